#include "scene/text/suite_variants.hpp"

#include <algorithm>

#include "scene/keys/keys.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/text/unread.hpp"

namespace chainreel {
namespace {

constexpr const char* kExample = "variants: {dark: {theme: dark}, strong: {parameters.F: 20}}";

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
    if (pair.second.IsMap() && find_key(key) && find_key(key)->is_section) {
      problems.add("'variants." + name + "." + key + "' holds keys: write each with a dot, like " + key + "." +
                       pair.second.begin()->first.Scalar(),
                   where);
      continue;
    }
    variant.overrides.push_back({key + "=" + text_of(pair.second), where});
  }
  return variant;
}

std::vector<std::string> keys_of_pictures() {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys())
    if (key.of_model == OfModel::picture && !key.is_section) names.push_back(key.name);
  return names;
}

}  // namespace

std::vector<std::string> with_variant(std::vector<std::string> overrides, const SuiteVariant& variant) {
  for (const SuiteOverride& one : variant.overrides) overrides.push_back(one.text);
  return overrides;
}

void require_of_pictures(const SuiteVariant& variant, ProblemList& problems) {
  for (const SuiteOverride& one : variant.overrides) {
    const std::string key = one.text.substr(0, one.text.find('='));
    const SceneKey* row = find_key(key);
    if (row == nullptr || row->of_model != OfModel::picture)
      problems.add("'" + key + "' says nothing of how a model is drawn: variants of models may set " + joined(keys_of_pictures()), one.place);
  }
}

void require_read_by(const Scene& scene, const SuiteVariant& variant) {
  for (const SuiteOverride& one : variant.overrides)
    try {
      require_read(one.text.substr(0, one.text.find('=')), scene, "variant " + variant.name);
    } catch (const Error& error) {
      std::vector<Problem> problems = error.problems();
      for (Problem& problem : problems) problem.place = one.place;
      throw Error(ExitCode::bad_input, std::move(problems));
    }
}

Error as_said_in(const Suite& suite, const Error& error) {
  std::vector<SuiteOverride> all;
  for (std::size_t i = 0; i < suite.overrides.size(); ++i) all.push_back({suite.overrides[i], suite.override_places[i]});
  for (const SuiteVariant& variant : suite.variants) all.insert(all.end(), variant.overrides.begin(), variant.overrides.end());
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems)
    for (const SuiteOverride& one : all) {
      const bool is_named = problem.place.file == "--set " + one.text,
                 is_about = problem.place.file.empty() &&
                            problem.message.starts_with("'" + one.text.substr(0, one.text.find('=')) + "'");
      if (is_named || is_about) problem.place = one.place;
    }
  return Error(error.code(), std::move(problems));
}

bool lists_themes(const YamlDocument& document) {
  return document.root["theme"].IsDefined() && document.root["theme"].IsSequence();
}

std::vector<SuiteVariant> read_variants(Fields& root, const YamlDocument& document, ProblemList& problems) {
  std::vector<SuiteVariant> variants;
  if (lists_themes(document)) {
    for (const YAML::Node& theme : root.find("theme")) {
      const std::string name = theme.IsScalar() ? theme.Scalar() : "";
      variants.push_back({name, {{"theme=" + name, document.place_of(theme, "theme")}}, document.place_of(theme, "theme")});
    }
    if (root.has("variants")) root.problem_at("variants", "'variants' and a list of themes are two ways to say it: name the themes in the variants");
    if (variants.empty()) root.problem_at("theme", "'theme' is an empty list: theme: [light, dark]");
  } else if (root.has("variants")) {
    const YAML::Node node = root.find("variants");
    if (!node.IsMap() || node.size() == 0) {
      root.problem_at("variants", std::string("'variants' must hold names, each with keys of scenes: ") + kExample);
      return variants;
    }
    for (const auto& pair : node) {
      const std::string& name = pair.first.Scalar();
      variants.push_back(variant_of(document, name, pair.second, document.place_of(pair.first, "variants." + name), problems));
    }
  }
  return variants;
}

}  // namespace chainreel
