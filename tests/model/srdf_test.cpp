#include "model/srdf.hpp"

#include <gmock/gmock.h>

#include "model_file.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

SrdfFile read_states(const std::string& text) {
  const TemporaryFolder folder;
  return read_srdf(folder.write("r.srdf", text));
}

std::string srdf_error(const std::string& text) {
  try {
    read_states(text);
    return "";
  } catch (const Error& error) {
    return std::to_string(int(error.code())) + ": " + error.what();
  }
}

TEST(Srdf, GivesNamedStatesInTheirOrderWithLines) {
  const SrdfFile file = read_states(
      "<robot name='arm'>\n<group name='all'><joint name='a'/></group>\n"
      "<group_state name='home' group='all'>\n<joint name='a' value='0.5'/><joint name='root' value='0 0 1 0 "
      "0 0 1'/>\n"
      "</group_state><disable_collisions link1='x' link2='y'/>\n<group_state name='rest' "
      "group='all'/></robot>");
  EXPECT_EQ(file.robot, "arm");
  ASSERT_EQ(file.states.size(), 2u);
  EXPECT_EQ(file.states[0].name, "home");
  EXPECT_EQ(file.states[0].group, "all");
  EXPECT_EQ(file.states[0].line, 3);
  ASSERT_EQ(file.states[0].joints.size(), 2u);
  EXPECT_EQ(file.states[0].joints[0].line, 4);
  EXPECT_THAT(file.states[0].joints[0].values, ElementsAre(0.5));
  EXPECT_EQ(file.states[0].joints[1].values.size(), 7u);
  EXPECT_EQ(file.states[1].name, "rest");
}

TEST(Srdf, TellsAllProblemsWithTheirLines) {
  const std::string error = srdf_error(
      "<robot name='arm'>\n<group_state group='g'><joint name='a' value='1,5'/></group_state>\n"
      "<group_state name='s' group='g'><joint value='1'/><joint name='b'/></group_state>\n"
      "<group_state name='s' group='g'><joint name='c' value='1'/><joint name='c' "
      "value='nan'/></group_state>\n</robot>");
  EXPECT_THAT(error, HasSubstr("r.srdf:2: <group_state> has no name"));
  EXPECT_THAT(error, HasSubstr("r.srdf:2: state '': joint 'a' has the value '1,5', which is not a number"));
  EXPECT_THAT(error, HasSubstr("r.srdf:3: a <joint> of state 's' has no name"));
  EXPECT_THAT(error, HasSubstr("joint 'b' has no value"));
  EXPECT_THAT(error, HasSubstr("r.srdf:4: the state 's' of group 'g' exists already (line 3)"));
  EXPECT_THAT(error, HasSubstr("gives joint 'c' a second value"));
  EXPECT_THAT(error, HasSubstr("'nan', which is not a number"));
}

TEST(Srdf, RefusesWhatIsNone) {
  EXPECT_THAT(srdf_error("<robot name='arm'/>"), HasSubstr("names no state"));
  EXPECT_THAT(srdf_error("<robot name='arm'><link name='l'/></robot>"), HasSubstr("is a URDF, not an SRDF"));
  EXPECT_THAT(srdf_error("<robot>"), HasSubstr("not well-formed"));
  EXPECT_THAT(srdf_error("<scene/>"), HasSubstr("outermost tag must be <robot>"));
  EXPECT_THAT(srdf_error("<robot><xacro:include filename='x'/></robot>"), HasSubstr("expand the file first"));
  std::string deep = "<robot>";
  for (int i = 0; i < 100; ++i) deep += "<group name='g'>";
  EXPECT_THAT(srdf_error(deep), HasSubstr("7: "));
}

}  // namespace
}  // namespace chainreel
