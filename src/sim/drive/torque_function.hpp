// Torques that a function of the calling program gives: what no scene file can say.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace chainreel {

class TorqueLaw;

// Writes nv numbers, N m or N, from t (s), q (nq) and qd (nv). It is asked some thousand times a second of the motion, more than
// once of an instant, and not in the order of time: what it gives must depend on its arguments alone. One thread asks at a time.
using TorqueFunction =
    std::function<void(double t, std::span<const double> q, std::span<const double> qd, std::span<double> tau)>;

struct OwnTorque {
  TorqueFunction function;
  std::string words;  // what it is called, for films and reports
  std::string name{};  // in pictures, "hold" for hold(t, q, qd): letters, digits and _; "": it has none
  // What it threw: then it is asked no more, and what asked for a run ends and has to throw it on.
  std::shared_ptr<std::exception_ptr> failure = std::make_shared<std::exception_ptr>();
};

std::unique_ptr<TorqueLaw> make_function_torque(OwnTorque torque);

}  // namespace chainreel
