// Layers over the chain: every vector is where and as long as the physics says, and nothing overlaps the
// words.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/layers/mass_map.hpp"
#include "draw/layers/past.hpp"
#include "draw/layers/vectors.hpp"
#include "draw/page/arrow.hpp"
#include "draw/shapes.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/point.hpp"
#include "render/canvas.hpp"
#include "sim/torques_along.hpp"
#include "support/picture_compare.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::Not;

constexpr double kLayersRoundOff = 1e-9;  // of places that are sums of a few numbers of size 1
// The runs have their rates from central differences over 1e-5 s: wrong by h^2/6 q''' ~ 1e-9.
constexpr double kRate = 1e-8;

// A straight arrow as it is drawn: a shaft and a head.
struct SeenArrow {
  Point tail, tip;
  Point v() const { return tip - tail; }
};

std::vector<Polygon> heads(const Picture& picture, Color color) {
  return test::all_of<Polygon>(picture,
                               [&](const Polygon& p) { return p.count == 3 && p.paint.fill == color; });
}

// Arrows inside scenes (clipped) or in the foot (not). The first shaft before a head begins at its tail.
std::vector<SeenArrow> arrows(const Picture& picture, Color color, bool in_scene = true) {
  std::vector<SeenArrow> found;
  std::optional<Point> tail;
  for (const Item& item : picture.items) {
    if ((item.clip >= 0) != in_scene) continue;
    if (const auto* shaft = std::get_if<Capsule>(&item.shape)) {
      if (shaft->paint.fill == color && !tail) tail = shaft->a;
    }
    // What led to a dot was the tie of an arrow that stands aside.
    if (const auto* dot = std::get_if<Ellipse>(&item.shape); dot && dot->paint.fill == color) tail.reset();
    if (const auto* head = std::get_if<Polygon>(&item.shape)) {
      if (head->count != 3 || head->paint.fill != color || !tail) continue;
      found.push_back({*tail, head->corners[0]});
      tail.reset();
    }
  }
  return found;
}

std::vector<Arc> arcs(const Picture& picture, Color color) {
  std::vector<Arc> found;
  for (const Item& item : picture.items) {
    const auto* arc = std::get_if<Arc>(&item.shape);
    if (arc && item.clip >= 0 && arc->color == color) found.push_back(*arc);
  }
  return found;
}

// How far the first arc turns, up to the tip of the head that follows it, counter-clockwise positive.
std::vector<double> turns(const Picture& picture, Color color) {
  std::vector<double> found;
  const Arc* arc = nullptr;
  for (const Item& item : picture.items) {
    if (item.clip < 0) continue;
    if (const auto* a = std::get_if<Arc>(&item.shape); a && a->color == color) arc = a;
    const auto* head = std::get_if<Polygon>(&item.shape);
    if (!arc || !head || head->paint.fill != color) continue;
    const Point tip = head->corners[0] - arc->center;
    const double end = arc->start + arc->sweep;  // inside of the head
    found.push_back(arc->sweep + std::remainder(std::atan2(tip.y, tip.x) - end, 2 * std::numbers::pi));
    arc = nullptr;
  }
  return found;
}

class LayerFilm : public ::testing::Test {
 protected:
  LayerFilm() {
    scene.title = "Layers";
    scene.file = "scenes/test.yaml";
    scene.draw = {"chain", "trail", "time", "title", "torque_label", "ground"};
  }

  void make(const std::string& name, const std::vector<std::string>& torque,
            const std::function<std::vector<double>(double)>& motion, int frames = 300) {
    simulation.chain = test::model(name);
    std::vector<TorqueEntry> entries;
    for (const std::string& text : torque) entries.push_back({text, {}, {}});
    simulation.torque = make_torque_law(simulation.chain, entries, {});
    scene.torque = std::move(entries);
    run = test::run_of(motion, frames);
  }
  void make_rr() { make("rr", {"10*sin(2*t)", "-3"}, test::swing); }

  Film film() const {
    return Film(scene, {{scene, simulation.chain, run, &simulation}}, run.t, fonts());
  }
  void draw(const std::vector<std::string>& more) {
    scene.draw.insert(scene.draw.end(), more.begin(), more.end());
  }

  const Theme& light = light_theme();
  Scene scene;
  Simulation simulation;
  Trajectory run;
};

Vector3d rr_velocity(double t) {
  const double h = 1e-6;
  const auto tip = [](double s) {
    const auto q = test::swing(s);
    return Vector3d(std::cos(q[0]) + std::cos(q[0] + q[1]), std::sin(q[0]) + std::sin(q[0] + q[1]), 0);
  };
  return (tip(t + h) - tip(t - h)) / (2 * h);
}

// That below which 95 % of those lie that are more than round-off.
double nearly_the_largest(std::vector<double> magnitudes) {
  std::sort(magnitudes.begin(), magnitudes.end());
  std::erase_if(magnitudes, [most = magnitudes.back()](double one) { return one < 1e-6 * most; });
  return magnitudes[std::size_t(std::ceil(0.95 * double(magnitudes.size()))) - 1];
}

TEST_F(LayerFilm, VelocityIsAsLongAsItsShareOfWhatIsNearlyTheFastestAndBeginsAtTheTip) {
  make_rr();
  draw({"velocity"});
  const Film pictures = film();
  std::vector<double> speeds;
  for (const double t : run.t) speeds.push_back(rr_velocity(t).norm());
  const double fastest = nearly_the_largest(speeds);
  double longest = 0;
  int seen = 0, beside = 0;
  for (int k = 0; k < run.size(); ++k) {
    const Vector3d v = rr_velocity(run.t[std::size_t(k)]);
    const auto drawn = arrows(pictures.frame(k), light.velocity);
    if (0.20 * v.norm() / fastest < 0.003 - 1e-6) {
      EXPECT_TRUE(drawn.empty()) << k;
    }
    if (0.20 * v.norm() / fastest < 0.003 + 1e-6) continue;
    ASSERT_EQ(drawn.size(), 1u) << k;
    const auto q = test::swing(run.t[std::size_t(k)]);
    const Point tip = pictures.camera().project(
        {std::cos(q[0]) + std::cos(q[0] + q[1]), std::sin(q[0]) + std::sin(q[0] + q[1]), 0});
    // Where it would lie along a link it stands beside it, and a dot says where it acts.
    const auto dots = test::all_of<Ellipse>(pictures.frame(k), [&](const Ellipse& e) { return e.paint.fill == light.velocity; });
    EXPECT_LT(test::distance(dots.empty() ? drawn[0].tail : dots[0].center, tip), kLayersRoundOff) << k;
    beside += int(!dots.empty());
    const double per_unit = 0.20 / fastest;
    EXPECT_LT(test::distance(drawn[0].v(), {per_unit * v.x(), per_unit * v.y()}), kRate) << k;
    longest = std::max(longest, test::length(drawn[0].v()));
    ++seen;
  }
  EXPECT_GT(seen, 250);
  EXPECT_LT(beside, seen / 2);
  EXPECT_NEAR(longest, 0.20 * *std::max_element(speeds.begin(), speeds.end()) / fastest, kRate);
  // Negative control: a frame on, it is another vector.
  EXPECT_GT(test::distance(arrows(pictures.frame(60), light.velocity).at(0).v(),
                           arrows(pictures.frame(61), light.velocity).at(0).v()),
            1e-4);
}

TEST_F(LayerFilm, WeightsHangAtTheCentresOfMassAndGoWithTheMasses) {
  make_rr();
  simulation.chain.bodies[2].inertia.mass = 0.4;
  draw({"gravity"});
  const Film pictures = film();
  std::optional<double> full;
  for (const int k : {0, 100, 299}) {
    const auto q = test::swing(run.t[std::size_t(k)]);
    const auto drawn = arrows(pictures.frame(k), light.force);
    ASSERT_EQ(drawn.size(), 2u);
    const Vector3d first(std::cos(q[0]), std::sin(q[0]), 0);
    const Vector3d second = first + Vector3d(std::cos(q[0] + q[1]), std::sin(q[0] + q[1]), 0);
    EXPECT_LT(test::distance(drawn[0].tail, pictures.camera().project(first)), kLayersRoundOff);
    EXPECT_LT(test::distance(drawn[1].tail, pictures.camera().project(second)), kLayersRoundOff);
    // So long as there is room for, the same at all frames.
    if (!full) full = test::length(drawn[0].v());
    EXPECT_LT(test::distance(drawn[0].v(), {0, -*full}), kLayersRoundOff);
    EXPECT_LT(test::distance(drawn[1].v(), {0, -0.4 * *full}), kLayersRoundOff);
  }
}

TEST_F(LayerFilm, TorquesTurnInTheirSenseByTheirShareOfTwoHundredAndFortyDegrees) {
  make_rr();
  draw({"torque"});
  const Film pictures = film();
  std::vector<double> all;
  for (const double t : run.t) all.insert(all.end(), {3, std::abs(10 * std::sin(2 * t))});
  const double largest = nearly_the_largest(all);
  for (int k = 1; k < run.size(); ++k) {
    const double t = run.t[std::size_t(k)], tau = 10 * std::sin(2 * t);
    if (std::abs(tau) < 0.02 * largest) continue;
    const Picture picture = pictures.frame(k);
    const auto drawn = turns(picture, light.torque);
    ASSERT_EQ(drawn.size(), 2u) << k;
    const double full = 240 * std::numbers::pi / 180;
    EXPECT_NEAR(drawn[0], full * tau / largest, kLayersRoundOff) << k;
    EXPECT_NEAR(drawn[1], full * -3 / largest, kLayersRoundOff) << k;
    const auto places = arcs(picture, light.torque);
    const auto q = test::swing(t);
    EXPECT_LT(test::distance(places[0].center, pictures.camera().project(Vector3d::Zero())), kLayersRoundOff);
    EXPECT_LT(
        test::distance(places[1].center, pictures.camera().project({std::cos(q[0]), std::sin(q[0]), 0})),
        kLayersRoundOff);
    // A small one is small all over, so that it ends in a dot.
    EXPECT_NEAR(places[0].radius, 0.058 * std::min(1.0, full * std::abs(tau) / largest / (std::numbers::pi / 3)), kLayersRoundOff);
    EXPECT_NEAR(places[1].radius, 0.058, kLayersRoundOff);
  }
}

// At which frames the clip has a ring, which says that a torque rests.
std::vector<bool> frames_with_ring(const Film& pictures, Color color) {
  std::vector<bool> found;
  for (int k = 0; k < pictures.frame_count(); ++k) {
    const auto rings = test::all_of<Arc>(pictures.frame(k), [color](const Arc& arc) {
      return arc.color.faded(0) == color.faded(0) && std::abs(arc.sweep) > 6;
    });
    found.push_back(!rings.empty());
  }
  return found;
}

TEST_F(LayerFilm, ATorqueThatRestsIsADotAndHasARingFromThreeTenthsOfASecondOn) {
  make("rr", {"10*(t > 1)", "0"}, test::swing);
  draw({"torque"});
  const Film pictures = film();
  const std::vector<bool> ring = frames_with_ring(pictures, light.torque);
  for (int k = 0; k < run.size(); ++k) {
    const double t = run.t[std::size_t(k)];
    EXPECT_EQ(ring[std::size_t(k)], t > 0.3 && t < 1 - 0.5 / 60) << t;
    EXPECT_EQ(heads(pictures.frame(k), light.torque).size(), t > 1 ? 1u : 0u);
    // The second joint has no drive, and no mark.
    const auto dots = test::all_of<Ellipse>(pictures.frame(k), [&](const Ellipse& e) { return e.paint.fill == light.torque; });
    EXPECT_EQ(dots.size(), 1u);
  }
}

// The word of a torque that is hardly there is near its arc, which is hardly more than a dot: where a whole arc would be it
// would stand alone.
TEST_F(LayerFilm, WordsOfSmallTorquesStandBesideTheirSmallArcs) {
  const auto way_to_word = [&](const std::string& second) {
    make("rr", {"10", second}, [](double) { return std::vector<double>{-1.2, 0.9}; }, 60);
    scene.draw = {"chain", "torque"};
    const Film pictures = film();
    const Point elbow = pictures.camera().project({std::cos(-1.2), std::sin(-1.2), 0});
    double nearest = HUGE_VAL;
    for (const GlyphRun& glyphs : test::all_of<GlyphRun>(pictures.frame(30)))
      if (glyphs.color == light.torque) nearest = std::min(nearest, test::distance(glyphs.origin, elbow));
    return nearest;
  };
  // Off the joint: 0.026 H, half of a head and 0.010 H; of a whole arc 0.058 H and those. The origin of a word is its lower left.
  EXPECT_LT(way_to_word("1.2"), 0.058 + 0.009 + 0.010 - 0.004);
  // An arc within the disc of its joint has no word.
  EXPECT_GT(way_to_word("0.3"), 0.3) << "that of the other joint";
  EXPECT_GT(way_to_word("9"), 0.058 + 0.009 + 0.010 - 0.004);
}

// A slider that rests to within rounding has no arrow, and its kind no scale of its own; nor have torques beside forces.
TEST_F(LayerFilm, DrivesThatAreRoundingBesideOthersHaveNoScale) {
  const auto scales = [&](const std::string& torque, const std::string& force) {
    make("slider_crank", {torque, "0", force}, [](double t) { return std::vector<double>{0.5 + t, -0.8, 0.3}; }, 60);
    scene.draw = {"chain", "torque", "legend"};
    return test::words_of(film().static_layer());
  };
  EXPECT_THAT(scales("10", "1e-6*sin(9*t)"), testing::AllOf(HasSubstr("torque"), Not(HasSubstr("joint force"))));
  EXPECT_THAT(scales("1e-6*sin(9*t)", "10"), testing::AllOf(HasSubstr("joint force"), Not(HasSubstr("torque"))));
  // Negative control: small ones that are no rounding have theirs, and so have the smallest where nothing else acts.
  EXPECT_THAT(scales("10", "0.01*sin(9*t)"), testing::AllOf(HasSubstr("torque"), HasSubstr("joint force")));
  EXPECT_THAT(scales("0", "1e-6*sin(9*t)"), HasSubstr("joint force"));
}

TEST_F(LayerFilm, AnArcThatPassesZeroHasNeitherARingNorAJump) {
  make("rr", {"10*sin(3*t)", "10*(t > 2)"}, test::swing);
  draw({"torque"});
  const Film pictures = film();
  double jump = 0, jump_of_step = 0;
  std::optional<Point> tip_before;
  for (int k = 0; k < run.size(); ++k) {
    const Picture picture = pictures.frame(k);
    const auto drawn = heads(picture, light.torque);
    const Point joint = pictures.camera().project(Vector3d::Zero());
    // The first joint's head is near it; where there is none the arc is a dot.
    Point tip = joint;
    for (const Polygon& head : drawn)
      if (test::distance(head.corners[0], joint) < 0.0585) tip = head.corners[0];
    if (tip_before) jump = std::max(jump, test::distance(tip, *tip_before));
    tip_before = tip;
  }
  // By 9.2 degrees a frame at 60 frames a second, and by a fifth of the radius where that grows: 0.018 H at most.
  EXPECT_LT(jump, 0.018);
  EXPECT_GT(jump, 0.005) << "it moves";
  // Negative control: a torque that jumps does.
  const auto arc_at = [&](int k) { return arcs(pictures.frame(k), light.torque).size(); };
  for (int k = 1; k < run.size(); ++k) jump_of_step += arc_at(k) > arc_at(k - 1) + 0.5;
  EXPECT_GE(jump_of_step, 1);
}

TEST(Rings, NeverLastForLessThanThreeTenthsOfASecondAndAreNeverASurprise) {
  std::uint32_t seed = 1;
  const auto chance = [&seed] { return double((seed = seed * 1664525u + 1013904223u) >> 8) / (1 << 24); };
  int seen = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<double> t;
    std::vector<bool> rests;
    const double stay = 0.80 + 0.199 * chance();
    bool now = chance() < 0.5;
    for (int k = 0; k < 400; ++k) {
      t.push_back(k / 60.0);
      if (chance() > stay) now = !now;
      rests.push_back(now);
    }
    const std::vector<double> rings = rings_along(t, rests);
    for (std::size_t k = 0; k < t.size(); ++k) {
      EXPECT_TRUE(rings[k] == 0 || rests[k]);
      if (k > 0) {
        EXPECT_LE(std::abs(rings[k] - rings[k - 1]), 1 / 60.0 / 0.15 + 1e-9) << "it fades";
      }
      if (rings[k] == 0 || (k > 0 && rings[k - 1] > 0)) continue;
      std::size_t end = k;
      while (end + 1 < t.size() && rings[end + 1] > 0) ++end;
      EXPECT_GE(t[end] - t[k], 0.3 - 3 / 60.0);
      for (std::size_t before = k; before > 0 && t[k] - t[before] < 0.3 - 1e-9; --before) EXPECT_TRUE(rests[before]);
      ++seen;
    }
  }
  EXPECT_GT(seen, 50);
}

// By the time of the motion, not of the film: frames in which it stands still for words, or is slow, do not count more.
TEST(VectorMagnitudes, AreWeighedByHowLongTheyLast) {
  std::vector<Magnitude> run;
  for (int i = 1; i <= 100; ++i) run.push_back({double(i), 0.1});
  EXPECT_DOUBLE_EQ(full_magnitude(run), 95);
  for (int i = 0; i < 60; ++i) run.push_back({99, 0});
  EXPECT_DOUBLE_EQ(full_magnitude(run), 95);
  for (Magnitude& one : run) one.weight = 0;
  EXPECT_DOUBLE_EQ(full_magnitude(run), 99) << "of a picture by itself each counts";
}

TEST(VectorMagnitudes, MakeAScaleThatNoSinglePeakRuins) {
  VectorMagnitudes magnitudes;
  const auto add = [&magnitudes](double value) {
    WorldVector vector;
    vector.value = {0, value, 0};
    magnitudes.add(vector);
  };
  for (int i = 1; i <= 99; ++i) add(1 + i * 1e-3);
  EXPECT_DOUBLE_EQ(magnitudes.full()[std::size_t(VectorKind::velocity)], 1.095) << "the 95th of 99: ceil(94.05)";
  add(50);
  EXPECT_DOUBLE_EQ(magnitudes.full()[std::size_t(VectorKind::velocity)], 1.095) << "the 95th of 100";
  for (int i = 0; i < 1000; ++i) add(1e-6);
  EXPECT_DOUBLE_EQ(magnitudes.full()[std::size_t(VectorKind::velocity)], 1.095) << "round-off does not count";
  std::vector<Magnitude> pulse(19, {5});
  pulse.push_back({1000});
  EXPECT_DOUBLE_EQ(full_magnitude(pulse), 5) << "a pulse does not make all else vanish";
  add(std::nan(""));
  EXPECT_EQ(magnitudes.full()[std::size_t(VectorKind::weight)], 0);
}

TEST_F(LayerFilm, ForcesOfSlidersRunBesideTheirRails) {
  make(
      "pp", {"4", "-2*cos(t)"},
      [](double t) {
        return std::vector<double>{t, std::sin(t)};
      },
      120);
  draw({"torque"});
  const Film pictures = film();
  const double full = test::length(arrows(pictures.frame(0), light.torque).at(0).v());  // at 4 N
  EXPECT_GE(full, kLeastArrows * 0.20 - kLayersRoundOff);
  EXPECT_LE(full, 0.20 + kLayersRoundOff);
  for (const int k : {0, 60}) {
    const double t = run.t[std::size_t(k)];
    const auto drawn = arrows(pictures.frame(k), light.torque);
    ASSERT_EQ(drawn.size(), 2u);
    Workspace ws(simulation.chain);
    compute_kinematics(simulation.chain, ws, run.q_at(k), run.qd_at(k));
    const Vector3d axes[] = {ws.X_WB[1].linear() * simulation.chain.bodies[1].joint.axis,
                             ws.X_WB[2].linear() * simulation.chain.bodies[2].joint.axis};
    const double forces[] = {4, -2 * std::cos(t)};
    for (std::size_t i = 0; i < 2; ++i) {
      const Point along{axes[i].x(), axes[i].y()};
      EXPECT_LT(test::distance(drawn[i].v(), (full * forces[i] / 4) * along), kLayersRoundOff);
      const Point off = drawn[i].tail - pictures.camera().project(ws.X_WB[i + 1].translation());
      EXPECT_NEAR(test::length(off), 0.034, kLayersRoundOff);
      EXPECT_NEAR(off.x * along.x + off.y * along.y, 0, kLayersRoundOff);
    }
  }
}

TEST_F(LayerFilm, ConstraintForceIsDashedAndActsOnTheRobot) {
  make(
      "pp", {"0", "0"},
      [](double t) {
        return std::vector<double>{t, 0};
      },
      120);
  // On a line along x: the multiplier is the force along y that the slider exerts on it.
  simulation.constraints.list = {
      LineConstraint{simulation.chain.frames[std::size_t(simulation.chain.end_effector)].name,
                     Vector3d::Zero(), Vector3d::UnitX()}};
  run.rows = 1;
  for (int k = 0; k < run.size(); ++k) run.lambda.push_back(k < 60 ? 8 : -4);
  draw({"constraint_force", "equation"});
  const Film pictures = film();
  const std::vector<Reaction> reactions = reactions_along(simulation, run).at(0);
  ASSERT_EQ(reactions.size(), 1u);
  EXPECT_NEAR(reactions[0].force.norm(), 8, kLayersRoundOff);
  for (const int k : {0, 100}) {
    const Picture picture = pictures.frame(k);
    const auto drawn = arrows(picture, light.constraint);
    ASSERT_EQ(drawn.size(), 1u);
    const Vector3d force = reactions_along(simulation, run).at(std::size_t(k)).at(0).force;
    // The first dash begins a radius of its round end behind the tail.
    EXPECT_NEAR(test::length(drawn[0].v()), 0.20 * force.norm() / 8 - 0.003, kLayersRoundOff);
    EXPECT_GT(drawn[0].v().y * force.y(), 0);
    const auto dashes =
        test::all_of<Capsule>(picture, [&](const Capsule& c) { return c.paint.fill == light.constraint; });
    EXPECT_GT(dashes.size(), 3u);
    for (const Capsule& dash : dashes) EXPECT_LE(test::distance(dash.a, dash.b) + 0.006, 0.012 + kLayersRoundOff);
  }
  EXPECT_THAT(test::words_of(pictures.static_layer()), HasSubstr("\U0001D706"));  // lambda
}

TEST(VectorPen, CutsWhatTheScaleCannotShowAndSaysSo) {
  VectorScales scales;
  scales.full[std::size_t(VectorKind::velocity)] = 2;
  const VectorPen pen(light_theme(), fonts(), 1, scales);
  for (const double value : {1.0, 2.4, 2.6, 1e9}) {
    WorldVector v;
    v.value = {value, 0, 0};
    v.label = "v";
    Picture picture;
    MarkLabels labels;
    pen.draw(picture, v, Camera{}, 1, 0, labels);
    const auto drawn = arrows(picture, light_theme().velocity);
    ASSERT_EQ(drawn.size(), 1u);
    EXPECT_NEAR(drawn[0].v().x, std::min(0.1 * value, 0.25), kLayersRoundOff);
    EXPECT_EQ(heads(picture, light_theme().velocity).size(), 1u);
    // The shaft, or its two parts and the strokes of the break between them.
    auto lines = test::all_of<Capsule>(picture);
    std::erase_if(lines, [](const Capsule& line) { return !(line.paint.fill == light_theme().velocity); });  // below them their casing
    ASSERT_EQ(lines.size(), value > 2.5 ? 4u : 1u);
    if (value < 2.5) continue;
    // From a break that has just begun to open to one that is open.
    const double gap = lines[1].a.x - lines[0].b.x;
    EXPECT_NEAR(gap, 0.011 * std::min(1.0, (value / 2.5 - 1) / 0.1), kLayersRoundOff);
  }
}

TEST(VectorPen, TurnsInSpaceLieOnTheCircleAsTheCameraSeesIt) {
  VectorScales scales;
  scales.full[std::size_t(VectorKind::torque)] = 1;
  const VectorPen pen(light_theme(), fonts(), 1, scales);
  Camera camera;  // along -z
  WorldVector v;
  v.kind = VectorKind::torque;
  v.axis = Vector3d(1, 0, 1).normalized();
  v.value = v.axis;
  v.label = "tau_1";
  Picture picture;
  MarkLabels labels;
  pen.draw(picture, v, camera, 1, 0, labels);
  const auto paths = test::all_of<Trail>(picture);
  ASSERT_EQ(paths.size(), 2u) << "one is the casing of the other";
  EXPECT_EQ(paths[0].points.size(), paths[1].points.size());
  EXPECT_GT(paths[0].points[0].width, paths[1].points[0].width);
  for (const TrailPoint& p : paths[0].points) {
    // On the plane across the axis z = -x: the circle has depth -x where the page shows x.
    EXPECT_NEAR(std::sqrt(2 * p.p.x * p.p.x + p.p.y * p.p.y), 0.058, kLayersRoundOff);
  }
}

TEST_F(LayerFilm, ThePrintedScaleIsTheOneThatIsDrawn) {
  make_rr();
  draw({"velocity", "gravity", "torque", "legend"});
  const Film pictures = film();
  const Picture page = pictures.static_layer();
  const std::string words = test::words_of(page);
  EXPECT_THAT(words, HasSubstr("torque"));
  EXPECT_THAT(words, HasSubstr("velocity"));
  EXPECT_THAT(words, HasSubstr("weight"));
  std::vector<double> speeds;
  for (int k = 0; k < run.size(); ++k) {
    Workspace ws(simulation.chain);
    compute_kinematics(simulation.chain, ws, run.q_at(k), run.qd_at(k));
    speeds.push_back(frame_velocity(simulation.chain, ws, simulation.chain.end_effector).norm());
  }
  const double fastest = nearly_the_largest(speeds);
  VectorScales scales;
  scales.full[std::size_t(VectorKind::velocity)] = fastest;
  scales.full[std::size_t(VectorKind::weight)] = 9.81;
  for (const ScaleEntry& entry : scale_entries(scales, {VectorKind::velocity, VectorKind::weight}, false, light)) {
    EXPECT_THAT(words, HasSubstr(entry.text));
    const auto marks = arrows(page, entry.color, false);
    ASSERT_EQ(marks.size(), 1u);
    const double value = std::stod(entry.text);  // "5 m/s"
    const VectorKind kind = entry.color == light.velocity ? VectorKind::velocity : VectorKind::weight;
    const double largest = scales.of(kind).full;
    // Arrows are as long as there is room for, and so are their marks.
    constexpr int k = 100;  // where neither is short
    const double shown = test::length(arrows(pictures.frame(k), entry.color, true).at(0).v());
    const double worth = kind == VectorKind::velocity ? speeds[std::size_t(k)] : 9.81;
    EXPECT_NEAR(test::length(marks[0].v()) / value, shown / worth, kLayersRoundOff);
    EXPECT_GE(shown / worth, kLeastArrows * 0.20 / largest - kLayersRoundOff);
    EXPECT_LE(shown / worth, 0.20 / largest + kLayersRoundOff);
    EXPECT_LE(value, largest);
    EXPECT_GT(value, 0.4 * largest);
  }
  // Without the legend the numbers stay and the names go.
  scene.draw.pop_back();
  const std::string bare = test::words_of(film().static_layer());
  EXPECT_THAT(bare, HasSubstr("m/s"));
  EXPECT_THAT(bare, Not(HasSubstr("velocity")));
}

TEST_F(LayerFilm, TheCameraHoldsEveryVectorOfTheClip) {
  make_rr();
  const double bare = film().camera().scale;
  draw({"velocity", "gravity", "torque"});
  const Film pictures = film();
  // Arrows give way to the motion, not the motion to arrows: half of their lengths lies within the margin here, and words beyond their
  // tips, which have other places, took 15 % of the motion's size.
  EXPECT_NEAR(pictures.camera().scale, bare, kLayersRoundOff);
  double nearest = 1;
  for (int k = 0; k < run.size(); ++k) {
    const Picture picture = pictures.frame(k);
    for (const Color color : {light.velocity, light.force, light.torque}) {
      for (const Polygon& head : heads(picture, color)) {
        for (int i = 0; i < 3; ++i) {
          const Point p = head.corners[std::size_t(i)];
          const Rect& area = pictures.scene_area();
          EXPECT_TRUE(test::is_inside(area, p)) << k;
          nearest = std::min({nearest, p.x - area.x0, area.x1 - p.x, p.y - area.y0, area.y1 - p.y});
        }
      }
    }
  }
  // Not by leaving the page empty: some vector comes near to the margin around the fitted box, a label
  // between.
  EXPECT_LT(nearest, 0.16);
}

TEST_F(LayerFilm, CentreOfMassIsTheMeanOfTheMasses) {
  make_rr();
  simulation.chain.bodies[2].inertia.mass = 3;
  draw({"com"});
  const Film pictures = film();
  for (const int k : {0, 77}) {
    const auto q = test::swing(run.t[std::size_t(k)]);
    const Vector3d first(std::cos(q[0]), std::sin(q[0]), 0);
    const Vector3d second = first + Vector3d(std::cos(q[0] + q[1]), std::sin(q[0] + q[1]), 0);
    const Point mean = pictures.camera().project((first + 3 * second) / 4);
    const auto quarters =
        test::all_of<Polygon>(pictures.frame(k), [](const Polygon& p) { return p.count == 8; });
    ASSERT_EQ(quarters.size(), 2u);
    for (const Polygon& quarter : quarters) EXPECT_LT(test::distance(quarter.corners[0], mean), kLayersRoundOff);
  }
}

TEST_F(LayerFilm, FramesHaveTheAxesOfTheirLinks) {
  make_rr();
  draw({"frames"});
  const Film pictures = film();
  const int k = 50;
  const auto q = test::swing(run.t[std::size_t(k)]);
  const Picture picture = pictures.frame(k);
  const auto x_tips = heads(picture, light.axis[0]), y_tips = heads(picture, light.axis[1]);
  ASSERT_EQ(x_tips.size(), 3u);  // two links and the gripper
  ASSERT_EQ(y_tips.size(), 3u);
  const double angle = q[0] + q[1];
  const Point joint = pictures.camera().project({std::cos(q[0]), std::sin(q[0]), 0});
  EXPECT_LT(test::distance(x_tips[1].corners[0] - joint, {0.075 * std::cos(angle), 0.075 * std::sin(angle)}),
            kLayersRoundOff);
  EXPECT_LT(test::distance(y_tips[1].corners[0] - joint, {-0.075 * std::sin(angle), 0.075 * std::cos(angle)}),
            kLayersRoundOff);
  // z looks at the viewer: rings with dots. Letters say which is which, and only y has a tick.
  const auto rings =
      test::all_of<Ellipse>(picture, [&](const Ellipse& e) { return e.paint.stroke == light.axis[2]; });
  EXPECT_EQ(rings.size(), 3u);
  const auto lines = [&](int axis) {
    return test::all_of<Capsule>(
               picture, [&](const Capsule& c) { return c.paint.fill == light.axis[std::size_t(axis)]; })
        .size();
  };
  EXPECT_EQ(lines(0), 3u);
  EXPECT_EQ(lines(1), 6u);
}

TEST(Ghosts, AreEquallySpacedAndFadeWithAge) {
  std::vector<double> times;
  for (int k = 0; k < 200; ++k) times.push_back(frame_time(k, {50, 1}));
  EXPECT_EQ(ghost_spacing({50, 1}), 8);
  const auto all = ghosts_at(times, 100, {50, 1});
  ASSERT_EQ(all.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(all[i].frame, 100 - 8 * int(6 - i));
    EXPECT_EQ(all[i].filled, i >= 3);
  }
  EXPECT_NEAR(all.front().strength, 0.10, 1e-12);
  EXPECT_NEAR(all.back().strength, 0.35, 1e-12);
  EXPECT_TRUE(ghosts_at(times, 7, {50, 1}).empty());
  EXPECT_EQ(ghosts_at(times, 16, {50, 1}).size(), 2u);
  // An instant of a snapshot between the frames shifts no ghost by more than it must.
  times.insert(times.begin() + 90, 1.795);
  EXPECT_EQ(ghosts_at(times, 101, {50, 1}).back().frame, 93);
}

TEST_F(LayerFilm, GhostsStandWhereTheChainStood) {
  make_rr();
  draw({"ghosts"});
  const Film pictures = film();
  const auto is_link = [](const Capsule& c) { return c.paint.stroke_width > 0; };
  const auto now = test::all_of<Capsule>(pictures.frame(200), is_link);
  ASSERT_EQ(now.size(), 14u);  // six ghosts and the chain, two links each
  for (int age = 1; age <= 6; ++age) {
    const auto then = test::all_of<Capsule>(pictures.frame(200 - 10 * age), is_link);
    EXPECT_LT(test::distance(now[std::size_t(12 - 2 * age)].b, then[then.size() - 2].b), kLayersRoundOff);
    EXPECT_EQ(now[std::size_t(12 - 2 * age)].paint.fill.a > 0, age <= 3);
  }
}

TEST_F(LayerFilm, MassMatrixShowsTheNumbersOfTheClosedFormInACornerThatStaysFree) {
  make_rr();
  draw({"mass_matrix", "velocity", "torque"});
  const Film pictures = film();
  const Picture at = pictures.frame(90);
  const auto maps = test::all_of<Cells>(at);
  ASSERT_EQ(maps.size(), 1u);
  const double c = std::cos(test::swing(run.t[90])[1]);
  const std::string words = test::words_of(at);
  for (const double entry : {3 + 2 * c, 1 + c, 1.0}) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", entry);
    EXPECT_THAT(words, HasSubstr(text));
  }
  // Row by row from below: M21, M22, M11, M12. The strongest colour is that of the largest entry.
  EXPECT_EQ(maps[0].colors[0], maps[0].colors[3]);
  EXPECT_EQ(maps[0].rect.x1 <= pictures.scene_area().x1 + 1e-12, true);
  for (int k = 0; k < run.size(); ++k) {
    for (const Item& item : pictures.frame(k).items) {
      const auto* link = std::get_if<Capsule>(&item.shape);
      if (!link || item.clip < 0) continue;
      Point a = link->a, b = link->b;
      EXPECT_FALSE(cut_segment(widened(maps[0].rect, link->radius), a, b)) << k;
    }
  }
}

TEST_F(LayerFilm, AMassMatrixThatFindsNoCornerStandsBesideTheScene) {
  // A full turn of both links leaves no corner: the square of side 4 m fills the page's height.
  make(
      "rr", {"0", "0"},
      [](double t) {
        return std::vector<double>{2 * t, 0};
      },
      240);
  scene.video.width = scene.video.height = 400;
  scene.draw = {"chain"};
  const double without = film().camera().scale;
  draw({"mass_matrix"});
  const Film pictures = film();
  EXPECT_LT(pictures.camera().scale, without);
  EXPECT_GT(test::all_of<Cells>(pictures.frame(0)).at(0).rect.x0, pictures.scene_area().x1);
}

TEST_F(LayerFilm, MassesKeepTheirSignAndTheirScale) {
  const MassMap map(2, "kg m^2", 4, light, fonts(), 1);
  EXPECT_EQ(map.number(-1.234), "\u22121.23");
  EXPECT_EQ(map.number(-0.001), "0.00");
  EXPECT_EQ(map.color_at(0), light.background);
  const Color below = map.color_at(-4), above = map.color_at(4);
  EXPECT_GT(below.b, below.r);
  EXPECT_GT(above.r, above.b);
  EXPECT_EQ(map.color_at(8), above);
  EXPECT_EQ(mass_unit(test::model("pp")), "kg");
  EXPECT_EQ(mass_unit(test::model("rr")), "kg m^2");
}

TEST_F(LayerFilm, TheEquationTakesTheColoursOfItsVectors) {
  make_rr();
  draw({"equation"});
  const auto tau_color = [&] {
    for (const GlyphRun& glyphs : test::all_of<GlyphRun>(film().static_layer()))
      if (glyphs.text == "\U0001D70F" && glyphs.color != light.ink) return glyphs.color;
    return light.ink;
  };
  EXPECT_THAT(test::words_of(film().static_layer()), HasSubstr("\U0001D40C("));
  EXPECT_EQ(tau_color(), light.ink);
  draw({"torque"});
  EXPECT_EQ(tau_color(), light.torque);
}

TEST_F(LayerFilm, OfAMotionWithoutASimulationNothingIsSaidToAct) {
  make_rr();
  draw({"torque", "springs", "target", "constraint_force"});
  const Film pictures(scene, simulation.chain, run, run.size(), fonts());
  EXPECT_TRUE(heads(pictures.frame(50), light.torque).empty());
  EXPECT_FALSE(heads(film().frame(50), light.torque).empty());
}

TEST_F(LayerFilm, DarkPicturesHaveNoLightThemesColours) {
  make_rr();
  scene.theme = ThemeName::dark;
  draw({"velocity", "gravity", "torque", "com", "frames", "ghosts", "ellipse", "legend", "mass_matrix",
        "equation", "scale_bar"});
  const Film pictures = film();
  Picture picture = pictures.static_layer();
  picture.append(pictures.frame(100));
  EXPECT_EQ(picture.background, dark_theme().background);
  for (const GlyphRun& glyphs : test::all_of<GlyphRun>(picture))
    EXPECT_NE(glyphs.color, light.ink) << glyphs.text;
  for (const Capsule& capsule : test::all_of<Capsule>(picture)) {
    EXPECT_NE(capsule.paint.fill, light.ink);
    EXPECT_NE(capsule.paint.stroke, light.ink);
  }
  EXPECT_FALSE(arrows(picture, dark_theme().velocity).empty());
  EXPECT_TRUE(arrows(picture, light.velocity).empty());
}

// Pictures at 640x360, as the pictures of scenes are.
class LayerGolden : public LayerFilm {
 protected:
  void expect_golden(const std::string& name) {
    scene.text_scale = 1.5;
    scene.layout = PageLayout::scene;
    scene.video.width = 640, scene.video.height = 360, scene.video.fps = {};
    for (const ThemeName theme : {ThemeName::light, ThemeName::dark}) {
      scene.theme = theme;
      const Film pictures = film();
      Picture picture = pictures.static_layer();
      picture.append(pictures.frame(72));
      Canvas canvas(640, 360, fonts());
      Image image;
      canvas.draw(picture, image);
      EXPECT_TRUE(matches_golden(image, name + "_" + to_string(theme), {.max = 24, .mean = 0.05}));
    }
  }
};

TEST_F(LayerGolden, RrWithAllThatActsOnIt) {
  make_rr();
  scene.title = "All that acts on an RR";
  scene.draw = {"chain",    "trail",   "ghosts", "com",  "torque",
                "velocity", "gravity", "legend", "time", "title"};
  expect_golden("layers_rr");
}

TEST_F(LayerGolden, PpWithForcesAndItsMassMatrix) {
  make(
      "pp", {"4", "-2*cos(3*t)"},
      [](double t) {
        return std::vector<double>{0.8 * t, 0.5 * std::sin(3 * t)};
      },
      120);
  scene.title = "Forces of sliders";
  scene.draw = {"chain",    "frames", "torque", "velocity", "mass_matrix",
                "equation", "legend", "time",   "title"};
  expect_golden("layers_pp");
}

}  // namespace
}  // namespace chainreel
