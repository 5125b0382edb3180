// chainreel check FILM: whether it is as it was written, and whether its scene would make the same film today.
#pragma once

#include <string>

#include "app/cli/command.hpp"

namespace chainreel {

// Films, pictures and their audits: what scenes and models are not.
bool is_film_or_picture(const std::string& path);

// Held against the audit beside it. Throws Error (exit 1) where it is not what that tells of.
void check_as_written(const std::string& path, const CommonOptions& common);

// What it remembers against what a film or picture of the scene, as `common` changes it, would remember now. Throws Error
// (exit 1) where that is something else, (exit 3) of a file that shows no scene.
void check_against_scene(const std::string& path, const std::string& scene, const CommonOptions& common);

}  // namespace chainreel
