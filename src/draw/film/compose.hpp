// A film's page at its size in pixels: words that can be read, and a scene that has room.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "draw/film/film_sheet.hpp"
#include "draw/film/film_view.hpp"
#include "draw/layers/layer.hpp"

namespace chainreel {

// No word of a film is lower than this, but the scripts of formulas, down to pages 270 px high.
inline constexpr double kLeastWordPixels = 9;
inline constexpr int kLeastPagePixels = 270;

// The same in units of H; on paper what the page says.
double least_word(const Video& video);

// The text_scale at which a page is drawn: the scene's, smaller by the width of pages higher than wide, and no less than
// what makes the smallest word as high as that.
double text_scale_of_page(const Scene& page);

struct Composition {
  std::unique_ptr<const Stage> stage;
  Layers layers;
  FilmSheet sheet;
  FilmView view;
  std::vector<std::string> left_out;  // layers that the page is too small for
  std::vector<std::string> given;     // ... and those whose rows low panels take
  double held_text_scale = 0;  // that words have where plots and scene have no room beside those that are asked for; 0: as asked
};

// Where words had to be enlarged, layers go one after the other, in the order equation, torque_label, legend, mass_matrix,
// scale_bar, as long as the words leave less than kLeastScene of the page's height to the scene, or do not fit. Throws Error as
// Stage and FilmSheet do.
//
// With layout `auto` a plot stands beside the scene, else below it, where the motion keeps kLeastKept of its size and no further
// layer goes: the scene's only plot, or the story that it has (draw/film/story).
// On narrow pages names of the legend that tell no scale go before the plot. The plot of a grid of panels stands in the cell that these would leave
// empty, or in one of a grid in which they are larger by a tenth. Where words had to be enlarged, panels lower than two fifths of the page
// take the rows of equation and torque_label above them.
// In layout `compare` plots stand beside the panels of a motion that is at most half as wide as high, where these are no smaller for it, and of others
// where they are larger by three tenths.
// Comparisons have theirs on pages that are narrow, and those that lie over one another on all, where it costs next to nothing; those
// of methods, which look alike, where kLeastKeptOfMethods is kept.
//
// Words of a text_scale above 1 take their room from the scene, not from the plots: a frame keeps nine tenths of its area. Where the
// scene would then keep less than two fifths of its size words are as large as leaves it that.
inline constexpr double kLeastScene = 0.45;
// A motion so narrow that it leaves half of a narrow page empty gives its plot more: kLeastKeptOfNarrow.
inline constexpr double kLeastKept = 0.8, kLeastKeptOfPanels = 0.95, kLeastKeptOfMethods = 0.4, kLeastKeptOfNarrow = 0.6;
inline constexpr double kLeastKeptStacked = 0.75;  // pages that have plots above one another have height to spare
Composition compose(const Scene& page, const std::vector<PanelRun>& runs, const std::vector<double>& times, const Fonts& fonts,
                    const FilmClock& clock);

}  // namespace chainreel
