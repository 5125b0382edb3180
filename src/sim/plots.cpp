#include "sim/plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/format.hpp"
#include "sim/audit.hpp"
#include "sim/drive/probe.hpp"
#include "sim/instant.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {
namespace {

// Titles of plots whose units come with the constraints.
const std::string kMultipliers = "lambda", kMissed = "constraint error";

// "lambda [N, N m]", "constraint error [m]".
std::string with_row_units(const std::string& title, const Simulation& simulation) {
  std::vector<std::string> units;
  for (const RowUnits& row : row_units(simulation.chain, simulation.constraints.list)) {
    const std::string& unit = title == kMultipliers ? row.multiplier : row.error;
    if (!unit.empty() && std::find(units.begin(), units.end(), unit) == units.end()) units.push_back(unit);
  }
  return units.empty() ? title : title + " [" + joined(units) + "]";
}

// Whether all joints turn, or all slide: what their numbers are.
enum class JointUnits { turning, sliding, both };

JointUnits units_of(const Chain& chain) {
  bool turns = false, slides = false;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const JointKind kind = chain.bodies[i].joint.kind;
    turns |= kind != JointKind::prismatic;
    slides |= kind != JointKind::revolute;
  }
  return turns && slides ? JointUnits::both : slides ? JointUnits::sliding : JointUnits::turning;
}

std::string with_unit(const std::string& words, JointUnits units, const char* turning, const char* sliding) {
  switch (units) {
    case JointUnits::turning:
      return words + " [" + turning + "]";
    case JointUnits::sliding:
      return words + " [" + sliding + "]";
    case JointUnits::both:
      break;
  }
  return words + " [" + turning + ", " + sliding + "]";
}

}  // namespace

std::string with_joint_units(const std::string& words, const Chain& chain, const char* turning, const char* sliding) {
  return with_unit(words, units_of(chain), turning, sliding);
}

namespace {

std::string title_of(PlotQuantity quantity, const Chain& chain) {
  const JointUnits units = units_of(chain);
  switch (quantity) {
    case PlotQuantity::energy:
      return "energy [J]";
    case PlotQuantity::energy_error:
      return "energy error [J]";
    case PlotQuantity::q:
      return with_unit("q", units, "rad", "m");
    case PlotQuantity::qd:
      return with_unit("qd", units, "rad/s", "m/s");
    case PlotQuantity::tau:
      return with_unit("tau", units, "N m", "N");
    case PlotQuantity::lambda:
      return kMultipliers;
    case PlotQuantity::constraint_error:
      return kMissed;
    case PlotQuantity::effective_mass:
      return "effective mass [kg]";
    case PlotQuantity::energy_speed:
      return "speed at 0.5 J [m/s]";
    case PlotQuantity::expression:
      break;
  }
  return {};
}

// Of an expression that is one name; "" where that has none, or is a parameter of the scene.
std::string unit_of_name(const PlotSet& plots, const Chain& chain, const std::optional<Foot>& foot, const std::string& name) {
  const Parameters of_foot = foot ? foot_parameters(*foot) : Parameters{};
  if (std::any_of(of_foot.begin(), of_foot.end(), [&](const auto& one) { return one.first == name; })) return name == "grf" ? "N" : "m";
  const std::vector<std::string>& names = plots.probe.names();
  const int slot = int(std::find(names.begin(), names.end(), name) - names.begin());
  if (slot == int(names.size())) return "";
  if (slot == 0) return "s";
  if (plots.probe.is_kinematic(slot)) return plots.probe.is_velocity(slot) ? "m/s" : "m";
  for (const Body& body : chain.bodies) {
    const Joint& joint = body.joint;
    const bool turns = joint.kind == JointKind::revolute;
    if (joint.kind != JointKind::revolute && joint.kind != JointKind::prismatic) continue;
    if (slot == 1 + joint.q_index) return turns ? "rad" : "m";
    if (slot == 1 + chain.nq + joint.v_index) return turns ? "rad/s" : "m/s";
  }
  return "";
}

// The body that each coordinate, or with `rates` each rate, moves; 0 for none.
std::vector<int> bodies_moved(const Chain& chain, bool rates) {
  std::vector<int> bodies(std::size_t(rates ? chain.nv : chain.nq), 0);
  for (std::size_t b = chain.bodies.size(); b-- > 1;) {  // of those that share one the first
    const Joint& joint = chain.bodies[b].joint;
    if (joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic) bodies[std::size_t(rates ? joint.v_index : joint.q_index)] = int(b);
  }
  return bodies;
}

// The one body of whose motion an expression is; 0 where there is none, or several.
int body_of(const Expression& value, const Probe& probe, const Chain& chain) {
  int found = 0;
  for (const int slot : value.used_variables()) {
    int body = 0;
    if (probe.is_kinematic(slot)) {
      const int frame = probe.frame_of(chain, slot);
      if (frame >= 0) body = chain.frames[std::size_t(frame)].body;
    } else if (slot >= 1 && slot < 1 + chain.nq + chain.nv) {
      const bool is_rate = slot >= 1 + chain.nq;
      body = bodies_moved(chain, is_rate)[std::size_t(slot - 1 - (is_rate ? chain.nq : 0))];
    }
    if (body > 0 && found > 0 && body != found) return 0;
    if (body > 0) found = body;
  }
  return found;
}

// What stands in a plot beside others, and in no expression.
void require_no_curve_alone(const PlotEntry& entry, const std::vector<std::string>& names) {
  constexpr std::array<const char*, 4> kEnergies{"kinetic", "potential", "springs", "total"};
  if (std::ranges::count(kEnergies, entry.value) > 0 && std::ranges::count(names, entry.value) == 0)
    throw Error(ExitCode::bad_input, "'" + entry.value + "' is a curve of the plot `energy`, which has all of them: plot: [energy]", entry.place);
}

bool is_of_tip(PlotQuantity quantity) {
  return quantity == PlotQuantity::effective_mass || quantity == PlotQuantity::energy_speed;
}

void add_plot(PlotSet& plots, const PlotEntry& entry, const Chain& chain, const std::optional<Foot>& foot, int rows) {
  PlotSet::Plot plot;
  plot.quantity = value_named<PlotQuantity>(entry.value).value_or(PlotQuantity::expression);
  plot.title = entry.title.empty() ? title_of(plot.quantity, chain) : entry.title;
  plot.scale = entry.scale;
  const bool is_of_constraints = plot.quantity == PlotQuantity::lambda || plot.quantity == PlotQuantity::constraint_error;
  if (is_of_constraints && rows == 0)
    throw Error(ExitCode::bad_input, "there is no " + to_string(plot.quantity) + " to plot: the scene has no constraints", entry.place);
  if (is_of_tip(plot.quantity)) require_tip_for(chain, entry.value, entry.place);
  if (plot.quantity == PlotQuantity::expression) {
    require_no_curve_alone(entry, plots.probe.names());
    plot.value = Expression::parse(entry.value, plots.probe.names(), entry.place);
    if (plot.title.empty()) {
      const std::string unit = unit_of_name(plots, chain, foot, entry.value);
      plot.formula = entry.value;
      plot.title = entry.value + (unit.empty() ? "" : " [" + unit + "]");
    }
    for (const int slot : plot.value->used_variables()) {
      plots.needs_kinematics |= plots.probe.is_kinematic(slot);
      require_frame_of(chain, plots.probe, slot, entry.place);
    }
  }
  plots.list.push_back(std::move(plot));
}

std::vector<std::string> numbered(const std::string& stem, int count) {
  std::vector<std::string> names;
  for (int i = 1; i <= count; ++i) names.push_back(count == 1 ? stem : stem + std::to_string(i));
  return names;
}

// The curves of a table with a row a sample. `bodies`: of each, where they are of bodies.
PlotCurves columns(const std::vector<double>& table, const std::vector<std::string>& names, int samples, const std::vector<int>& bodies = {}) {
  PlotCurves plot;
  for (std::size_t i = 0; i < names.size(); ++i) {
    PlotCurve curve{names[i], {}};
    if (i < bodies.size()) curve.body = bodies[i];
    curve.y.reserve(std::size_t(samples));
    for (int k = 0; k < samples; ++k) curve.y.push_back(table[std::size_t(k) * names.size() + i]);
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

PlotCurves energies(const Simulation& simulation, const Trajectory& trajectory, int samples) {
  RunEnergies all = energies_along(simulation, trajectory, samples);
  PlotCurves plot;
  plot.curves = {{"kinetic", std::move(all.kinetic)}, {"potential", std::move(all.potential)}};
  if (all.has_springs) plot.curves.push_back({"springs", std::move(all.springs)});
  plot.curves.push_back({"total", std::move(all.total)});
  return plot;
}

// Where a curve changes its sign while it grows on both sides it has a pole, whose samples are as high as chance has it: it is cut
// there, down to some times its usual height, so that the rest of it can be read.
void cut_poles(PlotCurve& curve) {
  std::vector<double>& y = curve.y;
  constexpr double kUsual = 6;          // times the median magnitude
  constexpr std::ptrdiff_t kNear = 4;   // samples
  constexpr double kAlone = 1e4;        // times what is beside it, and the median
  std::vector<double> sizes;
  for (const double one : y)
    if (std::isfinite(one)) sizes.push_back(std::fabs(one));
  if (sizes.size() < 8) return;
  const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double most = kUsual * *middle;
  const auto count = std::ptrdiff_t(y.size());
  // Ever faster, on the way there from three samples away.
  const auto grows = [&](std::ptrdiff_t at, std::ptrdiff_t way) {
    const std::ptrdiff_t far = at + 2 * way;
    if (far < 0 || far >= count) return false;
    const double a = std::fabs(y[std::size_t(far)]), b = std::fabs(y[std::size_t(at + way)]), c = std::fabs(y[std::size_t(at)]);
    return c > b && b > a && c - b > b - a;
  };
  std::vector<std::ptrdiff_t> poles;  // between this sample and the next
  for (std::ptrdiff_t k = 0; k + 1 < count; ++k) {
    const double left = y[std::size_t(k)], right = y[std::size_t(k + 1)];
    if (left * right < 0 && std::min(std::fabs(left), std::fabs(right)) > *middle && grows(k, -1) && grows(k + 1, 1)) poles.push_back(k);
  }
  const std::vector<double> whole = y;
  const auto size_at = [&](std::ptrdiff_t k) { return k >= 0 && k < count && std::isfinite(whole[std::size_t(k)]) ? std::fabs(whole[std::size_t(k)]) : 0; };
  for (const std::ptrdiff_t pole : poles) {
    // Of a curve that is next to nothing elsewhere what is near its pole is the curve.
    const double least = std::max({most, size_at(pole - kNear), size_at(pole + 1 + kNear)});
    for (const int way : {-1, 1})
      for (std::ptrdiff_t k = way < 0 ? pole : pole + 1; k == pole || k == pole + 1 || size_at(k) > least; k += way) y[std::size_t(k)] = NAN;
  }
  // A sample that fell on a pole stands far above all others, also where the sign stays or the rest of the curve hides that it grows.
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    if (!(size_at(k) > kAlone * std::max({*middle, size_at(k - 1), size_at(k + 1)}))) continue;
    y[std::size_t(k)] = NAN;
    curve.alone = std::max(curve.alone, size_at(k));
  }
}

// Expressions at samples of a run.
class SampledExpressions {
 public:
  SampledExpressions(const PlotSet& plots, const Simulation& simulation, const Trajectory& trajectory)
      : plots_(plots), simulation_(simulation), trajectory_(trajectory), probe_(plots.probe), ws_(simulation.chain), system_(simulation), qdd_(std::size_t(simulation.chain.nv)) {}
  ~SampledExpressions() { simulation_.torque->leave_pieces(); }
  SampledExpressions(const SampledExpressions&) = delete;
  SampledExpressions& operator=(const SampledExpressions&) = delete;

  double at(const Expression& value, int sample) {
    const double t = trajectory_.t[std::size_t(sample)];
    const ConstVec q = trajectory_.q_at(sample), qd = trajectory_.qd_at(sample);
    probe_.set(simulation_.chain, ws_, t, q, qd, plots_.needs_kinematics);
    if (trajectory_.rows > 0) probe_.set_multipliers(trajectory_.lambda_at(sample));
    if (plots_.load.are_read()) {
      hold_as_then(system_, simulation_, trajectory_, t);
      GroundLoad load = ground_load(system_, ws_, plots_.ground, plots_.foot->height, t, q, qd, qdd_);
      // Thousands of metres off a foot that is nearly free, it would leave no height for the rest of the curve.
      if (!presses_near(load, *plots_.foot)) load.cop = NAN;
      plots_.load.set(probe_, load);
    }
    return value.evaluate(probe_.values());
  }

 private:
  const PlotSet& plots_;
  const Simulation& simulation_;
  const Trajectory& trajectory_;
  Probe probe_;
  Workspace ws_;
  ChainSystem system_;
  std::vector<double> qdd_;
};

PlotCurves values_of(const Expression& value, const PlotSet& plots, const Simulation& simulation, const Trajectory& trajectory,
                     int samples) {
  SampledExpressions expressions(plots, simulation, trajectory);
  PlotCurve curve;
  for (int k = 0; k < samples; ++k) curve.y.push_back(expressions.at(value, k));
  cut_poles(curve);
  curve.body = body_of(value, plots.probe, simulation.chain);
  PlotCurves plot;
  plot.curves.push_back(std::move(curve));
  return plot;
}

// Along the axes of the ellipse at the end effector; of a mass that is infinite along one the speed is zero.
PlotCurves tip_axes(const Simulation& simulation, const Trajectory& trajectory, int samples, bool as_speeds) {
  const TipMass tip(simulation.chain, simulation.constraints);
  Workspace ws(simulation.chain);
  PlotCurves plot;
  for (int k = 0; k < samples; ++k) {
    const EffectiveMass mass = tip.at(ws, trajectory.q_at(k));
    const auto count = std::size_t(mass.mobility.size());
    plot.curves.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double mobility = mass.is_infinite[i] ? 0 : mass.mobility(Eigen::Index(i));
      plot.curves[as_speeds ? count - 1 - i : i].y.push_back(as_speeds ? std::sqrt(mobility) : 1 / mobility);
    }
  }
  const std::vector<std::string> names = numbered(as_speeds ? "v" : "Lambda", int(plot.curves.size()));
  for (std::size_t i = 0; i < names.size(); ++i) plot.curves[i].name = names[i];
  return plot;
}

PlotCurves curves_of(const PlotSet::Plot& plot, const PlotSet& plots, const Simulation& simulation, const Trajectory& trajectory,
                     int samples) {
  const Chain& chain = simulation.chain;
  switch (plot.quantity) {
    case PlotQuantity::energy:
      return energies(simulation, trajectory, samples);
    case PlotQuantity::energy_error: {
      PlotCurves error;
      error.curves.push_back({"", audit_of(simulation, trajectory, samples).error});
      return error;
    }
    case PlotQuantity::q:
      return columns(trajectory.q, numbered("q", trajectory.nq), samples, bodies_moved(chain, false));
    case PlotQuantity::qd:
      return columns(trajectory.qd, numbered("qd", trajectory.nv), samples, bodies_moved(chain, true));
    case PlotQuantity::tau:
      return columns(torques_along(simulation, trajectory), numbered("tau", chain.nv), samples, bodies_moved(chain, true));
    case PlotQuantity::lambda:
      return columns(trajectory.lambda, numbered("lambda", trajectory.rows), samples);
    case PlotQuantity::constraint_error:
      return columns(constraint_errors_along(simulation, trajectory), numbered("phi", trajectory.rows), samples);
    case PlotQuantity::effective_mass:
    case PlotQuantity::energy_speed:
      return tip_axes(simulation, trajectory, samples, plot.quantity == PlotQuantity::energy_speed);
    case PlotQuantity::expression:
      break;
  }
  return values_of(*plot.value, plots, simulation, trajectory, samples);
}

}  // namespace

std::span<const Name> names_of(PlotQuantity) {
  static constexpr Name names[] = {{"energy", "kinetic, potential, of springs, and their sum, J"},
                                   {"energy_error", "what the work of the torques does not explain, J"},
                                   {"q", "of each joint, rad or m"},
                                   {"qd", "of each joint, rad/s or m/s"},
                                   {"tau", "as the run felt them, N m or N"},
                                   {"lambda", "of each row of the constraints"},
                                   {"constraint_error", "phi, by which each row of the constraints is missed, m or rad"},
                                   {"effective_mass", "at the end effector along each axis of its ellipse, kg"},
                                   {"energy_speed", "along the same axes, at which it has 0.5 J, m/s"}};
  return names;
}

std::span<const Name> names_of(PlotScale) {
  static constexpr Name names[] = {{"linear", "equal steps are equally far apart"},
                                   {"log", "equal factors are; what is not above zero has no place there"}};
  return names;
}

std::shared_ptr<const PlotSet> make_plots(const Chain& chain, const std::vector<PlotEntry>& entries,
                                          const Parameters& parameters, const NamedFrames& frames,
                                          const std::optional<Foot>& foot, int rows) {
  if (entries.empty()) return nullptr;
  Parameters known = parameters;
  if (foot) {
    const Parameters of_foot = foot_parameters(*foot);
    known.insert(known.end(), of_foot.begin(), of_foot.end());
  }
  auto plots = std::make_shared<PlotSet>(PlotSet{{}, Probe(chain, known, rows, frames), false, {}, {}, {}});
  ProblemList problems;
  for (const PlotEntry& entry : entries) {
    try {
      add_plot(*plots, entry, chain, foot, rows);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) problems.add(problem.message, problem.place);
    }
  }
  problems.throw_if_any();
  if (foot) {
    const auto& names = plots->probe.names();
    for (std::size_t i = 0; i < names.size(); ++i) plots->load.add(names[i], int(i));
    plots->foot = foot;
    plots->ground = ground_axes(chain);
  }
  return plots;
}

std::vector<PlotCurves> plot_curves(const PlotSet& plots, const Simulation& simulation, const Trajectory& trajectory, int samples) {
  std::vector<PlotCurves> all;
  for (const PlotSet::Plot& plot : plots.list) {
    all.push_back(curves_of(plot, plots, simulation, trajectory, samples));
    all.back().quantity = plot.quantity;
    all.back().formula = plot.formula;
    all.back().scale = plot.scale;
    all.back().title = plot.title == kMultipliers || plot.title == kMissed ? with_row_units(plot.title, simulation) : plot.title;
    all.back().angles = plot.quantity == PlotQuantity::q && units_of(simulation.chain) == JointUnits::turning;
  }
  return all;
}

std::vector<PlotCurves> plot_curves(const Simulation& simulation, const Trajectory& trajectory, int samples) {
  return simulation.plots ? plot_curves(*simulation.plots, simulation, trajectory, samples) : std::vector<PlotCurves>();
}

double plot_value(const Simulation& simulation, std::size_t plot, const Trajectory& trajectory, int sample) {
  return SampledExpressions(*simulation.plots, simulation, trajectory).at(*simulation.plots->list[plot].value, sample);
}

}  // namespace chainreel
