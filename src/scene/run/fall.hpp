// When does it fall? A run's first `fall` event, and how it depends on a key of the scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/run/sweep.hpp"
#include "scene/scene.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Whether an event says when it has fallen.
bool has_fall(const Scene& scene);

// The instant at which an event of kind `fall` ended the run, s.
std::optional<double> fall_time_of(const Scene& scene, const Trajectory& trajectory);

// "0.83 s", or "more than 5 s" of a run that did not fall.
std::string fall_time_text(const Scene& scene, const Trajectory& trajectory);

struct FallRow {
  std::string value;  // of the key
  RunStatus status = RunStatus::finished;
  double end_time = 0;                       // s
  std::optional<double> fall_time;           // s
  int ending_event = -1;                     // index into FallTable::events
  std::vector<std::optional<double>> first;  // the first time of each event, s; 0 of one that holds from the start
  std::string trouble;

  // When the centre of pressure first left the scene's foot, s, over toe or heel. From then on a flat foot
  // on the ground would tip, which the model's, fixed to the world, does not.
  std::optional<double> tips;
  bool over_toe = false;

  // Whether it lies on the toe's side of the foot when it has fallen, by its centre of mass; nothing where there is no foot or no fall.
  std::optional<bool> lies_before;

  // N m: what torque at the ankle a foot bears that rests under the weight, before it tips over its heel and over its toe; the
  // foot's own weight counts. Nothing without a foot, or where several joints stand on the ground.
  std::optional<std::pair<double, double>> bears;

  // When the ground would first have to pull at the robot, s: there it takes off, which the model's foot does not.
  std::optional<double> takes_off;
};

// Between two rows that end otherwise, where that changes: from `before`, which still ends as the lower row does, to `behind`.
// Nothing is known of rows that end alike, and of others only at a few places more.
struct FallEdge {
  double before = 0, behind = 0;  // of the key
  std::string from, to;           // see end_of
  double row_before = 0, row_behind = 0;  // the rows
  std::optional<double> contradicted_at;  // a value between the rows that ends as the edges do not have it: there are more of them
};

struct FallTable {
  Sweep sweep;
  std::vector<EventEntry> events;  // of the scene
  double duration = 0;             // s
  bool has_foot = false;
  std::optional<std::pair<double, double>> bears;  // as all rows have it; nothing where they differ
  std::string method;
  int threads = 1;
  std::vector<std::string> doubts;  // "NAME: what speaks against the scene", of its first row
  std::vector<FallRow> rows;
  std::vector<FallEdge> edges;  // where they were asked for
  std::string unit_of_edges{};
};

// What became of a run, the first of these that holds.
enum class FallEnd {
  falls,
  stopped,      // by another event
  fails,        // it came to no end
  lies,         // from the start
  stays_up,     // nothing is known of a foot
  takes_off,    // before it tips, if it does: where it has no way down, the ground's force has no place either
  tips,
  stands,
};
FallEnd what_became_of(const FallTable& table, const FallRow& row);
std::string tips_over(const FallRow& row);  // "toe", "heel"; "" where it does not
std::string falls_to(const FallRow& row);   // on which side of the foot it lies: "forwards", "backwards"; "" where that is not known

// How a run ended, in words that are the same of runs that ended alike: "falls forwards", "tips over the toe, not down", "stands",
// "stopped by left", ..
std::string end_of(const FallTable& table, const FallRow& row);
// From when on the ground would have to press beside the foot, or pull at it, by the motion through the samples of a run: a real foot turns
// from there on, and this one is held. Nothing where there is no foot, or it bears all of the run.
std::optional<double> foot_is_held_from(const Simulation& simulation, const Trajectory& run);
// "tips at 0.66 s", of such a run, or "takes off ..", where the ground would have to pull there; "" of others.
std::string tips_text(const Simulation& simulation, const Trajectory& run);
inline constexpr const char* kFootIsHeld = "the ground would have to press beside the foot, or pull at it: a real one turns from there on, this one is held";

// Never fell, and kept the pressure within the foot.
bool stands(const FallRow& row);
// Whether the key's values are two numbers at least, plain or of one unit.
bool can_have_edges(const Sweep& sweep);

struct FallSearch {
  int threads = 1;
  // Looks for the edges between rows, to this share of the rows' distance, or to neighbours of a key that takes whole numbers;
  // none at 0. Values of the key must be numbers.
  double edges_to = 0;
};

// A run for each value, on threads which ask `stop` with the share of all work that is done. `method: auto` means dop853 with a tolerance of 1e-10 here: the
// same for all rows. Throws what reading or preparing a row's scene throws, and Error (bad input) where the
// scene has no event of kind `fall`.
FallTable run_fall_table(const std::string& scene, const std::vector<std::string>& overrides,
                         const Sweep& sweep, const FallSearch& search, const StopRequest& stop = {});

}  // namespace chainreel
