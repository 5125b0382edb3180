#include "scene/text/panels.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "core/format.hpp"
#include "integrate/method.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/write_scene.hpp"

namespace chainreel {
namespace {

// A list as one writes a vector: (1, 0).
std::string in_words(std::string text) {
  if (text.starts_with('[') && text.ends_with(']')) {
    text.front() = '(';
    text.back() = ')';
  }
  return text;
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

std::string title_of(const Scene& panel, const std::vector<SceneEntry>& shared) {
  std::string title;
  for (const SceneEntry& entry : entries_of(panel)) {
    if (!find_key(entry.key)->is_captioned || std::find(shared.begin(), shared.end(), entry) != shared.end()) continue;
    title += (title.empty() ? "" : ", ") + words_of(entry);
  }
  return title;
}

}  // namespace

void name_panels(std::vector<Scene>& panels) {
  if (panels.empty()) return;
  const std::vector<SceneEntry> shared = shared_entries(panels);
  std::vector<std::string> titles;
  std::set<std::string> short_ones;
  for (const Scene& panel : panels) {
    titles.push_back(title_of(panel, shared));
    short_ones.insert(rounded(titles.back()));
  }
  const bool told_apart = short_ones.size() == panels.size();
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (!panels[i].title.empty()) continue;
    const std::string title = told_apart ? rounded(titles[i]) : titles[i];
    panels[i].title = title.empty() ? "panel " + std::to_string(i + 1) : title;
  }
}

}  // namespace chainreel
