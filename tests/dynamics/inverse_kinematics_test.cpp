// Oracles: forward kinematics of every pose found; of RR the two triangles that the law of cosines gives; and that
// every point between the inner and the outer circle is found.
#include "dynamics/inverse_kinematics.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/kinematics.hpp"
#include "model/link_chain.hpp"
#include "model/read_chain.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d tip_of(const Chain& chain, const std::vector<double>& q) {
  Workspace ws(chain);
  compute_kinematics(chain, ws, q, std::vector<double>(std::size_t(chain.nv), 0.0));
  return frame_position(chain, ws, chain.end_effector);
}

class Reaches : public ::testing::TestWithParam<std::string> {};

// 1e-9 m is what a figure promises; the solver itself stops at 1e-10 m.
TEST_P(Reaches, EveryPointOfTheWorkspaceForBothElbows) {
  const Chain chain = read_chain("models/" + GetParam() + ".urdf");
  for (const Elbow elbow : {Elbow::up, Elbow::down}) {
    PointSolver solver(chain, elbow);
    for (int i = 0; i < 9; ++i)
      for (int k = 0; k < 12; ++k) {
        // Off the circle on which RR stretches, and off its middle.
        const double r = solver.reach() * (0.06 + 0.93 * i / 8), a = 2 * kPi * (k + 0.3) / 12;
        const Eigen::Vector3d point = solver.middle() + r * (std::cos(a) * solver.ex() + std::sin(a) * solver.ey());
        const auto q = solver.pose_at(point);
        ASSERT_TRUE(q) << GetParam() << " r = " << r << ", angle " << a;
        EXPECT_LT((tip_of(chain, *q) - point).norm(), 1e-9);
        for (std::size_t j = 1; j < q->size(); ++j)
          EXPECT_TRUE(elbow == Elbow::up ? (*q)[j] < 1e-6 : (*q)[j] > -1e-6) << "r = " << r << ", q = " << (*q)[j];
      }
  }
}
INSTANTIATE_TEST_SUITE_P(PlanarChains, Reaches, ::testing::Values("rr", "rrr"));

TEST(InverseKinematics, OfRrIsTheTriangleOfTheLawOfCosines) {
  const Chain chain = read_chain("models/rr.urdf");  // unit links
  const Eigen::Vector3d point(0.9, 0.7, 0);
  const double d2 = point.squaredNorm(), bend = std::acos((d2 - 2) / 2);
  const auto up = PointSolver(chain, Elbow::up).pose_at(point), down = PointSolver(chain, Elbow::down).pose_at(point);
  ASSERT_TRUE(up && down);
  // A handful of roundings of angles below 4.
  EXPECT_NEAR((*up)[1], -bend, 1e-14);
  EXPECT_NEAR((*down)[1], bend, 1e-14);
  // An isosceles triangle: the first link is half the bend away from the direction of the point.
  EXPECT_NEAR((*up)[0], std::atan2(0.7, 0.9) + bend / 2, 1e-14);
  EXPECT_NEAR((*down)[0], std::atan2(0.7, 0.9) - bend / 2, 1e-14);
}

// Three unit links that bend by b twice reach to |1 + 2 cos b|: of two such bends within 1 m the smaller one.
TEST(InverseKinematics, OfRrrBendsAlikeAsLittleAsNeedBe) {
  const Chain chain = read_chain("models/rrr.urdf");
  for (const Elbow elbow : {Elbow::up, Elbow::down})
    for (const double r : {0.01, 0.3, 0.5303, 0.6452, 0.999, 1.0006, 1.5, 2.121, 2.99, 3.0}) {
      const auto q = PointSolver(chain, elbow).pose_at({r * std::cos(0.4), r * std::sin(0.4), 0});
      ASSERT_TRUE(q) << r;
      const double bend = (elbow == Elbow::up ? -1 : 1) * std::acos((r - 1) / 2);
      // Where it stretches out, a rounding of r is its root of the bend.
      EXPECT_NEAR((*q)[1], bend, r > 2.98 ? 1e-7 : 1e-12) << r;
      EXPECT_EQ((*q)[1], (*q)[2]) << r;
    }
}

// Three equal links close to a triangle there.
TEST(InverseKinematics, OfRrrReachesItsOwnBase) {
  const Chain chain = read_chain("models/rrr.urdf");
  const auto q = PointSolver(chain, Elbow::up).pose_at(tip_of(chain, {0, 2 * kPi / 3, 2 * kPi / 3}));
  ASSERT_TRUE(q);
  EXPECT_NEAR((*q)[1], -2 * kPi / 3, 1e-9);
}

// A slider first: what it cannot give the two bends do.
TEST(InverseKinematics, OfASliderFirstBendsAlikeToo) {
  const TemporaryFolder folder;
  LinkChain links;
  links.links = {0.3, 0.4, 0.5};
  links.joints = "PRR";
  EXPECT_TRUE(complete(links).empty());
  Chain chain = read_chain(folder.write("prr.urdf", urdf_of(links, "prr")));
  chain.bodies[1].joint.limit.lower = -0.2;
  chain.bodies[1].joint.limit.upper = 0.5;
  const std::vector<double> straight{0.1, 0, 0};
  EXPECT_NEAR((tip_of(chain, *PointSolver(chain, Elbow::up).pose_at(tip_of(chain, straight))) - tip_of(chain, straight)).norm(), 0, 1e-9);
  int found = 0;
  for (const Elbow elbow : {Elbow::up, Elbow::down})
    for (double x = -0.4; x < 1.5; x += 0.1)
      for (double y = -0.85; y < 0.9; y += 0.1) {
        const auto q = PointSolver(chain, elbow).pose_at({x, y, 0});
        if (!q) continue;
        ++found;
        EXPECT_LT((tip_of(chain, *q) - Eigen::Vector3d(x, y, 0)).norm(), 1e-9);
        EXPECT_EQ((*q)[1], (*q)[2]) << x << " " << y;
        EXPECT_TRUE(elbow == Elbow::up ? (*q)[1] <= 0 : (*q)[1] >= 0);
      }
  EXPECT_GT(found, 50);
}

// Negative controls.
TEST(InverseKinematics, FindsNothingWhereNothingIs) {
  for (const char* name : {"rr", "rrr"}) {
    const Chain chain = read_chain(std::string("models/") + name + ".urdf");
    PointSolver solver(chain, Elbow::up);
    EXPECT_FALSE(solver.pose_at(solver.middle() + 1.001 * solver.reach() * solver.ex()));
  }
  const Chain rr = read_chain("models/rr.urdf");
  // In the middle of equal links the first one's direction is free.
  EXPECT_FALSE(PointSolver(rr, Elbow::up).pose_at(Eigen::Vector3d::Zero()));
}

TEST(InverseKinematics, KeepsToTheJointsLimits) {
  Chain chain = read_chain("models/rr.urdf");
  chain.bodies[2].joint.limit.lower = 0;
  chain.bodies[2].joint.limit.upper = 1;
  const Eigen::Vector3d far(1.9, 0.1, 0), near(0.5, 0.1, 0);  // bends of 0.63 and 2.63 rad
  EXPECT_TRUE(PointSolver(chain, Elbow::down).pose_at(far));
  EXPECT_FALSE(PointSolver(chain, Elbow::down).pose_at(near));
  EXPECT_FALSE(PointSolver(chain, Elbow::up).pose_at(far));
}

TEST(InverseKinematics, SaysWhichChainsHaveAField) {
  const auto message = [](const Chain& chain) {
    try {
      PointSolver solver(chain, Elbow::up);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(message(read_chain("models/pp.urdf")), testing::HasSubstr("without limits"));
  EXPECT_THAT(message(read_chain("models/p.urdf")), testing::HasSubstr("two or three joints"));
  EXPECT_EQ(message(read_chain("models/rr.urdf")), "accepted");
}

}  // namespace
}  // namespace chainreel
