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

void emit_motion(YAML::Emitter& out, const Scene& scene) {
  if (scene.gravity) {
    out << YAML::Key << "gravity" << YAML::Value;
    emit_numbers(out, {scene.gravity->x(), scene.gravity->y(), scene.gravity->z()});
  }
  out << YAML::Key << "start" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "q" << YAML::Value;
  emit_numbers(out, scene.start.q);
  out << YAML::Key << "qd" << YAML::Value;
  emit_numbers(out, scene.start.qd);
  out << YAML::EndMap;
  out << YAML::Key << "torque" << YAML::Value;
  emit_list(out, scene.torque, [](const TorqueEntry& entry) { return entry.text; });
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
  emit_motion(out, scene);
  if (!scene.end_effector.empty()) out << YAML::Key << "end_effector" << YAML::Value << scene.end_effector;
  out << YAML::Key << "duration" << YAML::Value << format_shortest(scene.duration);
  out << YAML::Key << "method" << YAML::Value << scene.method;
  out << YAML::Key << "step" << YAML::Value << format_shortest(scene.step);
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
