#include "sim/unstable_rest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/format.hpp"
#include "sim/linear_modes.hpp"
#include "sim/drive/pushes.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
namespace {

constexpr double kBalanced = 1e-12;    // rad/s^2 or m/s^2: what rounding leaves of torques that cancel
constexpr double kVisible = 23;        // ln(1e-6 / 1e-16): by then it is as large as what can be seen
constexpr double kBeside = 0.01;       // rad or m: a start that is meant
constexpr int kInstantsOfRest = 65;    // over the duration: at torques that may begin later

// Until when nothing acts on the start, s.
double end_of_rest(const Simulation& simulation) {
  ChainSystem system(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints);
  simulation.torque->leave_pieces();
  double end = simulation.duration;
  if (const Pushes* pushes = simulation.torque->pushes())
    for (const ActingPush& push : pushes->list()) end = std::min(end, push.from);
  std::vector<double> qdd(simulation.qd0.size());
  for (int i = 0; i < kInstantsOfRest; ++i) {
    const double t = simulation.duration * i / (kInstantsOfRest - 1);
    if (t > end) break;
    system.acceleration(t, simulation.q0, simulation.qd0, qdd);
    if (!(largest_of(qdd) <= kBalanced)) return t;
  }
  return end;
}

}  // namespace

std::optional<Doubt> doubt_of_rest(const Simulation& simulation) {
  if (largest_of(simulation.qd0) > 0) return std::nullopt;
  const double end = end_of_rest(simulation);
  if (!(end > 0)) return std::nullopt;
  const Linearisation start = linearise(simulation);
  double growth = 0;
  for (const std::complex<double>& rate : start.rates) growth = std::max(growth, rate.real());
  if (start.about_target || !(growth * end > kVisible)) return std::nullopt;
  const std::size_t coordinate = simulation.q0.size() - 1;
  return Doubt{"rest", growth * end,
               "it starts at rest where all forces cancel and nothing holds it, so that only rounding can move it, which grows e-fold every " +
                   format_significant(1 / growth, 2) + " s: another method shows another motion",
               "--set start.q." + std::to_string(coordinate + 1) + "=" + format_significant(simulation.q0[coordinate] + kBeside, 6) +
                   ", a start beside it"};
}

}  // namespace chainreel
