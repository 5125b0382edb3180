#include "model/urdf_tree.hpp"

#include <unordered_map>

namespace chainreel {
namespace {

using NameIndex = std::unordered_map<std::string, int>;

template <class Named>
NameIndex index_of_names(const std::vector<Named>& items) {
  NameIndex index;
  for (std::size_t i = 0; i < items.size(); ++i) index.emplace(items[i].name, int(i));
  return index;
}

// The name that was likely meant, or else what to do.
template <class Named>
std::string remedy_for(const std::string& name, const std::vector<Named>& items, const UrdfProblems& problems,
                       const std::string& otherwise) {
  if (problems.is_full()) return "";  // the message will not be shown
  std::vector<std::string> names;
  for (const Named& item : items) names.push_back(item.name);
  const std::string near = near_name(name, names);
  return near.empty() ? otherwise : near;
}

std::string quoted_name(const std::string& name) {
  return "'" + name + "'";
}

// 'a', 'b', 'c' and 7 more
std::string first_names(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 5;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < kMost; ++i) text += (i == 0 ? "" : ", ") + quoted_name(names[i]);
  if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
  return text;
}

// Index of the link that a joint names, or -1 with a problem noted.
int find_link(const UrdfFile& file, const NameIndex& index, const UrdfJoint& joint, const std::string& name,
              const std::string& role, UrdfProblems& problems) {
  if (name.empty()) return -1;  // noted before
  const auto found = index.find(name);
  if (found != index.end()) return found->second;
  problems.add(joint.line, "joint " + quoted_name(joint.name) + " names the " + role + " link " + quoted_name(name) +
                               ", which does not exist:" +
                               remedy_for(name, file.links, problems, " add a <link> of that name"));
  return -1;
}

void find_root(UrdfFile& file, UrdfProblems& problems) {
  std::vector<std::string> roots;
  for (std::size_t i = 0; i < file.links.size(); ++i) {
    if (file.links[i].parent_joint >= 0) continue;
    if (roots.empty()) file.root = int(i);
    roots.push_back(file.links[i].name);
  }
  if (roots.size() > 1) {
    problems.add(file.links[std::size_t(file.root)].line,
                 "the model has " + std::to_string(roots.size()) + " roots, " + first_names(roots) +
                     ": every link but one must be the child of a joint");
  }
}

// Links that hang together in a loop are reached from no root.
void find_loops(const UrdfFile& file, UrdfProblems& problems) {
  std::vector<bool> reached(file.links.size(), false);
  for (std::size_t i = 0; i < file.links.size(); ++i) {
    if (file.links[i].parent_joint >= 0) continue;
    std::vector<int> open{int(i)};
    while (!open.empty()) {
      const int link = open.back();
      open.pop_back();
      reached[std::size_t(link)] = true;
      for (const int joint : file.links[std::size_t(link)].child_joints)
        open.push_back(file.joints[std::size_t(joint)].child);
    }
  }
  std::vector<std::string> lost;
  int line = 0;
  for (std::size_t i = 0; i < file.links.size(); ++i) {
    if (reached[i]) continue;
    if (lost.empty()) line = file.links[i].line;
    lost.push_back(file.links[i].name);
  }
  if (lost.empty()) return;
  problems.add(
      line, "the links " + first_names(lost) +
                " form a loop that hangs on nothing: a URDF is a tree, so remove the joint that closes it");
}

bool has_one_freedom(UrdfJointType type) {
  return type == UrdfJointType::revolute || type == UrdfJointType::continuous ||
         type == UrdfJointType::prismatic;
}

// Index of the joint that a mimic joint follows, or -1 with a problem noted.
int followed_joint(const UrdfFile& file, const NameIndex& index, const UrdfJoint& joint,
                   UrdfProblems& problems) {
  if (joint.mimic->joint.empty()) return -1;  // noted before
  const auto fail = [&](const std::string& message) {
    problems.add(joint.mimic->line, "joint " + quoted_name(joint.name) + message);
    return -1;
  };
  if (!has_one_freedom(joint.type)) {
    return fail(" is " + to_string(joint.type) +
                " and cannot mimic: only revolute, continuous and prismatic joints can");
  }
  const auto found = index.find(joint.mimic->joint);
  if (found == index.end()) {
    return fail(" mimics " + quoted_name(joint.mimic->joint) + ", which does not exist:" +
                remedy_for(joint.mimic->joint, file.joints, problems, " name a joint of this file"));
  }
  const UrdfJoint& followed = file.joints[std::size_t(found->second)];
  if (&followed == &joint) return fail(" mimics itself: name the joint that it follows");
  if (!has_one_freedom(followed.type)) {
    return fail(" mimics " + quoted_name(followed.name) + ", which is " + to_string(followed.type) +
                ": follow a revolute, continuous or prismatic joint");
  }
  return found->second;
}

}  // namespace

void connect_links(CheckedUrdf& urdf, UrdfProblems& problems) {
  UrdfFile& file = urdf.file;
  const NameIndex index = index_of_names(file.links);
  // Only the first of links without a name or with the same one can be found: the others would seem to be
  // lost.
  bool all_known = !file.links.empty() && index.size() == file.links.size() && !index.contains("");
  for (std::size_t j = 0; j < file.joints.size(); ++j) {
    UrdfJoint& joint = file.joints[j];
    joint.parent = find_link(file, index, joint, urdf.parent_names[j], "parent", problems);
    joint.child = find_link(file, index, joint, urdf.child_names[j], "child", problems);
    if (joint.parent < 0 || joint.child < 0) {
      all_known = false;
      continue;
    }
    if (joint.parent == joint.child) {
      problems.add(joint.line, "joint " + quoted_name(joint.name) + " joins link " + quoted_name(urdf.child_names[j]) +
                                   " to itself: name another parent");
      all_known = false;
      continue;
    }
    UrdfLink& child = file.links[std::size_t(joint.child)];
    if (child.parent_joint >= 0) {
      const UrdfJoint& other = file.joints[std::size_t(child.parent_joint)];
      problems.add(joint.line, "link " + quoted_name(child.name) + " is the child of two joints, " +
                                   quoted_name(other.name) + " (line " + std::to_string(other.line) + ") and " +
                                   quoted_name(joint.name) + ": a link hangs on one");
      all_known = false;
      continue;
    }
    child.parent_joint = int(j);
    file.links[std::size_t(joint.parent)].child_joints.push_back(int(j));
  }
  // What hangs on an unknown link would be named a second root.
  if (!all_known) return;
  find_root(file, problems);
  find_loops(file, problems);
}

void check_mimics(const UrdfFile& file, UrdfProblems& problems) {
  const NameIndex index = index_of_names(file.joints);
  std::vector<int> follows(file.joints.size(), -1);
  for (std::size_t j = 0; j < file.joints.size(); ++j)
    if (file.joints[j].mimic) follows[j] = followed_joint(file, index, file.joints[j], problems);

  // Walk from every joint until the walk meets itself or an earlier one.
  std::vector<std::size_t> walk(file.joints.size(), 0);
  for (std::size_t start = 0; start < file.joints.size(); ++start) {
    for (int at = int(start); at >= 0; at = follows[std::size_t(at)]) {
      std::size_t& seen = walk[std::size_t(at)];
      if (seen == start + 1) {
        const UrdfJoint& joint = file.joints[std::size_t(at)];
        problems.add(joint.mimic->line,
                     "joint " + quoted_name(joint.name) +
                         " closes a ring of mimic joints that only follow each other: one of them "
                         "must be free");
      }
      if (seen != 0) break;
      seen = start + 1;
    }
  }
}

std::vector<int> depth_first_links(const UrdfFile& file) {
  std::vector<int> order;
  std::vector<int> open{file.root};
  while (!open.empty()) {
    const int link = open.back();
    open.pop_back();
    order.push_back(link);
    const std::vector<int>& joints = file.links[std::size_t(link)].child_joints;
    // The last one pushed is visited first.
    for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint)
      open.push_back(file.joints[std::size_t(*joint)].child);
  }
  return order;
}

}  // namespace chainreel
