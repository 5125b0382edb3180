// The logo of a scene's style, and what its files tell of the style.
#pragma once

#include <optional>

#include "core/json.hpp"
#include "draw/page/sheet.hpp"
#include "scene/scene.hpp"

namespace chainreel {

struct PreparedFilm;

// Reads the style's logo, if it has one. Throws Error where the file is none.
void load_logo(Scene& scene);
// For a page of a figure, so many pixels high; read where it was not yet.
std::optional<PageLogo> page_logo(const Scene& scene, int page_height);

// {fonts: {label: {family, file, sha256}, ..}, fallback_fonts: [{file, face, sha256}, ..], logo: {sha256, pixels_sha256},
// low_contrast: [..]}: what a film depends on that its scene's text does not hold. Null where there is no style, and no word that
// the faces lack.
Json style_report(const PreparedFilm& film);

}  // namespace chainreel
