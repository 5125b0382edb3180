#include "scene/text/scene_paths.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "scene/keys/fields.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/write_scene.hpp"
#include "scene/yaml_document.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

using Visit = std::function<void(const YAML::Node& path)>;

void visit_paths(const YAML::Node& node, bool is_path, const Visit& visit) {
  if (node.IsScalar()) {
    if (is_path && !node.Scalar().empty()) visit(node);
  } else if (node.IsSequence()) {
    for (const YAML::Node& child : node) visit_paths(child, false, visit);
  } else if (node.IsMap()) {
    for (const auto& pair : node) {
      const std::string& key = pair.first.Scalar();
      // What bears names of one's own: parameters are numbers, columns words.
      if (key == "parameters" || key == "columns") continue;
      if (key == "packages" && pair.second.IsMap()) {
        for (const auto& package : pair.second) visit_paths(package.second, true, visit);
        continue;
      }
      const bool named = std::find(path_keys().begin(), path_keys().end(), key) != path_keys().end();
      visit_paths(pair.second, named && pair.second.IsScalar(), visit);
    }
  }
}

// By their places in the text.
std::map<std::size_t, std::string> paths_in(const std::string& text) {
  std::map<std::size_t, std::string> found;
  try {
    visit_paths(YAML::Load(text), false,
                [&](const YAML::Node& path) { found[std::size_t(path.Mark().pos)] = path.Scalar(); });
  } catch (const YAML::Exception& error) {
    throw Error(ExitCode::bad_input, "the scene is not valid YAML: " + error.msg);
  }
  return found;
}

// Where the scalar itself begins: behind an anchor's name or a tag.
std::size_t behind_properties(const std::string& text, std::size_t at) {
  while (text[at] == '&' || text[at] == '!') {
    at = text.find_first_of(" \t\r\n", at);
    at = text.find_first_not_of(" \t\r\n", at);
    if (at == std::string::npos) throw Error(ExitCode::bad_input, "a path of the scene has no end");
  }
  return at;
}

// Characters that the scalar takes in the text, with its quotes.
std::size_t length_of(const std::string& text, std::size_t at, const std::string& scalar) {
  const char quote = text[at];
  if (quote != '"' && quote != '\'') return scalar.size();
  std::size_t end = at + 1;
  while (end < text.size() && (text[end] != quote || (quote == '\'' && text[end + 1] == quote)))
    end += text[end] == quote || (quote == '"' && text[end] == '\\') ? 2 : 1;
  return end + 1 - at;
}

// Each path in the place of which `moved` puts another.
std::string with_paths(const std::string& text,
                       const std::function<std::optional<std::string>(const std::string&)>& moved) {
  std::string result = text;
  const auto found = paths_in(text);
  for (auto one = found.rbegin(); one != found.rend(); ++one)
    if (const std::optional<std::string> path = moved(one->second)) {
      const std::size_t at = behind_properties(text, one->first);
      result.replace(at, length_of(text, at, one->second), Json(*path).dump());  // a JSON text is YAML too
    }
  return result;
}

// A name of what comes with the program, in both folders.
bool stays_shipped(const std::string& path, const fs::path& from, const fs::path& to) {
  std::error_code ignored;
  return !shipped_input(path).empty() && !fs::exists(from / path, ignored) && !fs::exists(to / path, ignored);
}

// Whether the command line named it.
bool is_typed(const YamlDocument& document, const std::string& path) {
  return std::any_of(document.overrides.begin(), document.overrides.end(), [&](const Override& one) { return one.value.find(path) != std::string::npos; });
}

// Whether the scene is one of those that come with the program, and names their models by their places.
bool lies_among_shipped(const Scene& scene) {
  std::error_code ignored;
  const fs::path shipped = data_folder(), file = fs::absolute(scene.file, ignored).lexically_normal();
  return !shipped.empty() && std::mismatch(shipped.begin(), shipped.end(), file.begin(), file.end()).first == shipped.end();
}

}  // namespace

std::string scene_with_model(const std::string& text, const std::string& model) {
  return with_paths(text, [&](const std::string& path) -> std::optional<std::string> {
    return path.ends_with(".urdf") ? std::optional(model) : std::nullopt;
  });
}

std::string moved_scene_text(const std::string& text, const std::string& to, const std::string& from) {
  const fs::path folder = to.empty() ? fs::path(".") : fs::path(to);
  return with_paths(text, [&](const std::string& path) -> std::optional<std::string> {
    if (fs::path(path).is_absolute() || stays_shipped(path, from, folder)) return std::nullopt;
    // Absolute first: of a folder that is not there yet, a relative path stays as it is.
    std::error_code code;  // names too long, loops of links: such a path stays as it is
    const fs::path moved =
        fs::proximate(fs::absolute(fs::path(from) / path, code), fs::absolute(folder, code), code);
    return code ? path : moved.string();
  });
}

std::vector<std::string> relative_paths_in(const std::string& text) {
  std::vector<std::string> paths;
  for (const auto& [place, path] : paths_in(text))
    if (!fs::path(path).is_absolute() && std::find(paths.begin(), paths.end(), path) == paths.end())
      paths.push_back(path);
  return paths;
}

// By the names alone, not by what links lead to: links are copied as they are.
std::string path_from(const std::string& folder, const std::string& path) {
  if (path.empty()) return path;
  std::error_code code;
  const fs::path here = fs::current_path(code);
  if (code) return path;
  const fs::path start = (here / folder / "").lexically_normal(), target = (here / path).lexically_normal();
  const auto has_part_in_common = [](const fs::path& a, const fs::path& b) {  // beside the root
    const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    return std::distance(a.begin(), in_a) > 1;
  };
  if (fs::path(path).is_absolute() && !has_part_in_common(start, target)) return path;
  return target.lexically_relative(start.parent_path()).string();
}

std::string placeless_path(const Scene& scene, const std::string& path) {
  const std::vector<std::string>& kept = scene.absolute_paths;
  if (std::find(kept.begin(), kept.end(), path) != kept.end()) return path;
  const fs::path folder = fs::path(scene.file).parent_path();
  const std::string shipped = name_of_shipped(path);
  std::error_code ignored;
  if (!shipped.empty() && !lies_among_shipped(scene) && !fs::exists(folder / shipped, ignored)) return shipped;
  return path_from(folder.string(), path);
}

std::string placeless_scene_text(const Scene& scene) {
  return with_paths(scene_text(scene), [&](const std::string& path) { return placeless_path(scene, path); });
}

std::vector<std::string> absolute_paths_of(const YamlDocument& document) {
  std::vector<std::string> paths;
  visit_paths(document.root, false, [&](const YAML::Node& node) {
    if (fs::path(node.Scalar()).is_absolute() && !is_typed(document, node.Scalar()))
      paths.push_back(node.Scalar());
  });
  return paths;
}

std::vector<std::string> notes_of_shipped(const YamlDocument& document) {
  std::vector<std::string> notes;
  visit_paths(document.root, false, [&](const YAML::Node& node) {
    const std::string& named = node.Scalar();
    const std::string found = input_beside(document.file, named);
    // Paths of the command line are those of the working folder, too.
    std::error_code ignored;
    if (found == beside(document.file, named) || (is_typed(document, named) && fs::exists(named, ignored))) return;
    const std::string note = not_there(named, "beside " + document.file, found);
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  });
  return notes;
}

}  // namespace chainreel
