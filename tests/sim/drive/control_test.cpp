#include "sim/drive/control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/equation_of_motion.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

Entry entry(const std::string& text) {
  return {text, {}};
}

double last(const Trajectory& trajectory, std::size_t i) {
  return trajectory.q_at(trajectory.size() - 1)[i];
}

Simulation controlled(const std::string& model, const Control& control, double duration) {
  Simulation run = run_of(model, {}, duration);
  run.torque = make_control(run.chain, control, {});
  return run;
}

TEST(GravityCompensation, HoldsTheChainWhereItIs) {
  Control control;
  control.gravity_compensation = true;
  Simulation run = controlled("rrr", control, 2);
  run.q0 = {0.3, -0.7, 1.1};
  const Trajectory trajectory = simulate(run, instants(2, 0.5));
  // tau - tau_g is round-off of 30 N m: accelerations of some 1e-14, over 2 s.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(last(trajectory, i), run.q0[i], 1e-12);
}

TEST(Pd, SettlesOnItsReferenceWhereGravityIsCompensated) {
  Control control;
  control.gravity_compensation = true;
  control.pd = Feedback{{80}, {25}, {entry("0.5"), entry("-pi / 4")}, {}, {}, ""};
  const Trajectory trajectory = simulate(controlled("rr", control, 10), instants(10, 1));
  // The slowest mode decays at about kp / kd = 3.2 /s: exp(-32).
  EXPECT_NEAR(last(trajectory, 0), 0.5, 1e-9);
  EXPECT_NEAR(last(trajectory, 1), -std::acos(-1) / 4, 1e-9);
}

TEST(Pd, OfOneJointLeavesTheOthersAlone) {
  Simulation run = run_of("pp", {"0", "0"}, 1);
  Control control;
  control.pd = Feedback{{100}, {20}, {entry("1")}, {}, {}, ""};
  std::vector<TorqueEntry> entries(2);
  entries[0].control = control;
  run.torque = make_torque_law(run.chain, entries, {});
  Workspace ws(run.chain);
  std::vector<double> q{0.25, 3}, qd{0.5, 7}, tau(2);
  run.torque->evaluate(run.chain, ws, 0, q, qd, tau);
  EXPECT_DOUBLE_EQ(tau[0], 100 * 0.75 - 20 * 0.5);
  EXPECT_EQ(tau[1], 0);
}

// What is added to a control of the whole chain, to one of a joint, and the same written out: one motion.
TEST(Control, AddsExpressionsToItsParts) {
  const std::vector<std::string> plus{"5*sin(3*t) + y_G", "-2*(t > 0.5) - max(qd2, 0)"};
  Control whole;
  whole.gravity_compensation = true;
  for (const std::string& text : plus) whole.plus.push_back(entry(text));
  std::vector<TorqueEntry> joints(2);
  for (std::size_t i = 0; i < 2; ++i) {
    joints[i].control = Control{};
    joints[i].control->gravity_compensation = true;
    joints[i].control->plus = {entry(plus[i])};
  }
  // An RR of unit links and masses at their ends: tau_g = (g (2 cos q1 + cos q12), g cos q12).
  const std::string beyond = "9.81*cos(q1 + q2) + ";
  const Simulation written = run_of("rr", {"2*9.81*cos(q1) + " + beyond + plus[0], beyond + plus[1]}, 1, "rk4", 1e-4);
  const Trajectory expected = simulate(written, instants(1, 0.1));
  for (const bool by_joint : {false, true}) {
    Simulation run = run_of("rr", {"0", "0"}, 1, "rk4", 1e-4);
    run.torque = by_joint ? make_torque_law(run.chain, joints, {}) : make_control(run.chain, whole, {});
    EXPECT_NE(run.torque->corners(), nullptr) << "max(qd2, 0)";
    EXPECT_THAT(run.torque->breaks(1), testing::Contains(testing::DoubleNear(0.5, 1e-15)));
    const Trajectory own = simulate(run, instants(1, 0.1));
    ASSERT_EQ(own.size(), expected.size());
    // The same method at 0.1 ms: what differs is the rounding of gravity, grown over a second.
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(last(own, i), last(expected, i), 1e-11) << by_joint;
  }
  joints[0].control->plus.push_back(entry("1"));
  EXPECT_THROW(make_torque_law(written.chain, joints, {}), Error);
  whole.plus.push_back(entry("1"));
  EXPECT_THROW(make_control(written.chain, whole, {}), Error);
}

// Feedback beside what is added: a spring, but not all that acts, and the series of both is their sum's.
TEST(Control, KeepsItsSpringsAndItsSeriesBesideWhatIsAdded) {
  Control control;
  control.pd = Feedback{{100}, {20}, {entry("0.5")}, {}, {}, ""};
  std::vector<TorqueEntry> joints(2);
  joints[0].control = control;
  joints[0].control->plus = {entry("2*t - 3*q2 + 1")};
  const Simulation run = run_of("rr", {"0", "0"}, 1);
  const auto law = make_torque_law(run.chain, joints, {});
  const std::vector<LinearDrive> drives = law->linear_drives(run.chain);
  ASSERT_EQ(drives.size(), 1u);
  EXPECT_FALSE(drives[0].whole);
  const auto affine = law->affine();
  ASSERT_TRUE(affine);
  EXPECT_EQ(double(affine->powers[0][0]), 51);
  EXPECT_EQ(double(affine->powers[0][1]), 2);
  EXPECT_EQ(double(affine->K[0]), -100);
  EXPECT_EQ(double(affine->K[1]), -3);
  EXPECT_EQ(double(affine->D[0]), -20);
}

TEST(Reference, HasTheSameBitsWhereAccelerationsAreNotAskedFor) {
  const Parameters parameters{{"w", 1.7}};
  const std::vector<Entry> q{entry("sin(w * t) * exp(-t / 3)"), entry("t^3 / (1 + t^2)")};
  for (const std::vector<Entry>& rates : {std::vector<Entry>{}, {entry("cos(t)"), entry("w")}}) {
    const auto reference = make_expression_reference(q, rates, {}, parameters);
    for (const double t : {0.0, 0.3, 2.0}) {
      std::vector<double> whole_q(2), whole_qd(2), qdd(2), at(2), rate(2);
      reference->evaluate(t, whole_q, whole_qd, qdd);
      reference->evaluate(t, at, rate, {});
      EXPECT_EQ(at, whole_q) << t;
      EXPECT_EQ(rate, whole_qd) << t;
    }
  }
}

TEST(ComputedTorque, FollowsAMotionGivenByItsPositionsAlone) {
  // The derivatives of the expressions are exact, so that only the method's error is left: rk4 at 1 ms.
  Control control;
  control.computed_torque =
      Feedback{{100}, {20}, {entry("sin(2 * t)"), entry("t^2 / 4"), entry("cos(t) - 1")}, {}, {}, ""};
  Simulation run = controlled("rrr", control, 2);
  run.qd0 = {2, 0, 0};
  const Trajectory trajectory = simulate(run, instants(2, 0.25));
  EXPECT_NEAR(last(trajectory, 0), std::sin(4.0), 1e-9);
  EXPECT_NEAR(last(trajectory, 1), 1, 1e-9);
  EXPECT_NEAR(last(trajectory, 2), std::cos(2.0) - 1, 1e-9);
  EXPECT_LT(audit_of(run, trajectory).largest_error, 1e-8);
}

// M11 a + nle1, a the one that its own reference asks for: nothing is said of the other joint. Where its reference says what
// both do, so does its torque.
TEST(ComputedTorque, OfOneJointAsksForNoAccelerationOfTheOthers) {
  const std::vector<double> q{0.3, 0.5}, qd{1, -2};
  Simulation run = run_of("rr", {"0", "0"}, 1);
  Workspace ws(run.chain);
  const auto first_torque = [&](const std::vector<Entry>& reference) {
    Control control;
    control.computed_torque = Feedback{{40}, {4}, reference, {}, {}, ""};
    std::vector<TorqueEntry> entries(2);
    entries[0].control = control;
    run.torque = make_torque_law(run.chain, entries, {});
    std::vector<double> tau(2);
    run.torque->evaluate(run.chain, ws, 0, q, qd, tau);
    EXPECT_EQ(tau[1], 0);
    return tau[0];
  };
  const double a = 40 * (0 - 0.3) + 4 * (1 - 1), b = 40 * (0 - 0.5) + 4 * (0 + 2);
  compute_mass_matrix(run.chain, ws, q);
  const double M11 = ws.M(0, 0), M12 = ws.M(0, 1);
  compute_nle(run.chain, ws, q, qd);
  const double nle1 = ws.nle[0];
  EXPECT_NEAR(first_torque({entry("t")}), M11 * a + nle1, 1e-12);
  EXPECT_NEAR(first_torque({entry("t"), entry("0")}), M11 * a + M12 * b + nle1, 1e-12);
}

TEST(InverseOf, BringsAMotionBack) {
  // The torques of a recorded swing, from its spline, make the chain swing the same again.
  const Simulation swing = run_of("rr", {"3", "-1"}, 1);
  const Trajectory recorded = simulate(swing, instants(1, 0.005));
  std::string text = "t,q1,q2\n";
  for (int k = 0; k < recorded.size(); ++k)
    text += std::to_string(0.005 * k) + "," + std::to_string(recorded.q_at(k)[0]) + "," +
            std::to_string(recorded.q_at(k)[1]) + "\n";
  const TemporaryFolder folder;
  Control control;
  control.inverse_of = folder.write("swing.csv", text);
  const Trajectory again = simulate(controlled("rr", control, 1), instants(1, 0.25));
  // Six decimals in the file: 5e-7 of position, amplified by the instability of the swing over a second.
  EXPECT_NEAR(last(again, 0), last(recorded, 0), 1e-3);
  EXPECT_NEAR(last(again, 1), last(recorded, 1), 1e-3);
  const Trajectory without = simulate(run_of("rr", {"0", "0"}, 1), instants(1, 0.25));
  EXPECT_GT(std::abs(last(without, 0) - last(recorded, 0)), 0.1);  // negative control
}

TEST(CsvTorque, IsLinearBetweenItsRowsAndHeldAtItsEnds) {
  const TemporaryFolder folder;
  Control control;
  control.csv = folder.write("tau.csv", "t,tau1,tau2\n1, 2, 0\n2, 6, -1\n");
  const Simulation run = controlled("pp", control, 1);
  Workspace ws(run.chain);
  std::vector<double> zero(2), tau(2);
  const auto first = [&](double t) {
    run.torque->evaluate(run.chain, ws, t, zero, zero, tau);
    return tau[0];
  };
  EXPECT_EQ(first(0), 2);
  EXPECT_EQ(first(1.25), 3);
  EXPECT_EQ(first(2), 6);
  EXPECT_EQ(first(9), 6);
}

TEST(CsvTorque, MayEndWithItsTable) {
  const TemporaryFolder folder;
  Control control;
  control.csv = folder.write("tau.csv", "t,tau1,tau2\n1, 2, 0\n2, 6, -1\n");
  control.outside = Outside::zero;
  const Simulation run = controlled("pp", control, 1);
  Workspace ws(run.chain);
  std::vector<double> zero(2), tau(2);
  for (const auto& [t, expected] : {std::pair{0.5, 0.0}, {1.0, 2.0}, {1.25, 3.0}, {2.0, 6.0}, {2.5, 0.0}}) {
    run.torque->evaluate(run.chain, ws, t, zero, zero, tau);
    EXPECT_EQ(tau[0], expected) << t;
  }
  EXPECT_THAT(run.torque->breaks(1), testing::IsSupersetOf({1.0, 2.0}));
}

TEST(CsvTorque, ThatEndsWithItsTableJumpsThereExactly) {
  // A push that begins and ends off the grid, closed form x(2) by integrating twice.
  const TemporaryFolder folder;
  Control control;
  control.csv = folder.write("push.csv", "t,tau1,tau2\n0.10037,8,0\n0.5501,8,0\n");
  control.outside = Outside::zero;
  Simulation run = controlled("pp", control, 2);
  run.chain.gravity.setZero();
  const double mass = run.chain.bodies[1].inertia.mass + run.chain.bodies[2].inertia.mass;
  const double a = 0.10037, b = 0.5501;
  // Piecewise parabolas: rk4 is exact between the jumps; 2000 roundings are left.
  EXPECT_NEAR(last(simulate(run, instants(2, 2)), 0), 8 * (b - a) * (2 - (a + b) / 2) / mass, 1e-12);
}

TEST(InverseOf, MayEndWithItsTable) {
  const TemporaryFolder folder;
  Control control;
  control.inverse_of = folder.write("q.csv", "t,q1,q2\n0,0,0\n1,0.5,0.5\n2,1,0\n");
  for (const Outside outside : {Outside::hold, Outside::zero}) {
    control.outside = outside;
    const Simulation run = controlled("rr", control, 1);
    Workspace ws(run.chain);
    std::vector<double> zero(2), tau(2);
    run.torque->evaluate(run.chain, ws, 3, zero, zero, tau);
    // Held: what carries the arm at rest at (1, 0), unit links and masses.
    EXPECT_NEAR(tau[0], outside == Outside::hold ? 3 * 9.81 * std::cos(1.0) : 0, 1e-12);
  }
}

TEST(CsvTorque, BreaksStepsAtItsKnotsSoThatRk4KeepsItsOrder) {
  // A push that begins and ends off the grid: x'' = f(t), triangular; closed form x(2) by integrating twice.
  const TemporaryFolder folder;
  Control control;
  control.csv = folder.write("push.csv", "t,tau1,tau2\n0.10037,0,0\n0.5501,8,0\n1.0003,0,0\n");
  Simulation run = controlled("pp", control, 2);
  run.chain.gravity.setZero();
  const double mass = run.chain.bodies[1].inertia.mass + run.chain.bodies[2].inertia.mass;
  const double a = 0.10037, b = 0.5501, c = 1.0003, peak = 8;
  // Triangle: impulse and its first moment.
  const double impulse = peak * (c - a) / 2;
  const double center = (a + b + c) / 3;
  const Trajectory trajectory = simulate(run, instants(2, 2));
  // Piecewise cubic positions: RK4 is exact between the knots; 2000 roundings are left.
  EXPECT_NEAR(last(trajectory, 0), impulse * (2 - center) / mass, 1e-12);
  EXPECT_LT(audit_of(run, trajectory).largest_error, 1e-11);
}

// Step lengths that suited the torques before a knot are forgotten there: from it on a run is the one that begins there.
TEST(CsvTorque, BeginsAdaptiveMethodsAnewAtItsKnots) {
  const TemporaryFolder folder;
  Control control;
  control.csv = folder.write("tau.csv", "t,tau1,tau2\n0,0,0\n0.5,6,-3\n8,6,-3\n");
  for (const char* method : {"dop853", "radau5"}) {
    const auto adaptive = [&](Simulation run) {
      run.method = &find_method(method);
      run.step = 0;
      run.options.tolerance = 1e-5;
      run.longest_step = 1.5 / kLeastWatchedSteps;  // of the whole run, also for its parts
      run.whole_duration = 1.5;
      return run;
    };
    const Trajectory whole = simulate(adaptive(controlled("rr", control, 1.5)), instants(1.5, 0.5));
    const Trajectory before = simulate(adaptive(controlled("rr", control, 0.5)), instants(0.5, 0.5));
    Simulation rest = adaptive(run_of("rr", {"6", "-3"}, 1));
    rest.q0 = {before.q_at(1)[0], before.q_at(1)[1]};
    rest.qd0 = {before.qd_at(1)[0], before.qd_at(1)[1]};
    const Trajectory behind = simulate(rest, instants(1, 0.5));
    EXPECT_EQ(whole.steps, before.steps + behind.steps) << method;
    // Times of steps are rounded elsewhere; a run that kept its step length is off by some 1e-6.
    EXPECT_NEAR(last(whole, 0), last(behind, 0), 1e-11) << method;
    EXPECT_NEAR(last(whole, 1), last(behind, 1), 1e-11) << method;
  }
}

TEST(Control, SaysWhatIsWrongWithItsTable) {
  const TemporaryFolder folder;
  const Simulation run = run_of("rr", {"0", "0"}, 1);
  const auto error = [&](const std::string& text) -> std::string {
    Control control;
    control.csv = folder.write("bad.csv", text);
    try {
      make_control(run.chain, control, {});
      return "";
    } catch (const Error& caught) {
      return caught.what();
    }
  };
  EXPECT_THAT(error("t,tau1,tau2\n0,1,2\n0,1,2\n"), testing::HasSubstr("'t' does not rise"));
  EXPECT_THAT(error("t,tau1,tau2\n0,1\n"), testing::HasSubstr("bad.csv:2: has 2 values under 3 names"));
  EXPECT_THAT(error("t,tau1,tau2\n0,1,nan\n"), testing::HasSubstr("'nan' under 'tau2'"));
  EXPECT_THAT(error("t,tau1\n0,1\n"), testing::HasSubstr("tau1 to tau2"));
  EXPECT_THAT(error("t,x\n0,1\n"), testing::HasSubstr("has no columns tau1 to tau2"));
  EXPECT_THAT(error("tau1,tau2\n0,1\n"), testing::HasSubstr("no column 't'"));
  EXPECT_THAT(error("t,tau1,tau2\n1,1,2\n# so\n0.5,1,2\n"),
              testing::HasSubstr("bad.csv:4: 't' does not rise: 0.5 stands below 1"));
  EXPECT_THAT(error("t,tau1,tau2\n0,1,inf\n"), testing::HasSubstr("bad.csv:2: 'inf' under 'tau2'"));
  EXPECT_THAT(error("t,tau1,tau2\nnan,1,0\n"), testing::HasSubstr("'nan' under 't'"));
  EXPECT_THAT(error("t,tau1,tau2\n0,1e999,0\n"), testing::HasSubstr("'1e999' under 'tau1'"));
  EXPECT_THAT(error("t,tau1,tau2,tau1\n0,1,2,3\n"), testing::HasSubstr("two columns are named 'tau1'"));
  EXPECT_THAT(error("t,tau1,tau2,tau3\n0,1,2,3\n"), testing::HasSubstr("has a column tau3, but the mechanism has 2"));
  EXPECT_THAT(error("t,tau1,tau2\n"), testing::HasSubstr("holds no row of numbers"));
  EXPECT_THAT(error(""), testing::HasSubstr("holds no row of numbers"));
  EXPECT_EQ(error("t,tau1,tau2\n0,1,2\n"), "");  // negative control
}

TEST(Control, NamesTheRowWhereAMotionOverflows) {
  const TemporaryFolder folder;
  const Chain chain = run_of("rr", {"0", "0"}, 1).chain;
  const auto error = [&](const std::string& rows) -> std::string {
    try {
      make_table_reference(folder.write("q.csv", "t,q1,q2\n" + rows), chain);
      return "";
    } catch (const Error& caught) {
      EXPECT_EQ(caught.code(), ExitCode::numerical);
      return caught.what();
    }
  };
  EXPECT_THAT(error("0,0,0\n1,0,1e308\n2,0,-1e308\n3,0,0\n"), testing::HasSubstr("q.csv:2: the motion in column q2 has no finite derivatives"));
  EXPECT_THAT(error("0,0,0\n1e-320,1,0\n"), testing::HasSubstr("column q1"));
  EXPECT_EQ(error("0,0,0\n1,0,1e100\n2,0,-1e100\n3,0,0\n"), "");  // negative control
}

TEST(Control, WantsAsManyEntriesAsFreedoms) {
  const Simulation run = run_of("rrr", {"0", "0", "0"}, 1);
  Control control;
  control.pd = Feedback{{1, 2}, {1}, {}, {}, {}, ""};
  EXPECT_THROW(make_control(run.chain, control, {}), Error);
  control.pd->kp = {1, 2, 3};
  EXPECT_NO_THROW(make_control(run.chain, control, {}));
}

}  // namespace
}  // namespace chainreel
