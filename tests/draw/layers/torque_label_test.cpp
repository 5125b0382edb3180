#include "draw/layers/torque_label.hpp"

#include <gmock/gmock.h>

#include "draw/chains.hpp"

namespace chainreel {
namespace {

std::string label(const std::string& model, const std::vector<std::string>& entries) {
  std::vector<TorqueEntry> torque;
  for (const std::string& text : entries) torque.emplace_back().text = text;
  return torque_notations(test::model(model), torque).front();
}

TEST(TorqueLabel, SaysWhatActsAsTheLectureWritesIt) {
  EXPECT_EQ(label("rrr", {"10", "10", "10"}), "tau = (10, 10, 10) N m");
  EXPECT_EQ(label("rr", {"0", "5"}), "tau = (0, 5) N m");
  EXPECT_EQ(label("rr", {"0", "0.0"}), "tau = 0");
}

// What presses on constraints drives the joints, too, and what is cut does not.
TEST(TorqueLabel, TellsContactForcesAndCuts) {
  Scene scene;
  scene.torque.resize(2);
  for (TorqueEntry& entry : scene.torque) entry.text = "0";
  Chain chain = test::model("rr");
  scene.contact_force.push_back({1, {0, -5}, {}});
  EXPECT_EQ(torque_notations(chain, scene), (std::vector<std::string>{"tau = \"contact force 5 N\""}));
  scene.torque[0].text = "10";
  EXPECT_EQ(torque_notations(chain, scene).front(), "tau = (10, 0) N m + \"contact force 5 N\"");
  scene.contact_force.push_back({2, {3, 4, 0}, {}});
  EXPECT_EQ(torque_notations(chain, scene).front(), "tau = (10, 0) N m + \"contact forces 5, 5 N\"");
  scene.contact_force.clear();
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) chain.bodies[b].joint.limit.effort = 2;
  EXPECT_EQ(torque_notations(chain, scene).front(), "tau = (10, 0) N m");
  scene.limit = LimitPolicy::clamp;
  EXPECT_EQ(torque_notations(chain, scene).front(), "tau = (10, 0) N m\", cut at \"2 N m");
  chain.bodies[1].joint.limit.effort = 3;
  EXPECT_EQ(torque_notations(chain, scene).front(), "tau = (10, 0) N m\", cut at the joints' efforts\"");
  for (const std::string& form : torque_notations(chain, scene)) EXPECT_NO_THROW(lay_out_math(fonts(), form, {}));
}

// Where joints turn and slide a tuple has no unit, and the one torque that acts does.
TEST(TorqueLabel, NamesTheOneThatActsWithItsUnit) {
  EXPECT_EQ(label("slider_crank", {"8 - qd1", "0", "0"}), "tau_1 = (8 - qd1) N m");
  EXPECT_EQ(label("slider_crank", {"0", "0", "5"}), "tau_3 = 5 N");
  EXPECT_EQ(label("slider_crank", {"8 - qd1", "0", "5"}), "tau = (8 - qd1, 0, 5)");
  Chain slider_first = test::model("rr");
  slider_first.bodies[1].joint.kind = JointKind::prismatic;
  std::vector<TorqueEntry> torque(2);
  torque[0].text = "10", torque[1].text = "0";
  EXPECT_EQ(torque_notations(slider_first, torque).front(), "tau_1 = 10 N");
  EXPECT_EQ(torque_notations(test::model("rr"), torque), (std::vector<std::string>{"tau = (10, 0) N m", "tau_1 = 10 N m", "tau = tau(t, q, qd)"}));
}

// Of several zeros none tells anything; one beside a torque says that the other joint is free.
TEST(TorqueLabel, LeavesManyZerosOut) {
  EXPECT_EQ(label("rrr", {"12 - 2 * qd1", "0", "0"}), "tau_1 = (12 - 2 * qd1) N m");
  EXPECT_EQ(label("rrr", {"12 - 2 * qd1", "0", "1"}), "tau = (12 - 2 * qd1, 0, 1) N m");
  EXPECT_EQ(label("rr", {"10", "0"}), "tau = (10, 0) N m");
}

TEST(TorqueLabel, ShowsExpressionsAsWritten) {
  EXPECT_EQ(label("pp", {"0", "-100 * y_G"}), "tau = (0, -100 * y_G) N");
}

TEST(TorqueLabel, SaysIfWhereANumberActsAtTimes) {
  EXPECT_EQ(label("rr", {"5 * (t < 0.5)", "0"}), "tau = (5\" if \"t < 0.5\" else \"0, 0) N m");
  EXPECT_EQ(label("rr", {"(t >= 1) * F", "0"}), "tau = (F\" if \"t >= 1\" else \"0, 0) N m");
  EXPECT_NO_THROW(lay_out_math(fonts(), label("rr", {"5 * (t < 0.5)", "-2 * (q1 <= 3)"}), {}));
  EXPECT_EQ(label("rr", {"5 * (t >= 0) * (t < 0.5)", "0"}), "tau = (5\" if \"0 <= t < 0.5\" else \"0, 0) N m");
  EXPECT_EQ(label("rr", {"(t < 0.5) * F * (0 < t)", "0"}), "tau = (F\" if \"0 < t < 0.5\" else \"0, 0) N m");
  EXPECT_EQ(label("rr", {"5 * (t > 1) * (q1 < 2)", "0"}), "tau = (5\" if \"t > 1\" and \"q1 < 2\" else \"0, 0) N m");
  EXPECT_EQ(label("rr", {"5 * (t > 1) * (t > 2)", "0"}), "tau = (5\" if \"t > 1\" and \"t > 2\" else \"0, 0) N m");
  EXPECT_NO_THROW(lay_out_math(fonts(), label("rr", {"5 * (t >= 0) * (t < 0.5)", "5 * (t > 1) * (q1 < 2)"}), {}));
  // Others stand as they are written.
  for (const char* text : {"5 * (t < 0.5) - qd1", "5 * (t - 0.5)", "5 * (t < sin(q1))", "5 * (t < 1) * (t > 0) * (q1 > 0)",
                           "(t < 1) * (t > 0)", "5 * 2 * (t < 1)", "5 * (t < 1) / 2", "5 * (t < 1) + (t > 2)"})
    EXPECT_EQ(label("rr", {text, "0"}), "tau = (" + std::string(text) + ", 0) N m");
}

TEST(TorqueLabel, RaisesExponentsAsAWhole) {
  EXPECT_EQ(label("pp", {"t ^ 2", "2 ^ (t - (1 + q1))"}), "tau = (t^{2}, 2^{t - (1 + q1)}) N");
  EXPECT_EQ(label("pp", {"2 ^ -1 * t", "2^cos(t) + 1"}), "tau = (2^{-1} * t, 2^{cos(t)} + 1) N");
  EXPECT_NO_THROW(lay_out_math(fonts(), label("pp", {"min(t, 2) ^ 2", "3 ^ (-t) * x_G"}), {}));
}

TEST(TorqueLabel, WithoutEntriesSaysThatNothingActs) {
  EXPECT_EQ(label("rrr", {}), "tau = 0");
}

TEST(TorqueLabel, OfOneJointNeedsNoBracketsAroundANumber) {
  EXPECT_EQ(label("p", {"9.81"}), "tau = 9.81 N");
  EXPECT_EQ(label("p", {"-k * q1"}), "tau = (-k * q1) N");
  // A single product with a bracket at its end needs none around it.
  EXPECT_EQ(label("p", {"-80 * (q1 - 0.1)"}), "tau = -80 * (q1 - 0.1) N");
  EXPECT_EQ(label("p", {"5 * cos(2 * t)"}), "tau = 5 * cos(2 * t) N");
  for (const std::string kept : {"8 - (q1)", "2 / (1 + t)", "(t) - (q1)"}) EXPECT_EQ(label("p", {kept}), "tau = (" + kept + ") N");
}

TEST(TorqueLabel, HasNoUnitWhereForcesAndTorquesMix) {
  Chain chain = test::model("rr");
  chain.bodies[2].joint.kind = JointKind::prismatic;
  std::vector<TorqueEntry> torque(2);
  torque[0].text = "1", torque[1].text = "2";
  EXPECT_EQ(torque_notations(chain, torque).front(), "tau = (1, 2)");
}

TEST(TorqueLabel, NamesWhatAControlDoes) {
  Control control;
  control.gravity_compensation = true;
  control.pd.emplace();
  EXPECT_EQ(control_notation(control), "tau_g(q) + PD");
  EXPECT_NO_THROW(lay_out_math(fonts(), "tau = " + control_notation(control), {}));
  Control from_file;
  from_file.csv = "tau.csv";
  EXPECT_EQ(control_notation(from_file), "tau(t)");
  Control computed;
  computed.computed_torque.emplace();
  EXPECT_EQ(control_notation(computed), "computed torque");
  EXPECT_EQ(control_notation({}), "0");
  // For the whole chain, and for one joint beside a number.
  EXPECT_EQ(torque_notations(test::model("rr"), {}, control).front(), "tau = tau_g(q) + PD");
  std::vector<TorqueEntry> torque(2);
  torque[0].control = computed;
  EXPECT_EQ(torque_notations(test::model("rr"), torque).front(), "tau = (computed torque, 0) N m");
}

TEST(TorqueLabel, SaysWhatPullsTheEndEffector) {
  Control control;
  control.task.emplace();
  control.task->kp = {400};
  control.task->kd = {40};
  EXPECT_THAT(torque_notations(test::model("rr"), {}, control),
              testing::ElementsAre("tau = J^T F, F = 400 N/m\" \"(x_{ref} - x) + 40 N s/m\" \"(xd_{ref} - xd)", "tau = J^T F", "tau = tau(t, q, qd)"));
  control.task->kp = {50, 0};
  control.task->kd = {0};
  const std::string along_x = torque_notations(test::model("rr"), {}, control).front();
  EXPECT_EQ(along_x, "tau = J^T F, F = diag(50, 0) N/m\" \"(x_{ref} - x)");
  EXPECT_NO_THROW(lay_out_math(fonts(), along_x, {}));
}

TEST(TorqueLabel, SaysWhatResistsInTheJoints) {
  Chain chain = test::model("rr");
  EXPECT_EQ(resistance_notation(chain), "");
  chain.bodies[1].joint.damping = chain.bodies[2].joint.damping = 0.1;
  EXPECT_EQ(resistance_notation(chain), "\", damping \"0.1 N m s");
  chain.bodies[2].joint.damping = 0;
  chain.bodies[2].joint.friction = 0.25;
  EXPECT_EQ(resistance_notation(chain), "\", damping \"(0.1, 0) N m s\", friction \"(0, 0.25) N m");
  EXPECT_NO_THROW(lay_out_math(fonts(), "tau = 0" + resistance_notation(chain), {}));
}

TEST(TorqueLabel, OffersEverShorterForms) {
  Chain chain = test::model("rrr");
  std::vector<TorqueEntry> torque;
  for (int i = 1; i <= 12; ++i) torque.emplace_back().text = std::to_string(i);
  const std::vector<std::string> forms = torque_notations(chain, torque);
  EXPECT_THAT(forms.front(), testing::HasSubstr("1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12)"));
  EXPECT_THAT(forms, testing::Contains("tau = (1, 2, \u2026, 12) N m"));
  EXPECT_EQ(forms.back(), "tau = tau(t, q, qd)");
  for (const std::string& form : forms) EXPECT_NO_THROW(lay_out_math(fonts(), form, {})) << form;
}

}  // namespace
}  // namespace chainreel
