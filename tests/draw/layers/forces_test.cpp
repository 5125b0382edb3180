// Forces of a film and their words: torques, pushes, what constraints exert, at one scale and at the places where they act.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/cause.hpp"
#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/layers/devices.hpp"
#include "draw/layers/vectors.hpp"
#include "draw/page/coils.hpp"
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

// "8 - qd1": the arc is the whole torque, also where a damper stands at the joint: it turns as tau does.
TEST(TorqueLayer, BesideADamperIsTheWholeTorque) {
  const Cause cause("slider_crank", {"draw=[chain, torque, springs]"}), alone("slider_crank", {"draw=[chain, torque]"});
  const Film pictures = cause.film(), others = alone.film();
  EXPECT_FALSE(has_words(pictures.still(30), "8N") || has_words(pictures.still(30), "8 N"));
  // Its sense: the arc goes round the crank's pivot the way in which the torque turns.
  const Point pivot = pictures.camera().project(Vector3d::Zero());
  int seen = 0, against = 0;
  for (int k = 0; k < cause.run.size(); ++k) {
    const double tau = 8 - cause.run.qd_at(k)[0];
    if (std::abs(tau) < 1) continue;
    for (const Film* film : {&pictures, &others}) {
      const auto heads = test::all_of<Polygon>(film->frame(k), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().torque; });
      ASSERT_EQ(heads.size(), 1u) << k;
      const Point tip = heads[0].corners[0], base = 0.5 * (heads[0].corners[1] + heads[0].corners[2]);
      EXPECT_GT(cross(base - pivot, tip - pivot) * tau, 0) << k;
    }
    ++seen;
    against += tau < 0;
  }
  EXPECT_GT(seen, 60);
  EXPECT_GT(against, 0) << "the damper wins somewhere, or this test is none";
}

// An arc that is cut says how large the torque is; others are read by the scale.
TEST(TorqueLayer, WritesTheValueBesideAnArrowThatIsCut) {
  const Cause cause("rr_torque", {"torque=[\"1 + 30*exp(-(20*(t - 0.5))^2)\", 0]", "draw=[chain, torque]"}, 1);
  const Film pictures = cause.film();
  EXPECT_NE(test::words_of(pictures.still(30)).find("=31Nm"), std::string::npos) << test::words_of(pictures.still(30));
  EXPECT_EQ(test::words_of(pictures.still(55)).find("="), std::string::npos);
}

// What the ties exert has the names of the plotted multipliers: a vector of those that act in several directions, arrows side by side of those
// that act in one.
TEST(ConstraintForces, AreNamedLikeTheirCurves) {
  const Cause four_bar("four_bar", {"layout=scene", "draw=[+constraint_force]"}), pen("pen", {"layout=scene"});
  const auto dashes = [](const Picture& picture) {
    return test::all_of<Polygon>(picture, [](const Polygon& p) { return p.paint.fill == light().constraint; }).size();
  };
  EXPECT_GT(dashes(four_bar.film().still(44)), 0u);
  const std::string words = test::words_of(four_bar.film().still(44));
  EXPECT_NE(words.find("(\U0001D706"), std::string::npos) << words;
  EXPECT_EQ(words.find("+"), std::string::npos) << words;
  const Cause twice("rrr_free", {"layout=scene", "start={q: [90deg, -90deg, -30deg]}", "constraints=[{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}, {line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]"}, 1);
  const Film film = twice.film();
  const std::string first = test::words_of(film.still(0));
  for (const char* name : {"\u2212\U0001D7061", "\u2212\U0001D7062"}) EXPECT_NE(first.find(name), std::string::npos) << first;
  for (int k = 0; k < 60; ++k) {
    const std::string at_k = test::words_of(film.still(k));
    EXPECT_EQ(at_k.find("+"), std::string::npos) << at_k;
    EXPECT_EQ(at_k.find(","), std::string::npos) << at_k;
  }
  // Their heads stand side by side.
  std::vector<Point> heads;
  for (const Polygon& head : test::all_of<Polygon>(film.still(0), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().constraint && p.corners[0].y > 0.12; }))
    heads.push_back(head.corners[0]);
  ASSERT_EQ(heads.size(), 2u);
  EXPECT_NEAR(test::distance(heads[0], heads[1]), 0.02, 1e-6) << "page units, of the lanes; equal lengths";
  EXPECT_GT(dashes(pen.film().still(40)), 0u);
  // Of equal lines that run against one another each has its arrow, too.
  const Cause against("rrr_free", {"layout=scene", "start={q: [90deg, -90deg, -30deg]}", "constraints=[{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}, {line: {frame: gripper, point: [0, 0.5], direction: [-1, 0]}}]"}, 1);
  const std::string apart = test::words_of(against.film().still(0));
  for (const char* name : {"\u2212\U0001D7061", "\u2212\U0001D7062"}) EXPECT_NE(apart.find(name), std::string::npos) << apart;
}

// Near singular poses ties have needles: what they exert most of the time has an arrow for all that, and needles have numbers.
TEST(ConstraintForces, HaveAScaleThatNeedlesDoNotDecideOn) {
  const auto sizes = [](double usual, double peak, int peaks) {
    std::vector<Magnitude> all(100, {usual, 1});
    for (int k = 0; k < peaks; ++k) all[std::size_t(k)].size = peak;
    return all;
  };
  EXPECT_DOUBLE_EQ(without_needles(100, sizes(2, 100, 8)), 4.8);
  EXPECT_DOUBLE_EQ(without_needles(10, sizes(2, 10, 8)), 4.8) << "a fifth of it is a dot where arrows have half of their lengths";
  EXPECT_DOUBLE_EQ(without_needles(5, sizes(2, 5, 8)), 5) << "two fifths are seen then, too";
  EXPECT_DOUBLE_EQ(without_needles(100, sizes(0, 100, 8)), 100) << "nothing acts else";
}

// Where constraints lose rank a film says so: in its notes, by a dashed line in its plot, and by that pose behind the chain.
TEST(ChangePoint, IsShownAtOtherInstants) {
  const Cause falls("four_bar_singular", {}, 1);
  std::vector<double> lost;
  for (const RankLoss& loss : rank_losses_of(falls.simulation, falls.run)) lost.push_back(loss.t);
  ASSERT_FALSE(lost.empty());
  const auto film = [&](const std::vector<double>& instants) {
    PanelRun run{falls.scene, falls.simulation.chain, falls.run, &falls.simulation};
    run.change_points = instants;
    return Film(falls.scene, {run}, falls.times, falls.fonts);
  };
  const Film told = film(lost), plain = film({});
  const int then = int(std::lround(60 * lost.front()));
  EXPECT_EQ(told.panel(0).note(then - 2), "");
  EXPECT_EQ(told.panel(0).note(then + 1).find("t = 0.39 s: constraints lose rank"), 0u) << told.panel(0).note(then + 1);
  EXPECT_EQ(plain.panel(0).note(then + 1), "");
  const auto extra = [&](int k) { return int(told.frame(k).items.size()) - int(plain.frame(k).items.size()); };
  EXPECT_GT(extra(0), 0) << "a pale pose";
  EXPECT_LT(extra(then), extra(0)) << "where the chain is there itself it is none";
  const auto dashed = [](const Film& one) { return wires(one.static_layer(), light().muted).size(); };
  EXPECT_EQ(dashed(told) - dashed(plain), std::size_t(std::ranges::count_if(lost, [](double t) { return t < 1; }))) << "across the plot";
  // One of these lines says what they all are, the first.
  const auto names = [](const Film& one) { return test::all_of<GlyphRun>(one.static_layer(), [](const GlyphRun& run) { return run.text == "rank loss"; }); };
  ASSERT_GT(lost.size(), 1u);
  ASSERT_EQ(names(told).size(), 1u);
  EXPECT_TRUE(names(plain).empty()) << "negative control";
  std::vector<Trail> lines = wires(told.static_layer(), light().muted);
  const auto left = std::ranges::min(lines, {}, [](const Trail& line) { return line.points.front().p.x; }).points.front().p.x;
  const GlyphRun name = names(told).front();
  EXPECT_LT(name.origin.x, left + kCauseRoundOff);
  EXPECT_GT(name.origin.x + name.glyphs.back().x + name.size, left);
}

// A tenth of the largest is less than the disc of the pin in which it begins, and was not seen at all.
TEST(ConstraintForces, ThatAreSmallStandBesideTheDiscOfTheirJoint) {
  const Cause cause("slider_crank");
  const Film pictures = cause.film();
  for (const int k : {18, 24, 75}) {
    const Workspace ws = [&] {
      Workspace at(cause.simulation.chain);
      compute_kinematics(cause.simulation.chain, at, cause.run.q_at(k), cause.run.qd_at(k));
      return at;
    }();
    const Point pin = pictures.camera().project(tip_position(cause.simulation.chain, ws));
    const auto heads = test::all_of<Polygon>(pictures.frame(k), [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().constraint; });
    ASSERT_EQ(heads.size(), 1u) << k;
    for (int i = 0; i < 3; ++i) EXPECT_GT(test::distance(heads[0].corners[std::size_t(i)], pin), 0.011) << k << ": the disc's radius is 0.011 H";
  }
}

// A name that stands off is led to the arrow, or to the joint at which that begins: a line that ends between them leads to nothing.
TEST(ConstraintForces, HaveNamesThatLeadToThem) {
  int led = 0;
  for (const auto& size : {std::vector<std::string>{"video.width=1080", "video.height=1920"}, {"video.width=480", "video.height=270"}}) {
    const Cause cause("four_bar_singular", size, 4);
    const Film pictures = cause.film();
    for (int k = 0; k < int(cause.times.size()); k += 6) {
      const Picture frame = pictures.frame(k);
      const auto heads = test::all_of<Polygon>(frame, [](const Polygon& p) { return p.count == 3 && p.paint.fill == light().constraint; });
      const auto lines = test::all_of<Capsule>(frame, [](const Capsule& c) { return c.paint.fill == light().constraint && c.radius < 0.001; });  // thinner than any arrow; 0.026 H from it, 0.036 where marks are larger
      for (const Capsule& line : lines) {
        Workspace ws(cause.simulation.chain);
        compute_kinematics(cause.simulation.chain, ws, cause.run.q_at(k), cause.run.qd_at(k));
        double least = norm(line.b - pictures.camera().project(frame_position(cause.simulation.chain, ws, find_frame(cause.simulation.chain, "rocker_end"))));
        for (const Polygon& head : heads) least = std::min(least, test::distance(line.b, head.corners[0]));
        EXPECT_LT(least, 0.04) << k << " " << size.back();
        ++led;
      }
    }
  }
  EXPECT_GT(led, 0);
}

// A force that pushes its link comes from outside; where it is drawn from its place on, it lies on the link.
TEST(ConstraintForces, EndAtThePlaceThatTheyPush) {
  const Cause pen("pen", {"layout=scene"});
  const Film pictures = pen.film();
  const Chain& chain = pen.simulation.chain;
  Workspace ws(chain);
  for (const int k : {0, 40, 100}) {
    compute_kinematics(chain, ws, pen.run.q_at(k), pen.run.qd_at(k));
    const Point pushed = pictures.camera().project(tip_position(chain, ws));
    for (const Polygon& part : test::all_of<Polygon>(pictures.still(k), [](const Polygon& p) { return p.paint.fill == light().constraint; }))
      if (part.corners[0].y > 0.1) EXPECT_LT(test::box_of(part).y1, pushed.y) << k;  // not its scale's in the foot of the page
  }
}

// Of forces that act together the larger one is longer, whichever layer draws it.
TEST(Forces, AreAtOneScale) {
  const auto longest = [](const Picture& picture, Color color, bool in_foot) {
    double most = 0;
    for (const Capsule& shaft : test::all_of<Capsule>(picture, [&](const Capsule& c) { return c.paint.fill == color && (c.a.y < 0.12) == in_foot; }))
      most = std::max(most, test::distance(shaft.a, shaft.b));
    return most;
  };
  const Cause both("particle", {"torque=[4.905]"}, 0.2);
  const Picture picture = both.film().still(0);
  const double push = longest(picture, light().torque, false), weight = longest(picture, light().force, false);
  ASSERT_GT(push, 0);
  ASSERT_GT(weight, 0);
  EXPECT_LT(push, 0.6 * weight) << "half of it, the heads apart";
  EXPECT_NEAR(longest(picture, light().torque, true), longest(picture, light().force, true), 1e-12) << "one scale is printed";
  // However much smaller one is: of three kinds the smallest had a scale of its own, and was longer than the second.
  const Cause apart("rr_free", {"draw=[+gravity, -g]", "push=[{frame: gripper, force: [0, 400, 0], from: 0, until: 1}, {frame: link1, force: [40, 0, 0], from: 0, until: 1}]"}, 0.2);
  const Picture all = apart.film().still(0);
  std::vector<double> lengths;
  for (const Capsule& shaft : test::all_of<Capsule>(all, [&](const Capsule& c) { return c.paint.fill == light().force && c.a.y > 0.12; }))
    lengths.push_back(test::distance(shaft.a, shaft.b));
  ASSERT_FALSE(lengths.empty());
  EXPECT_GT(std::ranges::max(lengths), 0.05) << "400 N";
  std::ranges::sort(lengths, std::greater());
  if (lengths.size() > 1) EXPECT_LT(lengths[1], 0.2 * lengths[0]) << "40 N and weights of 10 N";
}

// Beside forces that leave no room for their arrows weights are dots with their numbers.
TEST(Forces, ThatAreTooSmallForAnArrowAreDots) {
  const auto dots = [](const Picture& picture) {
    return test::all_of<Ellipse>(picture, [](const Ellipse& dot) { return dot.paint.fill == light().force; }).size();
  };
  const std::vector<std::string> weights{"draw=[+gravity, -g]"};
  const std::string push = "push=[{frame: gripper, force: [0, 40000, 0], from: 0, until: 1}]";
  const Cause alone("rr_free", weights, 0.2), beside("rr_free", {weights[0], push}, 0.2);
  EXPECT_EQ(dots(beside.film().still(0)), 2u);
  EXPECT_THAT(test::words_of(beside.film().still(0)), testing::HasSubstr("9.8"));
  EXPECT_EQ(dots(alone.film().still(0)), 0u) << "arrows say all";
  EXPECT_THAT(test::words_of(alone.film().still(0)), testing::Not(testing::HasSubstr("9.8")));
}

// A velocity along a push is beside it, and both are seen.
TEST(Velocities, StandBesideThePushThatTheyWouldHide) {
  const auto ties = [](const std::string& what) {
    const Cause cause("rr_free", {"draw=[+velocity, -g]", "gravity=[0, 0, 0]", "start.q=[0, 90deg]", what}, 1);
    return test::all_of<Ellipse>(cause.film().still(20), [](const Ellipse& dot) { return dot.paint.fill == light().velocity; }).size();
  };
  EXPECT_EQ(ties("push=[{frame: gripper, force: [-1, 0, 0], from: 0, until: 1}]"), 1u);
  // Negative control: the torques that move it in the same way, J^T F.
  EXPECT_EQ(ties("torque=[1, 1]"), 0u);
}

TEST(Dampers, AreNamedInTheFootWhereTheyTurn) {
  const auto foot = [](const std::vector<std::string>& overrides) {
    return test::words_of(Cause("slider_crank", overrides, 0.2).film().static_layer());
  };
  EXPECT_THAT(foot({}), testing::AllOf(testing::HasSubstr("damper 1\u2009N m s"), testing::HasSubstr("torque 10\u2009N m")));
  EXPECT_THAT(foot({"torque=[\"8 - qd1\", \"-2*qd2\", 0]"}), testing::HasSubstr("dampers")) << "of several strengths";
  EXPECT_THAT(foot({"torque=[8, 0, 0]"}), testing::Not(testing::HasSubstr("damper")));
}

// Across its joint a word would be that of what stands there.
TEST(TorqueWords, StandBesideTheirArcs) {
  const Cause cause("slider_crank", {}, 5);
  const Film pictures = cause.film();
  const Point joint = pictures.camera().project(Vector3d::Zero());
  int above = 0, below = 0;
  for (int k = 0; k < cause.run.size(); ++k) {
    const Picture frame = pictures.frame(k);
    double widest = 0;
    for (const Arc& arc : test::all_of<Arc>(frame, [](const Arc& one) { return one.color == light().torque; }))
      widest = std::max(widest, std::abs(arc.sweep));
    for (const GlyphRun& word : test::all_of<GlyphRun>(frame, [](const GlyphRun& run) { return run.color == light().torque; })) {
      const bool is_below = word.origin.y < joint.y - 0.05;
      (is_below ? below : above) += 1;
      // Below by 45 degrees, which is 50 beyond an end.
      if (is_below) EXPECT_GT(widest, 2 * (135 - 50) * std::numbers::pi / 180 - 0.5) << k << ": but for the angle of the head";
    }
  }
  EXPECT_GT(above, 100);
}

// Whatever pulls there, no word lies on the pose that feedback follows.
TEST(TargetLayer, KeepsWordsOffItsOutline) {
  const Cause cause("rr_free", {"torque={pd: {kp: 20, kd: 2, q: [\"-0.3 + 0.8*sin(t)\", -0.5]}}"}, 3);
  const Film pictures = cause.film();
  const std::vector<double> followed = references_along(cause.simulation, cause.run);
  const Chain& chain = cause.simulation.chain;
  Workspace ws(chain);
  int seen = 0;
  for (int k = 0; k < cause.run.size(); ++k) {
    const std::vector<double> target(followed.begin() + 2 * k, followed.begin() + 2 * k + 2), rest(2);
    compute_kinematics(chain, ws, target, rest);
    for (const StandingWord& word : pictures.words(0, k)) {
      if (!(word.opacity > 0)) continue;
      ++seen;
      for (const LinkSegment& link : pictures.panel(0).motion().skeleton().links) {
        Point a = pictures.camera().project(pose_of(ws, link.body) * link.from), b = pictures.camera().project(pose_of(ws, link.body) * link.to);
        EXPECT_FALSE(cut_segment(word.box, a, b)) << k;
      }
    }
  }
  EXPECT_GT(seen, cause.run.size()) << "the words of both torques most of the time";
}

// Of two joints of which one follows a pose, and the other has a spring of its own or computed torque beside it.
TEST(TargetLayer, IsOfThoseJointsThatFollow) {
  const auto look = [](const std::string& torque) {
    const Cause cause("rr_free", {"torque=" + torque, "draw=[chain, target, springs, torque]", "start.q=[0.5, 0.5]"}, 0.2);
    const Picture picture = cause.film().frame(2);
    struct {
      std::size_t ghosts, coils, spirals;
    } seen{test::all_of<Capsule>(picture, [](const Capsule& c) { return c.paint.stroke_width > 0 && c.paint.fill.a == 0; }).size(), 0, 0};
    for (const Trail& wire : wires(picture, light().torque)) {
      seen.coils += wire.points.size() == 49;
      seen.spirals += wire.points.size() > 90;
    }
    return seen;
  };
  const auto own_spring = look("{pd: {kp: [50, 0], kd: [5, 0], q: [0.2, 0]}, plus: [0, '-30*(q2-1)']}");
  EXPECT_EQ(own_spring.ghosts, 1u);
  EXPECT_EQ(own_spring.coils, 1u);
  EXPECT_EQ(own_spring.spirals, 1u);
  const auto two_springs = look("{pd: {kp: [50, 20], kd: [5, 1], q: [0.2, 0.9]}, plus: ['-30*(q1-1)', 0], gravity_compensation: true}");
  EXPECT_EQ(two_springs.ghosts, 2u);
  EXPECT_EQ(two_springs.coils, 1u);
  EXPECT_EQ(two_springs.spirals, 0u);
  const auto by_model = look("[{computed_torque: {kp: 100, kd: 20, q: 1}}, '-3*q2']");
  EXPECT_EQ(by_model.ghosts, 1u);
  EXPECT_EQ(by_model.spirals, 1u);
  // Negative control: computed torque of the whole chain has all of it follow.
  EXPECT_EQ(look("{computed_torque: {kp: 100, kd: 20, q: [1, 0]}}").ghosts, 2u);
}

// A wrist: joint 2 has joint 3 in its place, behind which the hand begins, which goes along y where all is zero.
TEST(AngleLayer, OfAJointWithoutALinkIsAlongTheNextOne) {
  const auto zero_of = [](const std::string& dh) {
    const Cause cause("rr_free", {"model={dh: " + dh + "}", "start={q: [0, 0.4, 0.9]}", "torque=[0, 0, 0]", "draw=[chain, angles]", "camera={azimuth: 0deg, elevation: 0deg}"}, 0.1);
    const Film film = cause.film();
    const StagedRun& motion = film.panel(0).motion();
    return joint_zero(motion.chain(), motion.skeleton(), motion.pose_at(0), 2).along;
  };
  // The last row turns the hand by a quarter about the axis of joint 2.
  const Eigen::Vector3d turned = zero_of("[[0.5, 0, 0, 0], [0, 0, 0, 90deg], [0.3, 0, 0, 0]]"), straight = zero_of("[[0.5, 0, 0, 0], [0, 0, 0, 0], [0.3, 0, 0, 0]]");
  EXPECT_NEAR(turned.dot(straight), 0, kCauseRoundOff);
  EXPECT_NEAR(zero_of("[[0.5, 0, 0, 0], [0.2, 0, 0, 0], [0.3, 0, 0, 0]]").dot(straight), 1, kCauseRoundOff) << "negative control: with a link of its own";
}

// By rule the coordinates of springs are told where nothing else acts, in the units of their own joints.
TEST(StoryOfSprings, IsToldWhereNothingElseActs) {
  const auto page = [](const std::string& model, const std::string& start, const std::string& torque) {
    return Cause("rr_free", {"model=" + model, "start=" + start, "gravity=[0, 0, 0]", "torque=" + torque}, 0.3).film().static_layer();
  };
  const Picture slider = page("{links: [0.5], masses: [1], joints: P}", "{q: [0.3]}", "['-40*q1']");
  EXPECT_TRUE(has_words(slider, "[m]"));
  EXPECT_FALSE(has_words(slider, "rad"));
  const std::string two = "{links: [0.5, 0.4], masses: [2, 1]}", start = "{q: [0.5, 0.5]}";
  for (const char* torque : {"[{pd: {kp: 10, q: 0.5, kd: 1}}, '-3*q2 - qd2']", "[{computed_torque: {kp: 100, kd: 20, q: 1}}, '-3*q2']", "['sin(t)', '-3*q2']"}) {
    const Picture both = page(two, start, torque);
    EXPECT_TRUE(has_words(both, "[N m]")) << torque;
    EXPECT_FALSE(has_words(both, "[rad]")) << torque;
  }
  EXPECT_TRUE(has_words(page(two, start, "[0, '-3*q2']"), "[rad]")) << "negative control: a spring alone";
  EXPECT_TRUE(has_words(page(two, "{q: [0.5, 0.5]}", "['-2*q1', '-3*q2']"), "[rad]"));
}

// Spirals end at their link and at their pin however often they are wound up or unwound, in pieces that look round.
TEST(SpringLayer, HoldsSpiralsOfManyTurnsAtBothEnds) {
  const PageTurn turn{{0, 0}, {1, 0}, {0, 1}};
  const Color red{1, 0, 0, 1};
  const auto spiral = [&](double q) {
    Picture picture;
    draw_spiral(picture, turn, q, 0, 1, red, 0, {});
    return test::all_of<Trail>(picture);
  };
  const auto turned = [](const std::vector<Trail>& parts) {
    double sum = 0, most = 0;
    for (const Trail& part : parts)
      for (std::size_t i = 1; i < part.points.size(); ++i) {
        const Point a = part.points[i - 1].p, b = part.points[i].p;
        sum += std::abs(std::atan2(cross(a, b), dot(a, b)));
        most = std::max(most, std::abs(std::atan2(cross(a, b), dot(a, b))));
      }
    EXPECT_LT(most, 0.16);
    return sum;
  };
  for (const double q : {-1e4, -1000.3, -40.0, -13.0, -12.0, -3.0, 0.0, 3.0, 15.0, 15.8, 40.0, 777.7}) {
    const std::vector<Trail> parts = spiral(q);
    const bool has_more = std::abs(5 * std::numbers::pi - q) > 9 * std::numbers::pi;
    ASSERT_EQ(parts.size(), has_more ? 2u : 1u) << q;
    const Point in = parts.front().points.front().p, out = parts.back().points.back().p;
    EXPECT_NEAR(std::remainder(std::atan2(in.y, in.x) - q, 2 * std::numbers::pi), 0, kCauseRoundOff) << q;
    EXPECT_NEAR(std::remainder(std::atan2(out.y, out.x) - std::numbers::pi, 2 * std::numbers::pi), 0, kCauseRoundOff) << q;
    EXPECT_NEAR(norm(out), kSpiralOuter, kCauseRoundOff) << q;
    EXPECT_LE(turned(parts), 9 * std::numbers::pi + kCauseRoundOff) << q;
    // Its ends beside the gap fade, and those at link and pin do not.
    if (has_more && q != -13) {
      EXPECT_LT(parts.front().points.back().alpha, 0.35) << q;
      EXPECT_LT(parts.back().points.front().alpha, 0.35) << q;
    }
    EXPECT_EQ(parts.front().points.front().alpha, 1) << q;
    EXPECT_EQ(parts.back().points.back().alpha, 1) << q;
  }
  EXPECT_NEAR(turned(spiral(0)), 5 * std::numbers::pi, 1e-6) << "negative control: at rest it is whole";
}

// In a film words come and go within some frames; a picture alone has them in full.
TEST(Stills, HaveWordsInFull) {
  const Cause cause("rr_torque", {"layout=scene"}, 4);
  const Film pictures = cause.film();
  const auto pale = [](const Picture& picture) {
    return test::all_of<GlyphRun>(picture, [](const GlyphRun& run) { return run.color.a > 0 && run.color.a < 1; }).size();
  };
  int fading = 0;
  for (int k = 0; k < cause.run.size(); ++k) {
    fading += pale(pictures.frame(k)) > 0;
    EXPECT_EQ(pale(pictures.still(k)), 0u) << k;
  }
  EXPECT_GT(fading, 0) << "else this shows nothing";
}

// A film leaves names out that would run too fast to be read; in a picture nothing runs.
TEST(Stills, HaveNamesThatTheFilmLeavesOut) {
  const Cause cause("rrr_torque", {"layout=scene", "method=dop853", "tolerance=1e-9"}, 3);
  const Film pictures = cause.film();
  const auto letters = [](const Picture& picture) {
    return test::all_of<GlyphRun>(picture, [](const GlyphRun& run) { return run.color.a > 0; }).size();
  };
  int lacking = 0, gained = 0;
  for (int k = 0; k < cause.run.size(); ++k) {
    const std::vector<StandingWord> words = pictures.words(0, k);
    if (std::none_of(words.begin(), words.end(), [](const StandingWord& word) { return !(word.opacity > 0); })) continue;
    ++lacking;
    gained += letters(pictures.still(k)) > letters(pictures.frame(k));
  }
  EXPECT_GT(lacking, 10) << "else this shows nothing";
  EXPECT_GT(gained, 0.9 * lacking) << lacking << ": some have no room";
}

}  // namespace
}  // namespace chainreel
