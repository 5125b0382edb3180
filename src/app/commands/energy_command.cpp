// chainreel energy SCENE --until 1000s: how far the energy strays with each method.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/figure.hpp"
#include "app/film/progress.hpp"
#include "app/film/prepared.hpp"
#include "app/report/report.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/charts/energy_chart.hpp"
#include "draw/page/house_style.hpp"
#include "sim/audit.hpp"
#include "sim/workload.hpp"

namespace chainreel {
namespace {

struct EnergyOptions {
  std::string scene;
  std::string until;
  std::string methods;
  std::string step;
  double tolerance = 0;
  FigureOptions figure;
  CommonOptions common;
};

constexpr int kEarlyTimes = 1000, kLaterTimes = 9000;
constexpr double kDefaultStep = 0.01, kDefaultTolerance = 1e-9;
constexpr double kEarliest = 1e-4;  // of the whole time

// The ends of the columns in which the largest error is kept, and the instants at which dense output is
// looked at. Close together early on, where a log axis has room, and evenly later.
std::vector<double> times_until(double end) {
  std::vector<double> times;
  const double knee = 0.01 * end;
  for (int k = 0; k < kEarlyTimes; ++k)
    times.push_back(knee * std::pow(100 * kEarliest, 1 - double(k) / kEarlyTimes));
  for (int k = 0; k <= kLaterTimes; ++k) times.push_back(knee + (end - knee) * k / kLaterTimes);
  times.back() = end;
  return times;
}

// Fixed steps and tolerances are those asked for, else the scene's, else the defaults.
struct Settings {
  double step, tolerance;
  MethodSetting of(const Method& method) const {
    const int order = method.highest_order > 0 ? method.order : 0;
    return method.adaptive ? MethodSetting{&method, {tolerance, order}, 0} : MethodSetting{&method, {}, step};
  }
};

Settings settings_of(const EnergyOptions& options, const Scene& scene) {
  Settings settings{options.step.empty() ? 0 : parse_positive_seconds(options.step, "--step", "10ms"), options.tolerance};
  if (settings.tolerance > 0 && settings.tolerance < kLeastTolerance)
    throw Error(ExitCode::usage, "--tolerance is below the rounding of doubles, which no step can meet: take " +
                                     format_shortest(kLeastTolerance) + " or more");
  if (settings.step <= 0) settings.step = scene.step.value_or(kDefaultStep);
  if (settings.tolerance <= 0) settings.tolerance = scene.tolerance.value_or(kDefaultTolerance);
  return settings;
}

std::string one_word(RunStatus status) {
  return status == RunStatus::finished ? "" : to_string(status);
}

struct MethodRun {
  EnergyCurve curve;  // at the ends of steps
  MethodSetting setting;
  double largest = 0, at_end = 0;
  double largest_between = 0;  // on the method's dense output
  long evaluations = 0;
};

// The largest of the errors at the ends of steps in each column, at the instant where it occurs: no step is
// left out, however many there are.
class Columns {
 public:
  Columns(const std::vector<double>& ends, EnergyCurve& curve) : ends_(ends), curve_(curve) {}

  void see(double t, double error) {
    const std::size_t before = column_;
    while (column_ + 1 < ends_.size() && t > ends_[column_]) ++column_;
    if (curve_.t.empty() || column_ != before) {
      curve_.t.push_back(t);
      curve_.error.push_back(error);
    } else if (std::abs(error) > std::abs(curve_.error.back())) {
      curve_.t.back() = t;
      curve_.error.back() = error;
    }
  }

 private:
  const std::vector<double>& ends_;
  EnergyCurve& curve_;
  std::size_t column_ = 0;
};

MethodRun run_method(Simulation& simulation, const MethodSetting& setting, const std::vector<double>& times,
                     const StopRequest& stop) {
  apply(setting, simulation);
  MethodRun run;
  run.setting = setting;
  EnergyBalance balance(simulation);
  Columns columns(times, run.curve);
  const Trajectory trajectory = simulate(
      simulation, times, stop,
      [&](double t, ConstVec q, ConstVec qd, double work) {
        run.at_end = balance.at(q, qd, work).error;
        run.largest = std::max(run.largest, std::abs(run.at_end));
        columns.see(t, run.at_end);
      });
  throw_if_interrupted();
  run.largest_between = audit_of(simulation, trajectory).largest_error;
  run.evaluations = trajectory.evaluations;
  run.curve.method = setting.method->name;
  run.curve.title = setting.method->title;
  run.curve.trouble = one_word(trajectory.status);
  run.curve.look = int(setting.method - methods().data());
  return run;
}

std::string csv_of(const std::string& scene, const std::vector<MethodRun>& runs) {
  std::string text = csv_facts(scene);
  for (const MethodRun& run : runs) text += "# " + to_string(run.setting) + "\n";
  text += "method,t,energy_error\n";
  for (const MethodRun& run : runs)
    for (std::size_t k = 0; k < run.curve.t.size(); ++k)
      text += run.curve.method + "," + format_shortest(run.curve.t[k]) + "," +
              format_shortest(run.curve.error[k]) + "\n";
  return text;
}

EnergyChart chart_of(const PreparedScene& prepared, const Settings& settings, double until,
                     const std::vector<MethodRun>& runs) {
  EnergyChart chart;
  chart.title = "Energy error until " + format_shortest(until) + " s";
  chart.subtitle = (prepared.scene.title.empty() ? prepared.scene.name : prepared.scene.title) +
                   "; steps of " + format_shortest(settings.step) + " s, tolerances of " +
                   format_shortest(settings.tolerance);
  for (const MethodRun& run : runs) chart.curves.push_back(run.curve);
  return chart;
}

void print_table(const std::vector<MethodRun>& runs, const std::vector<std::string>& left_out) {
  std::vector<std::vector<std::string>> table{
      {"method", "largest error, J", "at the end, J", "between steps, J", "evaluations", "status"}};
  for (const MethodRun& run : runs)
    table.push_back({to_string(run.setting), format_significant(run.largest, 3),
                     format_significant(run.at_end, 3), format_significant(run.largest_between, 3),
                     std::to_string(run.evaluations),
                     run.curve.trouble.empty() ? "finished" : run.curve.trouble});
  std::fputs(table_text(table).c_str(), stdout);
  std::printf(
      "errors are those at the ends of all steps; `between steps` is the largest on dense output, which "
      "frames "
      "show\n");
  for (const std::string& line : left_out) std::printf("left out: %s\n", line.c_str());
}

Json json_of(const std::string& scene, double until, const std::vector<MethodRun>& runs,
             const std::vector<std::string>& left_out) {
  Json json{{"scene", scene}, {"until", until}, {"runs", Json::array()}, {"left_out", left_out}};
  for (const MethodRun& run : runs)
    json["runs"].push_back({{"method", run.curve.method},
                            {"setting", to_string(run.setting)},
                            {"largest_error", run.largest},
                            {"error_at_end", run.at_end},
                            {"largest_between_steps", run.largest_between},
                            {"evaluations", run.evaluations},
                            {"status", run.curve.trouble.empty() ? "finished" : run.curve.trouble}});
  return json;
}

// Before the first of them runs.
void require_all_possible(Simulation& simulation, const std::vector<const Method*>& chosen, const Settings& settings) {
  double work = 0;
  for (const Method* method : chosen) {
    apply(settings.of(*method), simulation);
    require_possible(simulation);
    work += least_work(simulation);
  }
  require_possible(work, double(chosen.size()));
}

void run_energy(const EnergyOptions& options) {
  check_figure_size(options.figure);
  const std::vector<const Method*> chosen = parse_methods(options.methods);
  PreparedScene prepared = load_scene(options.scene, overrides_of(options.common), false, options.common.quiet);
  require_computed_run(prepared.scene, "energy");
  const Settings settings = settings_of(options, prepared.scene);
  Simulation& simulation = prepared.simulation;
  if (!options.until.empty()) simulation.duration = parse_positive_seconds(options.until, "--until", "1000s");
  std::string output = options.figure.output;
  if (output.empty()) output = "out/" + prepared.scene.name + "_energy.png";
  check_figure_path(output);

  require_all_possible(simulation, chosen, settings);

  const std::vector<double> times = times_until(simulation.duration);
  std::vector<MethodRun> runs;
  std::vector<std::string> left_out;
  std::optional<WorkTicker> ticker(std::in_place, prepared.scene.name + ": simulating", options.common.quiet);
  for (const Method* method : chosen) {
    simulation.method = method;
    try {
      check_method(simulation);
    } catch (const Error& error) {
      left_out.push_back(error.problems().front().message);
      continue;
    }
    const double before = double(runs.size() + left_out.size());
    runs.push_back(run_method(simulation, settings.of(*method), times, [&](double t) {
      ticker->tell((before + part_done(simulation, t)) / double(chosen.size()), method->name);
      return interrupted();
    }));
  }
  ticker.reset();

  const Fonts fonts(families_of(prepared.scene));
  const ChartLook look = chart_look(options.figure, prepared.scene, fonts);
  const EnergyChart chart = chart_of(prepared, settings, simulation.duration, runs);
  const auto report = [&] { return json_of(options.scene, simulation.duration, runs, left_out); };
  const auto files = write_figure(energy_chart(chart, look), {csv_of(options.scene, runs), report}, options.figure,
                                  output, fonts, options.common.force);
  tell_files(options.common, files, report, [&] { print_table(runs, left_out); });
}

}  // namespace

void add_energy_command(CommandLine& app) {
  auto options = std::make_shared<EnergyOptions>();
  Command* command =
      app.add_subcommand("energy", "a chart of the energy error against time, a curve a method");
  command->add_option("scene", options->scene, "a scene file").required().names_input();
  command->add_option("--until", options->until, "how long, like 1000s (default the scene's duration)");
  command->add_option("--methods", options->methods, "rk4,taylor,.. (default all that take the scene)");
  command->add_option("--step", options->step, "of methods of fixed step, like 10ms (default the scene's, else 0.01)");
  command
      ->add_option("--tolerance", options->tolerance, "of adaptive methods (default the scene's, else 1e-9)")
      .positive();
  add_figure_options(*command, options->figure, options->common, "out/NAME_energy.png");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel energy rr_free --until 100s --step 0.01");
  command->callback([options] { run_energy(*options); });
}

}  // namespace chainreel
