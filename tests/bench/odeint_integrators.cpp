#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/integrator_engines.hpp"

namespace chainreel::bench {
namespace {

namespace odeint = boost::numeric::odeint;

template <std::size_t n>
using State = std::array<double, 2 * n>;

// y' of y = (q, v) by our forward dynamics.
template <std::size_t n>
class OurRate {
 public:
  static constexpr const char* kName = "";
  explicit OurRate(const MotionProblem& problem)
      : system_(problem.run) {}
  void operator()(const State<n>& y, State<n>& f, double t) {
    std::copy_n(y.begin() + n, n, f.begin());
    system_.acceleration(t, {y.data(), n}, {y.data() + n, n}, {f.data() + n, n});
  }

 private:
  ChainSystem system_;
};

// ... by equations as a user of odeint writes them for one chain whose centres of mass lie on its links, in
// absolute angles phi, with the C library's sine and cosine:
//   sum_j a_ij (cos(phi_i - phi_j) phi_j'' + sin(phi_i - phi_j) phi_j'^2) + g_i cos phi_i = tau_i - tau_i+1
template <std::size_t n>
class WrittenRate {
 public:
  static constexpr const char* kName = ", equations by hand";
  explicit WrittenRate(const MotionProblem& problem) {
    const Chain& chain = problem.run.chain;
    double carried = 0;  // kg behind the link
    for (std::size_t i = n; i-- > 0;) {
      const PlanarBody& body = chain.planar->bodies[i + 1];
      const double length = i + 1 < n ? chain.planar->bodies[i + 2].p_PJ.x() : 0;
      const double reach = body.mass * body.com.x() + carried * length;
      a_[i][i] = body.inertia + body.mass * body.com.x() * body.com.x() + carried * length * length;
      for (std::size_t j = 0; j < i; ++j) a_[i][j] = a_[j][i] = chain.planar->bodies[j + 2].p_PJ.x() * reach;
      g_[i] = -chain.gravity.y() * reach;
      carried += body.mass;
    }
    std::vector<double> tau(n);
    Workspace ws(chain);
    problem.run.torque->evaluate(chain, ws, 0, problem.run.q0, problem.run.qd0, tau);  // constant
    for (std::size_t i = 0; i < n; ++i) Q_[i] = tau[i] - (i + 1 < n ? tau[i + 1] : 0);
  }

  void operator()(const State<n>& y, State<n>& f, double) const {
    double phi[n], rate[n], A[n][n], x[n];
    for (std::size_t i = 0; i < n; ++i) {
      phi[i] = y[i] + (i > 0 ? phi[i - 1] : 0);
      rate[i] = y[n + i] + (i > 0 ? rate[i - 1] : 0);
      A[i][i] = a_[i][i];
      x[i] = Q_[i] - g_[i] * std::cos(phi[i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        A[i][j] = A[j][i] = a_[i][j] * std::cos(phi[i] - phi[j]);
        const double s = a_[i][j] * std::sin(phi[i] - phi[j]);
        x[i] -= s * rate[j] * rate[j];
        x[j] += s * rate[i] * rate[i];
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = k + 1; i < n; ++i) {
        const double factor = A[i][k] / A[k][k];
        for (std::size_t j = k; j < n; ++j) A[i][j] -= factor * A[k][j];
        x[i] -= factor * x[k];
      }
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t j = i + 1; j < n; ++j) x[i] -= A[i][j] * x[j];
      x[i] /= A[i][i];
    }
    for (std::size_t i = 0; i < n; ++i) {
      f[i] = y[n + i];
      f[n + i] = x[i] - (i > 0 ? x[i - 1] : 0);
    }
  }

 private:
  double a_[n][n] = {}, g_[n] = {}, Q_[n] = {};
};

// Both must say the same, or nothing is timed.
template <std::size_t n>
void require_agreement(const MotionProblem& problem) {
  State<n> y, ours, written;
  for (std::size_t i = 0; i < 2 * n; ++i) y[i] = 0.3 + 0.7 * double(i);
  OurRate<n> rate(problem);
  rate(y, ours, 0);
  const WrittenRate<n> by_hand(problem);
  by_hand(y, written, 0);
  for (std::size_t i = 0; i < 2 * n; ++i)
    if (!(std::abs(ours[i] - written[i]) <= 1e-9 * (1 + std::abs(ours[i]))))
      throw std::runtime_error("the equations by hand of " + problem.name + " differ from ours");
}

template <class Stepper, template <std::size_t> class Rate, std::size_t n>
class Odeint final : public EndFinder {
 public:
  Odeint(const MotionProblem& problem, const std::string& name, std::vector<double> ladder)
      : EndFinder("odeint " + name + Rate<n>::kName, std::move(ladder)), run_(problem.run), rate_(problem) {}

  std::vector<double> end_of(double rung) override {
    State<n> y;
    std::copy_n(run_.q0.begin(), n, y.begin());
    std::copy_n(run_.qd0.begin(), n, y.begin() + n);
    const auto rate = [this](const State<n>& x, State<n>& f, double t) { rate_(x, f, t); };
    // A hundredth of the run; the control finds its own step from there.
    const double first = run_.duration / 100;
    if constexpr (requires { Stepper(rung, rung); })
      odeint::integrate_adaptive(Stepper(rung, rung), rate, y, 0.0, run_.duration, first);
    else
      odeint::integrate_adaptive(odeint::make_controlled<Stepper>(rung, rung), rate, y, 0.0, run_.duration,
                                 first);
    return {y.begin(), y.begin() + n};
  }

 private:
  const Simulation& run_;
  Rate<n> rate_;
};

template <template <std::size_t> class Rate, std::size_t n>
void add(const MotionProblem& problem, EndFinders& all) {
  using Y = State<n>;
  const std::vector<double> rungs = decades(2, 14, 2);
  all.push_back(
      std::make_unique<Odeint<odeint::runge_kutta_cash_karp54<Y>, Rate, n>>(problem, "CashKarp54", rungs));
  all.push_back(std::make_unique<Odeint<odeint::runge_kutta_dopri5<Y>, Rate, n>>(problem, "DOPRI5", rungs));
  all.push_back(
      std::make_unique<Odeint<odeint::runge_kutta_fehlberg78<Y>, Rate, n>>(problem, "RKF78", rungs));
  all.push_back(
      std::make_unique<Odeint<odeint::bulirsch_stoer<Y>, Rate, n>>(problem, "BulirschStoer", rungs));
}

template <std::size_t n>
void add_with_both(const MotionProblem& problem, EndFinders& all) {
  require_agreement<n>(problem);
  add<OurRate, n>(problem, all);
  add<WrittenRate, n>(problem, all);
}

}  // namespace

void add_odeint(const MotionProblem& problem, EndFinders& all) {
  if (problem.run.chain.nv == 2) add_with_both<2>(problem, all);
  if (problem.run.chain.nv == 3) add_with_both<3>(problem, all);
}

std::string odeint_version() {
  return std::to_string(BOOST_VERSION / 100000) + "." + std::to_string(BOOST_VERSION / 100 % 1000);
}

}  // namespace chainreel::bench
