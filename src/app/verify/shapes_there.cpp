#include "app/verify/shapes_there.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/format.hpp"
#include "picture/point.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kMostTold = 5;

// Boxes around shapes, units of H; what covers more than it shows does no harm here.
struct BoxOf {
  Rect operator()(const Capsule& s) const {
    return widened(around({s.a.x, s.a.y, s.a.x, s.a.y}, {s.b.x, s.b.y, s.b.x, s.b.y}), s.radius);
  }
  Rect operator()(const Ellipse& s) const {
    const double x = std::hypot(s.u.x, s.v.x), y = std::hypot(s.u.y, s.v.y);
    return {s.center.x - x, s.center.y - y, s.center.x + x, s.center.y + y};
  }
  Rect operator()(const Arc& s) const {
    const double r = s.radius + s.width / 2;
    return {s.center.x - r, s.center.y - r, s.center.x + r, s.center.y + r};
  }
  Rect operator()(const Polygon& s) const {
    Rect box = at(s.corners[0]);
    for (int i = 1; i < s.count; ++i) box = around(box, at(s.corners[std::size_t(i)]));
    return box;
  }
  Rect operator()(const Trail& s) const {
    if (s.points.empty()) return {};
    Rect box = at(s.points.front().p);
    for (const TrailPoint& point : s.points) box = around(box, widened(at(point.p), point.width / 2));
    return box;
  }
  Rect operator()(const GlyphRun& s) const {
    Rect box = at(s.origin);
    for (const Glyph& glyph : s.glyphs) box = around(box, at({s.origin.x + glyph.x, s.origin.y + glyph.y}));
    // Ascenders, descenders and the last glyph's width are within an em of the pen.
    return widened({box.x0 - 0.1 * s.size, box.y0 - 0.35 * s.size, box.x1 + s.size, box.y1 + s.size}, s.stroke_width / 2);
  }
  Rect operator()(const Cells& s) const { return s.rect; }
  Rect operator()(const Solids&) const { return {-1e9, -1e9, 1e9, 1e9}; }

  static Rect at(Point p) { return {p.x, p.y, p.x, p.y}; }
};

struct NameOf {
  std::string operator()(const Capsule& s) const { return s.radius > 0.01 ? "a bar" : "a line"; }
  std::string operator()(const Ellipse& s) const {
    return std::abs(std::hypot(s.u.x, s.u.y) - std::hypot(s.v.x, s.v.y)) < 1e-9 ? "a disc" : "an ellipse";
  }
  std::string operator()(const Arc&) const { return "an arc"; }
  std::string operator()(const Polygon&) const { return "a polygon"; }
  std::string operator()(const Trail&) const { return "a curve or an outline"; }
  std::string operator()(const GlyphRun& s) const { return "the text '" + s.text + "'"; }
  std::string operator()(const Cells&) const { return "coloured cells"; }
  std::string operator()(const Solids&) const { return "bodies"; }
};

}  // namespace

std::string shapes_there(const Picture& picture, int height, const PixelBox& box) {
  const double h = height;
  const Rect part{box.x / h, 1 - (box.y + box.height) / h, (box.x + box.width) / h, 1 - box.y / h};
  std::vector<std::string> words;
  std::set<std::string> seen;
  // What lies on top is seen, and told, first.
  for (auto item = picture.items.rbegin(); item != picture.items.rend(); ++item) {
    if (!overlap(std::visit(BoxOf{}, item->shape), part)) continue;
    if (item->clip >= 0 && !overlap(picture.clips[std::size_t(item->clip)], part)) continue;
    const std::string name = std::visit(NameOf{}, item->shape);
    if (seen.insert(name).second) words.push_back(name);
  }
  if (words.empty()) return "nothing but the background";
  const bool more = words.size() > kMostTold;
  if (more) words.resize(kMostTold);
  return joined(words) + (more ? ", .." : "");
}

}  // namespace chainreel
