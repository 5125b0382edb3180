#include "dynamics/kernel_planar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/scalar.hpp"
#include "dynamics/aba.hpp"
#include "dynamics/compare.hpp"
#include "dynamics/crba.hpp"
#include "dynamics/forward_dynamics.hpp"
#include "support/chains.hpp"

namespace chainreel::testing {
namespace {

// Serial, revolute, axes along and against the normal, centres of mass anywhere, gravity in any direction.
Chain any_small_chain(std::uint64_t seed) {
  return random_planar_tree(seed, {.bodies = 1 + int(seed % 4), .serial = true, .prismatic = 0},
                            seed % 3 != 0);
}

// Torque behind the difference of two accelerations, against the torques at work.
double difference(Workspace& ws, const Chain& chain, const State& s, ConstVec a, ConstVec b) {
  compute_mass_matrix(chain, ws, s.q);
  const Eigen::VectorXd torque = ws.M * (as_vector(a) - as_vector(b));
  return torque.cwiseAbs().maxCoeff() / (ws.M.cwiseAbs() * as_vector(b).cwiseAbs()).maxCoeff();
}

TEST(PlanarKernelTest, EqualsTheArticulatedBodyAlgorithm) {
  Random random(121);
  for (std::uint64_t seed = 120; seed < 220; ++seed) {
    const Chain chain = any_small_chain(seed);
    ASSERT_TRUE(planar_kernel_of(chain).run) << chain.why_algebra;
    Workspace ws(chain);
    const State s = random_state(chain, random, 5);
    compute_aba(chain, ws, s.q, s.qd, s.tau);
    const std::vector<double> qdd = ws.qdd;
    compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
    EXPECT_LT(difference(ws, chain, s, ws.qdd, qdd), 1e-12) << chain.name;  // some hundred rounded operations

    const Chain other = with_changed_mass(chain, chain.nv, 1 + 1e-6);
    Workspace ws_other(other);
    compute_forward_dynamics(other, ws_other, s.q, s.qd, s.tau);
    EXPECT_GT(difference(ws, chain, s, ws_other.qdd, qdd), 1e-12) << chain.name;
  }
}

TEST(PlanarKernelTest, HasTheSameBitsOnEveryProcessor) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has only one way";
  Random random(122);
  for (std::uint64_t seed = 120; seed < 140; ++seed) {
    const Chain chain = any_small_chain(seed);
    const PlanarKernel kernel = planar_kernel_of(chain);
    for (const bool along_x : {false, true}) {
      for (const bool turned : {false, true}) {
        for (int k = 0; k < 50; ++k) {
          State s = random_state(chain, random, 5);
          if (k % 10 == 0) s.q[0] *= 1e6;  // rare angles
          std::vector<double> narrow(s.qd.size()), wide(s.qd.size());
          planar_kernel_for_any_processor(chain.nv, along_x, turned)(kernel, s.q.data(), s.qd.data(),
                                                                     s.tau.data(), narrow.data());
          planar_kernel_for_avx2(chain.nv, along_x, turned)(kernel, s.q.data(), s.qd.data(), s.tau.data(),
                                                            wide.data());
          EXPECT_EQ(narrow, wide);
        }
      }
    }
  }
}

// A kernel that hands out the cosine (or sine) of one absolute angle: unit inertias, no coupling, one link
// that weighs.
double by_kernel(int joints, std::size_t link, bool sine, const std::vector<double>& q) {
  PlanarKernel kernel;
  kernel.A_ii.fill(1);
  kernel.A_11_inv = kernel.A_11_A_22 = 1;
  kernel.h_x[link] = 1;
  kernel.g_x.fill(sine ? -1 : 0);
  kernel.g_y.fill(sine ? 0 : 1);
  const std::vector<double> zero(4, 0.0);
  std::vector<double> qdd(4, 0.0);
  planar_kernel_for_any_processor(joints, true, false)(kernel, q.data(), zero.data(), zero.data(),
                                                       qdd.data());
  return qdd[link];
}

TEST(PlanarKernelTest, SinesHaveTheBitsOfTheScalarFunction) {
  Random random(123);
  const double half_pi = 0x1.921fb54442d18p0;
  std::vector<double> angles{0,   1e-300,    1e-9,    half_pi, 2 * half_pi, 3 * half_pi,
                             1e5, 1048575.9, 1048577, 1e22,    1e300};
  for (int k = 0; k < 20000; ++k)
    angles.push_back(random.between(-1, 1) * std::pow(10.0, random.between(-3, 6)));
  for (const double angle : angles) {
    for (int joints = 1; joints <= 4; ++joints) {
      std::vector<double> q(4, 0.0);
      q[0] = angle;
      const auto link = std::size_t(joints - 1);
      const auto [s, c] = sin_cos(angle);
      ASSERT_EQ(by_kernel(joints, link, false, q), c) << angle;
      ASSERT_EQ(by_kernel(joints, link, true, q), s) << angle;
    }
  }
  EXPECT_NE(by_kernel(2, 0, true, {1.0, 0}), sin_cos(std::nextafter(1.0, 2.0)).s);
}

TEST(PlanarKernelTest, NanAndInfinityComeOutAsNan) {
  const Chain chain = rr_chain();
  Workspace ws(chain);
  const std::vector<double> qd{0, 0}, tau{0, 0};
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    compute_forward_dynamics(chain, ws, std::vector<double>{bad, 0}, qd, tau);
    EXPECT_TRUE(std::isnan(ws.qdd[0]) && std::isnan(ws.qdd[1]));
  }
}

// An unstable equilibrium is held exactly: no rotation of constants may let the chain fall.
TEST(PlanarKernelTest, AnUprightPendulumStaysUpright) {
  Chain chain = rr_chain();
  chain.bodies[1].inertia.com = {0, 1, 0};
  chain.bodies[2].inertia.com = {0, 1, 0};
  chain.bodies[2].joint.X_PJ = Eigen::Isometry3d(Eigen::Translation3d(0, 1, 0));
  finish(chain);
  Workspace ws(chain);
  const std::vector<double> zero{0, 0};
  compute_forward_dynamics(chain, ws, zero, zero, zero);
  EXPECT_EQ(ws.qdd, zero);
}

TEST(PlanarKernelTest, OtherChainsAreLeftToTheRecursions) {
  EXPECT_FALSE(planar_kernel_of(pp_chain()).run);
  EXPECT_FALSE(planar_kernel_of(arm_chain(1)).run);
  EXPECT_FALSE(planar_kernel_of(planar_serial_chain(5)).run);
  EXPECT_FALSE(
      planar_kernel_of(random_planar_tree(5, {.bodies = 3, .prismatic = 0})).run);  // two on one parent
  EXPECT_EQ(forward_dynamics_algorithm(rr_chain()), "planar, unrolled for 2 joints");
  EXPECT_EQ(forward_dynamics_algorithm(pp_chain()), "planar ABA");
  EXPECT_EQ(forward_dynamics_algorithm(random_tree(82, {.bodies = 12, .mimic = 0.4})),
            "spatial CRBA and LDL^T");
}

}  // namespace
}  // namespace chainreel::testing
