// Shapes as SVG with selectable text.
//
// Text is <text> with a position for every character; each face is embedded as the part of it that the page
// uses, so a browser shows the very glyphs of the other outputs. Programs that read no embedded fonts
// (librsvg, Inkscape) take the family behind it: DejaVu Sans, Latin Modern Math.
#pragma once

#include <string>

#include "picture/text.hpp"
#include "render/vector_shapes.hpp"

namespace chainreel {

std::string svg_text(const Picture& picture, const Fonts& fonts, const VectorPage& page);

}  // namespace chainreel
