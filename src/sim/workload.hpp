// What runs are going to take, counted before the first one begins: a mistake in a step or a duration is told at once
// instead of after a year.
#pragma once

#include <string>

#include "sim/simulate.hpp"

namespace chainreel {

inline constexpr double kMostSteps = 1e10;  // of one run
inline constexpr double kMostWork = 1e14;   // ns by the table of costs, of all runs of a command: some 28 hours

// Whole steps of a method of fixed step; 0 of one that chooses its steps.
double steps_of(const Simulation& simulation);

// ns at least, by the table of costs; of a method that chooses its steps 0.
double least_work(const Simulation& simulation);

// Throws Error (exit 7) with the count where so many runs like this one are more than may be asked for.
void require_possible(const Simulation& simulation, double runs = 1);

// The same for the sum of several runs' least_work.
void require_possible(double work, double runs);

}  // namespace chainreel
