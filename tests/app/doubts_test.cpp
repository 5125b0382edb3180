// What a scene says and nothing comes of, or something else than was meant, is warned of by every command that runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kRoot = CHAINREEL_SOURCE_FOLDER;

std::string short_scene(const std::string& more) {
  return "model: " + kRoot + "/models/rr.urdf\nduration: 0.1\nmethod: rk4\nvideo: {width: 320, height: 180}\n" + more;
}

// The line of the standard error with these words; "" where there is none.
std::string line_with(const std::string& words, const std::string& err) {
  const std::size_t at = err.find(words);
  if (at == std::string::npos) return "";
  const std::size_t begin = err.rfind('\n', at) + 1;
  return err.substr(begin, err.find('\n', at) - begin);
}

std::size_t count_of(const std::string& words, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(words, at)) != std::string::npos; at += words.size()) ++count;
  return count;
}

// What all panels of a comparison share is said once, what one has alone as well.
TEST(Doubts, OfSeveralPanelsAreSaidOnce) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("a.yaml", short_scene("start: {q: [60, 0]}\ncompare: [{step: 0.01}, {step: 0.02}, {step: 0.05, start: {q: [0, 40]}}]\n"));
  const std::vector<Words> commands{{"render", scene, "-o", folder.file("a.png")}, {"snapshot", scene, "-o", folder.file("b.png")},
                                    {"sheet", scene, "-o", folder.file("s.png")}, {"check", scene}};
  for (const Words& command : commands) {
    const std::string err = run_program(command).err;
    EXPECT_EQ(count_of("start.q: 60 of joint1", err), 1u) << command[0] << "\n" << err;
    EXPECT_EQ(count_of("start.q: 40 of joint2", err), 1u) << command[0] << "\n" << err;
  }
  const std::string two = folder.write("two.urdf", read_whole_file(kRoot + "/models/humanoid.urdf"));
  const std::string ends = folder.write(
      "b.yaml", "model: two.urdf\nmethod: rk4\nduration: 0.1\nvideo: {width: 320, height: 180}\ncompare: [{step: 0.01}, {step: 0.02}]\n");
  const std::string err = run_program({"render", ends, "-o", folder.file("c.png")}).err;
  EXPECT_LE(count_of("has several ends", err), 1u) << err;
}

TEST(Doubts, OfAStartAreWarningsOfEveryCommandAndOfItsReport) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", short_scene("start: {q: [60, -30]}\n"));
  const std::string said = "WARNING: a: start.q: 60 of joint1 is in radians, 9.55 turns: for degrees write 60deg";
  const std::vector<Words> commands{{"simulate", scene, "-o", folder.file("a.csv")},
                                    {"render", scene, "-o", folder.file("a.mp4")},
                                    {"snapshot", scene, "-o", folder.file("a.png")},
                                    {"sheet", scene, "-o", folder.file("s.png")},
                                    {"energy", scene, "-o", folder.file("e.png"), "--methods", "rk4"},
                                    {"stability", scene, "--methods", "rk4"},
                                    {"dynamics", scene},
                                    {"sweep", scene, "--over", "start.qd.1=0,1", "-o", folder.file("t.csv")}};
  for (const Words& command : commands) {
    const ProgramResult run = run_program(with(command, {"--quiet"}));
    EXPECT_EQ(run.status, 0) << command[0] << run.err;
    EXPECT_THAT(line_with("start.q", run.err), HasSubstr(said)) << command[0];
  }
  const ProgramResult films = run_program({"sweep", scene, "--over", "torque.1=0", "-o", folder.file("films/"), "--each", "png", "--quiet"});
  EXPECT_THAT(films.err, HasSubstr("WARNING: torque.1=0: a: start.q: 60 of joint1")) << "of the run";
  const Json report = Json::parse(run_program({"simulate", scene, "-o", folder.file("j.csv"), "--json"}).out);
  ASSERT_EQ(report["warnings"].size(), 2u) << "one a joint";
  EXPECT_EQ(report["warnings"][0]["kind"], "scene");
  EXPECT_THAT(report["warnings"][0]["what"].get<std::string>(), HasSubstr("60deg"));
  const ProgramResult meant = run_program({"simulate", scene, "--set", "start.q=[60deg, -30deg]", "-o", folder.file("m.csv"), "--quiet"});
  EXPECT_EQ(meant.err, "") << "negative control";
}

TEST(Doubts, OfGravityAcrossThePlaneOfTheChain) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", short_scene("gravity: [0, 0, -9.81]\n"));
  const auto said = [&](const std::string& gravity) {
    return run_program({"simulate", scene, "--set", "gravity=" + gravity, "-o", folder.file("a.csv"), "--force", "--quiet"}).err;
  };
  EXPECT_THAT(said("[0, 0, -9.81]"), HasSubstr("WARNING: a: gravity [0, 0, -9.81] is perpendicular to the plane in which the chain moves"));
  EXPECT_THAT(said("[0, 0, 1.62]"), HasSubstr("write gravity: [0, -1.62, 0], for none [0, 0, 0]"));
  // What is advised is silent, and so is a plane that is inclined, and a chain in space.
  for (const char* gravity : {"[0, -9.81, 0]", "[0, 0, 0]", "[0, -1, -9]"}) EXPECT_EQ(said(gravity), "") << gravity;
  EXPECT_EQ(run_program({"simulate", scene, "--set", "model=" + kRoot + "/models/arm.urdf", "-o", folder.file("b.csv"), "--quiet"}).err, "");
  EXPECT_THAT(run_program({"dynamics", "models/rr.urdf", "--gravity", "0,0,-9.81", "--json"}).err, HasSubstr("WARNING: gravity [0, 0, -9.81] is"));
  EXPECT_EQ(run_program({"dynamics", "models/rr.urdf", "--gravity", "0,-9.81,0", "--json"}).err, "");
}

TEST(Doubts, OfLimitsThatTheModelDoesNotHave) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", "model: {links: [0.5, 0.4], masses: [2, 1]}\nduration: 0.1\nmethod: rk4\ntorque: [141, 0]\n");
  const auto said = [&](const std::string& set) {
    return run_program({"simulate", scene, "--set", set, "-o", folder.file("a.csv"), "--force", "--quiet"}).err;
  };
  EXPECT_THAT(said("limit=clamp"), HasSubstr("WARNING: a: limit: clamp cuts nothing, as no joint of the model has a limit of its effort"));
  EXPECT_THAT(said("limit=stop"), HasSubstr("WARNING: a: limit: stop stops nothing"));
  EXPECT_EQ(said("limit=report"), "");
  const ProgramResult check = run_program({"check", scene, "--set", "limit=clamp"});
  EXPECT_THAT(check.err, HasSubstr("WARNING: a: limit: clamp cuts nothing"));
  // As advised: the torque is cut, which is said, and the joints keep all their way.
  const Words limited{"simulate", scene, "--set", "model={links: [0.5, 0.4], masses: [2, 1], joints: RP, efforts: 20}", "--set", "limit=clamp",
                      "-o", folder.file("c.csv"), "--columns", "t,tau", "--force"};
  const ProgramResult cut = run_program(limited);
  EXPECT_EQ(cut.status, 0) << cut.err;
  EXPECT_THAT(cut.err, HasSubstr("a: joint 'joint1' passed its effort limit 20 with 141 at t = 0 s: by limit: clamp, torques beyond it are cut"));
  EXPECT_THAT(cut.err, Not(HasSubstr("position limit")));
  EXPECT_EQ(run_program(with(limited, {"--quiet"})).err, "");
}

// CI may take a WARNING for an error; what is acknowledged is none.
TEST(Doubts, FailWhereThatIsAskedFor) {
  const TemporaryFolder folder;
  const Words drifts{"simulate", "assets/scenes/rr_free.yaml", "-o", folder.file("a.csv"), "--force", "--quiet"};
  EXPECT_EQ(run_program(drifts).status, 0);
  const ProgramResult failed = run_program(with(drifts, {"--warnings", "fail"}));
  EXPECT_EQ(failed.status, 1);
  EXPECT_THAT(failed.err, AllOf(HasSubstr("WARNING: rr_free: the energy is off"), HasSubstr("1 WARNING above")));
  EXPECT_FALSE(read_whole_file(folder.file("a.csv")).empty());
  EXPECT_EQ(run_program(drifts, {.environment = {{"CHAINREEL_WARNINGS", "fail"}}}).status, 1);
  EXPECT_EQ(run_program(with(drifts, {"--warnings", "fail", "--set", "acknowledge=[energy]"})).status, 0);
  EXPECT_EQ(run_program(with(drifts, {"--warnings", "fail", "--set", "duration=0.1"})).status, 0) << "negative control";
  EXPECT_EQ(run_program(with(drifts, {"--warnings", "maybe"})).status, 2);
}

// A script asks by the exit code whether joints stay within their limits.
TEST(Doubts, ThatALimitIsPassedIsAnErrorWhereTheSceneExpectsNone) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", "model: {links: [0.5, 0.4], masses: [2, 1], efforts: 20}\nduration: 0.1\nmethod: rk4\ntorque: [19, 0]\nexpect: within_limits\n"
                                                   "video: {width: 320, height: 180}\n");
  const auto run = [&](const std::string& torque, const Words& more) {
    return run_program(with(with({"simulate", scene, "-o", folder.file("a.csv"), "--force", "--quiet", "--set", "torque.1=" + torque}, more), {}));
  };
  EXPECT_EQ(run("19", {}).status, 0);
  EXPECT_EQ(run("21", {"--set", "limit=clamp"}).status, 0) << "the torque is cut as it is asked to be";
  for (const char* limit : {"report", "stop"}) {
    const ProgramResult passed = run("21", {"--set", std::string("limit=") + limit});
    EXPECT_EQ(passed.status, 7) << limit;
    EXPECT_THAT(passed.err, HasSubstr("joint 'joint1' passed its effort limit 20 with 21 at t = 0 s: `expect: within_limits` stands there")) << limit;
  }
  EXPECT_EQ(run("21", {"--set", "expect=finish"}).status, 0) << "negative control";
  const ProgramResult film = run_program({"render", scene, "--set", "torque.1=21", "-o", folder.file("a.mp4"), "--json"});
  EXPECT_EQ(film.status, 7);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.mp4")));
  const Json told = Json::parse(film.out)["films"][0];
  EXPECT_EQ(told["limits_passed"].size(), 1u);
  EXPECT_EQ(told["files"].size(), 0u);
  EXPECT_EQ(run_program({"snapshot", scene, "--set", "torque.1=21", "--at", "0.05", "-o", folder.file("a.png")}).status, 7) << "passed before";
  EXPECT_EQ(run_program({"snapshot", scene, "--set", "torque.1=21 * (t > 0.08)", "--at", "0.05", "-o", folder.file("b.png"), "--quiet"}).status, 0) << "passed behind it";
  ASSERT_EQ(run_program({"sweep", scene, "--over", "torque.1=19,21", "-o", folder.file("s.csv"), "--quiet"}).status, 7);
  EXPECT_THAT(read_whole_file(folder.file("s.csv")), AllOf(HasSubstr("\n0,19,1,"), HasSubstr("\n1,21,0,")));
  EXPECT_THAT(run_program({"check", scene, "--set", "model={links: [0.5, 0.4], masses: [2, 1]}"}).err, HasSubstr("expect: within_limits is always fulfilled"));
}

// `simulate` and `render` say the same of one run.
TEST(Doubts, LimitsAndEarlyEndsAreSaidOfTablesAsOfFilms) {
  const TemporaryFolder folder;
  const std::string model = kRoot + "/models/arm.urdf";
  const std::string scene = folder.write("a.yaml", "model: " + model + "\nduration: 0.2\nmethod: rk4\nvideo: {width: 320, height: 180}\nstart: {qd: [0, 30, 0, 0, 0, 0]}\n"
                                                   "events: [{when: \"t > 0.15\", kind: stop, name: late}]\n");
  const auto lines = [&](const std::string& command, const std::string& ending, const std::string& set) {
    const ProgramResult run = run_program({command, scene, "--set", set, "-o", folder.file("a" + ending), "--force"});
    EXPECT_EQ(run.status, 0) << run.err;
    std::string found;
    for (std::size_t begin = 0; begin < run.err.size(); begin = run.err.find('\n', begin) + 1) {
      const std::string line = run.err.substr(begin, run.err.find('\n', begin) - begin);
      if (line.find("passed its") != std::string::npos || line.find("stopped:") != std::string::npos) found += line + "\n";
    }
    return found;
  };
  for (const char* set : {"limit=report", "limit=stop", "limit=clamp"}) {
    const std::string said = lines("simulate", ".csv", set);
    EXPECT_THAT(said, HasSubstr("a: stopped: ")) << set;
    EXPECT_THAT(said, HasSubstr("limit")) << set;
    EXPECT_EQ(said, lines("render", ".mp4", set)) << set;
  }
  EXPECT_EQ(lines("simulate", ".csv", "start.qd=[0, 0, 0, 0, 0, 0]").find("passed"), std::string::npos) << "negative control";
}

TEST(Doubts, OfLogsWithoutUnits) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& table, const std::string& more) {
    folder.write("log.csv", table);
    const std::string scene = folder.write("a.yaml", "model: " + kRoot + "/models/rr.urdf\nmotion: " + more + "\n");
    return run_program({"simulate", scene, "-o", folder.file("a.csv"), "--force", "--quiet"}).err;
  };
  const std::string rows = ",10\n0.5,2,11\n1,4.5,12\n1.5,7,12\n2,8,12\n";  // no jumps, which are refused
  EXPECT_THAT(said("t,q1,q2\n0,0" + rows, "log.csv"), HasSubstr("WARNING: a: 'q1' of "));
  EXPECT_THAT(said("t,q1,q2\n0,0" + rows, "log.csv"), HasSubstr("for degrees its header is 'q1 [deg]', for radians 'q1 [rad]'"));
  EXPECT_EQ(said("t,q1 [deg],q2 [deg]\n0,0" + rows, "log.csv"), "") << "negative control";
  const std::string slow = "0,0,0\n20,0.1,0.1\n40,0.2,0.1\n60,0.2,0\n";
  EXPECT_THAT(said("t,q1,q2\n" + slow, "log.csv"), HasSubstr("are 20 s apart: is 't' in seconds? For milliseconds its header is 't [ms]'"));
  EXPECT_EQ(said("t [ms],q1,q2\n" + slow, "log.csv"), "");
  EXPECT_EQ(said("\"stamp [ms]\",\"q1\",q2\n" + slow, "{csv: log.csv, columns: {time: stamp}}"), "") << "names in quotes";
  EXPECT_THAT(said("t;q1;q2\n0;0;0\n1;0;0\n", "log.csv"), HasSubstr("separated by semicolons: chainreel reads tables separated by commas"));
  EXPECT_THAT(said("t,\"q1,q2\n0,0,0\n1,0,0\n", "log.csv"), HasSubstr("log.csv:1: a field begins with a quote"));
}

TEST(Doubts, OfNamesWithAnEndingThatAreNoFilesHere) {
  const TemporaryFolder folder;
  const RunOptions there{.folder = folder.path().string()};
  EXPECT_THAT(run_program({"dynamics", "rr.urdf"}, there).err, HasSubstr("note: there is no file rr.urdf here: the program's own is taken, "));
  EXPECT_EQ(run_program({"dynamics", "rr.urdf", "--quiet"}, there).err, "");
  EXPECT_THAT(run_program({"check", "pen.yaml", "--json"}, there).err, HasSubstr("there is no file pen.yaml here"));
  EXPECT_THAT(run_program({"check", "pen", "--json"}, there).err, Not(HasSubstr("here: the program's own"))) << "a plain name is meant so";
  EXPECT_THAT(run_program({"dynamics", kRoot + "/models/rr.urdf"}, there).err, Not(HasSubstr("note:")));
}

// Friction at rest has no sign of its own: the first row has the torque with which the motion begins.
TEST(StartAtACorner, HasTheTorqueOfWhatFollows) {
  const TemporaryFolder folder;
  const auto first_torque = [&](const std::string& load) {
    const std::string scene = folder.write("a.yaml", "model: {links: [0.5], masses: [1]}\ngravity: [0, 0, 0]\nduration: 0.1\nmethod: dop853\n"
                                                     "tolerance: 1e-8\ntorque: [\"" + load + " + (qd1<0) - (qd1>0)\"]\n");
    const Json state = Json::parse(run_program({"dynamics", scene, "--at", "0", "--json"}).out);
    const std::string table = run_program({"simulate", scene, "--columns", "tau", "-o", "-", "--quiet"}).out;
    EXPECT_NEAR(std::stod(table.substr(table.find('\n') + 1)), state["tau"][0].get<double>(), 1e-15);
    return state["tau"][0].get<double>();
  };
  // A slip against 1 N m; below that it is held, and nothing acts in sum.
  EXPECT_NEAR(first_torque("1.12"), 0.12, 1e-15);
  EXPECT_NEAR(first_torque("-1.5"), -0.5, 1e-15);
  EXPECT_NEAR(first_torque("0.5"), 0, 1e-12);
}

// A name for which no file lies beside the scene is one of the program's own models: that is no silence.
TEST(Doubts, ModelsThatLieNowhereBesideAreTold) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.yaml", "model: rr.urdf\nduration: 0.1\nmethod: rk4\nvideo: {width: 320, height: 180}\n");
  const std::string said = "there is no file rr.urdf beside " + scene + ": the program's own is taken";
  for (const Words& command : std::vector<Words>{{"render", scene, "-o", folder.file("a.png")}, {"simulate", scene, "-o", folder.file("a.csv")}, {"check", scene}})
    EXPECT_EQ(count_of(said, run_program(command).err), 1u) << command[0];
  const std::string suite = folder.write("ci.yaml", "scene: s.yaml\nat: [0]\n");
  EXPECT_THAT(run_program({"verify", suite, "--missing", "write"}).err, HasSubstr(said));
  const std::string models = folder.write("models.yaml", "model: rr.urdf\nposes: {home: [0, 0]}\n");
  EXPECT_THAT(run_program({"verify", models, "--missing", "write"}).err, HasSubstr("there is no file rr.urdf beside " + models));
  folder.write("rr.urdf", read_whole_file(kRoot + "/models/rr.urdf"));
  EXPECT_EQ(run_program({"simulate", scene, "-o", folder.file("b.csv"), "--quiet"}).err, "") << "negative control";
  EXPECT_THAT(run_program({"render", "assets/scenes/rr_free.yaml", "--at", "0", "-o", folder.file("c.png")}).err, Not(HasSubstr("there is no file")));
}

// Tables that torques follow are asked for their units as those of a motion are.
TEST(Doubts, DegreesOfAFollowedTableAreTold) {
  const TemporaryFolder folder;
  std::string rows = "t,q1,q2\n";
  for (int k = 0; k <= 20; ++k) rows += std::to_string(0.05 * k) + "," + std::to_string(30 * std::sin(0.05 * k)) + ",0\n";
  folder.write("deg.csv", rows);
  for (const char* torque : {"{inverse_of: deg.csv, outside: hold}", "{pd: {kp: 10, kd: 1, trajectory: deg.csv, outside: hold}}"}) {
    const std::string scene = folder.write("a.yaml", short_scene("torque: " + std::string(torque) + "\n"));
    EXPECT_THAT(run_program({"simulate", scene, "-o", folder.file("a.csv"), "--force", "--quiet"}).err,
                HasSubstr("goes to 25.24, which is in radians, 4.02 turns: for degrees its header is 'q1 [deg]'"))
        << torque;
  }
  rows.replace(rows.find("q1"), 2, "q1 [rad]");
  folder.write("deg.csv", rows);
  const std::string meant = folder.write("a.yaml", short_scene("torque: {inverse_of: deg.csv, outside: hold}\n"));
  EXPECT_THAT(run_program({"simulate", meant, "-o", folder.file("a.csv"), "--force", "--quiet"}).err, Not(HasSubstr("which is in radians"))) << "negative control";
}

TEST(Doubts, DegreesOfATargetAreTold) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& q) {
    const std::string scene = folder.write("a.yaml", short_scene("torque: {pd: {kp: 10, kd: 1, q: " + q + "}}\n"));
    return run_program({"simulate", scene, "-o", folder.file("a.csv"), "--force", "--quiet"}).err;
  };
  EXPECT_THAT(said("[90, 0]"), HasSubstr("torque.pd.q: 90 of joint1 is in radians, 14.3 turns: for degrees write 90deg"));
  EXPECT_THAT(said("[90deg, 0]"), Not(HasSubstr("radians"))) << "negative control";
  EXPECT_THAT(said("[\"3 * t\", 1.5]"), Not(HasSubstr("radians")));
}

// What speaks against one run of a sweep stands in its row.
TEST(Doubts, OfOneRunOfASweepStandInItsRow) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a.yaml", short_scene(""));
  ASSERT_EQ(run_program({"sweep", scene, "--over", "start.q.1=0,90", "-o", folder.file("t.csv")}).status, 0);
  const std::string table = read_whole_file(folder.file("t.csv"));
  EXPECT_THAT(table, HasSubstr("doubtful: start.q: 90 of joint1 is in radians"));
  EXPECT_EQ(count_of("doubtful", table), 1u);
}

// A chain that its constraints hold altogether ended the program.
TEST(Doubts, AreNoneOfAChainWithoutFreedom) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("z.yaml", "model: {links: [1], masses: [1]}\nconstraints: [{joint: {name: joint1, value: 0}}]\nduration: 0.2\nvideo: {width: 320, height: 180}\n");
  const ProgramResult run = run_program({"simulate", scene, "-o", folder.file("z.csv"), "--columns", "t,lambda", "--quiet"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(read_whole_file(folder.file("z.csv")), HasSubstr("\n0,-4.90")) << "m g L / 2";
  for (const Words& command : std::vector<Words>{{"render", scene, "-o", folder.file("z.mp4")}, {"snapshot", scene, "-o", folder.file("z.png")}, {"sheet", scene, "-o", folder.file("s.png")}, {"stability", scene, "--methods", "rk4"}})
    EXPECT_EQ(run_program(with(command, {"--quiet"})).status, 0) << command[0];
}

// The rate of 1 / (t - 0.05) has no value behind 0.05 s, whatever steps go over it.
TEST(Doubts, OfWorkThatIsNoNumberAreTold) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("p.yaml", "model: {links: [0.5], masses: [2]}\ntorque: ['1/(t-0.05)']\nduration: 0.1\nmethod: gauss4\nstep: 1ms\nvideo: {width: 320, height: 180}\n");
  EXPECT_THAT(run_program({"simulate", scene, "-o", folder.file("t.csv"), "--quiet"}).err, HasSubstr("the work of the torques is no number from t = 0.05 s on"));
  EXPECT_THAT(run_program({"simulate", scene, "--set", "duration=0.04", "-o", folder.file("u.csv"), "--quiet"}).err, Not(HasSubstr("no number"))) << "negative control";
  EXPECT_THAT(run_program({"energy", scene, "--methods", "gauss4", "-o", folder.file("e.csv")}).out, AllOf(HasSubstr("inf"), HasSubstr("work is no number")));
  const ProgramResult chart = run_program({"chart", scene, "--methods", "rk4", "--runs", "1", "-o", folder.file("c.csv")});
  EXPECT_EQ(chart.status, 5) << "and ends";
  EXPECT_THAT(chart.err, HasSubstr("no reference"));
}

// Where `auto` promises nothing any more, a quiet program says so, too.
TEST(Doubts, OfWhatAutoPromisesAreTold) {
  const TemporaryFolder folder;
  const ProgramResult told = run_program({"simulate", "rrr_torque", "--set", "acknowledge=[]", "-o", folder.file("t.csv"), "--quiet"});
  EXPECT_EQ(told.status, 0);
  EXPECT_THAT(told.err, AllOf(HasSubstr("WARNING: rrr_torque: method: auto promises"), HasSubstr("take --set duration=")));
  EXPECT_EQ(run_program({"simulate", "rrr_torque", "-o", folder.file("u.csv"), "--quiet"}).err, "") << "acknowledged";
  EXPECT_EQ(run_program({"simulate", "rrr_free", "-o", folder.file("v.csv"), "--quiet"}).err, "") << "negative control";
}

// Words of a URDF that are not read but were likely meant are told by every command that reads it.
TEST(Doubts, OfSlipsInAModelAreToldByEveryCommand) {
  const TemporaryFolder folder;
  const auto model = [](const std::string& dynamics, const std::string& origin = "") {
    return "<robot name=\"a\"><link name=\"base\"/><link name=\"b\"><inertial>" + origin + "<origin xyz=\"0.3 0 0\"/><mass value=\"1\"/><inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" iyz=\"0\" izz=\"0.1\"/></inertial></link>\n"
           "<joint name=\"j\" type=\"continuous\"><parent link=\"base\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/><dynamics " + dynamics + "/></joint></robot>\n";
  };
  folder.write("a.urdf", model("dampping=\"100\""));
  folder.write("good.urdf", model("damping=\"100\""));
  folder.write("two.urdf", model("damping=\"1\"", "<origin xyz=\"0 0 0\"/>"));
  const std::string scene = folder.write("s.yaml", "model: a.urdf\nduration: 0.1\nmethod: rk4\nvideo: {width: 320, height: 180}\n");
  for (const Words& command : std::vector<Words>{{"simulate", scene, "-o", folder.file("t.csv")}, {"render", scene, "-o", folder.file("t.mp4")}, {"dynamics", folder.file("a.urdf")},
                                                 {"snapshot", folder.file("a.urdf"), "-o", folder.file("s.png")}, {"ellipse", folder.file("a.urdf"), "--pose", "0.1", "-o", folder.file("e.svg")},
                                                 {"equations", folder.file("a.urdf"), "-o", folder.file("e.tex")}})
    EXPECT_THAT(run_program(with(command, {})).err, HasSubstr("a.urdf:2: joint 'j': the attribute 'dampping' of <dynamics> is not read: did you mean 'damping'?")) << command[0];
  EXPECT_EQ(run_program({"simulate", scene, "--set", "model=good.urdf", "-o", folder.file("u.csv"), "--quiet"}).err, "") << "negative control";
  folder.write("limit.urdf", model("/><limit lower=\"-1\" upper=\"1\" effort=\"-10\" velocity=\"1\""));
  const ProgramResult limit = run_program({"dynamics", folder.file("limit.urdf")});
  EXPECT_EQ(limit.status, 3);
  EXPECT_THAT(limit.err, HasSubstr("has a limit of effort below zero"));
  const ProgramResult two = run_program({"dynamics", folder.file("two.urdf")});
  EXPECT_EQ(two.status, 3);
  EXPECT_THAT(two.err, HasSubstr("two.urdf:1: link 'b' has more than one <origin>: keep one"));
}

// Where links of a loop come to lie on one line, no method knows the way on, and each said another one without a word.
TEST(Doubts, OfAChangePointAreToldByEveryMethod) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("cp.yaml", "model: {links: [0.3, 0.6, 0.4], masses: [1, 1, 1]}\ngravity: [0, 0, 0]\nstart: {q: {joint1: 90deg}, qd: {joint1: 3}}\n"
                                                    "constraints: [{point: {frame: gripper, at: [0.7, 0]}}]\nduration: 2\nvideo: {width: 320, height: 180}\n");
  for (const char* method : {"method=auto", "method=rk4", "method=dop853", "method=radau5", "method=semi_implicit_euler"}) {
    const std::string err = run_program({"simulate", scene, "--set", method, "-o", folder.file("t.csv"), "--force", "--quiet"}).err;
    EXPECT_THAT(err, HasSubstr("WARNING: cp: at t = 0.55")) << method;
    EXPECT_THAT(err, HasSubstr("depend on each other")) << method;
    EXPECT_THAT(err, HasSubstr("take --set duration=0.54")) << method;
    const std::string before = run_program({"simulate", scene, "--set", method, "--set", "duration=0.54", "-o", folder.file("t.csv"), "--force", "--quiet"}).err;
    EXPECT_EQ(before, "") << method << ": the remedy as it stands";
  }
  EXPECT_THAT(run_program({"energy", scene, "--methods", "rk4", "-o", folder.file("e.csv"), "--quiet"}).err, HasSubstr("depend on each other"));
  EXPECT_THAT(run_program({"dynamics", scene, "--at", "1"}).err, HasSubstr("WARNING: cp: at t = 0.55"));
  EXPECT_THAT(run_program({"dynamics", scene, "--at", "0.5"}).err, Not(HasSubstr("depend on each other"))) << "it ends before";
  EXPECT_EQ(run_program({"simulate", scene, "--set", "acknowledge=[rank, energy, samples, step, accuracy]", "-o", folder.file("t.csv"), "--force", "--quiet"}).err, "");
}

}  // namespace
}  // namespace chainreel
