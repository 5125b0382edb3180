// A formula of a scene: parsed once, evaluated at every instant over double, Quad and Dual.
//
//   numbers        1, 0.5, .5, 2e-3; always with a decimal point; 45deg is 45 * (pi / 180), 2rad is 2
//   names          the variables given to parse, and pi
//   operators      in rising order: < <= > >= == != (1 or 0; not chained), + -, * /, unary + -, ^ (right to
//   left)
//                  so -2^2 is -4, 2^3^2 is 2^9 and 2^-1 is 0.5
//   functions      sin cos tan asin acos atan tanh sqrt exp log abs sign, atan2(y, x), min and max of two or more
//
// There is one value per expression: no assignment, no list. Angles are radians. A number is the nearest
// double for every scalar, as it is everywhere else in a scene; pi and what is computed have the digits of
// the scalar.
//
// A double's result has the same bits on every machine; see core/scalar.hpp for its functions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/scalar.hpp"
#include "expr/program.hpp"

namespace chainreel {

class Expression {
 public:
  // A name's slot is its index in `names`; `place` is that of the text's first character. Throws Error (bad
  // input) at the place of the first thing that is wrong.
  static Expression parse(std::string_view text, std::span<const std::string> names, const Place& place);

  // The value where variable i is values[i]. Allocates nothing. For double, Quad, Dual<double>,
  // Dual<Dual<double>> and Dual<Quad>. What has no value (log(-1), 1/0) is NaN or infinite.
  template <class T>
  T evaluate(std::span<const T> values) const;

  bool is_constant() const { return constant_.has_value(); }
  std::optional<double> constant() const { return constant_; }
  // The comparison that the expression is, and what it compares: a - b of `a < b`, itself of any other.
  std::optional<Operation> comparison() const;
  Expression difference() const;
  // A comparison is part of it, below the outermost operation.
  bool compares_inside() const;
  const std::vector<int>& used_variables() const { return used_variables_; }  // slots that occur, rising
  const std::string& text() const { return text_; }
  const Program& program() const { return program_; }

 private:
  std::string text_;
  Program program_;
  std::vector<int> used_variables_;
  std::optional<double> constant_;  // the value of an expression without variables
};

// pi and the functions: no variable can have such a name.
bool is_reserved_name(std::string_view name);
// A letter or underscore, then letters, digits and underscores; other names cannot stand in an expression.
bool is_variable_name(std::string_view name);

// The functions that expressions know, as they are told to people.

// "atan2(y, x)" and what it is.
std::vector<Name> expression_functions();

}  // namespace chainreel
