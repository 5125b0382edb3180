#include "draw/layers/ellipse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/format.hpp"
#include "draw/layers/fading.hpp"
#include "draw/layers/layer.hpp"
#include "sim/instant.hpp"

namespace chainreel {
namespace {

// A semi-axis on the page: the whole vector, or the direction of an infinite one (projected, not unit).
struct PageAxis {
  Point v;
  std::optional<double> length;  // kg or m/s; absent: infinite
};

// From the longest to the shortest.
std::vector<PageAxis> page_axes(const std::vector<MassAxis>& axes, const Camera& camera, const EllipseStyle& style) {
  std::vector<PageAxis> projected;
  for (const MassAxis& axis : axes) {
    const Point d{camera.right.dot(axis.direction), camera.up.dot(axis.direction)};
    const std::optional<double> length = semi_axis(axis, style.reading);
    if (length) projected.push_back({(*length * style.per_unit) * d, length});
    if (!length && norm(d) > 1e-6) projected.push_back({d, length});
  }
  // What is heavy is slow.
  if (style.reading == EllipseReading::energy) std::reverse(projected.begin(), projected.end());
  return projected;
}

// The ellipse on the page whose support function is sqrt(sum (a_i . n)^2): the silhouette of the ellipsoid
// with the projected semi-axes a_i; for two perpendicular a_i just the ellipse itself.
std::array<Point, 2> silhouette(const std::vector<PageAxis>& axes) {
  double xx = 0, xy = 0, yy = 0;
  for (const PageAxis& a : axes) {
    xx += a.v.x * a.v.x;
    xy += a.v.x * a.v.y;
    yy += a.v.y * a.v.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const double mean = (xx + yy) / 2, deviation = std::hypot((xx - yy) / 2, xy);
  const Point u{std::cos(angle), std::sin(angle)};
  return {std::sqrt(mean + deviation) * u, std::sqrt(std::max(mean - deviation, 0.0)) * normal_to(u)};
}

// How far the finite axes reach from the centre along the unit vector n.
double reach_along(const std::vector<PageAxis>& axes, Point n) {
  double squared = 0;
  for (const PageAxis& axis : axes)
    if (axis.length) squared += dot(axis.v, n) * dot(axis.v, n);
  return std::sqrt(squared);
}

void draw_ellipse(Picture& picture, Point center, const std::array<Point, 2>& axes, const Paint& paint,
                  const EllipseStyle& style, int clip) {
  const auto [u, v] = axes;
  const Fade fade =
      longer(fade_along(style.scene, center, u, style.fade), fade_along(style.scene, center, v, style.fade));
  if (norm(v) < kNoLength)  // nothing moves along the other axis
    return draw_axis(picture, center, u, false, paint.stroke_width, paint.stroke, fade, clip);
  picture.add(Ellipse{center, std::min(1.0, kLongest / norm(u)) * u, v, paint, fade}, clip);
}

// The axes that have an end, solid the first of all and dashed the others, with their lengths where none is seen.
void draw_finite_axes(Picture& picture, const std::vector<PageAxis>& axes, Point center, const EllipseStyle& style,
                      int clip) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!axes[i].length || !(norm(axes[i].v) > kNoLength)) continue;
    const Fade fade = fade_before_length(center, axes[i].v, *axes[i].length, style);
    draw_axis(picture, center, axes[i].v, i > 0, style.lines * size::kEllipseAxis, style.theme->ellipse, fade, clip);
    draw_length_along(picture, center, axes[i].v, *axes[i].length, reach_along(axes, normal_to(unit(axes[i].v))),
                      style, clip);
  }
}

void draw_closed(Picture& picture, const std::vector<PageAxis>& axes, Point center, const EllipseStyle& style,
                 int clip) {
  const Color line = style.theme->ellipse;
  const bool solid = axes.size() > 2;
  const auto outline = silhouette(axes);
  draw_ellipse(picture, center, outline,
               {line.faded(solid ? kSilhouetteFill : kEllipseFill), line, style.lines * size::kEllipseLine}, style,
               clip);
  if (norm(outline[1]) < kNoLength && !solid)
    return draw_length_along(picture, center, axes[0].v, *axes[0].length, 0, style, clip);
  for (std::size_t i = 0; solid && i < axes.size(); ++i) {
    const auto principal = silhouette({axes[i], axes[(i + 1) % axes.size()]});
    if (norm(principal[1]) > kNoLength)
      draw_ellipse(picture, center, principal, {{}, line, style.lines * size::kEllipseAxis}, style, clip);
  }
  draw_finite_axes(picture, axes, center, style, clip);
}

// The whole line through p along the unit vector d, from edge to edge of the scene, fading over its last
// stretches.
void draw_fading_line(Picture& picture, Point p, Point d, const EllipseStyle& style, int clip) {
  const auto part = part_inside(style.scene, p - kBeyond * d, p + kBeyond * d);
  if (!part) return;
  const double in = kBeyond * (2 * part->first - 1), out = kBeyond * (2 * part->second - 1);
  const double fade = std::min(style.fade, (out - in) / 2);
  const Point a = p + in * d, b = p + out * d;
  Capsule line{a + fade * d, b - fade * d, style.lines * size::kEllipseLine / 2, {style.theme->ellipse, {}, 0}};
  picture.add(line, clip);
  line.alpha_b = 0;
  for (const auto& [inner, edge] : {std::pair{a + fade * d, a}, {b - fade * d, b}}) {
    line.a = inner;
    line.b = edge;
    picture.add(line, clip);
  }
}

// The fill between the lines.
void draw_fading_fill(Picture& picture, Point center, Point half_width, const Fade& fade, Color line, int clip) {
  const Rect& r = fade.scene;
  Polygon band{{Point{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, 4, {line.faded(kEllipseFill), {}, 0}};
  band = cut(cut(band, center + half_width, -1 * half_width), center - half_width, half_width);
  band.fade = fade;
  if (band.count >= 3) picture.add(band, clip);
}

void draw_open(Picture& picture, const std::vector<PageAxis>& axes, Point center, Point direction,
               const EllipseStyle& style, int clip) {
  const Color line = style.theme->ellipse;
  const Point d = unit(direction), n = normal_to(d);
  const double half_width = reach_along(axes, n);
  // As of an axis that is longer than any page: an ellipse that grows goes over into this band.
  draw_fading_fill(picture, center, half_width * n, fade_along(style.scene, center, 2 * kBeyond * d, style.fade), line,
                   clip);
  for (const double side : {-1.0, 1.0}) {
    draw_fading_line(picture, center + (side * half_width) * n, d, style, clip);
  }
  draw_axis(picture, center, kBeyond * d, false, style.lines * size::kEllipseAxis, line,
            fade_before_infinity(center, d, style), clip);
  draw_axis(picture, center, half_width * n, true, style.lines * size::kEllipseAxis, line,
            fade_along(style.scene, center, half_width * n, style.fade), clip);
  draw_infinities(picture, center, d, half_width, style, clip);
  for (const PageAxis& axis : axes)
    if (axis.length && norm(axis.v) > kNoLength)
      draw_length_along(picture, center, axis.v, *axis.length, 0, style, clip);
}

}  // namespace

std::string ellipse_legend(EllipseReading reading, bool section) {
  const std::string cut = section ? ", cut at the tool" : "";
  switch (reading) {
    case EllipseReading::energy:
      return "kinetic energy ellipse of \u039B(q)" + cut + ": velocities of equal energy, 0.5 J";
    case EllipseReading::belt:
      return "effective mass belt of \u039B(q)" + cut + ": mass felt along each direction";
    default:
      return "effective mass ellipse \u039B(q)" + cut + ": force for unit acceleration";
  }
}

std::vector<MassAxis> mass_axes(const EffectiveMass& effective) {
  const Eigen::Index rows = effective.mobility.size();
  const double largest = rows == 0 ? 0 : effective.mobility.maxCoeff();
  std::vector<MassAxis> axes;
  for (Eigen::Index i = 0; i < rows; ++i) {
    MassAxis axis;
    axis.direction = Eigen::Vector3d::Zero();
    for (Eigen::Index j = 0; j < rows; ++j) {
      axis.direction += effective.directions(j, i) * effective.basis.directions[std::size_t(j)];
    }
    const double mobility = effective.mobility(i);
    if (mobility > kSingularFraction * largest) axis.mass = 1 / mobility;
    axes.push_back(axis);
  }
  return axes;
}

std::optional<double> semi_axis(const MassAxis& axis, EllipseReading reading) {
  if (reading != EllipseReading::energy) return axis.mass;
  return axis.mass ? 1 / std::sqrt(*axis.mass) : 0.0;
}

std::optional<double> bounded_semi_axis(const std::vector<MassAxis>& axes, EllipseReading reading) {
  return axes.empty() ? std::nullopt : semi_axis(axes.back(), reading);
}

std::string EllipseScale::label() const {
  return format_shortest(bar) + (reading == EllipseReading::energy ? " m/s" : " kg");
}

EllipseScale ellipse_scale(std::vector<double> bounded, double bar_length, EllipseReading reading) {
  EllipseScale scale{1, bar_length, reading};
  std::erase_if(bounded, [](double m) { return !(std::isfinite(m) && m > 0); });
  if (bounded.empty()) return scale;
  const auto middle = bounded.begin() + std::ptrdiff_t(bounded.size() / 2);
  std::nth_element(bounded.begin(), middle, bounded.end());
  const double decade = std::pow(10.0, std::floor(std::log10(*middle)));
  double nearest = decade;
  for (const double step : {2.0, 5.0, 10.0}) {
    // Nearest in ratio, as lengths are compared by eye.
    if (std::abs(std::log(*middle / (step * decade))) < std::abs(std::log(*middle / nearest)))
      nearest = step * decade;
  }
  scale.bar = nearest;
  return scale;
}

void draw_mass_ellipse(Picture& picture, const std::vector<MassAxis>& axes, Point center,
                       const Camera& camera, const EllipseStyle& style, int clip) {
  if (!contains(style.scene, center)) return;
  if (style.reading == EllipseReading::belt) return draw_belt(picture, axes, center, camera, style, clip);
  const std::vector<PageAxis> projected = page_axes(axes, camera, style);
  Point open{};
  bool all_open = false;
  for (const PageAxis& axis : projected) {
    if (axis.length) continue;
    // A second, different open direction leaves nothing bounded.
    if (norm(open) > 0 && std::abs(dot(unit(open), normal_to(unit(axis.v)))) > 1e-6) all_open = true;
    open = axis.v;
  }
  if (all_open) {
    draw_infinities(picture, center, {1, 0}, 0, style, clip);
  } else if (norm(open) > 0) {
    draw_open(picture, projected, center, open, style, clip);
  } else if (!projected.empty()) {
    draw_closed(picture, projected, center, style, clip);
  }
}

std::vector<MassAxis> section_axes(const EffectiveMass& effective, const Eigen::Matrix<double, 3, 2>& plane,
                                   EllipseReading reading) {
  const double largest = effective.mobility.size() < 3 ? 0 : effective.mobility.maxCoeff();
  if (!(largest > 0)) return mass_axes(effective);
  const double least = kSingularFraction * largest;  // 1/kg: smaller counts as none
  // The form of the curve of `energy` grows without bounds at singular poses, where the curve is a segment: a
  // mass beyond all that counts stands for it.
  constexpr double kBeyondAll = 1e-3;
  auto values = effective.mobility;
  for (double& m : values) {
    if (reading == EllipseReading::mass) m = m * m;
    if (reading == EllipseReading::energy) m = 1 / std::max(m, kBeyondAll * least);
  }
  const PlaneForm form = form_on_plane(effective, values, plane);
  std::vector<MassAxis> axes;
  for (int i = 0; i < 2; ++i) {
    // As kg, whatever the form says.
    double mobility = form.values[i];
    if (reading == EllipseReading::mass) mobility = std::sqrt(mobility);
    if (reading == EllipseReading::energy) mobility = mobility > 0 ? 1 / mobility : 0;
    MassAxis axis;
    axis.direction = form.directions.col(i);
    if (mobility > least) axis.mass = 1 / mobility;
    axes.push_back(axis);
  }
  if (reading == EllipseReading::energy) std::swap(axes[0], axes[1]);
  return axes;
}

// The layer `ellipse`: the effective mass of the end effector along a run, at one scale for the whole film.

namespace {

constexpr double kEllipseBar = 0.10;  // units of H: the bounded semi-axis measures about as much

class EllipseLayer : public Layer {
 public:
  explicit EllipseLayer(const Stage& stage)
      : stage_(&stage),
        reading_(stage.page.ellipse.reading),
        is_section_(stage.page.ellipse.shape == EllipseShape::section) {
    for (const StagedRun& motion : stage.motions)
      if (is_of(motion)) masses_.emplace(&motion, motion);
    // Panels share the page, so their sides shrink with the root of their number.
    scale_ = ellipse_scale(bounded_semi_axes(), kEllipseBar / std::sqrt(double(stage.full_panels())), reading_);
  }

  UnderWords under_words() const override { return UnderWords::if_need_be; }
  bool has_words() const override { return true; }

  void write(SheetText& text) const override {
    text.bar = scale_.label();
    text.bar_length = scale_.bar_length;
    if (stage_->shows("legend"))
      text.legend = ellipse_legend(reading_, is_section_ && !stage_->motions.front().chain().planar);
  }

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    EllipseStyle style{&stage_->theme,   &stage_->fonts, panel.scene().text_scale,
                       scale_.per_unit(), panel.area(),   reading_};
    style.labels = &shot.labels;
    const Camera seen = panel.camera().seen_at(tip_position(panel.chain(), shot.ws));
    draw_mass_ellipse(picture, axes_at(panel.motion(), shot.k), panel.tip().place(shot.k), seen, style, panel.clip());
  }

 private:
  struct MassAlong {
    explicit MassAlong(const StagedRun& motion)
        : mass(motion.chain(), motion.simulation() ? motion.simulation()->constraints : ConstraintPlan{}),
          ws(std::make_unique<Workspace>(motion.chain())) {}
    TipMass mass;
    std::unique_ptr<Workspace> ws;  // its own: the mass needs more than the pose, and spoils it
  };

  std::vector<MassAxis> axes_at(const StagedRun& motion, int k) const {
    const MassAlong& along = masses_.at(&motion);
    const EffectiveMass effective = along.mass.at(*along.ws, motion.trajectory().q_at(k));
    if (!is_section_) return mass_axes(effective);
    return section_axes(effective, tip_plane(motion.chain(), motion.pose_at(k)), reading_);
  }

  // At some of the frames, kg or m/s.
  std::vector<double> bounded_semi_axes() const {
    std::vector<double> bounded;
    for (const auto& [motion, mass] : masses_)
      for (const int k : some_of(motion->samples()))
        if (const auto length = bounded_semi_axis(axes_at(*motion, k), reading_)) bounded.push_back(*length);
    return bounded;
  }

  const Stage* stage_;
  EllipseReading reading_;
  bool is_section_;
  std::map<const StagedRun*, MassAlong> masses_;
  EllipseScale scale_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_ellipse(const Stage& stage) {
  return std::make_unique<EllipseLayer>(stage);
}

}  // namespace chainreel
