// Questions to a list of shapes.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "picture/theme.hpp"

namespace chainreel::test {

template <class S>
std::vector<S> all_of(const Picture& picture) {
  std::vector<S> found;
  for (const Item& item : picture.items) {
    if (const S* shape = std::get_if<S>(&item.shape)) found.push_back(*shape);
  }
  return found;
}

template <class S, class Where>
std::vector<S> all_of(const Picture& picture, Where where) {
  std::vector<S> found = all_of<S>(picture);
  std::erase_if(found, [&](const S& shape) { return !where(shape); });
  return found;
}

inline double distance(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}
inline double length(Point v) {
  return std::hypot(v.x, v.y);
}

inline bool is_inside(const Rect& r, Point p, double slack = 0) {
  return p.x >= r.x0 - slack && p.x <= r.x1 + slack && p.y >= r.y0 - slack && p.y <= r.y1 + slack;
}
inline bool is_inside(const Rect& outer, const Rect& inner) {
  return is_inside(outer, Point{inner.x0, inner.y0}) && is_inside(outer, Point{inner.x1, inner.y1});
}
inline bool overlap(const Rect& a, const Rect& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

inline Rect shifted(const Rect& r, Point by) {
  return {r.x0 + by.x, r.y0 + by.y, r.x1 + by.x, r.y1 + by.y};
}

inline Rect box_of(const Polygon& polygon) {
  Rect box{polygon.corners[0].x, polygon.corners[0].y, polygon.corners[0].x, polygon.corners[0].y};
  for (int i = 1; i < polygon.count; ++i) {
    const Point p = polygon.corners[std::size_t(i)];
    box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
  }
  return box;
}
inline Point middle_of(const Rect& r) {
  return {(r.x0 + r.x1) / 2, (r.y0 + r.y1) / 2};
}

// Everything written on the picture, run by run.
inline std::string words_of(const Picture& picture) {
  std::string words;
  for (const GlyphRun& run : all_of<GlyphRun>(picture))
    if (run.stroke_width == 0) words += run.text;  // halos say nothing
  return words;
}

// Units of H for 1 kg, or m/s, as the scale bar of ellipses in the page's foot says.
inline double per_unit_of_bar(const Picture& page, const Theme& theme = light_theme()) {
  double worth = 0, length = 0;
  for (const GlyphRun& run : all_of<GlyphRun>(page))
    if (run.text.ends_with(" kg") || run.text.ends_with(" m/s")) worth = std::stod(run.text);
  for (const Item& item : page.items) {
    const auto* line = std::get_if<Capsule>(&item.shape);
    if (line && item.clip < 0 && line->paint.fill == theme.ellipse)
      length = std::max(length, distance(line->a, line->b));
  }
  return length / worth;
}

// The outline of an effective mass on the light page.
inline bool is_mass_ellipse(const Ellipse& e) {
  return e.paint.stroke == light_theme().ellipse;
}

// No coordinate or size in the picture is NaN or infinite.
inline bool is_finite(Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}
inline bool all_finite(const Picture& picture) {
  struct Finite {
    bool operator()(const Capsule& c) const {
      return is_finite(c.a) && is_finite(c.b) && std::isfinite(c.radius);
    }
    bool operator()(const Ellipse& e) const {
      return is_finite(e.center) && is_finite(e.u) && is_finite(e.v);
    }
    bool operator()(const Arc& a) const { return is_finite(a.center) && std::isfinite(a.sweep); }
    bool operator()(const Polygon& p) const {
      return std::all_of(p.corners.begin(), p.corners.begin() + p.count,
                         [](Point c) { return is_finite(c); });
    }
    bool operator()(const Trail& t) const {
      return std::all_of(t.points.begin(), t.points.end(),
                         [](const TrailPoint& p) { return is_finite(p.p); });
    }
    bool operator()(const GlyphRun& run) const { return is_finite(run.origin); }
    bool operator()(const Cells& c) const {
      return is_finite({c.rect.x0, c.rect.y0}) && is_finite({c.rect.x1, c.rect.y1});
    }
    bool operator()(const Solids& s) const { return is_finite(s.origin) && std::isfinite(s.scale); }
  };
  return std::all_of(picture.items.begin(), picture.items.end(),
                     [](const Item& item) { return std::visit(Finite{}, item.shape); });
}

}  // namespace chainreel::test
