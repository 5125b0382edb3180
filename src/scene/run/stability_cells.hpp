// A scene run at every point of a grid of two of its keys: where does it fail, and how far is its energy off?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/run/sweep.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// A run whose energy is off by more than this many times the energy scale of its motion (energy_scale) has
// failed, whether its numbers stay finite or not: joints that turn never leave all bounds. Sound methods
// stray far less: an oscillation of semi-implicit Euler at 99 % of its limit by 99 times its energy, its
// orbit being an ellipse of energies from 1/(1 + omega h/2) to 1/(1 - omega h/2).
inline constexpr double kFailedEnergy = 100;

struct StabilityCell {
  RunStatus status = RunStatus::finished;
  double energy_error = 0;     // J, largest |error| at the ends of all steps, of 100 in batches; infinite where the run came to no end
  double energy_scale = 0;     // J, of the motion; NaN where the truth came to no end either
  bool failed = false;         // it came to no end, or its energy is lost
  std::optional<bool> stable;  // by theory: of the motion linearised about the start, at the cell's own step
  std::string trouble;
};

struct StabilityCells {
  Sweep x, y;
  std::vector<StabilityCell> cells;  // x.values.size() a row, a row a value of y
  std::string method;
  int threads = 1;
  bool in_batches = false;  // stepped together by BatchSimulator
  // Where one key is `step`, beside what StabilityCell::stable says: for each value of the other the longest
  // stable step of the motion linearised about the start, or about the rest that feedback leads to.
  std::vector<std::optional<double>> boundary;
  // Motions that theory is of, those of them about the rest that feedback leads to, along whole runs besides, and about no more than
  // what is no equilibrium.
  int linearised = 0, about_rest = 0, along_runs = 0, about_motion = 0;

  const StabilityCell& at(std::size_t ix, std::size_t iy) const { return cells[iy * x.values.size() + ix]; }
};

// A run takes the scene's duration, and at least kLeastSteps steps of a fixed step: slow growth shows then.
inline constexpr int kLeastSteps = 1000;

// Both sweeps need numbers. On `threads` threads, which ask `stop` with the share of all work that is done. Throws what reading or preparing a cell's scene throws.
StabilityCells run_stability_cells(const std::string& scene, const std::vector<std::string>& overrides,
                                   const Sweep& x, const Sweep& y, int threads, const StopRequest& stop = {});

}  // namespace chainreel
