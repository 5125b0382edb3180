// Oracle: RR with unit links and masses at theta = (0, 150 deg): Lambda = [[4, -sqrt 3], [-sqrt 3, 2]], eigenvalues 5
// and 1; Lambda_inv is its inverse, [[2, sqrt 3], [sqrt 3, 4]] / 5.
#include "draw/layers/ellipse.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "draw/chains.hpp"
#include "draw/shapes.hpp"

namespace chainreel {
namespace {

constexpr double kPerDegree = std::numbers::pi / 180;
constexpr double kPerKg = 0.05;
const Point kCenter{0.8, 0.5};

struct DrawnBelt {
  std::vector<MassAxis> axes;
  Picture picture;

  DrawnBelt(const std::vector<double>& q, EllipseReading reading, double per_unit = kPerKg) {
    const Chain chain = test::model("rr");
    Workspace ws(chain);
    axes = mass_axes(effective_mass_of(chain, ws, q, chain.end_effector, Task::linear));
    draw(reading, per_unit, {});
  }
  DrawnBelt(std::vector<MassAxis> of, const Camera& camera, double per_unit) : axes(std::move(of)) {
    draw(EllipseReading::belt, per_unit, camera);
  }

  void draw(EllipseReading reading, double per_unit, const Camera& camera) {
    draw_mass_ellipse(picture, axes, kCenter, camera,
                      {&light_theme(), &fonts(), 1, per_unit, {0.045, 0.11, 1.73, 0.87}, reading}, -1);
  }
};

std::vector<TrailPoint> outline_of(const DrawnBelt& drawn) {
  return test::all_of<Trail>(drawn.picture).at(0).points;
}

const std::vector<double> kFolded{0, 150 * kPerDegree};

// 1 / (u^T Lambda_inv u) from the closed form.
double felt(Point u) {
  return 5 / (2 * u.x * u.x + 2 * std::sqrt(3.0) * u.x * u.y + 4 * u.y * u.y);
}
// How far the ellipse of the semi-axes 5 and 1 reaches along u.
double ellipse_radius(Point u) {
  const double s = std::sqrt(3.0) / 2, major = -s * u.x + 0.5 * u.y, minor = 0.5 * u.x + s * u.y;
  return 1 / std::sqrt(major * major / 25 + minor * minor);
}

TEST(Belt, IsTheMassFeltAlongEachDirection) {
  const DrawnBelt drawn(kFolded, EllipseReading::belt);
  const auto outlines = test::all_of<Trail>(drawn.picture);
  ASSERT_EQ(outlines.size(), 1u);
  ASSERT_GT(outlines[0].points.size(), 40u);
  for (const TrailPoint& point : outlines[0].points) {
    const Point r = point.p - kCenter, u = (1 / test::length(r)) * r;
    // Some hundred roundings of numbers up to 5, and a division.
    EXPECT_NEAR(test::length(r), kPerKg * felt(u), 1e-12);
    EXPECT_EQ(point.alpha, 1);
  }
}

TEST(Belt, LiesOutsideTheEllipseAndTouchesItAtTheAxes) {
  const DrawnBelt drawn(kFolded, EllipseReading::belt);
  double nearest = 10, farthest = 0, ratio_between = 0;
  for (const TrailPoint& point : outline_of(drawn)) {
    const Point r = point.p - kCenter, u = (1 / test::length(r)) * r;
    const double ratio = test::length(r) / (kPerKg * ellipse_radius(u));
    EXPECT_GE(ratio, 1 - 1e-12);
    ratio_between = std::max(ratio_between, ratio);
    nearest = std::min(nearest, test::length(r));
    farthest = std::max(farthest, test::length(r));
  }
  EXPECT_NEAR(nearest, 1 * kPerKg, 1e-12);
  EXPECT_NEAR(farthest, 5 * kPerKg, 1e-12);
  // Clearly another curve: the largest ratio is (1 + 5) / (2 sqrt 5), by Kantorovich's inequality.
  EXPECT_NEAR(ratio_between, 6 / (2 * std::sqrt(5.0)), 1e-3);
}

// Negative control: what the test above measures is 1 for the ellipse itself.
TEST(Belt, IsNotTheEllipse) {
  const Ellipse e = test::all_of<Ellipse>(DrawnBelt(kFolded, EllipseReading::mass).picture).at(0);
  const Point p = std::sqrt(0.5) * (e.u + e.v), u = (1 / test::length(p)) * p;
  EXPECT_NEAR(test::length(p), kPerKg * ellipse_radius(u), 1e-12);
  EXPECT_LT(test::length(p), 0.9 * kPerKg * felt(u));
}

// Beside the minor axis, lambda_min along it: half its width at the axis is less than nearby where lambda_min <
// lambda_max / 2.
TEST(Belt, HasAWaistWhereTheMinorMassIsLessThanHalfTheMajorOne) {
  const auto widest = [](double major) {
    const DrawnBelt drawn({{major, Eigen::Vector3d::UnitX()}, {1, Eigen::Vector3d::UnitY()}}, {}, 0.05);
    double most = 0;
    for (const TrailPoint& point : outline_of(drawn))
      most = std::max(most, point.p.y - kCenter.y);
    return most / 0.05;
  };
  EXPECT_NEAR(widest(1.9), 1, 1e-12);
  // The maximum of s / (c^2 / 5 + s^2) is 1 / (2 sqrt(1/5 (1 - 1/5))) = 1.25; chords lie 0.0003 H off at most.
  EXPECT_NEAR(widest(5), 1.25, 0.0003 / 0.05);
}

TEST(Belt, IsFilledOnceEverywhereInside) {
  const DrawnBelt drawn(kFolded, EllipseReading::belt);
  double area = 0;
  for (const Polygon& piece : test::all_of<Polygon>(drawn.picture)) {
    double twice = 0;
    for (int i = 0; i < piece.count; ++i) {
      const Point a = piece.corners[std::size_t(i)], b = piece.corners[std::size_t((i + 1) % piece.count)];
      twice += a.x * b.y - a.y * b.x;
    }
    area += std::abs(twice) / 2;
    EXPECT_NEAR(piece.paint.fill.a, 0.16, 1e-12);
  }
  // Half the integral of 1 / (c^2 / 5 + s^2)^2 over a turn is pi (5 + 1) sqrt(5) / 2; chords cut off below 1 %.
  const double exact = std::numbers::pi * 6 * std::sqrt(5.0) / 2 * kPerKg * kPerKg;
  EXPECT_NEAR(area, exact, 0.01 * exact);
}

TEST(Belt, IsOpenAtASingularPose) {
  const DrawnBelt drawn({0, 0}, EllipseReading::belt);
  EXPECT_EQ(test::words_of(drawn.picture), "\u221E\u221E");
  EXPECT_TRUE(test::all_finite(drawn.picture));
  const auto outlines = test::all_of<Trail>(drawn.picture);
  ASSERT_EQ(outlines.size(), 2u);
  for (const Trail& outline : outlines) {
    // The mass across is 1 kg: 1 / (1 sin^2 a) along the direction a.
    for (const TrailPoint& point : outline.points) {
      const Point r = point.p - kCenter;
      const double s = r.y / test::length(r);
      if (test::length(r) < 1) {
        EXPECT_NEAR(test::length(r) * s * s, kPerKg, 2 * 0.0003);
      }
    }
    EXPECT_EQ(outline.points.front().alpha, 0);
    EXPECT_EQ(outline.points.back().alpha, 0);
  }
}

// A surface of revolution about an axis across the line of sight is seen as the curve that turns.
TEST(Belt, InSpaceHasTheSilhouetteOfItsSurface) {
  const std::vector<MassAxis> axes{
      {5, Eigen::Vector3d::UnitX()}, {1, Eigen::Vector3d::UnitY()}, {1, Eigen::Vector3d::UnitZ()}};
  const DrawnBelt drawn(axes, {}, 0.05);
  const auto outlines = test::all_of<Trail>(drawn.picture);
  ASSERT_EQ(outlines.size(), 4u);  // the silhouette and three principal belts
  for (const TrailPoint& point : outlines[0].points) {
    const Point r = point.p - kCenter;
    const double c = r.x / test::length(r), s = r.y / test::length(r);
    EXPECT_NEAR(test::length(r), 0.05 / (c * c / 5 + s * s), 1e-12);
  }
  // Along the axis of revolution, and across it where the bulge of 1.25 kg is turned towards the camera.
  double along = 0, across = 0;
  for (const TrailPoint& point : outlines[0].points) {
    along = std::max(along, std::abs(point.p.x - kCenter.x));
    across = std::max(across, std::abs(point.p.y - kCenter.y));
  }
  EXPECT_NEAR(along, 5 * 0.05, 1e-12);
  EXPECT_NEAR(across, 1.25 * 0.05, 1e-4);
}

TEST(EnergyEllipse, HasSemiAxesOfOneOverTheRoots) {
  const Ellipse e = test::all_of<Ellipse>(DrawnBelt(kFolded, EllipseReading::energy).picture).at(0);
  EXPECT_NEAR(test::length(e.u), kPerKg / 1, 1e-12);
  EXPECT_NEAR(test::length(e.v), kPerKg / std::sqrt(5.0), 1e-12);
  // The long one lies where mass is least: along (1, sqrt 3) / 2.
  EXPECT_NEAR(std::abs(e.u.x * 0.5 + e.u.y * std::sqrt(3.0) / 2), kPerKg, 1e-12);
}

TEST(EnergyEllipse, IsASegmentAtASingularPose) {
  const DrawnBelt drawn({0, 0}, EllipseReading::energy);
  EXPECT_TRUE(test::all_of<Ellipse>(drawn.picture).empty());
  EXPECT_EQ(test::words_of(drawn.picture), "");
  const auto lines = test::all_of<Capsule>(drawn.picture);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(test::distance(lines[0].a, lines[0].b), 2 * kPerKg, 1e-12);
  EXPECT_NEAR(lines[0].a.x, kCenter.x, 1e-12);
}

TEST(Readings, AreNamedAndHaveTheirUnits) {
  EXPECT_THAT(ellipse_legend(EllipseReading::mass), testing::HasSubstr("mass ellipse"));
  EXPECT_THAT(ellipse_legend(EllipseReading::energy), testing::HasSubstr("energy ellipse"));
  EXPECT_THAT(ellipse_legend(EllipseReading::belt), testing::HasSubstr("belt"));
  EXPECT_EQ(ellipse_scale({2.1}, 0.1, EllipseReading::belt).label(), "2 kg");
  EXPECT_EQ(ellipse_scale({0.5}, 0.1, EllipseReading::energy).label(), "0.5 m/s");
  for (const EllipseReading reading : {EllipseReading::mass, EllipseReading::energy, EllipseReading::belt})
    EXPECT_EQ(value_named<EllipseReading>(to_string(reading)), reading);
}

}  // namespace
}  // namespace chainreel
