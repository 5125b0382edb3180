// What the program found, as JSON and as lines for people.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "core/json.hpp"
#include "dynamics/effective_mass.hpp"
#include "sim/simulate.hpp"

namespace chainreel {

std::string format_quantity(double value, const std::string& unit);  // "0.001 s"

Json to_json(std::span<const double> values);
Json to_json(const Eigen::MatrixXd& matrix);  // rows of numbers
Json to_json(const Eigen::Vector3d& vector);

// Lambda_inv, Lambda (null at singular poses), mobility, directions, singular_directions, basis.
void add_effective_mass(Json& json, const EffectiveMass& mass);

// "[3 1; 1 1]" with some significant digits.
std::string matrix_text(const Eigen::MatrixXd& matrix, int digits);

struct LibraryLine {
  std::string name;
  std::string version;
};
std::vector<LibraryLine> library_versions();

// What was run and whether it can be trusted: method, step, status, energy error, hash.
Json run_report(const PreparedScene& prepared, const Trajectory& trajectory);

// One line on standard error for each of the report's warnings, and of its panels'. Said even where all is to be quiet.
void tell_warnings(const std::string& name, const Json& report);

// For how long the first frame is held: whole frames, s.
double held_first(const Scene& scene);

// The sidecar of a film: that of its run, or a list `panels` of them; and what the film is. The same from one run of
// the program to the next. `frames`: of the whole film, with those that are held; `pictures` may be of one instant.
Json film_report(const Runs& runs, const Film& pictures, int frames);

// A table with left-aligned words and right-aligned numbers; the first row is its head.
std::string table_text(const std::vector<std::vector<std::string>>& rows);

// What `check` and the reports of runs say about constraints.

// Their names, rows, algorithm, stabilization and price; for a scene without constraints nothing is to be
// said.
Json constraint_plan_report(const Simulation& simulation);
std::string constraint_plan_text(const Json& report);

// How near the run stayed, and the force at each constraint's frame.
Json constraint_run_report(const Simulation& simulation, const Trajectory& trajectory);

}  // namespace chainreel
