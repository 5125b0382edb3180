// Triangles into the samples of a tile, cells beside one another at once: the same operations in the same order, so that samples
// have the same bytes. Included for each width of the processor's vectors, within a namespace that says what Floats, Ints, kCells,
// kSampleX, kSampleY, kCellX and a few functions are; so it includes nothing and has no guard.

inline Floats all(float x) { return Floats{} + x; }
inline Ints all(std::int32_t x) { return Ints{} + x; }
inline Floats least(Floats a, Floats b) { return a < b ? a : b; }
inline Floats most(Floats a, Floats b) { return a > b ? a : b; }

template <class Lanes, class Number>
inline void load(const Number* from, Lanes& lanes) {
  std::memcpy(&lanes, from, sizeof lanes);
}
template <class Lanes, class Number>
inline void store(Number* to, const Lanes& lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}

// A triangle's colours and depths at the cells from `column` on of a row; then of those behind.
template <Fill fill, bool is_even>
class Cells {
 public:
  explicit Cells(const TileTriangle& t)
      : t_(t),
        depth_offset_(all(t.depth.dx) * __builtin_convertvector(kSampleX, Floats) + all(t.depth.dy) * __builtin_convertvector(kSampleY, Floats)),
        depth_dx_(all(t.depth.dx)),
        farthest_(all(t.farthest)),
        nearest_(all(t.nearest)) {
    if constexpr (is_even) return;
    color_dx_ = in_each_cell(t.color.dx), darkest_ = in_each_cell(t.darkest), brightest_ = in_each_cell(t.brightest);
  }

  void start(int row, int column, TileArrays& samples) {
    const std::size_t cell = std::size_t(4) * std::size_t(row * kTileCells + column);
    depth_ = &samples.depth[cell], color_ = &samples.color[cell];
    if constexpr (fill == Fill::flat) return;
    const float y = float(row * kCellUnits);
    row_depth_ = depth_offset_ + all(t_.depth.start + t_.depth.dy * y);
    if constexpr (!is_even) row_color_ = in_each_cell(t_.color.start + t_.color.dy * y);
    x_ = all(float(column * kCellUnits)) + __builtin_convertvector(kCellX, Floats);
  }
  void step() {
    depth_ += 4 * kCells, color_ += 4 * kCells;
    x_ += float(kCellUnits * kCells);
  }
  // `wins`: the samples inside of the triangle.
  void paint(Ints wins) {
    if (any_of(wins) == 0) return;
    Ints color = all(std::int32_t(t_.even));
    if constexpr (fill != Fill::flat) {
      const Floats depth = least(most(row_depth_ + depth_dx_ * x_, farthest_), nearest_);
      Floats before;
      load(depth_, before);
      wins &= depth > before;
      if (any_of(wins) == 0) return;
      if constexpr (fill == Fill::nearest) store(depth_, Floats(wins ? depth : before));
      if constexpr (!is_even) color = packed_in_each_cell(least(most(row_color_ + color_dx_ * x_, darkest_), brightest_) + 0.5F);
    }
    if constexpr (fill == Fill::translucent) {
      const unsigned bits = any_of(wins);
      for (std::size_t k = 0; k < std::size_t(4 * kCells); ++k)
        if (bits >> k & 1) color_[k] = blended(std::uint32_t(color[k]), color_[k]);
    } else {
      Ints below;
      load(color_, below);
      store(color_, Ints(wins ? color : below));
    }
  }

 private:
  const TileTriangle& t_;
  Floats depth_offset_, depth_dx_, farthest_, nearest_, color_dx_{}, darkest_{}, brightest_{};
  Floats row_depth_{}, row_color_{}, x_{};
  float* depth_ = nullptr;
  std::uint32_t* color_ = nullptr;
};

template <Fill fill, bool is_even>
void fill_cells(const TileTriangle& t, const std::array<Edge, 3>& edges, TileArrays& samples) {
  constexpr int kNarrowing = 4;  // columns: what finding out more of a row costs
  std::array<Ints, 3> offset, step;
  for (std::size_t i = 0; i < 3; ++i) {
    offset[i] = all(edges[i].dx) * (kSampleX + kCellX) + all(edges[i].dy) * kSampleY;
    step[i] = all(edges[i].dx * kCellUnits * kCells);
  }
  const bool narrows = t.last_column - t.first_column >= kNarrowing;
  std::array<Crossing, 3> crossings;
  if (narrows)
    for (std::size_t i = 0; i < 3; ++i) crossings[i] = Crossing(edges[i]);
  Cells<fill, is_even> cells(t);
  for (int row = t.first_row; row <= t.last_row; ++row) {
    int first = t.first_column, last = t.last_column;
    if (narrows) {
      for (const Crossing& crossing : crossings) crossing.narrow(row, first, last);
      if (first > last) continue;
    }
    first &= -kCells;
    std::array<Ints, 3> value;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge& edge = edges[i];
      value[i] = offset[i] + all(std::int32_t(edge.start + std::int64_t(edge.dx) * first * kCellUnits + std::int64_t(edge.dy) * row * kCellUnits));
    }
    cells.start(row, first, samples);
    for (int column = first; column <= last; column += kCells, cells.step()) {
      cells.paint((value[0] | value[1] | value[2]) >= 0);
      for (std::size_t i = 0; i < 3; ++i) value[i] += step[i];
    }
  }
}

constexpr int kFewRows = 4, kFewColumns = 4;  // of a small triangle

// The samples of small triangles, of which many have none, or none that is seen.
class FewSamples {
 public:
  FewSamples(const TileTriangle& t)
      : row_(t.first_row),
        rows_(t.last_row + 1 - t.first_row),
        steps_((t.last_column - t.first_column + kCells) / kCells),
        column_(std::min(t.first_column, kTileCells - steps_ * kCells)) {}

  void find(const PageVertex& a, const PageVertex& b, const PageVertex& c, int tile_left, int tile_top) {
    const int left = tile_left + column_ * kCellUnits, top = tile_top + row_ * kCellUnits;
    // Of the edges from a, b and c on; the fourth lane is nothing.
    const Int4 x = {a.x - left, b.x - left, c.x - left, 0}, next_x = {x[1], x[2], x[0], 0};
    const Int4 y = {a.y - top, b.y - top, c.y - top, 0}, next_y = {y[1], y[2], y[0], 0};
    const Int4 dx = y - next_y, dy = next_x - x;
    const Int4 start = ~((dx > 0) | ((dx == 0) & (dy > 0))) - dx * x - dy * y;
    std::array<Ints, 3> value, down, aside;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = int(i);
      value[i] = all(dx[k]) * (kSampleX + kCellX) + (all(dy[k]) * kSampleY + all(start[k]));
      down[i] = all(dy[k] * kCellUnits);
      aside[i] = all(dx[k] * kCellUnits * kCells);
    }
    std::size_t next = 0;
    for (int row = 0; row < rows_; ++row) {
      std::array<Ints, 3> here = value;
      for (int step = 0; step < steps_; ++step) {
        inside_[next] = (here[0] | here[1] | here[2]) >= 0;
        any_ |= any_of(inside_[next++]);
        for (std::size_t i = 0; i < 3; ++i) here[i] += aside[i];
      }
      for (std::size_t i = 0; i < 3; ++i) value[i] += down[i];
    }
  }
  // Leaves out those that a triangle which comes no nearer than this cannot win.
  void keep_nearer(float nearest, const TileArrays& samples) {
    any_ = 0;
    std::size_t next = 0;
    const float* depth = &samples.depth[std::size_t(4 * (row_ * kTileCells + column_))];
    for (int row = 0; row < rows_; ++row, depth += 4 * kTileCells)
      for (int step = 0; step < steps_; ++step) {
        Floats before;
        load(depth + 4 * kCells * step, before);
        inside_[next] &= all(nearest) > before;
        any_ |= any_of(inside_[next++]);
      }
  }
  bool any() const { return any_ != 0; }

  template <Fill fill, bool is_even>
  void paint(const TileTriangle& t, TileArrays& samples) const {
    Cells<fill, is_even> cells(t);
    std::size_t next = 0;
    for (int row = 0; row < rows_; ++row) {
      cells.start(row_ + row, column_, samples);
      for (int step = 0; step < steps_; ++step, cells.step()) cells.paint(inside_[next++]);
    }
  }

 private:
  int row_, rows_, steps_, column_;
  unsigned any_ = 0;
  std::array<Ints, kFewRows * kFewColumns / kCells> inside_;  // row by row
};

// Calls `by` with a Fill and whether all is of one colour, as constants.
template <class By>
void for_fill(Fill fill, bool is_even, const By& by) {
  if (fill == Fill::flat)
    by.template operator()<Fill::flat, true>();
  else if (fill == Fill::nearest)
    is_even ? by.template operator()<Fill::nearest, true>() : by.template operator()<Fill::nearest, false>();
  else
    is_even ? by.template operator()<Fill::translucent, true>() : by.template operator()<Fill::translucent, false>();
}

inline void draw_triangle(const PageVertex& a, const PageVertex& b, const PageVertex& c, int left, int top, Fill fill, TileArrays& samples) {
  const PlaceRange range(a, b, c);
  TileTriangle t(range, left, top);
  if (t.first_column > t.last_column || t.first_row > t.last_row) return;
  if (t.last_column - t.first_column < kFewColumns && t.last_row - t.first_row < kFewRows && range.longest() < kTileUnits) {
    FewSamples few(t);
    few.find(a, b, c, left, top);
    if (few.any() && fill != Fill::flat) few.keep_nearer(std::max({a.depth, b.depth, c.depth}), samples);
    if (!few.any()) return;
    const bool is_even = t.shade(a, b, c, left, top, fill, range.longest());
    for_fill(fill, is_even, [&]<Fill how, bool even>() { few.paint<how, even>(t, samples); });
    return;
  }
  std::array<Edge, 3> edges = {Edge(a, b, left, top), Edge(b, c, left, top), Edge(c, a, left, top)};
  if (range.longest() > kTileUnits)
    for (Edge& edge : edges)
      if (edge.leaves_tile_out()) return;
  const bool is_even = t.shade(a, b, c, left, top, fill, range.longest());
  for_fill(fill, is_even, [&]<Fill how, bool even>() { fill_cells<how, even>(t, edges, samples); });
}
