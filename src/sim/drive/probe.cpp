#include "sim/drive/probe.hpp"

#include <algorithm>

#include "dynamics/kinematics.hpp"

namespace chainreel {

Probe::Probe(const Chain& chain, const Parameters& parameters, int rows, const NamedFrames& frames)
    : frames_(frames), nq_(chain.nq), rows_(rows) {
  names_.push_back("t");
  for (int i = 1; i <= chain.nq; ++i) names_.push_back("q" + std::to_string(i));
  for (int i = 1; i <= chain.nv; ++i) names_.push_back("qd" + std::to_string(i));
  kinematic_begin_ = int(names_.size());
  const auto add_frame = [&](const std::string& name) {
    for (const char* part : {"x_", "y_", "z_", "xd_", "yd_", "zd_"}) names_.push_back(part + name);
  };
  add_frame("G");
  for (const NamedFrame& frame : frames_) add_frame(frame.name);
  values_.resize(names_.size());
  for (const auto& [name, value] : parameters) {
    names_.push_back(name);
    values_.push_back(value);
  }
  multiplier_begin_ = int(names_.size());
  for (int i = 1; i <= rows; ++i) names_.push_back("lambda" + std::to_string(i));
  values_.resize(names_.size());
}

void Probe::set_multipliers(ConstVec lambda) {
  std::copy(lambda.begin(), lambda.end(), values_.begin() + multiplier_begin_);
}

void Probe::set(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, bool with_kinematics) {
  values_[0] = t;
  auto next = std::copy(q.begin(), q.end(), values_.begin() + 1);
  next = std::copy(qd.begin(), qd.end(), next);
  if (!with_kinematics) return;
  compute_kinematics(chain, ws, q, qd);
  const auto write = [&](int frame) {
    const Eigen::Vector3d x = frame_position(chain, ws, frame), xd = frame_velocity(chain, ws, frame);
    next = std::copy(xd.begin(), xd.end(), std::copy(x.begin(), x.end(), next));
  };
  // Who reads it has asked for one.
  if (chain.end_effector >= 0)
    write(chain.end_effector);
  else
    next += 6;
  for (const NamedFrame& frame : frames_) write(frame.frame);
}

void require_tip_for(const Chain& chain, const std::string& what, const Place& place) {
  try {
    require_end_effector(chain);
  } catch (const Error& error) {
    throw Error(error.code(), what + " is of the end effector: " + error.problems().front().message, place);
  }
}

void require_frame_of(const Chain& chain, const Probe& probe, int slot, const Place& place) {
  // No other frame may be called G.
  const std::string& name = probe.names()[std::size_t(slot)];
  if (probe.is_kinematic(slot) && name.ends_with("_G")) require_tip_for(chain, name, place);
}

}  // namespace chainreel
