#include "encode/film_input.hpp"

#include <fstream>
#include <string>

namespace chainreel {
namespace {

bool is_png(const std::string& path) {
  const std::string signature = "\x89PNG\r\n\x1a\n";
  std::string begin(signature.size(), '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), std::streamsize(begin.size()));
  return begin == signature;
}

}  // namespace

FilmInputPtr open_film(const std::string& path, FilmKinds kinds) {
  capture_libav_log();
  AVDictionary* options = nullptr;
  // A file that plays a list must not open others.
  libav().av_dict_set(&options, "protocol_whitelist", "file", 0);
  std::string formats = "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm";
  if (kinds == FilmKinds::films_and_small_clips) formats += ",gif,apng";
  libav().av_dict_set(&options, "format_whitelist", formats.c_str(), 0);
  AVFormatContext* input = nullptr;
  // Long texts before its first picture hide from those who look at a file's begin alone that an APNG moves.
  const AVInputFormat* told = path.ends_with(".apng") && is_png(path) ? libav().av_find_input_format("apng") : nullptr;
  const int code = libav().avformat_open_input(&input, ("file:" + path).c_str(), told, &options);
  libav().av_dict_free(&options);
  check_libav(code, ExitCode::bad_input, "is no film that can be read", path);
  return FilmInputPtr(input);
}

}  // namespace chainreel
