// The unit circle of accelerations beside its image under M(q): what the mass matrix does, two joints at a time.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "draw/figures/caption.hpp"
#include "draw/figures/poses.hpp"
#include "draw/page/arrow.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/plot.hpp"

namespace chainreel {
namespace {

constexpr int kMostPoses = 3;
constexpr double kFill = 0.16;
constexpr double kWidestLabel = 0.25;  // of a frame
constexpr double kAirAround = 1.25;  // of what is drawn, to the frame of its axes

bool is_prismatic(const Chain& chain, int freedom) {
  for (const Body& body : chain.bodies)
    if (&body != &chain.bodies[0] && body.joint.v_index == freedom) return body.joint.kind == JointKind::prismatic;
  return false;
}

std::string acceleration_title(const Chain& chain, int joint) {
  return "$qdd" + std::to_string(joint + 1) + (is_prismatic(chain, joint) ? "$ [m/s\u00B2]" : "$ [rad/s\u00B2]");
}

std::string torque_title(const Chain& chain, int joint) {
  return "$tau" + std::to_string(joint + 1) + (is_prismatic(chain, joint) ? "$ [N]" : "$ [N m]");
}

PlotFrame frame_in(const Rect& area, double most, const std::string& x, const std::string& y, const PlotStyle& style) {
  return lay_out_plot(area, {Scale::linear, -most, most, x}, {Scale::linear, -most, most, y}, style);
}

// Axes with the same length per unit both ways, in the middle of where they were: squares of one size on one base line.
void make_equal_squares(PlotFrame& a, PlotFrame& b) {
  const double side = std::min({a.box.width(), a.box.height(), b.box.width(), b.box.height()});
  for (PlotFrame* frame : {&a, &b}) {
    const Point middle{(frame->box.x0 + frame->box.x1) / 2, (frame->box.y0 + frame->box.y1) / 2};
    frame->box = {middle.x - side / 2, middle.y - side / 2, middle.x + side / 2, middle.y + side / 2};
  }
}

// The image of the unit circle under a symmetric positive matrix, whose eigenvectors are its axes, with the images of the unit vectors as arrows.
void draw_image(Picture& picture, const PlotFrame& frame, const Eigen::Matrix2d& map, const std::string& symbol,
                std::array<int, 2> joints, const PlotStyle& style) {
  const int clip = int(picture.clips.size());
  picture.clips.push_back(frame.box);
  const Point center = frame.at({0, 0});
  const double unit = frame.box.width() / (frame.x.high - frame.x.low);
  const double angle = std::atan2(2 * map(0, 1), map(0, 0) - map(1, 1)) / 2;
  const double mean = (map(0, 0) + map(1, 1)) / 2;
  const double deviation = std::hypot(map(0, 1), (map(0, 0) - map(1, 1)) / 2);
  const double major = unit * (mean + deviation), minor = unit * (mean - deviation);
  const Color color = style.theme->ellipse;
  picture.add(Ellipse{center,
                      {major * std::cos(angle), major * std::sin(angle)},
                      {-minor * std::sin(angle), minor * std::cos(angle)},
                      {color.faded(kFill), color, size::kEllipseLine}},
              clip);
  for (int k = 0; k < 2; ++k) {
    const Point v{unit * map(0, k), unit * map(1, k)};
    const Color arrow = style.theme->curve[std::size_t(k)];
    draw_arrow(picture, center, v, {arrow, 1, false, 0, style.theme->lines}, clip);
    const TextStyle text{Face::math, style.text(size::kAxis), arrow, Align::center};
    const std::string name = symbol + std::to_string(joints[std::size_t(k)] + 1);
    TextLine label = lay_out_math(*style.fonts, name + " = 1", text);
    // Small frames have room for the symbol alone; that it is of unit length is said below the figure.
    if (label.advance > kWidestLabel * frame.box.width()) label = lay_out_math(*style.fonts, name, text);
    const double length = std::max(norm(v), 1e-9), em = text.size;
    // Beside the tip, on the side away from the other arrow.
    const double side = k == 0 ? -1 : 1;
    const Point out{-side * v.y / length, side * v.x / length};
    const double off = std::abs(out.x) * label.advance / 2 + std::abs(out.y) * 0.35 * em + 0.4 * em;
    Point at = center + 0.72 * v + off * out;
    const double half = label.advance / 2 + 0.006;
    at.x = std::clamp(at.x, frame.box.x0 + half, frame.box.x1 - half);
    at.y = std::clamp(at.y - 0.3 * em, frame.box.y0 + 0.3 * em, frame.box.y1 - em);
    draw_text(picture, label, at);
  }
}

void draw_posture(Picture& picture, const Chain& chain, const std::vector<double>& q, const Skeleton& skeleton,
                  Camera camera, const Rect& area, const Theme& theme) {
  Workspace ws(chain);
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  compute_kinematics(chain, ws, q, at_rest);
  ChainFit fit(chain, skeleton, camera);
  fit.add_pose(ws, kNoLimit);
  fit_to(camera, fit.box(), area, size::kFitMargin);
  const ChainDrawing drawing{chain, skeleton, camera, look_of(skeleton, camera, theme)};
  draw_base(picture, drawing, -1);
  draw_rails(picture, drawing, ws, -1);
  draw_links(picture, drawing, ws, -1);
  draw_end_effector(picture, camera.project(tip_position(chain, ws)), drawing.look, -1);
}

}  // namespace

Picture draw_joint_space_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                                std::array<int, 2> joints, const PoseFigureOptions& options,
                                const Fonts& fonts) {
  if (poses.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  if (int(poses.size()) > kMostPoses)
    throw Error(ExitCode::usage, "--joint-space shows at most " + std::to_string(kMostPoses) + " poses");
  Workspace ws(chain);
  std::vector<Eigen::Matrix2d> maps;
  double most = 0;
  for (const std::vector<double>& q : poses) {
    compute_mass_matrix(chain, ws, q);
    Eigen::Matrix2d map;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) map(i, j) = ws.M(joints[std::size_t(i)], joints[std::size_t(j)]);
    maps.push_back(map);
    most = std::max(most, map.rowwise().norm().maxCoeff());
  }
  Skeleton skeleton = skeleton_of(chain);
  for (const std::vector<double>& q : poses) widen_rails(skeleton, chain, q, kNoLimit);

  SheetText text;
  text.title = options.title;
  text.logo = logo_of(options);
  text.legend = "mass matrix M(q): accelerations of unit length, and the torques that they take";
  const Theme& theme = *options.theme;
  const Sheet sheet =
      lay_out_sheet(text, double(options.width) / options.height, options.text_scale, theme, fonts);
  const PlotStyle style{&fonts, &theme, options.text_scale};
  const double row = (sheet.scene.height() - double(poses.size() - 1) * size::kGutter) / double(poses.size());
  const double column = (sheet.scene.width() - 2 * size::kGutter) / 3;
  const double words = 1.6 * scaled(size::kAxis, options.text_scale);

  Picture picture;
  picture.aspect = sheet.aspect;
  picture.background = theme.background;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double top = sheet.scene.y1 - double(i) * (row + size::kGutter), bottom = top - row;
    const auto area = [&](int k) {
      const double x = sheet.scene.x0 + k * (column + size::kGutter);
      return Rect{x, bottom, x + column, top};
    };
    Rect body = area(0);
    body.y0 += words;
    draw_posture(picture, chain, poses[i], skeleton, view_of(chain), body, theme);
    const TextStyle caption{Face::math, scaled(size::kAxis, options.text_scale), theme.ink, Align::center};
    Rect below{body.x0, bottom, body.x1, bottom + (0.3 + 1.2) * caption.size};
    if (options.letters) below = draw_letter(picture, i, below, options.text_scale, theme, fonts);
    draw_text(picture, fit_math(fonts, pose_notations(chain, poses[i]), caption, below.width(), options.text_scale),
              {(below.x0 + below.x1) / 2, bottom + 0.3 * caption.size});
    PlotFrame from = frame_in(area(1), kAirAround, acceleration_title(chain, joints[0]),
                              acceleration_title(chain, joints[1]), style);
    PlotFrame to = frame_in(area(2), kAirAround * most, torque_title(chain, joints[0]), torque_title(chain, joints[1]),
                            style);
    make_equal_squares(from, to);
    draw_axes(picture, from, style);
    draw_image(picture, from, Eigen::Matrix2d::Identity(), "qdd", joints, style);
    draw_axes(picture, to, style);
    draw_image(picture, to, maps[i], "qdd", joints, style);
  }
  draw_sheet(picture, sheet);
  return picture;
}

}  // namespace chainreel
