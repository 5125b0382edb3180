#include "sim/between_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/format.hpp"
#include "core/scalar.hpp"
#include "dynamics/kinematics.hpp"
#include "sim/plots.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

constexpr int kBetween = 7;             // instants between two samples
constexpr std::size_t kMostBetween = 20'000;  // of a run, where torques are asked
constexpr double kFlat = 0.1;           // of its plot's range: a curve that moves less is judged by so much
constexpr std::size_t kMostClose = 16;  // places looked at closer
constexpr double kShortest = 1e-9;      // of the duration: what is closer, like an event at a sample, makes rates of rounding
constexpr double kRounding = 1e-9;      // of the size of the numbers, and in rad/s, N m, ..: no motion

// The instants looked at between the samples a and b: evenly, at kinks and halfway between those.
std::vector<double> instants_between(double a, double b, int evenly, std::span<const double> kinks) {
  std::vector<double> times;
  for (int i = 1; i <= evenly; ++i) times.push_back(a + (b - a) * i / (evenly + 1));
  double before = a;
  for (const double kink : kinks) {
    times.push_back(0.5 * (before + kink));
    times.push_back(kink);
    before = kink;
  }
  if (!kinks.empty()) times.push_back(0.5 * (before + b));
  std::sort(times.begin(), times.end());
  return times;
}

// A run with more samples: those of `run`, each followed by what lies between it and the next.
struct Denser {
  Trajectory run;
  std::vector<int> samples;  // rows of `run` that are the samples of the first
  int evenly = 1;            // rows between two of them; where there are more, the torques have kinks
};

class Filler {
 public:
  Filler(const Simulation& simulation, const Trajectory& run)
      : simulation_(simulation), chain_(simulation.chain), run_(run), system_(simulation), qdd_(std::size_t(chain_.nv)) {
    kinks_ = simulation.torque->breaks(simulation.duration);
    std::sort(kinks_.begin(), kinks_.end());
    const auto room = std::clamp<std::size_t>(kMostBetween / std::size_t(std::max(run.size(), 1)), 1, kBetween);
    evenly_ = int(room);
    stride_ = 1 + kinks_.size() / kMostBetween;
  }

  Denser fill() {
    denser_.run.nq = run_.nq, denser_.run.nv = run_.nv, denser_.run.holds = run_.holds;
    denser_.run.rows = run_.lambda.empty() ? 0 : run_.rows;
    for (int k = 0; k < run_.size(); ++k) {
      denser_.samples.push_back(denser_.run.size());
      put(run_.t[std::size_t(k)], run_.q_at(k), run_.qd_at(k));
      if (denser_.run.rows > 0) put_multipliers(run_.lambda_at(k));
      if (k + 1 < run_.size() && run_.t[std::size_t(k) + 1] - run_.t[std::size_t(k)] > kShortest * simulation_.duration) fill_behind(k);
    }
    denser_.evenly = evenly_;
    simulation_.torque->leave_pieces();
    return std::move(denser_);
  }

 private:
  void put(double t, ConstVec q, ConstVec qd) {
    Trajectory& run = denser_.run;
    run.t.push_back(t);
    run.q.insert(run.q.end(), q.begin(), q.end());
    run.qd.insert(run.qd.end(), qd.begin(), qd.end());
  }

  void put_multipliers(ConstVec lambda) {
    denser_.run.lambda.insert(denser_.run.lambda.end(), lambda.begin(), lambda.end());
  }

  // The state at t back onto the constraints, where the run does so, and the multipliers there: no number where it does
  // not come back.
  std::vector<double> meet_constraints(double t) {
    ConstrainedChain& constrained = *system_.constrained();
    Workspace& ws = system_.workspace();
    hold_as_then(system_, simulation_, run_, t);
    if (constrained.projects() && !constrained.project(ws, q_, qd_).reached)
      return std::vector<double>(std::size_t(run_.rows), std::numeric_limits<double>::quiet_NaN());
    constrained.accelerate(ws, q_, qd_, system_.applied_torque(t, q_, qd_), qdd_);
    const ConstVec lambda = constrained.lambda();
    return {lambda.begin(), lambda.end()};
  }

  void fill_behind(int k) {
    const double a = run_.t[std::size_t(k)], b = run_.t[std::size_t(k) + 1];
    std::vector<double> within;
    const auto first = std::upper_bound(kinks_.begin(), kinks_.end(), a), last = std::lower_bound(first, kinks_.end(), b);
    for (auto kink = first; kink < last; kink += std::min<std::ptrdiff_t>(std::ptrdiff_t(stride_), last - kink))
      within.push_back(*kink);
    for (const double t : instants_between(a, b, evenly_, within)) {
      state_between(k, (t - a) / (b - a), b - a);
      std::vector<double> lambda;
      if (denser_.run.rows > 0) lambda = meet_constraints(t);
      put(t, q_, qd_);
      put_multipliers(lambda);
    }
  }

  // At the part s of the way from sample k to the next, h apart.
  void state_between(int k, double s, double h) {
    const ConstVec qa = run_.q_at(k), qb = run_.q_at(k + 1), va = run_.qd_at(k), vb = run_.qd_at(k + 1);
    q_.assign(qa.begin(), qa.end());
    qd_.resize(va.size());
    if (run_.nq != run_.nv || chain_.has_floating) {
      std::vector<double> mean(va.size());
      for (std::size_t i = 0; i < va.size(); ++i) {
        qd_[i] = va[i] + s * (vb[i] - va[i]);
        mean[i] = 0.5 * (va[i] + qd_[i]);
      }
      advance(chain_, q_, mean, s * h);
      return;
    }
    for (std::size_t i = 0; i < q_.size(); ++i) {
      const double step = qb[i] - qa[i], bend_a = h * va[i] - step, bend_b = step - h * vb[i];
      const double bend = bend_a + s * (bend_b - bend_a);
      q_[i] = qa[i] + s * step + s * (1 - s) * bend;
      qd_[i] = (step + (1 - 2 * s) * bend + s * (1 - s) * (bend_b - bend_a)) / h;
    }
  }

  const Simulation& simulation_;
  const Chain& chain_;
  const Trajectory& run_;
  ChainSystem system_;
  std::vector<double> kinks_;
  int evenly_ = 1;
  std::size_t stride_ = 1;
  Denser denser_;
  std::vector<double> q_, qd_, qdd_;
};

// That a curve goes beyond both samples about it.
struct Hidden {
  std::size_t plot = 0, curve = 0, sample = 0;  // behind which it lies
  double least_unit = 0, unit = 1;  // of shares: the curve's range
  double let_be = 0;                // the share that may be hidden
  double amount = 0, t = 0;

  double excess() const { return amount / (unit * let_be); }
};

double span_of(const std::vector<double>& y, double& size) {
  double low = kInfinity, high = -kInfinity;
  for (const double one : y)
    if (std::isfinite(one)) low = std::min(low, one), high = std::max(high, one);
  if (!(low <= high)) return 0;
  size = std::max({size, std::abs(low), std::abs(high)});
  return high - low;
}

// Where the curves of one plot do so by more than is let be.
void look_at(const PlotCurves& plot, std::size_t number, const Denser& denser, std::vector<Hidden>& found) {
  double widest = 0, size = 0;
  for (const PlotCurve& curve : plot.curves) widest = std::max(widest, span_of(curve.y, size));
  if (!(widest > kRounding * std::max(1.0, size))) return;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const std::vector<double>& y = plot.curves[c].y;
    const double least = kFlat * widest, unit = std::max(span_of(y, size), least);
    for (std::size_t k = 0; k + 1 < denser.samples.size(); ++k) {
      const int first = denser.samples[k], last = denser.samples[k + 1];
      const bool has_kinks = plot.quantity == PlotQuantity::tau && last - first - 1 > denser.evenly;
      Hidden hidden{number, c, k, least, unit, has_kinks ? kDoubtfulPulse : kDoubtfulSamples};
      const auto [low, high] = std::minmax(y[std::size_t(first)], y[std::size_t(last)]);
      for (int i = first + 1; i < last; ++i)
        if (const double beyond = std::max(low - y[std::size_t(i)], y[std::size_t(i)] - high); beyond > hidden.amount)
          hidden.amount = beyond, hidden.t = denser.run.t[std::size_t(i)];
      if (hidden.excess() > 1) found.push_back(hidden);
    }
  }
}

// The same places in the run itself, at instants near together and those where something was seen: the cubic tells where something
// hides, of a sharp peak not how much, and behind a jump that there is a peak where there is none.
void look_closer(const PlotSet& plots, const Simulation& simulation, const Trajectory& trajectory, std::vector<Hidden>& found) {
  constexpr int kClose = 200;
  std::vector<double> times = trajectory.t;
  for (const Hidden& one : found) {
    const double a = trajectory.t[one.sample], b = trajectory.t[one.sample + 1];
    for (int i = 0; i < kClose; ++i) times.push_back(a + (b - a) * i / kClose);
    times.push_back(b);
    times.push_back(one.t);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const Trajectory close = simulate(simulation, times);
  const std::vector<PlotCurves> curves = plot_curves(plots, simulation, close, close.size());
  for (Hidden& one : found) {
    const std::vector<double>& y = curves[one.plot].curves[one.curve].y;
    const auto place = [&](double t) { return std::size_t(std::lower_bound(close.t.begin(), close.t.end(), t) - close.t.begin()); };
    const std::size_t first = place(trajectory.t[one.sample]), last = place(trajectory.t[one.sample + 1]);
    double size = 0;
    one.unit = std::max(span_of(y, size), one.least_unit);
    one.amount = 0;
    if (last >= y.size()) continue;
    const auto [low, high] = std::minmax(y[first], y[last]);
    for (std::size_t i = first + 1; i < last; ++i)
      if (const double beyond = std::max(low - y[i], y[i] - high); beyond > one.amount) one.amount = beyond, one.t = close.t[i];
  }
}

// Frames a second at which as many frames stand where this looked.
long rate_for(const Trajectory& run) {
  double longest = 0;
  for (std::size_t k = 1; k < run.t.size(); ++k) longest = std::max(longest, run.t[k] - run.t[k - 1]);
  return std::lround((kBetween + 1) / longest);
}

}  // namespace

std::optional<Doubt> doubt_between(const Simulation& simulation, const Trajectory& trajectory) {
  if (trajectory.size() < 3 || trajectory.steps + 1 == trajectory.size() || !simulation.torque) return {};
  const Denser denser = Filler(simulation, trajectory).fill();
  std::vector<PlotEntry> always{{"qd", "", {}}, {"tau", "", {}}};
  if (denser.run.rows > 0) always.push_back({"lambda", "", {}});
  const auto plots = make_plots(simulation.chain, always, {}, {}, {}, denser.run.rows);
  const std::vector<PlotCurves> curves = plot_curves(*plots, simulation, denser.run, denser.run.size());
  std::vector<Hidden> found;
  for (std::size_t i = 0; i < curves.size(); ++i) look_at(curves[i], i, denser, found);
  std::stable_sort(found.begin(), found.end(), [](const Hidden& a, const Hidden& b) { return a.excess() > b.excess(); });
  if (found.size() > kMostClose) found.resize(kMostClose);
  if (!found.empty()) look_closer(*plots, simulation, trajectory, found);
  const auto worst = std::max_element(found.begin(), found.end(), [](const Hidden& a, const Hidden& b) { return a.excess() < b.excess(); });
  if (worst == found.end() || worst->excess() <= 1) return {};
  const PlotCurves& plot = curves[worst->plot];
  const std::string& own = plot.curves[worst->curve].name;
  const double share = worst->amount / worst->unit;
  return Doubt{"samples", share,
               "between two frames or rows " + (own.empty() ? plot.title : own) + " goes " + format_significant(worst->amount, 3) +
                   " beyond both, " + std::to_string(std::lround(100 * share)) + " % of its range, at t = " +
                   format_significant(worst->t, 5) + " s: arrows and tables miss that",
               "--set video.fps=" + std::to_string(rate_for(trajectory)) + ", of a table simulate --every " +
                   format_significant(1000.0 / double(rate_for(trajectory)), 2) + "ms or --every-step"};
}

}  // namespace chainreel
