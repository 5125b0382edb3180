// Films with slow motion, as files: frames, tables, audit, captions and what remembers them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/json.hpp"
#include "draw/shapes.hpp"
#include "encode/png.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// PP falls from rest: q2 = -g t^2 / 2, which rk4 follows exactly; through -0.5 m after sqrt(1 / g).
constexpr char kFalling[] = "model: " CHAINREEL_SOURCE_FOLDER
                            "/models/pp.urdf\nduration: 0.5\nmethod: rk4\nstep: 0.01\ntorque: [0, 0]\n"
                            "events: [{when: \"q2 < -0.5\", name: half}, {when: \"t > 0.495\", name: late}]\n"
                            "video: {width: 320, height: 180}\ntext_scale: 1.5\n";
// 0.1 s, then 0.1 s four times slower (0.4 s), 0.3 s: 0.8 s of film.
constexpr char kSlow[] = "slow_motion: [{from: 0.1, until: 0.2, speed: 0.25}]\n";
// From 0.05 s before the event to as long after it ten times slower: 0.4 + 1 s.
constexpr char kAround[] = "slow_motion: [{event: half, from: -0.05, until: 0.05, speed: 0.1}]\n";
// Not even about the events.
constexpr char kNone[] = "slow_motion: none\n";
const double kHalf = std::sqrt(1 / 9.81);

std::vector<std::vector<double>> table_of(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream text(csv);
  std::string line, cell;
  std::getline(text, line);
  while (std::getline(text, line)) {
    rows.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      rows.back().push_back(std::stod(cell));
  }
  return rows;
}

class SlowMotionFilm : public ::testing::Test {
 protected:
  std::string scene(const std::string& more) const { return folder_.write("falls.yaml", kFalling + more); }
  // Writes falls.ENDING for each.
  Json render(const std::string& more, const std::vector<std::string>& endings,
              const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{"render", scene(more), "--quiet", "--force"};
    for (const std::string& ending : endings) command.insert(command.end(), {"-o", file(ending)});
    command.insert(command.end(), options.begin(), options.end());
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(read_whole_file(file("json")));
  }
  std::string file(const std::string& ending) const { return folder_.file("falls." + ending); }
  std::string text(const std::string& ending) const { return read_whole_file(file(ending)); }

  TemporaryFolder folder_;
};

TEST_F(SlowMotionFilm, IsSampledAnewFromTheMotion) {
  const Json audit = render(kSlow, {"mp4", "csv"});
  const VideoFacts facts = probe_video(file("mp4"));
  EXPECT_EQ(facts.frames, 48);
  EXPECT_EQ(facts.duration, (Ratio{4, 5}));
  EXPECT_TRUE(facts.regular);
  EXPECT_EQ(audit["frames"], 48);
  EXPECT_EQ(audit["film_seconds"], 0.8);
  EXPECT_EQ(audit["duration"], 0.5);
  const auto rows = table_of(text("csv"));
  ASSERT_EQ(rows.size(), 49u) << "a row a frame, and one at the end";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double film = double(k) / 60;
    const double t = film < 0.1 ? film : film < 0.5 ? 0.1 + (film - 0.1) / 4 : 0.2 + (film - 0.5);
    EXPECT_NEAR(rows[k][0], t, 1e-14);
    // The closed form, to round-off of the steps.
    EXPECT_NEAR(rows[k][2], -9.81 / 2 * t * t, 1e-13);
    if (k > 0) {
      EXPECT_LT(rows[k][2], rows[k - 1][2]) << "a frame was repeated";
    }
  }
  EXPECT_EQ(rows.back()[0], 0.5);
  // Negative control.
  render(kNone, {"mp4", "csv"});
  EXPECT_EQ(probe_video(file("mp4")).frames, 30);
  EXPECT_EQ(table_of(text("csv")).size(), 31u);
}

TEST_F(SlowMotionFilm, FollowsAnEventThatOnlyTheRunKnows) {
  const Json plain = render(kNone, {"mp4"});
  const Json audit = render(kAround, {"mp4", "csv"});
  EXPECT_EQ(probe_video(file("mp4")).frames, 84);
  ASSERT_EQ(audit["slow_motion"].size(), 1u);
  const Json& one = audit["slow_motion"][0];
  EXPECT_NEAR(one["from"].get<double>(), kHalf - 0.05, 1e-11);
  EXPECT_NEAR(one["until"].get<double>(), kHalf + 0.05, 1e-11);
  EXPECT_NEAR(one["film_from"].get<double>(), kHalf - 0.05, 1e-11);
  EXPECT_NEAR(one["film_until"].get<double>(), kHalf + 0.95, 1e-11);
  // Samples are none of the run's concern: the same instant to the last bit.
  EXPECT_EQ(audit["events"], plain["events"]);
  EXPECT_EQ(plain.at("slow_motion"), Json::array());
  // Captions at the times of the film: the event lies half a second behind the change; what comes behind the
  // instant of the last frame is told before the end, here with what is being read then.
  EXPECT_THAT(text("srt"), HasSubstr("1\n00:00:00,769 --> 00:00:00,900\nhalf\n\n2\n00:00:00,900 --> 00:00:01,400\nhalf\nlate\n"));
  EXPECT_THAT(text("txt"), HasSubstr("not at its own speed: t = 0.269275 s to 0.369275 s at 0.1\u00D7"));
  EXPECT_THAT(text("txt"), HasSubstr("84 frames"));
}

TEST_F(SlowMotionFilm, OfAnEventThatDoesNotComeIsThePlainOne) {
  const Json audit = render("slow_motion: [{event: half, from: 0, until: 1, speed: 0.1}]\n", {"csv"},
                            {"--set", "duration=0.3"});
  EXPECT_EQ(audit["slow_motion"], Json::array());
  EXPECT_EQ(audit["frames"], 18);
  const ProgramResult loud =
      run_program({"render", file("yaml"), "-o", file("csv"), "--force", "--set", "duration=0.3"});
  EXPECT_THAT(loud.err, HasSubstr("falls: no slow motion about 'half', which does not happen"));
}

TEST_F(SlowMotionFilm, SaysSoBesideTheTimeForAsLongAsItHolds) {
  const auto words_at = [&](const std::string& at, const std::string& more = kSlow) {
    const ProgramResult result =
        run_program({"snapshot", scene(more), "--at", at, "-o", file("svg"), "--force", "--quiet"});
    EXPECT_EQ(result.status, 0) << result.err;
    return text("svg");
  };
  // Instants of the motion, with as many decimals as tell the frames apart.
  EXPECT_THAT(words_at("0.1"), HasSubstr("0.25\u00D7"));
  EXPECT_THAT(words_at("0.15"), testing::AllOf(HasSubstr("0.25\u00D7"), HasSubstr("t = 0.150 s")));
  EXPECT_THAT(words_at("0.199"), HasSubstr("0.25\u00D7"));
  EXPECT_THAT(words_at("0.099"), testing::AllOf(Not(HasSubstr("\u00D7")), HasSubstr("t = 0.099 s")));
  EXPECT_THAT(words_at("0.2"), Not(HasSubstr("\u00D7")));
  EXPECT_THAT(words_at("0.15", kNone), testing::AllOf(Not(HasSubstr("\u00D7")), HasSubstr("t = 0.15 s")));
  EXPECT_THAT(words_at("0.15", "slow_motion: [{from: 0, until: 0.5, speed: 4}]\n"),
              testing::AllOf(HasSubstr("4\u00D7"), HasSubstr("t = 0.15 s")));
}

TEST_F(SlowMotionFilm, IsRememberedWithAllOfItsFrames) {
  for (const char* slow : {kSlow, kAround}) {
    const TemporaryFolder once, again;
    const std::string film = scene(slow), clip = once.file("f_000000.png"), extracted = again.file("f.yaml");
    ASSERT_EQ(run_program({"render", film, "--quiet", "-o", clip}).status, 0);
    ASSERT_EQ(run_program({"extract", clip, "-o", extracted}).status, 0);
    ASSERT_EQ(run_program({"render", extracted, "--quiet", "-o", again.file("f_000000.png")}).status, 0);
    int frames = 0;
    for (const auto& entry : std::filesystem::directory_iterator(once.path())) {
      if (entry.path().extension() != ".png") continue;
      ++frames;
      EXPECT_EQ(read_png(entry.path().string()).bgra,
                read_png(again.file(entry.path().filename().string())).bgra);
    }
    EXPECT_EQ(frames, slow == kSlow ? 48 : 84);
  }
}

TEST_F(SlowMotionFilm, IsCountedByCheckAndOfNoMatterToSimulate) {
  const auto checked = [&](const std::string& more, const std::vector<std::string>& options = {}) {
    std::vector<std::string> command{"check", scene(more), "--json"};
    command.insert(command.end(), options.begin(), options.end());
    return run_program(command);
  };
  EXPECT_EQ(Json::parse(checked(kAround).out)["cost"]["frames"], 84);
  EXPECT_THAT(checked(kAround).out, HasSubstr("slow_motion: ["));
  EXPECT_EQ(Json::parse(checked(kNone).out)["cost"]["frames"], 30);
  // Only the run can tell how long that gets.
  const ProgramResult endless = checked("slow_motion: [{event: half, from: -1, until: 1000, speed: 0.001}]\n",
                                        {"--set", "duration=100", "--set", "video.fps=240"});
  EXPECT_EQ(endless.status, 7);
  EXPECT_THAT(endless.err, HasSubstr("falls.yaml:9:"));
  EXPECT_THAT(endless.err, HasSubstr("more than ten million frames"));
  const auto states = [&](const std::string& more) {
    return run_program({"simulate", scene(more), "-o", "-", "--quiet"}).out;
  };
  EXPECT_EQ(states(kSlow), states(""));
}

TEST_F(SlowMotionFilm, OfPanelsFollowsTheEventsOfTheFirst) {
  const std::string panels = "compare: [{title: a}, {title: b, gravity: [0, -4, 0]}]\n";
  const Json audit = render(kAround + panels, {"mp4"});
  EXPECT_EQ(audit["frames"], 84);
  EXPECT_NEAR(audit["slow_motion"][0]["from"].get<double>(), kHalf - 0.05, 1e-11);
  EXPECT_EQ(probe_video(file("mp4")).frames, 84);
}

TEST_F(SlowMotionFilm, HoldsAndSmallClipsGoByTheTimeOfTheFilm) {
  const Json audit =
      render(kSlow, {"gif", "mp4"}, {"--set", "video.fps=25", "--hold", "{first: 0.2, last: 0.4}"});
  EXPECT_EQ(audit["frames"], 20 + 5 + 10);
  EXPECT_EQ(probe_video(file("gif")).frames, 35);
  EXPECT_NEAR(audit["slow_motion"][0]["film_from"].get<double>(), 0.3, 1e-12);
  EXPECT_NEAR(audit["slow_motion"][0]["film_until"].get<double>(), 0.7, 1e-12);
  // `late` at 0.495 s of the motion is 0.995 s of the film, which leaves too little time to read it alone.
  EXPECT_THAT(text("srt"), HasSubstr("00:00:00,819 --> 00:00:00,900\nhalf\n\n2\n00:00:00,900 --> 00:00:01,400\nhalf\nlate\n"));
}

TEST_F(SlowMotionFilm, TheTableOfAFilmEndsWhereThatOfARunDoes) {
  const Json audit = render(kNone, {"csv"});
  const std::string states = run_program({"simulate", scene(kNone), "-o", "-", "--quiet"}).out;
  EXPECT_EQ(text("csv"), states);
  const ProgramResult run = run_program({"simulate", scene(kNone), "-o", file("b.csv"), "--json", "--quiet"});
  EXPECT_EQ(Json::parse(run.out)["trajectory_sha256"], audit["trajectory_sha256"]);
}

TEST_F(SlowMotionFilm, LooksLikeItsGolden) {
  const Fonts fonts;
  for (const char* theme : {"light", "dark"}) {
    const PreparedFilm film = load_film(
        "assets/scenes/rr_ellipse.yaml",
        {"video.width=640", "video.height=360", "text_scale=1.5", "duration=2", std::string("theme=") + theme,
         "slow_motion=[{from: 0.5, until: 1, speed: 0.25}, {from: 1.5, until: 2, speed: 4}]"});
    const FilmClock clock = clock_of(film);
    const std::vector<double> times = clock.frame_times();
    ASSERT_EQ(times.size(), 60u + 120u + 8u);  // 1 s, 2 s and an eighth of a second, which is 7.5 frames
    const Runs runs(film, clock, times);
    const Film pictures = runs.pictures(int(times.size()), fonts);
    const auto image = [&](int k) {
      Picture picture = pictures.static_layer();
      picture.append(pictures.frame(k));
      return rasterise(picture, 640, 360, fonts);
    };
    const std::string name = std::string("slow_motion_") + theme;
    EXPECT_TRUE(matches_golden(image(90), name, {.max = 24, .mean = 0.05}));
    EXPECT_FALSE(pictures_agree(image(90), image(160), {.max = 24, .mean = 0.05}, name + "_control"));
  }
}

// Stands still at the event for 0.4 s, and at 0.4 s for 0.2 s.
constexpr char kWords[] =
    "slow_motion: none\n"
    "annotate: [{event: half, text: \"half a metre\", point: gripper, hold: 0.4s}, "
    "{at: 0.4s, text: \"$g t^2 / 2$\", point: [0.2, -0.5], hold: 0.2s}, {event: late, text: late, point: gripper, hold: 0}]\n";

TEST_F(SlowMotionFilm, StandsStillForWordsWhichItsAuditAndItsTextTell) {
  const Json audit = render(kWords, {"gif"});
  EXPECT_EQ(audit["drawn"]["frames"], 66) << "0.5 s and 0.6 s at 60 frames a second";
  ASSERT_EQ(audit["pauses"].size(), 2u) << "hold: 0 is none";
  EXPECT_NEAR(double(audit["pauses"][0]["at"]), kHalf, 1e-9);
  EXPECT_EQ(audit["pauses"][0]["seconds"], 0.4);
  EXPECT_NEAR(double(audit["pauses"][0]["film_from"]), kHalf, 1e-9);
  EXPECT_EQ(audit["pauses"][1]["at"], 0.4);
  EXPECT_NEAR(double(audit["pauses"][1]["film_from"]), 0.8, 1e-9) << "behind the first pause";
  EXPECT_EQ(audit.at("slow_motion"), Json::array());
  EXPECT_THAT(text("txt"), HasSubstr("stands still at t = 0.319275 s for 0.4 s, at 0.4 s for 0.2 s"));
  EXPECT_EQ(render(kNone, {"gif"}).at("pauses"), Json::array());
}

TEST_F(SlowMotionFilm, StandsStillForWordsOfOneInstantOneBehindTheOther) {
  const Json audit = render("slow_motion: none\nannotate: [{event: half, text: a, point: gripper, hold: 0.4s}, {event: again, text: b, point: [0.2, -0.5], hold: 0.2s}]\n", {"gif"},
                            {"--set", "events=[{when: \"q2 < -0.5\", name: half}, {when: \"q2 < -0.5\", name: again}]"});
  EXPECT_EQ(audit["drawn"]["frames"], 66);
  ASSERT_EQ(audit["pauses"].size(), 2u);
  EXPECT_NEAR(double(audit["pauses"][0]["film_from"]), kHalf, 1e-9);
  EXPECT_NEAR(double(audit["pauses"][1]["film_from"]), kHalf + 0.4, 1e-9);
}

TEST_F(SlowMotionFilm, ItsTableHasEachInstantOnce) {
  render(kWords, {"mp4", "csv"});
  const auto rows = table_of(text("csv"));
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_LT(rows[k - 1][0], rows[k][0]) << k;
  EXPECT_LT(rows.size(), 66u) << "which is how many frames there are";
  EXPECT_GT(rows.size(), 30u);
}

TEST_F(SlowMotionFilm, OfWordsThatComeBehindItsEndHasNoPause) {
  const Json audit = render("annotate: [{at: 0.45s, text: never, point: gripper, hold: 0.4s}]\n",
                            {"gif"}, {"--set", "events=[{when: \"q2 < -0.5\", kind: stop, name: half}]"});
  EXPECT_TRUE(audit["pauses"].empty()) << audit["pauses"];
  EXPECT_LT(int(audit["frames"]), 30);
}

TEST_F(SlowMotionFilm, ThatStandsStillIsResumedWithTheSameBytes) {
  render(kWords, {"mp4"});
  const std::string whole = text("mp4");
  render(kWords, {"mp4"}, {"--resume"});
  EXPECT_TRUE(text("mp4") == whole);
}

TEST_F(SlowMotionFilm, APictureOfAnInstantAtWhichItStandsStillHasTheWords) {
  const auto picture = [&](const std::string& at, const std::string& more = kWords) {
    EXPECT_EQ(run_program({"snapshot", scene(more), "--at", at, "-o", file("svg"), "--force", "--quiet"}).status, 0);
    const std::string svg = text("svg");
    return svg.substr(svg.find("</metadata>"));  // which holds the scene
  };
  EXPECT_THAT(picture("0"), Not(HasSubstr("half a metre"))) << "they come with the pause";
  EXPECT_THAT(picture("event half"), HasSubstr("half a metre"));
  EXPECT_THAT(picture("event half", ""), Not(HasSubstr("half a metre")));
}

// By itself: 0.05 s, a tenth of the motion, before and behind `half`. With `late`, which is near and would be one with it, the
// film would be more than twice as long as the motion.
constexpr char kAuto[] = "";

TEST_F(SlowMotionFilm, IsThereByItselfAboutEventsAndSaysSo) {
  const Json audit = render(kAuto, {"mp4", "csv"});
  ASSERT_EQ(audit["slow_motion"].size(), 1u) << audit["slow_motion"].dump();
  const Json& half = audit["slow_motion"][0];
  EXPECT_NEAR(half["from"].get<double>(), kHalf - 0.05, 1e-11);
  EXPECT_NEAR(half["until"].get<double>(), kHalf + 0.05, 1e-11);
  EXPECT_EQ(half["speed"], 0.25);
  EXPECT_EQ(half["ease"], 0.025);
  EXPECT_EQ(half["because"], "'half'");
  // A quarter of the speed for half of it; as long as 1 / 0.625 of the motion where it changes.
  EXPECT_NEAR(half["film_until"].get<double>() - half["film_from"].get<double>(), 0.05 / 0.25 + 0.05 / 0.625, 1e-9);
  EXPECT_EQ(probe_video(file("mp4")).frames, audit["frames"]);
  EXPECT_EQ(table_of(text("csv")).size(), audit["frames"].get<std::size_t>() + 1) << "a row a frame, and the end";
  EXPECT_THAT(text("txt"), HasSubstr("s at 0.25\u00D7, eased within that ('half')"));
  const ProgramResult loud = run_program({"render", file("yaml"), "-o", file("csv"), "--force"});
  EXPECT_THAT(loud.err, HasSubstr("falls: film lasts 0.7 s, its motion 0.5 s: slow motion at 1 place (--set slow_motion=none): t = 0.269275 s to "
                                  "0.369275 s at 0.25\u00D7, eased within that ('half')"));
  const ProgramResult check = run_program({"check", file("yaml"), "--json"});
  EXPECT_EQ(Json::parse(check.out)["cost"]["frames"], audit["frames"]);
  EXPECT_EQ(Json::parse(check.out)["slow_motion"][0]["because"], "'half'");
  EXPECT_THAT(run_program({"check", file("yaml")}).out, HasSubstr("slow motion from t = 0.269275 s"));
  // Ended by an event, it is as long as it has become, not as it might have.
  const ProgramResult ended = run_program({"render", file("yaml"), "-o", file("csv"), "--force", "--set", "duration=5", "--set",
                                           "events=[{when: \"q2 < -0.5\", kind: stop, name: half}]"});
  EXPECT_THAT(ended.err, AllOf(HasSubstr("its motion 0.3193 s"), HasSubstr("film lasts 0.")));
  EXPECT_EQ(render(kNone, {"mp4"}).at("slow_motion"), Json::array());
}

TEST_F(SlowMotionFilm, ByItselfShowsTheSameInstantsAsPicturesAndParts) {
  // Two groups of pictures, so that there are two parts.
  const std::vector<std::string> longer{"--set", "duration=3", "--quiet"};
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.end(), longer.begin(), longer.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << result.err;
  };
  render(kAuto, {"mp4", "csv"}, longer);
  const std::string whole = text("mp4"), still = folder_.file("still.png");
  // Frame 12 lies where the speed changes.
  const double t = table_of(text("csv"))[12][0];
  run({"render", file("yaml"), "--frames", "12:13", "-o", folder_.file("f_000000.png")});
  run({"snapshot", file("yaml"), "--at", format_shortest(t), "-o", still});
  EXPECT_EQ(read_png(folder_.file("f_000012.png")).bgra, read_png(still).bgra);
  for (const char* shard : {"1/2", "2/2"}) run({"render", file("yaml"), "--shard", shard, "-o", folder_.file("part.mp4")});
  std::vector<std::string> join{"join", "-o", folder_.file("joined.mp4"), "--quiet"};
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    if (entry.path().filename().string().starts_with("part.")) join.push_back(entry.path().string());
  const ProgramResult joined = run_program(join);
  ASSERT_EQ(joined.status, 0) << joined.err;
  EXPECT_TRUE(read_whole_file(folder_.file("joined.mp4")) == whole);
}

TEST_F(SlowMotionFilm, ByItselfIsThatOfAllPanelsButNotOfThoseThatGoWild) {
  // The second falls slower: through -0.5 m at 0.85 s.
  const Json both = render("compare: [{title: a}, {title: b, gravity: [0, -1.384083045, 0]}]\n", {"gif"},
                           {"--set", "duration=1", "--set", "events=[{when: \"q2 < -0.5\", name: half}]"});
  ASSERT_EQ(both["slow_motion"].size(), 2u) << both["slow_motion"].dump();
  EXPECT_NEAR(both["slow_motion"][1]["from"].get<double>(), 0.75, 1e-8);
  EXPECT_EQ(both["slow_motion"][1]["because"], "'half'");
  const Json wild = render("compare: [{title: a, events: []}, {title: b, torque: [0, \"1e6 * q2 * abs(q2)\"], expect: diverge}]\n", {"gif"});
  EXPECT_EQ(wild.at("slow_motion"), Json::array()) << wild["slow_motion"].dump();
  EXPECT_EQ(wild["drawn"]["frames"], 30);
}

TEST_F(SlowMotionFilm, ByItselfIsNotWhereNoWordsCanSaySo) {
  const auto frames = [&](const std::string& more) {
    return Json::parse(run_program({"check", scene(more), "--json"}).out)["cost"]["frames"].get<int>();
  };
  EXPECT_EQ(frames("layout: transparent\n"), 30);
  EXPECT_GT(frames("layout: transparent\nslow_motion: {}\n"), 30) << "unless it is asked for";
  EXPECT_GT(frames(kAuto), 30);
}

// One instant is told everywhere: the last frame stands there, too.
TEST(FilmsThatStopAtALimit, EndAtItsInstant) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("stop.yaml", "model: {links: [0.5, 0.4], masses: [1, 1], efforts: 1}\ntorque: [0, '2.3 * t']\nduration: 2\nlimit: stop\nmethod: rk4\nstep: 0.001\nslow_motion: none\n");
  const PreparedFilm film = load_film(scene, {}, false, true);
  const Runs runs(film);
  ASSERT_EQ(runs[0].status, RunStatus::stopped);
  EXPECT_NEAR(runs[0].end_time, 1 / 2.3, 1e-9) << "s: where 2.3 t is 1";
  const Fonts fonts;
  const Film pictures = runs.pictures(runs.frames_shown(int(runs.times().size())), fonts);
  const std::string words = test::words_of(pictures.frame(pictures.frame_count() - 1));
  EXPECT_THAT(words, HasSubstr("t = 0.43 s")) << "not 0.45 s, where frame 27 would be";
}

TEST(OwnSlowMotionOfScenes, IsWhereLinksTurnTooFastAndNowhereElse) {
  const auto checked = [](const std::string& scene, const std::vector<std::string>& options = {}) {
    std::vector<std::string> command{"check", "assets/scenes/" + scene + ".yaml", "--json"};
    for (const std::string& option : options) command.insert(command.end(), {"--set", option});
    return Json::parse(run_program(command).out);
  };
  for (const char* calm : {"rr_free", "rr_torque", "pp_free", "pen", "euler_gains_energy"}) {
    const Json json = checked(calm);
    EXPECT_EQ(json.at("slow_motion"), Json::array()) << calm;
  }
  EXPECT_EQ(checked("rr_free")["cost"]["frames"], 600);
  // Nearly all of it is too fast: slow where that begins, and two seconds longer than the motion of five.
  const Json fast = checked("rrr_torque");
  ASSERT_EQ(fast["slow_motion"].size(), 1u);
  EXPECT_LT(fast["slow_motion"][0]["from"].get<double>(), 0.5);
  EXPECT_EQ(fast["cost"]["frames"], 420);
  EXPECT_EQ(fast["slow_motion"][0]["because"], "a link turns more than 15 degrees a frame");
  EXPECT_EQ(checked("rrr_torque", {"slow_motion=none"}).at("slow_motion"), Json::array());
  EXPECT_EQ(checked("rrr_torque", {"slow_motion={turn: 90deg}"}).at("slow_motion"), Json::array());
  // A whirl of a few frames: so it is shown, of ten seconds where that is asked for.
  EXPECT_EQ(checked("rrr_free")["slow_motion"], Json::array());
  EXPECT_GT(checked("rrr_free", {"slow_motion={turn: 15deg}"})["slow_motion"].size(), 2u);
  EXPECT_EQ(checked("rrr_free", {"duration=5", "method=dop853", "start={q: [90deg, -90deg, -30deg]}", "constraints=[{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}, {line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]"})["slow_motion"].size(), 1u);
  // Where constraints lose rank the motion may go on in two ways.
  const Json singular = checked("four_bar_singular")["slow_motion"];
  ASSERT_GE(singular.size(), 1u);
  EXPECT_THAT(singular[0]["because"].get<std::string>(), HasSubstr("'constraints lose rank'"));
  EXPECT_LT(singular[0]["from"].get<double>(), 0.39) << "s: that of the first such pose";
}

}  // namespace
}  // namespace chainreel
