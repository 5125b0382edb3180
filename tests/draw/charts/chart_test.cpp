// Charts: every measurement is where it belongs, words are on the page, and the pictures are the goldens.
#include "draw/charts/chart.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"
#include "draw/chart_samples.hpp"
#include "draw/charts/response_chart.hpp"
#include "draw/shapes.hpp"
#include "render/canvas.hpp"
#include "support/fonts.hpp"
#include "support/picture_compare.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;
using namespace test;

ChartLook look_of(const Theme& theme, double text_scale = 1) {
  return {16.0 / 9.0, text_scale, &theme, &fonts()};
}

constexpr std::array kBoth = {ChartCost::seconds, ChartCost::evaluations};
constexpr std::array kSeconds = {ChartCost::seconds};

Image drawn(const Picture& picture) {
  Canvas canvas(640, 360, fonts());
  Image image;
  canvas.draw(picture, image);
  return image;
}

// As for all goldens: text and edges may fall otherwise on the pixels with other versions of the libraries.
constexpr PictureTolerance kGolden = {.max = 24, .mean = 0.05};

bool says(const Picture& picture, const std::string& words) {
  for (const GlyphRun& run : all_of<GlyphRun>(picture))
    if (run.text.find(words) != std::string::npos) return true;
  return false;
}

void expect_words_on_page(const Picture& picture) {
  for (const GlyphRun& run : all_of<GlyphRun>(picture)) {
    if (run.glyphs.empty()) continue;
    EXPECT_GE(run.size, 0.7 * size::kTick - 1e-12) << run.text;  // scripts are 70 % of the smallest text
    EXPECT_GE(run.origin.x, 0.9 * size::kMargin) << run.text;
    // The last pen is at most an em left of the end of the run.
    EXPECT_LE(run.origin.x + run.glyphs.back().x, picture.aspect - 0.9 * size::kMargin) << run.text;
    EXPECT_GE(run.origin.y, 0.5 * size::kMargin) << run.text;
    EXPECT_LE(run.origin.y + 0.73 * run.size, 1) << run.text;
  }
}

TEST(Chart, IsAsItWasLookedAt) {
  EXPECT_TRUE(matches_golden(
      drawn(work_precision_chart(sample_work_precision(), kSeconds, look_of(light_theme(), 1.5))),
      "chart_light", kGolden));
  EXPECT_TRUE(
      matches_golden(drawn(work_precision_chart(sample_work_precision(), kBoth, look_of(dark_theme()))),
                     "chart_dark", kGolden));
  EXPECT_TRUE(matches_golden(drawn(energy_chart(sample_energy(), look_of(light_theme(), 1.5))),
                             "energy_chart", kGolden));
  EXPECT_TRUE(matches_golden(drawn(stability_map(sample_map(120, 80), look_of(light_theme(), 1.5))),
                             "stability_map", kGolden));
}

TEST(Chart, AllWordsAreOnThePageAtEverySize) {
  for (const Theme* theme : {&light_theme(), &dark_theme()})
    for (const double scale : {1.0, 1.5}) {
      const ChartLook look = look_of(*theme, scale);
      expect_words_on_page(work_precision_chart(sample_work_precision(), kBoth, look));
      expect_words_on_page(energy_chart(sample_energy(), look));
      expect_words_on_page(stability_map(sample_map(20, 10), look));
    }
}

TEST(Chart, NamesEveryMethodAndWhatItShows) {
  const WorkPrecision data = sample_work_precision();
  const Picture picture = work_precision_chart(data, kBoth, look_of(light_theme()));
  for (const ChartCurve& curve : data.curves) EXPECT_TRUE(says(picture, curve.method)) << curve.method;
  for (const char* words : {"time per run [s]", "evaluations of the dynamics", "final error [rad]", "auto",
                            "rounding", "2\u00D710\u207B\u00B2\u2074", "failed", "revision 1a2b3c4"})
    EXPECT_TRUE(says(picture, words)) << words;
  WorkPrecision less = data;
  less.choice.reset();
  less.floor = 0;
  const Picture without = work_precision_chart(less, kBoth, look_of(light_theme()));
  EXPECT_FALSE(says(without, "auto"));
  EXPECT_FALSE(says(without, "rounding"));
}

// A choice of another order lies off its method's curve, and says why.
TEST(Chart, SaysWhyTheChoiceLiesOffItsCurve) {
  WorkPrecision data = sample_work_precision();
  const auto chosen = std::ranges::find(data.curves, data.choice->method, &ChartCurve::method);
  ChartPoint& point = chosen->points[std::size_t(data.choice->point)];
  point.label = "taylor, order 20, tolerance 1e-06";
  EXPECT_FALSE(says(work_precision_chart(data, kBoth, look_of(light_theme())), "auto (order 20)"));
  point.is_apart = true;
  EXPECT_TRUE(says(work_precision_chart(data, kBoth, look_of(light_theme())), "auto (order 20)"));
}

// A method whose marker is a disc, so that its points can be counted.
WorkPrecision one_curve(int failed) {
  WorkPrecision data;
  ChartCurve curve{"rk4", 4, {}, 0};
  for (int i = 0; i < 6; ++i)
    curve.points.push_back({std::pow(10.0, -2 * i), 1e-4 * std::pow(3.16, i), 1e3, i < failed, ""});
  data.curves.push_back(curve);
  return data;
}

std::vector<Ellipse> discs(const Picture& picture) {
  const Color color = curve_style(0, light_theme()).color;
  return all_of<Ellipse>(picture, [&](const Ellipse& e) { return e.paint.fill == color; });
}

TEST(Chart, DrawsEveryRungOfTheLadder) {
  // One more is the key beside the label.
  EXPECT_EQ(discs(work_precision_chart(one_curve(0), kSeconds, look_of(light_theme()))).size(), 7u);
  EXPECT_EQ(discs(work_precision_chart(one_curve(2), kSeconds, look_of(light_theme()))).size(), 7u);
}

// A method that alone comes below the growth of one rounding is not the cheapest at any error that means something.
TEST(Chart, LightsNoneForWhatRoundingDecides) {
  WorkPrecision data;
  data.floor = 1e-12;
  data.curves.push_back({"usual", 4, {{1e-4, 1, 1, false, ""}, {1e-10, 2, 2, false, ""}}, 0});
  data.curves.push_back({"below", 4, {{1e-4, 3, 3, false, ""}, {1e-14, 9, 9, false, ""}}, 1});
  light_curves(data, kBoth, {});
  EXPECT_TRUE(data.curves[0].is_lit && !data.curves[1].is_lit);
  data.floor = 0;
  light_curves(data, kBoth, {});
  EXPECT_TRUE(data.curves[1].is_lit) << "where no floor is known";
}

// Where the reference is known less well than rounding would let a method be, that decides what errors mean.
TEST(Chart, ShadesWhatTheReferenceDoesNotTell) {
  WorkPrecision data = sample_work_precision();
  data.reference_uncertainty = 1e-9;
  const std::string words = words_of(work_precision_chart(data, kBoth, look_of(light_theme())));
  EXPECT_THAT(words, testing::AllOf(HasSubstr("reference"), HasSubstr("shaded: reference known to"), Not(HasSubstr("amplification"))));
  EXPECT_EQ(data.least_error(), 1e-9);
  data.curves = {{"usual", 4, {{1e-4, 1, 1, false, ""}, {1e-8, 2, 2, false, ""}}, 0}, {"below", 4, {{1e-4, 3, 3, false, ""}, {1e-10, 9, 9, false, ""}}, 1}};
  data.choice.reset();
  light_curves(data, kBoth, {});
  EXPECT_TRUE(data.curves[0].is_lit && !data.curves[1].is_lit);
}

// On pages that are higher than wide panels stand one below the other, and words are those of a slide as wide.
TEST(Chart, StacksItsPanelsOnPortraitPages) {
  ChartLook look = look_of(light_theme());
  look.aspect = 9.0 / 16;
  look.height = 4.0 / 3 / look.aspect;
  const Picture picture = work_precision_chart(sample_work_precision(), kBoth, look);
  EXPECT_EQ(picture.aspect, look.aspect);
  std::vector<double> title_lines;
  for (const GlyphRun& run : all_of<GlyphRun>(picture)) {
    EXPECT_GE(run.origin.x, 0) << run.text;
    EXPECT_LE(run.origin.x + (run.glyphs.empty() ? 0 : run.glyphs.back().x), picture.aspect) << run.text;
    if (run.text.find("time per run") != std::string::npos || run.text.find("evaluations of") != std::string::npos) title_lines.push_back(run.origin.y);
  }
  ASSERT_EQ(title_lines.size(), 2u);
  EXPECT_GT(std::abs(title_lines[0] - title_lines[1]), 0.3);
}

TEST(Chart, LightsTheCheapestAndTheChoiceOrWhatIsAskedFor) {
  WorkPrecision data;
  const auto add = [&](const char* method, double cost) {
    ChartCurve curve{method, 4, {}, int(data.curves.size())};
    for (int i = 0; i < 4; ++i) curve.points.push_back({std::pow(10.0, -2 * i), cost * std::pow(3.0, i), 1e3 * cost, false, ""});
    data.curves.push_back(curve);
  };
  add("cheap", 1e-4), add("chosen", 2e-4), add("dear", 3e-4);
  data.choice = ChartChoice{"chosen", 1};
  light_curves(data, kBoth, {});
  EXPECT_TRUE(data.curves[0].is_lit && data.curves[1].is_lit && !data.curves[2].is_lit);
  const Picture picture = work_precision_chart(data, kSeconds, look_of(light_theme()));
  EXPECT_TRUE(says(picture, "1 other, grey"));
  const auto trails = [&](const Picture& p, Color color) {
    return all_of<Trail>(p, [&](const Trail& trail) { return trail.color == color; }).size() +
           all_of<Capsule>(p, [&](const Capsule& line) { return line.paint.fill == color; }).size();
  };
  EXPECT_EQ(trails(picture, curve_style(2, light_theme()).color), 0u);
  light_curves(data, kBoth, {"dear"});
  EXPECT_TRUE(!data.curves[0].is_lit && !data.curves[1].is_lit && data.curves[2].is_lit);
  EXPECT_GT(trails(work_precision_chart(data, kSeconds, look_of(light_theme())), curve_style(2, light_theme()).color), 0u);
}

// The third of the list and the fifteenth share a green, the third and the eighth are two greens.
// Below a chart of a slide two lines say all that they promise.
TEST(Chart, ItsFootTakesTwoLines) {
  WorkPrecision data = sample_work_precision();
  data.error_meaning = "error: larger of q's and 0.19 s \u00D7 qd's at 50 instants";
  light_curves(data, kBoth, {"taylor", "rk4"});
  const Picture picture = work_precision_chart(data, kBoth, look_of(light_theme()));
  std::set<double> lines;
  std::string words;
  for (const GlyphRun& run : all_of<GlyphRun>(picture))
    if (run.origin.y < size::kMargin + 0.09 && run.origin.x < 2 * size::kMargin) lines.insert(run.origin.y), words += run.text + " ";
  EXPECT_EQ(lines.size(), 2u) << words;
  for (const char* part : {"50 instants", "grows to", "2\u00D710\u207B\u00B2\u2074", "1, 10, 100 times", "10 others, grey: --highlight", "failed or lost", "revision 1a2b3c4"})
    EXPECT_THAT(words, HasSubstr(part));
}

// The name of a grey curve has a line to it, or no other curve beside it.
TEST(Chart, NamesOfGreyCurvesAreSeenToBeTheirs) {
  WorkPrecision data;
  // Two that end side by side, and one by itself.
  const auto add = [&](const char* method, double error, double cost, double per_error = 3) {
    ChartCurve curve{method, 0, {}, int(data.curves.size())};
    for (int i = 0; i < 4; ++i) curve.points.push_back({error * std::pow(10.0, -2 * i), cost * std::pow(per_error, i), 1e3, false, ""});
    data.curves.push_back(curve);
  };
  add("lit", 1, 1e-4, 1.5), add("left", 30, 2e-3, 20), add("right", 36, 2e-3, 20), add("alone", 1e5, 1e-3, 20);
  light_curves(data, kSeconds, {"lit"});
  for (const Theme* theme : {&light_theme(), &dark_theme()}) {
    const Picture picture = work_precision_chart(data, kSeconds, look_of(*theme));
    const auto dots = all_of<Ellipse>(picture, [&](const Ellipse& dot) { return dot.paint.fill == theme->muted; });
    EXPECT_GE(dots.size(), 2u) << "left and right";
    for (const char* name : {"left", "right", "alone"}) EXPECT_TRUE(says(picture, name)) << name;
    for (const Ellipse& dot : dots) {
      const auto leads_there = [&](const Capsule& line) { return test::distance(line.a, dot.center) < 1e-12 && test::distance(line.a, line.b) > 1e-3; };
      EXPECT_EQ(all_of<Capsule>(picture, leads_there).size(), 1u);
    }
  }
  // Negative control: far from all others a name stands beside its end.
  data.curves.erase(data.curves.begin() + 1, data.curves.begin() + 3);
  const Picture two = work_precision_chart(data, kSeconds, look_of(light_theme()));
  EXPECT_TRUE(says(two, "alone"));
  EXPECT_TRUE(all_of<Ellipse>(two, [](const Ellipse& dot) { return dot.paint.fill == light_theme().muted; }).empty());
}

TEST(Chart, CurvesInColourHaveColoursOfTheirOwn) {
  const auto lit = [](std::vector<std::size_t> places) {
    WorkPrecision data;
    for (int k = 0; k < 15; ++k) data.curves.push_back({std::to_string(k), 4, {{1e-3, 1e-3, 1e3, false, ""}}, k});
    std::vector<std::string> names;
    for (const std::size_t place : places) names.push_back(std::to_string(place));
    light_curves(data, kBoth, names);
    std::vector<Color> colors;
    for (const std::size_t place : places) colors.push_back(curve_style(data.curves[place].look, light_theme()).color);
    return colors;
  };
  for (const std::size_t other : {14u, 7u}) {
    const std::vector<Color> colors = lit({2, other});
    EXPECT_EQ(colors[0], curve_style(2, light_theme()).color) << "the first keeps its own";
    EXPECT_GT(std::abs(colors[0].r - colors[1].r), 60) << other << ": no green";
  }
  // Negative control: those that differ keep what they have, so that a method looks the same from chart to chart.
  EXPECT_EQ(lit({0, 1, 3})[2], curve_style(3, light_theme()).color);
  std::vector<std::size_t> six{1, 2, 7, 9, 13, 14};
  std::vector<Color> colors = lit(six);
  for (std::size_t i = 0; i < colors.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(colors[i] == colors[j]) << i << " " << j;
}

TEST(Chart, ExplainsTrianglesOnlyWhereThereAreSome) {
  WorkPrecision data = one_curve(0);
  data.curves[0].order = 2;  // it falls by a half decade of cost for each of error: not as order 4 does
  EXPECT_EQ(says(work_precision_chart(data, kSeconds, look_of(light_theme())), "triangles"),
            !all_of<Polygon>(work_precision_chart(data, kSeconds, look_of(light_theme()))).empty());
  data.curves[0].order = 0;  // no slope is expected
  EXPECT_FALSE(says(work_precision_chart(data, kSeconds, look_of(light_theme())), "triangles"));
}

TEST(Chart, FailedRunsStandAtTheRightEdge) {
  const Picture none = work_precision_chart(one_curve(0), kSeconds, look_of(light_theme()));
  const Picture picture = work_precision_chart(one_curve(2), kSeconds, look_of(light_theme()));
  EXPECT_FALSE(says(none, "failed"));
  EXPECT_TRUE(says(picture, "failed"));
  std::vector<double> xs;
  for (const Ellipse& disc : discs(picture)) xs.push_back(disc.center.x);
  std::sort(xs.begin(), xs.end());
  // Four points, the two failures at one x a decade further, the key.
  EXPECT_DOUBLE_EQ(xs[4], xs[5]);
  EXPECT_GT(xs[4] - xs[3], 0.01);
}

TEST(Chart, TheChoiceIsCircledWhereItIs) {
  WorkPrecision data = one_curve(0);
  data.choice = ChartChoice{"rk4", 3};
  const Picture picture = work_precision_chart(data, kSeconds, look_of(light_theme()));
  const auto rings = all_of<Ellipse>(picture, [](const Ellipse& e) { return e.paint.fill.a == 0; });
  ASSERT_EQ(rings.size(), 1u);
  const auto points = discs(picture);
  EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                          [&](const Ellipse& e) { return distance(e.center, rings[0].center) < 1e-12; }));
  data.choice = ChartChoice{"unknown", 3};
  EXPECT_TRUE(
      all_of<Ellipse>(work_precision_chart(data, kSeconds, look_of(light_theme())), [](const Ellipse& e) {
        return e.paint.fill.a == 0;
      }).empty());
}

// A choice of another order than the ladder's: no curve bends to it, and it is not what others are held against.
TEST(Chart, AChoiceThatIsNoRungIsAMarkByItself) {
  const auto lines = [](const WorkPrecision& data) {
    return all_of<Capsule>(work_precision_chart(data, kSeconds, look_of(light_theme())), [](const Capsule&) { return true; }).size();
  };
  WorkPrecision data = one_curve(0);
  const std::size_t marks = discs(work_precision_chart(data, kSeconds, look_of(light_theme()))).size(), pieces = lines(data);
  data.curves[0].points.insert(data.curves[0].points.begin() + 1, {data.curves[0].points[0].error, 1e-9, 1, false, "rk4, order 5"});
  EXPECT_LT(*least_cost(data, ChartCost::seconds, 1), 1e-8);
  EXPECT_NE(lines(data), pieces);
  data.curves[0].points[1].is_apart = true;
  EXPECT_GT(*least_cost(data, ChartCost::seconds, 1), 1e-8);
  EXPECT_EQ(discs(work_precision_chart(data, kSeconds, look_of(light_theme()))).size(), marks + 1);
}

TEST(Chart, LeastCostIsThatOfTheBestMethodAtEachError) {
  WorkPrecision data;
  data.curves = {{"a", 1, {{1e-2, 1, 0, false, ""}, {1e-4, 100, 0, false, ""}}, -1},
                 {"b", 4, {{1e-1, 5, 0, false, ""}, {1e-9, 50, 0, false, ""}}, -1},
                 {"c", 4, {{1e-12, 1e-3, 0, true, ""}}, -1}};
  EXPECT_NEAR(*least_cost(data, ChartCost::seconds, 1e-2), 1, 1e-12);
  EXPECT_NEAR(*least_cost(data, ChartCost::seconds, std::pow(10, -2.5)), std::sqrt(10.0), 1e-9);  // along a
  EXPECT_NEAR(*least_cost(data, ChartCost::seconds, 1e-5), 5 * std::sqrt(10.0), 1e-9);  // halfway along b
  EXPECT_NEAR(*least_cost(data, ChartCost::seconds, 1), 1, 1e-12);
  EXPECT_FALSE(least_cost(data, ChartCost::seconds, 1e-10));  // a failed run counts for nothing
}

// Forty pixels of a slide: what is narrower shows no slope.
TEST(Chart, TrianglesAreWideEnoughToBeRead) {
  const Color color = light_theme().muted.faded(0.12);
  std::size_t seen = 0;
  for (const double scale : {1.0, 1.5}) {
    const Picture picture = work_precision_chart(sample_work_precision(), kBoth, look_of(light_theme(), scale));
    for (const Polygon& one : all_of<Polygon>(picture, [&](const Polygon& p) { return p.paint.fill == color; })) {
      EXPECT_GE(std::abs(one.corners[1].x - one.corners[0].x), 40.0 / 1080 - 1e-3);
      ++seen;
    }
  }
  EXPECT_GE(seen, 4u);
}

// A small page has the chart on three fifths of its height: what its caption says stands on large ones alone.
TEST(Chart, OnPaperIsMostlyAPlot) {
  ChartLook look = look_of(light_theme(), 1.9);
  look.aspect = 4.0 / 3;
  look.is_small = true;
  const Picture picture = work_precision_chart(sample_work_precision(), kBoth, look);
  EXPECT_FALSE(says(picture, "What accuracy costs"));
  EXPECT_FALSE(says(picture, "Intel"));
  EXPECT_TRUE(says(picture, "times the cheapest"));
  EXPECT_TRUE(says(picture, "time per run"));
}

// On a paper's column names of curves in colour beside the only panel would leave it two thirds of the width.
TEST(Chart, OnSmallPagesHasTheNamesOfCurvesInsideWhereTheyHaveRoom) {
  WorkPrecision data = sample_work_precision();
  light_curves(data, kSeconds, {"taylor"});
  const auto frame_end = [&](bool is_small) {
    ChartLook look = look_of(light_theme());
    look.is_small = is_small;
    double end = 0;
    for (const Capsule& line : all_of<Capsule>(work_precision_chart(data, kSeconds, look)))
      if (line.paint.fill == light_theme().rule) end = std::max({end, line.a.x, line.b.x});
    return end;
  };
  EXPECT_GT(frame_end(true), 0.95 * 16.0 / 9.0) << "but for the margin and half of the last number";
  EXPECT_LT(frame_end(false), 0.9 * 16.0 / 9.0) << "negative control: a slide has them beside";
}

TEST(Chart, SlopesAreShownOnlyWhereACurveHasThem) {
  const auto triangles = [](const WorkPrecision& data) {
    const Color color = light_theme().muted.faded(0.12);
    return all_of<Polygon>(work_precision_chart(data, kSeconds, look_of(light_theme())),
                           [&](const Polygon& p) { return p.paint.fill == color; });
  };
  WorkPrecision data = one_curve(0);  // costs grow by sqrt(10) for two decades: order 4
  ASSERT_EQ(triangles(data).size(), 1u);
  data.curves[0].order = 2;
  EXPECT_TRUE(triangles(data).empty());
}

TEST(Chart, StandsTheWorstInput) {
  WorkPrecision data;
  data.title = "Nothing";
  EXPECT_TRUE(all_finite(work_precision_chart(data, kBoth, look_of(light_theme()))));
  data = one_curve(6);
  data.floor = 1e-5;
  data.curves[0].points.push_back({0, 0, 0, false, ""});
  data.curves[0].points.push_back({HUGE_VAL, NAN, -1, false, ""});
  EXPECT_TRUE(all_finite(work_precision_chart(data, kBoth, look_of(light_theme()))));
  EXPECT_TRUE(all_finite(energy_chart({}, look_of(light_theme()))));
  EnergyChart energy;
  energy.curves.push_back({"a", {0, 1, 2}, {0, 0, HUGE_VAL}, "diverged", -1});
  EXPECT_TRUE(all_finite(energy_chart(energy, look_of(dark_theme()))));
}

// --- energy ---

TEST(EnergyChart, CrestsAreTheLargestOfEachPart) {
  EnergyCurve curve{"a", {}, {}, "", -1};
  for (int i = 1; i <= 10000; ++i) {
    curve.t.push_back(i * 0.01);
    curve.error.push_back((i % 7 == 0 ? -1 : 0.01) * i);
  }
  const auto found = crests(curve, 1, 20);
  ASSERT_EQ(found.size(), 20u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double end = std::pow(100.0, (i + 1) / 20.0);   // of its part
    EXPECT_NEAR(found[i].y, 100 * end, 7.0 + 1e-9) << i;  // the last multiple of seven before it
    EXPECT_NEAR(found[i].y, 100 * found[i].x, 1e-9);
  }
  EXPECT_TRUE(crests({"none", {}, {}, "", -1}, 1, 20).empty());
}

TEST(EnergyChart, OthersThanThoseInColourAreGreyAndHaveTheirNamesWhereThereIsRoom) {
  EnergyChart data = sample_energy();
  const auto greys = [&](const Picture& picture) {
    return all_of<Trail>(picture, [](const Trail& one) { return one.color == light_theme().base; }).size();
  };
  EXPECT_EQ(greys(energy_chart(data, look_of(light_theme()))), 0u);
  for (EnergyCurve& curve : data.curves) curve.is_lit = curve.method == "taylor";
  const Picture picture = energy_chart(data, look_of(light_theme()));
  EXPECT_GT(greys(picture), 0u);
  EXPECT_TRUE(says(picture, "verlet"));
  ChartLook small = look_of(light_theme(), 1.5);
  small.is_small = true;
  EXPECT_FALSE(says(energy_chart(data, small), "verlet"));
  EXPECT_TRUE(says(energy_chart(data, small), "taylor"));
}

// Negative control: the errors themselves fall at each passage through zero.
TEST(EnergyChart, ShowsTheLargestErrorUntilEachTime) {
  EnergyChart data;
  data.curves.push_back({"a", {}, {}, "", 0});
  for (int i = 1; i < 2000; ++i) {
    data.curves[0].t.push_back(0.01 * i);
    data.curves[0].error.push_back(0.1 * std::sin(0.05 * i) * i);
  }
  const std::vector<Point> parts = crests(data.curves[0], 0.01, 240);
  EXPECT_FALSE(std::ranges::is_sorted(parts, {}, &Point::y));
  int curves = 0;
  for (const Trail& curve : all_of<Trail>(energy_chart(data, look_of(light_theme())))) {
    if (curve.color != curve_style(0, light_theme()).color || curve.points.size() < 20) continue;
    ++curves;
    for (std::size_t i = 1; i < curve.points.size(); ++i) EXPECT_GE(curve.points[i].p.y, curve.points[i - 1].p.y - 1e-12) << i;
  }
  EXPECT_EQ(curves, 1);
}

TEST(EnergyChart, SaysWhichRunsEndedEarly) {
  const Picture picture = energy_chart(sample_energy(), look_of(light_theme()));
  EXPECT_TRUE(says(picture, "explicit_euler (diverged)"));
  EXPECT_TRUE(says(picture, "|energy error| [J]"));
  EXPECT_FALSE(says(picture, "verlet ("));
}

// --- stability ---

// Marks lie where the axes say, a gap parts a curve, and what has no value is a cross above.
TEST(ResponseChart, HasAMarkARunAndGapsWhereThereIsNone) {
  ResponseChart data{"Peaks", "5 runs", "", {Scale::linear, 0, 4, "payload [kg]"}, {{"largest $|tau|$ [N m]", true, {}}}, "Each mark is a run"};
  std::vector<ResponseCurve>& curves = data.panels[0].curves;
  curves = {{"$tau1$", {{0, 10.0}, {1, 20.0}, {2, {}}, {3, 40.0, true}, {4, 50.0}}}, {"$tau2$", {{0, 5.0}, {1, 5.0}, {2, {}}, {3, 5.0}, {4, 5.0}}}};
  const Picture picture = response_chart(data, look_of(light_theme()));
  expect_words_on_page(picture);
  EXPECT_TRUE(says(picture, "Each mark is a run"));
  // Of the first curve runs 0, 1 and 4 are discs, and the key of its name is one; a doubtful run is none, nor one without a value.
  std::vector<Point> places;
  for (const Ellipse& disc : discs(picture)) places.push_back(disc.center);
  std::sort(places.begin(), places.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  ASSERT_EQ(places.size(), 4u);
  EXPECT_NEAR(places[2].x - places[1].x, 3 * (places[1].x - places[0].x), 1e-9);
  EXPECT_NEAR(places[2].y - places[1].y, 3 * (places[1].y - places[0].y), 1e-9) << "10, 20 and 50 N m";
  EXPECT_TRUE(says(picture, "no value"));
  // Without the gap the first curve, which is solid, is one piece from run 0 to 2; the doubtful run 3 is joined to nothing; there is a disc more, and no cross.
  ResponseChart data_without = data;
  data_without.panels[0].curves[0].points[2].y = 30;
  const Picture whole = response_chart(data_without, look_of(light_theme()));
  EXPECT_EQ(discs(whole).size(), 5u);
  EXPECT_FALSE(says(whole, "no value"));
  EXPECT_EQ(all_of<Trail>(picture).size(), all_of<Trail>(whole).size()) << "0 to 1, and 0 to 2";
  data_without.panels[0].curves[0].points[3].is_doubtful = false;
  EXPECT_EQ(discs(response_chart(data_without, look_of(light_theme()))).size(), 6u) << "a ring less";
  const auto crosses = [](const Picture& drawn) {
    return std::ranges::count_if(all_of<Capsule>(drawn), [](const Capsule& one) { return one.paint.fill == light_theme().muted; });
  };
  EXPECT_EQ(crosses(picture), crosses(whole) + 4) << "two strokes, and two before what is said of it";
  data.panels.clear();
  EXPECT_NO_THROW(response_chart(data, look_of(dark_theme()))) << "nothing to show";
}

// Runs have the marks of what they lack, and those that occur are told, in rows of their own where the title leaves no room.
TEST(ResponseChart, TellsWhatRunsWithoutAValueAre) {
  ResponseChart data{"Falls", "4 runs", "", {Scale::linear, 0, 3, "k"}, {{"instant [s]", true, {}}}, ""};
  data.lacks = {{"failed"}, {"tips, not down within 5 s", Marker::disc, 1}, {"stands for 5 s", Marker::disc, 2}};
  data.panels[0].curves = {{"down", {{0, 1.0}, {1, {}, false, 1}, {2, {}, false, 2}, {3, {}, false, 2}}}, {"tips", {{0, 1.0}, {1, 1.0}, {2, {}}, {3, {}}}}};
  for (const double text_scale : {1.0, 2.2}) {
    const Picture picture = response_chart(data, look_of(light_theme(), text_scale));
    expect_words_on_page(picture);
    EXPECT_TRUE(says(picture, "tips, not down within 5 s"));
    EXPECT_TRUE(says(picture, "stands for 5 s"));
    EXPECT_FALSE(says(picture, "failed")) << "negative control: no run has";
    const auto discs_of = [&](std::size_t curve) {
      return all_of<Ellipse>(picture, [&](const Ellipse& disc) { return disc.paint.fill == light_theme().curve[curve]; }).size();
    };
    EXPECT_EQ(discs_of(1), 2u) << "a run, and what is said of it";
    EXPECT_EQ(discs_of(2), 3u);
  }
}

TEST(StabilityMap, ColoursCellsByErrorAndHatchesFailures) {
  const StabilityMap data = sample_map(12, 8);
  const Picture picture = stability_map(data, look_of(light_theme()));
  const auto cells = all_of<Cells>(picture, [](const Cells& c) { return c.nx == 12; });
  ASSERT_EQ(cells.size(), 1u);
  int failed = 0;
  for (std::size_t i = 0; i < data.cells.size(); ++i) {
    EXPECT_EQ(cells[0].colors[i] == light_theme().grid, data.cells[i].failed) << i;
    failed += data.cells[i].failed;
  }
  ASSERT_GT(failed, 10);
  const auto hatch =
      all_of<Capsule>(picture, [](const Capsule& c) { return c.paint.fill == light_theme().base; });
  EXPECT_GT(hatch.size(), 10u);
  EXPECT_TRUE(says(picture, "failed"));

  StabilityMap stable = data;
  for (MapCell& cell : stable.cells) cell.failed = false;
  EXPECT_FALSE(says(stability_map(stable, look_of(light_theme())), "failed"));
}

// Beyond the end of the bar cells have none of its colours; on paper the map has three quarters of the width all the same.
TEST(StabilityMap, WhatIsWorseThanAllColoursIsPale) {
  StabilityMap data = sample_map(12, 8);
  EXPECT_FALSE(says(stability_map(data, look_of(light_theme())), "> 100 %"));
  data.most = 5e-4;
  data.pale = "> 100 %";
  data.error_title = "|energy error| / energy [%]";
  std::size_t beyond = 0;
  for (const MapCell& cell : data.cells) beyond += !cell.failed && cell.error > data.most;
  ASSERT_GE(beyond, 5u);
  for (const Theme* theme : {&light_theme(), &dark_theme()}) {
    const Picture picture = stability_map(data, look_of(*theme));
    EXPECT_TRUE(says(picture, "> 100 %"));
    expect_words_on_page(picture);
    const auto cells = all_of<Cells>(picture, [](const Cells& c) { return c.nx == 12; });
    std::map<std::string, std::size_t> colours;
    for (std::size_t i = 0; i < data.cells.size(); ++i)
      if (!data.cells[i].failed && data.cells[i].error > data.most) ++colours[std::to_string(cells[0].colors[i].r) + " " + std::to_string(cells[0].colors[i].g)];
    EXPECT_EQ(colours.size(), 1u) << "all alike";
  }
}

TEST(StabilityMap, ItsColoursGetLighterStepByStep) {
  const auto light = [](double share) {
    const Color c = map_color(share);
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
  };
  for (int i = 0; i < 50; ++i) EXPECT_LT(light(i / 50.0), light((i + 1) / 50.0)) << i;
  EXPECT_EQ(map_color(-3), map_color(0));
  EXPECT_EQ(map_color(NAN), map_color(0));
  EXPECT_EQ(map_color(7), map_color(1));
}

TEST(StabilityMap, AWrongNumberOfCellsIsAnError) {
  StabilityMap data = sample_map(4, 3);
  data.cells.pop_back();
  EXPECT_THROW(stability_map(data, look_of(light_theme())), Error);
}

// Of cells that know: a corner of two, a hole, and one that does not know.
TEST(EdgesBetween, RunAlongTheSidesOfCellsThatDiffer) {
  const std::optional<bool> yes = true, no = false, unknown;
  const auto corner = edges_between({yes, yes, no, yes, no, no}, 3, 2);
  ASSERT_EQ(corner.size(), 1u);
  ASSERT_EQ(corner[0].size(), 4u);
  const Point ends[] = {corner[0].front(), corner[0].back()};
  EXPECT_EQ(ends[0].x + ends[1].x, 3);
  EXPECT_EQ(ends[0].y + ends[1].y, 2);
  const auto hole = edges_between({yes, yes, yes, yes, no, yes, yes, yes, yes}, 3, 3);
  ASSERT_EQ(hole.size(), 1u);
  EXPECT_EQ(hole[0].size(), 5u);
  EXPECT_TRUE(edges_between({yes, unknown, no}, 3, 1).empty());
  EXPECT_TRUE(edges_between({yes, yes, yes, yes}, 2, 2).empty());
}

}  // namespace
}  // namespace chainreel
