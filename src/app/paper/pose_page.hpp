// Figures of poses on paper: how high their page is, and how many panels stand beside one another.
#pragma once

#include <vector>

#include "app/paper/paper.hpp"
#include "draw/figures/poses.hpp"

namespace chainreel {

void set_page(PoseFigureOptions& figure, const PaperPage& page, double text_scale);

// On a page of the width that is asked for. As high as is asked for, too; else as shows the poses best: every word whole and the masses below
// each, then chains and ellipses as large as so much paper allows. Throws Error (usage) of too many pixels.
void put_on_paper(PoseFigureOptions& figure, const PaperOptions& paper, const TipMass& tip, const std::vector<std::vector<double>>& poses,
                  const Fonts& fonts);

// A row of panels in pixels: no higher than they need, with words as large as on a slide of that width.
void cut_row(PoseFigureOptions& figure, const TipMass& tip, const std::vector<std::vector<double>>& poses, const Fonts& fonts);

}  // namespace chainreel
