#include "sim/drive/prices.hpp"

namespace chainreel {
namespace {

constexpr double kOfExpression = 4, kOfInstruction = 3, kOfFunction = 25;  // ns

bool is_function(Operation operation) {
  switch (operation) {
    case Operation::sine:
    case Operation::cosine:
    case Operation::tangent:
    case Operation::square_root:
    case Operation::exponential:
    case Operation::logarithm:
    case Operation::power:
    case Operation::arc_tangent2:
      return true;
    default:
      return false;
  }
}

constexpr double kWithCorners = 2;  // times an expression that has some

}  // namespace

double price_of(std::span<const Instruction> instructions) {
  double price = kOfExpression;
  for (const Instruction& one : instructions) price += is_function(one.operation) ? kOfFunction : kOfInstruction;
  return price;
}

double price_of(const CorneredProgram& program) {
  return (program.has_corners() ? kWithCorners : 1) * price_of(program.instructions);
}

double price_of_kinematics(const Chain& chain) {
  return (chain.planar ? 65 : 120) * chain.nv;
}

double price_of_inverse_dynamics(const Chain& chain) {
  return (chain.planar ? 70 : 140) * chain.nv;
}

}  // namespace chainreel
