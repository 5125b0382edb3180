// A run seen ever closer, where what is looked for lies between its samples: peaks of torques, rates and multipliers.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "sim/simulate.hpp"

namespace chainreel {

// The same run at more instants: at all of its steps and within them, `looks` together where steps are fewer (of more than 200'000
// steps between its samples alone), then twice about those instants that `look` returned of what it saw last. Its own steps
// stay where they are.
void look_closer(const Simulation& simulation, const Trajectory& run, std::size_t looks,
                 const std::function<std::vector<double>(const Trajectory& seen)>& look, const StopRequest& stop = {});

// Of a number how far it goes from zero, and when it first goes as far: a motion that repeats itself has peaks that differ by the errors
// of its run alone, by less than a millionth.
class Farthest {
 public:
  // Of a run of that duration, s.
  explicit Farthest(double duration) : apart_(kApart * duration) {}

  void look(double value, double t) {
    const double size = std::abs(value);
    if (size > std::abs(value_)) value_ = value, at_ = t;
    const bool is_of_first = std::abs(t - first_t_) <= apart_;
    if (is_as_far(value) && (is_of_first ? size > std::abs(first_) : t < first_t_)) first_ = value, first_t_ = t;
    if (!is_as_far(first_)) first_ = value_, first_t_ = at_;
  }
  double value() const { return std::copysign(value_, first_); }
  double t() const { return first_t_; }
  double at() const { return at_; }  // when it is the farthest of all

 private:
  static constexpr double kApart = 2e-3;  // of the duration: peaks nearer to each other are one
  static constexpr double kAsFar = 1e-6;
  bool is_as_far(double value) const { return std::abs(value) >= (1 - kAsFar) * std::abs(value_); }

  double apart_;
  double value_ = 0, at_ = 0;       // the farthest
  double first_ = 0, first_t_ = 0;  // of the first peak that is as far
};

}  // namespace chainreel
