#include "scene/read_constraints.hpp"

#include <algorithm>

#include "scene/quantity.hpp"

namespace chainreel {
namespace {

const std::vector<std::string> kKinds{"line",  "plane", "point", "distance",
                                      "close", "curve", "joint", "linear"};

// Keys without which a constraint says nothing.
class Needs {
 public:
  Needs(Fields& fields, Place place, std::string example)
      : fields_(fields), place_(std::move(place)), example_(std::move(example)) {}

  template <class T>
  void read(const std::string& key, T& value) {
    if (fields_.has(key))
      fields_.read(key, value);
    else
      fields_.problems().add("'" + fields_.path(key) + "' is missing: write " + example_, place_);
  }

 private:
  Fields& fields_;
  Place place_;
  std::string example_;
};

// A frame or a place of the world stands at the other end.
void read_other_end(Fields& fields, ConstraintEntry& entry, const std::string& example) {
  fields.read("b", entry.b);
  fields.read("at", entry.at);
  if (entry.b.empty() == entry.at.empty())
    fields.problems().add(
        "'" + fields.path("b") + "' names a frame, or 'at' a place, one of the two: write " + example,
        entry.place);
}

void read_closure(Fields& fields, ConstraintEntry& entry) {
  bool weld = false;
  fields.read("weld", weld);
  const YAML::Node axis = fields.find("axis");
  bool about_axis = false;
  if (axis.IsDefined() && axis.IsSequence()) {
    fields.read("axis", entry.direction);
    about_axis = true;
  } else if (axis.IsDefined()) {
    fields.read("axis", about_axis);
  }
  if (weld && about_axis)
    fields.problem_at("weld", "'weld' leaves no axis to turn about: keep 'weld' or 'axis', not both");
  if ((weld || about_axis) && entry.b.empty() && !entry.at.empty())
    fields.problem_at(weld ? "weld" : "axis",
               "a place of the world has no axes: close on a frame of the base, with 'b'");
  entry.closure = weld ? "weld" : about_axis ? "axis" : "point";
}

void read_coefficients(Fields& fields, ConstraintEntry& entry) {
  const YAML::Node node = fields.find("coefficients");
  if (!node.IsDefined() || !node.IsMap() || node.size() == 0) {
    fields.problems().add(
        "'" + fields.path("coefficients") +
            "' must hold joints and numbers: {coefficients: {joint1: 1, joint2: -2}, value: 0}",
        entry.place);
    return;
  }
  Fields inner(fields.document(), node, fields.path("coefficients"), fields.problems());
  for (const auto& pair : node) {
    double coefficient = 0;
    inner.read(pair.first.Scalar(), coefficient);
    entry.coefficients.emplace_back(pair.first.Scalar(), coefficient);
  }
}

void read_kind(Fields& fields, ConstraintEntry& entry) {
  const std::string& kind = entry.kind;
  if (kind == "line") {
    Needs needs(fields, entry.place, "{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}");
    needs.read("frame", entry.a);
    needs.read("point", entry.at);
    needs.read("direction", entry.direction);
  } else if (kind == "plane") {
    Needs needs(fields, entry.place, "{plane: {frame: gripper, point: [0, 0, 0.5], normal: [0, 0, 1]}}");
    needs.read("frame", entry.a);
    needs.read("point", entry.at);
    needs.read("normal", entry.direction);
  } else if (kind == "point") {
    Needs needs(fields, entry.place, "{point: {frame: gripper, at: [1, 0.5]}}");
    needs.read("frame", entry.a);
    needs.read("at", entry.at);
  } else if (kind == "distance") {
    const std::string example =
        "{distance: {a: gripper, b: base, length: 1.2}}, or `at: [x, y]` in the place of b";
    Needs needs(fields, entry.place, example);
    needs.read("a", entry.a);
    read_other_end(fields, entry, example);
    needs.read("length", entry.value);
  } else if (kind == "close") {
    const std::string example = "{close: {a: tip1, b: tip2}}, or `at: [x, y]` in the place of b";
    Needs(fields, entry.place, example).read("a", entry.a);
    read_other_end(fields, entry, example);
    read_closure(fields, entry);
  } else if (kind == "curve") {
    Needs needs(fields, entry.place,
                "{curve: {frame: gripper, x: \"1 + 0.5 * cos(s)\", y: \"0.5 * sin(s)\"}}");
    needs.read("frame", entry.a);
    needs.read("x", entry.x);
    needs.read("y", entry.y);
    fields.read("s", entry.s);
  } else if (kind == "joint") {
    Needs needs(fields, entry.place, "{joint: {name: joint2, value: 90deg}}");
    needs.read("name", entry.a);
    needs.read("value", entry.value);
  } else {
    read_coefficients(fields, entry);
    entry.value = 0;
    fields.read("value", entry.value);
  }
}

void read_entry(Fields& fields, const YAML::Node& node, const std::string& key, Scene& scene) {
  const Place place = fields.place_of(node, key);
  const bool one_key = node.IsMap() && node.size() == 1 && node.begin()->second.IsMap();
  const std::string kind = one_key ? node.begin()->first.Scalar() : "";
  if (!one_key || std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) {
    std::string kinds;
    for (const std::string& one : kKinds) kinds += (kinds.empty() ? "" : ", ") + one;
    const std::string what =
        one_key ? "unknown kind '" + kind + "' of a constraint:" + did_you_mean(kind, kKinds) +
                      " There are " + kinds
                : "a constraint is one key with what belongs to it, like {point: {frame: "
                  "gripper, at: [1, 0.5]}}; the keys are " +
                      kinds;
    fields.problems().add(what, place);
    return;
  }
  ConstraintEntry entry;
  entry.kind = kind;
  entry.place = place;
  Fields inner(fields.document(), node.begin()->second, fields.path(key) + "." + kind, fields.problems());
  read_kind(inner, entry);
  inner.finish();
  scene.constraints.push_back(std::move(entry));
}

void read_contact(Fields& fields, const YAML::Node& node, const std::string& key, Scene& scene) {
  const Place place = fields.place_of(node, key);
  if (!node.IsMap()) {
    fields.problems().add(
        "'contact_force' must hold a constraint's number and a force in N: {constraint: 1, "
        "force: [0, -5]}, or a list of such",
        place);
    return;
  }
  Fields inner(fields.document(), node, fields.path(key), fields.problems());
  ContactEntry entry;
  entry.place = place;
  inner.read("constraint", entry.constraint);
  Needs(inner, place, "{constraint: 1, force: [0, -5]}").read("force", entry.force);
  inner.finish();
  const int count = int(scene.constraints.size());
  if (entry.constraint < 1 || entry.constraint > count)
    fields.problems().add("'contact_force' presses constraint " + std::to_string(entry.constraint) +
                              ", but the scene has " +
                              (count == 0 ? "none" : std::to_string(count) + ", counted from 1"),
                          place);
  for (const ContactEntry& other : scene.contact_force)
    if (other.constraint == entry.constraint)
      fields.problems().add("'contact_force' presses constraint " + std::to_string(entry.constraint) +
                                " twice: add the two forces up",
                            place);
  scene.contact_force.push_back(std::move(entry));
}

}  // namespace

void read_constraints(Fields& fields, Scene& scene) {
  const YAML::Node list = fields.find("constraints");
  if (list.IsDefined() && !list.IsSequence())
    fields.problem_at(
        "constraints",
        "'constraints' must be a list: [{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}]");
  if (list.IsSequence())
    for (std::size_t i = 0; i < list.size(); ++i)
      read_entry(fields, list[i], "constraints." + std::to_string(i + 1), scene);

  fields.read("stabilize", scene.stabilize);
  try {
    stabilization_of(scene.stabilize);
  } catch (const Error& error) {
    fields.problem_at("stabilize", error.what());
  }
  const YAML::Node baumgarte = fields.find("baumgarte");
  if (baumgarte.IsDefined() && !baumgarte.IsMap()) {
    fields.problem_at("baumgarte", "'baumgarte' must hold its gain in 1/s: {gain: 10}");
  } else if (baumgarte.IsDefined()) {
    Fields inner(fields.document(), baumgarte, fields.path("baumgarte"), fields.problems());
    inner.read("gain", scene.baumgarte_gain);
    if (!(scene.baumgarte_gain > 0))
      inner.problem_at("gain", "'baumgarte.gain' must be above 0 1/s; some 10 is good");
    inner.finish();
    if (scene.stabilize != "baumgarte")
      fields.problem_at("baumgarte",
                 "'baumgarte' means nothing with stabilize: " + scene.stabilize +
                     ": write `stabilize: baumgarte`, or leave it out");
  }
  const YAML::Node contact = fields.find("contact_force");
  if (!contact.IsDefined()) return;
  if (!contact.IsSequence()) return read_contact(fields, contact, "contact_force", scene);
  for (std::size_t i = 0; i < contact.size(); ++i)
    read_contact(fields, contact[i], "contact_force." + std::to_string(i + 1), scene);
}

}  // namespace chainreel
