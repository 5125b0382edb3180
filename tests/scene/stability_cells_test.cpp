#include "scene/run/stability_cells.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "core/error.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/audit.hpp"

namespace chainreel {
namespace {

const std::string kSpring = "assets/scenes/pp_spring.yaml";
const std::string kArm = "assets/scenes/rr_torque.yaml";
const std::vector<std::string> kStiffness = {"torque=[0, -k * y_G]", "parameters.k=100"};

StabilityCells spring_cells(const std::string& x, const std::string& y) {
  return run_stability_cells(kSpring, kStiffness, parse_sweep(x, "--x"), parse_sweep(y, "--y"), 2);
}

// The lecture's spring has omega = sqrt(k / m), m = 1 kg: semi-implicit Euler is stable up to omega h = 2.
TEST(StabilityCells, FailWhereTheTheoryOfTheSpringSaysSo) {
  // Steps from 1.998 / omega to 2.002 / omega: a thousand steps grow by e^(1000 * 2 sqrt(0.001)) behind it.
  for (const double k : {25.0, 100.0, 400.0}) {
    const double limit = 2 / std::sqrt(k);
    const std::string range = "step=" + std::to_string(0.999 * limit) + "," + std::to_string(1.001 * limit);
    const StabilityCells map = spring_cells(range, "parameters.k=" + std::to_string(k) + ",1");
    EXPECT_EQ(map.at(0, 0).status, RunStatus::finished) << k;
    EXPECT_EQ(map.at(1, 0).status, RunStatus::diverged) << k;
    ASSERT_TRUE(map.boundary[0]);
    // Central differences of a linear force: rounding over the difference, 1e-16 * 10 / 6e-6.
    EXPECT_NEAR(*map.boundary[0] / limit, 1, 1e-8);
  }
}

TEST(StabilityCells, HaveTheErrorOfARunByItself) {
  const StabilityCells map = spring_cells("step=0.01,0.02", "parameters.k=50,100");
  EXPECT_FALSE(map.in_batches);
  std::vector<std::string> settings = kStiffness;
  settings.insert(settings.end(), {"step=0.02", "parameters.k=100"});
  Scene scene = read_scene(kSpring, settings);
  Simulation alone = prepare(scene, false);
  alone.duration = kLeastSteps * 0.02;
  const Trajectory trajectory = simulate_audited(alone, {});
  EXPECT_EQ(map.at(1, 1).energy_error, trajectory.energy_at_steps->largest_error);
  EXPECT_NE(map.at(0, 1).energy_error, map.at(1, 1).energy_error);
}

TEST(StabilityCells, InBatchesAreTheRunsByThemselves) {
  const std::vector<std::string> set = {"method=semi_implicit_euler", "step=0.002", "duration=3"};
  const StabilityCells map = run_stability_cells(kArm, set, parse_sweep("torque.1=-1:1:5", "--x"),
                                                 parse_sweep("torque.2=0:2:3", "--y"), 2);
  ASSERT_TRUE(map.in_batches);
  for (std::size_t iy = 0; iy < 3; ++iy) {
    for (std::size_t ix = 0; ix < 5; ++ix) {
      std::vector<std::string> settings = set;
      settings.insert(settings.end(), {map.x.setting(ix), map.y.setting(iy)});
      Scene scene = read_scene(kArm, settings);
      Simulation alone = prepare(scene, false);
      std::vector<double> looks;  // of a batch: 15 steps apart
      for (int k = 1; k <= 100; ++k) looks.push_back(k * 15 * 0.002);
      const double error = audit_of(alone, simulate(alone, looks)).largest_error;
      // The same bits of the state; energies of some 10 J are added in another order.
      EXPECT_NEAR(map.at(ix, iy).energy_error, error, 1e-13);
      EXPECT_GT(error, 1e-6);
    }
  }
}

// Joints that turn never leave all bounds: beyond its limit the arm rattles about with thousands of joules.
TEST(StabilityCells, FailWhereTheEnergyIsLostThoughEveryNumberStaysFinite) {
  const std::vector<std::string> set = {"torque={pd: {kp: 400, kd: 20, q: [0, 0]}}",
                                        "duration=2",
                                        "gravity=[0, 0, 0]",
                                        "method=rk4",
                                        "step=0.01",
                                        "start.q=[0.01, 0]"};
  const double limit = 0.0306;
  const StabilityCells map = run_stability_cells(kArm, set, parse_sweep("step=0.0298,0.0312", "--x"),
                                                 parse_sweep("start.q.1=0.01,0.02", "--y"), 2);
  ASSERT_TRUE(map.boundary[0]);
  EXPECT_NEAR(*map.boundary[0], limit, 2e-4);
  EXPECT_FALSE(map.at(0, 0).failed);
  EXPECT_TRUE(map.at(1, 0).failed) << map.at(1, 0).energy_error << " J of " << map.at(1, 0).energy_scale;
}

// omega h = sqrt(2) comes round in four steps: looks at every tenth would see the same two states again and
// again.
TEST(StabilityCells, MissNoStepOfAMotionThatRepeatsItself) {
  const StabilityCells map = spring_cells("step=0.1,0.11", "parameters.k=200,210");
  // Four states of its ellipse of energies, not the largest; the neighbour's come round everywhere.
  EXPECT_GT(map.at(0, 0).energy_error, 0.5 * map.at(0, 1).energy_error);
  EXPECT_GT(map.at(0, 1).energy_error, 10);
}

// Where no key is the step, each cell knows whether its own step is stable.
TEST(StabilityCells, KnowTheoryWithoutAnAxisOfSteps) {
  const StabilityCells map = run_stability_cells(
      kSpring, {"torque=[0, -k * y_G]", "parameters.k=100", "step=0.1"},
      parse_sweep("parameters.k=300,390,410,500", "--x"), parse_sweep("start.q.2=1,2", "--y"), 2);
  EXPECT_TRUE(map.boundary.empty());
  for (std::size_t iy = 0; iy < 2; ++iy)
    for (std::size_t ix = 0; ix < 4; ++ix) {
      EXPECT_EQ(map.at(ix, iy).stable, ix < 2);  // omega h = 2 at k = 400
      EXPECT_EQ(map.at(ix, iy).failed, ix >= 2);
    }
}

TEST(StabilityCells, RefuseAutoAndScenesThatCannotBeRead) {
  try {
    run_stability_cells(kSpring, {"method=auto", "step=~"}, parse_sweep("torque.1=1,2", "--x"),
                        parse_sweep("torque.2=1,2", "--y"), 2);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
  }
  EXPECT_THROW(run_stability_cells(kSpring, {}, parse_sweep("torque.7=1,2", "--x"),
                                   parse_sweep("torque.2=1,2", "--y"), 2),
               Error);
}

}  // namespace
}  // namespace chainreel
