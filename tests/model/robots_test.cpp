// Public robots (Gepetto's example-robot-data), found through the environment variable CHAINREEL_ROBOTS. They
// are not part of the project; without them these tests say so and pass.
#include <gmock/gmock.h>


#include "model/doctor.hpp"
#include "model_file.hpp"
#include "support/public_robots.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct Robot {
  const char* file;
  int nv;
  bool is_planar;
  bool serial;
};

const std::vector<Robot> kRobots{
    {"double_pendulum_description/urdf/double_pendulum.urdf", 2, true, true},
    {"double_pendulum_description/urdf/double_pendulum_continuous.urdf", 2, true, true},
    {"double_pendulum_description/urdf/double_pendulum_simple.urdf", 2, true, true},
    {"finger_edu_description/robots/finger_edu.urdf", 3, false, true},
    {"panda_description/urdf/panda.urdf", 8, false, false},  // nine joints, one of them mimics
    {"panda_description/urdf/panda_collision.urdf", 8, false, false},
    {"bolt_description/robots/bolt.urdf", 6, false, false},
    {"simple_humanoid_description/urdf/simple_humanoid.urdf", 29, false, false},
    {"simple_humanoid_description/urdf/simple_humanoid_classical.urdf", 29, false, false},
};

class PublicRobots : public ::testing::Test {
 protected:
  PublicRobots() {
    const std::string folder = public_robots_folder();
    if (folder.empty()) return;
    folder_ = fs::absolute(folder).lexically_normal();
    if (folder_.filename().empty()) folder_ = folder_.parent_path();  // it ended in a slash
    // Their meshes are package://example-robot-data/robots/NAME/..., where robots is this folder.
    options_.packages["example-robot-data"] = folder_.parent_path().string();
  }

  void SetUp() override {
    if (folder_.empty()) GTEST_SKIP() << kNoRobots;
  }
  std::string path(const char* file) const { return (folder_ / file).string(); }

  fs::path folder_;
  ModelOptions options_;
};

TEST_F(PublicRobots, AllAreReadWithTheirMeshes) {
  if (folder_.filename() != "robots") options_.meshes = false;
  for (const Robot& robot : kRobots) {
    SCOPED_TRACE(robot.file);
    const Chain chain = read_chain(path(robot.file), options_);
    EXPECT_EQ(chain.nv, robot.nv);
    EXPECT_EQ(chain.nq, robot.nv);
    EXPECT_EQ(chain.planar.has_value(), robot.is_planar) << chain.why_algebra;
    EXPECT_EQ(chain.serial, robot.serial);
    EXPECT_EQ(chain.gravity, Eigen::Vector3d(0, 0, -9.81));
  }
}

TEST_F(PublicRobots, TheDoublePendulumMovesInTheYzPlane) {
  const Chain chain = read_chain(path(kRobots[0].file), options_);
  ASSERT_TRUE(chain.planar);
  EXPECT_EQ(chain.why_algebra, "planar: all 2 revolute axes are parallel to x");
  EXPECT_EQ(chain.planar->plane.ex, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(chain.planar->plane.ey, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(chain.planar->bodies[1].inertia, 0.00040827);
}

TEST_F(PublicRobots, ThePandasFingersShareACoordinate) {
  const Chain chain = read_chain(path("panda_description/urdf/panda.urdf"), options_);
  EXPECT_TRUE(chain.has_mimic);
  EXPECT_EQ(chain.bodies.size(), 10u);
  EXPECT_EQ(chain.bodies[8].joint.v_index, chain.bodies[9].joint.v_index);
  EXPECT_EQ(chain.coordinate_names.back(), "panda_finger_joint1");
}

TEST_F(PublicRobots, BoltFloatsWhenAskedTo) {
  options_.floating_base = true;
  const Chain chain = read_chain(path("bolt_description/robots/bolt.urdf"), options_);
  EXPECT_EQ(chain.nq, 13);
  EXPECT_EQ(chain.nv, 12);
}

TEST_F(PublicRobots, TheDoctorFindsNoErrors) {
  for (const Robot& robot : kRobots) {
    for (const Finding& finding : examine_model(path(robot.file), options_))
      EXPECT_NE(finding.severity, Finding::Severity::error) << robot.file << ": " << finding.message;
  }
}

// package://example-robot-data/robots/panda_description/..: the path goes through the folder that the URDF lies in.
TEST_F(PublicRobots, WithoutTheirPackageTheMeshesAreFoundByTheirTailAndThatIsSaid) {
  options_.packages.clear();
  int said = 0;
  for (const Finding& finding : examine_model(path("panda_description/urdf/panda.urdf"), options_)) {
    EXPECT_THAT(finding.message, testing::Not(testing::HasSubstr("is not found")));
    said += finding.message.find("is not where its package should be, and is taken from") != std::string::npos;
  }
  EXPECT_GT(said, 0);
}

}  // namespace
}  // namespace chainreel
