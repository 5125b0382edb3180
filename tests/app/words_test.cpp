// The words of every kind of picture: on the page, whole, large enough, and apart from each other.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/all_pictures.hpp"
#include "app/paper/pose_page.hpp"
#include "app/ink.hpp"
#include "app/print_pictures.hpp"
#include "core/format.hpp"
#include "draw/figures/poses.hpp"
#include "draw/page/sheet.hpp"
#include "model/read_chain.hpp"
#include "picture/theme.hpp"
#include "support/chains.hpp"
#include "support/fonts.hpp"

namespace chainreel {
namespace {

using test::AnyPicture;
using test::PictureLook;
using test::Written;

// Ink may lean over its advance by a side bearing, and letters hang below base lines that keep the margin.
constexpr double kBearing = 0.004, kDescent = 0.25;
// Second-level scripts of the mathematics are half of the size of their line; all else is as large as the
// style says.
constexpr double kSecondScript = 0.5;
// The exponent of a power of ten on an axis is a script, too.
constexpr double kExponent = 0.7;
// Within one formula: italic letters lean over what follows them.
constexpr double kLean = 0.12;
// Half a pixel of 1080 rows: ink that touches in exact outlines does not overlap to the eye.
constexpr double kTouch = 0.5 / 1080;

std::string say(const Written& w) {
  char place[80];
  std::snprintf(place, sizeof place, "' at (%.3f, %.3f), size %.4f", w.ink.x0, w.ink.y0, w.run.size);
  return "'" + w.run.text + place;
}

double depth(const Rect& a, const Rect& b) {
  return std::min(std::min(a.x1, b.x1) - std::max(a.x0, b.x0), std::min(a.y1, b.y1) - std::max(a.y0, b.y0));
}

bool holds(const Rect& outer, const Rect& inner, double slack) {
  return inner.x0 >= outer.x0 - slack && inner.x1 <= outer.x1 + slack && inner.y0 >= outer.y0 - slack &&
         inner.y1 <= outer.y1 + slack;
}

bool is_exponent(const Written& w) {
  return w.run.text.find_first_not_of("0123456789\u2212") == std::string::npos;
}

// Runs that follow each other in the list and in the mathematics may be parts of one formula.
bool of_one_formula(const Written& a, const Written& b) {
  return a.run.face == Face::math && b.run.face == Face::math && b.item - a.item <= 3;
}

// Large words are that much smaller at most where plots would not keep their frames, which is said (draw/film/compose).
constexpr double kHeldForPlots = 0.85;

// What is wrong with the words of a picture; nothing where all is well.
std::vector<std::string> faults_of(const Picture& picture, double text_scale) {
  std::vector<std::string> faults;
  const std::vector<Written> words = test::written_on(picture, fonts());
  const Written* title = nullptr;
  for (const Written& w : words)
    if (w.run.face == Face::label_bold && w.clip < 0 && (!title || w.ink.y0 > title->ink.y0)) title = &w;
  const double least = kSmallestText * std::max(kHeldForPlots * text_scale, 1.0);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Written& w = words[i];
    const double hanging = kDescent * w.run.size;
    const Rect inside{size::kMargin - kBearing, size::kMargin - hanging,
                      picture.aspect - size::kMargin + kBearing, 1 - size::kMargin + kBearing};
    if (!holds(inside, w.ink, 0)) faults.push_back("in the outer margin: " + say(w));
    if (w.clip >= 0 && !holds(picture.clips[std::size_t(w.clip)], w.ink, kTouch))
      faults.push_back("cut: " + say(w));
    const double smallest = w.run.face == Face::math ? kSecondScript * least
                            : is_exponent(w)         ? kExponent * least
                                                     : least;
    if (w.run.size < smallest - 1e-12) faults.push_back("too small: " + say(w));
    if (title && &w != title && w.clip >= 0 && w.ink.y1 > title->ink.y0)
      faults.push_back("of the scene, in the title's band: " + say(w));
    for (std::size_t j = 0; j < i; ++j) {
      const double allowed = of_one_formula(words[j], w) ? kLean * w.run.size : kTouch;
      if (depth(words[j].ink, w.ink) > allowed)
        faults.push_back("overlap: " + say(words[j]) + " and " + say(w));
    }
  }
  return faults;
}

class EveryPicture : public ::testing::TestWithParam<AnyPicture> {};

INSTANTIATE_TEST_SUITE_P(All, EveryPicture, ::testing::ValuesIn(test::all_pictures()),
                         [](const auto& p) { return p.param.name; });

// 1280 x 720 has the page of 1920 x 1080; its letters are as many parts of the height.
const PictureLook kLooks[] = {
    {{}, 1920, 1080, 1}, {{}, 1280, 720, 1.25}, {{}, 640, 360, 1.5}, {{}, 1440, 1080, 1}};

TEST_P(EveryPicture, HasItsWordsWholeAndApart) {
  for (PictureLook look : kLooks) {
    for (const char* theme : {"light", "dark"}) {
      look.theme = theme;
      const Picture picture = GetParam().draw(look, fonts());
      std::string all;
      for (const std::string& fault : faults_of(picture, look.text_scale)) all += "\n  " + fault;
      EXPECT_EQ(all, "") << look.width << "x" << look.height << " " << theme;
    }
  }
}

TEST_P(EveryPicture, HasTheBackgroundOfItsTheme) {
  for (const char* theme : {"light", "dark"}) {
    Color background = GetParam().draw({theme, 640, 360, 1.5}, fonts()).background;
    if (GetParam().name == "transparent") {
      EXPECT_EQ(background.a, 0);
      background.a = 1;
    }
    EXPECT_EQ(background, theme_named(theme).background);
  }
}

// A column of a paper, 84 mm wide, for one pose and for six: no word leaves the page, lies on another or is smaller than 7 pt, and
// letters and poses are of one size.
TEST(Words, OfJointSpaceInAColumnAreWholeAndApart) {
  constexpr double kWidth = 84, kSevenPoints = 7 * 25.4 / 72;  // mm
  const Chain chain = read_chain("models/rr.urdf", {});
  std::vector<std::vector<double>> poses;
  double before = 0;
  for (int count = 1; count <= 6; ++count) {
    poses.push_back({0.4 * count, 2.6 - 0.5 * count});
    PoseFigureOptions options;
    options.width = 1600, options.height = 3200;
    options.letters = true;
    options.text_scale = kSevenPoints / (2 * kWidth) / kSmallestText;
    const std::optional<double> height = joint_space_height(chain, poses, {0, 1}, options, fonts());
    ASSERT_TRUE(height) << count;
    EXPECT_GT(*height, before) << "each pose takes a row";
    before = *height;
    options.text_scale *= options.height / std::ceil(*height);
    options.height = int(std::ceil(*height));
    const Picture picture = draw_joint_space_figure(chain, poses, {0, 1}, options, fonts());
    const double page_mm = kWidth / picture.aspect;
    const std::vector<Written> words = test::written_on(picture, fonts());
    std::vector<double> captions;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const Written& w = words[i];
      EXPECT_TRUE(holds({0, 0, picture.aspect, 1}, w.ink, 0)) << count << " leaves the page: " << say(w);
      EXPECT_GE(w.run.size * page_mm, kSevenPoints * (w.run.face == Face::math ? kSecondScript : 1) * 0.999) << count << say(w);
      if (w.run.face == Face::label_bold || w.run.text.find("\u00B0") != std::string::npos) captions.push_back(w.run.size);
      for (std::size_t j = 0; j < i; ++j) {
        const double allowed = of_one_formula(words[j], w) ? kLean * w.run.size : kTouch;
        EXPECT_LE(depth(words[j].ink, w.ink), allowed) << count << " overlap: " << say(words[j]) << " and " << say(w);
      }
    }
    ASSERT_GE(captions.size(), 2u * std::size_t(count));
    EXPECT_DOUBLE_EQ(*std::min_element(captions.begin(), captions.end()), *std::max_element(captions.begin(), captions.end()));
  }
}

void expect_whole_and_apart(const Picture& picture, const std::string& what) {
  const std::vector<Written> words = test::written_on(picture, fonts());
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Written& w = words[i];
    EXPECT_TRUE(holds({0, 0, picture.aspect, 1}, w.ink, 0)) << what << "leaves the page: " << say(w);
    EXPECT_EQ(w.run.text.find("..."), std::string::npos) << what << say(w);
    if (w.clip >= 0) EXPECT_TRUE(holds(picture.clips[std::size_t(w.clip)], w.ink, kTouch)) << what << "cut: " << say(w);
    for (std::size_t j = 0; j < i; ++j) {
      const double allowed = of_one_formula(words[j], w) ? kLean * w.run.size : kTouch;
      EXPECT_LE(depth(words[j].ink, w.ink), allowed) << what << "overlap: " << say(words[j]) << " and " << say(w);
    }
  }
}

// Few poses and many, of chains of up to seven joints, in a column and over a page's width: no caption lies on another, leaves its page or
// shortens its pose, and times stand off the chains.
TEST(Words, OfPosesOnPaperAreWholeAndApart) {
  for (const int joints : {1, 3, 7}) {
    const Chain chain = test::planar_serial_chain(joints);
    const TipMass tip(chain);
    std::vector<std::vector<double>> poses;
    for (int count = 1; count <= 13; ++count) {
      std::vector<double> q(std::size_t(joints), -1.05 - 0.03 * count);
      q[0] = 1.9 - 0.07 * count;
      poses.push_back(q);
      if (count == 2 || (count > 4 && count % 4 != 1)) continue;
      for (const double width : {84.0, 174.0})
        for (const bool is_labelled : {false, true}) {
          const std::string what = std::to_string(joints) + " joints, " + std::to_string(count) + " poses, " + format_shortest(width) + " mm: ";
          PoseFigureOptions figure;
          figure.letters = figure.labels.empty();
          for (int i = 0; i < count && is_labelled; ++i) figure.labels.push_back("t = " + format_fixed(0.122 * i, 3) + " s");
          put_on_paper(figure, {.width_mm = width}, tip, poses, fonts());
          const Picture picture = draw_ellipse_figure(tip, poses, figure, fonts());
          expect_whole_and_apart(picture, what);
        }
    }
  }
}

// Rows of an RR, whose words for the masses may take a line of the foot; what has no room is refused.
TEST(Words, OfRowsOnPaperAreWholeAndApart) {
  const Chain chain = read_chain("models/rr.urdf", {});
  const TipMass tip(chain);
  std::vector<std::vector<double>> poses;
  int drawn = 0;
  for (int count = 1; count <= 8; ++count) {
    poses.push_back({0, 0.4 + 0.3 * count});
    for (const double width : {84.0, 174.0})
      for (const bool has_letters : {false, true})
        try {
          PoseFigureOptions figure;
          figure.layout = "row";
          figure.letters = has_letters;
          put_on_paper(figure, {.width_mm = width}, tip, poses, fonts());
          expect_whole_and_apart(draw_ellipse_figure(tip, poses, figure, fonts()),
                                 std::to_string(count) + " poses, " + format_shortest(width) + (has_letters ? " mm, letters: " : " mm: "));
          ++drawn;
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), ExitCode::usage) << error.what();
        }
  }
  EXPECT_GE(drawn, 24);
}

// Negative control: each kind of fault is found.
TEST(Words, ThatAreWronglyPlacedAreFound) {
  const auto with = [](const char* text, TextStyle style, Point at, int clip = -1) {
    Picture page;
    page.clips.push_back({0.3, 0.3, 1.2, 0.95});
    draw_text(page, lay_out_text(fonts(), "Title", {Face::label_bold, size::kTitle}), {0.1, 0.9});
    draw_text(page, lay_out_text(fonts(), "ground", {Face::label, size::kAxis}), {0.1, 0.1});
    draw_text(page, lay_out_text(fonts(), text, style), at, clip);
    return faults_of(page, 1);
  };
  const TextStyle usual{Face::label, size::kAxis};
  EXPECT_TRUE(with("fine", usual, {0.5, 0.5}, 0).empty());
  EXPECT_THAT(with("out", usual, {0.01, 0.5}), testing::ElementsAre(testing::HasSubstr("margin")));
  EXPECT_THAT(with("small", {Face::label, 0.020}, {0.5, 0.5}),
              testing::ElementsAre(testing::HasSubstr("too small")));
  EXPECT_THAT(with("above", usual, {0.15, 0.105}), testing::ElementsAre(testing::HasSubstr("overlap")));
  EXPECT_THAT(with("cut", usual, {0.29, 0.5}, 0), testing::ElementsAre(testing::HasSubstr("cut")));
  EXPECT_THAT(with("high", usual, {0.5, 0.9}, 0), testing::ElementsAre(testing::HasSubstr("title's band")));
}

}  // namespace
}  // namespace chainreel
