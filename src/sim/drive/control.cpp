#include "sim/drive/control.hpp"

#include <algorithm>
#include <map>

#include "core/csv.hpp"
#include "core/format.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "sim/drive/prices.hpp"
#include "sim/drive/table_units.hpp"
#include "sim/drive/torque.hpp"

namespace chainreel {
namespace {

class CsvTorque final : public TorqueLaw {
 public:
  explicit CsvTorque(TimeTable table) : table_(std::move(table)) {}

  void evaluate(const Chain&, Workspace&, double t, ConstVec, ConstVec, Vec tau) override {
    const std::vector<double>& times = table_.t;
    const auto above = std::upper_bound(times.begin(), times.end(), t);
    const auto next = std::size_t(above - times.begin());
    const std::size_t last = times.size() - 1;
    for (std::size_t i = 0; i < tau.size(); ++i) {
      const std::vector<double>& y = table_.groups[0][i];
      if (next == 0 || next > last)
        tau[i] = y[next == 0 ? 0 : last];
      else
        tau[i] =
            y[next - 1] + (t - times[next - 1]) / (times[next] - times[next - 1]) * (y[next] - y[next - 1]);
    }
  }
  double price(const Chain& chain) const override { return kPriceOfLaw + kPriceOfSpline * chain.nv; }
  std::vector<double> breaks(double) const override { return table_.t; }

 private:
  TimeTable table_;
};

void add_multiple(std::vector<Quad>& powers, const std::vector<Quad>& of, Quad factor) {
  powers.resize(std::max(powers.size(), of.size()));
  for (std::size_t k = 0; k < of.size(); ++k) powers[k] += factor * of[k];
}

// Whether a law is known to do nothing at a freedom.
bool leaves_alone(const TorqueLaw& law, std::size_t freedom) {
  const std::optional<AffineTorque> torque = law.affine();
  if (!torque) return false;
  const auto is_zero = [](const Quad& one) { return one == Quad(0); };
  const std::size_t n = torque->powers.size();
  const auto is_zero_row = [&](const std::vector<Quad>& all) { return std::all_of(all.begin() + std::ptrdiff_t(freedom * n), all.begin() + std::ptrdiff_t((freedom + 1) * n), is_zero); };
  return std::ranges::all_of(torque->powers[freedom], is_zero) && is_zero_row(torque->K) && is_zero_row(torque->D);
}

// Of two at one freedom the spring, where there is one: two springs have no rest that is one of theirs, two dampers no rate.
std::optional<LinearDrive> one_of(const std::vector<LinearDrive>& drives) {
  if (drives.size() == 1) return drives.front();
  if (std::ranges::count_if(drives, &LinearDrive::is_spring) != 1) return {};
  return *std::ranges::find_if(drives, &LinearDrive::is_spring);
}

void evaluate_affine(const AffineTorque& torque, Quad t, std::span<const Quad> q, std::span<const Quad> qd, std::span<Quad> tau) {
  const std::size_t n = tau.size();
  for (std::size_t i = 0; i < n; ++i) {
    tau[i] = 0;
    for (std::size_t k = torque.powers[i].size(); k-- > 0;) tau[i] = tau[i] * t + torque.powers[i][k];
    for (std::size_t j = 0; j < n; ++j) tau[i] += torque.K[i * n + j] * q[j] + torque.D[i * n + j] * qd[j];
  }
}

// Laws that compare the state with a reference motion.
class ReferenceLaw : public TorqueLaw {
 public:
  ReferenceLaw(std::unique_ptr<Reference> reference, int n)
      : reference_(std::move(reference)), q_(std::size_t(n)), qd_(q_), qdd_(q_) {}

  std::vector<double> breaks(double end) const override { return reference_->breaks(end); }
  void enter_piece(double t) override { reference_->enter_piece(t); }
  void leave_pieces() override { reference_->leave_pieces(); }

 protected:
  bool copy_reference(double t, Vec q) {
    move_without_acceleration(t);
    std::copy(q_.begin(), q_.end(), q.begin());
    return true;
  }
  void move_to(double t) { reference_->evaluate(t, q_, qd_, qdd_); }
  void move_without_acceleration(double t) { reference_->evaluate(t, q_, qd_, {}); }

  std::unique_ptr<Reference> reference_;
  std::vector<double> q_, qd_, qdd_;  // the reference's
};

class InverseTorque final : public ReferenceLaw {
 public:
  InverseTorque(const Chain& chain, std::unique_ptr<Reference> reference)
      : ReferenceLaw(std::move(reference), chain.nv) {}

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec, ConstVec, Vec tau) override {
    move_to(t);
    compute_inverse_dynamics(chain, ws, q_, qd_, qdd_);
    compute_friction(chain, ws, qd_);
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i] = ws.tau[i] + ws.tau_f[i];
  }
  double price(const Chain& chain) const override { return kPriceOfLaw + reference_->price(true) + price_of_inverse_dynamics(chain); }
};

class PdTorque final : public ReferenceLaw {
 public:
  PdTorque(std::unique_ptr<Reference> reference, std::vector<double> kp, std::vector<double> kd)
      : ReferenceLaw(std::move(reference), int(kp.size())), kp_(std::move(kp)), kd_(std::move(kd)), affine_(as_polynomials()) {}

  void evaluate(const Chain&, Workspace&, double t, ConstVec q, ConstVec qd, Vec tau) override {
    move_without_acceleration(t);
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i] = kp_[i] * (q_[i] - q[i]) + kd_[i] * (qd_[i] - qd[i]);
  }
  double price(const Chain&) const override { return kPriceOfLaw + reference_->price(false); }
  std::vector<LinearDrive> linear_drives(const Chain&) const override {
    std::vector<LinearDrive> drives;
    for (std::size_t i = 0; i < kp_.size(); ++i) {
      if (!(kp_[i] >= 0 && kd_[i] >= 0 && kp_[i] + kd_[i] > 0)) continue;
      LinearDrive drive{int(i), kp_[i], kd_[i]};
      drive.follows = true;
      drives.push_back(drive);
    }
    return drives;
  }
  bool reference_at(double t, Vec q) override { return copy_reference(t, q); }
  // What gains push away follows nothing.
  bool follows(std::size_t i) const override { return kp_[i] > 0 || (kp_[i] == 0 && kd_[i] > 0); }

  std::optional<AffineTorque> affine() const override { return affine_; }
  bool evaluate_in_quad(Quad t, std::span<const Quad> q, std::span<const Quad> qd, std::span<Quad> tau) const override {
    if (affine_) evaluate_affine(*affine_, t, q, qd, tau);
    return affine_.has_value();
  }

 private:
  std::optional<AffineTorque> as_polynomials() const {
    const std::optional<ReferencePolynomials> followed = reference_->polynomials();
    if (!followed) return {};
    const std::size_t n = kp_.size();
    AffineTorque torque{{}, std::vector<Quad>(n * n), std::vector<Quad>(n * n)};
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<Quad>& powers = torque.powers.emplace_back();
      add_multiple(powers, followed->q[i], kp_[i]);
      add_multiple(powers, followed->qd[i], kd_[i]);
      torque.K[i * n + i] = -Quad(kp_[i]);
      torque.D[i * n + i] = -Quad(kd_[i]);
    }
    return torque;
  }

  std::vector<double> kp_, kd_;
  std::optional<AffineTorque> affine_;  // where the reference is polynomials
};

class ComputedTorque final : public ReferenceLaw {
 public:
  // `alone`: the one joint that follows the reference, the others are asked for no acceleration.
  ComputedTorque(const Chain& chain, std::unique_ptr<Reference> reference, std::vector<double> kp,
                 std::vector<double> kd, std::optional<std::size_t> alone)
      : ReferenceLaw(std::move(reference), chain.nv), kp_(std::move(kp)), kd_(std::move(kd)), alone_(alone) {}

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    move_to(t);
    for (std::size_t i = 0; i < tau.size(); ++i)
      qdd_[i] = alone_ && i != *alone_ ? 0 : qdd_[i] + kp_[i] * (q_[i] - q[i]) + kd_[i] * (qd_[i] - qd[i]);
    compute_inverse_dynamics(chain, ws, q, qd, qdd_);
    compute_friction(chain, ws, qd);
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i] = ws.tau[i] + ws.tau_f[i];
  }
  double price(const Chain& chain) const override { return kPriceOfLaw + reference_->price(true) + price_of_inverse_dynamics(chain); }
  bool reference_at(double t, Vec q) override { return copy_reference(t, q); }
  bool follows(std::size_t i) const override { return !alone_ || i == *alone_; }

 private:
  std::vector<double> kp_, kd_;
  std::optional<std::size_t> alone_;
};

class GravityCompensation final : public TorqueLaw {
 public:
  void evaluate(const Chain& chain, Workspace& ws, double, ConstVec q, ConstVec, Vec tau) override {
    compute_gravity_torque(chain, ws, q);
    std::copy(ws.tau_g.begin(), ws.tau_g.end(), tau.begin());
  }
  double price(const Chain& chain) const override { return kPriceOfLaw + price_of_inverse_dynamics(chain); }
};

class SumOfTorques final : public TorqueLaw {
 public:
  SumOfTorques(std::vector<std::unique_ptr<TorqueLaw>> parts, int n)
      : parts_(std::move(parts)), part_(std::size_t(n)) {}

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    std::fill(tau.begin(), tau.end(), 0.0);
    for (const auto& part : parts_) {
      part->evaluate(chain, ws, t, q, qd, part_);
      for (std::size_t i = 0; i < tau.size(); ++i) tau[i] += part_[i];
    }
  }
  double price(const Chain& chain) const override {
    double sum = 0;
    for (const auto& part : parts_) sum += part->price(chain);
    return sum;
  }
  std::vector<double> breaks(double end) const override {
    std::vector<double> all;
    for (const auto& part : parts_) {
      const std::vector<double> some = part->breaks(end);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }
  void enter_piece(double t) override {
    for (const auto& part : parts_) part->enter_piece(t);
  }
  void leave_pieces() override {
    for (const auto& part : parts_) part->leave_pieces();
  }
  // Of expressions, of which there is one part at most.
  StateCorners* corners() override {
    for (const auto& part : parts_)
      if (StateCorners* own = part->corners()) return own;
    return nullptr;
  }
  // Each freedom by itself: what parts do elsewhere says nothing of it.
  std::vector<LinearDrive> linear_drives(const Chain& chain) const override {
    std::map<int, std::vector<LinearDrive>> at;
    for (const auto& part : parts_)
      for (const LinearDrive& own : part->linear_drives(chain)) at[own.freedom].push_back(own);
    std::vector<LinearDrive> drives;
    for (const auto& [freedom, own] : at) {
      std::optional<LinearDrive> one = one_of(own);
      if (!one) continue;
      const auto others = std::ranges::count_if(parts_, [&](const auto& part) { return !leaves_alone(*part, std::size_t(freedom)); });
      one->whole = one->whole && (parts_.size() == 1 || others == 1);
      drives.push_back(*one);
    }
    return drives;
  }
  bool reference_at(double t, Vec q) override {
    for (const auto& part : parts_)
      if (part->reference_at(t, q)) return true;
    return false;
  }
  bool follows(std::size_t freedom) const override {
    return std::ranges::any_of(parts_, [&](const auto& part) { return part->follows(freedom); });
  }
  std::optional<TaskTarget> task_at(double t) override {
    for (const auto& part : parts_)
      if (std::optional<TaskTarget> own = part->task_at(t)) return own;
    return {};
  }
  std::optional<AffineTorque> affine() const override {
    std::optional<AffineTorque> sum;
    for (const auto& part : parts_) {
      const std::optional<AffineTorque> own = part->affine();
      if (!own) return {};
      if (!sum)
        sum = own;
      else
        for (std::size_t i = 0; i < sum->powers.size(); ++i) add_row(*sum, *own, i);
    }
    return sum;
  }
  bool evaluate_in_quad(Quad t, std::span<const Quad> q, std::span<const Quad> qd, std::span<Quad> tau) const override {
    std::vector<Quad> part(tau.size());
    std::fill(tau.begin(), tau.end(), Quad(0));
    for (const auto& one : parts_) {
      if (!one->evaluate_in_quad(t, q, qd, part)) return false;
      for (std::size_t i = 0; i < tau.size(); ++i) tau[i] += part[i];
    }
    return true;
  }

 private:
  std::vector<std::unique_ptr<TorqueLaw>> parts_;
  std::vector<double> part_;
};

// A law that ends with its table.
class WithinTable final : public TorqueLaw {
 public:
  WithinTable(std::unique_ptr<TorqueLaw> law, double from, double until)
      : law_(std::move(law)), from_(from), until_(until) {}

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec q, ConstVec qd, Vec tau) override {
    if (piece_.value_or(is_within(t))) return law_->evaluate(chain, ws, t, q, qd, tau);
    std::fill(tau.begin(), tau.end(), 0.0);
  }
  double price(const Chain& chain) const override { return law_->price(chain); }
  std::vector<double> breaks(double end) const override {
    std::vector<double> all = law_->breaks(end);
    all.insert(all.end(), {from_, until_});
    return all;
  }
  void enter_piece(double t) override {
    piece_ = is_within(t);
    law_->enter_piece(t);
  }
  void leave_pieces() override {
    piece_.reset();
    law_->leave_pieces();
  }

 private:
  bool is_within(double t) const { return t >= from_ && t <= until_; }

  std::unique_ptr<TorqueLaw> law_;
  double from_, until_;        // s
  std::optional<bool> piece_;  // whether the piece that a run is in lies within
};

// `law` is driven by the table at `path`; where there is none it acts always.
std::unique_ptr<TorqueLaw> within(std::unique_ptr<TorqueLaw> law, const std::string& path,
                                  const std::optional<Outside>& outside) {
  if (path.empty() || outside != Outside::zero) return law;
  const std::vector<double> t = law->breaks(0);  // which are its rows
  return std::make_unique<WithinTable>(std::move(law), t.front(), t.back());
}

// One number for all freedoms, or one a freedom.
template <class T>
std::vector<T> spread(const std::vector<T>& given, const Chain& chain, const std::string& key, const Place& place) {
  const auto n = std::size_t(chain.nv);
  if (given.size() == 1) return std::vector<T>(n, given.front());
  if (given.size() == n) return given;
  throw Error(ExitCode::bad_input,
              "'" + key + "' has " + std::to_string(given.size()) +
                  " entries: give one for all, or one for each of the " + std::to_string(n) + " freedoms (" +
                  shortened(joined(chain.coordinate_names), 200) + ")" + (chain.has_mimic ? "; joints that follow others have none of their own" : ""),
              place);
}

std::unique_ptr<Reference> reference_of(const Chain& chain, const Feedback& feedback,
                                        const Parameters& parameters, const Place& place) {
  if (!feedback.trajectory.empty()) return make_table_reference(feedback.trajectory, chain);
  const auto entries = [&](const std::vector<Entry>& given, const char* key) {
    return given.empty() ? given : spread(given, chain, key, place);
  };
  const std::vector<Entry> q =
      feedback.q.empty() ? std::vector<Entry>(std::size_t(chain.nv)) : entries(feedback.q, "q");
  return make_expression_reference(q, entries(feedback.qd, "qd"), entries(feedback.qdd, "qdd"), parameters);
}

}  // namespace

std::span<const Name> names_of(Outside) {
  static constexpr Name names[] = {{"hold", "the row at that end: its torque, or its pose at rest"},
                                   {"zero", "no torque"},
                                   {"refuse", "nothing: the run must not be longer"}};
  return names;
}

std::unique_ptr<TorqueLaw> make_control(const Chain& chain, const Control& control, const Parameters& parameters,
                                        std::optional<std::size_t> joint, const NamedFrames& frames) {
  if (chain.has_floating && (!control.inverse_of.empty() || control.pd || control.computed_torque))
    throw Error(
        ExitCode::bad_input,
        "pd, computed_torque and inverse_of follow joint positions: a floating base has no such torque",
        control.place);
  std::vector<std::unique_ptr<TorqueLaw>> parts;
  if (!control.csv.empty()) {
    const Table file = control.since_first_row ? read_log(control.csv, control.columns) : read_table(control.csv, control.columns);
    TimeTable table = time_table_of(file, {"tau"}, chain.coordinate_names, control.columns);
    check_table_units(chain, file, table, {"tau"});
    if (table.groups[0].empty())
      throw Error(ExitCode::bad_input, "has no columns tau1 to tau" + std::to_string(chain.nv) + 
                      ": of other names, beside `csv:`, say `columns: {time: " + control.columns.time.text() + ", " + chain.coordinate_names.front() + ": NAME}`",
                  {control.csv});
    parts.push_back(within(std::make_unique<CsvTorque>(std::move(table)), control.csv, control.outside));
  }
  if (!control.inverse_of.empty())
    parts.push_back(
        within(std::make_unique<InverseTorque>(chain, make_table_reference(control.inverse_of, chain)),
               control.inverse_of, control.outside));
  const auto gains = [&](const std::vector<double>& given, const char* key) {
    return spread(given, chain, key, control.place);
  };
  if (const auto& pd = control.pd)
    parts.push_back(within(std::make_unique<PdTorque>(reference_of(chain, *pd, parameters, control.place),
                                                      gains(pd->kp, "kp"), gains(pd->kd, "kd")),
                           pd->trajectory, pd->outside));
  if (const auto& ct = control.computed_torque) {
    const bool speaks_of_all = !joint || !ct->trajectory.empty() || std::max({ct->q.size(), ct->qd.size(), ct->qdd.size()}) > 1;
    parts.push_back(
        within(std::make_unique<ComputedTorque>(chain, reference_of(chain, *ct, parameters, control.place), gains(ct->kp, "kp"),
                                                gains(ct->kd, "kd"), speaks_of_all ? std::nullopt : joint),
               ct->trajectory, ct->outside));
  }
  if (control.task) {
    if (joint) throw Error(ExitCode::bad_input, "'task' pulls the whole chain: write torque: {task: {..}} in the place of the list", control.place);
    parts.push_back(make_task_torque(chain, *control.task, parameters, frames));
  }
  if (control.gravity_compensation) parts.push_back(std::make_unique<GravityCompensation>());
  if (!control.plus.empty() && !joint) {
    std::vector<TorqueEntry> entries;
    for (const Entry& one : spread(control.plus, chain, "plus", control.place)) entries.push_back({one.text, one.place, {}});
    parts.push_back(make_torque_law(chain, entries, parameters, frames));
  }
  if (control.function) parts.push_back(make_function_torque(*control.function));
  return std::make_unique<SumOfTorques>(std::move(parts), chain.nv);
}

}  // namespace chainreel
