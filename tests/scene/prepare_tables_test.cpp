// What tables say of a scene's start and of its duration.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/simulate.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SceneTables : public ::testing::Test {
 protected:
  // Of RRR, 2 s long, driven by tables beside the scene.
  Scene ready(const std::string& text) {
    Scene scene = read_scene(folder_.write(
        "one.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rrr.urdf\nduration: 2\nmethod: dop853\n" + text));
    simulation_ = prepare(scene, false);
    return scene;
  }
  std::string error(const std::string& text) {
    try {
      ready(text);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }
  void motion(const std::string& rows) { folder_.write("q.csv", "t,q1,q2,q3\n" + rows); }
  void torques(const std::string& rows) { folder_.write("tau.csv", "t,tau1,tau2,tau3\n" + rows); }

  TemporaryFolder folder_;
  Simulation simulation_;
};

TEST_F(SceneTables, StartIsThatOfTheMotionWhoseTorquesAct) {
  motion("0,0.5,-1,0.25\n1,0.75,-0.5,0.25\n2,1,0,0.25\n");
  const Scene scene = ready("torque: {inverse_of: q.csv}\n");
  EXPECT_THAT(scene.start.q, ElementsAre(0.5, -1, 0.25));
  EXPECT_THAT(scene.start.qd, ElementsAre(testing::DoubleNear(0.25, 1e-14), testing::DoubleNear(0.5, 1e-14),
                                          testing::DoubleNear(0, 1e-14)));
  EXPECT_THAT(scene.notices, ElementsAre(HasSubstr("starts as the motion")));
  const double times[] = {2};
  const Trajectory run = simulate(simulation_, times);
  ASSERT_EQ(run.status, RunStatus::finished);
  const double end[] = {1, 0, 0.25};
  // 1e-9 a step, magnified by an arm that swings upright for two seconds.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(run.q_at(0)[i], end[i], 1e-5);
}

TEST_F(SceneTables, StartThatIsNamedStaysAndIsToldApart) {
  motion("0,0.5,-1,0.25\n1,0.75,-0.5,0.25\n2,1,0,0.25\n");
  const Scene scene = ready("torque: {inverse_of: q.csv}\nstart: {q: [0.5, 0, 0.25], qd: [0.25, 0.5, 0]}\n");
  EXPECT_THAT(scene.start.q, ElementsAre(0.5, 0, 0.25));
  EXPECT_THAT(scene.notices, ElementsAre(HasSubstr("the start differs from that of the motion")));
  EXPECT_THAT(scene.notices[0], HasSubstr("by 1 in a coordinate"));
  EXPECT_THAT(ready("torque: {inverse_of: q.csv}\nstart: {q: [0.5, -1, 0.25], qd: [0.25, 0.5, 0]}\n").notices, IsEmpty());
}

TEST_F(SceneTables, StartOfOneJointIsThatOfItsOwnMotion) {
  motion("0,0.5,-1,0.25\n2,1,0,0.25\n");
  const Scene scene = ready("torque: [0, {inverse_of: q.csv}, 0]\n");
  EXPECT_THAT(scene.start.q, ElementsAre(0, -1, 0));
}

TEST_F(SceneTables, RowsThatDoNotSpanTheRunAreSaidOrRefused) {
  torques("0.5,1,0,0\n1.5,2,0,0\n");
  const std::vector<std::string> notices = ready("torque: {csv: tau.csv}\n").notices;
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_THAT(notices[0], HasSubstr("speaks of 0.5 to 1.5 s, but the run of 0 to 2 s; before and behind it the torque of its "
                                    "nearest row is held"));
  for (const char* meant : {"hold", "zero"})
    EXPECT_THAT(ready(std::string("torque: {csv: tau.csv, outside: ") + meant + "}\n").notices, IsEmpty()) << meant;
  EXPECT_THAT(error("torque: {csv: tau.csv, outside: refuse}\n"), HasSubstr("one.yaml:4:"));
  EXPECT_THAT(error("torque: [{csv: tau.csv, outside: refuse}, 0, 0]\n"), HasSubstr("0.5 to 1.5 s"));
  torques("0,1,0,0\n2,2,0,0\n");
  EXPECT_EQ(error("torque: {csv: tau.csv, outside: refuse}\n"), "");
  EXPECT_THAT(ready("torque: {csv: tau.csv}\n").notices, IsEmpty());
}

// Stamps that count from elsewhere: none of the rows would act.
TEST_F(SceneTables, LogsOfTorquesWithAnotherClockBeginAtTheStart) {
  torques("100,1,0,0\n101,2,0,0\n102,3,0,0\n");
  const Scene scene = ready("torque: {csv: tau.csv}\n");
  EXPECT_THAT(scene.notices, ElementsAre(HasSubstr("t = 0 is the first row of ")));
  ASSERT_TRUE(scene.control);
  EXPECT_TRUE(scene.control->since_first_row);
  const Scene held = ready("torque: {csv: tau.csv, outside: hold}\n");
  EXPECT_FALSE(held.control->since_first_row) << "its times as they stand";
  torques("1.9,1,0,0\n2.9,2,0,0\n");
  EXPECT_FALSE(ready("torque: {csv: tau.csv}\n").control->since_first_row) << "a row of it acts";
}

TEST_F(SceneTables, ReferencesOfFeedbackAreSaidToo) {
  motion("0,0,0,0\n1,1,0,0\n");
  EXPECT_THAT(ready("torque: {pd: {kp: 1, trajectory: q.csv}}\n").notices, ElementsAre(HasSubstr("behind it the pose")));
  EXPECT_THAT(error("torque: {computed_torque: {kp: 1, trajectory: q.csv, outside: refuse}}\n"), HasSubstr("0 to 1 s"));
}

// A column of another quantity would run as a torque or an angle of its number: three joints that turn.
TEST_F(SceneTables, UnitsOfAnotherKindAreRefused) {
  const auto log = [&](const std::string& units) { folder_.write("tau.csv", "t,tau1" + units + ",tau2,tau3\n0,1,0,0\n10,1,0,0\n"); };
  const auto track = [&](const std::string& header) { folder_.write("q.csv", "t," + header + "\n0,0,0,0\n10,1,0,0\n"); };
  for (const char* unit : {" [deg]", " [rad]", " [N]", " [mm]"}) {
    log(unit);
    EXPECT_THAT(error("torque: {csv: tau.csv}\n"), testing::AllOf(HasSubstr("is to be tau of 'joint1'"), HasSubstr("which turns"))) << unit;
  }
  for (const char* unit : {"", " [N m]"}) {
    log(unit);
    EXPECT_EQ(error("torque: {csv: tau.csv}\n"), "") << unit;
  }
  const std::string pd = "torque: {pd: {trajectory: q.csv, kp: 1, kd: 1}}\n", inverse = "torque: {inverse_of: q.csv}\n";
  for (const char* header : {"q1 [mm],q2,q3", "q1,q2 [N],q3", "q1 [rad/s],q2,q3"}) {
    track(header);
    for (const std::string& text : {pd, inverse}) EXPECT_THAT(error(text), HasSubstr("which turns")) << header;
  }
  track("q1 [deg],q2 [rad],q3");
  for (const std::string& text : {pd, inverse}) EXPECT_EQ(error(text), "");
}

}  // namespace
}  // namespace chainreel
