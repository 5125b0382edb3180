// The corners of expressions: where they jump or bend. `t > 1` jumps where its switching function t - 1 is
// zero, abs(x) bends where x is; so do the other comparisons, min and max (at a - b) and atan2(y, x) (at y,
// where x < 0).
//
// Each corner has a side: +1 or -1 is the sign that its switching function has, or is taken to have. With its
// sides held fixed an expression is smooth: abs(x) is x or -x on both sides of x = 0, (x > 0) is 1 or 0.
// Between -1 and 1 stands the mean of both branches with the weights (1 - s) / 2 and (1 + s) / 2; NaN stands
// for the text as it is. == and != are never true, or always, but at instants; those push nothing.
//
// Beyond its corner a branch may leave the domain of what it stands in: max(0, x)^1.5 is x^1.5 there. What
// has no value so, but has one as written, has that one; what stands around it keeps its side.
//
// What is the same function up to a constant factor, like qd1 > 0, 0 < 2*qd1 and abs(-qd1), is one corner.
#pragma once

#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "expr/affine.hpp"
#include "expr/expression.hpp"

namespace chainreel {

inline constexpr double kAsWritten = std::numeric_limits<double>::quiet_NaN();  // as a side
// As a side, with its sign: what jumps is on that side, what only bends (abs, min, max) is as written. At the
// corner itself that is the same; but 1/abs(x) keeps its sign where rounding leaves x beside zero.
inline constexpr double kJumpsAlone = std::numeric_limits<double>::infinity();

// An expression that knows its corners.
struct CorneredProgram {
  struct Turn {
    int corner = -1;  // index into Corners, -1: none
    double sign = 1;  // of the operation's own switching function against the corner's
  };
  std::vector<Instruction> instructions;
  std::vector<Turn> turns;  // one an instruction
  int stack_size = 0;

  bool has_corners() const;
};

// `sides`: one a corner. Finite wherever the expression is. Allocates nothing. For double, Dual<double> and
// Dual<Dual<double>>.
template <class T>
T evaluate(const CorneredProgram& program, std::span<const T> values, std::span<const double> sides);

struct Corner {
  CorneredProgram value;    // the switching function
  bool time_alone = false;  // it reads nothing that changes but t
  bool only_bends = false;  // it is no operation with sides, but what is under a root: a kink of t alone
  std::string text;         // of the first expression that has it
  // Between its sides an expression is not the mean of what it is on them: another corner, a function or a
  // denominator reads it.
  bool is_curved = false;
};

// The corners of some expressions over the same variables.
class Corners {
 public:
  // `uses`: constants change never, `time` is t, all others are the state's.
  explicit Corners(std::vector<VariableUse> uses) : uses_(std::move(uses)) {}

  // Finds the corners of an expression; those that are known already are shared.
  CorneredProgram add(const Expression& expression);

  int count() const { return int(list_.size()); }
  const Corner& operator[](int k) const { return list_[std::size_t(k)]; }
  std::span<const VariableUse> uses() const { return uses_; }

 private:
  using Key = std::pair<std::vector<double>, std::string>;

  CorneredProgram::Turn corner_at(const CorneredProgram& program, std::size_t begin, Operation operation,
                                  std::size_t middle, const std::string& text);
  std::pair<Key, double> key_of(const CorneredProgram& value) const;
  void mark_curved(const CorneredProgram& program);

  std::vector<VariableUse> uses_;
  std::vector<Corner> list_;
  std::map<Key, int> known_;
};

}  // namespace chainreel
