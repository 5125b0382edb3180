// Every scene of assets/scenes as somebody reads it: how high its smallest word is on a phone, how strongly words and marks
// stand out in its pixels, and how much of the page the scene keeps in other formats.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/report/run_report.hpp"
#include "draw/film/compose.hpp"
#include "draw/film/film.hpp"
#include "draw/page/house_style.hpp"
#include "render/canvas.hpp"
#include "support/fonts.hpp"
#include "support/scene_names.hpp"

namespace chainreel::reading {
namespace {

constexpr double kSecondScript = 0.5;  // of its line, an index of an index

// A scene with another page, few frames a second, and one of them.
struct Page {
  PreparedFilm film;
  Runs runs;
  Film pictures;
  Picture picture;

  Page(const std::string& scene, std::vector<std::string> overrides)
      : film(load_film("assets/scenes/" + scene + ".yaml", with_few_frames(std::move(overrides)), true, true)),
        runs(film),
        pictures(runs.pictures(runs.frames_shown(int(runs.times().size())), fonts())) {
    const int k = int(0.4 * pictures.frame_count());
    picture = pictures.static_layer();
    picture.append(pictures.frame(k));
  }
  static std::vector<std::string> with_few_frames(std::vector<std::string> overrides) {
    overrides.push_back("video.fps=10");
    return overrides;
  }
};

std::vector<std::string> size_of(int width, int height) {
  return {"video.width=" + std::to_string(width), "video.height=" + std::to_string(height)};
}

bool is_halo(const GlyphRun& run) {
  return run.stroke_width > 0;
}

bool is_exponent(const std::string& text) {
  return text.find_first_not_of("0123456789\u2212") == std::string::npos;
}

class ReadingOfEveryScene : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Assets, ReadingOfEveryScene, ::testing::ValuesIn(test::scene_names()),
                         [](const auto& p) { return p.param; });

TEST_P(ReadingOfEveryScene, NoWordIsLowerThanNinePixelsOnAPhone) {
  const Page page(GetParam(), size_of(480, 270));
  double least = 1e9, least_script = 1e9;
  for (const Item& item : page.picture.items)
    if (const auto* run = std::get_if<GlyphRun>(&item.shape); run && !is_halo(*run)) {
      const bool may_be_script = run->face == Face::math || is_exponent(run->text);
      (may_be_script ? least_script : least) = std::min(may_be_script ? least_script : least, 270 * run->size);
    }
  std::string gone;
  for (const std::string& layer : page.pictures.left_out()) gone += " " + layer;
  std::printf("%-20s 480 x 270: words from %.1f px, formulas from %.1f px, scene %.0f %% of the height; left out:%s\n",
              GetParam().c_str(), least, least_script, 100 * page.pictures.scene_area().height(), gone.c_str());
  EXPECT_GE(least, kLeastWordPixels - 1e-9);
  EXPECT_GE(least_script, kSecondScript * kLeastWordPixels);
}

TEST_P(ReadingOfEveryScene, PortraitAndSquareAreComposed) {
  for (const auto& [width, height] : {std::pair{1080, 1920}, {1080, 1080}}) {
    const Page page(GetParam(), size_of(width, height));
    const double aspect = double(width) / height;
    Rect all = page.pictures.scene_area(0);
    for (int i = 1; i < page.pictures.panel_count(); ++i) {
      const Rect& one = page.pictures.scene_area(i);
      all = {std::min(all.x0, one.x0), std::min(all.y0, one.y0), std::max(all.x1, one.x1), std::max(all.y1, one.y1)};
    }
    std::printf("%-20s %d x %d: scenes over %.0f x %.0f %% of the page, %.0f px a metre\n", GetParam().c_str(), width, height,
                100 * all.width() / aspect, 100 * all.height(), page.pictures.camera().scale * height);
    EXPECT_GE(all.width(), 0.75 * aspect) << "scenes take the width of narrow pages";
    EXPECT_GE(all.height(), 0.30);
    EXPECT_THAT(page.pictures.left_out(), testing::IsEmpty());
  }
}

// Of the frame about the only plot's data, units of H squared: four lines in the theme's rule.
double area_of_plot(const Picture& picture) {
  Rect box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Item& item : picture.items) {
    const auto* line = std::get_if<Capsule>(&item.shape);
    if (line == nullptr || !(line->paint.fill == light_theme().rule) || line->radius != size::kPlotFrame / 2) continue;
    box = {std::min(box.x0, line->a.x), std::min(box.y0, line->a.y), std::max(box.x1, line->a.x), std::max(box.y1, line->a.y)};
  }
  return (box.x1 - box.x0) * (box.y1 - box.y0);
}

// Where these words begin.
std::optional<Point> place_of(const Picture& picture, const std::string& words) {
  for (const Item& item : picture.items)
    if (const auto* run = std::get_if<GlyphRun>(&item.shape); run && run->text.find(words) != std::string::npos) return run->origin;
  return std::nullopt;
}

bool says(const Picture& picture, const std::string& words) {
  return place_of(picture, words).has_value();
}

TEST(Reading, APlotStandsInTheCellThatPanelsWouldLeaveEmpty) {
  for (const auto& [scene, title] : {std::pair{"euler_gains_energy", "energy [J]"}, {"pen_drift", "off the line [m]"}}) {
    const Page page(scene, size_of(1080, 1080));
    const std::optional<Point> at = place_of(page.picture, title);
    ASSERT_TRUE(at) << scene;
    EXPECT_GT(at->x, page.pictures.scene_area(2).x1) << scene;
    EXPECT_LT(at->y, page.pictures.scene_area(1).y0) << scene;
    EXPECT_GT(at->y, page.pictures.scene_area(2).y0) << scene;
  }
}

TEST(Reading, NamesOfTheLegendGoBeforeThePlot) {
  const Page page("humanoid_fall", size_of(1080, 1920)), parabola("pp_free", size_of(1080, 1920)), wide("humanoid_fall", size_of(1920, 1080));
  EXPECT_TRUE(says(page.picture, "centre of pressure [m]"));
  EXPECT_FALSE(says(page.picture, "centre of mass"));
  EXPECT_TRUE(says(page.picture, "ground reaction")) << "a scale stays";
  EXPECT_TRUE(says(wide.picture, "centre of mass"));
  EXPECT_TRUE(says(parabola.picture, "energy [J]"));
}

TEST(Reading, LowPanelsTakeTheRowsOfFormulas) {
  const Page page("big_steps", size_of(480, 270));
  EXPECT_THAT(page.pictures.left_out(), testing::Contains("torque_label"));
  EXPECT_GT(page.pictures.scene_area(0).height(), 0.36) << "with a row of formulas 0.32";
}

TEST(Reading, LargeWordsTakeTheirRoomFromTheSceneNotFromPlots) {
  for (const std::string layout : {"scene-right", "scene-below"}) {
    const auto page_at = [&](const std::string& text_scale) {
      return Page("rr_torque", {"plot=energy", "layout=" + layout, "text_scale=" + text_scale});
    };
    const Page usual = page_at("1"), large = page_at("3");
    EXPECT_GE(area_of_plot(large.picture), 0.9 * area_of_plot(usual.picture)) << layout;
    EXPECT_GE(large.pictures.camera().scale, 0.4 * usual.pictures.camera().scale) << layout;
    // Below the scene there is no room for such words: they are held, which is said.
    EXPECT_EQ(large.pictures.held_text_scale() > 0, layout == "scene-below");
    EXPECT_EQ(left_out_words({}, large.pictures.held_text_scale(), large.film.scene).size(), layout == "scene-below" ? 1u : 0u);
    EXPECT_EQ(usual.pictures.held_text_scale(), 0);
  }
}

// The frames of plots do not yield to large words, but that is no reason to leave out a plot which the motion has room for.
TEST(Reading, LargeWordsKeepThePlotThatNobodyAskedFor) {
  const std::map<std::string, std::vector<std::string>> scenes{{"rrr_free", {"duration=5", "start={q: [90deg, -90deg, -30deg]}", "constraints=[{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}, {line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]"}}, {"rr_torque", {}}};
  for (const auto& [name, overrides] : scenes) {
    const auto area = [&](std::vector<std::string> words) {
      words.insert(words.end(), overrides.begin(), overrides.end());
      return area_of_plot(Page(name, words).picture);
    };
    for (const std::string text_scale : {"1", "1.5", "2"})
      EXPECT_GT(area({"video.width=960", "video.height=540", "text_scale=" + text_scale}), 0.1) << name << text_scale;
    // Negative control: a scene alone has none.
    EXPECT_FALSE(std::isfinite(area({"layout=scene"}))) << name;
  }
}

// Whoever asks for a place of plots and names none gets what is told of the motion.
TEST(Reading, APlaceForPlotsIsFilled) {
  const auto has_plot = [](const std::string& layout, const std::string& draw) {
    return std::isfinite(area_of_plot(Page("rr_free", {"layout=" + layout, "draw=" + draw}).picture));
  };
  for (const std::string layout : {"scene-right", "scene-below"})
    for (const std::string draw : {"[chain]", "[chain, mass_matrix]"}) EXPECT_TRUE(has_plot(layout, draw)) << layout << draw;
  EXPECT_FALSE(has_plot("scene", "[chain]"));
  EXPECT_FALSE(has_plot("auto", "[chain, mass_matrix]")) << "negative control: by itself a picture with M(q) has none";
}

// The strongest contrast of a word's pixels with what lies there without it: that of its stems.
double contrast_of_word(const Image& with, const Image& without, const Rect& box, int height) {
  double most = 1;
  for (int y = std::max(0, int(height * (1 - box.y1))); y < std::min(with.height, int(height * (1 - box.y0)) + 1); ++y)
    for (int x = std::max(0, int(height * box.x0)); x < std::min(with.width, int(height * box.x1) + 1); ++x) {
      const Pixel a = with.at(x, y), b = without.at(x, y);
      if (!(a == b)) most = std::max(most, contrast({a.r, a.g, a.b, 1}, {b.r, b.g, b.b, 1}));
    }
  return most;
}

// About the letters of a run; what is near its base line is enough.
Rect box_of(const GlyphRun& run) {
  const double end = run.glyphs.empty() ? 0 : run.glyphs.back().x;
  return {run.origin.x, run.origin.y, run.origin.x + end + 0.5 * run.size, run.origin.y + kCapHeight * run.size};
}

// What marks are drawn in. Fills of links and rails lie inside of outlines; onion skins, what fades and tints are meant to be
// faint; frames and grids of plots are decoration.
std::set<std::uint32_t> mark_colors(const Theme& theme) {
  std::set<std::uint32_t> colors;
  const auto add = [&](const Color& c) { colors.insert(std::uint32_t(c.r << 16 | c.g << 8 | c.b)); };
  for (const Color& c : {theme.ink, theme.muted, theme.base, theme.ellipse, theme.torque, theme.velocity, theme.force, theme.constraint,
                         theme.side_a, theme.side_b})
    add(c);
  for (const Color& c : theme.curve) add(c);
  for (const Color& c : theme.axis) add(c);
  return colors;
}

TEST_P(ReadingOfEveryScene, WordsAndMarksStandOut) {
  for (const char* name : {"light", "dark"}) {
    std::vector<std::string> overrides = size_of(1280, 720);
    overrides.push_back("theme=" + std::string(name));
    const Page page(GetParam(), overrides);
    Picture without = page.picture;
    std::erase_if(without.items, [](const Item& item) {
      const auto* run = std::get_if<GlyphRun>(&item.shape);
      return run && !is_halo(*run);
    });
    Canvas canvas(1280, 720, fonts());
    Image shown, bare;
    canvas.draw(page.picture, shown);
    canvas.draw(without, bare);
    double least_word = 21, least_mark = 21;
    std::string faintest;
    for (const Item& item : page.picture.items)
      if (const auto* run = std::get_if<GlyphRun>(&item.shape); run && !is_halo(*run) && run->color.a > 0.99 && !run->glyphs.empty()) {
        const double found = contrast_of_word(shown, bare, box_of(*run), 720);
        if (found < least_word) faintest = run->text;
        least_word = std::min(least_word, found);
      }
    std::map<std::uint32_t, int> pixels;
    for (int y = 0; y < bare.height; ++y)
      for (int x = 0; x < bare.width; ++x) {
        const Pixel p = bare.at(x, y);
        ++pixels[std::uint32_t(p.r << 16 | p.g << 8 | p.b)];
      }
    const Pixel corner = bare.at(0, 0);
    int seen = 0;
    for (const std::uint32_t color : mark_colors(theme_named(name)))
      if (pixels[color] > 0) {
        ++seen;
        least_mark = std::min(least_mark, contrast(color_of(color), {corner.r, corner.g, corner.b, 1}));
      }
    EXPECT_GE(seen, 1) << name;
    std::printf("%-20s %-5s least contrast of words %.1f ('%s'), of marks %.1f\n", GetParam().c_str(), name, least_word,
                faintest.c_str(), least_mark);
    // The stems of the smallest letters are narrower than two pixels here: what is mixed with its background loses a little.
    EXPECT_GE(least_word, 4.5 * 0.95) << name << ": " << faintest;
    EXPECT_GE(least_mark, 3) << name;
  }
}

}  // namespace
}  // namespace chainreel::reading
