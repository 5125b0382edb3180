// Whether a run can be trusted: the energy that its equations say it has, against the energy that it has.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/drive/linear_drive.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// The energy error is E(t) - E(0) - integral of qd^T (tau - tau_f) dt, signed, J.
struct Audit {
  double energy_start = 0;        // kinetic + potential at t = 0, J
  double largest_kinetic = 0;     // over the samples, and over the steps of a run whose energy was looked at there, J
  double energy_moved = 0;        // by this run, J: the largest of kinetic energy, and of the ranges of potential
                                  // energy and of work, over the same; see energy_scale() for the true motion's
  double largest_error = 0;       // of |error| over the samples, J: with that of dense output between steps
  double largest_error_time = 0;  // s
  std::vector<double> error;      // signed, a number a sample, J
  std::string sha256;             // over little-endian doubles t, q, qd, sample by sample
};

// The first `samples` samples of the trajectory (all of them where negative).
Audit audit_of(const Simulation& simulation, const Trajectory& trajectory, int samples = -1);

// The energy that springs hold: torques that the scene's own text says are a coordinate's spring, see `linear_drives`. J.
class SpringEnergy {
 public:
  explicit SpringEnergy(const Simulation& simulation);
  bool has_springs() const { return !springs_.empty(); }
  double at(ConstVec q) const;

 private:
  std::vector<LinearDrive> springs_;
};

// The energies of a run's first `samples` samples, J; that of springs is part of the total.
struct RunEnergies {
  std::vector<double> kinetic, potential, springs, total;
  bool has_springs = false;
};
RunEnergies energies_along(const Simulation& simulation, const Trajectory& trajectory, int samples);

// Energy errors of single states of a run.
class EnergyBalance {
 public:
  explicit EnergyBalance(const Simulation& simulation);
  double energy_start() const { return energy_start_; }
  struct State {
    double kinetic, potential, error;  // J; springs work like other torques
  };
  State at(ConstVec q, ConstVec qd, double work);

 private:
  const Chain& chain_;
  Workspace ws_;
  double energy_start_;
};

// The energy scale of a motion, J: the largest kinetic energy that it truly has until the simulation's
// duration, by dop853 at 1e-6, so that nothing counts that a cruder method gains from nowhere. The
// simulation's own method is left as it is. Nothing where that run comes to no end.
std::optional<double> energy_scale(Simulation& simulation, const StopRequest& stop = {});

// A run whose energy is looked at at the end of every step, too: Trajectory::energy_at_steps. `between`: as of `simulate`.
Trajectory simulate_audited(const Simulation& simulation, std::span<const double> times,
                            const StopRequest& stop = {}, double between = 0);

}  // namespace chainreel
