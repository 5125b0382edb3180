// What a film says of itself, read from MP4, MOV and WebM.
#pragma once

#include <string>

#include "encode/frame_sink.hpp"

namespace chainreel {

// Names in lower case. Throws Error (exit 3) where the file is no film of these kinds.
Tags read_film_tags(const std::string& path);

}  // namespace chainreel
