// The key torque: numbers, expressions and controls.
#include <algorithm>
#include <cmath>

#include "core/format.hpp"
#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

// One number, or a list with one a freedom.
std::vector<double> read_gains(Fields& fields, const std::string& key, const std::string& unit) {
  const YAML::Node node = fields.find(key);
  if (!node.IsDefined()) return {0};
  std::vector<double> gains(1);
  fields.measure_in(unit);
  if (node.IsSequence())
    fields.read(key, gains);
  else
    fields.read(key, gains.front());
  fields.measure_in("");
  return gains;
}

// One expression, or a list with one a freedom.
std::vector<Entry> read_entries(Fields& fields, const std::string& key, const std::string& what = "an expression in t") {
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
        "'" + fields.path(key) + "' must be " + what + ", or a list with one a freedom",
        fields.place_of(node, key));
  return entries;
}

// What a table stands for beyond its rows; `has_table`: there is one.
std::optional<Outside> read_outside(Fields& fields, bool has_table, const std::string& tables) {
  std::optional<Outside> outside;
  if (!has_table && fields.has("outside"))
    fields.problem_at("outside", "'" + fields.path("outside") + "' says what a table is taken for beyond its rows, and there is no " +
                                     tables + ": leave it out");
  fields.read("outside", outside);
  return outside;
}

// `kp`, `kd`: what these gains are told in.
std::optional<Feedback> read_feedback(Fields& fields, const std::string& key, const std::string& kp, const std::string& kd) {
  const YAML::Node node = fields.find(key);
  if (!node.IsDefined()) return std::nullopt;
  if (!node.IsMap()) {
    fields.problems().add("'" + fields.path(key) + "' must hold kp, kd and q: {kp: 100, kd: 10, q: [0, 1]}",
                          fields.place_of(node, key));
    return std::nullopt;
  }
  Fields inner(fields.document(), node, fields.path(key), fields.problems());
  Feedback feedback;
  feedback.kp = read_gains(inner, "kp", kp);
  feedback.kd = read_gains(inner, "kd", kd);
  feedback.q = read_entries(inner, "q");
  feedback.qd = read_entries(inner, "qd");
  feedback.qdd = read_entries(inner, "qdd");
  for (const char* one : {"kp", "kd", "q", "qd", "qdd"})
    if (const YAML::Node list = inner.find(one); list.IsSequence() && list.size() == 1) feedback.lists_of_one.push_back(one);
  inner.read_path("trajectory", feedback.trajectory);
  if (!feedback.trajectory.empty() && !(feedback.q.empty() && feedback.qd.empty() && feedback.qdd.empty()))
    fields.problems().add(
        "'" + fields.path(key) + "' takes its motion from trajectory or from q, qd, qdd, not from both",
        fields.place_of(node, key));
  feedback.outside = read_outside(inner, !feedback.trajectory.empty(), "trajectory");
  inner.finish();
  return feedback;
}

std::optional<TaskFeedback> read_task(Fields& fields) {
  const YAML::Node node = fields.find("task");
  if (!node.IsDefined()) return std::nullopt;
  std::optional<Fields> inner = fields.section("task", "a place to go to and gains: {kp: 100, kd: 20, x: [\"0.5*cos(t)\", 0.5]}");
  if (!inner) return std::nullopt;
  TaskFeedback task;
  task.place = fields.place_of(node, "task");
  inner->read("frame", task.frame);
  task.kp = read_gains(*inner, "kp", "N/m");
  task.kd = read_gains(*inner, "kd", "N s/m");
  task.x = read_entries(*inner, "x");
  task.xd = read_entries(*inner, "xd");
  for (const char* one : {"kp", "kd"})
    if (const YAML::Node list = inner->find(one); list.IsSequence() && list.size() == 1) task.lists_of_one.push_back(one);
  inner->finish();
  return task;
}

Control read_control(Fields& fields, const YAML::Node& node, const std::string& key) {
  Fields inner(fields.document(), node, fields.path(key), fields.problems());
  Control control;
  control.place = fields.place_of(node, key);
  inner.read_path("csv", control.csv);
  control.columns = read_columns(inner, {"tau"});
  if (control.csv.empty() && inner.has("columns"))
    inner.problem_at("columns", "'" + inner.path("columns") + "' names the columns of `csv`, and there is none: leave it out");
  inner.read_path("inverse_of", control.inverse_of);
  control.outside = read_outside(inner, !control.csv.empty() || !control.inverse_of.empty(), "csv or inverse_of");
  control.pd = read_feedback(inner, "pd", "N m/rad or N/m", "N m s/rad or N s/m");
  control.computed_torque = read_feedback(inner, "computed_torque", "1/s^2", "1/s");
  control.task = read_task(inner);
  inner.read("gravity_compensation", control.gravity_compensation);
  control.plus = read_entries(inner, "plus", "an expression");
  control.plus_is_list_of_one = control.plus.size() == 1 && inner.find("plus").IsSequence();
  for (Entry& entry : control.plus) entry.text = in_one_line(entry.text);
  // Films of such a run remember what it was called.
  if (const YAML::Node function = node["function"]; function.IsDefined() && inner.has("function"))
    fields.problems().add("the torque was " + (function.IsScalar() ? function.Scalar() : std::string("a function")) +
                              ", which no file holds: run the program that has it, or write an expression or a table (csv)",
                          fields.place_of(function, key));
  inner.finish();
  return control;
}

// One for all stands without brackets.
void emit_entries(YAML::Emitter& out, const char* name, const std::vector<Entry>& list) {
  if (list.empty()) return;
  out << YAML::Key << name << YAML::Value;
  if (list.size() == 1)
    out << list.front().text;
  else
    emit_list(out, list, [](const Entry& entry) { return entry.text; });
}

void emit_gains(YAML::Emitter& out, const char* name, const std::vector<double>& list) {
  std::vector<Entry> entries;
  for (const double gain : list) entries.push_back({format_shortest(gain), {}});
  emit_entries(out, name, entries);
}

void emit_feedback(YAML::Emitter& out, const std::string& key, const std::optional<Feedback>& feedback) {
  if (!feedback) return;
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginMap;
  emit_gains(out, "kp", feedback->kp);
  emit_gains(out, "kd", feedback->kd);
  emit_entries(out, "q", feedback->q);
  emit_entries(out, "qd", feedback->qd);
  emit_entries(out, "qdd", feedback->qdd);
  if (!feedback->trajectory.empty()) out << YAML::Key << "trajectory" << YAML::Value << feedback->trajectory;
  if (feedback->outside) out << YAML::Key << "outside" << YAML::Value << to_string(*feedback->outside);
  out << YAML::EndMap;
}

void emit_task(YAML::Emitter& out, const std::optional<TaskFeedback>& task) {
  if (!task) return;
  out << YAML::Key << "task" << YAML::Value << YAML::Flow << YAML::BeginMap;
  if (!task->frame.empty()) out << YAML::Key << "frame" << YAML::Value << task->frame;
  emit_gains(out, "kp", task->kp);
  emit_gains(out, "kd", task->kd);
  emit_entries(out, "x", task->x);
  emit_entries(out, "xd", task->xd);
  out << YAML::EndMap;
}

void emit_control(YAML::Emitter& out, const Control& control) {
  out << YAML::Flow << YAML::BeginMap;
  if (!control.csv.empty()) out << YAML::Key << "csv" << YAML::Value << control.csv;
  emit_columns(out, control.columns, "tau");
  if (!control.inverse_of.empty()) out << YAML::Key << "inverse_of" << YAML::Value << control.inverse_of;
  if (control.outside) out << YAML::Key << "outside" << YAML::Value << to_string(*control.outside);
  emit_feedback(out, "pd", control.pd);
  emit_feedback(out, "computed_torque", control.computed_torque);
  emit_task(out, control.task);
  if (control.gravity_compensation) out << YAML::Key << "gravity_compensation" << YAML::Value << true;
  emit_entries(out, "plus", control.plus);
  if (control.function) out << YAML::Key << "function" << YAML::Value << control.function->words;
  out << YAML::EndMap;
}

KeyText told_gain(const char* key, const char* each, const char* what) {
  return told_either(key, {told("", KeyForm::number, "for all"), told_list("", told("", KeyForm::number, ""), each)}, what);
}

KeyText told_feedback(const char* name, const char* help) {
  const auto course = [](const char* key, const char* what) {
    return told_either(key, {told("", KeyForm::expression, ""), told_list("", told("", KeyForm::expression, ""), "one a freedom")},
                       what);
  };
  return told_record(name,
                     {told_gain("kp", "one a freedom", "gain of places; 0 where it is left out"), told_gain("kd", "one a freedom", "gain of rates"),
                      course("q", "the motion to follow, expressions in t; its derivatives are taken exactly"),
                      course("qd", "its rates, where they are not the derivatives"),
                      course("qdd", "its accelerations, likewise"),
                      told("trajectory", KeyForm::path, "a table with t,q1.. and maybe qd1.., qdd1.. in the place of q"),
                      told_word("outside", names_of(Outside{}), "what the table is taken for beyond its rows")},
                     help);
}

KeyText told_task() {
  return told_record("task",
                     {told("frame", KeyForm::text, "whose origin is pulled; left out: the end effector"),
                      told_gain("kp", "one an axis", "of the spring, N/m"), told_gain("kd", "one an axis", "of the damper, N s/m"),
                      told_list("x", told("", KeyForm::expression, ""), "the place to go to, m: expressions in t, two along the axes of the plane of motion, or x y z"),
                      told_list("xd", told("", KeyForm::expression, ""), "its velocity, where it is not the derivative")},
                     "J^T (kp (x_ref - x) + kd (xd_ref - xd)): a spring and a damper that pull a frame to a place that moves; of the whole chain");
}

KeyText told_control(const char* name) {
  return told_record(name,
                     {told("csv", KeyForm::path, "a table with t,tau1..; linear between its rows, where steps end"),
                      told_columns({"tau"}),
                      told("inverse_of", KeyForm::path, "a table with t,q1..: the torques that this motion takes"),
                      told_word("outside", names_of(Outside{}), "what these tables are taken for beyond their rows"),
                      told_feedback("pd", "kp (q_ref - q) + kd (qd_ref - qd)"),
                      told_feedback("computed_torque", "M (qdd_ref + kd (qd_ref - qd) + kp (q_ref - q)) + nle + tau_f; as the entry of one joint "
                                                     "with one expression it asks for no acceleration of the others"),
                      told_task(),
                      told("gravity_compensation", KeyForm::truth, "tau_g(q)"),
                      told_either("plus", {told("", KeyForm::expression, "of a joint, or for all alike"),
                                           told_list("", told("", KeyForm::expression, ""), "one a freedom")},
                                  "what is added, of the names that torques read")},
                     "what drives the whole chain, or one joint; its parts add up");
}

}  // namespace

KeyText told_torque() {
  return told_either("torque",
                     {told_control(""), told_list("", told_either("", {told("", KeyForm::expression, ""), told_control("")}, ""),
                                                  "a number, an expression or a control a joint")},
                     "what drives the joints, N m or N");
}

namespace {

// Single ones by their indices from 1, {2: 5}, as `--set torque.2=5` makes where there is no list: joints that are left out have none.
// Behind them stands kOtherTorques.
bool read_single_torques(Fields& fields, const YAML::Node& node, Scene& scene) {
  constexpr double kMostEntries = 1000;  // more than chains have
  const auto index_of = [&](const YAML::Node& key) {
    const std::optional<double> at = parse_number(key.Scalar());
    return at && *at >= 1 && *at <= kMostEntries && *at == std::floor(*at) ? std::size_t(*at) : 0;
  };
  if (!node.IsMap() || node.size() == 0 || std::any_of(node.begin(), node.end(), [&](const auto& pair) { return index_of(pair.first) == 0; }))
    return false;
  for (const auto& pair : node) {
    const std::size_t at = index_of(pair.first);
    const std::string key = "torque." + pair.first.Scalar();
    scene.torque.resize(std::max(scene.torque.size(), at));
    if (pair.second.IsScalar())
      scene.torque[at - 1] = {in_one_line(pair.second.Scalar()), fields.place_of(pair.second, key), {}};
    else
      fields.problems().add("'" + key + "' must be a number or an expression", fields.place_of(pair.second, key));
  }
  scene.torque.push_back({kOtherTorques, fields.place_of(node, "torque"), {}});
  return true;
}

}  // namespace

void read_torque(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("torque");
  if (!node.IsDefined() || node.IsNull()) return;
  if (read_single_torques(fields, node, scene)) return;
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
      scene.torque.push_back({in_one_line(node[i].Scalar()), place, {}});
    else if (node[i].IsMap())
      scene.torque.push_back({"control", place, read_control(fields, node[i], key)});
    else
      fields.problems().add(
          "'torque' entry " + std::to_string(i + 1) + " must be a number, an expression or a control", place);
  }
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

}  // namespace chainreel
