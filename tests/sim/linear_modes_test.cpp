#include "sim/linear_modes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "dynamics/kinematics.hpp"
#include "model/read_chain.hpp"
#include "sim/runs.hpp"
#include "support/public_robots.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

double limit(Simulation& run, const std::string& method) {
  const auto found = longest_stable_step(find_method(method), linearise_along(run));
  EXPECT_TRUE(found) << method;
  return found.value_or(NAN);
}

Simulation weightless(Simulation run) {
  run.chain.gravity.setZero();
  return run;
}

// Differences of forces of 100 N leave 1e-9.
constexpr double kTolerance = 1e-8;

TEST(Linearise, GivesTheSpringsLimits) {
  Simulation run = weightless(run_of("pp", {"0", "-100 * q2"}, 1));
  EXPECT_NEAR(limit(run, "semi_implicit_euler"), 0.2, kTolerance);
  EXPECT_NEAR(limit(run, "rk4"), 0.2 * std::sqrt(2), kTolerance);
  for (const char* method : {"implicit_midpoint", "gauss4", "gauss6", "radau5"})
    EXPECT_EQ(limit(run, method), HUGE_VAL) << method;
  EXPECT_TRUE(linearise(run).is_equilibrium);
}

TEST(Linearise, SeesDampersThatLetNothingSwing) {
  for (const auto& [d, expected] : {std::pair{30.0, 0.1064}, {60.0, 0.04779}}) {
    Simulation run = weightless(run_of("pp", {"0", "-100 * q2 - " + std::to_string(d) + " * qd2"}, 1));
    EXPECT_NEAR(limit(run, "rk4"), expected, 2e-4 * expected);
    const double fastest = d / 2 + std::sqrt(d * d / 4 - 100);
    EXPECT_NEAR(limit(run, "rk4"), 2.785293563 / fastest, kTolerance);
  }
}

TEST(Linearise, SaysWhereTheStartIsNoEquilibrium) {
  Simulation run = weightless(run_of("pp", {"0", "-100 * q2"}, 1));
  run.q0 = {0, 1};
  EXPECT_FALSE(linearise(run).is_equilibrium);
  EXPECT_NEAR(linearise(run).acceleration, 100, 1e-9);
  EXPECT_NEAR(limit(run, "rk4"), 0.2 * std::sqrt(2), kTolerance);
  run.q0 = {0, 0};
  run.qd0 = {0.5, 0};
  EXPECT_FALSE(linearise(run).is_equilibrium);
  EXPECT_EQ(linearise(run).rate, 0.5);
}

TEST(Linearise, TellsNoLimitWhereNothingSwings) {
  Simulation run = run_of("pp", {"0", "1"}, 1);
  const Linearisation start = linearise(run);
  EXPECT_THAT(start.trouble, HasSubstr("nothing swings or decays"));
  EXPECT_FALSE(longest_stable_step(find_method("rk4"), start));
}

// Where gravity pulls, feedback leads below its target, and joints without any hang: the run itself says where to.
TEST(Linearise, FeedbackIsLookedAtWhereItsRunsComeToRest) {
  struct Case {
    std::vector<double> kp, kd, q0;
    std::vector<std::string> target, torque;
  };
  const Case cases[] = {
      {{8, 4}, {5, 3}, {0, 0}, {"0", "pi/2"}, {"-8*q1 - 5*qd1", "4*(pi/2 - q2) - 3*qd2"}},
      {{200, 0}, {5, 0.1}, {0.01, -1.5}, {"0", "0"}, {"-200*q1 - 5*qd1", "-0.1*qd2"}},
  };
  for (const Case& one : cases) {
    Simulation by_control = run_of("rr", {}, 40, "dop853"), by_text = run_of("rr", one.torque, 120, "dop853");
    Control control;
    control.pd = Feedback{one.kp, one.kd, {}, {}, {}, ""};
    for (const std::string& angle : one.target) control.pd->q.push_back({angle, {}});
    by_control.torque = make_control(by_control.chain, control, {});
    by_control.q0 = by_text.q0 = one.q0;
    const Trajectory run = simulate(by_text, std::vector<double>{120});
    by_text.q0.assign(run.q_at(0).begin(), run.q_at(0).end());
    by_text.qd0 = {0, 0};
    const Linearisation held = linearise(by_control), rest = linearise(by_text);
    EXPECT_TRUE(held.about_target && held.is_equilibrium);
    ASSERT_EQ(held.rates.size(), rest.rates.size());
    // As near as the run has come to its rest, and differences tell slopes.
    for (std::size_t i = 0; i < rest.rates.size(); ++i) EXPECT_LT(std::abs(held.rates[i] - rest.rates[i]), 1e-4 * std::abs(rest.rates.back()));
  }
  // At the target itself, or with the free joint at zero, other rates would be told.
  Simulation off = run_of("rr", {"-8*q1 - 5*qd1", "4*(pi/2 - q2) - 3*qd2"}, 1);
  off.q0 = {0, 1.5707963267948966};
  EXPECT_FALSE(linearise(off).is_equilibrium);
}

// Feedback on every joint: what the theory says, runs must do, from a little beside the rest.
TEST(Linearise, PutsTheLimitOfAnArmUnderFeedbackWhereRunsDiverge) {
  Simulation run = weightless(run_of("rrr", {}, 1));
  Control control;
  control.pd = Feedback{{2000}, {100}, {}, {}, {}, ""};
  for (const char* angle : {"0.3", "-0.7", "1.1"}) control.pd->q.push_back({angle, {}});
  run.torque = make_control(run.chain, control, {});
  run.q0 = {0.3, -0.7, 1.1};
  EXPECT_TRUE(linearise(run).is_equilibrium);
  // From wherever it starts, a pose that is held is where steps must be stable; on the way there they must be, too.
  const double at_target = limit(run, "semi_implicit_euler");
  run.q0 = {2, 1, -1};
  EXPECT_TRUE(linearise(run).about_target);
  EXPECT_DOUBLE_EQ(*longest_stable_step(find_method("semi_implicit_euler"), linearise(run)), at_target);
  EXPECT_LT(limit(run, "semi_implicit_euler"), at_target);
  run.q0 = {0.3, -0.7, 1.1};
  // One that moves is none.
  Control moving = control;
  moving.pd->q[0] = {"0.3 + 0.1 * t", {}};
  Simulation follows = weightless(run_of("rrr", {}, 1));
  follows.torque = make_control(follows.chain, moving, {});
  EXPECT_FALSE(linearise(follows).about_target);
  for (const char* method : {"explicit_euler", "semi_implicit_euler", "rk4", "symplectic_euler", "verlet"}) {
    const double h = limit(run, method);
    // Far below what swings allows: dampers decide.
    for (const double factor : {0.99, 1.02}) {
      Simulation one = weightless(run_of("rrr", {}, 1, method, factor * h));
      one.torque = make_control(one.chain, control, {});
      one.q0 = {0.3 + 1e-6, -0.7, 1.1};
      one.duration = 2000 * one.step;
      const double end[] = {one.duration};
      const Trajectory trajectory = simulate(one, end);
      const bool grew = trajectory.status != RunStatus::finished ||
                        std::abs(trajectory.q_at(trajectory.size() - 1)[0] - 0.3) > 1e-3;
      EXPECT_EQ(grew, factor > 1) << method << " " << factor;
    }
  }
}

// A spring at the elbow, written as text: where the arm is stretched it is stiffer than at the start, and that is where the run goes.
// Differences of the rates from those of the same spring as feedback: rounding of slopes, a part of 1e-6.
TEST(Linearise, TellsTheShortestLimitAlongARun) {
  const auto with_spring = [](const std::string& method, double step) {
    Simulation run = run_of("rr", {"0", "-4000*q2 - 2*qd2"}, 1, method, step);
    run.q0 = {-1.5707963267948966, 0.35};
    return run;
  };
  Simulation by_text = with_spring("rk4", 1e-3), by_control = with_spring("rk4", 1e-3);
  Control control;
  control.pd = Feedback{{0, 4000}, {0, 2}, {}, {}, {}, ""};
  for (const char* angle : {"0", "0"}) control.pd->q.push_back({angle, {}});
  by_control.torque = make_control(by_control.chain, control, {});
  for (const char* method : {"rk4", "semi_implicit_euler", "verlet"}) {
    const double h = limit(by_text, method);
    EXPECT_NEAR(limit(by_control, method), h, 1e-6 * h) << method;
    EXPECT_LT(h, 0.95 * *longest_stable_step(find_method(method), linearise(by_text))) << method;  // what was told once
    EXPECT_EQ(by_text.method, &find_method("rk4"));  // its own is kept
    EXPECT_EQ(by_text.step, 1e-3);
    for (const double factor : {0.95, 1.1}) {
      Simulation one = with_spring(method, factor * h);
      const Trajectory trajectory = simulate_every_step(one);
      // It decays with 37 /s, and what grows may stay within bounds: the spring is softer where the elbow is bent.
      double last = 0;
      for (int k = trajectory.size() * 4 / 5; k < trajectory.size(); ++k) last = std::max(last, std::abs(trajectory.q_at(k)[1]));
      const bool grew = trajectory.status != RunStatus::finished || last > 0.05;
      EXPECT_EQ(grew, factor > 1) << method << " " << factor;
    }
  }
  EXPECT_EQ(by_text.most_evaluations, 0);
}

// What is stiff for a moment of a long run is looked at, too: an elastic stop, with and without an idle constraint.
TEST(Linearise, SeesAStopThatARunTouches) {
  for (const bool tied : {false, true})
    for (const double duration : {3.0, 20.0}) {
      Simulation run = weightless(run_of("pp", {"10000*max(-q1,0)", "0"}, duration));
      run.q0 = {1, 0}, run.qd0 = {-1, 0};
      if (tied) run.constraints.list.push_back(JointConstraint{run.chain.coordinate_names[1], 0});
      const double mass = run.chain.bodies[1].inertia.mass + run.chain.bodies[2].inertia.mass;
      const double omega = std::sqrt(10000 / mass);
      EXPECT_NEAR(limit(run, "semi_implicit_euler"), 2 / omega, 1e-6) << tied << " " << duration;
      EXPECT_NEAR(limit(run, "rk4"), 2 * std::sqrt(2) / omega, 1e-6) << tied << " " << duration;
    }
}

// What holds constraints down has a rate of its own, which a step has to follow: rk4 breaks down behind 2.785 / gain.
TEST(Linearise, KnowsTheRateOfBaumgarte) {
  Simulation run = run_of("rr", {"0", "0"}, 1);
  run.q0 = {-1, 0};
  run.constraints.list.push_back(JointConstraint{run.chain.coordinate_names[1], 0});
  run.constraints.stabilize = Stabilization::baumgarte;
  run.constraints.gain = 100;
  EXPECT_NEAR(limit(run, "rk4"), 2.785293563 / 100, 1e-5);
  run.constraints.stabilize = Stabilization::project;
  EXPECT_GT(limit(run, "rk4"), 0.5);
}

TEST(Linearise, FindsThePandasLimitUnderStiffFeedback) {
  const std::string robots = public_robots_folder();
  if (robots.empty()) GTEST_SKIP() << kNoRobots;
  const std::string file = robots + "/panda_description/urdf/panda.urdf";
  ModelOptions options;
  options.end_effector = "panda_hand";
  options.meshes = false;
  Simulation run;
  run.chain = read_chain(file, options);
  run.q0 = {0, -0.7854, 0, -2.3562, 0, 1.5708, 0.7854, 0.02};
  run.q0.resize(std::size_t(run.chain.nq));
  run.qd0.resize(std::size_t(run.chain.nv));
  run.duration = 0.3;
  Control control;
  control.pd = Feedback{{2000}, {100}, {}, {}, {}, ""};
  for (const double q : run.q0) control.pd->q.push_back({std::to_string(q), {}});
  run.torque = make_control(run.chain, control, {});
  // Its hand turns with some 0.006 kg m^2 on a damper of 100 N m s: 15327 /s.
  EXPECT_NEAR(limit(run, "rk4"), 1.817e-4, 1e-7);
  EXPECT_NEAR(limit(run, "semi_implicit_euler"), 1.301e-4, 1e-7);
  run.method = &find_method("rk4");
  for (const double step : {1.7e-4, 3e-4}) {
    run.step = step;
    EXPECT_EQ(simulate(run, {}).status == RunStatus::finished, step < 1.8e-4) << step;
  }
}

}  // namespace
}  // namespace chainreel
