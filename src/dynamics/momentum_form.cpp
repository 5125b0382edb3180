// v_i and I_i are the velocity and inertia of body i, S_j the motion of joint j, p(j) the parent of j, and
//
//   h_j = I_j v_j + sum of h_i over the children i of j        the momentum of all that joint j carries,
//   p_j = S_j . h_j                                            (R. Featherstone, Rigid Body Dynamics
//                                                              Algorithms, 2008, ch. 2.11 and 5.3).
//
// A change dq_j turns all that j carries against its parent. Seen from joint j's own body that is a change of
// the velocity handed on by the parent, dv_j = (v_p(j) x S_j) dq_j, which the whole subtree shares as one
// rigid body. T = 1/2 sum v_i . I_i v_i therefore changes by
//
//   dT/dq_j = (v_p(j) x S_j) . h_j = (v_j x S_j) . h_j         since S_j x S_j = 0.
//
// For a floating joint p are the six numbers of S_j . h_j along the body's own axes, and v_j x S_j stands as it
// is: what the joint's own twist adds, (S_k qd_k x S_j) . h_j, is no derivative of T but the turning of the axes
// along which p is counted (Euler's and Poincare's equations).
//
// tau_g = S_j . F_j, where F_j is what the weights of all that j carries press on it, taken as RNEA does: the
// world rises at -gravity.
//
// Chains of the planar kernel take absolute angles phi_i (dynamics/kernels/kernel_planar.hpp): with the momenta
// P_i = p_i - p_{i+1}, sum_j A_ij phi_j' = P_i and dT/dphi_i = sum_{j>i} dA_ij/dphi_i phi_i' phi_j'
// - sum_{j<i} dA_ji/dphi_j phi_i' phi_j'.
#include "dynamics/momentum_form.hpp"

#include <algorithm>
#include <limits>

#include "core/scalar.hpp"
#include "dynamics/algebra.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {
namespace {

// a of every body as the weights see it.
template <class A>
void lift(Links<A>& links) {
  links.a[0] = links.base_acceleration;
  for (std::size_t i = 1; i < links.size(); ++i)
    links.a[i] = A::to_child(links.X[i], links.a[links.joint[i].parent]);
}

// f <- h, p <- S . h
template <class A>
void momentum_of(Links<A>& links, ConstVec qd, Vec p) {
  move(links, qd);
  for (std::size_t i = 1; i < links.size(); ++i) links.f[i] = links.I[i] * links.v[i];
  std::fill(p.begin(), p.end(), 0.0);
  for (std::size_t i = links.size(); --i > 0;) {
    const auto& joint = links.joint[i];
    for (std::size_t k = 0; k < joint.freedoms; ++k)
      p[joint.v + k] += A::power(A::unit_motion(links.body[i], links.S[i], int(k)), links.f[i]);
    if (joint.parent > 0)
      links.f[joint.parent] = links.f[joint.parent] + A::to_parent(links.X[i], links.f[i]);
  }
}

// f <- h, pA <- F
template <class A>
void force_of(Links<A>& links, ConstVec qd, Vec p_dot) {
  auto& h = links.f;
  auto& F = links.pA;
  move(links, qd);
  lift(links);
  for (std::size_t i = 1; i < links.size(); ++i) {
    h[i] = links.I[i] * links.v[i];
    F[i] = links.I[i] * links.a[i];
  }
  std::fill(p_dot.begin(), p_dot.end(), 0.0);
  for (std::size_t i = links.size(); --i > 0;) {
    const auto& joint = links.joint[i];
    for (std::size_t k = 0; k < joint.freedoms; ++k) {
      const auto S = A::unit_motion(links.body[i], links.S[i], int(k));
      p_dot[joint.v + k] += A::power(A::cross_motion(links.v[i], S), h[i]) - A::power(S, F[i]);
    }
    if (joint.parent == 0) continue;
    h[joint.parent] = h[joint.parent] + A::to_parent(links.X[i], h[i]);
    F[joint.parent] = F[joint.parent] + A::to_parent(links.X[i], F[i]);
  }
}

}  // namespace

MomentumForm::MomentumForm(const Chain& chain)
    : ws_(chain),
      q_(std::size_t(chain.nq), std::numeric_limits<double>::quiet_NaN()),
      joints_(std::size_t(ws_.scratch->planar_kernel.joints)),
      factors_(chain.has_mimic),
      M_(factors_ ? std::size_t(chain.nv * chain.nv) : 0) {}

bool MomentumForm::is_new(ConstVec q) {
  if (std::equal(q.begin(), q.end(), q_.begin())) return false;
  std::copy(q.begin(), q.end(), q_.begin());
  return true;
}

template <std::size_t n>
[[gnu::flatten]] void MomentumForm::place_kernel(ConstVec q) {
  if (!is_new(q)) return;
  const PlanarKernel& kernel = ws_.scratch->planar_kernel;
  double U_x[kMax], U_y[kMax], H_x[kMax], H_y[kMax];
  double phi = 0;
  for (std::size_t i = 0; i < n; ++i) {
    phi += kernel.sign[i] * q[i];
    const auto [s, c] = sin_cos(phi);
    U_x[i] = kernel.l_x[i] * c - kernel.l_y[i] * s, U_y[i] = kernel.l_x[i] * s + kernel.l_y[i] * c;
    H_x[i] = kernel.h_x[i] * c - kernel.h_y[i] * s, H_y[i] = kernel.h_x[i] * s + kernel.h_y[i] * c;
    pull_[i] = kernel.pull_c[i] * c - kernel.pull_s[i] * s;
  }
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      A_[j][i] = A_[i][j] = U_x[i] * H_x[j] + U_y[i] * H_y[j];
      slope_[j][i] = U_x[i] * H_y[j] - U_y[i] * H_x[j];
      factor_[j * n + i] = A_[j][i];
    }
    A_[j][j] = factor_[j * n + j] = kernel.A_ii[j];
  }
  ldlt_factor(int(n), factor_);
}

void MomentumForm::place_links(ConstVec q) {
  if (!is_new(q)) return;
  has_factor_ = false;
  with_links(ws_, [&](auto& links) { place(links, q); });
}

template <std::size_t n>
[[gnu::flatten]] void MomentumForm::kernel_momentum(ConstVec q, ConstVec qd, Vec p) {
  place_kernel<n>(q);
  const auto& sign = ws_.scratch->planar_kernel.sign;
  double rate[n], behind = 0;
  for (std::size_t i = 0; i < n; ++i) rate[i] = (i > 0 ? rate[i - 1] : 0) + sign[i] * qd[i];
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = 0; j < n; ++j) behind += A_[i][j] * rate[j];
    p[i] = sign[i] * behind;
  }
}

template <std::size_t n>
[[gnu::flatten]] void MomentumForm::kernel_velocity(ConstVec q, ConstVec p, Vec qd) {
  place_kernel<n>(q);
  const auto& sign = ws_.scratch->planar_kernel.sign;
  double x[n];
  for (std::size_t i = 0; i < n; ++i) x[i] = sign[i] * p[i] - (i + 1 < n ? sign[i + 1] * p[i + 1] : 0);
  ldlt_solve(int(n), factor_, x);
  for (std::size_t i = 0; i < n; ++i) qd[i] = sign[i] * (i > 0 ? x[i] - x[i - 1] : x[i]);
}

template <std::size_t n>
[[gnu::flatten]] void MomentumForm::kernel_force(ConstVec q, ConstVec qd, Vec p_dot) {
  place_kernel<n>(q);
  const auto& sign = ws_.scratch->planar_kernel.sign;
  double rate[n], force[n], behind = 0;
  for (std::size_t j = 0; j < n; ++j) {
    rate[j] = (j > 0 ? rate[j - 1] : 0) + sign[j] * qd[j];
    force[j] = pull_[j];
    for (std::size_t i = 0; i < j; ++i) {
      const double pair = slope_[j][i] * (rate[i] * rate[j]);
      force[i] += pair;
      force[j] -= pair;
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    behind += force[i];
    p_dot[i] = sign[i] * behind;
  }
}

void MomentumForm::momentum(ConstVec q, ConstVec qd, Vec p) {
  switch (joints_) {
    case 1:
      return kernel_momentum<1>(q, qd, p);
    case 2:
      return kernel_momentum<2>(q, qd, p);
    case 3:
      return kernel_momentum<3>(q, qd, p);
    case 4:
      return kernel_momentum<4>(q, qd, p);
    default:
      place_links(q);
      with_links(ws_, [&](auto& links) { momentum_of(links, qd, p); });
  }
}

void MomentumForm::velocity(ConstVec q, ConstVec p, Vec qd) {
  switch (joints_) {
    case 1:
      return kernel_velocity<1>(q, p, qd);
    case 2:
      return kernel_velocity<2>(q, p, qd);
    case 3:
      return kernel_velocity<3>(q, p, qd);
    case 4:
      return kernel_velocity<4>(q, p, qd);
    default:
      return factors_ ? velocity_by_factor(q, p, qd) : velocity_by_bodies(q, p, qd);
  }
}

// At rest and without gravity qdd = M^-1 tau.
void MomentumForm::velocity_by_bodies(ConstVec q, ConstVec p, Vec qd) {
  place_links(q);
  with_links(ws_, [&](auto& links) { aba(links, {}, ConstVec(ws_.scratch->zeros), p, qd); });
}

void MomentumForm::velocity_by_factor(ConstVec q, ConstVec p, Vec qd) {
  place_links(q);
  if (!has_factor_) {
    with_links(ws_, [&](auto& links) { crba(links, p.size(), M_.data()); });
    ldlt_factor(int(p.size()), M_.data());
    has_factor_ = true;
  }
  std::copy(p.begin(), p.end(), qd.begin());
  ldlt_solve(int(p.size()), M_.data(), qd.data());
}

void MomentumForm::force(ConstVec q, ConstVec qd, Vec p_dot) {
  switch (joints_) {
    case 1:
      return kernel_force<1>(q, qd, p_dot);
    case 2:
      return kernel_force<2>(q, qd, p_dot);
    case 3:
      return kernel_force<3>(q, qd, p_dot);
    case 4:
      return kernel_force<4>(q, qd, p_dot);
    default:
      place_links(q);
      with_links(ws_, [&](auto& links) { force_of(links, qd, p_dot); });
  }
}

}  // namespace chainreel
