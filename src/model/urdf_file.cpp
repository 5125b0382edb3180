#include "model/urdf_file.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include "core/scalar.hpp"
#include "model/urdf_check.hpp"
#include "model/urdf_problems.hpp"
#include "model/urdf_tree.hpp"

namespace chainreel {

Eigen::Isometry3d isometry_of(const UrdfOrigin& origin) {
  const auto [sr, cr] = sin_cos(origin.rpy[0]);
  const auto [sp, cp] = sin_cos(origin.rpy[1]);
  const auto [sy, cy] = sin_cos(origin.rpy[2]);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,            //
      -sp, cp * sr, cp * cr;
  X.translation() = origin.xyz;
  return X;
}

std::string to_string(UrdfJointType type) {
  switch (type) {
    case UrdfJointType::revolute:
      return "revolute";
    case UrdfJointType::continuous:
      return "continuous";
    case UrdfJointType::prismatic:
      return "prismatic";
    case UrdfJointType::fixed:
      return "fixed";
    case UrdfJointType::floating:
      return "floating";
    case UrdfJointType::planar:
      return "planar";
  }
  return "";
}

UrdfFile read_urdf_file(const ModelSource& source) {
  UrdfProblems problems = source.links ? UrdfProblems(source.place) : UrdfProblems(source.path);
  CheckedUrdf urdf = check_urdf(source.urdf(), source.path, problems);
  if (source.links) urdf.file.asked = source.place;
  connect_links(urdf, problems);
  check_mimics(urdf.file, problems);
  problems.throw_if_any();
  read_urdf_values(urdf.plain, urdf.file);
  urdf.file.remarks = problems.take_remarks();
  return std::move(urdf.file);
}

namespace {

// urdfdom reports through one global handler; this one keeps what it says for our own message.
class LogCapture : public console_bridge::OutputHandler {
 public:
  LogCapture() : previous_(console_bridge::getOutputHandler()) { console_bridge::useOutputHandler(this); }
  ~LogCapture() override { console_bridge::useOutputHandler(previous_); }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR || text_.size() > 500) return;
    text_ += (text_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return text_; }

 private:
  console_bridge::OutputHandler* previous_;
  std::string text_;
};

Eigen::Vector3d vector_of(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

void read_inertial(const urdf::Inertial& from, UrdfInertial& to) {
  to.origin.xyz = vector_of(from.origin.position);
  to.mass = from.mass;
  to.inertia << from.ixx, from.ixy, from.ixz,  //
      from.ixy, from.iyy, from.iyz,            //
      from.ixz, from.iyz, from.izz;
}

void read_geometry(const urdf::Geometry& from, UrdfShape& to) {
  switch (from.type) {
    case urdf::Geometry::BOX:
      to.kind = UrdfShapeKind::box;
      to.size = vector_of(static_cast<const urdf::Box&>(from).dim);
      break;
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(from);
      to.kind = UrdfShapeKind::cylinder;
      to.size = {cylinder.radius, cylinder.radius, cylinder.length};
      break;
    }
    case urdf::Geometry::SPHERE:
      to.kind = UrdfShapeKind::sphere;
      to.size.setConstant(static_cast<const urdf::Sphere&>(from).radius);
      break;
    case urdf::Geometry::MESH:
      to.kind = UrdfShapeKind::mesh;
      to.mesh_file = static_cast<const urdf::Mesh&>(from).filename;
      to.mesh_scale = vector_of(static_cast<const urdf::Mesh&>(from).scale);
      break;
  }
}

template <class Shapes>
void read_shapes(const Shapes& from, std::vector<UrdfShape>& to) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i].origin.xyz = vector_of(from[i]->origin.position);
    read_geometry(*from[i]->geometry, to[i]);
  }
}

// urdfdom only logs what it cannot read and goes on without it.
bool is_complete(const urdf::Link& from, const UrdfLink& to) {
  return bool(from.inertial) == to.inertial.has_value() && from.visual_array.size() == to.visuals.size() &&
         from.collision_array.size() == to.collisions.size();
}

void read_link(const urdf::Link& from, UrdfLink& to) {
  if (to.inertial) read_inertial(*from.inertial, *to.inertial);
  read_shapes(from.visual_array, to.visuals);
  read_shapes(from.collision_array, to.collisions);
}

void read_joint(const urdf::Joint& from, UrdfJoint& to) {
  to.origin.xyz = vector_of(from.parent_to_joint_origin_transform.position);
  to.axis = vector_of(from.axis);
  if (from.limits) {
    to.limit.lower = from.limits->lower;
    to.limit.upper = from.limits->upper;
    to.limit.effort = from.limits->effort;
    to.limit.velocity = from.limits->velocity;
  }
  if (from.dynamics) {
    to.damping = from.dynamics->damping;
    to.friction = from.dynamics->friction;
  }
  if (to.mimic) {
    to.mimic->multiplier = from.mimic->multiplier;
    to.mimic->offset = from.mimic->offset;
  }
}

// urdfdom's links own their children: dropping a long chain would recurse once a link and exhaust the stack.
void take_apart(urdf::ModelInterface& model) {
  for (auto& [name, link] : model.links_) {
    link->child_links.clear();
    link->child_joints.clear();
  }
}

void read_values(const std::string& plain, UrdfFile& file) {
  LogCapture log;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(plain);
  if (!model) throw Error(ExitCode::bad_input, "is refused by urdfdom: " + log.text(), file.at(0));
  const auto refuse = [&](const std::string& what, int line) {
    throw Error(ExitCode::bad_input, "urdfdom cannot read " + what + ": " + log.text(), file.at(line));
  };
  for (UrdfLink& link : file.links) {
    const auto found = model->links_.find(link.name);
    if (found == model->links_.end() || !is_complete(*found->second, link))
      refuse("link '" + link.name + "'", link.line);
    read_link(*found->second, link);
  }
  for (UrdfJoint& joint : file.joints) {
    const auto found = model->joints_.find(joint.name);
    if (found == model->joints_.end()) refuse("joint '" + joint.name + "'", joint.line);
    read_joint(*found->second, joint);
  }
  take_apart(*model);
}

}  // namespace

void read_urdf_values(const std::string& plain, UrdfFile& file) {
  try {
    read_values(plain, file);
  } catch (const Error&) {
    read_values(plain, file);  // urdfdom takes want of memory, which may have passed, for a number that is none
  }
}

}  // namespace chainreel
