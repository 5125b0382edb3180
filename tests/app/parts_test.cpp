// A film made by many: by threads, in parts, again after it was killed. The bytes are those of one that draws all of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// 128 frames at 60 frames/s, with those that are held: two chunks of a film, and 16 of what has key frames alone.
const Words kSmall{"--quiet", "--set", "video.width=96", "--set", "video.height=54",
                   "--set",   "duration=2", "--hold", "{first: 0.05, last: 0.084}"};

Words render_of(const std::string& scene, const Words& more) {
  return with(with({"render", "assets/scenes/" + scene + ".yaml"}, kSmall), more);
}

// All files below a folder, by their place in it; of audits what does not depend on the clock.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string bytes = read_whole_file(entry.path().string());
    if (entry.path().extension() == ".json") {
      Json audit = Json::parse(bytes);
      audit.erase("seconds");
      bytes = audit.dump();
    }
    files[fs::relative(entry.path(), folder).string()] = bytes;
  }
  return files;
}

void expect_same_files(const fs::path& a, const fs::path& b) {
  const auto first = files_in(a), second = files_in(b);
  for (const auto& [name, bytes] : first) {
    ASSERT_TRUE(second.contains(name)) << name;
    EXPECT_TRUE(bytes == second.at(name)) << name << " differs";
  }
  EXPECT_EQ(first.size(), second.size());
}

TEST(Jobs, HoweverManyGiveTheSameBytes) {
  const TemporaryFolder one, two, eight;
  for (const auto& [folder, jobs] : {std::pair{&one, "1"}, {&two, "2"}, {&eight, "8"}}) {
    Words words{"--jobs", jobs, "--at", "0.5"};
    for (const char* name : {"a.mp4", "b.webm", "c.mov", "d.gif", "e.apng", "f/f_000000.png", "g.png", "h.svg", "i.csv"})
      words = with(words, {"-o", folder->file(name)});
    ASSERT_EQ(run_program(render_of("rr_ellipse", words)).status, 0);
  }
  EXPECT_EQ(probe_video(one.file("a.mp4")).frames, 128);
  EXPECT_THAT(probe_video(one.file("a.mp4")).key_frames, testing::ElementsAre(0, 64));
  EXPECT_EQ(probe_video(one.file("b.webm")).frames, 128);
  EXPECT_TRUE(fs::exists(one.file("f/f_000127.png")) && !fs::exists(one.file("f/f_000128.png")));
  expect_same_files(one.path(), two.path());
  expect_same_files(one.path(), eight.path());
}

TEST(Jobs, BodiesInSpaceAndTransparentPagesToo) {
  const TemporaryFolder one, many;
  for (const auto& [folder, jobs] : {std::pair{&one, "1"}, {&many, "4"}})
    ASSERT_EQ(run_program(render_of("arm_ellipsoid", {"--set", "duration=0.9", "--preset", "overlay", "--jobs", jobs, "-o",
                                                      folder->file("a.webm"), "-o", folder->file("a.mov")}))
                  .status,
              0);
  expect_same_files(one.path(), many.path());
}

TEST(Jobs, AnErrorOfOneEndsAllAndLeavesNothing) {
  const TemporaryFolder folder;
  // No file may grow beyond 20 kB.
  const ProgramResult result = run_command(
      with({"sh", "-c", "ulimit -f 40; exec \"$0\" \"$@\"", program_path()},
           render_of("rr_ellipse", {"--jobs", "4", "-o", folder.file("a.mov"), "-o", folder.file("b.mp4")})));
  EXPECT_EQ(result.status, 6) << result.err;
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace chainreel
