// What a style makes of themes and pages.
#include "draw/page/house_style.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "draw/charts/chart_page.hpp"
#include "draw/page/sheet.hpp"
#include "draw/shapes.hpp"
#include "picture/plot.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(HouseStyle, ChangesTheThemeItIsOfAndNoOther) {
  Scene scene;
  scene.style.light["ink"] = {0x102030};
  scene.style.light["links"] = {0x112233, 0x445566};
  const Theme& light = page_theme(scene);
  EXPECT_EQ(light.ink, color_of(0x102030));
  EXPECT_EQ(light.link[2], color_of(0x112233)) << "two colours take turns";
  EXPECT_EQ(light.muted, light_theme().muted);
  EXPECT_EQ(&page_theme(scene), &light) << "the same style is one theme, which stays where it is";
  scene.theme = ThemeName::dark;
  EXPECT_EQ(page_theme(scene), dark_theme());
  scene.style = {};
  EXPECT_EQ(&page_theme(scene), &dark_theme());
}

// Three variants and more have the style's own colours as far as these go: curves, then sides.
TEST(HouseStyle, ColoursComparisonsOfThreeAndMore) {
  Scene page;
  page.style.light = {{"curves", {0xAA0000, 0x008800}}, {"side_a", {0x0000CC}}, {"side_b", {0x008800}}};
  const Theme& theme = page_theme(page);
  EXPECT_EQ(variant_color(theme, 0, 3), color_of(0xAA0000));
  EXPECT_EQ(variant_color(theme, 1, 3), color_of(0x008800));
  EXPECT_EQ(variant_color(theme, 2, 3), color_of(0x0000CC));
  EXPECT_EQ(variant_color(theme, 3, 4), curve_style(3, theme).color) << "the program's own behind them";
  EXPECT_EQ(variant_color(theme, 0, 2), color_of(0x0000CC));
  EXPECT_EQ(variant_color(light_theme(), 0, 3), curve_style(0, light_theme()).color) << "without a style";
}

TEST(HouseStyle, EachSingleColourHasItsPlaceInTheTheme) {
  for (const Name& color : kStyleColors) {
    Scene scene;
    scene.style.light[color.name] = {0x0A0B0C};
    EXPECT_FALSE(page_theme(scene) == light_theme()) << color.name;
  }
}

TEST(HouseStyle, SaysWhatCannotBeRead) {
  Scene scene;
  EXPECT_THAT(low_contrasts(scene), IsEmpty()) << "the program's own colours are not the style's";
  scene.style.light = {{"ink", {0x777777}}, {"base", {0x959595}}, {"grid", {0xFEFEFE}}};
  // 0x777777 has 4.48 with white, 0x959595 has 2.99: both just too little. A grid is decoration.
  const auto lines = low_contrasts(scene);
  EXPECT_THAT(lines, testing::Contains(HasSubstr("ink has a contrast of 4.4 with the background; words need 4.5: take a darker")));
  EXPECT_THAT(lines, testing::Contains(HasSubstr("base has a contrast of 2.9 with the background; marks need 3: take a darker")));
  scene.style.light = {{"ink", {0x767676}}, {"base", {0x949494}}, {"links", {0xFFFFFF}}};  // 4.54, 3.03
  EXPECT_THAT(low_contrasts(scene), IsEmpty());
  scene.style.light = {{"background", {0x808080}}};
  EXPECT_FALSE(low_contrasts(scene).empty()) << "a background is set against all that stands on it";
  scene.style.light = {{"links", {0x202020}}};
  EXPECT_THAT(low_contrasts(scene), IsEmpty()) << "it stands out from the page itself";
  scene.style.light = {{"links", {0xEEEEEE}}, {"ink", {0xAAAAAA}}};
  EXPECT_THAT(low_contrasts(scene), testing::Contains(HasSubstr("link 1 has a contrast of 2 with its outline")));
}

TEST(HouseStyle, IsSilentAboutColoursThatThePictureDoesNotShow) {
  Scene scene;
  scene.draw = default_layers();
  scene.style.light = {{"velocity", {0xFEFEFE}}, {"ellipse", {0xFEFEFE}}, {"side_a", {0xFEFEFE}}, {"torque", {0xFEFEFE}}, {"constraint", {0xFEFEFE}}};
  EXPECT_THAT(low_contrasts(scene), IsEmpty());
  scene.draw.push_back("velocity");
  EXPECT_THAT(low_contrasts(scene), testing::ElementsAre(HasSubstr("velocity has a contrast of 1")));
  scene.compare.resize(2);
  EXPECT_THAT(low_contrasts(scene), testing::Contains(HasSubstr("side_a has a contrast of 1")));
  Scene links;
  links.style.light = {{"links", {0xEEEEEE}}, {"ink", {0xAAAAAA}}};
  EXPECT_THAT(low_contrasts(links, 0), testing::Not(testing::Contains(HasSubstr("link 1")))) << "a model of meshes has none";
}

TEST(HouseStyle, SaysThatALogoVanishes) {
  const auto logo = [](std::uint8_t letters, std::uint8_t card, std::uint8_t opacity) {
    Image image(40, 20);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const bool is_letter = x % 4 == 0;
        std::uint8_t* p = &image.bgra[4 * (std::size_t(y) * 40 + std::size_t(x))];
        p[0] = p[1] = p[2] = is_letter ? letters : card;
        p[3] = is_letter ? 255 : opacity;
      }
    return std::make_shared<const Image>(image);
  };
  Scene scene;
  scene.theme = ThemeName::dark;
  scene.style.logo = Logo{.file = "logo.svg", .image = logo(0x20, 0, 0)};
  EXPECT_THAT(low_contrasts(scene), testing::ElementsAre(HasSubstr("the logo has a contrast of 1")));
  scene.style.logo->image = logo(0x20, 0xFF, 255);
  EXPECT_THAT(low_contrasts(scene), IsEmpty()) << "on a white card";
  scene.style.logo->image = logo(0xF0, 0, 0);
  EXPECT_THAT(low_contrasts(scene), IsEmpty());
  scene.theme = ThemeName::light;
  EXPECT_THAT(low_contrasts(scene), testing::ElementsAre(HasSubstr("take a darker one")));
}

TEST(HouseStyle, ContrastIsThatOfWcag) {
  EXPECT_NEAR(contrast(color_of(0xFFFFFF), color_of(0x000000)), 21, 1e-9);
  EXPECT_NEAR(contrast(color_of(0x777777), color_of(0xFFFFFF)), 4.478, 0.001);
  EXPECT_EQ(contrast(color_of(0x123456), color_of(0x123456)), 1);
}

// Corners of 8 x 4 px, the left half black, the right half transparent.
std::shared_ptr<const Image> two_halves() {
  auto image = std::make_shared<Image>(8, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) image->bgra[std::size_t(4 * (8 * y + x) + 3)] = 255;
  return image;
}

TEST(Logo, StandsInItsCornerOnWholePixelsAndWordsEndBesideIt) {
  const Fonts fonts;
  SheetText text;
  text.title = "A title that fills most of the width of this page, or so";
  text.longest_time = "t = 0.00 s";
  const Sheet plain = lay_out_sheet(text, 16.0 / 9, 1, light_theme(), fonts);
  for (const PageCorner corner : {PageCorner::top_right, PageCorner::top_left, PageCorner::bottom_right, PageCorner::bottom_left}) {
    text.logo = PageLogo{two_halves(), corner, 0.1, 1080};
    const Sheet sheet = lay_out_sheet(text, 16.0 / 9, 1, light_theme(), fonts);
    const Rect& box = sheet.logo_box;
    for (const double edge : {box.x0, box.x1, box.y0, box.y1}) EXPECT_NEAR(edge * 1080, std::round(edge * 1080), 1e-6);
    EXPECT_NEAR(box.width() / box.height(), 2, 0.02);
    const auto is_off = [&](const Rect& r) { return r.x1 <= box.x0 || r.x0 >= box.x1 || r.y1 <= box.y0 || r.y0 >= box.y1; };
    EXPECT_TRUE(is_off(sheet.scene)) << to_string(corner);
    for (const PlacedText& placed : sheet.texts) {
      const Rect& ink = placed.line.box;
      EXPECT_TRUE(is_off({placed.anchor.x + ink.x0, placed.anchor.y + ink.y0, placed.anchor.x + ink.x1, placed.anchor.y + ink.y1}))
          << to_string(corner);
    }
    EXPECT_TRUE(sheet.time_anchor.y < box.y0 || sheet.time_anchor.x <= box.x0 || sheet.time_anchor.y >= box.y1 || sheet.time_anchor.x > box.x1) << to_string(corner);
    EXPECT_LE(sheet.scene.height(), plain.scene.height());
  }
}

TEST(Logo, StandsOnChartsAndTheirWordsEndBesideIt) {
  const Fonts fonts;
  const ChartText text{"A title that fills most of the width of this page, or so", "what is below it, which is as long as that, and a little longer, so that it needs a second row",
                       "small words at the foot, which take more than one row of a page as narrow as this one is: machine, compiler, revision, and so on"};
  for (const PageCorner corner : {PageCorner::top_right, PageCorner::top_left, PageCorner::bottom_right, PageCorner::bottom_left}) {
    Picture picture;
    const Rect left = draw_chart_page(picture, text, {16.0 / 9, 1, &light_theme(), &fonts, PageLogo{two_halves(), corner, 0.1, 1080}});
    ASSERT_EQ(test::all_of<Cells>(picture).size(), 1u);
    const Rect box = test::all_of<Cells>(picture).front().rect;
    const auto is_off = [&](const Rect& r) { return r.x1 <= box.x0 || r.x0 >= box.x1 || r.y1 <= box.y0 || r.y0 >= box.y1; };
    // A logo at the foot stands beside the title of the axis, below its numbers.
    const PlotStyle style{&fonts, &light_theme(), 1};
    Rect numbers = lay_out_plot(left, {Scale::linear, 0, 1, "x"}, {Scale::linear, 0, 1, "y"}, style).box;
    numbers.y0 -= size::kPlotTick + style.text(size::kTick);
    EXPECT_TRUE(is_off(is_at_top(corner) ? left : numbers)) << to_string(corner);
    EXPECT_EQ(box.y0 > 0.5, is_at_top(corner));
    EXPECT_EQ(box.x0 < 0.5, is_at_left(corner));
    for (const GlyphRun& run : test::all_of<GlyphRun>(picture)) {
      ASSERT_FALSE(run.glyphs.empty());
      // From the first glyph to an em behind the last one's origin at most.
      EXPECT_TRUE(is_off({run.origin.x, run.origin.y, run.origin.x + run.glyphs.back().x + run.size / 2, run.origin.y + run.size / 2})) << to_string(corner) << run.text;
    }
  }
}

TEST(Logo, KeepsItsColoursWhereItIsMadeSmaller) {
  Picture picture;
  draw_logo(picture, *two_halves(), {0, 0, 4.0 / 100, 2.0 / 100}, 100);
  const Cells& cells = std::get<Cells>(picture.items.front().shape);
  ASSERT_EQ(cells.nx, 4);
  ASSERT_EQ(cells.ny, 2);
  EXPECT_EQ(cells.colors[1], color_of(0x000000));
  EXPECT_EQ(cells.colors[2].a, 0) << "what is transparent does not darken its neighbours";
}

}  // namespace
}  // namespace chainreel
