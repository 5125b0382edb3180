// The text of dynamics/kernel_planar.hpp, compiled once for every processor and once for those with 256-bit
// vectors. Included by those two files alone, behind their choice of processor; everything here is private to
// the file.
//
// No lambdas here: g++ 12 compiles them for the common processor. Nor does it define __AVX2__ behind the
// choice.
//
// Bits: each lane of a vector does what a scalar would, and no operation is fused or re-ordered, so that the
// width of the vectors does not show.
#pragma once

#include "core/scalar.hpp"
#include "dynamics/kernel_planar.hpp"

namespace chainreel {
namespace {

using Pack2 = double __attribute__((vector_size(16)));
using Pack4 = double __attribute__((vector_size(32)));
using Bits2 = std::uint64_t __attribute__((vector_size(16)));
using Bits4 = std::uint64_t __attribute__((vector_size(32)));

template <int n>
using PackOf = std::conditional_t<n <= 2, Pack2, Pack4>;
template <class Pack>
using BitsOf = std::conditional_t<sizeof(Pack) == 16, Bits2, Bits4>;

// These few are all that is not arithmetic. For common processors the compiler splits Pack4 in two by itself.
#ifdef CHAINREEL_WIDE_VECTORS
inline bool all_signs(const Pack2& x) {
  return __builtin_ia32_movmskpd(x) == 3;
}
inline bool all_signs(const Pack4& x) {
  return __builtin_ia32_movmskpd256(x) == 15;
}
// a where the highest bit of the mask is set, else b.
inline void choose(const Bits2& mask, const Pack2& a, const Pack2& b, Pack2& result) {
  result = __builtin_ia32_blendvpd(b, a, Pack2(mask));
}
inline void choose(const Bits4& mask, const Pack4& a, const Pack4& b, Pack4& result) {
  result = __builtin_ia32_blendvpd256(b, a, Pack4(mask));
}
#else
inline bool all_signs(const Pack2& x) {
  return __builtin_ia32_movmskpd(x) == 3;
}
inline bool all_signs(const Pack4& x) {
  return all_signs(__builtin_shufflevector(x, x, 0, 1)) && all_signs(__builtin_shufflevector(x, x, 2, 3));
}
template <class Pack>
inline void choose(const BitsOf<Pack>& mask, const Pack& a, const Pack& b, Pack& result) {
  const BitsOf<Pack> all = -(mask >> 63);
  result = Pack((BitsOf<Pack>(a) & all) | (BitsOf<Pack>(b) & ~all));
}
#endif

template <class Pack>
inline const Pack& load(const double* lanes) {
  return *reinterpret_cast<const Pack*>(lanes);
}

// sin_cos of core/scalar.hpp in each lane, operation by operation, and so with its bits; but the sine of -0
// is +0. One comparison finds every lane that might be rare, at the price of some that are not: |r| >= |k| /
// 2^19 fails for all |k| > 2^19, where the reduction ends, and for NaN.
template <class Pack>
inline void sin_cos_of(const Pack& x, Pack& s, Pack& c) {
  const SinCosTable& t = kSinCosTable;
  const Pack shifted = x * load<Pack>(t.two_over_pi) + load<Pack>(t.round_to_integer);
  const Pack k = shifted - load<Pack>(t.round_to_integer);
  const Pack r1 = x - k * load<Pack>(t.half_pi[0]);
  const Pack p2 = k * load<Pack>(t.half_pi[1]);
  const Pack p3 = k * load<Pack>(t.half_pi[2]);
  const Pack r2 = r1 - p2;
  const Pack r = r2 - p3;
  const Pack r_tail = ((r1 - r2) - p2) + ((r2 - r) - p3);
  const Pack size_r = Pack(BitsOf<Pack>(r) & BitsOf<Pack>(load<Pack>(t.no_sign)));
  const Pack size_k = Pack(BitsOf<Pack>(k) & BitsOf<Pack>(load<Pack>(t.no_sign)));
  if (!all_signs(Pack(size_r >= size_k * load<Pack>(t.rare)))) [[unlikely]] {
    sin_cos_of_each(reinterpret_cast<const double*>(&x), sizeof(Pack) / sizeof(double),
                    reinterpret_cast<double*>(&s), reinterpret_cast<double*>(&c));
    return;
  }

  const Pack z = r * r;
  const Pack z2 = z * z;
  const Pack P = (load<Pack>(t.sin[0]) + z * load<Pack>(t.sin[1])) +
                 z2 * ((load<Pack>(t.sin[2]) + z * load<Pack>(t.sin[3])) +
                       z2 * (load<Pack>(t.sin[4]) + z * load<Pack>(t.sin[5])));
  const Pack Q = (load<Pack>(t.cos[0]) + z * load<Pack>(t.cos[1])) +
                 z2 * ((load<Pack>(t.cos[2]) + z * load<Pack>(t.cos[3])) +
                       z2 * (load<Pack>(t.cos[4]) + z * load<Pack>(t.cos[5])));
  const Pack one = load<Pack>(t.one);
  const Pack half_z = z * load<Pack>(t.half);
  const Pack w = one - half_z;
  const Pack sine = r + (r * z * P + r_tail * w);
  const Pack cosine = w + (((one - w) - half_z) + (z2 * Q - r * r_tail));

  using Bits = BitsOf<Pack>;
  const Bits quadrant = Bits(shifted);
  const Bits two = Bits(load<Pack>(t.bit_two));
  const Bits sign_s = (quadrant & two) << 62;
  const Bits sign_c = ((quadrant + Bits(load<Pack>(t.bit_one))) & two) << 62;
  choose(quadrant << 63, cosine, sine, s);
  choose(quadrant << 63, sine, cosine, c);
  s = Pack(Bits(s) ^ sign_s);
  c = Pack(Bits(c) ^ sign_c);
}

// x <- A^-1 x of a symmetric positive definite matrix, lower half: L D L^T without its loops being loops.
template <int n>
inline void solve(const PlanarKernel& kernel, double (&A)[n][n], double (&x)[n]) {
  double D_inv[n];
#pragma GCC unroll 4
  for (int j = 0; j < n; ++j) {
    // L D of row j, then L
#pragma GCC unroll 4
    for (int k = 0; k < j; ++k) {
#pragma GCC unroll 4
      for (int i = 0; i < k; ++i) A[j][k] -= A[j][i] * A[k][i];
    }
#pragma GCC unroll 4
    for (int k = 0; k < j; ++k) {
      const double LD = A[j][k];
      A[j][k] = LD * D_inv[k];
      A[j][j] -= A[j][k] * LD;
      x[j] -= A[j][k] * x[k];
    }
    D_inv[j] = j == 0 ? kernel.A_11_inv : 1 / A[j][j];
  }
#pragma GCC unroll 4
  for (int i = n - 1; i >= 0; --i) {
    x[i] *= D_inv[i];
#pragma GCC unroll 4
    for (int k = i + 1; k < n; ++k) x[i] -= A[k][i] * x[k];
  }
}

// The same for two unknowns, by Cramer's rule: one division instead of two in a row.
inline void solve(const PlanarKernel& kernel, double (&A)[2][2], double (&x)[2]) {
  const double det_inv = 1 / (kernel.A_11_A_22 - A[1][0] * A[1][0]);
  const double x0 = A[1][1] * x[0] - A[1][0] * x[1];
  const double x1 = A[0][0] * x[1] - A[1][0] * x[0];
  x[0] = x0 * det_inv;
  x[1] = x1 * det_inv;
}

// Of a number along the joint's own axis.
template <bool kTurned>
inline double along_normal(const PlanarKernel& kernel, int i, double x) {
  return kTurned ? x * kernel.sign[std::size_t(i)] : x;
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

template <int n, bool kAlongX, bool kTurned>
void run_planar_kernel(const PlanarKernel& kernel, const double* q, const double* qd, const double* tau,
                       double* qdd) {
  using Pack = PackOf<n>;
  double angle[n], rate[n];  // absolute
  for (int i = 0; i < n; ++i) {
    angle[i] = along_normal<kTurned>(kernel, i, q[i]) + (i > 0 ? angle[i - 1] : 0);
    rate[i] = along_normal<kTurned>(kernel, i, qd[i]) + (i > 0 ? rate[i - 1] : 0);
  }

  Pack phi, s, c;
  fill_lanes<n>(angle, phi);
  sin_cos_of(phi, s, c);
  Pack U_x = load<Pack>(kernel.l_x.data()) * c, U_y = load<Pack>(kernel.l_x.data()) * s;
  Pack H_x = load<Pack>(kernel.h_x.data()) * c, H_y = load<Pack>(kernel.h_x.data()) * s;
  if (!kAlongX) {
    U_x -= load<Pack>(kernel.l_y.data()) * s, U_y += load<Pack>(kernel.l_y.data()) * c;
    H_x -= load<Pack>(kernel.h_y.data()) * s, H_y += load<Pack>(kernel.h_y.data()) * c;
  }
  const Pack pull = load<Pack>(kernel.g_y.data()) * H_x - load<Pack>(kernel.g_x.data()) * H_y;

  double A[n][n], x[n];
  for (int i = 0; i < n; ++i) {
    A[i][i] = kernel.A_ii[std::size_t(i)];
    const double handed_on = i + 1 < n ? along_normal<kTurned>(kernel, i + 1, tau[i + 1]) : 0;
    x[i] = (along_normal<kTurned>(kernel, i, tau[i]) - handed_on) + pull[i];
  }
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      A[j][i] = U_x[i] * H_x[j] + U_y[i] * H_y[j];
      const double slope = U_x[i] * H_y[j] - U_y[i] * H_x[j];
      x[i] += slope * (rate[j] * rate[j]);
      x[j] -= slope * (rate[i] * rate[i]);
    }
  }
  solve(kernel, A, x);
  for (int i = n - 1; i >= 0; --i) qdd[i] = along_normal<kTurned>(kernel, i, i == 0 ? x[0] : x[i] - x[i - 1]);
}

template <int n>
PlanarKernel::Run planar_kernel_for(bool along_x, bool turned) {
  if (along_x) return turned ? run_planar_kernel<n, true, true> : run_planar_kernel<n, true, false>;
  return turned ? run_planar_kernel<n, false, true> : run_planar_kernel<n, false, false>;
}

PlanarKernel::Run planar_kernel_for(int joints, bool along_x, bool turned) {
  switch (joints) {
    case 1:
      return planar_kernel_for<1>(along_x, turned);
    case 2:
      return planar_kernel_for<2>(along_x, turned);
    case 3:
      return planar_kernel_for<3>(along_x, turned);
    case 4:
      return planar_kernel_for<4>(along_x, turned);
    default:
      return nullptr;
  }
}

}  // namespace
}  // namespace chainreel
