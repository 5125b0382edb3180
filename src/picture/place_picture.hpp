// A whole page, drawn small on another one.
#pragma once

#include "picture/picture.hpp"

namespace chainreel {

struct Placing {
  Rect cell;                 // of the larger page: the small one fills it both ways or one, in its middle
  double thinnest_line = 0;  // units of the larger page's H: lines become no thinner
  double smallest_text = 0;  // ... em: words that became smaller could not be read and are left out,
                             // with the plates below them
  double margin = 0;         // units of the small page's H: cut off on all sides
};

// Everything of `page` but its background, cut at its edges.
void place_picture(Picture& target, const Picture& page, const Placing& placing);

// A picture that was drawn `height` units high, as the page 1 high that pictures are.
Picture in_page_units(const Picture& picture, double height);

}  // namespace chainreel
