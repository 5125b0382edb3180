// From what the file says to what moves: fixed joints lumped into their parents, one body a moving joint.
//
// Lumping: m = sum m_i, com = sum m_i c_i / m, and by Steiner's theorem
// I = sum I_i + m_i (|d_i|^2 1 - d_i d_i^T), d_i = c_i - com, with every c_i and I_i in the axes of the body.
#pragma once

#include "model/chain.hpp"
#include "model/read_chain.hpp"
#include "model/urdf_file.hpp"

namespace chainreel {

struct ReducedModel {
  Chain chain;  // without gravity, planar form and end effector
  std::vector<int>
      link_of_body;  // index into UrdfFile::links; -1 for the world and the bodies within a planar joint
};

// Throws Error where a moving link has no mass.
ReducedModel reduce(const UrdfFile& file, const ModelOptions& options);

// A body of several parts. `parts` are in the axes of the body.
Inertia lumped(const std::vector<Inertia>& parts);

// The directions x and y of a planar joint with this normal: for normals z, x, y they are (x, y), (y, z), (z,
// x).
std::pair<Eigen::Vector3d, Eigen::Vector3d> in_plane_axes(const Eigen::Vector3d& normal);

}  // namespace chainreel
