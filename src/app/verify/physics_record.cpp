#include "app/verify/physics_record.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "core/csv.hpp"
#include "core/hash.hpp"
#include "scene/keys/keys.hpp"
#include "scene/run/prepare.hpp"
#include "sim/trajectory_difference.hpp"

namespace chainreel {
namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

// Where files lie and what the model's is called is of no matter, what they say is told of themselves; how
// films are packed no picture shows.
bool is_recorded(const SceneKey& key) {
  return key.name != "model" && key.name != "packages" && key.name != "title" &&
         key.flags != FlagGroup::output && key.section() != "hold";
}

// Of the tables that drive a scene: their names as they stand in its keys, and a hash of their numbers.
class Tables {
 public:
  void take(MotionEntry& motion) { add(motion.csv, sha256_of(*motion.table)); }
  void take(Control& control) {
    take(control.csv);
    take(control.inverse_of);
    if (control.pd) take(control.pd->trajectory);
    if (control.computed_torque) take(control.computed_torque->trajectory);
  }
  Json hashes() { return std::move(hashes_); }

 private:
  // Names alone stay in the key.
  void take(std::string& path) {
    if (!path.empty()) add(path, sha256_of(read_csv(path)));
  }
  void add(std::string& path, const std::string& hash) {
    path = file_name(path);
    const std::string others = hashes_.value(path, "");  // of another folder
    hashes_[path] = others + (others.empty() ? "" : " ") + hash;
  }

  Json hashes_ = Json::object();
};

Json keys_of(Scene scene, KeyOf of, Tables& tables) {
  if (scene.motion) tables.take(*scene.motion);
  if (scene.control) tables.take(*scene.control);
  for (TorqueEntry& entry : scene.torque)
    if (entry.control) tables.take(*entry.control);
  std::vector<SceneEntry> entries;
  for (const SceneKey& key : scene_keys())
    if (key.of == of && is_recorded(key)) key.write(key, scene, entries);
  Json json = Json::object();
  for (const SceneEntry& entry : entries) json[entry.key] = entry.text;
  return json;
}

Json json_of(const std::vector<SampledNumber>& numbers) {
  Json json = Json::array();
  for (const SampledNumber& number : numbers) json.push_back({number.label, number.unit});
  return json;
}

// What is no number is null, as JSON has it.
Json json_of(const std::vector<double>& numbers) {
  Json json = Json::array();
  for (const double number : numbers) json.push_back(std::isfinite(number) ? Json(number) : Json(nullptr));
  return json;
}

Json trajectory_record(const PreparedScene& panel, const Trajectory& trajectory) {
  const Audit audit = audit_of(panel.simulation, trajectory);
  SampledTrajectory run = sampled(panel.simulation.chain, trajectory);
  Json events = Json::array();
  for (int k = 0; k < trajectory.events.size(); ++k) {
    const EventEntry& event = panel.scene.events[std::size_t(trajectory.events.event[std::size_t(k)])];
    events.push_back({event.title(), trajectory.events.t[std::size_t(k)]});
  }
  return {{"sha256", audit.sha256},
          {"status", run.status},
          {"end_time", run.end_time},
          {"events", events},
          {"q_numbers", json_of(run.q_numbers)},
          {"qd_numbers", json_of(run.qd_numbers)},
          {"t", json_of(run.t)},
          {"q", json_of(run.q)},
          {"qd", json_of(run.qd)}};
}

Json method_record(const PreparedScene& panel) {
  const Simulation& simulation = panel.simulation;
  Json json{{"name", simulation.method->name}, {"step", simulation.step}};
  if (simulation.options.tolerance > 0) json["tolerance"] = simulation.options.tolerance;
  if (simulation.options.order > 0) json["order"] = simulation.options.order;
  return json;
}

// How a panel's model was read.
struct ModelReading {
  ModelSource source;
  ModelOptions options;
  DescribeCollisions collisions;
  friend bool operator==(const ModelReading&, const ModelReading&) = default;
};
ModelReading reading_of(const PreparedScene& panel) {
  const bool shows_collisions = panel.scene.links == LinkShapes::collision;
  ModelReading reading{panel.scene.model, model_options_of(panel.scene),
                       shows_collisions ? DescribeCollisions::all : DescribeCollisions::where_seen};
  reading.options.meshes = panel.shapes != nullptr;  // of bars no picture shows them
  return reading;
}

}  // namespace

Json model_record(const ModelSource& urdf, const ModelOptions& options, DescribeCollisions collisions) {
  return to_json(describe_model(urdf, options, collisions));
}

Json run_record(const PreparedFilm& film, const Runs& runs) {
  Json models = Json::array(), panels = Json::array();
  Tables page_tables;
  Json page = keys_of(film.scene, KeyOf::page, page_tables);
  page["title"] = film.scene.title;
  std::vector<ModelReading> read;  // of `models`: panels that share one read its meshes once
  for (std::size_t i = 0; i < film.panels.size(); ++i) {
    const PreparedScene& panel = film.panels[i];
    const ModelReading reading = reading_of(panel);
    const auto index = std::size_t(std::find(read.begin(), read.end(), reading) - read.begin());
    if (index == read.size()) {
      read.push_back(reading);
      models.push_back(model_record(reading.source, reading.options, reading.collisions));
    }
    Tables tables;
    Json keys = keys_of(panel.scene, KeyOf::panel, tables);
    panels.push_back({{"title", panel.scene.title},
                      {"keys", std::move(keys)},
                      {"tables", tables.hashes()},
                      {"model", index},
                      {"method", method_record(panel)},
                      {"trajectory", trajectory_record(panel, runs[i])}});
  }
  return {{"page", page}, {"panels", panels}, {"models", models}};
}

}  // namespace chainreel
