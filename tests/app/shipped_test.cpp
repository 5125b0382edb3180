// Models and styles that come with the program, named by scenes that lie anywhere.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kSmall = "duration: 0.1\nmethod: rk4\nstep: 0.01\nvideo: {width: 64, height: 36, fps: 20}\n";

ProgramResult in(const TemporaryFolder& folder, const Words& words) {
  return run_program(words, {.folder = folder.path()});
}

Json simulated(const TemporaryFolder& folder, const std::string& scene) {
  const ProgramResult run = in(folder, {"simulate", scene, "-o", "a.csv", "--force", "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  return run.status == 0 ? Json::parse(run.out) : Json();
}

TEST(ShippedModel, MayBeNamedWithoutItsEndingWhereOnlyModelsAreMeant) {
  const TemporaryFolder folder;
  for (const char* model : {"rr", "rrr"}) {
    const ProgramResult run = in(folder, {"equations", model, "--latex", "--only", "M"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "") << "nothing to be said";
    EXPECT_EQ(run.out, in(folder, {"equations", CHAINREEL_SOURCE_FOLDER "/models/" + std::string(model) + ".urdf", "--latex", "--only", "M"}).out);
  }
  EXPECT_EQ(in(folder, {"ellipse", "rrr", "--pose", "0,1,0.5", "-o", "a.png"}).status, 0);
  EXPECT_EQ(in(folder, {"render", "rr"}).status, 3) << "a film takes a scene";
  fs::create_directory(folder.file("rr_free"));
  EXPECT_THAT(in(folder, {"check", "rr_free.yaml"}).out, HasSubstr("rr_free"));
  EXPECT_THAT(in(folder, {"render", "rr_free"}).err, HasSubstr("is a folder here: the scene of that name which comes with the program is rr_free.yaml"));
}

// A film alone gives its scene back, with the model that came with the program, and says what its bytes depend on.
TEST(ShippedModel, OfAFilmAloneIsFoundAgain) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"render", "assets/scenes/rr_free.yaml", "--set", "duration=0.1", "--set", "video.width=64", "--set", "video.height=36", "--quiet", "-o", folder.file("a.mp4")}).status, 0);
  const ProgramResult extracted = in(folder, {"extract", "a.mp4", "-o", "again.yaml"});
  EXPECT_EQ(extracted.status, 0) << extracted.err;
  EXPECT_THAT(extracted.err, AllOf(HasSubstr("note: chainreel "), HasSubstr("made it of a scene called rr_free.yaml"), Not(HasSubstr("there is no"))));
  EXPECT_EQ(in(folder, {"extract", "a.mp4", "-o", "rr_free.yaml"}).status, 0);
  ASSERT_EQ(in(folder, {"render", "rr_free.yaml", "--quiet", "-o", "b.mp4"}).status, 0);
  EXPECT_EQ(in(folder, {"compare", "a.mp4", "b.mp4", "--tolerance", "0", "--count-edges"}).status, 0) << "the same frames";
}

TEST(ShippedModel, IsFoundByItsNameWhereTheSceneHasNoFileOfThatName) {
  const TemporaryFolder folder;
  folder.write("named.yaml", "model: rr.urdf\n" + kSmall);
  folder.write("by_path.yaml", "model: " CHAINREEL_SOURCE_FOLDER "/models/rr.urdf\n" + kSmall);
  const std::string shipped = simulated(folder, "named.yaml")["model_sha256"];
  EXPECT_EQ(shipped, simulated(folder, "by_path.yaml")["model_sha256"].get<std::string>());
  // What lies beside the scene comes first.
  fs::copy_file(CHAINREEL_SOURCE_FOLDER "/models/pp.urdf", folder.file("rr.urdf"));
  const std::string own = simulated(folder, "named.yaml")["model_sha256"];
  EXPECT_NE(own, shipped);
  fs::remove(folder.file("rr.urdf"));
  // Of --set, and from standard input.
  EXPECT_THAT(in(folder, {"check", "by_path.yaml", "--set", "model=rrr.urdf"}).out, HasSubstr("models/rrr.urdf"));
  EXPECT_EQ(in(folder, {"dynamics", "named.yaml", "--at", "0.05"}).status, 0);
}

TEST(ShippedModel, IsRememberedByItsNameSoThatFilmsDoNotDependOnThePlace) {
  const TemporaryFolder one, other;
  for (const TemporaryFolder* folder : {&one, &other}) {
    folder->write("a.yaml", "model: rr.urdf\nstyle: lecture.yaml\n" + kSmall);
    ASSERT_EQ(in(*folder, {"render", "a.yaml", "-o", "a.mp4", "--quiet"}).status, 0);
  }
  EXPECT_EQ(read_whole_file(one.file("a.mp4")), read_whole_file(other.file("a.mp4")));
  const ProgramResult extracted = in(one, {"extract", "a.mp4"});
  EXPECT_EQ(extracted.err, "") << "nothing is missing";
  EXPECT_THAT(extracted.out, AllOf(HasSubstr("model: \"rr.urdf\""), HasSubstr("file: \"lecture.svg\""), Not(HasSubstr("share/"))));
  fs::create_directory(one.file("deeper"));
  ASSERT_EQ(in(one, {"extract", "a.mp4", "-o", "deeper/b.yaml"}).status, 0);
  ASSERT_EQ(in(one, {"render", "deeper/b.yaml", "-o", "deeper/a.mp4", "--quiet"}).status, 0);
  const auto hash = [&](const char* film) { return Json::parse(in(one, {"extract", film, "--json"}).out)["audit"]["trajectory_sha256"]; };
  EXPECT_EQ(hash("deeper/a.mp4"), hash("a.mp4"));
}

TEST(ShippedModel, IsTakenBySuitesAndSweeps) {
  const TemporaryFolder folder;
  folder.write("suite.yaml", "model: rr.urdf\nsize: 64x36\nposes: {a: [0, 1]}\n");
  EXPECT_EQ(in(folder, {"verify", "suite.yaml", "--missing", "write"}).status, 0);
  EXPECT_EQ(in(folder, {"verify", "suite.yaml"}).status, 0);
  for (const auto& entry : fs::recursive_directory_iterator(folder.file("suite.baselines")))
    if (entry.path().extension() == ".json")
      EXPECT_THAT(read_whole_file(entry.path().string()), Not(HasSubstr("models/rr.urdf"))) << "baselines are the same wherever the program is installed";
  folder.write("a.yaml", "model: rr.urdf\n" + kSmall);
  const ProgramResult swept = in(folder, {"sweep", "a.yaml", "--over", "model=rr.urdf,pp.urdf", "-o", "a.csv"});
  EXPECT_EQ(swept.status, 0) << swept.err;
}

TEST(ShippedModel, OfANameThatIsNearIsNamedInOneError) {
  const TemporaryFolder folder;
  folder.write("a.yaml", "model: humanoit.urdf\n" + kSmall);
  const ProgramResult run = in(folder, {"check", "a.yaml"});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("a.yaml:1:8: there is no model file humanoit.urdf"), HasSubstr("did you mean 'humanoid.urdf'?")));
  folder.write("b.yaml", "model: ../models/rr.urdf\n" + kSmall);
  EXPECT_THAT(in(folder, {"check", "b.yaml"}).err, Not(HasSubstr("comes with the program"))) << "a path is none of the program's";
}

}  // namespace
}  // namespace chainreel
