// An SVG file as pixels, by librsvg, which is opened when the first one is read.
#pragma once

#include <string>

#include "core/image.hpp"

namespace chainreel {

// `height` px high, on nothing. What lies in other files is not read. Throws Error: exit 3 where `bytes` are no SVG with a
// size (`path` is named), exit 4 where librsvg is not there.
Image svg_image(const std::string& bytes, const std::string& path, int height);

}  // namespace chainreel
