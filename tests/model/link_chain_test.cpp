// Chains in numbers: what they take, what they refuse, and the file that they stand for.
#include "model/link_chain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "model/doctor.hpp"
#include "model/read_chain.hpp"
#include "model/urdf_file.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string first_problem(LinkChain links) {
  const std::vector<LinkProblem> problems = complete(links);
  return problems.empty() ? "" : problems.front().key + " " + problems.front().message;
}

TEST(LinkChain, TakesOneNumberForAllLinksAndFillsInWhatIsLeftOut) {
  LinkChain links{.links = {0.5, 0.4, 0.3}, .damping = {0.1}};
  EXPECT_TRUE(complete(links).empty());
  EXPECT_THAT(links.masses, ElementsAre(1, 1, 1));
  EXPECT_THAT(links.damping, ElementsAre(0.1, 0.1, 0.1));
  EXPECT_EQ(links.joints, "RRR");
  EXPECT_EQ(text_of(links), "{links: [0.5, 0.4, 0.3], masses: [1, 1, 1], joints: RRR, shape: rod, damping: [0.1, 0.1, 0.1]}");
}

TEST(LinkChain, SaysWhichListDoesNotFit) {
  EXPECT_EQ(first_problem({.links = {1, 1, 1}, .masses = {1, 2}}),
            "masses has 2 numbers, but the chain has 3 links: write one for each, or one for all");
  EXPECT_THAT(first_problem({.links = {1, 1}, .joints = "RRR"}), HasSubstr("'RRR' names 3 joints, but the chain has 2 links"));
  EXPECT_THAT(first_problem({.links = {1}, .joints = "Q"}), HasSubstr("letters R (turns) and P (slides)"));
  EXPECT_THAT(first_problem({.links = {1}, .joints = "xR"}), HasSubstr("letters R"));
  EXPECT_THAT(first_problem({.links = {-1}}), HasSubstr("holds -1: numbers must lie between 0"));
  EXPECT_THAT(first_problem({.links = {1}, .masses = {0}}), HasSubstr("masses holds 0"));
  EXPECT_THAT(first_problem({.links = {1}, .damping = {-0.1}}), HasSubstr("damping holds -0.1"));
  EXPECT_THAT(first_problem({}), HasSubstr("links must hold the length of each link"));
  EXPECT_THAT(first_problem({.links = {1}, .dh = {{1, 0, 0, 0}}}), HasSubstr("leave one out"));
  EXPECT_THAT(first_problem({.dh = {{1, 0, 0, 0}}, .joints = "Rx"}), HasSubstr("turn about z"));
  EXPECT_THAT(first_problem({.links = std::vector<double>(101, 1.0)}), HasSubstr("beyond 100 write a URDF file"));
  EXPECT_EQ(first_problem({.links = std::vector<double>(100, 1.0)}), "");
}

TEST(LinkChain, MayLimitTheEffortsOfItsJointsAndNothingElse) {
  LinkChain links{.links = {0.5, 0.4}, .efforts = {20}, .joints = "RP"};
  ASSERT_TRUE(complete(links).empty());
  EXPECT_THAT(text_of(links), HasSubstr("efforts: [20, 20]}"));
  ModelSource source("scene.yaml");
  source.links = links;
  EXPECT_TRUE(read_urdf_file(source).remarks.empty());
  const Chain chain = read_chain(source);
  for (std::size_t i = 1; i <= 2; ++i) {
    const JointLimit& limit = chain.bodies[i].joint.limit;
    EXPECT_EQ(limit.effort, 20);
    EXPECT_EQ(limit.velocity, std::numeric_limits<double>::infinity());
    EXPECT_GE(limit.upper, 1e9) << "as good as none";
    EXPECT_LE(limit.lower, -1e9);
  }
  EXPECT_THAT(first_problem({.links = {1}, .efforts = {0}}), HasSubstr("efforts holds 0"));
  EXPECT_THAT(first_problem({.links = {1, 1}, .efforts = {1, 2, 3}}), HasSubstr("efforts has 3 numbers"));
}

TEST(LinkChain, HasLinksThatScenesCanName) {
  LinkChain links{.links = {0.5, 0.4}, .joints = "RP"};
  ASSERT_TRUE(complete(links).empty());
  ModelSource source("scene.yaml");
  source.links = links;
  const UrdfFile file = read_urdf_file(source);
  std::vector<std::string> names;
  for (const UrdfLink& link : file.links) names.push_back(link.name);
  EXPECT_THAT(names, ElementsAre("base", "link1", "link2", "gripper"));
  EXPECT_TRUE(file.remarks.empty()) << "the file's own reader finds nothing to remark";
  const Chain chain = read_chain(source);
  EXPECT_EQ(chain.frames[std::size_t(chain.end_effector)].name, "gripper");
  EXPECT_THAT(chain.coordinate_names, ElementsAre("joint1", "joint2"));
}

// No line of a text that nobody can look at.
TEST(LinkChain, IsToldOfAtThePlaceThatAsksForIt) {
  LinkChain links{.links = {0, 1}, .joints = "RR", .shape = LinkMass::point};
  links.links = {1, 0};  // the last link moves no mass
  ASSERT_TRUE(complete(links).empty());
  ModelSource source("scene.yaml");
  source.place = {"scene.yaml", 4, 8};
  source.links = links;
  try {
    read_chain(source);
    FAIL() << "a joint that moves no mass was taken";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("scene.yaml:4:8: joint 'joint2' moves no mass"));
  }
}

TEST(LinkChain, InSpaceHasInertiaAboutItsOwnAxis) {
  LinkChain wrist{.dh = {{0, 1.5707963267948966, 0.3, 0}, {0, -1.5707963267948966, 0, 0}, {0, 0, 0.1, 0}}};
  ASSERT_TRUE(complete(wrist).empty());
  ModelSource source("scene.yaml");
  source.links = wrist;
  EXPECT_EQ(read_chain(source).nv, 3) << "no joint is without inertia";
}

}  // namespace
}  // namespace chainreel
