// What a GIF says of itself: one comment, a JSON object of texts in ASCII, as the GIF specification (89a,
// section 24) wants comments to be.
#pragma once

#include <string>

#include "encode/frame_sink.hpp"

namespace chainreel {

// Puts the comment in before the end of a whole GIF. Throws Error (exit 6) where the file cannot be written
// again.
void put_gif_comment(const std::string& path, const Tags& tags);
// Nothing where there is no such comment. Throws Error (exit 3) where the file is no GIF.
Tags read_gif_comment(const std::string& path);

}  // namespace chainreel
