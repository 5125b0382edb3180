// What must not happen to files and terminals, whatever the program is given and wherever it is stopped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_probe.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

const std::string kSmall = " --quiet --set video.width=64 --set video.height=36 --set video.fps=25 --set duration=0.2 ";

// In a shell, since rlimits, closed streams and signals are its trade; $0 is the program, $1 the folder.
ProgramResult shell(const std::string& line, const TemporaryFolder& folder, std::map<std::string, std::string> environment = {}) {
  return run_command({"sh", "-c", line, program_path(), folder.path().string()}, {.folder = "", .environment = std::move(environment)});
}

std::string render_to(const std::string& file) {
  return "\"$0\" render assets/scenes/rr_torque.yaml" + kSmall + "-o \"$1\"/" + file;
}

std::map<std::string, std::string> failing(const std::string& name, const std::string& value) {
  return {{"LD_PRELOAD", preloaded(CHAINREEL_FAILING_CALLS)}, {"ASAN_OPTIONS", "verify_asan_link_order=0"}, {name, value}};
}

TEST(StandardOutput, ThatIsLostIsExitSixInEveryCommand) {
  const TemporaryFolder folder;
  for (const char* command : {"--help", "--version", "methods", "methods --json", "render --help", "check models/rr.urdf",
                              "dynamics models/rr.urdf", "simulate assets/scenes/pp_free.yaml --set duration=0.01 -o -"}) {
    for (const char* lost : {" >/dev/full", " >&-"}) {
      const ProgramResult result = shell(std::string("\"$0\" ") + command + lost, folder);
      EXPECT_EQ(result.status, 6) << command << lost;
      EXPECT_THAT(result.err, HasSubstr("standard output")) << command << lost;
    }
  }
  // What fails anyway keeps its own code.
  EXPECT_EQ(shell("\"$0\" check none.yaml >/dev/full", folder).status, 3);
}

// No file gets the number of a closed stream, so that nothing is printed into it.
TEST(StandardOutput, ThatIsClosedIsNoFilm) {
  const TemporaryFolder folder;
  const ProgramResult result = shell("\"$0\" snapshot assets/scenes/pp_free.yaml --width 64 --height 36 -o \"$1\"/a.svg >&- 2>&- <&-", folder);
  EXPECT_EQ(result.status, 6);
  EXPECT_TRUE(read_whole_file(folder.file("a.svg")).ends_with("</svg>\n"));
}

TEST(Outputs, AreNoInputs) {
  const TemporaryFolder folder;
  const std::string model = folder.write("m.urdf", read_whole_file("models/rr.urdf"));
  const std::string scene = folder.write("s.yaml", "model: m.urdf\nduration: 0.05\nmethod: rk4\n");
  fs::create_symlink("s.yaml", folder.file("soft.csv"));
  fs::create_hard_link(model, folder.file("hard.csv"));
  for (const char* name : {"soft.csv", "hard.csv"}) {
    const ProgramResult result = run_program({"simulate", scene, "-o", folder.file(name), "--force"});
    EXPECT_EQ(result.status, 6) << name;
    EXPECT_THAT(result.err, HasSubstr("never replaces an input")) << name;
  }
  const std::string table = folder.write("q.csv", "t,q1,q2\n0,0,0\n1,1,1\n2,1,2\n");
  EXPECT_EQ(run_program({"inverse", model, "--trajectory", table, "-o", table, "--force"}).status, 6);
  EXPECT_EQ(read_whole_file(table).substr(0, 7), "t,q1,q2");
}

TEST(Sidecars, ReplaceOnlyWhatThisProgramWrote) {
  for (const char* name : {"a.json", "a.txt"}) {
    const TemporaryFolder folder;
    const std::string mine = folder.write(std::string("out/") + name, "{\"mine\": 1}\n");
    const ProgramResult refused = shell(render_to("out/a.mp4"), folder);
    EXPECT_EQ(refused.status, 6) << name;
    EXPECT_THAT(refused.err, HasSubstr(name));
    EXPECT_EQ(read_whole_file(mine), "{\"mine\": 1}\n");
    EXPECT_EQ(shell(render_to("out/a.mp4 --force"), folder).status, 0);
  }
  const TemporaryFolder folder;
  for (int i = 0; i < 2; ++i) {
    const ProgramResult again = shell(render_to("out/a.mp4"), folder);
    EXPECT_EQ(again.status, 0) << again.err;
  }
  folder.write("out/a.txt", read_whole_file(folder.file("out/a.txt")) + "Checked by hand.\n");
  EXPECT_EQ(shell(render_to("out/a.mp4"), folder).status, 6);
  // Beside a chart, and a film whose name nobody gave.
  folder.write("out/c.csv", "my,table\n");
  const std::string energy = "\"$0\" energy assets/scenes/pp_free.yaml --until 0.1s --step 0.01 --quiet --width 64 --height 36 -o \"$1\"/out/c.png";
  EXPECT_EQ(shell(energy, folder).status, 6);
  EXPECT_EQ(read_whole_file(folder.file("out/c.csv")), "my,table\n");
  fs::remove(folder.file("out/c.csv"));
  for (int i = 0; i < 2; ++i) EXPECT_EQ(shell(energy, folder).status, 0);
  folder.write("out/rr_torque.mp4", "my recording");
  EXPECT_EQ(shell(render_to("out/"), folder).status, 6);
  EXPECT_EQ(read_whole_file(folder.file("out/rr_torque.mp4")), "my recording");
}

TEST(Signals, OfEveryKindLeaveNothingHalfWritten) {
  for (const auto& [name, code] : {std::pair{"HUP", 129}, {"QUIT", 131}}) {
    const TemporaryFolder folder;
    const ProgramResult result =
        // A shell starts what runs in the background with SIGQUIT ignored, which the program would respect.
        shell("env --default-signal=QUIT,HUP \"$0\" render assets/scenes/rr_free.yaml --quiet --set duration=300 -o \"$1\"/a.mp4 & pid=$!; "
              "until ls -A \"$1\" | grep -q .; do sleep 0.02; done; kill -" + std::string(name) + " $pid; wait $pid",
              folder);
    EXPECT_EQ(result.status, code) << result.err;
    EXPECT_TRUE(fs::is_empty(folder.path())) << name;
  }
}

TEST(Signals, ThatKillLeaveWhatTheNextRunTidiesUp) {
  const TemporaryFolder folder;
  shell("\"$0\" render assets/scenes/rrr_torque.yaml --quiet --set duration=300 -o \"$1\"/a.mp4 -o \"$1\"/k_000000.png & pid=$!; "
        "until test $(ls -A \"$1\" | wc -l) -ge 4; do sleep 0.02; done; kill -KILL $pid; wait $pid", folder);
  ASSERT_GE(names_in(folder.path()).size(), 2u);
  const ProgramResult next = shell(render_to("b.gif"), folder);
  EXPECT_EQ(next.status, 0) << next.err;
  EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("b.gif", "b.json", "b.txt"));
}

// A file that may not grow: for the program, a disk that is full.
TEST(Disk, ThatIsFullIsToldWithTheNameOfTheFile) {
  for (const char* name : {"a.mp4", "a.webm", "a.gif", "a.apng", "a.png", "a.pdf"}) {
    const TemporaryFolder folder;
    const ProgramResult result = shell("ulimit -f 1; " + render_to(name), folder);
    EXPECT_EQ(result.status, 6) << name << result.err;
    EXPECT_THAT(result.err, HasSubstr(std::string("/") + name));
    EXPECT_THAT(result.err, Not(HasSubstr(".tmp")));
    EXPECT_TRUE(fs::is_empty(folder.path())) << name;
  }
}

// Renames of a second sequence: five old frames aside, five new ones in. Whichever fails, once or from there on, no
// picture is lost, and the next run sets right what could not be undone.
TEST(Disk, ThatFailsInTheMidstOfASequenceLeavesTheOldOne) {
  for (const char* first : {"1", "4", "6", "8"}) {
    for (const char* count : {"1", "1000"}) {
      const TemporaryFolder folder;
      const std::string render = render_to("k_000000.png --force");
      ASSERT_EQ(shell(render, folder).status, 0);
      const std::string old = read_whole_file(folder.file("k_000003.png"));
      auto environment = failing("FAIL_FROM", first);
      environment["FAIL_COUNT"] = count;
      const ProgramResult failed = shell(render + " --set theme=dark", folder, environment);
      EXPECT_EQ(failed.status, 6) << failed.err;
      EXPECT_EQ(run_program({"init", folder.file("x"), "--quiet"}).status, 0);  // looks into the folder
      for (int i = 0; i < 5; ++i) EXPECT_TRUE(fs::exists(folder.file("k_00000" + std::to_string(i) + ".png"))) << first << i;
      EXPECT_EQ(read_whole_file(folder.file("k_000003.png")), old) << first << "+" << count << "\n" << failed.err;
      EXPECT_THAT(names_in(folder.path()), Not(testing::Contains(HasSubstr(".chainreel")))) << first << count;
    }
  }
}

TEST(Disk, ThatCannotSeekGivesAWholeFilmOrNone) {
  const TemporaryFolder folder;
  const ProgramResult result = shell(render_to("a.mp4"), folder, failing("FAIL_SEEK", "1"));
  if (result.status != 0) {
    EXPECT_EQ(result.status, 6) << result.err;
    EXPECT_FALSE(fs::exists(folder.file("a.mp4")));
    return;
  }
  EXPECT_EQ(probe_video(folder.file("a.mp4")).frames, 5);
}

// A film with its sidecars and a picture, whose n-th call of a kind fails, once. Those of files fail each in its turn, those
// of memory at some points over the whole run; with CHAINREEL_ALL_FAULTS at many.
class EveryCall : public testing::TestWithParam<const char*> {
 protected:
  ProgramResult render(const TemporaryFolder& folder, std::map<std::string, std::string> settings) {
    auto environment = failing("FAIL_CALL", GetParam());
    environment.merge(settings);
    return run_command({program_path(), "render", "assets/scenes/rr_torque.yaml", "--quiet", "--set", "video.width=64", "--set",
                        "video.height=36", "--set", "video.fps=25", "--set", "duration=0.2", "--jobs", "1", "-o",
                        folder.file("a.mp4"), "-o", folder.file("a.png")},
                       {.folder = "", .environment = environment, .timeout_s = 60});
  }
};

TEST_P(EveryCall, ThatFailsOnceLeavesWholeFilesAndIsToldInALine) {
  const bool is_memory = std::string(GetParam()) == "memory";
  if (kIsSanitized && is_memory) GTEST_SKIP() << "the sanitizer's memory does not fail";
  const TemporaryFolder whole;
  const ProgramResult good = render(whole, {{"FAIL_COUNTED", whole.file("count")}});
  ASSERT_EQ(good.status, 0) << good.err;
  const long calls = std::stol(read_whole_file(whole.file("count")));
  fs::remove(whole.file("count"));
  const std::vector<std::string> names = names_in(whole.path());
  const long points = !is_memory ? calls : std::getenv("CHAINREEL_ALL_FAULTS") != nullptr ? 500 : 12;
  std::vector<long> places;
  for (long k = 0; k < std::min(points, calls); ++k) places.push_back(is_memory ? 1 + k * (calls / points) : 1 + k);
  // When the film has its name and its audit is put together: within a destructor that takes memory.
  for (long behind = 60; is_memory && behind < 120; behind += 6) places.push_back(calls - behind);
  for (const long at : places) {
    const TemporaryFolder folder;
    const ProgramResult result = render(folder, {{"FAIL_AT", std::to_string(at)}});
    const std::string what = std::string(GetParam()) + " " + std::to_string(at) + " of " + std::to_string(calls) + ": " + result.err;
    // Files are put into their places one by one, each when it is whole; nothing hidden stays.
    for (const std::string& name : names_in(folder.path())) {
      EXPECT_THAT(names, testing::Contains(name)) << what;
      if (!std::binary_search(names.begin(), names.end(), name)) continue;
      const std::string text = read_whole_file(folder.file(name));
      if (name == "a.json")
        EXPECT_TRUE(Json::accept(text)) << what;  // tells of seconds
      else
        EXPECT_EQ(text, read_whole_file(whole.file(name))) << what << name;
    }
    if (result.status == 0) {  // done in another way
      EXPECT_EQ(names_in(folder.path()), names) << what;
      continue;
    }
    EXPECT_EQ(result.status, is_memory ? 7 : 6) << what;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(Disk, EveryCall, testing::Values("write", "rename", "fsync", "lseek", "memory"),
                         [](const auto& one) { return std::string(one.param); });

TEST(Terminal, GetsNoOrdersFromNamesOfOthers) {
  const TemporaryFolder folder;
  const std::string escape = "\x1b]0;owned\x07";
  std::string model = read_whole_file("models/rr.urdf");
  const std::size_t name = model.find("robot name=\"") + 12;
  model.insert(name, "\xc2\x9b" "31m");
  const std::string urdf = folder.write("m.urdf", model);
  const std::string table = folder.write("q.csv", "t,q1,q2\n0," + escape + ",0\n");
  const std::string scene = folder.write("s.yaml", "model: m.urdf\n\"\\e[2J\": 1\n");
  const std::string titled = folder.write("t.yaml", "model: m.urdf\nduration: 0.1\ntitle: \"a\\e[2Jb\"\n");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"check", urdf}, {"dynamics", urdf}, {"inverse", urdf, "--trajectory", table, "-o", folder.file("x.csv")},
        {"check", scene}, {"check", titled}, {"check", folder.file(escape)}, {"check", "--" + escape}, {"render", titled, "-o", folder.file(escape)}}) {
    const ProgramResult result = run_program(command);
    for (const std::string& bytes : {std::string("\x1b"), std::string("\x07"), std::string("\xc2\x9b")})
      EXPECT_THAT(result.out + result.err, Not(HasSubstr(bytes))) << command[0] << " " << command[1];
  }
}

TEST(Messages, AreNoLongerThanSomeLines) {
  const TemporaryFolder folder;
  const std::string table = folder.write("q.csv", "t,q1,q2\n0," + std::string(60000, 'x') + ",0\n");
  const ProgramResult cell = run_program({"inverse", "models/rr.urdf", "--trajectory", table, "-o", folder.file("x.csv")});
  EXPECT_EQ(cell.status, 3);
  EXPECT_LT(cell.err.size(), 1500u);
  EXPECT_THAT(cell.err, HasSubstr("bytes more"));
  std::string keys = "model: m.urdf\n";
  for (int i = 0; i < 1000; ++i) keys += "key" + std::to_string(i) + ": 1\n";
  const ProgramResult many = run_program({"check", folder.write("s.yaml", keys)});
  EXPECT_EQ(many.status, 3);
  EXPECT_LT(std::count(many.err.begin(), many.err.end(), '\n'), 50);
  EXPECT_THAT(many.err, HasSubstr("more problems"));
}

TEST(Fonts, ThatCannotBeOpenedAreToldAsFiles) {
  for (const char* files : {"4", "5", "6"}) {
    const TemporaryFolder folder;
    const ProgramResult result = shell(std::string("ulimit -n ") + files + "; \"$0\" snapshot assets/scenes/pp_free.yaml --width 64 --height 36 -o \"$1\"/a.png", folder);
    EXPECT_THAT(result.err, Not(HasSubstr("glyph"))) << files;
    if (result.status != 0) EXPECT_FALSE(result.err.empty()) << files;
    if (result.status != 0) EXPECT_TRUE(fs::is_empty(folder.path())) << files;
  }
}

// From what hardly holds the program itself to what holds a picture too; without the room the renderer's library crashes.
TEST(Memory, ThatIsShortIsExitSeven) {
  if (kIsSanitized) GTEST_SKIP() << "a sanitizer's shadow takes terabytes of address space";
  int refused = 0, drawn = 0;
  for (int limit = 100; limit <= 640; limit += 20) {
    const TemporaryFolder folder;
    const ProgramResult result = shell("ulimit -v " + std::to_string(limit * 1000) +
                                           "; \"$0\" --gl osmesa snapshot assets/scenes/pp_free.yaml --width 640 --height 360 -o \"$1\"/a.png", folder);
    EXPECT_TRUE(result.status == 0 || result.status == 7) << limit << ": " << result.status << result.err;
    if (result.status == 7) EXPECT_TRUE(fs::is_empty(folder.path())) << limit;
    refused += result.status == 7;
    drawn += result.status == 0;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(drawn, 0);
}

// Encoders and the loader of libraries tell it in their own ways.
TEST(Memory, ThatIsShortForAFilmIsExitSevenToo) {
  if (kIsSanitized) GTEST_SKIP() << "a sanitizer's shadow takes terabytes of address space";
  for (const auto& [limit, name] : {std::pair{150, "a.mp4"}, {520, "a.mp4"}, {560, "a.mp4"}, {580, "a.mp4"}, {560, "a.webm"}}) {
    const TemporaryFolder folder;
    const ProgramResult result = shell("ulimit -v " + std::to_string(limit * 1000) +
                                           "; \"$0\" render assets/scenes/pp_free.yaml --quiet --jobs 1 --set duration=0.05 --set "
                                           "video.width=1920 --set video.height=1080 -o \"$1\"/" + name, folder);
    EXPECT_TRUE(result.status == 0 || result.status == 7) << limit << name << ": " << result.status << result.err;
    if (result.status != 0) EXPECT_THAT(result.err, AnyOf(HasSubstr("memory"), HasSubstr("address space"))) << limit << name;
    if (result.status == 7) EXPECT_TRUE(fs::is_empty(folder.path())) << limit << name;
  }
}

TEST(Threads, ThatTheSystemDoesNotGiveAreDoneWithout) {
  const TemporaryFolder folder;
  for (const char* at : {"1", "2"}) {
    auto environment = failing("FAIL_CALL", "thread");
    environment["FAIL_AT"] = at;
    const ProgramResult result = shell(render_to("a.mov --force --jobs 3"), folder, environment);
    EXPECT_EQ(result.status, 0) << result.err;
  }
}

TEST(Quaternions, WithoutADirectionAreRefused) {
  const TemporaryFolder folder;
  const std::string inertial = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
  const std::string model = folder.write("m.urdf", "<robot name='r'><link name='base'>" + inertial + "</link><link name='tip'>" + inertial +
                                                       "</link><joint name='j' type='continuous'><parent link='base'/><child link='tip'/>"
                                                       "<axis xyz='1 0 0'/></joint></robot>");
  const std::string scene = folder.write("s.yaml", "model: m.urdf\nbase: floating\nduration: 0.1\nmethod: rk4\nstart:\n  q: [0, 0, 0, 0, 0, 0, 0, 0]\n");
  const ProgramResult run = run_program({"simulate", scene, "-o", "-"});
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_THAT(run.err, HasSubstr("s.yaml:6"));
  EXPECT_THAT(run.err, HasSubstr("quaternion"));
  EXPECT_EQ(run_program({"dynamics", model, "--base", "floating", "--q", "0,0,0,0,0,0,0,0"}).status, 2);
}

// Texts that a clip is said to remember, wrong in every way that a reader trusts.
TEST(Extract, OfAClipWhoseSceneIsNoTextIsExitThree) {
  const TemporaryFolder folder;
  const std::string clip = folder.file("a.mov");
  const ProgramResult made = run_program({"render", "assets/scenes/pp_free.yaml", "-o", clip, "--set", "duration=0.05", "--set",
                                          "video.width=160", "--set", "video.height=90", "--quiet"});
  ASSERT_EQ(made.status, 0) << made.err;
  std::ifstream in(clip, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  in.close();
  const std::size_t place = bytes.find("gravity:");
  ASSERT_NE(place, std::string::npos) << "the scene stands in the file as it is";
  bytes[place] = '\xFF';
  std::ofstream(clip, std::ios::binary) << bytes;
  for (const char* form : {"--json", "--force"}) {
    const ProgramResult result = run_program({"extract", clip, form});
    EXPECT_EQ(result.status, 3) << form << result.err;
    EXPECT_NE(result.err.find("no UTF-8"), std::string::npos) << result.err;
  }
}

TEST(Extract, OfAHostileClipIsOneLineAndExitThree) {
  const TemporaryFolder folder;
  const auto svg = [&](const std::string& text) { return folder.write("a.svg", "<svg><metadata>" + text + "</metadata></svg>"); };
  std::string deep = "{\"chainreel_figure\": ";
  for (int i = 0; i < 100000; ++i) deep += "[";
  const ProgramResult nested = run_program({"extract", svg(deep)});
  EXPECT_EQ(nested.status, 3) << nested.err;
  EXPECT_EQ(std::count(nested.err.begin(), nested.err.end(), '\n'), 1);
  const std::string large = folder.write("large.urdf", "");
  fs::resize_file(large, std::uintmax_t(200) << 30);
  for (const std::string& audit :
       {std::string(R"({"model": 3, "model_sha256": []})"), std::string(R"({"panels": 7})"), std::string(R"({"panels": [1, null, {"model": {}}]})"),
        R"({"model": ")" + std::string(5000, 'n') + R"(", "model_sha256": "x"})", R"({"model": ")" + large + R"(", "model_sha256": "x"})",
        std::string(R"({"model": "/dev/zero", "model_sha256": "x"})")}) {
    const ProgramResult result = run_program({"extract", svg(R"({"chainreel_scene": "model: m.urdf\n", "chainreel_audit": )" + audit + "}")}, {.timeout_s = 20});
    EXPECT_EQ(result.status, 0) << audit.substr(0, 60) << result.err;
    EXPECT_FALSE(result.timed_out);
    EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  fs::create_symlink("loop.svg", folder.file("loop.svg"));
  for (const std::string& name : {folder.file("loop.svg"), folder.file(std::string(300, 'n') + ".svg")})
    for (const char* command : {"extract", "check", "gallery", "doctor"}) {
      if (command == std::string("doctor")) continue;
      const ProgramResult result = run_program({command, name});
      EXPECT_EQ(result.status, 3) << command << result.err;
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
}

TEST(Gallery, WaitsForNoPipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(shell(render_to("a.mp4"), folder).status, 0);
  for (const char* name : {"a.json", "a.txt"}) fs::remove(folder.file(name));
  for (const char* name : {"a.json", "a.txt", "a_chart.png", "b.mp4"}) ASSERT_EQ(mkfifo(folder.file(name).c_str(), 0600), 0);
  const ProgramResult result = run_program({"gallery", folder.path().string(), "-o", folder.file("page.html")}, {.timeout_s = 20});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(run_program({"gallery", folder.file("b.mp4"), "-o", folder.file("b.html")}, {.timeout_s = 20}).status, 3);
}

}  // namespace
}  // namespace chainreel
