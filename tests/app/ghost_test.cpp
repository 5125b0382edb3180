// Layout `ghost`: one variant filled, the others over it in outline.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/film/target.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "dynamics/kinematics.hpp"
#include "picture/theme.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr char kGhostScene[] = "assets/scenes/ghost_euler.yaml";

// A film of variants, at hand with its runs.
struct Ghosts {
  explicit Ghosts(const std::vector<std::string>& overrides, const std::string& scene = kGhostScene)
      : prepared(load_film(scene, overrides)),
        times(frame_times(prepared.scene)),
        runs(prepared, {}, times),
        film(runs.pictures(int(times.size()), fonts)) {}

  Image image(int k) const {
    Picture picture = film.static_layer();
    picture.append(film.frame(k));
    return rasterise(picture, prepared.scene.video.width, prepared.scene.video.height, fonts);
  }

  // A place on link `body` of a variant at frame k: `along` of its metre, and `side` of its half width to the
  // left, which is that of a filled link, and a little more where it is outlined.
  Point place(int variant, int k, int body, double along, double side) const {
    const Chain& chain = prepared.panels[std::size_t(variant)].simulation.chain;
    Workspace ws(chain);
    const Trajectory& run = runs[std::size_t(variant)];
    compute_kinematics(chain, ws, run.q_at(k), run.qd_at(k));
    const Eigen::Isometry3d X_WB = pose_of(ws, body);
    const Point a = film.camera().project(X_WB.translation());
    const Point b = film.camera().project(X_WB * Eigen::Vector3d(1, 0, 0));
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Point left{-(b.y - a.y) / length, (b.x - a.x) / length};
    const double half = look_of(skeleton_of(chain), film.camera(), light_theme()).link_width / 2;
    return a + along * (b - a) + (side * (half + (variant > 0 ? kOutlineAway : 0))) * left;
  }

  Pixel pixel(const Image& image, Point p) const {
    return image.at(int(p.x * image.height), int((1 - p.y) * image.height));
  }

  std::string words(int k) const {
    std::string all;
    for (const Picture& picture : {film.static_layer(), film.frame(k)})
      for (const Item& item : picture.items)
        if (const auto* run = std::get_if<GlyphRun>(&item.shape)) all += run->text + "\n";
    return all;
  }

  Fonts fonts;
  PreparedFilm prepared;
  std::vector<double> times;
  Runs runs;
  Film film;
};

Pixel solid(Color color) {
  return {color.r, color.g, color.b, 255};
}

constexpr int kFrame = 72;

TEST(GhostLayout, FillsTheFirstRunAndOutlinesTheSecondWhereTheirPhysicsHasThem) {
  const Ghosts ghosts({"video.width=1920", "video.height=1080"});
  const Image image = ghosts.image(kFrame);
  const Theme& theme = light_theme();
  int filled = 0, outlined = 0, inside = 0;
  for (double along = 0.2; along < 0.85; along += 0.05) {
    for (const int body : {1, 2}) {
      filled += ghosts.pixel(image, ghosts.place(0, kFrame, body, along, 0.3)) ==
                solid(variant_of(0, 2, true, theme).theme->link[std::size_t(body) - 1]);
      for (const double side : {-1.0, 1.0})
        outlined += ghosts.pixel(image, ghosts.place(1, kFrame, body, along, side)) == solid(theme.side_b);
      inside += ghosts.pixel(image, ghosts.place(1, kFrame, body, along, 0.3)) == solid(theme.side_b);
    }
  }
  // Of 26 places each: where the other run lies over or under it, the colour may be another.
  EXPECT_GE(filled, 20);
  EXPECT_GE(outlined, 44);
  EXPECT_EQ(inside, 0) << "an outline is no fill";
}

// Negative control: a frame of the panels side by side has neither in that place.
TEST(GhostLayout, IsNotAComparisonSideBySide) {
  const Ghosts ghosts({"layout=compare"});
  const Image image = ghosts.image(kFrame);
  int outlined = 0;
  for (double along = 0.2; along < 0.85; along += 0.05)
    for (const int body : {1, 2})
      outlined += ghosts.pixel(image, ghosts.place(1, kFrame, body, along, 1)) == solid(light_theme().side_b);
  EXPECT_EQ(outlined, 0);
  EXPECT_GT(ghosts.film.camera(1).origin.x, ghosts.film.camera(0).origin.x);
}

TEST(GhostLayout, HasOneCameraAndNamesItsVariants) {
  const Ghosts ghosts({});
  EXPECT_EQ(ghosts.film.panel_count(), 2);
  EXPECT_EQ(ghosts.film.camera(1).origin.x, ghosts.film.camera(0).origin.x);
  EXPECT_EQ(ghosts.film.camera(1).scale, ghosts.film.camera(0).scale);
  const std::string words = ghosts.words(0);
  EXPECT_THAT(words, HasSubstr("truth (Taylor series)\n"));
  EXPECT_THAT(words, HasSubstr("explicit Euler, 20 ms\n"));
  EXPECT_THAT(words, Not(HasSubstr("B"))) << "one outline is told by being one";
}

TEST(GhostLayout, TellsThreeOutlinesApartByLettersAndColours) {
  const Ghosts ghosts(
      {"compare=[{title: a}, {title: b, step: 0.02, method: rk4}, {title: c, start.q.1: -1}, "
       "{title: d, start.q.1: -1.2}]",
       "method=rk4", "step=0.01", "duration=1"});
  const std::string words = ghosts.words(30);
  for (const char* key : {"a\n", "B: b\n", "C: c\n", "D: d\n", "\nB\n", "\nC\n", "\nD\n"})
    EXPECT_THAT(words, HasSubstr(key));
  std::set<std::uint32_t> colors;
  for (int i = 0; i < 4; ++i) {
    const Color c = variant_of(i, 4, true, light_theme()).color;
    colors.insert(std::uint32_t(c.r) << 16 | std::uint32_t(c.g) << 8 | c.b);
  }
  EXPECT_EQ(colors.size(), 4u);
}

TEST(GhostLayout, AVariantThatDivergesStandsStillPalerAndSaysSo) {
  // PP on a stiff spring by explicit Euler: out of the picture within some steps.
  const Ghosts ghosts(
      {"duration=0.5", "parameters={k: 1e5}", "torque=[0, -k * y_G]", "gravity=[0, 0, 0]",
       "compare=[{title: calm, parameters.k: 100}, {title: wild, method: explicit_euler, expect: "
       "diverge}]",
       "layout=ghost", "method=semi_implicit_euler", "step=0.001"},
      "assets/scenes/pp_spring.yaml");
  EXPECT_THAT(ghosts.words(29), HasSubstr("wild: left the picture at t = "));
  EXPECT_THAT(ghosts.words(0), Not(HasSubstr("left the picture")));
  const auto strokes = [&](int k) {
    int full = 0;
    for (const Item& item : ghosts.film.frame(k).items)
      if (const auto* p = std::get_if<Polygon>(&item.shape)) full += p->paint.stroke == light_theme().side_b;
    return full;
  };
  EXPECT_GT(strokes(0), 0);
  EXPECT_EQ(strokes(29), 0);
}

TEST(GhostLayout, IsReachedByFlagsAndSaysWhatItNeeds) {
  const TemporaryFolder folder;
  const std::vector<std::string> vary{"assets/scenes/rr_free.yaml",
                                      "--layout",
                                      "ghost",
                                      "--quiet",
                                      "--set",
                                      "video.width=320",
                                      "--set",
                                      "video.height=180"};
  const auto run = [&](const std::string& command, const std::vector<std::string>& more) {
    std::vector<std::string> all{command};
    all.insert(all.end(), vary.begin(), vary.end());
    all.insert(all.end(), more.begin(), more.end());
    return run_program(all);
  };
  EXPECT_EQ(run("snapshot", {"--vary", "method=rk4,explicit_euler", "-o", folder.file("a.png")}).status, 0);
  const ProgramResult film = run(
      "render", {"--vary", "method=rk4,explicit_euler", "--set", "duration=0.2", "-o", folder.file("a.mp4")});
  ASSERT_EQ(film.status, 0) << film.err;
  EXPECT_EQ(probe_video(folder.file("a.mp4")).frames, 12);
  EXPECT_EQ(Json::parse(read_whole_file(folder.file("a.json")))["layout"], "ghost");
  EXPECT_THAT(read_whole_file(folder.file("a.txt")),
              HasSubstr("2 variants in one place (filled: RK4; in outline: explicit Euler)"));
  const ProgramResult alone = run("snapshot", {"-o", folder.file("b.png")});
  EXPECT_EQ(alone.status, 3);
  EXPECT_THAT(alone.err, HasSubstr("layout 'ghost' needs `compare:` with its panels"));
  const ProgramResult many =
      run("snapshot", {"--vary", "step=1e-3,2e-3,3e-3,4e-3,5e-3", "-o", folder.file("b.png")});
  EXPECT_EQ(many.status, 3);
  EXPECT_THAT(many.err,
              HasSubstr("draws up to 4 variants over one another, not 5: compare fewer, or take grid"));
}

TEST(GhostLayout, LooksLikeItsGoldenInTheDark) {
  const Ghosts ghosts({"video.width=640", "video.height=360", "text_scale=1.5", "theme=dark"});
  EXPECT_TRUE(matches_golden(ghosts.image(kFrame), "ghost_euler_dark", {.max = 24, .mean = 0.05}));
}

// Runs over one another leave room beside them, or below them upright: for what tells them apart. Not where that would make
// them smaller.
TEST(GhostStory, IsPlottedWhereItCostsTheRunsNothing) {
  const TemporaryFolder folder;
  const auto drawn = [&](const char* width, const char* height, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"snapshot", kGhostScene, "--at", "2", "--width", width, "--height", height, "-o", folder.file("a.svg"), "--force"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_whole_file(folder.file("a.svg"));
  };
  EXPECT_THAT(drawn("1280", "720"), HasSubstr("energy [J]"));
  EXPECT_THAT(drawn("1080", "1920"), HasSubstr("energy [J]"));
  EXPECT_THAT(drawn("1280", "720", {"--set", "draw=[ellipse]"}), testing::Not(HasSubstr("energy [J]"))) << "the picture shows masses";
}

}  // namespace
}  // namespace chainreel
