// The keys constraints and contact_force. A kind of constraint is a row of kinds(): its keys in the order in which they
// are read and written.
#include <algorithm>
#include <variant>

#include "scene/own_keys.hpp"

namespace chainreel {
namespace {

// Keys of a constraint that are no plain members of the entry.
struct ByHand {
  void (*read)(Fields& fields, ConstraintEntry& entry);
  void (*write)(YAML::Emitter& out, const ConstraintEntry& entry);
  std::vector<KeyText> (*tell)();
};

struct Member {
  using Value = std::variant<std::string ConstraintEntry::*, std::vector<double> ConstraintEntry::*,
                             double ConstraintEntry::*, ByHand>;
  enum class Need {
    required,
    optional,
    either,        // of the keys of this need one must be there
  };
  const char* key;  // "": by hand
  Value value;
  const char* help = "";
  const char* unit = "";
  Need need = Need::required;
  bool is_expression = false;
};

struct Kind {
  Name name;
  const char* example;
  std::vector<Member> members;
};

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
  entry.closure = weld ? Closure::weld : about_axis ? Closure::axis : Closure::point;
}

void write_closure(YAML::Emitter& out, const ConstraintEntry& entry) {
  if (entry.closure == Closure::weld) out << YAML::Key << "weld" << YAML::Value << true;
  if (entry.closure != Closure::axis) return;
  out << YAML::Key << "axis" << YAML::Value;
  if (entry.direction.empty())
    out << true;
  else
    emit_numbers(out, entry.direction);
}

std::vector<KeyText> tell_closure() {
  return {told_either("axis",
                      {told("", KeyForm::truth, ""), told_list("", told("", KeyForm::number, ""), "")},
                      "they turn against each other about one axis alone: true, the frames' z, or its direction"),
          told("weld", KeyForm::truth, "they do not turn against each other")};
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

void write_coefficients(YAML::Emitter& out, const ConstraintEntry& entry) {
  out << YAML::Key << "coefficients" << YAML::Value << YAML::Flow << YAML::BeginMap;
  for (const auto& [name, coefficient] : entry.coefficients)
    out << YAML::Key << name << YAML::Value << format_shortest(coefficient);
  out << YAML::EndMap;
}

std::vector<KeyText> tell_coefficients() {
  return {told_mapping("coefficients", told("", KeyForm::number, ""), "joints and their factors").required()};
}

const std::vector<Kind>& kinds() {
  using Entry = ConstraintEntry;
  using Need = Member::Need;
  static const Member frame{"frame", &Entry::a, "whose origin it is"};
  static const Member point{"point", &Entry::at, "somewhere on it", "m"};
  static const Member a{"a", &Entry::a, "a frame"};
  static const Member b{"b", &Entry::b, "the other frame", "", Need::either};
  static const Member place{"at", &Entry::at, "in its place: a place of the world", "m", Need::either};
  static const std::vector<Kind> rows{
      {{"line", "a frame's origin stays on a line"},
       "{line: {frame: gripper, point: [0, 0.5], direction: [1, 0]}}",
       {frame, point, {"direction", &Entry::direction, "along the line, of any length"}}},
      {{"plane", "a frame's origin stays on a plane"},
       "{plane: {frame: gripper, point: [0, 0.5], normal: [0, 1]}}",
       {frame, point, {"normal", &Entry::direction, "at right angles to the plane, of any length"}}},
      {{"point", "a frame's origin stays at a place"},
       "{point: {frame: gripper, at: [1, 0.5]}}",
       {frame, {"at", &Entry::at, "the place", "m"}}},
      {{"distance", "a rod without mass between two frames, or from a frame to a place of the world"},
       "{distance: {a: gripper, b: base, length: 1.2}}",
       {a, b, place, {"length", &Entry::value, "of the rod", "m"}}},
      {{"close", "two frames' origins coincide: a joint that closes a loop"},
       "{close: {a: rocker_end, b: ground_pin}}",
       {a, b, place, {"", ByHand{read_closure, write_closure, tell_closure}}}},
      {{"curve", "a frame's origin stays on a curve in the plane of motion"},
       "{curve: {frame: gripper, x: \"1 + 0.5 * cos(s)\", y: \"0.5 * sin(s)\"}}",
       {frame,
        {"x", &Entry::x, "an expression in s", "m", Need::required, true},
        {"y", &Entry::y, "an expression in s", "m", Need::required, true},
        {"s", &Entry::s, "where along the curve the frame is sought first; 0 where it is left out", "",
         Need::optional}}},
      {{"joint", "one coordinate keeps a value"},
       "{joint: {name: joint2, value: 90deg}}",
       {{"name", &Entry::a, "of the joint"}, {"value", &Entry::value, "rad or m"}}},
      {{"linear", "a sum of coordinates keeps a value: gears, belts"},
       "{linear: {coefficients: {joint1: 1, joint2: -2}, value: 0}}",
       {{"", ByHand{read_coefficients, write_coefficients, tell_coefficients}},
        {"value", &Entry::value, "of the sum; 0 where it is left out", "", Need::optional}}}};
  return rows;
}

void read_member(Fields& fields, ConstraintEntry& entry, const Member& member, const std::string& example) {
  if (const auto* hand = std::get_if<ByHand>(&member.value)) return hand->read(fields, entry);
  if (member.need == Member::Need::required && !fields.has(member.key))
    return fields.problems().add("'" + fields.path(member.key) + "' is missing: write " + example, entry.place);
  if (const auto* text = std::get_if<0>(&member.value)) fields.read(member.key, entry.**text);
  if (const auto* numbers = std::get_if<1>(&member.value)) fields.read(member.key, entry.**numbers);
  if (const auto* number = std::get_if<2>(&member.value)) fields.read(member.key, entry.**number);
}

void read_members(Fields& fields, ConstraintEntry& entry, const Kind& kind) {
  std::vector<std::string> either;
  for (const Member& member : kind.members) {
    read_member(fields, entry, member, kind.example);
    if (member.need == Member::Need::either) either.emplace_back(member.key);
  }
  const auto given = std::count_if(either.begin(), either.end(), [&](const std::string& key) { return fields.has(key); });
  if (!either.empty() && given != 1)
    fields.problems().add("'" + fields.path("b") + "' names a frame, or 'at' a place, one of the two: write " +
                              kind.example + ", or `at: [x, y]` in the place of b",
                          entry.place);
}

void write_member(YAML::Emitter& out, const ConstraintEntry& entry, const Member& member) {
  if (const auto* hand = std::get_if<ByHand>(&member.value)) return hand->write(out, entry);
  const auto key = [&]() -> YAML::Emitter& { return out << YAML::Key << member.key << YAML::Value; };
  if (const auto* text = std::get_if<0>(&member.value); text && !(entry.**text).empty()) {
    if (member.is_expression)
      key() << YAML::DoubleQuoted << entry.**text;
    else
      key() << entry.**text;
  }
  if (const auto* numbers = std::get_if<1>(&member.value); numbers && !(entry.**numbers).empty())
    emit_numbers(key(), entry.**numbers);
  if (const auto* number = std::get_if<2>(&member.value)) key() << format_shortest(entry.**number);
}

KeyText told_kind(const Kind& kind) {
  std::vector<KeyText> parts;
  for (const Member& member : kind.members) {
    if (const auto* hand = std::get_if<ByHand>(&member.value)) {
      for (KeyText& part : hand->tell()) parts.push_back(std::move(part));
      continue;
    }
    KeyText part = member.value.index() == 1
                       ? told_list(member.key, told("", KeyForm::number, ""), member.help)
                       : told(member.key, member.value.index() == 2 ? KeyForm::number
                                          : member.is_expression    ? KeyForm::expression
                                                                    : KeyForm::text,
                              member.help);
    part.unit = member.unit;
    part.is_required = member.need == Member::Need::required;
    parts.push_back(std::move(part));
  }
  KeyText text = told_record(kind.name.name, std::move(parts), kind.name.meaning);
  text.example = kind.example;
  return text;
}

void read_constraint(Fields& fields, const YAML::Node& node, const std::string& key, Scene& scene) {
  const Place place = fields.place_of(node, key);
  const bool one_key = node.IsMap() && node.size() == 1 && node.begin()->second.IsMap();
  const std::string kind = one_key ? node.begin()->first.Scalar() : "";
  const std::optional<ConstraintKind> known = value_named<ConstraintKind>(kind);
  if (!known) {
    const std::vector<std::string> names = words_of(names_of(ConstraintKind{}));
    fields.problems().add(one_key ? "unknown kind '" + kind + "' of a constraint:" + did_you_mean(kind, names) +
                                        " There are " + joined(names)
                                  : "a constraint is one key with what belongs to it, like {point: {frame: "
                                    "gripper, at: [1, 0.5]}}; the keys are " +
                                        joined(names),
                          place);
    return;
  }
  ConstraintEntry entry;
  entry.kind = *known;
  entry.place = place;
  Fields inner(fields.document(), node.begin()->second, fields.path(key) + "." + kind, fields.problems());
  read_members(inner, entry, kinds()[std::size_t(entry.kind)]);
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
  if (!inner.read("force", entry.force) && !inner.has("force"))
    fields.problems().add("'" + inner.path("force") + "' is missing: write {constraint: 1, force: [0, -5]}", place);
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

std::span<const Name> names_of(ConstraintKind) {
  static const std::vector<Name> names = [] {
    std::vector<Name> all;
    for (const Kind& kind : kinds()) all.push_back(kind.name);
    return all;
  }();
  return names;
}

KeyText told_constraints() {
  std::vector<KeyText> alternatives;
  for (const Kind& kind : kinds()) alternatives.push_back(told_record("", {told_kind(kind).required()}, ""));
  return told_list("constraints", told_either("", std::move(alternatives), "a constraint"),
                   "what ties the mechanism beyond its joints");
}

void read_constraints(Fields& fields, Scene& scene) {
  const YAML::Node list = fields.find("constraints");
  if (list.IsDefined() && !list.IsSequence())
    fields.problem_at("constraints", "'constraints' must be a list: [" + std::string(kinds().front().example) + "]");
  if (list.IsSequence())
    for (std::size_t i = 0; i < list.size(); ++i)
      read_constraint(fields, list[i], "constraints." + std::to_string(i + 1), scene);
}

std::string constraints_text(const Scene& scene) {
  if (scene.constraints.empty()) return "";
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::BeginSeq;
    for (const ConstraintEntry& entry : scene.constraints) {
      out << YAML::Flow << YAML::BeginMap << YAML::Key << to_string(entry.kind) << YAML::Value << YAML::Flow
          << YAML::BeginMap;
      for (const Member& member : kinds()[std::size_t(entry.kind)].members) write_member(out, entry, member);
      out << YAML::EndMap << YAML::EndMap;
    }
    out << YAML::EndSeq;
  });
}

KeyText told_contact_force() {
  KeyText one = told_record(
      "", {told("constraint", KeyForm::whole, "its number in the list, from 1; 1 where it is left out").within({1}),
           told_list("force", told("", KeyForm::number, ""), "of the robot on it").in("N").required()},
      "");
  return told_either("contact_force", {one, told_list("", one, "")}, "forces to press with on constraints");
}

void read_contact_force(Fields& fields, Scene& scene) {
  const YAML::Node contact = fields.find("contact_force");
  if (!contact.IsDefined()) return;
  if (!contact.IsSequence()) return read_contact(fields, contact, "contact_force", scene);
  for (std::size_t i = 0; i < contact.size(); ++i)
    read_contact(fields, contact[i], "contact_force." + std::to_string(i + 1), scene);
}

std::string contact_force_text(const Scene& scene) {
  if (scene.contact_force.empty() || scene.constraints.empty()) return "";
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::BeginSeq;
    for (const ContactEntry& entry : scene.contact_force) {
      out << YAML::Flow << YAML::BeginMap << YAML::Key << "constraint" << YAML::Value << entry.constraint;
      emit_numbers(out << YAML::Key << "force" << YAML::Value, entry.force);
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  });
}

}  // namespace chainreel
