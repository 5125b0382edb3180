// Constrained forward dynamics of a chain of two to four revolute joints that moves in a plane, with one to
// three different rows, in absolute angles: dynamics/kernel_planar.hpp has the chain's own equations A phi''
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

#include "dynamics/constrained_spatial.hpp"
#include "dynamics/constraint_set.hpp"
#include "dynamics/kernel_planar.hpp"

namespace chainreel {

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
