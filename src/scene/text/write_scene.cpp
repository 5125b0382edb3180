#include "scene/text/write_scene.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "core/json.hpp"
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

namespace {

namespace fs = std::filesystem;

struct Scalar {
  std::string value;
};
using Found = std::map<std::size_t, Scalar>;  // by its place in the text

void find_paths(const YAML::Node& node, bool is_path, Found& found) {
  if (node.IsScalar()) {
    if (is_path && !node.Scalar().empty() && !fs::path(node.Scalar()).is_absolute())
      found[std::size_t(node.Mark().pos)] = {node.Scalar()};
  } else if (node.IsSequence()) {
    for (const YAML::Node& child : node) find_paths(child, false, found);
  } else if (node.IsMap()) {
    for (const auto& pair : node) {
      const std::string& key = pair.first.Scalar();
      // Parameters may bear any name; they are numbers.
      if (key == "parameters") continue;
      if (key == "packages" && pair.second.IsMap()) {
        for (const auto& package : pair.second) find_paths(package.second, true, found);
        continue;
      }
      const bool named = std::find(path_keys().begin(), path_keys().end(), key) != path_keys().end();
      find_paths(pair.second, named && pair.second.IsScalar(), found);
    }
  }
}

// Characters that the scalar takes in the text, with its quotes.
std::size_t length_of(const std::string& text, std::size_t at, const Scalar& scalar) {
  if (text[at] != '"') return scalar.value.size();
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
  return end + 1 - at;
}

}  // namespace

std::string moved_scene_text(const std::string& text, const std::string& to) {
  const fs::path folder = to.empty() ? fs::path(".") : fs::path(to);
  Found found;
  try {
    find_paths(YAML::Load(text), false, found);
  } catch (const YAML::Exception& error) {
    throw Error(ExitCode::bad_input, "the scene is not valid YAML: " + error.msg);
  }
  std::string moved = text;
  for (auto one = found.rbegin(); one != found.rend(); ++one) {
    const auto& [at, scalar] = *one;
    // Absolute first: of a folder that is not there yet, a relative path stays as it is.
    std::error_code code;  // names too long, loops of links: such a path stays as it is
    std::string path = fs::proximate(fs::absolute(scalar.value, code), fs::absolute(folder, code), code).string();
    if (code) path = scalar.value;
    moved.replace(at, length_of(moved, at, scalar), Json(path).dump());  // a JSON text is YAML too
  }
  return moved;
}

}  // namespace chainreel
