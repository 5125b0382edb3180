// A scene over a grid of its keys.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/hash.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kSweptScene = "assets/scenes/rr_free.yaml";
const Words kGrid{"--over", "start.q.1=0:1.5:4", "--over", "gravity.2=-9.81,-1.62", "--set", "duration=0.3"};

ProgramResult sweep(const std::string& output, const Words& more = kGrid, const RunOptions& options = {}) {
  return run_program(with({"sweep", kSweptScene, "-o", output}, more), options);
}

// But for a last one that is the hash of all above it.
std::vector<std::string> lines_of(const std::string& path) {
  std::istringstream stream(read_whole_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  if (!lines.empty() && lines.back().starts_with("# sha256: ")) lines.pop_back();
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

// As many lines of facts as its help tells numpy to skip, which takes a first `#` line for the names.
TEST(SweepTable, HasItsNamesBehindThreeLinesOfFacts) {
  const TemporaryFolder folder;
  ASSERT_EQ(sweep(folder.file("a.csv")).status, 0);
  const std::vector<std::string> lines = lines_of(folder.file("a.csv"));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(lines.at(k)[0], '#');
  EXPECT_TRUE(lines.at(3).starts_with("run,start.q.1,"));
  EXPECT_THAT(run_program({"sweep", "--help"}).out, HasSubstr("skip_header=3"));
}

// An oscillator without damping passes zero at t = pi / 2 w, 3 pi / 2 w, .. downwards every period: first, last and number by the closed form.
TEST(SweepTable, HasTheFirstAndTheLastOfEachEventAndHowOften) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [1], masses: [1], joints: P}\ngravity: [0, 0, 0]\nstart: {q: [1]}\ntorque: [-k * q1]\nparameters: {k: 1}\n"
                                                   "events: [{when: q1 < 0, name: left}, {when: q1 > 5, name: far}]\nduration: 10\nmethod: dop853\ntolerance: 1e-11\n");
  const ProgramResult result = run_program({"sweep", scene, "--over", "parameters.k=1,4,0.01", "-o", folder.file("e.csv")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, testing::HasSubstr("in 2 of 3 rows an event happens more than once"));
  const std::vector<std::string> lines = lines_of(folder.file("e.csv"));
  EXPECT_THAT(lines[3], testing::HasSubstr(",\"left [s]\",\"last_left [s]\",\"times_left\",\"holds_left\",\"far [s]\",\"last_far [s]\",\"times_far\",\"holds_far\",trouble"));
  const std::vector<std::string> names = fields_of(lines[3]);
  const auto at = std::size_t(std::ranges::find(names, "\"left [s]\"") - names.begin());
  const double pi = 3.14159265358979312;
  for (const auto& [row, w] : {std::pair{0, 1.0}, {1, 2.0}, {2, 0.1}}) {
    const std::vector<std::string> cells = fields_of(lines[std::size_t(4 + row)]);
    const int times = w * 10 < pi / 2 ? 0 : 1 + int((w * 10 - pi / 2) / (2 * pi));
    EXPECT_EQ(cells.at(at + 2), std::to_string(times)) << w;
    EXPECT_EQ(cells.at(at + 3), std::cos(w * 10) < 0 ? "1" : "0") << w;
    EXPECT_EQ(cells.at(at + 6), "0");
    EXPECT_EQ(cells.at(at + 7), "0");
    if (times == 0) {
      EXPECT_EQ(cells.at(at) + cells.at(at + 1), "");
      continue;
    }
    EXPECT_NEAR(std::stod(cells.at(at)), pi / 2 / w, 1e-8) << w;
    EXPECT_NEAR(std::stod(cells.at(at + 1)), (pi / 2 + 2 * pi * (times - 1)) / w, 1e-8) << w;
  }
  EXPECT_EQ(run_program({"sweep", scene, "--over", "parameters.k=1:4:3", "--map", "last_left", "-o", folder.file("m.svg")}).status, 0);
}

// The whole says what its parts said, and each reason is one.
TEST(SweepTable, JoinedTellsWhatFailed) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [0.5], masses: [1], efforts: 20}\nduration: 0.2\nmethod: rk4\ntorque: [19]\nexpect: within_limits\n");
  for (const char* shard : {"1/2", "2/2"}) EXPECT_EQ(run_program({"sweep", scene, "--over", "torque.1=19,18,21", "--shard", shard, "-o", folder.file("p.csv")}).status, shard[0] == '1' ? 0 : 7);
  Words join{"join", "-o", folder.file("all.csv")};
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().filename().string().starts_with("p.") && entry.path().extension() == ".csv") join.push_back(entry.path().string());
  ASSERT_EQ(join.size(), 5u);
  const ProgramResult joined = run_program(join);
  EXPECT_EQ(joined.status, 7);
  EXPECT_THAT(joined.err, testing::AllOf(HasSubstr("1 of the runs failed, first at run 2: "), HasSubstr("effort limit 20")));
  EXPECT_EQ(lines_of(folder.file("all.csv")).size(), 4u + 3);
  const ProgramResult calm = run_program({"sweep", scene, "--over", "torque.1=1,2", "--set", "expect=diverge", "-o", folder.file("d.csv")});
  EXPECT_EQ(calm.status, 5);
  EXPECT_THAT(calm.err, HasSubstr("torque.1=1: was expected to diverge, but finished"));
  const ProgramResult passing = run_program({"sweep", scene, "--over", "torque.1=21,22", "--set", "expect=diverge", "-o", folder.file("p2.csv")});
  EXPECT_EQ(passing.status, 5) << "limits are not what it failed for";
  EXPECT_THAT(passing.err, HasSubstr("was expected to diverge, but finished; limits: "));
  const ProgramResult twins = run_program({"sweep", scene, "--over", "torque.1=1,2", "--set", "events=[{when: q1, name: zero}, {when: \"q1 < -0.9\", name: last_zero}]", "-o", folder.file("t.csv")});
  EXPECT_EQ(twins.status, 3);
  EXPECT_THAT(twins.err, HasSubstr("two columns of the table would be called last_zero [s]"));
}

TEST(SweepTable, RowsAreTheLastOfTheRunsByThemselves) {
  const TemporaryFolder folder;
  ASSERT_EQ(sweep(folder.file("a.csv")).status, 0);
  const std::vector<std::string> lines = lines_of(folder.file("a.csv"));
  ASSERT_EQ(lines.size(), 4u + 8u);
  EXPECT_EQ(lines[3], "run,start.q.1,gravity.2,good,status,end_time [s],ended_by,q1 [rad],q2 [rad],qd1 [rad/s],qd2 [rad/s],energy [J],trouble");
  // The last axis goes on first: run 3 is of the second start and the second gravity.
  const std::vector<std::string> row = fields_of(lines[4 + 3]);
  EXPECT_EQ(row[1], "0.5");
  EXPECT_EQ(row[2], "-1.62");
  ASSERT_EQ(run_program({"simulate", kSweptScene, "--quiet", "--set", "duration=0.3", "--set", "start.q.1=0.5", "--set",
                         "gravity.2=-1.62", "-o", folder.file("one.csv")})
                .status,
            0);
  const std::vector<std::string> alone = fields_of(lines_of(folder.file("one.csv")).back());
  EXPECT_EQ(std::vector<std::string>(row.begin() + 7, row.begin() + 11), std::vector<std::string>(alone.begin() + 1, alone.begin() + 5));
  const std::vector<std::string> names = fields_of(lines_of(folder.file("one.csv")).front());
  const auto energy = std::find(names.begin(), names.end(), "energy [J]");
  ASSERT_NE(energy, names.end());
  EXPECT_EQ(row[11], alone[std::size_t(energy - names.begin())]);
}

// The value of an expression at the end of each run, as a column and as a map.
TEST(SweepTable, HasExpressionsAtTheEnd) {
  const TemporaryFolder folder;
  const std::string distance = "sqrt(x_G^2 + max(y_G, -9)^2)";
  ASSERT_EQ(sweep(folder.file("a.csv"), with(kGrid, {"--last", "q1 - 2 * q2", "--last", distance, "--peaks", "qd2"})).status, 0);
  const std::vector<std::string> lines = lines_of(folder.file("a.csv"));
  EXPECT_THAT(lines[3], HasSubstr(",energy [J],peak_qd2 [rad/s],q1 - 2 * q2,\"" + distance + "\",trouble"));
  for (std::size_t run = 4; run < lines.size(); ++run) {
    const std::vector<std::string> row = fields_of(lines[run]);
    EXPECT_DOUBLE_EQ(std::stod(row[13]), std::stod(row[7]) - 2 * std::stod(row[8]));
    // Of rr.urdf, whose links are 1 m: the law of cosines.
    EXPECT_NEAR(std::stod(row[14]), std::sqrt(2 + 2 * std::cos(std::stod(row[8]))), 1e-12);
  }
  const Words grid{"--over", "start.q.1=0:1.5:4", "--over", "start.q.2=0:1:3", "--set", "duration=0.3"};
  EXPECT_EQ(sweep(folder.file("b.png"), with(grid, {"--last", "x_G"})).status, 0) << "its only column besides";
  EXPECT_EQ(sweep(folder.file("c.png"), with(grid, {"--last", "x_G", "--peaks", "qd1", "--map", "x_G"})).status, 0);
  EXPECT_THAT(sweep(folder.file("d.png"), with(grid, {"--map", "x_G"})).err, HasSubstr("--last adds the value of an expression"));
  EXPECT_THAT(sweep(folder.file("e.csv"), with(grid, {"--last", "x_H"})).err, HasSubstr("--last 'x_H': unknown name"));
  EXPECT_THAT(sweep(folder.file("e.csv"), with(grid, {"--last", "energy"})).err, HasSubstr("write an expression"));
  EXPECT_FALSE(fs::exists(folder.file("e.csv")));
}

// However values are written, columns hold SI units and radians.
TEST(SweepTable, ColumnsOfValuesAreNumbers) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"sweep", kSweptScene, "--set", "duration=0.1", "--over", "start.q.1=10deg,pi/2", "--over", "step=1ms,2ms", "--set",
                         "method=rk4", "-o", folder.file("a.csv")})
                .status,
            0);
  const std::vector<std::string> lines = lines_of(folder.file("a.csv"));
  EXPECT_EQ(fields_of(lines[4])[1], "0.17453292519943295");
  EXPECT_EQ(fields_of(lines[4])[2], "0.001");
  EXPECT_EQ(fields_of(lines[7])[1], "1.5707963267948966");
  EXPECT_EQ(fields_of(lines[7])[2], "0.002");
}

TEST(SweepTable, WordsStayWords) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"sweep", kSweptScene, "--set", "duration=0.1", "--over", "title=1e3,10ms,007", "--over", "accuracy=0.1 px,0.1 m", "--set",
                         "method=auto", "--set", "step=", "-o", folder.file("a.csv")})
                .status,
            0);
  const std::vector<std::string> lines = lines_of(folder.file("a.csv"));
  EXPECT_EQ(fields_of(lines[4])[1], "1e3");
  EXPECT_EQ(fields_of(lines[4])[2], "0.1 px");
  EXPECT_EQ(fields_of(lines[9])[1], "007");
  EXPECT_EQ(fields_of(lines[9])[2], "0.1 m");
}

TEST(SweepTable, AnEventCalledLikeAColumnHasAKeyOfItsOwn) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("e.yaml", "model: {links: [1]}\nstart: {q: [1]}\nduration: 1\nmethod: rk4\nstep: 0.01\nevents: [{when: q1, name: energy}]\n");
  ASSERT_EQ(run_program({"sweep", scene, "--over", "start.q.1=1,2", "-o", folder.file("a.json")}).status, 0);
  const Json json = Json::parse(read_whole_file(folder.file("a.json")));
  EXPECT_EQ(json["energy"].size(), 2u);
  ASSERT_TRUE(json.contains("energy [s]")) << json;
  EXPECT_NE(json["energy"], json["energy [s]"]);
}

// Held against the same run at each of its steps, between which a peak is higher by h^2 |x''| / 8.
TEST(SweepTable, OfSeveralKindsIsTheSameTableComputedOnce) {
  const TemporaryFolder folder;
  const std::string json = folder.file("a.json"), csv = folder.file("a.csv"), npz = folder.file("a.npz");
  ASSERT_EQ(sweep(json, with(kGrid, {"-o", csv, "-o", npz})).status, 0);
  for (const std::string& one : {json, csv, npz}) {
    const std::string alone = folder.file("alone" + fs::path(one).extension().string());
    ASSERT_EQ(sweep(alone).status, 0);
    EXPECT_EQ(read_whole_file(one), read_whole_file(alone)) << one;
  }
  // One that is there is not written over, and then no other is begun.
  fs::remove(csv), fs::remove(npz);
  const ProgramResult refused = sweep(csv, with(kGrid, {"-o", npz, "-o", json}));
  EXPECT_EQ(refused.status, 6);
  EXPECT_THAT(refused.err, HasSubstr("a.json"));
  EXPECT_FALSE(fs::exists(csv));
  EXPECT_FALSE(fs::exists(npz));
  // Without a .csv among them, too; what is named twice is refused.
  fs::remove(json);
  ASSERT_EQ(sweep(npz, with(kGrid, {"-o", json})).status, 0);
  EXPECT_EQ(read_whole_file(npz), read_whole_file(folder.file("alone.npz")));
  EXPECT_EQ(read_whole_file(json), read_whole_file(folder.file("alone.json")));
  EXPECT_EQ(sweep(csv, with(kGrid, {"-o", csv})).status, 2);
  EXPECT_EQ(sweep(csv, with(kGrid, {"-o", folder.file("b.csv"), "--shard", "1/2"})).status, 2);
}

// Which run has the largest peak, also where rows were done before, and which runs pass limits of their joints.
TEST(SweepTable, SaysWhereItsPeaksAreLargestAndWhoPassesLimits) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("arm.yaml", "model: {links: [0.5, 0.4], masses: [2, 1], efforts: 3}\nduration: 0.5\nmethod: rk4\nstep: 0.01\n"
                                                     "parameters: {F: 1}\ntorque: [F, 0]\n");
  const std::string csv = folder.file("a.csv");
  const auto swept = [&](const Words& more = {}) {
    return run_program(with({"sweep", scene, "-o", csv, "--over", "parameters.F=1,-4,2", "--over", "start.q.2=0,\"90deg\"", "--peaks", "tau"}, more));
  };
  const ProgramResult first = swept();
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, AllOf(HasSubstr("largest tau1 [N m]: -4, in run 2: "), HasSubstr("parameters.F=-4")));
  EXPECT_THAT(first.err, HasSubstr("2 of 6 rows pass limits of joints"));
  const std::vector<std::string> lines = lines_of(csv);
  for (std::size_t run = 0; run < 6; ++run)
    EXPECT_EQ(lines[4 + run].find("limits: joint 'joint1' passed its effort limit 3 with") != std::string::npos, run == 2 || run == 3) << lines[4 + run];
  EXPECT_THAT(swept().out, AllOf(HasSubstr("6 of them done before"), HasSubstr("largest tau1 [N m]: -4, in run 2: ")));
  const Json told = parse_json(swept({"--json"}).out)["outputs"][0]["largest"];
  EXPECT_EQ(told[0]["value"], -4.0);
  EXPECT_EQ(told[0]["run"], 2);
}

// Where no run has a larger peak than the others, none is named.
TEST(SweepTable, SaysThatPeaksAreTheSameInAllRuns) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"sweep", "rr_torque", "--set", "duration=0.2", "--set", "torque=[3, 1]", "--over", "start.q.1=0,0.5", "--peaks", "tau,qd", "-o",
                                            folder.file("a.csv")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("tau1 [N m]: 3, the same in all runs"));
  EXPECT_THAT(result.out, testing::ContainsRegex("qd1 .*, in run "));
}

TEST(SweepTable, HasThePeaksOfTheRunsByThemselves) {
  const TemporaryFolder folder;
  const Words set{"--set", "duration=1", "--set", "torque=[0.5 * sin(7 * t), -0.2]", "--set", "method=rk4", "--set", "step=0.1ms"};
  ASSERT_EQ(sweep(folder.file("a.csv"), with({"--over", "start.q.1=0,1", "--peaks", "qd,tau,energy_error"}, set)).status, 0);
  const std::vector<std::string> lines = lines_of(folder.file("a.csv"));
  EXPECT_TRUE(lines[3].ends_with("qd2 [rad/s],energy [J],peak_qd1 [rad/s],peak_qd2 [rad/s],peak_tau1 [N m],peak_tau2 [N m],peak_energy_error [J],trouble"));
  for (const std::size_t run : {0, 1}) {
    ASSERT_EQ(run_program(with({"simulate", kSweptScene, "--quiet", "--every-step", "--columns", "t,qd,tau,energy_error", "--force", "--set",
                                "start.q.1=" + std::to_string(run), "-o", folder.file("one.csv")},
                               set))
                  .status,
              0);
    std::vector<double> largest(5);
    const std::vector<std::string> rows = lines_of(folder.file("one.csv"));
    for (std::size_t row = 1; row < rows.size(); ++row) {
      const std::vector<std::string> fields = fields_of(rows[row]);
      for (std::size_t i = 0; i < 5; ++i)
        if (const double value = std::stod(fields[i + 1]); std::abs(value) > std::abs(largest[i])) largest[i] = value;
    }
    const std::vector<std::string> fields = fields_of(lines[4 + run]);
    const std::size_t first = fields_of(lines[3]).size() - 6;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(std::stod(fields[first + i]), largest[i], 3e-7 * std::abs(largest[i])) << run << " " << i;
    EXPECT_GE(std::abs(std::stod(fields[first + 4])), std::abs(largest[4])) << "between the steps that of dense output is added";
    EXPECT_LT(std::abs(std::stod(fields[first + 4])), 1e-9) << "J: of a tolerance of 1e-10";
  }
  // A table with others is another one; of t there is no peak, and pictures have none.
  EXPECT_EQ(sweep(folder.file("a.csv"), with({"--over", "start.q.1=0,1", "--peaks", "qd"}, set)).status, 6);
  EXPECT_THAT(sweep(folder.file("b.csv"), with(kGrid, {"--peaks", "t"})).err, HasSubstr("t has no peak"));
  EXPECT_EQ(sweep(folder.file("b.csv"), with(kGrid, {"--peaks", "lambda"})).status, 2);
  EXPECT_EQ(sweep(folder.file("b/"), with(kGrid, {"--peaks", "qd"})).status, 2);
}

// A pulse of a millisecond in a run of two seconds, whose top is 3 sin(5 t) + H but for rounding.
TEST(SweepTable, FindsThePeakOfANarrowPulse) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("p.yaml",
                                         "model: rr.urdf\nduration: 2\nmethod: dop853\nparameters: {H: 5, w: 1e-3, c: 0.76543}\n"
                                         "torque: [3 * sin(5 * t) + H * exp(-((t - c) / w)^2), 0]\n");
  ASSERT_EQ(run_program({"sweep", scene, "-o", folder.file("a.csv"), "--over", "parameters.w=1e-3,5e-4", "--over", "parameters.c=0.3:1.7:8",
                         "--peaks", "tau"})
                .status,
            0);
  const std::vector<std::string> lines = lines_of(folder.file("a.csv"));
  const std::vector<std::string> names = fields_of(lines[3]);
  const auto at = std::size_t(std::find(names.begin(), names.end(), "peak_tau1 [N m]") - names.begin());
  for (std::size_t row = 4; row < lines.size(); ++row) {
    const std::vector<std::string> fields = fields_of(lines[row]);
    const double pulse = 3 * std::sin(5 * std::stod(fields[2])) + 5;
    EXPECT_NEAR(std::abs(std::stod(fields[at])), std::max(3.0, pulse), 1e-3) << lines[row];
  }
}

TEST(SweepTable, ManyThreadsSharesAndRepeatsGiveTheSameBytes) {
  const TemporaryFolder folder;
  ASSERT_EQ(sweep(folder.file("one.csv"), with(kGrid, {"--jobs", "1"})).status, 0);
  ASSERT_EQ(sweep(folder.file("many.csv"), with(kGrid, {"--jobs", "8"})).status, 0);
  const std::string whole = read_whole_file(folder.file("one.csv"));
  EXPECT_EQ(read_whole_file(folder.file("many.csv")), whole);
  Words join{"join"};
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    ASSERT_EQ(sweep(folder.file("s.csv"), with(kGrid, {"--shard", shard})).status, 0);
    join.push_back(folder.file(std::string("s.part-") + shard[0] + "-of-3.csv"));
  }
  ASSERT_EQ(run_program(with(join, {"-o", folder.file("joined.csv")})).status, 0);
  EXPECT_EQ(read_whole_file(folder.file("joined.csv")), whole);
  // Parts that are missing, doubled or of another sweep are refused.
  EXPECT_THAT(run_program({"join", join[1], join[2], "-o", folder.file("x.csv")}).err, HasSubstr("before it are missing"));
  EXPECT_THAT(run_program({"join", join[2], "-o", folder.file("x.csv")}).err, HasSubstr("are missing"));
  EXPECT_THAT(run_program(with(join, {join[1], "-o", folder.file("x.csv")})).err, HasSubstr("in another part, too"));
  ASSERT_EQ(sweep(folder.file("t.csv"), with(kGrid, {"--shard", "1/3", "--set", "torque=[0, 1]"})).status, 0);
  EXPECT_THAT(run_program({"join", join[1], join[3], folder.file("t.part-1-of-3.csv"), "-o", folder.file("x.csv")}).err,
              HasSubstr("no part of the same sweep"));
  EXPECT_FALSE(fs::exists(folder.file("x.csv")));
}

// The hidden file of a run that was killed: the head of a table, rows with what tells that they are whole, and what it was writing.
std::string kept_rows(const std::string& head, const std::string& rows, const std::string& begun) {
  return head + rows + "# so far: " + sha256_of(rows) + "\n" + begun;
}

TEST(SweepTable, GoesOnBehindTheLastWholeRow) {
  const TemporaryFolder folder;
  ASSERT_EQ(sweep(folder.file("a.csv")).status, 0);
  const std::string whole = read_whole_file(folder.file("a.csv"));
  EXPECT_THAT(sweep(folder.file("a.csv")).out, HasSubstr("8 of them done before")) << "nothing is to be forced";
  // As a run leaves it that was killed within a row; those that are there are taken, which a forged one shows.
  const std::size_t first = whole.find("\n0,") + 1, sixth = whole.find("\n5,") + 1, forged = whole.find("\n1,");
  std::string rows = whole.substr(first, sixth - first);
  rows[whole.find("finished", forged) - first] = 'F';
  const std::string left = kept_rows(whole.substr(0, first), rows, whole.substr(sixth, 20));
  fs::remove(folder.file("a.csv"));
  folder.write(".a.csv.rows", left);
  ASSERT_EQ(sweep(folder.file("a.csv")).status, 0);
  std::string expected = whole;
  expected[expected.find("finished", forged)] = 'F';
  const auto without_hash = [](const std::string& table) { return table.substr(0, table.rfind("# sha256")); };
  EXPECT_EQ(without_hash(read_whole_file(folder.file("a.csv"))), without_hash(expected));
  // Rows of another sweep are not, nor is a table of another one replaced.
  const Words other = with(kGrid, {"--set", "torque=[0, 1]"});
  EXPECT_EQ(sweep(folder.file("a.csv"), other).status, 6);
  folder.write(".a.csv.rows", left);
  EXPECT_EQ(sweep(folder.file("a.csv"), with(other, {"--force"})).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("a.csv")), Not(HasSubstr("Finished")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2) << "the table and its record";
}

// As a disk leaves them that lost power, and as no killed run does.
TEST(SweepTable, TakesRowsOnlyUpToTheFirstThatIsNotItsOwn) {
  const TemporaryFolder folder;
  ASSERT_EQ(sweep(folder.file("a.csv")).status, 0);
  const std::string whole = read_whole_file(folder.file("a.csv"));
  const std::size_t first = whole.find("\n0,") + 1, third = whole.find("\n2,") + 1, fourth = whole.find("\n3,") + 1, fifth = whole.find("\n4,") + 1;
  const std::string head = whole.substr(0, first), rows = whole.substr(first, fifth - first), good = kept_rows(head, rows, "");
  std::string zeros = good, changed = good;
  zeros.replace(third + 4, 8, std::string(8, '\0'));
  changed[changed.find("finished", third)] = 'F';
  const std::string missing = whole.substr(first, third - first) + whole.substr(fourth, fifth - fourth);
  for (const std::string& left : {kept_rows(head, missing, ""), kept_rows(head, rows + missing, ""), zeros, changed, head + rows, good + "4,1\n# so far: 0\n", good}) {
    fs::remove(folder.file("a.csv"));
    folder.write(".a.csv.rows", left);
    ASSERT_EQ(sweep(folder.file("a.csv")).status, 0);
    EXPECT_EQ(read_whole_file(folder.file("a.csv")), whole);
  }
  folder.write("a.csv", whole.substr(0, third) + whole.substr(fourth) + whole.substr(whole.rfind("\n7,") + 1));
  EXPECT_EQ(sweep(folder.file("a.csv")).status, 6) << "a table of the right length that misses a run";
  // Rows are kept over nothing that is somebody's.
  folder.write(".b.csv.rows", "mine");
  const ProgramResult result = sweep(folder.file("b.csv"));
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.err, HasSubstr("this program did not write it"));
  EXPECT_EQ(read_whole_file(folder.file(".b.csv.rows")), "mine");
}

TEST(SweepTable, TakesValuesThatAreListsAndHoldNamesOfFiles) {
  const TemporaryFolder folder;
  folder.write("a.csv", "t,tau1,tau2\n0,1,2\n9,3,1\n");
  folder.write("b.csv", "t,tau1,tau2\n0,0,0\n9,0,0\n");
  folder.write("m.urdf", read_whole_file("models/rr.urdf"));
  const std::string scene = folder.write("s.yaml", "model: m.urdf\nmethod: rk4\nstep: 0.01\nduration: 0.1\n");
  const Words words{"sweep", scene, "--over", "torque={csv: a.csv},{csv: \"b.csv\"},[\"max(t, 1)\", 0],[0]", "-o", folder.file("t.csv")};
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.status, 5) << result.err;
  EXPECT_THAT(result.err, HasSubstr("1 of the runs failed, first at torque=[0]")) << "commas of a value are none of the row's";
  const std::vector<std::string> lines = lines_of(folder.file("t.csv"));
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_THAT(lines[4], HasSubstr("0,{csv: a.csv},1,finished"));
  EXPECT_THAT(lines[6], HasSubstr("2,\"[\"\"max(t, 1)\"\", 0]\",1,finished"));
  folder.write("b.csv", "t,tau1,tau2\n0,0,0\n9,0,8\n");
  EXPECT_EQ(run_program(words).status, 6) << "its rows are of another torque";
}

TEST(SweepTable, RunsThatFailAreRowsAndToldAtTheEnd) {
  const TemporaryFolder folder;
  const ProgramResult result =
      sweep(folder.file("a.csv"), {"--over", "step=0.001,-1,0.002", "--over", "model=../../models/rr.urdf,../../models/rrr.urdf", "--set",
                                   "duration=0.1", "--quiet"});
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.err, HasSubstr("4 of the runs failed, first at step=0.001 model=../../models/rrr.urdf"));
  const std::vector<std::string> lines = lines_of(folder.file("a.csv"));
  ASSERT_EQ(lines.size(), 4u + 6u);
  EXPECT_THAT(lines[4], HasSubstr(",1,finished,0.1"));
  EXPECT_THAT(lines[6], HasSubstr(",0,refused,,,,,,,,\"'step' must be above 0 s\""));
  for (std::size_t k = 4; k < lines.size(); ++k)
    EXPECT_EQ(std::count(lines[k].begin(), std::find(lines[k].begin(), lines[k].end(), '"'), ','),
              std::count(lines[3].begin(), lines[3].end(), ','))
        << lines[k];
}

// Whichever of the values it is.
TEST(SweepTable, ABadFirstValueIsARowLikeAnyOther) {
  const TemporaryFolder folder;
  const auto rows = [&](const std::string& values) {
    const ProgramResult result = sweep(folder.file("a.csv"), {"--over", "step=" + values, "--set", "duration=0.1", "--force", "--quiet"});
    EXPECT_EQ(result.status, 5) << result.err;
    std::vector<std::string> lines = lines_of(folder.file("a.csv"));
    lines.erase(lines.begin(), lines.begin() + 4);
    for (std::string& line : lines) line.erase(0, line.find(',') + 1);  // its number
    std::sort(lines.begin(), lines.end());
    return lines;
  };
  const std::vector<std::string> first = rows("-1,0.001,0.002"), last = rows("0.001,0.002,-1");
  EXPECT_EQ(first.size(), 3u);
  EXPECT_EQ(first, last);
  const std::string shared = folder.file("b.csv");
  for (const char* shard : {"1/3", "2/3", "3/3"})
    sweep(shared, {"--over", "step=-1,0.001,0.002", "--set", "duration=0.1", "--quiet", "--shard", shard});
  EXPECT_EQ(run_program({"join", folder.file("b.part-1-of-3.csv"), folder.file("b.part-2-of-3.csv"), folder.file("b.part-3-of-3.csv"),
                         "-o", shared}).status, 5) << "one failed, as the sweep says itself";
  rows("-1,0.001,0.002");
  EXPECT_EQ(read_whole_file(shared), read_whole_file(folder.file("a.csv")));
}

TEST(SweepTable, WhatNoValueMakesGoodIsOneErrorAtOnce) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& output, const Words& over) {
    const ProgramResult result = sweep(output, over);
    EXPECT_NE(result.status, 0);
    EXPECT_NE(result.status, 5) << "no run";
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.csv")));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    return result.err;
  };
  for (const std::string& output : {folder.file("a.csv"), folder.file("films/")}) {
    EXPECT_THAT(error(output, {"--over", "stepp=0:1:10000"}), HasSubstr("unknown key 'stepp'")) << output;
    EXPECT_THAT(error(output, {"--over", "start.q.7=0:1:1000"}), HasSubstr("no index from 1 to 2")) << output;
  }
  EXPECT_THAT(error(folder.file("a.csv"), {"--over", "step=-1,-2"}), HasSubstr("'step' must be above 0 s"));
  EXPECT_THAT(error(folder.file("a.csv"), {"--over", "step=0.01,0.02", "--set", "model=none.urdf"}), HasSubstr("none.urdf"));
}

TEST(SweepFolder, SkipsWhatShowsTheSameSceneAndNothingElse) {
  const TemporaryFolder folder;
  const Words small{"--over", "start.q.1=0,0.5", "--each", "mp4", "--each", "png", "--set", "video.width=64", "--set",
                    "video.height=36", "--set", "duration=0.1"};
  ASSERT_EQ(sweep(folder.file("films/"), small).status, 0);
  const std::string film = folder.file("films/rr_free_start.q.1_0.5.mp4");
  const std::string bytes = read_whole_file(film);
  ASSERT_EQ(run_program({"render", kSweptScene, "--quiet", "-o", folder.file("one.mp4"), "--set", "start.q.1=0.5", "--set",
                         "video.width=64", "--set", "video.height=36", "--set", "duration=0.1", "--set", "title=RR without torques: $q1(0)$ = 0.5"})
                .status,
            0);
  EXPECT_EQ(bytes, read_whole_file(folder.file("one.mp4"))) << "as a render by itself";
  EXPECT_TRUE(fs::exists(folder.file("films/rr_free_start.q.1_0.png")));
  const auto written = fs::last_write_time(film);
  fs::remove(folder.file("films/rr_free_start.q.1_0.mp4"));
  const ProgramResult again = sweep(folder.file("films/"), with(small, {"--force"}));
  EXPECT_THAT(again.out, HasSubstr("2 runs, 1 of them done before, 0 failed"));
  EXPECT_EQ(fs::last_write_time(film), written);
  EXPECT_TRUE(fs::exists(folder.file("films/rr_free_start.q.1_0.mp4")));
  // Of the same name, but of another scene.
  const Words other = with(small, {"--set", "torque=[1, 0]"});
  EXPECT_EQ(sweep(folder.file("films/"), other).status, 6);
  EXPECT_EQ(read_whole_file(film), bytes);
  EXPECT_THAT(sweep(folder.file("films/"), with(other, {"--force"})).out, HasSubstr("0 of them done before"));
  EXPECT_NE(read_whole_file(film), bytes);
}

const Words kSmallFilms{"--set", "video.width=64", "--set", "video.height=36", "--set", "duration=0.1"};

// What the scene's text does not tell: the instant of pictures, the model's and its tables' files, the audit beside.
TEST(SweepFolder, MakesAnewWhatShowsAnythingElse) {
  const TemporaryFolder folder;
  folder.write("m.urdf", read_whole_file("models/rr.urdf"));
  folder.write("tau.csv", "t,tau1,tau2\n0,1,0\n1,1,0\n");
  const std::string scene = folder.write("s.yaml", "model: m.urdf\nmethod: rk4\nstep: 0.01\ntorque: {csv: tau.csv}\nstart: {q: [0, 0]}\n");
  const auto made = [&](const Words& more) {
    const ProgramResult result =
        run_program(with(with({"sweep", scene, "--over", "start.q.1=0,1", "-o", folder.file("out/")}, kSmallFilms), more));
    return std::to_string(result.status) + " " + result.out + result.err;
  };
  const auto pictures = [&] { return read_whole_file(folder.file("out/s_start.q.1_0.png")); };
  const Words png{"--each", "png", "--each", "csv"};
  EXPECT_THAT(made(png), HasSubstr("0 of them done before"));
  EXPECT_THAT(made(png), HasSubstr("2 of them done before"));
  const std::string first = pictures();
  EXPECT_THAT(made(with(png, {"--at", "0.1"})), HasSubstr("0 of them done before"));
  EXPECT_NE(pictures(), first);
  EXPECT_THAT(made(png), HasSubstr("0 of them done before"));
  EXPECT_EQ(pictures(), first);
  folder.write("tau.csv", "t,tau1,tau2\n0,9,0\n1,9,0\n");
  EXPECT_THAT(made(png), HasSubstr("0 of them done before"));
  fs::remove(folder.file("out/s_start.q.1_1.json"));  // as one leaves it that was killed before
  EXPECT_THAT(made(png), HasSubstr("1 of them done before"));
  EXPECT_TRUE(fs::exists(folder.file("out/s_start.q.1_1.json")));
  EXPECT_THAT(made(with(png, {"--at", "5"})), HasSubstr("outside the duration"));
}

TEST(SweepFolder, MakesAnewWhatWasCutOffOrLostItsWords) {
  const TemporaryFolder folder;
  Words words{"--over", "start.q.1=0,1", "--set", "duration=0.2", "--set", "video.width=96", "--set", "video.height=54"};
  for (const char* kind : {"mp4", "mov", "webm", "png", "apng", "svg"}) words = with(words, {"--each", kind});
  const std::string runs = folder.file("runs/");
  ASSERT_EQ(sweep(runs, words).status, 0);
  for (const char* ending : {"mp4", "mov", "webm", "png", "apng", "svg", "txt"}) {
    const std::string path = runs + "rr_free_start.q.1_1." + ending, bytes = read_whole_file(path);
    if (std::string(ending) == "txt")
      fs::remove(path);
    else
      fs::resize_file(path, bytes.size() * 2 / 3);
    const ProgramResult result = sweep(runs, words);
    EXPECT_EQ(result.status, 0) << ending << result.err;
    EXPECT_THAT(result.out, HasSubstr("1 of them done before")) << ending;
    EXPECT_TRUE(read_whole_file(path) == bytes) << ending;
    EXPECT_THAT(sweep(runs, words).out, HasSubstr("2 of them done before")) << ending;
  }
  // Also what is too short to say what it is: its audit does.
  const std::string film = runs + "rr_free_start.q.1_1.mp4", bytes = read_whole_file(film);
  fs::resize_file(film, 200);
  const ProgramResult again = sweep(runs, words);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(read_whole_file(film) == bytes);
}

TEST(SweepFolder, MakesAnewWhatHasOtherBytesThanItsAuditSays) {
  const TemporaryFolder folder;
  const Words words{"--over", "start.q.1=0,1", "--set", "duration=0.2", "--set", "video.width=96", "--set", "video.height=54", "--each", "mp4", "--each", "png"};
  const std::string runs = folder.file("runs/"), film = runs + "rr_free_start.q.1_1.mp4";
  ASSERT_EQ(sweep(runs, words).status, 0);
  const std::string bytes = read_whole_file(film);
  for (int damages = 0; damages < 2; ++damages) {  // the second time, the audit is of files that were made at two times
    std::string damaged = bytes;
    const std::size_t picture = damaged.rfind("mdat") + 100;  // in what it remembers it would be another's film
    damaged[picture] = char(damaged[picture] ^ 8);
    std::ofstream(film, std::ios::binary) << damaged;
    EXPECT_THAT(sweep(runs, words).out, HasSubstr("1 of them done before")) << damages;
    EXPECT_TRUE(read_whole_file(film) == bytes);
    EXPECT_THAT(sweep(runs, words).out, HasSubstr("2 of them done before")) << damages;
  }
  const Json audit = Json::parse(read_whole_file(runs + "rr_free_start.q.1_1.json"));
  EXPECT_EQ(audit["outputs"].size(), 2u) << audit["outputs"].dump();
}

TEST(SweepFolder, SaysWhichRunIsDoubtful) {
  const TemporaryFolder folder;
  const ProgramResult result = sweep(folder.file("runs/"), {"--over", "start.q.1=0:1:7", "--each", "csv", "--set", "duration=0.2", "--set",
                                                            "method=explicit_euler", "--set", "step=0.01", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("WARNING: start.q.1=0")) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 6) << "five, and how many more: " << result.err;
  EXPECT_THAT(result.err, HasSubstr("2 more runs are as doubtful"));
}

TEST(SweepFolder, OfTwoAtOnceIsThatOfOne) {
  const TemporaryFolder folder;
  const std::string two = "\"$0\" \"$@\" & p=$!; \"$0\" \"$@\"; a=$?; wait $p; echo $a $?";
  const ProgramResult result = run_command(
      with({"sh", "-c", two, program_path(), "sweep", kSweptScene, "--over", "start.q.1=0:1:6", "-o", folder.file("films/"), "--each",
            "png", "--quiet"},
           kSmallFilms));
  EXPECT_EQ(result.out, "0 0\n") << result.err;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.file("films")), {}), 18);
}

TEST(SweepFolder, SharesKnowTheNamesOfTheOthers) {
  const TemporaryFolder folder;
  const ProgramResult result =
      sweep(folder.file("films/"), with(kSmallFilms, {"--over", "title=a/b,c,d,a_b", "--each", "png", "--shard", "1/2"}));
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("too much alike"));
}

TEST(SweepTable, IsFinishedWhereItHasAllItsRows) {
  const TemporaryFolder folder;
  ASSERT_EQ(sweep(folder.file("a.csv")).status, 0);
  const std::string whole = read_whole_file(folder.file("a.csv"));
  folder.write("a.csv", whole.substr(0, whole.rfind("\n7,") + 1));
  EXPECT_EQ(sweep(folder.file("a.csv")).status, 6) << "somebody's, now";
  EXPECT_EQ(sweep(folder.file("a.csv"), with(kGrid, {"--force"})).status, 0);
  EXPECT_EQ(read_whole_file(folder.file("a.csv")), whole);
}

TEST(SweepTable, ThatWasChangedByHandIsNotTakenForItsOwn) {
  const TemporaryFolder folder;
  ASSERT_EQ(sweep(folder.file("a.csv")).status, 0);
  const std::string whole = read_whole_file(folder.file("a.csv"));
  EXPECT_THAT(sweep(folder.file("a.csv")).out, HasSubstr("done before"));
  for (const std::string& changed : {std::string(whole).replace(whole.find("finished") + 9, 3, "0.1"), whole.substr(0, whole.rfind("# sha256"))}) {
    folder.write("a.csv", changed);
    const ProgramResult refused = sweep(folder.file("a.csv"));
    EXPECT_EQ(refused.status, 3);
    EXPECT_THAT(refused.err, HasSubstr("a.csv: has been changed or cut off since it was written: compute it again, with --force"));
    EXPECT_EQ(read_whole_file(folder.file("a.csv")), changed);
    EXPECT_EQ(sweep(folder.file("a.csv"), with(kGrid, {"--force"})).status, 0);
    EXPECT_EQ(read_whole_file(folder.file("a.csv")), whole);
  }
}

TEST(SweepTable, PartsThatLostTheirEndOrAreMixedUpAreNotJoined) {
  const TemporaryFolder folder;
  for (const char* shard : {"1/2", "2/2"}) ASSERT_EQ(sweep(folder.file("a.csv"), with(kGrid, {"--shard", shard})).status, 0);
  const std::string second = read_whole_file(folder.file("a.part-2-of-2.csv"));
  const std::string swapped = std::string(second).replace(second.find("\n5,"), 3, "\n6,");
  const std::string digit = std::string(second).replace(second.find("finished") + 9, 3, "0.1");
  const std::string without_hash = second.substr(0, second.rfind("# sha256"));
  for (const std::string& spoilt :
       {second.substr(0, second.size() - 1), second.substr(0, second.size() - 3), swapped, digit, without_hash, second + "8,", second + second}) {
    const ProgramResult result =
        run_program({"join", folder.file("a.part-1-of-2.csv"), folder.write("b.csv", spoilt), "-o", folder.file("x.csv")});
    EXPECT_EQ(result.status, 3) << result.out;
    EXPECT_FALSE(fs::exists(folder.file("x.csv")));
  }
}

TEST(SweepTable, DependsOnFilesThatValuesNameAndHoldsAnyWords) {
  const TemporaryFolder folder;
  folder.write("a.urdf", read_whole_file("models/rr.urdf"));
  folder.write("b.urdf", read_whole_file("models/rr.urdf"));
  const std::string scene = folder.write("s.yaml", "model: a.urdf\nmethod: rk4\nstep: 0.01\nduration: 0.1\n");
  const Words words{"sweep", scene, "--over", "model=a.urdf,b.urdf", "-o", folder.file("t.csv")};
  ASSERT_EQ(run_program(words).status, 0);
  EXPECT_THAT(run_program(words).out, HasSubstr("2 of them done before"));
  folder.write("b.urdf", read_whole_file("models/rr.urdf") + "<!-- heavier -->\n");
  EXPECT_EQ(run_program(words).status, 6) << "its rows are of another model";
  ASSERT_EQ(run_program({"sweep", scene, "--over", "title=two\nlines,\"b\"", "-o", folder.file("u.csv")}).status, 0);
  const std::vector<std::string> lines = lines_of(folder.file("u.csv"));
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_THAT(lines[4], HasSubstr("0,\"two lines\",1,finished"));
  EXPECT_THAT(lines[5], HasSubstr("1,\"\"\"b\"\"\",1,finished"));
}

TEST(Sweep, SaysWhatItCannotDoBeforeTheFirstRun) {
  const TemporaryFolder folder;
  const auto trouble = [&](const Words& more) {
    const ProgramResult result = run_program(with({"sweep", kSweptScene}, more));
    EXPECT_NE(result.status, 0);
    return std::to_string(result.status) + " " + result.err;
  };
  const Words over{"--over", "start.q.1=0,1"};
  EXPECT_THAT(trouble(with(over, {"-o", folder.file("a.mp4")})), HasSubstr("into a FOLDER/"));
  EXPECT_THAT(trouble(with(over, {"-o", folder.file("f/"), "-o", folder.file("g/")})), HasSubstr("takes one folder"));
  EXPECT_THAT(trouble(with(over, {"-o", folder.file("a.csv"), "-o", folder.file("./a.csv")})), HasSubstr("named twice"));
  EXPECT_THAT(trouble(with(over, {"-o", folder.file("a.csv"), "--each", "png"})), HasSubstr("--each says"));
  EXPECT_THAT(trouble(with(over, {"-o", folder.file("f/"), "--each", "doc"})), HasSubstr("--each doc"));
  EXPECT_THAT(trouble(with(over, {"-o", folder.file("f/"), "--each", "png", "--each", "png"})), HasSubstr("twice"));
  EXPECT_THAT(trouble(with(with(over, over), {"-o", folder.file("a.csv")})), HasSubstr("varies already"));
  EXPECT_THAT(trouble({"--over", "a=0:1:9999", "--over", "b=0:1:9999", "--over", "c=0:1:9999"}), HasSubstr("7 "));
  EXPECT_THAT(trouble({"--over", "title=" + std::string(300, 'x') + ",b", "-o", folder.file("f/")}), HasSubstr("names of more than"));
  EXPECT_THAT(trouble({"--over", "nothing=0,1", "-o", folder.file("a.csv")}), HasSubstr("3 "));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// Pages of a grid show the instant that was asked for, whatever the rate and slow motion of each film, and say which run they are of.
TEST(SweepFolder, PagesShowTheInstantAndSayTheirRun) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", "title: Falling\nmodel: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nduration: 1\nmethod: rk4\nvideo: {width: 320, height: 180, fps: 30}\n");
  const std::string out = folder.file("out");
  ASSERT_EQ(run_program({"sweep", scene, "--over", "start.q.1=0,1", "--over", "payload.mass=1,2", "--each", "svg", "--at", "0.251", "-o", out, "--quiet"}).status, 0);
  int seen = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(out)) {
    if (entry.path().extension() != ".svg") continue;
    ++seen;
    const std::string svg = read_whole_file(entry.path().string()), name = entry.path().filename().string();
    EXPECT_THAT(svg, testing::ContainsRegex("t = 0.251? s")) << name;
    EXPECT_THAT(svg, HasSubstr("payload = " + std::string(name.find("mass_1") != name.npos ? "1" : "2") + " kg")) << name;
  }
  EXPECT_EQ(seen, 4);
  const ProgramResult today = run_program({"check", out, "--today"});
  EXPECT_EQ(today.status, 0) << today.out;
  // Who sets a title has it as it is.
  ASSERT_EQ(run_program({"sweep", scene, "--over", "payload.mass=1,2", "--set", "title=Mine", "--each", "svg", "-o", out, "--quiet"}).status, 0);
  EXPECT_THAT(read_whole_file(out + "/a_payload.mass_1.svg"), Not(HasSubstr("payload = ")));
}

// A column over the two keys: the numbers of the table, first axis across, and the size of peaks. Oracle: a falling body by hand.
TEST(SweepMap, ShowsAColumnOfTheTableOverItsTwoKeys) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("fall.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/pp.urdf\nstart: {q: [0, 0], qd: [0, 0]}\nduration: 1\nmethod: dop853\n"
                                                      "tolerance: 1e-10\nevents: [{when: \"q2 < -3\", kind: fall, name: down}]\n");
  const auto swept = [&](const Words& more) {
    return run_program(with({"sweep", scene, "--over", "gravity.2=-8:-2:4", "--over", "start.qd.1=1:3:3", "--force"}, more));
  };
  ASSERT_EQ(swept({"--peaks", "qd", "--map", "qd2", "-o", folder.file("m.png"), "-o", folder.file("m.svg")}).status, 0);
  EXPECT_TRUE(fs::exists(folder.file("m.csv"))) << "its numbers lie beside it";
  const Image image = read_png(folder.file("m.png"));
  EXPECT_EQ(image.width, 1920);
  const std::string svg = read_whole_file(folder.file("m.svg"));
  EXPECT_THAT(svg, AllOf(HasSubstr("gravity.2"), HasSubstr("12 runs of 1 s")));
  // Columns of cells differ, rows do not: gravity alone changes how fast it falls; the largest is at the left.
  const auto at = [&](double x, double y) {
    const std::size_t i = (std::size_t(y * image.height) * std::size_t(image.width) + std::size_t(x * image.width)) * 4;
    return std::array<int, 3>{image.bgra[i], image.bgra[i + 1], image.bgra[i + 2]};
  };
  EXPECT_EQ(at(0.1, 0.3), at(0.1, 0.7));
  EXPECT_NE(at(0.1, 0.5), at(0.7, 0.5));
  EXPECT_GT(at(0.1, 0.5)[2], at(0.7, 0.5)[2]) << "yellow where it is fastest, violet where it is slowest";
  EXPECT_THAT(svg, AllOf(HasSubstr("DOP853"), Not(HasSubstr("doubtful"))));
  // Numbers that a table calls doubtful have a dot, and the page says of how many.
  ASSERT_EQ(swept({"--peaks", "qd", "--map", "qd2", "--set", "method=semi_implicit_euler", "--set", "step=0.3", "-o", folder.file("d.svg")}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("d.svg")), AllOf(HasSubstr("doubtful"), HasSubstr("column `trouble`")));
  // By the first of the peaks where no column is named; what has no number is hatched.
  ASSERT_EQ(swept({"--map", "down", "-o", folder.file("e.svg"), "-o", folder.file("e.csv")}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("e.svg")), HasSubstr("no value"));
  EXPECT_THAT(swept({"--map", "qd3", "--peaks", "qd", "-o", folder.file("x.png")}).err, HasSubstr("--map qd3: the table has no such column"));
  EXPECT_FALSE(fs::exists(folder.file("x.csv"))) << "said before anything is computed";
  EXPECT_THAT(swept({"-o", folder.file("y.png")}).err, HasSubstr("a map shows one column of the table"));
  EXPECT_THAT(swept({"--peaks", "qd", "--shard", "1/2", "-o", folder.file("z.png")}).err, HasSubstr("a share of the runs makes no map"));
  EXPECT_THAT(swept({"--map", "qd1", "-o", folder.file("t.csv")}).err, HasSubstr("--map says what a picture shows"));
  const ProgramResult three = run_program({"sweep", scene, "--over", "gravity.2=-8:-2:4", "--over", "start.q.1=0:1:2", "--over", "start.q.2=0:1:2", "--peaks", "qd", "-o", folder.file("three.png")});
  EXPECT_THAT(three.err, HasSubstr("one key as curves, or two as a map"));
  EXPECT_FALSE(fs::exists(folder.file("three.csv")));
}

// Over one key a picture has a curve for the peaks of each joint, whose marks are the table's numbers.
TEST(SweepTable, OverOneKeyIsDrawnAsCurves) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", "title: Payloads\nmodel: " + std::string(CHAINREEL_SOURCE_FOLDER) + "/models/rr.urdf\nduration: 0.5\nmethod: rk4\n"
                                                   "events: [{when: y_G < -1, name: low}]\n");
  const auto swept = [&](const Words& more) { return run_program(with({"sweep", scene, "--over", "start.q.1=-60deg:0:4", "--force"}, more)); };
  const ProgramResult run = swept({"--peaks", "qd,tau", "-o", folder.file("p.svg"), "-o", folder.file("p.png")});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(fs::exists(folder.file("p.csv")));
  const std::string svg = read_whole_file(folder.file("p.svg"));
  EXPECT_THAT(svg, AllOf(HasSubstr("Payloads"), HasSubstr("4 runs of 0.5 s"), HasSubstr("Each mark is a run"), Not(HasSubstr("no value"))));
  EXPECT_EQ(run_program({"check", folder.file("p.svg"), folder.file("p.csv"), "--today"}).status, 0);
  EXPECT_EQ(svg.find("doubtful"), std::string::npos);
  // A quantity a panel; what is doubtful is said with its remedy, unless the method is auto's.
  ASSERT_EQ(swept({"--peaks", "qd,tau", "--set", "method=explicit_euler", "--set", "step=0.05", "-o", folder.file("d.svg")}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("d.svg")), AllOf(HasSubstr("N m]"), HasSubstr("rad/s]"), HasSubstr("4 of 4 runs doubtful"), HasSubstr("try --set method=auto")));
  // One joint; what has no value is a cross above the axes; what is no column is said before anything is computed.
  ASSERT_EQ(swept({"--peaks", "qd", "--map", "qd2", "-o", folder.file("q.svg")}).status, 0);
  EXPECT_NE(read_whole_file(folder.file("q.svg")), svg);
  ASSERT_EQ(swept({"--map", "low", "-o", folder.file("e.svg")}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("e.svg")), HasSubstr("no value"));
  EXPECT_THAT(swept({"--map", "qd3", "--peaks", "qd", "-o", folder.file("x.png")}).err, HasSubstr("--map qd3: the table has no such column"));
  EXPECT_FALSE(fs::exists(folder.file("x.csv")));
  const ProgramResult falling = run_program({"sweep", scene, "--over", "start.q.1=1,0", "--peaks", "qd", "-o", folder.file("f.png")});
  EXPECT_THAT(falling.err, HasSubstr("takes rising numbers"));
  const ProgramResult words = run_program({"sweep", scene, "--over", "method=rk4,verlet", "--peaks", "qd", "-o", folder.file("w.png")});
  EXPECT_THAT(words.err, HasSubstr("takes rising numbers"));
}

}  // namespace
}  // namespace chainreel
