#include "scene/read_events.hpp"

#include "expr/expression.hpp"

namespace chainreel {
namespace {

void read_frames(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("frames");
  if (!node.IsDefined()) return;
  const auto complain = [&](const std::string& message, const YAML::Node& at, const std::string& key) {
    fields.problems().add(message, fields.place_of(at, key));
  };
  if (!node.IsMap())
    return complain("'frames' must hold names and links or joints of the model: frames: {H: hip}", node,
                    "frames");
  for (const auto& pair : node) {
    const std::string& name = pair.first.Scalar();
    const std::string key = "frames." + name;
    if (!is_variable_name("x_" + name) || name == "G")
      complain("'" + name + "' cannot name a frame: take letters, digits and _, and not G, the end effector",
               pair.first, key);
    else if (!pair.second.IsScalar())
      complain("'" + key + "' must name a link or a joint of the model", pair.second, key);
    else
      scene.frames[name] = pair.second.Scalar();
  }
}

void read_foot(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("foot");
  if (!node.IsDefined()) return;
  const Place place = fields.place_of(node, "foot");
  if (!node.IsMap()) {
    fields.problems().add(
        "'foot' must hold heel and toe, m along the ground: foot: {heel: -0.06, toe: 0.19, height: 0}",
        place);
    return;
  }
  Fields inner(fields.document(), node, fields.path("foot"), fields.problems());
  Foot foot;
  inner.read("heel", foot.heel);
  inner.read("toe", foot.toe);
  inner.read("height", foot.height);
  inner.finish();
  if (!(foot.heel < foot.toe))
    fields.problems().add(
        "'foot' needs a heel below its toe, m along the ground: foot: {heel: -0.06, toe: 0.19}", place);
  scene.foot = foot;
}

// One entry of the list; `key` is its dotted path.
EventEntry read_event(Fields& fields, const YAML::Node& node, const std::string& key) {
  Fields inner(fields.document(), node, key, fields.problems());
  EventEntry entry;
  const auto named = [&](const std::string& what, auto find, auto& value) {
    std::string name;
    inner.read(what, name);
    if (name.empty()) return;
    try {
      value = find(name);
    } catch (const Error& error) {
      fields.problems().add("'" + key + "." + what + "': " + error.problems().front().message,
                            inner.place_of(inner.find(what), what));
    }
  };
  inner.read("when", entry.when);
  entry.place = entry.when.empty() ? fields.place_of(node, key) : inner.place_of(inner.find("when"), "when");
  if (entry.when.empty())
    fields.problems().add("'" + key + "' needs `when`, an expression: {when: \"y_H < 0.5\", kind: stop}",
                          entry.place);
  named("kind", event_kind_of, entry.kind);
  inner.read("name", entry.name);
  named("direction", crossing_of, entry.direction);
  inner.finish();
  return entry;
}

}  // namespace

void read_events(Fields& fields, Scene& scene) {
  read_frames(fields, scene);
  read_foot(fields, scene);
  const YAML::Node node = fields.find("events");
  if (!node.IsDefined()) return;
  const auto refuse = [&](const YAML::Node& at, const std::string& key) {
    fields.problems().add(
        "'" + key + "' must be " + (key == "events" ? "a list of" : "one of") +
            " entries like {when: \"y_H < 0.5\", kind: mark, name: low}; kinds are mark, stop, fall",
        fields.place_of(at, key));
  };
  if (!node.IsSequence()) return refuse(node, "events");
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string key = "events." + std::to_string(i + 1);
    if (node[i].IsMap())
      scene.events.push_back(read_event(fields, node[i], key));
    else
      refuse(node[i], key);
  }
}

}  // namespace chainreel
