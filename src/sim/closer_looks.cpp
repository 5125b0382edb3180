#include "sim/closer_looks.hpp"

#include <algorithm>

namespace chainreel {
namespace {

constexpr long kMostStepsLookedAt = 200'000;
constexpr std::size_t kMostWithin = 31;  // of a step
constexpr int kClose = 64;               // instants about one of interest
constexpr int kRounds = 2;

// What lies between an instant's neighbours.
void add_about(double t, const std::vector<double>& seen, std::vector<double>& times) {
  const auto at = std::lower_bound(seen.begin(), seen.end(), t) - seen.begin();
  const double a = seen[std::size_t(std::max<std::ptrdiff_t>(at - 1, 0))];
  const double b = seen[std::min(std::size_t(at) + 1, seen.size() - 1)];
  for (int i = 1; i < kClose; ++i) times.push_back(a + (b - a) * i / kClose);
}

}  // namespace

void look_closer(const Simulation& simulation, const Trajectory& run, std::size_t looks,
                 const std::function<std::vector<double>(const Trajectory&)>& look, const StopRequest& stop) {
  std::vector<double> interesting;
  const auto see_also = [&](std::vector<double> times) {
    times.insert(times.end(), run.t.begin(), run.t.end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end(), [](double a, double b) { return b - a <= 1e-12 * (1 + b); }), times.end());
    Trajectory seen = simulate(simulation, times, stop);
    interesting = look(seen);
    return seen;
  };
  const bool by_steps = run.steps <= kMostStepsLookedAt && !simulation.motion;
  const Trajectory steps = by_steps ? simulate_every_step(simulation, stop) : Trajectory{};
  if (by_steps) look(steps);
  const std::vector<double>& marks = by_steps ? steps.t : run.t;
  const std::size_t within = std::min(kMostWithin, looks / std::max<std::size_t>(marks.size(), 1));
  std::vector<double> times;
  for (std::size_t k = 0; k + 1 < marks.size(); ++k)
    for (std::size_t i = 0; i <= within; ++i) times.push_back(marks[k] + (marks[k + 1] - marks[k]) * double(i) / double(within + 1));
  Trajectory seen = see_also(std::move(times));
  for (int round = 0; round < kRounds && seen.size() > 1; ++round) {
    times.clear();
    for (const double t : interesting) add_about(t, seen.t, times);
    seen = see_also(std::move(times));
  }
}

}  // namespace chainreel
