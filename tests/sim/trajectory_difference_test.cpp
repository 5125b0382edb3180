// Where two runs part, in words.
#include "sim/trajectory_difference.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/read_chain.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// Two angles, 0 to 10 s by hundredths: a sine of 1 rad and one of 2 rad.
SampledTrajectory swing() {
  SampledTrajectory run;
  run.q_numbers = {{"q1 (shoulder)", "rad"}, {"q2 (elbow)", "rad"}};
  run.qd_numbers = {{"qd1 (shoulder)", "rad/s"}, {"qd2 (elbow)", "rad/s"}};
  for (int k = 0; k <= 1000; ++k) {
    const double t = k * 0.01;
    run.t.push_back(t);
    run.q.insert(run.q.end(), {std::sin(t), 2 * std::sin(2 * t)});
    run.qd.insert(run.qd.end(), {std::cos(t), 4 * std::cos(2 * t)});
  }
  run.end_time = 10;
  return run;
}

// q2 is off by `rate` times what passed of the time since `from`.
SampledTrajectory strayed(double rate, double from) {
  SampledTrajectory run = swing();
  for (std::size_t k = 0; k < run.size(); ++k) run.q[2 * k + 1] += rate * std::max(0.0, run.t[k] - from);
  return run;
}

std::vector<std::string> words_of(const SampledTrajectory& before, const SampledTrajectory& after) {
  const TrajectoryDifference difference = difference_of(before, after);
  std::vector<std::string> words = difference.others;
  if (const std::string freedom = freedom_words(difference); !freedom.empty())
    words.insert(words.begin(), freedom);
  EXPECT_EQ(words.empty(), difference.empty());
  return words;
}

TEST(TrajectoryDifference, SaysWhichFreedomPartsWhenAndHowFar) {
  EXPECT_THAT(
      words_of(swing(), strayed(0.02, 0.8)),
      ElementsAre("q2 (elbow) differs by 0.0002 rad from t = 0.81 s on (largest 0.18 rad at t = 10 s)"));
  EXPECT_THAT(words_of(swing(), swing()), IsEmpty());
}

TEST(TrajectoryDifference, TakesRoundOffForNone) {
  EXPECT_THAT(words_of(swing(), strayed(3e-10, 0)), IsEmpty());  // 3e-9 rad at last, of a range of 4 rad
  EXPECT_THAT(words_of(swing(), strayed(3e-9, 0)), ElementsAre(HasSubstr("q2 (elbow) differs by")));
}

TEST(TrajectoryDifference, NamesTheFirstOfSeveral) {
  SampledTrajectory run = strayed(0.02, 2);
  for (std::size_t k = 300; k < run.size(); ++k) run.q[2 * k] += 1;
  EXPECT_THAT(words_of(swing(), run),
              ElementsAre(AllOf(StartsWith("q2 (elbow) differs by 0.0002 rad from t = 2.01 s on"),
                                HasSubstr(", most of all q1 (shoulder), by 1 rad at t = 3.01 s"))));
}

TEST(TrajectoryDifference, LooksAtRatesWherePositionsAgree) {
  SampledTrajectory run = swing();
  run.qd[2 * 500] += 0.5;
  EXPECT_THAT(words_of(swing(), run), ElementsAre("qd1 (shoulder) differs by 0.5 rad/s from t = 5 s on"));
}

TEST(TrajectoryDifference, ComparesRunsOfOtherLengthsAndRatesOverSharedInstants) {
  SampledTrajectory short_run = strayed(0.02, 0.8), rare = swing();
  short_run.t.resize(501), short_run.q.resize(1002), short_run.qd.resize(1002);
  short_run.status = "stopped", short_run.end_time = 5;
  EXPECT_THAT(words_of(swing(), short_run),
              ElementsAre(HasSubstr("from t = 0.81 s on (largest 0.084 rad at t = 5 s)"),
                          "the run: finished at t = 10 s -> stopped at t = 5 s"));
  for (std::size_t k = 0; k < rare.size(); ++k) rare.t[k] += 0.005;
  EXPECT_THAT(words_of(swing(), rare), ElementsAre("the runs are sampled at other instants and share 0"));
  EXPECT_EQ(difference_of(swing(), short_run).instants, 501);
}

TEST(TrajectoryDifference, TakesWhatIsNoNumberForFarAway) {
  SampledTrajectory run = swing();
  run.q[2 * 700] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(words_of(swing(), run), ElementsAre("q1 (shoulder) differs by inf rad from t = 7 s on"));
  EXPECT_THAT(words_of(run, run), IsEmpty());
}

// The difference of two numbers may be larger than any number, and so may be a range.
TEST(TrajectoryDifference, TellsTheLargestNumbersOfEitherSignApart) {
  SampledTrajectory high = swing(), low = swing();
  high.q[2 * 20] = 1e308, low.q[2 * 20] = -1e308;
  EXPECT_THAT(words_of(high, low), ElementsAre(StartsWith("q1 (shoulder) differs by inf")));
  EXPECT_THAT(words_of(high, high), IsEmpty());
}

TEST(TrajectoryDifference, TellsEventsAndFreedoms) {
  SampledTrajectory before = swing(), after = swing();
  before.events = {{"touch", 1.2}, {"low", 2}, {"low", 3}, {"gone", 4}};
  after.events = {{"touch", 1.25}, {"low", 2}, {"new", 6}};
  EXPECT_THAT(
      words_of(before, after),
      ElementsAre("event gone: does not happen any more (was at t = 4 s)", "event low: happens 2 -> 1 times",
                  "event new: happens now, at t = 6 s", "event touch: at t = 1.2 -> 1.25 s"));
  SampledTrajectory one = swing();
  one.q_numbers.pop_back(), one.qd_numbers.pop_back();
  one.q.resize(one.size()), one.qd.resize(one.size());
  EXPECT_THAT(words_of(swing(), one), ElementsAre("freedoms q1 (shoulder), q2 (elbow) -> q1 (shoulder)"));
}

TEST(TrajectoryDifference, ComparesRotationsByTheirAngle) {
  SampledTrajectory before;
  for (int i = 0; i < 4; ++i) before.q_numbers.push_back({"rotation of base", "quaternion"});
  before.t = {0, 1};
  before.q = {0, 0, 0, 1, 0, 0, std::sin(0.4), std::cos(0.4)};
  before.end_time = 1;
  SampledTrajectory after = before;
  for (double& x : after.q) x = -x;  // means the same
  EXPECT_THAT(words_of(before, after), IsEmpty());
  after.q[6] = std::sin(0.405), after.q[7] = std::cos(0.405);
  EXPECT_THAT(words_of(before, after), ElementsAre("rotation of base differs by 0.01 rad from t = 1 s on"));
}

TEST(TrajectoryDifference, FindsRotationsByTheirNames) {
  std::vector<SampledNumber> numbers;
  for (const char* name :
       {"q.base.x", "q.base.qx", "q.base.qy", "q.base.qz", "q.base.qw", "q.a.qx", "q.b.qy", "q.b.qz"})
    numbers.push_back({name, ""});
  join_rotations(numbers);
  std::vector<std::string> labels;
  for (const SampledNumber& number : numbers) labels.push_back(number.label);
  const std::string turn = "rotation of q.base";
  EXPECT_THAT(labels, ElementsAre("q.base.x", turn, turn, turn, turn, "q.a.qx", "q.b.qy", "q.b.qz"));
}

TEST(TrajectoryDifference, KeepsEverySomeSamplesAndTheLast) {
  const Chain chain = read_chain(CHAINREEL_SOURCE_FOLDER "/models/rr.urdf");
  for (const int count : {1, 2, 199, 200, 201, 601, 5000}) {
    SCOPED_TRACE(count);
    Trajectory run;
    run.nq = run.nv = 2;
    for (int k = 0; k < count; ++k) {
      run.t.push_back(k);
      run.q.insert(run.q.end(), {0.0 + k, 1.0});
      run.qd.insert(run.qd.end(), {2.0, 3.0});
    }
    const SampledTrajectory kept = sampled(chain, run);
    EXPECT_LE(kept.size(), 200U);
    EXPECT_GE(kept.size(), std::size_t(std::min(count, 100)));
    EXPECT_EQ(kept.t.back(), count - 1);
    EXPECT_EQ(kept.q.size(), 2 * kept.size());
    EXPECT_EQ(kept.q_numbers[1].label, "q2 (joint2)");
    EXPECT_EQ(kept.q_numbers[1].unit, "rad");
    EXPECT_THAT(words_of(kept, sampled(chain, run, 50)), IsEmpty());  // other strides share instants
  }
  EXPECT_EQ(sampled(chain, Trajectory{}).size(), 0U);
}

}  // namespace
}  // namespace chainreel
