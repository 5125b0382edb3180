#include "draw/robot/joints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chainreel {
namespace {

// The hatch goes down to the left at 45 degrees when the ground is below.
constexpr double kHatchDepth = size::kGroundSpacing;

}  // namespace

void draw_line(Picture& picture, PageLine line, double width, Color color, int clip) {
  picture.add(Capsule{line.a, line.b, width / 2, {color, {}, 0}}, clip);
}

void draw_dashed_line(Picture& picture, PageLine line, double width, Color color, int clip) {
  const double dash = 0.007, length = norm(line.b - line.a);
  const Point along = unit(line.b - line.a);
  for (double at = 0; at < length; at += 2 * dash)
    draw_line(picture, {line.a + at * along, line.a + std::min(at + dash, length) * along}, width, color, clip);
}

void draw_revolute(Picture& picture, Point center, const ChainLook& look, int clip) {
  const double r = look.joint_disc / 2, dot = size::kJointDot / 2 * look.joint_disc / size::kJointDisc;
  const Color ink = toned(look.theme->ink, look);
  const double outline = look.stroke * size::kJointOutline * std::sqrt(look.joint_disc / size::kJointDisc);
  picture.add(Ellipse{center, {r, 0}, {0, r}, {look.filled ? look.theme->background : Color{}, ink, outline}}, clip);
  picture.add(Ellipse{center, {dot, 0}, {0, dot}, {ink, {}, 0}}, clip);
}

void draw_end_effector(Picture& picture, Point center, const ChainLook& look, int clip) {
  const double r = look.marks * size::kEndEffector / 2;
  picture.add(Ellipse{center, {r, 0}, {0, r}, {toned(look.theme->ink, look), {}, 0}}, clip);
}

void draw_center_of_mass(Picture& picture, Point center, const ChainLook& look, int clip) {
  constexpr int kEdges = 6;  // of a quarter: 0.9 % of the radius off the circle, a tenth of a pixel
  const double r = look.marks * size::kCenterOfMass / 2;
  const Color ink = look.theme->ink;
  picture.add(Ellipse{center, {r, 0}, {0, r}, {look.theme->background, {}, 0}}, clip);
  for (const double start : {0.0, std::numbers::pi}) {
    Polygon quarter;
    quarter.count = kEdges + 2;
    quarter.corners[0] = center;
    quarter.paint = {ink, {}, 0};
    for (int i = 0; i <= kEdges; ++i) {
      const double angle = start + i * std::numbers::pi / 2 / kEdges;
      quarter.corners[std::size_t(i + 1)] = center + Point{r * std::cos(angle), r * std::sin(angle)};
    }
    picture.add(quarter, clip);
  }
  picture.add(Ellipse{center, {r, 0}, {0, r}, {{}, ink, size::kLinkOutline}}, clip);
}

PageLine with_overhang(PageLine way, bool carrier, const ChainLook& look) {
  const Point along = unit(way.b - way.a);
  const double overhang = look.rails * rail_overhang(carrier);
  return {way.a - overhang * along, way.b + overhang * along};
}

void draw_rail(Picture& picture, PageLine rail, Color fill, const ChainLook& look, int clip) {
  const Point half = (look.rails * size::kRailGap / 2) * normal_to(unit(rail.b - rail.a));
  const Color ink = toned(look.theme->ink, look);
  picture.add(Polygon{{rail.a + half, rail.b + half, rail.b - half, rail.a - half}, 4, {fill, {}, 0}}, clip);
  for (const double side : {-1.0, 1.0}) {
    draw_line(picture, {rail.a + side * half, rail.b + side * half}, size::kRailLine, ink, clip);
  }
  for (const Point end : {rail.a, rail.b})
    draw_line(picture, {end + half, end - half}, size::kRailLine, ink, clip);
}

void draw_carriage(Picture& picture, Point center, Point along, bool carrier, Color fill,
                   const ChainLook& look, int clip) {
  const Point u = unit(along);
  const Point l = (look.rails * carriage_length(carrier) / 2) * u;
  const Point h = (look.rails * size::kCarriageHeight / 2) * normal_to(u);
  picture.add(Polygon{{center + l + h, center - l + h, center - l - h, center + l - h},
                      4,
                      {fill, toned(look.theme->ink, look), look.stroke * size::kLinkOutline}},
              clip);
}

void draw_ground(Picture& picture, PageLine line, Point inside, const ChainLook& look, int clip) {
  const Color base = toned(look.theme->base, look);
  const Point along = unit(line.b - line.a);
  const double length = norm(line.b - line.a);
  // Whole spacings, centred, so that the hatch is the same at both ends.
  const double spacing = look.marks * size::kGroundSpacing, depth = look.marks * kHatchDepth;
  const int strokes = std::max(1, int(std::floor(length / spacing)));
  const double first = (length - (strokes - 1) * spacing) / 2 + depth / 2;
  for (int i = 0; i < strokes; ++i) {
    const Point top = line.a + (first + i * spacing) * along;
    draw_line(picture, {top, top - depth * along + depth * inside}, size::kGroundHatch, base, clip);
  }
  draw_line(picture, line, size::kGroundLine, base, clip);
}

void draw_pin(Picture& picture, Point center, const ChainLook& look, int clip) {
  // The pin goes with its joint, which is small where links are thin.
  const double pin = look.marks * std::clamp(look.joint_disc / (look.marks * size::kJointDisc), 0.65, 1.0);
  const Point foot = center - Point{0, pin * kPinHeight};
  const Point half{pin * kPinWidth / 2, 0}, half_line{look.marks * size::kGroundLength / 2, 0};
  draw_ground(picture, {foot - half_line, foot + half_line}, {0, -1}, look, clip);
  picture.add(
      Polygon{{center, foot - half, foot + half},
              3,
              {tinted(look.theme->base, 0.35, look), toned(look.theme->base, look), size::kLinkOutline}},
      clip);
}

void draw_rail_ground(Picture& picture, PageLine rail, const ChainLook& look, int clip) {
  Point inside = normal_to(unit(rail.b - rail.a));
  // Below the rail; left of it where it stands upright.
  if (inside.y > 1e-9 || (std::abs(inside.y) <= 1e-9 && inside.x > 0)) inside = -1 * inside;
  const Point shift = (look.rails * size::kRailGap / 2 + size::kGroundLine / 2) * inside;
  draw_ground(picture, {rail.a + shift, rail.b + shift}, inside, look, clip);
}

double pin_depth() {
  return kPinHeight + kHatchDepth + size::kGroundHatch / 2;
}

double rail_ground_depth() {
  return size::kRailGap / 2 + size::kGroundLine + kHatchDepth + size::kGroundHatch / 2;
}

}  // namespace chainreel
