// Motions as tables, scenes from standard input: what goes in and out of the program besides pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/csv.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::Each;
using testing::HasSubstr;

const Words kHalfSecond{"--set", "duration=0.5", "--quiet"};

ProgramResult simulate(const std::string& scene, const Words& more) {
  return run_program(with(with({"simulate", scene}, kHalfSecond), more));
}

Table table_of(const std::string& scene, const Words& more) {
  const TemporaryFolder folder;
  const ProgramResult made = simulate(scene, with(more, {"-o", folder.file("a.csv")}));
  EXPECT_EQ(made.status, 0) << made.err;
  return made.status == 0 ? read_csv(folder.file("a.csv")) : Table{};
}

const std::vector<double>& column(const Table& table, const std::string& name) {
  static const std::vector<double> none;
  const int at = table.find(name);
  EXPECT_GE(at, 0) << name;
  return at < 0 ? none : table.columns[std::size_t(at)];
}

// Commands whose numbers are tables: each in all three formats, the same numbers in all of them.
struct Tabled {
  const char* name;
  Words words;
  std::string column;  // of numbers
  bool is_measured = false;  // anew each time, so that files of two runs differ
};

class TabledCommand : public testing::TestWithParam<Tabled> {};

TEST_P(TabledCommand, HasTheSameNumbersInEveryFormat) {
  const TemporaryFolder folder;
  const auto made = [&](const std::string& ending) {
    const std::string file = folder.file("a" + ending);
    const ProgramResult run = run_program(with(GetParam().words, {"-o", file, "--quiet"}));
    EXPECT_EQ(run.status, 0) << ending << ": " << run.err;
    return file;
  };
  const std::string csv = made(".csv"), npz = made(".npz"), json = made(".json");
  const ProgramResult numpy = run_command(
      {"/usr/bin/python3", "-c",
       "import csv, json, numpy, sys\n"
       "d = numpy.load(sys.argv[1])\n"
       "rows = list(csv.DictReader(line for line in open(sys.argv[2]) if not line.startswith('#')))\n"
       "json.load(open(sys.argv[3]))\n"
       "name = sys.argv[4]\n"
       "assert list(d['columns']) and set(d['columns']) == set(rows[0]), (list(d['columns']), list(rows[0]))\n"
       "there = next(c for c in rows[0] if c.split(' [')[0] == name)\n"
       "assert d[name].dtype == numpy.float64\n"
       "assert sys.argv[5] == '1' or len(d[name]) == len(rows)\n"
       "assert sys.argv[5] == '1' or all((numpy.isnan(x) and r[there] == '') or x == float(r[there]) for x, r in zip(d[name], rows))\n"
       "print(numpy.isfinite(d[name]).any())\n",
       npz, csv, json, GetParam().column, GetParam().is_measured ? "1" : "0"});
  EXPECT_EQ(numpy.out, "True\n") << numpy.err;
  const std::string other = folder.file("a.xlsx");
  const ProgramResult refused = run_program(with(GetParam().words, {"-o", other}));
  EXPECT_EQ(refused.status, 2) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr(".npz")) << "the endings that there are";
  EXPECT_FALSE(fs::exists(other));
}

INSTANTIATE_TEST_SUITE_P(
    All, TabledCommand,
    testing::Values(
        Tabled{"fall", {"fall", "assets/scenes/humanoid_fall.yaml", "--sweep", "parameters.k=0,600"}, "fall_time"},
        Tabled{"sweep", {"sweep", "assets/scenes/rr_free.yaml", "--over", "start.q.1=0,1", "--over", "method=rk4,dop853", "--set", "duration=0.2"}, "q1"},
        Tabled{"ellipse", {"ellipse", "models/rr.urdf", "--pose", "0,90deg", "--pose", "0,60deg"}, "q.joint2"},
        Tabled{"chart", {"chart", "assets/scenes/rr_free.yaml", "--methods", "rk4,explicit_euler", "--set", "duration=0.2", "--runs", "1", "--longest", "2ms"}, "error", true},
        Tabled{"energy", {"energy", "assets/scenes/rr_free.yaml", "--methods", "rk4,explicit_euler", "--set", "duration=0.2"}, "energy_error"},
        Tabled{"stability", {"stability", "assets/scenes/pp_spring.yaml", "--set", "duration=0.2", "--set", "torque=[0, -k * y_G]", "--set",
                             "parameters.k=25", "--x", "step=0.01:0.02:2", "--y", "parameters.k=25:50:2"}, "energy_error"},
        Tabled{"methods", {"stability", "assets/scenes/pp_spring.yaml", "--methods", "rk4,dop853", "--set", "duration=0.2"}, "energy_error"}),
    [](const auto& param) { return std::string(param.param.name); });

// A row a millisecond without a film of 1000 frames a second; times are exact: 0.003, not 0.0030000000000000001 and its kin.
TEST(SimulateEvery, GivesTheTimeBetweenRows) {
  const TemporaryFolder folder;
  const auto table = [&](const Words& more) {
    Words words{"simulate", "rr_free", "--set", "duration=0.05", "--columns", "t,q", "--force", "-o", folder.file("a.csv")};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  ASSERT_EQ(table({"--every", "1ms"}).status, 0);
  const std::string every = read_whole_file(folder.file("a.csv"));
  EXPECT_EQ(std::ranges::count(every, '\n'), 52);
  EXPECT_THAT(every, testing::AllOf(HasSubstr("\n0.003,"), HasSubstr("\n0.047,"), HasSubstr("\n0.05,")));
  ASSERT_EQ(table({"--set", "video.fps=1000"}).status, 0);
  EXPECT_EQ(read_whole_file(folder.file("a.csv")), every);
  ASSERT_EQ(table({"--every", "15ms"}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("a.csv")), testing::AllOf(HasSubstr("\n0.045,"), HasSubstr("\n0.05,"))) << "the end is there in any case";
  for (const char* wrong : {"0", "-1ms", "1e-12", "soon"}) EXPECT_NE(table({"--every", wrong}).status, 0) << wrong;
  EXPECT_EQ(table({"--every", "1ms", "--every-step"}).status, 2);
  // One of a column's numbers, or all of them.
  const std::string all = table({"--peaks", "qd,tau"}).out, one = table({"--peaks", "qd2"}).out;
  const auto line_of = [](const std::string& text, const std::string& name) {
    const std::size_t at = text.find("\n" + name);
    std::string line = at == text.npos ? "" : text.substr(at, text.find('\n', at + 1) - at);
    line.erase(std::unique(line.begin(), line.end(), [](char a, char b) { return a == ' ' && b == ' '; }), line.end());
    return line;
  };
  EXPECT_EQ(line_of(one, "qd2"), line_of(all, "qd2"));
  EXPECT_NE(line_of(one, "qd2"), "");
  EXPECT_THAT(one, testing::Not(HasSubstr("qd1")));
  EXPECT_THAT(table({"--peaks", "qd7"}).err, HasSubstr("--peaks: the model has no qd7; it has qd1, qd2"));
  EXPECT_THAT(table({"--peaks", "qd,qd2"}).err, HasSubstr("leave one out"));
}

TEST(SimulateTables, AreTheSameMotionInEveryFormat) {
  const TemporaryFolder folder;
  const std::string csv = folder.file("a.csv"), json = folder.file("a.json"), npz = folder.file("a.npz");
  const ProgramResult made =
      simulate("assets/scenes/four_bar.yaml", {"-o", csv, "-o", npz, "-o", json, "--columns", "t,q,lambda,energy", "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(Json::parse(made.out)["files"], Json({csv, npz, json}));
  const Table table = read_csv(csv);
  const Json read = Json::parse(read_whole_file(json));
  EXPECT_EQ(read["q"].size(), table.rows());
  const ProgramResult numpy = run_command({"/usr/bin/python3", "-c",
                                           "import numpy, json, sys\n"
                                           "d, j = numpy.load(sys.argv[1]), json.load(open(sys.argv[2]))\n"
                                           "c = numpy.genfromtxt(sys.argv[3], delimiter=',', skip_header=1)\n"
                                           "assert list(d['columns']) == j['columns']\n"
                                           "assert all(numpy.array_equal(d[k], numpy.array(j[k])) for k in j if k != 'columns')\n"
                                           "all = numpy.column_stack([d[k] for k in j if k != 'columns'])\n"
                                           "print(numpy.array_equal(all, c), all.shape[1] == len(j['columns']))\n",
                                           npz, json, csv});
  EXPECT_EQ(numpy.out, "True True\n") << numpy.err;
}

// Of a line it is the distance from it; what is projected stays on it to rounding, what is not drifts.
// Numbers are read more closely than pictures: with `auto` a table is exact to 1e-8 of the motion's room, the film's own numbers are not.
TEST(SimulateTables, AreExactWhereAMethodIsChosen) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [0.5, 0.4], masses: [2, 1.5]}\ntorque: [3, 1]\nduration: 1\nvideo: {width: 64, height: 36}\n");
  const auto last_q2 = [&](const std::vector<std::string>& command) {
    const std::string csv = folder.file("t.csv");
    std::vector<std::string> words = command;
    words.insert(words.end(), {"-o", csv, "--force", "--quiet"});
    EXPECT_EQ(run_program(words).status, 0);
    const std::string text = read_whole_file(csv);
    const std::string row = text.substr(text.rfind('\n', text.size() - 2) + 1);
    return std::stod(row.substr(row.find(',', row.find(',') + 1) + 1));
  };
  const double truth = last_q2({"simulate", scene, "--set", "method=dop853", "--set", "tolerance=1e-13"});
  EXPECT_NEAR(last_q2({"simulate", scene}), truth, 1e-7);  // radians of a joint beside 1e-8 of 1.8 m: links of 0.4 m
  EXPECT_GT(std::abs(last_q2({"simulate", scene, "--set", "accuracy=0.1 px"}) - truth), 1e-6);
  EXPECT_EQ(last_q2({"render", scene}), last_q2({"simulate", scene, "--set", "accuracy=0.1 px"})) << "the numbers of the film";
}

TEST(SimulateTables, TellByHowMuchConstraintsAreMissed) {
  const TemporaryFolder folder;
  double largest[2];
  for (const int k : {0, 1}) {
    const std::string file = folder.file("a" + std::to_string(k) + ".csv");
    ASSERT_EQ(simulate("assets/scenes/pen_drift.yaml", {"--panel", k == 0 ? "1" : "3", "--columns", "t,y_G,constraint_error", "-o", file}).status, 0);
    const Table table = read_csv(file);
    ASSERT_EQ(table.names, (std::vector<std::string>{"t", "y_G", "phi1"}));
    EXPECT_EQ(table.units[2], "m");
    largest[k] = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      EXPECT_NEAR(std::abs(table.columns[2][row]), std::abs(table.columns[1][row] - 0.5), 1e-14) << "rounding of numbers about 1";
      largest[k] = std::max(largest[k], std::abs(table.columns[2][row]));
    }
  }
  EXPECT_GT(largest[0], 1e-3);
  EXPECT_LT(largest[1], 1e-14);
  EXPECT_EQ(simulate("assets/scenes/rr_free.yaml", {"--columns", "t,constraint_error", "-o", folder.file("b.csv")}).status, 2);
  EXPECT_EQ(run_program({"snapshot", "assets/scenes/pen.yaml", "--quiet", "--set", "plot=constraint_error", "-o", folder.file("a.png")}).status, 0);
  EXPECT_EQ(run_program({"snapshot", "assets/scenes/rr_free.yaml", "--quiet", "--set", "plot=constraint_error", "-o", folder.file("b.png")}).status, 3);
}

TEST(SimulateTables, OfOtherKindsAreRefusedBeforeAnythingIsComputed) {
  const TemporaryFolder folder;
  for (const std::string name : {"a", "a.txt", "a.csv.gz", "a.CSV.gz"}) {
    const ProgramResult refused = simulate("assets/scenes/rr_free.yaml", {"-o", folder.file("good.csv"), "-o", folder.file(name)});
    EXPECT_EQ(refused.status, 2) << name;
    EXPECT_THAT(refused.err, HasSubstr(".csv, .json, .npz")) << name;
  }
  const ProgramResult twice = simulate("assets/scenes/rr_free.yaml", {"-o", folder.file("a.csv"), "-o", folder.file("./a.csv")});
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("named twice"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SimulateTables, GiveCsvToStandardOutputBesideFiles) {
  const TemporaryFolder folder;
  const ProgramResult made = simulate("assets/scenes/pp_free.yaml", {"-o", "-", "-o", folder.file("a.csv")});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out, read_whole_file(folder.file("a.csv")));
  EXPECT_EQ(simulate("assets/scenes/pp_free.yaml", {"-o", "-", "-o", "-"}).status, 2);
}

// A scene with a robot of two ends.
std::string two_arms(const TemporaryFolder& folder) {
  const std::string inertial = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
  const auto arm = [&](const std::string& name) {
    return "<link name='" + name + "'>" + inertial + "</link><joint name='to_" + name +
           "' type='continuous'><parent link='base'/><child link='" + name + "'/><axis xyz='0 0 1'/></joint>";
  };
  folder.write("two.urdf", "<robot name='two'><link name='base'>" + inertial + "</link>" + arm("left") + arm("right") + "</robot>");
  return folder.write("two.yaml", "model: two.urdf\nduration: 0.5\nmethod: rk4\nstep: 0.01\n");
}

TEST(SimulateColumns, HoldWhatTheEquationOfMotionSays) {
  // tau = M qdd + nle + tau_f at each row, by the program's own numbers of that state.
  const Table table = table_of("assets/scenes/rr_torque.yaml", {"--columns", "tau,qdd,qd,q,t,x_G,yd_G,energy_error"});
  EXPECT_EQ(table.names.front(), "tau1") << "in the order that was asked for";
  const std::size_t row = table.rows() / 2;
  const auto pair = [&](const std::string& stem) {
    return std::to_string(column(table, stem + "1")[row]) + "," + std::to_string(column(table, stem + "2")[row]);
  };
  const ProgramResult said =
      run_program({"dynamics", "models/rr.urdf", "--q", pair("q"), "--qd", pair("qd"), "--tau", pair("tau"), "--json"});
  ASSERT_EQ(said.status, 0) << said.err;
  const Json json = Json::parse(said.out);
  // Six decimals of the state that was handed on, through forces of some 20 N per rad.
  EXPECT_NEAR(json["qdd"][0].get<double>(), column(table, "qdd1")[row], 1e-3);
  EXPECT_NEAR(json["qdd"][1].get<double>(), column(table, "qdd2")[row], 1e-3);
  EXPECT_NEAR(json["x"][0].get<double>(), column(table, "x_G")[row], 1e-5);
  EXPECT_NEAR(json["xd"][1].get<double>(), column(table, "yd_G")[row], 1e-4);
  EXPECT_GT(std::abs(column(table, "qdd1")[row]), 0.1);  // negative control: something moves
}

TEST(SimulateColumns, GiveFramesOfAllLinksAndTheEndEffectorAmongThem) {
  const Table table = table_of("assets/scenes/rr_free.yaml", {"--columns", "t,x_G,y_G,z_G,frames"});
  for (const char* axis : {"x", "y", "z"})
    EXPECT_EQ(column(table, std::string(axis) + "_G"), column(table, std::string("gripper.") + axis));
}

TEST(SimulateColumns, GiveInstantsAsDecimalsWhereTheyAre) {
  // Sums of steps of 0.1 s: 0.30000000000000004, 0.7999999999999999.
  const Table table = table_of("assets/scenes/rr_free.yaml", {"--every-step", "--columns", "t", "--set", "method=rk4", "--set", "step=0.1",
                                                              "--set", "duration=1"});
  EXPECT_EQ(table.columns[0], (std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1}));
  // A third of a second is none, and keeps all its digits.
  const Table thirds = table_of("assets/scenes/rr_free.yaml", {"--columns", "t", "--set", "video.fps=3", "--set", "duration=1"});
  EXPECT_EQ(thirds.columns[0][1], 1.0 / 3);
}

TEST(SimulateColumns, ThatARunDoesNotHaveAreRefused) {
  const auto refused = [](const std::string& scene, const std::string& columns, const std::string& why) {
    const ProgramResult result = simulate(scene, {"-o", "-", "--columns", columns});
    EXPECT_EQ(result.status, 2) << columns;
    EXPECT_EQ(result.out, "") << columns;
    EXPECT_THAT(result.err, HasSubstr(why)) << columns;
  };
  refused("assets/scenes/rr_free.yaml", "t,lambda", "no constraints");
  refused("assets/scenes/rr_free.yaml", "t,taus", "did you mean 'tau'");
  refused("assets/scenes/rr_free.yaml", "t,q,t", "names t twice");
  refused("assets/scenes/rr_free.yaml", "", "is empty");
  refused("assets/scenes/rr_free.yaml", "t,,q", "must be");
  const TemporaryFolder folder;
  refused(two_arms(folder), "t,x_G", "end_effector=NAME");
}

TEST(SimulateColumns, OfAFloatingBaseHaveUnitsAndNames) {
  const TemporaryFolder folder;
  const ProgramResult made = simulate(two_arms(folder), {"-o", "-", "--base", "floating", "--columns", "q,qd,tau"});
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string head = made.out.substr(0, made.out.find('\n'));
  for (const char* name : {".x [m],", ".qw,", ".vx [m/s],", ".wz [rad/s],", ".wz [N m],", ".vx [N],"}) EXPECT_THAT(head, HasSubstr(name));
  const auto commas = std::count(head.begin(), head.end(), ',');
  EXPECT_EQ(commas, 9 + 8 + 8 - 1);
}

TEST(RenderTables, AreWrittenForNumPyToo) {
  const TemporaryFolder folder;
  const Words small{"--set", "video.width=64", "--set", "video.height=36"};
  ASSERT_EQ(run_program(with(with({"render", "assets/scenes/pp_free.yaml", "-o", folder.file("a.npz"), "-o", folder.file("a.gif")},
                                  kHalfSecond), small)).status, 0);
  const ProgramResult read = run_command({"/usr/bin/python3", "-c", "import numpy, sys; print(numpy.load(sys.argv[1])['q'].shape)", folder.file("a.npz")});
  EXPECT_EQ(read.out, "(31, 2)\n") << read.err;  // 30 frames and the end
}

// A table that says its units is taken at its word, or refused.
TEST(TablesThatAreRead, AreTakenInTheUnitsThatTheyName) {
  const TemporaryFolder folder;
  const auto torque = [&](const std::string& table) {
    const ProgramResult made = run_program({"inverse", "models/rr.urdf", "--trajectory", folder.write("q.csv", table), "-o", "-"});
    return made.status == 0 ? made.out : "status " + std::to_string(made.status) + ": " + made.err;
  };
  const std::string expected = torque("t,q1,q2\n0,0,0.5\n1,0,0.5\n");
  EXPECT_THAT(expected, testing::StartsWith("t [s],tau1"));
  EXPECT_EQ(torque("t [s],q1 [rad],q2 [rad]\n0,0,0.5\n1,0,0.5\n"), expected);
  EXPECT_EQ(torque("t [ms],q1 [rad],q2\n0,0,0.5\n1000,0,0.5\n"), expected);
  const std::string right_angle = torque("t,q1,q2\n0,1.5707963267948966,0\n1,1.5707963267948966,0\n");
  EXPECT_EQ(torque("t,q1 [deg],q2 [deg]\n0,90,0\n1,90,0\n"), right_angle);
  EXPECT_NE(right_angle, expected);
  for (const char* unit : {"grad", "rad/min", "deg/", ""})
    EXPECT_THAT(torque("t,q1 [" + std::string(unit) + "],q2\n0,0,0.5\n1,0,0.5\n"),
                *unit == '\0' ? testing::StartsWith("t [s]") : testing::StartsWith("status 3"))
        << unit;
  // Two tables of other units are not equal, though their numbers are.
  const std::string a = folder.write("a.csv", "t,q1 [rad]\n0,0\n1,1\n"), b = folder.write("b.csv", "t,q1 [deg]\n0,0\n1,1\n");
  EXPECT_EQ(run_program({"compare", a, a}).status, 0);
  const ProgramResult compared = run_program({"compare", a, b});
  EXPECT_EQ(compared.status, 1) << compared.out;
  EXPECT_THAT(compared.out, HasSubstr("units"));
}

// The shell gives it: run_program's own input is empty.
ProgramResult with_input(const std::string& text, const std::string& words, const TemporaryFolder& folder) {
  const std::string file = folder.write("input.txt", text);
  return run_command({"sh", "-c", "cd \"$2\" && \"$0\" " + words + " < \"$1\"", program_path(), file, folder.path().string()});
}

TEST(StandardInput, HoldsASceneForAllThatTakeOne) {
  const TemporaryFolder folder;
  const std::string scene =
      "model: {links: [1, 1]}\nduration: 0.2\nmethod: rk4\nstep: 0.01\ntorque: [0, 0]\nvideo: {width: 64, height: 36}\n";
  folder.write("a.yaml", scene);
  for (const std::string words : {"simulate - --json -o -.csv", "check - --json", "dynamics - --json --at 0.1", "equations - --json"}) {
    const ProgramResult of_input = with_input(scene, words, folder);
    EXPECT_EQ(of_input.status, 0) << words << of_input.err;
    EXPECT_FALSE(parse_json(of_input.out).is_discarded()) << words;
  }
  for (const std::string words : {"render -", "snapshot - --width 64 --height 36", "energy - --methods rk4", "sweep - --over duration=0.1,0.2"})
    EXPECT_EQ(with_input(scene, words + " --quiet", folder).status, 0) << words;
  for (const char* file : {"out/stdin.mp4", "out/stdin.png", "out/stdin_energy.csv", "out/stdin_sweep.csv"})
    EXPECT_TRUE(fs::exists(folder.path() / file)) << file;
  // The same motion as from a file.
  const ProgramResult of_file = with_input("", "simulate a.yaml -o -", folder);
  EXPECT_EQ(with_input(scene, "simulate - -o -", folder).out, of_file.out);
}

TEST(StandardInput, ThatIsNoSceneSaysSoByItsName) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, int status, const std::string& why) {
    const ProgramResult result = with_input(text, "check -", folder);
    EXPECT_EQ(result.status, status) << why;
    EXPECT_THAT(result.err, HasSubstr(why));
  };
  refused("", 3, "stdin: holds no scene");
  refused("model: {links: [1]}\ntorque: [0]\nduraton: 3\n", 3, "stdin:3:1");
  refused(std::string(std::size_t(2) << 20, '#'), 7, "larger than 1 MiB");
  refused(std::string("\xff\xfe\0\0", 4), 3, "stdin");
  const ProgramResult closed = run_command({"sh", "-c", "\"$0\" check - <&-", program_path()});
  EXPECT_EQ(closed.status, 3);
  EXPECT_THAT(closed.err, HasSubstr("stdin: cannot be read"));
}

// What a sweep goes on with is of the same scene, also where that has no file.
TEST(StandardInput, OfAnotherSceneIsAnotherSweep) {
  const TemporaryFolder folder;
  const auto sweep = [&](const std::string& torque) {
    const ProgramResult made = with_input("model: {links: [1]}\nduration: 0.1\nmethod: rk4\nstep: 0.01\ntorque: [" + torque + "]\n",
                                          "sweep - --over start.q.1=0,1 --set start.q=[0] -o out/a.csv --json", folder);
    EXPECT_EQ(made.status, 0) << made.err;
    return read_whole_file((folder.path() / "out/a.csv").string());
  };
  EXPECT_NE(sweep("0"), sweep("9"));
}

TEST(SnapshotNumbers, GoWithSeveralFilesOfOnePicture) {
  const TemporaryFolder folder;
  const Words words{"snapshot", "assets/scenes/rr_torque.yaml", "--at", "0.5", "--width", "64", "--height", "36"};
  const ProgramResult both = run_program(with(words, {"-o", folder.file("a.svg"), "-o", folder.file("b.png"), "--json"}));
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_EQ(Json::parse(both.out)["files"], Json({folder.file("a.svg"), folder.file("b.png")}));
  EXPECT_EQ(Json::parse(both.out)["pictures"].size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(folder.file("a.svg")) && std::filesystem::exists(folder.file("b.png")));
  const ProgramResult mixed = run_program(with(words, {"-o", folder.file("c.svg"), "-o", folder.file("d/")}));
  EXPECT_EQ(mixed.status, 2);
  EXPECT_THAT(mixed.err, HasSubstr("several -o name files of one picture"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("c.svg")));
}

TEST(MotionTables, TellTheUnitsOfMultipliers) {
  const TemporaryFolder folder;
  const auto head = [&](const std::string& constraints) {
    const std::string scene = folder.write("a.yaml", "model: pp.urdf\nduration: 0.1\nmethod: rk4\nconstraints:\n" + constraints);
    const ProgramResult run = run_program({"simulate", scene, "--columns", "t,lambda", "-o", "-", "--quiet"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out.substr(0, run.out.find('\n'));
  };
  EXPECT_EQ(head("  - {line: {frame: gripper, point: [0, 0], direction: [1, 0]}}\n"), "t [s],lambda1 [N]");
  EXPECT_EQ(head("  - {joint: {name: joint1, value: 0}}\n"), "t [s],lambda1 [N]") << "a slider";
  const std::string turning = folder.write("b.yaml", "model: rr.urdf\nduration: 0.1\nmethod: rk4\nconstraints: [{joint: {name: joint2, value: 0}}]\n");
  EXPECT_THAT(run_program({"simulate", turning, "--columns", "lambda", "-o", "-", "--quiet"}).out, testing::StartsWith("lambda1 [N m]\n"));
}

TEST(SnapshotNumbers, AreThoseOfDynamicsAtThatInstant) {
  const TemporaryFolder folder;
  const ProgramResult shot = run_program({"snapshot", "assets/scenes/rr_torque.yaml", "--at", "0.5", "--width", "64", "--height", "36", "-o",
                                          folder.file("a.svg"), "--json"});
  ASSERT_EQ(shot.status, 0) << shot.err;
  const Json shown = Json::parse(shot.out)["pictures"][0]["panels"][0];
  const Json state = Json::parse(run_program({"dynamics", "assets/scenes/rr_torque.yaml", "--at", "0.5", "--json"}).out);
  EXPECT_EQ(shown["t"], 0.5);
  for (const char* key : {"q", "qd", "tau", "kinetic", "potential"}) EXPECT_EQ(shown[key], state[key]) << key;
  EXPECT_EQ(shown["end_effector"]["x"], state["x"]);
  EXPECT_EQ(shown["end_effector"]["xd"], state["xd"]);
}

// Between steps of symplectic Euler the energy is what it is at them: its velocities are no rates of its places, and one path
// through both would swing by as much as the method errs.
TEST(Tables, BetweenCrudeStepsTheEnergyIsThatOfTheSteps) {
  const TemporaryFolder folder;
  const auto energies = [&](const char* fps) {
    const std::string file = folder.file("e.csv");
    EXPECT_EQ(run_program({"simulate", "rr_free", "--set", "method=symplectic_euler", "--set", "step=0.01", "--set", "duration=2", "--set",
                           std::string("video.fps=") + fps, "--columns", "t,energy", "-o", file, "--force", "--quiet"}).status, 0);
    std::istringstream lines(read_whole_file(file));
    std::vector<double> all;
    for (std::string line; std::getline(lines, line);)
      if (std::isdigit(static_cast<unsigned char>(line[0]))) all.push_back(std::stod(line.substr(line.rfind(',') + 1)));
    return all;
  };
  const std::vector<double> on_steps = energies("100"), between = energies("300");
  ASSERT_EQ(between.size(), 3 * (on_steps.size() - 1) + 1);
  double range = 0;
  for (const double one : on_steps) range = std::max(range, std::fabs(one - on_steps[0]));
  ASSERT_GT(range, 0.1) << "negative control: a crude method errs";
  for (std::size_t k = 0; k + 1 < on_steps.size(); ++k)
    for (std::size_t i = 0; i <= 3; ++i) {
      // The cubics are off by O(h^2), a tenth of the method's O(h).
      EXPECT_GT(between[3 * k + i], std::min(on_steps[k], on_steps[k + 1]) - 0.1 * range) << k;
      EXPECT_LT(between[3 * k + i], std::max(on_steps[k], on_steps[k + 1]) + 0.1 * range) << k;
    }
}

}  // namespace
}  // namespace chainreel
