#include "model/package_path.hpp"

#include <gmock/gmock.h>

#include "model/visuals.hpp"
#include "model_file.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// An environment variable for the time of a test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (old_) {
      setenv(name_, old_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

class PackagePath : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string mesh(const std::string& name) const { return folder_.write(name, "solid\nendsolid\n"); }
  FoundFile find(const std::string& name, std::map<std::string, std::string> packages = {}) const {
    return FileFinder(path("ws/arm_robot/urdf/arm.urdf"), std::move(packages)).find(name);
  }

  TemporaryFolder folder_;
  Variable no_ros_{"ROS_PACKAGE_PATH", ""};
  Variable no_ament_{"AMENT_PREFIX_PATH", ""};
};

TEST_F(PackagePath, AGivenFolderComesFirst) {
  const std::string given = mesh("elsewhere/meshes/m.stl");
  mesh("ws/arm_robot/meshes/m.stl");
  EXPECT_EQ(find("package://arm_robot/meshes/m.stl", {{"arm_robot", path("elsewhere")}}).path, given);
}

TEST_F(PackagePath, TheNearestPackageXmlCountsWhereItsNameFits) {
  const std::string inside = mesh("ws/arm_robot/meshes/m.stl");
  folder_.write("ws/arm_robot/package.xml", "<package><name>other_name</name></package>");
  EXPECT_EQ(find("package://other_name/meshes/m.stl").path, inside);
  EXPECT_EQ(find("package://third_name/meshes/m.stl").path, "");
  folder_.write("ws/arm_robot/package.xml", "<package><name>");  // broken: as if it were not there
  EXPECT_EQ(find("package://other_name/meshes/m.stl").path, "");
}

TEST_F(PackagePath, AFolderAboveOfThatNameCounts) {
  const std::string inside = mesh("ws/arm_robot/meshes/m.stl");
  EXPECT_EQ(find("package://arm_robot/meshes/m.stl").path, inside);
}

TEST_F(PackagePath, RosAndAmentFoldersAreSearchedInTheirOrder) {
  const std::string ros = mesh("ros/tools/m.stl"), itself = mesh("second/gear/m.stl"),
                    ament = mesh("opt/share/hand/m.stl");
  const Variable ros_path("ROS_PACKAGE_PATH", path("ros") + "::" + path("second/gear"));
  const Variable ament_path("AMENT_PREFIX_PATH", path("opt"));
  EXPECT_EQ(find("package://tools/m.stl").path, ros);
  EXPECT_EQ(find("package://gear/m.stl").path, itself);
  EXPECT_EQ(find("package://hand/m.stl").path, ament);
  EXPECT_THAT(
      find("package://none/m.stl").searched,
      ElementsAre(path("ros/none/m.stl"), path("second/gear/none/m.stl"), path("opt/share/none/m.stl")));
}

TEST_F(PackagePath, PlainPathsCountFromTheUrdfAndFileAddressesFromTheRoot) {
  const std::string beside = mesh("ws/arm_robot/meshes/m.stl"), spaced = mesh("a b/m.stl");
  EXPECT_EQ(find("../meshes/m.stl").path, beside);
  EXPECT_EQ(find(beside).path, beside);
  EXPECT_EQ(find("file://" + beside).path, beside);
  EXPECT_EQ(find("file://" + path("a%20b/m.stl")).path, spaced);
  EXPECT_EQ(find("meshes/m.stl").path, "");
}

TEST_F(PackagePath, WhatIsNotFoundTellsWhereItWasSearchedAndWhatToDo) {
  const FoundFile lost = find("package://lost/m.stl", {{"lost", path("there")}});
  EXPECT_EQ(missing_mesh_message("arm", "package://lost/m.stl", lost),
            "link 'arm': the mesh 'package://lost/m.stl' is not found (searched " + path("there/m.stl") +
                "): say where the package lies with `--package lost=FOLDER`");
  EXPECT_THAT(find("http://host/m.stl").searched, IsEmpty());
  EXPECT_THAT(find("http://host/m.stl").remedy, HasSubstr("only package://, file:// and plain paths"));
  // A package without a name cannot be given a folder.
  for (const char* name : {"package://", "package:///meshes/m.stl"}) {
    EXPECT_THAT(find(name).remedy, HasSubstr("names no package"));
    EXPECT_THAT(find(name).remedy, testing::Not(HasSubstr("--package")));
  }
}

TEST_F(PackagePath, APackageThatStandsDeeperIsFoundByItsTail) {
  const std::string deep = mesh("repository/robots/panda_description/meshes/m.stl");
  const FoundFile found =
      find("package://panda_description/meshes/m.stl", {{"panda_description", path("repository")}});
  EXPECT_EQ(found.path, deep);
  EXPECT_TRUE(found.by_tail);
  // Its own place comes first, and is nothing to speak of.
  const std::string own = mesh("repository/meshes/m.stl");
  const FoundFile first = find("package://panda_description/meshes/m.stl", {{"panda_description", path("repository")}});
  EXPECT_EQ(first.path, own);
  EXPECT_FALSE(first.by_tail);
}

TEST_F(PackagePath, APathThroughAFolderAboveTheUrdfIsFoundByItsTail) {
  const std::string inside = mesh("ws/arm_robot/meshes/m.stl");
  const FoundFile found = find("package://collection/robots/arm_robot/meshes/m.stl");
  EXPECT_EQ(found.path, inside);
  EXPECT_TRUE(found.by_tail);
  // Negative control: a file of the same name in the package of another robot is not taken.
  EXPECT_EQ(find("package://collection/robots/leg_robot/meshes/m.stl").path, "");
  EXPECT_EQ(find("package://collection/meshes/m.stl").path, "");
}

TEST_F(PackagePath, OnlyPicturesAskForMeshes) {
  const auto asked_for = [&](const std::string& tag, const std::string& file) -> std::string {
    const std::string arm = folder_.write(
        "ws/arm_robot/urdf/arm.urdf",
        robot_text(link_text("base") +
                   link_text("arm", inertial_text() + "<" + tag + "><geometry><mesh filename='" + file +
                                        "'/></geometry></" + tag + ">") +
                   joint_text("swing", "continuous", "base", "arm")));
    EXPECT_EQ(refusal_of(arm), "");
    try {
      read_visuals(arm, read_chain(arm), {});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  mesh("ws/arm_robot/meshes/m.stl");
  EXPECT_EQ(asked_for("visual", "package://arm_robot/meshes/m.stl"), "");
  EXPECT_THAT(asked_for("visual", "package://arm_robot/meshes/n.stl"), HasSubstr("is not found (searched"));
  EXPECT_EQ(asked_for("collision", "package://arm_robot/meshes/n.stl"), "");
}

}  // namespace
}  // namespace chainreel
