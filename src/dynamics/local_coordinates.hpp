// Coordinates x of a chain with floating joints, as many as freedoms, so that x' are rates of their own: of a
// floating joint the position p in its parent and, in place of the quaternion, the rotation vector r from a base
// that moves along, R = R_base exp(r). All other coordinates stay as they are. With x' = (p', r') and the joint's
// twist (v, w) in the body's own axes,
//
//   v = R^T p',   w = D(r) r',   D = 1 - A [r]x + B [r]x^2,   A = (1 - cos |r|) / |r|^2,  B = (|r| - sin |r|) / |r|^3
//
// (D: the right Jacobian of SO(3); K. Lynch, F. Park, Modern Robotics, 2017, ch. 3; E. Hairer, C. Lubich, G. Wanner,
// Geometric Numerical Integration, 2006, III.4 and IV.8: its inverse is dexp^-1, by which methods keep their order).
// Regular where |r| < 2 pi: less than a turn of a body from the base.
#pragma once

#include <vector>

#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

class LocalCoordinates {
 public:
  explicit LocalCoordinates(const Chain& chain) : chain_(&chain), base_(std::size_t(chain.nq)) {}

  // The base is where q is. x there: nv numbers.
  void move_to(ConstVec q, Vec x);

  // All that follow take x, nv numbers: the configuration; v = D x' and back; x'' = (D x')' and back solved for x''.
  void place(ConstVec x, Vec q) const;
  void to_velocity(ConstVec x, ConstVec x_dot, Vec v) const;
  void to_rate(ConstVec x, ConstVec v, Vec x_dot) const;
  void to_second_rate(ConstVec x, ConstVec x_dot, ConstVec v_dot, Vec x_ddot) const;

  // The momenta p_x = D^T p that belong to x, from those of v, and back; their rates, from p and p' (as
  // MomentumForm gives them) at the rates x'. (x, p_x) is a canonical pair.
  void to_momentum(ConstVec x, ConstVec p, Vec p_x) const;
  void from_momentum(ConstVec x, ConstVec p_x, Vec p) const;
  void to_force(ConstVec x, ConstVec x_dot, ConstVec p, ConstVec p_dot, Vec p_x_dot) const;

 private:
  const Chain* chain_;
  std::vector<double> base_;  // as q; of floating joints their quaternions are asked for
};

}  // namespace chainreel
