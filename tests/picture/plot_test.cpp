// Plots: ticks, frames, curves cut at the frame, labels that keep apart.
#include "picture/plot.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "picture/color_vision.hpp"
#include "picture/fonts.hpp"
#include "picture/plot_hatch.hpp"
#include "picture/point.hpp"
#include "support/fonts.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

PlotStyle style_of(double text_scale = 1) {
  return {&fonts(), &light_theme(), text_scale};
}

std::vector<std::string> labels(const Axis& axis, int most) {
  std::vector<std::string> found;
  for (const Tick& tick : ticks_of(axis, most))
    if (!tick.label.empty())
      found.push_back(tick.label + (tick.superscript.empty() ? "" : "^" + tick.superscript));
  return found;
}

template <class S>
std::vector<S> all_of(const Picture& picture) {
  std::vector<S> found;
  for (const Item& item : picture.items)
    if (const S* shape = std::get_if<S>(&item.shape)) found.push_back(*shape);
  return found;
}

Rect box_of(const GlyphRun& run) {
  // The pens enclose the run but for its last glyph, which is at most an em wide.
  return {run.origin.x, run.origin.y, run.origin.x + run.glyphs.back().x + run.size, run.origin.y + run.size};
}

// --- ticks ---

TEST(Axes, AreRoundedOutToWholeTicksOnBothSides) {
  const Axis axis = rounded_out({.scale = Scale::linear, .low = -7.3, .high = 18.2});
  EXPECT_DOUBLE_EQ(axis.low, -10);
  EXPECT_DOUBLE_EQ(axis.high, 20);
  const Axis small = rounded_out({.scale = Scale::linear, .low = 0.0031, .high = 0.0069});
  EXPECT_DOUBLE_EQ(small.low, 0.003);
  EXPECT_DOUBLE_EQ(small.high, 0.007);
  const Axis decades = rounded_out({.scale = Scale::log, .low = 0.02, .high = 30});
  EXPECT_DOUBLE_EQ(decades.low, 0.01);
  EXPECT_DOUBLE_EQ(decades.high, 100);
}

TEST(Ticks, StepsAreOneTwoOrFive) {
  EXPECT_THAT(labels({Scale::linear, 0, 10}, 5), ElementsAre("0", "5", "10"));
  EXPECT_THAT(labels({Scale::linear, -1, 1}, 5), ElementsAre("\u22121.0", "\u22120.5", "0.0", "0.5", "1.0"));
  EXPECT_THAT(labels({Scale::linear, 0, 0.07}, 5), ElementsAre("0.00", "0.02", "0.04", "0.06"));
}

TEST(Ticks, NeverMoreThanAskedForAndNeverOutside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-6, 6), offset(-5, 5);
  for (int i = 0; i < 500; ++i) {
    const double range = std::pow(10.0, exponent(random)), low = range * offset(random);
    for (const int most : {3, 5}) {
      const auto ticks = ticks_of({Scale::linear, low, low + range}, most);
      ASSERT_LE(int(ticks.size()), most) << low << " " << range;
      ASSERT_GE(int(ticks.size()), 1) << low << " " << range;
      // An end that is a tick up to 1e-9 of a step has its tick.
      for (const Tick& tick : ticks) {
        ASSERT_GE(tick.value, low - 1e-8 * range);
        ASSERT_LE(tick.value, low + range * (1 + 1e-8));
      }
    }
  }
}

// Of however small a plot, symmetric about zero or not, each axis has two numbers at least: one is no scale. They stand apart.
TEST(Ticks, AreAScaleInTheSmallestPlots) {
  for (const double side : {0.16, 0.2, 0.3})
    for (double most = 0.11; most < 2000; most *= 1.07)
      for (const double low : {-most, 0.0, 0.3 * most}) {
        const PlotStyle style = style_of(3);
        PlotFrame frame = lay_out_plot({0.2, 0.2, 1, 1}, {Scale::linear, low, most}, {Scale::linear, low, most}, style);
        frame.box = {0.5, 0.5, 0.5 + side, 0.5 + side};
        Picture picture;
        draw_axes(picture, frame, style);
        std::vector<Rect> across, up;
        for (const GlyphRun& run : all_of<GlyphRun>(picture)) (run.origin.y < frame.box.y0 - 0.05 ? across : up).push_back(box_of(run));
        EXPECT_GE(up.size(), 2u) << low << " .. " << most << " on " << side;
        EXPECT_GE(across.size(), 2u) << low << " .. " << most << " on " << side;
      }
}

TEST(Ticks, LargeAndSmallNumbersShareAPowerOfTen) {
  EXPECT_THAT(labels({Scale::linear, 0, 2e6}, 5),
              ElementsAre("0", "0.5\u00D710^6", "1.0\u00D710^6", "1.5\u00D710^6", "2.0\u00D710^6"));
  EXPECT_THAT(labels({Scale::linear, 0, 1e-4}, 3),
              ElementsAre("0", "0.5\u00D710^\u22124", "1.0\u00D710^\u22124"));
}

TEST(Ticks, LogAxesLabelThreeToSixDecadesHoweverLong) {
  for (int decades = 3; decades <= 40; ++decades) {
    const auto shown = labels({Scale::log, 1e-20, std::pow(10.0, decades - 20)}, 6);
    EXPECT_GE(shown.size(), 3u) << decades;
    EXPECT_LE(shown.size(), 6u) << decades;
  }
  EXPECT_THAT(labels({Scale::log, 1e-3, 100}, 6),
              ElementsAre("10^\u22123", "10^\u22122", "10^\u22121", "1", "10", "10^2"));
}

// A tick for each of hundreds of decades would be a comb; numbers stand at round powers with one step.
TEST(Ticks, OfHundredsOfDecadesStandApartAtRoundPowers) {
  EXPECT_THAT(labels({Scale::log, 1e-300, 1e300}, 6), ElementsAre("10^\u2212200", "1", "10^200"));
  EXPECT_THAT(labels({Scale::log, 1e-5, 1e70}, 6), ElementsAre("1", "10^20", "10^40", "10^60"));
  for (const double decades : {18.0, 75.0, 140.0, 301.0, 590.0}) {
    const PlotStyle style = style_of();
    const Axis axis{Scale::log, 1e-295, std::pow(10.0, decades - 295)};
    const PlotFrame frame = lay_out_plot({0.1, 0.1, 0.9, 0.7}, axis, axis, style);
    Picture picture;
    draw_axes(picture, frame, style);
    std::vector<double> ticks;  // left of the frame
    for (const Capsule& line : all_of<Capsule>(picture))
      if (line.a.y == line.b.y && std::min(line.a.x, line.b.x) < frame.box.x0 - 1e-6) ticks.push_back(line.a.y);
    std::ranges::sort(ticks);
    ASSERT_GE(ticks.size(), 10u) << decades;
    for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_GT(ticks[i] - ticks[i - 1], 0.01) << decades;
    EXPECT_NEAR(ticks[2] - ticks[1], ticks[1] - ticks[0], 1e-9) << decades;
  }
}

TEST(Ticks, ShortLogAxesLabelOneTwoFive) {
  EXPECT_THAT(labels({Scale::log, 0.5, 5}, 6), ElementsAre("0.5", "1", "2", "5"));
}

TEST(Ticks, AnglesAreMultiplesOfHalfPi) {
  using std::numbers::pi;
  EXPECT_THAT(labels({Scale::angle, -pi, pi}, 5),
              ElementsAre("\u2212\u03C0", "\u2212\u03C0/2", "0", "\u03C0/2", "\u03C0"));
  EXPECT_THAT(labels({Scale::angle, 0, 1}, 5), ElementsAre("0.0", "0.5", "1.0"));
}

TEST(Ticks, AxesWithoutRangeHaveNone) {
  EXPECT_THAT(ticks_of({Scale::linear, 1, 1}, 5), IsEmpty());
  EXPECT_THAT(ticks_of({Scale::log, 0, 1}, 5), IsEmpty());
  EXPECT_THAT(ticks_of({Scale::linear, NAN, 1}, 5), IsEmpty());
}

TEST(Axes, RoundedOutHoldsTheIntervalAndEndsOnTicks) {
  const Axis log = rounded_out({Scale::log, 3e-7, 0.2});
  EXPECT_NEAR(std::log10(log.low), -7, 1e-12);  // a power computed by pow
  EXPECT_NEAR(std::log10(log.high), 0, 1e-12);
  const Axis linear = rounded_out({Scale::linear, -0.37, 2.1});
  EXPECT_LE(linear.low, -0.37);
  EXPECT_GE(linear.high, 2.1);
  const Axis constant = rounded_out({Scale::linear, 4, 4});
  EXPECT_LT(constant.low, 4);
  EXPECT_GT(constant.high, 4);
}

// --- frames ---

TEST(PlotFrame, DataGoToThePageAndBack) {
  const PlotFrame frame{{Scale::log, 1e-12, 1}, {Scale::linear, -2, 5}, {0.1, 0.2, 1.5, 0.9}};
  EXPECT_NEAR(frame.at({1e-6, 1.5}).x, 0.8, 1e-14);  // half of the decades; rounding of numbers below 2
  EXPECT_NEAR(frame.at({1e-6, 1.5}).y, 0.55, 1e-14);
  const Point back = frame.data_at(frame.at({3e-9, 4.2}));
  EXPECT_NEAR(back.x / 3e-9, 1, 1e-12);  // rounding times 28 natural units of the log axis
  EXPECT_NEAR(back.y, 4.2, 1e-13);
  EXPECT_FALSE(frame.can_show({0, 1}));
  EXPECT_FALSE(frame.can_show({1, NAN}));
  EXPECT_TRUE(frame.can_show({1, -1}));
}

TEST(PlotFrame, AllWordsStayInTheArea) {
  const Rect area = {0.05, 0.06, 0.75, 0.6};
  for (const double scale : {1.0, 1.5})
    for (const Axis& y :
         {Axis{Scale::log, 1e-16, 1e4, "error [J]"}, Axis{Scale::linear, -20000, 15000, "energy [J]"}}) {
      const PlotFrame frame = lay_out_plot(area, {Scale::linear, 0, 10, "time [s]"}, y, style_of(scale));
      Picture picture;
      draw_axes(picture, frame, style_of(scale));
      for (const GlyphRun& run : all_of<GlyphRun>(picture)) {
        if (run.glyphs.empty()) continue;
        // Not more than the slack of box_of beyond the sides.
        EXPECT_TRUE(holds(widened(area, run.size), box_of(run))) << run.text;
        EXPECT_GE(run.origin.x, area.x0 - 1e-12) << run.text;
        EXPECT_GE(run.size, 0.7 * size::kTick) << run.text;  // exponents are set at 70 %
      }
    }
}

// --- curves ---

TEST(Curves, AreCutAtTheFrame) {
  const PlotFrame frame{{Scale::linear, 0, 1}, {Scale::linear, 0, 1}, {0.2, 0.2, 0.8, 0.8}};
  std::vector<Point> data;
  for (int i = 0; i <= 400; ++i) data.push_back({-1 + 3 * i / 400.0, 0.5 + 2 * std::sin(0.2 * i)});
  data.push_back({1e300, -1e300});
  for (const Dash dash : {Dash::solid, Dash::dashed, Dash::dotted, Dash::dash_dot}) {
    Picture picture;
    draw_curve(picture, frame, data, {light_theme().ink, size::kPlotLine, dash, Marker::disc}, light_theme());
    const auto trails = all_of<Trail>(picture);
    ASSERT_EQ(trails.size(), 1u);
    EXPECT_GT(trails[0].points.size(), 50u);
    const double slack = 1e-12;  // rounding of the cut
    for (const TrailPoint& p : trails[0].points)
      EXPECT_TRUE(holds(widened(frame.box, slack), {p.p.x, p.p.y, p.p.x, p.p.y})) << p.p.x << " " << p.p.y;
    for (const Ellipse& marker : all_of<Ellipse>(picture))
      EXPECT_TRUE(holds(widened(frame.box, slack),
                        {marker.center.x, marker.center.y, marker.center.x, marker.center.y}));
  }
}

double drawn_length(const Trail& trail) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < trail.points.size(); ++i) {
    const TrailPoint &a = trail.points[i], &b = trail.points[i + 1];
    if (a.alpha > 0 && b.alpha > 0) sum += std::hypot(b.p.x - a.p.x, b.p.y - a.p.y);
  }
  return sum;
}

TEST(Curves, DashesCoverTheirShareOfTheLine) {
  const std::vector<Point> line = {{0, 0.5}, {0.7, 0.5}, {1.3, 0.5}};
  const auto length = [&](Dash dash) {
    Picture picture;
    draw_path(picture, line, {light_theme().ink, 0.0035, dash, Marker::none});
    return drawn_length(all_of<Trail>(picture).at(0));
  };
  EXPECT_NEAR(length(Dash::solid), 1.3, 1e-12);
  // 0.018 on, 0.008 off; round ends are part of a dash, and the last period may be cut anywhere.
  EXPECT_NEAR(length(Dash::dashed), 1.3 * (0.018 - 0.0035) / 0.026, 0.018);
  EXPECT_LT(length(Dash::dotted), length(Dash::dash_dot));
}

TEST(Curves, GapsAreWhereNothingCanBeShown) {
  const PlotFrame frame{{Scale::linear, 0, 1}, {Scale::log, 0.1, 10}, {0, 0, 1, 1}};
  const std::vector<Point> data = {{0, 1},   {0.2, 1},   {0.3, 0}, {0.4, 1},
                                   {0.6, 1}, {0.7, NAN}, {0.8, 1}, {1, 1}};
  Picture picture;
  draw_curve(picture, frame, data, {light_theme().ink, 0.003, Dash::solid, Marker::none}, light_theme());
  EXPECT_NEAR(drawn_length(all_of<Trail>(picture).at(0)), 0.6, 1e-12);
}

TEST(Curves, ThinningKeepsEveryPeak) {
  const PlotFrame frame{{Scale::linear, 0, 1}, {Scale::linear, -1, 2}, {0, 0, 1, 1}};
  std::vector<Point> data;
  for (int i = 0; i <= 200000; ++i) data.push_back({i / 200000.0, std::sin(0.01 * i)});
  data[123457].y = 1.9;  // a single point among 200000
  Picture picture;
  draw_curve(picture, frame, data, {light_theme().ink, 0.003, Dash::solid, Marker::none}, light_theme());
  const auto points = all_of<Trail>(picture).at(0).points;
  EXPECT_LT(points.size(), 8000u);
  double highest = 0;
  for (const TrailPoint& p : points) highest = std::max(highest, p.p.y);
  EXPECT_DOUBLE_EQ(highest, frame.at_y(1.9));
}

TEST(Curves, TwelveLooksCanBeToldApart) {
  for (const Theme* theme : {&light_theme(), &dark_theme()}) {
    std::set<Marker> markers;
    std::set<std::array<int, 3>> colors;
    for (int i = 0; i < kCurveLooks; ++i) {
      const CurveStyle style = curve_style(i, *theme);
      EXPECT_GE(contrast(style.color, theme->background), 3.5) << i;
      EXPECT_NE(style.dash, curve_style(i + 1, *theme).dash) << i;
      markers.insert(style.marker);
      colors.insert({style.color.r, style.color.g, style.color.b});
      EXPECT_NE(curve_style(i + kCurveLooks, *theme).dash, style.dash);
    }
    EXPECT_EQ(int(markers.size()), kCurveLooks);
    EXPECT_EQ(int(colors.size()), kCurveLooks);
  }
}

// --- labels ---

TEST(Labels, KeepApartAndInOrder) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0, 1);
  for (int run = 0; run < 200; ++run) {
    std::vector<double> wanted(12);
    for (double& y : wanted) y = run % 2 == 0 ? place(random) : 0.5 + 0.01 * place(random);
    std::sort(wanted.begin(), wanted.end());
    const std::vector<double> got = moved_apart(wanted, 0.05, 0.1, 0.9);
    EXPECT_GE(got.front(), 0.1 - 1e-12);
    EXPECT_LE(got.back(), 0.9 + 1e-12);
    for (std::size_t i = 0; i + 1 < got.size(); ++i) EXPECT_GE(got[i + 1] - got[i], 0.05 - 1e-12);
  }
}

TEST(Labels, StayWhereTheyAreWhereThereIsRoom) {
  EXPECT_THAT(moved_apart({0.2, 0.5, 0.7}, 0.1, 0, 1), ElementsAre(0.2, 0.5, testing::DoubleEq(0.7)));
  // Two at one place move by half a pitch each: the least sum of squares.
  EXPECT_THAT(moved_apart({0.5, 0.5}, 0.1, 0, 1),
              ElementsAre(testing::DoubleNear(0.45, 1e-15), testing::DoubleNear(0.55, 1e-15)));
}

TEST(Labels, OfManyCurvesDoNotOverlap) {
  const PlotFrame frame{{Scale::linear, 0, 1}, {Scale::linear, 0, 1}, {0.1, 0.1, 1.2, 0.9}};
  std::vector<EndLabel> ends;
  for (int i = 0; i < 12; ++i)
    ends.push_back({{1.2, 0.30 + 0.002 * i}, "method_" + std::to_string(i), curve_style(i, light_theme())});
  Picture picture;
  draw_end_labels(picture, frame, ends, 1.25, style_of());
  std::vector<Rect> boxes;
  for (const GlyphRun& run : all_of<GlyphRun>(picture)) boxes.push_back(box_of(run));
  ASSERT_EQ(boxes.size(), 12u);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(overlap(boxes[i], boxes[k])) << i << " " << k;
}

TEST(Labels, ParagraphsBreakAtSpacesAndHyphens) {
  const TextStyle style{Face::label, 0.022, light_theme().ink, Align::left};
  EXPECT_THAT(wrapped(fonts(), "no double-precision method", style, 0),
              ElementsAre("no", "double-", "precision", "method"));
  EXPECT_THAT(wrapped(fonts(), "no double-precision method", style, 10),
              ElementsAre("no double-precision method"));
  EXPECT_THAT(wrapped(fonts(), "at 1e-10 or -3 a dop853-like", style, 0), testing::ElementsAre("at", "1e-10", "or", "-3", "a", "dop853-", "like")) << "signs are no hyphens";
  for (const std::string& line : wrapped(fonts(), "a method that is known to all of us", style, 0.15))
    EXPECT_LE(lay_out_text(fonts(), line, style).advance, 0.15) << line;
}

TEST(Labels, ParagraphsHaveNoSingleWordOnTheirLastLine) {
  const TextStyle style{Face::label, 0.022, light_theme().ink, Align::left};
  const std::string words = "RRR under constant torques, the first of two lines that are about as long as one of them and one word more";
  const double all_but_one = lay_out_text(fonts(), words.substr(0, words.rfind(' ')), style).advance;
  const std::vector<std::string> lines = wrapped(fonts(), words, style, all_but_one);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_GT(lay_out_text(fonts(), lines[1], style).advance, 0.3 * all_but_one) << lines[1];
  const double whole = lay_out_text(fonts(), words, style).advance;
  EXPECT_EQ(wrapped(fonts(), words, style, whole * 1.001).size(), 1u) << "negative control: one line stays one";
  EXPECT_EQ(wrapped(fonts(), words, style, 0.7 * whole).front(), words.substr(0, wrapped(fonts(), words, style, 0.7 * whole).front().size())) << "nothing is lost";
}

// --- the rest ---

TEST(Hatch, CoversMarkedCellsAlone) {
  const Rect box = {0, 0, 1, 0.5};
  std::vector<bool> marked(8 * 4, false);
  marked[2 * 8 + 5] = marked[2 * 8 + 6] = true;  // x from 0.625 to 0.875, y from 0.25 to 0.375
  Picture picture;
  draw_hatch(picture, box, 8, 4, marked, light_theme().base);
  const Rect allowed = widened({0.625, 0.25, 0.875, 0.375}, 1e-12);
  const auto lines = all_of<Capsule>(picture);
  EXPECT_GT(lines.size(), 10u);
  for (const Capsule& line : lines) {
    EXPECT_TRUE(holds(allowed, {line.a.x, line.a.y, line.b.x, line.b.y}));
    EXPECT_NEAR(line.b.x - line.a.x, line.b.y - line.a.y, 1e-12);
  }
  Picture none;
  draw_hatch(none, box, 8, 4, std::vector<bool>(32, false), light_theme().base);
  EXPECT_THAT(none.items, IsEmpty());
}

TEST(Segments, AreCutToTheBox) {
  const Rect box = {0, 0, 1, 1};
  Point a = {-1, 0.5}, b = {3, 0.5};
  ASSERT_TRUE(cut_segment(box, a, b));
  EXPECT_DOUBLE_EQ(a.x, 0);
  EXPECT_DOUBLE_EQ(b.x, 1);
  Point c = {-1, 0.9}, d = {0.2, 2.5};  // passes the corner outside
  EXPECT_FALSE(cut_segment(box, c, d));
}

TEST(FontSubset, IsSmallAndHasWhatItWasAskedFor) {
  const std::string few = font_subset(fonts(), Face::label, {U'a', U'b', 0x2212});
  EXPECT_GT(few.size(), 500u);
  EXPECT_LT(few.size(), 40000u);  // the whole face has 750 kB
  EXPECT_GT(font_subset(fonts(), Face::label, {U'a', U'b', U'c', U'd', U'e', U'f'}).size(), few.size());
}

TEST(Text, GlyphsKnowTheirCharacters) {
  const TextLine line = lay_out_text(fonts(), "office", {Face::label, 0.03, light_theme().ink, Align::left});
  const std::vector<Glyph>& glyphs = line.runs.at(0).glyphs;
  EXPECT_EQ(glyphs.front().character, 0u);
  EXPECT_EQ(glyphs.back().character, 5u);
  EXPECT_LT(glyphs.size(), 6u);  // "ffi" is one glyph in this face
  const TextLine math =
      lay_out_math(fonts(), "tau = 12 N m", {Face::math, 0.03, light_theme().ink, Align::left});
  std::uint32_t last = 0;
  for (const Glyph& glyph : math.runs.at(0).glyphs) {
    EXPECT_GE(glyph.character, last);
    last = glyph.character;
  }
  EXPECT_EQ(last + 1, 6u);  // of "tau=12Nm", the tau one character of its own
}

}  // namespace
}  // namespace chainreel
