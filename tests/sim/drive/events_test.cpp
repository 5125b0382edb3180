// Instants of events against closed forms, and what a run does with them.

#include "sim/watch/events.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "dynamics/equation_of_motion.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"
#include "support/allocation_count.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

using ::testing::HasSubstr;

constexpr double g = 9.81;
// Twice what the root finder promises, and the round-off of instants near 1 s.
constexpr double kInstant = 3e-12;

EventEntry event(const std::string& when, EventKind kind = EventKind::mark) {
  return {when, kind, "", Crossing::either, {}};
}

void look_for(Simulation& run, const std::vector<EventEntry>& entries) {
  run.events = make_events(run.chain, entries, {});
}

// PP with its second joint thrown upward: q2 = v t - g t^2 / 2, a polynomial that dense output has exactly.
Simulation thrown(double v, double step, const std::vector<EventEntry>& entries, double duration = 1) {
  Simulation run = run_of("pp", {"0", "0"}, duration, "rk4", step);
  run.qd0[1] = v;
  look_for(run, entries);
  return run;
}

std::vector<double> times_of(const Simulation& run) {
  return simulate(run, {}).events.t;
}

TEST(Events, FreeFallPassesAHeightWhenGalileoSays) {
  const Trajectory run = simulate(thrown(0, 0.1, {event("q2 < -1")}), instants(1, 0.1));
  ASSERT_EQ(run.events.size(), 1);
  EXPECT_NEAR(run.events.t[0], std::sqrt(2 / g), kInstant);
  EXPECT_NEAR(run.events.q_at(0)[1], -1, 10 * kInstant) << "it passes there with 4.4 m/s";
  EXPECT_NEAR(run.events.qd_at(0)[1], -std::sqrt(2 * g), 10 * kInstant);
  EXPECT_EQ(run.status, RunStatus::finished) << "a mark ends nothing";
}

double agm(double a, double b) {
  for (int k = 0; k < 8; ++k) std::tie(a, b) = std::pair((a + b) / 2, std::sqrt(a * b));
  return a;
}

class Pendulum : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, Pendulum, ::testing::Values("dop853", "taylor", "radau5"),
                         [](const auto& p) { return p.param; });

TEST_P(Pendulum, PassesTheVerticalAfterQuartersOfItsPeriod) {
  Simulation run = run_of("rr", {"0"}, 6);
  run.chain = test::planar_serial_chain(1);
  run.torque = make_torque_law(run.chain, {{"0", {}, {}}}, {});
  run.q0 = {0};  // horizontal: an amplitude of 90 degrees
  run.qd0 = {0};
  run.method = &find_method(GetParam());
  run.step = 0;
  run.options.tolerance = GetParam() == "radau5" ? 1e-12 : 1e-14;
  look_for(run, {event("q1 + pi/2")});
  Workspace ws(run.chain);
  compute_mass_matrix(run.chain, ws, run.q0);
  compute_gravity_torque(run.chain, ws, run.q0);
  // T/4 = sqrt(I / (m g l)) K(sin(90/2 deg)), K(k) = pi / (2 agm(1, sqrt(1 - k^2))).
  const double quarter =
      std::sqrt(ws.M(0, 0) / ws.tau_g[0]) * std::numbers::pi / (2 * agm(1, std::cos(std::numbers::pi / 4)));
  const std::vector<double> times = times_of(run);
  ASSERT_GE(times.size(), 3u);
  for (std::size_t k = 0; k < times.size(); ++k)
    EXPECT_NEAR(times[k], double(2 * k + 1) * quarter, 1e-9) << k;
}

TEST(Events, AreOnlyAsExactAsTheMethodsDenseOutput) {
  Simulation run = run_of("rr", {"0", "0"}, 1, "explicit_euler", 0.01);
  look_for(run, {event("q1 < -0.5")});
  Simulation exact = run_of("rr", {"0", "0"}, 1, "dop853", 0);
  exact.options.tolerance = 1e-13;
  look_for(exact, {event("q1 < -0.5")});
  EXPECT_GT(std::abs(times_of(run).at(0) - times_of(exact).at(0)), 1e-4) << "negative control";
}

TEST(Events, TwoInOneStepAreBothFoundWhereTheyLieInDifferentParts) {
  // Up through 0.15 m and down again within a step of 0.5 s.
  const std::vector<double> times = times_of(thrown(2, 0.5, {event("q2 - 0.15")}));
  const double root = std::sqrt(4 - 2 * g * 0.15);
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[0], (2 - root) / g, kInstant);
  EXPECT_NEAR(times[1], (2 + root) / g, kInstant);
}

// 0.2038735 m is passed for 0.3 ms about the top, 1.4e-7 m above it, within one of 2048 parts of a step of 0.5 s.
TEST(Events, AreFoundWhereTheyComeAndGoWithinAPart) {
  const double root = std::sqrt(4 - 2 * g * 0.2038735);
  for (const double step : {0.5, 0.05, 0.002}) {
    const std::vector<double> times = times_of(thrown(2, step, {event("q2 - 0.2038735")}));
    ASSERT_EQ(times.size(), 2u) << step;
    // It passes at g times 0.3 ms, so that an error of q2 of round-off is one of 1e-13 s.
    EXPECT_NEAR(times[0], (2 - root) / g, 10 * kInstant) << step;
    EXPECT_NEAR(times[1], (2 + root) / g, 10 * kInstant) << step;
    const std::vector<double> above = times_of(thrown(2, step, {event("q2 > 0.2038735")}));
    ASSERT_EQ(above.size(), 1u) << step;
    EXPECT_NEAR(above[0], times[0], kInstant) << step;
  }
  const Trajectory stopped = simulate(thrown(2, 0.5, {event("q2 > 0.2038735", EventKind::stop)}), {});
  EXPECT_NEAR(stopped.end_time, (2 - root) / g, 10 * kInstant);
  // The top is at 0.20387360 m.
  EXPECT_TRUE(times_of(thrown(2, 0.5, {event("q2 - 0.2038738"), event("q2 > 0.2038738"), event("q2 < -4")})).empty()) << "negative control";
}

// 0.66 looks a period, of 2048 a run: some are not seen, and that is said.
TEST(Events, ThatAreFasterThanLooksAreHasty) {
  const auto run_with = [](double step, const std::string& when) {
    return simulate(thrown(0, step, {event(when)}), {});
  };
  for (const char* when : {"sin(20000 * t) - 0.1", "sin(20000 * t) > 0.9"}) {
    const Trajectory coarse = run_with(0.01, when), fine = run_with(0.0005, when);
    ASSERT_EQ(coarse.events.hasty.size(), 1u) << when;
    EXPECT_LT(coarse.events.hasty[0].t, 0.02) << when;
    EXPECT_LT(coarse.events.size(), fine.events.size()) << when;
    EXPECT_TRUE(fine.events.hasty.empty()) << "negative control: " << when;
  }
  const Trajectory fine = run_with(0.0005, "sin(20000 * t) - 0.1");
  EXPECT_EQ(fine.events.size(), 2 * 3183 + 1) << "of 3183.1 periods";
  EXPECT_TRUE(run_with(0.01, "sin(20000 * t) * 1e-9 + q2 + 1").events.hasty.empty()) << "it is the fall that is looked at";
  // As fast as the looks, or nearly, they look still or slow.
  for (const char* when : {"sin(2 * pi * 2048 * t) > 0.3", "sin(2 * pi * 2047 * t) > 0.3", "sin(2 * pi * 1024 * t) > 0.3", "sin(2 * pi * 2100 * t + q2) - 0.1", "sin(10000 * t) > 0.5"})
    EXPECT_EQ(run_with(0.01, when).events.hasty.size(), 1u) << when;
  // Negative controls: slow ones, a jump, a spike of its own, and what does not move.
  for (const char* when : {"cos(30 * t) > 0.99", "t > 0.3", "tanh(1000 * (t - 0.5)) > 0.2", "1 / ((t - 0.31)^2 + 1e-6) > 5e5", "q1 > 1e-3", "max(q2 + 1, 0) > 0.5", "abs(sin(20 * t)) > 0.5", "sign(sin(200 * t)) > 0", "sign(sin(30 * t)) - 0.5"})
    EXPECT_TRUE(run_with(0.01, when).events.hasty.empty()) << when;
}

TEST(Events, AtOneInstantComeInTheOrderOfTheScene) {
  const EventEntry mark = event("q2 < -1"), stop = event("q2 < -1", EventKind::stop);
  using ::testing::ElementsAre;
  EXPECT_THAT(simulate(thrown(0, 0.1, {mark, stop, mark}), {}).events.event, ElementsAre(0, 1))
      << "what stands behind a stop does not happen";
  EXPECT_THAT(simulate(thrown(0, 0.1, {stop, mark}), {}).events.event, ElementsAre(0));
  EXPECT_THAT(simulate(thrown(0, 0.5, {event("q2 < -1"), event("q2 < -0.9")}), {}).events.event, ElementsAre(1, 0))
      << "within one part of a step, the earlier one first";
}

TEST(Events, HaveHappenedAtTheirInstantAndNotBeforeIt) {
  for (int k = 0; k < 20; ++k) {
    const std::string mark = std::to_string(0.1 + 0.047 * k);
    const double height = std::stod(mark);
    const Trajectory run = simulate(thrown(5, 0.3, {event("q2 > " + mark), event("qd2 < " + mark)}), {});
    ASSERT_EQ(run.events.size(), 2) << mark;
    for (int i = 0; i < 2; ++i) {
      const auto at = std::size_t(i);
      if (run.events.event[at] == 0) {
        EXPECT_GT(run.events.q_at(i)[1], height) << k;
        EXPECT_LT(run.events.q_at(i)[1] - height, 5 * kInstant) << k;
      } else {
        EXPECT_LT(run.events.qd_at(i)[1], height) << k;
        EXPECT_GT(run.events.qd_at(i)[1] - height, -g * kInstant) << k;
      }
    }
  }
}

TEST(Events, HaveADirection) {
  EventEntry up = event("q2 - 0.15"), down = up;
  up.direction = Crossing::rising;
  down.direction = Crossing::falling;
  const Trajectory run =
      simulate(thrown(2, 0.1, {up, down, event("q2 > 0.15"), event("q2 <= 0.15"), event("q2 == 0.15")}), {});
  const double root = std::sqrt(4 - 2 * g * 0.15), first = (2 - root) / g, second = (2 + root) / g;
  std::vector<std::vector<double>> times(5);
  for (int k = 0; k < run.events.size(); ++k)
    times[std::size_t(run.events.event[std::size_t(k)])].push_back(run.events.t[std::size_t(k)]);
  using ::testing::DoubleNear;
  using ::testing::ElementsAre;
  EXPECT_THAT(times[0], ElementsAre(DoubleNear(first, kInstant)));
  EXPECT_THAT(times[1], ElementsAre(DoubleNear(second, kInstant)));
  EXPECT_THAT(times[2], ElementsAre(DoubleNear(first, kInstant)));
  EXPECT_THAT(times[3], ElementsAre(DoubleNear(second, kInstant)));
  EXPECT_THAT(times[4], ElementsAre(DoubleNear(first, kInstant), DoubleNear(second, kInstant)));
}

TEST(Events, AtAStepsEndHappenOnce) {
  for (const char* when : {"t - 0.5", "t >= 0.5", "t > 0.5", "t == 0.5"}) {
    const std::vector<double> times = times_of(thrown(0, 0.125, {event(when)}));
    ASSERT_EQ(times.size(), 1u) << when;
    EXPECT_NEAR(times[0], 0.5, kInstant) << when;
  }
  EXPECT_EQ(times_of(thrown(0, 0.125, {event("t >= 1")})).size(), 1u) << "at the end of the run";
  EXPECT_EQ(times_of(thrown(0, 0.125, {event("t > 1")})).size(), 0u) << "which is not behind it";
}

TEST(Events, ThatHoldAtTheBeginningWaitUntilTheyHaveBeenFalse) {
  EXPECT_EQ(times_of(thrown(0, 0.1, {event("q2 < 1")})).size(), 0u);
  EXPECT_EQ(times_of(thrown(0, 0.1, {event("q2")})).size(), 0u) << "zero at t = 0 is no crossing";
  const std::vector<double> again = times_of(thrown(2, 0.1, {event("q2 < 0.1")}));
  ASSERT_EQ(again.size(), 1u);
  EXPECT_NEAR(again[0], (2 + std::sqrt(4 - 2 * g * 0.1)) / g, kInstant);
}

TEST(Events, JumpsAreLocatedLikeCrossings) {
  const std::vector<double> times =
      times_of(thrown(2, 0.25, {event("max(t > 0.3, q1 > 5) > 0"), event("2 * (q2 > 0.15) < 1")}));
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[0], 0.3, kInstant);
  EXPECT_NEAR(times[1], (2 + std::sqrt(4 - 2 * g * 0.15)) / g, kInstant);
}

// Beside a pole an expression changes its sign and is never zero. q1 = t.
TEST(Events, PolesAreNoZeros) {
  Simulation run = run_of("pp", {"0", "0"}, 4, "rk4", 0.1);
  run.qd0[0] = 1;
  run.chain.gravity.setZero();
  run.torque = make_torque_law(run.chain, {{"0", {}, {}}, {"0", {}, {}}}, {});
  look_for(run, {event("tan(q1)"), event("1 / (q1 - 0.4)"), event("1 / (q1 - 0.4) > 1")});
  const EventHits hits = simulate(run, instants(4, 0.1)).events;
  ASSERT_EQ(hits.size(), 2);
  EXPECT_EQ(hits.event, (std::vector<int>{2, 0})) << "larger than 1 from behind the pole on";
  EXPECT_NEAR(hits.t[0], 0.4, kInstant);
  EXPECT_NEAR(hits.t[1], std::numbers::pi, 1e-9);
}

// Steps of rk4 end on the pole or near it, and a look may find it infinite: no zero, whichever.
TEST(Events, PolesAreNoZerosWhereverStepsEnd) {
  for (const auto& [method, step] : {std::pair{"rk4", 0.01}, {"rk4", 0.007}, {"rk4", 0.125}, {"dop853", 0.125}, {"radau5", 0.0625}})
    for (const char* pole : {"1 / (q1 - 0.5)", "1 / (q1 - 0.503)", "tan(pi * q1)"}) {
      Simulation run = run_of("pp", {"0", "0"}, 0.9, method, step);
      run.qd0[0] = 1;
      run.chain.gravity.setZero();
      run.torque = make_torque_law(run.chain, {{"0", {}, {}}, {"0", {}, {}}}, {});
      look_for(run, {event(pole), event("q1 - 0.7")});
      const Trajectory trajectory = simulate(run, instants(0.9, 0.1));
      ASSERT_EQ(trajectory.status, RunStatus::finished) << method << " " << step << " " << pole << ": " << trajectory.trouble;
      ASSERT_EQ(trajectory.events.size(), 1) << method << " " << step << " " << pole;
      EXPECT_NEAR(trajectory.events.t[0], 0.7, 1e-9);
    }
  // What stays infinite is told, with its own instant.
  Simulation lost = run_of("pp", {"0", "0"}, 1, "rk4", 0.01);
  lost.chain.gravity.setZero();
  lost.torque = make_torque_law(lost.chain, {{"0", {}, {}}, {"0", {}, {}}}, {});
  look_for(lost, {event("exp(2000 * t) - 2")});
  const Trajectory trajectory = simulate(lost, instants(1, 0.1));
  EXPECT_EQ(trajectory.status, RunStatus::event_not_finite);
  EXPECT_NEAR(trajectory.end_time, 0.355, 0.01) << "2000 t = 709.8";
}

// Steps as long as a method that needs no short ones takes them: looks are no farther apart for that.
TEST(Events, AreFoundInLongSteps) {
  Simulation run = run_of("pp", {"0", "0"}, 3, "explicit_euler", 0.2);
  run.qd0[0] = 1;
  run.q0[0] = -1;
  run.chain.gravity.setZero();
  run.torque = make_torque_law(run.chain, {{"0", {}, {}}, {"0", {}, {}}}, {});
  look_for(run, {event("sin(200 * q1)")});
  EXPECT_EQ(simulate(run, instants(3, 0.2)).events.size(), 191);
}

// No look at a run would find it: that is said, and never that it does not happen.
TEST(Events, ThatOnlyTouchZeroAreRefused) {
  Simulation run = run_of("pp", {"0", "0"}, 1);
  for (const char* touches : {"abs(q1 - 0.5)", "(q1 - 0.5)^2", "abs(q1 - 0.5) <= 0", "sin(q1) - 1", "sqrt(q1)", "-abs(q1) - q2^2", "abs(q1) == 0", "exp(t)"}) {
    try {
      look_for(run, {event(touches)});
      ADD_FAILURE() << touches;
    } catch (const Error& error) {
      EXPECT_THAT(std::string(error.what()), HasSubstr("is never on both sides of zero")) << touches;
    }
  }
  for (const char* passes : {"abs(q1) - 0.1", "abs(q1) < 0.1", "min(q1 > 1, t > 2) > 0", "q1^3", "q1 * abs(q1)", "max(q1, q2)", "sin(q1)", "log(q1)", "q1^2 - q2^2", "sqrt(q1) > 1", "(q1 - 0.5) * (1 + (q1 > 0))", "2 * (q1 > 0.5) - 1"})
    EXPECT_NO_THROW(look_for(run, {event(passes)})) << passes;
}

TEST(StopEvent, EndsTheRunAtItsInstantAndTheAuditHolds) {
  Simulation run = run_of("rr", {"-3 * qd1", "2 * sin(5 * t)"}, 5, "dop853", 0);
  run.options.tolerance = 1e-12;
  look_for(run, {event("q1 < -1"), event("q1 < -0.9", EventKind::stop), event("q1 < -0.8")});
  const Trajectory trajectory = simulate(run, instants(5, 0.01));
  EXPECT_EQ(trajectory.status, RunStatus::stopped);
  EXPECT_EQ(trajectory.ending_event, 1);
  ASSERT_EQ(trajectory.events.size(), 2) << "what would come later in the same step does not happen";
  EXPECT_EQ(trajectory.events.event[0], 2);
  EXPECT_EQ(trajectory.t.back(), trajectory.end_time);
  EXPECT_EQ(trajectory.events.t.back(), trajectory.end_time);
  EXPECT_NEAR(trajectory.q_at(trajectory.size() - 1)[0], -0.9, 1e-11);
  EXPECT_EQ(trajectory.size(), int(trajectory.end_time / 0.01) + 2);
  EXPECT_THAT(trajectory.trouble, HasSubstr("q1 < -0.9 at t = "));
  // What this tolerance leaves of some 10 J over a second.
  EXPECT_LT(audit_of(run, trajectory).largest_error, 1e-9);
  EXPECT_GT(std::abs(trajectory.work.back()), 0.01) << "the torques do work";
  const Trajectory steps = simulate_every_step(run);
  EXPECT_EQ(steps.t.back(), trajectory.end_time);
}

TEST(MarkEvent, LeavesTheBitsOfTheRunAlone) {
  for (const char* method : {"semi_implicit_euler", "rk4", "dop853", "taylor"}) {
    Simulation run = run_of("rrr", {"1", "0", "-0.1 * qd3"}, 2, method, 0.01);
    const Trajectory plain = simulate(run, instants(2, 0.03));
    look_for(run, {event("y_G < -1"), event("q2 - 1")});
    const Trajectory watched = simulate(run, instants(2, 0.03));
    EXPECT_EQ(plain.q, watched.q) << method;
    EXPECT_EQ(plain.qd, watched.qd) << method;
    EXPECT_GE(watched.events.size(), 1) << method;
  }
}

TEST(Events, AreLookedForWithoutAllocations) {
  Simulation run = run_of("rrr", {"1", "0", "-0.1 * qd3"}, 20, "rk4", 0.0005);
  look_for(run, {event("y_G < -100"), event("q2 - 100 * t - 100")});
  long at_first = -1, at_last = 0;
  simulate(run, {}, [&](double t) {
    if (t > 0 && at_first < 0) at_first = allocation_count();
    at_last = allocation_count();
    return false;
  });
  EXPECT_EQ(at_last - at_first, 0);
}

TEST(Events, ThatAreNoNumberEndTheRunAndSaySo) {
  const Trajectory run = simulate(thrown(2, 0.1, {event("log(0.1 - t) > 5")}), {});
  EXPECT_EQ(run.status, RunStatus::event_not_finite);
  EXPECT_THAT(run.trouble, HasSubstr("the event 'log(0.1 - t) > 5' is not a finite number at t = "));
}

std::string complaint(const EventEntry& entry) {
  try {
    const Chain chain = test::rr_chain();
    make_events(chain, {entry}, {});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Events, ThatCannotHappenAreRefused) {
  EXPECT_THAT(complaint(event("1 < 2")), HasSubstr("reads nothing that changes"));
  EXPECT_THAT(complaint(event("min(q1 > 1, q2 > 1)")), HasSubstr("write `min(q1 > 1, t > 2) > 0` for both"));
  EXPECT_THAT(complaint(event("q1 != 1")), HasSubstr("name the instant with =="));
  EventEntry twice = event("q1 > 1");
  twice.direction = Crossing::rising;
  EXPECT_THAT(complaint(twice), HasSubstr("leave out `direction`"));
  EXPECT_EQ(complaint(event("min(q1 > 1, q2 > 1) > 0")), "");  // negative control
}

}  // namespace
}  // namespace chainreel
