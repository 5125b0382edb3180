// A chain in its coordinates and momenta: p = M(q) qd, T = 1/2 p^T M^-1 p, and
//
//   qd = M^-1 p,   p' = dT/dq + tau - tau_f - tau_g,   dT/dq at constant qd.
//
// All of it is O(n), but for chains whose bodies share a coordinate (mimic), which factor M.
#pragma once

#include <array>
#include <vector>

#include "dynamics/kernels/kernel_planar.hpp"
#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

// Remembers the configuration that it was last asked about, with its sines, cosines and what of M was
// factored there: questions about one configuration cost little after the first. q: nq numbers, qd and p: nv. Of a
// floating joint p are the momenta along the body's own axes and about its origin, linear, then angular; p' those
// of Euler and Poincare. In dynamics/local_coordinates they become a canonical pair.
class MomentumForm {
 public:
  explicit MomentumForm(const Chain& chain);

  void momentum(ConstVec q, ConstVec qd, Vec p);
  void velocity(ConstVec q, ConstVec p, Vec qd);
  // dT/dq - tau_g at the velocity qd: p' of a chain that no torque and no friction acts on.
  void force(ConstVec q, ConstVec qd, Vec p_dot);

 private:
  bool is_new(ConstVec q);
  // The form of the planar kernel with n joints, unrolled.
  template <std::size_t n>
  void place_kernel(ConstVec q);
  template <std::size_t n>
  void kernel_momentum(ConstVec q, ConstVec qd, Vec p);
  template <std::size_t n>
  void kernel_velocity(ConstVec q, ConstVec p, Vec qd);
  template <std::size_t n>
  void kernel_force(ConstVec q, ConstVec qd, Vec p_dot);
  void place_links(ConstVec q);
  void velocity_by_bodies(ConstVec q, ConstVec p, Vec qd);
  void velocity_by_factor(ConstVec q, ConstVec p, Vec qd);

  Workspace ws_;
  std::vector<double> q_;  // of the last question; NaN before the first

  // Chains of the planar kernel, in absolute angles.
  static constexpr std::size_t kMax = PlanarKernel::kMaxJoints;
  std::size_t joints_ = 0;  // 0: another chain
  double slope_[kMax][kMax] = {};
  double factor_[kMax * kMax] = {};  // of M in absolute angles, joints_ x joints_: L D L^T
  double A_[kMax][kMax] = {};
  double pull_[kMax] = {};

  bool factors_ = false;  // M of a chain whose bodies share a coordinate
  bool has_factor_ = false;
  std::vector<double> M_;
};

}  // namespace chainreel
