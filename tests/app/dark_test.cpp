// The dark theme's pictures of each kind, against pictures that were looked at.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/all_pictures.hpp"
#include "app/film/target.hpp"
#include "encode/png.hpp"
#include "picture/theme.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

constexpr int kDarkWidth = 640, kDarkHeight = 360;
// The same pixels are expected everywhere; another build of FreeType may move a glyph's edge, and one of Mesa a pixel.
constexpr PictureTolerance kSame{.max = 24, .mean = 0.05};

Image picture_of(const std::string& name, const std::string& theme) {
  static const Fonts fonts;
  const auto& all = test::all_pictures();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  if (found == all.end()) throw std::logic_error("no picture is called " + name);
  return rasterise(found->draw({theme, kDarkWidth, kDarkHeight, 1.5}, fonts), kDarkWidth, kDarkHeight, fonts);
}

class InTheDark : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Kinds, InTheDark,
                         ::testing::Values("rr_ellipse", "euler_gains_energy", "compare_layers", "plots_right",
                                         "poses_rr", "ellipse_row", "ellipse_field", "ellipse_along",
                                         "ellipse_joint_space", "energy_chart", "stability_map", "arm_section"),
                         [](const auto& p) { return std::string(p.param); });

TEST_P(InTheDark, LooksLikeItsGolden) {
  EXPECT_TRUE(matches_golden(picture_of(GetParam(), "dark"), std::string(GetParam()) + "_dark", kSame));
}

// Negative control, and no leftovers of the other theme: nearly every pixel differs.
TEST_P(InTheDark, IsNotTheLightOne) {
  const Image dark = picture_of(GetParam(), "dark"), light = picture_of(GetParam(), "light");
  EXPECT_GT(compare_pictures(dark, light).mean, 60);
}

// The theme of a picture that a command writes, by its corner.
std::string theme_by(std::vector<std::string> words) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.png");
  words.insert(words.end(), {"-o", file, "--quiet", "--width", "320", "--height", "180"});
  const ProgramResult result = run_program(words);
  if (result.status != 0) return result.err;
  const Pixel corner = read_png(file).at(2, 2);
  for (const char* name : {"light", "dark"}) {
    const Color background = theme_named(name).background;
    if (corner == Pixel{background.r, background.g, background.b, 255}) return name;
  }
  return "neither";
}

TEST(ThemeFlag, IsTakenByEveryCommandThatDraws) {
  const std::string scene = "assets/scenes/rr_free.yaml";
  const std::vector<std::vector<std::string>> commands{
      {"snapshot", scene, "--set", "duration=0.1"},
      {"snapshot", "models/rr.urdf"},
      {"ellipse", "models/rr.urdf", "--pose", "0,1"},
      {"ellipse", "--along", scene, "--set", "duration=0.1"},
      {"energy", scene, "--until", "0.1s", "--methods", "rk4"},
      {"chart", scene, "--set", "duration=0.1", "--methods", "rk4", "--runs", "1", "--longest", "0.001"},
      {"stability", "assets/scenes/pp_spring.yaml", "--set", "torque=[0, -k * y_G]", "--set",
       "parameters.k=100", "--x", "step=0.1:0.2:2", "--y", "parameters.k=50:100:2"}};
  for (std::vector<std::string> words : commands) {
    SCOPED_TRACE(words[0] + " " + words[1]);
    EXPECT_EQ(theme_by(words), "light");
    const bool has_scene = words[1].ends_with(".yaml") || words[1] == "--along";
    words.insert(words.end(), {"--theme", "dark", "--text-scale", "1.2"});
    EXPECT_EQ(theme_by(words), "dark");
    words[words.size() - 3] = "drak";
    EXPECT_THAT(theme_by(words), testing::HasSubstr("drak"));
    if (!has_scene) continue;
    // The scene's own theme counts unless the flag says otherwise.
    words.resize(words.size() - 4);
    words.insert(words.end(), {"--set", "theme=dark"});
    EXPECT_EQ(theme_by(words), "dark");
    words.insert(words.end(), {"--theme", "light"});
    EXPECT_EQ(theme_by(words), "light");
  }
}

}  // namespace
}  // namespace chainreel
