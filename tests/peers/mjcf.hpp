// A chain as MuJoCo's model text (MJCF), so that another engine can be asked the same question.
//
// What is left out: contacts, limits, damping and friction. Inertias are written by principal axes (`quat`,
// `diaginertia`): MuJoCo's own diagonalisation of `fullinertia` stops at 1e-9. It refuses masses and moments
// that are zero; those are written as kLeast, which is far below what a sum with any other part keeps.
#pragma once

#include <string>

#include "model/chain.hpp"

namespace chainreel::peers {

inline constexpr double kLeast = 1e-14;  // kg and kg m^2; MuJoCo's own limit is 1e-15

// Joints in the order of the chain's coordinates; every body is named b1, b2, .., its joint j1, j2, ...
// Throws std::invalid_argument for what MJCF cannot say: shared coordinates (mimic), floating joints that do
// not hang on the world.
// `equality` is text for MJCF's <equality>; constraints are switched on where there is any.
std::string mjcf_of(const Chain& chain, const std::string& equality = "");

}  // namespace chainreel::peers
