#include "sim/audit.hpp"

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"
#include "dynamics/energy.hpp"

namespace chainreel {

Audit audit_of(const Simulation& simulation, const Trajectory& trajectory, int samples) {
  const int count = samples < 0 ? trajectory.size() : std::min(samples, trajectory.size());
  Audit audit;
  Workspace ws(simulation.chain);
  Sha256 hash;
  audit.energy_start = energy_of(simulation.chain, ws, simulation.q0, simulation.qd0).total();
  for (int k = 0; k < count; ++k) {
    const auto i = std::size_t(k);
    const Energy energy = energy_of(simulation.chain, ws, trajectory.q_at(k), trajectory.qd_at(k));
    const double error = energy.total() - audit.energy_start - trajectory.work[i];
    audit.error.push_back(error);
    audit.largest_kinetic = std::max(audit.largest_kinetic, energy.kinetic);
    if (std::abs(error) > audit.largest_error) {
      audit.largest_error = std::abs(error);
      audit.largest_error_time = trajectory.t[i];
    }
    hash.add(std::span<const double>(&trajectory.t[i], 1));
    hash.add(trajectory.q_at(k));
    hash.add(trajectory.qd_at(k));
  }
  audit.sha256 = hash.finish();
  return audit;
}

}  // namespace chainreel
