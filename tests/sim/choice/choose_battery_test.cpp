// The promises of `method: auto` on random scenes whose torques have corners and jumps, against a judge that knows of
// none of them: RK4 whose steps are halved until halves agree, down to picoseconds. CHAINREEL_BATTERY=200 makes it as
// many, with a table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "core/error.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "sim/choice/choose_method.hpp"
#include "sim/choice/deviation.hpp"
#include "sim/runs.hpp"
#include "support/battery.hpp"

namespace chainreel {
namespace {

using test::CorneredScene;
using test::cornered_scene;

constexpr int kScenes = 30;
constexpr double kLongest = 1e-3, kShortest = 1e-12;  // s; the shortest push takes 2 ms
constexpr double kLocalError = 1e-12, kCoarserError = 1e-11;  // of a step

class Judge {
 public:
  Judge(const Simulation& run, double local_error)
      : run_(run), local_error_(local_error), ws_(run.chain), n_(std::size_t(run.chain.nv)), tau_(n_), vd_(n_) {}

  Trajectory at(const std::vector<double>& times) {
    Trajectory exact;
    exact.nq = exact.nv = int(n_);
    State y = run_.q0;
    y.insert(y.end(), run_.qd0.begin(), run_.qd0.end());
    double t = 0, h = kLongest;
    for (const double end : times) {
      while (t < end) t += step(t, std::min(h, end - t), y, h);
      exact.t.push_back(end);
      exact.q.insert(exact.q.end(), y.begin(), y.begin() + std::ptrdiff_t(n_));
      exact.qd.insert(exact.qd.end(), y.begin() + std::ptrdiff_t(n_), y.end());
    }
    return exact;
  }

 private:
  using State = std::vector<double>;

  State rate(double t, const State& y) {
    const std::span<const double> q(y.data(), n_), v(y.data() + n_, n_);
    run_.torque->evaluate(run_.chain, ws_, t, q, v, tau_);
    compute_forward_dynamics(run_.chain, ws_, q, v, tau_, vd_);
    State f(v.begin(), v.end());
    f.insert(f.end(), vd_.begin(), vd_.end());
    return f;
  }

  static State moved(const State& y, double h, const State& f) {
    State z = y;
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += h * f[i];
    return z;
  }

  State rk4(double t, double h, const State& y) {
    const State a = rate(t, y), b = rate(t + h / 2, moved(y, h / 2, a)), c = rate(t + h / 2, moved(y, h / 2, b)),
                d = rate(t + h, moved(y, h, c));
    State z = y;
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    return z;
  }

  // The length of the step that stands; `h` becomes that to try next.
  double step(double t, double length, State& y, double& h) {
    for (;; length /= 2) {
      const State whole = rk4(t, length, y), half = rk4(t + length / 2, length / 2, rk4(t, length / 2, y));
      double apart = 0;
      for (std::size_t i = 0; i < y.size(); ++i) apart = std::max(apart, std::abs(whole[i] - half[i]));
      if (apart > local_error_ && length > kShortest) continue;
      y = half;
      h = std::min(kLongest, 2 * length);
      return length;
    }
  }

  const Simulation& run_;
  double local_error_;
  Workspace ws_;
  std::size_t n_;
  State tau_, vd_;
};

// Where dry friction holds a joint, halving finds no end.
bool has_dry_friction(const CorneredScene& scene) {
  for (const std::string& torque : scene.torque)
    if (torque.find("(qd") != std::string::npos && torque.find("abs(qd") == std::string::npos) return true;
  return false;
}

struct Outcome {
  double error = 0, promise = 0;  // px
  double judge = 0;               // px, that the judge may be off itself
  std::string words;              // of a broken promise
  bool holds_to_the_end = false;

  // Instants of corners are known to 1e-13 s.
  bool is_broken() const { return error > 1.0001 * promise + judge; }
};

Outcome outcome_of(const CorneredScene& scene) {
  // What is judged: frames, what is halfway between, and the end.
  std::vector<double> frames, promised;
  for (int k = 0; k < 60 * scene.duration; ++k) frames.push_back(k / 60.0);
  Simulation run = run_of(scene.model, scene.torque, scene.duration);
  run.q0 = scene.q0, run.qd0 = scene.qd0;
  const Accuracy accuracy{0.1, AccuracyUnit::px};
  const Choice choice = choose_method(run, accuracy, frames);
  for (int k = 0; k <= 120 * scene.duration; ++k)
    if (!choice.holds_until || k / 120.0 <= *choice.holds_until) promised.push_back(k / 120.0);
  const int count = int(promised.size());
  const Trajectory exact = Judge(run, kLocalError).at(promised), coarser = Judge(run, kCoarserError).at(promised);
  Deviation deviation(run, accuracy, motion_size(run, exact));
  Outcome outcome;
  outcome.error = deviation.largest(simulate(run, promised), exact, count);
  outcome.promise = std::isfinite(choice.best.error) ? choice.best.error : accuracy.value;
  outcome.judge = 2 * deviation.largest(coarser, exact, count) + 1e-7;  // what stands almost still is rounded, too
  outcome.words = to_string(choice.best.setting) + " " + choice.why_until;
  outcome.holds_to_the_end = !choice.holds_until;
  return outcome;
}

struct Tally {
  int count = 0, broken = 0, until = 0, refused = 0;
  double worst = 0;
};

// A scene counts for each kind of torque that it has.
std::vector<std::string> kinds_of(const CorneredScene& scene) {
  std::vector<std::string> kinds;
  const auto add = [&](const char* mark, const char* word) {
    for (const std::string& torque : scene.torque)
      if (torque.find(mark) != std::string::npos) {
        kinds.push_back(word);
        return;
      }
  };
  add(")*(t<", "push");
  add(">=", "jump");
  add("min(1", "ramp");
  add("abs(t", "abs(t)");
  add("sin(", "half waves");
  add("-0.3) + min", "gap");
  add("max(-8", "cut feedback");
  add("abs(qd", "drag");
  return kinds;
}

TEST(ChooseBattery, BreaksNoPromiseOnScenesWithCorners) {
  const char* const asked = std::getenv("CHAINREEL_BATTERY");
  const int wanted = asked ? std::atoi(asked) : kScenes;
  std::map<std::string, Tally> table;
  int done = 0;
  for (std::uint64_t seed = 1; done < wanted; ++seed) {
    const CorneredScene scene = cornered_scene(seed);
    if (has_dry_friction(scene)) continue;
    ++done;
    Tally one{1};
    try {
      const Outcome outcome = outcome_of(scene);
      one.worst = (outcome.error - outcome.judge) / outcome.promise;
      one.broken = outcome.is_broken();
      one.until = !outcome.holds_to_the_end;
      EXPECT_FALSE(outcome.is_broken())
          << "seed " << seed << ": " << scene.text() << "\noff by " << outcome.error << " px, promised "
          << outcome.promise << ", the judge by " << outcome.judge << ": " << outcome.words;
    } catch (const Error& error) {
      one.refused = 1;
      ADD_FAILURE() << "seed " << seed << ": " << scene.text() << "\n" << error.what();
    }
    for (const std::string& kind : kinds_of(scene)) {
      Tally& tally = table[kind];
      tally.count += 1, tally.broken += one.broken, tally.until += one.until, tally.refused += one.refused;
      tally.worst = std::max(tally.worst, one.worst);
    }
  }
  if (!asked) return;
  std::printf("| kind of scene | count | promises broken | worst error/promise | held until only | refused |\n");
  for (const auto& [kind, tally] : table)
    std::printf("| %s | %d | %d | %.3f | %d | %d |\n", kind.c_str(), tally.count, tally.broken, tally.worst,
                tally.until, tally.refused);
}

}  // namespace
}  // namespace chainreel
