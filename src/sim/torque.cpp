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
    for (const Expression& entry : entries_)
      for (int slot : entry.used_variables()) needs_kinematics_ |= probe_.is_kinematic(slot);
  }

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    probe_.set(chain, ws, t, q, qd, needs_kinematics_);
    for (std::size_t i = 0; i < entries_.size(); ++i) tau[i] = entries_[i].evaluate(probe_.values());
  }

 private:
  Probe probe_;
  std::vector<Expression> entries_;
  bool needs_kinematics_ = false;
};

}  // namespace

std::unique_ptr<TorqueLaw> make_torque_law(const Chain& chain, const std::vector<TorqueEntry>& entries,
                                           const Parameters& parameters) {
  Probe probe(chain, parameters);
  ProblemList problems;
  std::vector<Expression> parsed;
  std::vector<double> constants;
  for (const TorqueEntry& entry : entries) {
    try {
      parsed.push_back(Expression::parse(entry.text, probe.names(), entry.place));
      const std::optional<double> constant = parsed.back().constant();
      if (constant) constants.push_back(*constant);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  problems.throw_if_any();
  if (constants.size() == entries.size()) return std::make_unique<ConstantTorque>(std::move(constants));
  return std::make_unique<ExpressionTorque>(std::move(probe), std::move(parsed));
}

}  // namespace chainreel
