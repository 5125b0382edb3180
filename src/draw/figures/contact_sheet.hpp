// Many pictures on one page, a title below each.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

inline constexpr int kMostCells = 48;
// Of each picture. Where the page has room above and below, pictures are as tall as the second.
inline constexpr double kCellAspect = 16.0 / 9.0, kTallestCell = 4.0 / 3.0;

struct ContactSheetLook {
  double aspect = 16.0 / 9.0;
  int columns = 0;  // 0: as many as make the pictures largest
  std::string title{};  // above all; "": none. It may have formulas between dollar signs, as those of cells
  double text_scale = 1;
  double least_text = size::kTick;  // units of H: no word is lower; of a page of paper less
  const Theme* theme = &light_theme();
  const Fonts* fonts = nullptr;
  int title_lines = 0;  // of the longest caption, if it needs more than are usual
  bool is_paper = false;

  double words_of(double size) const { return text_scale < 1 ? std::max(size * text_scale, least_text) : scaled(size, text_scale); }
};

// Where the cells lie: pictures row by row from the top, below each the room for its title.
struct ContactGrid {
  int columns = 1, lines = 1;
  double text_size = 0;      // of titles, units of H
  double smallest_text = 0;  // of all words
  int title_lines = 2;
  std::vector<Rect> pictures, titles;

  // The smallest words in units of the height of the page that a picture is drawn on.
  double smallest_in_cell() const { return smallest_text * (1 - 2 * size::kMargin) / pictures.front().height(); }

  // Of the page that a picture is drawn on, which is larger: its outer margin is cut off.
  double page_aspect() const {
    const Rect& cell = pictures.front();
    return cell.width() / cell.height() * (1 - 2 * size::kMargin) + 2 * size::kMargin;
  }
};

// Throws Error (usage) where that many cells leave nothing to see: more than kMostCells, or too many columns.
ContactGrid contact_grid(int count, const ContactSheetLook& look);

// The text_scale at which the words inside a picture of this grid can be read; next to nothing where they
// would hide what they name, and then they are left out.
double text_scale_in(const ContactGrid& grid);

struct ContactCell {
  Picture picture;  // of the grid's page_aspect
  std::string title;
};
// How many lines the longest title takes.
int title_lines_of(const ContactGrid& grid, std::span<const ContactCell> cells, const ContactSheetLook& look);
// One cell a place of the grid. Titles are broken into lines at spaces; what does not fit ends in "...".
Picture draw_contact_sheet(const ContactGrid& grid, std::span<const ContactCell> cells,
                           const ContactSheetLook& look);

}  // namespace chainreel
