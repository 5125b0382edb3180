#include "scene/text/suite_variants.hpp"

#include <algorithm>
#include <optional>

#include "scene/keys/keys.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/text/read_compare.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/unread.hpp"

namespace chainreel {
namespace {

constexpr const char* kExample = "variants: {dark: {theme: dark}, strong: {parameters.F: 20}}";

std::string key_of(const SuiteOverride& one) {
  return one.text.substr(0, one.text.find('='));
}

std::string text_of(const YAML::Node& node) {
  return flow_text([&](YAML::Emitter& out) { out << node; });
}

SuiteVariant variant_of(const YamlDocument& document, const std::string& name, const YAML::Node& node, const Place& place,
                        ProblemList& problems) {
  SuiteVariant variant{name, {}, place};
  if (name.empty() || !node.IsMap() || node.size() == 0) {
    problems.add("'variants." + name + "' must hold keys of scenes and what they are: " + kExample, place);
    return variant;
  }
  for (const auto& pair : node) {
    const std::string& key = pair.first.Scalar();
    const Place where = document.place_of(pair.first, "variants." + name + "." + key);
    if (const SceneKey* row = find_key(key); pair.second.IsMap() && row && row->is_section) {
      const std::string first = pair.second.size() > 0 ? pair.second.begin()->first.Scalar() : "KEY";
      problems.add("'variants." + name + "." + key + "' holds keys: write each with a dot, like " + key + "." + first, where);
      continue;
    }
    if (key == "video.width" || key == "video.height") {
      problems.add("'" + key + "': the pictures of a suite have the size that `size: 640x360` says", where);
      continue;
    }
    variant.overrides.push_back({key + "=" + text_of(pair.second), where});
  }
  return variant;
}

bool shows_at_poses(const SceneKey& key) {
  return key.of_model == OfModel::picture || key.is_seen_at_poses;
}

std::vector<std::string> keys_of_pictures() {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys())
    if (shows_at_poses(key) && !key.is_section && !key.name.starts_with("video.")) names.push_back(key.name);
  return names;
}

}  // namespace

std::vector<std::string> with_variant(std::vector<std::string> overrides, const SuiteVariant& variant) {
  for (const SuiteOverride& one : variant.overrides) overrides.push_back(one.text);
  return overrides;
}

bool is_about_models(const SuiteVariant& variant) {
  return std::all_of(variant.overrides.begin(), variant.overrides.end(), [](const SuiteOverride& one) {
    const SceneKey* row = find_key(key_of(one));
    return row != nullptr && shows_at_poses(*row);
  });
}

bool is_about_scene(const std::string& file, const std::vector<std::string>& overrides, const SuiteVariant& variant) {
  std::optional<Scene> scene;
  try {
    scene = read_scene(file, with_variant(overrides, variant));
  } catch (const OverruledError&) {
    return false;
  } catch (const Error&) {
    return true;
  }
  try {
    for (const SuiteOverride& one : variant.overrides) require_read(key_of(one), *scene, "");
  } catch (const Error&) {
    return false;
  }
  return true;
}

std::string words_of_idle(const SuiteVariant& variant) {
  std::vector<std::string> keys;
  for (const SuiteOverride& one : variant.overrides) keys.push_back(key_of(one));
  return "variant '" + variant.name + "' sets " + joined(keys) +
         ", which no source of the suite has: parameters must be read by an expression of a scene, panels of a comparison must not "
         "set it themselves, and models take " + joined(keys_of_pictures());
}

Error as_said_in(const Suite& suite, const Error& error) {
  std::vector<SuiteOverride> all;
  for (std::size_t i = 0; i < suite.overrides.size(); ++i) all.push_back({suite.overrides[i], suite.override_places[i]});
  for (const SuiteVariant& variant : suite.variants) all.insert(all.end(), variant.overrides.begin(), variant.overrides.end());
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems)
    for (const SuiteOverride& one : all) {
      const std::string key = key_of(one);
      const bool is_named = problem.place.file == "--set " + one.text,
                 is_about = (problem.place.file.empty() && problem.message.starts_with("'" + key + "'")) ||
                            (problem.place.line == 0 && problem.message.starts_with("unknown key '" + key.substr(0, key.find('.'))));
      if (is_named || is_about) problem.place = one.place;
    }
  return Error(error.code(), std::move(problems));
}

bool lists_themes(const YamlDocument& document) {
  return document.root["theme"].IsDefined() && document.root["theme"].IsSequence();
}

namespace {

std::vector<SuiteVariant> read_themes(Fields& root, const YamlDocument& document) {
  std::vector<SuiteVariant> themes;
  if (!lists_themes(document)) return themes;
  const std::vector<std::string> known = words_of(names_of(ThemeName{}));
  for (const YAML::Node& theme : root.find("theme")) {
    const std::string name = theme.IsScalar() ? theme.Scalar() : "";
    const Place place = document.place_of(theme, "theme");
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      root.problems().add("'theme' lists '" + name + "', which is none:" + did_you_mean(name, known) + " there are " + joined(known), place);
      continue;
    }
    if (std::any_of(themes.begin(), themes.end(), [&](const SuiteVariant& other) { return other.name == name; })) {
      root.problems().add("'theme' lists '" + name + "' twice", place);
      continue;
    }
    themes.push_back({name, {{"theme=" + name, place}}, place});
  }
  if (root.find("theme").size() == 0) root.problem_at("theme", "'theme' is an empty list: theme: [light, dark]");
  return themes;
}

std::vector<SuiteVariant> read_own(Fields& root, const YamlDocument& document, ProblemList& problems) {
  std::vector<SuiteVariant> variants;
  if (!root.has("variants")) return variants;
  const YAML::Node node = root.find("variants");
  if (!node.IsMap() || node.size() == 0) {
    root.problem_at("variants", std::string("'variants' must hold names, each with keys of scenes: ") + kExample);
    return variants;
  }
  for (const auto& pair : node) {
    const std::string& name = pair.first.Scalar();
    variants.push_back(variant_of(document, name, pair.second, document.place_of(pair.first, "variants." + name), problems));
  }
  return variants;
}

bool has_theme(const SuiteVariant& variant) {
  return std::any_of(variant.overrides.begin(), variant.overrides.end(), [](const SuiteOverride& one) { return one.text.starts_with("theme="); });
}

// The variant in that theme.
SuiteVariant in_theme(SuiteVariant variant, const SuiteVariant& theme) {
  variant.name += "_" + theme.name;
  variant.overrides.insert(variant.overrides.begin(), theme.overrides.begin(), theme.overrides.end());
  return variant;
}

}  // namespace

SuiteVariants read_variants(Fields& root, const YamlDocument& document, ProblemList& problems) {
  const std::vector<SuiteVariant> themes = read_themes(root, document);
  SuiteVariants found{{}, themes.empty() ? std::vector<SuiteVariant>(1) : themes};
  for (const SuiteVariant& variant : read_own(root, document, problems)) {
    if (themes.empty() || has_theme(variant)) found.own.push_back(variant);
    if (has_theme(variant)) continue;
    for (const SuiteVariant& theme : themes) found.own.push_back(in_theme(variant, theme));
  }
  return found;
}

}  // namespace chainreel
