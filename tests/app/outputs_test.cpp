// What `render`, `snapshot`, `ellipse` and `extract` write, read again by others than the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "app/film/clip_memory.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "encode/png.hpp"
#include "support/picture_compare.hpp"
#include "scene/text/scene_paths.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// 0.2 s in five small frames.
const std::vector<std::string> kTiny{"--quiet",      "--set",           "video.width=160",
                                     "--set",        "video.height=90", "--set",
                                     "video.fps=25", "--set",           "duration=0.2"};

ProgramResult render(const std::vector<std::string>& more, const std::string& scene = "rr_torque") {
  std::vector<std::string> command{"render", "assets/scenes/" + scene + ".yaml"};
  command.insert(command.end(), kTiny.begin(), kTiny.end());
  command.insert(command.end(), more.begin(), more.end());
  return run_program(command);
}

std::size_t rows_of(const std::string& text) {
  return std::size_t(std::count(text.begin(), text.end(), '\n'));
}

// Every output of one scene, in one pass; made once for the tests that look at it.
class OnePass : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const std::vector<std::string> files{"a.mp4", "b.webm", "c.mov", "d.gif", "e.apng",
                                         "f.png", "g.svg",  "h.pdf", "i.csv", "frames/k_000000.png"};
    std::vector<std::string> more;
    for (const std::string& file : files) more.insert(more.end(), {"-o", folder_->file(file)});
    result_ = render(more);
  }
  static void TearDownTestSuite() { delete folder_; }
  void SetUp() override { ASSERT_EQ(result_.status, 0) << result_.err; }

  static std::string file(const std::string& name) { return folder_->file(name); }

  static TemporaryFolder* folder_;
  static ProgramResult result_;
};
TemporaryFolder* OnePass::folder_ = nullptr;
ProgramResult OnePass::result_;

TEST_F(OnePass, LeavesWhatWasNamedAndItsSidecarsAlone) {
  EXPECT_THAT(names_in(folder_->path()),
              ElementsAre("a.json", "a.mp4", "a.txt", "b.json", "b.txt", "b.webm", "c.json", "c.mov", "c.txt",
                          "d.gif", "d.json", "d.txt", "e.apng", "e.json", "e.txt", "f.png", "frames", "g.svg",
                          "h.pdf", "i.csv"));
  EXPECT_THAT(names_in(folder_->path() / "frames"),
              ElementsAre("k.json", "k.tex", "k.txt", "k_000000.png", "k_000001.png", "k_000002.png",
                          "k_000003.png", "k_000004.png"));
}

TEST_F(OnePass, ClipsShowTheFramesOfTheSequence) {
  const Image first = read_png(file("frames/k_000000.png")), last = read_png(file("frames/k_000004.png"));
  ASSERT_GT(compare_pictures(first, last).mean, 0.2);  // it moves
  struct Row {
    const char* name;
    const char* codec;
    const char* pixel_format;
    double mean;
  };
  for (const Row& row : {Row{"a.mp4", "h264", "yuv420p", 3}, Row{"b.webm", "vp9", "yuv420p", 4},
                         Row{"c.mov", "prores", "yuv444p12le", 1}, Row{"d.gif", "gif", "bgra", 1},
                         Row{"e.apng", "apng", "rgb24", 0}}) {
    const VideoFacts facts = probe_video(file(row.name));
    EXPECT_EQ(facts.codec, row.codec);
    EXPECT_EQ(facts.pixel_format, row.pixel_format) << row.name;
    EXPECT_EQ(facts.frames, 5) << row.name;
    EXPECT_EQ(facts.width, 160);
    EXPECT_EQ(facts.height, 90);
    EXPECT_EQ(facts.fps, (Ratio{25, 1})) << row.name;
    // Small letters are all edges: what codecs lose there is bounded by the mean.
    EXPECT_LE(compare_pictures(facts.first, first).mean, row.mean) << row.name;
    EXPECT_LE(compare_pictures(facts.last, last).mean, row.mean) << row.name;
    if (std::string_view(row.codec) != "gif" && std::string_view(row.codec) != "apng") {
      for (const std::string& tag : {facts.primaries, facts.transfer, facts.matrix}) EXPECT_EQ(tag, "bt709");
      // ProRes has no mark of its own for it, and readers from FFmpeg 7 on say so.
      if (std::string_view(row.codec) != "prores" || facts.range != "unknown") {
        EXPECT_EQ(facts.range, "tv") << row.name;
      }
    }
  }
  // But for words that fade in films: the very picture of `snapshot`.
  EXPECT_LE(compare_pictures(read_png(file("f.png")), first).mean, 1);
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(with(with({"snapshot", "assets/scenes/rr_torque.yaml", "--at", "0"}, kTiny), {"-o", folder.file("f.png")})).status, 0);
  EXPECT_EQ(read_png(file("f.png")).bgra, read_png(folder.file("f.png")).bgra);
}

TEST_F(OnePass, VectorPagesHaveTheirWordsAndTheirPicture) {
  const ProgramResult words = run_command({"pdftotext", file("h.pdf"), "-"});
  ASSERT_EQ(words.status, 0) << words.err;
  EXPECT_THAT(words.out, HasSubstr("t = 0.00 s"));
  EXPECT_THAT(read_whole_file(file("g.svg")), HasSubstr("t = 0.00 s"));
  // At the size of the pixels, both show what they show but for edges and hinting.
  const Image first = read_png(file("f.png"));
  ASSERT_EQ(
      run_command({"rsvg-convert", "-w", "160", "-h", "90", file("g.svg"), "-o", file("frames/svg.png")})
          .status,
      0);
  EXPECT_LT(compare_pictures(read_png(file("frames/svg.png")), first).mean, 3);
  ASSERT_EQ(run_command({"pdftocairo", "-png", "-singlefile", "-scale-to-x", "160", "-scale-to-y", "90",
                         file("h.pdf"), file("frames/pdf")})
                .status,
            0);
  EXPECT_LT(compare_pictures(read_png(file("frames/pdf.png")), first).mean, 3);
  EXPECT_GT(compare_pictures(Image(160, 90), first).mean, 30);  // negative control
  fs::remove(file("frames/svg.png"));
  fs::remove(file("frames/pdf.png"));
}

TEST_F(OnePass, TheTableHasARowAFrame) {
  const std::string table = read_whole_file(file("i.csv"));
  EXPECT_THAT(table, testing::StartsWith("t [s],q1 [rad],q2 [rad],qd1 [rad/s],qd2 [rad/s],tau1 [N m],"));
  EXPECT_EQ(rows_of(table), 7u) << "head, frames, and the end of the motion";
  EXPECT_THAT(table, HasSubstr("\n0.2,"));
}

TEST_F(OnePass, EveryKindOfFileRemembersTheScene) {
  const ClipMemory first = recall(file("a.mp4"));
  EXPECT_THAT(first.scene, HasSubstr("method: semi_implicit_euler"));
  EXPECT_THAT(first.scene, HasSubstr("width: 160"));
  EXPECT_THAT(first.scene, HasSubstr("model: \"../../models/rr.urdf\""));
  EXPECT_EQ(first.audit["frames"], 5);
  EXPECT_EQ(first.audit["trajectory_sha256"],
            Json::parse(read_whole_file(file("a.json")))["trajectory_sha256"]);
  EXPECT_FALSE(first.audit.contains("seconds"));
  for (const char* name : {"b.webm", "c.mov", "d.gif", "e.apng", "f.png", "g.svg", "h.pdf", "frames/k_000000.png"}) {
    ClipMemory memory = recall(file(name));
    EXPECT_EQ(memory.scene, first.scene) << name;
    EXPECT_EQ(memory.audit.erase("at"), name[1] == '.' && name[0] > 'e' ? 1u : 0u) << name << ": the instant of pictures";
    EXPECT_EQ(memory.audit, first.audit) << name;
  }
}

TEST_F(OnePass, TheExtractedSceneGivesTheSameFilesAgain) {
  for (const char* name : {"a.mp4", "d.gif", "h.pdf", "g.svg", "f.png"}) {
    const TemporaryFolder again;
    const std::string scene = again.file("deep/scene.yaml");
    ASSERT_EQ(run_program({"extract", file(name), "-o", scene}).status, 0);
    const ProgramResult result = run_program(
        {"render", scene, "--quiet", "-o", again.file("x.mp4"), "-o", again.file("k_000000.png")});
    ASSERT_EQ(result.status, 0) << result.err;
    for (int k = 0; k < 5; ++k) {
      const std::string frame = "k_00000" + std::to_string(k) + ".png";
      EXPECT_EQ(read_png(again.file(frame)).bgra, read_png(file("frames/" + frame)).bgra) << name << k;
    }
    EXPECT_EQ(recall(again.file("x.mp4")).audit["trajectory_sha256"],
              recall(file("a.mp4")).audit["trajectory_sha256"]);
  }
  // Negative control: a scene that differs gives other frames.
  const TemporaryFolder again;
  ASSERT_EQ(run_program({"extract", file("a.mp4"), "-o", again.file("s.yaml")}).status, 0);
  ASSERT_EQ(run_program({"render", again.file("s.yaml"), "--quiet", "--set", "torque.1=3", "-o",
                         again.file("k_000000.png")})
                .status,
            0);
  EXPECT_NE(read_png(again.file("k_000004.png")).bgra, read_png(file("frames/k_000004.png")).bgra);
}

TEST_F(OnePass, ToStandardOutputTheSceneIsMeantForTheWorkingFolder) {
  const ProgramResult result = run_program({"extract", file("c.mov")});
  EXPECT_EQ(result.out, moved_scene_text(recall(file("c.mov")).scene, "", "assets/scenes"));
  EXPECT_EQ(result.err, "");
  const Json json = Json::parse(run_program({"extract", file("c.mov"), "--json"}).out);
  EXPECT_EQ(json["scene"], result.out);
  EXPECT_EQ(json["audit"]["frames"], 5);
}

TEST_F(OnePass, ItIsSaidInWords) {
  const std::string words = read_whole_file(file("a.txt"));
  for (const char* part : {"the chain ", "2 freedoms", "0.2 s", "5 frames", "at rest", "Units"})
    EXPECT_THAT(words, HasSubstr(part));
  EXPECT_EQ(words, read_whole_file(file("b.txt")));
  EXPECT_THAT(read_whole_file(file("frames/k.tex")),
              HasSubstr("\\animategraphics[autoplay,loop,width=\\linewidth]{25}{frames/k_}{000000}{000004}"));
}

TEST(Outputs, AnOverlayHasStraightOpacityAndNoWords) {
  const TemporaryFolder folder;
  const ProgramResult result =
      render({"--preset", "overlay", "-o", folder.file("a.mov"), "-o", folder.file("a.webm"), "-o",
              folder.file("a_000000.png"), "-o", folder.file("a.svg"), "-o", folder.file("a.apng"), "--set", "draw=[-torque]"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Image png = read_png(folder.file("a_000000.png"));
  EXPECT_EQ(png.at(2, 2).a, 0);
  EXPECT_EQ(png.at(157, 88).a, 0);  // no time
  int opaque = 0, soft = 0;
  for (std::size_t i = 3; i < png.bgra.size(); i += 4) {
    opaque += png.bgra[i] == 255;
    soft += png.bgra[i] > 0 && png.bgra[i] < 255;
  }
  EXPECT_GT(opaque, 50);
  EXPECT_GT(soft, 50);
  for (const char* name : {"a.mov", "a.webm", "a.apng"}) {
    const VideoFacts facts = probe_video(folder.file(name));
    EXPECT_EQ(facts.frames, 5);
    EXPECT_THAT(facts.pixel_format, testing::AnyOf("yuva444p12le", "yuva420p", "rgba")) << name;
    for (const int level : {0, 128, 255})
      EXPECT_LE(compare_pictures(over(facts.first, level), over(png, level)).mean, 2.5) << name << level;
  }
  const std::string svg = read_whole_file(folder.file("a.svg"));
  EXPECT_THAT(svg, Not(HasSubstr("<text")));
  // Neither have the arcs of its torques.
  ASSERT_EQ(render({"--preset", "overlay", "-o", folder.file("arcs.svg")}).status, 0);
  const std::string arcs = read_whole_file(folder.file("arcs.svg"));
  EXPECT_THAT(arcs, Not(HasSubstr("<text")));
  EXPECT_GT(arcs.size(), svg.size());
  // Laid on white it is the picture on a white page, to the rounding of colours times opacity.
  ASSERT_EQ(render({"-o", folder.file("w_000000.png"), "--layout", "scene", "--set", "draw=[chain, trail]"}).status, 0);
  const Image white = read_png(folder.file("w_000000.png"));
  EXPECT_TRUE(pictures_agree(over(png, 255), white, {.max = 3, .mean = 0.05}, "overlay_on_white"));
  EXPECT_FALSE(pictures_agree(over(png, 250), white, {.max = 3, .mean = 0.05}, "overlay_control"));
}

TEST(Outputs, HeldFramesAreCountedAndShown) {
  const TemporaryFolder folder;
  ASSERT_EQ(render({"--hold", "{first: 0.08, last: 0.2}", "-o", folder.file("a.mp4"), "-o",
                    folder.file("a_000000.png"), "-o", folder.file("a.csv")})
                .status,
            0);
  const VideoFacts facts = probe_video(folder.file("a.mp4"));
  EXPECT_EQ(facts.frames, 5 + 2 + 5);
  EXPECT_TRUE(facts.regular);
  const auto frame = [&](int k) {
    return read_png(folder.file("a_0000" + std::string(k < 10 ? "0" : "") + std::to_string(k) + ".png")).bgra;
  };
  EXPECT_EQ(frame(0), frame(1));
  EXPECT_EQ(frame(1), frame(2));
  EXPECT_NE(frame(2), frame(3));
  EXPECT_EQ(frame(6), frame(11));
  EXPECT_NE(frame(5), frame(6));
  const Json audit = Json::parse(read_whole_file(folder.file("a.json")));
  EXPECT_EQ(audit["frames"], 12);
  EXPECT_EQ(audit["held_frames"], (Json{{"first", 2}, {"last", 5}}));
  EXPECT_EQ(audit["film_seconds"], 0.48);
  EXPECT_EQ(audit["duration"], 0.2);
  EXPECT_EQ(rows_of(read_whole_file(folder.file("a.csv"))), 7u);  // the motion alone
}

TEST(Outputs, PresetsNameTheirFiles) {
  const auto files_of = [](const std::string& preset) {
    const TemporaryFolder folder;
    EXPECT_EQ(render({"--preset", preset, "-o", folder.file("x") + "/"}).status, 0) << preset;
    std::vector<std::string> names = names_in(folder.path() / "x");
    std::erase_if(names,
                  [](const std::string& name) { return name.ends_with(".json") || name.ends_with(".txt"); });
    return names;
  };
  EXPECT_THAT(files_of("slides"), ElementsAre("rr_torque.mp4"));
  EXPECT_THAT(files_of("web"), ElementsAre("rr_torque.png", "rr_torque.webm"));
  EXPECT_THAT(files_of("doc"), ElementsAre("rr_torque.gif"));
  EXPECT_THAT(files_of("frames"), ElementsAre("rr_torque_frames"));
  EXPECT_THAT(files_of("still"), ElementsAre("rr_torque.pdf", "rr_torque.png", "rr_torque.svg"));
  EXPECT_THAT(files_of("overlay"), ElementsAre("rr_torque.mov", "rr_torque.webm"));
}

// Where a GIF has other frames than were drawn, the audit beside it begins with its own.
TEST(Outputs, AuditsBeginWithTheFirstClip) {
  const TemporaryFolder folder;
  const auto audits = [&](const Words& files) {
    Words words{"render", "assets/scenes/rr_torque.yaml", "--set", "video.width=1000", "--set", "video.height=500", "--set", "video.fps=60",
                "--set", "duration=0.2", "--force", "--json"};
    for (const std::string& file : files) words = with(words, {"-o", folder.file(file)});
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(result.out)["films"][0];
  };
  const auto beside = [&](const char* name) { return Json::parse(read_whole_file(folder.file(name))); };
  const auto expect_clip = [&](const Json& audit, const char* clip) {
    const VideoFacts facts = probe_video(folder.file(clip));
    EXPECT_EQ(audit["frames"], facts.frames) << clip;
    EXPECT_EQ(audit["width"], facts.width) << clip;
    EXPECT_EQ(audit["height"], facts.height) << clip;
    EXPECT_EQ(audit["fps"].get<double>() * facts.fps.den, facts.fps.num) << clip;
    EXPECT_NEAR(audit["film_seconds"].get<double>() * audit["fps"].get<double>(), facts.frames, 1e-12) << "round-off of one quotient";
  };
  const Json gif_alone = audits({"a.gif"});
  expect_clip(gif_alone, "a.gif");
  expect_clip(beside("a.json"), "a.gif");
  EXPECT_EQ(gif_alone["frames"], 4) << "every third of twelve";
  EXPECT_EQ(gif_alone["drawn"]["frames"], 12);

  // Of other files that lie there already the audit tells on, as they show the same.
  const Json film_beside = audits({"a.mp4"});
  expect_clip(film_beside, "a.mp4");
  EXPECT_FALSE(film_beside.contains("drawn"));
  const Json both = beside("a.json");
  ASSERT_EQ(both["outputs"].size(), 2u) << both;
  for (const Json& one : both["outputs"]) expect_clip(one, one["file"].get<std::string>().c_str());

  // Two names: the report's is the first clip's, each audit's that beside it. Pictures and tables come in between.
  expect_clip(audits({"p.png", "c.csv", "b.gif", "d.mp4"}), "b.gif");
  expect_clip(beside("b.json"), "b.gif");
  expect_clip(beside("d.json"), "d.mp4");
  expect_clip(audits({"d.mp4", "b.gif"}), "d.mp4");
  expect_clip(beside("b.json"), "b.gif");
}

// What an audit tells of, by name, size and hash; who has a film of the same name made again as something else is told.
TEST(Outputs, AreInTheirAuditWithSizeAndHash) {
  const TemporaryFolder folder;
  ASSERT_EQ(render({"-o", folder.file("a.mp4"), "-o", folder.file("a.gif")}).status, 0);
  const auto outputs = [&] { return Json::parse(read_whole_file(folder.file("a.json")))["outputs"]; };
  ASSERT_EQ(outputs().size(), 2u);
  for (const Json& one : outputs()) {
    const std::string path = folder.file(one["file"]);
    EXPECT_EQ(one["sha256"], sha256_of_file(path));
    EXPECT_EQ(one["bytes"], std::filesystem::file_size(path));
  }
  const Json small = outputs()[1];
  EXPECT_EQ(small["frames"], probe_video(folder.file("a.gif")).frames);
  EXPECT_EQ(Json::parse(read_whole_file(folder.file("a.json")))["drawn"], Json()) << "the film is no smaller than its frames";

  const Words again{"render", "assets/scenes/rr_torque.yaml", "--set", "video.width=160", "--set", "video.height=90", "--set", "video.fps=25",
                    "--set", "duration=0.2", "-o", folder.file("a.gif"), "--force"};
  const ProgramResult same = run_program(again);
  EXPECT_THAT(same.err, Not(HasSubstr("told of")));
  EXPECT_EQ(outputs().size(), 2u) << "both show the same";
  const ProgramResult other = run_program(with(again, {"--set", "video.width=320"}));
  EXPECT_THAT(other.err, HasSubstr("a.json tells of " + folder.file("a.mp4") + ", which is still there and shows something else: " +
                                   folder.file("a.gif.json")));
  ASSERT_EQ(outputs().size(), 1u);
  EXPECT_EQ(outputs()[0]["file"], "a.mp4") << "no more of the other one";
  EXPECT_EQ(Json::parse(read_whole_file(folder.file("a.gif.json")))["outputs"][0]["sha256"], sha256_of_file(folder.file("a.gif")));
  // Both pass, and both are told of by what was written with them.
  for (const char* file : {"a.mp4", "a.gif", "a.gif.json", "a.json"}) {
    const ProgramResult check = run_program({"check", folder.file(file)});
    EXPECT_EQ(check.status, 0) << file << check.out << check.err;
  }
  // A film made again keeps its own, whatever it shows now.
  EXPECT_EQ(run_program(again).status, 0);
  EXPECT_EQ(run_program({"check", folder.file("a.gif")}).status, 0);
  EXPECT_EQ(outputs().size(), 1u);
}

TEST(Outputs, SeveralOfAnotherFilmsNameHaveAuditsOfTheirOwn) {
  const TemporaryFolder folder;
  ASSERT_EQ(render({"-o", folder.file("a.mp4")}).status, 0);
  const ProgramResult two = render({"-o", folder.file("a.gif"), "-o", folder.file("a.webm"), "--set", "duration=0.3", "--force"});
  ASSERT_EQ(two.status, 0) << two.err;
  for (const char* film : {"a.mp4", "a.gif", "a.webm"}) {
    const ProgramResult check = run_program({"check", folder.file(film)});
    EXPECT_EQ(check.status, 0) << film << check.err;
  }
  // What takes over an audit all the same is a warning, however quiet.
  const ProgramResult frames = render({"-o", folder.file("a_000000.png"), "--set", "duration=0.3", "--force", "--quiet"});
  EXPECT_THAT(frames.err, HasSubstr("WARNING: " + folder.file("a.json") + " told of " + folder.file("a.mp4")));
}

TEST(Outputs, StillsShowTheInstantThatIsAskedForAsSnapshotsDo) {
  const TemporaryFolder folder;
  ASSERT_EQ(render({"--at", "0.12", "-o", folder.file("a.png"), "-o", folder.file("a_000000.png")}).status,
            0);
  EXPECT_THAT(render({"--at", "0.3", "-o", folder.file("b.png")}).err,
              HasSubstr("lies outside the duration"));
  // Between frames, and behind the last one: the instant itself, as `snapshot` has it.
  const Words scene{"assets/scenes/rr_torque.yaml", "--quiet", "--force", "--set", "video.width=160", "--set", "video.height=90", "--set", "video.fps=25",
                    "--set", "duration=0.2"};
  const auto picture = [&](const std::string& command, const std::string& t) {
    EXPECT_EQ(run_program(with(with({command}, scene), {"--at", t, "-o", folder.file("c.png")})).status, 0);
    return read_png(folder.file("c.png")).bgra;
  };
  for (const char* t : {"0.12", "0.13", "0.2"}) EXPECT_TRUE(picture("render", t) == picture("snapshot", t)) << t;
  EXPECT_NE(picture("render", "0.12"), picture("render", "0.13"));
}

TEST(Outputs, SnapshotsAndEllipsesAreVectorPages) {
  const TemporaryFolder folder;
  for (const std::string ending : {"svg", "pdf", "png"}) {
    const std::string file = folder.file("s." + ending);
    ASSERT_EQ(run_program({"snapshot", "assets/scenes/rr_torque.yaml", "--quiet", "--at", "0.1", "-o", file,
                           "--set", "duration=0.2", "--set", "video.width=640", "--set", "video.height=360"})
                  .status,
              0);
    EXPECT_EQ(recall(file).audit["at"], 0.1);
    EXPECT_THAT(recall(file).scene, HasSubstr("duration: 0.2"));
    ASSERT_EQ(run_program({"ellipse", "models/rr.urdf", "--quiet", "--pose", "0,90deg", "-o",
                           folder.file("e." + ending)})
                  .status,
              0);
  }
  EXPECT_THAT(run_command({"pdftotext", folder.file("s.pdf"), "-"}).out, HasSubstr("t = 0.10 s"));
  EXPECT_THAT(run_command({"pdftotext", folder.file("e.pdf"), "-"}).out, HasSubstr("kg"));
  EXPECT_THAT(read_whole_file(folder.file("e.svg")), HasSubstr("<text"));
  ASSERT_EQ(run_command({"rsvg-convert", "-w", "1920", "-h", "1080", folder.file("e.svg"), "-o",
                         folder.file("again.png")})
                .status,
            0);
  EXPECT_LT(compare_pictures(read_png(folder.file("again.png")), read_png(folder.file("e.png"))).mean, 1);
  const ProgramResult bad =
      run_program({"ellipse", "models/rr.urdf", "--pose", "0,0", "-o", folder.file("e.eps")});
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr(".png, .svg or .pdf, their numbers as .csv, .json or .npz"));
}

// A figure of a model says what made it, so does a sheet; what it says makes it again.
TEST(Outputs, FiguresRememberTheirCommand) {
  const TemporaryFolder folder;
  const std::vector<std::string> figures[] = {
      {"ellipse", "models/rr.urdf", "--pose", "0,90deg", "--pose", "-1,0", "--theme", "dark", "--title", "Two of it's"},
      {"ellipse", "models/rr.urdf", "--field", "--samples", "5"},
      {"snapshot", "models/rr.urdf", "--pose", "0,90deg", "--text-scale", "1.5"},
      {"sheet", "assets/scenes/rr_free.yaml", "assets/scenes/pp_free.yaml", "--at", "0.5", "--set", "draw=[chain]"}};
  for (const std::vector<std::string>& words : figures)
    for (const std::string ending : {"png", "svg", "pdf"}) {
      std::vector<std::string> command = words;
      const std::string file = folder.file("e." + ending);
      command.insert(command.end(), {"--width", "640", "--height", "360", "--quiet", "-o", file, "--force"});
      ASSERT_EQ(run_program(command).status, 0);
      const ProgramResult said = run_program({"extract", file});
      ASSERT_EQ(said.status, 0) << said.err;
      EXPECT_THAT(said.out, testing::StartsWith("chainreel " + words[0] + " " + words[1] + " "));
      const Json figure = Json::parse(run_program({"extract", file, "--json"}).out)["figure"];
      if (words[0] != "sheet") {
        EXPECT_EQ(figure["model"], "models/rr.urdf");
        EXPECT_GE(figure["poses"].size(), 1u);
      }
      std::vector<std::string> again = figure["arguments"].get<std::vector<std::string>>();
      again.insert(again.end(), {"--quiet", "-o", folder.file("again." + ending), "--force"});
      ASSERT_EQ(run_program(again).status, 0);
      EXPECT_EQ(read_whole_file(folder.file("again." + ending)), read_whole_file(file)) << said.out;
    }
  EXPECT_THAT(run_program({"extract", folder.file("e.png"), "-o", folder.file("x.yaml")}).err,
              HasSubstr("is a figure, not a scene; it was made by: chainreel sheet"));
}

// An instant between two frames belongs to the picture, not to the film.
TEST(Outputs, SnapshotsTellTheFramesOfTheirFilm) {
  const TemporaryFolder folder;
  const std::string small = "video: {width: 320, height: 180, fps: 10}\ntext_scale: 1.5\nduration: 1\n";
  const std::string rr = "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\n" + small;
  const std::pair<std::string, std::string> scenes[] = {
      {"plain", rr},
      {"held", rr + "hold: {first: 0.5, last: 1}\n"},
      {"stops", rr + "events: [{when: \"t > 0.55\", kind: stop}]\n"},
      {"stops_late", rr + "events: [{when: \"t > 0.95\", kind: stop}]\n"}};
  for (const auto& [name, text] : scenes) {
    const std::string scene = folder.write(name + ".yaml", text), film = folder.file(name + ".mp4");
    ASSERT_EQ(run_program({"render", scene, "--quiet", "-o", film}).status, 0);
    const Json rendered = recall(film).audit;
    for (const std::string at : {"0.2", "0.25", "0.55", "0.98"}) {
      const std::string still = folder.file(name + at + ".png");
      ASSERT_EQ(run_program({"snapshot", scene, "--quiet", "--at", at, "-o", still}).status, 0) << name << at;
      const Json audit = recall(still).audit;
      EXPECT_EQ(audit["frames"], rendered["frames"]) << name << " at " << at;
      EXPECT_EQ(audit["film_seconds"], rendered["film_seconds"]) << name << " at " << at;
    }
  }
}

TEST(Outputs, ACommandLineIsQuotedForTheShell) {
  EXPECT_EQ(command_line({{"arguments", {"ellipse", "a.urdf", "--title", "It's two", "--pose", "-1,0"}}}),
            "chainreel ellipse a.urdf --title 'It'\\''s two' --pose -1,0");
}

TEST(Outputs, WhatCannotBeWrittenIsSaidBeforeTheRun) {
  const TemporaryFolder folder;
  const auto trouble = [&](const std::vector<std::string>& more) {
    const ProgramResult result = render(more);
    EXPECT_NE(result.status, 0);
    return result.err;
  };
  EXPECT_THAT(trouble({"-o", folder.file("a.avi")}),
              HasSubstr("no output has that ending; there are .mp4, .webm"));
  EXPECT_THAT(trouble({"-o", folder.file("a.mp4"), "-o", folder.file("a.mp4")}), HasSubstr("named twice"));
  EXPECT_THAT(trouble({"-o", folder.file("x") + "/", "-o", folder.file("a.mp4")}),
              HasSubstr("either one folder or files"));
  EXPECT_THAT(trouble({"--preset", "slide", "-o", folder.file("a.mp4")}),
              HasSubstr("'video.preset' must be slides, web, overlay, doc, frames or still, not 'slide': did you mean 'slides'?"));
  EXPECT_THAT(trouble({"--preset", "overlay", "-o", folder.file("a.mp4")}),
              HasSubstr("a transparent background cannot be written there"));
  // Of what would be a film without its background in part.
  for (const char* name : {"a.gif", "a.mp4"}) {
    const ProgramResult result = render({"--layout", "transparent", "-o", folder.file(name)});
    EXPECT_EQ(result.status, 2) << name;
    EXPECT_THAT(result.err, HasSubstr(std::string(name) + ": a transparent background cannot be written there"));
  }
  EXPECT_THAT(trouble({"--crf", "60", "-o", folder.file("a.webm"), "-o", folder.file("a.mp4")}),
              HasSubstr("must be from 0 to 51"));
  EXPECT_THAT(trouble({"--crf", "64", "-o", folder.file("a.webm")}),
              HasSubstr("'video.crf' must lie between"));
  EXPECT_THAT(trouble({"--set", "video.width=161", "-o", folder.file("a.gif")}),
              HasSubstr("take 160 or 162"));
  EXPECT_THAT(trouble({"--hold", "{first: -1}", "-o", folder.file("a.gif")}),
              HasSubstr("'hold.first' must lie"));
  EXPECT_THAT(trouble({"--hold", "{frist: 1}", "-o", folder.file("a.gif")}),
              HasSubstr("The keys here are first, last."));
  EXPECT_THAT(names_in(folder.path()), IsEmpty());
  // One of several targets is there already: none is touched.
  folder.write("b.csv", "mine");
  EXPECT_THAT(trouble({"-o", folder.file("b.mp4"), "-o", folder.file("b.csv")}), HasSubstr("exists already"));
  folder.write("seq/b_000007.png", "mine");
  EXPECT_THAT(trouble({"-o", folder.file("seq/b_000000.png")}), HasSubstr("exists already"));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("b.csv", "seq"));
  EXPECT_THAT(names_in(folder.path() / "seq"), ElementsAre("b_000007.png"));
  EXPECT_EQ(read_whole_file(folder.file("b.csv")), "mine");
  // By force old frames go, and what no audit tells of as a frame stays.
  EXPECT_EQ(render({"--force", "-o", folder.file("seq/b_000000.png")}).status, 0);
  EXPECT_EQ(read_whole_file(folder.file("seq/b_000007.png")), "mine");
}

TEST(Outputs, AQualityThatNoFileHasIsSaid) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& file) {
    const ProgramResult result =
        run_program({"render", "assets/scenes/rr_free.yaml", "--crf", "30", "--set", "duration=0.1", "--set",
                     "video.width=160", "--set", "video.height=90", "-o", folder.file(file)});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  EXPECT_THAT(said("a.mov"), HasSubstr("video.crf does nothing"));
  EXPECT_THAT(said("b.mp4"), Not(HasSubstr("video.crf")));
}

TEST(Outputs, SizeAndRateHaveFlags) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.mp4");
  ASSERT_EQ(run_program({"render", "assets/scenes/rr_free.yaml", "--quiet", "--set", "duration=0.2", "--width", "320", "--height", "180", "--fps", "30000/1001", "-o", file}).status, 0);
  const Json audit = Json::parse(read_whole_file(folder.file("a.json")));
  EXPECT_EQ(audit["width"], 320);
  EXPECT_EQ(audit["height"], 180);
  EXPECT_EQ(audit["fps"], "30000/1001");
  EXPECT_EQ(run_program({"check", file, "--today"}).status, 0);
  EXPECT_EQ(run_program({"render", "assets/scenes/rr_free.yaml", "--quiet", "--width", "321", "-o", folder.file("b.mp4")}).status, 3) << "is no even number";
}

// What the captions beside a film hold.
std::string captions_with(const std::vector<std::string>& settings) {
  const TemporaryFolder folder;
  std::vector<std::string> words{"--set", "slow_motion=none", "-o", folder.file("a.gif")};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  EXPECT_EQ(render(words).status, 0);
  return read_whole_file(folder.file("a.srt"));
}

// One may be read: an event a millisecond behind another shares its caption, one half a second behind it has its own.
TEST(Outputs, CaptionsStandForAsLongAsOneReadsThem) {
  EXPECT_EQ(captions_with({"duration=3",
                           "events=[{when: t - 0.5, name: a}, {when: t - 0.501, name: b}, {when: t - 1, name: c}, {when: t - 1.6, name: d}]"}),
            "1\n00:00:00,501 --> 00:00:01,000\na\nb\n\n2\n00:00:01,000 --> 00:00:01,600\nc\n\n3\n00:00:01,600 --> 00:00:03,000\nd\n\n");
}

// Nothing is told before it happens, and words that the film stands still for stand as long as it does.
TEST(Outputs, CaptionsFollowTheFilm) {
  EXPECT_EQ(captions_with({"duration=4", "events=[{when: t - 0.5, name: a}, {when: t - 0.7, name: b}]",
                           "annotate=[{at: 1.5s, text: held, point: gripper, hold: 3s}]"}),
            "1\n00:00:00,500 --> 00:00:00,700\na\n\n2\n00:00:00,700 --> 00:00:01,500\na\nb\n\n3\n00:00:01,500 --> 00:00:04,600\nheld\n\n");
  // Words that hold nothing stand for two seconds of the film, whatever comes meanwhile, as in the picture.
  EXPECT_EQ(captions_with({"duration=4", "events=[{when: t - 1, name: low}]",
                           "annotate=[{at: 0.3s, text: one, point: [0.5, 0.5], hold: 0s}, {at: 1s, text: two, point: gripper, hold: 1s}]"}),
            "1\n00:00:00,300 --> 00:00:01,000\none\n\n2\n00:00:01,000 --> 00:00:02,100\none\nlow\ntwo\n\n"
            "3\n00:00:02,100 --> 00:00:02,300\none\nlow\n\n4\n00:00:02,300 --> 00:00:03,000\nlow\n\n");
}

// As versions of Cairo write one text: brackets and backslashes behind one, in octal, on a line that goes on, or as pairs.
TEST(Outputs, WordsOfAPdfAreReadInEveryFormOfALiteral) {
  const TemporaryFolder folder;
  for (const char* literal : {R"({"chainreel_scene":"model: \\"a \(b\)\\"\\n","chainreel_audit":{}})",
                              R"({"chainreel_scene":"model: \\"a (b)\\"\\n","chainreel_audit":{}})",
                              "\\173\"chainreel_scene\":\"model: \\134\"a \\050b\\\n\\051\\\\\"\\\\n\",\"chainreel_audit\":{}}"}) {
    const std::string file = folder.write("a.pdf", std::string("%PDF-1.4\n1 0 obj\n<< /Keywords (") + literal + ")\n /Producer (cairo)\n>>\n%%EOF\n");
    EXPECT_EQ(recall(file).scene, "model: \"a (b)\"\n") << literal;
  }
  // In a compressed stream, as newer versions have it: whole, and cut off.
  const std::string objects = "<< /Keywords ({\"chainreel_scene\":\"model: b\\\\n\",\"chainreel_audit\":{}}) >>";
  std::string packed(compressBound(uLong(objects.size())), ' ');
  uLongf size = uLongf(packed.size());
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(objects.data()), uLong(objects.size())), Z_OK);
  const std::string head = "%PDF-1.7\n1 0 obj\n<< /Type /ObjStm /Filter /FlateDecode >>\nstream\n";
  EXPECT_EQ(recall(folder.write("c.pdf", head + packed.substr(0, size) + "\nendstream\n")).scene, "model: b\n");
  EXPECT_THROW(recall(folder.write("d.pdf", head + packed.substr(0, size / 3))), Error);
  EXPECT_THROW(recall(folder.write("b.pdf", "%PDF-1.4\n<< /Keywords ({\\")), Error);
}

// Formulas are nothing without the values of what they read, and nothing else.
TEST(Outputs, WordsTellTheParametersOfTorques) {
  const TemporaryFolder folder;
  ASSERT_EQ(render({"--set", "parameters={k: 12, kk: 5, other: 3}", "--set", "torque=[-k * q1, 2 * k]", "--set", "title=T", "-o", folder.file("a.gif")}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("a.txt")), AllOf(HasSubstr("torques (-k * q1, 2 * k), where k = 12, starting"), Not(HasSubstr("kk = 5")), Not(HasSubstr("other = 3"))));
}

// Behind the last frame nothing is shown: what stands at the very end is told on that.
TEST(Outputs, WordsAtTheVeryEndAreShown) {
  const TemporaryFolder folder;
  const auto picture = [&](const std::string& name, const std::string& words) {
    EXPECT_EQ(render({"--set", "duration=0.2", "--set", "slow_motion=none", "--set", "annotate=[" + words + "]", "-o", folder.file(name)}).status, 0);
    return read_whole_file(folder.file(name));
  };
  EXPECT_NE(picture("a.gif", "{at: 0.2, text: the end, point: gripper}"), picture("b.gif", ""));
}

TEST(Outputs, EventsAreCaptions) {
  const TemporaryFolder folder;
  const ProgramResult result =
      render({"--set", "slow_motion=none", "--set",
              "events=[{when: \"t > 0.05\", name: \"a > b\"}, {when: \"t > 0.15\", name: late}, {when: \"t > "
              "9\", name: never}]",
              "--hold", "{first: 1}", "-o", folder.file("a.mp4"), "-o", folder.file("a.gif")});
  ASSERT_EQ(result.status, 0) << result.err;
  // Times of the film, whose first frame stands for a second: what comes just before its end is told half a second before it.
  EXPECT_EQ(read_whole_file(folder.file("a.srt")), "1\n00:00:00,700 --> 00:00:01,200\na > b\nlate\n\n");
  EXPECT_THAT(read_whole_file(folder.file("a.txt")), HasSubstr("t = 0.050 s: a > b\n  t = 0.150 s: late\n"));
  // None came: no captions.
  ASSERT_EQ(render({"--set", "events=[{when: \"t > 9\", name: never}]", "-o", folder.file("b.mp4")}).status,
            0);
  EXPECT_FALSE(fs::exists(folder.file("b.srt")));
}

TEST(Outputs, AFailingRunLeavesFilmsAndTablesAsPartialAlone) {
  const TemporaryFolder folder;
  const ProgramResult result =
      render({"--set", "torque=[0, -1e6 * (1 + t^8 * 1e6) * y_G]", "--set", "step=0.001", "--set",
              "duration=4", "-o", folder.file("a.mp4"), "-o", folder.file("a.gif"), "-o",
              folder.file("a.png"), "-o", folder.file("a_000000.png"), "-o", folder.file("a.csv")},
             "pp_spring");
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.partial.csv", "a.partial.gif", "a.partial.mp4"));
  EXPECT_LT(probe_video(folder.file("a.partial.mp4")).frames, 100);
  // A table by itself likewise; one that has the name already is said to be another run's.
  const Words failing{"simulate", "assets/scenes/pp_spring.yaml", "--set", "torque=[0, -1e6 * (1 + t^8 * 1e6) * y_G]", "--set", "step=0.001",
                      "--set", "duration=4", "--force", "-o"};
  const std::string table = folder.file("b.csv"), partial = folder.file("b.partial.csv");
  const ProgramResult first = run_program(with(failing, {table}));
  EXPECT_EQ(first.status, 5);
  EXPECT_THAT(first.err, HasSubstr("note: what there is of it: " + partial + "\n"));
  folder.write("b.csv", "older\n");
  EXPECT_THAT(run_program(with(failing, {table})).err,
              HasSubstr("note: what there is of it: " + partial + "; " + table + " is still that of an earlier run\n"));
  EXPECT_EQ(read_whole_file(table), "older\n");
}

TEST(Outputs, ExtractSaysWhatItCannotRead) {
  const TemporaryFolder folder;
  const auto trouble = [&](const std::string& file) {
    const ProgramResult result = run_program({"extract", file});
    EXPECT_EQ(result.status, 3) << file;
    return result.err;
  };
  EXPECT_THAT(trouble(folder.file("none.mp4")), HasSubstr("no such file"));
  EXPECT_THAT(trouble(folder.write("a.mp4", "no film")), HasSubstr("is no film that can be read"));
  EXPECT_THAT(trouble(folder.write("a.pdf", "%PDF-1.5")), HasSubstr("remembers no scene"));
  EXPECT_THAT(trouble(folder.write("b.pdf", "/Keywords <FEFF00")), HasSubstr("remembers no scene"));
  EXPECT_THAT(trouble(folder.write("a.svg", "<svg><metadata>{\"chainreel_scene\": 1}</metadata></svg>")),
              HasSubstr("remembers no scene"));
  EXPECT_THAT(trouble(folder.write("a.gif", "no picture")), HasSubstr("is no GIF"));
  EXPECT_THAT(trouble(folder.write("b.gif", std::string("GIF89a\1\0\1\0\0\0\0\x21\xFE\5wor", 20))),
              HasSubstr("remembers no scene"));
  EXPECT_THAT(trouble(folder.write("a.txt", "words")), HasSubstr("only .mp4"));
}

TEST(Outputs, ExtractTellsOfAModelThatIsGoneOrAnother) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "models");
  fs::copy(fs::path(CHAINREEL_SOURCE_FOLDER) / "models/rr.urdf", folder.path() / "models/rr.urdf");
  folder.write("scene.yaml",
               "model: models/rr.urdf\nduration: 0.1\nmethod: rk4\nvideo: {width: 160, height: 90}\n");
  const RunOptions here{.folder = folder.path().string()};
  ASSERT_EQ(run_program({"render", "scene.yaml", "--quiet", "-o", "a.mp4"}, here).status, 0);
  EXPECT_EQ(run_program({"extract", "a.mp4"}, here).err, "");
  folder.write("models/rr.urdf", read_whole_file(folder.file("models/rr.urdf")) + "\n");
  EXPECT_THAT(run_program({"extract", "a.mp4"}, here).err, HasSubstr("has changed since"));
  fs::remove(folder.path() / "models/rr.urdf");
  EXPECT_THAT(run_program({"extract", "a.mp4"}, here).err,
              HasSubstr("there is no models/rr.urdf here"));
}

}  // namespace
}  // namespace chainreel
