// Joints that mimic others.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "model/chain.hpp"

namespace chainreel {

// "panda_finger_joint2 follows panda_finger_joint1 and has no number of its own", of all joints that mimic others; "" where none does.
std::string followers_of(const Chain& chain);

// Of a list with a number of every joint, in the model's order, where a chain has fewer freedoms, since some joints mimic others.
struct FollowerNumbers {
  std::vector<std::size_t> places;  // of those, where they are what the joints that lead them make of them; empty of all other lists
  std::string contradiction;        // "panda_finger_joint2 follows panda_finger_joint1, which makes it 0.02, not 0.01"
};
FollowerNumbers numbers_of_followers(const Chain& chain, std::span<const double> values, bool are_rates);

// Takes the entries at these rising places out of a list.
template <class T>
void take_out(std::vector<T>& entries, const std::vector<std::size_t>& places) {
  for (std::size_t i = places.size(); i-- > 0;) entries.erase(entries.begin() + std::ptrdiff_t(places[i]));
}

}  // namespace chainreel
