// What the parts of a torque cost an evaluation, ns on the machine of sim/cost_table, beside which they were measured, and rounded. Counted,
// never timed while the program runs.
#pragma once

#include <span>

#include "expr/corners.hpp"
#include "model/chain.hpp"

namespace chainreel {

inline constexpr double kPriceOfLaw = 40;         // whatever it is, but a constant
inline constexpr double kPriceOfSpline = 20;      // at an instant, a freedom
inline constexpr double kPriceOfFunction = 20000;  // of the caller, as Python's
inline constexpr double kPriceOfDerivative = 2.3;  // times an expression, with its derivative in t and with two alike

double price_of(std::span<const Instruction> instructions);
double price_of(const CorneredProgram& program);
double price_of_kinematics(const Chain& chain);
double price_of_inverse_dynamics(const Chain& chain);

}  // namespace chainreel
