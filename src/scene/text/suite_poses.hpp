// Poses as a suite writes them, and what they are of a model. Internal to suite.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/chain.hpp"
#include "model/srdf.hpp"
#include "model/urdf_file.hpp"

namespace chainreel {

struct WrittenValue {
  std::string joint;
  std::vector<double> values;
  Place place;
};

struct WrittenPose {
  std::string name;
  Place place;
  std::vector<double> numbers;       // by the order of coordinates ..
  std::vector<WrittenValue> joints;  // .. or by name
  bool is_by_name = false;
  bool is_of_srdf = false;
};

// The states of an SRDF. Those of several groups that share a name bear the group's in front: arm_home,
// hand_home.
std::vector<WrittenPose> poses_of(const SrdfFile& file);

// Where joints stand that a pose does not name: at zero, but where their limits exclude that in the middle
// between them, as joint_state_publisher and MoveIt do.
std::vector<double> resting_pose(const Chain& chain);

// The chain.nq numbers; none where the model has no such pose, of which everything is told: joints that it
// lacks or that follow another, numbers too few, values beyond a joint's limits. `file` is what the chain was
// read from.
std::optional<std::vector<double>> pose_of(const WrittenPose& written, const UrdfFile& file,
                                           const Chain& chain, ProblemList& problems);

}  // namespace chainreel
