// What people write and mean otherwise: it is said, or done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kChain = "model: {links: [0.5, 0.4], masses: [2, 1]}\n";

TEST(Meant, EquationsAreInTheFormOfTheirFilesEnding) {
  const TemporaryFolder folder;
  const auto text_in = [&](const std::string& name, const Words& more = {}) {
    const ProgramResult result = run_program(with({"equations", "models/rr.urdf", "-o", folder.file(name)}, more));
    return result.status == 0 ? read_whole_file(folder.file(name)) : result.err;
  };
  EXPECT_THAT(text_in("a.tex"), HasSubstr("\\begin{"));
  EXPECT_THAT(text_in("a.py"), HasSubstr("def "));
  EXPECT_THAT(text_in("a.json"), StartsWith("{"));
  EXPECT_THAT(text_in("a.txt"), Not(HasSubstr("\\begin{")));
  EXPECT_THAT(text_in("b.tex", {"--python"}), HasSubstr("take one of them"));
  EXPECT_THAT(text_in("a.dat"), HasSubstr("give it the ending .tex, .py, .json or .txt"));
}

TEST(Meant, AnAngleOfAHundredTurnsIsNoneOfATable) {
  const TemporaryFolder folder;
  const std::string table = folder.write("dh.csv", "a,alpha,d,theta\n0.5,90,0,0\n0.4,0,0,0\n");
  const ProgramResult made = run_program({"init", folder.file("arm"), "--dh", table});
  EXPECT_EQ(made.status, 3);
  EXPECT_THAT(made.err, HasSubstr("dh.csv:2: 90 is in radians, 14.3 turns: for degrees write 90deg, for radians 90rad"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("arm.urdf")));
  const std::string scene = folder.write("a.yaml", "model: {dh: [[0.5, 90, 0, 0], [0.4, 0, 0, 0]]}\n");
  EXPECT_THAT(run_program({"check", scene}).err, HasSubstr("for degrees write 90deg"));
  for (const char* good : {"90deg", "90rad", "1.5"}) {
    const std::string well = folder.write("b.yaml", std::string("model: {dh: [[0.5, ") + good + ", 0, 0], [0.4, 0, 0, 0]]}\n");
    EXPECT_EQ(run_program({"check", well}).status, 0) << good;
  }
}

// A chain of one's own has the torques that one asks for.
TEST(Meant, AChainInNumbersMovesFreely) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"init", folder.file("arm"), "--links", "0.5,0.4", "--masses", "2,1"}).status, 0);
  const ProgramResult run = run_program({"simulate", folder.file("arm.yaml"), "--json", "-o", folder.file("a.csv"), "--set", "duration=1",
                                         "--columns", "t,tau"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(read_whole_file(folder.file("a.csv")), Not(testing::ContainsRegex("\n[0-9.]+,[^\n]*[1-9]\n")));
  ASSERT_EQ(run_program({"init", folder.file("start")}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("start.yaml")), HasSubstr("\ntorque:")) << "an example has one";
}

TEST(Meant, SizeAndRateOfASmallClipAreSaid) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", kChain + "duration: 0.2\nvideo: {width: 1280, height: 720, fps: 60}\n");
  const ProgramResult made = run_program({"render", scene, "-o", folder.file("a.gif"), "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("a.gif has 800x450 pixels and 20 frames/s, as .gif files are at most 25 frames/s and 800 pixels wide"));
  const Json clip = Json::parse(made.out).at("films").at(0).at("small_clips").at(0);
  EXPECT_EQ(clip["width"], 800);
  EXPECT_EQ(clip["height"], 450);
  EXPECT_EQ(clip["fps"], 20);
  EXPECT_EQ(clip["frames"], 4);
  EXPECT_THAT(run_program({"render", scene, "-o", folder.file("a.gif"), "--force"}).out, HasSubstr("\na           4    0.20")) << "frames of the clip itself";
  const ProgramResult small = run_program({"render", scene, "-o", folder.file("b.gif"), "--set", "video={width: 64, height: 36, fps: 20}"});
  EXPECT_THAT(small.err, Not(HasSubstr("note:"))) << "negative control";
}

TEST(Meant, APictureOfWhatIsOverIsSaidToBe) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("a.yaml", kChain + "duration: 2\nevents: [{when: \"t - 0.5\", kind: stop, name: half}]\n");
  const auto said = [&](const char* at) {
    return run_program({"snapshot", scene, "--at", at, "--width", "64", "--height", "36", "-o", folder.file("a.png"), "--force"}).err;
  };
  EXPECT_THAT(said("1.5"), HasSubstr("a: every run had ended by t = 0.5 s: the picture for t = 1.5 s shows how"));
  EXPECT_THAT(said("0.4"), Not(HasSubstr("had ended"))) << "negative control";
}

TEST(Meant, ATableOfMillisecondsIsDoubted) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& last) {
    folder.write("log.csv", "t,tau1,tau2\n0,0,0\n" + last + ",1,1\n");
    const std::string scene = folder.write("a.yaml", kChain + "duration: 2\ntorque: {csv: log.csv}\n");
    return run_program({"simulate", scene, "-o", folder.file("a.csv"), "--force", "--quiet"}).err;
  };
  EXPECT_THAT(said("2000"), HasSubstr("goes on until 2000 s, of which the run of 2 s sees the beginning: are its times in seconds?"));
  EXPECT_THAT(said("3"), Not(HasSubstr("in seconds?"))) << "negative control";
}

TEST(Meant, HelpHasThePagesThatLieBesideTheProgram) {
  EXPECT_THAT(run_program({"help"}).out, AllOf(HasSubstr("snapshots"), HasSubstr("which-method"), HasSubstr("scene")));
  EXPECT_THAT(run_program({"help", "suite"}).out, HasSubstr("poses:"));
  EXPECT_EQ(run_program({"help", "suite"}).out, run_program({"help", "snapshots"}).out);
}

// What a picture cannot show, though it was asked for by name.
TEST(Meant, WhatIsAskedForInVainIsSaid) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", kChain + "start: {q: [0.5, 0.5]}\nduration: 0.5\n");
  const auto said = [&](const Words& more, int status = 0) {
    const ProgramResult result = run_program(with({"snapshot", scene, "--force", "-o", folder.file("s.png")}, more));
    EXPECT_EQ(result.status, status) << result.err;
    return result.err;
  };
  const Words words{"--set", "draw=[+legend, +equation]"}, shadow{"--set", "draw=[+shadow]"};
  EXPECT_THAT(said(with(words, {"--layout", "transparent"})), HasSubstr("legend, equation: not drawn"));
  EXPECT_EQ(said(words), "");
  EXPECT_EQ(said({"--layout", "transparent"}), "") << "nobody named its words";
  EXPECT_THAT(said(shadow), HasSubstr("shadow: not drawn"));
  EXPECT_EQ(said(with(shadow, {"--azimuth", "30deg"})), "");
  EXPECT_THAT(said({"--set", "ellipse.reading=belt"}), HasSubstr("'ellipse.reading' is of the layer `ellipse`"));
  EXPECT_EQ(said({"--set", "ellipse.reading=belt", "--set", "draw=[+ellipse]"}), "");
  EXPECT_THAT(said({"--set", "plot=['1 / 0 * t']"}, 3), HasSubstr("is not finite at any instant"));
  EXPECT_EQ(said({"--set", "plot=['1 / t']"}), "") << "but for one";
  EXPECT_THAT(said({"--fit", "[100, 100, 101, 101]"}, 3), HasSubstr("'camera.fit' shows nothing"));
  EXPECT_EQ(said({"--fit", "[0.1, 0.1, 0.2, 0.2]"}), "");
}

// Rooms of marks took all of a scene that plots below it leave: its scale was 2e13 m, and plots had no height.
TEST(Meant, PlotsBelowASceneLeaveItAndThemselvesRoom) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", kChain + "start: {q: [0.5, 0.5]}\nduration: 0.1\ntorque: [3, 2]\nplot: [energy, q, tau]\n");
  const auto square = [&](const Words& more, const std::string& height = "1080") {
    return run_program(with({"render", scene, "--width", "1080", "--height", height, "--force", "-o", folder.file("s.mp4")}, more));
  };
  for (const char* draw : {"draw=[]", "draw=[+angles]", "draw=[+frames, +equation]", "draw=[+mass_matrix, +equation, +scale_bar, +angles]"}) {
    const ProgramResult result = square({"--set", draw});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_LT(Json::parse(read_whole_file(folder.file("s.json"))).at("view").at("height").get<double>(), 12) << draw << ": the motion is 1.8 m high, and has a third of the page";
  }
  for (const char* height : {"1350", "1920"}) EXPECT_EQ(square({}, height).status, 0) << "a plot of what is constant may be lower than others, not lower than its numbers";
  const ProgramResult crowded = square({"--set", "draw=[+legend, +velocity, +com, +frames, +angles, +mass_matrix, +equation, +scale_bar, +ellipse, +gravity]", "--set",
                                        "torque=['-10 * (q1 - 1) - qd1', '3 * sin(5 * t)']", "--set", "push={frame: gripper, force: [10, 0], from: 0, until: 1}"});
  EXPECT_EQ(crowded.status, 3) << crowded.err;
  EXPECT_THAT(crowded.err, HasSubstr("3 plots have no room on this page"));
}

}  // namespace
}  // namespace chainreel
