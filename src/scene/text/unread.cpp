#include "scene/text/unread.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "core/format.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {
namespace {

constexpr const char* kWithExpressions[] = {"torque", "push", "constraints", "contact_force", "events", "plot"};

bool is_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// As a whole word.
bool has_word(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const bool begins = at == 0 || !is_of_name(text[at - 1]), ends = at + word.size() == text.size() || !is_of_name(text[at + word.size()]);
    if (begins && ends) return true;
  }
  return false;
}

// By the scene or one of its panels.
bool is_read(const std::string& name, const Scene& scene) {
  if (std::any_of(scene.compare.begin(), scene.compare.end(), [&](const Scene& panel) { return is_read(name, panel); })) return true;
  return std::any_of(std::begin(kWithExpressions), std::end(kWithExpressions), [&](const char* with) {
    const SceneKey* key = find_key(with);
    return has_word(key->text(*key, scene), name);
  });
}

}  // namespace

void require_read(const std::string& key, const Scene& scene, const std::string& option) {
  constexpr std::string_view kParameters = "parameters.";
  if (!key.starts_with(kParameters)) return;
  const std::string name = key.substr(kParameters.size());
  if (is_read(name, scene)) return;
  std::vector<std::string> read;
  for (const auto& [known, value] : scene.parameters)
    if (is_read(known, scene)) read.push_back(known);
  throw Error(ExitCode::usage, option + " " + key + ": no expression of the scene reads '" + name + "', so that all its runs would be equal" +
                                   (read.empty() ? "" : ":" + did_you_mean(name, read) + " Read are " + joined(read)));
}

}  // namespace chainreel
