// Runs under constraints against closed forms, other chains and their own conservation laws.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"
#include "model/read_chain.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"
#include "sim/system/constrained_chain.hpp"
#include "sim/system/constraint_plan.hpp"
#include "sim/torques_along.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using std::numbers::pi;

constexpr double kGravity = 9.81;
// m: the projection is content with 64 round-offs of places of 1 m.
constexpr double kOnConstraints = 4e-14;

Simulation exact_run(const std::string& model, const std::vector<std::string>& torque, double duration) {
  Simulation run = run_of(model, torque, duration, "dop853", 0);
  run.options.tolerance = 1e-12;
  return run;
}

// Crank and ground on one line; coupler and rocker are the legs of a right triangle.
Simulation four_bar(const std::vector<std::string>& torque, double duration) {
  Simulation run = exact_run("four_bar", torque, duration);
  run.q0 = {pi, std::atan2(3.0, 4.0) - pi, -pi / 2};
  run.constraints.list = {CloseConstraint{"rocker_end", "ground_pin"}};
  return run;
}

Simulation pen(double duration) {
  Simulation run = exact_run("rrr", {}, duration);
  run.q0 = {pi / 2, -pi / 2, -pi / 6};  // links up, level, and down to the line
  run.constraints.list = {LineConstraint{"gripper", {0, 0.5, 0}, {1, 0, 0}}};
  return run;
}

Simulation with_method(Simulation run, const std::string& method, double step) {
  run.method = &find_method(method);
  run.options = {};
  run.step = step;
  return run;
}

// The two-link chain that RRR is with its elbow fixed at 60 degrees.
Chain rrr_with_fixed_elbow(TemporaryFolder& folder) {
  std::ifstream file("models/rrr.urdf");
  std::ostringstream whole;
  whole << file.rdbuf();
  std::string text = whole.str();
  const std::string joint = "<joint name=\"joint2\" type=\"continuous\">\n    <origin xyz=\"1 0 0\"/>";
  const std::size_t at = text.find(joint);
  EXPECT_NE(at, std::string::npos);
  text.replace(
      at, joint.size(),
      "<joint name=\"joint2\" type=\"fixed\">\n    <origin xyz=\"1 0 0\" rpy=\"0 0 1.0471975511965976\"/>");
  return read_chain(folder.write("fixed.urdf", text));
}

TEST(ConstrainedRun, RodAcrossTheElbowMovesAsTheTwoLinkChainThatItThenIs) {
  TemporaryFolder folder;
  Simulation tied = exact_run("rrr", {"2 * sin(3 * t)", "5", "1 - qd3"}, 3);
  tied.q0 = {0.3, pi / 3, -0.4};
  tied.constraints.list = {DistanceConstraint{"base", "link3", std::sqrt(3.0), {}}};
  Simulation fixed = exact_run("rr", {}, 3);
  fixed.chain = rrr_with_fixed_elbow(folder);
  fixed.torque = make_torque_law(fixed.chain, {{"2 * sin(3 * t)", {}, {}}, {"1 - qd2", {}, {}}}, {});
  fixed.q0 = {0.3, -0.4};
  const std::vector<double> times = instants(3, 0.1);
  const Trajectory a = simulate(tied, times), b = simulate(fixed, times);
  ASSERT_EQ(a.size(), b.size());
  // Two runs at 1e-12 a step, some hundred steps of a motion that magnifies a few times.
  for (int k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(a.q_at(k)[0], b.q_at(k)[0], 1e-9);
    EXPECT_NEAR(a.q_at(k)[2], b.q_at(k)[1], 1e-9);
    EXPECT_NEAR(a.q_at(k)[1], pi / 3, 1e-14 * 10) << "the elbow is locked";
  }
  EXPECT_GT(std::abs(a.q_at(a.size() - 1)[0] - 0.3), 0.1) << "it moved";
}

TEST(ConstrainedRun, LockedRRSwingsWithThePeriodOfThePhysicalPendulum) {
  // Point masses of 1 kg at (1, 0) and (1.5, sqrt(3)/2): I = 1 + 3, m d = |(2.5, sqrt(3)/2)| = sqrt(7).
  const double amplitude = 2;
  const double rate2 = std::sqrt(7.0) * kGravity / 4;
  const double period = 4 / std::sqrt(rate2) * std::comp_ellint_1(std::sin(amplitude / 2));
  Simulation run = exact_run("rr", {}, period);
  const double hanging = -pi / 2 - std::atan2(std::sqrt(3.0) / 2, 2.5);
  run.q0 = {hanging + amplitude, pi / 3};
  run.constraints.list = {DistanceConstraint{"base", "gripper", std::sqrt(3.0), {}}};
  const double times[] = {period / 4, period / 2, period};
  const Trajectory trajectory = simulate(run, times);
  ASSERT_EQ(trajectory.status, RunStatus::finished);
  EXPECT_NEAR(trajectory.q_at(0)[0], hanging, 1e-10);
  EXPECT_NEAR(trajectory.q_at(1)[0], hanging - amplitude, 1e-10);
  EXPECT_NEAR(trajectory.q_at(2)[0], hanging + amplitude, 1e-10);
  EXPECT_GT(std::abs(trajectory.qd_at(0)[0]), 1) << "it moves when it hangs";
}

TEST(ConstrainedRun, PenOnAFrictionlessLineIsPushedAcrossItAndDoesNoWork) {
  const Simulation run = pen(5);
  const Trajectory trajectory = simulate(run, instants(5, 0.01));
  ASSERT_EQ(trajectory.status, RunStatus::finished);
  ASSERT_EQ(trajectory.rows, 1);
  const ConstraintSet set(run.chain, run.constraints.list);
  Workspace ws(run.chain);
  ConstrainedWorkspace cws(run.chain, set);
  double largest = 0;
  for (int k = 0; k < trajectory.size(); ++k) {
    compute_constraints(run.chain, ws, set, cws, trajectory.q_at(k), trajectory.qd_at(k));
    const Eigen::Vector3d f = contact_force(run.chain, set, cws, 0, trajectory.lambda_at(k));
    EXPECT_EQ(f.x(), 0);
    compute_kinematics(run.chain, ws, trajectory.q_at(k), trajectory.qd_at(k));
    const double power = f.dot(frame_velocity(run.chain, ws, run.chain.end_effector));
    EXPECT_NEAR(power, 0, 1e-13 * (1 + f.norm()) * 10);  // rounding of rates of some 10 /s
    largest = std::max(largest, f.norm());
  }
  EXPECT_GT(largest, 10) << "the line carries the arm";
  EXPECT_LT(trajectory.position_error, kOnConstraints);
  EXPECT_LT(trajectory.velocity_error, 1e-13);
  EXPECT_LT(audit_of(run, trajectory).largest_error, 1e-9);
}

TEST(ConstrainedRun, SamplesBetweenStepsLieOnTheConstraints) {
  const Trajectory trajectory = simulate(pen(2), instants(2, 0.00173));
  EXPECT_GT(trajectory.size(), 5 * trajectory.steps);
  EXPECT_LT(trajectory.position_error, kOnConstraints);
  Simulation loose = pen(2);
  loose.constraints.stabilize = Stabilization::none;
  EXPECT_GT(simulate(loose, instants(2, 0.00173)).position_error, 1e-13) << "negative control";
}

TEST(ConstrainedRun, ForcesPressedOnPurposeComeOutAndChangeNoMotion) {
  Simulation pressed = pen(3);
  const Trajectory without = simulate(pressed, instants(3, 0.05));
  pressed.constraints.contact_forces = {{0, {0, -5, 0}}};
  const Trajectory with = simulate(pressed, instants(3, 0.05));
  ASSERT_EQ(with.size(), without.size());
  double free_force = 0;
  for (int k = 0; k < with.size(); ++k) {
    EXPECT_NEAR(with.lambda_at(k)[0], -5, 1e-11);
    free_force = std::max(free_force, std::abs(without.lambda_at(k)[0] + 5));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(with.q_at(k)[i], without.q_at(k)[i], 1e-9);
  }
  EXPECT_GT(free_force, 5) << "negative control";
  EXPECT_LT(audit_of(pressed, with).largest_error, 1e-9) << "the added torques do no work";
}

TEST(ConstrainedRun, TorquesOfAnArmAtRestThatPressesAreJacobianTransposeForce) {
  Simulation run = exact_run("rr", {}, 0.1);
  run.chain.gravity.setZero();
  run.q0 = {0.3, 1.2};
  const double height = std::sin(0.3) + std::sin(1.5);
  run.constraints.list = {LineConstraint{"gripper", {0, height, 0}, {1, 0, 0}}};
  run.constraints.contact_forces = {{0, {0, -50, 0}}};
  const std::vector<double> tau = torques_along(run, simulate(run, instants(0.1, 0.05)));
  ASSERT_EQ(tau.size(), 6u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(tau[2 * k], -50 * (std::cos(0.3) + std::cos(1.5)), 1e-11);  // J^T f, some roundings of 50
    EXPECT_NEAR(tau[2 * k + 1], -50 * std::cos(1.5), 1e-11);
  }
}

// The multipliers and accelerations that follow from torques by Lagrange's equations of the first kind, solved densely.
Eigen::VectorXd dense_motion(const Simulation& run, const Trajectory& trajectory, int k, ConstVec tau) {
  const Eigen::Index n = run.chain.nv;
  const ConstraintSet set(run.chain, run.constraints.list);
  Workspace ws(run.chain);
  ConstrainedWorkspace cws(run.chain, set);
  const ConstVec q = trajectory.q_at(k), qd = trajectory.qd_at(k);
  compute_mass_matrix(run.chain, ws, q);
  compute_nle(run.chain, ws, q, qd);
  compute_constraints(run.chain, ws, set, cws, q, qd);
  const Eigen::Index m = set.rows();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, n + m);
  Eigen::VectorXd b(n + m);
  A.topLeftCorner(n, n) = ws.M;
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index v = 0; v < n; ++v) A(n + i, v) = A(v, n + i) = cws.Jc[std::size_t(i * n + v)];
    b(n + i) = -cws.Jcd_qd[std::size_t(i)];
  }
  for (Eigen::Index v = 0; v < n; ++v) b(v) = tau[std::size_t(v)] - ws.nle[std::size_t(v)];
  return A.fullPivLu().solve(b);
}

TEST(ConstrainedRun, TorquesThatAreShownGiveTheForceThatIsPressed) {
  Simulation run = exact_run("rrr", {"3 * sin(2 * t)", "-1", "0.5 - qd3"}, 2);
  run.q0 = {pi / 2, -pi / 2, -pi / 6};
  run.constraints.list = {LineConstraint{"gripper", {0, 0.5, 0}, {1, 0, 0}}};
  run.constraints.contact_forces = {{0, {0, -5, 0}}};
  const Trajectory trajectory = simulate(run, instants(2, 0.25));
  ASSERT_EQ(trajectory.status, RunStatus::finished);
  const std::vector<double> tau = torques_along(run, trajectory);
  std::vector<double> law(3);
  Workspace ws(run.chain);
  double pressing = 0;
  for (int k = 0; k < trajectory.size(); ++k) {
    const ConstVec here(tau.data() + 3 * k, 3);
    EXPECT_NEAR(dense_motion(run, trajectory, k, here)(3), -5, 1e-10);  // roundings of some 100 N
    run.torque->evaluate(run.chain, ws, trajectory.t[std::size_t(k)], trajectory.q_at(k), trajectory.qd_at(k), law);
    for (std::size_t i = 0; i < 3; ++i) pressing = std::max(pressing, std::abs(here[i] - law[i]));
  }
  EXPECT_GT(pressing, 5) << "the law alone would not do it";
}

TEST(ConstrainedRun, FourBarFulfilsFreudensteinsEquation) {
  // F. Freudenstein, Trans. ASME 77 (1955): K1 cos(out) - K2 cos(in) + K3 = cos(in - out), K1 = d/a,
  // K2 = d/c, K3 = (a^2 - b^2 + c^2 + d^2) / (2 a c).
  const double a = 0.4, b = 1.2, c = 0.9, d = 1.1;
  const Trajectory run = simulate(four_bar({"12 - 2 * qd1"}, 6), instants(6, 0.01));
  ASSERT_EQ(run.status, RunStatus::finished);
  for (int k = 0; k < run.size(); ++k) {
    const double in = run.q_at(k)[0], out = in + run.q_at(k)[1] + run.q_at(k)[2] + pi;
    const double K3 = (a * a - b * b + c * c + d * d) / (2 * a * c);
    EXPECT_NEAR(d / a * std::cos(out) - d / c * std::cos(in) + K3 - std::cos(in - out), 0, 1e-13);
  }
  EXPECT_GT(run.q_at(run.size() - 1)[0], pi + 4 * pi) << "the crank turned at least twice";
}

TEST(ConstrainedRun, SliderCrankFollowsItsClosedForm) {
  const double r = 0.4, l = 1;
  Simulation run = exact_run("slider_crank", {"8 - qd1"}, 5);
  run.q0 = {0, 0, 1.4};
  run.constraints.list = {CloseConstraint{"rod_end", "gripper"}};
  const Trajectory trajectory = simulate(run, instants(5, 0.01));
  ASSERT_EQ(trajectory.status, RunStatus::finished);
  for (int k = 0; k < trajectory.size(); ++k) {
    const double theta = trajectory.q_at(k)[0], rate = trajectory.qd_at(k)[0];
    const double s = std::sin(theta), c = std::cos(theta), root = std::sqrt(l * l - r * r * s * s);
    EXPECT_NEAR(trajectory.q_at(k)[2], r * c + root, 1e-14 * 10);
    EXPECT_NEAR(trajectory.qd_at(k)[2], -(r * s + r * r * s * c / root) * rate, 1e-13 * (1 + std::abs(rate)));
  }
  EXPECT_GT(trajectory.q_at(trajectory.size() - 1)[0], 2 * pi);
}

TEST(ConstrainedRun, CurveOfTwoExpressionsKeepsThePenOnIt) {
  Simulation run = exact_run("rrr", {}, 3);
  const auto circle = std::make_shared<ExpressionCurve>("1.2 + r * cos(s)", "r * sin(s)",
                                                        Parameters{{"r", 0.5}}, pi / 2, Place{});
  run.constraints.list = {CurveConstraint{"gripper", circle, pi / 2}};
  // Somewhere near the top of the circle; the start is brought onto it.
  run.q0 = {1.6, -1.0, -1.0};
  ConstrainedChain chain(run.chain, run.constraints);
  Workspace ws(run.chain);
  ASSERT_TRUE(chain.project(ws, run.q0, run.qd0).reached);
  const Trajectory trajectory = simulate(run, instants(3, 0.01));
  ASSERT_EQ(trajectory.status, RunStatus::finished) << trajectory.trouble;
  double swept = 0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (int k = 0; k < trajectory.size(); ++k) {
    compute_kinematics(run.chain, ws, trajectory.q_at(k), trajectory.qd_at(k));
    const Eigen::Vector3d x = frame_position(run.chain, ws, run.chain.end_effector);
    EXPECT_NEAR(std::hypot(x.x() - 1.2, x.y()), 0.5, 1e-14 * 10);
    if (k > 0) swept += (x - before).norm();
    before = x;
  }
  EXPECT_GT(swept, 0.5);
  EXPECT_LT(audit_of(run, trajectory).largest_error, 1e-9);
}

TEST(ConstrainedRun, TheSameLineTwiceMovesAsOneAndSharesTheForce) {
  Simulation twice = pen(3);
  const Trajectory once = simulate(twice, instants(3, 0.05));
  twice.constraints.list.push_back(twice.constraints.list.front());
  const Trajectory both = simulate(twice, instants(3, 0.05));
  ASSERT_EQ(both.status, RunStatus::finished);
  ASSERT_EQ(both.rows, 2);
  for (int k = 0; k < both.size(); ++k) {
    EXPECT_NEAR(both.lambda_at(k)[0], both.lambda_at(k)[1], 1e-10);
    EXPECT_NEAR(both.lambda_at(k)[0] + both.lambda_at(k)[1], once.lambda_at(k)[0], 1e-7);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(both.q_at(k)[i], once.q_at(k)[i], 1e-9);
  }
}

TEST(ConstrainedRun, ChangePointLinkageGoesThroughItsSingularPose) {
  Simulation run = exact_run("four_bar_parallel", {}, 4);
  run.options.tolerance = 1e-9;
  run.q0 = {pi / 3, -pi / 3, -2 * pi / 3};
  run.constraints.list = {CloseConstraint{"rocker_end", "ground_pin"}};
  const Trajectory trajectory = simulate(run, instants(4, 0.01));
  ASSERT_EQ(trajectory.status, RunStatus::finished) << trajectory.trouble;
  bool passed = false;
  for (int k = 0; k < trajectory.size(); ++k) passed |= trajectory.q_at(k)[0] < -0.5;
  EXPECT_TRUE(passed);
  EXPECT_LT(audit_of(run, trajectory).largest_error, 1e-5);
}

// A crank that turns without torque and gravity, some once a second: what each turn errs is alike.
Simulation spinning_four_bar(Stabilization stabilize, double duration, double step) {
  Simulation run = with_method(four_bar({}, duration), "rk4", step);
  ModelOptions weightless;
  weightless.gravity = Eigen::Vector3d(0, 0, 0);
  run.chain = read_chain("models/four_bar.urdf", weightless);
  run.qd0 = {6, 0, 0};
  ConstrainedChain chain(run.chain, run.constraints);
  Workspace ws(run.chain);
  chain.project(ws, run.q0, run.qd0);
  run.constraints.stabilize = stabilize;
  return run;
}

double largest_length_error(Stabilization stabilize, double duration) {
  return simulate(spinning_four_bar(stabilize, duration, 0.01), instants(duration, 0.05)).position_error;
}

// phi'' = -2 g phi' - g^2 phi from phi0 at rest is phi0 (1 + g t) e^(-g t), whatever the mechanism.
TEST(ConstrainedRun, BaumgartesErrorsDieAwayWithTheGain) {
  for (const double gain : {ConstraintPlan{}.gain, 25.0}) {
    Simulation run = pen(0.4);
    run.constraints.stabilize = Stabilization::baumgarte;
    if (gain == 25) run.constraints.gain = gain;
    run.q0[2] += 1e-3;
    const Trajectory trajectory = simulate(run, std::vector<double>{0, 0.1, 0.2, 0.4});
    const double g = gain == 25 ? 25 : 10;  // what a scene has that says nothing
    const auto phi = [&](int k) {
      const ConstVec q = trajectory.q_at(k);
      return std::sin(q[0]) + std::sin(q[0] + q[1]) + std::sin(q[0] + q[1] + q[2]) - 0.5;
    };
    for (int k = 1; k < 4; ++k) {
      const double t = trajectory.t[std::size_t(k)];
      EXPECT_NEAR(phi(k) / phi(0), (1 + g * t) * std::exp(-g * t), 1e-7) << g << " at " << t;
    }
  }
}

TEST(ConstrainedRun, LengthsDriftWithTheSquareOfTimeUnlessHeld) {
  const double loose_20 = largest_length_error(Stabilization::none, 20);
  const double loose_80 = largest_length_error(Stabilization::none, 80);
  EXPECT_NEAR(std::log(loose_80 / loose_20) / std::log(4.0), 2, 0.15) << loose_20 << " " << loose_80;
  const double damped_20 = largest_length_error(Stabilization::baumgarte, 20);
  const double damped_80 = largest_length_error(Stabilization::baumgarte, 80);
  EXPECT_LT(damped_80, 1.5 * damped_20) << "bounded";
  EXPECT_LT(damped_80, 0.01 * loose_80);
  EXPECT_LT(largest_length_error(Stabilization::project, 80), kOnConstraints);
}

TEST(ConstrainedRun, ProjectedLengthsStayToRoundOffAndTheEnergyHolds) {
  Simulation run = with_method(four_bar({}, 100), "rk4", 0.001);
  const Trajectory trajectory = simulate(run, instants(100, 0.1));
  ASSERT_EQ(trajectory.status, RunStatus::finished);
  EXPECT_LT(trajectory.position_error, kOnConstraints);
  EXPECT_LT(trajectory.velocity_error, 1e-12);
  const Audit audit = audit_of(run, trajectory);
  EXPECT_LT(audit.largest_error, 1e-6);
  EXPECT_GT(audit.largest_kinetic, 1);
}

TEST(ConstrainedRun, ProjectionCostsAdaptiveMethodsNoSteps) {
  for (const char* method : {"dop853", "radau5"}) {
    Simulation run = with_method(four_bar({"12 - 2 * qd1"}, 5), method, 0);
    run.options.tolerance = 1e-8;
    const double end[] = {5};
    const Trajectory held = simulate(run, end);
    run.constraints.stabilize = Stabilization::none;
    const Trajectory loose = simulate(run, end);
    ASSERT_EQ(held.status, RunStatus::finished);
    EXPECT_LT(double(held.steps), 1.1 * double(loose.steps)) << method;
    EXPECT_NEAR(held.q_at(0)[0], loose.q_at(0)[0], 1e-5);
    EXPECT_LT(held.position_error, kOnConstraints);
  }
}

TEST(ConstrainedRun, EveryMethodInPositionsAndRatesKeepsTheConstraints) {
  for (const char* method : {"explicit_euler", "semi_implicit_euler", "rk4", "dop853", "radau5"}) {
    const Trajectory trajectory = simulate(with_method(pen(1), method, 0.002), instants(1, 0.01));
    ASSERT_EQ(trajectory.status, RunStatus::finished) << method;
    EXPECT_LT(trajectory.position_error, kOnConstraints) << method;
    EXPECT_LT(trajectory.velocity_error, 1e-12) << method;
  }
}

TEST(ConstrainedRun, MethodsInAnotherFormNameOneThatFits) {
  for (const char* method : {"taylor", "rattle2", "gauss4", "verlet"}) {
    try {
      check_method(with_method(pen(1), method, 0.001));
      ADD_FAILURE() << method << " took constraints";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("takes no constraints: take dop853"));
    }
  }
}

TEST(ConstrainedRun, RowsThatNoAccelerationFulfilsStopTheRun) {
  // Stretched out towards a line that only this pose reaches: what turns must leave it.
  Simulation run = exact_run("rr", {}, 1);
  run.constraints.list = {PlaneConstraint{"gripper", {2, 0, 0}, {1, 0, 0}}};
  run.qd0 = {1, 0};
  const Trajectory trajectory = simulate(run, instants(1, 0.1));
  EXPECT_EQ(trajectory.status, RunStatus::inconsistent);
  EXPECT_THAT(trajectory.trouble, testing::HasSubstr("'plane gripper'"));
  EXPECT_THAT(trajectory.trouble, testing::HasSubstr("misses it by 2 at t = 0 s"));  // r w^2, 2 m and 1 /s
  run.qd0 = {0, 0};
  run.chain.gravity.setZero();
  EXPECT_NE(simulate(run, instants(1, 0.1)).status, RunStatus::inconsistent) << "negative control: at rest";
}

TEST(ConstrainedRun, TorquesCannotReadMultipliers) {
  const Chain chain = read_chain("models/rr.urdf");
  try {
    make_torque_law(chain, {{"2 * lambda1", {}, {}}, {"0", {}, {}}}, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("algebraic loop"));
  }
  EXPECT_NO_THROW(make_torque_law(chain, {{"my_lambda1", {}, {}}, {"0", {}, {}}}, {{"my_lambda1", 2}}));
}

TEST(ConstrainedRun, ProbesHoldTheMultipliersWhereTheyAreAskedFor) {
  const Chain chain = read_chain("models/rr.urdf");
  Probe probe(chain, {{"k", 3}}, 2);
  EXPECT_EQ(probe.names().back(), "lambda2");
  probe.set_multipliers(std::vector<double>{7, 8});
  EXPECT_EQ(probe.values().back(), 8);
  EXPECT_TRUE(probe.is_multiplier(int(probe.names().size()) - 2));
  EXPECT_FALSE(probe.is_multiplier(int(probe.names().size()) - 3)) << "the parameter";
}

}  // namespace
}  // namespace chainreel
