// What may go wrong around a suite: files of others, folders that take nothing, words that would mislead.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <tinyxml2.h>

#include <filesystem>

#include "app/verify_suite.hpp"
#include "core/hash.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class SuiteTrouble : public Verify {
 protected:
  int mode_of(const std::string& name) const {
    struct stat facts = {};
    EXPECT_EQ(stat((folder_.path() / name).c_str(), &facts), 0) << name;
    return int(facts.st_mode & 07777);
  }
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
};

TEST_F(SuiteTrouble, PicturesOfWhatFailedGoWhenTheyAreNoMoreTrueAndNoOthersDo) {
  accept_all();
  replace("arm.yaml", "home: [0, 0]", "home: [0, 1]");
  EXPECT_EQ(verify({"-o", "shown"}).status, 1);
  for (const char* what : {"expected", "actual", "difference"})
    EXPECT_NO_THROW(read_png(file(std::string("shown/home.") + what + ".png"))) << what;
  replace("arm.yaml", "home: [0, 1]", "home: [0, 0]");
  fs::copy_file(file("arm.baselines/up.png"), file("shown/up.actual.png"));  // the user's own
  write("shown/bent.expected.png", "mine, and no picture");
  EXPECT_EQ(verify({"-o", "shown"}).status, 0);
  EXPECT_FALSE(fs::exists(file("shown/home.actual.png")));
  EXPECT_FALSE(fs::exists(file("shown/home.difference.png")));
  EXPECT_TRUE(fs::exists(file("shown/up.actual.png")));
  EXPECT_EQ(read_whole_file(file("shown/bent.expected.png")), "mine, and no picture");
}

TEST_F(SuiteTrouble, FilesThatAreAcceptedAnewKeepTheirMode) {
  accept_all();
  for (const char* name : {"home.png", "home.json", "records/cameras.json"})
    ASSERT_EQ(chmod(file(std::string("arm.baselines/") + name).c_str(), 0600), 0);
  ASSERT_EQ(chmod(file("arm.baselines/records").c_str(), 0700), 0);
  ASSERT_EQ(chmod(file("arm.baselines/up.png").c_str(), 0640), 0);
  EXPECT_EQ(verify({"--accept", "home"}).status, 0);
  for (const char* name : {"home.png", "home.json", "records/cameras.json"})
    EXPECT_EQ(mode_of(std::string("arm.baselines/") + name), 0600) << name;
  EXPECT_EQ(mode_of("arm.baselines/records"), 0700);
  EXPECT_EQ(mode_of("arm.baselines/up.png"), 0640);
}

// The remedy is one that this command has: it takes no other place for its baselines.
TEST_F(SuiteTrouble, BaselinesBehindALinkAreReadAndNotReplaced) {
  accept_all();
  fs::rename(file("arm.baselines"), file("real"));
  fs::create_directory_symlink("real", file("arm.baselines"));
  EXPECT_EQ(verify().status, 0);
  const ProgramResult result = verify({"--accept"});
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.err, AllOf(HasSubstr("is a link"), Not(HasSubstr("-o"))));
  EXPECT_TRUE(fs::is_symlink(file("arm.baselines")));
  EXPECT_TRUE(fs::exists(file("real/home.png")));
}

TEST_F(SuiteTrouble, ALostCameraIsToldAlsoWhereNothingElseChanged) {
  accept_all();
  fs::remove(file("arm.baselines/records/cameras.json"));
  const ProgramResult result = verify();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err,
              HasSubstr("the camera of rr.urdf is missing in arm.baselines/records/cameras.json"));
  EXPECT_THAT(results()["notices"], SizeIs(1));
  EXPECT_EQ(verify({"--accept", "--refit"}).status, 0);
  EXPECT_THAT(verify().err, IsEmpty());
  // A camera of the suite's own is kept nowhere else.
  replace("arm.yaml", "size:", "camera: {fit: [-1, -2, 3, 2]}\nsize:");
  EXPECT_EQ(verify({"--accept"}).status, 0);
  EXPECT_THAT(results()["notices"], IsEmpty());
}

TEST_F(SuiteTrouble, ASpoiltCameraIsToldWithARemedyThatWorks) {
  for (const char* camera : {"[2, 0, 1, 1]", "[0, 0, 0, 1]", "[0, 1]", "\"a\"", "[0, 0, null, 1]"}) {
    accept_all();
    write("arm.baselines/records/cameras.json", std::string("{\"rr.urdf\": ") + camera + "}");
    const ProgramResult result = verify();
    EXPECT_EQ(result.status, 3) << camera;
    EXPECT_THAT(result.err,
                AllOf(HasSubstr("cameras.json"), HasSubstr("--accept --refit"), Not(HasSubstr("--set"))));
    EXPECT_EQ(verify({"--accept", "--refit"}).status, 0) << camera;
    EXPECT_EQ(verify().status, 0) << camera;
  }
}

// Of a robot in space the eye is kept, too: a foot three times as wide moved the middle that it looked at, and with it all else.
TEST_F(SuiteTrouble, AChangeOfARobotInSpaceDoesNotMoveTheEye) {
  write("space.urdf", read_whole_file("models/arm.urdf"));
  write("space.yaml", "model: space.urdf\nsize: 320x240\nposes: {up: [0.4, 0.1, -0.2, 0, 0, 0]}\n");
  ASSERT_EQ(verify({"--missing", "write"}, "space.yaml").status, 0);
  const Json cameras = Json::parse(read_whole_file(file("space.baselines/records/cameras.json")));
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras.front().size(), 8u) << cameras;
  replace("space.urdf", "radius=\"0.11\"", "radius=\"0.30\"");
  ASSERT_EQ(verify({"-o", "shown"}, "space.yaml").status, 1);
  const Image before = read_png(file("shown/up.expected.png")), after = read_png(file("shown/up.actual.png"));
  const std::size_t half = before.bgra.size() / 2;
  EXPECT_TRUE(std::equal(before.bgra.begin(), before.bgra.begin() + std::ptrdiff_t(half), after.bgra.begin())) << "the upper half shows no foot";
  EXPECT_NE(before.bgra, after.bgra);
}

TEST_F(SuiteTrouble, KeysOfTheSuiteAreToldWithItsLinesAndOnce) {
  write("swing.yaml", "model: rr.urdf\ntorque: [0, 0]\nduration: 1\nmethod: rk4\nstep: 0.01\n");
  write("both.yaml", "scene: swing.yaml\ncamera: {elevation: 400deg}\n");
  EXPECT_THAT(verify({}, "both.yaml").err,
              AllOf(HasSubstr("both.yaml:2:21: 'camera.elevation'"), Not(HasSubstr("--set"))));
  // Found out when the scene is made ready only.
  write("both.yaml", "scene: swing.yaml\nsize: 320x180\nat: 0\nend_effector: nobody\n");
  const ProgramResult result = verify({}, "both.yaml");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, AllOf(HasSubstr("both.yaml:4:15: 'end_effector'"), Not(HasSubstr("--set"))));
}

TEST_F(SuiteTrouble, ASourceThatCannotBeShownLeavesTheOthers) {
  std::string text = read_whole_file("models/rr.urdf");
  text.insert(text.find("<link name=\"link1\">") + 19,
              "<visual><geometry><mesh filename='none.stl'/></geometry></visual>");
  write("broken.urdf", text);
  write("two.yaml", "model: [rr.urdf, broken.urdf]\nsize: 320x180\nlinks: visual\nposes: {home: [0, 0]}\n");
  const Json json = results({"--missing", "write"}, "two.yaml");
  EXPECT_EQ(picture(json, "rr_home")["state"], "accepted");
  EXPECT_EQ(picture(json, "broken_home")["state"], "failed");
  EXPECT_THAT(words(json, "broken_home"), HasSubstr("none.stl"));
}

// An instant between two frames is a sample more, of trails, too.
TEST_F(SuiteTrouble, AnInstantMoreChangesNoOtherPicture) {
  write("swing.yaml",
        "model: rr.urdf\ntorque: [0, 0]\nduration: 3\nmethod: rk4\nstep: 0.01\ndraw: [chain, trail]\nvideo: "
        "{fps: 10}\n");
  write("s.yaml", "scene: swing.yaml\nsize: 640x360\nat: [1s, 2.9s, 2.9123s]\n");
  accept_all("s.yaml");
  write("s.yaml", "scene: swing.yaml\nsize: 640x360\nat: [0.777s, 1s, 2.713s, 2.9s, 2.9123s]\n");
  const Json json = results({}, "s.yaml");
  for (const char* name : {"1s", "2.9s", "2.9123s"}) EXPECT_EQ(picture(json, name)["state"], "same") << name;
}

TEST_F(SuiteTrouble, WhatCannotBeHonouredIsRefusedBeforeAnythingIsDrawn) {
  accept_all();
  const auto before = baselines();
  const auto refused = [&](const Words& words, int status, const std::string& told) {
    const ProgramResult result = verify(words);
    EXPECT_EQ(result.status, status) << testing::PrintToString(words);
    EXPECT_THAT(result.err, HasSubstr(told));
    EXPECT_THAT(result.out, IsEmpty()) << "drawn already";
  };
  refused({"--accept", "home", "--filter", "up"}, 2, "--accept home: --filter leaves this picture out");
  refused({"--filter", "home", "--filter", "nobody*"}, 2, "--filter nobody* matches none");
  refused({"-o", "arm.yaml"}, 2, "arm.yaml is a file");
  refused({"--junit", "arm.baselines/new.xml"}, 2, "lies in the folder of the baselines");
  refused({"-o", "arm.baselines/shown"}, 2, "lies in the folder of the baselines");
  refused({"--markdown", "/dev/null"}, 6, "is a device");
  write("there.html", "mine");
  refused({"--html", "there.html"}, 6, "exists already");
  EXPECT_EQ(baselines(), before);
}

TEST_F(SuiteTrouble, MasksThatLeaveNothingAreRefused) {
  const auto told = [&](const std::string& masks) {
    write("m.yaml", "model: rr.urdf\nsize: 320x180\nposes: {a: [0, 0]}\nmasks: " + masks + "\n");
    const ProgramResult result = verify({"--missing", "write"}, "m.yaml");
    return result.status == 0 ? "" : result.err;
  };
  EXPECT_THAT(told("[[0, 0, 320, 180]]"), HasSubstr("the masks cover all of the picture 'a'"));
  EXPECT_THAT(told("[[0, 0, 200, 180], [100, 0, 220, 100], [150, 100, 170, 80]]"), HasSubstr("cover all"));
  EXPECT_THAT(told("[[0, 0, 200, 180], [100, 0, 220, 100], [150, 101, 170, 79], [0, 0, 320, 100]]"),
              IsEmpty());
}

// 30 pictures of 8 MB each, which would not fit into what the program may have beside its libraries.
TEST_F(SuiteTrouble, AcceptingManyPicturesTakesTheMemoryOfAFew) {
  if (kIsSanitized) GTEST_SKIP() << "the sanitizer keeps what is given back";
  std::string poses;
  for (int i = 0; i < 30; ++i)
    poses += "  p" + std::to_string(i) + ": [0, " + std::to_string(0.1 * i) + "]\n";
  write("many.yaml", "model: rr.urdf\nsize: 1920x1080\nposes:\n" + poses);
  const auto largest = [&](const Words& more) {
    rusage after = {};
    EXPECT_EQ(verify(chainreel::with({"--jobs", "1", "--quiet"}, more), "many.yaml").status, 0);
    getrusage(RUSAGE_CHILDREN, &after);
    return after.ru_maxrss;  // KiB, of the largest child so far
  };
  const long few = largest({"--missing", "write", "--filter", "p1"});
  EXPECT_LT(largest({"--missing", "write"}), few + 120 * 1024) << "half of what all of them take";
}

TEST_F(SuiteTrouble, AForceThatLeavesTheMotionIsNotToldByItsRoundOff) {
  std::string scene = read_whole_file("assets/scenes/pen.yaml");
  scene.replace(scene.find("../../models/"), 13, "");
  scene.replace(scene.find("duration: 8"), 11, "duration: 4");
  write("rrr.urdf", read_whole_file("models/rrr.urdf"));
  // The force changes the torques, and with them what `method: auto` would take.
  write("pen.yaml", scene + "\nmethod: radau5\ntolerance: 2e-5\n");  // what its iteration leaves is told, and no more than rounding
  write("s.yaml", "scene: pen.yaml\nsize: 160x96\nat: 0\n");
  accept_all("s.yaml");
  replace("pen.yaml", "[0, -5]", "[0, -20]");
  const Json words = picture(results({}, "s.yaml"), "0s")["words"];
  EXPECT_EQ(words[0], "contact_force.1.force.2 -5 -> -20");
  EXPECT_THAT(words[1].get<std::string>(), testing::StartsWith("the motion is the same but for rounding: q"));
}

TEST_F(SuiteTrouble, ARecordThatIsNoneIsToldWithItsPictureAndARemedy) {
  accept_all();
  for (const auto& [name, bytes] : baselines()) {
    if (!name.starts_with("records/") || name.ends_with("cameras.json")) continue;
    Json record = parse_json(bytes);
    record["links"] = 3;
    const std::string text = record.dump(), id = sha256_of(text).substr(0, 16);
    write("arm.baselines/records/" + id + ".json", text);
    replace("arm.baselines/home.json", fs::path(name).stem().string(), id);
  }
  const std::string told = words(results(), "home");
  EXPECT_THAT(told, AllOf(HasSubstr("arm.baselines/home.json: is no record of a model"), HasSubstr("--accept home")));
  EXPECT_THAT(told, Not(HasSubstr("exception")));
  EXPECT_EQ(verify({"--accept", "home"}).status, 0);
}

// What is said to be typed can be, whatever the suite is called, and services are given text.
TEST_F(SuiteTrouble, NamesOfSuitesNeitherSpoilReportsNorCommands) {
  for (const std::string name : {"-x.yaml", "a `b` $(c) <b>.yaml", "``` \n.yaml", "no\xfftext.yaml"}) {
    write(name, read_whole_file(file("arm.yaml")));
    const Words reports{"--markdown", "out/a.md", "--junit", "out/a.xml", "--html", "out/a.html", "--json"};
    const ProgramResult result =
        run_program(chainreel::with({"verify"}, chainreel::with(reports, {"--", name})),
                    {.folder = folder_.path().string()});
    EXPECT_EQ(result.status, 1) << name << result.err;
    const Json json = parse_json(result.out);
    ASSERT_TRUE(json.is_object()) << name;
    tinyxml2::XMLDocument xml;
    EXPECT_EQ(xml.LoadFile(file("out/a.xml").c_str()), tinyxml2::XML_SUCCESS) << name;
    const std::string markdown = read_whole_file(file("out/a.md"));
    for (const char* bad : {"<b>.yaml: ", "\xff"}) EXPECT_THAT(markdown, Not(HasSubstr(bad))) << name;
    if (name.find('\xff') != std::string::npos) continue;  // JSON holds no such name
    std::string command = json["accept"].get<std::string>();
    EXPECT_THAT(markdown, HasSubstr("\n" + command + "\n```"));
    ASSERT_TRUE(command.starts_with("chainreel "));
    command.replace(0, 9, program_path());
    EXPECT_EQ(run_command({"sh", "-c", command}, {.folder = folder_.path().string()}).status, 0) << command;
  }
}

TEST_F(SuiteTrouble, OfAnotherSizeNoPixelsAreExpected) {
  accept_all();
  replace("arm.yaml", "320x180", "400x300");
  EXPECT_THAT(words(results(), "home"), Not(HasSubstr("very pixels")));
}

TEST_F(SuiteTrouble, WordsAboutSuitesAreNotAboutScenes) {
  write("two.yaml", "model: rr.urdf\n---\nmodel: rr.urdf\n");
  write("large.yaml", "model: rr.urdf\n#" + std::string(1 << 20, 'x'));
  write("deep.yaml", "model: " + std::string(99, '[') + std::string(99, ']') + "\n");
  for (const auto& [suite, status] : {std::pair("two.yaml", 3), {"large.yaml", 7}, {"deep.yaml", 3}}) {
    const ProgramResult result = verify({}, suite);
    EXPECT_EQ(result.status, status) << suite;
    EXPECT_THAT(result.err, Not(HasSubstr("scene"))) << suite;
  }
}

}  // namespace
}  // namespace chainreel
