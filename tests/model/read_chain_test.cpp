#include "model/read_chain.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "model_file.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> body_names(const Chain& chain) {
  std::vector<std::string> names;
  for (const Body& body : chain.bodies) names.push_back(body.name);
  return names;
}

const Joint& joint_of(const Chain& chain, const std::string& name) {
  for (const Body& body : chain.bodies)
    if (body.joint.name == name) return body.joint;
  ADD_FAILURE() << "no joint " << name;
  return chain.bodies[0].joint;
}

TEST(ReadChain, RrIsTwoPointMassesAtTheEndsOfTwoLinks) {
  const Chain chain = read_chain(CHAINREEL_SOURCE "/models/rr.urdf");
  ASSERT_EQ(chain.bodies.size(), 3u);
  EXPECT_EQ(chain.nq, 2);
  EXPECT_EQ(chain.nv, 2);
  EXPECT_THAT(chain.coordinate_names, ElementsAre("joint1", "joint2"));
  EXPECT_TRUE(chain.serial);
  EXPECT_EQ(chain.gravity, Eigen::Vector3d(0, -9.81, 0));
  EXPECT_EQ(chain.frames[std::size_t(chain.end_effector)].name, "gripper");
  ASSERT_TRUE(chain.planar);
  EXPECT_EQ(chain.why_algebra, "planar: all 2 revolute axes are parallel to z");
  for (std::size_t i = 1; i <= 2; ++i) {
    EXPECT_EQ(chain.bodies[i].inertia.mass, 1);
    EXPECT_EQ(chain.bodies[i].inertia.com, Eigen::Vector3d(1, 0, 0));
    EXPECT_TRUE(chain.bodies[i].inertia.about_com.isZero(0));
    EXPECT_EQ(chain.planar->bodies[i].com, Eigen::Vector2d(1, 0));
    EXPECT_EQ(chain.planar->bodies[i].inertia, 0);
    EXPECT_EQ(chain.planar->bodies[i].sign, 1);
    EXPECT_EQ(chain.planar->bodies[i].p_PJ, Eigen::Vector2d(double(i) - 1, 0));
  }
}

// At the end of a rod: its closed form. At the end of a point mass: the sum of both, still a point.
TEST(ReadChain, APayloadIsAPointOfTheBodyThatCarriesIt) {
  ModelOptions options;
  options.payload = {.mass = 3, .at = {0.25, 0, 0}};
  const Chain rods = read_chain(CHAINREEL_SOURCE "/models/rrr.urdf", options);
  const double c = (1 * 0.5 + 3 * 1.25) / 4, inertia = 1.0 / 12 + (c - 0.5) * (c - 0.5) + 3 * (1.25 - c) * (1.25 - c);
  EXPECT_EQ(rods.bodies[3].inertia.mass, 4);
  EXPECT_NEAR(rods.planar->bodies[3].com.x(), c, 1e-15);
  EXPECT_NEAR(rods.planar->bodies[3].inertia, inertia, 1e-15) << "sums of numbers of size 1";
  EXPECT_EQ(rods.bodies[2].inertia.mass, 1);
  ASSERT_EQ(rods.point_masses.size(), 1u) << "rods are none";
  EXPECT_EQ(rods.point_masses[0].body, 3);

  options.payload = {.mass = 0.5, .link = "link1", .at = {1, 0, 0}};
  const Chain points = read_chain(CHAINREEL_SOURCE "/models/rr.urdf", options);
  EXPECT_EQ(points.bodies[1].inertia.mass, 1.5);
  EXPECT_TRUE(points.bodies[1].inertia.about_com.isZero(1e-16));
  EXPECT_EQ(points.point_masses.size(), 3u);
  EXPECT_TRUE(read_chain(CHAINREEL_SOURCE "/models/pp.urdf").point_masses.empty()) << "sliders have carriages";

  const auto trouble = [](const char* model, const Payload& payload) {
    ModelOptions bad;
    bad.payload = payload;
    try {
      read_chain(std::string(CHAINREEL_SOURCE "/models/") + model, bad);
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(trouble("rr.urdf", {.mass = 1, .link = "griper"}), testing::AllOf(HasSubstr("'payload.link' names no link"), HasSubstr("gripper")));
  EXPECT_THAT(trouble("rr.urdf", {.mass = 1, .link = "base"}), HasSubstr("does not move"));
  EXPECT_EQ(trouble("rr.urdf", {.mass = 0, .link = "base"}), "") << "no load";
}

TEST(ReadChain, RrrIsThreeUniformRods) {
  const Chain chain = read_chain(CHAINREEL_SOURCE "/models/rrr.urdf");
  ASSERT_EQ(chain.bodies.size(), 4u);
  for (std::size_t i = 1; i <= 3; ++i) {
    EXPECT_EQ(chain.bodies[i].inertia.mass, 1);
    EXPECT_EQ(chain.bodies[i].inertia.com, Eigen::Vector3d(0.5, 0, 0));
    EXPECT_EQ(chain.planar->bodies[i].inertia, 1.0 / 12.0);
  }
}

TEST(ReadChain, PlanarScenesHaveXToTheRightAndYUp) {
  for (const char* file : {"rr", "rrr", "pp", "p"}) {
    const Chain chain = read_chain(std::string(CHAINREEL_SOURCE "/models/") + file + ".urdf");
    ASSERT_TRUE(chain.planar) << file;
    EXPECT_EQ(chain.planar->plane.ex, Eigen::Vector3d(1, 0, 0)) << file;
    EXPECT_EQ(chain.planar->plane.ey, Eigen::Vector3d(0, 1, 0)) << file;
    EXPECT_EQ(chain.planar->plane.normal, Eigen::Vector3d(0, 0, 1)) << file;
    EXPECT_EQ(chain.gravity, Eigen::Vector3d(0, -9.81, 0)) << file;
  }
}

TEST(ReadChain, OrdersBodiesDepthFirstAndChildrenAsWritten) {
  // Names whose alphabet runs against the document, links written after the joints that use them.
  const Chain chain = chain_from(robot_text(
      link_text("base") + moving("z", "continuous", "base") + moving("y", "continuous", "z") +
      moving("a", "continuous", "base") + moving("x", "continuous", "z") + moving("b", "continuous", "x")));
  EXPECT_THAT(body_names(chain), ElementsAre("", "z", "y", "x", "b", "a"));
  EXPECT_THAT(chain.coordinate_names, ElementsAre("to_z", "to_y", "to_x", "to_b", "to_a"));
  EXPECT_FALSE(chain.serial);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) EXPECT_LT(chain.bodies[i].parent, int(i));
}

TEST(ReadChain, ReadsEveryKindOfJoint) {
  const Chain chain = read_chain(CHAINREEL_SOURCE "/tests/model/good/every_joint_kind.urdf");
  EXPECT_EQ(chain.nq, 13);
  EXPECT_EQ(chain.nv, 12);
  EXPECT_TRUE(chain.has_floating);
  EXPECT_TRUE(chain.has_dissipation);
  EXPECT_THAT(chain.coordinate_names,
              ElementsAre("turn", "spin", "slide", "fly.vx", "fly.vy", "fly.vz", "fly.wx", "fly.wy", "fly.wz",
                          "skate.x", "skate.y", "skate.angle"));
  EXPECT_THAT(position_names(chain),
              ElementsAre("turn", "spin", "slide", "fly.x", "fly.y", "fly.z", "fly.qx", "fly.qy", "fly.qz",
                          "fly.qw", "skate.x", "skate.y", "skate.angle"));
  EXPECT_THAT(zero_configuration(chain), ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0));

  const Joint& turn = joint_of(chain, "turn");
  EXPECT_EQ(turn.axis, Eigen::Vector3d(0, 1, 0));  // 0 2 0 in the file
  EXPECT_EQ(turn.limit.lower, -1);
  EXPECT_EQ(turn.limit.effort, 5);
  EXPECT_EQ(turn.damping, 0.1);
  EXPECT_EQ(turn.friction, 0.2);
  // Turned by pi/2 about z as the double nearest to it has it.
  EXPECT_LE((turn.X_PJ.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-16);
  EXPECT_EQ(joint_of(chain, "spin").axis, Eigen::Vector3d(1, 0, 0));  // the format's default
  EXPECT_TRUE(std::isinf(joint_of(chain, "spin").limit.upper));
  // <limit> without lower and upper means 0 to 0 for a prismatic joint.
  EXPECT_EQ(joint_of(chain, "slide").limit.upper, 0);
  EXPECT_EQ(joint_of(chain, "fly").kind, JointKind::floating);
}

TEST(ReadChain, AContinuousJointHasLimitsOfEffortAndVelocityAndNoneOfItsAngle) {
  const Chain chain =
      chain_from(robot_text(link_text("base") + moving("arm", "continuous", "base", "0 0 1",
                                                       "<limit lower='-1' upper='1' effort='5' velocity='6'/>")));
  const JointLimit& limit = joint_of(chain, "to_arm").limit;
  EXPECT_EQ(limit.effort, 5);
  EXPECT_EQ(limit.velocity, 6);
  EXPECT_TRUE(std::isinf(limit.lower) && std::isinf(limit.upper));
}

TEST(ReadChain, APlanarJointIsThreeJointsWithMasslessBodiesBetween) {
  const Chain chain = read_chain(CHAINREEL_SOURCE "/tests/model/good/every_joint_kind.urdf");
  const int x = int(chain.bodies.size()) - 3;
  const std::vector<Body>& bodies = chain.bodies;
  EXPECT_EQ(bodies[std::size_t(x)].joint.kind, JointKind::prismatic);
  EXPECT_EQ(bodies[std::size_t(x)].joint.axis, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(bodies[std::size_t(x)].inertia.mass, 0);
  EXPECT_EQ(bodies[std::size_t(x) + 1].joint.axis, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(bodies[std::size_t(x) + 1].parent, x);
  EXPECT_EQ(bodies[std::size_t(x) + 2].joint.kind, JointKind::revolute);
  EXPECT_EQ(bodies[std::size_t(x) + 2].joint.axis, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(bodies[std::size_t(x) + 2].parent, x + 1);
  EXPECT_EQ(bodies[std::size_t(x) + 2].name, "e");
  EXPECT_EQ(bodies[std::size_t(x) + 2].inertia.mass, 1.5);
  // The planar joint alone is a planar chain.
  EXPECT_TRUE(chain_from(robot_text(link_text("base") + moving("disc", "planar", "base"))).planar);
}

TEST(ReadChain, EveryLinkHasAFrameOnItsBody) {
  const Chain chain = read_chain(CHAINREEL_SOURCE "/tests/model/good/every_joint_kind.urdf");
  EXPECT_EQ(chain.frames[0].name, "base");
  EXPECT_EQ(chain.frames[0].body, 0);
  const Frame& welded = chain.frames[std::size_t(find_frame(chain, "f"))];
  EXPECT_EQ(chain.bodies[std::size_t(welded.body)].name, "e");
  EXPECT_EQ(welded.X_BF.translation(), Eigen::Vector3d(0.1, 0, 0));
  EXPECT_EQ(find_frame(chain, "no such link"), -1);
}

TEST(ReadChain, AFloatingBaseHangsTheRootOnAFloatingJoint) {
  ModelOptions options;
  options.floating_base = true;
  const std::string text =
      robot_text(link_text("trunk", inertial_text()) + moving("leg", "continuous", "trunk"));
  const Chain chain = chain_from(text, options);
  EXPECT_THAT(body_names(chain), ElementsAre("", "trunk", "leg"));
  EXPECT_EQ(chain.bodies[1].joint.name, "base");
  EXPECT_EQ(chain.bodies[1].joint.kind, JointKind::floating);
  EXPECT_EQ(chain.nq, 8);
  EXPECT_EQ(chain.nv, 7);
  EXPECT_EQ(chain.bodies[2].joint.q_index, 7);
  EXPECT_EQ(chain.bodies[2].joint.v_index, 6);
  EXPECT_EQ(chain.why_algebra, "spatial: a floating joint moves in space");
  EXPECT_EQ(chain.gravity, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(chain_from(text).nv, 1);
  // A joint of the file may be called base already.
  const std::string taken = link_text("trunk", inertial_text()) + link_text("leg", inertial_text()) +
                            joint_text("base", "continuous", "trunk", "leg");
  EXPECT_EQ(chain_from(robot_text(taken), options).bodies[1].joint.name, "floating_base");
}

TEST(ReadChain, FrictionCanBeSwitchedOff) {
  const std::string text =
      robot_text(link_text("base") +
                 moving("arm", "continuous", "base", "0 0 1", "<dynamics damping='0.5' friction='0.25'/>"));
  EXPECT_TRUE(chain_from(text).has_dissipation);
  ModelOptions options;
  options.friction = false;
  EXPECT_FALSE(chain_from(text, options).has_dissipation);
  EXPECT_EQ(chain_from(text, options).bodies[1].joint.damping, 0);
}

TEST(ReadChain, MasslessLinksGetTheMassAskedFor) {
  const std::string text =
      robot_text(link_text("base") + link_text("arm") + joint_text("swing", "continuous", "base", "arm"));
  ModelOptions options;
  options.massless = 1e-3;
  const Chain chain = chain_from(text, options);
  EXPECT_EQ(chain.bodies[1].inertia.mass, 1e-3);
  // A radius of gyration of 1 cm; squaring it rounds once.
  EXPECT_NEAR(chain.bodies[1].inertia.about_com(0, 0), 1e-7, 1e-22);
}

TEST(ReadChain, AMasslessLinkBetweenTwoHeavyOnesIsFineWhereItSaysSo) {
  const std::string none = inertial_text(0, "0 0 0", "ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'");
  const std::string cross = link_text("base") + link_text("cross", none) +
                            joint_text("first", "continuous", "base", "cross", "1 0 0") +
                            moving("bob", "continuous", "cross", "0 1 0");
  EXPECT_EQ(chain_from(robot_text(cross)).nv, 2);
}

TEST(ReadChain, MimicJointsShareTheCoordinateOfTheOneTheyFollow) {
  // The first follows the second, which follows the third: q1 = 2 q2 + 1, q2 = -3 q3 + 0.5.
  const Chain chain = chain_from(robot_text(
      link_text("base") +
      moving("a", "continuous", "base", "0 0 1", "<mimic joint='to_b' multiplier='2' offset='1'/>") +
      moving("b", "continuous", "a", "0 0 1", "<mimic joint='to_c' multiplier='-3' offset='0.5'/>") +
      moving("c", "continuous", "b") + moving("d", "prismatic", "c", "1 0 0", "<mimic joint='to_c'/>")));
  EXPECT_EQ(chain.nq, 1);
  EXPECT_EQ(chain.nv, 1);
  EXPECT_TRUE(chain.has_mimic);
  EXPECT_THAT(chain.coordinate_names, ElementsAre("to_c"));
  const auto expect_joint = [&](std::size_t body, double ratio, double offset) {
    EXPECT_EQ(chain.bodies[body].joint.q_index, 0);
    EXPECT_EQ(chain.bodies[body].joint.ratio, ratio);
    EXPECT_EQ(chain.bodies[body].joint.offset, offset);
  };
  expect_joint(1, -6, 2);
  expect_joint(2, -3, 0.5);
  expect_joint(3, 1, 0);
  expect_joint(4, 1, 0);
}

TEST(ReadChain, TheEndEffectorIsGripperElseTheOnlyLeafElseToBeNamed) {
  const std::string two_arms =
      link_text("base") + moving("left", "continuous", "base") + moving("right", "continuous", "base");
  const Chain undecided = chain_from(robot_text(two_arms));
  EXPECT_EQ(undecided.end_effector, -1);
  try {
    require_end_effector(undecided);
    FAIL() << "an end effector was found";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("the ends are left, right"));
  }

  const std::string gripper = link_text("gripper") + joint_text("grip", "fixed", "left", "gripper");
  const Chain with_gripper = chain_from(robot_text(two_arms + gripper));
  EXPECT_EQ(with_gripper.frames[std::size_t(require_end_effector(with_gripper))].name, "gripper");

  ModelOptions options;
  options.end_effector = "right";
  const Chain named = chain_from(robot_text(two_arms + gripper), options);
  EXPECT_EQ(named.frames[std::size_t(named.end_effector)].name, "right");

  const TemporaryFolder folder;
  options.end_effector = "rght";
  EXPECT_THAT(refusal_of(folder.write("arms.urdf", robot_text(two_arms)), options),
              HasSubstr("has no link 'rght' that could be the end effector: did you mean 'right'?"));
}

TEST(ReadChain, GravityPointsAlongMinusYInTheXyPlaneAndMinusZElsewhere) {
  const auto gravity = [](const std::string& type, const std::string& axis,
                          const ModelOptions& options = {}) {
    return chain_from(robot_text(link_text("base") + moving("arm", type, "base", axis)), options).gravity;
  };
  const Eigen::Vector3d minus_y(0, -9.81, 0), minus_z(0, 0, -9.81);
  EXPECT_EQ(gravity("continuous", "0 0 1"), minus_y);
  EXPECT_EQ(gravity("continuous", "0 0 -1"), minus_y);
  EXPECT_EQ(gravity("prismatic", "1 1 0"), minus_y);
  EXPECT_EQ(gravity("continuous", "1 0 0"), minus_z);
  EXPECT_EQ(gravity("prismatic", "0 0 1"), minus_z);
  EXPECT_EQ(gravity("floating", "0 0 1"), minus_z);
  ModelOptions moon;
  moon.gravity = Eigen::Vector3d(0, 0, -1.62);
  EXPECT_EQ(gravity("continuous", "0 0 1", moon), Eigen::Vector3d(0, 0, -1.62));
}

TEST(ReadChain, AxesAreNormalisedWhateverTheirLength) {
  for (const char* axis : {"0 0 1e-90", "0 0 1e9", "0 0 0.3"}) {
    const Chain chain = chain_from(robot_text(link_text("base") + moving("arm", "continuous", "base", axis)));
    EXPECT_EQ(chain.bodies[1].joint.axis, Eigen::Vector3d(0, 0, 1)) << axis;
  }
  const Chain chain =
      chain_from(robot_text(link_text("base") + moving("arm", "continuous", "base", "1 -2 3")));
  EXPECT_NEAR(chain.bodies[1].joint.axis.norm(), 1, 2e-16);  // one rounding a component
}

TEST(ReadChain, AnglesStayAsTheyAreWritten) {
  const auto turned = [](const std::string& yaw) {
    return chain_from(robot_text(link_text("base") + moving("arm", "continuous", "base", "0 0 1",
                                                            "<origin rpy='0 0 " + yaw + "'/>")))
        .bodies[1]
        .joint.X_PJ.linear()(0, 0);
  };
  // cos(1.5708) = -3.673205103e-06: the five digits are not taken for pi/2.
  EXPECT_NEAR(turned("1.5708"), -3.673205103e-06, 1e-15);
  EXPECT_LT(std::fabs(turned("1.5707963267948966")), 1e-16);
}

TEST(ReadChain, RotationsFollowRollPitchYaw) {
  // Written out with Eigen's own rotations, R = Rz Ry Rx.
  const Chain chain =
      chain_from(robot_text(link_text("base") + moving("arm", "continuous", "base", "0 0 1",
                                                       "<origin xyz='1 2 3' rpy='0.3 -0.7 1.9'/>")));
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(1.9, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.7, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  EXPECT_LE((chain.bodies[1].joint.X_PJ.linear() - R).cwiseAbs().maxCoeff(), 1e-15);  // a few roundings
  EXPECT_EQ(chain.bodies[1].joint.X_PJ.translation(), Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace chainreel
