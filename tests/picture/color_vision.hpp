// How different two colours look, also to people who confuse some: the judge of the themes.
//
// Contrast: W3C, Web Content Accessibility Guidelines 2.1, "contrast ratio".
// Difference: G. Sharma, W. Wu, E. Dalal, "The CIEDE2000 color-difference formula", 2005, equations (2) to
// (22). Colour vision: G. Machado, M. Oliveira, L. Fernandes, "A physiologically-based model for simulation
// of color vision deficiency", 2009, table 1, severity 1.0; its matrices act on linear RGB.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "picture/picture.hpp"

namespace chainreel {

inline Eigen::Vector3d linear_rgb(const Color& color) {
  const auto linear = [](int level) {
    const double c = level / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return {linear(color.r), linear(color.g), linear(color.b)};
}

inline double contrast(const Color& one, const Color& other) {
  const Eigen::Vector3d weights(0.2126, 0.7152, 0.0722);
  const double a = weights.dot(linear_rgb(one)), b = weights.dot(linear_rgb(other));
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

enum class Vision { normal, protan, deutan, tritan };
inline constexpr std::array<Vision, 4> kVisions = {Vision::normal, Vision::protan, Vision::deutan,
                                                   Vision::tritan};

inline Eigen::Vector3d seen_by(Vision vision, const Eigen::Vector3d& rgb) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  if (vision == Vision::protan)
    m << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  if (vision == Vision::deutan)
    m << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  if (vision == Vision::tritan)
    m << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return (m * rgb).cwiseMax(0.0).cwiseMin(1.0);
}

// CIE L*a*b* under D65.
inline Eigen::Vector3d lab_of(const Eigen::Vector3d& rgb) {
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920, 0.9503041;
  const Eigen::Vector3d white = to_xyz * Eigen::Vector3d::Ones();
  const Eigen::Vector3d xyz = to_xyz * rgb;
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f(xyz.x() / white.x()), y = f(xyz.y() / white.y()), z = f(xyz.z() / white.z());
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

inline double ciede2000(const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) {
  constexpr double kDegree = std::numbers::pi / 180;
  const auto seventh = [](double c) {
    return std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + std::pow(25.0, 7)));
  };
  const auto hue = [](double b, double a) {
    const double h = a == 0 && b == 0 ? 0 : std::atan2(b, a) / kDegree;
    return h < 0 ? h + 360 : h;
  };
  const double mean_chroma = (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2])) / 2;
  const double g = 0.5 * (1 - seventh(mean_chroma));
  const double a1 = (1 + g) * lab1[1], a2 = (1 + g) * lab2[1];
  const double c1 = std::hypot(a1, lab1[2]), c2 = std::hypot(a2, lab2[2]);
  const double h1 = hue(lab1[2], a1), h2 = hue(lab2[2], a2);

  double dh = c1 * c2 == 0 ? 0 : h2 - h1;
  if (dh > 180) dh -= 360;
  if (dh < -180) dh += 360;
  const double dl = lab2[0] - lab1[0], dc = c2 - c1, dH = 2 * std::sqrt(c1 * c2) * std::sin(dh / 2 * kDegree);

  const double l = (lab1[0] + lab2[0]) / 2, c = (c1 + c2) / 2;
  double h = h1 + h2;
  if (c1 * c2 != 0) h = std::abs(h1 - h2) <= 180 ? h / 2 : (h < 360 ? (h + 360) / 2 : (h - 360) / 2);
  const double t = 1 - 0.17 * std::cos((h - 30) * kDegree) + 0.24 * std::cos(2 * h * kDegree) +
                   0.32 * std::cos((3 * h + 6) * kDegree) - 0.20 * std::cos((4 * h - 63) * kDegree);
  const double sl = 1 + 0.015 * std::pow(l - 50, 2) / std::sqrt(20 + std::pow(l - 50, 2));
  const double sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
  const double turn = 30 * std::exp(-std::pow((h - 275) / 25, 2));
  const double rt = -std::sin(2 * turn * kDegree) * 2 * seventh(c);
  const double x = dl / sl, y = dc / sc, z = dH / sh;
  return std::sqrt(x * x + y * y + z * z + rt * y * z);
}

inline double difference(Vision vision, const Color& one, const Color& other) {
  return ciede2000(lab_of(seen_by(vision, linear_rgb(one))), lab_of(seen_by(vision, linear_rgb(other))));
}

}  // namespace chainreel
