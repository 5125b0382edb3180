// What differs in the places and shapes of two states of a model. Internal.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/model_description.hpp"

namespace chainreel {

// "moved by 4 mm (x 0.5 -> 0.504 m)"; of two places that differ.
std::string move_words(const Eigen::Vector3d& before, const Eigen::Vector3d& after);
// "turned by 0.1 deg (rpy 0 0 0 -> 0 0 0.00174)"; "" where rpy is the same, or another writing of the same
// turn.
std::string turn_words(const UrdfOrigin& before, const UrdfOrigin& after);
// Both, as far as they differ.
std::vector<std::string> origin_changes(const UrdfOrigin& before, const UrdfOrigin& after);

struct ShapeDifference {
  std::string words;
  int line = 0;  // of the shape, of `after`
};

struct ShapesOfLink {
  const ModelDescription& model;
  const std::vector<DescribedShape>& shapes;
};

// Pairs of meshes that were told already: several links may show one.
using ToldMeshes = std::set<std::pair<int, int>>;

// Shapes that are the same are paired first, whatever their number; the others in their order. `what`:
// visual, collision.
std::vector<ShapeDifference> shape_differences(const ShapesOfLink& before, const ShapesOfLink& after,
                                               const std::string& link, const std::string& what,
                                               ToldMeshes& told);

}  // namespace chainreel
