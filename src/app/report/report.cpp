#include "app/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/film/automatic.hpp"
#include "app/report/version.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "dynamics/constraints/constrained_dynamics.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "encode/libav.hpp"
#include "render/canvas.hpp"
#include "scene/run/fall.hpp"
#include "sim/cost_table.hpp"
#include "sim/doubts.hpp"

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
  json["Lambda_inv"] = to_json(mass.Lambda_inv);
  json["Lambda"] = mass.Lambda ? to_json(*mass.Lambda) : Json(nullptr);
  json["mobility"] =
      to_json(std::span<const double>(mass.mobility.data(), std::size_t(mass.mobility.size())));
  json["directions"] = to_json(mass.directions);
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

std::vector<LibraryLine> library_versions() {
  std::vector<LibraryLine> lines{{"chainreel", program_version()}};
  for (const LibraryVersion& library : encode_library_versions())
    lines.push_back({library.name, library.version});
  return lines;
}

namespace {

// A run that is to diverge is no motion that anyone takes for true.
void add_warnings(Json& json, const PreparedScene& prepared, const Trajectory& trajectory, const Audit& audit) {
  json["warnings"] = Json::array();
  if (prepared.scene.expect == Outcome::diverge) return;
  const auto chosen_by = prepared.choice ? std::optional(prepared.scene.accuracy) : std::nullopt;
  for (const Doubt& doubt : doubts_of(prepared.simulation, trajectory, audit, chosen_by))
    json["warnings"].push_back(
        {{"kind", doubt.kind}, {"amount", doubt.amount}, {"what", doubt.words}, {"remedy", doubt.remedy}});
}

// What happened when, and whether it fell; nothing of a scene without events.
void add_events(Json& json, const Scene& scene, const Trajectory& trajectory) {
  if (scene.events.empty()) return;
  json["events"] = Json::array();
  const EventHits& hits = trajectory.events;
  for (int k = 0; k < hits.size(); ++k) {
    const EventEntry& event = scene.events[std::size_t(hits.event[std::size_t(k)])];
    json["events"].push_back({{"name", event.title()},
                              {"kind", to_string(event.kind)},
                              {"t", hits.t[std::size_t(k)]},
                              {"q", to_json(hits.q_at(k))},
                              {"qd", to_json(hits.qd_at(k))}});
  }
  const bool may_fall = std::any_of(scene.events.begin(), scene.events.end(),
                                    [](const EventEntry& event) { return event.kind == EventKind::fall; });
  const std::optional<double> time = fall_time_of(scene, trajectory);
  if (may_fall) json["fall_time"] = time ? Json(*time) : Json(nullptr);
  json["end_time"] = trajectory.end_time;
}

}  // namespace

Json run_report(const PreparedScene& prepared, const Trajectory& trajectory) {
  const Audit audit = audit_of(prepared.simulation, trajectory);
  const Scene& scene = prepared.scene;
  Json json;
  json["scene"] = scene.file;
  json["title"] = title_of(scene, trajectory);
  json["model"] = scene.model;
  json["model_sha256"] = sha256_of_file(scene.model);
  json["status"] = to_string(trajectory.status);
  if (scene.expect != Outcome::finish) json["expect"] = to_string(scene.expect);
  if (!trajectory.trouble.empty()) json["trouble"] = trajectory.trouble;
  const Simulation& simulation = prepared.simulation;
  json["method"] = simulation.method->name;
  json["step"] = simulation.step > 0 ? Json(simulation.step) : Json(nullptr);
  if (simulation.options.tolerance > 0) json["tolerance"] = simulation.options.tolerance;
  if (simulation.options.order > 0) json["order"] = simulation.options.order;
  if (prepared.choice) json["auto"] = choice_report(*prepared.choice, scene.accuracy, false);
  json["steps"] = trajectory.steps;
  json["evaluations"] = trajectory.evaluations;
  json["duration"] = scene.duration;
  json["energy_start"] = audit.energy_start;
  json["largest_kinetic_energy"] = audit.largest_kinetic;
  // Samples at every step are their own audit.
  const auto& steps = trajectory.energy_at_steps;
  json["audit_error"] = steps ? steps->largest_error : audit.largest_error;
  json["audit_error_time"] = steps ? steps->time : audit.largest_error_time;
  if (steps) {
    json["audit_error_of_frames"] = audit.largest_error;
    json["audit_error_of_frames_time"] = audit.largest_error_time;
  }
  json["energy_moved"] = audit.energy_moved;
  add_warnings(json, prepared, trajectory, audit);
  if (trajectory.rows > 0) json["constraint_error"] = constraint_run_report(simulation, trajectory);
  json["limits_passed"] = Json::array();
  for (const LimitEvent& event : trajectory.limits) {
    json["limits_passed"].push_back({{"joint", event.joint},
                                     {"quantity", event.quantity},
                                     {"t", event.t},
                                     {"value", event.value},
                                     {"limit", event.limit}});
  }
  add_events(json, scene, trajectory);
  json["trajectory_sha256"] = audit.sha256;
  return json;
}

void tell_warnings(const std::string& name, const Json& report) {
  const auto tell = [&](const Json& run, const std::string& who) {
    for (const Json& one : run["warnings"])
      std::fprintf(stderr, "WARNING: %s: %s; take %s\n", who.c_str(), one["what"].get<std::string>().c_str(),
                   one["remedy"].get<std::string>().c_str());
  };
  if (!report.contains("panels")) return tell(report, name);
  for (const Json& panel : report["panels"]) tell(panel, name + ", '" + panel["title"].get<std::string>() + "'");
}

double held_first(const Scene& scene) {
  return frame_time(frame_count(scene.hold.first, scene.video.fps), scene.video.fps);
}

namespace {

// As far as the motion went. `held`: film seconds before it begins.
Json slow_motion_report(const FilmClock& clock, const std::vector<Trajectory>& runs, double held) {
  double end = 0;
  for (const Trajectory& run : runs) end = std::max(end, run.end_time);
  Json list = Json::array();
  for (const Stretch& one : clock.stretches()) {
    if (one.from >= end) break;
    const double until = std::min(one.until, end);
    list.push_back({{"from", one.from},
                    {"until", until},
                    {"speed", one.speed},
                    {"film_from", held + clock.film_time(one.from)},
                    {"film_until", held + clock.film_time(until)}});
  }
  return list;
}

}  // namespace

Json film_report(const Runs& runs, const Film& pictures, int frames) {
  const PreparedFilm& film = runs.film();
  const auto report_of = [&](std::size_t i) {
    Json json = run_report(film.panels[i], runs[i]);
    if (const auto left = pictures.panel(int(i)).left_at()) json["left_picture_at"] = *left;
    return json;
  };
  const Scene& scene = film.scene;
  Json json;
  if (runs.size() == 1) {
    json = report_of(0);
  } else {
    json = {{"scene", scene.file},
            {"title", scene.title},
            {"layout", to_string(scene.layout)},
            {"duration", scene.duration}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
      json["panels"].push_back(report_of(i));
      for (const char* shared : {"scene", "duration"}) json["panels"].back().erase(shared);
      if (is_ghost_layout(scene)) json["panels"].back()["look"] = i == 0 ? "filled" : "outline";
    }
  }
  const FrameRate fps = scene.video.fps;
  json["frames"] = frames;
  json["fps"] = fps.den == 1 ? Json(fps.num) : Json(std::to_string(fps.num) + "/" + std::to_string(fps.den));
  json["width"] = scene.video.width;
  json["height"] = scene.video.height;
  json["film_seconds"] = frame_time(frames, fps);
  if (!scene.slow_motion.empty()) json["slow_motion"] = slow_motion_report(pictures.clock(), runs.list(), held_first(scene));
  for (const LibraryLine& line : library_versions()) json["versions"][line.name] = line.version;
  return json;
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

// The largest of each row's multiplier over the run.
std::vector<double> largest_multipliers(const Trajectory& trajectory) {
  std::vector<double> largest(std::size_t(trajectory.rows));
  for (int k = 0; k < trajectory.size(); ++k) {
    const auto lambda = trajectory.lambda_at(k);
    for (std::size_t i = 0; i < largest.size(); ++i) largest[i] = std::max(largest[i], std::fabs(lambda[i]));
  }
  return largest;
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
  if (plan.stabilize == Stabilization::baumgarte) json["gain"] = plan.gain;
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
  if (report.contains("gain")) text += ", gain " + format_shortest(report["gain"].get<double>()) + " 1/s";
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
  const std::vector<double> largest = largest_multipliers(trajectory);
  for (std::size_t i = 0; i < largest.size(); ++i)
    json["rows"].push_back({{"name", set.row_names()[i]}, {"largest_lambda", largest[i]}});
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
