#include "model/visuals.hpp"

#include <gmock/gmock.h>

#include <map>

#include "mesh/mesh_extents.hpp"
#include "mesh/read_mesh.hpp"
#include "model_file.hpp"
#include "support/public_robots.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string visual_text(const std::string& inside, const std::string& geometry = "<box size='1 2 3'/>") {
  return "<visual>\n<geometry>" + geometry + "</geometry>\n" + inside + "</visual>\n";
}

// A base with `base` inside, and one moving link with `arm` inside.
std::string model_text(const std::string& base, const std::string& arm, const std::string& more = "") {
  return robot_text(more + link_text("base", base) + link_text("arm", inertial_text() + arm) +
                    joint_text("j", "revolute", "base", "arm", "0 0 1",
                               "<origin xyz='0 0 1'/><limit effort='1' velocity='1'/>"));
}

std::vector<Visual> visuals_in(const std::string& path, const ModelOptions& options = {}) {
  return read_visuals(path, read_chain(path, options), options);
}

std::vector<Visual> visuals_from(const std::string& text) {
  const TemporaryFolder folder;
  return visuals_in(folder.write("model.urdf", text));
}

std::string refusal_from(const std::string& text) {
  try {
    visuals_from(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
  return "";
}

TEST(Visuals, HaveTheirShapesInDocumentOrder) {
  const std::vector<Visual> visuals = visuals_from(model_text(
      visual_text("<origin xyz='1 0 0'/>"),
      visual_text("", "<cylinder radius='0.1' length='2'/>") + visual_text("", "<sphere radius='0.3'/>")));
  ASSERT_EQ(visuals.size(), 3U);
  EXPECT_EQ(visuals[0].kind, VisualKind::box);
  EXPECT_EQ(visuals[0].body, 0);
  EXPECT_EQ(visuals[0].link, "base");
  EXPECT_EQ(visuals[0].size, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(visuals[0].X_BV.translation(), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(visuals[0].place.line, 2);
  EXPECT_FALSE(visuals[0].color);
  EXPECT_EQ(visuals[1].kind, VisualKind::cylinder);
  EXPECT_EQ(visuals[1].body, 1);
  EXPECT_EQ(visuals[1].size, Eigen::Vector3d(0.1, 0.1, 2));
  EXPECT_EQ(visuals[2].kind, VisualKind::sphere);
  EXPECT_EQ(visuals[2].size[0], 0.3);
}

TEST(Visuals, OfLumpedLinksAreOnTheBodyThatCarriesThem) {
  const std::string text = robot_text(link_text("base") + moving("arm", "continuous", "base") +
                                      link_text("tool", visual_text("<origin xyz='0 0 3'/>")) +
                                      joint_text("fix", "fixed", "arm", "tool", "0 0 1",
                                                 "<origin xyz='2 0 0' rpy='0 1.5707963267948966 0'/>"));
  const std::vector<Visual> visuals = visuals_from(text);
  ASSERT_EQ(visuals.size(), 1U);
  EXPECT_EQ(visuals[0].body, 1);
  EXPECT_EQ(visuals[0].link, "tool");
  // z of the tool is x of the arm: 2 + 3.
  EXPECT_LT((visuals[0].X_BV.translation() - Eigen::Vector3d(5, 0, 0)).norm(), 1e-12);
}

TEST(Visuals, MaterialsAreOwnOrNamed) {
  const std::string red = "<material name='red'><color rgba='1 0 0 0.5'/></material>";
  const std::vector<Visual> visuals = visuals_from(model_text(
      visual_text("<material name='late'/>") + visual_text("<material name='red'/>"),
      visual_text("<material name='late'><color rgba='0 1 0 1'/></material>") +
          visual_text("<material name='red'><color rgba='0 0 0.2 1'/></material>") +
          visual_text("<material name=''><color rgba='1 1 1 1'/></material>") + visual_text("<material/>"),
      red));
  ASSERT_EQ(visuals.size(), 6U);
  const auto color = [&](std::size_t i) { return visuals[i].color.value(); };
  EXPECT_THAT(color(0), ElementsAre(0, 255, 0, 255));  // defined by a later link
  EXPECT_THAT(color(1), ElementsAre(255, 0, 0, 128));  // by the robot
  EXPECT_THAT(color(2), ElementsAre(0, 255, 0, 255));
  EXPECT_THAT(color(3), ElementsAre(0, 0, 51, 255));  // what stands there counts, whatever the name
  EXPECT_THAT(color(4), ElementsAre(255, 255, 255, 255));
  EXPECT_FALSE(visuals[5].color);
}

TEST(Visuals, ATextureThatCannotBeReadCountsAsNothing) {
  const std::vector<Visual> visuals = visuals_from(model_text(
      visual_text("<material name='a'><color rgba='0 0 1 1'/><texture filename='none.png'/></material>"),
      visual_text("<material name='b'><texture filename='none.png'/></material>")));
  EXPECT_THAT(visuals.at(0).color.value(), ElementsAre(0, 0, 255, 255));
  EXPECT_FALSE(visuals.at(1).color);
}

TEST(Visuals, BadColoursAreToldWithLineAndRemedy) {
  const auto with = [](const std::string& color) {
    return refusal_from(model_text(visual_text("<material name='m'>\n" + color + "</material>"), ""));
  };
  EXPECT_THAT(with("<color rgba='1 0 0'/>"), AllOf(HasSubstr("model.urdf:5"), HasSubstr("four numbers"),
                                                   HasSubstr("rgba=\"0.5 0.5 0.5 1\"")));
  EXPECT_THAT(with("<color/>"), HasSubstr("four numbers"));
  EXPECT_THAT(with("<color rgba='255 0 0 1'/>"),
              AllOf(HasSubstr("between 0 and 1"), HasSubstr("divide it by 255")));
  EXPECT_THAT(with("<color rgba='-0.1 0 0 1'/>"), HasSubstr("between 0 and 1"));
  EXPECT_THAT(with("<color rgba='nan 0 0 1'/>"), HasSubstr("is not a number"));
  EXPECT_THAT(with("<color rgba='0,5 0 0 1'/>"), HasSubstr("decimal point"));
  EXPECT_EQ(with("<texture/>"), "");  // remarked by the doctor
  EXPECT_THAT(with("<color rgba='0 0 0 1'/><color rgba='0 0 0 1'/>"), HasSubstr("more than one <color>"));
  EXPECT_EQ(with("<color rgba=' +1 0 0\t1 '/>"), "");
}

TEST(Visuals, AMaterialThatNobodyDefinesIsNamed) {
  const std::string text =
      model_text(visual_text("<material name='gray'/>"), visual_text("<material name='grey'/>"),
                 "<material name='grey'><color rgba='0.5 0.5 0.5 1'/></material>");
  EXPECT_THAT(refusal_from(text),
              AllOf(HasSubstr("link 'base' names the material 'gray'"), HasSubstr("'grey'")));
  EXPECT_THAT(refusal_from(model_text(visual_text("<material name='x'/>"), "")), HasSubstr("write <color"));
  // The motion does not ask for colours.
  EXPECT_EQ(chain_from(text).nv, 1);
}

TEST(Visuals, MissingMeshesAreToldWhereTheyAreShownAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.write("m.urdf", model_text(visual_text("", "<mesh filename='none.stl'/>"),
                                                             visual_text("", "<box size='1 1 1'/>")));
  ModelOptions lenient;
  lenient.meshes = false;
  const Chain chain = read_chain(path, lenient);
  EXPECT_EQ(read_visuals(path, chain, lenient).size(), 1U);  // the box alone
  EXPECT_EQ(refusal_of(path), "");
  EXPECT_EQ(read_visuals(path, chain, {}, ShapesOf::collision).size(), 0U);
  try {
    read_visuals(path, chain, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("is not found"));
  }
}

TEST(Visuals, MeshesAreFoundAndScaled) {
  const TemporaryFolder folder;
  folder.write("meshes/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string path = folder.write(
      "m.urdf",
      model_text(visual_text("", "<mesh filename='meshes/a.obj' scale='0.001 -0.001 0.001'/>"), ""));
  const std::vector<Visual> visuals = visuals_in(path);
  ASSERT_EQ(visuals.size(), 1U);
  EXPECT_EQ(visuals[0].kind, VisualKind::mesh);
  EXPECT_EQ(visuals[0].mesh_scale, Eigen::Vector3d(0.001, -0.001, 0.001));
  EXPECT_EQ(read_mesh(visuals[0].mesh_file).triangles.size(), 3U);
}

TEST(Visuals, PublicRobotsHaveThemAll) {
  const std::string robots = public_robots_folder();
  if (robots.empty()) GTEST_SKIP() << kNoRobots;
  namespace fs = std::filesystem;
  ModelOptions options;
  options.packages["example-robot-data"] = fs::absolute(robots).lexically_normal().parent_path().string();
  const std::map<std::string, std::size_t> expected{
      {"panda_description/urdf/panda.urdf", 11},  // eight links, a hand, two fingers
      {"panda_description/urdf/panda_collision.urdf", 11},
      {"bolt_description/robots/bolt.urdf", 9},
      {"finger_edu_description/robots/finger_edu.urdf", 7},
      {"double_pendulum_description/urdf/double_pendulum.urdf", 3},
      {"double_pendulum_description/urdf/double_pendulum_continuous.urdf", 3},
      {"double_pendulum_description/urdf/double_pendulum_simple.urdf", 3},
      {"simple_humanoid_description/urdf/simple_humanoid.urdf", 0},  // these two have collision shapes alone
      {"simple_humanoid_description/urdf/simple_humanoid_classical.urdf", 0}};
  for (const auto& [name, count] : expected) {
    SCOPED_TRACE(name);
    const std::vector<Visual> visuals = visuals_in((fs::path(robots) / name).string(), options);
    EXPECT_EQ(visuals.size(), count);
    for (const Visual& visual : visuals) {
      if (visual.kind != VisualKind::mesh) continue;
      Box box;
      for (const auto& vertex : read_mesh(visual.mesh_file).vertices)
        box.add(Eigen::Vector3d(double(vertex.position[0]), double(vertex.position[1]),
                                double(vertex.position[2]))
                    .cwiseProduct(visual.mesh_scale));
      // No part of these robots is smaller than a finger or larger than a wall.
      EXPECT_GT(box.size().maxCoeff(), 0.01) << visual.mesh_file;
      EXPECT_LT(box.size().maxCoeff(), 1.2) << visual.mesh_file;
    }
  }
}

}  // namespace
}  // namespace chainreel
