#include "mesh/edge_cuts.hpp"

#include <cmath>

namespace chainreel {

TriangleMesh::Vertex middle_of(const TriangleMesh::Vertex& a, const TriangleMesh::Vertex& b) {
  TriangleMesh::Vertex middle = a;
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

void EdgeCuts::add_place(const std::array<float, 3>& position) {
  std::array<float, 3> at = position;
  for (float& x : at) x += 0.0F;  // -0 is at 0
  place_.push_back(places_.index_of(at));
}

void EdgeCuts::cut(std::vector<std::uint32_t>& triangles, const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& add_middle) {
  std::unordered_map<std::uint64_t, std::uint32_t> middles;  // of two vertices, which are not those of two others at the same places
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [known, is_new] = middles.try_emplace(of_two(a, b), 0);
    if (is_new) known->second = add_middle(a, b);
    return known->second;
  };
  std::vector<std::uint32_t> before;
  before.swap(triangles);
  triangles.reserve(2 * before.size());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles.insert(triangles.end(), {a, b, c}); };
  for (std::size_t t = 0; t + 2 < before.size(); t += 3) {
    std::array<std::uint32_t, 3> corner = {before[t], before[t + 1], before[t + 2]};
    std::array<bool, 3> cuts = {is_marked(corner[0], corner[1]), is_marked(corner[1], corner[2]), is_marked(corner[2], corner[0])};
    const int count = int(cuts[0]) + int(cuts[1]) + int(cuts[2]);
    // One cut lies at the first edge, two at the first two.
    while (count == 1 ? !cuts[0] : count == 2 && cuts[2]) {
      std::rotate(corner.begin(), corner.begin() + 1, corner.end());
      std::rotate(cuts.begin(), cuts.begin() + 1, cuts.end());
    }
    const auto [a, b, c] = corner;
    if (count == 0) {
      add(a, b, c);
      continue;
    }
    const std::uint32_t ab = middle(a, b);
    if (count == 1) {
      add(a, ab, c), add(ab, b, c);
      continue;
    }
    const std::uint32_t bc = middle(b, c);
    add(ab, b, bc);
    if (count == 2) {
      add(a, ab, bc), add(a, bc, c);
      continue;
    }
    const std::uint32_t ca = middle(c, a);
    add(a, ab, ca), add(ab, bc, ca), add(ca, bc, c);
  }
}

}  // namespace chainreel
