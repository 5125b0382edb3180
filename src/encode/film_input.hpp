// Films that are read back. Only encode includes this.
#pragma once

#include <memory>
#include <string>

#include "encode/libav.hpp"

namespace chainreel {

struct CloseFilmInput {
  void operator()(AVFormatContext* p) const { avformat_close_input(&p); }
};
using FilmInputPtr = std::unique_ptr<AVFormatContext, CloseFilmInput>;

// MP4, MOV or WebM. Throws Error (exit 3) for any other file.
FilmInputPtr open_film(const std::string& path);

}  // namespace chainreel
