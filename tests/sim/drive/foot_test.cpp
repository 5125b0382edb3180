// The centre of pressure below a standing human: by recursive Newton-Euler against the rates of all momentum.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "sim/runs.hpp"
#include "sim/watch/events.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

Simulation falling_human() {
  Simulation run =
      run_of("humanoid", {"40 - 30 * qd1", "-300 * q2", "-200 * q3 - 20 * qd3"}, 0.8, "dop853", 0);
  run.q0 = {-0.1, 0.05, -0.1};
  run.options.tolerance = 1e-13;
  return run;
}

double cop_at(const Simulation& run, double t, ConstVec q, ConstVec qd, double height = 0) {
  Workspace ws(run.chain);
  std::vector<double> tau(3);
  run.torque->evaluate(run.chain, ws, t, q, qd, tau);
  compute_forward_dynamics(run.chain, ws, q, qd, tau);
  const std::vector<double> qdd = ws.qdd;
  return ground_load(run.chain, ws, ground_axes(run.chain), height, q, qd, qdd).cop;
}

TEST(CenterOfPressure, OfAStillHumanLiesBelowTheCentreOfMass) {
  const Simulation run = falling_human();
  Workspace ws(run.chain);
  const std::vector<double> q{-0.1, 0.3, -0.2}, still(3);
  const MassCenter moving = mass_center_of(run.chain, ws, q, still);
  const Inertia& foot = run.chain.bodies[0].inertia;
  ASSERT_NEAR(foot.mass, 2.175, 1e-12);
  ASSERT_NEAR(foot.mass + moving.mass, 75, 1e-12) << "a human of 75 kg";
  const double below = (moving.mass * moving.position.x() + foot.mass * foot.com.x()) / 75;
  const GroundAxes axes = ground_axes(run.chain);
  EXPECT_EQ(axes.along, Eigen::Vector3d::UnitX());
  // Some hundred roundings of numbers below 1 m.
  EXPECT_NEAR(ground_load(run.chain, ws, axes, 0, q, still, still).cop, below, 1e-14);
  EXPECT_GT(std::abs(moving.position.x() - below), 1e-3) << "negative control: the foot counts";
}

TEST(CenterOfPressure, IsThatOfTheRatesOfMomentum) {
  const Simulation run = falling_human();
  const double h = 1e-3;
  std::vector<double> times;
  for (int k = 1; k <= 7; ++k)
    for (int j = -2; j <= 2; ++j) times.push_back(0.1 * k + h * j);
  const Trajectory trajectory = simulate(run, times);
  Workspace ws(run.chain);
  const double height = -0.05;  // any plane will do
  for (int k = 2; k < trajectory.size(); k += 5) {
    // p' and L' by the five-point rule, error h^4 / 30 of the fifth derivative: at most 1e-8 here.
    Eigen::Vector3d rate = Eigen::Vector3d::Zero(), spin = rate;
    for (const auto& [j, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      const Momentum momentum = momentum_of(run.chain, ws, trajectory.q_at(k + j), trajectory.qd_at(k + j));
      rate += weight / (12 * h) * momentum.linear;
      spin += weight / (12 * h) * momentum.angular;
    }
    const MassCenter moving = mass_center_of(run.chain, ws, trajectory.q_at(k), trajectory.qd_at(k));
    const Inertia& foot = run.chain.bodies[0].inertia;
    const Eigen::Vector3d gravity = run.chain.gravity;
    const Eigen::Vector3d force = rate - (moving.mass + foot.mass) * gravity;
    const Eigen::Vector3d moment =
        spin - (moving.mass * moving.position + foot.mass * foot.com).cross(gravity);
    const double expected = (moment.z() + height * force.x()) / force.y();
    const double t = trajectory.t[std::size_t(k)];
    EXPECT_NEAR(cop_at(run, t, trajectory.q_at(k), trajectory.qd_at(k), height), expected, 1e-7) << t;
    EXPECT_GT(std::abs(cop_at(run, t, trajectory.q_at(k), trajectory.qd_at(k), 0) - expected), 1e-5)
        << "negative control: the height of the ground counts at t = " << t;
  }
}

TEST(CenterOfPressure, CanBeReadByEvents) {
  Simulation run = falling_human();
  const double instant[] = {0.4};
  const Trajectory there = simulate(run, instant);
  const std::string cop = format_shortest(cop_at(run, 0.4, there.q_at(0), there.qd_at(0)));
  run.events = make_events(run.chain,
                           {{"cop - " + cop, EventKind::mark, "", Crossing::either, {}},
                            {"t > 0.3 + heel + toe", EventKind::mark, "", Crossing::either, {}}},
                           {}, {}, Foot{-0.0665, 0.1265, 0});
  const EventHits hits = simulate(run, {}).events;
  // It may pass that place at other instants, too.
  double nearest = 1, of_foot = 1;
  for (int k = 0; k < hits.size(); ++k) {
    const double t = hits.t[std::size_t(k)];
    if (hits.event[std::size_t(k)] == 1)
      of_foot = t;
    else if (std::abs(t - 0.4) < std::abs(nearest - 0.4))
      nearest = t;
  }
  EXPECT_NEAR(of_foot, 0.36, 1e-11);
  // The root finder's tolerance, and round-off of some 1e-15 m at some 0.01 m/s.
  EXPECT_NEAR(nearest, 0.4, 1e-11);
}

// The hold is the load again, and no set of forces within the foot pulls less: of two that press or pull at places of a grid none does.
TEST(FootHold, IsTheLoadWithTheLeastPull) {
  const GroundAxes axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  const Foot foot{-0.07, 0.2, 0};
  test::Random random(5);
  int pulls = 0, stands = 0;
  for (int i = 0; i < 400; ++i) {
    const auto number = test::random_vector(3, random, 1);
    const double up = 700 * number[0], cop = 0.5 * number[1];
    const GroundLoad load{cop, up, {200 * number[2], up, 0}, cop * up};
    const FootHold hold = hold_of(load, foot, axes);
    EXPECT_LT((hold.force - hold.pull * axes.up - load.force).norm(), 1e-9);
    EXPECT_NEAR(hold.place * hold.force.y() - hold.pull_place * hold.pull, load.moment, 1e-9);
    EXPECT_GE(hold.force.y(), -1e-9);
    EXPECT_GE(hold.pull, 0);
    for (const double place : {hold.place, hold.pull > 0 ? hold.pull_place : 0}) {
      EXPECT_GE(place, foot.heel - 1e-12);
      EXPECT_LE(place, foot.toe + 1e-12);
    }
    EXPECT_EQ(hold.pull == 0, bears(load, foot));
    (hold.pull > 0 ? pulls : stands) += 1;
    constexpr int kPlaces = 20;
    const auto at = [&](int k) { return foot.heel + (foot.toe - foot.heel) * k / kPlaces; };
    for (int a = 0; a < kPlaces; ++a)
      for (int b = a + 1; b <= kPlaces; ++b) {
        const double at_b = (load.moment - at(a) * up) / (at(b) - at(a)), at_a = up - at_b;
        EXPECT_GE(-std::min(at_a, 0.0) - std::min(at_b, 0.0), hold.pull - 1e-9);
      }
  }
  EXPECT_GT(pulls, 50);
  EXPECT_GT(stands, 50);
}

// Where the force against gravity vanishes the centre of pressure is nowhere, and what holds the foot goes on evenly.
TEST(FootHold, GoesOnWhereTheCentreOfPressureIsNowhere) {
  const GroundAxes axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  const Foot foot{-0.07, 0.2, 0};
  for (const double up : {1e-9, 0.0, -1e-9}) {
    const FootHold hold = hold_of({40 / up, up, {-200, up, 0}, 40}, foot, axes);
    EXPECT_NEAR(hold.pull, 40 / 0.27, 1e-6);
    EXPECT_EQ(hold.pull_place, foot.heel);
    EXPECT_EQ(hold.place, foot.toe);
  }
}

TEST(GroundReaction, IsTheSameByBothAlgebras) {
  const Simulation run = falling_human();
  const Chain spatial = test::without_planar_form(run.chain);
  Workspace planar_ws(run.chain), spatial_ws(spatial);
  test::Random random(11);
  for (int k = 0; k < 20; ++k) {
    const auto q = test::random_vector(3, random, 1), qd = test::random_vector(3, random, 3),
               qdd = test::random_vector(3, random, 10);
    const Wrench a = compute_ground_reaction(run.chain, planar_ws, q, qd, qdd);
    const Wrench b = compute_ground_reaction(spatial, spatial_ws, q, qd, qdd);
    // Roundings of some 1000 N.
    EXPECT_LT((a.force - b.force).norm(), 1e-10);
    EXPECT_LT((a.moment - b.moment).norm(), 1e-10);
  }
}

TEST(GroundAxes, WantGravityInThePlaneOfTheChain) {
  Chain chain = test::rr_chain();
  EXPECT_EQ(ground_axes(chain).up, Eigen::Vector3d::UnitY());
  chain.gravity = {0, 0, -9.81};
  EXPECT_THROW(ground_axes(chain), Error);
  EXPECT_THROW(ground_axes(test::arm_chain(1)), Error);
}

}  // namespace
}  // namespace chainreel
