// The order of operations is that of kernel_planar_text.hpp and kernel_packs.hpp; a change there that moves a rounding
// has its twin here.
#include "dynamics/kernels/batch_planar.hpp"

#include "core/scalar.hpp"
#include "dynamics/kernels/kernel_packs.hpp"
#include "dynamics/kernels/small_solve.hpp"

namespace chainreel {
namespace {

using Lanes = double __attribute__((vector_size(16)));
using Bits = std::uint64_t __attribute__((vector_size(16)));

// A bit for each lane with a >= b; not for NaN.
inline unsigned lanes_not_below(const Lanes& a, const Lanes& b) {
  return unsigned(__builtin_ia32_movmskpd(Lanes(a >= b)));
}

// a in lanes with an odd k, else b.
inline Lanes odd_of(const Bits& k, const Lanes& a, const Lanes& b) {
  const Bits all = -(k & 1);
  return Lanes((Bits(a) & all) | (Bits(b) & ~all));
}

constexpr int kWidth = sizeof(Lanes) / sizeof(double);
constexpr unsigned kAllLanes = (1u << kWidth) - 1;

inline Lanes& at(PlanarBlock::Row& row, int column) {
  return *reinterpret_cast<Lanes*>(row + column * kWidth);
}

inline Lanes sized(const Lanes& x) {
  return Lanes(Bits(x) & (~std::uint64_t(0) >> 1));
}

// Sine and cosine of the lanes that are set in the answer; the others' angles are rare.
inline unsigned sin_cos_of_lanes(const Lanes& x, Lanes& s, Lanes& c) {
  using namespace detail;
  const Lanes shifted = x * kTwoOverPi + kRoundToInteger;
  const Lanes k = shifted - kRoundToInteger;
  const Lanes r = (x - k * kHalfPi1) - k * (kHalfPi2 + kHalfPi3);
  const unsigned common = lanes_not_below(sized(r), sized(k) * 0x1p-19);

  const Lanes z = r * r;
  const Lanes z2 = z * z;
  const Lanes z4 = z2 * z2;
  const Lanes P = ((kSin[0] + z * kSin[1]) + z2 * (kSin[2] + z * kSin[3])) + z4 * (kSin[4] + z * kSin[5]);
  const Lanes Q = ((kCos[0] + z * kCos[1]) + z2 * (kCos[2] + z * kCos[3])) + z4 * (kCos[4] + z * kCos[5]);
  const Lanes sine = r + r * z * P;
  const Lanes cosine = (1.0 - z * 0.5) + z2 * Q;

  // After k quarter turns: odd k exchanges the two, bit 1 of k turns the sine's sign, of k + 1 the cosine's.
  const Bits turns = Bits(shifted);
  const Bits sign_s = (turns & 2) << 62;
  s = odd_of(turns, cosine, sine);
  c = odd_of(turns, sine, cosine);
  s = Lanes(Bits(s) ^ sign_s);
  c = Lanes(Bits(c) ^ (sign_s ^ (turns << 63)));
  return common;
}

// A chain with one rare angle takes the scalar function for all its angles, as the scalar path does.
template <int n>
[[gnu::noinline, gnu::cold]] void sin_cos_of_rare_lanes(unsigned common, const Lanes* x, Lanes* s, Lanes* c) {
  for (int lane = 0; lane < kWidth; ++lane) {
    if (common & (1u << lane)) continue;
    for (int i = 0; i < n; ++i) {
      double angle = x[i][lane], sine, cosine;
      sin_cos_of_each(&angle, 1, &sine, &cosine);
      s[i][lane] = sine;
      c[i][lane] = cosine;
    }
  }
}

template <int n>
inline void sin_cos_of_chains(const Lanes (&angle)[n], Lanes (&s)[n], Lanes (&c)[n]) {
  unsigned common = kAllLanes;
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) common &= sin_cos_of_lanes(angle[i], s[i], c[i]);
  if (common == kAllLanes) [[likely]]
    return;
  // Copies, so that what is common stays in registers.
  Lanes x[n], sines[n], cosines[n];
  for (int i = 0; i < n; ++i) x[i] = angle[i], sines[i] = s[i], cosines[i] = c[i];
  sin_cos_of_rare_lanes<n>(common, x, sines, cosines);
  for (int i = 0; i < n; ++i) s[i] = sines[i], c[i] = cosines[i];
}

// A_ij and its slope U_i x H_j for i < j, at [j][i].
template <int n, bool kAlongX>
inline void couple(PlanarBlock& block, int column, const Lanes (&s)[n], const Lanes (&c)[n], Lanes (&A)[n][n],
                   Lanes (&slope)[n][n]) {
  if constexpr (n == 2 && kAlongX) {
    const Lanes& l_1_h_2 = at(block.l_1_h_2, column);
    A[1][0] = l_1_h_2 * (c[0] * c[1] + s[0] * s[1]);
    slope[1][0] = l_1_h_2 * (c[0] * s[1] - s[0] * c[1]);
  } else {
    Lanes U_x[n], U_y[n], H_x[n], H_y[n];
#pragma GCC unroll 4
    for (int i = 0; i < n; ++i) {
      U_x[i] = at(block.l_x[i], column) * c[i], U_y[i] = at(block.l_x[i], column) * s[i];
      H_x[i] = at(block.h_x[i], column) * c[i], H_y[i] = at(block.h_x[i], column) * s[i];
      if constexpr (!kAlongX) {
        U_x[i] -= at(block.l_y[i], column) * s[i], U_y[i] += at(block.l_y[i], column) * c[i];
        H_x[i] -= at(block.h_y[i], column) * s[i], H_y[i] += at(block.h_y[i], column) * c[i];
      }
    }
#pragma GCC unroll 4
    for (int i = 0; i < n; ++i) {
#pragma GCC unroll 4
      for (int j = i + 1; j < n; ++j) {
        A[j][i] = U_x[i] * H_x[j] + U_y[i] * H_y[j];
        slope[j][i] = U_x[i] * H_y[j] - U_y[i] * H_x[j];
      }
    }
  }
}

// From numbers along the joints' own axes to numbers along the plane's.
template <bool kTurned>
inline Lanes along_normal(PlanarBlock& block, int column, int i, const Lanes& x) {
  if constexpr (kTurned) {
    return x * at(block.sign[i], column);
  } else {
    return x;
  }
}

// v += h qdd, then q += h v with the new v.
template <int n, bool kAlongX, bool kTurned>
inline void step_lanes(PlanarBlock& block, int column) {
  Lanes angle[n], rate[n];  // absolute
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) {
    angle[i] = along_normal<kTurned>(block, column, i, at(block.q[i], column));
    rate[i] = along_normal<kTurned>(block, column, i, at(block.qd[i], column));
    if (i > 0) angle[i] += angle[i - 1], rate[i] += rate[i - 1];
  }

  Lanes s[n], c[n], A[n][n], slope[n][n], x[n];
  sin_cos_of_chains<n>(angle, s, c);
  couple<n, kAlongX>(block, column, s, c, A, slope);

#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) {
    A[i][i] = at(block.A_ii[i], column);
    Lanes pull = at(block.pull_c[i], column) * c[i];
    if constexpr (!kAlongX) pull -= at(block.pull_s[i], column) * s[i];
    x[i] = at(block.Q[i], column) + pull;
  }
  add_rate_terms<n>(slope, rate, x);
  const Lanes one = {1, 1};
  solve_small<n>(one, at(block.A_11_inv, column), at(block.A_11_A_22, column), A, x);

  const Lanes h = at(block.h, column);
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) {
    const Lanes qdd = along_normal<kTurned>(block, column, i, i == 0 ? x[0] : x[i] - x[i - 1]);
    const Lanes qd = at(block.qd[i], column) + h * qdd;
    at(block.qd[i], column) = qd;
    at(block.q[i], column) += h * qd;
  }
}

template <int n, bool kAlongX, bool kTurned>
void step_planar_blocks(PlanarBlock* blocks, int count, long steps) {
  for (long step = 0; step < steps; ++step)
    for (int b = 0; b < count; ++b)
      for (int column = 0; column < PlanarBlock::kLanes / kWidth; ++column)
        step_lanes<n, kAlongX, kTurned>(blocks[b], column);
}

template <int n>
StepPlanarBlocks planar_batch_of(const PlanarKernel& kernel) {
  if (kernel.along_x)
    return kernel.turned ? step_planar_blocks<n, true, true> : step_planar_blocks<n, true, false>;
  return kernel.turned ? step_planar_blocks<n, false, true> : step_planar_blocks<n, false, false>;
}

StepPlanarBlocks planar_batch_of(const PlanarKernel& kernel) {
  switch (kernel.joints) {
    case 1:
      return planar_batch_of<1>(kernel);
    case 2:
      return planar_batch_of<2>(kernel);
    case 3:
      return planar_batch_of<3>(kernel);
    default:
      return planar_batch_of<4>(kernel);
  }
}

}  // namespace

bool are_alike(const PlanarKernel& a, const PlanarKernel& b) {
  return a.joints == b.joints && a.along_x == b.along_x && a.turned == b.turned;
}

void set_lane_chain(PlanarBlock& block, int lane, const PlanarKernel& kernel) {
  for (std::size_t i = 0; i < std::size_t(kernel.joints); ++i) {
    block.A_ii[i][lane] = kernel.A_ii[i];
    block.pull_c[i][lane] = kernel.pull_c[i];
    block.pull_s[i][lane] = kernel.pull_s[i];
    block.l_x[i][lane] = kernel.l_x[i];
    block.l_y[i][lane] = kernel.l_y[i];
    block.h_x[i][lane] = kernel.h_x[i];
    block.h_y[i][lane] = kernel.h_y[i];
    block.sign[i][lane] = kernel.sign[i];
  }
  block.A_11_inv[lane] = kernel.A_11_inv;
  block.A_11_A_22[lane] = kernel.A_11_A_22;
  block.l_1_h_2[lane] = kernel.l_1_h_2;
}

void set_lane_torque(PlanarBlock& block, int lane, int joints, const double* tau) {
  for (int i = 0; i < joints; ++i) {
    const double handed_on = i + 1 < joints ? tau[i + 1] * block.sign[i + 1][lane] : 0;
    block.Q[i][lane] = tau[i] * block.sign[i][lane] - handed_on;
  }
}

StepPlanarBlocks planar_batch_for(const PlanarKernel& kernel) {
  return planar_batch_of(kernel);
}

}  // namespace chainreel
