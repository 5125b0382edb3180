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

// What a chain has a number of a coordinate or a freedom of.
enum class StateNumbers { q, qd, tau };
// How they are called: see position_names; those of freedoms else.
std::vector<std::string> names_of_state(const Chain& chain, StateNumbers numbers);
// "90deg of slider is in rad, but its place is in m": the first of the numbers whose unit is of another kind; "" where none is.
// `written`: as above, one a coordinate (q) or a freedom.
std::string trouble_of_units(const Chain& chain, std::span<const std::string> written, StateNumbers numbers);

}  // namespace chainreel
