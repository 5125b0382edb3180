#include "dynamics/momentum_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/compare.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "support/allocation_count.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

// Kernels, planar and spatial recursions, shared coordinates, axes that point down.
std::vector<Chain> chains() {
  std::vector<Chain> all{rr_chain(), rrr_chain(), planar_serial_chain(4), planar_serial_chain(9)};
  for (std::uint64_t seed = 1; seed < 7; ++seed) {
    all.push_back(random_tree(seed, {.bodies = 9}));
    all.push_back(random_tree(seed, {.bodies = 9, .mimic = 0.4}));
    all.push_back(random_planar_tree(seed, {.bodies = 8}));
    all.push_back(random_planar_tree(seed, {.bodies = 8, .mimic = 0.4}));
    all.push_back(random_planar_tree(seed, {.bodies = 3, .serial = true, .prismatic = 0}));
  }
  return all;
}

// Round-off of some hundred operations, times the condition of M: up to 1e4 among these chains.
constexpr double kSolved = 1e-10;
constexpr double kSummed = 1e-12;

TEST(MomentumForm, GivesMassMatrixTimesVelocity) {
  Random random(3);
  for (const Chain& chain : chains()) {
    Workspace ws(chain);
    MomentumForm form(chain);
    const State s = random_state(chain, random);
    std::vector<double> p(s.qd.size());
    form.momentum(s.q, s.qd, p);
    compute_mass_matrix(chain, ws, s.q);
    EXPECT_LT(relative_difference(as_vector(p), ws.M * as_vector(s.qd)), kSummed) << chain.name;
  }
}

TEST(MomentumForm, UndoesItsMomentum) {
  Random random(4);
  for (const Chain& chain : chains()) {
    MomentumForm form(chain);
    for (int k = 0; k < 3; ++k) {
      const State s = random_state(chain, random);
      std::vector<double> p(s.qd.size()), qd(s.qd.size());
      form.momentum(s.q, s.qd, p);
      form.velocity(s.q, p, qd);
      EXPECT_LT(relative_difference(qd, s.qd), kSolved) << chain.name;
    }
  }
}

// d(T - P)/dq at constant qd, by central differences of the energies.
double slope_error(const Chain& chain, const State& s, double h, double factor) {
  Workspace ws(chain);
  MomentumForm form(chain);
  std::vector<double> p_dot(s.qd.size());
  form.force(s.q, s.qd, p_dot);
  const auto lagrangian = [&](std::size_t i, double dq) {
    std::vector<double> q = s.q;
    q[i] += dq;
    const Energy energy = energy_of(chain, ws, q, s.qd);
    return energy.kinetic - energy.potential;
  };
  double error = 0;
  for (std::size_t i = 0; i < s.q.size(); ++i)
    error = std::max(error, std::abs((lagrangian(i, h) - lagrangian(i, -h)) / (2 * h) - factor * p_dot[i]));
  return error;
}

TEST(MomentumForm, ForceIsTheLagrangiansSlope) {
  Random random(5);
  for (const Chain& chain : chains()) {
    const State s = random_state(chain, random, 1);
    // Central differences: a quarter of the error at half the step. A wrong slope leaves an error that stays.
    EXPECT_NEAR(slope_error(chain, s, 2e-3, 1) / slope_error(chain, s, 1e-3, 1), 4, 0.1) << chain.name;
    EXPECT_LT(slope_error(chain, s, 2e-3, 1.1) / slope_error(chain, s, 1e-3, 1.1), 1.5) << chain.name;
  }
}

TEST(MomentumForm, ForceOfSlidingMassesIsTheirWeight) {
  const Chain chain = pp_chain();
  MomentumForm form(chain);
  std::vector<double> p_dot(2);
  form.force(std::vector{0.3, -0.2}, std::vector{2.0, 1.0}, p_dot);
  EXPECT_NEAR(p_dot[0], 0, 1e-15);
  EXPECT_NEAR(p_dot[1], -9.81, 1e-14);
}

// p' = M qdd + M' qd along the motion, with M' = C + C^T: the momenta move as forward dynamics says.
TEST(MomentumForm, MovesAsForwardDynamics) {
  Random random(6);
  for (const Chain& chain : chains()) {
    Workspace ws(chain);
    MomentumForm form(chain);
    const State s = random_state(chain, random);
    const auto n = s.qd.size();
    std::vector<double> p_dot(n);
    form.force(s.q, s.qd, p_dot);
    compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
    const std::vector<double> qdd = ws.qdd;
    compute_mass_matrix(chain, ws, s.q);
    const double h = 1e-5;  // differences of M: error h^2 times the third derivative along qd, some 1e-8
    std::vector<double> q = s.q;
    const Eigen::MatrixXd M = ws.M;
    for (std::size_t i = 0; i < n; ++i) q[i] += h * s.qd[i];
    compute_mass_matrix(chain, ws, q);
    const Eigen::MatrixXd after = ws.M;
    for (std::size_t i = 0; i < n; ++i) q[i] -= 2 * h * s.qd[i];
    compute_mass_matrix(chain, ws, q);
    const Eigen::VectorXd rate = (after - ws.M) / (2 * h) * as_vector(s.qd);
    const Eigen::VectorXd expected = M * as_vector(qdd) + rate - as_vector(s.tau);
    EXPECT_LT(relative_difference(as_vector(p_dot), expected), 1e-6) << chain.name;
    // Negative control: without a hundredth of M' qd it does not.
    EXPECT_GT(relative_difference(as_vector(p_dot), Eigen::VectorXd(expected - 0.01 * rate)), 1e-5);
  }
}

TEST(MomentumForm, KernelsAgreeWithTheRecursions) {
  Random random(7);
  for (const Chain& chain : {rr_chain(), rrr_chain(), planar_serial_chain(4)}) {
    MomentumForm kernel(chain), recursion(without_planar_form(chain));
    const State s = random_state(chain, random);
    const auto n = s.qd.size();
    std::vector<double> a(n), b(n);
    kernel.force(s.q, s.qd, a);
    recursion.force(s.q, s.qd, b);
    EXPECT_LT(relative_difference(a, b), kSummed);
    kernel.velocity(s.q, s.qd, a);
    recursion.velocity(s.q, s.qd, b);
    EXPECT_LT(relative_difference(a, b), kSolved);
  }
}

TEST(MomentumForm, AnswersTheSameWhateverItRemembers) {
  Random random(8);
  for (const Chain& chain : chains()) {
    MomentumForm used(chain), fresh(chain);
    const State s = random_state(chain, random), other = random_state(chain, random);
    const auto n = s.qd.size();
    std::vector<double> a(n), b(n);
    used.velocity(other.q, other.qd, a);
    used.force(s.q, s.qd, a);
    used.momentum(other.q, other.qd, a);
    used.velocity(s.q, s.qd, a);
    fresh.velocity(s.q, s.qd, b);
    EXPECT_EQ(a, b);
    const long before = allocation_count();
    used.force(other.q, other.qd, a);
    EXPECT_EQ(allocation_count(), before);
    fresh.force(other.q, other.qd, b);
    EXPECT_EQ(a, b);
    fresh.force(s.q, other.qd, b);  // negative control: another configuration has another answer
    EXPECT_NE(a, b);
  }
}

}  // namespace
}  // namespace chainreel::test
