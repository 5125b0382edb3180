// Which link and joint of one state of a model is which of another one, also under another name. Internal.
#pragma once

#include <vector>

#include "model/model_description.hpp"

namespace chainreel {

// Indices into the other's lists, -1 where there is none.
struct ModelMatch {
  std::vector<int> links, joints;        // of `before`
  std::vector<int> links_of, joints_of;  // of `after`
};

// By name; what is left, as renamed: a link below the same joint, or, with the same inertia and shapes, below
// a joint of the same parent, type and origin; the root; and a joint above the same link.
ModelMatch match(const ModelDescription& before, const ModelDescription& after);

// The same triangles, whatever the file's name; of meshes that were not read, the same name.
bool is_same(const DescribedMesh& a, const DescribedMesh& b);

// The same shape, looks and place.
bool is_same(const DescribedShape& a, const ModelDescription& of_a, const DescribedShape& b,
             const ModelDescription& of_b);

}  // namespace chainreel
