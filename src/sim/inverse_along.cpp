#include "sim/inverse_along.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"

namespace chainreel {
namespace {

// m or rad: a motion further off is another mechanism's. Tables of a few digits are nearer.
constexpr double kOffConstraints = 1e-4;

class InverseWalk {
 public:
  InverseWalk(const Chain& chain, const ConstraintPlan& plan, const std::string& file, InverseAlong& result)
      : chain_(chain), plan_(plan), file_(file), result_(result), limits_(chain), ws_(chain), q_(std::size_t(chain.nv)), qd_(q_), qdd_(q_), tau_(q_) {
    if (plan.empty()) return;
    set_ = std::make_unique<ConstraintSet>(chain, plan.list);
    cws_ = std::make_unique<ConstrainedWorkspace>(chain, *set_);
    result_.rows = set_->row_names();
    lambda_.resize(std::size_t(set_->rows()));
  }

  void add(const Reference& reference, double t, int line) {
    reference.evaluate(t, q_, qd_, qdd_);
    if (set_)
      press(line);
    else
      compute_inverse_dynamics(chain_, ws_, q_, qd_, qdd_);
    compute_friction(chain_, ws_, qd_);
    for (std::size_t i = 0; i < q_.size(); ++i) {
      const double tau = ws_.tau[i] + ws_.tau_f[i];
      if (!std::isfinite(tau))
        throw Error(ExitCode::numerical,
                    "the torque tau" + std::to_string(i + 1) + " at t = " + format_shortest(t) +
                        " s is no finite number: the motion in this row is too fast for numbers",
                    {file_, line});
      tau_[i] = tau;
    }
    result_.tau.insert(result_.tau.end(), tau_.begin(), tau_.end());
    const double told = result_.t[result_.tau.size() / tau_.size() - 1];
    limits_.check_state(told, q_, qd_);
    limits_.check_effort(told, tau_, false);
    result_.lambda.insert(result_.lambda.end(), lambda_.begin(), lambda_.end());
  }

  const std::vector<LimitEvent>& limits() const { return limits_.events(); }

 private:
  void press(int line) {
    compute_constraints(chain_, ws_, *set_, *cws_, q_, qd_);
    look_at_constraints(line);
    std::fill(lambda_.begin(), lambda_.end(), 0.0);
    for (const ContactForce& contact : plan_.contact_forces)
      multipliers_of_force(chain_, *set_, *cws_, contact.constraint, contact.force, lambda_);
    compute_constrained_inverse_dynamics(chain_, ws_, *set_, *cws_, q_, qd_, qdd_, lambda_);
  }

  void look_at_constraints(int line) {
    const std::size_t nv = q_.size();
    for (std::size_t i = 0; i < lambda_.size(); ++i) {
      double rate = 0, acceleration = cws_->Jcd_qd[i];
      for (std::size_t v = 0; v < nv; ++v) {
        rate += cws_->Jc[i * nv + v] * qd_[v];
        acceleration += cws_->Jc[i * nv + v] * qdd_[v];
      }
      const double off = std::fabs(cws_->phi[i]);
      if (!(off <= kOffConstraints))
        throw Error(ExitCode::bad_input,
                    "the motion in this row is " + format_significant(off, 3) + " off the constraint '" +
                        set_->row_names()[i] + "': a mechanism that is tied so cannot move like this",
                    {file_, line});
      result_.position_error = std::max(result_.position_error, off);
      result_.velocity_error = std::max(result_.velocity_error, std::fabs(rate));
      result_.acceleration_error = std::max(result_.acceleration_error, std::fabs(acceleration));
    }
  }

  const Chain& chain_;
  const ConstraintPlan& plan_;
  const std::string& file_;
  InverseAlong& result_;
  LimitWatch limits_;
  Workspace ws_;
  std::unique_ptr<ConstraintSet> set_;  // null: none
  std::unique_ptr<ConstrainedWorkspace> cws_;
  std::vector<double> q_, qd_, qdd_, tau_, lambda_;
};

}  // namespace

InverseAlong inverse_along(const Chain& chain, const ConstraintPlan& constraints, const RecordedMotion& motion) {
  InverseAlong result;
  result.nv = std::size_t(chain.nv);
  result.t = motion.told_instants();
  InverseWalk walk(chain, constraints, motion.table().file, result);
  for (std::size_t k = 0; k < motion.rows(); ++k) walk.add(motion, motion.instant(k), motion.table().lines[k]);
  result.limits = walk.limits();
  return result;
}

}  // namespace chainreel
