// Where the panels of a film lie, and the one camera that sees all of them.
#pragma once

#include <optional>
#include <vector>

#include "draw/film/film_sheet.hpp"
#include "draw/layers/layer.hpp"
#include "draw/page/panel_grid.hpp"

namespace chainreel {

inline constexpr double kBarInset = 0.014;  // of what stands in a corner of a panel from its frame

// What the camera holds, and what it holds as far as that costs little.
struct ViewBoxes {
  FitBox must, wishes;
};

struct FilmView {
  // Throws Error (bad input) where there is no room for the panels, or for what stands beside their scenes.
  FilmView(const Stage& stage, const Layers& layers, const FilmSheet& sheet);

  Camera camera;  // of the first panel
  std::vector<PanelCell> cells;
  double marks = 1;  // size of marks, as in ChainLook
  ArrowShares arrows;  // of the lengths they were laid out with: so that they stay in the scenes

  // Of a panel's scene the part, units of H, that the fitted motion with its margins is wide, and high.
  Point size_used() const;
  // All panels see the same part of the world at the same place of their cells.
  Camera camera_of(std::size_t panel) const;
  // Lower left of the room that a layer asked for in or beside the scene of a panel.
  Point corner(std::size_t layer, std::size_t panel) const { return corners_[layer][panel]; }
  // What a layer has for itself of a panel's scene.
  const std::optional<Rect>& room(std::size_t panel) const { return rooms_[panel]; }
  SharedPage shared_page(const Stage& stage, const FilmSheet& sheet) const;

 private:
  void place_camera(const Stage& stage, const Layers& layers, const FilmSheet& sheet);
  void place_rooms(const Stage& stage, const Layers& layers);
  void shorten_arrows(const Stage& stage, const Layers& layers);

  ViewBoxes boxes_;
  double row_below_ = 0;  // units of H, that layers keep for themselves below all scenes
  std::vector<std::vector<Point>> corners_;  // by layer and panel
  std::vector<std::optional<Rect>> rooms_;   // by panel
};

}  // namespace chainreel
