// What a film says and plots around its scenes, and the room that this leaves them.
#pragma once

#include <optional>
#include <vector>

#include "draw/film/ghost_layout.hpp"
#include "draw/film/plot_strip.hpp"
#include "draw/film/story.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/panel_grid.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {

// From the lower end of a panel's row of words up to its base line, of the em.
inline constexpr double kTitleDescent = 0.40;

struct FilmSheet {
  // `story`: what is plotted where the scene names no plot, see story.hpp. Throws Error (bad input) where the words leave no room.
  FilmSheet(const Stage& stage, const Layers& layers, const Story& story = {}, const PlotRoom& room_given = {});

  Sheet sheet;  // its scene is what is left for all panels
  PlotRoom plot_room;  // that plots were given
  std::vector<PlotStrip> plots;
  std::optional<GhostKey> key;  // of layout `ghost`
  PanelRows rows;               // that panels keep free for words of their own
  bool has_panel_titles = false;
  bool has_plots_beside = false, has_plots_stacked = false;

  // Of the panels' titles in the smallest letters, units of H.
  double widest_title(const Stage& stage) const;
  // The least width of panels in which they stand on two lines, and below them when a run left the picture.
  double narrowest_panel(const Stage& stage) const;
  // Height of the row of titles above panels so wide, of two lines where one has no room; nothing where two have none.
  std::optional<double> row_of_titles(const Stage& stage, double width) const;
  // The titles of panels in cells of their own. Throws Error (bad input) where one does not fit.
  std::vector<PlacedText> panel_titles(const Stage& stage, const std::vector<PanelCell>& cells) const;

 private:
  void lay_out_plots(const Stage& stage, std::vector<StripData> data);
  bool put_time_beside_numbers(const Stage& stage, const std::string& longest_time);
  void align_plots();  // those above one another
};

}  // namespace chainreel
