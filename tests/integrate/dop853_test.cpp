#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "integrate/dop853_tableau.hpp"
#include "integrate/method.hpp"
#include "rooted_trees.hpp"
#include "started.hpp"

namespace chainreel {
namespace {

using dop853::Row;

// Sums of some ten products with numbers up to 43: round-off of a few hundred units.
constexpr double kRoundOff = 1e-13;

// The largest deviation from what order demands of the weights at s, over the trees with n nodes.
double residual(const Row& weights, double s, int n) {
  double largest = 0;
  for (const Tree& tree : trees_with(n)) {
    const std::vector<double> phi = phi_of(tree, dop853::a);
    double sum = -std::pow(s, n) / gamma_of(tree);
    for (std::size_t i = 0; i < phi.size(); ++i) sum += weights[i] * phi[i];
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

// The weights of the continuous extension at s.
Row weights_at(double s) {
  Row w{};
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double r0 = dop853::a[dop853::kEnd][i], r1 = (i == 0) - r0, r2 = r0 - (i == dop853::kEnd) - r1;
    double sum = 0;
    for (std::size_t j = 4; j-- > 0;) sum = (sum + dop853::d[j][i]) * (j % 2 == 1 ? s : 1 - s);
    w[i] = s * (r0 + (1 - s) * (r1 + s * (r2 + sum)));
  }
  return w;
}

TEST(RootedTrees, AreAsManyAsCayleyCounted) {
  const std::array<std::size_t, 8> counts{1, 1, 2, 4, 9, 20, 48, 115};
  for (int n = 1; n <= 8; ++n) EXPECT_EQ(trees_with(n).size(), counts[std::size_t(n) - 1]);
}

TEST(Dop853Tableau, MeetsTheOrderConditionsOfAllTreesUpToEightNodes) {
  for (int n = 1; n <= 8; ++n) EXPECT_LT(residual(dop853::a[dop853::kEnd], 1, n), kRoundOff) << n;
  EXPECT_GT(residual(dop853::a[dop853::kEnd], 1, 9), 1e-7);  // order 8 and no more
}

TEST(Dop853Tableau, HasStagesAtTheirInstants) {
  for (std::size_t s = 0; s < dop853::kAllStages; ++s) {
    double sum = 0;
    for (const double entry : dop853::a[s]) sum += entry;
    EXPECT_NEAR(sum, dop853::c[s], kRoundOff) << s;
  }
}

TEST(Dop853Tableau, ContinuesWithOrderSevenAtEveryInstant) {
  for (const double s : {0.1, 0.5, 0.93}) {
    for (int n = 1; n <= 7; ++n) EXPECT_LT(residual(weights_at(s), s, n), 10 * kRoundOff) << n << " " << s;
    EXPECT_GT(residual(weights_at(s), s, 8), 1e-9);
  }
}

// An error estimate of order p is a difference of two rules that agree on all trees with p nodes.
TEST(Dop853Tableau, EstimatesErrorsWithOrdersFiveAndThree) {
  for (int n = 1; n <= 5; ++n) EXPECT_LT(residual(dop853::e5, 0, n), kRoundOff) << n;
  EXPECT_GT(residual(dop853::e5, 0, 6), 1e-5);
  for (int n = 1; n <= 3; ++n) EXPECT_LT(residual(dop853::e3, 0, n), kRoundOff) << n;
  EXPECT_GT(residual(dop853::e3, 0, 4), 1e-5);
}

// Negative control: a last digit of a table that is off shows.
TEST(Dop853Tableau, MissesItsOrderWithOneDigitChanged) {
  Row b = dop853::a[dop853::kEnd];
  b[7] += 1e-9;
  EXPECT_GT(residual(b, 1, 1), 100 * kRoundOff);
}

constexpr std::array<double, 3> kParts{0.2, 0.45, 0.7};  // of a step

TEST(Dop853, InterpolatesWithItsDenseOrder) {
  // A local error of order 7 + 1; the next term is some h/2 = 0.06 of it, and halves too.
  EXPECT_NEAR(std::log2(largest_dense_error("dop853", 4, kParts) / largest_dense_error("dop853", 8, kParts)),
              8, 0.1);
}

TEST(Dop853, InterpolatesIntoTheEndsOfItsSteps) {
  Oscillator system(1);
  Started integrator(system, "dop853", 1e-9, 0, 1, 0);
  double q0 = 1, v0 = 0, q[1], v[1];
  while (integrator.time() < 10) {
    ASSERT_EQ(integrator->step(10, 10), StepResult::ok);
    integrator->interpolate(integrator->begin_time(), q, v);
    EXPECT_EQ(q[0], q0);
    EXPECT_EQ(v[0], v0);
    q0 = integrator.q();
    v0 = integrator.v();
    integrator->interpolate(integrator.time(), q, v);
    EXPECT_NEAR(q[0], q0, 4e-16);
    EXPECT_NEAR(v[0], v0, 4e-16);
  }
}

TEST(Dop853, IsTheSameRunWhetherItIsLookedIntoOrNot) {
  Oscillator system(1);
  const auto end = [&](bool look) {
    Started integrator(system, "dop853", 1e-9, 0, 1, 0);
    double q[1], v[1];
    while (integrator.time() < 10) {
      integrator->step(10, 10);
      if (look) integrator->interpolate(0.5 * (integrator->begin_time() + integrator.time()), q, v);
    }
    return integrator.q();
  };
  EXPECT_EQ(end(false), end(true));
}

// q'' = -q over a hundred turns, with the error of the end and the evaluations that it took.
struct Cost {
  double error;
  long evaluations;
};
Cost cost(double tolerance) {
  struct Counted final : SecondOrder {
    long evaluations = 0;
    int nq() const override { return 1; }
    int nv() const override { return 1; }
    void acceleration(double, std::span<const double> q, std::span<const double>,
                      std::span<double> vd) override {
      ++evaluations;
      vd[0] = -q[0];
    }
  } system;
  Started integrator(system, "dop853", tolerance, 0, 1, 0);
  const double end = 200 * std::acos(-1);
  EXPECT_EQ(integrator.go(end), StepResult::ok);
  return {std::hypot(integrator.q() - 1, integrator.v()), system.evaluations};
}

TEST(Dop853, HasErrorsInProportionToItsTolerance) {
  // Over 100 turns the errors of the steps, each below the tolerance, add up to 10 to 1000 of them.
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
    const Cost one = cost(tolerance);
    EXPECT_LT(one.error, 1000 * tolerance) << tolerance;
    EXPECT_GT(one.error, 0.1 * tolerance) << tolerance;
  }
  // Order 8: a hundredth of the error for 10^(2/8) = 1.78 times the evaluations.
  EXPECT_NEAR(double(cost(1e-9).evaluations) / double(cost(1e-7).evaluations), std::pow(10, 0.25), 0.15);
}

TEST(Dop853, StopsAtTheEndExactly) {
  Oscillator system(1);
  Started integrator(system, "dop853", 1e-6, 0.1, 1, 0);
  EXPECT_EQ(integrator.go(0.7), StepResult::ok);
  EXPECT_EQ(integrator.time(), 0.7);
  EXPECT_NEAR(integrator.q(), std::cos(0.6), 1e-6);
}

TEST(Dop853, RejectsAttemptsThatGiveNoNumbers) {
  // q'' = 0 that has no value from q = 1 on: attempts, which grow where there is no error, run into it.
  struct Edge final : SecondOrder {
    int beyond = 0;
    int nq() const override { return 1; }
    int nv() const override { return 1; }
    void acceleration(double, std::span<const double> q, std::span<const double>,
                      std::span<double> vd) override {
      beyond += q[0] >= 1;
      vd[0] = q[0] < 1 ? 0 : std::numeric_limits<double>::quiet_NaN();
    }
  } system;
  Started integrator(system, "dop853", 1e-8, 0, 0, 0.1);
  EXPECT_EQ(integrator.go(20), StepResult::step_too_small);
  EXPECT_GT(system.beyond, 10);
  // It has crept up to the edge, with numbers all the way.
  EXPECT_LT(integrator.time(), 10);
  EXPECT_GT(integrator.time(), 10 - 1e-9);
  EXPECT_NEAR(integrator.q(), 1, 1e-9);
}

TEST(Dop853, SaysThatNoStepIsSmallEnoughAtAPole) {
  // q = 1 / (1 - t) solves q'' = 2 q^3 and has its pole in t = 1.
  struct Pole final : SecondOrder {
    int nq() const override { return 1; }
    int nv() const override { return 1; }
    void acceleration(double, std::span<const double> q, std::span<const double>,
                      std::span<double> vd) override {
      vd[0] = 2 * q[0] * q[0] * q[0];
    }
  } system;
  Started integrator(system, "dop853", 1e-9, 0, 1, 1);
  StepResult result = StepResult::ok;
  int steps = 0;
  for (; result == StepResult::ok && steps < 10000; ++steps) result = integrator->step(2, 2);
  EXPECT_EQ(result, StepResult::step_too_small);
  EXPECT_NEAR(integrator.time(), 1, 1e-6);
  EXPECT_LT(steps, 2000);
}

TEST(Dop853, EndsWhereTheRateIsNoNumberAtTheStart) {
  struct Nothing final : SecondOrder {
    int nq() const override { return 1; }
    int nv() const override { return 1; }
    void acceleration(double, std::span<const double>, std::span<const double>,
                      std::span<double> vd) override {
      vd[0] = std::numeric_limits<double>::quiet_NaN();
    }
  } system;
  Started integrator(system, "dop853", 1e-9, 0, 1, 1);
  EXPECT_EQ(integrator->step(2, 2), StepResult::step_too_small);
}

}  // namespace
}  // namespace chainreel
