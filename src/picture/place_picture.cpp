#include "picture/place_picture.hpp"

#include <algorithm>

namespace chainreel {
namespace {

constexpr double kRoundOff = 1e-9;  // a text that just has the smallest size is kept

// One overload a shape: a new shape does not compile before it has its own.
struct Placer {
  double scale = 1;
  Point shift;
  double thinnest = 0;

  Point operator()(Point p) const { return shift + scale * p; }
  Rect operator()(const Rect& r) const {
    const Point low = (*this)(Point{r.x0, r.y0}), high = (*this)(Point{r.x1, r.y1});
    return {low.x, low.y, high.x, high.y};
  }
  // The width of a line: none where there was none.
  double width(double w) const { return w > 0 ? std::max(scale * w, thinnest) : 0; }
  Paint operator()(Paint paint) const {
    paint.stroke_width = width(paint.stroke_width);
    return paint;
  }

  Fade operator()(const Fade& fade) const {
    return {(*this)(fade.scene), scale * fade.left, scale * fade.right, scale * fade.bottom, scale * fade.top};
  }

  Capsule operator()(Capsule capsule) const {
    const bool is_line = capsule.paint.stroke_width == 0;
    capsule.a = (*this)(capsule.a);
    capsule.b = (*this)(capsule.b);
    capsule.radius = is_line ? width(2 * capsule.radius) / 2 : scale * capsule.radius;
    capsule.paint = (*this)(capsule.paint);
    return capsule;
  }
  Ellipse operator()(Ellipse ellipse) const {
    ellipse.center = (*this)(ellipse.center);
    ellipse.u = scale * ellipse.u;
    ellipse.v = scale * ellipse.v;
    ellipse.paint = (*this)(ellipse.paint);
    ellipse.fade = (*this)(ellipse.fade);
    return ellipse;
  }
  Arc operator()(Arc arc) const {
    arc.center = (*this)(arc.center);
    arc.radius *= scale;
    arc.width = width(arc.width);
    return arc;
  }
  Polygon operator()(Polygon polygon) const {
    for (int i = 0; i < polygon.count; ++i) {
      Point& corner = polygon.corners[std::size_t(i)];
      corner = (*this)(corner);
    }
    polygon.paint = (*this)(polygon.paint);
    polygon.fade = (*this)(polygon.fade);
    return polygon;
  }
  Trail operator()(Trail trail) const {
    for (TrailPoint& point : trail.points) {
      point.p = (*this)(point.p);
      point.width = width(point.width);
    }
    return trail;
  }
  GlyphRun operator()(GlyphRun run) const {
    run.size *= scale;
    run.stroke_width *= scale;
    run.origin = (*this)(run.origin);
    for (Glyph& glyph : run.glyphs) {
      glyph.x *= scale;
      glyph.y *= scale;
    }
    return run;
  }
  Cells operator()(Cells cells) const {
    cells.rect = (*this)(cells.rect);
    return cells;
  }
  Solids operator()(Solids solids) const {
    solids.origin = (*this)(solids.origin);
    solids.scale *= scale;
    solids.outline_width = solids.is_shadow ? scale * solids.outline_width : width(solids.outline_width);
    solids.fade = (*this)(solids.fade);
    return solids;
  }
};

bool is_unreadable(const Shape& shape, double smallest) {
  const GlyphRun* run = std::get_if<GlyphRun>(&shape);
  return run != nullptr && run->size < smallest * (1 - kRoundOff);
}

Rect common_part(const Rect& a, const Rect& b) {
  const Rect both{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
  return {both.x0, both.y0, std::max(both.x0, both.x1), std::max(both.y0, both.y1)};
}

Shape placed_shape(const Placer& place, const Shape& shape) {
  return std::visit([&](const auto& one) -> Shape { return place(one); }, shape);
}

}  // namespace

Picture in_page_units(const Picture& picture, double height) {
  const Placer place{1 / height, {}, 0};
  Picture page;
  page.aspect = picture.aspect / height;
  page.background = picture.background;
  for (const Rect& clip : picture.clips) page.clips.push_back(place(clip));
  for (const Item& item : picture.items) page.items.push_back({placed_shape(place, item.shape), item.clip});
  return page;
}

void place_picture(Picture& target, const Picture& page, const Placing& placing) {
  const Rect& cell = placing.cell;
  const Rect shown{placing.margin, placing.margin, page.aspect - placing.margin, 1 - placing.margin};
  const double scale = std::min(cell.width() / shown.width(), cell.height() / shown.height());
  const Point corner{(cell.x0 + cell.x1 - scale * page.aspect) / 2, (cell.y0 + cell.y1 - scale) / 2};
  const Placer place{scale, corner, placing.thinnest_line};
  const Rect edges = place(shown);

  const int first_clip = int(target.clips.size());
  target.clips.push_back(edges);
  for (const Rect& clip : page.clips) target.clips.push_back(common_part(place(clip), edges));
  for (const Item& item : page.items) {
    Item placed{placed_shape(place, item.shape), first_clip + 1 + item.clip};
    if (!is_unreadable(placed.shape, placing.smallest_text)) target.items.push_back(std::move(placed));
  }
}

}  // namespace chainreel
