#include "app/commands/check_film.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "app/cli/result.hpp"
#include "app/commands/comparison.hpp"
#include "app/film/formats.hpp"
#include "app/film/prepared.hpp"
#include "app/report/audit_check.hpp"
#include "app/works/moment.hpp"
#include "app/works/render_film.hpp"
#include "core/error.hpp"
#include "draw/page/house_style.hpp"

namespace chainreel {
namespace {

// What the versions say is told, and changes no picture by itself.
constexpr std::string_view kVersions = "versions";

std::string told(const Json& value) {
  constexpr std::size_t kLongest = 60;
  const std::string text = value.is_null() ? "none" : value.dump();
  return text.size() <= kLongest ? text : "";
}

// Keys of two audits that say something else: "energy_error: 0.02 -> 0.03".
std::vector<std::string> changed_facts(const Json& before, const Json& now) {
  Json keys = before;
  keys.update(now);
  std::vector<std::string> changes;
  for (const auto& [key, ignored] : keys.items()) {
    const Json old = before.value(key, Json()), other = now.value(key, Json());
    if (key == kVersions || old == other) continue;
    const std::string from = told(old), to = told(other);
    changes.push_back(key + (from.empty() || to.empty() ? " is another one" : ": " + from + " -> " + to));
  }
  return changes;
}

struct Today {
  std::vector<std::string> words;  // what has changed, for people
  std::vector<std::string> facts;  // of the audit
  bool has_other_versions = false;

  bool is_same() const { return words.empty() && facts.empty(); }
};

Today difference_of(const ClipMemory& film, const ClipMemory& today) {
  Today found;
  found.has_other_versions = film.audit.value(kVersions, Json()) != today.audit.value(kVersions, Json());
  ClipMemory same_versions = today;
  same_versions.audit[kVersions] = film.audit.value(kVersions, Json());
  found.words = explain_memories(film, same_versions);
  found.facts = changed_facts(film.audit, today.audit);
  if (film.title != today.title) found.facts.push_back("title: " + film.title + " -> " + today.title);
  if (film.description != today.description) found.facts.emplace_back("what it says for those who do not see it is another text");
  return found;
}

// A picture is one of `snapshot`'s or a frame of `render`'s, which remember a little else.
std::vector<ClipMemory> memories_today(const PreparedFilm& film, const std::string& path, const ClipMemory& remembered) {
  const Json at = remembered.audit.value("at", Json());
  if (find_output_format(path, Shows::motion) != nullptr || !at.is_number()) return {memory_of_film(film)};
  std::vector<ClipMemory> memories{memory_of_film(film)};
  memories.back().audit["at"] = at;
  const Fonts fonts(families_of(film.scene));
  if (at.get<double>() >= 0 && at.get<double>() <= film.scene.duration) memories.push_back(moment_at(film, at.get<double>(), fonts).memory);
  return memories;
}

}  // namespace

bool is_film_or_picture(const std::string& path) {
  constexpr std::array<const char*, 3> kBeside = {".json", ".txt", ".srt"};
  const std::string ending = lower_case_ending(path);
  return find_output_format(path) != nullptr || std::find(kBeside.begin(), kBeside.end(), ending) != kBeside.end();
}

void check_as_written(const std::string& path, const CommonOptions& common) {
  if (!overrides_of(common).empty())
    throw Error(ExitCode::usage, "--set and the like go with a scene: of a film it is asked whether its audit tells of these bytes; "
                                 "`--scene SCENE --set ..` asks whether that scene would make it today");
  const AuditCheck check = check_audit(path);
  tell_result(common, [&] { return to_json(check); }, [&] {
    for (const std::string& line : words_of(check)) std::printf("%s\n", line.c_str());
  });
  if (!check.passes()) throw Error(ExitCode::comparison_failed, "is not what its audit tells of", {path});
}

void check_against_scene(const std::string& path, const std::string& scene, const CommonOptions& common) {
  const ClipMemory remembered = recall(path);
  if (!remembered.figure.is_null())
    throw Error(ExitCode::bad_input, "is a figure, which shows no run of a scene: `chainreel extract` tells the command that makes it again", {path});
  const PreparedFilm film = load_film(scene, overrides_of(common), true, common.quiet);
  std::vector<Today> found;
  for (const ClipMemory& memory : memories_today(film, path, remembered)) found.push_back(difference_of(remembered, memory));
  const auto count = [](const Today& one) { return one.words.size() + one.facts.size(); };
  const Today& nearest = *std::min_element(found.begin(), found.end(), [&](const Today& a, const Today& b) { return count(a) < count(b); });
  tell_result(common, [&] {
    return Json{{"file", path}, {"scene", scene}, {"is_same", nearest.is_same()}, {"changed", nearest.words}, {"audit_changed", nearest.facts},
                {"has_other_versions", nearest.has_other_versions}};
  }, [&] {
    for (const std::string& line : nearest.words) std::printf("%s\n", line.c_str());
    if (nearest.words.empty())
      for (const std::string& line : nearest.facts) std::printf("audit: %s\n", line.c_str());
    if (nearest.is_same()) std::printf("%s is what %s shows today\n", path.c_str(), scene.c_str());
    if (nearest.has_other_versions) std::printf("made by other versions of the program or its libraries\n");
  });
  if (!nearest.is_same()) throw Error(ExitCode::comparison_failed, "is not what " + scene + " shows today: render it again", {path});
}

}  // namespace chainreel
