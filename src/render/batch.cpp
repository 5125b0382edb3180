#include "render/batch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "core/error.hpp"
#include "core/scalar.hpp"
#include "render/solid_bounds.hpp"

namespace chainreel {
namespace {

constexpr double kFringe = 1;             // px around an edge that may be touched
constexpr double kThinnest = 0.5;         // px: no line is thinner than twice this
constexpr double kSmallestAxis = 0.01;    // px: a flatter ellipse is a line
constexpr double kFarthest = 1 << 14;     // px: single precision still resolves 1/1000 px here
constexpr double kLargestAxis = 1e6;      // px: and 1/16 px here
constexpr double kLargestText = 1 << 13;  // px per em
constexpr int kMostCells = 4096;           // along a side: Mesa takes textures of 8192 and more
constexpr int kCorners = 8;

// 64 bits of what has been added: different for what differs, but by a chance of about 2^-64. Words go in by pairs, as the
// halves of a product of 128 bits that are laid on one another (folded multiplication, as wyhash has it).
class Look {
 public:
  void add(std::uint64_t word, std::uint64_t other = 0) {
    __extension__ using Product = unsigned __int128;
    const Product product = Product(word ^ 0x9E3779B97F4A7C15u) * (other ^ state_);
    state_ = std::uint64_t(product) ^ std::uint64_t(product >> 64) ^ 0xD6E8FEB86659FD93u;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const PixelBox& box) {
    add(pair(std::uint32_t(box.x), std::uint32_t(box.y)), pair(std::uint32_t(box.width), std::uint32_t(box.height)));
  }
  void add(std::span<const float> numbers) {  // a multiple of four
    const auto bits = [&](std::size_t i) { return std::bit_cast<std::uint32_t>(numbers[i]); };
    for (std::size_t i = 0; i + 3 < numbers.size(); i += 4) add(pair(bits(i), bits(i + 1)), pair(bits(i + 2), bits(i + 3)));
  }
  void add(std::span<const std::uint8_t> bytes) {
    for (std::size_t i = 0; i + 3 < bytes.size(); i += 4)
      add(std::uint64_t(bytes[i]) << 24 | std::uint64_t(bytes[i + 1]) << 16 | std::uint64_t(bytes[i + 2]) << 8 |
          bytes[i + 3]);
  }
  std::uint64_t value() const { return state_; }

 private:
  static std::uint64_t pair(std::uint32_t high, std::uint32_t low) { return std::uint64_t(high) << 32 | low; }

  std::uint64_t state_ = 0x2545F4914F6CDD1Du;
};

std::uint64_t more(std::uint64_t look, std::uint64_t word) {
  Look both;
  both.add(look);
  both.add(word);
  return both.value();
}

}  // namespace

struct Batch::Vector {
  float x = 0, y = 0, z = 0, w = 0;

  Vector() = default;
  Vector(double a, double b = 0, double c = 0, double d = 0)
      : x(float(a)), y(float(b)), z(float(c)), w(float(d)) {}
  static Vector premultiplied(const Color& c) {
    const double scale = c.a / 255;
    return {scale * c.r, scale * c.g, scale * c.b, c.a};
  }
};

struct Batch::Pixels {
  double x = 0, y = 0;
};

// A shape's opacity at a pixel is the least of slope (x, -x, y, -y) + offset, from 0 to 1: of those of the left, right,
// upper and lower edge. Where it does not fade, an edge cuts it off as smoothly as those of shapes are.
struct Batch::Fading {
  Vector slopes, offsets{1, 1, 1, 1};
  double left = -HUGE_VAL, top = -HUGE_VAL, right = HUGE_VAL, bottom = HUGE_VAL;  // nothing is seen beyond
  PixelBox unfaded;
};

Batch::Batch(int width, int height, GlyphAtlas& atlas)
    : width_(width), height_(height), atlas_(&atlas) {}

Batch::Pixels Batch::to_pixels(Point p) const {
  return {height_ * p.x, height_ * (1 - p.y)};
}

PixelBox Batch::to_pixels(const Rect& rect) const {
  const auto pixel = [](double edge, int largest) {
    return int(std::lround(std::clamp(edge, 0.0, double(largest))));
  };
  const Pixels low = to_pixels(Point{rect.x0, rect.y1}), high = to_pixels(Point{rect.x1, rect.y0});
  return box_between(pixel(low.x, width_), pixel(low.y, height_), pixel(high.x, width_), pixel(high.y, height_));
}

Batch::Fading Batch::to_pixels(const Fade& fade) const {
  Fading fading;
  fading.unfaded = clip_;
  if (!fade.any()) return fading;
  const Pixels low = to_pixels(Point{fade.scene.x0, fade.scene.y1}), high = to_pixels(Point{fade.scene.x1, fade.scene.y0});
  const auto stretch = [&](double side) { return std::max(1.0, height_ * side); };
  const auto slope = [&](double side) { return 1 / stretch(side); };
  const auto cut = [&](double side) { return side > 0 ? 0 : 0.5; };
  fading.slopes = {slope(fade.left), slope(fade.right), slope(fade.top), slope(fade.bottom)};
  fading.offsets = {cut(fade.left) - slope(fade.left) * low.x, cut(fade.right) + slope(fade.right) * high.x,
                    cut(fade.top) - slope(fade.top) * low.y, cut(fade.bottom) + slope(fade.bottom) * high.y};
  fading.left = low.x - kFringe, fading.top = low.y - kFringe, fading.right = high.x + kFringe, fading.bottom = high.y + kFringe;
  // A pixel less on each side: what is computed for its neighbour may be just below 1.
  const auto inner = [](double edge, int least, int most) { return int(std::clamp(edge, double(least), double(most))); };
  fading.unfaded = box_between(inner(std::ceil(low.x + stretch(fade.left)) + 1, clip_.x, clip_.right()),
                               inner(std::ceil(low.y + stretch(fade.top)) + 1, clip_.y, clip_.bottom()),
                               inner(std::floor(high.x - stretch(fade.right)) - 1, clip_.x, clip_.right()),
                               inner(std::floor(high.y - stretch(fade.bottom)) - 1, clip_.y, clip_.bottom()));
  return fading;
}

// All pixels that lie between the sides, within the clip. Empty for sides that are not numbers, too.
PixelBox Batch::visible_box(double left, double top, double right, double bottom) const {
  if (!std::isfinite(left + top + right + bottom)) return {};
  const auto inside = [](double edge, int low, int high) { return int(std::clamp(edge, double(low), double(high))); };
  return box_between(inside(std::floor(left), clip_.x, clip_.right()), inside(std::floor(top), clip_.y, clip_.bottom()),
                     inside(std::ceil(right), clip_.x, clip_.right()),
                     inside(std::ceil(bottom), clip_.y, clip_.bottom()));
}

// False where nothing would be seen.
bool Batch::set_paint(const Paint& paint, double& half_stroke, Vector& fill, Vector& stroke) const {
  const bool has_stroke = paint.stroke.a > 0 && paint.stroke_width > 0;
  half_stroke = has_stroke ? std::max(kThinnest, height_ * paint.stroke_width / 2) : 0;
  fill = Vector::premultiplied(paint.fill);
  stroke = has_stroke ? Vector::premultiplied(paint.stroke) : Vector();
  return has_stroke || paint.fill.a > 0;
}

Piece& Batch::append(Primitive primitive, const Outline& outline, std::initializer_list<Vector> vectors) {
  const auto size = std::size_t(4 * kPrimitives[std::size_t(primitive)].vectors);
  std::vector<float>& stream = streams_[std::size_t(primitive)];
  Piece piece{.primitive = primitive, .instance = int(stream.size() / size), .outline = outline};
  static_assert(sizeof(Vector) == 4 * sizeof(float));
  const std::size_t start = stream.size();
  stream.resize(start + size);
  std::memcpy(&stream[start], vectors.begin(), size * sizeof(float));
  Look look;
  look.add(std::uint64_t(primitive));
  look.add(clip_);
  // The atlas may hold another glyph in the same place by and by: what it is is added where it is known.
  const std::size_t known = primitive == Primitive::glyph ? 4 : 0;
  look.add(std::span<const float>(stream).last(size - known));
  piece.look = look.value();
  return pieces_.emplace_back(piece);
}

const float* Batch::numbers(const Piece& piece) const {
  const auto size = std::size_t(4 * kPrimitives[std::size_t(piece.primitive)].vectors);
  return &streams_[std::size_t(piece.primitive)][std::size_t(piece.instance) * size];
}

void Batch::set(const Picture& picture) {
  pieces_.clear();
  cell_sheets_.clear();
  solids_.clear();
  for (std::vector<float>& stream : streams_) stream.clear();
  for (const Item& item : picture.items) {
    clip_ =
        item.clip < 0 ? PixelBox{0, 0, width_, height_} : to_pixels(picture.clips.at(std::size_t(item.clip)));
    if (!clip_.empty()) std::visit([this](const auto& shape) { add(shape); }, item.shape);
  }
}

namespace {

// The part of a long segment that can be seen in [low, high]^2, as parameters; false where there is none.
bool clip_segment(double ax, double ay, double bx, double by, double low, double high, double& t0,
                  double& t1) {
  t0 = 0;
  t1 = 1;
  for (const auto& [from, to] : {std::pair(ax, bx), std::pair(ay, by)}) {
    if (std::max(from, to) < low || std::min(from, to) > high) return false;
    if (from == to) continue;
    const double at_low = (low - from) / (to - from), at_high = (high - from) / (to - from);
    t0 = std::max(t0, std::min(at_low, at_high));
    t1 = std::min(t1, std::max(at_low, at_high));
  }
  return t0 <= t1;
}

}  // namespace

void Batch::add(const Capsule& capsule) {
  Vector fill, stroke;
  double half_stroke = 0;
  if (!set_paint(capsule.paint, half_stroke, fill, stroke) || capsule.radius < 0) return;
  const double radius =
      half_stroke > 0 ? height_ * capsule.radius : std::max(kThinnest, height_ * capsule.radius);
  const double reach = radius + half_stroke + kFringe;
  Pixels a = to_pixels(capsule.a), b = to_pixels(capsule.b);
  const PixelBox box = visible_box(std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach,
                                   std::max(a.x, b.x) + reach, std::max(a.y, b.y) + reach);
  if (box.empty()) return;

  double alpha_a = capsule.alpha_a, alpha_b = capsule.alpha_b;
  const double farthest = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
  if (farthest > kFarthest) {
    double t0, t1;
    const double beyond = std::max(width_, height_) + 2 * reach;
    if (!clip_segment(a.x, a.y, b.x, b.y, -beyond, 2 * beyond, t0, t1)) return;
    const Pixels whole = {b.x - a.x, b.y - a.y};
    const double fade = alpha_b - alpha_a;
    b = {a.x + t1 * whole.x, a.y + t1 * whole.y};
    a = {a.x + t0 * whole.x, a.y + t0 * whole.y};
    alpha_b = alpha_a + t1 * fade;
    alpha_a = alpha_a + t0 * fade;
  }
  const Pixels along = {b.x - a.x, b.y - a.y};
  const double length = std::sqrt(along.x * along.x + along.y * along.y);
  const Pixels axis = length > 0 ? Pixels{along.x / length, along.y / length} : Pixels{1, 0};
  append(Primitive::capsule, {Outline::Kind::segment, box, a.x, a.y, axis.x, axis.y, length, 0, reach},
         {{a.x, a.y, axis.x, axis.y}, {length, radius, half_stroke}, {alpha_a, alpha_b}, fill, stroke});
}

void Batch::add(const Ellipse& ellipse) {
  const bool u_is_major = norm(ellipse.u) >= norm(ellipse.v);
  const Point major = u_is_major ? ellipse.u : ellipse.v, minor = u_is_major ? ellipse.v : ellipse.u;
  const double length = norm(major);
  if (norm(minor) >= length * (1 - 1e-9) && !ellipse.fade.any()) {
    add(Capsule{ellipse.center, ellipse.center, length, ellipse.paint});  // a disc
    return;
  }
  Vector fill, stroke;
  double half_stroke = 0;
  if (!set_paint(ellipse.paint, half_stroke, fill, stroke) || !ellipse.fade.is_finite()) return;
  const double smallest = half_stroke > 0 ? kSmallestAxis : kThinnest;
  const double a = std::clamp(height_ * length, smallest, kLargestAxis);
  const double b = std::clamp(height_ * norm(minor), smallest, a);
  const Pixels center = to_pixels(ellipse.center), axis = {major.x / length, -major.y / length};
  const double reach = half_stroke + kFringe;
  const double half_width = std::sqrt(a * a * axis.x * axis.x + b * b * axis.y * axis.y) + reach;
  const double half_height = std::sqrt(a * a * axis.y * axis.y + b * b * axis.x * axis.x) + reach;
  const Fading fading = to_pixels(ellipse.fade);
  const PixelBox box =
      visible_box(std::max(center.x - half_width, fading.left), std::max(center.y - half_height, fading.top),
                  std::min(center.x + half_width, fading.right), std::min(center.y + half_height, fading.bottom));
  if (box.empty()) return;
  append(Primitive::ellipse, {Outline::Kind::ellipse, box, center.x, center.y, axis.x, axis.y, a, b, reach},
         {{center.x, center.y, axis.x, axis.y}, {a, b, half_stroke}, stroke, fill, fading.slopes, fading.offsets})
      .unfaded = fading.unfaded;
}

void Batch::add(const Arc& arc) {
  if (!(arc.color.a > 0) || !(arc.radius >= 0) || !std::isfinite(arc.start) || !std::isfinite(arc.sweep))
    return;
  const double radius = height_ * arc.radius, half_width = std::max(kThinnest, height_ * arc.width / 2);
  const double reach = radius + half_width + kFringe;
  const Pixels center = to_pixels(arc.center);
  const PixelBox box = visible_box(center.x - reach, center.y - reach, center.x + reach, center.y + reach);
  if (box.empty()) return;
  const auto middle = sin_cos(arc.start + arc.sweep / 2);
  const auto half = sin_cos(std::min(std::abs(arc.sweep) / 2, std::numbers::pi));
  append(Primitive::arc, {Outline::Kind::ring, box, center.x, center.y, 1, 0, radius, 0, half_width + kFringe},
         {{center.x, center.y, middle.c, -middle.s},
                          {radius, half_width, half.s, half.c},
                          Vector::premultiplied(arc.color)});
}

void Batch::add(const Polygon& polygon) {
  Vector fill, stroke;
  double half_stroke = 0;
  if (polygon.count < 3 || polygon.count > kCorners || !polygon.fade.is_finite() ||
      !set_paint(polygon.paint, half_stroke, fill, stroke))
    return;
  std::vector<Pixels> corners;
  double left = HUGE_VAL, top = HUGE_VAL, right = -HUGE_VAL, bottom = -HUGE_VAL, twice_area = 0;
  for (int i = 0; i < polygon.count; ++i) {
    const Pixels p = to_pixels(polygon.corners[std::size_t(i)]);
    const Pixels next = to_pixels(polygon.corners[std::size_t((i + 1) % polygon.count)]);
    twice_area += p.x * next.y - p.y * next.x;
    left = std::min(left, p.x), right = std::max(right, p.x);
    top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    corners.push_back(p);
  }
  const double reach = half_stroke + kFringe;
  const Fading fading = to_pixels(polygon.fade);
  const PixelBox box = visible_box(std::max(left - reach, fading.left), std::max(top - reach, fading.top),
                                   std::min(right + reach, fading.right), std::min(bottom + reach, fading.bottom));
  if (box.empty() || !std::isfinite(twice_area)) return;

  // The shader takes eight corners in one sense; the missing ones divide the longest edges.
  if (twice_area < 0) std::reverse(corners.begin(), corners.end());
  while (corners.size() < kCorners) {
    std::size_t longest = 0;
    double longest_square = -1;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Pixels& next = corners[(i + 1) % corners.size()];
      const double square = std::pow(next.x - corners[i].x, 2) + std::pow(next.y - corners[i].y, 2);
      if (square > longest_square) longest_square = square, longest = i;
    }
    const Pixels& next = corners[(longest + 1) % corners.size()];
    const Pixels middle = {(corners[longest].x + next.x) / 2, (corners[longest].y + next.y) / 2};
    corners.insert(corners.begin() + std::ptrdiff_t(longest) + 1, middle);
  }
  const auto pair = [&corners](std::size_t i) {
    return Vector(corners[i].x, corners[i].y, corners[i + 1].x, corners[i + 1].y);
  };
  append(Primitive::polygon, {.kind = Outline::Kind::polygon, .box = box, .reach = reach},
         {pair(0), pair(2), pair(4), pair(6), {half_stroke}, stroke, fill, fading.slopes, fading.offsets})
      .unfaded = fading.unfaded;
}

void Batch::add(const Trail& trail) {
  if (!(trail.color.a > 0) || trail.points.empty()) return;
  const int first = int(pieces_.size());
  const Vector color = Vector::premultiplied(trail.color);
  PixelBox all;
  Look paint;
  for (const float level : {color.x, color.y, color.z, color.w}) paint.add(double(level));
  const std::size_t last = trail.points.size() - 1;
  for (std::size_t i = 0; i < std::max<std::size_t>(last, 1); ++i) {
    const TrailPoint& from = trail.points[i];
    const TrailPoint& to = trail.points[std::min(i + 1, last)];
    const Pixels a = to_pixels(from.p), b = to_pixels(to.p);
    const double radius_a = std::max(kThinnest, height_ * from.width / 2);
    const double radius_b = std::max(kThinnest, height_ * to.width / 2);
    const double reach = std::max(radius_a, radius_b) + kFringe;
    if (from.alpha <= 0 && to.alpha <= 0) continue;
    const PixelBox box = visible_box(std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach,
                                     std::max(a.x, b.x) + reach, std::max(a.y, b.y) + reach);
    if (box.empty()) continue;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Pixels axis = length > 0 ? Pixels{(b.x - a.x) / length, (b.y - a.y) / length} : Pixels{1, 0};
    Piece& piece =
        append(Primitive::trail, {Outline::Kind::segment, box, a.x, a.y, axis.x, axis.y, length, 0, reach},
               {{a.x, a.y, b.x, b.y}, {radius_a, radius_b, from.alpha, to.alpha}});
    piece.look = more(piece.look, paint.value());
    all = box_around(all, box);
  }
  // Where it differs its pieces do.
  if (int(pieces_.size()) > first) append(Primitive::layer, {Outline::Kind::box, all}, {color}).first_of_path = first;
}

void Batch::add(const GlyphRun& run) {
  if (!(run.color.a > 0) || !(run.size > 0)) return;
  const double size = height_ * run.size;
  if (size > kLargestText)
    throw Error(ExitCode::limit, "text of " + std::to_string(long(size)) + " px; the largest is " +
                                     std::to_string(long(kLargestText)));
  const int em = int(std::lround(64 * size)), stroke = int(std::lround(64 * height_ * run.stroke_width));
  for (const Glyph& glyph : run.glyphs) {
    const Pixels pen = to_pixels(run.origin + Point{glyph.x, glyph.y});
    if (visible_box(pen.x - 2 * size, pen.y - 2 * size, pen.x + 2 * size, pen.y + 2 * size).empty()) continue;
    const long quarters = std::lround(GlyphAtlas::kSteps * pen.x);
    const long step = ((quarters % GlyphAtlas::kSteps) + GlyphAtlas::kSteps) % GlyphAtlas::kSteps;
    const AtlasGlyph& bitmap = atlas_->glyph(run.face, glyph.index, em, int(step), stroke);
    if (bitmap.width == 0) continue;
    const double left = double((quarters - step) / GlyphAtlas::kSteps) + bitmap.offset_x;
    const double top = double(std::lround(pen.y)) + bitmap.offset_y;
    const PixelBox box = visible_box(left, top, left + bitmap.width, top + bitmap.height);
    if (box.empty()) continue;
    Piece& piece = append(Primitive::glyph, {Outline::Kind::box, box},
                          {{double(bitmap.left), double(bitmap.top)},
                           {left, top, double(bitmap.width), double(bitmap.height)},
                           Vector::premultiplied(run.color)});
    piece.look = more(piece.look, std::uint64_t(run.face) << 62 | std::uint64_t(glyph.index) << 30 |
                                      std::uint64_t(em) << 4 | std::uint64_t(step));
    if (stroke > 0) piece.look = more(piece.look, std::uint64_t(stroke));
    if (int(run.face) >= kOwnFaces) piece.look = more(piece.look, std::uint64_t(run.face));  // beyond the two bits above
  }
}

void Batch::add(const Cells& cells) {
  const std::size_t count = std::size_t(std::max(cells.nx, 0)) * std::size_t(std::max(cells.ny, 0));
  const Pixels low = to_pixels(Point{cells.rect.x0, cells.rect.y1});
  const Pixels high = to_pixels(Point{cells.rect.x1, cells.rect.y0});
  const PixelBox box = visible_box(low.x - kFringe, low.y - kFringe, high.x + kFringe, high.y + kFringe);
  if (count == 0 || cells.colors.size() != count || !(high.x > low.x) || !(high.y > low.y) || box.empty()) return;
  if (std::max(cells.nx, cells.ny) > kMostCells)
    throw Error(ExitCode::limit, "a map of " + std::to_string(cells.nx) + "x" + std::to_string(cells.ny) +
                                     " cells; each side may have up to " + std::to_string(kMostCells));
  CellSheet sheet{cells.nx, cells.ny, {}};
  sheet.rgba.reserve(4 * count);
  for (int row = cells.ny; row-- > 0;)
    for (int column = 0; column < cells.nx; ++column) {
      const Color& c = cells.colors[std::size_t(row) * std::size_t(cells.nx) + std::size_t(column)];
      for (const std::uint8_t level : {c.r, c.g, c.b})
        sheet.rgba.push_back(std::uint8_t(std::lround(c.a * level)));
      sheet.rgba.push_back(std::uint8_t(std::lround(255 * c.a)));
    }
  Look colors;
  colors.add(std::span<const std::uint8_t>(sheet.rgba));
  cell_sheets_.push_back(std::move(sheet));
  Piece& piece = append(Primitive::cells, {Outline::Kind::box, box},
                        {{low.x, low.y, high.x, high.y}, {double(cells.nx), double(cells.ny)}});
  piece.look = more(piece.look, colors.value());
}

namespace {

// Meshes by their places in memory, which are theirs as long as a canvas draws them.
std::uint64_t look_of(const Solids& solids) {
  Look look;
  for (const double number : {solids.origin.x, solids.origin.y, solids.scale}) look.add(number);
  for (const double number : solids.nearing) look.add(number);
  look.add(std::uint64_t(solids.is_shadow));
  const Fade& fade = solids.fade;
  for (const double number : {fade.scene.x0, fade.scene.y0, fade.scene.x1, fade.scene.y1, fade.left, fade.right, fade.bottom, fade.top})
    look.add(number);
  for (const Solid& part : solids.parts) {
    look.add(std::uint64_t(reinterpret_cast<std::uintptr_t>(part.mesh.get())));
    for (const double number : part.to_view) look.add(number);
    const Color color = part.color.value_or(Color{});
    look.add(std::uint64_t(part.color.has_value()) << 24 | std::uint64_t(color.r) << 16 |
             std::uint64_t(color.g) << 8 | color.b);
    look.add(color.a);
  }
  return look.value();
}

constexpr double kWidestBlur = 256;  // px

}  // namespace

void Batch::add(const Solids& solids) {
  if (solids.parts.empty() || !(solids.opacity > 0) || !is_drawable(solids)) return;
  const bool has_line = !solids.is_shadow && solids.outline.a > 0 && solids.outline_width > 0;
  const double blur = solids.is_shadow && std::isfinite(solids.outline_width) ? std::min(kWidestBlur, height_ * std::max(0.0, solids.outline_width)) : 0;
  const double radius = has_line ? std::max(2 * kThinnest, height_ * solids.outline_width) : blur;
  const double opacity = solids.is_shadow ? solids.opacity * solids.outline.a : solids.opacity;
  solids_.push_back(&solids);
  Piece& piece = append(Primitive::solids, {Outline::Kind::box, clip_}, {{opacity, radius}, Vector::premultiplied(solids.outline)});
  piece.look = more(piece.look, look_of(solids));
}

}  // namespace chainreel
