// K. Lynch, F. Park, Modern Robotics (2017), ch. 8.1, with the energies of J. Uicker (1965) in homogeneous
// transforms:
//
//   K = sum 1/2 tr(X' Sigma X'^T),   P = - sum g . (X (m c, m))
//   Sigma = [ 1/2 tr(I_c) 1 - I_c + m c c^T   m c ]
//           [ m c^T                           m   ]
//
// X = X_WB(x) is multiplied up joint by joint; X' is its derivative in time, and comes, like every other
// derivative, from dual numbers: x + x' e. The second derivatives of K nest two further layers.
//
// In the local chart of a floating joint X = X_0 exp(xi), and exp(xi) = 1 + xi^ + xi^^2 / 2 is exact where
// xi = 0: only the layer of time and one layer of x enter xi, so that every third power vanishes.
#include "dynamics/lagrange.hpp"

#include <array>

#include "core/scalar.hpp"
#include "core/dense.hpp"
#include "dynamics/friction.hpp"

namespace chainreel {

namespace {

// The upper three rows of a homogeneous transform.
template <class T>
using Transform = std::array<std::array<T, 4>, 3>;

template <class T>
Transform<T> transform_of(const Eigen::Matrix<double, 3, 4>& A) {
  Transform<T> X;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) X[i][j] = T(A(int(i), int(j)));
  }
  return X;
}

template <class T>
Transform<T> operator*(const Transform<T>& A, const Transform<T>& B) {
  Transform<T> X;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) X[i][j] = A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j];
    X[i][3] = X[i][3] + A[i][3];
  }
  return X;
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  return Eigen::Matrix3d{{0, -a.z(), a.y()}, {a.z(), 0, -a.x()}, {-a.y(), a.x(), 0}};
}

// 1 + sin [axis]x + (1 - cos) [axis]x^2
template <class T>
Transform<T> turn_about(const Eigen::Vector3d& axis, const T& angle) {
  const Eigen::Matrix3d A = cross_matrix(axis);
  const Eigen::Matrix3d A2 = A * A;
  const auto [sin, cos] = sin_cos(angle);
  Transform<T> X{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      X[i][j] = T(i == j ? 1.0 : 0.0) + T(A(int(i), int(j))) * sin + T(A2(int(i), int(j))) * (T(1.0) - cos);
    }
  }
  return X;
}

template <class T>
Transform<T> slide_along(const Eigen::Vector3d& axis, const T& distance) {
  Transform<T> X{};
  for (std::size_t i = 0; i < 3; ++i) {
    X[i][i] = T(1.0);
    X[i][3] = T(axis[int(i)]) * distance;
  }
  return X;
}

// 1 + xi^ + xi^^2 / 2, xi = (linear, angular)
template <class T>
Transform<T> small_motion(const T* xi) {
  const T& wx = xi[3];
  const T& wy = xi[4];
  const T& wz = xi[5];
  const T zero(0.0);
  const T W[3][4] = {{zero, -wz, wy, xi[0]}, {wz, zero, -wx, xi[1]}, {-wy, wx, zero, xi[2]}};
  Transform<T> X{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const T square = W[i][0] * W[0][j] + W[i][1] * W[1][j] + W[i][2] * W[2][j];
      X[i][j] = T(i == j ? 1.0 : 0.0) + W[i][j] + T(0.5) * square;
    }
  }
  return X;
}

Eigen::Matrix<double, 3, 4> pose_of_floating(const double* q) {
  Eigen::Matrix<double, 3, 4> X;
  X.leftCols<3>() = Eigen::Quaterniond(q[6], q[3], q[4], q[5]).normalized().toRotationMatrix();
  X.col(3) = Eigen::Vector3d(q[0], q[1], q[2]);
  return X;
}

// X_PB at coordinates q0, moved on by x.
template <class T>
Transform<T> joint_transform(const Joint& joint, ConstVec q0, const std::vector<T>& x) {
  const Transform<T> X_PJ = transform_of<T>(joint.X_PJ.matrix().topRows<3>());
  const double* q = &q0[std::size_t(joint.q_index)];
  const T* step = &x[std::size_t(joint.v_index)];
  if (joint.kind == JointKind::floating)
    return X_PJ * transform_of<T>(pose_of_floating(q)) * small_motion(step);
  const T value = T(joint.ratio) * (T(*q) + *step) + T(joint.offset);
  return X_PJ *
         (joint.kind == JointKind::revolute ? turn_about(joint.axis, value) : slide_along(joint.axis, value));
}

template <class T>
std::vector<Transform<T>> body_transforms(const Chain& chain, ConstVec q0, const std::vector<T>& x) {
  std::vector<Transform<T>> X(chain.bodies.size());
  X[0] = transform_of<T>(Eigen::Matrix<double, 3, 4>::Identity());
  for (std::size_t i = 1; i < X.size(); ++i) {
    X[i] = X[std::size_t(chain.bodies[i].parent)] * joint_transform(chain.bodies[i].joint, q0, x);
  }
  return X;
}

Eigen::Matrix4d second_moments(const Inertia& inertia) {
  const Eigen::Vector3d mc = inertia.mass * inertia.com;
  Eigen::Matrix4d Sigma;
  Sigma.topLeftCorner<3, 3>() = 0.5 * inertia.about_com.trace() * Eigen::Matrix3d::Identity() -
                                inertia.about_com + mc * inertia.com.transpose();
  Sigma.topRightCorner<3, 1>() = mc;
  Sigma.bottomLeftCorner<1, 3>() = mc.transpose();
  Sigma(3, 3) = inertia.mass;
  return Sigma;
}

template <class T>
T kinetic_energy(const Chain& chain, ConstVec q0, const std::vector<T>& x, const std::vector<T>& xd) {
  std::vector<Dual<T>> moving(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) moving[k] = {x[k], xd[k]};
  const std::vector<Transform<Dual<T>>> X = body_transforms(chain, q0, moving);
  T K(0.0);
  for (std::size_t b = 1; b < X.size(); ++b) {
    const Eigen::Matrix4d Sigma = second_moments(chain.bodies[b].inertia);
    for (const auto& row : X[b]) {
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) K = K + T(0.5 * Sigma(int(i), int(j))) * row[i].du * row[j].du;
      }
    }
  }
  return K;
}

template <class T>
T potential_energy(const Chain& chain, ConstVec q0, const std::vector<T>& x) {
  const std::vector<Transform<T>> X = body_transforms(chain, q0, x);
  T P(0.0);
  for (std::size_t b = 1; b < X.size(); ++b) {
    const Inertia& inertia = chain.bodies[b].inertia;
    for (std::size_t i = 0; i < 3; ++i) {
      T p = X[b][i][3];
      for (std::size_t j = 0; j < 3; ++j) p = p + X[b][i][j] * T(inertia.com[int(j)]);
      P = P - T(inertia.mass * chain.gravity[int(i)]) * p;
    }
  }
  return P;
}

using Dual1 = Dual<double>;
using Dual2 = Dual<Dual<double>>;

// d2K / dqd_i dqd_j; K is quadratic in the rates, so that they may be zero.
double mass_between(const Chain& chain, ConstVec q, std::size_t i, std::size_t j) {
  const std::size_t n = std::size_t(chain.nv);
  std::vector<Dual2> x(n), xd(n);
  xd[i].re.du = 1;
  xd[j].du.re = 1;
  return kinetic_energy(chain, q, x, xd).du.du;
}

// d/dt (dK/dqd_i) at constant qd: the change of dK/dqd_i along qd.
double momentum_rate(const Chain& chain, ConstVec q, ConstVec qd, std::size_t i) {
  const std::size_t n = std::size_t(chain.nv);
  std::vector<Dual2> x(n), xd(n);
  for (std::size_t k = 0; k < n; ++k) {
    x[k].re.du = qd[k];
    xd[k].re.re = qd[k];
  }
  xd[i].du.re = 1;
  return kinetic_energy(chain, q, x, xd).du.du;
}

double kinetic_slope(const Chain& chain, ConstVec q, ConstVec qd, std::size_t i) {
  const std::size_t n = std::size_t(chain.nv);
  std::vector<Dual1> x(n), xd(qd.begin(), qd.end());
  x[i].du = 1;
  return kinetic_energy(chain, q, x, xd).du;
}

double potential_slope(const Chain& chain, ConstVec q, std::size_t i) {
  std::vector<Dual1> x(static_cast<std::size_t>(chain.nv));
  x[i].du = 1;
  return potential_energy(chain, q, x).du;
}

}  // namespace

LagrangeDynamics lagrange_dynamics_of(const Chain& chain, ConstVec q, ConstVec qd, ConstVec tau) {
  const Eigen::Index n = chain.nv;
  LagrangeDynamics result{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = std::size_t(i);
    for (Eigen::Index j = 0; j <= i; ++j) {
      result.M(i, j) = result.M(j, i) = mass_between(chain, q, k, std::size_t(j));
    }
    result.tau_g(i) = potential_slope(chain, q, k);
    result.nle(i) = momentum_rate(chain, q, qd, k) - kinetic_slope(chain, q, qd, k) + result.tau_g(i);
  }
  const std::vector<double> tau_f = friction_of(chain, qd);
  for (Eigen::Index i = 0; i < n; ++i)
    result.qdd(i) = tau[std::size_t(i)] - tau_f[std::size_t(i)] - result.nle(i);
  result.qdd = solve_symmetric(result.M, result.qdd);
  return result;
}

}  // namespace chainreel
