#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/visuals.hpp"
#include "model_file.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

std::string shape_text(const std::string& tag, const std::string& geometry, const std::string& origin) {
  return "<" + tag + "><origin " + origin + "/><geometry>" + geometry + "</geometry></" + tag + ">";
}

// A base, and a link that turns on it with `shapes`.
Outline outline_of(const TemporaryFolder& folder, const std::string& shapes, const std::string& more = "") {
  const std::string path = folder.write(
      "model.urdf", "<robot name='m'>" + link_text("base", shape_text("visual", "<box size='9 9 9'/>", "")) +
                        link_text("arm", inertial_text() + shapes) + joint_text("hinge", "continuous", "base", "arm") +
                        more + "</robot>");
  return read_outline(path, read_chain(path), {});
}

double reach(const std::vector<Vector3d>& points, const Vector3d& direction) {
  double most = -1e300;
  for (const Vector3d& point : points) most = std::max(most, direction.dot(point));
  return most;
}

TEST(Outline, ReachesAsFarAsBoxesCylindersAndSpheresDo) {
  const TemporaryFolder folder;
  const Outline box = outline_of(folder, shape_text("visual", "<box size='1 0.5 0.2'/>", "xyz='0.5 0 0'"));
  ASSERT_EQ(box.points.size(), 2u);
  EXPECT_TRUE(box.points[0].empty()) << "the world does not move";
  EXPECT_EQ(box.points[1].size(), 8u);
  EXPECT_NEAR(reach(box.points[1], Vector3d::UnitX()), 1, 1e-15);
  EXPECT_NEAR(reach(box.points[1], -Vector3d::UnitX()), 0, 1e-15);
  EXPECT_NEAR(reach(box.points[1], Vector3d::UnitZ()), 0.1, 1e-15);
  // Turned by a right angle about z: its length lies along y.
  const Outline turned =
      outline_of(folder, shape_text("visual", "<cylinder radius='0.1' length='2'/>", "rpy='1.5707963267948966 0 0'"));
  EXPECT_NEAR(reach(turned.points[1], Vector3d::UnitY()), 1, 1e-15);
  EXPECT_NEAR(reach(turned.points[1], Vector3d::UnitX()), 0.1, 1e-15);
  const Outline sphere = outline_of(folder, shape_text("visual", "<sphere radius='0.3'/>", "xyz='0 0 1'"));
  EXPECT_EQ(sphere.points[1].size(), 6u);
  EXPECT_NEAR(reach(sphere.points[1], Vector3d::UnitZ()), 1.3, 1e-15);
}

TEST(Outline, TakesCollisionShapesWhereThereIsNothingElseAndLinksThatAreFixed) {
  const TemporaryFolder folder;
  const std::string small = shape_text("collision", "<box size='0.2 0.2 0.2'/>", "");
  EXPECT_NEAR(reach(outline_of(folder, small).points[1], Vector3d::UnitX()), 0.1, 1e-15);
  const std::string both = small + shape_text("visual", "<box size='0.4 0.4 0.4'/>", "");
  EXPECT_NEAR(reach(outline_of(folder, both).points[1], Vector3d::UnitX()), 0.2, 1e-15);
  const std::string flag = link_text("flag", shape_text("visual", "<sphere radius='0.5'/>", "xyz='2 0 0'")) +
                           joint_text("glue", "fixed", "arm", "flag");
  EXPECT_NEAR(reach(outline_of(folder, both, flag).points[1], Vector3d::UnitX()), 2.5, 1e-15);
}

TEST(Outline, OfManyShapesKeepsWhatLiesFarthest) {
  const TemporaryFolder folder;
  std::string shapes;
  for (int k = 0; k < 20; ++k)
    shapes += shape_text("visual", "<box size='0.1 0.1 0.1'/>", "xyz='" + std::to_string(0.2 * k) + " 0 0'");
  const Outline outline = outline_of(folder, shapes);
  EXPECT_LE(outline.points[1].size(), 26u);
  EXPECT_NEAR(reach(outline.points[1], Vector3d::UnitX()), 3.85, 1e-12);
  EXPECT_NEAR(reach(outline.points[1], Vector3d(1, 1, 1)), 3.95, 1e-12);
}

TEST(Outline, MeasuresMeshesWithTheirScaleAndNamesThoseThatItCannot) {
  const TemporaryFolder folder;
  folder.write("plate.obj", "v 0 0 0\nv 100 0 0\nv 0 50 0\nv 0 0 20\nf 1 2 3\nf 1 2 4\n");
  const std::string good = "<mesh filename='plate.obj' scale='0.01 0.01 -0.01'/>";
  const Outline outline = outline_of(folder, shape_text("visual", good, "xyz='0 0 1'"));
  EXPECT_TRUE(outline.unmeasured.empty());
  EXPECT_NEAR(reach(outline.points[1], Vector3d::UnitX()), 1, 1e-6);
  EXPECT_NEAR(reach(outline.points[1], -Vector3d::UnitZ()), -0.8, 1e-6);  // a mirror turns it down
  folder.write("broken.obj", "nonsense");
  for (const char* name : {"broken.obj", "missing.stl"}) {
    const Outline none = outline_of(folder, shape_text("visual", std::string("<mesh filename='") + name + "'/>", ""));
    EXPECT_THAT(none.unmeasured, testing::ElementsAre("arm")) << name;
    EXPECT_TRUE(none.points[1].empty());
  }
}

}  // namespace
}  // namespace chainreel
