// Every scene under tests/scene/bad says in its first line what is wrong with it:
// # expect: EXIT_CODE FILE[:LINE[:COLUMN]] PART OF THE MESSAGE

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr char kFolder[] = "tests/scene/bad";

std::vector<std::string> bad_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(CHAINREEL_SOURCE_FOLDER) / kFolder))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

struct Expectation {
  int status = 0;
  std::string place, message;
};

Expectation expectation_of(const std::string& path) {
  std::istringstream text(read_whole_file(path));
  std::string hash, word;
  Expectation expected;
  text >> hash >> word >> expected.status >> expected.place;
  std::getline(text >> std::ws, expected.message);
  if (hash != "#" || word != "expect:" || expected.message.empty())
    throw std::runtime_error(path + " does not say what it expects");
  return expected;
}

class BadScene : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Folder, BadScene, ::testing::ValuesIn(bad_scenes()),
                         [](const auto& p) { return p.param; });

TEST_P(BadScene, GivesItsMessagePlaceAndExitCode) {
  const std::string path = std::string(kFolder) + "/" + GetParam() + ".yaml";
  const Expectation expected = expectation_of(path);
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"render", path, "-o", folder.file("never.mp4"), "--quiet"});
  EXPECT_EQ(result.status, expected.status) << result.err;
  EXPECT_THAT(result.err, HasSubstr(expected.place));
  EXPECT_THAT(result.err, HasSubstr(expected.message));
  EXPECT_TRUE(fs::is_empty(folder.path())) << "something was left behind";
}

TEST(BadScenes, CoverWhatUsersGetWrong) {
  EXPECT_GE(bad_scenes().size(), 25u);
}

TEST(BadOutput, OfAnUnwritableFolderIsExitSix) {
  const ProgramResult result = run_program(
      {"render", "assets/scenes/pp_free.yaml", "-o", "/proc/none/film.mp4", "--set", "duration=0.1"});
  EXPECT_EQ(result.status, 6) << result.err;
  EXPECT_THAT(result.err, HasSubstr("choose another"));
}

TEST(BadOutput, DoesNotOverwriteWithoutForce) {
  const TemporaryFolder folder;
  const std::string film = folder.write("film.mp4", "precious");
  const std::vector<std::string> command{"render",
                                         "assets/scenes/pp_free.yaml",
                                         "-o",
                                         film,
                                         "--quiet",
                                         "--set",
                                         "duration=0.1",
                                         "--set",
                                         "video.width=64",
                                         "--set",
                                         "video.height=36"};
  const ProgramResult refused = run_program(command);
  EXPECT_EQ(refused.status, 6);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(read_whole_file(film), "precious");
  std::vector<std::string> forced = command;
  forced.push_back("--force");
  forced.insert(forced.end(), {"--set", "text_scale=0.5"});
  const ProgramResult done = run_program(forced);
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_NE(read_whole_file(film), "precious");
}

TEST(BadOutput, IsFoundBeforeAnythingRunsWhenTwoScenesShareAName) {
  const ProgramResult result =
      run_program({"render", "assets/scenes/pp_free.yaml", "assets/scenes/pp_free.yaml"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("would both be written to out/pp_free.mp4"));
}

}  // namespace
}  // namespace chainreel
