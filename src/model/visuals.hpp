// What a model looks like: the <visual> shapes of its links, each on the body that carries it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "model/read_chain.hpp"
#include "model/urdf_file.hpp"

namespace chainreel {

enum class VisualKind { box, cylinder, sphere, mesh };

struct Visual {
  int body = 0;                                            // index into Chain::bodies; 0: fixed to the world
  Eigen::Isometry3d X_BV = Eigen::Isometry3d::Identity();  // pose of the shape in its body
  VisualKind kind = VisualKind::box;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  // as in UrdfShape, m
  std::string mesh_file;                           // as found
  Eigen::Vector3d mesh_scale = Eigen::Vector3d::Ones();
  std::optional<std::array<std::uint8_t, 4>> color;  // of its <material>, red green blue opacity
  std::string link;
  Place place;  // of the <visual>, for errors
};

enum class ShapesOf { visual, collision };  // the <visual>s or the <collision>s

// In document order of links; lumped links are on the body that carries them. `chain` was read from the same
// file with the same options. A material that is only named has the colour that the robot gives that name,
// else the first link that does; a texture counts as its mean colour, and as nothing where it cannot be read.
// Throws Error with every material that is named and has no colour anywhere, and every mesh that is not
// found; without `options.meshes` such meshes are left out.
std::vector<Visual> read_visuals(const ModelSource& source, const Chain& chain, const ModelOptions& options,
                                 ShapesOf which = ShapesOf::visual);

// Where the meshes lie that a model shows.

const std::vector<UrdfShape>& shapes_of(const UrdfLink& link, ShapesOf which);

// For each mesh of a <visual> or <collision>, by its name as written, the path where it was found, "" where
// it was not. With `options.meshes` all must be found: throws Error with every one that is not.
std::map<std::string, std::string> find_meshes(const UrdfFile& file, const ModelOptions& options,
                                               ShapesOf which = ShapesOf::visual);

// How far the moving bodies of a model reach: points that span what can be seen of each.

struct Outline {
  // By index into Chain::bodies, in the body's frame, m: a body moves no point of its shapes further than the farthest
  // of these. Empty for the world, for bodies without shapes, and where there is no outline at all.
  std::vector<std::vector<Eigen::Vector3d>> points;
  std::vector<std::string> unmeasured;  // moving links with a mesh that was not found or cannot be read
};

// Takes the <visual>s, of links without any the <collision>s; meshes count with the box around their
// vertices. `chain` was read from the same file with the same options. Throws Error where the file cannot be
// read; never for a mesh.
Outline read_outline(const ModelSource& source, const Chain& chain, const ModelOptions& options);

}  // namespace chainreel
