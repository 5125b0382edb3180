// Springs and dampers are found where the text of a torque proves them, and nowhere else.

#include "sim/drive/linear_drive.hpp"

#include <gtest/gtest.h>

#include "sim/runs.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

std::vector<LinearDrive> drives_of(const std::string& model, const std::vector<std::string>& torque,
                                   const Parameters& parameters = {}) {
  const Chain chain = run_of(model, {}, 1).chain;
  std::vector<TorqueEntry> entries;
  for (const std::string& text : torque) entries.push_back({text, {}, {}});
  return make_torque_law(chain, entries, parameters)->linear_drives(chain);
}

struct Spring {
  const char* text;
  double stiffness, damping, rest, bias;
};

TEST(LinearDrive, IsFoundWhereverTheTextIsOneHoweverItIsWritten) {
  const Spring springs[] = {
      {"-100*y_G", 100, 0, 0, 0},
      {"-100*q2", 100, 0, 0, 0},
      {"100*(0.25 - q2)", 100, 0, 0.25, 0},
      {"-k*(y_G - 0.5) - 2*yd_G", 40, 2, 0.5, 0},
      {"-(q2*k)/2 - qd2/4 + 10", 20, 0.25, 0.5, 0},
      {"-3*q1 - 5*q2 + 3*q1", 5, 0, 0, 0},
      {"-q2^1*2^3", 8, 0, 0, 0},
      {"sqrt(16)*-q2 + 0*t + 0*x_G", 4, 0, 0, 0},
      {"-50*(q2 + qd2/10)", 50, 5, 0, 0},
      {"12 - 2*qd2", 0, 2, 0, 12},
      {"-4*yd_G", 0, 4, 0, 0},
  };
  for (const Spring& spring : springs) {
    const auto found = drives_of("pp", {"0", spring.text}, {{"k", 40}});
    ASSERT_EQ(found.size(), 1u) << spring.text;
    EXPECT_EQ(found[0].freedom, 1) << spring.text;
    EXPECT_DOUBLE_EQ(found[0].stiffness, spring.stiffness) << spring.text;
    EXPECT_DOUBLE_EQ(found[0].damping, spring.damping) << spring.text;
    EXPECT_NEAR(found[0].rest, spring.rest, 1e-15) << spring.text;
    EXPECT_DOUBLE_EQ(found[0].bias, spring.bias) << spring.text;
    EXPECT_TRUE(found[0].whole && !found[0].follows) << spring.text;
  }
}

TEST(LinearDrive, IsNotGuessed) {
  for (const char* text :
       {"0", "7", "-100*y_G^3", "-100*sin(q2)", "-100*q2*q2", "-q1", "-100*(q2 - q1)", "-100*(q2 - t)", "-100*q2 + sin(t)",
        "-100*q2*t", "100*q2", "2*qd2", "-100*q2 + qd2", "-100*abs(q2)", "-100*max(q2, 0)", "-100*q2*(q2 > 0)", "-qd2*abs(qd2)",
        "-q2/q1", "-100*q2 - qd1", "-exp(log(q2))", "-100*q2 + 0.001*q2^2", "-100*x_G", "q2*0.5/0"})
    EXPECT_TRUE(drives_of("pp", {"0", text}).empty()) << text;
}

TEST(LinearDrive, ReadsFramesOnlyWhereSlidersAloneLeadThere) {
  EXPECT_TRUE(drives_of("rr", {"0", "-100*y_G"}).empty()) << "an elbow's place is no multiple of an angle";
  ASSERT_EQ(drives_of("rr", {"-20*q1 - qd1", "-4*qd2"}).size(), 2u);
  EXPECT_FALSE(drives_of("rr", {"0", "-4*qd2"})[0].is_spring());
}

TEST(LinearDrive, OfFeedbackFollowsItsReference) {
  Simulation run = run_of("rr", {}, 1);
  Control control;
  control.pd = Feedback{{30, 0}, {3, 2}, {{"t", {}}, {"0.5", {}}}, {}, {}, "", {}};
  run.torque = make_control(run.chain, control, {});
  const auto pd = linear_drives(run);
  ASSERT_EQ(pd.size(), 2u);
  EXPECT_TRUE(pd[0].follows && pd[0].whole && pd[0].is_spring() && !pd[1].is_spring());
  std::vector<double> q{9, 9};
  EXPECT_TRUE(run.torque->reference_at(0.25, q));
  EXPECT_EQ(q, (std::vector<double>{0.25, 0.5}));
  control.gravity_compensation = true;
  run.torque = make_control(run.chain, control, {});
  ASSERT_EQ(linear_drives(run).size(), 2u);
  EXPECT_FALSE(linear_drives(run)[0].whole) << "gravity is held by the same motor";
  // Inverse dynamics with feedback follows, too, but is no spring.
  control.pd.reset();
  control.computed_torque = Feedback{{30}, {3}, {{"t", {}}, {"0.5", {}}}, {}, {}, "", {}};
  run.torque = make_control(run.chain, control, {});
  EXPECT_TRUE(linear_drives(run).empty());
  EXPECT_TRUE(run.torque->reference_at(0.5, q));
}

// What is added at one joint takes nothing from another.
TEST(LinearDrive, OfSumsIsDecidedForEachFreedom) {
  Simulation run = run_of("rr", {}, 1);
  Control control;
  const auto with = [&](std::vector<double> kp, std::vector<double> kd, const char* plus1, const char* plus2) {
    control.pd = Feedback{std::move(kp), std::move(kd), {{"0.2", {}}, {"0.5", {}}}, {}, {}, "", {}};
    control.plus = {{plus1, {}}, {plus2, {}}};
    run.torque = make_control(run.chain, control, {});
    return linear_drives(run);
  };
  const auto apart = with({50, 0}, {5, 0}, "0", "-30*(q2-1)");
  ASSERT_EQ(apart.size(), 2u);
  EXPECT_TRUE(apart[0].follows && apart[0].whole && apart[0].stiffness == 50);
  EXPECT_TRUE(!apart[1].follows && apart[1].whole && apart[1].rest == 1);
  EXPECT_TRUE(run.torque->follows(0) && !run.torque->follows(1));
  // Two springs at joint 1 have no rest that is one of theirs, but both joints follow.
  const auto two = with({50, 20}, {5, 1}, "-30*(q1-1)", "0");
  ASSERT_EQ(two.size(), 1u);
  EXPECT_TRUE(two[0].freedom == 1 && two[0].whole);
  EXPECT_TRUE(run.torque->follows(0) && run.torque->follows(1));
  // A damper beside it leaves a spring as a part.
  const auto damped = with({50, 20}, {5, 1}, "-2*qd1", "sin(t)");
  ASSERT_EQ(damped.size(), 2u);
  EXPECT_TRUE(damped[0].stiffness == 50 && damped[0].damping == 5 && !damped[0].whole);
  EXPECT_FALSE(damped[1].whole) << "nothing tells what is added there";
  EXPECT_TRUE(with({50, 50}, {0, 0}, "-q1", "-q2").empty()) << "negative control";
  with({-50, 0}, {5, 1}, "0", "0");
  EXPECT_TRUE(!run.torque->follows(0) && run.torque->follows(1)) << "what pushes away is not followed";
}

TEST(LinearDrive, IsNoneWhereItsTorqueMayBeCut) {
  Simulation run = run_of("rr", {"-20*q1", "-4*q2"}, 1);
  run.chain.bodies[1].joint.limit.effort = 5;
  EXPECT_EQ(linear_drives(run).size(), 2u);
  run.limit = LimitPolicy::clamp;
  ASSERT_EQ(linear_drives(run).size(), 1u);
  EXPECT_EQ(linear_drives(run)[0].freedom, 1);
}

}  // namespace
}  // namespace chainreel
