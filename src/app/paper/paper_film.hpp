// A film's page on paper: as high as its plots and panels need beside words of 7 pt.
#pragma once

#include "app/film/prepared.hpp"
#include "app/paper/paper.hpp"
#include "picture/text.hpp"

namespace chainreel {

// Gives the film's page its size. Without --height-mm that is the film's shape, or, where plots or panels would be too small so,
// the first higher page on which they are not, up to kHighestPage times as high as wide; a note says that. With --height-mm a
// note says what is too small. Throws Error (bad input) that names the least --width-mm where no height gives room.
inline constexpr double kHighestPage = 2.5;
void set_paper_page(PreparedFilm& film, const PaperOptions& options, const Fonts& fonts, bool quiet);

}  // namespace chainreel
