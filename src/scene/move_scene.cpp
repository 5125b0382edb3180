#include "scene/move_scene.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "core/json.hpp"
#include "scene/keys.hpp"

namespace chainreel {
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
