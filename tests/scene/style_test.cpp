// The key style: what is read, from where, and what is refused where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/text/read_scene.hpp"
#include "scene/text/write_scene.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

const std::string kModel = std::filesystem::absolute("models/rr.urdf").string();

class StyleFile : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.file(name)) << text;
    return folder_.file(name);
  }
  Scene scene_with(const std::string& style) const {
    return read_scene(write("scene.yaml", "model: " + kModel + "\nstyle: " + style + "\n"));
  }
  std::string trouble_with(const std::string& style) const {
    try {
      scene_with(style);
    } catch (const Error& error) {
      std::string all;
      for (const Problem& problem : error.problems()) all += to_string(problem) + "\n";
      return all;
    }
    return "none";
  }
  const TemporaryFolder folder_;
};

TEST_F(StyleFile, SaysTheSameAsTheKeysInTheSceneItself) {
  const std::string keys = "light: {ink: \"#102030\", links: [\"#56B4E9\", E69F00]}\nlines: 1.5\nfonts: {label: Inter}\n";
  write("lab.yaml", keys);
  const Scene by_file = scene_with("lab.yaml");
  const Scene here = scene_with("{light: {ink: \"#102030\", links: [\"#56B4E9\", E69F00]}, lines: 1.5, fonts: {label: Inter}}");
  EXPECT_EQ(scene_text(by_file), scene_text(here));
  EXPECT_EQ(by_file.style.light.at("ink"), std::vector<std::uint32_t>{0x102030});
  EXPECT_EQ(by_file.style.light.at("links"), (std::vector<std::uint32_t>{0x56B4E9, 0xE69F00}));
  EXPECT_EQ(by_file.style.lines, 1.5);
}

TEST_F(StyleFile, IsWhollyInTheTextThatFilmsRemember) {
  write("logo.png", "not looked at before a picture is drawn");
  write("lab.yaml",
        "light: {ink: \"#102030\", curves: [\"#0072B2\"]}\ndark: {background: \"#000000\"}\nlines: 0.8\ntrail: 2.5s\n"
        "fonts: {label: Inter, math: \"STIX Two Math\"}\nlogo: {file: logo.png, corner: bottom_left, height: 0.1}\n");
  const std::string text = scene_text(scene_with("lab.yaml"));
  const Scene again = read_scene(write("again.yaml", text));
  EXPECT_EQ(scene_text(again), text);
  EXPECT_EQ(again.style.logo->corner, PageCorner::bottom_left);
  EXPECT_EQ(again.style.trail, 2.5);
  EXPECT_EQ(again.style.fonts.math, "STIX Two Math");
  EXPECT_THAT(scene_text(scene_with("{}")), testing::Not(HasSubstr("style"))) << "a style that changes nothing is none";
}

TEST_F(StyleFile, NamesItsOwnFileAndLineWhereItIsWrong) {
  const std::string file = write("lab.yaml", "lines: 1.2\nlight:\n  inc: \"#102030\"\n");
  EXPECT_THAT(trouble_with("lab.yaml"), HasSubstr(file + ":3"));
  EXPECT_THAT(trouble_with("lab.yaml"), HasSubstr("did you mean 'ink'?"));
  write("lab.yaml", "lines: 7\ncolour: red\n");
  EXPECT_THAT(trouble_with("lab.yaml"), AllOf(HasSubstr(file + ":1"), HasSubstr(file + ":2"), HasSubstr("between 0.5 and 2")));
  write("lab.yaml", "trail: 61 s\n");
  EXPECT_THAT(trouble_with("lab.yaml"), AllOf(HasSubstr(file + ":1"), HasSubstr("between 0.2 s and 60 s")));
  write("lab.yaml", "light: [\n");
  EXPECT_THAT(trouble_with("lab.yaml"), AllOf(HasSubstr(file), HasSubstr("not valid YAML")));
  write("lab.yaml", "");
  EXPECT_THAT(trouble_with("lab.yaml"), AllOf(HasSubstr(file), HasSubstr("holds no style")));
  EXPECT_THAT(trouble_with("nowhere.yaml"), HasSubstr("there is no style file"));
}

TEST_F(StyleFile, ColoursAreSixDigitsInQuotes) {
  for (const char* wrong : {"{light: {ink: red}}", "{light: {ink: \"#12345\"}}", "{light: {ink: \"#12345G\"}}", "{light: {ink: [1]}}",
                            "{light: {links: [\"#zz0000\"]}}"})
    EXPECT_THAT(trouble_with(wrong), HasSubstr("six hexadecimal digits")) << wrong;
  write("lab.yaml", "light:\n  ink: #102030\n");  // a comment, to YAML
  EXPECT_THAT(trouble_with("lab.yaml"), HasSubstr("in quotes"));
  EXPECT_THAT(trouble_with("{light: {links: []}}"), HasSubstr("one to 4"));
  EXPECT_THAT(trouble_with("{light: {curves: [\"#000000\", \"#000000\", \"#000000\", \"#000000\"]}}"), HasSubstr("one to 3"));
}

TEST_F(StyleFile, LogosAreFilesBesideTheStyle) {
  EXPECT_THAT(trouble_with("{logo: {file: gone.png}}"), HasSubstr("which is not there"));
  EXPECT_THAT(trouble_with("{logo: {corner: top_left}}"), HasSubstr("must name the picture"));
  write("logo.gif", "");
  EXPECT_THAT(trouble_with("{logo: {file: logo.gif}}"), HasSubstr(".png or an .svg"));
  write("logo.png", "");
  EXPECT_THAT(trouble_with("{logo: {file: logo.png, height: 0.5}}"), HasSubstr("between 0.02 and 0.2"));
  EXPECT_THAT(trouble_with("{logo: {file: logo.png, corner: middle}}"), HasSubstr("top_right"));
  std::filesystem::create_directory(folder_.file("house"));
  write("house/lab.yaml", "logo: {file: ../logo.png}\n");
  EXPECT_TRUE(std::filesystem::equivalent(scene_with("house/lab.yaml").style.logo->file, folder_.file("logo.png")));
}

TEST_F(StyleFile, IsOfThePageNotOfAPanel) {
  write("scene.yaml", "");
  const std::string path = write("two.yaml", "model: " + kModel +
                                                 "\nstyle: {lines: 1.5}\ncompare: [{method: rk4}, {method: rk4, step: 0.01, style: {lines: 2}}]\n");
  try {
    read_scene(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("style"));
  }
}

}  // namespace
}  // namespace chainreel
