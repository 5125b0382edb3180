#include "scene/write_constraints.hpp"

#include <yaml-cpp/yaml.h>

#include "core/format.hpp"

namespace chainreel {
namespace {

void emit(YAML::Emitter& out, const char* key, const std::string& text) {
  out << YAML::Key << key << YAML::Value << text;
}

void emit(YAML::Emitter& out, const char* key, const std::vector<double>& numbers) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double x : numbers) out << format_shortest(x);
  out << YAML::EndSeq;
}

void emit_quoted(YAML::Emitter& out, const char* key, const std::string& text) {
  out << YAML::Key << key << YAML::Value << YAML::DoubleQuoted << text;
}

void emit_other_end(YAML::Emitter& out, const ConstraintEntry& entry) {
  if (entry.b.empty())
    emit(out, "at", entry.at);
  else
    emit(out, "b", entry.b);
}

void emit_members(YAML::Emitter& out, const ConstraintEntry& entry) {
  const std::string& kind = entry.kind;
  const std::string value = format_shortest(entry.value);
  if (kind == "line" || kind == "plane") {
    emit(out, "frame", entry.a);
    emit(out, "point", entry.at);
    emit(out, kind == "line" ? "direction" : "normal", entry.direction);
  } else if (kind == "point") {
    emit(out, "frame", entry.a);
    emit(out, "at", entry.at);
  } else if (kind == "distance") {
    emit(out, "a", entry.a);
    emit_other_end(out, entry);
    emit(out, "length", value);
  } else if (kind == "close") {
    emit(out, "a", entry.a);
    emit_other_end(out, entry);
    if (entry.closure == "weld") emit(out, "weld", std::string("true"));
    if (entry.closure == "axis" && entry.direction.empty()) emit(out, "axis", std::string("true"));
    if (entry.closure == "axis" && !entry.direction.empty()) emit(out, "axis", entry.direction);
  } else if (kind == "curve") {
    emit(out, "frame", entry.a);
    emit_quoted(out, "x", entry.x);
    emit_quoted(out, "y", entry.y);
    emit(out, "s", format_shortest(entry.s));
  } else if (kind == "joint") {
    emit(out, "name", entry.a);
    emit(out, "value", value);
  } else {
    out << YAML::Key << "coefficients" << YAML::Value << YAML::Flow << YAML::BeginMap;
    for (const auto& [name, coefficient] : entry.coefficients)
      emit(out, name.c_str(), format_shortest(coefficient));
    out << YAML::EndMap;
    emit(out, "value", value);
  }
}

// Emitters break long lines; one line is wanted.
std::string in_one_line(const YAML::Emitter& out) {
  std::string text = out.c_str();
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) {
    const std::size_t end = text.find_first_not_of(" \n", at);
    text.replace(at, end - at, " ");
  }
  return text;
}

}  // namespace

std::string constraints_text(const Scene& scene) {
  YAML::Emitter out;
  out << YAML::Flow << YAML::BeginSeq;
  for (const ConstraintEntry& entry : scene.constraints) {
    out << YAML::Flow << YAML::BeginMap << YAML::Key << entry.kind << YAML::Value << YAML::Flow
        << YAML::BeginMap;
    emit_members(out, entry);
    out << YAML::EndMap << YAML::EndMap;
  }
  out << YAML::EndSeq;
  return in_one_line(out);
}

std::string contact_force_text(const Scene& scene) {
  YAML::Emitter out;
  out << YAML::Flow << YAML::BeginSeq;
  for (const ContactEntry& entry : scene.contact_force) {
    out << YAML::Flow << YAML::BeginMap;
    emit(out, "constraint", std::to_string(entry.constraint));
    emit(out, "force", entry.force);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq;
  return in_one_line(out);
}

}  // namespace chainreel
