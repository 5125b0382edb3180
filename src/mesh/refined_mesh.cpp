// Edges are cut in halves, those at one place by all triangles that meet there, so that closed surfaces stay closed.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <unordered_map>
#include <unordered_set>

#include "core/equal_items.hpp"
#include "mesh/open_sky.hpp"

namespace chainreel {
namespace {

using Vertex = TriangleMesh::Vertex;

constexpr std::size_t kFewTriangles = 6000;  // of a mesh that may need finer ones
constexpr float kShortest = 2.5F;            // cells of the sky: edges that are not cut
constexpr int kRounds = 2;
constexpr int kUneven = 32;  // of 255: how far the openness in the middle may be from the mean of both ends

Vertex middle_of(const Vertex& a, const Vertex& b) {
  Vertex middle = a;
  float length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    middle.position[i] = (a.position[i] + b.position[i]) / 2;
    middle.normal[i] = a.normal[i] + b.normal[i];
    length += middle.normal[i] * middle.normal[i];
  }
  length = std::sqrt(length);
  for (std::size_t i = 0; i < 3; ++i) middle.normal[i] = length > 0 ? middle.normal[i] / length : a.normal[i];
  for (std::size_t i = 0; i < 4; ++i) middle.color[i] = std::uint8_t((a.color[i] + b.color[i] + 1) / 2);
  return middle;
}

class Refinement {
 public:
  Refinement(const PlacedTriangles& shape, const OpenSky& sky)
      : pose_(shape.pose), sky_(sky), mesh_(*shape.mesh), openness_(sky.openness_of(shape)), places_(mesh_.vertices.size()) {
    for (const Vertex& vertex : mesh_.vertices) add_place(vertex);
  }

  RefinedMesh run() {
    bool any = false;
    for (int round = 0; round < kRounds && find_cuts(); ++round) {
      cut();
      any = true;
    }
    if (!any) return {{}, std::move(openness_), false};
    return {std::move(mesh_), std::move(openness_), true};
  }

 private:
  // What an edge between two places becomes.
  using Edge = std::uint64_t;
  Edge edge_of(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t from = place_[a], to = place_[b];
    return Edge(std::min(from, to)) << 32 | std::max(from, to);
  }

  void add_place(const Vertex& vertex) {
    std::array<float, 3> at = vertex.position;
    for (float& x : at) x += 0.0F;  // -0 is at 0
    place_.push_back(places_.index_of(at));
  }

  bool find_cuts() {
    is_cut_.clear();
    const float shortest = kShortest * sky_.cell();
    for (std::size_t t = 0; t + 2 < mesh_.triangles.size(); t += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.triangles[t + k], b = mesh_.triangles[t + (k + 1) % 3];
        const auto &p = mesh_.vertices[a].position, &q = mesh_.vertices[b].position;
        const float x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
        if (x * x + y * y + z * z <= shortest * shortest) continue;
        const int mean = (openness_[a] + openness_[b] + 1) / 2;
        if (std::abs(sky_.openness_of(middle_of(mesh_.vertices[a], mesh_.vertices[b]), pose_) - mean) > kUneven) is_cut_.insert(edge_of(a, b));
      }
    return !is_cut_.empty();
  }

  void cut() {
    std::vector<std::uint32_t> before;
    before.swap(mesh_.triangles);
    middles_.clear();
    for (std::size_t t = 0; t + 2 < before.size(); t += 3) {
      std::array<std::uint32_t, 3> corner = {before[t], before[t + 1], before[t + 2]};
      const auto is_cut = [&](std::size_t k) { return is_cut_.contains(edge_of(corner[k], corner[(k + 1) % 3])); };
      const int cuts = int(is_cut(0)) + int(is_cut(1)) + int(is_cut(2));
      // One cut lies at the first edge, two at the first two.
      while (cuts == 1 ? !is_cut(0) : cuts == 2 && is_cut(2)) std::rotate(corner.begin(), corner.begin() + 1, corner.end());
      const auto [a, b, c] = corner;
      if (cuts == 0) {
        add(a, b, c);
        continue;
      }
      const std::uint32_t ab = middle(a, b);
      if (cuts == 1) {
        add(a, ab, c), add(ab, b, c);
        continue;
      }
      const std::uint32_t bc = middle(b, c);
      add(ab, b, bc);
      if (cuts == 2) {
        add(a, ab, bc), add(a, bc, c);
        continue;
      }
      const std::uint32_t ca = middle(c, a);
      add(a, ab, ca), add(ab, bc, ca), add(ca, bc, c);
    }
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c}); }

  // Of two vertices, which is not that of two others at the same places.
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [known, is_new] = middles_.try_emplace(std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), std::uint32_t(mesh_.vertices.size()));
    if (!is_new) return known->second;
    const Vertex vertex = middle_of(mesh_.vertices[a], mesh_.vertices[b]);
    mesh_.vertices.push_back(vertex);
    openness_.push_back(sky_.openness_of(vertex, pose_));
    add_place(vertex);
    return known->second;
  }

  PoseRows pose_;
  const OpenSky& sky_;
  TriangleMesh mesh_;
  std::vector<std::uint8_t> openness_;
  EqualItems<std::array<float, 3>> places_;
  std::vector<std::uint32_t> place_;  // of each vertex
  std::unordered_set<Edge> is_cut_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  // of two vertices
};

}  // namespace

RefinedMesh refined(const PlacedTriangles& shape, const OpenSky& sky) {
  if (shape.mesh->triangles.size() / 3 > kFewTriangles) return {{}, sky.openness_of(shape), false};
  return Refinement(shape, sky).run();
}

}  // namespace chainreel
