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
//   sum_j A_ij phi_j'' + sum_{j != i} dA_ij/dphi_j phi_j'^2 + (gravity x H_i) = Q_i,   Q_i = tau_i -
//   tau_{i+1},
//
// with dA_ij/dphi_j = - U_i x H_j = - dA_ij/dphi_i for i < j. (J. Craig, Introduction to Robotics, 3rd ed.,
// ch. 6, in joint angles; absolute angles keep every coupling to one product.)
#pragma once

#include <array>

#include "model/chain.hpp"

namespace chainreel {

struct PlanarKernel {
  static constexpr int kMaxJoints = 4;
  template <class T>
  using PerLink = std::array<T, kMaxJoints>;

  // Vectors of each link when q = 0, along the plane's axes; a missing link weighs nothing.
  alignas(32) PerLink<double> l_x{}, l_y{}, h_x{}, h_y{};
  alignas(32) PerLink<double> g_x{}, g_y{};  // gravity, the same for each link
  PerLink<double> A_ii{};
  double A_11_inv = 0, A_11_A_22 = 0;
  PerLink<double> sign{1, 1, 1, 1};  // of the joint's axis along the normal

  using Run = void (*)(const PlanarKernel& kernel, const double* q, const double* qd, const double* tau,
                       double* qdd);
  Run run = nullptr;  // for this number of joints and this processor; none if the chain is of another kind
};

// The constants of core/scalar.hpp's sin_cos, in each of four lanes: operands in memory, which the compiler
// must not see through, or it would load each by an instruction of its own.
struct alignas(32) SinCosTable {
  using Lanes = double[4];
  Lanes two_over_pi, round_to_integer, half_pi[3], rare, one, half, sin[6], cos[6], no_sign, bit_one, bit_two;
};
extern const SinCosTable kSinCosTable;

// Of n angles, one by one: the way for lanes with rare angles.
void sin_cos_of_each(const double* x, int n, double* s, double* c);

// `run` is null where the kernel does not fit.
PlanarKernel planar_kernel_of(const Chain& chain);

// The same text for every processor and for those with 256-bit vectors; both give the same bits.
// along_x: all l and h lie along ex; turned: some sign is -1.
PlanarKernel::Run planar_kernel_for_any_processor(int joints, bool along_x, bool turned);
PlanarKernel::Run planar_kernel_for_avx2(int joints, bool along_x, bool turned);

}  // namespace chainreel
