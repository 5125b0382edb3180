// From assimp's scene to one mesh of triangles.
#pragma once

#include "core/triangle_mesh.hpp"
#include "mesh/material_color.hpp"
#include "mesh/mesh_file.hpp"

namespace chainreel {

// Triangles alone, placed, without those that have no area; vertices that are equal to the last bit are one.
// Normals are the file's, where they tell more than the faces do. `placed` must be triangulated, with indices
// in range. What is not finite stays so.
TriangleMesh collect_triangles(const std::vector<PlacedMesh>& placed, MaterialColors& colors);

}  // namespace chainreel
