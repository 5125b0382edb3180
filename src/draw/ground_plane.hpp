// The ground under a robot in space: a grid that fades out, drawn where the robot stands on it.
#pragma once

#include <optional>

#include "model/chain.hpp"
#include "picture/camera.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// The plane through the world's origin, normal to gravity (without gravity: to z).
struct GroundPlane {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // on the plane, below the motion
  double radius = 1;                                 // m, where the grid has faded out
  double spacing = 0.1;                              // m: 1, 2 or 5 times a power of ten
};

Eigen::Vector3d up_of(const Chain& chain);

// Nothing where the robot does not come down to the plane, or goes through it. `motion` is a box around all
// places over the whole run.
std::optional<GroundPlane> ground_under(const Eigen::AlignedBox3d& motion, const Eigen::Vector3d& up);

void draw_ground_plane(Picture& picture, const GroundPlane& ground, const Camera& camera, const Theme& theme,
                       int clip);

}  // namespace chainreel
