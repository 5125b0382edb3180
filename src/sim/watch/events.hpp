// What a run looks out for: expressions whose zero crossing is located on the method's dense output.
//
// `y_H < 0.5`   the instant at which this becomes true; so with > <= >=. One that holds already at t = 0 does
//               not happen before it has been false.
// `q1 - pi/2`   the instant at which this becomes zero or changes its sign, whichever way; `q1 == pi/2` is
// the
//               same. With a direction: when it has risen to zero, or fallen to it.
//
// Each step is looked at in kLooksPerStep equal parts, a long one in more: none is longer than such a part of a step of 1/256 of the run. An event is found where the expression differs between
// the ends of a part, and where it comes nearer to zero within one and turns round behind it: the slopes at the ends say so. One that
// turns round at several looks in a row, or is elsewhere between them at odd instants, is faster than they are: see EventHits::hasty. Jumps are located like crossings;
// poles, where an expression changes its sign and is never zero, are none. The instant is exact to kInstantTolerance on the dense output, whose own error is the
// method's: see Method::dense_order.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/workspace.hpp"
#include "expr/expression.hpp"
#include "integrate/integrator.hpp"
#include "sim/drive/probe.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/system/trajectory.hpp"
#include "sim/watch/first_instant.hpp"

namespace chainreel {

// A foot that stands on the ground, fixed to the world, and the centre of pressure below it. A flat foot on
// the ground can stand only as long as that lies below it; beyond, it would tip about its heel or toe.

// Places along the ground, whose direction in the chain's plane is at right angles to gravity; positive
// towards +x, or, in a plane without x, towards +y. World numbers, m.
struct Foot {
  double heel = 0;
  double toe = 0;
  double height = 0;  // of the ground, against gravity
};

struct GroundAxes {
  Eigen::Vector3d along, up;  // in W
};
// Throws Error (bad input) for chains that move out of one plane or float, and where no gravity acts in it.
GroundAxes ground_axes(const Chain& chain);

// What the ground exerts on the robot, force F and moment n about the world's origin.
struct GroundLoad {
  // Centre of pressure, m along the ground: the place where it has no moment, (n + height F_along) / F_up.
  // Infinite or no number where the ground bears nothing.
  double cop = 0;
  double grf = 0;  // F_up, N: below zero the ground would have to pull, and who stands on it takes off
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // F
  double moment = 0;  // N m, about the place 0 on the ground, from `along` to `up`: cop grf, finite where cop is not
};
// The motion is the chain's own under some torque; `pushed`: what else acts from outside.
GroundLoad ground_load(const Chain& chain, Workspace& ws, const GroundAxes& axes, double height, ConstVec q,
                       ConstVec qd, ConstVec qdd, const Wrench& pushed = {});
// Of the system's own motion, with all that pushes it; writes the accelerations, nv numbers.
GroundLoad ground_load(ChainSystem& system, Workspace& ws, const GroundAxes& axes, double height, double t, ConstVec q,
                       ConstVec qd, Vec qdd);

// Whether a foot that stands can answer so: the ground presses, and within it. A real one turns or rises where not.
bool bears(const GroundLoad& load, const Foot& foot);
// Whether it presses (a ground cannot pull) within three of the foot's lengths of its middle: a centre of pressure farther off tells
// nothing, and none is there without a number.
bool presses_near(const GroundLoad& load, const Foot& foot);

// What holds a foot where it is: the same force and moment as the ground's, made of what presses within the foot and the least pull
// within it that is left to explain. No ground gives that pull.
struct FootHold {
  double place = 0;  // m along the ground, within the foot
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // there; against gravity it is not below zero
  double pull_place = 0, pull = 0;                  // N, with gravity; 0 where the foot can stand
};
FootHold hold_of(const GroundLoad& load, const Foot& foot, const GroundAxes& axes);

// Where a probe holds what the ground exerts; -1: nothing reads it.
struct GroundSlots {
  int cop = -1, grf = -1;
  bool are_read() const { return cop >= 0 || grf >= 0; }
  void add(const std::string& name, int slot);  // of cop and grf; of others nothing
  void set(Probe& probe, const GroundLoad& load) const;
};

// Of a duration: what is no shorter than the part of a step that lies between two looks at the torques is seen. Shorter pulses
// of t alone are sought (expr/pulses), shorter ones of the state are not.
inline constexpr int kLeastWatchedSteps = 256;

inline constexpr int kLooksPerStep = 8;

enum class EventKind {
  mark,  // is recorded
  stop,  // and ends the run
  fall,  // and counts as a fall
};
enum class Crossing { either, rising, falling };

std::span<const Name> names_of(EventKind);
std::span<const Name> names_of(Crossing);

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
  GroundSlots load;  // where an event reads it
};

// What events may read beyond torques where there is a foot: cop, grf, heel, toe.
Parameters foot_parameters(const Foot& foot);

// Null where there are neither. Throws Error with every problem.
std::shared_ptr<const EventSet> make_events(const Chain& chain, const std::vector<EventEntry>& entries,
                                            const Parameters& parameters, const NamedFrames& frames = {},
                                            const std::optional<Foot>& foot = {}, int rows = 0);

// The events of one run in progress.

class EventWatch {
 public:
  // References must outlive it.
  EventWatch(const EventSet& events, ChainSystem& system, double duration);

  // Where the run begins: what holds here does not happen until it has been false, and `hits` says so. False where an event's
  // value is no finite number, here and in check_step.
  bool start(double t, ConstVec q, ConstVec qd, EventHits& hits);
  // After a step: looks through it, up to the first event that ends the run. What happens is added to `hits`,
  // in the order of time; allocates only there.
  bool check_step(Integrator& integrator, EventHits& hits);

  bool has_ended() const { return ended_; }  // by an event: the last of the hits
  int bad_event() const { return bad_; }     // the one whose value was no finite number ..
  double bad_instant() const { return bad_at_; }  // .. and when, s

 private:
  struct State {
    double value = 0;
    bool holds = false;  // what the event's test asks
    int side = 0;        // sign of the value, for Test::changes_side
    double change = 0;   // of the value since the look before
    int turns = 0;       // at how many looks in a row it has turned round
  };
  // What was seen of a value, to judge by where it is between looks.
  struct Course {
    double low = 0, high = 0;
    int strays = 0;  // how often it was far from the line between two looks
  };
  struct Pending {
    int event;
    double t;
  };

  bool read(double t, ConstVec q, ConstVec qd);  // all values into now_
  void set_probe(double t, ConstVec q, ConstVec qd);
  double value_at(Integrator& integrator, const Event& event, double t);
  double locate(Integrator& integrator, std::size_t event, double begin, double end);
  bool is_pole(Integrator& integrator, std::size_t event, double t, double a, double b);
  // What happens to an event in that part, if anything, into pending_.
  void look_within(Integrator& integrator, std::size_t event, double a, double b);
  // Of one that comes and goes again within it.
  void look_for_a_visit(Integrator& integrator, std::size_t event, double a, double b);
  void look_for_haste(std::size_t event, double t, EventHits& hits);
  void call_hasty(std::size_t event, double t, EventHits& hits);
  // At an odd instant of that part, which no period of an event is a multiple of; after `read` at its end.
  void probe_between(Integrator& integrator, double a, double b, EventHits& hits);
  static bool happens(const Event& event, const State& before, double value);
  void record(Integrator& integrator, const Pending& hit, EventHits& hits);

  const EventSet& events_;
  ChainSystem& system_;
  double longest_part_;  // s, between two looks
  Workspace ws_;
  Probe probe_;
  std::vector<State> before_;
  std::vector<Course> courses_;
  long probes_ = 0;
  std::vector<double> now_;
  std::vector<Pending> pending_;
  std::vector<double> q_, qd_, qdd_;
  bool ended_ = false;
  int bad_ = -1;
  double bad_at_ = 0;
};

}  // namespace chainreel
