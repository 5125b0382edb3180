#include "sim/audit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hash.hpp"
#include "dynamics/energy.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

constexpr double kScaleTolerance = 1e-6;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void hold(double x) { low = std::min(low, x), high = std::max(high, x); }
  double size() const { return low <= high ? high - low : 0; }
};

// How much of the energy is at stake.
class Stake {
 public:
  void hold(const EnergyBalance::State& state, double work) {
    kinetic_ = std::max(kinetic_, state.kinetic);
    potential_.hold(state.potential);
    work_.hold(work);
  }
  double largest_kinetic() const { return kinetic_; }
  double moved() const { return std::max({kinetic_, potential_.size(), work_.size()}); }

 private:
  double kinetic_ = 0;  // J
  Range potential_, work_;
};

}  // namespace

SpringEnergy::SpringEnergy(const Simulation& simulation) {
  for (const LinearDrive& drive : linear_drives(simulation))
    if (drive.is_spring() && !drive.follows) springs_.push_back(drive);
}

double SpringEnergy::at(ConstVec q) const {
  double energy = 0;
  for (const LinearDrive& spring : springs_) {
    const double stretch = q[std::size_t(spring.freedom)] - spring.rest;  // without floating joints coordinates are freedoms
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

RunEnergies energies_along(const Simulation& simulation, const Trajectory& trajectory, int samples) {
  const SpringEnergy springs(simulation);
  Workspace ws(simulation.chain);
  RunEnergies energies;
  energies.has_springs = springs.has_springs();
  for (int k = 0; k < samples; ++k) {
    const Energy energy = energy_of(simulation.chain, ws, trajectory.q_at(k), trajectory.qd_at(k));
    energies.kinetic.push_back(energy.kinetic);
    energies.potential.push_back(energy.potential);
    energies.springs.push_back(springs.at(trajectory.q_at(k)));
    energies.total.push_back(energy.total() + energies.springs.back());
  }
  return energies;
}

EnergyBalance::EnergyBalance(const Simulation& simulation)
    : chain_(simulation.chain),
      ws_(simulation.chain),
      energy_start_(energy_of(chain_, ws_, simulation.q0, simulation.qd0).total()) {}

EnergyBalance::State EnergyBalance::at(ConstVec q, ConstVec qd, double work) {
  const Energy energy = energy_of(chain_, ws_, q, qd);
  return {energy.kinetic, energy.potential, energy.total() - energy_start_ - work};
}

Audit audit_of(const Simulation& simulation, const Trajectory& trajectory, int samples) {
  const int count = samples < 0 ? trajectory.size() : std::min(samples, trajectory.size());
  Audit audit;
  EnergyBalance balance(simulation);
  Sha256 hash;
  audit.energy_start = balance.energy_start();
  Stake stake;
  for (int k = 0; k < count; ++k) {
    const auto i = std::size_t(k);
    const auto state = balance.at(trajectory.q_at(k), trajectory.qd_at(k), trajectory.work[i]);
    audit.error.push_back(state.error);
    stake.hold(state, trajectory.work[i]);
    if (std::abs(state.error) > audit.largest_error) {
      audit.largest_error = std::abs(state.error);
      audit.largest_error_time = trajectory.t[i];
    }
    hash.add(std::span<const double>(&trajectory.t[i], 1));
    hash.add(trajectory.q_at(k));
    hash.add(trajectory.qd_at(k));
  }
  audit.largest_kinetic = stake.largest_kinetic();
  audit.energy_moved = stake.moved();
  // Frames may stand where a fast motion turns round, all of them.
  if (const auto& steps = trajectory.energy_at_steps; steps && samples < 0) {
    audit.largest_kinetic = std::max(audit.largest_kinetic, steps->largest_kinetic);
    audit.energy_moved = std::max(audit.energy_moved, steps->moved);
  }
  audit.sha256 = hash.finish();
  return audit;
}

std::optional<double> energy_scale(Simulation& simulation, const StopRequest& stop) {
  const MethodSetting own{simulation.method, simulation.options, simulation.step};
  apply({&find_method("dop853"), {kScaleTolerance, 0}, 0}, simulation);
  EnergyBalance balance(simulation);
  double largest = balance.at(simulation.q0, simulation.qd0, 0).kinetic;
  const Trajectory trajectory =
      simulate(simulation, {}, stop, [&](double, ConstVec q, ConstVec qd, double work) {
        largest = std::max(largest, balance.at(q, qd, work).kinetic);
      });
  apply(own, simulation);
  return is_complete(trajectory.status) ? std::optional(largest) : std::nullopt;
}

Trajectory simulate_audited(const Simulation& simulation, std::span<const double> times,
                            const StopRequest& stop, double between) {
  EnergyBalance balance(simulation);
  EnergyAtSteps seen;
  Stake stake;
  stake.hold(balance.at(simulation.q0, simulation.qd0, 0), 0);
  Trajectory trajectory =
      simulate(simulation, times, stop, [&](double t, ConstVec q, ConstVec qd, double work) {
        const EnergyBalance::State state = balance.at(q, qd, work);
        stake.hold(state, work);
        seen.at_end = state.error;
        if (std::abs(seen.at_end) <= seen.largest_error) return;
        seen.signed_error = seen.at_end;
        seen.largest_error = std::abs(seen.at_end);
        seen.time = t;
      }, between);
  seen.largest_kinetic = stake.largest_kinetic();
  seen.moved = stake.moved();
  trajectory.energy_at_steps = seen;
  return trajectory;
}

}  // namespace chainreel
