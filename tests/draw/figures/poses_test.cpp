#include "draw/figures/poses.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "core/error.hpp"
#include "draw/chains.hpp"
#include "draw/figures/caption.hpp"
#include "draw/shapes.hpp"

namespace chainreel {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

EffectiveMass mass_of(const Chain& chain, const std::vector<double>& q) {
  Workspace ws(chain);
  return effective_mass_of(chain, ws, q, chain.end_effector, Task::linear);
}

TEST(PoseFigure, ShowsTheLastPoseInFullAndTheOthersAsOnionSkins) {
  const Chain chain = test::model("rr");
  const Picture picture = draw_pose_figure(chain, {{0, 0.5}, {0.4, 0.5}, {0.8, 0.5}}, {}, fonts());
  const auto links =
      test::all_of<Capsule>(picture, [](const Capsule& c) { return c.paint.stroke_width > 0; });
  ASSERT_EQ(links.size(), 6u);
  const auto quarter = [](std::uint8_t c) {
    return std::uint8_t(std::lround(255 + 0.25 * (double(c) - 255)));
  };
  const Color full = light_theme().link[0];
  const Color skin{quarter(full.r), quarter(full.g), quarter(full.b), 1};
  EXPECT_EQ(links[0].paint.fill, skin);
  EXPECT_EQ(links[2].paint.fill, skin);
  EXPECT_EQ(links[4].paint.fill, full);
}

TEST(PoseFigure, NeedsAPose) {
  EXPECT_THROW(draw_pose_figure(test::model("rr"), {}, {}, fonts()), Error);
  EXPECT_THROW(draw_ellipse_figure(TipMass(test::model("rr")), {}, {}, fonts()), Error);
}

TEST(EllipseFigure, DrawsEveryPoseAtTheSameScale) {
  const Chain chain = test::model("rr");
  const Picture picture =
      draw_ellipse_figure(TipMass(chain), {{0, 90 * kDeg}, {0, 150 * kDeg}}, {}, fonts());
  const auto ellipses = test::all_of<Ellipse>(picture, test::is_mass_ellipse);
  ASSERT_EQ(ellipses.size(), 2u);
  // Lambda = diag(1, 2), and eigenvalues 5 and 1.
  EXPECT_NEAR(test::length(ellipses[0].u) / test::length(ellipses[0].v), 2, 1e-12);
  EXPECT_NEAR(test::length(ellipses[1].u) / test::length(ellipses[0].u), 2.5, 1e-12);
  const auto links = test::all_of<Capsule>(picture, [](const Capsule& c) {
    return c.paint.stroke_width == size::kLinkOutline && c.paint.fill.a == 1;
  });
  ASSERT_EQ(links.size(), 4u);
  for (const Capsule& link : links) {
    EXPECT_NEAR(test::distance(link.a, link.b), test::distance(links[0].a, links[0].b), 1e-12);
  }
  EXPECT_THAT(test::words_of(picture), testing::HasSubstr("effective mass ellipse"));
}

TEST(EllipseFigure, KeepsEllipsesOfOrdinaryPosesInsideTheirPanels) {
  const Chain chain = test::model("rr");
  for (const int poses : {1, 2, 4, 5, 8}) {
    std::vector<std::vector<double>> list;
    for (int i = 0; i < poses; ++i) list.push_back({0.3 * i, (60 + 10 * i) * kDeg});
    const Picture picture = draw_ellipse_figure(TipMass(chain), list, {}, fonts());
    ASSERT_EQ(picture.clips.size(), std::size_t(poses));
    int seen = 0;
    for (const Item& item : picture.items) {
      const auto* e = std::get_if<Ellipse>(&item.shape);
      if (!e || !test::is_mass_ellipse(*e)) continue;
      const double w = std::hypot(e->u.x, e->v.x), h = std::hypot(e->u.y, e->v.y);
      EXPECT_TRUE(test::is_inside(picture.clips[std::size_t(item.clip)],
                                  Rect{e->center.x - w, e->center.y - h, e->center.x + w, e->center.y + h}));
      ++seen;
    }
    EXPECT_EQ(seen, poses);
  }
}

TEST(EllipseFigure, PutsPanelsOnThePageWithoutOverlap) {
  const Chain chain = test::model("rr");
  const std::vector<std::vector<double>> list(6, {0.2, 1.0});
  for (const double text_scale : {1.0, 1.5}) {
    PoseFigureOptions options;
    options.text_scale = text_scale;
    options.title = "Six times the same pose";
    const Picture picture = draw_ellipse_figure(TipMass(chain), list, options, fonts());
    for (std::size_t i = 0; i < picture.clips.size(); ++i) {
      EXPECT_TRUE(test::is_inside(Rect{0, 0, picture.aspect, 1}, picture.clips[i]));
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(test::overlap(picture.clips[i], picture.clips[j]));
    }
  }
}

TEST(EllipseFigure, LeavesTheBandOpenAndTellsTheOtherMassAtASingularPose) {
  const Chain chain = test::model("rr");
  const Picture picture = draw_ellipse_figure(TipMass(chain), {{0, 0}}, {}, fonts());
  EXPECT_TRUE(test::all_of<Ellipse>(picture, test::is_mass_ellipse).empty());
  EXPECT_THAT(test::words_of(picture), testing::HasSubstr("\u221E"));
  EXPECT_EQ(eigenvalues_notations(masses_of(mass_of(chain, {90 * kDeg, 0}))).back(), "(\u221E, 1)\u2009kg");
  // As all captions, in the face of formulas.
  const auto infinities = test::all_of<GlyphRun>(picture, [](const GlyphRun& run) { return run.face == Face::math && run.text.find("\u221E") != std::string::npos; });
  EXPECT_FALSE(infinities.empty());
}

TEST(Caption, ShowsLambdaWithThreeDigits) {
  const Chain chain = test::model("rr");
  using Rows = std::vector<std::vector<std::string>>;
  EXPECT_EQ(matrix_notations(*mass_of(chain, {0, 150 * kDeg}).Lambda),
            (Rows{{"4.00", "-1.73"}, {"-1.73", "2.00"}}));
  EXPECT_EQ(matrix_notations(*mass_of(chain, {0, 90 * kDeg}).Lambda), (Rows{{"1", "0"}, {"0", "2"}}));
}

TEST(Caption, ShowsAnglesInDegreesAndSlidesInMetres) {
  EXPECT_EQ(pose_notations(test::model("rr"), {0, 150 * kDeg}).front(), "q = (0\u00B0, 150\u00B0)");
  EXPECT_EQ(pose_notations(test::model("rr"), {-1e-9, 12.34 * kDeg}).front(), "q = (0\u00B0, 12.3\u00B0)");
  EXPECT_EQ(pose_notations(test::model("pp"), {0.25, -1}).front(), "q = (0.25 m, -1 m)");
}

TEST(Caption, WritesNumbersWithoutAnExponentWhereThatIsShort) {
  EXPECT_EQ(number_notation(1234.5, 1234.5), "1234");
  EXPECT_EQ(number_notation(0.00123456, 1), "0.00123");
  EXPECT_EQ(number_notation(1e-13, 1), "0");
  EXPECT_EQ(number_notation(328281.4, 328281.4), "3.28e5");
  EXPECT_EQ(number_notation(-4.567e-7, 1e-6), "-4.57e-7");
  EXPECT_EQ(number_notation(-2.0 / 3, 1), "-0.667");
}

}  // namespace
}  // namespace chainreel
