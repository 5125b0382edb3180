// Pages placed on a page, and the grid of a contact sheet.
#include "draw/figures/contact_sheet.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "draw/page/sheet.hpp"
#include "picture/place_picture.hpp"
#include "render/canvas.hpp"
#include "support/fonts.hpp"
#include "support/picture_compare.hpp"

namespace chainreel {
namespace {

constexpr double kAspect = 16.0 / 9.0;
constexpr double kSheetRoundOff = 1e-12;

ContactSheetLook look(double text_scale = 1, int columns = 0) {
  return {kAspect, columns, "", text_scale, size::kTick, &light_theme(), &fonts()};
}

// One of each shape that a page may hold, some of it cut by a clip, some beyond the page.
Picture full_page() {
  Picture page;
  const Color ink = color_of(0x1A1A1A), blue = color_of(0x56B4E9), red = color_of(0xD55E00);
  page.clips = {{0.2, 0.1, 1.2, 0.8}};
  page.add(Polygon{{Point{0.1, 0.1}, {1.7, 0.2}, {1.0, 0.9}}, 3, {blue.faded(0.4), ink, 0.02}}, 0);
  page.add(Capsule{{0.3, 0.3}, {1.1, 0.6}, 0.06, {blue, ink, 0.012}});
  page.add(Capsule{{0.1, 0.9}, {1.9, 0.5}, 0.01, {red, {}, 0}});
  page.add(Ellipse{{1.3, 0.5}, {0.2, 0.1}, {-0.05, 0.1}, {red.faded(0.3), red, 0.012}});
  page.add(Arc{{0.6, 0.7}, 0.15, 0.5, 3.0, 0.02, ink});
  page.add(Trail{{{{0.9, 0.2}, 0.03, 1}, {{1.2, 0.3}, 0.02, 0.6}, {{1.5, 0.2}, 0.01, 0.2}}, blue});
  page.add(Cells{{0.05, 0.5, 0.25, 0.7}, 2, 2, {ink, red, blue, ink}});
  draw_text(page, lay_out_text(fonts(), "Words 123", {Face::label, 0.12, ink}), {0.9, 0.8});
  return page;
}

Image drawn(const Picture& picture, int width, int height) {
  Canvas canvas(width, height, fonts());
  Image image;
  canvas.draw(picture, image);
  return image;
}

Image part(const Image& image, int x0, int y0, int width, int height) {
  Image cut(width, height);
  for (int y = 0; y < height; ++y)
    std::copy_n(&image.bgra[4 * (std::size_t(y0 + y) * std::size_t(image.width) + std::size_t(x0))],
                4 * std::size_t(width), &cut.bgra[4 * std::size_t(y) * std::size_t(width)]);
  return cut;
}

bool is_white(const Image& image) {
  for (const std::uint8_t byte : image.bgra)
    if (byte != 255) return false;
  return true;
}

// A page in the lower left quarter of one twice as large has the pixels that it has by itself: shapes are
// drawn by distance in pixels, so only round-off may differ, and a glyph's place in the atlas.
TEST(PlacePicture, KeepsThePixelsOfEveryShape) {
  Picture sheet;
  sheet.aspect = kAspect;
  place_picture(sheet, full_page(), {{0, 0, kAspect / 2, 0.5}});
  const Image image = drawn(sheet, 1280, 720), alone = drawn(full_page(), 640, 360);
  EXPECT_TRUE(pictures_agree(part(image, 0, 360, 640, 360), alone, {.max = 8, .mean = 0.05}, "placed_page"));
  // What lay beyond the page's edge is cut there.
  EXPECT_TRUE(is_white(part(image, 641, 0, 639, 720)));
  EXPECT_TRUE(is_white(part(image, 0, 0, 1280, 359)));
}

TEST(PlacePicture, StandsInTheMiddleOfACellOfOtherProportions) {
  Picture page, sheet;
  page.aspect = 2;
  page.add(Ellipse{{1, 0.5}, {0.1, 0}, {0, 0.1}, {color_of(0), {}, 0}});
  place_picture(sheet, page, {{0.2, 0.1, 0.6, 0.9}});  // 0.4 wide: 0.2 high, from 0.4 on
  ASSERT_EQ(sheet.items.size(), 1u);
  const Ellipse& disc = std::get<Ellipse>(sheet.items[0].shape);
  EXPECT_NEAR(disc.center.x, 0.4, kSheetRoundOff);
  EXPECT_NEAR(disc.center.y, 0.5, kSheetRoundOff);
  EXPECT_NEAR(disc.u.x, 0.02, kSheetRoundOff);
  const Rect& edges = sheet.clips[std::size_t(sheet.items[0].clip)];
  EXPECT_NEAR(edges.y0, 0.4, kSheetRoundOff);
  EXPECT_NEAR(edges.y1, 0.6, kSheetRoundOff);
}

TEST(PlacePicture, CutsOffTheMargin) {
  Picture page, sheet;
  page.aspect = 2;
  page.add(Ellipse{{1, 0.5}, {0.1, 0}, {0, 0.1}, {color_of(0), {}, 0}});
  // Of 2 x 1 there remain 1.6 x 0.6: twice as large in a cell of 3.2 x 1.2.
  place_picture(sheet, page, {.cell = {0.1, 0.1, 3.3, 1.3}, .margin = 0.2});
  const Ellipse& disc = std::get<Ellipse>(sheet.items[0].shape);
  EXPECT_NEAR(disc.center.x, 1.7, kSheetRoundOff);
  EXPECT_NEAR(disc.center.y, 0.7, kSheetRoundOff);
  EXPECT_NEAR(disc.u.x, 0.2, kSheetRoundOff);
  const Rect& edges = sheet.clips[std::size_t(sheet.items[0].clip)];
  EXPECT_NEAR(edges.x0, 0.1, kSheetRoundOff);
  EXPECT_NEAR(edges.y1, 1.3, kSheetRoundOff);
}

TEST(PlacePicture, LeavesOutWordsThatCannotBeReadAndKeepsLinesThatCanBeSeen) {
  Picture page, sheet;
  const Color ink = color_of(0);
  for (const double size : {0.2, 0.25})
    draw_text(page, lay_out_text(fonts(), "x", {Face::label, size, ink}), {0, 0.5});
  page.add(Capsule{{0, 0}, {1, 1}, 0.005, {ink, {}, 0}});
  page.add(Ellipse{{1, 0.5}, {0.1, 0}, {0, 0.1}, {{}, ink, 0.004}});
  page.add(Capsule{{0, 0}, {1, 1}, 0.1, {ink, {}, 0}});
  place_picture(sheet, page, {{0, 0, kAspect / 10, 0.1}, 0.002, 0.022});
  ASSERT_EQ(sheet.items.size(), 4u);
  EXPECT_NEAR(std::get<GlyphRun>(sheet.items[0].shape).size, 0.025, kSheetRoundOff);
  EXPECT_NEAR(std::get<Capsule>(sheet.items[1].shape).radius, 0.001, kSheetRoundOff);
  EXPECT_NEAR(std::get<Ellipse>(sheet.items[2].shape).paint.stroke_width, 0.002, kSheetRoundOff);
  EXPECT_NEAR(std::get<Capsule>(sheet.items[3].shape).radius, 0.01, kSheetRoundOff);
}

TEST(PlacePicture, LeavesOutTheHalosOfWordsThatCannotBeRead) {
  Picture page;
  const Color ink = color_of(0);
  for (const double size : {0.2, 0.25}) {
    const TextLine line = lay_out_text(fonts(), "x", {Face::label, size, ink});
    draw_halo(page, line, {0.1, 0.5}, page.background, 0.01);
    draw_text(page, line, {0.1, 0.5});
  }
  Picture sheet;
  place_picture(sheet, page, {.cell = {0, 0, kAspect / 10, 0.1}, .smallest_text = 0.022});
  ASSERT_EQ(sheet.items.size(), 2u);  // of the larger words
  EXPECT_NEAR(std::get<GlyphRun>(sheet.items[0].shape).stroke_width, 0.002, kSheetRoundOff);
  EXPECT_EQ(std::get<GlyphRun>(sheet.items[1].shape).stroke_width, 0);
}

TEST(ContactGrid, HasRoomForAnyNumberOfPictures) {
  for (int count = 1; count <= kMostCells; ++count) {
    const ContactGrid grid = contact_grid(count, look());
    ASSERT_EQ(int(grid.pictures.size()), count);
    EXPECT_GE(grid.columns * grid.lines, count);
    EXPECT_LT((grid.lines - 1) * grid.columns, count) << "a line is empty";
    for (int i = 0; i < count; ++i) {
      const Rect& picture = grid.pictures[std::size_t(i)];
      const Rect& title = grid.titles[std::size_t(i)];
      EXPECT_LE(picture.width() / picture.height(), kCellAspect * (1 + 1e-9));
      EXPECT_GE(picture.width() / picture.height(), kTallestCell * (1 - 1e-9));
      EXPECT_GE(picture.x0, size::kMargin - kSheetRoundOff);
      EXPECT_LE(picture.x1, kAspect - size::kMargin + kSheetRoundOff);
      EXPECT_LE(picture.y1, 1 - size::kMargin + kSheetRoundOff);
      EXPECT_GE(title.y0, size::kMargin - kSheetRoundOff);
      if (i >= grid.columns) {
        EXPECT_LT(picture.y1, grid.titles[std::size_t(i - grid.columns)].y0);
      }
    }
    EXPECT_GE(grid.text_size, kSmallestText);
  }
}

// An upright page of six pictures in two columns has room below them, which a chain that swings all around can use.
TEST(ContactGrid, HasTallerPicturesWhereThePageHasRoom) {
  ContactSheetLook upright = look();
  upright.aspect = 1 / 1.4142;
  const ContactGrid grid = contact_grid(6, upright), row = contact_grid(9, look());
  EXPECT_EQ(grid.columns, 2);
  EXPECT_LT(grid.pictures[0].width() / grid.pictures[0].height(), 1.35);  // 1.78 before
  EXPECT_LT(grid.page_aspect(), grid.pictures[0].width() / grid.pictures[0].height()) << "the margin is cut off all around";
  EXPECT_NEAR(row.pictures[0].width() / row.pictures[0].height(), kCellAspect, 1e-9) << "three lines leave none";
}

TEST(ContactGrid, TakesTheColumnsThatMakePicturesLargest) {
  for (const int count : {2, 5, 17, 48}) {
    const double chosen = contact_grid(count, look()).pictures[0].width();
    for (int columns = 1; columns <= count; ++columns) {
      try {
        EXPECT_LE(contact_grid(count, look(1, columns)).pictures[0].width(), chosen * (1 + 1e-6));
      } catch (const Error&) {
        continue;  // too small to show anything
      }
    }
  }
  EXPECT_EQ(contact_grid(17, look(1, 6)).columns, 6);
  EXPECT_EQ(contact_grid(3, look(1, 6)).columns, 3);
}

// Where the height decides on the pictures, words have the width that is left.
TEST(ContactGrid, HasTitlesAsWideAsItsColumns) {
  ContactSheetLook four_lines = look(1, 5);
  four_lines.title_lines = 4;
  const ContactGrid grid = contact_grid(20, four_lines);
  EXPECT_GT(grid.titles[0].width(), 1.2 * grid.pictures[0].width());
  for (int i = 0; i < 20; ++i) {
    EXPECT_GE(grid.titles[i].x0, size::kMargin - kSheetRoundOff);
    EXPECT_LE(grid.titles[i].x1, kAspect - size::kMargin + kSheetRoundOff);
    if (i % 5 > 0) EXPECT_GT(grid.titles[i].x0, grid.titles[i - 1].x1);
  }
  EXPECT_EQ(contact_grid(2, look(1, 2)).titles[0].width(), contact_grid(2, look(1, 2)).pictures[0].width()) << "negative control: the width decides";
}

TEST(ContactGrid, SaysWhatDoesNotFit) {
  EXPECT_THROW(contact_grid(kMostCells + 1, look()), Error);
  EXPECT_THROW(contact_grid(40, look(1, 40)), Error);
  EXPECT_THROW(contact_grid(40, look(1, 1)), Error);
}

// Words of a page at that scale have at least the smallest size of the sheet, or there are none.
TEST(ContactGrid, ShowsWordsInPicturesThatAreLargeEnough) {
  for (const double text_scale : {1.0, 1.5}) {
    const ContactGrid large = contact_grid(1, look(text_scale)), small = contact_grid(17, look(text_scale));
    const double height = large.pictures[0].height() / (1 - 2 * size::kMargin);
    EXPECT_GE(text_scale_in(large) * size::kAxis * height, text_scale * kSmallestText * (1 - kSheetRoundOff));
    EXPECT_LT(text_scale_in(small), 0.01);
  }
}

std::vector<std::string> words_on(const Picture& picture) {
  std::vector<std::string> words;
  for (const Item& item : picture.items)
    if (const GlyphRun* run = std::get_if<GlyphRun>(&item.shape)) words.push_back(run->text);
  return words;
}

TEST(ContactSheet, BreaksTitlesAndCutsWhatDoesNotFit) {
  const ContactGrid grid = contact_grid(16, look());
  const std::string word = "Überschwinger";
  std::string endless = word;
  for (int i = 0; i < 20; ++i) endless += " " + word;
  const std::vector<ContactCell> cells{{Picture{}, "Short"}, {Picture{}, endless}};
  const std::vector<std::string> words = words_on(draw_contact_sheet(grid, cells, look()));
  ASSERT_EQ(words.size(), 3u);
  EXPECT_EQ(words[0], "Short");
  EXPECT_TRUE(words[1].starts_with(word) && words[1].ends_with(word)) << words[1];
  EXPECT_TRUE(words[2].starts_with(word) && words[2].ends_with("\u2026")) << words[2];
  for (const std::string& line : words)
    EXPECT_LE(lay_out_text(fonts(), line, {Face::label, grid.text_size, {}}).advance, grid.titles[0].width());
}

}  // namespace
}  // namespace chainreel
