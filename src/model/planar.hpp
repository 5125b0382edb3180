// Whether all motion of a chain stays in one plane, and its planar form.
//
// A chain is planar when some direction n (the normal) is parallel to every revolute axis and normal to every
// prismatic axis at zero pose. Turning about n changes neither, so it then holds at every pose: bodies only
// move parallel to the plane. The part of gravity along n does no work. Masses outside the plane load the
// bearings and nothing else.
#pragma once

#include <optional>
#include <string>

#include "model/chain.hpp"

namespace chainreel {

// Sine of the angle below which two axes are one direction. Axes that were meant to be parallel differ by the
// round-off of the rotations between them (1e-16 each); 1.5708 for pi/2 differs by 4e-6 and is no longer
// planar.
inline constexpr double kParallelTolerance = 1e-12;

// True where z is a normal: then gravity points along -y by default.
bool moves_in_xy_plane(const Chain& chain);

// True where a chain is not planar, but misses it by no more than angles written with few digits do.
bool is_nearly_planar(const Chain& chain);

// The planar form for chain.gravity, or nothing; `why` gets the sentence for Chain::why_algebra.
std::optional<PlanarChain> planar_form_of(const Chain& chain, std::string& why);

// Pose of each body when all joint values are 0.
std::vector<Eigen::Isometry3d> poses_at_zero(const Chain& chain);

}  // namespace chainreel
