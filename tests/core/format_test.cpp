#include "core/format.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <locale>
#include <sstream>

#include "core/ulps.hpp"

namespace chainreel {
namespace {

TEST(Format, ShortestTextsReadBackAsTheSameDouble) {
  test::Numbers numbers(31);
  for (int i = 0; i < 5000; ++i) {
    const double value = i % 2 == 0 ? numbers.any() : numbers.between(-10, 10);
    ASSERT_EQ(parse_number(format_shortest(value)), value);
  }
}

TEST(Format, SixteenDigitsWouldNotReadBack) {
  test::Numbers numbers(32);
  int lost = 0;
  for (int i = 0; i < 1000; ++i) {
    const double value = numbers.between(1, 10);
    lost += parse_number(format_significant(value, 16)) != value;
  }
  EXPECT_GT(lost, 100);
}

TEST(Format, ShortestIsShort) {
  EXPECT_EQ(format_shortest(0.1), "0.1");
  EXPECT_EQ(format_shortest(1e300), "1e+300");
}

TEST(Format, FixedNeverShowsANegativeZero) {
  EXPECT_EQ(format_fixed(-0.001, 2), "0.00");
  EXPECT_EQ(format_fixed(-0.0, 0), "0");
  EXPECT_EQ(format_fixed(-0.006, 2), "-0.01");
  EXPECT_EQ(format_fixed(1234.5678, 1), "1234.6");
  EXPECT_EQ(format_fixed(1e308, 0).size(), 309u);
}

TEST(Format, SignificantDropsTrailingZeros) {
  EXPECT_EQ(format_significant(1.26795, 4), "1.268");
  EXPECT_EQ(format_significant(2.0, 4), "2");
  EXPECT_EQ(format_significant(-0.0, 4), "0");
  EXPECT_EQ(format_significant(-432.1, 2), "-430");
  EXPECT_EQ(format_significant(99960, 3), "100000");
  EXPECT_EQ(format_significant(123456, 2), "1.2e+05");
  EXPECT_EQ(format_significant(0.00000123, 2), "1.2e-06");
}

TEST(Format, RoundedDownNeverLiesAbove) {
  EXPECT_EQ(rounded_down(0, 3), 0);
  EXPECT_DOUBLE_EQ(rounded_down(1.2399, 3), 1.23);
  EXPECT_DOUBLE_EQ(rounded_down(99.99, 2), 99);
  EXPECT_DOUBLE_EQ(rounded_down(0.0045678, 1), 0.004);
}

TEST(ParseNumber, TakesOneFiniteNumberAndNothingElse) {
  EXPECT_EQ(parse_number("-1.5e2"), -150);
  EXPECT_EQ(parse_number("+3"), 3);
  for (const char* text :
       {"", " 1", "1 ", "1,5", "+-1", "++1", "nan", "inf", "-inf", "1e999", "0x10", "1.5m", "."})
    EXPECT_EQ(parse_number(text), std::nullopt) << "'" << text << "'";
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(ParseNumber, IgnoresTheLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
  const std::string c_before = std::setlocale(LC_NUMERIC, nullptr);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // where it is installed
  std::ostringstream stream;
  stream << 1.5;
  EXPECT_EQ(stream.str(), "1,5") << "the locale has no effect here: nothing is tested";
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number("1,5"), std::nullopt);
  EXPECT_EQ(format_fixed(1.5, 1), "1.5");
  EXPECT_EQ(format_shortest(1.5), "1.5");
  std::setlocale(LC_NUMERIC, c_before.c_str());
  std::locale::global(before);
}

TEST(Separated, HoldsEmptyPartsButForOneBehindTheLastSign) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(separated("a,b", ','), (Words{"a", "b"}));
  EXPECT_EQ(separated("a,,b,", ','), (Words{"a", "", "b"}));
  EXPECT_EQ(separated("", ','), Words{});
}

TEST(Format, OfPowersHasOneDigit) {
  EXPECT_EQ(format_power(3.2e-14), "3\u00D710\u207B\u00B9\u2074");
  EXPECT_EQ(format_power(9.9e6), "1\u00D710\u2077") << "rounded up";
  EXPECT_EQ(format_power(1), "1\u00D710\u2070");
}

}  // namespace
}  // namespace chainreel
