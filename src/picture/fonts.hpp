// What pages carry of fonts: a file with the glyphs of a few characters alone, or the edges of glyphs.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "picture/text.hpp"

namespace chainreel {

// The bytes of the file: TrueType or OpenType as the face is. Throws Error (exit 4) where HarfBuzz gives up.
std::string font_subset(const Fonts& fonts, Face face, const std::set<char32_t>& characters);

// The edge of a glyph in ems, as FreeType tells it: M (move), L (line), Q and C (curves with one and two points between), Z (close).
struct OutlinePiece {
  char kind = 'Z';
  int count = 0;
  std::array<Point, 3> points{};
};
std::vector<OutlinePiece> outline_of(const Fonts& fonts, Face face, std::uint32_t glyph);

}  // namespace chainreel
