// Triangles of a body, as its file or its measures give them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace chainreel {

struct TriangleMesh {
  struct Vertex {
    std::array<float, 3> position{};      // m, in the mesh's own frame
    std::array<float, 3> normal{};        // unit, outwards
    std::array<std::uint8_t, 4> color{};  // red, green, blue, opacity (straight)
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> triangles;  // indices, three a triangle, counter-clockwise seen from outside
  bool has_colors = false;               // the file says them; otherwise all are white
};

}  // namespace chainreel
