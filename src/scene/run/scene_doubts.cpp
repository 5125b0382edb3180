#include "scene/run/scene_doubts.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "scene/annotation.hpp"
#include "scene/quantity.hpp"
#include "scene/run/pose_doubts.hpp"
#include "sim/drive/limits.hpp"
#include "sim/drive/table_units.hpp"

namespace chainreel {
namespace {

constexpr double kAcross = 1e-9;  // of gravity: what lies in the plane is rounding

std::string vector_words(const Eigen::Vector3d& v) {
  return bracketed({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0});  // never -0
}

// `limit: clamp` and `stop` ask for limits: of a model without any nothing comes of them.
std::string doubt_of_limit(LimitPolicy policy, Outcome expect, const Chain& chain) {
  const LimitWatch watch(chain);
  if (policy == LimitPolicy::clamp && !watch.have_effort())
    return "limit: clamp cuts nothing, as no joint of the model has a limit of its effort: in a URDF write <limit effort=\"20\"/>, "
           "in `model: {links: ..}` write efforts: 20";
  if (expect == Outcome::within_limits && watch.are_none())
    return "expect: within_limits is always fulfilled, as no joint of the model has a limit: in a URDF write <limit lower=.. upper=.. effort=.. velocity=../>, "
           "in `model: {links: ..}` efforts: 20";
  if (policy == LimitPolicy::stop && watch.are_none())
    return "limit: stop stops nothing, as no joint of the model has a limit: in a URDF write <limit lower=.. upper=.. effort=.. "
           "velocity=../>, or end the run by an event of kind stop";
  return "";
}

// A link that turns about its own origin on the world does not move there.
bool can_move(const Chain& chain, const Frame& frame) {
  constexpr double kOnAxis = 1e-9;  // m
  if (frame.body == 0) return false;
  const Body& body = chain.bodies[std::size_t(frame.body)];
  if (body.parent != 0 || body.joint.kind != JointKind::revolute) return true;
  return frame.X_BF.translation().cross(body.joint.axis).norm() > kOnAxis;
}

// Pushes of which nothing comes: behind the end of the run, on what is fixed to the world, or across the plane in which the chain moves.
std::vector<std::string> doubts_of_pushes(const Scene& scene, const Chain& chain) {
  std::vector<std::string> doubts;
  for (const PushEntry& push : scene.push) {
    const int frame = find_point(chain, push);
    if (push.from >= scene.duration)
      doubts.push_back("push: it begins at " + format_significant(push.from, 6) + " s, where the run has ended: take a longer `duration`");
    if (frame >= 0 && !can_move(chain, chain.frames[std::size_t(frame)]) && !scene.foot)
      doubts.push_back("push: '" + chain.frames[std::size_t(frame)].name + "' stands still whatever the chain does, so that nothing comes of it: push a link whose origin moves, as its joint's other end does");
    if (chain.planar && push.force.size() == 3) {
      const double across = Eigen::Vector3d(push.force[0], push.force[1], push.force[2]).dot(chain.planar->plane.normal);
      if (std::abs(across) > kAcross)
        doubts.push_back("push: " + format_significant(std::abs(across), 4) + " N of its force are perpendicular to the plane in which the chain moves, so that "
                         "nothing comes of them");
    }
  }
  return doubts;
}

bool are_zero(const std::vector<double>& gains) {
  return std::all_of(gains.begin(), gains.end(), [](double gain) { return gain == 0; });
}

bool has_negative(const std::vector<double>& gains) {
  return std::any_of(gains.begin(), gains.end(), [](double gain) { return gain < 0; });
}

// Feedback of which nothing comes, or that drives away from what it is told to follow.
std::vector<std::string> doubts_of_feedback(const Scene& scene, const Chain& chain) {
  std::vector<std::string> doubts;
  if (!scene.control) return doubts;
  const auto look_at_gains = [&](const std::string& name, const std::vector<double>& kp, const std::vector<double>& kd) {
    if (are_zero(kp) && are_zero(kd)) doubts.push_back("torque." + name + ": kp and kd are zero, so that nothing comes of it");
    if (has_negative(kp) || has_negative(kd)) doubts.push_back("torque." + name + ": a negative gain drives away from what is to be followed");
  };
  // A target is an angle like those of the start.
  const auto look_at_targets = [&](const std::string& name, const std::optional<Feedback>& feedback) {
    if (!feedback) return;
    for (std::size_t i = 0; i < std::min(feedback->q.size(), chain.coordinate_names.size()); ++i) {
      const std::string& written = feedback->q[i].text;
      const std::optional<double> value = parse_number(written);
      const std::string doubt = value && freedom_turns(chain, i) ? doubt_of_angle(written, *value, " of " + chain.coordinate_names[i]) : "";
      if (!doubt.empty()) doubts.push_back("torque." + name + ".q: " + doubt);
    }
  };
  look_at_targets("pd", scene.control->pd);
  look_at_targets("computed_torque", scene.control->computed_torque);
  if (scene.control->pd) look_at_gains("pd", scene.control->pd->kp, scene.control->pd->kd);
  if (!scene.control->task) return doubts;
  const TaskFeedback& task = *scene.control->task;
  look_at_gains("task", task.kp, task.kd);
  const int frame = task.frame.empty() ? chain.end_effector : find_frame(chain, task.frame);
  if (frame >= 0 && !can_move(chain, chain.frames[std::size_t(frame)]))
    doubts.push_back("torque.task: '" + chain.frames[std::size_t(frame)].name + "' stands still whatever the chain does, so that nothing comes of it");
  if (chain.planar && task.x.size() == 3)
    doubts.push_back("torque.task: what of `x` is perpendicular to the plane in which the chain moves is not followed: two numbers are enough");
  return doubts;
}

}  // namespace

std::string doubt_of_gravity(const Chain& chain) {
  const Eigen::Vector3d& g = chain.gravity;
  if (!chain.planar || !(g.norm() > 0)) return "";
  const Plane& plane = chain.planar->plane;
  if (std::hypot(g.dot(plane.ex), g.dot(plane.ey)) > kAcross * g.norm()) return "";
  // The plane's own basis was turned by this gravity: down in the picture is -y where y lies in it.
  const Eigen::Vector3d down = -plane.ey * g.norm();
  return "gravity " + vector_words(g) + " is perpendicular to the plane in which the chain moves, so that nothing of it acts: for down in the "
         "picture write gravity: " + vector_words(down) + ", for none [0, 0, 0]";
}

std::vector<std::string> doubts_of_scene(const Scene& scene, const Chain& chain) {
  std::vector<std::string> doubts = chain.slips;
  for (const std::string& doubt : doubts_of_pose(chain, scene.start.q, scene.start.written_q)) doubts.push_back("start.q: " + doubt);
  for (std::string doubt : {doubt_of_gravity(chain), doubt_of_limit(scene.limit, scene.expect, chain)})
    if (!doubt.empty()) doubts.push_back(std::move(doubt));
  for (std::string& doubt : doubts_of_pushes(scene, chain)) doubts.push_back(std::move(doubt));
  for (std::string& doubt : doubts_of_feedback(scene, chain)) doubts.push_back(std::move(doubt));
  return doubts;
}

}  // namespace chainreel
