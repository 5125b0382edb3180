#include "dynamics/effective_mass.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

EffectiveMass rr_effective_mass(const Chain& chain, double q2_deg) {
  Workspace ws(chain);
  return effective_mass_of(chain, ws, std::vector<double>{0, q2_deg * kDegree}, chain.end_effector,
                           Task::linear);
}

// Published for L = 1 m and m = 1 kg: design values of Modern Robotics, ch. 8.1.1, with four decimals.
TEST(EffectiveMassTest, HasThePublishedValuesOfRr) {
  const EffectiveMass at_90 = rr_effective_mass(rr_chain(), 90);
  const EffectiveMass at_150 = rr_effective_mass(rr_chain(), 150);
  ASSERT_TRUE(at_90.Lambda && at_150.Lambda);
  const double half_digit = 0.5e-4;
  EXPECT_LT((*at_90.Lambda - Eigen::Matrix2d{{1, 0}, {0, 2}}).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((*at_150.Lambda - Eigen::Matrix2d{{4, -1.7321}, {-1.7321, 2}}).cwiseAbs().maxCoeff(), half_digit);
  EXPECT_LT((at_90.Lambda_inv - Eigen::Matrix2d{{1, 0}, {0, 0.5}}).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(at_90.basis.names, (std::vector<std::string>{"x", "y"}));

  const EffectiveMass heavier = rr_effective_mass(rr_chain({.m2 = 1.001}), 150);
  EXPECT_GT((*heavier.Lambda - Eigen::Matrix2d{{4, -1.7321}, {-1.7321, 2}}).cwiseAbs().maxCoeff(),
            half_digit);
}

TEST(EffectiveMassTest, StretchedRrHasInfiniteMassAlongX) {
  const EffectiveMass stretched = rr_effective_mass(rr_chain(), 0);
  EXPECT_FALSE(stretched.Lambda);
  ASSERT_EQ(stretched.singular_directions.size(), 1u);
  EXPECT_EQ(stretched.singular_directions[0], Eigen::Vector2d(1, 0));
  EXPECT_EQ(stretched.mobility(0), 0);
  // M = [[5, 2], [2, 1]] and the row (2, 1) of y: (2, 1) M^-1 (2, 1)^T = 1
  EXPECT_NEAR(stretched.mobility(1), 1, 8 * kRoundOff);
  EXPECT_TRUE(stretched.Lambda_inv.allFinite());
}

// J = 1 and M = diag(2e6 + 0.5, 0.5): an axis is heavy beside another one, and no pose is singular.
TEST(EffectiveMassTest, HeavyAxesAreFinite) {
  Chain gantry = pp_chain();
  gantry.bodies[1].inertia.mass = gantry.planar->bodies[1].mass = 2e6;
  gantry.bodies[2].inertia.mass = gantry.planar->bodies[2].mass = 0.5;
  Workspace ws(gantry);
  const auto at = [&](const Chain& chain) { return effective_mass_of(chain, ws, std::vector<double>{0.3, 0.1}, chain.end_effector, Task::linear); };
  const EffectiveMass heavy = at(gantry);
  ASSERT_TRUE(heavy.Lambda);
  EXPECT_LT((*heavy.Lambda - Eigen::Matrix2d{{2e6 + 0.5, 0}, {0, 0.5}}).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(heavy.is_infinite, (std::vector<bool>{false, false}));
}

// All six coordinates of a flange: the smaller its inertia is, the larger are mobilities in 1/(kg m^2) beside those in 1/kg,
// at one and the same regular pose; and so are they for a robot of millimetres.
TEST(EffectiveMassTest, UnitsAndLightLinksMakeNoSingularPose) {
  const std::vector<double> pose{0.3, 0.4, -0.5, 0.2, 0.8, 1};
  for (const double inertia : {1e-3, 1e-5, 1e-7}) {
    Chain arm = arm_chain(7);
    Workspace sizes(arm);
    std::vector<double> q(pose);
    q.resize(std::size_t(arm.nq), 0.3);
    arm.bodies.back().inertia.mass = 0.02;
    arm.bodies.back().inertia.about_com = inertia * Eigen::Matrix3d::Identity();
    Workspace ws(arm);
    const EffectiveMass mass = effective_mass_of(arm, ws, q, arm.end_effector, Task::full);
    ASSERT_TRUE(mass.Lambda) << inertia;
    // What is lost to the condition of J and the scatter of the mobilities.
    EXPECT_LT((*mass.Lambda * mass.Lambda_inv - Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-6) << inertia;
  }
}

// Lambda's largest eigenvalue grows as 1/eps^2 towards the stretched pose, Lambda_inv stays finite.
TEST(EffectiveMassTest, GrowsWithTheInverseSquareOfTheDistanceToASingularPose) {
  const auto largest = [](double eps) {
    const EffectiveMass mass = rr_effective_mass(rr_chain(), eps / kDegree);
    return mass.Lambda ? 1 / mass.mobility(0) : -1;
  };
  // correct to O(eps^2)
  EXPECT_NEAR(largest(0.01) / largest(0.02), 4, 0.01);
  EXPECT_NEAR(largest(0.005) / largest(0.01), 4, 0.01);
}

// Lambda's larger eigenvalue is c / eps^2, with the same c for all small eps, of a square J and of one with more columns than rows.
TEST(EffectiveMassTest, IsSingularBelowTheStatedFraction) {
  const auto rr = [](double eps) { return rr_effective_mass(rr_chain(), eps / kDegree); };
  const auto rrr = [](double eps) {
    static const Chain chain = rrr_chain();
    Workspace ws(chain);
    return effective_mass_of(chain, ws, std::vector<double>{0.3, eps, 0}, chain.end_effector, Task::linear);
  };
  const auto scaled = [](const EffectiveMass& mass, double eps) { return mass.Lambda ? mass.Lambda->norm() * eps * eps : -1; };
  // What J knows of a pose is rounded to 2e-16 of lengths: some 1e-15 / eps, twice, and O(eps) of the law.
  const double of_rr = scaled(rr(1e-4), 1e-4), of_rrr = scaled(rrr(1e-4), 1e-4);
  EXPECT_GT(of_rr, 0);
  EXPECT_GT(of_rrr, 0);
  for (const double eps : {1e-5, 1e-6, 1e-8, 1e-10}) {
    EXPECT_NEAR(scaled(rr(eps), eps) / of_rr, 1, 1e-3 + 1e-14 / eps) << eps;
    EXPECT_NEAR(scaled(rrr(eps), eps) / of_rrr, 1, 1e-3 + 1e-14 / eps) << eps;
  }
  for (const EffectiveMass& mass : {rr(1e-14), rr(0), rrr(1e-14), rrr(0)}) {
    EXPECT_FALSE(mass.Lambda);
    ASSERT_EQ(mass.singular_directions.size(), 1u);
  }
  EXPECT_GT(std::abs(rr(1e-14).singular_directions[0](0)), 0.99999);
}

TEST(EffectiveMassTest, IsJMinvJtOfEveryChain) {
  Random random(71);
  std::vector<Chain> chains{rrr_chain(), arm_chain(5)};
  for (std::uint64_t seed = 70; seed < 75; ++seed) {
    chains.push_back(random_tree(seed, {.bodies = 9, .serial = true, .mimic = 0.3}));
    chains.push_back(random_tree(seed, {.bodies = 9, .floating_base = true}));
    chains.push_back(random_planar_tree(seed, {.bodies = 6, .serial = true}));
  }
  for (const Chain& chain : chains) {
    for (const Task task : {Task::linear, Task::full}) {
      const State s = random_state(chain, random);
      Workspace ws(chain);
      const EffectiveMass mass = effective_mass_of(chain, ws, s.q, chain.end_effector, task);
      compute_mass_matrix(chain, ws, s.q);
      compute_jacobian(chain, ws, s.q, chain.end_effector, task);
      // a factorisation with pivoting, by another library; round-off times the condition of M
      const Eigen::MatrixXd Lambda_inv = ws.J * ws.M.fullPivLu().solve(ws.J.transpose());
      EXPECT_LT(relative_difference(mass.Lambda_inv, Lambda_inv), 1e-10) << chain.name;
      EXPECT_GE(mass.mobility.minCoeff(), 0);
      if (!mass.Lambda) continue;
      const double condition = mass.mobility.maxCoeff() / mass.mobility.minCoeff();
      const Eigen::MatrixXd one = *mass.Lambda * mass.Lambda_inv;
      EXPECT_LT((one - Eigen::MatrixXd::Identity(one.rows(), one.cols())).cwiseAbs().maxCoeff(),
                1e-12 * condition)
          << chain.name;
    }
  }
}

TEST(EffectiveMassTest, AJointTooFewLeavesADirectionThatCannotMove) {
  Chain chain = pp_chain();
  chain.bodies.pop_back();
  finish(chain);
  Workspace ws(chain);
  const EffectiveMass mass =
      effective_mass_of(chain, ws, std::vector<double>{0.3}, chain.end_effector, Task::linear);
  EXPECT_FALSE(mass.Lambda);
  ASSERT_EQ(mass.singular_directions.size(), 1u);
  EXPECT_LT((mass.Lambda_inv - Eigen::Matrix2d{{1, 0}, {0, 0}}).cwiseAbs().maxCoeff(), 4 * kRoundOff);
  EXPECT_EQ(std::abs(mass.singular_directions[0](1)), 1);
}

TEST(EffectiveMassTest, AFixedFrameHasNoMobilityAndNoNan) {
  const Chain chain = rr_chain();
  Workspace ws(chain);
  const EffectiveMass mass = effective_mass_of(chain, ws, std::vector<double>{0.3, 1}, 0, Task::full);
  EXPECT_FALSE(mass.Lambda);
  EXPECT_EQ(mass.singular_directions.size(), 3u);
  EXPECT_TRUE(mass.Lambda_inv.isZero(0) && mass.directions.allFinite() && mass.mobility.isZero(0));
}

}  // namespace
}  // namespace chainreel::test
