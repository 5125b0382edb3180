// Robots in space: the eye, the model's shapes, the ground.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "draw/chains.hpp"
#include "draw/figures/poses.hpp"
#include "draw/film/film.hpp"
#include "draw/layers/ground_plane.hpp"
#include "draw/robot/body_shapes.hpp"
#include "draw/robot/view.hpp"
#include "draw/shapes.hpp"
#include "dynamics/kinematics.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kSpaceRoundOff = 1e-12;  // lengths of a metre after some dozens of operations

// Two links that turn about z and about x, with a box, a cylinder and a sphere to be seen; stands on z = 0.
const char* const kTwoAxes = R"(<?xml version="1.0"?>
<robot name="two_axes">
  <material name="blue"><color rgba="0 0 1 1"/></material>
  <link name="base"><visual><origin xyz="0 0 0.1"/><geometry><box size="0.4 0.3 0.2"/></geometry></visual></link>
  <link name="column">
    <inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <visual><origin xyz="0 0 0.25"/><geometry><cylinder radius="0.05" length="0.5"/></geometry>
      <material name="blue"/></visual>
  </link>
  <link name="arm">
    <inertial><origin xyz="0 0.5 0"/><mass value="1"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <visual><origin xyz="0 0.5 0"/><geometry><sphere radius="0.1"/></geometry></visual>
  </link>
  <link name="gripper"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="column"/><origin xyz="0 0 0.2"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="lift" type="continuous"><parent link="column"/><child link="arm"/><origin xyz="0 0 0.5"/>
    <axis xyz="1 0 0"/></joint>
  <joint name="tip" type="fixed"><parent link="arm"/><child link="gripper"/><origin xyz="0 0.6 0"/></joint>
</robot>
)";

class Space : public ::testing::Test {
 protected:
  Space() : path(folder.write("two_axes.urdf", kTwoAxes)), chain(read_chain(path)) {}

  std::shared_ptr<const BodyShapes> shapes(LinkShapes links = LinkShapes::visual) {
    MeshShelf shelf;
    return shapes_for({links, MeshUp::rviz, true, {path}}, path, chain, {}, shelf);
  }
  Scene scene() const {
    Scene scene;
    scene.title = "";
    scene.model = path;
    scene.duration = 1;
    scene.draw = {"chain", "ground"};
    return scene;
  }
  // The film's page; the scene must live as long.
  Film film(const Scene& scene, const BodyShapes* shapes) {
    return Film(scene, {{scene, chain, run, nullptr, shapes}}, run.t, fonts());
  }

  TemporaryFolder folder;
  std::string path;
  Chain chain;
  Trajectory run = test::run_of([](double t) { return std::vector<double>{0.4 * t, 0.3 * std::sin(t)}; }, 60);
};

Rect extent_of(const Solids& solids) {
  Rect all{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Solid& part : solids.parts)
    for (const TriangleMesh::Vertex& vertex : part.mesh->vertices) {
      std::array<double, 3> view{};
      double w = 1;
      for (std::size_t r = 0; r < 3; ++r) {
        view[r] = part.to_view[4 * r + 3];
        for (std::size_t c = 0; c < 3; ++c) view[r] += part.to_view[4 * r + c] * vertex.position[c];
        w -= solids.nearing[r] * view[r];
      }
      const Point at = solids.origin + solids.scale / w * Point{view[0], view[1]};
      all = {std::min(all.x0, at.x), std::min(all.y0, at.y), std::max(all.x1, at.x), std::max(all.y1, at.y)};
    }
  const double around = solids.outline_width;
  return {all.x0 - around, all.y0 - around, all.x1 + around, all.y1 + around};
}

TEST_F(Space, ShapesStandWhereTheirBodiesDo) {
  const auto all = shapes();
  ASSERT_EQ(all->shapes.size(), 3u);
  Workspace ws(chain);
  const std::vector<double> q{0.7, -0.4}, qd{0, 0};
  compute_kinematics(chain, ws, q, qd);
  Camera camera = view_of(chain);
  camera.focus = {0.1, 0.2, 0.3};
  Solids solids = solids_seen_by(camera);
  add_bodies(solids, *all, ws, camera);
  // The sphere's centre: 0.5 m along the arm, which turns by q1 about z and q2 about x at the column's top.
  const Vector3d center(-0.5 * std::cos(q[1]) * std::sin(q[0]), 0.5 * std::cos(q[1]) * std::cos(q[0]),
                        0.7 + 0.5 * std::sin(q[1]));
  const auto& m = solids.parts[2].to_view;
  EXPECT_NEAR(m[3], camera.right.dot(center - camera.focus), kSpaceRoundOff);
  EXPECT_NEAR(m[7], camera.up.dot(center - camera.focus), kSpaceRoundOff);
  EXPECT_NEAR(m[11], camera.toward_viewer.dot(center - camera.focus), kSpaceRoundOff);
  EXPECT_EQ(*solids.parts[1].color, color_of(0x0000FF));
  EXPECT_FALSE(solids.parts[0].color);
}

TEST_F(Space, PointsOfShapesProjectAsTheCameraProjectsThem) {
  const auto all = shapes();
  const Scene plain = scene();
  const Film made = film(plain, all.get());
  const Camera& camera = made.camera();
  ASSERT_TRUE(camera.has_eye());
  const Picture picture = made.frame(20);
  const Solids solids = test::all_of<Solids>(picture).at(0);
  Workspace ws(chain);
  compute_kinematics(chain, ws, run.q_at(20), run.qd_at(20));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& m = solids.parts[i].to_view;
    const double grown = solids.scale / (1 - m[3] * solids.nearing[0] - m[7] * solids.nearing[1] - m[11] * solids.nearing[2]);
    const Point at = solids.origin + grown * Point{m[3], m[7]};
    const Vector3d place = pose_of(ws, all->shapes[i].body) * all->shapes[i].X_BM.translation();
    EXPECT_NEAR(at.x, camera.project(place).x, kSpaceRoundOff);
    EXPECT_NEAR(at.y, camera.project(place).y, kSpaceRoundOff);
  }
}

TEST_F(Space, TheWholeMotionIsInThePicture) {
  const auto all = shapes();
  const Scene plain = scene();
  const Film made = film(plain, all.get());
  const Rect& area = made.scene_area();
  for (int k = 0; k < made.frame_count(); k += 7) {
    const Rect seen = extent_of(test::all_of<Solids>(made.frame(k)).at(0));
    EXPECT_GE(seen.x0, area.x0);
    EXPECT_GE(seen.y0, area.y0);
    EXPECT_LE(seen.x1, area.x1);
    EXPECT_LE(seen.y1, area.y1);
    // And fills it: a camera far away would pass the above.
    EXPECT_GT(seen.height(), 0.5 * area.height());
  }
}

TEST_F(Space, ThirtyDegreesHoldTheScene) {
  const Scene plain = scene();
  const Film made = film(plain, nullptr);
  const double height = made.scene_area().height() / made.camera().scale;
  // The last of six passes changes the distance by less than a thousandth.
  EXPECT_NEAR(2 * std::atan(height / 2 / made.camera().distance()), 30 * M_PI / 180, 0.001);
}

// Verticals have no vanishing point; seen from high above they do, since the page would be stretched.
TEST_F(Space, WhatStandsUprightIsDrawnUpright) {
  Scene plain = scene();
  const auto lean = [&](const Scene& asked) {
    const Film made = film(asked, nullptr);
    const Camera& camera = made.camera();
    EXPECT_TRUE(camera.has_eye());
    const Point low = camera.project(camera.focus + Vector3d(0.3, 0.3, -0.2)), high = camera.project(camera.focus + Vector3d(0.3, 0.3, 0.3));
    EXPECT_GT(high.y, low.y);
    return std::abs(high.x - low.x);
  };
  EXPECT_LT(lean(plain), kSpaceRoundOff);
  plain.camera.elevation = 60 * M_PI / 180;
  EXPECT_GT(lean(plain), 100 * kSpaceRoundOff);
}

// What is drawn before something else is what the ray meets first, and the eye is where all rays come from.
TEST_F(Space, RaysMeetInTheEye) {
  const Scene plain = scene();
  const Film made = film(plain, nullptr);
  const Camera& camera = made.camera();
  const Vector3d eye = camera.focus + camera.distance() * camera.toward_viewer;
  for (const Vector3d& place : {Vector3d(0.3, -0.2, 0.4), Vector3d(-0.2, 0.1, 0.9), Vector3d(0, 0.4, 0)}) {
    const Point near = camera.project(place + 0.3 * (eye - place)), far = camera.project(place);
    EXPECT_NEAR(near.x, far.x, kSpaceRoundOff);
    EXPECT_NEAR(near.y, far.y, kSpaceRoundOff);
  }
}

TEST_F(Space, AnEyeFarAwaySeesParallelRays) {
  Scene far = scene(), parallel = scene();
  far.camera.distance = 1e5;
  parallel.camera.distance = std::numeric_limits<double>::infinity();
  const Film one = film(far, nullptr), other = film(parallel, nullptr);
  EXPECT_FALSE(other.camera().has_eye());
  for (const Vector3d& place : {Vector3d(0, 0, 0), Vector3d(0.3, -0.4, 0.9)}) {
    // A metre of depth changes the scale by 1e-5.
    EXPECT_NEAR(one.camera().project(place).x, other.camera().project(place).x, 2e-5);
    EXPECT_NEAR(one.camera().project(place).y, other.camera().project(place).y, 2e-5);
  }
  Scene near = scene();
  near.camera.distance = 2;
  EXPECT_DOUBLE_EQ(film(near, nullptr).camera().distance(), 2);
}

TEST_F(Space, AnEyeAmongTheBodiesIsAnError) {
  Scene inside = scene();
  inside.camera.distance = 0.1;
  try {
    film(inside, nullptr);
    FAIL() << "a camera 0.1 m before the middle of the robot was accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("puts the eye among the bodies: "));
  }
}

TEST_F(Space, FitSaysWhatThePageShows) {
  Scene told = scene();
  told.camera.distance = std::numeric_limits<double>::infinity();
  told.camera.azimuth = 0;
  told.camera.elevation = 0;
  told.camera.fit = {-0.5, 0, 0.5, 1};  // x and z of the world, m
  const Film made = film(told, nullptr);
  const Rect& area = made.scene_area();
  const Point corner = made.camera().project({-0.5, 3, 0}), top = made.camera().project({0, -2, 1});
  EXPECT_NEAR(corner.y, area.y0, kSpaceRoundOff);
  EXPECT_NEAR(top.y, area.y1, kSpaceRoundOff);
  EXPECT_NEAR(top.x, (area.x0 + area.x1) / 2, kSpaceRoundOff);
}

TEST(View, TurnsByAzimuthAndElevation) {
  Chain chain = test::model("rr");
  CameraEntry entry;
  entry.azimuth = 90 * M_PI / 180;
  // A quarter turn about the plane's up: what came towards the viewer now points left.
  const Camera side = view_of(chain, entry);
  EXPECT_LT((side.toward_viewer - Vector3d::UnitX()).norm(), kSpaceRoundOff);
  EXPECT_LT((side.right + Vector3d::UnitZ()).norm(), kSpaceRoundOff);
  EXPECT_TRUE(is_oblique(chain, entry));
  EXPECT_FALSE(is_oblique(chain, {}));
  entry = {};
  entry.elevation = 90 * M_PI / 180;
  const Camera above = view_of(chain, entry);
  EXPECT_LT((above.toward_viewer - Vector3d::UnitY()).norm(), kSpaceRoundOff);
  EXPECT_LT((above.up + Vector3d::UnitZ()).norm(), kSpaceRoundOff);
}

TEST(Camera, DerivesItsProjection) {
  Camera camera = view_of(test::model("rr"), {0.5, 0.3, {}, {}});
  camera.focus = {0.2, 0.1, -0.3};
  camera.nearing = {0.1, 0.3, 0.3};
  camera.scale = 0.7;
  const Vector3d x(0.6, -0.2, 0.5), v(0.3, 0.8, -0.6);
  constexpr double h = 1e-6;  // of central differences: errors of h^2
  const Point difference = (1 / (2 * h)) * (camera.project(x + h * v) - camera.project(x - h * v));
  EXPECT_NEAR(camera.project_vector(v, x).x, difference.x, 1e-9);
  EXPECT_NEAR(camera.project_vector(v, x).y, difference.y, 1e-9);
  EXPECT_TRUE(std::isnan(camera.project(camera.focus + 10 * camera.nearing).x));  // behind the eye
}

TEST_F(Space, LinksSayWhatIsDrawn) {
  EXPECT_EQ(shapes(LinkShapes::plain), nullptr);
  EXPECT_NE(shapes(LinkShapes::automatic), nullptr);
  MeshShelf shelf;
  // Planar chains seen along their normal keep their bars.
  EXPECT_EQ(shapes_for({LinkShapes::automatic, MeshUp::rviz, false, {}}, path, chain, {}, shelf), nullptr);
  const std::string bare_path =
      folder.write("bare.urdf", std::regex_replace(kTwoAxes, std::regex("<visual>[^]*?</visual>"), ""));
  const Chain bare = read_chain(bare_path);
  // What shows nothing gets bodies where it is seen obliquely.
  EXPECT_NE(shapes_for({LinkShapes::automatic, MeshUp::rviz, true, {}}, bare_path, bare, {}, shelf), nullptr);
  EXPECT_EQ(shapes_for({LinkShapes::automatic, MeshUp::rviz, false, {}}, bare_path, bare, {}, shelf), nullptr);
  try {
    shapes_for({LinkShapes::visual, MeshUp::rviz, true, {"s.yaml", 3, 8}}, bare_path, bare, {}, shelf);
    FAIL() << "a model without shapes was drawn by them";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no <visual>: take auto or plain"));
    EXPECT_EQ(error.problems().front().place.line, 3);
  }
  const Scene plain = scene();
  EXPECT_TRUE(test::all_of<Solids>(film(plain, nullptr).frame(0)).empty());
  EXPECT_FALSE(test::all_of<Capsule>(film(plain, nullptr).frame(0)).empty());
  const auto all = shapes();
  EXPECT_TRUE(test::all_of<Capsule>(film(plain, all.get()).frame(0)).empty());
}

// Lines of the ground are the only trails that stand still.
TEST_F(Space, StandsOnAGroundThatItTouches) {
  const auto all = shapes();
  const auto lines_of = [&](const Scene& scene) { return test::all_of<Trail>(film(scene, all.get()).static_layer()); };
  const std::vector<Trail> lines = lines_of(scene());
  EXPECT_GT(lines.size(), 8u);
  // They end in nothing, and are nowhere cut off.
  for (const Trail& line : lines) {
    EXPECT_NEAR(line.points.front().alpha, 0, 1e-6);
    EXPECT_NEAR(line.points.back().alpha, 0, 1e-6);
  }
  Scene bare = scene();
  bare.draw = {"chain"};
  EXPECT_TRUE(lines_of(bare).empty());
  Scene below = scene();
  below.camera.elevation = -0.3;
  EXPECT_TRUE(lines_of(below).empty());
}

MotionBox box_of(const Vector3d& up, std::initializer_list<Vector3d> places) {
  MotionBox box(up);
  for (const Vector3d& place : places) box.add(place);
  return box;
}

TEST(GroundPlane, NeedsARobotThatComesDownToIt) {
  Camera camera;  // from above
  const Vector3d up = Vector3d::UnitZ();
  const auto ground = ground_under(box_of(up, {{-1, 0, 0.001}, {1, 2, 1}}), camera);
  ASSERT_TRUE(ground);
  EXPECT_EQ(ground->middle, Vector3d(0, 1, 0));
  EXPECT_GT(ground->radius, 1.4);                                             // beyond the corners
  EXPECT_FALSE(ground_under(box_of(up, {{-1, 0, -1}, {1, 2, 1}}), camera));   // through the plane
  EXPECT_FALSE(ground_under(box_of(up, {{-1, 0, 0.5}, {1, 2, 1}}), camera));  // hovers
  EXPECT_FALSE(ground_under(box_of(up, {}), camera));
  camera.toward_viewer = -up;
  EXPECT_FALSE(ground_under(box_of(up, {{-1, 0, 0}, {1, 2, 1}}), camera));  // seen from below
}

// Negative control: what is tied to the world has its ground at the origin alone.
TEST(GroundPlane, OfPosesIsBelowWhatNothingTiesToTheWorld) {
  Chain chain;
  CameraEntry wanted;
  wanted.elevation = 0.3;
  const MotionBox poses = box_of(Vector3d::UnitZ(), {{-1, 0, -0.3}, {1, 2, 1}});
  EXPECT_FALSE(ground_of_poses(chain, poses, Camera(), wanted));
  chain.has_floating = true;
  const auto ground = ground_of_poses(chain, poses, Camera(), wanted);
  ASSERT_TRUE(ground);
  EXPECT_LT((ground->middle - Vector3d(0, 1, -0.3)).norm(), kSpaceRoundOff);
  EXPECT_EQ(ground->height, -0.3);
}

// The world turned with all that is in it, the ground turns along.
TEST(GroundPlane, LiesAcrossGravity) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.4, Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();
  Camera camera;
  camera.toward_viewer = R * Vector3d::UnitZ();
  const auto straight = ground_under(box_of(Vector3d::UnitZ(), {{-1, 0, 0}, {1, 2, 1}}), Camera());
  const auto turned = ground_under(
      box_of(R * Vector3d::UnitZ(), {R * Vector3d(-1, 0, 0), R * Vector3d(1, 0, 0), R * Vector3d(1, 2, 1)}),
      camera);
  ASSERT_TRUE(straight && turned);
  // Directions on the ground are chosen anew, so that the box may be wider, but no more than by its diagonal.
  EXPECT_NEAR(turned->middle.dot(turned->up), 0, kSpaceRoundOff);
  EXPECT_LT(turned->radius, 1.5 * straight->radius);
  EXPECT_GT(turned->radius, straight->radius / 1.5);
}

TEST_F(Space, ThrowsAFlatShadow) {
  const auto all = shapes();
  Scene shaded = scene();
  shaded.draw = {"chain", "shadow"};
  const Picture picture = film(shaded, all.get()).frame(30);
  const auto solids = test::all_of<Solids>(picture);
  ASSERT_GE(solids.size(), 2u);
  ASSERT_TRUE(solids[0].is_shadow);
  EXPECT_GT(solids[0].outline_width, 0);  // soft
  const Solids& bodies = solids.back();
  EXPECT_FALSE(bodies.is_shadow);
  // The shadow of the sphere has its centre right below it: the two differ by the height times the page's up
  // alone.
  Workspace ws(chain);
  compute_kinematics(chain, ws, run.q_at(30), run.qd_at(30));
  const Vector3d center = pose_of(ws, 2) * all->shapes[2].X_BM.translation();
  const double rise = bodies.parts[2].to_view[7] - solids[0].parts[2].to_view[7];
  EXPECT_NEAR(rise, center.z() * std::cos(20 * M_PI / 180), kSpaceRoundOff);
  EXPECT_NEAR(bodies.parts[2].to_view[3], solids[0].parts[2].to_view[3], kSpaceRoundOff);
}

// A second shadow lies below what is near to the ground, the darker the nearer, and below nothing else.
TEST_F(Space, WhatTouchesTheGroundHasADarkerShadowBelow) {
  const auto all = shapes();
  Scene shaded = scene();
  shaded.draw = {"chain", "shadow"};
  const Picture picture = film(shaded, all.get()).frame(30);
  Workspace ws(chain);
  compute_kinematics(chain, ws, run.q_at(30), run.qd_at(30));
  std::map<const TriangleMesh*, double> height;  // of what is lowest of a shape
  for (const BodyShape& shape : all->shapes) {
    double lowest = HUGE_VAL;
    for (const Vector3d& corner : shape.corners) lowest = std::min(lowest, std::abs((pose_of(ws, shape.body) * corner).z()));
    height[shape.mesh.get()] = lowest;
  }
  double highest_with = 0, lowest_without = HUGE_VAL;
  std::set<const TriangleMesh*> with;
  const auto shadows = test::all_of<Solids>(picture, [](const Solids& solids) { return solids.is_shadow; });
  for (std::size_t i = 1; i < shadows.size(); ++i) {
    ASSERT_EQ(shadows[i].parts.size(), 1u);
    with.insert(shadows[i].parts[0].mesh.get());
  }
  for (const auto& [mesh, lowest] : height)
    (with.contains(mesh) ? highest_with : lowest_without) =
        with.contains(mesh) ? std::max(highest_with, lowest) : std::min(lowest_without, lowest);
  EXPECT_FALSE(with.empty());
  EXPECT_LT(with.size(), height.size());
  EXPECT_LT(highest_with, lowest_without);
}

TEST_F(Space, ThrowsNoShadowWhereThereIsNoGround) {
  const auto all = shapes();
  Scene shaded = scene();
  shaded.draw = {"chain", "shadow"};
  shaded.camera.elevation = -0.3;  // from below
  EXPECT_EQ(test::all_of<Solids>(film(shaded, all.get()).frame(30)).size(), 1u);
}

// An arrow along a link points the way the link is drawn, however strong the perspective.
TEST_F(Space, DirectionsAreSeenAsTheyAreAtTheirPlaces) {
  Camera camera = view_of(chain);
  camera.focus = {0, 0, 0.4};
  camera.nearing = Vector3d(0.7, 0.2, -0.1);
  const Vector3d place(0.5, -0.4, 0.2), direction(0.3, 0.2, -0.7);
  const Camera seen = camera.seen_at(place);
  const Point page = camera.project_vector(direction, place);
  const Point drawn{seen.right.dot(direction), seen.up.dot(direction)};
  EXPECT_NEAR(page.x * drawn.y - page.y * drawn.x, 0, kSpaceRoundOff);
  EXPECT_GT(page.x * drawn.x + page.y * drawn.y, 0);
  // Without the ray's own direction it would be off by degrees.
  const Point naive{camera.right.dot(direction), camera.up.dot(direction)};
  EXPECT_GT(std::abs(page.x * naive.y - page.y * naive.x), 0.01);
}

TEST_F(Space, PosesOfAModelAreSeenTheSameWay) {
  PoseFigureOptions options;
  options.shapes = shapes();
  const Picture picture = draw_pose_figure(chain, {{0, 0}, {0.5, 0.5}}, options, fonts());
  const auto solids = test::all_of<Solids>(picture, [](const Solids& one) { return !one.is_shadow; });
  ASSERT_EQ(solids.size(), 2u);
  EXPECT_LT(test::all_of<Solids>(picture).size(), 7u);  // two shadows a pose, and the contact of its foot
  EXPECT_LT(solids[0].opacity, 0.5);  // an onion skin
  EXPECT_EQ(solids[1].opacity, 1);
  EXPECT_NE(solids[1].nearing, (std::array<double, 3>{}));
}

// A left hand is a right hand with a negative scale; stretched, normals stay across the surface.
TEST_F(Space, MirroredShapesHaveTheirOutsideOutside) {
  folder.write("wedge.obj",
               "v 0 0 0\nv 1 0 -1\nv 0 1 0\nvn 0.6 0 0.8\nvn 0.8 0 0.6\nvn 0.7071068 0 0.7071068\nf 1//1 2//2 3//3\n");
  for (const auto& [scale, across, normal] :
       {std::tuple{"1 1 1", Vector3d(1, 0, 1), Vector3d(0.6, 0, 0.8)},
        {"-1 1 1", Vector3d(-1, 0, 1), Vector3d(-0.6, 0, 0.8)},
        {"-2 1 3", Vector3d(-3, 0, 2), Vector3d(-1.8, 0, 1.6)},
        {"-1 -1 1", Vector3d(-1, 0, 1), Vector3d(-0.6, 0, 0.8)},
        {"1 1 -1", Vector3d(1, 0, -1), Vector3d(0.6, 0, -0.8)}}) {
    std::string text = kTwoAxes;
    const std::string sphere = "<sphere radius=\"0.1\"/>";
    text.replace(text.find(sphere), sphere.size(), std::string("<mesh filename=\"wedge.obj\" scale=\"") + scale + "\"/>");
    const std::string model = folder.write("wedge.urdf", text);
    MeshShelf shelf;
    const auto all = shapes_for({LinkShapes::visual, MeshUp::rviz, true, {}}, model, read_chain(model), {}, shelf);
    const TriangleMesh& mesh = *all->shapes.at(2).mesh;
    ASSERT_EQ(mesh.triangles.size(), 3u);
    const auto corner = [&](std::size_t i) {
      const auto& p = mesh.vertices[mesh.triangles[i]].position;
      return Vector3d(p[0], p[1], p[2]);
    };
    const Vector3d turned = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    EXPECT_LT((turned.normalized() - across.normalized()).norm(), 1e-6) << scale;
    for (const auto& vertex : mesh.vertices) {
      if (Vector3d(vertex.position[0], vertex.position[1], vertex.position[2]).norm() > 0) continue;
      const Vector3d n(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
      EXPECT_LT((n - normal.normalized()).norm(), 1e-6) << scale;
    }
  }
}

TEST_F(Space, MeshesThatCannotBeReadAreNamedWithTheirLine) {
  folder.write("broken.stl", "no triangles here");
  std::string text = kTwoAxes;
  const std::string sphere = "<sphere radius=\"0.1\"/>";
  text.replace(text.find(sphere), sphere.size(), "<mesh filename=\"broken.stl\"/>");
  const std::string model = folder.write("broken.urdf", text);
  MeshShelf shelf;
  try {
    shapes_for({LinkShapes::visual, MeshUp::rviz, true, {}}, model, read_chain(model), {}, shelf);
    FAIL() << "a broken mesh was drawn";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("link 'arm'"));
    EXPECT_EQ(error.problems().front().place.line, 13);
  }
}

}  // namespace
}  // namespace chainreel
