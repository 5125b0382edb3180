#include "encode/film_tags.hpp"

#include <algorithm>
#include <cctype>

#include "encode/film_input.hpp"

namespace chainreel {

Tags read_film_tags(const std::string& path) {
  const FilmInputPtr input = open_film(path);
  Tags tags;
  const AVDictionaryEntry* entry = nullptr;
  while ((entry = av_dict_get(input->metadata, "", entry, AV_DICT_IGNORE_SUFFIX)) != nullptr) {
    std::string name = entry->key;  // WebM writes them in capitals
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    tags[name] = entry->value;
  }
  return tags;
}

}  // namespace chainreel
