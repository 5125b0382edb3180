// The registry of methods: one row each, walked by the command line, the tests and the documents.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "integrate/system.hpp"

namespace chainreel {

// One method with the memory it needs; allocates nothing after it is made.
class Stepper {
 public:
  virtual ~Stepper() = default;
  // Moves (q, v) from t to t + h.
  virtual void step(SecondOrder& system, double t, double h, std::span<double> q, std::span<double> v) = 0;
};

struct Method {
  std::string name;
  int order = 1;
  bool symplectic = false;  // for constant mass; see the source's note where M depends on q
  bool adaptive = false;
  int evaluations_per_step = 1;
  std::string source;
  std::unique_ptr<Stepper> (*make)(int nq, int nv) = nullptr;
};

const std::vector<Method>& methods();

// Throws Error (usage) naming the nearest known method.
const Method& find_method(const std::string& name);

}  // namespace chainreel
