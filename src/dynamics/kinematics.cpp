// Poses and velocities, out from the base: X_WB = X_WP X_PB, v_i = X v_p + S qd (R. Featherstone, Rigid Body
// Dynamics Algorithms, 2008, ch. 4.4).
#include "dynamics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "core/format.hpp"
#include "core/error.hpp"
#include "core/scalar.hpp"
#include "dynamics/floating.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

template <class A>
void place(Links<A>& links, ConstScalarSpan<A> q) {
  for (std::size_t i = 1; i < links.size(); ++i) {
    const auto& joint = links.joint[i];
    A::place(links.body[i], links.X[joint.parent], &q[joint.q], links.X[i], links.S[i], links.I[i]);
  }
}

template <class A>
void locate(Links<A>& links) {
  for (std::size_t i = 1; i < links.size(); ++i) {
    links.pose[i] = A::pose_of(links.pose[links.joint[i].parent], links.X[i]);
  }
}

template <class A>
void move(Links<A>& links, ConstScalarSpan<A> qd) {
  for (std::size_t i = 1; i < links.size(); ++i) {
    const auto& joint = links.joint[i];
    links.v[i] = A::to_child(links.X[i], links.v[joint.parent]) +
                 A::joint_motion(links.body[i], links.S[i], &qd[joint.v]);
  }
}

#define INSTANTIATE(A)                                   \
  template void place<A>(Links<A>&, ConstScalarSpan<A>); \
  template void locate<A>(Links<A>&);                    \
  template void move<A>(Links<A>&, ConstScalarSpan<A>);
CHAINREEL_FOR_EACH_ALGEBRA(INSTANTIATE)
#undef INSTANTIATE

namespace {

Eigen::Vector3d eigen_of(const Vec3<double>& v) {
  return {v.x, v.y, v.z};
}

// Into world numbers. A planar body keeps its distance from the plane and turns about the normal only.
void write_body(const Chain& chain, Workspace& ws, std::size_t i, const Planar<double>::Pose& pose,
                const Planar<double>::Motion& v) {
  const Plane& plane = chain.planar->plane;
  const Eigen::Isometry3d& X_zero = chain.planar->X_WB_zero[i];
  const auto turned = [&](const Eigen::Vector3d& u) -> Eigen::Vector3d {
    const double x = plane.ex.dot(u);
    const double y = plane.ey.dot(u);
    return plane.ex * (pose.c * x - pose.s * y) + plane.ey * (pose.s * x + pose.c * y) +
           plane.normal * plane.normal.dot(u);
  };
  for (int k = 0; k < 3; ++k) ws.X_WB[i].linear().col(k) = turned(X_zero.linear().col(k));
  ws.X_WB[i].translation() =
      plane.ex * pose.x + plane.ey * pose.y + plane.normal * plane.normal.dot(X_zero.translation());
  ws.v_WB[i] = plane.ex * v.x + plane.ey * v.y;
  ws.w_WB[i] = plane.normal * v.w;
}

void write_body(const Chain&, Workspace& ws, std::size_t i, const Spatial<double>::Pose& pose,
                const Spatial<double>::Motion& v) {
  ws.X_WB[i].linear().row(0) = eigen_of(pose.R.r0).transpose();
  ws.X_WB[i].linear().row(1) = eigen_of(pose.R.r1).transpose();
  ws.X_WB[i].linear().row(2) = eigen_of(pose.R.r2).transpose();
  ws.X_WB[i].translation() = eigen_of(pose.p);
  ws.v_WB[i] = eigen_of(pose.R * v.v);
  ws.w_WB[i] = eigen_of(pose.R * v.w);
}

}  // namespace

void compute_kinematics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd) {
  ws.require_sizes(chain, q, qd);
  with_links(ws, [&](auto& links) {
    place(links, q);
    locate(links);
    move(links, qd);
    for (std::size_t i = 1; i < links.size(); ++i) write_body(chain, ws, i, links.pose[i], links.v[i]);
  });
}

Eigen::Isometry3d frame_pose(const Chain& chain, const Workspace& ws, int frame) {
  const Frame& f = chain.frames[std::size_t(frame)];
  return ws.X_WB[std::size_t(f.body)] * f.X_BF;
}

Eigen::Vector3d frame_position(const Chain& chain, const Workspace& ws, int frame) {
  const Frame& f = chain.frames[std::size_t(frame)];
  return ws.X_WB[std::size_t(f.body)] * f.X_BF.translation();
}

Eigen::Vector3d frame_velocity(const Chain& chain, const Workspace& ws, int frame) {
  const Frame& f = chain.frames[std::size_t(frame)];
  const auto body = std::size_t(f.body);
  const Eigen::Vector3d r = ws.X_WB[body].linear() * f.X_BF.translation();
  return ws.v_WB[body] + ws.w_WB[body].cross(r);
}

// The Jacobian of a frame, column by column: the frame's velocity when one joint on its way to the base moves
// at unit rate and all others stand still (K. Lynch, F. Park, Modern Robotics, 2017, ch. 5.1, here at the
// frame's origin and along fixed axes). Its rate times qd is the frame's acceleration when qdd = 0 and
// nothing pulls.

template <class A>
void jacobian(const Links<A>& links, std::size_t i, const typename A::Point& point, std::size_t rows,
              std::size_t nv, typename A::Scalar* J) {
  std::fill(J, J + rows * nv, typename A::Scalar(0));
  for (; i > 0; i = links.joint[i].parent) {
    for (std::size_t k = 0; k < links.joint[i].freedoms; ++k) {
      const auto S = A::unit_motion(links.body[i], links.S[i], int(k));
      const auto column = A::rows(A::in_world(links.pose[i], S, point));
      const std::size_t first = column.size() - rows;
      const std::size_t v = links.joint[i].v + k;
      for (std::size_t r = 0; r < rows; ++r) J[v * rows + r] = J[v * rows + r] + column[first + r];
    }
  }
}

#define INSTANTIATE(A)                                                                               \
  template void jacobian<A>(const Links<A>&, std::size_t, const A::Point&, std::size_t, std::size_t, \
                            A::Scalar*);
CHAINREEL_FOR_EACH_ALGEBRA(INSTANTIATE)
#undef INSTANTIATE

namespace {

template <class A>
std::size_t row_count(const Links<A>&, Task task) {
  return std::size_t(task == Task::linear ? A::kLinearRows : A::kFullRows);
}

// The name of a unit vector: its axis where it is one of the world's.
std::string name_of(const Eigen::Vector3d& direction, const std::string& otherwise) {
  const char* const axes[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    if (direction == Eigen::Vector3d::Unit(k)) return axes[k];
    if (direction == -Eigen::Vector3d::Unit(k)) return std::string("-") + axes[k];
  }
  return otherwise;
}

}  // namespace

TaskBasis task_basis(const Chain& chain, Task task) {
  TaskBasis basis;
  const auto add = [&](const std::string& name, const Eigen::Vector3d& direction) {
    basis.names.push_back(name);
    basis.directions.push_back(direction);
  };
  if (chain.planar) {
    const Plane& plane = chain.planar->plane;
    if (task == Task::full) add("w_" + name_of(plane.normal, "n"), plane.normal);
    add(name_of(plane.ex, "ex"), plane.ex);
    add(name_of(plane.ey, "ey"), plane.ey);
    return basis;
  }
  const char* const axes[] = {"x", "y", "z"};
  for (int k = 0; k < 3 && task == Task::full; ++k)
    add(std::string("w_") + axes[k], Eigen::Vector3d::Unit(k));
  for (int k = 0; k < 3; ++k) add(axes[k], Eigen::Vector3d::Unit(k));
  return basis;
}

std::vector<std::string> words_of(const TaskBasis& basis) {
  std::vector<std::string> words = basis.names;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Eigen::Vector3d& e = basis.directions[i];
    if (name_of(e, "").empty())
      words[i] += " = (" + format_significant(e.x(), 6) + ", " + format_significant(e.y(), 6) + ", " + format_significant(e.z(), 6) + ")";
  }
  return words;
}

void compute_jacobian(const Chain& chain, Workspace& ws, ConstVec q, int frame, Task task) {
  ws.require_sizes(chain, q);
  const Frame& f = chain.frames[std::size_t(frame)];
  with_links(ws, [&](auto& links) {
    using A = typename std::decay_t<decltype(links)>::Algebra;
    place(links, q);
    locate(links);
    const auto i = std::size_t(f.body);
    const auto point = A::in_world(links.pose[i], A::point_of(chain, f));
    const std::size_t rows = row_count(links, task);
    ws.J.resize(Eigen::Index(rows), chain.nv);
    jacobian(links, i, point, rows, std::size_t(chain.nv), ws.J.data());
  });
}

void compute_jacobian_rate(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, int frame, Task task) {
  ws.require_sizes(chain, q, qd);
  const Frame& f = chain.frames[std::size_t(frame)];
  with_links(ws, [&](auto& links) {
    using A = typename std::decay_t<decltype(links)>::Algebra;
    place(links, q);
    locate(links);
    accelerate(links, typename A::Motion{}, qd, ConstVec(ws.scratch->zeros));
    const auto i = std::size_t(f.body);
    const auto point = A::in_world(links.pose[i], A::point_of(chain, f));
    const auto v = A::in_world(links.pose[i], links.v[i], point);
    const auto a = A::rows(A::classical(A::in_world(links.pose[i], links.a[i], point), v));
    const std::size_t rows = row_count(links, task);
    ws.Jd_qd.resize(Eigen::Index(rows));
    std::copy(a.end() - Eigen::Index(rows), a.end(), ws.Jd_qd.data());
  });
}

// Coordinates and their rates. They differ for floating joints alone, whose pose is a point of SE(3):
//
//   p' = R v,  quat' = 1/2 quat (w, 0)
//   q (+) h v = q exp(h v),  exp(v, w) = (V v, exp w),
//   V = 1 + (1 - cos |w|)/|w|^2 [w]x + (|w| - sin |w|)/|w|^3 [w]x^2
//
// (K. Lynch, F. Park, Modern Robotics, 2017, eq. 3.88).

namespace {

using Vector = Vec3<double>;

// (x - sin x) / x^3
double cubic_rest_of_sine(double x) {
  const double z = x * x;
  if (x > 0.5) return (x - sine(x)) / (z * x);
  // The difference cancels: its Taylor series, to z^6 / 15! < 2^-53 of the first term.
  return 1.0 / 6 -
         z * (1.0 / 120 - z * (1.0 / 5040 - z * (1.0 / 362880 - z * (1.0 / 39916800 - z / 6227020800.0))));
}

void advance_floating(double* q, const double* qd, double h) {
  const Vector v = Floating::linear(qd) * h;
  const Vector w = Floating::angular(qd) * h;
  const Quaternion start = unit_of(Floating::turn(q));

  const double angle = square_root(dot(w, w));
  const auto [s, c] = sin_cos(angle / 2);
  const double sinc = angle > 0 ? s / angle : 0.5;  // of the half angle, halved
  const Vector wv = cross(w, v);
  const Vector step = v + wv * (2 * sinc * sinc) + cross(w, wv) * cubic_rest_of_sine(angle);

  Floating::write(Floating::position(q) + turned(start, step), unit_of(start * Quaternion{w * sinc, c}), q);
}

void rate_floating(const double* q, const double* qd, double* q_dot) {
  const Quaternion turn = Floating::turn(q);
  const Quaternion rate = turn * Quaternion{Floating::angular(qd) * 0.5, 0};
  Floating::write(turned(unit_of(turn), Floating::linear(qd)), rate, q_dot);
}

}  // namespace

void q_rate(const Chain& chain, ConstVec q, ConstVec qd, Vec q_dot) {
  for_each_coordinate(
      chain, [&](std::size_t i, std::size_t v) { q_dot[i] = qd[v]; },
      [&](std::size_t i, std::size_t v) { rate_floating(&q[i], &qd[v], &q_dot[i]); });
}

void advance(const Chain& chain, Vec q, ConstVec qd, double h) {
  if (q.size() != std::size_t(chain.nq) || qd.size() != std::size_t(chain.nv)) [[unlikely]]
    throw Error(ExitCode::bad_input, "a step is from q of nq = " + std::to_string(chain.nq) + " numbers by qd of nv = " + std::to_string(chain.nv));
  for_each_coordinate(
      chain, [&](std::size_t i, std::size_t v) { q[i] += h * qd[v]; },
      [&](std::size_t i, std::size_t v) { advance_floating(&q[i], &qd[v], h); });
}

void normalize(const Chain& chain, Vec q) {
  for_each_coordinate(
      chain, [](std::size_t, std::size_t) {},
      [&](std::size_t i, std::size_t) {
        double* p = &q[i];
        Floating::write(Floating::position(p), unit_of(Floating::turn(p)), p);
      });
}

}  // namespace chainreel
