// Where a method stops being stable, for q'' = -omega^2 q - 2 z omega q'.
#pragma once

#include "integrate/method.hpp"

namespace chainreel {

// The largest modulus of the eigenvalues of the map that one step of length h makes of (q, v); the method is
// stable where it is at most 1. Adaptive methods step as they are told. A method that takes no oscillator
// (series, linked points) gives NaN.
double amplification(const Method& method, double omega, double damping_ratio, double h);

// The largest omega h below which every step is stable: 0 where none is, infinity where all are that can be
// told. Depends on the method and the damping ratio alone.
double stability_limit(const Method& method, double damping_ratio);

}  // namespace chainreel
