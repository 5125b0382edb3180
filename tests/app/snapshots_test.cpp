// Many pictures of one command, and bytes that do not depend on where or when they are made.
#include <gmock/gmock.h>

#include <filesystem>

#include "app/film/clip_memory.hpp"
#include "core/json.hpp"
#include "encode/png.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const Words kSmallPicture = {"--width", "160", "--height", "90", "--quiet"};
const Words kShortRun = {"--set", "duration=1", "--set", "method=rk4",
                         "--set", "step=0.01",  "--set", "tolerance=null"};

TEST(ManySnapshots, EachPoseIsAFileOfItsName) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(
      chainreel::with({"snapshot", "models/rr.urdf", "--pose", "home=0,0", "--pose", "up and away=90deg,0",
                       "--pose", "1,1", "-o", folder.file("new/"), "--json"},
                      kSmallPicture));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(Json::parse(result.out)["files"],
              ElementsAre(folder.file("new/home.png"), folder.file("new/up_and_away.png"),
                          folder.file("new/rr_3.png")));
  EXPECT_EQ(names_in(folder.file("new")),
            (std::vector<std::string>{"home.png", "rr_3.png", "up_and_away.png"}));
  // Each is what it is alone, and says how it is made alone.
  ASSERT_EQ(run_program(chainreel::with({"snapshot", "models/rr.urdf", "--pose", "90deg,0", "-o",
                                         folder.file("alone.png")},
                                        kSmallPicture))
                .status,
            0);
  EXPECT_TRUE(read_whole_file(folder.file("new/up_and_away.png")) == read_whole_file(folder.file("alone.png")));
  EXPECT_THAT(run_program({"extract", folder.file("new/up_and_away.png")}).out,
              AllOf(HasSubstr("snapshot models/rr.urdf --pose 90deg,0 "), Not(HasSubstr("home")),
                    Not(HasSubstr("1,1"))));
}

TEST(ManySnapshots, EachInstantIsAFileAndThatOfAFrameIsWhatItIsAlone) {
  const TemporaryFolder folder;
  fs::create_directories(folder.file("there"));
  const Words scene =
      chainreel::with({"snapshot", "assets/scenes/rr_free.yaml"}, chainreel::with(kShortRun, kSmallPicture));
  ASSERT_EQ(
      run_program(chainreel::with(scene, {"--at", "0,0.5s", "--at", "last=0.9", "-o", folder.file("there")}))
          .status,
      0);
  EXPECT_EQ(names_in(folder.file("there")),
            (std::vector<std::string>{"last.png", "rr_free_0.5s.png", "rr_free_0s.png"}));
  ASSERT_EQ(run_program(chainreel::with(scene, {"--at", "0.5", "-o", folder.file("alone.png")})).status, 0);
  EXPECT_EQ(read_whole_file(folder.file("there/rr_free_0.5s.png")),
            read_whole_file(folder.file("alone.png")));
  EXPECT_NE(read_png(folder.file("there/rr_free_0s.png")).bgra, read_png(folder.file("alone.png")).bgra);
}

TEST(ManySnapshots, APictureDoesNotDependOnWhichOthersAreAskedFor) {
  const TemporaryFolder folder;
  const Words scene =
      chainreel::with({"snapshot", "assets/scenes/rr_free.yaml"}, chainreel::with(kShortRun, kSmallPicture));
  const auto taken = [&](const std::string& at, const std::string& place) {
    EXPECT_EQ(run_program(chainreel::with(scene, {"--at", at, "-o", folder.file(place)})).status, 0);
  };
  taken("a=0.1234,b=0.5,c=0.8765", "many/");
  for (const auto& [name, at] : {std::pair("a", "0.1234"), {"b", "0.5"}, {"c", "0.8765"}}) {
    taken(at, std::string(name) + ".png");
    EXPECT_EQ(read_whole_file(folder.file(std::string("many/") + name + ".png")),
              read_whole_file(folder.file(std::string(name) + ".png")))
        << at;
  }
}

TEST(ManySnapshots, AnEventIsAnInstant) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("drop.yaml", "model: " + (fs::path(CHAINREEL_SOURCE_FOLDER) / "models/rr.urdf").string() +
                                    "\nduration: 1\nmethod: rk4\nvideo: {width: 160, height: 90}\nevents: "
                                    "[{when: \"q1 < -0.5\", name: low}, {when: "
                                    "\"q1 > 50\", name: never}]\n");
  const ProgramResult result =
      run_program({"snapshot", scene, "--at", "event low,0.1", "-o", folder.file("out/"), "--quiet"});
  ASSERT_EQ(result.status, 0) << result.err;
  const double at = recall(folder.file("out/drop_low.png")).audit["at"];
  EXPECT_GT(at, 0.1);
  EXPECT_LT(at, 0.9);
  EXPECT_THAT(run_program({"snapshot", scene, "--at", "event never", "-o", folder.file("x.png")}).err,
              HasSubstr("the event does not happen in this run"));
  EXPECT_THAT(run_program({"snapshot", scene, "--at", "event lov", "-o", folder.file("x.png")}).err,
              HasSubstr("did you mean 'low'?"));
}

// What is behind a sign of equality is no instant of its own, with the event's text for the picture's name.
TEST(ManySnapshots, AnEventWithoutANameMayHaveASignOfEquality) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("lift.yaml", "model: " + (fs::path(CHAINREEL_SOURCE_FOLDER) / "models/rr.urdf").string() +
                                                          "\nduration: 2\nmethod: rk4\nvideo: {width: 160, height: 90}\ntorque: [40, 0]\n"
                                                          "events: [{when: \"q1 >= 1\"}]\n");
  const ProgramResult result = run_program({"snapshot", scene, "--at", "event q1 >= 1", "-o", folder.file("a.png"), "--quiet"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_LT(recall(folder.file("a.png")).audit["at"], 0.5);
}

TEST(ManySnapshots, UnnamedPosesInOneFileStayOnePicture) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(chainreel::with({"snapshot", "models/rr.urdf", "--pose", "0,0", "--pose", "1,1", "-o",
                                         folder.file("a.png")},
                                        kSmallPicture))
                .status,
            0);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.png"});
  EXPECT_EQ(recall(folder.file("a.png")).figure["poses"].size(), 2u);
}

// A pose that has a name is the picture of the file that is named, as without it.
TEST(ManySnapshots, OneNamedPoseMayHaveAFileOfItsOwn) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"snapshot", "models/rr.urdf", "--pose", "a=0,1", "-o", folder.file("a.png"), "--quiet"}).status, 0);
  ASSERT_EQ(run_program({"snapshot", "models/rr.urdf", "--pose", "0,1", "-o", folder.file("b.png"), "--quiet"}).status, 0);
  EXPECT_EQ(read_whole_file(folder.file("a.png")), read_whole_file(folder.file("b.png")));
}

TEST(ManySnapshots, WhatIsUnclearIsRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  const auto trouble = [&](const Words& words) {
    const ProgramResult result =
        run_program(chainreel::with({"snapshot"}, chainreel::with(words, {"-o", folder.file("x/")})));
    EXPECT_EQ(result.status, 2) << result.err;
    return result.err;
  };
  EXPECT_THAT(trouble({"models/rr.urdf", "--pose", "a=0,0", "--pose", "a=1,1"}),
              HasSubstr("two pictures are named 'a'"));
  EXPECT_THAT(trouble({"models/rr.urdf", "--pose", "=0,0"}), HasSubstr("has no name in front of the ="));
  EXPECT_THAT(trouble({"models/rr.urdf", "--pose", "a=0,0", "--pose", "b=0"}), HasSubstr("has 1 number, but rr needs 2: of joint1, joint2"));
  EXPECT_THAT(trouble({"assets/scenes/rr_free.yaml", "--at", "0,0s"}),
              HasSubstr("two pictures are named 'rr_free_0s'"));
  EXPECT_THAT(trouble({"assets/scenes/rr_free.yaml", "--at", "0,soon"}), HasSubstr("'soon' is no instant"));
  EXPECT_THAT(trouble({"assets/scenes/rr_free.yaml", "--at", "99"}), HasSubstr("lies behind the end"));
  EXPECT_EQ(run_program({"snapshot", "assets/scenes/rr_free.yaml", "--at", "0,1", "-o", folder.file("a.png")})
                .status,
            2);
  EXPECT_EQ(run_program({"snapshot", "models/rr.urdf", "--pose", "a=0,1", "--pose", "b=1,0", "-o", folder.file("a.png")}).status,
            2);
  EXPECT_THAT(names_in(folder.path()), testing::IsEmpty());
  // A file of others is not written over, and then none of the others either.
  folder.write("y/b.png", "mine");
  EXPECT_EQ(run_program(
                {"snapshot", "models/rr.urdf", "--pose", "a=0,0", "--pose", "b=1,1", "-o", folder.file("y/")})
                .status,
            6);
  EXPECT_EQ(names_in(folder.file("y")), std::vector<std::string>{"b.png"});
}

TEST(Snapshots, OpenNoLibraryOfFilmsAndRenderersOnlyWhereOneIsNamed) {
  const TemporaryFolder folder;
  const auto opened = [&](const std::string& library, const std::string& name) {
    return run_program(chainreel::with({"--gl", library, "snapshot", "assets/scenes/rr_free.yaml", "-o", folder.file(name)},
                                       chainreel::with(kShortRun, kSmallPicture)),
                       {.environment = {{"LD_DEBUG", "files"}}})
        .err;
  };
  EXPECT_THAT(opened("osmesa", "a.png"), AllOf(HasSubstr("libOSMesa"), Not(HasSubstr("libavcodec"))));
  EXPECT_THAT(opened("auto", "b.png"), AllOf(HasSubstr("libassimp"), Not(HasSubstr("libOSMesa")), Not(HasSubstr("libavcodec"))));
}

// Two copies of the same inputs, seen by two users from different folders at different times.
class TwoPlaces : public testing::Test {
 protected:
  TwoPlaces() {
    for (const std::string& place : {first_, second_}) {
      fs::create_directories(fs::path(place) / "scenes");
      for (const char* model : {"rr.urdf", "pp.urdf"})
        fs::copy_file(fs::path(CHAINREEL_SOURCE_FOLDER) / "models" / model, fs::path(place) / model);
      const std::string look = "duration: 0.2\nmethod: rk4\nvideo: {width: 160, height: 90}\n";
      folder_.write(place.substr(folder_.path().string().size() + 1) + "/scenes/a.yaml",
                    "model: ../rr.urdf\n" + look);
      folder_.write(place.substr(folder_.path().string().size() + 1) + "/scenes/b.yaml",
                    "model: ../pp.urdf\n" + look);
      folder_.write(
          place.substr(folder_.path().string().size() + 1) + "/scenes/c.yaml",
          "model: ../rr.urdf\n" + look + "compare: [{method: rk4}, {method: dop853, model: ../rr.urdf}]\n");
    }
  }

  // `words` names files below a place as @/NAME.
  std::string made(const Words& words, const std::string& ending, bool in_first) {
    const std::string output = folder_.file((in_first ? "1" : "2") + ending);
    Words command;
    for (std::string word : words) {
      if (word.starts_with("@/")) word = in_first ? word.substr(2) : second_ + word.substr(1);
      command.push_back(word);
    }
    RunOptions options{.folder = first_};
    if (!in_first)
      options = {.folder = second_ + "/scenes",
                 .environment = {{"HOME", folder_.path().string()},
                                 {"LANG", "de_DE.UTF-8"},
                                 {"LC_ALL", "C"},
                                 {"TZ", "Asia/Tokyo"},
                                 {"USER", "else"}}};
    const ProgramResult result =
        run_program(chainreel::with(command, {"--quiet", "--force", "-o", output}), options);
    EXPECT_EQ(result.status, 0) << result.err;
    return output;
  }

  TemporaryFolder folder_;
  const std::string first_ = folder_.file("first"), second_ = folder_.file("far/away/second");
};

TEST_F(TwoPlaces, PicturesHaveTheSameBytes) {
  const Words size = {"--width", "160", "--height", "90"};
  for (const Words& words : {chainreel::with({"snapshot", "@/scenes/a.yaml", "--at", "0.1"}, size),
                             chainreel::with({"snapshot", "@/scenes/c.yaml"}, size),
                             chainreel::with({"snapshot", "@/rr.urdf", "--pose", "0,1"}, size),
                             chainreel::with({"ellipse", "@/rr.urdf", "--pose", "0,1"}, size),
                             chainreel::with({"ellipse", "--along", "@/scenes/a.yaml"}, size),
                             Words{"sheet", "@/scenes/a.yaml", "@/scenes/b.yaml"}})
    for (const char* ending : {".png", ".svg", ".pdf"}) {
      const std::string one = read_whole_file(made(words, ending, true)),
                        other = read_whole_file(made(words, ending, false));
      EXPECT_EQ(one == other, true) << words[0] << " " << words[1] << ending;
      EXPECT_THAT(one, Not(HasSubstr(folder_.path().string())));
    }
}

TEST_F(TwoPlaces, FilmsHaveTheSameBytes) {
  for (const char* ending : {".mp4", ".gif", ".apng"})
    EXPECT_EQ(read_whole_file(made({"render", "@/scenes/a.yaml"}, ending, true)) ==
                  read_whole_file(made({"render", "@/scenes/a.yaml"}, ending, false)),
              true)
        << ending;
}

// What a picture remembers works again where its inputs are found: below the working folder, beside it, or
// where it is said.
TEST_F(TwoPlaces, WhatIsExtractedWorksAgain) {
  const std::string picture = made({"snapshot", "@/scenes/a.yaml", "--at", "0.1"}, ".png", true);
  for (const Words& from : {Words{}, Words{"--from", first_ + "/scenes"}}) {
    const std::string scene = folder_.file("other/again.yaml");
    ASSERT_EQ(run_program(chainreel::with({"extract", picture, "-o", scene, "--force"}, from),
                          {.folder = from.empty() ? first_ : "/"})
                  .status,
              0);
    ASSERT_EQ(
        run_program({"snapshot", scene, "--at", "0.1", "--quiet", "--force", "-o", folder_.file("again.png")})
            .status,
        0);
    EXPECT_EQ(read_png(folder_.file("again.png")).bgra, read_png(picture).bgra);
  }
  const std::string figure =
      made({"ellipse", "@/rr.urdf", "--pose", "0,1", "--width", "160", "--height", "90"}, ".svg", true);
  EXPECT_EQ(run_program({"extract", figure}, {.folder = folder_.path().string()}).out.substr(0, 34),
            "chainreel ellipse first/rr.urdf --");
  // Where they are not, that is said.
  fs::remove(fs::path(first_) / "rr.urdf");
  fs::remove(fs::path(second_) / "rr.urdf");
  EXPECT_THAT(run_program({"extract", picture, "--from", first_ + "/scenes"}).err,
              HasSubstr("there is no ../rr.urdf here"));
}

// An absolute path that stands in the scene itself is no place of ours.
TEST_F(TwoPlaces, AbsolutePathsOfTheSceneStayAsTheyAre) {
  const std::string model = first_ + "/rr.urdf";
  const std::string scene = folder_.write(
      "x/s.yaml", "model: " + model + "\nduration: 0.1\nmethod: rk4\nvideo: {width: 160, height: 90}\n");
  ASSERT_EQ(run_program({"snapshot", scene, "--quiet", "-o", folder_.file("s.png")}).status, 0);
  EXPECT_THAT(recall(folder_.file("s.png")).scene, HasSubstr(model));
}

}  // namespace
}  // namespace chainreel
