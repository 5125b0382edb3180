// The text of dynamics/kernels/kernel_planar.hpp. Included as kernel_packs.hpp is, and private to the same two files.
#pragma once

#include "dynamics/kernels/kernel_packs.hpp"
#include "dynamics/kernels/kernel_planar.hpp"
#include "dynamics/kernels/small_solve.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {
namespace {

template <int n>
using PackOf = std::conditional_t<n <= 2, Pack2, Pack4>;

// From a number along the joint's own axis to one along the plane's.
template <bool kTurned>
inline double along_normal(const PlanarKernel& kernel, int i, double x) {
  return kTurned ? x * kernel.sign[std::size_t(i)] : x;
}

// Angles and rates of the links against the world.
template <int n, bool kTurned>
[[gnu::always_inline]] inline void make_absolute(const PlanarKernel& kernel, ConstVec q, ConstVec qd,
                                                 double (&angle)[n], double (&rate)[n]) {
  for (int i = 0; i < n; ++i) {
    angle[i] = along_normal<kTurned>(kernel, i, q[i]);
    rate[i] = along_normal<kTurned>(kernel, i, qd[i]);
    if (i > 0) angle[i] += angle[i - 1], rate[i] += rate[i - 1];
  }
}

// Torques on the links: a joint's own less what it hands on, and gravity's pull.
template <int n, bool kTurned>
[[gnu::always_inline]] inline void take_torques(const PlanarKernel& kernel, ConstVec tau, const PackOf<n>& pull,
                                                double (&x)[n]) {
  for (int i = 0; i < n; ++i) {
    const double handed_on = i + 1 < n ? along_normal<kTurned>(kernel, i + 1, tau[i + 1]) : 0;
    x[i] = (along_normal<kTurned>(kernel, i, tau[i]) - handed_on) + pull[i];
  }
}

// Lanes without a joint repeat the last angle.
template <int n>
inline void fill_lanes(const double (&x)[n], PackOf<n>& lanes) {
  if constexpr (n <= 2) {
    lanes = Pack2{x[0], x[n - 1]};
  } else {
    lanes = Pack4{x[0], x[1], x[2], x[n - 1]};
  }
}

// The coupling of links i < j: A_ij, and its slope U_i x H_j.
template <int n>
struct Couplings {
  double A[n][n], slope[n][n];
};

template <int n, bool kAlongX>
inline void couple(const PlanarKernel& kernel, const PackOf<n>& s, const PackOf<n>& c,
                   Couplings<n>& couplings) {
  using Pack = PackOf<n>;
  Pack U_x = load<Pack>(kernel.l_x.data()) * c, U_y = load<Pack>(kernel.l_x.data()) * s;
  Pack H_x = load<Pack>(kernel.h_x.data()) * c, H_y = load<Pack>(kernel.h_x.data()) * s;
  if (!kAlongX) {
    U_x -= load<Pack>(kernel.l_y.data()) * s, U_y += load<Pack>(kernel.l_y.data()) * c;
    H_x -= load<Pack>(kernel.h_y.data()) * s, H_y += load<Pack>(kernel.h_y.data()) * c;
  }
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      couplings.A[j][i] = U_x[i] * H_x[j] + U_y[i] * H_y[j];
      couplings.slope[j][i] = U_x[i] * H_y[j] - U_y[i] * H_x[j];
    }
  }
}

// Two links along ex need only their product.
template <>
inline void couple<2, true>(const PlanarKernel& kernel, const Pack2& s, const Pack2& c,
                            Couplings<2>& couplings) {
  couplings.A[1][0] = kernel.l_1_h_2 * (c[0] * c[1] + s[0] * s[1]);
  couplings.slope[1][0] = kernel.l_1_h_2 * (c[0] * s[1] - s[0] * c[1]);
}

// kAlongX: all links lie along ex and gravity along ey. Rare angles start anew with the careful way, as a
// last call: what is common then needs no stack.
template <int n, bool kAlongX, bool kTurned, Angles kAngles = Angles::common>
[[gnu::noinline]] void run_planar_kernel(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd,
                                         ConstVec tau, double* qdd) {
  using Pack = PackOf<n>;
  const PlanarKernel& kernel = ws.scratch->planar_kernel;
  double angle[n], rate[n];
  make_absolute<n, kTurned>(kernel, q, qd, angle, rate);

  Pack phi, s, c;
  fill_lanes<n>(angle, phi);
  if constexpr (kAngles == Angles::any) {
    sin_cos_of_any(phi, s, c);
  } else if (!sin_cos_of_common(phi, s, c)) [[unlikely]] {
    return run_planar_kernel<n, kAlongX, kTurned, Angles::any>(chain, ws, q, qd, tau, qdd);
  }
  Pack pull = load<Pack>(kernel.pull_c.data()) * c;
  if (!kAlongX) pull -= load<Pack>(kernel.pull_s.data()) * s;
  Couplings<n> couplings;
  couple<n, kAlongX>(kernel, s, c, couplings);

  auto& A = couplings.A;
  double x[n];
  take_torques<n, kTurned>(kernel, tau, pull, x);
  for (int i = 0; i < n; ++i) A[i][i] = kernel.A_ii[std::size_t(i)];
  add_rate_terms<n>(couplings.slope, rate, x);
  solve_small<n>(kSinCosTable.one[0], kernel.A_11_inv, kernel.A_11_A_22, A, x);
  for (int i = n - 1; i >= 0; --i) {
    qdd[i] = along_normal<kTurned>(kernel, i, i == 0 ? x[0] : x[i] - x[i - 1]);
  }
}

template <int n>
ForwardDynamics planar_kernel_for(bool along_x, bool turned) {
  if (along_x) return turned ? run_planar_kernel<n, true, true> : run_planar_kernel<n, true, false>;
  return turned ? run_planar_kernel<n, false, true> : run_planar_kernel<n, false, false>;
}

[[maybe_unused]] ForwardDynamics planar_kernel_for(const PlanarKernel& kernel) {
  switch (kernel.joints) {
    case 1:
      return planar_kernel_for<1>(kernel.along_x, kernel.turned);
    case 2:
      return planar_kernel_for<2>(kernel.along_x, kernel.turned);
    case 3:
      return planar_kernel_for<3>(kernel.along_x, kernel.turned);
    default:
      return planar_kernel_for<4>(kernel.along_x, kernel.turned);
  }
}

}  // namespace
}  // namespace chainreel
