#include "sim/drive/table_units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {

namespace {

// The joint whose number it is; null of one that several joints read, each in its own way, and of a floating base.
const Joint* joint_of(const Chain& chain, std::size_t freedom) {
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Joint& joint = chain.bodies[b].joint;
    if (joint.kind != JointKind::floating && std::size_t(joint.v_index) == freedom && joint.ratio == 1 && joint.offset == 0) return &joint;
  }
  return nullptr;
}

}  // namespace

bool freedom_turns(const Chain& chain, std::size_t freedom) {
  const Joint* joint = joint_of(chain, freedom);
  return joint != nullptr && joint->kind == JointKind::revolute;
}

void check_table_units(const Chain& chain, const Table& table, const TimeTable& motion, const std::vector<std::string>& quantities) {
  for (std::size_t group = 0; group < motion.columns.size(); ++group)
    for (std::size_t i = 0; i < motion.columns[group].size(); ++i) {
      const std::size_t column = motion.columns[group][i];
      const std::string& unit = table.units[column];
      if (unit.empty() || joint_of(chain, i) == nullptr) continue;
      const std::string base = unit.substr(0, unit.find('/'));
      const bool is_angle = base == "rad" || base == "deg", is_length = base == "m" || base == "mm" || base == "cm";
      const bool is_torque = base == "N m" || base == "Nm" || base == "N*m";
      const bool fits = quantities[group] == "tau" ? (freedom_turns(chain, i) ? is_torque : base == "N") : (freedom_turns(chain, i) ? is_angle : is_length);
      const std::string below = unit.find('/') == std::string::npos ? "" : unit.substr(unit.find('/') + 1);
      const bool is_of_order = quantities[group] == "qd" ? below == "s" : quantities[group] == "qdd" ? below == "s^2" || below == "s2" : below.empty();
      if (fits && is_of_order) continue;
      throw Error(ExitCode::bad_input,
                  "'" + table.names[column] + " [" + unit + "]' is to be " + quantities[group] + " of '" + chain.coordinate_names[i] +
                      "', which " + (freedom_turns(chain, i) ? "turns: rad, rad/s, rad/s^2 and N m, or deg" : "slides: m, m/s, m/s^2 and N, or mm"),
                  {table.file});
    }
}

// Nobody's log has so few rows; and of an angle nobody means more than a turn without saying so, in a unit.
std::vector<std::string> doubts_of_units(const Chain& chain, const Table& table, const TimeTable& motion, const std::string& clock, bool scene_names) {
  std::vector<std::string> doubts;
  constexpr double kSlowestLog = 1;  // s a row
  const std::size_t time = std::size_t(table.find(clock));
  const double step = (motion.t.back() - motion.t.front()) / double(motion.t.size() - 1);
  if (table.units[time].empty() && step > kSlowestLog)
    doubts.push_back("the rows of " + table.file + " are " + format_significant(step, 3) + " s apart: is '" + clock +
                     "' in seconds? For milliseconds its header is '" + clock + " [ms]' (or us, ns), for seconds '" + clock +
                     " [s]'" + (scene_names ? "; a scene may say so, too: `columns: {time: \"" + clock + " [ms]\"}`" : ""));
  for (std::size_t i = 0; i < motion.groups[0].size(); ++i) {
    const std::size_t column = motion.columns[0][i];
    if (!table.units[column].empty() || !freedom_turns(chain, i)) continue;
    double largest = 0;
    for (const double q : motion.groups[0][i]) largest = std::max(largest, std::fabs(q));
    if (!(largest > 2 * std::numbers::pi)) continue;
    const std::string& name = table.names[column];
    doubts.push_back("'" + name + "' of " + table.file + " goes to " + format_significant(largest, 4) + ", which is in radians, " +
                     format_significant(largest / (2 * std::numbers::pi), 3) + " turns: for degrees its header is '" + name +
                     " [deg]', for radians '" + name + " [rad]'" +
                     (scene_names ? "; a scene may say so, too: `columns: {" + chain.coordinate_names[i] + ": \"" + name + " [deg]\"}`" : ""));
  }
  return doubts;
}

}  // namespace chainreel
