// Every kind of picture by two renderers that share no code but the list of shapes: OSMesa's pixels and
// Cairo's.

#include <cairo.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "app/all_pictures.hpp"
#include "app/film/target.hpp"
#include "app/print_pictures.hpp"
#include "encode/png.hpp"
#include "picture/theme.hpp"
#include "render/vector_shapes.hpp"
#include "support/fonts.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

constexpr int kCardWidth = 960, kCardHeight = 540;

// On the page's background, so that what is transparent can be compared, too: Cairo's opacity is
// premultiplied.
Image by_cairo(const Picture& picture) {
  Image image(kCardWidth, kCardHeight);
  cairo_surface_t* surface = cairo_image_surface_create_for_data(image.bgra.data(), CAIRO_FORMAT_ARGB32,
                                                                 kCardWidth, kCardHeight, 4 * kCardWidth);
  cairo_t* cairo = cairo_create(surface);
  paint_with_cairo(cairo, picture, fonts(), kCardHeight);
  cairo_surface_flush(surface);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return image;
}

int difference(Pixel p, Pixel q) {
  return std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
}

// Pixels within `reach` of one that differs from its right or lower neighbour: edges of the reference.
std::vector<bool> edges_of(const Image& image, int contrast, int reach) {
  std::vector<bool> edge(std::size_t(image.width) * std::size_t(image.height));
  for (int y = 0; y + 1 < image.height; ++y)
    for (int x = 0; x + 1 < image.width; ++x) {
      const Pixel p = image.at(x, y);
      if (difference(p, image.at(x + 1, y)) <= contrast && difference(p, image.at(x, y + 1)) <= contrast)
        continue;
      for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + 1 + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + 1 + reach); ++u)
          edge[std::size_t(v) * std::size_t(image.width) + std::size_t(u)] = true;
    }
  return edge;
}

struct Comparison {
  double mean = 0;     // over all channels of all pixels
  int max = 0;         // anywhere
  int flat = 0;        // the largest away from edges
  int x = -1, y = -1;  // where that is
  double edges = 0;    // part of the page
};

// Edges of the reference are within kReach pixels of where a neighbour differs by more than kContrast.
constexpr int kContrast = 2, kReach = 1;

Comparison compare(const Image& actual, const Image& reference) {
  const std::vector<bool> edge = edges_of(reference, kContrast, kReach);
  Comparison result;
  result.mean = compare_pictures(actual, reference).mean;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x) {
      const int d = difference(actual.at(x, y), reference.at(x, y));
      result.max = std::max(result.max, d);
      if (edge[std::size_t(y) * std::size_t(reference.width) + std::size_t(x)])
        result.edges += 1.0 / (reference.width * reference.height);
      else if (d > result.flat)
        result.flat = d, result.x = x, result.y = y;
    }
  return result;
}

// At an edge the canvas keeps lines a pixel wide and sets text on whole rows, Cairo does neither: up to the
// contrast there. The mean is that of edges that are up to a fifth of the page.
constexpr double kMean = 2.0;
// Both round each blended layer to 8 bits on its own: one or two for the few layers that lie over each other;
// trails that fade are cut into 32 opacities by Cairo.
constexpr int kFlat = 4;
// The fading fill of an open ellipse is sixteen layers of one per cent: up to one level each.
constexpr int kFlatOfOpenFill = 17;
constexpr const char* kWithOpenFill[] = {"layers_all",    "ellipse_row",   "ellipse_superposed_row",
                                         "ellipse_field", "ellipse_along", "ellipse_grid"};

class TwoRenderers : public ::testing::TestWithParam<test::AnyPicture> {};

INSTANTIATE_TEST_SUITE_P(All, TwoRenderers, ::testing::ValuesIn(test::all_pictures()),
                         [](const auto& p) { return p.param.name; });

TEST_P(TwoRenderers, DifferAtEdgesAlone) {
  for (const char* theme : {"light", "dark"}) {
    Picture picture = GetParam().draw({theme, kCardWidth, kCardHeight, 1}, fonts());
    picture.background.a = 1;
    const Comparison found = compare(by_cairo(picture), rasterise(picture, kCardWidth, kCardHeight, fonts()));
    RecordProperty(std::string(theme) + "_mean", std::to_string(found.mean));
    RecordProperty(std::string(theme) + "_max", found.max);
    RecordProperty(std::string(theme) + "_flat", found.flat);
    if (std::getenv("CHAINREEL_SHOW_NUMBERS"))
      std::printf("%-24s %-5s mean %.3f max %d flat %d at (%d, %d) edges %.3f\n", GetParam().name.c_str(),
                  theme, found.mean, found.max, found.flat, found.x, found.y, found.edges);
    EXPECT_LT(found.mean, kMean) << theme;
    const bool open = std::ranges::find(kWithOpenFill, GetParam().name) != std::end(kWithOpenFill);
    EXPECT_LE(found.flat, open ? kFlatOfOpenFill : kFlat)
        << theme << " at (" << found.x << ", " << found.y << ")";
  }
}

Image by_rsvg(const Picture& picture) {
  const TemporaryFolder folder;
  const std::string svg = folder.write("page.svg", svg_text(picture, fonts(), {kCardHeight, "", "", ""}));
  const ProgramResult result = run_command({"rsvg-convert", svg, "-o", folder.file("page.png")});
  EXPECT_EQ(result.status, 0) << result.err;
  return result.status == 0 ? read_png(folder.file("page.png")) : Image(kCardWidth, kCardHeight);
}

// Poppler sets letters by its own hinting: up to 2.5 on pages full of words. Against a page without its
// picture that is a third at most.
constexpr double kMeanOfReaders = 3, kMostLost = 0.4;

std::string without_spaces(std::string text) {
  const std::string thin = "\u2009";
  for (std::size_t at; (at = text.find(thin)) != std::string::npos;) text.erase(at, thin.size());
  std::erase_if(text, [](unsigned char c) { return std::isspace(c); });
  return text;
}

void expect_words_of(const Picture& picture, const std::string& pdf) {
  const ProgramResult result = run_command({"pdftotext", "-raw", pdf, "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string words = without_spaces(result.out);
  for (const Item& item : picture.items)
    if (const auto* run = std::get_if<GlyphRun>(&item.shape); run && run->face != Face::math)
      EXPECT_THAT(words, testing::HasSubstr(without_spaces(run->text)));
  EXPECT_THAT(words, testing::Not(testing::HasSubstr("nosuchword")));
}

// Vector pages through readers that are not ours: the picture is there, and the words of a PDF can be sought. Theirs are
// the renderers of librsvg and Poppler, so the mean alone is compared.
TEST_P(TwoRenderers, ReadersOfSvgAndPdfShowThePictureAndItsWords) {
  Picture picture = GetParam().draw({"light", kCardWidth, kCardHeight, 1}, fonts());
  picture.background.a = 1;
  const Image reference = rasterise(picture, kCardWidth, kCardHeight, fonts());
  Image empty(kCardWidth, kCardHeight);
  std::fill(empty.bgra.begin(), empty.bgra.end(), std::uint8_t(255));
  const PictureDifference nothing = compare_pictures(empty, reference);
  const PictureDifference svg = compare_pictures(by_rsvg(picture), reference);
  ASSERT_TRUE(svg.same_size);
  EXPECT_LT(svg.mean, kMeanOfReaders);
  EXPECT_LT(svg.mean, kMostLost * nothing.mean);  // negative control: most of what is drawn is seen

  const TemporaryFolder folder;
  const std::string pdf = folder.write("page.pdf", pdf_text(picture, fonts(), {kCardHeight, "", "", ""}));
  ASSERT_EQ(run_command({"pdftoppm", "-r", "72", "-png", "-singlefile", pdf, folder.file("pdf")}).status, 0);
  const PictureDifference page = compare_pictures(read_png(folder.file("pdf.png")), reference);
  ASSERT_TRUE(page.same_size);
  EXPECT_LT(page.mean, kMeanOfReaders);
  EXPECT_LT(page.mean, kMostLost * nothing.mean);
  expect_words_of(picture, pdf);
}

// Negative control: a disc in the background that only one of them has, faint and small.
TEST(TwoRenderers, AFaintShapeMoreIsSeen) {
  Picture picture = test::all_pictures().front().draw({"light", kCardWidth, kCardHeight, 1}, fonts());
  const Image reference = rasterise(picture, kCardWidth, kCardHeight, fonts());
  picture.add(Ellipse{{0.02, 0.5}, {0.01, 0}, {0, 0.01}, {color_of(0x000000, 0.03), {}, 0}});
  EXPECT_GT(compare(by_cairo(picture), reference).flat, kFlat);
}

}  // namespace
}  // namespace chainreel
