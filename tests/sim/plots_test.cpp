// What plots show of a run.
#include "sim/plots.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/simulate.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

Simulation pendulum(const std::vector<PlotEntry>& plots) {
  Simulation run;
  run.chain = rr_chain();
  run.q0 = {0.3, -0.2};
  run.qd0 = {0.5, 0.1};
  run.torque = make_torque_law(run.chain, {{"1.5", {}, {}}, {"2 * t", {}, {}}}, {});
  run.method = &find_method("dop853");
  run.options = {1e-10, 0};
  run.step = 0;
  run.duration = 1;
  run.plots = make_plots(run.chain, plots, {{"k", 3}});
  return run;
}

const std::vector<double> kTimes{0, 0.25, 0.5, 0.75, 1};

std::vector<PlotCurves> curves_of(const std::vector<PlotEntry>& plots) {
  const Simulation run = pendulum(plots);
  return plot_curves(run, simulate(run, kTimes), int(kTimes.size()));
}

TEST(Plots, ShowQuantitiesByName) {
  const auto plots = curves_of({{"energy", "", {}}, {"q", "", {}}, {"tau", "", {}}});
  ASSERT_EQ(plots.size(), 3u);
  EXPECT_EQ(plots[0].title, "energy [J]");
  EXPECT_EQ(plots[1].title, "q [rad]");
  EXPECT_TRUE(plots[1].angles);
  EXPECT_EQ(plots[2].title, "tau [N m]");
  ASSERT_EQ(plots[0].curves.size(), 3u);
  for (std::size_t k = 0; k < kTimes.size(); ++k) {
    EXPECT_DOUBLE_EQ(plots[0].curves[0].y[k] + plots[0].curves[1].y[k], plots[0].curves[2].y[k]);
    EXPECT_DOUBLE_EQ(plots[2].curves[0].y[k], 1.5);
    EXPECT_DOUBLE_EQ(plots[2].curves[1].y[k], 2 * kTimes[k]);
  }
  EXPECT_EQ(plots[1].curves[1].name, "q2");
  EXPECT_EQ(plots[1].curves[1].y[0], -0.2);
}

// rr_chain: two links of 1 m, so that the tip's height has a closed form in q.
TEST(Plots, EvaluateExpressionsAtTheSamples) {
  const auto plots =
      curves_of({{"k * y_G", "three times the height [m]", {}}, {"q", "", {}}, {"t^2", "", {}}});
  EXPECT_EQ(plots[0].title, "three times the height [m]");
  EXPECT_EQ(plots[2].title, "t^2");
  for (std::size_t k = 0; k < kTimes.size(); ++k) {
    const double q1 = plots[1].curves[0].y[k], q2 = plots[1].curves[1].y[k];
    // Some round-offs of numbers up to 6.
    EXPECT_NEAR(plots[0].curves[0].y[k], 3 * (std::sin(q1) + std::sin(q1 + q2)), 1e-14);
    EXPECT_EQ(plots[2].curves[0].y[k], kTimes[k] * kTimes[k]);
  }
}

TEST(Plots, EnergyErrorIsTheAudits) {
  const auto plots = curves_of({{"energy_error", "", {}}, {"energy", "", {}}});
  // At a tolerance of 1e-10 over a second; the energy itself changes by the torques' work.
  for (const double error : plots[0].curves[0].y) EXPECT_LT(std::abs(error), 1e-8);
  EXPECT_GT(std::abs(plots[1].curves[2].y.back() - plots[1].curves[2].y.front()), 0.1);
}

TEST(Plots, SayWhatTheyCannotShow) {
  const Chain chain = rr_chain();
  EXPECT_EQ(make_plots(chain, {}, {}), nullptr);
  try {
    make_plots(chain, {{"energi", "", {"scene.yaml", 7, 3}}, {"lambda", "", {"scene.yaml", 8, 3}}}, {});
    FAIL() << "a misspelt quantity and multipliers without constraints were taken";
  } catch (const Error& error) {
    ASSERT_EQ(error.problems().size(), 2u);
    EXPECT_EQ(error.problems()[0].place.line, 7);
    EXPECT_NE(error.problems()[0].message.find("energi"), std::string::npos);
    EXPECT_NE(error.problems()[1].message.find("no constraints"), std::string::npos);
  }
}

}  // namespace
}  // namespace chainreel::test
