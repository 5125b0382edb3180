#include "app/scene_flags.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/format.hpp"
#include "scene/scene.hpp"

namespace chainreel {

void add_scene_flags(Command& command, FlagValues& values, std::span<const SceneFlag> flags) {
  for (const SceneFlag& one : flags) command.add_option(one.flag, values[one.key], one.help);
}

void add_overrides(const FlagValues& values, std::vector<std::string>& overrides) {
  for (const auto& [key, value] : values)
    if (!value.empty()) overrides.push_back(key + "=" + value);
}

namespace {

std::string given(const FlagValues& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? "" : found->second;
}

}  // namespace

std::string theme_of(const FlagValues& values) {
  const std::string name = given(values, "theme");
  if (name.empty()) return Scene{}.theme;
  if (std::find(theme_names().begin(), theme_names().end(), name) == theme_names().end())
    throw Error(ExitCode::usage, "--theme takes light or dark, not '" + name + "'");
  return name;
}

double text_scale_of(const FlagValues& values) {
  const std::string text = given(values, "text_scale");
  if (text.empty()) return Scene{}.text_scale;
  const auto scale = parse_number(text);
  if (!scale || !(*scale >= 0.5 && *scale <= 3))
    throw Error(ExitCode::usage, "--text-scale takes a number between 0.5 and 3, not '" + text + "'");
  return *scale;
}

}  // namespace chainreel
