// Which triangles a mesh has, in a few kilobytes, so that two states of a file can be compared when one of
// them is gone: how many triangles came and went, whatever the order of triangles and vertices in the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/json.hpp"
#include "core/triangle_mesh.hpp"

namespace chainreel {

struct TriangleSketch {
  static constexpr std::size_t kBuckets = 256;
  static constexpr std::size_t kLargestSample = 256;

  std::size_t triangles = 0;
  // Sums modulo 2^64 over all triangles of their hashes: by the places of their vertices, in their turning
  // sense; and of their colours besides.
  std::uint64_t shape = 0, colors = 0;
  // Sums of the components of all normals under signs by lot, which their triangle's hash decides: two
  // surfaces of one shape are shaded alike where these agree but for round-off (normals are sums over
  // neighbours in the file's order).
  std::array<double, 4> normals{};
  std::array<float, 3> lower{}, upper{};  // of the box around it, m
  // Of meshes with more triangles than a sample holds: sums of the hashes, triangle by triangle in the bucket
  // that its hash names. A bucket tells of a change in it, so that few changes are counted nearly one by one.
  std::vector<std::uint32_t> buckets;
  // Hashes of those triangles that have `thinning` zeros in theirs, rising: all of a small mesh, a fair lot
  // of a large one.
  int thinning = 0;
  std::vector<std::uint32_t> sample;
};

// Round-off of normals is no difference.
bool operator==(const TriangleSketch& a, const TriangleSketch& b);
bool has_same_normals(const TriangleSketch& a, const TriangleSketch& b);

TriangleSketch sketch_of(const TriangleMesh& mesh);

struct TriangleDifference {
  double gone = 0, come = 0;  // triangles; one that was moved did both
  bool is_counted = true;     // else estimated: within some 10 %
  double share = 0;           // the larger of the two, of all
};
TriangleDifference difference_of(const TriangleSketch& before, const TriangleSketch& after);

Json to_json(const TriangleSketch& sketch);
// Throws Json::exception, or std::invalid_argument, where it is none.
TriangleSketch triangle_sketch_of(const Json& json);

}  // namespace chainreel
