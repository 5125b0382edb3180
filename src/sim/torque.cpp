#include "sim/torque.hpp"

#include <algorithm>
#include <limits>

#include "core/format.hpp"
#include "expr/expression.hpp"
#include "model/read_chain.hpp"

namespace chainreel {
namespace {

class ConstantTorque final : public TorqueLaw {
 public:
  explicit ConstantTorque(std::vector<double> tau) : tau_(std::move(tau)) {}

  void evaluate(const Chain&, Workspace&, double, ConstVec, ConstVec, Vec tau) override {
    std::copy(tau_.begin(), tau_.end(), tau.begin());
  }
  bool is_constant() const override { return true; }

 private:
  std::vector<double> tau_;
};

class ExpressionTorque final : public TorqueLaw {
 public:
  ExpressionTorque(Probe probe, std::vector<Expression> entries)
      : probe_(std::move(probe)), entries_(std::move(entries)) {
    for (const Expression& entry : entries_) {
      for (int slot : entry.used_variables()) {
        needs_kinematics_ |= probe_.is_kinematic(slot);
        depends_on_velocity_ |= probe_.is_velocity(slot);
      }
    }
  }

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    probe_.set(chain, ws, t, q, qd, needs_kinematics_);
    for (std::size_t i = 0; i < entries_.size(); ++i) tau[i] = entries_[i].evaluate(probe_.values());
  }
  bool depends_on_velocity() const override { return depends_on_velocity_; }

 private:
  Probe probe_;
  std::vector<Expression> entries_;
  bool needs_kinematics_ = false;
  bool depends_on_velocity_ = false;
};

// Expressions and constants for all joints, with single joints driven by controls instead.
class MixedTorque final : public TorqueLaw {
 public:
  explicit MixedTorque(std::size_t n) : one_(n) {}
  void set_rest(std::unique_ptr<TorqueLaw> rest) { rest_ = std::move(rest); }
  void add(std::size_t joint, std::unique_ptr<TorqueLaw> law) {
    controls_.push_back({joint, std::move(law)});
  }

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    rest_->evaluate(chain, ws, t, q, qd, tau);
    for (const auto& [joint, law] : controls_) {
      law->evaluate(chain, ws, t, q, qd, one_);
      tau[joint] = one_[joint];
    }
  }
  std::vector<double> breaks() const override {
    std::vector<double> all;
    for (const auto& [joint, law] : controls_) {
      const std::vector<double> some = law->breaks();
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

 private:
  std::unique_ptr<TorqueLaw> rest_;
  std::vector<std::pair<std::size_t, std::unique_ptr<TorqueLaw>>> controls_;
  std::vector<double> one_;
};

std::unique_ptr<TorqueLaw> make_plain_law(const Chain& chain, const std::vector<TorqueEntry>& entries,
                                          const Parameters& parameters, ProblemList& problems) {
  Probe probe(chain, parameters);
  std::vector<Expression> parsed;
  std::vector<double> constants;
  for (const TorqueEntry& entry : entries) {
    try {
      parsed.push_back(Expression::parse(entry.control ? "0" : entry.text, probe.names(), entry.place));
      const std::optional<double> constant = parsed.back().constant();
      if (constant) constants.push_back(*constant);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  if (constants.size() == entries.size()) return std::make_unique<ConstantTorque>(std::move(constants));
  return std::make_unique<ExpressionTorque>(std::move(probe), std::move(parsed));
}

}  // namespace

std::unique_ptr<TorqueLaw> make_torque_law(const Chain& chain, const std::vector<TorqueEntry>& entries,
                                           const Parameters& parameters) {
  ProblemList problems;
  std::unique_ptr<TorqueLaw> plain = make_plain_law(chain, entries, parameters, problems);
  auto mixed = std::make_unique<MixedTorque>(entries.size());
  bool has_controls = false;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!entries[i].control) continue;
    has_controls = true;
    try {
      mixed->add(i, make_control(chain, *entries[i].control, parameters));
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  problems.throw_if_any();
  if (!has_controls) return plain;
  mixed->set_rest(std::move(plain));
  return mixed;
}

}  // namespace chainreel
