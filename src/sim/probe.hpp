// What torques, events and plots may read at one instant: t, q1.., qd1.., the end effector's position x_G y_G
// z_G and velocity xd_G yd_G zd_G, and the scene's parameters. Filled lazily: kinematics only where a reader
// needs them.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/workspace.hpp"
#include "model/chain.hpp"

namespace chainreel {

using Parameters = std::vector<std::pair<std::string, double>>;

class Probe {
 public:
  Probe(const Chain& chain, const Parameters& parameters);

  // Names by slot, for Expression::parse.
  const std::vector<std::string>& names() const { return names_; }
  bool is_kinematic(int slot) const { return slot >= kinematic_begin_ && slot < kinematic_begin_ + 6; }
  // A rate of a joint or of the end effector.
  bool is_velocity(int slot) const {
    return (slot > nq_ && slot < kinematic_begin_) || (slot >= kinematic_begin_ + 3 && is_kinematic(slot));
  }

  // Moves to an instant of the chain that it was made for. Allocates nothing.
  void set(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, bool with_kinematics);
  std::span<const double> values() const { return values_; }

 private:
  std::vector<std::string> names_;
  std::vector<double> values_;
  int nq_ = 0;
  int kinematic_begin_ = 0;
};

}  // namespace chainreel
