#include "app/verify/physics_record.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "app/report/driving_tables.hpp"
#include "scene/keys/keys.hpp"
#include "scene/run/prepare.hpp"
#include "sim/trajectory_difference.hpp"

namespace chainreel {
namespace {

// Where files lie and what the model's is called is of no matter, what they say is told of themselves; how
// films are packed no picture shows.
bool is_recorded(const SceneKey& key) {
  return key.name != "model" && key.name != "packages" && key.name != "title" &&
         key.flags != FlagGroup::output && key.section() != "hold";
}

// Tables by their names alone.
Json keys_of(const Scene& scene, KeyOf of) {
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
  Json page = keys_of(with_named_tables(film.scene), KeyOf::page);
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
    panels.push_back({{"title", panel.scene.title},
                      {"keys", keys_of(with_named_tables(panel.scene), KeyOf::panel)},
                      {"tables", driving_tables(panel.scene)},
                      {"model", index},
                      {"method", method_record(panel)},
                      {"trajectory", trajectory_record(panel, runs[i])}});
  }
  return {{"page", page}, {"panels", panels}, {"models", models}};
}

}  // namespace chainreel
