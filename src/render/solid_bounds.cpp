#include "render/solid_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "core/equal_items.hpp"

namespace chainreel {
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
      !std::all_of(solids.nearing.begin(), solids.nearing.end(), good) || !good(solids.opacity) || !good(solids.outline_width))
    return false;
  return std::all_of(solids.parts.begin(), solids.parts.end(), [&](const Solid& solid) {
    return solid.mesh && (!solid.openness || solid.openness->size() == solid.mesh->vertices.size()) && std::all_of(solid.to_view.begin(), solid.to_view.end(), good);
  });
}

namespace {

// For each vertex the number of its place.
std::vector<std::uint32_t> places_of(const TriangleMesh& mesh) {
  EqualItems<std::array<float, 3>> places(mesh.vertices.size() / 2);
  std::vector<std::uint32_t> place;
  place.reserve(mesh.vertices.size());
  for (const TriangleMesh::Vertex& vertex : mesh.vertices) {
    std::array<float, 3> at = vertex.position;
    for (float& x : at) x += 0.0F;  // -0 is at 0
    place.push_back(places.index_of(at));
  }
  return place;
}

// Sets that are joined step by step.
class Parts {
 public:
  explicit Parts(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0u); }
  std::uint32_t of(std::uint32_t i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { above_[of(a)] = of(b); }

 private:
  std::vector<std::uint32_t> above_;
};

struct Edge {
  std::uint32_t upper = 0;  // the place with the higher number
  std::uint32_t triangle : 31 = 0;
  std::uint32_t is_upward : 1 = 0;  // run along from the lower place
};

// The edges of all triangles, those of one lower place beside one another, in the order of their upper places: of place i from
// first[i] to first[i + 1].
struct Edges {
  Edges(const TriangleMesh& mesh, const std::vector<std::uint32_t>& place) : first(mesh.vertices.size() + 1, 0) {
    const auto for_each = [&](const auto& take) {
      for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
        const std::uint32_t corners[] = {place[mesh.triangles[t]], place[mesh.triangles[t + 1]], place[mesh.triangles[t + 2]]};
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t a = corners[k], b = corners[k == 2 ? 0 : k + 1];
          if (a != b) take(std::min(a, b), std::max(a, b), std::uint32_t(t / 3), a < b);
        }
      }
    };
    for_each([&](std::uint32_t lower, std::uint32_t, std::uint32_t, bool) { ++first[lower + 1]; });
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    row.resize(first.back());
    std::vector<std::uint32_t> next = first;
    for_each([&](std::uint32_t lower, std::uint32_t upper, std::uint32_t triangle, bool is_upward) {
      row[next[lower]++] = {upper, triangle & 0x7fffffffU, is_upward};
    });
    for (std::size_t i = 0; i + 1 < first.size(); ++i)
      std::sort(row.begin() + first[i], row.begin() + first[i + 1],
                [](const Edge& a, const Edge& b) { return a.upper < b.upper; });
  }

  std::vector<std::uint32_t> first;
  std::vector<Edge> row;
};

// Six times the volume between a triangle and the origin.
double six_volumes(const TriangleMesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t k) { return mesh.vertices[mesh.triangles[3 * triangle + k]].position; };
  const auto a = at(0), b = at(1), c = at(2);
  return a[0] * (double(b[1]) * c[2] - double(b[2]) * c[1]) +
         a[1] * (double(b[2]) * c[0] - double(b[0]) * c[2]) +
         a[2] * (double(b[0]) * c[1] - double(b[1]) * c[0]);
}

// A triangle's edge between two places: its corners there, as it runs, and the third.
struct Side {
  std::uint32_t from = 0, to = 0, third = 0;
};

Side side_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& place, const Edge& edge) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = [&](std::size_t corner) { return mesh.triangles[3 * std::size_t(edge.triangle) + (k + corner) % 3]; };
    const std::uint32_t from = place[at(0)], to = place[at(1)];
    if (std::max(from, to) == edge.upper && (from < to) == (edge.is_upward == 1)) return {at(0), at(1), at(2)};
  }
  return {};
}

bool bends(const TriangleMesh& mesh, std::uint32_t one, std::uint32_t other) {
  constexpr float kCosine = 0.8660254F;  // of 30 degrees
  const auto &n = mesh.vertices[one].normal, &m = mesh.vertices[other].normal;
  return n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < kCosine;
}

std::vector<Crease> creases_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& place, const Edges& edges) {
  std::vector<Crease> creases;
  for (std::size_t lower = 0; lower + 1 < edges.first.size(); ++lower)
    for (std::uint32_t i = edges.first[lower], behind = edges.first[lower + 1], end = i; i < behind; i = end) {
      for (end = i; end < behind && edges.row[end].upper == edges.row[i].upper;) ++end;
      if (end - i != 2 || edges.row[i].is_upward == edges.row[i + 1].is_upward) continue;
      const Side one = side_of(mesh, place, edges.row[i]), other = side_of(mesh, place, edges.row[i + 1]);
      if (bends(mesh, one.from, other.to) && bends(mesh, one.to, other.from)) creases.push_back({one.from, one.to, one.third, other.third});
    }
  return creases;
}

SortedTriangles closed_parts_first(const TriangleMesh& mesh, const Edges& edges) {
  const std::size_t count = mesh.triangles.size() / 3;
  Parts parts(count);
  std::vector<std::uint32_t> torn;  // triangles at edges that do not join two
  for (std::size_t place = 0; place + 1 < edges.first.size(); ++place)
    for (std::uint32_t i = edges.first[place], behind = edges.first[place + 1]; i < behind;) {
      std::uint32_t end = i;
      int sense = 0;
      for (; end < behind && edges.row[end].upper == edges.row[i].upper; ++end) {
        sense += edges.row[end].is_upward ? 1 : -1;
        parts.join(edges.row[i].triangle, edges.row[end].triangle);
      }
      if (end - i != 2 || sense != 0) torn.push_back(edges.row[i].triangle);
      i = end;
    }
  std::vector<double> volume(count, 0.0);
  for (std::size_t t = 0; t < count; ++t) volume[parts.of(std::uint32_t(t))] += six_volumes(mesh, t);
  for (const std::uint32_t t : torn) volume[parts.of(t)] = -1;

  const auto is_opaque = [&](std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.vertices[mesh.triangles[3 * t + k]].color[3] < 255) return false;
    return true;
  };
  enum Group : std::uint8_t { closed, open, translucent };
  std::vector<Group> group(count);
  for (std::size_t t = 0; t < count; ++t)
    group[t] = !is_opaque(t) ? translucent : volume[parts.of(std::uint32_t(t))] > 0 ? closed : open;

  SortedTriangles sorted;
  sorted.indices.reserve(3 * count);
  for (const Group wanted : {closed, open, translucent}) {
    for (std::size_t t = 0; t < count; ++t)
      if (group[t] == wanted)
        sorted.indices.insert(sorted.indices.end(), mesh.triangles.begin() + std::ptrdiff_t(3 * t),
                              mesh.triangles.begin() + std::ptrdiff_t(3 * t + 3));
    if (wanted == closed) sorted.closed = sorted.indices.size() / 3;
    if (wanted == open) sorted.opaque = sorted.indices.size() / 3;
  }
  return sorted;
}

}  // namespace

MeshSurface::MeshSurface(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> place = places_of(mesh);
  const Edges edges(mesh, place);
  triangles = closed_parts_first(mesh, edges);
  creases = creases_of(mesh, place, edges);
}

}  // namespace chainreel
