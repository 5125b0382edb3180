// The effective-mass ellipse of the end effector, `mass` form: all forces f = Lambda u for accelerations |u|
// = 1. Its semi-axes lie along the eigenvectors of Lambda and measure its eigenvalues in kg (K. Lynch, F.
// Park, Modern Robotics, ch. 8.1.1), drawn in H per kg. It is taken from the eigenvalues m of Lambda_inv = J
// M^-1 J^T, which stay finite: a semi-axis is 1 / m. Where m is zero to within kSingularFraction, no
// acceleration is possible along that direction, and where an axis leaves the scene at both of its ends no
// number could be read from it: there the curve is open, two lines along the bounded width that fade towards
// the edge of the scene, with an infinity sign at each end. In space the ellipse drawn is the silhouette of
// the ellipsoid, with its three principal ellipses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/effective_mass.hpp"
#include "picture/camera.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

inline const std::string kEllipseLegend = "effective mass ellipse \u039B(q): force for unit acceleration";

// A semi-axis of the ellipse or ellipsoid.
struct MassAxis {
  std::optional<double> mass;   // kg; absent: infinite
  Eigen::Vector3d direction{};  // unit, in W
};
// From the longest to the shortest.
std::vector<MassAxis> mass_axes(const EffectiveMass& effective);

// Of the axes with a finite mass the smallest, if there is one.
std::optional<double> smallest_mass(const std::vector<MassAxis>& axes);

// Fixed for a whole clip or figure: a bar of 1, 2 or 5 x 10^n kg.
struct MassScale {
  double bar_kg = 1;
  double bar_length = 0.10;  // units of H
  double per_kg() const { return bar_length / bar_kg; }
};
// The bar nearest to the median of the smaller semi-axes (kg), drawn `bar_length` long; 1 kg where there are
// none.
MassScale mass_scale(std::vector<double> smaller_semi_axes, double bar_length);

// What belongs to the picture in which ellipses are drawn.
struct EllipseStyle {
  const Theme* theme = nullptr;
  const Fonts* fonts = nullptr;
  double text_scale = 1;
  double per_kg = 0.1;  // units of H
  Rect scene;           // its edge is where open curves fade
};

void draw_mass_ellipse(Picture& picture, const std::vector<MassAxis>& axes, Point center,
                       const Camera& camera, const EllipseStyle& style, int clip);

}  // namespace chainreel
