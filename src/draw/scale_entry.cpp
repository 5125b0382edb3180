#include "draw/scale_entry.hpp"

#include "draw/arrow.hpp"
#include "draw/marks.hpp"
#include "draw/sheet.hpp"

namespace chainreel {
namespace {

constexpr double kTurnRadius = 0.70;  // of the em

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
      if (line.entry.measure > 0)
        draw_turn(picture, middle, {0, r}, {-r, 0}, line.entry.measure, {line.entry.color, 0.6}, -1);
      else
        draw_ring(picture, middle, {0, r}, {-r, 0}, line.entry.color, -1);
      break;
    case ScaleEntry::Mark::center_of_mass: {
      ChainLook look;
      look.theme = &theme;
      draw_center_of_mass(picture, middle, look, -1);
      break;
    }
    default:
      draw_arrow(picture, left, {line.entry.measure, 0},
                 {line.entry.color, 1, line.entry.mark == ScaleEntry::Mark::dashed_arrow}, -1);
  }
  draw_text(picture, line.text, {left.x + line.width - line.text.advance, left.y - kCapHeight / 2 * em});
}

}  // namespace chainreel
