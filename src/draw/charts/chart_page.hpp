// The page of a chart: what it shows above, how it came about below, and the room between the two.
#pragma once

#include <optional>
#include <string>

#include "draw/page/sheet.hpp"
#include "picture/plot.hpp"

namespace chainreel {

inline constexpr double kMostlyChart = 0.6;
inline constexpr double kLabelGap = 0.045;  // units of H, between the frame and the labels of its curves

struct ChartText {
  std::string title, subtitle;
  std::string footer;  // small, in as many lines as it needs
};

struct ChartLook {
  double aspect = 16.0 / 9.0;
  double text_scale = 1;
  const Theme* theme = nullptr;
  const Fonts* fonts = nullptr;
  std::optional<PageLogo> logo{};
  bool is_on_paper = false;  // whose caption says what notes would, where they leave little room

  PlotStyle plot_style() const { return {fonts, theme, text_scale}; }
};

// An empty page with the chart's words. The title shrinks to its row; subtitle and footer are broken into
// lines, and end beside the logo; on paper footer and subtitle, in this order, are left to its caption where they would leave less
// than kMostlyChart of the page's height. Returns what is left for the axes. Throws Error (exit 3) where the words leave no room.
Rect draw_chart_page(Picture& picture, const ChartText& text, const ChartLook& look);

// On paper: throws Error (exit 3) where the names of so many curves would not stand below one another.
void require_room_for_names(std::size_t curves, const Rect& area, const ChartLook& look);

}  // namespace chainreel
