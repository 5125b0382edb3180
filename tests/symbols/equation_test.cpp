// The equation in symbols is that of the recursions, number by number, and of the lecture, word by word.
#include "symbols/equation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/effective_mass.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"
#include "support/chains.hpp"
#include "symbols/notation.hpp"

namespace chainreel::test {
namespace {

using testing::HasSubstr;

// Some thousand roundings of terms that cancel in part, of numbers up to 100.
constexpr double kTolerance = 1e-9;

Eigen::MatrixXd numbers(const FormulaMatrix& m, const SymbolicValues& values) {
  Eigen::MatrixXd result(m.rows, m.columns);
  for (int r = 0; r < m.rows; ++r)
    for (int c = 0; c < m.columns; ++c) result(r, c) = value_of(m.at(r, c), values.symbols, values.angles);
  return result;
}

Eigen::VectorXd numbers(const std::vector<Formula>& list, const SymbolicValues& values) {
  Eigen::VectorXd result(Eigen::Index(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i)
    result[Eigen::Index(i)] = value_of(list[i], values.symbols, values.angles);
  return result;
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  EXPECT_EQ(a.rows(), b.rows());
  EXPECT_EQ(a.cols(), b.cols());
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

Eigen::Map<const Eigen::VectorXd> as_eigen(const std::vector<double>& v) {
  return {v.data(), Eigen::Index(v.size())};
}

// The largest of all differences in one state; Lambda where J is regular enough for its inverse to have digits.
double difference_at(const Chain& chain, const SymbolicEquation& equation, const State& s, bool& compared_lambda) {
  Workspace ws(chain);
  const SymbolicValues values = values_at(equation, s.q, s.qd);
  const Eigen::MatrixXd M = numbers(equation.M, values), C = numbers(equation.C, values);
  compute_mass_matrix(chain, ws, s.q);
  double largest = difference(M, ws.M);
  compute_gravity_torque(chain, ws, s.q);
  largest = std::max(largest, difference(numbers(equation.g, values), as_eigen(ws.tau_g)));
  compute_nle(chain, ws, s.q, s.qd);
  largest = std::max(largest, difference(C * as_eigen(s.qd) + numbers(equation.g, values), as_eigen(ws.nle)));
  largest = std::max(largest, difference(C, coriolis_matrix_of(chain, s.q, s.qd)));
  Eigen::VectorXd tau_f = numbers(equation.damping, values);
  const Eigen::VectorXd sign = numbers(equation.friction, values);
  for (Eigen::Index i = 0; i < tau_f.size(); ++i) tau_f[i] += sign[i] * std::tanh(s.qd[std::size_t(i)] / kFrictionSmoothing);
  compute_friction(chain, ws, s.qd);
  largest = std::max(largest, difference(tau_f, as_eigen(ws.tau_f)));
  if (chain.end_effector < 0) return largest;
  compute_kinematics(chain, ws, s.q, s.qd);
  compute_jacobian(chain, ws, s.q, chain.end_effector, Task::linear);
  largest = std::max(largest, difference(numbers(equation.J, values), ws.J));
  const EffectiveMass effective = effective_mass_of(chain, ws, s.q, chain.end_effector, Task::linear);
  if (!equation.Lambda || !effective.Lambda || effective.mobility[0] < 0.05 * effective.mobility.maxCoeff()) return largest;
  compared_lambda = true;
  const double root = value_of(equation.Lambda->root, values.symbols, values.angles);
  return std::max(largest, difference(numbers(equation.Lambda->numerator, values) / (root * root), *effective.Lambda));
}

// A hundred states.
void expect_equal(const Chain& chain, bool has_lambda) {
  const SymbolicEquation equation = symbolic_equation_of(chain);
  EXPECT_EQ(equation.Lambda.has_value(), has_lambda) << chain.name;
  Random random(3);
  bool compared_lambda = false;
  for (int k = 0; k < 100; ++k)
    EXPECT_LT(difference_at(chain, equation, random_state(chain, random), compared_lambda), kTolerance) << chain.name;
  EXPECT_EQ(compared_lambda, has_lambda) << chain.name;
}

TEST(SymbolicEquation, IsThatOfTheRecursionsForTheLecturesChains) {
  for (Chain chain : {rr_chain({.L1 = 0.7, .L2 = 1.3, .m1 = 2, .m2 = 0.5}), pp_chain()}) expect_equal(chain, true);
  expect_equal(rrr_chain(), false);
  // Negative control: one length a thousandth longer is seen.
  const Chain chain = rr_chain(), longer = rr_chain({.L2 = 1.001});
  Random random(4);
  bool compared = false;
  EXPECT_GT(difference_at(longer, symbolic_equation_of(chain), random_state(chain, random), compared), 1e4 * kTolerance);
}

// Joints' frames and axes by right angles, all else of them at random.
Chain right_angled(std::uint64_t seed, const TreeOptions& options) {
  Chain chain = random_tree(seed, options);
  Random random(seed);
  const auto axis = [&] { return (random.below(2) == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(random.below(3)); };
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    Joint& joint = chain.bodies[i].joint;
    joint.axis = axis();
    const double quarter = std::numbers::pi / 2 * random.below(4);
    joint.X_PJ.linear() = Eigen::AngleAxisd(quarter, axis()).toRotationMatrix();
    joint.damping = random.between(0, 1), joint.friction = random.between(0, 1);
  }
  finish(chain);
  chain.has_dissipation = true;
  chain.end_effector = int(chain.frames.size()) - 1;
  return chain;
}

TEST(SymbolicEquation, IsThatOfTheRecursionsForChainsInSpace) {
  int spatial = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Chain chain = right_angled(seed, {.bodies = seed <= 6 ? 3 : 4, .serial = seed % 2 == 0});
    spatial += !chain.planar;
    const SymbolicEquation equation = symbolic_equation_of(chain);
    bool compared_lambda = false;
    Random random(seed);
    for (int k = 0; k < 20; ++k)
      EXPECT_LT(difference_at(chain, equation, random_state(chain, random), compared_lambda), kTolerance) << chain.name;
  }
  EXPECT_GE(spatial, 6);
}

TEST(SymbolicEquation, IsThatOfTheRecursionsForPlanarTreesInAnyPlane) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Chain chain = random_planar_tree(seed, {.bodies = 4, .serial = seed % 2 == 0});
    chain.end_effector = int(chain.frames.size()) - 1;
    ASSERT_TRUE(chain.planar);
    const SymbolicEquation equation = symbolic_equation_of(chain);
    Random random(seed);
    bool compared = false;
    for (int k = 0; k < 20; ++k)
      EXPECT_LT(difference_at(chain, equation, random_state(chain, random), compared), kTolerance) << seed;
  }
}

// The lecture: M11 = m1 L1^2 + m2 (L1^2 + 2 L1 L2 cos q2 + L2^2), M12 = m2 (L1 L2 cos q2 + L2^2), M22 = m2 L2^2;
// c = (-m2 L1 L2 sin q2 (2 qd1 qd2 + qd2^2), m2 L1 L2 qd1^2 sin q2); g = ((m1 + m2) L1 g cos q1 + m2 g L2 cos(q1 + q2), ..).
TEST(SymbolicEquation, OfRrIsTheLecturesTermByTerm) {
  const SymbolicEquation rr = symbolic_equation_of(rr_chain());
  const auto told = [&](const Formula& formula) { return formula_in(Notation::text, rr, formula, "theta"); };
  EXPECT_EQ(told(rr.M.at(0, 0)), "(m_1 + m_2) L_1^2 + m_2 L_2^2 + 2 m_2 L_1 L_2 cos(theta_2)");
  EXPECT_EQ(told(rr.M.at(0, 1)), "m_2 L_2^2 + m_2 L_1 L_2 cos(theta_2)");
  EXPECT_EQ(told(rr.M.at(1, 0)), told(rr.M.at(0, 1)));
  EXPECT_EQ(told(rr.M.at(1, 1)), "m_2 L_2^2");
  EXPECT_EQ(told(rr.C.at(0, 0)), "-m_2 L_1 L_2 thetad_2 sin(theta_2)");
  EXPECT_EQ(told(rr.C.at(0, 1)), "-m_2 L_1 L_2 (thetad_1 + thetad_2) sin(theta_2)");
  EXPECT_EQ(told(rr.C.at(1, 0)), "m_2 L_1 L_2 thetad_1 sin(theta_2)");
  EXPECT_EQ(told(rr.C.at(1, 1)), "0");
  EXPECT_EQ(told(rr.g[0]), "(m_1 + m_2) L_1 g cos(theta_1) + m_2 L_2 g cos(theta_1 + theta_2)");
  EXPECT_EQ(told(rr.g[1]), "m_2 L_2 g cos(theta_1 + theta_2)");
  EXPECT_EQ(told(rr.Lambda->root), "sin(theta_2)");
}

TEST(SymbolicEquation, SaysRodsByTheirMassAndLength) {
  const SymbolicEquation rrr = symbolic_equation_of(rrr_chain());
  EXPECT_EQ(formula_in(Notation::text, rrr, rrr.M.at(2, 2)), "1/3 m_3 L_3^2");
  for (const Symbol& symbol : rrr.symbols) EXPECT_NE(symbol.kind, SymbolKind::inertia);
}

std::string trouble(const Chain& chain) {
  try {
    symbolic_equation_of(chain);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SymbolicEquation, RefusesWhatItCannotSay) {
  EXPECT_THAT(trouble(arm_chain(1)), HasSubstr("for 1 to 4 joints"));
  EXPECT_THAT(trouble(random_tree(3, {.bodies = 2, .floating_base = true})), HasSubstr("fixed base"));
  EXPECT_THAT(trouble(random_tree(3, {.bodies = 3})), HasSubstr("no right angle"));
  Chain follows = rr_chain();
  follows.bodies[2].joint.q_index = follows.bodies[2].joint.v_index = 0;
  follows.bodies[2].joint.ratio = 0.5;
  finish(follows);
  follows.bodies[2].joint.ratio = 0.5;
  follows.bodies[2].joint.v_index = 0;
  EXPECT_THAT(trouble(follows), HasSubstr("ratio"));
}

}  // namespace
}  // namespace chainreel::test
