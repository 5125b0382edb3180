#include "dynamics/constrained_effective_mass.hpp"

#include "dynamics/constrained_mass.hpp"
#include "dynamics/constraint_rows.hpp"
#include "core/dense.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Without constraints, as a scale; and with them.
struct Mobilities {
  double free = 0;
  Eigen::MatrixXd Lambda_inv;
};

Mobilities mobilities_of(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws) {
  const Eigen::Index rows = ws.J.rows();
  Eigen::MatrixXd M_inv_Jt(chain.nv, rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    Eigen::VectorXd column = ws.J.row(r);
    solve_mass(chain, ws, cws, column.data(), column.data());
    M_inv_Jt.col(r) = column;
  }
  Mobilities result;
  result.Lambda_inv = product(ws.J, M_inv_Jt);
  result.free = result.Lambda_inv.trace();
  // Jc M^-1 J^T, and what the constraints' forces answer to each unit force.
  const Eigen::Map<const RowMajor> Jc(cws.Jc.data(), cws.solver.rows(), chain.nv);
  const Eigen::MatrixXd coupling = product(Jc, M_inv_Jt);
  Eigen::MatrixXd answer(coupling.rows(), rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const Eigen::VectorXd column = coupling.col(r);
    cws.solver.solve(column.data(), answer.col(r).data());
  }
  result.Lambda_inv -= product(coupling.transpose(), answer);
  result.Lambda_inv = 0.5 * (result.Lambda_inv + result.Lambda_inv.transpose()).eval();
  return result;
}

}  // namespace

EffectiveMass constrained_effective_mass_of(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                            ConstrainedWorkspace& cws, ConstVec q, int frame, Task task) {
  EffectiveMass result;
  result.basis = task_basis(chain, task);
  compute_jacobian(chain, ws, q, frame, task);
  compute_constraints(chain, ws, set, cws, q, ws.scratch->zeros);
  factor_mass(chain, ws, cws, q);
  compute_row_system(chain, ws, cws);
  const Mobilities mobilities = mobilities_of(chain, ws, cws);
  result.Lambda_inv = mobilities.Lambda_inv;

  // Against what the chain could do by itself: where all motion is forbidden, all that is left is round-off.
  find_directions(result, mobilities.free);
  // They rise: the first ones are those of the singular directions.
  result.mobility.head(Eigen::Index(result.singular_directions.size())).setZero();
  if (result.singular_directions.empty()) result.Lambda = inverse_by_directions(result);
  return result;
}

}  // namespace chainreel
