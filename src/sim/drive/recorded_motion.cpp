#include "sim/drive/recorded_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "sim/drive/prices.hpp"
#include "sim/drive/table_units.hpp"

namespace chainreel {
namespace {

constexpr double kDoubtfulRate = 0.2;  // of the root of the mean square: rates in degrees are off by 57 times
// Off one by more than noise leaves of a factor, which it does not bend as it bends single rates, and than a spline over
// four rows a period or more: its rates there are 3 sin(x) / (x (2 + cos x)) of the true ones, x = pi/2: 0.955.
constexpr double kDoubtfulFactor = 0.05;
constexpr double kStill = 1e-9;        // rad/s, m/s: no motion, whose rate is rounding
constexpr double kRounding = 1e-10;    // of the largest nle: a torque that is less is none
constexpr double kGap = 5;             // of the usual distance of rows
constexpr double kDoubtfulNoise = 0.06;  // of the root of the mean square of accelerations
constexpr double kDigits = 64 * std::numeric_limits<double>::epsilon();
constexpr std::size_t kFewestForNoise = 12;  // rows
constexpr std::size_t kFewestForCoarse = 9;  // rows: every other one leaves five, of which a spline has two pieces of its own
constexpr double kDoubtfulTorque = 0.02;     // of the largest
constexpr std::size_t kFewWords = 6;   // that are named
const std::vector<std::string> kQuantities{"q", "qd", "qdd", "tau"};

std::string in_row(const Table& table, std::size_t k) {
  return "line " + std::to_string(table.lines[k]);
}

// Angles that begin again behind a turn would be taken for a motion back through all of it.
void check_turns(const Chain& chain, const Table& table, const TimeTable& motion) {
  const auto& q = motion.groups[0];
  const auto& qd = motion.groups[1];
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (!freedom_turns(chain, i)) continue;
    for (std::size_t k = 1; k < motion.t.size(); ++k) {
      const double jump = q[i][k] - q[i][k - 1], h = motion.t[k] - motion.t[k - 1];
      if (!(std::fabs(jump) > std::numbers::pi)) continue;
      // Rates that say so make it a fast motion.
      const double told = qd.empty() ? 0 : 0.5 * h * (qd[i][k] + qd[i][k - 1]);
      if (std::fabs(jump - told) < std::fabs(jump) / 2) continue;
      throw Error(ExitCode::bad_input,
                  "'" + table.names[motion.columns[0][i]] + "' jumps by " + format_significant(jump, 3) +
                      " rad within " + format_significant(h, 3) +
                      " s, more than half a turn: angles of a motion must go on behind a turn (unwrap them), in rad or with [deg] in the header",
                  {table.file, table.lines[k]});
    }
  }
}

// Divided differences of numbers at instants: their rates, between them.
struct Samples {
  std::vector<double> t, x;
  Samples rates() const {
    Samples of;
    for (std::size_t k = 0; k + 1 < x.size(); ++k) {
      of.t.push_back(0.5 * (t[k] + t[k + 1]));
      of.x.push_back((x[k + 1] - x[k]) / (t[k + 1] - t[k]));
    }
    return of;
  }
};

// How much of an acceleration's size changes from row to row as noise does, and no motion: by how much it is off the line through its
// neighbours, where the signs of that alternate; of the worst of windows, by the median, in which jumps of an honest acceleration go
// under, or of a single row that is farther off than it is large. White noise of q leaves 0.87 of that median in the
// accelerations, of qd 0.94. `least`: an acceleration that is none.
double noise_of(const Samples& qdd, double least) {
  constexpr double kOfMedian = 0.9, kLarge = 0.5, kOutlier = 1.2;
  constexpr std::size_t kWindow = 16;
  const std::size_t n = qdd.x.size();
  if (n < kFewestForNoise) return 0;
  std::vector<double> off;
  double size = 0, outlier = 0;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double share = (qdd.t[k] - qdd.t[k - 1]) / (qdd.t[k + 1] - qdd.t[k - 1]);
    off.push_back(qdd.x[k] - (qdd.x[k - 1] + share * (qdd.x[k + 1] - qdd.x[k - 1])));
    size += qdd.x[k] * qdd.x[k] / double(n - 2);
    const double own = std::fabs(qdd.x[k]);
    const bool is_peak = own >= std::fabs(qdd.x[k - 1]) && own >= std::fabs(qdd.x[k + 1]);  // beside a jump it is none
    if (is_peak && std::fabs(off.back()) > kOutlier * own) outlier = std::max(outlier, std::fabs(off.back()));
  }
  if (!(size > least * least)) return 0;
  size = std::sqrt(size);
  double worst = outlier > kLarge * size ? outlier / size : 0;
  for (std::size_t first = 0; first < off.size(); first += kWindow / 2) {
    const std::size_t behind = std::min(first + kWindow, off.size());
    if (behind - first < kWindow / 2) break;
    double along = 0;
    std::vector<double> magnitude;
    for (std::size_t k = first; k < behind; ++k) {
      magnitude.push_back(std::fabs(off[k]));
      if (k > first) along += off[k] * off[k - 1];
    }
    if (!(along < 0)) continue;
    std::nth_element(magnitude.begin(), magnitude.begin() + std::ptrdiff_t(magnitude.size() / 2), magnitude.end());
    worst = std::max(worst, kOfMedian * magnitude[magnitude.size() / 2] / size);
  }
  return worst;
}

// Of what splines differentiate the noise of rows, or their last digit, may be most of the acceleration.
void doubt_noise(const Table& table, const TimeTable& motion, std::vector<std::string>& doubts) {
  if (!motion.groups[2].empty()) return;
  const std::size_t group = motion.groups[1].empty() ? 0 : 1;
  const double rows_a_second = double(motion.t.size() - 1) / (motion.t.back() - motion.t.front());
  std::string names;
  double worst = 0;
  for (std::size_t i = 0; i < motion.groups[group].size(); ++i) {
    const Samples told{motion.t, motion.groups[group][i]};
    double least = 0;  // what rounding of doubles leaves
    for (const double one : told.x) least = std::max(least, kDigits * std::fabs(one));
    least *= group == 0 ? rows_a_second * rows_a_second : rows_a_second;
    const double noise = noise_of(group == 0 ? told.rates().rates() : told.rates(), std::max(kStill, least));
    if (!(noise > kDoubtfulNoise)) continue;
    names += (names.empty() ? "'" : ", '") + table.names[motion.columns[group][i]] + "'";
    worst = std::max(worst, noise);
  }
  if (!names.empty())
    doubts.push_back("the rows of " + names + " in " + table.file + " are noisy, rounded (they or their times) or too far apart: the accelerations that follow jump from row to row by " +
                     (worst < 1 ? "as much as " + format_significant(100 * worst, 2) + " % of their size" : "their own size and more") +
                     ", as in no motion, and the torques with them; smooth the rows before, or give " + (group == 0 ? "qd and qdd" : "qdd"));
}

// By which factor told rates differ from those of the splines: of what both add up to, in which noise of single rows goes
// out, the slope by least squares. 1 where nothing moves.
double factor_of(const std::vector<double>& t, const std::vector<double>& told, const std::vector<double>& rate) {
  std::vector<double> x(t.size()), y(t.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double h = t[k] - t[k - 1];
    x[k] = x[k - 1] + 0.5 * h * (rate[k] + rate[k - 1]);
    y[k] = y[k - 1] + 0.5 * h * (told[k] + told[k - 1]);
    mean_x += x[k] / double(t.size());
    mean_y += y[k] / double(t.size());
  }
  double xx = 0, xy = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  const double least = kStill * (t.back() - t.front());
  return xx > double(t.size()) * least * least ? xy / xx : 1;
}

// Numbers of the table that are to be derivatives of others: how far are they from those?
class Derivatives {
 public:
  Derivatives(const Table& table, const TimeTable& motion) : table_(table), motion_(motion) {}

  void compare(std::size_t lower, std::size_t upper, std::vector<std::string>& remarks) const {
    const auto& of = motion_.groups[lower];
    const auto& told = motion_.groups[upper];
    if (of.empty() || told.empty()) return;
    const auto t = std::make_shared<const std::vector<double>>(motion_.t);
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Spline spline = Spline::over(t, of[i]);
      std::vector<double> rates;
      double difference = 0, size = 0, worst = 0;
      std::size_t at = 0;
      for (std::size_t k = 0; k < t->size(); ++k) {
        const auto there = spline.at((*t)[k]);
        const double rate = upper - lower == 1 ? there.yd : there.ydd, off = std::fabs(told[i][k] - rate);
        rates.push_back(rate);
        difference += off * off;
        size += std::max(told[i][k] * told[i][k], rate * rate);
        if (off > worst) worst = off, at = k;
      }
      const double count = double(t->size());
      const double factor = factor_of(*t, told[i], rates);
      const bool is_other = std::sqrt(difference / count) > std::max(kStill, kDoubtfulRate * std::sqrt(size / count));
      if (!is_other && !(std::fabs(factor - 1) > kDoubtfulFactor)) continue;
      const auto name = [&](std::size_t group) { return "'" + table_.names[motion_.columns[group][i]] + "'"; };
      remarks.push_back(name(upper) + " is " + (is_other ? "not" : format_significant(factor, 3) + " times") + (upper - lower == 1 ? " the rate of " : " the second derivative of ") +
                        name(lower) + " in " + table_.file + ": they differ by " + format_significant(worst, 3) + " at t = " + format_significant((*t)[at], 4) + " s (" + in_row(table_, at) +
                        "); is a unit missing in the header, like [deg/s], or are rows too far apart? The torques follow " +
                        (upper == 2 ? name(upper) : name(upper) + " and its derivative"));
    }
  }

 private:
  const Table& table_;
  const TimeTable& motion_;
};

void remark_gap(const Table& table, const std::vector<double>& t, std::vector<std::string>& remarks) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < t.size(); ++k) steps.push_back(t[k] - t[k - 1]);
  const auto largest = std::max_element(steps.begin(), steps.end());
  const std::size_t at = std::size_t(largest - steps.begin());
  const double gap = *largest;
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  const double usual = steps[steps.size() / 2];
  if (gap > kGap * usual)
    remarks.push_back("there is nothing between t = " + format_significant(t[at], 6) + " and " + format_significant(t[at + 1], 6) +
                      " s in " + table.file + " (" + in_row(table, at + 1) + "), where rows are " + format_significant(usual, 3) +
                      " s apart: what is shown there is the spline's");
}

void remark_unused(const Table& table, const TimeTable& motion, const ColumnNames& names, std::vector<std::string>& remarks) {
  std::vector<bool> is_used(table.names.size());
  is_used[std::size_t(table.find(names.time.name))] = true;
  for (const auto& group : motion.columns)
    for (const std::size_t column : group) is_used[column] = true;
  std::vector<std::string> unused;
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (!is_used[i]) unused.push_back(table.names[i]);
  if (unused.empty()) return;
  const std::size_t more = unused.size() > kFewWords ? unused.size() - kFewWords : 0;
  if (more > 0) unused.resize(kFewWords);
  remarks.push_back("no use is made of these columns of " + table.file + ": " + joined(unused) +
                    (more > 0 ? " and " + std::to_string(more) + " others" : ""));
}

// tau from q, qd, qdd.
void inverse_torque(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd, Vec tau) {
  compute_nle(chain, ws, q, qd);
  double size = 0;
  for (const double part : ws.nle) size = std::max(size, std::fabs(part));
  compute_inverse_dynamics(chain, ws, q, qd, qdd);
  compute_friction(chain, ws, qd);
  for (std::size_t i = 0; i < tau.size(); ++i) {
    tau[i] = ws.tau[i] + ws.tau_f[i];
    if (std::fabs(tau[i]) < kRounding * size) tau[i] = 0;
  }
}

// At the rows of a table, one after the other.
std::vector<double> inverse_torques(const Chain& chain, const Reference& motion, const std::vector<double>& t) {
  const auto n = std::size_t(chain.nv);
  Workspace ws(chain);
  std::vector<double> q(n), qd(n), qdd(n), tau(n), all;
  for (const double at : t) {
    motion.evaluate(at, q, qd, qdd);
    inverse_torque(chain, ws, q, qd, qdd, tau);
    all.insert(all.end(), tau.begin(), tau.end());
  }
  return all;
}

// Every other row, from the first, of a motion without accelerations.
TimeTable every_other_row(const TimeTable& motion) {
  TimeTable coarse = motion;
  const auto thin = [](auto& list) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < list.size(); k += 2) list[kept++] = list[k];
    list.resize(kept);
  };
  thin(coarse.t);
  thin(coarse.lines);
  for (auto& group : coarse.groups)
    for (std::vector<double>& freedom : group) thin(freedom);
  return coarse;
}

std::string words_of(const RecordedMotion::OwnTorques& own, const std::string& file) {
  return "torques are those of inverse dynamics, not those that " + file + " tells, which differ by " +
         format_significant(own.largest, 3) + " N m or N at most" +
         (own.largest > 0 ? " ('" + own.freedom + "', t = " + format_significant(own.t, 4) + " s)" : "");
}

}  // namespace

RecordedMotion::RecordedMotion(const Chain& chain, std::shared_ptr<const Table> table, const ColumnNames& names)
    : table_(std::move(table)) {
  const std::string& file = table_->file;
  if (chain.has_floating || chain.nq != chain.nv)
    throw Error(ExitCode::bad_input, "a recorded motion tells the places of joints alone: a floating base has none; take base: fixed",
                {file});
  const TimeTable motion = time_table_of(*table_, kQuantities, chain.coordinate_names, names);
  const std::string n = std::to_string(chain.nv);
  if (motion.groups[0].empty())
    throw Error(ExitCode::bad_input,
                "has no columns q1 to q" + n + ", one a freedom, nor q." + chain.coordinate_names.front() +
                    " and so on: of other names, beside `csv:`, say `columns: {time: " + names.time.text() + ", " + chain.coordinate_names.front() +
                    ": NAME}`; there are " + joined(table_->names),
                {file});
  if (motion.t.size() < 2)
    throw Error(ExitCode::bad_input, "holds one row, which is a pose and no motion: a motion takes two rows or more", {file});
  check_table_units(chain, *table_, motion, kQuantities);
  check_turns(chain, *table_, motion);
  t_ = motion.t;
  second_ = *factor_of_unit(table_->units[std::size_t(table_->find(names.time.name))]);
  end_ = t_.back();
  freedoms_ = chain.coordinate_names;
  has_rates_ = !motion.groups[1].empty();
  has_accelerations_ = !motion.groups[2].empty();
  splines_ = make_table_reference(motion, file);

  doubts_ = doubts_of_units(chain, *table_, motion, names.time.name, true);
  doubt_noise(*table_, motion, doubts_);
  const Derivatives derivatives(*table_, motion);
  derivatives.compare(0, 1, remarks_);
  derivatives.compare(has_rates_ ? 1 : 0, 2, remarks_);
  remark_gap(*table_, motion.t, remarks_);
  if (!motion.groups[3].empty()) {
    recorded_torques_ = motion.groups[3];
    own_torques_ = own_torques_beside(inverse_torques(chain, *splines_, motion.t));
  }
  if (!has_accelerations_ && rows() >= kFewestForCoarse) doubt_splines(chain, motion);
  if (!has_accelerations_ && rows() < kFewestForCoarse)
    remarks_.push_back("torques follow derivatives of splines, and " + std::to_string(rows()) + " rows of " + file + " are too few to tell how well these are known: a table with " +
                       (has_rates_ ? "qdd" : "more rows, or with qd and qdd,") + " knows better");
  remark_unused(*table_, motion, names, remarks_);
}

void RecordedMotion::doubt_splines(const Chain& chain, const TimeTable& motion) {
  const TimeTable coarse = every_other_row(motion);
  const std::vector<double> fine = inverse_torques(chain, *splines_, coarse.t);
  const std::vector<double> other = inverse_torques(chain, *make_table_reference(coarse, table_->file), coarse.t);
  const std::size_t n = freedoms_.size();
  OwnTorques worst;
  worst.freedom = freedoms_.front();
  double size = 0;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    const double off = std::fabs(fine[k] - other[k]);
    size = std::max(size, std::fabs(fine[k]));
    if (off > worst.largest) worst = {off, coarse.t[k / n], freedoms_[k % n]};
  }
  coarse_torques_ = worst;
  if (worst.largest > kDoubtfulTorque * size)
    remarks_.push_back("torques follow " + std::string(has_rates_ ? "derivatives of splines through qd" : "second derivatives of splines through q") +
                       " and are known so well: splines through every other row of " + table_->file + " alone give others, by " + format_significant(worst.largest, 3) +
                       " N m or N at most ('" + worst.freedom + "', t = " + format_significant(worst.t, 4) + " s), of " + format_significant(size, 3) +
                       "; a table with " + (has_rates_ ? "qdd" : "qd and qdd") + " knows better");
}

std::optional<RecordedMotion::OwnTorques> RecordedMotion::own_torques_beside(const std::vector<double>& tau) const {
  const std::size_t n = freedoms_.size();
  if (recorded_torques_.empty()) return std::nullopt;
  OwnTorques worst;
  worst.freedom = freedoms_.front();
  for (std::size_t k = 0; k < t_.size(); ++k)
    for (std::size_t i = 0; i < n; ++i) {
      const double off = std::fabs(recorded_torques_[i][k] - tau[k * n + i]);
      if (off > worst.largest) worst = {off, t_[k], freedoms_[i]};
    }
  return worst;
}

std::vector<std::string> RecordedMotion::remarks(const std::optional<OwnTorques>& own) const {
  std::vector<std::string> all = remarks_;
  if (own) all.push_back(words_of(*own, table_->file));
  return all;
}

std::vector<double> RecordedMotion::told_instants() const {
  std::vector<double> told = table_->told;
  for (double& t : told) t *= second_;
  return told;
}

void RecordedMotion::evaluate(double t, Vec q, Vec qd, Vec qdd) const {
  splines_->evaluate(std::clamp(t, 0.0, end_), q, qd, qdd);
}

namespace {

class ReplayTorque final : public TorqueLaw {
 public:
  ReplayTorque(std::shared_ptr<const RecordedMotion> motion, int nv)
      : motion_(std::move(motion)), q_(std::size_t(nv)), qd_(q_), qdd_(q_) {}

  void evaluate(const Chain& chain, Workspace& ws, double t, ConstVec, ConstVec, Vec tau) override {
    motion_->evaluate(t, q_, qd_, qdd_);
    inverse_torque(chain, ws, q_, qd_, qdd_, tau);
  }
  double price(const Chain& chain) const override { return kPriceOfLaw + motion_->price(true) + price_of_inverse_dynamics(chain); }
  // Where splines bend; its accelerations do not jump.
  std::vector<double> breaks(double end) const override { return motion_->breaks(end); }

 private:
  std::shared_ptr<const RecordedMotion> motion_;
  std::vector<double> q_, qd_, qdd_;
};

class Player final : public Integrator {
 public:
  Player(std::shared_ptr<const RecordedMotion> motion, int nv)
      : Integrator(nv, nv), motion_(std::move(motion)), qdd_(std::size_t(nv)) {}

  void start(double t, std::span<const double> q, std::span<const double> v) override {
    begin_ = time_ = t;
    std::copy(q.begin(), q.end(), q_.begin());
    std::copy(v.begin(), v.end(), v_.begin());
  }
  StepResult step(double end, double) override {
    begin_ = time_;
    time_ = end;
    motion_->evaluate(end, q_, v_, qdd_);
    return StepResult::ok;
  }
  void interpolate(double t, std::span<double> q, std::span<double> v) override { motion_->evaluate(t, q, v, qdd_); }
  int dense_order() const override { return 3; }

 private:
  std::shared_ptr<const RecordedMotion> motion_;
  std::vector<double> qdd_;
};

}  // namespace

std::unique_ptr<TorqueLaw> make_replay_torque(const Chain& chain, std::shared_ptr<const RecordedMotion> motion) {
  return std::make_unique<ReplayTorque>(std::move(motion), chain.nv);
}

std::unique_ptr<Integrator> make_player(std::shared_ptr<const RecordedMotion> motion, int nv) {
  return std::make_unique<Player>(std::move(motion), nv);
}

}  // namespace chainreel
