// The sides that hold corners where more corners are held than the robot has ways to move.
//
// Two joints on a guide that leaves one way to move rest on the friction of both, and nobody knows how they
// share the load: the rates of their switching functions depend on each other, and many pairs of sides keep
// them at zero. Any within [-1, 1] is a mean of both branches of each (A. F. Filippov, Differential Equations
// with Discontinuous Righthand Sides (1988), 4); the one whose largest side is least is within as long as any
// is, and reaches the limit when the last does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chainreel {

class EvenSides {
 public:
  explicit EvenSides(std::size_t corners);

  // Of all x with A x = b (A by rows, square) the one whose largest |x_j| is least, and of those that leave
  // others free the one where theirs is, and so on: the strict Chebyshev solution (J. Rice, Bull. Amer. Math.
  // Soc. 68 (1962), 405). False, and x as it was, where A is regular, so that there is one alone, a number is
  // none, or there are more than kMost corners: choices of columns are gone through, whose number doubles with
  // each. Where b is out of A's range it is that of a part of the rows. No numbers where a row is zero: no side
  // holds that corner. Allocates nothing.
  static constexpr std::size_t kMost = 12;
  bool solve(std::span<const double> a, std::span<const double> b, std::span<double> x);

 private:
  // Rows of numbers of which the first few are told to take part.
  struct Rows {
    std::size_t width = 0;
    std::vector<double> numbers;
    std::vector<std::size_t> basic;  // of each row that is reduced, its column
    double& operator()(std::size_t row, std::size_t column) { return numbers[row * width + column]; }
  };
  using Columns = std::uint32_t;  // a bit each

  static std::size_t reduce(Rows& rows, std::size_t count, std::size_t of_columns, Columns active);
  void scale(std::span<const double> a, std::span<const double> b);
  bool find_combination(Columns left_out);
  void fix_largest(std::span<double> x);

  std::size_t n_;
  Rows rows_;                           // A scaled, b behind it
  Rows zeros_;                          // of the combination of rows that leaves columns out
  std::vector<double> weight_;          // of each column: x_j is its unknown over this
  std::vector<double> y_, lambda_;      // a combination of rows, and its columns
  std::vector<double> best_;
  std::size_t count_ = 0, rank_ = 0;
  Columns active_ = 0;                  // columns whose unknowns are not known yet
};

}  // namespace chainreel
