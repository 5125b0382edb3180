// A chain at one instant as shapes: what stands on the ground, links, joints.
#pragma once

#include <vector>

#include "draw/robot/body_shapes.hpp"
#include "draw/robot/joints.hpp"
#include "sim/system/constraint_plan.hpp"

namespace chainreel {

// Everything but the pose; references must outlive it.
struct ChainDrawing {
  const Chain& chain;
  const Skeleton& skeleton;
  const Camera& camera;
  ChainLook look;
  const BodyShapes* shapes = nullptr;  // drawn instead of bars, joints and ground marks
  const std::vector<bool>* only = nullptr;  // bodies whose bars and joints are drawn; null: all

  bool shows(int body) const { return only == nullptr || (*only)[std::size_t(body)]; }
};

// Ground, fixed parts and the rails fixed to them: the same at every pose.
void draw_base(Picture& picture, const ChainDrawing& drawing, int clip);
// The rails that the chain carries, with the carriages below them, after compute_kinematics: what lies under
// a trail.
void draw_rails(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, int clip);
// Body shapes, or links and joints; along the chain, in space from far to near. Without the end effector's disc, which is to
// lie above what is drawn later.
void draw_links(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, int clip);

// A rail from end to end, as it is drawn, from the joint's smaller values to its larger ones.
PageLine rail_line(const ChainDrawing& drawing, const Workspace& ws, const Rail& rail);

// What the body shapes throw on the plane `height` (m) above the world's origin under a light right above; nothing without them.
// Its edges are soft, it is darker below what comes near to the plane, and it fades before the edges of `area`.
void draw_shadow(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, double height, const Rect& area, int clip);

// The root link's origin, where what is fixed to the world begins.
Eigen::Vector3d root_place(const Chain& chain);
// Whether what the body hangs on is right at the root link: else a fixed part leads there.
bool hangs_on_root(const Chain& chain, const Skeleton& skeleton, const Body& body);

// World position of the end effector after compute_kinematics.
Eigen::Vector3d tip_position(const Chain& chain, const Workspace& ws);
// On the page, from the last link's joint to its end.
Point last_link(const Skeleton& skeleton, const Workspace& ws, const Camera& camera);
// The centre of mass of the whole chain after compute_kinematics; the origin where nothing has mass.
Eigen::Vector3d center_of_mass(const Chain& chain, const Workspace& ws);
Eigen::Vector3d center_velocity(const Chain& chain, const Workspace& ws);  // m/s
// A free robot with several ends is followed by its centre of mass, which forces within do not move.
bool is_followed_by_center(const Chain& chain);
// ... and the x and y axes of its frame in W.
Eigen::Matrix<double, 3, 2> tip_plane(const Chain& chain, const Workspace& ws);

// The joints at which constraints close loops, which the chain's own tree does not hold.

// Places of the world at which a loop is closed on the ground, or a frame pinned to it.
std::vector<Eigen::Vector3d> closure_pins(const Chain& chain, const ConstraintPlan& plan);
// The ground below these.
void draw_closure_pins(Picture& picture, const ChainDrawing& drawing, const ConstraintPlan& plan, int clip);
// The joints themselves, after compute_kinematics.
void draw_closure_joints(Picture& picture, const ChainDrawing& drawing, const Workspace& ws,
                         const ConstraintPlan& plan, int clip);

}  // namespace chainreel
