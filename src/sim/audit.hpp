// Whether a run can be trusted: the energy that its equations say it has, against the energy that it has.
#pragma once

#include <string>
#include <vector>

#include "sim/simulate.hpp"

namespace chainreel {

struct Audit {
  double energy_start = 0;        // kinetic + potential at t = 0, J
  double largest_kinetic = 0;     // over the samples, J: the scale of the motion
  double largest_error = 0;       // of |E(t) - E(0) - integral of qd^T (tau - tau_f) dt| over the samples, J
  double largest_error_time = 0;  // s
  std::vector<double> error;      // signed, a number a sample, J
  std::string sha256;             // over little-endian doubles t, q, qd, sample by sample
};

// The first `samples` samples of the trajectory (all of them where negative).
Audit audit_of(const Simulation& simulation, const Trajectory& trajectory, int samples = -1);

}  // namespace chainreel
