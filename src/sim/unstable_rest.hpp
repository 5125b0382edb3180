// A start at rest on which nothing acts, and from which the least deviation grows: a pendulum on its head. What moves it is rounding.
#pragma once

#include <optional>

#include "sim/doubts.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Where rounding would have grown to what can be seen by the time that something acts, or the run ends: whether a run left such a start
// or stood on its head is chance. Its amount: the exponent by which deviations grow until then.
std::optional<Doubt> doubt_of_rest(const Simulation& simulation);

}  // namespace chainreel
