// The quantity that tells what a motion is about, for scenes that name no plot.
#pragma once

#include <vector>

#include "draw/page/stage.hpp"
#include "sim/plots.hpp"

namespace chainreel {

// Whether panels beside one another show one motion, by several methods or steps.
bool differ_in_method_alone(const Stage& stage);

// Its curves along the run: what is wrong with the energy where panels differ in their method alone, lambda under constraints, tau of feedback and of torques that change, the driven coordinates
// of springs, else the energies; of several runs the same of each. Of one run that shows the ellipse what its axes measure. Empty where there is
// none to tell: of a single frame, of motions that no simulation is known of, on pages without words, of comparisons and sections with an ellipse, and
// where the picture itself shows M(q), unless it `is_asked` for.
// A list for each motion, all of one length; empty where there is nothing to tell.
using Story = std::vector<std::vector<PlotCurves>>;
Story story_of(const Stage& stage, bool is_asked = false);

}  // namespace chainreel
