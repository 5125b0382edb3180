// What differs between two states of a model, in words of the field.
#pragma once

#include <string>
#include <vector>

#include "model/model_description.hpp"

namespace chainreel {

// The most telling first.
enum class ModelChange {
  structure,   // links and joints that came, went or have another name; the order of coordinates
  joint,       // where joints are and how they turn; which of them follow others
  mass,        // masses, centres, inertias
  resistance,  // damping, friction
  limit,       // of joints: of position, rate and effort
  reading,     // how the model was read: gravity, base, end effector
  looks,       // shapes, colours, meshes: of no matter to a motion
};

struct ModelDifference {
  ModelChange change;
  std::string words;  // "link forearm: mass 1.2 -> 1.25 kg, URDF line 31"; the line is that of `after`
};

// Numbers are compared exactly as they were read from the files, but for axes, of which only the direction
// counts, and for turns, which several triples of rpy may write. Lines, paths and names of materials are no
// difference. Empty: the same.
std::vector<ModelDifference> differences(const ModelDescription& before, const ModelDescription& after);

}  // namespace chainreel
