// What `method: auto` judges its candidates by: where the run really goes, as far as that can be known. Several runs
// by other methods and tolerances look for each other's mistakes; a run that did not come to its end is none.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/accuracy.hpp"
#include "sim/choice/counted_runs.hpp"
#include "sim/choice/deviation.hpp"

namespace chainreel {

struct ChoiceReference {
  Trajectory run;                   // what candidates are compared with
  Trajectory other;                 // that confirms it: by how much its rates may be off
  MethodSetting setting;            // that gave the first
  std::string how;                  // in words
  MotionSize size;
  int samples = 0;                  // the first so many can be believed; the rest is unknown
  std::vector<double> uncertainty;  // of each of them, in the accuracy's unit
  bool is_whole = false;            // believed until the motion's end
  bool is_quick = false;            // of two runs that are not as exact as can be, and agree far within what is asked for
  bool has_parted = false;          // else: two references contradict each other there
  std::string why_no_further;       // else a clause without end mark: what happens behind the last of them
  // What could be asked for so that the whole run is believed, in the accuracy's unit; where that is known.
  std::optional<double> attainable;
};

// The largest part of what is allowed that the reference's own error may take.
inline constexpr double kShareOfReference = 0.5;

// The quick one; none where those do not agree, or where the most exact ones are as quick.
std::optional<ChoiceReference> find_quick_reference(CountedRuns& runs, const Accuracy& accuracy, std::span<const double> times);

// The most exact one. `times`: rising. Throws Error (numerical) where doubles do not hold what is asked for, and says what can be had.
ChoiceReference find_reference(CountedRuns& runs, const Accuracy& accuracy, std::span<const double> times);

}  // namespace chainreel
