// The key motion, and names of columns that are not the program's own.
#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

const std::vector<std::string> kOfMotion{"q", "qd", "qdd", "tau"};

}  // namespace

KeyText told_columns(const std::vector<std::string>& quantities) {
  const std::string first = quantities.front();
  KeyText of_freedom = told("", KeyForm::text, "the column of its " + first);
  if (quantities.size() > 1) {
    std::vector<KeyText> parts;
    for (const std::string& quantity : quantities) parts.push_back(told(quantity, KeyForm::text, ""));
    of_freedom = told_either("", {of_freedom, told_record("", std::move(parts), "a column a quantity")}, "");
  }
  return told_mapping("columns", std::move(of_freedom),
                      "names of the table's columns: of `time`, and of each joint, with a unit where the table tells none (\"elbow [deg]\"); "
                      "else t and " + first + "1, " + first + "2, .. or " + first + ".JOINT" + (quantities.size() > 1 ? "; of a joint's several: {" + joined(quantities, ": NAME, ") + ": NAME}" : ""));
}

ColumnNames read_columns(Fields& fields, const std::vector<std::string>& quantities) {
  ColumnNames columns;
  const YAML::Node node = fields.find("columns");
  if (!node.IsDefined() || node.IsNull()) return columns;
  const std::string path = fields.path("columns");
  const auto complain = [&](const YAML::Node& at, const std::string& key) {
    fields.problems().add("'" + key + "' must hold names of columns: columns: {time: stamp, shoulder: " +
                              (quantities.size() > 1 ? "{" + quantities[0] + ": pos_1, " + quantities[1] + ": vel_1}}" : quantities[0] + "_1}"),
                          fields.place_of(at, key));
  };
  if (!node.IsMap()) return complain(node, path), columns;
  for (const auto& pair : node) {
    const std::string& name = pair.first.Scalar();
    const std::string key = path + "." + name;
    if (name == "time" && pair.second.IsScalar()) {
      columns.time = ColumnName(pair.second.Scalar());
    } else if (pair.second.IsScalar()) {
      columns.list.push_back({name, quantities.front(), ColumnName(pair.second.Scalar())});
    } else if (pair.second.IsMap() && quantities.size() > 1) {
      Fields inner(fields.document(), pair.second, key, fields.problems());
      for (const std::string& quantity : quantities)
        if (std::string column; inner.read(quantity, column)) columns.list.push_back({name, quantity, ColumnName(column)});
      inner.finish();
    } else {
      complain(pair.second, key);
    }
  }
  return columns;
}

void emit_columns(YAML::Emitter& out, const ColumnNames& columns, const std::string& usual) {
  if (columns == ColumnNames{}) return;
  out << YAML::Key << "columns" << YAML::Value << YAML::Flow << YAML::BeginMap;
  if (columns.time != ColumnNames{}.time) out << YAML::Key << "time" << YAML::Value << columns.time.text();
  const auto& list = columns.list;
  for (std::size_t i = 0; i < list.size();) {
    std::size_t end = i + 1;
    while (end < list.size() && list[end].freedom == list[i].freedom) ++end;
    out << YAML::Key << list[i].freedom << YAML::Value;
    if (end == i + 1 && list[i].quantity == usual) {
      out << list[i].column.text();
    } else {
      out << YAML::BeginMap;
      for (std::size_t k = i; k < end; ++k) out << YAML::Key << list[k].quantity << YAML::Value << list[k].column.text();
      out << YAML::EndMap;
    }
    i = end;
  }
  out << YAML::EndMap;
}

KeyText told_motion() {
  return told_either("motion",
                     {told("", KeyForm::path, "a table with t,q1.. and maybe qd1.., qdd1.."),
                      told_record("", {told("csv", KeyForm::path, "the table").required(), told_columns(kOfMotion)},
                                  "a table whose columns have other names")},
                     "a recorded motion that is shown as it was, in the place of start, torque and method; its torques are "
                     "those of inverse dynamics");
}

void read_motion(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("motion");
  if (!node.IsDefined() || node.IsNull()) return;
  MotionEntry motion;
  motion.place = fields.place_of(node, "motion");
  if (node.IsMap()) {
    Fields inner(fields.document(), node, "motion", fields.problems());
    inner.read_path("csv", motion.csv);
    motion.columns = read_columns(inner, kOfMotion);
    inner.finish();
  } else {
    fields.read_path("motion", motion.csv);
  }
  if (motion.csv.empty())
    return fields.problem_at("motion", "'motion' must be a table, or name one: motion: log.csv, or motion: {csv: log.csv, columns: {time: stamp}}");
  try {
    motion.table = std::make_shared<const Table>(read_log(motion.csv, motion.columns));
    // As long as it is, unless the scene says how much of it is meant.
    const std::vector<double> t = time_table_of(*motion.table, {}, {}, {motion.columns.time, {}}).t;
    if (t.back() > t.front()) scene.duration = t.back() - t.front();
    scene.motion = std::move(motion);
  } catch (const Error& error) {
    for (const Problem& problem : error.problems()) fields.problems().add(problem.message, problem.place);
  }
}

std::string motion_text(const Scene& scene) {
  if (!scene.motion) return "";
  const MotionEntry& motion = *scene.motion;
  if (motion.columns == ColumnNames{}) return word_text(motion.csv);
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginMap << YAML::Key << "csv" << YAML::Value << motion.csv;
    emit_columns(out, motion.columns, kOfMotion.front());
    out << YAML::EndMap;
  });
}

}  // namespace chainreel
