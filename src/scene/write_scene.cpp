#include "scene/write_scene.hpp"

#include <yaml-cpp/yaml.h>

#include "core/format.hpp"

namespace chainreel {
namespace {

template <class Values, class Text>
void emit_list(YAML::Emitter& out, const Values& values, Text text) {
  out << YAML::Flow << YAML::BeginSeq;
  for (const auto& value : values) out << text(value);
  out << YAML::EndSeq;
}

void emit_numbers(YAML::Emitter& out, const std::vector<double>& values) {
  emit_list(out, values, format_shortest);
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
  out << YAML::EndMap;
}

void emit_control(YAML::Emitter& out, const Control& control) {
  out << YAML::Flow << YAML::BeginMap;
  if (!control.csv.empty()) out << YAML::Key << "csv" << YAML::Value << control.csv;
  if (!control.inverse_of.empty()) out << YAML::Key << "inverse_of" << YAML::Value << control.inverse_of;
  emit_feedback(out, "pd", control.pd);
  emit_feedback(out, "computed_torque", control.computed_torque);
  if (control.gravity_compensation) out << YAML::Key << "gravity_compensation" << YAML::Value << true;
  out << YAML::EndMap;
}

void emit_torque(YAML::Emitter& out, const Scene& scene) {
  out << YAML::Key << "torque" << YAML::Value;
  if (scene.control) return emit_control(out, *scene.control);
  out << YAML::Flow << YAML::BeginSeq;
  for (const TorqueEntry& entry : scene.torque) {
    if (entry.control)
      emit_control(out, *entry.control);
    else
      out << entry.text;
  }
  out << YAML::EndSeq;
}

void emit_mechanism(YAML::Emitter& out, const Scene& scene) {
  if (scene.gravity) {
    out << YAML::Key << "gravity" << YAML::Value;
    emit_numbers(out, {scene.gravity->x(), scene.gravity->y(), scene.gravity->z()});
  }
  out << YAML::Key << "base" << YAML::Value << scene.base;
  out << YAML::Key << "friction" << YAML::Value << scene.friction;
  if (scene.massless) out << YAML::Key << "massless" << YAML::Value << format_shortest(*scene.massless);
  out << YAML::Key << "limit" << YAML::Value << scene.limit;
  out << YAML::Key << "packages" << YAML::Value << YAML::Flow << YAML::BeginMap;
  for (const auto& [name, folder] : scene.packages) out << YAML::Key << name << YAML::Value << folder;
  out << YAML::EndMap;
}

void emit_motion(YAML::Emitter& out, const Scene& scene) {
  out << YAML::Key << "start" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "q" << YAML::Value;
  emit_numbers(out, scene.start.q);
  out << YAML::Key << "qd" << YAML::Value;
  emit_numbers(out, scene.start.qd);
  out << YAML::EndMap;
  emit_torque(out, scene);
  out << YAML::Key << "parameters" << YAML::Value << YAML::Flow << YAML::BeginMap;
  for (const auto& [name, value] : scene.parameters)
    out << YAML::Key << name << YAML::Value << format_shortest(value);
  out << YAML::EndMap;
}

}  // namespace

std::string scene_text(const Scene& scene) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  out << YAML::Key << "title" << YAML::Value << YAML::DoubleQuoted << scene.title;
  out << YAML::Key << "model" << YAML::Value << scene.model;
  emit_mechanism(out, scene);
  emit_motion(out, scene);
  if (!scene.end_effector.empty()) out << YAML::Key << "end_effector" << YAML::Value << scene.end_effector;
  out << YAML::Key << "duration" << YAML::Value << format_shortest(scene.duration);
  out << YAML::Key << "method" << YAML::Value << scene.method;
  if (scene.step) out << YAML::Key << "step" << YAML::Value << format_shortest(*scene.step);
  if (scene.tolerance) out << YAML::Key << "tolerance" << YAML::Value << format_shortest(*scene.tolerance);
  if (scene.order) out << YAML::Key << "order" << YAML::Value << *scene.order;
  if (scene.method == "auto") out << YAML::Key << "accuracy" << YAML::Value << to_string(scene.accuracy);
  out << YAML::Key << "draw" << YAML::Value;
  emit_list(out, scene.draw, [](const std::string& name) { return name; });
  out << YAML::Key << "text_scale" << YAML::Value << format_shortest(scene.text_scale);
  out << YAML::Key << "video" << YAML::Value << YAML::Flow << YAML::BeginMap;
  out << YAML::Key << "width" << YAML::Value << scene.video.width;
  out << YAML::Key << "height" << YAML::Value << scene.video.height;
  out << YAML::Key << "fps" << YAML::Value << rate_text(scene.video.fps);
  out << YAML::EndMap << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace chainreel
