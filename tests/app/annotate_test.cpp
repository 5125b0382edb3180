// Words of `annotate:` as pixels: a formula with its leader line, held, in both themes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

// An RR with words at its end, at a joint and at a place; the first hold the film for half a second.
class AnnotatedFilm {
 public:
  explicit AnnotatedFilm(const std::string& theme)
      : film_(load_film("assets/scenes/rr_ellipse.yaml",
                        {"video.width=640", "video.height=360", "text_scale=1.5", "duration=2", "theme=" + theme,
                         "annotate=[{at: 1s, text: \"heaviest along $Lambda^{-1}$\", point: gripper, hold: 0.5s},"
                         " {at: 1.5s, text: \"$q_2 = 0$\", point: joint2, hold: 0}]"})),
        runs_(film_),
        pictures_(runs_.pictures(runs_.frames_shown(int(runs_.times().size())), fonts_)) {}

  Image image(int k) const {
    Picture picture = pictures_.static_layer();
    picture.append(pictures_.frame(k));
    return rasterise(picture, 640, 360, fonts_);
  }
  int at(double t) const { return runs_.clock().frame_at(t); }

 private:
  const Fonts fonts_;
  const PreparedFilm film_;
  const Runs runs_;
  const Film pictures_;
};

constexpr PictureTolerance kSame{.max = 24, .mean = 0.05};

TEST(Annotations, LookLikeTheirGoldens) {
  for (const char* theme : {"light", "dark"}) {
    const AnnotatedFilm film(theme);
    const std::string name = std::string("annotate_") + theme;
    const int held = film.at(1) - 10;
    EXPECT_TRUE(matches_golden(film.image(held), name, kSame));
    // The motion stands still, but for a word of the ellipse that fades towards its next place.
    EXPECT_LT(10 * compare_pictures(film.image(held), film.image(held + 8)).mean,
              compare_pictures(film.image(held), film.image(held - 60)).mean);
    // Negative control: half a second behind the words the picture has none, and the arm has moved on.
    EXPECT_FALSE(pictures_agree(film.image(held), film.image(held - 60), kSame, name + "_control"));
  }
}

// As titles do: of the panel's own run.
TEST(Annotations, TellTheTimeOfTheFallAndParameters) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.svg");
  ASSERT_EQ(run_program({"snapshot", "assets/scenes/humanoid_fall.yaml", "--quiet", "--at", "1", "--set", "layout=scene", "--set",
                         "annotate=[{at: 1, text: \"over at {fall}, {tau} N m, {else}\", point: [0, 1]}]", "-o", file})
                .status,
            0);
  const std::string page = read_whole_file(file), words = page.substr(page.find("</metadata>"));
  const std::size_t title = words.find("falls in ");
  ASSERT_NE(title, std::string::npos);
  const std::string fall = words.substr(title + 9, words.find('<', title) - title - 9);
  EXPECT_THAT(words, testing::HasSubstr("over at " + fall + ", 25 N m, {else}"));
}

}  // namespace
}  // namespace chainreel
