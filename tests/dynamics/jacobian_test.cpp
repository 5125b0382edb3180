#include <gtest/gtest.h>

#include "dynamics/compare.hpp"
#include "dynamics/kinematics.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

std::vector<Chain> chains_with_jacobians() {
  std::vector<Chain> chains{rr_chain(), rrr_chain(), arm_chain(2)};
  for (std::uint64_t seed = 20; seed < 25; ++seed) {
    chains.push_back(random_tree(seed, {.bodies = 10, .serial = true, .mimic = 0.3}));
    chains.push_back(random_tree(seed, {.bodies = 10, .floating_base = true, .floating = 0.2}));
    chains.push_back(random_planar_tree(seed, {.bodies = 10, .serial = true, .mimic = 0.3}));
  }
  return chains;
}

// World velocity of the frame: angular, then linear.
Eigen::VectorXd frame_twist(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd) {
  compute_kinematics(chain, ws, q, qd);
  const auto body = std::size_t(chain.frames[std::size_t(chain.end_effector)].body);
  Eigen::VectorXd twist(6);
  twist << ws.w_WB[body], frame_velocity(chain, ws, chain.end_effector);
  return twist;
}

// A world twist in the rows of the task.
Eigen::VectorXd rows_of(const Chain& chain, const Eigen::VectorXd& twist, Task task) {
  const TaskBasis basis = task_basis(chain, task);
  Eigen::VectorXd rows(Eigen::Index(basis.names.size()));
  for (std::size_t r = 0; r < basis.names.size(); ++r) {
    const bool angular = basis.names[r].starts_with("w_");
    const Eigen::Vector3d part = angular ? twist.head<3>() : twist.tail<3>();
    rows(Eigen::Index(r)) = basis.directions[r].dot(part);
  }
  return rows;
}

TEST(JacobianTest, TimesRatesIsTheFramesVelocity) {
  Random random(21);
  for (const Chain& chain : chains_with_jacobians()) {
    Workspace ws(chain);
    const State s = random_state(chain, random);
    const Eigen::VectorXd twist = frame_twist(chain, ws, s.q, s.qd);
    for (const Task task : {Task::linear, Task::full}) {
      compute_jacobian(chain, ws, s.q, chain.end_effector, task);
      const Eigen::VectorXd v = ws.J * as_vector(s.qd);
      // ten joints' parts, each a few rounded products, may cancel
      EXPECT_LT(relative_difference(Eigen::MatrixXd(v), rows_of(chain, twist, task)), 1e-12) << chain.name;
    }
  }
}

Eigen::Vector3d position_after(const Chain& chain, Workspace& ws, const State& s, double h) {
  std::vector<double> q = s.q;
  advance(chain, q, s.qd, h);
  compute_kinematics(chain, ws, q, s.qd);
  return frame_position(chain, ws, chain.end_effector);
}

Eigen::VectorXd twist_after(const Chain& chain, Workspace& ws, const State& s, double h) {
  std::vector<double> q = s.q;
  advance(chain, q, s.qd, h);
  return frame_twist(chain, ws, q, s.qd);
}

double velocity_error(const Chain& chain, const State& s, double h) {
  Workspace ws(chain);
  compute_jacobian(chain, ws, s.q, chain.end_effector, Task::linear);
  const Eigen::VectorXd v = ws.J * as_vector(s.qd);
  const Eigen::Vector3d difference =
      (position_after(chain, ws, s, h) - position_after(chain, ws, s, -h)) / (2 * h);
  Eigen::VectorXd twist(6);
  twist << Eigen::Vector3d::Zero(), difference;
  return (v - rows_of(chain, twist, Task::linear)).norm();
}

// The rate of the twist along a constant qd is Jd qd.
double rate_error(const Chain& chain, const State& s, Task task, double h) {
  Workspace ws(chain);
  compute_jacobian_rate(chain, ws, s.q, s.qd, chain.end_effector, task);
  const Eigen::VectorXd rate = ws.Jd_qd;
  const Eigen::VectorXd difference = (twist_after(chain, ws, s, h) - twist_after(chain, ws, s, -h)) / (2 * h);
  return (rate - rows_of(chain, difference, task)).norm();
}

// Central differences miss by O(h^2): halving h divides the error by 4, up to the next order h^4.
TEST(JacobianTest, CentralDifferencesOfPositionConvergeWithOrderTwo) {
  Random random(22);
  for (const Chain& chain : chains_with_jacobians()) {
    const State s = random_state(chain, random, 1);
    EXPECT_NEAR(velocity_error(chain, s, 2e-3) / velocity_error(chain, s, 1e-3), 4, 0.1) << chain.name;
  }
}

TEST(JacobianTest, CentralDifferencesOfVelocityConvergeWithOrderTwo) {
  Random random(23);
  for (const Chain& chain : chains_with_jacobians()) {
    const State s = random_state(chain, random, 1);
    for (const Task task : {Task::linear, Task::full}) {
      const double ratio = rate_error(chain, s, task, 2e-3) / rate_error(chain, s, task, 1e-3);
      EXPECT_NEAR(ratio, 4, 0.1) << chain.name;
    }
  }
}

TEST(JacobianTest, DifferencesAlongOtherRatesDoNotConverge) {
  Random random(24);
  const Chain chain = arm_chain(3);
  State s = random_state(chain, random, 1);
  Workspace ws(chain);
  compute_jacobian(chain, ws, s.q, chain.end_effector, Task::linear);
  const Eigen::VectorXd v = ws.J * as_vector(s.qd);
  s.qd[3] += 1e-3;
  const double h = 1e-4;
  const Eigen::Vector3d difference =
      (position_after(chain, ws, s, h) - position_after(chain, ws, s, -h)) / (2 * h);
  EXPECT_GT((v - difference).norm(), 1e-5);
}

TEST(JacobianTest, RowsAreNamedAfterTheirDirections) {
  EXPECT_EQ(task_basis(rr_chain(), Task::linear).names, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(task_basis(rr_chain(), Task::full).names, (std::vector<std::string>{"w_z", "x", "y"}));
  EXPECT_EQ(task_basis(arm_chain(1), Task::full).names,
            (std::vector<std::string>{"w_x", "w_y", "w_z", "x", "y", "z"}));
}

}  // namespace
}  // namespace chainreel::test
