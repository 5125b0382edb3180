// The Taylor method in quadruple precision, for references: a step goes as far as the last four terms allow.
#pragma once

#include <vector>

#include "dynamics/taylor_planar.hpp"

namespace chainreel {

class QuadSeries {
 public:
  QuadSeries(const Chain& chain, const AffineTorque& torque, int order, double tolerance);

  void start(Quad t, std::vector<Quad> q, std::vector<Quad> v);
  // Moves to `end`; false where no step is small enough.
  bool run_to(Quad end);

  const std::vector<Quad>& q() const { return q_; }
  const std::vector<Quad>& v() const { return v_; }

 private:
  double longest_step() const;

  PlanarSeries<Quad> series_;
  std::size_t n_;
  int order_;
  double tolerance_;
  Quad t_ = 0;
  std::vector<Quad> q_, v_, c_;
};

}  // namespace chainreel
