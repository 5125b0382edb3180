// The key push: what pushes the robot from outside.
#include <algorithm>
#include <cmath>
#include <span>

#include "expr/expression.hpp"
#include "scene/keys/own_keys.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

constexpr const char* kLike = "{frame: torso, force: [60, 0, 0], from: 1s, until: 1.1s}";

// Numbers, or expressions of parameters, whose values wait until all keys were read: see find_forces. False where these are none.
bool read_force(Fields& fields, PushEntry& entry) {
  const YAML::Node node = fields.find("force");
  if (!node.IsSequence() || std::any_of(node.begin(), node.end(), [](const YAML::Node& one) { return !one.IsScalar(); })) return fields.read("force", entry.force);
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string& text = node[i].Scalar();
    entry.words.emplace_back();
    entry.force.push_back(0);
    try {
      entry.force.back() = parse_quantity(text, fields.place_of(node[i], "force." + std::to_string(i + 1)), "N");
    } catch (const Error&) {
      if (text.empty()) return fields.problem_at("force", "'" + fields.path("force") + "." + std::to_string(i + 1) + "' is empty: write 0 where there is none"), false;
      entry.words.back() = text;
    }
  }
  return true;
}

PushEntry read_one_push(Fields& fields, const YAML::Node& node, const std::string& key) {
  Fields inner(fields.document(), node, key, fields.problems());
  PushEntry entry;
  entry.place = fields.place_of(node, key);
  inner.read("frame", entry.frame);
  if (inner.has("force") && node["force"].IsMap()) {  // as `--set push.force.1=80` makes where the scene has no such list
    inner.problem_at("force", "'" + inner.path("force") + "' has single numbers, but there is no push whose force they are part of: push: " + kLike);
    return entry;
  }
  const bool is_read = read_force(inner, entry);
  if (is_read && entry.force.size() != 2 && entry.force.size() != 3)
    inner.problem_at("force", "'" + inner.path("force") + "' takes three numbers, N along x, y and z of the world, or of a chain in a plane two along its axes, not " +
                                  std::to_string(entry.force.size()));
  if (!inner.has("force")) fields.problems().add("'" + key + "' needs `force`: " + std::string(kLike), entry.place);
  if (inner.read_seconds("from", entry.from) && !(entry.from >= 0))
    inner.problem_at("from", "'" + inner.path("from") + "' is an instant of the run, 0 s or later");
  if (inner.read_seconds("until", entry.until) && !(entry.until > entry.from))
    inner.problem_at("until", "'" + inner.path("until") + "' must come behind `from`, " + format_shortest(entry.from) + " s");
  inner.finish();
  return entry;
}

}  // namespace

KeyText told_push() {
  const auto record = [](const std::string& what) {
    return told_record("",
                       {told("frame", KeyForm::text, "the link that is pushed at its origin, or the joint before it; the end effector where left out"),
                        told_list("force", told("", KeyForm::expression, ""), "N along x, y and z of the world; of a chain in a plane maybe two, along its axes; numbers, or expressions of `parameters`").required(),
                        told("from", KeyForm::number, "s; 0 where left out").within({.least = 0}),
                        told("until", KeyForm::number, "s; the end of the run where left out").within({.least = 0, .is_open = true})},
                       what);
  };
  return told_either("push", {record("a push"), told_list("", record("a push"), "several, which add up where they act at once")},
                     "forces from outside, each for a while, beside the joints' torques");
}

std::string push_text(const Scene& scene) {
  if (scene.push.empty()) return "";
  return flow_text([&](YAML::Emitter& out) {
    const auto emit = [&](const PushEntry& push) {
      out << YAML::Flow << YAML::BeginMap;
      if (!push.frame.empty()) out << YAML::Key << "frame" << YAML::Value << word_text(push.frame);
      out << YAML::Key << "force" << YAML::Value;
      if (std::ranges::all_of(push.words, &std::string::empty)) {
        emit_numbers(out, push.force);
      } else {
        out << YAML::BeginSeq;
        for (std::size_t i = 0; i < push.force.size(); ++i) out << (push.words[i].empty() ? format_shortest(push.force[i]) : word_text(push.words[i]));
        out << YAML::EndSeq;
      }
      out << YAML::Key << "from" << YAML::Value << format_shortest(push.from);
      if (std::isfinite(push.until)) out << YAML::Key << "until" << YAML::Value << format_shortest(push.until);
      out << YAML::EndMap;
    };
    if (scene.push.size() == 1) return emit(scene.push.front());
    out << YAML::Flow << YAML::BeginSeq;
    for (const PushEntry& push : scene.push) emit(push);
    out << YAML::EndSeq;
  });
}

void find_forces(Fields& fields, Scene& scene) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& [name, value] : scene.parameters) names.push_back(name), values.push_back(value);
  for (std::size_t k = 0; k < scene.push.size(); ++k) {
    PushEntry& push = scene.push[k];
    for (std::size_t i = 0; i < push.words.size(); ++i) {
      if (push.words[i].empty()) continue;
      const std::string key = "push." + (scene.push.size() > 1 ? std::to_string(k + 1) + "." : "") + "force." + std::to_string(i + 1);
      try {
        const Expression force = Expression::parse(push.words[i], names, push.place);
        if (force.is_constant() && has_unit(push.words[i])) parse_quantity(push.words[i], push.place, "N");  // throws of what it is no unit of
        push.force[i] = force.evaluate(std::span<const double>(values));
        if (!std::isfinite(push.force[i])) throw Error(ExitCode::bad_input, "'" + push.words[i] + "' is not a finite number", push.place);
      } catch (const Error& error) {
        fields.problems().add("'" + fields.path(key) + "': " + error.problems().front().message + "; it takes numbers, N, and expressions of `parameters`, which have no unit", push.place);
      }
    }
  }
}

void read_push(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("push");
  if (!node.IsDefined() || node.IsNull()) return;
  if (node.IsMap()) {
    scene.push.push_back(read_one_push(fields, node, fields.path("push")));
    return;
  }
  for (std::size_t i = 0; node.IsSequence() && i < node.size(); ++i) {
    const std::string key = fields.path("push") + "." + std::to_string(i + 1);
    if (node[i].IsMap())
      scene.push.push_back(read_one_push(fields, node[i], key));
    else
      fields.problems().add("'" + key + "' must be a push like " + std::string(kLike), fields.place_of(node[i], key));
  }
  if (!node.IsSequence() || node.size() == 0)
    fields.problem_at("push", "'push' must be a push, or a list of such: push: " + std::string(kLike));
}

}  // namespace chainreel
