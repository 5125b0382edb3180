#include "scene/text/suite_poses.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "core/format.hpp"
#include "model/followers.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// Limits are written with a few digits, 3.14159 for pi: what rounding takes from them still belongs to a
// joint.
constexpr double kRoundingOfLimits = 1e-5;  // rad or m

std::string value_text(double value, JointKind kind) {
  if (kind == JointKind::prismatic) return format_significant(value, 6) + " m";
  return format_significant(value, 6) + " rad (" + format_fixed(value * 180 / std::numbers::pi, 2) + " deg)";
}

const UrdfJoint* find_joint(const UrdfFile& file, const std::string& name) {
  for (const UrdfJoint& joint : file.joints)
    if (joint.name == name) return &joint;
  return nullptr;
}

// Sets the coordinates of one model, and says what is wrong with what is to be set.
class PoseSetter {
 public:
  PoseSetter(const WrittenPose& written, const UrdfFile& file, const Chain& chain, ProblemList& problems)
      : written_(written),
        file_(file),
        chain_(chain),
        problems_(problems),
        names_(position_names(chain)),
        q_(resting_pose(chain)),
        set_at_(q_.size()) {}

  std::optional<std::vector<double>> run() {
    if (written_.is_by_name)
      set_by_name();
    else
      set_by_order();
    if (is_good_) check_limits();
    if (is_good_)
      if (const std::string trouble = trouble_of_pose(chain_, q_); !trouble.empty())
        fail(trouble, written_.place);
    return is_good_ ? std::optional(q_) : std::nullopt;
  }

 private:
  void fail(const std::string& message, const Place& place) {
    is_good_ = false;
    problems_.add("pose '" + written_.name + "': " + message, place);
  }

  void set(std::size_t index, double value, const Place& place) {
    q_[index] = value;
    set_at_[index] = place;
  }

  void set_by_order() {
    std::vector<double> numbers = written_.numbers;
    const FollowerNumbers followers = numbers_of_followers(chain_, numbers, false);
    take_out(numbers, followers.places);
    if (numbers.size() != q_.size())
      return fail("has " + std::to_string(numbers.size()) + " numbers, but " + file_.path +
                      " needs " + std::to_string(q_.size()) + ": " + joined(names_) +
                      (followers.contradiction.empty() ? "" : "; " + followers.contradiction),
                  written_.place);
    for (std::size_t i = 0; i < q_.size(); ++i) set(i, numbers[i], written_.place);
  }

  void set_by_name() {
    for (const WrittenValue& value : written_.joints)
      if (!set_coordinates(value) && !is_of_follower(value)) refuse(value);
    if (is_good_) check_followers();
  }

  // Whether the name is that of coordinates: of one, or of all of a joint with several (NAME.x, NAME.y, ..).
  bool set_coordinates(const WrittenValue& value) {
    const std::vector<std::size_t> indices = places_of_joint(names_, value.joint);
    if (indices.empty()) return false;
    if (indices.size() != value.values.size()) {
      fail("joint '" + value.joint + "' takes " + std::to_string(indices.size()) +
               (indices.size() == 1 ? " number" : " numbers") + ", not " +
               std::to_string(value.values.size()),
           value.place);
      return true;
    }
    for (std::size_t i = 0; i < indices.size(); ++i) set(indices[i], value.values[i], value.place);
    return true;
  }

  // A joint that mimics another may be given where it stands anyway, as SRDF files do.
  bool is_of_follower(const WrittenValue& value) {
    for (const Body& body : chain_.bodies)
      if (&body != &chain_.bodies.front() && body.joint.name == value.joint && value.values.size() == 1) {
        followers_.push_back({&body.joint, value.values.front(), value.place});
        return true;
      }
    return false;
  }

  void refuse(const WrittenValue& value) {
    const UrdfJoint* joint = find_joint(file_, value.joint);
    const bool is_fixed = joint != nullptr && joint->type == UrdfJointType::fixed;
    // The joint by which the root link hangs in the world: a fixed base stands where it stands.
    if ((joint == nullptr || is_fixed) && written_.is_of_srdf && value.values.size() == 7)
      return set_floating_base(value);
    if (is_fixed)
      return fail("joint '" + value.joint + "' is fixed (" + file_.path + " line " +
                      std::to_string(joint->line) + "): leave it out",
                  value.place);
    fail(file_.path + " has no joint '" + value.joint + "':" + did_you_mean(value.joint, names_) +
             " It has " + joined(names_) + ".",
         value.place);
  }

  void set_floating_base(const WrittenValue& value) {
    for (const Body& body : chain_.bodies)
      if (body.joint.kind == JointKind::floating && find_joint(file_, body.joint.name) == nullptr)
        for (std::size_t i = 0; i < 7; ++i)
          set(std::size_t(body.joint.q_index) + i, value.values[i], value.place);
  }

  void check_followers() {
    for (const Follower& follower : followers_) {
      const Joint& joint = *follower.joint;
      const double value = joint.ratio * q_[std::size_t(joint.q_index)] + joint.offset;
      if (std::abs(value - follower.value) <= kRoundingOfLimits) continue;
      const std::string& leader = names_[std::size_t(joint.q_index)];
      fail("joint '" + joint.name + "' follows '" + leader + "', which puts it at " +
               value_text(value, joint.kind) + ", not " + value_text(follower.value, joint.kind) +
               ": give '" + leader + "' its value",
           follower.place);
    }
  }

  void check_limits() {
    for (std::size_t i = 1; i < chain_.bodies.size(); ++i) {
      const Joint& joint = chain_.bodies[i].joint;
      const std::optional<Place>& place = set_at_[std::size_t(joint.q_index)];
      if (joint.kind == JointKind::floating || !place) continue;
      const double value = joint.ratio * q_[std::size_t(joint.q_index)] + joint.offset;
      const bool below =
          value<joint.limit.lower - kRoundingOfLimits, above = value> joint.limit.upper + kRoundingOfLimits;
      if (!below && !above) continue;
      const UrdfJoint* read = find_joint(file_, joint.name);
      const std::string line =
          read == nullptr || read->limit.line == 0 ? "" : " line " + std::to_string(read->limit.line);
      fail("joint '" + joint.name + "' at " + value_text(value, joint.kind) + " is beyond its " +
               (below ? "lower" : "upper") + " limit of " +
               value_text(below ? joint.limit.lower : joint.limit.upper, joint.kind) + " (" + file_.path +
               line + "): keep it within",
           *place);
    }
  }

  struct Follower {
    const Joint* joint;
    double value;
    Place place;
  };

  const WrittenPose& written_;
  const UrdfFile& file_;
  const Chain& chain_;
  ProblemList& problems_;
  std::vector<std::string> names_;
  std::vector<double> q_;
  std::vector<std::optional<Place>> set_at_;
  std::vector<Follower> followers_;
  bool is_good_ = true;
};

// The states of an SRDF. Those of several groups that share a name bear the group's in front: arm_home,
// hand_home.
std::vector<WrittenPose> poses_of(const SrdfFile& file) {
  std::map<std::string, int> count;
  for (const SrdfState& state : file.states) ++count[state.name];
  std::vector<WrittenPose> poses;
  for (const SrdfState& state : file.states) {
    const bool is_shared = count[state.name] > 1 && !state.group.empty();
    WrittenPose pose{
        is_shared ? state.group + "_" + state.name : state.name, {file.path, state.line}, {}, {}, true, true, ""};
    for (const SrdfValue& value : state.joints)
      pose.joints.push_back({value.joint, value.values, {file.path, value.line}});
    poses.push_back(std::move(pose));
  }
  return poses;
}

}  // namespace

// Where poses are read from.
struct SuitePoses::List {
  const YamlDocument& document;
  const std::string& suite;
  const SuiteModels& models;
  ProblemList& problems;
};

void SuitePoses::read(Fields& root, const std::string& suite, const SuiteModels& models) {
  if (root.has("poses")) read_list({root.document(), suite, models, root.problems()}, root.find("poses"), "poses", "");
}

void SuitePoses::read_list(const List& list, const YAML::Node& node, const std::string& path, const std::string& model) {
  if (!node.IsMap() || node.size() == 0)
    return list.problems.add("'" + path + "' must hold names and poses: poses: {home: [0, 0, 0], reach: {elbow: -90deg}}",
                             list.document.place_of(node, path));
  Fields fields(list.document, node, path, list.problems);
  for (const auto& pair : node) {
    const std::string& name = pair.first.Scalar();
    const std::vector<std::string> own = model.empty() ? list.models.called(name) : std::vector<std::string>{};
    if (own.size() > 1)
      list.problems.add("'" + name + "' could be any of " + joined(own) + ": name it as `model:` does", list.document.place_of(pair.first, name));
    else if (own.size() == 1)
      read_list(list, pair.second, fields.path(name), own.front());
    else if (name == "srdf")
      for (const auto& [named, where] : texts_of(list.document, pair.second, fields.path(name), "srdf: my_robot.srdf", list.problems))
        read_states(list, named, where, model);
    else
      read_pose(list, fields, pair, model);
  }
}

void SuitePoses::read_states(const List& list, const std::string& named, const Place& place, const std::string& model) {
  const std::string path = beside(list.suite, named);
  if (!require_file_of_suite(named, path, place, list.problems)) return;
  try {
    srdfs_.push_back({read_srdf(path), place, poses_.size(), 0, !model.empty()});
    for (WrittenPose& pose : poses_of(srdfs_.back().file)) {
      pose.model = model;
      poses_.push_back(std::move(pose));
    }
    srdfs_.back().end = poses_.size();
  } catch (const Error& error) {
    add_problems(error, list.problems);
  }
}

void SuitePoses::read_pose(const List& list, Fields& poses, const std::pair<YAML::Node, YAML::Node>& named, const std::string& model) {
  const std::string& name = named.first.Scalar();
  const YAML::Node& node = named.second;
  const Place place = poses.place_of(named.first, name);
  WrittenPose pose{name, place, {}, {}, node.IsMap(), false, model};
  bool is_good = !name.empty();
  if (!is_good) {
    list.problems.add("a pose has no name: poses: {home: [0, 0]}", place);
  } else if (name.ends_with(".urdf")) {
    is_good = false;
    list.problems.add("'" + name + "' is no model of the suite whose poses could stand here: name it under `model:`, too", place);
  } else if (node.IsSequence()) {
    is_good = poses.read(name, pose.numbers);
  } else if (node.IsMap()) {
    Fields joints(list.document, node, poses.path(name), list.problems);
    for (const auto& pair : node) {
      const std::string& joint = pair.first.Scalar();
      WrittenValue value{joint, {}, list.document.place_of(pair.first, joints.path(joint))};
      double one = 0;
      if (pair.second.IsSequence()) {
        is_good = joints.read(joint, value.values) && is_good;
      } else {
        is_good = joints.read(joint, one) && is_good;
        value.values = {one};
      }
      pose.joints.push_back(std::move(value));
    }
  } else {
    is_good = false;
    list.problems.add("pose '" + name + "' must be a list of numbers, [0, 90deg], or joints with theirs, {elbow: 90deg}", place);
  }
  if (is_good) poses_.push_back(std::move(pose));
}

std::vector<const WrittenPose*> SuitePoses::of(const std::string& model, const std::optional<std::string>& robot) {
  std::vector<bool> is_other(poses_.size());
  for (Srdf& srdf : srdfs_)
    for (std::size_t i = srdf.begin; i < srdf.end; ++i) {
      is_other[i] = robot && poses_[i].model.empty() && srdf.file.robot != *robot;
      srdf.is_used |= !is_other[i];
    }
  std::vector<const WrittenPose*> found;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    if (!is_other[i] && (poses_[i].model.empty() || poses_[i].model == model)) found.push_back(&poses_[i]);
  return found;
}

void SuitePoses::tell_idle(const std::string& robots, ProblemList& problems) const {
  for (const Srdf& srdf : srdfs_)
    if (!srdf.is_used)
      problems.add(srdf.file.path + " is of the robot '" + srdf.file.robot + "', which no model of the suite is: " + robots +
                       ". Give its <robot> one of these names, or name the file under its model: poses: {my_robot.urdf: {srdf: ..}}.",
                   srdf.place);
}

std::vector<double> resting_pose(const Chain& chain) {
  std::vector<double> q = zero_configuration(chain);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const bool leads =
        joint.kind != JointKind::floating && chain.coordinate_names[std::size_t(joint.v_index)] == joint.name;
    const bool excludes_zero = joint.limit.lower > 0 || joint.limit.upper < 0;
    if (!leads || !excludes_zero) continue;
    const bool is_bounded = std::isfinite(joint.limit.lower) && std::isfinite(joint.limit.upper);
    q[std::size_t(joint.q_index)] = is_bounded              ? (joint.limit.lower + joint.limit.upper) / 2
                                    : joint.limit.lower > 0 ? joint.limit.lower
                                                            : joint.limit.upper;
  }
  return q;
}

std::optional<std::vector<double>> pose_of(const WrittenPose& written, const UrdfFile& file,
                                           const Chain& chain, ProblemList& problems) {
  return PoseSetter(written, file, chain, problems).run();
}

}  // namespace chainreel
