// Where the steps of a run end. Of the loop in sim/simulate alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/simulate.hpp"
#include "sim/workload.hpp"

namespace chainreel {

inline constexpr double kSameInstant = 1e-9;  // of a step: two instants closer than this are one
inline constexpr double kSameBreak = 1e-14;   // of the duration, where the method chooses its steps

// The instants at which steps end: whole steps, and a shorter last one where the duration is no multiple of
// the step; breaks of the torque law; where the method chooses its steps, the breaks and the duration alone.
class StepGrid {
 public:
  explicit StepGrid(const Simulation& simulation)
      : step_(simulation.step),
        duration_(simulation.duration),
        longest_(longest_step_of(simulation)),
        breaks_(simulation.torque->breaks(duration_)) {
    std::sort(breaks_.begin(), breaks_.end());
    // A step from break to break may be as short as time can tell; one to the grid may not.
    same_ = step_ > 0 ? same_instant(simulation) : kSameBreak * duration_;
    if (step_ <= 0) return;
    whole_steps_ = long(std::floor(std::min(steps_of(simulation), 2 * kMostSteps) + kSameInstant));
    remainder_ = duration_ - double(whole_steps_) * step_;
    if (remainder_ <= kSameInstant * step_) remainder_ = 0;
  }

  bool at_end(double now) const {
    return step_ > 0 ? whole_ == whole_steps_ && (remainder_ == 0 || now == duration_) : now == duration_;
  }

  struct Next {
    double end, h;
    bool is_break;  // of the torque law: methods start anew there
  };

  // The next multiple of the step, the duration, a break or the longest step's end that comes first. A step from multiple to
  // multiple has the step's own length, so that it does not depend on where it stands.
  Next next(double now) {
    before_ = {whole_, on_grid_};
    while (next_break_ < breaks_.size() && breaks_[next_break_] <= now + same_) ++next_break_;
    const double end_of_piece = next_break_ < breaks_.size() ? breaks_[next_break_] : kNever;
    const double first = std::min(end_of_piece, cut_);
    const bool last = step_ <= 0 || whole_ == whole_steps_;
    double grid = last ? duration_ : double(whole_ + 1) * step_;
    if (step_ <= 0 && longest_ > 0 && grid - now > longest_ + same_) grid = now + longest_;
    if (first < grid - same_) {
      on_grid_ = false;
      return {first, first - now, true};
    }
    if (step_ <= 0) return {grid, grid - now, first <= (grid < duration_ ? grid + same_ : grid)};
    const double h = on_grid_ ? (last ? remainder_ : step_) : grid - now;
    if (!last) ++whole_;
    on_grid_ = true;
    return {grid, h, first <= grid + same_};
  }

  // The step that was asked for last is taken again, and ends at `cut` if nothing comes before.
  void cut_at(double cut) {
    std::tie(whole_, on_grid_) = before_;
    cut_ = cut;
  }
  void forget_cut() { cut_ = kNever; }
  bool is_cut() const { return cut_ < kNever; }

  // The middle of the piece between breaks that begins at `now`, or holds it.
  double middle_of_piece(double now) const {
    const auto next = std::upper_bound(breaks_.begin(), breaks_.end(), now + same_);
    const double begin = next == breaks_.begin() ? 0 : *(next - 1);
    return 0.5 * (std::max(begin, 0.0) + std::min(next == breaks_.end() ? duration_ : *next, duration_));
  }
  double same() const { return same_; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  double step_, duration_, longest_, same_;
  long whole_steps_ = 0;  // in the run
  double remainder_ = 0;  // s, after the whole steps
  long whole_ = 0;        // multiples of the step passed
  bool on_grid_ = true;   // now is such a multiple
  std::vector<double> breaks_;
  std::size_t next_break_ = 0;
  double cut_ = kNever;  // a break found on the way
  std::pair<long, bool> before_{0, true};
};

}  // namespace chainreel
