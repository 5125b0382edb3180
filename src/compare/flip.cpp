#include "compare/flip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chainreel {
namespace {

constexpr double kPixelsPerDegree = 67;
constexpr int kReach = Flip::kReach;
// Constants of the paper: exponents of colours and features, and the part of the error, kLowError, that
// differences below the share kLowShare of the largest are spread over.
constexpr double kColorPower = 0.7, kFeaturePower = 0.5, kLowShare = 0.4, kLowError = 0.95;
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

// CIE's cube root with its straight piece near black.
float lab_root(float t) {
  constexpr float delta = 6.0f / 29.0f;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29.0f;
}

// L* and Hunt-adjusted a*, b* of white-relative XYZ.
std::array<float, 3> hunt_lab(float x, float y, float z) {
  const float fx = lab_root(x), fy = lab_root(y), fz = lab_root(z);
  const float lightness = 116 * fy - 16;
  return {lightness, 0.01f * lightness * 500 * (fx - fy), 0.01f * lightness * 200 * (fy - fz)};
}

double hyab(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// A Gaussian of the contrast sensitivity function: what exp(-b f^2) (f in cycles a degree) is in space, where
// both directions share one factor. Not normalised.
Flip::Taps sensitivity(double a, double b) {
  Flip::Taps taps;
  for (int i = -kReach; i <= kReach; ++i) {
    const double x = i / kPixelsPerDegree, pi = std::numbers::pi;
    taps[i + kReach] = float(std::sqrt(a * std::sqrt(pi / b)) * std::exp(-pi * pi * x * x / b));
  }
  return taps;
}

double sum_of(const Flip::Taps& taps) {
  double sum = 0;
  for (const float tap : taps) sum += tap;
  return sum;
}

void scale(Flip::Taps& taps, double factor) {
  for (float& tap : taps) tap = float(tap * factor);
}

// Positive and negative weights sum to 1 and to -1.
void normalise_signs(Flip::Taps& taps) {
  double positive = 0, negative = 0;
  for (const float tap : taps) (tap > 0 ? positive : negative) += std::abs(tap);
  for (float& tap : taps) tap = float(tap / (tap > 0 ? positive : negative));
}

// One value a pixel of a box.
struct Plane {
  int width, height;
  std::vector<float> values;
  Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
  float* row(int y) { return &values[std::size_t(y) * std::size_t(width)]; }
  const float* row(int y) const { return &values[std::size_t(y) * std::size_t(width)]; }
};

void add_along_x(const Plane& in, const Flip::Taps& taps, Plane& out) {
  for (int y = 0; y < out.height; ++y) {
    float* target = out.row(y);
    for (int k = 0; k <= 2 * kReach; ++k) {
      const float* source = in.row(y) + k;
      const float tap = taps[k];
      if (tap == 0) continue;
      for (int x = 0; x < out.width; ++x) target[x] += tap * source[x];
    }
  }
}

void add_along_y(const Plane& in, const Flip::Taps& taps, Plane& out) {
  for (int y = 0; y < out.height; ++y) {
    float* target = out.row(y);
    for (int k = 0; k <= 2 * kReach; ++k) {
      const float* source = in.row(y + k);
      const float tap = taps[k];
      if (tap == 0) continue;
      for (int x = 0; x < out.width; ++x) target[x] += tap * source[x];
    }
  }
}

// Adds `in`, filtered along both directions, to `out`, which is smaller by the reach on each side.
void add_filtered(const Plane& in, const Flip::Taps& along_x, const Flip::Taps& along_y, Plane& out) {
  Plane between(out.width, in.height);
  add_along_x(in, along_x, between);
  add_along_y(between, along_y, out);
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
      for (int column = 0; column < y.width; ++column) {
        const std::uint8_t* p = line + 4 * std::clamp(box.x + column - kReach, 0, image.width - 1);
        const auto shown = [&](int channel) {
          return p[3] == 255 ? p[channel] : (p[channel] * p[3] + kMidGrey * (255 - p[3]) + 127) / 255;
        };
        const float r = linear[shown(2)], g = linear[shown(1)], b = linear[shown(0)];
        const float big_x = m[0][0] * r + m[0][1] * g + m[0][2] * b;
        const float big_y = m[1][0] * r + m[1][1] * g + m[1][2] * b;
        const float big_z = m[2][0] * r + m[2][1] * g + m[2][2] * b;
        y.row(row)[column] = big_y;
        cx.row(row)[column] = big_x - big_y;
        cz.row(row)[column] = big_y - big_z;
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
  const int reach = int(std::ceil(3 * sigma));
  for (int i = -kReach; i <= kReach; ++i) {
    const double x = i / sigma, gaussian = std::abs(i) > reach ? 0 : std::exp(-0.5 * x * x);
    smooth_[i + kReach] = float(gaussian);
    edge_[i + kReach] = float(-x * gaussian);
    point_[i + kReach] = float((x * x - 1) * gaussian);
  }
  scale(smooth_, 1 / sum_of(smooth_));
  normalise_signs(edge_);
  normalise_signs(point_);

  const auto& m = white_relative().to;
  largest_ =
      std::pow(hyab(hunt_lab(m[0][1], m[1][1], m[2][1]), hunt_lab(m[0][2], m[1][2], m[2][2])), kColorPower);
}

Flip::Seen Flip::look_at(const Image& image, const PixelBox& box) const {
  const Patch patch(image, box);
  Plane y(box.width, box.height), cx = y, cz = y;
  add_filtered(patch.y, achromatic_, achromatic_, y);
  add_filtered(patch.cx, red_green_, red_green_, cx);
  add_filtered(patch.cz, blue_yellow_wide_, blue_yellow_wide_, cz);
  add_filtered(patch.cz, blue_yellow_narrow_, blue_yellow_narrow_, cz);
  Plane edge_x(box.width, box.height), edge_y = edge_x, point_x = edge_x, point_y = edge_x;
  add_filtered(patch.y, edge_, smooth_, edge_x);
  add_filtered(patch.y, point_, smooth_, point_x);
  Plane between(box.width, patch.y.height);
  add_along_x(patch.y, smooth_, between);
  add_along_y(between, edge_, edge_y);
  add_along_y(between, point_, point_y);

  const std::size_t count = y.values.size();
  Seen seen;
  for (std::vector<float>* values :
       {&seen.lightness, &seen.red_green, &seen.blue_yellow, &seen.edge, &seen.point})
    values->resize(count);
  const auto& to = white_relative().to;
  const auto& from = white_relative().from;
  for (std::size_t i = 0; i < count; ++i) {
    // Filters can leave what a screen can show: that is cut off, as the paper does.
    const float xyz[3] = {cx.values[i] + y.values[i], y.values[i], y.values[i] - cz.values[i]};
    float rgb[3], shown[3];
    for (int j = 0; j < 3; ++j)
      rgb[j] = std::clamp(from[j][0] * xyz[0] + from[j][1] * xyz[1] + from[j][2] * xyz[2], 0.0f, 1.0f);
    for (int j = 0; j < 3; ++j) shown[j] = to[j][0] * rgb[0] + to[j][1] * rgb[1] + to[j][2] * rgb[2];
    const std::array<float, 3> lab = hunt_lab(shown[0], shown[1], shown[2]);
    seen.lightness[i] = lab[0];
    seen.red_green[i] = lab[1];
    seen.blue_yellow[i] = lab[2];
    seen.edge[i] = std::sqrt(edge_x.values[i] * edge_x.values[i] + edge_y.values[i] * edge_y.values[i]);
    seen.point[i] = std::sqrt(point_x.values[i] * point_x.values[i] + point_y.values[i] * point_y.values[i]);
  }
  return seen;
}

void Flip::compute(const Image& expected, const Image& actual, const PixelBox& box,
                   std::vector<float>& errors) const {
  const Seen a = look_at(expected, box), b = look_at(actual, box);
  const double low = kLowShare * largest_;
  std::size_t i = 0;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x, ++i) {
      const double distance = hyab({a.lightness[i], a.red_green[i], a.blue_yellow[i]},
                                   {b.lightness[i], b.red_green[i], b.blue_yellow[i]});
      double error = 0;
      if (distance > 0) {
        const double color = std::pow(distance, kColorPower);
        const double spread = color < low ? kLowError * color / low
                                          : kLowError + (1 - kLowError) * (color - low) / (largest_ - low);
        const double feature = std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i])) /
                               std::numbers::sqrt2;
        error = std::pow(std::min(spread, 1.0), 1 - std::min(1.0, std::pow(feature, kFeaturePower)));
      }
      errors[std::size_t(y) * std::size_t(expected.width) + std::size_t(x)] = float(error);
    }
}

}  // namespace chainreel
