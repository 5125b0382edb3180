// Chains in numbers move like the models whose numbers they are, and like what books write of them.
#include "model/link_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"
#include "model/read_chain.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

Chain chain_in_numbers(LinkChain links) {
  EXPECT_TRUE(complete(links).empty());
  ModelSource source("scene.yaml");
  source.links = links;
  return read_chain(source);
}

// Largest relative difference of M and nle, and of the gripper's place in m, over 50 states.
double difference_of_chains(const Chain& a, const Chain& b) {
  Random random(7);
  Workspace wa(a), wb(b);
  double largest = 0;
  for (int k = 0; k < 50; ++k) {
    const State s = random_state(a, random, 3);
    compute_mass_matrix(a, wa, s.q), compute_mass_matrix(b, wb, s.q);
    compute_nle(a, wa, s.q, s.qd), compute_nle(b, wb, s.q, s.qd);
    largest = std::max({largest, relative_difference(wa.M, wb.M), relative_difference(wa.nle, wb.nle)});
    compute_kinematics(a, wa, s.q, s.qd), compute_kinematics(b, wb, s.q, s.qd);
    largest = std::max(largest, (frame_position(a, wa, a.end_effector) - frame_position(b, wb, b.end_effector)).norm());
  }
  return largest;
}

// Round-off of some hundred operations on numbers of size 1.
constexpr double kRounding = 1e-13;

TEST(LinkChain, IsTheModelWhoseNumbersItHas) {
  const LinkChain rr{.links = {1, 1}, .masses = {1}, .shape = LinkMass::point};
  EXPECT_EQ(difference_of_chains(chain_in_numbers(rr), read_chain("models/rr.urdf")), 0);
  EXPECT_LT(difference_of_chains(chain_in_numbers({.links = {1, 1, 1}, .masses = {1}}), read_chain("models/rrr.urdf")), kRounding);
  const LinkChain pp{.links = {0}, .masses = {1, 1}, .joints = "PP", .shape = LinkMass::point};
  LinkChain both = pp;
  both.links = {0, 0};
  EXPECT_EQ(difference_of_chains(chain_in_numbers(both), read_chain("models/pp.urdf")), 0);
  // Negative control.
  EXPECT_GT(difference_of_chains(chain_in_numbers({.links = {1, 1.001}, .masses = {1}, .shape = LinkMass::point}),
                                 read_chain("models/rr.urdf")),
            1e-4);
}

TEST(LinkChain, OfPointMassesHasTheEquationsOfTheBook) {
  const RR rr{.L1 = 0.7, .L2 = 0.4, .m1 = 2, .m2 = 1.5};
  const LinkChain links{.links = {0.7, 0.4}, .masses = {2, 1.5}, .shape = LinkMass::point};
  EXPECT_LT(difference_of_chains(chain_in_numbers(links), rr_chain(rr)), kRounding);
}

// M11 = m1 L1^2 / 3 + m2 (L1^2 + L1 L2 c2 + L2^2 / 3), M12 = m2 (L1 L2 c2 / 2 + L2^2 / 3), M22 = m2 L2^2 / 3;
// tau_g = [(m1 / 2 + m2) L1 g c1 + m2 L2 g c12 / 2, m2 L2 g c12 / 2].
TEST(LinkChain, OfRodsHasTheEquationsOfTheLecture) {
  const double L1 = 0.5, L2 = 0.4, m1 = 2, m2 = 1.5, g = 9.81;
  const Chain chain = chain_in_numbers({.links = {L1, L2}, .masses = {m1, m2}, .joints = "RR"});
  EXPECT_TRUE(chain.planar);
  Workspace ws(chain);
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    const State s = random_state(chain, random, 3);
    const double c1 = std::cos(s.q[0]), c2 = std::cos(s.q[1]), c12 = std::cos(s.q[0] + s.q[1]);
    Eigen::Matrix2d M;
    M(0, 0) = m1 * L1 * L1 / 3 + m2 * (L1 * L1 + L1 * L2 * c2 + L2 * L2 / 3);
    M(0, 1) = M(1, 0) = m2 * (L1 * L2 * c2 / 2 + L2 * L2 / 3);
    M(1, 1) = m2 * L2 * L2 / 3;
    compute_mass_matrix(chain, ws, s.q);
    compute_gravity_torque(chain, ws, s.q);
    EXPECT_LT(relative_difference(ws.M, M), kRounding);
    const Eigen::Vector2d tau_g((m1 / 2 + m2) * L1 * g * c1 + m2 * L2 * g * c12 / 2, m2 * L2 * g * c12 / 2);
    EXPECT_LT((as_vector(ws.tau_g) - tau_g).norm(), kRounding * 100);
  }
}

TEST(LinkChain, HasTheDampingAndTheAxesThatWereAskedFor) {
  const Chain chain = chain_in_numbers({.links = {0.5, 0.4, 0.3}, .masses = {1}, .damping = {0.1, 0, 2}, .joints = "RzRyPx"});
  ASSERT_EQ(chain.bodies.size(), 4u);
  EXPECT_EQ(chain.bodies[1].joint.damping, 0.1);
  EXPECT_EQ(chain.bodies[3].joint.damping, 2);
  EXPECT_EQ(chain.bodies[2].joint.axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(chain.bodies[3].joint.kind, JointKind::prismatic);
  EXPECT_FALSE(chain.planar);
  EXPECT_EQ(chain.gravity, Eigen::Vector3d(0, 0, -9.81));
}

// An arm with waist, shoulder and elbow: x = c1 r, y = s1 r, z = d1 + a2 s2 + a3 s23 with r = a2 c2 + a3 c23.
TEST(DhTable, OfAnElbowArmPutsTheGripperWhereThePencilDoes) {
  const double d1 = 0.6, a2 = 0.5, a3 = 0.4;
  const Chain arm = chain_in_numbers({.dh = {{0, std::numbers::pi / 2, d1, 0}, {a2, 0, 0, 0}, {a3, 0, 0, 0}}});
  Workspace ws(arm);
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const State s = random_state(arm, random, 1);
    compute_kinematics(arm, ws, s.q, s.qd);
    const double r = a2 * std::cos(s.q[1]) + a3 * std::cos(s.q[1] + s.q[2]);
    const Eigen::Vector3d place(std::cos(s.q[0]) * r, std::sin(s.q[0]) * r,
                                d1 + a2 * std::sin(s.q[1]) + a3 * std::sin(s.q[1] + s.q[2]));
    EXPECT_LT((frame_position(arm, ws, arm.end_effector) - place).norm(), 1e-14);
  }
}

TEST(DhTable, OfAPlanarArmIsTheChainOfItsLengths) {
  const Chain rows = chain_in_numbers({.dh = {{0.5, 0, 0, 0}, {0.4, 0, 0, 0}}, .masses = {2, 1.5}});
  EXPECT_LT(difference_of_chains(rows, chain_in_numbers({.links = {0.5, 0.4}, .masses = {2, 1.5}})), kRounding);
}

Eigen::Isometry3d turn_of_row(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, axis));
}
Eigen::Isometry3d shift_of_row(double x, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0, z));
}

// The product of the rows' transforms, as books define both conventions.
TEST(DhTable, OfAnyRowsIsTheProductOfTheirTransforms) {
  Random random(11);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  for (const DhConvention convention : {DhConvention::standard, DhConvention::modified}) {
    for (int k = 0; k < 20; ++k) {
      LinkChain links{.convention = convention};
      for (int i = 0; i < 5; ++i) {
        links.dh.push_back({random.between(-1, 1), random.between(-3, 3), random.between(-1, 1), random.between(-3, 3)});
        links.joints += random.below(3) == 0 ? 'P' : 'R';
      }
      const Chain chain = chain_in_numbers(links);
      const State s = random_state(chain, random, 2);
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      for (std::size_t i = 0; i < 5; ++i) {
        const auto& [a, alpha, d, theta] = links.dh[i];
        const bool slides = links.joints[i] == 'P';
        const Eigen::Isometry3d of_joint = turn_of_row(theta + (slides ? 0 : s.q[i]), z) * shift_of_row(0, d + (slides ? s.q[i] : 0));
        const Eigen::Isometry3d of_link = shift_of_row(a, 0) * turn_of_row(alpha, x);
        T = convention == DhConvention::standard ? T * of_joint * of_link : T * of_link * of_joint;
      }
      Workspace ws(chain);
      compute_kinematics(chain, ws, s.q, s.qd);
      EXPECT_LT((frame_pose(chain, ws, chain.end_effector).matrix() - T.matrix()).norm(), 1e-13) << to_string(convention);
    }
  }
}

}  // namespace
}  // namespace chainreel::test
