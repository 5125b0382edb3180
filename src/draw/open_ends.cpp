#include "draw/open_ends.hpp"

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "draw/mark_labels.hpp"
#include "draw/sheet.hpp"

namespace chainreel {
namespace {

constexpr double kSignAir = 0.008;       // units of H: about a sign
constexpr double kAppearing = 0.02;  // units of H: an axis that leads out by so much has its length in full strength

// The text with its middle as near to `at` as the scene allows.
void put_near(Picture& picture, const TextLine& text, Point at, const EllipseStyle& style, int clip,
              MarkLabels* labels) {
  const Point half{text.box.width() / 2, text.box.height() / 2};
  const Rect& scene = style.scene;
  const Point middle{
      std::clamp(at.x, std::min(scene.x0 + half.x, scene.x1), std::max(scene.x1 - half.x, scene.x0)),
      std::clamp(at.y, std::min(scene.y0 + half.y, scene.y1), std::max(scene.y1 - half.y, scene.y0))};
  if (labels != nullptr)
    labels->add(text, {middle.x - half.x, middle.y - half.y, middle.x + half.x, middle.y + half.y}, false);
  else
    draw_text(picture, text, {middle.x - half.x - text.box.x0, middle.y - half.y - text.box.y0}, clip);
}

// Half of what a text takes along the unit vector d.
double half_along(const TextLine& text, Point d) {
  return std::abs(d.x) * text.box.width() / 2 + std::abs(d.y) * text.box.height() / 2;
}

void draw_along(Picture& picture, const TextLine& text, Point center, Point d, double half_width,
                const EllipseStyle& style, int clip, MarkLabels* labels = nullptr) {
  const double clear = half_along(text, d) + kSignAir, along = way_out(style.scene, center, d) - clear;
  if (along > clear + size::kEndEffector) return put_near(picture, text, center + along * d, style, clip, labels);
  // Too near to the edge: beside the band, on the side that has more room.
  const Point side = normal_to(d), foot = center + std::max(along, 0.0) * d;
  const bool left = way_out(style.scene, foot, side) > way_out(style.scene, foot, -1 * side);
  put_near(picture, text, foot + ((left ? 1 : -1) * (half_width + half_along(text, side) + kSignAir)) * side, style,
           clip, labels);
}

double strength_of_length(Point center, Point v, const EllipseStyle& style) {
  return style.signs ? std::min(1.0, excess_of(style.scene, center, v) / kAppearing) : 0;
}

TextLine text_of_length(double length, double strength, const EllipseStyle& style) {
  const std::string unit = style.reading == EllipseReading::energy ? " m/s" : " kg";
  return lay_out_text(*style.fonts, format_significant(length, 3) + unit,
                      {Face::label, scaled(size::kTick, style.text_scale), style.theme->ellipse.faded(strength),
                       Align::left});
}

TextLine infinity(const EllipseStyle& style) {
  return lay_out_text(*style.fonts, "\u221E",
                      {Face::label, size::kSymbol * style.text_scale, style.theme->ellipse, Align::left});
}

Fade fade_before(const TextLine& text, double strength, Point center, Point v, const EllipseStyle& style) {
  Fade fade = fade_along(style.scene, center, v, style.fade);
  const Point d = unit(v);
  const double taken = strength * (2 * half_along(text, d) + kSignAir);
  // Only towards edges that the axis leaves through; one that it nearly misses comes in gradually.
  const auto room = [&](double stretch, double along) { return std::min(taken * std::abs(along), 4 * stretch); };
  fade.scene = {fade.scene.x0 + room(fade.left, d.x), fade.scene.y0 + room(fade.bottom, d.y),
                fade.scene.x1 - room(fade.right, d.x), fade.scene.y1 - room(fade.top, d.y)};
  return fade;
}

}  // namespace

void draw_infinities(Picture& picture, Point center, Point d, double half_width, const EllipseStyle& style, int clip) {
  if (!style.signs) return;
  const TextLine sign = infinity(style);
  draw_along(picture, sign, center, d, half_width, style, clip);
  draw_along(picture, sign, center, -1 * d, half_width, style, clip);
}

void draw_length_along(Picture& picture, Point center, Point v, double length, double half_width,
                       const EllipseStyle& style, int clip) {
  const double strength = strength_of_length(center, v, style);
  if (!(strength > 0)) return;
  const TextLine text = text_of_length(length, strength, style);
  draw_along(picture, text, center, unit(v), half_width, style, clip, style.labels);
  draw_along(picture, text, center, -1 * unit(v), half_width, style, clip, style.labels);
}

Fade fade_before_length(Point center, Point v, double length, const EllipseStyle& style) {
  const double strength = strength_of_length(center, v, style);
  if (!(strength > 0)) return fade_along(style.scene, center, v, style.fade);
  return fade_before(text_of_length(length, strength, style), strength, center, v, style);
}

Fade fade_before_infinity(Point center, Point d, const EllipseStyle& style) {
  return fade_before(infinity(style), style.signs ? 1 : 0, center, 2 * kBeyond * d, style);
}

}  // namespace chainreel
