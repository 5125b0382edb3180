#include "sim/end_reference.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "sim/chain_system.hpp"
#include "sim/quad_reference.hpp"

namespace chainreel {
namespace {

// Small against the start, large against rounding.
constexpr double kPush = 1e-9;
constexpr int kLooks = 200;  // at rates and their changes

EndState run(Simulation& simulation, const MethodSetting& setting) {
  apply(setting, simulation);
  const double end[] = {simulation.duration};
  const Trajectory trajectory = simulate(simulation, end);
  if (trajectory.status != RunStatus::finished || trajectory.size() == 0)
    throw Error(ExitCode::numerical, "no reference: " + to_string(setting) + " " + trajectory.trouble);
  const ConstVec q = trajectory.q_at(0), qd = trajectory.qd_at(0);
  return {{q.begin(), q.end()}, {qd.begin(), qd.end()}, 1};
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// Of errors of a start coordinate or rate, one by one; the largest. Rotations of a floating base are left
// alone.
double amplification_of(Simulation& simulation, const MethodSetting& setting, const EndState& end) {
  double largest = 1;
  for (std::vector<double>* start : {&simulation.q0, &simulation.qd0}) {
    if (start == &simulation.q0 && simulation.chain.has_floating) continue;
    for (double& x : *start) {
      const double x0 = x;
      x = x0 + kPush;
      const double moved = x - x0;
      largest = std::max(largest, apart(run(simulation, setting).q, end.q) / moved);
      x = x0;
    }
  }
  return largest;
}

// The time in which rates change by their own size; see EndState. Two or three digits are plenty.
double qd_scale_of(Simulation& simulation) {
  apply({&find_method("dop853"), {1e-6, 0}, 0}, simulation);
  std::vector<double> times;
  for (int k = 0; k <= kLooks; ++k) times.push_back(simulation.duration * k / kLooks);
  const Trajectory trajectory = simulate(simulation, times);
  ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
  std::vector<double> qdd(simulation.qd0.size());
  double rate = 0, change = 0;
  for (int k = 0; k < trajectory.size(); ++k) {
    system.acceleration(trajectory.t[std::size_t(k)], trajectory.q_at(k), trajectory.qd_at(k), qdd);
    for (const double x : trajectory.qd_at(k)) rate = std::max(rate, std::abs(x));
    for (const double x : qdd) change = std::max(change, std::abs(x));
  }
  return rate > 0 && rate < change * simulation.duration ? rate / change : simulation.duration;
}

std::optional<EndReference> by_quads(const Simulation& simulation) {
  const double end[] = {simulation.duration};
  const auto quads = quad_reference(simulation, end);
  const auto amplification = quad_amplification(simulation, simulation.duration);
  if (!quads || !amplification) return std::nullopt;
  return EndReference{{quads->q, quads->qd, 1}, quads->uncertainty.back(), *amplification, quads->how};
}

// For torques that cannot be had in quadruple precision.
EndReference by_doubles(Simulation& simulation) {
  const MethodSetting first{&find_method("dop853"), {1e-14, 0}, 0};
  const MethodSetting second{&find_method("radau5"), {1e-11, 0}, 0};
  EndReference reference;
  reference.state = run(simulation, first);
  reference.uncertainty = apart(reference.state.q, run(simulation, second).q);
  reference.amplification = amplification_of(simulation, first, reference.state);
  reference.how = "dop853 at 1e-14 beside radau5, in doubles";
  return reference;
}

}  // namespace

EndReference end_reference(Simulation& simulation) {
  const Method* const method = simulation.method;
  const MethodOptions options = simulation.options;
  const double step = simulation.step;
  const auto quads = by_quads(simulation);
  EndReference reference = quads ? *quads : by_doubles(simulation);
  reference.state.qd_scale = qd_scale_of(simulation);
  simulation.method = method;
  simulation.options = options;
  simulation.step = step;
  return reference;
}

}  // namespace chainreel
