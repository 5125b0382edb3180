#include "scene/keys/key_rows.hpp"

#include <cmath>

#include "scene/keys/own_keys.hpp"

namespace chainreel {

std::string text_of(const std::string& value) {
  return value.empty() ? "" : word_text(value);
}

std::string text_of(bool value) {
  return value ? "true" : "false";
}

std::string text_of(int value) {
  return std::to_string(value);
}

std::string text_of(double value) {
  return format_shortest(value);
}

std::string text_of(FrameRate value) {
  return value.den == 1 ? std::to_string(value.num) : std::to_string(value.num) + "/" + std::to_string(value.den);
}

std::string text_of(const Accuracy& value) {
  return to_string(value);
}

std::string text_of(const std::vector<double>& value) {
  return flow_text([&](YAML::Emitter& out) { emit_numbers(out, value); });
}

std::string text_of(const Eigen::Vector3d& value) {
  return text_of(std::vector<double>{value.x(), value.y(), value.z()});
}

void check_range(const SceneKey& key, Fields& fields, double value) {
  if (key.range.holds(value)) return;
  const bool is_between = std::isfinite(key.range.most) && !key.range.is_open;
  fields.problem_at(key.leaf(), "'" + fields.path(key.leaf()) + "' must " + (is_between ? "lie " : "be ") +
                                    range_text(key.range, key.unit) + key.hint +
                                    (key.infinity.empty() ? "" : ", or " + key.infinity));
}

bool is_endless(const SceneKey& key, Fields& fields) {
  const YAML::Node node = fields.find(key.leaf());
  return !key.infinity.empty() && node.IsScalar() && node.Scalar() == key.infinity;
}

namespace {

void write_line(const SceneKey& key, const Scene& scene, std::vector<SceneEntry>& entries) {
  if (key.means_something && !key.means_something(scene)) return;
  const std::string text = key.text(key, scene);
  if (!text.empty()) entries.push_back({key.name, text});
}

}  // namespace

SceneKey::Write line_writer() {
  return write_line;
}

KeyRow::KeyRow(KeyText text, void (*read)(Fields&, Scene&), std::string (*write)(const Scene&)) {
  static_cast<KeyText&>(key_) = std::move(text);
  key_.read = [read](const SceneKey&, Fields& fields, Scene& scene) { read(fields, scene); };
  key_.text = [write](const SceneKey&, const Scene& scene) { return write(scene); };
  key_.write = line_writer();
}

KeyRow::KeyRow(KeyText text, void (*read)(Fields&, Scene&), void (*write)(const Scene&, std::vector<SceneEntry>&)) {
  static_cast<KeyText&>(key_) = std::move(text);
  key_.read = [read](const SceneKey&, Fields& fields, Scene& scene) { read(fields, scene); };
  key_.text = [](const SceneKey&, const Scene&) { return std::string(); };
  key_.write = [write](const SceneKey&, const Scene& scene, std::vector<SceneEntry>& entries) { write(scene, entries); };
}

KeyRow KeyRow::section(const char* name, const char* example, const char* help) {
  KeyRow row;
  static_cast<KeyText&>(row.key_) = told_record(name, {}, help);
  row.key_.example = example;
  row.key_.is_section = true;
  row.key_.text = [](const SceneKey&, const Scene&) { return std::string(); };
  row.key_.write = [](const SceneKey&, const Scene&, std::vector<SceneEntry>&) {};
  return row;
}

}  // namespace chainreel
