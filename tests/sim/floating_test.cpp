// Adaptive and fixed steps of a chain with quaternions among its coordinates.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/kinematics.hpp"
#include "dynamics/momentum_form.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

// A tree of three bodies that floats and tumbles.
Simulation tumbling(const std::string& method, double step, double tolerance) {
  Simulation run;
  run.chain = random_tree(11, {.bodies = 3, .floating_base = true, .prismatic = 0});
  run.q0 = zero_configuration(run.chain);
  run.qd0.assign(std::size_t(run.chain.nv), 0.7);
  run.torque = make_torque_law(run.chain, std::vector<TorqueEntry>(std::size_t(run.chain.nv)), {});
  run.method = &find_method(method);
  run.options.tolerance = tolerance;
  run.step = step;
  run.duration = 1;
  return run;
}

double distance(const Trajectory& a, const Trajectory& b) {
  double largest = 0;
  for (int k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < std::size_t(a.nq); ++i)
      largest = std::max(largest, std::abs(a.q_at(k)[i] - b.q_at(k)[i]));
  return largest;
}

TEST(FloatingBase, MovesWithDop853AsWithShortSteps) {
  const std::vector<double> times = instants(1, 0.0625);
  const Trajectory truth = simulate(tumbling("rk4", 5e-4, 0), times);
  const Trajectory one = simulate(tumbling("dop853", 0, 1e-10), times);
  ASSERT_EQ(one.size(), int(times.size()));
  // The tolerance of some ten steps; that of rk4, h^4 times rates of some 3 /s to the fifth, is no larger.
  EXPECT_LT(distance(one, truth), 1e-9);
  EXPECT_GT(distance(simulate(tumbling("dop853", 0, 1e-3), times), truth), 1e-9);  // negative control
}

TEST(FloatingBase, IsInterpolatedByDop853WithItsDenseOrder) {
  const auto error = [](int steps) {
    std::vector<double> times;
    for (int k = 0; k < steps; ++k) times.push_back((k + 1.0 / 3) / steps);
    return distance(simulate(tumbling("dop853", 1.0 / steps, 0), times),
                    simulate(tumbling("dop853", 0, 1e-14), times));
  };
  // A local error of order 7 + 1; the next term is a tenth of it.
  EXPECT_NEAR(std::log2(error(6) / error(12)), 8, 0.3);
}

struct Ordered {
  const char* method;
  std::vector<int> steps;
  double window = 0.15;
  friend void PrintTo(const Ordered& row, std::ostream* out) { *out << row.method; }
};
class PlainMethod : public ::testing::TestWithParam<Ordered> {};
// Numbers of steps in 1 s at which the first term of the error leads and rounding is far.
INSTANTIATE_TEST_SUITE_P(Methods, PlainMethod,
                         ::testing::Values(Ordered{"symplectic_euler", {4000, 8000}}, Ordered{"verlet", {200, 800}},
                                           Ordered{"implicit_midpoint", {200, 800}}, Ordered{"gauss4", {40, 160}},
                                           Ordered{"gauss6", {24, 48}, 0.3}, Ordered{"radau5", {40, 160}}),
                         [](const auto& p) { return p.param.method; });

// The tumbling tree with torques of state and time and a damper behind its floating joint.
Simulation driven(const std::string& method, double step, double tolerance = 0) {
  Simulation run = tumbling(method, step, tolerance);
  for (Body& body : run.chain.bodies) body.joint.damping = body.joint.kind == JointKind::revolute ? 0.1 : 0;
  run.chain.has_dissipation = true;
  std::vector<TorqueEntry> entries(std::size_t(run.chain.nv));
  entries[1].text = "0.5*sin(3*t)", entries[4].text = "0.2", entries[6].text = "-2*q8 - 0.3*qd7";
  run.torque = make_torque_law(run.chain, entries, {});
  return run;
}

TEST_P(PlainMethod, KeepsItsOrderWithQuaternions) {
  static const std::vector<double> times = instants(1, 0.5);
  static const Trajectory truth = simulate(driven("dop853", 0, 1e-13), times);
  const std::vector<int>& steps = GetParam().steps;
  const double first = distance(simulate(driven(GetParam().method, 1.0 / steps[0]), times), truth);
  const double last = distance(simulate(driven(GetParam().method, 1.0 / steps[1]), times), truth);
  EXPECT_LT(last, 1e-3);
  EXPECT_NEAR(std::log2(first / last) / std::log2(steps[1] / steps[0]), find_method(GetParam().method).order,
              GetParam().window);
}

TEST(FloatingBase, IsInterpolatedInItsChartWithTheDenseOrder) {
  // Where the steps' own errors are small beside those of the polynomial between them.
  const auto error = [](const std::string& method, int steps) {
    std::vector<double> times;
    for (int k = 0; k < steps; ++k) times.push_back((k + 1.0 / 3) / steps);
    return distance(simulate(tumbling(method, 1.0 / steps, 0), times),
                    simulate(tumbling("dop853", 0, 1e-13), times));
  };
  EXPECT_NEAR(std::log2(error("gauss6", 10) / error("gauss6", 20)), 6, 0.4);  // quintic: h^6
  EXPECT_NEAR(std::log2(error("radau5", 10) / error("radau5", 20)), 5, 0.4);  // of the stages: h^5
}

TEST(FloatingBase, MovesWithRadau5WithinItsTolerance) {
  const std::vector<double> times = instants(1, 0.0625);
  const Trajectory truth = simulate(driven("dop853", 0, 1e-13), times);
  EXPECT_LT(distance(simulate(driven("radau5", 0, 1e-9), times), truth), 1e-7);
  EXPECT_LT(distance(simulate(driven("radau5", 0, 1e-6), times), truth), 1e-4);
  EXPECT_GT(distance(simulate(driven("radau5", 0, 1e-3), times), truth), 1e-9);  // negative control
}

// A body alone, without weight, about its centre of mass: principal moments I.
Simulation free_body(const Eigen::Vector3d& I, const Eigen::Vector3d& w, const std::string& method, double step,
                     double duration) {
  Simulation run;
  run.chain = random_tree(1, {.bodies = 1, .floating_base = true});
  run.chain.gravity.setZero();
  Body& body = run.chain.bodies[1];
  body.inertia = {2, Eigen::Vector3d::Zero(), I.asDiagonal()};
  body.joint.X_PJ.setIdentity();
  finish(run.chain);
  run.q0 = zero_configuration(run.chain);
  run.qd0 = {0.3, -0.2, 0.1, w.x(), w.y(), w.z()};
  run.torque = make_torque_law(run.chain, std::vector<TorqueEntry>(6), {});
  run.method = &find_method(method);
  run.step = step;
  run.duration = duration;
  return run;
}

Eigen::Quaterniond turn_of(ConstVec q) { return {q[6], q[3], q[4], q[5]}; }

// The angular momentum in the world.
Eigen::Vector3d momentum_of(const Eigen::Vector3d& I, ConstVec q, ConstVec qd) {
  return turn_of(q) * Eigen::Vector3d(I.x() * qd[3], I.y() * qd[4], I.z() * qd[5]);
}

const char* const kPlainMethods[] = {"symplectic_euler", "verlet", "implicit_midpoint", "gauss4", "gauss6", "radau5"};

TEST(SymmetricTop, PrecessesAsItsClosedFormSays) {
  // I1 = I2: w turns in the body by (1 - I3 / I1) w3, the body about the constant L by L / I1.
  const Eigen::Vector3d I(0.5, 0.5, 0.8), w(1, 0.4, 6);
  const double T = 3, rate = (I.z() / I.x() - 1) * w.z();
  const Eigen::Vector3d L = I.cwiseProduct(w);
  const Eigen::Quaterniond turn = Eigen::Quaterniond(Eigen::AngleAxisd(L.norm() / I.x() * T, L.normalized())) *
                                  Eigen::Quaterniond(Eigen::AngleAxisd(-rate * T, Eigen::Vector3d::UnitZ()));
  const double errors[] = {0.3, 1e-3, 1e-3, 1e-6, 1e-9, 1e-8};
  for (std::size_t m = 0; m < std::size(kPlainMethods); ++m) {
    const Trajectory end = simulate(free_body(I, w, kPlainMethods[m], 0.005, T), std::vector<double>{T});
    ASSERT_EQ(end.size(), 1) << kPlainMethods[m];
    EXPECT_LT(turn_of(end.q_at(0)).angularDistance(turn), errors[m]) << kPlainMethods[m];
    // Linear motion is a straight line at constant speed for any of them.
    const double along[] = {0.3, -0.2, 0.1};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(end.q_at(0)[i], along[i] * T, 1e-12) << kPlainMethods[m];
  }
}

TEST(TurnOfTheIntermediateAxis, KeepsMomentumAndEnergyToTheMethodsOrder) {
  // The body turns over again and again, 0.25 rad a step. Twice to three times what was measured.
  const Eigen::Vector3d I(1, 2, 3), w(0.01, 5, 0.01);
  const double bounds[] = {0.6, 2e-3, 3e-3, 2e-6, 1e-9, 1e-6};
  for (std::size_t m = 0; m < std::size(kPlainMethods); ++m) {
    const char* const method = kPlainMethods[m];
    const Simulation run = free_body(I, w, method, 0.05, 30);
    const Trajectory path = simulate_every_step(run);
    ASSERT_EQ(path.status, RunStatus::finished) << method << ": " << path.trouble;
    const Eigen::Vector3d L0 = momentum_of(I, run.q0, run.qd0);
    double strayed = 0, least = 1, unit = 0, energy = 0;
    for (int k = 0; k < path.size(); ++k) {
      const ConstVec q = path.q_at(k), qd = path.qd_at(k);
      strayed = std::max(strayed, (momentum_of(I, q, qd) - L0).norm() / L0.norm());
      least = std::min(least, qd[4] / w.y());
      unit = std::max(unit, std::abs(turn_of(q).norm() - 1));
      const Eigen::Vector3d rate(qd[3], qd[4], qd[5]);
      energy = std::max(energy, std::abs(rate.dot(I.cwiseProduct(rate)) / w.dot(I.cwiseProduct(w)) - 1));
    }
    EXPECT_LT(least, -0.9) << method;  // it did turn over
    EXPECT_LT(unit, 1e-15) << method;
    EXPECT_LT(strayed, bounds[m]) << method;
    EXPECT_GT(strayed, 0.01 * bounds[m]) << method;  // negative control
    EXPECT_LT(energy, 2 * bounds[m]) << method;
  }
}

TEST(FreeTree, KeepsBothMomenta) {
  // Of all bodies, about the world's origin: they are what the momenta of the floating joint are in the world's axes.
  // The linear one is kept to rounding by what integrates it itself, the angular one to the method's order.
  const double bounds[] = {1e-3, 1e-5, 2e-6, 5e-12, 1e-13, 1e-9};
  for (std::size_t m = 0; m < std::size(kPlainMethods); ++m) {
    const char* const method = kPlainMethods[m];
    Simulation run = tumbling(method, 0.01, 0);
    run.chain.gravity.setZero();
    finish(run.chain);
    MomentumForm form(run.chain);
    std::vector<double> p(std::size_t(run.chain.nv));
    const auto momenta = [&](ConstVec q, ConstVec qd) {
      form.momentum(q, qd, p);
      const Eigen::Quaterniond R = turn_of(q);
      const Eigen::Vector3d linear = R * Eigen::Vector3d(p[0], p[1], p[2]);
      const Eigen::Vector3d angular =
          R * Eigen::Vector3d(p[3], p[4], p[5]) + Eigen::Vector3d(q[0], q[1], q[2]).cross(linear);
      return Eigen::Matrix<double, 6, 1>((Eigen::Matrix<double, 6, 1>() << linear, angular).finished());
    };
    const Eigen::Matrix<double, 6, 1> at_first = momenta(run.q0, run.qd0);
    const Trajectory path = simulate_every_step(run);
    ASSERT_EQ(path.status, RunStatus::finished) << method << ": " << path.trouble;
    double linear = 0, angular = 0;
    for (int k = 0; k < path.size(); ++k) {
      const Eigen::Matrix<double, 6, 1> change = (momenta(path.q_at(k), path.qd_at(k)) - at_first) / at_first.norm();
      linear = std::max(linear, change.head<3>().norm());
      angular = std::max(angular, change.tail<3>().norm());
    }
    EXPECT_LT(linear, find_method(method).form == Form::momenta ? 1e-13 : bounds[m]) << method;
    EXPECT_LT(angular, bounds[m]) << method;
  }
}

TEST(EnergyOfAFloatingTree, IsKeptToTheMethodsOrder) {
  for (const auto& [method, bound] : {std::pair{"implicit_midpoint", 1e-3}, {"gauss4", 1e-8}, {"gauss6", 1e-8}}) {
    Simulation run = tumbling(method, 0.01, 0);
    run.duration = 5;
    const Trajectory path = simulate_every_step(run);
    const Audit audit = audit_of(run, path);
    EXPECT_LT(audit.largest_error, bound * audit.largest_kinetic) << method << " " << audit.largest_kinetic;
  }
}

TEST(FloatingJoints, AreTakenWhereverTheyStand) {
  // Two of them, one behind a joint that turns; bodies that share a coordinate.
  for (const std::uint64_t seed : {2, 5, 9}) {
    Simulation run;
    run.chain = random_tree(seed, {.bodies = 6, .floating = 0.4, .mimic = 0.3});
    run.q0 = zero_configuration(run.chain);
    run.qd0.assign(std::size_t(run.chain.nv), 0.5);
    run.torque = make_torque_law(run.chain, std::vector<TorqueEntry>(std::size_t(run.chain.nv)), {});
    run.duration = 0.25;
    run.step = 0.0025;
    run.method = &find_method("dop853");
    const Trajectory truth = simulate(run, std::vector<double>{0.25});
    const double errors[] = {0.1, 5e-3, 1e-3, 1e-7, 1e-10, 1e-9};
    for (std::size_t m = 0; m < std::size(kPlainMethods); ++m) {
      run.method = &find_method(kPlainMethods[m]);
      const Trajectory one = simulate(run, std::vector<double>{0.25});
      ASSERT_EQ(one.status, RunStatus::finished) << seed << " " << kPlainMethods[m] << ": " << one.trouble;
      EXPECT_LT(distance(one, truth), errors[m]) << seed << " " << kPlainMethods[m];
    }
  }
}

TEST(FloatingBase, IsHeldByConstraintsWithRadau5) {
  // The last body hangs by a ball joint; projections put the state aside after each step.
  const auto held = [](const std::string& method, double tolerance) {
    Simulation run = driven(method, 0, tolerance);
    run.qd0.assign(run.qd0.size(), 0);
    Workspace ws(run.chain);
    compute_kinematics(run.chain, ws, run.q0, run.qd0);
    const int frame = int(run.chain.frames.size()) - 1;
    run.constraints.list = {
        PointConstraint{run.chain.frames[std::size_t(frame)].name, frame_position(run.chain, ws, frame)}};
    return run;
  };
  const std::vector<double> times = instants(1, 0.0625);
  const Trajectory truth = simulate(held("dop853", 1e-12), times), one = simulate(held("radau5", 1e-8), times);
  ASSERT_EQ(one.status, RunStatus::finished) << one.trouble;
  EXPECT_LT(distance(one, truth), 1e-6);
  EXPECT_LT(one.position_error, 1e-12);
  EXPECT_GT(distance(truth, simulate(driven("dop853", 0, 1e-9), times)), 0.01);  // negative control
}

}  // namespace
}  // namespace chainreel::test
