// Suites: what pictures they ask for, and what is said of those that make no sense.
#include "scene/text/suite.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "support/public_robots.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 1e-15;  // what a product with pi may round

std::string link(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
         "iyz='0'/></inertial></link>\n";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& inside, const std::string& type = "revolute") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/><axis xyz='0 0 1'/><origin xyz='1 0 0'/>" + inside + "</joint>\n";
}

// shoulder within +-2, elbow within -3 .. -0.5, a finger that follows the thumb, and a fixed tip.
std::string arm(const std::string& name = "arm") {
  return "<robot name='" + name + "'>\n" + link("base") + link("upper") + link("lower") + link("thumb") +
         link("finger") + link("tip") +
         joint("shoulder", "base", "upper", "<limit lower='-2' upper='2' effort='1' velocity='1'/>") +
         joint("elbow", "upper", "lower", "<limit lower='-3' upper='-0.5' effort='1' velocity='1'/>") +
         joint("grip", "lower", "thumb", "<limit lower='0' upper='0.04' effort='1' velocity='1'/>",
               "prismatic") +
         joint(
             "grip_too", "lower", "finger",
             "<limit lower='-0.04' upper='0' effort='1' velocity='1'/><mimic joint='grip' multiplier='-1'/>",
             "prismatic") +
         joint("weld", "lower", "tip", "", "fixed") + "</robot>\n";
}

class Suites : public testing::Test {
 protected:
  Suites() {
    folder_.write("arm.urdf", arm());
    folder_.write("swing.yaml",
                  "model: arm.urdf\nduration: 2\nstart: {q: [0, -1, 0]}\nevents: [{when: \"q1 > 1\", kind: "
                  "mark, name: touch}]\n");
  }

  Suite read(const std::string& text) { return read_suite(folder_.write("snapshots.yaml", text)); }

  std::string error(const std::string& text) {
    try {
      read(text);
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input);
      return error.what();
    }
  }

  static std::vector<std::string> names(const Suite& suite) {
    std::vector<std::string> all;
    for (const SuitePicture& picture : suite.pictures) all.push_back(picture.name);
    return all;
  }

  TemporaryFolder folder_;
};

TEST_F(Suites, PosesAreByOrderOrByNameOrOfAnSrdfInTheUsersOrder) {
  folder_.write("arm.srdf",
                "<robot name='arm'><group_state name='ready' group='g'><joint name='elbow' value='-1.5'/>"
                "<joint name='grip_too' value='-0.03'/><joint name='grip' value='0.03'/>"
                "<joint name='root_joint' value='0 0 0 0 0 0 1'/></group_state></robot>");
  const Suite suite = read(
      "model: arm.urdf\nsize: 640x480\n"
      "poses: {zz: [0, -90deg, 0.01], srdf: arm.srdf, reach: {elbow: -pi/2, shoulder: 40deg}, rest: {}}\n");
  EXPECT_EQ(suite.name, "snapshots");
  EXPECT_THAT(names(suite), ElementsAre("zz", "ready", "reach", "rest"));
  EXPECT_THAT(suite.pictures[0].q, ElementsAre(0, testing::DoubleNear(-kPi / 2, kExact), 0.01));
  EXPECT_THAT(suite.pictures[1].q, ElementsAre(0, -1.5, 0.03));
  EXPECT_THAT(suite.pictures[2].q, ElementsAre(testing::DoubleNear(40 * kPi / 180, kExact),
                                               testing::DoubleNear(-kPi / 2, kExact), 0));
  // Zero is no place of this elbow: it stands in the middle of its limits.
  EXPECT_THAT(suite.pictures[3].q, ElementsAre(0, -1.75, 0));
  EXPECT_EQ(suite.pictures[2].pose, "reach");
  EXPECT_EQ(suite.pictures[2].place.line, 3);
  EXPECT_EQ(suite.pictures[1].place.file, folder_.file("arm.srdf"));
  EXPECT_EQ(suite.pictures[0].width, 640);
  EXPECT_EQ(suite.pictures[0].height, 480);
  EXPECT_TRUE(suite.pictures[0].is_model);
  EXPECT_EQ(suite.pictures[0].source, folder_.file("arm.urdf"));
}

TEST_F(Suites, InstantsAreSecondsOrEvents) {
  const Suite suite = read("scene: swing.yaml\nat: [0, 1.2s, 1e-1 s, event touch]\n");
  EXPECT_THAT(names(suite), ElementsAre("0s", "1.2s", "0.1s", "touch"));
  EXPECT_EQ(suite.pictures[1].at, 1.2);
  EXPECT_EQ(suite.pictures[1].pose, "1.2s");
  EXPECT_EQ(suite.pictures[3].event, "touch");
  EXPECT_FALSE(suite.pictures[3].telling);
  EXPECT_THAT(names(read("scene: swing.yaml\n")), ElementsAre("swing"));
  EXPECT_TRUE(read("scene: swing.yaml\n").pictures[0].telling);
}

TEST_F(Suites, OfSeveralSourcesNamesBearTheSource) {
  folder_.write("b/arm.urdf", arm());
  folder_.write("two.urdf", arm("two"));
  EXPECT_THAT(
      names(read("model: [arm.urdf, two.urdf]\nscene: swing.yaml\nat: 0\nposes: {home: [0, -1, 0]}\n")),
      ElementsAre("arm_home", "two_home", "swing_0s"));
  // Stems alone would be one name twice.
  EXPECT_THAT(names(read("model: [arm.urdf, b/arm.urdf]\nposes: {home: [0, -1, 0]}\n")),
              ElementsAre("arm_home", "b_arm_home"));
}

TEST_F(Suites, StatesOfAnSrdfGoToTheRobotOfItsName) {
  folder_.write("two.urdf", arm("two"));
  const std::string state =
      "<group_state name='ready' group='g'><joint name='elbow' value='-1'/></group_state>";
  folder_.write("two.srdf", "<robot name='two'>" + state + "</robot>");
  folder_.write("other.srdf", "<robot name='other'>" + state + "</robot>");
  EXPECT_THAT(names(read("model: [arm.urdf, two.urdf]\nposes: {srdf: two.srdf}\n")),
              ElementsAre("two_ready"));
  // Of one model it can only be meant: names differ in robots that people use.
  EXPECT_THAT(names(read("model: arm.urdf\nposes: {srdf: other.srdf}\n")), ElementsAre("ready"));
  EXPECT_THAT(error("model: [arm.urdf, two.urdf]\nposes:\n  srdf: other.srdf\n"),
              AllOf(HasSubstr("snapshots.yaml:3"),
                    HasSubstr("is of the robot 'other', which no model of the suite is")));
}

TEST_F(Suites, EachModelMayHaveAnEndEffectorOfItsOwn) {
  folder_.write("two.urdf", arm("arm"));
  const std::string models = "model: [arm.urdf, two.urdf]\nposes: {home: [0, -1, 0]}\nend_effector: ";
  const Suite suite = read(models + "{two.urdf: upper}\n");
  EXPECT_TRUE(suite.overrides.empty());
  EXPECT_THAT(suite.pictures[0].overrides, ElementsAre());
  EXPECT_THAT(suite.pictures[1].overrides, ElementsAre("end_effector=\"upper\""));
  EXPECT_THAT(error(models + "{three.urdf: upper}\n"), HasSubstr("is no model of this suite: it has arm.urdf, two.urdf"));
  EXPECT_THAT(error(models + "{two.urdf: uper}\n"), AllOf(HasSubstr("has no link 'uper'"), HasSubstr("did you mean 'upper'?")));
  EXPECT_THAT(error(models + "{two.urdf: [upper]}\n"), HasSubstr("must be the name of a link"));
  EXPECT_THAT(error(models + "{}\n"), HasSubstr("must be a link, or name one of each model"));
  EXPECT_THAT(error(models + "tool9\n"), HasSubstr("of several models write end_effector: {arm.urdf: LINK, ..}"));
}

TEST_F(Suites, PosesUnderAModelsNameAreItsOwn) {
  folder_.write("b/two.urdf", arm("arm"));
  folder_.write("three.urdf", arm("arm"));
  folder_.write("arm.srdf", "<robot name='arm'><group_state name='ready' group='g'><joint name='elbow' value='-1'/></group_state></robot>");
  const std::string models = "model: [arm.urdf, b/two.urdf, three.urdf]\n";
  const Suite suite = read(models + "poses: {both: [0, -1, 0], two.urdf: {home: [0, -2, 0]}, arm.urdf: {home: [0, -1.5, 0], srdf: arm.srdf}}\n");
  EXPECT_THAT(names(suite), ElementsAre("arm_both", "arm_home", "arm_ready", "two_both", "two_home", "three_both"));
  EXPECT_THAT(suite.pictures[1].q, ElementsAre(0, -1.5, 0));
  EXPECT_THAT(suite.pictures[4].q, ElementsAre(0, -2, 0));
  // A model of which no pose is stands at rest, as it does in a suite without poses.
  EXPECT_THAT(names(read("model: [arm.urdf, three.urdf]\nposes: {arm.urdf: {home: [0, -1, 0]}}\n")), ElementsAre("arm_home", "three"));
  // As the suite names it before any file of that name; where only the file's name is told, it must be one.
  folder_.write("b/arm.urdf", arm("arm"));
  EXPECT_THAT(names(read("model: [b/arm.urdf, arm.urdf]\nposes: {arm.urdf: {home: [0, -1, 0]}}\n")), ElementsAre("b_arm", "arm_home"));
  EXPECT_THAT(names(read("model: [arm.urdf, three.urdf]\nposes: {./arm.urdf: {home: [0, -1, 0]}}\n")), ElementsAre("arm_home", "three"));
  folder_.write("c/arm.urdf", arm("arm"));
  EXPECT_THAT(error("model: [b/arm.urdf, c/arm.urdf]\nposes: {arm.urdf: {home: [0, -1, 0]}}\n"), HasSubstr("could be any of"));
  EXPECT_THAT(error(models + "poses: {twoo.urdf: {home: [0, 0, 0]}}\n"), HasSubstr("'twoo.urdf' is no model of the suite"));
  EXPECT_THAT(error(models + "poses: {two.urdf: {home: [0, 0]}}\n"), HasSubstr("snapshots.yaml:2:20: pose 'home': has 2 numbers"));
  EXPECT_THAT(error(models + "poses: {two.urdf: [0, 0]}\n"), HasSubstr("'poses.two.urdf' must hold names and poses"));
}

TEST_F(Suites, StatesOfOneNameInTwoGroupsBearTheirGroup) {
  folder_.write(
      "arm.srdf",
      "<robot name='arm'><group_state name='home' group='arm'/><group_state name='home' group='hand'/>"
      "<group_state name='open' group='hand'/></robot>");
  EXPECT_THAT(names(read("model: arm.urdf\nposes: {srdf: arm.srdf}\n")),
              ElementsAre("arm_home", "hand_home", "open"));
}

TEST_F(Suites, PosesThatTheModelLacksAreErrorsThatNameWhatItHas) {
  const std::string text = error(
      "model: arm.urdf\nposes:\n  a: [0, -1]\n  b: {elbo: 1}\n  c: {weld: 1}\n  d: {grip_too: -0.01}\n  e: "
      "{elbow: [1, 2]}\n");
  EXPECT_THAT(text, HasSubstr("snapshots.yaml:3:3: pose 'a': has 2 numbers, but " + folder_.file("arm.urdf") +
                              " needs 3: shoulder, elbow, grip"));
  EXPECT_THAT(text, HasSubstr("snapshots.yaml:4:7: pose 'b': " + folder_.file("arm.urdf") +
                              " has no joint 'elbo': did you mean 'elbow'?"));
  EXPECT_THAT(text, HasSubstr("joint 'weld' is fixed"));
  EXPECT_THAT(
      text,
      HasSubstr("joint 'grip_too' follows 'grip', which puts it at 0 m, not -0.01 m: give 'grip' its value"));
  EXPECT_THAT(text, HasSubstr("joint 'elbow' takes 1 number, not 2"));
}

TEST_F(Suites, PosesOfAllJointsAreTakenWhereThoseThatFollowAgree) {
  EXPECT_EQ(read("model: arm.urdf\nposes: {a: [0, -1, 0.01, -0.01]}\n").pictures[0].q, read("model: arm.urdf\nposes: {a: [0, -1, 0.01]}\n").pictures[0].q);
  EXPECT_THAT(error("model: arm.urdf\nposes: {a: [0, -1, 0.01, 0.01]}\n"), HasSubstr("has 4 numbers"));
}

TEST_F(Suites, PosesOutOfLimitsAreErrorsThatNameJointValueAndLimit) {
  const std::string text =
      error("model: arm.urdf\nposes: {a: {shoulder: 120deg}, b: [0, 0, 0], c: {grip: 0.05}}\n");
  EXPECT_THAT(text, HasSubstr("pose 'a': joint 'shoulder' at 2.0944 rad (120.00 deg) is beyond its upper "
                              "limit of 2 rad (114.59 deg) (" +
                              folder_.file("arm.urdf") + " line 8)"));
  EXPECT_THAT(text,
              HasSubstr("pose 'b': joint 'elbow' at 0 rad (0.00 deg) is beyond its upper limit of -0.5 rad"));
  EXPECT_THAT(text, HasSubstr("pose 'c': joint 'grip' at 0.05 m is beyond its upper limit of 0.04 m"));
  EXPECT_THAT(text, HasSubstr("joint 'grip_too' at -0.05 m is beyond its lower limit of -0.04 m"));
  // Limits have few digits.
  EXPECT_THAT(names(read("model: arm.urdf\nposes: {a: {shoulder: 2.000001}}\n")), ElementsAre("a"));
}

TEST_F(Suites, TwoPicturesOfOneNameNameBothLines) {
  EXPECT_THAT(error("model: arm.urdf\nposes:\n  a b: [0, -1, 0]\n  a_b: [0, -1, 0]\n"),
              AllOf(HasSubstr("snapshots.yaml:4:3: two pictures are named 'a_b'"),
                    HasSubstr("snapshots.yaml line 3")));
  EXPECT_THAT(error("model: arm.urdf\nposes:\n  Home: [0, -1, 0]\n  home: [0, -1, 0]\n"),
              HasSubstr("differ in capitals alone"));
  EXPECT_THAT(error("scene: swing.yaml\nat: [1, 1.0s]\n"), HasSubstr("two pictures are named '1s'"));
  EXPECT_THAT(error("model: [arm.urdf, ./arm.urdf]\nposes: {a: [0, -1, 0]}\n"),
              HasSubstr("two pictures are named"));
}

TEST_F(Suites, NamesAreFitForFiles) {
  EXPECT_THAT(names(read("model: arm.urdf\nposes: {../../up: {}, -rf: {}, .hidden: {}, \"a/b c:d\": {}, "
                         "\"gr\u00FC\u00DF\": {}}\n")),
              ElementsAre("_._.._up", "_rf", "_hidden", "a_b_c_d", "gr\u00FC\u00DF"));
  EXPECT_THAT(error("model: arm.urdf\nposes: {" + std::string(300, 'a') + ": {}}\n"),
              HasSubstr("too long for a file"));
}

TEST_F(Suites, InstantsThatTheSceneLacksAreErrors) {
  const std::string text = error("scene: swing.yaml\nat: [3s, event tuch, -1, soon, event, 90deg]\n");
  EXPECT_THAT(
      text, HasSubstr("3s lies behind the end of " + folder_.file("swing.yaml") + ", whose duration is 2 s"));
  EXPECT_THAT(text, HasSubstr("has no event 'tuch': did you mean 'touch'?"));
  EXPECT_THAT(text, HasSubstr("'-1' lies before the start"));
  EXPECT_THAT(text, HasSubstr("'soon' is no instant: write seconds, like 1.2s, or `event NAME`"));
  EXPECT_THAT(text, HasSubstr("`event` names no event"));
  EXPECT_THAT(text, HasSubstr("'90deg' is no instant"));
}

TEST_F(Suites, ToleranceMasksAndSizeMayBeAPicturesOwn) {
  const Suite suite = read(
      "model: arm.urdf\nposes: {a: {}, b: {}}\ntolerance: {error: 0.2}\nmasks: [[0, 0, 10, 5]]\n"
      "pictures:\n  b:\n    tolerance: {pixels: 3}\n    size: 320x240\n    masks: [[300, 220, 20, 20]]\n");
  EXPECT_EQ(suite.pictures[0].tolerance.error, 0.2);
  EXPECT_EQ(suite.pictures[0].tolerance.pixels, 0);
  EXPECT_EQ(suite.pictures[0].tolerance.place.line, 3);
  EXPECT_EQ(suite.pictures[1].tolerance.error, 0.2);
  EXPECT_EQ(suite.pictures[1].tolerance.pixels, 3);
  EXPECT_EQ(suite.pictures[1].tolerance.place.line, 7);
  EXPECT_EQ(suite.pictures[1].width, 320);
  EXPECT_THAT(suite.pictures[0].masks, ElementsAre(std::array{0, 0, 10, 5}));
  EXPECT_THAT(suite.pictures[1].masks, ElementsAre(std::array{0, 0, 10, 5}, std::array{300, 220, 20, 20}));
  EXPECT_TRUE(read("model: arm.urdf\n").pictures[0].tolerance.is_default);
}

TEST_F(Suites, LookIsHandedOnAsKeysOfScenes) {
  const Suite suite =
      read("model: arm.urdf\ntheme: dark\ncamera: {azimuth: 90deg, fit: [-1, 0, 2, 1.5]}\nphysics: note\n");
  EXPECT_THAT(suite.overrides, ElementsAre("camera.azimuth=1.5707963267948966", "theme=dark"));
  EXPECT_EQ(suite.fit, (std::array<double, 4>{-1, 0, 2, 1.5}));
  EXPECT_EQ(suite.other_physics, OtherPhysics::note);
  EXPECT_EQ(read("model: arm.urdf\n").other_physics, OtherPhysics::fail);
  EXPECT_EQ(read("model: arm.urdf\nphysics: motion\n").other_physics, OtherPhysics::motion);
}

TEST_F(Suites, EachSourceIsShownOnceAVariant) {
  const Suite suite = read("scene: swing.yaml\nat: [0, 1s]\nvariants:\n  plain: {duration: 2}\n  dark: {theme: dark, start.q: [0, -2, 0]}\n");
  ASSERT_EQ(suite.pictures.size(), 4u);
  std::vector<std::string> names;
  for (const SuitePicture& picture : suite.pictures) names.push_back(picture.name);
  EXPECT_THAT(names, ElementsAre("0s_plain", "1s_plain", "0s_dark", "1s_dark"));
  EXPECT_THAT(suite.pictures[3].overrides, ElementsAre("theme=dark", "start.q=[0, -2, 0]"));
  EXPECT_THAT(suite.overrides, IsEmpty());
  // A list of themes says the same, of models, too.
  const Suite themes = read("model: arm.urdf\nposes: {rest: {}}\ntheme: [light, dark]\n");
  ASSERT_EQ(themes.pictures.size(), 2u);
  EXPECT_EQ(themes.pictures[1].name, "rest_dark");
  EXPECT_THAT(themes.pictures[1].overrides, ElementsAre("theme=dark"));
}

TEST_F(Suites, VariantsThatSayNothingAreRefusedWithTheirLine) {
  const std::string head = "scene: swing.yaml\nat: 0\nvariants:\n";
  EXPECT_THAT(error(head + "  a: {}\n"), AllOf(HasSubstr("snapshots.yaml:4"), HasSubstr("variants.a")));
  EXPECT_THAT(error(head + "  a: {theme: blue}\n"), AllOf(HasSubstr("snapshots.yaml:4"), HasSubstr("light")));
  EXPECT_THAT(error(head + "  a: {thme: dark}\n"), HasSubstr("theme"));
  EXPECT_THAT(error(head + "  a: {parameters.F: 20}\n"), AllOf(HasSubstr("snapshots.yaml:4"), HasSubstr("F")));
  EXPECT_THAT(error(head + "  a: {start: {q: [0, 0, 0]}}\n"), HasSubstr("start.q"));
  EXPECT_THAT(error(head + "  a: {start: {}}\n"), HasSubstr("start.KEY"));
  EXPECT_THAT(error("scene: swing.yaml\ntheme: []\n"), HasSubstr("empty list"));
  EXPECT_THAT(error(head + "  a: {video.width: 300}\n"), AllOf(HasSubstr("snapshots.yaml:4"), HasSubstr("size: 640x360")));
  EXPECT_THAT(error(head + "  a: {parametrs.F: 300}\n"), AllOf(HasSubstr("snapshots.yaml:4"), HasSubstr("unknown key")));
  EXPECT_THAT(error("scene: swing.yaml\nvariants: 3\n"), HasSubstr("must hold names"));
  EXPECT_THAT(error("model: arm.urdf\nvariants: {a: {base: floating}}\n"), HasSubstr("which no source of the suite has"));
  // A payload is seen at a pose, gravity is not.
  EXPECT_EQ(read("model: arm.urdf\nposes: {bent: {}}\nvariants: {a: {theme: light}, b: {payload.mass: 2}}\n").pictures.size(), 2u);
  EXPECT_THAT(error("model: arm.urdf\nvariants: {a: {gravity: [0, 0, 0]}}\n"), HasSubstr("which no source of the suite has"));
  EXPECT_THAT(error("model: arm.urdf\nvariants: {a: {duration: 1}}\n"), HasSubstr("which no source of the suite has"));
}

// A variant is one of those sources that have what it sets; others are shown as they are, and all in each theme.
TEST_F(Suites, VariantsAreOfTheSourcesThatTheyAreAbout) {
  folder_.write("push.yaml", "model: arm.urdf\nparameters: {F: 1}\ntorque: [F, 0, 0]\nduration: 2\n");
  const Suite suite = read(
      "model: arm.urdf\nposes: {rest: {}}\nscene: [swing.yaml, push.yaml]\nat: 1s\ntheme: [light, dark]\n"
      "variants: {weak: {parameters.F: 5}, night: {parameters.F: 9, theme: dark}}\n");
  std::vector<std::string> names;
  for (const SuitePicture& picture : suite.pictures) names.push_back(picture.name);
  EXPECT_THAT(names, ElementsAre("arm_rest_light", "arm_rest_dark", "swing_1s_light", "swing_1s_dark", "push_1s_weak_light", "push_1s_weak_dark",
                                 "push_1s_night"));
  EXPECT_THAT(suite.pictures[5].overrides, ElementsAre("theme=dark", "parameters.F=5"));
  EXPECT_THAT(suite.pictures[6].overrides, ElementsAre("parameters.F=9", "theme=dark"));
}

TEST_F(Suites, ListsOfThemesHoldThemes) {
  EXPECT_THAT(error("scene: swing.yaml\nat: 0\ntheme: [light, drak]\n"),
              AllOf(HasSubstr("snapshots.yaml:3:16: 'theme' lists 'drak'"), HasSubstr("did you mean 'dark'?")));
  EXPECT_THAT(error("scene: swing.yaml\nat: 0\ntheme: [light, light]\n"), HasSubstr("'theme' lists 'light' twice"));
  EXPECT_THAT(error("scene: swing.yaml\nat: 0\ntheme: [null]\n"), testing::Not(HasSubstr("empty list")));
}

TEST_F(Suites, VariantsThatAllPanelsOverruleAreOfOtherSources) {
  folder_.write("both.yaml", "model: arm.urdf\nduration: 2\ncompare: [{method: rk4}, {method: verlet}]\n");
  const Suite suite = read("scene: [both.yaml, swing.yaml]\nat: 1s\nvariants: {a: {method: rk4}}\n");
  ASSERT_EQ(suite.pictures.size(), 2U);
  EXPECT_EQ(suite.pictures[0].name, "both_1s");
  EXPECT_EQ(suite.pictures[1].name, "swing_1s_a");
  EXPECT_THAT(error("scene: both.yaml\nat: 1s\nvariants: {a: {method: rk4}}\n"), HasSubstr("panels of a comparison must not set it themselves"));
}

TEST_F(Suites, AllProblemsAreToldAtOnce) {
  const std::string text = error(
      "model: arn.urdf\nposes: {a: 3, \"\": [0], srdf: none.srdf}\nthem: dark\nsize: 640\ncamera: {azimut: 1, fit: [1, 0, 0, "
      "1]}\ntolerance: {error: 2, pixel: 1}\n"
      "masks: [[1, 2, 3]]\nphysics: ignore\ntheme: blue\nat: 3\n");
  EXPECT_THAT(text, HasSubstr("there is no file 'arn.urdf'"));
  EXPECT_THAT(text, HasSubstr("did you mean 'arm.urdf'?"));
  EXPECT_THAT(text, HasSubstr("pose 'a' must be a list of numbers"));
  EXPECT_THAT(text, HasSubstr("a pose has no name"));
  EXPECT_THAT(text, HasSubstr("snapshots.yaml:2:30: there is no file 'none.srdf'"));
  EXPECT_THAT(text, HasSubstr("unknown key 'them': did you mean 'theme'?"));
  EXPECT_THAT(text, HasSubstr("'size' must be width and height in pixels"));
  EXPECT_THAT(text, HasSubstr("unknown key 'camera.azimut': did you mean 'azimuth'?"));
  EXPECT_THAT(text, HasSubstr("'camera.fit' must grow"));
  EXPECT_THAT(text, HasSubstr("'tolerance.error' is a perceptual difference from 0 to 1"));
  EXPECT_THAT(text, HasSubstr("unknown key 'tolerance.pixel'"));
  EXPECT_THAT(text, HasSubstr("'masks' must be a list of boxes"));
  EXPECT_THAT(text, HasSubstr("'physics' must be fail, motion or note"));
  EXPECT_THAT(text, HasSubstr("'theme' must be light or dark"));
  EXPECT_THAT(text, HasSubstr("'at' goes with `scene:`"));
}

TEST_F(Suites, WhatIsNoSuiteSaysWhatToWrite) {
  EXPECT_THAT(error("[]"), HasSubstr("holds no suite: write `model: my_robot.urdf`"));
  EXPECT_THAT(error("size: 640x480\n"), HasSubstr("names nothing to show"));
  EXPECT_THAT(error("model: arm.urdf\nduration: 3\n"),
              HasSubstr("'duration' is a key of a scene: a suite names scenes"));
  EXPECT_THAT(error("model: swing.yaml\n"),
              HasSubstr("'swing.yaml' is no model: name scenes under `scene:`"));
  EXPECT_THAT(error("model: arm.urdf\nmasks: [[630, 0, 20, 10]]\n"),
              HasSubstr("leaves the picture 'arm' of 640x360"));
  EXPECT_THAT(error("model: arm.urdf\nposes: {a: {}}\npictures: {b: {size: 64x64}}\n"),
              HasSubstr("there is no picture 'b'"));
  EXPECT_THROW(read_suite(folder_.file("arm.urdf")), Error);
  EXPECT_THROW(read_suite(folder_.file("none.yaml")), Error);
}

TEST_F(Suites, AFolderIsTheScenesAndModelsInIt) {
  const Suite suite = read_suite(folder_.path().string());
  EXPECT_THAT(names(suite), ElementsAre("arm", "swing"));
  EXPECT_THAT(suite.pictures[0].q, ElementsAre(0, -1.75, 0));
  EXPECT_TRUE(suite.pictures[1].telling);
  EXPECT_EQ(suite.name, folder_.path().filename().string());
  // A scene and its model of one name, as `init` writes them.
  folder_.write("pair/one.urdf", read_whole_file(folder_.file("arm.urdf")));
  folder_.write("pair/one.yaml", "model: one.urdf\nduration: 1\nmethod: rk4\n");
  EXPECT_THAT(names(read_suite(folder_.file("pair"))), testing::UnorderedElementsAre("one", "one_model"));
  folder_.write("pair/ci.yaml", "scene: one.yaml\nmodel: one.urdf\n");
  EXPECT_THAT(names(read_suite(folder_.file("pair/ci.yaml"))), testing::UnorderedElementsAre("one", "one_model"));
  // What says what is to be shown is listened to.
  read("model: arm.urdf\nposes: {home: {}}\n");
  EXPECT_THAT(names(read_suite(folder_.path().string() + "/")), ElementsAre("home"));
  folder_.write("none/readme.txt", "");
  EXPECT_THROW(read_suite(folder_.file("none")), Error);
}

TEST(Suite, PublicRobotsHaveTheirNamedStatesAsPoses) {
  const std::string robots = public_robots_folder();
  if (robots.empty()) GTEST_SKIP() << kNoRobots;
  const TemporaryFolder folder;
  for (const auto& [model, srdf, name, count] :
       {std::tuple{"panda_description/urdf/panda.urdf", "panda_description/srdf/panda.srdf", "default", 8u},
        std::tuple{"bolt_description/robots/bolt.urdf", "bolt_description/srdf/bolt.srdf", "standing", 6u},
        std::tuple{"finger_edu_description/robots/finger_edu.urdf",
                   "finger_edu_description/srdf/finger_edu.srdf", "hanging", 3u}}) {
    const Suite suite = read_suite(folder.write(
        "s.yaml", "model: " + robots + "/" + model + "\nposes: {srdf: " + robots + "/" + srdf + "}\n"));
    ASSERT_EQ(suite.pictures.size(), 1u);
    EXPECT_EQ(suite.pictures[0].name, name);
    EXPECT_EQ(suite.pictures[0].q.size(), count);
  }
}

}  // namespace
}  // namespace chainreel
