#include "dynamics/energy.hpp"

#include <gtest/gtest.h>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

TEST(EnergyTest, RrAtRestStretchedOut) {
  const Chain chain = rr_chain();
  Workspace ws(chain);
  const std::vector<double> q{0, 0}, qd{0, 0}, up{std::acos(0.0), 0};
  EXPECT_EQ(energy_of(chain, ws, q, qd).total(), 0);
  EXPECT_NEAR(energy_of(chain, ws, up, qd).potential, 9.81 * (1 + 2), 16 * kRoundOff * 30);
}

// dE/dt = qd^T (tau - tau_f). E along the motion, to second order: q (+) (qd h + qdd h^2/2), qd + qdd h.
double power_error(const Chain& chain, const State& s, double h, double torque_factor) {
  Workspace ws(chain);
  compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
  const std::vector<double> qdd = ws.qdd;
  compute_friction(chain, ws, s.qd);
  const double power = torque_factor * as_vector(s.qd).dot(as_vector(s.tau) - as_vector(ws.tau_f));

  const auto energy_at = [&](double t) {
    std::vector<double> q = s.q, mean = s.qd, qd = s.qd;
    for (std::size_t i = 0; i < qd.size(); ++i) {
      qd[i] += t * qdd[i];
      mean[i] += t / 2 * qdd[i];
    }
    advance(chain, q, mean, t);
    return energy_of(chain, ws, q, qd).total();
  };
  return std::abs((energy_at(h) - energy_at(-h)) / (2 * h) - power);
}

TEST(EnergyTest, ChangesByThePowerOfTheTorques) {
  Random random(41);
  for (std::uint64_t seed = 40; seed < 50; ++seed) {
    Chain chain =
        random_tree(seed, {.bodies = 8, .floating_base = seed % 2 == 0, .floating = 0.1, .mimic = 0.2});
    for (Body& body : chain.bodies) body.joint.damping = 0.3;
    chain.has_dissipation = true;
    const Chain planar = random_planar_tree(seed, {.bodies = 8, .mimic = 0.2});
    for (const Chain& c : {chain, planar}) {
      const State s = random_state(c, random, 1);
      // Central differences: a quarter of the error at half the step. A wrong power leaves an error that
      // stays.
      EXPECT_NEAR(power_error(c, s, 4e-4, 1) / power_error(c, s, 2e-4, 1), 4, 0.2) << c.name;
      EXPECT_LT(power_error(c, s, 4e-4, 1.1) / power_error(c, s, 2e-4, 1.1), 2) << c.name;
    }
  }
}

TEST(EnergyTest, IsTheSumOverBodies) {
  Random random(55);
  const Chain chain = random_tree(56, {.bodies = 9, .floating_base = true, .mimic = 0.3});
  Workspace ws(chain);
  const State s = random_state(chain, random);
  Energy sum;
  Momentum momentum;
  const std::vector<BodyEnergy> bodies = body_energies_of(chain, ws, s.q, s.qd);
  ASSERT_EQ(bodies.size(), chain.bodies.size());
  for (const BodyEnergy& body : bodies) {
    sum.kinetic += body.energy.kinetic;
    sum.potential += body.energy.potential;
    momentum.linear += body.momentum.linear;
    momentum.angular += body.momentum.angular;
  }
  EXPECT_EQ(bodies[0].energy.total(), 0);
  EXPECT_EQ(sum.kinetic, energy_of(chain, ws, s.q, s.qd).kinetic);
  EXPECT_EQ(sum.potential, energy_of(chain, ws, s.q, s.qd).potential);
  EXPECT_EQ(momentum.linear, momentum_of(chain, ws, s.q, s.qd).linear);
  EXPECT_EQ(momentum.angular, momentum_of(chain, ws, s.q, s.qd).angular);
}

TEST(MomentumTest, IsMassTimesVelocityOfTheMassCenter) {
  Random random(57);
  for (const Chain& chain : {random_tree(58, {.bodies = 9, .floating_base = true}), rrr_chain()}) {
    Workspace ws(chain);
    const State s = random_state(chain, random);
    const MassCenter center = mass_center_of(chain, ws, s.q, s.qd);
    const Momentum momentum = momentum_of(chain, ws, s.q, s.qd);
    EXPECT_LT((momentum.linear - center.mass * center.velocity).norm(),
              16 * kRoundOff * momentum.linear.norm());
    EXPECT_NEAR(energy_of(chain, ws, s.q, s.qd).potential, -center.mass * chain.gravity.dot(center.position),
                1e-12);
  }
}

// Newton and Euler about the world's origin: P' = m g + f, L' = c x m g + moment of the base's wrench. The
// torques of inner joints cancel.
TEST(MomentumTest, ChangesByGravityAndTheBasesWrenchAlone) {
  Random random(59);
  const Chain chain = random_tree(60, {.bodies = 9, .serial = true, .floating_base = true});  // one root
  Workspace ws(chain);
  const State s = random_state(chain, random, 1);
  compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
  const std::vector<double> qdd = ws.qdd;
  const auto momentum_at = [&](double t) {
    std::vector<double> q = s.q, mean = s.qd, qd = s.qd;
    for (std::size_t i = 0; i < qd.size(); ++i) {
      qd[i] += t * qdd[i];
      mean[i] += t / 2 * qdd[i];
    }
    advance(chain, q, mean, t);
    const Momentum momentum = momentum_of(chain, ws, q, qd);
    Eigen::VectorXd both(6);
    both << momentum.linear, momentum.angular;
    return both;
  };
  const MassCenter center = mass_center_of(chain, ws, s.q, s.qd);
  const Eigen::Matrix3d R = ws.X_WB[1].linear();
  const Eigen::Vector3d force = R * Eigen::Vector3d(s.tau[0], s.tau[1], s.tau[2]);
  const Eigen::Vector3d moment = R * Eigen::Vector3d(s.tau[3], s.tau[4], s.tau[5]);
  const Eigen::Vector3d weight = center.mass * chain.gravity;
  Eigen::VectorXd rate(6);
  rate << weight + force, center.position.cross(weight) + ws.X_WB[1].translation().cross(force) + moment;

  const auto error = [&](double h, double factor) {
    return ((momentum_at(h) - momentum_at(-h)) / (2 * h) - factor * rate).norm();
  };
  EXPECT_NEAR(error(4e-4, 1) / error(2e-4, 1), 4, 0.2);  // central differences
  EXPECT_NEAR(error(4e-4, 1.1) / error(2e-4, 1.1), 1, 0.2);
}

}  // namespace
}  // namespace chainreel::test
