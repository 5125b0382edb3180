// Interval arithmetic over programs; see expr/course.hpp.
#include "expr/course.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/scalar.hpp"

namespace chainreel {
namespace {

constexpr double kPi = 3.14159265358979323846;

constexpr Range kAnything{-kInfinity, kInfinity};

Range range_of(std::initializer_list<double> values) {
  Range range{kInfinity, -kInfinity};
  for (const double x : values) {
    if (std::isnan(x)) return kAnything;
    range.low = std::min(range.low, x);
    range.high = std::max(range.high, x);
  }
  return range;
}

Range operator+(Range a, Range b) {
  return range_of({a.low + b.low, a.high + b.high});
}
Range operator-(Range a, Range b) {
  return range_of({a.low - b.high, a.high - b.low});
}
Range operator*(Range a, Range b) {
  if (a.is_zero() || b.is_zero()) return {};
  return range_of({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}
Range operator/(Range a, Range b) {
  if (b.has_zero()) return kAnything;
  return range_of({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
}

Range sine_of(Range x) {
  if (!(x.high - x.low < 2 * kPi)) return {-1, 1};
  Range range = range_of({sine(x.low), sine(x.high)});
  // The first crest and the first trough at or behind the beginning.
  const auto passes = [&](double at) { return at + 2 * kPi * std::ceil((x.low - at) / (2 * kPi)) <= x.high; };
  if (passes(0.5 * kPi)) range.high = 1;
  if (passes(-0.5 * kPi)) range.low = -1;
  return range;
}

Range cosine_of(Range x) {
  return sine_of({x.low + 0.5 * kPi, x.high + 0.5 * kPi});
}

Range whole_power(Range x, int n) {
  if (n == 0) return {1, 1};
  if (n < 0) return Range{1, 1} / whole_power(x, -n);
  Range range = range_of({power(x.low, double(n)), power(x.high, double(n))});
  if (n % 2 == 0 && x.has_zero()) range.low = 0;
  return range;
}

Range hull(Range a, Range b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

Course course_of(Operation operation, const Course& x, double side) {
  const auto [v, d] = x;
  switch (operation) {
    case Operation::negate:
      return {Range{} - v, Range{} - d};
    case Operation::sine:
      return {sine_of(v), cosine_of(v) * d};
    case Operation::cosine:
      return {cosine_of(v), Range{} - sine_of(v) * d};
    case Operation::tangent: {
      const Range c = cosine_of(v);
      const double low = tangent(v.low), high = tangent(v.high);
      // Between poles it rises; the rounding of a cosine may hide one that lies at an end.
      if (c.has_zero() || !(low <= high)) return {kAnything, kAnything};
      return {{low, high}, d / (c * c)};
    }
    case Operation::square_root: {
      if (v.high < 0) return {kAnything, kAnything};
      const Range root{square_root(std::max(v.low, 0.0)), square_root(v.high)};
      return {root, d / (root + root)};
    }
    case Operation::exponential: {
      const Range e{exponential(v.low), exponential(v.high)};
      return {e, e * d};
    }
    case Operation::logarithm:
      if (v.low <= 0) return {kAnything, kAnything};
      return {{logarithm(v.low), logarithm(v.high)}, d / v};
    default:  // the absolute value
      if (side == 1) return x;
      if (side == -1) return {Range{} - v, Range{} - d};
      if (v.low >= 0) return x;
      if (v.high <= 0) return {Range{} - v, Range{} - d};
      return {{0, std::max(-v.low, v.high)}, hull(d, Range{} - d)};
  }
}

Course power_of(const Course& a, const Course& b) {
  const bool constant = b.value.low == b.value.high && b.slope.is_zero();
  const double n = b.value.low;
  if (constant && n == std::floor(n) && std::abs(n) < 1000) {
    const int whole = int(n);
    return {whole_power(a.value, whole), Range{n, n} * whole_power(a.value, whole - 1) * a.slope};
  }
  if (constant && n > 0 && a.value.low >= 0) {  // zero has no logarithm
    const Range value{power(a.value.low, n), power(a.value.high, n)};
    if (a.slope.is_zero()) return {value, {}};
    const double steep = a.value.low > 0 ? power(a.value.low, n - 1) : n < 1 ? kInfinity : 0.0;
    return {value, Range{n, n} * range_of({steep, power(a.value.high, n - 1)}) * a.slope};
  }
  if (!(a.value.low > 0)) return {kAnything, kAnything};
  const Course log = course_of(Operation::logarithm, a, 0);
  const Course product{b.value * log.value, b.slope * log.value + b.value * log.slope};
  return course_of(Operation::exponential, product, 0);
}

Course course_of(Operation operation, const Course& a, const Course& b, double side) {
  switch (operation) {
    case Operation::add:
      return {a.value + b.value, a.slope + b.slope};
    case Operation::subtract:
      return {a.value - b.value, a.slope - b.slope};
    case Operation::multiply:
      return {a.value * b.value, a.slope * b.value + a.value * b.slope};
    case Operation::divide:
      return {a.value / b.value, (a.slope * b.value - a.value * b.slope) / (b.value * b.value)};
    case Operation::power:
      return power_of(a, b);
    case Operation::minimum:
    case Operation::maximum: {
      const double of_first = operation == Operation::maximum ? 1 : -1;
      if (side == of_first) return a;
      if (side == -of_first) return b;
      const Range above = operation == Operation::maximum ? a.value : b.value;
      const Range below = operation == Operation::maximum ? b.value : a.value;
      if (above.low >= below.high) return a;
      if (above.high <= below.low) return b;
      return {hull(a.value, b.value), hull(a.slope, b.slope)};
    }
    case Operation::arc_tangent2: {
      const Range norm = a.value * a.value + b.value * b.value;
      return {{-3 * kPi, 3 * kPi}, (b.value * a.slope - a.value * b.slope) / norm};
    }
    default: {  // a comparison; == and != hold never and always
      if (!(std::abs(side) == 1)) return {{0, 1}, {}};
      const bool rises = operation == Operation::greater || operation == Operation::greater_equal;
      const bool falls = operation == Operation::less || operation == Operation::less_equal;
      const double truth = rises ? (side == 1) : falls ? (side == -1) : (operation == Operation::not_equal);
      return {{truth, truth}, {}};
    }
  }
}

Course start(const Instruction& one, std::span<const VariableUse> uses, double a, double b) {
  const VariableUse& use = uses[std::size_t(one.slot)];
  if (use.role == VariableRole::time) return {{a, b}, {1, 1}};
  return {{use.value, use.value}, {}};
}

// `variable(instruction)` and `side(index)` say what a variable is, and at which side of its corner an instruction stands.
template <class Variable, class Side>
Course follow(const std::vector<Instruction>& instructions, std::vector<Course>& stack, Variable&& variable, Side&& side) {
  stack.clear();
  for (std::size_t i = 0; i < instructions.size(); ++i) {
    const Instruction& one = instructions[i];
    const int change = stack_change_of(one.operation);
    if (change > 0) {
      stack.push_back(one.operation == Operation::pi       ? Course{{kPi, kPi}, {}}
                      : one.operation == Operation::number ? Course{{one.number, one.number}, {}}
                                                           : variable(one));
      continue;
    }
    const Course last = stack.back();
    if (change == 0) {
      stack.back() = course_of(one.operation, last, side(i));
      continue;
    }
    stack.pop_back();
    stack.back() = course_of(one.operation, stack.back(), last, side(i));
  }
  return stack.back();
}

}  // namespace

Course Courses::over(const CorneredProgram& program, std::span<const double> sides, double a, double b) {
  return follow(program.instructions, stack_, [&](const Instruction& one) { return start(one, uses_, a, b); },
                [&](std::size_t i) {
                  const CorneredProgram::Turn turn = program.turns[i];
                  return turn.corner < 0 ? kAsWritten : turn.sign * sides[std::size_t(turn.corner)];
                });
}

Range values_of(const Program& program) {
  std::vector<Course> stack;
  return follow(program.instructions, stack, [](const Instruction&) { return Course{kAnything, kAnything}; },
                [](std::size_t) { return kAsWritten; })
      .value;
}

}  // namespace chainreel
