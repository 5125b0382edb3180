// chainreel check FILM: whether it is as it was written, and whether its scene would make the same film today.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.hpp"

namespace chainreel {

// Films, pictures and their audits: what scenes and models are not.
bool is_film_or_picture(const std::string& path);

// Held against the audit beside it. Throws Error (exit 1) where it is not what that tells of.
void check_as_written(const std::string& path, const CommonOptions& common);

// What films and pictures, and those in folders, remember against what their scenes as the command line changed them would make
// now. `scene`: of all; "": each has its own, which is found from where it lies. `as_commands`: of
// those that are another thing now the commands that make them anew are printed, a line each, and nothing else. Throws Error (exit 1) naming those that are
// something else now, (exit 3) where one shows no scene, or its scene is not found. `junit`: a file for the same, a case a film; "": none.
void check_of_today(const std::vector<std::string>& paths, const std::string& scene, bool as_commands, const std::string& junit, const CommonOptions& common);

}  // namespace chainreel
