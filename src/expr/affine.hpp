// Whether an expression is a polynomial in time plus constant multiples of chosen variables, and which one.
// Exact algebra on the parsed text: 3*(q1 - t)*2^2 has such a form, q1*q2, q1*t and sin(q1) have none, and
// neither has q1*0.5/0 or what cancels only in the end, like q1^2 - q1*q1.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "expr/expression.hpp"

namespace chainreel {

enum class VariableRole {
  constant,  // stands for its value
  time,
  linear,  // may occur with a constant factor
  other,   // may not occur
};

struct VariableUse {
  VariableRole role = VariableRole::other;
  double value = 0;  // of a constant
};

// powers[0] + powers[1] t + .. + sum_i weights[i] x_i
template <class T>
struct AffineForm {
  std::vector<T> powers;   // at least one
  std::vector<T> weights;  // one a name; zero but for the linear ones
};

inline constexpr int kHighestPowerOfTime = 8;

// `uses`: of each name that the expression was parsed with. For double and Quad.
template <class T>
std::optional<AffineForm<T>> affine_form_of(std::span<const Instruction> instructions,
                                            std::span<const VariableUse> uses);
template <class T>
std::optional<AffineForm<T>> affine_form_of(const Expression& expression, std::span<const VariableUse> uses) {
  return affine_form_of<T>(expression.program().instructions, uses);
}

}  // namespace chainreel
