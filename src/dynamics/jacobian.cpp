// The Jacobian of a frame, column by column: the frame's velocity when one joint on its way to the base moves
// at unit rate and all others stand still (K. Lynch, F. Park, Modern Robotics, 2017, ch. 5.1, here at the
// frame's origin and along fixed axes). Its rate times qd is the frame's acceleration when qdd = 0 and
// nothing pulls.
#include "dynamics/jacobian.hpp"

#include <algorithm>
#include <string>
#include <type_traits>

#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

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

void compute_jacobian(const Chain& chain, Workspace& ws, ConstVec q, int frame, Task task) {
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

}  // namespace chainreel
