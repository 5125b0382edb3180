// What a viewer sees of bodies that turn about their own frames, and what is promised of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "dynamics/kinematics.hpp"
#include "sim/runs.hpp"
#include "sim/choice/choose_method.hpp"
#include "sim/choice/deviation.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct RowLink {
  JointKind kind = JointKind::revolute;
  double mass = 1;
  Vector3d com = Vector3d::Zero();
  Vector3d moments = Vector3d::Zero();
  Vector3d box = Vector3d::Zero();  // edges, around the centre of mass; none: without a shape
  Vector3d origin = Vector3d::Zero();
};

const Vector3d kNone = Vector3d::Zero();

// A row of links, whose axes point along z; without weight, at rest.
Simulation row_of(const std::vector<RowLink>& links, const std::vector<std::string>& torque, double duration) {
  Simulation run;
  run.outline.points.resize(1);
  for (const RowLink& link : links) {
    Body body;
    body.name = body.joint.name = "j" + std::to_string(run.chain.bodies.size());
    body.parent = int(run.chain.bodies.size()) - 1;
    body.joint.kind = link.kind;
    if (link.kind == JointKind::prismatic) body.joint.axis = Vector3d::UnitX();
    body.joint.X_PJ.translation() = link.origin;
    body.inertia = {link.mass, link.com, link.moments.asDiagonal()};
    run.chain.bodies.push_back(body);
    run.outline.points.emplace_back();
    if (link.box.isZero(0)) continue;
    for (int i = 0; i < 8; ++i)
      run.outline.points.back().push_back(
          link.com + 0.5 * Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(link.box));
  }
  run.chain.gravity.setZero();
  test::finish(run.chain);
  run.chain.leaf_frames.clear();
  run.chain.end_effector = -1;
  run.q0 = zero_configuration(run.chain);
  run.qd0.assign(std::size_t(run.chain.nv), 0);
  std::vector<TorqueEntry> entries(run.qd0.size());
  for (std::size_t i = 0; i < torque.size(); ++i) entries[i].text = torque[i];
  run.torque = make_torque_law(run.chain, entries, {});
  run.duration = duration;
  return run;
}

std::vector<double> frames_at_60(double end) {
  return instants(end, 1.0 / 60);
}

// The last frame by the setting in the run, and by dop853 at 1e-13.
std::pair<Trajectory, Trajectory> chosen_and_exact(Simulation& run) {
  const std::vector<double> times = frames_at_60(run.duration);
  Trajectory chosen = simulate(run, times);
  apply({&find_method("dop853"), {1e-13, 0}, 0}, run);
  return {std::move(chosen), simulate(run, times)};
}

double largest_difference(const Trajectory& a, const Trajectory& b, std::size_t i) {
  double largest = 0;
  for (int k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a.q_at(k)[i] - b.q_at(k)[i]));
  return largest;
}

const RowLink kBar{JointKind::revolute, 1, {0.5, 0, 0}, {0.001, 0.0833, 0.0833}, {1, 0.05, 0.05}, kNone};

// Its frame stands still: 42 rad off and "0 px" was said.
TEST(SeenPoints, HoldTheFarEndOfABarWithoutATip) {
  for (const bool has_shape : {true, false}) {
    RowLink bar = kBar;
    if (!has_shape) bar.box.setZero();
    Simulation run = row_of({bar}, {"3*sin(2*t) - 0.3*qd1"}, 5);
    const Choice choice = choose_method(run, {0.1, AccuracyUnit::px}, frames_at_60(5));
    EXPECT_TRUE(choice.is_met);
    EXPECT_GT(choice.best.error, 1e-6);
    const auto [chosen, exact] = chosen_and_exact(run);
    // The picture is at most 2.1 m high; its far end is 1 m away.
    EXPECT_LT(largest_difference(chosen, exact, 0), 0.1 * 2.1 * 1.12 / 1080) << has_shape;
  }
}

// A wheel, drawn 4 m wide though its mass lies close to its hub: 2 m of lever at 0.1 px of a picture 6 m high.
TEST(SeenPoints, HoldTheRimOfAWheel) {
  const RowLink wheel{JointKind::revolute, 0.5, {0, 0, 0}, {0.001, 0.001, 0.002}, {4, 0.1, 0.02}, {1, 0, 0}};
  Simulation run = row_of({kBar, wheel}, {"0", "0.3*cos(20*t)"}, 5);
  choose_method(run, {0.1, AccuracyUnit::px}, frames_at_60(5));
  const auto [chosen, exact] = chosen_and_exact(run);
  EXPECT_LT(largest_difference(chosen, exact, 1), 0.1 * 6.1 * 1.12 / 1080 / 2);
}

TEST(SeenPoints, HoldTheOrientationOfABodyThatTumblesOnThePlace) {
  RowLink body{JointKind::floating, 1, {0, 0, 0}, {0.01, 0.02, 0.03}, {1, 0.5, 0.2}, kNone};
  for (const char* accuracy : {"0.1 px", "1e-3 rad"}) {
    Simulation run = row_of({body}, {}, 10);
    run.qd0 = {0, 0, 0, 0.01, 10, 0.01};
    choose_method(run, parse_accuracy(accuracy), frames_at_60(10));
    const auto [chosen, exact] = chosen_and_exact(run);
    Deviation angle(run, {1, AccuracyUnit::rad}, motion_size(run, exact));
    // 0.1 px of a picture 1.14 m high, 0.57 m from the middle; 10 % for the judge.
    EXPECT_LT(angle.largest(chosen, exact, exact.size()), accuracy[0] == '0' ? 2.3e-4 : 1.1e-3) << accuracy;
    EXPECT_GT(angle.largest(chosen, exact, exact.size()), 0);
  }
}

// A rod is the box whose ends are its own.
TEST(SeenPoints, TakeTheUniformBoxOfABodyWithoutShapes) {
  const RowLink rod{JointKind::revolute, 2, {0.5, 0, 0}, {0, 2.0 / 12, 2.0 / 12}, kNone, kNone};
  Simulation run = row_of({rod}, {}, 1);
  Workspace ws(run.chain);
  compute_kinematics(run.chain, ws, run.q0, run.qd0);
  std::vector<Vector3d> places;
  SeenPoints(run).read(ws, places);
  double most = 0;
  for (const Vector3d& place : places) {
    most = std::max(most, place.x());
    EXPECT_LT(std::hypot(place.y(), place.z()), 1e-15);
  }
  EXPECT_NEAR(most, 1, 1e-15);
}

// A point mass on its own axis, which alone has no size at all, and one that is drawn.
TEST(SeenPoints, NameTheFreedomsThatMoveNothing) {
  const RowLink point{JointKind::revolute, 1e-3, {0, 0, 0}, {0, 0, 0}, kNone, {1, 0, 0}};
  Simulation run = row_of({kBar, point}, {}, 1);
  Trajectory still;
  still.nq = still.nv = 2;
  still.t = {0}, still.q = run.q0, still.qd = run.qd0;
  EXPECT_THAT(unseen_freedoms(run, still), ElementsAre("j2"));
  RowLink drawn = point;
  drawn.box = {0.1, 0.1, 0.1};
  EXPECT_THAT(unseen_freedoms(row_of({kBar, drawn}, {}, 1), still), IsEmpty());
}

// What turns about itself has no bars that a picture could fit, and what moves by a hair is seen as large as it is.
TEST(MotionSize, IsThatOfTheBodiesWhereBarsHaveNone) {
  const RowLink wheel{JointKind::revolute, 1, {0, 0, 0}, {0.1, 0.1, 0.2}, {0.8, 0.6, 0.1}, kNone};
  Simulation run = row_of({wheel}, {"1"}, 3);
  run.method = &find_method("rk4");
  const MotionSize size = motion_size(run, simulate(run, frames_at_60(3)));
  EXPECT_NEAR(size.bodies.metres_per_px, 1.12 / 1080, 1e-5);  // a circle of 1 m, hit by frames
  EXPECT_EQ(size.bars.metres_per_px, 1.0 / 1080);
}

TEST(Deviation, InRadJudgesSlidersAndBasesByTheSizeOfTheMotion) {
  const RowLink cart{JointKind::prismatic, 1, {0, 0, 0}, {0, 0, 0}, kNone, kNone};
  Simulation run = row_of({cart, kBar}, {}, 1);
  Trajectory a;
  a.nq = a.nv = 2;
  a.t = {0}, a.q = {0, 0}, a.qd = {0, 0};
  Trajectory b = a;
  MotionSize size;
  size.bodies.diagonal = 4;
  b.q = {0.1, 0};
  EXPECT_NEAR(Deviation(run, {1, AccuracyUnit::rad}, size).at(a, b, 0), 0.025, 1e-15);
  b.q = {0.1, 0.2};
  EXPECT_NEAR(Deviation(run, {1, AccuracyUnit::rad}, size).at(a, b, 0), 0.2, 1e-15);
  RowLink floating = kBar;
  floating.kind = JointKind::floating;
  Simulation base = row_of({floating}, {}, 1);
  a.nq = b.nq = 7;
  a.q = {0, 0, 0, 0, 0, 0, 1};
  b.q = {0, 0, 0, 0, 0, -std::sin(0.15), -std::cos(0.15)};  // the same turn as its negative
  EXPECT_NEAR(Deviation(base, {1, AccuracyUnit::rad}, size).at(a, b, 0), 0.3, 1e-15);
  b.q = {2, 0, 0, 0, 0, 0, 1};
  EXPECT_NEAR(Deviation(base, {1, AccuracyUnit::rad}, size).at(a, b, 0), 0.5, 1e-15);
}

TEST(ChooseMethod, RefusesRadiansWhereNothingTurns) {
  Simulation run = run_of("pp", {"0", "-100*y_G"}, 1);
  try {
    choose_method(run, {1e-6, AccuracyUnit::rad}, frames_at_60(1));
    FAIL() << "angles of a chain of sliders were promised";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("ask for m, px or relative"));
  }
}

}  // namespace
}  // namespace chainreel
