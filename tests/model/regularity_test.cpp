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
