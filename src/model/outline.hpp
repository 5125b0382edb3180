// How far the moving bodies of a model reach: points that span what can be seen of each.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "model/read_chain.hpp"

namespace chainreel {

struct Outline {
  // By index into Chain::bodies, in the body's frame, m: a body moves no point of its shapes further than the farthest
  // of these. Empty for the world, for bodies without shapes, and where there is no outline at all.
  std::vector<std::vector<Eigen::Vector3d>> points;
  std::vector<std::string> unmeasured;  // moving links with a mesh that was not found or cannot be read
};

// Takes the <visual>s, of links without any the <collision>s; meshes count with the box around their
// vertices. `chain` was read from the same file with the same options. Throws Error where the file cannot be
// read; never for a mesh.
Outline read_outline(const std::string& path, const Chain& chain, const ModelOptions& options);

}  // namespace chainreel
