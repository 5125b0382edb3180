#include "model/planar.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/format.hpp"
#include "model_file.hpp"

namespace chainreel {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

double value_of(const Joint& joint, const std::vector<double>& q) {
  return joint.ratio * q[std::size_t(joint.q_index)] + joint.offset;
}

// Where each body's centre of mass is in the world, by poses in space.
std::vector<Vector3d> centres_in_space(const Chain& chain, const std::vector<double>& q) {
  std::vector<Isometry3d> X(chain.bodies.size(), Isometry3d::Identity());
  std::vector<Vector3d> centres(chain.bodies.size(), Vector3d::Zero());
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Body& body = chain.bodies[i];
    const double value = value_of(body.joint, q);
    X[i] = X[std::size_t(body.parent)] * body.joint.X_PJ;
    if (body.joint.kind == JointKind::revolute) X[i].rotate(Eigen::AngleAxisd(value, body.joint.axis));
    if (body.joint.kind == JointKind::prismatic) X[i].translate(value * body.joint.axis);
    centres[i] = X[i] * body.inertia.com;
  }
  return centres;
}

// The same in the plane, by the planar form alone: an angle and a point a body.
std::vector<Vector2d> centres_in_plane(const PlanarChain& form, const std::vector<double>& q) {
  const auto turned = [](double angle, const Vector2d& v) { return Vector2d(Eigen::Rotation2Dd(angle) * v); };
  std::vector<double> angle(form.bodies.size(), 0);
  std::vector<Vector2d> origin(form.bodies.size(), Vector2d::Zero()),
      centres(form.bodies.size(), Vector2d::Zero());
  for (std::size_t i = 1; i < form.bodies.size(); ++i) {
    const PlanarBody& body = form.bodies[i];
    const auto parent = std::size_t(body.parent);
    const double value = body.ratio * q[std::size_t(body.q_index)] + body.offset;
    angle[i] = angle[parent];
    origin[i] = origin[parent] + turned(angle[parent], body.p_PJ);
    if (body.kind == JointKind::revolute) angle[i] += body.sign * value;
    if (body.kind == JointKind::prismatic) origin[i] += turned(angle[parent], value * body.direction);
    centres[i] = origin[i] + turned(angle[i], body.com);
  }
  return centres;
}

// The largest distance between a centre of mass projected on the plane and the same by the planar form.
double largest_miss(const Chain& chain, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> number(-3, 3);
  double miss = 0;
  for (int pose = 0; pose < 20; ++pose) {
    std::vector<double> q(std::size_t(chain.nq));
    for (double& value : q) value = number(generator);
    const auto in_space = centres_in_space(chain, q);
    const auto in_plane = centres_in_plane(*chain.planar, q);
    const Plane& plane = chain.planar->plane;
    for (std::size_t i = 1; i < in_space.size(); ++i) {
      const Vector2d projected(in_space[i].dot(plane.ex), in_space[i].dot(plane.ey));
      miss = std::max(miss, (projected - in_plane[i]).norm());
    }
  }
  return miss;
}

// A tree of revolute joints either way round, prismatic joints within the plane and a mimic joint, hung up in
// the world by `rpy`; every joint has an offset out of the plane as well.
std::string tree_in_a_plane(const std::string& rpy) {
  const auto at = [](const std::string& xyz, const std::string& rest = "") {
    return "<origin xyz='" + xyz + "' rpy='0 0 0.4'/>" + rest;
  };
  return robot_text(
      link_text("world") + link_text("base") +
      joint_text("hang", "fixed", "world", "base", "1 0 0", "<origin xyz='1 2 3' rpy='" + rpy + "'/>") +
      moving("a", "continuous", "base", "0 0 1", at("0.1 0.2 0.3")) +
      moving("b", "prismatic", "a", "1 2 0", at("0.5 -0.1 0.2")) +
      moving("c", "continuous", "b", "0 0 -1", at("0.2 0.3 -0.4")) +
      moving("d", "continuous", "a", "0 0 2",
             at("-0.4 0.1 0.1", "<mimic joint='to_c' multiplier='-0.5' offset='0.25'/>")) +
      moving("e", "prismatic", "d", "-3 1 0", at("0 0.2 0")));
}

// Lengths of 1 to 10 m, a dozen roundings deep.
constexpr double kPlaneRoundOff = 1e-13;

TEST(Planar, TheFormMovesAsTheChainDoesWhateverTheOrientationOfThePlane) {
  for (const char* rpy :
       {"0 0 0", "1.5707963267948966 0 0", "0 1.5707963267948966 0", "0.3 -0.7 1.9", "3 0.2 -2"}) {
    const Chain chain = chain_from(tree_in_a_plane(rpy));
    ASSERT_TRUE(chain.planar) << chain.why_algebra;
    EXPECT_LE(largest_miss(chain, 7), kPlaneRoundOff) << rpy;
    const Plane& plane = chain.planar->plane;
    EXPECT_LE((plane.ex.cross(plane.ey) - plane.normal).norm(), 1e-15);
    EXPECT_LE(std::fabs(plane.ex.dot(plane.ey)), 1e-15);
  }
}

TEST(Planar, TheCheckAboveSeesAWrongSign) {
  Chain chain = chain_from(tree_in_a_plane("0.3 -0.7 1.9"));
  chain.planar->bodies[3].sign = -chain.planar->bodies[3].sign;
  EXPECT_GT(largest_miss(chain, 7), 0.1);
}

TEST(Planar, InertiaIsTakenAboutTheNormal) {
  const std::string inertia = "ixx='1' ixy='0.1' ixz='0.2' iyy='2' iyz='0.3' izz='2.5'";
  const auto about = [&](const std::string& axis) {
    const Chain chain =
        chain_from(robot_text(link_text("base") + link_text("arm", inertial_text(1, "0 0 0", inertia)) +
                              joint_text("swing", "continuous", "base", "arm", axis)));
    return chain.planar->bodies[1].inertia;
  };
  EXPECT_EQ(about("1 0 0"), 1);
  EXPECT_EQ(about("0 -1 0"), 2);
  EXPECT_EQ(about("0 0 1"), 2.5);
  // n^T I n for n = (1, 1, 0)/sqrt 2.
  EXPECT_NEAR(about("1 1 0"), 0.5 * (1 + 2 + 2 * 0.1), 1e-15);
}

struct View {
  Vector3d ex, ey;
};

View view_of(const std::string& joints, std::optional<Vector3d> gravity = std::nullopt) {
  ModelOptions options;
  options.gravity = gravity;
  const Chain chain = chain_from(robot_text(link_text("base") + joints), options);
  EXPECT_TRUE(chain.planar) << chain.why_algebra;
  return {chain.planar->plane.ex, chain.planar->plane.ey};
}

void expect_view(const View& view, const Vector3d& ex, const Vector3d& ey) {
  EXPECT_LE((view.ex - ex).norm(), 1e-15) << view.ex.transpose();
  EXPECT_LE((view.ey - ey).norm(), 1e-15) << view.ey.transpose();
}

TEST(Planar, UpIsAgainstGravityAndXToTheRight) {
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), none(0, 0, 0);
  for (const char* axis : {"0 0 1", "0 0 -1"})
    expect_view(view_of(moving("a", "continuous", "base", axis)), x, y);
  for (const char* axis : {"0 1 0", "0 -1 0"})
    expect_view(view_of(moving("a", "continuous", "base", axis)), x, z);
  for (const char* axis : {"1 0 0", "-1 0 0"})
    expect_view(view_of(moving("a", "continuous", "base", axis)), y, z);
  // Without gravity in the plane: +y is up, else +z.
  expect_view(view_of(moving("a", "continuous", "base", "0 0 1"), none), x, y);
  expect_view(view_of(moving("a", "continuous", "base", "0 1 0"), none), x, z);
  expect_view(view_of(moving("a", "continuous", "base", "0 0 1"), Vector3d(0, 0, -9.81)), x, y);
  // Coordinates do not turn with gravity where the plane holds two axes of the world: up is the nearest.
  for (const Vector3d& tilted : {Vector3d(3, -4, 0), Vector3d(-3, -4, 0), Vector3d(0.2, -9.81, 1)})
    expect_view(view_of(moving("a", "continuous", "base", "0 0 1"), tilted), x, y);
  expect_view(view_of(moving("a", "continuous", "base", "0 1 0"), Vector3d(2, 0, -9)), x, z);
  expect_view(view_of(moving("a", "continuous", "base", "0 0 1"), Vector3d(-9, 1, 0)), y, x);
  const double h = std::sqrt(0.5);
  expect_view(view_of(moving("a", "continuous", "base", "0.70710678118654757 0 0.70710678118654757"), Vector3d(0, -4, 0)), {h, 0, -h}, y);
  expect_view(view_of(moving("a", "continuous", "base", "0.70710678118654757 0 0.70710678118654757"), Vector3d(3, -4, -3)),
              Vector3d(4 * h, 3 / h, -4 * h).normalized(), Vector3d(-3, 4, 3).normalized());
  // In the yz plane the first link decides: it lies along -y, so -y is to the right.
  const std::string along_minus_y = "<origin xyz='0 -1 0'/>";
  expect_view(view_of(moving("a", "continuous", "base", "1 0 0") +
                      moving("b", "continuous", "a", "1 0 0", along_minus_y)),
              -y, z);
}

TEST(Planar, OneSlidingDirectionLiesInThePlaneWithGravity) {
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), none(0, 0, 0);
  expect_view(view_of(moving("a", "prismatic", "base", "1 0 0")), x, y);
  expect_view(view_of(moving("a", "prismatic", "base", "0 1 0")), x, y);
  expect_view(view_of(moving("a", "prismatic", "base", "0 0 1")), x, z);
  expect_view(view_of(moving("a", "prismatic", "base", "0 1 0"), none), x, y);
  expect_view(view_of(moving("a", "prismatic", "base", "1 0 0"), Vector3d(0, 0, -9.81)), x, z);
  expect_view(view_of(moving("a", "prismatic", "base", "1 0 0") + moving("b", "prismatic", "a", "-1 0 0")), x,
              y);
}

std::string why(const std::string& joints) {
  return chain_from(robot_text(link_text("base") + joints)).why_algebra;
}

TEST(Planar, TheReasonNamesTheDirectionOrTheJointsThatLeaveThePlane) {
  const std::string turn = moving("a", "continuous", "base", "0 0 1");
  EXPECT_EQ(why(turn), "planar: the only joint turns about z");
  EXPECT_EQ(why(turn + moving("b", "continuous", "a", "0 0 -1")),
            "planar: all 2 revolute axes are parallel to z");
  EXPECT_EQ(why(turn + moving("b", "continuous", "a", "0 1 0")),
            "spatial: the axes of to_a and to_b are not parallel");
  EXPECT_EQ(why(turn + moving("b", "prismatic", "a", "1 0 0")),
            "planar: revolute axes are parallel and prismatic axes normal to z");
  EXPECT_EQ(why(turn + moving("b", "prismatic", "a", "0 0 1")),
            "spatial: the axis of to_b is not normal to the axis of to_a");
  // A prismatic joint before the first revolute one counts as well.
  EXPECT_EQ(why(moving("b", "prismatic", "base", "0 1 1") + moving("a", "continuous", "b", "0 0 1")),
            "spatial: the axis of to_b is not normal to the axis of to_a");
  const std::string slide = moving("a", "prismatic", "base", "1 0 0");
  EXPECT_EQ(why(slide), "planar: the only joint slides along x");
  EXPECT_EQ(why(slide + moving("b", "prismatic", "a", "1 0 0")),
            "planar: all 2 prismatic axes are parallel to x");
  EXPECT_EQ(why(slide + moving("b", "prismatic", "a", "0 1 1")),
            "planar: all 2 prismatic axes are normal to (0, -0.707, 0.707)");
  EXPECT_EQ(why(slide + moving("b", "prismatic", "a", "0 1 0") + moving("c", "prismatic", "b", "0 0 1")),
            "spatial: the axes of to_a, to_b and to_c do not lie in one plane");
}

TEST(Planar, AnglesWithFewDigitsAreNotSnappedButExplained) {
  const auto hung = [](const std::string& angle) {
    return chain_from(
        robot_text(link_text("base") + moving("a", "continuous", "base", "1 0 0") +
                   moving("b", "continuous", "a", "0 0 1", "<origin rpy='0 " + angle + " 0'/>")));
  };
  const Chain few = hung("1.5708");
  EXPECT_FALSE(few.planar);
  EXPECT_TRUE(is_nearly_planar(few));
  EXPECT_THAT(few.why_algebra, HasSubstr("by 3.7e-06 rad only: pi/2 in full is 1.5707963267948966"));
  const Chain all = hung("1.5707963267948966");
  EXPECT_TRUE(all.planar) << all.why_algebra;
  EXPECT_FALSE(is_nearly_planar(all));
  EXPECT_FALSE(is_nearly_planar(hung("1")));
}

TEST(Planar, AChainOfManyTurnedFramesStaysPlanar) {
  std::string text = link_text("world") + link_text("l0") +
                     joint_text("hang", "fixed", "world", "l0", "1 0 0", "<origin rpy='0.3 -0.7 1.9'/>");
  for (int i = 1; i <= 2000; ++i) {
    text += moving("l" + std::to_string(i), "continuous", "l" + std::to_string(i - 1), "0 0 1",
                   "<origin xyz='1 0 0' rpy='0 0 0.1'/>");
  }
  const Chain chain = chain_from(robot_text(text));
  ASSERT_TRUE(chain.planar) << chain.why_algebra;
  EXPECT_LE(largest_miss(chain, 1), 1e-9);  // 2000 m long, 2000 joints: both sides gather round-off
}

}  // namespace
}  // namespace chainreel
