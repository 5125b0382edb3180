#include "expr/expression.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "expr/operations.hpp"

namespace chainreel {
namespace {

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

namespace {

bool is_comparison(Operation operation) {
  return operation >= Operation::less && operation <= Operation::not_equal;
}

}  // namespace

std::optional<Operation> Expression::comparison() const {
  const Operation outermost = program_.instructions.back().operation;
  return is_comparison(outermost) ? std::optional(outermost) : std::nullopt;
}

bool Expression::compares_inside() const {
  const auto& all = program_.instructions;
  return std::any_of(all.begin(), all.end() - 1,
                     [](const Instruction& one) { return is_comparison(one.operation); });
}

Expression Expression::difference() const {
  Expression result = *this;
  if (!comparison()) return result;
  result.program_.instructions.back().operation = Operation::subtract;
  if (constant_) result.constant_ = result.evaluate(std::span<const double>());
  return result;
}

template double Expression::evaluate(std::span<const double>) const;
template Quad Expression::evaluate(std::span<const Quad>) const;
template Dual<double> Expression::evaluate(std::span<const Dual<double>>) const;
template Dual<Dual<double>> Expression::evaluate(std::span<const Dual<Dual<double>>>) const;
template Dual<Quad> Expression::evaluate(std::span<const Dual<Quad>>) const;

}  // namespace chainreel
