#include "render/placed_solids.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "render/lanes.hpp"

namespace chainreel {
namespace {

constexpr int kFinePage = 540;            // px of height: smaller pages take more samples a pixel, since they cost less
constexpr float kNearestToEye = 0.02F;    // of the eye's distance: what comes nearer is cut off
constexpr double kFringe = 1;             // px around bodies and their line that may be touched
constexpr std::int32_t kOut = std::numeric_limits<std::int32_t>::min();  // in a vertex's place that it has none

// One key light from the upper left in front, one weak fill from the right. Surfaces that turn away from the
// viewer darken, so that a white body has an edge on a white page. `open`: to how much of the sky, of which comes what is no
// key light; that is dimmed half as much, since openings are seen from where it comes.
Float4 light(Float4 x, Float4 y, Float4 z, Float4 open) {
  const Float4 none = all4(0.0F);
  const Float4 key = most(-0.485F * x + 0.647F * y + 0.588F * z, none);
  const Float4 fill = most(0.700F * x - 0.140F * y + 0.700F * z, none);
  const Float4 facing = 0.62F + 0.38F * most(z, none);
  const Float4 lamps = 0.5F + 0.5F * open;
  return least(all4(1.0F), (0.43F * open + (0.52F * key + 0.18F * fill) * lamps) * facing + 0.08F * open);
}

// Of four vertices, 0 to 1.
Float4 openness_at(const Solid& solid, std::size_t first) {
  if (!solid.openness) return all4(1.0F);
  const std::vector<std::uint8_t>& all = *solid.openness;
  std::array<std::uint8_t, 4> own{};
  std::copy_n(&all[first], std::min<std::size_t>(4, all.size() - first), own.begin());
  return unpacked(load4<std::uint32_t>(own.data())) / 255.0F;
}

// To the nearest whole number; of less than 2^22.
Int4 rounded(Float4 x) {
  constexpr float kMagic = 12582912.0F;  // 1.5 * 2^23: numbers about it are one apart
  const Float4 sum = x + kMagic;
  return load4<Int4>(&sum) - load4<Int4>(std::array{kMagic, kMagic, kMagic, kMagic}.data());
}

// To the nearest place midway between samples: what is smaller than they are apart loses most of its triangles.
Int4 on_lattice(Int4 place) {
  constexpr int kApart = kCellUnits / 2;
  return (place + kApart / 2) & -kApart;
}

std::uint32_t bytes_of(const Color& color) {
  const auto level = [&color](int c) { return std::uint32_t(std::lround(color.a * c)); };
  return level(color.b) | level(color.g) << 8 | level(color.r) << 16 | std::uint32_t(std::lround(255 * color.a)) << 24;
}

bool is_same(const Solid& a, const Solid& b) {
  return a.mesh == b.mesh && a.to_view == b.to_view && a.color == b.color && a.openness == b.openness;
}

// But for their parts.
bool are_seen_alike(const SolidTraces& a, const SolidTraces& b) {
  const Solids &one = a.solids, &other = b.solids;
  return a.rim == b.rim && one.parts.size() == other.parts.size() && one.origin.x == other.origin.x && one.origin.y == other.origin.y &&
         one.scale == other.scale && one.nearing == other.nearing && one.opacity == other.opacity &&
         one.outline == other.outline && one.outline_width == other.outline_width && one.is_shadow == other.is_shadow && one.fade == other.fade;
}

}  // namespace

SampleGrid::SampleGrid(int page_width, int page_height)
    : width(page_width),
      height(page_height),
      cells(page_height <= kFinePage && 2 * std::max(page_width, page_height) <= kLongestPage ? 2 : 1) {}

SampleGrid SampleGrid::coarser(int pixels_a_cell) const {
  SampleGrid grid = *this;
  if (pixels_a_cell == 1) return grid;
  grid.cells = 1;
  grid.pixels = pixels_a_cell;
  return grid;
}

void mark_difference(const SolidTraces* before, const SolidTraces* now, TileMask& changed) {
  const bool in_parts = before != nullptr && now != nullptr && are_seen_alike(*before, *now);
  for (const SolidTraces* side : {before, now}) {
    if (side == nullptr) continue;
    for (std::size_t i = 0; i < side->tiles.size(); ++i)
      if (!in_parts || !is_same(before->solids.parts[i], now->solids.parts[i])) changed.add(side->tiles[i]);
  }
}

// A part with what it needs on its way to the page.
struct PlacedSolids::Part {
  const Solid& solid;
  const SolidMesh& mesh;
  std::optional<Color> color;  // of all its triangles
  std::uint32_t first = 0;     // of its vertices
  TileMask& touched;
  double middle = 0;  // of the mesh's box, towards the viewer, m

  bool is_translucent() const { return color && color->a < 1; }
};

void PlacedSolids::set(const Solids& solids, double rim, const SampleGrid& grid, const MeshOf& mesh_of) {
  traces_.solids = solids;
  traces_.rim = rim;
  rim_ = int(std::ceil(grid.units(rim + kFringe)));
  touched_side_ = int(grid.units(TileMask::kSide));
  touched_shift_ = std::countr_zero(unsigned(touched_side_));
  traces_.tiles.clear();
  traces_.tiles.resize(solids.parts.size(), TileMask(grid.width, grid.height));
  grid_ = grid;
  columns_ = grid.columns();
  rows_ = grid.rows();
  vertices_.clear();
  triangles_.clear();
  are_translucent_ = false;
  for (auto& bins : bins_) {
    bins.resize(std::size_t(columns_) * std::size_t(rows_));
    for (std::vector<std::uint32_t>& bin : bins) bin.clear();
  }

  std::vector<Part> parts;
  for (std::size_t i = 0; i < solids.parts.size(); ++i) {
    const Solid& solid = solids.parts[i];
    const SolidMesh& mesh = mesh_of(solid.mesh);
    std::optional<Color> color = solid.color;
    if (solids.is_shadow) color = Color{solids.outline.r, solids.outline.g, solids.outline.b, 1};
    double middle = solid.to_view[11];
    for (std::size_t k = 0; k < 3; ++k) middle += solid.to_view[8 + k] * (mesh.bounds.lower[k] + mesh.bounds.upper[k]) / 2;
    parts.push_back({solid, mesh, color, std::uint32_t(vertices_.size()), traces_.tiles[i], middle});
    place_vertices(parts.back());
  }
  // The inside of a closed part is never seen. A colour of its own holds for all triangles.
  for (const Part& part : parts) {
    const SortedTriangles& sorted = part.mesh.triangles;
    touched_last_ = {};
    if (part.is_translucent()) continue;
    add_triangles(part, 0, sorted.closed, true);
    add_triangles(part, sorted.closed, part.color ? sorted.indices.size() / 3 : sorted.opaque, false);
    if (!solids.is_shadow) add_creases(part);
  }
  // What shines through comes last, farthest first, and hides nothing.
  are_translucent_ = true;
  std::vector<const Part*> from_far;
  for (const Part& part : parts) from_far.push_back(&part);
  std::stable_sort(from_far.begin(), from_far.end(), [](const Part* a, const Part* b) { return a->middle < b->middle; });
  for (const Part* part : from_far) {
    const SortedTriangles& sorted = part->mesh.triangles;
    touched_last_ = {};
    if (!part->color) add_triangles(*part, sorted.opaque, sorted.indices.size() / 3, false);
    if (part->is_translucent()) add_triangles(*part, 0, sorted.indices.size() / 3, false);
  }
}

void PlacedSolids::place_vertices(const Part& part) {
  const Solids& solids = traces_.solids;
  const SolidMesh& mesh = part.mesh;
  std::array<float, 12> m;
  for (std::size_t i = 0; i < 12; ++i) m[i] = float(part.solid.to_view[i]);
  const double unit = grid_.units(grid_.height);  // a page height's
  const float left = float(unit * solids.origin.x), top = float(unit * (1 - solids.origin.y));
  const float scale = float(unit * solids.scale);
  std::array<float, 3> nearing;
  for (std::size_t i = 0; i < 3; ++i) nearing[i] = float(solids.nearing[i]);
  const float least_place = -kGuardCells * kCellUnits, largest_place = (kLongestPage + kGuardCells) * kCellUnits;
  const Color own = part.color.value_or(Color{});
  const std::uint32_t own_color = bytes_of(own);
  const Float4 own_levels = unpacked(own_color);
  vertices_.resize(part.first + mesh.color.size());
  for (std::size_t i = 0; i < mesh.color.size(); i += 4) {
    const auto at = [i](const std::vector<float>& numbers) { return load4<Float4>(&numbers[i]); };
    const Float4 px = at(mesh.position[0]), py = at(mesh.position[1]), pz = at(mesh.position[2]);
    const auto row = [&](std::size_t r) { return m[r] * px + m[r + 1] * py + m[r + 2] * pz + m[r + 3]; };
    const Float4 right = row(0), up = row(4), toward = row(8);
    const Float4 w = 1.0F - (right * nearing[0] + up * nearing[1] + toward * nearing[2]), inverse = 1.0F / w;
    const Float4 x = left + scale * right * inverse, y = top - scale * up * inverse, depth = toward * inverse;
    const Int4 is_in = (w > kNearestToEye) & (x > least_place) & (x < largest_place) & (y > least_place) & (y < largest_place);
    Int4 to_x = rounded(x), to_y = rounded(y);
    if (grid_.pixels > 1) to_x = on_lattice(to_x), to_y = on_lattice(to_y);
    to_x = is_in ? to_x : all4(kOut);
    Int4 color = all4(std::int32_t(own_color));
    if (!solids.is_shadow) {
      const Float4 nx = at(mesh.normal[0]), ny = at(mesh.normal[1]), nz = at(mesh.normal[2]);
      const auto turned = [&](std::size_t r) { return m[r] * nx + m[r + 1] * ny + m[r + 2] * nz; };
      const Float4 level = light(turned(0), turned(4), turned(8), openness_at(part.solid, i));
      const Int4 bytes = part.color ? color : load4<Int4>(&mesh.color[i]);
      color = bytes & std::int32_t(0xff000000U);
      for (int c = 0; c < 3; ++c) {
        const Float4 base = part.color ? all4(own_levels[c]) : __builtin_convertvector((bytes >> (8 * c)) & 255, Float4);
        color |= __builtin_convertvector(base * level + 0.5F, Int4) << (8 * c);
      }
    }
    for (std::size_t k = 0; k < 4; ++k)
      vertices_[part.first + i + k] = {to_x[k], to_y[k], depth[k], std::uint32_t(color[k])};
  }
}

void PlacedSolids::add_triangles(const Part& part, std::size_t first, std::size_t end, bool is_culled) {
  for (std::size_t t = first; t < end; ++t) {
    const std::uint32_t* const index = &part.mesh.triangles.indices[3 * t];
    const Triangle corners = {part.first + index[0], part.first + index[1], part.first + index[2]};
    if (vertices_[corners[0]].x == kOut || vertices_[corners[1]].x == kOut || vertices_[corners[2]].x == kOut)
      add_clipped(part, corners, is_culled);
    else
      add(corners, is_culled, part.touched);
  }
}

namespace {

constexpr double kCreaseLine = 0.0010, kThinnestCrease = 0.7;  // units of H, and px
constexpr std::uint32_t kCreaseLevel = 5;  // eighths of what the body's colour is beside it

std::uint32_t darkened(std::uint32_t color) {
  std::uint32_t result = color & 0xff000000U;
  for (int shift = 0; shift < 24; shift += 8) result |= ((color >> shift & 255) * kCreaseLevel / 8) << shift;
  return result;
}

// Twice a triangle's area; negative where one sees its outside.
std::int64_t turn(const PageVertex& a, const PageVertex& b, const PageVertex& c) {
  return std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(c.x - a.x) * (b.y - a.y);
}

}  // namespace

// Thin lines where a surface bends sharply, as far before it as they are wide.
void PlacedSolids::add_creases(const Part& part) {
  const double unit = grid_.units(grid_.height);
  const double half = grid_.units(std::max(kCreaseLine * grid_.height, kThinnestCrease) / 2);
  const float before = float(2 * half / (unit * traces_.solids.scale));
  for (const Crease& crease : part.mesh.creases) {
    const auto at = [&](std::uint32_t index) { return vertices_[part.first + index]; };
    const std::array<PageVertex, 4> corners = {at(crease.a), at(crease.b), at(crease.left), at(crease.right)};
    const auto &[a, b, left, right] = corners;
    const bool is_cut = std::any_of(corners.begin(), corners.end(), [](const PageVertex& corner) { return corner.x == kOut; });
    if (is_cut || (turn(a, b, left) >= 0 && turn(b, a, right) >= 0) || a.color >> 24 != 255) continue;
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
    if (length < 1) continue;
    const auto aside_x = std::int32_t(std::lround(-dy / length * half)), aside_y = std::int32_t(std::lround(dx / length * half));
    const auto first = std::uint32_t(vertices_.size());
    for (const PageVertex& end : {a, b})
      for (const int side : {-1, 1})
        vertices_.push_back({end.x + side * aside_x, end.y + side * aside_y, end.depth + before, darkened(end.color)});
    add({first, first + 1, first + 3}, false, part.touched);
    add({first, first + 3, first + 2}, false, part.touched);
  }
}

namespace {

// A corner of a triangle before the division by w.
struct ViewCorner {
  double x = 0, y = 0, w = 1;  // place times w
  double z = 0;
  std::array<double, 4> color{};
};

ViewCorner between(const ViewCorner& a, const ViewCorner& b, double t) {
  const auto mix = [t](double from, double to) { return from + t * (to - from); };
  ViewCorner c{mix(a.x, b.x), mix(a.y, b.y), mix(a.w, b.w), mix(a.z, b.z), {}};
  for (std::size_t i = 0; i < 4; ++i) c.color[i] = mix(a.color[i], b.color[i]);
  return c;
}

// The part of a convex outline where value(corner) is not negative.
template <class Value>
std::vector<ViewCorner> cut(const std::vector<ViewCorner>& outline, const Value& value) {
  std::vector<ViewCorner> result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const ViewCorner &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0) result.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) result.push_back(between(a, b, at_a / (at_a - at_b)));
  }
  return result;
}

}  // namespace

// Triangles that reach behind the eye, or so far out that their places are no more told exactly.
void PlacedSolids::add_clipped(const Part& part, const Triangle& corners, bool is_culled) {
  const Solids& solids = traces_.solids;
  const double unit = grid_.units(grid_.height);
  std::vector<ViewCorner> outline;
  for (const std::uint32_t corner : corners) {
    const std::array<float, 3>& p = part.mesh.mesh->vertices[corner - part.first].position;
    const auto row = [&](std::size_t r) {
      const double* const m = &part.solid.to_view[r];
      return m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
    };
    const std::array<double, 3>& n = solids.nearing;
    ViewCorner view{0, 0, 1 - (row(0) * n[0] + row(4) * n[1] + row(8) * n[2]), row(8), {}};
    view.x = unit * (solids.origin.x * view.w + solids.scale * row(0));
    view.y = unit * ((1 - solids.origin.y) * view.w - solids.scale * row(4));
    for (std::size_t c = 0; c < 4; ++c) view.color[c] = double(vertices_[corner].color >> (8 * c) & 255);
    outline.push_back(view);
  }
  constexpr double kLeast = (1.0 - kGuardCells) * kCellUnits, kLargest = (kLongestPage + kGuardCells - 1.0) * kCellUnits;
  outline = cut(outline, [](const ViewCorner& c) { return c.w - kNearestToEye; });
  outline = cut(outline, [](const ViewCorner& c) { return c.x - kLeast * c.w; });
  outline = cut(outline, [](const ViewCorner& c) { return kLargest * c.w - c.x; });
  outline = cut(outline, [](const ViewCorner& c) { return c.y - kLeast * c.w; });
  outline = cut(outline, [](const ViewCorner& c) { return kLargest * c.w - c.y; });
  const auto first = std::uint32_t(vertices_.size());
  for (const ViewCorner& c : outline) {
    PageVertex vertex{std::int32_t(std::lround(c.x / c.w)), std::int32_t(std::lround(c.y / c.w)), float(c.z / c.w), 0};
    for (std::size_t i = 0; i < 4; ++i) vertex.color |= std::uint32_t(std::lround(c.color[i])) << (8 * i);
    vertices_.push_back(vertex);
  }
  for (std::uint32_t i = 2; i < outline.size(); ++i) add({first, first + i - 1, first + i}, is_culled, part.touched);
}

void PlacedSolids::add(Triangle corners, bool is_culled, TileMask& touched) {
  const PageVertex &a = vertices_[corners[0]], &b = vertices_[corners[1]], &c = vertices_[corners[2]];
  const std::int64_t area = turn(a, b, c);
  // Counter-clockwise triangles, in pictures whose y points down.
  if (area == 0 || (area > 0 && is_culled)) return;
  if (area < 0) std::swap(corners[1], corners[2]);
  // What one sees from inside is mostly hidden, which is found out soonest when it comes last.
  add_to_tiles(corners, are_translucent_ ? translucent : area < 0 ? facing : averted, touched);
}

namespace {

// Whether a box meets a triangle, or would but for a corner of it.
bool meets(const std::array<const PageVertex*, 3>& corners, int left, int top, int right, int bottom) {
  for (std::size_t i = 0; i < 3; ++i) {
    const PageVertex &a = *corners[i], &b = *corners[(i + 1) % 3];
    const std::int64_t dx = a.y - b.y, dy = b.x - a.x;
    if (dx * ((dx < 0 ? left : right) - a.x) + dy * ((dy < 0 ? top : bottom) - a.y) < 0) return false;
  }
  return true;
}

}  // namespace

void PlacedSolids::add_to_tiles(const Triangle& corners, Group group, TileMask& touched) {
  const std::array<const PageVertex*, 3> at = {&vertices_[corners[0]], &vertices_[corners[1]], &vertices_[corners[2]]};
  const PlaceRange range(*at[0], *at[1], *at[2]);
  if (!range.has_samples()) return;
  mark_touched(corners, range, touched);
  static_assert(kTileUnits == 1 << 10);
  const int first_column = std::max(0, range.left >> 10), last_column = std::min(columns_ - 1, range.right >> 10);
  const int first_row = std::max(0, range.top >> 10), last_row = std::min(rows_ - 1, range.bottom >> 10);
  if (first_column > last_column || first_row > last_row) return;
  const auto triangle = std::uint32_t(triangles_.size());
  const bool is_large = range.longest() > kTileUnits / 2;  // it may leave out tiles that its range meets
  bool is_seen = false;
  for (int row = first_row; row <= last_row; ++row)
    for (int column = first_column; column <= last_column; ++column) {
      const int x = column * kTileUnits, y = row * kTileUnits;
      if (is_large && !meets(at, x, y, x + kTileUnits, y + kTileUnits)) continue;
      bins_[group][place(column, row)].push_back(triangle);
      is_seen = true;
    }
  if (is_seen) triangles_.push_back(corners);
}

// The page's tiles that a triangle or its rim may colour.
void PlacedSolids::mark_touched(const Triangle& corners, const PlaceRange& range, TileMask& touched) {
  const TileRange tiles{std::max(0, (range.left - rim_) >> touched_shift_), std::max(0, (range.top - rim_) >> touched_shift_),
                        std::min(touched.columns(), ((range.right + rim_) >> touched_shift_) + 1),
                        std::min(touched.rows(), ((range.bottom + rim_) >> touched_shift_) + 1)};
  const bool is_large = range.longest() > touched_side_ / 2;  // it may leave out tiles that its range meets
  if (!is_large && tiles == touched_last_) return;
  touched_last_ = is_large ? TileRange{} : tiles;
  const std::array<const PageVertex*, 3> at = {&vertices_[corners[0]], &vertices_[corners[1]], &vertices_[corners[2]]};
  for (int row = tiles.top; row < tiles.bottom; ++row)
    for (int column = tiles.left; column < tiles.right; ++column) {
      const int x = column * touched_side_, y = row * touched_side_;
      if (!is_large || meets(at, x - rim_, y - rim_, x + touched_side_ + rim_, y + touched_side_ + rim_)) touched.mark(column, row);
    }
}

bool PlacedSolids::is_empty(int column, int row) const {
  return std::all_of(bins_.begin(), bins_.end(), [at = place(column, row)](const auto& bins) { return bins[at].empty(); });
}

void PlacedSolids::draw(int column, int row, TileSamples& samples) const {
  for (const Group group : {facing, averted, translucent}) {
    const Fill fill = group == translucent ? Fill::translucent : traces_.solids.is_shadow ? Fill::flat : Fill::nearest;
    for (const std::uint32_t index : bins_[group][place(column, row)]) {
      const Triangle& t = triangles_[index];
      samples.draw(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]], column * kTileUnits, row * kTileUnits, fill);
    }
  }
}

}  // namespace chainreel
