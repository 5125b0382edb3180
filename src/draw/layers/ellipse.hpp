// The effective mass of the end effector as a curve around it, in one of three readings:
//
//   mass    all forces f = Lambda u for accelerations |u| = 1: an ellipse whose semi-axes lie along the
//           eigenvectors of Lambda and measure its eigenvalues in kg (K. Lynch, F. Park, Modern Robotics, ch. 8.1.1)
//   energy  all velocities v with v^T Lambda v / 2 = 0.5 J: an ellipse with semi-axes 1/sqrt(lambda) in m/s
//   belt    the mass felt along each direction u, 1 / (u^T Lambda_inv u) in kg, as a polar curve: it touches the
//           ellipse of `mass` at its axes and lies outside of it between them, with a waist at the minor one where
//           lambda_min < lambda_max / 2
//
// All are taken from the eigenvalues m of Lambda_inv = J M^-1 J^T, which stay finite: lambda = 1 / m. Where m is
// zero to within kSingularFraction of the largest, as singular_directions has it, no acceleration is possible along
// that direction: there, and nowhere else, `mass` is open, two lines along the bounded width that fade towards the
// edge of the scene, with an infinity sign at each end, and so are the ends of `belt`; `energy` shrinks to a segment.
// A curve that leaves the scene fades towards the edge, too, the sooner the further it leads out; an axis of a figure that leaves it at
// both of its ends has its length written at them ("7.91 kg"), one of a film in the plane at its outer end as soon as that has left it. The inside lies below the chain, the lines over it with
// edges in the background's colour, so that they are seen on any link. In space the ellipse drawn is the silhouette of
// the ellipsoid, with its three principal ellipses (draw/layers/ellipsoid).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "draw/robot/fit.hpp"
#include "dynamics/effective_mass.hpp"
#include "picture/camera.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"
#include "scene/words.hpp"

namespace chainreel {

class MarkLabels;

// What is drawn of the set: in the plane an ellipse, in space an ellipsoid, or the curve in which a plane cuts it.
enum class EllipseBody { flat, solid, section };
// What the curve is, in the words of a legend; may be broken behind ": ".
std::string ellipse_legend(EllipseReading reading, EllipseBody body = EllipseBody::flat);

// A semi-axis of the ellipse or ellipsoid.
struct MassAxis {
  std::optional<double> mass;   // kg; absent: infinite
  Eigen::Vector3d direction{};  // unit, in W
};
// From the longest to the shortest.
std::vector<MassAxis> mass_axes(const EffectiveMass& effective);

// How long a semi-axis is in this reading, kg or m/s; absent: infinite.
std::optional<double> semi_axis(const MassAxis& axis, EllipseReading reading);
// The semi-axis that is bounded at singular poses, too, and so decides on the scale: the smaller one, of `energy`
// the larger one.
std::optional<double> bounded_semi_axis(const std::vector<MassAxis>& axes, EllipseReading reading);

// Far from singular poses.
bool is_ordinary(const std::vector<MassAxis>& axes);

inline constexpr double kLongestBar = 0.12;  // units of H

// Fixed for a whole clip or figure: a bar of 1, 2 or 5 x 10^n kg, or m/s.
struct EllipseScale {
  double bar = 1;
  double bar_length = 0.10;  // units of H
  EllipseReading reading = EllipseReading::mass;

  double per_unit() const { return bar_length / bar; }  // units of H per kg or m/s
  std::string label() const;                            // "2 kg"
};
// The bar nearest to the median of the bounded semi-axes, drawn `bar_length` long; 1 kg or 1 m/s where there are
// none.
EllipseScale ellipse_scale(std::vector<double> bounded_semi_axes, double bar_length,
                           EllipseReading reading = EllipseReading::mass);
// The same, or as much smaller as lets four of five of these semi-axes be no longer than `longest` units of H; the bar is
// then at most kLongestBar long.
EllipseScale bounded_scale(const EllipseScale& scale, std::vector<double> long_semi_axes, double longest);

// What a closed curve takes around its middle; none of its axes counts beyond `most` units of H, open ones count for
// nothing along themselves.
Room room_of(const std::vector<MassAxis>& axes, const Camera& camera, const EllipseScale& scale, double most);

// What lies below the chain, its inside, and what over it, lines and words; or both where nothing lies between.
enum class EllipsePart { whole, below, above };

// Whether the robot hides a place from the viewer, given from the curve's middle, in W, in units of H.
using Hides = std::function<bool(const Eigen::Vector3d&)>;

// Whether some of a box lies in front of a curve.
using Covers = std::function<bool(const Rect&)>;

// What a film says at a frame of an axis that its scene cuts.
struct CutNumber {
  double length = 0;      // kg or m/s, by which the axis is known
  std::string bound = {};  // "> 5", said instead of it; "": the number itself
  double opacity = 1;
};

// What belongs to the picture in which ellipses are drawn.
struct EllipseStyle {
  const Theme* theme = nullptr;
  const Fonts* fonts = nullptr;
  double text_scale = 1;
  double per_unit = 0.1;  // units of H per kg or m/s
  Rect scene;             // its edge is where open curves fade
  EllipseReading reading = EllipseReading::mass;
  double fade = size::kEllipseFade;  // over this last stretch
  bool signs = true;                 // infinity signs and lengths at ends that are not seen
  double lines = 1;                  // times the widths of the style guide
  std::vector<CutNumber> cut_numbers{};  // of the axes that a film has cut; those that are not named have their numbers
  std::vector<std::string> names{};  // of the semi-axes in the notation of formulas, the longest first, where a plot has their curves
  std::vector<double> lengths{};     // of these, in the unit of the reading
  bool stands = false;  // the picture stands still: what comes or goes where an axis is cut is there whole or not at all
  MarkLabels* labels = nullptr;      // takes the lengths, to be drawn with other words; absent: they are drawn
  int* unnamed = nullptr;  // of figures, which have room around: counts semi-axes that have no place for their number
  EllipsePart part = EllipsePart::whole;
  Hides hides = nullptr;  // of a robot in space
  Covers covers = nullptr;  // of an ellipsoid in a film: its numbers stand outside, with a line to what they are of
  double hole = 0;        // units of H: axes begin at the end of the link about the middle, whose outline they would cut
  Point outward{};        // away from the link that the middle is an end of; numbers stand at the outer ends of axes along it in figures, of axes that are cut in films
  bool is_filled = true;  // not where several lie over one another
  double disc = 0;        // units of H; above 0: what is seen of the curve lies in this circle about its middle
  bool dashed_cut = false;  // where it is cut there, it says so

  bool draws_below() const { return part != EllipsePart::above; }
  bool draws_above() const { return part != EllipsePart::below; }
};

// The curve about `center` in the reading of the style.
void draw_mass_ellipse(Picture& picture, const std::vector<MassAxis>& axes, Point center,
                       const Camera& camera, const EllipseStyle& style, int clip);

// The curve of the reading `belt`: the mass felt along each direction. In space: the three belts in the principal
// planes, and the silhouette of the surface 1 / (u^T Lambda_inv u).
void draw_belt(Picture& picture, const std::vector<MassAxis>& axes, Point center, const Camera& camera,
               const EllipseStyle& style, int clip);

// The ellipsoid of a robot in space, cut by a plane through its middle.

// Semi-axes of the curve in which the plane of two perpendicular unit vectors (columns, in W) cuts the
// ellipsoid of this reading, as mass_axes gives those of the whole. With E the plane in the basis of Lambda,
// the curve of `mass` is f^T E^T Lambda_inv^2 E f = 1, that of `energy` v^T E^T Lambda E v = 1, that of
// `belt` 1 / (u^T E^T Lambda_inv E u). Chains in the plane have no ellipsoid: their ellipse itself.
std::vector<MassAxis> section_axes(const EffectiveMass& effective, const Eigen::Matrix<double, 3, 2>& plane,
                                   EllipseReading reading);

}  // namespace chainreel
