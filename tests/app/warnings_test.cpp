// What the audit has against a run is said aloud, whatever else is quiet.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"


namespace chainreel {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kRoot = CHAINREEL_SOURCE_FOLDER;

std::string coarse(const std::string& more) {
  return "model: " + kRoot + "/models/rr.urdf\nduration: 3\ntorque: [0, 0]\n" + more;
}

TEST(Warnings, AreSaidOfEnergyThatTheMethodMadeAndChangeNoExitCode) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("coarse.yaml", coarse("method: explicit_euler\nstep: 0.02\n"));
  const ProgramResult run =
      run_program({"simulate", scene, "-o", folder.file("a.csv"), "--quiet", "--json"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("WARNING: coarse: the energy is off by"));
  EXPECT_THAT(run.err, HasSubstr("--set step="));
  const Json report = Json::parse(run.out);
  ASSERT_EQ(report["warnings"].size(), 1u);
  EXPECT_EQ(report["warnings"][0]["kind"], "energy");
  EXPECT_NEAR(report["warnings"][0]["amount"].get<double>(),
              report["audit_error"].get<double>() / report["energy_moved"].get<double>(), 1e-12);
  const ProgramResult picture = run_program({"snapshot", scene, "-o", folder.file("a.png"), "--at", "2", "--quiet"});
  EXPECT_EQ(picture.status, 0) << picture.err;
  EXPECT_THAT(picture.err, HasSubstr("WARNING: coarse: the energy is off by"));
}

TEST(Warnings, HaveARemedyThatCanBeTyped) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("coarse.yaml", coarse("method: explicit_euler\nstep: 0.02\n"));
  const ProgramResult better = run_program({"simulate", scene, "-o", folder.file("a.csv"), "--set", "method=auto", "--set",
                                            "step=null", "--set", "tolerance=null"});
  EXPECT_EQ(better.status, 0) << better.err;
  EXPECT_THAT(better.err, Not(HasSubstr("WARNING")));
}

TEST(Warnings, AreNoneWhereARunIsToDivergeOrIsSound) {
  const TemporaryFolder folder;
  for (const char* more : {"method: explicit_euler\nstep: 0.02\nexpect: diverge\n", "method: rk4\nstep: 0.002\n"}) {
    const std::string scene = folder.write("scene.yaml", coarse(more));
    const std::string torque = std::string(more).find("diverge") != std::string::npos ? "-500*qd1" : "0";
    const ProgramResult run =
        run_program({"simulate", scene, "-o", folder.file("a.csv"), "--force", "--set", "torque.1=" + torque});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("WARNING"))) << more;
  }
}

TEST(Check, SaysThatFrictionLetsCreep) {
  const TemporaryFolder folder;
  const std::string model = folder.write("slider.urdf",
                                         "<robot name='slider'><link name='base'/><link name='cart'><inertial><mass "
                                         "value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
                                         "</link><joint name='rail' type='prismatic'><parent link='base'/><child "
                                         "link='cart'/><axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='9' "
                                         "velocity='9'/><dynamics friction='2'/></joint></robot>");
  const ProgramResult check = run_program({"check", model});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("F tanh(qd / 0.01)"));
  EXPECT_THAT(check.out, HasSubstr("0.0097 rad/s or m/s"));
  // And so it does: 1.5 N against 2 N.
  const ProgramResult run = run_program({"simulate", folder.write("push.yaml", "model: slider.urdf\ntorque: [1.5]\nduration: 1\n"
                                                                             "method: radau5\ntolerance: 1e-9\n"),
                                         "-o", "-"});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string last = run.out.substr(run.out.find_last_of(',') + 1);
  EXPECT_NEAR(std::stod(last), 0.00973, 1e-5) << run.out;
  const ProgramResult plain = run_program({"check", kRoot + "/models/rr.urdf"});
  EXPECT_THAT(plain.out, Not(HasSubstr("friction")));
}

}  // namespace
}  // namespace chainreel
