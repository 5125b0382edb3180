// What of a picture lies in a part of it, in words.
#pragma once

#include <string>

#include "core/pixel_box.hpp"
#include "picture/picture.hpp"

namespace chainreel {

// "the text 't = 1.2 s', an arc"; "nothing but the background". `box` in pixels of a picture that is `height`
// high.
std::string shapes_there(const Picture& picture, int height, const PixelBox& box);

}  // namespace chainreel
