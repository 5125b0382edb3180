#include "sim/constraint_plan.hpp"

#include "core/error.hpp"

namespace chainreel {

std::string to_string(Stabilization stabilize) {
  switch (stabilize) {
    case Stabilization::none:
      return "none";
    case Stabilization::baumgarte:
      return "baumgarte";
    case Stabilization::project:
      return "project";
  }
  return {};
}

Stabilization stabilization_of(const std::string& name) {
  for (const Stabilization one : {Stabilization::none, Stabilization::baumgarte, Stabilization::project})
    if (to_string(one) == name) return one;
  throw Error(ExitCode::bad_input, "'stabilize' must be project, baumgarte or none, not '" + name + "'");
}

}  // namespace chainreel
