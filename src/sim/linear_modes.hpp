// The motion of a chain linearised about its start, or about the rest to which its feedback brings it, and along its run: what
// decides whether a step is stable there.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "integrate/stability_limit.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

struct Linearisation {
  // Feedback (pd, computed torque) has a target that does not move, and brings the robot to rest: that place, which sags below the
  // target where gravity pulls, stands for the start here.
  bool about_target = false;
  // The motion of small deviations from the start at t = 0, along what constraints leave free; nothing where
  // `trouble` says why there is none.
  std::optional<LinearMotion> motion;
  std::string trouble;
  std::vector<std::complex<double>> rates;  // lambda of exp(lambda t), 1/s, as rates_of has them
  // What the start itself has: the largest |qd| and |qdd|. Where one of them is not zero the start is no
  // equilibrium, and what holds there need not hold later.
  double rate = 0, acceleration = 0;
  bool is_equilibrium = true;
  // Of a run that does not begin at rest, besides: the motion at its stiffest instants and at some others, and about the rest that lies
  // near its start or its end; under constraints as if it stood still there, and what holds them down by Baumgarte. Of floating
  // bases no more than the start is known.
  std::vector<LinearMotion> along;

  // Of all that is looked at: the fastest rate.
  std::complex<double> fastest() const;
};

Linearisation linearise(const Simulation& simulation);  // without `along`
// The run is looked at by another method; its own is kept.
Linearisation linearise_along(Simulation& simulation);

// The largest magnitude among its numbers; 0 of none.
double largest_of(const std::vector<double>& x);

// As stability_limit and is_stable, of all that is looked at: the shortest, and whether it is so everywhere; nothing where it is not
// known.
std::optional<double> longest_stable_step(const Method& method, const Linearisation& start);
std::optional<bool> is_stable_step(const Method& method, const Linearisation& start, double h);

}  // namespace chainreel
