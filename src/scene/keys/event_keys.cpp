// The key events: what a run looks out for.
#include <algorithm>

#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

// One entry of the list; `key` is its dotted path.
EventEntry read_event(Fields& fields, const YAML::Node& node, const std::string& key) {
  Fields inner(fields.document(), node, key, fields.problems());
  EventEntry entry;
  inner.read("when", entry.when);
  entry.place = entry.when.empty() ? fields.place_of(node, key) : inner.place_of(inner.find("when"), "when");
  if (entry.when.empty())
    fields.problems().add("'" + key + "' needs `when`, an expression: {when: \"y_H < 0.5\", kind: stop}",
                          entry.place);
  inner.read("kind", entry.kind);
  inner.read("name", entry.name);
  inner.read("direction", entry.direction);
  inner.finish();
  return entry;
}

}  // namespace

KeyText told_events() {
  return told_list("events",
                   told_record("",
                               {told("when", KeyForm::expression,
                                     "`y_H < 0.5`: when this becomes true; `q1 - pi/2`: when it becomes zero")
                                    .required(),
                                told_word("kind", names_of(EventKind{}), "what comes of it; mark where it is left out"),
                                told("name", KeyForm::text, "by which films and `slow_motion` call it; else `when` itself"),
                                told_word("direction", names_of(Crossing{}),
                                          "of an expression that is no comparison; either where it is left out")},
                               "an event"),
                   "what the run looks out for");
}

std::string events_text(const Scene& scene) {
  if (scene.events.empty()) return "";
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const EventEntry& event : scene.events) {
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

bool names_event(Fields& fields, const Scene& scene, const std::string& event) {
  if (event.empty()) return true;
  std::vector<std::string> names;
  for (const EventEntry& one : scene.events) names.push_back(one.title());
  if (std::find(names.begin(), names.end(), event) != names.end()) return true;
  fields.problem_at("event", "'" + fields.path("event") + "' names '" + event + "', but " +
                                 (names.empty() ? "the scene has no 'events'" : "no entry of 'events' has that name:") +
                                 did_you_mean(event, names) +
                                 (names.empty() ? "" : " There are " + quoted_list(names) + "."));
  return false;
}

void read_events(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("events");
  if (!node.IsDefined()) return;
  const auto refuse = [&](const YAML::Node& at, const std::string& key) {
    fields.problems().add(
        "'" + key + "' must be " + (key == "events" ? "a list of" : "one of") +
            " entries like {when: \"y_H < 0.5\", kind: mark, name: low}; kinds are " +
            joined(words_of(names_of(EventKind{}))),
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
