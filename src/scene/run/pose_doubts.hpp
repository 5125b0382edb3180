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
// "90deg of slider is in rad, but its place is in m": the first of the numbers whose unit is of another kind; "" where none is.
// `written`: as above, one a coordinate (q) or a freedom.
std::string trouble_of_units(const Chain& chain, std::span<const std::string> written, StateNumbers numbers);

// "panda_finger_joint2 follows panda_finger_joint1 and has no number of its own", of all joints that mimic others; "" where none does.
std::string followers_of(const Chain& chain);

// Of a list with a number of every joint, in the model's order, where a chain has fewer freedoms, since some joints mimic others:
// which ones are of those, where they are what the joints that lead them make of them. Empty of all other lists.
std::vector<std::size_t> numbers_of_followers(const Chain& chain, std::span<const double> values, StateNumbers numbers);

}  // namespace chainreel
