#include "scene/keys/schema.hpp"

#include <cmath>

#include "core/format.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {
namespace {

// Numbers may also be written as constant expressions, which stand in a file as text; any scalar is a text.
const Json kNumberOrText = Json::array({"number", "string"});
const Json kAnyScalar = Json::array({"string", "number", "boolean"});

Json schema_of(const KeyText& text);

Json record_of(const std::vector<KeyText>& parts) {
  Json json{{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
  for (const KeyText& part : parts) {
    json["properties"][part.name] = schema_of(part);
    if (part.is_required) json["required"].push_back(part.name);
  }
  return json;
}

Json form_of(const KeyText& text) {
  switch (text.form) {
    case KeyForm::number:
      return {{"type", kNumberOrText}};
    case KeyForm::whole:
      return {{"type", "integer"}};
    case KeyForm::truth:
      return {{"type", "boolean"}};
    case KeyForm::text:
    case KeyForm::path:
      return {{"type", kAnyScalar}};
    case KeyForm::word:
      return {{"enum", words_of(text.words)}};
    case KeyForm::rate:
    case KeyForm::accuracy:
    case KeyForm::expression:
      return {{"type", kNumberOrText}};
    case KeyForm::list:
      return {{"type", "array"}, {"items", schema_of(text.parts[0])}};
    case KeyForm::mapping:
      return {{"type", "object"}, {"additionalProperties", schema_of(text.parts[0])}};
    case KeyForm::record:
      return record_of(text.parts);
    case KeyForm::either:
      break;
  }
  Json json;
  for (const KeyText& part : text.parts) json["anyOf"].push_back(schema_of(part));
  return json;
}

// "of time, s, above 0 s; parallel: without end".
std::string description_of(const KeyText& text) {
  std::string words = text.help;
  const std::string range = range_text(text.range, text.unit);
  if (!text.unit.empty() && !range.ends_with(text.unit)) words += (words.empty() ? "" : ", ") + text.unit;
  if (!range.empty()) words += (words.empty() ? "" : ", ") + range;
  return words;
}

Json schema_of(const KeyText& text) {
  Json json = form_of(text);
  if (std::isfinite(text.range.least)) json[text.range.is_open ? "exclusiveMinimum" : "minimum"] = text.range.least;
  if (std::isfinite(text.range.most)) json["maximum"] = text.range.most;
  if (const std::string words = description_of(text); !words.empty()) json["description"] = words;
  return json;
}

Json schema_of_key(const SceneKey& key) {
  Json json = schema_of(key);
  std::string& words = json["description"].get_ref<std::string&>();
  const std::string held = key.absent.empty() ? key.text(key, Scene{}) : key.absent;
  if (!held.empty() && !key.is_required) words += "; where it is left out: " + held;
  if (!key.infinity.empty()) words += "; or " + key.infinity;
  if (key.takes_null) {
    if (json.contains("enum")) json["enum"].push_back(nullptr);
    if (json.contains("type")) {
      if (!json["type"].is_array()) json["type"] = Json::array({json["type"]});
      json["type"].push_back("null");
    }
  }
  if (key.is_section && key.read) json["type"] = {json["type"], "number", "string"};
  if (!key.example.empty()) json["examples"].push_back(key.example);
  return json;
}

// What stands at one level: keys, and sections with their keys. `takes` chooses among them.
template <class Takes>
Json properties_of(Takes takes) {
  Json properties = Json::object();
  for (const SceneKey& key : scene_keys()) {
    if (!takes(key)) continue;
    if (key.section().empty())
      properties[key.name] = schema_of_key(key);
    else
      properties[key.section()]["properties"][key.leaf()] = schema_of_key(key);
  }
  return properties;
}

// A panel changes keys by their names, or what lies deeper by its dotted path.
Json schema_of_panel() {
  const auto is_of_panel = [](const SceneKey& key) { return key.of == KeyOf::panel || key.name == "title"; };
  std::string names;
  for (const SceneKey& key : scene_keys())
    if (is_of_panel(key) && key.section().empty()) names += (names.empty() ? "" : "|") + key.name;
  return {{"type", "object"},
          {"properties", properties_of(is_of_panel)},
          {"patternProperties", {{"^(" + names + ")\\.", Json::object()}}},
          {"additionalProperties", false}};
}

}  // namespace

Json scene_schema() {
  Json json{{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "A scene of chainreel"},
            {"type", "object"},
            {"properties", properties_of([](const SceneKey&) { return true; })},
            {"required", Json::array({"model"})},
            {"additionalProperties", false}};
  Json& compare = json["properties"]["compare"];
  const Json description = compare["items"]["description"];
  compare["items"] = schema_of_panel();
  compare["items"]["description"] = description;
  return json;
}

}  // namespace chainreel
