// Words of `annotate:` as pixels: a formula with its leader line, held, in both themes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "dynamics/kinematics.hpp"
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

// A dot at the end of each line to what words speak of.
std::vector<Point> pointed_at(const Picture& picture) {
  std::vector<Point> found;
  for (const Item& item : picture.items)
    if (const auto* dot = std::get_if<Ellipse>(&item.shape); dot && std::abs(norm(dot->u) - 0.0055) < 1e-9) found.push_back(dot->center);
  return found;
}

TEST(Annotations, PointAtWhatIsDrawnInOutline) {
  for (const int panel : {1, 2}) {
    const PreparedFilm film = load_film("assets/scenes/ghost_euler.yaml", {"annotate=[{at: 0.5s, text: here, point: gripper, panel: " + std::to_string(panel) + ", hold: 0.5s}]"});
    const Runs runs(film);
    const Fonts fonts;
    const Film pictures = runs.pictures(runs.frames_shown(int(runs.times().size())), fonts);
    const int k = runs.clock().frame_at(0.5);
    const std::vector<Point> ends = pointed_at(pictures.frame(k));
    ASSERT_EQ(ends.size(), 1u);
    for (const std::size_t i : {0u, 1u}) {
      const Chain& chain = film.panels[i].simulation.chain;
      Workspace ws(chain);
      compute_kinematics(chain, ws, runs[i].q_at(k), runs[i].qd_at(k));
      const double off = norm(ends[0] - pictures.camera().project(frame_position(chain, ws, chain.end_effector)));
      // Negative control: the other one is elsewhere by then.
      if (int(i) + 1 == panel)
        EXPECT_LT(off, 1e-9) << panel;
      else
        EXPECT_GT(off, 0.001) << panel;
    }
  }
}

// A pause lets one look at what comes and goes while all moves: there it is whole, or not there.
TEST(Annotations, LetNoNumberStandHalfFadedWhileTheFilmStandsStill) {
  const TemporaryFolder folder;
  const std::string scene = folder.file("swing.yaml");
  std::ofstream(scene) << "model: {links: [0.5, 0.4, 0.3], masses: [2, 1.5, 1]}\nstart: {q: [0, 0, 0]}\nduration: 0.6\ndraw: [+ellipse]\n"
                          "annotate: [{at: 0.3s, text: here, point: gripper, hold: 1s}]\nvideo: {width: 1280, height: 720, fps: 30}\n";
  const PreparedFilm film = load_film(scene, {});
  const Runs runs(film);
  const Fonts fonts;
  const Film pictures = runs.pictures(runs.frames_shown(int(runs.times().size())), fonts);
  const auto faded = [&](int k) {
    int count = 0;
    for (const Item& item : pictures.frame(k).items)
      if (const auto* run = std::get_if<GlyphRun>(&item.shape)) count += run->color.a > 0 && run->color.a < 1 && run->stroke_width == 0;
    return count;
  };
  const int last = runs.clock().frame_at(0.3), fade = 6;  // frames: words that change places go and come meanwhile
  for (int k = last - 28 + fade; k < last - fade; ++k) EXPECT_EQ(faded(k), 0) << k;
  int moving = 0;
  for (int k = 0; k < pictures.frame_count(); ++k) moving += faded(k);
  EXPECT_GT(moving, 0) << "negative control";
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
