#include "model/read_chain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace chainreel {
namespace {

using testing::ElementsAre;

TEST(ReadChain, RrIsTwoPointMassesAtTheEndsOfTwoLinks) {
  const Chain chain = read_chain("models/rr.urdf");
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
    EXPECT_EQ(chain.planar->bodies[i].p_PJ, Eigen::Vector2d(i - 1.0, 0));
  }
}

TEST(ReadChain, PlanarScenesHaveXToTheRightAndYUp) {
  for (const char* file : {"models/rr.urdf", "models/rrr.urdf", "models/pp.urdf", "models/p.urdf"}) {
    const Chain chain = read_chain(file);
    ASSERT_TRUE(chain.planar) << file;
    EXPECT_EQ(chain.planar->plane.ex, Eigen::Vector3d(1, 0, 0)) << file;
    EXPECT_EQ(chain.planar->plane.ey, Eigen::Vector3d(0, 1, 0)) << file;
    EXPECT_EQ(chain.planar->plane.normal, Eigen::Vector3d(0, 0, 1)) << file;
    EXPECT_EQ(chain.gravity, Eigen::Vector3d(0, -9.81, 0)) << file;
  }
}

}  // namespace
}  // namespace chainreel
