#include "sim/simulate.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/format.hpp"
#include "sim/chain_system.hpp"
#include "sim/step_span.hpp"
#include "sim/work.hpp"

namespace chainreel {
namespace {

// A coordinate or rate beyond this has left every machine that could be drawn.
constexpr double kDivergenceBound = 1e9;  // rad, m, rad/s, m/s
constexpr double kMostNumbers = 2.5e8;    // stored in one trajectory: 2 GB
constexpr double kSameInstant = 1e-9;     // of a step: two instants closer than this are one
constexpr long kStepsBetweenStopRequests = 4096;

// One run in progress.
class Run {
 public:
  Run(const Simulation& simulation, std::size_t samples)
      : simulation_(simulation),
        system_(simulation.chain, *simulation.torque, simulation.limit),
        stepper_(simulation.method->make(simulation.chain.nq, simulation.chain.nv)),
        q_(simulation.q0),
        qd_(simulation.qd0),
        span_(simulation.chain.nq, simulation.chain.nv),
        work_(simulation, system_) {
    // Whole steps, and a shorter last one where the duration is no multiple of the step.
    const double h = simulation.step;
    whole_steps_ = long(std::floor(simulation.duration / h + kSameInstant));
    remainder_ = simulation.duration - double(whole_steps_) * h;
    if (remainder_ <= kSameInstant * h) remainder_ = 0;
    breaks_ = simulation.torque->breaks();
    std::sort(breaks_.begin(), breaks_.end());
    trajectory_.nq = simulation.chain.nq;
    trajectory_.nv = simulation.chain.nv;
    reserve(samples);
  }

  bool at_end() const { return whole_ == whole_steps_ && (remainder_ == 0 || now_ == simulation_.duration); }
  long steps() const { return trajectory_.steps; }
  double now() const { return now_; }

  // False where the run ended in this step; its state is then not fit to be sampled.
  bool take_step() {
    const auto [end, h] = next_step();
    const double begin = now_;
    span_.begin(begin, q_, qd_);
    stepper_->step(system_, begin, h, q_, qd_);
    if (!check_state(begin, end)) return false;
    now_ = end;
    span_.end(system_, end, q_, qd_);
    work_.add_step(system_, span_, q_, qd_);
    ++trajectory_.steps;
    trajectory_.end_time = end;
    passed_limit_ = system_.limits().check_state(end, q_, qd_);
    return true;
  }

  void sample_start() { append(0, q_, qd_, 0); }
  void sample_end() { append(span_.end_time(), q_, qd_, work_.at_end()); }
  // t lies in the last step.
  void sample(double t) {
    if (std::abs(t - span_.end_time()) <= kSameInstant * simulation_.step)
      return append(t, q_, qd_, work_.at_end());
    span_.move_to(system_, t);
    const double work = work_.at(system_, span_, t);
    append(t, span_.q(), span_.v(), work);
  }

  // Where the scene stops at limits: the step that passed one is the last.
  bool stopped_by_limit() {
    if (!passed_limit_ || simulation_.limit != LimitPolicy::stop) return false;
    trajectory_.status = RunStatus::stopped;
    trajectory_.trouble = to_string(system_.limits().events().back());
    return true;
  }

  bool stop_requested(const StopRequest& stop) {
    if (!stop || steps() % kStepsBetweenStopRequests != 0 || !stop(now_)) return false;
    trajectory_.status = RunStatus::interrupted;
    trajectory_.trouble = "interrupted at t = " + format_shortest(now_) + " s";
    return true;
  }

  Trajectory finish() {
    trajectory_.evaluations = system_.evaluations();
    trajectory_.limits = system_.limits().events();
    return std::move(trajectory_);
  }

 private:
  struct NextStep {
    double end, h;
  };

  // The next multiple of the step, the duration, or a break of the torque law that comes first. A step from
  // multiple to multiple has the step's own length, so that it does not depend on where it stands.
  NextStep next_step() {
    const double step = simulation_.step, same = kSameInstant * step;
    while (next_break_ < breaks_.size() && breaks_[next_break_] <= now_ + same) ++next_break_;
    const bool last = whole_ == whole_steps_;
    const double grid = last ? simulation_.duration : double(whole_ + 1) * step;
    if (next_break_ < breaks_.size() && breaks_[next_break_] < grid - same) {
      on_grid_ = false;
      return {breaks_[next_break_], breaks_[next_break_] - now_};
    }
    const double h = on_grid_ ? (last ? remainder_ : step) : grid - now_;
    if (!last) ++whole_;
    on_grid_ = true;
    return {grid, h};
  }

  void reserve(std::size_t samples) {
    const std::size_t row = std::size_t(trajectory_.nq + trajectory_.nv + 2);
    if (double(samples) * double(row) > kMostNumbers)
      throw Error(ExitCode::limit, "this run would store more than " + format_shortest(kMostNumbers) +
                                       " numbers: take a shorter duration or fewer samples");
    trajectory_.t.reserve(samples);
    trajectory_.q.reserve(samples * std::size_t(trajectory_.nq));
    trajectory_.qd.reserve(samples * std::size_t(trajectory_.nv));
    trajectory_.work.reserve(samples);
  }

  void append(double t, ConstVec q, ConstVec qd, double work) {
    trajectory_.t.push_back(t);
    trajectory_.q.insert(trajectory_.q.end(), q.begin(), q.end());
    trajectory_.qd.insert(trajectory_.qd.end(), qd.begin(), qd.end());
    trajectory_.work.push_back(work);
  }

  bool check_state(double begin, double end) {
    const int torque = system_.bad_torque();
    if (torque >= 0) {
      set_trouble(RunStatus::torque_not_finite,
                  "the torque at joint '" + name(torque) + "' is not a finite number", begin);
      return false;
    }
    const auto sane = [](double x) { return std::abs(x) < kDivergenceBound; };  // false for NaN
    for (std::size_t i = 0; i < q_.size(); ++i)
      if (!sane(q_[i])) return diverge(int(std::min(i, qd_.size() - 1)), end);
    for (std::size_t i = 0; i < qd_.size(); ++i)
      if (!sane(qd_[i])) return diverge(int(i), end);
    return true;
  }

  bool diverge(int freedom, double t) {
    set_trouble(RunStatus::diverged, "diverged at joint '" + name(freedom) + "'", t);
    return false;
  }

  void set_trouble(RunStatus status, const std::string& what, double t) {
    trajectory_.status = status;
    trajectory_.trouble =
        what + " at t = " + format_shortest(t) + " s (step " + std::to_string(steps() + 1) + ")";
  }

  std::string name(int freedom) const { return simulation_.chain.coordinate_names[std::size_t(freedom)]; }

  const Simulation& simulation_;
  ChainSystem system_;
  std::unique_ptr<Stepper> stepper_;
  std::vector<double> q_, qd_;
  StepSpan span_;
  WorkIntegral work_;
  long whole_steps_ = 0;  // in the run
  double remainder_ = 0;  // s, after the whole steps
  long whole_ = 0;        // multiples of the step passed
  bool passed_limit_ = false;
  bool on_grid_ = true;  // now_ is such a multiple
  double now_ = 0;
  std::vector<double> breaks_;
  std::size_t next_break_ = 0;
  Trajectory trajectory_;
};

}  // namespace

std::string to_string(RunStatus status) {
  switch (status) {
    case RunStatus::finished:
      return "finished";
    case RunStatus::diverged:
      return "diverged";
    case RunStatus::torque_not_finite:
      return "torque_not_finite";
    case RunStatus::stopped:
      return "stopped";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "unknown";
}

Trajectory simulate(const Simulation& simulation, std::span<const double> times, const StopRequest& stop) {
  Run run(simulation, times.size());
  std::size_t next = 0;
  while (next < times.size() && times[next] <= 0) {
    run.sample_start();
    ++next;
  }
  while (!run.at_end() && !run.stopped_by_limit() && !run.stop_requested(stop) && run.take_step()) {
    const double end = run.now() + kSameInstant * simulation.step;
    while (next < times.size() && times[next] <= end) run.sample(times[next++]);
  }
  return run.finish();
}

Trajectory simulate_every_step(const Simulation& simulation, const StopRequest& stop) {
  Run run(simulation, std::size_t(simulation.duration / simulation.step) + 2);
  run.sample_start();
  while (!run.at_end() && !run.stopped_by_limit() && !run.stop_requested(stop) && run.take_step())
    run.sample_end();
  return run.finish();
}

}  // namespace chainreel
