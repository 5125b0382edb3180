#include "app/automatic.hpp"

#include <cmath>
#include <cstdio>

#include "app/signals.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

std::string microseconds(double ns) {
  return format_significant(ns / 1000, 2) + " us";
}

Json candidate_report(const Choice::Candidate& candidate) {
  Json json{{"setting", to_string(candidate.setting)},
            {"error", std::isfinite(candidate.error) ? Json(candidate.error) : Json(nullptr)},
            {"cost_ns", candidate.cost},
            {"steps", candidate.steps},
            {"evaluations", candidate.evaluations}};
  if (!candidate.trouble.empty()) json["trouble"] = candidate.trouble;
  return json;
}

}  // namespace

void choose_automatically(PreparedScene& prepared) {
  if (prepared.simulation.method) return;
  Simulation& simulation = prepared.simulation;
  const auto stop = [](double) { return interrupted(); };
  const auto events = simulation.events;
  const double duration = simulation.duration;
  std::vector<double> times = frame_times(prepared.scene);
  if (events) {
    // What comes behind the event that ends the run is nobody's concern.
    apply({&find_method("dop853"), {1e-10, 0}, 0}, simulation);
    const double end = simulate(simulation, {}, stop).end_time;
    if (end > 0) simulation.duration = end;
    while (times.size() > 1 && times.back() > simulation.duration) times.pop_back();
    simulation.events = nullptr;
  }
  prepared.choice = choose_method(simulation, prepared.scene.accuracy, times, stop);
  simulation.events = events;
  simulation.duration = duration;
  throw_if_interrupted();
}

std::string choice_text(const Choice& choice, const Accuracy& accuracy) {
  const std::string unit = " " + accuracy.unit;
  std::string text = "auto: " + to_string(choice.best.setting);
  if (choice.is_met)
    text += " is off by " + format_significant(choice.best.error, 2) + unit + " and costs some " +
            microseconds(choice.best.cost) + "; " + std::to_string(choice.tried.size()) + " candidates";
  else
    text += " is the most exact that was found, off by " + format_significant(choice.best.error, 2) + unit +
            " where " + to_string(accuracy) + " was asked for";
  if (choice.holds_until)
    text += "; that holds until t = " + format_significant(*choice.holds_until, 3) +
            " s: this motion magnifies rounding so much that nothing in double precision stays within " +
            to_string(accuracy) + " for longer";
  return text;
}

void say_notices(const PreparedScene& prepared, bool quiet) {
  if (quiet) return;
  for (const std::string& notice : prepared.scene.notices)
    std::fprintf(stderr, "%s: %s\n", prepared.scene.name.c_str(), notice.c_str());
}

void say_choice(const PreparedScene& prepared, bool quiet) {
  say_notices(prepared, quiet);
  if (quiet || !prepared.choice) return;
  std::fprintf(stderr, "%s: %s\n", prepared.scene.name.c_str(),
               choice_text(*prepared.choice, prepared.scene.accuracy).c_str());
}

Json choice_report(const Choice& choice, const Accuracy& accuracy, bool tried) {
  Json json = candidate_report(choice.best);
  json["accuracy"] = to_string(accuracy);
  json["is_met"] = choice.is_met;
  json["holds_until"] = choice.holds_until ? Json(*choice.holds_until) : Json(nullptr);
  json["reference_uncertainty"] = choice.reference_uncertainty;
  if (tried)
    for (const Choice::Candidate& one : choice.tried) json["tried"].push_back(candidate_report(one));
  return json;
}

}  // namespace chainreel
