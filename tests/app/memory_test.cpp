// Memory that does not grow with what is asked for. In a program of its own, which is small: what a child takes is told from
// what its parent had on.
#include <gtest/gtest.h>

#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

// KiB of a run of the program, which is to succeed. One arena for all threads: with one for each the same run takes 5 MiB more or
// less, as chance has it, and 2 with one.
long peak_of(const Words& arguments) {
  const ProgramResult result = run_program(arguments, {.environment = {{"MALLOC_ARENA_MAX", "1"}}});
  EXPECT_EQ(result.status, 0) << result.err;
  return result.peak;
}

// Words of all marks, three plots of all samples, trails and ghosts. Of a frame more the run itself is kept, some 40 numbers; all places
// of its words are 600.
TEST(Memory, OfAFilmDoesNotGrowWithItsLength) {
  if (kIsSanitized) GTEST_SKIP() << "the sanitizer keeps what was freed";
  const TemporaryFolder folder;
  const auto film_of = [&](int frames) {
    return peak_of({"render", "rr_forces", "--set", "duration=" + std::to_string(frames / 60), "--set", "plot=[energy, q, tau]", "--width", "160",
                    "--height", "90", "--jobs", "1", "--quiet", "--force", "-o", folder.file("film.mp4")});
  };
  constexpr int kFew = 2400, kMany = 7200;
  const long few = film_of(kFew);
  EXPECT_GT(few, 20 * 1024) << "that of the program itself";
  EXPECT_LT(film_of(kMany) - few, kMany - kFew + 2 * 1024) << "a KiB a frame";
}

// A row is written as it comes: as text it has 200 bytes.
TEST(Memory, OfASweepDoesNotGrowWithItsRows) {
  if (kIsSanitized) GTEST_SKIP() << "the sanitizer keeps what was freed";
  const TemporaryFolder folder;
  const auto sweep_of = [&](int runs) {
    return peak_of({"sweep", "rr_free", "--over", "start.q.1=0:3:100", "--over", "start.q.2=0:3:" + std::to_string(runs / 100), "--set", "duration=0.01",
                    "--quiet", "--force", "-o", folder.file("table.csv")});
  };
  constexpr int kFew = 1000, kMany = 20000;
  const long few = sweep_of(kFew);
  EXPECT_LT(sweep_of(kMany) - few, (kMany - kFew) / 10) << "a hundred bytes a row";
}

}  // namespace
}  // namespace chainreel
