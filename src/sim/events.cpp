#include "sim/events.hpp"

#include <algorithm>

#include "sim/tip_reader.hpp"

namespace chainreel {
namespace {

template <class Value, std::size_t count>
Value find_named(const std::pair<const char*, Value> (&rows)[count], const std::string& name,
                 const std::string& what) {
  std::vector<std::string> names;
  std::string list;
  for (const auto& [known, value] : rows) {
    if (name == known) return value;
    names.push_back(known);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  throw Error(ExitCode::bad_input,
              "unknown " + what + " '" + name + "':" + did_you_mean(name, names) + " They are " + list + ".");
}

constexpr std::pair<const char*, EventKind> kKinds[] = {
    {"mark", EventKind::mark}, {"stop", EventKind::stop}, {"fall", EventKind::fall}};
constexpr std::pair<const char*, Crossing> kCrossings[] = {
    {"either", Crossing::either}, {"rising", Crossing::rising}, {"falling", Crossing::falling}};

Event::Test test_of(const Expression& when, const EventEntry& entry) {
  const std::optional<Operation> comparison = when.comparison();
  const auto refuse = [&](const std::string& why) -> Event::Test {
    throw Error(ExitCode::bad_input, "the event `" + entry.when + "` " + why, entry.place);
  };
  if (when.used_variables().empty()) return refuse("reads nothing that changes, so it can never happen");
  if (!comparison && when.compares_inside())
    return refuse(
        "is 1 or 0 and never crosses zero: write `min(q1 > 1, t > 2) > 0` for both, max for one of them");
  if (comparison && *comparison != Operation::equal && entry.direction != Crossing::either)
    return refuse("is a comparison, which says its direction itself: leave out `direction`");
  if (comparison == Operation::less) return Event::Test::below;
  if (comparison == Operation::less_equal) return Event::Test::at_or_below;
  if (comparison == Operation::greater) return Event::Test::above;
  if (comparison == Operation::greater_equal) return Event::Test::at_or_above;
  if (comparison == Operation::not_equal)
    return refuse("holds nearly always: name the instant with == or with the difference of the two sides");
  return entry.direction == Crossing::rising    ? Event::Test::at_or_above
         : entry.direction == Crossing::falling ? Event::Test::at_or_below
                                                : Event::Test::changes_side;
}

void add_event(EventSet& events, const Chain& chain, const EventEntry& entry) {
  const Expression when = Expression::parse(entry.when, events.probe.names(), entry.place);
  events.list.push_back({entry.title(), entry.kind, when.difference(), test_of(when, entry)});
  for (const int slot : when.used_variables()) {
    require_frame_of(chain, events.probe, slot, entry.place);
    events.needs_kinematics |= events.probe.is_kinematic(slot);
    events.needs_multipliers |= events.probe.is_multiplier(slot);
    if (events.foot && events.probe.names()[std::size_t(slot)] == "cop") events.cop_slot = slot;
  }
}

}  // namespace

EventKind event_kind_of(const std::string& name) {
  return find_named(kKinds, name, "kind of event");
}

Crossing crossing_of(const std::string& name) {
  return find_named(kCrossings, name, "direction of an event");
}

std::string to_string(EventKind kind) {
  return kKinds[std::size_t(kind)].first;
}

std::string to_string(Crossing crossing) {
  return kCrossings[std::size_t(crossing)].first;
}

std::vector<std::string> foot_names() {
  return {"cop", "heel", "toe"};
}

std::shared_ptr<const EventSet> make_events(const Chain& chain, const std::vector<EventEntry>& entries,
                                            const Parameters& parameters, const NamedFrames& frames,
                                            const std::optional<Foot>& foot, int rows) {
  if (entries.empty() && !foot) return nullptr;
  Parameters known = parameters;
  GroundAxes ground;
  if (foot) {
    if (rows > 0)
      throw Error(ExitCode::bad_input, "a foot goes without constraints: they would carry part of the robot");
    ground = ground_axes(chain);
    known.insert(known.end(), {{"cop", 0.0}, {"heel", foot->heel}, {"toe", foot->toe}});
  }
  auto events =
      std::make_shared<EventSet>(EventSet{Probe(chain, known, rows, frames), {}, false, false, foot, ground});
  ProblemList problems;
  for (const EventEntry& entry : entries) {
    try {
      add_event(*events, chain, entry);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  problems.throw_if_any();
  return events;
}

}  // namespace chainreel
