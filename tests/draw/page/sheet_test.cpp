#include "draw/page/sheet.hpp"
#include "draw/page/wrapped_words.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "draw/chains.hpp"
#include "draw/layers/ellipse.hpp"
#include "draw/page/scales.hpp"
#include "draw/shapes.hpp"

namespace chainreel {
namespace {

SheetText everything() {
  SheetText text;
  text.title = "RR under constant torques";
  text.torque = {"tau = (10, -100 y_G) N m"};
  text.longest_time = time_text(10);
  text.bar = "0.5 kg";
  text.bar_length = 0.1;
  text.legend = ellipse_legend(EllipseReading::mass);
  return text;
}

Sheet laid_out(const SheetText& text, double aspect = 16.0 / 9, double text_scale = 1) {
  return lay_out_sheet(text, aspect, text_scale, light_theme(), fonts());
}

std::vector<Rect> ink_boxes(const Sheet& sheet, const SheetText& text) {
  std::vector<Rect> boxes;
  for (const PlacedText& placed : sheet.texts) boxes.push_back(test::shifted(placed.line.box, placed.anchor));
  const TextLine time =
      lay_out_text(fonts(), text.longest_time,
                   {Face::label, scaled(size::kAxis, sheet.text_scale), light_theme().ink, Align::right});
  boxes.push_back(test::shifted(time.box, sheet.time_anchor));
  for (const PlacedEntry& entry : sheet.scales) {
    const double half = 0.011 * sheet.text_scale;
    boxes.push_back({entry.left.x, entry.left.y - half, entry.left.x + entry.line.width, entry.left.y + half});
  }
  if (sheet.bar)
    boxes.push_back(
        {sheet.bar->x, sheet.bar->y - 0.006, sheet.bar->x + sheet.bar_length, sheet.bar->y + 0.006});
  return boxes;
}

// Ink may lean over its advance by a side bearing.
constexpr double kBearing = 0.004;

void expect_tidy(const Sheet& sheet, const SheetText& text) {
  const double margin = size::kMargin * std::min(1.0, sheet.aspect);
  const Rect page{margin - kBearing, margin, sheet.aspect - margin + kBearing, 1 - margin};
  const std::vector<Rect> boxes = ink_boxes(sheet, text);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_TRUE(test::is_inside(page, boxes[i])) << i;
    EXPECT_FALSE(test::overlap(sheet.scene, boxes[i])) << i;
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(test::overlap(boxes[i], boxes[j])) << i << " and " << j;
  }
}

TEST(Sheet, KeepsItsTextsInsideThePageAndApart) {
  for (const double aspect : {16.0 / 9, 4.0 / 3, 1.0, 9.0 / 16}) {
    for (const double text_scale : {1.0, 1.5}) {
      SCOPED_TRACE(testing::Message() << aspect << " x " << text_scale);
      SheetText text = everything();
      if (aspect < 1) text.title = "RR falls";
      expect_tidy(laid_out(text, aspect, text_scale), text);
    }
  }
}

TEST(Sheet, KeepsScalesOfVectorsAndTheEquationApartFromEverythingElse) {
  for (const double aspect : {16.0 / 9, 4.0 / 3}) {
    for (const double text_scale : {1.0, 1.5}) {
      for (const int left_out : {0, 1, 2, 3}) {
        SCOPED_TRACE(testing::Message() << aspect << " x " << text_scale << " without " << left_out);
        SheetText text = everything();
        if (left_out >= 1) text.bar = text.legend = "";
        if (left_out >= 2) text.torque.clear();
        if (left_out >= 3) text.title = "";
        text.equation = "M(q) qdd + h(q, qd) + J_c^T lambda = tau";
        const Color ink = light_theme().ink;
        text.scales = {{ScaleEntry::Mark::turn, 3, ink, "torque 10 N m"},
                       {ScaleEntry::Mark::arrow, 0.19, ink, "velocity 5 m/s"},
                       {ScaleEntry::Mark::arrow, 0.11, ink, "weight 5 N"},
                       {ScaleEntry::Mark::dashed_arrow, 0.20, ink, "constraint force 20 N"},
                       {ScaleEntry::Mark::center_of_mass, 0, ink, "centre of mass"}};
        const Sheet sheet = laid_out(text, aspect, text_scale);
        EXPECT_EQ(sheet.scales.size(), 5u);
        expect_tidy(sheet, text);
      }
    }
  }
}

// Further rows of scales are closer than that of the time: what stands above them keeps off.
TEST(Sheet, HasAirAboveRowsOfScales) {
  const auto air_above = [](std::size_t entries, bool has_time) {
    SheetText text;
    if (has_time) text.longest_time = "t = 10.00 s";
    for (std::size_t i = 0; i < entries; ++i) text.scales.push_back({ScaleEntry::Mark::arrow, 0.19, light_theme().ink, "constraint force 20 N"});
    const Sheet sheet = laid_out(text, 1.0, 1.0);
    double top = 0;
    for (const PlacedEntry& entry : sheet.scales) top = std::max(top, entry.left.y);
    return sheet.scene.y0 - top;
  };
  const double alone = air_above(1, false), rows = air_above(5, true);
  EXPECT_NEAR(alone, size::kFooterBand / 2, 1e-9) << "of a row by itself there was enough";
  EXPECT_NEAR(rows, (0.75 + 0.4) * size::kAxis, 1e-9);
  EXPECT_NEAR(rows, alone, 0.1 * size::kAxis);
}

// Negative control: texts that do overlap are seen by the check above.
TEST(Sheet, TextsMovedTogetherWouldOverlap) {
  const SheetText text = everything();
  Sheet sheet = laid_out(text);
  sheet.texts.at(1).anchor = sheet.texts.at(0).anchor;
  EXPECT_TRUE(test::overlap(ink_boxes(sheet, text)[0], ink_boxes(sheet, text)[1]));
}

TEST(Sheet, LeavesTheWholePageToTheSceneWhereNothingIsSaid) {
  const Sheet sheet = laid_out({});
  EXPECT_NEAR(sheet.scene.height(), 1 - 2 * size::kMargin, 1e-12);
  EXPECT_NEAR(sheet.scene.width(), 16.0 / 9 - 2 * size::kMargin, 1e-12);
  SheetText title_only;
  title_only.title = "RR";
  const Sheet titled = laid_out(title_only);
  EXPECT_NEAR(titled.scene.height(), 1 - 2 * size::kMargin - size::kTitleBand, 1e-12);
}

TEST(Sheet, ShrinksALongTitleAndRefusesOneThatCannotBeRead) {
  SheetText text;
  text.title = "A title of rather many words that would not fit at its size";
  const Sheet sheet = laid_out(text, 4.0 / 3);
  EXPECT_LE(sheet.texts.at(0).line.advance, 4.0 / 3 - 2 * size::kMargin + 1e-9);
  EXPECT_LT(sheet.texts.at(0).line.runs.at(0).size, size::kTitle);
  EXPECT_GE(sheet.texts.at(0).line.runs.at(0).size, kSmallestText);
  for (int i = 0; i < 3; ++i) text.title += " and then some more";
  text.title_place = {"scenes/long.yaml", 2, 8};
  try {
    laid_out(text, 4.0 / 3);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), testing::HasSubstr("scenes/long.yaml:2:8: the title does not fit"));
  }
}

TEST(Sheet, WritesNothingSmallerThanTheSmallestSize) {
  for (const double text_scale : {0.5, 1.0, 1.5}) {
    for (const PlacedText& placed : laid_out(everything(), 4.0 / 3, text_scale).texts) {
      // Subscripts are smaller by the rules of mathematics: the base of each line counts.
      EXPECT_GE(placed.line.runs.at(0).size, kSmallestText);
    }
  }
}

TEST(Sheet, TakesTheFirstTorqueFormThatFits) {
  SheetText text;
  text.torque = {
      "tau = (1000000, 1000000, 1000000, 1000000, 1000000, 1000000, 1000000, 1000000, 1000000, 1000000)",
      "tau = (1, 2)", "tau = 3"};
  const TextLine line = laid_out(text, 9.0 / 16).texts.at(0).line;
  EXPECT_NEAR(line.advance,
              lay_out_math(fonts(), "tau = (1, 2)", {Face::math, size::kEquation}).advance, 1e-12);
}

TEST(Time, KeepsEveryDigitInItsPlace) {
  const Sheet sheet = laid_out(everything());
  const auto right_end = [&](double t) {
    Picture picture;
    draw_time(picture, sheet, t, fonts());
    const GlyphRun run = test::all_of<GlyphRun>(picture).at(0);
    return run.origin.x + run.glyphs.back().x;
  };
  EXPECT_NEAR(right_end(1.24), right_end(8.88), 1e-12);
  EXPECT_NEAR(right_end(1.11), right_end(10.00), 1e-12);
  EXPECT_EQ(time_text(1.2399999), "t = 1.24 s");
}

TEST(MetreBar, IsTheLargestRoundLengthWithinAQuarterOfTheScene) {
  EXPECT_DOUBLE_EQ(metre_bar_length(0.3, 1.69), 1);    // a quarter is 1.41 m
  EXPECT_DOUBLE_EQ(metre_bar_length(0.9, 1.69), 0.2);  // 0.47 m
  EXPECT_DOUBLE_EQ(metre_bar_length(0.08, 1.69), 5);   // 5.28 m
  EXPECT_DOUBLE_EQ(metre_bar_length(0.4225, 1.69), 1);
}

TEST(WrappedWords, AWordWiderThanALineEndsBehindItsHyphen) {
  const Fonts fonts;
  const TextStyle style{Face::label_bold, 0.03, light_theme().ink};
  const auto width_of = [&](const std::string& words) { return lay_out_words(fonts, words, style).advance; };
  const std::string name = "semi-implicit Euler";
  EXPECT_LT(lay_out_within(fonts, name, style, width_of("implicit")).box.width(), 1.02 * width_of("implicit"));
  // Negative control: where it has room it is whole, and a formula's minus is none.
  EXPECT_NEAR(lay_out_within(fonts, name, style, width_of(name)).box.width(), width_of(name), 0.1 * style.size);
  EXPECT_GT(lay_out_within(fonts, "$a-b-c-d$", style, width_of("$a-b$")).box.width(), 1.5 * width_of("$a-b$"));
}

}  // namespace
}  // namespace chainreel
