// Small multiples: every panel has the same camera up to a shift and the same kilograms per length, so that
// poses can be compared by eye.
#include "draw/figures/ellipse_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/figures/caption.hpp"
#include "draw/figures/pose_labels.hpp"
#include "draw/figures/pose_panels.hpp"
#include "draw/layers/body_obstacles.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/layers/ellipsoid.hpp"
#include "draw/layers/fading.hpp"
#include "draw/layers/ground_plane.hpp"
#include "draw/page/mark_labels.hpp"
#include "draw/page/panel_grid.hpp"
#include "draw/page/word_plan.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/place_picture.hpp"

namespace chainreel {
namespace {

// How long the bounded semi-axes (their median) are drawn, as a share of the shorter side of a panel.
constexpr double kSmallerAxis = 0.14, kLargerAxis = 0.24;
constexpr double kNearlyInfinite = 32;  // times the median

// The ground that a robot seen obliquely stands on, with its shadow.
void draw_below(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const CameraEntry& wanted, const Rect& scene, int clip) {
  MotionBox places(up_of(drawing.chain));
  extend(places, drawing.chain, drawing.skeleton, drawing.shapes, ws, std::numeric_limits<double>::infinity());
  const auto ground = ground_of_poses(drawing.chain, places, drawing.camera, wanted);
  if (!ground) return;
  draw_ground_plane(picture, *ground, drawing.camera, drawing.look.theme->rule, scene, clip);
  draw_shadow(picture, drawing, ws, ground->height, scene, clip);
}

// How many semi-axes have no number, for want of room.
int draw_panel(Picture& picture, const Panels& panels, std::size_t i, const Pose& pose, Workspace& ws) {
  const Theme& theme = *panels.options.theme;
  const Rect scene = panels.scene(i), first = panels.scene(0);
  const int clip = int(picture.clips.size());
  picture.clips.push_back(scene);
  const Rect frame = panels.frame(i);
  picture.add(Polygon{{Point{frame.x0, frame.y0}, {frame.x1, frame.y0}, {frame.x1, frame.y1}, {frame.x0, frame.y1}},
                      4,
                      {{}, theme.rule, size::kFrameLine}});
  Camera camera = panels.camera;
  camera.origin = camera.origin + Point{scene.x0 - first.x0, scene.y0 - first.y0};
  const std::vector<double> at_rest(std::size_t(panels.chain.nv), 0.0);
  compute_kinematics(panels.chain, ws, pose.q, at_rest);
  const ChainDrawing drawing{panels.chain, panels.skeleton, camera,
                             narrowed(look_of(panels.skeleton, camera, theme, 1, panels.marks), panels.widest_link),
                             panels.options.shapes.get()};
  draw_below(picture, drawing, ws, panels.options.camera, scene, clip);
  const std::size_t framed = picture.items.size();
  const Point tip = camera.project(tip_position(panels.chain, ws));
  EllipseStyle style{&theme, &panels.fonts,         panels.options.text_scale, panels.scale.per_unit(),
                     panels.picture(i),  panels.options.reading};
  MarkLabels labels;
  style.lines = panels.marks;
  int unnamed = 0;
  style.unnamed = &unnamed;
  if (has_lengths(panels) && !tells_lengths_below(panels)) style.labels = &labels;
  if (!drawing.shapes) style.hole = link_end(drawing.look);
  style.outward = last_link(panels.skeleton, ws, camera);
  if (drawing.shapes) style.hides = robot_hides(*drawing.shapes, ws, camera, tip_position(panels.chain, ws));
  const Camera seen = camera.seen_at(tip_position(panels.chain, ws));
  draw_base(picture, drawing, clip);
  style.part = EllipsePart::below;
  draw_mass_ellipse(picture, pose.axes, tip, seen, style, clip);
  draw_rails(picture, drawing, ws, clip);
  draw_links(picture, drawing, ws, clip);
  style.part = EllipsePart::above;
  draw_mass_ellipse(picture, pose.axes, tip, seen, style, clip);
  if (!drawing.shapes) draw_end_effector(picture, tip, drawing.look, clip);
  std::vector<Obstacle> bodies;
  if (drawing.shapes) add_silhouettes(bodies, *drawing.shapes, ws, camera);
  const int left_out = draw_clear_of(picture, framed, labels, bodies, panels.picture(i), theme, clip);
  if (i < panels.options.labels.size()) {
    const TextStyle text{Face::label, scaled(size::kAxis, panels.options.text_scale), theme.ink, Align::left};
    draw_text(picture,
              fit_text(panels.fonts, panels.options.labels[i], text, scene.width() - 2 * kLabelInset,
                       panels.options.text_scale),
              {scene.x0 + kLabelInset, scene.y1 - kLabelInset - 0.75 * text.size}, clip);
  }
  const double text_scale = panels.options.text_scale;
  Rect caption = panels.words_box(i);
  if (panels.options.letters) {
    const Rect whole = caption;
    caption = draw_letter(picture, i, panels.words.size, caption, text_scale, theme, panels.fonts);
    // In the middle of the panel, where a letter leaves room for that.
    const double taken = panels.lines.empty() ? usual_width(panels.words.notations[i], pose.effective, text_scale, theme, panels.fonts) : whole.width();
    if ((whole.width() - taken) / 2 > caption.x0 - whole.x0) caption = whole;
  }
  if (!panels.lines.empty())
    for (std::size_t line = 0; line <= panels.below.size(); ++line)
      draw_caption_line(picture, (line == 0 ? panels.words.notations : panels.below[line - 1])[i], panels.words.size, caption, text_scale,
                        theme, panels.fonts, int(line));
  else
    draw_caption(picture, panels.words.notations[i], pose.effective, panels.words.size, caption, text_scale, theme, panels.fonts);
  return left_out + unnamed;
}

}  // namespace

const std::vector<std::string>& figure_layout_names() {
  static const std::vector<std::string> names{"grid", "row", "superposed"};
  return names;
}

std::vector<Pose> poses_of(const TipMass& mass, const std::vector<std::vector<double>>& configurations,
                           const PoseFigureOptions& options, Workspace& ws) {
  const Chain& chain = mass.chain();
  std::vector<Pose> poses;
  for (const std::vector<double>& q : configurations) {
    Pose pose{q, mass.at(ws, q), {}};
    pose.axes = mass_axes(pose.effective);
    if (options.section) {
      const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
      compute_kinematics(chain, ws, q, at_rest);
      pose.axes = section_axes(pose.effective, tip_plane(chain, ws), options.reading);
    }
    poses.push_back(std::move(pose));
  }
  return poses;
}

std::vector<std::vector<double>> configurations_of(const std::vector<Pose>& poses) {
  std::vector<std::vector<double>> configurations;
  for (const Pose& pose : poses) configurations.push_back(pose.q);
  return configurations;
}

double longest_semi_axis(const std::vector<Pose>& poses, EllipseReading reading) {
  constexpr double kAlone = 3;       // times the next
  constexpr double kCutTo = 1 / 1.8;  // such a one does not decide on the scale, but this part of it
  constexpr std::size_t kLeastPoses = 3;
  std::vector<double> longest;  // of each
  for (const Pose& pose : poses) {
    // Velocities of equal energy are bounded everywhere.
    if (reading != EllipseReading::energy && !is_ordinary(pose.axes)) continue;
    double own = 0;
    for (const MassAxis& axis : pose.axes) own = std::max(own, semi_axis(axis, reading).value_or(0));
    longest.push_back(own);
  }
  std::sort(longest.rbegin(), longest.rend());
  if (longest.empty()) return 0;
  return longest.size() < kLeastPoses || longest[0] <= kAlone * longest[1] ? longest[0] : std::max(longest[1], kCutTo * longest[0]);
}

EllipseScale scale_for(const std::vector<Pose>& poses, double room, EllipseReading reading) {
  // Those of the curves that have an end, where there are any.
  const auto is_finite = [](const Pose& pose) { return !pose.axes.empty() && pose.axes.front().mass; };
  const bool any_finite = std::any_of(poses.begin(), poses.end(), is_finite);
  std::vector<double> bounded;
  for (const Pose& pose : poses) {
    const auto length = bounded_semi_axis(pose.axes, reading);
    if (length && *length > 0 && (is_finite(pose) || !any_finite)) bounded.push_back(*length);
  }
  if (bounded.empty()) return {1, 0.10, reading};
  std::nth_element(bounded.begin(), bounded.begin() + std::ptrdiff_t(bounded.size() / 2), bounded.end());
  const double median = bounded[bounded.size() / 2];
  double longest = std::max(median, longest_semi_axis(poses, reading));
  // Of poses that are all singular what is finite of each, where it is not nearly infinite.
  if (!any_finite && reading != EllipseReading::energy)
    for (const Pose& pose : poses)
      for (const MassAxis& axis : pose.axes)
        if (axis.mass && *axis.mass <= kNearlyInfinite * median) longest = std::max(longest, *axis.mass);
  const double usual = reading == EllipseReading::energy ? kLargerAxis : kSmallerAxis;
  return scale_of(room * std::min(usual / median, kLongestAxis / longest), reading);
}

EllipseScale scale_of(double per_unit, EllipseReading reading) {
  const double bar = round_length(kLongestBar / per_unit);
  return {bar, bar * per_unit, reading};
}

Sheet sheet_of(const Chain& chain, const PoseFigureOptions& options, const EllipseScale& scale,
               const Fonts& fonts, double height, UnderPoses under) {
  SheetText text;
  text.title = options.title;
  text.logo = logo_of(options);
  text.bar = scale.label();
  text.bar_length = scale.bar_length;
  text.legend = ellipse_legend(options.reading, chain.planar      ? EllipseBody::flat
                                                : options.section ? EllipseBody::section
                                                                  : EllipseBody::solid);
  constexpr std::array kUnder = {"", ", eigenvalues of \u039B under each pose", ", under each q: eigenvalues of \u039B"};
  if (under != UnderPoses::named) text.legend = text.legend.substr(0, text.legend.find(": ")) + kUnder[std::size_t(under)];
  if (options.cell > 0) text.legend += "; cut where longer than its cell (deeper fill: longer)" + (options.branch.empty() ? "" : "; " + options.branch);
  text.legend_size = size::kTick;
  return lay_out_sheet(text, double(options.width) / options.height, options.text_scale, *options.theme,
                       fonts, height);
}

PoseFigureFit fit_of_poses(const TipMass& mass, const std::vector<std::vector<double>>& configurations, const PoseFigureOptions& options,
                           const Fonts& fonts) {
  Workspace ws(mass.chain());
  const PageInUnits page = in_units(options);
  const std::optional<Panels> best = best_panels(mass.chain(), poses_of(mass, configurations, options, ws), page, fonts, ws);
  if (!best) return {};
  const double of_width = double(page.options.height) / options.width;
  return {best->camera.scale * of_width, best->scale.per_unit() * of_width, best->words.fit && !has_cut_captions(*best), best->has_masses,
          best->lines.empty(), has_lengths(*best),
          best->places.size() < kManyPoses || (best->below.empty() && is_mostly_picture(*best))};
}

Picture draw_ellipse_figure(const TipMass& mass, const std::vector<std::vector<double>>& configurations,
                            const PoseFigureOptions& options, const Fonts& fonts, int* numbers_left_out) {
  const Chain& chain = mass.chain();
  if (configurations.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  Workspace ws(chain);
  const std::vector<Pose> poses = poses_of(mass, configurations, options, ws);
  if (options.cell > 0 || options.layout == "superposed")
    return draw_superposed(chain, poses, options, fonts, numbers_left_out);
  const PageInUnits page = in_units(options);
  std::optional<Panels> best = best_panels(chain, poses, page, fonts, ws);
  if (!best)
    throw Error(ExitCode::usage,
                "too many poses for one page: draw several figures, or take --layout superposed");
  if (!best->words.fit)
    throw Error(ExitCode::usage, "the words of " + std::to_string(poses.size()) + " poses have no room below panels this narrow: take fewer poses, "
                                 "a larger page, --layout grid or superposed");
  const Panels& panels = *best;
  cut_to_content(*best, sheet_of(chain, page.options, panels.scale, fonts, page.height).scene, poses, ws);

  Picture picture;
  picture.aspect = double(options.width) / page.options.height;
  picture.background = options.theme->background;
  int left_out = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) left_out += draw_panel(picture, panels, i, poses[i], ws);
  if (numbers_left_out != nullptr) *numbers_left_out = left_out;
  draw_sheet(picture, sheet_of(chain, page.options, panels.scale, fonts, page.height, panels.under));
  return in_page_units(picture, page.height);
}

}  // namespace chainreel
