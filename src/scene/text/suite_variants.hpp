// What a suite shows several times over: each source as it is with other keys, in both themes or with several forces. Internal to
// suite.cpp.
#pragma once

#include <vector>

#include "scene/keys/fields.hpp"
#include "scene/text/suite.hpp"

namespace chainreel {

// `variants: {dark: {theme: dark}, strong: {parameters.F: 20}}`, each in all of `theme: [light, dark]` where that is a list.
struct SuiteVariants {
  std::vector<SuiteVariant> own;        // "strong_dark"
  std::vector<SuiteVariant> otherwise;  // of sources that none of these is about: the themes, or the source as it is
};
SuiteVariants read_variants(Fields& root, const YamlDocument& document, ProblemList& problems);

// Those of the variant behind others.
std::vector<std::string> with_variant(std::vector<std::string> overrides, const SuiteVariant& variant);

// Whether all that the variant sets is of a model's pictures, or is read by the scene at `file`; a scene that cannot be read with it
// is told of elsewhere.
bool is_about_models(const SuiteVariant& variant);
bool is_about_scene(const std::string& file, const std::vector<std::string>& overrides, const SuiteVariant& variant);

// What to say of a variant that none of the sources is about.
std::string words_of_idle(const SuiteVariant& variant);

// Whether `theme` is such a list.
bool lists_themes(const YamlDocument& document);

}  // namespace chainreel
