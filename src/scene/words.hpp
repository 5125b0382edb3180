// What a scene chooses by words: enumerations with the words that stand for their values in a file.
#pragma once

#include "core/names.hpp"

namespace chainreel {

// How the root link is held.
enum class RootLink { fixed, floating };
// What a run is to do.
enum class Outcome { finish, diverge, within_limits };
// What of a model is drawn: bars, or its shapes; `automatic` is visual in space.
enum class LinkShapes { automatic, plain, visual, collision };
// How the layer `ellipse` reads the effective mass: see draw/ellipse.hpp.
enum class EllipseReading { mass, energy, belt };
// What is drawn of it in space.
enum class EllipseShape { ellipsoid, section };
// Where on the page the scene, its plots and its panels stand.
enum class PageLayout { automatic, scene, scene_below, scene_right, transparent, compare, grid, ghost };
inline bool is_of_panels(PageLayout layout) {
  return layout == PageLayout::compare || layout == PageLayout::grid || layout == PageLayout::ghost;
}
enum class ThemeName { light, dark };
// What a scene writes where no file is named.
enum class Preset { slides, web, overlay, doc, frames, still };

std::span<const Name> names_of(RootLink);
std::span<const Name> names_of(Outcome);
std::span<const Name> names_of(LinkShapes);
std::span<const Name> names_of(EllipseReading);
std::span<const Name> names_of(EllipseShape);
std::span<const Name> names_of(PageLayout);
std::span<const Name> names_of(ThemeName);
std::span<const Name> names_of(Preset);


}  // namespace chainreel
