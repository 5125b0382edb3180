// Contact sheets as files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/works/moment.hpp"
#include "core/json.hpp"
#include "encode/png.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

// Chains with and without ellipse, vectors, closures and panels.
ProgramResult sheet(const std::vector<std::string>& more) {
  std::vector<std::string> command{"sheet"};
  for (const char* scene :
       {"rr_ellipse", "four_bar", "rr_forces", "euler_gains_energy", "humanoid_fall", "pp_spring"})
    command.push_back("assets/scenes/" + std::string(scene) + ".yaml");
  command.insert(command.end(), more.begin(), more.end());
  return run_program(command);
}

std::vector<std::string> small(const std::string& file, const std::string& theme) {
  return {"-o",  file,      "--at", "1.2",          "--width", "640",   "--height",
          "360", "--theme", theme,  "--text-scale", "1.5",     "--json"};
}

class SheetInTheme : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Themes, SheetInTheme, ::testing::Values("light", "dark"),
                         [](const auto& p) { return p.param; });

TEST_P(SheetInTheme, LooksLikeItsGolden) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.png");
  const ProgramResult result = sheet(small(file, GetParam()));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["columns"], 3);
  EXPECT_TRUE(matches_golden(read_png(file), "sheet_" + GetParam(), {.max = 24, .mean = 0.05}));
}

TEST(Sheet, ShowsAnotherInstantAndOtherKeysWhereAsked) {
  const TemporaryFolder folder;
  const auto picture = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> command = small(folder.file(name), "light");
    command.insert(command.end(), more.begin(), more.end());
    const ProgramResult result = sheet(command);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_png(folder.file(name));
  };
  const Image plain = picture("a.png", {});
  EXPECT_EQ(compare_pictures(plain, picture("b.png", {})).max, 0);
  EXPECT_GT(compare_pictures(plain, picture("c.png", {"--set", "draw=[chain, com]"})).mean, 0.1);
  EXPECT_GT(compare_pictures(plain, picture("d.png", {"--columns", "2"})).mean, 1.0);
}

TEST(Sheet, ShowsTheEndOfAShorterSceneAndTheLastEventUnasked) {
  const TemporaryFolder folder;
  const std::string fall = "assets/scenes/humanoid_fall.yaml";
  const auto picture = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> command{"sheet",   fall,  "-o",       folder.file(name),
                                     "--width", "320", "--height", "180"};
    command.insert(command.end(), more.begin(), more.end());
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_png(folder.file(name));
  };
  // The run ends with the fall, its last event.
  const Image unasked = picture("a.png", {});
  EXPECT_EQ(compare_pictures(unasked, picture("b.png", {"--at", "1000"})).max, 0);
  EXPECT_GT(compare_pictures(unasked, picture("c.png", {"--at", "0"})).mean, 0.1);
}

// One frame a second: the events come behind the only frame of the film, and between two.
TEST(Sheet, ShowsAnEventThatNoFrameShows) {
  const TemporaryFolder folder;
  const Fonts fonts;
  for (const auto& [name, event, at] : {std::tuple{"a.yaml", "{when: \"t > 0.95\", kind: stop}", 0.95},
                                        {"b.yaml", "{when: \"t > 0.95\"}", 0.95},
                                        {"c.yaml", "{when: \"t > 0.35\"}", 0.35}}) {
    const std::string scene = folder.write(
        name, "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nduration: 1\nvideo: {fps: 1}\nevents: [" +
                  std::string(event) + "]\n");
    const Moment moment = telling_moment(load_film(scene, {}), fonts);
    EXPECT_NEAR(moment.at, at, 1e-9) << name;  // events are found to 1e-12 s, times of this run are below 1 s
    EXPECT_EQ(moment.memory.audit["at"], moment.at);
    const auto shows = [&](const std::string& words) {
      return std::any_of(moment.picture.items.begin(), moment.picture.items.end(), [&](const Item& item) {
        const auto* run = std::get_if<GlyphRun>(&item.shape);
        return run && run->text == words;
      });
    };
    EXPECT_TRUE(shows("t = 0." + std::to_string(std::lround(at * 100)) + " s")) << name;
    EXPECT_FALSE(shows("t = 0.00 s")) << name;
  }
}

TEST(Sheet, IsAVectorPageToo) {
  const TemporaryFolder folder;
  for (const char* name : {"a.svg", "a.pdf"}) {
    const ProgramResult result = run_program(
        {"sheet", "assets/scenes/rr_free.yaml", "assets/scenes/pp_free.yaml", "-o", folder.file(name)});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  EXPECT_THAT(read_whole_file(folder.file("a.svg")), HasSubstr("Contact sheet"));
  EXPECT_TRUE(read_whole_file(folder.file("a.pdf")).starts_with("%PDF"));
}

// Three panels of a cell, told apart; not where the cells are too small for words.
TEST(Sheet, NamesThePanelsOfComparisonsWhereThereIsRoom) {
  const TemporaryFolder folder;
  const auto drawn = [&](int columns) {
    const std::string file = folder.file("a.svg");
    const ProgramResult result = run_program({"sheet", "assets/scenes/pen_drift.yaml", "assets/scenes/euler_gains_energy.yaml", "--columns",
                                              std::to_string(columns), "--width", columns > 1 ? "600" : "1920", "--height", columns > 1 ? "2000" : "1080",
                                              "-o", file, "--force"});
    EXPECT_EQ(result.status, 0) << result.err;
    return read_whole_file(file);
  };
  const std::string large = drawn(1);
  for (const char* name : {"none: it drifts", "Baumgarte", "projected", "truth (Taylor series)"}) EXPECT_THAT(large, HasSubstr(name));
  EXPECT_THAT(drawn(2), testing::Not(HasSubstr("Baumgarte<")));
}

// What a run tells of itself stands in the title of its instants, too; and the title may be another one.
TEST(Sheet, HasItsTitleFilledIn) {
  const TemporaryFolder folder;
  const auto pixels = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"sheet", "humanoid_fall", "--at", "0,1,2", "--force", "--quiet", "-o", folder.file("a.png")};
    command.insert(command.end(), more.begin(), more.end());
    EXPECT_EQ(run_program(command).status, 0);
    return read_png(folder.file("a.png")).bgra;
  };
  const auto own = pixels({});
  EXPECT_TRUE(own == pixels({"--title", "A standing human falls in 1.65 s"}));
  EXPECT_FALSE(own == pixels({"--title", "A standing human falls in {fall}"}));
}

TEST(Sheet, RefusesATitleThatIsNoFormulaOrHasNoRoom) {
  const TemporaryFolder folder;
  const auto titled = [&](const std::string& title) { return run_program({"sheet", "rr_free", "--title", title, "--width-mm", "84", "--quiet", "--force", "-o", folder.file("a.pdf")}); };
  EXPECT_EQ(titled("Six moments").status, 0);
  EXPECT_NE(titled("$\\bad$").status, 0);
  EXPECT_THAT(titled(std::string(500, 'W')).err, HasSubstr("a shorter --title"));
}

// On paper words are of a paper's size: more of them stand below a picture than on a slide.
TEST(Sheet, OnPaperHasWordsOfAPaper) {
  const TemporaryFolder folder;
  const auto size_of_words = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"sheet", "rr_free", "rr_torque", "--width-mm", "210", "--force", "--quiet", "-o", folder.file("a.pdf")};
    command.insert(command.end(), more.begin(), more.end());
    EXPECT_EQ(run_program(command).status, 0);
    return read_whole_file(folder.file("a.pdf"));
  };
  EXPECT_NE(size_of_words({}), size_of_words({"--text-scale", "1.5"}));
  EXPECT_NE(size_of_words({}), size_of_words({"--text-scale", "0.8"})) << "down to 7 pt";
  // Of A4 upright a caption has room for some 100 letters.
  const std::string scene = folder.write("long.yaml", "title: A pen that is held at y = 0.6 m while it goes along its line, and what it presses with on the paper below\nmodel: {links: [1, 1]}\nduration: 0.1\n");
  const std::string pdf = folder.file("long.pdf");
  ASSERT_EQ(run_program({"sheet", scene, "rr_free", "pen", "--width-mm", "210", "--quiet", "-o", pdf}).status, 0);
  const ProgramResult words = run_command({"pdftotext", pdf, "-"}, {});
  EXPECT_THAT(words.out, HasSubstr("paper below")) << words.err;
}

// No higher than its rows: what is free below them is a margin, as it is above.
TEST(Sheet, OnPaperIsAsHighAsItsRows) {
  const TemporaryFolder folder;
  const auto page = [&](std::vector<std::string> scenes, const std::string& width) {
    std::vector<std::string> command{"sheet", "--width-mm", width, "--dpi", "72", "--set", "duration=1", "--force", "--quiet", "-o", folder.file("a.png")};
    command.insert(command.end(), scenes.begin(), scenes.end());
    EXPECT_EQ(run_program(command).status, 0);
    return read_png(folder.file("a.png"));
  };
  const auto blank_rows = [](const Image& image, bool from_top) {
    int rows = 0;
    for (; rows < image.height; ++rows)
      for (int x = 0; x < image.width; ++x)
        if (image.at(x, from_top ? rows : image.height - 1 - rows).r < 250) return rows;
    return rows;
  };
  const Image one = page({"rr_free"}, "84"), three = page({"rr_free", "rr_torque", "pen"}, "84"), four = page({"rr_free", "rr_torque", "pen", "pp_free"}, "174");
  EXPECT_GT(three.height, 2 * one.height) << "one column";
  EXPECT_LT(four.height, four.width) << "two columns, two rows";
  for (const Image* image : {&one, &three, &four}) {
    EXPECT_LT(blank_rows(*image, true), 0.08 * image->height);
    EXPECT_LT(blank_rows(*image, false), 0.12 * image->height) << "with the room for a second line of a caption";
  }
}

TEST(Sheet, TellsTheProblemsOfAllScenes) {
  const TemporaryFolder folder;
  const std::string bad = folder.write("bad.yaml", "model: none.urdf\ndurration: 3\n");
  const ProgramResult result = run_program({"sheet", bad, "missing.yaml", "-o", folder.file("a.png")});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("durration"));
  EXPECT_THAT(result.err, HasSubstr("missing.yaml"));
  EXPECT_EQ(run_program({"sheet", bad, "-o", folder.file("a.txt")}).status, 2);
  EXPECT_EQ(run_program({"sheet", "assets/scenes/rr_free.yaml", "--at", "-1"}).status, 2);
  std::vector<std::string> many{"sheet"};
  many.insert(many.end(), 49, "assets/scenes/rr_free.yaml");
  EXPECT_EQ(run_program(many).status, 2);
}

// A handout: one scene at several instants, at one scale, each with its time; its title, with formulas, above all.
// Each scene at instants of its own, by its name; the others at their telling ones.
TEST(Sheet, ShowsScenesAtInstantsOfTheirOwn) {
  const TemporaryFolder folder;
  const auto made = [&](const std::string& at) {
    return run_program({"sheet", "assets/scenes/rr_free.yaml", "assets/scenes/pen.yaml", "assets/scenes/four_bar.yaml", "--at", at, "--json", "-o", folder.file("a.svg"), "--force"});
  };
  const ProgramResult result = made("pen=2.6s,rr_free=1s,rr_free=2s");
  ASSERT_EQ(result.status, 0) << result.err;
  std::vector<double> at;
  const Json cells = Json::parse(result.out)["cells"];
  for (const Json& cell : cells) at.push_back(cell["at"].get<double>());
  ASSERT_EQ(at.size(), 4u);
  EXPECT_EQ(std::vector<double>(at.begin(), at.begin() + 3), (std::vector<double>{1, 2, 2.6}));
  const std::string page = read_whole_file(folder.file("a.svg"));
  EXPECT_THAT(page, testing::AllOf(HasSubstr("t = 2.60 s: Pen"), HasSubstr("t = 1.00 s: RR"), HasSubstr(" s: Four-bar")));
  // One for all goes to those that are not named.
  const Json both = Json::parse(made("0.5,pen=2.6s").out)["cells"];
  EXPECT_EQ(both[0]["at"], 0.5);
  EXPECT_EQ(both[1]["at"], 2.6);
  EXPECT_THAT(made("pan=2.6s").err, HasSubstr("no scene of the sheet is called 'pan': did you mean 'pen'?"));
}

// Cells of one scene are seen by one camera, also where an instant lies behind the last frame: the base stands in the same place.
TEST(Sheet, HasOneScaleForOneScene) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [0.5, 0.4]}\nstart: {q: [1.5, 0]}\nduration: 0.6\nmethod: rk4\nvideo: {fps: 10}\ndraw: [chain, ground]\n");
  const std::string png = folder.file("a.png");
  ASSERT_EQ(run_program({"sheet", scene, "--at", "0,0.6", "--columns", "2", "--width", "800", "--height", "400", "-o", png, "--quiet"}).status, 0);
  const Image image = read_png(png);
  // Where the ground below the base begins and ends in a cell, from the cell's left edge.
  const auto ground = [&](int left) {
    std::pair<int, int> extent{image.width, 0};
    for (int y = 324; y < 334; ++y)
      for (int x = 20; x < 360; ++x)
        if (image.at(left + x, y).r < 200) extent = {std::min(extent.first, x), std::max(extent.second, x)};
    return extent;
  };
  const auto first = ground(18), second = ground(404);
  ASSERT_LT(first.first, first.second);
  EXPECT_NEAR(first.first, second.first, 1);
  EXPECT_NEAR(first.second, second.second, 1);
}

TEST(Sheet, ShowsOneSceneAtSeveralInstants) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "title: \"Driven by $tau_1 = 5$ N m\"\nmodel: {links: [0.5, 0.4]}\ntorque: [5, 0]\nduration: 2\nmethod: rk4\n"
                                                   "events: [{name: down, when: \"q1 < -1.2\"}]\n");
  const std::string svg = folder.file("a.svg"), png = folder.file("a.png");
  const ProgramResult made = run_program({"sheet", scene, "--at", "0,0.5s,event down", "--at", "99", "-o", svg, "-o", png, "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  const Json cells = Json::parse(made.out)["cells"];
  ASSERT_EQ(cells.size(), 4u);
  EXPECT_EQ(cells[1]["at"], 0.5);
  EXPECT_GT(cells[2]["at"].get<double>(), 0.1);
  EXPECT_EQ(cells[3]["at"], 2.0) << "over by then: its end";
  const std::string words = read_whole_file(svg);
  for (const char* time : {"t = 0.00 s", "t = 0.50 s", "t = 2.00 s"}) EXPECT_THAT(words, HasSubstr(time));
  EXPECT_THAT(words.substr(words.find("</metadata>")), testing::Not(HasSubstr("$tau_1")));
  // Several scenes have the instants one after the other, and each says whose it is.
  const ProgramResult two = run_program({"sheet", scene, "assets/scenes/pp_free.yaml", "--at", "0,0.1", "-o", svg, "--force", "--json"});
  ASSERT_EQ(two.status, 0) << two.err;
  EXPECT_EQ(Json::parse(two.out)["cells"].size(), 4u);
  EXPECT_THAT(read_whole_file(svg), HasSubstr("t = 0.10 s: "));
  for (const char* wrong : {"-1", "0,x", "0,,1"})
    EXPECT_EQ(run_program({"sheet", scene, "--at", wrong, "-o", folder.file("b.png")}).status, 2) << wrong;
  EXPECT_EQ(run_program({"sheet", scene, "--at", "event nothing", "-o", folder.file("b.png")}).status, 2);
  EXPECT_EQ(run_program({"sheet", scene, "-o", png, "-o", png, "--force"}).status, 2);
}

}  // namespace
}  // namespace chainreel
