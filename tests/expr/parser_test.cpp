// What is wrong with a text, where, and what to do about it.
#include <gtest/gtest.h>

#include "expr/expression.hpp"

namespace chainreel {
namespace {

const std::vector<std::string> kParserNames = {"t", "q1", "q2", "qd1", "y_G", "stiffness"};

// What parsing ends in, "" if it succeeds; the text stands at line 7, column 100.
std::string problem_with(const std::string& text) {
  try {
    Expression::parse(text, kParserNames, {"a.yaml", 7, 100});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_EQ(error.problems().size(), 1u);
    return error.what();
  }
  return "";
}

struct Bad {
  const char* text;
  int offset;  // of the first character that is wrong
  const char* message;
};

constexpr const char* kComma =
    "a comma cannot stand here: decimals are written with a point (1.5), and a list entry that holds a comma "
    "must be "
    "quoted";
constexpr const char* kAssignment = "there is one value per expression and no assignment; == compares";

const Bad kBad[] = {
    {"", 0, "empty expression: a number or a formula is wanted"},
    {" \t ", 0, "empty expression: a number or a formula is wanted"},
    // names
    {"2*stifness", 2, "unknown name 'stifness': did you mean 'stiffness'?"},
    {"y_g", 0, "unknown name 'y_g': did you mean 'y_G'?"},
    {"torque", 0, "unknown name 'torque'; known here: t q1 q2 qd1 y_G stiffness pi"},
    {"1 + sine(t)", 4, "unknown function 'sine': did you mean 'sin'?"},
    {"erf(t)", 0, "unknown function 'erf'; known here: sin cos tan sqrt exp log abs asin acos atan atan2 tanh sign min max"},
    {"2*sin", 2, "'sin' is a function: write sin(..)"},
    {"q1(2)", 0, "an operator is missing between 'q1' and '('"},
    {"pi(2)", 0, "an operator is missing between 'pi' and '('"},
    // arguments
    {"t+sin()", 2, "sin takes 1 argument, not 0"},
    {"sin(1,5)", 0, "sin takes 1 argument, not 2 (decimals are written with a point: 1.5)"},
    {"2*atan2(t)", 2, "atan2 takes 2 arguments, not 1"},
    {"max(1)", 0, "max takes 2 or more arguments, not 1"},
    {"max(1,)", 6, "')' stands where a value is wanted"},
    // commas and assignments
    {"1,5", 1, kComma},
    {"2*(1,5)", 4, kComma},
    {"t, q1", 1, kComma},
    {"q1 = 3", 3, kAssignment},
    {"tau1=3", 4, kAssignment},
    {"q1 := 3", 3, kAssignment},
    {"=3", 0, "'=' stands where a value is wanted"},
    // numbers
    {"1.2.3", 0, "'1.2.3' is not a number"},
    {"t+.", 2, "'.' is not a number"},
    {".nan", 0, "'.nan' is not a number"},
    {"1e999", 0, "'1e999' is outside the range of numbers"},
    {"90degs", 2, "an operator is missing before 'degs'"},
    {"90 deg", 3, "an operator is missing before this value"},
    {"2m", 1, "numbers in expressions have no unit but deg or rad: they are in SI units and radians"},
    {"2*pideg", 2, "unknown name 'pideg'; known here: t q1 q2 qd1 y_G stiffness pi"},
    {"2q1", 1, "an operator is missing before 'q1'"},
    {"0x10", 1, "an operator is missing before 'x10'"},
    {"2 q1", 2, "an operator is missing before this value"},
    {"2(t)", 1, "an operator is missing before this value"},
    // operators
    {"1+", 2, "the expression ends where a value is wanted"},
    {"*2", 0, "'*' stands where a value is wanted"},
    {"2**3", 1, "a power is written with ^"},
    {"1<2<3", 3, "comparisons do not chain: write (a < b) * (b < c)"},
    {"t && q1", 2, "'&' has no meaning in an expression"},
    {"t ! q1", 2, "'!' has no meaning in an expression"},
    {"t\xc2\xb2", 1, "'\xc2\xb2' has no meaning in an expression"},
    {"t\x01", 1, "byte 1 has no meaning in an expression"},
    {"t\xff", 1, "byte 255 has no meaning in an expression"},
    // parentheses
    {"2*(1+t", 2, "this '(' is never closed"},
    {"sin(t", 3, "this '(' is never closed"},
    {"1+t)", 3, "this ')' closes nothing"},
    {"()", 1, "')' stands where a value is wanted"},
};

TEST(Problems, AreNamedAtTheirColumn) {
  for (const Bad& bad : kBad)
    EXPECT_EQ(problem_with(bad.text), "a.yaml:7:" + std::to_string(100 + bad.offset) + ": " + bad.message)
        << "for the text '" << bad.text << "'";
}

TEST(Problems, AreNotSeenInGoodExpressions) {
  for (const char* text :
       {"1.5", "max(1,5)", "q1 == 3", "2 * q1", "stiffness", "90 * pi / 180", "(1 < 2) < 3", "2^3"})
    EXPECT_EQ(problem_with(text), "") << text;
}

TEST(Problems, WithoutAKnownColumnNameTheLineAlone) {
  try {
    Expression::parse("1,5", kParserNames, {"a.yaml", 7, 0});
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), std::string("a.yaml:7: ") + kComma);
  }
}

TEST(Problems, ThatStandAfterAZeroByteAreFound) {
  EXPECT_EQ(problem_with(std::string("1\0+", 3)), "a.yaml:7:101: byte 0 has no meaning in an expression");
}

TEST(Names, AreReservedForFunctionsAndPi) {
  for (const char* name : {"pi", "sin", "atan2", "max"}) EXPECT_TRUE(is_reserved_name(name)) << name;
  for (const char* name : {"q1", "Pi", "sinus", ""}) EXPECT_FALSE(is_reserved_name(name)) << name;
}

TEST(Names, AreMadeOfLettersDigitsAndUnderscores) {
  for (const char* name : {"k", "_k", "y_G", "K2"}) EXPECT_TRUE(is_variable_name(name)) << name;
  for (const char* name : {"", "2k", "k-1", "k 1", "\xc3\xa9"}) EXPECT_FALSE(is_variable_name(name)) << name;
}

}  // namespace
}  // namespace chainreel
