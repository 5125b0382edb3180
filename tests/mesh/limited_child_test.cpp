#include "mesh/limited_child.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <vector>

#include "mesh_files.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

TEST(LimitedChild, RepliesWithWhatTheWorkReturns) {
  // More than a pipe holds at once (64 KiB), and zero bytes inside.
  const std::string text(300'000, '\0');
  const ChildResult result = run_in_limited_child([&] { return text; });
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.reply, text);
}

TEST(LimitedChild, LeavesTheParentsMemoryAlone) {
  int value = 1;
  run_in_limited_child([&] {
    value = 2;
    return std::string();
  });
  EXPECT_EQ(value, 1);
}

TEST(LimitedChild, ACrashIsAResultAndNotTheEnd) {
  const ChildResult result = run_in_limited_child([]() -> std::string {
    raise(SIGSEGV);
    return "alive";
  });
  EXPECT_FALSE(result.finished);
  EXPECT_THAT(result.trouble, HasSubstr("crashed (signal 11)"));
}

TEST(LimitedChild, AnExceptionIsAFailure) {
  const ChildResult result = run_in_limited_child([]() -> std::string { throw std::runtime_error("no"); });
  EXPECT_FALSE(result.finished);
  EXPECT_EQ(result.trouble, "failed");
}

TEST(LimitedChild, EndlessWorkIsEnded) {
  ChildLimits limits;
  limits.cpu_seconds = 1;
  const ChildResult result = run_in_limited_child(
      []() -> std::string {
        volatile bool go_on = true;
        while (go_on) {
        }
        return "ended";
      },
      limits);
  EXPECT_FALSE(result.finished);
  EXPECT_EQ(result.trouble, "took too long");
}

TEST(LimitedChild, WorkThatOnlyWaitsIsEnded) {
  ChildLimits limits;
  limits.seconds = 1;
  const ChildResult result = run_in_limited_child(
      []() -> std::string {
        for (;;) pause();
      },
      limits);
  EXPECT_FALSE(result.finished);
  EXPECT_EQ(result.trouble, "took too long");
}

TEST(LimitedChild, ALongReplyIsCutOffAndRefused) {
  ChildLimits limits;
  limits.reply = 1000;
  EXPECT_EQ(run_in_limited_child([] { return std::string(1000, 'x'); }, limits).reply.size(), 1000U);
  const ChildResult result = run_in_limited_child([] { return std::string(100'000'000, 'x'); }, limits);
  EXPECT_FALSE(result.finished);
  EXPECT_EQ(result.reply, "");
  EXPECT_EQ(result.trouble, "sent back too much");
}

TEST(LimitedChild, MemoryEndsAtTheLimit) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes all address space, so the limit is not set";
#endif
  const auto take = [](std::size_t bytes) {
    return [bytes] {
      std::vector<char> memory(bytes, 'x');
      return std::string(1, memory.at(bytes / 2));
    };
  };
  ChildLimits limits;
  limits.memory = std::size_t(64) << 20;
  EXPECT_EQ(run_in_limited_child(take(std::size_t(16) << 20), limits).reply, "x");
  const ChildResult greedy = run_in_limited_child(take(std::size_t(256) << 20), limits);
  EXPECT_FALSE(greedy.finished);
  EXPECT_EQ(greedy.trouble, "ran out of memory");
  // What the program itself is held to holds for its child, too.
  const LessMemory less(std::size_t(64) << 20);
  EXPECT_EQ(run_in_limited_child(take(std::size_t(16) << 20)).reply, "x");
  EXPECT_EQ(run_in_limited_child(take(std::size_t(256) << 20)).trouble, "ran out of memory");
}

}  // namespace
}  // namespace chainreel
