// Textures in full, without a texture: a mesh is cut until the colours of its vertices, linear between them, are those of its
// images. All that draws a mesh then draws its textures.
#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.hpp"
#include "mesh/texture.hpp"

namespace chainreel {

// A vertex with its place in an image: (0, 0) is the lower left corner, (1, 1) the upper right one.
struct PaintedVertex {
  static constexpr std::uint32_t kUnpainted = ~std::uint32_t(0);

  TriangleMesh::Vertex vertex;  // its colour multiplies the image's
  float u = 0, v = 0;
  std::uint32_t texture = kUnpainted;  // all corners of a triangle have the same one
};

struct PaintedMesh {
  std::vector<PaintedVertex> vertices;
  std::vector<std::uint32_t> triangles;
  std::vector<Texture> textures;  // opaque
};

inline constexpr std::size_t kMostPaintTriangles = 400'000;  // that are added to a mesh: finer images are halved until they suffice
inline constexpr float kMostRepeats = 1000;  // of an image along a side: beyond, coordinates count as none

// Colours differ from the images' by less than 20 of 255 at the middle of each texel, or the triangles there are as small as texels.
TriangleMesh painted(PaintedMesh mesh);

}  // namespace chainreel
