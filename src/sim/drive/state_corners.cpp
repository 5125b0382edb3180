#include "sim/drive/state_corners.hpp"

#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

// Along one axis of W, of a frame's origin.
double frame_acceleration(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd, int frame,
                          int axis) {
  compute_jacobian(chain, ws, q, frame, Task::linear);
  compute_jacobian_rate(chain, ws, q, qd, frame, Task::linear);
  const TaskBasis basis = task_basis(chain, Task::linear);
  double sum = 0;
  for (std::size_t row = 0; row < basis.directions.size(); ++row) {
    double along = ws.Jd_qd[Eigen::Index(row)];
    for (std::size_t i = 0; i < qdd.size(); ++i) along += ws.J(Eigen::Index(row), Eigen::Index(i)) * qdd[i];
    sum += along * basis.directions[row][axis];
  }
  return sum;
}

}  // namespace

StateCorners::StateCorners(const Corners& corners, std::vector<double>& sides, Probe& probe)
    : corners_(corners), sides_(sides), probe_(probe), duals_(probe.values().size()) {
  for (int k = 0; k < corners.count(); ++k) {
    if (corners[k].time_alone) continue;
    indices_.push_back(k);
    reads_.push_back(corners_read_by(corners[k].value));
    lone_slots_.push_back(lone_slot_of(corners[k].value));
    for (const Instruction& one : corners[k].value.instructions) {
      if (one.operation != Operation::variable || !probe.is_kinematic(one.slot)) continue;
      needs_kinematics_ = true;
      if (probe.is_velocity(one.slot)) frame_rates_.push_back(one.slot);
    }
  }
  for (std::vector<bool>& read : reads_) read.resize(indices_.size());
}

std::vector<bool> StateCorners::corners_read_by(const CorneredProgram& value) const {
  std::vector<bool> read(indices_.size());
  for (const CorneredProgram::Turn& turn : value.turns)
    for (std::size_t k = 0; k < reads_.size(); ++k) {
      if (indices_[k] != turn.corner) continue;
      read[k] = true;
      for (std::size_t inner = 0; inner < reads_[k].size(); ++inner)
        if (reads_[k][inner]) read[inner] = true;
    }
  return read;
}

int StateCorners::lone_slot_of(const CorneredProgram& value) const {
  int slot = -1;
  for (const Instruction& one : value.instructions) {
    if (one.operation != Operation::variable) continue;
    if (slot >= 0 && one.slot != slot) return -1;
    slot = one.slot;
  }
  const std::vector<double> rest(probe_.values().size());
  return slot >= 0 && !value.has_corners() && evaluate<double>(value, rest, sides_) == 0 ? slot : -1;
}

void StateCorners::values(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec g) {
  probe_.set(chain, ws, t, q, qd, needs_kinematics_);
  for (int k = 0; k < count(); ++k)
    g[std::size_t(k)] = evaluate<double>(corners_[int(index(k))].value, probe_.values(), sides_);
}

void StateCorners::rates(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec q_dot, ConstVec qd,
                         ConstVec qdd, Vec g_dot) {
  const std::size_t nq = q.size(), nv = qd.size();
  probe_.set(chain, ws, t, q, qd, needs_kinematics_);
  const std::span<const double> values = probe_.values();
  for (std::size_t i = 0; i < duals_.size(); ++i) {
    const bool kinematic = probe_.is_kinematic(int(i));
    // A frame's position stands three places before its velocity.
    double rate = 0;
    if (i == 0)
      rate = 1;
    else if (i <= nq)
      rate = q_dot[i - 1];
    else if (i <= nq + nv)
      rate = qdd[i - 1 - nq];
    else if (kinematic && needs_kinematics_ && !probe_.is_velocity(int(i)))
      rate = values[i + 3];
    duals_[i] = Dual<double>(values[i], rate);
  }
  for (const int slot : frame_rates_)
    duals_[std::size_t(slot)].du =
        frame_acceleration(chain, ws, q, qd, qdd, probe_.frame_of(chain, slot), probe_.axis_of(slot));
  for (int k = 0; k < count(); ++k)
    g_dot[std::size_t(k)] = evaluate<Dual<double>>(corners_[int(index(k))].value, duals_, sides_).du;
}

}  // namespace chainreel
