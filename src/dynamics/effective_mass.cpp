// Lambda_inv = J M^-1 J^T: the acceleration of the frame for a unit force on it, all else at rest. Each row
// of J is taken as a torque and M^-1 of it by forward dynamics without velocity or gravity, so that long
// chains need no M. K. Lynch, F. Park, Modern Robotics (2017), ch. 8.6; O. Khatib, IEEE J. Robotics and
// Automation 3 (1987), eq. 51.
#include "dynamics/effective_mass.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "core/dense.hpp"
#include "dynamics/algebra.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

// ws.qdd = M^-1 ws.tau, in the pose of the last `place`.
void solve_for_acceleration(const Chain& chain, Workspace& ws) {
  with_links(ws, [&](auto& links) {
    using A = typename std::decay_t<decltype(links)>::Algebra;
    auto& scratch = *ws.scratch;
    if (!chain.has_mimic)
      return aba(links, typename A::Motion{}, ConstVec(scratch.zeros), ConstVec(ws.tau), Vec(ws.qdd));
    crba(links, std::size_t(chain.nv), scratch.M.data());
    ldlt_factor(chain.nv, scratch.M.data());
    std::copy(ws.tau.begin(), ws.tau.end(), ws.qdd.begin());
    ldlt_solve(chain.nv, scratch.M.data(), ws.qdd.data());
  });
}

Eigen::MatrixXd inverse_of_effective_mass(const Chain& chain, Workspace& ws) {
  const Eigen::Index rows = ws.J.rows();
  Eigen::MatrixXd Lambda_inv(rows, rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    Eigen::Map<Eigen::VectorXd>(ws.tau.data(), chain.nv) = ws.J.row(r);
    solve_for_acceleration(chain, ws);
    Lambda_inv.col(r) = product(ws.J, Eigen::Map<const Eigen::VectorXd>(ws.qdd.data(), chain.nv));
  }
  return 0.5 * (Lambda_inv + Lambda_inv.transpose());
}

// Which directions are infinitely heavy: no more mobile than `least`.
void part_directions(EffectiveMass& effective) {
  effective.is_infinite.clear();
  effective.singular_directions.clear();
  for (Eigen::Index k = 0; k < effective.mobility.size(); ++k) {
    effective.is_infinite.push_back(!(effective.mobility(k) > effective.least));
    if (effective.is_infinite.back()) effective.singular_directions.emplace_back(effective.directions.col(k));
  }
}

}  // namespace

void find_directions(EffectiveMass& effective, double free) {
  SymmetricEigen eigen = eigen_of_symmetric(effective.Lambda_inv);
  effective.mobility = eigen.values.cwiseMax(0.0);  // round-off may leave a zero below zero
  effective.directions = std::move(eigen.vectors);
  effective.least = free > 0 ? kForbiddenFraction * free : kSingularFraction * effective.mobility.maxCoeff();
  part_directions(effective);
}

namespace {

// Mobilities and directions by singular values, which know small ones to as many digits as the largest has. Leaves all as it is where M has no Cholesky factor.
void refine_directions(EffectiveMass& effective, const Eigen::MatrixXd& J, const Eigen::MatrixXd& M) {
  const Eigen::LLT<Eigen::MatrixXd> factor(M);
  if (factor.info() != Eigen::Success) return;
  const Eigen::MatrixXd W = factor.matrixL().solve(J.transpose());
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(W, Eigen::ComputeFullV);
  const Eigen::Index rows = J.rows(), known = svd.singularValues().size();
  const double largest = known > 0 ? svd.singularValues()(0) : 0;
  // Rounding of J, which gathers along the chain, is magnified by L^-1.
  const Eigen::MatrixXd inverse = factor.matrixL().solve(Eigen::MatrixXd::Identity(M.rows(), M.cols()));
  const double rounding = 0x1p-52 * double(J.cols()) * J.norm() * inverse.norm();
  const double least = std::max(kSingularValue * largest, rounding);
  effective.least = least * least;
  for (Eigen::Index k = 0; k < rows; ++k) {
    const Eigen::Index from = rows - 1 - k;  // rising
    const double sigma = from < known ? svd.singularValues()(from) : 0;
    effective.mobility(k) = sigma * sigma;
    effective.directions.col(k) = svd.matrixV().col(from);
  }
  part_directions(effective);
}

}  // namespace

Eigen::MatrixXd inverse_by_directions(const EffectiveMass& effective) {
  return congruence(effective.directions.transpose(), effective.mobility.cwiseInverse().asDiagonal());
}

EffectiveMass effective_mass_of(const Chain& chain, Workspace& ws, ConstVec q, int frame, Task task) {
  EffectiveMass result;
  result.basis = task_basis(chain, task);
  compute_jacobian(chain, ws, q, frame, task);
  result.Lambda_inv = inverse_of_effective_mass(chain, ws);

  find_directions(result);
  constexpr double kSmall = 1e-6;  // of the largest: ten digits are left
  if (result.mobility.size() > 0 && result.mobility(0) < kSmall * result.mobility.maxCoeff()) {
    const Eigen::MatrixXd J = ws.J;
    compute_mass_matrix(chain, ws, q);
    refine_directions(result, J, ws.M);
    ws.J = J;
  }
  if (!result.singular_directions.empty()) return result;

  if (ws.J.rows() == ws.J.cols()) {
    // Without the detour over the inverse, which squares the condition of J.
    compute_mass_matrix(chain, ws, q);
    result.Lambda = congruence(inverse_of(ws.J), ws.M);
  } else {
    result.Lambda = inverse_by_directions(result);
  }
  return result;
}

PlaneForm form_on_plane(const EffectiveMass& effective, const Eigen::VectorXd& values,
                        const Eigen::Matrix<double, 3, 2>& plane) {
  Eigen::MatrixXd E(values.size(), 2);
  for (Eigen::Index j = 0; j < values.size(); ++j)
    E.row(j) = effective.basis.directions[std::size_t(j)].transpose() * plane;
  const Eigen::MatrixXd turned = product(effective.directions.transpose(), E);
  const SymmetricEigen eigen = eigen_of_symmetric(congruence(turned, values.asDiagonal()));
  return {eigen.values.cwiseMax(0), plane * Eigen::Matrix2d(eigen.vectors)};
}

}  // namespace chainreel
