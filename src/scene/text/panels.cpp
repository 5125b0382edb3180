#include "scene/text/panels.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <yaml-cpp/yaml.h>

#include "integrate/method.hpp"
#include "model/model_description.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/element_words.hpp"
#include "scene/text/leaf_words.hpp"
#include "scene/text/title_values.hpp"
#include "scene/text/write_scene.hpp"

namespace chainreel {
namespace {

// Without braces, which a title fills.
std::string in_words(std::string text) {
  std::erase_if(text, [](char c) { return c == '{' || c == '}'; });
  return text;
}

// A list as one writes a vector: (1, 0).
std::string value_of(const SceneEntry& entry, const std::string& unit) {
  const YAML::Node node = YAML::Load(entry.text);
  if (!node.IsSequence()) return in_words(joined_value(title_value(node.IsScalar() ? node.Scalar() : entry.text, unit)));
  std::vector<TitleValue> values;
  for (const YAML::Node& one : node) values.push_back(title_value(one.IsScalar() ? one.Scalar() : "..", unit));
  return in_words(joined_values(values));
}

enum class Length { brief, whole };

std::string words_of(const SceneEntry& entry, Length length) {
  const SceneKey& key = *find_key(entry.key);
  const bool is_path = key.form == KeyForm::path || key.name == "packages" || (!entry.text.empty() && (key.name == "model" || key.name == "motion") && entry.text.front() != '{');
  const std::string name = entry.key.substr(entry.key.find('.') + 1);
  if (is_path) {
    const std::filesystem::path path = entry.text;
    const std::string own = length == Length::brief ? path.stem().string() : (path.parent_path().filename() / path.filename()).string();
    return (key.name == "motion" ? "motion " : "") + own;
  }
  if (key.form == KeyForm::truth && key.caption.empty()) return (entry.text == "true" ? "" : "no ") + name;
  const bool has_one_unit = key.caption.empty() && key.unit.find(" or ") == std::string::npos && key.unit.find('^') == std::string::npos;
  const std::string value = entry.key == "method" ? method_title(entry.text) : value_of(entry, has_one_unit ? key.unit : "");
  if (key.caption.empty()) return name + " = " + value;
  std::string words = key.caption;
  return words.replace(words.find('@'), 1, value);
}

// Of what is left out beside panels that have it.
std::string words_of_absent(const SceneEntry& of_other) {
  const std::string absent = find_key(of_other.key)->absent;
  const std::string section = find_key(of_other.key)->section();
  std::string name = section.empty() ? of_other.key.substr(of_other.key.find('.') + 1) : section;
  std::ranges::replace(name, '_', ' ');
  return (absent.empty() || absent == "none" ? "no " : "default ") + name;
}

// What a title says of one key.
using KeyWords = std::vector<std::string>;  // of each panel

using Entries = std::vector<const SceneEntry*>;  // of each panel, null where it is left out

// Keys that mean something beside a value of another one alone, as a payload's place does beside its mass, are told by that: what is
// the same wherever it stands says no more.
void leave_out_what_follows(const std::vector<std::string>& keys, const std::vector<Entries>& entries, std::vector<KeyWords>& all) {
  static const std::set<std::string> leading{"payload.mass", "motion", "constraints", "stabilize"};
  const auto follows = [&](std::size_t k) {
    std::set<std::string> texts;
    for (const SceneEntry* entry : entries[k])
      if (entry != nullptr) texts.insert(entry->text);
    if (texts.size() != 1 || std::ranges::find(entries[k], nullptr) == entries[k].end() || find_key(keys[k])->means_something == nullptr) return false;
    for (std::size_t g = 0; g < keys.size(); ++g) {
      if (g == k || !leading.contains(keys[g])) continue;
      std::set<std::string> with, without;
      for (std::size_t i = 0; i < entries[k].size(); ++i) (entries[k][i] != nullptr ? with : without).insert(all[g][i]);
      if (std::ranges::none_of(with, [&](const std::string& one) { return without.contains(one); })) return true;
    }
    return false;
  };
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (!leading.contains(keys[k]) || keys[k] == "stabilize")
      if (follows(k)) all[k].assign(all[k].size(), "");
}

// By what they differ in, key by key.
std::vector<KeyWords> words_by_key(const std::vector<Scene>& panels, const CoordinateUnits& units, Length length) {
  const std::vector<SceneEntry> shared = shared_entries(panels);
  std::vector<const Scene*> scenes;
  std::vector<std::vector<SceneEntry>> own;
  std::vector<std::string> keys;
  for (const Scene& panel : panels) {
    scenes.push_back(&panel);
    own.push_back(entries_of(panel));
    std::erase_if(own.back(), [&](const SceneEntry& entry) {
      return !find_key(entry.key)->is_captioned || std::find(shared.begin(), shared.end(), entry) != shared.end();
    });
    for (const SceneEntry& entry : own.back())
      if (std::ranges::find(keys, entry.key) == keys.end()) keys.push_back(entry.key);
  }
  const auto place = [](const std::string& key) { return find_key(key) - scene_keys().data(); };
  std::ranges::stable_sort(keys, [&](const std::string& a, const std::string& b) { return place(a) < place(b); });
  std::vector<KeyWords> all;
  std::vector<Entries> all_entries;
  for (const std::string& key : keys) {
    Entries entries;
    for (const std::vector<SceneEntry>& list : own) {
      const auto entry = std::ranges::find(list, key, &SceneEntry::key);
      entries.push_back(entry == list.end() ? nullptr : &*entry);
    }
    KeyWords words = words_by_leaf(scenes, entries, units);
    if (words.empty()) words = words_by_element(scenes, entries, units);
    if (words.empty())
      for (const SceneEntry* entry : entries) words.push_back(entry == nullptr ? "" : words_of(*entry, length));
    all.push_back(std::move(words));
    all_entries.push_back(std::move(entries));
  }
  leave_out_what_follows(keys, all_entries, all);
  // Who has none of these keys, or only some that say nothing, is told by the first that it lacks.
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (std::ranges::all_of(all, [i](const KeyWords& words) { return words[i].empty(); }))
      for (std::size_t k = 0; k < keys.size(); ++k)
        if (const auto other = std::ranges::find_if(all_entries[k], [](const SceneEntry* entry) { return entry != nullptr; }); other != all_entries[k].end()) {
          all[k][i] = words_of_absent(**other);
          break;
        }
  return all;
}

std::vector<std::string> joined_keys(const std::vector<KeyWords>& keys, const std::vector<bool>& chosen, std::size_t panels) {
  std::vector<std::string> titles(panels);
  for (std::size_t i = 0; i < panels; ++i)
    for (std::size_t k = 0; k < keys.size(); ++k)
      if (chosen[k] && !keys[k][i].empty()) titles[i] += (titles[i].empty() ? "" : ", ") + keys[k][i];
  return titles;
}

bool are_apart(const std::vector<std::string>& titles) {
  return std::set<std::string>(titles.begin(), titles.end()).size() == titles.size();
}

std::vector<std::string> readable(std::vector<std::string> titles) {
  for (std::string& title : titles) title = with_readable_numbers(title);
  return titles;
}

// As many keys as fit beside the first one that tells all panels apart: what is left out is an ellipsis. All where none does.
std::vector<std::string> that_fit(const std::vector<KeyWords>& keys, std::size_t panels) {
  constexpr std::size_t kOfPage = 96;  // bytes on a page's width, at the least size
  const std::size_t longest = kOfPage / std::max<std::size_t>(2, std::min<std::size_t>(panels, 4));
  const auto fit = [&](const std::vector<std::string>& all) { return std::ranges::all_of(all, [&](const std::string& one) { return one.size() <= longest; }); };
  const std::vector<bool> all(keys.size(), true);
  const std::vector<std::string> whole = readable(joined_keys(keys, all, panels));
  if (fit(whole)) return whole;
  std::vector<bool> chosen(keys.size());
  for (std::size_t k = 0; k < keys.size() && chosen == std::vector<bool>(keys.size()); ++k) {
    chosen[k] = true;
    const std::vector<std::string> alone = readable(joined_keys(keys, chosen, panels));
    chosen[k] = are_apart(alone) && fit(alone) && std::ranges::none_of(alone, &std::string::empty);
  }
  if (chosen == std::vector<bool>(keys.size())) return whole;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (chosen[k]) continue;
    chosen[k] = true;
    chosen[k] = fit(readable(joined_keys(keys, chosen, panels)));
  }
  std::vector<std::string> titles = readable(joined_keys(keys, chosen, panels));
  for (std::size_t i = 0; i < panels; ++i)
    if (titles[i] != whole[i]) titles[i] += ", \u2026";
  return titles;
}

std::vector<std::string> titles_of(const std::vector<Scene>& panels, const CoordinateUnits& units) {
  std::vector<std::string> titles;
  for (const Length length : {Length::brief, Length::whole}) {
    const std::vector<KeyWords> keys = words_by_key(panels, units, length);
    titles = that_fit(keys, panels.size());
    if (are_apart(titles)) return titles;
    titles = joined_keys(keys, std::vector<bool>(keys.size(), true), panels.size());
    if (are_apart(titles)) return titles;
  }
  return titles;
}

}  // namespace

CoordinateUnits units_of(const Chain& chain) {
  CoordinateUnits units;
  for (const DescribedCoordinate& one : coordinates_of(chain)) {
    units.q.push_back(one.unit);
    units.by_name[one.name] = one.unit;
  }
  units.freedoms.resize(std::size_t(chain.nv), "rad");
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind == JointKind::prismatic) units.freedoms[std::size_t(joint.v_index)] = "m";
    if (joint.kind == JointKind::floating)
      for (int k = 0; k < 3; ++k) units.freedoms[std::size_t(joint.v_index + k)] = "m";
  }
  return units;
}

bool differ_by_method_alone(const std::vector<Scene>& panels) {
  static const std::set<std::string> of_methods{"method", "step", "tolerance", "order", "accuracy", "expect"};
  const std::vector<SceneEntry> shared = shared_entries(panels);
  for (const Scene& panel : panels)
    for (const SceneEntry& entry : entries_of(panel)) {
      const bool is_free = of_methods.contains(entry.key) || !find_key(entry.key)->is_captioned;
      if (!is_free && std::find(shared.begin(), shared.end(), entry) == shared.end()) return false;
    }
  return true;
}

void name_panels(std::vector<Scene>& panels, const CoordinateUnits& units) {
  if (panels.empty()) return;
  const std::vector<std::string> titles = titles_of(panels, units);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (!panels[i].title.empty()) continue;
    const bool is_alone = std::ranges::count(titles, titles[i]) == 1;
    const std::string number = std::to_string(i + 1);
    panels[i].title = titles[i].empty() ? "panel " + number : is_alone ? titles[i] : titles[i] + " (" + number + ")";
  }
}

}  // namespace chainreel
