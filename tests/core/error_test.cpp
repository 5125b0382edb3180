#include "core/error.hpp"

#include <gtest/gtest.h>

namespace chainreel {
namespace {

TEST(Errors, ReadAsFileLineColumnMessageAndLeaveOutWhatIsUnknown) {
  EXPECT_EQ(to_string(Problem{"no such key", {"a.yaml", 3, 7}}), "a.yaml:3:7: no such key");
  EXPECT_EQ(to_string(Problem{"no such key", {"a.yaml", 3, 0}}), "a.yaml:3: no such key");
  EXPECT_EQ(to_string(Problem{"no such key", {"a.yaml", 0, 7}}), "a.yaml: no such key");
  EXPECT_EQ(to_string(Problem{"no such key", {"", 3, 7}}), "no such key");
}

TEST(Errors, CarryTheirExitCodeAndEveryProblemOnItsLine) {
  const Error error(ExitCode::bad_input, {{"one", {"a", 1, 2}}, {"two", {"b", 3, 0}}});
  EXPECT_EQ(error.code(), ExitCode::bad_input);
  EXPECT_STREQ(error.what(), "a:1:2: one\nb:3: two");
  EXPECT_EQ(error.problems().size(), 2u);
  EXPECT_STREQ(Error(ExitCode::usage, "what?").what(), "what?");
}

TEST(Errors, AProblemListThrowsAllOfItsProblemsOrNothing) {
  ProblemList problems;
  EXPECT_TRUE(problems.empty());
  EXPECT_NO_THROW(problems.throw_if_any());
  problems.add("first", {"f", 1, 1});
  problems.add("second", {"f", 2, 1});
  EXPECT_FALSE(problems.empty());
  try {
    problems.throw_if_any(ExitCode::limit);
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::limit);
    EXPECT_STREQ(error.what(), "f:1:1: first\nf:2:1: second");
  }
}

TEST(NearestName, FindsTheCandidateThatWasProbablyMeant) {
  const std::vector<std::string> keys = {"duration", "draw", "gravity", "torque", "q1"};
  EXPECT_EQ(nearest_name("duraton", keys), "duration");
  EXPECT_EQ(nearest_name("gravitiy", keys), "gravity");
  EXPECT_EQ(nearest_name("troque", keys), "torque");
  EXPECT_EQ(nearest_name("q2", keys), "q1");
  EXPECT_EQ(did_you_mean("duraton", keys), " did you mean 'duration'?");
}

TEST(NearestName, PassesOverCapitalsDashesAndExchangedNeighbours) {
  const std::vector<std::string> words = {"rk4", "semi_implicit_euler", "explicit_euler", "chain", "masses"};
  EXPECT_EQ(nearest_name("RK4", words), "rk4");
  EXPECT_EQ(nearest_name("semi-implicit-euler", words), "semi_implicit_euler");
  EXPECT_EQ(nearest_name("chian", words), "chain");
  EXPECT_EQ(did_you_mean("euler", words), " did you mean 'semi_implicit_euler' or 'explicit_euler'?");
  EXPECT_EQ(did_you_mean("mass", words), " did you mean 'masses'?");
  EXPECT_EQ(did_you_mean("ul", words), "") << "two letters are part of everything";
}

TEST(NearestName, KeepsSilentWhereNothingIsNear) {
  const std::vector<std::string> keys = {"duration", "draw"};
  EXPECT_EQ(nearest_name("elephant", keys), "");
  EXPECT_EQ(did_you_mean("elephant", keys), "");
  EXPECT_EQ(nearest_name("duration", {}), "");
}

}  // namespace
}  // namespace chainreel
