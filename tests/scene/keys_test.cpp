// The table of keys: what holds for every row.
#include "scene/keys/keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/format.hpp"
#include "scene/text/write_scene.hpp"
#include "written_scenes.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

class Keys : public WrittenScenes {
 protected:
  // What a key needs to mean something.
  static std::vector<std::string> context_of(const SceneKey& key) {
    if (key.name == "stabilize" || key.section() == "baumgarte")
      return {"constraints=[{point: {frame: gripper, at: [1, 0]}}]", "stabilize=baumgarte"};
    if (key.section() == "foot") return {"foot.heel=-1", "foot.toe=1"};
    if (key.name == "order") return {"method=taylor"};
    if (key.name == "tolerance" || key.name == "step") return {"method=dop853"};
    return {};
  }

  std::vector<std::string> with(const SceneKey& key, const std::string& value) {
    std::vector<std::string> set = context_of(key);
    set.push_back(key.name + "=" + value);
    return set;
  }
};

TEST_F(Keys, StandOnceEachWithAMeaning) {
  std::set<std::string> names;
  for (const SceneKey& key : scene_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_FALSE(key.help.empty()) << key.name;
    EXPECT_FALSE(key.chapter.empty()) << key.name;
    if (key.section().empty()) continue;
    ASSERT_NE(find_key(key.section()), nullptr) << key.name;
    EXPECT_TRUE(find_key(key.section())->is_section) << key.name;
    EXPECT_EQ(find_key(key.section())->of, key.of) << key.name;
  }
}

TEST_F(Keys, OfWordsTakeEachOfThemAndWriteItBack) {
  for (const SceneKey& key : scene_keys()) {
    if (key.form != KeyForm::word || key.name == "layout") continue;
    for (const Name& word : key.words) {
      const std::string text = key.text(key, read("", with(key, word.name)));
      EXPECT_EQ(text, word.name) << key.name;
    }
    EXPECT_THAT(error("", with(key, "wrng")), HasSubstr("'" + key.name + "' must be " + alternatives(key.words)));
  }
}

TEST_F(Keys, TakeNumbersUpToTheEndsOfTheirRangesAndNoFurther) {
  int ends = 0;
  for (const SceneKey& key : scene_keys()) {
    if (key.form != KeyForm::number && key.form != KeyForm::whole) continue;
    for (const double end : {key.range.least, key.range.most}) {
      if (!std::isfinite(end)) continue;
      ++ends;
      const double away = end == key.range.least ? -1 : 1;
      const double beyond = key.form == KeyForm::whole ? end + away : end + away * std::max(std::abs(end), 1.0) * 1e-3;
      const std::string refusal = error("", with(key, format_shortest(beyond)));
      EXPECT_THAT(refusal, HasSubstr("'" + key.name + "' must")) << beyond;
      EXPECT_THAT(refusal, HasSubstr(range_text(key.range, key.unit)));
      EXPECT_EQ(error("", with(key, format_shortest(end))).find("'" + key.name + "' must") == std::string::npos,
                !(key.range.is_open && end == key.range.least))
          << key.name << " = " << end;
    }
    EXPECT_THAT(error("", with(key, "[1]")), HasSubstr("'" + key.name + "' must be a number"));
    EXPECT_THAT(error("", with(key, ".nan")), HasSubstr("'" + key.name + "'"));
  }
  EXPECT_GE(ends, 15);
}

// What a file leaves out is what the struct holds: no default stands anywhere else.
TEST_F(Keys, LeaveTheDefaultsOfTheStructWhereTheyAreAbsent) {
  const Scene read_scene = read(""), defaults;
  for (const SceneKey& key : scene_keys())
    if (key.name != "model" && key.name != "title")
      EXPECT_EQ(key.text(key, read_scene), key.text(key, defaults)) << key.name;
}

TEST_F(Keys, AreCalledOfThePageOrOfAPanelInOnePlace) {
  for (const SceneKey& key : scene_keys()) {
    if (!key.section().empty() || key.name == "title" || key.name == "compare") continue;
    const std::string refusal = error("compare: [{" + key.name + ": {}}, {}]\n");
    if (key.of == KeyOf::page)
      EXPECT_THAT(refusal, HasSubstr("'" + key.name + "' belongs to the whole picture"));
    else
      EXPECT_THAT(refusal, testing::Not(HasSubstr("belongs to the whole picture"))) << key.name;
  }
}

TEST_F(Keys, WithNullAreAbsentWhereTheyCanBe) {
  for (const char* key : {"step", "tolerance", "order", "massless", "gravity", "video.crf", "camera.azimuth"})
    EXPECT_EQ(find_key(key)->text(*find_key(key), read("", {std::string(key) + "=null"})), "") << key;
  EXPECT_THAT(error("duration:\n"), HasSubstr("'duration' must be a number"));
}

TEST_F(Keys, WhoseValueIsAPathAreKnownByName) {
  EXPECT_THAT(path_keys(), testing::UnorderedElementsAre("model", "csv", "inverse_of", "trajectory", "motion", "style", "file"));
}

TEST_F(Keys, OfModelsAreThoseOfTheMechanismAndOfItsPicture) {
  EXPECT_THAT(keys_of_models(OfModel::mechanism),
              testing::ElementsAre("gravity", "base", "friction", "massless", "payload.mass", "payload.link", "payload.at", "packages"));
  EXPECT_THAT(keys_of_models(OfModel::picture),
              testing::ElementsAre("gravity", "base", "friction", "massless", "payload.mass", "payload.link", "payload.at", "packages", "end_effector", "links",
                                   "mesh_up", "camera", "theme", "text_scale", "style", "video.width", "video.height"));
}

TEST_F(Keys, OfADurationBelowHalfAFrameHaveARemedyThatIsTaken) {
  const std::string table = "method: dop853\n";
  EXPECT_THAT(error(table, {"duration=1e-5"}), HasSubstr("take video.fps=100000 for one"));
  EXPECT_EQ(error(table, {"duration=1e-5", "video.fps=100000"}), "");
  for (const char* shorter : {"duration=1e-7", "duration=1e-320"}) EXPECT_THAT(error(table, {shorter}), HasSubstr("take a longer one"));
}

}  // namespace
}  // namespace chainreel
