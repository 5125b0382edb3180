// The ground under a robot in space: a grid that fades out, drawn where the robot stands on it.
#pragma once

#include <optional>

#include "draw/robot/fit.hpp"
#include "draw/robot/view.hpp"
#include "picture/camera.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// A plane normal to the motion's up.
struct GroundPlane {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // on the plane, below the motion
  double height = 0;                                 // m above the world's origin
  double radius = 1;                                 // m, where the grid has faded out
  double spacing = 0.1;                              // m: 1, 2 or 5 times a power of ten
};

// Through the world's origin. Nothing where the motion does not come down to the plane, or goes through it, or where the camera sees it
// from below.
std::optional<GroundPlane> ground_under(const MotionBox& motion, const Camera& camera);
// Of poses: what no joint ties to the world stands on its lowest place. Nothing where the view is flat, too.
std::optional<GroundPlane> ground_of_poses(const Chain& chain, const MotionBox& poses, const Camera& camera, const CameraEntry& wanted);

// Fades with the distance from the middle, and before the edges of `area`.
void draw_ground_plane(Picture& picture, const GroundPlane& ground, const Camera& camera, Color color,
                       const Rect& area, int clip);

}  // namespace chainreel
