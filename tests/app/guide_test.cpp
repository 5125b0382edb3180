// The reference and the pages for people: what lies in assets/guide is what the program says, and its examples run.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "app/guide/manual.hpp"
#include "app/guide/reference.hpp"
#include "core/json.hpp"
#include "expr/expression.hpp"
#include "picture/math_notation.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/read_scene.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string guide_output(std::vector<std::string> words) {
  words.insert(words.begin(), "help");
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.status, 0) << result.err;
  return result.out;
}

std::vector<std::string> guide_topics() {
  std::vector<std::string> topics;
  const Json all = parse_json(guide_output({"--json"}));
  for (const Json& one : all["topics"]) topics.push_back(one["topic"].get<std::string>());
  return topics;
}

// A block of a page between fences, and where it stands.
struct GuideBlock {
  std::string page, language, text;
};

// In the order in which a reader comes to them.
std::vector<fs::path> guide_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator("assets/guide"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  files.insert(files.begin(), "README.md");
  return files;
}

std::vector<GuideBlock> guide_blocks(const std::string& language) {
  std::vector<GuideBlock> blocks;
  for (const fs::path& page : guide_files()) {
    std::istringstream text(read_whole_file(page.string()));
    bool inside = false;
    for (std::string line; std::getline(text, line);) {
      if (!line.starts_with("```")) {
        if (inside) blocks.back().text += line + "\n";
        continue;
      }
      inside = !inside;
      if (inside) blocks.push_back({page.string(), line.substr(3), ""});
    }
    EXPECT_FALSE(inside) << page << ": a fence is left open";
  }
  std::erase_if(blocks, [&](const GuideBlock& block) { return block.language != language; });
  return blocks;
}

// `CHAINREEL_UPDATE_GOLDEN=1` writes the pages anew.
TEST(Guide, PagesAreWhatTheProgramSays) {
  const std::vector<std::string> topics = guide_topics();
  EXPECT_THAT(topics, testing::IsSupersetOf({"scene", "methods", "constraints", "outputs"}));
  for (const std::string& topic : topics) {
    const std::string path = "assets/guide/" + topic + ".md", text = guide_output({topic});
    if (std::getenv("CHAINREEL_UPDATE_GOLDEN")) std::ofstream(path) << text;
    EXPECT_TRUE(fs::exists(path) && read_whole_file(path) == text)
        << path << " is old: write it by `chainreel help " << topic << " > " << path
        << "`, or all by this test with CHAINREEL_UPDATE_GOLDEN=1";
  }
}

TEST(Guide, TellsOfEveryKeyWithItsUnitRangeAndDefault) {
  const std::string page = guide_output({"scene"});
  for (const SceneKey& key : scene_keys()) {
    if (key.is_section) continue;
    const std::size_t row = page.find("| `" + key.name + "`");
    ASSERT_NE(row, std::string::npos) << key.name;
    const std::string line = page.substr(row, page.find('\n', row) - row);
    EXPECT_THAT(line, HasSubstr(key.unit));
    EXPECT_THAT(line, HasSubstr(range_text(key.range, key.unit)));
    EXPECT_THAT(line, HasSubstr(key.is_required       ? "needed"
                                : key.absent.empty() ? key.text(key, Scene{})
                                                     : key.absent));
    EXPECT_THAT(line, HasSubstr(key.help));
    for (const Name& word : key.words) EXPECT_THAT(line, HasSubstr(std::string("`") + word.name + "`"));
  }
}

// Fragments of scenes are completed by a model and what they presuppose.
TEST(Guide, ExamplesOfScenesAreRead) {
  const std::vector<GuideBlock> blocks = guide_blocks("yaml");
  EXPECT_GE(blocks.size(), 15u);
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "assets");
  fs::create_directory_symlink(fs::absolute("models"), folder.path() / "models");
  fs::create_directory_symlink(fs::absolute("assets/scenes"), folder.path() / "assets/scenes");
  fs::create_directory(folder.path() / "assets/mine");
  // The motion that examples show.
  std::ofstream(folder.path() / "assets/mine/log.csv") << "t,stamp,q1,q2,pos_1,pos_2,vel_1,vel_2\n0,0,0,0,0,0,1,1\n1,1,1,1,1,1,1,1\n";
  for (const GuideBlock& block : blocks) {
    const bool is_whole = block.text.find("model:") != std::string::npos;
    const std::string path = (folder.path() / "assets/mine/scene.yaml").string();
    std::ofstream(path) << (is_whole ? "" : "model: ../../models/rr.urdf\n") << block.text;
    try {
      read_scene(path);
    } catch (const Error& error) {
      ADD_FAILURE() << block.page << ":\n" << block.text << error.what();
    }
  }
}

TEST(Guide, CommandsRun) {
  const TemporaryFolder folder;
  for (const char* part : {"assets", "models"})
    fs::create_directory_symlink(fs::absolute(part), folder.path() / part);
  fs::create_directory_symlink(fs::path(program_path()).parent_path(), folder.path() / "build");
  int commands = 0;
  for (const GuideBlock& block : guide_blocks("sh")) {
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("build/chainreel ")) continue;
      line = line.substr(0, line.find("  #"));
      if (line.find(" render ") != std::string::npos)
        line += " --set duration=0.2 --set video.width=320 --set video.height=180";
      const ProgramResult result = run_command({"sh", "-c", line}, {.folder = folder.path().string()});
      EXPECT_EQ(result.status, 0) << block.page << ": " << line << "\n" << result.err;
      ++commands;
    }
  }
  EXPECT_GE(commands, 25);
  for (const char* made : {"out/sheet.png", "out/index.html"}) EXPECT_TRUE(fs::exists(folder.path() / made)) << made;
}

TEST(Guide, ReadmeIsShort) {
  const std::string text = read_whole_file("README.md");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 100);
}

TEST(Guide, LinksLeadSomewhere) {
  static const std::regex link(R"(\]\(([^)#]+)\))");
  for (const fs::path& page : guide_files()) {
    const std::string text = read_whole_file(page.string());
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at)
      if (!(*at)[1].str().starts_with("http"))
        EXPECT_TRUE(fs::exists(page.parent_path() / (*at)[1].str())) << page << ": " << (*at)[1];
  }
}

TEST(Help, OnACommandIsItsOwn) {
  EXPECT_EQ(guide_output({"render"}), run_program({"render", "--help"}).out);
  const ProgramResult wrong = run_program({"help", "scenes"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'scene'?"));
}

// What the program, its module and its pages tell people to type.
// A terminal breaks lines within words, and rows of tables below their first column.
TEST(Help, LinesFitTheTerminal) {
  EXPECT_EQ(page_on_terminal("as it is\n\n- a list of words\n", 12), "as it is\n\n- a list of\n  words\n");
  EXPECT_EQ(page_on_terminal("| key | what it is |\n| `a` | one two three four |\n", 18), "| key | what it is\n| `a` | one two\n        three four\n");
  EXPECT_EQ(page_on_terminal("averyveryverylongword and others\n", 10), "averyveryverylongword\nand others\n");
  EXPECT_EQ(page_on_terminal("\u03bb\u03bb\u03bb \u03bb\u03bb\u03bb \u03bb\n", 7), "\u03bb\u03bb\u03bb \u03bb\u03bb\u03bb\n\u03bb\n");
  const std::string page = run_program({"help", "scene"}).out;
  for (const std::size_t columns : {80u, 120u}) {
    const std::string shown = page_on_terminal(page, columns);
    std::istringstream lines(shown), words(page), shown_words(shown);
    for (std::string line; std::getline(lines, line);)
      if (line.find(' ', line.find_first_not_of(" |-")) != std::string::npos) EXPECT_LE(line.size(), columns + 10) << line;
    // No word is lost.
    const auto next = [](std::istringstream& stream) {
      std::string word;
      while (stream >> word && (word == "|" || word.starts_with("---"))) {
      }
      return stream ? word : "";
    };
    for (std::string word = next(words); !word.empty(); word = next(words)) ASSERT_EQ(next(shown_words), word);
  }
}

TEST(Help, EveryTopicThatIsNamedAnywhereIsThere) {
  const std::regex named("(?:chainreel help|`help) ([a-z][a-z-]*)");
  std::set<std::string> topics;
  for (const char* folder : {"src", "assets/guide", "assets/scenes", "assets/ci"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file() || entry.path().extension() == ".png") continue;
      const std::string text = read_whole_file(entry.path().string());
      for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at) topics.insert((*at)[1].str());
    }
  EXPECT_THAT(topics, testing::IsSupersetOf({"scene", "snapshots", "layers"})) << "negative control: some are found";
  for (const std::string& topic : topics) EXPECT_EQ(run_program({"help", topic}).status, 0) << "chainreel help " << topic;
}

TEST(Help, FormulasThatAreToldAreFormulas) {
  const std::string page = guide_output({"formulas"});
  for (const Name& one : formula_notation()) {
    EXPECT_THAT(page, HasSubstr("`" + std::string(one.name) + "`"));
    EXPECT_NO_THROW(parse_math(one.name)) << one.name;
  }
}

TEST(Help, ToldNamesAreThoseThatExpressionsKnow) {
  const std::string page = guide_output({"expressions"});
  for (const char* function : {"sin", "atan2", "max"}) {
    EXPECT_THAT(page, HasSubstr(std::string("`") + function + "("));
    EXPECT_TRUE(is_reserved_name(function));
  }
}

}  // namespace
}  // namespace chainreel
