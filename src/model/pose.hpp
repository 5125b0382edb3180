// Whether numbers are a pose of a chain.
#pragma once

#include <span>
#include <string>

#include "model/chain.hpp"

namespace chainreel {

// What keeps the chain.nq numbers from being one, with its remedy; "" for a pose. Quaternions need no unit length, but
// without any they point nowhere.
std::string trouble_of_pose(const Chain& chain, std::span<const double> q);

}  // namespace chainreel
