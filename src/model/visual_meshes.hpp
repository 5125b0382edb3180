// Where the meshes lie that a model shows.
#pragma once

#include <map>
#include <string>

#include "model/read_chain.hpp"
#include "model/urdf_file.hpp"
#include "model/visuals.hpp"

namespace chainreel {

const std::vector<UrdfShape>& shapes_of(const UrdfLink& link, ShapesOf which);

// For each mesh of a <visual> or <collision>, by its name as written, the path where it was found, "" where
// it was not. With `options.meshes` all must be found: throws Error with every one that is not.
std::map<std::string, std::string> find_meshes(const UrdfFile& file, const ModelOptions& options,
                                               ShapesOf which = ShapesOf::visual);

}  // namespace chainreel
