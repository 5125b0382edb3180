#include <algorithm>

#include "dynamics/kinematics.hpp"

#include <gtest/gtest.h>

#include "dynamics/compare.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

// The path of the chain's definition: every joint's transform, one after the other.
Eigen::Isometry3d pose_by_transforms(const Chain& chain, const State& s, int body) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  for (int i = body; i > 0; i = chain.bodies[std::size_t(i)].parent) {
    const Joint& joint = chain.bodies[std::size_t(i)].joint;
    const double* q = &s.q[std::size_t(joint.q_index)];
    const double value = joint.ratio * *q + joint.offset;
    Eigen::Isometry3d X_J = Eigen::Isometry3d::Identity();
    if (joint.kind == JointKind::revolute)
      X_J.linear() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
    if (joint.kind == JointKind::prismatic) X_J.translation() = joint.axis * value;
    if (joint.kind == JointKind::floating) {
      X_J.linear() = Eigen::Quaterniond(q[6], q[3], q[4], q[5]).toRotationMatrix();
      X_J.translation() = Eigen::Vector3d(q[0], q[1], q[2]);
    }
    X = joint.X_PJ * X_J * X;
  }
  return X;
}

double pose_difference(const Chain& chain, const Workspace& ws, const State& s) {
  double largest = 0;
  for (int i = 1; i < int(chain.bodies.size()); ++i) {
    const Eigen::Isometry3d expected = pose_by_transforms(chain, s, i);
    largest = std::max(largest, relative_difference(ws.X_WB[std::size_t(i)].matrix(), expected.matrix()));
  }
  return largest;
}

TEST(KinematicsTest, PosesAreTheProductsOfTheJointsTransforms) {
  Random random(31);
  for (std::uint64_t seed = 30; seed < 40; ++seed) {
    const TreeOptions options{.bodies = 15, .floating_base = seed % 2 == 0, .floating = 0.1, .mimic = 0.2};
    const Chain tree = random_tree(seed, options);
    const Chain planar = random_planar_tree(seed, {.bodies = 15, .mimic = 0.2});
    ASSERT_TRUE(planar.planar);
    for (const Chain& chain : {tree, planar}) {
      State s = random_state(chain, random);
      Workspace ws(chain);
      compute_kinematics(chain, ws, s.q, s.qd);
      // up to 15 products of rotations; planar axes are parallel to 1e-12 only
      EXPECT_LT(pose_difference(chain, ws, s), 1e-12) << chain.name;
      s.q[0] += 1e-9;
      EXPECT_GT(pose_difference(chain, ws, s), 1e-12) << chain.name;
    }
  }
}

TEST(KinematicsTest, FramePoseIsTheBodysTimesTheFrames) {
  const Chain chain = arm_chain(4);
  Workspace ws(chain);
  Random random(32);
  const State s = random_state(chain, random);
  compute_kinematics(chain, ws, s.q, s.qd);
  const Eigen::Isometry3d X = pose_by_transforms(chain, s, 7) * chain.frames.back().X_BF;
  EXPECT_LT(relative_difference(frame_pose(chain, ws, chain.end_effector).matrix(), X.matrix()), 1e-14);
  EXPECT_LT((frame_position(chain, ws, chain.end_effector) - X.translation()).norm(), 1e-14);
}

Chain free_flyer() {
  return random_tree(33, {.bodies = 4, .floating_base = true, .floating = 0.5});
}

// The exponential is exact: two half steps along one twist are one whole step, also through small angles.
TEST(KinematicsTest, AdvancingAlongOneTwistComposes) {
  const Chain chain = free_flyer();
  Random random(34);
  const State s = random_state(chain, random);
  for (const double h : {1e-8, 1e-3, 0.1, 0.3, 1.0, 2.0}) {
    std::vector<double> once = s.q, twice = s.q;
    advance(chain, once, s.qd, h);
    advance(chain, twice, s.qd, h / 2);
    advance(chain, twice, s.qd, h / 2);
    EXPECT_LT(relative_difference(once, twice), 16 * kRoundOff) << h;
    std::vector<double> other = s.q;
    advance(chain, other, s.qd, h * (1 + 1e-5));
    EXPECT_GT(relative_difference(once, other), 16 * kRoundOff * (h > 1e-5 ? 1 : 0)) << h;
  }
}

TEST(KinematicsTest, RateIsTheDerivativeOfAdvancing) {
  const Chain chain = free_flyer();
  Random random(35);
  const State s = random_state(chain, random, 1);
  std::vector<double> q_dot(s.q.size());
  q_rate(chain, s.q, s.qd, q_dot);
  const auto error = [&](double h) {
    std::vector<double> ahead = s.q, behind = s.q;
    advance(chain, ahead, s.qd, h);
    advance(chain, behind, s.qd, -h);
    return ((as_vector(ahead) - as_vector(behind)) / (2 * h) - as_vector(q_dot)).norm();
  };
  EXPECT_NEAR(error(2e-3) / error(1e-3), 4, 0.05);  // central differences: order two
}

TEST(KinematicsTest, NormalizeMakesUnitQuaternionsAndMovesNothing) {
  const Chain chain = free_flyer();
  Random random(36);
  const State s = random_state(chain, random);
  State longer = s;
  for (const Body& body : chain.bodies) {
    if (body.joint.kind != JointKind::floating || body.name.empty()) continue;
    for (std::size_t k = 3; k < 7; ++k) longer.q[std::size_t(body.joint.q_index) + k] *= 1.5;
  }
  ASSERT_NE(longer.q, s.q);
  Workspace ws(chain);
  compute_kinematics(chain, ws, longer.q, s.qd);
  EXPECT_LT(pose_difference(chain, ws, s), 1e-14);  // poses never trusted the length
  normalize(chain, longer.q);
  EXPECT_LT(relative_difference(longer.q, s.q), 4 * kRoundOff);
}

TEST(KinematicsTest, WithoutFloatingJointsRateAndAdvanceAreTheCoordinatesOwn) {
  const Chain chain = random_tree(37, {.bodies = 6, .mimic = 0.5});
  Random random(38);
  const State s = random_state(chain, random);
  std::vector<double> q_dot(s.q.size()), q = s.q;
  q_rate(chain, s.q, s.qd, q_dot);
  EXPECT_EQ(q_dot, s.qd);
  advance(chain, q, s.qd, 0.25);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_EQ(q[i], s.q[i] + 0.25 * s.qd[i]);
}

}  // namespace
}  // namespace chainreel::test
