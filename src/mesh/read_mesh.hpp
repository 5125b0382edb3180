// Mesh files as triangles.
#pragma once

#include <string>

#include "core/names.hpp"
#include "core/triangle_mesh.hpp"
#include "mesh/material_color.hpp"
#include "mesh/mesh_file.hpp"

namespace chainreel {

// Whose up a Collada file follows: a URDF has axes of its own, so that RViz takes the numbers as they are
// written; `file` turns them so that the direction that the file calls up is z. STL and OBJ call nothing up:
// they are taken as written either way.
enum class MeshUp { rviz, file };
std::span<const Name> names_of(MeshUp);

// STL, OBJ or DAE, by the file's ending: all nodes placed, Collada's unit applied, without `scale` of a URDF.
// Lines, points and triangles without area are left out.
// Normals are the file's where they tell of a surface; where they only repeat the faces' (as in every STL),
// or are missing, those of the faces, smoothed over edges below 35 degrees. Colours are the file's for each
// vertex, else the materials' diffuse ones with their opacity (one of 0 counts as 1: such files mean
// transparency). A texture, PNG or JPEG, is painted onto the triangles (mesh/painted_mesh), or gives its mean where the
// mesh has no coordinates on it; one that is missing, of another kind or inside the mesh file leaves the material's colour. Errors as of mesh_extents; exit 7 also for more than
// kMostTriangles.
TriangleMesh read_mesh(const std::string& path, MeshUp up = MeshUp::rviz);

inline constexpr std::size_t kMostTriangles = 4'000'000;

// From assimp's scene to one mesh of triangles.

// Triangles alone, placed, without those that have no area; vertices that are equal to the last bit are one.
// Normals are the file's, where they tell more than the faces do. `placed` must be triangulated, with indices
// in range. What is not finite stays so.
TriangleMesh collect_triangles(const std::vector<PlacedMesh>& placed, MaterialColors& colors);

}  // namespace chainreel
