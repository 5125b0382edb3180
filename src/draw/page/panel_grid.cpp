#include "draw/page/panel_grid.hpp"

#include <algorithm>

namespace chainreel {
namespace {

// Marks have their full size in a panel of this height and shrink with it, down to a limit.
constexpr double kFullPanel = 0.6, kSmallestMarks = 0.45;
constexpr double kWorthOfFull = 1.5;   // a grid without an empty cell is taken up to that much smaller
constexpr double kSmallestSide = 0.06;  // of a panel that shows anything

}  // namespace

bool is_large_enough(const Rect& scene) {
  return std::min(scene.width(), scene.height()) > kSmallestSide;
}

std::vector<PanelCell> panel_cells(const Rect& area, int count, int columns, const PanelRows& rows) {
  const int lines = (count + columns - 1) / columns;
  const double width = (area.width() - (columns - 1) * size::kGutter) / columns;
  const double height = (area.height() - (lines - 1) * size::kGutter) / lines;
  std::vector<PanelCell> cells;
  for (int i = 0; i < count; ++i) {
    const int line = i / columns, column = i % columns;
    const double x0 = area.x0 + column * (width + size::kGutter);
    const double y1 = area.y1 - line * (height + size::kGutter);
    // At the edges exactly those of the area, so that one panel is the area to the last bit.
    const double x1 = column + 1 == columns ? area.x1 : x0 + width;
    const double y0 = line + 1 == lines ? area.y0 : y1 - height;
    cells.push_back({{x0, y1 - rows.title, x1, y1},
                     {x0, y0 + rows.note, x1, y1 - rows.title},
                     {x0, y0, x1, y0 + rows.note}});
  }
  return cells;
}

std::vector<PanelCell> best_cells(const Rect& area, int count, const PanelRows& rows, const FitBox& box, double least_width, bool keeps_width, bool is_full) {
  std::vector<PanelCell> best;
  double best_worth = 0;
  for (int lines = 1; lines <= count; ++lines) {
    const int columns = (count + lines - 1) / lines;  // as few as these lines allow: no line is nearly empty
    if ((lines - 1) * columns >= count) continue;     // a line would stay empty
    if (is_full && lines * columns != count) continue;
    std::vector<PanelCell> cells = panel_cells(area, count, columns, rows);
    if (!is_large_enough(cells[0].scene)) continue;
    if (keeps_width && columns > 1 && cells[0].scene.width() < least_width) continue;
    Camera camera;
    fit_to(camera, box, cells[0].scene, size::kFitMargin);
    const bool has_no_gap = lines * columns == count && cells[0].scene.width() >= least_width;
    const double worth = (has_no_gap ? kWorthOfFull : 1) * camera.scale;
    if (worth > best_worth) {
      best_worth = worth;
      best = std::move(cells);
    }
  }
  return best;
}

double marks_in(const Rect& scene) {
  return std::clamp(std::min(scene.width(), scene.height()) / kFullPanel, kSmallestMarks, 1.0);
}

double marks_in(const std::vector<PanelCell>& cells) {
  if (cells.size() == 1) return 1;
  return marks_in(cells[0].scene);
}

}  // namespace chainreel
