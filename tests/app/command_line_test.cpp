// The command line as people use it: help, init, check, doctor, signals, and what the README says.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <regex>
#include <sstream>

#include "core/json.hpp"
#include "encode/png.hpp"
#include "scene/read_scene.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::vector<std::string> kCommands{"render",  "snapshot", "ellipse", "simulate", "dynamics",
                                         "inverse", "init",     "check",   "doctor",   "sheet",    "gallery"};

TEST(Help, HasAnExampleForEveryCommand) {
  for (const std::string& command : kCommands) {
    const ProgramResult result = run_program({command, "--help"});
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.out, HasSubstr("Example: chainreel " + command));
  }
}

TEST(Usage, ErrorsAreExitTwo) {
  EXPECT_EQ(run_program({}).status, 2);
  EXPECT_EQ(run_program({"rendr"}).status, 2);
  EXPECT_EQ(run_program({"render"}).status, 2);
  EXPECT_EQ(run_program({"render", "--no-such-flag", "a.yaml"}).status, 2);
}

TEST(Init, WritesASceneThatRenders) {
  const TemporaryFolder folder;
  const ProgramResult made = run_program({"init", folder.file("my_arm")});
  ASSERT_EQ(made.status, 0) << made.err;
  const ProgramResult rendered =
      run_program({"render", folder.file("my_arm.yaml"), "-o", folder.file("my_arm.mp4"), "--quiet", "--set",
                   "duration=0.1", "--set", "video.width=320", "--set", "video.height=180"});
  EXPECT_EQ(rendered.status, 0) << rendered.err;
  const ProgramResult checked = run_program({"check", folder.file("my_arm.urdf")});
  EXPECT_EQ(checked.status, 0) << checked.err;
}

TEST(Init, KeepsWhatIsThere) {
  const TemporaryFolder folder;
  const std::string model = folder.write("arm.urdf", "mine");
  EXPECT_EQ(run_program({"init", folder.file("arm")}).status, 6);
  EXPECT_EQ(read_whole_file(model), "mine");
  EXPECT_FALSE(fs::exists(folder.file("arm.yaml")));
}

TEST(Check, PrintsASceneThatReadsBackTheSame) {
  const ProgramResult first = run_program({"check", "assets/scenes/pp_spring.yaml", "--json"});
  ASSERT_EQ(first.status, 0) << first.err;
  const Json report = Json::parse(first.out);
  EXPECT_EQ(report["model"]["algebra"], "planar");
  EXPECT_EQ(report["cost"]["steps"], 10000);
  EXPECT_EQ(report["cost"]["Lambda_computed"], 0);
  const TemporaryFolder folder;
  std::string text = report["scene"];
  text.replace(text.find("models/"), 0, std::string(CHAINREEL_SOURCE_FOLDER) + "/");
  const ProgramResult again = run_program({"check", folder.write("again.yaml", text), "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out)["cost"], report["cost"]);
}

TEST(Doctor, FindsWhatFilmsNeed) {
  const ProgramResult result = run_program({"doctor", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json report = Json::parse(result.out);
  EXPECT_TRUE(report.contains("renderer"));
  EXPECT_THAT(report["encoders"].dump(), HasSubstr("libx264"));
  EXPECT_EQ(report["fonts"].size(), 3u);
}

TEST(Progress, IsAPlainLineWhereThereIsNoTerminal) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"render", "assets/scenes/pp_free.yaml", "-o", folder.file("a.mp4"), "--set",
                   "duration=0.2", "--set", "video.width=320", "--set", "video.height=180"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("100 %"));
  EXPECT_THAT(result.err, HasSubstr("frames/s"));
  EXPECT_THAT(result.err, testing::Not(HasSubstr("\r")));
}

TEST(Interrupt, LeavesNothingHalfWritten) {
  const TemporaryFolder folder;
  const ProgramResult result = run_command({"timeout", "--signal=INT", "--preserve-status", "1",
                                            program_path(), "render", "assets/scenes/rrr_torque.yaml", "-o",
                                            folder.file("a.mp4"), "--quiet", "--set", "duration=300"});
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// Lines of the README's shell blocks that call the program, with small pictures.
std::vector<std::string> readme_commands() {
  std::vector<std::string> commands;
  std::istringstream text(read_whole_file("README.md"));
  bool shell = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) shell = line == "```sh";
    if (shell && line.starts_with("build/chainreel ")) commands.push_back(line.substr(0, line.find("  #")));
  }
  return commands;
}

// What a page for people shows must be there, and be small enough to load at once.
TEST(Readme, PicturesAreThereAndTheFirstIsTheSheetOfAllScenes) {
  const std::string text = read_whole_file("README.md");
  static const std::regex picture(R"(!\[[^\]]+\]\(([^)]+)\))");
  std::vector<std::string> files;
  for (std::sregex_iterator at(text.begin(), text.end(), picture), end; at != end; ++at) files.push_back((*at)[1]);
  ASSERT_FALSE(files.empty());
  EXPECT_EQ(files.front(), "assets/gallery/sheet.png");
  EXPECT_LT(text.find(files.front()), 600u);
  for (const std::string& file : files) {
    EXPECT_TRUE(fs::is_regular_file(file)) << file;
    EXPECT_LT(fs::file_size(file), 400000u) << file;
  }
}

// The sheet remembers its titles.
TEST(Readme, SheetShowsEveryScene) {
  const std::string words = read_png_text("assets/gallery/sheet.png")["description"];
  for (const auto& entry : fs::directory_iterator("assets/scenes")) {
    const std::string title = read_scene(entry.path().string(), {}).title;
    EXPECT_THAT(words, HasSubstr(title.substr(0, title.find('{'))))
        << "make it anew: chainreel sheet assets/scenes/*.yaml --width 1600 --height 1120 -o assets/gallery/sheet.png "
           "--force";
  }
}

TEST(Readme, CommandsRun) {
  const std::vector<std::string> commands = readme_commands();
  EXPECT_GE(commands.size(), 5u);
  const TemporaryFolder folder;
  for (const char* part : {"assets", "models", "build"}) {
    const fs::path target =
        std::string(part) == "build" ? fs::path(program_path()).parent_path() : fs::absolute(part);
    fs::create_directory_symlink(target, folder.path() / part);
  }
  for (const std::string& command : commands) {
    std::string line = command;
    if (line.find(" render ") != std::string::npos)
      line += " --set duration=0.2 --set video.width=320 --set video.height=180";
    const ProgramResult result = run_command({"sh", "-c", line}, {.folder = folder.path().string()});
    EXPECT_EQ(result.status, 0) << command << "\n" << result.err;
  }
  for (const char* made : {"out/sheet.png", "out/index.html"}) EXPECT_TRUE(fs::exists(folder.path() / made)) << made;
}

}  // namespace
}  // namespace chainreel
