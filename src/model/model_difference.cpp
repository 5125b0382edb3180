#include "model/model_difference.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/change_words.hpp"
#include "core/format.hpp"
#include "model/model_match.hpp"
#include "model/shape_difference.hpp"

namespace chainreel {
namespace {

constexpr const char* kAxes = "xyz";

std::string vector_text(const Eigen::Vector3d& v) {
  return format_shortest(v.x()) + " " + format_shortest(v.y()) + " " + format_shortest(v.z());
}

bool has_axis(UrdfJointType type) {
  return type != UrdfJointType::fixed && type != UrdfJointType::floating;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Of a URDF whose `lower` or `upper` are not written, or do not count for this type of joint, none.
struct LimitValue {
  const char* name;
  const char* angular;
  const char* linear;
  std::optional<double> (*value)(const UrdfJoint& joint);
};
bool is_bounded(const UrdfJoint& joint) {
  return joint.limit.given &&
         (joint.type == UrdfJointType::revolute || joint.type == UrdfJointType::prismatic);
}
constexpr LimitValue kLimits[] = {
    {"lower limit", "rad", "m",
     [](const UrdfJoint& joint) {
       return is_bounded(joint) ? std::optional(joint.limit.lower) : std::nullopt;
     }},
    {"upper limit", "rad", "m",
     [](const UrdfJoint& joint) {
       return is_bounded(joint) ? std::optional(joint.limit.upper) : std::nullopt;
     }},
    {"limit of effort", "N m", "N",
     [](const UrdfJoint& joint) {
       return joint.limit.has_effort ? std::optional(joint.limit.effort) : std::nullopt;
     }},
    {"limit of velocity", "rad/s", "m/s",
     [](const UrdfJoint& joint) {
       return joint.limit.has_velocity ? std::optional(joint.limit.velocity) : std::nullopt;
     }},
};

std::string payload_text(const Payload& payload) {
  if (!(payload.mass > 0)) return "none";
  return format_shortest(payload.mass) + " kg at " + vector_text(payload.at) + " of " + payload.link;
}

class ModelComparison {
 public:
  ModelComparison(const ModelDescription& before, const ModelDescription& after)
      : before_(before), after_(after), match_(match(before, after)) {}

  std::vector<ModelDifference> run() {
    compare_names();
    for (std::size_t i = 0; i < after_.joints.size(); ++i)
      if (match_.joints_of[i] >= 0)
        compare(before_.joints[std::size_t(match_.joints_of[i])], after_.joints[i]);
    for (std::size_t i = 0; i < after_.links.size(); ++i)
      if (match_.links_of[i] >= 0) compare(before_.links[std::size_t(match_.links_of[i])], after_.links[i]);
    compare_reading();
    std::stable_sort(found_.begin(), found_.end(),
                     [](const ModelDifference& a, const ModelDifference& b) { return a.change < b.change; });
    return std::move(found_);
  }

 private:
  void tell(ModelChange change, const std::string& words, int line = 0) {
    found_.push_back({change, words + (line > 0 ? ", URDF line " + std::to_string(line) : "")});
  }

  template <class List>
  void compare_names(const char* what, const List& before, const List& after, const std::vector<int>& there,
                     const std::vector<int>& back) {
    for (std::size_t i = 0; i < before.size(); ++i)
      if (there[i] < 0) tell(ModelChange::structure, std::string(what) + " " + before[i].name + ": gone");
    for (std::size_t i = 0; i < after.size(); ++i)
      if (back[i] < 0)
        tell(ModelChange::structure, std::string(what) + " " + after[i].name + ": added", after[i].line);
      else if (const std::string& old = before[std::size_t(back[i])].name; old != after[i].name)
        tell(ModelChange::structure, std::string(what) + " " + old + ": renamed to " + after[i].name,
             after[i].line);
  }

  // What a link or a joint of `before` is called in `after`; its old name where it is gone.
  std::string link_now(int link) const {
    const int now = match_.links[std::size_t(link)];
    return now < 0 ? before_.links[std::size_t(link)].name : after_.links[std::size_t(now)].name;
  }
  std::string joint_now(const std::string& name) const {
    for (std::size_t i = 0; i < before_.joints.size(); ++i)
      if (before_.joints[i].name == name && match_.joints[i] >= 0)
        return after_.joints[std::size_t(match_.joints[i])].name;
    return name;
  }
  std::string coordinate_now(const std::string& name) const {
    const std::string now = joint_now(name);
    const std::size_t dot = name.rfind('.');  // of planar and floating joints
    return now != name || dot == std::string::npos ? now : joint_now(name.substr(0, dot)) + name.substr(dot);
  }

  void compare_names() {
    if (before_.name != after_.name)
      tell(ModelChange::looks, "model: renamed from " + before_.name + " to " + after_.name);
    const auto kept =
        std::count_if(match_.joints.begin(), match_.joints.end(), [](int joint) { return joint >= 0; });
    if (2 * std::size_t(kept) < std::max(before_.joints.size(), after_.joints.size()))
      tell(ModelChange::structure, "another robot: " + std::to_string(kept) + " of its " +
                                       std::to_string(after_.joints.size()) + " joints were there before");
    compare_names("link", before_.links, after_.links, match_.links, match_.links_of);
    compare_names("joint", before_.joints, after_.joints, match_.joints, match_.joints_of);
    if (link_now(before_.root) != after_.links[std::size_t(after_.root)].name)
      tell(ModelChange::structure,
           "root link " + change_text(link_now(before_.root), after_.links[std::size_t(after_.root)].name));
    compare_order();
  }

  // The numbers of q stand in the order in which joints hang in the file.
  void compare_order() {
    std::vector<std::string> before, after;
    for (const DescribedCoordinate& one : before_.coordinates) before.push_back(coordinate_now(one.name));
    for (const DescribedCoordinate& one : after_.coordinates) after.push_back(one.name);
    if (before == after) return;
    const std::string words = "order of coordinates " + change_text(joined(before), joined(after));
    std::sort(before.begin(), before.end());
    std::sort(after.begin(), after.end());
    if (before == after) tell(ModelChange::structure, words);
  }

  void compare(const UrdfJoint& before, const UrdfJoint& after) {
    const std::string joint = "joint " + after.name + ": ";
    if (before.type != after.type)
      tell(ModelChange::joint, joint + "type " + change_text(to_string(before.type), to_string(after.type)),
           after.line);
    if (match_.links[std::size_t(before.parent)] != after.parent)
      tell(ModelChange::structure,
           joint + "its parent link " +
               change_text(link_now(before.parent), after_.links[std::size_t(after.parent)].name),
           after.line);
    if (match_.links[std::size_t(before.child)] != after.child)
      tell(ModelChange::structure,
           joint + "its child link " +
               change_text(link_now(before.child), after_.links[std::size_t(after.child)].name),
           after.line);
    for (const std::string& words : origin_changes(before.origin, after.origin))
      tell(ModelChange::joint, joint + "origin " + words, after.line);
    compare_axes(joint, before, after);
    compare_mimic(joint, before.mimic, after.mimic, after.line);
    compare_resistance(joint, before, after);
  }

  void compare_axes(const std::string& joint, const UrdfJoint& before, const UrdfJoint& after) {
    if (!has_axis(before.type) || !has_axis(after.type)) return;
    const Eigen::Vector3d a = before.axis.normalized(), b = after.axis.normalized();
    if (a == b) return;
    const bool is_turned_round = a == -b;
    tell(ModelChange::joint,
         joint + "axis turned " + (is_turned_round ? "round" : "by " + angle_text(angle_between(a, b))) +
             " (" + change_text(vector_text(before.axis), vector_text(after.axis)) + ")",
         after.line);
  }

  void compare_mimic(const std::string& joint, const std::optional<UrdfMimic>& before,
                     const std::optional<UrdfMimic>& after, int line) {
    if (!before && !after) return;
    if (!before)
      return tell(ModelChange::joint, joint + "follows joint " + after->joint + " now (mimic)", after->line);
    const std::string leader = joint_now(before->joint);
    if (!after)
      return tell(ModelChange::joint, joint + "does not follow joint " + leader + " any more (mimic)", line);
    if (leader != after->joint)
      tell(ModelChange::joint, joint + "mimic joint " + change_text(leader, after->joint), after->line);
    if (before->multiplier != after->multiplier)
      tell(ModelChange::joint,
           joint + "mimic multiplier " + change_text(before->multiplier, after->multiplier, ""), after->line);
    if (before->offset != after->offset)
      tell(ModelChange::joint, joint + "mimic offset " + change_text(before->offset, after->offset, ""),
           after->line);
  }

  void compare_resistance(const std::string& joint, const UrdfJoint& before, const UrdfJoint& after) {
    if (after.type == UrdfJointType::fixed) return;
    const bool is_linear = after.type == UrdfJointType::prismatic;
    const auto compare = [&](const char* what, double old, double now, const char* angular,
                             const char* linear) {
      if (old != now)
        tell(ModelChange::resistance,
             joint + what + " " + change_text(old, now, is_linear ? linear : angular), after.line);
    };
    compare("damping", before.damping, after.damping, "N m s/rad", "N s/m");
    compare("friction", before.friction, after.friction, "N m", "N");
    for (const LimitValue& limit : kLimits) {
      const std::optional<double> old = limit.value(before), now = limit.value(after);
      const std::string unit = is_linear ? limit.linear : limit.angular;
      const int line = after.limit.given ? after.limit.line : after.line;
      const auto text = [&](const std::optional<double>& value) {
        return value ? format_shortest(*value) + " " + unit : "none";
      };
      if (old != now)
        tell(ModelChange::limit,
             joint + limit.name + " " +
                 (old && now ? change_text(*old, *now, unit) : change_text(text(old), text(now))),
             line);
    }
  }

  void compare(const DescribedLink& before, const DescribedLink& after) {
    compare_inertia(after.name, before.inertial, after.inertial, after.line);
    for (const ShapeDifference& one : shape_differences({before_, before.visuals}, {after_, after.visuals},
                                                        after.name, "visual", told_meshes_))
      tell(ModelChange::looks, one.words, one.line);
    for (const ShapeDifference& one : shape_differences(
             {before_, before.collisions}, {after_, after.collisions}, after.name, "collision", told_meshes_))
      tell(ModelChange::looks, one.words, one.line);
  }

  void compare_inertia(const std::string& name, const std::optional<UrdfInertial>& before,
                       const std::optional<UrdfInertial>& after, int link_line) {
    if (!before && !after) return;
    const std::string link = "link " + name + ": ", of_link = "inertia of link " + name + ": ";
    if (!before)
      return tell(ModelChange::mass,
                  link + "has an inertia now, mass " + format_shortest(after->mass) + " kg", after->line);
    if (!after)
      return tell(ModelChange::mass,
                  link + "has no inertia any more, mass was " + format_shortest(before->mass) + " kg",
                  link_line);
    if (before->mass != after->mass)
      tell(ModelChange::mass, link + "mass " + change_text(before->mass, after->mass, "kg"), after->mass_line);
    if (before->origin.xyz != after->origin.xyz)
      tell(ModelChange::mass, link + "centre of mass " + move_words(before->origin.xyz, after->origin.xyz),
           after->line);
    if (const std::string turn = turn_words(before->origin, after->origin); !turn.empty())
      tell(ModelChange::mass, of_link + "its axes " + turn, after->line);
    std::vector<std::string> entries;
    for (int i = 0; i < 3; ++i)
      for (int k = i; k < 3; ++k)
        if (before->inertia(i, k) != after->inertia(i, k))
          entries.push_back(std::string("I") + kAxes[i] + kAxes[k] + " " +
                            change_text(before->inertia(i, k), after->inertia(i, k), ""));
    if (!entries.empty()) tell(ModelChange::mass, of_link + joined(entries) + " kg m^2", after->line);
  }

  void compare_reading() {
    if (before_.gravity != after_.gravity)
      tell(ModelChange::reading,
           "gravity " + change_text(vector_text(before_.gravity), vector_text(after_.gravity)) + " m/s^2");
    if (before_.floating_base != after_.floating_base)
      tell(ModelChange::reading,
           std::string("base ") + (after_.floating_base ? "fixed -> floating" : "floating -> fixed"));
    if (before_.friction != after_.friction)
      tell(ModelChange::reading, std::string("damping and friction of joints ") +
                                     (after_.friction ? "act now" : "do not act any more"));
    const auto mass = [](const std::optional<double>& value) {
      return value ? format_shortest(*value) + " kg" : "none";
    };
    if (before_.massless != after_.massless)
      tell(ModelChange::reading,
           "mass of links without inertia " + change_text(mass(before_.massless), mass(after_.massless)));
    const auto link_named_now = [this](std::string name) {
      for (std::size_t i = 0; i < before_.links.size(); ++i)
        if (before_.links[i].name == name) return link_now(int(i));
      return name;
    };
    Payload payload = before_.payload;
    payload.link = link_named_now(payload.link);
    if (payload != after_.payload) tell(ModelChange::mass, "payload " + change_text(payload_text(payload), payload_text(after_.payload)));
    const std::string end = link_named_now(before_.end_effector);
    const auto named = [](const std::string& name) { return name.empty() ? "none" : name; };
    if (end != after_.end_effector)
      tell(ModelChange::reading, "end effector " + change_text(named(end), named(after_.end_effector)));
  }

  const ModelDescription &before_, &after_;
  ModelMatch match_;
  std::vector<ModelDifference> found_;
  ToldMeshes told_meshes_;
};

}  // namespace

std::vector<ModelDifference> differences(const ModelDescription& before, const ModelDescription& after) {
  return ModelComparison(before, after).run();
}

}  // namespace chainreel
