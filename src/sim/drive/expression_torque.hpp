// Torques that are expressions of time, state, end effector and parameters.
#pragma once

#include <memory>

#include "expr/expression.hpp"
#include "sim/drive/torque.hpp"

namespace chainreel {

// One entry a freedom, parsed with the probe's names.
std::unique_ptr<TorqueLaw> make_expression_torque(Probe probe, std::vector<Expression> entries);

}  // namespace chainreel
