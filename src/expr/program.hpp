// What the parser writes and evaluation reads: instructions in postfix order for a stack machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace chainreel {

enum class Operation : std::int32_t {
  // onto the stack
  number,
  variable,
  pi,
  // the top
  negate,
  sine,
  cosine,
  tangent,
  square_root,
  exponential,
  logarithm,
  absolute,
  // the top two
  add,
  subtract,
  multiply,
  divide,
  power,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  minimum,
  maximum,
  arc_tangent2,
};

// By how much an operation changes the number of values on the stack.
constexpr int stack_change_of(Operation operation) {
  return operation <= Operation::pi ? 1 : operation < Operation::add ? 0 : -1;
}

struct Instruction {
  Operation operation = Operation::number;
  std::int32_t slot = 0;  // of a variable
  double number = 0;
};

// Nesting costs at most one waiting value for each of the five levels of precedence; the unit of the innermost number one more, and
// functions that are written as others two more each, of which programs as long as this have so many in one another.
inline constexpr int kMaxNesting = 200;
inline constexpr std::size_t kMaxInstructions = 50'000;
inline constexpr int kMaxStack = 5 * (kMaxNesting + 1) + 1 + 2 * 16;

struct Program {
  std::vector<Instruction> instructions;
  int stack_size = 0;  // the most values that wait at once
};

}  // namespace chainreel
