#include "app/today/command_inputs.hpp"

#include <algorithm>
#include <filesystem>

#include "app/film/clip_memory.hpp"
#include "app/film/clip_origin.hpp"
#include "app/report/driving_tables.hpp"
#include "app/verify/physics_record.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "model/model_description.hpp"
#include "model/model_source.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/scene_difference.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAnother = "is another one, by its hash";

// Figures draw the skeleton, or shapes whose change is told by the hash alone.
Json mechanism_of(const ModelSource& source) {
  ModelOptions options;
  options.meshes = false;
  ModelDescription described = describe_model(source, options);
  for (DescribedLink& link : described.links) link.visuals.clear(), link.collisions.clear();
  return to_json(described);
}

Json model_input(const ModelSource& source) {
  Json input;  // nothing that throws stands within braces, see input_of
  input["elements_sha256"] = source.elements_sha256();
  input["mechanism"] = mechanism_of(source);
  return input;
}

// What the command changes of its scenes.
std::vector<std::string> overrides_in(const std::vector<std::string>& words) {
  std::vector<std::string> overrides;
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "--set") overrides.push_back(words[i + 1]);
  return overrides;
}

Json scene_input(const std::string& path, const std::vector<std::string>& overrides) {
  Scene scene = read_scene(path, overrides, MethodsOf::command);
  Json input;
  input["scene"] = placeless_scene_text(scene);
  input["models"].push_back(model_input(scene.model));
  input["tables"].push_back(driving_tables(scene));
  for (const Scene& panel : scene.compare) {
    input["models"].push_back(model_input(panel.model));
    input["tables"].push_back(driving_tables(panel));
  }
  return input;
}

Json input_of(const std::string& path, const std::vector<std::string>& overrides) {
  const std::string ending = lower_case_ending(path);
  try {
    // Nothing that throws stands within braces: there g++ 12 destroys values that it has not made.
    Json input;
    if (is_model_file(path)) {
      const Json model = model_input(ModelSource(path));
      input["models"].push_back(model);
    } else if (ending == ".yaml" || ending == ".yml") {
      input = scene_input(path, overrides);
    } else {
      const std::string sha256 = sha256_of_file(path);
      input["sha256"] = sha256;
    }
    input["file"] = fs::path(path).filename().string();
    return input;
  } catch (const Error&) {
    return nullptr;
  }
}

void add_model_changes(const Json& before, const Json& now, std::vector<std::string>& words) {
  if (word_of(before, "elements_sha256") == word_of(now, "elements_sha256")) return;
  std::vector<std::string> own = explain_models(before.value("mechanism", Json()), now.value("mechanism", Json()));
  if (own.empty()) own.emplace_back(std::string("the model ") + kAnother);
  for (std::string& one : own)
    if (std::find(words.begin(), words.end(), one) == words.end()) words.push_back(std::move(one));
}

std::vector<std::string> changes_of(const Json& before, const Json& now, const std::vector<std::string>& without) {
  std::vector<std::string> words;
  if (word_of(before, "sha256") != word_of(now, "sha256")) words.emplace_back(kAnother);
  if (word_of(before, "scene") != word_of(now, "scene")) {
    words = explain_scene_texts(word_of(before, "scene"), word_of(now, "scene"));
    if (words.empty()) words.emplace_back("is another one");
    std::erase_if(words, [&](const std::string& one) {
      const std::string key = one.substr(0, one.find_first_of(" :"));
      return std::ranges::any_of(without, [&](const std::string& other) { return key == other || key.starts_with(other + "."); });
    });
  }
  const Json models = before.value("models", Json::array()), tables = before.value("tables", Json::array());
  const Json models_now = now.value("models", Json::array()), tables_now = now.value("tables", Json::array());
  for (std::size_t i = 0; i < std::min(models.size(), models_now.size()); ++i) add_model_changes(models[i], models_now[i], words);
  for (std::size_t i = 0; i < std::min(tables.size(), tables_now.size()); ++i)
    for (std::string& one : table_changes(tables[i], tables_now[i], "torque")) words.push_back(std::move(one));
  return words;
}

}  // namespace

std::vector<std::string> words_from(const Command& command, const std::string& folder) {
  std::vector<std::string> words = command.words();
  for (const std::size_t i : command.files()) {
    const std::size_t begin = begin_of_path(words[i], words[i - 1]);
    words[i].replace(begin, std::string::npos, path_from(folder, words[i].substr(begin)));
  }
  return words;
}

Json command_inputs(const std::vector<std::string>& words, const std::vector<std::size_t>& files) {
  const std::vector<std::string> overrides = overrides_in(words);
  Json inputs = Json::array();
  for (const std::size_t i : files)
    if (i > 0 && i < words.size() && words[i - 1] != "--package") inputs.push_back(input_of(words[i], overrides));
  return inputs;
}

bool are_known(const Json& inputs) {
  return inputs.is_array() && !inputs.empty() && std::none_of(inputs.begin(), inputs.end(), [](const Json& one) { return !one.is_object(); });
}

std::vector<std::string> keys_of_command(const std::vector<std::string>& words) {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    for (const char* option : {"--over", "--sweep", "--x", "--y"})
      if (words[i] == option) keys.push_back(words[i + 1].substr(0, words[i + 1].find('=')));
  return keys;
}

std::vector<std::string> keys_without_numbers(const std::vector<std::string>& words) {
  // Of others nothing is known.
  static const std::vector<std::string> kCommands = {"simulate", "sweep", "fall", "inverse", "equations", "energy", "stability"};
  if (words.empty() || std::ranges::count(kCommands, words.front()) == 0) return {};
  std::vector<std::string> keys = keys_of_command(words);
  keys.insert(keys.end(), {"title", "acknowledge", "draw", "theme", "text_scale", "style", "annotate"});
  if (words.front() == "equations")  // of the mechanism
    keys.insert(keys.end(), {"start", "torque", "push", "method", "step", "tolerance", "order", "accuracy", "duration", "ellipse", "camera", "plot", "layout", "video",
                             "slow_motion", "hold", "events", "expect"});
  return keys;
}

std::vector<std::string> changed_inputs(const Json& before, const Json& now, const std::vector<std::string>& without) try {
  std::vector<std::string> words;
  if (before.size() != now.size()) return {"its files are others"};
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::string file = before.size() > 1 || before[i].contains("sha256") ? word_of(before[i], "file") + ": " : "";
    for (const std::string& one : changes_of(before[i], now[i], without)) words.push_back(file + one);
  }
  return words;
} catch (const Json::exception&) {
  return {"what it remembers of its files is no record of this program"};
}

}  // namespace chainreel
