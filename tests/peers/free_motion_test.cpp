// Robots left to themselves: whether what the equations conserve stays.
//
// Rule: two seconds of motion without torque, damping and friction, by rk4 at 1 ms; the audit's largest error
// must stay below 1e-6 of the largest kinetic energy. Robots on a fixed base start at rest with every turning
// joint at 1.5 rad and fall. From nearly upright poses the light ends of the double pendulums and of the
// panda whip round at 75 rad/s, and rk4's own error at 1 ms reaches 1e-6 and more; there the error must be
// the method's, which halving the step shows. Robots that hang on nothing drift without gravity, where
// falling together would hide how they move: every joint starts with 1 rad/s or m/s, the base with a turn of
// 1 rad/s about its z. The human, whose trunk has 0.68 of its mass, is treated like the robots that whip.
#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "peers/model_files.hpp"
#include "sim/audit.hpp"
#include "sim/simulate.hpp"
#include "support/chains.hpp"
#include "support/public_robots.hpp"

namespace chainreel::peers {
namespace {

constexpr double kLargestError = 1e-6;  // of the largest kinetic energy

Simulation free_motion(Chain chain, double angle = 1.5) {
  Simulation run;
  run.q0 = zero_configuration(chain);
  run.qd0.assign(std::size_t(chain.nv), 0);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (joint.kind == JointKind::floating) {
      run.qd0[std::size_t(joint.v_index) + 5] = 1;
    } else {
      if (joint.kind == JointKind::revolute) run.q0[std::size_t(joint.q_index)] = angle;
      if (chain.has_floating) run.qd0[std::size_t(joint.v_index)] = 1;
    }
  }
  if (chain.has_floating) chain.gravity.setZero();
  run.torque = make_torque_law(chain, std::vector<TorqueEntry>(std::size_t(chain.nv)), {});
  run.chain = std::move(chain);
  run.method = &find_method("rk4");
  run.step = 0.001;
  run.duration = 2;
  return run;
}

// Of the largest kinetic energy.
double audit_error(const std::string& name, const Simulation& run) {
  const Trajectory trajectory = simulate_every_step(run);
  EXPECT_EQ(trajectory.status, RunStatus::finished) << name << ": " << trajectory.trouble;
  const Audit audit = audit_of(run, trajectory);
  EXPECT_GT(audit.largest_kinetic, 0) << name << " does not move";
  std::printf("%-75s kinetic up to %8.3g J, audit error %.1e of it\n", name.c_str(), audit.largest_kinetic,
              audit.largest_error / audit.largest_kinetic);
  return audit.largest_error / audit.largest_kinetic;
}

// Energy errors of rk4 fall as h^4 or, where they do not return, as h^5: by 16 to 32 when the step is halved.
void expect_error_of_order_four(const std::string& name, Simulation run) {
  const double coarse = audit_error(name, run);
  if (coarse < 1e-9) return;  // of round-off's size when halved
  run.step /= 2;
  const double ratio = coarse / audit_error(name + ", half the step", run);
  EXPECT_GT(ratio, 10) << name;
  EXPECT_LT(ratio, 50) << name;
}

TEST(FreeMotion, OfTheCommittedModelsKeepsTheirEnergy) {
  for (const std::string& path : committed_models()) {
    // Its heavy trunk whips the light shank round.
    if (path.ends_with("humanoid.urdf"))
      expect_error_of_order_four(path, free_motion(read_frictionless(path)));
    else
      EXPECT_LT(audit_error(path, free_motion(read_frictionless(path))), kLargestError) << path;
  }
}

TEST(FreeMotion, OfPublicRobotsKeepsTheirEnergy) {
  if (public_robots().empty()) GTEST_SKIP() << kNoRobots;
  for (const std::string& path : public_robots())
    EXPECT_LT(audit_error(path, free_motion(read_frictionless(path))), kLargestError) << path;
}

TEST(FreeMotion, OfPublicRobotsThatHangOnNothingKeepsTheirEnergy) {
  if (public_robots().empty()) GTEST_SKIP() << kNoRobots;
  for (const std::string& path : public_robots())
    EXPECT_LT(audit_error(path + ", floating", free_motion(read_frictionless(path, true))), kLargestError)
        << path;
}

TEST(FreeMotion, ErrorIsTheMethodsOwn) {
  expect_error_of_order_four("arm", free_motion(chainreel::test::arm_chain(3)));
}

TEST(FreeMotion, ErrorOfPublicRobotsIsTheMethodsOwn) {
  if (public_robots().empty()) GTEST_SKIP() << kNoRobots;
  for (const std::string& path : public_robots())
    expect_error_of_order_four(path + ", upright", free_motion(read_frictionless(path), 0.3));
}

// Negative control: explicit Euler gains energy, some h^2 a step.
TEST(FreeMotion, AuditSeesAMethodThatGainsEnergy) {
  Simulation run = free_motion(chainreel::test::arm_chain(3));
  run.method = &find_method("explicit_euler");
  EXPECT_GT(audit_error("arm, explicit Euler", run), 1000 * kLargestError);
}

}  // namespace
}  // namespace chainreel::peers
