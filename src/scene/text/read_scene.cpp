#include "scene/text/read_scene.hpp"

#include <algorithm>
#include <filesystem>

#include "core/json.hpp"
#include "scene/keys/keys.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/text/read_compare.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

// "azimuth, elevation, distance, fit: camera: {azimuth: 35deg}"
std::string contents_of(const SceneKey& section) {
  std::vector<std::string> leaves;
  for (const SceneKey& key : scene_keys())
    if (key.section() == section.name) leaves.push_back(key.leaf());
  return joined(leaves) + ": " + section.example;
}

// Row by row; those below a section follow it.
void read_keys(Fields& fields, Scene& scene) {
  std::optional<Fields> section;
  const auto leave_section = [&] {
    if (section) section->finish();
    section.reset();
  };
  for (const SceneKey& key : scene_keys()) {
    if (key.section().empty()) leave_section();
    if (key.is_section && key.read && fields.find(key.name).IsScalar())
      key.read(key, fields, scene);
    else if (key.is_section)
      section = fields.section(key.name, contents_of(key));
    else if (key.section().empty())
      key.read(key, fields, scene);
    else if (section)
      key.read(key, *section, scene);
  }
  leave_section();
}

// Numbers as people wrote them, with the units that they have.
std::vector<std::string> numbers_of_start(const YamlDocument& document, const char* key) {
  std::vector<std::string> texts;
  const YAML::Node start = document.root["start"];
  if (!start || !start.IsMap()) return texts;
  const YAML::Node list = start[key];
  if (list && list.IsMap())  // single entries by their indices
    for (const auto& pair : list) {
      const std::optional<double> at = parse_number(pair.first.Scalar());
      if (!at) continue;  // a joint's, see JointNumbers
      texts.resize(std::max(texts.size(), std::size_t(*at)));
      if (pair.second.IsScalar()) texts[std::size_t(*at) - 1] = pair.second.Scalar();
    }
  if (list && list.IsSequence())
    for (const YAML::Node& one : list) texts.push_back(one.IsScalar() ? one.Scalar() : "");
  return texts;
}

// A scene of one panel.
Scene read_document(const YamlDocument& document) {
  Scene scene;
  scene.file = document.file;
  scene.name = std::filesystem::path(document.file).stem().string();
  if (document.is_panel) scene.draw = default_layers_of_panels();
  ProblemList problems;
  Fields fields(document, document.root, "", problems);
  read_keys(fields, scene);
  check_together(fields, scene);
  fields.finish();
  problems.throw_if_any();
  scene.start.written_q = numbers_of_start(document, "q");
  scene.start.written_qd = numbers_of_start(document, "qd");
  scene.places = document.places();
  scene.absolute_paths = absolute_paths_of(document);
  scene.not_beside = notes_of_shipped(document);
  scene.notices.insert(scene.notices.end(), scene.not_beside.begin(), scene.not_beside.end());
  return scene;
}

Scene read_either(const YamlDocument& document) {
  return is_comparison(document) ? read_comparison(document, &read_document) : read_document(document);
}

// Whether a value of a key that holds words is what YAML would take for something else: a colon and a blank, a bracket, a comment.
// Words in quotes are YAML's, as is null, which takes the key away.
bool is_text_as_it_stands(const Override& one) {
  std::string key = one.key;
  if (key.starts_with("compare."))
    if (const std::size_t dot = key.find('.', std::string("compare.").size()); dot != std::string::npos) key = key.substr(dot + 1);
  const SceneKey* row = find_key(key);
  if (row == nullptr || row->name != key || row->form != KeyForm::text) return false;
  const std::size_t begin = one.value.find_first_not_of(' ');
  if (begin == std::string::npos) return false;
  try {
    const YAML::Node node = YAML::Load(one.value);
    if (one.value[begin] == '"' || one.value[begin] == '\'') return !node.IsScalar();
    const std::string words = one.value.substr(begin, one.value.find_last_not_of(' ') + 1 - begin);
    return words != "null" && words != "~" && !(node.IsScalar() && node.Scalar() == words);
  } catch (const YAML::Exception&) {
    return true;
  }
}

std::vector<Override> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<Override> parsed;
  for (const std::string& text : texts) {
    Override one = parse_override(text);
    if (is_text_as_it_stands(one)) one.value = quoted_text(one.value);
    parsed.push_back(std::move(one));
  }
  return parsed;
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides, MethodsOf methods) {
  YamlDocument document = load_yaml(path, parse_overrides(overrides));
  document.is_for_methods = methods == MethodsOf::command;
  Scene scene = read_either(document);
  scene.set = overrides;
  return scene;
}

Scene read_scene_text(const std::string& text, const std::string& file, const std::vector<std::string>& overrides) {
  return read_either(yaml_document_of(text, file, parse_overrides(overrides)));
}

SceneFile::SceneFile(const std::string& path) : path_(path) {}

SceneFile::~SceneFile() = default;

Scene SceneFile::read(const std::vector<std::string>& overrides) {
  constexpr int kMostReads = 1000;  // values that were replaced stay in the document's memory
  const std::vector<Override> wanted = parse_overrides(overrides);
  const auto same_key = [](const Override& a, const Override& b) { return a.key == b.key; };
  const bool takes_away = std::any_of(wanted.begin(), wanted.end(), [](const Override& one) { return one.value.empty(); });
  const bool fits = document_ && ++reads_ < kMostReads && !takes_away &&
                    std::equal(wanted.begin(), wanted.end(), document_->overrides.begin(), document_->overrides.end(),
                               same_key);
  if (fits) {
    replace_overrides(*document_, wanted);
  } else {
    document_ = std::make_unique<YamlDocument>(load_yaml(path_, wanted));
    reads_ = 0;
  }
  return read_either(*document_);
}

Scene read_model_scene(const std::string& model, const std::vector<std::string>& overrides) {
  if (!std::filesystem::is_regular_file(model))
    throw Error(ExitCode::bad_input, "there is no such model file", {model});
  // A JSON text is YAML too.
  const std::string text = "model: " + Json(std::filesystem::path(model).filename().string()).dump();
  return read_either(yaml_document_of(text, model, parse_overrides(overrides)));
}

}  // namespace chainreel
