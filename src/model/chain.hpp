// What a mechanism is: a tree of moving bodies, fixed joints already lumped into their parents. Constant
// after loading. Body 0 is the world, moving bodies start at 1 and parents come before children, so that
// loops read like R. Featherstone, Rigid Body Dynamics Algorithms, table 4.3. SI units and radians
// throughout.
//
// Frames: W world, P parent body, B body. A body's frame is its joint's frame: the URDF link frame behind the
// joint.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace chainreel {

// URDF's `planar` joint is read as three one-freedom joints (x, y, angle) with massless bodies between them.
enum class JointKind {
  revolute,   // one angle about `axis` (also URDF `continuous`)
  prismatic,  // one displacement along `axis`
  floating,   // q = x y z qx qy qz qw (pose of B in P), velocity = twist of B in B: v = (linear, angular)
};

struct JointLimit {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double effort = std::numeric_limits<double>::infinity();
  double velocity = std::numeric_limits<double>::infinity();
};

struct Joint {
  std::string name;
  JointKind kind = JointKind::revolute;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // unit length, in B (same numbers in P's joint frame)
  Eigen::Isometry3d X_PJ =
      Eigen::Isometry3d::Identity();  // joint frame in P: p_P = X_PJ * p_J; X_PB = X_PJ at zero
  JointLimit limit;
  double damping = 0;   // N m s/rad or N s/m
  double friction = 0;  // N m or N
  // Where the joint reads the coordinates: value = ratio * q[q_index] + offset. A mimic joint shares the
  // coordinate of the joint that it follows; all others have ratio 1 and offset 0.
  int q_index = 0;
  int v_index = 0;
  double ratio = 1;
  double offset = 0;
};

struct Inertia {
  double mass = 0;                                      // kg
  Eigen::Vector3d com = Eigen::Vector3d::Zero();        // centre of mass in B, m
  Eigen::Matrix3d about_com = Eigen::Matrix3d::Zero();  // about the centre of mass, axes of B, kg m^2
};

struct Body {
  std::string
      name;  // the URDF link behind the joint; the joint's name where a planar joint has no link between
  int parent = 0;
  Joint joint;
  Inertia inertia;  // with everything fixed to it lumped in
};

// A named place on a body: every link of the file has one, lumped links included.
struct Frame {
  std::string name;
  int body = 0;
  Eigen::Isometry3d X_BF = Eigen::Isometry3d::Identity();
};

// The plane of a mechanism whose bodies all move parallel to one plane.
struct Plane {
  Eigen::Vector3d ex = Eigen::Vector3d::UnitX();
  Eigen::Vector3d ey = Eigen::Vector3d::UnitY();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // ex x ey
};

// One body of the planar form. Its frame has its origin at the joint's (projected on the plane) and is
// parallel to ex, ey when all joint values are 0, so that no placement carries an angle.
struct PlanarBody {
  int parent = 0;
  JointKind kind = JointKind::revolute;                  // revolute or prismatic
  double sign = 1;                                       // revolute: +1 about normal, -1 about -normal
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  // prismatic: unit, in the parent's planar frame
  Eigen::Vector2d p_PJ = Eigen::Vector2d::Zero();        // joint origin in the parent's planar frame
  double mass = 0;
  Eigen::Vector2d com = Eigen::Vector2d::Zero();  // in the planar body frame
  double inertia = 0;                             // about the centre of mass, about the normal
  int q_index = 0;
  double ratio = 1;
  double offset = 0;
};

struct PlanarChain {
  Plane plane;
  std::vector<PlanarBody> bodies;            // same indices as Chain::bodies
  std::vector<Eigen::Isometry3d> X_WB_zero;  // pose of each body when all joint values are 0
};

// A mass at a point of a body, for pictures: a payload, or all that a body has. The body's inertia holds it already.
struct PointMass {
  int body = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // in B, m
  double mass = 0;                               // kg
  bool is_payload = false;
};

struct Chain {
  std::string name;
  std::vector<Body> bodies = std::vector<Body>(1);  // [0] is the world
  std::vector<Frame> frames;                        // [0] is the root link
  int nq = 0;                                       // numbers in q
  int nv = 0;                                       // numbers in qd, qdd, tau: the degrees of freedom
  // nv names: the joint that owns each freedom; NAME.vx vy vz wx wy wz for a floating joint, NAME.x NAME.y
  // NAME.angle for a planar one.
  std::vector<std::string> coordinate_names;
  bool serial = true;  // every body has at most one child
  bool has_mimic = false;
  bool has_floating = false;
  bool has_dissipation = false;          // some joint has damping or friction
  Eigen::Vector3d gravity{0, 0, -9.81};  // m/s^2, in W
  int end_effector = -1;  // index into frames; -1 where none was asked for and several leaves could be it
  std::vector<PointMass> point_masses;
  std::vector<int> leaf_frames;  // frames of the links that carry no joint, in the order of `frames`

  std::optional<PlanarChain> planar;  // set when all motion stays in one plane
  std::string why_algebra;            // one sentence: why planar, or what made it spatial
  std::vector<std::string> slips;     // "arm.urdf:12: the attribute 'dampping' .. did you mean 'damping'?": what its file says that is not read, but was likely meant
};

// kg, of all bodies that move.
double mass_of(const Chain& chain);

// Index into chain.frames, or -1.
int find_frame(const Chain& chain, const std::string& name);

// Index into chain.frames of the end effector. Throws Error listing the leaves where there is none.
int require_end_effector(const Chain& chain);

// nq names: as coordinate_names, but NAME.x y z qx qy qz qw for a floating joint.
std::vector<std::string> position_names(const Chain& chain);

// Where among such names those of a joint stand: its own, or NAME.x and its like; none for one that is not there.
std::vector<std::size_t> places_of_joint(std::span<const std::string> names, const std::string& joint);

// q with every joint at zero: zeros, and the unit quaternion for floating joints.
std::vector<double> zero_configuration(const Chain& chain);

// Whether numbers are a pose of a chain.

// What keeps the chain.nq numbers from being one, with its remedy; "" for a pose. Quaternions need no unit length, but
// without any they point nowhere.
std::string trouble_of_pose(const Chain& chain, std::span<const double> q);

}  // namespace chainreel
