#include "render/changes.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace chainreel {
namespace {

// Where in a list of pieces each look is: a table at most half full, in which the looks, evenly spread numbers, are their own
// hashes. Made when it is first asked, as most pieces follow one another as they did.
class Places {
 public:
  explicit Places(const std::vector<Piece>& pieces) : pieces_(pieces) {}

  // The first from there on, or -1.
  int of(std::uint64_t look, int from) {
    if (slots_.empty()) fill();
    int place = slots_[slot_of(look)];
    while (place >= 0 && place < from) place = next_[std::size_t(place)];
    return place;
  }

 private:
  void fill() {
    slots_.assign(std::bit_ceil(2 * pieces_.size() + 1), -1);
    next_.assign(pieces_.size(), -1);
    for (int i = int(pieces_.size()); i-- > 0;) {  // each is put before those behind it that look like it
      int& first = slots_[slot_of(pieces_[std::size_t(i)].look)];
      next_[std::size_t(i)] = first;
      first = i;
    }
  }
  // Of that look, or the free one where it would be.
  std::size_t slot_of(std::uint64_t look) const {
    std::size_t slot = look & (slots_.size() - 1);
    while (slots_[slot] >= 0 && pieces_[std::size_t(slots_[slot])].look != look) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  const std::vector<Piece>& pieces_;
  std::vector<int> slots_, next_;
};

// Calls visit(column, row, whether all of it is inside of the shape) for the tiles that a shape may colour.
template <class Visit>
void for_each_tile(const Piece& piece, const float* numbers, const TileMask& page, const Visit& visit) {
  constexpr int kTile = TileMask::kSide;
  const PixelBox& box = piece.outline.box;
  for (int row = box.y / kTile; row * kTile < box.bottom(); ++row) {
    const int top = std::max(box.y, row * kTile), bottom = std::min(box.bottom(), (row + 1) * kTile);
    const Spans spans = piece.outline.spans(top, bottom, numbers);
    if (spans.empty()) continue;
    for (int column = spans.left / kTile; column * kTile < spans.right && column < page.columns(); ++column)
      visit(column, row,
            bottom - top == kTile && spans.inner_left <= column * kTile && spans.inner_right >= (column + 1) * kTile);
  }
}

const Piece& at(const Batch& batch, int i) {
  return batch.pieces()[std::size_t(i)];
}

class Difference {
 public:
  Difference(const Batch& before, const Batch& now, const MarkSolids& mark_solids, TileMask& changed)
      : before_(before), now_(now), mark_solids_(mark_solids), changed_(changed) {}

  // Equal pieces are paired in order; what lies between two pairs differs.
  void mark() {
    const std::vector<Piece>&a = before_.pieces(), &b = now_.pieces();
    Places places(a);
    int next_a = 0, next_b = 0;
    for (int i = 0; i < int(b.size()); ++i) {
      const std::uint64_t look = b[std::size_t(i)].look;
      const bool is_next = next_a < int(a.size()) && a[std::size_t(next_a)].look == look;
      const int same = is_next ? next_a : places.of(look, next_a);
      if (same < 0) continue;
      mark_between(next_a, same, next_b, i);
      next_a = same + 1;
      next_b = i + 1;
    }
    mark_between(next_a, int(a.size()), next_b, int(b.size()));
  }

 private:
  void mark_between(int a, int end_a, int b, int end_b) {
    if (end_a - a == end_b - b) {
      for (; a < end_a; ++a, ++b) mark_pair(at(before_, a), at(now_, b));
      return;
    }
    for (; a < end_a; ++a) mark_piece(before_, at(before_, a));
    for (; b < end_b; ++b) mark_piece(now_, at(now_, b));
  }

  // A shape that moves changes nothing where it was and still is of one colour.
  void mark_pair(const Piece& a, const Piece& b) {
    // Of bodies that are put down alike only those that have moved.
    if (a.primitive == Primitive::solids && b.primitive == Primitive::solids && a.outline.box == b.outline.box)
      return mark_solids_(&a, &b, changed_);
    if (a.primitive != b.primitive || !has_same_fill(a, b)) {
      mark_piece(before_, a);
      mark_piece(now_, b);
      return;
    }
    inside_.clear();
    const bool fades_alike = fades_as(a, b);
    const auto is_even = [&](const Piece& piece, int column, int row) {
      const PixelBox tile = TileMask::pixels_of(column, row);
      return fades_alike || common_part(tile, piece.unfaded) == tile;
    };
    for_each_tile(a, before_.numbers(a), changed_, [&](int column, int row, bool is_inside) {
      is_inside && is_even(a, column, row) ? inside_.mark(column, row) : changed_.mark(column, row);
    });
    // What is left inside is of `a` alone, and differs, too.
    for_each_tile(b, now_.numbers(b), changed_, [&](int column, int row, bool is_inside) {
      if (!is_inside || !is_even(b, column, row) || !inside_.at(column, row)) changed_.mark(column, row);
      inside_.unmark(column, row);
    });
    changed_.add(inside_);
  }

  // Of shapes with the same fill.
  bool fades_as(const Piece& a, const Piece& b) const {
    const int place = place_of_fill(a.primitive) + 4;
    const float *in_a = before_.numbers(a) + place, *in_b = now_.numbers(b) + place;
    return std::equal(in_a, in_a + 8, in_b);
  }

  // Of shapes that fill evenly, the clips of which are the same where it matters: by their boxes.
  bool has_same_fill(const Piece& a, const Piece& b) const {
    const int place = place_of_fill(a.primitive);
    if (place == 0) return false;
    const float *in_a = before_.numbers(a) + place, *in_b = now_.numbers(b) + place;
    return std::equal(in_a, in_a + 4, in_b);
  }

  void mark_piece(const Batch& batch, const Piece& piece) {
    if (piece.primitive == Primitive::solids)
      return &batch == &before_ ? mark_solids_(&piece, nullptr, changed_) : mark_solids_(nullptr, &piece, changed_);
    if (piece.primitive == Primitive::layer) return;  // where it differs the pieces of its path do
    const bool is_ring = piece.primitive == Primitive::arc;  // nothing is inside
    for_each_tile(piece, batch.numbers(piece), changed_, [&](int column, int row, bool is_inside) {
      if (!is_inside || !is_ring) changed_.mark(column, row);
    });
  }

  const Batch &before_, &now_;
  const MarkSolids& mark_solids_;
  TileMask& changed_;
  TileMask inside_ = changed_;  // of the piece that is looked at
};

}  // namespace

void mark_changes(const Batch& before, const Batch& now, const MarkSolids& mark_solids, TileMask& changed) {
  Difference(before, now, mark_solids, changed).mark();
}

}  // namespace chainreel
