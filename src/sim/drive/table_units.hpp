// Units that the columns of a table tell, held against what they are to be.
#pragma once

#include <string>
#include <vector>

#include "core/csv.hpp"
#include "model/chain.hpp"

namespace chainreel {

// Whether the freedom turns; none of one that several joints read, each in its own way, nor of a floating base.
bool freedom_turns(const Chain& chain, std::size_t freedom);

// What turns is no length, and what slides no angle. `quantities`: q, qd, qdd or tau of each group of the table's columns. Throws Error (bad input) that
// names the column. Of freedoms that are no joint's own number nothing is known.
void check_table_units(const Chain& chain, const Table& table, const TimeTable& columns, const std::vector<std::string>& quantities);

// What speaks against the units of a motion's table where it tells none: angles of more than a turn, rows far apart. `motion`: its coordinates, `clock` the
// column of its instants; `scene_names`: whether a scene can say what columns are.
std::vector<std::string> doubts_of_units(const Chain& chain, const Table& table, const TimeTable& motion, const std::string& clock, bool scene_names);

}  // namespace chainreel
