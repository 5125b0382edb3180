// The paths in a scene's text: as found from another folder, or so that they are the same wherever the scene
// lies.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace chainreel {

struct YamlDocument;

// `text` as scene_text writes it, its paths as found from the folder `from` ("": the working folder): the
// same with relative paths as found from `to`. Throws Error (bad input) where it is no YAML.
std::string moved_scene_text(const std::string& text, const std::string& to, const std::string& from = "");

// `text` as people write it, all else as it stands, its models now this file. Throws as above.
std::string scene_with_model(const std::string& text, const std::string& model);

// Relative paths that the text names, each once. Throws as above.
std::vector<std::string> relative_paths_in(const std::string& text);

// What a file that is copied with its inputs may say: the path, which is as found from the working folder, as
// found from `folder`. An absolute one stays where it has nothing in common with the folder.
std::string path_from(const std::string& folder, const std::string& path);

// Paths of a scene as found from its own file's folder; those that the file has as absolute ones stay.
std::string placeless_path(const Scene& scene, const std::string& path);
// scene_text with such paths: the same wherever the scene lies, and from wherever it was read.
std::string placeless_scene_text(const Scene& scene);

// Absolute paths that stand in the file itself, not in values of the command line.
std::vector<std::string> absolute_paths_of(const YamlDocument& document);

// What is to be said of names for which no file lies beside the document, so that those of the program itself are taken.
std::vector<std::string> notes_of_shipped(const YamlDocument& document);

}  // namespace chainreel
