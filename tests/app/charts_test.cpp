// `chart`, `energy`, `stability`, `methods`: what they draw and the numbers beside it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "core/format.hpp"
#include "core/json.hpp"
#include "integrate/method.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Rows of a CSV as columns by name, without units; lines that begin with # are passed over.
struct Csv {
  std::vector<std::map<std::string, std::string>> rows;
  explicit Csv(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> head;
    for (std::string line; std::getline(stream, line);) {
      if (line.starts_with('#')) continue;
      std::vector<std::string> cells;
      std::istringstream cut(line);
      for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
      if (head.empty()) {
        for (const std::string& cell : cells) head.push_back(cell.substr(0, cell.find(" [")));
        continue;
      }
      auto& row = rows.emplace_back();
      for (std::size_t i = 0; i < cells.size() && i < head.size(); ++i) row[head[i]] = cells[i];
    }
  }
};

// The line of a table that begins with this word.
std::string line_of(const std::string& text, const std::string& word) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(word + " ")) return line;
  return "";
}

std::string last_word(const std::string& line) {
  const std::size_t end = line.find_last_not_of(' ');
  return end == std::string::npos ? "" : line.substr(line.rfind(' ', end) + 1, end - line.rfind(' ', end));
}

double number(const std::string& text) {
  return text.empty() ? std::nan("") : std::stod(text);
}

// What is damped comes to rest whatever the method did on its way: errors at the end say nothing there, and the chart says so.
TEST(ChartCommand, WarnsWhereTheRunEndsAtRest) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [0.5], masses: [1], joints: R}\nstart: {q: [1], qd: [2]}\ngravity: [0, 0, 0]\n"
                                                   "torque: [-10 * qd1]\nduration: 3\n");
  const auto warned = [&](const Words& more) {
    Words words{"chart", scene, "--methods", "rk4", "--runs", "1", "--longest", "5ms", "--force", "--json", "-o", folder.file("c.svg")};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(result.out);
    return std::pair{result.err, json.at("warnings").size()};
  };
  EXPECT_THAT(warned({"--error", "final"}), testing::Pair(HasSubstr("the run ends at rest"), 1u));
  EXPECT_THAT(warned({"--error", "final", "--set", "duration=0.05"}), testing::Pair(Not(HasSubstr("at rest")), 0u));
  EXPECT_THAT(warned({}), testing::Pair(Not(HasSubstr("at rest")), 0u)) << "the way is judged";
  EXPECT_THAT(warned({"--error", "energy"}), testing::Pair(Not(HasSubstr("at rest")), 0u));
}

// By default the largest error along the run is judged: of what comes to rest, errors at the end call the coarsest step exact.
TEST(ChartCommand, JudgesTheWay) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [0.5], masses: [1], joints: R}\nstart: {q: [1], qd: [2]}\ngravity: [0, 0, 0]\n"
                                                   "torque: [-20 * q1 - 10 * qd1]\nduration: 4\n");
  const auto cheapest_for = [&](const std::string& error) {
    const ProgramResult result = run_program({"chart", scene, "--methods", "rk4", "--runs", "1", "--longest", "5ms", "--error", error, "--reach", "1e-6", "--force", "-o", folder.file("c.csv")});
    EXPECT_EQ(result.status, 0) << result.err;
    const std::size_t at = result.out.find("h = ");
    EXPECT_NE(at, std::string::npos) << result.out;
    return std::stod(result.out.substr(at + 4));
  };
  const double way = cheapest_for("way"), final = cheapest_for("final");
  EXPECT_LT(way, final);
  const Csv csv(read_whole_file(folder.file("c.csv")));
  for (const auto& row : csv.rows) {
    if (row.at("status") != "finished") continue;
    EXPECT_GE(number(row.at("way_error")), number(row.at("error"))) << row.at("step");
  }
}

// Where a motion magnifies roundings beyond its own size no method is better than another: what comes before is judged, and that is said.
TEST(ChartCommand, JudgesAChaoticRunWhereItIsKnown) {
  const TemporaryFolder folder;
  const auto chart = [&](const std::string& scene, const Words& more) {
    const ProgramResult result = run_program(with({"chart", scene, "--methods", "rk4,taylor", "--runs", "1", "--longest", "20ms", "--json", "--force", "-o", folder.file("c.csv")}, more));
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(result.out);
  };
  const Json cut = chart("rrr_torque", {});
  EXPECT_EQ(cut.at("duration"), 5);
  const double until = cut.at("judged_until");
  EXPECT_LT(until, 5);
  EXPECT_LE(until, cut.at("choice").at("holds_until").get<double>());
  EXPECT_THAT(read_whole_file(folder.file("c.csv")), HasSubstr("# judged: the first " + format_shortest(until) + " of 5 s"));
  double least = 1;
  for (const Json& rung : cut.at("methods").back().at("rungs")) least = std::min(least, rung.at("way_error").is_null() ? 1 : rung.at("way_error").get<double>());
  EXPECT_LT(least, 1e-3) << "a share of the motion that is an answer";
  const Json whole = chart("rrr_torque", {"--set", "duration=1"});
  EXPECT_EQ(whole.at("judged_until"), 1) << "negative control: what is known to its end";
  EXPECT_THAT(read_whole_file(folder.file("c.csv")), Not(HasSubstr("judged")));
  EXPECT_EQ(chart("rrr_torque", {"--error", "energy"}).at("judged_until"), 5) << "the energy is known everywhere";
}

// A run that a limit stops has no end that others could be compared at: told before anything is measured.
TEST(ChartCommand, RefusesARunThatALimitStops) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: {links: [0.5], masses: [1], efforts: 1}\ntorque: ['2 * t']\nduration: 2\nlimit: stop\n");
  const ProgramResult stopped = run_program({"chart", scene, "--methods", "rk4", "--runs", "1", "-o", folder.file("c.csv")});
  EXPECT_EQ(stopped.status, 5);
  EXPECT_THAT(stopped.err, AllOf(HasSubstr("the run stops: joint 'joint1' passed its effort limit 1"), HasSubstr("take --set duration=0.")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("c.csv")));
  EXPECT_EQ(run_program({"chart", scene, "--methods", "rk4", "--runs", "1", "--longest", "2ms", "--set", "duration=0.4", "-o", folder.file("d.csv")}).status, 0) << "negative control";
}

TEST(MethodsCommand, ListsEveryRowOfTheRegistry) {
  const ProgramResult result = run_program({"methods", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json list = Json::parse(result.out)["methods"];
  ASSERT_EQ(list.size(), methods().size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i]["name"], methods()[i].name);
    EXPECT_EQ(list[i]["order"], methods()[i].order);
    EXPECT_FALSE(list[i]["source"].get<std::string>().empty());
  }
  const std::string table = run_program({"methods"}).out;
  for (const Method& method : methods()) EXPECT_THAT(table, HasSubstr(method.name));
}

TEST(ChartCommand, WritesAPictureAndTheNumbersBesideIt) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"chart", "assets/scenes/rr_free.yaml", "--set", "duration=1", "--runs", "1", "--longest",
                   "0.1", "--methods", "rk4,dop853", "-o", folder.file("chart.svg")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("reference: "), HasSubstr("uncertainty"), HasSubstr("auto: ")));
  EXPECT_THAT(read_whole_file(folder.file("chart.svg")), AllOf(HasSubstr("<svg"), HasSubstr("rk4"), HasSubstr("[rad]<"), testing::Not(HasSubstr("[rad, m]"))));
  const std::string text = read_whole_file(folder.file("chart.csv"));
  EXPECT_THAT(text, AllOf(HasSubstr("# machine: "), HasSubstr("# compiler: "), HasSubstr("# revision: ")));
  const Csv csv(text);
  ASSERT_GT(csv.rows.size(), 12u);
  std::map<std::string, double> best;
  for (const auto& row : csv.rows) {
    EXPECT_GT(number(row.at("median_seconds")), 0);
    EXPECT_GT(number(row.at("evaluations")), 0);
    if (row.at("status") != "finished") continue;
    auto [place, first] = best.try_emplace(row.at("method"), number(row.at("error")));
    if (!first) place->second = std::min(place->second, number(row.at("error")));
  }
  EXPECT_THAT(text, HasSubstr("# error: the larger of error_q and error_qd x "));
  const std::size_t at = text.find("error_qd x ") + 11;
  const double scale = std::stod(text.substr(at));
  EXPECT_GT(scale, 0.01);
  EXPECT_LT(scale, 1);
  bool rates_decide = false;
  for (const auto& row : csv.rows) {
    if (row.at("status") != "finished") continue;
    const double q = number(row.at("error_q")), qd = scale * number(row.at("error_qd"));
    EXPECT_NEAR(number(row.at("error")), std::max(q, qd), 1e-4 * std::max(q, qd));  // six digits each
    rates_decide = rates_decide || qd > q;
  }
  EXPECT_TRUE(rates_decide);
  // Both reach rounding or nearly so: 1e-9 on a motion of a second that magnifies errors ten times.
  EXPECT_LT(best.at("rk4"), 1e-9);
  EXPECT_LT(best.at("dop853"), 1e-11);
}

// The largest along the run, as simulate's audit has it; at the end alone the method may be right by chance.
TEST(ChartCommand, JudgesTheEnergyAlongTheRun) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"chart", "assets/scenes/rr_free.yaml", "--set", "duration=3", "--runs", "1", "--error", "energy", "--methods",
                                            "rk4,dop853", "-o", folder.file("chart.svg"), "-o", folder.file("chart.csv")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("1e-3 [J]"), HasSubstr("error: of the energy, the largest")));
  EXPECT_THAT(read_whole_file(folder.file("chart.svg")), HasSubstr("largest energy error [J]"));
  const Csv csv(read_whole_file(folder.file("chart.csv")));
  int compared = 0;
  for (const auto& row : csv.rows) {
    const std::string step = row.at("step"), tolerance = row.at("tolerance");
    if (step != "0.01" && tolerance != "1e-06") continue;
    const ProgramResult run = run_program({"simulate", "assets/scenes/rr_free.yaml", "--set", "duration=3", "--set", "method=" + row.at("method"), "--set",
                                           step.empty() ? "tolerance=" + tolerance : "step=" + step, "-o", folder.file("a.csv"), "--force", "--json"});
    const double expected = Json::parse(run.out)["energy_error"];
    EXPECT_NEAR(number(row.at("energy_error")), expected, 1e-9 * expected) << row.at("method");
    ++compared;
  }
  EXPECT_EQ(compared, 2) << "tolerances are written as one writes them";
}

TEST(ChartCommand, RefusesUnknownMethodsAndEndings) {
  const ProgramResult method = run_program({"chart", "assets/scenes/rr_free.yaml", "--methods", "rk5"});
  EXPECT_EQ(method.status, 2);
  EXPECT_THAT(method.err, HasSubstr("did you mean 'rk4'?"));
  const ProgramResult ending = run_program({"chart", "assets/scenes/rr_free.yaml", "-o", "chart.gif"});
  EXPECT_EQ(ending.status, 2);
  EXPECT_THAT(ending.err, HasSubstr(".png, .svg or .pdf, their numbers as .csv, .json or .npz"));
}

TEST(EnergyCommand, ShowsWhoGainsEnergyAndWhoKeepsIt) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"energy", "assets/scenes/rr_free.yaml", "--until", "5s", "--step", "0.01", "--methods",
                   "explicit_euler,rk4,dop853", "-o", folder.file("energy.csv")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("energy.png")));
  const Csv csv(read_whole_file(folder.file("energy.csv")));
  std::map<std::string, double> largest;
  double end = 0;
  for (const auto& row : csv.rows) {
    double& error = largest[row.at("method")];
    error = std::max(error, std::abs(number(row.at("energy_error"))));
    end = std::max(end, number(row.at("t")));
  }
  EXPECT_EQ(end, 5);
  // Three classes, each a hundred times better: first order, fourth order, a tolerance of 1e-9.
  EXPECT_GT(largest.at("explicit_euler"), 1);
  EXPECT_LT(largest.at("rk4"), 0.01 * largest.at("explicit_euler"));
  EXPECT_LT(largest.at("dop853"), 0.01 * largest.at("rk4"));
}

TEST(EnergyCommand, ShowsTheCurvesOfAComparisonAsItsPanelsSay) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"energy", "assets/scenes/euler_gains_energy.yaml", "--until", "1s", "-o", folder.file("a.svg"), "-o", folder.file("b.csv"), "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json report = Json::parse(result.out);
  ASSERT_EQ(report["runs"].size(), 3u);
  EXPECT_EQ(report["runs"][1]["setting"], "explicit_euler, step 0.02 s");
  EXPECT_EQ(report["runs"][2]["panel"], 3);
  EXPECT_THAT(report["runs"][0]["setting"].get<std::string>(), HasSubstr("tolerance 1e-12"));
  EXPECT_GT(report["runs"][1]["largest_error"], 1e6 * report["runs"][0]["largest_error"].get<double>());
  EXPECT_THAT(read_whole_file(folder.file("a.svg")), AllOf(HasSubstr("semi-implicit Euler, 20 ms"), HasSubstr("explicit Euler, 20 ms")));
  const Csv csv(read_whole_file(folder.file("b.csv")));
  EXPECT_EQ(csv.rows.front().at("panel"), "1");
  EXPECT_EQ(csv.rows.back().at("panel"), "3");
  // A run that diverges is one of them.
  const ProgramResult big = run_program({"energy", "assets/scenes/big_steps.yaml", "-o", folder.file("c.csv")});
  EXPECT_EQ(big.status, 0) << big.err;
  EXPECT_THAT(big.out, HasSubstr("diverged"));
}

TEST(EnergyCommand, RunsMethodsOnTheMotionThatPanelsShare) {
  const TemporaryFolder folder;
  const Words words{"--until", "0.2s", "--methods", "rk4,verlet", "-o", folder.file("a.csv"), "--force"};
  const ProgramResult shared = run_program(with({"energy", "assets/scenes/euler_gains_energy.yaml"}, words));
  EXPECT_EQ(shared.status, 0) << shared.err;
  EXPECT_THAT(shared.out, HasSubstr("rk4, step 0.01 s")) << "the panels alone have steps";
  // Panels that differ otherwise: the first message names the flag.
  const ProgramResult apart = run_program(with({"energy", "assets/scenes/pen_drift.yaml"}, words));
  EXPECT_EQ(apart.status, 3);
  EXPECT_THAT(apart.err, HasSubstr("choose one, `--panel 1` to `--panel 3`"));
  EXPECT_EQ(run_program(with({"energy", "assets/scenes/pen_drift.yaml", "--panel", "2"}, {"--until", "0.2s", "--methods", "rk4", "-o",
                                                                                          folder.file("a.csv"), "--force"}))
                .status,
            0);
  EXPECT_EQ(run_program(with({"energy", "assets/scenes/pen_drift.yaml", "--panel", "4"}, words)).status, 2);
  EXPECT_EQ(run_program({"stability", "assets/scenes/big_steps.yaml", "--methods", "rk4"}).status, 0);
}

// The methods are the command's: a scene's step and tolerance are what they take.
// Nothing is left out in silence: these go on where the scene would stop.
TEST(EnergyCommand, AndOthersThatMeasureMethodsSayThatEventsAreLeftOut) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("stops.yaml", "model: {links: [0.5, 0.4], masses: [2, 1]}\nstart: {q: [0.3, 0.5]}\nduration: 0.2\n"
                                                       "events: [{when: q1, kind: stop}]\n");
  const std::string said = "events are not looked for here";
  const Words methods{scene, "--methods", "dop853"};
  for (const char* command : {"energy", "chart", "stability"}) {
    EXPECT_THAT(run_program(with(with({command}, methods), {"-o", folder.file(std::string(command) + ".csv")})).err, HasSubstr(said)) << command;
    EXPECT_THAT(run_program(with(with({command}, methods), {"-o", folder.file(std::string(command) + "_none.csv"), "--set", "events=[]"})).err,
                testing::Not(HasSubstr(said)))
        << command;
  }
}

TEST(EnergyCommand, TakesAStepOfASceneThatNamesNoMethod) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", "model: rr.urdf\nduration: 0.2\nstep: 0.02\ntolerance: 1e-7\n");
  const ProgramResult result = run_program({"energy", scene, "--methods", "rk4,dop853", "-o", folder.file("a.csv")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("rk4, step 0.02 s"), HasSubstr("dop853, tolerance 1e-07")));
  EXPECT_EQ(run_program({"simulate", scene, "-o", folder.file("b.csv")}).status, 3) << "elsewhere they go with a method";
}

TEST(FigureOutputs, MayBeSeveral) {
  const TemporaryFolder folder;
  const Words words{"energy", "assets/scenes/rr_free.yaml", "--until", "0.1s", "--methods", "rk4"};
  const ProgramResult both = run_program(with(words, {"-o", folder.file("e.svg"), "-o", folder.file("e.csv"), "-o", folder.file("f.pdf"), "--json"}));
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_EQ(Json::parse(both.out)["files"],
            Json({folder.file("e.svg"), folder.file("e.csv"), folder.file("f.pdf"), folder.file("f.csv")}));
  EXPECT_EQ(read_whole_file(folder.file("e.csv")), read_whole_file(folder.file("f.csv")));
  // What is there already is told before anything is run.
  const ProgramResult again = run_program({"energy", "assets/scenes/rr_free.yaml", "--until", "100000s", "-o", folder.file("e.svg")});
  EXPECT_EQ(again.status, 6);
  const ProgramResult twice = run_program(with(words, {"-o", folder.file("g.svg"), "-o", folder.file("./g.svg")}));
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("is named twice"));
}

// Errors stand at the ends of steps, and the largest of them all is kept however long the run is.
TEST(EnergyCommand, KeepsTheLargestOfAllStepsAndTellsItFromDenseOutput) {
  const TemporaryFolder folder;
  double shorter = 0;
  for (const char* until : {"20s", "200s"}) {
    const ProgramResult result =
        run_program({"energy", "assets/scenes/rr_free.yaml", "--until", until, "--step", "0.01", "--methods",
                     "symplectic_euler,verlet", "-o", folder.file("energy.csv"), "--force"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Csv csv(read_whole_file(folder.file("energy.csv")));
    std::map<std::string, double> largest;
    for (const auto& row : csv.rows) {
      double& error = largest[row.at("method")];
      error = std::max(error, std::abs(number(row.at("energy_error"))));
      const double steps = number(row.at("t")) / 0.01;
      EXPECT_NEAR(steps, std::round(steps), 1e-3);
    }
    if (shorter == 0) {
      EXPECT_NEAR(largest.at("symplectic_euler"), 1.60, 0.01);
      EXPECT_NEAR(largest.at("verlet"), 0.144, 0.001);
      EXPECT_THAT(result.out, HasSubstr("between steps, J"));
    }
    EXPECT_GE(largest.at("symplectic_euler"), shorter);
    shorter = largest.at("symplectic_euler");
  }
}

TEST(StabilityCommand, PutsTheBorderWhereTheTheoryHasIt) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"stability", "assets/scenes/pp_spring.yaml", "--set", "torque=[0, -k * y_G]", "--set",
                   "parameters.k=100", "--x", "step=0.05:0.3:26", "--y", "parameters.k=50:400:8", "-o",
                   folder.file("map.png"), "--width", "640", "--height", "360"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_GT(std::filesystem::file_size(folder.file("map.png")), 5000u);
  const Csv csv(read_whole_file(folder.file("map.csv")));
  ASSERT_EQ(csv.rows.size(), 26u * 8u);
  int failed = 0;
  for (const auto& row : csv.rows) {
    const double omega_h = std::sqrt(number(row.at("parameters.k"))) * number(row.at("step"));
    if (std::abs(omega_h - 2) < 1e-9) continue;  // on the border itself rounding decides
    EXPECT_EQ(row.at("failed") == "0", omega_h < 2) << omega_h;
    EXPECT_EQ(row.at("stable_by_theory") == "1", omega_h < 2) << omega_h;
    failed += omega_h > 2;
  }
  EXPECT_GT(failed, 20);
  EXPECT_THAT(result.out, HasSubstr("and at instants of the run")) << "the scene starts away from its spring's rest";
}

// A line that a twentieth of the cells contradict is no limit: it is left out, which is said; colours are shares of the motion's energy.
TEST(StabilityCommand, LeavesOutATheoryThatCellsContradict) {
  const TemporaryFolder folder;
  const ProgramResult far = run_program({"stability", "assets/scenes/rr_free.yaml", "--x", "step=0.01:0.3:8:log", "--y", "start.q.2=-90deg:90deg:5", "-o", folder.file("far.svg")});
  ASSERT_EQ(far.status, 0) << far.err;
  EXPECT_THAT(far.out, HasSubstr("limit of the linearised motion is left out"));
  EXPECT_THAT(read_whole_file(folder.file("far.svg")), AllOf(HasSubstr("linearised motion"), HasSubstr("&gt; 100 %"), HasSubstr("energy [%]"), Not(HasSubstr("Theory:"))));
  const ProgramResult linear = run_program({"stability", "assets/scenes/pp_spring.yaml", "--x", "step=0.05:0.3:12", "--y", "start.q.2=0.1:0.4:3", "-o", folder.file("near.svg")});
  ASSERT_EQ(linear.status, 0) << linear.err;
  EXPECT_THAT(linear.out, Not(HasSubstr("left out")));
  EXPECT_THAT(read_whole_file(folder.file("near.svg")), HasSubstr("Theory:"));
}

TEST(ChartCommand, PrintsTheCheapestOfTheErrorsThatAreAsked) {
  const TemporaryFolder folder;
  const auto chart = [&](const std::string& reach) {
    return run_program({"chart", "pp_spring", "--set", "duration=0.5", "--methods", "rk4,dop853", "--longest", "5ms", "--runs", "1", "--reach", reach, "--force", "-o", folder.file("c.csv")});
  };
  const ProgramResult two = chart("1e-4, 2e-7");
  ASSERT_EQ(two.status, 0) << two.err;
  EXPECT_THAT(two.out, testing::ContainsRegex("to reach +1e-4.* 2e-7"));
  EXPECT_THAT(two.out, testing::Not(HasSubstr("1e-9")));
  for (const char* bad : {"-1", "0", "1e-4,,", "small", ""}) EXPECT_EQ(chart(bad).status, 2) << bad;
}

TEST(StabilityCommand, DrawsAMapOfEachMethodThatIsNamed) {
  const TemporaryFolder folder;
  const Words map{"stability", "assets/scenes/pp_spring.yaml", "--set", "torque=[0, -k * y_G]", "--set", "parameters.k=100", "--x",
                  "step=0.05:0.3:3", "--y", "parameters.k=50:400:2", "--methods", "rk4,semi_implicit_euler"};
  const auto with = [&](Words more) {
    more.insert(more.begin(), map.begin(), map.end());
    return run_program(more);
  };
  ASSERT_EQ(with({"-o", folder.file("map.csv")}).status, 0);
  const std::string rk4 = read_whole_file(folder.file("map_rk4.csv")), euler = read_whole_file(folder.file("map_semi_implicit_euler.csv"));
  EXPECT_NE(rk4, euler);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "map.csv"));
  EXPECT_THAT(with({"--json", "-o", folder.file("b.csv")}).err, HasSubstr("--json tells of one map"));
  EXPECT_EQ(with({"-o", folder.file("map.csv")}).status, 6) << "files that are there stay";
  // Axes that would have no room are refused, as other figures are.
  for (const char* width : {"20", "30"}) {
    const ProgramResult narrow = with({"-o", folder.file("n.png"), "--width-mm", width, "--height-mm", "80"});
    EXPECT_EQ(narrow.status, 3) << width;
    EXPECT_THAT(narrow.err, HasSubstr("take a wider page")) << width;
  }
}

TEST(StabilityCommand, ComparesTheMethodsWithoutAMap) {
  const ProgramResult result = run_program({"stability", "assets/scenes/pp_spring.yaml"});
  ASSERT_EQ(result.status, 0) << result.err;
  // omega = 10 rad/s: 2 / omega and 2 sqrt(2) / omega; implicit methods have no limit.
  EXPECT_THAT(result.out, AllOf(HasSubstr("Who fails here"), HasSubstr("0.2828"), HasSubstr("diverged"),
                                HasSubstr("omega = 10 rad/s"), HasSubstr("and at instants of the run")));
  for (const char* method : {"radau5", "implicit_midpoint", "gauss4", "gauss6"})
    EXPECT_EQ(last_word(line_of(result.out, method)), "none") << method;
  EXPECT_EQ(last_word(line_of(result.out, "explicit_euler")), "0");
}

// Beyond critical damping nothing swings: the fastest decay, 26.18 /s, decides.
TEST(StabilityCommand, HasLimitsWhereADamperLetsNothingSwing) {
  const ProgramResult result =
      run_program({"stability", "assets/scenes/pp_spring.yaml", "--set", "torque=[0, -100 * q2 - 30 * qd2]",
                   "--set", "duration=1", "--methods", "rk4,semi_implicit_euler,gauss4"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(last_word(line_of(result.out, "rk4")), "0.1064");
  EXPECT_EQ(last_word(line_of(result.out, "semi_implicit_euler")), "0.06056");
  EXPECT_EQ(last_word(line_of(result.out, "gauss4")), "none");
  EXPECT_THAT(result.out, HasSubstr("decays with 26.1803 /s"));
}

TEST(StabilityCommand, SaysUnknownWhereItFoundNoLimit) {
  const ProgramResult result =
      run_program({"stability", "assets/scenes/pp_free.yaml", "--methods", "rk4,gauss4"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(last_word(line_of(result.out, "rk4")), "unknown");
  EXPECT_THAT(result.out, HasSubstr("nothing swings or decays about the start"));
}

TEST(StabilityCommand, SaysWhatItTakesInsteadOfAnythingElse) {
  EXPECT_EQ(run_program({"stability", "assets/scenes/pp_spring.yaml", "--x", "step=1:2:3"}).status, 2);
  const ProgramResult words = run_program(
      {"stability", "assets/scenes/pp_spring.yaml", "--x", "method=rk4,verlet", "--y", "step=0.1:0.2:2"});
  EXPECT_EQ(words.status, 2);
  EXPECT_THAT(words.err, HasSubstr("--x of a map takes a range"));
}

TEST(AutoMethod, IsChosenWhereASceneNamesNoneAndSaysSo) {
  const ProgramResult check = run_program({"check", "assets/scenes/rr_free.yaml", "--json", "--set",
                                           "method=auto", "--set", "step=null", "--set", "duration=2"});
  ASSERT_EQ(check.status, 0) << check.err;
  const Json report = Json::parse(check.out);
  const Json& choice = report["cost"]["auto"];
  EXPECT_TRUE(choice["is_met"]);
  EXPECT_EQ(choice["accuracy"], "0.1 px");
  EXPECT_LE(choice["error"].get<double>(), 0.1);
  EXPECT_GT(choice["tried"].size(), 5u);
  EXPECT_THAT(report["scene"].get<std::string>(),
              AllOf(HasSubstr("method: auto"), Not(HasSubstr("\nstep:"))));
}

// Counted before anything is run: each of these would take years, or memory that is not there.
TEST(Workload, IsRefusedWithItsCountBeforeItBegins) {
  const std::string scene = "assets/scenes/pp_spring.yaml";
  TemporaryFolder folder;
  const std::string out = folder.file("x");
  const auto with = [&](std::vector<std::string> words, const std::string& output) {
    words.insert(words.end(), {"-o", output});
    return words;
  };
  const std::vector<std::string> tiny{"--set", "method=rk4", "--set", "step=1e-15"};
  const auto joined = [](std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  for (const std::vector<std::string>& words :
       {with(joined({"simulate", scene}, tiny), out + ".csv"), with(joined({"render", scene}, tiny), out + ".mp4"),
        joined({"check", scene}, tiny), with(joined({"snapshot", scene}, tiny), out + ".png"),
        with(joined({"sheet", scene}, tiny), out + ".png"),
        with({"energy", scene, "--until", "1e9s", "--step", "1e-9"}, out + ".png"),
        with({"stability", scene, "--set", "method=rk4", "--x", "step=1e-12:1e-11:3", "--y", "start.q.2=0.1:1:3"},
             out + ".png"),
        with({"stability", scene, "--set", "method=rk4", "--set", "step=1e-6", "--x", "start.q.1=0:1:10000", "--y",
              "start.q.2=0.1:1:10000"},
             out + ".png")}) {
    const ProgramResult result = run_program(words, {.timeout_s = 20});
    EXPECT_EQ(result.status, 7) << words[0] << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("take"), Not(HasSubstr("exception")))) << words[0];
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << words[0];
  }
}

TEST(Workload, IsNoToleranceBelowTheRoundingOfDoubles) {
  const ProgramResult scene = run_program({"check", "assets/scenes/pp_spring.yaml", "--set", "method=dop853", "--set",
                                           "step=null", "--set", "tolerance=1e-17"});
  EXPECT_EQ(scene.status, 3);
  EXPECT_THAT(scene.err, AllOf(HasSubstr("tolerance"), HasSubstr("1e-15")));
  const ProgramResult energy = run_program({"energy", "assets/scenes/pp_spring.yaml", "--tolerance", "1e-17"});
  EXPECT_EQ(energy.status, 2);
  EXPECT_THAT(energy.err, HasSubstr("1e-15"));
}

// What the search is at goes to standard error, and not with --quiet; the choice is the same in every command.
TEST(Automatic, SaysTheSameInEveryCommand) {
  const std::vector<std::string> scene{"assets/scenes/rr_free.yaml", "--set", "method=auto", "--set", "step=null",
                                       "--set", "duration=10", "--set", "accuracy=1e-3 px"};
  const auto run = [&](const std::string& command, const std::vector<std::string>& more) {
    std::vector<std::string> words{command};
    words.insert(words.end(), scene.begin(), scene.end());
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  TemporaryFolder folder;
  const ProgramResult check = run("check", {}), simulate = run("simulate", {"-o", folder.file("a.csv")}),
                      json = run("simulate", {"-o", folder.file("b.csv"), "--json", "--quiet"});
  const std::string sentence = line_of(check.out, "auto:");
  ASSERT_FALSE(sentence.empty()) << check.err;
  EXPECT_THAT(simulate.err, HasSubstr(sentence));
  EXPECT_EQ(json.err, "");
  const Json choice = Json::parse(json.out)["auto"];
  EXPECT_THAT(sentence, HasSubstr(choice["setting"].get<std::string>()));
  if (!choice["why_until"].is_null()) EXPECT_THAT(sentence, HasSubstr(choice["why_until"].get<std::string>()));
  EXPECT_FALSE(choice["reference"].get<std::string>().empty());
}

}  // namespace
}  // namespace chainreel
