#include "scene/write_scene.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "scene/write_constraints.hpp"

namespace chainreel {
namespace {

// Text of a value in one line of YAML.
template <class Emit>
std::string flow_text(Emit emit) {
  YAML::Emitter out;
  out << YAML::Flow;
  emit(out);
  return out.c_str();
}

template <class Values, class Text>
void emit_list(YAML::Emitter& out, const Values& values, Text text) {
  out << YAML::Flow << YAML::BeginSeq;
  for (const auto& value : values) out << text(value);
  out << YAML::EndSeq;
}

void emit_numbers(YAML::Emitter& out, const std::vector<double>& values) {
  emit_list(out, values, format_shortest);
}

std::string text_of(const std::string& word) {
  return flow_text([&](YAML::Emitter& out) { out << word; });
}

std::string text_of(const std::vector<double>& numbers) {
  return flow_text([&](YAML::Emitter& out) { emit_numbers(out, numbers); });
}

std::string quoted(const std::string& words) {
  return flow_text([&](YAML::Emitter& out) { out << YAML::DoubleQuoted << words; });
}

std::string rate_text(FrameRate fps) {
  return fps.den == 1 ? std::to_string(fps.num) : std::to_string(fps.num) + "/" + std::to_string(fps.den);
}

void emit_feedback(YAML::Emitter& out, const std::string& key, const std::optional<Feedback>& feedback) {
  if (!feedback) return;
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginMap;
  out << YAML::Key << "kp" << YAML::Value;
  emit_numbers(out, feedback->kp);
  out << YAML::Key << "kd" << YAML::Value;
  emit_numbers(out, feedback->kd);
  const auto entries = [&](const char* name, const std::vector<Entry>& list) {
    if (list.empty()) return;
    out << YAML::Key << name << YAML::Value;
    emit_list(out, list, [](const Entry& entry) { return entry.text; });
  };
  entries("q", feedback->q);
  entries("qd", feedback->qd);
  entries("qdd", feedback->qdd);
  if (!feedback->trajectory.empty()) out << YAML::Key << "trajectory" << YAML::Value << feedback->trajectory;
  if (feedback->outside) out << YAML::Key << "outside" << YAML::Value << to_string(*feedback->outside);
  out << YAML::EndMap;
}

void emit_control(YAML::Emitter& out, const Control& control) {
  out << YAML::Flow << YAML::BeginMap;
  if (!control.csv.empty()) out << YAML::Key << "csv" << YAML::Value << control.csv;
  if (!control.inverse_of.empty()) out << YAML::Key << "inverse_of" << YAML::Value << control.inverse_of;
  if (control.outside) out << YAML::Key << "outside" << YAML::Value << to_string(*control.outside);
  emit_feedback(out, "pd", control.pd);
  emit_feedback(out, "computed_torque", control.computed_torque);
  if (control.gravity_compensation) out << YAML::Key << "gravity_compensation" << YAML::Value << true;
  out << YAML::EndMap;
}

std::string torque_text(const Scene& scene) {
  return flow_text([&](YAML::Emitter& out) {
    if (scene.control) return emit_control(out, *scene.control);
    out << YAML::Flow << YAML::BeginSeq;
    for (const TorqueEntry& entry : scene.torque) {
      if (entry.control)
        emit_control(out, *entry.control);
      else
        out << entry.text;
    }
    out << YAML::EndSeq;
  });
}

void add_mechanism(std::vector<SceneEntry>& entries, const Scene& scene) {
  entries.push_back({"model", text_of(scene.model)});
  if (scene.gravity)
    entries.push_back({"gravity", text_of(std::vector<double>{scene.gravity->x(), scene.gravity->y(),
                                                              scene.gravity->z()})});
  entries.push_back({"base", scene.base});
  entries.push_back({"friction", scene.friction ? "true" : "false"});
  if (scene.massless) entries.push_back({"massless", format_shortest(*scene.massless)});
  entries.push_back({"limit", scene.limit});
  for (const auto& [name, folder] : scene.packages) entries.push_back({"packages." + name, text_of(folder)});
}

std::string events_text(const std::vector<EventEntry>& events) {
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const EventEntry& event : events) {
      out << YAML::Flow << YAML::BeginMap;
      out << YAML::Key << "when" << YAML::Value << YAML::DoubleQuoted << event.when;
      out << YAML::Key << "kind" << YAML::Value << to_string(event.kind);
      if (!event.name.empty()) out << YAML::Key << "name" << YAML::Value << YAML::DoubleQuoted << event.name;
      if (event.direction != Crossing::either)
        out << YAML::Key << "direction" << YAML::Value << to_string(event.direction);
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  });
}

void add_events(std::vector<SceneEntry>& entries, const Scene& scene) {
  for (const auto& [name, frame] : scene.frames) entries.push_back({"frames." + name, text_of(frame)});
  if (scene.foot) {
    entries.push_back({"foot.heel", format_shortest(scene.foot->heel)});
    entries.push_back({"foot.toe", format_shortest(scene.foot->toe)});
    entries.push_back({"foot.height", format_shortest(scene.foot->height)});
  }
  if (!scene.events.empty()) entries.push_back({"events", events_text(scene.events)});
}

void add_method(std::vector<SceneEntry>& entries, const Scene& scene) {
  entries.push_back({"method", scene.method});
  if (scene.step) entries.push_back({"step", format_shortest(*scene.step)});
  if (scene.tolerance) entries.push_back({"tolerance", format_shortest(*scene.tolerance)});
  if (scene.order) entries.push_back({"order", std::to_string(*scene.order)});
  if (scene.method == "auto") entries.push_back({"accuracy", to_string(scene.accuracy)});
  entries.push_back({"expect", scene.expect});
}

std::string plots_text(const std::vector<PlotEntry>& plots) {
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const PlotEntry& plot : plots) {
      if (plot.title.empty()) {
        out << YAML::DoubleQuoted << plot.value;
        continue;
      }
      out << YAML::Flow << YAML::BeginMap;
      out << YAML::Key << "value" << YAML::Value << YAML::DoubleQuoted << plot.value;
      out << YAML::Key << "title" << YAML::Value << YAML::DoubleQuoted << plot.title;
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  });
}

// What the scene leaves to the film stays left to it.
void add_camera(std::vector<SceneEntry>& entries, const CameraEntry& camera) {
  if (camera.azimuth) entries.push_back({"camera.azimuth", format_shortest(*camera.azimuth)});
  if (camera.elevation) entries.push_back({"camera.elevation", format_shortest(*camera.elevation)});
  if (camera.distance)
    entries.push_back(
        {"camera.distance", std::isfinite(*camera.distance) ? format_shortest(*camera.distance) : "parallel"});
  if (camera.fit) entries.push_back({"camera.fit", text_of(std::vector<double>(camera.fit->begin(), camera.fit->end()))});
}

std::string slow_motion_text(const std::vector<SlowMotionEntry>& stretches) {
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const SlowMotionEntry& one : stretches) {
      out << YAML::Flow << YAML::BeginMap;
      if (!one.event.empty()) out << YAML::Key << "event" << YAML::Value << YAML::DoubleQuoted << one.event;
      for (const auto& [key, value] : {std::pair{"from", one.from}, {"until", one.until}, {"speed", one.speed}})
        out << YAML::Key << key << YAML::Value << format_shortest(value);
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  });
}

void add_page(std::vector<SceneEntry>& entries, const Scene& scene) {
  entries.push_back({"draw", flow_text([&](YAML::Emitter& out) {
                       emit_list(out, scene.draw, [](const std::string& name) { return name; });
                     })});
  entries.push_back({"ellipse.reading", scene.ellipse.reading});
  entries.push_back({"ellipse.shape", scene.ellipse.shape});
  add_camera(entries, scene.camera);
  if (!scene.plot.empty()) entries.push_back({"plot", plots_text(scene.plot)});
  entries.push_back({"layout", scene.layout});
  entries.push_back({"theme", scene.theme});
  entries.push_back({"text_scale", format_shortest(scene.text_scale)});
  entries.push_back({"video.width", std::to_string(scene.video.width)});
  entries.push_back({"video.height", std::to_string(scene.video.height)});
  entries.push_back({"video.fps", rate_text(scene.video.fps)});
  if (!scene.video.preset.empty()) entries.push_back({"video.preset", scene.video.preset});
  if (scene.video.crf) entries.push_back({"video.crf", format_shortest(*scene.video.crf)});
  if (!scene.slow_motion.empty()) entries.push_back({"slow_motion", slow_motion_text(scene.slow_motion)});
  entries.push_back({"hold.first", format_shortest(scene.hold.first)});
  entries.push_back({"hold.last", format_shortest(scene.hold.last)});
}

bool holds(const std::vector<SceneEntry>& entries, const SceneEntry& entry) {
  return std::find(entries.begin(), entries.end(), entry) != entries.end();
}

// Lines `key: value`; neighbours below one key share its line: `video: {width: 640, height: 360}`.
std::string lines_of(const std::vector<SceneEntry>& entries) {
  std::string text, open;
  for (const SceneEntry& entry : entries) {
    const std::size_t dot = entry.key.find('.');
    const std::string group = dot == std::string::npos ? "" : entry.key.substr(0, dot);
    if (!open.empty() && group != open) text += "}\n";
    if (group.empty())
      text += entry.key + ": " + entry.text + "\n";
    else
      text += (group == open ? ", " : group + ": {") + entry.key.substr(dot + 1) + ": " + entry.text;
    open = group;
  }
  return text + (open.empty() ? "" : "}\n");
}

std::string panel_text(const Scene& panel, const std::vector<SceneEntry>& shared) {
  std::string text = "  - title: " + quoted(panel.title) + "\n";
  for (const SceneEntry& entry : entries_of(panel))
    if (!holds(shared, entry)) text += "    " + entry.key + ": " + entry.text + "\n";
  return text;
}

}  // namespace

std::vector<SceneEntry> entries_of(const Scene& scene) {
  std::vector<SceneEntry> entries;
  add_mechanism(entries, scene);
  entries.push_back({"start.q", text_of(scene.start.q)});
  entries.push_back({"start.qd", text_of(scene.start.qd)});
  entries.push_back({"torque", torque_text(scene)});
  for (const auto& [name, value] : scene.parameters)
    entries.push_back({"parameters." + name, format_shortest(value)});
  if (!scene.constraints.empty()) {
    entries.push_back({"constraints", constraints_text(scene)});
    entries.push_back({"stabilize", scene.stabilize});
    if (scene.stabilize == "baumgarte")
      entries.push_back({"baumgarte.gain", format_shortest(scene.baumgarte_gain)});
    if (!scene.contact_force.empty()) entries.push_back({"contact_force", contact_force_text(scene)});
  }
  if (!scene.end_effector.empty()) entries.push_back({"end_effector", text_of(scene.end_effector)});
  add_events(entries, scene);
  add_method(entries, scene);
  entries.push_back({"links", scene.links});
  entries.push_back({"mesh_up", scene.mesh_up});
  return entries;
}

std::vector<SceneEntry> shared_entries(const std::vector<Scene>& panels) {
  std::vector<SceneEntry> shared = entries_of(panels.front());
  for (const Scene& panel : panels) {
    const std::vector<SceneEntry> own = entries_of(panel);
    std::erase_if(shared, [&](const SceneEntry& entry) { return !holds(own, entry); });
  }
  return shared;
}

std::string scene_text(const Scene& scene) {
  std::vector<SceneEntry> entries{{"title", quoted(scene.title)}};
  const std::vector<SceneEntry> shared =
      scene.compare.empty() ? entries_of(scene) : shared_entries(scene.compare);
  entries.insert(entries.end(), shared.begin(), shared.end());
  entries.push_back({"duration", format_shortest(scene.duration)});
  add_page(entries, scene);
  std::string text = lines_of(entries);
  if (!scene.compare.empty()) text += "compare:\n";
  for (const Scene& panel : scene.compare) text += panel_text(panel, shared);
  return text;
}

}  // namespace chainreel
