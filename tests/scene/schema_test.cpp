// The JSON Schema of scenes: what the program takes it takes, and the commonest mistakes it refuses.
#include "scene/keys/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "core/format.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/write_scene.hpp"

namespace chainreel {
namespace {

// A scalar as an editor sees it.
Json json_of(const YAML::Node& node) {
  if (node.IsSequence()) {
    Json list = Json::array();
    for (const YAML::Node& child : node) list.push_back(json_of(child));
    return list;
  }
  if (node.IsMap()) {
    Json map = Json::object();
    for (const auto& pair : node) map[pair.first.Scalar()] = json_of(pair.second);
    return map;
  }
  if (!node.IsScalar()) return nullptr;
  const std::string text = node.Scalar();
  if (node.Tag() == "!") return text;  // quoted
  if (text == "true" || text == "false") return text == "true";
  const auto number = parse_number(text);
  if (!number) return text;
  return *number == double(long(*number)) ? Json(long(*number)) : Json(*number);
}

// As much of JSON Schema as the program's own uses; any other word is a fault of the schema.
class Validator {
 public:
  std::string problem_of(const Json& value, const Json& schema, const std::string& at = "") {
    for (const auto& [word, rule] : schema.items()) {
      const std::string problem = check(word, rule, value, schema, at);
      if (!problem.empty()) return problem;
    }
    return "";
  }

 private:
  static bool has_type(const Json& value, const std::string& type) {
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "null") return value.is_null();
    return type == "array" ? value.is_array() : value.is_object();
  }

  std::string check(const std::string& word, const Json& rule, const Json& value, const Json& schema,
                    const std::string& at) {
    const auto unless = [&](bool good) { return good ? "" : at + ": " + word + " " + rule.dump().substr(0, 60); };
    if (word == "type") {
      if (rule.is_string()) return unless(has_type(value, rule));
      for (const Json& type : rule)
        if (has_type(value, type)) return "";
      return unless(false);
    }
    if (word == "enum") return unless(std::find(rule.begin(), rule.end(), value) != rule.end());
    if (word == "minimum") return unless(!value.is_number() || value >= rule);
    if (word == "maximum") return unless(!value.is_number() || value <= rule);
    if (word == "exclusiveMinimum") return unless(!value.is_number() || value > rule);
    if (word == "anyOf") {
      for (const Json& one : rule)
        if (problem_of(value, one, at).empty()) return "";
      return unless(false);
    }
    if (word == "items") {
      for (const Json& item : value.is_array() ? value : Json::array())
        if (const std::string problem = problem_of(item, rule, at + "[]"); !problem.empty()) return problem;
      return "";
    }
    if (word == "required") {
      for (const Json& key : rule)
        if (!value.contains(key.get<std::string>())) return unless(false);
      return "";
    }
    if (word == "additionalProperties") return check_properties(rule, value, schema, at);
    const std::vector<std::string> told{"properties", "patternProperties", "description", "examples", "$schema", "title"};
    return std::find(told.begin(), told.end(), word) != told.end() ? "" : "the schema has an unknown word " + word;
  }

  // `properties` and `patternProperties` never stand without this one.
  std::string check_properties(const Json& others, const Json& value, const Json& schema, const std::string& at) {
    if (!value.is_object()) return "";
    for (const auto& [key, item] : value.items()) {
      const std::string where = at + "." + key;
      Json rule = others;
      if (schema.contains("patternProperties"))
        for (const auto& [pattern, its] : schema["patternProperties"].items())
          if (std::regex_search(key, std::regex(pattern))) rule = its;
      if (schema.contains("properties") && schema["properties"].contains(key)) rule = schema["properties"][key];
      if (rule == false) return where + ": no such key";
      if (const std::string problem = problem_of(item, rule, where); !problem.empty()) return problem;
    }
    return "";
  }
};

std::string problem_of(const std::string& yaml) {
  static const Json schema = scene_schema();
  return Validator().problem_of(json_of(YAML::Load(yaml)), schema);
}

TEST(Schema, TakesEverySceneAsItIsAndAsItIsWritten) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator("assets/scenes")) {
    const std::string path = entry.path().string();
    EXPECT_EQ(Validator().problem_of(json_of(YAML::LoadFile(path)), scene_schema()), "") << path;
    EXPECT_EQ(problem_of(scene_text(read_scene(path))), "") << path;
    ++scenes;
  }
  EXPECT_GE(scenes, 15);
}

TEST(Schema, HoldsEveryKeyWithItsRangeAndMeaning) {
  const Json properties = scene_schema()["properties"];
  for (const SceneKey& key : scene_keys()) {
    Json holder = properties;
    if (!key.section().empty()) holder = properties[key.section()]["properties"];
    ASSERT_TRUE(holder.contains(key.leaf())) << key.name;
    const Json& row = holder[key.leaf()];
    EXPECT_THAT(row["description"].get<std::string>(), testing::HasSubstr(key.help));
    for (const Name& word : key.words)
      EXPECT_NE(std::find(row["enum"].begin(), row["enum"].end(), word.name), row["enum"].end()) << key.name;
    if (std::isfinite(key.range.most)) EXPECT_EQ(row["maximum"], key.range.most) << key.name;
  }
}

TEST(Schema, RefusesWhatTheReaderRefuses) {
  const std::string model = "model: a.urdf\n";
  EXPECT_EQ(problem_of(model), "");
  for (const char* wrong :
       {"colour: blue", "theme: drak", "step: 0", "duration: -1", "draw: [+torques]", "video: {wdth: 5}",
        "video: {width: 8}", "video: {width: 12.5}", "camera: {distance: -1}", "friction: maybe", "start: [0]",
        "constraints: [{lin: {}}]", "constraints: [{point: {frame: g}}]", "events: [{kind: stop}]",
        "events: [{when: q1, kind: mrk}]", "slow_motion: [{from: 1, until: 2, speed: 0}]",
        "compare: [{video: {width: 640}}]", "compare: [{metod: rk4}]", "torque: {pdd: 1}", "plot: [{title: x}]", "plot: {value: q1, scale: cubic}",
        "contact_force: {constraint: 0, force: [1, 2]}", "text_scale: 4", "hold: {last: 4000}"})
    EXPECT_NE(problem_of(model + wrong), "") << wrong;
  EXPECT_NE(problem_of("title: no model"), "");
}

TEST(Schema, TakesConstantExpressionsAndDottedKeysOfPanels) {
  for (const char* good :
       {"start: {q: [90deg, pi/2]}", "step: 1e-3", "camera: {azimuth: 35deg, distance: parallel, fit: motion}",
        "compare: [{torque.2: 5}, {parameters.k: 3, title: b}, {}]", "torque: [1, {pd: {kp: 1, kd: [2, 3], q: sin(t)}}]",
        "plot: energy", "plot: [q, {value: y_G, title: h}]", "plot: {value: 1 + q1^2, scale: log}", "video: {fps: 30000/1001}", "draw: [-trail, +ellipse]",
        "title: 3", "accuracy: 1e-3 m", "slow_motion: [{from: 1s, until: 1.5s, speed: 0.25}]"})
    EXPECT_EQ(problem_of(std::string("model: a.urdf\n") + good), "") << good;
}

}  // namespace
}  // namespace chainreel
