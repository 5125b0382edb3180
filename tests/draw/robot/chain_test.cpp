#include <algorithm>

#include "draw/robot/chain.hpp"

#include <gmock/gmock.h>

#include "draw/chains.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "draw/shapes.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

const Rect kArea{0.045, 0.11, 1.73, 0.87};
constexpr double kRoundOff = 1e-12;  // of page coordinates, after sines and a matrix or two

// One chain at one pose, fitted to `fit_poses`.
struct Drawn {
  Chain chain;
  Skeleton skeleton;
  Camera camera;
  ChainLook look;
  Picture base, links;

  Drawn(Chain of, const std::vector<double>& q, std::vector<std::vector<double>> fit_poses = {})
      : chain(std::move(of)), skeleton(skeleton_of(chain)), camera(view_of(chain)) {
    fit_poses.push_back(q);
    Workspace ws(chain);
    const std::vector<double> qd(std::size_t(chain.nv), 0.0);
    for (const auto& pose : fit_poses) widen_rails(skeleton, chain, pose, 1e9);
    ChainFit fit(chain, skeleton, camera);
    for (const auto& pose : fit_poses) {
      compute_kinematics(chain, ws, pose, qd);
      fit.add_pose(ws, 1e9);
    }
    fit_to(camera, fit.box(), kArea, size::kFitMargin);
    look = look_of(skeleton, camera, light_theme());
    compute_kinematics(chain, ws, q, qd);
    const ChainDrawing drawing{chain, skeleton, camera, look};
    draw_base(base, drawing, -1);
    draw_rails(links, drawing, ws, -1);
    draw_links(links, drawing, ws, -1);
  }

  std::vector<Capsule> capsules() const {  // links have an outline, lines have none
    return test::all_of<Capsule>(links, [](const Capsule& c) { return c.paint.stroke_width > 0; });
  }
  std::vector<Ellipse> discs() const {
    return test::all_of<Ellipse>(links, [](const Ellipse& e) { return e.paint.stroke_width > 0; });
  }
  std::vector<Polygon> blocks() const {
    return test::all_of<Polygon>(links, [](const Polygon& p) { return p.paint.stroke_width > 0; });
  }
};

TEST(Chain, LinksRunFromJointToJointToGripper) {
  const double a = 0.3, b = -1.1;
  const Drawn rr(test::model("rr"), {a, b});
  const Point base = rr.camera.project({0, 0, 0});
  const Point elbow = rr.camera.project({std::cos(a), std::sin(a), 0});
  const Point tip = rr.camera.project({std::cos(a) + std::cos(a + b), std::sin(a) + std::sin(a + b), 0});
  const auto links = rr.capsules();
  ASSERT_EQ(links.size(), 2u);
  EXPECT_LT(test::distance(links[0].a, base), kRoundOff);
  EXPECT_LT(test::distance(links[0].b, elbow), kRoundOff);
  EXPECT_LT(test::distance(links[1].a, elbow), kRoundOff);
  EXPECT_LT(test::distance(links[1].b, tip), kRoundOff);
  EXPECT_EQ(links[0].paint.fill, light_theme().link[0]);
  EXPECT_EQ(links[1].paint.fill, light_theme().link[1]);

  // Its masses are points at the ends of the links: that of the first lies below the second joint.
  const auto discs = rr.discs();
  ASSERT_EQ(discs.size(), 4u);
  EXPECT_LT(test::distance(discs[0].center, elbow), kRoundOff);
  EXPECT_LT(test::distance(discs[1].center, base), kRoundOff);
  EXPECT_LT(test::distance(discs[2].center, tip), kRoundOff);
  EXPECT_LT(test::distance(discs[3].center, elbow), kRoundOff);
  EXPECT_EQ(discs[0].paint.fill, light_theme().link[0]);
  EXPECT_EQ(discs[2].paint.fill, light_theme().link[1]);
}

// Negative control of the test above: at another pose its claims do not hold.
// A coupler with a point beside its line is one rigid piece, not two bars that a pin holds; a point on its line makes no plate.
TEST(Chain, ABodyWithAPointBesideItsLineIsAPlate) {
  const auto plates = [](const Chain& chain) {
    const Drawn drawn(chain, {1, 0.3, -0.6});
    return test::all_of<Polygon>(drawn.links, [](const Polygon& p) { return p.count == 3 && p.paint.fill.a > 0 && p.paint.fill.a < 1; });
  };
  Chain chain = test::model("four_bar");
  const auto found = plates(chain);
  ASSERT_EQ(found.size(), 1u);
  const Drawn drawn(chain, {1, 0.3, -0.6});
  EXPECT_EQ(drawn.capsules().size(), 2u) << "crank and rocker";
  chain.frames[std::size_t(chain.end_effector)].X_BF.translation() = Eigen::Vector3d(0.5, 1e-4, 0);
  EXPECT_TRUE(plates(chain).empty());
}

TEST(Chain, OfAnotherPoseLiesElsewhere) {
  const Drawn rr(test::model("rr"), {0.3, -1.1}), other(test::model("rr"), {0.3, -1.0});
  EXPECT_GT(test::distance(rr.capsules()[1].b, other.capsules()[1].b), 1e-3);
}

TEST(Chain, LinksAreThinnerThanTheStyleOnlyWhereTheyAreShort) {
  Drawn near(test::model("rr"), {0, 0});
  const double shortest = near.camera.scale;  // 1 m
  EXPECT_NEAR(near.look.link_width, std::min(0.042, 0.09 * shortest), kRoundOff);
  near.camera.scale = 0.2;
  EXPECT_NEAR(look_of(near.skeleton, near.camera, light_theme()).link_width, 0.018, kRoundOff);
  near.camera.scale = 10;
  EXPECT_EQ(look_of(near.skeleton, near.camera, light_theme()).link_width, size::kLinkWidth);
}

TEST(Chain, IsPinnedToTheGroundBelowItsFirstJoint) {
  const Drawn rr(test::model("rr"), {0.3, -1.1});
  const Point base = rr.camera.project({0, 0, 0});
  const auto lines = test::all_of<Capsule>(
      rr.base, [](const Capsule& c) { return std::abs(2 * c.radius - size::kGroundLine) < 1e-12; });
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(test::distance(lines[0].a, lines[0].b), size::kGroundLength, kRoundOff);
  EXPECT_NEAR((lines[0].a.x + lines[0].b.x) / 2, base.x, kRoundOff);
  EXPECT_LT(lines[0].a.y, base.y);
  const auto hatch = test::all_of<Capsule>(
      rr.base, [](const Capsule& c) { return std::abs(2 * c.radius - size::kGroundHatch) < 1e-12; });
  EXPECT_EQ(hatch.size(), 8u);  // floor(0.12 / 0.014)
  for (const Capsule& stroke : hatch) {
    EXPECT_LE(std::max(stroke.a.y, stroke.b.y), lines[0].a.y + kRoundOff);
    EXPECT_NEAR(std::abs(stroke.a.x - stroke.b.x), std::abs(stroke.a.y - stroke.b.y), kRoundOff);
  }
}

TEST(Chain, GroundAndLinksLieInsideTheFittedArea) {
  const Drawn rr(test::model("rr"), {-2.0, 0.4}, {{0, 0}, {-1, -1}});
  for (const Capsule& c : test::all_of<Capsule>(rr.base)) {
    EXPECT_TRUE(test::is_inside(kArea, c.a, -c.radius) && test::is_inside(kArea, c.b, -c.radius));
  }
  for (const Capsule& c : rr.capsules()) {
    EXPECT_TRUE(test::is_inside(kArea, c.a, -c.radius) && test::is_inside(kArea, c.b, -c.radius));
  }
}

TEST(Chain, OfTwoSlidersHasAFixedRailAcrossAndACarriedRailUpright) {
  const Drawn pp(test::model("pp"), {0.5, 0.2}, {{0, -1}, {2, 1}});
  // The fixed rail spans x = 0 .. 2 at y = 0, with the same overhang at both ends.
  const auto fixed = test::all_of<Polygon>(pp.base);
  ASSERT_EQ(fixed.size(), 1u);
  const Rect rail = test::box_of(fixed[0]);
  EXPECT_NEAR(rail.x0, pp.camera.project({0, 0, 0}).x - rail_overhang(true), kRoundOff);
  EXPECT_NEAR(rail.x1, pp.camera.project({2, 0, 0}).x + rail_overhang(true), kRoundOff);
  EXPECT_NEAR(rail.height(), size::kRailGap, kRoundOff);
  EXPECT_NEAR(test::middle_of(rail).y, pp.camera.project({0, 0, 0}).y, kRoundOff);

  const auto moving = test::all_of<Polygon>(pp.links);
  ASSERT_EQ(moving.size(), 3u);  // carriage, the rail that it carries, slider
  const Rect carriage = test::box_of(moving[0]), upright = test::box_of(moving[1]),
             slider = test::box_of(moving[2]);
  EXPECT_LT(test::distance(test::middle_of(carriage), pp.camera.project({0.5, 0, 0})), kRoundOff);
  EXPECT_NEAR(test::middle_of(upright).x, pp.camera.project({0.5, 0, 0}).x, kRoundOff);
  EXPECT_NEAR(upright.y0, pp.camera.project({0, -1, 0}).y - rail_overhang(false), kRoundOff);
  EXPECT_NEAR(upright.y1, pp.camera.project({0, 1, 0}).y + rail_overhang(false), kRoundOff);
  EXPECT_LT(test::distance(test::middle_of(slider), pp.camera.project({0.5, 0.2, 0})), kRoundOff);
}

TEST(Chain, OfTwoSlidersShowsBothBlocksAlsoWhereTheyMeet) {
  const Drawn pp(test::model("pp"), {0, 0}, {{1, 1}});
  const auto blocks = pp.blocks();
  ASSERT_EQ(blocks.size(), 2u);
  const Rect carriage = test::box_of(blocks[0]), slider = test::box_of(blocks[1]);
  // The carriage shows on both sides of the upright rail, the slider above and below the carriage.
  const double shown = 0.02;  // of H: 7 px at the smallest size
  EXPECT_GT(slider.x0 - carriage.x0, shown);
  EXPECT_GT(carriage.x1 - slider.x1, shown);
  EXPECT_GT(slider.y1, carriage.y1);
  EXPECT_LT(slider.y0, carriage.y0);
}

TEST(Chain, CarriedRailsReachTheirCarriageAlsoWhereTheMotionDoesNot) {
  const Drawn pp(test::model("pp"), {0.1, 0.5}, {{0.4, 0.2}});
  const auto shapes = test::all_of<Polygon>(pp.links);
  const Rect carriage = test::box_of(shapes.at(0)), rail = test::box_of(shapes.at(1));
  EXPECT_LT(rail.y0, carriage.y0);
  EXPECT_GT(rail.y1, pp.camera.project({0, 0.5, 0}).y);
}

TEST(Chain, ALeafThatHoldsTheEndEffectorInItsJointReachesToItsCentreOfMass) {
  Chain chain = test::model("rr");
  chain.frames.at(std::size_t(chain.end_effector)).X_BF = Eigen::Isometry3d::Identity();
  const Drawn rr(chain, {0, 0});
  ASSERT_EQ(rr.capsules().size(), 2u);
  EXPECT_LT(test::distance(rr.capsules()[1].b, rr.camera.project({2, 0, 0})), kRoundOff);
}

TEST(Chain, RailsPassOverValuesOfARunThatDiverged) {
  const Chain chain = test::model("pp");
  Skeleton skeleton = skeleton_of(chain);
  widen_rails(skeleton, chain, std::vector<double>{1, 2}, 100);
  widen_rails(skeleton, chain, std::vector<double>{1e30, std::nan("")}, 100);
  EXPECT_EQ(skeleton.rails.at(0).upper, 1);
  EXPECT_EQ(skeleton.rails.at(1).upper, 2);
}

TEST(Chain, InSpaceIsDrawnFromFarToNear) {
  // Two links out of the page plane of the camera: the one that points away is drawn first.
  Chain chain = test::model("rr");
  chain.planar.reset();
  const Drawn away(chain, {2.2, 0}), toward(chain, {-0.9, 0});
  const auto first_fill = [](const Drawn& drawn) { return drawn.capsules().front().paint.fill; };
  EXPECT_EQ(first_fill(away), light_theme().link[1]);    // its far end is the tip
  EXPECT_EQ(first_fill(toward), light_theme().link[0]);  // its far end is the base
}

TEST(Chain, HatchesLinksWhoseColourRepeats) {
  Chain chain = test::two_links(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), {0, -9.81, 0});
  const auto extend = [&] {
    Body body = chain.bodies.back();
    body.parent = int(chain.bodies.size()) - 1;
    body.joint.q_index = body.joint.v_index = chain.nq++;
    ++chain.nv;
    chain.frames.back().body = int(chain.bodies.size());
    chain.bodies.push_back(body);
    chain.planar = planar_form_of(chain, chain.why_algebra);
  };
  const auto strokes = [&] {
    const Drawn drawn(chain, std::vector<double>(std::size_t(chain.nq), 0.1));
    return test::all_of<Capsule>(drawn.links, [](const Capsule& c) { return c.paint.stroke_width == 0; })
        .size();
  };
  extend();
  extend();
  EXPECT_EQ(strokes(), 0u);  // four links, four colours
  extend();
  EXPECT_GT(strokes(), 3u);
}

}  // namespace
}  // namespace chainreel
