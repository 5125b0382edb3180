// chainreel stability SCENE [--x KEY=.. --y KEY=..]: where the scene fails, and which method fails on it.

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/figure.hpp"
#include "app/film/prepared.hpp"
#include "app/film/progress.hpp"
#include "app/report/report.hpp"
#include "app/sweep/map_axes.hpp"
#include "app/today/table_record.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/machine.hpp"
#include "core/output_file.hpp"
#include "draw/charts/stability_map.hpp"
#include "draw/page/house_style.hpp"
#include "scene/run/prepare.hpp"
#include "scene/run/stability_cells.hpp"
#include "scene/run/title.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/audit.hpp"
#include "sim/linear_modes.hpp"

namespace chainreel {
namespace {

struct StabilityOptions {
  std::string scene;
  std::string x, y;
  std::string methods;
  int threads = 0;
  int panel = 0;  // of the table, from 1; 0: the motion that all share
  FigureOptions figure;
  CommonOptions common;
};

constexpr double kTableSteps[] = {0.1, 0.01, 0.001};
constexpr double kTableTolerances[] = {1e-3, 1e-6, 1e-9};

constexpr const char* kTheory = "theory";

void add_limits(const StabilityCells& cells, StabilityMap& map) {
  const bool along_x = cells.x.key == "step";
  const std::vector<double>& others = (along_x ? cells.y : cells.x).numbers;
  MapBoundary line;
  line.label = kTheory;
  for (std::size_t i = 0; i < cells.boundary.size(); ++i) {
    if (!cells.boundary[i] || !std::isfinite(*cells.boundary[i]) || *cells.boundary[i] <= 0) continue;
    const double step = *cells.boundary[i];
    line.points.push_back(along_x ? Point{step, others[i]} : Point{others[i], step});
  }
  if (line.points.size() >= 2) map.boundaries.push_back(line);
}

double value_at(const Axis& axis, double share) {
  return axis.scale == Scale::log ? axis.low * std::pow(axis.high / axis.low, share)
                                  : axis.low + share * (axis.high - axis.low);
}

// Between the cells that are stable by theory and those that are not, along their edges.
void add_edges(const StabilityCells& cells, StabilityMap& map) {
  std::vector<std::optional<bool>> stable;
  for (const StabilityCell& cell : cells.cells) stable.push_back(cell.stable);
  for (const auto& corners : edges_between(stable, map.nx, map.ny)) {
    MapBoundary line;
    if (map.boundaries.empty()) line.label = kTheory;
    for (const Point& corner : corners)
      line.points.push_back({value_at(map.x, corner.x / map.nx), value_at(map.y, corner.y / map.ny)});
    map.boundaries.push_back(line);
  }
}

const char* place_of(bool about_target) {
  return about_target ? "the rest that feedback leads to" : "the start";
}

constexpr const char* kNoEquilibrium = "That is no equilibrium: elsewhere limits may differ";
constexpr const char* kAlong = " and at instants of the run, the shortest counts";

std::string place_of(const StabilityCells& cells) {
  const char* along = cells.along_runs > 0 ? kAlong : "";
  if (cells.about_rest == 0 || cells.about_rest == cells.linearised) return place_of(cells.about_rest > 0) + std::string(along);
  return "the rest that feedback leads to, or else the start" + std::string(along);
}

// Where theory is told of a cell and the run does otherwise.
struct Agreement {
  std::size_t known = 0, otherwise = 0;

  explicit Agreement(const StabilityCells& cells) {
    for (const StabilityCell& cell : cells.cells) {
      known += cell.stable.has_value();
      otherwise += cell.stable.has_value() && *cell.stable == cell.failed;
    }
  }
  // A twentieth is what cells beside the line are: a line that is wrong more often tells nothing.
  bool is_rough() const { return 20 * otherwise > known; }
  std::string text() const {
    return "The limit of the linearised motion is left out: " + std::to_string(otherwise) + " of " + std::to_string(known) +
           " cells do otherwise than it, which knows neither of energies nor of motions that are far from linear.";
  }
};

// Of the motion's energy; beyond all bounds where there is none that is known.
double percent_of_motion(const StabilityCell& cell) {
  return cell.energy_error == 0 ? 0 : 100 * cell.energy_error / cell.energy_scale;
}

std::string unknown_text(const StabilityCells& cells) {
  const auto unknown = std::ranges::count_if(cells.cells, [](const StabilityCell& cell) { return !cell.failed && std::isnan(cell.energy_scale); });
  return unknown == 0 ? "" : " The energy of the motion is not known of " + std::to_string(unknown) + (unknown == 1 ? " cell, which is pale." : " cells, which are pale.");
}

// With the unit of what is along it, which only its model and expressions know.
Axis stability_axis(Scene scene, const Sweep& sweep) {
  return map_axis(with_unit_of(prepare(scene, false).chain, with_unit_of_parameter(scene, sweep)));
}

StabilityMap map_of(const Scene& scene, const StabilityCells& cells) {
  StabilityMap map;
  map.title = "Where " + method_title(cells.method) + " fails";
  map.subtitle = title_over_runs(scene);
  map.x = stability_axis(scene, cells.x);
  map.y = stability_axis(scene, cells.y);
  map.nx = int(cells.x.values.size());
  map.ny = int(cells.y.values.size());
  map.error_title = "|energy error| / energy [%]";
  map.most = 100;
  map.pale = "> 100 %";
  for (const StabilityCell& cell : cells.cells) map.cells.push_back({cell.failed, percent_of_motion(cell)});
  add_limits(cells, map);
  if (cells.boundary.empty()) add_edges(cells, map);
  map.footer = "Each cell is a run of the scene's duration and of at least " + std::to_string(kLeastSteps) +
               " steps; colour: its largest energy error against the motion's largest kinetic energy; failed: no end, or an error above " +
               format_shortest(kFailedEnergy) + " times that." + unknown_text(cells);
  if (!map.boundaries.empty()) {
    const Agreement agreement(cells);
    map.footer += agreement.is_rough() ? " " + agreement.text() : " Theory: the limit of the motion linearised about " + place_of(cells) + ".";
    if (agreement.is_rough()) map.boundaries.clear();
    if (!agreement.is_rough() && cells.about_motion > 0) map.footer += " " + std::string(kNoEquilibrium) + ".";
  }
  if (scene.limit == LimitPolicy::clamp)
    map.footer += " Torques are cut at the joints' efforts, which bounds errors of the energy, too: a run may chatter and not fail.";
  return map;
}

std::string csv_of(const std::string& scene, const StabilityCells& cells) {
  std::string text = csv_facts(scene) + cells.x.key + "," + cells.y.key +
                     ",status,failed,energy_error [J],energy_scale [J],stable_by_theory,trouble\n";
  for (std::size_t iy = 0; iy < cells.y.values.size(); ++iy)
    for (std::size_t ix = 0; ix < cells.x.values.size(); ++ix) {
      const StabilityCell& cell = cells.at(ix, iy);
      text += cells.x.values[ix] + "," + cells.y.values[iy] + "," + to_string(cell.status) + "," +
              (cell.failed ? "1," : "0,") +
              (std::isfinite(cell.energy_error) ? format_shortest(cell.energy_error) : "") + "," +
              (std::isfinite(cell.energy_scale) ? format_shortest(cell.energy_scale) : "") + "," +
              (cell.stable ? (*cell.stable ? "1" : "0") : "") + "," +
              csv_words(cell.trouble) + "\n";
    }
  return text;
}

void print_map_summary(const StabilityCells& cells) {
  std::size_t failed = 0;
  for (const StabilityCell& cell : cells.cells) failed += cell.failed;
  std::printf(
      "%s: %zu of %zu cells fail (no end, or an energy error above %s times the motion's); %d threads%s\n",
      cells.method.c_str(), failed, cells.cells.size(), format_shortest(kFailedEnergy).c_str(), cells.threads,
      cells.in_batches ? ", stepped in batches" : "");
  if (const Agreement agreement(cells); agreement.is_rough()) std::printf("%s\n", agreement.text().c_str());
  if (cells.along_runs > 0 || cells.about_motion > 0)
    std::printf("theory: of the motion linearised about %s%s\n", place_of(cells).c_str(), cells.about_motion > 0 ? (std::string(". ") + kNoEquilibrium).c_str() : "");
}

Json json_of(const std::string& scene, const StabilityCells& cells) {
  Json json{{"scene", scene},
            {"method", cells.method},
            {"x", {{"key", cells.x.key}, {"values", cells.x.numbers}}},
            {"y", {{"key", cells.y.key}, {"values", cells.y.numbers}}},
            {"threads", cells.threads},
            {"rows", Json::array()}};
  std::size_t failed = 0;
  for (std::size_t iy = 0; iy < cells.y.values.size(); ++iy) {
    Json row = Json::array();
    for (std::size_t ix = 0; ix < cells.x.values.size(); ++ix) {
      const StabilityCell& cell = cells.at(ix, iy);
      failed += cell.failed;
      row.push_back({{"failed", cell.failed},
                     {"status", to_string(cell.status)},
                     {"energy_error", cell.energy_error},
                     {"energy_scale", cell.energy_scale}});
      row.back()["stable_by_theory"] = or_null(cell.stable);
      row.back()["trouble"] = or_null(cell.trouble);
    }
    json["rows"].push_back(std::move(row));
  }
  json["failed"] = failed;
  return json;
}

std::string usual_map(const StabilityOptions& options) {
  return "out/" + std::filesystem::path(options.scene).stem().string() + "_stability.png";
}

void draw_map(const StabilityOptions& options) {
  const Sweep x = parse_sweep(options.x, "--x"), y = parse_sweep(options.y, "--y");
  require_map_axis(x, "--x");
  require_map_axis(y, "--y");
  FigureFiles files(options.figure, usual_map(options), options.common.force);
  const std::vector<std::string> overrides = overrides_of(options.common);
  const int threads = options.threads > 0 ? options.threads : usable_cores();
  StabilityCells cells;
  {
    WorkTicker ticker(std::filesystem::path(options.scene).stem().string() + ": simulating", options.common.quiet);
    cells = run_stability_cells(options.scene, overrides, x, y, threads, [&](double part) {
      ticker.tell(part, std::to_string(x.values.size() * y.values.size()) + " cells");
      return interrupted();
    });
  }
  throw_if_interrupted();
  const Scene scene = read_scene(options.scene, overrides);
  const Fonts fonts(families_of(scene));
  const ChartLook look = chart_look(options.figure, scene, fonts);
  const auto report = [&] { return json_of(options.scene, cells); };
  const auto written = files.write([&] { return stability_map(map_of(scene, cells), look); },
                                   {csv_of(options.scene, cells), report}, fonts);
  tell_files(options.common, written, report, [&] { print_map_summary(cells); });
}

// What became of a run with one setting: in words, and as numbers.
struct Verdict {
  std::string words;
  Json json;
};

Verdict verdict(Simulation& simulation, const MethodSetting& setting, const StopRequest& stop) {
  apply(setting, simulation);
  const double end[] = {simulation.duration};
  const Trajectory trajectory = simulate_audited(simulation, end, stop);
  throw_if_interrupted();
  Json json{{"setting", to_string(setting)}, {"status", to_string(trajectory.status)}, {"end_time", trajectory.end_time},
            {"energy_error", nullptr}};
  if (trajectory.status != RunStatus::finished || trajectory.size() == 0)
    return {to_string(trajectory.status) + " at " + format_significant(trajectory.end_time, 3) + " s", json};
  json["energy_error"] = trajectory.energy_at_steps->largest_error;
  return {format_significant(trajectory.energy_at_steps->largest_error, 2) + " J", json};
}

std::string limit_text(const std::optional<double>& limit) {
  if (!limit) return "unknown";
  return std::isfinite(*limit) ? format_significant(*limit, 4) : "none";
}

bool has_no_limit(const std::optional<double>& limit) {
  return limit && !std::isfinite(*limit);
}

Json rate_json(const std::complex<double>& rate) {
  return {{"real", rate.real()}, {"imag", rate.imag()}};
}

Json linearisation_json(const Linearisation& start) {
  Json json{{"trouble", or_null(start.trouble)}, {"about_target", start.about_target}, {"is_equilibrium", nullptr}, {"qd", nullptr}, {"qdd", nullptr}, {"rates", Json::array()}, {"looked_at_along", start.along.size()}, {"fastest_along", nullptr}};
  if (!start.trouble.empty()) return json;
  json.update({{"is_equilibrium", start.is_equilibrium}, {"qd", start.rate}, {"qdd", start.acceleration}});
  for (const std::complex<double>& rate : start.rates) json["rates"].push_back(rate_json(rate));
  if (!start.along.empty()) json["fastest_along"] = rate_json(start.fastest());
  return json;
}

// "decays with 7063 /s", "swings with omega = 10 rad/s, damping ratio 0.05"
std::string rate_text(const std::complex<double>& rate) {
  const double size = std::abs(rate);
  if (rate.imag() == 0)
    return (rate.real() > 0 ? "grows with " : "decays with ") + format_significant(size, 6) + " /s";
  std::string text = "swings with omega = " + format_significant(size, 6) + " rad/s";
  if (rate.real() != 0) text += ", damping ratio " + format_significant(-rate.real() / size, 3);
  return text;
}

void print_linearisation(const Linearisation& start) {
  if (!start.trouble.empty()) return (void)std::printf("no limit can be told: %s\n", start.trouble.c_str());
  std::printf("limits are those of the motion linearised about %s%s; its fastest part %s\n", place_of(start.about_target),
              start.along.empty() ? "" : kAlong, rate_text(start.fastest()).c_str());
  std::printf("none: stable at every step, though its equations may find no solution; 0: at no step; unknown: no limit was found\n");
  if (!start.is_equilibrium && start.along.empty())
    std::printf("that is no equilibrium (qd %s, qdd %s at most): elsewhere limits may differ\n",
                format_significant(start.rate, 3).c_str(), format_significant(start.acceleration, 3).c_str());
  const auto grows = std::find_if(start.rates.begin(), start.rates.end(),
                                  [](const std::complex<double>& rate) { return rate.real() > 0; });
  if (grows != start.rates.end() && start.along.empty())
    std::printf("the motion itself is unstable there: a part of it %s; limits are those of the rest\n",
                rate_text(*grows).c_str());
}

// A row a run.
std::string csv_of_methods(const std::string& scene, const Json& found) {
  const auto number = [](const Json& value) { return value.is_number() ? format_shortest(value.get<double>()) : ""; };
  std::string text = csv_facts(scene) + "method,setting,status,end_time [s],energy_error [J],longest_stable_step [s]\n";
  for (const Json& method : found["methods"])
    for (const Json& run : method["runs"])
      text += method["method"].get<std::string>() + "," + csv_words(run["setting"].get<std::string>()) + "," +
              run["status"].get<std::string>() + "," + number(run["end_time"]) + "," + number(run["energy_error"]) + "," +
              (method["is_always_stable"].get<bool>() ? "inf" : number(method["longest_stable_step"])) + "\n";
  return text;
}

// "Who fails here": every method at three steps or tolerances.
void compare_methods(const StabilityOptions& options) {
  PreparedScene prepared = load_motion(options.scene, overrides_of(options.common), options.panel, options.common.quiet);
  require_computed_run(prepared.scene, "stability");
  Simulation& simulation = prepared.simulation;
  const Linearisation start = linearise_along(simulation);
  std::vector<std::vector<std::string>> table{
      {"method", "coarse", "middle", "fine", "limit of the step, s"}};
  Json found{{"scene", options.scene}, {"methods", Json::array()}, {"left_out", Json::array()}};
  TableRecords records(*options.figure.command, options.common.force);
  records.open(options.figure.outputs, options.figure.outputs);
  const std::vector<const Method*> chosen = parse_methods(options.methods);
  std::optional<WorkTicker> ticker(std::in_place, prepared.scene.name + ": simulating", options.common.quiet);
  double runs_done = 0;
  for (const Method* method : chosen) {
    simulation.method = method;
    try {
      check_method(simulation);
    } catch (const Error& error) {
      found["left_out"].push_back(error.problems().front().message);
      runs_done += 3;
      continue;
    }
    std::vector<std::string> row{method->name};
    Json runs = Json::array();
    for (std::size_t k = 0; k < 3; ++k) {
      Verdict one = verdict(simulation, method->adaptive ? MethodSetting{method, {kTableTolerances[k], 0}, 0}
                                                         : MethodSetting{method, {}, kTableSteps[k]},
                            [&](double t) {
                              ticker->tell((runs_done + part_done(simulation, t)) / (3 * double(chosen.size())), method->name);
                              return interrupted();
                            });
      ++runs_done;
      row.push_back(std::move(one.words));
      runs.push_back(std::move(one.json));
    }
    const std::optional<double> limit = longest_stable_step(*method, start);
    row.push_back(limit_text(limit));
    table.push_back(row);
    found["methods"].push_back({{"method", method->name}, {"runs", runs}, {"longest_stable_step", has_no_limit(limit) ? Json(nullptr) : or_null(limit)}, {"is_always_stable", has_no_limit(limit)}});
  }
  ticker.reset();
  found["start"] = linearisation_json(start);
  const std::vector<std::string>& outputs = options.figure.outputs;
  const FigureNumbers numbers{csv_of_methods(options.scene, found), [&] { return found; }};
  for (const std::string& output : outputs) write_numbers(output, numbers, options.common.force);
  records.write();
  if (options.common.json) {
    found.update(files_json(outputs));
    return print_json(found);
  }
  if (options.common.quiet && !outputs.empty()) return;
  std::printf(
      "Who fails here: the largest energy error with steps of 0.1, 0.01 and 0.001 s, or tolerances of "
      "1e-3, 1e-6 and 1e-9\n");
  std::fputs(table_text(table).c_str(), stdout);
  for (const Json& line : found["left_out"]) std::printf("left out: %s\n", line.get<std::string>().c_str());
  print_linearisation(start);
}

// The options of one method's map; of several their files bear its name.
StabilityOptions map_by(const StabilityOptions& options, const Method& method, bool is_one_of_several) {
  StabilityOptions one = options;
  one.methods.clear();
  one.common.set.push_back("method=" + method.name);
  one.figure.is_one_of_several = is_one_of_several;
  if (!is_one_of_several) return one;
  if (one.figure.outputs.empty()) one.figure.outputs = {usual_map(options)};
  for (std::string& output : one.figure.outputs) {
    const std::filesystem::path path(output);
    output = (path.parent_path() / (path.stem().string() + "_" + method.name + path.extension().string())).string();
  }
  return one;
}

void run_stability(const StabilityOptions& options) {
  check_figure_size(options.figure);
  if (options.x.empty() != options.y.empty())
    throw Error(ExitCode::usage, "a map needs both --x and --y: the runs along one key alone are a table of `sweep`; without either the methods are compared");
  if (options.x.empty()) {
    for (const std::string& output : options.figure.outputs) {
      if (!is_table_path(output))
        throw Error(ExitCode::usage, "-o " + output +
                                         ": without --x and --y methods are compared, whose table is written as .csv, .json or .npz");
      const OutputFile may_be_written(output, options.common.force);  // throws where it may not, before anything is run
    }
    return compare_methods(options);
  }
  if (options.panel > 0)
    throw Error(ExitCode::usage, "--panel goes with the table of methods; a map takes what all panels share: --set compare=");
  if (options.methods.empty()) return draw_map(options);
  const std::vector<const Method*> chosen = parse_methods(options.methods);
  if (chosen.size() > 1 && options.common.json)
    throw Error(ExitCode::usage, "--json tells of one map: name one of --methods, or write -o map.json, which becomes a file of each");
  std::vector<StabilityOptions> maps;
  for (const Method* method : chosen) maps.push_back(map_by(options, *method, chosen.size() > 1));
  // Each file may be written before any map is computed.
  for (const StabilityOptions& one : maps) FigureFiles(one.figure, "", one.common.force);
  for (const StabilityOptions& one : maps) draw_map(one);
}

}  // namespace

void add_stability_command(CommandLine& app) {
  auto options = std::make_shared<StabilityOptions>();
  Command* command = app.add_subcommand(
      "stability", "a map of where a scene fails over two of its keys, or a table of which method does");
  command->add_option("scene", options->scene, "a scene file").required().names_input();
  command->add_option("--x", options->x, "KEY=from:to:count, maybe with :log behind it; a picture needs --x and --y: without them there is the table of methods");
  command->add_option("--y", options->y, "the same, upward");
  command->add_option("--methods", options->methods, "rk4,taylor,..: of the table (default all); of maps one each, in files of their names (default the scene's)");
  add_panel_option(*command, options->panel);
  command->add_option("--jobs", options->threads, "threads (default: all cores)").range(1, 256);
  add_figure_options(*command, options->figure, options->common, "of maps out/NAME_stability.png, of tables none");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer(
      "Example: chainreel stability pp_spring --set 'torque=[0, -k * y_G]'\n"
      "         --set parameters.k=100 --x step=0.02:0.4:96 --y parameters.k=25:400:60");
  command->callback([options] { run_stability(*options); });
}

}  // namespace chainreel
