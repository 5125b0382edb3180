// The oracle is the closed form of RR with L1 = L2 = 1 m, m1 = m2 = 1 kg: at theta = (0, 90 deg) Lambda =
// diag(1, 2), at (0, 150 deg) Lambda = [[4, -sqrt 3], [-sqrt 3, 2]], with eigenvalues 5 and 1 along (-sqrt 3,
// 1) / 2 and (1, sqrt 3) / 2.
#include "draw/layers/ellipse.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "core/format.hpp"
#include "draw/chains.hpp"
#include "draw/film/film.hpp"
#include "draw/layers/body_obstacles.hpp"
#include "draw/layers/fading.hpp"
#include "draw/layers/ellipsoid.hpp"
#include "draw/page/mark_labels.hpp"
#include "draw/shapes.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// M and J of unit links, an inverse and an eigenproblem: some hundred roundings of numbers up to 5.
constexpr double kEllipseRoundOff = 1e-12;

struct DrawnEllipse {
  std::vector<MassAxis> axes;
  Picture picture;
  EllipseStyle style;
  Camera camera;
  Point center{0.8, 0.5};

  explicit DrawnEllipse(const std::vector<double>& q, double per_kg = 0.05, Point at = {0.8, 0.5})
      : center(at) {
    const Chain chain = test::model("rr");
    Workspace ws(chain);
    axes = mass_axes(effective_mass_of(chain, ws, q, chain.end_effector, Task::linear));
    style = {&light_theme(), &fonts(), 1, per_kg, {0.045, 0.11, 1.73, 0.87}};
    draw_mass_ellipse(picture, axes, center, camera, style, -1);
  }

  std::string words() const { return test::words_of(picture); }
  // Lines along the open direction: fading at one end.
  std::vector<Capsule> fading() const {
    return test::all_of<Capsule>(picture, [](const Capsule& c) { return c.alpha_b == 0; });
  }
};

TEST(Ellipse, HasTheEigenvaluesOfLambdaAsSemiAxes) {
  const DrawnEllipse bent({0, 150 * kDegree});
  const auto ellipses = test::all_of<Ellipse>(bent.picture);
  ASSERT_EQ(ellipses.size(), 1u);
  const Ellipse& e = ellipses[0];
  EXPECT_LT(test::distance(e.center, bent.center), kEllipseRoundOff);
  EXPECT_NEAR(test::length(e.u), 5 * 0.05, kEllipseRoundOff);
  EXPECT_NEAR(test::length(e.v), 1 * 0.05, kEllipseRoundOff);
  const double s = std::sqrt(3.0) / 2;
  EXPECT_NEAR(std::abs(e.u.x * -s + e.u.y * 0.5), 5 * 0.05, kEllipseRoundOff);
  EXPECT_NEAR(std::abs(e.v.x * 0.5 + e.v.y * s), 1 * 0.05, kEllipseRoundOff);
  EXPECT_EQ(e.paint.stroke_width, size::kEllipseLine);
  EXPECT_NEAR(e.paint.fill.a, 0.16, 1e-12);
  EXPECT_EQ(bent.words(), "");
}

// Negative control: another pose has another ellipse, with the axes of its own Lambda = diag(1, 2).
TEST(Ellipse, FollowsThePose) {
  const Ellipse e = test::all_of<Ellipse>(DrawnEllipse({0, 90 * kDegree}).picture).at(0);
  EXPECT_NEAR(std::abs(e.u.y), 2 * 0.05, kEllipseRoundOff);
  EXPECT_NEAR(std::abs(e.v.x), 1 * 0.05, kEllipseRoundOff);
  EXPECT_GT(std::abs(test::length(e.u) - 5 * 0.05), 0.1);
}

TEST(Ellipse, ShowsTheMajorAxisSolidAndTheMinorOneDashed) {
  const DrawnEllipse bent({0, 150 * kDegree});
  const auto lines = test::all_of<Capsule>(bent.picture);
  double longest = 0, minor = 0;
  for (const Capsule& line : lines) {
    EXPECT_DOUBLE_EQ(2 * line.radius, size::kEllipseAxis);
    longest = std::max(longest, test::distance(line.a, line.b));
    if (test::distance(line.a, line.b) < 0.1) minor += test::distance(line.a, line.b);
  }
  EXPECT_NEAR(longest, 2 * 5 * 0.05, kEllipseRoundOff);
  EXPECT_GT(minor, 0.4 * 2 * 0.05);
  EXPECT_LT(minor, 0.9 * 2 * 0.05);
}

TEST(Ellipse, IsAnOpenBandAtASingularPose) {
  const DrawnEllipse stretched({0, 0});
  EXPECT_TRUE(test::all_of<Ellipse>(stretched.picture).empty());
  EXPECT_EQ(stretched.words(), "\u221E\u221E");
  EXPECT_TRUE(test::all_finite(stretched.picture));
  // The mass across is 1 / (J M^-1 J^T)_yy. With J = [[0, 0], [2, 1]], M = [[5, 2], [2, 1]]: (2, 1) M^-1 (2,
  // 1)^T = 1.
  const auto lines = stretched.fading();
  ASSERT_EQ(lines.size(), 4u);
  for (const Capsule& line : lines) {
    EXPECT_NEAR(std::abs(line.a.y - 0.5), 1 * 0.05, kEllipseRoundOff);
    EXPECT_NEAR(line.a.y, line.b.y, kEllipseRoundOff);
    EXPECT_EQ(line.alpha_a, 1);
    EXPECT_NEAR(test::distance(line.a, line.b), size::kEllipseFade, kEllipseRoundOff);
    EXPECT_NEAR(std::min(std::abs(line.b.x - stretched.style.scene.x0),
                         std::abs(line.b.x - stretched.style.scene.x1)),
                0, kEllipseRoundOff);
  }
}

TEST(Ellipse, FillsTheBandBetweenItsLinesAndFadesItBeforeTheEdge) {
  const DrawnEllipse stretched({0.6, 0});
  const Point along{std::cos(0.6), std::sin(0.6)}, across{-along.y, along.x};
  const auto bands = test::all_of<Polygon>(stretched.picture);
  ASSERT_EQ(bands.size(), 1u);
  const Polygon& band = bands[0];
  EXPECT_NEAR(band.paint.fill.a, 0.16, kEllipseRoundOff);
  for (int i = 0; i < band.count; ++i) {
    const Point p = band.corners[std::size_t(i)], r = p - stretched.center;
    EXPECT_LE(std::abs(r.x * across.x + r.y * across.y), 0.05 + kEllipseRoundOff);
    EXPECT_TRUE(test::is_inside(stretched.style.scene, p));
  }
  EXPECT_EQ(band.fade.opacity_at(stretched.center), 1);
  for (const int side : {-1, 1}) {
    const Point end = stretched.center + (side * way_out(stretched.style.scene, stretched.center, side * along)) * along;
    EXPECT_NEAR(band.fade.opacity_at(end), 0, kEllipseRoundOff);
  }
}

TEST(Ellipse, NearlySingularIsStillNeverANumberThatWasCut) {
  // What is left of the mobility is rounding: the band is open, and its width is the minor axis.
  const DrawnEllipse nearly({0, 1e-14});
  EXPECT_TRUE(test::all_of<Ellipse>(nearly.picture).empty());
  EXPECT_EQ(nearly.words(), "\u221E\u221E");
  EXPECT_EQ(DrawnEllipse({0, 1e-6}).words(), "1e+12 kg1e+12 kg") << "finite";
}

// Of 4e8 kg the page shows the same curve as of 4e5 kg: of an axis of ten million pages rounding was left, ten times as wide.
TEST(Ellipse, OfAMassBeyondAllPagesIsAsLongAsOneCanSee) {
  const DrawnEllipse heavy({0, 5e-5}), light({0, 1.6e-3});
  const auto of_heavy = test::all_of<Ellipse>(heavy.picture), of_light = test::all_of<Ellipse>(light.picture);
  ASSERT_FALSE(of_heavy.empty());
  ASSERT_FALSE(of_light.empty());
  EXPECT_NEAR(norm(of_heavy[0].u), norm(of_light[0].u), 1e-6);
  EXPECT_NEAR(norm(of_heavy[0].v), norm(of_light[0].v), 1e-6);
  EXPECT_EQ(heavy.words().find("\u221E"), std::string::npos) << heavy.words();
}

// RR near its stretched pose, but regular: of Lambda_inv the smaller eigenvalue is 1e-4 of the larger one or
// more.
TEST(Ellipse, HasNoInfinitySignWhereJIsRegular) {
  for (const EllipseReading reading : {EllipseReading::mass, EllipseReading::belt})
    for (const double angle : {2.0, 5.0, 20.0, 178.0}) {
      DrawnEllipse regular({0.3, angle * kDegree}, 0.3);
      regular.style.reading = reading;
      regular.picture = {};
      draw_mass_ellipse(regular.picture, regular.axes, regular.center, regular.camera, regular.style, -1);
      ASSERT_TRUE(regular.axes[0].mass);
      for (const Ellipse& e : test::all_of<Ellipse>(regular.picture))
        EXPECT_TRUE(e.fade.any()) << "it is too large for the scene";
      EXPECT_TRUE(test::all_finite(regular.picture));
      // Its mass, at both ends of the axis that is cut.
      const std::string mass = format_significant(*regular.axes[0].mass, 3) + " kg";
      EXPECT_EQ(regular.words(), mass + mass) << angle;
      // The curve fades: nothing of it is there at the edge that the axis leaves through.
      double least = 1;
      for (const Trail& trail : test::all_of<Trail>(regular.picture))
        for (const TrailPoint& point : trail.points) {
          EXPECT_TRUE(test::is_inside(regular.style.scene, point.p, 1e-9));
          least = std::min(least, point.alpha);
        }
      EXPECT_LT(least, 1e-6);
    }
}

// As the axis grows beyond the edge, the curve fades over 0.03 H more than it leads out, so that its tip is never cut flat, and the mass comes
// in gradually: between two frames of a film nothing flashes.
TEST(Ellipse, FadesGraduallyAsItOutgrowsItsScene) {
  const Point middle{0.8875, 0.5};  // 0.8425 from both edges
  for (const double excess : {0.001, 0.01, 0.05, 0.3}) {
    const std::vector<MassAxis> axes{{1, Eigen::Vector3d::UnitX()}, {0.1, Eigen::Vector3d::UnitY()}};
    const EllipseStyle style{&light_theme(), &fonts(), 1, 0.8425 + excess, {0.045, 0.11, 1.73, 0.87}};
    Picture picture;
    draw_mass_ellipse(picture, axes, middle, {}, style, -1);
    const double stretch = std::min(excess + 0.03, size::kEllipseFade);
    const auto ellipses = test::all_of<Ellipse>(picture);
    ASSERT_EQ(ellipses.size(), 1u);
    EXPECT_EQ(ellipses[0].paint.stroke_width, size::kEllipseLine);
    for (const double inside : {0.0, 0.5, 1.0, 1.5})
      for (const double x : {style.scene.x0 + inside * stretch, style.scene.x1 - inside * stretch})
        EXPECT_NEAR(ellipses[0].fade.opacity_at({x, 0.5}), std::min(inside, 1.0), 1e-9);
    const auto words = test::all_of<GlyphRun>(picture);
    ASSERT_EQ(words.size(), 2u);
    EXPECT_EQ(words[0].text, "1.00 kg");
    EXPECT_NEAR(words[0].color.a, std::min(1.0, excess / 0.02), 1e-9);
  }
  // Inside it has no number, and farther from the edge it is whole.
  Picture whole;
  draw_mass_ellipse(whole, {{1, Eigen::Vector3d::UnitX()}, {0.1, Eigen::Vector3d::UnitY()}}, middle, {},
                    {&light_theme(), &fonts(), 1, 0.8424, {0.045, 0.11, 1.73, 0.87}}, -1);
  EXPECT_EQ(test::all_of<Ellipse>(whole).size(), 1u);
  EXPECT_EQ(test::words_of(whole), "");
}

// In films the number stands on the axis where its outer end leaves the scene, from the first frame on and without a jump; the other end decides nothing.
TEST(Ellipse, OfAFilmHasTheNumberOfACutAxisWhereItLeaves) {
  for (const double outward : {1.0, -1.0}) {
    Point before{};
    for (const double length : {0.3, 0.35, 0.45, 0.9, 5.0}) {
      // 0.37 to the lower edge, as far as the upper one.
      const Point middle{0.8, 0.49};
      MarkLabels labels;
      EllipseStyle style{&light_theme(), &fonts(), 1, length, {0.045, 0.12, 1.73, 0.86}};
      style.labels = &labels;
      style.outward = {0, outward};
      Picture picture;
      draw_mass_ellipse(picture, {{1, Eigen::Vector3d::UnitY()}, {0.1, Eigen::Vector3d::UnitX()}}, middle, {}, style, -1);
      const bool is_cut = length > 0.37;
      const auto numbers = test::all_of<GlyphRun>(picture, [](const GlyphRun& run) { return run.stroke_width == 0; });
      ASSERT_EQ(numbers.size(), is_cut ? 1u : 0u) << length;
      EXPECT_EQ(labels.words().size(), is_cut ? 1u : 2u) << "else it is a word of the plan";
      if (!is_cut) continue;
      EXPECT_EQ(numbers[0].text, "1.00 kg");
      EXPECT_GT(outward * (numbers[0].origin.y - middle.y), 0.2);
      if (length > 0.5) EXPECT_LT(norm(numbers[0].origin - before), 1e-12) << "it stays there";
      before = numbers[0].origin;
    }
  }
}

// The plan of a film follows each word by its name: two of one name changed places where an axis turned its ends round, and stood on the curve.
TEST(Ellipse, HasAWordOfItsOwnForEachAxis) {
  for (const double angle : {0.2, 1.5, 1.6, 3.0}) {
    MarkLabels labels;
    EllipseStyle style{&light_theme(), &fonts(), 1, 0.1, {0.045, 0.12, 1.73, 0.86}};
    style.labels = &labels;
    const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0);
    Picture picture;
    draw_mass_ellipse(picture, {{2, along}, {1, Eigen::Vector3d::UnitZ().cross(along)}}, {0.8, 0.5}, {}, style, -1);
    ASSERT_EQ(labels.words().size(), 2u);
    EXPECT_EQ(labels.words()[0].name, "semi-axis 1");
    EXPECT_EQ(labels.words()[0].line.runs.front().text, "2.00 kg") << angle;
    EXPECT_EQ(labels.words()[1].name, "semi-axis 2");
  }
}

// The tip near an edge: the major axis leaves there, its other end shows its length.
TEST(Ellipse, IsNowhereCutFlatWhereOneEndLeavesTheScene) {
  for (const Point tip : {Point{1.70, 0.5}, {0.06, 0.5}, {0.8, 0.12}, {0.8, 0.86}}) {
    const DrawnEllipse at_edge({0, 150 * kDegree}, 0.05, tip);
    const auto ellipses = test::all_of<Ellipse>(at_edge.picture);
    ASSERT_EQ(ellipses.size(), 1u);
    EXPECT_EQ(at_edge.words(), "");
    const Ellipse& ellipse = ellipses[0];
    const Rect& scene = at_edge.style.scene;
    double near_edge = 0;
    for (int i = 0; i < 100000; ++i) {
      const double angle = 2 * std::numbers::pi * i / 100000;
      const Point p = ellipse.center + std::cos(angle) * ellipse.u + std::sin(angle) * ellipse.v;
      const double inside = std::min({p.x - scene.x0, scene.x1 - p.x, p.y - scene.y0, scene.y1 - p.y});
      if (std::abs(inside) < 1e-4) near_edge = std::max(near_edge, ellipse.fade.opacity_at(p));
    }
    EXPECT_TRUE(ellipse.fade.any());
    // The shortest stretch here is 0.02 H: 1e-4 is 0.005 of it.
    EXPECT_LT(near_edge, 0.01) << tip.x << " " << tip.y;
  }
  // Negative control: in the middle it is whole.
  const auto middle = test::all_of<Ellipse>(DrawnEllipse({0, 150 * kDegree}).picture);
  ASSERT_EQ(middle.size(), 1u);
  EXPECT_FALSE(middle[0].fade.any());
}

// Over a chain lines have edges in the background's colour: their contrast is that with the page, whatever
// link lies below.
TEST(Ellipse, LiesBelowTheChainWithItsInsideAndOverItWithItsLines) {
  const DrawnEllipse bent({0, 150 * kDegree});
  const auto part = [&](EllipsePart which) {
    EllipseStyle style = bent.style;
    style.part = which;
    Picture picture;
    draw_mass_ellipse(picture, bent.axes, bent.center, bent.camera, style, -1);
    return picture;
  };
  const auto below = test::all_of<Ellipse>(part(EllipsePart::below)),
             above = test::all_of<Ellipse>(part(EllipsePart::above));
  ASSERT_EQ(below.size(), 1u);
  EXPECT_NEAR(below[0].paint.fill.a, 0.16, 1e-12);
  EXPECT_EQ(below[0].paint.stroke_width, 0);
  ASSERT_EQ(above.size(), 2u);
  for (const Ellipse& e : above) EXPECT_EQ(e.paint.fill.a, 0);
  EXPECT_TRUE(above[0].paint.stroke == light_theme().background);
  EXPECT_GT(above[0].paint.stroke_width, above[1].paint.stroke_width + 0.002);
  EXPECT_TRUE(above[1].paint.stroke == light_theme().ellipse);
}

// As its ratio of axes grows without bounds, the curve goes over into the open band: it keeps its width and
// its fade.
TEST(Ellipse, GoesOverIntoTheOpenBandWithoutAJump) {
  const auto outline_at = [](std::optional<double> mass) {
    const EllipseStyle style{&light_theme(), &fonts(), 1, 0.1, {0.045, 0.11, 1.73, 0.87}};
    Picture picture;
    draw_mass_ellipse(picture, {{mass, Eigen::Vector3d::UnitX()}, {1, Eigen::Vector3d::UnitY()}}, {0.8, 0.5},
                      {}, style, -1);
    double highest = 0;  // of the curve 0.6 H beside its middle, inside of what fades
    for (const Ellipse& e : test::all_of<Ellipse>(picture)) {
      const double share = 0.6 / test::length(e.u);
      highest = std::max(highest, test::length(e.v) * std::sqrt(1 - share * share));
    }
    for (const Capsule& line :
         test::all_of<Capsule>(picture, [](const Capsule& c) { return c.radius == size::kEllipseLine / 2; }))
      highest = std::max(highest, line.a.y - 0.5);
    return highest;
  };
  EXPECT_NEAR(outline_at(std::nullopt), 0.1, 1e-12);
  // x = 0.6 of a = 20 and more: sqrt(1 - (0.6 / a)^2) differs from 1 by 0.0005 and less.
  for (const double mass : {200.0, 1e4, 1e6}) EXPECT_NEAR(outline_at(mass), 0.1, 1e-4) << mass;
}

TEST(Ellipse, KeepsInfinitySignsInsideTheSceneWhereverTheTipIs) {
  for (const Point tip : {Point{0.05, 0.12}, {1.72, 0.86}, {0.8, 0.86}, {1.70, 0.5}}) {
    const DrawnEllipse stretched({0, 0}, 0.05, tip);
    int signs = 0;
    for (const GlyphRun& run : test::all_of<GlyphRun>(stretched.picture)) {
      const TextLine sign = lay_out_text(fonts(), run.text, {run.face, run.size, run.color, Align::left});
      // The run's origin is its left end.
      EXPECT_TRUE(test::is_inside(stretched.style.scene, test::shifted(sign.box, run.origin)));
      ++signs;
    }
    EXPECT_EQ(signs, 2);
  }
}

TEST(Ellipse, OfAPointThatCannotMoveIsInfiniteEverywhere) {
  EffectiveMass stuck;
  stuck.basis = {{"x", "y"}, {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()}};
  stuck.mobility = Eigen::VectorXd::Zero(2);
  stuck.directions = Eigen::MatrixXd::Identity(2, 2);
  stuck.is_infinite = {true, true};
  const auto axes = mass_axes(stuck);
  EXPECT_FALSE(axes.at(0).mass || axes.at(1).mass);
  EXPECT_FALSE(bounded_semi_axis(axes, EllipseReading::mass));
  Picture picture;
  draw_mass_ellipse(picture, axes, {0.8, 0.5}, {}, {&light_theme(), &fonts(), 1, 0.1, {0, 0, 1.7, 1}}, -1);
  EXPECT_EQ(test::words_of(picture), "\u221E\u221E");
}

TEST(Ellipse, InSpaceIsTheSilhouetteOfTheEllipsoid) {
  const std::vector<MassAxis> axes{
      {3, Eigen::Vector3d::UnitX()}, {2, Eigen::Vector3d::UnitY()}, {1, Eigen::Vector3d::UnitZ()}};
  Camera camera;  // looks along -z first
  const EllipseStyle style{&light_theme(), &fonts(), 1, 0.1, {0, 0, 1.7, 1}};
  Picture front;
  draw_mass_ellipse(front, axes, {0.8, 0.5}, camera, style, -1);
  EXPECT_NEAR(test::length(test::all_of<Ellipse>(front).at(0).u), 0.3, kEllipseRoundOff);
  EXPECT_NEAR(test::length(test::all_of<Ellipse>(front).at(0).v), 0.2, kEllipseRoundOff);
  // From 45 degrees between y and z the silhouette is sqrt((2^2 + 1^2) / 2) high.
  const double c = std::sqrt(0.5);
  camera.up = {0, c, c};
  camera.toward_viewer = {0, -c, c};
  Picture oblique;
  draw_mass_ellipse(oblique, axes, {0.8, 0.5}, camera, style, -1);
  EXPECT_NEAR(test::length(test::all_of<Ellipse>(oblique).at(0).v), 0.1 * std::sqrt(2.5), kEllipseRoundOff);
  // Its outline is drawn in space: from 0.1 sqrt(2.5) to 0.3 from the middle.
  const auto lines = test::all_of<Trail>(oblique);
  const auto outline = std::find_if(lines.begin(), lines.end(),
                                    [](const Trail& t) { return t.points[0].width == size::kEllipseLine; });
  ASSERT_NE(outline, lines.end());
  double nearest = 1, farthest = 0;
  for (const TrailPoint& point : outline->points) {
    nearest = std::min(nearest, test::distance(point.p, {0.8, 0.5}));
    farthest = std::max(farthest, test::distance(point.p, {0.8, 0.5}));
  }
  EXPECT_NEAR(farthest, 0.3, 1e-3);  // of the nearest of 128 points
  EXPECT_NEAR(nearest, 0.1 * std::sqrt(2.5), 1e-3);
  // And of the principal ellipses and axes the near halves in full, the far ones thin and dashed.
  const auto width_of = [](const Trail& t) { return t.points[0].width; };
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [&](const Trail& t) { return width_of(t) == size::kEllipseAxis; }),
            6);
  EXPECT_GT(test::all_of<Capsule>(oblique, [](const Capsule& line) { return 2 * line.radius < size::kEllipseAxis; })
                .size(),
            20u);
}

// A cube of 1 m about the tip, seen along -z, at 1 H a metre.
struct CubeAtTip {
  CubeAtTip() : cube(load_body_shapes({visual()}, MeshUp::rviz, shelf)), chain(test::model("rr")), ws(chain) {
    compute_kinematics(chain, ws, std::vector<double>{0, 0}, std::vector<double>{0, 0});
  }
  static Visual visual() {
    Visual one;
    one.size = {1, 1, 1};
    return one;
  }

  MeshShelf shelf;
  BodyShapes cube;
  Chain chain;
  Workspace ws;
};

TEST(Ellipsoid, IsHiddenWhereABodyStandsBeforeIt) {
  const CubeAtTip at_tip;
  const BodyShapes& cube = at_tip.cube;
  const Workspace& ws = at_tip.ws;
  const Hides hides = robot_hides(cube, ws, Camera{}, Eigen::Vector3d::Zero());
  EXPECT_TRUE(hides({0, 0, -2}));
  EXPECT_TRUE(hides({0.4, 0.4, 0.4})) << "inside";
  EXPECT_FALSE(hides({0, 0, 2}));
  EXPECT_FALSE(hides({0.6, 0, -2}));
  // What is hidden is drawn below the robot, and nowhere twice.
  EllipseStyle style{&light_theme(), &fonts(), 1, 1, {0, 0, 1.7, 1}};
  style.hides = hides;
  const std::vector<MassAxis> axes{{0.4, Eigen::Vector3d::UnitX()}, {0.3, Eigen::Vector3d::UnitY()}, {0.2, Eigen::Vector3d::UnitZ()}};
  const auto lines = [&](EllipsePart part) {
    style.part = part;
    Picture picture;
    draw_mass_ellipse(picture, axes, {0.8, 0.5}, {}, style, -1);
    return test::all_of<Trail>(picture).size();
  };
  EXPECT_GT(lines(EllipsePart::below), 3u);
  EXPECT_EQ(lines(EllipsePart::above), 0u) << "all of it is in the cube";
  // Over the body its outline and its axes are dashed.
  const auto dashes = [&] {
    Picture picture;
    draw_mass_ellipse(picture, axes, {0.8, 0.5}, {}, style, -1);
    return test::all_of<Capsule>(picture, [&](const Capsule& dash) { return dash.paint.fill == light_theme().ellipse; });
  };
  style.part = EllipsePart::above;
  double farthest = 0;
  for (const Capsule& dash : dashes()) farthest = std::max(farthest, test::distance(dash.a, {0.8, 0.5}));
  EXPECT_NEAR(farthest, 0.4, 0.01) << "as far as the longest semi-axis, but for a gap between dashes";
  style.hides = nullptr;
  EXPECT_GT(lines(EllipsePart::above), 3u);
  EXPECT_TRUE(dashes().empty()) << "nothing hides anything";
}

// Words keep off all that a body covers, not only off a line through it.
TEST(Ellipsoid, IsNamedBesideTheBodiesBeforeIt) {
  const CubeAtTip at_tip;
  const BodyShapes& cube = at_tip.cube;
  const Workspace& ws = at_tip.ws;
  std::vector<Obstacle> covered;
  add_silhouettes(covered, cube, ws, Camera{});
  const auto is_free = [&](Point middle) {
    // As low as the smallest word.
    const Rect word{middle.x - 0.03, middle.y - size::kTick / 2, middle.x + 0.03, middle.y + size::kTick / 2};
    return std::ranges::none_of(covered, [&](const Obstacle& one) {
      Point a = one.a, b = one.b;
      return cut_segment(word, a, b);
    });
  };
  const Point middle = Camera{}.project(Eigen::Vector3d::Zero());
  const double half = 0.5 * Camera{}.scale;
  for (double x = -0.9; x < 1; x += 0.3)
    for (double y = -0.9; y < 1; y += 0.3) EXPECT_FALSE(is_free(middle + half * Point{x, y})) << x << " " << y;
  EXPECT_TRUE(is_free(middle + Point{half + 0.04, 0}));
  EXPECT_TRUE(is_free(middle + Point{0, -half - 0.02}));
}

TEST(EllipseScale, DrawsARoundMassNearTheMedianAsTheBar) {
  EXPECT_EQ(ellipse_scale({0.9, 1.0, 40}, 0.1).bar, 1);
  EXPECT_EQ(ellipse_scale({0.013}, 0.1).bar, 0.01);
  EXPECT_EQ(ellipse_scale({1.8, 2.4, 2.2}, 0.1).bar, 2);
  EXPECT_EQ(ellipse_scale({8}, 0.1).bar, 10);
  EXPECT_EQ(ellipse_scale({300, std::numeric_limits<double>::infinity()}, 0.1).bar, 200);
  EXPECT_EQ(ellipse_scale({}, 0.1).bar, 1);
  // Whatever the median, its axis is drawn within a factor sqrt(2.5) of the bar: half way between 2 and 5.
  for (double m = 0.01; m < 100; m *= 1.1) {
    const double drawn = m * ellipse_scale({m}, 0.1).per_unit() / 0.1;
    EXPECT_LT(std::max(drawn, 1 / drawn), std::sqrt(2.5) + 1e-12) << m;
  }
}

// Four of five long axes are no longer than they may be; the bar is round, and shorter than its longest.
TEST(EllipseScale, IsBoundedByTheLongAxesToo) {
  const EllipseScale usual = ellipse_scale({0.2}, 0.1);
  EXPECT_EQ(bounded_scale(usual, {}, 0.3).per_unit(), usual.per_unit());
  EXPECT_EQ(bounded_scale(usual, {0.4, 0.5, 0.6}, 0.3).per_unit(), usual.per_unit()) << "0.6 kg is 0.3 H at 0.5 H/kg";
  const std::vector<double> longest{4.0, 4.1, 4.2, 4.3, 4.4, 30};
  const EllipseScale bounded = bounded_scale(usual, longest, 0.3);
  EXPECT_NEAR(bounded.per_unit(), 0.3 / 4.4, 1e-12);
  EXPECT_EQ(bounded.bar, 1);
  EXPECT_LE(bounded.bar_length, kLongestBar + 1e-12);
  EXPECT_NEAR(bounded.bar_length, bounded.bar * bounded.per_unit(), 1e-12);
}

// The whole clip of a nearly stretched chain, whose ellipses are five times as long as wide and more: by their width alone they
// would be longer than half of the page is high. The tip goes to the right of its base, the ellipses stand across.
TEST(EllipseLayer, KeepsLongEllipsesOnItsPage) {
  const Chain chain = test::model("rr");
  const auto q = [](double t) { return std::vector<double>{1.2 + 0.1 * t, 0.4 + 0.1 * std::sin(t)}; };
  constexpr int kFrames = 120;
  const Trajectory run = test::run_of(q, kFrames);
  Scene scene;
  scene.draw = {"chain", "ellipse"};
  const Film film(scene, chain, run, kFrames, fonts());
  std::vector<double> lengths;
  for (int k = 0; k < kFrames; k += 10) {
    const auto ellipses = test::all_of<Ellipse>(film.frame(k), [](const Ellipse& e) { return e.paint.stroke == light_theme().ellipse; });
    ASSERT_EQ(ellipses.size(), 1u);
    EXPECT_GT(test::length(ellipses[0].u), 5 * test::length(ellipses[0].v)) << "else the test says nothing";
    lengths.push_back(test::length(ellipses[0].u));
  }
  std::sort(lengths.begin(), lengths.end());
  // Twelve frames of those that decide: the 80th percentile lies between two of them.
  EXPECT_LE(lengths[8], 0.30);
  EXPECT_GE(lengths[10], 0.30) << "no smaller than they need be";
}

// Of a film: before its lines they could not be read.
TEST(Ellipsoid, HasItsNumbersOutsideOfItsSilhouette) {
  const std::vector<MassAxis> axes{{2, Eigen::Vector3d::UnitX()}, {1.5, Eigen::Vector3d::UnitZ()}, {1, Eigen::Vector3d(0.1, 1, 0.1).normalized()}};
  MarkLabels labels;
  EllipseStyle style{&light_theme(), &fonts(), 1, 0.1, {0.045, 0.11, 1.73, 0.87}};
  style.labels = &labels;
  style.hides = [](const Eigen::Vector3d&) { return false; };
  Camera camera;
  camera.right = Eigen::Vector3d(1, 0, -0.3).normalized();
  camera.toward_viewer = Eigen::Vector3d(0.3, 0, 1).normalized();
  const Point center{0.8, 0.5};
  Picture picture;
  draw_ellipsoid(picture, axes, center, camera, style, -1);
  Spread spread;
  for (const MassAxis& axis : axes) spread.add({0.1 * *axis.mass * camera.right.dot(axis.direction), 0.1 * *axis.mass * camera.up.dot(axis.direction)});
  ASSERT_EQ(labels.words().size(), 3u);
  int closed = 0;
  for (const MarkWord& word : labels.words()) {
    ASSERT_EQ(word.closed.size(), word.places.size());
    for (std::size_t p = 0; p < word.places.size(); ++p) {
      if (word.closed[p] && ++closed) continue;
      const Rect& box = word.places[p];
      for (const Point corner : {Point{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}, center_of(box)}) {
        const Point from = corner - center, way = unit(from);
        // Where the ray to it leaves the ellipse p^T S^-1 p = 1.
        const double det = spread.xx * spread.yy - spread.xy * spread.xy;
        const double inverse = (spread.yy * way.x * way.x - 2 * spread.xy * way.x * way.y + spread.xx * way.y * way.y) / det;
        EXPECT_GT(norm(from), 1 / std::sqrt(inverse));
      }
    }
    EXPECT_TRUE(std::ranges::find(word.closed, false) != word.closed.end()) << "it has a place";
  }
  EXPECT_GT(closed, 0) << "ends of axes lie before it";
}

}  // namespace
}  // namespace chainreel
