// What changed in a model, in words.
#include "model/model_difference.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numbers>

#include "core/error.hpp"
#include "model_file.hpp"
#include "support/public_robots.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string replaced(std::string text, const std::string& from, const std::string& to, bool all = false) {
  std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  for (; at != std::string::npos; at = all ? text.find(from, at + to.size()) : std::string::npos)
    text.replace(at, from.size(), to);
  return text;
}

std::vector<std::string> words_of(const ModelDescription& before, const ModelDescription& after) {
  // What a record holds says it as well.
  const ModelDescription kept = model_description_of(parse_json(to_json(before).dump()));
  std::vector<std::string> words;
  for (const ModelDifference& one : differences(kept, after)) words.push_back(one.words);
  return words;
}

ModelDescription described(const std::string& text, const ModelOptions& options = {}) {
  const TemporaryFolder folder;
  return describe_model(folder.write("model.urdf", text), options);
}

std::vector<std::string> between(const std::string& before, const std::string& after) {
  return words_of(described(before), described(after));
}

const std::string& arm() {
  static const std::string text = text_of(CHAINREEL_SOURCE "/models/arm.urdf");
  return text;
}

std::vector<std::string> after(const std::string& from, const std::string& to, bool all = false) {
  return between(arm(), replaced(arm(), from, to, all));
}

TEST(ModelDifference, TellsMassesAndInertias) {
  EXPECT_THAT(after("<mass value=\"3\"/>", "<mass value=\"3.03\"/>"),
              ElementsAre("link forearm: mass 3 -> 3.03 kg, URDF line 30"));
  EXPECT_THAT(after("<mass value=\"3\"/>", "\n<mass value=\"3.03\"/>"), ElementsAre("link forearm: mass 3 -> 3.03 kg, URDF line 31"))
      << "the mass's own line, where it is not that of <inertial>";
  EXPECT_THAT(
      after("<origin xyz=\"0 0 0.17\"/><mass", "<origin xyz=\"0 0.003 0.174\"/><mass"),
      ElementsAre(
          "link forearm: centre of mass moved by 5 mm (y 0 -> 0.003 m, z 0.17 -> 0.174 m), URDF line 30"));
  EXPECT_THAT(after("izz=\"0.0024\"", "izz=\"0.0025\""),
              ElementsAre("inertia of link forearm: Izz 0.0024 -> 0.0025 kg m^2, URDF line 30"));
  EXPECT_THAT(
      after("<origin xyz=\"0 0 0.17\"/><mass", "<origin xyz=\"0 0 0.17\" rpy=\"0.001 0 0\"/><mass"),
      ElementsAre(
          "inertia of link forearm: its axes turned by 0.0573 deg (rpy 0 0 0 -> 0.001 0 0), URDF line 30"));
  // In the last digit that a double has.
  EXPECT_THAT(after("<mass value=\"3\"/>", "<mass value=\"3.0000000000000004\"/>"),
              ElementsAre("link forearm: mass 3 -> 3.0000000000000004 kg, URDF line 30"));
}

TEST(ModelDifference, TellsJoints) {
  EXPECT_THAT(after("<origin xyz=\"0 0 0.45\"/>\n    <axis", "<origin xyz=\"0 0 0.454\"/>\n    <axis"),
              ElementsAre("joint joint3: origin moved by 4 mm (z 0.45 -> 0.454 m), URDF line 58"));
  EXPECT_THAT(after("<origin xyz=\"0 0 0.45\"/>\n    <axis",
                    "<origin xyz=\"0 0 0.45\" rpy=\"0 0 1e-3\"/>\n    <axis"),
              ElementsAre(StartsWith("joint joint3: origin turned by 0.0573 deg (rpy 0 0 0 -> 0 0 0.001)")));
  EXPECT_THAT(
      after("<axis xyz=\"0 1 0\"/><limit lower=\"-2.6\"", "<axis xyz=\"0.001 1 0\"/><limit lower=\"-2.6\""),
      ElementsAre(
          AllOf(StartsWith("joint joint3: axis turned by 0.0573 deg"), HasSubstr("0 1 0 -> 0.001 1 0"))));
  EXPECT_THAT(
      after("<axis xyz=\"0 1 0\"/><limit lower=\"-2.6\"", "<axis xyz=\"0 -1 0\"/><limit lower=\"-2.6\""),
      ElementsAre(StartsWith("joint joint3: axis turned round")));
  EXPECT_THAT(after("lower=\"-2.6\" upper=\"2.6\" effort=\"150\" velocity=\"4\"",
                    "lower=\"-2.5\" upper=\"2.7\" effort=\"151\" velocity=\"5\""),
              ElementsAre("joint joint3: lower limit -2.6 -> -2.5 rad, URDF line 59",
                          "joint joint3: upper limit 2.6 -> 2.7 rad, URDF line 59",
                          "joint joint3: limit of effort 150 -> 151 N m, URDF line 59",
                          "joint joint3: limit of velocity 4 -> 5 rad/s, URDF line 59"));
  EXPECT_THAT(
      after("velocity=\"6\"/></joint>\n  <joint name=\"joint5\"",
            "velocity=\"6\"/><dynamics damping=\"0.1\" friction=\"0.2\"/></joint>\n  <joint name=\"joint5\""),
      ElementsAre(StartsWith("joint joint4: damping 0 -> 0.1 N m s/rad"),
                  StartsWith("joint joint4: friction 0 -> 0.2 N m")));
  EXPECT_THAT(
      after("<joint name=\"joint4\" type=\"revolute\">", "<joint name=\"joint4\" type=\"continuous\">"),
      ElementsAre(StartsWith("joint joint4: type revolute -> continuous"),
                  HasSubstr("lower limit -3.1 rad -> none"), HasSubstr("upper limit")));
  EXPECT_THAT(after("<axis xyz=\"0 1 0\"/><limit lower=\"-2.6\"",
                    "<axis xyz=\"0 1 0\"/><mimic joint=\"joint2\" multiplier=\"2\"/><limit lower=\"-2.6\""),
              Contains(StartsWith("joint joint3: follows joint joint2 now (mimic)")));
}

TEST(ModelDifference, TellsMimics) {
  const std::string text =
      robot_text(link_text("base") + moving("a", "continuous", "base") +
                 moving("b", "continuous", "a", "0 0 1", "<mimic joint='to_a' multiplier='1' offset='0'/>"));
  EXPECT_THAT(between(text, replaced(text, "multiplier='1'", "multiplier='-1'")),
              ElementsAre(HasSubstr("joint to_b: mimic multiplier 1 -> -1")));
  EXPECT_THAT(between(text, replaced(text, "offset='0'", "offset='0.1'")),
              ElementsAre(HasSubstr("joint to_b: mimic offset 0 -> 0.1")));
  // What it follows under another name is the same.
  EXPECT_THAT(between(text, replaced(text, "'to_a'", "'shoulder'", true)),
              ElementsAre(StartsWith("joint to_a: renamed to shoulder")));
}

TEST(ModelDifference, TellsLinksAndJointsThatCameWentOrHaveAnotherName) {
  EXPECT_THAT(after("\"forearm\"", "\"lower_arm\"", true),
              ElementsAre("link forearm: renamed to lower_arm, URDF line 29"));
  EXPECT_THAT(after("\"joint3\"", "\"elbow\"", true),
              ElementsAre("joint joint3: renamed to elbow, URDF line 58"));
  EXPECT_THAT(after("\"base\"", "\"ground\"", true), ElementsAre(StartsWith("link base: renamed to ground")));
  // Both at once, in two places, and what is there told by the new name.
  std::string text =
      replaced(replaced(arm(), "\"forearm\"", "\"lower_arm\"", true), "\"joint3\"", "\"elbow\"", true);
  EXPECT_THAT(between(arm(), text), ElementsAre(HasSubstr("link forearm: renamed to lower_arm"),
                                                HasSubstr("joint joint3: renamed to elbow")));
  text = replaced(replaced(arm(), "\"forearm\"", "\"lower_arm\"", true), "<mass value=\"3\"/>",
                  "<mass value=\"4\"/>");
  EXPECT_THAT(between(arm(), text),
              ElementsAre(HasSubstr("link forearm: renamed"), StartsWith("link lower_arm: mass 3 -> 4 kg")));
  // A camera on the wrist.
  text = replaced(arm(), "</robot>",
                  "<link name='camera'/><joint name='mount' type='fixed'><parent link='wrist1'/><child "
                  "link='camera'/></joint></robot>");
  EXPECT_THAT(between(arm(), text),
              ElementsAre("link camera: added, URDF line 67", "joint mount: added, URDF line 67"));
  EXPECT_THAT(between(text, arm()), ElementsAre("link camera: gone", "joint mount: gone"));
  EXPECT_THAT(between(text, replaced(text, "<parent link='wrist1'/>", "<parent link='wrist2'/>")),
              ElementsAre("joint mount: its parent link wrist1 -> wrist2, URDF line 67"));
  // All names are other ones: the file of another arm is told as a whole, not as twelve renamings.
  const std::string rrr = text_of(CHAINREEL_SOURCE "/models/rrr.urdf"),
                    rr = text_of(CHAINREEL_SOURCE "/models/rr.urdf");
  EXPECT_THAT(between(rr, rrr), Contains(StartsWith("joint joint3: added")));
}

TEST(ModelDifference, TellsTheOrderOfCoordinates) {
  const std::string base = link_text("base"), a = moving("a", "continuous", "base"),
                    b = moving("b", "continuous", "base");
  EXPECT_THAT(between(robot_text(base + a + b), robot_text(base + b + a)),
              ElementsAre("order of coordinates to_a, to_b -> to_b, to_a"));
}

TEST(ModelDifference, TellsShapesAndColours) {
  EXPECT_THAT(after("<color rgba=\"0.000 0.620 0.451 1\"/>", "<color rgba=\"0.016 0.620 0.451 1\"/>"),
              ElementsAre("link wrist2: visual 1 (cylinder) colour 0 158 115 255 -> 4 158 115 255 of 255 "
                          "(material green), URDF line 42"));
  EXPECT_THAT(after("<material name=\"green\"/>", "<material name=\"sky\"/>"),
              ElementsAre(HasSubstr("(material green -> material sky)")));
  EXPECT_THAT(
      after("radius=\"0.040\" length=\"0.32\"", "radius=\"0.041\" length=\"0.33\""),
      ElementsAre(
          "link forearm: visual 1 (cylinder) radius 0.04 -> 0.041 m, length 0.32 -> 0.33 m, URDF line 32"));
  EXPECT_THAT(
      after("<box size=\"0.11 0.035 0.02\"/>", "<box size=\"0.12 0.035 0.02\"/>"),
      ElementsAre("link hand: visual 2 (box) size 0.11 0.035 0.02 -> 0.12 0.035 0.02 m, URDF line 48"));
  EXPECT_THAT(after("<box size=\"0.11 0.035 0.02\"/>", "<sphere radius=\"0.1\"/>"),
              ElementsAre(HasSubstr("visual 2 (sphere) was a box")));
  EXPECT_THAT(after("<origin xyz=\"0.042 0 0.125\"/>", "<origin xyz=\"0.043 0 0.125\"/>"),
              ElementsAre("link hand: visual 3 (box) moved by 1 mm (x 0.042 -> 0.043 m), URDF line 49"));
  const std::string finger =
      "    <visual><origin xyz=\"0.042 0 0.125\"/><geometry><box size=\"0.014 0.03 "
      "0.05\"/></geometry><material name=\"grey\"/></visual>\n";
  EXPECT_THAT(after(finger, ""), ElementsAre("link hand: visual 3 (box) gone"));
  EXPECT_THAT(between(replaced(arm(), finger, ""), arm()),
              ElementsAre("link hand: visual 3 (box) added, URDF line 49"));
  const std::string thumb = replaced(finger, "0.042", "-0.042");
  EXPECT_THAT(after(finger + thumb, thumb + finger),
              ElementsAre(HasSubstr("link hand: its visuals stand in another order")));
}

TEST(ModelDifference, CallsWhatMeansTheSameNoDifference) {
  EXPECT_THAT(after("<robot name=\"arm\">", "<robot name=\"arm\">\n\n<!-- lines -->\n"), IsEmpty());
  EXPECT_THAT(after("\n", "\r\n", true), IsEmpty());
  EXPECT_THAT(after("<mass value=\"3\"/>", "<mass value=\" 3.000e0 \"/>"), IsEmpty());
  EXPECT_THAT(after("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 2 0\"/>"), IsEmpty());
  EXPECT_THAT(after("\"green\"", "\"leaf\"", true), IsEmpty());
  EXPECT_THAT(after("<joint name=\"tool\" type=\"fixed\">",
                    "<joint name=\"tool\" type=\"fixed\"><axis xyz=\"0 1 0\"/>"),
              IsEmpty());
  EXPECT_THAT(after("<link name=\"gripper\"/>", "<link name=\"gripper\"></link>"), IsEmpty());
  // Collisions of links that are seen.
  EXPECT_THAT(
      after("<link name=\"forearm\">",
            "<link name=\"forearm\"><collision><geometry><sphere radius=\"1\"/></geometry></collision>"),
      IsEmpty());
}

TEST(ModelDifference, TellsHowTheModelIsRead) {
  const auto read = [](const ModelOptions& options) {
    return words_of(described(arm()), described(arm(), options));
  };
  ModelOptions options;
  options.gravity = Eigen::Vector3d(0, 0, -9.8);
  EXPECT_THAT(read(options), ElementsAre("gravity 0 0 -9.81 -> 0 0 -9.8 m/s^2"));
  options = {};
  options.end_effector = "hand";
  EXPECT_THAT(read(options), ElementsAre("end effector gripper -> hand"));
  options = {};
  options.friction = false;
  EXPECT_THAT(read(options), ElementsAre("damping and friction of joints do not act any more"));
  const std::string free = robot_text(moving("a", "continuous", "base") + link_text("base", inertial_text()));
  options = {};
  options.floating_base = true;
  EXPECT_THAT(words_of(described(free), described(free, options)), Contains("base fixed -> floating"));
}

// A tetrahedron and more, as STL.
std::string solid(int triangles, double height = 1, double shift = 0) {
  std::string text = "solid s\n";
  for (int i = 0; i < triangles; ++i)
    text += "facet normal 0 0 1\nouter loop\nvertex " + std::to_string(i + shift) + " 0 0\nvertex " +
            std::to_string(i + 1 + shift) + " 0 0\nvertex " + std::to_string(i + shift) + " 1 " +
            std::to_string(height) + "\nendloop\nendfacet\n";
  return text + "endsolid s\n";
}

TEST(ModelDifference, TellsMeshesByTheirTriangles) {
  const TemporaryFolder folder;
  const std::string shape = "<visual><geometry><mesh filename='forearm.stl'/></geometry></visual>";
  const std::string path = folder.write(
      "model.urdf", robot_text(link_text("forearm", shape) + link_text("a", inertial_text() + shape) +
                               joint_text("j", "continuous", "forearm", "a")));
  const auto with_mesh = [&](const std::string& text) {
    folder.write("forearm.stl", text);
    return describe_model(path, {});
  };
  const ModelDescription before = with_mesh(solid(50));
  EXPECT_THAT(words_of(before, with_mesh(replaced(solid(50), "\n", "\r\n", true))), IsEmpty());
  EXPECT_THAT(
      words_of(before, with_mesh(replaced(solid(50), "vertex 7.000000 1 1", "vertex 7.000000 1 1.001"))),
      ElementsAre(StartsWith(
          "mesh forearm.stl (links forearm, a): 2 % of its 50 triangles differ")));  // once, of two links
  EXPECT_THAT(words_of(before, with_mesh(solid(49))),
              ElementsAre(StartsWith("mesh forearm.stl (links forearm, a): 1 of its 50 triangles gone")));
  EXPECT_THAT(
      words_of(before, with_mesh(solid(50, 2))),
      ElementsAre(HasSubstr("all of its 50 triangles differ; the box around it 50 x 1 x 1 -> 50 x 1 x 2 m")));
  EXPECT_THAT(words_of(before, with_mesh(solid(50, 1, 0.25))),
              ElementsAre(HasSubstr("the box around it moved by 250 mm")));
  fs::remove(folder.path() / "forearm.stl");
  ModelOptions options;
  options.meshes = false;
  EXPECT_THAT(words_of(before, describe_model(path, options)),
              ElementsAre("mesh forearm.stl (links forearm, a): cannot be read any more, URDF line 2"));
  // In another folder under the same name.
  folder.write("forearm.stl", solid(50));
  folder.write("else/forearm.stl", solid(50));
  const std::string text = text_of(path);
  folder.write("model.urdf", replaced(text, "forearm.stl", "else/forearm.stl"));
  EXPECT_THAT(words_of(before, describe_model(path, {})), IsEmpty());
  folder.write("model.urdf",
               replaced(text, "filename='forearm.stl'", "filename='forearm.stl' scale='1 1 2'"));
  EXPECT_THAT(words_of(before, describe_model(path, {})),
              ElementsAre(StartsWith("link forearm: visual 1 (mesh forearm.stl) scale 1 1 1 -> 1 1 2")));
}

// What a mesh file names itself is no part of its bytes.
TEST(ModelDifference, TellsColoursThatStandBesideAMesh) {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "model.urdf",
      robot_text(link_text("base", "<visual><geometry><mesh filename='a.obj'/></geometry></visual>") +
                 moving("a", "continuous", "base")));
  folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl m\nf 1 2 3\nf 1 3 4\n");
  folder.write("a.mtl", "newmtl m\nKd 0.5 0 0\n");
  const ModelDescription before = describe_model(path, {});
  folder.write("a.mtl", "newmtl m\nKd 0.5 0.1 0\n");
  EXPECT_THAT(words_of(before, describe_model(path, {})),
              ElementsAre("mesh a.obj (link base): the same triangles in other colours, URDF line 2"));
}

TEST(ModelDifference, RefusesSpoiltRecords) {
  const Json good = to_json(described(arm()));
  const std::vector<std::function<void(Json&)>> spoilings{
      [](Json& json) { json.erase("links"); },
      [](Json& json) { json["links"] = 3; },
      [](Json& json) { json["root"] = 99; },
      [](Json& json) { json["root"] = -1; },
      [](Json& json) { json["joints"][0]["child"] = 99; },
      [](Json& json) { json["joints"][0]["type"] = "ball"; },
      [](Json& json) {
        json["joints"][0]["axis"] = {1, 2};
      },
      [](Json& json) { json["links"][1]["visuals"][0]["kind"] = "cone"; },
      [](Json& json) { json["links"][1]["visuals"][0]["kind"] = "mesh"; },
      [](Json& json) { json["gravity"] = "down"; },
      [](Json& json) { json["links"][1]["inertial"]["mass"] = nullptr; },
      [](Json& json) { json = nullptr; }};
  for (std::size_t i = 0; i < spoilings.size(); ++i) {
    Json bad = good;
    spoilings[i](bad);
    EXPECT_THROW(model_description_of(bad), Error) << i;
  }
}

// Renaming is looked for within bounds: a file of thousands of links that all have other names comes to an
// end.
TEST(ModelDifference, ComesToAnEndWithThousandsOfOtherNames) {
  const auto many = [](const std::string& name) {
    std::string text = link_text("base") + moving("arm", "continuous", "base");
    for (int i = 0; i < 3000; ++i)
      text += link_text(name + std::to_string(i)) +
              joint_text(name + "j" + std::to_string(i), "fixed", "base", name + std::to_string(i));
    return robot_text(text);
  };
  EXPECT_THAT(between(many("a"), many("b")).size(), testing::Ge(3000U));
}

TEST(ModelDifference, OfOurOwnModelsToThemselvesIsNone) {
  for (const fs::directory_entry& file : fs::directory_iterator(CHAINREEL_SOURCE "/models")) {
    const ModelDescription model = describe_model(file.path().string(), {});
    EXPECT_THAT(words_of(model, model), IsEmpty()) << file.path();
    EXPECT_EQ(to_json(model).dump(), to_json(model_description_of(to_json(model))).dump()) << file.path();
  }
}

TEST(ModelDifference, PublicRobotsAreToldFromTheirVariants) {
  const std::string folder = public_robots_folder();
  if (folder.empty()) GTEST_SKIP() << kNoRobots;
  ModelOptions options;
  options.packages["example-robot-data"] = fs::absolute(folder).lexically_normal().parent_path().string();
  const std::string path = folder + "/bolt_description/robots/bolt.urdf";
  const ModelDescription bolt = describe_model(path, options);
  EXPECT_THAT(words_of(bolt, describe_model(path, options)), IsEmpty());
  EXPECT_LT(to_json(bolt).dump().size(), 100'000U);
  ASSERT_FALSE(bolt.meshes.empty());
  for (const DescribedMesh& mesh : bolt.meshes) EXPECT_TRUE(mesh.sketch) << mesh.file;
  const TemporaryFolder copy;
  const std::string text = text_of(path);
  const std::size_t at = text.find("<mass"), value = text.find('"', at) + 1;
  std::string heavy = text;
  heavy.insert(value, "1");
  EXPECT_THAT(words_of(bolt, describe_model(copy.write("bolt.urdf", heavy), options)),
              ElementsAre(AllOf(StartsWith("link "), HasSubstr(": mass "))));
  // The same robot in another folder, then without the last triangle of one of its (binary) meshes.
  for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder + "/bolt_description"))
    if (file.is_regular_file())
      copy.write("robots/" + fs::relative(file.path(), folder).string(), text_of(file.path().string()));
  options.packages["example-robot-data"] = copy.path().string();
  const std::string copied = (copy.path() / "robots/bolt_description/robots/bolt.urdf").string();
  EXPECT_EQ(to_json(bolt).dump(), to_json(describe_model(copied, options)).dump());
  const std::string stl = "robots/bolt_description/meshes/stl/bolt_foot.stl";
  std::string foot = text_of((copy.path() / stl).string());
  std::uint32_t triangles = 0;
  std::copy_n(foot.begin() + 80, 4, reinterpret_cast<char*>(&triangles));
  --triangles;
  std::copy_n(reinterpret_cast<const char*>(&triangles), 4, foot.begin() + 80);
  copy.write(stl, foot.substr(0, foot.size() - 50));
  EXPECT_THAT(
      words_of(bolt, describe_model(copied, options)),
      ElementsAre(AllOf(StartsWith("mesh bolt_foot.stl (links FL_FOOT, FR_FOOT)"),
                        HasSubstr(": 1 of its " + std::to_string(triangles + 1) + " triangles gone"))));
}

}  // namespace
}  // namespace chainreel
