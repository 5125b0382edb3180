// Poses as a suite writes them, and what they are of a model. Internal to suite.cpp.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "model/chain.hpp"
#include "model/srdf.hpp"
#include "model/urdf_file.hpp"
#include "scene/keys/fields.hpp"
#include "scene/text/suite_models.hpp"

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
  std::string model;  // the file whose it is alone; "": of all, or as its SRDF says
};

// `poses: {home: [0, 90deg], reach: {elbow: 1}, srdf: arm.srdf}`, and under a model's name those that are its own.
class SuitePoses {
 public:
  void read(Fields& root, const std::string& suite, const SuiteModels& models);
  // Those that are meant for the model. Of an SRDF that stands under no model's name they are by the name of the robot, where it matters.
  std::vector<const WrittenPose*> of(const std::string& model, const std::optional<std::string>& robot);
  bool has_states() const { return !srdfs_.empty(); }
  // A problem for each SRDF whose robot none was. `robots`: which there are, in words.
  void tell_idle(const std::string& robots, ProblemList& problems) const;

 private:
  struct Srdf {
    SrdfFile file;
    Place place;
    std::size_t begin, end;  // of its poses
    bool is_used = false;
  };
  struct List;
  void read_list(const List& list, const YAML::Node& node, const std::string& path, const std::string& model);
  void read_states(const List& list, const std::string& named, const Place& place, const std::string& model);
  void read_pose(const List& list, Fields& poses, const std::pair<YAML::Node, YAML::Node>& named, const std::string& model);

  std::vector<WrittenPose> poses_;
  std::vector<Srdf> srdfs_;
};

// Where joints stand that a pose does not name: at zero, but where their limits exclude that in the middle
// between them, as joint_state_publisher and MoveIt do.
std::vector<double> resting_pose(const Chain& chain);

// The chain.nq numbers; none where the model has no such pose, of which everything is told: joints that it
// lacks or that follow another, numbers too few, values beyond a joint's limits. `file` is what the chain was
// read from.
std::optional<std::vector<double>> pose_of(const WrittenPose& written, const UrdfFile& file,
                                           const Chain& chain, ProblemList& problems);

}  // namespace chainreel
