#include "sim/choice/choose_method.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "sim/choice/counted_runs.hpp"
#include "sim/choice/deviation.hpp"
#include "sim/choice/quad_reference.hpp"
#include "sim/cost_table.hpp"
#include "sim/runs.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
  Deviation deviation(simulation, accuracy, motion_size(simulation, exact));
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
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, frames_until(3));
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
    const Choice choice = choose_method(simulation, {px, AccuracyUnit::px}, frames_until(3));
    EXPECT_GT(choice.best.cost, cost) << px;
    cost = choice.best.cost;
  }
}

TEST(ChooseMethod, SaysUntilWhenAChaoticMotionCanBeKnown) {
  // RRR with (10, 10, 10) magnifies errors 8e7 times in 2 s and goes on to do so.
  Simulation simulation = run_of("rrr", {"10", "10", "10"}, 5);
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, frames_until(5));
  ASSERT_TRUE(choice.holds_until);
  EXPECT_GT(*choice.holds_until, 1.5);
  EXPECT_LT(*choice.holds_until, 4);
  // What is cheapest until there would lose the rest sooner than it has to.
  EXPECT_TRUE(simulation.method->adaptive);
  EXPECT_LE(simulation.options.tolerance, 1e-6);
  const double cheapest = std::min_element(choice.tried.begin(), choice.tried.end(), [](const auto& a, const auto& b) {
                            return (a.trouble.empty() && a.error <= 0.1 ? a.cost : kInfinity) < (b.trouble.empty() && b.error <= 0.1 ? b.cost : kInfinity);
                          })->cost;
  EXPECT_GT(choice.best.cost, cheapest);
}

std::string message_of(Simulation& simulation, const Accuracy& accuracy, double end) {
  try {
    choose_method(simulation, accuracy, frames_until(end));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::numerical);
    return error.what();
  }
  return "";
}

// Places of an RR are some metres from the origin: doubles hold them to 4e-16 m.
TEST(ChooseMethod, RefusesWhatDoublesDoNotHoldAndSaysWhatCanBeHad) {
  for (const Accuracy& accuracy : {Accuracy{1e-16, AccuracyUnit::m}, {1e-14, AccuracyUnit::px}, {1e-17, AccuracyUnit::rad},
                                  {1e-17, AccuracyUnit::relative}}) {
    Simulation simulation = run_of("rr", {"0", "0"}, 3);
    EXPECT_THAT(message_of(simulation, accuracy, 3), AllOf(HasSubstr("below what doubles hold"), HasSubstr("Ask for")))
        << to_string(accuracy);
  }
}

// A start a hair beside the upright balance: two runs in doubles part by half of what is asked for at 3.5 s, but one of
// them is right to the end.
TEST(ChooseMethod, PromisesToTheEndWhereQuadruplePrecisionConfirmsIt) {
  Simulation simulation = run_of("rr", {"0", "0"}, 12);
  simulation.q0 = {1.57079632, 0};
  const std::vector<double> times = frames_until(12);
  const Choice choice = choose_method(simulation, {0.001, AccuracyUnit::px}, times);
  EXPECT_TRUE(choice.is_met);
  EXPECT_FALSE(choice.holds_until) << *choice.holds_until << choice.why_until;
  EXPECT_LE(choice.best.error, 0.001);
  // By extrapolation, which shares no text with the series.
  const auto quads = quad_reference(simulation, std::vector<double>{12});
  ASSERT_TRUE(quads);
  simulation.duration = 12;
  const Trajectory run = simulate(simulation, std::vector<double>{12});
  Trajectory exact = run;
  exact.q = quads->q;
  Deviation deviation(simulation, {0.001, AccuracyUnit::px}, motion_size(simulation, simulate(simulation, times)));
  EXPECT_LE(deviation.at(run, exact, 0), 0.001);
}

// Over 60 s an RR magnifies errors so much that doubles lose it: behind 26.45 s, not at 22.8 s where two runs in doubles
// part.
TEST(ChooseMethod, FindsHowLongDoublesHoldAMotion) {
  Simulation simulation = run_of("rr", {"0", "0"}, 60);
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, frames_until(60));
  EXPECT_TRUE(choice.is_met);
  ASSERT_TRUE(choice.holds_until);
  EXPECT_GT(*choice.holds_until, 26.45);
  EXPECT_LT(*choice.holds_until, 40);
  EXPECT_THAT(choice.why_until, HasSubstr("twice the digits of doubles"));
  // To the extrapolation's word for it.
  const std::vector<double> end{26.45};
  const auto quads = quad_reference(simulation, end);
  ASSERT_TRUE(quads);
  simulation.duration = 60;
  const Trajectory run = simulate(simulation, end);
  Trajectory exact = run;
  exact.q = quads->q;
  Deviation deviation(simulation, {0.1, AccuracyUnit::px}, motion_size(simulation, simulate(simulation, frames_until(25))));
  EXPECT_LE(deviation.at(run, exact, 0), 0.1);
}

// Torques that are constant between instants: runs of rk4 at 0.1 ms from one to the next, whose own error on these is
// below 1e-8 m.
double error_of_pieces(Simulation& simulation, const std::vector<double>& tau1, const std::vector<double>& from,
                       const std::vector<double>& times) {
  const Accuracy accuracy{1, AccuracyUnit::px};
  Trajectory exact;
  exact.nq = simulation.chain.nq;
  exact.nv = simulation.chain.nv;
  std::vector<double> q = simulation.q0, qd = simulation.qd0;
  for (std::size_t piece = 0; piece < from.size(); ++piece) {
    const double begin = from[piece], end = piece + 1 < from.size() ? from[piece + 1] : simulation.duration;
    Simulation one = run_of("rr", {std::to_string(tau1[piece]), "0"}, end - begin, "rk4", 1e-4);
    one.q0 = q, one.qd0 = qd;
    std::vector<double> local;
    for (const double t : times)
      if (t >= begin && t < end) local.push_back(t - begin);
    local.push_back(end - begin);
    const Trajectory run = simulate(one, local);
    const int last = run.size() - 1;
    exact.q.insert(exact.q.end(), run.q.begin(), run.q.begin() + std::ptrdiff_t(2 * last));
    exact.t.insert(exact.t.end(), std::size_t(last), 0);
    q.assign(run.q_at(last).begin(), run.q_at(last).end());
    qd.assign(run.qd_at(last).begin(), run.qd_at(last).end());
  }
  const Trajectory run = simulate(simulation, times);
  if (run.size() < int(times.size())) return std::numeric_limits<double>::infinity();
  Deviation deviation(simulation, accuracy, motion_size(simulation, exact));
  return deviation.largest(run, exact, int(times.size()));
}

struct Push {
  std::string torque;
  std::vector<double> q0, tau, from;
};

// Pushes that runs stepped over, or died at, while their references did so as well.
TEST(ChooseMethod, KeepsItsPromiseWithPushesThatBeginAndEndAtOnce) {
  const double down = -std::acos(0);
  const std::vector<double> times = frames_until(4);
  for (const Push& push : {Push{"60*(t>1.507)*(t<1.557)", {-1, 0.5}, {0, 60, 0}, {0, 1.507, 1.557}},
                           Push{"60*(t>1.507)", {-1, 0.5}, {0, 60}, {0, 1.507}},
                           Push{"100*(t>1.507)", {-1, 0.5}, {0, 100}, {0, 1.507}},
                           Push{"60*(t>1)*(t<1.05)", {down, 0}, {0, 60, 0}, {0, 1, 1.05}},
                           Push{"60*(t>1)*(t<1.25)", {down, 0}, {0, 60, 0}, {0, 1, 1.25}},
                           Push{"600*(t>1)*(t<1.002)", {down, 0}, {0, 600, 0}, {0, 1, 1.002}},
                           Push{"60*(t>1)*(t<1.02)", {down, 0}, {0, 60, 0}, {0, 1, 1.02}}}) {
    Simulation simulation = run_of("rr", {push.torque, "0"}, 4);
    simulation.q0 = push.q0;
    const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, times);
    std::vector<double> judged;
    for (const double t : times)
      if (!choice.holds_until || t <= *choice.holds_until) judged.push_back(t);
    const double error = error_of_pieces(simulation, push.tau, push.from, judged);
    // The judge's own error comes on top.
    EXPECT_LE(error, choice.best.error * 1.001 + 1e-4) << push.torque << " " << choice.why_until;
    EXPECT_TRUE(choice.is_met) << push.torque;
  }
}

// Pulses that come and go between two frames, behind which a crude method is where it should be: what tables and events ask for lies
// between. Oracle: constant accelerations by hand.
TEST(ChooseMethod, JudgesWhatComesAndGoesBetweenFrames) {
  Simulation simulation = run_of("p", {"200*(t>0.31)*(t<0.32)-200*(t>0.32)*(t<0.33)"}, 1);
  simulation.chain.gravity.setZero();
  simulation.q0 = {0.2};
  std::vector<double> frames;
  for (int k = 0; k < 10; ++k) frames.push_back(k / 10.0);
  const Choice choice = choose_method(simulation, {1e-8, AccuracyUnit::relative}, frames);
  EXPECT_TRUE(choice.is_met);
  const std::vector<double> times{0, 0.31, 0.315, 0.32, 0.33, 1};
  const Trajectory run = run_with(simulation, choice.best.setting, times);
  const double a = 200 / simulation.chain.bodies[1].inertia.mass, end = 0.2 + a * 1e-4;
  const std::vector<double> exact{0.2, 0.2, 0.2 + 0.5 * a * 25e-6, 0.2 + 0.5 * a * 1e-4, end, end};
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(run.q_at(int(k))[0], exact[k], 1e-8 * (end - 0.2)) << times[k];
}

// Nothing exact enough is found within a small budget: the best so far is taken, and that is said.
TEST(ChooseMethod, EndsWithTheBestSoFarWhereItsBudgetEnds) {
  for (const char* torque : {"0", "-1e12*q1"}) {
    Simulation simulation = run_of("rr", {torque, "0"}, 20);
    const Choice choice = choose_method(simulation, {1e-4, AccuracyUnit::px}, frames_until(20), {}, 5e5);
    EXPECT_TRUE(choice.out_of_budget || choice.holds_until) << torque;
    EXPECT_TRUE(choice.best.setting.method) << torque;
    EXPECT_LT(choice.spent, 1.5 * choice.budget) << torque;
    EXPECT_EQ(simulation.most_evaluations, 0);
    EXPECT_EQ(simulation.longest_step, 0);
  }
}

TEST(ChooseMethod, ChoosesTheSameAgain) {
  std::string before;
  for (int k = 0; k < 2; ++k) {
    Simulation simulation = run_of("rr", {"5*sin(3*t)", "0"}, 2);
    const Choice choice = choose_method(simulation, {0.01, AccuracyUnit::px}, frames_until(2));
    const std::string now = to_string(choice.best.setting) + " " + std::to_string(choice.spent);
    EXPECT_TRUE(k == 0 || now == before) << now << " " << before;
    before = now;
  }
}

TEST(ChooseMethod, TellsWhatItDoesAndStopsWhenAsked) {
  Simulation simulation = run_of("rr", {"0", "0"}, 60);
  int asked = 0;
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, frames_until(60), [&](const ChoiceProgress& now) {
    EXPECT_FALSE(now.doing.empty());
    return ++asked == 5;
  });
  EXPECT_LT(choice.spent, 0.1 * choice.budget);
}

// References die of the spring at once, and what is cheapest until there is very dear behind.
TEST(ChooseMethod, PricesTheWholeRunWhereAPartDecides) {
  Simulation simulation = run_of("rr", {"-1e9*(q1-1)", "-1e5*qd2+5*sin(100*t)"}, 30);
  const std::vector<double> times = frames_until(30);
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, times, {}, 4e8);
  EXPECT_TRUE(choice.is_met);
  ASSERT_TRUE(choice.holds_until);
  EXPECT_LT(*choice.holds_until, 1);
  EXPECT_FALSE(choice.counted_until);
  EXPECT_LT(choice.best.cost, 4e8);
  simulation.most_evaluations = 2 * choice.best.evaluations;
  EXPECT_EQ(simulate(simulation, times).evaluations, choice.best.evaluations);
}

// A finite-time end: the torque grows without bounds, no run comes further, and nothing is said of what is behind.
TEST(ChooseMethod, SaysWhereNoReferenceGoesFurther) {
  Simulation simulation = run_of("rr", {"1/(1.0001-t)^2", "0"}, 3);
  const Choice choice = choose_method(simulation, {0.1, AccuracyUnit::px}, frames_until(3), {}, 2e8);
  ASSERT_TRUE(choice.holds_until);
  EXPECT_LE(*choice.holds_until, 1.0001);
  EXPECT_FALSE(choice.why_until.empty());
}

// Where the motion itself fails, as all references do, nothing is promised of what would follow.
TEST(ChooseMethod, SaysUntilWhenAMotionThatFailsHolds) {
  Simulation bouncing = run_of("pp", {"-5*((q1>0)-(q1<0)) - ((qd1>0)-(qd1<0))", "0"}, 10);
  bouncing.q0[0] = 0.3;
  Choice choice = choose_method(bouncing, {0.1, AccuracyUnit::px}, frames_until(10));
  ASSERT_TRUE(choice.holds_until);
  EXPECT_LT(*choice.holds_until, 5);
  EXPECT_THAT(choice.why_until, AllOf(HasSubstr("the motion itself ends"), HasSubstr("to and fro")));
  Simulation infinite = run_of("rr", {"log(abs(t-1))*10", "0"}, 3);
  choice = choose_method(infinite, {0.1, AccuracyUnit::px}, frames_until(3));
  ASSERT_TRUE(choice.holds_until);
  EXPECT_LE(*choice.holds_until, 1);
}

// Negative control: what no method can reach is not said to be met.
TEST(ChooseMethod, AdmitsWhereNothingIsExactEnough) {
  Simulation simulation = run_of("rr", {"0", "0"}, 12);
  const Choice choice = choose_method(simulation, {3e-15, AccuracyUnit::relative}, frames_until(12));
  EXPECT_TRUE(!choice.is_met || choice.holds_until);
  EXPECT_EQ(choice.holds_until.has_value(), !choice.why_until.empty());
}

TEST(Accuracy, ReadsWhatItWritesAndRefusesTheRest) {
  for (const char* text : {"0.1 px", "0.001 m", "0.01 rad"}) EXPECT_EQ(to_string(parse_accuracy(text)), text);
  EXPECT_EQ(parse_accuracy("1e-6").unit, AccuracyUnit::relative);
  for (const char* text : {"", "px", "0 px", "-1 m", "1 mm", "1e-6 relative and more", "nan px",
                           "1e-13 px", "1e-16", "1e-16 rad"})
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

// Evaluations under constraints and what follows each step have their price in the choice.
// A torque costs what it takes: of a method that asks for it four times a step the price of an evaluation grows by the law's own.
TEST(CostTable, CountsTorques) {
  const auto price = [](const std::string& torque) {
    Simulation simulation = run_of("rr", {torque, "0"}, 1);
    const ChoiceWatch watch;
    const CountedRuns runs(simulation, 1e9, watch);
    return runs.price_of_evaluation({&find_method("rk4"), {}, 1e-3});
  };
  EXPECT_GT(price("5*sin(2*t)"), price("5") + 50) << "ns";
  EXPECT_GT(price("5*sin(2*t)*exp(-t)*abs(q1)"), price("5*sin(2*t)") + 50);
  EXPECT_GT(price("-3*x_G"), price("-3*q1") + 100) << "where the tip is has to be worked out";
}

TEST(CostTable, CountsConstraints) {
  Simulation free = run_of("rrr", {"0", "0", "0"}, 1);
  Simulation tied = run_of("rrr", {"0", "0", "0"}, 1), softly = run_of("rrr", {"0", "0", "0"}, 1);
  tied.q0 = softly.q0 = {1.5, -1.5, -0.5};
  tied.constraints.list = softly.constraints.list = {LineConstraint{"gripper", {0, 0.5, 0}, {1, 0, 0}}};
  softly.constraints.stabilize = Stabilization::baumgarte;
  const MethodSetting setting{&find_method("rk4"), {}, 0.01};
  const auto cost = [&](Simulation& simulation, double steps, double evaluations) {
    return CountedRuns(simulation, 1e9, {}).cost_of(setting, steps, evaluations);
  };
  EXPECT_EQ(cost(free, 10, 40), run_cost(free.chain, *setting.method, {}, 10, 40));
  const ConstraintCost price = constraint_cost(tied.chain, tied.constraints);
  // What an evaluation costs stands in the place of the free chain's.
  EXPECT_DOUBLE_EQ(cost(tied, 0, 1) - cost(free, 0, 1), price.evaluation - forward_dynamics_cost(free.chain));
  EXPECT_GT(cost(tied, 0, 1), cost(free, 0, 1));
  EXPECT_DOUBLE_EQ(cost(tied, 1, 0) - cost(free, 1, 0), price.projection);
  EXPECT_GT(cost(tied, 1, 0), 5 * cost(free, 1, 0));
  EXPECT_EQ(cost(softly, 1, 0), cost(free, 1, 0)) << "nothing is projected";
  EXPECT_GT(cost(softly, 0, 1), cost(tied, 0, 1)) << "without the kernel";
  // And these are what is told of a choice.
  const Choice choice = choose_method(tied, parse_accuracy("1e-4 m"), frames_until(1));
  const Choice::Candidate& best = choice.best;
  EXPECT_DOUBLE_EQ(best.cost, CountedRuns(tied, 1e9, {}).cost_of(best.setting, double(best.steps), double(best.evaluations)));
}

TEST(Deviation, MeasuresPlacesInMetresAndPixelsAndAnglesInRadians) {
  Simulation simulation = run_of("rr", {"0", "0"}, 1);
  const Trajectory a = simulate(simulation, frames_until(1));
  Trajectory b = a;
  const int k = 10;
  b.q[2 * k + 1] += 0.01;  // the elbow: the tip moves 1 m away from it
  const MotionSize size = motion_size(simulation, a);
  const auto apart = [&](const char* unit) {
    return Deviation(simulation, {1, *value_named<AccuracyUnit>(unit)}, size).at(a, b, k);
  };
  EXPECT_NEAR(apart("rad"), 0.01, 1e-15);
  // The chord of the angle over an arm of 1 m, with the rounding of some sines.
  EXPECT_NEAR(apart("m"), 2 * std::sin(0.005), 1e-14);
  EXPECT_NEAR(apart("px"), apart("m") / size.bars.metres_per_px, 1e-10);
  EXPECT_NEAR(apart("relative"), apart("m") / size.bars.diagonal, 1e-14);
  EXPECT_EQ(Deviation(simulation, {1, AccuracyUnit::m}, size).at(a, b, k + 1), 0);
  b.q[2 * k] = std::nan("");
  EXPECT_TRUE(std::isinf(apart("px")));
}

}  // namespace
}  // namespace chainreel
