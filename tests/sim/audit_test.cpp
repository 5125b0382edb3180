#include "sim/audit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/hash.hpp"
#include "sim/runs.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

Audit audit(const Simulation& run, double dt = 0.05) {
  return audit_of(run, simulate(run, instants(run.duration, dt)));
}

TEST(Audit, OfRk4StaysAtItsErrorOverTenSeconds) {
  // RK4 at 1 ms keeps RR's energy to some 1e-8 J over 10 s; the motion's scale is 29 J.
  EXPECT_LT(audit(run_of("rr", {"0", "0"}, 10)).largest_error, 1e-7);
}

TEST(Audit, CountsTheWorkOfConstantTorques) {
  const Audit one = audit(run_of("rr", {"1", "1"}, 10));
  EXPECT_LT(one.largest_error, 1e-7);
  EXPECT_GT(one.largest_kinetic, 10);
}

TEST(Audit, CountsTheWorkOfTorquesThatDependOnTheState) {
  // Simpson on each step adds h^4 of the power's fourth derivative: below the method's own error.
  EXPECT_LT(audit(run_of("rr", {"-0.5 * qd1", "3 * sin(5 * t) - y_G"}, 5)).largest_error, 1e-7);
}

// The work of a spring over a step is that of what the dense output shows: on a quintic its power is of degree nine.
TEST(Audit, IntegratesThePowerOfASpringOverLongStepsToRoundOff) {
  Simulation run = run_of("pp", {"-30 * q1", "0"}, 2, "rk4", 0.25);
  run.chain.gravity.setZero();
  run.q0[0] = 1;
  const Trajectory trajectory = simulate(run, instants(2, 0.5));
  for (int k = 1; k < trajectory.size(); ++k) {
    const double q = trajectory.q_at(k)[0];
    EXPECT_NEAR(trajectory.work[std::size_t(k)], 15 * (1 - q * q), 1e-13) << k;
  }
}

// Long steps of a series: nodes as many as its degree asks for. What is left is the series' own tolerance.
TEST(Audit, TakesAsManyNodesAsLongStepsOfHighOrderNeed) {
  Simulation run = run_of("rr", {}, 4, "taylor", 0);
  run.chain = test::planar_serial_chain(1);
  run.chain.gravity.setZero();
  run.torque = make_torque_law(run.chain, {{"-30 * q1", {}, {}}}, {});
  run.q0 = {1};
  run.qd0 = {0};
  run.options.order = 24;
  run.options.tolerance = 1e-12;
  const Trajectory trajectory = simulate_audited(run, instants(4, 0.5));
  EXPECT_LT(trajectory.steps, 100);
  EXPECT_LT(trajectory.energy_at_steps->largest_error, 1e-11);
}

TEST(Audit, ShowsTheDriftOfTheLecturesMethodAndItsOrder) {
  // Semi-implicit Euler is of order 1: half the step, half the energy error.
  const double coarse = audit(run_of("rr", {"0", "0"}, 2, "semi_implicit_euler", 0.001)).largest_error;
  const double fine = audit(run_of("rr", {"0", "0"}, 2, "semi_implicit_euler", 0.0005)).largest_error;
  EXPECT_GT(coarse, 1e-3);
  EXPECT_NEAR(coarse / fine, 2, 0.1);  // the next term is some h x 20/s
}

TEST(Audit, RanksTheMethodsOnRr) {
  const double explicit_euler = audit(run_of("rr", {"0", "0"}, 5, "explicit_euler")).largest_error;
  const double semi_implicit = audit(run_of("rr", {"0", "0"}, 5, "semi_implicit_euler")).largest_error;
  const double rk4 = audit(run_of("rr", {"0", "0"}, 5, "rk4")).largest_error;
  EXPECT_GT(explicit_euler, 2 * semi_implicit);
  EXPECT_GT(semi_implicit, 1e5 * rk4);
}

struct Errors {
  double at_steps, at_frames;
};
// RR, let go from the horizontal, at 10 ms; frames between the steps.
Errors errors_of(const std::string& method, double duration, double dt = 0.004) {
  const Simulation run = run_of("rr", {"0", "0"}, duration, method, 0.01);
  const Trajectory trajectory = simulate_audited(run, instants(duration, dt));
  EXPECT_TRUE(trajectory.energy_at_steps);
  return {trajectory.energy_at_steps->largest_error, audit_of(run, trajectory).largest_error};
}

// The cubics of q and of qd keep between steps what symplectic methods keep at them: a quintic whose derivative is qd was off by nine
// joules here.
TEST(Audit, TellsTheErrorOfStepsAndThatOfFramesBetweenThem) {
  const Errors euler = errors_of("symplectic_euler", 20), verlet = errors_of("verlet", 20);
  EXPECT_NEAR(euler.at_steps, 1.60, 0.01);
  EXPECT_LT(euler.at_frames, 1.1 * euler.at_steps);
  EXPECT_NEAR(verlet.at_steps, 0.144, 0.001);
  EXPECT_LT(verlet.at_frames, 3 * verlet.at_steps) << "errors of interpolation, O(h^3), beside O(h^2)";
}

// The numbers of src/README.md: semi-implicit Euler in (q, qd) strays, symplectic Euler does not.
TEST(Audit, ShowsOverALongTimeWhoseEnergyStraysAndWhoseStaysWithinBounds) {
  EXPECT_NEAR(errors_of("semi_implicit_euler", 1000, 10).at_steps, 24.3, 0.1);
  EXPECT_NEAR(errors_of("symplectic_euler", 1000, 10).at_steps, 1.69, 0.01);
}

TEST(Audit, OfAllStepsMissesNone) {
  const Simulation run = run_of("rr", {"0", "0"}, 3, "semi_implicit_euler", 0.01);
  const Trajectory every = simulate_every_step(run);
  const Audit all = audit_of(run, every);
  const Trajectory few = simulate_audited(run, instants(3, 1.5));
  EXPECT_EQ(few.energy_at_steps->largest_error, all.largest_error);
  EXPECT_EQ(few.energy_at_steps->time, all.largest_error_time);
  EXPECT_EQ(few.energy_at_steps->at_end, all.error.back());
  EXPECT_LT(audit_of(run, few).largest_error, 0.9 * all.largest_error);  // negative control
  EXPECT_EQ(audit_of(run, few).sha256, audit_of(run, simulate(run, instants(3, 1.5))).sha256);
}

TEST(Audit, HasAScaleThatWhatWasGainedFromNowhereDoesNotChange) {
  Simulation good = run_of("rr", {"0", "0"}, 5), bad = run_of("rr", {"0", "0"}, 5, "explicit_euler", 0.02);
  EXPECT_NEAR(energy_scale(good).value(), audit(good).largest_kinetic, 0.1);  // between its samples
  EXPECT_EQ(energy_scale(bad), energy_scale(good));
  EXPECT_EQ(bad.method->name, "explicit_euler");
  EXPECT_GT(audit(bad).largest_kinetic, 1.3 * audit(good).largest_kinetic);  // negative control: it gains half again
}

// Negative control: a trajectory of another chain does not pass.
TEST(Audit, FailsForAForeignTrajectory) {
  Simulation run = run_of("rr", {"0", "0"}, 1);
  const Trajectory trajectory = simulate(run, instants(1, 0.1));
  run.chain.gravity *= 1.01;
  EXPECT_GT(audit_of(run, trajectory).largest_error, 0.01);
}

TEST(Audit, HashesTimeAndStateOfEachSample) {
  const Simulation run = run_of("pp", {"0", "0"}, 0.1);
  const Trajectory trajectory = simulate(run, instants(0.1, 0.05));
  Sha256 hash;
  for (int k = 0; k < trajectory.size(); ++k) {
    const std::vector<double> row{trajectory.t[std::size_t(k)], trajectory.q_at(k)[0], trajectory.q_at(k)[1],
                                  trajectory.qd_at(k)[0], trajectory.qd_at(k)[1]};
    hash.add(std::span<const double>(row));
  }
  EXPECT_EQ(audit_of(run, trajectory).sha256, hash.finish());
}

TEST(Audit, HashChangesWithTheLastBitOfAState) {
  const Simulation run = run_of("rr", {"0", "0"}, 0.2);
  Trajectory trajectory = simulate(run, instants(0.2, 0.1));
  const std::string before = audit_of(run, trajectory).sha256;
  EXPECT_EQ(before, audit_of(run, trajectory).sha256);
  trajectory.q.back() = std::nextafter(trajectory.q.back(), 10.0);
  EXPECT_NE(before, audit_of(run, trajectory).sha256);
}

// 120 Hz seen at 60 frames a second, always where it turns round: 26.5 m/s of 1 kg in between.
TEST(Audit, KnowsWhatMovesBetweenFrames) {
  Simulation run = run_of("pp", {"0", "1e4*sin(240*pi*t)"}, 0.4, "rk4", 1e-4);
  run.chain.gravity.setZero();
  const Trajectory trajectory = simulate_audited(run, instants(0.4, 1.0 / 60));
  const Audit seen = audit_of(run, trajectory);
  // The rate is F / (m w) (1 - cos(w t)).
  const double rate = 2e4 / (240 * std::acos(-1.0));
  EXPECT_NEAR(seen.energy_moved, 0.5 * rate * rate, 0.02 * rate * rate);
  EXPECT_NEAR(seen.energy_moved, seen.largest_kinetic, 0.01 * rate * rate);
  // Negative control: frames alone do not.
  EXPECT_LT(audit(run, 1.0 / 60).largest_kinetic, 1e-3);
}

}  // namespace
}  // namespace chainreel
