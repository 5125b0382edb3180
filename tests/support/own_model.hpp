// A model that comes with the program, as text that a test may change.
#pragma once

#include <string>

#include "support/temporary_folder.hpp"

namespace chainreel {

inline std::string own_model() { return read_whole_file(std::string(CHAINREEL_SOURCE_FOLDER) + "/models/rr.urdf"); }

// With another mass of its first link.
inline std::string heavier(const std::string& model) {
  const std::string mass = "<mass value=\"";
  std::string text = model;
  return text.replace(text.find(mass), mass.size(), mass + "1");
}

}  // namespace chainreel
