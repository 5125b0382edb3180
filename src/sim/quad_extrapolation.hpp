// Extrapolation of the midpoint rule in quadruple precision: W. Gragg, SIAM Journal on Numerical Analysis 2
// (1965) 384-403; R. Bulirsch, J. Stoer, Numerische Mathematik 8 (1966) 1-13; E. Hairer, S. Norsett, G.
// Wanner, Solving Ordinary Differential Equations I (1993), II.9.
//
// The rule with n_j = 2 j substeps has an error in even powers of the substep alone. Its results T_j1 for
// j = 1 .. columns are extrapolated to none,
//   T_j,k+1 = T_jk + (T_jk - T_j-1,k) / ((n_j / n_j-k)^2 - 1),
// which gives order 2 columns; the last two entries of the last row differ by the error of the worse one.
#pragma once

#include <vector>

#include "sim/quad_system.hpp"

namespace chainreel {

class QuadExtrapolation {
 public:
  QuadExtrapolation(QuadSystem& system, int columns, double tolerance);

  void start(Quad t, std::vector<Quad> q, std::vector<Quad> v);
  // Moves to `end`; false where no step is small enough.
  bool run_to(Quad end);

  const std::vector<Quad>& q() const { return q_; }
  const std::vector<Quad>& v() const { return v_; }

 private:
  // y = (q, v) after a step, by the midpoint rule in `substeps` parts.
  void midpoint(Quad h, int substeps, std::vector<Quad>& y);
  void rate(Quad t, const std::vector<Quad>& y, std::vector<Quad>& f);
  // The step's error in units of the tolerance; the result is the last entry of the table.
  double attempt(Quad h);

  QuadSystem& system_;
  std::size_t n_;
  double tolerance_;
  Quad t_ = 0, h_ = 0;
  std::vector<Quad> q_, v_;
  std::vector<std::vector<Quad>> table_;  // the last row so far
  std::vector<Quad> y_, before_, f_;
};

}  // namespace chainreel
