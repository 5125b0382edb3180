#include "scene/read_control.hpp"

namespace chainreel {
namespace {

// One number, or a list with one a freedom.
std::vector<double> read_gains(Fields& fields, const std::string& key) {
  std::vector<double> gains;
  const YAML::Node node = fields.find(key);
  if (!node.IsDefined()) return {0};
  if (node.IsSequence()) {
    fields.read(key, gains);
    return gains;
  }
  double gain = 0;
  fields.read(key, gain);
  return {gain};
}

// One expression, or a list with one a freedom.
std::vector<Entry> read_entries(Fields& fields, const std::string& key) {
  const YAML::Node node = fields.find(key);
  if (!node.IsDefined()) return {};
  std::vector<Entry> entries;
  if (node.IsScalar()) entries.push_back({node.Scalar(), fields.place_of(node, key)});
  if (node.IsSequence())
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string name = key + "." + std::to_string(i + 1);
      if (node[i].IsScalar()) entries.push_back({node[i].Scalar(), fields.place_of(node[i], name)});
    }
  if (entries.empty() || (node.IsSequence() && entries.size() != node.size()))
    fields.problems().add(
        "'" + fields.path(key) + "' must be an expression in t, or a list with one a freedom",
        fields.place_of(node, key));
  return entries;
}

// Of a table; `has_table`: there is one.
std::optional<Outside> read_outside(Fields& fields, bool has_table, const std::string& tables) {
  const YAML::Node node = fields.find("outside");
  if (!node.IsDefined()) return std::nullopt;
  std::string name;
  fields.read("outside", name);
  try {
    if (!has_table)
      throw Error(ExitCode::bad_input, "'" + fields.path("outside") + "' says what a table is taken for beyond its rows, and there is no " + tables + ": leave it out");
    return outside_of(name);
  } catch (const Error& error) {
    fields.problems().add(error.problems().front().message, fields.place_of(node, "outside"));
  }
  return std::nullopt;
}

std::optional<Feedback> read_feedback(Fields& fields, const std::string& key) {
  const YAML::Node node = fields.find(key);
  if (!node.IsDefined()) return std::nullopt;
  if (!node.IsMap()) {
    fields.problems().add("'" + fields.path(key) + "' must hold kp, kd and q: {kp: 100, kd: 10, q: [0, 1]}",
                          fields.place_of(node, key));
    return std::nullopt;
  }
  Fields inner(fields.document(), node, fields.path(key), fields.problems());
  Feedback feedback;
  feedback.kp = read_gains(inner, "kp");
  feedback.kd = read_gains(inner, "kd");
  feedback.q = read_entries(inner, "q");
  feedback.qd = read_entries(inner, "qd");
  feedback.qdd = read_entries(inner, "qdd");
  inner.read_path("trajectory", feedback.trajectory);
  if (!feedback.trajectory.empty() && !(feedback.q.empty() && feedback.qd.empty() && feedback.qdd.empty()))
    fields.problems().add(
        "'" + fields.path(key) + "' takes its motion from trajectory or from q, qd, qdd, not from both",
        fields.place_of(node, key));
  feedback.outside = read_outside(inner, !feedback.trajectory.empty(), "trajectory");
  inner.finish();
  return feedback;
}

}  // namespace

Control read_control(Fields& fields, const YAML::Node& node, const std::string& key) {
  Fields inner(fields.document(), node, fields.path(key), fields.problems());
  Control control;
  control.place = fields.place_of(node, key);
  inner.read_path("csv", control.csv);
  inner.read_path("inverse_of", control.inverse_of);
  control.outside = read_outside(inner, !control.csv.empty() || !control.inverse_of.empty(), "csv or inverse_of");
  control.pd = read_feedback(inner, "pd");
  control.computed_torque = read_feedback(inner, "computed_torque");
  inner.read("gravity_compensation", control.gravity_compensation);
  inner.finish();
  return control;
}

}  // namespace chainreel
