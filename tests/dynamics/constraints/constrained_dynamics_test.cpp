// Forward dynamics under constraints.
#include <algorithm>

#include "dynamics/constraints/constrained_dynamics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "dynamics/constraints/constrained_cases.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "support/allocation_count.hpp"

namespace chainreel::test {
namespace {

// M, nle + tau_f and the rows, each by its own algorithm, for Eigen to solve.
struct Equations {
  Eigen::MatrixXd M, Jc;
  Eigen::VectorXd free_force, Jcd_qd;

  Eigen::MatrixXd G() const { return Jc * M.ldlt().solve(Jc.transpose()); }
  // What lambda answers: G lambda = this.
  Eigen::VectorXd right_side() const { return Jc * M.ldlt().solve(free_force) + Jcd_qd; }
};

Equations equations_of(Tied& tied, const State& s) {
  Workspace ws(tied.chain);
  ConstrainedWorkspace cws(tied.chain, tied.set);
  cws.curve_s = tied.cws.curve_s;
  compute_constraints(tied.chain, ws, tied.set, cws, s.q, s.qd);
  compute_mass_matrix(tied.chain, ws, s.q);
  compute_nle(tied.chain, ws, s.q, s.qd);
  compute_friction(tied.chain, ws, s.qd);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return {ws.M, Eigen::Map<const RowMajor>(cws.Jc.data(), tied.set.rows(), tied.chain.nv),
          as_vector(s.tau) - as_vector(ws.nle) - as_vector(ws.tau_f), as_vector(cws.Jcd_qd)};
}

// Both equations of motion, each against the largest number in it; `solved` is (qdd, lambda).
double kkt_error(const Equations& e, const Eigen::VectorXd& qdd, const Eigen::VectorXd& lambda) {
  const Eigen::VectorXd force = e.M * qdd + e.Jc.transpose() * lambda;
  const Eigen::VectorXd rows = e.Jc * qdd;
  const double force_size = e.free_force.cwiseAbs().maxCoeff() +
                            (e.M.cwiseAbs() * qdd.cwiseAbs()).maxCoeff() +
                            (e.Jc.cwiseAbs().transpose() * lambda.cwiseAbs()).maxCoeff();
  const double row_size = e.Jcd_qd.cwiseAbs().maxCoeff() + (e.Jc.cwiseAbs() * qdd.cwiseAbs()).maxCoeff();
  return std::max((force - e.free_force).cwiseAbs().maxCoeff() / force_size,
                  (rows + e.Jcd_qd).cwiseAbs().maxCoeff() / row_size);
}

// Recursions of some ten bodies leave some ten round-offs in each number, M of condition up to 1e3 or so
// multiplies them before they reach qdd.
constexpr double kRecursionError = 1e-11;

std::vector<Constraint> some_ties(const Chain& chain, Random& random) {
  std::vector<Constraint> ties{PointConstraint{"tip", random.vector(1)},
                               DistanceConstraint{"b4", "tip", 0.8}};
  if (chain.bodies[1].joint.kind != JointKind::floating)
    ties.push_back(JointConstraint{chain.coordinate_names[1], 0});
  return ties;
}

TEST(ConstrainedDynamicsTest, FulfilsBothEquationsOnTreesOfEveryKind) {
  Random random(601);
  int regular = 0;
  for (int k = 0; k < 60; ++k) {
    const std::uint64_t seed = std::uint64_t(610 + k);
    const int bodies = k % 3 == 2 ? 26 : 8;  // those take the articulated inertias
    const double mimic = k % 4 == 3 ? 0.3 : 0;
    const bool serial = k % 6 > 1;  // in a tree few joints may carry the tip
    Chain chain =
        k % 2 == 0
            ? random_planar_tree(seed, {.bodies = bodies, .serial = serial, .mimic = mimic})
            : random_tree(seed,
                          {.bodies = bodies, .serial = serial, .floating_base = k % 4 == 1, .mimic = mimic});
    if (k % 5 == 0) {
      chain.bodies[2].joint.damping = 0.7;
      chain.has_dissipation = true;
    }
    Tied tied(chain, some_ties(chain, random));
    const State s = random_state(chain, random);
    const ConstraintStatus status = tied.move(s);
    if (status == ConstraintStatus::regular) ++regular;
    if (status == ConstraintStatus::inconsistent) continue;  // little of the tree is left to move the tip
    EXPECT_LT(kkt_error(equations_of(tied, s), tied.qdd(), tied.lambda()), kRecursionError) << chain.name;
  }
  EXPECT_GT(regular, 30);
}

TEST(ConstrainedDynamicsTest, TheEquationsNoticeAnotherMass) {
  Random random(602);
  Tied tied(rrr_chain(), {pin()});
  Tied heavier(with_changed_mass(rrr_chain(), 2, 1 + 1e-6), {pin()});
  const State s = random_state(tied.chain, random);
  heavier.move(s);
  EXPECT_GT(kkt_error(equations_of(tied, s), heavier.qdd(), heavier.lambda()), 1000 * kRecursionError);
}

// All joints but one locked is a rigid pendulum: qdd = -g sum(m x) / sum(m r^2).
TEST(ConstrainedDynamicsTest, LockedElbowIsAPhysicalPendulum) {
  const double bend = 0.8, q1 = 0.3;
  Tied tied(rr_chain(), {DistanceConstraint{"base", "gripper", 2 * std::cos(bend / 2)}});
  const State s{{q1, bend}, {1.7, 0}, {}, {0.6, 0}};
  ASSERT_EQ(tied.move(s), ConstraintStatus::regular);
  const Eigen::Vector2d p1(std::cos(q1), std::sin(q1));
  const Eigen::Vector2d p2 = p1 + Eigen::Vector2d(std::cos(q1 + bend), std::sin(q1 + bend));
  const double expected = (0.6 - 9.81 * (p1.x() + p2.x())) / (p1.squaredNorm() + p2.squaredNorm());
  const double tolerance = 64 * kRoundOff * std::fabs(expected);
  EXPECT_NEAR(tied.ws.qdd[0], expected, tolerance);
  EXPECT_NEAR(tied.ws.qdd[1], 0, tolerance);

  Tied by_joint(rr_chain(), {JointConstraint{tied.chain.coordinate_names[1], bend}});
  by_joint.move(s);
  EXPECT_NEAR(by_joint.ws.qdd[0], expected, tolerance);
  Tied straighter(rr_chain(), {DistanceConstraint{"base", "gripper", 2 * std::cos(bend / 2)}});
  straighter.move({{q1, bend + 1e-6}, {1.7, 0}, {}, {0.6, 0}});
  EXPECT_GT(std::fabs(straighter.ws.qdd[0] - expected), 1e6 * tolerance);
}

// The two-link chain whose first link is the first two rods as one body.
Chain two_links_of_bent_rods(double bend) {
  Chain chain = rrr_chain();
  const Eigen::Rotation2Dd turn(bend);
  const Eigen::Vector2d c1(0.5, 0), c2 = Eigen::Vector2d(1, 0) + turn * Eigen::Vector2d(0.5, 0);
  const Eigen::Vector2d com = (c1 + c2) / 2;
  Chain result;
  result.gravity = chain.gravity;
  result.bodies = {chain.bodies[0], chain.bodies[1], chain.bodies[3]};
  result.bodies[1].inertia.mass = 2;
  result.bodies[1].inertia.com = {com.x(), com.y(), 0};
  result.bodies[1].inertia.about_com.setZero();
  result.bodies[1].inertia.about_com(2, 2) = 2.0 / 12 + (c1 - com).squaredNorm() + (c2 - com).squaredNorm();
  result.bodies[2].parent = 1;
  const Eigen::Vector2d joint = Eigen::Vector2d(1, 0) + turn * Eigen::Vector2d(1, 0);
  result.bodies[2].joint.X_PJ = Eigen::Isometry3d(Eigen::Translation3d(joint.x(), joint.y(), 0));
  finish(result);
  return result;
}

TEST(ConstrainedDynamicsTest, RodAcrossTheElbowLeavesATwoLinkChain) {
  const double bend = 0.7;
  Tied tied(rrr_chain(), {DistanceConstraint{"base", "b3", 2 * std::cos(bend / 2)}});
  const Chain two = two_links_of_bent_rods(bend);
  Workspace ws(two);
  Random random(603);
  for (int k = 0; k < 20; ++k) {
    const double q1 = random.between(-3, 3), q3 = random.between(-3, 3);
    const double w1 = random.between(-2, 2), w3 = random.between(-2, 2);
    const double tau1 = random.between(-5, 5), tau3 = random.between(-5, 5);
    ASSERT_EQ(tied.move({{q1, bend, q3}, {w1, 0, w3}, {}, {tau1, 4, tau3}}), ConstraintStatus::regular);
    // The first link of `two` points along the first rod; joint 3 counts from the second rod.
    const std::vector<double> q{q1, bend + q3}, qd{w1, w3}, tau{tau1, tau3};
    compute_forward_dynamics(two, ws, q, qd, tau);
    const double tolerance = 1e-12;  // some 100 round-offs of accelerations of up to 50
    EXPECT_NEAR(tied.ws.qdd[0], ws.qdd[0], tolerance);
    EXPECT_NEAR(tied.ws.qdd[1], 0, tolerance);
    EXPECT_NEAR(tied.ws.qdd[2], ws.qdd[1], tolerance);
  }
}

// Rates that keep the rows: the part of `qd` in the null space of Jc.
std::vector<double> allowed_rates(const Equations& e, const std::vector<double>& qd) {
  const Eigen::VectorXd v = as_vector(qd);
  const Eigen::VectorXd kept = v - e.Jc.completeOrthogonalDecomposition().solve(e.Jc * v);
  return {kept.data(), kept.data() + kept.size()};
}

TEST(ConstrainedDynamicsTest, PenOnALineIsPushedAcrossItAndDoesNoWork) {
  Random random(604);
  Tied tied(rrr_chain(), {pen_line()});
  for (int k = 0; k < 20; ++k) {
    State s = random_state(tied.chain, random);
    s.qd = allowed_rates(equations_of(tied, s), s.qd);
    ASSERT_EQ(tied.move(s), ConstraintStatus::regular);
    const Equations e = equations_of(tied, s);
    const Eigen::VectorXd force = e.Jc.transpose() * tied.lambda();
    EXPECT_EQ(tied.set.row_list()[0].direction.x, 0);  // no horizontal part
    // Four round-offs of each of the three products.
    EXPECT_NEAR(force.dot(as_vector(s.qd)), 0, 16 * kRoundOff * force.norm() * as_vector(s.qd).norm());
  }
}

// The force on the tip from the links cut free, about their joints: with j_k joints, c_i and a_i centres and
// their accelerations, sum_{i >= k} I alpha_i + (c_i - j_k) x m (a_i - g) = tau_k + (p - j_k) x F.
TEST(ConstrainedDynamicsTest, LambdaIsTheReactionOfTheCutLinks) {
  Random random(605);
  Tied tied(rrr_chain(), {pin()});
  for (int k = 0; k < 20; ++k) {
    const State s = random_state(tied.chain, random);
    ASSERT_EQ(tied.move(s), ConstraintStatus::regular);
    Eigen::Vector2d joint[4] = {}, centre[3], a_centre[3], a_joint(0, 0);
    joint[0].setZero();
    double phi = 0, w = 0, alpha[3], sum = 0;
    for (int i = 0; i < 3; ++i) {
      phi += s.q[std::size_t(i)], w += s.qd[std::size_t(i)], sum += tied.ws.qdd[std::size_t(i)];
      alpha[i] = sum;
      const Eigen::Vector2d u(std::cos(phi), std::sin(phi)), n(-u.y(), u.x());
      centre[i] = joint[i] + 0.5 * u;
      a_centre[i] = a_joint + 0.5 * (alpha[i] * n - w * w * u);
      joint[i + 1] = joint[i] + u;
      a_joint += alpha[i] * n - w * w * u;
    }
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    Eigen::Matrix2d A;
    Eigen::Vector2d b;
    for (int row = 0; row < 2; ++row) {
      const int first = row + 1;
      const Eigen::Vector2d r = joint[3] - joint[first];
      A.row(row) << -r.y(), r.x();
      b[row] = -s.tau[std::size_t(first)];
      for (int i = first; i < 3; ++i)
        b[row] += alpha[i] / 12 + cross(centre[i] - joint[first], a_centre[i] + Eigen::Vector2d(0, 9.81));
    }
    const Eigen::Vector2d on_robot = A.inverse() * b;
    const double condition = A.norm() * A.inverse().norm();
    EXPECT_LT((tied.lambda() + on_robot).norm(), 200 * kRoundOff * condition * (1 + b.norm()));
  }
}

// Doubled and tripled constraints.
std::vector<std::vector<Constraint>> doubled_cases() {
  const CloseConstraint close{"gripper", "base"};
  return {{pen_line(), pen_line()},
          {pin(), pin()},
          {close, close},
          {pin(), pen_line(0.3)},
          {pen_line(), pen_line(0.7), pen_line()}};
}

TEST(ConstrainedDynamicsTest, RowsThatRepeatHaveTheMoorePenroseMultipliers) {
  Random random(606);
  for (const auto& ties : doubled_cases()) {
    Tied tied(rrr_chain(), ties);
    for (int k = 0; k < 100; ++k) {
      const State s = random_state(tied.chain, random);
      ASSERT_EQ(tied.move(s), ConstraintStatus::redundant);
      EXPECT_LE(tied.cws.residual, 1e-12);
      EXPECT_LE(tied.cws.passes, 4);
      const Equations e = equations_of(tied, s);
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(e.G(), Eigen::ComputeThinU | Eigen::ComputeThinV);
      Eigen::VectorXd sigma = svd.singularValues();
      double least = sigma[0];
      for (double& x : sigma) {
        if (x > 1e-10 * sigma[0]) least = std::min(least, x);
        x = x > 1e-10 * sigma[0] ? 1 / x : 0;
      }
      const Eigen::VectorXd expected =
          svd.matrixV() * sigma.asDiagonal() * svd.matrixU().transpose() * e.right_side();
      // round-off times the condition of G without its null space, and of M (some 100)
      EXPECT_LT(relative_difference(tied.lambda(), expected),
                1e4 * kRoundOff * sigma.maxCoeff() * svd.singularValues()[0])
          << least;
    }
  }
}

TEST(ConstrainedDynamicsTest, DoublingARowChangesNoAcceleration) {
  Random random(607);
  Tied once(rrr_chain(), {pin()}), twice(rrr_chain(), {pin(), pin()}),
      other(rrr_chain(), {pin(), pen_line()});
  const State s = random_state(once.chain, random);
  once.move(s);
  twice.move(s);
  EXPECT_LT(relative_difference(twice.ws.qdd, once.ws.qdd), 1e-13);
  EXPECT_LT(relative_difference(twice.lambda().head(2), Eigen::VectorXd(once.lambda() / 2)), 1e-13);
}

// A pinned tip that moves cannot keep its distance as well: the rod asks for an acceleration that the pin
// denies.
TEST(ConstrainedDynamicsTest, RowsThatContradictHaveTheLeastSquares) {
  Random random(608);
  Tied tied(rrr_chain(), {pin(), DistanceConstraint{"base", "gripper", 1.5}});
  for (int k = 0; k < 100; ++k) {
    const State s = random_state(tied.chain, random);
    ASSERT_EQ(tied.move(s), ConstraintStatus::inconsistent);
    const Equations e = equations_of(tied, s);
    const Eigen::MatrixXd G = e.G();
    const Eigen::VectorXd b = e.right_side();
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(G);
    decomposition.setThreshold(1e-10);
    const Eigen::VectorXd expected = decomposition.solve(b);
    // The condition of G's range multiplies round-off; up to 1e4 in these poses.
    EXPECT_LT(relative_difference(tied.lambda(), expected), 1e-8);
    EXPECT_NEAR(tied.cws.residual, (b - G * expected).cwiseAbs().maxCoeff(), 1e-8 * b.norm());
    EXPECT_GT(tied.cws.residual, 1e-6);
    EXPECT_LT(kkt_error({e.M, Eigen::MatrixXd(0 * e.Jc), e.free_force - e.Jc.transpose() * tied.lambda(),
                         0 * e.Jcd_qd},
                        tied.qdd(), tied.lambda()),
              kRecursionError);
    EXPECT_LE(tied.cws.passes, 6);
  }
}

// One row: G is a number and the mean of its diagonal, so that a pass leaves mu / (1 + mu) of the residual.
TEST(ConstrainedDynamicsTest, ProximalPassesConvergeLinearlyInMu) {
  Random random(609);
  Tied tied(rrr_chain(), {pen_line()});
  const State s = random_state(tied.chain, random);
  for (const double mu : {0.5, 0.1, 0.01}) {
    const auto residual_after = [&](int passes) {
      EXPECT_EQ(tied.move(s, {.most_passes = passes, .mu = mu, .always_proximal = true}),
                ConstraintStatus::not_converged);
      return tied.cws.residual;
    };
    // 1e-10: round-off of the residual of the third pass, 1e-6 of the first with mu = 0.01
    EXPECT_NEAR(residual_after(2) / residual_after(1), mu / (1 + mu), 1e-9);
    EXPECT_NEAR(residual_after(3) / residual_after(2), mu / (1 + mu), 1e-9);
  }
}

// Of two rows the direction with the smaller eigenvalue comes last.
TEST(ConstrainedDynamicsTest, TheSlowestDirectionSetsTheRateOfTheProximalPasses) {
  Tied tied(rrr_chain(), {pin()});
  const State s{{0.4, 0.9, -0.6}, {1, -1, 0.5}, {}, {1, 2, 3}};
  const double mu = 0.3;
  const Eigen::MatrixXd G = equations_of(tied, s).G();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(G);
  const double added = mu * G.trace() / 2;
  const auto residual_after = [&](int passes) {
    tied.move(s, {.most_passes = passes, .mu = mu, .always_proximal = true});
    return tied.cws.residual;
  };
  const double slow = added / (eigen.eigenvalues()[0] + added),
               fast = added / (eigen.eigenvalues()[1] + added);
  const double rest = std::pow(fast / slow, 12);  // what is left of the other direction
  ASSERT_LT(rest, 1e-3);
  EXPECT_NEAR(residual_after(13) / residual_after(12), slow, 100 * rest);
}

TEST(ConstrainedDynamicsTest, ProximalPassesAndTheClosedFormAgree) {
  Random random(610);
  Tied tied(rrr_chain(), {pin()});
  for (int k = 0; k < 20; ++k) {
    const State s = random_state(tied.chain, random);
    tied.move(s);
    const Eigen::VectorXd lambda = tied.lambda();
    EXPECT_EQ(tied.move(s, {.always_proximal = true}), ConstraintStatus::regular);
    EXPECT_LT(relative_difference(tied.lambda(), lambda), 1e-9);  // condition of G up to 1e6 in these poses
  }
}

// Stretched out, an arm's tip cannot move along it: that row of Jc is zero.
TEST(ConstrainedDynamicsTest, SingularPosesStayFinite) {
  Tied tied(rr_chain(), {PointConstraint{"gripper", {2, 0, 0}}});
  EXPECT_EQ(tied.move({{0, 0}, {0, 0}, {}, {1, 2}}), ConstraintStatus::redundant);
  EXPECT_EQ(tied.cws.rank, 1);
  EXPECT_TRUE(tied.qdd().allFinite());
  EXPECT_EQ(tied.cws.lambda[0], 0);
  EXPECT_EQ(tied.move({{0, 0}, {1, 0}, {}, {1, 2}}), ConstraintStatus::inconsistent);
  // The links' centripetal acceleration, 2 m (1 rad/s)^2, is all that is left.
  EXPECT_NEAR(tied.cws.residual, 2, 8 * kRoundOff);
}

// Three rods of 1 m pinned 1 m from their origin: a parallelogram, which lies on one line at the change point. Coordinates
// follow N theta, N = (1, -1, 1), so that N^T M N theta'' = N^T (tau - nle), however near that pose is.
TEST(ConstrainedDynamicsTest, NearAChangePointAccelerationsAreThoseOfTheBranchThatTheMotionIsOn) {
  const Eigen::Vector3d N(1, -1, 1);
  for (const double off : {0.5, 1e-1, 1e-2, 1e-3, 1e-4}) {
    Tied tied(rrr_chain(), {pin(1, 0)});
    const double rate = 1.5;
    const State s{{off, -off, off - std::numbers::pi}, {rate, -rate, rate}, {}, {1, 0.3, -0.2}};
    EXPECT_EQ(tied.move(s), ConstraintStatus::regular) << off;
    const Equations e = equations_of(tied, s);
    const double expected = N.dot(e.free_force) / N.dot(e.M * N);
    // The rows' round-off, which the distance from the singular pose magnifies.
    EXPECT_LT((tied.qdd() - N * expected).cwiseAbs().maxCoeff(), 1e-13 / off) << off;
  }
  // At the change point one row moves nothing, and what its branches have in common is all that the other one says.
  Tied tied(rrr_chain(), {pin(1, 0)});
  const State s{{0, 0, -std::numbers::pi}, {1, -1, 1}, {}, {1, 0.3, -0.2}};
  EXPECT_EQ(tied.move(s), ConstraintStatus::redundant);
  EXPECT_EQ(tied.cws.rank, 1);
  EXPECT_LT((tied.Jc() * tied.qdd() + tied.Jcd_qd()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(tied.qdd().cwiseAbs().maxCoeff(), 100);
}

TEST(ConstrainedDynamicsTest, WhatIsNoNumberIsReported) {
  Tied tied(rrr_chain(), {pin()});
  EXPECT_EQ(tied.move({{0.1, 0.2, 0.3}, {NAN, 0, 0}, {}, {0, 0, 0}}), ConstraintStatus::not_finite);
}

TEST(ConstrainedDynamicsTest, AllocatesNothing) {
  Random random(611);
  for (const Chain& chain :
       {rrr_chain(), arm_chain(2), planar_serial_chain(40), random_tree(612, {.bodies = 12, .mimic = 0.3})}) {
    const std::string tip = chain.frames.back().name;
    Tied tied(chain, {PointConstraint{tip, kOrigin}, DistanceConstraint{"base", tip, 1},
                      PointConstraint{tip, kOrigin}});
    const State s = random_state(chain, random);
    const long before = allocation_count();
    tied.move(s);
    EXPECT_EQ(allocation_count() - before, 0) << chain.name;
  }
}

}  // namespace
}  // namespace chainreel::test
