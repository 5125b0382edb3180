// Integrators of several projects behind one face, so that one text times them all: each takes a chain from
// its start to the end of the run at one rung of its ladder of tolerances or steps.
//
// Boost.odeint and CVODE are given our forward dynamics, the same calls that our own methods make: that is
// generous to them. odeint is timed with equations as its users write them, too. MuJoCo computes its own.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/simulate.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel::bench {

struct MotionProblem {
  std::string name;
  Simulation run;             // chain, start, torques, duration
  std::vector<double> q_end;  // exact
};

class EndFinder {
 public:
  EndFinder(std::string engine_name, std::vector<double> rungs_from_the_coarsest)
      : engine(std::move(engine_name)), rungs(std::move(rungs_from_the_coarsest)) {}
  virtual ~EndFinder() = default;
  // Coordinates at the end; NaN where the engine gives up.
  virtual std::vector<double> end_of(double rung) = 0;

  std::string engine;
  std::vector<double> rungs;
};

using EndFinders = std::vector<std::unique_ptr<EndFinder>>;

// 10^-first .. 10^-last, `each` a decade.
std::vector<double> decades(double first, double last, int each);

// By a method of ours: a ladder of tolerances where it is adaptive, else of steps.
std::unique_ptr<EndFinder> by_our_method(const MotionProblem& problem, const std::string& method, int order,
                                         std::vector<double> rungs);
void add_odeint(const MotionProblem& problem, EndFinders& all);
std::unique_ptr<EndFinder> by_cvode(const MotionProblem& problem, bool stiff, std::vector<double> rungs);
std::unique_ptr<EndFinder> by_mujoco(const MotionProblem& problem, std::vector<double> rungs);

std::string odeint_version();
std::string cvode_version();

}  // namespace chainreel::bench
