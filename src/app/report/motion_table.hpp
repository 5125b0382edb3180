// A run as a table.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "model/chain.hpp"
#include "sim/simulate.hpp"
#include "table/data_table.hpp"

namespace chainreel {

// What a table of a run may hold, each one array, but for `energy`.
enum class MotionColumn { t, q, qd, qdd, tau, energy, work, energy_error, x_G, y_G, z_G, xd_G, yd_G, zd_G, lambda, constraint_error, frames };
std::span<const Name> names_of(MotionColumn);

// t, q, qd, tau, energy, and place and velocity of the end effector, where there is one: of a planar chain along the axes of
// its plane.
std::vector<MotionColumn> usual_columns(const Chain& chain);

// "t,q,tau": in that order. Throws Error (usage) naming the option.
std::vector<MotionColumn> parse_columns(const std::string& text, const std::string& option);

// Throws Error (usage) where the run has none of them: the end effector's without one, lambda without constraints.
void require_columns(const Simulation& simulation, const std::vector<MotionColumn>& columns, const std::string& option);

// A row a sample; samples of one instant, as of a film that stands still, are one. q1.. of a serial chain, q.NAME of trees and floating bases; likewise qd, qdd and tau. Instants that are
// decimals but for the rounding of sums are given as these: 0.3, not 0.30000000000000004.
DataTable motion_table(const Simulation& simulation, const Trajectory& trajectory, const std::vector<MotionColumn>& columns);
DataTable motion_table(const Simulation& simulation, const Trajectory& trajectory);  // with the usual ones

// Of the arrays tau and lambda: "tau1 [N m]", "lambda1 [N]".
std::vector<std::string> torque_columns(const Chain& chain);
std::vector<std::string> multiplier_columns(const Chain& chain, const std::vector<Constraint>& constraints);

// "q1,q2,qd1,qd2", or with units "q1 [rad],q2 [rad],qd1 [rad/s],qd2 [rad/s]", and the same of a sample.
enum class NamesOfState { plain, with_units };
std::string state_names(const Chain& chain, NamesOfState names = NamesOfState::plain);
std::string state_text(const Trajectory& trajectory, int k);

// NAME.csv of a single panel, NAME.1.csv, NAME.2.csv, .. of several; `panel` from 0.
std::string panel_table_path(const std::string& path, std::size_t panel, bool alone);

}  // namespace chainreel
