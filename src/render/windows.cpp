#include "render/windows.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace chainreel {
namespace {

void append_window(const PixelBox& box, const float* numbers, int count, std::vector<float>& instances) {
  instances.insert(instances.end(), {float(box.x), float(box.y), float(box.right()), float(box.bottom())});
  instances.insert(instances.end(), numbers, numbers + count);
}

// Rows that are looked at together: the fewer, the less is drawn beside thin shapes, and the more windows there are.
constexpr int kStrip = 16;
static_assert(TileMask::kSide % kStrip == 0);

constexpr int kSmall = 40 * 40;  // px: what a window more costs

// A shape's parts within the marked tiles, as boxes that do not overlap.
class WindowParts {
 public:
  WindowParts(const Piece& piece, const float* numbers, const TileMask& tiles, std::vector<PixelBox>& some,
        std::vector<PixelBox>& inner)
      : outline_(piece.outline), numbers_(numbers), tiles_(tiles), some_(some), inner_(inner) {}

  void find() {
    const PixelBox& box = outline_.box;
    const Marked marked = how_many();
    if (marked == Marked::none) return;
    if ((outline_.kind == Outline::Kind::box || box.width * box.height < kSmall) && marked == Marked::all) return some_.add(box);
    const int height = outline_.kind == Outline::Kind::box ? TileMask::kSide : kStrip;
    for (int top = box.y; top < box.bottom();) {
      const int bottom = std::min(box.bottom(), (top / height + 1) * height);
      add_strip(top, bottom);
      top = bottom;
    }
  }

 private:
  enum class Marked { none, some, all };

  // Of the tiles that its box meets.
  Marked how_many() const {
    const TileRange range = tiles_.tiles_of(outline_.box);
    bool any = false, all = true;
    for (int row = range.top; row < range.bottom; ++row)
      for (int column = range.left; column < range.right; ++column) (tiles_.at(column, row) ? any : all) = tiles_.at(column, row);
    return all ? Marked::all : any ? Marked::some : Marked::none;
  }

  void add_strip(int top, int bottom) {
    const Spans spans = outline_.spans(top, bottom, numbers_);
    if (spans.empty()) return;
    constexpr int kSide = TileMask::kSide;
    const int row = top / kSide, end = (spans.right - 1) / kSide + 1;
    for (int column = spans.left / kSide; column < end; ++column) {
      if (!tiles_.at(column, row)) continue;
      int last = column + 1;
      while (last < end && tiles_.at(last, row)) ++last;
      const auto part = [&](int left, int right) {
        return box_between(std::max(left, column * kSide), top, std::min(right, last * kSide), bottom);
      };
      some_.add(part(spans.left, spans.inner_left));
      some_.add(part(spans.inner_right, spans.right));
      inner_.add(part(spans.inner_left, spans.inner_right));
      column = last;
    }
  }

  const Outline& outline_;
  const float* numbers_;
  const TileMask& tiles_;
  BoxJoiner some_, inner_;
};

}  // namespace

void Windows::add(int index, Primitive primitive, const float* numbers, const std::vector<PixelBox>& boxes) {
  if (boxes.empty()) return;
  const int floats = floats_of(primitive);
  std::vector<float>& stream = streams_[std::size_t(primitive)];
  if (runs_.empty() || runs_.back().primitive != primitive || primitive == Primitive::cells)
    runs_.push_back({.primitive = primitive, .first = int(stream.size()) / floats, .piece = index});
  for (const PixelBox& box : boxes) append_window(box, numbers, floats - 4, stream);
  runs_.back().count += int(boxes.size());
}

void Windows::add_shape(const Batch& batch, int index, const TileMask& tiles) {
  const Piece& piece = batch.pieces()[std::size_t(index)];
  const float* numbers = batch.numbers(piece);
  some_.clear();
  inner_.clear();
  WindowParts(piece, numbers, tiles, some_, inner_).find();
  const float* fill = numbers + place_of_fill(piece.primitive);
  const bool has_inside = place_of_fill(piece.primitive) > 0 && fill[3] > 0;
  // Nothing of the shape overlaps: what continues a run comes first.
  const bool continues = !runs_.empty() && runs_.back().primitive == piece.primitive;
  if (continues) add(index, piece.primitive, numbers, some_);
  if (has_inside) add_inside(index, piece, fill);
  if (!continues) add(index, piece.primitive, numbers, some_);
}

// What is inside of the shape, and there evenly filled or faded.
void Windows::add_inside(int index, const Piece& piece, const float* fill) {
  even_.clear();
  faded_.clear();
  for (const PixelBox& box : inner_) {
    const PixelBox even = common_part(box, piece.unfaded);
    if (even.empty()) {
      faded_.push_back(box);
      continue;
    }
    even_.push_back(even);
    for (const PixelBox& side : {box_between(box.x, box.y, box.right(), even.y), box_between(box.x, even.y, even.x, even.bottom()),
                                 box_between(even.right(), even.y, box.right(), even.bottom()),
                                 box_between(box.x, even.bottom(), box.right(), box.bottom())})
      if (!side.empty()) faded_.push_back(side);
  }
  add(index, Primitive::faded, fill, faded_);
  add(index, Primitive::flat, fill, even_);
}

// Strip by strip, so that none overlaps another: strips lie within tiles.
void Windows::find_path_area(const PixelBox& within) {
  constexpr int kGap = 12;  // px: what a window more costs
  struct Part {
    int row, left, right;
    bool operator<(const Part& other) const { return std::pair(row, left) < std::pair(other.row, other.left); }
  };
  std::vector<Part> parts;
  for (const PixelBox& box : path_windows_)
    for (int row = box.y / kStrip; row * kStrip < box.bottom(); ++row) parts.push_back({row, box.x, box.right()});
  std::sort(parts.begin(), parts.end());
  path_.clear();
  BoxJoiner area(path_);
  for (std::size_t i = 0; i < parts.size();) {
    Part part = parts[i++];
    for (; i < parts.size() && parts[i].row == part.row && parts[i].left <= part.right + kGap; ++i)
      part.right = std::max(part.right, parts[i].right);
    area.add(common_part(within, box_between(part.left, part.row * kStrip, part.right, (part.row + 1) * kStrip)));
  }
}

// The pieces into their layer, then its colour onto the page, each pixel once.
void Windows::add_path(const Batch& batch, int layer, const TileMask& tiles) {
  const Piece& colour = batch.pieces()[std::size_t(layer)];
  path_windows_.clear();
  const std::size_t run = runs_.size();
  for (int i = colour.first_of_path; i < layer; ++i) {
    add_shape(batch, i, tiles);
    path_windows_.insert(path_windows_.end(), some_.begin(), some_.end());
  }
  if (runs_.size() == run) return;
  find_path_area(colour.outline.box);
  std::vector<float>& flat = streams_[std::size_t(Primitive::flat)];
  constexpr std::array<float, 4> kNothing = {};
  runs_[run].first_to_clear = int(flat.size()) / floats_of(Primitive::flat);
  runs_[run].count_to_clear = int(path_.size());
  for (const PixelBox& box : path_) append_window(box, kNothing.data(), int(kNothing.size()), flat);
  add(layer, Primitive::layer, batch.numbers(colour), path_);
}

void Windows::set(const Batch& batch, const TileMask& tiles) {
  runs_.clear();
  for (std::vector<float>& stream : streams_) stream.clear();
  for (int i = 0; i < int(batch.pieces().size()); ++i) {
    const Primitive primitive = batch.pieces()[std::size_t(i)].primitive;
    if (primitive == Primitive::solids)
      runs_.push_back({.primitive = primitive, .piece = i});
    else if (primitive == Primitive::layer)
      add_path(batch, i, tiles);
    else if (primitive != Primitive::trail)
      add_shape(batch, i, tiles);
  }
}

}  // namespace chainreel
