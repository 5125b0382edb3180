#include "model/reduce.hpp"

#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "model/principal_moments.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {
namespace {

// A body that gets its mass from the option `massless` has this radius of gyration, m.
constexpr double kMasslessRadius = 0.01;

// Unit length without overflow or underflow on the way.
Eigen::Vector3d unit_of(const Eigen::Vector3d& v) {
  const Eigen::Vector3d scaled = v / v.cwiseAbs().maxCoeff();
  return scaled / scaled.norm();
}

Inertia inertia_of(const UrdfInertial& inertial, const Eigen::Isometry3d& X_BL) {
  const Eigen::Isometry3d X_BI = X_BL * isometry_of(inertial.origin);
  const Eigen::Matrix3d R = X_BI.linear();
  return {inertial.mass, X_BI.translation(), R * inertial.inertia * R.transpose()};
}

class Reducer {
 public:
  Reducer(const UrdfFile& file, const ModelOptions& options)
      : file_(file), options_(options), problems_(file.problems()) {
    for (const UrdfJoint& joint : file_.joints) joint_names_.insert(joint.name);
  }

  ReducedModel run() {
    chain_.name = file_.name;
    result_.link_of_body = {-1};
    parts_.resize(1);
    part_links_.resize(1);
    place_.resize(file_.links.size());
    for (const int link : depth_first_links(file_)) place_link(link);
    number_coordinates();
    lump();
    finish();
    problems_.throw_if_any();
    return std::move(result_);
  }

 private:
  // Where a link sits: its body and its pose there.
  struct LinkPlace {
    int body = 0;
    Eigen::Isometry3d X_BL = Eigen::Isometry3d::Identity();
  };

  void place_link(int index) {
    const UrdfLink& link = file_.links[std::size_t(index)];
    LinkPlace& place = place_[std::size_t(index)];
    if (link.parent_joint >= 0) {
      const UrdfJoint& joint = file_.joints[std::size_t(link.parent_joint)];
      const LinkPlace& parent = place_[std::size_t(joint.parent)];
      const Eigen::Isometry3d X_PJ = parent.X_BL * isometry_of(joint.origin);
      if (joint.type == UrdfJointType::fixed) {
        place = {parent.body, X_PJ};
      } else {
        place.body = add_joint(joint, index, parent.body, X_PJ);
      }
    } else if (options_.floating_base) {
      Joint base;
      base.name = base_joint_name();
      base.kind = JointKind::floating;
      place.body = add_body(std::move(base), index, 0);
    }

    if (link.child_joints.empty()) chain_.leaf_frames.push_back(int(chain_.frames.size()));
    chain_.frames.push_back({link.name, place.body, place.X_BL});
    if (!link.inertial) return;
    part_links_[std::size_t(place.body)].push_back(index);
    parts_[std::size_t(place.body)].push_back(inertia_of(*link.inertial, place.X_BL));
  }

  std::string base_joint_name() const {
    std::string name = "base";
    while (joint_names_.contains(name)) name = "floating_" + name;
    return name;
  }

  int add_body(Joint joint, int link, int parent) {
    const bool is_massless = link < 0;
    Body body;
    body.name = is_massless ? joint.name : file_.links[std::size_t(link)].name;
    body.parent = parent;
    body.joint = std::move(joint);
    chain_.bodies.push_back(std::move(body));
    result_.link_of_body.push_back(link);
    parts_.emplace_back();
    part_links_.emplace_back();
    return int(chain_.bodies.size()) - 1;
  }

  int add_joint(const UrdfJoint& from, int link, int parent, const Eigen::Isometry3d& X_PJ) {
    Joint joint;
    joint.name = from.name;
    joint.X_PJ = X_PJ;
    if (options_.friction) {
      joint.damping = from.damping;
      joint.friction = from.friction;
    }
    joint.limit = limit_of(from);
    if (from.type == UrdfJointType::floating) {
      joint.kind = JointKind::floating;
      return add_body(std::move(joint), link, parent);
    }
    const Eigen::Vector3d axis = unit_of(from.axis);
    if (from.type == UrdfJointType::planar) return add_planar_joint(joint, axis, link, parent);
    joint.kind = from.type == UrdfJointType::prismatic ? JointKind::prismatic : JointKind::revolute;
    joint.axis = axis;
    const int body = add_body(std::move(joint), link, parent);
    if (from.mimic) mimics_.emplace(from.name, body);
    joints_.emplace(from.name, &from);
    return body;
  }

  // Two displacements, then the angle about the normal; damping and friction act on each of the three.
  int add_planar_joint(Joint joint, const Eigen::Vector3d& normal, int link, int parent) {
    const auto [x, y] = in_plane_axes(normal);
    const std::string name = joint.name;
    for (const char* part : {".x", ".y", ".angle"}) {
      if (!joint_names_.contains(name + part)) continue;
      problems_.add(file_.links[std::size_t(link)].line,
                    "joint '" + name + part + "' has the name of a part of the planar joint '" + name +
                        "': give it another");
    }
    joint.name = name + ".x";
    joint.kind = JointKind::prismatic;
    joint.axis = x;
    const int first = add_body(joint, -1, parent);
    joint.name = name + ".y";
    joint.axis = y;
    joint.X_PJ = Eigen::Isometry3d::Identity();
    const int second = add_body(joint, -1, first);
    joint.name = name + ".angle";
    joint.kind = JointKind::revolute;
    joint.axis = normal;
    return add_body(joint, link, second);
  }

  static JointLimit limit_of(const UrdfJoint& joint) {
    JointLimit limit;
    const bool is_bounded = joint.type == UrdfJointType::revolute || joint.type == UrdfJointType::prismatic;
    if (joint.limit.given && is_bounded) {
      limit.lower = joint.limit.lower;  // 0 where it is not written, as the format has it
      limit.upper = joint.limit.upper;
    }
    if (joint.limit.has_effort) limit.effort = joint.limit.effort;
    if (joint.limit.has_velocity) limit.velocity = joint.limit.velocity;
    return limit;
  }

  // Joints with a coordinate of their own are numbered first, whatever their place among the followers.
  void number_coordinates() {
    std::unordered_map<std::string, int> known;
    for (std::size_t i = 1; i < chain_.bodies.size(); ++i) {
      Joint& joint = chain_.bodies[i].joint;
      if (mimics_.contains(joint.name)) continue;
      joint.q_index = chain_.nq;
      joint.v_index = chain_.nv;
      known.emplace(joint.name, int(i));
      const bool is_floating = joint.kind == JointKind::floating;
      chain_.nq += is_floating ? 7 : 1;
      chain_.nv += is_floating ? 6 : 1;
      name_coordinates(joint);
    }
    for (const auto& [name, body] : mimics_) resolve_mimic(name, known);
  }

  // value = r1 (r2 q + o2) + o1 where a follower is followed. Goes up to the first joint with a known
  // coordinate and comes back down, so that long rows of followers stay cheap.
  void resolve_mimic(const std::string& name, std::unordered_map<std::string, int>& known) {
    std::vector<std::string> row;
    for (std::string at = name; !known.contains(at); at = joints_.at(at)->mimic->joint) row.push_back(at);
    for (; !row.empty(); row.pop_back()) {
      const UrdfMimic& mimic = *joints_.at(row.back())->mimic;
      const Joint& leader = chain_.bodies[std::size_t(known.at(mimic.joint))].joint;
      const int body = mimics_.at(row.back());
      Joint& joint = chain_.bodies[std::size_t(body)].joint;
      joint.q_index = leader.q_index;
      joint.v_index = leader.v_index;
      joint.ratio = mimic.multiplier * leader.ratio;
      joint.offset = mimic.multiplier * leader.offset + mimic.offset;
      known.emplace(row.back(), body);
    }
  }

  void name_coordinates(const Joint& joint) {
    if (joint.kind != JointKind::floating) {
      chain_.coordinate_names.push_back(joint.name);
      return;
    }
    for (const char* part : {"vx", "vy", "vz", "wx", "wy", "wz"})
      chain_.coordinate_names.push_back(joint.name + "." + part);
  }

  void lump() {
    std::vector<bool> is_leaf(chain_.bodies.size(), true);
    for (const Body& body : chain_.bodies) is_leaf[std::size_t(body.parent)] = false;
    chain_.bodies[0].inertia = lumped(parts_[0]);  // loads the ground alone
    for (std::size_t i = 1; i < chain_.bodies.size(); ++i) {
      Inertia& inertia = chain_.bodies[i].inertia;
      inertia = lumped(parts_[i]);
      require_positive(i);
      const bool weighs_nothing = inertia.mass == 0 && inertia.about_com.cwiseAbs().maxCoeff() < kNoMoment;
      if (result_.link_of_body[i] < 0 || !weighs_nothing) continue;
      if (options_.massless) {
        inertia.mass = *options_.massless;
        inertia.about_com = inertia.mass * kMasslessRadius * kMasslessRadius * Eigen::Matrix3d::Identity();
      } else if (parts_[i].empty() || is_leaf[i]) {
        complain_of_massless(i);
      }
    }
  }

  // A light link may carry what a file's few digits left of a thin direction, where the body that it is fixed to has
  // enough; what the whole body lacks comes from a part.
  void require_positive(std::size_t body) {
    if (is_positive(principal_moments(chain_.bodies[body].inertia.about_com))) return;
    for (const int part : part_links_[body]) {
      const UrdfLink& link = file_.links[std::size_t(part)];
      const Eigen::Vector3d moments = principal_moments(link.inertial->inertia);
      if (is_positive(moments)) continue;
      const bool is_alone = part_links_[body].size() == 1;
      problems_.add(link.inertial->line,
                    "link '" + link.name + "' has an inertia that is not positive (principal moments " +
                        moments_text(moments) + (is_alone ? ")" : "), and what it is fixed to does not make up for it") +
                        ": no body has one, so correct it");
    }
  }

  void complain_of_massless(std::size_t body) {
    const UrdfLink& link = file_.links[std::size_t(result_.link_of_body[body])];
    problems_.add(
        link.line,
        "link '" + link.name + "' moves (joint '" + chain_.bodies[body].joint.name + "') but " +
            (link.inertial ? "weighs nothing" : "has no <inertial>") +
            ": give it a mass and an inertia, make its joint fixed, or let it have a small mass (kg) with "
            "`--set massless=1e-6`, in a scene `massless: 1e-6`");
  }

  void finish() {
    std::vector<int> children(chain_.bodies.size(), 0);
    for (std::size_t i = 1; i < chain_.bodies.size(); ++i) {
      const Body& body = chain_.bodies[i];
      if (++children[std::size_t(body.parent)] > 1) chain_.serial = false;
      chain_.has_floating |= body.joint.kind == JointKind::floating;
      chain_.has_dissipation |= body.joint.damping > 0 || body.joint.friction > 0;
    }
    chain_.has_mimic = !mimics_.empty();
    if (chain_.bodies.size() > 1) return;
    problems_.add(file_.links[std::size_t(file_.root)].line,
                  "nothing moves: every joint is fixed. Give one the type revolute, continuous or prismatic, "
                  "or let the "
                  "base float with `--base floating`");
  }

  const UrdfFile& file_;
  const ModelOptions& options_;
  UrdfProblems problems_;
  ReducedModel result_;
  Chain& chain_ = result_.chain;
  std::unordered_set<std::string> joint_names_;               // of the file
  std::vector<LinkPlace> place_;                              // per link
  std::vector<std::vector<Inertia>> parts_;                   // per body
  std::vector<std::vector<int>> part_links_;                  // of each part its link
  std::unordered_map<std::string, int> mimics_;               // joint name -> its body
  std::unordered_map<std::string, const UrdfJoint*> joints_;  // those that may follow or be followed
};

}  // namespace

Inertia lumped(const std::vector<Inertia>& parts) {
  if (parts.size() == 1) return parts[0];
  Inertia whole;
  for (const Inertia& part : parts) {
    whole.mass += part.mass;
    whole.com += part.mass * part.com;
  }
  if (whole.mass > 0) whole.com /= whole.mass;
  for (const Inertia& part : parts) {
    const Eigen::Vector3d d = part.com - whole.com;
    whole.about_com +=
        part.about_com + part.mass * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  }
  return whole;
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> in_plane_axes(const Eigen::Vector3d& normal) {
  int largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  const Eigen::Vector3d next = Eigen::Vector3d::Unit((largest + 1) % 3);
  const Eigen::Vector3d x = unit_of(next - normal.dot(next) * normal);
  return {x, normal.cross(x)};
}

ReducedModel reduce(const UrdfFile& file, const ModelOptions& options) {
  return Reducer(file, options).run();
}

}  // namespace chainreel
