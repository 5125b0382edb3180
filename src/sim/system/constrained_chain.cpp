#include "sim/system/constrained_chain.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_rows.hpp"

namespace chainreel {
namespace {

// An acceleration, relative to 1 + the rows' own at qdd = 0: what rows contradict each other by where they
// truly do. Stages of a step lie a little off the constraints, where dependent rows need not agree exactly.
constexpr double kUnmet = 1e-6;

double largest_of(ConstVec values) {
  double largest = 0;
  for (const double x : values)
    if (!(std::fabs(x) <= largest)) largest = std::fabs(x);
  return largest;
}

}  // namespace

ConstrainedChain::ConstrainedChain(const Chain& chain, const ConstraintPlan& plan)
    : chain_(&chain),
      set_(chain, plan.list),
      cws_(chain, set_),
      stabilize_(plan.stabilize),
      contact_forces_(plan.contact_forces),
      wanted_(std::size_t(set_.rows())),
      qdd_(std::size_t(chain.nv)),
      curve_s_(cws_.curve_s) {
  if (stabilize_ == Stabilization::baumgarte) options_.gain = plan.gain;
}

bool ConstrainedChain::is_unmet() const {
  const bool doubtful =
      cws_.status == ConstraintStatus::inconsistent || cws_.status == ConstraintStatus::not_converged;
  return doubtful && cws_.residual > kUnmet * (1 + largest_of(cws_.Jcd_qd));
}

void ConstrainedChain::accelerate(Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau, Vec qdd) {
  compute_constrained_dynamics(*chain_, ws, set_, cws_, q, qd, tau, qdd, options_);
  suspicion_ = suspicion_ || is_unmet();
}

void ConstrainedChain::press(Workspace& ws, ConstVec q, ConstVec qd, ConstVec applied, Vec tau) {
  compute_constrained_dynamics(*chain_, ws, set_, cws_, q, qd, applied, qdd_, options_);
  compute_constraints(*chain_, ws, set_, cws_, q, qd);
  const std::size_t nv = tau.size();
  for (const ContactForce& contact : contact_forces_) {
    multipliers_of_force(*chain_, set_, cws_, contact.constraint, contact.force, wanted_);
    const int end = set_.first_row(contact.constraint + 1);
    for (auto i = std::size_t(set_.first_row(contact.constraint)); i < std::size_t(end); ++i)
      for (std::size_t v = 0; v < nv; ++v) tau[v] += cws_.Jc[i * nv + v] * (wanted_[i] - cws_.lambda[i]);
  }
}

Projection ConstrainedChain::project(Workspace& ws, Vec q, Vec qd) {
  const Projection result = project_positions(*chain_, ws, set_, cws_, q);
  project_velocities(*chain_, ws, set_, cws_, q, qd);
  return result;
}

void ConstrainedChain::project_sample(Workspace& ws, Vec q, Vec qd) {
  curve_s_ = cws_.curve_s;
  project(ws, q, qd);
  cws_.curve_s = curve_s_;
}

const ConstrainedWorkspace& ConstrainedChain::rows_at(Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau) {
  curve_s_ = cws_.curve_s;
  compute_constrained_dynamics(*chain_, ws, set_, cws_, q, qd, tau, qdd_, options_);
  compute_constraints(*chain_, ws, set_, cws_, q, qd);
  cws_.curve_s = curve_s_;
  return cws_;
}

ConstrainedChain::Look ConstrainedChain::look(Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau) {
  rows_at(ws, q, qd, tau);
  Look look{largest_of(cws_.phi), 0};
  for (std::size_t i = 0; i < cws_.phi.size(); ++i) {
    double rate = 0;
    for (std::size_t v = 0; v < qd.size(); ++v) rate += cws_.Jc[i * qd.size() + v] * qd[v];
    look.velocity_error = std::max(look.velocity_error, std::fabs(rate));
  }
  return look;
}

bool ConstrainedChain::take_suspicion() {
  const bool was = suspicion_;
  suspicion_ = false;
  return was;
}

std::optional<ConstrainedChain::Unmet> ConstrainedChain::unmet(Workspace& ws, ConstVec q, ConstVec qd,
                                                               ConstVec tau) {
  curve_s_ = cws_.curve_s;
  compute_constrained_dynamics(*chain_, ws, set_, cws_, q, qd, tau, qdd_, options_);
  cws_.curve_s = curve_s_;
  if (!is_unmet()) return std::nullopt;
  const auto larger = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  const auto worst = std::max_element(cws_.r.begin(), cws_.r.end(), larger);
  return Unmet{int(worst - cws_.r.begin()), cws_.residual, cws_.status};
}

}  // namespace chainreel
