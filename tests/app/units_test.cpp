// Numbers with units of the wrong kind, lists with too few, words with colons: what is taken, and what is refused with the remedy.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "app/sweep/map_axes.hpp"
#include "core/json.hpp"
#include "model/model_description.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/read_scene.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kModels = std::string(CHAINREEL_SOURCE_FOLDER) + "/models/";

class Units : public testing::Test {
 protected:
  // `simulate` of rr for two steps with these settings.
  ProgramResult run(const Words& settings, const std::string& model = "rr.urdf") {
    const std::string scene = folder_.write("a.yaml", "model: " + kModels + model + "\nduration: 0.02\nmethod: rk4\n");
    Words words{"simulate", scene, "-o", folder_.file("a.csv"), "--force", "--json", "--quiet"};
    for (const std::string& setting : settings) words = with(words, {"--set", setting});
    return run_program(words);
  }
  std::string hash(const Words& settings, const std::string& model = "rr.urdf") {
    const ProgramResult result = run(settings, model);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.status == 0 ? Json::parse(result.out)["trajectory_sha256"].get<std::string>() : result.err;
  }
  void expect_refused(const Words& settings, const std::string& words, const std::string& model = "rr.urdf") {
    const ProgramResult result = run(settings, model);
    EXPECT_NE(result.status, 0) << settings[0];
    EXPECT_THAT(result.err, HasSubstr(words)) << settings[0];
  }

  TemporaryFolder folder_;
};

TEST_F(Units, OfAStateAreThoseOfItsJoints) {
  expect_refused({"start.q=[0.1, 90deg]"}, "90deg of joint2 is in the unit rad, but this is in m", "pp.urdf");
  expect_refused({"start.q=[4cm, 0]"}, "4cm of joint1 is in the unit m, but this is in rad");
  expect_refused({"start.qd=[0, 1m/s]"}, "1m/s of joint2 is in the unit m/s, but this is in rad/s");
  EXPECT_EQ(hash({"start.q=[4cm, 0.1]"}, "pp.urdf"), hash({"start.q=[0.04, 0.1 m]"}, "pp.urdf"));
  const auto dynamics = [](const std::string& flag, const std::string& numbers) {
    return run_program({"dynamics", kModels + "rr.urdf", flag, numbers});
  };
  for (const auto& [flag, numbers] : {std::pair{"--q", "4s,1kg"}, {"--q", "4cm,1m"}, {"--tau", "5deg,1"}, {"--qd", "1,2rad"}, {"--q", "joint2=1s"},
                                      {"--gravity", "0,-9.81m,0"}})
    EXPECT_EQ(dynamics(flag, numbers).status, 2) << flag << numbers;
  EXPECT_THAT(dynamics("--tau", "5deg,1").err, HasSubstr("5deg of joint1 is in the unit rad, but this is in N m"));
  for (const auto& [flag, numbers] : {std::pair{"--q", "4deg,1rad"}, {"--tau", "5 N m,1"}, {"--qd", "1deg/s,2"}, {"--gravity", "0,-9.81 m/s^2,0"}})
    EXPECT_EQ(dynamics(flag, numbers).status, 0) << flag << numbers;
}

TEST_F(Units, OfGainsAndOfModelsInNumbers) {
  expect_refused({"torque={pd: {kp: 60deg, kd: 1, q: 0}}"}, "'60deg' is in deg, but this is in N m/rad or N/m");
  expect_refused({"torque={computed_torque: {kp: 60, kd: 1s, q: 0}}"}, "but this is in 1/s");
  EXPECT_EQ(hash({"torque={pd: {kp: 60 N m/rad, kd: 1, q: 0}}"}), hash({"torque={pd: {kp: 60, kd: 1, q: 0}}"}));
  expect_refused({"model={links: [0.5, 0.4kg]}"}, "but this is in m");
  expect_refused({"model={links: [0.5, 0.4], masses: 2m}"}, "but this is in kg");
  expect_refused({"model={dh: [[0.5s, 0, 0, 0]]}"}, "but this is in m");
  EXPECT_EQ(hash({"model={links: [50cm, 0.4], masses: 2000 g}"}), hash({"model={links: [0.5, 0.4], masses: 2}"}));
}

TEST_F(Units, OfDegreesAreUnderstoodInAllExpressions) {
  EXPECT_EQ(hash({"torque={pd: {kp: 60, kd: 1, q: [45deg, 60deg]}}"}), hash({"torque={pd: {kp: 60, kd: 1, q: [45 * (pi / 180), 60 * (pi / 180)]}}"}));
  EXPECT_EQ(hash({"torque=[-10 * (q1 - 45deg), 0]"}), hash({"torque=[-10 * (q1 - (pi / 180) * 45), 0]"}));
  EXPECT_EQ(hash({"start.q=[45\u00b0, 10deg + 20deg]"}), hash({"start.q=[45deg, 30deg]"}));
  EXPECT_EQ(hash({"start.q=[2 * 45deg, 0]"}), hash({"start.q=[90deg, 0]"}));
  // What means one angle as a whole and another one to its last number.
  for (const char* angle : {"1 + 90deg", "90/2deg", "90deg + 1deg/s"}) EXPECT_NE(run({std::string("start.q=[") + angle + ", 0]"}).status, 0) << angle;
  expect_refused({"start.q=[90/2deg, 0]"}, "give each its own unit");
  expect_refused({"duration=10deg + 5"}, "is in rad, but this is in s");
}

TEST_F(Units, AListHasANumberForEach) {
  expect_refused({"torque={pd: {kp: 60, kd: 1, q: [1]}}"}, "'torque.pd.q' is a list of one entry, but the model");
  expect_refused({"torque={pd: {kp: [60], kd: 1, q: 0}}"}, "2 freedoms: write one for each, or one for all without brackets");
  for (const char* key : {"masses", "damping", "efforts"})
    expect_refused({std::string("model={links: [0.5, 0.4], ") + key + ": [2]}"}, "'model." + std::string(key) + "' is a list of one entry, but the chain has 2 links");
  // Of one freedom it is one each; and what is said of the scene, which remembers it, can be read again.
  EXPECT_EQ(run({"model={links: [0.5], masses: [2]}", "torque={pd: {kp: [60], kd: 1, q: [1]}}"}).status, 0);
  const std::string scene = folder_.write("b.yaml", "model: " + kModels + "rr.urdf\nmethod: rk4\ntorque: {pd: {kp: 60, kd: 1, q: 30deg}}\n");
  const ProgramResult check = run_program({"check", scene, "--json"});
  ASSERT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(Json::parse(check.out)["scene"].get<std::string>(), HasSubstr("kp: 60, kd: 1, q: 30deg"));
}

TEST_F(Units, SingleEntriesOfAListThatWasLeftOutStartFromTheDefault) {
  EXPECT_EQ(hash({"start.qd.1=-0.2"}), hash({"start.qd=[-0.2, 0]"}));
  EXPECT_EQ(hash({"start.q.2=90deg", "start.q.1=0.1"}), hash({"start.q=[0.1, 90deg]"}));
  EXPECT_EQ(hash({"gravity.2=-1.62"}), hash({"gravity=[0, -1.62, 0]"}));
  EXPECT_EQ(hash({"gravity.1=3"}), hash({"gravity=[3, -9.81, 0]"}));
  EXPECT_EQ(hash({"torque.1=5"}), hash({"torque=[5, 0]"}));
  EXPECT_EQ(hash({"torque.2=-q1"}), hash({"torque=[0, -q1]"}));
  expect_refused({"start.qd.3=1"}, "has 3 numbers");
  expect_refused({"start.qd.0=1"}, "counted from 1");
  expect_refused({"gravity.4=1"}, "three numbers");
  expect_refused({"torque.3=1"}, "'torque' has 3 entries");
  expect_refused({"start.q.1=4cm"}, "4cm of joint1");
  const std::string scene = folder_.write("s.yaml", "model: " + kModels + "rr.urdf\nduration: 0.02\n");
  for (const char* over : {"start.qd.1=0,-0.2", "gravity.2=-9.81,-1.62", "torque.1=0,5"})
    EXPECT_EQ(run_program({"sweep", scene, "--over", over, "-o", folder_.file("s.csv"), "--force"}).status, 0) << over;
}

// Of vectors, too, whose list may have been left out.
TEST_F(Units, SingleNumbersOfAVectorStandBesideItsDefaults) {
  const ProgramResult one = run_program({"check", "rr_free", "--set", "payload.mass=1", "--set", "payload.at.2=0.1"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("[0, 0.1, 0]"));
  EXPECT_THAT(run_program({"check", "rr_free", "--set", "payload.mass=1", "--set", "payload.at.4=0.1"}).err, HasSubstr("there is no '4'"));
  EXPECT_THAT(run_program({"check", "rr_free", "--set", "payload.mass=1", "--set", "payload.at=1"}).err, HasSubstr("x y z: [0.1, 0, 0]"));
}

TEST_F(Units, StartsAreWrittenByJointOrByPlace) {
  EXPECT_EQ(hash({"start.q.joint2=90deg", "start.qd.joint1=1"}), hash({"start.q=[0, 90deg]", "start.qd=[1, 0]"}));
  EXPECT_EQ(hash({"start.q={joint2: 90deg, 1: 0.1}"}), hash({"start.q=[0.1, 90deg]"}));
  EXPECT_NE(hash({"start.q.joint2=90deg"}), hash({"start.q.joint1=90deg"}));
  expect_refused({"start.q={joint2: 1, 2: 1}"}, "joint2 twice");
  expect_refused({"start.q.jont2=1"}, "did you mean 'joint2'");
  expect_refused({"start.q.joint2=[1, 2]"}, "takes 1 number, not 2");
  expect_refused({"start.q.joint1=4cm"}, "4cm of joint1");
  EXPECT_EQ(hash({"start.q={}"}), hash({}));
  // A joint's name that is a number is no place in the list.
  std::string urdf = read_whole_file(kModels + "rr.urdf");
  for (std::size_t at = 0; (at = urdf.find("\"joint", at)) != std::string::npos; ++at) urdf.erase(at + 1, 5);
  const std::string numbered = folder_.write("numbered.urdf", urdf);
  const std::string scene = folder_.write("n.yaml", "model: " + numbered + "\nduration: 0.02\nmethod: rk4\nstart: {q: {1: 1}}\n");
  const ProgramResult refused = run_program({"check", scene});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("write the whole list"));
}

TEST_F(Units, OfRangesReachTheirKey) {
  const std::string scene = folder_.write("s.yaml", "model: " + kModels + "rr.urdf\nduration: 0.02\nmethod: rk4\ntorque: {pd: {kp: 60, kd: 1, q: [0, 0]}}\n");
  const auto status = [&](const std::string& over) {
    return run_program({"sweep", scene, "--over", over, "-o", folder_.file("s.csv"), "--force", "--quiet"}).status;
  };
  for (const char* good : {"start.q.1=0:90deg:3", "torque.pd.q.1=0:90deg:3", "start.qd.2=1deg/s:0:2", "step=1ms:2ms:2", "start.q.1=0:1:3"})
    EXPECT_EQ(status(good), 0) << good;
  for (const char* bad : {"start.q.1=0:90cm:3", "start.q.1=0:2s:3", "step=1ms:2deg:2", "torque.pd.kp=0:60deg:3", "torque.pd.q.1=0:2s:2"})
    EXPECT_NE(status(bad), 0) << bad;
  const auto varied = [&](const std::string& vary) {
    return run_program({"snapshot", scene, "--vary", vary, "-o", folder_.file("v.png"), "--force", "--quiet"}).status;
  };
  EXPECT_EQ(varied("start.q.1=0:90deg:2"), 0);
  EXPECT_NE(varied("start.q.1=0:90cm:2"), 0);
}

TEST_F(Units, ParametersThatNobodyReadsDoNotVary) {
  const std::string scene = folder_.write("p.yaml", "model: " + kModels + "rr.urdf\nduration: 0.02\nmethod: rk4\nparameters: {k: 1, kk: 2}\ntorque: [-kk * q1, 0]\n"
                                                    "video: {width: 320, height: 180}\n");
  const std::vector<Words> commands{{"sweep", scene, "--over", "parameters.k=1,2", "-o", folder_.file("s.csv")},
                                    {"sweep", scene, "--over", "parameters.k=1,2", "-o", folder_.file("films/"), "--each", "png"},
                                    {"render", scene, "--vary", "parameters.k=1,2", "-o", folder_.file("p.mp4")},
                                    {"snapshot", scene, "--vary", "parameters.k=1,2", "-o", folder_.file("p.png")}};
  for (const Words& command : commands) {
    const ProgramResult refused = run_program(command);
    EXPECT_EQ(refused.status, 2) << command[0] << refused.err;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("no expression of the scene reads 'k'"), HasSubstr("Read are kk"))) << command[0];
    Words good = command;
    for (std::string& word : good)
      if (word == "parameters.k=1,2") word = "parameters.kk=1,2";
    EXPECT_EQ(run_program(good).status, 0) << command[0];
  }
}

// And it is what its ending says.
TEST_F(Units, EndingsMayBeInCapitals) {
  const std::string scene = folder_.write("c.yaml", "model: " + kModels + "rr.urdf\nduration: 0.1\nmethod: rk4\nvideo: {width: 320, height: 180}\n");
  const std::pair<const char*, const char*> starts[] = {{"a.MP4", "ftyp"}, {"a.Gif", "GIF89a"}, {"a.PNG", "PNG"}, {"a.WEBM", "webm"}, {"a.SVG", "<svg"}};
  for (const auto& [name, start] : starts) {
    const ProgramResult made = run_program({"render", scene, "-o", folder_.file(name), "--force"});
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(read_whole_file(folder_.file(name)).substr(0, 400), HasSubstr(start)) << name;
  }
  EXPECT_EQ(run_program({"extract", folder_.file("a.MP4")}).status, 0);
  for (const char* name : {"t.CSV", "t.NPZ", "t.JSON"}) EXPECT_EQ(run_program({"simulate", scene, "-o", folder_.file(name)}).status, 0) << name;
  EXPECT_THAT(read_whole_file(folder_.file("t.CSV")), testing::StartsWith("t [s],"));
  EXPECT_THAT(read_whole_file(folder_.file("t.NPZ")), testing::StartsWith("PK"));
  EXPECT_TRUE(parse_json(read_whole_file(folder_.file("t.JSON"))).is_object());
  EXPECT_EQ(run_program({"equations", kModels + "rr.urdf", "-o", folder_.file("e.TEX")}).status, 0);
  EXPECT_EQ(run_program({"sweep", scene, "--over", "start.q.1=1,2", "-o", folder_.file("s.CSV")}).status, 0);
  EXPECT_EQ(run_program({"render", scene, "-o", folder_.file("k_000000.PNG")}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.file("k_000001.png"))) << "a sequence, not a picture of that name";
  EXPECT_NE(run_program({"render", scene, "-o", folder_.file("a.MP5")}).status, 0) << "negative control";
}

TEST_F(Units, AWrongCountOfNumbersIsToldWithTheNamesOfTheJoints) {
  const std::string rr = kModels + "rr.urdf";
  EXPECT_THAT(run_program({"dynamics", rr, "--q", "0"}).err, HasSubstr("--q 0 has 1 number, but rr needs 2: of joint1, joint2"));
  EXPECT_THAT(run_program({"dynamics", rr, "--tau", "1,2,3"}).err, HasSubstr("--tau 1,2,3 has 3 numbers, but rr needs 2: of joint1, joint2"));
  EXPECT_THAT(run_program({"snapshot", rr, "--pose", "1", "-o", folder_.file("a.png")}).err, HasSubstr("of joint1, joint2"));
  EXPECT_EQ(run_program({"dynamics", rr, "--q", "0,1"}).status, 0) << "negative control";
}

TEST_F(Units, NumbersThatSpacesPartAreToldToStandTogether) {
  const Words command{"dynamics", kModels + "rr.urdf", "--q", "0"};
  EXPECT_THAT(run_program(with(command, {"-45deg"})).err, HasSubstr("the numbers of an option stand together, with commas: --q 0,-45deg"));
  EXPECT_THAT(run_program(with(command, {"0.3"})).err, HasSubstr("stand together"));
  EXPECT_THAT(run_program(with(command, {"more"})).err, Not(HasSubstr("stand together"))) << "negative control";
}

TEST_F(Units, WordsAreTakenAsTheyStand) {
  const auto title = [&](const std::string& words) {
    const ProgramResult result = run({"title=" + words});
    return result.status == 0 ? Json::parse(result.out)["title"].get<std::string>() : result.err;
  };
  for (const char* words : {"Push: falls", "[a, b]", "Push #2", "{k", "it's", "- a", "* 2", "90\u00b0"}) EXPECT_EQ(title(words), words);
  EXPECT_EQ(title("\"Push: falls\""), "Push: falls") << "in quotes as YAML has it";
  EXPECT_EQ(title("plain"), "plain");
  expect_refused({"start.q=[0: 1"}, "is not valid YAML");
}

// Axes have the units of keys, of coordinates, and of parameters where expressions of torque leave but one.
TEST(UnitsOfAxes, AreToldWhereTheyAreKnown) {
  const TemporaryFolder folder;
  const auto title = [&](const std::string& model, const std::string& torque, const std::string& key) {
    Scene scene = read_scene(folder.write("a.yaml", "model: " + kModels + model + "\nduration: 1\nparameters: {k: 1, w: 2}\ntorque: " + torque + "\n"));
    const Sweep sweep = with_unit_of_parameter(scene, {key, {"1", "2"}, {1, 2}});
    return title_of_axis(with_unit_of(prepare(scene, false).chain, sweep));
  };
  EXPECT_EQ(title("pp.urdf", "[0, 0]", "step"), "step [s]");
  EXPECT_EQ(title("pp.urdf", "[0, 0]", "payload.mass"), "payload [kg]");
  EXPECT_EQ(title("pp.urdf", "[0, 0]", "duration"), "duration [s]");
  EXPECT_EQ(title("pp.urdf", "[0, 0]", "gravity.2"), "gravity.2 [m/s\u00B2]");
  EXPECT_EQ(title("pp.urdf", "[0, 0]", "torque.1"), "torque.1 [N]");
  EXPECT_EQ(title("rr.urdf", "[0, 0]", "torque.1"), "torque.1 [N m]");
  EXPECT_EQ(title("rr.urdf", "{pd: {kp: [1, 2], kd: 1, q: [0, 0]}}", "torque.pd.kp.2"), "torque.pd.kp.2 [N m/rad]");
  for (const auto& [torque, unit] : {std::pair<const char*, const char*>{"[0, -k * y_G]", " [N/m]"}, {"[-k * qd1, -k * qd2]", " [N s/m]"}, {"[k, 0]", " [N]"},
                                     {"[sin(k * t), 0]", ""}, {"[w * sin(k * t), 0]", ""}, {"[-100 * k * y_G, 0]", ""}, {"[-k * y_G + k, 0]", ""}, {"[0, 0]", ""}})
    EXPECT_EQ(title("pp.urdf", torque, "parameters.k"), std::string("k") + unit) << torque;
  for (const auto& [torque, unit] : {std::pair<const char*, const char*>{"[-k * q1, 0]", " [N m/rad]"}, {"[0, -2 * k * qd2]", " [N m s/rad]"}, {"[k * sin(q1), 0]", " [N m]"},
                                     {"[k * y_G, 0]", " [N]"}})
    EXPECT_EQ(title("rr.urdf", torque, "parameters.k"), std::string("k") + unit) << torque;
}

}  // namespace
}  // namespace chainreel
