#include "encode/film_tags.hpp"

#include <algorithm>
#include <cctype>

#include "encode/libav.hpp"

namespace chainreel {

Tags read_film_tags(const std::string& path) {
  capture_libav_log();
  AVDictionary* options = nullptr;
  // A file that plays a list must not open others.
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  av_dict_set(&options, "format_whitelist", "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm", 0);
  AVFormatContext* input = nullptr;
  const int code = avformat_open_input(&input, ("file:" + path).c_str(), nullptr, &options);
  av_dict_free(&options);
  check_libav(code, ExitCode::bad_input, "is no film that can be read", path);
  Tags tags;
  const AVDictionaryEntry* entry = nullptr;
  while ((entry = av_dict_get(input->metadata, "", entry, AV_DICT_IGNORE_SUFFIX)) != nullptr) {
    std::string name = entry->key;  // WebM writes them in capitals
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    tags[name] = entry->value;
  }
  avformat_close_input(&input);
  return tags;
}

}  // namespace chainreel
