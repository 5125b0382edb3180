// References in quadruple precision, and the end states of the three problems that speed and accuracy are
// measured on.
#include "sim/choice/quad_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/runs.hpp"

namespace chainreel {
namespace {

struct Problem {
  std::string name, model;
  std::vector<std::string> torque;
  double end;
  std::vector<double> q, qd;
  friend void PrintTo(const Problem& problem, std::ostream* out) { *out << problem.name; }
};

// Found by this reference at 1e-27 a step with a series of order 44 beside 12 columns of extrapolation, which
// differed by 1e-25 (A), 3e-26 (B) and 5e-28 (D); all digits of a double are given.
const Problem kProblems[] = {
    {"A",
     "rr",
     {"0", "0"},
     10,
     {-2.1392709908108452, 0.042080936083541493},
     {6.0783848857619676, -15.75974556747085}},
    {"B",
     "rr",
     {"1", "1"},
     10,
     {-1.9910983396003634, -0.43717011999145006},
     {0.17410029414312581, -6.9477822859139087}},
    {"D",
     "rrr",
     {"10", "10", "10"},
     0.5,
     {-1.5264567312956019, 1.9802443053520795, 3.8621819823270869},
     {-8.4091339323936243, 7.4518792440199677, 16.879509713974965}},
};

class Problems : public ::testing::TestWithParam<Problem> {};
INSTANTIATE_TEST_SUITE_P(Measured, Problems, ::testing::ValuesIn(kProblems),
                         [](const auto& p) { return p.param.name; });

TEST_P(Problems, EndWhereTheyEnd) {
  const Problem& problem = GetParam();
  const Simulation run = run_of(problem.model, problem.torque, problem.end);
  const auto reference = quad_reference(run, std::vector{problem.end});
  ASSERT_TRUE(reference);
  EXPECT_LT(reference->uncertainty[0], 1e-20);
  for (std::size_t i = 0; i < problem.q.size(); ++i) {
    EXPECT_DOUBLE_EQ(reference->q[i], problem.q[i]);
    EXPECT_DOUBLE_EQ(reference->qd[i], problem.qd[i]);
  }
}

TEST_P(Problems, EndElsewhereWithOneBitLessGravity) {
  const Problem& problem = GetParam();
  Simulation run = run_of(problem.model, problem.torque, problem.end);
  run.chain.gravity *= 1 - 0x1p-50;
  const auto reference = quad_reference(run, std::vector{problem.end});
  ASSERT_TRUE(reference);
  EXPECT_NE(reference->q[0], problem.q[0]);
  EXPECT_NEAR(reference->q[0], problem.q[0], 1e-12);
}

// The method in doubles comes as near as the amplification lets it: rounding of 50 to 400 steps.
TEST_P(Problems, AreReachedInDoublesToTheirAmplification) {
  const Problem& problem = GetParam();
  Simulation run = run_of(problem.model, problem.torque, problem.end, "taylor", 0);
  run.options = {1e-16, 24};
  const double amplification = quad_amplification(run, problem.end).value();
  EXPECT_GE(amplification, 1);
  const Trajectory end = simulate(run, std::vector{problem.end});
  for (std::size_t i = 0; i < problem.q.size(); ++i)
    EXPECT_NEAR(end.q[i], problem.q[i], 100 * amplification * 0x1p-53);
}

TEST(QuadReference, KnowsTheOscillator) {
  // One slide of 1 kg on a spring of 100 N/m from the origin under gravity: y = -g/100 (1 - cos 10 t).
  const Simulation run = run_of("pp", {"0", "-100*q2"}, 2);
  const std::vector<double> times = {0.5, 2};
  const auto reference = quad_reference(run, times);
  ASSERT_TRUE(reference);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double y = -0.0981 * (1 - std::cos(10 * times[k]));
    EXPECT_NEAR(reference->q[2 * k + 1], y, 1e-16);
    EXPECT_EQ(reference->q[2 * k], 0);
  }
}

TEST(QuadReference, KnowsHowErrorsOfAFreeSlideGrow) {
  // An error of 1 in the rate is one of `end` in the place.
  EXPECT_NEAR(quad_amplification(run_of("pp", {"0", "0"}, 3), 3).value(), 3, 1e-6);
}

TEST(QuadReference, IsAlsoThereWithoutASeries) {
  Simulation run = run_of("rr", {"sin(q1)", "-0.5*qd2"}, 1);
  run.chain.bodies[1].joint.friction = 0.2;
  run.chain.bodies[2].joint.damping = 0.1;
  run.chain.has_dissipation = true;
  const auto reference = quad_reference(run, std::vector{1.0});
  ASSERT_TRUE(reference);
  EXPECT_LT(reference->uncertainty[0], 1e-18);
  const Trajectory rk4 = simulate(run, std::vector{1.0});
  EXPECT_NEAR(reference->q[0], rk4.q[0], 1e-6);
  EXPECT_NEAR(reference->q[1], rk4.q[1], 1e-6);
  run.chain.bodies[2].joint.damping = 0;
  EXPECT_GT(std::abs(quad_reference(run, std::vector{1.0})->q[1] - rk4.q[1]), 1e-4);
}

TEST(QuadReference, IsAbsentWhereTorquesAreOnlyDoubles) {
  EXPECT_FALSE(quad_reference(run_of("rr", {"x_G", "0"}, 1), std::vector{1.0}));
  EXPECT_FALSE(quad_amplification(run_of("rr", {"x_G", "0"}, 1), 1));
}

}  // namespace
}  // namespace chainreel
