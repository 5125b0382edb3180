// One entry of the page's foot: a mark as long as its number says, and the words beside it.
#pragma once

#include <string>

#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

struct ScaleEntry {
  enum class Mark { arrow, dashed_arrow, turn, center_of_mass };
  Mark mark = Mark::arrow;
  double measure = 0;  // units of H; of a turn rad, 0: the ring of a torque that is zero
  Color color;
  std::string text;  // "weight 10 N"
};

// Laid out in one row; `width` of mark, gap and words.
struct EntryLine {
  ScaleEntry entry;
  TextLine text;
  double mark_width = 0, width = 0;
};
EntryLine lay_out_entry(const ScaleEntry& entry, const Fonts& fonts, double text_scale, const Theme& theme);

// `left`: its left end, in the middle of its row.
void draw_entry(Picture& picture, const EntryLine& line, Point left, const Theme& theme);

}  // namespace chainreel
