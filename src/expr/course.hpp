// What a function of t alone does over a whole piece of time, in interval arithmetic: bounds that its values
// and its slopes keep (R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis (2009)).
#pragma once

#include <span>
#include <vector>

#include "expr/corners.hpp"

namespace chainreel {

struct Range {
  double low = 0, high = 0;
  bool has_zero() const { return low <= 0 && high >= 0; }
  bool is_zero() const { return low == 0 && high == 0; }
  bool has_both_signs() const { return low < 0 && high > 0; }
};

// What values a function of t takes over a piece of time, and its slope.
struct Course {
  Range value, slope;
};

// Between which numbers a program lies whatever its variables are, as its operations tell it one by one: |x| is never below zero, but
// x - x may be anything.
Range values_of(const Program& program);

// The courses of programs over the same variables, all of which but t are constants.
class Courses {
 public:
  explicit Courses(std::span<const VariableUse> uses) : uses_(uses) {}

  // Over [a, b], at these sides of corners.
  Course over(const CorneredProgram& program, std::span<const double> sides, double a, double b);

 private:
  std::span<const VariableUse> uses_;
  std::vector<Course> stack_;
};

}  // namespace chainreel
