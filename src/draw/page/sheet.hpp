// The page around the scene: title and torques above, legend, scale and time below, and the room that is left
// between them. Bands grow with text_scale and with the lines that they need, so that nothing is cut or
// overlaps.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/image.hpp"
#include "draw/page/scales.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"
#include "scene/style.hpp"

namespace chainreel {

// Nothing is written smaller than this, in units of H.
inline constexpr double kSmallestText = size::kTick;

inline constexpr double kRoundOff = 1e-12;  // a text that just fills its row fits

// A picture in a corner. The band that it stands in ends before it.
struct PageLogo {
  std::shared_ptr<const Image> image;
  PageCorner corner = PageCorner::top_right;
  double height = 0;  // units of H
  int page_height = 1080;  // px: its sides lie on whole pixels
};

// Where it stands within the margins: in its corner, on whole pixels, not wider than a third of them.
Rect box_of(const PageLogo& logo, const Rect& inside);
bool is_at_top(PageCorner corner);
bool is_at_left(PageCorner corner);
inline constexpr double kBesideLogo = 0.05;  // units of H: words end so far from it

// What a page says. Empty texts are left out, and bands without a text, too.
struct SheetText {
  std::string title;
  std::vector<std::string> torque;  // math notation; the first form that fits is taken
  std::string equation;             // math notation, a line of its own where it does not fit beside others
  std::vector<SymbolColor> symbols;  // of the equation
  std::string longest_time;         // of the running time: room is kept for it at the lower right
  double beside_time = 0;           // units of H that are kept free left of the running time
  std::string bar;                  // beside the scale bar of the ellipse
  double bar_length = 0;            // units of H
  double legend_size = size::kAxis;
  std::string legend;               // may be broken behind ": ", and between words where it must
  std::vector<ScaleEntry> scales;   // of vectors, in rows above or beside the time
  bool with_panel_titles = false;   // where several panels share the page each has one of its own
  std::optional<PageLogo> logo;
  Place title_place;                // for the message about a title that does not fit
};

struct PlacedText {
  TextLine line;
  Point anchor;
};

struct PlacedEntry {
  EntryLine line;
  Point left;
};

struct Sheet {
  double aspect = 16.0 / 9.0;
  double text_scale = 1;
  const Theme* theme = nullptr;
  Rect scene;  // what is left for the chain
  std::vector<PlacedText> texts;
  std::optional<Point> bar;  // left end of the scale bar
  double bar_length = 0;
  std::vector<PlacedEntry> scales;
  std::optional<PageLogo> logo;
  Rect logo_box;
  Point time_anchor;  // right end of its base line
  Point time_left;    // ... and where what stands beside it ends
};

// `height`: of a page whose unit is not its own height; `aspect` is then its width in that unit.
Sheet lay_out_sheet(const SheetText& text, double aspect, double text_scale, const Theme& theme,
                    const Fonts& fonts, double height = 1);

// Everything on the sheet but the running time.
void draw_sheet(Picture& picture, const Sheet& sheet);
void draw_time(Picture& picture, const Sheet& sheet, double t, const Fonts& fonts, int decimals = 2);

// "t = 1.24 s"
std::string time_text(double t, int decimals = 2);

// The line at its style's size, or smaller where it is wider than `width`, down to the smallest size times
// text_scale. The caller looks whether it fits now.
TextLine fit_text(const Fonts& fonts, const std::string& text, TextStyle style, double width,
                  double text_scale);
// The same of words with formulas between dollar signs.
TextLine fit_words(const Fonts& fonts, const std::string& words, TextStyle style, double width, double text_scale);
// The same for the first of several math notations that can be read and fits.
TextLine fit_math(const Fonts& fonts, const std::vector<std::string>& forms, TextStyle style, double width,
                  double text_scale, const std::vector<SymbolColor>& symbols = {});

}  // namespace chainreel
