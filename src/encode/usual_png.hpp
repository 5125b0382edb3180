// Fast reading of the PNG files that there usually are: eight bits a channel, RGB or RGBA, not interlaced, in
// sRGB.
#pragma once

#include <optional>
#include <string_view>

#include "core/image.hpp"

namespace chainreel {

// The picture; nothing where the file is of another kind, or where anything about it is not in order: libpng
// reads the others, and says what is wrong. Checksums are checked.
std::optional<Image> decode_usual_png(std::string_view bytes);

}  // namespace chainreel
