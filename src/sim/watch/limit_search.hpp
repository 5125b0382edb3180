// When in a step a joint passed a limit.
#pragma once

#include <optional>
#include <vector>

#include "integrate/integrator.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {

// By how much a state is beyond the limit that `seen` names; negative within it. An effort is that which the
// law asks for, before it is cut.
double excess_of(const LimitEvent& seen, ChainSystem& system, double t, ConstVec q, ConstVec qd);

// What passes a limit and comes back within the last step is found on dense output, at looks and at the turns between them.
class LimitSearch {
 public:
  explicit LimitSearch(ChainSystem& system);

  // Shows such states to the system's LimitWatch. `looks`: parts of the step.
  void look_within(Integrator& integrator, int looks);

 private:
  void read(double t, ConstVec q, ConstVec qd, std::vector<double>& distances);
  void look_for_a_visit(Integrator& integrator, std::size_t measure, double a, double b);

  ChainSystem& system_;
  std::vector<double> q_, qd_, tau_;  // of a look; tau_: uncut, none where no effort is limited
  std::vector<double> before_, now_, change_;  // a measure each; the last: from look to look
  double known_at_ = -1;                       // of before_
};

// `seen` with the first instant of the last step at which it was beyond, and the value there; by dense
// output, looked at like events, and where it was seen. Empty where it never was, as where an attempt that was rejected saw it.
std::optional<LimitEvent> first_passing(const LimitEvent& seen, ChainSystem& system, Integrator& integrator);

}  // namespace chainreel
