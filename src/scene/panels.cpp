#include "scene/panels.hpp"

#include <algorithm>
#include <filesystem>

#include "scene/write_scene.hpp"

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

std::string words_of(const SceneEntry& entry) {
  const std::string value = in_words(entry.text);
  if (entry.key == "method") return value;
  if (entry.key == "model") return std::filesystem::path(entry.text).stem().string();
  if (entry.key == "step") return "step " + value + " s";
  if (entry.key == "tolerance" || entry.key == "order" || entry.key == "accuracy")
    return entry.key + " " + value;
  if (entry.key == "torque") return "\u03C4 = " + value;
  if (entry.key == "start.q") return "q(0) = " + value;
  if (entry.key == "start.qd") return "qd(0) = " + value;
  return entry.key.substr(entry.key.find('.') + 1) + " = " + value;
}

std::string title_of(const Scene& panel, const std::vector<SceneEntry>& shared) {
  std::string title;
  for (const SceneEntry& entry : entries_of(panel)) {
    if (entry.key == "expect" || std::find(shared.begin(), shared.end(), entry) != shared.end()) continue;
    title += (title.empty() ? "" : ", ") + words_of(entry);
  }
  return title;
}

}  // namespace

void name_panels(std::vector<Scene>& panels) {
  if (panels.empty()) return;
  const std::vector<SceneEntry> shared = shared_entries(panels);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (!panels[i].title.empty()) continue;
    const std::string title = title_of(panels[i], shared);
    panels[i].title = title.empty() ? "panel " + std::to_string(i + 1) : title;
  }
}

}  // namespace chainreel
