#include "model/planar.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/format.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

bool are_parallel(const Vector3d& a, const Vector3d& b) {
  return a.cross(b).norm() <= kParallelTolerance;
}

// A unit vector, freed of the round-off that would keep it off a coordinate axis.
Vector3d cleaned(Vector3d v) {
  v.normalize();
  int largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  const Vector3d axis = Vector3d::Unit(largest) * (v[largest] < 0 ? -1.0 : 1.0);
  return are_parallel(v, axis) ? axis : v;
}

std::string direction_text(const Vector3d& v) {
  constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    if (std::fabs(v[i]) == 1) return kNames[std::size_t(i)];
  return "(" + format_significant(v[0], 3) + ", " + format_significant(v[1], 3) + ", " +
         format_significant(v[2], 3) + ")";
}

// The axes of all joints at zero pose, in W.
struct Axes {
  std::vector<Vector3d> of_body;  // per body; the world's is unused
  int revolutes = 0;
  int prismatics = 0;
  int first_revolute = 0;  // body indices, 0: none
  int first_prismatic = 0;
  int second_direction = 0;  // first prismatic joint that is not parallel to the first one
};

Axes axes_of(const Chain& chain, const std::vector<Eigen::Isometry3d>& X_WB) {
  Axes axes;
  axes.of_body.resize(chain.bodies.size(), Vector3d::Zero());
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    axes.of_body[i] = X_WB[i].linear() * joint.axis;
    if (joint.kind == JointKind::revolute && ++axes.revolutes == 1) axes.first_revolute = int(i);
    if (joint.kind != JointKind::prismatic) continue;
    if (++axes.prismatics == 1) axes.first_prismatic = int(i);
    const Vector3d& first = axes.of_body[std::size_t(axes.first_prismatic)];
    if (axes.second_direction == 0 && !are_parallel(axes.of_body[i], first)) axes.second_direction = int(i);
  }
  return axes;
}

// The normal of a chain that only slides along one direction d: the plane holds d and "up" (against gravity,
// else +y, else +z), or, where d is up, d and the first of x, y, z that is across it.
Vector3d normal_of_slide(const Vector3d& d, const Vector3d& gravity) {
  Vector3d up = gravity.norm() > 0 ? Vector3d(-gravity) : Vector3d::UnitY();
  up.normalize();
  if (!are_parallel(up, d)) return d.cross(up);
  for (int i = 0; i < 3; ++i) {
    const Vector3d right = Vector3d::Unit(i);
    if (std::fabs(right.dot(d)) < 0.9) return right.cross(d);
  }
  return Vector3d::UnitZ();
}

// Up in the plane, unless gravity acts across it. Of a plane that holds two axes of the world it is the one that is nearest,
// so that coordinates in it do not turn with gravity.
Vector3d up_in_plane(const Vector3d& normal, const Vector3d& up) {
  int along = 0;
  normal.cwiseAbs().maxCoeff(&along);
  if (!are_parallel(normal, Vector3d::Unit(along))) return up;
  // Of two that are as near the later one: z before y before x.
  int nearest = along == 0 ? 1 : 0;
  for (int i = nearest + 1; i < 3; ++i)
    if (i != along && std::fabs(up[i]) >= std::fabs(up[nearest])) nearest = i;
  return up[nearest] < 0 ? Vector3d(-Vector3d::Unit(nearest)) : Vector3d(Vector3d::Unit(nearest));
}

// The basis in the plane: ey is up, and ex shows x, or the first link, to the right.
Plane plane_of(const Vector3d& normal, const Chain& chain, const std::vector<Eigen::Isometry3d>& X_WB) {
  const auto in_plane = [&](const Vector3d& v) -> Vector3d { return v - v.dot(normal) * normal; };
  constexpr double kAcross = 1e-9;  // a shorter projection has no direction worth its round-off
  Vector3d up = in_plane(-chain.gravity);
  if (up.norm() <= kAcross * chain.gravity.norm()) up = in_plane(Vector3d::UnitY());
  if (up.norm() <= kAcross) up = in_plane(Vector3d::UnitZ());

  Plane plane;
  plane.ey = cleaned(up_in_plane(normal, up));
  plane.ex = cleaned(plane.ey.cross(normal));
  // What decides between left and right: x, the first link, y, z.
  std::vector<Vector3d> to_the_right{Vector3d::UnitX()};
  if (chain.bodies.size() > 2) to_the_right.push_back(X_WB[2].translation() - X_WB[1].translation());
  to_the_right.push_back(Vector3d::UnitY());
  to_the_right.push_back(Vector3d::UnitZ());
  for (const Vector3d& v : to_the_right) {
    const double side = v.dot(plane.ex);
    if (std::fabs(side) <= kAcross * v.norm()) continue;
    if (side < 0) plane.ex = -plane.ex;
    break;
  }
  plane.normal = plane.ex.cross(plane.ey);
  return plane;
}

// How far a joint's axis is from its place in the plane, rad.
double misalignment(const Joint& joint, const Vector3d& axis, const Vector3d& normal) {
  return joint.kind == JointKind::revolute ? axis.cross(normal).norm() : std::fabs(axis.dot(normal));
}

std::string why_planar(const Axes& axes, const Vector3d& normal) {
  const std::string n = direction_text(normal);
  if (axes.prismatics == 0 && axes.revolutes == 1) return "planar: the only joint turns about " + n;
  if (axes.prismatics == 0)
    return "planar: all " + std::to_string(axes.revolutes) + " revolute axes are parallel to " + n;
  if (axes.revolutes == 0)
    return "planar: all " + std::to_string(axes.prismatics) + " prismatic axes are normal to " + n;
  return "planar: revolute axes are parallel and prismatic axes normal to " + n;
}

std::string why_spatial(const Chain& chain, const Axes& axes, int body) {
  const auto name = [&](int i) { return chain.bodies[std::size_t(i)].joint.name; };
  if (axes.revolutes == 0) {
    return "spatial: the axes of " + name(axes.first_prismatic) + ", " + name(axes.second_direction) +
           " and " + name(body) + " do not lie in one plane";
  }
  if (chain.bodies[std::size_t(body)].joint.kind == JointKind::revolute)
    return "spatial: the axes of " + name(axes.first_revolute) + " and " + name(body) + " are not parallel";
  return "spatial: the axis of " + name(body) + " is not normal to the axis of " + name(axes.first_revolute);
}

// What is off by less was meant to be in the plane.
constexpr double kNearlyPlanar = 1e-3;  // rad

struct PlaneSearch {
  std::optional<Vector3d> normal;
  std::string why;
  bool is_near = false;  // no plane, but it is missed by less than kNearlyPlanar only
};

PlaneSearch search_plane(const Chain& chain, const Axes& axes) {
  if (chain.has_floating) return {std::nullopt, "spatial: a floating joint moves in space"};
  const auto axis = [&](int body) -> const Vector3d& { return axes.of_body[std::size_t(body)]; };
  if (axes.revolutes == 0 && axes.second_direction == 0) {
    const Vector3d d = cleaned(axis(axes.first_prismatic));
    const std::string all = axes.prismatics == 1 ? "planar: the only joint slides along "
                                                 : "planar: all " + std::to_string(axes.prismatics) +
                                                       " prismatic axes are parallel to ";
    return {cleaned(normal_of_slide(d, chain.gravity)), all + direction_text(d)};
  }
  const Vector3d normal = axes.revolutes > 0
                              ? cleaned(axis(axes.first_revolute))
                              : cleaned(axis(axes.first_prismatic).cross(axis(axes.second_direction)));
  double worst = 0;
  int offender = 0;  // the first joint outside the plane
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const double off = misalignment(chain.bodies[i].joint, axes.of_body[i], normal);
    worst = std::max(worst, off);
    if (off > kParallelTolerance && offender == 0) offender = int(i);
  }
  if (offender == 0) return {normal, why_planar(axes, normal)};
  PlaneSearch search{std::nullopt, why_spatial(chain, axes, offender), worst < kNearlyPlanar};
  if (search.is_near)
    search.why += ", by " + format_significant(worst, 2) + " rad only: pi/2 in full is 1.5707963267948966";
  return search;
}

PlanarBody planar_body(const Chain& chain, const PlanarChain& form, const Axes& axes, std::size_t i) {
  const Body& body = chain.bodies[i];
  const Plane& plane = form.plane;
  const auto projected = [&](const Vector3d& v) { return Eigen::Vector2d(v.dot(plane.ex), v.dot(plane.ey)); };
  const Eigen::Matrix3d R_WB = form.X_WB_zero[i].linear();

  PlanarBody planar;
  planar.parent = body.parent;
  planar.kind = body.joint.kind;
  if (planar.kind == JointKind::revolute) {
    planar.sign = axes.of_body[i].dot(plane.normal) > 0 ? 1 : -1;
  } else {
    planar.direction = projected(axes.of_body[i]);
  }
  planar.p_PJ = projected(form.X_WB_zero[std::size_t(body.parent)].linear() * body.joint.X_PJ.translation());
  planar.mass = body.inertia.mass;
  planar.com = projected(R_WB * body.inertia.com);
  const Vector3d normal_B = R_WB.transpose() * plane.normal;
  planar.inertia = normal_B.dot(body.inertia.about_com * normal_B);
  planar.q_index = body.joint.q_index;
  planar.ratio = body.joint.ratio;
  planar.offset = body.joint.offset;
  return planar;
}

}  // namespace

std::vector<Eigen::Isometry3d> poses_at_zero(const Chain& chain) {
  std::vector<Eigen::Isometry3d> X_WB(chain.bodies.size(), Eigen::Isometry3d::Identity());
  for (std::size_t i = 1; i < chain.bodies.size(); ++i)
    X_WB[i] = X_WB[std::size_t(chain.bodies[i].parent)] * chain.bodies[i].joint.X_PJ;
  return X_WB;
}

bool moves_in_xy_plane(const Chain& chain) {
  if (chain.has_floating) return false;
  const Axes axes = axes_of(chain, poses_at_zero(chain));
  for (std::size_t i = 1; i < chain.bodies.size(); ++i)
    if (misalignment(chain.bodies[i].joint, axes.of_body[i], Vector3d::UnitZ()) > kParallelTolerance)
      return false;
  return true;
}

bool is_nearly_planar(const Chain& chain) {
  return search_plane(chain, axes_of(chain, poses_at_zero(chain))).is_near;
}

std::optional<PlanarChain> planar_form_of(const Chain& chain, std::string& why) {
  PlanarChain form;
  form.X_WB_zero = poses_at_zero(chain);
  const Axes axes = axes_of(chain, form.X_WB_zero);
  const PlaneSearch search = search_plane(chain, axes);
  why = search.why;
  if (!search.normal) return std::nullopt;
  form.plane = plane_of(*search.normal, chain, form.X_WB_zero);
  form.bodies.resize(chain.bodies.size());
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) form.bodies[i] = planar_body(chain, form, axes, i);
  return form;
}

}  // namespace chainreel
