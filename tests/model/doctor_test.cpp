#include "model/doctor.hpp"

#include <gmock/gmock.h>

#include "model_file.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using Severity = Finding::Severity;

// "warning 3: message"
std::vector<std::string> findings_of(const std::string& inside, const ModelOptions& options = {}) {
  const TemporaryFolder folder;
  std::vector<std::string> lines;
  for (const Finding& finding : examine_model(folder.write("model.urdf", robot_text(inside)), options)) {
    lines.push_back(to_string(finding.severity) + " " + std::to_string(finding.place.line) + ": " +
                    finding.message);
  }
  return lines;
}

std::string arm_with(const std::string& inertial, const std::string& rest = "") {
  return link_text("base") + link_text("arm", inertial + rest) +
         joint_text("swing", "continuous", "base", "arm");
}

std::string box(const std::string& size, const std::string& tag = "visual") {
  return "<" + tag + "><geometry><box size='" + size + "'/></geometry></" + tag + ">";
}

TEST(Doctor, FindsNothingWrongWithASoundModel) {
  EXPECT_THAT(findings_of(arm_with(
                  inertial_text(1, "0.5 0 0", "ixx='0.01' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'"),
                  box("1 0.1 0.1"))),
              IsEmpty());
}

TEST(Doctor, TellsEveryErrorOfReading) {
  EXPECT_THAT(findings_of(arm_with("")),
              Contains(StartsWith("error 3: link 'arm' moves (joint 'swing') but has no <inertial>")));
  EXPECT_THAT(findings_of("<link>"), ElementsAre(HasSubstr("is not well-formed XML")));
  const auto missing = examine_model("no/such/file.urdf");
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].severity, Severity::error);
}

TEST(Doctor, SeesInertiasThatNoBodyHas) {
  const auto with_moments = [](const std::string& x, const std::string& y, const std::string& z) {
    return findings_of(arm_with(inertial_text(
        1, "0 0 0", "ixx='" + x + "' ixy='0' ixz='0' iyy='" + y + "' iyz='0' izz='" + z + "'")));
  };
  EXPECT_THAT(with_moments("1", "1", "2.5"),
              ElementsAre(AllOf(StartsWith("warning 3"), HasSubstr("principal moments 1, 1, 2.5"))));
  EXPECT_THAT(with_moments("1", "1", "2"), IsEmpty());  // a thin plate
  EXPECT_THAT(with_moments("0", "1", "1"), IsEmpty());  // a thin rod
  EXPECT_THAT(with_moments("-1", "1", "1"),
              Contains(HasSubstr("error 3: link 'arm' has an inertia that is not positive")));
  EXPECT_THAT(with_moments("0", "0", "0"), Contains(HasSubstr("note 3: link 'arm' is a point mass")));
}

TEST(Doctor, SeesOffDiagonalInertiaThatIsTooLarge) {
  const std::string skewed = "ixx='1' ixy='1.5' ixz='0' iyy='1' iyz='0' izz='1'";
  EXPECT_THAT(
      findings_of(arm_with(inertial_text(1, "0 0 0", skewed))),
      Contains(HasSubstr("error 3: link 'arm' has an inertia that is not positive (principal moments -0.5")));
}

TEST(Doctor, SeesACentreOfMassFarOutsideTheShapes) {
  const auto with_com = [](const std::string& com) {
    return findings_of(
        arm_with(inertial_text(1, com, "ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'"),
                 box("1 0.1 0.1") + box("0.2 0.2 0.2", "collision")));
  };
  EXPECT_THAT(with_com("500 0 0"), ElementsAre(HasSubstr("has its centre of mass 500 m outside its shapes")));
  EXPECT_THAT(with_com("0.4 0 0"), IsEmpty());
  EXPECT_THAT(with_com("1 0 0"), IsEmpty());  // outside, but not far
}

TEST(Doctor, SeesInertiasTooLargeForTheirShapes) {
  EXPECT_THAT(
      findings_of(arm_with(inertial_text(1, "0 0 0", "ixx='100' ixy='0' ixz='0' iyy='100' iyz='0' izz='100'"),
                           box("1 0.1 0.1"))),
      ElementsAre(AllOf(StartsWith("warning 3"), HasSubstr("radius of gyration of 10 m"))));
}

TEST(Doctor, SuspectsWrongUnits) {
  EXPECT_THAT(findings_of(arm_with(inertial_text(25'000))), ElementsAre(HasSubstr("were grams meant?")));
  EXPECT_THAT(findings_of(arm_with(inertial_text(), box("300 20 20"))),
              Contains(HasSubstr("were millimetres meant?")));
  EXPECT_THAT(findings_of(link_text("base") +
                          moving("arm", "continuous", "base", "0 0 1", "<origin xyz='0 0 333'/>")),
              ElementsAre(HasSubstr("sits 333 m from its parent link")));
}

TEST(Doctor, SeesAttributesThatLookMisspelt) {
  const auto with_origin = [](const std::string& origin) {
    return findings_of(link_text("base") + link_text("arm", inertial_text()) +
                       joint_text("swing", "continuous", "base", "arm", "0 0 1", "<origin " + origin + "/>"));
  };
  EXPECT_THAT(with_origin("xzy='0 0 1'"),
              Contains("warning 4: joint 'swing': the attribute 'xzy' of <origin> is not read: did you mean 'xyz'?"));
  EXPECT_THAT(with_origin("xyz='0 0 1' ryp='0 0 1'"), Contains(HasSubstr("'ryp' of <origin> is not read: did you mean 'rpy'?")));
  EXPECT_THAT(with_origin("xyz='0 0 1' quat='1 0 0 0'"), Contains("note 4: joint 'swing': the attribute 'quat' of <origin> is not read"));
  EXPECT_THAT(with_origin("xyz='0 0 1' rpy='0 0 1'"), IsEmpty());
}

TEST(Doctor, SeesAnglesThatLookLikeDegrees) {
  const auto with_angles = [](const std::string& rpy) {
    return findings_of(link_text("base") + link_text("arm", inertial_text()) +
                       joint_text("swing", "continuous", "base", "arm", "0 0 1", "<origin rpy='" + rpy + "'/>"));
  };
  EXPECT_THAT(with_angles("90 0 0"), Contains(AllOf(StartsWith("warning 4: joint 'swing' has rpy=\"90 0 0\""),
                                                    HasSubstr("were degrees meant?"))));
  EXPECT_THAT(with_angles("0 -45 0"), Contains(HasSubstr("were degrees meant?")));
  EXPECT_THAT(with_angles("1.5708 -3.1416 6.2832"), IsEmpty());
  EXPECT_THAT(findings_of(arm_with("<inertial><origin rpy='0 0 180'/><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' "
                                   "iyy='1' iyz='0' izz='1'/></inertial>")),
              Contains(HasSubstr("the <inertial> of link 'arm' has rpy=\"0 0 180\"")));
}

TEST(Doctor, RemarksWhatOtherProgramsPassOver) {
  EXPECT_THAT(findings_of(arm_with(inertial_text()) + link_text("pad") +
                          joint_text("stick", "fixed", "arm", "pad", "0 0 1", "<mimic joint='none'/>")),
              Contains("warning 6: joint 'stick' is fixed, so its <mimic> is not read: give it another type if it shall move"));
  EXPECT_THAT(findings_of(arm_with(inertial_text()) + "<material name='worn'><texture/></material>\n"),
              Contains(HasSubstr("material 'worn': <texture> names no file and is not read")));
}

TEST(Doctor, MeasuresMeshes) {
  const TemporaryFolder folder;
  folder.write(
      "m.stl",
      "solid m\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 250 0 0\nvertex 0 100 0\nendloop\n"
      "endfacet\nendsolid m\n");
  const auto with_mesh = [&](const std::string& rest, const std::string& tag = "visual") {
    const std::string shape = "<" + tag + "><geometry><mesh " + rest + "/></geometry></" + tag + ">";
    const std::string path = folder.write("arm.urdf", robot_text(arm_with(inertial_text(1, "0 0 0"), shape)));
    std::string all;
    for (const Finding& finding : examine_model(path))
      all += to_string(finding.severity) + ": " + finding.message + "\n";
    return all;
  };
  EXPECT_THAT(with_mesh("filename='m.stl'"),
              HasSubstr("has a mesh of 250 m: were millimetres meant? Write scale="));
  EXPECT_THAT(with_mesh("filename='m.stl' scale='1e-7 1e-7 1e-7'"), HasSubstr("is its scale applied twice"));
  // 1 kg m^2 and 1 kg in 0.27 m.
  EXPECT_THAT(with_mesh("filename='m.stl' scale='0.001 0.001 0.001'"), HasSubstr("measure 0.269 m across"));
  EXPECT_THAT(with_mesh("filename='lost.stl'"),
              AllOf(HasSubstr("warning: link 'arm': the mesh 'lost.stl' is not found (searched "),
                    HasSubstr("/lost.stl)")));
  EXPECT_THAT(with_mesh("filename='lost.stl'", "collision"),
              HasSubstr("warning: link 'arm': the mesh 'lost.stl'"));
  folder.write("broken.stl", "no mesh");
  EXPECT_THAT(with_mesh("filename='broken.stl'"), HasSubstr("warning: link 'arm': the mesh"));
}

TEST(Doctor, CountsTagsThatAreNotReadAndNamesMisspeltOnes) {
  const std::string sound = arm_with(inertial_text());
  EXPECT_THAT(findings_of(sound + "<gazebo/>\n<transmission/>\n<gazebo/>"),
              ElementsAre("note 5: <gazebo> inside <robot> is not read (2 times, the first is here)",
                          "note 6: <transmission> inside <robot> is not read"));
  EXPECT_THAT(findings_of(arm_with(inertial_text(), "<visul/>")),
              ElementsAre("warning 3: <visul> inside <link> is not read: did you mean 'visual'?"));
}

TEST(Doctor, FindsOddLimits) {
  const auto with_limit = [](const std::string& limit, const std::string& type = "revolute") {
    return findings_of(link_text("base") + moving("arm", type, "base", "0 0 1", limit));
  };
  EXPECT_THAT(with_limit(""), ElementsAre(StartsWith("note 4: joint 'to_arm' is revolute without <limit>")));
  EXPECT_THAT(with_limit("", "continuous"), IsEmpty());
  EXPECT_THAT(with_limit("<limit lower='-1' upper='1' effort='1' velocity='1'/>"), IsEmpty());
  EXPECT_THAT(with_limit("<limit effort='1' velocity='1'/>"),
              ElementsAre(HasSubstr("has neither lower nor upper")));
  EXPECT_THAT(with_limit("<limit effort='1' velocity='1'/>", "continuous"), IsEmpty());
  EXPECT_THAT(with_limit("<limit lower='1' upper='-1' effort='1' velocity='1'/>"),
              ElementsAre(HasSubstr("swap them")));
  EXPECT_THAT(with_limit("<limit lower='1' upper='1' effort='1' velocity='1'/>"),
              ElementsAre(HasSubstr("the single value 1")));
  EXPECT_THAT(with_limit("<limit lower='-90' upper='90' effort='1' velocity='1'/>"),
              ElementsAre(HasSubstr("were degrees meant?")));
  EXPECT_THAT(with_limit("<limit lower='-90' upper='90' effort='1' velocity='1'/>", "prismatic"), IsEmpty());
  EXPECT_THAT(with_limit("<limit lower='-1' upper='1' effort='0' velocity='1'/>"),
              ElementsAre(HasSubstr("has a limit of 0 for effort")));
}

TEST(Doctor, TellsOfMassesThatItGaveAndOfPlanesThatAreMissed) {
  ModelOptions options;
  options.massless = 1e-6;
  EXPECT_THAT(findings_of(arm_with(""), options),
              ElementsAre("note 0: link 'arm' has no mass of its own and is given 1e-06 kg"));
  EXPECT_THAT(findings_of(link_text("base") + moving("a", "continuous", "base", "1 0 0") +
                          moving("b", "continuous", "a", "0 0 1", "<origin rpy='0 1.5708 0'/>")),
              ElementsAre(HasSubstr(
                  "warning 0: almost planar, but spatial: the axes of to_a and to_b are not parallel")));
}

TEST(Doctor, TellsFewOfAKindAndCountsTheRest) {
  std::string joints = link_text("base");
  for (int i = 0; i < 100; ++i) joints += moving("l" + std::to_string(i), "revolute", "base");
  const auto findings = findings_of(joints);
  ASSERT_EQ(findings.size(), std::size_t(kMostOfAKind) + 1);
  EXPECT_EQ(findings.back(), "note 14: and 95 more joints without <limit>");
}

TEST(Doctor, PutsErrorsBeforeWarningsBeforeNotes) {
  const auto findings = findings_of(
      "<gazebo/>" + arm_with(inertial_text(-0.0, "0 0 0", "ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'"),
                             box("300 1 1")));
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_THAT(findings[0], StartsWith("error"));
  EXPECT_THAT(findings[1], StartsWith("warning"));
  EXPECT_THAT(findings[2], StartsWith("note"));
}

}  // namespace
}  // namespace chainreel
