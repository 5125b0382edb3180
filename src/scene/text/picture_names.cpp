#include "scene/text/picture_names.hpp"

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kLongestName = 200;  // bytes: file systems take 255, and endings are put behind it

bool stays(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-' || c == '+' ||
         (c & 0x80) != 0;
}

std::string in_small_letters(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return name;
}

std::string where(const Place& place) {
  if (place.line > 0) return place.file + " line " + std::to_string(place.line);
  return place.file;
}

}  // namespace

NamedText named_text(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return {"", text};
  if (equals == 0) throw Error(ExitCode::usage, "'" + text + "' has no name in front of the =");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::string file_name_of(const std::string& name) {
  std::string fit = printable(name);  // bytes that are no text are written out
  for (char& c : fit)
    if (!stays(c)) c = '_';
  if (fit.empty()) return "_";
  if (fit.front() == '.' || fit.front() == '-') fit.front() = '_';
  return fit;
}

void PictureNames::add(const std::string& name, const Place& place, ProblemList& problems) {
  if (name.size() > kLongestName)
    problems.add("the picture '" + shortened(name, 40) + "' has a name of more than " +
                     std::to_string(kLongestName) + " characters, too long for a file: shorten it",
                 place);
  const auto [known, is_new] = given_.emplace(in_small_letters(name), Given{name, place});
  if (is_new) return;
  const Given& first = known->second;
  const std::string same = first.name == name
                               ? "two pictures are named '" + name + "'"
                               : "the pictures '" + first.name + "' and '" + name +
                                     "' differ in capitals alone, which are one file to many file systems";
  problems.add(same + ": the other was named at " + where(first.place) + "; give each its own name", place);
}

}  // namespace chainreel
