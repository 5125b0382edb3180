// The command line as people use it: help, init, check, doctor, signals, and what the README says.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>

#include "app/cli/last_words.hpp"
#include "app/cli/streams.hpp"
#include "core/json.hpp"
#include "encode/png.hpp"
#include "scene/text/read_scene.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

TEST(Usage, ErrorsAreExitTwo) {
  EXPECT_EQ(run_program({}).status, 2);
  EXPECT_EQ(run_program({"rendr"}).status, 2);
  EXPECT_EQ(run_program({"render"}).status, 2);
  EXPECT_EQ(run_program({"render", "--no-such-flag", "a.yaml"}).status, 2);
}

TEST(Usage, NamesWhatItDidNotExpectInItsOrderAndCommandsThatThereAreNot) {
  EXPECT_THAT(run_program({"simulate", "a", "b", "c", "--foo"}).err, HasSubstr("were not expected: b c --foo"));
  EXPECT_THAT(run_program({"rendr", "a"}).err, HasSubstr("no command 'rendr'"));
  EXPECT_THAT(run_program({}).err, HasSubstr("A subcommand is required"));
  for (const char* command : {"fall", "stability"})
    EXPECT_THAT(run_program({command, "assets/scenes/humanoid_fall.yaml", "--threads", "2"}).err, HasSubstr("--threads is called --jobs"));
}

TEST(Init, WritesASceneThatRenders) {
  const TemporaryFolder folder;
  const ProgramResult made = run_program({"init", folder.file("my_arm")});
  ASSERT_EQ(made.status, 0) << made.err;
  const ProgramResult rendered =
      run_program({"render", folder.file("my_arm.yaml"), "-o", folder.file("my_arm.mp4"), "--quiet", "--set",
                   "duration=0.1", "--set", "video.width=320", "--set", "video.height=180"});
  EXPECT_EQ(rendered.status, 0) << rendered.err;
  const ProgramResult checked = run_program({"check", folder.file("my_arm.urdf")});
  EXPECT_EQ(checked.status, 0) << checked.err;
}

TEST(Init, KeepsWhatIsThere) {
  const TemporaryFolder folder;
  const std::string model = folder.write("arm.urdf", "mine");
  EXPECT_EQ(run_program({"init", folder.file("arm")}).status, 6);
  EXPECT_EQ(read_whole_file(model), "mine");
  EXPECT_FALSE(fs::exists(folder.file("arm.yaml")));
}

TEST(Check, PrintsASceneThatReadsBackTheSame) {
  const ProgramResult first = run_program({"check", "assets/scenes/pp_spring.yaml", "--json"});
  ASSERT_EQ(first.status, 0) << first.err;
  const Json report = Json::parse(first.out);
  EXPECT_EQ(report["model"]["algebra"], "planar");
  EXPECT_EQ(report["cost"]["steps"], 10000);
  EXPECT_EQ(report["cost"]["Lambda_computed"], 0);
  const TemporaryFolder folder;
  std::string text = report["scene"];
  text.replace(text.find("models/"), 0, std::string(CHAINREEL_SOURCE_FOLDER) + "/");
  const ProgramResult again = run_program({"check", folder.write("again.yaml", text), "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out)["cost"], report["cost"]);
}

TEST(Doctor, FindsWhatFilmsNeed) {
  const ProgramResult result = run_program({"doctor", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json report = Json::parse(result.out);
  EXPECT_TRUE(report.contains("renderer"));
  EXPECT_THAT(report["encoders"].dump(), HasSubstr("libx264"));
  EXPECT_EQ(report["fonts"].size(), 3u);
}

TEST(Progress, IsAPlainLineWhereThereIsNoTerminal) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"render", "assets/scenes/pp_free.yaml", "-o", folder.file("a.mp4"), "--set",
                   "duration=0.2", "--set", "video.width=320", "--set", "video.height=180"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("100 %"));
  EXPECT_THAT(result.err, HasSubstr("frames/s"));
  EXPECT_THAT(result.err, testing::Not(HasSubstr("\r")));
}

// What a shell waits for, of the program whose number is $pid: that there is something in the folder $0, so that all is
// read and checked and it is in the midst of writing; or that it has worked for 0.2 s of processor time, whatever the
// clock says.
const std::string kIsWriting = "ls -A \"$0\" | grep -q .";
const std::string kIsAtWork = "test $(cut -d ' ' -f 14 /proc/$pid/stat) -ge 20";
const std::string kInterrupt = "kill -INT $pid";

// The program with `arguments`, interrupted as soon as `it_does` holds; its end is awaited.
ProgramResult interrupted_when(const std::string& it_does, const TemporaryFolder& folder, const Words& arguments,
                               const std::string& interrupt = kInterrupt) {
  const std::string line = "\"$@\" & pid=$!; until " + it_does + "; do kill -0 $pid || break; sleep 0.01; done; " +
                           interrupt + "; wait $pid";
  return run_command(with({"sh", "-c", line, folder.path().string(), program_path()}, arguments));
}

const Words kLongRender{"render", "assets/scenes/rrr_torque.yaml", "--quiet", "--set", "duration=300", "-o"};

TEST(Interrupt, LeavesNothingHalfWritten) {
  const TemporaryFolder folder;
  const ProgramResult result = interrupted_when(kIsWriting, folder, with(kLongRender, {folder.file("a.mp4")}));
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Interrupt, OfWhatKeepsFinishedPartsSaysThatItGoesOn) {
  const TemporaryFolder folder;
  const ProgramResult result = interrupted_when(kIsWriting, folder, with(kLongRender, {folder.file("a.mp4"), "--resume"}), kInterrupt);
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("what is finished is, and the same command goes on from there"));
  EXPECT_FALSE(fs::exists(folder.file("a.mp4")));
}

// As `timeout` signals its child and then the group of both: one signal, come twice.
TEST(Interrupt, ThatComesTwiceAtOnceLeavesNothingEither) {
  const TemporaryFolder folder;
  const ProgramResult result = interrupted_when(kIsWriting, folder, with(kLongRender, {folder.file("a.mp4")}),
                                                kInterrupt + "; sleep 0.001; " + kInterrupt);
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("nothing half-written was kept"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// Of a program that does not look: the second signal is meant as one.
TEST(InterruptDeathTest, AgainAfterAWhileEndsTheProgramAtOnce) {
  const auto raise_twice = [](useconds_t apart, int first) {
    install_signal_handlers();
    std::raise(first);
    usleep(apart);
    std::raise(SIGINT);
    std::_Exit(interrupted() ? 7 : 0);
  };
  EXPECT_EXIT(raise_twice(1000, SIGINT), testing::ExitedWithCode(7), "");
  EXPECT_EXIT(raise_twice(600000, SIGINT), testing::KilledBySignal(SIGINT), "");
  EXPECT_EXIT(raise_twice(600000, SIGTERM), testing::KilledBySignal(SIGINT), "");
}

// Tools that look for faults have handlers of their own.
TEST(FaultDeathTest, EndsWithALineAndAsTheSystemEndsIt) {
  const auto fault = [](int signal) {
    install_last_words();
    std::raise(signal);
    std::_Exit(0);  // nobody goes on after a fault
  };
  for (const auto& [signal, name] : {std::pair{SIGSEGV, "SIGSEGV"}, {SIGBUS, "SIGBUS"}, {SIGFPE, "SIGFPE"}, {SIGABRT, "SIGABRT"}}) {
    struct sigaction usual = {};
    sigaction(signal, nullptr, &usual);
    if (usual.sa_handler == SIG_DFL)
      EXPECT_EXIT(fault(signal), testing::KilledBySignal(signal), std::string("chainreel: .*") + name + ".*: what it was writing is not finished");
  }
}

// While the encoder finishes: that of VP9 has looked at the frames so far, and takes seconds to write them.
TEST(Interrupt, BehindTheLastFrameKeepsNoPartialFilm) {
  const TemporaryFolder folder, log;
  const ProgramResult result = run_command(
      {"sh", "-c",
       "\"$0\" render assets/scenes/rr_free.yaml -o \"$1\" --set duration=0.5 2>\"$2\" & pid=$!; "
       "until grep -q '100 %' \"$2\"; do sleep 0.01; done; kill -INT $pid; wait $pid",
       program_path(), folder.file("a.webm"), log.file("said")});
  EXPECT_EQ(result.status, 130) << read_whole_file(log.file("said"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Interrupt, IsHeardByGalleryAndSheet) {
  const TemporaryFolder made;
  ASSERT_EQ(run_program({"render", "assets/scenes/rr_free.yaml", "--quiet", "-o", made.file("a.mp4"), "--set",
                         "duration=0.1", "--set", "video.width=320", "--set", "video.height=180"})
                .status,
            0);
  // Some milliseconds each: it takes seconds to read them all.
  for (int i = 0; i < 3000; ++i)
    fs::create_symlink(made.path() / "a.mp4", made.path() / ("film_" + std::to_string(i) + ".mp4"));
  Words sheet{"sheet", "--width", "8000", "--height", "6000", "-o"};
  const Words scenes(48, "assets/scenes/rr_free.yaml");
  const TemporaryFolder page, picture;
  for (const auto& [folder, words] : {std::pair{&page, Words{"gallery", made.path().string(), "-o", page.file("page.html")}},
                                      {&picture, with(with(sheet, {picture.file("sheet.png")}), scenes)}}) {
    const ProgramResult result = interrupted_when(kIsAtWork, *folder, words);
    EXPECT_EQ(result.status, 130) << words[0] << "\n" << result.err;
    EXPECT_TRUE(fs::is_empty(folder->path())) << words[0];
  }
}

// What a page for people shows must be there, and be small enough to load at once.
TEST(Readme, PicturesAreThereAndTheFirstIsTheSheetOfAllScenes) {
  const std::string text = read_whole_file("README.md");
  static const std::regex picture(R"(!\[[^\]]+\]\(([^)]+)\))");
  std::vector<std::string> files;
  for (std::sregex_iterator at(text.begin(), text.end(), picture), end; at != end; ++at) files.push_back((*at)[1]);
  ASSERT_FALSE(files.empty());
  EXPECT_EQ(files.front(), "assets/gallery/sheet.png");
  EXPECT_LT(text.find(files.front()), 600u);
  for (const std::string& file : files) {
    EXPECT_TRUE(fs::is_regular_file(file)) << file;
    EXPECT_LT(fs::file_size(file), 400000u) << file;
  }
}

// The sheet remembers its titles.
TEST(Readme, SheetShowsEveryScene) {
  const std::string words = read_png_text("assets/gallery/sheet.png")["description"];
  const std::string remedy =
      "make it anew: chainreel sheet assets/scenes/*.yaml --width 1600 --height 1120 --text-scale 0.8 -o assets/gallery/sheet.png "
      "--force";
  std::ptrdiff_t scenes = 0;
  for (const auto& entry : fs::directory_iterator("assets/scenes")) {
    const std::string title = read_scene(entry.path().string(), {}).title;
    const std::string shown = title.substr(0, title.find('{'));
    ASSERT_FALSE(shown.empty()) << entry.path() << ": a title that begins with a blank to fill cannot be found";
    ASSERT_EQ(title.find(';'), std::string::npos) << entry.path() << ": titles are told apart by semicolons";
    EXPECT_THAT(words, HasSubstr(shown)) << remedy;
    ++scenes;
  }
  EXPECT_EQ(std::count(words.begin(), words.end(), ';') + 1, scenes) << remedy;
}

// CHAINREEL_UPDATE_GOLDEN=1 makes them anew. What `chart` measures is never the same twice: rr_free_chart.png is made by hand, by
// `chainreel chart assets/scenes/rr_free.yaml --width 1280 --height 720`.
TEST(Gallery, PicturesAreWhatTheProgramDrawsToday) {
  struct Made {
    std::string name;
    Words command;
  };
  Made sheet{"sheet", {"sheet", "--width", "1600", "--height", "1120", "--text-scale", "0.8"}};
  std::vector<std::string> scenes;
  for (const auto& entry : fs::directory_iterator("assets/scenes")) scenes.push_back(entry.path().string());
  std::ranges::sort(scenes);
  sheet.command.insert(sheet.command.end(), scenes.begin(), scenes.end());
  const Words size{"--width", "1280", "--height", "720"};
  const std::vector<Made> all = {
      sheet,
      {"arm_ellipsoid", with({"snapshot", "assets/scenes/arm_ellipsoid.yaml", "--at", "2s"}, size)},
      {"rr_ellipse", with({"snapshot", "assets/scenes/rr_ellipse.yaml", "--at", "1.2s"}, size)},
      {"ellipse_poses", with({"ellipse", "models/rr.urdf", "--pose", "0,90deg", "--pose", "0,150deg", "--pose", "0,0"}, size)},
      {"pp_spring_stability", with({"stability", "assets/scenes/pp_spring.yaml", "--x", "step=0.02:0.4:96", "--y", "parameters.k=25:400:60",
                                    "--set", "torque=[0, -k * y_G]", "--set", "parameters.k=100"}, size)},
  };
  const TemporaryFolder folder;
  for (const Made& one : all) {
    const std::string kept = "assets/gallery/" + one.name + ".png", now = folder.file(one.name + ".png");
    const ProgramResult result = run_program(with(one.command, {"-o", now, "--quiet"}));
    ASSERT_EQ(result.status, 0) << one.name << "\n" << result.err;
    if (std::getenv("CHAINREEL_UPDATE_GOLDEN")) fs::copy_file(now, kept, fs::copy_options::overwrite_existing);
    EXPECT_TRUE(pictures_agree(read_png(now), read_png(kept), {}, "gallery_" + one.name)) << one.name;
  }
}

// By the names of joints, with a picture's name in front or without; 30 for 30deg is said.
TEST(CommandLine, TakesPosesByNameAndSaysWhatIsMeantInDegrees) {
  const TemporaryFolder folder;
  const auto q_of = [](const std::string& q) {
    return Json::parse(run_program({"dynamics", "models/rr.urdf", "--q", q, "--json"}).out)["q"];
  };
  EXPECT_EQ(q_of("joint2=90deg"), q_of("0,90deg"));
  EXPECT_EQ(q_of("joint2=0.5,joint1=20deg"), q_of("20deg,0.5"));
  for (const char* bad : {"jont2=1", "joint1=1,joint1=2", "joint1=1,2", "joint1="})
    EXPECT_EQ(run_program({"dynamics", "models/rr.urdf", "--q", bad}).status, 2) << bad;
  EXPECT_THAT(run_program({"dynamics", "models/rr.urdf", "--q", "jont2=1"}).err, HasSubstr("did you mean"));
  const ProgramResult named = run_program({"snapshot", "models/rr.urdf", "--pose", "home=joint2=90deg", "--pose", "b=0,1", "--width", "64",
                                           "--height", "36", "-o", folder.file("f/"), "--quiet"});
  EXPECT_EQ(named.status, 0) << named.err;
  EXPECT_TRUE(std::filesystem::exists(folder.file("f/home.png")));
  const ProgramResult degrees = run_program({"dynamics", "models/rr.urdf", "--q", "30,0.2"});
  EXPECT_THAT(degrees.err, HasSubstr("WARNING: --q: 30 of joint1 is in radians, 4.77 turns: for degrees write 30deg"));
  EXPECT_EQ(run_program({"dynamics", "models/rr.urdf", "--q", "30rad,6.2"}).err, "") << "negative control";
  EXPECT_THAT(run_program({"dynamics", "models/arm.urdf", "--q", "joint2=150deg"}).err,
              HasSubstr("WARNING: --q: joint2 at 150 deg is beyond its limits, "));
}

TEST(CommandLine, SaysWhatIsMeantInDegreesAndWhatIsBeyondLimitsOfAStart) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& model, const std::string& q) {
    const std::string scene = folder.write("a.yaml", "model: " + std::string(CHAINREEL_SOURCE_FOLDER) + "/models/" + model + "\nstart: {q: [" + q + "]}\n");
    return run_program({"simulate", scene, "--set", "duration=0.1", "-o", folder.file("a.csv"), "--force"}).err;
  };
  EXPECT_THAT(said("rr.urdf", "90, 0.2"), HasSubstr("a: start.q: 90 of joint1 is in radians, 14.3 turns: for degrees write 90deg, for radians 90rad"));
  EXPECT_THAT(said("rr.urdf", "90rad, 720deg"), Not(HasSubstr("start.q")));
  EXPECT_THAT(said("arm.urdf", "0, 150deg, 0, 0, 0, 0"), HasSubstr("a: start.q: joint2 at 150 deg is beyond its limits, "));
  EXPECT_THAT(said("arm.urdf", "0, 0, 0, 0, 0, 0"), Not(HasSubstr("start.q")));
}

// A file or a folder of that name is nobody's wish; `simulate` and `inverse` write there.
TEST(CommandLine, ADashIsNoNameOfAFile) {
  const std::string root = CHAINREEL_SOURCE_FOLDER;
  for (const Words& words : std::vector<Words>{{"equations", root + "/models/rr.urdf", "-o", "-"},
                                               {"snapshot", root + "/models/rr.urdf", "--pose", "home=0,1", "-o", "-/"},
                                               {"sweep", root + "/assets/scenes/pp_free.yaml", "--over", "torque.1=0,1", "--set",
                                                "duration=0.05", "-o", "-"}}) {
    const TemporaryFolder folder;
    const ProgramResult result = run_program(words, {.folder = folder.path().string()});
    EXPECT_EQ(result.status, 2) << words[0] << result.err;
    EXPECT_THAT(result.err, HasSubstr("name one, like -o out/")) << words[0];
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << words[0];
  }
  const ProgramResult table = run_program({"simulate", "assets/scenes/pp_free.yaml", "--set", "duration=0.05", "-o", "-", "--quiet"});
  EXPECT_EQ(table.status, 0) << "negative control";
}

}  // namespace
}  // namespace chainreel
