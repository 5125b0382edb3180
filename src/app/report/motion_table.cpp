#include "app/report/motion_table.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/constraints/constraint_set.hpp"
#include "dynamics/kinematics.hpp"
#include "sim/audit.hpp"
#include "sim/system/chain_system.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {

std::span<const Name> names_of(MotionColumn) {
  static constexpr Name names[] = {{"t", "s"},
                                   {"q", "of each coordinate, rad or m"},
                                   {"qd", "of each freedom, rad/s or m/s"},
                                   {"qdd", "rad/s^2 or m/s^2"},
                                   {"tau", "as the run felt them, N m or N"},
                                   {"energy", "kinetic, potential, of springs, and their sum, J"},
                                   {"work", "of torques, of springs, friction and pushes, too, since the start, J"},
                                   {"energy_error", "what the work of the torques does not explain, J"},
                                   {"x_G", "of the end effector along W, m"},
                                   {"y_G", "m"},
                                   {"z_G", "m"},
                                   {"xd_G", "m/s"},
                                   {"yd_G", "m/s"},
                                   {"zd_G", "m/s"},
                                   {"lambda", "of each row of the constraints, N or N m"},
                                   {"constraint_error", "phi, by which each of those rows is missed, m or rad"},
                                   {"frames", "the origin of each link's frame along W, m"}};
  return names;
}

namespace {

constexpr MotionColumn kTip[] = {MotionColumn::x_G,  MotionColumn::y_G,  MotionColumn::z_G,
                                 MotionColumn::xd_G, MotionColumn::yd_G, MotionColumn::zd_G};

bool is_of_tip(MotionColumn column) {
  return std::find(std::begin(kTip), std::end(kTip), column) != std::end(kTip);
}

// Its place among x, y, z and their rates.
std::size_t index_in_tip(MotionColumn column) {
  return std::size_t(std::find(std::begin(kTip), std::end(kTip), column) - std::begin(kTip));
}

bool is_plain(const Chain& chain) {
  return chain.serial && !chain.has_floating;
}

// "q1", or "q.hip" where numbers would say nothing.
std::vector<std::string> names_of_numbers(const Chain& chain, const std::string& stem, const std::vector<std::string>& owners) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < owners.size(); ++i)
    names.push_back(stem + (is_plain(chain) ? std::to_string(i + 1) : "." + owners[i]));
  return names;
}

enum class Kind { turns, slides, plain };

// Of that many numbers, of which a joint's begin at its index; a quaternion's are plain, a twist's turn.
std::vector<Kind> kinds_of(const Chain& chain, int count, int Joint::*index, Kind of_turn) {
  std::vector<Kind> kinds(std::size_t(count), Kind::plain);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const auto at = kinds.begin() + std::ptrdiff_t(joint.*index);
    if (joint.ratio != 1 || joint.offset != 0) continue;  // it reads another joint's coordinate
    if (joint.kind == JointKind::floating)
      std::fill_n(std::fill_n(at, 3, Kind::slides), 3, of_turn);
    else
      *at = joint.kind == JointKind::revolute ? Kind::turns : Kind::slides;
  }
  return kinds;
}

std::vector<Kind> kinds_of_positions(const Chain& chain) {
  return kinds_of(chain, chain.nq, &Joint::q_index, Kind::plain);
}

std::vector<Kind> kinds_of_freedoms(const Chain& chain) {
  return kinds_of(chain, chain.nv, &Joint::v_index, Kind::turns);
}

std::vector<std::string> with_units(std::vector<std::string> names, const std::vector<Kind>& kinds, const char* turning,
                                    const char* sliding) {
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i] = with_unit(names[i], kinds[i] == Kind::turns ? turning : kinds[i] == Kind::slides ? sliding : "");
  return names;
}

// Sums of steps are decimals but for their rounding, which nobody wants to read.
double decimal_instant(double t) {
  constexpr int kDigits = 15, kShort = 12;
  const std::string text = format_significant(t, kDigits);
  const double near = parse_number(text).value_or(t);
  return format_shortest(near).size() <= kShort ? near : t;
}

std::vector<double> decimal_instants(std::vector<double> t) {
  for (double& instant : t) instant = decimal_instant(instant);
  return t;
}

std::vector<double> accelerations_along(const Simulation& simulation, const Trajectory& trajectory) {
  ChainSystem system(simulation);
  const auto n = std::size_t(simulation.chain.nv);
  std::vector<double> all(std::size_t(trajectory.size()) * n);
  for (int k = 0; k < trajectory.size(); ++k) {
    const double t = trajectory.t[std::size_t(k)];
    hold_as_then(system, simulation, trajectory, t);
    system.acceleration(t, trajectory.q_at(k), trajectory.qd_at(k), Vec(all).subspan(std::size_t(k) * n, n));
  }
  simulation.torque->leave_pieces();
  return all;
}

void add_energies(DataTable& table, const Simulation& simulation, const Trajectory& trajectory) {
  RunEnergies all = energies_along(simulation, trajectory, trajectory.size());
  table.add("kinetic", "J", std::move(all.kinetic));
  table.add("potential", "J", std::move(all.potential));
  if (all.has_springs) table.add("springs", "J", std::move(all.springs));
  table.add("energy", "J", std::move(all.total));
}

// x, y, z and their rates of the end effector, a list each.
std::vector<std::vector<double>> tip_along(const Chain& chain, const Trajectory& trajectory) {
  std::vector<std::vector<double>> tip(6);
  Workspace ws(chain);
  for (int k = 0; k < trajectory.size(); ++k) {
    compute_kinematics(chain, ws, trajectory.q_at(k), trajectory.qd_at(k));
    const Eigen::Vector3d x = frame_position(chain, ws, chain.end_effector), xd = frame_velocity(chain, ws, chain.end_effector);
    for (int i = 0; i < 3; ++i) {
      tip[std::size_t(i)].push_back(x[i]);
      tip[std::size_t(i) + 3].push_back(xd[i]);
    }
  }
  return tip;
}

void add_frames(DataTable& table, const Chain& chain, const Trajectory& trajectory) {
  std::vector<std::string> names;
  for (const Frame& frame : chain.frames)
    for (const char* axis : {"x", "y", "z"}) names.push_back(with_unit(frame.name + "." + axis, "m"));
  std::vector<double> values;
  values.reserve(names.size() * std::size_t(trajectory.size()));
  Workspace ws(chain);
  for (int k = 0; k < trajectory.size(); ++k) {
    compute_kinematics(chain, ws, trajectory.q_at(k), trajectory.qd_at(k));
    for (std::size_t frame = 0; frame < chain.frames.size(); ++frame) {
      const Eigen::Vector3d x = frame_position(chain, ws, int(frame));
      values.insert(values.end(), {x[0], x[1], x[2]});
    }
  }
  table.add("frames", std::move(names), {chain.frames.size(), 3}, std::move(values));
}

void add_multipliers(DataTable& table, const Simulation& simulation, const Trajectory& trajectory) {
  table.add("lambda", multiplier_columns(simulation.chain, simulation.constraints.list), {std::size_t(trajectory.rows)}, trajectory.lambda);
}

void add_constraint_errors(DataTable& table, const Simulation& simulation, const Trajectory& trajectory) {
  std::vector<std::string> names;
  for (const RowUnits& row : row_units(simulation.chain, simulation.constraints.list))
    names.push_back(with_unit("phi" + std::to_string(names.size() + 1), row.error));
  table.add("constraint_error", std::move(names), {std::size_t(trajectory.rows)}, constraint_errors_along(simulation, trajectory));
}

void add_column(DataTable& table, MotionColumn column, const Simulation& simulation, const Trajectory& trajectory) {
  const Chain& chain = simulation.chain;
  const auto of_freedoms = [&](const char* stem, const char* turning, const char* sliding, std::vector<double> values) {
    table.add(stem, with_units(names_of_numbers(chain, stem, chain.coordinate_names), kinds_of_freedoms(chain), turning, sliding),
              {std::size_t(chain.nv)}, std::move(values));
  };
  switch (column) {
    case MotionColumn::t:
      return table.add("t", "s", decimal_instants(trajectory.t));
    case MotionColumn::q:
      return table.add("q",
                       with_units(names_of_numbers(chain, "q", position_names(chain)), kinds_of_positions(chain), "rad", "m"),
                       {std::size_t(chain.nq)}, trajectory.q);
    case MotionColumn::qd:
      return of_freedoms("qd", "rad/s", "m/s", trajectory.qd);
    case MotionColumn::qdd:
      return of_freedoms("qdd", "rad/s^2", "m/s^2", accelerations_along(simulation, trajectory));
    case MotionColumn::tau:
      return table.add("tau", torque_columns(chain), {std::size_t(chain.nv)}, torques_along(simulation, trajectory));
    case MotionColumn::energy:
      return add_energies(table, simulation, trajectory);
    case MotionColumn::work:
      return table.add("work", "J", trajectory.work);
    case MotionColumn::energy_error:
      return table.add("energy_error", "J", audit_of(simulation, trajectory).error);
    case MotionColumn::lambda:
      return add_multipliers(table, simulation, trajectory);
    case MotionColumn::constraint_error:
      return add_constraint_errors(table, simulation, trajectory);
    case MotionColumn::frames:
      return add_frames(table, chain, trajectory);
    default:
      break;
  }
}

// Of a film that stands still, whose frames are samples of one instant, the first alone.
void keep_instants_once(DataTable& table, const Trajectory& trajectory) {
  const auto is_again = [&](int k) {
    return k > 0 && trajectory.t[std::size_t(k)] == trajectory.t[std::size_t(k) - 1] &&
           std::ranges::equal(trajectory.q_at(k), trajectory.q_at(k - 1)) && std::ranges::equal(trajectory.qd_at(k), trajectory.qd_at(k - 1));
  };
  std::vector<std::size_t> kept;
  for (int k = 0; k < trajectory.size(); ++k)
    if (!is_again(k)) kept.push_back(std::size_t(k));
  if (kept.size() == table.rows) return;
  for (DataArray& array : table.arrays) {
    const std::size_t count = table.rows == 0 ? 0 : array.values.size() / table.rows;
    for (std::size_t to = 0; to < kept.size(); ++to)
      std::copy_n(array.values.begin() + std::ptrdiff_t(kept[to] * count), count, array.values.begin() + std::ptrdiff_t(to * count));
    array.values.resize(kept.size() * count);
  }
  table.rows = kept.size();
}

}  // namespace

std::vector<std::string> torque_columns(const Chain& chain) {
  return with_units(names_of_numbers(chain, "tau", chain.coordinate_names), kinds_of_freedoms(chain), "N m", "N");
}

std::vector<std::string> multiplier_columns(const Chain& chain, const std::vector<Constraint>& constraints) {
  std::vector<std::string> names;
  for (const RowUnits& row : row_units(chain, constraints)) names.push_back(with_unit("lambda" + std::to_string(names.size() + 1), row.multiplier));
  return names;
}

std::vector<MotionColumn> usual_columns(const Chain& chain) {
  std::vector<MotionColumn> columns{MotionColumn::t, MotionColumn::q, MotionColumn::qd, MotionColumn::tau, MotionColumn::energy};
  if (chain.end_effector < 0) return columns;
  constexpr double kAlong = 1e-12;  // of a unit vector: less is rounding
  for (const MotionColumn column : kTip) {
    const auto axis = Eigen::Index(index_in_tip(column) % 3);
    const bool moves = !chain.planar || std::abs(chain.planar->plane.ex[axis]) > kAlong || std::abs(chain.planar->plane.ey[axis]) > kAlong;
    if (moves) columns.push_back(column);
  }
  return columns;
}

std::vector<MotionColumn> parse_columns(const std::string& text, const std::string& option) {
  std::vector<MotionColumn> columns;
  for (const std::string& word : separated(text, ',')) {
    const std::optional<MotionColumn> column = value_named<MotionColumn>(word);
    const std::string stem = without_number(word);
    if (!column && value_named<MotionColumn>(stem))
      throw Error(ExitCode::usage, option + ": " + word + " is one of " + stem + ": ask for " + stem + ", which has all of them");
    if (!column) throw Error(ExitCode::usage, option + ": each " + misnamed(names_of(MotionColumn{}), word));
    if (std::find(columns.begin(), columns.end(), *column) != columns.end())
      throw Error(ExitCode::usage, option + " names " + word + " twice");
    columns.push_back(*column);
  }
  if (columns.empty())
    throw Error(ExitCode::usage, option + " takes names between commas, like t,q,tau; there are " + alternatives(names_of(MotionColumn{})));
  return columns;
}

void require_columns(const Simulation& simulation, const std::vector<MotionColumn>& columns, const std::string& option) {
  for (const MotionColumn column : columns) {
    if (is_of_tip(column) && simulation.chain.end_effector < 0)
      throw Error(ExitCode::usage, option + " " + to_string(column) + ": " + simulation.chain.name +
                                       " has several ends: choose one with `--set end_effector=NAME`");
    if ((column == MotionColumn::lambda || column == MotionColumn::constraint_error) && simulation.constraints.empty())
      throw Error(ExitCode::usage, option + " " + to_string(column) + ": the scene has no constraints");
  }
}

DataTable motion_table(const Simulation& simulation, const Trajectory& trajectory, const std::vector<MotionColumn>& columns) {
  DataTable table;
  table.rows = std::size_t(trajectory.size());
  std::vector<std::vector<double>> tip;
  for (const MotionColumn column : columns) {
    if (!is_of_tip(column)) {
      add_column(table, column, simulation, trajectory);
      continue;
    }
    if (tip.empty()) tip = tip_along(simulation.chain, trajectory);
    const std::size_t i = index_in_tip(column);
    table.add(to_string(column), i < 3 ? "m" : "m/s", tip[i]);
  }
  keep_instants_once(table, trajectory);
  return table;
}

DataTable motion_table(const Simulation& simulation, const Trajectory& trajectory) {
  return motion_table(simulation, trajectory, usual_columns(simulation.chain));
}

std::string state_names(const Chain& chain, NamesOfState form) {
  std::vector<std::string> names = names_of_numbers(chain, "q", position_names(chain)),
                           rates = names_of_numbers(chain, "qd", chain.coordinate_names);
  if (form == NamesOfState::with_units) {
    names = with_units(std::move(names), kinds_of_positions(chain), "rad", "m");
    rates = with_units(std::move(rates), kinds_of_freedoms(chain), "rad/s", "m/s");
  }
  names.insert(names.end(), rates.begin(), rates.end());
  return joined(names, ",");
}

std::string state_text(const Trajectory& trajectory, int k) {
  std::string text;
  for (const auto& values : {trajectory.q_at(k), trajectory.qd_at(k)})
    for (const double value : values) text += (text.empty() ? "" : ",") + format_shortest(value);
  return text;
}

std::string panel_table_path(const std::string& path, std::size_t panel, bool alone) {
  if (alone) return path;
  std::filesystem::path result(path);
  const std::string ending = result.extension().string();
  return result.replace_extension(std::to_string(panel + 1) + ending).string();
}

}  // namespace chainreel
