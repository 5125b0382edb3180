#include "dynamics/constraints/constraint_projection.hpp"

#include <algorithm>

#include "core/scalar.hpp"
#include "dynamics/constraints/constrained_mass.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "dynamics/kinematics.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

// The round-off of the numbers phi is made of: metres of a chain, radians of a turn.
constexpr double kPositionRoundOff = 4e-16;
constexpr int kMostPasses = 60;

// M and the rows' system at q; the rows are written already. The articulated inertias overwrite velocities.
void prepare_rows(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws, ConstVec q) {
  factor_mass(chain, ws, cws, q);
  compute_row_system(chain, ws, cws);
}

// change = -Z^T lambda
void write_change(const ConstrainedWorkspace& cws, Vec change) {
  std::fill(change.begin(), change.end(), 0.0);
  for (std::size_t i = 0; i < cws.dlambda.size(); ++i) {
    for (std::size_t v = 0; v < change.size(); ++v)
      change[v] -= cws.Z[i * change.size() + v] * cws.dlambda[i];
  }
}

struct Worst {
  double size = 0;
  int row = 0;
};
Worst worst_of(const std::vector<double>& phi) {
  Worst worst;
  for (std::size_t i = 0; i < phi.size(); ++i)
    if (!(absolute(phi[i]) <= worst.size)) worst = {absolute(phi[i]), int(i)};
  return worst;
}

// What round-off leaves of phi: by the size of the places and lengths in it.
double round_off_of(const ConstraintSet& set, const ConstrainedWorkspace& cws) {
  double size = 1;
  for (const auto& state : cws.anchor_states)
    size = std::max({size, absolute(state.p.x), absolute(state.p.y), absolute(state.p.z)});
  for (const auto& row : set.row_list()) size = std::max(size, absolute(row.offset));
  return kPositionRoundOff * size;
}

}  // namespace

Projection project_positions(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                             ConstrainedWorkspace& cws, Vec q) {
  Projection result;
  const ConstVec zeros = ws.scratch->zeros;
  compute_constraints(chain, ws, set, cws, q, zeros);
  Worst worst = worst_of(cws.phi);
  result.before = worst.size;
  result.worst_row = worst.row;
  double shrink = 1;  // of the step: halved where a whole one leads away
  std::vector<double>& change = cws.dq;
  while (result.passes < kMostPasses && worst.size > round_off_of(set, cws) && shrink > 1e-4) {
    prepare_rows(chain, ws, cws, q);
    cws.solver.solve(cws.phi.data(), cws.dlambda.data());
    write_change(cws, change);
    ++result.passes;
    Worst next;
    for (;;) {
      advance(chain, q, change, shrink);
      compute_constraints(chain, ws, set, cws, q, zeros);
      next = worst_of(cws.phi);
      if (next.size < worst.size || !(shrink > 1e-4)) break;
      advance(chain, q, change, -shrink);
      // Below this a step that gains nothing is round-off, not a valley missed.
      if (worst.size < 64 * round_off_of(set, cws)) break;
      shrink /= 2;
    }
    const bool gained = next.size < worst.size;
    if (gained) {
      for (const double x : change) result.moved = std::max(result.moved, shrink * absolute(x));
      worst = next;
      shrink = std::min(1.0, 2 * shrink);
    } else {
      break;
    }
  }
  normalize(chain, q);
  compute_constraints(chain, ws, set, cws, q, zeros);
  worst = worst_of(cws.phi);
  result.after = worst.size;
  result.reached = worst.size <= 64 * round_off_of(set, cws);
  if (!result.reached) result.worst_row = worst.row;
  return result;
}

double project_velocities(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                          ConstrainedWorkspace& cws, ConstVec q, Vec qd) {
  compute_constraints(chain, ws, set, cws, q, qd);
  prepare_rows(chain, ws, cws, q);
  double before = 0;
  // A second time for the round-off that the condition of G magnifies.
  for (int times = 0; times < 2; ++times) {
    for (std::size_t i = 0; i < cws.r.size(); ++i) {
      double rate = 0;
      for (std::size_t v = 0; v < qd.size(); ++v) rate += cws.Jc[i * qd.size() + v] * qd[v];
      cws.r[i] = rate;
      if (times == 0) before = std::max(before, absolute(rate));
    }
    cws.solver.solve(cws.r.data(), cws.dlambda.data());
    write_change(cws, cws.dq);
    for (std::size_t v = 0; v < qd.size(); ++v) qd[v] += cws.dq[v];
  }
  return before;
}

}  // namespace chainreel
