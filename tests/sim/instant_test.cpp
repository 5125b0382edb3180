// What an instant says of a constrained mechanism: against Lagrange's equations of the first kind, solved densely,
// against the four-bar's own equation in its one freedom, and against a pen on a line in closed form.
#include "sim/instant.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "sim/runs.hpp"
#include "sim/system/constrained_chain.hpp"

namespace chainreel {
namespace {

using std::numbers::pi;

Simulation four_bar() {
  Simulation run = run_of("four_bar", {"12 - 2 * qd1", "0", "0"}, 6, "dop853", 0);
  run.options.tolerance = 1e-12;
  run.q0 = {pi, std::atan2(3.0, 4.0) - pi, -pi / 2};
  run.constraints.list = {CloseConstraint{"rocker_end", "ground_pin"}};
  return run;
}

// qdd, then lambda.
Eigen::VectorXd dense_motion(const Simulation& run, const Instant& now, ConstVec q, ConstVec qd) {
  const Chain& chain = run.chain;
  const Eigen::Index n = chain.nv, m = now.Jc.rows();
  Workspace ws(chain);
  compute_mass_matrix(chain, ws, q);
  compute_nle(chain, ws, q, qd);
  compute_friction(chain, ws, qd);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, n + m);
  A << ws.M, now.Jc.transpose(), now.Jc, Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd b(n + m);
  for (Eigen::Index v = 0; v < n; ++v) {
    const auto i = std::size_t(v);
    b(v) = now.tau[i] - ws.nle[i] - (chain.has_dissipation ? ws.tau_f[i] : 0);
  }
  for (Eigen::Index i = 0; i < m; ++i) b(n + i) = -now.Jcd_qd[std::size_t(i)];
  return A.fullPivLu().solve(b);
}

TEST(Instant, OfAFourBarSolvesLagrangesEquationsOfTheFirstKind) {
  const Simulation run = four_bar();
  const Trajectory trajectory = simulate(run, instants(3, 0.5));
  ASSERT_EQ(trajectory.status, RunStatus::finished);
  for (int k = 0; k < trajectory.size(); ++k) {
    const ConstVec q = trajectory.q_at(k), qd = trajectory.qd_at(k);
    const Instant now = instant_of(run, trajectory.t[std::size_t(k)], q, qd);
    ASSERT_EQ(now.rows.size(), 2u);
    EXPECT_DOUBLE_EQ(now.tau[0], 12 - 2 * qd[0]);
    const Eigen::VectorXd dense = dense_motion(run, now, q, qd);
    // Roundings of some 1000 rad/s^2 at the dead centres.
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(now.qdd[i], dense(Eigen::Index(i)), 1e-9);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(now.lambda[i], dense(3 + Eigen::Index(i)), 1e-9);
      EXPECT_NEAR(now.lambda[i], trajectory.lambda_at(k)[i], 1e-9) << "and is what the run has";
      EXPECT_NEAR(now.phi[i], 0, 1e-13);
    }
  }
}

TEST(Instant, OfAFourBarMovesAsItsOneFreedomDoes) {
  // T = I(theta) w^2 / 2 along the motion: I qdd1 + I' w^2 / 2 + V' = tau1, all by central differences along the run.
  const Simulation run = four_bar();
  const double h = 1e-3, t = 0.8;
  const double times[] = {t - h, t, t + h};
  const Trajectory near = simulate(run, times);
  Workspace ws(run.chain);
  double I[3], V[3];
  for (int k = 0; k < 3; ++k) {
    const Energy energy = energy_of(run.chain, ws, near.q_at(k), near.qd_at(k));
    I[k] = 2 * energy.kinetic / std::pow(near.qd_at(k)[0], 2);
    V[k] = energy.potential;
  }
  const double step = near.q_at(2)[0] - near.q_at(0)[0], w = near.qd_at(1)[0];
  const Instant now = instant_of(run, t, near.q_at(1), near.qd_at(1));
  const double qdd1 = (now.tau[0] - (V[2] - V[0]) / step - (I[2] - I[0]) / step * w * w / 2) / I[1];
  EXPECT_NEAR(now.qdd[0], qdd1, 1e-4 * (1 + std::abs(qdd1)));  // differences over 1 ms
  EXPECT_GT(std::abs(now.qdd[0]), 1e-2);
}

TEST(Instant, ForceOfAClosureIsWhatTheRockersPinHolds) {
  // Virtual work of the cut chain: what each torque does beyond M qdd + nle is the closure's force times the pin's way.
  const Simulation run = four_bar();
  const double times[] = {0.7};
  const Trajectory at = simulate(run, times);
  const Instant now = instant_of(run, 0.7, at.q_at(0), at.qd_at(0));
  ASSERT_EQ(now.forces.size(), 1u);
  Workspace ws(run.chain);
  const int pin = find_frame(run.chain, "rocker_end");
  compute_inverse_dynamics(run.chain, ws, at.q_at(0), at.qd_at(0), now.qdd);
  const std::vector<double> needed = ws.tau;
  compute_jacobian(run.chain, ws, at.q_at(0), pin, Task::linear);
  const TaskBasis basis = task_basis(run.chain, Task::linear);
  for (std::size_t i = 0; i < 3; ++i) {
    double work = 0;
    for (std::size_t r = 0; r < basis.directions.size(); ++r)
      work += basis.directions[r].dot(now.forces[0]) * ws.J(Eigen::Index(r), Eigen::Index(i));
    EXPECT_NEAR(now.tau[i] - needed[i], work, 1e-10);
  }
}

// Dry friction of 2 N against 1.5 sin(5 t) N: once the slider rests nothing moves it, and friction is what the push is.
TEST(Instant, OfWhatSticksHasTheFrictionThatHoldsIt) {
  Simulation run = run_of("pp", {"-2*(qd1>0)+2*(qd1<0) + 1.5*sin(5*t)", "0"}, 4, "dop853", 0);
  run.options.tolerance = 1e-9;
  run.qd0 = {0.1, 0};
  const double times[] = {3};
  const Trajectory at = simulate(run, times);
  ASSERT_NEAR(at.qd_at(0)[0], 0, 1e-12) << "it does not rest";
  const Instant now = instant_of(run, at, 0);
  EXPECT_NEAR(now.tau[0], 0, 1e-12);
  EXPECT_NEAR(now.qdd[0], 0, 1e-12);
  // Of the state alone nobody can tell: the law has the push, and friction by the sign of a rate that is rounding.
  EXPECT_GT(std::abs(instant_of(run, 3, at.q_at(0), at.qd_at(0)).tau[0]), 0.5);
}

TEST(Instant, OfAPenOnALineHasTheClosedForm) {
  // RR, unit links and masses, at (0, 90 deg), tip at (1, 1) on a level line: M = [3 1; 1 1], Jc = (1, 0), so that q1
  // cannot accelerate, q2 does as its own pendulum, and lambda is what is left at joint 1.
  const double g = 9.81;
  Simulation run = run_of("rr", {"7", "3"}, 1);
  run.q0 = {0, pi / 2};
  run.constraints.list = {LineConstraint{"gripper", {0, 1, 0}, {1, 0, 0}}};
  const std::vector<double> at_rest{0, 0};
  const Instant now = instant_of(run, 0, run.q0, at_rest);
  EXPECT_NEAR(now.Jc(0, 0), 1, 1e-15);
  EXPECT_NEAR(now.Jc(0, 1), 0, 1e-15);
  EXPECT_NEAR(now.qdd[0], 0, 1e-13);
  EXPECT_NEAR(now.qdd[1], 3, 1e-13);  // tau2 / M22: the outer mass stands straight above its joint
  EXPECT_NEAR(now.lambda[0], 7 - 2 * g - 3, 1e-12);  // tau1 - tau_g1 - M12 qdd2
  EXPECT_NEAR(now.forces[0].y(), now.lambda[0], 1e-15);
}

TEST(TipMass, OfAFourBarIsThatOfItsOneFreedom) {
  // A unit force along the tip's way moves the only freedom there is: 1/m = w_tip^2 / (2 T) for any rate.
  const Simulation run = four_bar();
  const double times[] = {0, 0.9};
  const Trajectory trajectory = simulate(run, times);
  Workspace ws(run.chain);
  const ConstVec q = trajectory.q_at(1), qd = trajectory.qd_at(1);
  const double kinetic = energy_of(run.chain, ws, q, qd).kinetic;
  compute_jacobian(run.chain, ws, q, run.chain.end_effector, Task::linear);
  const Eigen::VectorXd v = ws.J * Eigen::Map<const Eigen::VectorXd>(qd.data(), 3);
  const EffectiveMass mass = TipMass(run.chain, run.constraints).at(ws, q);
  EXPECT_NEAR(mass.mobility.maxCoeff(), v.squaredNorm() / (2 * kinetic), 1e-12 * v.squaredNorm() / kinetic);
  ASSERT_EQ(mass.singular_directions.size(), 1u) << "one freedom moves the tip along one direction";
  EXPECT_NEAR(mass.singular_directions[0].dot(v.normalized()), 0, 1e-9);
}

}  // namespace
}  // namespace chainreel
