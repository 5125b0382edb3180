#include "scene/text/element_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>

#include <yaml-cpp/yaml.h>

#include "core/format.hpp"

namespace chainreel {
namespace {

using Elements = std::vector<std::string>;

constexpr std::string_view kDegrees = "deg", kDegreeSign = "\u00B0";
constexpr int kDigits = 4;  // of numbers that nobody wrote

// A list's symbol, that of its elements around their index, and a unit.
struct ListWords {
  std::string_view key, whole, before, behind, unit;
};
constexpr std::array<ListWords, 4> kLists{{{"start.q", "q(0)", "q_", "(0)", ""},
                                           {"start.qd", "$qd(0)$", "qd_", "(0)", ""},
                                           {"torque", "\u03C4", "tau_", "", ""},
                                           {"gravity", "g", "g_", "", " m/s\u00B2"}}};

// A number as it was written, "30deg" as 30 with its sign; nothing of an expression.
std::optional<std::string> as_written(std::string text) {
  const bool is_in_degrees = text.ends_with(kDegrees);
  if (is_in_degrees) text = trimmed(text.substr(0, text.size() - kDegrees.size()));
  const std::optional<double> number = parse_number(text);
  if (!number) return {};
  return with_minus_signs(text) + std::string(is_in_degrees ? kDegreeSign : "");
}

Elements elements_of(const SceneEntry& entry, const std::vector<std::string>* written) {
  if (!entry.text.starts_with('[')) return {};
  Elements elements;
  const YAML::Node list = YAML::Load(entry.text);
  for (const YAML::Node& one : list) {
    const std::optional<double> number = one.IsScalar() ? parse_number(one.Scalar()) : std::nullopt;
    if (!number) return {};
    const std::size_t i = elements.size();
    const std::optional<std::string> own = written != nullptr && written->size() == list.size() ? as_written((*written)[i]) : std::nullopt;
    elements.push_back(own ? *own : with_minus_signs(format_significant(*number, kDigits)));
  }
  return elements;
}

std::vector<Elements> elements_of_all(const std::vector<Scene>& panels, const std::vector<const SceneEntry*>& entries) {
  std::vector<Elements> all;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (entries[i] == nullptr) return {};
    const StartState& start = panels[i].start;
    const std::string& key = entries[i]->key;
    all.push_back(elements_of(*entries[i], key == "start.q" ? &start.written_q : key == "start.qd" ? &start.written_qd : nullptr));
    if (all.back().empty() || all.back().size() != all.front().size()) return {};
  }
  // A zero among degrees is one of degrees.
  for (std::size_t e = 0; e < all.front().size(); ++e)
    if (std::ranges::any_of(all, [e](const Elements& one) { return one[e].ends_with(kDegreeSign); }))
      for (Elements& one : all)
        if (one[e] == "0") one[e] += kDegreeSign;
  return all;
}

std::string joined_vector(const Elements& elements) {
  return "(" + joined(elements) + ")";
}

// Straight down, as gravity mostly is, its size alone.
bool points_down_alone(const std::vector<Elements>& all) {
  std::optional<std::size_t> down;
  for (const Elements& one : all)
    for (std::size_t e = 0; e < one.size(); ++e) {
      if (one[e] == "0") continue;
      if (!one[e].starts_with("\u2212") || down.value_or(e) != e) return false;
      down = e;
    }
  return down.has_value();
}

std::string size_of(const Elements& down) {
  for (const std::string& one : down)
    if (one != "0") return one.substr(std::string_view("\u2212").size());
  return "0";
}

}  // namespace

std::string symbol_of_gain(const std::string& name) {
  const bool is_gain = name.size() == 2 && name[0] == 'k' && (name[1] == 'p' || name[1] == 'd' || name[1] == 'i');
  return is_gain ? std::string("$k_") + name[1] + "$" : name;
}

std::string with_minus_signs(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == ' ' || text[i - 1] == '(';
    const bool leads = i + 1 < text.size() && (std::isdigit(static_cast<unsigned char>(text[i + 1])) || text[i + 1] == '.');
    if (text[i] == '-' && begins && leads)
      result += "\u2212";
    else
      result += text[i];
  }
  return result;
}

std::vector<std::string> words_by_element(const std::vector<Scene>& panels, const std::vector<const SceneEntry*>& entries) {
  const auto first = std::ranges::find_if(entries, [](const SceneEntry* entry) { return entry != nullptr; });
  const auto list = first == entries.end() ? kLists.end() : std::ranges::find(kLists, (*first)->key, &ListWords::key);
  if (list == kLists.end()) return {};
  const std::vector<Elements> all = elements_of_all(panels, entries);
  if (all.empty()) return {};
  std::vector<std::size_t> differing;
  for (std::size_t e = 0; e < all.front().size(); ++e)
    if (std::ranges::any_of(all, [&](const Elements& one) { return one[e] != all.front()[e]; })) differing.push_back(e);
  if (differing.empty()) return {};
  const bool is_gravity = list->key == "gravity", is_down = is_gravity && points_down_alone(all);
  const bool is_whole = differing.size() == all.front().size() && differing.size() > 1;
  std::vector<std::string> words;
  for (const Elements& one : all) {
    std::string& own = words.emplace_back();
    if (is_down) {
      own = "$g$ = " + size_of(one) + std::string(list->unit);
    } else if (is_whole) {
      own = std::string(list->whole) + " = " + joined_vector(one) + std::string(list->unit);
    } else {
      for (const std::size_t e : differing) {
        const std::string index = is_gravity ? std::string(1, "xyz"[std::min<std::size_t>(e, 2)]) : e < 9 ? std::to_string(e + 1) : "{" + std::to_string(e + 1) + "}";
        own += (own.empty() ? "" : ", ") + ("$" + std::string(list->before) + index + std::string(list->behind) + "$ = ") + one[e] + std::string(list->unit);
      }
    }
  }
  return words;
}

}  // namespace chainreel
