#include "scene/text/write_scene.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "scene/keys/keys.hpp"
#include "scene/keys/own_keys.hpp"

namespace chainreel {

std::string in_one_line(const YAML::Emitter& out) {
  std::string text = out.c_str();
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) {
    const std::size_t end = text.find_first_not_of(" \n", at);
    text.replace(at, end - at, " ");
  }
  return text;
}

std::string word_text(const std::string& word) {
  return flow_text([&](YAML::Emitter& out) { out << word; });
}

std::string quoted_text(const std::string& words) {
  return flow_text([&](YAML::Emitter& out) { out << YAML::DoubleQuoted << words; });
}

namespace {

bool holds(const std::vector<SceneEntry>& entries, const SceneEntry& entry) {
  return std::find(entries.begin(), entries.end(), entry) != entries.end();
}

// Lines `key: value`; neighbours below one key share its line: `video: {width: 640, height: 360}`.
std::string lines_of(const std::vector<SceneEntry>& entries) {
  std::string text, open;
  for (const SceneEntry& entry : entries) {
    const std::size_t dot = entry.key.find('.');
    const std::string group = dot == std::string::npos ? "" : entry.key.substr(0, dot);
    if (!open.empty() && group != open) text += "}\n";
    if (group.empty())
      text += entry.key + ": " + entry.text + "\n";
    else
      text += (group == open ? ", " : group + ": {") + entry.key.substr(dot + 1) + ": " + entry.text;
    open = group;
  }
  return text + (open.empty() ? "" : "}\n");
}

std::string panel_text(const Scene& panel, const std::vector<SceneEntry>& shared) {
  std::string text = "  - title: " + quoted_text(panel.title) + "\n";
  for (const SceneEntry& entry : entries_of(panel))
    if (!holds(shared, entry)) text += "    " + entry.key + ": " + entry.text + "\n";
  return text;
}

}  // namespace

std::vector<SceneEntry> entries_of(const Scene& scene) {
  std::vector<SceneEntry> entries;
  for (const SceneKey& key : scene_keys())
    if (key.of == KeyOf::panel) key.write(key, scene, entries);
  return entries;
}

std::vector<SceneEntry> shared_entries(const std::vector<Scene>& panels) {
  std::vector<SceneEntry> shared = entries_of(panels.front());
  for (const Scene& panel : panels) {
    const std::vector<SceneEntry> own = entries_of(panel);
    std::erase_if(shared, [&](const SceneEntry& entry) { return !holds(own, entry); });
  }
  return shared;
}

std::string scene_text(const Scene& scene) {
  const Scene& first = scene.compare.empty() ? scene : scene.compare.front();
  const std::vector<SceneEntry> shared = scene.compare.empty() ? entries_of(scene) : shared_entries(scene.compare);
  std::vector<SceneEntry> entries{{"title", quoted_text(scene.title)}};
  for (const SceneKey& key : scene_keys()) {
    if (key.name == "title") continue;
    std::vector<SceneEntry> own;
    key.write(key, key.of == KeyOf::page ? scene : first, own);
    if (key.of == KeyOf::panel) std::erase_if(own, [&](const SceneEntry& entry) { return !holds(shared, entry); });
    entries.insert(entries.end(), own.begin(), own.end());
  }
  std::string text = lines_of(entries);
  if (!scene.compare.empty()) text += "compare:\n";
  for (const Scene& panel : scene.compare) text += panel_text(panel, shared);
  return text;
}

}  // namespace chainreel
