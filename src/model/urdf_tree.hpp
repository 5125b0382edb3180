// Links and joints joined to one tree, and mimic joints to what they follow: unknown names, several roots,
// loops.
#pragma once

#include "model/urdf_check.hpp"
#include "model/urdf_problems.hpp"

namespace chainreel {

// Fills parent and child of joints, parent_joint and child_joints of links, and the root.
void connect_links(CheckedUrdf& urdf, UrdfProblems& problems);

// Every mimic joint must follow, directly or through other mimic joints, one that has a coordinate of its
// own.
void check_mimics(const UrdfFile& file, UrdfProblems& problems);

}  // namespace chainreel
