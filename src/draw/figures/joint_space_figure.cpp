// The unit circle of accelerations beside its image under M(q): what the mass matrix does, two joints at a time.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "core/error.hpp"
#include "draw/figures/caption.hpp"
#include "draw/figures/joint_space_layout.hpp"
#include "draw/figures/poses.hpp"
#include "draw/page/arrow.hpp"
#include "draw/page/mark_labels.hpp"
#include "draw/page/panel_grid.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/chain_fit.hpp"
#include "draw/robot/joints.hpp"
#include "draw/robot/view.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/place_picture.hpp"
#include "picture/plot.hpp"

namespace chainreel {
namespace {

constexpr double kFill = 0.16;
constexpr double kWidestLabel = 0.25;  // of a frame
constexpr double kAirAround = 1.25;  // of what is drawn, to the frame of its axes
constexpr double kLetterRoom = 2.5;    // of the em
constexpr double kLeastSquare = 4;       // of the em of numbers: below, axes cannot be read
constexpr double kUsualBlock = 26;       // of the em, of a page that is as high as its blocks need
constexpr double kMostHead = 0.45, kSmallestArrow = 0.25;  // of an arrow's length; of its size: thinner ones cannot be seen
constexpr double kFullArrows = 0.25;     // units of H, of a square: arrows are smaller in smaller ones

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

JointSpaceAxes axes_of(const Chain& chain, std::array<int, 2> joints, double most) {
  const auto axis = [](double end, const std::string& title) { return Axis{Scale::linear, -end, end, title}; };
  const auto [i, j] = joints;
  return {axis(kAirAround, acceleration_title(chain, i)), axis(kAirAround, acceleration_title(chain, j)),
          axis(kAirAround * most, torque_title(chain, i)), axis(kAirAround * most, torque_title(chain, j))};
}

// The part of M(q) that belongs to the two joints.
Eigen::Matrix2d mass_of(const Workspace& ws, std::array<int, 2> joints) {
  Eigen::Matrix2d map;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) map(i, j) = ws.M(joints[std::size_t(i)], joints[std::size_t(j)]);
  return map;
}

struct Arrow {
  Point v;
  Color color;
  TextLine name;
};

// What a name lies on that stands there: other arrows, the curve, the zero lines.
double price_of(const Rect& place, const PlotFrame& frame, std::span<const Point> curve, const std::array<Arrow, 2>& arrows,
                int own, double fraction, const std::optional<Rect>& other) {
  constexpr int kPieces = 24;
  constexpr double kOfCurve = 1, kOfArrow = 2, kOfZero = 0.15, kOfOther = 100, kOfEdge = 100, kOfTip = 6, kOfStray = 2;
  const Point center = frame.at({0, 0});
  const auto lies_in = [&](Point p) { return p.x > place.x0 && p.x < place.x1 && p.y > place.y0 && p.y < place.y1; };
  double price = is_within(place, frame.box) ? 0 : kOfEdge;
  if (other && overlap(place, widened(*other, 0.35 * place.height()))) price += kOfOther;
  for (const Point& p : curve) price += lies_in(p) ? kOfCurve : 0;
  for (int k = 0; k <= kPieces; ++k) {
    const double s = double(k) / kPieces;
    for (const Arrow& arrow : arrows) price += lies_in(center + s * arrow.v) ? kOfArrow : 0;
    price += lies_in({frame.box.x0 + s * frame.box.width(), center.y}) ? kOfZero : 0;
    price += lies_in({center.x, frame.box.y0 + s * frame.box.height()}) ? kOfZero : 0;
  }
  // Nearer to its own arrow's tip than to the other one's.
  const Point middle = center_of(place);
  const double to_own = norm(middle - center - arrows[std::size_t(own)].v), to_other = norm(middle - center - arrows[std::size_t(1 - own)].v);
  if (to_other < 1.3 * to_own) price += kOfStray;
  return price + kOfTip * (1 - fraction);
}

// The name of an arrow beside it, where it lies on as little as can be.
Rect place_of_name(const PlotFrame& frame, std::span<const Point> curve, const std::array<Arrow, 2>& arrows, int own,
                   double em, const std::optional<Rect>& other) {
  constexpr int kDirections = 16;
  const Arrow& arrow = arrows[std::size_t(own)];
  const Point center = frame.at({0, 0});
  Rect best{};
  double least = std::numeric_limits<double>::infinity();
  for (const double fraction : {1.0, 0.8, 0.6})
    for (const double gap : {0.3, 0.7, 1.3})
      for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * std::numbers::pi * k / kDirections;
        const Rect place = place_beyond(arrow.name, center + fraction * arrow.v, gap * em, {std::cos(angle), std::sin(angle)});
        const double price = price_of(widened(place, 0.1 * em), frame, curve, arrows, own, fraction, other) + gap;
        if (price < least) least = price, best = place;
      }
  return best;
}

// The image of the unit circle under a symmetric positive matrix, whose eigenvectors are its axes, with the images of the unit vectors as arrows.
void draw_image(Picture& picture, const PlotFrame& frame, const Eigen::Matrix2d& map, std::array<int, 2> joints,
                bool is_torque, const PlotStyle& style) {
  constexpr int kOnCurve = 96;
  const int clip = int(picture.clips.size());
  picture.clips.push_back(frame.box);
  const Point center = frame.at({0, 0});
  const double unit = frame.box.width() / (frame.x.high - frame.x.low);
  const double angle = std::atan2(2 * map(0, 1), map(0, 0) - map(1, 1)) / 2;
  const double mean = (map(0, 0) + map(1, 1)) / 2;
  const double deviation = std::hypot(map(0, 1), (map(0, 0) - map(1, 1)) / 2);
  const double major = unit * (mean + deviation), minor = unit * (mean - deviation);
  const Point u{major * std::cos(angle), major * std::sin(angle)}, v{-minor * std::sin(angle), minor * std::cos(angle)};
  const Color color = style.theme->ellipse;
  picture.add(Ellipse{center, u, v, {color.faded(kFill), color, size::kEllipseLine}}, clip);
  std::vector<Point> curve;
  for (int k = 0; k < kOnCurve; ++k) {
    const double turn = 2 * std::numbers::pi * k / kOnCurve;
    curve.push_back(center + std::cos(turn) * u + std::sin(turn) * v);
  }
  std::array<Arrow, 2> arrows;
  const double em = style.text(size::kAxis);
  for (int k = 0; k < 2; ++k) {
    Arrow& arrow = arrows[std::size_t(k)];
    arrow.v = {unit * map(0, k), unit * map(1, k)};
    arrow.color = style.theme->curve[std::size_t(k)];
    const TextStyle text{Face::math, em, arrow.color, Align::center};
    // In the space of torques an arrow is a column of M, what the unit of acceleration takes.
    const std::string number = std::to_string(joints[std::size_t(k)] + 1), name = is_torque ? "M e_{" + number + "}" : "qdd" + number;
    arrow.name = lay_out_math(*style.fonts, is_torque ? name : name + " = 1", text);
    // Small frames have room for the symbol alone; that it is of unit length is said below the figure.
    if (arrow.name.advance > kWidestLabel * frame.box.width()) arrow.name = lay_out_math(*style.fonts, name, text);
    // A short one keeps a shaft that can be seen.
    const double of_frame = std::clamp(frame.box.width() / kFullArrows, 0.5, 1.0), of_length = std::max(kMostHead * norm(arrow.v) / size::kArrowHead, kSmallestArrow);
    draw_arrow(picture, center, arrow.v, {arrow.color, std::min(of_frame, of_length), false, 0, style.theme->lines}, clip);
  }
  std::optional<Rect> before;
  for (int k = 0; k < 2; ++k) {
    const TextLine& name = arrows[std::size_t(k)].name;
    const Rect place = place_of_name(frame, curve, arrows, k, em, before);
    draw_text(picture, name, {place.x0 - name.box.x0, place.y0 - name.box.y0});
    before = place;
  }
}

// All that a joint-space figure is drawn from. Its unit is the page's height, of pages higher than slides that of a slide as wide.
class JointSpaceFigure {
 public:
  JointSpaceFigure(const Chain& chain, const std::vector<std::vector<double>>& poses, std::array<int, 2> joints,
                   const PoseFigureOptions& options, const Fonts& fonts);

  // Squares as large as the page has room for.
  JointSpaceLayout layout() const;
  // As many blocks across as are of usual width, and as high as they get.
  JointSpaceLayout layout_by_width() const;
  bool can_be_read(const JointSpaceLayout& layout) const { return layout.side >= kLeastSquare * style_.text(size::kTick); }
  double height_around(const JointSpaceLayout& layout) const { return height_ - sheet_.scene.height() + layout.height; }
  double unit_px() const { return unit_px_; }

  Picture draw(const JointSpaceLayout& layout);

 private:
  int count() const { return int(poses_.size()); }
  Sheet sheet() const;
  Camera camera_in(const Rect& square, double marks);
  void draw_posture(Picture& picture, const std::vector<double>& q, const Camera& camera, double marks);
  void draw_words(Picture& picture, std::size_t pose, const Rect& box) const;

  const Chain& chain_;
  const std::vector<std::vector<double>>& poses_;
  std::array<int, 2> joints_;
  const PoseFigureOptions& options_;
  const Fonts& fonts_;
  Workspace ws_;
  Skeleton skeleton_;
  std::vector<Eigen::Matrix2d> maps_;
  double unit_px_ = 1080, height_ = 1, text_scale_ = 1;
  Sheet sheet_;
  PlotStyle style_;
  JointSpaceAxes axes_;
};

JointSpaceFigure::JointSpaceFigure(const Chain& chain, const std::vector<std::vector<double>>& poses, std::array<int, 2> joints,
                                   const PoseFigureOptions& options, const Fonts& fonts)
    : chain_(chain), poses_(poses), joints_(joints), options_(options), fonts_(fonts), ws_(chain), skeleton_(skeleton_of(chain)) {
  if (poses.empty()) throw Error(ExitCode::usage, "a figure needs at least one pose");
  double most = 0;
  for (const std::vector<double>& q : poses) {
    widen_rails(skeleton_, chain, q, kNoLimit);
    compute_mass_matrix(chain, ws_, q);
    maps_.push_back(mass_of(ws_, joints));
    most = std::max(most, maps_.back().rowwise().norm().maxCoeff());
  }
  const PageInUnits page = in_units(options);
  unit_px_ = page.options.height;
  height_ = page.height;
  text_scale_ = page.options.text_scale;
  sheet_ = sheet();
  style_ = {&fonts, options.theme, text_scale_};
  axes_ = axes_of(chain, joints, most);
}

Sheet JointSpaceFigure::sheet() const {
  SheetText text;
  text.title = options_.title;
  text.logo = logo_of(options_);
  if (text.logo) text.logo->page_height = int(unit_px_);
  text.legend = "mass matrix M(q): accelerations of unit length, and the torques that they take";
  text.legend_size = size::kTick;
  return lay_out_sheet(text, options_.width / unit_px_, text_scale_, *options_.theme, fonts_, height_);
}

JointSpaceLayout JointSpaceFigure::layout() const {
  JointSpaceLayout best;
  for (int across = 1; across <= count(); ++across) {
    const JointSpaceLayout tried = lay_out_blocks(axes_, count(), across, sheet_.scene.width(), sheet_.scene.height(), style_);
    if (across == 1 || tried.side > best.side) best = tried;
  }
  return best;
}

JointSpaceLayout JointSpaceFigure::layout_by_width() const {
  const double block = kUsualBlock * style_.text(size::kTick);
  const int across = std::clamp(int(sheet_.scene.width() / block), 1, count());
  return lay_out_blocks(axes_, count(), across, sheet_.scene.width(), std::numeric_limits<double>::infinity(), style_);
}

// One for all poses, so that they can be compared by eye.
Camera JointSpaceFigure::camera_in(const Rect& square, double marks) {
  const std::vector<double> at_rest(std::size_t(chain_.nv), 0.0);
  const auto fit = [&](Camera& seen) {
    ChainFit places(chain_, skeleton_, seen, marks, options_.shapes.get());
    for (const std::vector<double>& q : poses_) {
      compute_kinematics(chain_, ws_, q, at_rest);
      places.add_pose(ws_, kNoLimit);
    }
    fit_to(seen, places.box(), square, 0);
  };
  return aimed_camera(chain_, options_.camera, box_around(chain_, skeleton_, options_.shapes.get(), ws_, poses_), square, fit);
}

void JointSpaceFigure::draw_posture(Picture& picture, const std::vector<double>& q, const Camera& camera, double marks) {
  const std::vector<double> at_rest(std::size_t(chain_.nv), 0.0);
  compute_kinematics(chain_, ws_, q, at_rest);
  const ChainDrawing drawing{chain_, skeleton_, camera, look_of(skeleton_, camera, *options_.theme, 1, marks), options_.shapes.get()};
  draw_base(picture, drawing, -1);
  draw_rails(picture, drawing, ws_, -1);
  draw_links(picture, drawing, ws_, -1);
  if (!drawing.shapes) draw_end_effector(picture, camera.project(tip_position(chain_, ws_)), drawing.look, -1);
}

void JointSpaceFigure::draw_words(Picture& picture, std::size_t pose, const Rect& box) const {
  std::vector<std::vector<std::string>> forms;
  for (const std::vector<double>& q : poses_) forms.push_back(pose_notations(chain_, q));
  const double letter = options_.letters ? kLetterRoom * style_.text(size::kAxis) : 0;
  const CaptionLines lines = caption_lines(forms, box.width() - letter, text_scale_, *options_.theme, fonts_);
  const Rect rest = options_.letters ? draw_letter(picture, pose, lines.size, box, text_scale_, *options_.theme, fonts_) : box;
  draw_text(picture, lay_out_math(fonts_, lines.notations[pose], {Face::math, lines.size, options_.theme->ink, Align::left}),
            {rest.x0, caption_base(box, text_scale_)});
}

Picture JointSpaceFigure::draw(const JointSpaceLayout& layout) {
  Picture picture;
  picture.aspect = options_.width / unit_px_;
  picture.background = options_.theme->background;
  const std::vector<JointSpaceBlock> blocks = blocks_of(layout, axes_, count(), sheet_.scene, style_);
  const double marks = marks_in(blocks[0].chain);
  const Camera first = camera_in(blocks[0].chain, marks);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const JointSpaceBlock& block = blocks[i];
    Camera camera = first;
    camera.origin = camera.origin + Point{block.chain.x0 - blocks[0].chain.x0, block.chain.y0 - blocks[0].chain.y0};
    draw_posture(picture, poses_[i], camera, marks);
    draw_words(picture, i, block.words);
    draw_axes(picture, block.from, style_);
    draw_image(picture, block.from, Eigen::Matrix2d::Identity(), joints_, false, style_);
    draw_axes(picture, block.to, style_);
    draw_image(picture, block.to, maps_[i], joints_, true, style_);
  }
  draw_sheet(picture, sheet_);
  return in_page_units(picture, height_);
}

}  // namespace

bool joint_space_has_room(const Chain& chain, const std::vector<std::vector<double>>& poses, std::array<int, 2> joints,
                          const PoseFigureOptions& options, const Fonts& fonts) {
  const JointSpaceFigure figure(chain, poses, joints, options, fonts);
  return figure.can_be_read(figure.layout());
}

std::optional<double> joint_space_height(const Chain& chain, const std::vector<std::vector<double>>& poses,
                                         std::array<int, 2> joints, const PoseFigureOptions& options, const Fonts& fonts) {
  const JointSpaceFigure figure(chain, poses, joints, options, fonts);
  const JointSpaceLayout layout = figure.layout_by_width();
  if (!figure.can_be_read(layout)) return std::nullopt;
  return figure.height_around(layout) * figure.unit_px();
}

Picture draw_joint_space_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                                std::array<int, 2> joints, const PoseFigureOptions& options,
                                const Fonts& fonts) {
  JointSpaceFigure figure(chain, poses, joints, options, fonts);
  const JointSpaceLayout layout = figure.layout();
  if (!figure.can_be_read(layout))
    throw Error(ExitCode::usage, poses.size() == 1 ? "the page is too small for the squares of --joint-space beside their words: take a larger one"
                                                   : "the page has no room for the squares of " + std::to_string(poses.size()) +
                                                         " poses beside their words: take fewer, or a higher page");
  return figure.draw(layout);
}

}  // namespace chainreel
