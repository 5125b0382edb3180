// With J_k the Jacobian of body k's twist V_k in the world, I_k its inertia there,
//
//   C = sum_k J_k^T (I_k J_k' + B_k J_k),   B = 1/2 (V x* I - I V x + (I V) bar-x*),   (f bar-x*) v = v x* f
//
// (S. Echeandia, P. Wensing, Numerical methods to compute the Coriolis matrix and Christoffel symbols for rigid-body
// systems, J. Comput. Nonlinear Dynam. 16(9), 2021.) B V is V x* I V, so that C qd is what it should be; I' = V x* I - I V x
// and the last term is skew, so that Mdot - 2 C is; for joints of one freedom it is the matrix of Christoffel's symbols.
// Summed from the leaves on, each pair of a body and one of its ancestors is met once: O(n d) for depth d.
#include <vector>

#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {

namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;  // angular above linear, about the world's origin, along its axes
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix3d cross_matrix(const Vector3d& a) {
  return Matrix3d{{0, -a.z(), a.y()}, {a.z(), 0, -a.x()}, {-a.y(), a.x(), 0}};
}

Vector6 stacked(const Vector3d& angular, const Vector3d& linear) {
  Vector6 v;
  v << angular, linear;
  return v;
}

// V x, from motions to motions; that from forces to forces is minus its transpose.
Matrix6 motion_cross(const Vector6& V) {
  Matrix6 X = Matrix6::Zero();
  X.topLeftCorner<3, 3>() = X.bottomRightCorner<3, 3>() = cross_matrix(V.head<3>());
  X.bottomLeftCorner<3, 3>() = cross_matrix(V.tail<3>());
  return X;
}

// f bar-x*
Matrix6 force_cross_bar(const Vector6& f) {
  Matrix6 X = Matrix6::Zero();
  X.topLeftCorner<3, 3>() = -cross_matrix(f.head<3>());
  X.topRightCorner<3, 3>() = X.bottomLeftCorner<3, 3>() = -cross_matrix(f.tail<3>());
  return X;
}

Matrix6 inertia_in_world(const Inertia& inertia, const Eigen::Isometry3d& X_WB) {
  const Matrix3d c = cross_matrix(X_WB * inertia.com);
  Matrix6 I;
  I << X_WB.linear() * inertia.about_com * X_WB.linear().transpose() + inertia.mass * c * c.transpose(), inertia.mass * c,
      inertia.mass * c.transpose(), inertia.mass * Matrix3d::Identity();
  return I;
}

// A freedom of a body's joint: the body's twist for a unit rate, and how that changes as the body moves.
struct Column {
  Eigen::Index index = 0;  // in qd
  Vector6 S, S_dot;
};

std::vector<Column> columns_of(const Joint& joint, const Eigen::Isometry3d& X_WB, const Matrix6& V_cross) {
  const Vector3d p = X_WB.translation();
  const auto turning = [&](const Vector3d& axis) { return stacked(axis, p.cross(axis)); };
  const auto sliding = [&](const Vector3d& axis) { return stacked(Vector3d::Zero(), axis); };
  std::vector<Column> columns;
  const auto add = [&](const Vector6& S) {
    columns.push_back({Eigen::Index(joint.v_index) + Eigen::Index(columns.size()), S, V_cross * S});
  };
  const Vector3d axis = joint.ratio * (X_WB.linear() * joint.axis);
  if (joint.kind == JointKind::revolute) add(turning(axis));
  if (joint.kind == JointKind::prismatic) add(sliding(axis));
  if (joint.kind == JointKind::floating) {
    for (int k = 0; k < 3; ++k) add(sliding(X_WB.linear().col(k)));
    for (int k = 0; k < 3; ++k) add(turning(X_WB.linear().col(k)));
  }
  return columns;
}

}  // namespace

MatrixXd coriolis_matrix_of(const Chain& chain, ConstVec q, ConstVec qd) {
  Workspace ws(chain);
  compute_kinematics(chain, ws, q, qd);
  const std::size_t bodies = chain.bodies.size();
  std::vector<std::vector<Column>> columns(bodies);
  std::vector<Matrix6> I(bodies, Matrix6::Zero()), B(bodies, Matrix6::Zero());  // of a body with all that it carries
  for (std::size_t i = 1; i < bodies; ++i) {
    const Body& body = chain.bodies[i];
    const Eigen::Isometry3d& X_WB = ws.X_WB[i];
    const Vector6 V = stacked(ws.w_WB[i], ws.v_WB[i] - ws.w_WB[i].cross(Vector3d(X_WB.translation())));
    const Matrix6 V_cross = motion_cross(V);
    columns[i] = columns_of(body.joint, X_WB, V_cross);
    I[i] = inertia_in_world(body.inertia, X_WB);
    B[i] = 0.5 * (force_cross_bar(I[i] * V) - V_cross.transpose() * I[i] - I[i] * V_cross);
  }
  MatrixXd C = MatrixXd::Zero(chain.nv, chain.nv);
  for (std::size_t i = bodies - 1; i >= 1; --i) {
    for (const Column& of_body : columns[i]) {
      const Vector6 IS = I[i] * of_body.S, BS = I[i] * of_body.S_dot + B[i] * of_body.S;
      const Vector6 transposed_BS = B[i].transpose() * of_body.S;
      for (const Column& own : columns[i]) C(own.index, of_body.index) += own.S.dot(BS);
      for (std::size_t a = std::size_t(chain.bodies[i].parent); a > 0; a = std::size_t(chain.bodies[a].parent)) {
        for (const Column& above : columns[a]) {
          C(above.index, of_body.index) += above.S.dot(BS);
          C(of_body.index, above.index) += above.S_dot.dot(IS) + above.S.dot(transposed_BS);
        }
      }
    }
    const auto parent = std::size_t(chain.bodies[i].parent);
    I[parent] += I[i];
    B[parent] += B[i];
  }
  return C;
}

}  // namespace chainreel
