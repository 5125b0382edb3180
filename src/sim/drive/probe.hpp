// What torques, events and plots may read at one instant: t, q1.., qd1.., the end effector's position x_G y_G
// z_G and velocity xd_G yd_G zd_G, those of further frames x_H.., the scene's parameters, and lambda1.. of the rows of constraints, which
// torques may not read. Filled lazily: kinematics only where a reader needs them.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

using Parameters = std::vector<std::pair<std::string, double>>;

// A frame of the chain under the name that expressions know it by: H gives x_H y_H z_H xd_H yd_H zd_H.
struct NamedFrame {
  std::string name;
  int frame = 0;  // index into Chain::frames
};
using NamedFrames = std::vector<NamedFrame>;

class Probe {
 public:
  Probe(const Chain& chain, const Parameters& parameters, int rows = 0, const NamedFrames& frames = {});

  // Names by slot, for Expression::parse.
  const std::vector<std::string>& names() const { return names_; }
  bool is_kinematic(int slot) const { return slot >= kinematic_begin_ && slot < kinematic_end(); }
  // A rate of a joint or of a frame.
  bool is_velocity(int slot) const {
    return (slot > nq_ && slot < kinematic_begin_) || (is_kinematic(slot) && (slot - kinematic_begin_) % 6 >= 3);
  }

  // The frame that a kinematic slot reads, and which of its x, y, z.
  int frame_of(const Chain& chain, int slot) const {
    const int which = (slot - kinematic_begin_) / 6;
    return which == 0 ? chain.end_effector : frames_[std::size_t(which - 1)].frame;
  }
  int axis_of(int slot) const { return (slot - kinematic_begin_) % 3; }

  bool is_multiplier(int slot) const {
    return slot >= multiplier_begin_ && slot < multiplier_begin_ + rows_;
  }

  // Moves to an instant of the chain that it was made for. Allocates nothing.
  void set(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, bool with_kinematics);
  // The multipliers at that instant; `rows` numbers.
  void set_multipliers(ConstVec lambda);
  std::span<const double> values() const { return values_; }
  void set_value(int slot, double value) { values_[std::size_t(slot)] = value; }

 private:
  int kinematic_end() const { return kinematic_begin_ + 6 * int(1 + frames_.size()); }

  NamedFrames frames_;
  std::vector<std::string> names_;
  std::vector<double> values_;
  int nq_ = 0;
  int kinematic_begin_ = 0;
  int multiplier_begin_ = 0;
  int rows_ = 0;
};

// Throws Error (bad input) where the chain has no end effector, of which `what` is.
void require_tip_for(const Chain& chain, const std::string& what, const Place& place);
// The same where the slot of the probe is x_G or another of the end effector.
void require_frame_of(const Chain& chain, const Probe& probe, int slot, const Place& place);

}  // namespace chainreel
