#include "picture/text.hpp"

#include <ft2build.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "core/error.hpp"
#include "core/hash.hpp"
#include "support/fonts.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
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

const std::vector<std::string> kOwnFolders = {"/usr/share/fonts/truetype/dejavu", "/usr/share/texmf/fonts/opentype/public/lm-math"};

std::string refusal(const Fonts& fonts, const std::string& text) {
  try {
    lay_out_text(fonts, text, label(1));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_renderer);
    return error.what();
  }
  return "";
}

TEST(Text, CharactersThatNoFontHasNameTheirPackage) {
  const Fonts own(kOwnFolders);
  EXPECT_THAT(refusal(own, "arm \u5b57"), AllOf(HasSubstr("U+5B57 in 'arm \u5b57'"), HasSubstr("install the Debian package fonts-noto-cjk")));
  EXPECT_THAT(refusal(own, "\u306e"), HasSubstr("fonts-noto-cjk"));
  EXPECT_THAT(refusal(own, "\u0928\u092e"), HasSubstr("U+0928"));
  EXPECT_THAT(refusal(own, "\u0928\u092e"), HasSubstr("fonts-noto-core"));
  EXPECT_THAT(refusal(own, "\U0001F980"), HasSubstr("fonts-symbola"));
  EXPECT_THAT(refusal(own, "\ue000"), HasSubstr("which Unicode gives no meaning"));
  EXPECT_THAT(refusal(own, "a\x01"), HasSubstr("control character"));
  EXPECT_EQ(refusal(own, "q\u2081"), "");
  // The same sign may be missing in one face only: subscript one is, and formulas have no other.
  EXPECT_THROW(lay_out_math(own, "q\u5b57", {Face::math, 1, color_of(0), Align::left}), Error);
}

// A folder with the program's own fonts and one more.
class OtherScripts : public testing::Test {
 protected:
  const Fonts& with(const std::string& file, const std::string& package) {
    if (!std::filesystem::exists(file)) ADD_FAILURE() << "install the Debian package " << package;
    std::vector<std::string> folders = kOwnFolders;
    folders.push_back(std::filesystem::path(file).parent_path().string());
    fonts_ = std::make_unique<Fonts>(folders);
    return *fonts_;
  }
  const Fonts& with_chinese() {
    return with("/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf", "fonts-droid-fallback");
  }
  const Fonts& with_devanagari() { return with("/usr/share/fonts/truetype/lohit-devanagari/Lohit-Devanagari.ttf", "fonts-lohit-deva"); }

 private:
  std::unique_ptr<Fonts> fonts_;
};

std::string all_words(const TextLine& line) {
  std::string words;
  for (const GlyphRun& run : line.runs) words += (words.empty() ? "" : "|") + run.text;
  return words;
}

TEST_F(OtherScripts, TakeWhatIsMissingFromAnotherFaceAndTheRestFromTheOwn) {
  const Fonts& fonts = with_chinese();
  const TextLine line = lay_out_text(fonts, "arm \u6a5f\u68b0 2", label(0.1));
  ASSERT_EQ(line.runs.size(), 3u) << all_words(line);
  EXPECT_EQ(all_words(line), "arm |\u6a5f\u68b0| 2");
  EXPECT_EQ(line.runs[0].face, Face::label);
  EXPECT_EQ(int(line.runs[1].face), kOwnFaces);
  EXPECT_EQ(line.runs[2].face, Face::label);
  EXPECT_FALSE(line.runs[1].joins || line.runs[1].right_to_left);
  EXPECT_GT(line.runs[2].origin.x, line.runs[1].origin.x + 0.15) << "two of some 0.1";
  EXPECT_EQ(lay_out_text(fonts, "arm", label(0.1)).runs[0].face, Face::label);
  // Aligned as a whole.
  EXPECT_NEAR(lay_out_text(fonts, "arm \u6a5f\u68b0 2", label(0.1, Align::right)).runs[0].origin.x, -line.advance, kTextRoundOff);
}

TEST_F(OtherScripts, FacesThatStandInAreToldByFileAndHash) {
  const Fonts& fonts = with_chinese();
  lay_out_text(fonts, "arm", label(1));
  EXPECT_TRUE(fonts.fallbacks().empty());
  lay_out_text(fonts, "\u6a5f", label(1));
  lay_out_text(fonts, "\u68b0", label(1));
  ASSERT_EQ(fonts.fallbacks().size(), 1u);
  EXPECT_THAT(fonts.file(fonts.fallbacks()[0]), HasSubstr("DroidSansFallbackFull.ttf"));
  EXPECT_NE(fonts.sha256(fonts.fallbacks()[0]), fonts.sha256(Face::label));
}

TEST_F(OtherScripts, RightToLeftWordsStandInTheOrderInWhichTheyAreSeen) {
  // Hebrew, which DejaVu has: read shin, lamed; seen lamed, shin.
  const TextLine line = lay_out_text(fonts(), "ab \u05e9\u05dc 12 cd", label(0.1));
  EXPECT_EQ(all_words(line), "ab |12|\u05e9\u05dc | |cd") << "the number stands left of the word that is read before it";
  const GlyphRun& hebrew = line.runs.at(2);
  EXPECT_TRUE(hebrew.right_to_left);
  EXPECT_GT(hebrew.glyphs.front().character, hebrew.glyphs.back().character);
  // Words that begin to the right lead the whole line there.
  EXPECT_EQ(all_words(lay_out_text(fonts(), "\u05e9\u05dc ab", label(0.1))), "ab|\u05e9\u05dc ");
}

TEST_F(OtherScripts, ArabicLettersJoin) {
  const auto glyph = [](const TextLine& line, std::size_t i) { return line.runs.at(0).glyphs.at(i).index; };
  const TextLine word = lay_out_text(fonts(), "\u0628\u0628\u0628", label(1));  // three times beh
  ASSERT_EQ(word.runs.at(0).glyphs.size(), 3u);
  EXPECT_TRUE(word.runs[0].joins && word.runs[0].right_to_left);
  EXPECT_NE(glyph(word, 0), glyph(word, 1));
  EXPECT_NE(glyph(word, 1), glyph(word, 2));
  EXPECT_NE(glyph(word, 0), glyph(lay_out_text(fonts(), "\u0628", label(1)), 0));
}

TEST_F(OtherScripts, DevanagariSignsChangePlaces) {
  const Fonts& fonts = with_devanagari();
  const TextLine line = lay_out_text(fonts, "\u0915\u093f", label(1));  // ka with i, which is written before it
  ASSERT_EQ(line.runs.size(), 1u);
  EXPECT_TRUE(line.runs[0].joins);
  const TextLine ka = lay_out_text(fonts, "\u0915", label(1));
  ASSERT_EQ(line.runs[0].glyphs.size(), 2u);
  EXPECT_EQ(line.runs[0].glyphs[1].index, ka.runs[0].glyphs[0].index);
  EXPECT_EQ(line.runs[0].glyphs[0].character, 0u) << "both stand for the whole";
}

TEST_F(OtherScripts, FormulasKeepTheirPlaceAmongWords) {
  const TextLine line = lay_out_words(fonts(), "\u05e9\u05dc $tau$ \u05d0", label(0.1));
  ASSERT_EQ(line.runs.size(), 3u);
  EXPECT_EQ(line.runs[0].text, " \u05d0") << "read last, seen first";
  EXPECT_EQ(line.runs[1].face, Face::math);
  EXPECT_EQ(line.runs[2].text, "\u05e9\u05dc ");
  EXPECT_LT(line.runs[0].origin.x, line.runs[1].origin.x);
  EXPECT_LT(line.runs[1].origin.x, line.runs[2].origin.x);
}

// Whatever is given, no glyph is the box of a missing one.
TEST_F(OtherScripts, NoGlyphIsMissing) {
  const Fonts& fonts = with_chinese();
  for (const char* text : {"\u200f", "\u200d", "a\u0301\u0323", "\u0628\u200c\u0628", "\u202eabc\u202c \u6a5f", "\u2067\u05e9\u2069 a",
                           "(\u05e9) [\u6a5f]", "\u6a5f\ufe00", "\u06f1\u06f2\u06f3 \u0661\u0662", " \u6a5f ", "\u5b57\u3002\uff0c"})
    for (const GlyphRun& run : lay_out_text(fonts, text, label(1)).runs)
      for (const Glyph& glyph : run.glyphs) EXPECT_NE(glyph.index, 0u) << text;
}

TEST(Text, ALineBreakIsAnErrorToo) {
  EXPECT_THAT(refusal(fonts(), "one\ntwo"), HasSubstr("U+000A in 'one\ntwo' is a control character"));
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
