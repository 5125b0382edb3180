// Speed against accuracy: every method at every rung of its ladder of steps or tolerances, timed and compared
// with a reference.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sim/choice/choose_method.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Where the run goes, far more exactly than any rung.
struct ReferenceRun {
  std::vector<double> t;      // rising, behind the start; the last is the run's end
  std::vector<double> q, qd;  // as many numbers each time
  // By which errors of qd are multiplied to stand beside those of q, s: the time in which rates change by
  // their own size, the largest |qd| over the largest |qdd| of the motion, and no more than its duration.
  double qd_scale = 1;
  double energy = 0;  // J: the motion's energy scale

  ConstVec q_at(std::size_t k) const { return row(q, k); }
  ConstVec qd_at(std::size_t k) const { return row(qd, k); }

 private:
  ConstVec row(const std::vector<double>& rows, std::size_t k) const {
    const std::size_t width = rows.size() / t.size();
    return ConstVec(rows).subspan(k * width, width);
  }
};

// Of q and of qd, largest of |q_i - reference| and of |qd_i - reference|.
struct StateError {
  double q = 0, qd = 0;
  double size = 0;  // the larger of both, the second times qd_scale; infinite where the run failed
};

struct Rung {
  MethodSetting setting;
  StateError way;           // the largest at the reference's instants, of fixed steps at those at which one ends, and at all where q is off by a tenth of the motion
  StateError final;         // at the end
  double energy_error = 0;  // J, the largest at the end of any step, and within steps where it is a tenth of the motion's
  double seconds = 0;       // median of the runs, nothing sampled but the end
  int runs = 0;
  long steps = 0, evaluations = 0;
  RunStatus status = RunStatus::finished;
  std::string trouble;
};

// By which error rungs are judged.
enum class Judged { way, final, energy };
double judged_error(const Rung& rung, Judged judged);

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
  Judged judged = Judged::way;  // it ends where this error gains no more
};

// Throws nothing for what happens during runs.
Ladder climb(Simulation& simulation, const Method& method, const ReferenceRun& reference,
             const LadderOptions& options, const StopRequest& stop = {});

// One rung by itself. Where its first run takes more than `longest`, s, it is ended there, with RunStatus::out_of_budget.
Rung measure(Simulation& simulation, const MethodSetting& setting, const ReferenceRun& reference, int runs,
             const StopRequest& stop = {}, double longest = std::numeric_limits<double>::infinity());

// The reference, as exact as it can be had, and how exact that is.
struct LadderReference {
  ReferenceRun run;
  double uncertainty = 0;        // of the coordinates at any of its instants: by how much two ways to it differ
  double final_uncertainty = 0;  // at the end
  double amplification = 1;      // growth of small errors of the start until the end
  std::string how;               // in a few words
};

// The simulation's own method is left out of it and unchanged. Throws Error (numerical) where the motion has
// no end to compare with.
LadderReference find_reference_run(Simulation& simulation, const StopRequest& stop = {});

}  // namespace chainreel
