// A chain under a torque law in quadruple precision, through the general recursions: what references are
// computed with. It shares no text with the Taylor series.
#pragma once

#include <memory>
#include <span>

#include "core/scalar.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

class QuadSystem {
 public:
  virtual ~QuadSystem() = default;
  int n() const { return n_; }
  // v' at this state; allocates.
  virtual void acceleration(Quad t, std::span<const Quad> q, std::span<const Quad> v, std::span<Quad> vd) = 0;

 protected:
  explicit QuadSystem(int n) : n_(n) {}
  int n_;
};

// Nothing where the torques cannot be had with the digits of Quad (controls, the end effector in an
// expression, torques that are cut), and for floating joints and joints that follow others. `simulation` must
// outlive it.
std::unique_ptr<QuadSystem> make_quad_system(const Simulation& simulation);

}  // namespace chainreel
