#include "app/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/report/version.hpp"
#include "core/format.hpp"
#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "sim/torques_along.hpp"
#include "sim/cost_table.hpp"

namespace chainreel {

std::string format_quantity(double value, const std::string& unit) {
  return format_shortest(value) + " " + unit;
}

Json to_json(std::span<const double> values) {
  Json list = Json::array();
  for (double value : values) list.push_back(value);
  return list;
}

Json to_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

Json to_json(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

void add_effective_mass(Json& json, const EffectiveMass& mass) {
  json["basis"] = mass.basis.names;
  json["basis_directions"] = Json::array();
  for (const Eigen::Vector3d& direction : mass.basis.directions) json["basis_directions"].push_back(to_json(direction));
  json["Lambda_inv"] = to_json(mass.Lambda_inv);
  json["Lambda"] = mass.Lambda ? to_json(*mass.Lambda) : Json(nullptr);
  json["mobility"] =
      to_json(std::span<const double>(mass.mobility.data(), std::size_t(mass.mobility.size())));
  json["directions"] = to_json(Eigen::MatrixXd(mass.directions.transpose()));  // one a row, like those that are singular
  Json singular = Json::array();
  for (const Eigen::VectorXd& direction : mass.singular_directions)
    singular.push_back(to_json(std::span<const double>(direction.data(), std::size_t(direction.size()))));
  json["singular_directions"] = singular;
}

std::string matrix_text(const Eigen::MatrixXd& matrix, int digits) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (i > 0) text += "; ";
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += (j > 0 ? " " : "") + format_significant(matrix(i, j), digits);
  }
  return text + "]";
}

std::vector<LibraryLine> library_versions(Writes writes) {
  std::vector<LibraryLine> lines{{"chainreel", program_version()}};
  for (const LibraryVersion& library : encode_library_versions(writes))
    lines.push_back({library.name, library.version});
  return lines;
}

std::string table_text(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string pad(widths[i] - row[i].size(), ' ');
      const bool number = &row != &rows.front() && parse_number(row[i]).has_value();
      const bool last = i + 1 == row.size();
      text += number ? pad + row[i] : row[i] + (last ? "" : pad);
      text += last ? "\n" : "  ";
    }
  }
  return text;
}

namespace {

std::string algorithm_of(const Chain& chain, const ConstrainedWorkspace& cws, bool by_kernel) {
  if (!by_kernel) return "general: M^-1 Jc^T, then the rows' own system";
  return std::string(chain.planar ? "planar, unrolled in absolute angles" : "spatial, unrolled") +
         (cws.kernel.doubled ? ", equal rows once" : "");
}

}  // namespace

Json constraint_plan_report(const Simulation& simulation) {
  const ConstraintPlan& plan = simulation.constraints;
  const ConstraintSet set(simulation.chain, plan.list);
  const ConstrainedWorkspace cws(simulation.chain, set);
  Json json;
  for (const Constraint& constraint : plan.list) json["names"].push_back(name_of(constraint));
  json["rows"] = set.row_names();
  const bool by_kernel = cws.kernel.run != nullptr && plan.stabilize != Stabilization::baumgarte;
  json["dynamics"] = algorithm_of(simulation.chain, cws, by_kernel);
  json["stabilize"] = to_string(plan.stabilize);
  json["gain"] = plan.stabilize == Stabilization::baumgarte ? Json(plan.gain) : Json(nullptr);
  const ConstraintCost cost = constraint_cost(simulation.chain, plan);
  json["evaluation_ns"] = cost.evaluation;
  json["projection_ns"] = cost.projection;
  return json;
}

std::string constraint_plan_text(const Json& report) {
  std::string names;
  for (const Json& name : report["names"]) names += (names.empty() ? "" : ", ") + name.get<std::string>();
  const std::size_t rows = report["rows"].size();
  std::string text = "constraints: " + names + " (" + std::to_string(rows) + (rows == 1 ? " row" : " rows") +
                     "); " + report["dynamics"].get<std::string>() + ", some " +
                     format_significant(report["evaluation_ns"].get<double>(), 2) +
                     " ns; stabilize: " + report["stabilize"].get<std::string>();
  if (report["gain"].is_number()) text += ", gain " + format_shortest(report["gain"].get<double>()) + " 1/s";
  const double projection = report["projection_ns"].get<double>();
  if (projection > 0) text += ", some " + format_significant(projection / 1000, 2) + " us a step";
  return text;
}

Json constraint_run_report(const Simulation& simulation, const Trajectory& trajectory) {
  const Chain& chain = simulation.chain;
  const ConstraintSet set(chain, simulation.constraints.list);
  Json json{{"stabilize", to_string(simulation.constraints.stabilize)},
            {"position_error", trajectory.position_error},
            {"velocity_error", trajectory.velocity_error},
            {"rows", Json::array()}};
  const std::vector<LargestMultiplier> largest = largest_multipliers(simulation, trajectory);
  for (std::size_t i = 0; i < largest.size(); ++i)
    json["rows"].push_back({{"name", set.row_names()[i]}, {"largest_lambda", std::fabs(largest[i].value)}, {"largest_lambda_signed", largest[i].value}, {"largest_lambda_time", largest[i].t}});
  json["force_at_start"] = json["force_at_end"] = Json::array();
  if (trajectory.size() == 0) return json;
  Workspace ws(chain);
  ConstrainedWorkspace cws(chain, set);
  const auto forces_at = [&](int sample) {
    compute_constraints(chain, ws, set, cws, trajectory.q_at(sample), trajectory.qd_at(sample));
    Json forces;
    for (std::size_t k = 0; k < set.constraints().size(); ++k)
      forces.push_back({{"constraint", name_of(set.constraints()[k])},
                        {"force", to_json(contact_force(chain, set, cws, k, trajectory.lambda_at(sample)))}});
    return forces;
  };
  json["force_at_start"] = forces_at(0);
  json["force_at_end"] = forces_at(trajectory.size() - 1);
  return json;
}

}  // namespace chainreel
