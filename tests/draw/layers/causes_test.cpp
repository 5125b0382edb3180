// What drives and ties a robot is drawn: springs, targets, constraints, gravity, limits and angles, each where the physics
// says.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/cause.hpp"
#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/layers/vectors.hpp"
#include "draw/page/word_plan.hpp"
#include "draw/shapes.hpp"
#include "draw/robot/made_bodies.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/rank_loss.hpp"
#include "sim/torques_along.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;
using test::Cause;
using test::has_words;
using test::kCauseRoundOff;
using test::light;
using test::torque_heads;
using test::wires;

TEST(SpringLayer, DrawsACoilFromAFixedAnchorToTheSliderAndAMarkWhereItRests) {
  const Cause cause("pp_spring");
  const Film pictures = cause.film();
  std::optional<Point> anchor;
  double shortest = 1, longest = 0;
  for (int k = 0; k < cause.run.size(); k += 7) {
    const Picture picture = pictures.frame(k);
    const auto coils = wires(picture, light().torque);
    ASSERT_EQ(coils.size(), 1u) << k;
    const Point from = coils[0].points.front().p, to = coils[0].points.back().p;
    if (!anchor) anchor = from;
    EXPECT_LT(test::distance(*anchor, from), kCauseRoundOff) << "it is fixed";
    const Point slider = pictures.camera().project({cause.q(k, 0), cause.q(k, 1), 0});
    EXPECT_NEAR(to.x, slider.x, kCauseRoundOff);
    EXPECT_NEAR(slider.y - to.y, size::kCarriageLength / 2, kCauseRoundOff) << "at the carriage's lower edge";
    EXPECT_EQ(torque_heads(picture), 0) << "the coil says how large the force is";
    // It is told from its rail by a pale edge, and by a gap to the lines of that.
    const auto edges = wires(picture, light().background);
    ASSERT_EQ(edges.size(), 1u) << k;
    ASSERT_EQ(edges[0].points.size(), coils[0].points.size());
    EXPECT_GT(edges[0].points[1].width, coils[0].points[1].width);
    for (const TrailPoint& point : edges[0].points)
      EXPECT_LT(std::abs(point.p.x - slider.x) + point.width / 2, (size::kRailGap - size::kRailLine) / 2) << k;
    shortest = std::min(shortest, test::distance(from, to));
    longest = std::max(longest, test::distance(from, to));
    // Dashes across the rail where y = 0.
    const double rest = pictures.camera().project(Vector3d::Zero()).y;
    const auto dashes = test::all_of<Capsule>(picture, [&](const Capsule& c) { return c.paint.fill == light().torque; });
    EXPECT_GE(dashes.size(), 3u);
    for (const Capsule& dash : dashes) EXPECT_NEAR(dash.a.y, rest, kCauseRoundOff);
  }
  EXPECT_GT(shortest, 0.05) << "it never turns inside out";
  EXPECT_GT(longest, 3 * shortest);
}

TEST(SpringLayer, DrawsArrowsWhereALawIsNotLinear) {
  const Cause cause("pp_spring", {"torque=[0, -100 * y_G^3]"}, 0.5);
  const Picture picture = cause.film().frame(3);
  EXPECT_TRUE(wires(picture, light().torque).empty());
  EXPECT_TRUE(wires(picture, light().background).empty()) << "no spring, no edge";
  EXPECT_EQ(torque_heads(picture), 1);
}

TEST(SpringLayer, LeavesTheArrowsToWhoDoesNotNameIt) {
  const Cause cause("pp_spring", {"draw=[chain, torque]"}, 0.5);
  const Picture picture = cause.film().frame(3);
  EXPECT_TRUE(wires(picture, light().torque).empty());
  EXPECT_EQ(torque_heads(picture), 1);
}

TEST(SpringLayer, WindsASpiralByTheAngleFromItsRest) {
  const Cause cause("rr_free", {"torque=[-30 * (q1 - 0.5), -2 * qd2]"}, 1);
  const Film pictures = cause.film();
  for (const int k : {0, 20, 40}) {
    const Picture picture = pictures.frame(k);
    const Point joint = pictures.camera().project(Vector3d::Zero());
    const auto all = wires(picture, light().torque);
    const auto spiral = std::find_if(all.begin(), all.end(), [](const Trail& path) { return path.points.size() >= 57; });
    ASSERT_NE(spiral, all.end());
    // The inner end turns with the link, the outer one stays opposite to it as it rests.
    double turned = 0;
    for (std::size_t i = 1; i < spiral->points.size(); ++i) {
      const Point a = spiral->points[i - 1].p - joint, b = spiral->points[i].p - joint;
      turned += std::atan2(cross(a, b), dot(a, b));
    }
    const Point in = spiral->points.front().p - joint, out = spiral->points.back().p - joint;
    EXPECT_NEAR(std::remainder(std::atan2(in.y, in.x) - cause.q(k, 0), 2 * std::numbers::pi), 0, kCauseRoundOff);
    EXPECT_NEAR(std::remainder(std::atan2(out.y, out.x) - 0.5 - std::numbers::pi, 2 * std::numbers::pi), 0, kCauseRoundOff);
    EXPECT_NEAR(turned, 5 * std::numbers::pi + 0.5 - cause.q(k, 0), 1e-6);
    EXPECT_EQ(torque_heads(picture), k == 0 ? 0 : 1) << "the damper has its arc, too; at rest it does nothing";
  }
}

TEST(TargetLayer, ShowsThePoseThatFeedbackFollows) {
  const Cause cause("rr_free", {"torque={pd: {kp: 20, kd: 2, q: [\"0.3 + t\", -0.5]}}", "draw=[chain, target]"}, 1);
  const Film pictures = cause.film();
  for (const int k : {0, 30, 59}) {
    const Picture picture = pictures.frame(k);
    const auto outlines = test::all_of<Capsule>(picture, [](const Capsule& c) { return c.paint.stroke_width > 0 && c.paint.fill.a == 0; });
    ASSERT_EQ(outlines.size(), 2u);
    const double q1 = 0.3 + cause.times[std::size_t(k)], q2 = -0.5;
    const Point tip = pictures.camera().project({std::cos(q1) + std::cos(q1 + q2), std::sin(q1) + std::sin(q1 + q2), 0});
    EXPECT_LT(test::distance(outlines[1].b, tip), kCauseRoundOff);
    EXPECT_TRUE(test::is_inside(pictures.scene_area(), tip)) << "the camera holds it";
  }
  // From the target to where the joint is, coils.
  const auto coils = wires(pictures.frame(0), light().torque);
  ASSERT_EQ(coils.size(), 2u);
  const Point joint = pictures.camera().project(Vector3d::Zero());
  const Point from = coils[0].points.front().p - joint, to = coils[0].points.back().p - joint;
  EXPECT_NEAR(std::atan2(from.y, from.x), 0.3, kCauseRoundOff);
  EXPECT_NEAR(std::atan2(to.y, to.x), 0, kCauseRoundOff);
  // Negative control: an expression that follows nothing has no target.
  const Cause other("rr_torque", {}, 0.1);
  EXPECT_TRUE(references_along(other.simulation, other.run).empty());
}

// A joint without gains follows nothing: its link has no outline, and what follows stands where its own gains pull it.
TEST(TargetLayer, IsNothingOfJointsThatNoGainDrives) {
  const Cause cause("rr_free", {"torque={pd: {kp: [20, 0], kd: [2, 0], q: [0.3, 0]}}", "draw=[chain, target]"}, 1);
  const Film pictures = cause.film();
  for (const int k : {0, 30}) {
    const auto outlines = test::all_of<Capsule>(pictures.frame(k), [](const Capsule& c) { return c.paint.stroke_width > 0 && c.paint.fill.a == 0; });
    ASSERT_EQ(outlines.size(), 1u);
    EXPECT_LT(test::distance(outlines[0].b, pictures.camera().project({std::cos(0.3), std::sin(0.3), 0})), kCauseRoundOff);
  }
}

// A spring along x alone pulls along x alone, and one along each axis where they are not alike; one of equal kp goes straight to its place.
TEST(TargetLayer, DrawsSpringsOfTheTaskAlongTheAxesThatTheyPullAlong) {
  const auto coils_of = [](const std::string& kp) {
    const Cause cause("rr_free", {"torque={task: {kp: " + kp + ", kd: 0, x: [0.2, 0.3]}}", "draw=[chain, target]", "start.q=[0.4, 0.9]"}, 0.2);
    const Film pictures = cause.film();
    std::vector<Point> ways;
    for (const Trail& coil : wires(pictures.frame(0), light().torque)) ways.push_back(coil.points.back().p - coil.points.front().p);
    return ways;
  };
  const std::vector<Point> along_x = coils_of("[100, 0]"), both = coils_of("[100, 50]"), one = coils_of("100");
  ASSERT_EQ(along_x.size(), 1u);
  EXPECT_NEAR(along_x[0].y, 0, kCauseRoundOff);
  EXPECT_GT(std::abs(along_x[0].x), 0.05);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[0].y, 0, kCauseRoundOff);
  EXPECT_NEAR(both[1].x, 0, kCauseRoundOff);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].y / one[0].x, both[1].y / both[0].x, kCauseRoundOff) << "the same way, on a page of its own scale";
  EXPECT_TRUE(coils_of("0").empty());
  // Negative control: what pushes away from its place is no spring.
  EXPECT_TRUE(coils_of("-50").empty());
  const std::vector<Point> away_along_x = coils_of("[-50, 100]");
  ASSERT_EQ(away_along_x.size(), 1u);
  EXPECT_NEAR(away_along_x[0].x, 0, kCauseRoundOff);
}

TEST(ConstraintLayer, DrawsTheLineOfThePenOnceAndHatchedWhereItPresses) {
  for (const bool up : {false, true}) {
    const Cause cause("pen", {"contact_force={constraint: 1, force: [0, " + std::string(up ? "5" : "-5") + "]}"}, 1);
    const Film pictures = cause.film();
    const double height = pictures.camera().project({0, 0.5, 0}).y;
    const auto lines = test::all_of<Capsule>(pictures.static_layer(), [&](const Capsule& c) {
      return c.paint.fill == light().base && std::abs(c.a.y - height) < 1e-9 && std::abs(c.b.y - height) < 1e-9;
    });
    ASSERT_EQ(lines.size(), 1u);
    const auto strokes = test::all_of<Capsule>(pictures.static_layer(), [&](const Capsule& c) {
      return c.paint.fill == light().base && std::abs(c.a.y - height) < 1e-9 && std::abs(c.b.y - height) > 0.005;
    });
    EXPECT_GT(strokes.size(), 10u);
    for (const Capsule& stroke : strokes) EXPECT_EQ(stroke.b.y > height, up);
    for (int k = 0; k < cause.run.size(); ++k) {
      const Point pen = pictures.panel(0).tip().place(k);
      EXPECT_GT(pen.x, lines[0].a.x);
      EXPECT_LT(pen.x, lines[0].b.x);
    }
  }
  const Cause without("rr_torque", {"draw=[constraints]", "layout=scene"}, 0.1);
  EXPECT_TRUE(test::all_of<Capsule>(without.film().static_layer()).empty());
}

TEST(ConstraintLayer, DrawsCurvesAndRods) {
  const Cause circle("rr_free", {"start.q=[0, 90deg]", "constraints=[{curve: {frame: gripper, x: \"sqrt(2)*cos(s)\", y: \"sqrt(2)*sin(s)\", s: 0.785398163397}}]",
                                 "method=dop853", "step=null", "draw=[constraints]", "camera.fit=[-2, -2, 2, 2]"}, 0.2);
  const Film pictures = circle.film();
  const auto paths = wires(pictures.static_layer(), light().base);
  ASSERT_EQ(paths.size(), 1u) << "it comes back to where it began";
  const Point middle = pictures.camera().project(Vector3d::Zero());
  for (const TrailPoint& p : paths[0].points)
    EXPECT_NEAR(test::distance(p.p, middle), std::sqrt(2) * pictures.camera().scale, 1e-4);
  EXPECT_LT(test::distance(paths[0].points.front().p, paths[0].points.back().p), kCauseRoundOff);

  const Cause rod("rr_free", {"start.q=[0, 90deg]", "constraints=[{distance: {a: gripper, at: [1, 2], length: 1}}]",
                              "method=dop853", "step=null", "draw=[constraints]"}, 0.2);
  const Film rods = rod.film();
  const auto bars = test::all_of<Capsule>(rods.frame(5), [](const Capsule& c) { return c.paint.stroke_width > 0; });
  ASSERT_EQ(bars.size(), 1u);
  EXPECT_NEAR(test::distance(bars[0].a, bars[0].b), rods.camera().scale, 1e-6) << "1 m";
  EXPECT_LT(test::distance(bars[0].b, rods.camera().project({1, 2, 0})), kCauseRoundOff);
}

TEST(FieldLayer, IsASmallArrowBesideTheMotionAndNothingWithoutGravity) {
  const auto arrows = [](const Cause& cause) {
    return test::all_of<Polygon>(cause.film().static_layer(), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().force; });
  };
  const Cause falls("rr_free", {}, 3);
  const auto found = arrows(falls);
  ASSERT_EQ(found.size(), 1u);
  const Point tip = found[0].corners[0], base = 0.5 * (found[0].corners[1] + found[0].corners[2]);
  EXPECT_NEAR(tip.x, base.x, kCauseRoundOff);
  EXPECT_LT(tip.y, base.y) << "downwards";
  const Film pictures = falls.film();
  for (int k = 0; k < falls.run.size(); k += 5)
    for (const Capsule& link : test::all_of<Capsule>(pictures.frame(k), [](const Capsule& c) { return c.paint.stroke_width > 0; })) {
      Point a = link.a, b = link.b;
      EXPECT_FALSE(cut_segment(widened(test::box_of(found[0]), link.radius), a, b)) << k;
    }
  EXPECT_TRUE(arrows(Cause("pp_spring", {}, 0.1)).empty()) << "its gravity is zero";
  EXPECT_EQ(arrows(Cause("rr_free", {"gravity=[9.81, 0, 0]"}, 0.5)).size(), 1u);
}

// An arm whose ellipse sweeps over the place beside the motion where the arrow else stands.
TEST(FieldLayer, KeepsOffTheEllipse) {
  const Cause arm("rr_ellipse",
                  {"model={dh: [[0.5, 0, 0, 0], [0.4, 0, 0, 0]], masses: [3, 2]}", "start={q: [20deg, 40deg]}", "duration=3",
                   "torque={computed_torque: {kp: 100, kd: 20, q: ['20deg + 30deg*(1 - cos(2*t))', '40deg + 45deg*sin(2*t)^2']}}"},
                  3);
  const Film film = arm.film();
  const auto arrows = test::all_of<Polygon>(film.static_layer(), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().force; });
  ASSERT_EQ(arrows.size(), 1u);
  const Point place = center_of(test::box_of(arrows[0]));
  int closed = 0;
  for (int k = 0; k < arm.run.size(); k += 3)
    for (const Ellipse& e : test::all_of<Ellipse>(film.frame(k), [](const Ellipse& one) { return one.paint.fill.a > 0 && one.paint.fill.a < 0.3; })) {
      ++closed;
      const Point d = place - e.center;
      EXPECT_GT(std::hypot(dot(d, e.u) / dot(e.u, e.u), dot(d, e.v) / dot(e.v, e.v)), 1) << k;
    }
  EXPECT_GT(closed, 20) << "there are ellipses";
}

// A slider whose spring hangs where the arrow else stands.
TEST(FieldLayer, KeepsOffSprings) {
  const auto slider = [](const std::string& draw) {
    return Cause("rr_free", {"model={links: [0.6, 0.5], masses: [2, 1], joints: PR}", "start={q: [0.3, -60deg]}", "duration=4",
                             "torque=['-80*(q1-0.1) - 3*qd1', 0]", "draw=" + draw}, 3);
  };
  const auto arrow = [](const Film& film) {
    const auto heads = test::all_of<Polygon>(film.static_layer(), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().force; });
    return heads.size() == 1 ? widened(test::box_of(heads[0]), 0.02) : Rect{};  // as far as its letter
  };
  const Cause hung = slider("[chain, g, springs]");
  const Film film = hung.film();
  const auto meets = [&](const Rect& box) {
    int frames = 0;
    for (int k = 0; k < hung.run.size(); k += 5) frames += lies_on(box, obstacles_of(film.frame(k)));
    return frames;
  };
  EXPECT_GT(arrow(film).height(), 0);
  EXPECT_EQ(meets(arrow(film)), 0);
  EXPECT_LT(arrow(slider("[chain, g]").film()).x1, arrow(film).x0) << "negative control: without a spring it stands on its side";
}

TEST(FieldLayer, KeepsOffTheMassMatrix) {
  const auto swing = [](const std::string& draw) {
    return Cause("rr_free", {"start={q: [20deg, 50deg]}", "torque=[1, 0]", "duration=2", "layout=scene", "draw=" + draw}, 2);
  };
  const auto arrow = [](const Film& film) {
    const auto heads = test::all_of<Polygon>(film.static_layer(), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().force; });
    return heads.size() == 1 ? widened(test::box_of(heads[0]), 0.02) : Rect{};
  };
  const Cause with_table = swing("[chain, g, ellipse, mass_matrix]"), without = swing("[chain, g, ellipse]");
  const Film film = with_table.film(), bare = without.film();
  const Rect table = test::all_of<Cells>(film.frame(0)).at(0).rect;
  ASSERT_GT(arrow(film).height(), 0);
  EXPECT_FALSE(test::overlap(arrow(film), table));
  EXPECT_TRUE(test::overlap(arrow(bare), table)) << "negative control: it stood there";
}

// One arrow stands for panels of one gravity alone.
TEST(FieldLayer, StandsInEachPanelWhereGravityDiffers) {
  const auto arrows = [](const Cause& a, const Cause& b) {
    const Film film(a.scene, {{a.scene, a.simulation.chain, a.run, &a.simulation}, {b.scene, b.simulation.chain, b.run, &b.simulation}}, a.times, a.fonts);
    return test::all_of<Polygon>(film.static_layer(), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().force; });
  };
  const Cause down("rr_free", {}, 0.5), up("rr_free", {"gravity=[0, 9.81, 0]"}, 0.5);
  EXPECT_EQ(arrows(down, down).size(), 1u);
  const auto both = arrows(down, up);
  ASSERT_EQ(both.size(), 2u);
  const auto points_up = [](const Polygon& head) { return head.corners[0].y > head.corners[1].y; };
  EXPECT_NE(points_up(both[0]), points_up(both[1]));
}

// How far, in pixels of a plot of 700 x 800, the curve leaves the lines between points of what is kept between frames at 30 Hz,
// and between those frames alone.
TEST(PlotsOfFilms, AreWithinHalfAPixelOfTheCurve) {
  const Cause bar("four_bar", {"method=dop853", "step=null", "tolerance=1e-10"}, 0.1);
  std::vector<double> frames, all;
  const double end = bar.simulation.duration;
  for (int k = 0; k <= int(30 * end); ++k) frames.push_back(k / 30.0);
  for (int k = 0; k <= int(3000 * end); ++k) all.push_back(k / 3000.0);
  const Trajectory film = simulate(bar.simulation, frames, {}, {}, 0.5 * end / 1920), truth = simulate(bar.simulation, all);
  ASSERT_TRUE(film.between);
  const auto [low, high] = std::minmax_element(truth.lambda.begin(), truth.lambda.end());
  const auto place = [&](const Trajectory& of, std::ptrdiff_t k) {
    return Point{700 * of.t[std::size_t(k)] / end, 800 * of.lambda_at(int(k))[1] / (*high - *low)};
  };
  const auto off_by = [&](const Trajectory& seen) {
    double worst = 0;
    for (int k = 0; k < truth.size(); ++k) {
      const auto next = std::upper_bound(seen.t.begin(), seen.t.end(), truth.t[std::size_t(k)]) - seen.t.begin();
      double nearest = HUGE_VAL;
      for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(1, next - 3); i < std::min<std::ptrdiff_t>(seen.size(), next + 4); ++i) {
        const Point p = place(truth, k), a = place(seen, i - 1), d = place(seen, i) - a;
        const double s = std::clamp(dot(p - a, d) / std::max(dot(d, d), 1e-12), 0.0, 1.0);
        nearest = std::min(nearest, norm(p - a - s * d));
      }
      worst = std::max(worst, nearest);
    }
    return worst;
  };
  EXPECT_LT(off_by(*film.between), 0.5);
  EXPECT_GT(off_by(film), 5) << "negative control";
}

TEST(PlotsOfFilms, DrawAStepAsAnEdge) {
  Cause cause("rr_free", {"torque=['8*(t>1.013)', 0]", "plot=[tau]", "method=dop853", "step=null"}, 2);
  const auto widest_edge = [&] {
    const Film film = cause.film();
    double narrowest = 1;
    for (const Trail& curve : wires(film.frame(film.frame_count() - 1), light().curve[0]))
      for (std::size_t i = 1; i < curve.points.size(); ++i)
        if (std::abs(curve.points[i].p.y - curve.points[i - 1].p.y) > 0.1)
          narrowest = std::min(narrowest, std::abs(curve.points[i].p.x - curve.points[i - 1].p.x));
    return narrowest;
  };
  EXPECT_GT(widest_edge(), 1e-3) << "negative control: from frame to frame it is a ramp";
  cause.run = simulate(cause.simulation, cause.times, {}, {}, 0.01);
  EXPECT_LT(widest_edge(), 1e-5);
}

TEST(AngleLayer, MeasuresFromWhereTheModelCountsZero) {
  const Cause cause("rr_free", {"draw=[chain, angles]"}, 1);
  const Film pictures = cause.film();
  const int k = 40;
  const auto arcs = wires(pictures.frame(k), light().ink);
  ASSERT_EQ(arcs.size(), 2u);
  const double q1 = cause.q(k, 0), q2 = cause.q(k, 1);
  const Point joint = pictures.camera().project({std::cos(q1), std::sin(q1), 0});
  // The second begins where the first link points.
  const Point zero = arcs[1].points.front().p - joint;
  EXPECT_NEAR(std::atan2(zero.y, zero.x), std::remainder(q1, 2 * std::numbers::pi), kCauseRoundOff);
  // Up to its head, which ends at the second link.
  const auto heads = test::all_of<Polygon>(pictures.frame(k), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().ink; });
  ASSERT_EQ(heads.size(), 2u);
  const Point tip = heads[1].corners[0] - joint;
  EXPECT_NEAR(std::remainder(std::atan2(tip.y, tip.x) - q1 - q2, 2 * std::numbers::pi), 0, kCauseRoundOff);
  EXPECT_TRUE(wires(Cause("rr_free", {"layout=scene"}, 0.1).film().frame(2), light().ink).empty()) << "only who asks for it";
}

TEST(LimitLayer, ShowsALimitThatTheMotionComesNearTo) {
  Cause cause("rr_free", {"draw=[chain, limits]"}, 1);
  const auto shown = [&](int k) {
    return test::all_of<Trail>(cause.film().frame(k), [](const Trail& path) { return path.color.faded(0) == light().base.faded(0); }).size();
  };
  EXPECT_EQ(shown(59), 0u) << "there is none";
  double lowest = 0;
  for (int k = 0; k < cause.run.size(); ++k) lowest = std::min(lowest, cause.q(k, 0));
  Joint& joint = cause.simulation.chain.bodies[1].joint;
  joint.limit.upper = 3;
  joint.limit.lower = lowest - 25 * std::numbers::pi / 180;
  for (int k = 0; k < cause.run.size(); k += 7) EXPECT_EQ(shown(k), 0u) << "it comes within 20 degrees of none";
  joint.limit.lower = lowest - 0.05;
  // In all pictures, stronger where it is near, and there with the way that is left.
  int seen = 0;
  for (int k = 0; k < cause.run.size(); ++k) {
    const bool near = cause.q(k, 0) - joint.limit.lower < 40 * std::numbers::pi / 180;
    EXPECT_EQ(shown(k), near ? 2u : 1u) << k;
    seen += near;
  }
  EXPECT_GE(seen, 2);
  EXPECT_LT(seen, cause.run.size());
}

// In space a robot has bodies, behind which its target stands pale, and over which coils lie.
struct DrivenInSpace {
  DrivenInSpace(const std::string& torque, const std::string& gravity = "[0, 0, -9.81]",
                const std::string& model = "{dh: [[0, 90deg, 0.6, 0], [0.5, 0, 0, 0], [0.4, 0, 0, 0]]}") {
    const std::string text = "model: " + model + "\nstart: {q: [0, 0.5, -1]}\nduration: 0.5\nmethod: rk4\nstep: 0.001\ngravity: " +
                             gravity + "\ntorque: " + torque + "\n";
    scene = read_scene(folder.write("space.yaml", text));
    simulation = prepare(scene, false);
    for (int k = 0; k < 30; ++k) times.push_back(k / 60.0);
    run = simulate(simulation, times);
    bodies = made_bodies(simulation.chain);
  }
  Film film(bool with_bodies = true) const { return {scene, {{scene, simulation.chain, run, &simulation, with_bodies ? &bodies : nullptr}}, times, fonts}; }

  TemporaryFolder folder;
  Scene scene;
  Simulation simulation;
  std::vector<double> times;
  Trajectory run;
  BodyShapes bodies;
  Fonts fonts;
};

TEST(TargetLayer, StandsPaleBehindBodiesInSpaceWithCoilsOverThem) {
  DrivenInSpace driven("{pd: {kp: 20, kd: 2, q: [90deg, 60deg, 0]}}");
  driven.scene.draw = {"chain", "target"};
  const Picture picture = driven.film().frame(3);
  std::optional<std::size_t> pale, whole, coil;
  for (std::size_t i = 0; i < picture.items.size(); ++i) {
    if (const auto* solids = std::get_if<Solids>(&picture.items[i].shape); solids && !solids->is_shadow) (solids->opacity < 1 ? pale : whole) = i;
    if (const auto* wire = std::get_if<Trail>(&picture.items[i].shape); wire && !coil && wire->color == light().torque) coil = i;
  }
  ASSERT_TRUE(pale && whole && coil);
  EXPECT_LT(*pale, *whole);
  EXPECT_LT(*whole, *coil);
  EXPECT_EQ(wires(picture, light().torque).size(), 3u);
  // Negative control: without feedback there is neither.
  const DrivenInSpace alone("[0, 0, 0]");
  EXPECT_EQ(wires(alone.film().frame(3), light().torque).size(), 0u);
  EXPECT_EQ(test::all_of<Solids>(alone.film().frame(3), [](const Solids& solids) { return !solids.is_shadow; }).size(), 1u);
}

TEST(SpringLayer, WindsSpiralsAboutTheAxesOfBodiesInSpace) {
  const DrivenInSpace sprung("[\"-10*(q1-1)\", \"-60*(q2-0.5)\", \"-30*q3\"]");
  EXPECT_EQ(wires(sprung.film().frame(3), light().torque).size(), 3u);
  EXPECT_EQ(wires(sprung.film().frame(3), light().background).size(), 3u) << "each set off from its body";
  EXPECT_EQ(wires(sprung.film(false).frame(3), light().background).size(), 0u);
  EXPECT_EQ(torque_heads(sprung.film().frame(3)), 0) << "the spiral says how large the torque is";
}

TEST(SpringLayer, CoilsAlongTheAxisOfASliderInSpace) {
  const DrivenInSpace sprung("[0, \"-80*(q2-0.1)\", 0]", "[0, 0, -9.81]", "{links: [0.4, 0.3, 0.3], joints: RzPyRx}");
  const Film film = sprung.film();
  std::optional<double> before;
  for (const int k : {0, 12, 24}) {
    const Picture picture = film.frame(k);
    const auto coils = test::all_of<Trail>(picture, [](const Trail& path) { return path.color == light().torque && path.points.size() > 100; });
    ASSERT_EQ(coils.size(), 1u) << k;
    Workspace ws(sprung.simulation.chain);
    compute_kinematics(sprung.simulation.chain, ws, sprung.run.q_at(k), sprung.run.qd_at(k));
    EXPECT_LT(test::distance(coils[0].points.back().p, film.camera().project(pose_of(ws, 2).translation())), kCauseRoundOff) << "it ends at the slider";
    const double length = test::distance(coils[0].points.front().p, coils[0].points.back().p);
    if (before) EXPECT_NE(length, *before) << "and is as long as the way to it";
    before = length;
    EXPECT_GE(wires(picture, light().background).size(), 1u) << "set off from the bodies";
    EXPECT_EQ(torque_heads(picture), 0) << "it stands for the arrow";
  }
}

// Beside the bodies in space, where marks of bars would lie on them.
TEST(CoordinateLayers, StandBesideBodiesInSpace) {
  DrivenInSpace driven("[0, 0, 0]");
  driven.simulation.chain.bodies[2].joint.limit = {driven.run.q_at(29)[1] - 0.05, 3, 1e9, 1e9};
  const auto radii = [&](const char* layer, bool with_bodies, Color color) {
    driven.scene.draw = {"chain", layer};
    const Film film = driven.film(with_bodies);
    std::vector<double> all;
    for (const int joint : {1, 2, 3}) {
      Workspace ws(driven.simulation.chain);
      compute_kinematics(driven.simulation.chain, ws, driven.run.q_at(29), driven.run.qd_at(29));
      const Point center = film.camera().project(pose_of(ws, joint).translation());
      double farthest = 0;
      for (const Trail& arc : test::all_of<Trail>(film.frame(29), [&](const Trail& path) { return path.color.faded(0) == color.faded(0) && path.color.a > 0.9 && path.points.size() > 2; }))
        for (const TrailPoint& point : arc.points)
          if (test::distance(center, point.p) < 0.3) farthest = std::max(farthest, test::distance(center, point.p));
      all.push_back(farthest);
    }
    return all;
  };
  EXPECT_GT(radii("limits", true, light().base)[1], 0) << "a limit is shown on bodies, too";
  EXPECT_GT(radii("angles", true, light().ink)[1], 0);
  driven.scene.draw = {"chain", "angles"};
  EXPECT_GE(wires(driven.film().frame(29), light().background).size(), 3u) << "each set off from its body";
  EXPECT_EQ(wires(driven.film(false).frame(29), light().background).size(), 0u);
}

TEST(DefaultLayers, ShowTheCauseAndLeaveSmallPanelsAlone) {
  const auto has = [](const Scene& scene, const char* layer) {
    return std::find(scene.draw.begin(), scene.draw.end(), layer) != scene.draw.end();
  };
  for (const char* name : {"rr_torque", "rrr_torque", "pp_spring", "pen", "four_bar", "slider_crank", "humanoid_fall", "particle"}) {
    const Scene scene = read_scene("assets/scenes/" + std::string(name) + ".yaml");
    for (const char* layer : {"torque", "springs", "constraints", "target", "g", "limits"})
      EXPECT_EQ(has(scene, layer), !(std::string(name) == "pen" && std::string(layer) == "target")) << name << layer;  // its target is next to its pose
    EXPECT_FALSE(has(scene, "angles"));
  }
  for (const char* name : {"big_steps", "euler_gains_energy", "ghost_euler"}) {
    const Scene scene = read_scene("assets/scenes/" + std::string(name) + ".yaml");
    EXPECT_TRUE(has(scene, "springs") && has(scene, "constraints") && has(scene, "torque")) << name << ": what acts is not shown by half";
    EXPECT_FALSE(has(scene, "target")) << name;
  }
  EXPECT_TRUE(has(read_scene("assets/scenes/pen_drift.yaml", {"draw=[+target]"}), "target")) << "who asks gets it";
}

// What is tied of coordinates has no line in the world: it is told at their joints.
TEST(ConstraintsLayer, MarksJointsThatAreHeldOrTied) {
  const std::vector<std::string> still{"start.q=[60deg, -60deg, -60deg]", "start.qd=[0, 0, 0]"};
  const auto scene = [&](const std::string& constraints) {
    std::vector<std::string> all = still;
    if (!constraints.empty()) all.push_back("constraints=[" + constraints + "]");
    return Cause("rrr_free", all, 0.5);
  };
  const auto squares = [](const Picture& picture) {
    return test::all_of<Polygon>(picture, [](const Polygon& p) { return p.count == 4 && p.paint.fill == light().ink; });
  };
  const auto rings = [](const Picture& picture) {
    return test::all_of<Arc>(picture, [](const Arc& arc) { return arc.color == light().constraint; });
  };
  const Cause held = scene("{joint: {name: joint2, value: -60deg}}"), tied = scene("{linear: {coefficients: {joint1: 1, joint3: 1}, value: 0}}"), free = scene("");
  for (const int k : {0, 20}) {
    const auto joint = [&](const Cause& cause, const Film& film, int body) {
      Workspace ws(cause.simulation.chain);
      compute_kinematics(cause.simulation.chain, ws, cause.run.q_at(k), cause.run.qd_at(k));
      return film.camera().project(pose_of(ws, body).translation());
    };
    const Film of_held = held.film(), of_tied = tied.film();
    const auto square = squares(of_held.frame(k));
    ASSERT_EQ(square.size(), 1u);
    EXPECT_LT(norm(0.5 * (square[0].corners[0] + square[0].corners[2]) - joint(held, of_held, 2)), kCauseRoundOff);
    EXPECT_TRUE(rings(of_held.frame(k)).empty());
    const auto ring = rings(of_tied.frame(k));
    ASSERT_EQ(ring.size(), 2u);
    EXPECT_LT(norm(ring[0].center - joint(tied, of_tied, 1)), kCauseRoundOff);
    EXPECT_LT(norm(ring[1].center - joint(tied, of_tied, 3)), kCauseRoundOff);
    EXPECT_TRUE(squares(of_tied.frame(k)).empty());
    EXPECT_TRUE(squares(free.film().frame(k)).empty() && rings(free.film().frame(k)).empty()) << "negative control";
  }
}

}  // namespace
}  // namespace chainreel
