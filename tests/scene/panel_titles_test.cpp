// What panels without a title are called: by every key in which they may differ.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "scene/keys/keys.hpp"
#include "scene/text/panels.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Two turning joints, or one and a slider.
const CoordinateUnits kTurning{{"rad", "rad"}, {"rad", "rad"}, {{"shoulder", "rad"}}}, kSliding{{"rad", "m"}, {"rad", "m"}, {}};

class PanelTitles : public WrittenScenes {
 protected:
  std::vector<std::string> titles(const std::string& head, const std::string& first, const std::string& second, const CoordinateUnits& units = kTurning) {
    return titles(head + "compare: [" + first + ", " + second + "]\n", units);
  }
  std::vector<std::string> titles(const std::string& text, const CoordinateUnits& units = kTurning) {
    const bool has_model = text.starts_with("model:");
    Scene scene = has_model ? read_scene(folder_.write("own.yaml", text)) : read(text);
    name_panels(scene.compare, units);
    std::vector<std::string> titles;
    for (const Scene& panel : scene.compare) titles.push_back(panel.title);
    return titles;
  }
};

struct Case {
  const char *head, *first, *second, *expected_first, *expected_second;
};

const Case kCases[] = {
    {"", "{torque: {pd: {kp: 50, kd: 5, q: [1, 0]}}}", "{torque: {computed_torque: {kp: 50, kd: 5, q: [1, 0]}}}", "PD", "computed torque"},
    {"", "{torque: {pd: {kp: 50, kd: 5, q: [1, 0]}}}", "{torque: {pd: {kp: 50, kd: 5, q: [1, 0]}, gravity_compensation: true}}", "PD", "PD + gravity compensation"},
    {"", "{torque: {pd: {kp: 50, kd: 5, q: [1, 0]}}}", "{}", "PD", "no torque"},
    {"", "{torque: {pd: {kp: 50, kd: 5, q: [1, 0]}}}", "{torque: [1, 0]}", "PD", "τ = (1, 0) N m"},
    {"", "{torque: {task: {kp: 50, kd: 5, x: [1, 0]}}}", "{torque: {task: {kp: 80, kd: 5, x: [1, 0]}}}", "$k_p$ = 50 N/m", "$k_p$ = 80 N/m"},
    {"", "{torque: {task: {kp: 50, kd: 5, x: [1, 0]}}}", "{torque: {task: {kp: 50, kd: 5, x: [1, 0.5]}}}", "$y_{ref}$ = 0 m", "$y_{ref}$ = 0.5 m"},
    {"", "{torque: {pd: {kp: 50, kd: 5, q: [30deg, 0]}}}", "{torque: {pd: {kp: 50, kd: 5, q: [-45deg, 0]}}}", "$q_{ref, 1}$ = 30°", "$q_{ref, 1}$ = −45°"},
    {"", "{torque: {pd: {kp: 50, kd: 5, q: [0.5, pi/2]}}}", "{torque: {pd: {kp: 50, kd: 5, q: [1, pi]}}}", "$q_{ref}$ = (28.65°, 90°)", "$q_{ref}$ = (57.3°, 180°)"},
    {"", "{torque: {pd: {kp: 50, kd: 5, q: [\"sin(2*t)\", 0]}}}", "{torque: {pd: {kp: 50, kd: 5, q: [\"sin(3*t)\", 0]}}}", "$q_{ref, 1}$ = sin(2·t)", "$q_{ref, 1}$ = sin(3·t)"},
    {"", "{torque: [{pd: {kp: 50, kd: 5, q: 1}}, 0]}", "{torque: [{pd: {kp: 60, kd: 5, q: 1}}, 0]}", "$k_p$ = 50", "$k_p$ = 60"},
    {"", "{torque: [\"-100 * y_G\", 0]}", "{torque: [\"-50 * y_G\", 0]}", "$tau_1$ = −100·y_G", "$tau_1$ = −50·y_G"},
    {"", "{torque: {plus: [1, 0]}}", "{torque: {plus: [2, 0]}}", "$tau_1$ plus 1 N m", "$tau_1$ plus 2 N m"},
    {"", "{torque: [1, 0]}", "{torque: [2, 0]}", "$tau_1$ = 1 N m", "$tau_1$ = 2 N m"},
    {"", "{start.q: [1, 0]}", "{start.q: [2, 0]}", "$q_1(0)$ = 57.3°", "$q_1(0)$ = 114.6°"},
    {"", "{start.q: [pi/2, 0]}", "{}", "$q_1(0)$ = 90°", "$q_1(0)$ = 0°"},
    {"", "{start.qd: [1, 0]}", "{start.qd: [90deg/s, 0]}", "$qd_1(0)$ = 1 rad/s", "$qd_1(0)$ = 90°/s"},
    {"", "{gravity: [0, -9.80665, 0]}", "{gravity: [0, -1.62, 0]}", "$g$ = 9.80665 m/s²", "$g$ = 1.62 m/s²"},
    {"", "{gravity: [0, -9.80665, 0]}", "{}", "gravity = (0, −9.80665, 0)", "default gravity"},
    {"", "{base: floating}", "{base: fixed}", "floating base", "fixed base"},
    {"", "{friction: false}", "{}", "no friction", "friction"},
    {"", "{massless: 1e-6}", "{massless: 1e-3}", "massless links 10⁻⁶ kg", "massless links 0.001 kg"},
    {"", "{payload.mass: 2}", "{payload.mass: 3}", "payload 2 kg", "payload 3 kg"},
    {"", "{payload: {mass: 2, at: [0.1, 0, 0]}}", "{payload: {mass: 2, at: [0.2, 0, 0]}}", "payload at $x$ = 0.1 m", "payload at $x$ = 0.2 m"},
    {"", "{payload: {mass: 2}}", "{}", "payload 2 kg", "no payload"},
    {"", "{payload: {mass: 2, link: arm}}", "{payload: {mass: 2, link: hand}}", "payload on arm", "payload on hand"},
    {"", "{limit: clamp}", "{limit: stop}", "limits: clamp", "limits: stop"},
    {"", "{packages: {r: a/robot}}", "{packages: {r: b/robot}}", "a/robot", "b/robot"},
    {"", "{push: {force: [60, 0], until: 0.1}}", "{}", "push", "no push"},
    {"", "{push: {force: [60, 0], until: 0.1}}", "{push: {force: [80, 0], until: 0.1}}", "push $F_x$ = 60 N", "push $F_x$ = 80 N"},
    {"", "{push: {force: [60, 0], until: 0.1}}", "{push: {force: [60, 0], until: 0.2}}", "push until 0.1 s", "push until 0.2 s"},
    {"", "{motion: a.csv}", "{motion: b.csv}", "motion a", "motion b"},
    {"", "{motion: a.csv}", "{}", "motion a", "computed"},
    {"", "{parameters: {w: pi}}", "{parameters: {w: pi/2}}", "w = π", "w = π/2"},
    {"", "{constraints: [{line: {frame: g, point: [0, 0.5], direction: [1, 0]}}]}", "{}", "line", "no constraints"},
    {"", "{constraints: [{line: {frame: g, point: [0, 0.5], direction: [1, 0]}}]}", "{constraints: [{line: {frame: g, point: [0, 0.7], direction: [1, 0]}}]}", "through $y$ = 0.5 m", "through $y$ = 0.7 m"},
    {"", "{constraints: [{line: {frame: g, point: [0, 0.5], direction: [1, 0]}}]}", "{constraints: [{point: {frame: g, at: [0, 0.7]}}]}", "line", "point"},
    {"", "{constraints: [{distance: {a: g, at: [0, 1], length: 0.5}}]}", "{constraints: [{distance: {a: g, at: [0, 1], length: 0.75}}]}", "length 0.5 m", "length 0.75 m"},
    {"", "{constraints: [{joint: {name: shoulder, value: 30deg}}]}", "{constraints: [{joint: {name: shoulder, value: 45deg}}]}", "shoulder = 30°", "shoulder = 45°"},
    {"constraints: [{line: {frame: g, point: [0, 0.5], direction: [1, 0]}}]\n", "{stabilize: baumgarte}", "{stabilize: none}", "drift: baumgarte", "drift: none"},
    {"constraints: [{line: {frame: g, point: [0, 0.5], direction: [1, 0]}}]\nstabilize: baumgarte\n", "{baumgarte.gain: 5}", "{}", "Baumgarte gain 5 1/s", "Baumgarte gain 10 1/s"},
    {"constraints: [{line: {frame: g, point: [0, 0.5], direction: [1, 0]}}]\n", "{contact_force: {force: [0, -5]}}", "{contact_force: {force: [0, -8]}}", "contact force $F_y$ = −5 N", "contact force $F_y$ = −8 N"},
    {"constraints: [{line: {frame: g, point: [0, 0.5], direction: [1, 0]}}]\n", "{contact_force: {force: [0, -5]}}", "{}", "contact force", "no contact force"},
    {"", "{end_effector: hand}", "{end_effector: arm}", "end effector hand", "end effector arm"},
    {"", "{frames: {H: hip}}", "{frames: {H: knee}}", "H = hip", "H = knee"},
    {"", "{foot: {heel: -0.06, toe: 0.19, height: 0}}", "{foot: {heel: -0.06, toe: 0.25, height: 0}}", "toe at 0.19 m", "toe at 0.25 m"},
    {"", "{events: [{when: \"y_G < 0.5\"}]}", "{events: [{when: \"y_G < 0.25\"}]}", "event y_G < 0.5", "event y_G < 0.25"},
    {"", "{events: [{when: \"y_G < 0.5\"}]}", "{}", "event", "no events"},
    {"", "{method: rk4}", "{method: dop853}", "RK4", "DOP853"},
    {"method: rk4\n", "{step: 0.01}", "{}", "step 0.01 s", "default step"},
    {"method: dop853\n", "{tolerance: 1e-10}", "{tolerance: 1e-6}", "tolerance 10⁻¹⁰", "tolerance 10⁻⁶"},
    {"method: taylor\n", "{order: 12}", "{order: 20}", "order 12", "order 20"},
    {"", "{accuracy: 0.1 px}", "{accuracy: 1 px}", "accuracy 0.1 px", "accuracy 1 px"},
    {"", "{links: plain}", "{links: visual}", "links: plain", "links: visual"},
    {"", "{mesh_up: file}", "{}", "mesh up: file", "mesh up: rviz"},
};

TEST_F(PanelTitles, TellApartWhateverKeyDiffers) {
  constexpr std::size_t kLongest = 48;  // bytes: what half a page holds at its least size
  for (const char* table : {"a.csv", "b.csv"}) folder_.write(table, "t,q1,q2\n0,0,0\n1,1,1\n");
  std::set<std::string> keys;
  for (const Case& one : kCases) {
    const std::vector<std::string> own = titles(one.head, one.first, one.second);
    EXPECT_THAT(own, ElementsAre(one.expected_first, one.expected_second)) << one.first << " beside " << one.second;
    EXPECT_NE(own[0], own[1]) << one.first;
    for (const std::string& title : own) EXPECT_LE(title.size(), kLongest) << title;
    const std::string first = std::string(one.first).substr(1);
    const std::string key = first.substr(0, first.find(':'));
    for (const SceneKey& row : scene_keys())
      if (row.name == key || row.name.starts_with(key + ".") || std::string(one.first).find(row.leaf() + ":") != std::string::npos) keys.insert(row.name);
  }
  // Every key that panels may have for themselves is among them; `model` has a test of its own, the others are in no title.
  for (const SceneKey& row : scene_keys()) {
    if (row.of == KeyOf::page || row.is_section || !row.is_captioned || row.name == "model") continue;
    EXPECT_TRUE(keys.contains(row.name)) << row.name << " has no case here";
  }
}

TEST_F(PanelTitles, TellModelsByWhatDiffers) {
  const std::string links = "model: {links: [0.5, 0.4], masses: [2, 1]}\n";
  EXPECT_THAT(titles(links, "{}", "{model: {links: [0.5, 0.6], masses: [2, 1]}}"), ElementsAre("$l_2$ = 0.4 m", "$l_2$ = 0.6 m"));
  EXPECT_THAT(titles(links, "{}", "{model: {links: [0.5, 0.4], masses: [3, 1]}}"), ElementsAre("$m_1$ = 2 kg", "$m_1$ = 3 kg"));
  EXPECT_THAT(titles(links, "{}", "{model: {links: [0.5, 0.4], masses: [2, 1], joints: RP}}"), ElementsAre("joints RR", "joints RP"));
  folder_.write("other.urdf", "<robot/>");
  EXPECT_THAT(titles("", "{}", "{model: other.urdf}"), ElementsAre("rr", "other"));
}

// Units are those of the joints; of models that differ in them there are none.
TEST_F(PanelTitles, HaveTheUnitsOfTheirJoints) {
  EXPECT_THAT(titles("", "{start.q: [0, 0.5]}", "{start.q: [0, 0.7]}", kSliding), ElementsAre("$q_2(0)$ = 0.5 m", "$q_2(0)$ = 0.7 m"));
  EXPECT_THAT(titles("", "{start.q: [0, 0.5]}", "{start.q: [0, 0.7]}", {}), ElementsAre("$q_2(0)$ = 0.5", "$q_2(0)$ = 0.7"));
  EXPECT_THAT(titles("", "{torque: [0, 5]}", "{torque: [0, 7]}", kSliding), ElementsAre("$tau_2$ = 5 N", "$tau_2$ = 7 N"));
  EXPECT_THAT(titles("", "{torque: [1, 5]}", "{torque: [2, 7]}", kSliding), ElementsAre("\u03C4 = (1 N m, 5 N)", "\u03C4 = (2 N m, 7 N)"));
}

// Of one control numbers, beside others its name, too.
TEST_F(PanelTitles, NameControlsAndWhatDiffersAmongEqualOnes) {
  const std::string pd = "{torque: {pd: {kp: 50, kd: 5, q: [1, 0]}}}", stiff = "{torque: {pd: {kp: 90, kd: 5, q: [1, 0]}}}",
                    computed = "{torque: {computed_torque: {kp: 50, kd: 5, q: [1, 0]}}}";
  EXPECT_THAT(titles("compare: [" + pd + ", " + stiff + ", " + computed + "]\n"),
              ElementsAre("PD, $k_p$ = 50", "PD, $k_p$ = 90", "computed torque"));
}

// What is left out to make them short is an ellipsis, and no title is another one's.
TEST_F(PanelTitles, SayWhatTheyLeaveOut) {
  const std::vector<std::string> own =
      titles("", "{gravity: [0, -1.62, 0], friction: false, start.q: [30deg, 0], start.qd: [1, 2], torque: [1, 2]}", "{gravity: [0, -9.81, 0]}");
  EXPECT_THAT(own[0], testing::EndsWith(", \u2026"));
  EXPECT_THAT(own[0], HasSubstr("1.62 m/s\u00B2"));
  EXPECT_NE(own[0], own[1]);
  // Of several keys those that tell panels apart: here no gravity does.
  EXPECT_THAT(titles("compare: [{start.q: [30deg, 0]}, {start.q: [40deg, 0]}, {gravity: [0, -1.62, 0], start.q: [50deg, 0], torque: [1, 2], start.qd: [1, 2]}]\n"),
              ElementsAre("$q_1(0)$ = 30\u00B0, no torque, \u2026", "$q_1(0)$ = 40\u00B0, no torque, \u2026", "$q_1(0)$ = 50\u00B0, \u03C4 = (1, 2) N m, \u2026"));
}

}  // namespace
}  // namespace chainreel
