// The keys `constraints`, `stabilize`, `baumgarte`, `contact_force`: read, written, refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/constraints/constraint_set.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/write_scene.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

template <class Form>
const Form& form_of(const Scene& scene, std::size_t k) {
  return std::get<Form>(scene.constraints.at(k).form);
}

class SceneConstraints : public ::testing::Test {
 protected:
  // A scene on a chain of models/, with these keys.
  Scene read(const std::string& text, const std::string& model = "rrr") {
    return read_scene(
        folder_.write("one.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/" + model + ".urdf\n" + text));
  }
  Simulation ready(const std::string& text, const std::string& model = "rrr") {
    Scene scene = read(text, model);
    Simulation simulation = prepare(scene);
    notices_ = scene.notices;
    return simulation;
  }
  // The text of the error, or "" where there is none.
  std::string error(const std::string& text, const std::string& model = "rrr") {
    try {
      ready(text, model);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

  TemporaryFolder folder_;
  std::vector<std::string> notices_;
};

const std::string kPenStart = "start: {q: [90deg, -60deg, -120deg]}\n";

TEST_F(SceneConstraints, EveryKindIsReadAndWrittenBackTheSame) {
  const std::string text =
      "parameters: {r: 0.5}\n"
      "constraints:\n"
      "  - {line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}\n"
      "  - {plane: {frame: gripper, point: [0, 0.5, 0], normal: [0, 1, 0]}}\n"
      "  - {point: {frame: gripper, at: [1, 0.5]}}\n"
      "  - {distance: {a: gripper, b: base, length: 1.2}}\n"
      "  - {distance: {a: gripper, at: [2, 0], length: 1.2}}\n"
      "  - {close: {a: gripper, b: link1}}\n"
      "  - {close: {a: gripper, b: link1, weld: true}}\n"
      "  - {close: {a: gripper, b: link1, axis: [0, 0, 1]}}\n"
      "  - {close: {a: gripper, at: [1, 1]}}\n"
      "  - {curve: {frame: gripper, x: \"1 + r * cos(s)\", y: \"max(r, 2) * sin(s)\", s: 0.5}}\n"
      "  - {joint: {name: joint2, value: 90deg}}\n"
      "  - {linear: {coefficients: {joint1: 1, joint2: -2}, value: 0.5}}\n"
      "stabilize: baumgarte\nbaumgarte: {gain: 20}\n"
      "contact_force: [{constraint: 1, force: [0, -5]}, {constraint: 3, force: [1, 2, 0]}]\n";
  const Scene scene = read(text);
  ASSERT_EQ(scene.constraints.size(), 12u);
  EXPECT_EQ(form_of<DistanceEntry>(scene, 3).b, "base");
  EXPECT_EQ(form_of<CurveEntry>(scene, 9).y, "max(r, 2) * sin(s)");
  EXPECT_EQ(scene.baumgarte_gain, 20);
  EXPECT_EQ(scene.contact_force[1].force, (std::vector<double>{1, 2, 0}));
  const std::string written = scene_text(scene);
  const Scene again = read_scene(folder_.write("two.yaml", written));
  EXPECT_EQ(scene_text(again), written);
  ASSERT_EQ(again.constraints.size(), 12u);
  EXPECT_EQ(form_of<CurveEntry>(again, 9).y, form_of<CurveEntry>(scene, 9).y);
  EXPECT_EQ(form_of<LinearEntry>(again, 11).coefficients, form_of<LinearEntry>(scene, 11).coefficients);
  EXPECT_EQ(form_of<CloseEntry>(again, 7).closure, Closure::axis);
}

TEST_F(SceneConstraints, SayHowDriftIsHeldOffAndAreProjectedOntoWhereTheySayNothing) {
  const std::string pen = kPenStart + "constraints: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]\n";
  const auto plan = [&](const std::string& more) { return ready(pen + more).constraints; };
  EXPECT_EQ(plan("").stabilize, Stabilization::project);
  EXPECT_EQ(plan("stabilize: project\n").stabilize, Stabilization::project);
  EXPECT_EQ(plan("stabilize: none\n").stabilize, Stabilization::none);
  EXPECT_EQ(plan("stabilize: baumgarte\n").stabilize, Stabilization::baumgarte);
  EXPECT_EQ(plan("stabilize: baumgarte\n").gain, 10);
  EXPECT_EQ(plan("stabilize: baumgarte\nbaumgarte: {gain: 25}\n").gain, 25);
}

TEST_F(SceneConstraints, PlacesOfTheWorldStandWhereFramesCould) {
  const Simulation one =
      ready(kPenStart + "constraints: [{close: {a: gripper, at: [0.8660254037844386, 0.5]}}]\n");
  EXPECT_TRUE(std::holds_alternative<PointConstraint>(one.constraints.list[0]));
  const Simulation rod = ready(kPenStart + "constraints: [{distance: {a: gripper, b: world, length: 1}}]\n");
  const ConstraintSet set(rod.chain, rod.constraints.list);
  EXPECT_EQ(set.rows(), 1);
  EXPECT_TRUE(notices_.empty()) << notices_[0];
}

TEST_F(SceneConstraints, AStartALittleBesideIsMovedWithANotice) {
  const std::string line = "constraints: [{line: {frame: gripper, point: [0, 0.52], direction: [1, 0]}}]\n";
  const Simulation moved = ready(kPenStart + line);
  ASSERT_EQ(notices_.size(), 1u);
  EXPECT_THAT(notices_[0], HasSubstr("0.02 m off 'line gripper'"));
  EXPECT_NE(moved.q0[0], 1.5707963267948966);
  ready(
      "start: {q: [90deg, -60deg, -120deg], qd: [1, 0, 0]}\n"
      "constraints: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]\n");
  ASSERT_EQ(notices_.size(), 1u);
  EXPECT_THAT(notices_[0], HasSubstr("rates left the constraints by 0.866"));
}

// Who wrote no start means none: any pose that holds them will do, and is told.
TEST_F(SceneConstraints, AStartThatNobodyWroteMayBeFarFromTheOneThatIsTaken) {
  const std::string line = "constraints: [{line: {frame: gripper, point: [0, 1.0], direction: [1, 0]}}]\n";
  const Simulation found = ready(line);
  ASSERT_EQ(notices_.size(), 1u);
  EXPECT_THAT(notices_[0], AllOf(HasSubstr("1 m off 'line gripper'"), HasSubstr("was moved to q = ")));
  EXPECT_NEAR(std::sin(found.q0[0]) + std::sin(found.q0[0] + found.q0[1]) + std::sin(found.q0[0] + found.q0[1] + found.q0[2]), 1, 1e-13);
  EXPECT_THAT(error("start: {q: [0, 0, 0]}\n" + line), HasSubstr("if it is meant"));
}

// A crank is where the start says, and turns as fast; the rest of the linkage follows. Oracle: the loop's two equations by hand.
TEST_F(SceneConstraints, JointsThatAStartDoesNotNameFollow) {
  const std::string bars = "{links: [0.3, 0.9, 0.7], masses: [0.5, 1.5, 1], joints: RRR}\n";
  const std::string loop = "constraints: [{close: {a: gripper, at: [0.8, 0]}}]\n";
  const auto prepared = [&](const std::string& start) {
    Scene scene = read_scene(folder_.write("bars.yaml", "model: " + bars + start + loop));
    Simulation simulation = prepare(scene);
    notices_ = scene.notices;
    return simulation;
  };
  for (const double crank : {0.2, 1.0471975511965976, 2.5, -1.2}) {
    const Simulation found = prepared("start: {q: {joint1: " + format_shortest(crank) + "}, qd: {joint1: 6}}\n");
    const std::vector<double>&q = found.q0, &qd = found.qd0;
    EXPECT_NEAR(q[0], crank, 1e-14);
    EXPECT_EQ(qd[0], 6);
    const double lengths[] = {0.3, 0.9, 0.7};
    double x = -0.8, y = 0, xd = 0, yd = 0, angle = 0, rate = 0;
    for (int i = 0; i < 3; ++i) {
      angle += q[std::size_t(i)], rate += qd[std::size_t(i)];
      x += lengths[i] * std::cos(angle), y += lengths[i] * std::sin(angle);
      xd -= lengths[i] * rate * std::sin(angle), yd += lengths[i] * rate * std::cos(angle);
    }
    EXPECT_LT(std::max(std::abs(x), std::abs(y)), 1e-13) << crank;
    EXPECT_LT(std::max(std::abs(xd), std::abs(yd)), 1e-12) << crank;
    EXPECT_THAT(notices_, testing::ElementsAre(HasSubstr("the joints whose angles the constraints decide follow: q = "),
                                               HasSubstr("the rates that the start does not name follow: qd = ")));
  }
  // The linkage is put together in one way all round: whatever the crank's angle, no other way, no turns, and the next is near.
  std::optional<std::vector<double>> before;
  for (int degrees = 0; degrees < 360; degrees += 3) {
    const std::vector<double> q = prepared("start: {q: {joint1: " + std::to_string(degrees) + "deg}}\n").q0;
    EXPECT_LT(q[2], 0) << degrees;
    EXPECT_LE(std::abs(q[1]), std::numbers::pi) << degrees;
    if (before) {
      EXPECT_LT(std::abs(std::remainder(q[1] - (*before)[1], 2 * std::numbers::pi)), 0.2) << degrees;
      EXPECT_LT(std::abs(q[2] - (*before)[2]), 0.2) << degrees;
    }
    before = q;
  }
  // The other way is had by saying about where another joint stands.
  const std::vector<double> up = prepared("start: {q: {joint1: 1}}\n").q0;
  const std::vector<double> other = prepared("start: {q: {joint1: 1, joint3: 120deg}}\n").q0;
  EXPECT_EQ(other[0], 1);
  EXPECT_THAT(notices_, testing::Contains(AllOf(HasSubstr("; joint3, though named, stands at "), HasSubstr(" and not at 2.0944"), testing::Not(HasSubstr("joint1, though")))));
  EXPECT_NEAR(other[2], -up[2], 1e-9) << "the mirrored one has the same angle between the bars";
  // Feedback that does not know of the ties is told of.
  prepared("start: {q: {joint1: 1}}\ntorque: {computed_torque: {kp: 100, kd: 20, q: [1, 0, 0]}}\n");
  EXPECT_THAT(notices_, testing::Contains(HasSubstr("computed_torque takes M and h of the chain without its constraints")));
  // What no constraint touches stays where it is; limits of joints choose, too.
  Scene geared = read_scene(folder_.write("gear.yaml", "model: {links: [0.3, 0.3, 0.3], joints: RRR}\nstart: {q: {joint1: 60deg}}\n"
                                                       "constraints: [{linear: {coefficients: {joint1: 1, joint2: -2}, value: 0}}]\n"));
  EXPECT_EQ(prepare(geared).q0[2], 0);
  for (const int degrees : {45, 90, 135}) {
    Scene crank = read_scene(std::string(CHAINREEL_SOURCE_FOLDER) + "/assets/scenes/slider_crank.yaml", {"start={q: {crank_joint: " + std::to_string(degrees) + "deg}}"});
    EXPECT_GT(prepare(crank).q0[2], 0.4) << degrees << ": the slider is within 0.5 to 1.5 m";
  }
  // What no pose has is refused and nothing else moved; all joints named are a start as any other.
  try {
    prepared("start: {q: {joint1: 1, joint2: 0}}\n");
    FAIL() << "three bars with two angles given do not close there";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("bars.yaml:2:"), HasSubstr("no pose on the constraints was found at which joint1 = 1, joint2 = 0"),
                                    HasSubstr("or leave it out, `start: {q: {joint1: 1}}`: the others follow")));
  }
  EXPECT_THROW(prepared("start: {q: {joint1: 1, joint2: 0, joint3: 0}}\n"), Error);
  // The start that a refusal advises is on the constraints, and nothing is said of it.
  try {
    prepared("start: {q: [1.0, -0.2, -1.5]}\n");
    FAIL() << "too far to be meant";
  } catch (const Error& error) {
    const std::string text = error.what(), begin = "write `", end = "` if it is meant";
    const std::size_t at = text.find(begin) + begin.size();
    prepared(text.substr(at, text.find(end) - at) + "\n");
    EXPECT_TRUE(notices_.empty()) << notices_.front();
    EXPECT_THAT(text, HasSubstr("name the joints that are to stand so, `start: {q: {joint1: 1}}`"));
  }
}

TEST_F(SceneConstraints, WhatCannotBeReachedIsRefusedWithTheDistance) {
  EXPECT_THAT(
      error(kPenStart + "constraints: [{line: {frame: gripper, point: [0, 3.5], direction: [1, 0]}}]\n"),
      AllOf(HasSubstr("one.yaml:3:"), HasSubstr("'line gripper' is out of reach"), HasSubstr("0.5")));
  EXPECT_THAT(error("start: {q: [180deg, -140deg, -90deg]}\n"
                    "constraints: [{close: {a: rocker_end, at: [5, 0]}}]\n",
                    "four_bar"),
              AllOf(HasSubstr("one.yaml:3:"), HasSubstr("out of reach"), HasSubstr("2.5")));
  EXPECT_THAT(error(kPenStart + "constraints:\n"
                                "  - {line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}\n"
                                "  - {line: {frame: gripper, point: [0, 0.6], direction: [1, 0]}}\n"),
              AllOf(HasSubstr("contradict each other"), HasSubstr("leave one out")));
  EXPECT_THAT(
      error(kPenStart + "constraints: [{line: {frame: gripper, point: [0, 2.5], direction: [1, 0]}}]\n"),
      HasSubstr("if it is meant"))
      << "far, but not out of reach";
}

// Stretched out towards its line a chain leaves it by its angles squared: no first derivative shows the way (rr and rrr have
// links of 1 m). Whether there is a pose is known in closed form: the line's height is below the chain's length or not.
TEST_F(SceneConstraints, AStretchedStartFindsThePosesThatThereAre) {
  const auto line = [](const char* height) {
    return std::string("constraints: [{line: {frame: gripper, point: [0, ") + height + "], direction: [1, 0]}}]\n";
  };
  const std::string up = "start: {q: [90deg, 0, 0]}\n", level = "start: {q: [0, 0, 0]}\n";
  const Simulation near = ready(up + line("2.9999"));
  ASSERT_EQ(notices_.size(), 1u);
  EXPECT_THAT(notices_[0], HasSubstr("0.0001 m off 'line gripper' and was moved"));
  const double y = std::sin(near.q0[0]) + std::sin(near.q0[0] + near.q0[1]) + std::sin(near.q0[0] + near.q0[1] + near.q0[2]);
  EXPECT_NEAR(y, 2.9999, 1e-13);  // places to 64 round-offs
  for (const char* height : {"2.9999", "2.99", "1.5", "0.2", "-2.9999"})
    for (const std::string& start : {up, level})
      EXPECT_THAT(error(start + line(height)), AnyOf("", HasSubstr("if it is meant"))) << height << " " << start;
  EXPECT_THAT(error(level + line("3")), HasSubstr("at the very end of reach"));
  for (const std::string& start : {up, level})
    EXPECT_THAT(error(start + line("3.1")), HasSubstr("is out of reach: the nearest pose that was found leaves it 0.1 away"));
}

TEST_F(SceneConstraints, BadInputNamesPlaceAndRemedy) {
  const auto bad = [&](const std::string& list) { return error(kPenStart + "constraints: " + list + "\n"); };
  EXPECT_THAT(bad("[{point: {frame: griper, at: [1, 1]}}]"),
              AllOf(HasSubstr("one.yaml:3:15"), HasSubstr("no frame 'griper'"), HasSubstr("gripper")));
  EXPECT_THAT(bad("[{point: {frame: gripper, at: [1]}}]"),
              AllOf(HasSubstr("'at' has 1 numbers"), HasSubstr("two are needed")));
  EXPECT_THAT(bad("[{line: {frame: gripper, point: [0, 1]}}]"),
              HasSubstr("direction' is missing: write {line:"));
  EXPECT_THAT(bad("[{pont: {frame: gripper, at: [1, 1]}}]"), HasSubstr("unknown kind 'pont'"));
  EXPECT_THAT(bad("[{point: {frame: gripper, at: [1, 1], axis: 2}}]"), HasSubstr("unknown key"));
  EXPECT_THAT(bad("[gripper]"), HasSubstr("a constraint is one key"));
  EXPECT_THAT(bad("{point: 1}"), HasSubstr("must be a list"));
  EXPECT_THAT(bad("[{close: {a: gripper}}]"), HasSubstr("names a frame, or 'at' a place"));
  EXPECT_THAT(bad("[{close: {a: gripper, b: base, axis: true, weld: true}}]"), HasSubstr("not both"));
  EXPECT_THAT(bad("[{distance: {a: gripper, b: base, length: 0}}]"), HasSubstr("must be above zero"));
  EXPECT_THAT(bad("[{joint: {name: joint9, value: 0}}]"), HasSubstr("no coordinate 'joint9'"));
  EXPECT_THAT(bad("[{curve: {frame: gripper, x: cos(u), y: sin(s)}}]"), HasSubstr("curve, x:"));
  EXPECT_THAT(bad("[{curve: {frame: gripper, x: 1, y: 2}}]"), HasSubstr("no place, tangent or curvature"));
  EXPECT_THAT(bad("[]\nstabilize: projection"), HasSubstr("must be project, baumgarte or none"));
  EXPECT_THAT(bad("[]\nbaumgarte: {gain: 3}"), HasSubstr("means nothing with stabilize: project"));
  EXPECT_THAT(bad("[]\ncontact_force: {constraint: 1, force: [0, 1]}"), HasSubstr("the scene has none"));
  const std::string pen = "[{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]\n";
  EXPECT_THAT(bad(pen + "method: taylor"), AllOf(HasSubstr("one.yaml:4:"), HasSubstr("take dop853")));
  EXPECT_THAT(bad(pen + "torque: [lambda1, 0, 0]"), HasSubstr("algebraic loop"));
  EXPECT_THAT(bad(pen + "contact_force: [{constraint: 1, force: [0, 1]}, {constraint: 1, force: [0, 2]}]"),
              HasSubstr("presses constraint 1 twice"));
  EXPECT_EQ(bad(pen), "") << "negative control";
}

TEST_F(SceneConstraints, ForceThatAConstraintDoesNotBearIsSaidOrRefused) {
  const std::string pen = kPenStart + "constraints: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]\n";
  EXPECT_THAT(error(pen + "contact_force: {constraint: 1, force: [3, 0]}\n"),
              AllOf(HasSubstr("one.yaml:4:"), HasSubstr("'line gripper' bears nothing")));
  EXPECT_THAT(error(kPenStart + "constraints: [{joint: {name: joint2, value: -60deg}}]\n" +
                    "contact_force: {constraint: 1, force: [0, -5]}\n"),
              HasSubstr("'joint joint2' bears nothing"));
  ready(pen + "contact_force: {constraint: 1, force: [3, -5]}\n");
  EXPECT_THAT(notices_, testing::ElementsAre(HasSubstr("of the contact_force of [3, -5, 0] N, 'line gripper' bears [0, -5, 0] N")));
  ready(pen + "contact_force: {constraint: 1, force: [0, -5]}\n");
  EXPECT_THAT(notices_, testing::IsEmpty());
}

}  // namespace
}  // namespace chainreel
