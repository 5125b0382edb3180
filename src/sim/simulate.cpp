#include "sim/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/machine.hpp"
#include "sim/drive/limits.hpp"
#include "sim/drive/recorded_motion.hpp"
#include "sim/headway.hpp"
#include "sim/sample_instants.hpp"
#include "sim/step_grid.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/system/forms.hpp"
#include "sim/torques_along.hpp"
#include "sim/watch/corner_watch.hpp"
#include "sim/watch/events.hpp"
#include "sim/watch/limit_search.hpp"
#include "sim/workload.hpp"

namespace chainreel {
namespace {

// A coordinate or rate beyond this has left every machine that could be drawn.
constexpr double kDivergenceBound = 1e9;  // rad, m, rad/s, m/s
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLongStep = 4;          // of the distance of instants between samples: curves show where longer steps end
constexpr double kBesideCorner = 1e-5;    // of the distance of instants between samples
constexpr double kMostNumbers = 2.5e8;    // stored in one trajectory: 2 GB
constexpr double kNumbersThatFit = 1e7;   // everywhere
constexpr double kLostConstraint = 1e-6;  // m or rad, behind a projection
// Corners of the state: how exactly steps end there, in s and units in the last place, and how often that is tried.
constexpr double kCutTolerance = 1e-13;
constexpr int kMostCuts = 12;
constexpr double kNearCut = 1e-6;  // of the step that ends there: good enough where no more can be had
// Evaluations times freedoms, and steps: a long run listens as soon as a short one, whatever its mechanism.
constexpr double kWorkBetweenStopRequests = 1 << 15;

// One run in progress.
class Run {
 public:
  Run(const Simulation& simulation, std::size_t samples)
      : simulation_(simulation),
        system_(simulation.chain, *simulation.torque, simulation.limit, simulation.constraints),
        constrained_(system_.constrained()),
        forms_(system_, *simulation.method),
        integrator_(simulation.motion ? make_player(simulation.motion, simulation.chain.nv)
                                      : make_integrator(*simulation.method, forms_.forms(), simulation.options)),
        grid_(simulation),
        q_(simulation.q0),
        qd_(simulation.qd0),
        work_(simulation, system_, integrator_->path_order()) {
    require_possible(simulation);
    if (system_.corners()) corners_.emplace(system_, simulation.duration, simulation.method->order <= 2);
    simulation.torque->enter_piece(grid_.middle_of_piece(0));
    settle_corners(0);
    for (int k = 0; corners_ && !chatters_ && k < system_.corners()->count(); ++k)
      trajectory_.start_sides.push_back(system_.corners()->side(k));
    look_at_limits_of_start();
    integrator_->start(0, q_, qd_);
    if (simulation.events && !simulation.events->list.empty()) watch_.emplace(*simulation.events, system_, std::max(simulation.duration, simulation.whole_duration));
    trajectory_.nq = simulation.chain.nq;
    trajectory_.nv = simulation.chain.nv;
    if (constrained_) trajectory_.rows = constrained_->set().rows();
    reserve(samples);
  }

  ~Run() { simulation_.torque->leave_pieces(); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  bool at_end() const { return grid_.at_end(now()); }
  long steps() const { return trajectory_.steps; }
  double now() const { return integrator_->time(); }

  // False where the run ended in this step; its state is then not fit to be sampled.
  bool take_step() {
    const double begin = now();
    if (constrained_ && steps() == 0 && !check_constraints(begin)) return false;
    if (chatters_) return blame_corner(begin);
    const std::optional<StepGrid::Next> moved = corners_ ? step_to_corner(begin) : step_on(begin);
    if (!moved) return false;
    const StepGrid::Next next = *moved;
    if (constrained_ && !settle()) return false;
    system_.forget_bad_torque();
    if (!simulation_.motion_only)
      work_.add_step(system_, *integrator_, q_now());
    else if (!work_.is_free())  // who asks for the inside of a step pays for it: as many evaluations as with the work
      integrator_->interpolate(0.5 * (begin + now()), q_, qd_);
    ++trajectory_.steps;
    trajectory_.end_time = now();
    if (watch_ && !look_for_events()) return false;
    look_at_limits();
    start_anew_ = next.is_break && now() == next.end;
    return makes_headway();
  }

  // Behind a break of the torques what the method remembers of them is old, and so is the state that it has
  // where that was projected. Called when the samples of the last step have been taken.
  void pass_break() {
    if (!start_anew_ && projected_) integrator_->correct(q_end_, qd_end_);
    if (!start_anew_) return;
    remember_state();
    grid_.forget_cut();
    simulation_.torque->enter_piece(grid_.middle_of_piece(now()));
    settle_corners(now());
    integrator_->start(now(), q_, qd_);
    start_anew_ = false;
  }

  bool stands_at_break() const { return start_anew_; }

  // The rest of the last step is no part of the run then: it ended at end_time.
  bool ended_early() const { return trajectory_.status == RunStatus::stopped; }
  double end_time() const { return trajectory_.end_time; }
  void sample_event() {
    const double same = same_instant(simulation_);
    if (trajectory_.t.empty() || trajectory_.t.back() < end_time() - same) sample(end_time());
  }

  void sample_start() { append(0, simulation_.q0, simulation_.qd0, 0); }
  void show(const StepObserver& observer) const { observer(now(), q_now(), qd_now(), work_.at_end()); }
  void sample_end() { append(now(), q_now(), qd_now(), work_.at_end()); }
  // t lies in the last step.
  void sample(double t) {
    if (std::abs(t - now()) <= same_instant(simulation_))
      return append(t, q_now(), qd_now(), work_.at_end());
    place_at(t);
    append(t, q_, qd_, simulation_.motion_only ? 0 : work_.at(system_, *integrator_, t, q_));
  }

  // t lies in the last step. Nothing that is told of the run depends on it. The samples are kept beside it from the first such instant on.
  void sample_between(double t) {
    if (!between_) {
      between_.emplace();
      between_->t = trajectory_.t, between_->q = trajectory_.q, between_->qd = trajectory_.qd, between_->work = trajectory_.work;
    }
    const long evaluations = system_.evaluations();
    place_at(t);
    append_to(*between_, t, q_, qd_, std::numeric_limits<double>::quiet_NaN());
    evaluations_between_ += system_.evaluations() - evaluations;
  }

  bool stop_requested(const StopRequest& stop) {
    if (simulation_.most_evaluations > 0 && system_.evaluations() >= simulation_.most_evaluations) {
      trajectory_.status = RunStatus::out_of_budget;
      trajectory_.trouble = "took the " + std::to_string(simulation_.most_evaluations) +
                            " evaluations that it was given until t = " + format_significant(now(), 6) + " s";
      return true;
    }
    const double work = double(system_.evaluations()) * simulation_.chain.nv + double(steps());
    if (!stop || work < next_request_) return false;
    next_request_ = work + kWorkBetweenStopRequests;
    if (!stop(now())) return false;
    trajectory_.status = RunStatus::interrupted;
    trajectory_.trouble = "interrupted at t = " + format_shortest(now()) + " s";
    return true;
  }

  Trajectory finish() {
    trajectory_.evaluations = system_.evaluations() - evaluations_between_;
    if (between_) {
      Trajectory& between = *between_;
      between.nq = trajectory_.nq, between.nv = trajectory_.nv, between.rows = trajectory_.lambda.empty() ? 0 : trajectory_.rows;
      between.holds = trajectory_.holds;
      if (between.rows > 0) between.lambda = multipliers_along(simulation_, between);
      trajectory_.between = std::make_shared<const Trajectory>(std::move(between));
    }
    return std::move(trajectory_);
  }

 private:
  void reserve(std::size_t samples) {
    const std::size_t row = std::size_t(trajectory_.nq + trajectory_.nv + trajectory_.rows + 2);
    const double numbers = double(samples) * double(row);
    if (numbers > kMostNumbers)
      throw Error(ExitCode::limit, "this run would store " + format_significant(numbers, 3) + " numbers, more than " +
                                       format_shortest(kMostNumbers) + ": take a shorter duration or fewer samples");
    if (numbers > kNumbersThatFit)
      require_memory(numbers * sizeof(double), "a run of " + std::to_string(samples) + " samples");
    trajectory_.t.reserve(samples);
    trajectory_.q.reserve(samples * std::size_t(trajectory_.nq));
    trajectory_.qd.reserve(samples * std::size_t(trajectory_.nv));
    trajectory_.work.reserve(samples);
    trajectory_.lambda.reserve(samples * std::size_t(trajectory_.rows));
  }

  // The state at t, in the last step.
  void place_at(double t) {
    integrator_->interpolate(t, q_, qd_);
    if (projected_) constrained_->project_sample(system_.workspace(), q_, qd_);
  }

  static void append_to(Trajectory& trajectory, double t, ConstVec q, ConstVec qd, double work) {
    trajectory.t.push_back(t);
    trajectory.q.insert(trajectory.q.end(), q.begin(), q.end());
    trajectory.qd.insert(trajectory.qd.end(), qd.begin(), qd.end());
    trajectory.work.push_back(work);
  }

  void append(double t, ConstVec q, ConstVec qd, double work) {
    append_to(trajectory_, t, q, qd, work);
    if (between_) append_to(*between_, t, q, qd, work);
    if (constrained_ && !simulation_.motion_only) append_multipliers(t, q, qd);
  }

  // At a break they are, as torques and accelerations are told, those from there on.
  void append_multipliers(double t, ConstVec q, ConstVec qd) {
    const bool is_behind = start_anew_ && t >= now();
    if (is_behind) simulation_.torque->leave_pieces();
    const auto look = constrained_->look(system_.workspace(), q, qd, system_.applied_torque(t, q, qd));
    if (is_behind) simulation_.torque->enter_piece(grid_.middle_of_piece(integrator_->begin_time()));
    const ConstVec lambda = constrained_->lambda();
    trajectory_.lambda.insert(trajectory_.lambda.end(), lambda.begin(), lambda.end());
    trajectory_.position_error = std::max(trajectory_.position_error, look.position_error);
    trajectory_.velocity_error = std::max(trajectory_.velocity_error, look.velocity_error);
  }

  std::optional<StepGrid::Next> step_on(double begin) {
    const StepGrid::Next next = grid_.next(begin);
    if (!check_result(integrator_->step(next.end, next.h), begin) || !check_state(begin, now())) return {};
    return next;
  }

  // A step within which no corner of the torques leaves its side: one that does is taken again up to there,
  // until it ends there.
  std::optional<StepGrid::Next> step_to_corner(double begin) {
    remember_state();
    for (int cuts = 0;; ++cuts) {
      const std::optional<StepGrid::Next> next = step_on(begin);
      if (!next) return {};
      const bool arrived = grid_.is_cut() && next->is_break && now() == next->end;
      const double tolerance = std::max(kCutTolerance, 8e-16 * now());
      std::optional<double> cut = corners_->first_crossing(*integrator_, q_, qd_);
      if (cut && now() - *cut <= tolerance && arrived) cut.reset();
      if (!cut && arrived && cuts < kMostCuts) {
        const double off = corners_->off_by(now(), integrator_->q(), integrator_->v());
        if (std::abs(off) > tolerance && std::abs(off) < 0.5 * (now() - begin)) cut = now() + off;
      }
      if (cut && arrived && cuts >= kMostCuts && now() - *cut <= kNearCut * (now() - begin)) cut.reset();
      if (!cut) return next;
      if (cuts > 0 && cuts % (2 * kMostCuts) == 0 && !corners_->rests_at_bends(begin, q_, qd_)) return blame_corner(begin), std::nullopt;
      system_.forget_bad_torque();
      if (*cut <= begin + std::max(grid_.same(), tolerance)) {  // it has no length: the corner is here
        grid_.cut_at(kNever);
        settle_corners(begin);
        if (chatters_) return blame_corner(begin), std::nullopt;
      } else {
        grid_.cut_at(*cut);
      }
      integrator_->start(begin, q_, qd_);
    }
  }

  void settle_corners(double t) {
    if (!corners_) return;
    chatters_ = !corners_->settle(t, q_, qd_);
    if (!trajectory_.holds.empty() && trajectory_.holds.back().end == kNever) trajectory_.holds.back().end = t;
    if (corners_->is_holding()) trajectory_.holds.push_back({t, kNever, system_.held()});
  }

  bool blame_corner(double t) {
    set_trouble(RunStatus::chattering,
                "the torque `" + corners_->culprit() +
                    "` jumps to and fro without end: smooth its corner, as tanh(x/0.01) smooths a sign",
                t);
    return false;
  }

  // The state at the last step's end into that of samples.
  void remember_state() {
    const ConstVec q = q_now(), qd = qd_now();
    std::copy(q.begin(), q.end(), q_.begin());
    std::copy(qd.begin(), qd.end(), qd_.begin());
  }

  // The state at the end of the last step.
  ConstVec q_now() const { return projected_ ? ConstVec(q_end_) : integrator_->q(); }
  ConstVec qd_now() const { return projected_ ? ConstVec(qd_end_) : integrator_->v(); }

  bool makes_headway() {
    if (simulation_.step > 0) return true;
    const double done = headway_.hopeless(steps(), now(), simulation_.duration);
    if (done == 0) return true;
    set_trouble(RunStatus::step_too_small,
                "the last " + std::to_string(Headway::kSteps) + " steps came forward by " + format_significant(done, 3) + " s: " +
                    (constrained_ ? "the constraints are singular near this pose, as of a chain stretched out along them"
                                  : "the tolerance is too small for this motion, or a stiff part needs an implicit method"),
                now());
    return false;
  }

  // After a step under constraints: back onto them, and whether they can be met there.
  bool settle() {
    if (constrained_->projects()) {
      q_end_.assign(integrator_->q().begin(), integrator_->q().end());
      qd_end_.assign(integrator_->v().begin(), integrator_->v().end());
      projected_ = true;
      const Projection way = constrained_->project(system_.workspace(), q_end_, qd_end_);
      if (!(way.after <= kLostConstraint)) {
        set_trouble(RunStatus::constraint_lost,
                    "constraint '" + row_name(way.worst_row) + "' was lost by " +
                        format_significant(way.after, 3) + ", and no way led back",
                    now());
        return false;
      }
    }
    return !constrained_->take_suspicion() || check_constraints(now());
  }

  bool check_constraints(double t) {
    const auto unmet = constrained_->unmet(system_.workspace(), q_now(), qd_now(), system_.applied_torque(t, q_now(), qd_now()));
    if (!unmet || system_.bad_torque() >= 0) return true;
    set_trouble(RunStatus::inconsistent,
                "constraints contradict each other: no acceleration fulfils '" + row_name(unmet->row) +
                    "', the nearest misses it by " + format_significant(unmet->residual, 3),
                t);
    return false;
  }

  std::string row_name(int row) const { return constrained_->set().row_names()[std::size_t(row)]; }

  // The state decides: a torque that was no number in an attempt that was rejected does no harm.
  bool check_state(double begin, double end) {
    const int wild = wild_freedom();
    if (wild < 0) return true;
    if (system_.bad_torque() >= 0) return blame_torque(begin);
    set_trouble(RunStatus::diverged, "diverged at joint '" + name(wild) + "'", end);
    return false;
  }

  // The first freedom whose numbers have left all bounds, or -1.
  int wild_freedom() const {
    const auto sane = [](double x) { return std::abs(x) < kDivergenceBound; };  // false for NaN
    const ConstVec q = integrator_->q(), qd = integrator_->v();
    for (std::size_t i = 0; i < q.size(); ++i)
      if (!sane(q[i])) return int(std::min(i, qd.size() - 1));
    for (std::size_t i = 0; i < qd.size(); ++i)
      if (!sane(qd[i])) return int(i);
    return -1;
  }

  bool look_for_events() {
    const bool good = (steps() > 1 || watch_->start(0, simulation_.q0, simulation_.qd0, trajectory_.events)) &&
                      watch_->check_step(*integrator_, trajectory_.events);
    system_.forget_bad_torque();
    if (!good) {
      const Event& event = simulation_.events->list[std::size_t(watch_->bad_event())];
      set_trouble(RunStatus::event_not_finite, "the event '" + event.name + "' is not a finite number", watch_->bad_instant());
      return false;
    }
    if (!watch_->has_ended()) return true;
    const EventHits& hits = trajectory_.events;
    trajectory_.ending_event = hits.event.back();
    trajectory_.end_time = hits.t.back();
    trajectory_.status = RunStatus::stopped;
    trajectory_.trouble = simulation_.events->list[std::size_t(hits.event.back())].name +
                          " at t = " + format_significant(hits.t.back(), 6) + " s";
    return true;
  }

  // Limits that were passed in the last step, up to where the run ended; the first one ends it where the scene
  // stops at limits. An effort may be asked for in an attempt or at a stage alone: then it is looked for on.
  void look_at_limits() {
    // A swing may pass a limit and come back within a long step; of short ones their ends are near enough to tell where it may.
    constexpr double kShort = 1.0 / 2048;  // of the run
    if (!system_.limits().are_none()) limit_search_.look_within(*integrator_, simulation_.step > 0 && simulation_.step < kShort * simulation_.duration ? 1 : kLooksPerStep);
    system_.limits().check_state(now(), q_now(), qd_now());
    const std::vector<LimitEvent>& seen = system_.limits().events();
    while (limits_seen_ < seen.size()) seen_limits_.push_back(seen[limits_seen_++]);
    if (seen_limits_.empty()) return;
    std::vector<LimitEvent> passed;
    std::erase_if(seen_limits_, [&](const LimitEvent& one) {
      const std::optional<LimitEvent> found = first_passing(one, system_, *integrator_);
      if (found && found->t <= end_time()) passed.push_back(*found);
      return found.has_value();
    });
    system_.forget_bad_torque();
    report(std::move(passed));
  }

  void look_at_limits_of_start() {
    if (system_.limits().are_none()) return;
    system_.limits().check_state(0, q_, qd_);
    system_.torque(0, q_, qd_);
    system_.forget_bad_torque();
    limits_seen_ = system_.limits().events().size();
    report(system_.limits().events());
  }

  void report(std::vector<LimitEvent> passed) {
    std::stable_sort(passed.begin(), passed.end(), [](const LimitEvent& a, const LimitEvent& b) { return a.t < b.t; });
    for (const LimitEvent& one : passed) {
      trajectory_.limits.push_back(one);
      if (simulation_.limit != LimitPolicy::stop) continue;
      trajectory_.status = RunStatus::stopped;
      trajectory_.trouble = to_string(one);
      trajectory_.end_time = one.t;
      trajectory_.ending_event = -1;  // it comes before the event that would have ended the run, if one would
      return;
    }
  }

  bool check_result(StepResult result, double begin) {
    if (result == StepResult::ok) return true;
    if (system_.bad_torque() >= 0) return blame_torque(begin);
    if (corners_ && corners_->changed_before(begin)) return blame_corner(begin);
    // What makes steps small is most often the joint that moves fastest.
    const ConstVec qd = integrator_->v();
    const auto slower = [](double x, double y) { return std::abs(x) < std::abs(y); };
    const std::string fastest = "; the fastest joint is '" + name(int(std::max_element(qd.begin(), qd.end(), slower) - qd.begin())) + "'" +
                                (constrained_ ? "; or the constraints are singular near this pose, as of a chain stretched out along them" : "");
    const bool is_implicit = result == StepResult::not_converged;
    set_trouble(is_implicit ? RunStatus::not_converged : RunStatus::step_too_small,
                (is_implicit ? "the implicit equations of a step found no solution" : "no step was small enough for the tolerance") + fastest, begin);
    return false;
  }

  bool blame_torque(double t) {
    set_trouble(RunStatus::torque_not_finite, "the torque at joint '" + name(system_.bad_torque()) + "' is not a finite number", t);
    return false;
  }

  void set_trouble(RunStatus status, const std::string& what, double t) {
    trajectory_.status = status;
    trajectory_.trouble = what + " at t = " + format_significant(t, 12) + " s (step " + std::to_string(steps() + 1) + ")";
  }

  std::string name(int freedom) const { return simulation_.chain.coordinate_names[std::size_t(freedom)]; }

  const Simulation& simulation_;
  ChainSystem system_;
  ConstrainedChain* constrained_;  // null: none
  ChainForms forms_;
  std::unique_ptr<Integrator> integrator_;
  StepGrid grid_;
  std::vector<double> q_, qd_;          // of a sample
  std::vector<double> q_end_, qd_end_;  // the last step's end, on the constraints
  bool projected_ = false;              // so that these two hold
  WorkIntegral work_;
  std::optional<EventWatch> watch_;
  std::optional<CornerWatch> corners_;  // of the state
  bool chatters_ = false;               // they jump to and fro without end
  LimitSearch limit_search_{system_};
  std::size_t limits_seen_ = 0;            // by the watch, of its list
  std::vector<LimitEvent> seen_limits_;    // but not found on a step yet
  double next_request_ = 0;  // the work at which the next stop request is asked
  bool start_anew_ = false;
  Headway headway_;
  Trajectory trajectory_;
  std::optional<Trajectory> between_;  // these samples and what lies between, where anything does
  long evaluations_between_ = 0;
};

}  // namespace

Trajectory simulate(const Simulation& simulation, std::span<const double> times, const StopRequest& stop,
                    const StepObserver& observer, double between) {
  check_ready(simulation, times);
  if (between >= distance_of(times)) between = 0;  // of long films samples are nearer to one another
  Run run(simulation, times.size());
  SampleInstants instants(times, between, std::max(kBesideCorner * between, 4 * same_instant(simulation)));
  while (instants.next(0)) run.sample_start();
  while (!run.at_end() && !run.ended_early() && !run.stop_requested(stop) && run.take_step()) {
    const double end = run.end_time() + same_instant(simulation);
    if (run.stands_at_break()) instants.corner_at(run.now());
    if (between > 0 && simulation.step > kLongStep * between) instants.look_at(run.end_time());
    while (const auto instant = instants.next(end)) instant->is_sample ? run.sample(instant->t) : run.sample_between(instant->t);
    if (run.ended_early()) {
      if (instants.has_samples()) run.sample_event();
      break;
    }
    if (observer) run.show(observer);
    run.pass_break();
  }
  return run.finish();
}

Trajectory simulate_every_step(const Simulation& simulation, const StopRequest& stop) {
  check_ready(simulation);
  Run run(simulation, std::size_t(std::min(steps_of(simulation), kMostNumbers)) + 2);
  run.sample_start();
  while (!run.at_end() && !run.ended_early() && !run.stop_requested(stop) && run.take_step()) {
    if (run.ended_early()) {
      run.sample_event();
      break;
    }
    run.sample_end();
    run.pass_break();
  }
  return run.finish();
}

}  // namespace chainreel
