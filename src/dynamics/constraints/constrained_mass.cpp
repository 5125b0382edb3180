#include "dynamics/constraints/constrained_mass.hpp"

#include <algorithm>

#include "core/dense.hpp"
#include "dynamics/algebra.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

// Forces p and accelerations a take the arrays of aba, which has done its work; IA, U and D_inv stay. A
// floating joint's U is no longer needed, either.
template <class A>
void solve_articulated(Links<A>& links, const double* b, double* x) {
  std::fill(links.pA.begin(), links.pA.end(), typename A::Force{});
  for (std::size_t i = links.size(); --i > 0;) {
    const auto& joint = links.joint[i];
    auto& p = links.pA[i];
    if constexpr (A::has_floating) {
      if (joint.freedoms == 6) {
        const auto force = A::joint_force(&b[joint.v]);
        links.U[i] = force + p * -1.0;
        if (joint.parent > 0)
          links.pA[joint.parent] = links.pA[joint.parent] + A::to_parent(links.X[i], force);
        continue;
      }
    }
    const double u = links.u[i] = b[joint.v] - A::power(links.S[i], p);
    if (joint.parent == 0) continue;
    auto& onward = links.pA[joint.parent];
    onward = onward + A::to_parent(links.X[i], p + links.U[i] * (u * links.D_inv[i]));
  }
  links.a[0] = {};
  for (std::size_t i = 1; i < links.size(); ++i) {
    const auto& joint = links.joint[i];
    const auto carried = A::to_child(links.X[i], links.a[joint.parent]);
    if constexpr (A::has_floating) {
      if (joint.freedoms == 6) {
        links.a[i] = A::solve(links.IA[i], links.U[i]);
        A::write_joint_rates(links.a[i] + carried * -1.0, &x[joint.v]);
        continue;
      }
    }
    const double rate = (links.u[i] - A::power(carried, links.U[i])) * links.D_inv[i];
    links.a[i] = carried + links.S[i] * rate;
    x[joint.v] = rate;
  }
}

}  // namespace

bool takes_dense_mass_matrix(const Chain& chain) {
  return chain.has_mimic || chain.nv <= kDenseFreedoms;
}

void factor_placed_mass(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws) {
  if (!takes_dense_mass_matrix(chain)) return;
  with_links(ws, [&](auto& links) { crba(links, std::size_t(chain.nv), cws.M.data()); });
  ldlt_factor(chain.nv, cws.M.data());
}

void factor_mass(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws, ConstVec q) {
  with_links(ws, [&](auto& links) {
    using A = typename std::decay_t<decltype(links)>::Algebra;
    place(links, q);
    locate(links);
    const ConstVec zeros = ws.scratch->zeros;
    if (!takes_dense_mass_matrix(chain)) aba(links, typename A::Motion{}, zeros, zeros, Vec(cws.dq));
  });
  factor_placed_mass(chain, ws, cws);
}

void solve_mass(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws, const double* b, double* x) {
  if (!takes_dense_mass_matrix(chain))
    return with_links(ws, [&](auto& links) { solve_articulated(links, b, x); });
  if (x != b) std::copy(b, b + chain.nv, x);
  ldlt_solve(chain.nv, cws.M.data(), x);
}

void compute_row_system(const Chain& chain, Workspace& ws, ConstrainedWorkspace& cws) {
  const int m = cws.solver.rows();
  const auto nv = std::size_t(chain.nv);
  double* const G = cws.solver.G();
  for (int i = 0; i < m; ++i) {
    double* const Z_i = cws.Z.data() + std::size_t(i) * nv;
    solve_mass(chain, ws, cws, cws.Jc.data() + std::size_t(i) * nv, Z_i);
    for (int j = 0; j <= i; ++j) {
      const double* const J_j = cws.Jc.data() + std::size_t(j) * nv;
      double sum = 0;
      for (std::size_t v = 0; v < nv; ++v) sum += J_j[v] * Z_i[v];
      G[i * m + j] = G[j * m + i] = sum;
    }
  }
  cws.solver.factor();
}

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
  for (Eigen::Index k = 0; k < result.mobility.size(); ++k)
    if (result.is_infinite[std::size_t(k)]) result.mobility(k) = 0;
  if (result.singular_directions.empty()) result.Lambda = inverse_by_directions(result);
  return result;
}

}  // namespace chainreel
