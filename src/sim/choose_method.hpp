// `method: auto`: the cheapest method and step whose error stays below what the scene allows, at every drawn
// place, in every frame. Cost is counted (cost_table.hpp), never timed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/accuracy.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

struct MethodSetting {
  const Method* method = nullptr;
  MethodOptions options;
  double step = 0;  // s; 0: by the tolerance
};

void apply(const MethodSetting& setting, Simulation& simulation);

// "taylor, order 16, tolerance 1e-6".
std::string to_string(const MethodSetting& setting);

struct Choice {
  struct Candidate {
    MethodSetting setting;
    double error = 0;  // largest over the frames, in the accuracy's unit, against a run far more exact
    double cost = 0;   // ns by the table
    long steps = 0, evaluations = 0;
    std::string trouble;  // "" where it ran to the end
  };
  Candidate best;
  bool is_met = false;                // the best one's error is below the accuracy
  std::optional<double> holds_until;  // s: from there on no run in double precision can be that exact
  double reference_uncertainty = 0;   // in the accuracy's unit, up to there
  std::vector<Candidate> tried;
};

// `times`: of the frames. Leaves the best setting in `simulation`. Where the run ends early (a torque that is
// not finite, limits that stop), what can be compared is.
Choice choose_method(Simulation& simulation, const Accuracy& accuracy, std::span<const double> times,
                     const StopRequest& stop = {});

}  // namespace chainreel
