// Panels of equal size in rows, each with a row for its title above and one for a note below its scene.
#pragma once

#include <vector>

#include "draw/page/sheet.hpp"
#include "draw/robot/fit.hpp"

namespace chainreel {

struct PanelCell {
  Rect title;  // empty where panels have none
  Rect scene;
  Rect note;
};

// What every cell keeps free around its scene, units of H.
struct PanelRows {
  double title = 0;
  double note = 0;
};

// Row by row from the top, `columns` in a row.
std::vector<PanelCell> panel_cells(const Rect& area, int count, int columns, const PanelRows& rows);

// The arrangement in which what is in `box`, the same for all panels, is largest; one without empty cells is taken where it is
// nearly as large and its panels are at least `least_width` wide. With `keeps_width` narrower ones stand alone in their
// lines or not at all; with `is_full` no arrangement has an empty cell.
std::vector<PanelCell> best_cells(const Rect& area, int count, const PanelRows& rows, const FitBox& box, double least_width = 0,
                                  bool keeps_width = false, bool is_full = false);

// Whether a panel whose scene has this part of the page shows anything.
bool is_large_enough(const Rect& scene);

// Size of the marks of joints and ground in a panel this large, or in one of these: 1 for one that fills the page.
double marks_in(const Rect& scene);
double marks_in(const std::vector<PanelCell>& cells);

}  // namespace chainreel
