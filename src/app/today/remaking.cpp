#include "app/today/remaking.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

#include "app/film/clip_origin.hpp"
#include "app/film/formats.hpp"
#include "app/paper/paper.hpp"
#include "app/report/sidecar.hpp"
#include "app/works/moment.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// As its audit tells, or a picture of `snapshot` itself; null where neither does.
Json set_of(const AskedFilm& asked) {
  return asked.audit.json.is_object() ? asked.audit.json.value(kSet, Json::array()) : asked.set;
}

bool is_picture(const std::string& path) {
  return find_output_format(path, Shows::still) != nullptr && find_output_format(path, Shows::motion) == nullptr;
}

// What one command makes with the file: all that its audit tells of, but pictures of other instants. `at`: the instant of its pictures, null without one.
std::vector<std::string> made_together(const AskedFilm& asked, std::size_t panels, Json& at) {
  std::vector<std::string> all;
  const auto add = [&](const std::string& path) {
    const std::string output = panels > 1 && is_table(path) ? page_of_table(path) : path;
    if (std::find(all.begin(), all.end(), output) == all.end()) all.push_back(output);
  };
  for (const Json& one : audited_files_of(asked.audit.json)) {
    const std::string name = fs::path(word_of(one, "file")).filename().string(), path = (fs::path(asked.path).parent_path() / name).string();
    const Json own = is_picture(path) ? one.value("at", Json()) : Json();
    if (find_output_format(path) == nullptr || (own.is_number() && at.is_number() && own != at)) continue;
    if (own.is_number()) at = own;
    add(path);
  }
  add(asked.path);
  return all;
}

constexpr int kDigitsOfInstant = 9;  // of a frame's, of which rounding is no part

// What makes it anew, as a shell's words. What has an audit beside it was made by `render`, a picture of one instant, too; one without by `snapshot`.
std::vector<std::string> command_of(const AskedFilm& asked, const PreparedFilm& film, const Json& shown, const std::vector<std::string>& set) {
  Json at = is_picture(asked.path) ? shown.value("at", Json()) : Json();
  const std::vector<std::string> outputs = made_together(asked, film.panels.size(), at);
  std::vector<std::string> words{"chainreel", at.is_number() && !asked.audit.json.is_object() ? "snapshot" : "render", typed_path(film.scene.file)};
  for (const std::string& flag : paper_flags(paper_of(shown.value(kPaper, Json())))) words.push_back(flag);
  const std::string event = word_of(shown, kAtEvent);
  if (at.is_number()) words.insert(words.end(), {"--at", event.empty() ? format_significant(at.get<double>(), kDigitsOfInstant) + "s" : "event " + event});
  for (const std::string& one : set) words.insert(words.end(), {"--set", one});
  for (const std::string& output : outputs) words.insert(words.end(), {"-o", typed_path(output)});
  words.emplace_back("--force");
  return words;
}

}  // namespace

std::string typed_path(const std::string& path) {
  return path.starts_with('-') ? "./" + path : path;
}

std::string page_of_table(const std::string& path) {
  const fs::path stem = fs::path(path).replace_extension();
  return fs::path(stem).replace_extension().string() + fs::path(path).extension().string();
}

std::vector<std::string> changes_of(const AskedFilm& asked, const CommonOptions& common) {
  std::vector<std::string> set;
  const Json told = set_of(asked);
  for (const Json& one : told.is_array() ? told : Json::array())
    if (one.is_string()) set.push_back(one);
  for (const std::string& one : overrides_of(common)) set.push_back(one);
  return set;
}

namespace {

std::vector<std::string> outputs_of(const std::vector<std::string>& command) {
  std::vector<std::string> outputs;
  for (std::size_t i = 0; i + 1 < command.size(); ++i)
    if (command[i] == "-o") outputs.push_back(fs::path(command[i + 1]).lexically_normal().string());
  return outputs;
}

}  // namespace

bool has_other_pixels(const std::string& path) {
  if (lower_case_ending(path) == ".svg") return is_other_svg(read_plain_file(path));
  if (lower_case_ending(path) != ".png") return false;
  const auto text = read_png_text(path);
  const auto written = text.find(kPixels);
  return written != text.end() && written->second != pixels_checksum(read_png(path));
}

namespace {

// By somebody else since it was written.
bool was_changed(const std::string& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return false;
  try {
    return is_changed_since(path) || has_other_pixels(path);
  } catch (const Error&) {
    return true;  // it cannot be read as what it was
  }
}

}  // namespace

std::vector<std::string> foreign_beside(const std::vector<std::string>& command) {
  const std::vector<std::string> outputs = outputs_of(command);
  const std::string verb = command.size() > 1 ? command[1] : "";
  std::vector<std::string> foreign;
  const auto look = [&](const std::string& path) {
    std::error_code code;
    const bool is_new = std::find(foreign.begin(), foreign.end(), path) == foreign.end() && std::find(outputs.begin(), outputs.end(), path) == outputs.end();
    const bool has_record = is_own_sidecar(path + ".json"), is_edited = has_record && is_changed_since(path);
    if (is_new && fs::exists(fs::symlink_status(path, code)) && (is_edited || (!has_record && !is_own_sidecar(path)))) foreign.push_back(path);
  };
  for (const std::string& output : outputs) {
    if (was_changed(output)) foreign.push_back(output);
    const auto named = [&](const char* ending) { return fs::path(output).replace_extension(ending).string(); };
    if (verb == "render")
      for (const char* ending : {".json", ".txt", ".srt"}) look(named(ending));
    else if (is_table(output))
      look(output + ".json");
    else if (verb == "energy" || verb == "stability" || verb == "fall" || verb == "sweep")
      look(named(".csv"));
  }
  return foreign;
}

std::vector<std::string> placed_words(std::vector<std::string> command) {
  std::error_code code;
  for (std::size_t i = 1; i < command.size(); ++i)
    if (command[i - 1] == "-o" || fs::exists(command[i], code)) command[i] = fs::weakly_canonical(fs::absolute(command[i]), code).string();
  return command;
}

void put_in_order(std::vector<std::vector<std::string>>& commands) {
  std::map<std::string, std::size_t> makers;
  for (std::size_t i = 0; i < commands.size(); ++i)
    for (const std::string& output : outputs_of(commands[i])) makers.emplace(output, i);
  std::vector<std::vector<std::string>> ordered;
  std::vector<bool> is_begun(commands.size());
  const std::function<void(std::size_t)> put = [&](std::size_t i) {
    if (is_begun[i]) return;  // there, or a circle
    is_begun[i] = true;
    for (const std::string& word : commands[i])
      if (const auto maker = makers.find(fs::path(word).lexically_normal().string()); maker != makers.end()) put(maker->second);
    ordered.push_back(commands[i]);
  };
  for (std::size_t i = 0; i < commands.size(); ++i) put(i);
  commands = std::move(ordered);
}

Remaking remaking_of(const AskedFilm& asked, const PreparedFilm& film, const Json& shown, const CommonOptions& common) {
  Remaking again{.knows_set = set_of(asked).is_array(), .set = changes_of(asked, common)};
  again.command = command_of(asked, film, shown, again.set);
  return again;
}

}  // namespace chainreel
