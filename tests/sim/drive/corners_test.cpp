// Runs under torques with corners: against closed forms, against integration by hand from corner to corner,
// and against other methods.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"
#include "sim/torques_along.hpp"
#include "support/battery.hpp"

namespace chainreel {
namespace {

using ::testing::HasSubstr;

// Adaptive: its step is 0.
Simulation with(Simulation run, const std::string& method, double tolerance) {
  run.method = &find_method(method);
  run.step = 0;
  run.options.tolerance = tolerance;
  return run;
}

// The first joint of PP slides across gravity; the second falls beside it and takes no part.
Simulation slider(const std::string& torque, double duration, const std::string& method = "rk4",
                  double step = 0.01) {
  return run_of("pp", {torque, "0"}, duration, method, step);
}

std::vector<double> q_at_end(const Simulation& run) {
  const double end[] = {run.duration};
  const Trajectory trajectory = simulate(run, end);
  EXPECT_EQ(trajectory.status, RunStatus::finished) << trajectory.trouble;
  if (trajectory.size() != 1) return {};
  std::vector<double> state(trajectory.q.begin(), trajectory.q.end());
  state.insert(state.end(), trajectory.qd.begin(), trajectory.qd.end());
  return state;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size() || a.empty()) return INFINITY;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

double mass_of_slider() {
  const Simulation run = slider("1", 1);
  return 0.5 / q_at_end(run)[0];  // x = f t^2 / (2 m)
}

class EveryMethod : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         ::testing::Values("rk4", "dop853", "radau5", "verlet", "gauss4",
                                           "implicit_midpoint"),
                         [](const auto& p) { return p.param; });

TEST_P(EveryMethod, FollowsAPushOfTwoMillisecondsExactly) {
  // Piecewise a parabola, which all of these have exactly: x(1) = v (1 - 0.507 - 0.001), v = f 0.002 / m.
  Simulation run = slider("1000*(t>0.507)*(t<0.509)", 1, GetParam(), 0.05);
  if (run.method->adaptive) run = with(std::move(run), GetParam(), 1e-9);
  const double m = mass_of_slider();
  EXPECT_NEAR(q_at_end(run)[2], 2 / m, 1e-12);
  EXPECT_NEAR(q_at_end(run)[0], 2 / m * (1 - 0.508), 1e-12);
}

TEST_P(EveryMethod, HoldsASliderThatSignFrictionHasStopped) {
  // 2 N against 1 m/s: it stops at t = m / 2 after m / 4, and rests there.
  Simulation run = slider("-2*((qd1>0)-(qd1<0))", 3, GetParam(), 0.05);
  if (run.method->adaptive) run = with(std::move(run), GetParam(), 1e-9);
  run.qd0[0] = 1;
  const double m = mass_of_slider();
  EXPECT_NEAR(q_at_end(run)[0], m / 4, 1e-11);
  EXPECT_NEAR(q_at_end(run)[2], 0, 1e-11);
  const Trajectory trajectory = simulate(run, instants(3, 0.1));
  ASSERT_EQ(trajectory.holds.size(), 1u);
  EXPECT_NEAR(trajectory.holds[0].begin, m / 2, 1e-11);
  EXPECT_LT(trajectory.steps, 1000);
}

TEST(Corners, FrictionLetsGoWhereThePushOutgrowsIt) {
  // A push of t N against 2 N: at rest until 2 s, then x = (t - 2)^3 / (6 m).
  for (const char* method : {"dop853", "radau5", "rk4"}) {
    Simulation run = slider("t - 2*((qd1>0)-(qd1<0))", 4, method, 0.05);
    if (run.method->adaptive) run = with(std::move(run), method, 1e-10);
    const double m = mass_of_slider();
    EXPECT_NEAR(q_at_end(run)[0], 8 / (6 * m), 1e-10) << method;
    EXPECT_NEAR(q_at_end(run)[2], 2 / m, 1e-10) << method;
  }
}

// To the last bit, so that nothing happens there: rounding made rates of both signs, events by the dozen and limits passed
// by 1e-34 m.
TEST(Corners, WhatIsHeldFromTheStartDoesNotMoveAtAll) {
  for (const char* method : {"dop853", "radau5", "rk4"}) {
    Simulation run = slider("3*sin(t) - 2*((qd1>0)-(qd1<0))", 5, method, 0.05);
    if (run.method->adaptive) run = with(std::move(run), method, 1e-10);
    run.events = make_events(run.chain, {{"qd1", EventKind::stop, "turns back", Crossing::either, {}}}, {});
    const Trajectory trajectory = simulate(run, instants(5, 0.1));
    for (int k = 0; trajectory.t[std::size_t(k)] < std::asin(2.0 / 3) - 0.06; ++k) {
      EXPECT_EQ(trajectory.q_at(k)[0], 0) << method;
      EXPECT_EQ(trajectory.qd_at(k)[0], 0) << method;
    }
    // It sets out where 3 sin t = 2 and comes to rest where the impulse since then is zero:
    // 3 (cos t0 - cos t) = 2 (t - t0), t = 3.32312.
    ASSERT_EQ(trajectory.events.size(), 1) << method;
    EXPECT_NEAR(trajectory.events.t[0], 3.32312, 6e-6) << method;
  }
}

TEST(Corners, FrictionStopsASliderUnderMethodsOfFirstOrderToo) {
  for (const char* method : {"symplectic_euler", "explicit_euler", "semi_implicit_euler"}) {
    Simulation run = slider("-2*((qd1>0)-(qd1<0))", 3, method, 1e-3);
    run.qd0[0] = 1;
    EXPECT_NEAR(q_at_end(run)[0], mass_of_slider() / 4, 2e-3) << method;
    EXPECT_NEAR(q_at_end(run)[2], 0, 1e-11) << method;
  }
}

TEST(Corners, ASurfaceOfPositionAndRateIsSlidDownExactly) {
  // On q + qd = 0 the motion is q' = -q, whatever pushes it there.
  Simulation run = with(slider("-10*((q1+qd1>0)-(q1+qd1<0))", 5), "dop853", 1e-10);
  run.q0[0] = 1;
  const Trajectory trajectory = simulate(run, instants(5, 1));
  ASSERT_EQ(trajectory.size(), 6);
  for (int k = 1; k < 6; ++k) EXPECT_NEAR(trajectory.q_at(k)[0] + trajectory.qd_at(k)[0], 0, 1e-10);
  EXPECT_NEAR(trajectory.q_at(5)[0], trajectory.q_at(4)[0] * std::exp(-1), 1e-9);
}

TEST(Corners, ThatAreCrossedAtEverShorterIntervalsEndTheRunWithTheirExpression) {
  for (const char* method : {"dop853", "radau5", "verlet"}) {
    Simulation run = slider("-5*((q1>0)-(q1<0)) - ((qd1>0)-(qd1<0))", 10, method, 1e-3);
    if (run.method->adaptive) run = with(std::move(run), method, 1e-10);
    run.q0[0] = 0.3;
    const Trajectory trajectory = simulate(run, instants(10, 1));
    EXPECT_EQ(trajectory.status, RunStatus::chattering) << method;
    EXPECT_THAT(trajectory.trouble, HasSubstr("-5*((q1>0)-(q1<0))"));
    // Inwards with 4 N, outwards against 6 N; amplitudes shrink by 4 / 6: they come to an end where the
    // series does.
    double end = 0, x = 0.3;
    const double m = mass_of_slider();
    for (int k = 0; k < 200; ++k, x *= 4.0 / 6)
      end += std::sqrt(2 * x * m / 4) + std::sqrt(2 * x * 4 / 6 * m / 6);
    EXPECT_NEAR(trajectory.end_time, end, 0.01);
  }
}

TEST(Corners, WhatTheTextHoldsAtRestStaysThere) {
  for (const char* torque : {"5*(q1>0)", "2*((qd1>0)-(qd1<0))", "5*(q1==0)", "1-2*((qd1>0)-(qd1<0))"})
    EXPECT_EQ(q_at_end(with(slider(torque, 2), "dop853", 1e-9))[0], 0) << torque;
  const double m = mass_of_slider();
  EXPECT_NEAR(q_at_end(with(slider("5*(q2<=0)", 2), "dop853", 1e-9))[0], 10 / m, 1e-9);
}

TEST(Corners, FrictionHoldsFromTheStartBesideACornerThatNothingDrives) {
  // abs(qd1) stands at zero too, and nothing holds it there but that nothing pushes.
  Simulation run = run_of("pp", {"-0.5*abs(qd1)*qd1", "9.81 + 2*t - ((qd2>0)-(qd2<0))"}, 1, "rk4", 0.01);
  const Trajectory trajectory = simulate(run, instants(1, 1));
  EXPECT_EQ(trajectory.status, RunStatus::finished) << trajectory.trouble;
  ASSERT_EQ(trajectory.holds.size(), 1u);
  EXPECT_NEAR(trajectory.holds[0].end, 0.5, 1e-10);
  EXPECT_NEAR(trajectory.q_at(1)[1], 2 * 0.125 / 6, 1e-10);
}

TEST(Corners, TheTorqueThatIsShownOfAHeldJointIsWhatHoldsIt) {
  // 1 N pushes and friction answers, though the text knows 2 N, none and -2 N only.
  const Simulation run = with(slider("1*t - 2*((qd1>0)-(qd1<0))", 3), "dop853", 1e-10);
  const std::vector<double> tau = torques_along(run, simulate(run, instants(3, 0.5)));
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(tau[std::size_t(2 * k)], 0, 1e-12) << "at rest nothing is left";
  EXPECT_NEAR(tau[2 * 6], 1, 1e-12) << "at 3 s it slides";
}

TEST(Corners, OfAReferenceEndStepsToo) {
  // The gripper's goal turns back at 1 s, with a jump of its rate.
  Simulation run = run_of("pp", {}, 2);
  Control control;
  control.pd = Feedback{{50}, {10}, {{"abs(t-1)", {}}, {"0", {}}}, {}, {}, ""};
  run.torque = make_control(run.chain, control, {});
  EXPECT_THAT(run.torque->breaks(2), ::testing::ElementsAre(1));
  const std::vector<double> fine = q_at_end(with(std::move(run), "dop853", 1e-12));
  Simulation coarse = run_of("pp", {}, 2, "rk4", 0.01);
  coarse.torque = make_control(coarse.chain, control, {});
  coarse.step = 0.03;  // 1 s is no multiple
  EXPECT_LT(apart(q_at_end(coarse), fine), 2e-4);
}

// By another way: to each instant by itself, and on from there under the other torque.
std::vector<double> by_hand(const std::vector<double>& q0, const std::vector<double>& instants,
                            const std::vector<std::string>& torques, double end) {
  std::vector<double> q = q0, qd(2);
  double now = 0;
  for (std::size_t k = 0; k < torques.size(); ++k) {
    const double next = k < instants.size() ? instants[k] : end;
    Simulation run = with(run_of("rr", {torques[k], "0"}, next - now), "dop853", 1e-12);
    run.q0 = q;
    run.qd0 = qd;
    const std::vector<double> state = q_at_end(run);
    q.assign(state.begin(), state.begin() + 2);
    qd.assign(state.begin() + 2, state.end());
    now = next;
  }
  q.insert(q.end(), qd.begin(), qd.end());
  return q;
}

TEST(Corners, PushesOfAnArmAreThoseOfIntegrationFromCornerToCorner) {
  struct Case {
    std::vector<double> q0;
    std::string torque;
    std::vector<double> instants;
    std::vector<std::string> torques;
  };
  const double down = -1.5707963267948966;
  for (const Case& c : {Case{{-1, 0.5}, "60*(t>1.507)*(t<1.557)", {1.507, 1.557}, {"0", "60", "0"}},
                        Case{{-1, 0.5}, "60*(t>1.507)", {1.507}, {"0", "60"}},
                        Case{{down, 0}, "60*(t>1)*(t<1.05)", {1, 1.05}, {"0", "60", "0"}},
                        Case{{down, 0}, "60*(t>1)*(t<1.002)", {1, 1.002}, {"0", "60", "0"}}}) {
    Simulation run = run_of("rr", {c.torque, "0"}, 4);
    run.q0 = c.q0;
    EXPECT_LT(apart(q_at_end(with(std::move(run), "dop853", 1e-10)), by_hand(c.q0, c.instants, c.torques, 4)),
              1e-7)
        << c.torque;
  }
}

TEST(Corners, ThirtyRandomScenesHaveOneMotionUnderThreeMethods) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const test::CorneredScene scene = test::cornered_scene(seed);
    const auto end_under = [&](const char* method, double tolerance, double beside) {
      Simulation run = run_of(scene.model, scene.torque, scene.duration, method, 1e-3);
      run.q0 = scene.q0;
      run.qd0 = scene.qd0;
      run.q0[0] += beside;
      return q_at_end(tolerance > 0 ? with(std::move(run), method, tolerance) : std::move(run));
    };
    const std::vector<double> one = end_under("dop853", 1e-10, 0);
    const double amplification = std::max(1.0, apart(one, end_under("dop853", 1e-10, 1e-7)) / 1e-7);
    // Three bodies thrown about magnify errors of the way up to 1e8 times.
    EXPECT_LT(apart(one, end_under("radau5", 1e-9, 0)), 1e-6 * amplification) << seed << ": " << scene.text();
    EXPECT_LT(apart(one, end_under("rk4", 0, 0)), 1e-4 * amplification) << seed << ": " << scene.text();
  }
}

Simulation arm_with_dry_friction() {
  Simulation run = run_of("rr", {"-30*((qd1>0)-(qd1<0))", "-30*((qd2>0)-(qd2<0))"}, 4);
  run.q0 = {-1, 0.5};
  run.qd0 = {2, -3};
  return run;
}

TEST(Corners, DryFrictionOfBothJointsHoldsAnArmInTheEnd) {
  const std::vector<double> one = q_at_end(with(arm_with_dry_friction(), "dop853", 1e-11));
  const std::vector<double> other = q_at_end(with(arm_with_dry_friction(), "radau5", 1e-11));
  EXPECT_LT(apart(one, other), 1e-8);
  EXPECT_NEAR(one[2], 0, 1e-10);
  EXPECT_NEAR(one[3], 0, 1e-10);
}

TEST_P(EveryMethod, FeelsASmoothPulseOfTenMicroseconds) {
  // Its momentum is sqrt(pi), wherever steps would end without it.
  Simulation run = slider("1e5*exp(-((t-1.2345)/1e-5)^2) + 0*qd1", 2, GetParam(), 0.05);
  if (run.method->adaptive) run = with(std::move(run), GetParam(), 1e-9);
  const double m = mass_of_slider(), v = std::sqrt(std::numbers::pi) / m;
  // Methods of fixed steps take some thirty through it.
  EXPECT_NEAR(q_at_end(run)[2], v, run.method->adaptive ? 1e-7 : 2e-3);
  EXPECT_NEAR(q_at_end(run)[0], v * (2 - 1.2345), run.method->adaptive ? 1e-6 : 2e-3);
}

TEST_P(EveryMethod, BouncesOffASpringWhoseForceIsAPowerOfItsDepth) {
  // Energy is kept: it leaves as fast as it came. Where it lifts off the force has no branch beyond zero.
  for (const char* torque : {"300*max(0,-q1)^1.5", "30*sqrt(max(0,-q1))", "300*max(0,-q1)^1.5*(q1<0)"}) {
    Simulation run = slider(torque, 1.5, GetParam(), 1e-3);
    if (run.method->adaptive) run = with(std::move(run), GetParam(), 1e-9);
    run.q0[0] = 0.1;
    run.qd0[0] = -1;
    // The bend costs methods of fixed steps their order, and roots more than powers.
    EXPECT_NEAR(q_at_end(run)[2], 1, run.method->adaptive ? 1e-6 : 1e-3) << torque;
  }
}

// The same torque as a text without corners inside others, or with others.
struct Twins {
  std::string nested, plain;
};

double apart_at_end(const Twins& twins, const std::string& method, double tolerance, double q0, double qd0) {
  const auto end = [&](const std::string& torque) {
    Simulation run = slider(torque, 2, method, 2e-3);
    if (tolerance > 0) run = with(std::move(run), method, tolerance);
    run.q0[0] = q0;
    run.qd0[0] = qd0;
    return q_at_end(run);
  };
  return apart(end(twins.nested), end(twins.plain));
}

const std::string sign_friction = "((qd1>0)-(qd1<0))";

TEST(Corners, FrictionThatIsCutOffIsThatWhichItIsCutTo) {
  const std::string f = sign_friction;
  for (const Twins& twins : {Twins{"max(-6,min(6,-30*" + f + "))", "-6*" + f},
                             {"5*sin(3*t) + max(-2,min(2,-9*" + f + " + sin(t)))", "5*sin(3*t) - 2*" + f},
                             {"5*sin(3*t) - 2*" + f + "^3", "5*sin(3*t) - 2*" + f},
                             {"5*sin(3*t) - 3*" + f + "/(1+0.5*" + f + "*" + f + ")", "5*sin(3*t) - 2*" + f},
                             {"5*sin(3*t) - max(2*(qd1>0),0) + abs(2*(qd1<0))", "5*sin(3*t) - 2*" + f},
                             {"5*sin(3*t) - min(2,3*abs(" + f + "))*" + f, "5*sin(3*t) - 2*" + f}})
    for (const char* method : {"dop853", "radau5", "rk4"})
      EXPECT_LT(apart_at_end(twins, method, method[0] == 'r' && method[1] == 'k' ? 0 : 1e-11, 0.3, 1), 1e-8)
          << method << ": " << twins.nested;
}

TEST(Corners, PolesThatAreCutOffAreJumpsOrNothing) {
  for (const Twins& twins : {Twins{"min(5,max(-5,1/(q1-0.5)))", "((q1>0.5)-(q1<0.5))/max(0.2,abs(q1-0.5))"},
                             {"max(-5,min(5,1/(q1-0.5)))", "((q1>0.5)-(q1<0.5))/max(0.2,abs(q1-0.5))"},
                             {"min(4,0.5/abs(q1-0.5))", "0.5/max(0.125,abs(q1-0.5))"},
                             {"max(-4,min(4,-0.5/abs(q1-0.5)))", "-0.5/max(0.125,abs(q1-0.5))"},
                             {"min(4,abs(0.5/(q1-0.5)))", "0.5/max(0.125,abs(q1-0.5))"},
                             {"min(3,max(-3,1/(t-0.3)^3))",
                              "(abs(t-0.3)>3^(-1/3))*0 + 3*(t>0.3)*(t<=0.3+3^(-1/3)) - "
                              "3*(t<0.3) + (t>0.3+3^(-1/3))/max(0.1,t-0.3)^3"}})
    for (const char* method : {"dop853", "radau5", "rk4"})
      EXPECT_LT(apart_at_end(twins, method, method[0] == 'r' && method[1] == 'k' ? 0 : 1e-11, 0, 4), 1e-7)
          << method << ": " << twins.nested;
}

TEST(Corners, FrictionBeyondTheEffortOfItsJointHoldsAsMuchAsTheJointCan) {
  const auto end = [](const std::string& torque) {
    Simulation run = with(slider(torque, 3), "dop853", 1e-10);
    run.chain.bodies[1].joint.limit.effort = 2;
    run.limit = LimitPolicy::clamp;
    run.qd0[0] = 1;
    return q_at_end(run);
  };
  EXPECT_LT(apart(end("-30*((qd1>0)-(qd1<0))"), end("-2*((qd1>0)-(qd1<0))")), 1e-10);
  EXPECT_NEAR(end("-30*((qd1>0)-(qd1<0))")[2], 0, 1e-11);
}

TEST(Corners, AThinObstacleIsNotSteppedOver) {
  // A disc of 1 mm beside the way: its distance dips sharply between the looks at a step.
  const auto end = [](const char* place, const std::string& method, double tolerance) {
    const std::string at = place;
    Simulation run = run_of("pp", {"0", "9.81 + 3e5*max(0, 0.001 - sqrt((q1-" + at + ")^2 + (q2+0.0002)^2))"},
                            1, method, 1e-4);
    if (tolerance > 0) run = with(std::move(run), method, tolerance);
    run.q0[0] = -1;
    run.qd0[0] = 3;
    return q_at_end(run);
  };
  // At the end of a step, too: 0.5 s and 1 s are such.
  for (const char* place : {"0.31", "-0.998", "0.5004", "1.73", "-0.77123"}) {
    const std::vector<double> fine = end(place, "rk4", 0);  // off by some 1e-5, and the way goes on by metres
    EXPECT_GT(std::abs(fine[1]), 5e-3) << place;
    for (const char* method : {"dop853", "radau5"})
      EXPECT_LT(apart(end(place, method, 1e-9), fine), 5e-5) << method << " " << place;
  }
}

// A bend where the motion comes to rest: the state swings about it by what the method is off, and no torque jumps.
TEST(Corners, ThatOnlyBendDoNotStopWhatComesToRestAtThem) {
  for (const auto& [method, step, tolerance] : {std::tuple{"radau5", 0.0, 1e-4}, {"radau5", 0.0, 1e-5}, {"rk4", 0.02, 0.0}}) {
    Simulation run = run_of("rr", {"-40*(q1+1.2) - 20*qd1 - 0.5*max(qd1,0) + 19.62*cos(q1) + 9.81*cos(q1+q2)", "-40*(q2-0.5) - 8*qd2 + 9.81*cos(q1+q2)"},
                            40, method, step > 0 ? step : 0.001);
    if (tolerance > 0) apply({&find_method(method), {tolerance, 0}, 0}, run);
    const Trajectory trajectory = simulate(run, instants(40, 10));
    EXPECT_EQ(trajectory.status, RunStatus::finished) << method << " " << tolerance << ": " << trajectory.trouble;
  }
}

}  // namespace
}  // namespace chainreel
