#include "core/names.hpp"

#include "core/error.hpp"

namespace chainreel {

std::optional<std::size_t> index_of_name(std::span<const Name> names, std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].name == name) return i;
  return std::nullopt;
}

std::vector<std::string> words_of(std::span<const Name> names) {
  std::vector<std::string> words;
  for (const Name& one : names) words.emplace_back(one.name);
  return words;
}

std::string alternatives(std::span<const Name> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += std::string(i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i].name;
  return text;
}

std::string misnamed(std::span<const Name> names, std::string_view name) {
  const std::string near = did_you_mean(name, words_of(names));
  return "must be " + alternatives(names) + ", not '" + std::string(name) + "'" + (near.empty() ? "" : ":" + near);
}

void refuse_name(std::string_view what, std::span<const Name> names, std::string_view name) {
  throw Error(ExitCode::bad_input, std::string(what) + " " + misnamed(names, name));
}

}  // namespace chainreel
