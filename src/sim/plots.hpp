// What plots show of a run: quantities with a name of their own, or expressions of what a probe reads, at the
// run's samples.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"
#include "expr/expression.hpp"
#include "sim/drive/probe.hpp"
#include "sim/system/trajectory.hpp"
#include "sim/watch/events.hpp"

namespace chainreel {

struct Simulation;

// Numbers that are no larger, in SI units, are the rounding of others, as of a place that constraints hold: "y_G - 0.7": nothing
// is judged by how they move.
inline constexpr double kRoundedZero = 1e-12;

enum class PlotQuantity {
  energy,        // kinetic, potential, of springs where there are, and their sum, J
  energy_error,  // E(t) - E(0) - work, J
  q,             // of each joint
  qd,
  tau,         // as the run felt them
  lambda,      // of each row of the constraints
  constraint_error,  // likewise, by how much it is missed
  effective_mass,    // at the end effector, along each axis of its ellipse, the largest first, kg; infinite at singular poses
  energy_speed,      // likewise, the speed at which it has 0.5 J, m/s, the largest first
  expression,  // one curve
};

enum class PlotScale { linear, log };
std::span<const Name> names_of(PlotScale);

// A plot as the scene wrote it.
struct PlotEntry {
  std::string value;  // a quantity's name, or an expression
  std::string title;  // of the axis, unit in brackets; "": the quantity's own, or the expression
  Place place;        // of `value`
  PlotScale scale = PlotScale::linear;  // of the numbers' axis
};

// The plots of a scene, ready for any number of runs.
struct PlotSet {
  struct Plot {
    PlotQuantity quantity = PlotQuantity::expression;
    std::string title;
    std::string formula;  // that a title made of an expression begins with; else ""
    std::optional<Expression> value;
    PlotScale scale = PlotScale::linear;
  };
  std::vector<Plot> list;
  Probe probe;
  bool needs_kinematics = false;
  GroundSlots load;  // in the probe, where there is a foot
  std::optional<Foot> foot;
  GroundAxes ground;
};

// The names of all but `expression`, which has none.
std::span<const Name> names_of(PlotQuantity);

// A quantity of joints with its unit as their kinds have it: "q [rad]", "q [m]", "q [rad, m]".
std::string with_joint_units(const std::string& words, const Chain& chain, const char* turning, const char* sliding);

// Null where there are none. `rows` of the constraints. Throws Error with every problem.
std::shared_ptr<const PlotSet> make_plots(const Chain& chain, const std::vector<PlotEntry>& entries,
                                          const Parameters& parameters, const NamedFrames& frames = {},
                                          const std::optional<Foot>& foot = {}, int rows = 0);

struct PlotCurve {
  std::string name;       // "q1", "kinetic"; of an expression ""
  std::vector<double> y;  // a number a sample; an effective mass may be infinite
  bool is_bound = false;  // what the others are held against
  double shown_low = -HUGE_VAL, shown_high = HUGE_VAL;  // what plots show of it, where it may run off to a pole
  int body = 0;           // whose coordinate, rate, torque or place it is; 0: of none, or of several
  double alone = 0;       // the largest size of samples that are left out as each stands far above all others: on a pole, or a needle
};
struct PlotCurves {
  PlotQuantity quantity = PlotQuantity::expression;
  std::string title;
  bool angles = false;  // radians: ticks at multiples of pi/2
  std::vector<PlotCurve> curves;
  std::string formula{};  // as PlotSet::Plot has it
  PlotScale scale = PlotScale::linear;
};

// One entry a plot, over the first `samples` samples.
std::vector<PlotCurves> plot_curves(const PlotSet& plots, const Simulation& simulation, const Trajectory& trajectory, int samples);
// The same of simulation.plots.
std::vector<PlotCurves> plot_curves(const Simulation& simulation, const Trajectory& trajectory, int samples);

// Of one of simulation.plots, an expression, the value at a sample.
double plot_value(const Simulation& simulation, std::size_t plot, const Trajectory& trajectory, int sample);

}  // namespace chainreel
