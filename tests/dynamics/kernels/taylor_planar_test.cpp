#include "dynamics/kernels/taylor_planar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <quadmath.h>

#include "dynamics/compare.hpp"
#include "dynamics/kernels/taylor_planar_state.hpp"
#include "dynamics/recursions.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

// Serial, revolute, axes along and against the normal, centres of mass anywhere, gravity in any direction.
Chain chain_of(std::uint64_t seed, int bodies) {
  return random_planar_tree(seed, {.bodies = bodies, .serial = true, .prismatic = 0}, seed % 2 != 0);
}

AffineTorque no_torque(int n) {
  return {std::vector<std::vector<Quad>>(std::size_t(n)), std::vector<Quad>(std::size_t(n * n)),
          std::vector<Quad>(std::size_t(n * n))};
}

AffineTorque random_torque(int n, Random& random) {
  AffineTorque torque = no_torque(n);
  for (auto& powers : torque.powers)
    for (int k = random.below(4); k >= 0; --k) powers.push_back(random.between(-2, 2));
  for (Quad& x : torque.K) x = random.between(-3, 3);
  for (Quad& x : torque.D) x = random.between(-1, 1);
  return torque;
}

std::vector<Quad> in_quad(const std::vector<double>& x) {
  return {x.begin(), x.end()};
}

// sum_k factor(k) c_k s^(k - lost) of each joint.
std::vector<Quad> polynomial(const std::vector<Quad>& c, int n, Quad s, int derivative) {
  const int order = int(c.size()) / n - 1;
  std::vector<Quad> sum(static_cast<std::size_t>(n));
  for (int k = order; k >= derivative; --k)
    for (int i = 0; i < n; ++i)
      sum[std::size_t(i)] = sum[std::size_t(i)] * s + c[std::size_t(k * n + i)] * (derivative > 0 ? k : 1) *
                                                          (derivative > 1 ? k - 1 : 1);
  return sum;
}

std::vector<Quad> torque_at(const AffineTorque& torque, const Chain& chain, Quad t,
                            const std::vector<Quad>& q, const std::vector<Quad>& qd) {
  const std::size_t n = q.size();
  std::vector<Quad> tau(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = torque.powers[i].size(); k-- > 0;) tau[i] = tau[i] * t + torque.powers[i][k];
    for (std::size_t j = 0; j < n; ++j) tau[i] += torque.K[i * n + j] * q[j] + torque.D[i * n + j] * qd[j];
    tau[i] -= Quad(chain.bodies[i + 1].joint.damping) * qd[i];
  }
  return tau;
}

// By how much the series misses the equations of motion at s, as the articulated-body algorithm has them,
// against the largest acceleration.
double defect(const Chain& chain, const AffineTorque& torque, Quad t, const std::vector<Quad>& c, Quad s) {
  const std::vector<Quad> q = polynomial(c, chain.nv, s, 0), qd = polynomial(c, chain.nv, s, 1),
                          series = polynomial(c, chain.nv, s, 2);
  const std::vector<Quad> tau = torque_at(torque, chain, t + s, q, qd);
  std::vector<Quad> qdd(q.size());
  Links<Planar<Quad>> links(chain);
  place<Planar<Quad>>(links, q);
  aba<Planar<Quad>>(links, links.base_acceleration, qd, tau, qdd);
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    worst = std::max(worst, std::abs(double(qdd[i] - series[i])));
    size = std::max(size, std::abs(double(qdd[i])));
  }
  return worst / size;
}

class ChainsOfAnyLength : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Joints, ChainsOfAnyLength, ::testing::Values(1, 2, 3, 4, 5, 8));

// The series of order N leaves s^(N-1) of the acceleration out: a defect that falls by 2^(N-1) when s halves
// has every coefficient right, whatever the second text says about the first.
TEST_P(ChainsOfAnyLength, SolvesTheEquationsOfMotionToItsOrder) {
  Random random(900);
  for (std::uint64_t seed = 900; seed < 906; ++seed) {
    Chain chain = chain_of(seed, GetParam());
    const int n = chain.nv;
    if (seed % 3 == 0) chain.bodies[std::size_t(n)].joint.damping = 0.7;
    const AffineTorque torque = random_torque(n, random);
    const State s = random_state(chain, random, 1);
    constexpr int kOrder = 12;
    PlanarSeries<Quad> series(chain, torque, kOrder);
    std::vector<Quad> c(std::size_t(n * (kOrder + 1)));
    const Quad t = random.between(-1, 1);
    series.expand(t, in_quad(s.q), in_quad(s.qd), kOrder, c);
    // From here on 2^4 and 2^5 times shorter: the second term left is a small part of the first, which is
    // still 1e4 roundings of a Quad.
    Quad h = 1;
    while (defect(chain, torque, t, c, h) > 1e-12) h /= 2;
    const double ratio = defect(chain, torque, t, c, h / 16) / defect(chain, torque, t, c, h / 32);
    EXPECT_NEAR(std::log2(ratio), kOrder - 1, 0.5) << "seed " << seed << ", s = " << double(h);

    // One coefficient off by a part in a million shows as the order that it stands at.
    c[std::size_t(8 * n)] *= 1 + 1e-6Q;
    const double broken = defect(chain, torque, t, c, h / 16) / defect(chain, torque, t, c, h / 32);
    EXPECT_NEAR(std::log2(broken), 6, 0.5) << "seed " << seed;
  }
}

// A series of a chain under a torque at a state, all of them random, in numbers of one kind beside the same in Quads.
template <class T>
struct BesideQuads {
  int n = 0;
  std::vector<Quad> exact;
  std::vector<T> c;

  BesideQuads(std::uint64_t seed, int bodies, int order, Random& random) {
    const Chain chain = chain_of(seed, bodies);
    n = chain.nv;
    const AffineTorque torque = random_torque(n, random);
    const State s = random_state(chain, random, 1);
    exact.resize(std::size_t(n * (order + 1)));
    c.resize(exact.size());
    PlanarSeries<Quad>(chain, torque, order).expand(0.5, in_quad(s.q), in_quad(s.qd), order, exact);
    const std::vector<T> q(s.q.begin(), s.q.end()), qd(s.qd.begin(), s.qd.end());
    PlanarSeries<T>(chain, torque, order).expand(0.5, q, qd, order, c);
  }
};

TEST_P(ChainsOfAnyLength, HasTheDigitsOfADouble) {
  Random random(910);
  for (std::uint64_t seed = 910; seed < 916; ++seed) {
    constexpr int kOrder = 20;
    const auto [n, exact, c] = BesideQuads<double>(seed, GetParam(), kOrder, random);
    for (int k = 0; k <= kOrder; ++k) {
      const auto row = std::span(exact).subspan(std::size_t(k * n), std::size_t(n));
      const std::vector<double> rounded(row.begin(), row.end());
      // Errors of each order feed the next ones, through masses that may differ a hundredfold.
      EXPECT_LT(relative_difference(std::span(c).subspan(std::size_t(k * n), std::size_t(n)), rounded),
                1e-11 * (k + 1))
          << "seed " << seed << ", order " << k;
    }
  }
}

TEST_P(ChainsOfAnyLength, HasTwiceThoseDigitsInDoubleDoubles) {
  Random random(920);
  double most_missed = 0;
  for (std::uint64_t seed = 920; seed < 926; ++seed) {
    constexpr int kOrder = 40;
    const auto [n, exact, c] = BesideQuads<DoubleDouble>(seed, GetParam(), kOrder, random);
    for (int k = 0; k <= kOrder; ++k) {
      Quad apart = 0, size = 0;
      double of_doubles = 0;
      for (int i = 0; i < n; ++i) {
        const auto at = std::size_t(k * n + i);
        apart = std::max(apart, fabsq(Quad(c[at]) - exact[at]));
        size = std::max(size, fabsq(exact[at]));
        of_doubles = std::max(of_doubles, double(fabsq(Quad(double(exact[at])) - exact[at])));
      }
      // The bound of doubles, 2^51 times smaller, which is how much more two doubles know than one.
      EXPECT_LT(double(apart), 1e-11 * 0x1p-51 * (k + 1) * double(size)) << "seed " << seed << ", order " << k;
      most_missed = std::max(most_missed, of_doubles / double(size));
    }
  }
  EXPECT_GT(most_missed, 1e-18) << "numbers of a single double fail it";
}

TEST(PlanarSeries, OfTwoHorizontalLinksAtRestHasEveryFourthTerm) {
  const Chain chain = rr_chain();
  constexpr int kOrder = 30;
  std::vector<double> c(2 * (kOrder + 1));
  PlanarSeries<double>(chain, no_torque(2), kOrder)
      .expand(0, std::vector{0.0, 0.0}, std::vector{0.0, 0.0}, kOrder, c);
  for (int k = 0; k <= kOrder; ++k) {
    if (k % 4 == 2)
      EXPECT_NE(c[std::size_t(2 * k)], 0) << k;
    else
      EXPECT_EQ(c[std::size_t(2 * k)], 0) << k;
  }
  EXPECT_DOUBLE_EQ(c[4], -9.81 / 2);  // the first link falls freely; the second keeps its direction
  EXPECT_NEAR(c[5], 9.81 / 2, 1e-15);
}

TEST(PlanarSeries, SaysWhichChainsHaveNone) {
  using ::testing::HasSubstr;
  const auto why = [](const Chain& chain) { return why_no_planar_series(chain).value_or(""); };
  EXPECT_EQ(why(rrr_chain()), "");
  EXPECT_THAT(why(arm_chain(1)), HasSubstr("plane"));
  EXPECT_THAT(why(pp_chain()), HasSubstr("not revolute"));
  EXPECT_THAT(why(random_planar_tree(4, {.bodies = 6, .prismatic = 0})), HasSubstr("branches"));
  Chain rough = rr_chain();
  rough.bodies[2].joint.friction = 0.1;
  EXPECT_THAT(why(rough), HasSubstr("friction"));
}

}  // namespace
}  // namespace chainreel::test
