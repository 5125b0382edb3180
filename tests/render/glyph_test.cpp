// Text against FreeType itself, and the sheet that keeps its bitmaps.
#include <algorithm>

#include <ft2build.h>
#include <gtest/gtest.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "core/error.hpp"
#include "picture/theme.hpp"
#include "render/drawing.hpp"
#include "render/glyph_atlas.hpp"

namespace chainreel {
namespace {

constexpr int kGlyphWidth = 320, kGlyphHeight = 180;

Image draw_text_on(Canvas& canvas, const TextLine& line, Point anchor) {
  Picture picture;
  draw_text(picture, line, anchor);
  Image image;
  canvas.draw(picture, image);
  return image;
}

// Black glyphs on white by FreeType alone, pens on quarters of a pixel and baselines on whole ones.
Image by_freetype(const TextLine& line, Point anchor) {
  Image image(kGlyphWidth, kGlyphHeight);
  std::fill(image.bgra.begin(), image.bgra.end(), std::uint8_t(255));
  for (const GlyphRun& run : line.runs) {
    FT_Face face = fonts().ft_face(run.face);
    FT_Set_Char_Size(face, 0, FT_F26Dot6(std::lround(64 * run.size * kGlyphHeight)), 72, 72);
    for (const Glyph& glyph : run.glyphs) {
      const double x = kGlyphHeight * (anchor.x + run.origin.x + glyph.x),
                   y = kGlyphHeight * (1 - anchor.y - run.origin.y - glyph.y);
      const double quarter = std::round(4 * x) / 4;
      FT_Load_Glyph(face, glyph.index, FT_LOAD_NO_HINTING);
      FT_Outline_Translate(&face->glyph->outline, FT_Pos(64 * (quarter - std::floor(quarter))), 0);
      FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL);
      const FT_Bitmap& bitmap = face->glyph->bitmap;
      for (int row = 0; row < int(bitmap.rows); ++row)
        for (int column = 0; column < int(bitmap.width); ++column) {
          const int px = int(std::floor(quarter)) + face->glyph->bitmap_left + column;
          const int py = int(std::lround(y)) - face->glyph->bitmap_top + row;
          for (std::size_t k = 0; k < 3; ++k) {
            std::uint8_t& byte = image.bgra[std::size_t(4 * (py * kGlyphWidth + px)) + k];
            byte = std::uint8_t(std::lround(byte * (1 - bitmap.buffer[row * bitmap.pitch + column] / 255.0)));
          }
        }
    }
  }
  return image;
}

TEST(Glyphs, TextIsWhatFreeTypeDraws) {
  Canvas canvas(kGlyphWidth, kGlyphHeight, fonts());
  const TextStyle style = {Face::label, 0.1, kBlack, Align::left};
  for (const Point anchor : {Point{0.1, 0.5}, Point{0.1037, 0.4321}}) {
    const TextLine text = lay_out_text(fonts(), "Explicit g\u2212\u00c4", style);
    const TextLine math = lay_out_math(fonts(), "tau = (1, -y_G)^T N m", style);
    // Where glyphs overlap the order of rounding differs: one level.
    EXPECT_LE(largest_difference(draw_text_on(canvas, text, anchor), by_freetype(text, anchor)), 1);
    EXPECT_LE(largest_difference(draw_text_on(canvas, math, anchor), by_freetype(math, anchor)), 1);
    // Negative control: half a pixel beside it is another picture.
    const Point beside = anchor + Point{0.5 / kGlyphHeight, 0};
    EXPECT_GT(largest_difference(draw_text_on(canvas, text, anchor), by_freetype(text, beside)), 50);
  }
}

TEST(Glyphs, TextHasItsColor) {
  const Image image = draw_items({[] {
    TextStyle style = {Face::label_bold, 0.9, color_of(0xD55E00), Align::left};
    GlyphRun run = lay_out_text(fonts(), "I", style).runs.at(0);
    run.origin = {0.3, 0.2};
    return run;
  }()});
  bool found = false;
  for (int x = 0; x < kSide; ++x) found = found || image.at(x, kSide / 2) == Pixel{0xD5, 0x5E, 0x00, 255};
  EXPECT_TRUE(found);
}

TEST(Glyphs, TheSheetGrowsWithoutLosingGlyphs) {
  const TextStyle small = {Face::label, 0.06, kBlack, Align::left};
  const TextLine line = lay_out_text(fonts(), "kept apart", small);
  Canvas canvas(kGlyphWidth, kGlyphHeight, fonts());
  const Image before = draw_text_on(canvas, line, {0.2, 0.5});
  for (int i = 0; i < 60; ++i) {  // some megabytes of other glyphs
    TextStyle other = small;
    other.size = 0.5 + 0.01 * i;
    draw_text_on(canvas, lay_out_text(fonts(), "ABCDEFGHMNOPQRSTW", other), {0.0, 0.1});
  }
  EXPECT_EQ(largest_difference(draw_text_on(canvas, line, {0.2, 0.5}), before), 0);
}

TEST(Glyphs, GlyphsDoNotOverlapInTheSheet) {
  GlyphAtlas atlas(fonts(), 4096);
  std::vector<AtlasGlyph> glyphs;
  for (int size : {600, 2000, 900, 6400, 300})
    for (std::uint32_t index = 36; index < 80; ++index)
      for (int step = 0; step < GlyphAtlas::kSteps; ++step)
        glyphs.push_back(atlas.glyph(Face::label, index, size, step));
  std::vector<int> owner(std::size_t(atlas.width()) * std::size_t(atlas.height()), -1);
  for (std::size_t i = 0; i < glyphs.size(); ++i) {
    const AtlasGlyph& g = glyphs[i];
    ASSERT_LE(g.left + g.width, atlas.width());
    ASSERT_LE(g.top + g.height, atlas.height());
    for (int y = g.top; y < g.top + g.height; ++y)
      for (int x = g.left; x < g.left + g.width; ++x) {
        int& pixel = owner[std::size_t(y) * std::size_t(atlas.width()) + std::size_t(x)];
        ASSERT_EQ(pixel, -1) << "glyphs " << pixel << " and " << i;
        pixel = int(i);
      }
  }
}

TEST(Glyphs, TextBeyondTheSheetIsALimit) {
  GlyphAtlas atlas(fonts(), 600);
  EXPECT_NO_THROW(atlas.glyph(Face::label, 36, 64 * 100, 0));
  try {
    for (int size = 200; size < 400; size += 10) atlas.glyph(Face::label, 36, 64 * size, 0);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::limit);
  }
}

// At 640x360 with the letters of small pictures, 1.5 times the usual ones: any two digits differ clearly.
TEST(Glyphs, DigitsOfTickLabelsCanBeToldApartAt360Lines) {
  Canvas canvas(640, 360, fonts());
  std::vector<Image> digits;
  for (const char* digit : {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    const TextStyle style = {Face::label, 1.5 * size::kTick, light_theme().ink, Align::left};
    digits.push_back(draw_text_on(canvas, lay_out_text(fonts(), digit, style), {0.5, 0.5}));
  }
  for (std::size_t i = 0; i < digits.size(); ++i) {
    double ink = 0;
    int darkest = 255;
    for (std::size_t k = 0; k < digits[i].bgra.size(); k += 4) {
      ink += (255 - digits[i].bgra[k]) / 255.0;
      darkest = std::min(darkest, int(digits[i].bgra[k]));
    }
    EXPECT_LT(darkest, 90) << i;  // strokes of a pixel, not a grey haze
    for (std::size_t j = 0; j < i; ++j) {
      double differing = 0;
      for (std::size_t k = 0; k < digits[i].bgra.size(); k += 4)
        differing += std::abs(int(digits[i].bgra[k]) - int(digits[j].bgra[k])) / 255.0;
      EXPECT_GT(differing, 0.2 * ink) << j << " and " << i;
    }
  }
}

}  // namespace
}  // namespace chainreel
