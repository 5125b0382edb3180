#include "app/report/alt_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/report/motion_table.hpp"
#include "app/report/report.hpp"
#include "core/format.hpp"
#include "dynamics/constraints/constraint_rows.hpp"
#include "draw/layers/speed_box.hpp"
#include "picture/formula_words.hpp"
#include "scene/annotation.hpp"
#include "scene/run/fall.hpp"
#include "scene/run/title.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

constexpr double kCaptionSeconds = 2;  // at most; the next event ends it
constexpr double kLeastCaption = 0.5;  // s that words stand, so that they can be read, beside those that come meanwhile
constexpr double kSameInstant = 0.05;  // s of the film: what comes so close together comes at once

struct Moment {
  double t = 0;  // of the run, or of the film, s
  std::string text;
  double stay = kCaptionSeconds;  // s of the film
  bool is_word = false;           // of `annotate:`, which the picture shows for as long
};

std::string vector_text(const std::vector<double>& values) {
  std::string text = "(";
  for (std::size_t i = 0; i < values.size(); ++i)
    text += (i > 0 ? ", " : "") + format_significant(values[i], 4);
  return text + ")";
}

// Of gains in the space of the task: what of the two acts.
std::string drive_words(const std::vector<double>& kp, const std::vector<double>& kd) {
  const auto acts = [](const std::vector<double>& gains) { return std::ranges::any_of(gains, [](double gain) { return gain != 0; }); };
  return acts(kp) && acts(kd) ? "a spring and a damper" : acts(kd) ? "a damper" : "a spring";
}

// What it is made of, in the order in which it is added.
std::string control_words(const Control& control, const std::string& end_effector) {
  std::vector<std::string> parts;
  if (!control.csv.empty()) parts.emplace_back("torques of a table");
  if (!control.inverse_of.empty()) parts.emplace_back("the torques that a recorded motion takes");
  if (control.pd) parts.emplace_back("springs and dampers of the joints (pd)");
  if (control.computed_torque) parts.emplace_back("computed torque");
  if (control.task) parts.push_back(drive_words(control.task->kp, control.task->kd) + " at " + (control.task->frame.empty() ? end_effector : control.task->frame));
  if (control.gravity_compensation) parts.emplace_back("gravity compensation");
  if (!control.plus.empty()) {
    std::vector<std::string> texts;
    for (const Entry& one : control.plus) texts.push_back(one.text);
    parts.push_back("torques (" + joined(texts) + ")");
  }
  return joined(parts, " and ");
}

// ", where k = 1200, lean = 0.05": the parameters that formulas read.
std::string where_words(const Scene& scene, const std::string& formulas) {
  const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  const auto reads = [&](const std::string& name) {
    for (std::size_t at = formulas.find(name); at != std::string::npos; at = formulas.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if ((at == 0 || !is_of_name(formulas[at - 1])) && (end == formulas.size() || !is_of_name(formulas[end]))) return true;
    }
    return false;
  };
  std::vector<std::string> values;
  for (const auto& [name, value] : scene.parameters)
    if (reads(name)) values.push_back(name + " = " + format_significant(value, 4));
  return values.empty() ? "" : ", where " + joined(values);
}

std::string torque_words(const Scene& scene) {
  if (scene.motion) return "the torques that a recorded motion takes (inverse dynamics)";
  if (scene.control && scene.control->function) return "torques of " + scene.control->function->words;
  if (scene.control) return control_words(*scene.control, scene.end_effector);
  std::string text;
  bool acts = false;
  for (const TorqueEntry& entry : scene.torque) {
    text += (text.empty() ? "" : ", ") + (entry.control ? control_words(*entry.control, scene.end_effector) : entry.text);
    acts = acts || entry.control || entry.text != "0";
  }
  if (acts) return "torques (" + text + ")" + where_words(scene, text);
  return scene.contact_force.empty() ? "no torques" : "torques that press alone";
}

// ", pushed by 60 N at trunk from 0.5 s to 0.6 s": what acts of each push, as its arrow shows it.
std::string push_words(const PreparedScene& panel) {
  const Pushes* pushes = panel.simulation.torque->pushes();
  if (pushes == nullptr) return "";
  std::string text;
  for (const ActingPush& push : pushes->list())
    text += (text.empty() ? ", pushed by " : " and ") + format_significant(push.force.norm(), 4) + " N at " +
            panel.simulation.chain.frames[std::size_t(push.frame)].name + " from " + format_significant(push.from, 4) + " s" +
            (std::isfinite(push.until) ? " to " + format_significant(push.until, 4) + " s" : " on");
  return text;
}

// ", pressing with 5 N on its line"
std::string press_words(const PreparedScene& panel) {
  std::string text;
  const ConstraintPlan& plan = panel.simulation.constraints;
  for (const ContactForce& one : plan.contact_forces)
    text += (text.empty() ? ", pressing with " : " and ") + format_significant(one.force.norm(), 4) + " N on " + name_of(plan.list[one.constraint]);
  return text;
}

std::string payload_words(const Scene& scene) {
  if (!(scene.payload.mass > 0)) return "";
  const std::string& link = scene.payload.link.empty() ? scene.end_effector : scene.payload.link;
  return ", with a load of " + format_significant(scene.payload.mass, 4) + " kg at " + link;
}

// ", of which it keeps 1, tied by a line,": each constraint by the name that it goes by elsewhere.
std::string tie_words(const PreparedScene& panel, const Trajectory& run) {
  const ConstraintPlan& plan = panel.simulation.constraints;
  std::vector<std::string> names;
  for (const Constraint& one : plan.list) names.push_back(name_of(one));
  if (names.empty()) return "";
  // Rows that repeat each other at one pose, as where a linkage is stretched, do not at others.
  const Chain& chain = panel.simulation.chain;
  const ConstraintSet set(chain, plan.list);
  Workspace ws(chain);
  int freed = chain.nv;
  for (const int k : {0, run.size() / 2, run.size() - 1})
    if (k >= 0 && k < run.size()) freed = std::min(freed, int(free_directions(chain, ws, set, run.q_at(k)).cols()));
  return ", of which it keeps " + (freed == 0 ? "none" : std::to_string(freed)) + ", tied by " + joined(names) + ",";
}

std::string resistance_words(const Chain& chain) {
  const auto any = [&](double Joint::*part) { return std::any_of(chain.bodies.begin(), chain.bodies.end(), [part](const Body& body) { return body.joint.*part > 0; }); };
  if (!chain.has_dissipation) return "";
  const bool is_damped = any(&Joint::damping), rubs = any(&Joint::friction);
  return std::string(", with ") + (is_damped && rubs ? "damping and friction" : rubs ? "friction" : "damping") + " in its joints";
}

std::string motion_words(const PreparedScene& panel, const Trajectory& run) {
  const double seconds = run.end_time;
  const Scene& scene = panel.scene;
  const Chain& chain = panel.simulation.chain;
  const bool starts_at_rest =
      std::all_of(scene.start.qd.begin(), scene.start.qd.end(), [](double qd) { return qd == 0; });
  return "the chain" + (chain.name == "chain" ? "" : " " + chain.name) + " with " + std::to_string(chain.nv) +
         (chain.nv == 1 ? " freedom" : " freedoms") + tie_words(panel, run) + " moves for " + format_significant(seconds, 4) + " s" +
         " under " +
         (chain.gravity.norm() > 0
              ? "gravity of " + format_significant(chain.gravity.norm(), 4) + " m/s\u00B2 and "
              : "no gravity and ") +
         torque_words(scene) + press_words(panel) + push_words(panel) + payload_words(scene) +
         resistance_words(chain) + ", starting " + (starts_at_rest ? "at rest" : "in motion") +
         " from q = " + vector_text(scene.start.q);
}

void add_events(std::vector<Moment>& moments, const RunReport& run, const std::string& where) {
  const EventHits& hits = run.trajectory.events;
  for (int k = 0; k < hits.size(); ++k) {
    const EventEntry& event = run.prepared.scene.events[std::size_t(hits.event[std::size_t(k)])];
    moments.push_back({hits.t[std::size_t(k)], where + event.title()});
  }
}

// What `annotate:` says, formulas as they are written.
void add_words(std::vector<Moment>& moments, const FilmReport& report) {
  const std::vector<RunEvents> events = events_of(report.runs);
  for (const AnnotationEntry& entry : report.film().scene.annotate) {
    const auto at = instant_of(entry, events);
    const std::size_t panel = std::min(std::size_t(entry.panel), report.panels.size()) - 1;
    if (!at || *at > report.panels[panel].trajectory.end_time) continue;
    const RunReport& run = report.panels[panel];
    moments.push_back({*at, in_plain_words(filled_words(entry.text, run.prepared.scene, run.trajectory)), seconds_shown(entry), true});
  }
}

// "; stands still at t = 1.2 s for 2 s"
std::string pause_words(const FilmReport& report) {
  std::string text;
  for (const Pause& one : report.pauses)
    text += std::string(text.empty() ? "; stands still at t = " : ", at ") + format_significant(one.at, 6) + " s for " +
            format_quantity(one.seconds, "s");
  return text;
}

void add_troubles(std::vector<Moment>& moments, const RunReport& run, const std::string& where) {
  for (const LimitEvent& limit : run.trajectory.limits)
    moments.push_back({limit.t, where + "joint " + limit.joint + " " + limit_words(limit, run.prepared.scene.limit)});
  if (run.left_picture_at) moments.push_back({*run.left_picture_at, where + "the chain leaves the picture"});
}

// "rk4: " of one panel of several.
std::string where_of(const FilmReport& report, const RunReport& run) {
  return report.panels.size() == 1 ? "" : in_plain_words(title_of(run)) + ": ";
}

void sort_by_time(std::vector<Moment>& moments) {
  std::stable_sort(moments.begin(), moments.end(),
                   [](const Moment& a, const Moment& b) { return a.t < b.t; });
}

std::string srt_time(double t) {
  const long ms = std::lround(1000 * t);
  char text[32];
  std::snprintf(text, sizeof text, "%02ld:%02ld:%02ld,%03ld", ms / 3600000, ms / 60000 % 60, ms / 1000 % 60,
                ms % 1000);
  return text;
}

// "; not at its own speed: t = 1 s to 1.5 s at 0.25x"
std::string speed_words(const FilmReport& report) {
  std::vector<std::string> stretches;
  for (const Stretch& one : report.slow_motion)
    stretches.push_back(to_words(one));
  return stretches.empty() ? "" : "; not at its own speed: " + joined(stretches);
}

// "Constraints: missed by 3.9e-16 at most; largest multipliers: lambda1 [N] 3360 at t = 1.31 s (line gripper)": a line of each run that has some.
std::string constraint_lines(const FilmReport& report) {
  std::string text;
  for (const RunReport& run : report.panels) {
    if (run.trajectory.rows == 0) continue;
    const Json& facts = run.constraints();
    text += "Constraints: " + where_of(report, run) + "missed by " + format_significant(run.trajectory.position_error, 2) + " " + unit_of_misses(run.prepared.simulation.constraints.list) + " at most";
    const std::vector<std::string> columns = multiplier_columns(run.prepared.simulation.chain, run.prepared.simulation.constraints.list);
    for (std::size_t i = 0; i < columns.size(); ++i)
      text += (i == 0 ? "; largest multipliers: " : ", ") + columns[i] + " " +
              format_significant(facts["rows"][i]["largest_lambda_signed"].get<double>(), 4) + " at t = " +
              format_significant(facts["rows"][i]["largest_lambda_time"].get<double>(), 4) + " s (" + facts["rows"][i]["name"].get<std::string>() + ")";
    text += "\n";
  }
  return text;
}

// The audit without the place where the scene lay.
Json placeless(Json audit, const Scene& scene) {
  const auto leave_place = [&](Json& part, const char* key) {
    if (part.contains(key)) part[key] = placeless_path(scene, part[key].get<std::string>());
  };
  const auto leave_model = [&](Json& part, const Scene& panel) {
    if (!panel.model.links) leave_place(part, "model");  // numbers lie nowhere
  };
  leave_place(audit, "scene");
  leave_model(audit, scene);
  if (audit.contains("panels"))
    for (std::size_t i = 0; i < audit["panels"].size() && i < scene.compare.size(); ++i)
      leave_model(audit["panels"][i], scene.compare[i]);
  return audit;
}

// Without keys that say nothing: FFmpeg knows an APNG only where its first picture begins within 2 KB.
Json without_empty_keys(const Json& audit) {
  Json brief = Json::object();
  for (const auto& [key, value] : audit.items())
    if (!value.empty() || key == "warnings" || key == "limits_passed") brief[key] = value;
  return brief;
}

}  // namespace

ClipMemory memory_of(const FilmReport& report) {
  const Scene& scene = report.film().scene;
  return {scene.title, sentence_of(report), placeless_scene_text(scene), placeless(without_empty_keys(to_json(report)), scene)};
}

std::string sentence_of(const FilmReport& report) {
  const PreparedFilm& film = report.film();
  std::string text = in_plain_words(film.panels.size() == 1 ? title_of(report.panels.front()) : title_of_page(film.scene));
  if (text.empty()) text = film.scene.name;
  const std::string motion = motion_words(film.panels.front(), report.runs[0]);
  if (film.panels.size() == 1) return text + ": " + motion + ".";
  const bool ghost = is_ghost_layout(film.scene);
  text += ": " + std::to_string(film.panels.size()) +
          (ghost ? " variants in one place (filled: " : " panels at one scale (");
  for (std::size_t i = 0; i < film.panels.size(); ++i)
    text += std::string(i == 0 ? "" : ghost && i == 1 ? "; in outline: " : "; ") + in_plain_words(title_of(report.panels[i]));
  return text + "); in the first, " + motion + ".";
}

std::string alt_text(const FilmReport& report, const ClipLength& clip) {
  const Scene& scene = report.film().scene;
  const std::vector<PreparedScene>& panels = report.film().panels;
  std::string text = sentence_of(report) + "\n\n";
  for (std::size_t i = 1; i < panels.size(); ++i)
    text += in_plain_words(title_of(report.panels[i])) + ": " + motion_words(panels[i], report.runs[i]) + ".\n";
  if (panels.size() > 1) text += "\n";
  text += "Scene: " + scene.name + "\nDuration: " + format_significant(clip.seconds, 6) + " s, " + std::to_string(clip.frames) + " frames";
  const double first = scene.hold.first, last = scene.hold.last;
  if (first > 0) text += "; the first is held for " + format_quantity(first, "s");
  if (last > 0) text += "; the last is held for " + format_quantity(last, "s");
  text += speed_words(report) + pause_words(report) + "\nUnits: m, kg, s, N, N m, J, rad; times are those of the motion\n" + constraint_lines(report);
  for (const std::string& warning : warning_lines(report)) text += "Warning: " + warning + "\n";
  std::vector<Moment> moments;
  for (const RunReport& run : report.panels) add_events(moments, run, where_of(report, run));
  for (const RunReport& run : report.panels) {
    add_troubles(moments, run, where_of(report, run));
    if (const auto held = foot_is_held_from(run.prepared.simulation, run.trajectory)) moments.push_back({*held, where_of(report, run) + kFootIsHeld});
  }
  add_words(moments, report);
  sort_by_time(moments);
  text += moments.empty() ? "What happens: nothing is marked; the motion goes on to its end.\n"
                          : "What happens:\n";
  for (std::size_t i = 0; i < moments.size(); ++i) {
    // An event and the words that point at it are one.
    const bool goes_on = i > 0 && moments[i].t == moments[i - 1].t;
    if (goes_on) text.back() = ';';
    text += (goes_on ? " " : "  t = " + format_fixed(moments[i].t, 3) + " s: ") + moments[i].text + "\n";
  }
  return text;
}

std::string captions(const FilmReport& report) {
  const Scene& scene = report.film().scene;
  std::vector<Moment> moments;
  for (const RunReport& run : report.panels) add_events(moments, run, where_of(report, run));
  add_words(moments, report);
  sort_by_time(moments);
  const double start = held_first(scene), film_end = report.film_seconds();
  // What comes at the film's end is told a little before it.
  const double latest = std::max(0.0, film_end - kLeastCaption);
  for (Moment& moment : moments) moment.t = std::min(start + report.clock.film_time(moment.t), latest);
  std::string text;
  int number = 0;
  for (std::size_t i = 0, next = 0; i < moments.size(); i = next) {
    while (next < moments.size() && moments[next].t < moments[i].t + kSameInstant) ++next;
    const double first = moments[i].t, begin = moments[next - 1].t;  // of all of them: the first a little late, none before its time
    for (std::size_t k = i; k < next; ++k) moments[k].t = first;
    // What came just before stands on until it can have been read, and words of `annotate:` for as long as in the picture, nothing before its time.
    const auto until = [&](const Moment& one) { return one.t + one.stay; };
    std::vector<Moment> standing;
    double end = begin;
    for (std::size_t k = 0; k < next; ++k) {
      if (k < i && !(moments[k].is_word ? until(moments[k]) > begin + kSameInstant : moments[k].t + kLeastCaption > begin)) continue;
      standing.push_back(moments[k]);
      end = std::max(end, until(moments[k]));
    }
    end = std::min(end, film_end);
    if (next < moments.size()) end = std::min(end, moments[next].t);
    // A caption more where words go before the others do.
    std::vector<double> ends{end};
    for (const Moment& one : standing)
      if (one.is_word && until(one) > begin + kSameInstant && until(one) < end - kSameInstant) ends.push_back(until(one));
    std::sort(ends.begin(), ends.end());
    double from = begin;
    for (const double to : ends) {
      if (!(to > from)) continue;
      text += std::to_string(++number) + "\n" + srt_time(from) + " --> " + srt_time(to) + "\n";
      for (const Moment& one : standing)
        if (!one.is_word || from == begin || until(one) > from + kSameInstant) text += one.text + "\n";
      text += "\n";
      from = to;
    }
  }
  return text;
}

}  // namespace chainreel
