// Forward dynamics and mass matrix against MuJoCo, an engine that shares no line with ours.
//
// Tolerance: 1e-9 of max(1, |qdd|_inf) in qdd and of max |M_ij| in M. Both engines work in double precision;
// what differs is round-off, 1e-16 times the condition number of M (1e5 for an arm that ends in light
// fingers), and the moments of 1e-14 kg m^2 that MuJoCo asks of point masses. A mass that is wrong by one
// part in a million stands far above it: see the negative controls.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "peers/mjcf.hpp"
#include "peers/model_files.hpp"
#include "peers/mujoco_chain.hpp"
#include "support/chains.hpp"
#include "support/public_robots.hpp"

namespace chainreel::peers {
namespace {

using chainreel::test::arm_chain;
using chainreel::test::as_vector;
using chainreel::test::Random;
using chainreel::test::random_state;
using chainreel::test::random_tree;
using chainreel::test::relative_difference;
using chainreel::test::State;
using chainreel::test::with_changed_mass;

constexpr double kAgreement = 1e-9;
constexpr int kStates = 100;

struct Difference {
  double qdd = 0;  // of max(1, |qdd|_inf)
  double M = 0;    // of max |M_ij|
};

double distance(const std::vector<double>& qdd, const std::vector<double>& expected) {
  double largest = 0, size = 1;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!std::isfinite(qdd[i]) || !std::isfinite(expected[i])) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::abs(qdd[i] - expected[i]));
    size = std::max(size, std::abs(expected[i]));
  }
  return largest / size;
}

// The largest over random states.
Difference difference(const Chain& ours, MujocoChain& theirs) {
  Workspace ws(ours);
  Random random(20240);
  Difference largest;
  for (int k = 0; k < kStates; ++k) {
    const State state = random_state(ours, random);
    compute_forward_dynamics(ours, ws, state.q, state.qd, state.tau);
    largest.qdd = std::max(largest.qdd, distance(ws.qdd, theirs.qdd_of(state.q, state.qd, state.tau)));
    compute_mass_matrix(ours, ws, state.q);
    largest.M = std::max(largest.M, relative_difference(ws.M, theirs.mass_matrix_of(state.q)));
  }
  EXPECT_EQ(theirs.warnings(), "");
  return largest;
}

void expect_agreement(const std::string& name, const Chain& chain) {
  SCOPED_TRACE(name);
  MujocoChain theirs(chain);
  const Difference found = difference(chain, theirs);
  std::printf("%-60s %2d freedoms: qdd %.1e, M %.1e\n", name.c_str(), chain.nv, found.qdd, found.M);
  EXPECT_LT(found.qdd, kAgreement);
  EXPECT_LT(found.M, kAgreement);
}

TEST(Mujoco, AgreesOnTheCommittedModels) {
  const std::vector<std::string> paths = committed_models();
  ASSERT_GE(paths.size(), 3u);
  for (const std::string& path : paths)
    expect_agreement(path, with_independent_joints(read_frictionless(path)));
}

TEST(Mujoco, AgreesOnPublicRobots) {
  if (public_robots().empty()) GTEST_SKIP() << kNoRobots;
  for (const std::string& path : public_robots())
    expect_agreement(path, with_independent_joints(read_frictionless(path)));
}

TEST(Mujoco, AgreesOnPublicRobotsThatHangOnNothing) {
  if (public_robots().empty()) GTEST_SKIP() << kNoRobots;
  for (const std::string& path : public_robots())
    expect_agreement(path + ", floating", with_independent_joints(read_frictionless(path, true)));
}

TEST(Mujoco, AgreesOnRandomTreesOfAllJointKinds) {
  for (int seed = 1; seed <= 40; ++seed) {
    // Every second one floats, every third one is serial.
    const Chain chain =
        random_tree(std::uint64_t(seed),
                    {.bodies = 2 + seed % 20, .serial = seed % 3 == 0, .floating_base = seed % 2 == 0});
    expect_agreement(chain.name, chain);
  }
}

TEST(Mujoco, AgreesOnTreesWhereSomeBodiesHaveNoMass) {
  for (int seed = 1; seed <= 20; ++seed) {
    const Chain chain = random_tree(std::uint64_t(seed), {.bodies = 12, .massless = 0.4});
    expect_agreement(chain.name, chain);
  }
}

// A chain whose joints share coordinates, and the same chain with a coordinate a joint. Rates go by the
// constant matrix G, qd_free = G qd, so that M = G^T M_free G and nle = G^T nle_free.
struct Coupling {
  explicit Coupling(const Chain& chain);
  std::vector<double> free_position(const std::vector<double>& q) const;
  std::vector<double> accelerations(MujocoChain& theirs, const State& state) const;

  Chain coupled, free;
  Eigen::MatrixXd G;
};

Coupling::Coupling(const Chain& chain) : coupled(chain), free(with_independent_joints(chain)) {
  G.setZero(free.nv, coupled.nv);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = coupled.bodies[i].joint;
    const int row = free.bodies[i].joint.v_index;
    for (int k = 0; k < (joint.kind == JointKind::floating ? 6 : 1); ++k)
      G(row + k, joint.v_index + k) = joint.ratio;
  }
}

std::vector<double> Coupling::free_position(const std::vector<double>& q) const {
  std::vector<double> all(std::size_t(free.nq));
  for (std::size_t i = 1; i < coupled.bodies.size(); ++i) {
    const Joint& joint = coupled.bodies[i].joint;
    const auto from = std::size_t(joint.q_index), to = std::size_t(free.bodies[i].joint.q_index);
    if (joint.kind == JointKind::floating) {
      std::copy_n(&q[from], 7, &all[to]);
    } else {
      all[to] = joint.ratio * q[from] + joint.offset;
    }
  }
  return all;
}

std::vector<double> Coupling::accelerations(MujocoChain& theirs, const State& state) const {
  const std::vector<double> q = free_position(state.q);
  const Eigen::VectorXd qd = G * as_vector(state.qd);
  const std::vector<double> rest(std::size_t(free.nv));
  const std::vector<double> drift = theirs.qdd_of(q, {qd.data(), rest.size()}, rest);
  const Eigen::MatrixXd M_free = theirs.mass_matrix_of(q);
  const Eigen::VectorXd nle_free = -(M_free * as_vector(drift));
  const Eigen::VectorXd qdd =
      (G.transpose() * M_free * G).ldlt().solve(as_vector(state.tau) - G.transpose() * nle_free);
  return {qdd.data(), qdd.data() + qdd.size()};
}

void expect_coupled_agreement(const std::string& name, const Chain& chain) {
  const Coupling coupling(chain);
  MujocoChain theirs(coupling.free);
  Workspace ws(chain);
  Random random(20241);
  double largest = 0;
  for (int k = 0; k < kStates; ++k) {
    const State state = random_state(chain, random);
    compute_forward_dynamics(chain, ws, state.q, state.qd, state.tau);
    largest = std::max(largest, distance(ws.qdd, coupling.accelerations(theirs, state)));
  }
  std::printf("%-60s %2d freedoms: qdd %.1e\n", name.c_str(), chain.nv, largest);
  EXPECT_LT(largest, kAgreement) << name;
}

TEST(Mujoco, AgreesOnJointsThatFollowOthers) {
  int coupled = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const Chain chain =
        random_tree(std::uint64_t(seed), {.bodies = 10, .floating_base = seed % 2 == 0, .mimic = 0.5});
    coupled += chain.has_mimic ? 1 : 0;
    expect_coupled_agreement(chain.name, chain);
  }
  EXPECT_GT(coupled, 10);
}

TEST(Mujoco, AgreesOnPublicRobotsWhoseJointsFollowOthers) {
  if (public_robots().empty()) GTEST_SKIP() << kNoRobots;
  for (const std::string& path : public_robots()) {
    const Chain chain = read_frictionless(path);
    if (chain.has_mimic) expect_coupled_agreement(path + ", coupled", chain);
  }
}

TEST(Mujoco, IsGivenNothingThatItsFormatCannotSay) {
  EXPECT_THROW(mjcf_of(random_tree(1, {.bodies = 20, .mimic = 1})), std::invalid_argument);
  EXPECT_THROW(mjcf_of(random_tree(1, {.bodies = 20, .floating = 1})), std::invalid_argument);
}

// Negative controls: what is asked of MuJoCo differs from what is asked of us by one part in a million.

TEST(Mujoco, SeesAMassThatIsWrongByOnePartInAMillion) {
  for (const Chain& chain : {chainreel::test::rrr_chain(), arm_chain(1),
                             random_tree(2, {.bodies = 6, .floating_base = true})}) {
    MujocoChain theirs(with_changed_mass(chain, 2, 1 + 1e-6));
    const Difference found = difference(chain, theirs);
    EXPECT_GT(found.qdd, 10 * kAgreement) << chain.name;
    EXPECT_GT(found.M, 10 * kAgreement) << chain.name;
  }
}

TEST(Mujoco, SeesGravityThatIsWrongByOnePartInAMillion) {
  Chain chain = arm_chain(1);
  MujocoChain theirs(chain);
  chain.gravity *= 1 + 1e-6;
  EXPECT_GT(difference(chain, theirs).qdd, 10 * kAgreement);
}

TEST(Mujoco, SeesATwistThatIsReadInTheWorldsAxes) {
  const Chain chain = random_tree(2, {.bodies = 3, .floating_base = true});
  MujocoChain theirs(chain);
  Workspace ws(chain);
  Random random(1);
  const State state = random_state(chain, random);
  State in_world_axes = state;
  const Eigen::Quaterniond R(Eigen::Map<const Eigen::Vector4d>(state.q.data() + 3));
  Eigen::Map<Eigen::Vector3d>(in_world_axes.qd.data()) =
      R * Eigen::Map<const Eigen::Vector3d>(state.qd.data());
  compute_forward_dynamics(chain, ws, state.q, state.qd, state.tau);
  EXPECT_GT(distance(ws.qdd, theirs.qdd_of(state.q, in_world_axes.qd, state.tau)), 1e-3);
}

}  // namespace
}  // namespace chainreel::peers
