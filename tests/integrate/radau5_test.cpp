#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "integrate/dense_lu.hpp"
#include "integrate/method.hpp"
#include "integrate/radau5_tableau.hpp"
#include "rooted_trees.hpp"
#include "started.hpp"

namespace chainreel {
namespace {

constexpr double kRadauRoundOff = 1e-14;  // of sums of a few products of numbers up to 10

// The largest deviation from the order conditions over the trees with n nodes, with b, the last row of A.
double residual(int n) {
  double largest = 0;
  for (const Tree& tree : trees_with(n)) {
    const std::vector<double> phi = phi_of(tree, radau5::A);
    double sum = -1 / gamma_of(tree);
    for (std::size_t i = 0; i < 3; ++i) sum += radau5::A[2][i] * phi[i];
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

TEST(Radau5Tableau, MeetsTheOrderConditionsOfAllTreesUpToFiveNodes) {
  for (int n = 1; n <= 5; ++n) EXPECT_LT(residual(n), kRadauRoundOff) << n;
  EXPECT_GT(residual(6), 1e-5);  // and of no more
}

TEST(Radau5Tableau, FallsApartIntoOneRealAndOneComplexEigenvalue) {
  using namespace radau5;
  // A T diag(gamma, [alpha -beta; beta alpha]) = T, and T_inv T = 1.
  for (std::size_t i = 0; i < 3; ++i) {
    Row AT{};
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) AT[j] += A[i][k] * T[k][j];
    EXPECT_NEAR(AT[0] * gamma, T[i][0], kRadauRoundOff);
    EXPECT_NEAR(AT[1] * alpha + AT[2] * beta, T[i][1], kRadauRoundOff);
    EXPECT_NEAR(-AT[1] * beta + AT[2] * alpha, T[i][2], kRadauRoundOff);
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += T_inv[i][k] * T[k][j];
      EXPECT_NEAR(sum, i == j, kRadauRoundOff);
    }
  }
}

TEST(Radau5Tableau, EstimatesNoErrorForAConstantRate) {
  // Stages c_i h y' : sum d_i c_i = -1 takes y' away.
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += radau5::d[i] * radau5::c[i];
    double dA = 0;
    for (std::size_t j = 0; j < 3; ++j) dA += radau5::d[j] * radau5::A[j][i];
    EXPECT_NEAR(dA, radau5::dA[i], kRadauRoundOff);
  }
  EXPECT_NEAR(sum, -1, kRadauRoundOff);
}

// Rows in another order: in each column there is one number that can be a pivot.
TEST(DenseLu, FindsTheOnlyPivotOfAColumn) {
  constexpr std::size_t n = 5;
  DenseLu<double> turned(n);
  std::vector<double> b(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (2 * i + 3) % n;
    turned(i, j) = double(i + 2);
    b[i] = double(i + 2) * double(j + 1);  // x = 1, 2, ..
  }
  turned.factor();
  turned.solve(b);
  for (std::size_t j = 0; j < n; ++j) EXPECT_NEAR(b[j], double(j + 1), 8 * 0x1p-52) << j;
}

TEST(DenseLu, SolvesWhatItHasFactored) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const std::size_t n : {1u, 2u, 3u, 8u, 30u}) {
    DenseLu<double> real(n);
    DenseLu<Complex> complex(n);
    std::vector<double> x(n), b(n);
    std::vector<Complex> z(n), c(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = uniform(random), z[i] = {uniform(random), uniform(random)};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const double a = i == j ? 0 : uniform(random);  // nothing on the diagonal: pivots must be found
        const Complex ac{a, n == 1 || i != j ? uniform(random) : 0};
        real(i, j) = n == 1 ? 2 : a;
        complex(i, j) = ac;
        b[i] += real(i, j) * x[j];
        c[i] = {c[i].re + (ac * z[j]).re, c[i].im + (ac * z[j]).im};
      }
    real.factor();
    complex.factor();
    real.solve(b);
    complex.solve(c);
    // Round-off times the condition numbers of these matrices, some thousand at most.
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(b[i], x[i], 1e-11) << n;
      EXPECT_NEAR(c[i].re, z[i].re, 1e-11) << n;
      EXPECT_NEAR(c[i].im, z[i].im, 1e-11) << n;
    }
  }
}

// q'' = -k (q - cos t) - d (q' + sin t) - cos t: q = cos t from (1, 0), however stiff (A. Prothero, A.
// Robinson, Mathematics of Computation 28 (1974) 145-162).
struct OnASpring final : SecondOrder {
  double k, d;
  long evaluations = 0;
  OnASpring(double k_, double d_) : k(k_), d(d_) {}
  int nq() const override { return 1; }
  int nv() const override { return 1; }
  void acceleration(double t, std::span<const double> q, std::span<const double> v,
                    std::span<double> vd) override {
    ++evaluations;
    vd[0] = -k * (q[0] - std::cos(t)) - d * (v[0] + std::sin(t)) - std::cos(t);
  }
};

struct RadauCost {
  int steps = 0;
  long evaluations = 0;
  double error = 0;
};
RadauCost cost(const std::string& method, double k, double d, double tolerance, double q0 = 1) {
  OnASpring system(k, d);
  Started integrator(system, method, tolerance, 0, q0, 0);
  RadauCost result;
  while (integrator.time() < 10) {
    EXPECT_EQ(integrator->step(10, 10), StepResult::ok);
    ++result.steps;
  }
  result.evaluations = system.evaluations;
  result.error = std::abs(integrator.q() - std::cos(10));
  return result;
}

TEST(Radau5, TakesNoShorterStepsForStifferSprings) {
  const RadauCost soft = cost("radau5", 1e6, 1e3, 1e-6);
  for (const double k : {1e8, 1e10}) {
    const RadauCost stiff = cost("radau5", k, std::sqrt(k), 1e-6);
    EXPECT_LT(stiff.steps, 1.2 * soft.steps) << k;
    EXPECT_LT(stiff.error, 1e-5) << k;  // the tolerance times ten for ten units of time
  }
  // Negative control: an explicit method does.
  EXPECT_GT(cost("dop853", 1e6, 1e3, 1e-6).steps, 20 * cost("dop853", 1, 1, 1e-6).steps);
}

TEST(Radau5, FollowsWhatASpringLetsGoAndThenTheSlowMotion) {
  // Released a tenth away: the spring's own motion, over in some 10 / 500 s, must be seen and must not
  // linger.
  const RadauCost one = cost("radau5", 1e6, 1e3, 1e-6, 1.1);
  EXPECT_LT(one.error, 1e-5);
  EXPECT_LT(one.steps, 300);
}

TEST(Radau5, HasErrorsInProportionToItsTolerance) {
  const double turns = 20 * std::acos(-1);
  double last = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    Oscillator system(1);
    Started integrator(system, "radau5", tolerance, 0, 1, 0);
    EXPECT_EQ(integrator.go(turns), StepResult::ok);
    const double error = std::hypot(integrator.q() - 1, integrator.v());
    // Ten turns add the errors of some hundred steps up.
    EXPECT_LT(error, 100 * tolerance) << tolerance;
    // Order 5 with steps in proportion to tolerance^(1/6): a hundredth of the tolerance is 100^(5/6) = 46
    // times less error; the estimate's own error and Newton's rest leave a factor of 3.
    if (last > 0) {
      EXPECT_NEAR(std::log(last / error), std::log(46), std::log(3)) << tolerance;
    }
    last = error;
  }
}

TEST(Radau5, AsksLittleOnLinearProblems) {
  // One evaluation at the beginning and, the Jacobian serving on, three for each of one or two passes.
  const RadauCost one = cost("radau5", 100, 10, 1e-6);
  EXPECT_LT(double(one.evaluations) / one.steps, 7.5);
}

TEST(Radau5, TakesAwayNearlyAllOfWhatItCannotFollow) {
  // R(z) = -3/z + .. for large z: one step at omega h = 1e6 leaves 3e-6 of an oscillation.
  Oscillator system(1e6);
  Started integrator(system, "radau5", 0, 0, 1, 0);
  ASSERT_EQ(integrator->step(1, 1), StepResult::ok);
  // Next term 1/z; the Jacobian's differences are right to 1e-8.
  EXPECT_NEAR(std::hypot(integrator.q(), integrator.v() / 1e6), 3e-6, 1e-11);
}

constexpr std::array<double, 3> kDecayParts{0.2, 0.45, 0.8};  // of a step

TEST(Radau5, InterpolatesFixedStepsToFourthOrder) {
  // A local error of order 4 + 1; the next term is h/2 = 0.05 of it and moves the slope by as much.
  EXPECT_NEAR(
      std::log2(largest_dense_error("radau5", 20, kDecayParts) / largest_dense_error("radau5", 40, kDecayParts)), 5,
      0.1);
}

TEST(Radau5, SwingsNoFartherBetweenFixedStepsThanItsSpringPulls) {
  // A spring that is over within the step: the motion in between stays between start and rest, where the
  // acceleration at the start, 1e5, would throw a quintic polynomial far out.
  Oscillator system(1e3);
  Started integrator(system, "radau5", 0, 0, 0.1, 0);
  ASSERT_EQ(integrator->step(0.05, 0.05), StepResult::ok);
  double q[1], v[1];
  for (int k = 1; k < 20; ++k) {
    integrator->interpolate(0.05 * k / 20, q, v);
    EXPECT_LT(std::abs(q[0]), 0.15) << k;
  }
}

TEST(Radau5, InterpolatesIntoTheEndsOfItsSteps) {
  for (const double tolerance : {0.0, 1e-6}) {
    OnASpring system(1e4, 100);
    Started integrator(system, "radau5", tolerance, 0, 1, 0);
    double q0 = 1, q[1], v[1];
    for (int k = 1; k <= 20; ++k) {
      ASSERT_EQ(integrator->step(k * 0.1, 0.1), StepResult::ok);
      integrator->interpolate(integrator->begin_time(), q, v);
      EXPECT_EQ(q[0], q0);
      integrator->interpolate(integrator->time(), q, v);
      EXPECT_NEAR(q[0], integrator.q(), 1e-14);  // b's last digit and Newton's
      q0 = integrator.q();
    }
  }
}

TEST(Radau5, SaysThatNoStepIsSmallEnoughAtAPole) {
  // q = 1 / (1 - t) solves q'' = 2 q^3.
  struct Pole final : SecondOrder {
    int nq() const override { return 1; }
    int nv() const override { return 1; }
    void acceleration(double, std::span<const double> q, std::span<const double>,
                      std::span<double> vd) override {
      vd[0] = 2 * q[0] * q[0] * q[0];
    }
  } system;
  Started integrator(system, "radau5", 1e-6, 0, 1, 1);
  StepResult result = StepResult::ok;
  int steps = 0;
  for (; result == StepResult::ok && integrator.time() < 2 && steps < 20000; ++steps)
    result = integrator->step(2, 2);
  EXPECT_EQ(result, StepResult::step_too_small);
  EXPECT_NEAR(integrator.time(), 1, 1e-4);
  EXPECT_LT(steps, 5000);
}

TEST(Radau5, SaysThatAFixedStepHasNoSolution) {
  // At h = 10 no number solves v = v0 + h (1 + v^2) and its like.
  struct Squares final : SecondOrder {
    int nq() const override { return 1; }
    int nv() const override { return 1; }
    void acceleration(double, std::span<const double>, std::span<const double> v,
                      std::span<double> vd) override {
      vd[0] = 1 + v[0] * v[0];
    }
  } system;
  Started integrator(system, "radau5", 0, 0, 0, 0);
  EXPECT_EQ(integrator->step(10, 10), StepResult::not_converged);
  Started shorter(system, "radau5", 0, 0, 0, 0);  // negative control: there is one at h = 0.1
  EXPECT_EQ(shorter->step(0.1, 0.1), StepResult::ok);
  EXPECT_NEAR(shorter.v(), std::tan(0.1), 1e-8);
}

}  // namespace
}  // namespace chainreel
