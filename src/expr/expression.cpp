#include "expr/expression.hpp"

#include <quadmath.h>

#include <array>
#include <cassert>

namespace chainreel {
namespace {

template <class T>
T pi() {
  if constexpr (std::is_constructible_v<T, Quad>)
    return T(M_PIq);
  else
    return T(double(M_PIq));
}

template <class T>
T result_of(Operation operation, const T& x) {
  switch (operation) {
    case Operation::sine:
      return sine(x);
    case Operation::cosine:
      return cosine(x);
    case Operation::tangent:
      return tangent(x);
    case Operation::square_root:
      return square_root(x);
    case Operation::exponential:
      return exponential(x);
    case Operation::logarithm:
      return logarithm(x);
    case Operation::absolute:
      return absolute(x);
    default:
      assert(operation == Operation::negate);
      return -x;
  }
}

template <class T>
T truth(bool value) {
  return T(value ? 1.0 : 0.0);
}

template <class T>
T result_of(Operation operation, const T& a, const T& b) {
  switch (operation) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return power(a, b);
    case Operation::less:
      return truth<T>(a < b);
    case Operation::less_equal:
      return truth<T>(a <= b);
    case Operation::greater:
      return truth<T>(a > b);
    case Operation::greater_equal:
      return truth<T>(a >= b);
    case Operation::equal:
      return truth<T>(a == b);
    case Operation::not_equal:
      return truth<T>(a != b);
    case Operation::minimum:
      return minimum(a, b);
    case Operation::maximum:
      return maximum(a, b);
    default:
      assert(operation == Operation::arc_tangent2);
      return arc_tangent2(a, b);
  }
}

// `size` places are enough for the program; few, because a Dual's are cleared first.
template <std::size_t size, class T>
T run(const std::vector<Instruction>& instructions, std::span<const T> values) {
  std::array<T, size> stack;
  T* top = stack.data();  // one past the last value
  for (const Instruction& instruction : instructions) {
    const Operation operation = instruction.operation;
    switch (operation) {
      case Operation::number:
        *top++ = T(instruction.number);
        break;
      case Operation::variable:
        assert(std::size_t(instruction.slot) < values.size());
        *top++ = values[std::size_t(instruction.slot)];
        break;
      case Operation::pi:
        *top++ = pi<T>();
        break;
      default:
        if (stack_change_of(operation) == 0) {
          top[-1] = result_of(operation, top[-1]);
        } else {
          top[-2] = result_of(operation, top[-2], top[-1]);
          --top;
        }
    }
  }
  return top[-1];
}

}  // namespace

template <class T>
T Expression::evaluate(std::span<const T> values) const {
  constexpr int kUsualStack = 8;
  if (program_.stack_size <= kUsualStack) return run<kUsualStack>(program_.instructions, values);
  return run<kMaxStack>(program_.instructions, values);
}

template double Expression::evaluate(std::span<const double>) const;
template Quad Expression::evaluate(std::span<const Quad>) const;
template Dual<double> Expression::evaluate(std::span<const Dual<double>>) const;
template Dual<Dual<double>> Expression::evaluate(std::span<const Dual<Dual<double>>>) const;
template Dual<Quad> Expression::evaluate(std::span<const Dual<Quad>>) const;

}  // namespace chainreel
