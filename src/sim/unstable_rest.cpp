#include "sim/unstable_rest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/format.hpp"
#include "sim/linear_modes.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
namespace {

constexpr double kBalanced = 1e-12;  // rad/s^2 or m/s^2: what rounding leaves of torques that cancel
constexpr double kMoved = 1e-6;      // rad or m
constexpr double kBeside = 0.01;     // rad or m: a start that is meant
constexpr int kInstantsOfRest = 33;           // over the duration: at torques that may begin later

double largest_number(const std::vector<double>& x) {
  double largest = 0;
  for (const double one : x) largest = std::max(largest, std::abs(one));
  return largest;
}

// The largest |qdd| that the start has at any of these instants.
double acceleration_at_rest(const Simulation& simulation) {
  ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
  simulation.torque->leave_pieces();
  double largest = 0;
  std::vector<double> qdd(simulation.qd0.size());
  for (int i = 0; i < kInstantsOfRest && largest <= kBalanced; ++i) {
    system.acceleration(simulation.duration * i / (kInstantsOfRest - 1), simulation.q0, simulation.qd0, qdd);
    largest = std::max(largest, largest_number(qdd));
  }
  return largest;
}

// The coordinate that went farthest from the start, and by how much.
std::pair<std::size_t, double> farthest_from_start(const Trajectory& run) {
  std::pair<std::size_t, double> farthest{0, 0};
  for (int k = 1; k < run.size(); ++k)
    for (std::size_t i = 0; i < std::size_t(run.nq); ++i)
      if (const double away = std::abs(run.q_at(k)[i] - run.q_at(0)[i]); away > farthest.second) farthest = {i, away};
  return farthest;
}

}  // namespace

std::optional<Doubt> doubt_of_rest(const Simulation& simulation, const Trajectory& run) {
  if (largest_number(simulation.qd0) > 0 || simulation.torque->pushes() != nullptr || run.size() < 2) return std::nullopt;
  const auto [coordinate, away] = farthest_from_start(run);
  if (!(away > kMoved)) return std::nullopt;
  if (!(acceleration_at_rest(simulation) <= kBalanced)) return std::nullopt;
  const Linearisation start = linearise(simulation);
  double growth = 0;
  for (const std::complex<double>& rate : start.rates) growth = std::max(growth, rate.real());
  if (start.about_target || !(growth > 0)) return std::nullopt;
  const std::string beside = format_significant(simulation.q0[coordinate] + kBeside, 6);
  return Doubt{"rest", away,
               "it starts at rest where all forces cancel and nothing holds it, so that what moves it is rounding, which grows e-fold every " +
                   format_significant(1 / growth, 2) + " s: another method shows another motion",
               "--set start.q." + std::to_string(coordinate + 1) + "=" + beside + ", a start beside it"};
}

}  // namespace chainreel
