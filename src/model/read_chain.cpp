#include "model/read_chain.hpp"

#include "model/planar.hpp"
#include "model/reduce.hpp"
#include "model/urdf_file.hpp"

namespace chainreel {
namespace {

int end_effector_of(const Chain& chain, const ModelOptions& options, const std::string& path) {
  if (options.end_effector.empty()) {
    const int gripper = find_frame(chain, "gripper");
    if (gripper >= 0) return gripper;
    return chain.leaf_frames.size() == 1 ? chain.leaf_frames[0] : -1;
  }
  const int frame = find_frame(chain, options.end_effector);
  if (frame >= 0) return frame;
  std::vector<std::string> names;
  for (const Frame& known : chain.frames) names.push_back(known.name);
  const std::string near = did_you_mean(options.end_effector, names);
  throw Error(ExitCode::bad_input,
              "has no link '" + options.end_effector + "' that could be the end effector:" +
                  (near.empty() ? " its last link is '" + names.back() + "'" : near),
              {path});
}

}  // namespace

Chain read_chain(const std::string& path, const ModelOptions& options) {
  const UrdfFile file = read_urdf_file(path);
  Chain chain = reduce(file, options).chain;
  chain.end_effector = end_effector_of(chain, options, path);
  const Eigen::Vector3d down =
      moves_in_xy_plane(chain) ? Eigen::Vector3d(0, -9.81, 0) : Eigen::Vector3d(0, 0, -9.81);
  chain.gravity = options.gravity.value_or(down);
  chain.planar = planar_form_of(chain, chain.why_algebra);
  return chain;
}

}  // namespace chainreel
