// What users paste into their repositories runs there: the shell steps of assets/ci, its test of pytest and
// of ctest, and the suites of the guide.
#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>

#include "scene/text/suite.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string arm_named(const std::string& name, const std::string& length = "1") {
  std::string text = "<robot name='" + name + "'><link name='base'/>";
  const char* joints[][3] = {
      {"shoulder", "base", "upper"}, {"elbow", "upper", "lower"}, {"wrist", "lower", "hand"}};
  for (const auto& [joint, parent, child] : joints)
    text += "<link name='" + std::string(child) +
            "'><inertial><origin xyz='0.5 0 0'/><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' "
            "ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='" +
            joint + "' type='continuous'><parent link='" + parent + "'/><child link='" + child +
            "'/><origin xyz='" + (std::string(joint) == "shoulder" ? "0" : length) +
            " 0 0'/><axis xyz='0 0 1'/></joint>";
  return text + "</robot>";
}

// The command of a step, dedented: of `run: |` below its name, or of `script:` with a list of one.
std::string step_of(const std::string& file, const std::string& head) {
  std::istringstream lines(read_whole_file(file));
  std::string line, text;
  while (std::getline(lines, line) && line.find(head) == std::string::npos) {
  }
  std::size_t indent = std::string::npos;
  while (std::getline(lines, line)) {
    if (line.ends_with("run: |")) {  // what stood before are conditions
      text.clear();
      indent = std::string::npos;
      continue;
    }
    const std::size_t start = line.find_first_not_of(' ');
    if (indent == std::string::npos) indent = start;
    if (start == std::string::npos || start < indent) break;
    text += line.substr(indent) + "\n";
    if (line[indent] == '-') return line.substr(indent + 2);
  }
  return text;
}

// A repository with a suite, its baselines, and the program where the steps build it.
class PastedIntoCi : public testing::Test {
 protected:
  PastedIntoCi() {
    write_suite();
    folder_.write("arm.urdf", arm_named("arm"));
    fs::create_directories(folder_.path() / ".chainreel");
    fs::create_directory_symlink(fs::path(program_path()).parent_path(), folder_.path() / ".chainreel/build");
    EXPECT_EQ(run_program({"verify", "snapshots.yaml", "--missing", "write", "--quiet"}, here()).status, 0);
  }

  void write_suite() {
    folder_.write("snapshots.yaml",
                  "model: arm.urdf\nposes: {home: [0, 0, 0], reach: {elbow: 90deg}}\nsize: 160x120\n");
  }
  void break_something() { folder_.write("arm.urdf", arm_named("arm", "1.2")); }

  RunOptions here() const {
    return {.folder = folder_.path().string(),
            .environment = {{"SUITE", "snapshots.yaml"},
                            {"CHAINREEL", program_path()},
                            {"GITHUB_STEP_SUMMARY", folder_.file("page.md")}}};
  }
  ProgramResult run(const std::string& shell) const {
    return run_command({"bash", "-e", "-o", "pipefail", "-c", shell}, here());
  }

  TemporaryFolder folder_;
};

TEST_F(PastedIntoCi, StepsOfGithubEndWellOrWithAReport) {
  const std::string file = "assets/ci/github.yml", verify = step_of(file, "name: Verify"),
                    summary = step_of(file, "name: Summary");
  ASSERT_THAT(verify, HasSubstr("verify \"$SUITE\""));
  ProgramResult result = run(verify);
  EXPECT_EQ(result.status, 0) << result.err;
  break_something();
  result = run(verify);
  EXPECT_EQ(result.status, 1) << result.err;
  for (const char* report : {"out/junit.xml", "out/report.html", "out/summary.md"})
    EXPECT_TRUE(fs::exists(folder_.path() / report)) << report;
  EXPECT_EQ(run(summary).status, 0);
  EXPECT_EQ(read_whole_file(folder_.file("page.md")), read_whole_file(folder_.file("out/summary.md")));
  fs::remove(folder_.path() / "out/summary.md");
  EXPECT_EQ(run(summary).status, 0);
}

TEST_F(PastedIntoCi, FilmsOfAFolderAreHeldAgainstTheirScenes) {
  folder_.write("s.yaml", "model: arm.urdf\nduration: 0.1\nmethod: rk4\nvideo: {width: 64, height: 36}\n");
  fs::create_directory(folder_.path() / "docs");
  ASSERT_EQ(run_program({"render", "s.yaml", "-o", "docs/s.mp4", "--quiet"}, here()).status, 0);
  const std::string github = step_of("assets/ci/github.yml", "name: Films");
  ASSERT_THAT(github, HasSubstr("check \"$FILMS\" --today"));
  const std::string gitlab = "export PATH=\"$PWD/.chainreel/build:$PATH\"\ntest -z \"$FILMS\" || chainreel check \"$FILMS\" --today";
  EXPECT_THAT(read_whole_file("assets/ci/gitlab-ci.yml"), HasSubstr("test -z \"$FILMS\" || chainreel check \"$FILMS\" --today"));
  EXPECT_EQ(run("FILMS=docs\n" + github).status, 0);
  EXPECT_EQ(run("FILMS=docs\n" + gitlab).status, 0);
  EXPECT_EQ(run("FILMS=\n" + gitlab).status, 0);
  break_something();
  EXPECT_EQ(run("FILMS=docs\n" + github).status, 1);
  EXPECT_EQ(run("FILMS=docs\n" + gitlab).status, 1);
}

TEST_F(PastedIntoCi, ScriptOfGitlabEndsWellOrWithAReport) {
  const std::string file = "assets/ci/gitlab-ci.yml", verify = step_of(file, "  script:") + "\n" + step_of(file, "export PATH");
  ASSERT_THAT(verify, HasSubstr("verify \"$SUITE\""));
  EXPECT_EQ(run(verify).status, 0);
  break_something();
  EXPECT_EQ(run(verify).status, 1);
  EXPECT_THAT(read_whole_file(folder_.file("out/junit.xml")), HasSubstr("<failure"));
}

// With a package nothing is built: it is fetched and handed to apt, whose part a script plays here.
TEST_F(PastedIntoCi, APackageIsInstalledInsteadOfBuilding) {
  const std::string package = folder_.write("served.deb", "bytes of a package"), log = folder_.file("apt.log");
  const std::string apt = folder_.write("bin/apt-get", "#!/bin/sh\necho \"$@\" >> " + log + "\ncat /tmp/chainreel.deb >> " + log + "\n");
  fs::permissions(apt, fs::perms::owner_all);
  RunOptions options = here();
  options.environment["PATH"] = folder_.file("bin") + ":" + std::getenv("PATH");
  options.environment["CHAINREEL_DEB"] = "file://" + package;
  options.environment["CHAINREEL_SOURCE"] = folder_.file("no_such_repository");
  const ProgramResult result =
      run_command({"bash", "-e", "-o", "pipefail", "-c", step_of("assets/ci/github.yml", "name: Install")}, options);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(read_whole_file(log), testing::AllOf(HasSubstr("install -y --no-install-recommends /tmp/chainreel.deb"), HasSubstr("bytes of a package")));
  options.environment["CHAINREEL_DEB"] = "file://" + folder_.file("gone.deb");
  EXPECT_NE(run_command({"bash", "-e", "-o", "pipefail", "-c", step_of("assets/ci/github.yml", "name: Install")}, options).status, 0);
}

// Pasted as it is it says what is still wanted, before anything is fetched.
TEST_F(PastedIntoCi, WithoutAPackageOrARepositoryItSaysWhatToSet) {
  RunOptions options = here();
  options.environment["CHAINREEL_DEB"] = options.environment["CHAINREEL_SOURCE"] = "";
  const std::string file = read_whole_file("assets/ci/gitlab-ci.yml"), gitlab = file.substr(file.find("if [ -n \"$CHAINREEL_DEB\""), file.find("\n  script:") - file.find("if [ -n \"$CHAINREEL_DEB\""));
  for (const std::string& step : {step_of("assets/ci/github.yml", "name: Install"), gitlab}) {
    const ProgramResult result = run_command({"bash", "-e", "-o", "pipefail", "-c", step}, options);
    EXPECT_EQ(result.status, 2) << step;
    EXPECT_THAT(result.err, HasSubstr("set CHAINREEL_DEB"));
  }
}

TEST_F(PastedIntoCi, PytestHasATestAPicture) {
  fs::copy_file("assets/ci/test_snapshots.py", folder_.path() / "test_snapshots.py");
  const Words words = {"pytest-3", "-v", "-p", "no:cacheprovider", "test_snapshots.py"};
  RunOptions options = here();
  options.environment.erase("SUITE");
  ProgramResult result = run_command(words, options);
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("test_snapshot[home] PASSED"));
  break_something();
  result = run_command(words, options);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("test_snapshot[reach] FAILED"));
  EXPECT_THAT(result.out, HasSubstr("changed; "));
  folder_.write("snapshots.yaml", "model: gone.urdf\n");
  EXPECT_THAT(run_command(words, options).out, HasSubstr("there is no file 'gone.urdf'"));
}

TEST_F(PastedIntoCi, CtestRunsTheSuite) {
  fs::copy_file("assets/ci/CMakeLists.txt", folder_.path() / "CMakeLists.txt");
  ASSERT_EQ(run_command({"cmake", "-G", "Ninja", "-S", ".", "-B", "b", "-D", "CHAINREEL=" + program_path()}, here()).status,
            0);
  EXPECT_EQ(run_command({"ctest", "--test-dir", "b"}, here()).status, 0);
  break_something();
  EXPECT_NE(run_command({"ctest", "--test-dir", "b"}, here()).status, 0);
  EXPECT_TRUE(fs::exists(folder_.path() / "b/out/report.html"));
}

TEST(CiFiles, AreYamlThatALinterTakes) {
  const std::string rules =
      "{extends: relaxed, rules: {line-length: {max: 130}, truthy: {check-keys: false}}}";
  const ProgramResult result =
      run_command({"yamllint", "--strict", "-d", rules, "assets/ci/github.yml", "assets/ci/gitlab-ci.yml"});
  EXPECT_EQ(result.status, 0) << result.out;
  // Negative control.
  const TemporaryFolder folder;
  EXPECT_NE(
      run_command({"yamllint", "--strict", "-d", rules, folder.write("bad.yml", "a: 1\na: 2\n")}).status, 0);
}

TEST(CiFiles, SuitesOfTheGuideAreRead) {
  const TemporaryFolder folder;
  folder.write("arm.urdf", arm_named("arm"));
  folder.write("two.urdf", arm_named("two"));
  folder.write("swing.yaml", "model: arm.urdf\nparameters: {F: 0}\ntorque: [F, 0, 0]\nevents: [{when: \"q1 > 1\", name: touch}]\n");
  const std::string page = read_whole_file("assets/guide/snapshots.md"), open = "```yml\n";
  int suites = 0;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at + 1), ++suites) {
    const std::size_t begin = at + open.size();
    const std::string path =
        folder.write("snapshots.yaml", page.substr(begin, page.find("```", begin) - begin));
    EXPECT_NO_THROW(EXPECT_GE(read_suite(path).pictures.size(), 2u));
  }
  EXPECT_EQ(suites, 3);
}

}  // namespace
}  // namespace chainreel
