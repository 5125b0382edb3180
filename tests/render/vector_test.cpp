// The same shapes as vectors: against the canvas, and through independent readers.
#include <cairo.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "encode/png.hpp"
#include "render/drawing.hpp"
#include "render/test_card.hpp"
#include "render/vector_shapes.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int kPageWidth = 960, kPageHeight = 540;

// Edges differ by up to a pixel's coverage: the canvas keeps lines a pixel wide and sets text on whole rows,
// and each rasteriser has its own rule for what a pixel covers. Edges are a few per cent of the page;
// measured are 0.5 to 0.9.
constexpr double kMeanOfVectorEdges = 1.2;

Image by_canvas(const Picture& picture) {
  Canvas canvas(kPageWidth, kPageHeight, fonts());
  Image image;
  canvas.draw(picture, image);
  return image;
}

Image by_cairo(const Picture& picture) {
  Image image(kPageWidth, kPageHeight);
  cairo_surface_t* surface = cairo_image_surface_create_for_data(image.bgra.data(), CAIRO_FORMAT_ARGB32,
                                                                 kPageWidth, kPageHeight, 4 * kPageWidth);
  cairo_t* cairo = cairo_create(surface);
  paint_with_cairo(cairo, picture, fonts(), kPageHeight);
  cairo_surface_flush(surface);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return image;
}

Image by_rsvg(const Picture& picture) {
  const TemporaryFolder folder;
  const std::string svg = folder.write("page.svg", svg_text(picture, fonts(), {kPageHeight, "", "", ""}));
  const std::string png = folder.file("page.png");
  const ProgramResult result = run_command({"rsvg-convert", svg, "-o", png});
  EXPECT_EQ(result.status, 0) << result.err;
  return read_png(png);
}

Image by_poppler(const Picture& picture) {
  const TemporaryFolder folder;
  const std::string pdf = folder.write("page.pdf", pdf_text(picture, fonts(), {kPageHeight, "", "", ""}));
  const ProgramResult result =
      run_command({"pdftoppm", "-r", "72", "-png", "-singlefile", pdf, folder.file("page")});
  EXPECT_EQ(result.status, 0) << result.err;
  return read_png(folder.file("page.png"));
}

Picture whole_card() {
  return test_card(fonts(), light_theme());
}

// The worst difference of any pixel after averaging squares of nine by nine: shifts of edges by part of a
// pixel vanish, a shape that is missing or has another colour does not.
double worst_of_blurred(const Image& a, const Image& b) {
  constexpr int kReach = 4;
  double worst = 0;
  for (int y = kReach; y + kReach < a.height; y += 3)
    for (int x = kReach; x + kReach < a.width; x += 3) {
      std::array<double, 3> sum{};
      for (int dy = -kReach; dy <= kReach; ++dy)
        for (int dx = -kReach; dx <= kReach; ++dx) {
          const Pixel p = a.at(x + dx, y + dy), q = b.at(x + dx, y + dy);
          sum[0] += p.r - q.r, sum[1] += p.g - q.g, sum[2] += p.b - q.b;
        }
      for (const double s : sum) worst = std::max(worst, std::abs(s) / 81);
    }
  return worst;
}

// Text or an edge moved by half a row changes the mean over nine rows by up to half of 255 / 9 for each edge
// in them, and text has several (measured: 32); a lost line of text or a wrong fill changes it by more
// than 60.
constexpr double kWorstOfBlurred = 45;

class VectorPictures : public ::testing::TestWithParam<const char*> {
 protected:
  Image drawn(const Picture& picture) const {
    const std::string by = GetParam();
    return by == "cairo" ? by_cairo(picture) : by == "svg" ? by_rsvg(picture) : by_poppler(picture);
  }
};

TEST_P(VectorPictures, DifferFromTheCanvasAtEdgesAlone) {
  const Image expected = by_canvas(whole_card()), actual = drawn(whole_card());
  const PictureDifference difference = compare_pictures(actual, expected);
  ASSERT_TRUE(difference.same_size);
  EXPECT_LT(difference.mean, kMeanOfVectorEdges);
  EXPECT_LT(worst_of_blurred(actual, expected), kWorstOfBlurred);
}

// Negative control: each kind of shape is seen when it is missing.
TEST_P(VectorPictures, AMissingShapeIsNoticed) {
  const Image expected = by_canvas(whole_card());
  Picture less = whole_card();
  const auto largest_text = std::find_if(less.items.begin(), less.items.end(), [](const Item& item) {
    return std::holds_alternative<GlyphRun>(item.shape);
  });
  less.items.erase(largest_text);
  EXPECT_GT(worst_of_blurred(drawn(less), expected), kWorstOfBlurred);
  less = whole_card();
  std::erase_if(less.items, [](const Item& item) { return std::holds_alternative<Cells>(item.shape); });
  EXPECT_GT(worst_of_blurred(drawn(less), expected), kWorstOfBlurred);
}

// Large, so that a lost, moved or wrong letter is more than an edge.
Picture page_of_scripts() {
  Picture page;
  double y = 0.75;
  for (const char* words : {"\u0645\u0631\u062d\u0628\u0627 abc 12", "\u05e9\u05dc\u05d5\u05dd (ab)", "\u6a5f\u68b0 arm"}) {
    draw_text(page, lay_out_text(fonts(), words, {Face::label, 0.2, kBlack, Align::left}), {0.1, y});
    y -= 0.3;
  }
  return page;
}

TEST_P(VectorPictures, LettersOfOtherScriptsStandWhereTheCanvasHasThem) {
  const Image expected = by_canvas(page_of_scripts());
  EXPECT_LT(worst_of_blurred(drawn(page_of_scripts()), expected), kWorstOfBlurred);
  // Negative control: the words as they are read, not as they are seen.
  Picture turned = page_of_scripts();
  for (Item& item : turned.items)
    if (auto* run = std::get_if<GlyphRun>(&item.shape); run != nullptr && run->right_to_left)
      for (std::size_t i = 0, k = run->glyphs.size() - 1; i < k; ++i, --k) std::swap(run->glyphs[i].index, run->glyphs[k].index);
  EXPECT_GT(worst_of_blurred(drawn(turned), expected), kWorstOfBlurred);
}

INSTANTIATE_TEST_SUITE_P(All, VectorPictures, ::testing::Values("cairo", "svg", "pdf"));

TEST(Vector, CellsAreFlatAndExact) {
  Picture page;
  page.add(Cells{{0.25, 0.25, 0.75, 0.75},
                 2,
                 2,
                 {color_of(0x112233), color_of(0x445566), color_of(0x778899), color_of(0xAABBCC)}});
  for (const Image& image : {by_canvas(page), by_cairo(page), by_rsvg(page), by_poppler(page)}) {
    const auto at = [&](double x, double y) { return image.at(int(x * kPageHeight), int((1 - y) * kPageHeight)); };
    for (const double d : {0.02, 0.12, 0.23}) {
      EXPECT_EQ(at(0.25 + d, 0.25 + d), (Pixel{0x11, 0x22, 0x33}));
      EXPECT_EQ(at(0.75 - d, 0.25 + d), (Pixel{0x44, 0x55, 0x66}));
      EXPECT_EQ(at(0.25 + d, 0.75 - d), (Pixel{0x77, 0x88, 0x99}));
      EXPECT_EQ(at(0.75 - d, 0.75 - d), (Pixel{0xAA, 0xBB, 0xCC}));
    }
    EXPECT_EQ(at(0.24, 0.5), (Pixel{255, 255, 255}));
  }
}

Polygon rectangle_in_px(double left, double top, double right, double bottom, const Paint& paint) {
  const auto at = [](double x, double y) { return Point{x / kPageHeight, 1 - y / kPageHeight}; };
  Polygon polygon;
  polygon.count = 4;
  polygon.corners = {at(left, top), at(right, top), at(right, bottom), at(left, bottom)};
  polygon.paint = paint;
  return polygon;
}

TEST(Vector, ClipsOnWholePixelsAreExact) {
  Picture page;
  page.clips.push_back({100.0 / kPageHeight, 1 - 300.0 / kPageHeight, 250.0 / kPageHeight, 1 - 200.0 / kPageHeight});
  page.add(rectangle_in_px(50, 50, 600, 500, {kBlack, kNothing, 0}), 0);
  // A PDF has its numbers in decimals, and its reader takes a touched sixteenth of a pixel for one that is covered: two
  // of them at an edge.
  for (const auto& [image, least] : {std::pair{by_canvas(page), 255}, {by_cairo(page), 255}, {by_rsvg(page), 255},
                                     {by_poppler(page), 255 - 32}}) {
    for (const int x : {100, 101, 180, 248, 249}) {
      for (const int y : {200, 201, 298, 299}) EXPECT_EQ(image.at(x, y).g, 0) << x << " " << y;
      for (const int y : {198, 199, 300, 301}) EXPECT_GE(image.at(x, y).g, least) << x << " " << y;
    }
    for (const int y : {200, 250, 299})
      for (const int x : {98, 99, 250, 251}) EXPECT_GE(image.at(x, y).g, least) << x << " " << y;
  }
}

TEST(Vector, FillsShineThroughTranslucentStrokes) {
  Picture page;
  page.add(rectangle_in_px(100, 100, 300, 300, {color_of(0xFF0000), color_of(0x0000FF, 0.5), 16.0 / kPageHeight}));
  for (const Image& image : {by_canvas(page), by_cairo(page), by_rsvg(page), by_poppler(page)}) {
    const Pixel inside = image.at(200, 104), outside = image.at(200, 96);
    EXPECT_NEAR(inside.r, 127.5, 1.5);
    EXPECT_EQ(inside.g, 0);
    EXPECT_NEAR(inside.b, 127.5, 1.5);
    EXPECT_NEAR(outside.r, 127.5, 1.5);
    EXPECT_NEAR(outside.g, 127.5, 1.5);
    EXPECT_EQ(outside.b, 255);
  }
}

TEST(Vector, ShapesFadeTowardsEdges) {
  Picture page;
  Fade fade{{100.0 / kPageHeight, 1 - 400.0 / kPageHeight, 500.0 / kPageHeight, 1 - 100.0 / kPageHeight}};
  fade.left = 160.0 / kPageHeight, fade.top = 80.0 / kPageHeight;
  page.add(Ellipse{{300.0 / kPageHeight, 0.5}, {2, 1}, {-0.8, 1.6}, {kBlack, kNothing, 0}, fade});
  const Image canvas = by_canvas(page);
  EXPECT_NEAR(canvas.at(180, 300).g, 127, 2);  // else they were alike without it
  for (const Image& image : {by_cairo(page), by_rsvg(page), by_poppler(page)})
    for (int y = 92; y < 410; y += 5)
      for (int x = 93; x < 510; x += 5) ASSERT_NEAR(image.at(x, y).g, canvas.at(x, y).g, 255 / 64.0 + 2) << x << " " << y;
}

std::string words_of_pdf(const std::string& bytes) {
  const TemporaryFolder folder;
  const ProgramResult result = run_command({"pdftotext", "-layout", folder.write("page.pdf", bytes), "-"});
  EXPECT_EQ(result.status, 0) << result.err;
  return result.out;
}

TEST(Pdf, ItsWordsCanBeFound) {
  const std::string words = words_of_pdf(pdf_text(whole_card(), fonts(), {540, "Card", "all shapes", "kept"}));
  EXPECT_THAT(words, HasSubstr("Every primitive, once"));
  EXPECT_THAT(words, HasSubstr("t = 1.24 s"));
  Picture wordless = whole_card();
  std::erase_if(wordless.items,
                [](const Item& item) { return std::holds_alternative<GlyphRun>(item.shape); });
  EXPECT_THAT(words_of_pdf(pdf_text(wordless, fonts(), {})), Not(HasSubstr("primitive")));
}

TEST(Pdf, LigaturesAreFoundByTheirLetters) {
  Picture page;
  draw_text(page, lay_out_text(fonts(), "final office", {Face::label, 0.1, kBlack, Align::left}),
            {0.1, 0.5});
  EXPECT_THAT(words_of_pdf(pdf_text(page, fonts(), {})), HasSubstr("final office"));
}

TEST(Pdf, WordsThatRunToTheLeftAreFoundAsTheyAreRead) {
  const std::string words = words_of_pdf(pdf_text(page_of_scripts(), fonts(), {}));
  EXPECT_THAT(words, HasSubstr("\u0645\u0631\u062d\u0628\u0627"));
  EXPECT_THAT(words, HasSubstr("\u05e9\u05dc\u05d5\u05dd"));
  EXPECT_THAT(words, HasSubstr("\u6a5f\u68b0"));
}

TEST(Pdf, EqualPicturesGiveEqualBytesWithoutATime) {
  const std::string bytes = pdf_text(whole_card(), fonts(), {540, "Card", "", ""});
  EXPECT_EQ(bytes, pdf_text(whole_card(), fonts(), {540, "Card", "", ""}));
  EXPECT_THAT(bytes, Not(HasSubstr("CreationDate")));
}

TEST(Svg, HoldsItsWordsAsTextAndItsFonts) {
  const std::string svg = svg_text(whole_card(), fonts(), {540, "A <card>", "all & any", "kept"});
  EXPECT_THAT(svg, HasSubstr("<title>A &lt;card&gt;</title>"));
  EXPECT_THAT(svg, HasSubstr("<desc>all &amp; any</desc>"));
  EXPECT_THAT(svg, HasSubstr(">Every primitive, once</tspan>"));
  EXPECT_THAT(svg, HasSubstr("font-family:chainreel-math"));
  EXPECT_EQ(svg, svg_text(whole_card(), fonts(), {540, "A <card>", "all & any", "kept"}));
}

TEST(Svg, LettersThatJoinAreOutlinesAndTheOthersTextInTheirFont) {
  const std::string svg = svg_text(page_of_scripts(), fonts(), {1000, "", "", ""});
  EXPECT_THAT(svg, HasSubstr("aria-label=\"\u0645\u0631\u062d\u0628\u0627"));
  EXPECT_THAT(svg, Not(HasSubstr(">\u0645")));
  EXPECT_THAT(svg, HasSubstr("font-family=\"chainreel-other1,sans-serif\""));
  EXPECT_THAT(svg, HasSubstr(">\u6a5f\u68b0</tspan>"));
  EXPECT_THAT(svg, HasSubstr("@font-face{font-family:chainreel-other1"));
}

TEST(Svg, EveryCharacterHasItsPlace) {
  Picture page;
  draw_text(page, lay_out_text(fonts(), "AVA", {Face::label, 0.1, kBlack, Align::left}), {0.1, 0.5});
  std::smatch places;
  const std::string svg = svg_text(page, fonts(), {1000, "", "", ""});
  ASSERT_TRUE(
      std::regex_search(svg, places, std::regex("<tspan x=\"([0-9.]+) ([0-9.]+) ([0-9.]+)\">AVA</tspan>")));
  const GlyphRun run = lay_out_text(fonts(), "AVA", {Face::label, 0.1, kBlack, Align::left}).runs[0];
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(std::stod(places[i + 1]), 1000 * (0.1 + run.glyphs[i].x), 0.0006);  // half of the last digit
}

TEST(Trails, OfOneOpacityAreOnePath) {
  const auto runs = trail_runs({{{{0, 0}, 0.01, 1},
                                 {{1, 0}, 0.01, 1},
                                 {{1, 0}, 0.01, 0},
                                 {{2, 0}, 0.01, 0},
                                 {{2, 0}, 0.01, 1},
                                 {{3, 0}, 0.01, 1}},
                                kBlack});
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].lines.size(), 2u);
  EXPECT_TRUE(runs[0].round_ends);
  const auto fading = trail_runs({{{{0, 0}, 0.01, 0.2}, {{1, 0}, 0.01, 0.6}, {{2, 0}, 0.01, 1}}, kBlack});
  ASSERT_EQ(fading.size(), 2u);
  EXPECT_FALSE(fading[0].round_ends);
  EXPECT_NEAR(fading[0].alpha, 0.4, 1.0 / 64);  // half a level of 32
}

TEST(Vector, WhatIsNotFiniteIsLeftOut) {
  Picture page = whole_card(), broken = whole_card();
  broken.add(Capsule{{NAN, 0}, {1, 1}, 0.1, {kBlack, {}, 0}});
  broken.add(Ellipse{{0.5, 0.5}, {HUGE_VAL, 0}, {0, 0.1}, {kBlack, {}, 0}});
  broken.add(Cells{{0, 0, 1, 1}, 3, 3, {}});
  EXPECT_EQ(svg_text(page, fonts(), {}), svg_text(broken, fonts(), {}));
  EXPECT_EQ(pdf_text(page, fonts(), {}), pdf_text(broken, fonts(), {}));
}

}  // namespace
}  // namespace chainreel
