// Which of many items are equal.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace chainreel {

// Items that are equal to the last bit, found without a tree: an open table of indices, half empty.

// `Item` must have no gaps between its members.
template <class Item>
class EqualItems {
  static_assert(std::is_trivially_copyable_v<Item> && sizeof(Item) % sizeof(std::uint32_t) == 0);

 public:
  // `expected`: about how many different ones will come; more than that make it grow.
  explicit EqualItems(std::size_t expected = 0) : table_(std::bit_ceil(std::max<std::size_t>(1024, 2 * expected)), kFree) {
    items.reserve(expected);
  }

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

  std::vector<std::uint32_t> table_;
};

}  // namespace chainreel
