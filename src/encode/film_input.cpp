#include "encode/film_input.hpp"

namespace chainreel {

FilmInputPtr open_film(const std::string& path) {
  capture_libav_log();
  AVDictionary* options = nullptr;
  // A file that plays a list must not open others.
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  av_dict_set(&options, "format_whitelist", "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm", 0);
  AVFormatContext* input = nullptr;
  const int code = avformat_open_input(&input, ("file:" + path).c_str(), nullptr, &options);
  av_dict_free(&options);
  check_libav(code, ExitCode::bad_input, "is no film that can be read", path);
  return FilmInputPtr(input);
}

}  // namespace chainreel
