// All combinations of values of several keys of a scene.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/run/sweep.hpp"

namespace chainreel {

class Grid {
 public:
  // Of texts like KEY=a,b,c or KEY=from:to:count; `option` is named in errors. Throws Error (usage) where two are of the same
  // key, (exit 7) where there are more than a hundred million combinations.
  Grid(const std::vector<std::string>& texts, const std::string& option);

  const std::vector<Sweep>& axes() const { return axes_; }
  std::size_t size() const { return size_; }

  // Which value of each axis combination k has: the last axis goes on first.
  std::vector<std::size_t> places(std::size_t k) const;
  // "key=value" of each axis, as overrides of the scene.
  std::vector<std::string> settings(std::size_t k) const;

 private:
  std::vector<Sweep> axes_;
  std::size_t size_ = 1;
};

}  // namespace chainreel
