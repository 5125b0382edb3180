// chainreel energy SCENE --until 1000s: how far the energy strays with each method, or in each panel of a comparison.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/figure.hpp"
#include "app/film/automatic.hpp"
#include "app/film/prepared.hpp"
#include "app/film/progress.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/charts/energy_chart.hpp"
#include "draw/charts/lit_colours.hpp"
#include "draw/page/house_style.hpp"
#include "picture/formula_words.hpp"
#include "scene/run/title.hpp"
#include "scene/text/read_scene.hpp"
#include "sim/audit.hpp"
#include "sim/workload.hpp"

namespace chainreel {
namespace {

struct EnergyOptions {
  std::string scene;
  std::string until;
  std::string methods;
  std::string highlight;
  std::string step;
  double tolerance = 0;
  int panel = 0;  // from 1; 0: not given
  bool total = false;
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

// One curve: a method on the motion, or a panel as its scene says it.
struct Subject {
  Simulation* simulation = nullptr;
  MethodSetting setting;
  std::string title;  // what the picture and the table call it; "": the method
  int panel = 0;      // from 1; 0: of no panel
};

// What is compared, and on what.
struct EnergySubjects {
  std::vector<PreparedScene> scenes;  // the motion, or a panel each
  std::vector<Subject> subjects;
  std::vector<std::string> left_out;
  std::string title;     // of the picture of which these are panels
  std::string settings;  // of all subjects: "steps of 0.01 s, tolerances of 1e-09"; "": each has its own

  const PreparedScene& first() const { return scenes.front(); }
};

// Fixed steps and tolerances are those asked for, else the scene's, else the defaults.
struct Settings {
  std::optional<double> step, tolerance;

  MethodSetting of(const Method& method, const Scene& scene) const {
    const int order = method.highest_order > 0 ? scene.order && method.name == scene.method ? *scene.order : method.order : 0;
    return method.adaptive ? MethodSetting{&method, {tolerance_in(scene), order}, 0} : MethodSetting{&method, {}, step_in(scene)};
  }
  double step_in(const Scene& scene) const { return step.value_or(scene.step.value_or(kDefaultStep)); }
  double tolerance_in(const Scene& scene) const { return tolerance.value_or(scene.tolerance.value_or(kDefaultTolerance)); }
};

Settings settings_of(const EnergyOptions& options) {
  Settings settings;
  if (!options.step.empty()) settings.step = parse_positive_seconds(options.step, "--step", "10ms");
  if (options.tolerance > 0 && options.tolerance < kLeastTolerance)
    throw Error(ExitCode::usage, "--tolerance is below the rounding of doubles, which no step can meet: take " +
                                     format_shortest(kLeastTolerance) + " or more");
  if (options.tolerance > 0) settings.tolerance = options.tolerance;
  return settings;
}

// All methods on one motion. Those that cannot take it are left out.
EnergySubjects compare_methods_on(PreparedScene motion, const std::vector<const Method*>& methods, const Settings& settings) {
  EnergySubjects all;
  all.scenes.push_back(std::move(motion));
  Simulation& simulation = all.scenes.front().simulation;
  const Scene& scene = all.scenes.front().scene;
  for (const Method* method : methods) {
    simulation.method = method;
    try {
      check_method(simulation);
      all.subjects.push_back({&simulation, settings.of(*method, scene), "", 0});
    } catch (const Error& error) {
      all.left_out.push_back(error.problems().front().message);
    }
  }
  const auto is_adaptive = [](const Subject& one) { return one.setting.method->adaptive; };
  std::vector<std::string> words;
  if (!std::all_of(all.subjects.begin(), all.subjects.end(), is_adaptive))
    words.push_back("steps of " + format_shortest(settings.step_in(scene)) + " s");
  if (std::any_of(all.subjects.begin(), all.subjects.end(), is_adaptive))
    words.push_back("tolerances of " + format_shortest(settings.tolerance_in(scene)));
  all.settings = joined(words);
  return all;
}

// Each panel with its own method, step and tolerance, where the command line says no others.
EnergySubjects compare_panels(PreparedFilm film, const Settings& settings) {
  EnergySubjects all;
  all.title = title_over_runs(film.scene);
  all.scenes = std::move(film.panels);
  for (PreparedScene& panel : all.scenes) {
    Simulation& simulation = panel.simulation;
    if (!simulation.method) continue;
    MethodSetting setting{simulation.method, simulation.options, simulation.step};
    if (settings.step && setting.step > 0) setting.step = *settings.step;
    if (settings.tolerance && setting.options.tolerance > 0) setting.options.tolerance = *settings.tolerance;
    all.subjects.push_back({&simulation, setting, in_plain_words(panel.scene.title), int(all.subjects.size()) + 1});
  }
  return all;
}

EnergySubjects subjects_of(const EnergyOptions& options, const std::vector<const Method*>& methods, const Settings& settings) {
  const std::vector<std::string> overrides = overrides_of(options.common);
  if (options.methods.empty() && options.panel == 0 &&
      !read_scene(options.scene, overrides, MethodsOf::command).compare.empty()) {
    PreparedFilm film = load_film(options.scene, overrides, false, options.common.quiet);
    for (const PreparedScene& panel : film.panels) require_computed_run(panel.scene, "energy");
    for (PreparedScene& panel : film.panels) leave_events_out(panel);
    say_choice(film.panels, options.common.quiet);
    return compare_panels(std::move(film), settings);
  }
  PreparedScene motion = load_motion(options.scene, overrides, options.panel, options.common.quiet);
  require_computed_run(motion.scene, "energy");
  return compare_methods_on(std::move(motion), methods, settings);
}

std::string one_word(RunStatus status) {
  return status == RunStatus::finished ? "" : to_string(status);
}

struct MethodRun {
  const Subject* subject = nullptr;
  EnergyCurve curve;  // at the ends of steps
  double largest = 0, at_end = 0;
  double largest_between = 0;  // on the method's dense output
  long evaluations = 0;
};

// The largest of the errors at the ends of steps in each column, at the instant where it occurs: no step is
// left out, however many there are.
class Columns {
 public:
  Columns(const std::vector<double>& ends, EnergyCurve& curve) : ends_(ends), curve_(curve) {}

  void see(double t, const EnergyBalance::State& state, double springs) {
    const double error = state.error, energy = state.kinetic + state.potential + springs;
    const std::size_t before = column_;
    while (column_ + 1 < ends_.size() && t > ends_[column_]) ++column_;
    if (curve_.t.empty() || column_ != before) {
      curve_.t.push_back(t);
      curve_.error.push_back(error);
      curve_.energy.push_back(energy);
    } else if (std::abs(error) > std::abs(curve_.error.back())) {
      curve_.t.back() = t;
      curve_.error.back() = error;
      curve_.energy.back() = energy;
    }
  }

 private:
  const std::vector<double>& ends_;
  EnergyCurve& curve_;
  std::size_t column_ = 0;
};

MethodRun run_subject(const Subject& subject, const std::vector<double>& times, const StopRequest& stop) {
  Simulation& simulation = *subject.simulation;
  const Method& method = *subject.setting.method;
  apply(subject.setting, simulation);
  MethodRun run;
  run.subject = &subject;
  EnergyBalance balance(simulation);
  const SpringEnergy springs(simulation);
  Columns columns(times, run.curve);
  const Trajectory trajectory = simulate(
      simulation, times, stop,
      [&](double t, ConstVec q, ConstVec qd, double work) {
        const EnergyBalance::State state = balance.at(q, qd, work);
        run.at_end = state.error;
        // No number is farther off than any: the work behind a pole of a torque.
        run.largest = std::isfinite(run.at_end) ? std::max(run.largest, std::abs(run.at_end)) : std::numeric_limits<double>::infinity();
        columns.see(t, state, springs.at(q));
      });
  throw_if_interrupted();
  run.largest_between = audit_of(simulation, trajectory).largest_error;
  run.evaluations = trajectory.evaluations;
  run.curve.method = subject.panel > 0 ? subject.title : method.name;
  run.curve.title = subject.panel > 0 ? subject.title : method.title;
  run.curve.trouble = one_word(trajectory.status);
  if (run.curve.trouble.empty() && !std::isfinite(run.largest)) run.curve.trouble = "work is no number";
  run.curve.look = subject.panel > 0 ? -1 : int(&method - methods().data());
  return run;
}

std::string csv_of(const std::string& scene, const std::vector<MethodRun>& runs) {
  std::string text = csv_facts(scene);
  for (const MethodRun& run : runs)
    text += "# " + (run.subject->panel > 0 ? "panel " + std::to_string(run.subject->panel) + ": " : "") + to_string(run.subject->setting) + "\n";
  const bool of_panels = !runs.empty() && runs.front().subject->panel > 0;
  text += std::string(of_panels ? "panel," : "") + "method,t [s],energy_error [J],energy [J]\n";
  for (const MethodRun& run : runs)
    for (std::size_t k = 0; k < run.curve.t.size(); ++k)
      text += (of_panels ? std::to_string(run.subject->panel) + "," : "") + run.subject->setting.method->name + "," +
              format_shortest(run.curve.t[k]) + "," + format_shortest(run.curve.error[k]) + "," +
              format_shortest(run.curve.energy[k]) + "\n";
  return text;
}

EnergyChart chart_of(const EnergySubjects& all, double until, const std::vector<MethodRun>& runs, bool total) {
  const Scene& scene = all.first().scene;
  EnergyChart chart;
  chart.shows_energy = total;
  chart.title = (total ? "Energy until " : "Energy error until ") + format_shortest(until) + " s";
  chart.subtitle = all.settings.empty() ? all.title : title_over_runs(scene) + "; " + all.settings;
  for (const MethodRun& run : runs) chart.curves.push_back(run.curve);
  return chart;
}

// Of so many all are told apart; of more those that are asked for, else the most exact and what the scene itself takes.
void light_curves_of(EnergyChart& chart, const std::vector<MethodRun>& runs, const std::vector<std::string>& asked, const PreparedScene& prepared) {
  constexpr std::size_t kMostLit = 6;
  if (asked.empty() && runs.size() <= kMostLit) return;
  const auto is_better = [](const MethodRun& a, const MethodRun& b) {
    return a.curve.trouble.empty() != b.curve.trouble.empty() ? a.curve.trouble.empty() : a.largest < b.largest;
  };
  const MethodRun* const best = &*std::ranges::min_element(runs, is_better);
  const std::string own = prepared.choice ? prepared.choice->best.setting.method->name : prepared.scene.method;
  std::vector<int*> looks;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string& name = runs[i].subject->setting.method->name;
    EnergyCurve& curve = chart.curves[i];
    curve.is_lit = asked.empty() ? &runs[i] == best || name == own : std::ranges::count(asked, name) > 0;
    if (!curve.is_lit) continue;
    if (curve.look < 0) curve.look = int(i);
    looks.push_back(&curve.look);
  }
  tell_colours_apart(looks);
  if (!asked.empty()) return;
  const bool has_own = std::ranges::any_of(runs, [&](const MethodRun& run) { return run.subject->setting.method->name == own; });
  chart.footer = best->subject->setting.method->name == own ? "in colour: the scene's method, which is the most exact"
                 : has_own                                   ? "in colour: the most exact, and the scene's method"
                                                             : "in colour: the most exact";
}

std::string status_of(const MethodRun& run) {
  return run.curve.trouble.empty() ? "finished" : run.curve.trouble;
}

void print_table(const std::vector<MethodRun>& runs, const std::vector<std::string>& left_out) {
  std::vector<std::vector<std::string>> table{
      {"method", "largest error, J", "at the end, J", "between steps, J", "evaluations", "status"}};
  for (const MethodRun& run : runs)
    table.push_back({(run.subject->title.empty() ? "" : run.subject->title + ": ") + to_string(run.subject->setting),
                     format_significant(run.largest, 3), format_significant(run.at_end, 3),
                     format_significant(run.largest_between, 3), std::to_string(run.evaluations), status_of(run)});
  std::fputs(table_text(table).c_str(), stdout);
  std::printf(
      "errors are those at the ends of all steps; `between steps` is the largest on dense output, which "
      "frames "
      "show\n");
  for (const std::string& line : left_out) std::printf("left out: %s\n", line.c_str());
}

Json json_of(const std::string& scene, double until, const std::vector<MethodRun>& runs,
             const std::vector<std::string>& left_out) {
  Json json{{"scene", scene}, {"duration", until}, {"runs", Json::array()}, {"left_out", left_out}};
  for (const MethodRun& run : runs)
    json["runs"].push_back({{"panel", run.subject->panel > 0 ? Json(run.subject->panel) : Json(nullptr)},
                            {"title", run.subject->title},
                            {"method", run.subject->setting.method->name},
                            {"setting", to_string(run.subject->setting)},
                            {"largest_error", run.largest},
                            {"error_at_end", run.at_end},
                            {"largest_between_steps", run.largest_between},
                            {"evaluations", run.evaluations},
                            {"status", status_of(run)}});
  return json;
}

// Before the first of them runs.
void require_all_possible(const EnergySubjects& all) {
  double work = 0;
  for (const Subject& subject : all.subjects) {
    apply(subject.setting, *subject.simulation);
    require_possible(*subject.simulation);
    work += least_work(*subject.simulation);
  }
  require_possible(work, double(all.subjects.size()));
}

std::vector<MethodRun> run_all(const EnergySubjects& all, double until, bool quiet) {
  const std::vector<double> times = times_until(until);
  std::vector<MethodRun> runs;
  WorkTicker ticker(all.first().scene.name + ": simulating", quiet);
  for (const Subject& subject : all.subjects)
    runs.push_back(run_subject(subject, times, [&](double t) {
      ticker.tell((double(runs.size()) + part_done(*subject.simulation, t)) / double(all.subjects.size()),
                  subject.setting.method->name);
      return interrupted();
    }));
  return runs;
}

void run_energy(const EnergyOptions& options) {
  check_figure_size(options.figure);
  const std::vector<const Method*> chosen = parse_methods(options.methods);
  const std::vector<std::string> asked = parse_highlight(options.highlight, chosen);
  EnergySubjects all = subjects_of(options, chosen, settings_of(options));
  const Scene& scene = all.first().scene;
  const double until = options.until.empty() ? scene.duration : parse_positive_seconds(options.until, "--until", "1000s");
  for (PreparedScene& one : all.scenes) one.simulation.duration = until;
  FigureFiles files(options.figure, "out/" + scene.name + "_energy.png", options.common.force);
  require_all_possible(all);
  for (const std::string& name : asked)
    if (std::ranges::none_of(all.subjects, [&](const Subject& one) { return one.setting.method->name == name; }))
      throw Error(ExitCode::bad_input, "--highlight: " + name + " does not take this scene", scene.place_of("method"));
  const std::vector<MethodRun> runs = run_all(all, until, options.common.quiet);

  warn_of_rank(all.first(), until);

  const Fonts fonts(families_of(scene));
  const ChartLook look = chart_look(options.figure, scene, fonts);
  const auto report = [&] { return json_of(options.scene, until, runs, all.left_out); };
  EnergyChart chart = chart_of(all, until, runs, options.total);
  light_curves_of(chart, runs, asked, all.first());
  const auto written = files.write([&] { return energy_chart(chart, look); },
                                   {csv_of(options.scene, runs), report}, fonts);
  tell_files(options.common, written, report, [&] { print_table(runs, all.left_out); });
}

}  // namespace

void add_energy_command(CommandLine& app) {
  auto options = std::make_shared<EnergyOptions>();
  Command* command =
      app.add_subcommand("energy", "a chart of the energy error against time, a curve a method, or of a scene that compares several a curve a panel");
  command->add_option("scene", options->scene, "a scene file").required().names_input();
  command->add_flag("--total", options->total, "the picture shows the energies themselves, on plain axes, instead of their errors");
  command->add_option("--until", options->until, "how long, like 1000s (default the scene's duration)");
  command->add_option("--methods", options->methods, "rk4,taylor,.. (default all that take the scene, or what its panels say)");
  command->add_option("--highlight", options->highlight, "taylor,rk4: these in colour, the rest grey (default of more than six the most exact and the scene's)");
  add_panel_option(*command, options->panel);
  command->add_option("--step", options->step, "of methods of fixed step, like 10ms (default the scene's, else 0.01)");
  command
      ->add_option("--tolerance", options->tolerance, "of adaptive methods (default the scene's, else 1e-9)")
      .positive();
  add_figure_options(*command, options->figure, options->common, "out/NAME_energy.png");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel energy rr_free --until 100s --step 0.01\n"
                  "or, the energies of the lecture's Euler methods: chainreel energy rr_free --total --methods explicit_euler,semi_implicit_euler,rk4");
  command->callback([options] { run_energy(*options); });
}

}  // namespace chainreel
