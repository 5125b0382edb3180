// The effective mass that films, figures and tables show.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/instant.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

constexpr double kRoundOff = 1e-12;  // of masses near 1 kg through an inverse of condition 10 or so

TEST(TipMass, OfAFreeChainIsItsLambda) {
  const Chain chain = rr_chain();
  Workspace ws(chain);
  // L = 1 m, m = 1 kg: Lambda = diag(1, 2) at (0, 90 deg).
  const std::vector<double> q{0, M_PI / 2};
  for (const EffectiveMass& mass : {TipMass(chain).at(ws, q), TipMass(chain, {}).at(ws, q)}) {
    ASSERT_TRUE(mass.Lambda);
    EXPECT_NEAR((*mass.Lambda)(0, 0), 1, kRoundOff);
    EXPECT_NEAR((*mass.Lambda)(1, 1), 2, kRoundOff);
  }
}

TEST(TipMass, OfAPenOnALineIsInfiniteAcrossIt) {
  const Chain chain = rr_chain();
  ConstraintPlan line;
  line.list = {LineConstraint{"gripper", {0, 1, 0}, {1, 0, 0}}};
  Workspace ws(chain);
  const std::vector<double> q{0, M_PI / 2};
  const EffectiveMass mass = TipMass(chain, line).at(ws, q);
  EXPECT_FALSE(mass.Lambda);
  ASSERT_EQ(mass.singular_directions.size(), 1u);
  EXPECT_NEAR(std::abs(mass.singular_directions[0][1]), 1, kRoundOff);
  // Lambda is diagonal here, so that the line leaves the mass along it as it is.
  EXPECT_NEAR(mass.Lambda_inv(0, 0), 1, kRoundOff);
}

}  // namespace
}  // namespace chainreel::test
