// What the figures of ellipses share. Internal.
#pragma once

#include <vector>

#include "draw/figures/poses.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/fit.hpp"

namespace chainreel {

inline constexpr double kLongestBar = 0.12;   // units of H
inline constexpr double kLongestAxis = 0.34;  // of the shorter side of a panel

struct Pose {
  std::vector<double> q;
  EffectiveMass effective;
  std::vector<MassAxis> axes;
};
std::vector<Pose> poses_of(const TipMass& mass, const std::vector<std::vector<double>>& configurations,
                           const PoseFigureOptions& options, Workspace& ws);

std::vector<std::vector<double>> configurations_of(const std::vector<Pose>& poses);

// Far from singular poses.
bool is_ordinary(const std::vector<MassAxis>& axes);
// The bounded semi-axes (their median) have their usual length, but no semi-axis of an ordinary pose is longer than
// kLongestAxis, so that all ellipses of ordinary poses can be seen whole. `room`: the shorter side of a panel, units
// of H.
EllipseScale scale_for(const std::vector<Pose>& poses, double room, EllipseReading reading);

// With legend, scale and title.
Sheet sheet_of(const Chain& chain, const PoseFigureOptions& options, const EllipseScale& scale, const Fonts& fonts);

// What a closed curve of the usual size takes around the end effector; none of its axes counts beyond `most`.
Room room_of(const std::vector<MassAxis>& axes, const Camera& camera, const EllipseScale& scale, double most);

// All poses in one place, or a field.
Picture draw_superposed(const Chain& chain, const std::vector<Pose>& poses, const PoseFigureOptions& options,
                        const Fonts& fonts);

}  // namespace chainreel
