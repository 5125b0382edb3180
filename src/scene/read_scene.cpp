#include "scene/read_scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/format.hpp"
#include "core/json.hpp"
#include "scene/fields.hpp"
#include "scene/film_clock.hpp"
#include "scene/quantity.hpp"
#include "scene/read_camera.hpp"
#include "scene/read_compare.hpp"
#include "scene/read_constraints.hpp"
#include "scene/read_control.hpp"
#include "scene/read_events.hpp"
#include "scene/read_method.hpp"
#include "scene/read_plot.hpp"
#include "scene/read_slow_motion.hpp"
#include "sim/drive/limits.hpp"

namespace chainreel {
namespace {

constexpr int kLargestSide = 16384;  // pixels
constexpr double kLongestHold = 3600;  // s

// A problem at a key's value unless `good`.
void require(Fields& fields, const std::string& key, bool good, const std::string& message) {
  if (good) return;
  const YAML::Node node = fields.find(key);
  fields.problems().add(message,
                        node.IsDefined() ? fields.place_of(node, key) : Place{fields.document().file, 0, 0});
}

void read_model(Fields& fields, Scene& scene) {
  fields.read("model", scene.model);
  if (scene.model.empty()) {
    require(fields, "model", false, "the scene names no model: write `model: ../../models/rr.urdf`");
    return;
  }
  scene.model = beside(scene.file, scene.model);
  std::error_code ignored;
  require(fields, "model", std::filesystem::is_regular_file(scene.model, ignored),
          "there is no model file " + scene.model + ": paths are relative to the scene file");
}

void read_start(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("start");
  if (!node.IsDefined()) return;
  if (!node.IsMap()) {
    fields.problems().add("'start' must hold q and qd: start: {q: [0, 90deg], qd: [0, 0]}",
                          fields.place_of(node, "start"));
    return;
  }
  Fields start(fields.document(), node, fields.path("start"), fields.problems());
  start.read("q", scene.start.q);
  start.read("qd", scene.start.qd);
  start.finish();
}

void read_torque(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("torque");
  if (!node.IsDefined()) return;
  if (node.IsMap()) {
    scene.control = read_control(fields, node, "torque");
    return;
  }
  if (!node.IsSequence()) {
    fields.problems().add(
        "'torque' must be a list with a number or an expression a joint: [0, -100 * y_G], or a control like "
        "{pd: {kp: 100, kd: 10, q: [0, 1]}}",
        fields.place_of(node, "torque"));
    return;
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string key = "torque." + std::to_string(i + 1);
    const Place place = fields.place_of(node[i], key);
    if (node[i].IsScalar())
      scene.torque.push_back({node[i].Scalar(), place, {}});
    else if (node[i].IsMap())
      scene.torque.push_back({"control", place, read_control(fields, node[i], key)});
    else
      fields.problems().add(
          "'torque' entry " + std::to_string(i + 1) + " must be a number, an expression or a control", place);
  }
}

void read_mechanism(Fields& fields, Scene& scene) {
  fields.read("base", scene.base);
  require(fields, "base", scene.base == "fixed" || scene.base == "floating",
          "'base' must be fixed or floating");
  fields.read("friction", scene.friction);
  double massless = 0;
  fields.read("massless", massless);
  if (fields.find("massless").IsDefined()) {
    require(fields, "massless", massless > 0, "'massless' must be a mass above 0 kg, like 1e-6");
    scene.massless = massless;
  }
  fields.read("limit", scene.limit);
  try {
    limit_policy_of(scene.limit);
  } catch (const Error& error) {
    require(fields, "limit", false, error.what());
  }
  const YAML::Node packages = fields.find("packages");
  if (!packages.IsDefined()) return;
  require(fields, "packages", packages.IsMap(),
          "'packages' must hold names and folders: packages: {my_robot: ../robot}");
  if (packages.IsMap())
    for (const auto& pair : packages)
      scene.packages[pair.first.Scalar()] =
          beside(scene.file, pair.second.IsScalar() ? pair.second.Scalar() : "");
}

void read_parameters(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("parameters");
  if (!node.IsDefined()) return;
  if (!node.IsMap()) {
    fields.problems().add("'parameters' must hold names and numbers: parameters: {k: 100}",
                          fields.place_of(node, "parameters"));
    return;
  }
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

// A plain list replaces the default layers; entries `+name` and `-name` edit them.
void read_draw(Fields& fields, Scene& scene) {
  std::vector<std::string> entries;
  fields.read("draw", entries);
  if (entries.empty()) {
    if (fields.find("draw").IsDefined()) scene.draw.clear();
    return;
  }
  const auto edits = std::count_if(entries.begin(), entries.end(), [](const std::string& entry) {
    return entry.starts_with('+') || entry.starts_with('-');
  });
  require(fields, "draw", edits == 0 || edits == long(entries.size()),
          "'draw' either lists layers or edits the default ones with +name and -name; do not mix the two");
  if (edits == 0) scene.draw.clear();
  for (const std::string& entry : entries) {
    const bool remove = entry.starts_with('-');
    const std::string name = remove || entry.starts_with('+') ? entry.substr(1) : entry;
    const auto& known = layer_names();
    require(fields, "draw", std::find(known.begin(), known.end(), name) != known.end(),
            "unknown layer '" + name + "' in 'draw':" + did_you_mean(name, known));
    std::erase(scene.draw, name);
    if (!remove) scene.draw.push_back(name);
  }
}

void read_ellipse(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("ellipse");
  if (!node.IsDefined()) return;
  if (!node.IsMap()) {
    fields.problems().add("'ellipse' must hold reading or shape, like ellipse: {reading: belt}",
                          fields.place_of(node, "ellipse"));
    return;
  }
  Fields ellipse(fields.document(), node, fields.path("ellipse"), fields.problems());
  ellipse.read("reading", scene.ellipse.reading);
  const auto& known = reading_names();
  require(ellipse, "reading", std::find(known.begin(), known.end(), scene.ellipse.reading) != known.end(),
          "'ellipse.reading' must be mass, energy or belt, not '" + scene.ellipse.reading + "'");
  ellipse.read("shape", scene.ellipse.shape);
  require(ellipse, "shape", scene.ellipse.shape == "ellipsoid" || scene.ellipse.shape == "section",
          "'ellipse.shape' must be ellipsoid or section, not '" + scene.ellipse.shape + "'");
  ellipse.finish();
}

void read_theme(Fields& fields, Scene& scene) {
  fields.read("theme", scene.theme);
  const auto& known = theme_names();
  require(fields, "theme", std::find(known.begin(), known.end(), scene.theme) != known.end(),
          "'theme' must be light or dark, not '" + scene.theme + "'");
}

void read_video(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("video");
  if (!node.IsDefined()) return;
  if (!node.IsMap()) {
    fields.problems().add("'video' must hold width, height, fps: video: {width: 1280, height: 720, fps: 60}",
                          fields.place_of(node, "video"));
    return;
  }
  Fields video(fields.document(), node, fields.path("video"), fields.problems());
  video.read("width", scene.video.width);
  video.read("height", scene.video.height);
  video.read("fps", scene.video.fps);
  video.read("preset", scene.video.preset);
  const auto& presets = preset_names();
  require(video, "preset",
          !video.find("preset").IsDefined() ||
              std::find(presets.begin(), presets.end(), scene.video.preset) != presets.end(),
          "unknown preset '" + scene.video.preset + "':" + did_you_mean(scene.video.preset, presets) +
              " There are slides, web, overlay, doc, frames and still.");
  if (video.find("crf").IsDefined()) {
    double crf = 0;
    video.read("crf", crf);
    require(video, "crf", crf >= 0 && crf <= 63,
            "'video.crf' must lie between 0, the best, and 51 for MP4 or 63 for WebM");
    scene.video.crf = crf;
  }
  for (const auto& [key, side] :
       {std::pair{"width", scene.video.width}, std::pair{"height", scene.video.height}}) {
    require(video, key, side >= 16 && side <= kLargestSide,
            "'video." + std::string(key) + "' must lie between 16 and " + std::to_string(kLargestSide) +
                " pixels");
    require(video, key, side % 2 == 0 || side < 16,
            "'video." + std::string(key) + "' is odd: H.264 with 4:2:0 colour needs even sides, take " +
                std::to_string(side - 1) + " or " + std::to_string(side + 1));
  }
  video.finish();
}

void read_hold(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("hold");
  if (!node.IsDefined()) return;
  if (!node.IsMap()) {
    fields.problems().add("'hold' must hold first and last, in seconds: hold: {first: 1, last: 2}",
                          fields.place_of(node, "hold"));
    return;
  }
  Fields hold(fields.document(), node, fields.path("hold"), fields.problems());
  hold.read("first", scene.hold.first);
  hold.read("last", scene.hold.last);
  for (const auto& [key, seconds] :
       {std::pair{"first", scene.hold.first}, std::pair{"last", scene.hold.last}})
    require(hold, key, seconds >= 0 && seconds <= kLongestHold,
            "'hold." + std::string(key) + "' must lie between 0 and " + format_shortest(kLongestHold) + " s");
  hold.finish();
}

void read_expectation(Fields& fields, Scene& scene) {
  fields.read("expect", scene.expect);
  require(fields, "expect", scene.expect == "finish" || scene.expect == "diverge",
          "'expect' must be finish or diverge");
}

void check_numbers(Fields& fields, const Scene& scene) {
  require(fields, "duration", scene.duration > 0, "'duration' must be above 0 s");
  require(fields, "text_scale", scene.text_scale >= 0.5 && scene.text_scale <= 3,
          "'text_scale' must lie between 0.5 and 3");
  const double frames = scene.duration * scene.video.fps.value();
  require(fields, "duration", frames <= kMostFrames, "'duration' is longer than ten million frames");
  require(fields, "duration", frames >= 0.5 || scene.duration <= 0,
          "'duration' is shorter than half a frame: the film would be empty");
}

// A scene of one panel.
Scene read_document(const YamlDocument& document) {
  Scene scene;
  scene.file = document.file;
  scene.name = std::filesystem::path(document.file).stem().string();
  ProblemList problems;
  Fields fields(document, document.root, "", problems);
  fields.read("title", scene.title);
  read_model(fields, scene);
  fields.read("gravity", scene.gravity);
  read_mechanism(fields, scene);
  read_start(fields, scene);
  read_torque(fields, scene);
  read_parameters(fields, scene);
  read_constraints(fields, scene);
  fields.read("end_effector", scene.end_effector);
  read_events(fields, scene);
  fields.read("duration", scene.duration);
  read_method(fields, scene);
  read_expectation(fields, scene);
  read_draw(fields, scene);
  read_body_shapes(fields, scene);
  read_ellipse(fields, scene);
  read_camera(fields, scene);
  read_plot(fields, scene);
  read_layout(fields, scene);
  fields.find("compare");
  read_theme(fields, scene);
  fields.read("text_scale", scene.text_scale);
  read_video(fields, scene);
  read_slow_motion(fields, scene);
  read_hold(fields, scene);
  check_numbers(fields, scene);
  fields.finish();
  problems.throw_if_any();
  scene.places = document.places();
  return scene;
}

Scene read_either(const YamlDocument& document) {
  return is_comparison(document) ? read_comparison(document, &read_document) : read_document(document);
}

std::vector<Override> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<Override> parsed;
  for (const std::string& text : texts) parsed.push_back(parse_override(text));
  return parsed;
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  return read_either(load_yaml(path, parse_overrides(overrides)));
}

SceneFile::SceneFile(const std::string& path) : path_(path) {}

SceneFile::~SceneFile() = default;

Scene SceneFile::read(const std::vector<std::string>& overrides) {
  constexpr int kMostReads = 1000;  // values that were replaced stay in the document's memory
  const std::vector<Override> wanted = parse_overrides(overrides);
  const auto same_key = [](const Override& a, const Override& b) { return a.key == b.key; };
  const bool fits = document_ && ++reads_ < kMostReads &&
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
