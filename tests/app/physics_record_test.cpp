// What stands behind pictures, and what is said of two states of it.

#include "app/verify/physics_record.hpp"

#include <gmock/gmock.h>

#include <random>
#include <regex>

#include "core/error.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr char kRr[] = CHAINREEL_SOURCE_FOLDER "/models/rr.urdf";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("'" + from + "' is not in the text");
  return text.replace(at, from.size(), to);
}

Json record_of(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  const PreparedFilm film = load_film(scene, overrides, false);
  return run_record(film, Runs(film));
}

constexpr char kRecordedScene[] =
    "model: rr.urdf\nduration: 1\nmethod: rk4\nstep: 0.01\ntorque: [1, \"-2 * qd2\"]\nvideo: {fps: 30}\n";

struct Workshop {
  TemporaryFolder folder;
  std::string scene;
  Workshop() {
    folder.write("rr.urdf", read_whole_file(kRr));
    scene = folder.write("scene.yaml", kRecordedScene);
  }
  // What is said where the scene is changed by an override, or the model by a replacement.
  std::vector<std::string> after(const std::vector<std::string>& overrides) const {
    return explain_runs(record_of(scene), record_of(scene, overrides));
  }
  std::vector<std::string> after_model(const std::string& from, const std::string& to) const {
    const Json before = record_of(scene);
    const std::string text = read_whole_file(kRr);
    folder.write("rr.urdf", replaced(text, from, to));
    const Json now = record_of(scene);
    folder.write("rr.urdf", text);
    return explain_runs(before, now);
  }
};

TEST(PhysicsRecord, IsTheSameInAnyFolderAndWithAnyLineEndings) {
  const Workshop here, there;
  const std::string first = record_of(here.scene).dump();
  EXPECT_EQ(first, record_of(there.scene).dump());
  for (const char* name : {"rr.urdf", "scene.yaml"}) {
    const std::string text = read_whole_file(there.folder.file(name));
    there.folder.write(name, std::regex_replace(text, std::regex("\n"), "\r\n"));
  }
  EXPECT_EQ(first, record_of(there.scene).dump());
  // Found from another working folder, its paths look otherwise.
  const std::string relative = std::filesystem::relative(here.scene).string();
  EXPECT_EQ(first, record_of(relative).dump());
  EXPECT_THAT(first, testing::Not(HasSubstr(here.folder.path().filename().string())));
  EXPECT_LT(first.size(), 100'000U);
  EXPECT_THAT(explain_runs(Json::parse(first), record_of(here.scene)), IsEmpty());
}

TEST(PhysicsRecord, TellsAMotionTogetherWithItsOneCause) {
  const Workshop shop;
  EXPECT_THAT(shop.after({"method=explicit_euler"}),
              ElementsAre(AllOf(StartsWith("q"), HasSubstr(" differs by "), HasSubstr(" from t = 0.03"),
                                HasSubstr("(largest "), HasSubstr(": method rk4 -> explicit_euler"))));
  EXPECT_THAT(shop.after({"torque.1=1.01"}),
              ElementsAre(AllOf(HasSubstr("differs by"), HasSubstr(": torque.1 1 -> 1.01"))));
  EXPECT_THAT(
      shop.after_model("<mass value=\"1\"/>", "<mass value=\"1.01\"/>"),
      ElementsAre(AllOf(StartsWith("q"), HasSubstr(": link link1: mass 1 -> 1.01 kg, URDF line 19"))));
  // What a method brings with it is no second cause.
  EXPECT_THAT(shop.after({"method=dop853", "step=null"}),
              ElementsAre(HasSubstr(
                  ": method rk4 -> dop853 (tolerance: left out -> 1e-09, step: 0.01 -> left out)")));
  // Several causes stand by themselves, before what comes of them.
  EXPECT_THAT(shop.after({"torque.1=1.01", "start.q=[0.001, 0]"}),
              ElementsAre("start.q.1 0 -> 0.001", "torque.1 1 -> 1.01",
                          AllOf(HasSubstr("q1 (joint1) differs by 0.001 rad from t = 0 s on"),
                                HasSubstr(", as does 1 other"))));
}

TEST(PhysicsRecord, TellsKeysThatMoveNothing) {
  const Workshop shop;
  EXPECT_THAT(shop.after({"theme=dark"}), ElementsAre("theme light -> dark"));
  EXPECT_THAT(shop.after({"camera.azimuth=10deg"}),
              ElementsAre(StartsWith("camera.azimuth: left out -> 0.17")));
  EXPECT_THAT(shop.after({"video.fps=60"}), ElementsAre("video.fps 30 -> 60"));
  EXPECT_THAT(shop.after({"duration=2"}),
              ElementsAre("the run ends at t = 1 s -> t = 2 s", "duration 1 -> 2"));
  EXPECT_THAT(
      shop.after_model("rgba=\"0.337", "rgba=\"0.353"),
      ElementsAre(
          AllOf(HasSubstr("link link1: visual 1 (cylinder) colour 86 180 233 255 -> 90 180 233 255 of 255"),
                HasSubstr("material sky")),
          HasSubstr("link link1: visual 2 (sphere) colour")));
  // How a film is packed is no part of a picture, nor is where a model lies.
  EXPECT_THAT(shop.after({"video.preset=web", "hold.last=2"}), IsEmpty());
}

TEST(PhysicsRecord, NamesTheTableWhoseNumbersChanged) {
  const Workshop shop;
  shop.folder.write("tau.csv", "t,tau1,tau2\n0,1,0\n1,1,0\n");
  const std::vector<std::string> drive = {"torque={csv: tau.csv}"};
  const Json before = record_of(shop.scene, drive);
  shop.folder.write("tau.csv", "t,tau1,tau2\r\n0,1.0,0\r\n1,1,0\r\n");
  EXPECT_EQ(before.dump(), record_of(shop.scene, drive).dump());
  shop.folder.write("tau.csv", "t,tau1,tau2\n0,1,0\n1,1.1,0\n");
  EXPECT_THAT(explain_runs(before, record_of(shop.scene, drive)),
              ElementsAre(AllOf(StartsWith("q2 (joint2) differs by"),
                                HasSubstr(": torque: the numbers in table tau.csv differ"))));
}

TEST(PhysicsRecord, NamesTheRecordedMotionThatChanged) {
  const Workshop shop;
  const std::string scene = shop.folder.write("replay.yaml", "model: rr.urdf\nmotion: log.csv\n");
  const auto log = [&](const char* q, const char* qdd) {
    shop.folder.write("log.csv", std::string("t,q1,q2,qd1,qd2,qdd1,qdd2\n0,0,0,0,0,0,0\n1,") + q + ",0,0,0," + qdd + ",0\n");
    return record_of(scene);
  };
  const Json before = log("1", "0");
  EXPECT_EQ(before.dump(), log("1.0", "0").dump());
  EXPECT_THAT(explain_runs(before, log("1.1", "0")),
              ElementsAre(AllOf(StartsWith("q1 (joint1) differs by"), HasSubstr(": motion: the numbers in table log.csv differ"))));
  // Torques alone are others: the states are the same.
  EXPECT_THAT(explain_runs(before, log("1", "0.5")), ElementsAre("motion: the numbers in table log.csv differ"));
}

// A change beside another one that moves is told by itself where it cannot have moved anything.
TEST(PhysicsRecord, TakesNothingForACauseThatDoesNotAct) {
  const TemporaryFolder folder;
  const auto write = [&](const char* limit, const char* damping, const char* mass) {
    folder.write("m.urdf",
                 std::string("<robot name='m'><link name='base'/><link name='a'><inertial><origin xyz='1 0 "
                             "0'/><mass value='") +
                     mass +
                     "'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link><joint "
                     "name='j' type='revolute'>"
                     "<parent link='base'/><child link='a'/><axis xyz='0 0 1'/><limit lower='-9' upper='" +
                     limit + "' effort='99' velocity='99'/><dynamics damping='" + damping +
                     "'/></joint></robot>");
  };
  const auto told = [&](const std::vector<std::string>& overrides) {
    const std::string scene =
        folder.write("s.yaml", "model: m.urdf\nduration: 0.5\nmethod: rk4\nstep: 0.01\n");
    write("9", "0", "1");
    const Json before = record_of(scene, overrides);
    write("8", "0.1", "1.01");
    return explain_runs(before, record_of(scene, overrides));
  };
  EXPECT_THAT(told({"friction=false"}),
              ElementsAre(AllOf(StartsWith("q1 (j) differs by"), HasSubstr(": link a: mass 1 -> 1.01 kg")),
                          HasSubstr("joint j: damping"), HasSubstr("joint j: upper limit")));
  EXPECT_THAT(told({"limit=stop"}),
              ElementsAre(StartsWith("link a: mass"), StartsWith("joint j: damping"),
                          StartsWith("joint j: upper limit"), StartsWith("q1 (j) differs by")));
}

TEST(PhysicsRecord, KeepsTablesOfOneNameInTwoFoldersApart) {
  const Workshop shop;
  const auto table = [&](const char* folder, const char* value) {
    shop.folder.write(std::string(folder) + "/ref.csv",
                      std::string("t,q1,q2\n0,0,0\n0.5,") + value + ",0\n1,1,0\n");
  };
  const std::vector<std::string> drive = {
      "torque=[{pd: {kp: 10, kd: 1, trajectory: a/ref.csv}}, {pd: {kp: 10, kd: 1, trajectory: b/ref.csv}}]"};
  table("a", "0.5"), table("b", "0.5");
  const Json before = record_of(shop.scene, drive);
  table("a", "0.6");
  EXPECT_THAT(explain_runs(before, record_of(shop.scene, drive)),
              ElementsAre(HasSubstr(": torque: the numbers in table ref.csv differ")));
}

TEST(PhysicsRecord, TellsTheRotationOfAFloatingBase) {
  const TemporaryFolder folder;
  folder.write("m.urdf",
               "<robot name='m'><link name='body'><inertial><mass value='1'/><inertia ixx='1' ixy='0' "
               "ixz='0' iyy='2' iyz='0' izz='3'/>"
               "</inertial></link></robot>");
  const std::string scene = folder.write("s.yaml",
                                         "model: m.urdf\nbase: floating\nduration: 0.5\nmethod: rk4\nstep: "
                                         "0.01\ngravity: [0, 0, 0]\nstart: {qd: [0, 0, 0, 1, 0, 0]}\n");
  EXPECT_THAT(explain_runs(record_of(scene), record_of(scene, {"start.qd=[0, 0, 0, 1.01, 0, 0]"})),
              ElementsAre(AllOf(StartsWith("rotation of "), HasSubstr(" differs by 0.0001"),
                                HasSubstr(" rad from t = 0.01"), HasSubstr(": start.qd.4 1 -> 1.01"))));
}

// Start and motion of a closed loop move with the lengths of its links.
TEST(PhysicsRecord, TakesAStartOnConstraintsAlongWithItsCause) {
  const TemporaryFolder folder;
  const std::string text = read_whole_file(CHAINREEL_SOURCE_FOLDER "/models/four_bar.urdf");
  folder.write("models/four_bar.urdf", text);
  const std::string scene = folder.write(
      "assets/scenes/four_bar.yaml", read_whole_file(CHAINREEL_SOURCE_FOLDER "/assets/scenes/four_bar.yaml"));
  const std::vector<std::string> quick = {"duration=0.2", "method=rk4", "step=0.005"};
  const Json before = record_of(scene, quick);
  folder.write("models/four_bar.urdf",
               replaced(text, "<origin xyz=\"1.2 0 0\"/>", "<origin xyz=\"1.201 0 0\"/>"));
  EXPECT_THAT(explain_runs(before, record_of(scene, quick)),
              ElementsAre(HasSubstr(": joint coupler_pin: origin moved by 1 mm"),
                          StartsWith("the start on the constraints: start.q.1 3.14159 -> ")));
}

TEST(PhysicsRecord, SaysWhatOnePanelHasAlone) {
  const Workshop shop;
  const std::string page = "compare=[{method: rk4}, {method: semi_implicit_euler}]";
  const Json before = record_of(shop.scene, {page});
  EXPECT_THAT(explain_runs(before, record_of(shop.scene, {page, "theme=dark"})),
              ElementsAre("theme light -> dark"));
  EXPECT_THAT(
      explain_runs(before, record_of(shop.scene, {"compare=[{method: rk4}, {method: symplectic_euler}]"})),
      testing::Contains(
          AllOf(StartsWith("panel 2 ("), HasSubstr("method semi_implicit_euler -> symplectic_euler"))));
  EXPECT_THAT(explain_runs(before, record_of(shop.scene)), testing::Contains("compare: panels 2 -> 1"));
}

TEST(PhysicsRecord, RefusesWhatIsNone) {
  const Workshop shop;
  const Json good = record_of(shop.scene);
  Json cut = good;
  cut["panels"][0]["trajectory"]["q"].erase(0);
  Json empty = good;
  empty["models"] = Json::array();
  Json words = good;
  words["panels"][0]["trajectory"]["q"] = "x";
  for (const Json& bad : {Json(), Json::array(), Json{{"panels", 3}}, cut, empty, words})
    EXPECT_THROW(explain_runs(good, bad), Error) << bad.dump().substr(0, 200);
  EXPECT_THROW(explain_models(good["models"][0], Json::object()), Error);
}

// Records lie in files that anyone may touch.
TEST(PhysicsRecord, SpoiltByLotIsRefusedOrTold) {
  const Workshop shop;
  const Json good = record_of(shop.scene);
  std::mt19937 lot(5);
  int refused = 0, told = 0;
  for (int round = 0; round < 600; ++round) {
    Json bad = good;
    Json* node = &bad;
    for (int depth = 0; node->is_structured() && !node->empty() && (depth < 2 || lot() % 4 != 0); ++depth) {
      auto child = node->begin();
      std::advance(child, lot() % node->size());
      node = &*child;
    }
    switch (lot() % 6) {
      case 0:
        *node = nullptr;
        break;
      case 1:
        *node = -7;
        break;
      case 2:
        *node = 1e300;
        break;
      case 3:
        *node = "x";
        break;
      case 4:
        *node = Json::array();
        break;
      default:
        *node = Json::object();
        break;
    }
    try {
      told += !explain_runs(good, bad).empty();
      explain_runs(bad, good);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input);
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(told, 20);
}

TEST(Poses, AreToldByJointsInTheUnitsThatTheyHave) {
  const Json model = model_record(CHAINREEL_SOURCE_FOLDER "/models/pp.urdf", {});
  EXPECT_THAT(explain_poses({0, 1}, {0, 1.5}, {"slide1", "slide2"}, model),
              ElementsAre("pose: slide2 1 -> 1.5 m"));
  const Json arm = model_record(kRr, {});
  EXPECT_THAT(explain_poses({0, 1.5707963267948966}, {0, 1.5718435243461}, {"joint1", "joint2"}, arm),
              ElementsAre("pose: joint2 90 -> 90.06 deg"));
  EXPECT_THAT(explain_poses({0, 1.5}, {0, 1.5 + 1e-13}, {"joint1", "joint2"}, arm),
              ElementsAre("pose: joint2 85.9436692696235 -> 85.9436692696292 deg"));
  EXPECT_THAT(explain_poses({0, 1.5}, {0, 1.6}, {"joint1", "joint2"}),
              ElementsAre("pose: joint2 1.5 -> 1.6"));
  EXPECT_THAT(explain_poses({0, 1.5}, {0, 1.5}, {"joint1", "joint2"}, arm), IsEmpty());
  EXPECT_THAT(explain_poses({0}, {0, 1.5}, {"joint1", "joint2"}), ElementsAre("pose: 1 -> 2 numbers"));
}

}  // namespace
}  // namespace chainreel
