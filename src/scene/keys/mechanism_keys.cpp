// The keys model, packages, parameters and frames.
#include <filesystem>

#include "expr/expression.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/quantity.hpp"

namespace chainreel {

KeyText told_model() {
  return told("model", KeyForm::path, "the mechanism, a URDF file").required();
}

void read_model(Fields& fields, Scene& scene) {
  fields.read_path("model", scene.model);
  std::error_code ignored;
  if (scene.model.empty())
    fields.problem_at("model", "the scene names no model: write `model: ../../models/rr.urdf`");
  else if (!std::filesystem::is_regular_file(scene.model, ignored))
    fields.problem_at("model", "there is no model file " + scene.model + ": paths are relative to the scene file");
}

std::string model_text(const Scene& scene) {
  return word_text(scene.model);
}

KeyText told_packages() {
  return told_mapping("packages", told("", KeyForm::path, "its folder"), "where package://NAME of the model lies");
}

void read_packages(Fields& fields, Scene& scene) {
  const YAML::Node packages = fields.find("packages");
  if (!packages.IsDefined()) return;
  if (!packages.IsMap())
    return fields.problem_at("packages", "'packages' must hold names and folders: packages: {my_robot: ../robot}");
  for (const auto& pair : packages)
    scene.packages[pair.first.Scalar()] = beside(scene.file, pair.second.IsScalar() ? pair.second.Scalar() : "");
}

void write_packages(const Scene& scene, std::vector<SceneEntry>& entries) {
  for (const auto& [name, folder] : scene.packages) entries.push_back({"packages." + name, word_text(folder)});
}

KeyText told_parameters() {
  return told_mapping("parameters", told("", KeyForm::number, "its value"), "names that expressions may read");
}

void read_parameters(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("parameters");
  if (!node.IsDefined()) return;
  if (!node.IsMap())
    return fields.problem_at("parameters", "'parameters' must hold names and numbers: parameters: {k: 100}");
  for (const auto& pair : node) {
    const std::string& name = pair.first.Scalar();
    const Place place = fields.place_of(pair.second, "parameters." + name);
    try {
      if (!pair.second.IsScalar()) throw Error(ExitCode::bad_input, "must be a number", place);
      scene.parameters.emplace_back(name, parse_quantity(pair.second.Scalar(), place));
    } catch (const Error& error) {
      fields.problems().add("parameter '" + name + "': " + error.problems().front().message, place);
    }
  }
}

void write_parameters(const Scene& scene, std::vector<SceneEntry>& entries) {
  for (const auto& [name, value] : scene.parameters) entries.push_back({"parameters." + name, format_shortest(value)});
}

KeyText told_frames() {
  return told_mapping("frames", told("", KeyForm::text, "a link, or a joint for the link behind it"),
                      "names by which expressions read places: with H, x_H y_H z_H xd_H yd_H zd_H");
}

void read_frames(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("frames");
  if (!node.IsDefined()) return;
  const auto complain = [&](const std::string& message, const YAML::Node& at, const std::string& key) {
    fields.problems().add(message, fields.place_of(at, key));
  };
  if (!node.IsMap())
    return complain("'frames' must hold names and links or joints of the model: frames: {H: hip}", node, "frames");
  for (const auto& pair : node) {
    const std::string& name = pair.first.Scalar();
    const std::string key = "frames." + name;
    if (!is_variable_name("x_" + name) || name == "G")
      complain("'" + name + "' cannot name a frame: take letters, digits and _, and not G, the end effector",
               pair.first, key);
    else if (!pair.second.IsScalar())
      complain("'" + key + "' must name a link or a joint of the model", pair.second, key);
    else
      scene.frames[name] = pair.second.Scalar();
  }
}

void write_frames(const Scene& scene, std::vector<SceneEntry>& entries) {
  for (const auto& [name, frame] : scene.frames) entries.push_back({"frames." + name, word_text(frame)});
}

}  // namespace chainreel
