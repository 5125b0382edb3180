// Normals for triangles that bring none.
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace chainreel {

using Point3f = std::array<float, 3>;

// Unit, counter-clockwise seen from outside; zero where the triangle has no area, not finite where a
// point is not.
Eigen::Vector3d face_normal(const Point3f& a, const Point3f& b, const Point3f& c);

// Edges that are flatter than this are meant to be round.
inline constexpr double kSmoothedEdge = 35;  // degrees

// A normal for each corner of triangles: the mean of the faces that meet there and differ from the corner's
// own by less than kSmoothedEdge, each weighted by its angle at that point, so that it does not matter how a
// face was cut into triangles. `corners` has three points a triangle; points are one where they are equal to
// the last bit. Corners of triangles without area have zero.
std::vector<Eigen::Vector3f> smooth_normals(const std::vector<Point3f>& corners);

// Items that are equal to the last bit, found without a tree: an open table of indices, half empty.

// `Item` must have no gaps between its members.
template <class Item>
class EqualItems {
  static_assert(std::is_trivially_copyable_v<Item> && sizeof(Item) % sizeof(std::uint32_t) == 0);

 public:
  // Where the item is, or is from now on, in `items`.
  std::uint32_t index_of(const Item& item) {
    if (2 * items.size() >= table_.size()) grow();
    std::uint32_t& slot = slot_of(item);
    if (slot == kFree) {
      slot = std::uint32_t(items.size());
      items.push_back(item);
    }
    return slot;
  }

  std::vector<Item> items;  // each once, in the order of their coming

 private:
  static constexpr std::uint32_t kFree = ~std::uint32_t(0);

  static std::size_t hash_of(const Item& item) {
    std::array<std::uint32_t, sizeof(Item) / sizeof(std::uint32_t)> words;
    std::memcpy(words.data(), &item, sizeof(Item));
    std::uint64_t hash = 0;
    for (const std::uint32_t word : words) hash = std::rotl((hash ^ word) * 0x9E3779B97F4A7C15U, 29);
    return std::size_t(hash);
  }

  std::uint32_t& slot_of(const Item& item) {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = hash_of(item) & mask;
    while (table_[at] != kFree && std::memcmp(&items[table_[at]], &item, sizeof(Item)) != 0)
      at = (at + 1) & mask;
    return table_[at];
  }

  void grow() {
    table_.assign(2 * table_.size(), kFree);
    for (std::size_t i = 0; i < items.size(); ++i) slot_of(items[i]) = std::uint32_t(i);
  }

  std::vector<std::uint32_t> table_ = std::vector<std::uint32_t>(1024, kFree);
};

}  // namespace chainreel
