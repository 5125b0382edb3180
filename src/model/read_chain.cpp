#include "model/read_chain.hpp"

#include <cmath>

#include "model/doctor.hpp"
#include "model/planar.hpp"
#include "model/reduce.hpp"
#include "model/regularity.hpp"
#include "model/urdf_file.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {
namespace {

std::string near_link(const std::string& name, const Chain& chain) {
  std::vector<std::string> names;
  for (const Frame& known : chain.frames) names.push_back(known.name);
  return near_name(name, names);
}

int end_effector_of(const Chain& chain, const ModelOptions& options, const UrdfFile& file) {
  if (options.end_effector.empty()) {
    const int gripper = find_frame(chain, "gripper");
    if (gripper >= 0) return gripper;
    return chain.leaf_frames.size() == 1 ? chain.leaf_frames[0] : -1;
  }
  const int frame = find_frame(chain, options.end_effector);
  if (frame >= 0) return frame;
  const std::string near = near_link(options.end_effector, chain);
  throw Error(ExitCode::bad_input,
              "has no link '" + options.end_effector + "' that could be the end effector:" +
                  (near.empty() ? " its last link is '" + chain.frames.back().name + "'" : near),
              file.at(0));
}

void require_regular(const ReducedModel& model, const UrdfFile& file) {
  const std::optional<Unresisted> found = unresisted_motion(model.chain);
  if (!found) return;
  const Body& body = model.chain.bodies[std::size_t(found->body)];
  const int link = model.link_of_body[std::size_t(found->body)];
  throw Error(ExitCode::bad_input,
              "joint '" + body.joint.name + "' moves no mass at any pose when it " + found->motion +
                  (found->behind ? " (the joints behind it give way)" : "") +
                  ", so no torque has an acceleration: give link '" + body.name + "' " + found->remedy +
                  (body.joint.kind == JointKind::floating ? ", or fix the base" : ", or make the joint fixed"),
              file.at(link < 0 ? 0 : file.links[std::size_t(link)].line));
}

// Two rigid bodies as one: the point adds no inertia about itself.
void add_point(Inertia& inertia, double mass, const Eigen::Vector3d& at) {
  const double whole = inertia.mass + mass;
  const Eigen::Vector3d com = (inertia.mass * inertia.com + mass * at) / whole, apart = at - inertia.com;
  const double reduced = inertia.mass * mass / whole;
  inertia.about_com += reduced * (apart.squaredNorm() * Eigen::Matrix3d::Identity() - apart * apart.transpose());
  inertia.com = com;
  inertia.mass = whole;
}

// Of bodies that turn: a slider is seen by its carriage.
void find_point_masses(Chain& chain, const ModelOptions& options) {
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Body& body = chain.bodies[b];
    const bool is_point = body.inertia.about_com.isZero(0) && body.inertia.mass > options.massless.value_or(0);
    if (is_point && body.joint.kind == JointKind::revolute) chain.point_masses.push_back({int(b), body.inertia.com, body.inertia.mass, false});
  }
}

void carry(Chain& chain, const Payload& payload, const UrdfFile& file) {
  if (!(payload.mass > 0)) return;
  const int index = payload.link.empty() ? chain.end_effector : find_frame(chain, payload.link);
  if (index < 0 && payload.link.empty())
    throw Error(ExitCode::bad_input, "has several ends, so that `payload` must say which carries it: payload.link, or end_effector", file.at(0));
  if (index < 0)
    throw Error(ExitCode::bad_input, "'payload.link' names no link: '" + payload.link + "'" + near_link(payload.link, chain), file.at(0));
  const Frame& frame = chain.frames[std::size_t(index)];
  if (frame.body == 0)
    throw Error(ExitCode::bad_input, "link '" + frame.name + "' stands on the ground and does not move, so that a payload there does nothing: name another, payload.link", file.at(0));
  const Eigen::Vector3d at = frame.X_BF * payload.at;
  add_point(chain.bodies[std::size_t(frame.body)].inertia, payload.mass, at);
  chain.point_masses.push_back({frame.body, at, payload.mass, true});
}

}  // namespace

Chain chain_of(const UrdfFile& file, const ModelOptions& options) {
  ReducedModel model = reduce(file, options);
  model.chain.end_effector = end_effector_of(model.chain, options, file);
  find_point_masses(model.chain, options);
  carry(model.chain, options.payload, file);
  require_regular(model, file);
  Chain chain = std::move(model.chain);
  const Eigen::Vector3d down =
      moves_in_xy_plane(chain) ? Eigen::Vector3d(0, -9.81, 0) : Eigen::Vector3d(0, 0, -9.81);
  chain.gravity = options.gravity.value_or(down);
  // A component that is no number was left out.
  for (int i = 0; i < 3; ++i)
    if (std::isnan(chain.gravity[i])) chain.gravity[i] = down[i];
  chain.planar = planar_form_of(chain, chain.why_algebra);
  chain.slips = slips_of(file);
  return chain;
}

Chain read_chain(const ModelSource& source, const ModelOptions& options) {
  return chain_of(read_urdf_file(source), options);
}

}  // namespace chainreel
