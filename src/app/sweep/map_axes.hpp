// Keys of a scene as axes of a map, whose cells are the runs.
#pragma once

#include <string>

#include "model/chain.hpp"
#include "picture/plot.hpp"
#include "scene/run/sweep.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// What an axis calls a key: "step [s]", a parameter by its name, q2(0) for start.q.2.
std::string title_of_key(const std::string& key);
std::string title_of_axis(const Sweep& sweep);  // with the unit that its range has: "$q1(0)$ [rad]"
// The same with the unit of the coordinate, its torque or its gain, which the model knows, where the range has none.
Sweep with_unit_of(const Chain& chain, Sweep sweep);
// ... and of a parameter, which expressions tell.
Sweep with_unit_of_parameter(Scene scene, Sweep sweep);
// Cells are centred on the values: half a cell beyond the first and the last.
Axis map_axis(const Sweep& sweep);
// By what its numbers are shown: angles are read in degrees.
double degrees_of(const Sweep& sweep);
// With ticks at the values, where these are few, and angles in degrees; the second from the first value to the last.
Axis map_axis_in_units(const Sweep& sweep);
Axis curve_axis_of(const Sweep& sweep);
// Throws Error (usage) unless its numbers rise.
void require_curve_axis(const Sweep& sweep, const std::string& option);
// Throws Error (usage) unless its cells are of one size: rising values at equal distances or factors.
void require_map_axis(const Sweep& sweep, const std::string& option);

}  // namespace chainreel
