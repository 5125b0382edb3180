// Colours for pixels that nobody sees.
#pragma once

#include "core/image.hpp"

namespace chainreel {

// Each fully transparent pixel takes the mean colour, weighed by opacity, of the smallest block of 2, 4, ..
// 64 pixels a side around it that shows anything. Codecs that blur then mix edges with their own colour, not
// with black. Opacity stays as it is.
void bleed_colors(Image& image);

}  // namespace chainreel
