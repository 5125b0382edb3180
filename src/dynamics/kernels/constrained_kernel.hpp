// Constrained forward dynamics of a chain of two to four revolute joints that moves in a plane, with one to
// three different rows, in absolute angles: dynamics/kernels/kernel_planar.hpp has the chain's own equations A phi''
// = b.
//
// The place of a frame is a sum of vectors R_i r_i, one a link, and so is the difference d of two: with
// (X_i, Y_i) = R_i r_i, absolute rates w_i, and e, L constant,
//
//   row along e     C_i = e x .. = e_y X_i - e_x Y_i          gamma = - sum (e_x X_i + e_y Y_i) w_i^2
//   row of a rod    C_i = (d_y X_i - d_x Y_i) / L             gamma = (d . d''(phi'' = 0) + |d'|^2) / L
//
// With links eliminated from the first on, F_k the eliminated rows, G = sum of F_k F_l / D and
// lambda = G^-1 (C A^-1 b + gamma) cost no further division but those of G.
//
// Chains in space take constrained_spatial.hpp.
//
// A row that was asked for several times is computed once, and its multiplier shared out evenly: that is the
// shortest one. All else that is not regular is left to the general way.
#pragma once

#include <array>
#include <vector>

#include "dynamics/constraints/constraint_set.hpp"
#include "dynamics/kernels/kernel_planar.hpp"
#include "dynamics/kernels/kernel_spatial.hpp"

namespace chainreel {

// Constrained forward dynamics of a chain or tree of up to 15 joints in space, with one to three different
// rows: dynamics/kernels/kernel_spatial.hpp has the chain's own equations, all vectors about one point O.
//
//   row along e     f = e        gamma = e.(a_a - a_b)                            a at qdd = 0
//   row of a rod    f = d / L    gamma = (d.(a_a - a_b) + |v_a - v_b|^2) / L      d = p_a - p_b
//   C_j = S_j . (p_a x f - p_b x f, f - f) over the anchors that joint j carries
//
// The rows ride through the elimination of M = L^T D L in the lanes of one vector, F = L^-T C^T, so that
// G = F^T D^-1 F and lambda = G^-1 (C qdd_free + gamma) cost no further solution with M.

struct SpatialRows {
  struct Anchor {
    int body = 0;                                 // 0: the world
    alignas(32) SpatialKernel::Lanes point[3]{};  // in the kernel's axes of the body, each in all lanes

    bool operator==(const Anchor&) const = default;
  };
  struct Row {
    int a = 0, b = 0;  // anchors
    bool rod = false;
    alignas(32) SpatialKernel::Lanes direction{};
    double length_inv = 0;

    bool operator==(const Row&) const = default;
  };
  std::vector<Anchor> anchors;
  std::array<Row, 3> row;
};

struct ConstrainedWorkspace;

struct ConstrainedKernel {
  static constexpr int kMostRows = 3;
  using PerLink = PlanarKernel::PerLink;

  struct Row {
    // Along: C = a cos + b sin and gamma = sum (b cos - a sin) w^2. Rod: r_x, r_y.
    alignas(32) PerLink a{}, b{};
    bool rod = false;
    double d_x = 0, d_y = 0, length_inv = 0;  // rod: what of d is constant

    bool operator==(const Row&) const = default;
  };
  std::array<Row, kMostRows> row;
  SpatialRows in_space;                   // of chains in space, in place of `row`
  int rows = 0;                           // different ones; 0: chain or constraints are of another kind
  std::vector<int> group;                 // of each row of the set, its place in `row`
  std::array<double, kMostRows> share{};  // 1 / how many rows of the set are this one
  bool doubled = false;

  // tau less friction. Writes qdd and the results in cws; false where the general way must be taken.
  using Run = bool (*)(const Workspace& ws, ConstrainedWorkspace& cws, ConstVec q, ConstVec qd, ConstVec tau,
                       double* qdd, double tolerance);
  Run run = nullptr;
};

ConstrainedKernel constrained_kernel_of(const Chain& chain, const ConstraintSet& set);

// The unrolled text for so many joints and rows; null where there is none.
ConstrainedKernel::Run constrained_run(const PlanarKernel& kernel, int rows);
ConstrainedKernel::Run constrained_run(const SpatialKernel& kernel, int rows);

}  // namespace chainreel
