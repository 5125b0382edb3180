// Every file below tests/model/bad breaks one thing and says in its first line what must be reported:
// <!-- expect LINE: MESSAGE -->
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>

#include "model_file.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

struct Expectation {
  int line = 0;
  std::string message;
};

Expectation expectation_of(const std::string& path) {
  std::ifstream stream(path);
  std::string first;
  std::getline(stream, first);
  std::smatch match;
  if (!std::regex_match(first, match, std::regex("<!-- expect (\\d+): (.*) -->")))
    return {-1, "no expectation"};
  return {std::stoi(match[1]), match[2]};
}

class BadFile : public ::testing::TestWithParam<std::string> {};

TEST_P(BadFile, IsRefusedWithItsMessageAndLineAndNothingElse) {
  const Expectation expected = expectation_of(GetParam());
  try {
    read_chain(GetParam());
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.problems(), testing::SizeIs(1)) << error.what();
    EXPECT_EQ(error.problems()[0].place.line, expected.line) << error.what();
    EXPECT_EQ(error.problems()[0].place.file, GetParam());
    EXPECT_THAT(error.problems()[0].message, testing::HasSubstr(expected.message));
  }
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  return fs::path(info.param).stem().string();
}

INSTANTIATE_TEST_SUITE_P(Models, BadFile, ::testing::ValuesIn(files_in(CHAINREEL_SOURCE "/tests/model/bad")),
                         test_name);

class GoodFile : public ::testing::TestWithParam<std::string> {};

// The same tags in their right form: what is refused above is refused for its fault, not for its looks.
TEST_P(GoodFile, IsRead) {
  EXPECT_EQ(refusal_of(GetParam()), "");
}

INSTANTIATE_TEST_SUITE_P(Models, GoodFile, ::testing::ValuesIn(files_in(CHAINREEL_SOURCE "/tests/model/good")),
                         test_name);
INSTANTIATE_TEST_SUITE_P(OfTheProgram, GoodFile, ::testing::ValuesIn(files_in(CHAINREEL_SOURCE "/models")),
                         test_name);

TEST(BadFiles, AllProblemsOfAFileAreToldInItsOrder) {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "many.urdf",
      robot_text(link_text("base") + link_text("arm", inertial_text(-1)) +
                 joint_text("swing", "continuous", "base", "arm", "0 0 0") +
                 joint_text("lost", "continuous", "base", "nowhere", "0 0 1", "<mimic joint='none'/>")));
  try {
    read_chain(path);
    FAIL() << "it was read";
  } catch (const Error& error) {
    std::vector<int> lines;
    for (const Problem& problem : error.problems()) lines.push_back(problem.place.line);
    EXPECT_THAT(lines, testing::ElementsAre(3, 4, 5, 5)) << error.what();
  }
}

TEST(BadFiles, ShapesWithoutTheirMeasuresAreRefused) {
  const auto refusal = [](const std::string& shape) {
    const TemporaryFolder folder;
    return refusal_of(folder.write("m.urdf", robot_text(link_text("base", "<visual><geometry>" + shape + "</geometry></visual>") +
                                                        moving("arm", "continuous", "base"))));
  };
  for (const auto& [shape, missing] : {std::pair{"<box/>", "<box size> is missing"},
                                       {"<box size='1 2'/>", "<box size>"},
                                       {"<sphere/>", "<sphere radius> is missing"},
                                       {"<sphere radius='one'/>", "<sphere radius>"},
                                       {"<cylinder length='1'/>", "<cylinder radius> is missing"},
                                       {"<cylinder radius='1'/>", "<cylinder length> is missing"},
                                       {"<box size='1 -2 3'/>", "the size of its <box> is negative (-2)"},
                                       {"<sphere radius='-1'/>", "the radius of its <sphere> is negative (-1)"},
                                       {"<cylinder radius='-1' length='1'/>", "the radius of its <cylinder>"},
                                       {"<cylinder radius='1' length='-1'/>", "the length of its <cylinder>"},
                                       {"<mesh/>", "names no file"}}) {
    EXPECT_THAT(refusal(shape), testing::AllOf(testing::HasSubstr("m.urdf:2"), testing::HasSubstr(missing))) << shape;
  }
  EXPECT_EQ(refusal("<cylinder radius='1' length='1'/>"), "");  // negative control
}

TEST(BadFiles, OfVeryManyProblemsTheFirstAreToldAndTheRestCounted) {
  std::string links = link_text("base");
  for (int i = 0; i < 1000; ++i) links += link_text("base");
  const TemporaryFolder folder;
  const std::string message = refusal_of(folder.write("same.urdf", robot_text(links)));
  EXPECT_THAT(message, testing::HasSubstr("and 970 more problems"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 30);
}

TEST(BadFiles, AreFoundToBeMissingFoldersOrNoText) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal_of((folder.path() / "none.urdf").string()), testing::HasSubstr("no such file"));
  EXPECT_THAT(refusal_of(folder.path().string()), testing::HasSubstr("is not a file with text"));
  EXPECT_THAT(refusal_of(folder.write("zero.urdf", std::string("<robot>\0</robot>", 16))),
              testing::HasSubstr("holds zero bytes"));
  EXPECT_THAT(refusal_of(folder.write("void.urdf", "")), testing::HasSubstr("is not well-formed XML"));
}

}  // namespace
}  // namespace chainreel
