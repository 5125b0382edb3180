// What is exact in plots of panels that show one motion by several methods: a thin curve, which says which of them errs.
#pragma once

#include <cstddef>
#include <optional>

#include "draw/film/plot_strip.hpp"
#include "draw/page/stage.hpp"

namespace chainreel {

// Of the stage's references the first, each plot cut to where the second one confirms it; nothing where there are none.
std::optional<StripRun> exact_run(const Stage& stage);

// Adds plot i of that run to those of all others, named "exact", unless one of them lies on it.
void add_exact(StripData& data, const StripRun& exact, std::size_t i, const Theme& theme);

}  // namespace chainreel
