// chainreel fall SCENE [--sweep KEY=..]: when a scene's model falls, against one of its keys.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/commands/figure.hpp"
#include "app/film/formats.hpp"
#include "app/film/progress.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "app/sweep/map_axes.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/machine.hpp"
#include "draw/charts/response_chart.hpp"
#include "draw/page/house_style.hpp"
#include "scene/run/fall.hpp"
#include "scene/text/read_scene.hpp"
#include "table/data_table.hpp"

namespace chainreel {
namespace {

struct FallOptions {
  std::string scene;
  std::string sweep;
  bool edges = false;
  int threads = 0;
  FigureOptions figure;
  CommonOptions common;

  bool draws() const {
    return std::ranges::any_of(figure.outputs, [](const std::string& path) { return find_output_format(path, Shows::still) != nullptr; });
  }
};

bool has_failed(const FallRow& row) {
  return !is_complete(row.status);
}

// To this share of the distance of rows.
constexpr double kEdgesTo = 1e-4;
// How far from an edge a longer run is looked at, where near to it any run takes longer to end: of the distance of rows, and of that to the row.
constexpr double kWellBefore = 0.02, kOfWayToRow = 0.1;

std::string to_words(const FallTable& table, const FallEdge& edge) {
  const double place = (edge.before + edge.behind) / 2, half = std::abs(edge.behind - edge.before) / 2;
  const std::string unit = table.unit_of_edges.empty() ? "" : " " + table.unit_of_edges;
  // As many digits as it is known to.
  const int digits = half > 0 ? std::clamp(int(std::ceil(std::log10(std::max(std::abs(place), half) / half))) + 1, 2, 17) : 17;
  // Rounded up, and one more for the place's own last digit.
  const double last = half > 0 ? std::pow(10, std::floor(std::log10(half))) : 0, within = half > 0 ? std::ceil(half / last + 0.1) * last : 0;
  return table.sweep.key + " = " + format_significant(place, digits) + unit + " (within " + format_significant(within, 1) + "): from '" + edge.from + "' to '" + edge.to +
         "' in runs of " + format_quantity(table.duration, "s") + ", between the rows " + format_significant(edge.row_before, 6) + " and " +
         format_significant(edge.row_behind, 6);
}

std::string verdict(const FallTable& table, const FallRow& row) {
  const std::string within = format_quantity(table.duration, "s");
  switch (what_became_of(table, row)) {
    case FallEnd::falls: return format_fixed(*row.fall_time, 4) + (row.lies_before ? " " + falls_to(row) : "");
    case FallEnd::stopped: return "stopped: " + row.trouble;
    case FallEnd::fails: break;
    case FallEnd::lies: return "lies from the start";
    case FallEnd::stays_up: return "does not fall within " + within;
    case FallEnd::takes_off: return "takes off at " + format_fixed(*row.takes_off, 4) + ", not down within " + within;
    case FallEnd::tips: return "tips over the " + tips_over(row) + " at " + format_fixed(*row.tips, 4) + ", not down within " + within;
    case FallEnd::stands: return "stands for " + within;
  }
  return row.trouble;
}

// What speaks against single edges, once for each two rows.
std::vector<std::string> doubts_of_edges(const FallTable& table) {
  std::vector<std::string> doubts;
  std::optional<double> told;
  for (const FallEdge& edge : table.edges) {
    if (!edge.contradicted_at || told == edge.row_before) continue;
    told = edge.row_before;
    doubts.push_back(table.sweep.key + ": the end changes more often between " + format_significant(edge.row_before, 6) + " and " +
                     format_significant(edge.row_behind, 6) + " than --edges tells, as at " + format_significant(*edge.contradicted_at, 6) +
                     ": take more rows, or a shorter duration");
  }
  return doubts;
}

// Edges that are those of the duration: what ends in one way well before one ends otherwise where the run is twice as long.
std::vector<std::string> doubts_of_duration(const FallOptions& options, const FallTable& table) {
  std::vector<std::string> doubts;
  std::vector<std::string> overrides = overrides_of(options.common);
  overrides.push_back("duration=" + format_shortest(2 * table.duration));
  if (table.sweep.key == "duration") return {};
  for (const FallEdge& edge : table.edges) {
    const double away = kWellBefore * (edge.row_behind - edge.row_before);
    const double to_before = kOfWayToRow * (edge.before - edge.row_before), to_behind = kOfWayToRow * (edge.row_behind - edge.behind);
    const double same = std::copysign(std::min(std::abs(to_before), std::abs(to_behind)), away);
    for (const auto& [value, end] : {std::pair{edge.before - away, edge.from}, {edge.behind + away, edge.to}, {edge.before - same, edge.from}, {edge.behind + same, edge.to}}) {
      throw_if_interrupted();
      const bool is_between = (value - edge.row_before) * (value - edge.row_behind) <= 0 && std::ranges::none_of(table.edges, [&, at = value](const FallEdge& other) {
        return &other != &edge && (other.before - at) * (other.before - edge.before) < 0;
      });
      if (!is_between) continue;
      Sweep one;
      one.key = table.sweep.key;
      one.values = {format_shortest(value) + table.unit_of_edges};
      try {
        const FallTable longer = run_fall_table(options.scene, overrides, one, {1, 0}, [](double) { return interrupted(); });
        const std::string then = end_of(longer, longer.rows.front());
        if (then == end) continue;
        doubts.push_back("the edge between '" + edge.from + "' and '" + edge.to + "' is that of the duration: at " + table.sweep.key + " = " + format_significant(value, 4) +
                         " a run of " + format_quantity(longer.duration, "s") + " ends with '" + then + "', one of " + format_quantity(table.duration, "s") + " with '" + end + "'");
        break;
      } catch (const Error& error) {
        throw_if_interrupted();
        doubts.push_back("whether the edge between '" + edge.from + "' and '" + edge.to + "' is that of the duration cannot be told, as no run can be longer: " +
                         error.problems().front().message);
        break;
      }
    }
  }
  return doubts;
}

// The first time of each event, but of falls: they are what the table is about.
std::vector<std::size_t> other_events(const FallTable& table) {
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < table.events.size(); ++i)
    if (table.events[i].kind != EventKind::fall) others.push_back(i);
  return others;
}

// What the command line changed of the scene, which the table does not show.
std::string set_words(const FallOptions& options) {
  return joined(overrides_of(options.common));
}

void print_table(const FallTable& table, const std::string& set, bool searched) {
  const std::vector<std::size_t> others = other_events(table);
  std::vector<std::vector<std::string>> rows{{table.sweep.key}};
  for (const std::size_t i : others) rows[0].push_back(table.events[i].title() + ", s");
  rows[0].push_back("falls at, s");
  if (table.sweep.key.empty()) rows[0].erase(rows[0].begin());
  for (const FallRow& row : table.rows) {
    rows.emplace_back();
    if (!table.sweep.key.empty()) {
      const auto number = parse_number(row.value);
      rows.back().push_back(number ? format_significant(*number, 6) : row.value);
    }
    for (const std::size_t i : others)
      rows.back().push_back(!row.first[i] ? "never" : *row.first[i] == 0 ? "from the start" : format_fixed(*row.first[i], 4));
    rows.back().push_back(verdict(table, row));
  }
  std::fputs(table_text(rows).c_str(), stdout);
  for (const EventEntry& event : table.events)
    if (!event.when.empty()) std::printf("%s: when %s\n", event.title().c_str(), event.when.c_str());
  for (const FallEdge& edge : table.edges) std::printf("%s\n", to_words(table, edge).c_str());
  const auto falls_behind_tipping = [](const FallRow& row) { return row.tips && row.fall_time && *row.tips < *row.fall_time; };
  if (std::ranges::any_of(table.rows, falls_behind_tipping))
    std::printf("where the foot tips before the fall, the time of the fall is that of a foot that is held: a real one turns from there on\n");
  if (table.bears && std::any_of(table.rows.begin(), table.rows.end(), [&](const FallRow& row) { return what_became_of(table, row) == FallEnd::tips; }))
    std::printf("behind that this foot stays where a real one turns. At rest it bears %s N m of the ankle over the heel and %s N m over the toe: where the "
                "ankle's torque goes beyond, cut it there by max(.., min(.., ..)) to see the fall; a foot whose body moves may tip before\n",
                format_significant(table.bears->first, 4).c_str(), format_significant(table.bears->second, 4).c_str());
  if (searched && table.edges.empty()) std::printf("no edges: all rows end alike\n");
  if (!set.empty()) std::printf("with %s\n", set.c_str());
  // Of a setting that the table's rows have, each its own, nothing is said.
  const bool is_swept = table.sweep.key == "step" || table.sweep.key == "tolerance" || table.sweep.key == "order" || table.sweep.key == "method";
  std::printf("%s; %d threads\n", table.method.substr(0, is_swept ? table.method.find(',') : std::string::npos).c_str(), table.threads);
}

Json report_of(const FallOptions& options, const FallTable& table) {
  Json json{{"scene", options.scene}, {"duration", table.duration}, {"method", table.method}};
  json["set"] = overrides_of(options.common);
  json["key"] = or_null(table.sweep.key);
  json["events"] = Json::array();
  for (const EventEntry& event : table.events)
    json["events"].push_back(
        {{"name", event.title()}, {"kind", to_string(event.kind)}, {"when", event.when}});
  json["rows"] = Json::array();
  for (const FallRow& row : table.rows) {
    Json one{{"status", to_string(row.status)}, {"end_time", row.end_time}, {"value", nullptr}};
    if (!table.sweep.key.empty()) {
      const auto number = parse_number(row.value);
      one["value"] = number ? Json(*number) : Json(row.value);
    }
    one["fall_time"] = or_null(row.fall_time);
    one["ended_by"] =
        row.ending_event < 0 ? Json(nullptr) : Json(table.events[std::size_t(row.ending_event)].title());
    one["first"] = Json::array();
    for (const std::optional<double>& time : row.first) one["first"].push_back(or_null(time));
    one["stands"] = table.has_foot ? Json(stands(row)) : Json(nullptr);
    one["tips_at"] = or_null(row.tips);
    one["tips_over"] = row.tips ? Json(tips_over(row)) : Json(nullptr);
    one["falls"] = row.lies_before ? Json(falls_to(row)) : Json(nullptr);
    one["takes_off_at"] = or_null(row.takes_off);
    one["foot_bears"] = row.bears ? Json{{"over_heel", row.bears->first}, {"over_toe", row.bears->second}} : Json(nullptr);
    one["trouble"] = or_null(row.trouble);
    json["rows"].push_back(one);
  }
  json["edges"] = Json::array();
  for (const FallEdge& edge : table.edges)
    json["edges"].push_back({{"before", edge.before},
                             {"behind", edge.behind},
                             {"from", edge.from},
                             {"to", edge.to},
                             {"rows", {edge.row_before, edge.row_behind}},
                             {"contradicted_at", or_null(edge.contradicted_at)}});
  return json;
}

// Numbers with all their digits; an empty field is what did not happen.
std::string csv_of(const FallOptions& options, const FallTable& table) {
  const auto field = [](const std::optional<double>& value) { return value ? format_shortest(*value) : ""; };
  const bool swept = !table.sweep.key.empty();
  std::string text = csv_facts(options.scene) + (set_words(options).empty() ? "" : "# set: " + set_words(options) + "\n");
  for (const FallEdge& edge : table.edges) text += "# edge: " + to_words(table, edge) + "\n";
  text += (swept ? table.sweep.key + "," : "") + "fall_time [s],status,end_time [s]";
  for (const EventEntry& event : table.events) text += "," + csv_words(event.title() + " [s]");
  if (table.has_foot) text += ",stands,tips_at [s],tips_over,falls,takes_off_at [s]";
  text += "\n";
  for (const FallRow& row : table.rows) {
    if (swept) text += row.value + ",";
    text += field(row.fall_time) + "," + to_string(row.status) + "," + format_shortest(row.end_time);
    for (const std::optional<double>& time : row.first) text += "," + field(time);
    if (table.has_foot) text += std::string(stands(row) ? ",true," : ",false,") + field(row.tips) + "," + tips_over(row) + "," + falls_to(row) + "," + field(row.takes_off);
    text += "\n";
  }
  return text;
}

constexpr std::size_t kDownCurve = 0, kTipsCurve = 1;  // of the chart
constexpr std::size_t kNoCurveOfChart = 2;              // a colour that neither has

// What a run is that has no instant of a fall, in the order of the ends.
std::vector<ResponseLack> lacks_of(const FallTable& table) {
  const std::string within = format_quantity(table.duration, "s"), not_down = "not down within " + within;
  std::vector<ResponseLack> lacks(std::size_t(FallEnd::stands) + 1, {""});
  const auto is = [&](FallEnd end) -> ResponseLack& { return lacks[std::size_t(end)]; };
  is(FallEnd::falls) = {"no instant"};
  is(FallEnd::stopped) = {"stopped", Marker::open_square};
  is(FallEnd::fails) = {"failed", Marker::plus};
  is(FallEnd::lies) = {"lies from the start", Marker::open_diamond, kDownCurve};
  is(FallEnd::stays_up) = {not_down};
  is(FallEnd::takes_off) = {"takes off, " + not_down, Marker::open_triangle_down, kTipsCurve};
  is(FallEnd::tips) = {"tips, " + not_down, Marker::open_triangle, kTipsCurve};
  is(FallEnd::stands) = {"stands for " + within, Marker::diamond, kNoCurveOfChart};
  return lacks;
}

// When runs fall and feet tip, against the key; where how they end changes.
ResponseChart chart_of(const FallTable& table, const Scene& scene) {
  ResponseChart chart;
  chart.title = "When does it fall?";
  chart.subtitle = scene.name + ", " + std::to_string(table.rows.size()) + " runs of " + format_quantity(table.duration, "s") + ", " + table.method;
  const Sweep sweep = with_unit_of_parameter(scene, table.sweep);
  chart.x = curve_axis_of(sweep);
  ResponsePanel instants{"instant [s]", true, {}};
  const double degrees = degrees_of(sweep);
  ResponseCurve falls{"down", {}}, tips{"foot tips", {}};
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const FallRow& row = table.rows[i];
    const double x = table.sweep.numbers[i] * degrees;
    falls.points.push_back({x, row.fall_time, false, std::size_t(what_became_of(table, row))});
    tips.points.push_back({x, row.tips});
  }
  const auto any = [](const ResponseCurve& curve) { return std::ranges::any_of(curve.points, [](const ResponsePoint& one) { return one.y.has_value(); }); };
  instants.curves.push_back(falls);
  if (any(tips)) instants.curves.push_back(tips);
  chart.panels.push_back(instants);
  chart.lacks = lacks_of(table);
  if (any(tips)) chart.footer = "After tipping the foot is held where a real one turns.";
  for (const FallEdge& edge : table.edges) {
    const double x = (edge.before + edge.behind) / 2 * degrees;
    chart.edges.push_back({x, format_significant(x, 4)});
    chart.footer += std::string(chart.footer.empty() ? "" : " ") + "At " + format_significant(x, 4) + " from '" + edge.from + "' to '" + edge.to + "'.";
    chart.needed += (chart.needed.empty() ? "Until " : "until ") + format_significant(x, 4) + ": " + edge.from + "; ";
  }
  if (!table.edges.empty()) chart.needed += "beyond: " + table.edges.back().to;
  return chart;
}

void run_fall(const FallOptions& options) {
  Sweep sweep;
  sweep.values = {""};
  if (!options.sweep.empty()) sweep = parse_sweep(options.sweep, "--sweep");
  if (options.edges && !can_have_edges(sweep))
    throw Error(ExitCode::usage, "--edges looks between the numbers of --sweep: give two at least, like --sweep torque.1=0:60:7");
  const bool writes = !options.figure.outputs.empty();
  check_figure_size(options.figure);
  for (const std::string& output : options.figure.outputs) refuse_dash(output);
  if (options.draws() && sweep.key.empty()) throw Error(ExitCode::usage, "a picture shows falls against a key: give --sweep, like --sweep torque.1=0:60:7");
  if (options.draws()) require_curve_axis(sweep, "--sweep " + sweep.key);
  std::optional<FigureFiles> files;
  if (writes) files.emplace(options.figure, "", options.common.force);  // throws where one may not be written, before anything is computed
  const int cores = usable_cores();
  const int threads = std::min(options.threads > 0 ? options.threads : cores, int(sweep.values.size()));
  FallTable table;
  {
    WorkTicker ticker(std::filesystem::path(options.scene).stem().string() + ": simulating", options.common.quiet);
    table = run_fall_table(options.scene, overrides_of(options.common), sweep, {threads, options.edges ? kEdgesTo : 0}, [&](double part) {
      ticker.tell(part);
      return interrupted();
    });
  }
  throw_if_interrupted();
  tell_warnings(table.doubts);
  tell_warnings(doubts_of_edges(table));
  tell_warnings(doubts_of_duration(options, table));
  Json report = report_of(options, table);
  const FigureNumbers numbers{csv_of(options, table), [&] { return report; }};
  std::vector<std::string> written;
  if (files) {
    const Scene scene = read_scene(options.scene, overrides_of(options.common));
    const Fonts fonts(families_of(scene));
    written = files->write([&] { return response_chart(chart_of(table, scene), chart_look(options.figure, scene, fonts)); }, numbers, fonts);
  }
  report.update(files_json(written));
  if (options.common.json)
    print_json(report);
  else if (!options.common.quiet || !writes)
    print_table(table, set_words(options), options.edges);
  for (const std::string& output : written)
    if (!options.common.quiet && !options.common.json) std::printf("%s\n", output.c_str());
  const auto failed = std::find_if(table.rows.begin(), table.rows.end(), has_failed);
  if (failed == table.rows.end()) return;
  const std::string setting = sweep.key.empty() ? "" : " at " + sweep.key + "=" + failed->value;
  throw Error(ExitCode::numerical, "a run failed" + setting + ": " + failed->trouble, {options.scene});
}

}  // namespace

void add_fall_command(CommandLine& app) {
  auto options = std::make_shared<FallOptions>();
  Command* command = app.add_subcommand("fall", "when a scene's model falls, against one of its keys");
  command->add_option("scene", options->scene, "a scene file with an event of kind fall").required().names_input();
  command->add_option("--sweep", options->sweep,
                      "KEY=a,b,c or KEY=from:to:count, maybe with :log behind it, like torque.1=0:60:7");
  command->add_flag("--edges", options->edges, "between rows that end otherwise, the value at which that changes, by bisection");
  command->add_option("--jobs", options->threads, "threads (default: all cores)").range(1, 256);
  add_figure_options(*command, options->figure, options->common, "none");
  add_scene_options(*command, options->common);
  add_result_options(*command, options->common);
  command->footer("Example: chainreel fall humanoid_fall --sweep parameters.k=0:1200:7 --edges\n"
                  "         chainreel fall humanoid_fall --sweep parameters.k=0:1200:25 --edges -o out/fall.png");
  command->callback([options] { run_fall(*options); });
}

}  // namespace chainreel
