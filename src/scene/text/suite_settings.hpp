// What a suite says of all its pictures and of single ones alike: size, tolerance, masks. Internal to
// suite.cpp.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/keys/fields.hpp"
#include "scene/text/suite.hpp"

namespace chainreel {

struct SuiteSize {
  int width = 0, height = 0;  // px
};

struct SuiteSettings {
  std::optional<SuiteSize> size;
  std::optional<double> error;
  std::optional<int> pixels;
  std::optional<bool> count_edges;
  Place tolerance_place;
  std::vector<std::array<int, 4>> masks;
  Place place;
};

// The keys `size`, `tolerance` and `masks` of a mapping.
void read_suite_settings(Fields& fields, SuiteSettings& settings);

// What the settings say holds of the picture from now on; masks join those that it has.
void apply(const SuiteSettings& settings, SuitePicture& picture);

// Adds a problem for each mask that leaves the picture, and where nothing of it is left to be looked at.
void check_masks(const SuitePicture& picture, ProblemList& problems);

}  // namespace chainreel
