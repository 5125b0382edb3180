#include "picture/text.hpp"

#include <ft2build.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "core/error.hpp"
#include "core/hash.hpp"
#include "support/fonts.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

// Positions are a few sums of whole font units divided by the em: round-off of numbers of size 1.
constexpr double kTextRoundOff = 1e-14;

TextStyle label(double size, Align align = Align::left) {
  return {Face::label, size, color_of(0), align};
}

TEST(Text, MeasuresGrowWithTheSize) {
  const TextLine one = lay_out_text(fonts(), "Explicit Euler gains energy", label(0.03));
  const TextLine two = lay_out_text(fonts(), "Explicit Euler gains energy", label(0.06));
  EXPECT_GT(one.advance, 0.3);  // 27 letters of about half an em
  EXPECT_NEAR(two.advance, 2 * one.advance, kTextRoundOff);
  EXPECT_NEAR(two.box.x1, 2 * one.box.x1, kTextRoundOff);
  EXPECT_NEAR(two.box.y0, 2 * one.box.y0, kTextRoundOff);
}

TEST(Text, AlignmentMovesTheWholeLine) {
  const TextLine left = lay_out_text(fonts(), "t = 1.24 s", label(0.03, Align::left));
  const TextLine center = lay_out_text(fonts(), "t = 1.24 s", label(0.03, Align::center));
  const TextLine right = lay_out_text(fonts(), "t = 1.24 s", label(0.03, Align::right));
  EXPECT_EQ(left.runs.at(0).origin.x, 0);
  EXPECT_NEAR(center.runs.at(0).origin.x, -left.advance / 2, kTextRoundOff);
  EXPECT_NEAR(right.runs.at(0).origin.x, -left.advance, kTextRoundOff);
  EXPECT_NEAR(right.box.x1, left.box.x1 - left.advance, kTextRoundOff);
  EXPECT_EQ(right.box.y1, left.box.y1);
}

TEST(Text, InkBoxIsThatOfTheOutline) {
  const TextLine line = lay_out_text(fonts(), "g", label(1));
  FT_Face face = fonts().ft_face(Face::label);
  ASSERT_EQ(FT_Load_Char(face, 'g', FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING), 0);
  FT_BBox control;  // of the control points: never smaller than the ink, and equal where extrema are points
  FT_Outline_Get_CBox(&face->glyph->outline, &control);
  const double em = face->units_per_EM;
  EXPECT_NEAR(line.box.x0, double(control.xMin) / em, kTextRoundOff);
  EXPECT_NEAR(line.box.x1, double(control.xMax) / em, kTextRoundOff);
  EXPECT_NEAR(line.box.y0, double(control.yMin) / em, kTextRoundOff);
  EXPECT_NEAR(line.box.y1, double(control.yMax) / em, kTextRoundOff);
  EXPECT_LT(line.box.y0, -0.1);  // g has a descender
}

// Whatever stands first: d rises highest, g goes lowest.
TEST(Text, InkBoxHoldsEveryGlyph) {
  const auto box = [](const char* text) { return lay_out_text(fonts(), text, label(1)).box; };
  const Rect g = box("g"), d = box("d");
  for (const char* text : {"gxd", "dxg", "xgd", "xdg", "gdx", "g d"}) {
    EXPECT_EQ(box(text).y0, g.y0) << text;
    EXPECT_EQ(box(text).y1, d.y1) << text;
    EXPECT_GT(box(text).width(), g.width() + d.width() - kTextRoundOff) << text;
  }
}

TEST(Text, FiguresAreTabular) {
  std::set<double> advances;
  for (const char* number : {"0.00", "1.11", "4.77", "7.41", "1.74"})
    advances.insert(lay_out_text(fonts(), number, label(1)).advance);
  EXPECT_EQ(advances.size(), 1u);
  // Negative control: letters are not.
  EXPECT_NE(lay_out_text(fonts(), "iiii", label(1)).advance, lay_out_text(fonts(), "mmmm", label(1)).advance);
}

TEST(Text, PairsAreKerned) {
  const double apart =
      lay_out_text(fonts(), "A", label(1)).advance + lay_out_text(fonts(), "V", label(1)).advance;
  EXPECT_LT(lay_out_text(fonts(), "AV", label(1)).advance, apart - 0.01);
}

TEST(Text, TextWithoutInkHasAnAdvanceAndNoBox) {
  const TextLine blank = lay_out_text(fonts(), "  ", label(1));
  EXPECT_GT(blank.advance, 0);
  EXPECT_EQ(blank.box.width(), 0);
  EXPECT_TRUE(lay_out_text(fonts(), "", label(1)).runs.empty());
}

TEST(Text, MissingGlyphIsAnErrorThatNamesCharacterFaceAndPackage) {
  try {
    lay_out_text(fonts(), "arm \u5b57", label(1));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_renderer);
    EXPECT_THAT(error.what(), HasSubstr("U+5B57"));
    EXPECT_THAT(error.what(), HasSubstr("DejaVu Sans"));
    EXPECT_THAT(error.what(), HasSubstr("fonts-dejavu-core"));
  }
  // The same sign may be missing in one face only: subscript one is.
  EXPECT_NO_THROW(lay_out_text(fonts(), "q\u2081", label(1)));
  EXPECT_THROW(lay_out_text(fonts(), "q\u2081", {Face::math, 1, color_of(0), Align::left}), Error);
}

TEST(Text, ALineBreakIsAnErrorToo) {
  EXPECT_THROW(lay_out_text(fonts(), "one\ntwo", label(1)), Error);
}

TEST(Text, BytesThatAreNotUtf8AreAnError) {
  for (const char* bad : {"\xff", "a\x80", "\xc3", "\xe2\x82", "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80",
                          "\xf0\x80\x80\x80", "\xe0\x80\x80"}) {
    try {
      lay_out_text(fonts(), bad, label(1));
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input);
    }
  }
}

TEST(Text, Utf8IsReadAndWrittenBack) {
  const std::string text = "a\u00e9\u03c4\u2212\U0001D70F\U0010FFFF";
  const std::u32string decoded = decode_utf8(text);
  EXPECT_EQ(decoded, U"a\u00e9\u03c4\u2212\U0001D70F\U0010FFFF");
  EXPECT_EQ(encode_utf8(decoded), text);
}

TEST(Text, DrawingMovesRunsToTheAnchorAndKeepsTheWords) {
  Picture picture;
  const TextLine line = lay_out_text(fonts(), "t = 1 s", label(0.03, Align::right));
  draw_text(picture, line, {1.7, 0.05}, 3);
  ASSERT_EQ(picture.items.size(), 1u);
  EXPECT_EQ(picture.items[0].clip, 3);
  const auto& run = std::get<GlyphRun>(picture.items[0].shape);
  EXPECT_EQ(run.text, "t = 1 s");
  EXPECT_NEAR(run.origin.x, 1.7 - line.advance, kTextRoundOff);
  EXPECT_NEAR(run.origin.y, 0.05, kTextRoundOff);
}

TEST(Text, FacesAreKnownByFileAndHash) {
  for (const Face face : {Face::label, Face::label_bold, Face::math}) {
    std::ifstream file(fonts().file(face), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    ASSERT_GT(bytes.size(), 100000u);
    Sha256 hash;
    hash.add(std::as_bytes(std::span(bytes)));
    EXPECT_EQ(fonts().sha256(face), hash.finish());
  }
  EXPECT_NE(fonts().sha256(Face::label), fonts().sha256(Face::label_bold));
}

TEST(Text, MissingFontFileNamesItsPackage) {
  try {
    Fonts nowhere(std::vector<std::string>{"/nonexistent"});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_renderer);
    EXPECT_THAT(error.what(), HasSubstr("DejaVuSans.ttf"));
    EXPECT_THAT(error.what(), HasSubstr("fonts-dejavu-core"));
  }
  try {
    Fonts without_math(std::vector<std::string>{"/usr/share/fonts/truetype/dejavu"});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("fonts-lmodern"));
  }
}

}  // namespace
}  // namespace chainreel
