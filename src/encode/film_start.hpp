// One frame of a film, as a still that stands for it, and its measures.
#pragma once

#include <string>

#include "core/image.hpp"
#include "encode/frame_sink.hpp"

namespace chainreel {

struct FilmStart {
  int width = 0, height = 0;  // of the film, pixels
  double seconds = 0;         // of the film
  std::string container;      // what the file holds, whatever its name: "mov,mp4,m4a,3gp,3g2,mj2", "matroska,webm", "gif", "apng"
  Image frame;                // opaque, scaled down to at most the width that was asked for
};

// The frame that is shown `at` seconds from the start on, or the last one. Reads MP4, MOV, WebM, GIF or APNG. Throws Error (exit 3)
// where the file is no such film or the frame cannot be decoded.
FilmStart read_film_start(const std::string& path, int widest, double at = 0);

// What a film says of itself, read from MP4, MOV and WebM.

// Names in lower case. Throws Error (exit 3) where the file is no film of these kinds.
Tags read_film_tags(const std::string& path);

}  // namespace chainreel
