#include "integrate/stability_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace chainreel {
namespace {

// The limit is found by halving to 1e-9 of itself, and growth is told from none at 1e-12: rk4's growth behind
// its limit is steep, that of semi-implicit Euler a square root.
constexpr double kTolerance = 1e-6;

TEST(StabilityLimit, IsTheTheorysForTheFixedSteps) {
  EXPECT_NEAR(stability_limit(find_method("semi_implicit_euler"), 0), 2, kTolerance);
  EXPECT_NEAR(stability_limit(find_method("rk4"), 0), 2 * std::sqrt(2), kTolerance);
  EXPECT_EQ(stability_limit(find_method("explicit_euler"), 0), 0);
}

TEST(StabilityLimit, FallsWithDampingForSemiImplicitEulerAndRisesForExplicit) {
  for (const double z : {0.05, 0.2, 0.5, 0.9}) {
    EXPECT_NEAR(stability_limit(find_method("semi_implicit_euler"), z), 2 * (std::sqrt(1 + z * z) - z),
                kTolerance);
    EXPECT_NEAR(stability_limit(find_method("explicit_euler"), z), 2 * z, kTolerance);
  }
}

// Negative control: no method has another's limit.
TEST(StabilityLimit, TellsMethodsApart) {
  EXPECT_GT(std::abs(stability_limit(find_method("rk4"), 0) -
                     stability_limit(find_method("semi_implicit_euler"), 0)),
            0.5);
  EXPECT_GT(amplification(find_method("rk4"), 10, 0, 0.29), 1.0);
  EXPECT_LT(amplification(find_method("rk4"), 10, 0, 0.28), 1.0);
}

}  // namespace
}  // namespace chainreel
