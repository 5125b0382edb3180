// The rules of the Taylor method on series that are known, and on series that lie.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "integrate/method.hpp"

namespace chainreel {
namespace {

// One coordinate whose coefficients a function gives.
class KnownSeries final : public Series {
 public:
  using Term = std::function<double(double t, double q, double v, int k)>;
  explicit KnownSeries(Term term) : term_(std::move(term)) {}
  int n() const override { return 1; }
  void expand(double t, std::span<const double> q, std::span<const double> v, int order,
              std::span<double> c) override {
    for (int k = 0; k <= order; ++k) c[std::size_t(k)] = term_(t, q[0], v[0], k);
    ++expansions;
  }
  int expansions = 0;

 private:
  Term term_;
};

// q'' = -q.
double oscillation(double, double q, double v, int k) {
  const double size = std::abs(k % 2 == 0 ? q : v) / std::tgamma(k + 1.0);
  return std::copysign(size, (k / 2 % 2 == 0 ? 1 : -1) * (k % 2 == 0 ? q : v));
}

// q = 1/(1 - t), which has no value at t = 1: q[k] = q^(k+1).
double pole(double, double q, double, int k) {
  return std::pow(q, k + 1);
}

struct Ran {
  double q = 0, v = 0, t = 0;
  int steps = 0;
  StepResult result = StepResult::ok;
};

Ran run_to(double end, Series& series, double q, double v, const MethodOptions& options, double fixed = 0) {
  Forms forms;
  forms.series = &series;
  const auto method = make_integrator(find_method("taylor"), forms, options);
  method->start(0, std::vector{q}, std::vector{v});
  Ran run;
  for (int k = 1; run.result == StepResult::ok && method->time() < end && run.steps < 10000; ++k) {
    run.result = fixed > 0 ? method->step(k * fixed, fixed) : method->step(end, end - method->time());
    ++run.steps;
  }
  run.t = method->time(), run.q = method->q()[0], run.v = method->v()[0];
  return run;
}

TEST(Taylor, ConvergesWithItsOrder) {
  KnownSeries series(oscillation);
  const auto error = [&series](int order, double h) {
    const Ran run = run_to(12, series, 1, 0, {0, order}, h);
    return std::hypot(run.q - std::cos(12), run.v + std::sin(12));
  };
  // Rounding is 1e-3 of the errors at most; the next terms are h / 14 of the first.
  EXPECT_NEAR(std::log2(error(12, 1.0) / error(12, 0.5)), 12, 0.1);
  EXPECT_NEAR(std::log2(error(16, 2.0) / error(16, 1.0)), 16, 0.2);
}

TEST(Taylor, MeetsTheTolerance) {
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    KnownSeries series(oscillation);
    const Ran run = run_to(20, series, 1, 0, {tolerance, 20});
    ASSERT_EQ(run.result, StepResult::ok);
    EXPECT_EQ(run.t, 20);
    EXPECT_LT(std::hypot(run.q - std::cos(20), run.v + std::sin(20)), run.steps * tolerance);
    EXPECT_EQ(series.expansions, run.steps + 1);  // no step was refused
  }
}

TEST(Taylor, ShortensItsStepsTowardsAPole) {
  KnownSeries series(pole);
  const Ran run = run_to(0.99, series, 1, 1, {1e-9, 20});
  ASSERT_EQ(run.result, StepResult::ok);
  // Errors grow as the square of q.
  EXPECT_NEAR(run.q, 100, 1e-9 * 1e4);
  EXPECT_GT(run.steps, 8);
}

// The last four terms say nothing of the motion: whatever step is tried, what follows must fit.
TEST(Taylor, IsNotDeceivedByTermsThatAreMissing) {
  KnownSeries honest(pole);
  const Ran exact = run_to(0.9, honest, 1, 1, {1e-12, 20});
  for (const int known : {6, 10, 16}) {
    KnownSeries liar(
        [known](double t, double q, double v, int k) { return k > known && k <= 20 ? 0 : pole(t, q, v, k); });
    const Ran run = run_to(0.9, liar, 1, 1, {1e-6, 20});
    ASSERT_EQ(run.result, StepResult::ok) << known;
    EXPECT_NEAR(run.q, exact.q, 1e-3) << known;
  }
}

// Zero in the last four terms and zero below: only the look at the step's end can tell.
TEST(Taylor, RefusesAStepWhoseEndDoesNotFit) {
  KnownSeries hidden([](double t, double q, double v, int k) {
    const bool is_hidden = t == 0;  // the first expansion sees a motion without force
    return k < 2 ? (k == 0 ? q : v) : is_hidden ? 0 : oscillation(t, q, v, k);
  });
  const Ran run = run_to(20, hidden, 1, 0, {1e-9, 20});
  // Only a step so short that it loses no more than a few hundred tolerances.
  ASSERT_EQ(run.result, StepResult::ok);
  EXPECT_NEAR(run.q, std::cos(20), 1e-6);
  EXPECT_GT(hidden.expansions, run.steps + 10);
}

TEST(Taylor, TakesOneStepWhereTheMotionIsUniform) {
  KnownSeries series([](double, double q, double v, int k) { return k == 0 ? q : k == 1 ? v : 0; });
  const Ran run = run_to(1000, series, 2, 0.5, {1e-9, 20});
  EXPECT_EQ(run.steps, 1);
  EXPECT_EQ(run.q, 502);
}

TEST(Taylor, HandsOnWhatIsNoNumber) {
  KnownSeries series([](double, double q, double v, int k) { return k == 0 ? q : k == 1 ? v : NAN; });
  const Ran run = run_to(1, series, 0, 0, {1e-9, 20});
  EXPECT_FALSE(std::isfinite(run.q));
}

}  // namespace
}  // namespace chainreel
