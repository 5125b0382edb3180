// What charts judge rungs by, against a closed form: q' = v, v' = -100 q + .. of a slider on a spring.
#include "sim/choice/work_precision.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "core/scalar.hpp"
#include "sim/runs.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
namespace {

constexpr double kSpring = 50, kDamper = 8;

// The second slider of PP, borne, on a spring with a damper: q2 = e^(-d t) (q0 cos w t + ((v0 + d q0) / w) sin w t), d = c / 2 m and w^2 = k / m - d^2.
Simulation damped_slider(double duration) {
  Simulation run = run_of("pp", {"0", "-50 * q2 - 8 * qd2 + 9.81"}, duration);  // of 1 kg
  run.q0 = {0, 0.5};
  return run;
}

struct Slider {
  double q, qd;
};

// `m`: as the chain's own equation of motion at the start tells it, -k q0 / qdd.
Slider closed_form(const Simulation& run, double t) {
  ChainSystem system(run);
  std::vector<double> qdd(2);
  system.acceleration(0, run.q0, run.qd0, qdd);
  const double m = -kSpring * run.q0[1] / qdd[1], d = kDamper / (2 * m), w = std::sqrt(kSpring / m - d * d), q0 = run.q0[1], s = d * q0 / w;
  const double e = std::exp(-d * t), cosine = std::cos(w * t), sine = std::sin(w * t);
  return {e * (q0 * cosine + s * sine), e * (-d * (q0 * cosine + s * sine) + w * (s * cosine - q0 * sine))};
}

TEST(WorkPrecision, ReferencesFollowTheClosedFormAllAlong) {
  for (const double duration : {4.0, 0.7}) {
    Simulation run = damped_slider(duration);
    const LadderReference reference = find_reference_run(run);
    ASSERT_GE(reference.run.t.size(), 40u);
    EXPECT_EQ(reference.run.t.back(), duration);
    for (std::size_t k = 0; k < reference.run.t.size(); ++k) {
      const Slider exact = closed_form(run, reference.run.t[k]);
      EXPECT_NEAR(reference.run.q_at(k)[1], exact.q, 1e-13) << reference.run.t[k];   // a few roundings of exp, cos and the mass
      EXPECT_NEAR(reference.run.qd_at(k)[1], exact.qd, 1e-12) << reference.run.t[k];
    }
    EXPECT_LT(reference.uncertainty, 1e-13);
    EXPECT_LE(reference.final_uncertainty, reference.uncertainty);
  }
}

// What happens within a thousandth of the run is seen: a rate that decays in a few milliseconds, whose errors at the usual 40 instants
// are a thousandth of those on the way.
TEST(WorkPrecision, SeesWhatIsOverBeforeTheFirstOfTheUsualInstants) {
  Simulation run = run_of("pp", {"0", "-500 * qd2 + 9.81"}, 4);
  run.q0 = {0, 0};
  run.qd0 = {0, 10};
  const LadderReference reference = find_reference_run(run);
  std::size_t early = 0;
  for (const double t : reference.run.t) early += t < 0.05 ? 1 : 0;
  EXPECT_GE(early, 5u);
  EXPECT_LT(reference.run.t.size(), 400u) << "no more than the motion asks for";
  // The closed form: qd' = -(c / m) qd.
  ChainSystem system(run);
  std::vector<double> qdd(2);
  system.acceleration(0, run.q0, run.qd0, qdd);
  const double rate = -qdd[1] / run.qd0[1];
  const MethodSetting setting{&find_method("implicit_midpoint"), {}, 0.002};
  const Rung rung = measure(run, setting, reference.run, 1);
  apply(setting, run);
  const Trajectory own = simulate_every_step(run);
  double worst = 0;
  for (int k = 1; k < own.size(); ++k) worst = std::max(worst, std::abs(own.qd_at(k)[1] - run.qd0[1] * std::exp(-rate * own.t[std::size_t(k)])));
  EXPECT_GT(rung.way.qd, 0.5 * worst);
  EXPECT_LE(rung.way.qd, worst * (1 + 1e-6));
}

// What is damped forgets its errors: those along the way are some 1e4 times those at the end, and are what the chart judges.
TEST(WorkPrecision, ErrorsOfTheWayAreThoseOfTheWay) {
  Simulation run = damped_slider(4);
  const LadderReference reference = find_reference_run(run);
  for (const double step : {0.2, 0.05, 0.01}) {
    const Rung rung = measure(run, {&find_method("rk4"), {}, step}, reference.run, 1);
    apply({&find_method("rk4"), {}, step}, run);
    const Trajectory own = simulate_every_step(run);
    double q = 0, qd = 0;
    // At those ends of steps that are instants of the reference.
    for (int k = 1; k < own.size(); ++k)
      for (const double t : reference.run.t)
        if (std::abs(own.t[std::size_t(k)] - t) < 1e-9) {
          const Slider exact = closed_form(run, own.t[std::size_t(k)]);
          q = std::max(q, std::abs(own.q_at(k)[1] - exact.q)), qd = std::max(qd, std::abs(own.qd_at(k)[1] - exact.qd));
        }
    EXPECT_NEAR(rung.way.q, q, 1e-12 + 1e-9 * q) << step;
    EXPECT_NEAR(rung.way.qd, qd, 1e-11 + 1e-9 * qd) << step;
    EXPECT_EQ(rung.way.size, std::max(rung.way.q, reference.run.qd_scale * rung.way.qd)) << step;
    EXPECT_GT(rung.way.q, 100 * rung.final.q) << step;
    EXPECT_EQ(judged_error(rung, Judged::way), rung.way.size);
    EXPECT_EQ(judged_error(rung, Judged::final), rung.final.size);
    EXPECT_EQ(judged_error(rung, Judged::energy), rung.energy_error);
  }
}

// Halved steps halve the error of the way as they do that at the end: no polynomial between steps is judged. Order 6 in steps that are long
// enough for its error to stand above rounding.
TEST(WorkPrecision, ErrorsOfTheWayHaveTheMethodsOrder) {
  Simulation run = damped_slider(4);
  const LadderReference reference = find_reference_run(run);
  for (const auto& [name, order, step] : {std::tuple("explicit_euler", 1, 1e-3), std::tuple("rk4", 4, 0.02), std::tuple("gauss6", 6, 0.1)}) {
    const Rung coarse = measure(run, {&find_method(name), {}, step}, reference.run, 1), fine = measure(run, {&find_method(name), {}, step / 2}, reference.run, 1);
    EXPECT_NEAR(std::log2(coarse.way.q / fine.way.q), order, 0.25) << name;
  }
}

// Verlet at omega h = 2 stands at turning points at the ends of all steps, with all of its energy; what it does between is another motion. What is right at the
// ends and nearly so between them keeps its error there.
TEST(WorkPrecision, AnEnergyThatIsRightAtTheEndsOfStepsAloneIsNot) {
  Simulation run = run_of("pp", {"0", "-100 * q2 + 9.81"}, 4);
  run.q0 = {0, 1};
  ChainSystem system(run);
  std::vector<double> qdd(2);
  system.acceleration(0, run.q0, run.qd0, qdd);
  const double h = 2 / std::sqrt(-qdd[1]);
  const LadderReference reference = find_reference_run(run);
  EXPECT_NEAR(reference.run.energy, 50, 1e-3);  // 100 N/m 1 m^2 / 2, as far as steps meet the middle
  EXPECT_GT(measure(run, {&find_method("verlet"), {}, h}, reference.run, 1).energy_error, 25);
  EXPECT_LT(measure(run, {&find_method("gauss6"), {}, h}, reference.run, 1).energy_error, 1e-9);
}

// An implicit method may ask for its equations far more often than the table of costs says: what takes longer is ended, and no rung.
TEST(WorkPrecision, RungsThatTakeTooLongAreEnded) {
  Simulation run = damped_slider(4);
  const LadderReference reference = find_reference_run(run);
  const Rung ended = measure(run, {&find_method("rk4"), {}, 1e-6}, reference.run, 3, {}, 1e-3);
  EXPECT_EQ(ended.status, RunStatus::out_of_budget);
  EXPECT_EQ(ended.runs, 1);
  EXPECT_FALSE(std::isfinite(ended.way.size));
  EXPECT_EQ(measure(run, {&find_method("rk4"), {}, 1e-2}, reference.run, 3, {}, 10).runs, 3);
}

}  // namespace
}  // namespace chainreel
