// A run as a table.
#pragma once

#include <string>

#include "model/chain.hpp"
#include "sim/system/trajectory.hpp"

namespace chainreel {

// t, then q1.. and qd1.. of a serial chain, or q.NAME and qd.NAME of trees and floating bases; a row a
// sample.
std::string trajectory_csv(const Chain& chain, const Trajectory& trajectory);

// "q1,q2,qd1,qd2", and the same of a sample: as in such a table behind t.
std::string state_names(const Chain& chain);
std::string state_text(const Trajectory& trajectory, int k);

// NAME.csv of a single panel, NAME.1.csv, NAME.2.csv, .. of several; `panel` from 0.
std::string panel_csv_path(const std::string& path, std::size_t panel, bool alone);

}  // namespace chainreel
