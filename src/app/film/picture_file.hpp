// One picture as pixels, and as a file.
#pragma once

#include <string>

#include "app/film/clip_memory.hpp"
#include "app/film/formats.hpp"
#include "core/image.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"

namespace chainreel {

// One picture as pixels.
Image rasterise(const Picture& picture, int width, int height, const Fonts& fonts);
// Throws Error (usage) unless the path's ending is a picture's.
const OutputFormat& picture_format_of(const std::string& path);
// ... and as a file that appears whole or not at all: .png, .svg or .pdf. Vector pages have the proportions of the
// pixels, and a height that suits a sheet of paper.
void write_picture(const Picture& picture, int width, int height, const Fonts& fonts, const std::string& path,
                   bool overwrite, const ClipMemory& memory = {});

}  // namespace chainreel
