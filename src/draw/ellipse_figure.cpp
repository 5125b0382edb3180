// Small multiples: every panel has the same camera up to a shift and the same kilograms per length, so that
// poses can be compared by eye.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/caption.hpp"
#include "draw/chain.hpp"
#include "draw/ellipse.hpp"
#include "draw/joints.hpp"
#include "draw/poses.hpp"
#include "draw/sheet.hpp"
#include "draw/view.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr int kMostAcross = 4;
constexpr double kFrameLine = 0.0018;
// Of the shorter side of a panel: how long the smaller semi-axes (their median) and the longest one are
// drawn, whatever gives the smaller scale. Axes beyond kLongest times the median do not count: near a
// singular pose they have no bound.
constexpr double kSmallerAxis = 0.14, kLongestAxis = 0.34, kLongest = 8;
constexpr double kLongestBar = 0.12;  // units of H

struct Pose {
  std::vector<double> q;
  EffectiveMass effective;
  std::vector<MassAxis> axes;
};

std::vector<Pose> poses_of(const Chain& chain, const std::vector<std::vector<double>>& configurations,
                           Workspace& ws) {
  std::vector<Pose> poses;
  for (const std::vector<double>& q : configurations) {
    Pose pose{q, effective_mass_of(chain, ws, q, chain.end_effector, Task::linear), {}};
    pose.axes = mass_axes(pose.effective);
    poses.push_back(std::move(pose));
  }
  return poses;
}

// Panels of equal size, row by row from the top.
std::vector<Rect> panels_of(const Rect& area, int count) {
  const int rows = (count + kMostAcross - 1) / kMostAcross, columns = (count + rows - 1) / rows;
  const double width = (area.width() - (columns - 1) * size::kGutter) / columns;
  const double height = (area.height() - (rows - 1) * size::kGutter) / rows;
  std::vector<Rect> panels;
  for (int i = 0; i < count; ++i) {
    const double x = area.x0 + (i % columns) * (width + size::kGutter);
    const double y = area.y1 - (i / columns) * (height + size::kGutter);
    panels.push_back({x, y - height, x + width, y});
  }
  return panels;
}

MassScale scale_for(const std::vector<Pose>& poses, double panel_side) {
  std::vector<double> smaller;
  for (const Pose& pose : poses) {
    if (const auto mass = smallest_mass(pose.axes)) smaller.push_back(*mass);
  }
  if (smaller.empty()) return {};
  std::nth_element(smaller.begin(), smaller.begin() + std::ptrdiff_t(smaller.size() / 2), smaller.end());
  const double median = smaller[smaller.size() / 2];
  double longest = median;
  for (const Pose& pose : poses) {
    for (const MassAxis& axis : pose.axes) {
      if (axis.mass && *axis.mass <= kLongest * median) longest = std::max(longest, *axis.mass);
    }
  }
  const double per_kg = panel_side * std::min(kSmallerAxis / median, kLongestAxis / longest);
  const double bar_kg = round_length(kLongestBar / per_kg);
  return {bar_kg, bar_kg * per_kg};
}

Sheet sheet_of(const PoseFigureOptions& options, const MassScale& scale, const Fonts& fonts) {
  SheetText text;
  text.title = options.title;
  text.bar = format_shortest(scale.bar_kg) + " kg";
  text.bar_length = scale.bar_length;
  text.legend = kEllipseLegend;
  return lay_out_sheet(text, double(options.width) / options.height, options.text_scale, *options.theme,
                       fonts);
}

Rect above_caption(const Rect& panel, double caption) {
  return {panel.x0, panel.y0 + caption, panel.x1, panel.y1};
}

// The room that a closed ellipse of the usual size takes around the end effector.
Room room_of(const std::vector<MassAxis>& axes, const Camera& camera, double per_kg, double most) {
  double xx = 0, yy = 0;
  for (const MassAxis& axis : axes) {
    const double length = axis.mass ? std::min(*axis.mass * per_kg, most) : 0;
    xx += std::pow(length * camera.right.dot(axis.direction), 2);
    yy += std::pow(length * camera.up.dot(axis.direction), 2);
  }
  return {std::sqrt(xx), std::sqrt(xx), std::sqrt(yy), std::sqrt(yy)};
}

}  // namespace

Picture draw_ellipse_figure(const Chain& chain, const std::vector<std::vector<double>>& configurations,
                            const PoseFigureOptions& options, const Fonts& fonts) {
  if (configurations.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  Workspace ws(chain);
  const std::vector<Pose> poses = poses_of(chain, configurations, ws);
  const double caption = caption_height(int(poses[0].effective.basis.directions.size()), options.text_scale);

  // The bar's length does not change where the panels lie.
  const Rect area = sheet_of(options, {}, fonts).scene;
  const std::vector<Rect> panels = panels_of(area, int(poses.size()));
  const Rect first = above_caption(panels[0], caption);
  const double side = std::min(first.width(), first.height());
  if (!(side > 0.08)) throw Error(ExitCode::usage, "too many poses for one page: draw several figures");
  const MassScale scale = scale_for(poses, side);

  constexpr double kNoLimit = std::numeric_limits<double>::max();
  Skeleton skeleton = skeleton_of(chain);
  for (const Pose& pose : poses) widen_rails(skeleton, chain, pose.q, kNoLimit);
  Camera camera = view_of(chain);
  ChainFit fit(chain, skeleton, camera);
  for (const Pose& pose : poses) {
    compute_kinematics(chain, ws, pose.q, at_rest);
    fit.add_pose(ws, kNoLimit);
    fit.add(tip_position(chain, ws), room_of(pose.axes, camera, scale.per_kg(), kLongestAxis * side));
  }
  fit_to(camera, fit.box(), first, size::kFitMargin);

  Picture picture;
  picture.aspect = double(options.width) / options.height;
  picture.background = options.theme->background;
  const Point origin = camera.origin;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Rect scene = above_caption(panels[i], caption);
    const int clip = int(i);
    picture.clips.push_back(scene);
    camera.origin = origin + Point{scene.x0 - first.x0, scene.y0 - first.y0};
    const ChainLook look = look_of(skeleton, camera, *options.theme);
    picture.add(
        Polygon{{Point{scene.x0, scene.y0}, {scene.x1, scene.y0}, {scene.x1, scene.y1}, {scene.x0, scene.y1}},
                4,
                {{}, options.theme->rule, kFrameLine}});
    compute_kinematics(chain, ws, poses[i].q, at_rest);
    const Point tip = camera.project(tip_position(chain, ws));
    draw_base(picture, {chain, skeleton, camera, look}, clip);
    draw_links(picture, {chain, skeleton, camera, look}, ws, clip);
    const EllipseStyle style{options.theme, &fonts, options.text_scale, scale.per_kg(), scene};
    draw_mass_ellipse(picture, poses[i].axes, tip, camera, style, clip);
    draw_end_effector(picture, tip, look, clip);
    draw_caption(picture, chain, poses[i].q, poses[i].effective,
                 {panels[i].x0, panels[i].y0, panels[i].x1, scene.y0}, options.text_scale, *options.theme,
                 fonts);
  }
  draw_sheet(picture, sheet_of(options, scale, fonts));
  return picture;
}

}  // namespace chainreel
