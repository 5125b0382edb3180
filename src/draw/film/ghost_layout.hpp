// Layout `ghost`: variants of one scene in one place, seen by one camera. The first is drawn as always, the
// others over it in outline, each in a colour of its own. (The layer `ghosts` is another thing: the same
// chain at earlier instants.)
#pragma once

#include <string>
#include <vector>

#include "draw/film/panel.hpp"
#include "draw/page/panel_grid.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

// Outlines of links lie this far outside the edges of filled ones, units of H.
inline constexpr double kOutlineAway = 1.4 * size::kLinkOutline;

bool is_ghost_layout(const Scene& page);

// What is drawn of a variant over the first: its chain and its trail.
Layers outline_layers(const Layers& layers);

// Of variant i of `count`: the colours that their plots have, too.
Color variant_color(int i, int count, const Theme& theme);
// "B", "C", ... where there are several outlines to be told apart; "" else.
std::string variant_letter(int i, int count);

// One cell for all, with a row of its own below the scene for each variant that may have a note.
std::vector<PanelCell> ghost_cells(const Rect& area, const PanelRows& rows, const std::vector<Panel>& panels);

// Above the scene: what is filled and what is outlined, in rows as wide as the page.
class GhostKey {
 public:
  // Throws Error (bad input) at the place of a title that does not fit in a row of its own.
  GhostKey(const std::vector<Panel>& panels, double width, double text_scale, const Theme& theme,
           const Fonts& fonts);

  double height() const;  // of all rows
  void draw(Picture& picture, const Rect& rows) const;

 private:
  struct Entry {
    TextLine line;
    Color color;
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
