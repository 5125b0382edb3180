#include "render/vector_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "picture/text.hpp"
#include "render/solid_bounds.hpp"

namespace chainreel {
namespace {

constexpr int kOpacityLevels = 32;
constexpr int kWidthLevels = 16;  // of the widest part

bool good(double x) {
  return std::isfinite(x);
}
bool good(Point p) {
  return good(p.x) && good(p.y);
}
bool good(const Paint& paint) {
  return good(paint.fill.a) && good(paint.stroke.a) && good(paint.stroke_width);
}

struct Finite {
  bool operator()(const Capsule& c) const {
    return good(c.a) && good(c.b) && good(c.radius) && good(c.paint) && good(c.alpha_a) && good(c.alpha_b);
  }
  bool operator()(const Ellipse& e) const {
    return good(e.center) && good(e.u) && good(e.v) && good(e.paint) && e.fade.is_finite();
  }
  bool operator()(const Arc& a) const {
    return good(a.center) && good(a.radius) && good(a.start) && good(a.sweep) && good(a.width);
  }
  bool operator()(const Polygon& p) const {
    return p.count >= 3 && p.count <= 8 && good(p.paint) && p.fade.is_finite() &&
           std::all_of(p.corners.begin(), p.corners.begin() + p.count, [](Point c) { return good(c); });
  }
  bool operator()(const Trail& t) const {
    return std::all_of(t.points.begin(), t.points.end(),
                       [](const TrailPoint& p) { return good(p.p) && good(p.width) && good(p.alpha); });
  }
  bool operator()(const GlyphRun& run) const { return good(run.origin) && good(run.size) && good(run.stroke_width); }
  bool operator()(const Cells& c) const {
    return c.nx > 0 && c.ny > 0 && c.colors.size() == std::size_t(c.nx) * std::size_t(c.ny) &&
           good(c.rect.x0 + c.rect.y0) && good(c.rect.x1 + c.rect.y1);
  }
  bool operator()(const Solids& s) const { return is_drawable(s); }
};

bool same(Point a, Point b) {
  return a.x == b.x && a.y == b.y;
}

}  // namespace

bool is_finite(const Shape& shape) {
  return std::visit(Finite{}, shape);
}

std::vector<TrailRun> trail_runs(const Trail& trail) {
  double widest = 0;
  for (const TrailPoint& p : trail.points) widest = std::max(widest, p.width);
  struct Level {
    int alpha = -1, width = -1;
    bool operator==(const Level&) const = default;
  };
  std::vector<TrailRun> runs;
  Level last;
  bool is_uniform = true;
  for (std::size_t i = 0; i + 1 < trail.points.size(); ++i) {
    const TrailPoint &a = trail.points[i], &b = trail.points[i + 1];
    const bool is_jump = same(a.p, b.p) && (a.alpha <= 0 || b.alpha <= 0);
    const Level level = {int(std::lround((a.alpha + b.alpha) / 2 * kOpacityLevels)),
                         int(std::lround((a.width + b.width) / 2 * kWidthLevels / std::max(widest, 1e-300)))};
    if (is_jump || level.alpha <= 0) continue;
    if (runs.empty() || !(level == last)) {
      is_uniform = runs.empty();
      runs.push_back({widest * level.width / kWidthLevels, double(level.alpha) / kOpacityLevels, {}, false});
      last = level;
    }
    auto& lines = runs.back().lines;
    if (lines.empty() || !same(lines.back().back(), a.p)) lines.push_back({a.p});
    lines.back().push_back(b.p);
  }
  if (is_uniform && !runs.empty()) runs.front().round_ends = true;
  return runs;
}

std::vector<FadeLevel> fade_levels(const Fade& fade) {
  std::vector<FadeLevel> levels;
  for (int i = 0; i <= kOpacityLevels; ++i) {
    const Rect part = fade.inset(double(i) / kOpacityLevels);
    if (part.x0 < part.x1 && part.y0 < part.y1) levels.push_back({part, std::min(1.0, (i + 0.5) / kOpacityLevels)});
  }
  return levels;
}

std::vector<GlyphCluster> clusters_of(const GlyphRun& run) {
  const std::u32string text = decode_utf8(run.text);
  std::set<std::size_t> starts{text.size()};
  for (const Glyph& glyph : run.glyphs) starts.insert(std::min<std::size_t>(glyph.character, text.size()));
  std::vector<GlyphCluster> clusters;
  for (std::size_t i = 0; i < run.glyphs.size();) {
    GlyphCluster cluster{i, 0, {}};
    const std::size_t from = std::min<std::size_t>(run.glyphs[i].character, text.size());
    while (i < run.glyphs.size() && run.glyphs[i].character == from) ++i, ++cluster.count;
    if (cluster.count == 0) ++i, ++cluster.count;  // a glyph without a character of its own
    // Up to where the next begins as it is read, which to the left may be the one before.
    const auto next = starts.upper_bound(from);
    if (next != starts.end()) cluster.text = text.substr(from, *next - from);
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

}  // namespace chainreel
