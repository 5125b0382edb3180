#include "sim/drive/torque.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

#include "core/format.hpp"
#include "expr/corners.hpp"
#include "expr/expression.hpp"
#include "expr/instants.hpp"
#include "expr/pulses.hpp"
#include "model/read_chain.hpp"
#include "sim/drive/prices.hpp"
#include "sim/drive/state_corners.hpp"

namespace chainreel {
namespace {

class ConstantTorque final : public TorqueLaw {
 public:
  explicit ConstantTorque(std::vector<double> tau) : tau_(std::move(tau)) {}

  void evaluate(const Chain&, Workspace&, double, ConstVec, ConstVec, Vec tau) override {
    std::copy(tau_.begin(), tau_.end(), tau.begin());
  }
  double price(const Chain&) const override { return 0; }
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

// Expressions and constants for all joints, to which controls of single joints are added.
class MixedTorque final : public TorqueLaw {
 public:
  explicit MixedTorque(std::size_t n) : one_(n) {}
  void set_rest(std::unique_ptr<TorqueLaw> rest) { rest_ = std::move(rest); }
  // `has_more`: the rest has an expression of the joint, too.
  void add(std::size_t joint, bool has_more, std::unique_ptr<TorqueLaw> law) {
    controls_.push_back({joint, has_more, std::move(law)});
  }

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    rest_->evaluate(chain, ws, t, q, qd, tau);
    for (const auto& [joint, has_more, law] : controls_) {
      law->evaluate(chain, ws, t, q, qd, one_);
      tau[joint] += one_[joint];
    }
  }
  double price(const Chain& chain) const override {
    double sum = rest_->price(chain);
    for (const auto& [joint, has_more, law] : controls_) sum += law->price(chain);
    return sum;
  }
  std::vector<double> breaks(double end) const override {
    std::vector<double> all = rest_->breaks(end);
    for (const auto& [joint, has_more, law] : controls_) {
      const std::vector<double> some = law->breaks(end);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }
  void enter_piece(double t) override {
    rest_->enter_piece(t);
    for (const auto& [joint, has_more, law] : controls_) law->enter_piece(t);
  }
  void leave_pieces() override {
    rest_->leave_pieces();
    for (const auto& [joint, has_more, law] : controls_) law->leave_pieces();
  }
  StateCorners* corners() override { return rest_->corners(); }
  std::optional<AffineTorque> affine() const override {
    std::optional<AffineTorque> torque = rest_->affine();
    for (const auto& [joint, has_more, law] : controls_) {
      const std::optional<AffineTorque> own = law->affine();
      if (!torque || !own) return {};
      add_row(*torque, *own, joint);
    }
    return torque;
  }
  bool evaluate_in_quad(Quad t, std::span<const Quad> q, std::span<const Quad> qd, std::span<Quad> tau) const override {
    if (!rest_->evaluate_in_quad(t, q, qd, tau)) return false;
    std::vector<Quad> own(tau.size());
    for (const auto& [joint, has_more, law] : controls_) {
      if (!law->evaluate_in_quad(t, q, qd, own)) return false;
      tau[joint] += own[joint];
    }
    return true;
  }
  // Of a joint that has a control beside an expression those of the control alone, as a part: two springs at one joint have no
  // rest that is one of theirs.
  std::vector<LinearDrive> linear_drives(const Chain& chain) const override {
    std::vector<LinearDrive> all;
    for (const LinearDrive& one : rest_->linear_drives(chain))
      if (std::none_of(controls_.begin(), controls_.end(), [&](const auto& control) { return int(control.joint) == one.freedom; })) all.push_back(one);
    for (const auto& [joint, has_more, law] : controls_)
      for (LinearDrive one : law->linear_drives(chain)) {
        if (one.freedom != int(joint)) continue;
        one.whole = one.whole && !has_more;
        all.push_back(one);
      }
    return all;
  }
  // That of the joints which follow one; the others' own place is left as it is.
  bool reference_at(double t, Vec q) override {
    bool any = false;
    for (const auto& [joint, has_more, law] : controls_) {
      if (!law->reference_at(t, one_)) continue;
      q[joint] = one_[joint];
      any = true;
    }
    return any;
  }
  bool follows(std::size_t freedom) const override {
    return std::any_of(controls_.begin(), controls_.end(), [&](const auto& control) { return control.joint == freedom && control.law->follows(freedom); });
  }

 private:
  std::unique_ptr<TorqueLaw> rest_;
  struct JointControl {
    std::size_t joint;
    bool has_more;
    std::unique_ptr<TorqueLaw> law;
  };
  std::vector<JointControl> controls_;
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

// What of an entry is an expression: of a control what is added to it.
TorqueEntry expression_of(const TorqueEntry& entry) {
  if (!entry.control) return entry;
  const std::vector<Entry>& plus = entry.control->plus;
  if (plus.size() > 1) throw Error(ExitCode::bad_input, "'plus' of one joint is one expression, not a list", entry.place);
  if (plus.empty()) return {"0", entry.place, {}};
  return {plus.front().text, plus.front().place, {}};
}

std::unique_ptr<TorqueLaw> make_plain_law(const Chain& chain, const std::vector<TorqueEntry>& entries,
                                          const Parameters& parameters, const NamedFrames& frames,
                                          ProblemList& problems) {
  Probe probe(chain, parameters, 0, frames);
  std::vector<Expression> parsed;
  std::vector<double> constants;
  for (const TorqueEntry& entry : entries) {
    try {
      const TorqueEntry plain = expression_of(entry);
      refuse_multipliers(plain, parameters);
      parsed.push_back(Expression::parse(plain.text, probe.names(), plain.place));
      for (const int slot : parsed.back().used_variables()) require_frame_of(chain, probe, slot, plain.place);
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

void add_row(AffineTorque& sum, const AffineTorque& other, std::size_t freedom) {
  std::vector<Quad>& powers = sum.powers[freedom];
  const std::vector<Quad>& more = other.powers[freedom];
  powers.resize(std::max(powers.size(), more.size()));
  for (std::size_t k = 0; k < more.size(); ++k) powers[k] += more[k];
  const std::size_t n = sum.powers.size();
  for (std::size_t j = freedom * n; j < (freedom + 1) * n; ++j) sum.K[j] += other.K[j], sum.D[j] += other.D[j];
}

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
      mixed->add(i, !entries[i].control->plus.empty(), make_control(chain, *entries[i].control, parameters, i));
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  problems.throw_if_any();
  if (!has_controls) return plain;
  mixed->set_rest(std::move(plain));
  return mixed;
}

namespace {

class ExpressionTorque final : public TorqueLaw {
 public:
  ExpressionTorque(Probe probe, std::vector<Expression> entries)
      : probe_(std::move(probe)), entries_(std::move(entries)), corners_(uses_for_corners()) {
    for (const Expression& entry : entries_) {
      programs_.push_back(corners_.add(entry));
      for (int slot : entry.used_variables()) {
        needs_kinematics_ |= probe_.is_kinematic(slot);
        depends_on_velocity_ |= probe_.is_velocity(slot);
      }
    }
    sides_.assign(std::size_t(corners_.count()), kAsWritten);
    if (corners_.count() > 0) state_corners_.emplace(corners_, sides_, probe_);
    has_corners_ = std::any_of(programs_.begin(), programs_.end(),
                               [](const CorneredProgram& one) { return one.has_corners(); });
  }

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    probe_.set(chain, ws, t, q, qd, needs_kinematics_);
    if (!has_corners_) {
      for (std::size_t i = 0; i < entries_.size(); ++i) tau[i] = entries_[i].evaluate(probe_.values());
      return;
    }
    for (std::size_t i = 0; i < programs_.size(); ++i)
      tau[i] = chainreel::evaluate<double>(programs_[i], probe_.values(), sides_);
  }

  double price(const Chain& chain) const override {
    double sum = kPriceOfLaw + (needs_kinematics_ ? price_of_kinematics(chain) : 0);
    for (const CorneredProgram& one : programs_) sum += price_of(one);
    return sum;
  }
  std::vector<double> breaks(double end) const override {
    if (end == end_of_breaks_) return breaks_;
    breaks_ = instants_of(corners_, end);
    const std::vector<double> pulses = pulses_of(programs_, corners_, breaks_, end);
    breaks_.insert(breaks_.end(), pulses.begin(), pulses.end());
    end_of_breaks_ = end;
    return breaks_;
  }
  void enter_piece(double t) override { set_sides_of_time(corners_, t, sides_); }
  void leave_pieces() override { std::fill(sides_.begin(), sides_.end(), kAsWritten); }
  StateCorners* corners() override {
    return state_corners_ && state_corners_->count() > 0 ? &*state_corners_ : nullptr;
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

  std::vector<LinearDrive> linear_drives(const Chain& chain) const override {
    if (!has_coordinate_a_freedom()) return {};
    std::vector<VariableUse> uses = variable_uses();
    for (std::size_t slot = 0; slot < uses.size(); ++slot)
      if (probe_.is_kinematic(int(slot))) uses[slot].role = VariableRole::linear;
    std::vector<std::optional<AffineForm<double>>> forms;
    for (const Expression& entry : entries_) forms.push_back(affine_form_of<double>(entry, uses));
    return linear_drives_of(chain, probe_, forms);
  }

  bool evaluate_in_quad(Quad t, std::span<const Quad> q, std::span<const Quad> qd,
                        std::span<Quad> tau) const override {
    if (needs_kinematics_ || corners_.count() > 0) return false;  // methods in quads know no corners
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

  // Coordinates, rates and frames change with the motion; they stand before the parameters.
  std::vector<VariableUse> uses_for_corners() const {
    std::vector<VariableUse> uses(probe_.values().size());
    bool before_frames = true;
    for (std::size_t slot = 0; slot < uses.size(); ++slot) {
      const bool kinematic = probe_.is_kinematic(int(slot));
      before_frames = before_frames && !kinematic;
      if (slot == 0)
        uses[slot] = {VariableRole::time, 0};
      else if (before_frames || kinematic)
        uses[slot] = {VariableRole::linear, 0};
      else
        uses[slot] = {VariableRole::constant, probe_.values()[slot]};
    }
    return uses;
  }

  Probe probe_;
  std::vector<Expression> entries_;
  Corners corners_;
  std::vector<CorneredProgram> programs_;  // of the entries
  std::vector<double> sides_;              // of the corners
  std::optional<StateCorners> state_corners_;
  mutable std::vector<double> breaks_;  // until end_of_breaks_, in s; many runs ask for the same
  mutable double end_of_breaks_ = -1;
  bool has_corners_ = false;  // with sides; else the entries are evaluated as they stand
  bool needs_kinematics_ = false;
  bool depends_on_velocity_ = false;
};

}  // namespace

std::unique_ptr<TorqueLaw> make_expression_torque(Probe probe, std::vector<Expression> entries) {
  return std::make_unique<ExpressionTorque>(std::move(probe), std::move(entries));
}

}  // namespace chainreel
