#include "compare/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "compare/test_images.hpp"

namespace chainreel {
namespace {

using Vec = std::array<double, 3>;

std::vector<float> errors_of(const Image& a, const Image& b) {
  return Flip().errors(a, b, {0, 0, a.width, a.height});
}

// The paper once more, in double precision, over the plane and without separating a filter. Written from its
// equations: nothing is shared with the program.
namespace naive {

const double kXyz[3][3] = {
    {0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};

Vec linear(Pixel p) {
  const auto curve = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return {curve(p.r / 255.0), curve(p.g / 255.0), curve(p.b / 255.0)};
}

Vec xyz(Vec rgb) {
  Vec result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i] += kXyz[i][j] * rgb[j];
  return result;
}

const Vec kWhite = xyz({1, 1, 1});

Vec ycxcz(Vec rgb) {
  const Vec v = xyz(rgb);
  const double x = v[0] / kWhite[0], y = v[1] / kWhite[1], z = v[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// Linear RGB of YCxCz by Cramer's rule.
Vec rgb_of(Vec c) {
  const double y = (c[0] + 16) / 116;
  const Vec v = {(c[1] / 500 + y) * kWhite[0], y * kWhite[1], (y - c[2] / 200) * kWhite[2]};
  const auto det = [](const double m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  Vec rgb;
  for (int k = 0; k < 3; ++k) {
    double m[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] = j == k ? v[i] : kXyz[i][j];
    rgb[k] = std::clamp(det(m) / det(kXyz), 0.0, 1.0);
  }
  return rgb;
}

Vec hunt(Vec rgb) {
  const Vec v = xyz(rgb);
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (841.0 / 108) * t + 4.0 / 29; };
  const double x = f(v[0] / kWhite[0]), y = f(v[1] / kWhite[1]), z = f(v[2] / kWhite[2]), l = 116 * y - 16;
  return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}

double hyab(Vec a, Vec b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

double redistributed(Vec a, Vec b) {
  const double most = std::pow(hyab(hunt({0, 1, 0}), hunt({0, 0, 1})), 0.7), low = 0.4 * most;
  const double d = std::pow(hyab(a, b), 0.7);
  return d < low ? 0.95 / low * d : 0.95 + (d - low) / (most - low) * 0.05;
}

template <class Weight>
double filtered(const Image& image, int x, int y, int channel, int reach, Weight weight) {
  double sum = 0, positive = 0, negative = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const double w = weight(dx, dy);
        if (pass == 0) {
          (w > 0 ? positive : negative) += std::abs(w);
          continue;
        }
        const Pixel p =
            image.at(std::clamp(x + dx, 0, image.width - 1), std::clamp(y + dy, 0, image.height - 1));
        sum += w / (w > 0 ? positive : negative) * ycxcz(linear(p))[channel];
      }
  return sum;
}

double error(const Image& a, const Image& b, int x, int y) {
  const double pi = std::numbers::pi, ppd = 67;
  const auto seen = [&](const Image& image) {
    const auto gauss = [&](double a1, double b1, double a2, double b2) {
      return [=](int dx, int dy) {
        const double z = (dx * dx + dy * dy) / (ppd * ppd);
        return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * z / b1) +
               a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * z / b2);
      };
    };
    return hunt(rgb_of({filtered(image, x, y, 0, 10, gauss(1, 0.0047, 0, 1e-5)),
                        filtered(image, x, y, 1, 10, gauss(1, 0.0053, 0, 1e-5)),
                        filtered(image, x, y, 2, 10, gauss(34.1, 0.04, 13.5, 0.025))}));
  };
  const double sigma = 0.5 * 0.082 * ppd;
  const auto feature = [&](const Image& image, bool point) {
    const auto along = [&](bool vertical) {
      return filtered(image, x, y, 0, 9, [=](int dx, int dy) {
        const double g = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma)), d = vertical ? dy : dx;
        return point ? (d * d / (sigma * sigma) - 1) * g : -d * g;
      });
    };
    return std::hypot(along(false), along(true)) / 116;  // 116 Y - 16 by weights that sum to 0
  };
  const double color = redistributed(seen(a), seen(b));
  const double edge = std::abs(feature(a, false) - feature(b, false));
  const double point = std::abs(feature(a, true) - feature(b, true));
  return std::pow(color, 1 - std::sqrt(std::max(edge, point) / std::numbers::sqrt2));
}

}  // namespace naive

// Single precision beside double: the power 0.7 of a difference of some 1e-5 of L* is the coarsest.
constexpr double kSingle = 1e-3;

TEST(Flip, IsNoneBetweenEqualPictures) {
  const Image image = noise(30, 20, 1);
  for (const float error : errors_of(image, image)) ASSERT_EQ(error, 0.0f);
}

TEST(Flip, OfPlainColoursIsTheFormulaWithoutFilters) {
  const std::pair<Pixel, Pixel> pairs[] = {{{0, 0, 0, 255}, {255, 255, 255, 255}},
                                           {{200, 30, 40, 255}, {190, 40, 45, 255}},
                                           {{0, 255, 0, 255}, {0, 0, 255, 255}},
                                           {{128, 128, 128, 255}, {132, 128, 128, 255}}};
  for (const auto& [first, second] : pairs) {
    const double expected =
        naive::redistributed(naive::hunt(naive::linear(first)), naive::hunt(naive::linear(second)));
    for (const float error : errors_of(flat_picture(24, 24, first), flat_picture(24, 24, second)))
      ASSERT_NEAR(error, expected, kSingle);
  }
}

TEST(Flip, OfBlackAndWhiteIsNearlyAll) {
  // L* differs by 100: (100^0.7 - 0.4 m) / (0.6 m) of the last twentieth, where m = 41.3 is green's from
  // blue.
  for (const float error :
       errors_of(flat_picture(4, 4, {0, 0, 0, 255}), flat_picture(4, 4, {255, 255, 255, 255})))
    ASSERT_NEAR(error, 0.967, 2e-3);
}

TEST(Flip, OfGreenAndBlueIsAll) {
  for (const float error :
       errors_of(flat_picture(4, 4, {0, 255, 0, 255}), flat_picture(4, 4, {0, 0, 255, 255})))
    ASSERT_NEAR(error, 1, 1e-6);
}

TEST(Flip, AgreesWithAnotherTextOfThePaper) {
  const Image a = noise(13, 9, 2), strokes = ring(6, 5, 4, 1, 13);
  Image b = noise(13, 9, 3), spot = strokes;
  set_pixel(spot, 9, 9, {255, 0, 0, 255});
  for (const auto& [first, second] : {std::pair(a, b), std::pair(strokes, spot)}) {
    const std::vector<float> errors = errors_of(first, second);
    for (int y = 0; y < first.height; y += 2)
      for (int x = 0; x < first.width; x += 3)
        ASSERT_NEAR(errors[std::size_t(y * first.width + x)], naive::error(first, second, x, y), kSingle)
            << x << ' ' << y;
  }
}

TEST(Flip, IsSymmetric) {
  const Image a = noise(20, 20, 4), b = ring(10, 10, 6, 2, 20);
  EXPECT_EQ(errors_of(a, b), errors_of(b, a));
}

TEST(Flip, OfABoxIsThatOfTheWhole) {
  const Image a = noise(40, 30, 5), b = noise(40, 30, 6);
  const std::vector<float> whole = errors_of(a, b);
  const std::vector<float> part = Flip().errors(a, b, {7, 11, 12, 9});
  ASSERT_EQ(part.size(), 12u * 9u);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 12; ++x)
      ASSERT_EQ(part[std::size_t(y * 12 + x)], whole[std::size_t((11 + y) * 40 + 7 + x)]);
}

// Processors with wide vectors take another compilation of it than those without, and than the sanitizers'
// build.
TEST(Flip, HasTheSameBitsInVectorsOfEveryWidth) {
  std::uint32_t hash = 2166136261u;  // FNV
  for (const float error : errors_of(noise(43, 30, 5), noise(43, 30, 6)))
    hash = (hash ^ std::bit_cast<std::uint32_t>(error)) * 16777619u;
  EXPECT_EQ(hash, 2690013391u);
}

TEST(Flip, ReachesNoFurtherThanItSays) {
  const Image a = flat_picture(60, 3, {90, 90, 90, 255});
  Image b = a;
  set_pixel(b, 30, 1, {255, 0, 255, 255});
  const std::vector<float> errors = errors_of(a, b);
  EXPECT_EQ(errors[60 + 30 - Flip::kReach - 1], 0.0f);
  EXPECT_GT(errors[60 + 30 - Flip::kReach], 0.0f);
  EXPECT_EQ(errors[60 + 30 + Flip::kReach + 1], 0.0f);
}

TEST(Flip, SeesTransparentPixelsOnMidGrey) {
  for (const float error :
       errors_of(flat_picture(5, 5, {255, 0, 0, 0}), flat_picture(5, 5, {128, 128, 128, 255})))
    ASSERT_EQ(error, 0.0f);
}

}  // namespace
}  // namespace chainreel
