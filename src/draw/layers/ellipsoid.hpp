// An ellipsoid about the end effector of a robot in space: its silhouette and its three principal ellipses, whose far
// halves are thin and dashed, and its semi-axes with their lengths. What lies behind the robot is drawn below it. Internal.
#pragma once

#include <vector>

#include "draw/layers/ellipse.hpp"
#include "draw/robot/body_shapes.hpp"

namespace chainreel {

// None of the axes is infinite unless seen from its end; those of `energy` may have no length.
void draw_ellipsoid(Picture& picture, const std::vector<MassAxis>& axes, Point center, const Camera& camera,
                    const EllipseStyle& style, int clip);

// What the bodies hide as they stand after compute_kinematics, from a camera that sees the curve about `tip`, a place in W.
// Each counts as what 13 pairs of planes leave of space: where a line meets that and not the body itself, nothing of the
// body is drawn over the line either. Keeps a reference to none of them.
Hides robot_hides(const BodyShapes& shapes, const Workspace& ws, const Camera& camera, const Eigen::Vector3d& tip);

}  // namespace chainreel
