#include "scene/text/panels.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include <yaml-cpp/yaml.h>

#include "core/format.hpp"
#include "integrate/method.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/element_words.hpp"
#include "scene/text/write_scene.hpp"

namespace chainreel {
namespace {

// A list as one writes a vector: (1, 0).
// Without braces, which a title fills.
std::string in_words(std::string text) {
  std::erase_if(text, [](char c) { return c == '{' || c == '}'; });
  if (text.starts_with('[') && text.ends_with(']')) {
    text.front() = '(';
    text.back() = ')';
  }
  return with_minus_signs(text);
}

// Numbers of more digits than one reads, such as those of degrees in rad, with four of them.
std::string rounded(const std::string& text) {
  constexpr std::size_t kReadable = 7;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) || text[end] == '.')) ++end;
    const std::string word = text.substr(i, std::max<std::size_t>(end - i, 1));
    const bool is_long = word.size() > kReadable && word.find('.') != std::string::npos;
    const std::optional<double> number = is_long ? parse_number(word) : std::nullopt;
    result += number ? format_significant(*number, 4) : word;
    i += word.size();
  }
  return result;
}

std::string words_of(const SceneEntry& entry) {
  const SceneKey& key = *find_key(entry.key);
  if (key.form == KeyForm::path) return std::filesystem::path(entry.text).stem().string();
  const std::string value = entry.key == "method" ? method_title(entry.text) : in_words(entry.text);
  if (key.caption.empty()) return entry.key.substr(entry.key.find('.') + 1) + " = " + value;
  std::string words = key.caption;
  return words.replace(words.find('@'), 1, value);
}

// The values within a mapping, each by the way to it: {"pd.kp", "10"}.
void add_leaves(const YAML::Node& node, const std::string& way, std::map<std::string, std::string>& leaves) {
  if (!node.IsMap()) {
    YAML::Emitter text;
    text << YAML::Flow << node;
    leaves[way] = node.IsScalar() ? node.Scalar() : text.c_str();
    return;
  }
  for (const auto& entry : node)
    add_leaves(entry.second, (way.empty() ? "" : way + ".") + entry.first.Scalar(), leaves);
}

using Leaves = std::map<std::string, std::string>;

std::string last_part(const std::string& way) {
  return way.substr(way.rfind('.') + 1);
}

// As in_words, but a list of equal entries, as one number for all becomes, as that entry.
std::string leaf_in_words(const std::string& text) {
  if (!text.starts_with('[') || !text.ends_with(']')) return in_words(text);
  const YAML::Node list = YAML::Load(text);
  for (const YAML::Node& one : list)
    if (!one.IsScalar() || one.Scalar() != list[0].Scalar()) return in_words(text);
  return list.size() == 0 ? in_words(text) : list[0].Scalar();
}

// What a key says of each panel, where it says a mapping of all: only what differs in it, "kp = 10" rather than all of the
// torque, by the whole way where two values have one name. Empty where it is no mapping of all panels.
std::vector<std::string> words_within(const std::vector<const SceneEntry*>& entries) {
  std::vector<Leaves> all;
  for (const SceneEntry* entry : entries) {
    if (entry == nullptr || !entry->text.starts_with('{')) return {};
    add_leaves(YAML::Load(entry->text), "", all.emplace_back());
  }
  std::set<std::string> ways;
  std::map<std::string, int> names;
  for (const Leaves& leaves : all)
    for (const auto& [way, text] : leaves) {
      const bool is_shared = std::all_of(all.begin(), all.end(), [&, &way = way, &text = text](const Leaves& other) {
        const auto known = other.find(way);
        return known != other.end() && known->second == text;
      });
      if (!is_shared && ways.insert(way).second) ++names[last_part(way)];
    }
  std::vector<std::string> words;
  for (const Leaves& leaves : all) {
    std::string& own = words.emplace_back();
    for (const std::string& way : ways) {
      const std::string name = names[last_part(way)] > 1 ? way : last_part(way);
      const auto known = leaves.find(way);
      own += (own.empty() ? "" : ", ") + (known == leaves.end() ? "no " + name : symbol_of_gain(name) + " = " + leaf_in_words(known->second));
    }
  }
  return words;
}

// By what they differ in, key by key.
std::vector<std::string> titles_of(const std::vector<Scene>& panels) {
  const std::vector<SceneEntry> shared = shared_entries(panels);
  std::vector<std::vector<SceneEntry>> own;
  for (const Scene& panel : panels) {
    own.push_back(entries_of(panel));
    std::erase_if(own.back(), [&](const SceneEntry& entry) {
      return !find_key(entry.key)->is_captioned || std::find(shared.begin(), shared.end(), entry) != shared.end();
    });
  }
  const auto find = [](const std::vector<SceneEntry>& entries, const std::string& key) {
    const auto entry = std::find_if(entries.begin(), entries.end(), [&](const SceneEntry& one) { return one.key == key; });
    return entry == entries.end() ? nullptr : &*entry;
  };
  std::vector<std::string> titles;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    std::string& title = titles.emplace_back();
    for (const SceneEntry& entry : own[i]) {
      std::vector<const SceneEntry*> of_all;
      for (const auto& entries : own) of_all.push_back(find(entries, entry.key));
      std::vector<std::string> within = words_by_element(panels, of_all);
      if (within.empty()) within = words_within(of_all);
      const std::string words = within.empty() ? words_of(entry) : within[i];
      if (!words.empty()) title += (title.empty() ? "" : ", ") + words;
    }
  }
  return titles;
}

}  // namespace

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

void name_panels(std::vector<Scene>& panels) {
  if (panels.empty()) return;
  const std::vector<std::string> titles = titles_of(panels);
  std::set<std::string> short_ones;
  for (const std::string& title : titles) short_ones.insert(rounded(title));
  const bool told_apart = short_ones.size() == panels.size();
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (!panels[i].title.empty()) continue;
    const std::string title = told_apart ? rounded(titles[i]) : titles[i];
    panels[i].title = title.empty() ? "panel " + std::to_string(i + 1) : title;
  }
}

}  // namespace chainreel
