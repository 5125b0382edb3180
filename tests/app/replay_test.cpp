// Motions that were recorded, as films, tables and figures: what is shown of them is what is shown of the run that made them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "core/csv.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kModel = fs::absolute("models/rr.urdf").string();
// What the run and its replay share; a free swing, and one under torques that change.
const std::string kPage = "title: swing\nlayout: scene\nvideo: {width: 320, height: 180, fps: 30}\n";
const std::string kRun = "start: {q: [-60deg, 40deg], qd: [0, 1]}\nmethod: dop853\nduration: 1\n";
const std::string kTorque = "torque: [2 * sin(3 * t), -q2]\n";

class Replay : public ::testing::Test {
 protected:
  std::string scene(const std::string& name, const std::string& keys) {
    return folder.write(name, "model: " + kModel + "\n" + kPage + keys);
  }
  ProgramResult good(const Words& words) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  }
  // The run as a log with these columns.
  void record(const std::string& log, const std::string& columns, const std::string& torque = kTorque, const Words& more = {}) {
    scene("run.yaml", kRun + torque);
    good(with({"simulate", folder.file("run.yaml"), "-o", folder.file(log), "--columns", columns, "--quiet", "--force"}, more));
  }
  Table simulated(const std::string& scene, const Words& more = {}) {
    good(with({"simulate", folder.file(scene), "-o", folder.file("out.csv"), "--force", "--quiet"}, more));
    return read_csv(folder.file("out.csv"));
  }
  std::string refusal(const std::string& keys, int status = 3, const std::string& command = "check") {
    scene("bad.yaml", keys);
    const ProgramResult result = run_program({command, folder.file("bad.yaml")});
    EXPECT_EQ(result.status, status) << result.err;
    return result.err;
  }
  TemporaryFolder folder;
};

// A log does not know which of its torques were a spring's, whose energy the run tells.
Table without_springs(Table table) {
  for (const char* name : {"springs", "energy"})
    if (const int i = table.find(name); i >= 0) {
      table.names.erase(table.names.begin() + i);
      table.columns.erase(table.columns.begin() + i);
    }
  return table;
}

double largest_difference(const Table& one, const Table& other) {
  const Table a = without_springs(one), b = without_springs(other);
  double largest = 0;
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.rows(), b.rows());
  for (std::size_t i = 0; i < std::min(a.names.size(), b.names.size()); ++i)
    for (std::size_t k = 0; k < std::min(a.rows(), b.rows()); ++k)
      largest = std::max(largest, std::fabs(a.columns[i][k] - b.columns[i][k]));
  return largest;
}

TEST_F(Replay, FramesAreThoseOfTheRunPixelByPixel) {
  record("log.csv", "t,q,qd,qdd");
  scene("replay.yaml", "motion: log.csv\n");
  // Without torques, which differ by rounding: an end of an arc may then take another sample of a pixel.
  const Words look{"--set", "draw=[chain, trail, time, title, ellipse, ground, g]", "--quiet"};
  for (const std::string name : {"run", "replay"})
    good(with({"render", folder.file(name + ".yaml"), "-o", folder.file(name) + "/000000.png"}, look));
  int frames = 0;
  for (int k = 0; k < 30; ++k) {
    char name[32];
    std::snprintf(name, sizeof name, "/%06d.png", k);
    ASSERT_TRUE(fs::exists(folder.file("run") + name)) << name;
    const ProgramResult same = run_program({"compare", folder.file("run") + name, folder.file("replay") + name, "--tolerance", "0", "--count-edges"});
    EXPECT_EQ(same.status, 0) << name << same.out << same.err;
    ++frames;
  }
  EXPECT_EQ(frames, 30);
  const Words torques{"--set", "draw=[chain, torque, ground, g]", "--at", "0.6", "--quiet"};
  for (const std::string name : {"run", "replay"})
    good(with({"snapshot", folder.file(name + ".yaml"), "-o", folder.file(name) + "/torques.png"}, torques));
  EXPECT_EQ(run_program({"compare", folder.file("run/torques.png"), folder.file("replay/torques.png")}).status, 0);
  // Negative control: of another log they are others.
  record("log.csv", "t,q,qd,qdd", "");
  good(with({"snapshot", folder.file("replay.yaml"), "--at", "0.5", "-o", folder.file("b.png")}, look));
  good(with({"snapshot", folder.file("run.yaml"), "--at", "0.5", "--set", "torque=[1, 0]", "-o", folder.file("c.png")}, look));
  EXPECT_EQ(run_program({"compare", folder.file("b.png"), folder.file("c.png")}).status, 1);
}

TEST_F(Replay, TablesAreThoseOfTheRun) {
  record("log.csv", "t,q,qd,qdd");
  scene("replay.yaml", "motion: log.csv\n");
  const Words all{"--columns", "t,q,qd,qdd,tau,energy,x_G,y_G,xd_G,yd_G"};
  // All but tau and qdd are computed from the same numbers; those are sums of some 50 N m in doubles.
  EXPECT_LT(largest_difference(simulated("run.yaml", all), simulated("replay.yaml", all)), 1e-11);
  // From q and qd every 1/30 s: h^3 of a motion of some 4 rad/s, measured 0.1; from q alone h^2.
  record("log.csv", "t,q,qd");
  const double with_rates = largest_difference(simulated("run.yaml", all), simulated("replay.yaml", all));
  record("log.csv", "t,q");
  const double alone = largest_difference(simulated("run.yaml", all), simulated("replay.yaml", all));
  EXPECT_GT(with_rates, 1e-6);
  EXPECT_LT(with_rates, alone);
}

TEST_F(Replay, WordsTellWhatItsTorquesAre) {
  record("log.csv", "t,q,qd,qdd");
  scene("replay.yaml", "motion: log.csv\n");
  good({"render", folder.file("replay.yaml"), "-o", folder.file("a.mp4"), "--quiet"});
  const std::string text = read_whole_file(folder.file("a.txt"));
  EXPECT_THAT(text, AllOf(HasSubstr("recorded motion"), HasSubstr("inverse dynamics"), Not(HasSubstr("no torques"))));
  good({"snapshot", folder.file("replay.yaml"), "-o", folder.file("a.svg"), "--quiet"});
  good({"snapshot", folder.file("run.yaml"), "-o", folder.file("b.svg"), "--quiet"});
  EXPECT_NE(read_whole_file(folder.file("a.svg")), read_whole_file(folder.file("b.svg")));
  const Json audit = Json::parse(read_whole_file(folder.file("a.json")));
  EXPECT_EQ(audit["method"], "replay");
  EXPECT_EQ(audit["evaluations"], 0);
  EXPECT_EQ(audit["motion"]["torques"], "inverse dynamics");
  EXPECT_EQ(audit["warnings"], Json::array());
  EXPECT_EQ(audit["duration"], 1.0) << "as long as the log";
}

TEST_F(Replay, NeverWarnsOfAMethodsEnergy) {
  // A log that is no motion of this mechanism, by rates of another one: it has no method that could err.
  folder.write("log.csv", "t,q1,q2,qd1,qd2\n0,0,0,5,0\n0.5,0.1,0,-5,0\n1,0.2,0,5,0\n");
  scene("replay.yaml", "motion: log.csv\n");
  const ProgramResult result = good({"simulate", folder.file("replay.yaml"), "-o", folder.file("a.csv")});
  EXPECT_THAT(result.err, AllOf(Not(HasSubstr("WARNING")), Not(HasSubstr("energy is off")), HasSubstr("'qd1' is not the rate of 'q1'")));
}

TEST_F(Replay, IsAsLongAsTheLogOrShorter) {
  record("log.csv", "t,q");
  scene("replay.yaml", "motion: log.csv\n");
  EXPECT_EQ(simulated("replay.yaml", {"--set", "duration=0.5"}).columns[0].back(), 0.5);
  EXPECT_EQ(simulated("replay.yaml").columns[0].back(), 1);
  EXPECT_THAT(refusal("motion: log.csv\nduration: 1.01\n"), AllOf(HasSubstr("bad.yaml:6"), HasSubstr("ends at 1 s")));
}

TEST_F(Replay, RefusesWhatMeansNothingBesideIt) {
  record("log.csv", "t,q");
  const std::string all = refusal("motion: log.csv\nstart: {q: [0, 0]}\ntorque: [0, 0]\nmethod: rk4\nstep: 0.01\naccuracy: 1 px\n");
  EXPECT_THAT(all, AllOf(HasSubstr("start, torque, method, step, accuracy mean nothing"), HasSubstr("--set start= --set torque=")));
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1) << all;
  for (const char* key : {"tolerance: 1e-6", "order: 4", "constraints: [{joint: {name: joint2, value: 0}}]", "stabilize: baumgarte", "limit: clamp",
                          "limit: stop", "expect: diverge", "base: floating", "start: {qd: [0, 0]}"})
    EXPECT_THAT(refusal("motion: log.csv\n" + std::string(key) + "\n"), HasSubstr("'motion'")) << key;
  // Those that mean something, and the remedy as it is told.
  scene("good.yaml", "motion: log.csv\nlimit: report\nfriction: false\nparameters: {k: 1}\nevents: [{when: q1 > -k}]\nduration: 0.5\n");
  good({"check", folder.file("good.yaml")});
  scene("whole.yaml", kRun + kTorque);
  good({"check", folder.file("whole.yaml"), "--set", "motion=" + folder.file("log.csv"), "--set", "start=", "--set", "torque=", "--set", "method="});
}

TEST_F(Replay, CommandsThatAreAboutMethodsSaySo) {
  record("log.csv", "t,q");
  for (const char* command : {"chart", "energy", "stability"})
    EXPECT_THAT(refusal("motion: log.csv\n", 3, command), AllOf(HasSubstr("recorded motion"), HasSubstr(command)));
  scene("replay.yaml", "motion: log.csv\n");
  EXPECT_THAT(run_program({"inverse", folder.file("replay.yaml"), "--trajectory", folder.file("log.csv")}).err, HasSubstr("motion of its own"));
  EXPECT_THAT(run_program({"check", folder.file("replay.yaml"), "--all"}).err, HasSubstr("recorded motion"));
}

// What a page says of how to compute is for the panels that compute; one that shows a log has no use for it. In either order, and again
// from what the film remembers.
TEST_F(Replay, StandsBesideARunOfTheSamePage) {
  record("log.csv", "t,q,qd,qdd");
  const std::string page = "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nstart: {q: [1, 0]}\nmethod: rk4\nstep: 0.001\nlimit: stop\nvideo: {width: 160, height: 90}\nduration: 0.2\n";
  for (const char* panels : {"[{title: run}, {title: log, motion: log.csv}]", "[{title: log, motion: log.csv}, {title: run}]"}) {
    const std::string both = folder.write("both.yaml", page + "compare: " + panels + "\n");
    const ProgramResult made = run_program({"render", both, "--quiet", "--force", "-o", folder.file("both.mp4")});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(run_program({"check", folder.file("both.mp4"), "--today"}).status, 0);
    ASSERT_EQ(run_program({"extract", folder.file("both.mp4"), "--force", "-o", folder.file("again.yaml")}).status, 0);
    const Json before = Json::parse(run_program({"simulate", both, "--quiet", "--json", "--force", "-o", folder.file("a.csv")}).out);
    const Json after = Json::parse(run_program({"simulate", folder.file("again.yaml"), "--quiet", "--json", "--force", "-o", folder.file("b.csv")}).out);
    ASSERT_EQ(before["panels"].size(), 2u);
    for (const std::size_t i : {0, 1}) {
      EXPECT_EQ(before["panels"][i]["trajectory_sha256"], after["panels"][i]["trajectory_sha256"]) << panels << i;
      EXPECT_EQ(before["panels"][i]["method"] == "rk4", before["panels"][i]["title"] == "run") << panels << i;
    }
  }
  // What such a panel says itself is refused as ever.
  const std::string bad = folder.write("bad2.yaml", page + "compare: [{title: run}, {motion: log.csv, step: 0.1}]\n");
  EXPECT_THAT(run_program({"check", bad}).err, HasSubstr("beside it step means nothing"));
}

// The torques at the rows of a log, by its own names, in degrees, with stamps of a clock: those of the same numbers from t = 0
// in radians. Stamps of 1.7e9 s would leave a double 2e-7 s, of which splines made 8 % of the torques.
TEST_F(Replay, InverseTakesTheLogOfAScene) {
  std::string plain = "t,q1,q2\n", log = "stamp,shoulder,elbow\n";
  for (int k = 0; k <= 1000; ++k) {
    const double t = 1e-3 * k, a = 40 * std::sin(3 * t), b = 25 * std::cos(2 * t), rad = std::numbers::pi / 180;
    char row[200];
    std::snprintf(row, sizeof row, "%.3f,%.17g,%.17g\n", t, a * rad, b * rad);
    plain += row;
    std::snprintf(row, sizeof row, "17000000%02d.%03d,%.17g,%.17g\n", k / 1000, k % 1000, a, b);
    log += row;
  }
  folder.write("plain.csv", plain);
  folder.write("log.csv", log);
  scene("own.yaml", "motion: {csv: log.csv, columns: {time: stamp, joint1: \"shoulder [deg]\", joint2: {q: \"elbow [deg]\"}}}\n");
  scene("bare.yaml", "gravity: [0, -9.81, 0]\n");
  good({"inverse", folder.file("bare.yaml"), "--trajectory", folder.file("plain.csv"), "-o", folder.file("a.csv")});
  good({"inverse", folder.file("own.yaml"), "-o", folder.file("b.csv")});
  const Table a = read_csv(folder.file("a.csv")), b = read_csv(folder.file("b.csv"));
  ASSERT_EQ(a.rows(), 1001u);
  ASSERT_EQ(b.rows(), 1001u);
  EXPECT_EQ(b.columns[0][1], 1700000000.001) << "instants as the log has them";
  double largest = 0, off = 0;
  for (std::size_t k = 0; k < a.rows(); ++k)
    for (std::size_t i = 1; i < 3; ++i) {
      largest = std::max(largest, std::fabs(a.columns[i][k]));
      off = std::max(off, std::fabs(a.columns[i][k] - b.columns[i][k]));
    }
  // Second differences of angles rounded to 1e-16 rad, over 1e-6 s^2.
  EXPECT_LT(off, 1e-7 * largest);
  // What they are in is seen: in radians these would be turns.
  scene("bad.yaml", "motion: {csv: log.csv, columns: {time: stamp, joint1: shoulder, joint2: elbow}}\n");
  EXPECT_THAT(run_program({"inverse", folder.file("bad.yaml"), "-o", folder.file("c.csv")}).err,
              AllOf(HasSubstr("turns"), HasSubstr("columns: {joint1: \"shoulder [deg]\"}")));
  EXPECT_THAT(good({"check", folder.file("own.yaml")}).out, HasSubstr("joint1: \"shoulder [deg]\""));
}

// Of a mechanism that presses on its ties, too, torques are held against those that the log itself tells.
TEST_F(Replay, InverseOfATiedRunFindsItsOwnTorques) {
  const std::string scene = folder.write("tied.yaml", "model: {links: [1, 1], masses: [1, 1]}\ngravity: [0, 0, 0]\nstart: {q: [60deg, -120deg]}\n"
                                                       "constraints: [{line: {frame: gripper, point: [0, 0], direction: [1, 0]}}]\n"
                                                       "contact_force: {force: [0, -5]}\nduration: 0.5\n");
  good({"simulate", scene, "--columns", "t,q,qd,qdd,tau,lambda", "-o", folder.file("tied.csv")});
  const std::string said = good({"inverse", scene, "--trajectory", folder.file("tied.csv"), "-o", folder.file("tau.csv")}).err;
  EXPECT_THAT(said, HasSubstr("which differ by "));
  double off = 1;
  std::sscanf(said.c_str() + said.find("differ by ") + 10, "%lf", &off);
  EXPECT_LT(off, 1e-12) << said;  // rounding of 5 N m
}

TEST_F(Replay, OneUnitIsToldOfAColumn) {
  folder.write("log.csv", "t,a [rad],b\n0,0,0\n1,1,1\n");
  EXPECT_THAT(refusal("motion: {csv: log.csv, columns: {joint1: \"a [deg]\", joint2: b}}\n"), HasSubstr("remove one of the units"));
  EXPECT_THAT(refusal("motion: {csv: log.csv, columns: {joint1: a, joint2: \"b [grad]\"}}\n"), HasSubstr("not known"));
  EXPECT_EQ(run_program({"inverse", "models/rr.urdf", "-o", folder.file("a.csv")}).status, 2);
}

TEST_F(Replay, AllOtherCommandsShowIt) {
  record("log.csv", "t,q,qd,qdd");
  scene("replay.yaml", "motion: log.csv\nevents: [{when: y_G < -1.4, kind: fall, name: low}]\nplot: [tau]\n");
  const std::string file = folder.file("replay.yaml");
  EXPECT_THAT(good({"check", file}).out, HasSubstr("replay of log.csv"));
  const Json now = Json::parse(good({"dynamics", file, "--at", "0.1", "--json"}).out);
  const Json computed = Json::parse(good({"dynamics", folder.file("run.yaml"), "--at", "0.1", "--json"}).out);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(now["tau"][i].get<double>(), computed["tau"][i].get<double>(), 1e-11);
    EXPECT_NEAR(now["qdd"][i].get<double>(), computed["qdd"][i].get<double>(), 1e-9);
  }
  const auto value = [](const ProgramResult& result) { return Json::parse(result.out); };
  EXPECT_TRUE(value(good({"fall", file, "--json"})).is_object());
  good({"ellipse", "--along", file, "-o", folder.file("e.png"), "--quiet"});
  good({"sheet", file, "-o", folder.file("s.png"), "--quiet"});
  good({"sweep", file, "--over", "duration=0.1,0.2", "-o", folder.file("sweep.csv"), "--quiet"});
  EXPECT_THAT(read_whole_file(folder.file("sweep.csv")), HasSubstr("replay of log.csv"));
}

TEST_F(Replay, StandsBesideARunThatIsComputed) {
  record("log.csv", "t,q,qd,qdd");
  scene("both.yaml", "");
  folder.write("both.yaml", "model: " + kModel + "\nvideo: {width: 320, height: 180, fps: 30}\nlayout: ghost\ncompare:\n  - {title: recorded, motion: log.csv}\n"
                            "  - {title: computed, start: {q: [-60deg, 40deg], qd: [0, 1]}, torque: [2 * sin(3 * t), -q2], method: dop853}\n");
  good({"simulate", folder.file("both.yaml"), "-o", folder.file("p.csv"), "--quiet"});
  const Table recorded = read_csv(folder.file("p.1.csv")), computed = read_csv(folder.file("p.2.csv"));
  EXPECT_EQ(recorded.columns[0].back(), 1) << "as long as the recorded one";
  EXPECT_LT(largest_difference(recorded, computed), 1e-7);  // dop853 at 1e-9
  good({"render", folder.file("both.yaml"), "-o", folder.file("b.mp4"), "--quiet"});
}

TEST_F(Replay, AnotherLogMakesPartsOfAnotherFilm) {
  record("log.csv", "t,q,qd,qdd");
  scene("replay.yaml", "motion: log.csv\n");
  const Words render{"render", folder.file("replay.yaml"), "-o", folder.file("a.mp4"), "--quiet", "--set", "video.fps=128", "--shard"};
  good(with(render, {"1/2"}));
  // The same q and qd, so the same trajectory, but other torques.
  const std::string log = read_whole_file(folder.file("log.csv"));
  std::istringstream lines(log);
  std::string changed, line;
  for (int k = 0; std::getline(lines, line); ++k) changed += line + (k == 9 ? "e1" : "") + "\n";
  folder.write("log.csv", changed);
  good(with(render, {"2/2"}));
  Words parts{"join", "-o", folder.file("whole.mp4")};
  for (const auto& entry : fs::directory_iterator(folder.path()))
    if (entry.path().string().find(".part-") != std::string::npos && entry.path().extension() == ".mp4") parts.push_back(entry.path().string());
  ASSERT_EQ(parts.size(), 5u);
  EXPECT_NE(run_program(parts).status, 0);
  // Negative control: of one log they are parts of one film.
  good(with(render, {"1/2", "--force"}));
  good(parts);
}

TEST_F(Replay, FilmsRememberNamesOfColumns) {
  folder.write("log.csv", "stamp [ms],arm,b\n0,0,0\n500,0.5,0.1\n1000,1,0\n");
  scene("replay.yaml", "motion: {csv: log.csv, columns: {time: stamp, joint1: {q: arm}, joint2: b}}\n");
  good({"render", folder.file("replay.yaml"), "-o", folder.file("a.mp4"), "--quiet"});
  good({"extract", folder.file("a.mp4"), "-o", folder.file("again.yaml")});
  EXPECT_THAT(read_whole_file(folder.file("again.yaml")), HasSubstr("columns: {time: stamp, joint1: arm, joint2: b}"));
  EXPECT_EQ(largest_difference(simulated("replay.yaml"), simulated("again.yaml")), 0);
}

TEST_F(Replay, TorquesOfATableMayHaveNamesOfTheirOwn) {
  folder.write("a.csv", "t,tau1,tau2\n0,1,0\n1,2,-1\n");
  folder.write("b.csv", "stamp [ms],elbow,shoulder\n0,0,1\n1000,-1,2\n");
  scene("run.yaml", "duration: 1\nmethod: dop853\ntorque: {csv: a.csv}\n");
  const Table usual = simulated("run.yaml");
  const Words named{"--set", "torque={csv: " + folder.file("b.csv") + ", columns: {time: stamp, joint1: shoulder, joint2: elbow}}"};
  EXPECT_EQ(largest_difference(usual, simulated("run.yaml", named)), 0);
  const Words swapped{"--set", "torque={csv: " + folder.file("b.csv") + ", columns: {time: stamp, joint2: shoulder, joint1: elbow}}"};
  EXPECT_GT(largest_difference(usual, simulated("run.yaml", swapped)), 0.1);  // negative control
  EXPECT_THAT(refusal("torque: {inverse_of: a.csv, columns: {time: t}}\n"), HasSubstr("names the columns of `csv`"));
  EXPECT_THAT(refusal("torque: {csv: b.csv, columns: {time: stamp, joint1: shoulder, joint2: hand}}\n"), HasSubstr("has no column 'hand'"));
  EXPECT_THAT(refusal("torque: {csv: b.csv, columns: {time: stamp, joint1: shoulder}}\n"), HasSubstr("there is none of 'joint2'"));
}

}  // namespace
}  // namespace chainreel
