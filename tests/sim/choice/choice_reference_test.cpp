#include "sim/choice/choice_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sim/choice/error_growth.hpp"
#include "sim/runs.hpp"

namespace chainreel {
namespace {

std::vector<double> half_frames_until(double end) {
  std::vector<double> times;
  for (int k = 0; k <= int(std::lround(120 * end)); ++k) times.push_back(k / 120.0);
  return times;
}

// Torques with feedback have no series.
Simulation driven(double end) { return run_of("rr", {"5*sin(3*t) - 2*qd1", "-4*q2 - qd2"}, end); }

std::optional<ChoiceReference> quick_of(Simulation& simulation, const Accuracy& accuracy) {
  const ChoiceWatch watch;
  CountedRuns runs(simulation, 6e9, watch);
  return find_quick_reference(runs, accuracy, half_frames_until(simulation.duration));
}

ChoiceReference exact_of(Simulation& simulation, const Accuracy& accuracy) {
  const ChoiceWatch watch;
  CountedRuns runs(simulation, 6e9, watch);
  return find_reference(runs, accuracy, half_frames_until(simulation.duration));
}

// What it says of itself holds against the reference that is as exact as can be, whose own error is 1e-5 of that.
TEST(QuickReference, IsNoFurtherOffThanItSays) {
  Simulation simulation = driven(3);
  const Accuracy accuracy{0.1, AccuracyUnit::px};
  const auto quick = quick_of(simulation, accuracy);
  ASSERT_TRUE(quick);
  EXPECT_TRUE(quick->is_quick && quick->is_whole);
  const ChoiceReference exact = exact_of(simulation, accuracy);
  EXPECT_FALSE(exact.is_quick);
  ASSERT_EQ(quick->samples, exact.samples);
  Deviation deviation(simulation, accuracy, exact.size);
  const double said = *std::max_element(quick->uncertainty.begin(), quick->uncertainty.end());
  EXPECT_LE(said, 0.01 * accuracy.value);
  EXPECT_GT(said, 0);
  EXPECT_LE(deviation.largest(quick->run, exact.run, quick->samples), 2 * said);
}

TEST(QuickReference, IsNoneWhereMoreIsAskedOrDoublesPartOrASeriesIsQuicker) {
  Simulation simulation = driven(3);
  EXPECT_FALSE(quick_of(simulation, {1e-9, AccuracyUnit::px}));
  Simulation series = run_of("rr", {"1", "2"}, 3);
  EXPECT_FALSE(quick_of(series, {0.1, AccuracyUnit::px}));
  Simulation chaotic = run_of("rr", {"sin(t)", "0"}, 60);
  EXPECT_FALSE(quick_of(chaotic, {0.1, AccuracyUnit::px}));
}

// e^(20 k) from 1e-8 on: one that saturates at 10 has left what is small where the other has not.
std::vector<double> grown(double first, double most) {
  std::vector<double> errors;
  for (int k = 0; k <= 20; ++k) errors.push_back(std::min(first * std::exp(double(k)), most));
  return errors;
}

TEST(ErrorGrowth, TellsWhatErrorsWouldBeThatWereBounded) {
  ErrorGrowth growth(1);
  EXPECT_EQ(growth.unbounded(grown(1e-6, 10)), 10) << "no run is known";
  growth.learn(grown(1e-3, 10));
  EXPECT_EQ(growth.unbounded(grown(1e-6, 10)), 10) << "a run that is off itself tells nothing";
  growth.learn(grown(1e-9, 10));
  EXPECT_NEAR(growth.unbounded(grown(1e-6, 10)) / (1e-6 * std::exp(20.0)), 1, 1e-12);
  EXPECT_EQ(growth.unbounded(grown(1e-10, 10)), 1e-10 * std::exp(20.0)) << "small to the end";
  EXPECT_EQ(growth.unbounded({2, 3}), 3) << "of other samples";
  // The least growing run counts.
  growth.learn(std::vector<double>(21, 0.5));
  EXPECT_EQ(growth.unbounded(grown(1e-6, 10)), 10);
}

}  // namespace
}  // namespace chainreel
