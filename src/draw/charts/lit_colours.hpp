// Colours of the curves that a chart shows in colour.
#pragma once

#include <span>

namespace chainreel {

// Looks of curve_style: they stay where their colours differ; one that is like another before it becomes that which is least like all
// others.
void tell_colours_apart(std::span<int* const> looks);

}  // namespace chainreel
