// Suites of pictures against what they were accepted with.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <tinyxml2.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "app/verify_suite.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "encode/png.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

extern char** environ;

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST_F(Verify, FailsWithoutBaselinesAndSaysHowTheyAreMade) {
  const ProgramResult result = verify();
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("missing   home"));
  EXPECT_THAT(result.out, HasSubstr("--missing write"));
  EXPECT_THAT(baselines(), IsEmpty());
}

TEST_F(Verify, PassesWhatItWroteAndLeavesItAlone) {
  accept_all();
  const auto before = baselines();
  EXPECT_THAT(before, Contains(testing::Key("home.png")));
  const Json json = results();
  EXPECT_EQ(json["failed"], 0);
  for (const Json& one : json["pictures"]) EXPECT_EQ(one["state"], "same") << one.dump(1);
  EXPECT_EQ(baselines(), before);
}

TEST_F(Verify, NamesAMassThatNoPictureShows) {
  accept_all();
  replace("rr.urdf", "<mass value=\"1\"/>", "<mass value=\"1.01\"/>");
  const Json json = results();
  EXPECT_EQ(json["failed"], 3);
  EXPECT_EQ(picture(json, "up")["state"], "physics");
  EXPECT_THAT(words(json, "up"), HasSubstr("link1"));
  EXPECT_THAT(words(json, "up"), HasSubstr("mass 1 -> 1.01 kg"));
  // Where the suite says so, that is told and passes.
  replace("arm.yaml", "size:", "physics: note\nsize:");
  EXPECT_EQ(verify().status, 0);
}

// A payload is part of the mechanism, also where the suite says so: no picture of bars shows its mass.
TEST_F(Verify, NamesAPayloadThatASuiteChanges) {
  write("loads.yaml", "model: rr.urdf\nposes: {p: [0, 0]}\nsize: 160x90\nvariants: {none: {payload.mass: 0}, heavy: {payload.mass: 3}}\n");
  ASSERT_EQ(verify({"--missing", "write"}, "loads.yaml").status, 0);
  EXPECT_EQ(verify({}, "loads.yaml").status, 0);
  const auto state_with = [&](const std::string& before, const std::string& after, const std::string& words_in) {
    replace("loads.yaml", before, after);
    const ProgramResult result = verify({}, "loads.yaml");
    EXPECT_EQ(result.status, 1) << after;
    EXPECT_THAT(result.out, HasSubstr(words_in)) << after;
    EXPECT_THAT(result.out, Not(HasSubstr("pixels  "))) << after;
    replace("loads.yaml", after, before);
  };
  state_with("payload.mass: 3", "payload.mass: 50", "payload 3 kg at 0 0 0 of gripper -> 50 kg at 0 0 0 of gripper");
  state_with("payload.mass: 3", "payload.mass: 3, payload.link: link1", "of gripper -> 3 kg at 0 0 0 of link1");
  state_with("payload.mass: 0}", "payload.mass: 1}", "payload none -> 1 kg");
  EXPECT_EQ(verify({}, "loads.yaml").status, 0);
}

TEST_F(Verify, NamesAJointThatMoved) {
  accept_all();
  replace("rr.urdf", "<origin xyz=\"1 0 0\"/>\n    <parent link=\"link1", "<origin xyz=\"1.02 0 0\"/>\n    <parent link=\"link1");
  const Json json = results();
  EXPECT_EQ(picture(json, "bent")["state"], "changed");
  EXPECT_THAT(words(json, "bent"), HasSubstr("origin moved by"));
  EXPECT_GT(picture(json, "bent")["pixels"]["beyond"], 0);
}

TEST_F(Verify, NamesAPoseThatChanged) {
  accept_all();
  replace("arm.yaml", "60deg", "61deg");
  const Json json = results();
  EXPECT_EQ(json["failed"], 1);
  EXPECT_EQ(picture(json, "bent")["state"], "changed");
  EXPECT_THAT(words(json, "bent"), HasSubstr("joint2"));
}

// What a longer arm does to the picture is that it is longer: the camera is that of the baselines.
TEST_F(Verify, DoesNotMoveTheCameraWithTheRobot) {
  accept_all();
  replace("rr.urdf", "<origin xyz=\"1 0 0\"/>\n    <parent link=\"link1", "<origin xyz=\"1.004 0 0\"/>\n    <parent link=\"link1");
  EXPECT_EQ(verify({"-o", "shown"}).status, 1);
  const Image before = read_png(folder_.file("shown/home.expected.png")), after = read_png(folder_.file("shown/home.actual.png"));
  // Everything left of the second joint stands where it stood.
  int moved = 0;
  for (int y = 0; y < before.height; ++y)
    for (int x = 0; x < before.width * 2 / 5; ++x) moved += before.at(x, y) != after.at(x, y);
  EXPECT_EQ(moved, 0);
  EXPECT_EQ(verify({"--accept", "--refit"}).status, 0);
  EXPECT_EQ(verify().status, 0);
}

TEST_F(Verify, SaysWhereTheCameraCutsSomethingOff) {
  accept_all();
  replace("rr.urdf", "<origin xyz=\"1 0 0\"/>\n    <parent link=\"link1", "<origin xyz=\"3 0 0\"/>\n    <parent link=\"link1");
  EXPECT_THAT(words(results(), "home"), HasSubstr("--accept --refit"));
  // So it is said of what is accepted all the same.
  EXPECT_THAT(verify({"--accept", "home"}).out, HasSubstr("accepted  home\n          it is cut off at the edge"));
}

// Of a picture without a baseline, too, before it is accepted.
TEST_F(Verify, SaysWhereTheCameraCutsANewPictureOff) {
  accept_all();
  fs::remove(folder_.file("arm.baselines/home.png"));
  const ProgramResult whole = verify();
  EXPECT_THAT(whole.out, testing::Not(HasSubstr("cut off at the edge")));
  replace("rr.urdf", "<origin xyz=\"1 0 0\"/>\n    <parent link=\"link1", "<origin xyz=\"3 0 0\"/>\n    <parent link=\"link1");
  EXPECT_THAT(words(results(), "home"), testing::AllOf(HasSubstr("there is no baseline"), HasSubstr("cut off at the edge")));
}

TEST_F(Verify, AcceptsWhatIsNamedAndNothingElse) {
  accept_all();
  const auto before = baselines();
  replace("arm.yaml", "[90deg, 0]", "[80deg, 0]");
  replace("arm.yaml", "60deg", "61deg");
  EXPECT_EQ(verify({"--accept", "up"}).status, 1);  // the other one still differs
  const auto after = baselines();
  EXPECT_NE(after.at("up.png"), before.at("up.png"));
  EXPECT_EQ(after.at("bent.png"), before.at("bent.png"));
  const Json json = results();
  EXPECT_EQ(picture(json, "up")["state"], "same");
  EXPECT_EQ(picture(json, "bent")["state"], "changed");
  const ProgramResult unknown = verify({"--accept", "ap"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'up'"));
}

// Both themes, and a scene with two forces: a baseline each, and each is judged by its own.
TEST_F(Verify, ShowsEachSourceOnceAVariant) {
  write("both.yaml", "model: rr.urdf\nsize: 160x90\nposes: {home: [0, 0]}\ntheme: [light, dark]\n");
  accept_all("both.yaml");
  const auto files = baselines("both");
  EXPECT_NE(files.at("home_light.png"), files.at("home_dark.png"));
  EXPECT_EQ(verify({}, "both.yaml").status, 0);
  // A pose's name stands for all of its pictures.
  write("both.yaml", "model: rr.urdf\nsize: 160x90\nposes: {home: [10deg, 0]}\ntheme: [light, dark]\n");
  EXPECT_EQ(verify({}, "both.yaml").status, 1);
  EXPECT_EQ(verify({"--accept", "home"}, "both.yaml").out, "accepted  home_light\naccepted  home_dark\n2 pictures passed: 2 accepted\n");
  EXPECT_THAT(verify({"--accept", "ho*"}, "both.yaml").err, HasSubstr("patterns go with --filter"));
  write("swing.yaml", "model: rr.urdf\nparameters: {F: 1}\ntorque: [F, 0]\nduration: 1\n");
  const std::string suite = "scene: swing.yaml\nsize: 160x90\nat: 1s\nvariants:\n  weak: {theme: light}\n  strong: {parameters.F: ";
  write("swings.yaml", suite + "20}\n");
  accept_all("swings.yaml");
  EXPECT_NE(baselines("swings").at("1s_weak.png"), baselines("swings").at("1s_strong.png"));
  write("swings.yaml", suite + "21}\n");
  const Json json = results({}, "swings.yaml");
  EXPECT_EQ(picture(json, "1s_weak")["state"], "same");
  EXPECT_EQ(picture(json, "1s_strong")["state"], "changed");
  EXPECT_EQ(picture(json, "1s_strong")["source"], "swing.yaml (strong)");
  EXPECT_THAT(words(json, "1s_strong"), HasSubstr("parameters.F 20 -> 21"));
}

TEST_F(Verify, NamesUnusedBaselinesAndPrunesThemWhenAsked) {
  accept_all();
  replace("arm.yaml", ", bent: [30deg, 60deg]", "");
  EXPECT_THAT(results({"--html", "page.html", "--markdown", "page.md"})["unused"], ElementsAre("bent"));
  for (const char* report : {"page.html", "page.md"})
    EXPECT_THAT(read_whole_file(folder_.file(report)), HasSubstr("of no picture any more: the baseline bent; --prune removes it")) << report;
  EXPECT_THAT(baselines(), Contains(testing::Key("bent.png")));
  EXPECT_THAT(results({"--prune"})["pruned"], ElementsAre("bent"));
  EXPECT_THAT(baselines(), Not(Contains(testing::Key("bent.png"))));
  EXPECT_EQ(verify().status, 0);
}

// Other physics give other pixels: where physics are a note, those are weighed, as anti-aliasing is.
TEST_F(Verify, WherePhysicsAreANoteAnotherStepMayMoveEdges) {
  write("swing.yaml", "model: rr.urdf\nduration: 1\nmethod: rk4\nstep: 0.01\n");
  write("swing_suite.yaml", "scene: swing.yaml\nsize: 320x180\nat: 1s\nphysics: note\n");
  accept_all("swing_suite.yaml");
  replace("swing.yaml", "step: 0.01", "step: 0.02");
  const Json json = results({}, "swing_suite.yaml");
  EXPECT_EQ(picture(json, "1s")["state"], "changed") << json.dump(1);
  EXPECT_EQ(picture(json, "1s")["passed"], true) << json.dump(1);
  replace("swing.yaml", "step: 0.02", "step: 0.02\nstart: {q: [10deg, 0]}");
  EXPECT_EQ(picture(results({}, "swing_suite.yaml"), "1s")["passed"], false);
}

// Scenes that come with the program by name, all pictures of one accepted by it, and edges counted where asked.
TEST_F(Verify, TakesShippedScenesByNameAndCountsEdgesWhereAsked) {
  write("swing.yaml", "model: rr.urdf\nduration: 1\nmethod: rk4\nstep: 0.01\n");
  write("two.yaml", "scene: [rr_free, swing.yaml]\nsize: 320x180\nat: [0.5s, 1s]\nphysics: note\n");
  accept_all("two.yaml");
  EXPECT_TRUE(baselines("two").contains("rr_free_1s.png"));
  replace("swing.yaml", "step: 0.01", "step: 0.02");
  EXPECT_EQ(picture(results({}, "two.yaml"), "swing_1s")["passed"], true) << "as anti-aliasing may differ";
  replace("two.yaml", "physics: note", "physics: note\ntolerance: {error: 0, count_edges: true}");
  const Json json = results({}, "two.yaml");
  EXPECT_EQ(picture(json, "swing_1s")["passed"], false) << json.dump(1);
  EXPECT_EQ(picture(json, "rr_free_1s")["passed"], true);
  EXPECT_THAT(picture(json, "swing_1s")["tolerance"].get<std::string>(), HasSubstr("edges counted"));
  EXPECT_EQ(verify({"--accept", "swing"}, "two.yaml").status, 0) << "all of that scene";
  EXPECT_EQ(verify({}, "two.yaml").status, 0);
  write("none.yaml", "scene: rr_fre\nsize: 320x180\n");
  EXPECT_EQ(verify({}, "none.yaml").status, 3);
}

TEST_F(Verify, TakesAnotherStepForNoChangeOfTheMotionWhereAsked) {
  write("swing.yaml", "model: rr.urdf\nduration: 1\nmethod: rk4\nstep: 0.01\n");
  write("swing_suite.yaml", "scene: swing.yaml\nsize: 320x180\nat: 1s\nphysics: motion\n");
  accept_all("swing_suite.yaml");
  const auto passes = [&] { return picture(results({}, "swing_suite.yaml"), "1s")["passed"].get<bool>(); };
  replace("swing.yaml", "step: 0.01", "step: 0.02");
  EXPECT_TRUE(passes());
  // A start that is off by less than an edge of a pixel shows is another motion all the same.
  replace("swing.yaml", "duration: 1", "start: {q: [0.2deg, 0]}\nduration: 1");
  EXPECT_FALSE(passes());
  replace("swing.yaml", "start: {q: [0.2deg, 0]}\n", "");
  replace("swing.yaml", "method: rk4\nstep: 0.02", "method: explicit_euler\nstep: 0.02");
  EXPECT_FALSE(passes()) << "that method moves it elsewhere";
}

TEST_F(Verify, LooksAtThePicturesThatAFilterNames) {
  accept_all();
  replace("arm.yaml", "60deg", "61deg");
  EXPECT_EQ(verify({"--filter", "[hu]*"}).status, 0);
  EXPECT_THAT(verify({"--filter", "[hu]*"}).err, testing::ContainsRegex("--filter leaves [0-9]+ of [0-9]+ pictures out"));
  EXPECT_EQ(verify({"--filter", "b*"}).status, 1);
  EXPECT_EQ(verify({"--filter", "none*"}).status, 2);
}

TEST_F(Verify, TellsABaselineThatCannotBeUsed) {
  accept_all();
  const fs::path home = folder_.path() / "arm.baselines/home.png", up = folder_.path() / "arm.baselines/up.png";
  const std::string good = read_whole_file(home);
  write("arm.baselines/home.png", "no picture");
  EXPECT_EQ(picture(results(), "home")["state"], "baseline");
  write("arm.baselines/home.png", read_whole_file(up));  // a picture, but not this one
  EXPECT_THAT(words(results(), "home"), HasSubstr("was changed since it was accepted"));
  write("arm.baselines/home.png", good);
  replace("arm.baselines/home.json", "\"suite\": \"arm.yaml\"", "\"suite\": \"other\"");
  EXPECT_THAT(words(results(), "home"), HasSubstr("belongs to the suite"));
  fs::remove(folder_.path() / "arm.baselines/home.json");
  EXPECT_THAT(words(results(), "home"), HasSubstr("is missing beside the picture"));
  // The others are looked at all the same, and accepting mends it.
  EXPECT_EQ(results()["failed"], 1);
  EXPECT_EQ(verify({"--accept", "home"}).status, 0);
}

TEST_F(Verify, TellsOtherPixelsOfTheSamePhysicsApart) {
  accept_all();
  // As another renderer would have left it: one pixel by little, then a square that is missing.
  const auto edit = [&](auto change) {
    const std::string path = folder_.file("arm.baselines/home.png");
    Image image = read_png(path);
    const auto text = read_png_text(path);
    change(image);
    write_png(path, image, text);
    Json facts = parse_json(read_whole_file(folder_.file("arm.baselines/home.json")));
    facts["png_sha256"] = sha256_of(read_whole_file(path));
    write("arm.baselines/home.json", facts.dump(1) + "\n");
  };
  edit([](Image& image) { image.bgra[0] = std::uint8_t(image.bgra[0] - 4); });
  // The same renderer gives the same pixels; another one may differ by what nobody sees.
  EXPECT_EQ(picture(results(), "home")["state"], "pixels");
  Json facts = parse_json(read_whole_file(folder_.file("arm.baselines/home.json")));
  facts["page"]["renderer"] = "another one";
  write("arm.baselines/home.json", facts.dump(1) + "\n");
  EXPECT_EQ(picture(results(), "home")["state"], "rendered");
  EXPECT_THAT(words(results(), "home"), HasSubstr("renderer: another one -> "));
  EXPECT_EQ(verify().status, 0);
  edit([](Image& image) {
    for (int y = image.height / 2; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < 3; ++c) image.bgra[std::size_t(4 * (y * image.width + x) + c)] = 255;
  });
  const Json json = results();
  EXPECT_EQ(picture(json, "home")["state"], "pixels");
  EXPECT_THAT(words(json, "home"), HasSubstr("there: "));
  EXPECT_THAT(picture(json, "home")["tolerance"].get<std::string>(), HasSubstr("default"));
  // A mask over it, and a tolerance that lets it pass; both say where they were set.
  replace("arm.yaml", "size:", "masks: [[0, 90, 320, 90]]\nsize:");
  EXPECT_EQ(verify().status, 0);
}

TEST_F(Verify, NamesWhatTheSuiteItselfSaysOfTheLook) {
  accept_all();
  replace("arm.yaml", "size:", "theme: dark\nsize:");
  const Json json = results();
  EXPECT_EQ(picture(json, "home")["state"], "pixels");
  EXPECT_THAT(words(json, "home"), HasSubstr("theme: light -> dark"));
  EXPECT_THAT(words(json, "home"), HasSubstr("the suite now says theme=dark"));
}

// Bars have no colours of the file: a suite that lets other physics pass says so, and which key shows them.
TEST_F(Verify, SaysThatBarsDoNotShowAColourOfTheModel) {
  write("swing.yaml", "model: rr.urdf\nmethod: rk4\nduration: 0.2\n");
  const auto suite = [&](const std::string& more) {
    write("arm.yaml", "model: rr.urdf\nscene: swing.yaml\nsize: 320x180\nposes: {home: [0, 0]}\nat: 0.1s\nphysics: note\n" + more);
    accept_all();
    replace("rr.urdf", "0.902 0.624 0.000 1", "0.100 0.900 0.100 1");
    const Json json = results();
    replace("rr.urdf", "0.100 0.900 0.100 1", "0.902 0.624 0.000 1");
    return json;
  };
  const Json bars = suite("");
  ASSERT_EQ(bars["pictures"].size(), 2u);
  for (const Json& one : bars["pictures"]) {
    EXPECT_EQ(one["state"], "looks") << one;
    EXPECT_TRUE(one["passed"].get<bool>()) << one;
    EXPECT_THAT(one["words"].dump(), HasSubstr("`links: visual` in the suite shows them")) << one;
  }
  std::filesystem::remove_all(folder_.path() / "arm.baselines");
  const Json shapes = suite("links: visual\n");
  ASSERT_EQ(shapes["pictures"].size(), 2u);
  for (const Json& one : shapes["pictures"]) {
    EXPECT_EQ(one["state"], "looks") << one;
    EXPECT_FALSE(one["passed"].get<bool>()) << one;
    EXPECT_THAT(one["words"].dump(), Not(HasSubstr("bars"))) << one;
  }
  // A mass that differs is no matter of looks.
  write("arm.yaml", "model: rr.urdf\nsize: 320x180\nposes: {home: [0, 0]}\n");
  std::filesystem::remove_all(folder_.path() / "arm.baselines");
  accept_all();
  replace("rr.urdf", "<mass value=\"1\"/>", "<mass value=\"2\"/>");
  EXPECT_THAT(words(results(), "home"), Not(HasSubstr("bars")));
}

// The ambient shade of shapes is that of all poses within the limits, of which a report has to speak.
TEST_F(Verify, SaysThatShapesShowLimits) {
  const std::string box = "<visual><geometry><box size=\"0.3 0.2 0.1\"/></geometry></visual>";
  write("box.urdf", "<robot name=\"b\"><link name=\"base\">" + box + "</link><link name=\"arm\">" + box +
                        "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
                        "<joint name=\"j\" type=\"revolute\"><parent link=\"base\"/><child link=\"arm\"/><origin xyz=\"0.2 0 0.06\"/><axis xyz=\"0 1 0\"/>"
                        "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint></robot>");
  write("boxes.yaml", "model: box.urdf\nsize: 320x180\nlinks: visual\nposes: {bent: [0.3]}\n");
  accept_all("boxes.yaml");
  replace("box.urdf", "upper=\"1\"", "upper=\"0.4\"");
  EXPECT_THAT(words(results({}, "boxes.yaml"), "bent"), HasSubstr("limits are seen, too"));
  replace("box.urdf", "upper=\"0.4\"", "upper=\"1\"");
  replace("box.urdf", "effort=\"1\"", "effort=\"2\"");
  EXPECT_THAT(words(results({}, "boxes.yaml"), "bent"), Not(HasSubstr("limits are seen"))) << "an effort shades nothing";
}

// A title moves nothing, and no state but that of looks says so; a title beside another mass is no matter of looks.
TEST_F(Verify, TellsAnotherTitleFromAnotherMotion) {
  write("swing.yaml", "title: A swing\nmodel: rr.urdf\nduration: 1\n");
  write("swings.yaml", "scene: swing.yaml\nsize: 320x180\nat: 1s\n");
  accept_all("swings.yaml");
  replace("swing.yaml", "A swing", "Another swing");
  Json json = results({}, "swings.yaml");
  EXPECT_EQ(picture(json, "1s")["state"], "looks");
  EXPECT_EQ(picture(json, "1s")["passed"], false);
  EXPECT_THAT(words(json, "1s"), HasSubstr("title: A swing -> Another swing"));
  replace("swing.yaml", "duration: 1", "duration: 1\nstart: {q: [1deg, 0]}");
  EXPECT_EQ(picture(results({}, "swings.yaml"), "1s")["state"], "changed");
  replace("swing.yaml", "\nstart: {q: [1deg, 0]}", "");
  replace("rr.urdf", "<mass value=\"1\"/>", "<mass value=\"2\"/>");
  EXPECT_EQ(picture(results({}, "swings.yaml"), "1s")["state"], "changed");
}

// A report of an earlier run is not left to speak for one that could not begin.
TEST_F(Verify, ReportsTheErrorThatKeptItFromDrawing) {
  const Words reports{"--junit", folder_.file("r.xml"), "--html", folder_.file("r.html"), "--markdown", folder_.file("r.md")};
  accept_all();
  EXPECT_EQ(verify(reports).status, 0);
  EXPECT_THAT(read_whole_file(folder_.file("r.xml")), HasSubstr("failures=\"0\" errors=\"0\""));
  write("rr.urdf", "<robot");
  EXPECT_EQ(verify(reports).status, 3);
  EXPECT_THAT(read_whole_file(folder_.file("r.xml")), AllOf(HasSubstr("errors=\"1\""), HasSubstr("rr.urdf")));
  EXPECT_THAT(read_whole_file(folder_.file("r.md")), AllOf(HasSubstr("rr.urdf"), Not(HasSubstr("--accept"))));
  EXPECT_THAT(read_whole_file(folder_.file("r.html")), HasSubstr("rr.urdf"));
  // Nobody else's file is touched, and a command that was mistyped says nothing of the suite.
  folder_.write("r.md", "notes");
  EXPECT_EQ(verify(reports).status, 3);
  EXPECT_EQ(read_whole_file(folder_.file("r.md")), "notes");
  folder_.write("r.xml", "");
  EXPECT_EQ(verify(chainreel::with(reports, {"--refit"})).status, 2);
  EXPECT_EQ(read_whole_file(folder_.file("r.xml")), "");
}

TEST_F(Verify, RefusesToComparePicturesOfTwoSizes) {
  accept_all();
  replace("arm.yaml", "320x180", "640x360");
  const Json json = results();
  EXPECT_EQ(picture(json, "home")["state"], "size");
  EXPECT_THAT(words(json, "home"), HasSubstr("320 x 180 pixels, the picture 640 x 360"));
}

TEST_F(Verify, TellsAPictureThatCannotBeDrawnAndGoesOn) {
  write("swing.yaml", "model: rr.urdf\ntorque: [0, 0]\nduration: 1\nmethod: rk4\nstep: 0.01\nevents: [{name: down, when: q1 < -0.5}]\n");
  write("both.yaml", "scene: swing.yaml\nsize: 320x180\nat: [0, 0.5s, event down]\n");
  accept_all("both.yaml");
  replace("swing.yaml", "q1 < -0.5", "q1 < -50");
  const Json json = results({}, "both.yaml");
  EXPECT_EQ(json["failed"], 3);
  int failed = 0;
  for (const Json& one : json["pictures"]) failed += one["state"] == "failed";
  EXPECT_EQ(failed, 1);
}

// A picture of a suite and one made alone are told of one film: its held frames, and events of all of its panels.
TEST_F(Verify, SaysOfAFilmWhatASnapshotSays) {
  write("two.yaml",
        "model: rr.urdf\nduration: 1\nmethod: rk4\nstep: 0.01\ntorque: [0, 0]\nhold: {first: 0.5}\n"
        "events: [{name: down, when: q1 < -0.5}]\n"
        "compare: [{start: {q: [0.4, 0]}}, {start: {q: [0, 0]}}]\n");
  write("both.yaml", "scene: two.yaml\nsize: 320x180\nat: [event down]\n");
  accept_all("both.yaml");
  ASSERT_EQ(run_program({"snapshot", "two.yaml", "--at", "event down", "--width", "320", "--height", "180", "-o", "one.png"},
                        {.folder = folder_.path().string()})
                .status,
            0);
  std::string name;
  for (const auto& [file, bytes] : baselines("both"))
    if (file.ends_with(".png")) name = file;
  const auto audit = [](const std::string& path) { return parse_json(read_png_text(path).at("chainreel_audit")); };
  const Json suite = audit(folder_.file("both.baselines/" + name)), alone = audit(folder_.file("one.png"));
  EXPECT_EQ(suite["at"], alone["at"]);
  EXPECT_EQ(suite["frames"], alone["frames"]);
}

TEST_F(Verify, NamesWhatChangedInARun) {
  write("swing.yaml", "model: rr.urdf\ntorque: [0, 1]\nduration: 1\nmethod: rk4\nstep: 0.01\n");
  write("motion.yaml", "scene: swing.yaml\nsize: 320x180\nat: [0, 0.9s]\n");
  accept_all("motion.yaml");
  replace("swing.yaml", "rk4", "dop853");
  std::string said = results({}, "motion.yaml").dump();
  EXPECT_THAT(said, HasSubstr("method rk4 -> dop853"));
  replace("swing.yaml", "dop853", "rk4");
  EXPECT_EQ(verify({}, "motion.yaml").status, 0);
  replace("swing.yaml", "[0, 1]", "[0, 1.01]");
  said = results({}, "motion.yaml").dump();
  EXPECT_THAT(said, HasSubstr("torque"));
}

TEST_F(Verify, TakesAFolderOfScenes) {
  write("films/rr.urdf", read_whole_file("models/rr.urdf"));
  for (const char* name : {"a", "b"})
    write(std::string("films/") + name + ".yaml",
          "model: rr.urdf\ntorque: [0, 0]\nduration: 0.5\nmethod: rk4\nstep: 0.01\nvideo: {width: 320, height: 180}\n");
  accept_all("films/");
  EXPECT_THAT(baselines("films/snapshots"), Contains(testing::Key("a.png")));
  EXPECT_EQ(verify({}, "films").status, 0);

  fs::copy(folder_.path() / "films", folder_.path() / "cloned", fs::copy_options::recursive);
  EXPECT_EQ(verify({}, "cloned").status, 0) << "under another name";

  // One that cannot be read fails by itself.
  replace("films/b.yaml", "method: rk4", "metod: rk4");
  const Json results = this->results({}, "films");
  EXPECT_EQ(picture(results, "a")["state"], "same");
  EXPECT_EQ(picture(results, "b")["state"], "failed");
  EXPECT_THAT(words(results, "b"), HasSubstr("metod"));
  EXPECT_EQ(verify({}, "films").status, 1);
  // Where none can be read there is no suite.
  fs::remove(folder_.path() / "films/rr.urdf");
  replace("films/a.yaml", "method: rk4", "metod: rk4");
  EXPECT_EQ(verify({}, "films").status, 3);
}

TEST_F(Verify, IsTheSameOnOneThreadAndOnSeveral) {
  accept_all();
  const auto one = baselines();
  fs::remove_all(folder_.path() / "arm.baselines");
  EXPECT_EQ(verify({"--missing", "write", "--jobs", "3"}).status, 0);
  EXPECT_EQ(baselines(), one);
  const std::string told = verify({"--jobs", "1"}).out;
  for (int time = 0; time < 3; ++time) EXPECT_EQ(verify({"--jobs", "3"}).out, told) << "in the suite's order";
}

TEST_F(Verify, ReportsForServicesAreWellFormedAndSayEverything) {
  accept_all();
  replace("rr.urdf", "<mass value=\"1\"/>", "<mass value=\"1.01\"/>");
  const ProgramResult result = verify({"--junit", "junit.xml", "--markdown", "summary.md", "--html", "report.html"});
  EXPECT_EQ(result.status, 1);
  tinyxml2::XMLDocument junit;
  ASSERT_EQ(junit.LoadFile(folder_.file("junit.xml").c_str()), tinyxml2::XML_SUCCESS);
  const tinyxml2::XMLElement* suite = junit.FirstChildElement("testsuites")->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("tests"), 3);
  EXPECT_EQ(suite->IntAttribute("failures"), 3);
  EXPECT_THAT(suite->FirstChildElement("testcase")->FirstChildElement("failure")->Attribute("message"), HasSubstr("mass"));
  EXPECT_THAT(read_whole_file(folder_.file("summary.md")), HasSubstr("| home | physics | "));
  EXPECT_THAT(read_whole_file(folder_.file("report.html")), HasSubstr("1.01 kg"));
  EXPECT_THAT(result.out, HasSubstr("chainreel verify arm.yaml --accept home up bent"));
}

TEST_F(Verify, WaitsForAnotherOneThatWrites) {
  accept_all();
  // Two that accept at once: both end well, and the baselines are whole.
  const ProgramResult both = run_command(
      {"sh", "-c", "\"$0\" verify arm.yaml --accept --quiet & \"$0\" verify arm.yaml --accept --quiet; r=$?; wait $! && exit $r", program_path()},
      {.folder = folder_.path().string()});
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_EQ(verify().status, 0);
}

// Killed at many instants, accepting leaves the old baselines or the new ones.
TEST_F(Verify, KilledWhileItAcceptsLeavesOldOrNew) {
  accept_all();
  const auto old = baselines();
  replace("arm.yaml", "[0, 0]", "[5deg, 0]");
  replace("arm.yaml", "[90deg, 0]", "[80deg, 0]");
  const std::string program = program_path(), folder = folder_.path().string();
  std::map<std::string, std::string> fresh;
  int seen_new = 0;
  for (int wait_ms = 40; wait_ms <= 400; wait_ms += 24) {
    const std::string line = "cd '" + folder + "' && exec '" + program + "' verify arm.yaml --accept --quiet";
    const char* arguments[] = {"sh", "-c", line.c_str(), nullptr};
    pid_t child = 0;
    ASSERT_EQ(posix_spawn(&child, "/bin/sh", nullptr, nullptr, const_cast<char**>(arguments), environ), 0);
    ::usleep(useconds_t(wait_ms) * 1000);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    const auto now = baselines();
    if (now == old) continue;
    if (fresh.empty()) fresh = now;
    EXPECT_EQ(now, fresh) << wait_ms;
    EXPECT_EQ(verify().status, 0);
    ++seen_new;
    break;
  }
  if (seen_new == 0) {
    EXPECT_EQ(verify({"--accept"}).status, 0);
  }
  // What was left lying is gone with the next change.
  EXPECT_EQ(verify({"--accept"}).status, 0);
  int hidden = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path()))
    hidden += entry.path().filename().string().starts_with(".chainreel");
  EXPECT_EQ(hidden, 0);
}

TEST_F(Verify, OfAFolderThatCannotBeWrittenIsExitSix) {
  write("place", "a file where the baselines belong");
  fs::rename(folder_.path() / "place", folder_.path() / "arm.baselines");
  EXPECT_EQ(verify({"--missing", "write"}).status, 6);
  EXPECT_EQ(read_whole_file(folder_.path() / "arm.baselines"), "a file where the baselines belong");
}

TEST_F(Verify, RemovesNothingThatIsNotItsOwn) {
  accept_all();
  write("arm.baselines/records/notes.txt", "mine");
  write("arm.baselines/photo.png", "mine");
  write("arm.yml", "model: rr.urdf\nsize: 320x180\nposes: {other: [0, 0], camera: [1, 0]}\n");
  EXPECT_EQ(verify({"--missing", "write", "--prune"}, "arm.yml").status, 0);
  EXPECT_EQ(verify({"--accept", "--prune"}).status, 0);
  const auto files = baselines();
  for (const char* name : {"records/notes.txt", "photo.png", "other.png", "camera.png", "home.png"})
    EXPECT_TRUE(files.contains(name)) << name;
  EXPECT_EQ(verify().status, 0);
  EXPECT_EQ(verify({}, "arm.yml").status, 0);
}

TEST_F(Verify, ReplacesWhatItWroteBeforeAndNothingElse) {
  accept_all();
  replace("rr.urdf", "<mass value=\"1\"/>", "<mass value=\"1.1\"/>");
  const Words all = {"-o", "differences", "--junit", "j.xml", "--markdown", "s.md", "--html", "r.html"};
  ASSERT_EQ(verify(all).status, 1);
  const ProgramResult again = verify(all);
  EXPECT_EQ(again.status, 1) << again.err;
  EXPECT_THAT(again.out, HasSubstr("to take what is drawn now: "));
  for (const char* own : {"j.xml", "s.md", "r.html"}) {
    const std::string before = read_whole_file(folder_.file(own));
    write(own, "## Pictures of my holidays\n");
    const ProgramResult result = verify(all);
    EXPECT_EQ(result.status, 6) << own;
    EXPECT_THAT(result.err, HasSubstr(own));
    write(own, before);
  }
}

TEST_F(Verify, SurvivesFactsThatAreNone) {
  accept_all();
  replace("arm.baselines/home.json", "\"q\"", "\"zz\"");
  const Json json = results();
  EXPECT_EQ(picture(json, "home")["state"], "baseline");
  EXPECT_EQ(picture(json, "up")["state"], "same");
}

TEST_F(Verify, NeverWritesItsResultsOverBaselines) {
  accept_all();
  const auto before = baselines();
  EXPECT_EQ(verify({"--force", "--markdown", "arm.baselines/home.png"}).status, 2);
  EXPECT_EQ(verify({"-o", "arm.baselines"}).status, 2);
  EXPECT_EQ(verify({"--html", "a", "--junit", "a"}).status, 2);
  EXPECT_EQ(verify({"--accept", "home", "--refit"}).status, 2);
  EXPECT_EQ(baselines(), before);
}

TEST_F(Verify, FindsTheBaselinesOfTheFolderThatItStandsIn) {
  write("films/rr.urdf", read_whole_file("models/rr.urdf"));
  accept_all("films");
  EXPECT_EQ(run_program({"verify", "."}, {.folder = (folder_.path() / "films").string()}).status, 0);
  EXPECT_TRUE(fs::exists(folder_.path() / "films/snapshots.baselines/rr.png"));  // where the repository is that the folder may be
}

TEST_F(Verify, BaselinesDoNotDependOnThePlace) {
  accept_all();
  const TemporaryFolder other;
  for (const char* name : {"rr.urdf", "arm.yaml"}) other.write(std::string("deep/er/") + name, read_whole_file(folder_.path() / name));
  const ProgramResult result = run_program({"verify", other.file("deep/er/arm.yaml"), "--missing", "write"},
                                           {.folder = "/", .environment = {{"LC_ALL", "C.UTF-8"}, {"HOME", "/nowhere"}, {"TZ", "Asia/Tokyo"}}});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const auto& [name, bytes] : baselines()) EXPECT_EQ(read_whole_file(other.path() / "deep/er/arm.baselines" / name), bytes) << name;
}

}  // namespace
}  // namespace chainreel
