// A scene's text for another folder.
#pragma once

#include <string>

namespace chainreel {

// `text` as scene_text writes it, its paths as found from the working folder: the same with relative paths as
// found from `folder`. Throws Error (bad input) where it is no YAML.
std::string moved_scene_text(const std::string& text, const std::string& folder);

}  // namespace chainreel
