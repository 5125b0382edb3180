#include "draw/layers/acting.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/format.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/skeleton.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

constexpr int kMostLabels =
    4;  // of weights: more of them would hide the chain, and the legend says what they are

}  // namespace

Acting::Acting(const Chain& chain, const Simulation* simulation, const Trajectory& trajectory,
               const ActingLayers& layers)
    : chain_(&chain), layers_(layers) {
  if ((layers.torque || layers.constraint_force) && simulation == nullptr)
    throw std::logic_error("torques are drawn of a run whose simulation is known");
  if (layers.torque) tau_ = torques_along(*simulation, trajectory);
  if (layers.constraint_force) reactions_ = reactions_along(*simulation, trajectory);
}

void Acting::add_torques(std::vector<WorldVector>& vectors, const Workspace& ws, int k) const {
  const double* tau = tau_.data() + std::size_t(k) * std::size_t(chain_->nv);
  for (std::size_t b = 1; b < chain_->bodies.size(); ++b) {
    const Joint& joint = chain_->bodies[b].joint;
    const Eigen::Isometry3d X_WB = pose_of(ws, int(b));
    const Vector3d place = X_WB.translation();
    const double* own = tau + joint.v_index;
    const std::string label = "tau_{" + std::to_string(joint.v_index + 1) + "}";
    if (joint.kind == JointKind::floating) {
      // Nothing drives a floating base, unless the scene says so: then a force and a moment in axes of the
      // body.
      const Vector3d f = X_WB.linear() * Vector3d(own[0], own[1], own[2]);
      const Vector3d m = X_WB.linear() * Vector3d(own[3], own[4], own[5]);
      if (f.norm() > 0) vectors.push_back({VectorKind::joint_force, place, f, {}, {}, "f"});
      if (m.norm() > 0) vectors.push_back({VectorKind::torque, place, m, m.normalized(), {}, "m"});
      continue;
    }
    // A joint that follows another one has no drive of its own.
    if (joint.ratio != 1 || joint.offset != 0) continue;
    const Vector3d axis = X_WB.linear() * joint.axis;
    if (joint.kind == JointKind::revolute)
      vectors.push_back({VectorKind::torque, place, *own * axis, axis, Vector3d::Zero(), label});
    else
      vectors.push_back({VectorKind::joint_force, place, *own * axis, Vector3d::Zero(), axis, label});
  }
}

void Acting::add_weights(std::vector<WorldVector>& vectors, const Workspace& ws) const {
  int heavy = 0;
  for (std::size_t b = 1; b < chain_->bodies.size(); ++b) heavy += chain_->bodies[b].inertia.mass > 0 ? 1 : 0;
  int number = 0;
  for (std::size_t b = 1; b < chain_->bodies.size(); ++b) {
    const Inertia& inertia = chain_->bodies[b].inertia;
    if (!(inertia.mass > 0)) continue;
    ++number;
    const std::string label = heavy <= kMostLabels ? "m_{" + std::to_string(number) + "} g" : "";
    vectors.push_back({VectorKind::weight, pose_of(ws, int(b)) * inertia.com, inertia.mass * chain_->gravity,
                       Vector3d::Zero(), Vector3d::Zero(), label});
  }
}

std::vector<WorldVector> Acting::at(const Workspace& ws, int k) const {
  std::vector<WorldVector> vectors;
  const Vector3d none = Vector3d::Zero();
  if (layers_.gravity) add_weights(vectors, ws);
  if (layers_.torque) add_torques(vectors, ws, k);
  if (layers_.velocity)
    vectors.push_back({VectorKind::velocity, frame_position(*chain_, ws, chain_->end_effector),
                       frame_velocity(*chain_, ws, chain_->end_effector), none, none, "v"});
  if (reactions_.empty()) return vectors;
  const std::vector<Reaction>& reactions = reactions_[std::size_t(k)];
  for (std::size_t i = 0; i < reactions.size(); ++i)
    vectors.push_back({VectorKind::constraint, frame_position(*chain_, ws, reactions[i].frame),
                       reactions[i].force, none, none,
                       reactions.size() == 1 ? "f_c" : "f_{c" + std::to_string(i + 1) + "}"});
  return vectors;
}

std::vector<ScaleEntry> scale_entries(const VectorScales& scales, const std::vector<VectorKind>& shown,
                                      bool named, const Theme& theme) {
  std::vector<ScaleEntry> entries;
  for (const VectorKind kind : shown) {
    const VectorScale scale = scales.of(kind);
    const std::string name = named ? name_of(kind) + " " : "";
    const auto mark = kind == VectorKind::torque       ? ScaleEntry::Mark::turn
                      : kind == VectorKind::constraint ? ScaleEntry::Mark::dashed_arrow
                                                       : ScaleEntry::Mark::arrow;
    if (scale.largest > 0) {
      const double value = round_length(scale.largest);
      entries.push_back({mark, scale.on_page(value), color_of(kind, theme),
                         name + format_shortest(value) + "\u2009" + unit_of(kind)});
    } else if (kind == VectorKind::torque) {
      // Rings are drawn where nothing acts; arrows are not.
      entries.push_back({mark, 0, color_of(kind, theme), name + "0"});
    }
  }
  return entries;
}

std::vector<VectorKind> kinds_shown(const Chain& chain, const ActingLayers& layers) {
  bool turns = false, slides = false;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    turns |= chain.bodies[b].joint.kind == JointKind::revolute;
    slides |= chain.bodies[b].joint.kind == JointKind::prismatic;
  }
  std::vector<VectorKind> kinds;
  if (layers.torque && turns) kinds.push_back(VectorKind::torque);
  if (layers.torque && slides) kinds.push_back(VectorKind::joint_force);
  if (layers.velocity) kinds.push_back(VectorKind::velocity);
  if (layers.gravity) kinds.push_back(VectorKind::weight);
  if (layers.constraint_force) kinds.push_back(VectorKind::constraint);
  return kinds;
}

std::string equation_of_motion(bool constrained) {
  return constrained ? "M(q) qdd + h(q, qd) + J_c^T lambda = tau" : "M(q) qdd + h(q, qd) = tau";
}

std::vector<SymbolColor> equation_colors(const ActingLayers& layers, const Theme& theme) {
  std::vector<SymbolColor> colors;
  if (layers.torque) colors.push_back({"tau", theme.torque});
  if (layers.constraint_force) colors.push_back({"lambda", theme.constraint});
  return colors;
}

}  // namespace chainreel
