// Edges of a mesh cut in halves, those at one place by all triangles that meet there, so that closed surfaces stay closed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/equal_items.hpp"
#include "core/triangle_mesh.hpp"

namespace chainreel {

// The vertex half way: its normal has unit length again, its colour is the mean.
TriangleMesh::Vertex middle_of(const TriangleMesh::Vertex& a, const TriangleMesh::Vertex& b);

class EdgeCuts {
 public:
  explicit EdgeCuts(std::size_t expected_vertices = 0) : places_(expected_vertices) {}

  // The places of all vertices, in their order, those that a cut made included.
  void add_place(const std::array<float, 3>& position);

  // The edge between two vertices is to be cut, and so is any other between their places.
  void mark(std::uint32_t a, std::uint32_t b) { is_cut_.insert(edge_of(a, b)); }
  bool is_marked(std::uint32_t a, std::uint32_t b) const { return is_cut_.contains(edge_of(a, b)); }
  bool empty() const { return is_cut_.empty(); }
  void clear() { is_cut_.clear(); }

  // Cuts all that are marked. `add_middle(a, b)` makes the vertex in the middle of two, once for each two, says its place, and
  // gives its index.
  void cut(std::vector<std::uint32_t>& triangles, const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& add_middle);

 private:
  using Edge = std::uint64_t;  // between two places
  static Edge of_two(std::uint32_t a, std::uint32_t b) { return Edge(std::min(a, b)) << 32 | std::max(a, b); }
  Edge edge_of(std::uint32_t a, std::uint32_t b) const { return of_two(place_[a], place_[b]); }

  EqualItems<std::array<float, 3>> places_;
  std::vector<std::uint32_t> place_;  // of each vertex
  std::unordered_set<Edge> is_cut_;
};

}  // namespace chainreel
