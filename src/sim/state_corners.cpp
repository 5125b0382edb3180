#include "sim/state_corners.hpp"

#include <algorithm>

namespace chainreel {
namespace {

// s: the accelerations of frames are central differences of their velocities over this.
constexpr double kBesides = 1e-5;

}  // namespace

StateCorners::StateCorners(const Corners& corners, std::vector<double>& sides, Probe& probe)
    : corners_(corners), sides_(sides), probe_(probe), duals_(probe.values().size()), ahead_(duals_.size()) {
  for (int k = 0; k < corners.count(); ++k) {
    if (corners[k].time_alone) continue;
    indices_.push_back(k);
    for (const Instruction& one : corners[k].value.instructions) {
      if (one.operation != Operation::variable || !probe.is_kinematic(one.slot)) continue;
      needs_kinematics_ = true;
      needs_frame_rates_ |= probe.is_velocity(one.slot);
    }
  }
}

void StateCorners::values(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec g) {
  probe_.set(chain, ws, t, q, qd, needs_kinematics_);
  for (int k = 0; k < count(); ++k)
    g[std::size_t(k)] = evaluate<double>(corners_[int(index(k))].value, probe_.values(), sides_);
}

void StateCorners::rates(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec q_dot,
                         ConstVec qd, ConstVec qdd, Vec g_dot) {
  const std::size_t nq = q.size(), nv = qd.size();
  q_.resize(nq);  // once
  qd_.resize(nv);
  const auto probe_beside = [&](double s) {
    for (std::size_t i = 0; i < nq; ++i) q_[i] = q[i] + s * q_dot[i];
    for (std::size_t i = 0; i < nv; ++i) qd_[i] = qd[i] + s * qdd[i];
    probe_.set(chain, ws, t, q_, qd_, needs_kinematics_);
  };
  if (needs_frame_rates_) {
    probe_beside(kBesides);
    std::copy(probe_.values().begin(), probe_.values().end(), ahead_.begin());
    probe_beside(-kBesides);
    for (std::size_t i = 0; i < ahead_.size(); ++i)
      ahead_[i] = (ahead_[i] - probe_.values()[i]) / (2 * kBesides);
  }
  probe_.set(chain, ws, t, q, qd, needs_kinematics_);
  const std::span<const double> values = probe_.values();
  for (std::size_t i = 0; i < duals_.size(); ++i) {
    const bool kinematic = probe_.is_kinematic(int(i));
    // A frame's position stands three places before its velocity.
    double rate = 0;
    if (i == 0) rate = 1;
    else if (i <= nq) rate = q_dot[i - 1];
    else if (i <= nq + nv) rate = qdd[i - 1 - nq];
    else if (kinematic && needs_kinematics_) rate = probe_.is_velocity(int(i)) ? ahead_[i] : values[i + 3];
    duals_[i] = Dual<double>(values[i], rate);
  }
  for (int k = 0; k < count(); ++k)
    g_dot[std::size_t(k)] =
        evaluate<Dual<double>>(corners_[int(index(k))].value, duals_, sides_).du;
}

}  // namespace chainreel
