// The text of dynamics/kernels/kernel_spatial.hpp. Included as kernel_packs.hpp is, and private to the files
// that include it.
#pragma once

#include "dynamics/kernels/kernel_packs.hpp"
#include "dynamics/kernels/kernel_spatial.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {
namespace {

// A 3-vector; its last lane is zero.
using Vector = Pack4;

inline const Vector& load(const SpatialKernel::Lanes& lanes) {
  return load<Pack4>(lanes.data());
}

inline Vector cross(const Vector& a, const Vector& b) {
  return turned_lanes(a * turned_lanes(b) - turned_lanes(a) * b);
}

// Column by column.
struct Matrix {
  Vector c0, c1, c2;
};

// A v
inline Vector times(const Matrix& A, const Vector& v) {
  return A.c0 * lane<0>(v) + A.c1 * lane<1>(v) + A.c2 * lane<2>(v);
}

// A k, of a column of constants
inline Vector times(const Matrix& A, const SpatialKernel::Lanes (&k)[3]) {
  return A.c0 * load(k[0]) + A.c1 * load(k[1]) + A.c2 * load(k[2]);
}

// Motion of the joint for a unit rate, about O.
struct Axis {
  Vector w, v;
};

struct Moving {
  Matrix R;
  Vector o, w, v, a_w, a_v;
};

// What a body has, then what all have that it carries.
struct Carried {
  Matrix I;  // about O
  Vector h;  // mass times centre of mass
  Vector m;  // in all lanes
  Vector N, F;
};

inline void place(const SpatialKernel::Link& link, const Moving& parent, double q, double s, double c,
                  Moving& body, Axis& S) {
  const Vector U = times(parent.R, link.T[0]);
  const Vector V = times(parent.R, link.T[1]);
  const Vector z = times(parent.R, link.T[2]);
  body.o = parent.o + times(parent.R, link.p);
  body.R.c2 = z;
  if (link.slides) {
    body.R.c0 = U;
    body.R.c1 = V;
    body.o += z * q;
    S.w = Vector{};
    S.v = z;
  } else {
    body.R.c0 = U * c + V * s;
    body.R.c1 = V * c - U * s;
    S.w = z;
    S.v = cross(body.o, z);
  }
}

inline void move(const Moving& parent, const Axis& S, double qd, Moving& body) {
  body.w = parent.w + S.w * qd;
  body.v = parent.v + S.v * qd;
  body.a_w = parent.a_w + cross(parent.w, S.w) * qd;
  body.a_v = parent.a_v + (cross(parent.w, S.v) + cross(parent.v, S.w)) * qd;
}

// (d 1 - h c^T) is Steiner's part of the inertia.
inline void weigh(const SpatialKernel::Link& link, const Moving& body, Carried& carried) {
  const Matrix RI{times(body.R, link.I[0]), times(body.R, link.I[1]), times(body.R, link.I[2])};
  const Matrix& R = body.R;
  const Matrix I{RI.c0 * lane<0>(R.c0) + RI.c1 * lane<0>(R.c1) + RI.c2 * lane<0>(R.c2),
                 RI.c0 * lane<1>(R.c0) + RI.c1 * lane<1>(R.c1) + RI.c2 * lane<1>(R.c2),
                 RI.c0 * lane<2>(R.c0) + RI.c1 * lane<2>(R.c1) + RI.c2 * lane<2>(R.c2)};

  const Vector c = body.o + times(R, link.com);
  const Vector v_c = body.v + cross(body.w, c);
  const Vector a_c = body.a_v + cross(body.a_w, c) + cross(body.w, v_c);
  carried.F = load(link.mass) * a_c;
  carried.N = times(I, body.a_w) + cross(body.w, times(I, body.w)) + cross(c, carried.F);

  carried.m = load(link.mass);
  carried.h = carried.m * c;
  const Vector hc = carried.h * c;
  const double d = (hc[0] + hc[1]) + hc[2];
  carried.I.c0 = I.c0 + (Vector{d, 0, 0, 0} - carried.h * lane<0>(c));
  carried.I.c1 = I.c1 + (Vector{0, d, 0, 0} - carried.h * lane<1>(c));
  carried.I.c2 = I.c2 + (Vector{0, 0, d, 0} - carried.h * lane<2>(c));
}

inline void add(const Carried& part, Carried& sum) {
  sum.I.c0 += part.I.c0;
  sum.I.c1 += part.I.c1;
  sum.I.c2 += part.I.c2;
  sum.h += part.h;
  sum.m += part.m;
  sum.N += part.N;
  sum.F += part.F;
}

// Row i of the mass matrix from lane 1 on, behind its part of nle - tau. Lanes above i + 1 hold nothing of
// use.
template <int kPacks>
inline void fill_row(const Axis* S, const Carried& carried, int i, double tau, Pack4 (&row)[kPacks]) {
  const Axis& Si = S[i + 1];
  const Vector n = times(carried.I, Si.w) + cross(carried.h, Si.v);
  const Vector f = carried.m * Si.v - cross(carried.h, Si.w);
#pragma GCC unroll 4
  for (int g = 0; g < kPacks; ++g) {
    if (4 * g > i + 1) break;
    const Axis* Sj = S + 4 * g;
    Vector first;
    if (g == 0) {
      first = Si.w * carried.N + Si.v * carried.F;
    } else {
      first = Sj[0].w * n + Sj[0].v * f;
    }
    row[g] = sums_of(first, Sj[1].w * n + Sj[1].v * f, Sj[2].w * n + Sj[2].v * f, Sj[3].w * n + Sj[3].v * f);
  }
  row[0] -= Pack4{tau, 0, 0, 0};
}

// The links are eliminated from the last one on, which fills no zero of a tree; then the accelerations follow
// from the first one on: M qdd = -(nle - tau).
template <int kPacks>
inline void solve(int n, Pack4 (&row)[4 * kPacks][kPacks], double* qdd) {
  double D_inv[4 * kPacks];
  for (int k = n - 1; k >= 0; --k) {
    const double* const row_k = reinterpret_cast<const double*>(row[k]);
    D_inv[k] = 1 / row_k[k + 1];
    for (int i = 0; i < k; ++i) {
      const double factor = row_k[i + 1] * D_inv[k];
#pragma GCC unroll 4
      for (int g = 0; g < kPacks; ++g) {
        if (4 * g <= i + 1) row[i][g] -= row[k][g] * factor;
      }
    }
  }
  for (int k = 0; k < n; ++k) {
    const double* const row_k = reinterpret_cast<const double*>(row[k]);
    double sum = row_k[0];
    for (int j = 0; j < k; ++j) sum += row_k[j + 1] * qdd[j];
    qdd[k] = -(sum * D_inv[k]);
  }
}

// All that comes before the elimination.
template <int kPacks>
struct SpatialPass {
  Moving body[4 * kPacks];  // [0] is the world
  Axis S[4 * kPacks];       // [0] is free; those behind the last joint fill lanes that nobody reads
  Carried carried[4 * kPacks];
  Pack4 row[4 * kPacks][kPacks];
};

// False for angles that are not common, where these were asked for alone.
template <int kPacks, bool kSerial, Angles kAngles>
[[gnu::always_inline]] inline bool sweep(const SpatialKernel& kernel, ConstVec q, ConstVec qd, ConstVec tau,
                                         SpatialPass<kPacks>& pass) {
  const int n = kernel.joints;
  alignas(32) double angle[4 * kPacks], s[4 * kPacks], c[4 * kPacks];
  for (int i = 0; i < n; ++i) angle[i] = kernel.links[std::size_t(i)].slides ? 0 : q[std::size_t(i)];
  for (int i = n; i < 4 * kPacks; ++i) angle[i] = 0;
  for (int g = 0; g < kPacks; ++g) {
    const Pack4& x = load<Pack4>(angle + 4 * g);
    Pack4& sines = *reinterpret_cast<Pack4*>(s + 4 * g);
    Pack4& cosines = *reinterpret_cast<Pack4*>(c + 4 * g);
    if constexpr (kAngles == Angles::any) {
      sin_cos_of_any(x, sines, cosines);
    } else if (!sin_cos_of_common(x, sines, cosines)) [[unlikely]] {
      return false;
    }
  }

  Moving(&body)[4 * kPacks] = pass.body;
  for (int i = n + 1; i < 4 * kPacks; ++i) pass.S[i] = Axis{};
  const Vector zero{};
  body[0].R = {Vector{1, 0, 0, 0}, Vector{0, 1, 0, 0}, Vector{0, 0, 1, 0}};
  const SpatialKernel::Link& first = kernel.links[0];
  body[0].o = zero - times(body[0].R, first.p);
  if (first.slides) body[0].o -= times(body[0].R, first.T[2]) * q[0];
  body[0].w = body[0].v = body[0].a_w = zero;
  body[0].a_v = load(kernel.base_acceleration);
  for (int i = 0; i < n; ++i) {
    const auto at = std::size_t(i);
    const SpatialKernel::Link& link = kernel.links[at];
    const Moving& parent = body[kSerial ? i : link.parent + 1];
    place(link, parent, q[at], s[i], c[i], body[i + 1], pass.S[i + 1]);
    move(parent, pass.S[i + 1], qd[at], body[i + 1]);
    weigh(link, body[i + 1], pass.carried[i]);
  }

  for (int i = n - 1; i >= 0; --i) {
    const auto at = std::size_t(i);
    fill_row<kPacks>(pass.S, pass.carried[i], i, tau[at], pass.row[i]);
    const int parent = kSerial ? i - 1 : kernel.links[at].parent;
    if (parent >= 0) add(pass.carried[i], pass.carried[parent]);
    if (!kSerial) {
      for (int g = 0; g < kPacks; ++g)
        pass.row[i][g] = masked(pass.row[i][g], kernel.masks[at].lanes + 4 * g);
    }
  }
  return true;
}

template <int kPacks, bool kSerial, Angles kAngles = Angles::common>
[[gnu::noinline]] void run_spatial_kernel(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd,
                                          ConstVec tau, double* qdd) {
  const SpatialKernel& kernel = ws.scratch->spatial_kernel;
  SpatialPass<kPacks> pass;
  if (!sweep<kPacks, kSerial, kAngles>(kernel, q, qd, tau, pass)) [[unlikely]]
    return run_spatial_kernel<kPacks, kSerial, Angles::any>(chain, ws, q, qd, tau, qdd);
  solve<kPacks>(kernel.joints, pass.row, qdd);
}

template <int kPacks>
ForwardDynamics spatial_kernel_for_packs(const SpatialKernel& kernel) {
  return kernel.serial ? run_spatial_kernel<kPacks, true> : run_spatial_kernel<kPacks, false>;
}

[[maybe_unused]] ForwardDynamics spatial_kernel_for(const SpatialKernel& kernel) {
  switch (kernel.joints / 4) {
    case 0:
      return spatial_kernel_for_packs<1>(kernel);
    case 1:
      return spatial_kernel_for_packs<2>(kernel);
    case 2:
      return spatial_kernel_for_packs<3>(kernel);
    default:
      return spatial_kernel_for_packs<4>(kernel);
  }
}

}  // namespace
}  // namespace chainreel
