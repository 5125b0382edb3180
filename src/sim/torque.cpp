#include "sim/torque.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

#include "core/format.hpp"
#include "expr/affine.hpp"
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
  std::optional<AffineTorque> affine() const override {
    const std::size_t n = tau_.size();
    AffineTorque torque{{}, std::vector<Quad>(n * n), std::vector<Quad>(n * n)};
    for (const double tau : tau_) torque.powers.push_back({Quad(tau)});
    return torque;
  }
  bool evaluate_in_quad(Quad, std::span<const Quad>, std::span<const Quad>,
                        std::span<Quad> tau) const override {
    std::copy(tau_.begin(), tau_.end(), tau.begin());
    return true;
  }

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

  std::optional<AffineTorque> affine() const override {
    const std::size_t n = entries_.size();
    if (!has_coordinate_a_freedom()) return {};
    AffineTorque torque{{}, std::vector<Quad>(n * n), std::vector<Quad>(n * n)};
    const std::vector<VariableUse> uses = variable_uses();
    for (std::size_t i = 0; i < n; ++i) {
      auto form = affine_form_of<Quad>(entries_[i], uses);
      if (!form) return {};
      torque.powers.push_back(std::move(form->powers));
      std::copy_n(form->weights.begin() + 1, n, torque.K.begin() + std::ptrdiff_t(i * n));
      std::copy_n(form->weights.begin() + 1 + std::ptrdiff_t(n), n, torque.D.begin() + std::ptrdiff_t(i * n));
    }
    return torque;
  }

  bool evaluate_in_quad(Quad t, std::span<const Quad> q, std::span<const Quad> qd,
                        std::span<Quad> tau) const override {
    if (needs_kinematics_) return false;
    std::vector<Quad> values(probe_.values().begin(), probe_.values().end());
    values[0] = t;
    std::copy(qd.begin(), qd.end(), std::copy(q.begin(), q.end(), values.begin() + 1));
    for (std::size_t i = 0; i < entries_.size(); ++i)
      tau[i] = entries_[i].evaluate(std::span<const Quad>(values));
    return true;
  }

 private:
  // False with floating joints, whose rates are no derivatives of their coordinates.
  bool has_coordinate_a_freedom() const { return probe_.is_kinematic(int(1 + 2 * entries_.size())); }

  // Time, then coordinates and rates, then the end effector, then parameters.
  std::vector<VariableUse> variable_uses() const {
    std::vector<VariableUse> uses;
    for (std::size_t slot = 0; slot < probe_.values().size(); ++slot) {
      if (slot == 0)
        uses.push_back({VariableRole::time, 0});
      else if (slot <= 2 * entries_.size())
        uses.push_back({VariableRole::linear, 0});
      else if (probe_.is_kinematic(int(slot)))
        uses.push_back({VariableRole::other, 0});
      else
        uses.push_back({VariableRole::constant, probe_.values()[slot]});
    }
    return uses;
  }

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

// Multipliers follow from the torques: one that reads them would be an equation, not a law.
void refuse_multipliers(const TorqueEntry& entry, const Parameters& parameters) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  const std::string& text = entry.text;
  for (std::size_t at = text.find("lambda"); at != std::string::npos; at = text.find("lambda", at + 1)) {
    const std::size_t end = text.find_first_not_of("0123456789", at + 6);
    if (end == at + 6 || at + 6 == text.size()) continue;
    if ((at > 0 && is_word(text[at - 1])) || (end != std::string::npos && is_word(text[end]))) continue;
    const std::string name = text.substr(at, end == std::string::npos ? end : end - at);
    if (std::any_of(parameters.begin(), parameters.end(), [&](const auto& one) { return one.first == name; }))
      continue;
    throw Error(ExitCode::bad_input,
                "a torque cannot read " + name +
                    ", which follows from the torques: an algebraic loop. Ask for a force with "
                    "`contact_force:`, or read " + name + " in events and plots",
                entry.place);
  }
}

std::unique_ptr<TorqueLaw> make_plain_law(const Chain& chain, const std::vector<TorqueEntry>& entries,
                                          const Parameters& parameters, const NamedFrames& frames,
                                          ProblemList& problems) {
  Probe probe(chain, parameters, 0, frames);
  std::vector<Expression> parsed;
  std::vector<double> constants;
  for (const TorqueEntry& entry : entries) {
    try {
      if (!entry.control) refuse_multipliers(entry, parameters);
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
                                           const Parameters& parameters, const NamedFrames& frames) {
  ProblemList problems;
  std::unique_ptr<TorqueLaw> plain = make_plain_law(chain, entries, parameters, frames, problems);
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
