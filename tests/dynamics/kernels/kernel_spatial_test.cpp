#include "dynamics/kernels/kernel_spatial.hpp"

#include <gtest/gtest.h>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kernels/kernels.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

// Serial chains and trees of 1 to 15 turning and sliding joints, some bodies without inertia.
Chain any_fitting_chain(std::uint64_t seed) {
  const int bodies = 1 + int(seed % 15);
  return random_tree(seed, {.bodies = bodies, .serial = seed % 2 == 0, .massless = seed % 3 == 0 ? 0.2 : 0});
}

// Torque behind the spatial_difference of two accelerations, against the torques at work.
double spatial_difference(Workspace& ws, const Chain& chain, const State& s, ConstVec a, ConstVec b) {
  compute_mass_matrix(chain, ws, s.q);
  const Eigen::VectorXd torque = ws.M * (as_vector(a) - as_vector(b));
  const double size = (ws.M.cwiseAbs() * as_vector(b).cwiseAbs()).maxCoeff();
  return torque.allFinite() ? torque.cwiseAbs().maxCoeff() / size : std::numeric_limits<double>::infinity();
}

double difference_from_aba(const Chain& chain, const Chain& chain_of_kernel, const State& s) {
  Workspace ws(chain), ws_of_kernel(chain_of_kernel);
  compute_aba(chain, ws, s.q, s.qd, s.tau);
  const std::vector<double> qdd = ws.qdd;
  compute_forward_dynamics(chain_of_kernel, ws_of_kernel, s.q, s.qd, s.tau);
  return spatial_difference(ws, chain, s, ws_of_kernel.qdd, qdd);
}

constexpr double kSpatialTolerance = 1e-12;  // some thousand operations, rounded at random

TEST(SpatialKernelTest, EqualsTheArticulatedBodyAlgorithm) {
  Random random(131);
  for (std::uint64_t seed = 130; seed < 280; ++seed) {
    const Chain chain = any_fitting_chain(seed);
    ASSERT_EQ(spatial_kernel_of(chain).joints, chain.nv);
    if (chain.planar) continue;
    const State s = random_state(chain, random, 3);
    EXPECT_LT(difference_from_aba(chain, chain, s), kSpatialTolerance) << chain.name;
    const Chain other = with_changed_mass(chain, chain.nv, 1 + 1e-6);
    EXPECT_GT(difference_from_aba(chain, other, s), kSpatialTolerance) << chain.name;
  }
}

TEST(SpatialKernelTest, ABaseFarFromTheOriginCostsNoDigits) {
  Random random(132);
  Chain chain = arm_chain(9);
  chain.bodies[1].joint.X_PJ.translation() += Eigen::Vector3d(1e6, -2e6, 3e6);
  const State s = random_state(chain, random, 3);
  EXPECT_LT(difference_from_aba(chain, chain, s), kSpatialTolerance);

  // and so on a rail
  Chain cart = random_tree(133, {.bodies = 6, .serial = true});
  cart.bodies[1].joint.kind = JointKind::prismatic;
  State far = random_state(cart, random, 3);
  far.q[0] = 1e6;
  EXPECT_LT(difference_from_aba(cart, cart, far), kSpatialTolerance);
}

TEST(SpatialKernelTest, NanComesOutAsNan) {
  const Chain chain = arm_chain(1);
  Workspace ws(chain);
  Random random(135);
  State s = random_state(chain, random);
  s.q[3] = std::numeric_limits<double>::quiet_NaN();
  compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
  EXPECT_FALSE(as_vector(ws.qdd).allFinite());
}

TEST(SpatialKernelTest, LongerFloatingAndMimicChainsAreLeftToTheRecursions) {
  EXPECT_EQ(spatial_kernel_of(random_tree(1, {.bodies = 16})).joints, 0);
  EXPECT_EQ(spatial_kernel_of(random_tree(1, {.bodies = 3, .floating_base = true})).joints, 0);
  EXPECT_EQ(spatial_kernel_of(random_tree(82, {.bodies = 12, .mimic = 0.4})).joints, 0);
  EXPECT_EQ(forward_dynamics_algorithm(arm_chain(1)), "spatial, CRBA and LDL^T about one point");
  EXPECT_EQ(forward_dynamics_algorithm(random_tree(1, {.bodies = 16})), "spatial ABA");
}

}  // namespace
}  // namespace chainreel::test
