// What lengths on the page are worth: entries of its foot, each a mark as long as its number says and the words
// beside it, and bars.
#pragma once

#include <string>

#include "picture/camera.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

struct Sheet;

struct ScaleEntry {
  enum class Mark { arrow, dashed_arrow, turn, damper, center_of_mass, disc };
  Mark mark = Mark::arrow;
  double measure = 0;  // units of H, of a disc its diameter; of a turn rad
  Color color;
  std::string text;  // "weight 10 N"
  int order = 0;     // entries stand by it, from left to right
};
// Entries behind those of vectors, and behind all that have a measure.
inline constexpr int kAfterVectors = 1000, kAfterScales = 2000;

// Laid out in one row; `width` of mark, gap and words.
struct EntryLine {
  ScaleEntry entry;
  TextLine text;
  double mark_width = 0, width = 0;
};
EntryLine lay_out_entry(const ScaleEntry& entry, const Fonts& fonts, double text_scale, const Theme& theme);

// `left`: its left end, in the middle of its row.
void draw_entry(Picture& picture, const EntryLine& line, Point left, const Theme& theme);

// The largest of 1, 2, 5 x 10^n that is not above `most`: what a scale bar may measure.
double round_length(double most);

// A bar with end ticks, `at` its left end.
void draw_scale_bar(Picture& picture, Point at, double length, Color color, int clip = -1);

// The largest of 1, 2, 5 x 10^n m that measures at most a quarter of the scene's width.
double metre_bar_length(double scale, double scene_width);

// The scale of lengths: a bar at the lower left inside the scene.
// How much of the lower edge of a scene it takes, units of H.
double metre_bar_row(double text_scale);
void draw_metre_bar(Picture& picture, const Camera& camera, const Sheet& sheet, const Fonts& fonts);

}  // namespace chainreel
