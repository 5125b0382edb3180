// The tables that drive a scene: torques, references and recorded motions in CSV files.
#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// Their names without folders, and hashes of their numbers: {"tau.csv": ".."}. Reads the files; throws Error as read_csv does.
Json driving_tables(const Scene& scene);

// The scene with these names in place of the paths.
Scene with_named_tables(Scene scene);

// "torque: the numbers in table tau.csv differ", for each of both that has other numbers. `key`: of the scene, that reads them.
std::vector<std::string> table_changes(const Json& before, const Json& after, const std::string& key);

}  // namespace chainreel
