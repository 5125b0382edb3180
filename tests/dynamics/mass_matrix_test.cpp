#include <algorithm>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "dynamics/compare.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

// Every kind of chain that the algorithms know.
std::vector<Chain> all_kinds_of_chains() {
  std::vector<Chain> chains{rr_chain(), rrr_chain(), pp_chain(), arm_chain(1)};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    chains.push_back(random_tree(seed, {.bodies = 12, .massless = 0.2}));
    chains.push_back(random_tree(seed, {.bodies = 12, .mimic = 0.4}));
    chains.push_back(random_tree(seed, {.bodies = 12, .floating_base = true, .floating = 0.2, .mimic = 0.2}));
    chains.push_back(random_planar_tree(seed, {.bodies = 12, .mimic = 0.3, .massless = 0.2}));
  }
  return chains;
}

// M unit_k = RNEA(qdd = unit_k) - RNEA(qdd = 0)
Eigen::MatrixXd mass_matrix_by_columns(const Chain& chain, Workspace& ws, const State& s) {
  const auto n = std::size_t(chain.nv);
  compute_nle(chain, ws, s.q, s.qd);
  const std::vector<double> nle = ws.nle;
  Eigen::MatrixXd M(chain.nv, chain.nv);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> unit(n, 0.0);
    unit[k] = 1;
    compute_inverse_dynamics(chain, ws, s.q, s.qd, unit);
    M.col(Eigen::Index(k)) = as_vector(ws.tau) - as_vector(nle);
  }
  return M;
}

double largest_column_difference(const Chain& chain, const Chain& chain_of_columns) {
  Workspace ws(chain), ws_of_columns(chain_of_columns);
  Random random(5);
  double largest = 0;
  for (int k = 0; k < 5; ++k) {
    const State s = random_state(chain, random);
    compute_mass_matrix(chain, ws, s.q);
    largest = std::max(largest,
                       relative_difference(ws.M, mass_matrix_by_columns(chain_of_columns, ws_of_columns, s)));
  }
  return largest;
}

// The columns are differences of torques that hold gravity and velocities too: about ten times as large as
// M's numbers.
constexpr double kMassTolerance = 1e-12;

TEST(MassMatrixTest, ColumnsAreInverseDynamicsOfUnitAcceleration) {
  for (const Chain& chain : all_kinds_of_chains()) {
    EXPECT_LT(largest_column_difference(chain, chain), kMassTolerance) << chain.name;
  }
}

TEST(MassMatrixTest, ColumnsOfAnotherMassDiffer) {
  for (const Chain& chain : {rr_chain(), arm_chain(1)}) {
    EXPECT_GT(largest_column_difference(chain, with_changed_mass(chain, 2, 1 + 1e-9)), kMassTolerance);
  }
}

TEST(MassMatrixTest, IsSymmetricAndPositiveDefinite) {
  Random random(6);
  for (const Chain& chain : all_kinds_of_chains()) {
    Workspace ws(chain);
    compute_mass_matrix(chain, ws, random_state(chain, random).q);
    EXPECT_EQ(ws.M, ws.M.transpose()) << chain.name;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(ws.M).eigenvalues()(0), 0) << chain.name;
  }
}

TEST(MassMatrixTest, GivesTheKineticEnergyOfAllBodies) {
  Random random(7);
  for (const Chain& chain : all_kinds_of_chains()) {
    Workspace ws(chain);
    const State s = random_state(chain, random);
    compute_mass_matrix(chain, ws, s.q);
    const double by_matrix = 0.5 * as_vector(s.qd).dot(ws.M * as_vector(s.qd));
    const double by_bodies = energy_of(chain, ws, s.q, s.qd).kinetic;
    EXPECT_NEAR(by_matrix / by_bodies, 1, 1e-12) << chain.name;  // sums of up to 200 rounded terms
    const Chain other = with_changed_mass(chain, int(chain.bodies.size()) - 1, 1.001);
    Workspace ws_other(other);
    EXPECT_GT(std::abs(by_matrix / energy_of(other, ws_other, s.q, s.qd).kinetic - 1), 1e-12) << chain.name;
  }
}

}  // namespace
}  // namespace chainreel::test
