#include "app/gallery/gallery_pictures.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/film/clip_memory.hpp"
#include "app/film/clip_origin.hpp"
#include "app/film/formats.hpp"
#include "app/gallery/gallery_clips.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "encode/png.hpp"
#include "picture/formula_words.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestPicture = 50'000'000;  // bytes

bool is_shown(const OutputFormat& row) {
  return row.shows == Shows::still && *row.browser_type != 0;
}

// The first of the forms in which a picture is there and browsers show it: drawn.png of drawn.pdf; "" where there is none.
std::string shown_form(const std::string& path) {
  std::error_code code;
  for (const OutputFormat& row : output_formats()) {
    if (!is_shown(row)) continue;
    const std::string form = lower_case_ending(path) == row.ending ? path : fs::path(path).replace_extension(row.ending).string();
    if (fs::exists(form, code)) return form;
  }
  return "";
}

bool remembers(const std::string& path) {
  try {
    recall(path);
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::vector<std::string> films_of(const fs::path& folder) {
  std::vector<std::string> stems;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (find_output_format(entry.path().string(), Shows::motion) != nullptr) stems.push_back(entry.path().stem().string());
  return stems;
}

// pen.png, pen_chart.png and pen.poster.png go with pen.mp4, and so does pen.svg; pen_still.svg is a picture of its own.
bool goes_with(const fs::path& picture, const std::vector<std::string>& films) {
  const std::string stem = picture.stem().string();
  return std::any_of(films.begin(), films.end(), [&](const std::string& film) {
    return stem == film || stem.starts_with(film + ".") || (is_chart_name(picture.filename().string()) && stem.starts_with(film + "_"));
  });
}

// By its first bytes: a browser shows nothing of what is only named so.
bool is_what_its_name_says(const std::string& path, const std::string& type) {
  std::ifstream stream(path, std::ios::binary);
  std::string start(512, ' ');
  stream.read(start.data(), std::streamsize(start.size()));
  start.resize(std::size_t(std::max<std::streamsize>(stream.gcount(), 0)));
  return type == "image/png" ? start.starts_with("\x89PNG\r\n\x1a\n") : start.find("<svg") != std::string::npos;
}

// What keeps its pixels from being read; "" of a drawing, which a browser reads as far as it goes.
std::string trouble_of(const std::string& path, const std::string& type) {
  if (type != "image/png") return "";
  try {
    read_png(path);
    return "";
  } catch (const Error& error) {
    return error.problems().front().message;
  }
}

// What a figure without a title shows, by the command that made it: "Effective mass of rr".
std::string shown_by(const Json& figure) {
  const std::vector<std::string> words = figure.is_object() ? figure.value("arguments", std::vector<std::string>()) : std::vector<std::string>();
  if (words.empty() || words.front() != "ellipse") return "";
  const bool is_joint_space = std::ranges::count(words, "--joint-space") > 0;
  std::string source;
  for (const std::size_t i : figure.value("files", std::vector<std::size_t>()))
    if (source.empty() && i < words.size()) source = words[i];
  source = fs::path(source.substr(source.find('=') + 1)).stem().string();
  return source.empty() ? "" : (is_joint_space ? "Mass matrix of " : "Effective mass of ") + source;
}

std::string title_of(const std::string& path) {
  try {
    const ClipMemory memory = recall(path);
    const std::string filled = word_of(memory.audit, "title");  // which says what the scene's leaves open
    if (const std::string& title = filled.empty() ? memory.title : filled; !title.empty()) return in_plain_words(title);
    if (const std::string shown = shown_by(memory.figure); !shown.empty()) return shown;
  } catch (const Error&) {
    // Another program's: it has its name.
  }
  return fs::path(path).stem().string();
}

}  // namespace

std::string shown_endings(const std::string& last_word) {
  return endings_of(&is_shown, last_word);
}

std::string picture_type_of(const std::string& path) {
  const OutputFormat* format = find_output_format(path, Shows::still);
  return format ? format->browser_type : "";
}

std::vector<std::string> pictures_in(const std::string& folder, std::vector<std::string>& left_out, std::vector<std::string>& shown_once) {
  const std::vector<std::string> films = films_of(folder);
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string path = entry.path().string();
    std::error_code code;
    if (!entry.is_regular_file(code) || find_output_format(path, Shows::still) == nullptr) continue;
    if (goes_with(entry.path(), films)) {
      if (std::ranges::count(films, entry.path().stem().string()) > 0) shown_once.push_back(path);
      continue;
    }
    // The same picture once.
    const std::string form = shown_form(path);
    if ((form.empty() || form == path) && remembers(path)) (form.empty() ? left_out : found).push_back(path);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<GalleryPicture> read_pictures(const std::vector<std::string>& paths) {
  std::vector<GalleryPicture> pictures;
  std::vector<Problem> problems;
  for (const std::string& path : paths) {
    note_input(path);
    const std::string type = picture_type_of(path);
    if (fs::file_size(path) > kLargestPicture)
      problems.push_back({"has more than " + std::to_string(kLargestPicture / 1'000'000) + " MB, too many for a picture in a page", {path}});
    else if (!is_what_its_name_says(path, type))
      problems.push_back({"is named " + lower_case_ending(path) + " but is no such picture", {path}});
    else if (const std::string trouble = trouble_of(path, type); !trouble.empty())
      problems.push_back({"cannot be read as a picture: " + trouble, {path}});
    else
      pictures.push_back({path, type, title_of(path)});
  }
  if (!problems.empty()) throw Error(ExitCode::bad_input, std::move(problems));
  return pictures;
}

}  // namespace chainreel
