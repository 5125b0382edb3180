#include <gtest/gtest.h>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

std::vector<Chain> chains_with_christoffel_symbols() {
  std::vector<Chain> chains{rr_chain(), rrr_chain(), pp_chain(), arm_chain(7)};
  for (std::uint64_t seed = 110; seed < 120; ++seed) {
    chains.push_back(random_tree(seed, {.bodies = 8, .mimic = 0.3}));
    chains.push_back(random_tree(seed, {.bodies = 8, .floating_base = true, .floating = 0.2}));
    chains.push_back(random_planar_tree(seed, {.bodies = 8}));
  }
  return chains;
}

// M after moving along qd for a time h.
Eigen::MatrixXd mass_matrix_after(const Chain& chain, const State& s, double h) {
  Workspace ws(chain);
  std::vector<double> q = s.q;
  advance(chain, q, s.qd, h);
  compute_mass_matrix(chain, ws, q);
  return ws.M;
}

// By central differences of order four.
Eigen::MatrixXd rate_of_mass_matrix(const Chain& chain, const State& s) {
  const double h = 1e-3;
  const auto difference = [&](double step) {
    return Eigen::MatrixXd((mass_matrix_after(chain, s, step) - mass_matrix_after(chain, s, -step)) /
                           (2 * step));
  };
  return (4 * difference(h) - difference(2 * h)) / 3;
}

TEST(CoriolisTest, TimesRatesPlusGravityIsNle) {
  Random random(111);
  for (const Chain& chain : chains_with_christoffel_symbols()) {
    const State s = random_state(chain, random);
    Workspace ws(chain);
    compute_nle(chain, ws, s.q, s.qd);
    compute_gravity_torque(chain, ws, s.q);
    const Eigen::VectorXd sum = coriolis_matrix_of(chain, s.q, s.qd) * as_vector(s.qd) + as_vector(ws.tau_g);
    EXPECT_LT(relative_difference(Eigen::MatrixXd(sum), as_vector(ws.nle)), 1e-12) << chain.name;
  }
}

// Mdot - 2 C is skew exactly where Mdot = C + C^T.
TEST(CoriolisTest, MdotMinusTwoCIsSkew) {
  Random random(112);
  for (const Chain& chain : chains_with_christoffel_symbols()) {
    const State s = random_state(chain, random, 1);
    const Eigen::MatrixXd C = coriolis_matrix_of(chain, s.q, s.qd);
    const Eigen::MatrixXd skew = rate_of_mass_matrix(chain, s) - 2 * C;
    // differences of order four miss by h^4 times the fifth derivative of M along the motion
    EXPECT_LT((skew + skew.transpose()).cwiseAbs().maxCoeff(), 1e-8 * (1 + C.cwiseAbs().maxCoeff()))
        << chain.name;
  }
}

TEST(CoriolisTest, COfOtherRatesIsNotSkew) {
  Random random(113);
  const Chain chain = arm_chain(8);
  const State s = random_state(chain, random, 1);
  std::vector<double> qd = s.qd;
  qd[2] += 1e-3;
  const Eigen::MatrixXd C = coriolis_matrix_of(chain, s.q, qd);
  const Eigen::MatrixXd skew = rate_of_mass_matrix(chain, s) - 2 * C;
  EXPECT_GT((skew + skew.transpose()).cwiseAbs().maxCoeff(), 1e-8 * (1 + C.cwiseAbs().maxCoeff()));
}

// Modern Robotics, eq. 8.9 and 8.17: -m2 L1 L2 s2 [[qd2, qd1 + qd2], [-qd1, 0]].
TEST(CoriolisTest, IsTheBooksMatrixForRr) {
  const Chain chain = rr_chain();
  const std::vector<double> q{0.3, 1.1}, qd{2, -0.7};
  const Eigen::Matrix2d book = -std::sin(1.1) * Eigen::Matrix2d{{-0.7, 1.3}, {-2, 0}};
  EXPECT_LT((coriolis_matrix_of(chain, q, qd) - book).cwiseAbs().maxCoeff(), 16 * kRoundOff);
}

// By their definition, with M differentiated along each coordinate. Mimic joints share coordinates.
TEST(CoriolisTest, IsMadeOfChristoffelSymbols) {
  Random random(114);
  std::vector<Chain> chains{rrr_chain(), pp_chain(), arm_chain(7)};
  for (std::uint64_t seed = 120; seed < 126; ++seed) {
    chains.push_back(random_tree(seed, {.bodies = 8, .mimic = 0.3}));
    chains.push_back(random_planar_tree(seed, {.bodies = 8}));
  }
  for (const Chain& chain : chains) {
    State s = random_state(chain, random, 1);
    const std::vector<double> qd = s.qd;
    const Eigen::Index n = chain.nv;
    std::vector<Eigen::MatrixXd> dM;
    for (Eigen::Index k = 0; k < n; ++k) {
      s.qd.assign(std::size_t(n), 0.0);
      s.qd[std::size_t(k)] = 1;
      dM.push_back(rate_of_mass_matrix(chain, s));
    }
    Eigen::MatrixXd symbols = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index k = 0; k < n; ++k)
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          symbols(i, j) += 0.5 * (dM[std::size_t(k)](i, j) + dM[std::size_t(j)](i, k) - dM[std::size_t(i)](j, k)) * qd[std::size_t(k)];
    const Eigen::MatrixXd C = coriolis_matrix_of(chain, s.q, qd);
    // as above: differences of order four
    EXPECT_LT((C - symbols).cwiseAbs().maxCoeff(), 1e-8 * (1 + C.cwiseAbs().maxCoeff())) << chain.name;
  }
}

}  // namespace
}  // namespace chainreel::test
