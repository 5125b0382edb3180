#include "sim/choice/curve_deviation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/choice/choose_method.hpp"
#include "sim/choice/deviation.hpp"
#include "sim/runs.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

std::vector<double> frames_of(double end) {
  std::vector<double> times;
  for (int k = 0; k < int(std::lround(30 * end)); ++k) times.push_back(k / 30.0);
  return times;
}

// Feedback that comes to rest: coarse steps keep the places and shake the rates.
const std::vector<std::string> kSettling{"60*(0.5-q1)-8*qd1", "30*(0.8-q2)-4*qd2"};

double range_of(const std::vector<double>& table, std::size_t i, std::size_t n) {
  double low = table[i], high = table[i];
  for (std::size_t k = i; k < table.size(); k += n) low = std::min(low, table[k]), high = std::max(high, table[k]);
  return high - low;
}

// The largest share of its column's range by which a table is off.
double off_by(const std::vector<double>& table, const std::vector<double>& exact, std::size_t n) {
  double largest = 0;
  for (std::size_t k = 0; k < exact.size(); ++k)
    largest = std::max(largest, std::abs(table[k] - exact[k]) / range_of(exact, k % n, n));
  return largest;
}

struct JudgedRun {
  double rates, torques;  // shares of ranges
};

// To rk4 at 0.1 ms, which neither the choice nor its references use; its own error is below 1e-8 of these ranges.
JudgedRun judge(Simulation& simulation, const MethodSetting& setting, const std::vector<double>& times) {
  apply({&find_method("rk4"), {}, 1e-4}, simulation);
  const Trajectory exact = simulate(simulation, times);
  const std::vector<double> torques = torques_along(simulation, exact);
  apply(setting, simulation);
  const Trajectory run = simulate(simulation, times);
  const auto n = std::size_t(simulation.chain.nv);
  return {off_by(run.qd, exact.qd, n), off_by(torques_along(simulation, run), torques, n)};
}

TEST(CurveDeviation, RatesAndTorquesOfAChoiceAreRightToAThousandthOfTheirRange) {
  const std::vector<double> times = frames_of(4);
  Simulation simulation = run_of("rr", kSettling, 4);
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, times);
  ASSERT_TRUE(choice.is_met);
  EXPECT_DOUBLE_EQ(choice.curve_allowed, 1e-3);
  ASSERT_TRUE(choice.best.curve_error);
  EXPECT_LE(*choice.best.curve_error, 1e-3);
  const JudgedRun judged = judge(simulation, choice.best.setting, times);
  EXPECT_LE(std::max(judged.rates, judged.torques), *choice.best.curve_error * 1.001);

  // Negative control: the cheapest that keeps the points alone is cheaper, and misses curves by what it says.
  const Choice::Candidate* points_alone = nullptr;
  for (const Choice::Candidate& one : choice.tried)
    if (one.trouble.empty() && one.error <= 0.1 && (!points_alone || one.cost < points_alone->cost)) points_alone = &one;
  ASSERT_TRUE(points_alone);
  EXPECT_LT(points_alone->cost, choice.best.cost);
  EXPECT_GT(*points_alone->curve_error, 1e-3);
  const JudgedRun worse = judge(simulation, points_alone->setting, times);
  EXPECT_GT(std::max(worse.rates, worse.torques), 1e-3);
}

TEST(CurveDeviation, AllowsCurvesAsManyHundredthsAsPixelsInEveryUnit) {
  const MotionSize size{{0.001, 1}, {0.002, 2}};
  const auto share = [&](const char* text) { return share_of_curves(parse_accuracy(text), size); };
  EXPECT_DOUBLE_EQ(share("0.1 px"), 1e-3);
  EXPECT_DOUBLE_EQ(share("2e-4 m"), 1e-3);         // 0.1 px of the bodies' picture
  EXPECT_DOUBLE_EQ(share("1e-4 relative"), 1e-3);  // of 2 m
  EXPECT_DOUBLE_EQ(share("1e-4 rad"), 1e-3);
}

TEST(CurveDeviation, JudgesMultipliersUnderConstraints) {
  Simulation tied = run_of("rrr", {"2*sin(9*t)-2*qd1", "-2*qd2", "-2*qd3"}, 1);
  const double right = std::acos(0.0);
  tied.q0 = {right, -right, -right / 3};  // on the line
  tied.constraints.list = {LineConstraint{"gripper", {0, 0.5, 0}, {1, 0, 0}}};
  const Choice choice = choose_method(tied, {0.1, AccuracyUnit::px}, frames_of(1));
  ASSERT_TRUE(choice.is_met && choice.best.curve_error);
  ASSERT_FALSE(choice.holds_until) << choice.why_until;
  const std::vector<double> judged = instants(1, 1.0 / 60);  // frames and halves between them
  const Trajectory run = simulate(tied, judged);
  ASSERT_EQ(run.rows, 1);
  apply({&find_method("rk4"), {}, 1e-4}, tied);
  EXPECT_LE(off_by(run.lambda, simulate(tied, judged).lambda, 1), *choice.best.curve_error * 1.001);
}

// A torque that jumps with the state: instants near it may lie on either side, and that is nobody's error.
TEST(CurveDeviation, JumpsLeaveAChoice) {
  const std::vector<double> times = frames_of(3);
  Simulation simulation = run_of("rr", {"6*((q1>-1)-(q1<=-1))-2*qd1", "-qd2"}, 3);
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, times);
  EXPECT_TRUE(choice.is_met);
}

// What stands still has curves of no range but rounding: that is no reason to find nothing exact enough.
TEST(CurveDeviation, RestIsExactEnough) {
  Simulation simulation = run_of("rr", {"-qd1", "-qd2"}, 2);
  simulation.q0 = {-std::acos(0.0), 0};
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, frames_of(2));
  EXPECT_TRUE(choice.is_met);
  EXPECT_FALSE(choice.holds_until);
}

// Between what is compared, a reference whose own confirmation is too far off judges nothing, and says so.
TEST(CurveDeviation, SaysOfWhichCurveItsReferencesPart) {
  const std::vector<double> times = frames_of(1);
  Simulation simulation = run_of("rr", {"-qd1", "-qd2"}, 1, "rk4", 1e-3);
  ChoiceReference reference;
  reference.run = reference.other = simulate(simulation, times);
  reference.samples = reference.run.size();
  EXPECT_EQ(CurveDeviation(simulation, reference, 1e-3).remark(), "");
  reference.other.qd[2 * 10] += 0.1;
  const CurveDeviation deviation(simulation, reference, 1e-3);
  EXPECT_THAT(deviation.remark(), HasSubstr("references lie"));
  // Neither there nor elsewhere is the reference off itself by what is compared.
  EXPECT_EQ(deviation.largest(reference.run).share, 0);
  Trajectory off = reference.run;
  off.qd[2 * 20 + 1] += 0.1;
  EXPECT_GT(deviation.largest(off).share, 1e-3);
  off.qd[2 * 20 + 1] = std::nan("");
  EXPECT_TRUE(std::isinf(deviation.largest(off).share));
}

}  // namespace
}  // namespace chainreel
