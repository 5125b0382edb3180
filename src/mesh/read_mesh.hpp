// Mesh files as triangles.
#pragma once

#include <string>

#include "core/triangle_mesh.hpp"

namespace chainreel {

// Whose up a Collada file follows: a URDF has axes of its own, so that RViz takes the numbers as they are
// written; `file` turns them so that the direction that the file calls up is z.
enum class MeshUp { rviz, file };

// STL, OBJ or DAE, by the file's ending: all nodes placed, Collada's unit applied, without `scale` of a URDF.
// Normals are the file's, else those of the faces, smoothed over edges that are nearly flat. Colours are the
// materials' diffuse ones, with a texture its mean. Errors as of mesh_extents; exit 7 also for more than
// kMostTriangles.
TriangleMesh read_mesh(const std::string& path, MeshUp up = MeshUp::rviz);

inline constexpr std::size_t kMostTriangles = 4'000'000;

}  // namespace chainreel
