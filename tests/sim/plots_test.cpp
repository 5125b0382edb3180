// What plots show of a run.
#include "sim/plots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/runs.hpp"
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

// A spring in a joint holds 1/2 k (q - a)^2 from the start on: without a damper the total stays as it is, with another torque it does not.
TEST(Plots, OfEnergiesHaveThatOfSpringsInTheirTotal) {
  Simulation run = pendulum({{"energy", "", {}}});
  const auto energies_under = [&](const std::vector<TorqueEntry>& torques) {
    run.torque = make_torque_law(run.chain, torques, {});
    return plot_curves(run, simulate(run, kTimes), int(kTimes.size())).front().curves;
  };
  const std::vector<PlotCurve> spring = energies_under({{"-7 * (q1 - 0.5)", {}, {}}, {"0", {}, {}}});
  ASSERT_EQ(spring.size(), 4u);
  EXPECT_EQ(spring[2].name, "springs");
  EXPECT_DOUBLE_EQ(spring[2].y[0], 0.5 * 7 * 0.2 * 0.2);
  double moved = 0;
  for (std::size_t k = 0; k < kTimes.size(); ++k) {
    EXPECT_NEAR(spring[3].y[k], spring[3].y[0], 1e-8) << "what dop853 at 1e-10 adds in a second";
    moved = std::max(moved, std::abs(spring[2].y[k] - spring[2].y[0]));
  }
  EXPECT_GT(moved, 0.01);
  const std::vector<PlotCurve> motor = energies_under({{"-7 * (q1 - 0.5)", {}, {}}, {"3", {}, {}}});
  EXPECT_GT(std::abs(motor[3].y[4] - motor[3].y[0]), 0.01) << "the motor's work is none of it";
  EXPECT_EQ(energies_under({{"7 * q1", {}, {}}, {"0", {}, {}}}).size(), 3u) << "what pushes away is no spring";
}

// Of what swings so fast that it would take off in between: a centre of pressure far from the foot, or none at all, would leave
// no height for the rest of the curve.
TEST(Plots, OfTheCentreOfPressureHaveGapsWhereNothingPressesNearTheFoot) {
  Simulation run = pendulum({});
  const Foot foot{.heel = -0.1, .toe = 0.3};
  run.q0 = {0.5, 0}, run.qd0 = {9, 0};
  run.torque = make_torque_law(run.chain, {{"40", {}, {}}, {"0", {}, {}}}, {});
  run.plots = make_plots(run.chain, {{"cop", "", {}}, {"grf", "", {}}}, {}, {}, foot);
  std::vector<double> times;
  for (int k = 0; k <= 200; ++k) times.push_back(0.005 * k);
  const auto plots = plot_curves(run, simulate(run, times), int(times.size()));
  int pulls = 0, far = 0, near = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double cop = plots[0].curves[0].y[k], grf = plots[1].curves[0].y[k];
    EXPECT_TRUE(std::isfinite(grf));
    (std::isfinite(cop) ? near : grf > 0 ? far : pulls)++;
    if (!std::isfinite(cop)) continue;
    EXPECT_GT(grf, 0);
    EXPECT_LT(std::abs(cop - 0.1), 3 * 0.4);
  }
  EXPECT_GT(pulls, 10);
  EXPECT_GT(far, 0);
  EXPECT_GT(near, 10);
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

// Curves say whose they are, so that pictures can draw them as that body: of joints, of places; not of two bodies, nor of none.
TEST(Plots, SayWhoseTheyAre) {
  const auto plots = curves_of({{"q", "", {}}, {"tau", "", {}}, {"q2", "", {}}, {"qd1^2 + t", "", {}}, {"k * y_G", "", {}}, {"q1 + q2", "", {}}, {"t^2", "", {}}, {"energy", "", {}}});
  std::vector<std::vector<int>> bodies;
  for (const PlotCurves& plot : plots) {
    bodies.emplace_back();
    for (const PlotCurve& curve : plot.curves) bodies.back().push_back(curve.body);
  }
  EXPECT_EQ(bodies, (std::vector<std::vector<int>>{{1, 2}, {1, 2}, {2}, {1}, {2}, {0}, {0}, {0, 0, 0}}));
}

// Samples beside a pole are as high as chance has it: the curve is cut there; one that only jumps, or is steep, is whole. q1 = t.
TEST(Plots, AreCutAtPoles) {
  Simulation run = run_of("pp", {"0", "0"}, 2, "rk4", 0.01);
  run.chain.gravity.setZero();
  run.torque = make_torque_law(run.chain, {{"0", {}, {}}, {"0", {}, {}}}, {});
  run.qd0[0] = 1;
  run.plots = make_plots(run.chain, {{"1 / (q1 - 0.503)", "", {}}, {"tan(3 * q1)", "", {}}, {"20 * (t > 0.5) - 10", "", {}}, {"exp(4 * q1) - exp(2 - 4 * q1)", "", {}}, {"5 * t + 0.001 / (q1 - 1)", "", {}}, {"1 / (q1 - 1)^2", "", {}}}, {}, {}, std::nullopt, 0);
  std::vector<double> times;
  for (int k = 0; k <= 120; ++k) times.push_back(k / 60.0);
  const auto plots = plot_curves(run, simulate(run, times), int(times.size()));
  for (std::size_t i = 0; i < plots.size(); ++i) {
    double highest = 0;
    int gaps = 0;
    for (const double y : plots[i].curves[0].y) std::isfinite(y) ? void(highest = std::max(highest, std::abs(y))) : void(++gaps);
    if (i >= 4) {  // samples that fell on a pole, which no growth announces
      EXPECT_LE(gaps, 2) << plots[i].title;
      EXPECT_LT(highest, 4000) << plots[i].title;
      continue;
    }
    if (i >= 2) {
      EXPECT_EQ(gaps, 0) << plots[i].title;
      continue;
    }
    EXPECT_GE(gaps, 2) << plots[i].title;
    EXPECT_LT(gaps, 20) << plots[i].title;
    EXPECT_LT(highest, 15) << plots[i].title << ": six times what it usually is";
  }
}

// A needle of one sample looks like a pole, and is told by its height where it is left out.
TEST(Plots, TellTheHeightOfASampleThatIsLeftOut) {
  Simulation run = run_of("pp", {"0", "0"}, 2, "rk4", 0.01);
  run.plots = make_plots(run.chain, {{"100 * exp(-((t - 1) / 0.002)^2)", "", {}}, {"sin(t)", "", {}}}, {}, {}, std::nullopt, 0);
  std::vector<double> times;
  for (int k = 0; k <= 120; ++k) times.push_back(k / 60.0);
  const auto plots = plot_curves(run, simulate(run, times), int(times.size()));
  EXPECT_NEAR(plots[0].curves[0].alone, 100, 1e-6);
  EXPECT_EQ(std::count_if(plots[0].curves[0].y.begin(), plots[0].curves[0].y.end(), [](double y) { return std::isnan(y); }), 1);
  EXPECT_EQ(plots[1].curves[0].alone, 0) << "negative control";
}

TEST(Plots, EnergyErrorIsTheAudits) {
  const auto plots = curves_of({{"energy_error", "", {}}, {"energy", "", {}}});
  // At a tolerance of 1e-10 over a second; the energy itself changes by the torques' work.
  for (const double error : plots[0].curves[0].y) EXPECT_LT(std::abs(error), 1e-8);
  EXPECT_GT(std::abs(plots[1].curves[2].y.back() - plots[1].curves[2].y.front()), 0.1);
}

// RR of unit links and masses: Lambda = diag(1, 2) at a right angle; stretched, nothing moves it along itself.
TEST(Plots, OfTheEffectiveMassAreTheAxesOfItsEllipse) {
  constexpr double kRoundOff = 1e-12;
  Simulation run = pendulum({{"effective_mass", "", {}}, {"energy_speed", "", {}}});
  const auto first_of = [&](double q2) {
    run.q0 = {0, q2};
    run.qd0 = {0, 0};
    return plot_curves(run, simulate(run, kTimes), int(kTimes.size()));
  };
  const auto bent = first_of(M_PI / 2);
  EXPECT_EQ(bent[0].title, "effective mass [kg]");
  ASSERT_EQ(bent[0].curves.size(), 2u);
  EXPECT_EQ(bent[0].curves[0].name, "Lambda1");
  EXPECT_NEAR(bent[0].curves[0].y[0], 2, kRoundOff) << "the largest first";
  EXPECT_NEAR(bent[0].curves[1].y[0], 1, kRoundOff);
  EXPECT_NEAR(bent[1].curves[0].y[0], 1, kRoundOff) << "m v^2 / 2 = 0.5 J";
  EXPECT_NEAR(bent[1].curves[1].y[0], 1 / std::sqrt(2), kRoundOff);
  const auto stretched = first_of(0);
  EXPECT_TRUE(std::isinf(stretched[0].curves[0].y[0])) << "and no large number";
  EXPECT_TRUE(std::isfinite(stretched[0].curves[1].y[0]));
  EXPECT_EQ(stretched[1].curves[1].y[0], 0);
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

// What is kept between the samples: torques that jump do so there where they do, a ten-thousandth of the instants' distance
// wide; and the run is the same to the last bit.
TEST(Between, HasBothSidesOfEachStepAndLeavesTheRunAsItIs) {
  Simulation run = run_of("rr", {"8*(t>1.013)", "3*(q1>-0.2)-2"}, 2, "dop853", 0);
  run.options.tolerance = 1e-9;
  run.q0 = {0.1, 0.3};
  run.plots = make_plots(run.chain, {{"tau", "", {}}}, {});
  const std::vector<double> frames = instants(2, 0.1);
  constexpr double kApart = 0.01, kEdge = 1e-4 * kApart;
  const Trajectory plain = simulate(run, frames), kept = simulate(run, frames, {}, {}, kApart);
  EXPECT_EQ(plain.between, nullptr);
  EXPECT_EQ(plain.t, kept.t);
  EXPECT_EQ(plain.q, kept.q);
  EXPECT_EQ(plain.qd, kept.qd);
  EXPECT_EQ(plain.work, kept.work);
  EXPECT_EQ(plain.evaluations, kept.evaluations);
  EXPECT_EQ(plain.steps, kept.steps);
  ASSERT_TRUE(kept.between);
  const Trajectory& between = *kept.between;
  EXPECT_GT(between.size(), 190);
  EXPECT_TRUE(std::is_sorted(between.t.begin(), between.t.end()));
  for (int k = 0; k < kept.size(); ++k) {
    const auto at = std::find(between.t.begin(), between.t.end(), kept.t[std::size_t(k)]);
    ASSERT_NE(at, between.t.end());
    EXPECT_EQ(between.q_at(int(at - between.t.begin()))[0], kept.q_at(k)[0]);
  }
  // How wide the jumps of a curve are, and where.
  const auto jumps = [&](const Trajectory& of, std::size_t curve) {
    const std::vector<double> tau = plot_curves(run, of, of.size())[0].curves[curve].y;
    std::vector<std::pair<double, double>> found;
    for (std::size_t k = 1; k < tau.size(); ++k)
      if (tau[k] != tau[k - 1]) found.push_back({of.t[k - 1], of.t[k]});
    return found;
  };
  const auto in_time = jumps(between, 0), in_place = jumps(between, 1);
  ASSERT_EQ(in_time.size(), 1u);
  EXPECT_LT(in_time[0].second - in_time[0].first, kEdge);
  EXPECT_TRUE(in_time[0].first <= 1.013 && in_time[0].second >= 1.013);
  ASSERT_GE(in_place.size(), 1u);
  for (const auto& [from, until] : in_place) EXPECT_LT(until - from, kEdge) << from;
  EXPECT_NEAR(jumps(kept, 0)[0].second - jumps(kept, 0)[0].first, 0.1, 1e-9) << "negative control: at the frames it is a ramp";
}

}  // namespace
}  // namespace chainreel::test
