#include "encode/film_start.hpp"

#include <algorithm>
#include <cctype>

#include "encode/film_input.hpp"
#include "encode/film_reader.hpp"

namespace chainreel {

FilmStart read_film_start(const std::string& path, int widest, double at) {
  FilmReader reader(path);
  FilmStart start;
  if (!reader.find(at, start.frame, widest)) throw Error(ExitCode::bad_input, "holds no frame that can be decoded", {path});
  for (std::size_t i = 3; i < start.frame.bgra.size(); i += 4) start.frame.bgra[i] = 255;
  start.width = reader.width();
  start.height = reader.height();
  start.seconds = reader.seconds();
  start.container = reader.container();
  return start;
}

Tags read_film_tags(const std::string& path) {
  const FilmInputPtr input = open_film(path);
  Tags tags;
  const AVDictionaryEntry* entry = nullptr;
  while ((entry = libav().av_dict_get(input->metadata, "", entry, AV_DICT_IGNORE_SUFFIX)) != nullptr) {
    std::string name = entry->key;  // WebM writes them in capitals
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    tags[name] = entry->value;
  }
  return tags;
}

}  // namespace chainreel
