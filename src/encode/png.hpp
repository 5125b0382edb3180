// PNG by libpng: 8-bit RGBA, or RGB where every pixel is opaque; text chunks for what the picture should remember.
#pragma once

#include <map>
#include <string>

#include "core/image.hpp"

namespace chainreel {

void write_png(const std::string& path, const Image& image, const std::map<std::string, std::string>& text = {});
Image read_png(const std::string& path);  // throws Error (exit 3)

}  // namespace chainreel
