#include "sim/between_samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/runs.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::optional<Doubt> doubt_of(const std::vector<std::string>& torque, double fps, double duration = 2) {
  Simulation run = run_of("rr", torque, duration, "dop853", 0);
  run.options.tolerance = 1e-9;
  run.q0 = {-std::acos(0.0), 0.3};
  return doubt_between(run, simulate(run, instants(duration, 1 / fps)));
}

// 29 Hz at 30 frames a second look like 1 Hz.
TEST(BetweenSamples, FindsATorqueFasterThanTheFrames) {
  const std::optional<Doubt> doubt = doubt_of({"8*sin(2*pi*29*t)", "0"}, 30);
  ASSERT_TRUE(doubt);
  EXPECT_EQ(doubt->kind, "samples");
  // Of a range of 16 N m up to all may lie beyond both frames; near the zeros of the slow wave it is nearly half.
  EXPECT_GT(doubt->amount, 0.3);
  EXPECT_THAT(doubt->words, AllOf(HasSubstr("tau1"), HasSubstr("between two frames or rows")));
  EXPECT_THAT(doubt->remedy, AllOf(HasSubstr("--set video.fps=240"), HasSubstr("--every-step")));
}

// Pulses have kinks, between which the torque is looked at, however short they are.
TEST(BetweenSamples, FindsAPulseThatNoFrameMeets) {
  for (const char* pulse : {"20*(t>1.005)*(t<1.020)", "20*(t>1.0101)*(t<1.0102)"}) {
    const std::optional<Doubt> doubt = doubt_of({pulse, "0"}, 30);
    ASSERT_TRUE(doubt) << pulse;
    EXPECT_NEAR(doubt->amount, 1, 1e-9) << pulse;
  }
}

// A pen whose chain is all but stretched for an instant presses on its line with a peak that is narrower than a frame.
// Oracle: the same run with a row a step, whose multipliers are the run's own.
TEST(BetweenSamples, FindsAPeakOfMultipliersThatNoFrameMeets) {
  Simulation run = run_of("rrr", {"-6*sin(2*t)", "0", "0"}, 2, "dop853", 0);
  run.options.tolerance = 1e-10;
  run.q0 = {std::acos(0.0), -std::acos(0.0), -std::acos(0.0) / 3};
  run.constraints.list = {LineConstraint{"gripper", {0, 0.5, 0}, {1, 0, 0}}};
  const auto range = [](const Trajectory& trajectory) {
    const auto [low, high] = std::minmax_element(trajectory.lambda.begin(), trajectory.lambda.end());
    return std::pair(*low, *high);
  };
  const auto [low, high] = range(simulate_every_step(run));
  int found = 0;
  for (const double fps : {20.0, 30.0, 960.0}) {
    const Trajectory framed = simulate(run, instants(2, 1 / fps));
    const auto [least, most] = range(framed);
    const double hidden = std::max(high - most, least - low);
    const std::optional<Doubt> doubt = doubt_between(run, framed);
    if (fps > 900) {
      EXPECT_FALSE(doubt) << doubt->words;
    } else if (hidden > 0.2 * (most - least)) {
      ++found;
      ASSERT_TRUE(doubt) << fps;
      EXPECT_THAT(doubt->words, HasSubstr("lambda"));
      EXPECT_GT(doubt->amount, 0.5 * hidden / (high - low)) << fps;
      // By the run itself, where two frames' cubic gave a half of it; three digits are said, at 200 instants a frame.
      const std::string& words = doubt->words;
      EXPECT_GT(std::stod(words.substr(words.find("goes ") + 5)), 0.98 * hidden) << fps << words;
    }
  }
  EXPECT_GT(found, 0) << "a test that looks at nothing";
}

// Negative controls: smooth motions, torques that jump once and what rests say nothing.
TEST(BetweenSamples, SaysNothingOfWhatTheFramesShow) {
  for (const char* smooth : {"0", "5*sin(3*t)", "8*(t>1.01)", "30*(0.5-q1)-8*qd1", "-qd1"})
    EXPECT_FALSE(doubt_of({smooth, "0"}, 30)) << smooth << ": " << doubt_of({smooth, "0"}, 30)->words;
  // Behind a jump within the first frame a cubic swings as far as nothing does.
  Simulation driven = run_of("rr", {"max(-20, min(20, 60*(1-q1) - 15*qd1))", "max(-20, min(20, 60*(-0.8-q2) - 15*qd2))"}, 4, "dop853", 0);
  driven.options.tolerance = 1e-9;
  driven.q0 = {-std::acos(0.0), 0};
  const std::optional<Doubt> doubt = doubt_between(driven, simulate(driven, instants(4, 1.0 / 60)));
  EXPECT_FALSE(doubt) << doubt->words;
  Simulation still = run_of("rr", {"-qd1", "-qd2"}, 1, "dop853", 0);
  still.options.tolerance = 1e-9;
  still.q0 = {-std::acos(0.0), 0};
  EXPECT_FALSE(doubt_between(still, simulate(still, instants(1, 1.0 / 30))));
}

// The same torque is well shown at what the remedy names, and by a row a step.
TEST(BetweenSamples, IsContentWithTheRemedy) {
  EXPECT_FALSE(doubt_of({"8*sin(2*pi*29*t)", "0"}, 480));
  Simulation run = run_of("rr", {"8*sin(2*pi*29*t)", "0"}, 1, "dop853", 0);
  run.options.tolerance = 1e-9;
  EXPECT_FALSE(doubt_between(run, simulate_every_step(run)));
}

}  // namespace
}  // namespace chainreel
