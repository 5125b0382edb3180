// What `bench` says of a film: its stages, and its encoder alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

const Words kBenchedFilm{"--quiet", "--set", "video.width=96", "--set", "video.height=54", "--set", "duration=2"};

Json bench(const Words& more) {
  const ProgramResult result = run_program(with(with({"bench", "assets/scenes/rr_ellipse.yaml", "--json"}, kBenchedFilm), more));
  EXPECT_EQ(result.status, 0) << result.err;
  return result.status == 0 ? Json::parse(result.out).at("films").at(0) : Json();
}

TEST(Bench, StagesAndTheRestAreTheWholeOfTheProcessorsTime) {
  const Json report = bench({"--jobs", "2"});
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["frames"], 120);
  EXPECT_EQ(report["film_frames"], 120);
  EXPECT_EQ(report["chunks"], 2);
  EXPECT_EQ(report["jobs"], 2);
  double sum = 0;
  for (const auto& [name, stage] : report["stages"].items()) {
    sum += stage["cpu_ms"].get<double>();
    if (name != "rest") EXPECT_GT(stage["cpu_ms"].get<double>(), 0) << name;
  }
  // The least of rounds counts; of one round, to rounding.
  EXPECT_NEAR(sum * 120 / 1000, report["whole"]["cpu"].get<double>(), 1e-9);
  EXPECT_GT(report["encoder_alone"]["cpu"].get<double>(), 0);
  EXPECT_DOUBLE_EQ(report["ratio"]["wall"].get<double>(),
                   report["whole"]["wall"].get<double>() / report["encoder_alone"]["wall"].get<double>());
  EXPECT_GT(report["one_encoder"]["cpu"].get<double>(), 0);
  EXPECT_DOUBLE_EQ(report["ratio_to_one_encoder"]["cpu"].get<double>(),
                   report["whole"]["cpu"].get<double>() / report["one_encoder"]["cpu"].get<double>());
}

TEST(Bench, OfAFilmWhoseFramesDoNotFitIsThatOfItsFirstChunksAndSaysSo) {
  // 60 frames of a chunk are 0.83 MB, 120 are 1.66.
  const Words little{"--memory", "1", "--set", "video.width=128", "--set", "video.height=72"};
  const Json report = bench(little);
  EXPECT_EQ(report["frames"], 60);
  EXPECT_EQ(report["film_frames"], 120);
  EXPECT_EQ(report["chunks"], 1);
  EXPECT_EQ(report["jobs"], 1) << "a chunk keeps one thread busy";
  const ProgramResult told = run_program(with(with({"bench", "assets/scenes/rr_ellipse.yaml"}, kBenchedFilm), little));
  EXPECT_THAT(told.out, HasSubstr("of its 120: so many fit into memory for the encoder alone (--memory)"));
}

TEST(Bench, LeavesNothingBehindAndWritesNoFileOfTheScene) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program(with({"bench", "assets/scenes/pp_free.yaml"}, kBenchedFilm), {.environment = {{"TMPDIR", folder.path()}}});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THAT(result.out, HasSubstr("times as long"));
}

}  // namespace
}  // namespace chainreel
