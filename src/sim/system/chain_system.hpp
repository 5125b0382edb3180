// A chain under a torque law, as the methods see it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "dynamics/kernels/taylor_planar.hpp"
#include "dynamics/workspace.hpp"
#include "integrate/dense_lu.hpp"
#include "integrate/system.hpp"
#include "sim/drive/limits.hpp"
#include "sim/drive/pushes.hpp"
#include "sim/drive/state_corners.hpp"
#include "sim/drive/torque.hpp"
#include "sim/system/constrained_chain.hpp"
#include "sim/system/even_sides.hpp"

namespace chainreel {

struct Simulation;

class ChainSystem final : public SecondOrder {
 public:
  ChainSystem(const Chain& chain, TorqueLaw& torque, LimitPolicy limit, const ConstraintPlan& constraints);
  // What a run of it steps: its chain, torques, limits and constraints, whole. It must outlive the system.
  explicit ChainSystem(const Simulation& simulation);

  int nq() const override { return chain_->nq; }
  int nv() const override { return chain_->nv; }
  void acceleration(double t, std::span<const double> q, std::span<const double> v,
                    std::span<double> vd) override;
  void q_rate(std::span<const double> q, std::span<const double> v, std::span<double> q_dot) const override;
  void advance(std::span<double> q, std::span<const double> v, double h) const override;
  void normalize(std::span<double> q) const override;

  // Power of the joint torques less friction and of what pushes, W.
  double power(double t, ConstVec q, ConstVec qd);

  // The joints' torques at this state, cut where the limit policy says so; valid until the next call.
  ConstVec torque(double t, ConstVec q, ConstVec qd);
  ConstVec applied_torque(double t, ConstVec q, ConstVec qd);  // ... with J^T F of what pushes from outside
  ConstVec net_torque(double t, ConstVec q, ConstVec qd);      // ... less tau_f
  ConstVec uncut_torque(double t, ConstVec q, ConstVec qd);  // what the law asks for, whatever the joints can
  // What pushes from outside, about the world's origin.
  Wrench pushed(double t, ConstVec q, ConstVec qd);
  LimitWatch& limits() { return limits_; }

  // The corners of the torque law that depend on the state; null: none. Those of `held` are kept at zero from
  // here on: their sides are, at each evaluation, the mean of both branches at which the switching functions
  // do not change (A. F. Filippov, Differential Equations with Discontinuous Righthand Sides (1988), 4). It is
  // the mean of whole torques, as what stands around the corner and the joints' efforts make them.
  StateCorners* corners() { return torque_->corners(); }
  void hold(std::vector<int> held);
  const std::vector<int>& held() const { return held_; }
  // The sides that hold them at this state, also beyond -1 and 1; where many do, those of EvenSides. False where none do.
  bool find_holding_sides(double t, ConstVec q, ConstVec qd);
  // The rates of all switching functions at the sides that stand, one a corner; valid until the next call.
  ConstVec corner_rates(double t, ConstVec q, ConstVec qd);
  ConstVec last_acceleration() const { return qdd_; }  // of corner_rates

  // Null where there are no constraints: then nothing of them is computed.
  ConstrainedChain* constrained() const { return constrained_.get(); }
  Workspace& workspace() { return ws_; }
  const Chain& chain() const { return *chain_; }
  const TorqueLaw& law() const { return *torque_; }
  LimitPolicy limit_policy() const { return limit_; }
  void count_evaluation() { ++evaluations_; }  // of the dynamics in another form

  long evaluations() const { return evaluations_; }
  int bad_torque() const { return bad_torque_; }  // the first freedom whose torque was not finite, or -1
  void forget_bad_torque() { bad_torque_ = -1; }  // of an attempt that came to nothing

 private:
  void evaluate_torque(double t, ConstVec q, ConstVec qd);
  void evaluate_law(double t, ConstVec q, ConstVec qd);
  void evaluate_uncut(double t, ConstVec q, ConstVec qd);
  void evaluate_mean(double t, ConstVec q, ConstVec qd);
  ConstVec applied() const { return pushes_ == nullptr ? tau_ : tau_applied_; }  // behind evaluate_law
  void accelerate(ConstVec q, ConstVec qd, Vec qdd);
  void solve_for_sides();

  const Chain* chain_;
  TorqueLaw* torque_;
  LimitPolicy limit_;
  LimitWatch limits_;
  Workspace ws_;
  std::unique_ptr<ConstrainedChain> constrained_;
  const Pushes* pushes_;  // null: none
  std::vector<double> tau_;
  std::vector<double> tau_applied_;  // where something pushes
  std::vector<double> tau_net_;   // of a chain with friction
  bool torque_is_known_ = false;  // constant and evaluated: the same tau_ at every instant
  std::vector<int> held_;
  std::vector<int> resting_;  // freedoms whose own rates are held at zero
  bool takes_means_ = false;        // of whole torques: more than the sides between -1 and 1 make of them
  std::vector<double> tau_branch_, held_sides_;
  std::vector<double> q_dot_, qdd_, rates_, wanted_;
  std::vector<double> changes_, sought_, sides_;  // of the rates by the sides, by rows
  DenseLu<double> lu_{0};
  EvenSides even_{0};
  long evaluations_ = 0;
  int bad_torque_ = -1;
};

// A chain under a torque law as a Taylor series, for planar chains of revolute joints under torques that are
// constant, polynomial in t or affine in the state.

// Whether the policy may cut torques.
bool cuts_torques(const Chain& chain, LimitPolicy limit);

// Why this chain under this law has no series, a clause that follows "because"; nothing where it has one.
std::optional<std::string> why_no_series(const Chain& chain, const TorqueLaw& law, LimitPolicy limit);

// Terms up to `highest_order`. Throws Error (bad input) that says why there is none and names dop853.
std::unique_ptr<Series> make_chain_series(ChainSystem& system, int highest_order);

}  // namespace chainreel
