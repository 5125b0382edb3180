#include "dynamics/constrained_inverse.hpp"

#include "dynamics/constraint_rows.hpp"
#include "core/dense.hpp"
#include "dynamics/rnea.hpp"

namespace chainreel {

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
  const Eigen::Matrix3Xd forces = forces_of_rows(chain, set, cws, k);
  Eigen::Map<Eigen::VectorXd>(lambda.data() + set.first_row(k), forces.cols()) =
      least_squares(forces, f);
}

}  // namespace chainreel
