// Robots in space on the command line: flags of the view, shapes, sections.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json.hpp"
#include "encode/png.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;
class OnTheCommandLine : public ::testing::Test {
 protected:
  Image snapshot(const Words& more, const std::string& model = "models/arm.urdf") {
    const std::string file = folder_.file("a.png");
    const ProgramResult result = run_program(with(
        {"snapshot", model, "-o", file, "--force", "--quiet", "--width", "320", "--height", "180"}, more));
    EXPECT_EQ(result.status, 0) << result.err;
    return read_png(file);
  }
  static double difference(const Image& a, const Image& b) { return compare_pictures(a, b).mean; }

  TemporaryFolder folder_;
};

TEST_F(OnTheCommandLine, EveryFlagOfTheViewChangesThePicture) {
  const Words bent{"--pose", "0,0.6,1.2,0,0.5,0"};
  const Image plain = snapshot(bent);
  for (const Words& flag : {Words{"--azimuth", "80deg"},
                            {"--elevation", "60deg"},
                            {"--distance", "2"},
                            {"--distance", "parallel"},
                            {"--fit", "[-1, -1, 1, 1]"},
                            {"--links", "plain"}})
    EXPECT_GT(difference(plain, snapshot(with(bent, flag))), 0.5) << flag[0] << " " << flag[1];
  EXPECT_EQ(difference(plain, snapshot(with(
                                  bent, {"--azimuth", "35deg", "--elevation", "20deg", "--links", "auto"}))),
            0);
}

TEST_F(OnTheCommandLine, PlanarChainsAreSeenObliquelyWhereAnAngleIsNamed) {
  const Words pose{"--pose", "0.5,1"};
  EXPECT_GT(difference(snapshot(pose, "models/rr.urdf"),
                       snapshot(with(pose, {"--azimuth", "40deg"}), "models/rr.urdf")),
            0.5);
}

TEST_F(OnTheCommandLine, FlagsThatMakeNoSenseAreRefused) {
  const auto error = [&](const Words& more) {
    const ProgramResult result =
        run_program(with({"snapshot", "models/arm.urdf", "-o", folder_.file("b.png")}, more));
    EXPECT_EQ(result.status, 3);
    return result.err;
  };
  EXPECT_THAT(error({"--azimuth", "35"}),
              HasSubstr("'camera.azimuth' must lie between -360deg and 360deg; a number without"));
  EXPECT_THAT(error({"--elevation", "120deg"}), HasSubstr("'camera.elevation' must lie between -90deg and 90deg"));
  EXPECT_THAT(error({"--distance", "0"}), HasSubstr("'camera.distance' must be above 0 and up to 1e6 m, or parallel"));
  EXPECT_THAT(error({"--distance", "1e300"}), HasSubstr("'camera.distance' must be above 0"));
  EXPECT_THAT(error({"--fit", "[1, 0, 0, 1]"}), HasSubstr("'camera.fit' must grow from left to right"));
  EXPECT_THAT(error({"--fit", "1,0,0,1"}), HasSubstr("'camera.fit' must be motion, or the part that is shown"));
  EXPECT_THAT(error({"--links", "meshes"}),
              HasSubstr("'links' must be auto, plain, visual or collision, not 'meshes'"));
}

TEST_F(OnTheCommandLine, ShapesThatAreNotThereAreBadInput) {
  const ProgramResult none =
      run_program({"snapshot", "models/arm.urdf", "--links", "collision", "-o", folder_.file("c.png")});
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("'links' is collision, but the model has no <collision>"));
  const ProgramResult inside =
      run_program({"snapshot", "models/arm.urdf", "--distance", "0.1", "-o", folder_.file("c.png")});
  EXPECT_EQ(inside.status, 3);
  EXPECT_THAT(inside.err, HasSubstr("puts the eye among the bodies"));
}

TEST_F(OnTheCommandLine, TheDistanceThatAnErrorNamesIsAccepted) {
  const ProgramResult refused =
      run_program({"snapshot", "models/arm.urdf", "--distance", "0.1", "-o", folder_.file("d.png")});
  const std::size_t end = refused.err.find(" m are needed at least");
  ASSERT_NE(end, std::string::npos) << refused.err;
  const std::size_t begin = refused.err.rfind(' ', end - 1) + 1;
  snapshot({"--distance", refused.err.substr(begin, end - begin)});
}

TEST_F(OnTheCommandLine, CheckTellsWhatIsDrawn) {
  const Words words{"check", "assets/scenes/arm_ellipsoid.yaml", "--json"};
  const Json shapes = Json::parse(run_program(words).out)["cost"];
  EXPECT_EQ(shapes["shapes"], 13);  // <visual>s in the file
  EXPECT_GT(shapes["triangles"], 1000);
  EXPECT_EQ(Json::parse(run_program(with(words, {"--set", "links=plain"})).out)["cost"]["shapes"], 0);
}

TEST_F(OnTheCommandLine, SectionsHaveTwoSemiAxes) {
  const auto report = [&](const std::string& shape) {
    const ProgramResult result =
        run_program({"ellipse", "models/arm.urdf", "--pose", "0,0.6,1.2,0,0.7,0", "--shape", shape, "--json",
                     "-o", folder_.file("e.csv"), "--force"});
    EXPECT_EQ(result.status, 0) << result.err;
    return Json::parse(result.out);
  };
  const Json section = report("section"), whole = report("ellipsoid");
  EXPECT_EQ(section["shape"], "section");
  EXPECT_EQ(section["poses"][0]["semi_axes"].size(), 2u);
  EXPECT_EQ(whole["poses"][0]["semi_axes"].size(), 3u);
  EXPECT_EQ(section["poses"][0]["eigenvalues"], whole["poses"][0]["eigenvalues"]);
  // No section reaches beyond the whole, none is thinner than its thinnest.
  const auto& cut = section["poses"][0]["semi_axes"];
  const auto& all = whole["poses"][0]["semi_axes"];
  EXPECT_LE(cut[0].get<double>(), all[0].get<double>() + 1e-12);
  EXPECT_GE(cut[1].get<double>(), all[2].get<double>() - 1e-12);
}

}  // namespace
}  // namespace chainreel
