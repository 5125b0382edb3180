// Whether the joint-space inertia of a chain is regular at poses in general, so that torques have
// accelerations.
//
// The articulated-body recursion (R. Featherstone, Rigid Body Dynamics Algorithms, ch. 7.3) factors M: the
// pivots D_i = S_i^T I_i^A S_i are all positive where M is regular, and the first one that vanishes names a
// joint whose motion moves no mass, such as the last joint of a chain that ends in a point mass on its own
// axis. A pose may be singular by chance (two point masses stretched out), so several poses without any
// symmetry are tried. A mimic joint is locked in this test: it adds motion to its leader's and only takes
// mass away from it in contrived chains.
#pragma once

#include <optional>
#include <string>

#include "model/chain.hpp"

namespace chainreel {

// A motion that nothing resists, in words for a message.
struct Unresisted {
  int body = 0;         // that its joint moves
  std::string motion;   // "turns", "slides", "turns about x and moves along z"
  bool behind = false;  // the bodies behind have inertia, but their joints give way
  std::string remedy;   // what the body's link must be given: "a mass"
};

// At the last of the poses, where nothing resists a motion at any of those tried; absent: M is regular.
std::optional<Unresisted> unresisted_motion(const Chain& chain);

}  // namespace chainreel
