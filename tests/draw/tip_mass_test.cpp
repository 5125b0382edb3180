// The effective mass that a panel draws.
#include "draw/tip_mass.hpp"

#include <gtest/gtest.h>

#include "support/chains.hpp"

namespace chainreel::testing {
namespace {

constexpr double kRoundOff = 1e-12;  // of masses near 1 kg through an inverse of condition 10 or so

Simulation simulation_of(Chain chain) {
  Simulation simulation;
  simulation.chain = std::move(chain);
  return simulation;
}

TEST(TipMass, OfAFreeChainIsItsLambda) {
  const Simulation free = simulation_of(rr_chain());
  Workspace ws(free.chain);
  // L = 1 m, m = 1 kg: Lambda = diag(1, 2) at (0, 90 deg).
  const std::vector<double> q{0, M_PI / 2};
  for (const Simulation* simulation : {static_cast<const Simulation*>(nullptr), &free}) {
    const EffectiveMass mass = TipMass(free.chain, simulation).at(ws, q);
    ASSERT_TRUE(mass.Lambda);
    EXPECT_NEAR((*mass.Lambda)(0, 0), 1, kRoundOff);
    EXPECT_NEAR((*mass.Lambda)(1, 1), 2, kRoundOff);
  }
}

TEST(TipMass, OfAPenOnALineIsInfiniteAcrossIt) {
  Simulation pen = simulation_of(rr_chain());
  pen.constraints.list = {LineConstraint{"gripper", {0, 1, 0}, {1, 0, 0}}};
  Workspace ws(pen.chain);
  const std::vector<double> q{0, M_PI / 2};
  const EffectiveMass mass = TipMass(pen.chain, &pen).at(ws, q);
  EXPECT_FALSE(mass.Lambda);
  ASSERT_EQ(mass.singular_directions.size(), 1u);
  EXPECT_NEAR(std::abs(mass.singular_directions[0][1]), 1, kRoundOff);
  // Lambda is diagonal here, so that the line leaves the mass along it as it is.
  EXPECT_NEAR(mass.Lambda_inv(0, 0), 1, kRoundOff);
}

}  // namespace
}  // namespace chainreel::testing
