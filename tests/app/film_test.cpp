// Films as files: what a decode finds is what the scene asked for and what the audit says.

#include "draw/film/film.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "core/json.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kSmall{"--set", "video.width=320", "--set", "video.height=180",
                                      "--set", "text_scale=1.5"};

ProgramResult render(const std::string& scene, const std::string& film, std::vector<std::string> more = {}) {
  std::vector<std::string> command{"render", "assets/scenes/" + scene + ".yaml", "-o", film, "--quiet"};
  command.insert(command.end(), kSmall.begin(), kSmall.end());
  command.insert(command.end(), more.begin(), more.end());
  return run_program(command);
}

TEST(Film, HasTheFramesSizeAndRateOfItsScene) {
  const TemporaryFolder folder;
  const std::string film = folder.file("film.mp4");
  ASSERT_EQ(render("rr_free", film, {"--set", "duration=1.5"}).status, 0);
  const VideoFacts facts = probe_video(film);
  EXPECT_EQ(facts.codec, "h264");
  EXPECT_EQ(facts.pixel_format, "yuv420p");
  EXPECT_EQ(facts.width, 320);
  EXPECT_EQ(facts.height, 180);
  EXPECT_EQ(facts.fps, (Ratio{60, 1}));
  EXPECT_EQ(facts.frames, 90);
  EXPECT_EQ(facts.duration, (Ratio{3, 2}));
  const Json audit = Json::parse(read_whole_file(folder.file("film.json")));
  EXPECT_EQ(audit["frames"], 90);
  EXPECT_EQ(audit["film_seconds"], 1.5);
  EXPECT_EQ(audit["steps"], 1500);
  EXPECT_EQ(audit["method"], "semi_implicit_euler");
  EXPECT_EQ(audit["step"], 0.001);
  EXPECT_EQ(audit["status"], "finished");
  EXPECT_EQ(audit["energy_start"], 0);  // stretched out at the height of the origin
  EXPECT_EQ(audit["trajectory_sha256"].get<std::string>().size(), 64u);
  for (const char* stage : {"simulate", "draw", "render", "encode", "total"})
    EXPECT_GE(audit["seconds"][stage].get<double>(), 0);
  EXPECT_TRUE(audit["versions"].contains("chainreel"));
}

TEST(Film, RoundsAnAwkwardDurationToWholeFrames) {
  const TemporaryFolder folder;
  const std::string film = folder.file("film.mp4");
  ASSERT_EQ(render("pp_free", film, {"--set", "duration=0.5", "--set", "video.fps=30000/1001"}).status, 0);
  const VideoFacts facts = probe_video(film);
  EXPECT_EQ(facts.frames, 15);  // 14.985 of them
  EXPECT_EQ(facts.fps, (Ratio{30000, 1001}));
  EXPECT_EQ(facts.duration, (Ratio{15 * 1001, 30000}));
}

TEST(Film, ShowsInItsFramesWhatASnapshotShows) {
  const TemporaryFolder folder;
  const std::string film = folder.file("film.mp4");
  ASSERT_EQ(render("rr_torque", film, {"--set", "duration=1"}).status, 0);
  const VideoFacts facts = probe_video(film);
  const PreparedFilm film_made =
      load_film("assets/scenes/rr_torque.yaml",
                {"video.width=320", "video.height=180", "text_scale=1.5", "duration=1"});
  const PreparedScene& prepared = film_made.panels.front();
  const Trajectory trajectory = simulate(prepared.simulation, frame_times(prepared.scene));
  const Fonts fonts;
  const Film drawn(prepared.scene, {{prepared.scene, prepared.simulation.chain, trajectory, &prepared.simulation}}, trajectory.t,
                   fonts);
  const auto image = [&](int k) {
    Picture picture = drawn.static_layer();
    picture.append(drawn.frame(k));
    return rasterise(picture, 320, 180, fonts);
  };
  // H.264 with 4:2:0 blurs coloured edges; the mean over a mostly white page stays small.
  constexpr PictureTolerance kCoded{.max = 255, .mean = 2};
  EXPECT_TRUE(pictures_agree(facts.first, image(0), kCoded, "film_first"));
  EXPECT_TRUE(pictures_agree(facts.last, image(59), kCoded, "film_last"));
  EXPECT_FALSE(pictures_agree(facts.last, image(0), kCoded, "film_control"));  // negative control
}

TEST(Film, IsTheSameFileTwice) {
  const TemporaryFolder folder;
  ASSERT_EQ(render("rrr_torque", folder.file("a.mp4"), {"--set", "duration=0.5"}).status, 0);
  ASSERT_EQ(render("rrr_torque", folder.file("b.mp4"), {"--set", "duration=0.5"}).status, 0);
  EXPECT_EQ(read_whole_file(folder.file("a.mp4")), read_whole_file(folder.file("b.mp4")));
}

TEST(Film, OfARunThatDivergesIsKeptAsPartial) {
  const TemporaryFolder folder;
  const ProgramResult result = render(
      "pp_spring", folder.file("film.mp4"),
      {"--set", "torque=[0, -1e6 * (1 + t^8 * 1e6) * y_G]", "--set", "step=0.001", "--set", "duration=4"});
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.err, testing::HasSubstr("diverged at joint"));
  EXPECT_THAT(result.err, testing::HasSubstr("smaller step"));
  EXPECT_FALSE(fs::exists(folder.file("film.mp4")));
  EXPECT_TRUE(fs::exists(folder.file("film.partial.mp4")));
  EXPECT_LT(probe_video(folder.file("film.partial.mp4")).frames, 240);
}

TEST(Film, GoesToAFolderUnderItsScenesName) {
  const TemporaryFolder folder;
  std::vector<std::string> command{"render",      "assets/scenes/pp_free.yaml", "assets/scenes/rr_free.yaml",
                                   "-o",          folder.file("clips") + "/",   "--set",
                                   "duration=0.1"};
  command.insert(command.end(), kSmall.begin(), kSmall.end());
  const ProgramResult result = run_program(command);
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* file :
       {"clips/pp_free.mp4", "clips/pp_free.json", "clips/pp_free.txt", "clips/rr_free.mp4", "clips/rr_free.json",
        "clips/rr_free.txt"})
    EXPECT_TRUE(fs::exists(folder.file(file))) << file;
  EXPECT_THAT(result.out, testing::HasSubstr("pp_free"));
  EXPECT_THAT(result.out, testing::HasSubstr("frames"));
  int files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.file("clips"))) ++files;
  EXPECT_EQ(files, 6) << "a temporary file was left";
}

}  // namespace
}  // namespace chainreel
