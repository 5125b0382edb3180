// Bodies in space as one shape of a picture: the renderer lights them, lets them hide one another and puts
// the result down like any flat shape.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/triangle_mesh.hpp"
#include "picture/color.hpp"

namespace chainreel {

// View coordinates: x right, y up, z towards the viewer, m, from the point that the camera looks at.
struct Solid {
  std::shared_ptr<const TriangleMesh> mesh;
  std::array<double, 12>
      to_view{};  // rows of the 3x4 matrix from the mesh's coordinates; a pose, scales are the mesh's own
  std::optional<Color> color;  // instead of the mesh's own
};

struct Solids {
  std::vector<Solid> parts;
  // A point (x, y, z) of the view stands on the page at origin + scale / (1 - z nearness) (x, y).
  Point origin;
  double scale = 1;     // units of H per metre where z = 0
  double nearness = 0;  // 1/m: of the eye from z = 0; 0: parallel rays
  double opacity = 1;   // of the whole
  Color outline;        // around the whole; a = 0: none
  double outline_width = 0;
  bool is_shadow = false;  // one flat colour instead of light: that of `outline`, which then is no line
};

}  // namespace chainreel
