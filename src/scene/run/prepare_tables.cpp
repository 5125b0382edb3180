#include <algorithm>
#include <cmath>

#include "core/csv.hpp"
#include "core/format.hpp"
#include "dynamics/kinematics.hpp"
#include "scene/run/prepare.hpp"
#include "sim/drive/recorded_motion.hpp"
#include "sim/drive/table_units.hpp"

namespace chainreel {
namespace {

// Less is rounding, of an instant as a share of the duration, of a coordinate in rad or m.
constexpr double kSame = 1e-9;
// A table that goes on for so many times the run is likely told in another unit.
constexpr double kOtherUnit = 10;

struct NamedControl {
  Control* control;
  std::size_t first, end;  // the freedoms that it drives
};

std::vector<NamedControl> controls_of(Scene& scene, const Chain& chain) {
  std::vector<NamedControl> controls;
  if (scene.control) controls.push_back({&*scene.control, 0, std::size_t(chain.nv)});
  for (std::size_t i = 0; i < scene.torque.size(); ++i)
    if (scene.torque[i].control) controls.push_back({&*scene.torque[i].control, i, i + 1});
  return controls;
}

void say_once(std::vector<std::string>& list, const std::string& text) {
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

// A log of torques that begins behind the run's end has a clock of its own: as of a motion, t = 0 is its first row.
void set_clock(Scene& scene, Control& control, std::vector<double>& t) {
  const double first = t.front();
  if (control.outside || !(first >= scene.duration)) return;
  control.since_first_row = true;
  for (double& one : t) one -= first;
  say_once(scene.notices, "t = 0 is the first row of " + control.csv + ", whose '" + control.columns.time.name + "' is " + format_shortest(first) +
                              " s, behind the end of the run: `outside: hold` or zero beside the table takes its times as they stand");
}

bool is_meant(const std::optional<Outside>& outside) {
  return outside == Outside::hold || outside == Outside::zero;
}

// What a table of these instants is taken for beyond its ends.
void look_at_span(Scene& scene, const std::string& path, const std::vector<double>& t, const std::optional<Outside>& outside,
                  const std::string& what, const Place& place) {
  const bool late = t.front() > kSame * scene.duration, early = t.back() < (1 - kSame) * scene.duration;
  if (t.back() > kOtherUnit * scene.duration)
    say_once(scene.doubts, "the table " + path + " goes on until " + format_shortest(t.back()) + " s, of which the run of " + format_shortest(scene.duration) +
           " s sees the beginning: are its times in seconds?");
  if (!late && !early) return;
  const std::string span = "the table " + path + " speaks of " + format_shortest(t.front()) + " to " +
                           format_shortest(t.back()) + " s, but the run of 0 to " + format_shortest(scene.duration) + " s";
  if (outside == Outside::refuse)
    throw Error(ExitCode::bad_input,
                span + ", and `outside: refuse` stands there: take another duration or table, or outside: hold or zero",
                place);
  const std::string end = late && early ? "before and behind it" : late ? "before it" : "behind it";
  say_once(scene.notices, span + "; " + end + " " + what + " held: write `outside: hold` beside the table if it is meant, or zero, or refuse");
}

// Of the table of a motion that is followed.
void look_at_units(Scene& scene, const Chain& chain, const Table& table) {
  const TimeTable motion = time_table_of(table, {"q"}, chain.coordinate_names);
  if (motion.t.size() < 2 || motion.groups[0].empty()) return;
  for (const std::string& doubt : doubts_of_units(chain, table, motion, ColumnNames{}.time.name, false))
    say_once(scene.doubts, doubt);
}

void look_at_controls(Scene& scene, const Chain& chain) {
  for (const NamedControl& one : controls_of(scene, chain)) {
    Control& control = *one.control;
    const auto look = [&](const std::string& path, const std::optional<Outside>& outside, const std::string& what, bool is_log = false) {
      if (path.empty()) return;
      if (is_log && is_meant(outside)) return;
      const ColumnNames names = is_log ? control.columns : ColumnNames{};
      const Table table = read_table(path, names);
      if (!is_log) look_at_units(scene, chain, table);
      if (is_meant(outside)) return;
      std::vector<double> t = time_table_of(table, {}, chain.coordinate_names, names).t;
      if (is_log) set_clock(scene, control, t);
      look_at_span(scene, path, t, outside, what, control.place);
    };
    const std::string torque = "the torque of its nearest row is", pose = "the pose of its nearest row is";
    look(control.csv, control.outside, torque, true);
    look(control.inverse_of, control.outside, pose);
    for (const std::optional<Feedback>& feedback : {control.pd, control.computed_torque})
      if (feedback) look(feedback->trajectory, feedback->outside, pose);
    if (control.computed_torque && !scene.constraints.empty())
      say_once(scene.notices, "computed_torque takes M and h of the chain without its constraints: what these add disturbs it, by less the larger kp and kd are");
  }
}

// The state of the motions that give the torques, where there are any; of joints without one as it is.
bool take_motion(Scene& scene, const Chain& chain, std::vector<double>& q, std::vector<double>& qd,
                 std::string& path) {
  bool found = false;
  for (const NamedControl& one : controls_of(scene, chain)) {
    if (one.control->inverse_of.empty()) continue;
    found = true;
    path = one.control->inverse_of;
    std::vector<double> at(std::size_t(chain.nv)), rate(at), acceleration(at);
    make_table_reference(path, chain)->evaluate(0, at, rate, acceleration);
    for (std::size_t i = one.first; i < one.end; ++i) {
      q[i] = at[i];
      qd[i] = rate[i];
    }
  }
  return found;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

void take_start(Scene& scene, const Chain& chain) {
  if (chain.has_floating || chain.nq != chain.nv) return;
  std::vector<double> q = zero_configuration(chain), qd(std::size_t(chain.nv));
  const std::vector<double> zero = q;
  std::string path;
  if (!take_motion(scene, chain, q, qd, path)) return;
  const bool takes_q = scene.start.q.empty(), takes_qd = scene.start.qd.empty();
  if (takes_q) scene.start.q = q;
  if (takes_qd) scene.start.qd = qd;
  const double away = farthest(scene.start.q, q), faster = farthest(scene.start.qd, qd);
  if (away > kSame || faster > kSame)
    scene.notices.push_back("the start differs from that of the motion " + path + " by " + format_significant(away, 3) +
                            " in a coordinate and " + format_significant(faster, 3) +
                            " in a rate: the torques of that motion lead elsewhere from here");
  else if ((takes_q && farthest(q, zero) > kSame) || (takes_qd && farthest(qd, std::vector<double>(qd.size())) > kSame))
    scene.notices.push_back("starts as the motion " + path + " does: q = " + bracketed(q) + ", qd = " + bracketed(qd));
}

}  // namespace

void prepare_motion(Scene& scene, Simulation& simulation) {
  const MotionEntry& entry = *scene.motion;
  const auto motion = std::make_shared<const RecordedMotion>(simulation.chain, entry.table, entry.columns);
  const double end = motion->end();
  if (scene.duration > end * (1 + kSame)) {
    const Place place = scene.place_of("duration");
    throw Error(ExitCode::bad_input,
                "the motion " + entry.csv + " ends at " + format_shortest(end) + " s, and nothing is known of what comes behind: take a "
                "duration of at most that, or leave it out, which is all of it",
                place.line > 0 ? place : entry.place);
  }
  scene.duration = std::min(scene.duration, end);
  replay(simulation, motion);
  scene.start = StartState();
  scene.start.q = simulation.q0;
  scene.start.qd = simulation.qd0;
  scene.doubts.insert(scene.doubts.end(), motion->doubts().begin(), motion->doubts().end());
  if (const double first = entry.table->first; first != 0)
    scene.notices.push_back("t = 0 is the first row of " + entry.csv + ", whose '" + entry.columns.time.name + "' is " + format_shortest(first));
  for (std::string& remark : motion->remarks()) scene.notices.push_back(std::move(remark));
}

void prepare_tables(Scene& scene, const Chain& chain) {
  take_start(scene, chain);
  look_at_controls(scene, chain);
}

}  // namespace chainreel
