// Forces from outside: against Jacobians, closed forms, and what the ground and the joints must not take for their own.

#include "sim/drive/pushes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"
#include "sim/audit.hpp"
#include "sim/runs.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/torques_along.hpp"
#include "sim/watch/events.hpp"
#include "support/allocation_count.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

constexpr double kAlways = std::numeric_limits<double>::infinity();

Simulation pushed(Simulation run, std::vector<ActingPush> pushes) {
  run.torque = make_pushed_law(std::move(run.torque), std::move(pushes));
  return run;
}

std::vector<double> numbers(test::Random& random, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(random.between(-1, 1));
  return all;
}

// J^T F by the Jacobian's own recursion, of trees with sliders and joints that follow others, on fixed and floating bases.
TEST(Pushes, AreTheJacobianTransposedTimesTheForce) {
  test::Random random(3);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Chain chain = test::random_tree(seed, {.floating_base = seed % 3 == 0, .mimic = 0.2});
    Workspace ws(chain);
    std::vector<double> q = zero_configuration(chain);
    const std::vector<double> way = numbers(random, chain.nv), qd = numbers(random, chain.nv);
    advance(chain, q, way, 1);
    const int frame = random.below(int(chain.frames.size()));
    const Eigen::Vector3d force = random.vector(10);
    std::vector<double> tau(std::size_t(chain.nv));
    const Pushes pushes({{frame, force, 0, kAlways}, {frame, force, 1, 2}});
    pushes.add_to(chain, ws, 0.5, q, qd, tau);
    compute_jacobian(chain, ws, q, frame, Task::linear);
    const TaskBasis basis = task_basis(chain, Task::linear);
    Eigen::VectorXd along(Eigen::Index(basis.directions.size()));
    for (Eigen::Index r = 0; r < along.size(); ++r) along[r] = basis.directions[std::size_t(r)].dot(force);
    const Eigen::VectorXd expected = ws.J.transpose() * along;
    // Some tens of roundings of numbers below 100 N m.
    for (std::size_t i = 0; i < tau.size(); ++i) EXPECT_NEAR(tau[i], expected[Eigen::Index(i)], 1e-12) << seed;
  }
}

// A slider of 1 kg that carries another one: F t / m, whatever the steps, since they end where pushes begin and end.
TEST(Pushes, GiveTheirImpulseAtAnyStep) {
  for (const char* method : {"semi_implicit_euler", "explicit_euler", "rk4", "verlet", "implicit_midpoint"}) {
    Simulation run = run_of("pp", {"0", "0"}, 1, method, 0.01);
    run.chain.gravity.setZero();
    run = pushed(std::move(run), {{run.chain.end_effector, {6, 2, 7}, 0.2042, 0.4546}, {run.chain.end_effector, {0, 1, 0}, 0.9, 3}});
    const Trajectory trajectory = simulate(run, instants(1, 0.1));
    const ConstVec qd = trajectory.qd_at(trajectory.size() - 1);
    EXPECT_NEAR(qd[0], 6 * 0.2504 / 2, 1e-13) << method;  // x carries both
    EXPECT_NEAR(qd[1], 2 * 0.2504 + 1 * 0.1, 1e-13) << method;
    EXPECT_EQ(trajectory.qd_at(2)[0], 0) << "before it begins";
  }
}

TEST(Pushes, DoWorkThatTheAuditCounts) {
  Simulation run = run_of("rr", {"1", "-0.2 * qd2"}, 3, "dop853", 0);
  run.options.tolerance = 1e-11;
  run = pushed(std::move(run), {{run.chain.end_effector, {3, 4, 0}, 0.7, 1.1}, {1, {-2, 1, 0}, 0.9, kAlways}});
  const Audit audit = audit_of(run, simulate(run, instants(3, 0.05)));
  EXPECT_LT(audit.largest_error, 1e-8);
  EXPECT_GT(audit.largest_kinetic, 1) << "something moves";
}

// The same motion as under torques J^T F, which are written for RR in its own coordinates.
TEST(Pushes, MoveAsTorquesThatAreWrittenOutDo) {
  const auto exact = [](const std::vector<std::string>& torque) {
    Simulation run = run_of("rr", torque, 1, "dop853", 0);
    run.options.tolerance = 1e-12;
    return run;
  };
  Simulation by_force = exact({"0", "0"});
  by_force = pushed(std::move(by_force), {{by_force.chain.end_effector, {3, 4, 0}, 0, kAlways}});
  const Simulation by_torque = exact({"4 * x_G - 3 * y_G", "4 * (x_G - cos(q1)) - 3 * (y_G - sin(q1))"});
  const Trajectory a = simulate(by_force, instants(1, 0.1)), b = simulate(by_torque, instants(1, 0.1));
  for (int k = 0; k < a.size(); ++k)
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(a.q_at(k)[std::size_t(i)], b.q_at(k)[std::size_t(i)], 1e-10) << k;
  for (const double tau : torques_along(by_force, a)) EXPECT_EQ(tau, 0) << "the joints drive nothing";
}

// Efforts are the joints' own: what pushes is not cut.
TEST(Pushes, AreNoEffort) {
  Simulation run = run_of("rr", {"0", "0"}, 0.1);
  for (std::size_t b = 1; b < run.chain.bodies.size(); ++b) run.chain.bodies[b].joint.limit.effort = 1e-3;
  run.limit = LimitPolicy::clamp;
  run = pushed(std::move(run), {{run.chain.end_effector, {0, 100, 0}, 0, kAlways}});
  const Trajectory trajectory = simulate(run, instants(0.1, 0.1));
  EXPECT_TRUE(trajectory.limits.empty());
  const ConstVec qd = trajectory.qd_at(trajectory.size() - 1);
  EXPECT_GT(std::hypot(qd[0], qd[1]), 1);
}

// A still human of weight W who is pushed forward by F at height h: what bears him moves forward by F h / W.
TEST(Pushes, MoveTheCentreOfPressureByTheirLever) {
  const Simulation run = run_of("humanoid", {}, 1);
  const Chain& chain = run.chain;
  Workspace ws(chain);
  const std::vector<double> q{-0.05, 0.1, -0.1}, still(3);
  const GroundAxes axes = ground_axes(chain);
  const int hip = find_frame(chain, "trunk");
  ASSERT_GE(hip, 0);
  const double force = 40, weight = 75 * 9.81;
  const Pushes pushes({{hip, {force, 0, 0}, 0, kAlways}});
  const Wrench wrench = pushes.wrench(chain, ws, 0, q, still);
  const double height = frame_position(chain, ws, hip).y();
  const GroundLoad alone = ground_load(chain, ws, axes, 0, q, still, still), with = ground_load(chain, ws, axes, 0, q, still, still, wrench);
  EXPECT_NEAR(with.cop - alone.cop, force * height / weight, 1e-12);
  EXPECT_NEAR(with.grf, alone.grf, 1e-10) << "it lifts nothing";
  EXPECT_NEAR(with.force.x(), -force, 1e-10) << "and is held by the ground";
}

// In free fall of all joints the ground bears what Newton says: with the push counted, the rate of all momentum.
TEST(Pushes, AndTheGroundMakeTheRateOfMomentum) {
  Simulation run = run_of("humanoid", {"40", "-300 * q2", "-200 * q3"}, 0.3, "dop853", 0);
  run.options.tolerance = 1e-13;
  run.q0 = {-0.1, 0.05, -0.1};
  const int trunk = find_frame(run.chain, "trunk");
  run = pushed(std::move(run), {{trunk, {80, -30, 0}, 0, kAlways}});
  const double h = 2e-4, t = 0.15;
  const Trajectory trajectory = simulate(run, std::vector<double>{t - h, t, t + h});
  Workspace ws(run.chain);
  const auto momentum = [&](int k) { return momentum_of(run.chain, ws, trajectory.q_at(k), trajectory.qd_at(k)).linear; };
  const Eigen::Vector3d rate = (momentum(2) - momentum(0)) / (2 * h);
  ChainSystem system(run);
  std::vector<double> qdd(3);
  const ConstVec q = trajectory.q_at(1), qd = trajectory.qd_at(1);
  system.acceleration(t, q, qd, qdd);
  const GroundLoad load = ground_load(run.chain, ws, ground_axes(run.chain), 0, q, qd, qdd, system.pushed(t, q, qd));
  const Eigen::Vector3d weight = 75 * run.chain.gravity;
  // The difference quotient is off by h^2 / 6 of the third derivative: 2.5 mN, 25 times as much with h = 1 ms.
  EXPECT_LT((load.force + weight + Eigen::Vector3d(80, -30, 0) - rate).head<2>().norm(), 0.01);
  EXPECT_GT((load.force + weight - rate).head<2>().norm(), 50) << "negative control: the push counts";
}

TEST(Pushes, AllocateNothingInTheLoop) {
  Simulation run = run_of("rr", {"0", "0"}, 20, "semi_implicit_euler", 0.0005);
  run = pushed(std::move(run), {{run.chain.end_effector, {1, 2, 0}, 0, kAlways}});
  long at_first = -1, at_last = 0;
  simulate(run, instants(20, 1.0 / 60), [&](double t) {
    if (t > 0 && at_first < 0) at_first = allocation_count();
    at_last = allocation_count();
    return false;
  });
  EXPECT_EQ(at_last, at_first);
}

// Behind its end it does nothing, and a law without any is as it was.
TEST(Pushes, EndAndNoneAreNone) {
  const Chain chain = test::rr_chain();
  Workspace ws(chain);
  const std::vector<double> q{0.3, 1}, qd{0.1, 0.2};
  std::vector<double> tau(2);
  const Pushes pushes({{chain.end_effector, {1, 2, 0}, 1, 2}});
  for (const double t : {0.0, 0.999, 2.0, 5.0}) pushes.add_to(chain, ws, t, q, qd, tau);
  EXPECT_THAT(tau, testing::ElementsAre(0, 0));
  pushes.add_to(chain, ws, 1, q, qd, tau);
  EXPECT_NE(tau[0], 0);
  EXPECT_THAT(pushes.breaks(1.5), testing::ElementsAre(1));
  std::unique_ptr<TorqueLaw> law = make_torque_law(chain, {}, {});
  const TorqueLaw* bare = law.get();
  EXPECT_EQ(make_pushed_law(std::move(law), {}).get(), bare);
}

}  // namespace
}  // namespace chainreel
