// The kernels for constrained chains, in the plane and in space, against the general way.
#include <algorithm>

#include "dynamics/kernels/constrained_kernel.hpp"

#include <gtest/gtest.h>

#include "dynamics/constraints/constrained_cases.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel::test {
namespace {

// Condition of G up to 1e6.
constexpr double kConstrainedTolerance = 1e-9;

Chain damped(Chain chain) {
  chain.bodies[2].joint.damping = 0.7;
  chain.has_dissipation = true;
  return chain;
}

struct Pair {
  Pair(const Chain& chain, const std::vector<Constraint>& ties) : fast(chain, ties), general(chain, ties) {
    general.cws.kernel.run = nullptr;
  }
  double difference(const State& s) {
    EXPECT_EQ(fast.move(s), general.move(s)) << fast.chain.name;
    return std::max(relative_difference(fast.ws.qdd, general.ws.qdd),
                    relative_difference(fast.cws.lambda, general.cws.lambda));
  }
  Tied fast, general;
};

void expect_agreement(const Chain& chain, const std::vector<Constraint>& ties, Random& random) {
  Pair pair(chain, ties);
  ASSERT_NE(pair.fast.cws.kernel.run, nullptr) << chain.name;
  for (int k = 0; k < 30; ++k) EXPECT_LT(pair.difference(random_state(chain, random)), kConstrainedTolerance);
}

TEST(ConstrainedKernelTest, AgreesWithTheGeneralWayInThePlane) {
  Random random(706);
  const std::vector<std::vector<Constraint>> cases{
      {pen_line()},
      {pin()},
      {CloseConstraint{"gripper", "base"}},
      {DistanceConstraint{"base", "gripper", 1.3}},
      {DistanceConstraint{"gripper", "b1", 1.3}, PlaneConstraint{"b3", {0, 1, 0}, {1, 2, 0}}},
      {pin(), pin()}};
  for (const auto& ties : cases) {
    expect_agreement(rrr_chain(), ties, random);
    expect_agreement(damped(rrr_chain()), ties, random);
  }
}

// Of the last frame, at the end of all bodies.
std::vector<std::vector<Constraint>> ties_in_space(const std::string& tip) {
  const PointConstraint pinned{tip, {0.3, -0.2, 0.4}};
  return {{pinned},
          {PlaneConstraint{tip, {0, 0, 1}, {1, 2, 3}}},
          {LineConstraint{tip, {0, 0, 1}, {1, 2, 3}}},
          {DistanceConstraint{"base", tip, 0.7}},
          {DistanceConstraint{"b2", tip, 0.7}, PlaneConstraint{"b3", {0, 1, 0}, {1, 2, 0}}},
          {CloseConstraint{tip, "b1"}},
          {pinned, pinned}};
}

TEST(ConstrainedKernelTest, AgreesWithTheGeneralWayInSpace) {
  Random random(707);
  for (const int bodies : {4, 7, 9, 15}) {
    const Chain chain = random_tree(std::uint64_t(720 + bodies), {.bodies = bodies, .serial = true});
    for (const auto& ties : ties_in_space(chain.frames.back().name)) {
      expect_agreement(chain, ties, random);
      expect_agreement(damped(chain), ties, random);
    }
  }
}

TEST(ConstrainedKernelTest, AgreesWithTheGeneralWayInTrees) {
  Random random(708);
  int moving = 0;
  for (std::uint64_t seed = 740; seed < 760; ++seed) {
    const Chain chain = random_tree(seed, {.bodies = 10, .serial = false});
    const std::vector<Constraint> ties{DistanceConstraint{"b4", "b8", 0.8}};
    Pair pair(chain, ties);
    if (pair.fast.set.rows() == 0 || pair.fast.cws.kernel.run == nullptr) continue;
    const State s = random_state(chain, random);
    // A rod between places that no joint moves apart leaves a row of round-off.
    if (pair.general.move(s) != ConstraintStatus::regular || std::abs(pair.general.cws.lambda[0]) > 1e6)
      continue;
    EXPECT_LT(pair.difference(s), kConstrainedTolerance) << seed;
    ++moving;
  }
  EXPECT_GT(moving, 10);
}

TEST(ConstrainedKernelTest, DiffersWhereOnePlaceDoes) {
  Random random(709);
  const Chain chain = random_tree(727, {.bodies = 7, .serial = true});
  const std::string tip = chain.frames.back().name;
  Tied here(chain, {DistanceConstraint{"base", tip, 0.7}});
  Tied there(chain, {DistanceConstraint{"b1", tip, 0.7}});
  const State s = random_state(chain, random);
  here.move(s);
  there.move(s);
  EXPECT_GT(relative_difference(here.ws.qdd, there.ws.qdd), 1e3 * kConstrainedTolerance);
}

TEST(ConstrainedKernelTest, LeavesSingularPosesAndOtherRowsToTheGeneralWay) {
  Random random(710);
  const Chain arm = random_tree(727, {.bodies = 7, .serial = true});
  const std::string tip = arm.frames.back().name;
  const Tied welded(arm, {CloseConstraint{tip, "base", Closure::weld}});
  EXPECT_EQ(welded.cws.kernel.run, nullptr);
  const Tied four(arm, {PointConstraint{tip, kOrigin}, DistanceConstraint{"b2", tip, 0.7}});
  EXPECT_EQ(four.cws.kernel.run, nullptr);

  // Two planes a hair apart: their rows depend on each other.
  Pair pair(arm,
            {PlaneConstraint{tip, kOrigin, {0, 0, 1}}, PlaneConstraint{tip, {0, 0, 1e-3}, {0, 1e-9, 1}}});
  ASSERT_NE(pair.fast.cws.kernel.run, nullptr);
  const State s = random_state(arm, random);
  EXPECT_EQ(pair.fast.move(s), pair.general.move(s));
  EXPECT_LT(relative_difference(pair.fast.ws.qdd, pair.general.ws.qdd), kConstrainedTolerance);
}

}  // namespace
}  // namespace chainreel::test
