// Newton-Euler and Lagrange lead to the same equations of motion.
#include <algorithm>

#include "dynamics/lagrange.hpp"

#include <gtest/gtest.h>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

// Largest difference of M, tau_g, nle, and of the torque behind the accelerations, each against its own size.
double difference(const Chain& chain, const Chain& chain_of_lagrange, const State& s) {
  const LagrangeDynamics lagrange = lagrange_dynamics_of(chain_of_lagrange, s.q, s.qd, s.tau);
  Workspace ws(chain);
  compute_mass_matrix(chain, ws, s.q);
  compute_gravity_torque(chain, ws, s.q);
  compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
  compute_nle(chain, ws, s.q, s.qd);
  double largest = relative_difference(lagrange.M, ws.M);
  largest = std::max(largest, relative_difference(Eigen::MatrixXd(lagrange.tau_g), as_vector(ws.tau_g)));
  largest = std::max(largest, relative_difference(Eigen::MatrixXd(lagrange.nle), as_vector(ws.nle)));
  const Eigen::VectorXd torque = ws.M * (lagrange.qdd - as_vector(ws.qdd));
  const double scale = (ws.M.cwiseAbs() * as_vector(ws.qdd).cwiseAbs()).maxCoeff();
  return std::max(largest, torque.cwiseAbs().maxCoeff() / scale);
}

// The issue is the same equations, not the same operations: round-off of some thousand operations.
constexpr double kLagrangeTolerance = 1e-10;

TEST(LagrangeTest, EqualsNewtonEulerOnTwoHundredTrees) {
  Random random(91);
  for (std::uint64_t seed = 100; seed < 300; ++seed) {
    // 2 to 40 bodies, most of them small: the cost grows with the cube of the number
    const int bodies = seed % 20 == 0 ? 40 : 2 + random.below(13);
    TreeOptions options{.bodies = bodies, .serial = seed % 4 == 1, .floating_base = seed % 5 == 2};
    options.floating = seed % 3 == 0 ? 0.1 : 0;
    options.mimic = seed % 4 == 3 ? 0.3 : 0;
    options.massless = seed % 2 == 0 ? 0.1 : 0;
    const Chain chain = seed % 10 == 9 ? random_planar_tree(seed, options) : random_tree(seed, options);
    EXPECT_LT(difference(chain, chain, random_state(chain, random)), kLagrangeTolerance) << chain.name;
  }
}

TEST(LagrangeTest, EqualsNewtonEulerOnTheLecturesChains) {
  Random random(92);
  for (const Chain& chain : {rr_chain(), rrr_chain(), pp_chain(), arm_chain(6)}) {
    for (int k = 0; k < 20; ++k) {
      EXPECT_LT(difference(chain, chain, random_state(chain, random)), kLagrangeTolerance) << chain.name;
    }
  }
}

TEST(LagrangeTest, AnotherMassGivesOtherEquations) {
  Random random(93);
  const Chain chain = random_tree(94, {.bodies = 6, .floating_base = true});
  const Chain other = with_changed_mass(chain, 6, 1 + 1e-8);
  EXPECT_GT(difference(chain, other, random_state(chain, random)), kLagrangeTolerance);
}

TEST(LagrangeTest, FrictionIsSubtractedHereToo) {
  Chain chain = random_tree(95, {.bodies = 5, .mimic = 0.4});
  for (Body& body : chain.bodies) body.joint.damping = 0.7, body.joint.friction = 0.2;
  Random random(96);
  const State s = random_state(chain, random);
  Chain rough = chain;
  rough.has_dissipation = true;
  EXPECT_LT(difference(rough, rough, s), kLagrangeTolerance);
  EXPECT_GT(difference(rough, chain, s), kLagrangeTolerance);
}

// The lecture's first example: a particle that moves vertically, m xdd = f - m g.
TEST(LagrangeTest, AVerticalParticleFallsWithG) {
  Chain chain = pp_chain();
  chain.bodies.pop_back();
  chain.bodies[1].joint.axis = Eigen::Vector3d::UnitY();
  chain.bodies[1].inertia.mass = 2;
  finish(chain);
  const std::vector<double> q{0.4}, qd{3}, tau{5};
  const LagrangeDynamics lagrange = lagrange_dynamics_of(chain, q, qd, tau);
  EXPECT_EQ(lagrange.M(0, 0), 2);
  EXPECT_EQ(lagrange.tau_g(0), 2 * 9.81);
  EXPECT_EQ(lagrange.nle(0), 2 * 9.81);
  EXPECT_EQ(lagrange.qdd(0), (5 - 2 * 9.81) / 2);
}

}  // namespace
}  // namespace chainreel::test
