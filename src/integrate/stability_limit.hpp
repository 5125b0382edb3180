// Where a method stops being stable on a linear motion: where its step multiplies something that the motion
// itself does not let grow.
//
// A method whose step is a function R of the matrix of the motion (it commutes with it: Runge-Kutta methods)
// acts on each eigenvalue by itself, |R(h lambda)| <= 1, and is looked at one by one: no slow motion is lost
// beside a fast one. All others (those that treat q and v in turn) mix what springs and dampers do: there the
// spectral radius of the whole step counts.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "integrate/linear_motion.hpp"

namespace chainreel {

// Rates of the motion exp(lambda t), 1/s, that are neither 0 nor the mirror image of another one (imaginary
// part >= 0), the slowest first. What cannot be told from 0 beside the fastest, 3e-5 of it, counts as 0, and
// so do real parts of 1e-9 of it.
std::vector<std::complex<double>> rates_of(const LinearMotion& motion);

// Whether one step of length h > 0 is stable; nothing where that is not known: for methods that take no
// linear motion, and where the motion has no rate that is to stay within bounds.
std::optional<bool> is_stable(const Method& method, const LinearMotion& motion, double h);

// The largest step below which every step is stable, s: 0 where none is, infinity where all are; nothing
// where it is not known.
std::optional<double> stability_limit(const Method& method, const LinearMotion& motion);

}  // namespace chainreel
