// The Taylor method in quadruple precision, for references: a step goes as far as the last four terms allow.
#pragma once

#include <limits>
#include <vector>

#include "dynamics/kernels/taylor_planar.hpp"

namespace chainreel {

class QuadSeries {
 public:
  QuadSeries(const Chain& chain, const AffineTorque& torque, int order, double tolerance);

  void start(Quad t, std::vector<Quad> q, std::vector<Quad> v);
  // Ends run_to behind so many expansions of all its calls.
  void set_most_expansions(long most) { most_ = most; }
  long expansions() const { return expansions_; }
  // Moves to `end`; false where no step is small enough, or the expansions are spent.
  bool run_to(Quad end);

  const std::vector<Quad>& q() const { return q_; }
  const std::vector<Quad>& v() const { return v_; }

 private:
  double longest_step() const;

  PlanarSeries<Quad> series_;
  std::size_t n_;
  int order_;
  double tolerance_;
  long most_ = std::numeric_limits<long>::max(), expansions_ = 0;
  Quad t_ = 0;
  std::vector<Quad> q_, v_, c_;
};

}  // namespace chainreel
