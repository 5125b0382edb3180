#include "dynamics/energy.hpp"

#include <gtest/gtest.h>

#include "dynamics/compare.hpp"
#include "dynamics/forward_dynamics.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"
#include "support/chains.hpp"

namespace chainreel::testing {
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

}  // namespace
}  // namespace chainreel::testing
