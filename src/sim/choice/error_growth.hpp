// How errors grow in a motion that forgets where it came from, so that a run whose errors are as large as the motion itself
// can be told from one that nearly held.
#pragma once

#include <vector>

namespace chainreel {

class ErrorGrowth {
 public:
  // `small`: up to which errors grow as small ones do, in their unit.
  explicit ErrorGrowth(double small) : small_(small) {}

  // Of one run: errors at each sample. Runs whose error at the end is small tell how errors grow until there.
  void learn(const std::vector<double>& errors);
  // What the largest error of a run would be, had it gone on to grow from where it was small for the last time as in the
  // run known in which it grew the least; at least the largest it has.
  double unbounded(const std::vector<double>& errors) const;

 private:
  double small_;
  std::vector<double> growth_;  // from each sample to the last, the least of the runs known
};

}  // namespace chainreel
