#include "mesh/painted_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/edge_cuts.hpp"

namespace chainreel {
namespace {

constexpr float kSeen = 20;        // of 255: colours that differ by so much
constexpr float kFinest = 1;       // texels: shorter edges are not cut
constexpr float kLong = 0.55F;     // of a triangle's longest edge: the others that are cut with it
constexpr double kMostTexels = 8e6;  // under all triangles, that may be looked at

using Level = std::array<float, 4>;

// A vertex on its image.
struct Spot {
  float x = 0, y = 0;  // in texels, whole numbers at their middles; y down
  Level color{};
};

class Painting {
 public:
  explicit Painting(PaintedMesh mesh) : given_(std::move(mesh)) {}

  TriangleMesh run() {
    while (texels_covered() > kMostTexels) halve();
    while (!paint()) halve();
    TriangleMesh result;
    result.vertices.reserve(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      TriangleMesh::Vertex vertex = vertices_[i].vertex;
      if (vertices_[i].texture != PaintedVertex::kUnpainted)
        for (std::size_t c = 0; c < 3; ++c)
          vertex.color[c] = std::uint8_t(std::lround(spots_[i].color[c] * float(vertex.color[c]) / 255));
      result.vertices.push_back(vertex);
    }
    result.triangles = std::move(triangles_);
    return result;
  }

 private:
  void halve() {
    for (Texture& texture : given_.textures) texture = texture.halved();
  }

  // Of all triangles, counting rows of their own; 0 where nothing gets coarser any more.
  double texels_covered() const {
    double count = 0;
    for (std::size_t t = 0; t + 2 < given_.triangles.size(); t += 3) {
      std::array<Spot, 3> at;
      const PaintedVertex& first = given_.vertices[given_.triangles[t]];
      if (first.texture == PaintedVertex::kUnpainted) continue;
      const Texture& texture = given_.textures[first.texture];
      if (texture.width == 1 && texture.height == 1) continue;
      for (std::size_t k = 0; k < 3; ++k) at[k] = place_of(given_.vertices[given_.triangles[t + k]]);
      const double abx = at[1].x - at[0].x, aby = at[1].y - at[0].y, acx = at[2].x - at[0].x, acy = at[2].y - at[0].y;
      const auto [low, high] = std::minmax({at[0].y, at[1].y, at[2].y});
      count += std::abs(abx * acy - acx * aby) / 2 + double(high - low) + 1;
    }
    return count;
  }

  Spot place_of(const PaintedVertex& vertex) const {
    const Texture& texture = given_.textures[vertex.texture];
    return {vertex.u * float(texture.width) - 0.5F, (1 - vertex.v) * float(texture.height) - 0.5F, {}};
  }

  // A vertex that `vertices_` has got last.
  void add_spot() {
    const PaintedVertex& vertex = vertices_.back();
    Spot spot;
    if (vertex.texture != PaintedVertex::kUnpainted) {
      spot = place_of(vertex);
      spot.color = given_.textures[vertex.texture].at(spot.x, spot.y);
    }
    spots_.push_back(spot);
    cuts_.add_place(vertex.vertex.position);
  }

  std::uint32_t add_middle(std::uint32_t a, std::uint32_t b) {
    const PaintedVertex &p = vertices_[a], &q = vertices_[b];
    vertices_.push_back({middle_of(p.vertex, q.vertex), (p.u + q.u) / 2, (p.v + q.v) / 2, p.texture});
    add_spot();
    return std::uint32_t(vertices_.size() - 1);
  }

  // Whether that took no more triangles than there may be.
  bool paint() {
    vertices_.clear(), spots_.clear();
    triangles_ = given_.triangles;
    cuts_ = EdgeCuts(2 * given_.vertices.size());
    for (const PaintedVertex& vertex : given_.vertices) {
      vertices_.push_back(vertex);
      add_spot();
    }
    while (find_cuts()) {
      cuts_.cut(triangles_, [this](std::uint32_t a, std::uint32_t b) { return add_middle(a, b); });
      if (triangles_.size() > given_.triangles.size() + 3 * kMostPaintTriangles) return false;
    }
    return true;
  }

  bool find_cuts() {
    cuts_.clear();
    for (std::size_t t = 0; t + 2 < triangles_.size(); t += 3) {
      const std::array<std::uint32_t, 3> corner = {triangles_[t], triangles_[t + 1], triangles_[t + 2]};
      if (vertices_[corner[0]].texture == PaintedVertex::kUnpainted) continue;
      const auto length = [&](std::size_t k) {
        const Spot &p = spots_[corner[k]], &q = spots_[corner[(k + 1) % 3]];
        return std::hypot(p.x - q.x, p.y - q.y);
      };
      const std::array<float, 3> lengths = {length(0), length(1), length(2)};
      const float longest = std::max({lengths[0], lengths[1], lengths[2]});
      if (longest <= kFinest || !is_seen(corner)) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (lengths[k] > std::max(kFinest, kLong * longest)) cuts_.mark(corner[k], corner[(k + 1) % 3]);
    }
    return !cuts_.empty();
  }

  static bool differ(const Level& a, const Level& b) {
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(a[i] - b[i]) > kSeen) return true;
    return false;
  }

  // Whether the image differs somewhere in a triangle from what is linear between its corners.
  bool is_seen(const std::array<std::uint32_t, 3>& corner) const {
    const std::array<Spot, 3> p = {spots_[corner[0]], spots_[corner[1]], spots_[corner[2]]};
    const Texture& texture = given_.textures[vertices_[corner[0]].texture];
    for (std::size_t k = 0; k < 3; ++k) {
      const Spot &a = p[k], &b = p[(k + 1) % 3];
      Level mean{};
      for (std::size_t i = 0; i < 4; ++i) mean[i] = (a.color[i] + b.color[i]) / 2;
      if (differ(texture.at((a.x + b.x) / 2, (a.y + b.y) / 2), mean)) return true;
    }
    const float abx = p[1].x - p[0].x, aby = p[1].y - p[0].y, acx = p[2].x - p[0].x, acy = p[2].y - p[0].y;
    const float twice = abx * acy - acx * aby;
    if (std::abs(twice) < 1e-3F) return false;  // a line, of which the middles were looked at
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int y = int(std::ceil(low)); y <= int(std::floor(high)); ++y) {
      float left = std::max({p[0].x, p[1].x, p[2].x}), right = std::min({p[0].x, p[1].x, p[2].x});
      for (std::size_t k = 0; k < 3; ++k) {
        const Spot &a = p[k], &b = p[(k + 1) % 3];
        if (a.y == b.y || float(y) < std::min(a.y, b.y) || float(y) > std::max(a.y, b.y)) continue;
        const float x = a.x + (b.x - a.x) * (float(y) - a.y) / (b.y - a.y);
        left = std::min(left, x), right = std::max(right, x);
      }
      for (int x = int(std::ceil(left)); x <= int(std::floor(right)); ++x) {
        const float to_x = float(x) - p[0].x, to_y = float(y) - p[0].y;
        const float b = (to_x * acy - acx * to_y) / twice, c = (abx * to_y - to_x * aby) / twice;
        const ColorBytes& own = texture.beyond(x, y);
        Level color{}, texel{};
        for (std::size_t i = 0; i < 4; ++i) {
          color[i] = p[0].color[i] + b * (p[1].color[i] - p[0].color[i]) + c * (p[2].color[i] - p[0].color[i]);
          texel[i] = float(own[i]);
        }
        if (differ(texel, color)) return true;
      }
    }
    return false;
  }

  PaintedMesh given_;
  std::vector<PaintedVertex> vertices_;
  std::vector<Spot> spots_;  // of each vertex
  std::vector<std::uint32_t> triangles_;
  EdgeCuts cuts_;
};

}  // namespace

TriangleMesh painted(PaintedMesh mesh) {
  return Painting(std::move(mesh)).run();
}

}  // namespace chainreel
