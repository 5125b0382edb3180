// What speaks against a pose that a chain can take: degrees that were meant, limits that are passed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/chain.hpp"

namespace chainreel {

// Half a sentence each. `q`: one number a coordinate, rad or m; `written`: the same as they stand in the text, "" where they do not.
// A number without a unit of more than a whole turn is doubtful, as is one outside the limits of its joint.
std::vector<std::string> doubts_of_pose(const Chain& chain, std::span<const double> q, std::span<const std::string> written);

}  // namespace chainreel
