// camera, links and mesh_up of a scene.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "scene/text/read_scene.hpp"
#include "scene/text/write_scene.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CameraKeys : public WrittenScenes {};

TEST_F(CameraKeys, AreReadWithTheirUnits) {
  const Scene scene = read(
      "links: visual\nmesh_up: file\n"
      "camera: {azimuth: -40deg, elevation: 0.25, distance: 3, fit: [-1, -0.5, 2, 1.5]}\n");
  EXPECT_EQ(scene.links, LinkShapes::visual);
  EXPECT_EQ(scene.mesh_up, MeshUp::file);
  EXPECT_DOUBLE_EQ(*scene.camera.azimuth, -40 * std::numbers::pi / 180);
  EXPECT_EQ(*scene.camera.elevation, 0.25);
  EXPECT_EQ(*scene.camera.distance, 3);
  EXPECT_THAT(*scene.camera.fit, ElementsAre(-1, -0.5, 2, 1.5));
}

TEST_F(CameraKeys, LeaveTheViewToTheFilmWhereTheyAreAbsent) {
  const Scene scene = read("camera: {fit: motion}\n");
  EXPECT_FALSE(scene.camera.azimuth || scene.camera.elevation || scene.camera.distance || scene.camera.fit);
  EXPECT_EQ(scene.links, LinkShapes::automatic);
  EXPECT_EQ(scene.mesh_up, MeshUp::rviz);
}

TEST_F(CameraKeys, KnowParallelRays) {
  EXPECT_TRUE(std::isinf(*read("camera: {distance: parallel}\n").camera.distance));
}

TEST_F(CameraKeys, ComeBackAsTheyWereWritten) {
  for (const char* text :
       {"camera: {azimuth: 0.5, elevation: -0.25, distance: parallel, fit: [-1, -0.5, 2, 1.5]}\n",
        "camera: {distance: 2.5}\nlinks: plain\nmesh_up: file\n", ""}) {
    const Scene scene = read(text);
    const std::string written = scene_text(scene);
    const Scene again = read_scene(folder_.write("again.yaml", written), {});
    EXPECT_EQ(scene_text(again), written);
    EXPECT_EQ(again.camera.azimuth, scene.camera.azimuth);
    EXPECT_EQ(again.camera.elevation, scene.camera.elevation);
    EXPECT_EQ(again.camera.distance, scene.camera.distance);
    EXPECT_EQ(again.camera.fit, scene.camera.fit);
    EXPECT_EQ(again.links, scene.links);
    EXPECT_EQ(again.mesh_up, scene.mesh_up);
  }
}

TEST_F(CameraKeys, OfPanelsComeBackAsTheyWereWritten) {
  const Scene scene =
      read("compare: [{links: plain}, {links: visual, mesh_up: file}]\ncamera: {azimuth: 0.5}\n");
  const Scene again = read_scene(folder_.write("again.yaml", scene_text(scene)), {});
  ASSERT_EQ(again.compare.size(), 2u);
  EXPECT_EQ(again.compare[0].links, LinkShapes::plain);
  EXPECT_EQ(again.compare[1].links, LinkShapes::visual);
  EXPECT_EQ(again.compare[0].mesh_up, MeshUp::rviz);
  EXPECT_EQ(again.compare[1].mesh_up, MeshUp::file);
  EXPECT_EQ(again.camera.azimuth, 0.5);
  EXPECT_THAT(error("compare: [{camera: {azimuth: 0}}, {}]\n"),
              HasSubstr("'camera' belongs to the whole picture"));
}

TEST_F(CameraKeys, ThatMakeNoSenseAreErrorsWithTheirPlaces) {
  EXPECT_THAT(error("camera: left\n"), HasSubstr("one.yaml:2:9: 'camera' must hold azimuth"));
  EXPECT_THAT(error("camera: {azimuth: 40}\n"), HasSubstr("without deg is in radians"));
  EXPECT_THAT(error("camera: {elevation: 100deg}\n"), HasSubstr("between -90deg and 90deg"));
  EXPECT_THAT(error("camera: {distance: 0}\n"), HasSubstr("one.yaml:2:20: 'camera.distance' must be above 0"));
  EXPECT_THAT(error("camera: {distance: -2}\n"), HasSubstr(", or parallel"));
  EXPECT_THAT(error("camera: {fit: all}\n"), HasSubstr("fit: [left, bottom, right, top]"));
  EXPECT_THAT(error("camera: {fit: [0, 0, 1]}\n"), HasSubstr("fit: [left, bottom, right, top]"));
  EXPECT_THAT(error("camera: {fit: [1, 0, 0, 1]}\n"), HasSubstr("must grow from left to right"));
  EXPECT_THAT(error("camera: {azimut: 1}\n"), HasSubstr("did you mean 'azimuth'?"));
  EXPECT_THAT(error("links: meshes\n"),
              HasSubstr("one.yaml:2:8: 'links' must be auto, plain, visual or collision, not 'meshes'"));
  EXPECT_THAT(error("mesh_up: z\n"), HasSubstr("'mesh_up' must be rviz or file, not 'z'"));
}

}  // namespace
}  // namespace chainreel
