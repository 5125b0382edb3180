// Bodies that are made for models without any, and the tints of those that have one grey.
#include "draw/robot/made_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <string>

#include "dynamics/kinematics.hpp"
#include "mesh/primitives.hpp"
#include "render/solid_bounds.hpp"
#include "scene/text/read_scene.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

std::string link_text(const std::string& name, double mass, const std::string& com) {
  return "<link name=\"" + name + "\"><inertial><origin xyz=\"" + com + "\"/><mass value=\"" + std::to_string(mass) +
         "\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>";
}
std::string joint_text(const std::string& parent, const std::string& child, const std::string& place, const std::string& axis = "0 1 0",
                       const std::string& type = "continuous") {
  return "<joint name=\"to_" + child + "\" type=\"" + type + "\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/><origin xyz=\"" + place + "\"/><axis xyz=\"" + axis + "\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>";
}

// Hips, a trunk, arms of one piece, legs with knees and feet.
std::string person() {
  std::string text = "<robot name=\"person\">" + link_text("hips", 20, "0 0 0.05") + link_text("trunk", 25, "0 0 0.2") +
                     link_text("chest", 12, "0 0 0") + joint_text("hips", "trunk", "0 0 0.18") + joint_text("trunk", "chest", "0 0 0.35", "0 0 1");
  for (const std::string side : {"l", "r"}) {
    const std::string y = side == "l" ? "0.2" : "-0.2", half = side == "l" ? "0.09" : "-0.09";
    text += link_text(side + "_arm", 4, "0 0 -0.5") + joint_text("chest", side + "_arm", "0 " + y + " 0") + link_text(side + "_thigh", 7, "0 0 -0.2") +
            joint_text("hips", side + "_thigh", "0 " + half + " 0") + link_text(side + "_shank", 4, "0 0 -0.2") +
            joint_text(side + "_thigh", side + "_shank", "0 0 -0.4") + link_text(side + "_foot", 1, "0.2 0 -0.08") +
            joint_text(side + "_shank", side + "_foot", "0 0 -0.4");
  }
  return text + "</robot>";
}

struct Extent {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(HUGE_VAL), upper = -lower;
};

// Of all shapes at q = 0, in W; of one body only where it is named.
Extent extent_of(const Chain& chain, const BodyShapes& shapes, const std::string& body = "") {
  Workspace ws(chain);
  const std::vector<double> q = zero_configuration(chain), qd(std::size_t(chain.nv), 0.0);
  compute_kinematics(chain, ws, q, qd);
  Extent all;
  for (const BodyShape& shape : shapes.shapes) {
    if (!body.empty() && chain.bodies[std::size_t(shape.body)].name != body) continue;
    for (const auto& vertex : shape.mesh->vertices) {
      const Eigen::Vector3d p =
          pose_of(ws, shape.body) * (shape.X_BM * Eigen::Vector3d(vertex.position[0], vertex.position[1], vertex.position[2]));
      all = {all.lower.cwiseMin(p), all.upper.cwiseMax(p)};
    }
  }
  return all;
}

class MadeBodies : public ::testing::Test {
 protected:
  Chain read(const std::string& text, bool is_floating = true) {
    ModelOptions options;
    options.floating_base = is_floating;
    return read_chain(folder_.write("model.urdf", text), options);
  }
  TemporaryFolder folder_;
};

TEST_F(MadeBodies, APersonHasHeadTrunkAndFeet) {
  const Chain chain = read(person());
  const BodyShapes shapes = made_bodies(chain);
  const Extent all = extent_of(chain, shapes), chest = extent_of(chain, shapes, "chest"), trunk = extent_of(chain, shapes, "trunk");
  const Extent foot = extent_of(chain, shapes, "l_foot"), arm = extent_of(chain, shapes, "l_arm");
  // The head is the chest's, which lies at 0.53 m, and above everything else.
  EXPECT_EQ(all.upper.z(), chest.upper.z());
  EXPECT_GT(chest.upper.z(), 0.53 + 0.25);
  // The trunk is between hips and shoulders in width, and wider than deep.
  const Eigen::Vector3d size = trunk.upper - trunk.lower;
  EXPECT_GT(size.y(), 0.18);
  EXPECT_LT(size.y(), 0.40);
  EXPECT_GT(size.y(), 1.3 * size.x());
  // A foot stands on its mass's height, and leads ahead and to a heel.
  constexpr double kCorner = 1e-3;  // m: no corner of a globe lies on its axes
  EXPECT_NEAR(foot.lower.z(), -0.88, kCorner);
  EXPECT_NEAR(foot.upper.x(), 0.2, kCorner);
  EXPECT_LT(foot.lower.x(), -0.05);
  EXPECT_LT(arm.upper.y() - arm.lower.y(), 0.25);
  // Left and right are one another's mirror.
  EXPECT_NEAR(all.lower.y(), -all.upper.y(), 1e-6);
  for (const BodyShape& shape : shapes.shapes) {
    EXPECT_EQ(MeshSurface(*shape.mesh).triangles.closed, shape.mesh->triangles.size() / 3);
    EXPECT_FALSE(shape.corners.empty());
  }
}

TEST_F(MadeBodies, ATrunkFixedToTheWorldHasTheSameLimbs) {
  const Chain fixed = read(person(), false), floating = read(person());
  const Extent a = extent_of(fixed, made_bodies(fixed)), b = extent_of(floating, made_bodies(floating));
  EXPECT_LT((a.lower - b.lower).norm() + (a.upper - b.upper).norm(), 1e-6);
}

TEST_F(MadeBodies, LimbsAreAsThickAsTheirMassInWater) {
  for (const auto& [mass, radius] : {std::pair{5.0, std::sqrt(5 / (1000 * std::numbers::pi * 0.5))}, {0.001, 0.08 * 0.5}, {1e4, 0.20 * 0.5}}) {
    const Chain chain = read("<robot name=\"rod\"><link name=\"base\"/>" + link_text("rod", mass, "0 0.5 0") + joint_text("base", "rod", "0 0 0") + "</robot>", false);
    const BodyShapes shapes = made_bodies(chain);
    ASSERT_EQ(shapes.shapes.size(), 2u);  // and its joint
    const MeshBounds bounds = bounds_of(*shapes.shapes[0].mesh);
    // No corner of the globe lies on its axes: 1 % inside.
    EXPECT_NEAR(bounds.upper[0], radius, 0.01 * radius);
    EXPECT_NEAR(bounds.upper[2], 0.25 + radius, 0.01 * radius);
  }
}

TEST_F(MadeBodies, TwoRobotsFarApartAreNotOneTrunk) {
  const Chain chain = read("<robot name=\"two\"><link name=\"base\"/>" + link_text("a", 1, "0 0 0.5") + link_text("b", 1, "0 0 0.5") +
                               joint_text("base", "a", "0 0 0") + joint_text("base", "b", "3 0 0", "1 0 0") + "</robot>",
                           false);
  for (const BodyShape& shape : made_bodies(chain).shapes) EXPECT_GT(shape.body, 0);
}

// An arm that turns about the vertical stands on the ground, on a plinth; about a level axis it hangs on nothing that is seen.
TEST_F(MadeBodies, WhatTurnsAboutTheVerticalStandsOnAPlinth) {
  const auto read_arm = [&](const std::string& axis) {
    ModelOptions options;
    options.gravity = {0, 0, -9.81};
    return read_chain(folder_.write("arm.urdf", "<robot name=\"arm\"><link name=\"base\"/>" + link_text("a", 3, "0 0 0.3") + link_text("b", 1, "0.2 0 0") + link_text("c", 1, "0.2 0 0") +
                                                    joint_text("base", "a", "0 0 0", axis) + joint_text("a", "b", "0 0 0.6") + joint_text("b", "c", "0.5 0 0") + "</robot>"),
                      options);
  };
  const auto on_world = [](const BodyShapes& shapes) { return std::ranges::count_if(shapes.shapes, [](const BodyShape& shape) { return shape.body == 0; }); };
  const Chain upright = read_arm("0 0 1"), level = read_arm("0 1 0");
  const BodyShapes shapes = made_bodies(upright);
  EXPECT_EQ(on_world(shapes), 1);
  EXPECT_NEAR(extent_of(upright, shapes).lower.z(), 0, 1e-6) << "on the ground";
  EXPECT_EQ(on_world(made_bodies(level)), 0);
}

TEST_F(MadeBodies, ChainsInNumbersHaveThemWhereTheirRodsAreNotAskedFor) {
  const Scene scene = read_scene(folder_.write("numbers.yaml", "model: {dh: [[0, 90deg, 0.6, 0], [0.5, 0, 0, 0], [0.4, 0, 0, 0]]}\n"));
  const Chain chain = read_chain(scene.model);
  const auto count = [&](LinkShapes links) {
    MeshShelf shelf;
    return shapes_for({links, MeshUp::rviz, true, {}}, scene.model, chain, {}, shelf)->shapes.size();
  };
  EXPECT_EQ(count(LinkShapes::automatic), made_bodies(chain).shapes.size());
  EXPECT_EQ(count(LinkShapes::visual), 3u) << "a rod a link";
}

TEST_F(MadeBodies, SlidersKeepTheirBars) {
  const Chain chain = read("<robot name=\"s\"><link name=\"base\"/>" + link_text("a", 1, "0 0 0.5") + link_text("b", 1, "0 0.5 0") +
                               joint_text("base", "a", "0 0 0", "0 0 1", "prismatic") + joint_text("a", "b", "0 0 0") + "</robot>",
                           false);
  EXPECT_TRUE(made_bodies(chain).shapes.empty());
}

TEST_F(MadeBodies, LinksOfOneGreyGetTwoTintsInTurn) {
  std::string text = "<robot name=\"g\"><material name=\"m\"><color rgba=\"0.5 0.5 0.5 1\"/></material><link name=\"base\"/>" +
                     link_text("a", 1, "0 0 0.5") + link_text("b", 1, "0 0 0.5") + link_text("c", 1, "0 0 0.5") + joint_text("base", "a", "0 0 0") +
                     joint_text("a", "b", "0 0 1", "1 0 0") + joint_text("b", "c", "0 0 1") + "</robot>";
  text = std::regex_replace(text, std::regex("</inertial>"),
                            "</inertial><visual><geometry><sphere radius=\"0.1\"/></geometry><material name=\"m\"/></visual>");
  const auto colors = [&](const std::string& model, LinkShapes links) {
    const std::string path = folder_.write("grey.urdf", model);
    MeshShelf shelf;
    const auto shapes = shapes_for({links, MeshUp::rviz, true, {}}, path, read_chain(path), {}, shelf);
    std::vector<Color> result;
    for (const BodyShape& shape : shapes->shapes) result.push_back(shape.color.value_or(Color{}));
    return result;
  };
  const auto tints = colors(text, LinkShapes::automatic);
  ASSERT_EQ(tints.size(), 3u);
  EXPECT_FALSE(tints[0] == tints[1]);
  EXPECT_TRUE(tints[0] == tints[2]);
  const Color grey{128, 128, 128, 1};
  EXPECT_EQ(colors(text, LinkShapes::visual), std::vector(3, grey)) << "what is asked for by name is as the file has it";
  // A robot in a colour keeps it.
  const Color blue = colors(std::regex_replace(text, std::regex("0.5 0.5 0.5 1"), "0 0 1 1"), LinkShapes::automatic).front();
  EXPECT_EQ(blue.b, 255);
  EXPECT_EQ(blue.r, 0);
}

TEST(RoundedBox, FillsItsEdgesAndIsClosed) {
  const TriangleMesh mesh = rounded_box_mesh({0.4, 0.6, 1}, 0.1);
  EXPECT_EQ(MeshSurface(mesh).triangles.closed, mesh.triangles.size() / 3);
  const MeshBounds bounds = bounds_of(mesh);
  const std::array<double, 3> half{0.2, 0.3, 0.5};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(bounds.upper[i], half[i], 0.01 * 0.1);
}

}  // namespace
}  // namespace chainreel
