// The page of a chart: what it shows above, how it came about below, and the room between the two.
#pragma once

#include <optional>
#include <string>

#include "draw/page/sheet.hpp"
#include "picture/plot.hpp"

namespace chainreel {

inline constexpr double kMostlyChart = 0.6, kWholeChart = 0.8;
inline constexpr double kLabelGap = 0.045;  // units of H, between the frame and the labels of its curves

struct ChartText {
  std::string title, subtitle;
  std::string footer;  // small, in as many lines as it needs
  std::string needed{};   // what stands in the footer's place where that has no room
  std::string warning{};  // below the subtitle, in bold; never left out
  bool is_in_caption = false;  // what the title says, too: on small pages it goes where the chart would have less than kWholeChart
};

struct ChartLook {
  double aspect = 16.0 / 9.0;
  double text_scale = 1;
  const Theme* theme = nullptr;
  const Fonts* fonts = nullptr;
  std::optional<PageLogo> logo{};
  bool is_small = false;  // paper, whose caption says what notes would, or few pixels: where they leave little room

  double height = 1;  // of the page, in units in which it is laid out: those of a slide as wide, where it is higher than that

  double width() const { return aspect * height; }
  PlotStyle plot_style() const { return {fonts, theme, text_scale}; }
};

// A picture that was laid out in units of the look, as the page that pictures are.
Picture as_page(const Picture& picture, const ChartLook& look);

// An empty page with the chart's words. The title shrinks to its row; subtitle and footer are broken into
// lines, and end beside the logo; on small ones footer and subtitle, in this order, are left out where they would leave less
// than kMostlyChart of the page's height, but for what is needed. Returns what is left for the axes. Throws Error (exit 3) where the words leave no room.
Rect draw_chart_page(Picture& picture, const ChartText& text, const ChartLook& look);

// Throws Error (exit 3) where what stands beside axes leaves them no room.
void require_room_for_axes(const PlotFrame& frame, const ChartLook& look);

// On small pages: throws Error (exit 3) where the names of so many curves would not stand below one another.
void require_room_for_names(std::size_t curves, const Rect& area, const ChartLook& look);

}  // namespace chainreel
