// The models that other engines are asked about: those of models/ and, where the environment variable
// CHAINREEL_ROBOTS names a folder of public robot descriptions, every robot below it.
#pragma once

#include <string>
#include <vector>

#include "model/chain.hpp"

namespace chainreel::peers {

// Paths of all *.urdf below a folder, in order of their names.
std::vector<std::string> urdf_files_below(const std::string& folder);

std::vector<std::string> committed_models();
// Empty where CHAINREEL_ROBOTS is not set: tests are skipped then. Throws std::runtime_error where it names no
// folder with robots.
std::vector<std::string> public_robots();

// Without friction and without meshes.
Chain read_frictionless(const std::string& path, bool floating_base = false);

// Every mimic joint gets a coordinate of its own.
Chain with_independent_joints(Chain chain);

}  // namespace chainreel::peers
