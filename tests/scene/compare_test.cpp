// Scenes that compare: what each panel is, what it is called, whom an error blames.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/run/prepare.hpp"
#include "scene/text/panels.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/write_scene.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CompareScene : public WrittenScenes {
 protected:
  static std::vector<std::string> titles(Scene scene) {
    name_panels(scene.compare);
    std::vector<std::string> titles;
    for (const Scene& panel : scene.compare) titles.push_back(panel.title);
    return titles;
  }

  static std::vector<std::string> lines_of(const Scene& scene) {
    std::vector<std::string> lines;
    for (const SceneEntry& entry : entries_of(scene)) lines.push_back(entry.key + ": " + entry.text);
    return lines;
  }
};

TEST_F(CompareScene, GivesEachPanelTheSceneWithItsOwnChanges) {
  const Scene scene = read(
      "title: Whole\ntorque: [1, 2]\nduration: 3\nmethod: rk4\nstep: 0.01\nparameters: {k: 1}\ncompare:\n"
      "  - {step: 0.02, title: Left}\n"
      "  - {method: explicit_euler, torque.2: -3 * q1, parameters.k: 5, start.q: [90deg, 0], expect: "
      "diverge}\n");
  ASSERT_EQ(scene.compare.size(), 2u);
  const Scene &a = scene.compare[0], &b = scene.compare[1];
  EXPECT_EQ(scene.title, "Whole");
  EXPECT_EQ(a.title, "Left");
  EXPECT_EQ(b.title, "") << "the film's title is not a panel's";
  EXPECT_EQ(a.step, 0.02);
  EXPECT_EQ(b.step, 0.01);
  EXPECT_EQ(a.method, "rk4");
  EXPECT_EQ(b.method, "explicit_euler");
  EXPECT_EQ(a.torque[1].text, "2") << "a change in one panel reached another";
  EXPECT_EQ(b.torque[0].text, "1");
  EXPECT_EQ(b.torque[1].text, "-3 * q1");
  EXPECT_EQ(a.parameters[0].second, 1);
  EXPECT_EQ(b.parameters[0].second, 5);
  EXPECT_TRUE(a.start.q.empty());
  EXPECT_EQ(b.start.q.size(), 2u);
  EXPECT_EQ(a.expect, Outcome::finish);
  EXPECT_EQ(b.expect, Outcome::diverge);
  EXPECT_EQ(a.duration, 3);
  EXPECT_EQ(scene.layout, PageLayout::compare);
}

// What the page says is changed for one panel by the way that panels write it, too.
TEST_F(CompareScene, TakesChangesOfOnePanelFromTheCommandLine) {
  const std::string text = "torque: [1, 2]\npush: {force: [1, 0]}\ncompare: [{push.force.1: 5}, {}]\n";
  const std::string path = folder_.write("one.yaml", "model: rr.urdf\n" + text);
  const Scene scene = read_scene(path, {"compare.1.push.force.1=7", "compare.2.push.force.1=9", "compare.2.torque.2=4"});
  EXPECT_EQ(scene.compare[0].push[0].force[0], 7);
  EXPECT_EQ(scene.compare[1].push[0].force[0], 9);
  EXPECT_EQ(scene.compare[1].torque[1].text, "4");
  EXPECT_EQ(scene.compare[0].torque[1].text, "2");
}

TEST_F(CompareScene, NamesAPanelByWhatItDoesNotHaveAndByOneNumberForAll) {
  const std::string links = "{model: {links: [0.5, 0.4], masses: [2, 1]";
  EXPECT_THAT(titles(read("compare: [" + links + "}}, " + links + ", damping: 0.2}}]\n")), ElementsAre("no damping", "damping = 0.2 N m s/rad"));
}

TEST_F(CompareScene, OfOnePanelIsAPlainScene) {
  EXPECT_TRUE(read("").compare.empty());
  EXPECT_EQ(read("").layout, PageLayout::automatic);
  EXPECT_EQ(read("expect: diverge\n").expect, Outcome::diverge);
}

TEST_F(CompareScene, ChoosesTheLayoutByTheNumberOfPanels) {
  EXPECT_EQ(read("compare: [{}, {}]\n").layout, PageLayout::compare);
  EXPECT_EQ(read("compare: [{}, {}, {}]\n").layout, PageLayout::grid);
  EXPECT_EQ(read("compare: [{}, {}]\nlayout: grid\n").layout, PageLayout::grid);
  EXPECT_THAT(error("compare: [{}, {}, {}]\nlayout: compare\n"), HasSubstr("shows two panels, not 3"));
  EXPECT_THAT(error("compare: [{}, {}]\nlayout: scene\n"), HasSubstr("shows one panel"));
  EXPECT_THAT(error("layout: grid\n"), HasSubstr("needs `compare:`"));
  EXPECT_THAT(error("layout: compere\n"), HasSubstr("did you mean 'compare'?"));
}

TEST_F(CompareScene, TakesTwoToTwelvePanels) {
  EXPECT_THAT(error("compare: [{}]\n"), HasSubstr("one.yaml:2:10: 'compare' must be a list of 2 to 12"));
  std::string many = "compare: [{}";
  for (int i = 1; i < 12; ++i) many += ", {}";
  EXPECT_EQ(error(many + "]\n"), "");  // negative control
  EXPECT_THAT(error(many + ", {}]\n"), HasSubstr("2 to 12 panels"));
  EXPECT_THAT(error("compare: {method: rk4}\n"), HasSubstr("2 to 12 panels"));
  EXPECT_THAT(error("compare: [{}, rk4]\n"), HasSubstr("one.yaml:2:15: panel 2 must hold"));
}

TEST_F(CompareScene, BlamesTheLineOfThePanel) {
  const std::string head = "torque: [0, 0]\nstep: 0.01\nmethod: rk4\ncompare:\n  - {}\n";
  EXPECT_THAT(error(head + "  - {step: 0}\n"), HasSubstr("one.yaml:7:12: 'step' must be above"));
  EXPECT_THAT(error(head + "  - {method: rk5}\n"), HasSubstr("one.yaml:7:14: "));
  EXPECT_THAT(error(head + "  - {metod: rk4}\n"), HasSubstr("one.yaml:7:6: unknown key 'metod'"));
  EXPECT_THAT(error(head + "  - {start.p: [0, 0]}\n"), HasSubstr("one.yaml:7:6: unknown key 'start.p'"));
  EXPECT_THAT(error(head + "  - {torque.3: 1}\n"), HasSubstr("one.yaml:7:6: '3' is no index from 1 to 2"));
  EXPECT_THAT(error(head + "  - {duration: 1}\n"),
              HasSubstr("one.yaml:7:6: 'duration' belongs to the whole"));
  EXPECT_THAT(error(head + "  - {video.width: 640}\n"), HasSubstr("'video' belongs to the whole picture"));
  EXPECT_THAT(error(head + "  - {expect: explode}\n"), HasSubstr("'expect' must be finish, diverge or within_limits"));
}

TEST_F(CompareScene, TellsAProblemOfAllPanelsOnce) {
  const std::string text = error("colour: blue\ncompare: [{}, {method: rk4}, {}]\n");
  EXPECT_THAT(text, HasSubstr("one.yaml:2:1: unknown key 'colour'"));
  EXPECT_EQ(text.find("unknown key"), text.rfind("unknown key"));
}

TEST_F(CompareScene, TakesOverridesOfTheSceneAndOfItsPanels) {
  const std::string text = "method: rk4\nstep: 0.01\ntorque: [0, 0]\ncompare: [{}, {step: 0.02}]\n";
  const Scene scene = read(text, {"step=0.005", "compare.1.torque=[1, 2]", "compare.1.torque.2=7"});
  EXPECT_EQ(scene.compare[0].step, 0.005);
  EXPECT_EQ(scene.compare[1].step, 0.02) << "what a panel says is stronger";
  EXPECT_EQ(scene.compare[0].torque[1].text, "7");
  EXPECT_EQ(scene.compare[1].torque[1].text, "0");
  EXPECT_THAT(error(text, {"compare.2.step=0"}), HasSubstr("--set compare.2.step=0: 'step' must be"));
  EXPECT_THAT(error(text, {"compare.2.stp=1"}), HasSubstr("--set compare.2.stp=1: unknown key 'stp'"));
  EXPECT_THAT(error(text, {"step=0"}), HasSubstr("--set step=0: 'step' must be"));
  EXPECT_THAT(error(text, {"compare.3.step=1"}), HasSubstr("no index from 1 to 2"));
}

TEST_F(CompareScene, RefusesOverridesThatEachPanelOverrules) {
  const std::string text = "title: T\ntorque: [0, 0]\nstart: {q: [0, 0]}\ncompare: [{title: A, method: rk4, start: {q: [1, 0]}}, {title: B, method: verlet, start.q.1: 2}]\n";
  EXPECT_THAT(error(text, {"method=taylor"}), HasSubstr("--set method=taylor: 'method' is set by each panel"));
  EXPECT_THAT(error(text, {"start.q.1=3"}), HasSubstr("--set compare.1.start.q.1=3"));
  EXPECT_EQ(read(text, {"start.q.2=3"}).compare[1].start.q[1], 3) << "one panel takes it";
  EXPECT_THAT(error(text, {"method=taylor", "compare.1.method=dop853"}), HasSubstr("--set method=taylor")) << "a panel's by another --set";
  EXPECT_THAT(error("parameters: {F: 1}\ntorque: [F, 0]\ncompare: [{parameters.F: 2}, {parameters.F: 3}]\n", {"parameters={F: 9}"}),
              HasSubstr("'parameters' is set by each panel"));
  EXPECT_EQ(read(text, {"title=U"}).title, "U") << "of the page, whatever its panels are called";
  EXPECT_EQ(read(text, {"compare.2.method=taylor"}).compare[1].method, "taylor");
  EXPECT_EQ(read(text, {"duration=2"}).compare[0].duration, 2);
}

TEST_F(CompareScene, NamesPanelsByWhatDiffers) {
  EXPECT_THAT(titles(read("method: rk4\ncompare: [{method: explicit_euler}, {}]\n")),
              ElementsAre("explicit Euler", "RK4"));
  EXPECT_THAT(titles(read("compare: [{step: 0.01, method: rk4}, {step: 0.001, method: rk4, title: mine}]\n")),
              ElementsAre("step 0.01 s", "mine"));
  EXPECT_THAT(titles(read("compare: [{torque: [1, 0]}, {torque: [2, 0]}]\n")),
              ElementsAre("$tau_1$ = 1", "$tau_1$ = 2"));
  EXPECT_THAT(titles(read("compare: [{torque: [1, 0]}, {torque: [2, -3]}]\n")),
              ElementsAre("\u03C4 = (1, 0)", "\u03C4 = (2, \u22123)"));
  EXPECT_THAT(titles(read("compare: [{torque: [\"sin(t)\", 0]}, {torque: [2, 0]}]\n")),
              ElementsAre("$tau_1$ = sin(t)", "$tau_1$ = 2"));
  // Gravity straight down is told by its size, else by what differs.
  EXPECT_THAT(titles(read("compare: [{gravity: [0, -9.81, 0]}, {gravity: [0, -1.62, 0]}, {gravity: [0, 0, 0]}]\n")),
              ElementsAre("$g$ = 9.81 m/s\u00B2", "$g$ = 1.62 m/s\u00B2", "$g$ = 0 m/s\u00B2"));
  EXPECT_THAT(titles(read("compare: [{gravity: [0, -9.81, 0]}, {gravity: [0, 9.81, 0]}]\n")),
              ElementsAre("$g_y$ = \u22129.81 m/s\u00B2", "$g_y$ = 9.81 m/s\u00B2"));
  EXPECT_THAT(titles(read("parameters: {k: 1}\ncompare: [{parameters.k: 5}, {}]\n")),
              ElementsAre("k = 5", "k = 1"));
  EXPECT_THAT(titles(read("compare: [{}, {}]\n")), ElementsAre("panel 1", "panel 2"));
  // Of a torque in several words, what differs within it.
  EXPECT_THAT(titles(read("torque: {gravity_compensation: true, pd: {kp: 60, kd: 10, q: [0.5, 0.5]}}\n"
                          "compare: [{torque.pd.kp: 10}, {}]\n")),
              ElementsAre("$k_p$ = 10", "$k_p$ = 60"));
  EXPECT_THAT(titles(read("torque: {pd: {kp: [60, 30], kd: 10, q: [0.5, 0.5]}}\ncompare: [{torque.pd.kp: [1, 2], torque.pd.kd: 3}, {}]\n")),
              ElementsAre("$k_d$ = 3, $k_p$ = (1, 2)", "$k_d$ = 10, $k_p$ = (60, 30)"));
  EXPECT_THAT(titles(read("torque: {pd: {kp: 60, kd: 10, q: [0.5, 0.5]}}\ncompare: [{torque: [1, 0]}, {}]\n")).front(),
              HasSubstr("(1, 0)"));
  // Of starts the elements that differ, in the unit in which they were written; as many digits as one reads, and all of them where
  // that would not tell panels apart.
  EXPECT_THAT(titles(read("compare: [{start.q: [-20deg, 0]}, {start.q: [-40deg, 0]}]\n")),
              ElementsAre("$q_1(0)$ = \u221220\u00B0", "$q_1(0)$ = \u221240\u00B0"));
  EXPECT_THAT(titles(read("start: {q: [-90deg, 0]}\ncompare: [{}, {start.q.2: 90deg}, {start.q.2: 0.5}]\n")),
              ElementsAre("$q_2(0)$ = 0\u00B0", "$q_2(0)$ = 90\u00B0", "$q_2(0)$ = 0.5"));
  EXPECT_THAT(titles(read("compare: [{start.q: [1, 0]}, {start.q: [2, -45deg]}]\n")),
              ElementsAre("q(0) = (1, 0\u00B0)", "q(0) = (2, \u221245\u00B0)"));
  EXPECT_THAT(titles(read("method: rk4\ncompare: [{step: 1.23456781e-05}, {step: 1.23456782e-05}]\n")),
              ElementsAre("step 1.23456781e-05 s", "step 1.23456782e-05 s"));
}

TEST_F(CompareScene, ReadsWhatItWrites) {
  Scene scene = read(
      "title: Two\ntorque: [1, 2]\nmethod: rk4\nstep: 0.01\nparameters: {k: 1, m: 2}\ncompare:\n"
      "  - {step: 0.02, title: Left}\n"
      "  - {method: dop853, parameters.k: 5, start: {q: [1, 2]}, expect: diverge}\n",
      {"compare.2.title=\"right: b\""});
  for (Scene& panel : scene.compare) panel.model = "rr.urdf";
  const Scene again = read_scene(folder_.write("again.yaml", scene_text(scene)));
  ASSERT_EQ(again.compare.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    Scene expected = scene.compare[i];
    expected.model = again.compare[i].model;  // as found from the working folder
    EXPECT_THAT(lines_of(again.compare[i]), testing::UnorderedElementsAreArray(lines_of(expected)));
    EXPECT_EQ(again.compare[i].title, expected.title);
  }
  EXPECT_EQ(again.title, "Two");
  EXPECT_EQ(again.layout, PageLayout::compare);
  // What the panels share is written once.
  const std::string text = scene_text(scene);
  EXPECT_EQ(text.find("torque:"), text.rfind("torque:"));
  EXPECT_NE(text.find("step:"), text.rfind("step:"));  // negative control
}

}  // namespace
}  // namespace chainreel
