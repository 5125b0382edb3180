#include "expr/corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <optional>
#include <set>

#include "expr/operations.hpp"

namespace chainreel {
namespace {

bool compares(Operation operation) {
  return operation >= Operation::less && operation <= Operation::not_equal;
}

bool has_sides(Operation operation) {
  return compares(operation) || operation == Operation::absolute || operation == Operation::minimum ||
         operation == Operation::maximum || operation == Operation::arc_tangent2;
}

// And does not jump.
bool bends(Operation operation) {
  return operation == Operation::absolute || operation == Operation::minimum ||
         operation == Operation::maximum;
}

// On one side of the corner, or the mean of both.
template <class T>
T on_side(Operation operation, const T& x, double side) {
  return operation == Operation::absolute ? T(side) * x : result_of(operation, x);
}

// The branch of atan2 that goes on smoothly from y > 0 or from y < 0.
template <class T>
T arc_tangent_on(const T& y, const T& x, double side) {
  const T value = arc_tangent2(y, x);
  if (!(value_of(x) < 0)) return value;
  const T turn = T(2) * pi<T>();
  const bool above = value_of(value) > 0;
  const T upper = above ? value : value + turn;
  if (side == 1) return upper;
  const T lower = upper - turn;
  return side == -1 ? lower : lower + T(0.5 * (1 + side)) * turn;
}

template <class T>
T on_side(Operation operation, const T& a, const T& b, double side) {
  switch (operation) {
    case Operation::less:
    case Operation::less_equal:
      return T(0.5 * (1 - side));
    case Operation::greater:
    case Operation::greater_equal:
      return T(0.5 * (1 + side));
    case Operation::equal:
      return T(0);
    case Operation::not_equal:
      return T(1);
    case Operation::minimum:
      return side == 1 ? b : side == -1 ? a : T(0.5) * (a + b - T(side) * (a - b));
    case Operation::maximum:
      return side == 1 ? a : side == -1 ? b : T(0.5) * (a + b + T(side) * (a - b));
    default:
      return arc_tangent_on(a, b, side);
  }
}

// What an operation reads onto the stack; false for those that compute.
template <class T>
bool push(const Instruction& instruction, std::span<const T> values, T*& top) {
  switch (instruction.operation) {
    case Operation::number:
      *top++ = T(instruction.number);
      return true;
    case Operation::variable:
      *top++ = values[std::size_t(instruction.slot)];
      return true;
    case Operation::pi:
      *top++ = pi<T>();
      return true;
    default:
      return false;
  }
}

double side_of(const CorneredProgram& program, std::size_t i, std::span<const double> sides) {
  const CorneredProgram::Turn turn = program.turns[i];
  return turn.corner < 0 ? kAsWritten : turn.sign * sides[std::size_t(turn.corner)];
}

// Replaces the arguments at the top of the stack by what the operation makes of them on that side.
template <class T>
void operate(Operation operation, double side, T*& top) {
  const bool as_written = std::isnan(side) || (std::isinf(side) && bends(operation));
  if (std::isinf(side)) side = std::copysign(1.0, side);
  if (stack_change_of(operation) == 0) {
    top[-1] = as_written ? result_of(operation, top[-1]) : on_side(operation, top[-1], side);
  } else {
    top[-2] =
        as_written ? result_of(operation, top[-2], top[-1]) : on_side(operation, top[-2], top[-1], side);
    --top;
  }
}

template <std::size_t size, class T>
T run(const CorneredProgram& program, std::span<const T> values, std::span<const double> sides) {
  std::array<T, size> stack;
  T* top = stack.data();  // one past the last value
  for (std::size_t i = 0; i < program.instructions.size(); ++i)
    if (!push(program.instructions[i], values, top))
      operate(program.instructions[i].operation, side_of(program, i, sides), top);
  return top[-1];
}

// Beside each value what it is as written, which takes its place where it alone is finite.
template <std::size_t size, class T>
T run_with_text(const CorneredProgram& program, std::span<const T> values, std::span<const double> sides) {
  std::array<T, size> stack, text;
  T *top = stack.data(), *text_top = text.data();
  for (std::size_t i = 0; i < program.instructions.size(); ++i) {
    const Instruction& instruction = program.instructions[i];
    if (push(instruction, values, top)) {
      push(instruction, values, text_top);
      continue;
    }
    operate(instruction.operation, side_of(program, i, sides), top);
    operate(instruction.operation, kAsWritten, text_top);
    if (!std::isfinite(value_of(top[-1])) && std::isfinite(value_of(text_top[-1]))) top[-1] = text_top[-1];
  }
  return top[-1];
}

template <std::size_t size, class T>
T finite_where_possible(const CorneredProgram& program, std::span<const T> values,
                        std::span<const double> sides) {
  const T result = run<size>(program, values, sides);
  return std::isfinite(value_of(result)) ? result : run_with_text<size>(program, values, sides);
}

// Instructions [begin, end) of a program.
CorneredProgram part_of(const CorneredProgram& program, std::size_t begin, std::size_t end) {
  CorneredProgram part;
  const auto b = std::ptrdiff_t(begin), e = std::ptrdiff_t(end);
  part.instructions.assign(program.instructions.begin() + b, program.instructions.begin() + e);
  part.turns.assign(program.turns.begin() + b, program.turns.begin() + e);
  part.stack_size = program.stack_size;
  return part;
}

// Whether a power may have a corner: one whose exponent is a whole number has none.
bool may_bend(const CorneredProgram& program, std::size_t middle, std::size_t end) {
  if (end - middle != 1) return true;
  const Instruction& exponent = program.instructions[middle];
  return exponent.operation != Operation::number || exponent.number != std::floor(exponent.number);
}

}  // namespace

bool CorneredProgram::has_corners() const {
  return std::any_of(turns.begin(), turns.end(), [](const Turn& turn) { return turn.corner >= 0; });
}

template <class T>
T evaluate(const CorneredProgram& program, std::span<const T> values, std::span<const double> sides) {
  constexpr int kUsualStack = 8;
  if (program.stack_size <= kUsualStack) return finite_where_possible<kUsualStack>(program, values, sides);
  return finite_where_possible<kMaxStack>(program, values, sides);
}

// Two functions have one key where they are the same up to a factor; the number is that factor's sign.
std::pair<Corners::Key, double> Corners::key_of(const CorneredProgram& value) const {
  Key key;
  if (const auto form = affine_form_of<double>(value.instructions, uses_)) {
    key.first = form->powers;
    key.first.insert(key.first.end(), form->weights.begin(), form->weights.end());
    double scale = 0;
    for (std::size_t i = 1; i < key.first.size(); ++i)  // the constant last: it may be zero or rounded
      if (std::abs(key.first[i]) > std::abs(scale)) scale = key.first[i];
    if (scale != 0) {
      for (double& one : key.first) one = one / scale + 0.0;  // no negative zero
      key.first.push_back(double(form->powers.size()));
      return {key, scale < 0 ? -1.0 : 1.0};
    }
    key.first.clear();
  }
  const Instruction* const first = value.instructions.data();
  for (const Instruction* one = first; one != first + value.instructions.size(); ++one) {
    key.second += std::to_string(int(one->operation)) + ":" + std::to_string(one->slot) + ":";
    char bits[sizeof(double)];
    std::memcpy(bits, &one->number, sizeof bits);
    key.second.append(bits, sizeof bits);
  }
  return {key, 1.0};
}

// The corner of the operation whose arguments are the instructions from `begin` on, the second one's from
// `middle` on.
CorneredProgram::Turn Corners::corner_at(const CorneredProgram& program, std::size_t begin,
                                         Operation operation, std::size_t middle, const std::string& text) {
  const bool takes_difference =
      compares(operation) || operation == Operation::minimum || operation == Operation::maximum;
  const bool root = operation == Operation::square_root || operation == Operation::power;
  const std::size_t size = program.instructions.size();
  const bool first_alone = operation == Operation::arc_tangent2 || operation == Operation::power;
  CorneredProgram value = part_of(program, begin, first_alone ? middle : size);
  if (takes_difference) {
    value.instructions.push_back({Operation::subtract});
    value.turns.push_back({});
  }
  bool changes = false, reads_state = false;
  for (const Instruction& one : value.instructions) {
    if (one.operation != Operation::variable) continue;
    const VariableRole role = uses_[std::size_t(one.slot)].role;
    changes = changes || role != VariableRole::constant;
    reads_state = reads_state || (role != VariableRole::constant && role != VariableRole::time);
  }
  if (!changes || (root && reads_state)) return {};
  const auto form = affine_form_of<double>(value.instructions, uses_);
  const auto is_zero = [](double x) { return x == 0; };
  if (form && std::all_of(form->weights.begin(), form->weights.end(), is_zero) &&
      std::all_of(form->powers.begin() + 1, form->powers.end(), is_zero))
    return {};  // a constant after all
  const auto [key, sign] = key_of(value);
  const auto [found, is_new] = known_.try_emplace(key, int(list_.size()));
  if (is_new) {
    list_.push_back({value, !reads_state, root, text, false});
    if (sign < 0) {  // the corner's own function is that of the first operation
      list_.back().value.instructions.push_back({Operation::negate});
      list_.back().value.turns.push_back({});
    }
  }
  if (root) return {};
  list_[std::size_t(found->second)].only_bends = false;
  return {found->second, sign};
}

CorneredProgram Corners::add(const Expression& expression) {
  CorneredProgram program;
  program.stack_size = expression.program().stack_size;
  std::vector<std::size_t> begins;  // of each value that waits on the stack
  for (const Instruction& instruction : expression.program().instructions) {
    const int change = stack_change_of(instruction.operation);
    const std::size_t here = program.instructions.size();
    CorneredProgram::Turn turn;
    if (change > 0) {
      begins.push_back(here);
    } else {
      const std::size_t middle = change < 0 ? begins.back() : here;
      if (change < 0) begins.pop_back();
      const bool bends = instruction.operation == Operation::square_root ||
                         (instruction.operation == Operation::power && may_bend(program, middle, here));
      if (has_sides(instruction.operation) || bends)
        turn = corner_at(program, begins.back(), instruction.operation, middle, expression.text());
    }
    program.instructions.push_back(instruction);
    program.turns.push_back(turn);
  }
  mark_curved(program);
  return program;
}

// Follows the corners that each waiting value reads; sums and products with others leave them affine.
void Corners::mark_curved(const CorneredProgram& program) {
  std::vector<std::set<int>> stack;
  const auto mark = [&](const std::set<int>& read) {
    for (const int k : read) list_[std::size_t(k)].is_curved = true;
  };
  for (std::size_t i = 0; i < program.instructions.size(); ++i) {
    const Operation operation = program.instructions[i].operation;
    const int change = stack_change_of(operation);
    if (change > 0) {
      stack.emplace_back();
      continue;
    }
    std::set<int> last;
    if (change < 0) {
      last = std::move(stack.back());
      stack.pop_back();
    }
    std::set<int>& read = stack.back();
    if (operation == Operation::multiply) {
      std::set<int> both;
      std::set_intersection(read.begin(), read.end(), last.begin(), last.end(),
                            std::inserter(both, both.begin()));
      mark(both);
    } else if (operation == Operation::divide) {
      mark(last);
    } else if (operation != Operation::negate && operation != Operation::add &&
               operation != Operation::subtract) {
      mark(read);
      mark(last);
    }
    read.merge(last);
    if (program.turns[i].corner >= 0) read.insert(program.turns[i].corner);
  }
}

template double evaluate(const CorneredProgram&, std::span<const double>, std::span<const double>);
template Dual<double> evaluate(const CorneredProgram&, std::span<const Dual<double>>,
                               std::span<const double>);
template Dual<Dual<double>> evaluate(const CorneredProgram&, std::span<const Dual<Dual<double>>>,
                                     std::span<const double>);

}  // namespace chainreel
