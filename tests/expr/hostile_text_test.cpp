// Texts made to break a parser end in an Error: no crash, no endless loop, no deep recursion.
#include <gtest/gtest.h>

#include <random>

#include "expr/expression.hpp"

namespace chainreel {
namespace {

const std::vector<std::string> kHostileTextNames = {"t", "q1", "q2"};

std::string problem_of(const std::string& text) {
  try {
    Expression::parse(text, kHostileTextNames, {"a.yaml", 1, 1});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

TEST(HostileTexts, NestingIsAllowedToTwoHundredLevels) {
  EXPECT_EQ(problem_of(repeated("(", 200) + "1" + repeated(")", 200)), "");
  EXPECT_EQ(problem_of(repeated("(", 201) + "1" + repeated(")", 201)),
            "a.yaml:1:202: nested deeper than 200 levels");
}

TEST(HostileTexts, EveryKindOfNestingIsLimited) {
  for (const char* piece : {"(", "-", "2^", "sin(", "max(1,", "1<(", "1+2*3^(", "+"})
    EXPECT_NE(problem_of(repeated(piece, 1000)).find("nested deeper than 200 levels"), std::string::npos)
        << piece;
}

// Each level leaves four values waiting: an argument, and the left sides of <, + and *.
TEST(HostileTexts, TheDeepestStackIsLargeEnough) {
  const std::string text = repeated("max(0,0<0+1*", 200) + "1" + repeated(")", 200);
  const Expression calls = Expression::parse(text, kHostileTextNames, {});
  EXPECT_EQ(calls.constant(), 1);
  const std::vector<Dual<double>> none;
  EXPECT_EQ(calls.evaluate(std::span<const Dual<double>>(none)), 1);
  const Expression powers =
      Expression::parse(repeated("0<0+1*1^(", 100) + "1" + repeated(")", 100), kHostileTextNames, {});
  EXPECT_EQ(powers.constant(), 1);
}

// Each acos is written with its argument three times.
TEST(HostileTexts, FunctionsThatAreWrittenAsOthersDoNotGrowWithoutBound) {
  EXPECT_EQ(problem_of(repeated("acos(", 8) + "t" + repeated(")", 8)), "");
  for (const char* piece : {"acos(", "asin(", "2^acos("})
    EXPECT_NE(problem_of(repeated(piece, 60) + "t" + repeated(")", 60)).find("the expression is too long"), std::string::npos) << piece;
  EXPECT_EQ(problem_of(repeated("0<0+1*max(0,", 150) + repeated("asin(", 8) + "t" + repeated(")", 158)), "");
}

TEST(HostileTexts, LongFlatExpressionsAreFine) {
  const Expression sum = Expression::parse("0" + repeated("+1", 4999), kHostileTextNames, {});
  EXPECT_EQ(sum.constant(), 4999);
}

TEST(HostileTexts, TextsAboveTenThousandCharactersAreRefused) {
  EXPECT_EQ(problem_of(std::string(10000, '1')),
            "a.yaml:1:1: '" + std::string(40, '1') + "..' is outside the range of numbers");
  EXPECT_EQ(problem_of(std::string(10001, '1')),
            "a.yaml:1:1: an expression may have 10000 characters, this one has 10001");
  for (const char* piece : {"(", "1+", "\xff", "a", " "})
    EXPECT_NE(problem_of(repeated(piece, 1 << 20)).find("an expression may have"), std::string::npos)
        << piece;
}

TEST(HostileTexts, ALongNameIsShortenedInTheMessage) {
  EXPECT_LT(problem_of(std::string(9999, 'a')).size(), 200u);
}

TEST(HostileTexts, RandomBytesEndInAnErrorOrAnExpression) {
  std::mt19937_64 random(51);
  const std::string alphabet = "0123456789.eE+-*/^()<>=!,tq12 sincoxamp";
  int good = 0;
  for (int i = 0; i < 50000; ++i) {
    std::string text(random() % 24, ' ');
    for (char& c : text) c = i % 2 == 0 ? char(random()) : alphabet[random() % alphabet.size()];
    const std::string problem = problem_of(text);
    if (problem.empty()) {
      ++good;
      const std::vector<double> values = {1, 2, 3};
      Expression::parse(text, kHostileTextNames, {}).evaluate(std::span<const double>(values));
    } else {
      ASSERT_TRUE(problem.starts_with("a.yaml:1:")) << problem;
    }
  }
  EXPECT_GT(good, 100) << "some of them must be expressions, or the alphabet is badly chosen";
}

// Good expressions with one character changed: nearer to what a person mistypes.
TEST(HostileTexts, OneWrongCharacterIsSurvived) {
  std::mt19937_64 random(52);
  const std::string good = "k*(1 - q1) + max(2.5e-1, sin(2*t)^2, q2) - (t < 3)*atan2(q1, -q2)/4";
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = good;
    text[random() % text.size()] = char(32 + random() % 95);
    refused += !problem_of(text).empty();
  }
  EXPECT_GT(refused, 10000);
}

}  // namespace
}  // namespace chainreel
