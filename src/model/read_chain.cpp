#include "model/read_chain.hpp"

#include <cmath>

#include "model/planar.hpp"
#include "model/reduce.hpp"
#include "model/regularity.hpp"
#include "model/urdf_file.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {
namespace {

int end_effector_of(const Chain& chain, const ModelOptions& options, const UrdfFile& file) {
  if (options.end_effector.empty()) {
    const int gripper = find_frame(chain, "gripper");
    if (gripper >= 0) return gripper;
    return chain.leaf_frames.size() == 1 ? chain.leaf_frames[0] : -1;
  }
  const int frame = find_frame(chain, options.end_effector);
  if (frame >= 0) return frame;
  std::vector<std::string> names;
  for (const Frame& known : chain.frames) names.push_back(known.name);
  const std::string near = near_name(options.end_effector, names);
  throw Error(ExitCode::bad_input,
              "has no link '" + options.end_effector + "' that could be the end effector:" +
                  (near.empty() ? " its last link is '" + names.back() + "'" : near),
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

}  // namespace

Chain chain_of(const UrdfFile& file, const ModelOptions& options) {
  ReducedModel model = reduce(file, options);
  require_regular(model, file);
  Chain chain = std::move(model.chain);
  chain.end_effector = end_effector_of(chain, options, file);
  const Eigen::Vector3d down =
      moves_in_xy_plane(chain) ? Eigen::Vector3d(0, -9.81, 0) : Eigen::Vector3d(0, 0, -9.81);
  chain.gravity = options.gravity.value_or(down);
  // A component that is no number was left out.
  for (int i = 0; i < 3; ++i)
    if (std::isnan(chain.gravity[i])) chain.gravity[i] = down[i];
  chain.planar = planar_form_of(chain, chain.why_algebra);
  return chain;
}

Chain read_chain(const ModelSource& source, const ModelOptions& options) {
  return chain_of(read_urdf_file(source), options);
}

}  // namespace chainreel
