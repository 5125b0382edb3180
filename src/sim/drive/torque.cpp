#include "sim/drive/torque.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

#include "core/format.hpp"
#include "expr/expression.hpp"
#include "model/read_chain.hpp"
#include "sim/drive/expression_torque.hpp"
#include "sim/tip.hpp"

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
  std::vector<double> breaks(double end) const override {
    std::vector<double> all = rest_->breaks(end);
    for (const auto& [joint, law] : controls_) {
      const std::vector<double> some = law->breaks(end);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }
  void enter_piece(double t) override {
    rest_->enter_piece(t);
    for (const auto& [joint, law] : controls_) law->enter_piece(t);
  }
  void leave_pieces() override {
    rest_->leave_pieces();
    for (const auto& [joint, law] : controls_) law->leave_pieces();
  }
  StateCorners* corners() override { return rest_->corners(); }

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
      for (const int slot : parsed.back().used_variables()) require_frame_of(chain, probe, slot, entry.place);
      const std::optional<double> constant = parsed.back().constant();
      if (constant) constants.push_back(*constant);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  if (constants.size() == entries.size()) return std::make_unique<ConstantTorque>(std::move(constants));
  return make_expression_torque(std::move(probe), std::move(parsed));
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
