// The words of marks in every scene of assets/scenes, over all frames: they lie on nothing, and do not jump.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "draw/film/film.hpp"
#include "draw/shapes.hpp"
#include "picture/theme.hpp"
#include "support/scene_names.hpp"

namespace chainreel {
namespace {

// Places on what is drawn, close enough for no letter to fit between, with the half width of the line there.
struct Dot {
  Point p;
  double radius = 0;
};
struct Drawn {
  std::vector<Dot> links, arrows;
};

constexpr double kDotPitch = 0.004;  // units of H

void put_dots(std::vector<Dot>& dots, Point a, Point b, double radius) {
  const int pieces = std::clamp(int(norm(b - a) / kDotPitch), 1, 1000);
  for (int i = 0; i <= pieces; ++i) dots.push_back({a + (double(i) / pieces) * (b - a), radius});
}

// Links are bars with an outline of ink, arrows and arcs have the colours of vectors.
Drawn drawn_on(const Picture& picture, const Theme& theme, int clip) {
  Drawn drawn;
  const auto is_vector = [&](const Color& c) {
    return c == theme.torque || c == theme.velocity || c == theme.force || c == theme.constraint;
  };
  for (const Item& item : picture.items) {
    if (item.clip != clip) continue;
    if (const auto* bar = std::get_if<Capsule>(&item.shape)) {
      if (bar->paint.stroke == theme.ink && bar->paint.stroke_width > 0)
        put_dots(drawn.links, bar->a, bar->b, bar->radius);
      if (is_vector(bar->paint.fill)) put_dots(drawn.arrows, bar->a, bar->b, bar->radius);
    }
    if (const auto* head = std::get_if<Polygon>(&item.shape); head && is_vector(head->paint.fill))
      for (int i = 0; i < head->count; ++i)
        put_dots(drawn.arrows, head->corners[std::size_t(i)], head->corners[std::size_t((i + 1) % head->count)], 0);
    if (const auto* arc = std::get_if<Arc>(&item.shape); arc && is_vector(arc->color))
      for (int i = 0; i <= 100; ++i) {
        const double angle = arc->start + arc->sweep * i / 100;
        drawn.arrows.push_back(
            {arc->center + arc->radius * Point{std::cos(angle), std::sin(angle)}, arc->width / 2});
      }
  }
  return drawn;
}

bool any_in(const std::vector<Dot>& dots, const Rect& box) {
  return std::any_of(dots.begin(), dots.end(), [&](const Dot& dot) {
    const Rect wide = widened(box, dot.radius);
    return dot.p.x > wide.x0 && dot.p.x < wide.x1 && dot.p.y > wide.y0 && dot.p.y < wide.y1;
  });
}

struct Counts {
  int frames = 0, words = 0, on_words = 0, on_arrows = 0, on_links = 0, jumps = 0, left_out = 0;
  std::vector<double> off{};  // units of H, of each word that stands from what it names

  double mean_off() const {
    double sum = 0;
    for (const double one : off) sum += one;
    return off.empty() ? 0 : sum / double(off.size());
  }
  double off_of(double share) const {
    if (off.empty()) return 0;
    std::vector<double> sorted = off;
    std::ranges::sort(sorted);
    return sorted[std::min(sorted.size() - 1, std::size_t(share * double(sorted.size())))];
  }
};

// By more than 0.02 H on the page, and about what it names, too, which itself is followed by an eye up to 0.1 H a frame.
bool jumps(const StandingWord& before, const StandingWord& now) {
  const Point way = center_of(now.box) - center_of(before.box);
  if (!now.anchor || !before.anchor) return norm(way) > 0.02;
  const Point ride = *now.anchor - *before.anchor;
  return norm(way) > 0.02 && (norm(way - ride) > 0.02 || norm(ride) > 0.1);
}

// Words of two frames are the same one where they stand nearest to one another and say so: by their order, as long as
// there are as many.
void count(Counts& counts, const Drawn& drawn, std::span<const StandingWord> now, std::span<const StandingWord> before) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    ++counts.words;
    if (!(now[i].opacity > 0)) {
      ++counts.left_out;
      continue;
    }
    if (now[i].anchor) counts.off.push_back(norm(nearest_in(now[i].box, *now[i].anchor) - *now[i].anchor));
    for (std::size_t j = 0; j < i; ++j) counts.on_words += now[j].opacity > 0 && overlap(now[i].box, now[j].box);
    counts.on_arrows += any_in(drawn.arrows, now[i].box);
    counts.on_links += any_in(drawn.links, now[i].box);
    if (now.size() != before.size() || !(before[i].opacity > 0)) continue;
    const bool fades = now[i].opacity < 0.5 && before[i].opacity < 0.5;
    counts.jumps += !fades && jumps(before[i], now[i]);
  }
}

class WordsOfEveryScene : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Assets, WordsOfEveryScene, ::testing::ValuesIn(test::scene_names()),
                         [](const auto& p) { return p.param; });

TEST_P(WordsOfEveryScene, LieOnNothingAndDoNotJump) {
  const Fonts fonts;
  const PreparedFilm prepared = load_film("assets/scenes/" + GetParam() + ".yaml", {}, false);
  const Runs runs(prepared);
  const Film film = runs.pictures(runs.frames_shown(int(runs.times().size())), fonts);
  Counts counts;
  for (int panel = 0; panel < film.panel_count(); ++panel)
    for (int k = 0; k <= film.panel(panel).last(); ++k) {
      const auto words = film.words(panel, k);
      ++counts.frames;
      if (words.empty()) continue;
      count(counts, drawn_on(film.frame(k), light_theme(), panel), words,
            k > 0 ? film.words(panel, k - 1) : std::vector<StandingWord>());
    }
  std::printf("%-20s %4d frames %5d words: on words %d, on arrows %d, on links %d, jumps %d, left out %d, off what they name by %.3f H, 95 %% by less than %.3f\n",
              GetParam().c_str(), counts.frames, counts.words, counts.on_words, counts.on_arrows, counts.on_links,
              counts.jumps, counts.left_out, counts.mean_off(), counts.off_of(0.95));
  EXPECT_EQ(counts.on_words, 0);
  EXPECT_EQ(counts.on_arrows, 0);
  EXPECT_EQ(counts.on_links, 0);
  EXPECT_EQ(counts.jumps, 0);
  // The lengths of the ellipse's axes run along the edge of the scene faster than can be read, and the joints of rrr_torque, at
  // 20 rad/s, bring links to every place about them. The shortest axes of arm_ellipsoid turn behind the hand, and their numbers change
  // sides; its plot has them. What ties exert is an arrow for some tenths of a second, while the tie moves at its fastest: too short for
  // its name where it is not cut, whose plot tells it.
  // Numbers of axes that say which are wider, and arrows of four_bar_singular make room for what is said of its event; their names, which its
  // plot has, too, are not led across links.
  const std::map<std::string, double> most{{"rr_ellipse", 0.22}, {"rrr_torque", 0.25}, {"four_bar_singular", 0.24}, {"arm_ellipsoid", 0.26}};
  const auto own = most.find(GetParam());
  // About a joint a name is beside its arc, whose radius is 0.058 H, or 0.035 H farther off; the arm's ellipsoid has numbers at its ends.
  // That of a crank which turns all around its joint stands outside of its circle, and numbers of ties keep off a trail that ends there.
  if (GetParam() != "arm_ellipsoid") {
    EXPECT_LE(counts.mean_off(), GetParam() == "slider_crank" ? 0.17 : GetParam() == "four_bar_singular" ? 0.12 : 0.1);
  }
  EXPECT_LE(counts.left_out, (own == most.end() ? 0.05 : own->second) * counts.words);
}

// The largest numbers that names of curves tell, as in "to 1\u00D710\u2078 m", of a page's plots.
std::set<std::string> numbers_told(const std::string& scene, const char* width, const char* height) {
  const Fonts fonts;
  const PreparedFilm prepared = load_film(scene, {std::string("video.width=") + width, std::string("video.height=") + height}, false);
  const Runs runs(prepared);
  const Composition page = runs.composition(prepared.scene, runs.frames_shown(int(runs.times().size())), fonts);
  std::set<std::string> told;
  for (const PlotStrip& plot : page.sheet.plots) {
    Picture picture;
    plot.draw_static(picture);
    const std::string words = test::words_of(picture);
    for (const std::string before : {"to ", "once "})
      for (std::size_t at = words.find(before); at != std::string::npos; at = words.find(before, at + 1)) {
        const std::size_t number = at + before.size();
        if (number < words.size() && std::isdigit(static_cast<unsigned char>(words[number]))) told.insert(words.substr(at, words.find(' ', number) - at));
      }
  }
  return told;
}

// Samples of curves do not depend on the page. Where a small one has no room for such a name it tells none.
TEST_P(WordsOfEveryScene, TellOneNumberOnPagesOfEverySize) {
  const std::string scene = "assets/scenes/" + GetParam() + ".yaml";
  const std::set<std::string> told = numbers_told(scene, "1920", "1080");
  if (told.empty()) return;
  for (const auto& [width, height] : {std::pair{"640", "360"}, {"480", "270"}, {"1080", "1920"}})
    for (const std::string& number : numbers_told(scene, width, height)) EXPECT_TRUE(told.contains(number)) << number << " at " << width;
}

// About the ink of a run of letters; less than that, so that parts of one formula keep off one another.
Rect core_of(const GlyphRun& run) {
  return {run.origin.x + 0.05 * run.size, run.origin.y, run.origin.x + run.glyphs.back().x + (run.text.ends_with(" ") ? 0 : 0.4) * run.size, run.origin.y + 0.6 * run.size};
}

// Pairs of words that lie on one another.
std::string words_on_words(const Picture& picture) {
  std::vector<std::pair<Rect, std::string>> seen;
  std::string found;
  for (const GlyphRun& run : test::all_of<GlyphRun>(picture)) {
    if (run.glyphs.empty() || run.stroke_width > 0 || !(run.color.a > 0.3)) continue;
    const Rect core = core_of(run);
    for (const auto& [other, text] : seen)
      if (overlap(core, other)) found += text + " | " + run.text + "; ";
    seen.emplace_back(core, run.text);
  }
  return found;
}

// Frames of a film tell the peak of what is cut for as long as one reads it; a picture by itself would be taken for that instant's, and has
// another number at the film's place, which may be wider.
TEST_P(WordsOfEveryScene, OfAPictureByItselfTellNoPeakAndLieOnNoOther) {
  const Fonts fonts;
  const PreparedFilm prepared = load_film("assets/scenes/" + GetParam() + ".yaml", {}, false);
  const Runs runs(prepared);
  const Film film = runs.pictures(runs.frames_shown(int(runs.times().size())), fonts);
  constexpr int kApart = 5;  // frames
  int in_film = 0;
  for (int k = 0; k < film.frame_count(); k += kApart) {
    in_film += test::words_of(film.frame(k)).find("peak") != std::string::npos;
    const Picture still = film.still(k);
    EXPECT_EQ(test::words_of(still).find("peak"), std::string::npos) << k;
    EXPECT_EQ(words_on_words(still), "") << k;
  }
  if (GetParam() == "slider_crank") EXPECT_GT(in_film, 0) << "negative control";
}

}  // namespace
}  // namespace chainreel
