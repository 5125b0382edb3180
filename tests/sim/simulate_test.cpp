#include "dynamics/energy.hpp"
#include "core/error.hpp"
#include "sim/simulate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/runs.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

// Largest distance between the last states of two runs.
double distance(const Trajectory& a, const Trajectory& b) {
  double largest = 0;
  for (std::size_t i = 0; i < std::size_t(a.nq); ++i)
    largest = std::max(largest, std::abs(a.q_at(a.size() - 1)[i] - b.q_at(b.size() - 1)[i]));
  return largest;
}

TEST(Simulate, ThrowsPpOnItsParabola) {
  // q1 = v t, q2 = v t - g t^2 / 2: RK4 is exact on polynomials of degree 4, so only round-off of 2000
  // additions stays.
  Simulation run = run_of("pp", {"0", "0"}, 2);
  run.qd0 = {1.5, 9.81};
  const Trajectory trajectory = simulate(run, instants(2, 0.1));
  ASSERT_EQ(trajectory.status, RunStatus::finished);
  for (int k = 0; k < trajectory.size(); ++k) {
    const double t = trajectory.t[std::size_t(k)];
    EXPECT_NEAR(trajectory.q_at(k)[0], 1.5 * t, 2000 * 3 * 2.3e-16);
    EXPECT_NEAR(trajectory.q_at(k)[1], 9.81 * t - 9.81 / 2 * t * t, 2000 * 20 * 2.3e-16);
    EXPECT_NEAR(trajectory.qd_at(k)[1], 9.81 - 9.81 * t, 2000 * 20 * 2.3e-16);
  }
}

// What is not ready is refused, where numbers beyond the end of a list were read, a run never ended, or samples were lost.
TEST(Simulate, RefusesWhatIsNotReady) {
  const auto trouble = [](auto change, std::vector<double> times) {
    Simulation run = run_of("pp", {"0", "0"}, 2);
    change(run);
    try {
      simulate(run, times);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return std::string(error.what());
    }
    return std::string();
  };
  const auto leave = [](Simulation&) {};
  EXPECT_EQ(trouble(leave, {0, 1, 2}), "");
  EXPECT_THAT(trouble([](Simulation& run) { run.q0 = {1}; }, {}), HasSubstr("1 numbers of q0, the chain 2"));
  EXPECT_THAT(trouble([](Simulation& run) { run.qd0 = {}; }, {}), HasSubstr("0 numbers of qd0"));
  EXPECT_THAT(trouble([](Simulation& run) { run.method = nullptr; }, {}), HasSubstr("no method"));
  EXPECT_THAT(trouble([](Simulation& run) { run.torque = nullptr; }, {}), HasSubstr("no torque"));
  EXPECT_THAT(trouble([](Simulation& run) { run.step = -1; }, {}), HasSubstr("a step of -1 s"));
  EXPECT_THAT(trouble([](Simulation& run) { run.duration = -1; }, {}), HasSubstr("a duration of -1 s"));
  EXPECT_THAT(trouble(leave, {0, 1, 0.5}), HasSubstr("do not rise from 0 to its duration: 0.5 s"));
  EXPECT_THAT(trouble(leave, {0, 3}), HasSubstr("3 s"));
  EXPECT_THAT(trouble(leave, {-1}), HasSubstr("-1 s"));
}

TEST(Simulate, MovesPpAsTheLecturesMethodSaysExactly) {
  // Semi-implicit Euler on constant acceleration: q2(k h) = v k h + a h^2 k (k + 1) / 2.
  Simulation run = run_of("pp", {"0", "0"}, 2, "semi_implicit_euler");
  run.qd0 = {0, 9.81};
  const Trajectory trajectory = simulate_every_step(run);
  ASSERT_EQ(trajectory.size(), 2001);
  for (int k = 0; k <= 2000; k += 100) {
    const double expected = 9.81 * k * 1e-3 - 9.81 * 1e-6 * k * (k + 1) / 2;
    EXPECT_NEAR(trajectory.q_at(k)[1], expected, 2000 * 20 * 2.3e-16);
  }
}

TEST(Simulate, SwingsPpOnItsSpring) {
  // q2 = q2(0) cos(omega t), omega = sqrt(100 / m), m the mass that moves in y (1 kg). RK4's error after 10 s
  // at omega h = 0.01: (omega h)^4 omega t / 120 = 8e-9.
  Simulation run = run_of("pp", {"0", "-100 * q2"}, 10);
  run.chain.gravity.setZero();
  run.q0 = {0, 1};
  const Trajectory trajectory = simulate(run, instants(10, 0.5));
  for (int k = 0; k < trajectory.size(); ++k)
    EXPECT_NEAR(trajectory.q_at(k)[1], std::cos(10 * trajectory.t[std::size_t(k)]), 1e-8);
}

class Order : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Registry, Order, ::testing::Values("explicit_euler", "semi_implicit_euler", "rk4"),
                         [](const auto& p) { return p.param; });

TEST_P(Order, OfTheMethodShowsInTheErrorOnRr) {
  const std::vector<double> end{1};
  const double h = GetParam() == "rk4" ? 0.0025 : 0.0005;
  const Trajectory reference = simulate(run_of("rr", {"1", "1"}, 1, "rk4", 1e-4), end);
  const double coarse = distance(simulate(run_of("rr", {"1", "1"}, 1, GetParam(), h), end), reference);
  const double fine = distance(simulate(run_of("rr", {"1", "1"}, 1, GetParam(), h / 2), end), reference);
  // The slope's own error is the next term of the series: some h / 1 s for the Euler methods, 0.02 x 5 for
  // RK4.
  EXPECT_NEAR(std::log2(coarse / fine), find_method(GetParam()).order, GetParam() == "rk4" ? 0.15 : 0.05);
  EXPECT_GT(coarse, 0);
}

TEST(Simulate, EndsAtTheDurationThoughItIsNoMultipleOfTheStep) {
  Simulation run = run_of("pp", {"0", "0"}, 1.00035);
  run.qd0 = {1, 0};
  const std::vector<double> times{1.00035};
  const Trajectory trajectory = simulate(run, times);
  ASSERT_EQ(trajectory.size(), 1);
  EXPECT_EQ(trajectory.steps, 1001);
  EXPECT_EQ(trajectory.end_time, 1.00035);
  EXPECT_NEAR(trajectory.q_at(0)[0], 1.00035, 1001 * 2.3e-16);
}

TEST(Simulate, SamplesBetweenStepsToFourthOrder) {
  // The same run sampled off its steps: the Hermite cubic is off by h^4/384 of the fourth derivative (some
  // 1e3 here).
  const std::vector<double> times{0.33333, 0.77777};
  const Trajectory coarse = simulate(run_of("rr", {"0", "0"}, 1, "rk4", 0.001), times);
  const Trajectory fine = simulate(run_of("rr", {"0", "0"}, 1, "rk4", 0.00001), times);
  for (int k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(coarse.q_at(k)[i], fine.q_at(k)[i], 1e-10);
      EXPECT_NEAR(coarse.qd_at(k)[i], fine.qd_at(k)[i], 1e-7);  // one order less
    }
}

// Explicit Euler by a shorter step of its own; semi-implicit Euler evenly from end to end, as a shorter step of it goes beyond both.
TEST(Simulate, BetweenEulersStepsIsWhatTheMethodSaysOfThem) {
  constexpr double kStep = 0.02;
  for (const char* method : {"explicit_euler", "semi_implicit_euler"}) {
    const bool is_even = std::string_view(method) == "semi_implicit_euler";
    const auto start = [&] { return run_of("rr", {"3", "-q2"}, 1, method, kStep); };
    const Simulation run = start();
    const Trajectory all = simulate_every_step(run);
    double apart = 0;  // of the two ways
    for (const double share : {0.25, 0.6}) {
      for (const int k : {0, 7, 40}) {
        const double t[] = {(k + share) * kStep};
        Simulation shorter = start();
        shorter.q0.assign(all.q_at(k).begin(), all.q_at(k).end());
        shorter.qd0.assign(all.qd_at(k).begin(), all.qd_at(k).end());
        shorter.step = shorter.duration = share * kStep;
        const Trajectory inside = simulate(run, t), own = simulate_every_step(shorter);
        for (std::size_t i = 0; i < 2; ++i) {  // the length of the step is rounded: 1e-15 of rates of some 10
          const double even = (1 - share) * all.q_at(k)[i] + share * all.q_at(k + 1)[i];
          EXPECT_NEAR(inside.q_at(0)[i], is_even ? even : own.q_at(1)[i], 1e-13) << method << k;
          EXPECT_NEAR(inside.qd_at(0)[i], own.qd_at(1)[i], 1e-13) << method << k;
          apart = std::max(apart, std::abs(even - own.q_at(1)[i]));
        }
      }
    }
    // Negative control: share (1 - share) h^2 of accelerations of some 10 lies between.
    if (is_even)
      EXPECT_GT(apart, 1e-4);
    else
      EXPECT_LT(apart, 1e-13);
  }
}

// A polynomial through the ends of Euler's steps had energies that the method does not: ten times its own error.
TEST(Simulate, EnergiesBetweenEulersStepsAreBetweenThoseAtTheirEnds) {
  Simulation run = run_of("rr", {"0", "0"}, 5, "explicit_euler", 0.02);
  run.q0 = {-0.785, 0};
  const Trajectory all = simulate_every_step(run);
  std::vector<double> times;
  for (int k = 0; k + 1 < all.size(); ++k) times.push_back((k + 0.5) * 0.02);
  const Trajectory inside = simulate(run, times);
  Workspace ws(run.chain);
  double farthest = 0, step = 0;
  for (int k = 0; k < inside.size(); ++k) {
    const double begin = energy_of(run.chain, ws, all.q_at(k), all.qd_at(k)).total(), end = energy_of(run.chain, ws, all.q_at(k + 1), all.qd_at(k + 1)).total();
    const double middle = energy_of(run.chain, ws, inside.q_at(k), inside.qd_at(k)).total();
    farthest = std::max({farthest, middle - std::max(begin, end), std::min(begin, end) - middle});
    step = std::max(step, std::abs(end - begin));
  }
  EXPECT_GT(step, 0.05);  // it is a crude method
  EXPECT_LT(farthest, 0.5 * step);
}

TEST(Simulate, GivesTheStepsOwnValuesAtTheirEnds) {
  const Simulation run = run_of("rrr", {"10", "10", "10"}, 0.5, "semi_implicit_euler");
  const Trajectory all = simulate_every_step(run);
  const Trajectory some = simulate(run, instants(0.5, 0.05));
  for (int k = 0; k < some.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(some.q_at(k)[i], all.q_at(50 * k)[i]) << k;
}

TEST(Simulate, IsTheSameRunWhateverIsSampled) {
  const std::vector<double> end{0.5};
  const Simulation run = run_of("rrr", {"10", "10", "10"}, 0.5);
  std::vector<double> many = instants(0.499, 1.0 / 420);
  many.push_back(0.5);
  EXPECT_EQ(distance(simulate(run, end), simulate(run, many)), 0);
  many.back() = 0.4999;  // negative control: another instant is another state
  EXPECT_GT(distance(simulate(run, end), simulate(run, many)), 0);
}

TEST(Simulate, StopsWithTimeStepAndJointWhereItDiverges) {
  Simulation run = run_of("pp", {"0", "-1e8 * q2"}, 10, "semi_implicit_euler");  // omega h = 10: far beyond 2
  run.q0 = {0, 1};
  const Trajectory trajectory = simulate(run, instants(10, 0.1));
  EXPECT_EQ(trajectory.status, RunStatus::diverged);
  EXPECT_LT(trajectory.end_time, 0.1);
  EXPECT_THAT(trajectory.trouble,
              HasSubstr("diverged at joint '" + run.chain.coordinate_names[1] + "' at t = "));
  EXPECT_EQ(trajectory.size(), 1);  // the start alone: nothing wild is sampled
}

TEST(Simulate, StopsWhereATorqueIsNotFinite) {
  const Simulation run = run_of("rr", {"0", "1 / (t - 0.5)"}, 1);
  const Trajectory trajectory = simulate(run, instants(1, 0.1));
  EXPECT_EQ(trajectory.status, RunStatus::torque_not_finite);
  EXPECT_THAT(trajectory.trouble, HasSubstr("torque at joint '" + run.chain.coordinate_names[1] + "'"));
  EXPECT_NEAR(trajectory.end_time, 0.5, 0.0011);
}

TEST(Simulate, StopsWhenAsked) {
  const Trajectory trajectory = simulate(run_of("rr", {"0", "0"}, 100), {}, [](double t) { return t > 5; });
  EXPECT_EQ(trajectory.status, RunStatus::interrupted);
  EXPECT_LT(trajectory.end_time, 20);
}

TEST(Simulate, EndsWhereItsEvaluationsAreSpent) {
  for (const char* method : {"rk4", "dop853", "radau5", "taylor"}) {
    Simulation run = run_of("rr", {"0", "0"}, 100);
    run.method = &find_method(method);
    if (run.method->adaptive) run.step = 0, run.options.tolerance = 1e-9;
    run.most_evaluations = 500;
    const Trajectory trajectory = simulate(run, {});
    EXPECT_EQ(trajectory.status, RunStatus::out_of_budget) << method;
    EXPECT_GE(trajectory.evaluations, 500) << method;
    // What a step takes more: radau5's iterations and Jacobians.
    EXPECT_LT(trajectory.evaluations, 700) << method;
    EXPECT_LT(trajectory.end_time, 100) << method;
  }
}

// A push from rest that lies between the stages of a long step is met by short ones.
TEST(Simulate, TakesNoStepThatIsLongerThanItMay) {
  Simulation run = run_of("rr", {"0", "0"}, 2);
  run.method = &find_method("dop853");
  run.step = 0;
  run.options.tolerance = 1e-6;
  const long free = simulate(run, {}).steps;
  run.longest_step = 0.01;
  const Trajectory trajectory = simulate_every_step(run);
  EXPECT_EQ(trajectory.status, RunStatus::finished);
  EXPECT_EQ(trajectory.t.back(), 2);
  EXPECT_GT(trajectory.steps, free);
  for (int k = 1; k < trajectory.size(); ++k)
    EXPECT_LE(trajectory.t[std::size_t(k)] - trajectory.t[std::size_t(k) - 1], 0.01 + 1e-8);
}

// A slider that coasts lets an adaptive method take the whole run for a step, and no stage of it would feel a push on the way:
// a Gaussian of 0.3 N of half a second, of the time and of the place. In closed form the first adds its impulse A sqrt(pi/w),
// the second its work: v^2 = 1 + 2 A sqrt(pi/w), of 1 kg each.
TEST(Simulate, FeelsAPushOnTheWayOfWhatCoasts) {
  const double pi = std::acos(-1.0), impulse = 0.3 * std::sqrt(pi / 50);
  for (const char* method : {"dop853", "radau5"}) {
    for (const double at : {20.0, 31.7, 40.0, 55.0}) {
      const std::string place = std::to_string(at);
      Simulation by_time = run_of("pp", {"0.3*exp(-50*(t-" + place + ")^2)", "0"}, 60, method, 0);
      by_time.chain.gravity.setZero();
      by_time.options.tolerance = 1e-9;
      by_time.qd0 = {1, 0};
      Simulation by_place = run_of("pp", {"0.3*exp(-50*(q1-" + place + ")^2)", "0"}, 60, method, 0);
      by_place.chain.gravity.setZero();
      by_place.options.tolerance = 1e-9;
      by_place.qd0 = {1, 0};
      const double end[] = {60};
      Workspace ws(by_time.chain);
      const double mass = 2 * energy_of(by_time.chain, ws, by_time.q0, by_time.qd0).kinetic;
      EXPECT_NEAR(simulate(by_time, end).qd_at(0)[0], 1 + impulse / mass, 1e-6) << method << at;
      EXPECT_NEAR(simulate(by_place, end).qd_at(0)[0], std::sqrt(1 + 2 * impulse / mass), 1e-6) << method << at;
    }
  }
  // Negative control: free motion is taken in steps as long as the method likes.
  Simulation free = run_of("pp", {"0", "0"}, 60, "dop853", 0);
  free.options.tolerance = 1e-9;
  EXPECT_LT(simulate_every_step(free).size(), 40);
  EXPECT_EQ(longest_step_of(free), 0);
}

// Two instants of a long run are not taken for one: at t = 0.35 it is where the short run is.
TEST(Simulate, SamplesOfLongRunsStandAtTheirInstants) {
  std::vector<double> short_run, long_run;
  for (const auto& [duration, q] : {std::pair(1.0, &short_run), {4000.0, &long_run}}) {
    Simulation run = run_of("rr", {"0", "0"}, duration, "dop853", 0);
    run.options.tolerance = 1e-13;
    run.most_evaluations = 20'000;  // the rest of the long one does not matter
    const Trajectory trajectory = simulate(run, instants(0.9, 1e-3));
    *q = trajectory.q;
  }
  ASSERT_EQ(short_run.size(), long_run.size());
  // The methods' own errors are 1e-12 at most; a millionth of a second of difference would be 1e-6.
  for (std::size_t i = 0; i < short_run.size(); ++i) EXPECT_NEAR(short_run[i], long_run[i], 1e-10) << i;
}

// A swing that passes a limit for a fifth of a second and comes back within a step.
TEST(Simulate, FindsALimitThatIsPassedWithinAStep) {
  Simulation run = run_of("rr", {"0", "0"}, 5, "dop853", 0);
  run.options.tolerance = 1e-6;
  run.q0 = {-1, 0};
  const Trajectory free = simulate(run, instants(5, 1e-3));
  double highest = -1;
  for (int k = 0; k < free.size(); ++k) highest = std::max(highest, free.q_at(k)[0]);
  for (const double below : {1e-2, 1e-3, 1e-4}) {
    for (auto& body : run.chain.bodies)
      if (body.joint.v_index == 0) body.joint.limit.upper = highest - below;
    const Trajectory trajectory = simulate(run, instants(5, 1.0 / 60));
    EXPECT_EQ(trajectory.limits.size(), 1u) << below;
  }
}

}  // namespace
}  // namespace chainreel
