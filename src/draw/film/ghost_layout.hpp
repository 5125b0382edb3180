// Layout `ghost`: variants of one scene in one place, seen by one camera. The first is drawn as always, the
// others over it in outline, each in a colour of its own. (The layer `ghosts` is another thing: the same
// chain at earlier instants.)
#pragma once

#include <string>
#include <vector>

#include "draw/page/panel_grid.hpp"
#include "draw/page/stage.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// One cell for all, with a row of its own below the scene for each variant that may have a note.
std::vector<PanelCell> ghost_cells(const Rect& area, const PanelRows& rows, const std::vector<StagedRun>& motions);

// Above the scene: what is filled and what is outlined, in rows as wide as the page.
class GhostKey {
 public:
  // Throws Error (bad input) at the place of a title that does not fit in a row of its own.
  GhostKey(const Stage& stage, double width);

  double height() const;  // of all rows
  void draw(Picture& picture, const Rect& rows) const;

 private:
  struct Entry {
    TextLine line;
    Color color, fill;
    bool filled = false;
    double x = 0;  // from the left end
    int row = 0;
  };
  void draw_mark(Picture& picture, const Entry& entry, Point left) const;

  const Theme* theme_;
  double text_size_ = 0;
  int rows_ = 1;
  std::vector<Entry> entries_;
};

}  // namespace chainreel
