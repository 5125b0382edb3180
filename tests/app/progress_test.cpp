// What the program says while it works, and of what it chose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/film/progress.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ProgressWords, GoFromNothingToAll) {
  EXPECT_EQ(bar_text(0), "[>                   ] 0 %");
  EXPECT_EQ(bar_text(0.5), "[==========>         ] 50 %");
  EXPECT_EQ(bar_text(1), "[====================] 100 %");
  for (const double none : {-0.1, 1.1, 0.0 / 0.0}) EXPECT_EQ(bar_text(none), "");
  EXPECT_EQ(time_left_text(0.25, 10), "30 s left");
  EXPECT_EQ(time_left_text(0.001, 10), "") << "too early to tell";
}

// A run that would take an hour, which is ended when it has said what it does.
std::string said_by(const std::string& wrapped, const TemporaryFolder& folder) {
  const std::string run = "\"$0\" simulate assets/scenes/rr_torque.yaml --set method=rk4 --set step=1e-6 --set duration=1000 -o \"$1/a.csv\"";
  const std::string line = wrapped.empty() ? run + " 2> \"$1/said\"" : wrapped;
  const std::string wait = "i=0; until grep -q simulating \"$1/said\" || [ $i -gt 600 ]; do sleep 0.1; i=$((i+1)); done; kill -INT $!; wait $!";
  run_command({"sh", "-c", line + " & " + wait, program_path(), folder.path().string()});
  return read_whole_file(folder.file("said"));
}

TEST(ProgressOfARun, IsToldFromTheFirstSecondsOnWithABar) {
  const TemporaryFolder folder;
  EXPECT_THAT(said_by("", folder), HasSubstr("rr_torque: simulating  [>"));
}

// Standard error shows control characters as \u000d, which a line that rewrites itself needs.
TEST(ProgressOfARun, RewritesItsLineOnATerminal) {
  const TemporaryFolder folder;
  const std::string said = said_by(
      "script -qefc \"'$0' simulate assets/scenes/rr_torque.yaml --set method=rk4 --set step=1e-6 --set duration=1000 -o '$1/a.csv'\" \"$1/said\" > \"$1/shown\"",
      folder);
  EXPECT_THAT(said, HasSubstr("\rrr_torque: simulating"));
  EXPECT_THAT(said, Not(HasSubstr("\\u000d")));
}

TEST(CheckOfAChoice, ShowsTheThreeNextBestUnlessAllAreAskedFor) {
  const Words words{"check", "assets/scenes/rr_free.yaml", "--set", "method=auto", "--set", "duration=1"};
  const auto candidates = [](const std::string& out) {  // rows of the table behind its head
    const std::size_t head = out.find("next best");
    const std::string table = out.substr(out.find('\n', head) + 1);
    return std::count(table.begin(), table.begin() + std::ptrdiff_t(std::min(table.find("others: --all"), table.find("computed for"))), '\n');
  };
  const ProgramResult few = run_program(words), all = run_program(with(words, {"--all"}));
  ASSERT_EQ(few.status, 0) << few.err;
  EXPECT_THAT(few.out, HasSubstr("auto: "));
  EXPECT_EQ(candidates(few.out), 3);
  EXPECT_THAT(few.out, HasSubstr("others: --all"));
  EXPECT_GT(candidates(all.out), 3);
  EXPECT_THAT(all.out, Not(HasSubstr("--all")));
  EXPECT_EQ(run_program({"check", "assets/scenes/rr_free.yaml", "--all", "--set", "method=rk4"}).status, 2);
  EXPECT_EQ(run_program({"check", "models/rr.urdf", "--all"}).status, 2);
  // JSON has them all in any case.
  const Json json = Json::parse(run_program(with(words, {"--json"})).out);
  EXPECT_GE(json["cost"]["auto"]["tried"].size(), std::size_t(candidates(all.out)));
}

}  // namespace
}  // namespace chainreel
