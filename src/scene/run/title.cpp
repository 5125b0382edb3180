#include "scene/run/title.hpp"

#include <array>
#include <cctype>
#include <functional>
#include <optional>
#include <set>
#include <string_view>

#include "core/format.hpp"
#include "scene/run/fall.hpp"

namespace chainreel {
namespace {

constexpr const char* kFall = "fall";

// The words with each name in braces, outside of formulas, replaced by what `value_of` has for it; without a value it stays.
std::string filled(const std::string& words, const std::function<std::optional<std::string>(const std::string& name)>& value_of) {
  std::string text;
  bool is_formula = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == '$') is_formula = !is_formula && words.find('$', i + 1) != std::string::npos;
    const std::size_t end = words[i] == '{' && !is_formula ? words.find('}', i) : std::string::npos;
    if (end == std::string::npos) {
      text += words[i];
      continue;
    }
    const std::optional<std::string> value = value_of(words.substr(i + 1, end - i - 1));
    text += value ? *value : words.substr(i, end + 1 - i);
    i = end;
  }
  return text;
}

std::string value_text(double value) {
  return format_significant(value, 6);
}

std::optional<std::string> parameter_of(const Scene& scene, const std::string& name) {
  for (const auto& [own, value] : scene.parameters)
    if (own == name) return value_text(value);
  return {};
}

// "tips at 0.66 s, not down", of a foot that is held where a real one turns; "" of a run whose foot bears it all.
std::string tips_not_down(const Simulation* simulation, const Trajectory& trajectory) {
  const std::string tips = simulation == nullptr ? "" : tips_text(*simulation, trajectory);
  return tips.empty() ? "" : tips + ", not down";
}

// The title; of a run that does not fall "falls in {fall}" says that, as nobody knows whether it would.
std::string told_of_none(const Scene& scene, const Simulation* simulation, const Trajectory& trajectory) {
  if (!has_fall(scene) || fall_time_of(scene, trajectory)) return scene.title;
  std::string title = scene.title;
  const std::string within = " within " + format_significant(trajectory.end_time, 3) + " s";
  constexpr std::array<std::pair<std::string_view, const char*>, 3> kSaid{{{"falls in {fall}", "does"}, {"Falls in {fall}", "Does"}, {"fall in {fall}", "do"}}};
  for (const auto& [words, verb] : kSaid)
    for (std::size_t at = title.find(words); at != title.npos; at = title.find(words, at + 1))
      if (at == 0 || !std::isalpha(static_cast<unsigned char>(title[at - 1]))) {
        const std::string tips = tips_not_down(simulation, trajectory);
        title.replace(at, words.size(), (tips.empty() ? verb + std::string(" not fall") : tips) + within);
      }
  return title;
}

}  // namespace

std::string filled_words(const std::string& words, const Scene& scene, const Trajectory& trajectory) {
  return filled(words, [&](const std::string& name) -> std::optional<std::string> {
    if (name == kFall && has_fall(scene)) return fall_time_text(scene, trajectory);
    return parameter_of(scene, name);
  });
}

std::string title_of(const Scene& scene, const Simulation* simulation, const Trajectory& trajectory) {
  std::set<std::string> told;
  const std::string own = told_of_none(scene, simulation, trajectory);
  bool tells_fall = own != scene.title;
  std::string title = filled(own, [&](const std::string& name) -> std::optional<std::string> {
    if (name == kFall && has_fall(scene)) {
      tells_fall = true;
      return fall_time_text(scene, trajectory);
    }
    std::optional<std::string> value = parameter_of(scene, name);
    if (value) told.insert(name);
    return value;
  });
  // A name that was made for a panel tells what came of it, too.
  const bool is_made = !scene.title.empty() && !scene.places.contains("title");
  if (is_made && !tells_fall && has_fall(scene)) {
    const bool falls = fall_time_of(scene, trajectory).has_value();
    const std::string tips = falls ? "" : tips_not_down(simulation, trajectory);
    title += ": " + (falls ? "falls in " + fall_time_text(scene, trajectory) : tips.empty() ? "does not fall" : tips);
  }
  for (const auto& [name, value] : scene.set_parameters)
    if (!told.contains(name)) title += (title.empty() ? "" : ", ") + name + " = " + value_text(value);
  return title;
}

std::string title_of_page(const Scene& page) {
  if (page.compare.empty()) return page.title;
  return filled(page.title, [&](const std::string& name) -> std::optional<std::string> {
    if (name == kFall || parameter_of(page, name)) return "\u2026";
    return {};
  });
}

std::string title_over_runs(const Scene& scene) {
  if (scene.title.empty()) return scene.name;
  if (!scene.compare.empty()) return title_of_page(scene);
  return filled(scene.title, [&](const std::string& name) -> std::optional<std::string> {
    if (name == kFall && has_fall(scene)) return "\u2026";
    return parameter_of(scene, name);
  });
}

std::vector<std::string> title_notices(const Scene& scene) {
  std::vector<std::string> notices;
  const bool is_page = !scene.compare.empty();  // its title is that of several runs
  filled(scene.title, [&](const std::string& name) -> std::optional<std::string> {
    const bool is_known = (name == kFall && has_fall(scene)) || parameter_of(scene, name).has_value();
    if (is_page || !is_known)
      notices.push_back("'title': {" + name + "} " + (is_page ? "is left open: " : "stays as it is: ") +
                        (is_page           ? "the title of a comparison has no values, those of its panels do"
                         : name == kFall   ? "no event of kind fall says when it falls"
                         : scene.parameters.empty() ? "the scene has no `parameters:`"
                                                    : "`parameters:` has no such name"));
    return {};
  });
  return notices;
}

}  // namespace chainreel
