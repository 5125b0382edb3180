// `fall`: the table of fall times, and what events are to films and audits.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

constexpr char kHuman[] = "assets/scenes/humanoid_fall.yaml";

// PP falls freely from rest: through -1 m after sqrt(2/g).
constexpr char kFallingScene[] =
    "model: " CHAINREEL_SOURCE_FOLDER
    "/models/pp.urdf\nduration: 2\nmethod: rk4\nstep: 0.01\n"
    "title: \"Falls in {fall}\"\ntorque: [0, 0]\n"
    "events: [{when: \"q2 < -0.5\", name: half}, {when: \"q2 < -1\", kind: fall, name: down}]\n";

TEST(FallCommand, PrintsATableAgainstTheParameter) {
  const ProgramResult result = run_program({"fall", kHuman, "--sweep", "parameters.k=0:1200:7"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("parameters.k"));
  EXPECT_THAT(result.out, HasSubstr("falls at, s"));
  EXPECT_THAT(result.out, HasSubstr("centre of pressure leaves the foot, s"));
  EXPECT_THAT(result.out, testing::AnyOf(HasSubstr("stands for 5 s"), HasSubstr("not down within 5 s")));
  EXPECT_THAT(result.out, HasSubstr("hip where the knee was: when y_H < 0.5"));
}

TEST(FallCommand, SaysThatHeStandsOnlyWhileThePressureIsWithinTheFoot) {
  // With k the ankle holds him up; from where the pressure leaves the foot on, only since the foot is glued.
  const ProgramResult result = run_program({"fall", kHuman, "--sweep", "parameters.k=0:1200:7", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  int standing = 0, held = 0;
  const Json json = Json::parse(result.out);
  for (const Json& row : json["rows"]) {
    const bool left = !row["first"][0].is_null(), down = !row["fall_time"].is_null();
    EXPECT_EQ(row["stands"].get<bool>(), !left && !down) << row.dump();
    ASSERT_EQ(row["tips_at"].is_null(), !left);
    if (left) {
      EXPECT_NEAR(row["tips_at"].get<double>(), row["first"][0].get<double>(), 1e-9);
      EXPECT_EQ(row["tips_over"], "toe");
      EXPECT_EQ(row["falls"], down ? Json("forwards") : Json(nullptr));
    }
    standing += !left && !down, held += left && !down;
    if (!left || down) continue;
    // A film of that run does not say that he does not fall: a real one has tipped.
    const TemporaryFolder folder;
    const ProgramResult still = run_program({"snapshot", kHuman, "--set", "title=He falls in {fall}", "--set", "parameters.k=" + row["value"].dump(), "--at", "3", "--json", "-o",
                                             folder.file("h.png"), "--quiet"});
    ASSERT_EQ(still.status, 0) << still.err;
    EXPECT_THAT(still.out, HasSubstr("He tips at ")) << row.dump();
    EXPECT_THAT(still.out, HasSubstr(" s, not down within 5 s"));
  }
  EXPECT_GT(standing, 0);
  EXPECT_GT(held, 0);
  // Outside from the start on: an event would wait there, the verdict does not.
  const ProgramResult text =
      run_program({"fall", kHuman, "--set", "foot={heel: -0.2, toe: -0.1}", "--set", "parameters.k=1200"});
  EXPECT_THAT(text.out, HasSubstr("tips over the toe at 0.0000, not down within 5 s"));
}

// The closed form: from rest it is down after sqrt(2 h / g), so that within 2 s it falls by 19.62 m and no more.
TEST(FallCommand, FindsTheValueAtWhichTheEndChanges) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("depth.yaml", "model: " CHAINREEL_SOURCE_FOLDER
                                                       "/models/pp.urdf\nduration: 2\nmethod: rk4\nstep: 0.01\ntorque: [0, 0]\nparameters: {h: 1}\n"
                                                       "events: [{when: \"q2 + h < 0\", kind: fall, name: down}]\n");
  const auto edges = [&](const std::string& sweep) {
    const ProgramResult result = run_program({"fall", scene, "--sweep", sweep, "--edges", "--json"});
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(result.out)["edges"];
  };
  for (const char* sweep : {"parameters.h=1:41:5", "parameters.h=41:1:5"}) {
    const Json found = edges(sweep);
    ASSERT_EQ(found.size(), 1u) << sweep;
    const double before = found[0]["before"], behind = found[0]["behind"];
    EXPECT_LE(std::min(before, behind), 0.5 * 9.81 * 4);
    EXPECT_GE(std::max(before, behind), 0.5 * 9.81 * 4);
    EXPECT_LE(std::abs(behind - before), 10 * 1e-4) << "of the distance of rows";
  }
  EXPECT_TRUE(edges("parameters.h=1,2,3").empty());
  EXPECT_THAT(run_program({"fall", scene, "--sweep", "parameters.h=1:41:5", "--edges"}).out,
              HasSubstr("parameters.h = 19.6203 (within 0.0004): from 'falls' to 'does not fall' in runs of 2 s, between the rows 11 and 21"));
  const std::string table = folder.file("edges.csv");
  run_program({"fall", scene, "--sweep", "parameters.h=1:41:5", "--edges", "-o", table});
  EXPECT_THAT(read_whole_file(table), HasSubstr("# edge: parameters.h = 19.62"));
  EXPECT_THAT(run_program({"fall", scene, "--edges"}).err, HasSubstr("--edges looks between the numbers of --sweep"));
  // Whole numbers stay whole; lists may have units; ends are told apart by where they lie and what stopped them.
  const auto told = [&](const Words& more) {
    const ProgramResult run = run_program(with({"fall", scene, "--edges"}, more));
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out;
  };
  EXPECT_THAT(told({"--set", "method=taylor", "--set", "model=rr.urdf", "--set", "step=null", "--set", "tolerance=1e-6", "--sweep", "order=12:30:3"}), HasSubstr("no edges: all rows end alike"));
  EXPECT_THAT(run_program({"fall", kHuman, "--sweep", "start.q.1=-3deg,3deg", "--edges"}).out, HasSubstr("from 'falls forwards' to 'falls backwards'"));
  // Swinging on and on it comes over the top at last, or never, as one may not foresee.
  const std::string swings = folder.write("swings.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nstart: {q: [-90deg, 0], qd: [0, 0]}\nduration: 10\nmethod: dop853\n"
                                                         "tolerance: 1e-11\nevents: [{when: \"q1 > 90deg\", kind: fall, name: over}]\n");
  EXPECT_THAT(run_program({"fall", swings, "--sweep", "start.qd.1=3:9:7", "--edges"}).err, HasSubstr("the end changes more often between"));
  // What only has not fallen yet does not stand: the edge is the duration's.
  const std::string slow = folder.write("slow.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\nstart: {q: [90deg, 0], qd: [0, 0]}\nduration: 0.8\nmethod: dop853\n"
                                                     "tolerance: 1e-11\nevents: [{when: \"q1 > 120deg\", kind: fall, name: over}]\n");
  const ProgramResult topples = run_program({"fall", slow, "--sweep", "start.q.1=91deg:119deg:2", "--edges"});
  EXPECT_THAT(topples.out, HasSubstr("in runs of 0.8 s, between the rows"));
  EXPECT_THAT(topples.err, HasSubstr("is that of the duration: at start.q.1 = "));
  EXPECT_THAT(topples.err, HasSubstr("a run of 1.6 s ends with 'falls'"));
  // Rows far apart do not hide it; and of what cannot run longer that is said.
  const std::string sprung = folder.write("sprung.yaml", "model: {links: [1], masses: [1], joints: R}\nstart: {q: [91deg]}\ntorque: [\"-K * (q1 - 1.5707963)\"]\n"
                                                         "parameters: {K: 0}\nduration: 3\nmethod: dop853\ntolerance: 1e-10\nevents: [{when: \"abs(q1 - 1.5707963) > 1\", kind: fall, name: over}]\n");
  EXPECT_THAT(run_program({"fall", sprung, "--sweep", "parameters.K=0:2000:3", "--edges"}).err, HasSubstr("is that of the duration"));
  EXPECT_THAT(run_program({"fall", slow, "--sweep", "duration=0.2:1:3", "--edges"}).err, Not(HasSubstr("is that of the duration")));
  // A film of a fall says that its foot is held, where a real one turns; one that stands says nothing of it.
  const Words small{"--set", "video.width=96", "--set", "video.height=54", "--force", "-o", folder.file("f.gif")};
  EXPECT_THAT(run_program(with({"render", kHuman}, small)).err, HasSubstr("a real one turns from there on, this one is held"));
  EXPECT_THAT(read_whole_file(folder.file("f.txt")), HasSubstr("a real one turns from there on, this one is held"));
  EXPECT_THAT(run_program({"fall", kHuman}).out, HasSubstr("the time of the fall is that of a foot that is held"));
  EXPECT_THAT(run_program(with({"render", kHuman, "--set", "parameters.k=1200"}, small)).err, Not(HasSubstr("this one is held")));
  // A foot has two edges between these rows: not down any more, and standing.
  const ProgramResult of_human = run_program({"fall", kHuman, "--sweep", "parameters.k=0:1200:2", "--edges", "--json"});
  EXPECT_THAT(of_human.err, Not(HasSubstr("is that of the duration")));
  const Json human = Json::parse(of_human.out)["edges"];
  ASSERT_EQ(human.size(), 2u);
  EXPECT_EQ(human[0]["to"], human[1]["from"]);
  EXPECT_EQ(human[1]["to"], "stands");
  const auto stands = [&](const Json& k) {
    return Json::parse(run_program({"fall", kHuman, "--set", "parameters.k=" + k.dump(), "--json"}).out)["rows"][0]["stands"];
  };
  EXPECT_FALSE(stands(human[1]["before"]));
  EXPECT_TRUE(stands(human[1]["behind"]));
}

// A table or picture of one value would be taken for that of another.
TEST(FallCommand, SaysWhatTheCommandLineSet) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("fall.yaml", std::string(kFallingScene) + "parameters: {k: 1}\nvideo: {width: 64, height: 36, fps: 20}\n");
  const ProgramResult told = run_program({"fall", scene, "--set", "parameters.k=200", "-o", folder.file("a.csv")});
  EXPECT_THAT(told.out, HasSubstr("with parameters.k=200"));
  EXPECT_THAT(read_whole_file(folder.file("a.csv")), HasSubstr("# set: parameters.k=200\n"));
  const auto title = [&](const Words& more) {
    const ProgramResult run = run_program(with({"simulate", scene, "-o", folder.file("b.csv"), "--force", "--json"}, more));
    return Json::parse(run.out)["title"].get<std::string>();
  };
  EXPECT_EQ(title({"--set", "parameters.k=200"}), "Falls in 0.45 s, k = 200");
  EXPECT_EQ(title({"--set", "parameters.k=200", "--set", "title=Mine"}), "Mine") << "whoever gives a title says all of it";
  EXPECT_EQ(title({}), "Falls in 0.45 s") << "what the file says is known to who reads it";
}

TEST(FallCommand, SaysWhatHoldsFromTheStart) {
  // A push so strong that the pressure is outside of the foot at once: as an event it waits, here it is no "never".
  const TemporaryFolder folder;
  const std::string csv = folder.file("push.csv");
  const ProgramResult result = run_program({"fall", kHuman, "--set", "parameters.k=600", "--set", "start.qd=[0, 0, 0]", "--sweep", "start.qd.1=0,-1", "-o", csv});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("from the start"));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("never   tips")));
  const std::string text = read_whole_file(csv);
  EXPECT_THAT(text, HasSubstr(",stands,tips_at [s],tips_over,falls,takes_off_at [s]\n"));
  EXPECT_THAT(text, HasSubstr(",false,0,toe,"));

  const std::string scene = folder.write("falling.yaml", kFallingScene);
  const ProgramResult lying = run_program({"fall", scene, "--set", "start.q=[0, -2]"});
  EXPECT_THAT(lying.out, HasSubstr("lies from the start"));
}

// Held still by its own torques, he leans until the ankle's is what the foot bears at rest: the sweep's edge against the torque
// of inverse dynamics there.
TEST(FallCommand, SaysWhatAFootBearsAtRest) {
  const ProgramResult fall = run_program({"fall", kHuman, "--set", "torque={gravity_compensation: true}", "--set", "start.qd=[0, 0, 0]", "--set", "duration=0.2",
                                          "--sweep", "start.q.1=-12.5deg:0:4", "--edges", "--json"});
  ASSERT_EQ(fall.status, 0) << fall.err;
  const Json found = parse_json(fall.out);
  ASSERT_EQ(found["edges"].size(), 1u);
  const std::string q = format_shortest(found["edges"][0]["before"].get<double>()) + ",0,0";
  const ProgramResult dynamics = run_program({"dynamics", "models/humanoid.urdf", "--q", q, "--json"});
  ASSERT_EQ(dynamics.status, 0) << dynamics.err;
  const double tau = std::abs(parse_json(dynamics.out)["nle"][0].get<double>());
  EXPECT_NEAR(found["rows"][0]["foot_bears"]["over_toe"].get<double>(), tau, 0.01) << "the edge is as narrow as 5e-6 rad, the torque changes by 700 N m/rad";
  EXPECT_NEAR(found["rows"][0]["foot_bears"]["over_heel"].get<double>() + found["rows"][0]["foot_bears"]["over_toe"].get<double>(), 195.8, 0.3) << "weight times the foot's length";
  // Of rows with other weights each has its own.
  const Json loaded = parse_json(run_program({"fall", kHuman, "--set", "duration=0.1", "--sweep", "payload.mass=0,40", "--json"}).out)["rows"];
  EXPECT_NEAR(loaded[1]["foot_bears"]["over_toe"].get<double>() - loaded[0]["foot_bears"]["over_toe"].get<double>(), 40 * 9.81 * 0.1995, 1e-9);
}

// 10 kg on a vertical slide above the middle of a foot: what drives it, F, is what the ground bears.
TEST(FallCommand, SaysWhoTakesOffAndWhen) {
  const TemporaryFolder folder;
  folder.write("hop.urdf",
               "<robot name=\"hop\"><link name=\"foot\"/><link name=\"body\"><inertial><mass value=\"10\"/>"
               "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>"
               "<joint name=\"up\" type=\"prismatic\"><parent link=\"foot\"/><child link=\"body\"/>"
               "<origin xyz=\"0.05 1 0\"/><axis xyz=\"0 1 0\"/>"
               "<limit lower=\"-100\" upper=\"100\" effort=\"10000\" velocity=\"100\"/></joint></robot>");
  const std::string scene = folder.write("hop.yaml",
                                         "model: hop.urdf\ngravity: [0, -9.81, 0]\nduration: 1\nparameters: {late: -100}\n"
                                         "torque: [\"200*(t<0.5)+late*(t>=0.5)\"]\nfoot: {heel: -0.1, toe: 0.1}\n"
                                         "events: [{when: \"y_G < -50\", kind: fall, name: down}]\n");
  const auto row_of = [&](const std::string& setting) {
    const ProgramResult result = run_program({"fall", scene, "--set", setting, "--json"});
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(result.out)["rows"][0];
  };
  const Json hops = row_of("parameters.late=-100"), stands = row_of("parameters.late=100");
  EXPECT_FALSE(hops["stands"].get<bool>());
  EXPECT_TRUE(hops["tips_at"].is_null()) << "the pressure never leaves the foot";
  EXPECT_NEAR(hops["takes_off_at"].get<double>(), 0.5, 2e-12) << "to what instants of events are found";
  EXPECT_TRUE(stands["stands"].get<bool>());
  EXPECT_TRUE(stands["takes_off_at"].is_null());
  // The zero of a force that changes without a jump.
  EXPECT_NEAR(row_of("torque=[150 - 200*t]")["takes_off_at"].get<double>(), 0.75, 2e-12);
  const Json pushed = row_of("torque=[-100]");
  EXPECT_FALSE(pushed["stands"].get<bool>());
  EXPECT_EQ(pushed["takes_off_at"], 0.0);

  const std::string csv = folder.file("hop.csv");
  const ProgramResult text = run_program({"fall", scene, "-o", csv});
  EXPECT_THAT(text.out, HasSubstr("takes off at 0.5000, not down within 1 s"));
  EXPECT_THAT(read_whole_file(csv), HasSubstr(",false,,,,0.5"));
}

TEST(FallCommand, GivesTheClosedFormInJsonAndCsv) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("falling.yaml", kFallingScene), csv = folder.file("fall.csv");
  const ProgramResult result =
      run_program({"fall", scene, "--sweep", "torque.2=0,2,40", "--json", "-o", csv});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json json = Json::parse(result.out);
  ASSERT_EQ(json["rows"].size(), 3u);
  for (const int k : {0, 1}) {
    const Json& row = json["rows"][std::size_t(k)];
    const double fall = 9.81 - row["value"].get<double>();  // of 1 kg
    EXPECT_NEAR(row["fall_time"].get<double>(), std::sqrt(2 / fall), 1e-11);
    EXPECT_NEAR(row["first"][0].get<double>(), std::sqrt(1 / fall), 1e-11);
    EXPECT_EQ(row["ended_by"], "down");
  }
  EXPECT_TRUE(json["rows"][2]["fall_time"].is_null()) << "40 N lift it";
  EXPECT_EQ(json["rows"][2]["status"], "finished");
  const std::string text = read_whole_file(csv);
  EXPECT_THAT(text, HasSubstr("torque.2,fall_time [s],status,end_time [s],\"half [s]\",\"down [s]\""));
  EXPECT_THAT(text, HasSubstr("40,,finished,2,,"));
}

// Against the key: instants of falls and of tipping, edges as lines with their numbers.
TEST(FallCommand, DrawsWhenHeFalls) {
  const TemporaryFolder folder;
  const Words sweep{"fall", "humanoid_fall", "--sweep", "parameters.k=0:1200:5", "--edges"};
  const auto with = [&](Words more) {
    Words words = sweep;
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  const ProgramResult drawn = with({"-o", folder.file("f.svg")});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  const std::string svg = read_whole_file(folder.file("f.svg"));
  EXPECT_THAT(svg, testing::AllOf(HasSubstr("down"), HasSubstr("foot tips"), HasSubstr("instant [s]"), HasSubstr("from '")));
  EXPECT_THAT(read_whole_file(folder.file("f.csv")), HasSubstr("parameters.k,fall_time [s]")) << "the numbers lie beside it";
  EXPECT_EQ(run_program({"check", folder.file("f.svg"), "--today"}).status, 0);
  EXPECT_THAT(svg, HasSubstr("When does it fall?"));
  const ProgramResult none = run_program({"fall", "humanoid_fall", "-o", folder.file("g.png")});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("--sweep"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("g.png")));
}

TEST(FallCommand, SaysWhatItNeeds) {
  const ProgramResult none = run_program({"fall", "assets/scenes/rr_free.yaml", "--sweep", "torque.1=0:1:2"});
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("rr_free.yaml: has no event of kind `fall`"));
  EXPECT_THAT(none.err, HasSubstr("events: [{when: \"y_G < 0.5\", kind: fall"));
  EXPECT_EQ(run_program({"fall", kHuman, "--sweep", "k"}).status, 2);
  EXPECT_EQ(run_program({"fall", kHuman, "-o", "x.txt"}).status, 2);
}

// The scale of the ground's reaction stands while there is one that a ground can give: it pushes while he stands, and at the
// end, where it had to pull, there is neither an arrow nor its scale.
// What holds the foot at the end has the same scale.
TEST(Events, TheGroundsScaleStandsWithItsArrow) {
  const TemporaryFolder folder;
  const auto picture_at = [&](const std::string& instant) {
    const std::string file = folder.file("a.svg");
    const ProgramResult result =
        run_program({"snapshot", "assets/scenes/humanoid_fall.yaml", "--at", instant, "-o", file, "--force", "--quiet"});
    EXPECT_EQ(result.status, 0) << result.err;
    return read_whole_file(file);
  };
  EXPECT_NE(picture_at("0.5").find("ground reaction"), std::string::npos);
  EXPECT_NE(picture_at("event hip where the knee was").find("ground reaction"), std::string::npos);
}

TEST(Events, AreInTheAuditWithNameTimeAndState) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("falling.yaml", kFallingScene), csv = folder.file("fall.csv");
  const ProgramResult result = run_program({"simulate", scene, "-o", csv, "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json json = Json::parse(result.out);
  const Json& report = json.is_array() ? json[0] : json;
  const double time = std::sqrt(2 / 9.81);
  EXPECT_EQ(report["status"], "stopped");
  EXPECT_EQ(report["title"], "Falls in 0.45 s");
  EXPECT_NEAR(report["fall_time"].get<double>(), time, 1e-11);
  ASSERT_EQ(report["events"].size(), 2u);
  EXPECT_EQ(report["events"][0]["name"], "half");
  EXPECT_EQ(report["events"][0]["kind"], "mark");
  EXPECT_EQ(report["events"][1]["name"], "down");
  EXPECT_NEAR(report["events"][1]["q"][1].get<double>(), -1, 1e-11);
  EXPECT_NEAR(report["events"][1]["qd"][1].get<double>(), -std::sqrt(2 * 9.81), 1e-10);
  EXPECT_LT(report["energy_error"].get<double>(), 1e-11);
  // The last row stands at the fall.
  std::string line, last;
  for (std::istringstream rows(read_whole_file(csv)); std::getline(rows, line);) last = line;
  EXPECT_NEAR(std::stod(last), time, 1e-11);
}

TEST(Events, LeadAutoNoFurtherThanToTheEnd) {
  const TemporaryFolder folder;
  const std::string plain = folder.write("plain.yaml", "model: " CHAINREEL_SOURCE_FOLDER
                                                       "/models/pp.urdf\nduration: 2\naccuracy: 1e-9 m\n"
                                                       "events: [{when: \"q2 < -1\", kind: fall}]\n");
  const ProgramResult run = run_program({"simulate", plain, "-o", folder.file("b.csv"), "--json", "--quiet"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_NEAR((json.is_array() ? json[0] : json)["fall_time"].get<double>(), std::sqrt(2 / 9.81), 1e-9);
}

// Of a scene whose layout holds one run: panels take another one, tell their falls, and leave the title above them open.
TEST(FallCommand, PanelsOfAVariedSceneTellWhetherTheyFall) {
  const TemporaryFolder folder;
  std::string text = read_whole_file(kHuman);
  text.replace(text.find("../../models"), std::string("../../models").size(), CHAINREEL_SOURCE_FOLDER "/models");
  const std::string scene = folder.write("human.yaml", text + "layout: scene\n");
  const Words words{"snapshot", scene, "--at", "3", "--vary", "parameters.k=0,930", "-o", folder.file("a.svg")};
  const ProgramResult made = run_program(words);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("layout 'scene' shows one run"));
  const std::string svg = read_whole_file(folder.file("a.svg"));
  EXPECT_THAT(svg, AllOf(HasSubstr("does not fall"), HasSubstr("falls in"), HasSubstr("falls in \u2026")));
  EXPECT_THAT(svg.substr(svg.find("</metadata>")), Not(HasSubstr("{fall}")));
  // A layout that is asked for is none that goes by in silence.
  EXPECT_EQ(run_program(with(words, {"--set", "layout=scene", "--force"})).status, 3);
}

}  // namespace
}  // namespace chainreel
