#include "sim/system/trajectory.hpp"

namespace chainreel {

std::string to_string(RunStatus status) {
  switch (status) {
    case RunStatus::finished: return "finished";
    case RunStatus::diverged: return "diverged";
    case RunStatus::torque_not_finite: return "torque_not_finite";
    case RunStatus::stopped: return "stopped";
    case RunStatus::event_not_finite: return "event_not_finite";
    case RunStatus::not_converged: return "not_converged";
    case RunStatus::step_too_small: return "step_too_small";
    case RunStatus::inconsistent: return "inconsistent";
    case RunStatus::constraint_lost: return "constraint_lost";
    case RunStatus::chattering: return "chattering";
    case RunStatus::out_of_budget: return "out_of_budget";
    case RunStatus::interrupted: return "interrupted";
  }
  return "unknown";
}

}  // namespace chainreel
