#include "sim/choose_method.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "runs.hpp"
#include "sim/cost_table.hpp"
#include "sim/deviation.hpp"

namespace chainreel {
namespace {

std::vector<double> frames_until(double end) {
  std::vector<double> times;
  for (int k = 0; k < int(std::lround(60 * end)); ++k) times.push_back(k / 60.0);
  return times;
}

Trajectory run_with(Simulation& simulation, const MethodSetting& setting, const std::vector<double>& times) {
  apply(setting, simulation);
  return simulate(simulation, times);
}

// An independent judge: rk4 at 0.1 ms, which neither the choice nor its references use; its own error on RR
// over 3 s is below 1e-9.
double judged_error(Simulation& simulation, const Accuracy& accuracy, const Choice& choice,
                    const std::vector<double>& times) {
  const Trajectory exact = run_with(simulation, {&find_method("rk4"), {}, 1e-4}, times);
  const Trajectory chosen = run_with(simulation, choice.best.setting, times);
  Deviation deviation(simulation.chain, accuracy, motion_size(simulation.chain, exact));
  return deviation.largest(chosen, exact, int(times.size()));
}

TEST(ChooseMethod, MeetsWhatIsAskedInEveryUnit) {
  const std::vector<double> times = frames_until(3);
  for (const char* text : {"1 px", "0.01 px", "1e-5 m", "1e-4 rad", "1e-6 relative"}) {
    Simulation simulation = run_of("rr", {"0", "0"}, 3);
    const Accuracy accuracy = parse_accuracy(text);
    const Choice choice = choose_method(simulation, accuracy, times);
    EXPECT_TRUE(choice.is_met) << text;
    EXPECT_LE(choice.best.error, accuracy.value);
    // The judge and the estimate differ by the judge's own error, far below what is allowed.
    EXPECT_NEAR(judged_error(simulation, accuracy, choice, times) / choice.best.error, 1, 0.05) << text;
    EXPECT_FALSE(choice.holds_until);
  }
}

TEST(ChooseMethod, TakesTheCheapestThatWasTriedAndExactEnough) {
  Simulation simulation = run_of("rr", {"0", "0"}, 3);
  const Choice choice = choose_method(simulation, {0.1, "px"}, frames_until(3));
  int exact = 0, methods_tried = 0;
  const Method* last = nullptr;
  for (const Choice::Candidate& one : choice.tried) {
    methods_tried += one.setting.method != last;
    last = one.setting.method;
    if (!one.trouble.empty() || one.error > 0.1) continue;
    ++exact;
    EXPECT_LE(choice.best.cost, one.cost) << to_string(one.setting);
  }
  EXPECT_GE(exact, 2);
  EXPECT_GE(methods_tried, 5);
}

TEST(ChooseMethod, MoreAccuracyCostsMore) {
  double cost = 0;
  for (const double px : {10.0, 0.1, 1e-3, 1e-6}) {
    Simulation simulation = run_of("rr", {"0", "0"}, 3);
    const Choice choice = choose_method(simulation, {px, "px"}, frames_until(3));
    EXPECT_GT(choice.best.cost, cost) << px;
    cost = choice.best.cost;
  }
}

TEST(ChooseMethod, SaysUntilWhenAChaoticMotionCanBeKnown) {
  // RRR with (10, 10, 10) magnifies errors 8e7 times in 2 s and goes on to do so.
  Simulation simulation = run_of("rrr", {"10", "10", "10"}, 5);
  const Choice choice = choose_method(simulation, {0.1, "px"}, frames_until(5));
  ASSERT_TRUE(choice.holds_until);
  EXPECT_GT(*choice.holds_until, 1.5);
  EXPECT_LT(*choice.holds_until, 4);
}

// Negative control: what no method can reach is not said to be met.
TEST(ChooseMethod, AdmitsWhereNothingIsExactEnough) {
  Simulation simulation = run_of("rr", {"0", "0"}, 3);
  const Choice choice = choose_method(simulation, {1e-13, "relative"}, frames_until(3));
  EXPECT_TRUE(!choice.is_met || choice.holds_until);
}

TEST(Accuracy, ReadsWhatItWritesAndRefusesTheRest) {
  for (const char* text : {"0.1 px", "0.001 m", "0.01 rad"}) EXPECT_EQ(to_string(parse_accuracy(text)), text);
  EXPECT_EQ(parse_accuracy("1e-6").unit, "relative");
  for (const char* text : {"", "px", "0 px", "-1 m", "1 mm", "1e-6 relative and more", "nan px"})
    EXPECT_THROW(parse_accuracy(text), Error) << text;
}

TEST(CostTable, HasARowForEveryMethodAndGrowsWithTheRun) {
  const Chain chain = run_of("rr", {"0", "0"}, 1).chain;
  for (const Method& method : methods()) {
    const double cost = run_cost(chain, method, {}, 100, 100);
    EXPECT_GT(cost, 0) << method.name;
    EXPECT_NEAR(run_cost(chain, method, {}, 200, 200) / cost, 2, 1e-12) << method.name;
  }
}

TEST(Deviation, MeasuresPlacesInMetresAndPixelsAndAnglesInRadians) {
  Simulation simulation = run_of("rr", {"0", "0"}, 1);
  const Trajectory a = simulate(simulation, frames_until(1));
  Trajectory b = a;
  const int k = 10;
  b.q[2 * k + 1] += 0.01;  // the elbow: the tip moves 1 m away from it
  const MotionSize size = motion_size(simulation.chain, a);
  const auto apart = [&](const char* unit) {
    return Deviation(simulation.chain, {1, unit}, size).at(a, b, k);
  };
  EXPECT_NEAR(apart("rad"), 0.01, 1e-15);
  // The chord of the angle over an arm of 1 m, with the rounding of some sines.
  EXPECT_NEAR(apart("m"), 2 * std::sin(0.005), 1e-14);
  EXPECT_NEAR(apart("px"), apart("m") / size.metres_per_px, 1e-10);
  EXPECT_NEAR(apart("relative"), apart("m") / size.diagonal, 1e-14);
  EXPECT_EQ(Deviation(simulation.chain, {1, "m"}, size).at(a, b, k + 1), 0);
  b.q[2 * k] = std::nan("");
  EXPECT_TRUE(std::isinf(apart("px")));
}

}  // namespace
}  // namespace chainreel
