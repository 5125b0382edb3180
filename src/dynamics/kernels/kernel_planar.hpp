// Forward dynamics of a chain of one to four revolute joints that moves in a plane, in absolute angles,
// unrolled for its number of joints. What is constant is folded once, when the workspace is made.
//
// phi_i: absolute angle of link i; R_i its rotation; m_i, I_i mass and moment of inertia about its centre of
// mass; l_i the vector from its joint to the next one, d_i to its centre of mass, both along the link. With
// all that a link carries lumped at its end,
//
//   h_i = m_i d_i + l_i sum_{k>i} m_k,   A_ii = I_i + m_i d_i^2 + l_i^2 sum_{k>i} m_k,
//   U_i = R_i l_i,  H_i = R_i h_i,       A_ij = U_i . H_j  for i < j,
//
// the kinetic energy is 1/2 sum A_ij phi_i' phi_j', and Lagrange's equations are
//
//   sum_j A_ij phi_j'' + sum_{j != i} dA_ij/dphi_j phi_j'^2 = Q_i + H_i x gravity,   Q_i = tau_i - tau_{i+1},
//
// with dA_ij/dphi_j = - U_i x H_j = - dA_ij/dphi_i for i < j. (J. Craig, Introduction to Robotics, 3rd ed.,
// ch. 6, in joint angles; absolute angles keep every coupling to one product.)
#pragma once

#include <array>

#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

struct PlanarKernel {
  static constexpr int kMaxJoints = 4;
  using PerLink = std::array<double, kMaxJoints>;

  // Vectors of each link when q = 0, along the plane's axes; a missing link weighs nothing.
  alignas(32) PerLink l_x{}, l_y{}, h_x{}, h_y{};
  alignas(32) PerLink pull_c{}, pull_s{};  // H_i x gravity = pull_c cos phi_i - pull_s sin phi_i
  PerLink A_ii{};
  double A_11_inv = 0, A_11_A_22 = 0, l_1_h_2 = 0;
  PerLink sign{1, 1, 1, 1};  // of the joint's axis along the normal

  int joints = 0;       // 0: the chain is of another kind
  bool along_x = true;  // all links lie along ex and gravity along ey
  bool turned = false;  // some sign is -1
};

PlanarKernel planar_kernel_of(const Chain& chain);

}  // namespace chainreel
