#include "model/model_match.hpp"

#include <algorithm>
#include <unordered_map>

namespace chainreel {
namespace {

bool is_same(const UrdfOrigin& a, const UrdfOrigin& b) {
  return a.xyz == b.xyz && a.rpy == b.rpy;
}

bool is_same(const std::optional<UrdfInertial>& a, const std::optional<UrdfInertial>& b) {
  if (!a || !b) return !a && !b;
  return is_same(a->origin, b->origin) && a->mass == b->mass && a->inertia == b->inertia;
}

constexpr int kMostRenamed = 300;

int joint_above(const ModelDescription& model, int link) {
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (model.joints[i].child == link) return int(i);
  return -1;
}

template <class List>
void match_by_name(const List& before, const List& after, std::vector<int>& there, std::vector<int>& back) {
  there.assign(before.size(), -1);
  back.assign(after.size(), -1);
  std::unordered_map<std::string, int> names;
  for (std::size_t i = 0; i < after.size(); ++i) names.emplace(after[i].name, int(i));
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto found = names.find(before[i].name);
    if (found == names.end() || back[std::size_t(found->second)] >= 0) continue;
    there[i] = found->second;
    back[std::size_t(found->second)] = int(i);
  }
}

class Matcher {
 public:
  Matcher(const ModelDescription& before, const ModelDescription& after) : before_(before), after_(after) {}

  ModelMatch run() {
    match_by_name(before_.links, after_.links, match_.links, match_.links_of);
    match_by_name(before_.joints, after_.joints, match_.joints, match_.joints_of);
    // Of two robots that have nothing in common none is the other's root under another name.
    const bool have_something =
        std::any_of(match_.links.begin(), match_.links.end(), [](int link) { return link >= 0; });
    if (have_something || is_alike(before_.root, after_.root)) match_links(before_.root, after_.root);
    // A link that is found lets others be found below it. Of files with very many other links nobody asks for
    // names.
    for (int looks = 0; looks < kMostRenamed && match_one_more_link(); ++looks) {
    }
    for (std::size_t i = 0; i < after_.joints.size(); ++i) {
      if (match_.joints_of[i] >= 0) continue;
      const int link = match_.links_of[std::size_t(after_.joints[i].child)];
      const int joint = link < 0 ? -1 : joint_above(before_, link);
      if (joint < 0 || match_.joints[std::size_t(joint)] >= 0) continue;
      match_.joints[std::size_t(joint)] = int(i);
      match_.joints_of[i] = joint;
    }
    return std::move(match_);
  }

 private:
  bool match_links(int before, int after) {
    if (match_.links[std::size_t(before)] >= 0 || match_.links_of[std::size_t(after)] >= 0) return false;
    match_.links[std::size_t(before)] = after;
    match_.links_of[std::size_t(after)] = before;
    return true;
  }

  bool match_one_more_link() {
    for (std::size_t i = 0; i < after_.joints.size(); ++i)
      if (const int joint = match_.joints_of[i]; joint >= 0)
        if (match_links(before_.joints[std::size_t(joint)].child, after_.joints[i].child)) return true;
    for (const UrdfJoint& old : before_.joints) {
      if (match_.links[std::size_t(old.child)] >= 0) continue;
      for (const UrdfJoint& joint : after_.joints)
        if (match_.links_of[std::size_t(joint.child)] < 0 &&
            match_.links[std::size_t(old.parent)] == joint.parent && old.type == joint.type &&
            is_same(old.origin, joint.origin) && is_alike(old.child, joint.child))
          return match_links(old.child, joint.child);
    }
    return false;
  }

  bool is_alike(int before, int after) const {
    const DescribedLink &a = before_.links[std::size_t(before)], &b = after_.links[std::size_t(after)];
    if (!is_same(a.inertial, b.inertial) || a.visuals.size() != b.visuals.size()) return false;
    for (std::size_t i = 0; i < a.visuals.size(); ++i)
      if (!chainreel::is_same(a.visuals[i], before_, b.visuals[i], after_)) return false;
    return true;
  }

  const ModelDescription &before_, &after_;
  ModelMatch match_;
};

}  // namespace

bool is_same(const DescribedMesh& a, const DescribedMesh& b) {
  return a.sketch && b.sketch ? *a.sketch == *b.sketch : a.file == b.file && !a.sketch && !b.sketch;
}

bool is_same(const DescribedShape& a, const ModelDescription& of_a, const DescribedShape& b,
             const ModelDescription& of_b) {
  if (a.shape.kind != b.shape.kind || !is_same(a.shape.origin, b.shape.origin) || a.color != b.color)
    return false;
  if (a.shape.kind != UrdfShapeKind::mesh) return a.shape.size == b.shape.size;
  return a.shape.mesh_scale == b.shape.mesh_scale &&
         is_same(of_a.meshes[std::size_t(a.mesh)], of_b.meshes[std::size_t(b.mesh)]);
}

ModelMatch match(const ModelDescription& before, const ModelDescription& after) {
  return Matcher(before, after).run();
}

}  // namespace chainreel
