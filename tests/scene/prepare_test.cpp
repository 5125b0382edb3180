#include "scene/prepare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/read_scene.hpp"

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
