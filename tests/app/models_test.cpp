// A model where a scene could stand: keys given on the command line act, or are refused; flags that a command does not
// honour are not offered.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

Json dynamics_of_rr(const Words& more) {
  const ProgramResult result = run_program(with({"dynamics", "models/rr.urdf", "--q", "0,90deg", "--json"}, more));
  EXPECT_EQ(result.status, 0) << result.err;
  return result.status == 0 ? Json::parse(result.out) : Json{};
}

TEST(ModelKeys, OfTheMechanismActOnDynamics) {
  EXPECT_NEAR(dynamics_of_rr({})["tau_g"][0].get<double>(), 2 * 9.81, 1e-13);
  EXPECT_EQ(dynamics_of_rr({"--set", "gravity=[0, 0, 0]"})["tau_g"][0], 0);
  EXPECT_NEAR(dynamics_of_rr({"--set", "gravity=[0, -1.62, 0]"})["tau_g"][0].get<double>(), 2 * 1.62, 1e-14);
  EXPECT_EQ(dynamics_of_rr({"--gravity", "0,0,0"})["tau_g"][0], 0);
  EXPECT_EQ(dynamics_of_rr({"--set", "end_effector=link1"})["end_effector"], "link1");
  EXPECT_EQ(dynamics_of_rr({"--end-effector", "link1"})["J"], dynamics_of_rr({"--set", "end_effector=link1"})["J"]);
}

constexpr const char* kRough = R"(<robot name="rough">
  <link name="base"/>
  <link name="arm"><inertial><origin xyz="1 0 0"/><mass value="1"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="gripper"/>
  <joint name="a" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="9" velocity="9"/><dynamics damping="2" friction="0"/></joint>
  <joint name="b" type="revolute"><parent link="arm"/><child link="gripper"/><origin xyz="2 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="9" velocity="9"/></joint>
</robot>
)";

TEST(ModelKeys, FrictionAndMasslessActOnEveryCommandThatReadsAModel) {
  const TemporaryFolder folder;
  const std::string model = folder.write("rough.urdf", kRough);
  EXPECT_EQ(run_program({"dynamics", model}).status, 3) << "the gripper's joint moves no mass";
  const Words massless{"--set", "massless=1e-6"};
  const auto friction = [&](const std::string& on) {
    const ProgramResult result =
        run_program(with({"dynamics", model, "--qd", "1,0", "--json", "--set", "friction=" + on}, massless));
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(result.out)["tau_f"][0].get<double>();
  };
  EXPECT_EQ(friction("true"), 2);
  EXPECT_EQ(friction("false"), 0);
  EXPECT_EQ(run_program(with({"check", model}, massless)).status, 0);
  EXPECT_EQ(run_program(with({"snapshot", model, "-o", folder.file("a.png"), "--width", "64", "--height", "64"}, massless)).status, 0);
  EXPECT_EQ(run_program(with({"ellipse", model, "--pose", "0,1", "-o", folder.file("a.csv")}, massless)).status, 0);
  const std::string motion = folder.write("q.csv", "t,q1,q2\n0,0,0\n1,1,1\n");
  EXPECT_EQ(run_program(with({"inverse", model, "--trajectory", motion, "-o", folder.file("tau.csv")}, massless)).status, 0);
}

TEST(ModelKeys, ThatMeanNothingToACommandAreRefusedNamingWhatItTakes) {
  const TemporaryFolder folder;
  const std::string motion = folder.write("q.csv", "t,q1,q2\n0,0,0\n1,1,1\n");
  const std::vector<Words> commands{{"dynamics", "models/rr.urdf"},
                                    {"check", "models/rr.urdf"},
                                    {"inverse", "models/rr.urdf", "--trajectory", motion, "-o", folder.file("t.csv")},
                                    {"snapshot", "models/rr.urdf", "-o", folder.file("a.png")},
                                    {"ellipse", "models/rr.urdf", "--pose", "0,1", "-o", folder.file("e.csv")}};
  for (const Words& command : commands) {
    const ProgramResult result = run_program(with(command, {"--set", "duration=2", "--set", "start.q=[1, 1]"}));
    EXPECT_EQ(result.status, 2) << command[0];
    EXPECT_THAT(result.err, HasSubstr("--set duration=2: means nothing to `" + command[0] + "` of the model"));
    EXPECT_THAT(result.err, HasSubstr("--set start.q=[1, 1]: means nothing"));
    EXPECT_THAT(result.err, HasSubstr("it takes gravity, base, friction, massless, payload.mass"));
    const ProgramResult unknown = run_program(with(command, {"--set", "gravty=[0, 0, 0]"}));
    EXPECT_EQ(unknown.status, 3) << command[0];
    EXPECT_THAT(unknown.err, HasSubstr("did you mean 'gravity'?"));
    const ProgramResult wrong = run_program(with(command, {"--set", "gravity=[0, 0]"}));
    EXPECT_EQ(wrong.status, 3) << command[0];
  }
  EXPECT_EQ(run_program(with(commands[0], {"--set", "theme=dark"})).status, 2) << "dynamics draws nothing";
  EXPECT_EQ(run_program(with(commands[3], {"--layout", "transparent"})).status, 2);
  EXPECT_EQ(run_program(with(commands[3], {"--at", "1"})).status, 2);
  EXPECT_EQ(run_program(with(commands[3], {"--vary", "method=rk4,taylor"})).status, 2);
}

TEST(ModelKeys, OfThePictureActAsTheirFlagsDo) {
  const TemporaryFolder folder;
  const auto page = [&](const Words& more) {
    const std::string file = folder.file("a.svg");
    const ProgramResult result =
        run_program(with({"snapshot", "models/arm.urdf", "--pose", "0,0.6,1.2,0,0.5,0", "--links", "plain", "-o", file, "--force"}, more));
    EXPECT_EQ(result.status, 0) << result.err;
    const std::string text = read_whole_file(file);
    return text.substr(text.find("</metadata>"), text.rfind("<!-- sha256") - text.find("</metadata>"));  // which is of the memory, too
  };
  const std::string plain = page({});
  for (const auto& [flag, key] : {std::pair{Words{"--theme", "dark"}, "theme=dark"},
                                  {{"--azimuth", "80deg"}, "camera.azimuth=80deg"},
                                  {{"--width", "640"}, "video.width=640"}}) {
    EXPECT_NE(page(flag), plain) << key;
    EXPECT_EQ(page(flag), page({"--set", key})) << key;
  }
}

TEST(Flags, ThatACommandDoesNotHonourAreNotOffered) {
  const std::vector<Words> refused{
      {"init", "x", "--set", "a=1"},          {"init", "x", "--base", "fixed"},
      {"methods", "--set", "a=1"},            {"methods", "--quiet"},
      {"doctor", "--base", "floating"},       {"doctor", "--force"},
      {"dynamics", "models/rr.urdf", "--force"}, {"check", "models/rr.urdf", "--force"},
      {"completion", "bash", "--json"},          {"check", "models/rr.urdf", "--columns", "t"},
      {"sheet", "assets/scenes/rr_free.yaml", "--set", "theme=dark"},
      {"sheet", "assets/scenes/rr_free.yaml", "--set", "video.width=64"},
      {"dynamics", "assets/scenes/pen.yaml", "--q", "0,0,0"}, {"dynamics", "models/rr.urdf", "--at", "1"}};
  for (const Words& words : refused) EXPECT_EQ(run_program(words).status, 2) << words[0] << " " << words.back();
}

TEST(InitCommand, TellsItsFilesAsJson) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"init", folder.file("my_arm"), "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["files"][0], folder.file("my_arm.yaml"));
}

// Two fingers that move as one: who gives each a number is told which of them has none.
TEST(MimicJoints, AreNamedWhereNumbersDoNotFit) {
  const TemporaryFolder folder;
  const std::string joint = "<limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"9\"/><axis xyz=\"0 1 0\"/>";
  const auto link = [](const std::string& name) {
    return "<link name=\"" + name + "\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>";
  };
  const std::string model = folder.write(
      "hand.urdf", "<robot name=\"hand\">" + link("palm") + link("a") + link("b") +
                       "<joint name=\"left\" type=\"prismatic\"><parent link=\"palm\"/><child link=\"a\"/>" + joint + "</joint>" +
                       "<joint name=\"right\" type=\"prismatic\"><parent link=\"palm\"/><child link=\"b\"/><mimic joint=\"left\"/>" + joint +
                       "</joint></robot>");
  const ProgramResult counted = run_program({"dynamics", model, "--q", "0.1,0.2"});
  EXPECT_EQ(counted.status, 2);
  EXPECT_THAT(counted.err, HasSubstr("hand needs 1: of left; right follows left, which makes it 0.1, not 0.2"));
  EXPECT_THAT(run_program({"dynamics", model, "--q", "0.1,0.2,0.3"}).err, HasSubstr("of left; right follows left and has no number of its own"));
  EXPECT_THAT(run_program({"dynamics", model, "--q", "right=0.1"}).err, HasSubstr("right follows left"));
  const std::string scene = folder.write("hand.yaml", "model: hand.urdf\nstart: {q: [0.1, 0.2]}\nduration: 1\n");
  EXPECT_THAT(run_program({"check", scene}).err, HasSubstr("needs 1: right follows left, which makes it 0.1, not 0.2"));
  // Who names all of a robot's joints, each where it is, is understood.
  const ProgramResult all = run_program({"dynamics", model, "--q", "0.1,0.1", "--qd", "2,2"}), own = run_program({"dynamics", model, "--q", "0.1", "--qd", "2"});
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_EQ(all.out, own.out);
  folder.write("hand.yaml", "model: hand.urdf\nstart: {q: [0.1, 0.1], qd: [2, 2]}\nduration: 1\n");
  EXPECT_EQ(run_program({"check", scene}).status, 0) << run_program({"check", scene}).err;
}

// The states of an SRDF that lies beside the model, or in srdf/ beside its folder, wherever a pose is asked for.
TEST(NamedPoses, OfAnSrdfAreTakenByEveryCommandThatTakesAPose) {
  const TemporaryFolder folder;
  folder.write("arm/urdf/rr.urdf", read_whole_file("models/rr.urdf"));
  const std::string model = folder.file("arm/urdf/rr.urdf");
  folder.write("arm/srdf/rr.srdf", "<robot name=\"rr\"><group_state name=\"ready\" group=\"all\"><joint name=\"joint1\" value=\"0.5\"/>"
                                   "<joint name=\"joint2\" value=\"-1\"/></group_state></robot>");
  folder.write("arm/srdf/other.srdf", "<robot name=\"another\"><group_state name=\"ready\" group=\"all\"><joint name=\"x\" value=\"1\"/></group_state></robot>");
  const Json wanted{0.5, -1.0};
  EXPECT_EQ(Json::parse(run_program({"dynamics", model, "--q", "ready", "--json"}).out)["q"], wanted);
  EXPECT_EQ(Json::parse(run_program({"ellipse", model, "--pose", "ready", "-o", folder.file("a.csv"), "--json"}).out)["poses"][0]["q"], wanted);
  const Json shot = Json::parse(run_program({"snapshot", model, "--pose", "ready", "--width", "64", "--height", "36", "-o", folder.file("a.svg"), "--json"}).out);
  EXPECT_EQ(shot["pictures"][0]["poses"][0]["q"], wanted);
  const ProgramResult wrong = run_program({"dynamics", model, "--q", "redy"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("rr.srdf has no state of this name: did you mean 'ready'?"));
  EXPECT_EQ(run_program({"dynamics", "models/rr.urdf", "--q", "ready"}).status, 2) << "without an SRDF there is none";
}

TEST(DynamicsCommand, SaysWhatMassIsFixedToTheWorld) {
  const ProgramResult words = run_program({"dynamics", "models/humanoid.urdf", "--base", "fixed"});
  const Json json = Json::parse(run_program({"dynamics", "models/humanoid.urdf", "--base", "fixed", "--json"}).out);
  if (json["fixed_mass"] > 0.0) EXPECT_THAT(words.out, HasSubstr("fixed to the world"));
  EXPECT_GE(json["fixed_mass"].get<double>(), 0);
}

}  // namespace
}  // namespace chainreel
