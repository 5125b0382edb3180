// What a URDF file says, before anything is reduced: links and joints in document order, each with its line.
//
// Two readers fill it. The check pass (urdf_check, tinyxml2) gives names, lines, structure, and the rotations
// as written: urdfdom turns them into quaternions with the C library's sine, whose bits differ between
// machines. urdfdom (urdf_values) gives every other value. What one of them refuses is an Error.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/model_source.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {

// <origin xyz rpy>: rotation R = Rz(yaw) Ry(pitch) Rx(roll).
struct UrdfOrigin {
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero();
  Eigen::Vector3d rpy = Eigen::Vector3d::Zero();
};

Eigen::Isometry3d isometry_of(const UrdfOrigin& origin);

// <material>: of a <visual>, or of the robot for all that name it.
struct UrdfMaterial {
  std::string name;                           // "" where it has none
  std::optional<std::array<double, 4>> rgba;  // red green blue opacity, 0 to 1
  std::string texture;                        // as written, "" where there is none
  bool has_empty_texture = false;             // a <texture> without a file, which is remarked
  int line = 0;
  bool says_something() const { return rgba || !texture.empty(); }
};

enum class UrdfShapeKind { box, cylinder, sphere, mesh };

// One <visual> or <collision>.
struct UrdfShape {
  UrdfShapeKind kind = UrdfShapeKind::box;
  UrdfOrigin origin;
  Eigen::Vector3d size =
      Eigen::Vector3d::Zero();  // box: edges; cylinder: radius, radius, length; sphere: radius x 3
  std::string mesh_file;        // as written: package://, file:// or a path
  Eigen::Vector3d mesh_scale = Eigen::Vector3d::Ones();
  std::optional<UrdfMaterial> material;  // of a <visual>
  int line = 0;
};

struct UrdfInertial {
  UrdfOrigin origin;
  double mass = 0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre of mass, in the axes of `origin`
  int line = 0, mass_line = 0;
};

struct UrdfLink {
  std::string name;
  int line = 0;
  std::optional<UrdfInertial> inertial;
  std::vector<UrdfShape> visuals;
  std::vector<UrdfShape> collisions;
  int parent_joint = -1;          // index into UrdfFile::joints; -1 at the root
  std::vector<int> child_joints;  // in document order
};

enum class UrdfJointType { revolute, continuous, prismatic, fixed, floating, planar };

std::string to_string(UrdfJointType type);

struct UrdfLimit {
  bool given = false;  // there is a <limit>
  bool has_lower = false, has_upper = false, has_effort = false, has_velocity = false;
  double lower = 0, upper = 0, effort = 0, velocity = 0;
  int line = 0;
};

struct UrdfMimic {
  std::string joint;
  double multiplier = 1;
  double offset = 0;
  int line = 0;
};

struct UrdfJoint {
  std::string name;
  int line = 0;
  UrdfJointType type = UrdfJointType::fixed;
  int parent = -1;  // indices into UrdfFile::links
  int child = -1;
  UrdfOrigin origin;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // as written, not normalised
  UrdfLimit limit;
  double damping = 0;
  double friction = 0;
  std::optional<UrdfMimic> mimic;
};

// A tag that nothing here reads.
struct UrdfIgnoredTag {
  std::string name;
  std::string parent;  // the tag around it
  int count = 0;
  int first_line = 0;
};

struct UrdfFile {
  std::string path;
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::vector<UrdfMaterial> materials;  // of the robot
  int root = -1;  // index into links
  std::vector<UrdfIgnoredTag> ignored;
  std::vector<UrdfRemark> remarks;

  std::optional<Place> asked;  // of numbers that stand for a file: where they stand, for all errors

  Place at(int line) const { return asked ? *asked : Place{path, line, 0}; }
  // An empty list for problems of this file.
  UrdfProblems problems() const { return asked ? UrdfProblems(*asked) : UrdfProblems(path); }
};

// Links from the root on, parents first, depth first, children in document order.
std::vector<int> depth_first_links(const UrdfFile& file);

// Reads and checks. Throws Error with every problem that the file has (exit 3; exit 7 beyond a limit of
// size).
UrdfFile read_urdf_file(const ModelSource& source);

// The second look at a URDF file: urdfdom reads masses, inertias, placements, axes, limits and shapes.

// `plain` is the text that check_urdf prepared, without problems. Throws Error with urdfdom's own words where
// it refuses what the check let through.
void read_urdf_values(const std::string& plain, UrdfFile& file);

}  // namespace chainreel
