// The quantity that tells what a motion is about, for scenes that name no plot.
#pragma once

#include <vector>

#include "draw/page/stage.hpp"
#include "sim/plots.hpp"

namespace chainreel {

// Its curves along the run: lambda under constraints, tau of feedback and of torques that change, the driven coordinates
// of springs, else the energies. Empty where there is none to tell: of several runs, of a single frame, of motions that no
// simulation is known of, on pages without words, and where the picture itself shows masses (ellipse, mass_matrix).
std::vector<PlotCurves> story_of(const Stage& stage);

}  // namespace chainreel
