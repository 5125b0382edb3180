// What the figures of ellipses share. Internal.
#pragma once

#include <vector>

#include "draw/figures/poses.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/chain.hpp"

namespace chainreel {

inline constexpr double kLongestAxis = 0.34;  // of the shorter side of a panel

struct Pose {
  std::vector<double> q;
  EffectiveMass effective;
  std::vector<MassAxis> axes;
};
std::vector<Pose> poses_of(const TipMass& mass, const std::vector<std::vector<double>>& configurations,
                           const PoseFigureOptions& options, Workspace& ws);

std::vector<std::vector<double>> configurations_of(const std::vector<Pose>& poses);

// By which the scale of a figure is bounded, in the axes' unit: the longest of ordinary poses; of three poses or more one that is alone with
// its length does not make all others small.
double longest_semi_axis(const std::vector<Pose>& poses, EllipseReading reading);
// The bounded semi-axes (their median) have their usual length, but the longest_semi_axis is no longer than kLongestAxis, so that all
// ellipses of ordinary poses, but one that is alone with its length, can be seen whole. `room`: the shorter side of a panel, units of H.
EllipseScale scale_for(const std::vector<Pose>& poses, double room, EllipseReading reading);
// The bar of a scale that draws a unit so long, units of H.
EllipseScale scale_of(double per_unit, EllipseReading reading);

// What below panels the legend explains: nothing, masses, or poses without a name and masses.
enum class UnderPoses { named, masses, poses_and_masses };

// With legend, scale and title.
// `height`: of the page, in units.
Sheet sheet_of(const Chain& chain, const PoseFigureOptions& options, const EllipseScale& scale, const Fonts& fonts, double height = 1,
               UnderPoses under = UnderPoses::named);

// All poses in one place, or a field. `numbers_left_out`: see draw_ellipse_figure.
Picture draw_superposed(const Chain& chain, const std::vector<Pose>& poses, const PoseFigureOptions& options,
                        const Fonts& fonts, int* numbers_left_out);

}  // namespace chainreel
