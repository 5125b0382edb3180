// The events of one run in progress.
#pragma once

#include <vector>

#include "integrate/integrator.hpp"
#include "sim/chain_system.hpp"
#include "sim/events.hpp"
#include "sim/trajectory.hpp"

namespace chainreel {

class EventWatch {
 public:
  // References must outlive it.
  EventWatch(const EventSet& events, ChainSystem& system);

  // Where the run begins: what holds here does not happen until it has been false. False where an event's
  // value is no finite number, here and in check_step.
  bool start(double t, ConstVec q, ConstVec qd);
  // After a step: looks through it, up to the first event that ends the run. What happens is added to `hits`,
  // in the order of time; allocates only there.
  bool check_step(Integrator& integrator, EventHits& hits);

  bool has_ended() const { return ended_; }  // by an event: the last of the hits
  int bad_event() const { return bad_; }     // the one whose value was no finite number

 private:
  struct State {
    double value = 0;
    bool holds = false;  // what the event's test asks
    int side = 0;        // sign of the value, for Test::changes_side
  };
  struct Pending {
    int event;
    double t;
  };

  bool read(double t, ConstVec q, ConstVec qd);  // all values into now_
  void set_probe(double t, ConstVec q, ConstVec qd);
  double value_at(Integrator& integrator, const Event& event, double t);
  double locate(Integrator& integrator, std::size_t event, double begin, double end);
  static bool happens(const Event& event, const State& before, double value);
  void record(Integrator& integrator, const Pending& hit, EventHits& hits);

  const EventSet& events_;
  ChainSystem& system_;
  Workspace ws_;
  Probe probe_;
  std::vector<State> before_;
  std::vector<double> now_;
  std::vector<Pending> pending_;
  std::vector<double> q_, qd_, qdd_;
  bool ended_ = false;
  int bad_ = -1;
};

}  // namespace chainreel
