#include "render/test_card.hpp"

#include <cmath>
#include <numbers>

namespace chainreel {
namespace {

using std::numbers::pi;

Point on_circle(Point center, double radius, double angle) {
  return center + Point{radius * std::cos(angle), radius * std::sin(angle)};
}

void draw_chain(Picture& page, const Theme& theme, Point base) {
  Point joint = base;
  const double angles[] = {0.9, 0.2, -0.7};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point next = on_circle(joint, 0.16, angles[i]);
    page.add(Capsule{joint, next, size::kLinkWidth / 2, {theme.link[i], theme.ink, size::kLinkOutline}});
    joint = next;
  }
  joint = base;
  for (const double angle : angles) {
    const double r = size::kJointDisc / 2, dot = size::kJointDot / 2;
    page.add(Ellipse{joint, {r, 0}, {0, r}, {theme.background, theme.ink, size::kJointOutline}});
    page.add(Ellipse{joint, {dot, 0}, {0, dot}, {theme.ink, {}, 0}});
    joint = on_circle(joint, 0.16, angle);
  }
  page.add(Ellipse{joint, {0.007, 0}, {0, 0.007}, {theme.ink, {}, 0}});
  // The ground mark.
  page.add(Capsule{
      base - Point{0.06, 0.03}, base + Point{0.06, -0.03}, size::kGroundLine / 2, {theme.base, {}, 0}});
  for (int i = 0; i < 8; ++i) {
    const Point top = base + Point{-0.05 + i * size::kGroundSpacing, -0.03};
    page.add(Capsule{top, top - Point{0.012, 0.012}, size::kGroundHatch / 2, {theme.base, {}, 0}});
  }
}

void draw_ellipses(Picture& page, const Theme& theme, Point at) {
  const auto axes = [](double a, double b, double angle) {
    const Point u = on_circle({}, a, angle);
    return std::pair(u, (b / a) * Point{-u.y, u.x});
  };
  const Paint paint = {theme.ellipse.faded(0.16), theme.ellipse, size::kEllipseLine};
  double x = 0;
  for (const double flatness : {0.6, 0.2, 0.02, 0.0001, 0.0}) {
    const auto [u, v] = axes(0.11, 0.11 * flatness, 0.5);
    page.add(Ellipse{at + Point{x, 0}, u, v, paint});
    x += 0.16;
  }
  const auto [u, v] = axes(0.08, 0.03, -0.3);
  page.add(Ellipse{at + Point{x, 0.0}, u, v, {theme.link[3], {}, 0}});
}

void draw_arcs(Picture& page, const Theme& theme, Point at) {
  double x = 0;
  for (const double sweep : {0.5, pi, -1.7, 5.2, 2 * pi}) {
    page.add(Arc{at + Point{x, 0}, 0.045, 0.4, sweep, 0.006, theme.torque});
    x += 0.13;
  }
}

void draw_polygons(Picture& page, const Theme& theme, Point at) {
  double x = 0;
  for (int corners = 3; corners <= 8; ++corners) {
    Polygon polygon;
    polygon.count = corners;
    for (int i = 0; i < corners; ++i)
      polygon.corners[std::size_t(i)] = on_circle(at + Point{x, 0}, 0.045, 0.3 + 2 * pi * i / corners);
    polygon.paint = {theme.link[std::size_t(corners) % 4], theme.ink,
                     corners % 2 == 0 ? size::kLinkOutline : 0};
    page.add(polygon);
    x += 0.11;
  }
  Polygon arrow = {{{{0, 0.009}, {0.024, 0}, {0, -0.009}}}, 3, {theme.velocity, {}, 0}};
  for (Point& corner : arrow.corners) corner = corner + at + Point{x, 0};
  page.add(Capsule{at + Point{x - 0.05, 0}, at + Point{x, 0}, 0.003, {theme.velocity, {}, 0}});
  page.add(arrow);
}

void draw_trails(Picture& page, const Theme& theme, Point at) {
  Trail trail;
  trail.color = theme.curve[2];
  const int last = 120;
  for (int i = 0; i <= last; ++i) {
    const double s = double(i) / last;
    const Point p = {0.55 * s, 0.05 * std::sin(14 * s) * (1 - 0.5 * s)};
    trail.points.push_back({at + p, size::kTrailTail + s * (size::kTrailHead - size::kTrailTail), 0.7 * s});
  }
  page.add(trail);
  Trail loop;
  loop.color = theme.curve[0];
  for (int i = 0; i <= 80; ++i)
    loop.points.push_back({on_circle(at + Point{0.68, 0}, 0.02 + 0.0004 * i, 0.2 * i), 0.008, 0.35});
  page.add(loop);
}

void draw_lines(Picture& page, const Theme& theme, Point at) {
  for (int i = 0; i < 12; ++i) {
    const double angle = pi / 2 * i / 11;
    page.add(Capsule{
        on_circle(at, 0.03, angle), on_circle(at, 0.15, angle), (0.0005 + 0.0003 * i), {theme.ink, {}, 0}});
  }
  page.add(Capsule{at + Point{0.2, 0.1}, at + Point{0.45, 0.1}, 0.004, {theme.curve[0], {}, 0}, 1, 0});
  page.add(Capsule{at + Point{0.2, 0.06},
                   at + Point{0.45, 0.02},
                   0.02,
                   {theme.link[0].faded(0.5), theme.ink.faded(0.5), 0.008},
                   1,
                   0.2});
}

// Cells of any size, a few of them translucent.
void draw_map(Picture& page, const Rect& rect) {
  Cells cells{rect, 7, 5, {}};
  for (int i = 0; i < 35; ++i)
    cells.colors.push_back(
        {std::uint8_t(7 * i), std::uint8_t(90 + 3 * i), std::uint8_t(250 - 5 * i), i % 6 == 0 ? 0.5 : 1});
  page.add(cells);
}

void draw_texts(Picture& page, const Fonts& fonts, const Theme& theme) {
  const auto text = [&](Face face, double em, Color color, Align align, const char* words, Point at) {
    draw_text(page, lay_out_text(fonts, words, {face, em, color, align}), at);
  };
  const auto math = [&](double em, const char* notation, Point at) {
    draw_text(page, lay_out_math(fonts, notation, {Face::math, em, theme.ink, Align::left}), at);
  };
  text(Face::label_bold, size::kTitle, theme.ink, Align::left, "Every primitive, once", {0.05, 0.925});
  text(Face::label, size::kAxis, theme.ink, Align::right, "t = 1.24 s", {1.72, 0.05});
  text(Face::label, size::kTick, theme.muted, Align::center, "energy [J]   0.25\u00d7   \u22122.5",
       {1.4, 0.05});
  math(size::kEquation, "tau = (10, 10, 10)^T N m", {0.05, 0.86});
  math(size::kEquation, "tau = (0, -100 y_G) N", {0.62, 0.86});
  math(size::kEquation, "Lambda^-1 = J M^{-1} J^T", {1.10, 0.86});
  math(size::kSymbol, "q_1, qd_2, qdd_3, thetad, lambda_{n_c}, x_ee^2, h sin(2*q1), 1.5e-3 m/s^2",
       {0.62, 0.79});
}

}  // namespace

Picture test_card(const Fonts& fonts, const Theme& theme) {
  Picture page;
  page.background = theme.background;
  page.clips.push_back({1.45, 0.10, 1.72, 0.22});
  draw_texts(page, fonts, theme);
  draw_chain(page, theme, {0.13, 0.52});
  draw_ellipses(page, theme, {0.80, 0.65});
  draw_arcs(page, theme, {0.75, 0.48});
  draw_polygons(page, theme, {0.12, 0.36});
  draw_trails(page, theme, {0.06, 0.20});
  draw_lines(page, theme, {0.95, 0.18});
  // What is cut by a clip rectangle, and large translucent discs one over the other.
  page.add(Ellipse{{1.45, 0.16}, {0.1, 0}, {0, 0.1}, {theme.link[1], theme.ink, size::kLinkOutline}}, 0);
  for (int i = 0; i < 3; ++i) {
    const Point at = on_circle({1.58, 0.42}, 0.05, 2 * pi * i / 3);
    page.add(Ellipse{at, {0.08, 0}, {0, 0.08}, {theme.link[std::size_t(i)].faded(0.5), {}, 0}});
  }
  draw_map(page, {1.62, 0.52, 1.74, 0.60});
  return page;
}

}  // namespace chainreel
