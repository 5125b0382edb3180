// Corners that are held where the robot has fewer ways to move: which sides, and that it rests on them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/constraints/constraint_rows.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "sim/runs.hpp"
#include "sim/system/even_sides.hpp"
#include "sim/torques_along.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

double largest_of(const std::vector<double>& x) {
  double largest = 0;
  for (const double one : x) largest = std::max(largest, std::abs(one));
  return largest;
}

TEST(EvenSides, ShareALoadAlike) {
  // Two rows that say the same, 3 x1 - x2 = 2: |x| = 2 / (3 + 1) of both.
  std::vector<double> x(2);
  ASSERT_TRUE(EvenSides(2).solve(std::vector{3.0, -1.0, -6.0, 2.0}, std::vector{2.0, -4.0}, x));
  EXPECT_NEAR(x[0], 0.5, 1e-15);
  EXPECT_NEAR(x[1], -0.5, 1e-15);
  // Beside one that is known, -0.9.
  std::vector<double> y(3);
  ASSERT_TRUE(EvenSides(3).solve(std::vector{3.0, -1.0, 0.0, -6.0, 2.0, 0.0, 0.0, 0.0, 5.0}, std::vector{2.0, -4.0, -4.5}, y));
  EXPECT_NEAR(y[0], 0.5, 1e-15);
  EXPECT_NEAR(y[1], -0.5, 1e-15);
  EXPECT_NEAR(y[2], -0.9, 1e-15);
  // What no side moves, no side holds.
  ASSERT_TRUE(EvenSides(2).solve(std::vector{3.0, -1.0, 0.0, 1e-16}, std::vector{2.0, 0.0}, x));
  EXPECT_TRUE(std::isnan(x[0]) && std::isnan(x[1]));
}

TEST(EvenSides, LeaveRegularSystemsAlone) {
  std::vector<double> x{7, 8};
  EXPECT_FALSE(EvenSides(2).solve(std::vector{1.0, 0.0, 0.0, 1e-6}, std::vector{1.0, 1.0}, x)) << "rows of heavy and of light joints";
  EXPECT_FALSE(EvenSides(2).solve(std::vector<double>{1, 1, 1, NAN}, std::vector{1.0, 1.0}, x));
  EXPECT_EQ(x, (std::vector<double>{7, 8}));
}

// Choices of columns double with each corner: beyond kMost none are gone through, and 40 corners fit into no word of bits.
TEST(EvenSides, OfMoreCornersThanCanBeGoneThroughAreLeftAlone) {
  for (const std::size_t n : {EvenSides::kMost, EvenSides::kMost + 1, std::size_t(40)}) {
    EvenSides even(n);
    const std::vector<double> a(n * n, 1), b(n, double(n) / 2);  // all rows alike: singular
    std::vector<double> x(n, 7);
    EXPECT_EQ(even.solve(a, b, x), n <= EvenSides::kMost) << n;
    for (const double one : x) EXPECT_NEAR(one, n <= EvenSides::kMost ? 0.5 : 7, 1e-12) << n;
  }
}

// A = G D of rank r, m x m: no way along its null space has a smaller largest side (what is convex has no other lowest place).
TEST(EvenSides, HaveTheLeastLargestSideThatThereIs) {
  test::Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const std::size_t m = 2 + std::size_t(trial) % 4, r = 1 + std::size_t(trial / 4) % (m - 1);
    const auto left = test::random_vector(m * r, random, 1), right = test::random_vector(r * m, random, 1),
               inside = test::random_vector(m, random, 1);
    std::vector<double> a(m * m), b(m), x(m);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        for (std::size_t k = 0; k < r; ++k) a[i * m + j] += left[i * r + k] * right[k * m + j];
        b[i] += a[i * m + j] * inside[j];
      }
    ASSERT_TRUE(EvenSides(m).solve(a, b, x)) << m << " " << r;
    for (std::size_t i = 0; i < m; ++i) {
      double off = -b[i];
      for (std::size_t j = 0; j < m; ++j) off += a[i * m + j] * x[j];
      EXPECT_NEAR(off, 0, 1e-11) << "round-off over pivots of 1e-3 and more";
    }
    EXPECT_LE(largest_of(x), largest_of(inside) + 1e-11);
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows(right.data(), Eigen::Index(r),
                                                                                                       Eigen::Index(m));
    const Eigen::MatrixXd kernel = Eigen::FullPivLU<Eigen::MatrixXd>(rows).kernel();
    ASSERT_EQ(kernel.cols(), Eigen::Index(m - r));
    for (int way = 0; way < 200; ++way) {
      const auto z = test::random_vector(m - r, random, 1);
      const Eigen::VectorXd step = 1e-3 * kernel * Eigen::Map<const Eigen::VectorXd>(z.data(), kernel.cols());
      std::vector<double> other = x;
      for (std::size_t j = 0; j < m; ++j) other[j] += step[Eigen::Index(j)];
      EXPECT_GE(largest_of(other), largest_of(x) - 1e-11);
    }
  }
}

struct Rest {
  double largest_torque = 0, largest_rate = 0, off = 0;
  RunStatus status = RunStatus::finished;
};

// What holds at every sample from `from` on: how large torques and rates are, and how far tau - nle - Jc^T lambda is
// from zero, which of a robot at rest is all that there is.
Rest rest_of(const Simulation& run, double from) {
  const Trajectory trajectory = simulate(run, instants(run.duration, run.duration / 120));
  Rest rest{0, 0, 0, trajectory.status};
  const std::vector<double> tau = torques_along(run, trajectory);
  const std::size_t nv = std::size_t(run.chain.nv);
  const ConstraintSet set(run.chain, run.constraints.list);
  Workspace ws(run.chain);
  ConstrainedWorkspace cws(run.chain, set);
  for (int k = 0; k < trajectory.size(); ++k) {
    const auto q = trajectory.q_at(k), qd = trajectory.qd_at(k);
    for (std::size_t i = 0; i < nv; ++i) rest.largest_torque = std::max(rest.largest_torque, std::abs(tau[std::size_t(k) * nv + i]));
    if (trajectory.t[std::size_t(k)] < from) continue;
    compute_constraints(run.chain, ws, set, cws, q, qd);
    compute_nle(run.chain, ws, q, qd);
    for (std::size_t i = 0; i < nv; ++i) {
      double off = tau[std::size_t(k) * nv + i] - ws.nle[i];
      for (int row = 0; row < trajectory.rows; ++row) off -= cws.Jc[std::size_t(row) * nv + i] * trajectory.lambda_at(k)[std::size_t(row)];
      rest.off = std::max(rest.off, std::abs(off));
      rest.largest_rate = std::max(rest.largest_rate, std::abs(qd[i]));
    }
  }
  return rest;
}

Simulation with_dry_friction(const std::string& model, double F, std::vector<double> q) {
  std::vector<std::string> torque;
  for (std::size_t i = 1; i <= q.size(); ++i) {
    const std::string f = std::to_string(F), rate = "qd" + std::to_string(i);
    torque.push_back("-" + f + "*(" + rate + ">0)+" + f + "*(" + rate + "<0)");
  }
  Simulation run = run_of(model, torque, 2, "dop853", 0);
  run.q0 = std::move(q);
  run.options.tolerance = 1e-10;
  return run;
}

// Two joints on a line have one way to move, along n with Jc n = 0, and rest where |nle n| <= F (|n1| + |n2|).
TEST(DryFrictionOnALine, OfTwoJointsHoldsWithWhatItHas) {
  const double a = std::numbers::pi / 3, b = a - std::numbers::pi / 1.8;
  const auto on_line = [&](double F) {
    Simulation run = with_dry_friction("rr", F, {a, b - a});
    run.constraints.list = {LineConstraint{"gripper", {0, std::sin(a) + std::sin(b), 0}, {1, 0, 0}}};
    return run;
  };
  const Simulation any = on_line(1);
  Workspace ws(any.chain);
  compute_nle(any.chain, ws, any.q0, any.qd0);
  const double n1 = -std::cos(b), n2 = std::cos(a) + std::cos(b);
  const double enough = std::abs(ws.nle[0] * n1 + ws.nle[1] * n2) / (std::abs(n1) + std::abs(n2));
  for (const double share : {1.01, 1.08, 1.6, 2.2, 2.4, 3.2, 5.0}) {
    const Rest rest = rest_of(on_line(share * enough), 0);
    EXPECT_EQ(rest.status, RunStatus::finished) << share;
    // The projection onto the line leaves 1e-11 m of it, and rates of as little.
    EXPECT_NEAR(rest.largest_torque, enough, 1e-9) << share << ": both carry alike";
    EXPECT_LT(rest.largest_rate, 1e-9) << share;
    EXPECT_LT(rest.off, 1e-9) << share;
  }
  const Rest moves = rest_of(on_line(0.99 * enough), 0);
  EXPECT_LE(moves.largest_torque, 0.99 * enough + 1e-6) << "of the decimals of F";
  EXPECT_GT(moves.largest_rate, 0.01) << "negative control";
}

// Three joints on a line: one side more than there are ways to move.
TEST(DryFrictionOnALine, OfThreeJointsComesToRestWithinItsBounds) {
  for (const double F : {8.0, 12.0, 20.0}) {
    Simulation run = with_dry_friction("rrr", F, {std::numbers::pi / 2, -std::numbers::pi / 2, -std::numbers::pi / 6});
    run.constraints.list = {LineConstraint{"gripper", {0, 0.5, 0}, {1, 0, 0}}};
    const Rest rest = rest_of(run, 1.9);
    EXPECT_EQ(rest.status, RunStatus::finished) << F;
    EXPECT_LE(rest.largest_torque, F * (1 + 1e-9)) << F;
    EXPECT_LT(rest.largest_rate, 1e-8) << F;
    EXPECT_LT(rest.off, 1e-7) << F;
  }
}

}  // namespace
}  // namespace chainreel
