// From assimp's scene to one mesh of triangles.
#pragma once

#include <assimp/scene.h>

#include "core/triangle_mesh.hpp"
#include "mesh/material_color.hpp"
#include "mesh/mesh_file.hpp"

namespace chainreel {

// Triangles alone, placed, without those that have no area; vertices that are equal to the last bit are one.
// `placed` must be triangulated, with indices in range. Vertices that are not finite stay so.
TriangleMesh collect_triangles(const std::vector<PlacedMesh>& placed, MaterialColors& colors);

}  // namespace chainreel
