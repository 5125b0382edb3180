// The keys constraints and contact_force. What belongs to a kind of constraint stands in its file in scene/keys/constraints.
#include <algorithm>
#include <utility>
#include <variant>

#include "scene/keys/constraints/kind.hpp"

namespace chainreel {
namespace {

std::vector<std::string> names_of_kinds() {
  std::vector<std::string> names;
  for (const ConstraintKind* kind : constraint_kinds()) names.emplace_back(kind->name().name);
  return names;
}

void read_constraint(Fields& fields, const YAML::Node& node, const std::string& key, Scene& scene) {
  const Place place = fields.place_of(node, key);
  const bool one_key = node.IsMap() && node.size() == 1 && node.begin()->second.IsMap();
  const std::string word = one_key ? node.begin()->first.Scalar() : "";
  const std::vector<std::string> names = names_of_kinds();
  const auto known = std::find(names.begin(), names.end(), word);
  if (known == names.end()) {
    fields.problems().add(one_key ? "unknown kind '" + word + "' of a constraint:" + did_you_mean(word, names) +
                                        " There are " + joined(names)
                                  : "a constraint is one key with what belongs to it, like {point: {frame: "
                                    "gripper, at: [1, 0.5]}}; the keys are " +
                                        joined(names),
                          place);
    return;
  }
  Fields inner(fields.document(), node.begin()->second, fields.path(key) + "." + word, fields.problems());
  const ConstraintKind& kind = *constraint_kinds()[std::size_t(known - names.begin())];
  scene.constraints.push_back({kind.read(inner, place), place});
  inner.finish();
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

template <std::size_t... I>
std::vector<const ConstraintKind*> kinds_of(std::index_sequence<I...>) {
  return {&std::variant_alternative_t<I, ConstraintForm>::kind()...};
}

const std::vector<const ConstraintKind*>& constraint_kinds() {
  static const std::vector<const ConstraintKind*> kinds =
      kinds_of(std::make_index_sequence<std::variant_size_v<ConstraintForm>>());
  return kinds;
}

KeyText told_constraints() {
  std::vector<KeyText> alternatives;
  for (const ConstraintKind* kind : constraint_kinds())
    alternatives.push_back(told_record("", {kind->tell().required()}, ""));
  return told_list("constraints", told_either("", std::move(alternatives), "a constraint"),
                   "what ties the mechanism beyond its joints");
}

void read_constraints(Fields& fields, Scene& scene) {
  const YAML::Node list = fields.find("constraints");
  if (list.IsDefined() && !list.IsSequence())
    fields.problem_at("constraints", "'constraints' must be a list: [" + std::string(constraint_kinds().front()->example()) + "]");
  if (list.IsSequence())
    for (std::size_t i = 0; i < list.size(); ++i)
      read_constraint(fields, list[i], "constraints." + std::to_string(i + 1), scene);
}

std::string constraints_text(const Scene& scene) {
  if (scene.constraints.empty()) return "";
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::BeginSeq;
    for (const ConstraintEntry& entry : scene.constraints) {
      const ConstraintKind& kind = kind_of(entry.form);
      out << YAML::Flow << YAML::BeginMap << YAML::Key << kind.name().name << YAML::Value << YAML::Flow << YAML::BeginMap;
      kind.write(out, entry.form);
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
