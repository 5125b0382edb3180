#include "scene/run/prepare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scene/text/read_scene.hpp"

namespace chainreel {
namespace {

TEST(Prepare, WritesTheDefaultsOfTheModelBackIntoTheScene) {
  Scene scene;
  scene.model = "models/rr.urdf";
  const Simulation simulation = prepare(scene);
  EXPECT_EQ(*scene.gravity, Eigen::Vector3d(0, -9.81, 0));
  EXPECT_EQ(scene.end_effector, "gripper");
  EXPECT_EQ(scene.start.q, std::vector<double>(2));
  EXPECT_EQ(scene.torque.size(), 2u);
  EXPECT_TRUE(simulation.torque->is_constant());
  EXPECT_EQ(simulation.method, nullptr) << "`auto` is still to choose";
}

TEST(Prepare, GivesExpressionsTheGripperAndTheParameters) {
  Scene scene;
  scene.model = "models/pp.urdf";
  scene.start.q = {0.5, 2};
  scene.start.qd = {3, 4};
  scene.parameters = {{"k", 100}};
  scene.torque = {{"x_G + 10 * xd_G", {}, {}}, {"-k * y_G + yd_G + t", {}, {}}};
  const Simulation simulation = prepare(scene);
  EXPECT_FALSE(simulation.torque->is_constant());
  Workspace ws(simulation.chain);
  std::vector<double> tau(2), q{0, 1.5}, qd{3, 4};
  simulation.torque->evaluate(simulation.chain, ws, 0.25, q, qd, tau);
  // PP: the gripper moves with q one to one; its offset at q = 0 is what the model says.
  std::vector<double> tau_zero(2), zero(2);
  simulation.torque->evaluate(simulation.chain, ws, 0, zero, zero, tau_zero);
  EXPECT_DOUBLE_EQ(tau[0] - tau_zero[0], 30);
  EXPECT_DOUBLE_EQ(tau[1] - tau_zero[1], -150 + 4 + 0.25);
}

TEST(Prepare, NamesEveryFreedomWhereTheTorqueHasTheWrongLength) {
  Scene scene;
  scene.model = "models/rrr.urdf";
  scene.torque = {{"1", {}, {}}};
  try {
    prepare(scene);
    FAIL() << "one torque for three joints was accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'torque' has 1 entries"));
    EXPECT_THAT(error.what(), testing::HasSubstr("3 freedoms"));
  }
}

// A torso with two arms: no end effector until one is named.
std::string two_ends() {
  const std::string path = testing::TempDir() + "two_ends.urdf";
  std::ofstream file(path);
  file << "<robot name='two_ends'><link name='torso'/>";
  for (const std::string arm : {"left", "right"})
    file << "<link name='" << arm << "'><inertial><origin xyz='0.5 0 0'/><mass value='1'/>"
         << "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"
         << "<joint name='swing_" << arm << "' type='continuous'><parent link='torso'/><child link='" << arm
         << "'/><axis xyz='0 0 1'/></joint>";
  file << "</robot>";
  return path;
}

std::string refusal_of(Scene scene) {
  try {
    prepare(scene);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Prepare, AsksForAnEndEffectorOnlyWhereSomethingOfItIsWanted) {
  Scene scene;
  scene.model = two_ends();
  ASSERT_THAT(scene.draw, testing::Contains("trail"));
  Scene plain = scene;
  EXPECT_EQ(prepare(plain).chain.end_effector, -1);
  EXPECT_EQ(plain.end_effector, "");
  EXPECT_THAT(plain.draw, testing::AllOf(testing::Contains("chain"), testing::Not(testing::Contains("trail"))));

  // Who names one of them, or reads x_G, is told what to type.
  Scene drawn = scene;
  drawn.draw = drawn.named_layers = {"chain", "ellipse"};
  drawn.places["draw"] = {"scene.yaml", 3, 1};
  EXPECT_THAT(refusal_of(drawn), testing::AllOf(testing::HasSubstr("scene.yaml:3"), testing::HasSubstr("'ellipse'"),
                                                testing::HasSubstr("`--set end_effector=NAME`"),
                                                testing::HasSubstr("left, right")));
  // The trail is not named by who edits the default layers.
  Scene edited = read_scene(std::string(CHAINREEL_SOURCE_FOLDER) + "/assets/scenes/rr_free.yaml", {"draw=[+ghosts]"});
  edited.model = scene.model;
  edited.end_effector = "";
  prepare(edited);
  EXPECT_THAT(edited.draw, testing::AllOf(testing::Contains("ghosts"), testing::Not(testing::Contains("trail"))));
  Scene pushed = scene;
  pushed.torque = {{"x_G", {}, {}}, {"0", {}, {}}};
  EXPECT_THAT(refusal_of(pushed), testing::HasSubstr("x_G is of the end effector"));
  Scene watched = scene;
  watched.events.push_back({});
  watched.events.back().when = "y_G < 0";
  EXPECT_THAT(refusal_of(watched), testing::HasSubstr("y_G is of the end effector"));

  for (Scene* named : {&drawn, &pushed, &watched}) {
    named->end_effector = "left";
    EXPECT_EQ(refusal_of(*named), "");
  }
}

TEST(Prepare, RefusesParametersThatExpressionsKnowOtherwise) {
  for (const char* name : {"q1", "t", "x_G", "sin", "pi", "2k", "a b"}) {
    Scene scene;
    scene.model = "models/rr.urdf";
    scene.parameters = {{name, 1}};
    EXPECT_THROW(prepare(scene), Error) << name;
  }
  Scene scene;  // negative control
  scene.model = "models/rr.urdf";
  scene.parameters = {{"k_2", 1}};
  EXPECT_NO_THROW(prepare(scene));
}

}  // namespace
}  // namespace chainreel
