// Where the letters of a picture really are: outlines of the font files, read by FreeType, not by the
// layout's boxes.
#pragma once

#include <vector>

#include "picture/picture.hpp"
#include "picture/text.hpp"

namespace chainreel::test {

struct Written {
  GlyphRun run;
  Rect ink;          // of its letters, units of H; spaces have none
  int clip = -1;     // of the picture
  std::size_t item;  // of the picture
};

// Every run of the picture that leaves ink.
std::vector<Written> written_on(const Picture& picture, const Fonts& fonts);

}  // namespace chainreel::test
