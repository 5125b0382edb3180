#include "dynamics/kernels/kernel_planar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/scalar.hpp"
#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kernels/kernels.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
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
    ASSERT_GT(planar_kernel_of(chain).joints, 0) << chain.why_algebra;
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

// A kernel that hands out the cosine (or sine) of one absolute angle: unit inertias, no coupling, one link
// that weighs.
double by_kernel(int joints, std::size_t link, bool sine, const std::vector<double>& q) {
  static const Chain chain = planar_serial_chain(4);
  static Workspace ws(chain);
  PlanarKernel kernel;
  kernel.joints = joints;
  kernel.along_x = false;
  kernel.A_ii.fill(1);
  kernel.A_11_inv = kernel.A_11_A_22 = 1;
  (sine ? kernel.pull_s : kernel.pull_c)[link] = sine ? -1 : 1;
  ws.scratch->planar_kernel = kernel;
  const std::vector<double> zero(4, 0.0);
  dynamics_of(kernel)(chain, ws, q, zero, zero, ws.qdd.data());
  return ws.qdd[link];
}

// In units in the last place of the exact value.
double error_in_ulps(double x, Quad exact) {
  const double size = std::fabs(value_of(exact));
  const double ulp = std::nextafter(size, 2 * size + 1) - size;
  return std::fabs(value_of((Quad(x) - exact) / Quad(ulp)));
}

// Two roundings count: of the angle that is left after the quarter turns, half a unit of an angle which may
// be the next power of two above its sine, and of the last sum, half a unit; the rest is some hundredths.
TEST(PlanarKernelTest, SinesAreRightToOneAndAHalfUnits) {
  Random random(123);
  const double half_pi = 0x1.921fb54442d18p0;
  std::vector<double> angles{1e-300, 1e-9,      half_pi, 2 * half_pi, 3 * half_pi,
                             1e5,    1048575.9, 1048577, 1e22,        1e300};
  for (int k = 0; k < 20000; ++k)
    angles.push_back(random.between(-1, 1) * std::pow(10.0, random.between(-3, 6)));
  for (const double angle : angles) {
    const auto [s, c] = sin_cos(Quad(angle));
    for (int joints = 1; joints <= 4; ++joints) {
      const std::vector<double> q{angle, 0, 0, 0};
      const auto link = std::size_t(joints - 1);
      ASSERT_LE(error_in_ulps(by_kernel(joints, link, false, q), c), 1.6) << angle;
      ASSERT_LE(error_in_ulps(by_kernel(joints, link, true, q), s), 1.6) << angle;
    }
  }
  EXPECT_GT(error_in_ulps(by_kernel(2, 0, true, {0.5, 0}), sin_cos(Quad(0.5 + 0x1p-50)).s), 1.6);
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
  EXPECT_EQ(planar_kernel_of(pp_chain()).joints, 0);
  EXPECT_EQ(planar_kernel_of(arm_chain(1)).joints, 0);
  EXPECT_EQ(planar_kernel_of(planar_serial_chain(5)).joints, 0);
  EXPECT_EQ(planar_kernel_of(random_planar_tree(5, {.bodies = 3, .prismatic = 0})).joints,
            0);  // two on one parent
  EXPECT_EQ(forward_dynamics_algorithm(rr_chain()), "planar, unrolled for 2 joints");
  EXPECT_EQ(forward_dynamics_algorithm(pp_chain()), "planar ABA");
  EXPECT_EQ(forward_dynamics_algorithm(random_tree(82, {.bodies = 12, .mimic = 0.4})),
            "spatial CRBA and LDL^T");
}

}  // namespace
}  // namespace chainreel::test
