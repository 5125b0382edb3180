#include "draw/page/scales.hpp"

#include <cmath>
#include <numbers>

#include "core/format.hpp"
#include "draw/page/arrow.hpp"
#include "draw/page/coils.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/joints.hpp"

namespace chainreel {
namespace {

constexpr double kBarTick = 0.012;    // height of the ticks at the ends of a bar
constexpr double kTurnRadius = 0.70;  // of the em
constexpr double kDamperSize = 0.55;  // of one about a joint of full size

// An arc in the foot is small, but turns by the true angle.
double turn_radius(double em) {
  return kTurnRadius * em;
}

}  // namespace

EntryLine lay_out_entry(const ScaleEntry& entry, const Fonts& fonts, double text_scale, const Theme& theme) {
  const double em = scaled(size::kTick, text_scale);
  EntryLine line{entry, lay_out_text(fonts, entry.text, {Face::label, em, theme.ink, Align::left})};
  switch (entry.mark) {
    case ScaleEntry::Mark::turn:
      line.mark_width = 2 * turn_radius(em) + 0.3 * em;
      break;
    case ScaleEntry::Mark::damper:
      line.mark_width = 2 * kDamperSize * kVanesOuter;
      break;
    case ScaleEntry::Mark::center_of_mass:
      line.mark_width = size::kCenterOfMass;
      break;
    default:
      line.mark_width = entry.measure;
  }
  line.width = line.mark_width + (line.mark_width > 0 ? size::kMarkToText : 0) + line.text.advance;
  return line;
}

void draw_entry(Picture& picture, const EntryLine& line, Point left, const Theme& theme) {
  const double em = line.text.runs.empty() ? 0 : line.text.runs[0].size;
  const Point middle = left + Point{line.mark_width / 2, 0};
  const double r = turn_radius(em);
  switch (line.entry.mark) {
    case ScaleEntry::Mark::turn:
      draw_turn(picture, middle, {0, r}, {-r, 0}, line.entry.measure, {line.entry.color, 0.6, false, 0, theme.lines}, -1);
      break;
    case ScaleEntry::Mark::damper: {
      ChainLook look;
      look.theme = &theme;
      draw_vanes(picture, {middle, {1, 0}, {0, 1}}, std::numbers::pi / 2, kDamperSize, line.entry.color, tinted(line.entry.color, kInsideOfVanes, look), -1);
      break;
    }
    case ScaleEntry::Mark::center_of_mass: {
      ChainLook look;
      look.theme = &theme;
      draw_center_of_mass(picture, middle, look, -1);
      break;
    }
    case ScaleEntry::Mark::disc:
      picture.add(Ellipse{middle, {line.mark_width / 2, 0}, {0, line.mark_width / 2}, {line.entry.color, {}, 0}}, -1);
      break;
    default:
      draw_arrow(picture, left, {line.entry.measure, 0},
                 {line.entry.color, 1, line.entry.mark == ScaleEntry::Mark::dashed_arrow, 0, theme.lines}, -1);
  }
  draw_text(picture, line.text, {left.x + line.width - line.text.advance, left.y - kCapHeight / 2 * em});
}

double round_length(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= most) return step * decade;
  }
  return decade;
}

void draw_scale_bar(Picture& picture, Point at, double length, Color color, int clip) {
  const double r = size::kScaleBar / 2;
  const Point end{at.x + length, at.y};
  picture.add(Capsule{at, end, r, {color, {}, 0}}, clip);
  for (const Point p : {at, end}) {
    picture.add(Capsule{{p.x, p.y - kBarTick / 2}, {p.x, p.y + kBarTick / 2}, r, {color, {}, 0}}, clip);
  }
}

double metre_bar_length(double scale, double scene_width) {
  return round_length(0.25 * scene_width / scale);
}

double metre_bar_row(double text_scale) {
  return 1.5 * scaled(size::kTick, text_scale);
}

void draw_metre_bar(Picture& picture, const Camera& camera, const Sheet& sheet, const Fonts& fonts) {
  const double metres = metre_bar_length(camera.scale, sheet.scene.width());
  const double length = metres * camera.scale, text_size = scaled(size::kTick, sheet.text_scale);
  const Point at{sheet.scene.x0, sheet.scene.y0 + 0.6 * text_size};
  draw_scale_bar(picture, at, length, sheet.theme->ink);
  const TextStyle style{Face::label, text_size, sheet.theme->ink, Align::left};
  draw_text(picture, lay_out_text(fonts, format_shortest(metres) + " m", style),
            {at.x + length + 0.014, at.y - 0.36 * text_size});
}

}  // namespace chainreel
