// One text, several algebras: they must agree.
#include <algorithm>

#include <gtest/gtest.h>

#include "dynamics/compare.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"
#include "dynamics/recursions.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

struct Results {
  Eigen::MatrixXd M;
  std::vector<double> nle, qdd;
  std::vector<Eigen::Vector3d> p, v;
};

Results results_of(const Chain& chain, const State& s) {
  Workspace ws(chain);
  compute_mass_matrix(chain, ws, s.q);
  compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
  compute_nle(chain, ws, s.q, s.qd);
  compute_kinematics(chain, ws, s.q, s.qd);
  Results results{ws.M, ws.nle, ws.qdd, {}, ws.v_WB};
  for (const auto& X : ws.X_WB) results.p.push_back(X.translation());
  return results;
}

double difference(const Results& a, const Results& b) {
  double largest = relative_difference(a.M, b.M);
  largest = std::max(largest, relative_difference(a.nle, b.nle));
  // an acceleration has the condition of M, a torque has not
  const Eigen::VectorXd torque = b.M * (as_vector(a.qdd) - as_vector(b.qdd));
  const double scale = (b.M.cwiseAbs() * as_vector(b.qdd).cwiseAbs()).maxCoeff();
  largest = std::max(largest, torque.cwiseAbs().maxCoeff() / scale);
  for (std::size_t i = 1; i < a.p.size(); ++i) {
    largest = std::max({largest, (a.p[i] - b.p[i]).norm() / (1 + b.p[i].norm()),
                        (a.v[i] - b.v[i]).norm() / (1 + b.v[i].norm())});
  }
  return largest;
}

TEST(AlgebraTest, PlanarEqualsSpatial) {
  Random random(51);
  for (std::uint64_t seed = 50; seed < 100; ++seed) {
    TreeOptions options{.bodies = 2 + random.below(20), .serial = seed % 2 == 0};
    options.mimic = seed % 3 == 0 ? 0.3 : 0;
    options.massless = 0.1;
    const Chain chain = random_planar_tree(seed, options, seed % 5 != 0);
    ASSERT_TRUE(chain.planar) << chain.why_algebra;
    const State s = random_state(chain, random);
    const Results planar = results_of(chain, s);
    EXPECT_LT(difference(planar, results_of(without_planar_form(chain), s)), 1e-12) << chain.name;
    const Chain other = without_planar_form(with_changed_mass(chain, options.bodies, 1 + 1e-9));
    EXPECT_GT(difference(planar, results_of(other, s)), 1e-12) << chain.name;
  }
}

// Forward dynamics over another scalar, as doubles.
template <class A>
std::vector<double> acceleration_over(const Chain& chain, const State& s,
                                      const std::vector<double>& direction = {}) {
  using T = typename A::Scalar;
  Links<A> links(chain);
  std::vector<T> q(s.q.begin(), s.q.end()), qd(s.qd.begin(), s.qd.end()), tau(s.tau.begin(), s.tau.end());
  if constexpr (std::is_same_v<T, Dual<double>>) {
    for (std::size_t i = 0; i < direction.size(); ++i) q[i].du = direction[i];
  }
  std::vector<T> qdd(qd.size());
  place(links, ConstScalarSpan<A>(q));
  aba(links, links.base_acceleration, ConstScalarSpan<A>(qd), ConstScalarSpan<A>(tau), ScalarSpan<A>(qdd));
  std::vector<double> result;
  for (const T& x : qdd) {
    if constexpr (std::is_same_v<T, Dual<double>>) {
      result.push_back(direction.empty() ? x.re : x.du);
    } else {
      result.push_back(value_of(x));
    }
  }
  return result;
}

TEST(AlgebraTest, QuadNumbersRoundToTheDoubles) {
  Random random(52);
  for (std::uint64_t seed = 50; seed < 60; ++seed) {
    const Chain planar = random_planar_tree(seed, {.bodies = 6});
    const Chain tree = random_tree(seed, {.bodies = 6, .floating_base = seed % 2 == 0});
    const State s = random_state(planar, random), t = random_state(tree, random);
    // in double precision: round-off times the condition of M, some thousands
    EXPECT_LT(relative_difference(acceleration_over<Planar<double>>(planar, s),
                                  acceleration_over<Planar<Quad>>(planar, s)),
              1e-11);
    EXPECT_LT(relative_difference(acceleration_over<Spatial<double>>(tree, t),
                                  acceleration_over<Spatial<Quad>>(tree, t)),
              1e-11);
    // planar and spatial in quad numbers: what is left is the planar form, made in double precision
    EXPECT_LT(relative_difference(acceleration_over<Planar<Quad>>(planar, s),
                                  acceleration_over<Spatial<Quad>>(planar, s)),
              1e-11);
  }
}

// RR's masses and lengths are exact: there planar and spatial agree beyond what a double can tell apart.
TEST(AlgebraTest, QuadNumbersAreNotDoublesInDisguise) {
  Random random(53);
  const Chain chain = rr_chain();
  const State s = random_state(chain, random);
  const auto planar = acceleration_over<Planar<Quad>>(chain, s);
  EXPECT_EQ(planar, acceleration_over<Spatial<Quad>>(chain, s));
  int different = 0;
  for (int k = 0; k < 20; ++k) {
    const State other = random_state(chain, random);
    different +=
        acceleration_over<Planar<double>>(chain, other) != acceleration_over<Planar<Quad>>(chain, other);
  }
  EXPECT_GT(different, 0);
}

TEST(AlgebraTest, DualNumbersCarryTheDerivative) {
  Random random(54);
  const Chain planar = random_planar_tree(61, {.bodies = 5});
  const Chain tree = random_tree(62, {.bodies = 5});
  const auto check = [&]<class Over, class Plain>(const Chain& chain, Over, Plain) {
    const State s = random_state(chain, random, 1);
    const std::vector<double> direction = random_vector(s.q.size(), random, 1);
    const auto derivative = acceleration_over<Over>(chain, s, direction);
    EXPECT_EQ(acceleration_over<Over>(chain, s), acceleration_over<Plain>(chain, s));
    const auto error = [&](double h) {
      State ahead = s, behind = s;
      for (std::size_t i = 0; i < s.q.size(); ++i) {
        ahead.q[i] += h * direction[i];
        behind.q[i] -= h * direction[i];
      }
      const auto a = acceleration_over<Plain>(chain, ahead), b = acceleration_over<Plain>(chain, behind);
      return ((as_vector(a) - as_vector(b)) / (2 * h) - as_vector(derivative)).norm();
    };
    EXPECT_NEAR(error(2e-3) / error(1e-3), 4, 0.2) << chain.name;  // central differences: order two
  };
  check(planar, Planar<Dual<double>>{}, Planar<double>{});
  check(tree, Spatial<Dual<double>>{}, Spatial<double>{});
}

}  // namespace
}  // namespace chainreel::test
