// Films as files that are read back. Only encode includes this.
#pragma once

#include <memory>
#include <string>

#include "encode/libav.hpp"

namespace chainreel {

struct CloseFilmInput {
  void operator()(AVFormatContext* p) const { libav().avformat_close_input(&p); }
};
using FilmInputPtr = std::unique_ptr<AVFormatContext, CloseFilmInput>;

enum class FilmKinds { films, films_and_small_clips };

// MP4, MOV or WebM; of small clips also GIF and APNG. Throws Error (exit 3) for any other file.
FilmInputPtr open_film(const std::string& path, FilmKinds kinds = FilmKinds::films);

}  // namespace chainreel
