// A table of Denavit and Hartenberg's rows: CSV with the names a, alpha, d, theta on top, in any order, and maybe mass.
#pragma once

#include <string>
#include <vector>

#include "model/link_chain.hpp"

namespace chainreel {

struct DhTable {
  std::vector<DhRow> rows;
  std::vector<double> masses;  // kg; empty: the table has none
};

// Cells are numbers in m and rad, or constant expressions: 90deg, pi/2. Throws Error (bad input) with file and line.
DhTable read_dh_table(const std::string& path);

}  // namespace chainreel
