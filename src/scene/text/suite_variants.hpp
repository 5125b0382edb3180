// What a suite shows several times over: each source as it is with other keys, in both themes or with several forces. Internal to
// suite.cpp.
#pragma once

#include <vector>

#include "scene/keys/fields.hpp"
#include "scene/text/suite.hpp"

namespace chainreel {

// `variants: {dark: {theme: dark}, strong: {parameters.F: 20}}`, or `theme: [light, dark]`, which names its variants by themselves.
// Empty where there are none.
std::vector<SuiteVariant> read_variants(Fields& root, const YamlDocument& document, ProblemList& problems);

// Those of the variant behind others.
std::vector<std::string> with_variant(std::vector<std::string> overrides, const SuiteVariant& variant);

// Adds a problem for each key that says nothing of a model's pictures.
void require_of_pictures(const SuiteVariant& variant, ProblemList& problems);

// Throws Error where nobody reads a parameter that the variant sets.
void require_read_by(const Scene& scene, const SuiteVariant& variant);

// Whether `theme` is such a list.
bool lists_themes(const YamlDocument& document);

}  // namespace chainreel
