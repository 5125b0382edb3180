#include "sim/probe.hpp"

#include <algorithm>

#include "dynamics/kinematics.hpp"

namespace chainreel {

Probe::Probe(const Chain& chain, const Parameters& parameters) : nq_(chain.nq) {
  names_.push_back("t");
  for (int i = 1; i <= chain.nq; ++i) names_.push_back("q" + std::to_string(i));
  for (int i = 1; i <= chain.nv; ++i) names_.push_back("qd" + std::to_string(i));
  kinematic_begin_ = int(names_.size());
  for (const char* name : {"x_G", "y_G", "z_G", "xd_G", "yd_G", "zd_G"}) names_.push_back(name);
  values_.resize(names_.size());
  for (const auto& [name, value] : parameters) {
    names_.push_back(name);
    values_.push_back(value);
  }
}

void Probe::set(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, bool with_kinematics) {
  values_[0] = t;
  auto next = std::copy(q.begin(), q.end(), values_.begin() + 1);
  next = std::copy(qd.begin(), qd.end(), next);
  if (!with_kinematics) return;
  compute_kinematics(chain, ws, q, qd);
  const Eigen::Vector3d x = frame_position(chain, ws, chain.end_effector);
  const Eigen::Vector3d xd = frame_velocity(chain, ws, chain.end_effector);
  next = std::copy(x.begin(), x.end(), next);
  std::copy(xd.begin(), xd.end(), next);
}

}  // namespace chainreel
