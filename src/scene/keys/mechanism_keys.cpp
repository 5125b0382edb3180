// The keys model, packages, parameters and frames.
#include <filesystem>

#include "core/data_folder.hpp"
#include "expr/expression.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/quantity.hpp"

namespace chainreel {

KeyText told_model() {
  const KeyText number = told("", KeyForm::number, "");
  const auto for_all_or_each = [&](const char* name, const char* help) {
    return told_either(name, {number, told_list("", number, "")}, help);
  };
  return told_either(
             "model",
             {told("", KeyForm::path, "a URDF file, relative to the scene, or the name of one that comes with the program: rr.urdf"),
              told_record(
                  "",
                  {told_list("links", number, "their lengths, m; at zero all lie along x, one behind the other; frames are base, link1, link2 .. and the end, gripper"),
                   for_all_or_each("masses", "kg; 1 each where left out"),
                   told("joints", KeyForm::text,
                        "a letter each: R turns about z, P slides along x, or across the P before it; else with its axis, "
                        "RzPx; all R where left out"),
                   told_word("shape", names_of(LinkMass{}), "where the mass is; rod where left out"),
                   for_all_or_each("damping", "of the joints, N m s/rad or N s/m; none where left out"),
                   for_all_or_each("efforts", "that the joints are limited to, for `limit:`, N m or N; without end where left out"),
                   told_list("dh", told_list("", number, ""),
                             "in the place of `links`: a, alpha, d, theta of each joint (Denavit and Hartenberg), m and rad"),
                   told_word("convention", names_of(DhConvention{}), "of `dh`; standard where left out")},
                  "a serial chain in numbers: a number a link, or one for all")},
             "the mechanism")
      .required();
}

namespace {

// A number for all, or a list of one each.
void read_numbers(Fields& fields, const std::string& key, const char* unit, std::vector<double>& values) {
  double one = 0;
  fields.measure_in(unit);
  if (fields.find(key).IsScalar() && fields.read(key, one))
    values = {one};
  else if (!fields.find(key).IsScalar())
    fields.read(key, values);
  fields.measure_in("");
}

bool read_dh(Fields& fields, std::vector<DhRow>& rows) {
  const YAML::Node node = fields.find("dh");
  if (!node.IsDefined()) return true;
  bool is_good = node.IsSequence() && node.size() > 0;
  if (!is_good) fields.problem_at("dh", "'model.dh' must hold rows a, alpha, d, theta: dh: [[0.5, 90deg, 0, 0], [0.4, 0, 0, 0]]");
  for (std::size_t i = 0; is_good && i < node.size(); ++i) {
    const std::string key = "dh." + std::to_string(i + 1);
    const Place place = fields.place_of(node[i], key);
    try {
      if (!node[i].IsSequence() || node[i].size() != 4)
        throw Error(ExitCode::bad_input, "must be four numbers a, alpha, d, theta: [0.5, 90deg, 0, 0]");
      DhRow& row = rows.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        if (!node[i][k].IsScalar()) throw Error(ExitCode::bad_input, "must be four numbers a, alpha, d, theta");
        row[k] = kDhAngle[k] ? parse_angle(node[i][k].Scalar(), place) : parse_quantity(node[i][k].Scalar(), place, "m");
      }
    } catch (const Error& error) {
      fields.problems().add("'model." + key + "': " + error.problems().front().message, place);
      is_good = false;
    }
  }
  return is_good;
}

ModelSource read_links(Fields& fields, const YAML::Node& node) {
  Fields inner(fields.document(), node, "model", fields.problems());
  ModelSource source(fields.document().file);
  source.place = fields.place_of(node, "model");
  LinkChain chain;
  const bool has_links = inner.has("links");
  inner.measure_in("m");
  bool is_good = !has_links || inner.read("links", chain.links);
  read_numbers(inner, "masses", "kg", chain.masses);
  read_numbers(inner, "damping", "N m s/rad or N s/m", chain.damping);
  read_numbers(inner, "efforts", "N m or N", chain.efforts);
  inner.read("joints", chain.joints);
  inner.read("shape", chain.shape);
  is_good &= read_dh(inner, chain.dh);
  inner.read("convention", chain.convention);
  if (inner.has("convention") && chain.dh.empty())
    inner.problem_at("convention", "'model.convention' means nothing without rows of `dh`");
  inner.finish();
  if (!is_good) return source;
  // A number in brackets is that of one link.
  for (const char* key : {"masses", "damping", "efforts"})
    if (const YAML::Node list = inner.find(key); list.IsSequence() && list.size() == 1 && chain.size() > 1)
      inner.problem_at(key, "'model." + std::string(key) + "' is a list of one entry, but the chain has " + std::to_string(chain.size()) +
                                " links: write one for each, or one for all without brackets");
  for (const LinkProblem& problem : complete(chain)) {
    const std::string message = "'model." + problem.key + "' " + problem.message;
    if (inner.find(problem.key).IsDefined())
      inner.problem_at(problem.key, message);
    else
      fields.problem_at("model", message);
  }
  source.links = std::move(chain);
  return source;
}

}  // namespace

namespace {

// Of a name without folders, which a model that comes with the program may have.
std::string among_shipped(const std::string& name) {
  if (name.find('/') != std::string::npos) return "";
  const std::string near = near_shipped_models(name);
  return near.empty() ? "" : ", and none of that name comes with the program:" + near;
}

}  // namespace

void read_model(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("model");
  if (node.IsMap()) {
    scene.model = read_links(fields, node);
    return;
  }
  if (node.IsSequence())
    return fields.problem_at("model", "'model' must be a URDF file, or hold numbers: model: {links: [0.5, 0.4], masses: [2, 1]}");
  fields.read_path("model", scene.model.path);
  std::error_code ignored;
  if (scene.model.path.empty())
    fields.problem_at("model", "the scene names no model: write `model: my_robot.urdf`, `model: rr.urdf` for one that comes with the program, or `model: {links: [0.5, 0.4]}`");
  else if (!std::filesystem::is_regular_file(scene.model.path, ignored))
    fields.problem_at("model", "there is no model file " + scene.model.path + ": " + fields.paths_start("model") + among_shipped(node.Scalar()));
}

std::string model_text(const Scene& scene) {
  return scene.model.links ? text_of(*scene.model.links) : word_text(scene.model.path);
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
