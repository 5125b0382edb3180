// The key annotate.
#include <algorithm>

#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

constexpr double kLongestPause = 3600;  // s
constexpr const char* kAnnotation = "{at: 1.2s, text: \"heaviest along the arm\", point: gripper, hold: 1s}";

// One entry of the list; false where something is wrong that has been told.
bool read_annotation(Fields& inner, const Scene& scene, AnnotationEntry& entry, bool may_be_beyond) {
  bool good = true;
  const auto problem = [&](const char* key, const std::string& message) {
    good = false;
    inner.problem_at(key, "'" + inner.path(key) + "' " + message);
  };
  const bool has_at = inner.has("at"), has_event = inner.read("event", entry.event);
  if (has_at == has_event)
    problem("at", std::string(has_at ? "and `event` both say when: leave one of the two out"
                                     : "is missing: say when with `at` or `event`") +
                      ", like " + kAnnotation);
  if (has_at && !inner.read_seconds("at", entry.at))
    good = false;
  else if (has_at && !(entry.at >= 0 && (entry.at <= scene.duration || may_be_beyond)))
    problem("at", "is " + format_shortest(entry.at) + " s, but the motion goes from 0 to " +
                      format_shortest(scene.duration) + " s");
  good &= names_event(inner, scene, entry.event);
  if (!inner.has("text") || (inner.read("text", entry.text) && entry.text.empty()))
    problem("text", std::string("is missing: what is to be said, like ") + kAnnotation);
  const YAML::Node point = inner.find("point");
  if (point.IsDefined() && point.IsSequence()) {
    if (inner.read("point", entry.spot) && entry.spot.size() != 2 && entry.spot.size() != 3)
      problem("point", "has " + std::to_string(entry.spot.size()) +
                           " numbers: a place is [right, up] in metres, or [x, y, z] in the world");
  } else if (!point.IsDefined() || (inner.read("point", entry.point) && entry.point.empty())) {
    problem("point", "is missing: a link, a joint, a name of `frames`, or a place [right, up] in metres");
  }
  if (inner.read_seconds("hold", entry.hold) && !(entry.hold >= 0 && entry.hold <= kLongestPause))
    problem("hold", "must lie between 0 and " + format_shortest(kLongestPause) + " s");
  inner.read("panel", entry.panel);
  inner.finish();
  return good;
}

// Words of one moment would stand side by side, and none be read.
void refuse_same_instants(Fields& fields, const Scene& scene) {
  const auto& all = scene.annotate;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (all[i].panel == all[j].panel && all[i].event == all[j].event && all[i].at == all[j].at)
        fields.problems().add("'annotate." + std::to_string(j + 1) + "' and 'annotate." + std::to_string(i + 1) +
                                  "' overlap: both stand at " +
                                  (all[i].event.empty() ? format_shortest(all[i].at) + " s" : "'" + all[i].event + "'") +
                                  "; let one come later",
                              all[i].place);
}

}  // namespace

KeyText told_annotate() {
  return told_list(
      "annotate",
      told_record("",
                  {told("at", KeyForm::number, "when, an instant of the motion; or `event`").in("s"),
                   told("event", KeyForm::text, "a name of `events:`: the first time that it happens"),
                   told("text", KeyForm::text, "what is said; formulas between dollar signs: \"along $Lambda$\"; {fall} and {F} as in `title`").required(),
                   told_either("point",
                               {told("", KeyForm::text, ""),
                                told_list("", told("", KeyForm::number, ""), "m, as `camera.fit` has them, or x y z in the world")},
                               "what it points at: a name of `frames`, a link (its middle), a joint, or a place [right, up] or [x, y, z]")
                       .required(),
                   told("hold", KeyForm::number, "for how long the motion stands still there, s of the film; 2 where it is left "
                                                 "out; with 0 the film goes on and the words stay for 2 s")
                       .in("s"),
                   told("panel", KeyForm::whole, "of a comparison; 1 where it is left out")},
                  "words"),
      "words that point at something, for which the film stands still");
}

std::string annotate_text(const Scene& scene) {
  if (scene.annotate.empty()) return "";
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const AnnotationEntry& one : scene.annotate) {
      out << YAML::Flow << YAML::BeginMap;
      if (one.event.empty())
        out << YAML::Key << "at" << YAML::Value << format_shortest(one.at);
      else
        out << YAML::Key << "event" << YAML::Value << YAML::DoubleQuoted << one.event;
      out << YAML::Key << "text" << YAML::Value << YAML::DoubleQuoted << one.text;
      out << YAML::Key << "point" << YAML::Value;
      if (one.spot.empty())
        out << YAML::DoubleQuoted << one.point;
      else
        emit_numbers(out, one.spot);
      out << YAML::Key << "hold" << YAML::Value << format_shortest(one.hold);
      if (one.panel != 1) out << YAML::Key << "panel" << YAML::Value << one.panel;
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  });
}

void read_annotate(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("annotate");
  if (!node.IsDefined() || node.IsNull()) return;
  if (!node.IsSequence())
    return fields.problem_at("annotate", std::string("'annotate' must be a list of entries: [") + kAnnotation + "]");
  const bool may_be_beyond = fields.cuts_short("annotate");
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string key = "annotate." + std::to_string(i + 1);
    AnnotationEntry entry;
    entry.place = fields.place_of(node[i], key);
    if (!node[i].IsMap()) {
      fields.problems().add("'" + key + "' must be an entry like " + kAnnotation, entry.place);
      continue;
    }
    Fields inner(fields.document(), node[i], key, fields.problems());
    if (!read_annotation(inner, scene, entry, may_be_beyond)) continue;
    if (entry.at <= scene.duration) {
      scene.annotate.push_back(entry);
      continue;
    }
    ++beyond;
    scene.notices.push_back(left_out_beyond(key, scene));
  }
  if (scene.annotate.size() + beyond == node.size()) refuse_same_instants(fields, scene);
}

}  // namespace chainreel
