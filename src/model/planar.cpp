#include "model/planar.hpp"

#include <array>
#include <cmath>

#include "core/format.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

bool are_parallel(const Vector3d& a, const Vector3d& b) {
  return a.cross(b).norm() <= kParallelTolerance;
}

bool are_normal(const Vector3d& a, const Vector3d& b) {
  return std::fabs(a.dot(b)) <= kParallelTolerance;
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

// The basis in the plane: ey is up, and ex shows x, or the first link, to the right.
Plane plane_of(const Vector3d& normal, const Chain& chain, const std::vector<Eigen::Isometry3d>& X_WB) {
  const auto in_plane = [&](const Vector3d& v) -> Vector3d { return v - v.dot(normal) * normal; };
  constexpr double kAcross = 1e-9;  // a shorter projection has no direction worth its round-off
  Vector3d up = in_plane(-chain.gravity);
  if (up.norm() <= kAcross * chain.gravity.norm()) up = in_plane(Vector3d::UnitY());
  if (up.norm() <= kAcross) up = in_plane(Vector3d::UnitZ());

  Plane plane;
  plane.ey = cleaned(up);
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

std::string joint_name(const Chain& chain, int body) {
  return chain.bodies[std::size_t(body)].joint.name;
}

// A normal of the plane, or nothing and the reason.
std::optional<Vector3d> normal_of(const Chain& chain, const Axes& axes, std::string& why) {
  if (chain.has_floating) {
    why = "spatial: a floating joint moves in space";
    return std::nullopt;
  }
  const auto axis = [&](int body) -> const Vector3d& { return axes.of_body[std::size_t(body)]; };
  if (axes.revolutes == 0 && axes.second_direction == 0) {
    const Vector3d d = cleaned(axis(axes.first_prismatic));
    why = axes.prismatics == 1 ? "planar: the only joint slides along " + direction_text(d)
                               : "planar: all " + std::to_string(axes.prismatics) +
                                     " prismatic axes are parallel to " + direction_text(d);
    return cleaned(normal_of_slide(d, chain.gravity));
  }
  const bool turns = axes.revolutes > 0;
  const Vector3d normal = turns ? cleaned(axis(axes.first_revolute))
                                : cleaned(axis(axes.first_prismatic).cross(axis(axes.second_direction)));
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const bool revolute = chain.bodies[i].joint.kind == JointKind::revolute;
    if (revolute ? are_parallel(axes.of_body[i], normal) : are_normal(axes.of_body[i], normal)) continue;
    const std::string name = joint_name(chain, int(i));
    if (revolute) {
      why = "spatial: the axes of " + joint_name(chain, axes.first_revolute) + " and " + name +
            " are not parallel";
    } else if (turns) {
      why = "spatial: the axis of " + name + " is not normal to the axis of " +
            joint_name(chain, axes.first_revolute);
    } else {
      why = "spatial: the axes of " + joint_name(chain, axes.first_prismatic) + ", " +
            joint_name(chain, axes.second_direction) + " and " + name + " do not lie in one plane";
    }
    const double off =
        revolute ? axes.of_body[i].cross(normal).norm() : std::fabs(axes.of_body[i].dot(normal));
    if (off < 1e-3) {
      why += " (by " + format_significant(off, 2) +
             " rad only: if they should be, write angles with all digits, pi/2 as 1.5707963267948966)";
    }
    return std::nullopt;
  }
  if (axes.prismatics == 0) {
    why = axes.revolutes == 1 ? "planar: the only joint turns about " + direction_text(normal)
                              : "planar: all " + std::to_string(axes.revolutes) +
                                    " revolute axes are parallel to " + direction_text(normal);
  } else if (axes.revolutes == 0) {
    why = "planar: all " + std::to_string(axes.prismatics) + " prismatic axes are normal to " +
          direction_text(normal);
  } else {
    why = "planar: revolute axes are parallel and prismatic axes normal to " + direction_text(normal);
  }
  return normal;
}

PlanarBody planar_body(const Chain& chain, const PlanarChain& form, const Axes& axes, std::size_t i) {
  const Body& body = chain.bodies[i];
  const Plane& plane = form.plane;
  const auto projected = [&](const Vector3d& v) { return Eigen::Vector2d(v.dot(plane.ex), v.dot(plane.ey)); };
  const Eigen::Isometry3d& X_WB = form.X_WB_zero[i];
  const Eigen::Matrix3d& R_WB = X_WB.linear();

  PlanarBody planar;
  planar.parent = body.parent;
  planar.kind = body.joint.kind;
  if (planar.kind == JointKind::revolute) {
    planar.sign = axes.of_body[i].dot(plane.normal) > 0 ? 1 : -1;
  } else {
    planar.direction = projected(axes.of_body[i]);
  }
  planar.p_PJ = projected(X_WB.translation() - form.X_WB_zero[std::size_t(body.parent)].translation());
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
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const bool revolute = chain.bodies[i].joint.kind == JointKind::revolute;
    const Vector3d& axis = axes.of_body[i];
    if (!(revolute ? are_parallel(axis, Vector3d::UnitZ()) : are_normal(axis, Vector3d::UnitZ())))
      return false;
  }
  return true;
}

std::optional<PlanarChain> planar_form_of(const Chain& chain, std::string& why) {
  PlanarChain form;
  form.X_WB_zero = poses_at_zero(chain);
  const Axes axes = axes_of(chain, form.X_WB_zero);
  const auto normal = normal_of(chain, axes, why);
  if (!normal) return std::nullopt;
  form.plane = plane_of(*normal, chain, form.X_WB_zero);
  form.bodies.resize(chain.bodies.size());
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) form.bodies[i] = planar_body(chain, form, axes, i);
  return form;
}

}  // namespace chainreel
