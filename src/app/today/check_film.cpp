#include "app/today/check_film.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <optional>

#include "app/cli/named_pose.hpp"
#include "app/cli/result.hpp"
#include "app/cli/shell_word.hpp"
#include "app/cli/streams.hpp"
#include "app/compare/comparison.hpp"
#include "app/film/clip_memory.hpp"
#include "app/film/clip_origin.hpp"
#include "app/film/formats.hpp"
#include "app/film/prepared.hpp"
#include "app/paper/paper_film.hpp"
#include "app/report/audit_check.hpp"
#include "app/report/driving_tables.hpp"
#include "app/report/junit.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/run_report.hpp"
#include "app/report/sidecar.hpp"
#include "app/today/asked_films.hpp"
#include "app/today/command_inputs.hpp"
#include "app/today/remaking.hpp"
#include "app/today/table_record.hpp"
#include "app/verify/physics_record.hpp"
#include "app/works/moment.hpp"
#include "app/works/render_film.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "draw/page/house_style.hpp"
#include "model/model_source.hpp"
#include "model/read_chain.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

// Keys of an audit that are no part of what is shown: versions and the model's file, which are told by themselves, where the
// scene lies, and how the method was chosen that both have.
bool is_beside(const std::string& key) {
  constexpr std::array<std::string_view, 8> kKeys = {"versions", "model_sha256", "model_elements_sha256", "scene", "auto", kSet, kMechanisms, kShipped};
  return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

std::string value_words(const Json& value) {
  constexpr std::size_t kLongest = 60;
  const std::string text = value.is_null() ? "none" : value.dump();
  return text.size() <= kLongest ? text : "";
}

Json without_beside(const Json& audit) {
  Json rest = Json::object();
  for (const auto& [key, value] : audit.items())
    if (!is_beside(key)) rest[key] = value;
  if (rest.contains("panels") && rest["panels"].is_array())
    for (Json& panel : rest["panels"]) panel = without_beside(panel);
  return rest;
}

// Keys of two audits that say something else: "energy_error: 0.02 -> 0.03".
std::vector<std::string> changed_facts(const Json& before, const Json& now) {
  Json keys = before;
  keys.update(now);
  std::vector<std::string> changes;
  for (const auto& [key, ignored] : keys.items()) {
    const Json old = before.value(key, Json()), other = now.value(key, Json());
    if (old == other) continue;
    const std::string from = value_words(old), to = value_words(other);
    changes.push_back(key + (from.empty() || to.empty() ? " is another one" : ": " + from + " -> " + to));
  }
  return changes;
}

// The audits of all panels; of one the film's own.
std::vector<Json> panels_of(const Json& audit) {
  const Json panels = audit.is_object() ? audit.value("panels", Json()) : Json();
  return panels.is_array() && !panels.empty() ? std::vector<Json>(panels.begin(), panels.end()) : std::vector<Json>{audit};
}

constexpr const char* kAnotherModel = "the model is another one";

// What of the models has changed: by their records in the audit beside the film or in a picture by itself; where there are none by their hashes.
std::vector<std::string> changed_models(const Json& beside, const ClipMemory& film, const ClipMemory& today, const PreparedFilm& prepared) {
  const std::vector<Json> before = panels_of(film.audit), now = panels_of(today.audit);
  if (before.size() != now.size() || before.size() != prepared.panels.size()) return {};
  const Json& telling = beside.is_object() ? beside : film.audit;
  const Json records = telling.is_object() ? telling.value(kMechanisms, Json::array()) : Json::array();
  std::vector<std::string> words;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (compare_model_files(before[i], now[i]) != ModelFiles::other) continue;
    std::vector<std::string> own{kAnotherModel};
    if (i < records.size()) own = explain_models(records[i], mechanism_record(prepared.panels[i]));
    for (const std::string& one : own)
      if (std::find(words.begin(), words.end(), one) == words.end()) words.push_back(one);
  }
  return words;
}

// Likewise of the tables that drive it.
std::vector<std::string> changed_tables(const Json& beside, const PreparedFilm& prepared) {
  const Json records = beside.is_object() ? beside.value(kTables, Json::array()) : Json::array();
  std::vector<std::string> words;
  for (std::size_t i = 0; i < std::min(records.size(), prepared.panels.size()); ++i) {
    const Scene& scene = prepared.panels[i].scene;
    for (std::string& one : table_changes(records[i], driving_tables(scene), scene.motion ? "motion" : "torque"))
      if (std::find(words.begin(), words.end(), one) == words.end()) words.push_back(std::move(one));
  }
  return words;
}

// What has changed since.
struct Today {
  std::string path, scene;
  std::vector<std::string> words{};  // for people
  std::vector<std::string> facts{};  // of the audit
  bool has_other_versions = false;
  std::optional<Error> trouble{};  // it cannot be told
  bool is_gone = false;          // an audit tells of it, and it is not there
  bool is_far = false;           // its scene has the name that it remembers, and lies where another course's may, too
  Remaking again{};

  bool is_same() const { return words.empty() && facts.empty() && !trouble && !is_gone; }
};

// Whether a scene or model that was found by its name lies neither above the picture nor beside the folder that holds it.
bool lies_elsewhere(const std::string& picture, const std::string& scene) {
  std::error_code code;
  const fs::path own = fs::weakly_canonical(fs::absolute(picture), code).parent_path(), other = fs::weakly_canonical(fs::absolute(scene), code).parent_path();
  const auto [parted, at] = std::mismatch(own.begin(), own.end(), other.begin(), other.end());
  return at != other.end() && std::distance(parted, own.end()) > 1;
}

Today difference_of(const std::string& path, const Json& beside, const ClipMemory& film, const ClipMemory& today, const PreparedFilm& prepared) {
  Today found{.path = path, .scene = prepared.scene.file};
  found.has_other_versions = has_other_versions(film.audit.value("versions", Json::object()), today.audit.value("versions", Json::object()));
  ClipMemory old = film, now = today;
  old.audit = without_beside(film.audit);
  now.audit = without_beside(today.audit);
  found.words = changed_models(beside, film, today, prepared);
  for (std::string& one : changed_tables(beside, prepared)) found.words.push_back(std::move(one));
  for (std::string& one : explain_memories(old, now)) found.words.push_back(std::move(one));
  found.facts = changed_facts(old.audit, now.audit);
  // Drawings keep neither.
  if (film.title.empty() && film.description.empty()) return found;
  if (film.title != today.title) found.facts.push_back("title: " + film.title + " -> " + today.title);
  if (film.description != today.description) found.facts.emplace_back("what it says for those who do not see it is another text");
  return found;
}

// A picture is one of `snapshot`'s or a frame of `render`'s, which remember a little else.
std::vector<ClipMemory> memories_today(PreparedFilm& film, const std::string& path, const ClipMemory& remembered) {
  const PaperOptions paper = paper_of(remembered.audit.value(kPaper, Json()));
  if (paper.is_given()) set_paper_page(film, paper, Fonts(families_of(film.scene)), true);
  Json at = remembered.audit.value("at", Json());
  std::vector<ClipMemory> memories{memory_of_film(film)};
  if (find_output_format(path, Shows::motion) != nullptr || !at.is_number()) return memories;
  const std::string event = word_of(remembered.audit, kAtEvent);
  if (!event.empty()) at = instants_asked(film, {{0, event, "event " + event}}).front();
  memories.back().audit["at"] = at;
  const Fonts fonts(families_of(film.scene));
  if (at.get<double>() >= 0 && at.get<double>() <= film.scene.duration) {
    memories.push_back(moment_at(film, at.get<double>(), fonts).memory);
    memories.back().audit.update(told_alone(film));
  }
  for (ClipMemory& memory : memories) {
    if (!event.empty()) memory.audit[kAtEvent] = event;
    if (paper.is_given()) memory.audit[kPaper] = to_json(paper);
  }
  return memories;
}

// A torque that a program of the user's gave is in no file: without it, the scene shows something else, which has to replace nothing.
void require_no_own_torque(const std::string& path, const Json& audit) {
  const std::string words = torque_function_in(audit);
  if (!words.empty()) throw Error(ExitCode::bad_input, "was driven by " + words + ", which no file holds: run again the program that made it", {path});
}

PreparedFilm film_behind(const AskedFilm& asked, const std::string& scene, const CommonOptions& common) {
  require_no_own_torque(asked.path, asked.audit.json);
  return load_film(scene.empty() ? scene_behind(asked) : scene, changes_of(asked, common), true, common.quiet);
}

// A table of `render`: it remembers nothing, and is made again.
Today table_of_today(const AskedFilm& asked, const std::string& scene, const CommonOptions& common) {
  if (!asked.audit.json.is_object())
    throw Error(ExitCode::bad_input, "is a table that no audit and no record beside it tells of, as commands write them: whether it would be the same today cannot be told", {asked.path});
  const std::string& path = asked.path;
  const OwnAudit& audit = asked.audit;
  const PreparedFilm film = film_behind(asked, scene, common);
  Today found{.path = path, .scene = film.scene.file};
  found.again = remaking_of(asked, film, Json::object(), common);
  const Runs runs(film);
  const std::string bytes = read_plain_file(path);
  const std::string page = page_of_table(path);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs.size() > 1 && panel_table_path(page, i, false) != path) continue;
    if (bytes == table_bytes(motion_table(film.panels[i].simulation, runs[i]), table_format_of(path))) return found;
  }
  const Json records = audit.json.is_object() ? audit.json.value(kMechanisms, Json::array()) : Json::array();
  for (std::size_t i = 0; i < std::min(records.size(), film.panels.size()); ++i)
    for (std::string& one : explain_models(records[i], mechanism_record(film.panels[i]))) found.words.push_back(std::move(one));
  for (std::string& one : changed_tables(audit.json, film)) found.words.push_back(std::move(one));
  found.words.emplace_back("its numbers are others");
  return found;
}

Today gone_of_today(const AskedFilm& asked, const std::string& scene, const CommonOptions& common) {
  const PreparedFilm film = film_behind(asked, scene, common);
  Today found{.path = asked.path, .scene = film.scene.file, .is_gone = true};
  found.again = remaking_of(asked, film, {{"at", asked.audit.at}}, common);
  return found;
}

// Poses that have a name beside the model, and are others now.
std::vector<std::string> changed_poses(const Json& figure, const std::string& model) {
  const Json poses = figure.value("named_poses", Json::object());
  std::vector<std::string> words;
  if (poses.empty() || !poses.is_object()) return words;
  const Chain chain = read_chain(model);
  for (const auto& [name, before] : poses.items()) {
    const std::string now = named_pose_text(chain, model, name, "pose");
    if (now == name)
      words.push_back("the pose " + name + " stands in no .srdf beside the model any more");
    else if (before != Json(now))
      words.push_back("pose " + name + ": " + (before.is_string() ? before.get<std::string>() : "another one") + " -> " + now);
  }
  return words;
}

// What a command writes is never among the words that are remembered: a file that came from elsewhere could name any of the user's.
std::vector<std::string> words_behind_program(std::vector<std::string> words, const std::vector<std::size_t>& files, const std::string& path) {
  std::vector<std::string> all{"chainreel"};
  for (const std::size_t i : files)
    if (i < words.size()) words[i] = typed_path(words[i]);
  // Each of its files is made by itself: flags that are of another one's form go.
  const std::string ending = lower_case_ending(path);
  if (!words.empty() && words.front() == "equations") {
    if (ending != ".tex") std::erase(words, "--document");
    if (ending == ".py" || ending == ".json") std::erase(words, "--theta");
  }
  for (const std::string& word : words)
    if (word.starts_with("-o") || word.starts_with("--output") || word.starts_with("--force"))
      throw Error(ExitCode::bad_input, "remembers a command that says where to write, which no program of ours does: it was changed by hand", {path});
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

// What the files of a command say now. Throws Error (bad input) where one cannot be read any more.
Json inputs_today(const std::vector<std::string>& words, const std::vector<std::size_t>& files, const std::string& path) {
  Json now = command_inputs(words, files);
  if (!are_known(now))
    throw Error(ExitCode::bad_input, "one of the files that made it cannot be read any more: `" + shell_line(words_behind_program(words, files, path)) + "` says which; a scene that lies elsewhere is named by --scene", {path});
  return now;
}

// A table of a command by itself, by the record beside it.
Today recorded_of_today(const AskedFilm& asked, const std::string& scene, const CommonOptions& common) {
  RecordedCommand made = recorded_command(asked.audit.json, asked.audit.folder, asked.path);
  if (made.files.empty()) throw Error(ExitCode::bad_input, "was made of no file", {asked.path});
  std::string& first = made.words[made.files.front()];
  if (!scene.empty()) first = scene;
  Today found{.path = asked.path, .scene = first, .is_gone = asked.is_gone};
  for (const std::string& set : overrides_of(common)) made.words.insert(made.words.end(), {"--set", set});
  const Json now = inputs_today(made.words, made.files, asked.path);
  if (asked.audit.is_changed && !asked.is_gone) found.words.push_back("the file is not as it was written: `chainreel check " + asked.path + "`");
  for (std::string& one : changed_inputs(asked.audit.json[kMadeBy].value(kInputs, Json()), now, keys_without_numbers(made.words))) found.words.push_back(std::move(one));
  for (std::string& one : changed_poses({{"named_poses", made.named_poses}}, first)) found.words.push_back(std::move(one));
  found.again.command = words_behind_program(made.words, made.files, asked.path);
  // The table of a map is made without one.
  if (const auto map = std::find(found.again.command.begin(), found.again.command.end(), "--map"); map != found.again.command.end() && map + 1 != found.again.command.end())
    found.again.command.erase(map, map + 2);
  found.again.command.insert(found.again.command.end(), {"-o", typed_path(made.output), "--force"});
  return found;
}

constexpr const char* kOtherPixels = "the file is not as it was written: its pixels are others";

// A figure depends on what its files say, and on poses that have names beside its model.
Today figure_of_today(const std::string& path, const ClipMemory& remembered) {
  const Json& figure = remembered.figure;
  const std::string model = word_of(figure, "model"), file = first_file_of(figure);
  if (file.empty())
    throw Error(ExitCode::bad_input, "is a figure that does not remember what its files said: `chainreel extract` tells the command that makes it again", {path});
  const ClipOrigin origin = find_nearest(path, file, files_wanted_by(remembered), figure.value(kShipped, Json()) == Json(true));
  if (!origin.is_found) throw Error(ExitCode::bad_input, "shows " + file + ", which is not here, nor in folders around", {path});
  const Json moved = figure_from(figure, origin);
  Today found{.path = path, .scene = model.empty() ? first_file_of(moved) : word_of(moved, "model")};
  const std::vector<std::string> words = moved.value("arguments", std::vector<std::string>());
  if (figure.contains(kInputs)) {
    found.words = changed_inputs(figure[kInputs], inputs_today(words, figure.value("files", std::vector<std::size_t>()), path), keys_of_command(words));
  } else {
    const ModelSource source(found.scene);
    if (compare_model_files(figure, {{"model_sha256", source.sha256()}, {"model_elements_sha256", source.elements_sha256()}}) == ModelFiles::other)
      found.words.emplace_back(kAnotherModel);
  }
  if (!model.empty())
    for (std::string& one : changed_poses(figure, found.scene)) found.words.push_back(std::move(one));
  if (has_other_pixels(path)) found.words.emplace_back(kOtherPixels);
  found.is_far = figure.value(kShipped, Json()) != Json(true) && lies_elsewhere(path, found.scene);
  found.again.command = words_behind_program(words, figure.value("files", std::vector<std::size_t>()), path);
  found.again.command.insert(found.again.command.end(), {"-o", typed_path(path), "--force"});
  return found;
}

Today today_of(const AskedFilm& asked, const std::string& scene, const CommonOptions& common) {
  const std::string& path = asked.path;
  const OwnAudit& audit = asked.audit;
  if (audit.json.is_object() && audit.json.contains(kMadeBy)) return recorded_of_today(asked, scene, common);
  if (asked.is_gone) return gone_of_today(asked, scene, common);
  if (is_table(path)) return table_of_today(asked, scene, common);
  const std::string is_other = "the file is not as it was written: `chainreel check " + path + "`";
  ClipMemory remembered;
  try {
    remembered = recall(path);
  } catch (const Error&) {
    if (!audit.is_changed) throw;
    Today broken = gone_of_today(asked, scene, common);
    broken.is_gone = false;
    broken.words = {is_other};
    return broken;
  }
  if (!remembered.figure.is_null()) return figure_of_today(path, remembered);
  require_no_own_torque(path, remembered.audit);
  PreparedFilm film = film_behind(asked, scene, common);
  std::vector<Today> found;
  for (const ClipMemory& memory : memories_today(film, path, remembered)) found.push_back(difference_of(path, audit.json, remembered, memory, film));
  const auto count = [](const Today& one) { return one.words.size() + one.facts.size(); };
  Today nearest = *std::min_element(found.begin(), found.end(), [&](const Today& a, const Today& b) { return count(a) < count(b); });
  if (audit.is_changed) nearest.words.insert(nearest.words.begin(), is_other);
  if (!audit.is_changed && has_other_pixels(path)) nearest.words.insert(nearest.words.begin(), kOtherPixels);
  nearest.words.insert(nearest.words.end(), audit.beside.begin(), audit.beside.end());
  nearest.again = remaking_of(asked, film, remembered.audit, common);
  nearest.is_far = scene.empty() && !asked.scene.empty() && remembered.audit.value(kShipped, Json()) != Json(true) && lies_elsewhere(path, asked.scene);
  return nearest;
}

void tell_passed_over(const std::vector<std::string>& files) {
  constexpr std::size_t kMostNames = 8;
  if (files.empty()) return;
  const std::vector<std::string> named(files.begin(), files.begin() + std::ptrdiff_t(std::min(files.size(), kMostNames)));
  std::fprintf(stderr, "note: %s not asked about, as no audit beside %s the scene: %s%s (--scene names that of a film or picture; charts, which measure, cannot be asked)\n",
               counted(files.size(), "file is", "files are").c_str(), files.size() == 1 ? "it tells" : "them tells", joined(named).c_str(),
               files.size() > kMostNames ? ", .." : "");
}

void print_today(const Today& one) {
  if (one.trouble)
    std::printf("%s: it cannot be told whether its scene shows the same today\n", one.path.c_str());
  else if (one.is_gone)
    std::printf("%s is gone: the audit beside it tells of it\n", one.path.c_str());
  else if (one.is_same())
    std::printf("%s is what %s shows today%s\n", one.path.c_str(), one.scene.c_str(), one.has_other_versions ? ", made by other versions of the program or its libraries" : "");
  else
    std::printf("%s is NOT what %s shows today\n", one.path.c_str(), one.scene.c_str());
  for (const std::string& line : one.words) std::printf("  %s\n", line.c_str());
  if (one.words.empty())
    for (const std::string& line : one.facts) std::printf("  %s\n", line.c_str());
  if (!one.is_same() && one.is_far) std::printf("  its scene was found in another folder, by the name alone: if it is another one, name the right one by --scene\n");
  if (!one.is_same() && !one.again.knows_set) std::printf("  what --set changed when it was made is not known, as no audit lies beside it: give it again\n");
  if (!one.is_same() && !one.again.command.empty()) std::printf("  made again by: %s\n", shell_line(one.again.command).c_str());
  if (const std::vector<std::string> foreign = one.is_same() ? std::vector<std::string>() : foreign_beside(one.again.command); !foreign.empty())
    std::printf("  .. which would replace %s, which this program did not write so: move it away before\n", joined(foreign).c_str());
}

// One file is told of with its command. What of many is not as it should be is told in the report: here how many they are, and what makes all anew.
Problem stale_files(const std::vector<std::string>& asked, const std::vector<Today>& all, const std::string& scene, const CommonOptions& common) {
  std::vector<const Today*> stale;
  for (const Today& one : all)
    if (!one.is_same() && !one.trouble) stale.push_back(&one);
  if (all.size() == 1) {
    const Today& one = *stale.front();
    return {(one.is_gone ? "is gone" : "is not what " + one.scene + " shows today") + ": make it again" + (one.again.command.empty() ? "" : ", `" + shell_line(one.again.command) + "`"), {one.path}};
  }
  std::vector<std::string> words{"chainreel", "check"};
  for (const std::string& path : asked) words.push_back(typed_path(path));
  if (scene.empty())
    words.emplace_back("--today");
  else
    words.insert(words.end(), {"--scene", typed_path(scene)});
  for (const std::string& set : overrides_of(common)) words.insert(words.end(), {"--set", set});
  words.emplace_back("--commands");
  return {counted(stale.size(), "file", "files") + " of " + std::to_string(all.size()) + (stale.size() == 1 ? " is not what its scene shows" : " are not what their scenes show") +
              " today: `" + shell_line(words) + " | sh` makes " + (stale.size() == 1 ? "it" : "them") + " anew",
          {}};
}

// For a shell nothing else is told: what is as it should be has no line. What would be lost or is not known is told in place of a command that runs.
void print_commands(const std::vector<Today>& all) {
  std::vector<std::vector<std::string>> commands;
  std::map<std::vector<std::string>, std::string> remarks;
  std::set<std::vector<std::string>> known;  // by where their files lie, however these are named
  for (const Today& one : all) {
    const std::string remark = one.is_far                ? "# its scene was found in another folder, by the name alone: "
                               : !one.again.knows_set ? "# what --set changed is not known, as no audit lies beside it: "
                                                      : "";
    if (!one.is_same() && !one.again.command.empty() && known.insert(placed_words(one.again.command)).second) {
      remarks.emplace(one.again.command, remark);
      commands.push_back(one.again.command);
    }
  }
  put_in_order(commands);
  for (const std::vector<std::string>& command : commands) {
    const std::vector<std::string> foreign = foreign_beside(command);
    const std::string remark = !foreign.empty() ? "# it would replace " + joined(foreign) + ", which this program did not write so: " : remarks.at(command);
    std::printf("%s%s\n", remark.c_str(), shell_line(command).c_str());
  }
}

std::vector<JunitCase> cases_of(const std::vector<Today>& all) {
  std::vector<JunitCase> cases;
  for (const Today& one : all) {
    JunitCase found{.group = one.scene, .name = one.path, .is_error = one.trouble.has_value()};
    if (one.trouble) found.fault = "unknown", found.message = one.trouble->problems().front().message;
    if (!one.trouble && !one.is_same()) {
      found.fault = one.is_gone ? "gone" : "changed";
      found.message = one.is_gone ? "is gone" : one.words.empty() ? "is not what its scene shows today" : one.words.front();
      found.text = joined(one.words.empty() ? one.facts : one.words, "\n") + (one.again.command.empty() ? "" : "\nmade again by: " + shell_line(one.again.command));
    }
    cases.push_back(found);
  }
  return cases;
}

Json report_of(const Today& one) {
  return {{"file", one.path}, {"scene", one.scene}, {"set", one.again.set}, {"command", one.again.command}, {"is_same", one.is_same()}, {"changed", one.words}, {"audit_changed", one.facts},
          {"has_other_versions", one.has_other_versions}, {"is_gone", one.is_gone}, {"trouble", one.trouble ? Json(one.trouble->problems().front().message) : Json(nullptr)}};
}

}  // namespace

bool is_film_or_picture(const std::string& path) {
  constexpr std::array<const char*, 3> kBeside = {".json", ".txt", ".srt"};
  const std::string ending = lower_case_ending(path);
  return find_output_format(path) != nullptr || is_table(path) || std::find(kBeside.begin(), kBeside.end(), ending) != kBeside.end();
}

void check_as_written(const std::string& path, const CommonOptions& common) {
  if (!overrides_of(common).empty())
    throw Error(ExitCode::usage, "--set and the like go with a scene: of a film it is asked whether its audit tells of these bytes; "
                                 "with --today, whether its scene would make it now");
  const AuditCheck check = check_audit(path);
  tell_result(common, [&] { return to_json(check); }, [&] {
    for (const std::string& line : words_of(check)) std::printf("%s\n", line.c_str());
  });
  if (!check.passes()) throw Error(ExitCode::comparison_failed, "is not what its audit tells of", {path});
}

void check_of_today(const std::vector<std::string>& paths, const std::string& scene, bool as_commands, const std::string& junit, const CommonOptions& common) {
  const AskedFilms asked = asked_films(paths);
  if (!common.quiet) tell_passed_over(asked.passed_over);
  std::vector<Today> all;
  for (const AskedFilm& film : asked.list) {
    throw_if_interrupted();
    try {
      all.push_back(today_of(film, scene, common));
    } catch (const Error& error) {
      if (error.code() == ExitCode::interrupted || error.code() == ExitCode::terminated) throw;
      all.push_back({.path = film.path, .scene = scene, .trouble = error});
    } catch (const Json::exception&) {
      all.push_back({.path = film.path, .scene = scene, .trouble = Error(ExitCode::bad_input, "what it remembers, or the audit beside it, was changed by hand", {film.path})});
    }
  }
  tell_result(common, [&] {
    Json films = Json::array();
    for (const Today& one : all) films.push_back(report_of(one));
    return Json{{"films", films}, {"passed_over", asked.passed_over}};
  }, [&] {
    if (as_commands) return print_commands(all);
    for (const Today& one : all) print_today(one);
  });
  if (!junit.empty()) write_junit(junit, junit_text("check --today", joined(paths), cases_of(all)));
  std::vector<Problem> troubles;
  for (const Today& one : all) {
    if (!one.trouble) continue;
    for (Problem problem : one.trouble->problems()) {
      // A trouble of a scene concerns each of its films.
      if (problem.place.file.empty())
        problem.place.file = one.path;
      else if (problem.place.file != one.path)
        problem.message += "; " + one.path + " shows it";
      troubles.push_back(std::move(problem));
    }
  }
  const bool is_told = troubles.empty();
  if (std::ranges::any_of(all, [](const Today& one) { return !one.is_same() && !one.trouble; })) troubles.push_back(stale_files(paths, all, scene, common));
  if (!troubles.empty()) throw Error(is_told ? ExitCode::comparison_failed : ExitCode::bad_input, std::move(troubles));
}

}  // namespace chainreel
