#include "scene/run/fall.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/parallel.hpp"
#include "integrate/hermite_span.hpp"
#include "scene/quantity.hpp"
#include "scene/run/prepare.hpp"
#include "scene/text/unread.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/workload.hpp"

namespace chainreel {
namespace {

Scene read_one(const std::string& path, const std::vector<std::string>& overrides) {
  Scene scene = read_scene(path, overrides);
  require_single_run(scene);
  if (!has_fall(scene))
    throw Error(ExitCode::bad_input,
                "has no event of kind `fall`, so nothing says when it has fallen: add one like "
                "events: [{when: \"y_G < 0.5\", kind: fall, name: lies}]",
                scene.place_of("events"));
  if (scene.chooses_method()) {
    scene.method = "dop853";
    scene.tolerance = 1e-10;
  }
  return scene;
}

// By an angle, so that a ground that bears nothing, where the pressure is infinitely far away, is none without number.
constexpr const char* kPressureLeavesTheFoot = "atan2(max(heel - cop, cop - toe), 1) > 0";
constexpr const char* kGroundPulls = "grf < 0";

double pressure_at(const Simulation& simulation, const Foot& foot, double t, ConstVec q, ConstVec qd) {
  const Chain& chain = simulation.chain;
  ChainSystem system(simulation);
  std::vector<double> qdd(qd.size());
  Workspace ws(chain);
  return ground_load(system, ws, ground_axes(chain), foot.height, t, q, qd, qdd).cop;
}

// `event`: the one that watches the pressure; it waits where it holds from the start.
void find_tipping(FallRow& row, const Simulation& simulation, const Foot& foot, const Trajectory& run, int event) {
  const double at_start = pressure_at(simulation, foot, 0, simulation.q0, simulation.qd0);
  if (!(at_start >= foot.heel && at_start <= foot.toe)) {
    row.tips = 0;
    row.over_toe = at_start > foot.toe;
    return;
  }
  for (int k = 0; k < run.events.size(); ++k) {
    if (run.events.event[std::size_t(k)] != event) continue;
    const double t = run.events.t[std::size_t(k)];
    row.tips = t;
    const double place = pressure_at(simulation, foot, t, run.events.q_at(k), run.events.qd_at(k));
    row.over_toe = place > 0.5 * (foot.heel + foot.toe);
    return;
  }
}

// By the centre of mass, under which the ground would bear it if it rested there.
bool lies_on_the_toes_side(const Chain& chain, const Foot& foot, ConstVec q) {
  Workspace ws(chain);
  const std::vector<double> at_rest(std::size_t(chain.nv), 0.0);
  return ground_load(chain, ws, ground_axes(chain), foot.height, q, at_rest, at_rest).cop > 0.5 * (foot.heel + foot.toe);
}

// `stop` is asked with the part of the run that is done.
std::optional<std::pair<double, double>> borne_by_foot(const Simulation& simulation) {
  if (!simulation.events || !simulation.events->foot) return {};
  const Chain& chain = simulation.chain;
  std::vector<double> ankles;  // m along the ground
  for (std::size_t b = 1; b < chain.bodies.size(); ++b)
    if (chain.bodies[b].parent == 0) ankles.push_back(chain.bodies[b].joint.X_PJ.translation().dot(simulation.events->ground.along));
  if (ankles.size() != 1) return {};
  const double g = chain.gravity.norm(), weight = mass_of(chain) * g;
  const Foot& foot = *simulation.events->foot;
  // About the ankle: the ground's force at heel or toe, and the foot's own weight, which the ankle does not feel.
  const Inertia& own = chain.bodies[0].inertia;
  const double of_foot = own.mass * g * (own.com.dot(simulation.events->ground.along) - ankles[0]);
  return std::pair{weight * (ankles[0] - foot.heel) + of_foot, weight * (foot.toe - ankles[0]) - of_foot};
}

FallRow run_row(Scene scene, const StopRequest& stop) {
  const std::size_t events = scene.events.size();
  if (scene.foot)
    for (const char* when : {kPressureLeavesTheFoot, kGroundPulls}) scene.events.push_back({.when = when, .name = {}, .place = {}});
  const Simulation simulation = prepare(scene, false);
  const double end[] = {simulation.duration};
  const Trajectory run = simulate(simulation, end, [&](double t) { return stop && stop(part_done(simulation, t)); });
  FallRow row;
  row.status = run.status;
  row.end_time = run.end_time;
  row.fall_time = fall_time_of(scene, run);
  row.ending_event = run.ending_event;
  row.trouble = run.trouble;
  row.bears = borne_by_foot(simulation);
  row.first.resize(scene.events.size());
  if (scene.foot) find_tipping(row, simulation, *scene.foot, run, int(events));
  if (scene.foot && row.fall_time) row.lies_before = lies_on_the_toes_side(simulation.chain, *scene.foot, run.q_at(run.size() - 1));
  for (int k = run.events.size() - 1; k >= 0; --k)
    row.first[std::size_t(run.events.event[std::size_t(k)])] = run.events.t[std::size_t(k)];
  for (const int event : run.events.from_start) row.first[std::size_t(event)] = 0;
  if (scene.foot) row.takes_off = row.first[events + 1];
  row.first.resize(events);
  return row;
}

bool can_be_read(const auto& read) {
  try {
    read();
    return true;
  } catch (const Error&) {
    return false;
  }
}

// What is between two values of the key.
struct Bisected {
  std::vector<double> numbers;  // of the rows
  std::string unit;             // of numbers in between
  bool is_whole = false;        // whole numbers alone

  std::string setting(const std::string& key, double number) const { return key + "=" + format_shortest(number) + unit; }
  // None where they are neighbours.
  std::optional<double> middle(double a, double b, double close) const {
    if (!(std::abs(b - a) > (is_whole ? 1 : close))) return std::nullopt;
    const double half = a + (b - a) / 2;
    return is_whole ? std::floor(half) : half;
  }
};

// Without numbers where a value is none; those with units, one by one, in SI.
Bisected bisected(const Sweep& sweep) {
  if (!sweep.numbers.empty()) return {sweep.numbers, sweep.unit};
  Bisected key;
  for (const std::string& value : sweep.values) {
    const std::string unit = unit_kind(value);
    if (unit.empty() || (!key.unit.empty() && unit != key.unit)) return {};
    key.unit = unit;
    try {
      key.numbers.push_back(parse_quantity(value, {}));
    } catch (const Error&) {
      return {};
    }
  }
  return key;
}

// Bisection between each two rows that end otherwise; `run_at` says how the scene of a setting ends. What lies between is ended as
// neither does where a middle shows it; then the next edge is looked for behind that.
template <class RunAt, class Stop>
void find_edges(FallTable& table, const FallSearch& search, const Bisected& key, RunAt run_at, Stop is_stopped) {
  constexpr std::size_t kMostEdges = 8;  // between two rows
  std::vector<std::vector<FallEdge>> found(table.rows.empty() ? 0 : table.rows.size() - 1);
  for_each_index(found.size(), search.threads, [&](std::size_t k) {
    const double first = key.numbers[k], last = key.numbers[k + 1], close = search.edges_to * std::abs(last - first);
    const std::string wanted = end_of(table, table.rows[k + 1]);
    FallEdge edge{first, last, end_of(table, table.rows[k]), wanted, first, last, {}};
    while (edge.from != wanted && found[k].size() < kMostEdges && !is_stopped()) {
      while (const std::optional<double> middle = key.middle(edge.before, edge.behind, close)) {
        if (is_stopped()) return;
        const std::string ends = run_at(key.setting(table.sweep.key, *middle));
        (ends == edge.from ? edge.before : edge.behind) = *middle;
        if (ends != edge.from) edge.to = ends;
      }
      found[k].push_back(edge);
      edge = {edge.behind, last, edge.to, wanted, first, last, {}};
    }
    if (found[k].empty()) return;
    constexpr int kMore = 8;  // places
    for (int i = 1; i < kMore && !is_stopped() && !key.is_whole; ++i) {
      const double at = first + (last - first) * i / kMore;
      std::string expected = found[k].front().from;
      for (const FallEdge& one : found[k])
        if (std::abs(at - first) >= std::abs(one.behind - first)) expected = one.to;
      if (run_at(key.setting(table.sweep.key, at)) == expected) continue;
      for (FallEdge& one : found[k]) one.contradicted_at = at;
      break;
    }
  });
  for (const std::vector<FallEdge>& of_pair : found) table.edges.insert(table.edges.end(), of_pair.begin(), of_pair.end());
}

}  // namespace

bool can_have_edges(const Sweep& sweep) { return bisected(sweep).numbers.size() >= 2; }

bool stands(const FallRow& row) {
  return !row.tips && !row.takes_off && !row.fall_time && row.status == RunStatus::finished;
}

namespace {

struct HeldFoot {
  double from;     // s
  bool takes_off;  // the ground would have to pull
};

std::optional<HeldFoot> held_foot_of(const Simulation& simulation, const Trajectory& run) {
  if (!simulation.events || !simulation.events->foot || !simulation.torque) return {};
  const Foot& foot = *simulation.events->foot;
  const Chain& chain = simulation.chain;
  ChainSystem system(simulation);
  std::vector<double> qdd(std::size_t(chain.nv));
  Workspace ws(chain);
  simulation.torque->leave_pieces();
  const GroundAxes axes = ground_axes(chain);
  const auto load_at = [&](double t, ConstVec q, ConstVec qd) { return ground_load(system, ws, axes, foot.height, t, q, qd, qdd); };
  const auto stands = [&](double t, ConstVec q, ConstVec qd) { return bears(load_at(t, q, qd), foot); };
  int k = 0;
  while (k < run.size() && stands(run.t[std::size_t(k)], run.q_at(k), run.qd_at(k))) ++k;
  if (k == run.size()) return {};
  if (k == 0) return HeldFoot{run.t.front(), load_at(run.t.front(), run.q_at(0), run.qd_at(0)).grf < 0};
  // Samples may be far apart: between them it is looked for in the motion through both.
  constexpr int kHalvings = 40;
  HermiteSpan span(chain.nq, chain.nv);
  span.start();
  double last = run.t[std::size_t(k) - 1], first = run.t[std::size_t(k)];
  span.begin(last, run.q_at(k - 1), run.qd_at(k - 1));
  span.end(first, run.q_at(k), run.qd_at(k));
  std::vector<double> q(std::size_t(chain.nq)), qd(std::size_t(chain.nv));
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (last + first) / 2;
    span.interpolate(system, middle, q, qd);
    (stands(middle, q, qd) ? last : first) = middle;
  }
  span.interpolate(system, first, q, qd);
  return HeldFoot{first, load_at(first, q, qd).grf < 0};
}

}  // namespace

std::optional<double> foot_is_held_from(const Simulation& simulation, const Trajectory& run) {
  const std::optional<HeldFoot> held = held_foot_of(simulation, run);
  return held ? std::optional(held->from) : std::nullopt;
}

std::string tips_text(const Simulation& simulation, const Trajectory& run) {
  const std::optional<HeldFoot> held = held_foot_of(simulation, run);
  return !held ? "" : (held->takes_off ? "takes off at " : "tips at ") + format_significant(held->from, 2) + " s";
}

FallEnd what_became_of(const FallTable& table, const FallRow& row) {
  if (row.fall_time) return FallEnd::falls;
  if (row.status == RunStatus::stopped) return FallEnd::stopped;
  if (row.status != RunStatus::finished) return FallEnd::fails;
  for (std::size_t i = 0; i < table.events.size(); ++i)
    if (table.events[i].kind == EventKind::fall && row.first[i] == 0.0) return FallEnd::lies;
  if (!table.has_foot) return FallEnd::stays_up;
  if (row.takes_off && (!row.tips || *row.takes_off <= *row.tips)) return FallEnd::takes_off;
  return row.tips ? FallEnd::tips : FallEnd::stands;
}

std::string tips_over(const FallRow& row) { return !row.tips ? "" : row.over_toe ? "toe" : "heel"; }

std::string falls_to(const FallRow& row) { return !row.lies_before ? "" : *row.lies_before ? "forwards" : "backwards"; }

std::string end_of(const FallTable& table, const FallRow& row) {
  switch (what_became_of(table, row)) {
    case FallEnd::falls: return row.lies_before ? "falls " + falls_to(row) : "falls";
    case FallEnd::stopped: return "stopped" + (row.ending_event < 0 ? "" : " by " + table.events[std::size_t(row.ending_event)].title());
    case FallEnd::fails: break;
    case FallEnd::lies: return "lies from the start";
    case FallEnd::stays_up: return "does not fall";
    case FallEnd::takes_off: return "takes off, not down";
    case FallEnd::tips: return "tips over the " + tips_over(row) + ", not down";
    case FallEnd::stands: return "stands";
  }
  return to_string(row.status);
}

bool has_fall(const Scene& scene) {
  return std::any_of(scene.events.begin(), scene.events.end(),
                     [](const EventEntry& event) { return event.kind == EventKind::fall; });
}

std::optional<double> fall_time_of(const Scene& scene, const Trajectory& trajectory) {
  if (trajectory.ending_event < 0) return {};
  const EventEntry& event = scene.events[std::size_t(trajectory.ending_event)];
  return event.kind == EventKind::fall ? std::optional(trajectory.end_time) : std::nullopt;
}

std::string fall_time_text(const Scene& scene, const Trajectory& trajectory) {
  const std::optional<double> time = fall_time_of(scene, trajectory);
  return time ? format_fixed(*time, 2) + " s"
              : "more than " + format_significant(trajectory.end_time, 3) + " s";
}

FallTable run_fall_table(const std::string& scene, const std::vector<std::string>& overrides,
                         const Sweep& sweep, const FallSearch& search, const StopRequest& stop) {
  FallTable table;
  table.sweep = sweep;
  table.threads = search.threads;
  table.rows.resize(sweep.values.size());
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> all = overrides;
    if (!sweep.key.empty()) all.push_back(setting);
    return all;
  };
  const auto settings = [&](std::size_t k) { return with(sweep.key.empty() ? "" : sweep.setting(k)); };
  // The first row's scene alone: one that cannot be read says so once.
  const Scene first = read_one(scene, settings(0));
  if (!sweep.key.empty()) require_read(sweep.key, first, "--sweep");
  table.events = first.events;
  table.duration = first.duration;
  table.has_foot = first.foot.has_value();
  table.method = method_text(first);
  Scene counted = first;
  const Simulation simulation = prepare(counted, false);
  require_possible(simulation, double(table.rows.size()));
  for (const std::string& doubt : counted.doubts) table.doubts.push_back(first.name + ": " + doubt);
  DoneShare done(table.rows.size());
  for_each_index(table.rows.size(), search.threads, [&](std::size_t k) {
    if (stop && stop(done.with())) return;
    table.rows[k] = run_row(read_one(scene, settings(k)), [&](double part) { return stop && stop(done.with(part)); });
    table.rows[k].value = sweep.values[k];
    done.add();
  });
  table.bears = table.rows.front().bears;
  for (const FallRow& row : table.rows)
    if (row.bears != table.bears) table.bears = std::nullopt;
  const auto is_stopped = [&] { return stop && stop(1); };
  if (!(search.edges_to > 0) || is_stopped()) return table;
  const auto run_at = [&](const std::string& setting) {
    return end_of(table, run_row(read_one(scene, with(setting)), [&](double) { return is_stopped(); }));
  };
  Bisected key = bisected(sweep);
  key.is_whole = std::all_of(key.numbers.begin(), key.numbers.end(), [](double x) { return x == std::floor(x); }) &&
                 !can_be_read([&] { read_one(scene, with(key.setting(sweep.key, key.numbers[0] + 0.5))); });
  table.unit_of_edges = key.unit;
  find_edges(table, search, key, run_at, is_stopped);
  return table;
}

}  // namespace chainreel
