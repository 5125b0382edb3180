#include "render/solid_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chainreel {
namespace {

// The nearest that a body may come to the eye, as a share of the eye's distance.
constexpr double kNearest = 0.02;

}  // namespace

MeshBounds bounds_of(const TriangleMesh& mesh) {
  MeshBounds bounds;
  bounds.lower.fill(std::numeric_limits<double>::max());
  bounds.upper.fill(std::numeric_limits<double>::lowest());
  for (const TriangleMesh::Vertex& vertex : mesh.vertices)
    for (std::size_t i = 0; i < 3; ++i) {
      bounds.lower[i] = std::min(bounds.lower[i], double(vertex.position[i]));
      bounds.upper[i] = std::max(bounds.upper[i], double(vertex.position[i]));
    }
  return bounds;
}

bool is_drawable(const Solids& solids) {
  const auto good = [](double x) { return std::isfinite(x); };
  if (!good(solids.origin.x + solids.origin.y) || !(solids.scale > 0) || !good(solids.scale) ||
      !(solids.nearness >= 0) || !good(solids.opacity) || !good(solids.outline_width))
    return false;
  return std::all_of(solids.parts.begin(), solids.parts.end(), [&](const Solid& solid) {
    return solid.mesh && std::all_of(solid.to_view.begin(), solid.to_view.end(), good);
  });
}

std::optional<SolidBounds> bounds_of(const Solids& solids, const std::vector<MeshBounds>& bounds) {
  SolidBounds all{{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, -HUGE_VAL, HUGE_VAL};
  const double closest = solids.nearness > 0 ? (1 - kNearest) / solids.nearness : HUGE_VAL;
  for (std::size_t i = 0; i < solids.parts.size(); ++i) {
    if (solids.parts[i].mesh->triangles.empty()) continue;
    const std::array<double, 12>& m = solids.parts[i].to_view;
    for (int corner = 0; corner < 8; ++corner) {
      std::array<double, 3> p{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = corner >> axis & 1 ? bounds[i].upper[axis] : bounds[i].lower[axis];
      const auto row = [&](std::size_t r) {
        return m[4 * r] * p[0] + m[4 * r + 1] * p[1] + m[4 * r + 2] * p[2] + m[4 * r + 3];
      };
      const double z = std::min(row(2), closest);
      const double grown = solids.scale / (1 - z * solids.nearness);
      const Point at = solids.origin + grown * Point{row(0), row(1)};
      all.page = {std::min(all.page.x0, at.x), std::min(all.page.y0, at.y), std::max(all.page.x1, at.x),
                  std::max(all.page.y1, at.y)};
      all.nearest = std::max(all.nearest, z);
      all.farthest = std::min(all.farthest, z);
    }
  }
  if (!(all.page.x0 <= all.page.x1)) return std::nullopt;
  const double around = solids.is_shadow ? 0 : solids.outline_width;
  all.page = {all.page.x0 - around, all.page.y0 - around, all.page.x1 + around, all.page.y1 + around};
  return all;
}

}  // namespace chainreel
