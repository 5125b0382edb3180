#include "scene/text/element_words.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <yaml-cpp/yaml.h>

#include "core/format.hpp"

namespace chainreel {
namespace {

using Values = std::vector<TitleValue>;

// A list's name, and the unit of its numbers.
struct ListWords {
  std::string_view key;
  ListName name;
  std::string unit;
};
const std::array<ListWords, 5>& list_words() {
  static const std::array<ListWords, 5> rows{{{"start.q", {"q(0)", "$q_#(0)$"}, "q"},
                                              {"start.qd", {"$qd(0)$", "$qd_#(0)$"}, "qd"},
                                              {"torque", {"\u03C4", "$tau_#$"}, "tau"},
                                              {"gravity", {"g", "$g_#$", true}, "m/s\u00B2"},
                                              {"payload.at", {"payload at @", "payload at $#$", true}, "m"}}};
  return rows;
}

// A number as it was written, "30deg"; nothing of an expression, or with another unit.
std::optional<std::string> as_written(const std::string& text) {
  for (const std::string_view unit : {"deg/s", "deg", ""})
    if (text.ends_with(unit)) return parse_number(trimmed(text.substr(0, text.size() - unit.size()))) ? std::optional(text) : std::nullopt;
  return {};
}

Values values_of(const SceneEntry& entry, const std::vector<std::string>* written, const std::string& unit, const CoordinateUnits& units) {
  if (!entry.text.starts_with('[')) return {};
  Values values;
  const YAML::Node list = YAML::Load(entry.text);
  for (const YAML::Node& one : list) {
    if (!one.IsScalar()) return {};
    const std::size_t i = values.size();
    const std::optional<std::string> own = written != nullptr && i < written->size() ? as_written((*written)[i]) : std::nullopt;
    values.push_back(title_value(own ? *own : one.Scalar(), unit_at(unit, i, units)));
  }
  return values;
}

bool is_left_out(const SceneEntry* entry) { return entry == nullptr || entry->text == "[]"; }

// Lists that are left out are zero, those of starts and torques.
std::vector<Values> values_of_all(const std::vector<const Scene*>& panels, const std::vector<const SceneEntry*>& entries, const ListWords& list,
                                  const CoordinateUnits& units) {
  std::vector<Values> all;
  std::size_t length = 0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Values& own = all.emplace_back();
    if (is_left_out(entries[i])) continue;
    const StartState& start = panels[i]->start;
    own = values_of(*entries[i], list.key == "start.q" ? &start.written_q : list.key == "start.qd" ? &start.written_qd : nullptr, list.unit, units);
    if (own.empty() || (length > 0 && own.size() != length)) return {};
    length = own.size();
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_left_out(entries[i])) {
      if (!list.key.starts_with("start.")) return {};
      for (std::size_t e = 0; e < length; ++e) all[i].push_back(title_value("0", unit_at(list.unit, e, units)));
    }
  // A zero among degrees is one of degrees.
  const auto is_in_degrees = [](const TitleValue& one) { return one.words.ends_with("\u00B0"); };
  for (std::size_t e = 0; e < length; ++e)
    if (std::ranges::any_of(all, [&](const Values& one) { return is_in_degrees(one[e]); }))
      for (Values& one : all)
        if (one[e].words == "0") one[e].words += "\u00B0";
  return all;
}

bool is_zero(const TitleValue& value) { return value.words == "0"; }

// Straight down, as gravity mostly is, its size alone.
bool points_down_alone(const std::vector<Values>& all) {
  std::optional<std::size_t> down;
  for (const Values& one : all)
    for (std::size_t e = 0; e < one.size(); ++e) {
      if (is_zero(one[e])) continue;
      if (!one[e].words.starts_with("\u2212") || down.value_or(e) != e) return false;
      down = e;
    }
  return down.has_value();
}

std::string size_of(const Values& down) {
  for (TitleValue one : down)
    if (!is_zero(one)) {
      one.words = one.words.substr(std::string_view("\u2212").size());
      return joined_value(one);
    }
  return joined_value(down.front());
}

std::string named(const std::string& name, const std::string& value) {
  const std::size_t at = name.find('@');
  return at == std::string::npos ? name + " = " + value : std::string(name).replace(at, 1, value);
}

std::string index_in_words(std::size_t e, bool is_axis) {
  if (is_axis) return std::string(1, "xyz"[std::min<std::size_t>(e, 2)]);
  return e < 9 ? std::to_string(e + 1) : "{" + std::to_string(e + 1) + "}";
}

}  // namespace

std::string unit_at(const std::string& unit, std::size_t index, const CoordinateUnits& units) {
  if (unit == "q") return index < units.q.size() ? units.q[index] : "";
  if (unit != "qd" && unit != "qdd" && unit != "tau") return unit;
  if (index >= units.freedoms.size()) return "";
  const std::string& own = units.freedoms[index];
  return unit == "tau" ? (own == "rad" ? "N m" : "N") : own + (unit == "qd" ? "/s" : "/s\u00B2");
}

std::vector<std::string> words_of_lists(const ListName& name, const std::vector<std::vector<TitleValue>>& all) {
  const std::size_t length = all.front().size();
  const bool are_equally_long = length > 0 && std::ranges::all_of(all, [&](const Values& one) { return one.size() == length; });
  std::vector<std::size_t> differing;
  for (std::size_t e = 0; are_equally_long && e < length; ++e)
    if (std::ranges::any_of(all, [&](const Values& one) { return one[e] != all.front()[e]; })) differing.push_back(e);
  const bool is_whole = !are_equally_long || differing.empty() || length == 1 || (differing.size() == length && differing.size() > 1);
  std::vector<std::string> words;
  for (const Values& one : all) {
    std::string& own = words.emplace_back();
    // One number for all, or equal ones.
    const bool is_one = !one.empty() && std::ranges::all_of(one, [&](const TitleValue& value) { return value == one.front(); }) && name.element.empty();
    if (is_whole) {
      own = named(name.whole, one.size() == 1 || is_one ? joined_value(one.front()) : joined_values(one));
      continue;
    }
    for (const std::size_t e : differing) {
      std::string element = name.element.empty() ? name.whole + " " + std::to_string(e + 1) : name.element;
      if (const std::size_t at = element.find('#'); at != std::string::npos) element.replace(at, 1, index_in_words(e, name.has_axes));
      own += (own.empty() ? "" : ", ") + named(element, joined_value(one[e]));
    }
  }
  return words;
}

std::vector<std::string> words_by_element(const std::vector<const Scene*>& panels, const std::vector<const SceneEntry*>& entries,
                                          const CoordinateUnits& units) {
  const auto first = std::ranges::find_if(entries, [](const SceneEntry* entry) { return entry != nullptr; });
  const auto list = first == entries.end() ? list_words().end() : std::ranges::find(list_words(), (*first)->key, &ListWords::key);
  if (list == list_words().end()) return {};
  const std::vector<Values> all = values_of_all(panels, entries, *list, units);
  if (all.empty() || all.front().empty()) return {};
  if (list->key != "gravity" || !points_down_alone(all)) return words_of_lists(list->name, all);
  std::vector<std::string> words;
  for (const Values& one : all) words.push_back("$g$ = " + size_of(one));
  return words;
}

}  // namespace chainreel
