// What the page says of the layers that a scene names: scales of vectors, and the equation of motion.
#pragma once

#include <string>
#include <vector>

#include "draw/acting.hpp"
#include "draw/scale_entry.hpp"

namespace chainreel {

// One entry a kind of vector that is shown, each with a mark of 1, 2 or 5 x 10^n: the scale is printed
// whenever the layer is on. `named`: the legend is on, and says what each one is.
std::vector<ScaleEntry> scale_entries(const VectorScales& scales, const std::vector<VectorKind>& shown,
                                      bool named, const Theme& theme);

// The kinds that these layers show of this chain.
std::vector<VectorKind> kinds_shown(const Chain& chain, const ActingLayers& layers);

// "M(q) qdd + h(q, qd) = tau", with the multipliers' term where there are constraints.
std::string equation_of_motion(bool constrained);
// tau and lambda take the colours of their vectors where those are shown.
std::vector<SymbolColor> equation_colors(const ActingLayers& layers, const Theme& theme);

}  // namespace chainreel
