// Numbers of one scene that several commands tell are the same numbers: of constrained mechanisms, trees, mimicking
// joints, floating bases and panels of comparisons.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/csv.hpp"
#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

const std::string kModels = CHAINREEL_SOURCE_FOLDER "/models/";

Json json_of(const Words& words) {
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.status, 0) << words[0] << ": " << result.err;
  return result.status == 0 ? Json::parse(result.out) : Json{};
}

void expect_same(const Json& a, const Json& b, double tolerance, const std::string& what) {
  if (a.is_array()) {
    ASSERT_EQ(a.size(), b.size()) << what;
    for (std::size_t i = 0; i < a.size(); ++i) expect_same(a[i], b[i], tolerance, what);
  } else if (a.is_number()) {
    EXPECT_NEAR(a.get<double>(), b.get<double>(), tolerance * (1 + std::abs(b.get<double>()))) << what;
  } else {
    EXPECT_EQ(a, b) << what;
  }
}

// A slider that an arm follows by half, both on a tree with a second arm.
constexpr const char* kMimicTree = R"(<robot name="follower">
  <link name="base"/>
  <link name="cart"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="left"><inertial><origin xyz="0.5 0 0"/><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="gripper"><inertial><origin xyz="0.4 0 0"/><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="cart"/><axis xyz="1 0 0"/><limit lower="-9" upper="9" effort="99" velocity="99"/></joint>
  <joint name="swing" type="continuous"><parent link="cart"/><child link="left"/><axis xyz="0 0 1"/></joint>
  <joint name="follow" type="continuous"><parent link="cart"/><child link="gripper"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/>
    <mimic joint="slide" multiplier="0.5" offset="0.2"/></joint>
</robot>
)";

class Agreement : public ::testing::Test {
 protected:
  std::string scene(const std::string& text) { return folder_.write("scene" + std::to_string(++count_) + ".yaml", text); }

  // All commands about one single run, at 0, 0.5 and 1 s of its one second.
  void check(const std::string& scene, const Words& more) {
    SCOPED_TRACE(scene);
    const Words common = with({"--set", "duration=1", "--set", "video.fps=2"}, more);
    const std::string table = folder_.file("run.csv");
    const Json run = json_of(with({"simulate", scene, "-o", table, "--json", "--force"}, common));
    const Table rows = read_csv(table);
    const Json along =
        json_of(with({"ellipse", "--along", scene, "--samples", "3", "-o", folder_.file("e.csv"), "--json", "--force"}, common));
    const Json pictures = json_of(with({"snapshot", scene, "--at", "0,0.5,1", "-o", folder_.file("pictures/"), "--width", "160", "--height", "90",
                                        "--json", "--force", "--quiet"}, common))["pictures"];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string at = k == 0 ? "0" : k == 1 ? "0.5" : "1";
      const Json now = json_of(with({"dynamics", scene, "--at", at, "--json", "--quiet"}, common));
      const Json& pose = along["poses"][k];
      // The same run sampled at the same instant: the same bits but for the way to and from text.
      expect_same(now["q"], pose["q"], 1e-15, "q of dynamics and ellipse");
      for (const char* key : {"Lambda_inv", "Lambda", "mobility"}) expect_same(now[key], pose[key], 1e-12, key);
      expect_same(now["x"], pose["point"], 1e-15, "the end effector");
      const Json& shown = pictures[k]["panels"][0];
      for (const char* key : {"q", "qd", "tau"}) expect_same(now[key], shown[key], 1e-12, std::string(key) + " of dynamics and snapshot");
      // Of the frames' samples, of which a film has the multipliers, as of the state by itself.
      if (now["lambda"].is_array()) expect_same(now["lambda"], shown["lambda"], 1e-9, "lambda of dynamics and snapshot");
      ASSERT_GT(rows.rows(), k);
      // t, then q, then qd.
      Json state = now["q"];
      for (const Json& rate : now["qd"]) state.push_back(rate);
      ASSERT_GT(rows.columns.size(), state.size());
      for (std::size_t i = 0; i < state.size(); ++i)
        EXPECT_NEAR(rows.columns[i + 1][k], state[i].get<double>(), 1e-15 * (1 + std::abs(state[i].get<double>())))
            << rows.names[i + 1] << " at " << at;
    }
    // What the audit says of the start and the end.
    const Json start = json_of(with({"dynamics", scene, "--json", "--quiet"}, common));
    EXPECT_NEAR(run["energy_start"].get<double>(), start["kinetic"].get<double>() + start["potential"].get<double>(), 1e-12);
    if (run["constraint_error"].is_null()) return;
    const Json end = json_of(with({"dynamics", scene, "--at", "1", "--json", "--quiet"}, common));
    expect_same(start["contact_forces"], run["constraint_error"]["force_at_start"], 1e-9, "force at the start");
    expect_same(end["contact_forces"], run["constraint_error"]["force_at_end"], 1e-9, "force at the end");
  }

  TemporaryFolder folder_;
  int count_ = 0;
};

TEST_F(Agreement, OfCommandsOnConstrainedMechanisms) {
  for (const char* name : {"four_bar", "slider_crank", "pen"})
    check("assets/scenes/" + std::string(name) + ".yaml", {"--set", "method=dop853", "--set", "tolerance=1e-9"});
  const std::string line = "{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}";
  check(scene("model: " + kModels + "rrr.urdf\nstart: {q: [90deg, -90deg, -30deg]}\nmethod: dop853\ntolerance: 1e-9\n"
              "constraints: [" + line + ", " + line + "]\n"), {});
}

TEST_F(Agreement, OfCommandsOnTreesMimicAndFloatingBases) {
  folder_.write("follower.urdf", kMimicTree);
  check(scene("model: follower.urdf\nstart: {q: [0.3, 1], qd: [1, 0]}\nmethod: dop853\ntorque: [\"-3 * q1\", 0.5]\n"
              "constraints: [{linear: {coefficients: {slide: 1, swing: -0.5}, value: -0.2}}]\n"), {});
  check(scene("model: follower.urdf\nstart: {q: [0.3, 1], qd: [1, 0]}\nmethod: dop853\n"), {});
  check(scene("model: " + kModels + "rr.urdf\nbase: floating\nmassless: 0.5\nmethod: dop853\ngravity: [0, 0, 0]\n"
              "start: {qd: [0.1, 0, 0, 0, 0, 0.5, 1, -1]}\n"), {});
}

TEST_F(Agreement, OfPanelsWithTheScenesThatTheyAre) {
  const std::string both = scene("model: " + kModels + "rrr.urdf\nduration: 1\nvideo: {fps: 2}\n"
                                 "start: {q: [90deg, -60deg, -120deg]}\nmethod: dop853\n"
                                 "compare:\n  - {torque: [1, 0, 0]}\n"
                                 "  - {constraints: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]}\n");
  const std::string free = scene("model: " + kModels + "rrr.urdf\nduration: 1\nvideo: {fps: 2}\n"
                                 "start: {q: [90deg, -60deg, -120deg]}\nmethod: dop853\ntorque: [1, 0, 0]\n");
  const Words at{"--at", "0.5", "--json", "--quiet"};
  Json one = json_of(with({"dynamics", both, "--panel", "1"}, at)), alone = json_of(with({"dynamics", free}, at));
  alone["scene"] = one["scene"];
  EXPECT_EQ(one, alone);
  const Json pen = json_of(with({"dynamics", both, "--panel", "2"}, at));
  EXPECT_EQ(pen["constraint_rows"].size(), 1u);
  EXPECT_EQ(run_program(with({"dynamics", both}, at)).status, 3) << "which of the two?";
  EXPECT_EQ(run_program(with({"dynamics", both, "--panel", "3"}, at)).status, 2);
}

TEST_F(Agreement, OfDynamicsOfASceneWithItsModelInThatState) {
  const Json now = json_of({"dynamics", "assets/scenes/rr_torque.yaml", "--at", "0.4", "--json", "--quiet"});
  const auto list = [](const Json& numbers) {
    std::string text;
    for (const Json& x : numbers) text += (text.empty() ? "" : ",") + x.dump();
    return text;
  };
  const Json model = json_of({"dynamics", "models/rr.urdf", "--q=" + list(now["q"]), "--qd=" + list(now["qd"]),
                              "--tau=" + list(now["tau"]), "--gravity=" + list(now["gravity"]), "--json"});
  for (const auto& [key, value] : model.items())
    if (!value.is_null()) expect_same(value, now[key], 1e-13, key);  // a model has no scene and no instant
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(now["h"][i].get<double>(), now["nle"][i].get<double>() + now["tau_f"][i].get<double>());
}

TEST_F(Agreement, OfInverseWithTheRunThatItsTorquesMake) {
  // A motion along the line, its torques while pressing with 20 N, and what a run under these torques says of them.
  const std::string pen = "model: " + kModels + "rrr.urdf\nduration: 1\nvideo: {fps: 1000}\nmethod: dop853\n"
                          "gravity: [0, 0, 0]\nstart: {q: [90deg, -60deg, -120deg]}\n"
                          "constraints: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]\n";
  const std::string motion = folder_.file("motion.csv"), torques = folder_.file("tau.csv");
  ASSERT_EQ(run_program({"simulate", scene(pen + "torque: [1, 0.5, -1]\n"), "-o", motion}).status, 0);
  const std::string pressing = scene(pen + "contact_force: {constraint: 1, force: [0, -20]}\n");
  const Json report = json_of({"inverse", pressing, "--trajectory", motion, "-o", torques, "--json"});
  EXPECT_EQ(report["constraints"]["rows"].size(), 1u);
  EXPECT_LT(report["constraints"]["position_error"].get<double>(), 1e-12);
  const Table inverse = read_csv(torques);
  EXPECT_EQ(inverse.names, (std::vector<std::string>{"t", "tau1", "tau2", "tau3", "lambda1"}));
  const std::string again = folder_.file("again.csv");
  ASSERT_EQ(run_program({"simulate", scene(pen + "torque: {csv: tau.csv}\n"), "-o", again}).status, 0);
  const Table first = read_csv(motion), second = read_csv(again);
  const std::size_t end = first.rows() - 1;
  for (const char* q : {"q1", "q2", "q3"}) {
    const auto i = std::size_t(first.find(q));
    // Torques are linear between rows of 1 ms: the error falls with their square, from 0.024 at 10 ms.
    EXPECT_NEAR(first.columns[i][end], second.columns[i][end], 1e-3) << q;
  }
  const auto elbow = std::size_t(first.find("q2"));
  EXPECT_GT(std::abs(first.columns[elbow][end] - first.columns[elbow][0]), 0.1) << "it moved";
  const Json now = json_of({"dynamics", pressing, "--json", "--quiet"});
  EXPECT_NEAR(now["lambda"][0].get<double>(), inverse.columns[4][0], 1e-10) << "presses as the scene does";
}

TEST_F(Agreement, EllipseOfAConstrainedSceneIsNotThatOfItsCutChain) {
  const Json along = json_of({"ellipse", "--along", "assets/scenes/four_bar.yaml", "--samples", "2", "-o",
                              folder_.file("e.csv"), "--json"});
  EXPECT_TRUE(along["poses"][1]["eigenvalues"][0].is_null()) << "one freedom: infinite across its way";
  EXPECT_THAT(read_whole_file(folder_.file("e.csv")), HasSubstr(",inf,"));
  const ProgramResult joint = run_program({"ellipse", "--along", "assets/scenes/four_bar.yaml", "--joint-space",
                                           "--joints", "1,2", "-o", folder_.file("j.png")});
  EXPECT_EQ(joint.status, 2);
  EXPECT_THAT(joint.err, HasSubstr("cut chain"));
}

TEST_F(Agreement, InverseRefusesWhatTheMechanismCannotDo) {
  const std::string pen = scene("model: " + kModels + "rrr.urdf\nduration: 1\nmethod: dop853\n"
                                "start: {q: [90deg, -60deg, -120deg]}\n"
                                "constraints: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]\n");
  const std::string off = folder_.write("off.csv", "t,q1,q2,q3\n0,0,0,0\n1,0,0,1\n");
  const ProgramResult result = run_program({"inverse", pen, "--trajectory", off, "-o", folder_.file("t.csv")});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("off.csv:2: the motion in this row is 0.5 off the constraint 'line gripper"));
  const std::string wild = folder_.write("wild.csv", "t,q1,q2\n0,0,0\n1,0,1e308\n2,0,-1e308\n3,0,0\n");
  const ProgramResult overflow = run_program({"inverse", kModels + "pp.urdf", "--trajectory", wild, "-o", folder_.file("t.csv")});
  EXPECT_EQ(overflow.status, 5);
  EXPECT_THAT(overflow.err, HasSubstr("wild.csv:2: the motion in column q2 has no finite derivatives"));
  const std::string jump = folder_.write("jump.csv", "t,q1,q2,q3\n0,0,3,0\n1,0,-3,0\n");
  const ProgramResult turned = run_program({"inverse", kModels + "rrr.urdf", "--trajectory", jump, "-o", folder_.file("t.csv")});
  EXPECT_EQ(turned.status, 3);
  EXPECT_THAT(turned.err, HasSubstr("jump.csv:3: 'q2' jumps by -6 rad within 1 s, more than half a turn"));
  const std::string fast = folder_.write("fast.csv", "t,q1,q2,q3,qd1,qd2,qd3\n0,0,0,0,1e200,0,0\n1,0,0,0,1e200,0,0\n");
  const ProgramResult big = run_program({"inverse", kModels + "rrr.urdf", "--trajectory", fast, "-o", folder_.file("t.csv")});
  EXPECT_EQ(big.status, 5);
  EXPECT_THAT(big.err, HasSubstr("fast.csv:2: the torque tau"));
}

}  // namespace
}  // namespace chainreel
