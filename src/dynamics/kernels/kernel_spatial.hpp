// Forward dynamics of a small chain or tree of revolute and prismatic joints in space: the mass matrix and
// the forces of R. Featherstone, Rigid Body Dynamics Algorithms (2008), tables 5.1 and 6.2, and an
// elimination that keeps the order of the tree (ch. 8.5).
//
// All vectors are along the world's axes, and all moments and velocities are taken about one point O, so that
// nothing has to be carried from body to body: inertias and forces of a subtree are plain sums, and M_ij =
// S_j . Ic_i S_i is one product. O moves: at each call it is where the first joint is, so that a long way of
// the base costs no digits. A 3-vector is one vector of four lanes.
//
//   R_i = R_p T_i turn_z(q),  o_i = o_p + R_p p_i,  S_i = (z_i; o_i x z_i)   or (0; z_i) for a sliding joint
//   v_i = v_p + S_i qd,  a_i = a_p + v_p x S_i qd                             a of the world is -gravity
//   F_i = m (a of the centre of mass),  N_i = I a_w + w x I w + c_i x F_i      Newton and Euler
//   row i of M: S_j . Ic_i S_i;  nle_i = S_i . (sum of (N, F) behind i)
//
// The axes of each body are turned so that z is the joint's axis.
#pragma once

#include <array>
#include <vector>

#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

struct SpatialKernel {
  static constexpr int kMaxJoints = 15;  // one lane of a row holds its right-hand side
  using Lanes = std::array<double, 4>;

  // A number that multiplies vectors stands in all four lanes.
  struct alignas(32) Link {
    Lanes T[3][3];  // T[c][r]: row r of column c of the turn from the parent's axes at q = 0
    Lanes p[3];     // joint in the parent's axes
    Lanes com[3];   // centre of mass in the body's axes
    Lanes I[3][3];  // about the centre of mass
    Lanes mass;
    int parent = -1;  // link, -1 for the world
    bool slides = false;
  };
  // Keeps of row i what lies between link i and the base: lane 0, and lane j + 1 for each link j on the way.
  struct alignas(32) RowMask {
    std::uint64_t lanes[16];
  };

  std::vector<Link> links;
  std::vector<RowMask> masks;
  alignas(32) Lanes base_acceleration{};
  int joints = 0;  // 0: the chain is of another kind
  bool serial = true;
};

SpatialKernel spatial_kernel_of(const Chain& chain);

// The kernel's axes of the body behind a joint with this axis, in the body's own: z is the joint's axis.
Eigen::Matrix3d kernel_axes(const Eigen::Vector3d& axis);

}  // namespace chainreel
