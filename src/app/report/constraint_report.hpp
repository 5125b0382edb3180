// What `check` and the reports of runs say about constraints.
#pragma once

#include "core/json.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

// Their names, rows, algorithm, stabilization and price; for a scene without constraints nothing is to be
// said.
Json constraint_plan_report(const Simulation& simulation);
std::string constraint_plan_text(const Json& report);

// How near the run stayed, and the force at each constraint's frame.
Json constraint_run_report(const Simulation& simulation, const Trajectory& trajectory);

}  // namespace chainreel
