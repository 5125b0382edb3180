#include "dynamics/constraints/constrained_dynamics.hpp"

#include <algorithm>

#include "core/dense.hpp"
#include "core/scalar.hpp"
#include "dynamics/constraints/constrained_mass.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

std::string to_string(ConstraintStatus status) {
  switch (status) {
    case ConstraintStatus::regular:
      return "regular";
    case ConstraintStatus::redundant:
      return "redundant";
    case ConstraintStatus::inconsistent:
      return "inconsistent";
    case ConstraintStatus::not_converged:
      return "not converged";
    case ConstraintStatus::not_finite:
      return "not finite";
  }
  return {};
}

ConstrainedWorkspace::ConstrainedWorkspace(const Chain& chain, const ConstraintSet& set)
    : solver(set.rows()), kernel(constrained_kernel_of(chain, set)) {
  const auto m = std::size_t(set.rows());
  const auto nv = std::size_t(chain.nv);
  for (auto* vector : {&phi, &Jcd_qd, &lambda, &r, &dlambda}) vector->resize(m);
  for (auto* matrix : {&Jc, &Z}) matrix->resize(m * nv);
  for (auto* vector : {&tau, &tau_net, &qdd, &dq}) vector->resize(nv);
  if (takes_dense_mass_matrix(chain)) M.resize(nv * nv);
  anchor_states.resize(set.anchors().size());
  row_states.resize(m);
  for (const ConstraintSet::Curve& curve : set.curves()) curve_s.push_back(curve.s);
}

namespace {

// qdd without constraints; phi, Jc, Jcd_qd; M ready to be solved with. tau less friction.
void compute_free_motion(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                         ConstrainedWorkspace& cws, ConstVec q, ConstVec qd, ConstVec tau, Vec qdd) {
  std::copy(tau.begin(), tau.end(), cws.tau.begin());
  with_links(ws, [&](auto& links) {
    const ConstVec zeros = ws.scratch->zeros;
    place(links, q);
    locate(links);
    if (takes_dense_mass_matrix(chain)) {
      rnea(links, links.base_acceleration, qd, zeros, Vec(ws.nle));
      evaluate_rows(links, links.base_acceleration, set, cws, q);
      factor_placed_mass(chain, ws, cws);
      for (std::size_t v = 0; v < tau.size(); ++v) cws.tau[v] -= ws.nle[v];
      solve_mass(chain, ws, cws, cws.tau.data(), qdd.data());
    } else {
      accelerate(links, links.base_acceleration, qd, zeros);
      evaluate_rows(links, links.base_acceleration, set, cws, q);
      aba(links, links.base_acceleration, qd, ConstVec(cws.tau), qdd);
    }
  });
}

void add_stabilization(ConstrainedWorkspace& cws, ConstVec qd, double gain) {
  for (std::size_t i = 0; i < cws.phi.size(); ++i) {
    double rate = 0;
    for (std::size_t v = 0; v < qd.size(); ++v) rate += cws.Jc[i * qd.size() + v] * qd[v];
    cws.Jcd_qd[i] += gain * (2 * rate + gain * cws.phi[i]);
  }
}

// cws.r = Jc qdd + Jcd_qd; returns the largest sum of the sizes of what is added there, which its round-off
// goes by.
double take_residual(ConstrainedWorkspace& cws, ConstVec qdd) {
  const std::size_t nv = qdd.size();
  double largest = 0;
  cws.residual = 0;
  for (std::size_t i = 0; i < cws.r.size(); ++i) {
    double sum = cws.Jcd_qd[i];
    double size = absolute(sum);
    for (std::size_t v = 0; v < nv; ++v) {
      const double part = cws.Jc[i * nv + v] * qdd[v];
      size += absolute(part);
      sum += part;
    }
    cws.r[i] = sum;
    // Written so that what is no number counts as the largest.
    if (!(absolute(sum) <= cws.residual)) cws.residual = absolute(sum);
    largest = std::max(largest, size);
  }
  return largest;
}

// |G r|
double explained_residual(const ConstrainedWorkspace& cws) {
  double largest = 0;
  for (int i = 0; i < cws.solver.rows(); ++i) {
    double sum = 0;
    for (int j = 0; j < cws.solver.rows(); ++j) sum += cws.solver.G(i, j) * cws.r[std::size_t(j)];
    largest = std::max(largest, absolute(sum));
  }
  return largest;
}

void apply(ConstrainedWorkspace& cws, Vec qdd) {
  const std::size_t nv = qdd.size();
  for (std::size_t i = 0; i < cws.dlambda.size(); ++i) {
    const double dlambda = cws.dlambda[i];
    cws.lambda[i] += dlambda;
    for (std::size_t v = 0; v < nv; ++v) qdd[v] -= cws.Z[i * nv + v] * dlambda;
  }
}

// Passes until the rows are fulfilled, or what is left cannot be.
ConstraintStatus resolve(ConstrainedWorkspace& cws, Vec qdd, const ConstrainedOptions& options) {
  RowSolver& solver = cws.solver;
  std::fill(cws.lambda.begin(), cws.lambda.end(), 0.0);
  cws.passes = 0;
  cws.rank = solver.rank();
  double scale = 1 + take_residual(cws, qdd);
  if (options.always_proximal || !solver.regular()) solver.factor_proximal(options.mu);
  for (;;) {
    if (!(cws.residual < 1e300)) return ConstraintStatus::not_finite;
    const double tolerance = options.tolerance * scale;
    // A first pass is always made: lambda must answer a residual that happens to be small, too.
    if (cws.passes > 0 && cws.residual <= tolerance)
      return solver.regular() ? ConstraintStatus::regular : ConstraintStatus::redundant;
    if (cws.passes > 0 && !solver.regular() &&
        explained_residual(cws) <= tolerance * solver.largest_diagonal())
      return ConstraintStatus::inconsistent;
    if (cws.passes == options.most_passes) return ConstraintStatus::not_converged;
    // On dependent rows the direct solution is the answer if the rows agree; if not, passes go on from it.
    const bool direct = solver.regular() || cws.passes == 0;
    if (direct && !options.always_proximal) {
      solver.solve(cws.r.data(), cws.dlambda.data());
    } else {
      solver.solve_proximal(cws.r.data(), cws.dlambda.data());
    }
    apply(cws, qdd);
    ++cws.passes;
    scale = std::max(scale, 1 + take_residual(cws, qdd));
  }
}

}  // namespace

ConstraintStatus compute_constrained_dynamics(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                              ConstrainedWorkspace& cws, ConstVec q, ConstVec qd,
                                              ConstVec tau, Vec qdd, const ConstrainedOptions& options) {
  if (chain.has_dissipation) {
    compute_friction(chain, ws, qd);
    for (std::size_t v = 0; v < tau.size(); ++v) cws.tau_net[v] = tau[v] - ws.tau_f[v];
    tau = cws.tau_net;
  }
  const bool by_kernel = cws.kernel.run != nullptr && !options.always_proximal && !(options.gain > 0);
  if (by_kernel && cws.kernel.run(ws, cws, q, qd, tau, qdd.data(), options.tolerance)) {
    cws.rank = cws.kernel.rows;
    return cws.status = cws.kernel.doubled ? ConstraintStatus::redundant : ConstraintStatus::regular;
  }
  compute_free_motion(chain, ws, set, cws, q, qd, tau, qdd);
  if (options.gain > 0) add_stabilization(cws, qd, options.gain);
  compute_row_system(chain, ws, cws);
  cws.status = resolve(cws, qdd, options);
  if (!cws.solver.regular()) cws.solver.remove_null_part(cws.lambda.data());
  return cws.status;
}

ConstraintStatus compute_constrained_dynamics(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                              ConstrainedWorkspace& cws, ConstVec q, ConstVec qd,
                                              ConstVec tau, const ConstrainedOptions& options) {
  return compute_constrained_dynamics(chain, ws, set, cws, q, qd, tau, Vec(ws.qdd), options);
}

namespace {

Eigen::Vector3d in_world(const Chain& chain, const Vec3<double>& v) {
  if (!chain.planar) return {v.x, v.y, v.z};
  const Plane& plane = chain.planar->plane;
  return plane.ex * v.x + plane.ey * v.y + plane.normal * v.z;
}

// A^T: the force of each of the constraint's multipliers, one a column. In the plane no force leaves it: a
// rod between different heights loads the bearings across, which no motion shows.
Eigen::Matrix3Xd forces_of_rows(const Chain& chain, const ConstraintSet& set, const ConstrainedWorkspace& cws,
                                std::size_t k) {
  const int first = set.first_row(k);
  Eigen::Matrix3Xd forces(3, set.first_row(k + 1) - first);
  for (Eigen::Index i = 0; i < forces.cols(); ++i) {
    Vec3<double> f = cws.row_states[std::size_t(first + i)].f_a;
    if (chain.planar) f.z = 0;
    forces.col(i) = in_world(chain, f);
  }
  return forces;
}

}  // namespace

void compute_constrained_inverse_dynamics(const Chain& chain, Workspace& ws, const ConstraintSet& set,
                                          ConstrainedWorkspace& cws, ConstVec q, ConstVec qd, ConstVec qdd,
                                          ConstVec lambda) {
  compute_constraints(chain, ws, set, cws, q, qd);
  compute_inverse_dynamics(chain, ws, q, qd, qdd);
  const auto nv = std::size_t(chain.nv);
  for (std::size_t i = 0; i < lambda.size(); ++i)
    for (std::size_t v = 0; v < nv; ++v) ws.tau[v] += cws.Jc[i * nv + v] * lambda[i];
}

Eigen::Vector3d contact_force(const Chain& chain, const ConstraintSet& set, const ConstrainedWorkspace& cws,
                              std::size_t k, ConstVec lambda) {
  const Eigen::Matrix3Xd forces = forces_of_rows(chain, set, cws, k);
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < forces.cols(); ++i) force += forces.col(i) * lambda[std::size_t(set.first_row(k) + i)];
  return force;
}

void multipliers_of_force(const Chain& chain, const ConstraintSet& set, const ConstrainedWorkspace& cws,
                          std::size_t k, const Eigen::Vector3d& f, Vec lambda) {
  // Asked at every evaluation, mostly of rows that keep their directions: the last answer is that of the next.
  struct Answer {
    Eigen::Matrix3Xd forces;
    Eigen::Vector3d f;
    Eigen::VectorXd lambda;
  };
  thread_local Answer last;
  const Eigen::Matrix3Xd forces = forces_of_rows(chain, set, cws, k);
  if (last.forces.cols() != forces.cols() || last.forces != forces || last.f != f) last = {forces, f, least_squares(forces, f)};
  Eigen::Map<Eigen::VectorXd>(lambda.data() + set.first_row(k), forces.cols()) = last.lambda;
}

}  // namespace chainreel
