// Colours by meaning; within one picture a colour never stands for two things.
#pragma once

#include <array>
#include <string_view>

#include "picture/picture.hpp"

namespace chainreel {

struct Theme {
  Color background, ink, muted, base, rule, grid;
  std::array<Color, 4> link;  // fills, then the cycle repeats
  Color ellipse, torque, velocity, force, constraint;
  std::array<Color, 3> curve;  // plot lines of joints 1, 2, 3
  Color side_a, side_b;        // the two sides of a comparison
  std::array<Color, 5> variant{};  // of three and more, the first `variants`; then those of curve_style
  int variants = 0;                // none but a style's
  std::array<Color, 3> axis;   // x, y, z of a frame; each axis also bears its letter
  double lines = 1;            // times the widths of outlines, curves and ellipses
  double trail = 1;            // s that trails go back

  friend bool operator==(const Theme&, const Theme&) = default;
};

bool is_dark(const Theme& theme);  // its background

// Of one of `count` runs that are compared.
Color variant_color(const Theme& theme, int i, int count);

const Theme& light_theme();
const Theme& dark_theme();
// The dark one for "dark", the light one for any other word.
const Theme& theme_named(std::string_view name);

// Sizes in units of H.
namespace size {
inline constexpr double kMargin = 0.045, kGutter = 0.030, kTitleBand = 0.085, kFooterBand = 0.065;
inline constexpr double kTitle = 0.044, kEquation = 0.042, kSymbol = 0.034, kAxis = 0.028, kTick = 0.022;
inline constexpr double kLinkWidth = 0.042, kLinkOutline = 0.0030;
inline constexpr double kJointDisc = 0.030, kJointOutline = 0.0040, kJointDot = 0.007;
inline constexpr double kRailLine = 0.0030, kRailGap = 0.048, kCarriageLength = 0.060,
                        kCarriageHeight = 0.048;
inline constexpr double kGroundLine = 0.0045, kGroundHatch = 0.0022, kGroundSpacing = 0.014,
                        kGroundLength = 0.12;
inline constexpr double kEndEffector = 0.014;
inline constexpr double kScaleBar = 0.0035, kEllipseLine = 0.0042, kEllipseAxis = 0.0022, kEllipseFade = 0.10;
inline constexpr double kTrailHead = 0.0050, kTrailTail = 0.0015, kTrailDot = 0.006;
inline constexpr double kArrowShaft = 0.0060, kArrowHead = 0.024, kArrowHeadWidth = 0.018;
inline constexpr double kLongestArrow = 0.20, kArrowCut = 0.25, kShortestArrow = 0.003;
inline constexpr double kTorqueArc = 0.058, kBesideRail = 0.034, kBeforePushed = 0.012, kDash = 0.012, kDashGap = 0.008;
inline constexpr double kCenterOfMass = 0.022;
inline constexpr double kFrameLine = 0.0018;  // about a panel
inline constexpr double kMarkToText = 0.014;  // in a legend
inline constexpr double kAxisShaft = 0.0045, kAxisLength = 0.075, kAxisHead = 0.016;
inline constexpr double kFitMargin = 0.06;  // fraction of the fitted box
}  // namespace size

// A text size of the style guide at this text_scale, no less than the smallest of the guide. From kEvenGrowth on sizes come
// nearer to one another: the smallest grow on in full and those twice as large no more, so that a page on which words are
// large has room for more than its title.
inline constexpr double kEvenGrowth = 1.6;
double scaled(double size, double text_scale);
// The same without a least size: of what is as high as words of `size` are at text_scale 1, times `part`.
double grown(double part, double size, double text_scale);

}  // namespace chainreel
