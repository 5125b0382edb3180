#include <cmath>
#include <cstdlib>

#include "mesh/edge_cuts.hpp"
#include "mesh/open_sky.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kFewTriangles = 6000;  // of a mesh that may need finer ones
constexpr float kShortest = 2.5F;            // cells of the sky: edges that are not cut
constexpr int kRounds = 2;
constexpr int kUneven = 32;  // of 255: how far the openness in the middle may be from the mean of both ends

class Refinement {
 public:
  Refinement(const PlacedTriangles& shape, const OpenSky& sky)
      : pose_(shape.pose), sky_(sky), mesh_(*shape.mesh), openness_(sky.openness_of(shape)), cuts_(mesh_.vertices.size()) {
    for (const TriangleMesh::Vertex& vertex : mesh_.vertices) cuts_.add_place(vertex.position);
  }

  RefinedMesh run() {
    bool any = false;
    for (int round = 0; round < kRounds && find_cuts(); ++round) {
      cuts_.cut(mesh_.triangles, [this](std::uint32_t a, std::uint32_t b) { return add_middle(a, b); });
      any = true;
    }
    if (!any) return {{}, std::move(openness_), false};
    return {std::move(mesh_), std::move(openness_), true};
  }

 private:
  bool find_cuts() {
    cuts_.clear();
    const float shortest = kShortest * sky_.cell();
    for (std::size_t t = 0; t + 2 < mesh_.triangles.size(); t += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.triangles[t + k], b = mesh_.triangles[t + (k + 1) % 3];
        const auto &p = mesh_.vertices[a].position, &q = mesh_.vertices[b].position;
        const float x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
        if (x * x + y * y + z * z <= shortest * shortest) continue;
        const int mean = (openness_[a] + openness_[b] + 1) / 2;
        if (std::abs(sky_.openness_of(middle_of(mesh_.vertices[a], mesh_.vertices[b]), pose_) - mean) > kUneven) cuts_.mark(a, b);
      }
    return !cuts_.empty();
  }

  std::uint32_t add_middle(std::uint32_t a, std::uint32_t b) {
    mesh_.vertices.push_back(middle_of(mesh_.vertices[a], mesh_.vertices[b]));
    openness_.push_back(sky_.openness_of(mesh_.vertices.back(), pose_));
    cuts_.add_place(mesh_.vertices.back().position);
    return std::uint32_t(mesh_.vertices.size() - 1);
  }

  PoseRows pose_;
  const OpenSky& sky_;
  TriangleMesh mesh_;
  std::vector<std::uint8_t> openness_;
  EdgeCuts cuts_;
};

}  // namespace

RefinedMesh refined(const PlacedTriangles& shape, const OpenSky& sky) {
  if (shape.mesh->triangles.size() / 3 > kFewTriangles) return {{}, sky.openness_of(shape), false};
  return Refinement(shape, sky).run();
}

}  // namespace chainreel
