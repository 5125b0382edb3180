// How a film begins: its first frame, as a still that stands for the film, and its measures.
#pragma once

#include <string>

#include "core/image.hpp"

namespace chainreel {

struct FilmStart {
  int width = 0, height = 0;  // of the film, pixels
  double seconds = 0;         // of the film
  Image frame;                // opaque, scaled down to at most the width that was asked for
};

// Of MP4, MOV or WebM. Throws Error (exit 3) where the file is no such film or its first frame cannot be
// decoded.
FilmStart read_film_start(const std::string& path, int widest);

}  // namespace chainreel
