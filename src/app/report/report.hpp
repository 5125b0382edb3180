// What the program found, as JSON and as lines for people.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "dynamics/effective_mass.hpp"
#include "encode/library_versions.hpp"
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
std::vector<LibraryLine> library_versions(Writes writes = Writes::films);

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
