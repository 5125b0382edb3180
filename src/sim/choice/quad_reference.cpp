#include "sim/choice/quad_reference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dynamics/friction.hpp"
#include "dynamics/recursions.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
namespace {

// Errors of a step; a motion that amplifies them 1e8 times still has all digits of a double.
constexpr double kTolerance = 1e-25;
constexpr int kOrder = 40;
constexpr int kColumns = 12, kOtherColumns = 10;
// Large against these errors, small against all that bends the motion.
constexpr double kPerturbation = 1e-10;
constexpr double kPerturbedTolerance = 1e-16;
constexpr int kPerturbedOrder = 22;

// Some ten times those of any scene that ends: half a minute.
constexpr long kMostAttempts = 8000, kMostExpansions = 100'000;

struct States {
  std::vector<Quad> q, v;  // n numbers a time
};

template <class Method>
std::optional<States> states_at(Method& method, const std::vector<Quad>& q0, const std::vector<Quad>& v0,
                                std::span<const double> times) {
  method.start(0, q0, v0);
  States states;
  for (const double t : times) {
    if (!method.run_to(t)) return {};
    states.q.insert(states.q.end(), method.q().begin(), method.q().end());
    states.v.insert(states.v.end(), method.v().begin(), method.v().end());
  }
  return states;
}

double apart(std::span<const Quad> a, std::span<const Quad> b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(double(a[i] - b[i])));
  return largest;
}

bool has_series(const Simulation& simulation) {
  return !why_no_series(simulation.chain, *simulation.torque, simulation.limit);
}

std::vector<Quad> in_quad(const std::vector<double>& x) {
  return {x.begin(), x.end()};
}

}  // namespace

std::optional<QuadReference> quad_reference(const Simulation& simulation, std::span<const double> times, const StopRequest& stop) {
  const std::unique_ptr<QuadSystem> system = make_quad_system(simulation);
  if (!system) return {};
  const std::vector<Quad> q0 = in_quad(simulation.q0), v0 = in_quad(simulation.qd0);
  QuadExtrapolation extrapolation(*system, kColumns, kTolerance);
  extrapolation.set_limits(stop, kMostAttempts + long(times.size()));
  QuadReference reference;
  std::optional<States> first, second;
  if (has_series(simulation)) {
    LongSeries<Quad> series(simulation.chain, *simulation.torque->affine(), kOrder, kTolerance);
    series.set_limits(stop, kMostExpansions);
    first = states_at(series, q0, v0, times);
    if (first) second = states_at(extrapolation, q0, v0, times);
    reference.how = "Taylor series beside extrapolation of the midpoint rule, in quadruple precision";
  } else {
    QuadExtrapolation other(*system, kOtherColumns, kTolerance * 1e-2);
    other.set_limits(stop, kMostAttempts + long(times.size()));
    first = states_at(extrapolation, q0, v0, times);
    if (first) second = states_at(other, q0, v0, times);
    reference.how = "extrapolation of the midpoint rule at two orders, in quadruple precision";
  }
  if (!first || !second) return {};
  const auto n = std::size_t(system->n());
  for (std::size_t k = 0; k < times.size(); ++k) {
    reference.t.push_back(times[k]);
    const auto row = [&](const std::vector<Quad>& x) { return std::span(x).subspan(k * n, n); };
    for (const Quad& q : row(first->q)) reference.q.push_back(double(q));
    for (const Quad& v : row(first->v)) reference.qd.push_back(double(v));
    reference.uncertainty.push_back(apart(row(first->q), row(second->q)));
  }
  return reference;
}

std::optional<double> quad_amplification(const Simulation& simulation, double end, const StopRequest& stop) {
  const std::unique_ptr<QuadSystem> system = make_quad_system(simulation);
  if (!system) return {};
  const bool by_series = has_series(simulation);
  const AffineTorque torque = by_series ? *simulation.torque->affine() : AffineTorque{};
  const auto end_of = [&](const std::vector<Quad>& q0, const std::vector<Quad>& v0) {
    const double times[] = {end};
    if (by_series) {
      LongSeries<Quad> series(simulation.chain, torque, kPerturbedOrder, kPerturbedTolerance);
      series.set_limits(stop, kMostExpansions);
      return states_at(series, q0, v0, times);
    }
    QuadExtrapolation extrapolation(*system, kOtherColumns, kPerturbedTolerance);
    extrapolation.set_limits(stop, kMostAttempts);
    return states_at(extrapolation, q0, v0, times);
  };
  std::vector<Quad> q0 = in_quad(simulation.q0), v0 = in_quad(simulation.qd0);
  const std::optional<States> unperturbed = end_of(q0, v0);
  if (!unperturbed) return {};
  double largest = 1;
  for (std::vector<Quad>* start : {&q0, &v0}) {
    for (Quad& x : *start) {
      const Quad exact = x;
      x += kPerturbation;
      const std::optional<States> perturbed = end_of(q0, v0);
      x = exact;
      if (!perturbed) return {};
      largest = std::max(largest, apart(perturbed->q, unperturbed->q) / kPerturbation);
    }
  }
  return largest;
}

namespace {

constexpr double kFirstStep = 0.05;  // s
constexpr double kSafety = 0.8, kSlowest = 0.2, kFastest = 2;
constexpr double kShortest = 1e-12;  // s

}  // namespace

QuadExtrapolation::QuadExtrapolation(QuadSystem& system, int columns, double tolerance)
    : system_(system),
      n_(std::size_t(system.n())),
      tolerance_(tolerance),
      table_(std::size_t(columns), std::vector<Quad>(2 * n_)),
      y_(2 * n_),
      before_(2 * n_),
      f_(2 * n_) {}

void QuadExtrapolation::start(Quad t, std::vector<Quad> q, std::vector<Quad> v) {
  t_ = t;
  h_ = kFirstStep;
  q_ = std::move(q);
  v_ = std::move(v);
}

void QuadExtrapolation::rate(Quad t, const std::vector<Quad>& y, std::vector<Quad>& f) {
  const std::span<const Quad> q(y.data(), n_), v(y.data() + n_, n_);
  std::copy(v.begin(), v.end(), f.begin());
  system_.acceleration(t, q, v, std::span(f).subspan(n_));
}

void QuadExtrapolation::midpoint(Quad h, int substeps, std::vector<Quad>& y) {
  const Quad part = h / substeps;
  std::copy(q_.begin(), q_.end(), before_.begin());
  std::copy(v_.begin(), v_.end(), before_.begin() + std::ptrdiff_t(n_));
  rate(t_, before_, f_);
  for (std::size_t i = 0; i < 2 * n_; ++i) y[i] = before_[i] + part * f_[i];
  for (int k = 1; k < substeps; ++k) {
    rate(t_ + k * part, y, f_);
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      const Quad next = before_[i] + 2 * part * f_[i];
      before_[i] = y[i];
      y[i] = next;
    }
  }
}

double QuadExtrapolation::attempt(Quad h) {
  double error = 0;
  for (std::size_t j = 0; j < table_.size(); ++j) {
    midpoint(h, 2 * int(j + 1), y_);
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      Quad better = y_[i];
      for (std::size_t k = 0; k < j; ++k) {
        const Quad ratio = Quad(double(j + 1)) / Quad(double(j - k));
        const Quad next = better + (better - table_[k][i]) / (ratio * ratio - 1);
        table_[k][i] = better;
        better = next;
      }
      table_[j][i] = better;
    }
  }
  const std::vector<Quad>&best = table_.back(), &worse = table_[table_.size() - 2];
  for (std::size_t i = 0; i < 2 * n_; ++i) {
    const double part = std::abs(double(best[i] - worse[i])) / (1 + std::abs(double(best[i])));
    if (!(part <= error)) error = part;
  }
  return error / tolerance_;
}

bool QuadExtrapolation::run_to(Quad end) {
  const double power = 1.0 / (2 * double(table_.size()) - 1);
  while (t_ < end) {
    const bool last = t_ + h_ >= end;
    const Quad h = last ? end - t_ : h_;
    if (attempts_++ >= most_ || (stop_ && stop_(double(t_)))) return false;
    const double error = attempt(h);
    const double factor =
        std::isfinite(error)
            ? std::clamp(kSafety * std::pow(std::max(error, 1e-30), -power), kSlowest, kFastest)
            : kSlowest;
    if (error <= 1) {
      t_ = last ? end : t_ + h;
      std::copy_n(table_.back().begin(), n_, q_.begin());
      std::copy_n(table_.back().begin() + std::ptrdiff_t(n_), n_, v_.begin());
      if (!last || factor < 1) h_ = h * factor;
    } else {
      h_ = h * std::min(factor, 0.9);
      if (h_ < kShortest) return false;
    }
  }
  return true;
}

namespace {

// tanh of joint friction, as in dynamics/friction.cpp.
Quad smooth_sign(Quad x) {
  const Quad e = exponential(-2 * absolute(x));
  const Quad t = (1 - e) / (1 + e);
  return x < 0 ? -t : t;
}

template <class A>
class ChainInQuad final : public QuadSystem {
 public:
  explicit ChainInQuad(const Simulation& simulation)
      : QuadSystem(simulation.chain.nv),
        chain_(simulation.chain),
        law_(*simulation.torque),
        links_(chain_),
        tau_(std::size_t(n_)) {}

  void acceleration(Quad t, std::span<const Quad> q, std::span<const Quad> v, std::span<Quad> vd) override {
    law_.evaluate_in_quad(t, q, v, tau_);
    for (std::size_t i = 1; i < chain_.bodies.size() && chain_.has_dissipation; ++i) {
      const Joint& joint = chain_.bodies[i].joint;
      const auto k = std::size_t(joint.v_index);
      tau_[k] -= Quad(joint.damping) * v[k];
      if (joint.friction != 0) tau_[k] -= joint.friction * smooth_sign(v[k] / Quad(kFrictionSmoothing));
    }
    place<A>(links_, q);
    aba<A>(links_, links_.base_acceleration, v, tau_, vd);
  }

 private:
  const Chain& chain_;
  const TorqueLaw& law_;
  Links<A> links_;
  std::vector<Quad> tau_;
};

}  // namespace

std::unique_ptr<QuadSystem> make_quad_system(const Simulation& simulation) {
  const Chain& chain = simulation.chain;
  if (!simulation.constraints.empty()) return {};
  if (chain.has_floating || chain.has_mimic || cuts_torques(chain, simulation.limit)) return {};
  std::vector<Quad> q(simulation.q0.begin(), simulation.q0.end()), tau(q.size());
  if (!simulation.torque->evaluate_in_quad(0, q, q, tau)) return {};
  if (chain.planar) return std::make_unique<ChainInQuad<Planar<Quad>>>(simulation);
  return std::make_unique<ChainInQuad<Spatial<Quad>>>(simulation);
}

namespace {

constexpr int kLastTerms = 4;
constexpr double kLongestStep = 0.25;  // s; also where the last terms are all missing
constexpr double kShortestStep = 1e-12;        // s

}  // namespace

template <class T>
LongSeries<T>::LongSeries(const Chain& chain, const AffineTorque& torque, int order, double tolerance)
    : series_(chain, torque, order),
      n_(std::size_t(chain.nv)),
      order_(order),
      tolerance_(tolerance),
      c_(n_ * std::size_t(order + 1)) {}

template <class T>
void LongSeries<T>::start(T t, std::vector<T> q, std::vector<T> v) {
  t_ = t;
  q_ = std::move(q);
  v_ = std::move(v);
}

template <class T>
double LongSeries<T>::longest_step() const {
  double longest = kLongestStep;
  for (int k = order_; k > order_ - kLastTerms; --k) {
    for (std::size_t i = 0; i < n_; ++i) {
      const double c = std::abs(double(c_[std::size_t(k) * n_ + i]));
      if (c > 0) longest = std::min(longest, std::pow(tolerance_ / (k * c), 1.0 / (k - 1)));
      if (std::isnan(c)) return 0;
    }
  }
  return longest;
}

template <class T>
bool LongSeries<T>::run_to(T end) {
  while (t_ < end) {
    if (expansions_ >= most_ || (stop_ && stop_(double(t_)))) return false;
    ++expansions_;
    series_.expand(t_, q_, v_, order_, c_);
    const double longest = longest_step();
    if (longest < kShortestStep) return false;
    const bool last = t_ + longest >= end;
    const T h = last ? end - t_ : T(longest);
    for (std::size_t i = 0; i < n_; ++i) {
      T q = 0, v = 0;
      for (int k = order_; k >= 0; --k) {
        v = v * h + q;
        q = q * h + c_[std::size_t(k) * n_ + i];
      }
      q_[i] = q, v_[i] = v;
    }
    t_ = last ? end : t_ + h;
  }
  return true;
}

template class LongSeries<Quad>;
template class LongSeries<DoubleDouble>;

}  // namespace chainreel
