// Speed against accuracy: every method at every rung of its ladder of steps or tolerances, timed and compared
// with a reference.
#pragma once

#include <string>
#include <vector>

#include "sim/choice/choose_method.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Where the run ends, far more exactly than any rung.
struct EndState {
  std::vector<double> q, qd;
  // By which errors of qd are multiplied to stand beside those of q, s: the time in which rates change by
  // their own size, the largest |qd| over the largest |qdd| of the motion, and no more than its duration.
  double qd_scale = 1;
};

struct Rung {
  MethodSetting setting;
  double error = 0;  // the larger of the next two, the second times qd_scale; infinite where the run failed
  double error_q = 0, error_qd = 0;  // largest of |q_i - reference| and |qd_i - reference| at the end
  double energy_error = 0;  // J, the largest at the end of any step
  double seconds = 0;       // median of the runs, nothing sampled but the end
  int runs = 0;
  long steps = 0, evaluations = 0;
  RunStatus status = RunStatus::finished;
  std::string trouble;
};

struct Ladder {
  const Method* method = nullptr;
  std::vector<Rung> rungs;  // from the coarsest on
  std::string refusal;      // why the method does not take this chain; then there are no rungs
};

struct LadderOptions {
  int runs = 5;               // of each rung
  double longest_run = 0.2;   // s, by the table of costs: finer rungs are left out
  double longest_step = 0.2;  // s
  double lowest_tolerance = 1e-15;
  bool judges_energy = false;  // it ends where the energy's error gains no more, else where the final one does
};

// Throws nothing for what happens during runs.
Ladder climb(Simulation& simulation, const Method& method, const EndState& reference,
             const LadderOptions& options, const StopRequest& stop = {});

// One rung by itself: for the setting that `auto` chose.
Rung measure(Simulation& simulation, const MethodSetting& setting, const EndState& reference, int runs,
             const StopRequest& stop = {});

// Where a run ends, as exactly as it can be had, and how exactly that is.

struct EndReference {
  EndState state;
  double uncertainty = 0;    // of the coordinates: by how much two ways to the reference differ
  double amplification = 1;  // growth of small errors of the start until the end
  std::string how;           // in a few words
};

// The simulation's own method is left out of it and unchanged. Throws Error (numerical) where the motion has
// no end to compare with.
EndReference end_reference(Simulation& simulation);

}  // namespace chainreel
