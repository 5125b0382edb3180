// A font file with the glyphs of a few characters alone, to be carried inside of a page.
#pragma once

#include <set>
#include <string>

#include "picture/text.hpp"

namespace chainreel {

// The bytes of the file: TrueType or OpenType as the face is. Throws Error (exit 4) where HarfBuzz gives up.
std::string font_subset(const Fonts& fonts, Face face, const std::set<char32_t>& characters);

}  // namespace chainreel
