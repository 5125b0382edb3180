// The key slow_motion.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/film_clock.hpp"
#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

constexpr const char* kExample = "{from: 1s, until: 1.5s, speed: 0.25}";
constexpr Name kWords[] = {{"auto", "slower where a link turns fast and about events, where the picture has words to say so"},
                           {"none", "nowhere"}};
constexpr double kLeastSlow = 0.9;  // beyond, it is no slow motion
constexpr KeyRange kSpeeds{kSlowest, kLeastSlow}, kTurns{0, std::numbers::pi, true}, kArounds{0, 1000, true};

// One entry of the list; `key` is its dotted path.
class StretchReader {
 public:
  StretchReader(Fields& fields, const YAML::Node& node, const std::string& key)
      : inner_(fields.document(), node, key, fields.problems()),
        cuts_short_(fields.cuts_short("slow_motion")),
        key_(key),
        place_(fields.place_of(node, key)) {}

  // Begins behind the end that the command line gives the motion: nothing is wrong with it.
  bool is_beyond() const { return is_beyond_; }

  // False where something is wrong that has been told, or it is beyond.
  bool read(const Scene& scene, SlowMotionEntry& entry) {
    inner_.read("event", entry.event);
    const bool complete =
        (has("from") && inner_.read_seconds("from", entry.from)) &
                          (has("until") && inner_.read_seconds("until", entry.until)) & read_speed(entry.speed);
    inner_.finish();
    if (!complete || !names_event(inner_, scene, entry.event)) return false;
    return entry.event.empty() ? check_instants(scene, entry) : check_span(entry);
  }

 private:
  bool complain(const std::string& message, const std::string& key) {
    inner_.problems().add("'" + key_ + "." + key + "' " + message, inner_.place_of(inner_.find(key), key));
    return false;
  }

  bool has(const std::string& key) {
    const YAML::Node node = inner_.find(key);
    if (node.IsDefined() && node.IsScalar()) return true;
    inner_.problems().add("'" + key_ + "' needs `" + key + "`: " + kExample, place_);
    return false;
  }

  bool read_speed(double& speed) {
    if (!has("speed")) return false;
    inner_.read("speed", speed);
    if (speed >= kSlowest && speed <= kFastest) return true;
    return complain("must lie between " + format_shortest(kSlowest) + " and " + format_shortest(kFastest) +
                        ": 0.25 is four times slower, 4 four times faster",
                    "speed");
  }

  bool check_span(const SlowMotionEntry& entry) {
    if (entry.from < entry.until) return true;
    return complain("must lie before `until`: " + format_shortest(entry.from) + " s is not before " +
                        format_shortest(entry.until) + " s",
                    "from");
  }

  bool check_instants(const Scene& scene, const SlowMotionEntry& entry) {
    if (!check_span(entry)) return false;
    if (entry.from < 0)
      return complain("must not lie before 0 s; seconds before an event go with `event: NAME`", "from");
    if (entry.from < scene.duration) return true;
    is_beyond_ = cuts_short_;
    if (is_beyond_) return false;
    return complain("lies at or behind the end of the motion, " + format_shortest(scene.duration) + " s",
                    "from");
  }

  Fields inner_;
  bool cuts_short_, is_beyond_ = false;
  std::string key_;
  Place place_;
};

std::string span_text(const SlowMotionEntry& entry) {
  return format_shortest(entry.from) + " to " + format_shortest(entry.until) + " s";
}

// At an instant of the motion two speeds make no sense; around events the slower one holds.
void refuse_overlaps(Fields& fields, const YAML::Node& node, const Scene& scene) {
  std::vector<SlowMotionEntry> instants;
  for (const SlowMotionEntry& entry : scene.slow_motion)
    if (entry.event.empty()) instants.push_back(entry);
  std::sort(instants.begin(), instants.end(),
            [](const SlowMotionEntry& a, const SlowMotionEntry& b) { return a.from < b.from; });
  for (std::size_t i = 0; i + 1 < instants.size(); ++i)
    if (instants[i + 1].from < instants[i].until)
      fields.problems().add("stretches of 'slow_motion' overlap: " + span_text(instants[i]) + " and " +
                                span_text(instants[i + 1]) + "; let one end where the next begins",
                            fields.place_of(node, "slow_motion"));
}

// What can be said before the run, which alone knows its events.
void check_length(Fields& fields, const YAML::Node& node, const Scene& scene) {
  if (!(scene.duration > 0)) return;  // told elsewhere
  const FilmClock clock(scene.duration, scene.video.fps, stretches_of(scene.slow_motion, scene.events, {}));
  const double frames = clock.film_seconds() * scene.video.fps.value();
  const bool follows_events = std::any_of(scene.slow_motion.begin(), scene.slow_motion.end(),
                                          [](const SlowMotionEntry& entry) { return !entry.event.empty(); });
  if (frames > kMostFrames)
    fields.problems().add("'slow_motion' makes a film of more than ten million frames",
                          fields.place_of(node, "slow_motion"));
  else if (frames < 0.5 && !follows_events)
    fields.problems().add("'slow_motion' leaves less than half a frame: the film would be empty",
                          fields.place_of(node, "slow_motion"));
}

// Null where something is wrong that has been told.
std::optional<SlowMotionRule> read_rule(Fields& fields, const YAML::Node& node) {
  SlowMotionRule rule;
  rule.is_asked = true;
  Fields inner(fields.document(), node, "slow_motion", fields.problems());
  bool is_right = true;
  const auto within = [&](const char* key, const KeyRange& range, double value, const char* unit) {
    if (range.holds(value)) return;
    inner.problem_at(key, "'slow_motion." + std::string(key) + "' must lie " + range_text(range, unit));
    is_right = false;
  };
  if (inner.read("speed", rule.speed)) within("speed", kSpeeds, rule.speed, "");
  if (inner.read("turn", rule.turn)) within("turn", kTurns, rule.turn, "rad");
  double around = 0;
  if (inner.read_seconds("around", around)) {
    rule.around = around;
    within("around", kArounds, around, "s");
  }
  inner.finish();
  return is_right ? std::optional(rule) : std::nullopt;
}

std::string rule_text(const SlowMotionRule& rule) {
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "speed" << YAML::Value << format_shortest(rule.speed);
    out << YAML::Key << "turn" << YAML::Value << format_shortest(rule.turn);
    if (rule.around) out << YAML::Key << "around" << YAML::Value << format_shortest(*rule.around);
    out << YAML::EndMap;
  });
}

}  // namespace

KeyText told_slow_motion() {
  KeyText list =
      told_list("", told_record("",
                               {told("event", KeyForm::text, "a name of `events:`; `from` and `until` are seconds from its "
                                                          "instants on, before it with a minus"),
                                told("from", KeyForm::number, "the first instant").in("s").required(),
                                told("until", KeyForm::number, "the last instant").in("s").required(),
                                told("speed", KeyForm::number, "0.25 is four times slower, 4 four times faster")
                                    .within({kSlowest, kFastest})
                                    .required()},
                               "a stretch"),
                "stretches of the motion");
  KeyText rule = told_record(
      "",
      {told("speed", KeyForm::number, "0.25 where it is left out").within(kSpeeds),
       told("turn", KeyForm::number, "how far a link may turn from frame to frame; 15deg where it is left out").in("rad").within(kTurns),
       told("around", KeyForm::number, "of the motion before and behind what is slowed down, half of which the speed takes to change; "
                                       "0.2, at most a tenth of the motion, where it is left out")
           .in("s")
           .within(kArounds)},
      "as auto, with numbers of its own");
  return told_either("slow_motion", {told_word("", kWords, ""), std::move(rule), std::move(list)},
                     "where the film shows the motion slower, or faster, than it was");
}

std::string slow_motion_text(const Scene& scene) {
  if (scene.slow_motion_rule && scene.slow_motion_rule->is_asked) return rule_text(*scene.slow_motion_rule);
  if (scene.slow_motion_rule) return kWords[0].name;
  if (scene.slow_motion.empty()) return kWords[1].name;
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const SlowMotionEntry& one : scene.slow_motion) {
      out << YAML::Flow << YAML::BeginMap;
      if (!one.event.empty()) out << YAML::Key << "event" << YAML::Value << YAML::DoubleQuoted << one.event;
      for (const auto& [key, value] : {std::pair{"from", one.from}, {"until", one.until}, {"speed", one.speed}})
        out << YAML::Key << key << YAML::Value << format_shortest(value);
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  });
}

std::string left_out_beyond(const std::string& key, const Scene& scene) {
  return "'" + key + "' of the scene is left out: it begins behind the end of the motion, " + format_shortest(scene.duration) +
         " s, that the command line says";
}

void read_slow_motion(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("slow_motion");
  if (!node.IsDefined() || node.IsNull()) return;
  if (node.IsScalar() && node.Scalar() == kWords[0].name) return;
  if (node.IsMap()) {
    scene.slow_motion_rule = read_rule(fields, node);
    return;
  }
  scene.slow_motion_rule.reset();
  if (node.IsScalar() && node.Scalar() == kWords[1].name) return;
  if (!node.IsSequence())
    return fields.problem_at("slow_motion", std::string("'slow_motion' must be auto, none, numbers for what is slowed down by itself: "
                                                        "{speed: 0.25, turn: 15deg}, or a list of stretches: [") +
                                                kExample + ", {event: NAME, from: -0.2s, until: 0.3s, speed: 0.1}]");
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string key = "slow_motion." + std::to_string(i + 1);
    if (!node[i].IsMap()) {
      fields.problems().add("'" + key + "' must be a stretch like " + kExample, fields.place_of(node[i], key));
      continue;
    }
    SlowMotionEntry entry;
    StretchReader reader(fields, node[i], key);
    if (reader.read(scene, entry)) scene.slow_motion.push_back(entry);
    if (!reader.is_beyond()) continue;
    ++beyond;
    scene.notices.push_back(left_out_beyond(key, scene));
  }
  if (scene.slow_motion.size() + beyond < node.size()) return;
  refuse_overlaps(fields, node, scene);
  check_length(fields, node, scene);
}

}  // namespace chainreel
