// Small multiples: every panel has the same camera up to a shift and the same kilograms per length, so that
// poses can be compared by eye.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/caption.hpp"
#include "draw/chain.hpp"
#include "draw/chain_fit.hpp"
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
// Marks have their full size in a panel of this height and shrink with it, down to a limit.
constexpr double kFullPanel = 0.6, kSmallestMarks = 0.45;

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

// What all panels share.
struct Panels {
  const Chain& chain;
  const PoseFigureOptions& options;
  const Fonts& fonts;
  std::vector<Rect> places;
  double caption = 0;  // height of the words below each scene
  double marks = 1;
  MassScale scale;
  Skeleton skeleton;
  Camera camera;  // of the first panel

  Rect scene(std::size_t i) const { return above_caption(places[i], caption); }
  double side() const { return std::min(scene(0).width(), scene(0).height()); }
};

void fit_panels(Panels& panels, const std::vector<Pose>& poses, Workspace& ws) {
  constexpr double kNoLimit = std::numeric_limits<double>::max();
  panels.skeleton = skeleton_of(panels.chain);
  for (const Pose& pose : poses) widen_rails(panels.skeleton, panels.chain, pose.q, kNoLimit);
  panels.camera = view_of(panels.chain);
  ChainFit fit(panels.chain, panels.skeleton, panels.camera, panels.marks);
  const std::vector<double> at_rest(std::size_t(panels.chain.nv), 0.0);
  for (const Pose& pose : poses) {
    compute_kinematics(panels.chain, ws, pose.q, at_rest);
    fit.add_pose(ws, kNoLimit);
    fit.add(tip_position(panels.chain, ws),
            room_of(pose.axes, panels.camera, panels.scale.per_kg(), kLongestAxis * panels.side()));
  }
  fit_to(panels.camera, fit.box(), panels.scene(0), size::kFitMargin);
}

void draw_panel(Picture& picture, const Panels& panels, std::size_t i, const Pose& pose, Workspace& ws) {
  const Theme& theme = *panels.options.theme;
  const Rect scene = panels.scene(i), first = panels.scene(0);
  const int clip = int(picture.clips.size());
  picture.clips.push_back(scene);
  picture.add(
      Polygon{{Point{scene.x0, scene.y0}, {scene.x1, scene.y0}, {scene.x1, scene.y1}, {scene.x0, scene.y1}},
              4,
              {{}, theme.rule, kFrameLine}});
  Camera camera = panels.camera;
  camera.origin = camera.origin + Point{scene.x0 - first.x0, scene.y0 - first.y0};
  const std::vector<double> at_rest(std::size_t(panels.chain.nv), 0.0);
  compute_kinematics(panels.chain, ws, pose.q, at_rest);
  const ChainDrawing drawing{panels.chain, panels.skeleton, camera,
                             look_of(panels.skeleton, camera, theme, 1, panels.marks)};
  const Point tip = camera.project(tip_position(panels.chain, ws));
  draw_base(picture, drawing, clip);
  draw_rails(picture, drawing, ws, clip);
  draw_links(picture, drawing, ws, clip);
  draw_mass_ellipse(picture, pose.axes, tip, camera,
                    {&theme, &panels.fonts, panels.options.text_scale, panels.scale.per_kg(), scene}, clip);
  draw_end_effector(picture, tip, drawing.look, clip);
  draw_caption(picture, panels.chain, pose.q, pose.effective,
               {scene.x0, panels.places[i].y0, scene.x1, scene.y0}, panels.options.text_scale, theme,
               panels.fonts);
}

}  // namespace

Picture draw_ellipse_figure(const Chain& chain, const std::vector<std::vector<double>>& configurations,
                            const PoseFigureOptions& options, const Fonts& fonts) {
  if (configurations.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  Workspace ws(chain);
  const std::vector<Pose> poses = poses_of(chain, configurations, ws);
  Panels panels{chain, options, fonts, {}, 0, 1, {}, {}, {}};
  panels.caption = caption_height(int(poses[0].effective.basis.directions.size()), options.text_scale);
  // The scale follows from the size of the panels: they are laid out with the longest bar and label that may
  // come.
  panels.places = panels_of(sheet_of(options, {0.005, kLongestBar}, fonts).scene, int(poses.size()));
  if (!(panels.side() > 0.08))
    throw Error(ExitCode::usage, "too many poses for one page: draw several figures");
  panels.marks = std::clamp(panels.side() / kFullPanel, kSmallestMarks, 1.0);
  panels.scale = scale_for(poses, panels.side());
  fit_panels(panels, poses, ws);

  Picture picture;
  picture.aspect = double(options.width) / options.height;
  picture.background = options.theme->background;
  for (std::size_t i = 0; i < poses.size(); ++i) draw_panel(picture, panels, i, poses[i], ws);
  draw_sheet(picture, sheet_of(options, panels.scale, fonts));
  return picture;
}

}  // namespace chainreel
