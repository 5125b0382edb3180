#include "scene/run/sweep.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "core/error.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const std::string& text) {
  try {
    parse_sweep(text, "--x");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "accepted";
}

TEST(Sweep, TakesListsOfWordsAndNumbers) {
  const Sweep words = parse_sweep("method=rk4,verlet", "--vary");
  EXPECT_EQ(words.key, "method");
  EXPECT_THAT(words.values, ElementsAre("rk4", "verlet"));
  EXPECT_TRUE(words.numbers.empty());
  EXPECT_EQ(words.setting(1), "method=verlet");
  EXPECT_THAT(parse_sweep("torque.1=1,-2.5", "--x").numbers, ElementsAre(1, -2.5));
}

TEST(Sweep, CommasAndColonsWithinBracketsAndQuotesBelongToAValue) {
  EXPECT_THAT(parse_sweep("start.q=[0, 1],[2,3]", "--x").values, ElementsAre("[0, 1]", "[2,3]"));
  EXPECT_THAT(parse_sweep("torque={csv: a.csv},[\"max(t, 1)\", 0],0", "--x").values,
              ElementsAre("{csv: a.csv}", "[\"max(t, 1)\", 0]", "0"));
  EXPECT_THAT(parse_sweep("title='a, b: c',d", "--x").values, ElementsAre("'a, b: c'", "d"));
  EXPECT_EQ(parse_sweep("step=max(1, 2):3:2", "--x").numbers.size(), 2u);
  // What does not close is words.
  EXPECT_THAT(parse_sweep("title=don't,f(x,]", "--x").values, ElementsAre("don't", "f(x", "]"));
}

TEST(Sweep, RangesHoldBothEndsAndEqualDistances) {
  const Sweep range = parse_sweep("parameters.k=0:90deg:4", "--x");
  ASSERT_EQ(range.numbers.size(), 4u);
  EXPECT_EQ(range.numbers.front(), 0);
  EXPECT_EQ(range.numbers.back(), std::acos(0.0));
  // A rounding of each of two products.
  EXPECT_NEAR(range.numbers[1], range.numbers[3] / 3, 1e-15);
}

TEST(Sweep, LogarithmicRangesHaveEqualFactors) {
  const Sweep range = parse_sweep("step=1e-4:1e-1:4:log", "--x");
  EXPECT_TRUE(range.logarithmic);
  EXPECT_THAT(parse_sweep("torque.1=-100:-1:3:log", "--x").values, ElementsAre("-100", "-10", "-1"));
  for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(range.numbers[k] / range.numbers[k - 1], 10, 1e-13);
}

// No sums of rounding: 1 + 0.8 * -1 is 0.19999999999999996.
TEST(Sweep, RangesHoldTheDecimalsThatTheyMean) {
  EXPECT_THAT(parse_sweep("k=1:0:6", "--x").values, ElementsAre("1", "0.8", "0.6", "0.4", "0.2", "0"));
  EXPECT_THAT(parse_sweep("k=-0.3:0.3:7", "--x").values, ElementsAre("-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"));
  EXPECT_THAT(parse_sweep("k=1e-4:1e-1:4:log", "--x").values, ElementsAre("1e-04", "0.001", "0.01", "0.1"));
  EXPECT_THAT(parse_sweep("k=1e9:1000000001:3", "--x").values, ElementsAre("1e+09", "1000000000.5", "1000000001"));
  // What no short decimal is stays as it was computed.
  EXPECT_EQ(parse_sweep("k=0:1:4", "--x").numbers[1], 1.0 / 3);
  EXPECT_EQ(parse_sweep("k=0:90deg:4", "--x").numbers[2], 2.0 / 3 * std::acos(0.0));
}

TEST(Sweep, ValuesReadBackAsTheNumbers) {
  const Sweep range = parse_sweep("step=0.1:0.7:13", "--x");
  for (std::size_t k = 0; k < range.numbers.size(); ++k)
    EXPECT_EQ(std::stod(range.values[k]), range.numbers[k]);
}

TEST(Sweep, SaysWhatItTakesWhereAskedForAnythingElse) {
  EXPECT_THAT(refusal("step"), HasSubstr("names no key or no values"));
  EXPECT_THAT(refusal("=1,2"), HasSubstr("names no key"));
  EXPECT_THAT(refusal("step=1,,2"), HasSubstr("empty value"));
  EXPECT_THAT(refusal("step=0:1"), HasSubstr("is no range"));
  EXPECT_THAT(refusal("step=0:1:1"), HasSubstr("count between 2"));
  EXPECT_THAT(refusal("step=0:1:5:log"), HasSubstr("of one sign"));
  EXPECT_THAT(refusal("step=-1:1:5:log"), HasSubstr("of one sign"));
  EXPECT_THAT(refusal("step=a:1:5"), HasSubstr("'a', which is no number"));
}

}  // namespace
}  // namespace chainreel
