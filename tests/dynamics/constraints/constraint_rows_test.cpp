// phi, Jc and Jc_dot qd of every kind of constraint.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "dynamics/constraints/constrained_cases.hpp"
#include "dynamics/kinematics.hpp"
#include "model/read_chain.hpp"

namespace chainreel::test {
namespace {

// The largest differences of Jc qd against the rate of phi, and of Jc_dot qd against the rate of Jc qd, along
// the motion with constant qd. Central differences with h = 1e-5 are wrong by h^2/6 of a third derivative
// (some 100 here: 1e-8) and by 2^-52/h = 1e-11 of the size.
struct Differences {
  double rate = 0, acceleration = 0;
};
constexpr double kStep = 1e-5;
constexpr double kDifferenceError = 1e-7;

Differences differences_of(Tied& tied, const State& s) {
  const auto at = [&](double h) {
    std::vector<double> q = s.q;
    advance(tied.chain, q, s.qd, h);
    compute_constraints(tied.chain, tied.ws, tied.set, tied.cws, q, s.qd);
    return std::pair<Eigen::VectorXd, Eigen::VectorXd>(tied.phi(), tied.Jc() * as_vector(s.qd));
  };
  const auto after = at(kStep), before = at(-kStep), now = at(0);
  const Eigen::VectorXd phi_rate = (after.first - before.first) / (2 * kStep);
  const Eigen::VectorXd v_rate = (after.second - before.second) / (2 * kStep);
  return {(phi_rate - now.second).cwiseAbs().maxCoeff(), (v_rate - tied.Jcd_qd()).cwiseAbs().maxCoeff()};
}

// Every kind, between the tip and bodies on other branches.
std::vector<Constraint> of_every_kind(const Chain& chain, Random& random) {
  const std::string a = "tip", b = "b2";
  std::vector<Constraint> all{PointConstraint{a, random.vector(1)},
                              PlaneConstraint{b, random.vector(1), random.unit_vector()},
                              DistanceConstraint{a, b, 0.7}, CloseConstraint{a, "b1", Closure::weld},
                              CloseConstraint{b, a, Closure::axis, random.unit_vector()}};
  std::vector<LinearConstraint::Term> terms;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind == JointKind::floating) continue;
    terms.push_back({chain.coordinate_names[std::size_t(joint.v_index)], random.between(-1, 1)});
  }
  all.push_back(JointConstraint{terms.front().coordinate, 0.3});
  all.push_back(LinearConstraint{terms, -0.2});
  if (!chain.planar) {
    all.push_back(LineConstraint{a, random.vector(1), random.unit_vector()});
    return all;
  }
  const Plane& plane = chain.planar->plane;
  all.push_back(LineConstraint{a, random.vector(1), plane.ex * 0.3 - plane.ey});
  all.push_back(CurveConstraint{b, std::make_shared<Ellipse>(6, 5, Eigen::Vector2d(0.3, -0.2)), 0.5});
  return all;
}

TEST(ConstraintRowsTest, AreTheDerivativesOfPhiInThePlane) {
  Random random(501);
  for (int k = 0; k < 20; ++k) {
    // Frames of a plane's bodies become parallel where their axes are: turned about the plane's normal alone.
    Chain chain =
        random_planar_tree(std::uint64_t(510 + k), {.bodies = 6, .prismatic = 0.2, .mimic = 0.2}, k % 2);
    const Frame tip = chain.frames.back();
    const auto& zero = chain.planar->X_WB_zero;
    for (Frame& frame : chain.frames)
      frame.X_BF.linear() = zero[std::size_t(frame.body)].linear().transpose();
    Tied tied(chain, of_every_kind(chain, random));
    const Differences d = differences_of(tied, random_state(chain, random));
    EXPECT_LT(d.rate, kDifferenceError) << chain.name;
    EXPECT_LT(d.acceleration, kDifferenceError) << chain.name;
  }
}

TEST(ConstraintRowsTest, AreTheDerivativesOfPhiInSpace) {
  Random random(502);
  for (int k = 0; k < 20; ++k) {
    const Chain chain = random_tree(
        std::uint64_t(540 + k), {.bodies = 6, .floating_base = k % 2 == 0, .floating = 0.1, .mimic = 0.2});
    Tied tied(chain, of_every_kind(chain, random));
    const Differences d = differences_of(tied, random_state(chain, random));
    EXPECT_LT(d.rate, kDifferenceError) << chain.name;
    EXPECT_LT(d.acceleration, kDifferenceError) << chain.name;
  }
}

// The comparison sees a wrong acceleration: that of a motion one per cent faster.
TEST(ConstraintRowsTest, DifferencesNoticeAnotherSpeed) {
  Random random(503);
  const Chain chain = random_tree(560, {.bodies = 6});
  Tied tied(chain, of_every_kind(chain, random));
  const State s = random_state(chain, random);
  differences_of(tied, s);
  const Eigen::VectorXd right = tied.Jcd_qd();
  std::vector<double> faster = s.qd;
  for (double& rate : faster) rate *= 1.01;
  compute_constraints(chain, tied.ws, tied.set, tied.cws, s.q, faster);
  EXPECT_GT((tied.Jcd_qd() - right).cwiseAbs().maxCoeff(), 100 * kDifferenceError);
}

TEST(ConstraintRowsTest, ThePlaneHasNoRowsThatItFulfilsByItself) {
  const Chain flat = rrr_chain();
  const Chain deep = without_planar_form(rrr_chain());
  const auto rows = [](const Chain& chain, const Constraint& c) { return ConstraintSet(chain, {c}).rows(); };
  const CloseConstraint close{"gripper", "b1"};
  EXPECT_EQ(rows(flat, pen_line()), 1);
  EXPECT_EQ(rows(deep, pen_line()), 2);
  EXPECT_EQ(rows(flat, pin()), 2);
  EXPECT_EQ(rows(deep, pin()), 3);
  EXPECT_EQ(rows(flat, close), 2);
  EXPECT_EQ(rows(deep, close), 3);
  EXPECT_EQ(rows(flat, (CloseConstraint{"gripper", "b1", Closure::axis})), 2);
  EXPECT_EQ(rows(deep, (CloseConstraint{"gripper", "b1", Closure::axis})), 5);
  EXPECT_EQ(rows(flat, (CloseConstraint{"gripper", "b1", Closure::weld})), 3);
  EXPECT_EQ(rows(deep, (CloseConstraint{"gripper", "b1", Closure::weld})), 6);
  EXPECT_EQ(rows(flat, (PlaneConstraint{"gripper", {0, 0.5, 0}, {0, 1, 0}})), 1);
  EXPECT_EQ(rows(flat, (DistanceConstraint{"base", "gripper", 1})), 1);
}

TEST(ConstraintRowsTest, AreNamed) {
  const ConstraintSet set(rrr_chain(), {pen_line(), pin(), DistanceConstraint{"base", "b3", 1}});
  EXPECT_EQ(set.row_names(), (std::vector<std::string>{"line gripper", "point gripper x", "point gripper y",
                                                       "distance base b3"}));
  EXPECT_EQ(set.first_row(1), 1);
  EXPECT_EQ(set.first_row(3), 4);
}

std::string message_of(const Chain& chain, const std::vector<Constraint>& constraints) {
  try {
    const ConstraintSet set(chain, constraints);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ConstraintRowsTest, WhatCannotBeIsNamed) {
  const Chain chain = rrr_chain();
  EXPECT_NE(message_of(chain, {PointConstraint{"griper", kOrigin}}).find("did you mean 'gripper'"),
            std::string::npos);
  EXPECT_NE(message_of(chain, {JointConstraint{"elbow", 0}}).find("no coordinate 'elbow'"),
            std::string::npos);
  EXPECT_NE(message_of(chain, {PointConstraint{"base", kOrigin}}).find("does not move"), std::string::npos);
  EXPECT_NE(message_of(chain, {DistanceConstraint{"b3", "gripper", 1}}).find("one body"), std::string::npos);
  EXPECT_NE(message_of(chain, {DistanceConstraint{"base", "gripper", 0}}).find("above zero"),
            std::string::npos);
  EXPECT_NE(message_of(chain, {PlaneConstraint{"gripper", kOrigin, {0, 0, 1}}}).find("no motion in it"),
            std::string::npos);
  EXPECT_NE(message_of(chain, {LineConstraint{"gripper", kOrigin, {0, 0, 0}}}).find("no length"),
            std::string::npos);
  EXPECT_NE(message_of(chain, {LineConstraint{"gripper", kOrigin, {0, 1, 1}}}).find("leaves the plane"),
            std::string::npos);
  EXPECT_NE(message_of(chain, {LinearConstraint{{{chain.coordinate_names[0], 0}}, 1}}).find("zero"),
            std::string::npos);
  EXPECT_EQ(message_of(chain, {pin()}), "accepted");
}

TEST(CurveRows, FindTheFootOfAPlaceFarAlongAWindingCurve) {
  // The tip of RR stands on a wave whose foot is sought first at its left end, with many arcs between.
  const Chain chain = read_chain("models/rr.urdf");
  const Wave wave(0.3);
  for (const double x : {-0.85, -0.41, 0.13, 0.66, 1.31}) {
    const Eigen::Vector2d c = wave.at(x).c;
    const double bend = std::acos((c.squaredNorm() - 2) / 2);
    const std::vector<double> q{std::atan2(c.y(), c.x()) - bend / 2, bend}, qd{1, -2};
    const ConstraintSet set(chain, {CurveConstraint{"gripper", std::make_shared<Wave>(0.3), -0.9}});
    ConstrainedWorkspace cold(chain, set);
    Workspace ws(chain);
    compute_constraints(chain, ws, set, cold, q, qd);
    EXPECT_NEAR(cold.phi[0], 0, 1e-14) << x;
    EXPECT_NEAR(cold.curve_s[0], x, 1e-12) << x;
  }
}

}  // namespace
}  // namespace chainreel::test
