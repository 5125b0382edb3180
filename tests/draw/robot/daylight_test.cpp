// Which bodies stand in one another's shade.
#include "draw/robot/daylight.hpp"

#include <gtest/gtest.h>

#include "mesh/primitives.hpp"

namespace chainreel {
namespace {

// Two boxes: the second turns about z, half a metre above the first, and hides its top.
Chain two_bodies(JointKind kind) {
  Chain chain;
  for (int b = 1; b <= 2; ++b) {
    Body body;
    body.parent = b - 1;
    body.joint.kind = b == 1 ? JointKind::revolute : kind;
    if (b == 2) body.joint.X_PJ.translation() = Eigen::Vector3d(0, 0, 0.5);
    chain.bodies.push_back(body);
  }
  return chain;
}

BodyShapes boxes_on(int one, int other) {
  BodyShapes shapes;
  for (const int body : {one, other}) {
    BodyShape shape;
    shape.body = body;
    const double side = body == one ? 1 : 3;
    shape.mesh = std::make_shared<const TriangleMesh>(box_mesh({side, side, 0.4}));
    shapes.shapes.push_back(shape);
  }
  return shapes;
}

// Of the first shape's vertices on top.
int mean_on_top(const BodyShapes& shapes) {
  const BodyShape& shape = shapes.shapes.front();
  const TriangleMesh& mesh = shape.lit ? *shape.lit : *shape.mesh;
  int sum = 0, count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (mesh.vertices[v].normal[2] > 0.9F) sum += (*shape.openness)[v], ++count;
  return sum / count;
}

TEST(Daylight, ANeighbourOnAJointTakesItAway) {
  BodyShapes shapes = boxes_on(1, 2);
  put_in_daylight(shapes, two_bodies(JointKind::revolute));
  EXPECT_LT(mean_on_top(shapes), 128);
  for (const BodyShape& shape : shapes.shapes) EXPECT_EQ(shape.openness->size(), (shape.lit ? shape.lit : shape.mesh)->vertices.size());
}

TEST(Daylight, WhatFloatsIsNoNeighbour) {
  BodyShapes shapes = boxes_on(1, 2);
  put_in_daylight(shapes, two_bodies(JointKind::floating));
  EXPECT_GT(mean_on_top(shapes), 240);
}

TEST(Daylight, BodiesWithoutShapesAreSkipped) {
  // The first box is the world's; the body between has no shape.
  BodyShapes shapes = boxes_on(0, 2);
  put_in_daylight(shapes, two_bodies(JointKind::revolute));
  EXPECT_LT(mean_on_top(shapes), 128);
}

TEST(Daylight, NothingIsToBeDoneWithoutShapes) {
  BodyShapes shapes;
  put_in_daylight(shapes, two_bodies(JointKind::revolute));
  EXPECT_TRUE(shapes.shapes.empty());
}

}  // namespace
}  // namespace chainreel
