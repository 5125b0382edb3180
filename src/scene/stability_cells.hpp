// A scene run at every point of a grid of two of its keys: where does it fail, and how far is its energy off?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/sweep.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

struct StabilityCell {
  RunStatus status = RunStatus::finished;
  double energy_error = 0;  // J, largest |audit error| at stability_times; infinite where the run failed
  std::string trouble;
};

struct StabilityCells {
  Sweep x, y;
  std::vector<StabilityCell> cells;  // x.values.size() a row, a row a value of y
  std::string method;
  int threads = 1;
  bool in_batches = false;  // stepped together by BatchSimulator
  // Where one key is `step`: for each value of the other the longest stable step of the motion linearised
  // about the start.
  std::vector<std::optional<double>> boundary;

  const StabilityCell& at(std::size_t ix, std::size_t iy) const { return cells[iy * x.values.size() + ix]; }
};

// A run takes the scene's duration, and at least kLeastSteps steps of a fixed step: slow growth shows then.
inline constexpr int kLeastSteps = 1000;
// Equally spaced instants at which energies are looked at, the last one at the end.
std::vector<double> stability_times(double duration);

// Both sweeps need numbers. On `threads` threads. Throws what reading or preparing a cell's scene throws.
StabilityCells run_stability_cells(const std::string& scene, const std::vector<std::string>& overrides,
                                   const Sweep& x, const Sweep& y, int threads, const StopRequest& stop = {});

}  // namespace chainreel
