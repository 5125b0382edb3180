// Feedback in the space of the task: its power, its rest, what it asks of a scene.
#include "sim/drive/task_torque.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/kinematics.hpp"
#include "sim/drive/control.hpp"
#include "sim/runs.hpp"
#include "sim/torques_along.hpp"
#include "support/allocation_count.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TaskFeedback pulls(const std::vector<std::string>& x, double kp, double kd) {
  TaskFeedback task;
  task.kp = {kp};
  task.kd = {kd};
  for (const std::string& text : x) task.x.push_back({text, {}});
  return task;
}

// tau . qd is the power of the force at the frame, of chains in the plane and in space, on fixed and floating bases.
TEST(TaskTorque, HasThePowerOfItsForce) {
  test::Random random(11);
  for (const char* model : {"rr", "rrr", "arm"}) {
    const Chain chain = run_of(model, {}, 1).chain;
    const bool is_flat = chain.planar.has_value();
    TaskFeedback task = pulls(is_flat ? std::vector<std::string>{"cos(2*t)", "0.5 + t"} : std::vector<std::string>{"cos(2*t)", "0.5 + t", "t^2"}, 30, 7);
    const auto law = make_task_torque(chain, task, {});
    Workspace ws(chain);
    for (int i = 0; i < 20; ++i) {
      const double t = random.between(0, 1);
      std::vector<double> q, qd, tau(std::size_t(chain.nv));
      for (int j = 0; j < chain.nv; ++j) q.push_back(random.between(-2, 2)), qd.push_back(random.between(-2, 2));
      law->evaluate(chain, ws, t, q, qd, tau);
      compute_kinematics(chain, ws, q, qd);
      const int tip = chain.end_effector;
      const Eigen::Vector3d x = frame_position(chain, ws, tip), xd = frame_velocity(chain, ws, tip);
      Eigen::Vector3d to{std::cos(2 * t), 0.5 + t, is_flat ? x.z() : t * t}, rate{-2 * std::sin(2 * t), 1, is_flat ? xd.z() : 2 * t};
      const Eigen::Vector3d force = 30 * (to - x) + 7 * (rate - xd);
      double power = 0;
      for (int j = 0; j < chain.nv; ++j) power += tau[std::size_t(j)] * qd[std::size_t(j)];
      EXPECT_NEAR(power, force.dot(xd), 1e-12 * (1 + force.norm() * xd.norm())) << model;
    }
  }
}

// With gravity taken away the tip comes to the place, and stays with one that moves: the error is what inertia asks for.
TEST(TaskTorque, BringsTheTipToThePlaceAndAlongWithIt) {
  Simulation run = run_of("rrr", {}, 12);
  Control control;
  control.gravity_compensation = true;
  control.task = pulls({"1.2", "0.9"}, 200, 60);
  control.plus = {{"-2*qd1", {}}, {"-2*qd2", {}}, {"-2*qd3", {}}};  // of what moves beside the tip
  run.torque = make_control(run.chain, control, {});
  run.q0 = {0.3, 0.4, 0.5};
  const Trajectory still = simulate(run, instants(12, 4));
  Workspace ws(run.chain);
  compute_kinematics(run.chain, ws, still.q_at(still.size() - 1), still.qd_at(still.size() - 1));
  // The slowest part decays with some 2 /s: exp(-24).
  EXPECT_LT((frame_position(run.chain, ws, run.chain.end_effector) - Eigen::Vector3d(1.2, 0.9, 0)).norm(), 1e-6);
  const std::vector<TaskTarget> targets = task_targets_along(run, still);
  ASSERT_EQ(targets.size(), std::size_t(still.size()));
  EXPECT_NEAR((targets[0].place - Eigen::Vector3d(1.2, 0.9, 0)).norm(), 0, 1e-15);
  // With a velocity of its own in the reference, whose derivative it is by itself: nothing else can follow 0.2 m/s to a millimetre.
  control.task = pulls({"1 + 0.2*sin(0.5*t)", "0.9"}, 4000, 600);
  run.torque = make_control(run.chain, control, {});
  const Trajectory moving = simulate(run, instants(12, 4));
  const int last = moving.size() - 1;
  compute_kinematics(run.chain, ws, moving.q_at(last), moving.qd_at(last));
  EXPECT_LT((frame_position(run.chain, ws, run.chain.end_effector) - Eigen::Vector3d(1 + 0.2 * std::sin(6.0), 0.9, 0)).norm(), 1e-3);
}

TEST(TaskTorque, AllocatesNothing) {
  const Chain chain = run_of("rrr", {}, 1).chain;
  const auto law = make_task_torque(chain, pulls({"cos(t)", "1"}, 30, 7), {});
  Workspace ws(chain);
  const std::vector<double> q{0.1, 0.2, 0.3};
  std::vector<double> tau(3);
  law->evaluate(chain, ws, 0, q, q, tau);
  const long before = allocation_count();
  law->evaluate(chain, ws, 0.5, q, q, tau);
  EXPECT_EQ(allocation_count(), before);
}

TEST(TaskTorque, SaysWhatDoesNotFit) {
  const auto trouble = [](const char* model, const TaskFeedback& task) -> std::string {
    try {
      make_task_torque(run_of(model, {}, 1).chain, task, {});
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_THAT(trouble("arm", pulls({"1", "2"}, 1, 1)), HasSubstr("three expressions in t, since the chain moves in space"));
  EXPECT_THAT(trouble("rr", pulls({"1"}, 1, 1)), HasSubstr("two or three expressions in t"));
  TaskFeedback task = pulls({"1", "2"}, 1, 1);
  task.frame = "griper";
  EXPECT_THAT(trouble("rr", task), AllOf(HasSubstr("names no link"), HasSubstr("did you mean 'gripper'?")));
  task = pulls({"1", "2"}, 1, 1);
  task.kp = {1, 2, 3};
  EXPECT_THAT(trouble("rr", task), HasSubstr("'task.kp' has 3 entries"));
  task.kp = {1};
  task.lists_of_one = {"kp"};
  EXPECT_THAT(trouble("rr", task), HasSubstr("give one without brackets"));
  task = pulls({"q1", "2"}, 1, 1);
  EXPECT_THAT(trouble("rr", task), HasSubstr("unknown name 'q1'"));
  task = pulls({"1", "2"}, 1, 1);
  task.xd = {{"0", {}}};
  EXPECT_THAT(trouble("rr", task), HasSubstr("'task.xd' has 1 entries and 'task.x' 2"));
  EXPECT_EQ(trouble("rr", pulls({"1", "2", "0"}, 1, 1)), "");
  task = pulls({"1", "2"}, 1, 1);
  task.frame = "H";
  EXPECT_NO_THROW(make_task_torque(run_of("rr", {}, 1).chain, task, {}, {{"H", 1}}));
  // An entry of one joint cannot pull the whole chain.
  std::vector<TorqueEntry> entries(2);
  entries[0].control = Control{};
  entries[0].control->task = pulls({"1", "2"}, 1, 1);
  EXPECT_THROW(make_torque_law(run_of("rr", {}, 1).chain, entries, {}), Error);
}

}  // namespace
}  // namespace chainreel
