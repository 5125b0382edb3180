#include "app/film/automatic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/cli/streams.hpp"
#include "app/film/progress.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "scene/run/prepare.hpp"

namespace chainreel {
namespace {

constexpr double kWorthSaying = 100;  // times what was asked for: beyond that nobody wants it
constexpr double kMostInstants = 20'000;  // by which a method is judged
constexpr long kMostEvaluationsForEvents = 10'000'000;

std::string microseconds(double ns) {
  return ns < 1e9 ? format_significant(ns / 1000, 2) + " us" : format_significant(ns / 1e9, 2) + " s";
}

// Two digits, rounded up: a bound stays one.
std::string bound_text(double x) {
  if (!(x > 0)) return "0";
  return format_significant(x + 0.49 * std::pow(10, std::floor(std::log10(x)) - 1), 2);
}

// What is plotted and tabled over time: ", tau2 by 0.08 % of its range".
std::string curve_text(const Choice::Candidate& best) {
  if (!best.curve_error || best.curve.empty()) return "";
  return ", " + best.curve + " by " + bound_text(100 * *best.curve_error) + " % of its range,";
}

std::string curves_asked_for(const Choice& choice) {
  if (!choice.best.curve_error || *choice.best.curve_error <= choice.curve_allowed) return "";
  return ", and so " + format_significant(100 * choice.curve_allowed, 2) + " % of curves' ranges";
}

std::string price_text(const Choice& choice) {
  std::string price = microseconds(choice.best.cost);
  if (choice.counted_until) price += " until t = " + format_significant(*choice.counted_until, 4) + " s";
  if (choice.cost_to_end) price += ", at that rate " + microseconds(*choice.cost_to_end) + " to the end";
  return price;
}

Json candidate_report(const Choice::Candidate& candidate) {
  Json json{{"setting", to_string(candidate.setting)},
            {"error", std::isfinite(candidate.error) ? Json(candidate.error) : Json(nullptr)},
            {"curve_error", candidate.curve_error && std::isfinite(*candidate.curve_error) ? Json(*candidate.curve_error) : Json(nullptr)},
            {"curve", candidate.curve},
            {"cost_ns", candidate.cost},
            {"steps", candidate.steps},
            {"evaluations", candidate.evaluations}};
  json["trouble"] = or_null(candidate.trouble);
  return json;
}

std::string progress_text(const ChoiceProgress& now, double duration) {
  return "choosing a method: " + now.doing + " at t = " + format_significant(now.t, 3) + " of " +
         format_shortest(duration) + " s, behind " + std::to_string(now.runs) + " runs; of its budget";
}

// Where the run ends by an event, s.
std::optional<double> end_by_event(Simulation& simulation, std::span<const double> times) {
  apply({&find_method("dop853"), {1e-10, 0}, 0}, simulation);
  simulation.longest_step = times.size() > 1 ? times[1] - times[0] : 0;
  simulation.most_evaluations = kMostEvaluationsForEvents;
  const Trajectory run = simulate(simulation, {}, [](double) { return interrupted(); });
  simulation.longest_step = 0;
  simulation.most_evaluations = 0;
  throw_if_interrupted();
  return run.ending_event >= 0 ? std::optional(run.end_time) : std::nullopt;
}

}  // namespace

void choose_automatically(PreparedScene& prepared, bool quiet, double between) {
  if (prepared.simulation.method) return;
  Simulation& simulation = prepared.simulation;
  const auto events = simulation.events;
  const double duration = simulation.duration;
  std::vector<double> times = between > 0 ? instants_every(between, prepared.scene.duration, kMostInstants) : frame_times(prepared.scene);
  if (events) {
    // What comes behind the event that ends the run is nobody's concern.
    const auto end = end_by_event(simulation, times);
    if (end && *end > 0) simulation.duration = *end, simulation.whole_duration = duration;
    while (times.size() > 1 && times.back() > simulation.duration) times.pop_back();
    simulation.events = nullptr;
  }
  try {
    prepared.choice = choose_with_progress(simulation, prepared.scene, times, quiet);
  } catch (const Error& error) {
    throw Error(error.code(), error.problems().front().message, prepared.scene.place_of("accuracy"));
  }
  simulation.events = events;
  simulation.duration = duration;
  simulation.whole_duration = 0;
}

Choice choose_with_progress(Simulation& simulation, const Scene& scene, std::span<const double> times, bool quiet) {
  // Bars have no extent but their own.
  simulation.outline =
      scene.links == LinkShapes::plain ? Outline{} : read_outline(scene.model, simulation.chain, model_options_of(scene));
  Ticker ticker(quiet);
  const auto watch = [&](const ChoiceProgress& now) {
    if (ticker.is_due()) ticker.say(scene.name + ": " + progress_text(now, simulation.duration), std::clamp(now.spent, 0.0, 1.0));
    return interrupted();
  };
  Choice choice = choose_method(simulation, scene.accuracy, times, watch);
  throw_if_interrupted();
  return choice;
}

std::string choice_text(const Choice& choice, const Accuracy& accuracy) {
  const std::string unit = " " + to_string(accuracy.unit);
  const Choice::Candidate& best = choice.best;
  std::string text = "auto: " + to_string(best.setting);
  if (choice.is_met)
    text += " is off by at most " + bound_text(best.error) + unit + curve_text(best) + " and costs some " +
            price_text(choice) + "; " + std::to_string(choice.tried.size()) + " candidates";
  else if (std::isfinite(best.error))
    text += " is the most exact that was found, off by up to " + bound_text(best.error) + unit + curve_text(best) +
            " where " + to_string(accuracy) + " was asked for" + curves_asked_for(choice);
  else
    text += " is taken, though nothing is known of its error";
  if (choice.out_of_budget)
    text += "; the search ended before all was tried, at its budget of " + microseconds(choice.budget) +
            " of counted work: this is the best so far";
  for (const std::string& remark : choice.remarks) text += "; " + remark;
  if (!choice.holds_until) return text;
  text += "; that holds until t = " + format_significant(*choice.holds_until, 4) + " s: " + choice.why_until;
  if (choice.attainable && *choice.attainable > accuracy.value && *choice.attainable < kWorthSaying * accuracy.value)
    text += "; to the end something can be promised from " + format_significant(*choice.attainable, 2) + unit + " on";
  return text;
}

std::optional<Doubt> doubt_of_choice(const Choice& choice, const Accuracy& accuracy, double end) {
  if (!choice.is_met)
    return Doubt{"accuracy", choice.best.error, "method: auto found none that keeps " + to_string(accuracy) + " here, as `chainreel check` tells in full",
                 std::isfinite(choice.best.error) ? "--set accuracy='" + format_significant(2 * choice.best.error, 1) + " " + to_string(accuracy.unit) + "', or a method by name"
                                                  : "a method by name"};
  if (!choice.holds_until || *choice.holds_until >= end) return {};
  const double until = *choice.holds_until;
  return Doubt{"accuracy", until / end,
               "method: auto promises " + to_string(accuracy) + " until t = " + format_significant(until, 4) + " s alone, as `chainreel check` tells in full",
               until > 0 ? "--set duration=" + format_significant(rounded_down(until, 3), 3) : "a method by name"};
}

namespace {

std::vector<std::string> lines_of(std::span<const PreparedScene> panels, std::vector<std::string> Scene::*words) {
  std::vector<std::string> lines;
  for (const PreparedScene& panel : panels)
    for (const std::string& one : panel.scene.*words)
      if (const std::string line = panel.scene.name + ": " + one; std::find(lines.begin(), lines.end(), line) == lines.end())
        lines.push_back(line);
  return lines;
}

}  // namespace

std::vector<std::string> doubt_lines(std::span<const PreparedScene> panels) {
  return lines_of(panels, &Scene::doubts);
}

std::vector<std::string> notice_lines(std::span<const PreparedScene> panels) {
  return lines_of(panels, &Scene::notices);
}

void say_notices(std::span<const PreparedScene> panels, bool quiet) {
  for (const std::string& line : doubt_lines(panels)) tell_warning(line);
  if (quiet) return;
  for (const std::string& line : notice_lines(panels)) std::fprintf(stderr, "%s\n", line.c_str());
}

void say_choice(std::span<const PreparedScene> panels, bool quiet) {
  say_notices(panels, quiet);
  for (const PreparedScene& panel : panels)
    if (!quiet && panel.choice)
      std::fprintf(stderr, "%s: %s\n", panel.scene.name.c_str(), choice_text(*panel.choice, panel.scene.accuracy).c_str());
}

Json choice_report(const Choice& choice, const Accuracy& accuracy, bool tried) {
  Json json = candidate_report(choice.best);
  json["accuracy"] = to_string(accuracy);
  json["error_unit"] = to_string(accuracy.unit);
  json["is_met"] = choice.is_met && !choice.holds_until;  // to the end
  json["holds_until"] = or_null(choice.holds_until);
  json["why_until"] = or_null(choice.why_until);
  json["counted_until"] = or_null(choice.counted_until);
  json["cost_to_end_ns"] = or_null(choice.cost_to_end);
  json["remarks"] = choice.remarks;
  json["reference"] = choice.reference;
  json["reference_uncertainty"] = choice.reference_uncertainty;
  json["attainable"] = or_null(choice.attainable);
  json["out_of_budget"] = choice.out_of_budget;
  json["spent"] = choice.spent / choice.budget;
  json["tried"] = Json::array();
  if (tried)
    for (const Choice::Candidate& one : choice.tried) json["tried"].push_back(candidate_report(one));
  return json;
}

}  // namespace chainreel
