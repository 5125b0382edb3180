#include "scene/text/leaf_words.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>

#include <yaml-cpp/yaml.h>

#include "core/format.hpp"
#include "scene/text/element_words.hpp"

namespace chainreel {
namespace {

using Leaves = std::map<std::string, std::vector<std::string>>;  // {"pd.kp", {"10"}}
enum class LeafForm { value, path, word };

// A value deep within a key: by the end of the way to it.
struct LeafRow {
  std::string_view key, way;
  ListName name;
  std::string unit;
  LeafForm form = LeafForm::value;
};
const std::vector<LeafRow>& leaf_rows() {
  static const std::vector<LeafRow> rows{
      {"torque", "task.kp", {"$k_p$", "$k_{p, #}$"}, "N/m"},
      {"torque", "task.kd", {"$k_d$", "$k_{d, #}$"}, "N s/m"},
      {"torque", "kp", {"$k_p$", "$k_{p, #}$"}, ""},
      {"torque", "kd", {"$k_d$", "$k_{d, #}$"}, ""},
      {"torque", "q", {"$q_{ref}$", "$q_{ref, #}$"}, "q"},
      {"torque", "qd", {"$qd_{ref}$", "$qd_{ref, #}$"}, "qd"},
      {"torque", "qdd", {"$qdd_{ref}$", "$qdd_{ref, #}$"}, "qdd"},
      {"torque", "x", {"$x_{ref}$", "$#_{ref}$", true}, "m"},
      {"torque", "xd", {"$xd_{ref}$", "$#d_{ref}$", true}, "m/s"},
      {"torque", "frame", {"at @", ""}, "", LeafForm::word},
      {"torque", "plus", {"plus @", "$tau_#$ plus @"}, "tau"},
      {"torque", "csv", {"torques @", ""}, "", LeafForm::path},
      {"torque", "inverse_of", {"torques of @", ""}, "", LeafForm::path},
      {"torque", "trajectory", {"motion @", ""}, "", LeafForm::path},
      {"torque", "outside", {"table: @", ""}, "", LeafForm::word},
      {"motion", "csv", {"motion @", ""}, "", LeafForm::path},
      {"push", "force", {"push @", "push $F_#$", true}, "N"},
      {"push", "frame", {"push at @", ""}, "", LeafForm::word},
      {"push", "from", {"push from @", ""}, "s"},
      {"push", "until", {"push until @", ""}, "s"},
      {"contact_force", "force", {"contact force @", "contact force $F_#$", true}, "N"},
      {"contact_force", "constraint", {"contact force on constraint @", ""}, ""},
      {"constraints", "point", {"through @", "through $#$", true}, "m"},
      {"constraints", "at", {"at @", "at $#$", true}, "m"},
      {"constraints", "direction", {"along @", "along $#$", true}, ""},
      {"constraints", "normal", {"normal @", "normal $n_#$", true}, ""},
      {"constraints", "length", {"length @", ""}, "m"},
      {"constraints", "frame", {"of @", ""}, "", LeafForm::word},
      {"constraints", "a", {"of @", ""}, "", LeafForm::word},
      {"constraints", "b", {"to @", ""}, "", LeafForm::word},
      {"constraints", "name", {"joint @", ""}, "", LeafForm::word},
      {"events", "when", {"event @", ""}, ""},
      {"events", "name", {"event @", ""}, "", LeafForm::word},
      {"model", "links", {"$l$", "$l_#$"}, "m"},
      {"model", "masses", {"$m$", "$m_#$"}, "kg"},
      {"model", "joints", {"joints @", ""}, "", LeafForm::word},
      {"model", "shape", {"mass as @", ""}, "", LeafForm::word},
      {"model", "damping", {"damping", ""}, "N m s/rad"},
      {"model", "efforts", {"effort", ""}, "N m"},
  };
  return rows;
}

// A part of a control, as its title has it.
struct PartName {
  std::string_view key, words;
};
constexpr std::array<PartName, 8> kParts{{{"csv", "torques of a table"}, {"inverse_of", "inverse dynamics"}, {"pd", "PD"},
                                          {"computed_torque", "computed torque"}, {"task", "task-space PD"},
                                          {"gravity_compensation", "gravity compensation"}, {"plus", "expression"}, {"function", "function"}}};

std::string last_part(const std::string& way) { return way.substr(way.rfind('.') + 1); }

bool ends_with_way(const std::string& way, std::string_view end) {
  return way.ends_with(end) && (way.size() == end.size() || way[way.size() - end.size() - 1] == '.');
}

std::string scalar_text(const YAML::Node& node) {
  if (node.IsScalar()) return node.Scalar();
  YAML::Emitter text;
  text << YAML::Flow << node;
  std::string words = text.c_str();
  std::ranges::replace(words, '[', '(');
  std::ranges::replace(words, ']', ')');
  return words;
}

void add_leaves(const YAML::Node& node, const std::string& way, Leaves& leaves) {
  const auto within = [&](const std::string& name) { return (way.empty() ? "" : way + ".") + name; };
  if (node.IsMap()) {
    for (const auto& entry : node) add_leaves(entry.second, within(entry.first.Scalar()), leaves);
  } else if (node.IsSequence() && std::any_of(node.begin(), node.end(), [](const auto& one) { return one.IsMap(); })) {
    for (std::size_t i = 0; i < node.size(); ++i) add_leaves(node[i], within(std::to_string(i + 1)), leaves);
  } else if (node.IsSequence()) {
    std::vector<std::string>& list = leaves[way];
    for (const YAML::Node& one : node) list.push_back(scalar_text(one));
  } else {
    leaves[way] = {scalar_text(node)};
  }
}

// What a panel's value of a key is, in words, beside which numbers tell panels of one kind apart.
std::string kind_of(const std::string& key, const SceneEntry* entry) {
  if (entry == nullptr || entry->text == "[]") return key == "torque" ? "no torque" : key == "motion" ? "computed" : key == "contact_force" ? "no contact force" : "no " + key;
  const YAML::Node node = YAML::Load(entry->text);
  if (!node.IsMap() && !(node.IsSequence() && node.size() > 0 && node[0].IsMap())) return "";
  std::vector<std::string> words;
  if (key == "torque" && node.IsMap()) {
    for (const PartName& part : kParts)
      if (node[std::string(part.key)]) words.emplace_back(part.words);
  } else if (key == "constraints") {
    for (const YAML::Node& one : node) words.push_back(one.begin()->first.Scalar());
  } else if (key == "push" || key == "events") {
    const std::size_t count = node.IsMap() ? 1 : node.size();
    return count == 1 ? (key == "push" ? "push" : "event") : std::to_string(count) + (key == "push" ? " pushes" : " events");
  } else {
    return key == "motion" ? "motion" : key == "contact_force" ? "contact force" : key == "model" ? "links" : key;
  }
  return joined(words, " + ");
}

// Of a slider among turning joints a model in numbers has units of its own.
std::string unit_of_leaf(const LeafRow& row, const Leaves& leaves) {
  if (row.key != "model" || (row.unit != "N m" && row.unit != "N m s/rad")) return row.unit;
  const auto joints = leaves.find("joints");
  const std::string letters = joints == leaves.end() ? "R" : joints->second.front();
  if (letters.find('P') == std::string::npos) return row.unit;
  if (letters.find('R') != std::string::npos) return "";
  return row.unit == "N m" ? "N" : "N s/m";
}

std::vector<TitleValue> values_of_leaf(const std::vector<std::string>& texts, const LeafRow* row, const std::string& way, const Leaves& leaves,
                                       const CoordinateUnits& units) {
  std::vector<TitleValue> values;
  // One for all: in the unit of all where that is one.
  const bool is_for_all = texts.size() == 1;
  const bool is_mixed = std::ranges::any_of(units.q, [&](const std::string& one) { return one != units.q.front(); });
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (row != nullptr && row->form == LeafForm::path)
      values.push_back({std::filesystem::path(texts[i]).stem().string(), ""});
    else if (row != nullptr && row->form == LeafForm::word)
      values.push_back({texts[i], ""});
    else if (row != nullptr)
      values.push_back(title_value(texts[i], is_for_all && is_mixed && (row->unit == "q" || row->unit == "qd" || row->unit == "tau") ? "" : unit_at(unit_of_leaf(*row, leaves), i, units)));
    else if (const auto name = leaves.find(way.substr(0, way.rfind('.') + 1) + "name"); name != leaves.end() && units.by_name.contains(name->second.front()))
      values.push_back(title_value(texts[i], units.by_name.at(name->second.front())));
    else
      values.push_back(title_value(texts[i], ""));
  }
  // "60" of (60, 60), as one number for all becomes.
  if (values.size() > 1 && std::ranges::all_of(values, [&](const TitleValue& one) { return one == values.front(); })) values.resize(1);
  return values;
}

// "joint 2" of "2.pd.kp", where names alone are two.
std::string place_in_words(const std::string& key, const std::string& way) {
  const std::string first = way.substr(0, way.find('.'));
  return parse_number(first) ? (key == "torque" ? "joint " : "") + first : first;
}

// What differs within these, which are of one kind.
std::vector<std::string> words_within(const std::string& key, const std::vector<const SceneEntry*>& entries, const CoordinateUnits& units) {
  std::vector<Leaves> all;
  for (const SceneEntry* entry : entries) add_leaves(YAML::Load(entry->text), "", all.emplace_back());
  std::set<std::string> ways;
  std::map<std::string, int> names;
  for (const Leaves& leaves : all)
    for (const auto& [way, texts] : leaves) {
      const bool is_shared = std::ranges::all_of(all, [&, &way = way, &texts = texts](const Leaves& other) {
        const auto known = other.find(way);
        return known != other.end() && known->second == texts;
      });
      if (!is_shared && ways.insert(way).second) ++names[last_part(way)];
    }
  std::vector<std::string> words(entries.size()), missing(entries.size());
  for (const std::string& way : ways) {
    const auto row = std::ranges::find_if(leaf_rows(), [&](const LeafRow& one) { return one.key == key && ends_with_way(way, one.way); });
    const bool is_told = row != leaf_rows().end();
    const auto owner = all.front().find(way.substr(0, way.rfind('.') + 1) + "name");
    const bool is_of_joint = last_part(way) == "value" && owner != all.front().end();
    const ListName name = is_told ? row->name : ListName{is_of_joint ? owner->second.front() : last_part(way), "", false};
    std::vector<std::size_t> having;
    std::vector<std::vector<TitleValue>> values;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const auto known = all[i].find(way); known != all[i].end()) {
        having.push_back(i);
        values.push_back(values_of_leaf(known->second, is_told ? &*row : nullptr, way, all[i], units));
      } else {
        missing[i] += (missing[i].empty() ? "no " : ", no ") + last_part(way);
      }
    const std::vector<std::string> own = words_of_lists(name, values);
    const std::string place = names[last_part(way)] > 1 ? " (" + place_in_words(key, way) + ")" : "";
    for (std::size_t k = 0; k < having.size(); ++k) words[having[k]] += (words[having[k]].empty() ? "" : ", ") + own[k] + place;
  }
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i].empty()) words[i] = missing[i];
  return words;
}

}  // namespace

std::vector<std::string> words_by_leaf(const std::vector<const Scene*>& panels, const std::vector<const SceneEntry*>& entries,
                                       const CoordinateUnits& units) {
  const auto first = std::ranges::find_if(entries, [](const SceneEntry* entry) { return entry != nullptr; });
  if (first == entries.end()) return {};
  static const std::set<std::string> of_kinds{"torque", "push", "motion", "constraints", "contact_force", "events", "model"};
  const std::string key = (*first)->key;
  if (!of_kinds.contains(key)) return {};
  std::vector<std::string> kinds;
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    kinds.push_back(kind_of(key, entries[i]));
    groups[kinds.back()].push_back(i);
  }
  if (groups.size() == 1 && kinds.front().empty()) return {};
  std::vector<std::string> words(entries.size());
  for (const auto& [kind, places] : groups) {
    std::vector<const SceneEntry*> own;
    std::vector<const Scene*> own_panels;
    for (const std::size_t i : places) own.push_back(entries[i]), own_panels.push_back(panels[i]);
    std::vector<std::string> within(places.size());
    if (kind.empty()) {
      within = words_by_element(own_panels, own, units);
      if (within.empty())
        for (const SceneEntry* entry : own) within.push_back(key == "torque" ? "\u03C4 = " + title_value(scalar_text(YAML::Load(entry->text)), "").words
                                           : (key == "motion" ? "motion " : "") + std::filesystem::path(entry->text).stem().string());
    } else if (places.size() > 1 && kind.find("no ") != 0 && own.front() != nullptr) {
      within = words_within(key, own, units);
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      const std::string told = groups.size() > 1 ? kind : "";
      words[places[k]] = told + (told.empty() || within[k].empty() ? "" : ", ") + within[k];
    }
  }
  return words;
}

}  // namespace chainreel
