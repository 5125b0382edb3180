// What a run looks out for: expressions whose zero crossing is located on the method's dense output.
//
// `y_H < 0.5`   the instant at which this becomes true; so with > <= >=. One that holds already at t = 0 does
//               not happen before it has been false.
// `q1 - pi/2`   the instant at which this becomes zero or changes its sign, whichever way; `q1 == pi/2` is
// the
//               same. With a direction: when it has risen to zero, or fallen to it.
//
// Each step is looked at in kLooksPerStep equal parts. An event is found where the expression differs between
// the ends of a part; one that comes and goes within a part is not seen. Jumps are located like crossings,
// and so are poles. The instant is exact to kInstantTolerance on the dense output, whose own error is the
// method's: see Method::dense_order.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "expr/expression.hpp"
#include "sim/first_instant.hpp"
#include "sim/foot.hpp"
#include "sim/probe.hpp"

namespace chainreel {

inline constexpr int kLooksPerStep = 8;

enum class EventKind {
  mark,  // is recorded
  stop,  // and ends the run
  fall,  // and counts as a fall
};
enum class Crossing { either, rising, falling };

// By name; throw Error naming the nearest one.
EventKind event_kind_of(const std::string& name);
Crossing crossing_of(const std::string& name);
std::string to_string(EventKind kind);
std::string to_string(Crossing crossing);

inline bool ends_the_run(EventKind kind) {
  return kind != EventKind::mark;
}

// An event as the scene wrote it.
struct EventEntry {
  std::string when;
  EventKind kind = EventKind::mark;
  std::string name;                       // "": `when` is its name
  Crossing direction = Crossing::either;  // of an expression that is no comparison
  Place place;                            // of `when`
  const std::string& title() const { return name.empty() ? when : name; }
};

struct Event {
  enum class Test { above, at_or_above, below, at_or_below, changes_side };  // of the value against zero
  std::string name;
  EventKind kind = EventKind::mark;
  Expression value;
  Test test = Test::changes_side;
};

// The events of a scene, ready for any number of runs.
struct EventSet {
  Probe probe;
  std::vector<Event> list;
  bool needs_kinematics = false;
  bool needs_multipliers = false;
  std::optional<Foot> foot;
  GroundAxes ground;
  int cop_slot = -1;  // of the probe, where an event reads it
};

// What events may read beyond torques where there is a foot: cop, heel, toe.
std::vector<std::string> foot_names();

// Null where there are neither. Throws Error with every problem.
std::shared_ptr<const EventSet> make_events(const Chain& chain, const std::vector<EventEntry>& entries,
                                            const Parameters& parameters, const NamedFrames& frames = {},
                                            const std::optional<Foot>& foot = {}, int rows = 0);

}  // namespace chainreel
