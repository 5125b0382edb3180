// The first steps: a chain of one's own from a few numbers, and what comes with the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <map>
#include <sstream>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const Words kBrief{"--set", "duration=0.05", "--quiet"};
const Words kTiny{"--set", "video.width=64", "--set", "video.height=36"};

// Everything that a run tells of its motion, by its hash.
std::string motion_of(const std::string& scene, const Words& more = {}) {
  const TemporaryFolder folder;
  const ProgramResult made =
      run_program(with(with({"simulate", scene, "-o", folder.file("a.csv"), "--json", "--set", "duration=0.5"}, more), {}));
  EXPECT_EQ(made.status, 0) << made.err;
  return made.status == 0 ? Json::parse(made.out).value("trajectory_sha256", "") : "";
}

TEST(InitOfNumbers, WritesTheChainThatASceneWithThoseNumbersHas) {
  const TemporaryFolder folder;
  const ProgramResult made = run_program({"init", folder.file("my_arm"), "--links", "0.5,0.4,0.3", "--masses", "2,1.5,1", "--joints",
                                          "RRR", "--damping", "0.1"});
  ASSERT_EQ(made.status, 0) << made.err;
  const Words inline_model{"--set", "model={links: [0.5, 0.4, 0.3], masses: [2, 1.5, 1], joints: RRR, damping: 0.1}"};
  const std::string of_file = motion_of(folder.file("my_arm.yaml"));
  EXPECT_EQ(of_file.size(), 64u);
  EXPECT_EQ(motion_of(folder.file("my_arm.yaml"), inline_model), of_file);
  EXPECT_NE(motion_of(folder.file("my_arm.yaml"), with(inline_model, {"--set", "model.damping=0.2"})), of_file);
}

TEST(InitOfNumbers, RendersWithoutAnotherWord) {
  const TemporaryFolder folder;
  folder.write("table.csv", "# an elbow arm\na, alpha, d, theta, mass\n0, 90deg, 0.6, 0, 3\n0.5, 0, 0, 0, 2\n0.4, 0, 0, 0, 1\n");
  const std::vector<std::pair<std::string, Words>> chains{
      {"one", {"--links", "1"}},  {"letters", {"--joints", "RPR"}}, {"point", {"--links", "1,1", "--shape", "point"}},
      {"dh", {"--dh", folder.file("table.csv")}}, {"cart", {"--joints", "PR", "--masses", "2,1"}}};
  for (const auto& [name, words] : chains) {
    const ProgramResult made = run_program(with({"init", folder.file(name)}, words));
    ASSERT_EQ(made.status, 0) << name << made.err;
    const ProgramResult drawn = run_program(
        with(with({"render", folder.file(name + ".yaml"), "-o", folder.file(name + ".gif")}, kBrief), kTiny));
    EXPECT_EQ(drawn.status, 0) << name << drawn.err;
    EXPECT_EQ(drawn.err, "") << name;
    EXPECT_EQ(run_program({"check", folder.file(name + ".urdf")}).status, 0) << name;
  }
}

TEST(InitOfNumbers, RefusesWhatDoesNotFitBeforeItWrites) {
  const TemporaryFolder folder;
  folder.write("bad.csv", "a,alpha,d,theta\n1,2,3,4\n1,2,3\n");
  folder.write("names.csv", "a,alpha,d,beta\n1,2,3,4\n");
  const std::vector<std::tuple<Words, int, std::string>> wrong{
      {{"--links", "1,1", "--masses", "1,2,3"}, 2, "--masses has 3 numbers, but the chain has 2 links"},
      {{"--links", "1,1", "--joints", "RX"}, 2, "--joints must be letters R"},
      {{"--links", "1,-1"}, 2, "--links holds -1"},
      {{"--links", "1,abc"}, 2, "--links 1,abc"},
      {{"--links", "1", "--convention", "modified"}, 2, "--convention is of --dh"},
      {{"--from", "rr", "--links", "1"}, 2, "--from copies a scene"},
      {{"--from", "rrrr"}, 2, "did you mean 'rrr'?"},
      {{"--links", "1,0", "--shape", "point"}, 3, "joint 'joint2' moves no mass"},
      {{"--dh", folder.file("bad.csv")}, 3, "bad.csv:3: has 3 cells under 4 names"},
      {{"--dh", folder.file("names.csv")}, 3, "names.csv:1: 'beta' names no column"},
      {{"--dh", folder.file("absent.csv")}, 3, "absent.csv"}};
  for (const auto& [words, status, text] : wrong) {
    const ProgramResult result = run_program(with({"init", folder.file("arm")}, words));
    EXPECT_EQ(result.status, status) << text << result.err;
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_FALSE(fs::exists(folder.file("arm.yaml")));
    EXPECT_FALSE(fs::exists(folder.file("arm.urdf")));
  }
}

TEST(InitFrom, CopiesAnySceneOfTheProgramWithItsComments) {
  const TemporaryFolder folder;
  int scenes = 0;
  Words names{"rr", "rrr", "pp", "four_bar", "pen", "humanoid", "compare"};
  for (const auto& entry : fs::directory_iterator("assets/scenes")) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (const std::string& name : names) {
    const ProgramResult made = run_program({"init", folder.file(name), "--from", name});
    ASSERT_EQ(made.status, 0) << name << made.err;
    const std::string text = read_whole_file(folder.file(name + ".yaml"));
    EXPECT_THAT(text, HasSubstr("model: \"" + name + ".urdf\"")) << name;
    if (!fs::exists("assets/scenes/" + name + ".yaml")) continue;
    ++scenes;
    std::string original = read_whole_file("assets/scenes/" + name + ".yaml");
    const std::size_t at = original.find("model: ");
    original.replace(at, original.find('\n', at) - at, "model: \"" + name + ".urdf\"");
    EXPECT_EQ(text, original) << name;
  }
  EXPECT_GE(scenes, 18);
  EXPECT_EQ(motion_of(folder.file("rr.yaml")), motion_of("assets/scenes/rr_free.yaml"));
}

// What every command that takes a scene makes of one whose model stands in it.
TEST(SceneWithAModelInNumbers, IsTakenByEveryCommandOfScenes) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml",
                                         "model: {links: [0.5, 0.4], masses: [2, 1]}\nstart: {q: [0.1, 0.5]}\ngravity: [0, -9.81, 0]\ntorque: [0, 0]\nmethod: rk4\nstep: 0.01\n"
                                         "duration: 0.05\nvideo: {width: 64, height: 36}\n"
                                         "events: [{when: \"y_G < -9\", kind: fall}]\n");
  folder.write("q.csv", "t,q1,q2\n0,0,0\n0.3,0.7,1\n1,1,2\n");
  folder.write("suite.yaml", "scene: s.yaml\nsize: 64x36\nat: [0.03]\n");
  const std::vector<Words> commands{
      {"check", scene},
      {"render", scene, "-o", folder.file("a.gif"), "--quiet"},
      {"render", scene, "-o", folder.file("a.mp4"), "--quiet", "--shard", "1/1"},
      {"snapshot", scene, "-o", folder.file("a.svg")},
      {"sheet", scene, "-o", folder.file("sheet.png")},
      {"simulate", scene, "-o", folder.file("a.csv")},
      {"dynamics", scene},
      {"inverse", scene, "--trajectory", folder.file("q.csv"), "-o", folder.file("tau.csv")},
      {"ellipse", "--along", scene, "-o", folder.file("e.csv")},
      {"chart", scene, "--methods", "rk4", "--runs", "1", "--longest", "0.01", "-o", folder.file("chart.csv")},
      {"energy", scene, "--until", "0.1s", "--step", "0.01", "--methods", "rk4", "-o", folder.file("energy.csv")},
      {"stability", scene, "--x", "step=0.001:0.002:2", "--y", "gravity.2=-9:-8:2", "-o", folder.file("stability.csv")},
      {"sweep", scene, "--over", "model.damping=0:1:3", "-o", folder.file("sweep.csv")},
      {"fall", scene, "--sweep", "torque.2=0,2", "-o", folder.file("fall.csv")},
      {"bench", scene, "--quiet"},
      {"verify", folder.file("suite.yaml"), "--missing", "write"},
      {"verify", folder.file("suite.yaml")}};
  for (const Words& words : commands) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << words[0] << "\n" << result.out << result.err;
  }
  // The damping that was swept acted.
  const std::string table = read_whole_file(folder.file("sweep.csv"));
  EXPECT_THAT(table, HasSubstr("\n2,1,1,finished"));
  EXPECT_NE(table.substr(table.find("\n0,0,"), 60).substr(8), table.substr(table.find("\n2,1,"), 60).substr(8));
}

TEST(SceneWithAModelInNumbers, IsRememberedByItsFilm) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a/s.yaml", "model: {links: [1, 1], masses: 1, shape: point}\nmethod: rk4\nduration: 0.1\n");
  const ProgramResult made = run_program(with({"render", scene, "-o", folder.file("a/clip.gif"), "--quiet"}, kTiny));
  ASSERT_EQ(made.status, 0) << made.err;
  const Json audit = Json::parse(read_whole_file(folder.file("a/clip.json")));
  EXPECT_EQ(audit["model"], "{links: [1, 1], masses: [1, 1], joints: RR, shape: point}");
  EXPECT_EQ(audit["model_sha256"].get<std::string>().size(), 64u);
  // Nothing else is needed to make it again, wherever it is.
  fs::create_directory(folder.path() / "b");
  fs::rename(folder.file("a/clip.gif"), folder.file("b/clip.gif"));
  fs::remove_all(folder.path() / "a");
  const ProgramResult out = run_program({"extract", folder.file("b/clip.gif"), "-o", folder.file("b/again.yaml")});
  ASSERT_EQ(out.status, 0) << out.err;
  const ProgramResult again =
      run_program(with({"render", folder.file("b/again.yaml"), "-o", folder.file("b/again.gif"), "--quiet"}, {}));
  ASSERT_EQ(again.status, 0) << again.err;
  const Json second = Json::parse(read_whole_file(folder.file("b/again.json")));
  for (const char* key : {"model", "model_sha256", "trajectory_sha256"}) EXPECT_EQ(second[key], audit[key]) << key;
}

// The model of a file and the same in numbers: the same motion, bit by bit.
TEST(SceneWithAModelInNumbers, MovesLikeTheFileOfItsNumbers) {
  EXPECT_EQ(motion_of("assets/scenes/rr_free.yaml", {"--set", "model={links: [1, 1], masses: 1, shape: point}"}),
            motion_of("assets/scenes/rr_free.yaml"));
}

// What stands in the column of options or of commands.
Words words_of_help(const Words& command, const std::string& head) {
  Words words;
  const std::string help = run_program(with(command, {"--help"})).out;
  std::istringstream lines(help.substr(help.find("\n" + head + "\n") + head.size() + 2));
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (line.size() > 2 && line[2] != ' ') words.push_back(line.substr(2, line.find_first_of(" ,", 2) - 2));
  return words;
}

// What bash offers behind these words, of which the last is begun.
Words completed_by_bash(const std::string& words, int last) {
  const ProgramResult result = run_command(
      {"bash", "-c",
       "source <(" + program_path() + " completion bash); COMP_WORDS=(chainreel " + words + "); COMP_CWORD=" + std::to_string(last) +
           "; _chainreel; printf '%s\n' \"${COMPREPLY[@]}\""});
  EXPECT_EQ(result.err, "");
  Words found;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) found.push_back(line);
  return found;
}

TEST(Completion, OfBashKnowsCommandsOptionsAndTheirWords) {
  using testing::Contains;
  using testing::ElementsAre;
  EXPECT_THAT(completed_by_bash("rend", 1), ElementsAre("render"));
  EXPECT_THAT(completed_by_bash("''", 1), Contains("completion"));
  EXPECT_THAT(completed_by_bash("render --them", 2), ElementsAre("--theme"));
  EXPECT_THAT(completed_by_bash("render --preset d", 3), ElementsAre("doc"));
  EXPECT_THAT(completed_by_bash("init --shape ''", 3), ElementsAre("rod", "point"));
  EXPECT_THAT(completed_by_bash("--gl os", 2), ElementsAre("osmesa"));
  EXPECT_THAT(completed_by_bash("render --set video.w", 3), ElementsAre("video.width="));
  EXPECT_THAT(completed_by_bash("render rr_fr", 2), ElementsAre("rr_free"));
  EXPECT_THAT(completed_by_bash("render assets/scenes/rr_fr", 2), ElementsAre("assets/scenes/rr_free.yaml"));
  EXPECT_THAT(completed_by_bash("help rend", 2), ElementsAre("render"));
}

TEST(Completion, AndManualPagesKnowEveryOptionOfEveryCommand) {
  std::map<std::string, std::string> scripts;
  for (const char* shell : {"bash", "zsh", "fish"}) scripts[shell] = run_program({"completion", shell}).out;
  int options = 0;
  for (const std::string& command : words_of_help({}, "Subcommands:")) {
    const std::string page = run_program({"help", command, "--man"}).out;
    EXPECT_THAT(page, testing::StartsWith(".TH CHAINREEL-")) << command;
    for (const auto& [shell, script] : scripts) EXPECT_THAT(script, HasSubstr(command)) << shell;
    for (const std::string& name : words_of_help({command}, "Options:")) {
      ++options;
      std::string in_roff = name;
      for (std::size_t at = 0; (at = in_roff.find('-', at)) != std::string::npos; at += 2) in_roff.replace(at, 1, "\\-");
      EXPECT_THAT(page, HasSubstr("\\fB" + in_roff + "\\fR")) << command;
      EXPECT_THAT(scripts["bash"], HasSubstr(name)) << command;
      EXPECT_THAT(scripts["zsh"], HasSubstr("'*" + name + "[")) << command;
      const std::string of_fish = name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      EXPECT_THAT(scripts["fish"], HasSubstr("__fish_seen_subcommand_from " + command + "'")) << command;
      EXPECT_THAT(scripts["fish"], HasSubstr(of_fish)) << command;
    }
  }
  EXPECT_GE(options, 150);
}

TEST(Installed, TreeMayBeMovedAndKnowsItsScenesByName) {
  const TemporaryFolder folder;
  const std::string build = fs::path(program_path()).parent_path().string();
  const ProgramResult installed = run_command({"cmake", "--install", build, "--prefix", folder.file("first")});
  ASSERT_EQ(installed.status, 0) << installed.err;
  fs::rename(folder.path() / "first", folder.path() / "moved");
  const std::string program = folder.file("moved/bin/chainreel");
  fs::create_directory(folder.path() / "work");
  const RunOptions there{.folder = folder.file("work")};
  const ProgramResult run = run_command({program, "simulate", "rr_free", "--set", "duration=0.5", "-o", "a.csv", "--json"}, there);
  ASSERT_EQ(run.status, 0) << run.err;
  const Json report = Json::parse(run.out);
  EXPECT_EQ(report["trajectory_sha256"], motion_of("assets/scenes/rr_free.yaml"));
  EXPECT_THAT(report["scene"].get<std::string>(), HasSubstr("moved/share/chainreel/assets/scenes/rr_free.yaml"));
  EXPECT_EQ(run_command({program, "check", "rr.urdf"}, there).status, 0);
  EXPECT_EQ(run_command({program, "init", "mine", "--from", "pen"}, there).status, 0);
  EXPECT_EQ(run_command({program, "equations", "rr.urdf"}, there).status, 0) << "by its program in libexec";
  // One's own file of that name comes first.
  fs::copy_file("assets/scenes/rr_free.yaml", folder.path() / "work/pen.yaml");
  const ProgramResult own = run_command({program, "check", "pen.yaml"}, there);
  EXPECT_EQ(own.status, 3) << "its model is not beside it";
  for (const char* file : {"share/man/man1/chainreel.1", "share/man/man1/chainreel-render.1", "share/chainreel/assets/guide/using.md",
                           "share/chainreel/models/rr.urdf", "share/bash-completion/completions/chainreel",
                           "share/zsh/vendor-completions/_chainreel", "share/fish/vendor_completions.d/chainreel.fish",
                           "share/doc/chainreel/copyright"})
    EXPECT_TRUE(fs::is_regular_file(folder.path() / "moved" / file)) << file;
  // Pages call the program by its name, and what they link to is there.
  static const std::regex link(R"(\]\(([^)#]+)\))");
  std::vector<fs::path> pages{folder.path() / "moved/share/doc/chainreel/README.md"};
  for (const auto& page : fs::directory_iterator(folder.path() / "moved/share/chainreel/assets/guide"))
    if (page.path().extension() == ".md") pages.push_back(page.path());
  EXPECT_GT(pages.size(), 10u);
  for (const fs::path& page : pages) {
    const std::string text = read_whole_file(page.string());
    EXPECT_THAT(text, testing::Not(HasSubstr("build/chainreel"))) << page;
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
      const std::string target = (*at)[1].str();
      if (!target.starts_with("http")) EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << ": " << target;
    }
  }
  // What roff has to say of the pages.
  for (const auto& page : fs::directory_iterator(folder.path() / "moved/share/man/man1")) {
    const ProgramResult set = run_command({"groff", "-man", "-ww", "-z", "-Tutf8", "-Kutf8", page.path().string()});
    if (set.status == 127) break;  // without groff, which nothing else needs
    EXPECT_EQ(set.err, "") << page.path();
  }
}

}  // namespace
}  // namespace chainreel
