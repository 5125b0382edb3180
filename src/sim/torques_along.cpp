#include "sim/torques_along.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "sim/closer_looks.hpp"

namespace chainreel {
namespace {

// The frame at which a constraint holds the robot; "" for conditions on coordinates.
struct HeldFrame {
  std::string operator()(const DistanceConstraint& c) const { return c.a; }
  std::string operator()(const CloseConstraint& c) const { return c.a; }
  std::string operator()(const JointConstraint&) const { return ""; }
  std::string operator()(const LinearConstraint&) const { return ""; }
  template <class C>
  std::string operator()(const C& c) const {
    return c.frame;
  }
};

}  // namespace

void hold_as_then(ChainSystem& system, const Simulation& simulation, const Trajectory& trajectory, double t) {
  const auto& holds = trajectory.holds;
  const auto found = std::find_if(holds.begin(), holds.end(),
                                  [t](const auto& one) { return one.begin <= t && t <= one.end; });
  // At the start, where friction of what rests has no sign of its own, the torques are those with which the motion begins.
  StateCorners* corners = system.corners();
  const int count = corners == nullptr ? 0 : corners->count();
  const bool is_start = t <= 0 && count > 0 && int(trajectory.start_sides.size()) == count;
  bool has_sides = !system.held().empty();
  for (int k = 0; k < count; ++k) has_sides = has_sides || !std::isnan(corners->side(k));
  if (found == holds.end() && !has_sides && !is_start) return;
  simulation.torque->leave_pieces();
  system.hold(found == holds.end() ? std::vector<int>() : found->corners);
  for (int k = 0; is_start && k < count; ++k) corners->set_side(k, trajectory.start_sides[std::size_t(k)]);
}

std::vector<double> torques_along(const Simulation& simulation, const Trajectory& trajectory) {
  ChainSystem system(simulation);
  std::vector<double> torques;
  torques.reserve(std::size_t(trajectory.size()) * std::size_t(simulation.chain.nv));
  for (int k = 0; k < trajectory.size(); ++k) {
    const double t = trajectory.t[std::size_t(k)];
    hold_as_then(system, simulation, trajectory, t);
    const ConstVec tau = system.torque(t, trajectory.q_at(k), trajectory.qd_at(k));
    torques.insert(torques.end(), tau.begin(), tau.end());
  }
  simulation.torque->leave_pieces();
  return torques;
}

std::vector<double> multipliers_along(const Simulation& simulation, const Trajectory& trajectory) {
  ChainSystem system(simulation);
  ConstrainedChain& constrained = *system.constrained();
  std::vector<double> multipliers;
  multipliers.reserve(std::size_t(trajectory.size()) * std::size_t(trajectory.rows));
  simulation.torque->leave_pieces();
  for (int k = 0; k < trajectory.size(); ++k) {
    const double t = trajectory.t[std::size_t(k)];
    const ConstVec q = trajectory.q_at(k), qd = trajectory.qd_at(k);
    hold_as_then(system, simulation, trajectory, t);
    constrained.look(system.workspace(), q, qd, system.applied_torque(t, q, qd));
    const ConstVec lambda = constrained.lambda();
    multipliers.insert(multipliers.end(), lambda.begin(), lambda.end());
  }
  simulation.torque->leave_pieces();
  return multipliers;
}

namespace {

void take_larger(std::vector<Farthest>& largest, const Trajectory& run) {
  if (run.rows != int(largest.size()) || run.lambda.empty()) return;
  for (int k = 0; k < run.size(); ++k) {
    const ConstVec lambda = run.lambda_at(k);
    for (std::size_t i = 0; i < largest.size(); ++i) largest[i].look(lambda[i], run.t[std::size_t(k)]);
  }
}

}  // namespace

std::vector<LargestMultiplier> largest_multipliers(const Simulation& simulation, const Trajectory& trajectory) {
  constexpr std::size_t kLooks = 60'000;
  std::vector<Farthest> largest(std::size_t(trajectory.rows), Farthest(simulation.duration));
  const auto found = [&] {
    std::vector<LargestMultiplier> all;
    for (const Farthest& one : largest) all.push_back({one.value(), one.t()});
    return all;
  };
  take_larger(largest, trajectory);
  if (trajectory.between) take_larger(largest, *trajectory.between);
  if (largest.empty() || simulation.motion || trajectory.status != RunStatus::finished) return found();
  look_closer(simulation, trajectory, kLooks, [&](const Trajectory& seen) {
    take_larger(largest, seen);
    std::vector<double> instants;
    for (const Farthest& one : largest) instants.insert(instants.end(), {one.at(), one.t()});
    return instants;
  });
  return found();
}

std::vector<double> constraint_errors_along(const Simulation& simulation, const Trajectory& trajectory) {
  ChainSystem system(simulation);
  ConstrainedChain& constrained = *system.constrained();
  const std::vector<double> no_torque(std::size_t(simulation.chain.nv), 0.0);
  std::vector<double> errors;
  errors.reserve(std::size_t(trajectory.size()) * std::size_t(trajectory.rows));
  for (int k = 0; k < trajectory.size(); ++k) {
    const std::vector<double>& phi = constrained.rows_at(system.workspace(), trajectory.q_at(k), trajectory.qd_at(k), no_torque).phi;
    errors.insert(errors.end(), phi.begin(), phi.end());
  }
  return errors;
}

std::vector<LinearDrive> linear_drives(const Simulation& simulation) {
  std::vector<LinearDrive> drives = simulation.torque->linear_drives(simulation.chain);
  std::erase_if(drives, [&](const LinearDrive& drive) {
    const int body = body_of_freedom(simulation.chain, drive.freedom);
    return body < 0 || (simulation.limit == LimitPolicy::clamp &&
                        std::isfinite(simulation.chain.bodies[std::size_t(body)].joint.limit.effort));
  });
  for (LinearDrive& drive : drives) drive.whole = drive.whole && simulation.constraints.contact_forces.empty();
  return drives;
}

std::vector<double> references_along(const Simulation& simulation, const Trajectory& trajectory) {
  const auto n = std::size_t(simulation.chain.nv);
  std::vector<double> references;
  if (simulation.chain.has_floating) return references;
  simulation.torque->leave_pieces();
  for (int k = 0; k < trajectory.size(); ++k) {
    const ConstVec q = trajectory.q_at(k);
    references.insert(references.end(), q.begin(), q.end());
    const Vec own = Vec(references).last(n);
    if (!simulation.torque->reference_at(trajectory.t[std::size_t(k)], own)) return {};
    for (std::size_t i = 0; i < n; ++i)
      if (!simulation.torque->follows(i)) own[i] = q[i];
  }
  return references;
}

namespace {

// The rows of constraint c that hold places, not directions.
std::vector<int> force_rows(const ConstraintSet& set, std::size_t c) {
  std::vector<int> rows;
  for (int row = set.first_row(c); row < set.first_row(c + 1); ++row) {
    const ConstraintSet::Kind kind = set.row_list()[std::size_t(row)].kind;
    if (kind != ConstraintSet::Kind::parallel && kind != ConstraintSet::Kind::coordinates) rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::vector<std::vector<Reaction>> reactions_along(const Simulation& simulation,
                                                   const Trajectory& trajectory) {
  if (simulation.constraints.empty() || trajectory.rows == 0) return {};
  const Chain& chain = simulation.chain;
  const ConstraintSet set(chain, simulation.constraints.list);
  ConstrainedWorkspace cws(chain, set);
  Workspace ws(chain);
  std::vector<std::vector<Reaction>> reactions(std::size_t(trajectory.size()));
  for (int k = 0; k < trajectory.size(); ++k) {
    compute_constraints(chain, ws, set, cws, trajectory.q_at(k), trajectory.qd_at(k));
    for (std::size_t c = 0; c < set.constraints().size(); ++c) {
      const std::string frame = std::visit(HeldFrame{}, set.constraints()[c]);
      if (frame.empty()) continue;
      // The multipliers are what the robot exerts on its surroundings; the reaction is the opposite.
      reactions[std::size_t(k)].push_back(
          {find_frame(chain, frame), -contact_force(chain, set, cws, c, trajectory.lambda_at(k)), force_rows(set, c)});
    }
  }
  return reactions;
}

std::vector<TaskTarget> task_targets_along(const Simulation& simulation, const Trajectory& trajectory) {
  std::vector<TaskTarget> targets;
  simulation.torque->leave_pieces();
  for (int k = 0; k < trajectory.size(); ++k) {
    std::optional<TaskTarget> own = simulation.torque->task_at(trajectory.t[std::size_t(k)]);
    if (!own) return {};
    targets.push_back(*own);
  }
  return targets;
}

std::optional<double> rounding_of(const Chain& chain, const std::vector<std::vector<Reaction>>& reactions) {
  constexpr double kRounding = 1e-6;
  double largest = 0;
  for (const std::vector<Reaction>& instant : reactions)
    for (const Reaction& one : instant) largest = std::max(largest, one.force.norm());
  if (reactions.empty() || !(largest < kRounding * mass_of(chain) * std::max(1.0, chain.gravity.norm()))) return {};
  return largest;
}

}  // namespace chainreel
