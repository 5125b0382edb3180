#include "integrate/method.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "oscillator.hpp"

namespace chainreel {
namespace {

struct State {
  double q, v;
};

State run(const Method& method, SecondOrder& system, State start, double end, int steps) {
  const AllForms forms(system);
  const std::unique_ptr<Integrator> integrator = make_integrator(method, forms.forms());
  integrator->start(0, std::array{start.q}, std::array{start.v});
  const double h = end / steps;
  for (int k = 0; k < steps; ++k) EXPECT_EQ(integrator->step((k + 1) * h, h), StepResult::ok);
  return {integrator->q()[0], integrator->v()[0]};
}

// log2 of the ratio of errors when the step halves.
double measured_order(const Method& method, SecondOrder& system, State start, double end, State exact,
                      int steps) {
  const State coarse = run(method, system, start, end, steps);
  const State fine = run(method, system, start, end, 2 * steps);
  return std::log2(std::hypot(coarse.q - exact.q, coarse.v - exact.v) /
                   std::hypot(fine.q - exact.q, fine.v - exact.v));
}

// Steps so long that the error stands well above round-off and the next term of its series well below it.
int steps_for(const Method& method) {
  return method.order <= 4 ? 100 : method.order <= 6 ? 12 : 4;
}

class EveryMethod : public ::testing::TestWithParam<std::string> {
 protected:
  const Method& method_ = find_method(GetParam());
};

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Method& method : methods())
    if (AllForms::has(method.form)) all.push_back(method.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod, ::testing::ValuesIn(names()),
                         [](const auto& p) { return p.param; });

TEST_P(EveryMethod, ConvergesWithItsOrderOnTheOscillator) {
  Oscillator system(1);
  // The next term of the error series is h = 0.02 times the leading one (or h^2 with the longer steps of high
  // orders and a small factor): the slope is off by about that much.
  EXPECT_NEAR(measured_order(method_, system, {1, 0}, 2, {std::cos(2), -std::sin(2)}, steps_for(method_)),
              method_.order, 0.05);
}

TEST_P(EveryMethod, ConvergesWithItsOrderOnATorqueOfTimeAlone) {
  Driven system;
  EXPECT_NEAR(measured_order(method_, system, {0, 1}, 2, {std::sin(2), std::cos(2)}, steps_for(method_)),
              method_.order, 0.05);
}

TEST_P(EveryMethod, CountsItsEvaluationsRight) {
  struct Counted final : SecondOrder {
    int evaluations = 0;
    int nq() const override { return 1; }
    int nv() const override { return 1; }
    void acceleration(double, std::span<const double>, std::span<const double>,
                      std::span<double> vd) override {
      ++evaluations;
      vd[0] = 0;
    }
  } system;
  if (method_.evaluations_per_step == 0) return;  // not always the same
  run(method_, system, {0, 0}, 1, 10);
  EXPECT_EQ(system.evaluations, 10 * method_.evaluations_per_step);
}

TEST_P(EveryMethod, IsNamedDocumentedAndUnique) {
  int rows = 0;
  for (const Method& method : methods()) rows += method.name == method_.name;
  EXPECT_EQ(rows, 1);
  EXPECT_GT(method_.source.size(), 20u);
}

// Negative control: a method measured against the wrong solution shows no order.
TEST_P(EveryMethod, ShowsNoOrderAgainstAWrongSolution) {
  Oscillator system(1);
  EXPECT_LT(measured_order(method_, system, {1, 0}, 2, {std::cos(2) + 0.1, -std::sin(2)}, 100), 0.5);
}

TEST(Rk4, IsExactOnPolynomialsUpToItsOrder) {
  Cubic system;
  const State end = run(find_method("rk4"), system, {0, 0}, 2, 7);
  // 7 steps of a few roundings each on numbers up to 12.
  EXPECT_NEAR(end.q, 8, 7 * 12 * 2.3e-16);
  EXPECT_NEAR(end.v, 12, 7 * 12 * 2.3e-16);
}

TEST(SemiImplicitEuler, KeepsTheOscillatorsModifiedEnergy) {
  // It conserves v^2 + omega^2 q^2 - h omega^2 q v exactly: only round-off is left, about one per step.
  Oscillator system(3);
  const auto modified = [](State s, double h) { return s.v * s.v + 9 * s.q * s.q - h * 9 * s.q * s.v; };
  const State start{1, 0};
  const State end = run(find_method("semi_implicit_euler"), system, start, 100, 10000);
  EXPECT_NEAR(modified(end, 0.01), modified(start, 0.01), 10000 * 9 * 2.3e-16);
}

TEST(ExplicitEuler, GainsEnergyAtEveryStepExactlyAsItsTheorySays) {
  // |1 + i h omega|^2 = 1 + (h omega)^2 per step.
  Oscillator system(1);
  const State end = run(find_method("explicit_euler"), system, {1, 0}, 10, 1000);
  EXPECT_NEAR(end.q * end.q + end.v * end.v, std::pow(1 + 1e-4, 1000), 1000 * 2.3e-16 * 1.2);
}

TEST(FindMethod, NamesTheNearestKnownOne) {
  try {
    find_method("semi_implict_euler");
    FAIL() << "an unknown method was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'semi_implicit_euler'?"));
  }
}

}  // namespace
}  // namespace chainreel
