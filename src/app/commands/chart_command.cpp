// chainreel chart SCENE: speed against accuracy, every method at every rung of its ladder.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

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
#include "draw/charts/chart.hpp"
#include "draw/page/house_style.hpp"
#include "scene/run/title.hpp"
#include "sim/choice/work_precision.hpp"
#include "sim/plots.hpp"
#include "sim/simulate.hpp"

namespace chainreel {
namespace {

// A run that is off by so many times the size of the motion, at least 1 rad or m, is lost, however far it is off.
constexpr double kLost = 100;
// And one that is off by more than this share of it is no answer that could be cheap.
constexpr double kAnswer = 0.1;

constexpr std::array kErrors = {"way", "final", "energy"};  // in the order of Judged, as their keys
constexpr std::array kJudgedKeys = {"way_error", "error", "energy_error"};

struct ChartOptions {
  std::string scene;
  std::string methods;
  std::string highlight;
  int runs = 5;
  std::string longest = "100ms";
  std::string error = "way";  // of kErrors
  std::string reach = "1e-3,1e-6,1e-9";  // errors that the printed table is for
  int panel = 0;  // from 1; 0: the motion that all share
  FigureOptions figure;
  CommonOptions common;

  Judged judged() const { return Judged(std::ranges::find(kErrors, error) - kErrors.begin()); }
  bool judges_energy() const { return judged() == Judged::energy; }
};

struct Measured {
  LadderReference reference;
  std::vector<Ladder> ladders;
  std::optional<Choice> choice;
  Accuracy accuracy;
  double duration = 0;         // s, of the scene
  std::optional<double> until;  // s, less than that: what is judged; behind it no run follows the motion

  // "5 s", "the first 2.65 of 5 s"
  std::string span() const {
    return (until ? "the first " + format_shortest(*until) + " of " : "") + format_shortest(duration) + " s";
  }
  // A run that is off by more is no answer that could be cheap: rad or m, or J.
  double largest_answer(const ChartOptions& options) const {
    if (!options.judges_energy()) return kAnswer * farthest();
    return reference.run.energy > 0 ? kAnswer * reference.run.energy : std::numeric_limits<double>::infinity();
  }
  double farthest() const {
    double most = 1;  // rad or m
    for (const double q : reference.run.q) most = std::max(most, std::abs(q));
    return most;
  }
  bool has_answer(const ChartOptions& options) const {
    const double largest = largest_answer(options);
    return std::ranges::any_of(ladders, [&](const Ladder& ladder) {
      return std::ranges::any_of(ladder.rungs, [&](const Rung& rung) { return judged_error(rung, options.judged()) <= largest; });
    });
  }
};

bool stop_asked(double) {
  return interrupted();
}

// The setting that `auto` takes becomes a rung of its method's ladder, unless it is one already. It may be of another order than these: it
// is no part of their curve.
struct ChoiceRung {
  int at = -1;
  bool is_apart = false;
};

ChoiceRung add_choice(Simulation& simulation, const Measured& measured, Ladder& ladder, const ChartOptions& options) {
  const MethodSetting& setting = measured.choice->best.setting;
  auto& rungs = ladder.rungs;
  for (std::size_t k = 0; k < rungs.size(); ++k)
    if (to_string(rungs[k].setting) == to_string(setting)) return {int(k), false};
  const Rung rung = measure(simulation, setting, measured.reference.run, options.runs, stop_asked);
  const double error = judged_error(rung, options.judged());
  const auto place = std::find_if(rungs.begin(), rungs.end(), [&](const Rung& one) { return judged_error(one, options.judged()) < error; });
  return {int(rungs.insert(place, rung) - rungs.begin()), true};
}

void measure_ladders(PreparedScene& prepared, const std::vector<const Method*>& chosen, const ChartOptions& options, Measured& measured) {
  Simulation& simulation = prepared.simulation;
  {
    // It takes seconds and cannot be asked how far it is.
    Ticker ticker(options.common.quiet);
    if (!options.common.quiet && isatty(STDERR_FILENO) != 0) ticker.say(prepared.scene.name + ": computing the reference");
    try {
      measured.reference = find_reference_run(simulation, stop_asked);
    } catch (const Error&) {
      throw_if_interrupted();
      throw;
    }
  }
  LadderOptions ladder;
  ladder.runs = options.runs;
  ladder.judged = options.judged();
  ladder.longest_run = parse_positive_seconds(options.longest, "--longest", "100ms");
  WorkTicker ticker(prepared.scene.name + ": measuring", options.common.quiet);
  measured.ladders.clear();
  for (const Method* method : chosen) {
    measured.ladders.push_back(climb(simulation, *method, measured.reference.run, ladder, [&](double) {
      ticker.tell(double(measured.ladders.size()) / double(chosen.size()), method->name);
      return interrupted();
    }));
    throw_if_interrupted();
  }
}

Measured measure_all(PreparedScene& prepared, const std::vector<const Method*>& chosen,
                     const ChartOptions& options) {
  Simulation& simulation = prepared.simulation;
  Measured measured;
  measured.accuracy = prepared.scene.accuracy;
  measured.duration = simulation.duration;
  measured.choice = prepared.choice;
  if (!measured.choice)
    measured.choice = choose_with_progress(simulation, prepared.scene, frame_times(prepared.scene), options.common.quiet);
  throw_if_interrupted();
  measure_ladders(prepared, chosen, options, measured);
  // Where the motion magnifies roundings beyond its own size no method is better than another: judged is what comes before.
  const double known = measured.choice->holds_until ? rounded_down(*measured.choice->holds_until, 3) : 0;
  if (known > 0 && known < simulation.duration && !measured.has_answer(options)) {
    measured.until = simulation.duration = known;
    measure_ladders(prepared, chosen, options, measured);
  }
  return measured;
}

// What the error of a rung is; of which instants, an axis says: "larger of q's and 0.13 s times qd's at 50 instants"
std::string error_text(const Measured& measured, Judged judged) {
  if (judged == Judged::energy) return "of the energy, the largest at the ends of steps and, where it is a tenth of the motion's, within them";
  const std::string larger = "larger of q's and " + format_significant(measured.reference.run.qd_scale, 2) + " s \u00D7 qd's";
  if (judged == Judged::final) return larger;
  return larger + " at " + std::to_string(measured.reference.run.t.size()) + " instants";
}

WorkPrecision data_of(PreparedScene& prepared, Measured& measured, const ChartOptions& options) {
  WorkPrecision data;
  data.title = "Speed against accuracy";
  data.subtitle = title_over_runs(prepared.scene) + ", " + measured.span() + (measured.until ? ", behind which no run follows the motion" : "") +
                  "; reference: " + measured.reference.how;
  const Judged judged = options.judged();
  const bool is_of_energy = options.judges_energy();
  data.error_title = is_of_energy ? "largest energy error [J]"
                                  : with_joint_units(judged == Judged::way ? "largest error" : "final error", prepared.simulation.chain, "rad", "m");
  data.error_meaning = "error: " + error_text(measured, judged);
  if (!is_of_energy) {
    data.floor = measured.reference.amplification * 0x1p-53;
    data.reference_uncertainty = judged == Judged::way ? measured.reference.uncertainty : measured.reference.final_uncertainty;
  }
  data.machine = machine_line();
  const double lost = kLost * measured.farthest();
  data.largest_answer = measured.largest_answer(options);
  for (Ladder& ladder : measured.ladders) {
    if (ladder.rungs.empty()) continue;
    ChoiceRung choice;
    if (ladder.method == measured.choice->best.setting.method) {
      choice = add_choice(prepared.simulation, measured, ladder, options);
      data.choice = {ladder.method->name, choice.at};
    }
    ChartCurve curve;
    curve.method = ladder.method->name;
    curve.title = ladder.method->title;
    curve.order = ladder.method->adaptive ? 0 : ladder.method->order;
    curve.look = int(ladder.method - methods().data());
    for (const Rung& rung : ladder.rungs) {
      const double error = judged_error(rung, judged);
      const bool is_lost = !std::isfinite(rung.final.size) || (!is_of_energy && error > lost);
      const bool is_apart = choice.is_apart && int(curve.points.size()) == choice.at;
      curve.points.push_back({error, rung.seconds, double(rung.evaluations), is_lost, to_string(rung.setting), is_apart});
    }
    data.curves.push_back(curve);
  }
  return data;
}

std::string number_or_empty(double value) {
  return std::isfinite(value) ? format_shortest(value) : "";
}

std::string columns_of(const StateError& error) {
  return number_or_empty(error.size) + "," + number_or_empty(error.q) + "," + number_or_empty(error.qd);
}

std::string csv_of(const std::string& scene, const Measured& measured) {
  std::string text = csv_facts(scene);
  text += "# reference: " + measured.reference.how + ", uncertainty " +
          format_significant(measured.reference.uncertainty, 2) +
          "\n# amplification: " + format_significant(measured.reference.amplification, 3) + (measured.until ? "\n# judged: " + measured.span() : "") +
          "\n# error: the larger of error_q and error_qd x " + format_significant(measured.reference.run.qd_scale, 6) +
          " s, at the end of the run; way_error, of way_q and way_qd: the largest at " + std::to_string(measured.reference.run.t.size()) +
          " instants along the run, of fixed steps at those at which one ends, and at all where q is off by a tenth of the motion; energy_error: the largest at the end of any step, and within steps where it is a tenth of the motion's\n";
  text +=
      "method,order,step [s],tolerance,runs,median_seconds [s],steps,evaluations,error,error_q,error_qd,"
      "way_error,way_q,way_qd,energy_error [J],status\n";
  for (const Ladder& ladder : measured.ladders)
    for (const Rung& rung : ladder.rungs) {
      const MethodSetting& setting = rung.setting;
      const int order = setting.options.order > 0 ? setting.options.order : setting.method->order;
      text += setting.method->name + "," + std::to_string(order) + "," +
              (setting.step > 0 ? format_shortest(setting.step) : "") + "," +
              (setting.options.tolerance > 0 ? format_shortest(setting.options.tolerance) : "") + "," +
              std::to_string(rung.runs) + "," + format_significant(rung.seconds, 4) + "," +
              std::to_string(rung.steps) + "," + std::to_string(rung.evaluations) + "," +
              columns_of(rung.final) + "," + columns_of(rung.way) + "," + number_or_empty(rung.energy_error) + "," +
              to_string(rung.status) + "\n";
    }
  return text;
}

// The run of that method that took the least time of those no farther off than `error`.
const ChartPoint* cheapest(const ChartCurve& curve, double error) {
  const ChartPoint* best = nullptr;
  for (const ChartPoint& point : curve.points)
    if (!point.failed && point.error <= error && (!best || point.seconds < best->seconds)) best = &point;
  return best;
}

std::vector<double> errors_to_reach(const std::string& text) {
  std::vector<double> errors;
  for (const std::string& part : separated(text, ',')) {
    const std::optional<double> error = parse_number(trimmed(part));
    if (!error || !(*error >= 1e-15 && *error <= 1e3))
      throw Error(ExitCode::usage, "--reach " + text + ": takes errors between 1e-15 and 1e3, like 1e-4 or 1e-3,1e-5");
    errors.push_back(*error);
  }
  if (errors.empty()) throw Error(ExitCode::usage, "--reach takes errors, like 1e-4 or 1e-3,1e-5");
  return errors;
}

void print_summary(const WorkPrecision& data, const Measured& measured, const ChartOptions& options) {
  const std::string unit = data.error_title.substr(std::min(data.error_title.find(" ["), data.error_title.size()));
  std::vector<std::vector<std::string>> table{{"ms a run, to reach"}};
  const std::vector<double> reach = errors_to_reach(options.reach);
  for (const std::string& error : separated(options.reach, ',')) table.front().push_back(trimmed(error) + (table.front().size() == 1 ? unit : ""));
  for (const ChartCurve& curve : data.curves) {
    std::vector<std::string> row{curve.method};
    for (const double error : reach) {
      const ChartPoint* const point = cheapest(curve, error);
      row.push_back(error < data.least_error() ? "unknown" : point ? format_significant(1000 * point->seconds, 3) + ", " + setting_of(point->label) : "-");
    }
    table.push_back(row);
  }
  std::fputs(table_text(table).c_str(), stdout);
  if (data.least_error() > *std::ranges::min_element(reach))
    std::printf("unknown: below %s, %s, errors say nothing of a method\n", format_significant(data.least_error(), 2).c_str(),
                data.is_least_of_reference() ? "to which the reference is known" : "to which the motion magnifies one rounding");
  for (const Ladder& ladder : measured.ladders)
    if (!ladder.refusal.empty()) std::printf("left out: %s\n", ladder.refusal.c_str());
  if (measured.until) std::printf("judged: %s; in the whole no run of these follows the motion\n", measured.span().c_str());
  constexpr std::array kWhen = {", the largest along the run", ", at the end of the run", ""};  // of kErrors
  std::printf("error: %s%s; of the pictures of a film, in the unit of `accuracy`: `chainreel check SCENE --all`\n", error_text(measured, options.judged()).c_str(),
              kWhen[std::size_t(options.judged())]);
  std::printf("reference: %s, uncertainty %s; the motion magnifies errors %s times\n",
              measured.reference.how.c_str(), format_significant(options.judged() == Judged::final ? measured.reference.final_uncertainty : measured.reference.uncertainty, 2).c_str(),
              format_significant(measured.reference.amplification, 2).c_str());
  std::printf("%s\n", choice_text(*measured.choice, measured.accuracy).c_str());
}

Json json_of(const std::string& scene, const Measured& measured, const ChartOptions& options) {
  Json json{{"scene", scene},
            {"machine", machine_line()},
            {"reference",
             {{"how", measured.reference.how},
              {"uncertainty", measured.reference.uncertainty},
              {"amplification", measured.reference.amplification}}},
            {"error", "the larger of error_q and error_qd x qd_scale, at the end of the run; way_error, of way_q and way_qd: the largest along it"},
            {"judged", kJudgedKeys[std::size_t(options.judged())]},
            {"duration", measured.duration},
            {"judged_until", measured.until.value_or(measured.duration)},
            {"qd_scale", measured.reference.run.qd_scale},
            {"units", {{"error", "rad or m"}, {"error_q", "rad or m"}, {"error_qd", "rad/s or m/s"}, {"way_error", "rad or m"}, {"way_q", "rad or m"}, {"way_qd", "rad/s or m/s"}, {"energy_error", "J"}, {"duration", "s"}, {"judged_until", "s"}, {"qd_scale", "s"}, {"step", "s"}}},
            {"choice", choice_report(*measured.choice, measured.accuracy, false)},
            {"methods", Json::array()},
            {"left_out", Json::array()}};
  for (const Ladder& ladder : measured.ladders) {
    if (!ladder.refusal.empty()) json["left_out"].push_back(ladder.refusal);
    Json rungs = Json::array();
    for (const Rung& rung : ladder.rungs)
      rungs.push_back({{"setting", to_string(rung.setting)},
                       {"step", rung.setting.step > 0 ? Json(rung.setting.step) : Json(nullptr)},
                       {"tolerance", rung.setting.options.tolerance > 0 ? Json(rung.setting.options.tolerance) : Json(nullptr)},
                       {"runs", rung.runs},
                       {"median_seconds", rung.seconds},
                       {"steps", rung.steps},
                       {"evaluations", rung.evaluations},
                       {"error", rung.final.size},
                       {"error_q", rung.final.q},
                       {"error_qd", rung.final.qd},
                       {"way_error", rung.way.size},
                       {"way_q", rung.way.q},
                       {"way_qd", rung.way.qd},
                       {"energy_error", rung.energy_error},
                       {"status", to_string(rung.status)}});
    if (ladder.refusal.empty()) json["methods"].push_back({{"method", ladder.method->name}, {"rungs", rungs}});
  }
  return json;
}

// Errors at the end say nothing of the way there where all comes to rest: what is damped forgets them.
std::string doubt_of_end(Simulation& simulation) {
  constexpr int kInstants = 200;
  constexpr double kAtRest = 1e-3;  // of the largest rate
  constexpr long kMostEvaluations = 1000000;  // a second or so: of a run that takes more nothing is said
  const MethodSetting own{simulation.method, simulation.options, simulation.step};
  MethodSetting exact{&find_method("dop853"), own.options, 0};
  exact.options.tolerance = 1e-8;
  std::vector<double> times(kInstants + 1);
  for (int k = 0; k <= kInstants; ++k) times[std::size_t(k)] = simulation.duration * k / kInstants;
  apply(exact, simulation);
  simulation.most_evaluations = kMostEvaluations;
  const Trajectory run = simulate(simulation, times, [](double) { return interrupted(); });
  apply(own, simulation);
  simulation.most_evaluations = 0;
  throw_if_interrupted();
  if (!is_complete(run.status)) return "";
  const auto rate_at = [&run](int k) {
    double rate = 0;
    for (const double one : run.qd_at(k)) rate = std::max(rate, std::abs(one));
    return rate;
  };
  double largest = 0;
  for (int k = 0; k < run.size(); ++k) largest = std::max(largest, rate_at(k));
  if (!(largest > 0) || rate_at(run.size() - 1) > kAtRest * largest) return "";
  return "the run ends at rest, where errors of the way there are forgotten: the chart says nothing of that way; take --error way, --error energy, "
         "or a shorter duration";
}

// A run that a limit ends has no error at an end that it does not come to.
void require_whole_run(PreparedScene& prepared) {
  Simulation& simulation = prepared.simulation;
  if (prepared.scene.limit != LimitPolicy::stop) return;
  const MethodSetting own{simulation.method, simulation.options, simulation.step};
  apply({&find_method("dop853"), {1e-9, 0}, 0}, simulation);
  const double end[] = {simulation.duration};
  const Trajectory run = simulate(simulation, end, [](double) { return interrupted(); });
  apply(own, simulation);
  throw_if_interrupted();
  if (run.status != RunStatus::stopped) return;
  throw Error(ExitCode::numerical, "the run stops: " + run.trouble + ", and a chart compares runs until their end: take --set duration=" +
                                       format_significant(run.end_time * 0.99, 2) + ", or --set limit=report", prepared.scene.place_of("limit"));
}

void run_chart(const ChartOptions& options) {
  check_figure_size(options.figure);
  errors_to_reach(options.reach);  // before anything is measured
  const std::vector<const Method*> chosen = parse_methods(options.methods);
  const std::vector<std::string> lit = parse_highlight(options.highlight, chosen);
  PreparedScene prepared = load_motion(options.scene, overrides_of(options.common), options.panel, options.common.quiet);
  require_computed_run(prepared.scene, "chart");
  FigureFiles files(options.figure, "out/" + prepared.scene.name + "_chart.png", options.common.force);
  const std::string doubt = options.judged() == Judged::final ? doubt_of_end(prepared.simulation) : "";
  if (!doubt.empty()) tell_warnings({prepared.scene.name + ": " + doubt});
  require_whole_run(prepared);
  Measured measured = measure_all(prepared, chosen, options);
  apply(measured.choice->best.setting, prepared.simulation);
  warn_of_rank(prepared, prepared.simulation.duration);
  WorkPrecision data = data_of(prepared, measured, options);
  for (const std::string& name : lit)
    if (std::none_of(data.curves.begin(), data.curves.end(), [&](const ChartCurve& c) { return c.method == name; }))
      throw Error(ExitCode::bad_input, "--highlight: " + name + " does not take this scene",
                  prepared.scene.place_of("method"));
  const Fonts fonts(families_of(prepared.scene));
  const ChartLook look = chart_look(options.figure, prepared.scene, fonts);
  const ChartCost panels[] = {ChartCost::seconds, ChartCost::evaluations};
  light_curves(data, panels, lit);
  const auto report = [&] {
    Json json = json_of(options.scene, measured, options);
    json["warnings"] = doubt.empty() ? Json::array() : Json{doubt};
    return json;
  };
  const auto written = files.write([&] { return work_precision_chart(data, panels, look); },
                                   {csv_of(options.scene, measured), report}, fonts);
  tell_files(options.common, written, report, [&] { print_summary(data, measured, options); });
}

}  // namespace

void add_chart_command(CommandLine& app) {
  auto options = std::make_shared<ChartOptions>();
  Command* command =
      app.add_subcommand("chart", "speed against accuracy: a work-precision diagram of a scene");
  command->add_option("scene", options->scene, "a scene file").required().names_input();
  command->add_option("--methods", options->methods, "rk4,taylor,.. (default all that take the scene)");
  command->add_option("--highlight", options->highlight,
                      "taylor,rk4: these in colour, the rest grey (default the cheapest at some error, and auto's)");
  command->add_option("--reach", options->reach, "1e-4,..: errors that the printed table is for (default 1e-3,1e-6,1e-9)");
  command->add_option("--runs", options->runs, "of each rung; the median counts").range(1, 1000);
  command->add_option("--longest", options->longest, "finer rungs whose runs would take longer by the table of costs are left out; one may take twice as long: 100ms")
      .show_default();
  command->add_option("--error", options->error, "what the chart judges: way (the largest of q and qd along the run, the default), final (at its end) or energy (the largest along the run, J)")
      .one_of({kErrors.begin(), kErrors.end()});
  add_panel_option(*command, options->panel);
  add_figure_options(*command, options->figure, options->common, "out/NAME_chart.png");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel chart rr_free -o out/chart.svg");
  command->callback([options] { run_chart(*options); });
}

}  // namespace chainreel
