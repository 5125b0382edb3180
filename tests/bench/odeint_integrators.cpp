#include <array>
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <limits>

#include "bench/integrator_engines.hpp"

namespace chainreel::bench {
namespace {

namespace odeint = boost::numeric::odeint;

template <std::size_t n>
using State = std::array<double, 2 * n>;

// y' of y = (q, v) by our forward dynamics.
template <std::size_t n>
struct Rate {
  ChainSystem* system;
  void operator()(const State<n>& y, State<n>& f, double t) const {
    std::copy_n(y.begin() + n, n, f.begin());
    system->acceleration(t, {y.data(), n}, {y.data() + n, n}, {f.data() + n, n});
  }
};

template <class Stepper, std::size_t n>
class Odeint final : public EndFinder {
 public:
  Odeint(const MotionProblem& problem, const std::string& name, std::vector<double> ladder)
      : EndFinder("odeint " + name, std::move(ladder)),
        run_(problem.run),
        system_(run_.chain, *run_.torque, LimitPolicy::report) {}

  std::vector<double> end_of(double rung) override {
    State<n> y;
    std::copy_n(run_.q0.begin(), n, y.begin());
    std::copy_n(run_.qd0.begin(), n, y.begin() + n);
    const Rate<n> rate{&system_};
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
  ChainSystem system_;
};

template <std::size_t n>
void add(const MotionProblem& problem, EndFinders& all) {
  using Y = State<n>;
  const std::vector<double> rungs = decades(2, 14, 2);
  all.push_back(
      std::make_unique<Odeint<odeint::runge_kutta_cash_karp54<Y>, n>>(problem, "CashKarp54", rungs));
  all.push_back(std::make_unique<Odeint<odeint::runge_kutta_dopri5<Y>, n>>(problem, "DOPRI5", rungs));
  all.push_back(std::make_unique<Odeint<odeint::runge_kutta_fehlberg78<Y>, n>>(problem, "RKF78", rungs));
  all.push_back(std::make_unique<Odeint<odeint::bulirsch_stoer<Y>, n>>(problem, "BulirschStoer", rungs));
}

}  // namespace

void add_odeint(const MotionProblem& problem, EndFinders& all) {
  if (problem.run.chain.nv == 2) add<2>(problem, all);
  if (problem.run.chain.nv == 3) add<3>(problem, all);
}

std::string odeint_version() {
  return std::to_string(BOOST_VERSION / 100000) + "." + std::to_string(BOOST_VERSION / 100 % 1000);
}

}  // namespace chainreel::bench
