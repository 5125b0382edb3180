#include "sim/constraint_plan.hpp"

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

}  // namespace chainreel
