#include "compare/flip.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numbers>
#include <utility>

namespace chainreel {
namespace {

constexpr double kPixelsPerDegree = 67;
constexpr int kReach = Flip::kReach;
// Constants of the paper: the exponent of colours, and the part of the error, kLowError, that
// differences below the share kLowShare of the largest are spread over.
constexpr float kColorPower = 0.7f, kLowShare = 0.4f, kLowError = 0.95f;
constexpr float kLeast = 1e-30f;           // a distance that still has a logarithm
constexpr double kFeatureDegrees = 0.082;  // width of the feature detectors
constexpr std::uint8_t kMidGrey = 128;

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

// Linear sRGB to CIE XYZ. White, the sum of its columns, is D65.
constexpr Matrix kToXyz = {{{0.4124564, 0.3575761, 0.1804375},
                            {0.2126729, 0.7151522, 0.0721750},
                            {0.0193339, 0.1191920, 0.9503041}}};

Matrix inverse_of(const Matrix& m) {
  Matrix inverse;
  double determinant = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      inverse[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
      if (i == 0) determinant += m[j][0] * inverse[0][j];
    }
  for (Vector& row : inverse)
    for (double& value : row) value /= determinant;
  return inverse;
}

// XYZ over that of white, of linear sRGB, and back.
struct WhiteRelative {
  float to[3][3], from[3][3];
  WhiteRelative() {
    Matrix relative = kToXyz;
    for (Vector& row : relative) {
      const double white = row[0] + row[1] + row[2];
      for (double& value : row) value /= white;
    }
    const Matrix back = inverse_of(relative);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        to[i][j] = float(relative[i][j]);
        from[i][j] = float(back[i][j]);
      }
  }
};

const WhiteRelative& white_relative() {
  static const WhiteRelative instance;
  return instance;
}

const std::array<float, 256>& linear_of_srgb() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t;
    for (int i = 0; i < 256; ++i) {
      const double c = i / 255.0;
      t[i] = float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return table;
}

// Elementary functions without branches, so that the compiler computes several pixels at once, and without
// the C library, which rounds otherwise where the processor has fused operations. Relative errors are some
// 1e-7, of powers 1e-6.

// Of what is positive: a third of the logarithm that the bits nearly are, then two steps of Halley.
inline float cube_root(float t) {
  const int third = int(float(std::bit_cast<std::int32_t>(t)) * (1.0f / 3.0f)) + 709921077;
  float root = std::bit_cast<float>(third);
  for (int step = 0; step < 2; ++step) {
    const float cube = root * root * root;
    root *= (cube + 2 * t) / (2 * cube + t);
  }
  return root;
}

// Of what is positive and no denormal.
inline float binary_logarithm(float x) {
  const std::int32_t bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;  // so that the rest is between 0.71 and 1.41
  const float rest = std::bit_cast<float>(bits - exponent * (1 << 23));
  const float s = (rest - 1) / (rest + 1), square = s * s;
  const float series = 1 + square * (1 / 3.0f + square * (1 / 5.0f + square * (1 / 7.0f + square / 9.0f)));
  return float(exponent) + float(2 * std::numbers::log2e) * s * series;
}

// 2^x for x from -126 to 127; less is taken as -126.
inline float binary_power(float x) {
  const float bounded = std::max(x, -126.0f);
  const std::int32_t whole = std::int32_t(bounded + 128.5f) - 128;
  const float part = (bounded - float(whole)) * float(std::numbers::ln2);
  const float series =
      1 + part * (1 + part * (1 / 2.0f +
                              part * (1 / 6.0f + part * (1 / 24.0f + part * (1 / 120.0f + part / 720.0f)))));
  return series * std::bit_cast<float>((whole + 127) * (1 << 23));
}

inline float power(float x, float exponent) {
  return binary_power(exponent * binary_logarithm(x));
}

// CIE's cube root with its straight piece near black.
inline float lab_root(float t) {
  constexpr float delta = 6.0f / 29.0f, end = delta * delta * delta;
  const float root = cube_root(std::max(t, end)), straight = t / (3 * delta * delta) + 4.0f / 29.0f;
  return t > end ? root : straight;
}

struct HuntLab {
  float lightness, red_green, blue_yellow;  // L* and Hunt-adjusted a*, b*
};

// Of white-relative XYZ.
inline HuntLab hunt_lab(float x, float y, float z) {
  const float fx = lab_root(x), fy = lab_root(y), fz = lab_root(z);
  const float lightness = 116 * fy - 16;
  return {lightness, 0.01f * lightness * 500 * (fx - fy), 0.01f * lightness * 200 * (fy - fz)};
}

inline float length(float a, float b) {
  return std::sqrt(a * a + b * b);
}

inline float hyab(const HuntLab& a, const HuntLab& b) {
  return std::abs(a.lightness - b.lightness) +
         length(a.red_green - b.red_green, a.blue_yellow - b.blue_yellow);
}

enum class Symmetry { even, odd };  // of the filters about their middles
constexpr auto kEven = Symmetry::even, kOdd = Symmetry::odd;

// A Gaussian of the contrast sensitivity function: what exp(-b f^2) (f in cycles a degree) is in space, where
// both directions share one factor. Not normalised.
Flip::Taps sensitivity(double a, double b) {
  Flip::Taps taps;
  for (int i = 0; i <= kReach; ++i) {
    const double x = i / kPixelsPerDegree, pi = std::numbers::pi;
    taps[i] = float(std::sqrt(a * std::sqrt(pi / b)) * std::exp(-pi * pi * x * x / b));
  }
  return taps;
}

// Over both sides of the middle.
double sum_of(const Flip::Taps& taps) {
  double sum = taps[0];
  for (int i = 1; i <= kReach; ++i) sum += 2 * double(taps[i]);
  return sum;
}

void scale(Flip::Taps& taps, double factor) {
  for (float& tap : taps) tap = float(tap * factor);
}

// Positive and negative weights of both sides sum to 1 and to -1.
void normalise_signs(Flip::Taps& taps, Symmetry symmetry) {
  double positive = std::max(taps[0], 0.0f), negative = std::max(-taps[0], 0.0f);
  for (int i = 1; i <= kReach; ++i) {
    const double weight = std::abs(taps[i]);
    if (symmetry == kOdd) {
      positive += weight;
      negative += weight;
    } else {
      (taps[i] > 0 ? positive : negative) += 2 * weight;
    }
  }
  for (float& tap : taps) tap = float(tap / (tap > 0 ? positive : negative));
}

// One value a pixel of a box; written before it is read.
struct Plane {
  int width, height;
  std::unique_ptr<float[]> values;
  Plane(int w, int h)
      : width(w),
        height(h),
        values(std::make_unique_for_overwrite<float[]>(std::size_t(w) * std::size_t(h))) {}
  float* row(int y) { return &values[std::size_t(y) * std::size_t(width)]; }
  const float* row(int y) const { return &values[std::size_t(y) * std::size_t(width)]; }
};

// What a filter makes of the values that lie `step` apart around `at`: of the sums of the two at one distance
// where it is even, of their differences where it is odd. Written out for each distance, so that a row is
// computed several pixels at a time with sums that stay in registers.
template <int kTaps, Symmetry kSymmetry>
[[gnu::always_inline]] inline float filtered(const float* at, std::ptrdiff_t step, const Flip::Taps& taps) {
  float sum = kSymmetry == kEven ? taps[0] * at[0] : 0.0f;
  const auto pair = [&](std::ptrdiff_t distance) {
    const float after = at[distance * step], before = at[-distance * step];
    return taps[std::size_t(distance)] * (kSymmetry == kEven ? after + before : after - before);
  };
  [&]<int... k>(std::integer_sequence<int, k...>) {
    ((sum += pair(k + 1)), ...);
  }
  (std::make_integer_sequence<int, kTaps>());
  return sum;
}

// How far the narrow filters reach: beyond it their weights are below 2e-9.
constexpr int kNarrowReach = 7;
constexpr int kFeatureReach = 9;  // three standard deviations, rounded up

// Each row of a patch, filtered.
template <int kTaps, Symmetry kSymmetry>
void along_x(const Plane& in, const Flip::Taps taps, Plane& out) {
  for (int y = 0; y < out.height; ++y) {
    const float* source = in.row(y) + kReach;
    float* __restrict target = out.row(y);
    for (int x = 0; x < out.width; ++x) target[x] = filtered<kTaps, kSymmetry>(source + x, 1, taps);
  }
}

// One row of the box, filtered along its columns.
template <int kTaps, Symmetry kSymmetry>
void along_y(const Plane& in, int y, const Flip::Taps taps, float* __restrict target) {
  const float* source = in.row(y + kReach);
  const std::ptrdiff_t step = in.width;
  for (int x = 0; x < in.width; ++x) target[x] = filtered<kTaps, kSymmetry>(source + x, step, taps);
}

// The box and its surroundings as Y, X - Y and Y - Z over those of white; beyond the picture its border goes
// on.
struct Patch {
  Plane y, cx, cz;
  Patch(const Image& image, const PixelBox& box)
      : y(box.width + 2 * kReach, box.height + 2 * kReach), cx(y.width, y.height), cz(y.width, y.height) {
    const std::array<float, 256>& linear = linear_of_srgb();
    const auto& m = white_relative().to;
    for (int row = 0; row < y.height; ++row) {
      const int from_y = std::clamp(box.y + row - kReach, 0, image.height - 1);
      const std::uint8_t* line = &image.bgra[std::size_t(4) * std::size_t(from_y) * std::size_t(image.width)];
      float *to_y = y.row(row), *to_cx = cx.row(row), *to_cz = cz.row(row);
      const std::uint8_t* last = nullptr;
      for (int column = 0; column < y.width; ++column) {
        const std::uint8_t* p = line + 4 * std::clamp(box.x + column - kReach, 0, image.width - 1);
        if (last != nullptr && std::memcmp(p, last, 4) == 0) {  // pages are flat
          to_y[column] = to_y[column - 1];
          to_cx[column] = to_cx[column - 1];
          to_cz[column] = to_cz[column - 1];
          continue;
        }
        last = p;
        const auto shown = [&](int channel) {
          return p[3] == 255 ? p[channel] : (p[channel] * p[3] + kMidGrey * (255 - p[3]) + 127) / 255;
        };
        const float r = linear[shown(2)], g = linear[shown(1)], b = linear[shown(0)];
        const float big_x = m[0][0] * r + m[0][1] * g + m[0][2] * b;
        const float big_y = m[1][0] * r + m[1][1] * g + m[1][2] * b;
        const float big_z = m[2][0] * r + m[2][1] * g + m[2][2] * b;
        to_y[column] = big_y;
        to_cx[column] = big_x - big_y;
        to_cz[column] = big_y - big_z;
      }
    }
  }
};

}  // namespace

Flip::Flip()
    : achromatic_(sensitivity(1, 0.0047)),
      red_green_(sensitivity(1, 0.0053)),
      blue_yellow_wide_(sensitivity(34.1, 0.04)),
      blue_yellow_narrow_(sensitivity(13.5, 0.025)) {
  scale(achromatic_, 1 / sum_of(achromatic_));
  scale(red_green_, 1 / sum_of(red_green_));
  const double wide = sum_of(blue_yellow_wide_), narrow = sum_of(blue_yellow_narrow_);
  const double both =
      std::sqrt(wide * wide + narrow * narrow);  // their sum in the plane, along one direction
  scale(blue_yellow_wide_, 1 / both);
  scale(blue_yellow_narrow_, 1 / both);

  const double sigma = 0.5 * kFeatureDegrees * kPixelsPerDegree;
  for (int i = 0; i <= kReach; ++i) {
    const double x = i / sigma, gaussian = i > kFeatureReach ? 0 : std::exp(-0.5 * x * x);
    smooth_[i] = float(gaussian);
    edge_[i] = float(-x * gaussian);
    point_[i] = float((x * x - 1) * gaussian);
  }
  scale(smooth_, 1 / sum_of(smooth_));
  normalise_signs(edge_, kOdd);
  normalise_signs(point_, kEven);

  const auto& m = white_relative().to;
  largest_ =
      power(hyab(hunt_lab(m[0][1], m[1][1], m[2][1]), hunt_lab(m[0][2], m[1][2], m[2][2])), kColorPower);
}

// What the eye makes of one picture in the box: one value a pixel of it.
struct Flip::Seen {
  Plane lightness, red_green, blue_yellow;  // L*, Hunt-adjusted a* and b*, filtered
  Plane edge, point;                        // lengths of the first and second derivatives of Y
  explicit Seen(const PixelBox& box)
      : lightness(box.width, box.height),
        red_green(box.width, box.height),
        blue_yellow(box.width, box.height),
        edge(box.width, box.height),
        point(box.width, box.height) {}
};

// Where a processor has wider vectors, the same in them: the compiler fuses nothing, so every processor
// rounds alike. All that is called is compiled along. The sanitizer cannot follow a choice that is made
// before the program starts.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CHAINREEL_ALSO_WIDE [[gnu::flatten, gnu::target_clones("avx2", "default")]]
#else
#define CHAINREEL_ALSO_WIDE
#endif

CHAINREEL_ALSO_WIDE Flip::Seen Flip::look_at(const Image& image, const PixelBox& box) const {
  const Patch patch(image, box);
  const auto high = [&] { return Plane(box.width, patch.y.height); };  // filtered along x alone
  Plane y = high(), cx = high(), wide = high(), narrow = high(), smooth = high(), edge = high(),
        point = high();
  along_x<kNarrowReach, kEven>(patch.y, achromatic_, y);
  along_x<kNarrowReach, kEven>(patch.cx, red_green_, cx);
  along_x<kReach, kEven>(patch.cz, blue_yellow_wide_, wide);
  along_x<kReach, kEven>(patch.cz, blue_yellow_narrow_, narrow);
  along_x<kFeatureReach, kEven>(patch.y, smooth_, smooth);
  along_x<kFeatureReach, kOdd>(patch.y, edge_, edge);
  along_x<kFeatureReach, kEven>(patch.y, point_, point);

  Seen seen(box);
  constexpr int kRows = 8;
  Plane rows(box.width, kRows);
  const float *const to_y = rows.row(0), *const to_cx = rows.row(1), *const to_wide = rows.row(2),
                     *const to_narrow = rows.row(3), *const edge_x = rows.row(4), *const edge_y = rows.row(5),
                     *const point_x = rows.row(6), *const point_y = rows.row(7);
  const WhiteRelative white = white_relative();
  const auto &to = white.to, &from = white.from;
  for (int row = 0; row < box.height; ++row) {
    along_y<kNarrowReach, kEven>(y, row, achromatic_, rows.row(0));
    along_y<kNarrowReach, kEven>(cx, row, red_green_, rows.row(1));
    along_y<kReach, kEven>(wide, row, blue_yellow_wide_, rows.row(2));
    along_y<kReach, kEven>(narrow, row, blue_yellow_narrow_, rows.row(3));
    along_y<kFeatureReach, kEven>(edge, row, smooth_, rows.row(4));
    along_y<kFeatureReach, kOdd>(smooth, row, edge_, rows.row(5));
    along_y<kFeatureReach, kEven>(point, row, smooth_, rows.row(6));
    along_y<kFeatureReach, kEven>(smooth, row, point_, rows.row(7));
    float *__restrict lightness = seen.lightness.row(row), *__restrict red_green = seen.red_green.row(row),
          *__restrict blue_yellow = seen.blue_yellow.row(row);
    for (int x = 0; x < box.width; ++x) {
      // Filters can leave what a screen can show: that is cut off, as the paper does.
      const float big_y = to_y[x], big_x = to_cx[x] + big_y, big_z = big_y - (to_wide[x] + to_narrow[x]);
      float rgb[3], shown[3];
      for (int j = 0; j < 3; ++j)
        rgb[j] = std::min(std::max(from[j][0] * big_x + from[j][1] * big_y + from[j][2] * big_z, 0.0f), 1.0f);
      for (int j = 0; j < 3; ++j) shown[j] = to[j][0] * rgb[0] + to[j][1] * rgb[1] + to[j][2] * rgb[2];
      const HuntLab lab = hunt_lab(shown[0], shown[1], shown[2]);
      lightness[x] = lab.lightness;
      red_green[x] = lab.red_green;
      blue_yellow[x] = lab.blue_yellow;
    }
    float* __restrict edges = seen.edge.row(row), * __restrict points = seen.point.row(row);
    for (int x = 0; x < box.width; ++x) {
      edges[x] = length(edge_x[x], edge_y[x]);
      points[x] = length(point_x[x], point_y[x]);
    }
  }
  return seen;
}

CHAINREEL_ALSO_WIDE std::vector<float> Flip::errors(const Image& expected, const Image& actual,
                                                    const PixelBox& box) const {
  const Seen a = look_at(expected, box), b = look_at(actual, box);
  const float largest = largest_, low = kLowShare * largest;
  std::vector<float> errors(std::size_t(box.width) * std::size_t(box.height));
  for (int y = 0; y < box.height; ++y) {
    const float *la = a.lightness.row(y), *lb = b.lightness.row(y);
    const float *ra = a.red_green.row(y), *rb = b.red_green.row(y);
    const float *ba = a.blue_yellow.row(y), *bb = b.blue_yellow.row(y);
    const float *ea = a.edge.row(y), *eb = b.edge.row(y), *pa = a.point.row(y), *pb = b.point.row(y);
    float* __restrict target = &errors[std::size_t(y) * std::size_t(box.width)];
    for (int x = 0; x < box.width; ++x) {
      const float distance = hyab({la[x], ra[x], ba[x]}, {lb[x], rb[x], bb[x]});
      const float color = power(std::max(distance, kLeast), kColorPower);
      const float below = kLowError * color / low;
      const float above = kLowError + (1 - kLowError) * (color - low) / (largest - low);
      const float spread = std::min(color < low ? below : above, 1.0f);
      const float feature =
          std::max(std::abs(ea[x] - eb[x]), std::abs(pa[x] - pb[x])) / float(std::numbers::sqrt2);
      // The paper's power of a feature is a half.
      const float error = power(spread, 1 - std::min(1.0f, std::sqrt(feature)));
      target[x] = distance > 0 ? error : 0.0f;
    }
  }
  return errors;
}

}  // namespace chainreel
