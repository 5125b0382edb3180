#include "mesh/open_sky.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scalar.hpp"

namespace chainreel {
namespace {

using Point3 = std::array<float, 3>;

constexpr float kPi = 3.14159265F;
constexpr int kCells = 22;          // along a body's longest side
constexpr float kApart = 0.7F;      // of a cell: points of surfaces
constexpr float kAhead = 1.1F;      // of a cell: where a surface looks at the sky from
constexpr float kTolerance = 0.6F;  // of a cell: what stands out less hides nothing
constexpr float kHides = 2.0F;      // of a cell: what stands out more hides all that is behind it
constexpr float kReturned = 0.4F;   // of the light that surfaces get they give to one another
constexpr float kSmallest = 1e-12F, kLargest = 1e12F;  // m: sides of bodies whose squares floats hold; others have no shade
constexpr float kBeyond = 0.5F;     // of a body's longest side: how far around it others count
constexpr int kDirections = 48;

Point3 placed(const PoseRows& m, const Point3& p) {
  return {m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3], m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
          m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11]};
}
Point3 turned(const PoseRows& m, const Point3& v) {
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[4] * v[0] + m[5] * v[1] + m[6] * v[2], m[8] * v[0] + m[9] * v[1] + m[10] * v[2]};
}
float dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point3 between(const Point3& a, const Point3& b, float t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}
float square(const Point3& a, const Point3& b) {
  const Point3 d = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  return dot(d, d);
}
float distance(const Point3& a, const Point3& b) { return std::sqrt(square(a, b)); }

float longest_side(const Point3& lower, const Point3& upper) {
  return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
}

Point3 normal_of_face(const std::array<Point3, 3>& p) {
  Point3 n = cross({p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]}, {p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]});
  const float length = std::sqrt(dot(n, n));
  for (float& x : n) x = length > 0 ? x / length : 0;
  return n;
}

// One point for each cell of a grid that triangles go through.
class PointGrid {
 public:
  PointGrid(SurfacePoints& to, float spacing) : to_(to), per_cell_(1 / spacing) {
    for (std::size_t i = 0; i < 3; ++i) count_[i] = 1 + std::size_t((to.upper[i] - to.lower[i]) * per_cell_);
    is_taken_.resize(count_[0] * count_[1] * count_[2]);
  }
  void add(const Point3& p) {
    std::array<std::size_t, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = std::min(count_[i] - 1, std::size_t(std::max(0.0F, (p[i] - to_.lower[i]) * per_cell_)));
    std::uint8_t& taken = is_taken_[(at[2] * count_[1] + at[1]) * count_[0] + at[0]];
    if (taken != 0) return;
    to_.points.push_back(p);
    to_.normals.push_back(normal_of_face(triangle_));
    taken = 1;
  }
  // Rows of points, from the longest side to the corner opposite of it.
  void add_triangle(std::array<Point3, 3> p) {
    triangle_ = p;
    // Of small ones others have the other corners, or what is as near.
    if (std::max({square(p[0], p[1]), square(p[1], p[2]), square(p[2], p[0])}) * per_cell_ * per_cell_ <= 1) return add(p[0]);
    const float ab = distance(p[0], p[1]), bc = distance(p[1], p[2]), ca = distance(p[2], p[0]);
    if (bc >= ab && bc >= ca) p = {p[1], p[2], p[0]};
    else if (ca > ab) p = {p[2], p[0], p[1]};
    const int rows = 1 + int(std::min(ab + bc + ca - std::max({ab, bc, ca}), 2 * distance(p[2], between(p[0], p[1], 0.5F))) * per_cell_);
    for (int row = 0; row <= rows; ++row) {
      const Point3 from = between(p[0], p[2], float(row) / float(rows)), to = between(p[1], p[2], float(row) / float(rows));
      const int steps = 1 + int(distance(from, to) * per_cell_);
      for (int step = 0; step <= steps; ++step) add(between(from, to, float(step) / float(steps)));
    }
  }

 private:
  SurfacePoints& to_;
  float per_cell_;
  std::array<Point3, 3> triangle_{};
  std::array<std::size_t, 3> count_{};
  std::vector<std::uint8_t> is_taken_;
};

// Evenly over the sphere, each far from the one before.
Point3 direction(int i) {
  constexpr double kGoldenAngle = 2.399963229728653;
  const double z = 1 - (2 * i + 1.0) / kDirections, r = std::sqrt(1 - z * z);
  const auto [s, c] = sin_cos(kGoldenAngle * i);
  return {float(r * c), float(r * s), float(z)};
}

}  // namespace

SurfacePoints::SurfacePoints(std::span<const PlacedTriangles> shapes) {
  lower.fill(std::numeric_limits<float>::max());
  upper.fill(std::numeric_limits<float>::lowest());
  std::vector<std::vector<Point3>> vertices;
  for (const PlacedTriangles& shape : shapes) {
    std::vector<Point3>& own = vertices.emplace_back();
    own.reserve(shape.mesh->vertices.size());
    for (const TriangleMesh::Vertex& vertex : shape.mesh->vertices) {
      own.push_back(placed(shape.pose, vertex.position));
      for (std::size_t i = 0; i < 3; ++i) {
        lower[i] = std::min(lower[i], own.back()[i]);
        upper[i] = std::max(upper[i], own.back()[i]);
      }
    }
  }
  const float side = longest_side(lower, upper);
  if (!(side > kSmallest && side < kLargest)) return;
  spacing = kApart * side / kCells;
  PointGrid grid(*this, spacing);
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const std::vector<std::uint32_t>& corners = shapes[s].mesh->triangles;
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3)
      grid.add_triangle({vertices[s][corners[t]], vertices[s][corners[t + 1]], vertices[s][corners[t + 2]]});
  }
}

OpenSky::OpenSky(const SurfacePoints& body, std::span<const Neighbor> neighbors) {
  if (!(body.spacing > 0)) return;
  cell_ = body.spacing / kApart;
  for (std::size_t i = 0; i < 3; ++i) {
    first_[i] = body.lower[i] - 2 * cell_;
    count_[i] = 5 + int((body.upper[i] - body.lower[i]) / cell_);
  }
  mark_ahead(body);
  for (std::size_t pose = 0; pose < kPoses; ++pose) {
    const Hiding all = hiding(body, neighbors, pose);
    for (int i = int(pose); i < kDirections; i += int(kPoses)) look_along(direction(i), body, all);
  }
}

// The nodes around the places that surfaces look at the sky from.
void OpenSky::mark_ahead(const SurfacePoints& body) {
  node_.assign(std::size_t(count_[0]) * std::size_t(count_[1]) * std::size_t(count_[2]), -1);
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    std::array<int, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = std::clamp(int((body.points[i][k] - first_[k]) / cell_ + kAhead * body.normals[i][k]), 0, count_[k] - 2);
    for (int corner = 0; corner < 8; ++corner) {
      const int x = at[0] + (corner & 1), y = at[1] + (corner >> 1 & 1), z = at[2] + (corner >> 2);
      std::int32_t& node = node_[index(x, y, z)];
      if (node >= 0) continue;
      node = std::int32_t(places_.size());
      places_.add({first_[0] + float(x) * cell_, first_[1] + float(y) * cell_, first_[2] + float(z) * cell_});
    }
  }
  nodes_.resize(places_.size());
}

OpenSky::Hiding OpenSky::hiding(const SurfacePoints& body, std::span<const Neighbor> neighbors, std::size_t pose) const {
  Hiding result;
  for (const Point3& p : body.points) result.points.add(p);
  result.width.assign(body.points.size(), 1);
  const float around = kBeyond * longest_side(body.lower, body.upper);
  for (const Neighbor& neighbor : neighbors) {
    constexpr float kWidest = 16;  // texels: of what is so much coarser than the body only holes are missed
    const int width = std::max(1, int(std::min(kWidest, neighbor.points->spacing / kApart / cell_)));
    for (const Point3& point : neighbor.points->points) {
      const Point3 p = placed(neighbor.poses[pose], point);
      bool is_near = true;
      for (std::size_t i = 0; i < 3; ++i) is_near &= p[i] >= body.lower[i] - around && p[i] <= body.upper[i] + around;
      if (!is_near) continue;
      result.points.add(p);
      result.width.push_back(width);
    }
  }
  return result;
}

void OpenSky::look_along(const Point3& direction, const SurfacePoints& body, const Hiding& hiding) {
  // Two axes across, in texels, and the map's square around the body and the nodes.
  const float per_texel = 1 / cell_;
  const Point3 other = std::abs(direction[2]) < 0.7F ? Point3{0, 0, 1} : Point3{1, 0, 0};
  Point3 u = cross(other, direction);
  const float length = std::sqrt(dot(u, u));
  for (float& x : u) x *= per_texel / length;
  const Point3 v = cross(direction, u);
  const Point3 middle = between(body.lower, body.upper, 0.5F);
  const int side = 10 + int(distance(body.lower, body.upper) * per_texel);
  const float size = float(side), left = size / 2 - dot(u, middle), top = size / 2 - dot(v, middle);
  const std::size_t beside = std::size_t(side) * std::size_t(side);  // where all lies that is not on the map
  map_.assign(beside + 1, std::numeric_limits<float>::lowest());
  // A loop that the compiler makes into vectors; texels are whole numbers that floats hold exactly.
  const auto place = [&](const Points& points) {
    const std::size_t count = points.size();
    const float *x = points.at[0].data(), *y = points.at[1].data(), *z = points.at[2].data();
    depth_.resize(count), texel_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      depth_[i] = direction[0] * x[i] + direction[1] * y[i] + direction[2] * z[i];
      const float column = u[0] * x[i] + u[1] * y[i] + u[2] * z[i] + left, row = v[0] * x[i] + v[1] * y[i] + v[2] * z[i] + top;
      const bool is_on = (column >= 0) & (column < size) & (row >= 0) & (row < size);
      const float texel = float(int(row)) * size + float(int(column));
      texel_[i] = int(is_on ? texel : size * size);
    }
  };
  place(hiding.points);
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    const auto texel = std::size_t(texel_[i]);
    if (hiding.width[i] == 1) map_[texel] = std::max(map_[texel], depth_[i]);
    if (hiding.width[i] == 1 || texel == beside) continue;
    const int half = hiding.width[i] / 2, x = texel_[i] % side, y = texel_[i] / side;
    for (int row = std::max(0, y - half); row <= std::min(side - 1, y + half); ++row)
      for (int column = std::max(0, x - half); column <= std::min(side - 1, x + half); ++column) {
        float& there = map_[std::size_t(row * side + column)];
        there = std::max(there, depth_[i]);
      }
  }
  map_[beside] = std::numeric_limits<float>::lowest();
  place(places_);
  constexpr float kWeight = 4 * kPi / kDirections;
  const float hides = kHides * cell_, per_ramp = per_texel / (kHides - kTolerance);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const float seen = kWeight * std::clamp((hides - (map_[std::size_t(texel_[i])] - depth_[i])) * per_ramp, 0.0F, 1.0F);
    nodes_[i] = {nodes_[i][0] + seen * direction[0], nodes_[i][1] + seen * direction[1], nodes_[i][2] + seen * direction[2], nodes_[i][3] + seen};
  }
}

float OpenSky::openness(const Point3& place, const Point3& normal) const {
  if (nodes_.empty()) return 1;
  std::array<int, 3> at;
  std::array<float, 3> part, behind;  // of the place that is looked up from, in its cell; of the surface, from its first node
  for (std::size_t i = 0; i < 3; ++i) {
    const float surface = (place[i] - first_[i]) / cell_, x = surface + kAhead * normal[i];
    at[i] = std::clamp(int(x), 0, count_[i] - 2);
    part[i] = std::clamp(x - float(at[i]), 0.0F, 1.0F);
    behind[i] = surface - float(at[i]);
  }
  float sum = 0, weights = 0;
  const float first_ahead = -dot(behind, normal);
  for (int dz = 0; dz < 2; ++dz)
    for (int dy = 0; dy < 2; ++dy) {
      const std::int32_t* const row = &node_[index(at[0], at[1] + dy, at[2] + dz)];
      const float across = (dy ? part[1] : 1 - part[1]) * (dz ? part[2] : 1 - part[2]);
      const float row_ahead = first_ahead + float(dy) * normal[1] + float(dz) * normal[2];
      for (int dx = 0; dx < 2; ++dx) {
        // What lies behind the surface says nothing about its front.
        const float ahead = row_ahead + float(dx) * normal[0];
        if (row[dx] < 0 || ahead <= 0) continue;
        const float weight = across * (dx ? part[0] : 1 - part[0]) * std::min(1.0F, 2 * ahead);
        const Node& node = nodes_[std::size_t(row[dx])];
        sum += weight * (node[3] / 4 + (normal[0] * node[0] + normal[1] * node[1] + normal[2] * node[2]) / 2);
        weights += weight;
      }
    }
  if (weights <= 1e-4F) return 1;
  const float sky = std::clamp(sum / (weights * kPi), 0.0F, 1.0F);
  return sky / (1 - kReturned * (1 - sky));
}

std::uint8_t OpenSky::openness_of(const TriangleMesh::Vertex& vertex, const PoseRows& pose) const {
  return std::uint8_t(255 * openness(placed(pose, vertex.position), turned(pose, vertex.normal)) + 0.5F);
}

std::vector<std::uint8_t> OpenSky::openness_of(const PlacedTriangles& shape) const {
  std::vector<std::uint8_t> result;
  result.reserve(shape.mesh->vertices.size());
  for (const TriangleMesh::Vertex& vertex : shape.mesh->vertices) result.push_back(openness_of(vertex, shape.pose));
  return result;
}

}  // namespace chainreel
