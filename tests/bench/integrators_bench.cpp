// The time that integrators take to reach an error: ours beside Boost.odeint, CVODE and MuJoCo.
//
// Problems (gravity 9.81 m/s^2 along -y): A, the chain of models/rr.urdf from rest at (0, 0) without torque
// over 10 s; D, three rods from rest at 0 under (10, 10, 10) over 0.5 s; S, A with a spring of 1e6 N m/rad
// and a damper of 1e3 N m s/rad in the second joint, which starts at 0.1, over 1 s. The error is the largest
// of the coordinates' at the end, against quadruple precision.
//
// Rule: each engine has one ladder of tolerances or steps. Untimed, each rung's error is found; for each goal
// the two rungs that enclose it for good are then timed, all engines in turn, round after round. The time to
// the goal lies between the two, in logarithms. Reported are medians over the rounds of these times, and of
// their ratios to ours within a round. Only the way from start to end is timed; memory is taken before.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <stdexcept>

#include "bench/integrator_engines.hpp"
#include "bench/results.hpp"
#include "core/format.hpp"
#include "model/read_chain.hpp"
#include "sim/choice/quad_reference.hpp"

namespace chainreel::bench {
namespace {

constexpr int kRounds = 15;
constexpr double kLeastTime = 2e-4;  // s: shorter runs are repeated within one measurement

MotionProblem problem_of(const std::string& name, const std::string& model,
                         const std::vector<std::string>& torque, std::vector<double> q0, double end) {
  MotionProblem problem;
  problem.name = name;
  Simulation& run = problem.run;
  run.chain = read_chain(CHAINREEL_SOURCE_FOLDER "/models/" + model + ".urdf");
  run.q0 = std::move(q0);
  run.qd0.resize(run.q0.size());
  std::vector<TorqueEntry> entries(torque.size());
  for (std::size_t i = 0; i < torque.size(); ++i) entries[i].text = torque[i];
  run.torque = make_torque_law(run.chain, entries, {});
  run.duration = end;
  const auto reference = quad_reference(run, std::vector{end});
  if (!reference || reference->uncertainty[0] > 1e-14) throw std::runtime_error("no reference of " + name);
  problem.q_end = reference->q;
  return problem;
}

double error_of(const std::vector<double>& q, const MotionProblem& problem) {
  double largest = 0;
  for (std::size_t i = 0; i < problem.q_end.size(); ++i) {
    const double error = i < q.size() ? std::abs(q[i] - problem.q_end[i]) : NAN;
    if (!(error <= largest)) largest = error;
    if (std::isnan(error)) return std::numeric_limits<double>::infinity();
  }
  return largest;
}

double seconds_of(EndFinder& finder, double rung) {
  for (int repeats = 1;; repeats *= 4) {
    const double begin = processor_seconds();
    for (int k = 0; k < repeats; ++k) finder.end_of(rung);
    const double seconds = processor_seconds() - begin;
    if (seconds >= kLeastTime) return seconds / repeats;
  }
}

// The rungs around a goal: `fine` and the next finer one reach it, `coarse` does not. Only one, where the
// coarsest rung reaches it.
struct Enclosure {
  double goal = 0;
  double coarse = 0, coarse_error = 0, fine = 0, fine_error = 0;

  double seconds(EndFinder& finder) const {
    const double fine_seconds = seconds_of(finder, fine);
    if (coarse == 0) return fine_seconds;
    const double coarse_seconds = seconds_of(finder, coarse);
    const double part = std::log(coarse_error / goal) / std::log(coarse_error / fine_error);
    return coarse_seconds * std::pow(fine_seconds / coarse_seconds, part);
  }
};

std::vector<Enclosure> enclosures_of(EndFinder& finder, const MotionProblem& problem,
                                     const std::vector<double>& goals) {
  std::vector<double> errors;
  const double finest_goal = *std::min_element(goals.begin(), goals.end());
  for (const double rung : finder.rungs) {
    errors.push_back(error_of(finder.end_of(rung), problem));
    const std::size_t last = errors.size() - 1;
    if (last > 0 && errors[last] <= finest_goal && errors[last - 1] <= finest_goal) break;
  }
  std::vector<Enclosure> enclosures;
  for (const double goal : goals) {
    for (std::size_t k = 0; k < errors.size(); ++k) {
      if (errors[k] > goal || (k + 1 < errors.size() && errors[k + 1] > goal)) continue;
      Enclosure one{goal, 0, 0, finder.rungs[k], errors[k]};
      if (k > 0) one.coarse = finder.rungs[k - 1], one.coarse_error = errors[k - 1];
      enclosures.push_back(one);
      break;
    }
  }
  return enclosures;
}

struct Timed {
  EndFinder* finder;
  Enclosure enclosure;
  std::vector<double> seconds;
};

// How many times longer than ours the best of a kind of engines ought to take.
struct Aim {
  std::string problem, kind;
  double goal, ratio;
};
const std::vector<Aim> kAims = {
    {"A", "odeint", 1e-9, 5},       {"D", "odeint", 1e-9, 3.5}, {"A", "CVODE Adams", 1e-9, 150},
    {"D", "CVODE Adams", 1e-9, 70}, {"A", "MuJoCo", 1e-3, 150}, {"A", "MuJoCo", 1e-9, 1200},
    {"D", "MuJoCo", 1e-3, 120},     {"D", "MuJoCo", 1e-9, 400}, {"S", "CVODE BDF", 1e-6, 4},
};

class Comparison {
 public:
  Comparison(const MotionProblem& problem, EndFinders finders, const std::vector<double>& goals)
      : problem_(problem), finders_(std::move(finders)), goals_(goals) {
    for (const auto& finder : finders_)
      for (const Enclosure& enclosure : enclosures_of(*finder, problem, goals))
        timed_.push_back({finder.get(), enclosure, {}});
  }

  void run() {
    for (int round = 0; round < kRounds; ++round)
      for (Timed& timed : timed_) timed.seconds.push_back(timed.enclosure.seconds(*timed.finder));
  }

  void report(Results& results) const {
    for (const double goal : goals_) {
      const Timed* const ours = best_of("chainreel", goal);
      for (const Timed& timed : timed_) {
        if (timed.enclosure.goal != goal) continue;
        const std::string ratio = ours ? format_fixed(ratio_to(timed, *ours), 2) : "";
        const std::string aim = aim_of(timed, goal);
        std::printf("%s %-8s %-24s %12.1f us  ratio %8s %s\n", problem_.name.c_str(),
                    format_shortest(goal).c_str(), timed.finder->engine.c_str(),
                    median_of(timed.seconds) * 1e6, ratio.c_str(),
                    aim.empty() ? "" : ("goal " + aim).c_str());
        results.add({problem_.name, format_shortest(goal), timed.finder->engine,
                     format_significant(timed.enclosure.fine, 3),
                     format_significant(timed.enclosure.fine_error, 2),
                     format_fixed(median_of(timed.seconds) * 1e6, 2), ratio, aim});
      }
    }
  }

 private:
  static double ratio_to(const Timed& timed, const Timed& ours) {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < timed.seconds.size(); ++k)
      ratios.push_back(timed.seconds[k] / ours.seconds[k]);
    return median_of(ratios);
  }

  // The fastest engine whose name starts so.
  const Timed* best_of(const std::string& kind, double goal) const {
    const Timed* best = nullptr;
    for (const Timed& timed : timed_)
      if (timed.enclosure.goal == goal && timed.finder->engine.starts_with(kind) &&
          (!best || median_of(timed.seconds) < median_of(best->seconds)))
        best = &timed;
    return best;
  }

  std::string aim_of(const Timed& timed, double goal) const {
    for (const Aim& aim : kAims)
      if (aim.problem == problem_.name && aim.goal == goal && best_of(aim.kind, goal) == &timed)
        return format_shortest(aim.ratio);
    return "";
  }

  const MotionProblem& problem_;
  EndFinders finders_;
  std::vector<double> goals_;
  std::vector<Timed> timed_;
};

// Steps that divide the duration: 1, 2, 5, 10 .. parts of a tenth of a second.
std::vector<double> steps_down_to(double least) {
  std::vector<double> steps;
  for (double decade = 0.1; decade > 0.5 * least; decade /= 10)
    for (const double part : {1.0, 2.0, 5.0})
      if (decade / part > 0.99 * least) steps.push_back(decade / part);
  return steps;
}

void compare_smooth(const MotionProblem& problem, Results& results) {
  EndFinders finders;
  for (const int order : {12, 16, 20, 24})
    finders.push_back(by_our_method(problem, "taylor", order, decades(1, 15, 2)));
  finders.push_back(by_our_method(problem, "dop853", 0, decades(2, 15, 2)));
  finders.push_back(by_our_method(problem, "rk4", 0, steps_down_to(1e-4)));
  add_odeint(problem, finders);
  finders.push_back(by_cvode(problem, false, decades(3, 14, 2)));
  finders.push_back(by_mujoco(problem, steps_down_to(2e-5)));
  Comparison comparison(problem, std::move(finders), {1e-3, 1e-6, 1e-9});
  comparison.run();
  comparison.report(results);
}

void compare_stiff(const MotionProblem& problem, Results& results) {
  EndFinders finders;
  finders.push_back(by_our_method(problem, "radau5", 0, decades(3, 12, 2)));
  finders.push_back(by_our_method(problem, "dop853", 0, decades(3, 12, 2)));
  finders.push_back(by_cvode(problem, true, decades(3, 12, 2)));
  Comparison comparison(problem, std::move(finders), {1e-6});
  comparison.run();
  comparison.report(results);
}

void run() {
  Results results("integrators", {"problem", "error", "engine", "finer_rung", "its_error", "median_us",
                                  "ratio_to_ours", "goal"});
  results.note("odeint", odeint_version() + ", with our forward dynamics, and with equations by hand");
  results.note("CVODE", cvode_version() + ", with our forward dynamics");
  results.note("ratio", "to the fastest of ours at the same error");
  compare_smooth(problem_of("A", "rr", {"0", "0"}, {0, 0}, 10), results);
  compare_smooth(problem_of("D", "rrr", {"10", "10", "10"}, {0, 0, 0}, 0.5), results);
  compare_stiff(problem_of("S", "rr", {"0", "-1e6*q2 - 1e3*qd2"}, {0, 0.1}, 1), results);
  results.write();
}

}  // namespace
}  // namespace chainreel::bench

int main() {
  try {
    chainreel::bench::run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
