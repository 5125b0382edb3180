// Projection onto constraints, forces from multipliers, effective mass under constraints.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "dynamics/constraints/constrained_cases.hpp"
#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constrained_mass.hpp"
#include "dynamics/constraints/constraint_projection.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel::test {
namespace {

Projection project(Tied& tied, std::vector<double>& q) {
  return project_positions(tied.chain, tied.ws, tied.set, tied.cws, q);
}

// Freudenstein: d/a cos th4 - d/c cos th2 + (a^2 - b^2 + c^2 + d^2)/(2 a c) = cos(th2 - th4), angles of crank
// a and rocker c from the line between the two ground pivots; here a = b = c = 1.
double freudenstein_error(const std::vector<double>& q, double x, double y) {
  const double d = std::hypot(x, y), ground = std::atan2(y, x);
  const double th2 = q[0] - ground, th4 = q[0] + q[1] + q[2] + std::numbers::pi - ground;
  return d * std::cos(th4) - d * std::cos(th2) + (1 + d * d) / 2 - std::cos(th2 - th4);
}

TEST(ConstrainedProjectionTest, FourBarAnglesFulfilFreudensteinsEquation) {
  Random random(701);
  Tied tied(rrr_chain(), {pin(1.2, 0.3)});
  int reached = 0;
  for (int k = 0; k < 50; ++k) {
    std::vector<double> q = random_vector(3, random, 3);
    if (!project(tied, q).reached) continue;  // a start may lie in a valley of its own
    ++reached;
    EXPECT_NEAR(freudenstein_error(q, 1.2, 0.3), 0, 1e-13);  // places to 64 round-offs, six terms
    q[1] += 1e-6;
    EXPECT_GT(std::fabs(freudenstein_error(q, 1.2, 0.3)), 1e-11);
  }
  EXPECT_GT(reached, 45);
}

// Beside the pose in which all links lie on one line a step of Newton's kind overshoots: it is halved until it gains.
TEST(ConstrainedProjectionTest, LeadsBackBesideAChangePoint) {
  Random random(703);
  for (const double off : {1e-2, 1e-3, 1e-4}) {
    Tied tied(rrr_chain(), {pin(1, 0)});
    for (int k = 0; k < 20; ++k) {
      std::vector<double> q{off, -off, off - std::numbers::pi};
      const std::vector<double> before = q, error = random_vector(3, random, 0.1 * off);
      for (std::size_t i = 0; i < 3; ++i) q[i] += error[i];
      const Projection back = project(tied, q);
      EXPECT_TRUE(back.reached) << off << " " << back.after;
      EXPECT_LE(back.after, 64 * 4e-16);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(q[i], before[i], off) << "no farther away than the change point";
      std::vector<double> qd{1, -1, 1.01};
      project_velocities(tied.chain, tied.ws, tied.set, tied.cws, q, qd);
      const Eigen::VectorXd rates = tied.Jc() * as_vector(qd);
      EXPECT_LT(rates.cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

TEST(ConstrainedProjectionTest, SaysHowFarALineIsOutOfReach) {
  Tied tied(rrr_chain(), {pen_line(5)});
  std::vector<double> q{0.4, 0.3, 0.2};
  const Projection projection = project(tied, q);
  EXPECT_FALSE(projection.reached);
  // The arm is 3 m long; near its stretched pose a step gains little.
  EXPECT_NEAR(projection.after, 2, 1e-3);
  Tied nearer(rrr_chain(), {pen_line(2.5)});
  EXPECT_TRUE(project(nearer, q).reached);
}

TEST(ConstrainedProjectionTest, VelocitiesLoseWhatIsAcrossInTheMetricOfM) {
  Random random(702);
  const Chain arm = arm_chain(3), long_chain = planar_serial_chain(30);
  for (const Chain& chain : {rrr_chain(), arm, long_chain}) {
    const std::string tip = chain.frames.back().name;
    Tied tied(chain, {PointConstraint{tip, kOrigin}, PointConstraint{tip, kOrigin}});
    const State s = random_state(chain, random);
    std::vector<double> qd = s.qd;
    EXPECT_GT(project_velocities(chain, tied.ws, tied.set, tied.cws, s.q, qd), 1e-3);
    EXPECT_LT((tied.Jc() * as_vector(qd)).cwiseAbs().maxCoeff(), 1e-13);
    compute_mass_matrix(chain, tied.ws, s.q);
    const Eigen::MatrixXd allowed = Eigen::FullPivLU<Eigen::MatrixXd>(tied.Jc()).setThreshold(1e-10).kernel();
    const Eigen::VectorXd impulse = tied.ws.M * (as_vector(qd) - as_vector(s.qd));
    EXPECT_LT((allowed.transpose() * impulse).cwiseAbs().maxCoeff(), 1e-10 * impulse.cwiseAbs().maxCoeff());
  }
}

TEST(ConstrainedInverseTest, UndoesForwardDynamicsAndReportsTheContactForce) {
  Random random(703);
  Tied tied(rrr_chain(), {pen_line()});
  for (int k = 0; k < 20; ++k) {
    const State s = random_state(tied.chain, random);
    tied.move(s);
    const std::vector<double> qdd = tied.ws.qdd, lambda = tied.cws.lambda;
    compute_constrained_inverse_dynamics(tied.chain, tied.ws, tied.set, tied.cws, s.q, s.qd, qdd, lambda);
    EXPECT_LT(relative_difference(tied.ws.tau, s.tau), 1e-11);  // M of condition 1e3 or so
    const Eigen::Vector3d f = contact_force(tied.chain, tied.set, tied.cws, 0, lambda);
    EXPECT_EQ(f, Eigen::Vector3d(0, lambda[0], 0));
  }
}

TEST(ConstrainedInverseTest, MultipliersOfAForceBearItsPartAcross) {
  Random random(704);
  const Chain arm = arm_chain(4);
  Tied tied(arm, {LineConstraint{"tip", kOrigin, {1, 0, 0}}, DistanceConstraint{"base", "tip", 1}});
  const State s = random_state(arm, random);
  compute_constraints(arm, tied.ws, tied.set, tied.cws, s.q, s.qd);
  std::vector<double> lambda(3, 7);
  multipliers_of_force(arm, tied.set, tied.cws, 0, {5, -3, 2}, lambda);
  EXPECT_LT((contact_force(arm, tied.set, tied.cws, 0, lambda) - Eigen::Vector3d(0, -3, 2)).norm(), 1e-14);
  EXPECT_EQ(lambda[2], 7);  // another constraint's
}

// J S (S^T M S)^-1 S^T J^T with S a basis of the motions that the constraints allow.
TEST(ConstrainedEffectiveMassTest, IsThatOfTheMotionsLeft) {
  Random random(705);
  for (const Chain& chain : {rrr_chain(), arm_chain(5), planar_serial_chain(30)}) {
    const std::string tip = chain.frames.back().name;
    const Constraint tie = PlaneConstraint{tip, kOrigin, {0, 1, 0}};
    Tied tied(chain, {tie, tie});
    const State s = random_state(chain, random);
    const EffectiveMass mass = constrained_effective_mass_of(chain, tied.ws, tied.set, tied.cws, s.q,
                                                             chain.end_effector, Task::linear);
    compute_mass_matrix(chain, tied.ws, s.q);
    compute_jacobian(chain, tied.ws, s.q, chain.end_effector, Task::linear);
    const Eigen::MatrixXd S = Eigen::FullPivLU<Eigen::MatrixXd>(tied.Jc()).setThreshold(1e-10).kernel();
    const Eigen::MatrixXd JS = tied.ws.J * S;
    const Eigen::MatrixXd expected = JS * (S.transpose() * tied.ws.M * S).ldlt().solve(JS.transpose());
    EXPECT_LT(relative_difference(mass.Lambda_inv, expected), 1e-9);  // S's condition times M's
    EXPECT_FALSE(mass.Lambda);
    ASSERT_EQ(mass.singular_directions.size(), 1u);
    EXPECT_NEAR(mass.singular_directions[0][1], 1, 1e-9);
  }
}

}  // namespace
}  // namespace chainreel::test
