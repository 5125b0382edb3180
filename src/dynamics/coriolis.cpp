// K. Lynch, F. Park, Modern Robotics (2017), eq. 8.16-8.17:
//
//   C_ij = sum_k Gamma_ijk qd_k,   Gamma_ijk = 1/2 (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i)
//
// The derivatives are those of CRBA over dual numbers, one coordinate at a time. With D = dM/dq_k and
// w = D qd: C += 1/2 D qd_k, and w / 2 is added to column k and taken from row k.
//
// Floating joints. The symbols are formed in the local chart q = q0 exp(xi) at xi = 0, where the body's twist
// is v = J(xi) xi', J = 1 - 1/2 ad_xi + .., and the mass matrix is J^T M J. Hence D = dM + J_k^T M + M J_k
// with J_k = -1/2 ad_(unit k). Back to twists: C = C_chart - M J', J' = sum J_k v_k. It changes nothing in C
// v, because ad_v v = 0, and keeps Mdot - 2 C skew, because it adds M J' minus its own transpose.
#include "dynamics/coriolis.hpp"

#include <vector>

#include "core/scalar.hpp"
#include "dynamics/kinematics.hpp"
#include "dynamics/recursions.hpp"

namespace chainreel {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

Eigen::Matrix3d cross_matrix(const Vector3d& a) {
  return Eigen::Matrix3d{{0, -a.z(), a.y()}, {a.z(), 0, -a.x()}, {-a.y(), a.x(), 0}};
}

// -1/2 ad of a twist (linear, angular)
Eigen::Matrix<double, 6, 6> chart_slope(const Vector3d& linear, const Vector3d& angular) {
  Eigen::Matrix<double, 6, 6> ad;
  ad << cross_matrix(angular), cross_matrix(linear), Eigen::Matrix3d::Zero(), cross_matrix(angular);
  return -0.5 * ad;
}

// J_k of every freedom k, as its non-zero 6x6 block; nothing for other joints.
struct ChartSlope {
  Eigen::Index first = 0;  // freedom of the joint
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Zero();
};

std::vector<ChartSlope> chart_slopes(const Chain& chain) {
  std::vector<ChartSlope> slopes(std::size_t(chain.nv));
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind != JointKind::floating) continue;
    for (int k = 0; k < 6; ++k) {
      const Vector3d linear = k < 3 ? Vector3d(Vector3d::Unit(k)) : Vector3d(Vector3d::Zero());
      const Vector3d angular = k < 3 ? Vector3d(Vector3d::Zero()) : Vector3d(Vector3d::Unit(k - 3));
      slopes[std::size_t(joint.v_index + k)] = {joint.v_index, chart_slope(linear, angular)};
    }
  }
  return slopes;
}

// M J_k, of which only six columns are not zero.
MatrixXd times_slope(const MatrixXd& M, const ChartSlope& slope) {
  MatrixXd product = MatrixXd::Zero(M.rows(), M.cols());
  if (!slope.J.isZero(0)) product.middleCols<6>(slope.first) = M.middleCols<6>(slope.first) * slope.J;
  return product;
}

// M and dM along the rates `unit` of the freedoms.
template <class A>
void mass_matrix_and_slope(const Chain& chain, Links<A>& links, ConstVec q, ConstVec unit, MatrixXd& M,
                           MatrixXd& dM) {
  std::vector<double> q_dot(q.size());
  q_rate(chain, q, unit, q_dot);
  std::vector<Dual<double>> dual_q(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) dual_q[i] = {q[i], q_dot[i]};
  place(links, ConstScalarSpan<A>(dual_q));

  const auto n = std::size_t(chain.nv);
  std::vector<Dual<double>> dual_M(n * n);
  crba(links, n, dual_M.data());
  M.resize(chain.nv, chain.nv);
  dM.resize(chain.nv, chain.nv);
  for (std::size_t i = 0; i < n * n; ++i) {
    M.data()[i] = dual_M[i].re;
    dM.data()[i] = dual_M[i].du;
  }
}

template <class A>
MatrixXd coriolis_matrix(const Chain& chain, ConstVec q, ConstVec qd) {
  Links<A> links(chain);
  const Eigen::Index n = chain.nv;
  const Eigen::Map<const Eigen::VectorXd> rates(qd.data(), n);
  const std::vector<ChartSlope> slopes = chart_slopes(chain);
  MatrixXd C = MatrixXd::Zero(n, n), M, D;
  std::vector<double> unit(std::size_t(n), 0.0);
  for (Eigen::Index k = 0; k < n; ++k) {
    unit[std::size_t(k)] = 1;
    mass_matrix_and_slope(chain, links, q, unit, M, D);
    unit[std::size_t(k)] = 0;
    const MatrixXd MJ = times_slope(M, slopes[std::size_t(k)]);
    D += MJ + MJ.transpose();
    const Eigen::VectorXd w = 0.5 * (D * rates);
    C += 0.5 * D * rates(k);
    C.col(k) += w;
    C.row(k) -= w.transpose();
    C -= MJ * rates(k);
  }
  return C;
}

}  // namespace

MatrixXd coriolis_matrix_of(const Chain& chain, ConstVec q, ConstVec qd) {
  return chain.planar ? coriolis_matrix<Planar<Dual<double>>>(chain, q, qd)
                      : coriolis_matrix<Spatial<Dual<double>>>(chain, q, qd);
}

}  // namespace chainreel
