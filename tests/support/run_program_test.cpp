#include "support/run_program.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

TEST(RunProgram, KeepsBothOutputsAndTheStatusApart) {
  const ProgramResult result = run_command({"sh", "-c", "echo out; echo err >&2; exit 7"});
  EXPECT_EQ(result.status, 7);
  EXPECT_EQ(result.out, "out\n");
  EXPECT_EQ(result.err, "err\n");
  EXPECT_FALSE(result.timed_out);
}

TEST(RunProgram, ArgumentsAreNotReadByAShell) {
  EXPECT_EQ(run_command({"printf", "%s|", "a b", "$HOME", "*", ""}).out, "a b|$HOME|*||");
}

TEST(RunProgram, ManyBytesOnBothOutputsDoNotBlock) {
  const ProgramResult result = run_command(
      {"sh", "-c",
       "head -c 1000000 /dev/zero >&2; head -c 1000000 /dev/zero; head -c 1000000 /dev/zero >&2"});
  EXPECT_EQ(result.out.size(), 1'000'000u);
  EXPECT_EQ(result.err.size(), 2'000'000u);
}

TEST(RunProgram, FolderAndEnvironmentAreTheCallers) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_command({"sh", "-c", "pwd -P; echo $CHAINREEL_TEST_WORD"},
                  {.folder = folder.path().string(), .environment = {{"CHAINREEL_TEST_WORD", "hello"}}});
  EXPECT_EQ(result.out, std::filesystem::canonical(folder.path()).string() + "\nhello\n");
}

TEST(RunProgram, TheTimeLimitEndsChildrenToo) {
  const ProgramResult result = run_command({"sh", "-c", "echo begun; sleep 600 & wait"}, {.timeout_s = 0.5});
  EXPECT_TRUE(result.timed_out);
  EXPECT_EQ(result.out, "begun\n");
  EXPECT_EQ(result.status, 128 + 9);
}

TEST(RunProgram, ASignalIsNotAGoodEnd) {
  EXPECT_EQ(run_command({"sh", "-c", "kill -TERM $$"}).status, 128 + 15);
}

TEST(RunProgram, AProgramThatIsNotThereThrows) {
  EXPECT_THROW(run_command({"/nonexistent/program"}), std::runtime_error);
}

}  // namespace
}  // namespace chainreel
