#include "draw/film/room.hpp"

namespace chainreel {

Lack lack_of_room(const Composition& composition) {
  const Stage& stage = *composition.stage;
  composition.sheet.panel_titles(stage, composition.view.cells);
  const double word = scaled(kSmallestText, stage.page.text_scale);
  for (const PlotStrip& plot : composition.sheet.plots)
    if (const Rect& box = plot.frame().box; !(box.height() >= kLeastPlot * word)) return {"a plot", box.height()};
    else if (!(box.width() >= kLeastPlotWidth * word)) return {"a plot", box.width(), true};
  for (const PanelCell& cell : composition.view.cells)
    if (!(cell.scene.height() >= kLeastScenes * word)) return {stage.has_cells() ? "a panel" : "the scene", cell.scene.height()};
  return {};
}

}  // namespace chainreel
