// Figures of many poses: superposed, in a row, over the workspace, and in joint space. Oracle: forward kinematics and
// eigenvectors, taken to the page by the camera that two known places of the chain give away.
#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/chains.hpp"
#include "draw/figures/caption.hpp"
#include "draw/figures/ellipse_figure.hpp"
#include "draw/figures/pose_labels.hpp"
#include "draw/figures/poses.hpp"
#include "draw/shapes.hpp"
#include "dynamics/equation_of_motion.hpp"

namespace chainreel {
namespace {

constexpr double kOneDegree = std::numbers::pi / 180;
const std::vector<std::vector<double>> kPoses{{0, 90 * kOneDegree}, {0.4, 150 * kOneDegree}, {1, 60 * kOneDegree}};

Point tip_of_rr(const std::vector<double>& q) {
  return {std::cos(q[0]) + std::cos(q[0] + q[1]), std::sin(q[0]) + std::sin(q[0] + q[1])};
}

PoseFigureOptions with_layout(const std::string& layout) {
  PoseFigureOptions options;
  options.layout = layout;
  return options;
}

// Ellipses stand at the tips: one camera takes all tips of unit links to the page, to a thousandth of a pixel at 1080.
TEST(Superposed, HasEveryEllipseAtItsTipWithItsOwnAxes) {
  const Picture picture =
      draw_ellipse_figure(TipMass(test::model("rr")), kPoses, with_layout("superposed"), fonts());
  const auto ellipses = test::all_of<Ellipse>(picture, test::is_mass_ellipse);
  ASSERT_EQ(ellipses.size(), 3u);
  const Point a = tip_of_rr(kPoses[0]), b = tip_of_rr(kPoses[1]), c = tip_of_rr(kPoses[2]);
  const double scale = test::distance(ellipses[0].center, ellipses[1].center) / test::distance(a, b);
  const Point expected = ellipses[0].center + scale * (c - a);
  EXPECT_LT(test::distance(ellipses[2].center, expected), 1e-3 / 1080);
  // Lambda = diag(1, 2) at the first pose; 5 kg along (-sqrt 3, 1) / 2, turned by 0.4 rad, at the second.
  const double per_kg = test::length(ellipses[0].v);
  EXPECT_NEAR(std::abs(ellipses[0].u.y), 2 * per_kg, 1e-12);
  EXPECT_NEAR(test::length(ellipses[1].u), 5 * per_kg, 1e-12);
  const double angle = 150 * kOneDegree + 0.4;
  EXPECT_NEAR(std::abs(ellipses[1].u.x * std::cos(angle) + ellipses[1].u.y * std::sin(angle)), 5 * per_kg, 1e-12);
}

// Seven poses along a short straight way, as a hand that starts and stops stands there: no name lies on another, and for each
// the eye finds its tip. A name is nearest to its own tip, or a line leads from it there that crosses no other.
TEST(Superposed, NamesEachPoseWhereTheEyeFindsIt) {
  PoseFigureOptions options = with_layout("superposed");
  std::vector<std::vector<double>> poses;
  const Chain chain = test::model("rr");
  for (const double x : {1.20, 1.22, 1.30, 1.42, 1.54, 1.60, 1.615}) {
    // The tip at (x, 1) by the law of cosines, links of 1 m.
    const double q2 = -std::acos((x * x + 1 - 2) / 2);
    poses.push_back({std::atan2(1, x) - q2 / 2, q2});
    options.labels.push_back("t = " + std::to_string(options.labels.size()) + " s");
  }
  const Picture picture = draw_ellipse_figure(TipMass(chain), poses, options, fonts());
  const auto ellipses = test::all_of<Ellipse>(picture, test::is_mass_ellipse);
  ASSERT_EQ(ellipses.size(), 7u);
  struct Name {
    std::size_t pose;
    Rect box;
  };
  std::vector<Name> names;
  for (const GlyphRun& run : test::all_of<GlyphRun>(picture))
    for (std::size_t i = 0; i < 7; ++i)
      if (run.stroke_width == 0 && run.text == options.labels[i])
        names.push_back({i, {run.origin.x, run.origin.y, run.origin.x + run.glyphs.back().x + 0.5 * run.size, run.origin.y + 0.7 * run.size}});
  ASSERT_EQ(names.size(), 7u) << "all of them are named";
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(test::overlap(names[i].box, names[j].box)) << i << " " << j;
  const auto leaders = test::all_of<Capsule>(picture, [](const Capsule& c) { return c.paint.fill == light_theme().ink && c.radius < 0.002; });
  const auto to_box = [](const Rect& r, Point p) {
    return test::distance(p, {std::clamp(p.x, r.x0, r.x1), std::clamp(p.y, r.y0, r.y1)});
  };
  // A tip, or an end of its ellipse.
  const auto ends_of = [&](std::size_t pose) {
    const Ellipse& e = ellipses[pose];
    return std::array<Point, 3>{e.center, e.center + e.u, e.center - e.u};
  };
  const auto way_to = [&](const Rect& box, std::size_t pose) {
    double way = HUGE_VAL;
    for (const Point end : ends_of(pose)) way = std::min(way, to_box(box, end));
    return way;
  };
  for (const Name& name : names) {
    const auto own = ends_of(name.pose);
    // Below the name stand the masses, from which a line may lead, too.
    const Rect words{name.box.x0, name.box.y0 - 0.05, name.box.x1 + 0.05, name.box.y1};
    const bool is_led = std::any_of(leaders.begin(), leaders.end(), [&](const Capsule& line) {
      return std::ranges::any_of(own, [&](Point end) { return test::distance(line.b, end) < 1e-9; }) && to_box(words, line.a) < 0.02;
    });
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < 7; ++i)
      if (i != name.pose) nearest = std::min(nearest, way_to(words, i));
    EXPECT_TRUE(is_led || way_to(words, name.pose) < 0.85 * nearest) << options.labels[name.pose];
  }
  EXPECT_GE(leaders.size(), 2u) << "else the test says nothing of lines";
}

// Where there is room no lines are needed, and what is named is not covered.
TEST(Superposed, NamesPosesFarFromOneAnotherWithoutLines) {
  const Picture picture = draw_ellipse_figure(TipMass(test::model("rr")), kPoses, with_layout("superposed"), fonts());
  EXPECT_TRUE(test::all_of<Capsule>(picture, [](const Capsule& c) { return c.paint.fill == light_theme().ink && c.radius < 0.002; }).empty());
}

// Each masses with its name, at the outer ends of ellipses that lie on one another, of which the lines alone are seen.
TEST(Superposed, TellsAllMassesWhereTheirAxesHaveNoRoom) {
  const std::vector<std::vector<double>> close{{0, 1.0}, {0.05, 1.0}, {0.1, 1.0}, {0.15, 1.0}};
  const auto filled = [](const Picture& picture) { return test::all_of<Ellipse>(picture, [](const Ellipse& e) { return e.paint.fill.a > 0 && e.paint.fill == light_theme().ellipse.faded(0.16); }).size(); };
  const auto masses = [](const Picture& picture) { return test::all_of<GlyphRun>(picture, [](const GlyphRun& run) { return run.text.ends_with(" kg") && run.text.find(", ") != std::string::npos && run.stroke_width == 0; }).size(); };
  int left_out = 0;
  const Picture crowd = draw_ellipse_figure(TipMass(test::model("rr")), close, with_layout("superposed"), fonts(), &left_out);
  EXPECT_EQ(left_out, 0);
  EXPECT_EQ(masses(crowd), close.size());
  EXPECT_EQ(filled(crowd), 0u);
  const std::vector<std::vector<double>> apart{{0, 1.5}, {3.1, 1.5}};
  const Picture two = draw_ellipse_figure(TipMass(test::model("rr")), apart, with_layout("superposed"), fonts());
  EXPECT_GE(filled(two), apart.size());
}

TEST(PoseLabels, StandOffTheLinesThatAreDrawn) {
  const Rect area{0, 0, 1.7, 1};
  const std::vector<NamedPlace> places{{{0.8, 0.5}, lay_out_text(fonts(), "t = 1 s", {Face::label, 0.028, light_theme().ink, Align::left}), {}}};
  const auto lies_on = [&](const std::vector<Obstacle>& lines) {
    const Rect box = place_names(places, {}, area, lines).front().word.box;
    return std::ranges::any_of(lines, [&](Obstacle line) { return cut_segment(box, line.a, line.b); });
  };
  // Where it would stand were there nothing, and a line across it.
  const Rect free = place_names(places, {}, area).front().word.box;
  const Point middle{(free.x0 + free.x1) / 2, (free.y0 + free.y1) / 2};
  EXPECT_FALSE(lies_on({{{middle.x - 0.3, middle.y}, {middle.x + 0.3, middle.y}, 0.001, false}}));
}

// Beside the curve of another it would be taken for that one's.
TEST(PoseLabels, StandOffTheCurvesOfOthers) {
  const Rect area{0, 0, 1.7, 1};
  const TextLine name = lay_out_text(fonts(), "t = 1 s", {Face::label, 0.028, light_theme().ink, Align::left});
  std::vector<NamedPlace> places{{{0.5, 0.5}, name, {Point{0.03, 0}, Point{0, 0.01}}}};
  const Rect alone = place_names(places, {}, area).front().word.box;
  // Of another whose curve passes by the place that it would have.
  const Point beside{(alone.x0 + alone.x1) / 2, alone.y1 + 0.018};
  places.push_back({beside, name, {Point{0.1, 0}, Point{0, 0.003}}});
  const Rect box = place_names(places, {}, area).front().word.box;
  EXPECT_GT(std::max({box.y0 - beside.y, beside.y - box.y1, box.x0 - beside.x - 0.1, beside.x - 0.1 - box.x1}), 0.02);
}

// Both lines of a name that stands left of its pose end where its leader begins, which met a blank.
TEST(Superposed, NamesLeftOfTheirPosesEndAtTheirLines) {
  const std::vector<std::vector<double>> close{{2.9, 1.0}, {2.95, 1.0}, {3.0, 1.0}, {3.05, 1.0}};
  PoseFigureOptions options = with_layout("superposed");
  for (const char* name : {"a", "b", "c", "d"}) options.labels.push_back(name);
  const Picture picture = draw_ellipse_figure(TipMass(test::model("rr")), close, options, fonts());
  const auto runs = test::all_of<GlyphRun>(picture, [](const GlyphRun& run) { return run.stroke_width == 0 && !run.glyphs.empty(); });
  std::size_t at_right = 0;
  for (const GlyphRun& name : runs)
    for (const GlyphRun& masses : runs)
      if (name.text.size() == 1 && masses.text.ends_with(" kg") && std::abs(name.origin.y - masses.origin.y - 1.35 * name.size) < 1e-9) at_right += name.origin.x > masses.origin.x + 0.5 * masses.glyphs.back().x;
  EXPECT_GE(at_right, 1u);
}

// Very many, on one another, or none at all: no name covers another, and it comes to an end.
TEST(PoseLabels, StandOffOneAnotherInAnyCrowd) {
  const Rect area{0, 0, 1.7, 1};
  for (const std::size_t count : {0u, 1u, 2u, 40u, 200u}) {
    std::vector<NamedPlace> places;
    for (std::size_t i = 0; i < count; ++i)
      places.push_back({{0.8 + 1e-4 * double(i % 7), 0.5}, lay_out_text(fonts(), "t = 1 s", {Face::label, 0.028, light_theme().ink, Align::left}), {}});
    const auto placed = place_names(places, {}, area);
    ASSERT_EQ(placed.size(), count);
    std::size_t standing = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!(placed[i].word.opacity > 0)) continue;
      ++standing;
      EXPECT_TRUE(test::is_inside(area, placed[i].word.box));
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_FALSE(placed[j].word.opacity > 0 && test::overlap(placed[i].word.box, placed[j].word.box));
    }
    EXPECT_GE(standing, std::min<std::size_t>(count, 8));
  }
}

TEST(Superposed, ShowsChainsAsOnionSkinsAndEllipsesInFull) {
  const Picture picture =
      draw_ellipse_figure(TipMass(test::model("rr")), kPoses, with_layout("superposed"), fonts());
  const auto links = test::all_of<Capsule>(
      picture, [](const Capsule& c) { return c.paint.stroke_width == size::kLinkOutline && c.paint.fill.a == 1; });
  ASSERT_EQ(links.size(), 6u);
  for (const Capsule& link : links) EXPECT_FALSE(link.paint.fill == light_theme().link[0]);
  for (const Ellipse& e : test::all_of<Ellipse>(picture, test::is_mass_ellipse))
    EXPECT_TRUE(e.paint.stroke == light_theme().ellipse);
}

TEST(EllipseFigure, PutsAllPosesIntoOneRowWhereItIsToldTo) {
  const std::vector<std::vector<double>> six(6, kPoses[0]);
  const auto rows = [&](const std::string& layout) {
    std::vector<double> bottoms;
    for (const Rect& r : draw_ellipse_figure(TipMass(test::model("rr")), six, with_layout(layout), fonts()).clips)
      if (std::none_of(bottoms.begin(), bottoms.end(), [&](double y) { return std::abs(y - r.y0) < 1e-9; }))
        bottoms.push_back(r.y0);
    return bottoms.size();
  };
  EXPECT_EQ(rows("row"), 1u);
  EXPECT_GE(rows("grid"), 2u);
}

// Of five poses and more each has one line, and its picture takes 70 % of its cell and more.
TEST(EllipseFigure, OfManyPosesIsMostlyPictures) {
  for (const char* model : {"rr", "rrr"})
    for (const std::size_t count : {5u, 9u, 20u}) {
      std::vector<std::vector<double>> poses;
      for (std::size_t i = 0; i < count; ++i) {
        poses.push_back({0.1, 0.4 + 2.2 * double(i) / double(count)});
        if (model == std::string("rrr")) poses.back().push_back(0.5);
      }
      const PoseFigureOptions options = with_layout("grid");
      const Picture picture = draw_ellipse_figure(TipMass(test::model(model)), poses, options, fonts());
      ASSERT_EQ(picture.clips.size(), count);
      const double caption = caption_line_height(options.text_scale), height = picture.clips[0].height();
      EXPECT_GE(height / (height + caption), 0.7) << model << count;
      // No brackets of matrices; each pose is named.
      const std::string words = test::words_of(picture);
      std::size_t named = 0;
      for (std::size_t at = words.find('='); at != std::string::npos; at = words.find('=', at + 1)) ++named;
      EXPECT_GE(named, count);
    }
  // Negative control: three above one another have their matrices, which take a third.
  PoseFigureOptions column = with_layout("grid");
  column.across = 1;
  column.width = 1080;
  const Picture three = draw_ellipse_figure(TipMass(test::model("rr")), std::vector<std::vector<double>>(3, {0, 1}), column, fonts());
  EXPECT_LT(three.clips[0].height() / (three.clips[0].height() + caption_height(2, 1)), 0.75);
}

// Wide cells have their words beside the pictures, which are as high as the cells then.
TEST(EllipseFigure, HasPosesAndMatricesBesidePicturesThatAreWide) {
  const Picture four = draw_ellipse_figure(TipMass(test::model("rr")), std::vector<std::vector<double>>(4, {0, 1}), {}, fonts());
  const auto frames = test::all_of<Polygon>(four, [](const Polygon& p) { return p.paint.stroke == light_theme().rule; });
  ASSERT_EQ(frames.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(frames[i].corners[2].y - frames[i].corners[0].y, four.clips[i].height(), 1e-12);
    EXPECT_GT(frames[i].corners[2].x - frames[i].corners[0].x, 1.3 * four.clips[i].width());
  }
}

// A pose whose mass is far above those of the others is cut and does not make them small; one that is but larger is seen whole.
TEST(EllipseFigure, OneFarHeavierPoseDoesNotMakeTheOthersSmall) {
  const auto largest = [](double degrees) {
    const Picture picture = draw_ellipse_figure(TipMass(test::model("rr")), {{0, degrees * kOneDegree}, {0, 60 * kOneDegree}, {0, 90 * kOneDegree}, {0, 150 * kOneDegree}}, {}, fonts());
    double length = 0;  // of the pose at 90 degrees, 2 kg, beside its link's
    for (const Ellipse& e : test::all_of<Ellipse>(picture, test::is_mass_ellipse))
      if (std::abs(test::length(e.u) - 2 * test::length(e.v)) < 1e-9) length = test::length(e.u);
    return length;
  };
  EXPECT_GT(largest(15), 0.7 * largest(25)) << "15.9 kg beside 6.6 kg: in the ratio of the masses it would be 0.42";
}

// The number of each axis is nearer to an end of that axis than to one of the other, or a line leads there: whatever the pose.
TEST(EllipseFigure, NumbersStandBesideTheAxisThatTheyAreOf) {
  const Chain chain = test::model("rr");
  int looked_at = 0, tied = 0;
  for (int i = 0; i < 30; ++i) {
    const std::vector<double> q{0.3 * i, 0.25 + 0.09 * i};
    for (const int width : {1920, 900}) {
      PoseFigureOptions options;
      options.width = width;
      const Picture picture = draw_ellipse_figure(TipMass(chain), {q, {0.1, 1.3}}, options, fonts());
      const auto ellipses = test::all_of<Ellipse>(picture, test::is_mass_ellipse);
      ASSERT_FALSE(ellipses.empty());
      const Ellipse& own = ellipses.front();
      const EffectiveMass mass = TipMass(chain).at(*std::make_unique<Workspace>(chain), q);
      const std::vector<MassAxis> axes = mass_axes(mass);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::string words = format_digits(*axes[axis].mass, 3) + " kg";
        const Point half = axis == 0 ? own.u : own.v, other = axis == 0 ? own.v : own.u;
        // Of the first panel.
        const auto runs = test::all_of<GlyphRun>(picture, [&](const GlyphRun& run) { return run.text == words && run.origin.x < picture.clips[0].x1; });
        if (runs.empty()) continue;
        const auto ties = test::all_of<Capsule>(picture, [&](const Capsule& c) {
          const auto ends_at = [&](Point p) { return std::min(test::distance(c.b, own.center + p), test::distance(c.b, own.center - p)); };
          return c.paint.fill == light_theme().ellipse && ends_at(half) < 0.012;
        });
        ++looked_at;
        if (!ties.empty()) {
          ++tied;
          continue;
        }
        const TextLine line = lay_out_text(fonts(), words, {Face::label, scaled(size::kTick, 1), {}, Align::left});
        const Point at = runs.front().origin;
        const Rect box{at.x, at.y + line.box.y0, at.x + line.box.width(), at.y + line.box.y1};
        const auto to_ends = [&](Point v) {
          const Point a = own.center + v, b = own.center - v;
          return std::min(test::distance(nearest_in(box, a), a), test::distance(nearest_in(box, b), b));
        };
        EXPECT_LT(to_ends(half), to_ends(other)) << i << " " << width << " " << words;
      }
    }
  }
  EXPECT_GT(looked_at, 80);
  EXPECT_GT(tied, 5);
}

// A stretched chain among others has no part in the scale.
TEST(EllipseFigure, HasItsScaleFromTheEllipsesThatEnd) {
  const Chain chain = test::model("rr");
  Workspace ws(chain);
  const auto scale_of = [&](const std::vector<std::vector<double>>& poses) {
    return scale_for(poses_of(TipMass(chain), poses, {}, ws), 0.5, EllipseReading::mass).per_unit();
  };
  const std::vector<std::vector<double>> bent{{0, 1.2}, {0, 1.5}, {0, 2.0}};
  std::vector<std::vector<double>> with_singular = bent;
  with_singular.insert(with_singular.end(), 5, {0, 0});
  EXPECT_EQ(scale_of(with_singular), scale_of(bent));
  EXPECT_TRUE(std::isfinite(scale_of({{0, 0}})));
}

TEST(EllipseFigure, LettersItsPanelsWhereItIsToldTo) {
  PoseFigureOptions options;
  const std::vector<std::vector<double>> poses(28, {0, 1});
  options.letters = true;
  const std::string words = test::words_of(draw_ellipse_figure(TipMass(test::model("rr")), poses, options, fonts()));
  for (const char* letter : {"(a)", "(b)", "(z)", "(aa)", "(ab)"}) EXPECT_THAT(words, testing::HasSubstr(letter));
  options.letters = false;
  EXPECT_THAT(test::words_of(draw_ellipse_figure(TipMass(test::model("rr")), poses, options, fonts())),
              testing::Not(testing::HasSubstr("(a)")));
}

// Far from singular poses the ratio of largest and smallest mass is below 32: then all ellipses are whole on every page.
TEST(EllipseFigure, HasWholeEllipsesOfAllOrdinaryPosesOnEveryPage) {
  struct Case {
    std::string model;
    std::vector<std::vector<double>> poses;
  };
  const std::vector<Case> cases{
      {"rrr", {{0, 0.6, 0.6}, {0.3, 2.2, 0.4}, {1, 0.4, -1.8}, {0.2, 2.5, -2.5}}},
      {"rr", {{0, 15 * kOneDegree}, {0.4, 150 * kOneDegree}, {1, 60 * kOneDegree}, {0, 3 * kOneDegree}}},
  };
  for (const auto& [model, poses] : cases)
    for (const auto& [width, height] : {std::pair{1000, 1000}, {1920, 1080}, {1080, 1920}})
      for (const char* layout : {"grid", "row", "superposed"}) {
        PoseFigureOptions options = with_layout(layout);
        options.width = width;
        options.height = height;
        const Chain chain = test::model(model);
        const TipMass mass(chain);
        Workspace ws(chain);
        std::size_t ordinary = 0;
        for (const Pose& pose : poses_of(mass, poses, options, ws)) ordinary += is_ordinary(pose.axes) ? 1 : 0;
        EXPECT_GE(ordinary, 2u) << model;
        const Picture picture = draw_ellipse_figure(mass, poses, options, fonts());
        EXPECT_GE(test::all_of<Ellipse>(picture, test::is_mass_ellipse).size(), ordinary) << model << " " << layout << width;
        EXPECT_THAT(test::words_of(picture), testing::Not(testing::HasSubstr("\u221E")));
      }
}

TEST(EllipseFigure, HasAllReadings) {
  for (const EllipseReading reading : {EllipseReading::mass, EllipseReading::energy, EllipseReading::belt})
    for (const char* layout : {"grid", "superposed"}) {
      PoseFigureOptions options = with_layout(layout);
      options.reading = reading;
      std::vector<std::vector<double>> poses = kPoses;
      poses.push_back({0, 0});
      const Picture picture = draw_ellipse_figure(TipMass(test::model("rr")), poses, options, fonts());
      EXPECT_TRUE(test::all_finite(picture));
      const std::string words = test::words_of(picture);
      EXPECT_THAT(words, testing::HasSubstr(ellipse_legend(reading).substr(0, 12)));
      EXPECT_THAT(words, testing::HasSubstr(reading == EllipseReading::energy ? " m/s" : " kg"));
      const bool infinite = words.find("\u221E") != std::string::npos;
      // Of `energy` the curve is finite; captions of panels tell the eigenvalues of Lambda all the same.
      EXPECT_EQ(infinite, reading != EllipseReading::energy || options.layout == "grid") << to_string(reading) << " " << layout;
    }
}

TEST(Field, KeepsEachEllipseInItsCell) {
  PoseFigureOptions options;
  options.cell = 0.4;
  options.branch = "elbow down";
  // A stretched chain among them: an open ellipse.
  std::vector<std::vector<double>> poses{{0, 0}};
  for (const double q2 : {0.8, 1.2, 1.6, 2.0}) poses.push_back({-0.5, q2});
  const Picture picture = draw_ellipse_figure(TipMass(test::model("rr")), poses, options, fonts());
  // The whole scene, and a cell for each.
  ASSERT_EQ(picture.clips.size(), 6u);
  const double side = picture.clips[1].width();
  for (std::size_t i = 1; i < picture.clips.size(); ++i) {
    EXPECT_NEAR(picture.clips[i].width(), side, 1e-12);
    EXPECT_NEAR(picture.clips[i].height(), side, 1e-12);
    const Point moved = test::middle_of(picture.clips[i]) - test::middle_of(picture.clips[1]);
    const Point expected = (side / 0.4) * (tip_of_rr(poses[i - 1]) - tip_of_rr(poses[0]));
    EXPECT_LT(test::distance(moved, expected), 1e-3 / 1080);
  }
  for (const Item& item : picture.items)
    if (const auto* e = std::get_if<Ellipse>(&item.shape); e && test::is_mass_ellipse(*e)) {
      EXPECT_LE(test::length(e->u), side / 2);
    }
  // Circles, not squares: nothing of a curve or of its inside comes into the corners of a cell.
  for (const Item& item : picture.items) {
    if (item.clip <= 0) continue;
    const Point middle = test::middle_of(picture.clips[std::size_t(item.clip)]);
    if (const auto* trail = std::get_if<Trail>(&item.shape))
      for (const TrailPoint& point : trail->points) EXPECT_LE(test::distance(point.p, middle), side / 2);
    if (const auto* piece = std::get_if<Polygon>(&item.shape))
      for (int i = 0; i < piece->count; ++i)
        EXPECT_LE(test::distance(piece->corners[std::size_t(i)], middle), side / 2);
  }
  EXPECT_THAT(test::words_of(picture), testing::Not(testing::HasSubstr("\u221E")));
  EXPECT_THAT(test::words_of(picture), testing::HasSubstr("cut where longer than its cell (deeper fill: longer); elbow down"));
}

// The nearer to a stretched arm, the longer the ellipse, of which a cell shows no more than of the others.
TEST(Field, FillsCutEllipsesByTheirLength) {
  PoseFigureOptions options;
  options.cell = 0.4;
  std::vector<std::vector<double>> poses;
  for (const double q2 : {1.2, 1.4, 1.6, 1.8, 0.4, 0.2, 0.1}) poses.push_back({-0.5, q2});
  const Picture picture = draw_ellipse_figure(TipMass(test::model("rr")), poses, options, fonts());
  std::vector<double> fills(poses.size());
  for (const Item& item : picture.items)
    if (const auto* piece = std::get_if<Polygon>(&item.shape); piece && item.clip > 0) fills[std::size_t(item.clip - 1)] = piece->paint.fill.a;
  for (int whole = 0; whole < 5; ++whole) EXPECT_NEAR(fills[std::size_t(whole)], fills[0], 1e-12) << whole;
  for (const std::size_t cut : {5, 6}) EXPECT_GT(fills[cut], fills[cut - 1] + 0.02) << cut;
}

// Numbers of kilograms without a name below a panel would be anybody's.
TEST(EllipseFigure, NamesTheMassesBelowItsPanels) {
  std::vector<std::vector<double>> poses;
  for (int i = 0; i < 9; ++i) poses.push_back({0, 22.5 * kOneDegree * i});
  const Picture picture = draw_ellipse_figure(TipMass(test::model("rr")), poses, {}, fonts());
  const std::string words = test::words_of(picture);
  EXPECT_THAT(words, testing::HasSubstr("eigenvalues of \u039B under each pose"));
  std::size_t named = 0;
  for (const GlyphRun& run : test::all_of<GlyphRun>(picture)) named += run.text.find("\U0001D6B2") != std::string::npos;
  EXPECT_EQ(named, poses.size());
}

// Below each of many poses stand its masses: at the axes they would stand twice. Speeds stand at the axes alone.
TEST(EllipseFigure, WritesEachMassOnce) {
  std::vector<std::vector<double>> poses;
  for (int i = 1; i <= 6; ++i) poses.push_back({0, 0.25 * i});
  const auto numbers = [&](std::size_t count, EllipseReading reading, const std::string& unit) {
    PoseFigureOptions options;
    options.reading = reading;
    const Picture picture = draw_ellipse_figure(TipMass(test::model("rr")), {poses.begin(), poses.begin() + std::ptrdiff_t(count)}, options, fonts());
    return test::all_of<GlyphRun>(picture, [&](const GlyphRun& run) { return run.face == Face::label && run.color == light_theme().ellipse && run.text.ends_with(unit) && run.stroke_width == 0; }).size();
  };
  EXPECT_EQ(numbers(6, EllipseReading::mass, "kg"), 0u);
  EXPECT_EQ(numbers(6, EllipseReading::energy, "m/s"), 12u);
  EXPECT_EQ(numbers(2, EllipseReading::mass, "kg"), 4u) << "negative control: above a matrix the axes have theirs";
}

TEST(JointSpace, ShowsTheImageOfTheUnitCircle) {
  // M = [[3, 1], [1, 1]] at (0, 90 deg): eigenvalues 2 +- sqrt 2.
  const Picture picture =
      draw_joint_space_figure(test::model("rr"), {{0, 90 * kOneDegree}}, {0, 1}, {}, fonts());
  const auto ellipses = test::all_of<Ellipse>(picture, test::is_mass_ellipse);
  ASSERT_EQ(ellipses.size(), 2u);
  const double radius = test::length(ellipses[0].u);
  EXPECT_NEAR(test::length(ellipses[0].v), radius, 1e-12);
  const double ratio = test::length(ellipses[1].u) / test::length(ellipses[1].v);
  EXPECT_NEAR(ratio, (2 + std::sqrt(2.0)) / (2 - std::sqrt(2.0)), 1e-10);
  // Its long axis is the eigenvector (1, sqrt 2 - 1).
  EXPECT_NEAR(std::abs(ellipses[1].u.y / ellipses[1].u.x), std::sqrt(2.0) - 1, 1e-10);
  const std::string words = test::words_of(picture);
  EXPECT_THAT(words, testing::HasSubstr(" [rad/s\u00B2]"));
  EXPECT_THAT(words, testing::HasSubstr("\U0001D70F"));
  EXPECT_THAT(words, testing::HasSubstr(" [N m]"));
}

// The numbers at the axes of one may be much longer than those of the other: on every page the squares are equal.
TEST(JointSpace, HasTwoEqualPlotsOnOneBaseLine) {
  for (const auto& [width, height] : {std::pair{1920, 1080}, {1000, 1000}}) {
    PoseFigureOptions options;
    options.width = width;
    options.height = height;
    const Picture picture = draw_joint_space_figure(test::model("rrr"), {{0, 1, 1}, {0, 0.1, 0.1}}, {0, 2}, options, fonts());
    ASSERT_EQ(picture.clips.size(), 4u);
    for (int row = 0; row < 2; ++row) {
      const Rect &from = picture.clips[std::size_t(2 * row)], &to = picture.clips[std::size_t(2 * row + 1)];
      EXPECT_NEAR(from.y0, to.y0, 1e-12);
      EXPECT_NEAR(from.width(), to.width(), 1e-12);
      EXPECT_NEAR(from.height(), to.height(), 1e-12);
      EXPECT_NEAR(from.width(), from.height(), 1e-12);
    }
  }
}

TEST(JointSpace, OfSlidesHasTheirUnits) {
  const std::string words = test::words_of(
      draw_joint_space_figure(test::model("pp"), {{0, 0}}, {0, 1}, {}, fonts()));
  EXPECT_THAT(words, testing::HasSubstr(" [m/s\u00B2]"));
  EXPECT_THAT(words, testing::HasSubstr(" [N]"));
}

// Negative control: another pair of joints of RRR, another image.
TEST(JointSpace, TakesTheJointsThatAreNamed) {
  const auto ratio = [](std::array<int, 2> joints) {
    const auto ellipses = test::all_of<Ellipse>(
        draw_joint_space_figure(test::model("rrr"), {{0, 1, 1}}, joints, {}, fonts()), test::is_mass_ellipse);
    return test::length(ellipses.at(1).u) / test::length(ellipses.at(1).v);
  };
  EXPECT_GT(std::abs(ratio({0, 1}) - ratio({1, 2})), 0.1);
}

// As many poses as have room: all with the same axes, their chains by one camera.
TEST(JointSpace, RefusesPosesThatHaveNoRoom) {
  const auto drawn = [](std::size_t count) {
    return draw_joint_space_figure(test::model("rr"), std::vector<std::vector<double>>(count, {0, 1}), {0, 1}, {}, fonts());
  };
  const Picture six = drawn(6);
  ASSERT_EQ(six.clips.size(), 12u);
  for (const Rect& square : six.clips) EXPECT_NEAR(square.width(), six.clips[0].width(), 1e-12);
  EXPECT_THROW(drawn(40), Error);
}

}  // namespace
}  // namespace chainreel
