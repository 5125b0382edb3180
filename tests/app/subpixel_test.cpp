// Pixels against closed forms: where joints, links, grippers and ellipses of films are, to a fraction of a
// pixel. World to page is scale and shift of the film's one camera; everything else is from formulas.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "picture/theme.hpp"
#include "support/fonts.hpp"

namespace chainreel {
namespace {

constexpr int kWide = 1920, kHigh = 1080;
// Coverage is rounded to 1/255 and summed over hundreds of pixels; shapes are exact in their middle. Discs
// and lines are found within a few hundredths of a pixel: a tenth is what nobody sees.
constexpr double kSubPixel = 0.1;

// How much of `b` there is on the way from `a` to `b`.
double part_of(Pixel p, Color a, Color b) {
  const double v[3] = {double(b.r) - a.r, double(b.g) - a.g, double(b.b) - a.b};
  const double d[3] = {double(p.r) - a.r, double(p.g) - a.g, double(p.b) - a.b};
  return (v[0] * d[0] + v[1] * d[1] + v[2] * d[2]) / (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// The film of a scene from where it stands still at `q`, and pixels of it. Places in pixels, y down.
class Still {
 public:
  Still(const std::string& scene, const std::string& q, const std::string& theme, const std::string& layers,
        const std::vector<std::string>& more = {})
      : theme_(theme_named(theme)) {
    std::vector<std::string> keys{"start={q: [" + q + "]}", "torque=[0, 0]", "duration=1", "theme=" + theme,
                                  "draw=[" + layers + "]"};
    keys.insert(keys.end(), more.begin(), more.end());
    const PreparedFilm film = load_film("assets/scenes/" + scene + ".yaml", keys);
    const std::vector<double> times = frame_times(film.scene);
    const Runs runs(film, {}, times);
    const Film pictures = runs.pictures(int(times.size()), fonts());
    Picture picture = pictures.static_layer();
    picture.append(pictures.frame(0));
    image_ = rasterise(picture, kWide, kHigh, fonts());
    origin_ = pictures.camera().origin;
    scale_ = pictures.camera().scale;
    per_kg_ = test::per_unit_of_bar(pictures.static_layer(), theme_);
    area_ = pictures.scene_area();
  }

  const Theme& theme() const { return theme_; }
  double pixels_per_metre() const { return scale_ * kHigh; }
  double pixels_per_kg() const { return per_kg_ * kHigh; }
  Point at(double x, double y) const {
    return {(origin_.x + scale_ * x) * kHigh, (1 - origin_.y - scale_ * y) * kHigh};
  }

  // Ellipses have no part in the fit: some end beyond the scene.
  bool shows(Point p, double air) const {
    return p.x > area_.x0 * kHigh + air && p.x < area_.x1 * kHigh - air &&
           p.y > (1 - area_.y1) * kHigh + air && p.y < (1 - area_.y0) * kHigh - air;
  }

  Pixel pixel(Point p) const { return image_.at(int(p.x), int(p.y)); }

  // The weighted middle of what is `ink` on `ground` within `radius` of a point.
  Point middle(Point near, double radius, Color ground, Color ink) const {
    double sum = 0, x = 0, y = 0;
    for_each_near(near, radius, [&](Point p, Pixel pixel) {
      const double weight = std::clamp(part_of(pixel, ground, ink), 0.0, 1.0);
      sum += weight, x += weight * p.x, y += weight * p.y;
    });
    return sum > 0 ? Point{x / sum, y / sum} : Point{-1, -1};
  }

  // Coverage of `ink` along a ray, from `from` to `to` pixels, by bilinear samples twenty a pixel: its
  // integral and its middle.
  struct OnRay {
    double length = 0, middle = 0;
  };
  OnRay along(Point start, Point direction, double from, double to, Color ground, Color ink) const {
    OnRay found;
    constexpr double kStep = 0.05;
    for (double r = from + kStep / 2; r < to; r += kStep) {
      const double weight = sample(start + r * direction, ground, ink) * kStep;
      found.length += weight, found.middle += weight * r;
    }
    found.middle /= found.length;
    return found;
  }

 private:
  void for_each_near(Point near, double radius, const std::function<void(Point, Pixel)>& visit) const {
    for (int y = int(near.y - radius) - 1; y <= int(near.y + radius) + 1; ++y)
      for (int x = int(near.x - radius) - 1; x <= int(near.x + radius) + 1; ++x) {
        const Point p{x + 0.5, y + 0.5};
        if (std::hypot(p.x - near.x, p.y - near.y) <= radius) visit(p, image_.at(x, y));
      }
  }
  double sample(Point p, Color ground, Color ink) const {
    const double x = p.x - 0.5, y = p.y - 0.5;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const double u = x - i, v = y - j;
    const auto at = [&](int a, int b) { return part_of(image_.at(a, b), ground, ink); };
    return (1 - u) * (1 - v) * at(i, j) + u * (1 - v) * at(i + 1, j) + (1 - u) * v * at(i, j + 1) +
           u * v * at(i + 1, j + 1);
  }

  const Theme& theme_;
  Image image_;
  Point origin_;
  double scale_ = 1, per_kg_ = 1;
  Rect area_;
};

double apart(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// Along an oblique ray: the curve bends within the width of its line, and the ray stays in it a little
// longer.
constexpr double kOblique = 0.15;

class Pixels : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Themes, Pixels, ::testing::Values("light", "dark"));

// RR with links of 1 m: elbow and gripper.
Point elbow(double q1) {
  return {std::cos(q1), std::sin(q1)};
}
Point tip(double q1, double q2) {
  return elbow(q1) + elbow(q1 + q2);
}

TEST_P(Pixels, HaveJointsAndGripperOfRrWhereItsFormulaSays) {
  for (const auto& [q1, q2] : {std::pair{0.3, 0.7}, {-1.1, 2.0}, {2.5, -0.4}}) {
    const Still still("rr_free", std::to_string(q1) + ", " + std::to_string(q2), GetParam(), "chain");
    const Theme& theme = still.theme();
    const Point end = tip(q1, q2), bend = elbow(q1);
    // The gripper is a disc of ink on the second link's fill; its outline is farther away than the radius
    // looked at.
    const double reach = 0.6 * size::kEndEffector * kHigh;
    const Point gripper = still.middle(still.at(end.x, end.y), reach, theme.link[1], theme.ink);
    EXPECT_LT(apart(gripper, still.at(end.x, end.y)), kSubPixel);
    // A joint is a dot of ink on a disc of the background's colour.
    const double inside = 0.3 * size::kJointDisc * kHigh;
    const Point joint = still.middle(still.at(bend.x, bend.y), inside, theme.background, theme.ink);
    EXPECT_LT(apart(joint, still.at(bend.x, bend.y)), kSubPixel);
    const Point root = still.middle(still.at(0, 0), inside, theme.background, theme.ink);
    EXPECT_LT(apart(root, still.at(0, 0)), kSubPixel);
    // Negative control: half a pixel off is seen.
    EXPECT_GT(apart(gripper, still.at(end.x, end.y) + Point{0.5, 0}), 3 * kSubPixel);
  }
}

// Room for the ellipses of the poses below, which have no part in the fit: what leads out of the scene fades.
const std::vector<std::string> kRoom{"camera={fit: [-2.4, -1.2, 2.6, 2.2]}"};

TEST_P(Pixels, AreOfTheThemesColoursWhereTheyAreFlat) {
  const auto exact = [](Color c) { return Pixel{c.r, c.g, c.b, 255}; };
  const Still still("rr_ellipse", "0, 90deg", GetParam(), "chain, ellipse", kRoom);
  const Theme& theme = still.theme();
  EXPECT_EQ(still.pixel(still.at(0.5, 0)), exact(theme.link[0]));
  const Still bare("rr_free", "0, 90deg", GetParam(), "chain");
  EXPECT_EQ(bare.pixel(bare.at(1, 0.4)), exact(theme.link[1]));
  EXPECT_EQ(still.pixel(still.at(1, 1)), exact(theme.ink));
  EXPECT_EQ(still.pixel({5, 5}), exact(theme.background));
  // Inside the ellipse, off its axes and the link: 16 % of its colour, rounded up or down.
  const Point inside = still.at(1, 1) + still.pixels_per_kg() * Point{0.5, -0.5};
  const Pixel fill = still.pixel(inside);
  const auto mixed = [](std::uint8_t from, std::uint8_t to) { return from + 0.16 * (double(to) - from); };
  EXPECT_NEAR(fill.r, mixed(theme.background.r, theme.ellipse.r), 1);
  EXPECT_NEAR(fill.g, mixed(theme.background.g, theme.ellipse.g), 1);
  EXPECT_NEAR(fill.b, mixed(theme.background.b, theme.ellipse.b), 1);
  EXPECT_NE(fill, exact(theme.background));  // negative control
}

TEST_P(Pixels, HaveLinksOfRrAlongTheirLines) {
  const double q1 = 0.3, q2 = 0.7;
  const Still still("rr_free", "0.3, 0.7", GetParam(), "chain");
  const Theme& theme = still.theme();
  for (const int link : {0, 1}) {
    const double angle = link == 0 ? q1 : q1 + q2;
    const Point begin = link == 0 ? Point{0, 0} : elbow(q1);
    const Point across{-std::sin(angle), -std::cos(angle)};  // in pixels, y down
    for (const double part : {0.3, 0.5, 0.7}) {
      const Point on = begin + part * elbow(angle), axis = still.at(on.x, on.y);
      // Fill between two outlines: the middle of what is not the background is the axis.
      const double reach = size::kLinkWidth * kHigh;
      const Still::OnRay width =
          still.along(axis, across, -reach, reach, theme.background, theme.link[std::size_t(link)]);
      const Still::OnRay inner = still.along(axis, across, -0.15 * reach, 0.15 * reach, theme.background,
                                             theme.link[std::size_t(link)]);
      EXPECT_NEAR(inner.length, 0.3 * reach, 0.01) << "flat fill along the axis";
      EXPECT_NEAR(width.middle, 0, kSubPixel) << link << " at " << part;
      // Negative control.
      const Still::OnRay moved = still.along(axis + 0.5 * across, across, -reach, reach, theme.background,
                                             theme.link[std::size_t(link)]);
      EXPECT_GT(std::abs(moved.middle), 3 * kSubPixel);
    }
  }
}

TEST_P(Pixels, HaveTheGripperOfPpWhereItsCoordinatesSay) {
  for (const auto& [x, y] : {std::pair{0.4, 0.25}, {-0.3, 0.6}}) {
    const Still still("pp_free", std::to_string(x) + ", " + std::to_string(y), GetParam(), "chain");
    const Theme& theme = still.theme();
    const Point gripper =
        still.middle(still.at(x, y), 0.6 * size::kEndEffector * kHigh, theme.link[1], theme.ink);
    EXPECT_LT(apart(gripper, still.at(x, y)), kSubPixel);
    EXPECT_GT(apart(gripper, still.at(x + 1 / still.pixels_per_metre(), y)),
              0.5);  // negative control: a pixel on
  }
}

// Lambda of an RR with unit links and masses at its ends, q1 = 0: at q2 = 90 deg diag(1, 2); at 150 deg it is
// [[4, -sqrt 3], [-sqrt 3, 2]], with 5 and 1 along (-sqrt 3, 1) / 2 and (1, sqrt 3) / 2.
struct KnownEllipse {
  double q2, angle;      // rad: of the first axis
  double first, second;  // kg
};

TEST_P(Pixels, HaveTheAxesOfTheEllipseWhereTheMassMatrixSays) {
  constexpr double kDegree = std::numbers::pi / 180;
  for (const KnownEllipse& known :
       {KnownEllipse{90 * kDegree, 0, 1, 2}, {150 * kDegree, 150 * kDegree, 5, 1}}) {
    const Still still("rr_ellipse", "0, " + std::to_string(known.q2 / kDegree) + "deg", GetParam(),
                      "ellipse", kRoom);
    const Theme& theme = still.theme();
    const Point end = tip(0, known.q2), center = still.at(end.x, end.y);
    const double line = size::kEllipseLine * kHigh;
    int axes_seen = 0, curve_seen = 0;
    for (const int axis : {0, 1, 2, 3}) {
      const double angle = known.angle + axis * std::numbers::pi / 2;
      const Point direction{std::cos(angle), -std::sin(angle)};
      const double radius = still.pixels_per_kg() * (axis % 2 == 0 ? known.first : known.second);
      if (!still.shows(center + radius * direction, 2 * line)) continue;
      ++axes_seen;
      // From the curve's middle outward there is half of its line, whatever lies inside.
      const Still::OnRay outside =
          still.along(center, direction, radius, radius + 2 * line, theme.background, theme.ellipse);
      EXPECT_NEAR(outside.length, line / 2, kSubPixel) << known.q2 << " axis " << axis;
      // Negative control: an axis a hundredth longer would be seen.
      const Still::OnRay longer =
          still.along(center, direction, 1.01 * radius, radius + 2 * line, theme.background, theme.ellipse);
      EXPECT_GT(std::abs(longer.length - line / 2), kSubPixel);
    }
    // Between the axes the curve is where the ellipse's equation has it.
    for (const double off : {-2.6, -2.1, -1.0, -0.5, 0.5, 1.0, 2.1, 2.6}) {
      const double c = std::cos(off), s = std::sin(off), a = known.first, b = known.second;
      const double radius = still.pixels_per_kg() / std::hypot(c / a, s / b), angle = known.angle + off;
      const Point direction{std::cos(angle), -std::sin(angle)};
      if (!still.shows(center + radius * direction, 3 * line)) continue;
      ++curve_seen;
      // The ray meets the line at this angle to its normal, so the line is longer along it.
      const double along = (c * c / (a * a) + s * s / (b * b)) / std::hypot(c / (a * a), s / (b * b));
      const Still::OnRay outside =
          still.along(center, direction, radius, radius + 3 * line / along, theme.background, theme.ellipse);
      EXPECT_NEAR(outside.length * along, line / 2, kOblique) << known.q2 << " off " << off;
    }
    EXPECT_GE(axes_seen, 2);
    EXPECT_GE(curve_seen, 3);
  }
}

}  // namespace
}  // namespace chainreel
