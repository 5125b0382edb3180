#include "mesh/triangle_sketch.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "mesh/read_mesh.hpp"

namespace chainreel {
namespace {

// Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014; the finaliser.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::uint64_t with(std::uint64_t hash, std::uint64_t more) {
  return mixed(hash + 0x9e3779b97f4a7c15ULL + more);
}

std::uint64_t hash_of_place(const TriangleMesh::Vertex& vertex) {
  std::uint64_t hash = 0;
  for (const float x : vertex.position) hash = with(hash, std::bit_cast<std::uint32_t>(x == 0 ? 0.0F : x));
  return hash;
}

struct TriangleHash {
  std::uint64_t shape, colors;
};

using TurnedCorners = std::array<std::uint32_t, 3>;

// From the corner with the least hash on, so that it does not matter with which of them a file begins.
TurnedCorners corners_of(const TriangleMesh& mesh, std::size_t first,
                         const std::vector<std::uint64_t>& places) {
  TurnedCorners corners{};
  std::copy_n(mesh.triangles.begin() + std::ptrdiff_t(first), 3, corners.begin());
  const auto least = std::min_element(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
    return places[a] < places[b];
  });
  std::rotate(corners.begin(), least, corners.end());
  return corners;
}

TriangleHash hash_of(const TriangleMesh& mesh, const TurnedCorners& corners,
                     const std::vector<std::uint64_t>& places) {
  TriangleHash hash{1, 2};
  for (const std::uint32_t corner : corners) {
    hash.shape = with(hash.shape, places[corner]);
    hash.colors =
        with(with(hash.colors, places[corner]), std::bit_cast<std::uint32_t>(mesh.vertices[corner].color));
  }
  return hash;
}

void add_normals(const TriangleMesh& mesh, const TurnedCorners& corners, std::uint64_t hash,
                 std::array<double, 4>& sums) {
  for (const std::uint32_t corner : corners) {
    hash = mixed(hash + 1);
    std::uint64_t signs = hash;
    for (double& sum : sums)
      for (const float component : mesh.vertices[corner].normal) {
        sum += signs & 1 ? double(component) : -double(component);
        signs >>= 1;
      }
  }
}

std::uint32_t short_of(std::uint64_t hash) {
  return std::uint32_t(hash >> 32);
}

void add_boxes(const TriangleMesh& mesh, TriangleSketch& sketch) {
  if (mesh.triangles.empty()) return;
  sketch.lower = sketch.upper = mesh.vertices[mesh.triangles.front()].position;
  for (const std::uint32_t corner : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      sketch.lower[i] = std::min(sketch.lower[i], mesh.vertices[corner].position[i]);
      sketch.upper[i] = std::max(sketch.upper[i], mesh.vertices[corner].position[i]);
    }
}

// How many values two sorted lists do not have in common, each as often as it stands there.
struct Unshared {
  std::size_t gone = 0, come = 0;
};
Unshared unshared_of(const std::vector<std::uint32_t>& before, const std::vector<std::uint32_t>& after) {
  Unshared unshared;
  std::size_t i = 0, k = 0;
  while (i < before.size() && k < after.size()) {
    if (before[i] == after[k])
      ++i, ++k;
    else if (before[i] < after[k])
      ++unshared.gone, ++i;
    else
      ++unshared.come, ++k;
  }
  unshared.gone += before.size() - i;
  unshared.come += after.size() - k;
  return unshared;
}

std::vector<std::uint32_t> thinned(const std::vector<std::uint32_t>& sample, int thinning) {
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t hash : sample)
    if (std::countr_zero(hash) >= thinning) kept.push_back(hash);
  return kept;
}

}  // namespace

TriangleSketch sketch_of(const TriangleMesh& mesh) {
  std::vector<std::uint64_t> places;
  places.reserve(mesh.vertices.size());
  for (const TriangleMesh::Vertex& vertex : mesh.vertices) places.push_back(hash_of_place(vertex));
  TriangleSketch sketch;
  sketch.triangles = mesh.triangles.size() / 3;
  sketch.buckets.assign(TriangleSketch::kBuckets, 0);
  for (std::size_t first = 0; first + 2 < mesh.triangles.size(); first += 3) {
    const TurnedCorners corners = corners_of(mesh, first, places);
    const TriangleHash hash = hash_of(mesh, corners, places);
    add_normals(mesh, corners, hash.shape, sketch.normals);
    sketch.shape += hash.shape;
    sketch.colors += hash.colors;
    sketch.buckets[hash.shape % TriangleSketch::kBuckets] += short_of(hash.shape);
    if (std::countr_zero(short_of(hash.shape)) < sketch.thinning) continue;
    sketch.sample.push_back(short_of(hash.shape));
    while (sketch.sample.size() > TriangleSketch::kLargestSample)
      sketch.sample = thinned(sketch.sample, ++sketch.thinning);
  }
  std::sort(sketch.sample.begin(), sketch.sample.end());
  if (sketch.thinning == 0) sketch.buckets.clear();  // the sample knows all
  add_boxes(mesh, sketch);
  return sketch;
}

bool has_same_normals(const TriangleSketch& a, const TriangleSketch& b) {
  // Of floats, the errors of so many summands under signs by lot, several times.
  const double tolerance = 1e-6 * std::sqrt(1 + 9 * double(a.triangles));
  for (std::size_t i = 0; i < a.normals.size(); ++i)
    if (!(std::abs(a.normals[i] - b.normals[i]) <= tolerance)) return false;
  return true;
}

bool operator==(const TriangleSketch& a, const TriangleSketch& b) {
  return a.triangles == b.triangles && a.shape == b.shape && a.colors == b.colors && a.lower == b.lower &&
         a.upper == b.upper && a.buckets == b.buckets && a.thinning == b.thinning && a.sample == b.sample &&
         has_same_normals(a, b);
}

TriangleDifference difference_of(const TriangleSketch& before, const TriangleSketch& after) {
  TriangleDifference difference;
  if (before.triangles == after.triangles && before.shape == after.shape) return difference;
  const double more = double(after.triangles) - double(before.triangles);
  const int thinning = std::max(before.thinning, after.thinning);
  double changes = 0;  // gone and come
  const bool by_buckets =
      before.buckets.size() == TriangleSketch::kBuckets && after.buckets.size() == before.buckets.size();
  std::size_t changed = 0;
  for (std::size_t i = 0; by_buckets && i < before.buckets.size(); ++i)
    changed += before.buckets[i] != after.buckets[i];
  if (by_buckets && changed < TriangleSketch::kBuckets * 3 / 4) {
    // So many balls in so many urns leave that many empty.
    changes =
        -double(TriangleSketch::kBuckets) * std::log1p(-double(changed) / double(TriangleSketch::kBuckets));
    if (changed <= 2) changes = double(changed);
    difference.is_counted = changed <= 2;
  } else {
    const std::vector<std::uint32_t> old = thinned(before.sample, thinning),
                                     now = thinned(after.sample, thinning);
    const Unshared unshared = unshared_of(old, now);
    const auto scaled = [](std::size_t count, std::size_t sample, std::size_t all) {
      return sample == 0 ? 0 : double(all) * double(count) / double(sample);
    };
    changes = scaled(unshared.gone, old.size(), before.triangles) +
              scaled(unshared.come, now.size(), after.triangles);
    difference.is_counted = thinning == 0;
  }
  changes = std::max({changes, std::abs(more), 1.0});
  difference.gone = std::min((changes - more) / 2, double(before.triangles));
  difference.come = std::min((changes + more) / 2, double(after.triangles));
  const double all = double(std::max(before.triangles, after.triangles));
  difference.share = std::max(difference.gone, difference.come) / std::max(all, 1.0);
  return difference;
}

namespace {

template <class Number>
std::string hex(Number value) {
  std::string text(2 * sizeof(Number), '0');
  for (std::size_t i = text.size(); i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15];
  return text;
}

template <class Number>
Number from_hex(std::string_view text) {
  Number value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (code != std::errc() || end != text.data() + text.size())
    throw std::invalid_argument("no hexadecimal number");
  return value;
}

std::string hex_of(const std::vector<std::uint32_t>& values) {
  std::string text;
  for (const std::uint32_t value : values) text += hex(value);
  return text;
}

std::vector<std::uint32_t> values_of(const std::string& text) {
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < text.size(); i += 8)
    values.push_back(from_hex<std::uint32_t>(std::string_view(text).substr(i, 8)));
  return values;
}

}  // namespace

Json to_json(const TriangleSketch& sketch) {
  Json json{{"triangles", sketch.triangles}, {"shape", hex(sketch.shape)}, {"colors", hex(sketch.colors)},
            {"normals", sketch.normals},     {"lower", sketch.lower},      {"upper", sketch.upper}};
  if (!sketch.buckets.empty()) json["buckets"] = hex_of(sketch.buckets);
  json["thinning"] = sketch.thinning;
  json["sample"] = hex_of(sketch.sample);
  return json;
}

TriangleSketch triangle_sketch_of(const Json& json) {
  TriangleSketch sketch;
  sketch.triangles = json.at("triangles").get<std::size_t>();
  if (sketch.triangles > kMostTriangles) throw std::invalid_argument("no number of triangles");
  sketch.shape = from_hex<std::uint64_t>(json.at("shape").get<std::string>());
  sketch.colors = from_hex<std::uint64_t>(json.at("colors").get<std::string>());
  sketch.normals = json.at("normals").get<std::array<double, 4>>();
  sketch.lower = json.at("lower").get<std::array<float, 3>>();
  sketch.upper = json.at("upper").get<std::array<float, 3>>();
  if (json.contains("buckets")) sketch.buckets = values_of(json.at("buckets").get<std::string>());
  sketch.thinning = json.at("thinning").get<int>();
  if (sketch.thinning < 0 || sketch.thinning > 32) throw std::invalid_argument("no sample of triangles");
  sketch.sample = values_of(json.at("sample").get<std::string>());
  return sketch;
}

}  // namespace chainreel
