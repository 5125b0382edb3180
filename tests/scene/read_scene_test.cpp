#include "scene/text/read_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "scene/quantity.hpp"
#include "scene/text/scene_paths.hpp"
#include "scene/text/write_scene.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class ReadScene : public WrittenScenes {};

TEST_F(ReadScene, LeavesTheDefaultsOfTheStructWhereKeysAreAbsent) {
  const Scene scene = read("");
  const Scene defaults;
  EXPECT_EQ(scene.method, defaults.method);
  EXPECT_FALSE(scene.step);
  EXPECT_EQ(to_string(scene.accuracy), "0.1 px");
  EXPECT_EQ(scene.method, "auto");
  EXPECT_EQ(scene.duration, defaults.duration);
  EXPECT_EQ(scene.draw, defaults.draw);
  EXPECT_EQ(scene.video.width, 1920);
  EXPECT_EQ(scene.video.height, 1080);
  EXPECT_EQ(scene.video.fps, (FrameRate{60, 1}));
  EXPECT_FALSE(scene.gravity.has_value());
}

TEST_F(ReadScene, FindsTheModelRelativeToTheSceneFile) {
  EXPECT_EQ(read("").model, folder_.file("rr.urdf"));
}

TEST_F(ReadScene, ReadsEveryKey) {
  const Scene scene = read(
      "title: \"A title\"\ngravity: [1, -2, 3.5]\nstart: {q: [90deg, pi/2], qd: [-1e-3, +2]}\n"
      "torque: [1, \"max(q1, 2)\"]\nparameters: {k: 100, angle: 30deg}\nend_effector: tip\nduration: 2.5\n"
      "method: rk4\nstep: 0.01\ndraw: [chain, time]\ntheme: dark\ntext_scale: 1.5\nvideo: {width: 640, height: 360, fps: "
      "30000/1001}\n");
  EXPECT_EQ(scene.title, "A title");
  EXPECT_EQ(*scene.gravity, Eigen::Vector3d(1, -2, 3.5));
  EXPECT_THAT(scene.start.q, ElementsAre(std::numbers::pi / 2, std::numbers::pi / 2));
  EXPECT_THAT(scene.start.qd, ElementsAre(-1e-3, 2));
  ASSERT_EQ(scene.torque.size(), 2u);
  EXPECT_EQ(scene.torque[1].text, "max(q1, 2)");
  EXPECT_EQ(scene.torque[1].place.line, 5);
  EXPECT_EQ(scene.torque[1].place.column, 13);  // of the text, behind its quote
  EXPECT_EQ(scene.parameters[0], (std::pair<std::string, double>("k", 100)));
  EXPECT_EQ(scene.parameters[1].second, 30 * std::numbers::pi / 180);
  EXPECT_EQ(scene.end_effector, "tip");
  EXPECT_EQ(scene.duration, 2.5);
  EXPECT_EQ(scene.method, "rk4");
  EXPECT_EQ(scene.step, 0.01);
  EXPECT_THAT(scene.draw, ElementsAre("chain", "time"));
  EXPECT_EQ(scene.text_scale, 1.5);
  EXPECT_EQ(scene.theme, ThemeName::dark);
  EXPECT_EQ(scene.video.fps, (FrameRate{30000, 1001}));
}

TEST_F(ReadScene, EditsTheDefaultLayersByPlusAndMinus) {
  EXPECT_THAT(read("draw: [+ellipse, -trail]").draw,
              ElementsAre("chain", "time", "title", "torque_label", "ground", "constraints", "springs", "torque", "target", "g", "limits", "shadow", "push", "constraint_force", "ellipse"));
  EXPECT_THAT(error("draw: [+ellipse, trail]"), HasSubstr("do not mix"));
  EXPECT_THAT(error("draw: [+torques]"), HasSubstr("did you mean 'torque'?"));
  EXPECT_THAT(error("theme: drak"), HasSubstr("'theme' must be light or dark, not 'drak'"));
}

TEST_F(ReadScene, KnowsHowTheEllipseIsRead) {
  EXPECT_EQ(read("").ellipse.reading, EllipseReading::mass);
  EXPECT_EQ(read("ellipse: {reading: belt}").ellipse.reading, EllipseReading::belt);
  EXPECT_THAT(error("ellipse: {reading: tensor}"), HasSubstr("must be mass, energy or belt, not 'tensor'"));
  EXPECT_THAT(error("ellipse: belt"), HasSubstr("ellipse: {reading: belt}"));
  EXPECT_THAT(error("ellipse: {axes: 2}"), HasSubstr("unknown key 'ellipse.axes'"));
}

TEST_F(ReadScene, TakesOverridesByDottedKeyAndIndex) {
  const Scene scene =
      read("torque: [1, 2]\nvideo: {width: 640}\n",
           {"video.width=320", "video.fps=25", "torque.2=-3 * q1", "duration=0.5", "start.q=[1, 90deg]"});
  EXPECT_EQ(scene.video.width, 320);
  EXPECT_EQ(scene.video.fps.num, 25);
  EXPECT_EQ(scene.torque[1].text, "-3 * q1");
  EXPECT_EQ(scene.duration, 0.5);
  EXPECT_THAT(scene.start.q, ElementsAre(1, std::numbers::pi / 2));
}

TEST_F(ReadScene, BlamesTheCommandLineForAnOverride) {
  EXPECT_THAT(error("duration: 2\n", {"duration=-1"}),
              HasSubstr("--set duration=-1: 'duration' must be above 0 s"));
  EXPECT_THAT(error("", {"video.wdth=3"}), HasSubstr("--set video.wdth=3: unknown key 'video.wdth'"));
  EXPECT_THAT(error("torque: [1]", {"torque.3=1"}), HasSubstr("no index from 1 to 1"));
  EXPECT_THAT(error("", {"duration"}), HasSubstr("--set takes key=value"));
}

TEST_F(ReadScene, CollectsEveryProblemOfAFile) {
  const std::string text = error("step: 0\nduration: -1\ncolour: blue\nmethod: rk5\n");
  for (const char* part : {":2:", ":3:", ":4:", ":5:", "unknown key 'colour'", "did you mean 'rk4'"})
    EXPECT_THAT(text, HasSubstr(part));
}

TEST_F(ReadScene, ReadsWhatItWrites) {
  Scene scene = read(
      "title: \"Says: \\\"x\\\"\"\ngravity: [0, 0, 0]\nstart: {q: [0.1, 0.2], qd: [1, 2]}\ntorque: [1, "
      "\"max(q1, 2)\"]\n"
      "parameters: {k: 0.1}\nmethod: rk4\nstep: 0.002\nvideo: {fps: 30000/1001}\n");
  scene.model = "rr.urdf";
  const std::string text = scene_text(scene);
  const Scene again = read_scene(folder_.write("again.yaml", text));
  EXPECT_EQ(again.title, scene.title);
  EXPECT_EQ(again.start.q, scene.start.q);
  EXPECT_EQ(again.start.qd, scene.start.qd);
  EXPECT_EQ(again.torque[1].text, scene.torque[1].text);
  EXPECT_EQ(again.parameters, scene.parameters);
  EXPECT_EQ(again.method, scene.method);
  EXPECT_EQ(again.step, scene.step);
  EXPECT_EQ(again.draw, scene.draw);
  EXPECT_EQ(again.video.fps, scene.video.fps);
  EXPECT_EQ(*again.gravity, *scene.gravity);
}

TEST_F(ReadScene, ReadsControlsForTheWholeChainAndForOneJoint) {
  const Scene whole = read(
      "torque: {gravity_compensation: true, pd: {kp: 80, kd: [8, 9], q: [\"sin(t)\", 0.5]}, csv: push.csv}\n"
      "base: floating\nfriction: false\nmassless: 1e-6\nlimit: clamp\npackages: {robot: parts}\n");
  ASSERT_TRUE(whole.control.has_value());
  EXPECT_TRUE(whole.control->gravity_compensation);
  EXPECT_THAT(whole.control->pd->kp, ElementsAre(80));
  EXPECT_THAT(whole.control->pd->kd, ElementsAre(8, 9));
  EXPECT_EQ(whole.control->pd->q[0].text, "sin(t)");
  EXPECT_EQ(whole.control->csv, folder_.file("push.csv"));
  EXPECT_EQ(whole.base, RootLink::floating);
  EXPECT_FALSE(whole.friction);
  EXPECT_EQ(whole.massless, 1e-6);
  EXPECT_EQ(whole.limit, LimitPolicy::clamp);
  EXPECT_EQ(whole.packages.at("robot"), folder_.file("parts"));

  const Scene one = read("torque: [1, {computed_torque: {kp: 1, kd: 2, trajectory: q.csv}}]\n");
  EXPECT_FALSE(one.torque[0].control.has_value());
  ASSERT_TRUE(one.torque[1].control.has_value());
  EXPECT_EQ(one.torque[1].control->computed_torque->trajectory, folder_.file("q.csv"));
}

TEST_F(ReadScene, WritesFeedbackOfATaskAndWhatIsAddedAsItReadsThem) {
  const std::string text =
      "torque: {task: {frame: link2, kp: [400, 300], kd: 80, x: [0.8*cos(t), 0.5], xd: [0, 0]}, gravity_compensation: true, plus: [-qd1, 0]}";
  const Scene scene = read(text + "\n");
  ASSERT_TRUE(scene.control && scene.control->task);
  EXPECT_EQ(scene.control->task->frame, "link2");
  EXPECT_THAT(scene.control->task->kp, ElementsAre(400, 300));
  EXPECT_EQ(scene.control->task->x[0].text, "0.8*cos(t)");
  EXPECT_THAT(scene_text(scene), HasSubstr(text));
  EXPECT_THAT(error("torque: {task: 5}\n"), HasSubstr("a place to go to and gains"));
  EXPECT_THAT(error("torque: {task: {x: [0, 0], kq: 5}}\n"), HasSubstr("unknown key 'torque.task.kq'"));
}

TEST_F(ReadScene, SaysWhatIsWrongWithAControl) {
  EXPECT_THAT(error("torque: {pdd: {}}\n"), HasSubstr("unknown key 'torque.pdd': did you mean 'pd'?"));
  EXPECT_THAT(error("torque: {pd: {kp: 1, kq: 2}}\n"), HasSubstr("unknown key 'torque.pd.kq'"));
  EXPECT_THAT(error("torque: {pd: {q: [0, 0], trajectory: a.csv}}\n"), HasSubstr("not from both"));
  EXPECT_THAT(error("torque: {csv: a.csv, outside: repeat}\n"), HasSubstr("'torque.outside' must be hold, zero or refuse, not 'repeat'"));
  EXPECT_THAT(error("torque: {gravity_compensation: true, outside: zero}\n"), HasSubstr("there is no csv or inverse_of"));
  EXPECT_THAT(error("torque: {pd: {q: [0, 0], outside: zero}}\n"), HasSubstr("there is no trajectory"));
  EXPECT_THAT(error("base: flying\n"), HasSubstr("'base' must be fixed or floating"));
  EXPECT_THAT(error("limit: halt\n"), HasSubstr("'limit' must be report, clamp or stop, not 'halt'"));
  EXPECT_THAT(error("massless: -1\n"), HasSubstr("above 0 kg"));
  EXPECT_THAT(error("friction: maybe\n"), HasSubstr("true or false"));
}

TEST_F(ReadScene, WritesControlsThatReadBackTheSame) {
  Scene scene = read(
      "torque: {pd: {kp: 80, kd: 8, q: [\"sin(t)\", 0.5], qd: [0, 0]}, gravity_compensation: true}\nlimit: "
      "stop\n");
  scene.model = "rr.urdf";
  const Scene again = read_scene(folder_.write("again.yaml", scene_text(scene)));
  ASSERT_TRUE(again.control.has_value());
  EXPECT_EQ(again.control->pd->q[0].text, "sin(t)");
  EXPECT_EQ(again.control->pd->qd.size(), 2u);
  EXPECT_TRUE(again.control->gravity_compensation);
  EXPECT_EQ(again.limit, LimitPolicy::stop);
}

TEST_F(ReadScene, WritesWhatTablesAreTakenForBeyondTheirRows) {
  Scene scene = read("torque: {csv: a.csv, outside: zero, pd: {kp: 1, trajectory: b.csv, outside: refuse}}\n");
  scene.model = "rr.urdf";
  const Scene again = read_scene(folder_.write("again.yaml", scene_text(scene)));
  EXPECT_EQ(again.control->outside, Outside::zero);
  EXPECT_EQ(again.control->pd->outside, Outside::refuse);
  EXPECT_EQ(read("torque: {csv: a.csv}\n").control->outside, std::nullopt);
}

TEST_F(ReadScene, ReadsAModelInASceneSPlace) {
  const Scene scene = read_model_scene("models/rr.urdf", {"gravity=[0, 0, 0]", "packages.parts=meshes"});
  EXPECT_EQ(scene.model, "models/rr.urdf");
  EXPECT_EQ(scene.gravity->norm(), 0);
  EXPECT_EQ(scene.packages.at("parts"), "models/meshes") << "beside the model";
  EXPECT_THROW(read_model_scene("models/rr.urdf", {"gravty=[0, 0, 0]"}), Error);
  EXPECT_THROW(read_model_scene("models/none.urdf"), Error);
}

TEST_F(ReadScene, WritesAliasesAndMergeKeysOut) {
  const Scene scene = read(
      "torque: &push [1, &spring \"-2 * q1\"]\nvideo: &small {width: 320, height: 180}\n"
      "compare:\n  - &one {title: one, method: rk4, step: 0.01, torque: *push}\n"
      "  - <<: *one\n    title: other\n    step: 0.02\n"
      "  - {<<: [{step: 0.03}, *one], title: third, torque.1: *spring}\n");
  ASSERT_EQ(scene.compare.size(), 3u);
  EXPECT_EQ(scene.compare[1].method, "rk4");
  EXPECT_EQ(scene.compare[1].step, 0.02) << "what stands beside << holds";
  EXPECT_EQ(scene.compare[2].step, 0.03) << "then the first of its list";
  EXPECT_EQ(scene.compare[1].torque[1].text, "-2 * q1");
  EXPECT_EQ(scene.compare[2].torque[0].text, "-2 * q1");
  EXPECT_EQ(scene.compare[0].torque[0].text, "1") << "a change of one panel reaches no other";
  EXPECT_EQ(scene.video.width, 320);
}

TEST_F(ReadScene, ChangesTheAliasAloneBySet) {
  const std::string text = "start: {q: &here [1, 2], qd: *here}\n";
  const Scene scene = read(text, {"start.qd.2=7"});
  EXPECT_THAT(scene.start.qd, ElementsAre(1, 7));
  EXPECT_THAT(scene.start.q, ElementsAre(1, 2));
  EXPECT_THAT(read(text, {"start.q=[3, 4]"}).start.qd, ElementsAre(1, 2));
  EXPECT_THAT(error(text, {"start.qd=*here"}), HasSubstr("--set start.qd=*here"));
}

// Places are those of the file as it was written, whatever stands between.
TEST_F(ReadScene, NamesTrueLinesOfFilesWithAliases) {
  const std::string text = "duration: &two 2\n\n# a comment\nhold: *two\nparameters: {a: &bad xyz, b: *bad}\nstep: 0.01\nmethod: rk5\n";
  EXPECT_THAT(error(text), AllOf(HasSubstr(":8:9: unknown method 'rk5'"), HasSubstr(":6:17: parameter 'b'")));
  EXPECT_THAT(error("video: &v {wdth: 3}\nellipse: {<<: *v}\n"), AllOf(HasSubstr(":2:"), HasSubstr("'ellipse.wdth'")));
  EXPECT_THAT(error("video: {<<: [1, 2]}\n"), HasSubstr(":2:14: `<<` takes the alias of a mapping"));
  EXPECT_THAT(error("video: {<<: {width: 640}, <<: {height: 360}}\n"), HasSubstr("stands here twice"));
  EXPECT_THAT(error("hold: &h 1\nduration: *h\nduration: 2\n"), HasSubstr(":4:1: the key 'duration' stands here twice"));
  EXPECT_THAT(error("hold: &h 1\nduration: *h\n\"<<\": {step: 1}\n"), HasSubstr("unknown key '<<'")) << "quoted it is a key";
  EXPECT_EQ(error("title: \"<<: no merge\"\n"), "");
}

TEST(SceneWithModel, PutsThePathBehindQuotesAndAnchorsAndKeepsComments) {
  for (const char* path : {"arm.urdf", "\"arm.urdf\"", "'arm.urdf'", "&m arm.urdf", "&m 'arm.urdf'"})
    EXPECT_EQ(scene_with_model("# mine\nmodel: " + std::string(path) + "  # the arm\nduration: 2\n", "new.urdf"),
              "# mine\nmodel: " + std::string(path[0] == '&' ? "&m " : "") + "\"new.urdf\"  # the arm\nduration: 2\n");
}

TEST_F(ReadScene, TakesBlocksOfWordsAsOneLine) {
  EXPECT_EQ(read("title: >\n  two lines\n  folded\n").title, "two lines folded");
  EXPECT_EQ(read("title: |\n  two lines\n  kept\n").title, "two lines kept");
  EXPECT_EQ(read("title: >-\n  without end\n").title, "without end");
  const Scene scene = read("torque:\n  - >\n    -2 * q1\n    - 3 * qd1\n  - 0\n");
  EXPECT_EQ(scene.torque[0].text, "-2 * q1 - 3 * qd1");
}

TEST_F(ReadScene, RefusesLargeFilesBeforeParsingThem) {
  EXPECT_THAT(error("# " + std::string(2 << 20, 'x') + "\n"), HasSubstr("larger than 1 MiB"));
  EXPECT_EQ(error("# a comment\n"), "");  // negative control: a small one is read
}

TEST(Quantity, ReadsDegreesAndConstants) {
  EXPECT_EQ(parse_quantity("180deg", {}), std::numbers::pi);
  EXPECT_EQ(parse_quantity("-2 * pi", {}), -2 * std::numbers::pi);
  EXPECT_EQ(parse_quantity(" 1e3 ", {}), 1000);
  for (const char* bad : {"", "deg", "1,5", "nan", ".inf", "1/0", "90 degrees", "t"})
    EXPECT_THROW(parse_quantity(bad, {}), Error) << bad;
}

TEST(Quantity, ReadsUnitsOfItsKindAlone) {
  EXPECT_DOUBLE_EQ(parse_quantity("20ms", {}, "s"), 0.02);
  EXPECT_DOUBLE_EQ(parse_quantity("2 * 5 min", {}, "s"), 600);
  EXPECT_DOUBLE_EQ(parse_quantity("1e-3s", {}, "s"), 1e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("35 cm", {}, "rad or m"), 0.35);
  EXPECT_DOUBLE_EQ(parse_quantity("(1 + 1) mm", {}), 2e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("pi rad", {}, "rad"), std::numbers::pi);
  EXPECT_DOUBLE_EQ(parse_quantity("90deg/s", {}, "rad/s or m/s"), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(parse_quantity("-9.81 m/s^2", {}, "m/s^2"), -9.81);
  EXPECT_EQ(parse_quantity("2", {}, "s"), 2);
  for (const auto& [text, in] : {std::pair{"90deg", "s"}, {"2s", "rad or m"}, {"1m", "s"}, {"3kg", "m/s^2"}})
    EXPECT_THROW(parse_quantity(text, {}, in), Error) << text;
  for (const char* bad : {"s", "ms", "2 parsecs", "2ss", "2 s s", "m/s^2"}) EXPECT_THROW(parse_quantity(bad, {}), Error) << bad;
  EXPECT_TRUE(has_unit("30deg") && has_unit("0.5 rad"));
  EXPECT_FALSE(has_unit("30") || has_unit("pi/6"));
}

// What was read without a word before: an angle for a time, and a slider's place that a unit made no better.
TEST_F(ReadScene, TakesUnitsWhereverANumberStandsAndRefusesOthers) {
  EXPECT_THAT(error("duration: 90deg\n"), HasSubstr("'90deg' is in deg, but this is in s"));
  EXPECT_THAT(error("gravity: [0, 1s, 0]\n"), HasSubstr("but this is in m/s^2"));
  EXPECT_THAT(error("start: {q: [1s, 0]}\n"), HasSubstr("but this is in rad or m"));
  const Scene scene = read("duration: 500ms\nmethod: rk4\nstep: 1ms\nstart: {q: [90deg, 20cm]}\nhold: 250ms\n");
  EXPECT_DOUBLE_EQ(scene.duration, 0.5);
  EXPECT_DOUBLE_EQ(*scene.step, 1e-3);
  EXPECT_DOUBLE_EQ(scene.start.q[1], 0.2);
  EXPECT_EQ(scene.hold.first, 0.25);
  EXPECT_EQ(scene.hold.last, 0.25);
}

// A file whose text is parsed once gives what one that is read anew gives: other values of the same keys, other keys, and
// good values behind a bad one.
TEST(SceneFile, ReadsLikeAFreshFileEachTime) {
  const std::string path = "assets/scenes/rr_torque.yaml";
  SceneFile file(path);
  std::vector<std::string> seen;
  for (const std::vector<std::string>& set : std::vector<std::vector<std::string>>{
           {"torque.1=1", "start.q.2=0.5"},
           {"torque.1=2", "start.q.2=0.25"},
           {"torque=[3, 4]", "torque.2=5"},
           {"torque=[6, 7]", "torque.2=8"},
           {"video.preset=web"},
           {"video.preset=slides"},
           {}}) {
    const std::string text = scene_text(file.read(set));
    EXPECT_EQ(text, scene_text(read_scene(path, set)));
    seen.push_back(text);
  }
  EXPECT_EQ(std::set<std::string>(seen.begin(), seen.end()).size(), seen.size());
  EXPECT_THROW(file.read({"duration=-1"}), Error);
  EXPECT_EQ(file.read({"duration=2"}).duration, 2);
}

}  // namespace
}  // namespace chainreel
