// Keys that are more than one number or word: each with what it looks like, how it is read, and how it is written.
// The table in keys.cpp names them. Internal.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "core/format.hpp"
#include "scene/keys/fields.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {

// --- the mechanism: mechanism_keys.cpp
KeyText told_model();
void read_model(Fields& fields, Scene& scene);
std::string model_text(const Scene& scene);
KeyText told_packages();
void read_packages(Fields& fields, Scene& scene);
void write_packages(const Scene& scene, std::vector<SceneEntry>& entries);
KeyText told_parameters();
void read_parameters(Fields& fields, Scene& scene);
void write_parameters(const Scene& scene, std::vector<SceneEntry>& entries);
KeyText told_frames();
void read_frames(Fields& fields, Scene& scene);
void write_frames(const Scene& scene, std::vector<SceneEntry>& entries);

// --- what drives it: torque_keys.cpp
KeyText told_torque();
void read_torque(Fields& fields, Scene& scene);
std::string torque_text(const Scene& scene);

// --- what pushes it: push_keys.cpp
KeyText told_push();
void read_push(Fields& fields, Scene& scene);
std::string push_text(const Scene& scene);
// Forces that parameters give. After all keys were read.
void find_forces(Fields& fields, Scene& scene);

// --- what was recorded of it: motion_keys.cpp
KeyText told_motion();
void read_motion(Fields& fields, Scene& scene);
std::string motion_text(const Scene& scene);
// Names of a table's columns, of `time` and of joints; the first quantity is meant where none is named.
KeyText told_columns(const std::vector<std::string>& quantities);
ColumnNames read_columns(Fields& fields, const std::vector<std::string>& quantities);
void emit_columns(YAML::Emitter& out, const ColumnNames& columns, const std::string& usual);

// --- what ties it: constraint_keys.cpp
KeyText told_constraints();
void read_constraints(Fields& fields, Scene& scene);
std::string constraints_text(const Scene& scene);
KeyText told_contact_force();
void read_contact_force(Fields& fields, Scene& scene);
std::string contact_force_text(const Scene& scene);

// --- what is looked out for: event_keys.cpp
KeyText told_events();
void read_events(Fields& fields, Scene& scene);
// Whether the scene has an event of the name that stands at `event` in the fields, or none is named; else a problem.
bool names_event(Fields& fields, const Scene& scene, const std::string& event);
std::string events_text(const Scene& scene);

// --- the page: page_keys.cpp
KeyText told_acknowledge();
void read_acknowledge(Fields& fields, Scene& scene);
std::string acknowledge_text(const Scene& scene);
KeyText told_draw();
void read_draw(Fields& fields, Scene& scene);
std::string draw_text(const Scene& scene);
KeyText told_fit();
void read_fit(Fields& camera, Scene& scene);
std::string fit_text(const Scene& scene);
KeyText told_plot();
void read_plot(Fields& fields, Scene& scene);
std::string plot_text(const Scene& scene);
// The layout must go with the number of panels that the scene already holds.
KeyText told_layout();
void read_layout(Fields& fields, Scene& scene);
std::string layout_text(const Scene& scene);
KeyText told_compare();

// --- the house style: style_keys.cpp
KeyText told_style();
void read_style(Fields& fields, Scene& scene);
std::string style_text(const Scene& scene);

// --- the film: slow_motion_keys.cpp
KeyText told_slow_motion();
void read_slow_motion(Fields& fields, Scene& scene);
// What is said of an entry of the file that Fields::cuts_short leaves nothing of.
std::string left_out_beyond(const std::string& key, const Scene& scene);
std::string slow_motion_text(const Scene& scene);

// --- what is pointed at: annotate_keys.cpp
KeyText told_annotate();
void read_annotate(Fields& fields, Scene& scene);
std::string annotate_text(const Scene& scene);

// What two keys say together: rules.cpp. After all keys were read.
void check_together(Fields& fields, Scene& scene);

// Text of a value in one line of YAML. Emitters break long lines.
std::string in_one_line(const YAML::Emitter& out);
template <class Emit>
std::string flow_text(Emit emit) {
  YAML::Emitter out;
  out << YAML::Flow;
  emit(out);
  return in_one_line(out);
}
template <class Values, class Text>
void emit_list(YAML::Emitter& out, const Values& values, Text text) {
  out << YAML::Flow << YAML::BeginSeq;
  for (const auto& value : values) out << text(value);
  out << YAML::EndSeq;
}
inline void emit_numbers(YAML::Emitter& out, const std::vector<double>& values) {
  emit_list(out, values, format_shortest);
}
// The text of an entry behind single torques of a list: how many others there are is not known before the model is.
inline constexpr const char* kOtherTorques = "\x01";
std::string word_text(const std::string& word);    // quoted where YAML wants it
std::string quoted_text(const std::string& words);  // always

}  // namespace chainreel
