#include "core/names.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace chainreel {

// Found by argument, as those of real enumerations.
enum class Weather { sun, rain, fog };
std::span<const Name> names_of(Weather) {
  static constexpr Name names[] = {{"sun", ""}, {"rain", ""}, {"fog", ""}};
  return names;
}

namespace {

TEST(Names, GoBothWays) {
  for (const Weather value : {Weather::sun, Weather::rain, Weather::fog})
    EXPECT_EQ(value_named<Weather>(to_string(value)), value);
  EXPECT_FALSE(value_named<Weather>("snow"));
  EXPECT_FALSE(value_named<Weather>(""));
}

TEST(Names, AreListedWithAnOrBeforeTheLast) {
  const std::span<const Name> names = names_of(Weather{});
  EXPECT_EQ(alternatives(names), "sun, rain or fog");
  EXPECT_EQ(alternatives(names.first(2)), "sun or rain");
  EXPECT_EQ(alternatives(names.first(1)), "sun");
}

TEST(Names, ThatAreWrongAreRefusedWithTheNearestOne) {
  try {
    require_named<Weather>("'sky'", "rein");
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_STREQ(error.what(), "'sky' must be sun, rain or fog, not 'rein': did you mean 'rain'?");
  }
}

}  // namespace
}  // namespace chainreel
