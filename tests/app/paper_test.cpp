// Figures with a size on paper: what their PDF says, read back from its content: its page, and how large each word stands on it.
#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "app/paper/pose_page.hpp"
#include "encode/png.hpp"
#include "model/read_chain.hpp"
#include "support/fonts.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using Words = std::vector<std::string>;
using testing::HasSubstr;
using testing::Not;

// All content of a PDF, inflated, one stream behind the other.
std::string content_of(const std::string& pdf) {
  std::string all;
  for (std::size_t at = pdf.find("stream\n"); at != std::string::npos; at = pdf.find("stream\n", at + 7)) {
    if (at >= 3 && pdf.compare(at - 3, 3, "end") == 0) continue;
    std::string part(1 << 16, '\0');
    z_stream inflater{};
    if (inflateInit(&inflater) != Z_OK) continue;
    inflater.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(pdf.data() + at + 7));
    inflater.avail_in = uInt(pdf.size() - at - 7);
    int state = Z_OK;
    std::string stream;
    while (state == Z_OK) {
      inflater.next_out = reinterpret_cast<Bytef*>(part.data());
      inflater.avail_out = uInt(part.size());
      state = inflate(&inflater, Z_NO_FLUSH);
      stream.append(part, 0, part.size() - inflater.avail_out);
    }
    inflateEnd(&inflater);
    if (state == Z_STREAM_END && stream.find(" Tf") != std::string::npos) all += stream + "\n";
  }
  return all;
}

// In pt, how tall the em of each text is: by the matrix that holds for the page, that of the text, and the size of its font.
std::vector<double> text_sizes(const std::string& pdf) {
  std::istringstream words(content_of(pdf));
  std::vector<double> sizes, numbers, outer{1};
  double page = 1, text = 1, font = 0;
  for (std::string word; words >> word;) {
    const auto height = [&] {
      return numbers.size() < 6 ? 1 : std::hypot(numbers[numbers.size() - 4], numbers[numbers.size() - 3]);
    };
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end == 0) {
      numbers.push_back(number);
      continue;
    }
    if (word == "q") outer.push_back(page);
    if (word == "Q" && outer.size() > 1) page = outer.back(), outer.pop_back();
    if (word == "cm") page *= height();
    if (word == "Tm") text = height();
    if (word == "Tf" && !numbers.empty()) font = numbers.back();
    if (word.ends_with("Tj") || word.ends_with("TJ")) sizes.push_back(page * text * font);
    if (word != "/f-0-0" && !word.starts_with('/')) numbers.clear();
  }
  return sizes;
}

struct PaperFigure {
  std::string name;
  std::vector<std::string> words;
};

// As each command has them; the scene's own words are in all of them.
std::vector<PaperFigure> figures() {
  return {
      {"scene", {"snapshot", "assets/scenes/rr_torque.yaml", "--at", "0.5"}},
      {"panels", {"snapshot", "assets/scenes/euler_gains_energy.yaml", "--at", "1"}},
      {"pose", {"snapshot", "models/rr.urdf", "--pose", "0.3,1"}},
      {"chart", {"chart", "assets/scenes/rr_free.yaml", "--set", "duration=0.2", "--methods", "rk4,dop853", "--runs", "1", "--longest", "20ms"}},
      {"energy", {"energy", "assets/scenes/rr_free.yaml", "--until", "1s", "--step", "0.01", "--methods", "rk4,symplectic_euler"}},
      {"stability", {"stability", "assets/scenes/pp_spring.yaml", "--x", "step=0.05:0.3:4", "--y", "start.q.2=0.1:0.4:4"}},
      {"ellipse", {"ellipse", "models/rr.urdf", "--sweep", "q2=30deg:150deg:3"}},
      {"joint_space", {"ellipse", "models/rr.urdf", "--joint-space", "--letters", "--sweep", "q2=30deg:150deg:6"}},
  };
}

// Indices in formulas, and those of powers of ten, are 0.7 of their letters; no other words are smaller than 7 pt.
TEST(OnPaper, NoWordIsSmallerThanSevenPoints) {
  const TemporaryFolder folder;
  for (const double width : {84.0, 174.0})
    for (PaperFigure figure : figures()) {
      const std::string file = folder.file(figure.name + ".pdf");
      figure.words.insert(figure.words.end(), {"--width-mm", std::to_string(int(width)), "-o", file, "--force", "--quiet"});
      const ProgramResult result = run_program(figure.words);
      ASSERT_EQ(result.status, 0) << figure.name << " " << width << result.err;
      const std::string pdf = read_whole_file(file);
      EXPECT_THAT(run_command({"pdfinfo", file}).out, HasSubstr(width < 100 ? "238.11 x" : "493.2")) << figure.name << ": as wide as it says, in pt";
      const std::vector<double> sizes = text_sizes(pdf);
      if (figure.name != "pose") {
        EXPECT_GT(sizes.size(), 2u) << figure.name;
      }
      for (const double size : sizes) {
        EXPECT_GE(size, 0.7 * 7 - 0.01) << figure.name << " " << width;
        EXPECT_LT(size, 40) << figure.name << ": what is read is no size of a font";
      }
      std::size_t words = 0;
      for (const double size : sizes) words += size >= 7 - 0.01 ? 1 : 0;
      EXPECT_GE(double(words), 0.5 * double(sizes.size())) << figure.name << ": most are no indices";
    }
}

// Negative control: what the test above reads is smaller where the page has no size on paper but that of a column's shape.
TEST(OnPaper, TheSameReadsSmallWords) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.pdf");
  ASSERT_EQ(run_program({"snapshot", "assets/scenes/rr_torque.yaml", "--at", "0.5", "--width", "480", "--height", "270", "-o", file}).status, 0);
  const std::vector<double> sizes = text_sizes(read_whole_file(file));
  ASSERT_FALSE(sizes.empty());
  EXPECT_LT(*std::min_element(sizes.begin(), sizes.end()), *std::max_element(sizes.begin(), sizes.end()));
}

TEST(OnPaper, PagesHaveTheShapeThatIsAskedFor) {
  const TemporaryFolder folder;
  const auto svg = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--width-mm", "84", "-o", folder.file("a.svg"), "--force", "--quiet"});
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_whole_file(folder.file("a.svg"));
  };
  EXPECT_THAT(svg({"snapshot", "assets/scenes/rr_torque.yaml"}), HasSubstr("width=\"84mm\" height=\"47.2"));
  EXPECT_THAT(svg({"snapshot", "assets/scenes/rr_torque.yaml", "--set", "video={width: 800, height: 800}"}), HasSubstr("height=\"84"));
  EXPECT_THAT(svg({"snapshot", "assets/scenes/rr_torque.yaml", "--height-mm", "70"}), HasSubstr("width=\"84mm\" height=\"70"));
  // A .png says how large it is: 100 dots an inch are 331 pixels of 84 mm.
  ASSERT_EQ(run_program({"snapshot", "models/rr.urdf", "--width-mm", "84", "--dpi", "100", "-o", folder.file("a.png")}).status, 0);
  EXPECT_EQ(read_png(folder.file("a.png")).width, 331);
  EXPECT_THAT(read_whole_file(folder.file("a.png")), HasSubstr("pHYs"));
}

// The page of a comparison in a column is as high as its panels and plot need; a height that is asked for holds, and what is
// too small on it is told with the height that is not.
TEST(OnPaper, PagesAreAsHighAsPanelsAndPlotsNeed) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.svg");
  const auto drawn = [&](const std::string& scene, std::vector<std::string> more) {
    std::vector<std::string> words{"snapshot", "assets/scenes/" + scene + ".yaml", "--at", "1", "--width-mm", "84", "-o", file, "--force"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << scene << result.err;
    const std::string svg = read_whole_file(file);
    const std::size_t at = svg.find("height=\"");
    return std::pair(std::strtod(svg.c_str() + at + 8, nullptr), result.err);
  };
  for (const char* scene : {"big_steps", "pen_drift", "euler_gains_energy"}) {
    const auto [height, words] = drawn(scene, std::string(scene) == "big_steps" ? Words{"--set", "plot="} : Words{});  // beside a plot its panels are too low there, which is told
    EXPECT_GT(height, 1.1 * 47.25) << scene << ": a page of the usual shape has no room";
    EXPECT_LE(height, 2.5 * 84 * 1.001) << scene;
    EXPECT_THAT(words, HasSubstr(" mm high, so that plots and panels have room beside words of 7 pt")) << scene;
    EXPECT_THAT(words, Not(HasSubstr("not drawn"))) << scene;
  }
  const auto [usual, quiet] = drawn("rr_free", {"--set", "layout=scene"});
  EXPECT_NEAR(usual, 47.2, 0.1) << "one that has room keeps its shape";
  EXPECT_THAT(quiet, Not(HasSubstr("so that plots")));
  const auto [asked, told] = drawn("pen_drift", {"--height-mm", "47"});
  EXPECT_NEAR(asked, 47, 0.1);
  EXPECT_THAT(told, HasSubstr(" mm high on a page of this size: take --height-mm "));
}

// Three narrow panels side by side need no page that is higher than it is wide.
TEST(OnPaper, EllipsesAtPosesAreAsHighAsTheirPanelsNeed) {
  const TemporaryFolder folder;
  const auto height = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"ellipse", "models/rr.urdf", "--width-mm", "84", "-o", folder.file("a.svg"), "--force"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run_program(words).status, 0);
    const std::string svg = read_whole_file(folder.file("a.svg"));
    return std::stod(svg.substr(svg.find("height=\"") + 8));
  };
  const double three = height({"--pose", "0,90deg", "--pose", "30deg,60deg", "--pose", "0,150deg", "--letters"});
  EXPECT_LT(three, 100);
  EXPECT_GT(three, 35);
  EXPECT_LT(height({"--pose", "0,90deg", "--pose", "30deg,60deg", "--layout", "row"}), 100) << "as large as the width allows";
}

// From five poses on a caption has one line, and the picture at least 70 % of its cell, on a column and across a page. On pages whose height is
// given there may be no room for that: the control.
TEST(OnPaper, ManyPosesHaveOneLineEach) {
  const Chain chain = read_chain("models/rr.urdf");
  const TipMass mass(chain);
  for (const double width : {84.0, 174.0})
    for (const std::size_t count : {5, 7, 12})
      for (const bool letters : {false, true}) {
        std::vector<std::vector<double>> poses;
        for (std::size_t i = 0; i < count; ++i) poses.push_back({0.35 * double(i), 0.7 + 0.15 * double(i)});
        PoseFigureOptions figure;
        figure.letters = letters;
        put_on_paper(figure, {.width_mm = width}, mass, poses, fonts());
        const PoseFigureFit fit = fit_of_poses(mass, poses, figure, fonts());
        EXPECT_TRUE(fit.is_compact && fit.is_whole && fit.has_masses) << width << " mm, " << count << " poses";
        if (width > 84 || count < 8) continue;
        PoseFigureOptions low;
        put_on_paper(low, {.width_mm = width, .height_mm = 40}, mass, poses, fonts());
        EXPECT_FALSE(fit_of_poses(mass, poses, low, fonts()).is_compact);
      }
}

// No pose loses its Lambda in silence: a page that is made for it has room, and one that has none says so.
TEST(OnPaper, EllipsesHaveTheirMassesOrSayThatThereIsNoRoom) {
  const TemporaryFolder folder;
  const auto told = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"ellipse", "models/rr.urdf", "--width-mm", "84", "-o", folder.file("a.svg"), "--force"};
    for (const char* pose : {"0,30deg", "0,90deg", "0,150deg"}) words.insert(words.end(), {"--pose", pose});
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0);
    return result.err;
  };
  EXPECT_EQ(told({"--letters"}), "");
  EXPECT_EQ(told({"--letters", "--layout", "row"}), "");
  EXPECT_THAT(told({"--letters", "--layout", "row", "--height-mm", "22", "--pose", "10deg,45deg", "--pose", "20deg,100deg"}), testing::HasSubstr("no room for the masses"));
}

TEST(OnPaper, JointSpaceIsAsHighAsItsPosesNeed) {
  const TemporaryFolder folder;
  const auto drawn = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"ellipse", "models/rr.urdf", "--joint-space", "--sweep", "q2=30deg:150deg:6", "-o", folder.file("a.svg"), "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  const ProgramResult column = drawn({"--width-mm", "84"});
  ASSERT_EQ(column.status, 0) << column.err;
  EXPECT_THAT(column.err, testing::ContainsRegex("the page is 2[0-9][0-9] mm high, so that poses and axes have room"));
  // Half as high where two blocks stand beside one another, and without a note where nothing is but a table.
  EXPECT_THAT(drawn({"--width-mm", "174"}).err, testing::ContainsRegex("the page is 1[0-9][0-9] mm high"));
  EXPECT_EQ(drawn({"--width-mm", "84", "--quiet"}).err, "");
  const ProgramResult narrow = drawn({"--width-mm", "30"});
  EXPECT_EQ(narrow.status, 2);
  const std::size_t at = narrow.err.find("take --width-mm ");
  ASSERT_NE(at, std::string::npos) << narrow.err;
  const int least = std::atoi(narrow.err.c_str() + at + 16);
  EXPECT_EQ(drawn({"--width-mm", std::to_string(least)}).status, 0) << "the width that is named has room";
  EXPECT_EQ(drawn({"--width-mm", std::to_string(least - 1)}).status, 2) << "and is the least";
  const ProgramResult low = drawn({"--width-mm", "84", "--height-mm", "60"});
  EXPECT_EQ(low.status, 2);
  EXPECT_THAT(low.err, HasSubstr("take --height-mm "));
}

// Titles that no column holds, however high the page: the least width that does.
TEST(OnPaper, NamesTheWidthThatHasRoom) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"snapshot", "assets/scenes/euler_gains_energy.yaml", "--width-mm", "30", "-o", folder.file("a.pdf")});
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("a page 30 mm wide has no room for this beside words of 7 pt, however high it is"));
  EXPECT_THAT(result.err, HasSubstr("take --width-mm "));
}

TEST(OnPaper, SizesThatDoNotGoTogetherAreNamed) {
  const TemporaryFolder folder;
  for (const auto& figure : figures()) {
    const auto error = [&](std::vector<std::string> more) {
      std::vector<std::string> words = figure.words;
      words.insert(words.end(), more.begin(), more.end());
      words.insert(words.end(), {"-o", folder.file("x.pdf")});
      const ProgramResult result = run_program(words);
      EXPECT_EQ(result.status, 2) << figure.name << result.err;
      EXPECT_FALSE(std::filesystem::exists(folder.file("x.pdf")));
      return result.err;
    };
    EXPECT_THAT(error({"--width-mm", "84", "--width", "200"}), HasSubstr("leave out --width")) << figure.name;
    EXPECT_THAT(error({"--dpi", "600"}), HasSubstr("go with --width-mm")) << figure.name;
    EXPECT_THAT(error({"--width-mm", "5"}), HasSubstr("between 20 and 2000")) << figure.name;
    EXPECT_THAT(error({"--width-mm", "2000", "--dpi", "2400"}), HasSubstr("smaller --dpi")) << figure.name;
  }
}

// Fifteen names of 7 pt are higher than a column's chart: an error that says so, rather than names on one another.
TEST(OnPaper, MoreMethodsThanHaveRoomAreRefused) {
  const TemporaryFolder folder;
  const Words energy{"energy", "assets/scenes/rr_free.yaml", "--until", "0.2s", "--step", "0.01", "--width-mm", "84", "--height-mm", "40", "-o", folder.file("a.pdf")};
  const auto highlighting = [&](const std::string& names) {
    Words words = energy;
    words.insert(words.end(), {"--force", "--highlight", names});
    return run_program(words);
  };
  EXPECT_EQ(run_program(energy).status, 0) << "grey ones have no names there";
  EXPECT_EQ(highlighting("euler").status, 2);
  const ProgramResult result = highlighting("explicit_euler,semi_implicit_euler,rk4,dop853,taylor,radau5,symplectic_euler,verlet,implicit_midpoint,gauss4,gauss6,rattle2,rattle4,rattle6,rattle8");
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("name fewer by --methods, or take a higher page"));
}

// One reading, one picture, several files.
TEST(EllipseOutputs, MayBeSeveral) {
  const TemporaryFolder folder;
  const std::vector<std::string> files{folder.file("a.png"), folder.file("a.pdf"), folder.file("a.csv"), folder.file("a.json")};
  std::vector<std::string> words{"ellipse", "models/rr.urdf", "--pose", "0,1", "--json"};
  for (const std::string& file : files) words.insert(words.end(), {"-o", file});
  const ProgramResult result = run_program(words);
  ASSERT_EQ(result.status, 0) << result.err;
  for (const std::string& file : files) {
    EXPECT_GT(std::filesystem::file_size(file), 100u) << file;
    EXPECT_THAT(result.out, HasSubstr(file));
  }
  const ProgramResult bad = run_program({"ellipse", "models/rr.urdf", "--pose", "0,1", "-o", folder.file("b.png"), "-o", folder.file("b.bmp")});
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("b.bmp"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.png"))) << "nothing is begun before all of them can be written";
}

}  // namespace
}  // namespace chainreel
