// Methods in momenta and in Cartesian points on chains: what they conserve, what they undo, what they refuse.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/energy.hpp"
#include "sim/runs.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/system/forms.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

using ::testing::HasSubstr;

struct End {
  std::vector<double> q, qd;
};

End end_of(const Simulation& run) {
  const std::vector<double> times{run.duration};
  const Trajectory trajectory = simulate(run, times);
  EXPECT_EQ(trajectory.status, RunStatus::finished) << run.method->name << ": " << trajectory.trouble;
  if (trajectory.size() == 0) return {std::vector<double>(run.q0.size(), NAN), run.qd0};
  const ConstVec q = trajectory.q_at(0), qd = trajectory.qd_at(0);
  return {{q.begin(), q.end()}, {qd.begin(), qd.end()}};
}

double distance(const End& a, const End& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.q.size(); ++i)
    largest = std::max({largest, std::abs(a.q[i] - b.q[i]), std::abs(a.qd[i] - b.qd[i])});
  return largest;
}

Simulation run_on(const Chain& chain, const std::vector<std::string>& torque, double duration,
                  const std::string& method, double step) {
  Simulation run;
  run.chain = chain;
  run.q0.assign(std::size_t(chain.nq), 0.1);
  run.qd0.assign(std::size_t(chain.nv), 0);
  std::vector<TorqueEntry> entries(std::size_t(chain.nv));
  for (std::size_t i = 0; i < torque.size(); ++i) entries[i].text = torque[i];
  run.torque = make_torque_law(run.chain, entries, {});
  run.method = &find_method(method);
  run.step = step;
  run.duration = duration;
  return run;
}

// How far RR, let go from the horizontal, is from there after 2 s and, velocities turned round, 2 s more.
double way_back(const std::string& method) {
  Simulation run = run_of("rr", {}, 2, method, 0.01);
  const End start{run.q0, run.qd0};
  End there = end_of(run);
  for (double& rate : there.qd) rate = -rate;
  run.q0 = there.q, run.qd0 = there.qd;
  return distance(end_of(run), start);
}

class Reversible : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, Reversible,
                         ::testing::Values("verlet", "implicit_midpoint", "gauss4", "gauss6", "rattle2",
                                           "rattle4", "rattle6", "rattle8"),
                         [](const auto& p) { return p.param; });

TEST_P(Reversible, GoesBackToWhereItCameFrom) {
  EXPECT_TRUE(find_method(GetParam()).reversible);
  // Round-off of 400 steps, multiplied by the motion's own sensitivity of some hundred.
  EXPECT_LT(way_back(GetParam()), 1e-12);
}

TEST(NotReversible, IsRk4) {
  EXPECT_GT(way_back("rk4"), 1e-6);
  EXPECT_FALSE(find_method("rk4").reversible);
}

// The largest error of RR's energy in [begin, end), at 10 ms.
struct Strayed {
  double early = 0, late = 0;
};
Strayed energy_error(const std::string& method, double duration, double step = 0.01) {
  const Simulation run = run_of("rr", {}, duration, method, step);
  const Trajectory trajectory = simulate_every_step(run);
  EXPECT_EQ(trajectory.status, RunStatus::finished) << method << ": " << trajectory.trouble;
  Workspace ws(run.chain);
  Strayed strayed;
  for (int k = 0; k < trajectory.size(); ++k) {
    const double E = energy_of(run.chain, ws, trajectory.q_at(k), trajectory.qd_at(k)).total();  // 0 at first
    double& largest = k < trajectory.size() / 5 ? strayed.early : strayed.late;
    largest = std::max(largest, std::abs(E));
  }
  return strayed;
}

struct Bound {
  const char* method;
  double error;  // J, what the method's order leaves at 10 ms on RR
  friend void PrintTo(const Bound& bound, std::ostream* out) { *out << bound.method; }
};
class Bounded : public ::testing::TestWithParam<Bound> {};
INSTANTIATE_TEST_SUITE_P(Methods, Bounded,
                         ::testing::Values(Bound{"symplectic_euler", 1.7}, Bound{"verlet", 0.2},
                                           Bound{"implicit_midpoint", 0.1}, Bound{"gauss4", 1e-4},
                                           Bound{"gauss6", 1e-6}, Bound{"rattle2", 0.15},
                                           Bound{"rattle4", 3e-4}, Bound{"rattle6", 5e-6},
                                           Bound{"rattle8", 2e-9}),
                         [](const auto& p) { return p.param.method; });

TEST_P(Bounded, KeepsTheEnergyForLong) {
  const Strayed strayed = energy_error(GetParam().method, 100);
  EXPECT_LT(strayed.late, GetParam().error);
  EXPECT_GT(strayed.late, 0.01 * GetParam().error);
  EXPECT_LT(strayed.late, 2 * strayed.early);  // the later four fifths of the time see no more
}

TEST(EnergyOfSemiImplicitEuler, WandersWhereThatInMomentaDoesNot) {
  // (q, qd) is not the pair in which the step is symplectic, since M depends on q; the scale is 29 J.
  EXPECT_GT(energy_error("semi_implicit_euler", 100).late, 10);
  EXPECT_LT(energy_error("symplectic_euler", 100).late, 1.7);
}

TEST(EnergyOfRk4, Falls) {
  const Strayed strayed = energy_error("rk4", 100);
  EXPECT_GT(strayed.late, 2 * strayed.early);
}

TEST(EnergyOfRattle8, IsKeptToRoundOffBySmallSteps) {
  // 10,000 steps of 17 parts; with positions in place of increments the impulses alone would leave 1e-10.
  EXPECT_LT(energy_error("rattle8", 10, 0.001).late, 1e-13 * 29);
}

// Damping in the joints, torques of time, position and velocity.
struct Forced {
  const char* method;
  double step, error, error_of_long_chain;
  friend void PrintTo(const Forced& forced, std::ostream* out) { *out << forced.method; }
};
class UnderTorques : public ::testing::TestWithParam<Forced> {};
// Errors of the method's order at these steps, twice to five times what was measured. The long chain cracks
// like a whip, which coordinates that count from link to link feel most where a step is split between them.
INSTANTIATE_TEST_SUITE_P(
    Methods, UnderTorques,
    ::testing::Values(Forced{"symplectic_euler", 5e-4, 5e-2, 8}, Forced{"verlet", 1e-3, 3e-4, 0.3},
                      Forced{"implicit_midpoint", 1e-3, 3e-4, 3e-3}, Forced{"gauss4", 5e-3, 5e-7, 3e-5},
                      Forced{"gauss6", 0.01, 5e-9, 5e-7}, Forced{"rattle2", 1e-3, 3e-4, 5e-3},
                      Forced{"rattle4", 5e-3, 1e-6, 1e-5}, Forced{"rattle6", 0.01, 1e-7, 3e-6},
                      Forced{"rattle8", 0.01, 1e-11, 1e-9}),
    [](const auto& p) { return p.param.method; });

TEST_P(UnderTorques, FollowsDop853) {
  Chain chain = test::rrr_chain();
  for (Body& body : chain.bodies) body.joint.damping = 0.4;
  chain.has_dissipation = true;
  const std::vector<std::string> torque{"3 * sin(2 * t)", "-4 * q2 - 0.5 * qd3", "xd_G"};
  const End reference = end_of(run_on(chain, torque, 1, "dop853", 0.001));
  EXPECT_LT(distance(end_of(run_on(chain, torque, 1, GetParam().method, GetParam().step)), reference),
            GetParam().error);
  // Negative control: without the dampers it is another motion.
  chain.has_dissipation = false;
  EXPECT_GT(distance(end_of(run_on(chain, torque, 1, GetParam().method, GetParam().step)), reference), 0.1);
}

// Rods whose ends share their mass, axes that point down, torques at every joint.
TEST_P(UnderTorques, FollowsDop853OnALongChain) {
  Chain chain = test::planar_serial_chain(7);
  for (std::size_t i = 2; i < chain.bodies.size(); i += 3) chain.bodies[i].joint.axis *= -1;
  test::finish(chain);
  const std::vector<std::string> torque{"2", "-0.5", "0.3", "0", "-0.1", "0.05", "0.01"};
  const double T = 0.25;
  const End reference = end_of(run_on(chain, torque, T, "dop853", 0.0005));
  const double step = 0.25 * GetParam().step;  // links of 1/7 m swing faster
  EXPECT_LT(distance(end_of(run_on(chain, torque, T, GetParam().method, step)), reference),
            GetParam().error_of_long_chain);
}

TEST(StiffSpring, IsNoTroubleForImplicitMethodsAndDivergesOthers) {
  // omega h = 1e6 sqrt(k / M) h: some 1e3 s^-1 against 10 ms.
  const std::vector<std::string> torque{"0", "-1e6 * (q2 - 0.1)"};
  for (const char* method : {"implicit_midpoint", "gauss4", "gauss6"}) {
    const End end = end_of(run_on(test::rr_chain(), torque, 2, method, 0.01));
    EXPECT_LT(std::abs(end.q[1] - 0.1), 0.01) << method;
  }
  for (const char* method : {"verlet", "symplectic_euler", "rk4"}) {
    Simulation run = run_on(test::rr_chain(), torque, 2, method, 0.01);
    run.q0[1] = 0.11;
    EXPECT_NE(simulate_every_step(run).status, RunStatus::finished) << method;
  }
}

// There momenta are rounding of forces that cancel, and have no size to be compared with.
TEST(Equilibrium, IsNoTroubleForImplicitMethods) {
  for (const char* method : {"implicit_midpoint", "gauss4", "gauss6"})
    for (const double step : {0.1, 0.01, 0.0001}) {
      Simulation run = run_on(test::rr_chain(), {"-20*(q1 + pi/2) - 3*qd1", "-3*qd2"}, 300 * step, method, step);
      run.q0 = {-std::numbers::pi / 2, 0};
      run.qd0 = {0, 0};
      const Trajectory still = simulate_every_step(run);
      EXPECT_EQ(still.status, RunStatus::finished) << method << " " << step;
      for (const double rate : still.qd) EXPECT_LT(std::fabs(rate), 1e-13);
    }
}

// Evaluations of 100 steps on a spring, by itself or with a damper.
long evaluations(const std::string& method, const std::string& torque) {
  Simulation run = run_of("pp", {"0", torque}, 1, method, 0.01);
  run.q0 = {0, 1};
  ChainSystem system(run);
  const ChainForms forms(system, *run.method);
  const auto integrator = make_integrator(*run.method, forms.forms());
  integrator->start(0, run.q0, run.qd0);
  for (int k = 1; k <= 100; ++k) EXPECT_EQ(integrator->step(0.01 * k, 0.01), StepResult::ok);
  return system.evaluations();
}

TEST(SlidingMasses, AreMovedExplicitly) {
  EXPECT_EQ(evaluations("symplectic_euler", "-100 * q2"), 101);  // one a step, one for the size of momenta
  EXPECT_EQ(evaluations("verlet", "-100 * q2"), 102);            // and one for the first half kick
  EXPECT_GT(evaluations("verlet", "-100 * q2 - qd2"), 300);
}

std::string refusal(const Chain& chain, const std::string& method) {
  try {
    check_method(run_on(chain, {}, 1, method, 0.01));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("take dop853"));
    EXPECT_THAT(error.what(), HasSubstr("the method " + method));
    return error.what();
  }
  return "";
}

TEST(Rattle, RefusesWhatIsNoRowOfPointsAndRods) {
  EXPECT_EQ(refusal(test::rr_chain(), "rattle4"), "");
  EXPECT_EQ(refusal(test::planar_serial_chain(20), "rattle4"), "");
  EXPECT_THAT(refusal(test::pp_chain(), "rattle4"), HasSubstr("slides"));
  EXPECT_THAT(refusal(test::arm_chain(1), "rattle4"), HasSubstr("does not move in one plane"));
  Chain chain = test::rrr_chain();
  chain.bodies[1].inertia.com.y() += 0.01;
  test::finish(chain);
  EXPECT_THAT(refusal(chain, "rattle2"), HasSubstr("beside the line"));
  chain = test::rrr_chain();
  chain.bodies[2].joint.X_PJ.translation().setZero();
  test::finish(chain);
  EXPECT_THAT(refusal(chain, "rattle2"), HasSubstr("coincide"));
  chain = test::rrr_chain();
  chain.bodies[2].parent = 1;
  chain.bodies[3].parent = 1;
  test::finish(chain);
  EXPECT_THAT(refusal(chain, "rattle2"), HasSubstr("branches"));
}

TEST(Rattle, TakesALastLinkOfAnyShape) {
  Chain chain = test::rrr_chain();
  chain.bodies[3].inertia.com = {0.2, 0.3, 0};
  test::finish(chain);
  const End reference = end_of(run_on(chain, {"1"}, 1, "dop853", 0.001));
  EXPECT_LT(distance(end_of(run_on(chain, {"1"}, 1, "rattle8", 0.01)), reference), 1e-9);
  chain.bodies[3].inertia.com.setZero();  // a flywheel
  test::finish(chain);
  const End wheel = end_of(run_on(chain, {"1"}, 1, "dop853", 0.001));
  EXPECT_LT(distance(end_of(run_on(chain, {"1"}, 1, "rattle8", 0.01)), wheel), 1e-9);
}

TEST(Rattle, CountsWholeTurns) {
  // Turns of 0.06 and 0.3 rad a step: angles from sines alone, and from both.
  for (const double speed : {12.0, 60.0}) {
    Simulation run = run_of("rr", {}, 3, "rattle8", 0.005);
    run.qd0 = {speed, 0};
    const End end = end_of(run);
    EXPECT_GT(end.q[0], speed);
    run.method = &find_method("dop853");
    run.step = 0.001;
    // A turn lost would be 6.28; RR's sensitivity grows with the turns.
    EXPECT_LT(distance(end, end_of(run)), speed < 20 ? 1e-8 : 1e-2) << speed;
  }
}

TEST(Rattle, SwingsASinglePendulum) {
  const Chain chain = test::planar_serial_chain(1);
  const End reference = end_of(run_on(chain, {"0.5"}, 2, "dop853", 0.001));
  EXPECT_LT(distance(end_of(run_on(chain, {"0.5"}, 2, "rattle8", 0.01)), reference), 1e-10);
  EXPECT_LT(distance(end_of(run_on(chain, {"0.5"}, 2, "rattle2", 0.001)), reference), 1e-4);
  EXPECT_GT(distance(end_of(run_on(chain, {"0.6"}, 2, "rattle8", 0.01)), reference), 1e-3);
}

}  // namespace
}  // namespace chainreel
