// The corners of a torque law that depend on the state: where it jumps or bends as the motion crosses them.
// In a run each has a side, see expr/corners.hpp, that holds from one crossing to the next.
#pragma once

#include <string>
#include <vector>

#include "expr/corners.hpp"
#include "sim/drive/probe.hpp"

namespace chainreel {

class StateCorners {
 public:
  // The state's among `corners`, whose sides stand in `sides`. Both, and the probe, must outlive it.
  StateCorners(const Corners& corners, std::vector<double>& sides, Probe& probe);

  int count() const { return int(indices_.size()); }
  double side(int k) const { return sides_[index(k)]; }
  void set_side(int k, double side) { sides_[index(k)] = side; }
  bool is_curved(int k) const { return corners_[int(index(k))].is_curved; }
  // Whether the switching function of k reads the side of `other`, be it through further ones. Such come later.
  bool reads(int k, int other) const { return reads_[std::size_t(k)][std::size_t(other)]; }
  // Which freedom's rate it is that is zero where the switching function of k is, and nothing else; -1: there is more to it.
  int rate_of(int k, int nq, int nv) const {
    const int slot = lone_slots_[std::size_t(k)];
    return slot > nq && slot <= nq + nv ? slot - 1 - nq : -1;
  }
  const std::string& text(int k) const { return corners_[int(index(k))].text; }

  // The switching functions, `count` numbers. Allocates nothing.
  void values(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec g);
  // Their rates along a motion with the acceleration qdd; `q_dot` is the rate of q.
  void rates(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec q_dot, ConstVec qd,
             ConstVec qdd, Vec g_dot);

 private:
  std::vector<bool> corners_read_by(const CorneredProgram& value) const;
  // Of the one variable that it reads and with which it is zero; -1.
  int lone_slot_of(const CorneredProgram& value) const;
  std::size_t index(int k) const { return std::size_t(indices_[std::size_t(k)]); }

  const Corners& corners_;
  std::vector<double>& sides_;
  Probe& probe_;
  std::vector<int> indices_;
  std::vector<std::vector<bool>> reads_;  // [k][other]
  std::vector<int> lone_slots_;           // one a k
  std::vector<Dual<double>> duals_;
  std::vector<int> frame_rates_;  // slots of frames' velocities that they read
  bool needs_kinematics_ = false;
};

}  // namespace chainreel
