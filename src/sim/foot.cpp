#include "sim/foot.hpp"

#include <cmath>

#include "core/error.hpp"
#include "dynamics/ground_reaction.hpp"

namespace chainreel {
namespace {

constexpr double kNegligible = 1e-6;  // of a unit vector: far above round-off of the axes of a file

}  // namespace

GroundAxes ground_axes(const Chain& chain) {
  if (!chain.planar || chain.has_floating)
    throw Error(ExitCode::bad_input,
                "a foot needs a chain that moves in one plane on a fixed base; here " + chain.why_algebra);
  const Eigen::Vector3d& normal = chain.planar->plane.normal;
  const Eigen::Vector3d up = -(chain.gravity - chain.gravity.dot(normal) * normal);
  if (!(up.norm() > kNegligible * (1 + chain.gravity.norm())))
    throw Error(ExitCode::bad_input,
                "a foot needs gravity in the plane of the chain: nothing presses it down");
  GroundAxes axes;
  axes.up = up.normalized();
  axes.along = axes.up.cross(normal).normalized();
  const double rightward = std::abs(axes.along.x()) > kNegligible ? axes.along.x() : axes.along.y();
  if (rightward < 0) axes.along = -axes.along;
  return axes;
}

double center_of_pressure(const Chain& chain, Workspace& ws, const GroundAxes& axes, double height,
                          ConstVec q, ConstVec qd, ConstVec qdd) {
  const Wrench on_robot = compute_ground_reaction(chain, ws, q, qd, qdd);
  const double moment = axes.along.cross(axes.up).dot(on_robot.moment);
  return (moment + height * on_robot.force.dot(axes.along)) / on_robot.force.dot(axes.up);
}

}  // namespace chainreel
