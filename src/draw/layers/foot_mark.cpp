#include "draw/layers/foot_mark.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "draw/page/arrow.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/forward_dynamics.hpp"
#include "dynamics/ground_reaction.hpp"

namespace chainreel {
namespace {

constexpr double kWeightArrow = 0.22;  // units of H: as long is the force that bears the weight
constexpr double kFarthest = 3;        // lengths of the foot: beyond, the arrow tells nothing
constexpr double kGroundBesideFoot = 2.5;  // lengths of the foot, on each side

double weight_of(const Chain& chain) {
  double mass = 0;
  for (const Body& body : chain.bodies) mass += body.inertia.mass;
  return mass * chain.gravity.norm();
}

}  // namespace

FootMark::FootMark(const Simulation& simulation, const Trajectory& trajectory, int samples)
    : weight_(weight_of(simulation.chain)),
      foot_(*simulation.events->foot),
      ground_(simulation.events->ground) {
  const Chain& chain = simulation.chain;
  for (const Body& body : chain.bodies)
    if (&body != &chain.bodies[0] && body.parent == 0) ankles_.push_back(body.joint.X_PJ.translation());
  Workspace ws(chain);
  std::vector<double> tau(std::size_t(chain.nv));
  for (int k = 0; k < samples; ++k) {
    const auto q = trajectory.q_at(k), qd = trajectory.qd_at(k);
    simulation.torque->evaluate(chain, ws, trajectory.t[std::size_t(k)], q, qd, tau);
    compute_forward_dynamics(chain, ws, q, qd, tau);
    const std::vector<double> qdd = ws.qdd;
    const Wrench wrench = compute_ground_reaction(chain, ws, q, qd, qdd);
    pushes_.push_back(
        {center_of_pressure(chain, ws, ground_, foot_.height, q, qd, qdd), wrench.force / weight_});
  }
}

Eigen::Vector3d FootMark::on_ground(double place) const {
  return place * ground_.along + foot_.height * ground_.up;
}

ScaleEntry FootMark::scale_entry(const Theme& theme) const {
  constexpr double kShare = 0.3;  // of the weight, at most
  const double force = round_length(kShare * weight_);
  return {ScaleEntry::Mark::arrow, kWeightArrow * force / weight_, theme.constraint,
          "ground reaction " + format_shortest(force) + " N"};
}

void FootMark::draw_foot(Picture& picture, const Camera& camera, const ChainLook& look, int clip) const {
  const double beyond = kGroundBesideFoot * (foot_.toe - foot_.heel);
  const Point left = camera.project(on_ground(foot_.heel - beyond)),
              right = camera.project(on_ground(foot_.toe + beyond));
  draw_ground(picture, left.x < right.x ? PageLine{left, right} : PageLine{right, left}, {0, -1}, look, clip);
  const Point heel = camera.project(on_ground(foot_.heel)), toe = camera.project(on_ground(foot_.toe));
  const Paint paint{tinted(look.theme->base, 0.35, look), toned(look.theme->base, look), size::kLinkOutline};
  for (const Eigen::Vector3d& ankle : ankles_)
    picture.add(Polygon{{heel, toe, camera.project(ankle)}, 3, paint}, clip);
}

void FootMark::draw_pressure(Picture& picture, const Camera& camera, const ChainLook& look, int k,
                             int clip) const {
  const Push& push = pushes_[std::size_t(std::clamp(k, 0, int(pushes_.size()) - 1))];
  const double middle = (foot_.heel + foot_.toe) / 2;
  // A ground cannot pull; false for what is no number, too.
  if (!(push.force.dot(ground_.up) > 0)) return;
  if (!(std::abs(push.place - middle) < kFarthest * (foot_.toe - foot_.heel))) return;
  const Point force = (kWeightArrow / camera.scale) * camera.project_vector(push.force, camera.focus);
  const bool stands = push.place >= foot_.heel && push.place <= foot_.toe;
  draw_arrow(picture, camera.project(on_ground(push.place)), force,
             {look.theme->constraint, look.marks, !stands, false}, clip);
}

}  // namespace chainreel
