#include "model/regularity.hpp"

#include <gmock/gmock.h>

#include "model_file.hpp"

namespace chainreel {
namespace {

const std::string kNoInertia = "ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'";

std::string point_mass(const std::string& name, const std::string& parent, const std::string& com,
                       const std::string& axis = "0 0 1", const std::string& type = "continuous",
                       double mass = 1) {
  return link_text(name, inertial_text(mass, com, kNoInertia)) +
         joint_text("to_" + name, type, parent, name, axis, "<origin xyz='1 0 0'/>");
}

std::string refusal(const std::string& joints) {
  const TemporaryFolder folder;
  return refusal_of(folder.write("model.urdf", robot_text(link_text("base") + joints)));
}

std::string names_joint(const std::string& joint) {
  return "joint '" + joint + "' moves no mass at any pose";
}

TEST(Regularity, PointMassesOffTheirAxesAreRegularThoughStretchedOutTheyAreNot) {
  EXPECT_EQ(refusal(point_mass("a", "base", "1 0 0") + point_mass("b", "a", "1 0 0")), "");
  EXPECT_EQ(refusal(point_mass("a", "base", "1e-4 0 0")), "");
}

TEST(Regularity, APointMassOnItsOwnAxisIsRefused) {
  EXPECT_THAT(refusal(point_mass("a", "base", "0 0 3")), testing::HasSubstr(names_joint("to_a")));
  // Not only at the end: the mass behind it lies on the axis as well.
  EXPECT_THAT(refusal(point_mass("a", "base", "1 0 0") + point_mass("b", "a", "0 0 1")),
              testing::HasSubstr(names_joint("to_b")));
  // Round-off in its place is no lever.
  EXPECT_THAT(refusal(point_mass("a", "base", "1e-17 0 3")), testing::HasSubstr(names_joint("to_a")));
}

TEST(Regularity, TwoJointsThatMoveOneMassTheSameWayAreRefused) {
  EXPECT_THAT(refusal(point_mass("a", "base", "0 0 0", "1 0 0", "prismatic", 0) +
                      point_mass("b", "a", "0 0 0", "1 0 0", "prismatic")),
              testing::HasSubstr(names_joint("to_a")));
  EXPECT_EQ(refusal(point_mass("a", "base", "0 0 0", "1 0 0", "prismatic", 0) +
                    point_mass("b", "a", "0 0 0", "0 1 0", "prismatic")),
            "");
}

TEST(Regularity, AMassThatTurnsOnThePointItSitsOnIsRefusedWhenItFloats) {
  EXPECT_THAT(refusal(point_mass("a", "base", "0 0 0", "0 0 1", "floating")),
              testing::HasSubstr(names_joint("to_a")));
  EXPECT_EQ(refusal(moving("a", "floating", "base")), "");
}

// What is missing is named: of a floating cart-pole the rail lacks a mass along the way of the cart, not an inertia.
TEST(Regularity, TheMotionThatMovesNothingIsNamedWithWhatItLacks) {
  const auto floating = [](const std::string& text) {
    ModelOptions options;
    options.floating_base = true;
    const TemporaryFolder folder;
    return refusal_of(folder.write("model.urdf", robot_text(text)), options);
  };
  const std::string unit = "ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'";
  const std::string cart = moving("cart", "prismatic", "rail", "1 0 0") + moving("pole", "continuous", "cart", "0 1 0");
  EXPECT_THAT(floating(link_text("rail", inertial_text(0, "0 0 0", unit)) + cart),
              testing::AllOf(testing::HasSubstr("joint 'base' moves no mass at any pose when it moves along x (the "
                                                "joints behind it give way)"),
                             testing::HasSubstr("give link 'rail' a mass, or")));
  EXPECT_EQ(floating(link_text("rail", inertial_text(1, "0 0 0", unit)) + cart), "");
  EXPECT_THAT(refusal(point_mass("a", "base", "0 0 0", "0 0 1", "floating")),
              testing::HasSubstr("when it turns about x, y and z, so no torque has an acceleration: give link 'a' an "
                                 "inertia about x, y and z"));
  EXPECT_THAT(refusal(point_mass("a", "base", "0 0 0.5", "0 0 1", "floating")),
              testing::HasSubstr("when it turns about z, so"));
  // About an axis that is none of the frame's.
  const std::string rod = "ixx='0.5' ixy='-0.5' ixz='0' iyy='0.5' iyz='0' izz='1'";
  EXPECT_THAT(floating(link_text("rod", inertial_text(1, "0 0 0", rod))),
              testing::HasSubstr("when it turns about the axis (0.707, 0.707, 0) through (0, 0, 0), so"));
  EXPECT_THAT(refusal(point_mass("a", "base", "0 0 0", "1 0 0", "prismatic", 0) +
                      point_mass("b", "a", "0 0 0", "1 0 0", "prismatic")),
              testing::HasSubstr("'to_a' moves no mass at any pose when it slides (the joints behind it give way), so no "
                                 "torque has an acceleration: give link 'a' a mass"));
}

TEST(Regularity, AFollowerNeedsNoInertiaOfItsOwn) {
  const std::string leader = moving("a", "continuous", "base");
  const std::string follower = link_text("b", inertial_text(1, "0 0 1", kNoInertia));
  const auto joint = [](const std::string& mimic) {
    return joint_text("to_b", "continuous", "base", "b", "0 0 1", mimic);
  };
  EXPECT_EQ(refusal(leader + follower + joint("<mimic joint='to_a'/>")), "");
  EXPECT_THAT(refusal(leader + follower + joint("")), testing::HasSubstr(names_joint("to_b")));
  // Also where the follower comes first in the tree.
  EXPECT_EQ(refusal(follower + joint("<mimic joint='to_a'/>") + leader), "");
}

TEST(Regularity, LongChainsAndSmallMassesAreNotTakenForSingular) {
  std::string many, small;
  for (int i = 0; i < 3000; ++i) {
    const std::string parent = i == 0 ? "base" : "l" + std::to_string(i - 1);
    many += point_mass("l" + std::to_string(i), parent, "1 0 0");
  }
  EXPECT_EQ(refusal(many), "");
  // A watch hand: a milligram, a millimetre, on an arm of a ton.
  EXPECT_EQ(refusal(point_mass("a", "base", "1 0 0", "0 0 1", "continuous", 1000) +
                    point_mass("b", "a", "0.001 0 0", "0 0 1", "continuous", 1e-6)),
            "");
}

}  // namespace
}  // namespace chainreel
