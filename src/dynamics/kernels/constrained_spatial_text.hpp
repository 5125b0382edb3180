// The text of dynamics/kernels/constrained_kernel.hpp, behind the choice of processor, as dynamics/kernels/kernel_packs.hpp
// is; private to the two files that include it.
#pragma once

#include "dynamics/constraints/constrained_workspace.hpp"
#include "dynamics/kernels/constrained_kernel.hpp"
#include "dynamics/kernels/kernel_spatial_text.hpp"
#include "dynamics/kernels/row_inverse_text.hpp"

namespace chainreel {
namespace {

inline double dot(const Vector& a, const Vector& b) {
  const Vector ab = a * b;
  return (ab[0] + ab[1]) + ab[2];
}

struct AnchorMotion {
  Vector p, v, a;  // from O; a for qdd = 0 and without gravity
};

inline AnchorMotion observe(const SpatialRows::Anchor& anchor, const Moving& body, const Vector& base) {
  AnchorMotion motion;
  motion.p = body.o + times(body.R, anchor.point);
  motion.v = body.v + cross(body.w, motion.p);
  motion.a = (body.a_v - base) + cross(body.a_w, motion.p) + cross(body.w, motion.v);
  return motion;
}

// A row's unit force on its first anchor, and its negative on the second.
struct RowForce {
  Vector f, n_a, n_b;
  double gamma;
};

inline RowForce force_of(const SpatialRows::Row& row, const AnchorMotion& a, const AnchorMotion& b) {
  RowForce force;
  if (row.rod) {
    const Vector d = a.p - b.p, dv = a.v - b.v;
    force.f = d * row.length_inv;
    force.gamma = (dot(d, a.a - b.a) + dot(dv, dv)) * row.length_inv;
  } else {
    force.f = load(row.direction);
    force.gamma = dot(force.f, a.a - b.a);
  }
  force.n_a = cross(a.p, force.f);
  force.n_b = cross(b.p, force.f);
  return force;
}

// Whether joint j (from 1 on) carries the body.
template <bool kSerial>
inline bool carries(const SpatialKernel& kernel, int j, int body) {
  if (kSerial) return j <= body;
  return body > 0 && kernel.masks[std::size_t(body - 1)].lanes[j] != 0;
}

// Lane k of C[i] is what joint i gives to row k, lane k of gamma its acceleration without that.
template <int kPacks, int m, bool kSerial>
[[gnu::always_inline]] inline void take_rows(const SpatialKernel& kernel, const SpatialRows& rows,
                                             const SpatialPass<kPacks>& pass, Vector (&C)[4 * kPacks],
                                             double (&gamma)[m]) {
  const Vector base = load(kernel.base_acceleration);
  AnchorMotion motion[2 * m];
  const int anchors = int(rows.anchors.size());
  for (int k = 0; k < anchors; ++k) {
    const SpatialRows::Anchor& anchor = rows.anchors[std::size_t(k)];
    motion[k] = observe(anchor, pass.body[anchor.body], base);
  }
  RowForce force[m];
  for (int k = 0; k < m; ++k) {
    const SpatialRows::Row& row = rows.row[std::size_t(k)];
    force[k] = force_of(row, motion[row.a], motion[row.b]);
    gamma[k] = force[k].gamma;
  }
  for (int j = 1; j <= kernel.joints; ++j) {
    const Axis& S = pass.S[j];
    Vector part[4] = {};
    for (int k = 0; k < m; ++k) {
      const SpatialRows::Row& row = rows.row[std::size_t(k)];
      const bool with_a = carries<kSerial>(kernel, j, rows.anchors[std::size_t(row.a)].body);
      const bool with_b = carries<kSerial>(kernel, j, rows.anchors[std::size_t(row.b)].body);
      if (with_a) part[k] = S.w * force[k].n_a + S.v * force[k].f;
      if (with_b) part[k] -= S.w * force[k].n_b + S.v * force[k].f;
    }
    C[j - 1] = sums_of(part[0], part[1], part[2], part[3]);
  }
}

// As `solve`, of all right-hand sides at once: lane 0 of the rows, and the lanes of B.
template <int kPacks>
[[gnu::always_inline]] inline void eliminate(int n, Pack4 (&row)[4 * kPacks][kPacks], Vector (&B)[4 * kPacks],
                                             double (&D_inv)[4 * kPacks]) {
  for (int k = n - 1; k >= 0; --k) {
    const double* const row_k = reinterpret_cast<const double*>(row[k]);
    D_inv[k] = 1 / row_k[k + 1];
    for (int i = 0; i < k; ++i) {
      const double factor = row_k[i + 1] * D_inv[k];
      B[i] -= B[k] * factor;
#pragma GCC unroll 4
      for (int g = 0; g < kPacks; ++g) {
        if (4 * g <= i + 1) row[i][g] -= row[k][g] * factor;
      }
    }
  }
}

// M x = -y, of an eliminated y.
template <int kPacks>
inline void substitute(int n, const Pack4 (&row)[4 * kPacks][kPacks], const double (&D_inv)[4 * kPacks],
                       const double (&y)[4 * kPacks], double* x) {
  for (int k = 0; k < n; ++k) {
    const double* const row_k = reinterpret_cast<const double*>(row[k]);
    double sum = y[k];
    for (int j = 0; j < k; ++j) sum += row_k[j + 1] * x[j];
    x[k] = -(sum * D_inv[k]);
  }
}

// r = C x + gamma; whether every row is within the tolerance of the sizes in it.
template <int m>
inline bool is_fulfilled(int n, const Vector* C, const double (&gamma)[m], const double* x, double tolerance,
                         double (&r)[m], double& residual) {
  double size[m];
  for (int k = 0; k < m; ++k) {
    r[k] = gamma[k];
    size[k] = absolute(gamma[k]);
  }
  for (int j = 0; j < n; ++j) {
    const Vector part = C[j] * x[j];
    for (int k = 0; k < m; ++k) {
      r[k] += part[k];
      size[k] += absolute(part[k]);
    }
  }
  bool good = true;
  residual = 0;
  for (int k = 0; k < m; ++k) {
    const double left = absolute(r[k]);
    good &= left <= tolerance * (1 + size[k]);  // false for what is no number
    residual = left > residual ? left : residual;
  }
  return good;
}

template <int kPacks, int m, bool kSerial, Angles kAngles = Angles::common>
[[gnu::noinline]] bool run_constrained_spatial(const Workspace& ws, ConstrainedWorkspace& cws, ConstVec q,
                                               ConstVec qd, ConstVec tau, double* qdd, double tolerance) {
  const SpatialKernel& kernel = ws.scratch->spatial_kernel;
  const int n = kernel.joints;
  SpatialPass<kPacks> pass;
  if (!sweep<kPacks, kSerial, kAngles>(kernel, q, qd, tau, pass)) [[unlikely]]
    return run_constrained_spatial<kPacks, m, kSerial, Angles::any>(ws, cws, q, qd, tau, qdd, tolerance);

  Vector C[4 * kPacks], B[4 * kPacks];
  double gamma[m], D_inv[4 * kPacks], y[4 * kPacks];
  take_rows<kPacks, m, kSerial>(kernel, cws.kernel.in_space, pass, C, gamma);
  for (int i = 0; i < n; ++i) B[i] = C[i];
  eliminate<kPacks>(n, pass.row, B, D_inv);

  Vector columns[m] = {}, free{};
  for (int k = 0; k < n; ++k) {
    y[k] = pass.row[k][0][0];
    const Vector solved = B[k] * D_inv[k];
    for (int l = 0; l < m; ++l) columns[l] += solved * B[k][l];
    free += solved * y[k];
  }
  double G[m][m], lambda[m];
  for (int k = 0; k < m; ++k) {
    for (int l = 0; l <= k; ++l) G[k][l] = columns[l][k];
    lambda[k] = gamma[k] - free[k];
  }
  RowInverse<m> inverse;
  if (!inverse.factor(G)) [[unlikely]]
    return false;
  inverse.solve(lambda);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < m; ++k) y[i] += B[i][k] * lambda[k];
  substitute<kPacks>(n, pass.row, D_inv, y, qdd);

  cws.passes = 1;
  double r[m];
  while (!is_fulfilled<m>(n, C, gamma, qdd, tolerance, r, cws.residual)) [[unlikely]] {
      if (++cws.passes > 4) return false;
      inverse.solve(r);
      double change[4 * kPacks];
      for (int i = 0; i < n; ++i) y[i] = 0;
      for (int k = 0; k < m; ++k) {
        lambda[k] += r[k];
        for (int i = 0; i < n; ++i) y[i] += B[i][k] * r[k];
      }
      substitute<kPacks>(n, pass.row, D_inv, y, change);
      for (int i = 0; i < n; ++i) qdd[i] += change[i];
    }
  hand_out<m>(cws, lambda);
  return true;
}

template <int kPacks, int m>
ConstrainedKernel::Run constrained_spatial_for(bool serial) {
  return serial ? run_constrained_spatial<kPacks, m, true> : run_constrained_spatial<kPacks, m, false>;
}
template <int kPacks>
ConstrainedKernel::Run constrained_spatial_for(int rows, bool serial) {
  if (rows == 1) return constrained_spatial_for<kPacks, 1>(serial);
  if (rows == 2) return constrained_spatial_for<kPacks, 2>(serial);
  return constrained_spatial_for<kPacks, 3>(serial);
}

ConstrainedKernel::Run constrained_spatial_for(const SpatialKernel& kernel, int rows) {
  switch (kernel.joints / 4) {
    case 0:
      return constrained_spatial_for<1>(rows, kernel.serial);
    case 1:
      return constrained_spatial_for<2>(rows, kernel.serial);
    case 2:
      return constrained_spatial_for<3>(rows, kernel.serial);
    default:
      return constrained_spatial_for<4>(rows, kernel.serial);
  }
}

}  // namespace
}  // namespace chainreel
