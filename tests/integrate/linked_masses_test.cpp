#include "integrate/linked_masses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace chainreel {
namespace {

using Links = std::vector<LinkedPoints::Link>;

double between(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * double(engine() >> 11) * 0x1p-53;
}

// Point masses, or rods, each with a positive definite pair of ends.
Links random_links(std::mt19937_64& engine, std::size_t n, bool rods) {
  Links links(n);
  for (LinkedPoints::Link& link : links) {
    link.a = between(engine, 0.5, 2), link.c = between(engine, 0.5, 2);
    link.b = rods ? between(engine, -0.45, 0.45) : 0;
  }
  return links;
}

std::vector<Vec2> multiply(const Links& links, const std::vector<Vec2>& x) {
  const std::size_t n = x.size();
  std::vector<Vec2> y(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = i > 0 ? x[i - 1] : Vec2{};
    y[i] = y[i] + x[i] * links[i].c + before * links[i].b;
    if (i > 0) y[i - 1] = y[i - 1] + x[i] * links[i].b + before * links[i].a;
  }
  return y;
}

// The largest of what the two conditions of `correct` leave.
double residual(const Links& links, bool wrong_mass, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const std::size_t n = links.size();
  std::vector<Vec2> d(n), e(n), move(n);
  std::vector<double> change(n), lambda(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = between(engine, -3, 3), turned = angle + between(engine, -0.3, 0.3);
    d[i] = {std::cos(angle), std::sin(angle)};
    e[i] = {std::cos(turned), std::sin(turned)};
    change[i] = between(engine, -1, 1);
  }
  Links used = links;
  if (wrong_mass) used[0].c *= 1.01;
  LinkedMasses masses(used);
  masses.correct(e, d, change, lambda, move);
  const std::vector<Vec2> impulse = multiply(links, move);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 next = i + 1 < n ? d[i + 1] * lambda[i + 1] : Vec2{};
    const Vec2 left = impulse[i] + d[i] * lambda[i] - next;
    largest = std::max({largest, std::fabs(left.x), std::fabs(left.y)});
    const Vec2 part = i > 0 ? move[i] - move[i - 1] : move[i];
    largest = std::max(largest, std::fabs(dot(e[i], part) - change[i]));
  }
  return largest;
}

// Round-off of a few products a link, with impulses up to some hundred.
constexpr double kSolved = 1e-12;

TEST(LinkedMasses, CorrectsLinksByImpulsesAlongThem) {
  std::mt19937_64 engine(5);
  for (const bool rods : {false, true}) {
    for (const std::size_t n : {1u, 2u, 3u, 7u, 40u}) {
      const Links links = random_links(engine, n, rods);
      EXPECT_LT(residual(links, false, n), kSolved) << n << rods;
      EXPECT_GT(residual(links, true, n), 1e-4) << n << rods;  // negative control
    }
  }
}

template <std::size_t k>
double difference_when_unrolled() {
  std::mt19937_64 engine(k);
  LinkedMasses masses(random_links(engine, k, false));
  std::array<Vec2, k> e, d, move, general;
  std::array<double, k> change, lambda, impulse;
  for (std::size_t i = 0; i < k; ++i) {
    const double angle = between(engine, -3, 3);
    d[i] = {std::cos(angle), std::sin(angle)};
    e[i] = {std::cos(angle + 0.2), std::sin(angle + 0.2)};
    change[i] = between(engine, -1, 1);
  }
  masses.correct_single(e, d, change, lambda, move);
  masses.correct(e, d, change, impulse, general);
  double largest = 0;
  for (std::size_t i = 0; i < k; ++i) {
    const Vec2 off = move[i] - general[i];
    largest = std::max({largest, std::fabs(off.x), std::fabs(off.y), std::fabs(lambda[i] - impulse[i])});
  }
  return largest;
}

TEST(LinkedMasses, CorrectTheSameWhenUnrolled) {
  EXPECT_LT(difference_when_unrolled<1>(), kSolved);
  EXPECT_LT(difference_when_unrolled<2>(), kSolved);
  EXPECT_LT(difference_when_unrolled<3>(), kSolved);
  EXPECT_LT(difference_when_unrolled<4>(), kSolved);
}

TEST(LinkedMasses, AcceleratesAsTheirMatrixSays) {
  std::mt19937_64 engine(6);
  for (const bool rods : {false, true}) {
    const Links links = random_links(engine, 9, rods);
    std::vector<Vec2> f(9);
    for (Vec2& one : f) one = {between(engine, -1, 1), between(engine, -1, 1)};
    std::vector<Vec2> a = f;
    LinkedMasses(links).accelerate(a);
    const std::vector<Vec2> back = multiply(links, a);
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_NEAR(back[i].x, f[i].x, 1e-14);  // round-off of two sweeps
      EXPECT_NEAR(back[i].y, f[i].y, 1e-14);
    }
  }
}

}  // namespace
}  // namespace chainreel
