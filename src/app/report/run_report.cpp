#include "app/report/run_report.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include "app/cli/streams.hpp"
#include "app/film/automatic.hpp"
#include "app/film/house_logo.hpp"
#include "app/report/report.hpp"
#include "app/report/sidecar.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "draw/film/compose.hpp"
#include "draw/layers/speed_box.hpp"
#include "model/model_description.hpp"
#include "picture/formula_words.hpp"
#include "render/canvas.hpp"
#include "scene/keys/keys.hpp"
#include "scene/run/fall.hpp"
#include "scene/run/prepare.hpp"
#include "scene/run/title.hpp"
#include "sim/drive/recorded_motion.hpp"
#include "sim/rank_loss.hpp"
#include "sim/torques_along.hpp"

namespace chainreel {

namespace {

// A run that is to diverge is no motion that anyone takes for true.
std::vector<Doubt> warnings_of(const PreparedScene& prepared, const Trajectory& trajectory, const Audit& audit) {
  if (prepared.scene.expect == Outcome::diverge) return {};
  const auto chosen_by = prepared.choice ? std::optional(prepared.scene.accuracy) : std::nullopt;
  std::vector<Doubt> doubts = doubts_of(prepared.simulation, trajectory, audit, chosen_by);
  if (chosen_by && trajectory.size() > 0)
    if (const auto doubt = doubt_of_choice(*prepared.choice, *chosen_by, trajectory.t.back())) doubts.push_back(*doubt);
  return doubts;
}

// A remedy of one panel changes that panel: keys of the page stay as they are.
std::string in_panel(const std::string& remedy, int panel) {
  const std::string set = "--set ", prefix = "compare." + std::to_string(panel) + ".";
  std::string text = remedy;
  for (std::size_t at = text.find(set); at != std::string::npos; at = text.find(set, at + 1)) {
    const std::size_t key = at + set.size() + (text[at + set.size()] == '\'' ? 1 : 0);
    const std::vector<std::string>& shared = page_keys();
    if (std::find(shared.begin(), shared.end(), text.substr(key, text.find_first_of(".=", key) - key)) == shared.end()) text.insert(key, prefix);
  }
  return text;
}

// What happened when, and whether it fell.
void add_events(Json& json, const Scene& scene, const Trajectory& trajectory) {
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
  json["held_from_start"] = Json::array();
  for (const int event : hits.from_start) json["held_from_start"].push_back(scene.events[std::size_t(event)].title());
  json["fall_time"] = or_null(fall_time_of(scene, trajectory));
  json["end_time"] = trajectory.end_time;
}

// Of a recorded motion. The hash makes films of another table others, also where q and qd are the same.
Json motion_report(const RecordedMotion& motion) {
  Json json{{"sha256", motion.sha256()},
            {"rows", motion.rows()},
            {"end", motion.end()},
            {"rates", motion.has_rates() ? "recorded" : "derivatives of a spline"},
            {"accelerations", motion.has_accelerations() ? "recorded" : "derivatives of a spline"},
            {"torques", "inverse dynamics"}};
  json["recorded_torques"] = nullptr;
  if (const auto& own = motion.own_torques())
    json["recorded_torques"] = {{"largest_difference", own->largest}, {"t", own->t}, {"freedom", own->freedom}};
  return json;
}

}  // namespace

Json mechanism_record(const PreparedScene& prepared) {
  ModelOptions options = model_options_of(prepared.scene);
  options.meshes = false;
  const bool shows_collisions = prepared.scene.links == LinkShapes::collision;
  ModelDescription model = describe_model(prepared.scene.model, options, shows_collisions ? DescribeCollisions::all : DescribeCollisions::where_seen);
  if (!prepared.shapes)
    for (DescribedLink& link : model.links) link.visuals.clear(), link.collisions.clear();
  return to_json(model);
}

RunReport run_report(const PreparedScene& prepared, const Trajectory& trajectory) {
  RunReport report{prepared, trajectory, audit_of(prepared.simulation, trajectory), {}, {}};
  report.audit.error = {};  // at each sample, which no report tells
  report.warnings = warnings_of(prepared, trajectory, report.audit);
  if (const int panel = prepared.scene.panel; panel > 0)
    for (Doubt& doubt : report.warnings) doubt.remedy = in_panel(doubt.remedy, panel);
  return report;
}

const Json& RunReport::constraints() const {
  if (!constraint_facts) constraint_facts = constraint_run_report(prepared.simulation, trajectory);
  return *constraint_facts;
}

std::string title_of(const RunReport& run) {
  return title_of(run.prepared.scene, &run.prepared.simulation, run.trajectory);
}

Json to_json(const RunReport& report) {
  const PreparedScene& prepared = report.prepared;
  const Trajectory& trajectory = report.trajectory;
  const Audit& audit = report.audit;
  const Scene& scene = prepared.scene;
  Json json = Json::object();  // JSON's null that becomes an object is lost where memory is short
  json["scene"] = scene.file;
  json["title"] = title_of(report);
  json["model"] = scene.model.words();
  json["model_sha256"] = scene.model.sha256();
  json["model_elements_sha256"] = scene.model.elements_sha256();
  json["status"] = to_string(trajectory.status);
  json["expect"] = to_string(scene.expect);
  json["trouble"] = or_null(trajectory.trouble);
  const Simulation& simulation = prepared.simulation;
  json["method"] = simulation.method->name;
  json["step"] = simulation.step > 0 ? Json(simulation.step) : Json(nullptr);
  json["tolerance"] = simulation.options.tolerance > 0 ? Json(simulation.options.tolerance) : Json(nullptr);
  json["order"] = simulation.options.order > 0 ? simulation.options.order : simulation.method->order;
  json["auto"] = prepared.choice ? choice_report(*prepared.choice, scene.accuracy, false) : Json(nullptr);
  json["motion"] = simulation.motion ? motion_report(*simulation.motion) : Json(nullptr);
  json["torque_function"] = scene.control && scene.control->function ? Json(scene.control->function->words) : Json(nullptr);
  json["steps"] = trajectory.steps;
  json["evaluations"] = trajectory.evaluations;
  json["duration"] = scene.duration;
  json["energy_start"] = audit.energy_start;
  json["largest_kinetic_energy"] = audit.largest_kinetic;
  // Samples at every step are their own audit.
  const auto& steps = trajectory.energy_at_steps;
  json["energy_error"] = steps ? steps->largest_error : audit.largest_error;
  json["energy_error_time"] = steps ? steps->time : audit.largest_error_time;
  json["energy_error_of_frames"] = audit.largest_error;
  json["energy_error_of_frames_time"] = audit.largest_error_time;
  json["energy_moved"] = audit.energy_moved;
  json["warnings"] = Json::array();
  for (const std::string& doubt : scene.doubts)
    json["warnings"].push_back({{"kind", "scene"}, {"amount", nullptr}, {"what", doubt}, {"remedy", ""}});
  for (const Doubt& doubt : report.warnings)
    json["warnings"].push_back(
        {{"kind", doubt.kind}, {"amount", doubt.amount}, {"what", doubt.words}, {"remedy", doubt.remedy}});
  json["constraint_error"] = trajectory.rows > 0 ? report.constraints() : Json(nullptr);
  json["limits_passed"] = to_json(trajectory.limits);
  add_events(json, scene, trajectory);
  json["trajectory_sha256"] = audit.sha256;
  json["left_picture_at"] = or_null(report.left_picture_at);
  return json;
}

Json to_json(const std::vector<LimitEvent>& limits) {
  Json json = Json::array();
  for (const LimitEvent& one : limits)
    json.push_back({{"joint", one.joint}, {"quantity", one.quantity}, {"t", one.t}, {"value", one.value}, {"limit", one.limit}});
  return json;
}

void tell_warnings(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) tell_warning(line);
}

namespace {

std::vector<double> instants_until(double end) {
  constexpr int kInstants = 200;
  std::vector<double> times;
  for (int k = 0; k <= kInstants; ++k) times.push_back(end * k / kInstants);
  return times;
}

bool is_acknowledged(const PreparedScene& prepared, const std::string& kind) {
  return std::ranges::find(prepared.scene.acknowledge, kind) != prepared.scene.acknowledge.end();
}

}  // namespace

void warn_of_rank(const PreparedScene& prepared, double end) {
  if (prepared.simulation.constraints.empty() || !(end > 0) || is_acknowledged(prepared, "rank")) return;
  const Trajectory trajectory = simulate(prepared.simulation, instants_until(end), [](double) { return interrupted(); });
  throw_if_interrupted();
  if (const std::optional<Doubt> doubt = doubt_of_rank(prepared.simulation, trajectory, end)) tell_warnings({prepared.scene.name + ": " + doubt->words});
}

void warn_of_run(const PreparedScene& prepared, const Trajectory& trajectory) {
  std::vector<std::string> lines;
  for (const Doubt& doubt : warnings_of(prepared, trajectory, audit_of(prepared.simulation, trajectory)))
    if (doubt.kind != "samples" && !is_acknowledged(prepared, doubt.kind)) lines.push_back(prepared.scene.name + ": " + doubt.words);
  tell_warnings(lines);
}

void warn_of_run(const PreparedScene& prepared) {
  if (!(prepared.simulation.duration > 0)) return;
  const Trajectory trajectory = simulate_audited(prepared.simulation, instants_until(prepared.simulation.duration), [](double) { return interrupted(); });
  throw_if_interrupted();
  warn_of_run(prepared, trajectory);
}

std::vector<std::string> warning_lines(const std::string& name, const RunReport& report) {
  std::vector<std::string> lines;
  const std::vector<std::string>& known = report.prepared.scene.acknowledge;
  for (const Doubt& doubt : report.warnings)
    if (std::find(known.begin(), known.end(), doubt.kind) == known.end()) lines.push_back(name + ": " + doubt.words + "; take " + doubt.remedy);
  return lines;
}

std::vector<std::string> warning_lines(const FilmReport& report) {
  const std::string& name = report.film().scene.name;
  if (report.panels.size() == 1) return warning_lines(name, report.panels.front());
  std::vector<std::string> lines;
  for (const RunReport& panel : report.panels)
    for (std::string& line : warning_lines(name + ", '" + in_plain_words(title_of(panel)) + "'", panel)) lines.push_back(std::move(line));
  return lines;
}

std::string limit_note(const LimitEvent& limit, LimitPolicy policy) {
  return to_string(limit) + (is_cut(limit, policy) ? ": by limit: clamp, torques beyond it are cut" : "");
}

std::string limit_words(const LimitEvent& limit, LimitPolicy policy) {
  if (is_cut(limit, policy)) return "is asked for more than its limit of effort: the torque is cut to that";
  return "passes its limit of " + limit.quantity;
}

std::vector<std::string> notes_of(const PreparedScene& prepared, const Trajectory& trajectory) {
  constexpr double kNoRate = 1e-9;  // rad/s or m/s
  constexpr std::size_t kMostLimits = 6;  // the audit tells of all
  std::vector<std::string> notes;
  const Scene& scene = prepared.scene;
  const bool has_stopped = trajectory.status == RunStatus::stopped;
  const std::vector<LimitEvent>& limits = trajectory.limits;
  const bool by_limit = has_stopped && scene.limit == LimitPolicy::stop && trajectory.ending_event < 0;
  for (std::size_t i = 0; i < limits.size() && !by_limit; ++i) {
    if (i == kMostLimits) {
      notes.push_back(std::to_string(limits.size() - i) + " more limits are passed: see `limits_passed` of --json");
      break;
    }
    notes.push_back(limit_note(limits[i], scene.limit));
  }
  for (const int event : trajectory.events.from_start)
    notes.push_back("event '" + scene.events[std::size_t(event)].title() + "' holds at t = 0 already: instants are those at which it begins again");
  const bool draws_reactions = std::find(scene.draw.begin(), scene.draw.end(), "constraint_force") != scene.draw.end();
  if (draws_reactions)
    if (const auto largest = rounding_of(prepared.simulation.chain, reactions_along(prepared.simulation, trajectory)))
      notes.push_back("constraint_force: no arrow, as what the constraints bear is rounding beside the robot's weight, " + format_significant(*largest, 2) + " N at most");
  if (const auto held = foot_is_held_from(prepared.simulation, trajectory)) notes.push_back("from t = " + format_significant(*held, 4) + " s on " + kFootIsHeld);
  if (!trajectory.trouble.empty() && is_complete(trajectory.status)) notes.push_back("stopped: " + trajectory.trouble);
  if (trajectory.size() > 1 && std::ranges::all_of(trajectory.qd, [](double rate) { return std::abs(rate) < kNoRate; }))
    notes.push_back("nothing moves: the start is at rest, and all that acts on it cancels: another `start` is needed, or a torque");
  return notes;
}

namespace {

std::string layers_left_out(const std::vector<std::string>& layers, const Scene& page) {
  if (page.video.least_text > 0)
    return page.name + ": " + joined(layers) + ": not drawn, as nothing is written below 7 pt and the page has no room for more: take "
           "a larger --height-mm or --width-mm";
  // Smaller pages are those of that height made smaller, words and all.
  const std::string where = page.video.height < kLeastPagePixels ? " on pages from " + std::to_string(kLeastPagePixels) + " px of height on" : "";
  return page.name + ": " + joined(layers) + ": not drawn, as no word may be lower than " + format_shortest(kLeastWordPixels) +
         " px" + where + " and " + std::to_string(page.video.width) + " x " + std::to_string(page.video.height) + " px have no room for more";
}

}  // namespace

std::vector<std::string> left_out_words(const std::vector<std::string>& layers, double held_text_scale, const Scene& page) {
  std::vector<std::string> lines;
  if (!layers.empty()) lines.push_back(layers_left_out(layers, page));
  if (held_text_scale > 0)
    lines.push_back(page.name + ": words have text_scale " + format_significant(held_text_scale, 2) + " instead of " + format_shortest(page.text_scale) +
                    ", as its plot and its scene have no room beside larger ones");
  return lines;
}

void tell_left_out(const std::vector<std::string>& layers, double held_text_scale, const Scene& page, bool quiet) {
  if (quiet) return;
  for (const std::string& line : left_out_words(layers, held_text_scale, page)) std::fprintf(stderr, "note: %s\n", line.c_str());
}

double held_first(const Scene& scene) {
  return frame_time(frame_count(scene.hold.first, scene.video.fps), scene.video.fps);
}

Json to_json(const Stretch& one) {
  Json json{{"from", one.from}, {"until", one.until}, {"speed", one.speed}};
  json["ease"] = one.cause.empty() ? Json(nullptr) : Json(one.ease);
  json["because"] = or_null(one.cause);
  return json;
}

std::string to_words(const Stretch& one) {
  return "t = " + format_significant(one.from, 6) + " s to " + format_significant(one.until, 6) + " s at " + speed_text(one.speed) +
         (one.ease > 0 && !one.cause.empty() ? ", eased within that" : "") + (one.cause.empty() ? "" : " (" + one.cause + ")");
}

FilmReport film_report(const Runs& runs, const Film& pictures, int frames) {
  FilmReport report{runs, {}, frames, pictures.clock(), {}, {}, Writes::films, pictures.left_out(), pictures.held_text_scale()};
  double end = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    report.panels.push_back(run_report(runs.film().panels[i], runs[i]));
    report.panels.back().left_picture_at = pictures.panel(int(i)).left_at();
    end = std::max(end, runs[i].end_time);
  }
  for (const Stretch& one : report.clock.stretches())
    if (one.from < end) {
      report.slow_motion.push_back(one);
      report.slow_motion.back().until = std::min(one.until, end);
    }
  const Camera& camera = pictures.camera();
  report.view = {1 / camera.scale, camera.project(Eigen::Vector3d::Zero())};
  const Scene& page = report.film().scene;
  for (const Pause& one : pauses_of(page.annotate, events_of(runs)))
    if (one.seconds > 0 && one.at <= end) report.pauses.push_back(one);
  return report;
}

Json to_json(const FilmReport& report) {
  const Scene& scene = report.film().scene;
  Json json = Json::object();  // JSON's null that becomes an object is lost where memory is short
  if (report.panels.size() == 1) {
    json = to_json(report.panels.front());
    json["layout"] = to_string(scene.layout);
    json["panels"] = Json::array();
  } else {
    json = {{"scene", scene.file},
            {"title", scene.title},
            {"duration", scene.duration},
            {"layout", to_string(scene.layout)}};
    json["panels"] = Json::array();
    json["warnings"] = Json::array();  // of all
    for (const RunReport& panel : report.panels) {
      json["panels"].push_back(to_json(panel));
      for (Json warning : json["panels"].back()["warnings"]) {
        warning["panel"] = json["panels"].size();
        json["warnings"].push_back(std::move(warning));
      }
      for (const char* shared : {"scene", "duration"}) json["panels"].back().erase(shared);
      if (is_ghost_layout(scene)) json["panels"].back()["look"] = &panel == &report.panels.front() ? "filled" : "outline";
    }
  }
  json.update(clip_facts(scene.video.width, scene.video.height, scene.video.fps, report.frames));
  json["left_out"] = report.left_out;
  json["view"] = {{"height", report.view.height}, {"origin", {report.view.origin.x, report.view.origin.y}}};
  json["style"] = style_report(report.film());
  const double held = held_first(scene);
  json["slow_motion"] = Json::array();
  for (const Stretch& one : report.slow_motion) {
    Json entry = to_json(one);
    entry["film_from"] = held + report.clock.film_time(one.from);
    entry["film_until"] = held + report.clock.film_time(one.until);
    json["slow_motion"].push_back(std::move(entry));
  }
  json["pauses"] = Json::array();
  std::map<double, double> stood;  // s, by instant: pauses at one follow one another
  for (const Pause& one : report.pauses) {
    json["pauses"].push_back({{"at", one.at}, {"seconds", one.seconds}, {"film_from", held + report.clock.film_time(one.at) + stood[one.at]}});
    stood[one.at] += one.seconds;
  }
  json["versions"] = Json::object();
  for (const LibraryLine& line : library_versions(report.writes)) json["versions"][line.name] = line.version;
  return json;
}

}  // namespace chainreel
