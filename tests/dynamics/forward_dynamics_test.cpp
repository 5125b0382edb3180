#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/error.hpp"
#include "dynamics/compare.hpp"
#include "dynamics/effective_mass.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

std::vector<Chain> two_hundred_trees() {
  std::vector<Chain> chains;
  Random random(8);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    TreeOptions options{
        .bodies = 2 + random.below(39), .serial = seed % 4 == 1, .floating_base = seed % 5 == 2};
    options.floating = seed % 3 == 0 ? 0.1 : 0;
    options.mimic = seed % 7 == 3 ? 0.3 : 0;
    options.massless = seed % 2 == 0 ? 0.1 : 0;
    chains.push_back(seed % 10 == 9 ? random_planar_tree(seed, options) : random_tree(seed, options));
  }
  return chains;
}

// Difference of two accelerations, measured as the torque M (a - b) against the torques at work: free of M's
// condition.
double torque_difference(const Eigen::MatrixXd& M, ConstVec a, ConstVec b, double torque_scale) {
  if (!as_vector(a).allFinite() || !as_vector(b).allFinite()) return std::numeric_limits<double>::infinity();
  return (M * (as_vector(a) - as_vector(b))).cwiseAbs().maxCoeff() / torque_scale;
}

struct Reference {
  Eigen::MatrixXd M;
  std::vector<double> qdd;
  double torque_scale = 0;
};

Reference by_mass_matrix(const Chain& chain, const State& s) {
  Workspace ws(chain);
  compute_mass_matrix(chain, ws, s.q);
  compute_nle(chain, ws, s.q, s.qd);
  const Eigen::VectorXd net = as_vector(s.tau) - as_vector(ws.nle);
  const Eigen::VectorXd qdd = ws.M.ldlt().solve(net);
  Reference reference{ws.M, {qdd.begin(), qdd.end()}, 0};
  reference.torque_scale =
      (ws.M.cwiseAbs() * qdd.cwiseAbs()).maxCoeff() + as_vector(ws.nle).cwiseAbs().maxCoeff();
  return reference;
}

// Up to 40 bodies with a hundred operations each, rounded at random: some hundred round-offs of the torques.
constexpr double kTorqueTolerance = 1e-12;

TEST(ForwardDynamicsTest, EqualsMassMatrixSolveOnTwoHundredTrees) {
  Random random(9);
  for (const Chain& chain : two_hundred_trees()) {
    Workspace ws(chain);
    const State s = random_state(chain, random);
    const Reference reference = by_mass_matrix(chain, s);
    compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
    EXPECT_LT(torque_difference(reference.M, ws.qdd, reference.qdd, reference.torque_scale), kTorqueTolerance)
        << chain.name;
    if (chain.has_mimic) continue;
    compute_aba(chain, ws, s.q, s.qd, s.tau);
    EXPECT_LT(torque_difference(reference.M, ws.qdd, reference.qdd, reference.torque_scale), kTorqueTolerance)
        << chain.name;
  }
}

TEST(ForwardDynamicsTest, AnotherMassGivesAnotherAcceleration) {
  Random random(10);
  const Chain chain = random_tree(11, {.bodies = 8});
  const State s = random_state(chain, random);
  const Reference reference = by_mass_matrix(chain, s);
  const Chain other = with_changed_mass(chain, 8, 1 + 1e-6);
  Workspace ws(other);
  compute_aba(other, ws, s.q, s.qd, s.tau);
  EXPECT_GT(torque_difference(reference.M, ws.qdd, reference.qdd, reference.torque_scale), kTorqueTolerance);
}

TEST(ForwardDynamicsTest, UndoesInverseDynamics) {
  Random random(12);
  for (const Chain& chain : two_hundred_trees()) {
    Workspace ws(chain);
    const State s = random_state(chain, random);
    compute_inverse_dynamics(chain, ws, s.q, s.qd, s.qdd);
    const std::vector<double> tau = ws.tau;
    compute_forward_dynamics(chain, ws, s.q, s.qd, tau);
    compute_mass_matrix(chain, ws, s.q);
    const double scale =
        (ws.M.cwiseAbs() * as_vector(s.qdd).cwiseAbs()).maxCoeff() + as_vector(tau).cwiseAbs().maxCoeff();
    EXPECT_LT(torque_difference(ws.M, ws.qdd, s.qdd, scale), kTorqueTolerance) << chain.name;
  }
}

TEST(ForwardDynamicsTest, FrictionOpposesMotionAndIsSubtracted) {
  Chain chain = rrr_chain();
  chain.bodies[1].joint.damping = 0.5;
  chain.bodies[2].joint.friction = 2;
  finish(chain);
  ASSERT_TRUE(chain.has_dissipation);
  Workspace ws(chain);
  Random random(13);
  const State s = random_state(chain, random);
  compute_friction(chain, ws, s.qd);
  // 2 rad/s is 200 times v0: tanh is 1 to round-off unless the speed happens to be small.
  ASSERT_GT(std::abs(s.qd[1]), 0.2);
  EXPECT_EQ(ws.tau_f, (std::vector<double>{0.5 * s.qd[0], std::copysign(2.0, s.qd[1]), 0}));
  compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
  const std::vector<double> qdd = ws.qdd;

  std::vector<double> net = s.tau;
  for (std::size_t i = 0; i < 3; ++i) net[i] -= ws.tau_f[i];
  Chain smooth = chain;
  smooth.has_dissipation = false;
  compute_forward_dynamics(smooth, ws, s.q, s.qd, net);
  EXPECT_EQ(qdd, ws.qdd);
  compute_forward_dynamics(smooth, ws, s.q, s.qd, s.tau);
  EXPECT_NE(qdd, ws.qdd);
}

TEST(ForwardDynamicsTest, FrictionOfAJointThatFollowsReachesItsLeaderByItsRatio) {
  // The follower turns at -2 x 1.5 rad/s: damping 0.5 and friction 3 resist with -4.5 there, and -2 times that here.
  Chain chain = rr_chain();
  Joint& follower = chain.bodies[2].joint;
  follower.q_index = follower.v_index = 0;
  follower.ratio = -2;
  follower.offset = 0.3;
  follower.damping = 0.5;
  follower.friction = 3;
  chain.bodies[1].joint.damping = 0.25;
  chain.has_dissipation = chain.has_mimic = true;
  chain.nq = chain.nv = 1;
  EXPECT_EQ(friction_of(chain, std::vector<double>{1.5}), (std::vector<double>{0.25 * 1.5 + 9}));
  EXPECT_EQ(friction_of(chain, std::vector<double>{-1.5}), (std::vector<double>{-0.25 * 1.5 - 9}));
}

TEST(ForwardDynamicsTest, SmoothedFrictionIsOddAndFollowsTanh) {
  Chain chain = rr_chain();
  chain.bodies[1].joint.friction = 1;
  finish(chain);
  Workspace ws(chain);
  for (double speed : {0.0, 1e-9, 1e-3, 0.01, 0.02, 0.3, 100.0}) {
    compute_friction(chain, ws, std::vector<double>{speed, 0});
    const double forward = ws.tau_f[0];
    EXPECT_NEAR(forward, std::tanh(speed / kFrictionSmoothing), 2 * kRoundOff);
    compute_friction(chain, ws, std::vector<double>{-speed, 0});
    EXPECT_EQ(ws.tau_f[0], -forward);
  }
}

TEST(ForwardDynamicsTest, RefusesVectorsAndWorkspacesOfOtherChains) {
  const Chain chain = planar_serial_chain(2), other = planar_serial_chain(3);
  Workspace ws(chain), foreign(other);
  const std::vector<double> two(2), one(1), three(3), none;
  const auto refuses = [](const auto& call) {
    try {
      call();
    } catch (const Error& error) {
      return error.code() == ExitCode::bad_input;
    }
    return false;
  };
  for (const std::vector<double>& wrong : {one, three, none}) {
    EXPECT_TRUE(refuses([&] { compute_forward_dynamics(chain, ws, wrong, two, two); }));
    EXPECT_TRUE(refuses([&] { compute_forward_dynamics(chain, ws, two, wrong, two); }));
    EXPECT_TRUE(refuses([&] { compute_forward_dynamics(chain, ws, two, two, wrong); }));
    EXPECT_TRUE(refuses([&] { compute_aba(chain, ws, two, two, wrong); }));
    EXPECT_TRUE(refuses([&] { compute_inverse_dynamics(chain, ws, two, two, wrong); }));
    EXPECT_TRUE(refuses([&] { compute_nle(chain, ws, two, wrong); }));
    EXPECT_TRUE(refuses([&] { compute_gravity_torque(chain, ws, wrong); }));
    EXPECT_TRUE(refuses([&] { compute_mass_matrix(chain, ws, wrong); }));
    EXPECT_TRUE(refuses([&] { compute_kinematics(chain, ws, two, wrong); }));
    EXPECT_TRUE(refuses([&] { compute_ground_reaction(chain, ws, two, two, wrong); }));
    EXPECT_TRUE(refuses([&] { energy_of(chain, ws, two, wrong); }));
    EXPECT_TRUE(refuses([&] { std::vector<double> q = wrong; advance(chain, q, two, 0.1); }));
    EXPECT_TRUE(refuses([&] { std::vector<double> q = two; advance(chain, q, wrong, 0.1); }));
    EXPECT_TRUE(refuses([&] { effective_mass_of(chain, ws, wrong, 0, Task::linear); }));
  }
  EXPECT_TRUE(refuses([&] { compute_forward_dynamics(chain, foreign, two, two, two); }));
  EXPECT_FALSE(refuses([&] { compute_forward_dynamics(chain, ws, two, two, two); }));
}

TEST(ForwardDynamicsTest, TenThousandLinksFall) {
  const Chain chain = planar_serial_chain(10000);
  Workspace ws(chain);
  const auto n = std::size_t(chain.nv);
  std::vector<double> q(n, 0.0), qd(n, 0.0), tau(n, 0.0);
  Random random(14);
  for (double& x : q) x = random.between(-0.01, 0.01);
  compute_forward_dynamics(chain, ws, q, qd, tau);
  const std::vector<double> qdd = ws.qdd;
  compute_inverse_dynamics(chain, ws, q, qd, qdd);
  compute_gravity_torque(chain, ws, q);
  // Against the largest torque of gravity: as many rounded terms as links.
  EXPECT_LT(as_vector(ws.tau).cwiseAbs().maxCoeff(),
            1e4 * kRoundOff * as_vector(ws.tau_g).cwiseAbs().maxCoeff());
  EXPECT_GT(as_vector(qdd).cwiseAbs().maxCoeff(), 1);
}

}  // namespace
}  // namespace chainreel::test
