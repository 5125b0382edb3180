// What speaks against a scene that can be run: what it says and what nothing comes of.
#pragma once

#include <string>
#include <vector>

#include "model/chain.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// Half a sentence each, of the scene as it was read and its chain: a start that is doubtful (pose_doubts), gravity across the
// plane of the chain, limits that the model does not have.
std::vector<std::string> doubts_of_scene(const Scene& scene, const Chain& chain);

// "" unless gravity is perpendicular to the plane in which the chain moves, where nothing of it acts.
std::string doubt_of_gravity(const Chain& chain);

}  // namespace chainreel
