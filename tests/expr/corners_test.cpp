// Corners of expressions: that they are found, shared, held on a side, and that those of t alone have their
// instants, all of them.
#include "expr/corners.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "expr/instants.hpp"
#include "expr/pulses.hpp"

namespace chainreel {
namespace {

constexpr double pi = std::numbers::pi;

const std::vector<std::string> kCornersNames{"t", "q1", "qd1", "k"};

struct Cornered {
  Corners corners{{{VariableRole::time, 0},
                   {VariableRole::linear, 0},
                   {VariableRole::linear, 0},
                   {VariableRole::constant, 3}}};
  CorneredProgram program;

  explicit Cornered(const std::string& text) { add(text); }
  void add(const std::string& text) { program = corners.add(Expression::parse(text, kCornersNames, {})); }
  double at(double t, double q, double qd, std::vector<double> sides) const {
    const std::vector<double> values{t, q, qd, 3};
    return evaluate<double>(program, values, sides);
  }
};

std::vector<double> instants(const std::string& text, double end = 10) {
  return instants_of(Cornered(text).corners, end);
}

void expect_instants(const std::string& text, const std::vector<double>& wanted, double tolerance,
                     double end = 10) {
  const std::vector<double> found = instants(text, end);

  ASSERT_EQ(found.size(), wanted.size()) << text;
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(found[i], wanted[i], tolerance) << text;
}

TEST(Instants, OfComparisonsOfTimeAreTheWrittenOnesToTheLastBit) {
  EXPECT_EQ(instants("60*(t>1.507)*(t<1.557)"), (std::vector<double>{1.507, 1.557}));
  EXPECT_EQ(instants("(t>=1)*(1.002>t)", 1e6), (std::vector<double>{1, 1.002})) << "2 ms of 11 days";
  EXPECT_EQ(instants("abs(t-1) + max(2-t, 0)"), (std::vector<double>{1, 2}));
  EXPECT_EQ(instants("(2*t > k)"), std::vector<double>{1.5}) << "a parameter has its value";
  EXPECT_TRUE(instants("(t > 11) + (t > 0) + (k > 2) + (q1 > t)").empty());
}

TEST(Instants, OfWavesAreAllFound) {
  std::vector<double> wanted;
  for (int k = 1; k * pi / 20 < 10; ++k) wanted.push_back(k * pi / 20);
  expect_instants("max(0, sin(20*t))", wanted, 4e-15);
  EXPECT_EQ(instants("(sin(500*t) > 0.999)", 10).size(), 1592u) << "796 crests, each of 0.18 ms";
}

TEST(Instants, OfPowersQuotientsAndNestedCornersAreFound) {
  expect_instants("(t^3 - 6*t^2 + 11*t > 6)", {1, 2, 3}, 1e-14);
  expect_instants("(exp(-t) < 0.5) + (log(t + 1) > 1)", {std::log(2), std::exp(1) - 1}, 1e-15);
  expect_instants("(1/(1 + t^2) < 0.1)", {3}, 1e-14);
  expect_instants("max(0, min(1, abs(t - 3) - 1))", {1, 2, 3, 4, 5}, 1e-15);
  expect_instants("abs((t > 1)*(t - 2) - 0.5)", {1, 2.5}, 1e-15);
  expect_instants("(sqrt(t) > 1.5) + (tan(t/10) > 0.5)", {2.25, 10 * std::atan(0.5)}, 1e-14);
  expect_instants("(2^t > 5)", {std::log2(5)}, 1e-14);
}

TEST(Instants, OfRootsThatOnlyTouchZeroAreFoundWithinRounding) {
  expect_instants("sqrt((t - 1)^2)", {1}, 2e-12);
  expect_instants("abs(sin(t)^2)", {pi, 2 * pi, 3 * pi}, 2e-11);
  expect_instants("atan2(sin(t), cos(t))", {pi, 2 * pi, 3 * pi}, 4e-15);
}

TEST(Instants, ThatAreTooManyAreRefusedWithTheExpression) {
  try {
    instants("max(0, sin(1e6*t))", 10);
    FAIL() << "three million instants";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::limit);
    EXPECT_NE(std::string(error.what()).find("sin(1e6*t)"), std::string::npos);
  }
  EXPECT_TRUE(instants("(0*t > 0) + (t - t > 0)").empty()) << "constants have none";
}

TEST(Corners, AreOneWhereTheirFunctionsDifferByAFactor) {
  Cornered sign("(qd1>0) - (qd1<0) + abs(-2*qd1) + max(qd1, 0) + (0 < 3*qd1)");
  EXPECT_EQ(sign.corners.count(), 1);
  sign.add("min(q1, k) - (q1 > k)");
  EXPECT_EQ(sign.corners.count(), 2);
  sign.add("(q1*qd1 > 1) + (q1*qd1 > 1)");
  EXPECT_EQ(sign.corners.count(), 3);
  EXPECT_FALSE(sign.corners[0].time_alone);
}

TEST(Corners, HeldOnASideMakeOneSmoothFunction) {
  const Cornered sign("(qd1>0) - (qd1<0)");
  EXPECT_EQ(sign.at(0, 0, -1e-3, {1}), 1) << "beyond the corner";
  EXPECT_EQ(sign.at(0, 0, 1e-3, {-1}), -1);
  EXPECT_EQ(sign.at(0, 0, 0, {0.25}), 0.25) << "between the branches";
  EXPECT_EQ(sign.at(0, 0, -2, {kAsWritten}), -1);
  EXPECT_EQ(Cornered("abs(q1)").at(0, -2, 0, {1}), -2);
  EXPECT_EQ(Cornered("min(q1, 1)").at(0, 5, 0, {-1}), 5);
  EXPECT_EQ(Cornered("max(q1, 1)").at(0, 5, 0, {-1}), 1);
  EXPECT_NEAR(Cornered("atan2(q1, qd1)").at(0, -0.01, -1, {1}), pi + 0.01, 1e-6) << "no jump at pi";
  EXPECT_EQ(Cornered("5*(q1 == 0)").at(0, 0, 0, {1}), 0) << "an instant pushes nothing";
}

TEST(Corners, GiveTheTextsValueWhereTheBranchBeyondThemHasNone) {
  EXPECT_EQ(Cornered("7*max(0, -q1)^1.5").at(0, 0.1, 0, {-1}), 0) << "(-0.1)^1.5 is none";
  EXPECT_EQ(Cornered("2*sqrt(abs(q1)) + 1").at(0, -4, 0, {1}), 5);
  EXPECT_EQ(Cornered("log(max(q1, 1))").at(0, -3, 0, {1}), 0);
  EXPECT_EQ(Cornered("abs(qd1)^0.5*((qd1>0)-(qd1<0))").at(0, 0, -4, {1}), 2) << "the sign beside it is kept";
  EXPECT_EQ(Cornered("min(30, 1/abs(q1))").at(0, 0, 0, {1, -1}), 30) << "at the pole";
  EXPECT_EQ(Cornered("min(30, 1/abs(q1))").at(0, 0, 0, {1, 0}), 30);
  EXPECT_EQ(Cornered("(q1<0)/abs(q1)").at(0, -0.5, 0, {kJumpsAlone}), 0)
      << "the jump's side and the text's bend";
  EXPECT_EQ(Cornered("(q1<0)/abs(q1)").at(0, 0.5, 0, {-kJumpsAlone}), 2);
  EXPECT_TRUE(std::isnan(Cornered("sqrt(q1)*(q1>-2)").at(0, -1, 0, {1}))) << "the text has none either";
}

TEST(Corners, KnowWhereMeansOfSidesAreNoMeansOfValues) {
  const auto curved = [](const std::string& text) { return Cornered(text).corners[0].is_curved; };
  EXPECT_FALSE(curved("-2*((qd1>0)-(qd1<0)) + q1*(qd1>0)/3"));
  EXPECT_FALSE(curved("(qd1>0)*(q1>0)"));
  EXPECT_TRUE(curved("max(-6, -30*(qd1>0))"));
  EXPECT_TRUE(curved("exp(-(qd1>0))"));
  EXPECT_TRUE(curved("1/(1+(qd1>0))"));
  EXPECT_TRUE(curved("((qd1>0)-(qd1<0))*((qd1>0)-(qd1<0))"));
}

TEST(Instants, OfRootsOfWhatIsCutOffAreFound) {
  expect_instants("abs(max(0, sin(5*t))^0.5)", {pi / 5, 2 * pi / 5, 3 * pi / 5}, 1e-14, 2);
  expect_instants("max(max(0, 0.48)^0.5, t)", {std::sqrt(0.48)}, 1e-14);
}

TEST(Instants, BeforeAPoleOfATangentAreNotHiddenByIt) {
  // The cosine is rounded where the tangent has its pole.
  for (const char* text : {"min(50, max(-50, tan(3*t)))", "max(-50, min(50, tan(3*t)))"})
    expect_instants(text, {std::atan(50) / 3, pi / 6, (pi - std::atan(50)) / 3}, 1e-14, 1);
}

std::vector<double> pulses(const std::string& text, double end) {
  const Cornered cornered(text);
  return pulses_of({cornered.program}, cornered.corners, instants_of(cornered.corners, end), end);
}

TEST(Pulses, ThatAreNarrowAreDividedIntoParts) {
  for (const char* text :
       {"1e5*exp(-((t-1.2345)/1e-5)^2)", "2/(1+((t-1.2345)/2e-6)^2)^4*qd1 - q1",
        "(t>1)*exp(-1e10*(t-1.2345)^2) + k", "-3*sin(t)^0*exp(-((t-1.2345)/1e-5)^2)*(t<2)"}) {
    const std::vector<double> found = pulses(text, 3);
    ASSERT_GE(found.size(), 34u) << text;
    EXPECT_NEAR(found.front(), 1.2345, 1e-4) << text;
    EXPECT_NEAR(found.back(), 1.2345, 1e-4) << text;
    EXPECT_LT(found.front(), 1.2345 - 5e-6) << text;
    EXPECT_GT(found.back(), 1.2345 + 5e-6) << text;
  }
  EXPECT_EQ(pulses("exp(-1e10*(t-1.2345)^2) + exp(-1e10*(t-1.2348)^2)", 3).size(), 68u) << "close together";
}

TEST(Pulses, AreNotSeenInSlowFunctionsNorInFastWaves) {
  for (const char* text :
       {"sin(20*t)", "t^2*exp(-t)", "sin(1e5*t)", "max(0, sin(20*t))", "60*(t>1)*(t<1.001)",
        "exp(-((t-1)/0.1)^2)", "tan(t)", "1/(t-1)", "qd1*t", "log(t)", "sqrt(t)*q1"})
    EXPECT_TRUE(pulses(text, 3).empty()) << text;
}

// Waves that no double resolves: a value of its own at each instant. What matters is that it ends.
TEST(Pulses, OfNoiseAreSoughtInBoundedTime) {
  for (const char* text : {"3*sin(18446744073709551616*t)", "sin(1e18*t)", "sin(1e300*t)", "cos(1e22*t)*exp(-t)"})
    for (const double end : {0.05, 3.0, 1e6}) EXPECT_LT(pulses(text, end).size(), 100u * 34) << text;
}

}  // namespace
}  // namespace chainreel
