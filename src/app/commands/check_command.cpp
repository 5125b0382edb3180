// chainreel check SCENE|MODEL|FILM: the effective scene with all defaults, what of the mechanism is modelled, and whether a film is
// the one that its audit tells of.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/film/automatic.hpp"
#include "app/film/model_scene.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/report/report.hpp"
#include "app/report/run_report.hpp"
#include "app/today/check_film.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "integrate/method.hpp"
#include "model/doctor.hpp"
#include "model/read_chain.hpp"
#include "scene/text/write_scene.hpp"
#include "sim/instant.hpp"

namespace chainreel {
namespace {

struct CheckOptions {
  std::vector<std::string> files;  // several where they are films
  std::string scene;               // that films are held against
  bool today = false;              // ... or each its own
  std::string junit;               // a file for what is found
  bool commands = false;           // that make anew what is another thing today
  bool all = false;                // candidates of a method that is chosen
  CommonOptions common;

  const std::string& file() const { return files.front(); }
};

std::string kind_name(const Joint& joint) {
  switch (joint.kind) {
    case JointKind::revolute:
      return "revolute";
    case JointKind::prismatic:
      return "prismatic";
    case JointKind::floating:
      return "floating";
  }
  return "";
}

// Whether no pose gives the end effector a finite mass along each direction, though there are joints enough, as where it lies on the last axis: told
// of a pose that is as good as any.
bool is_singular_everywhere(const Chain& chain) {
  if (chain.end_effector < 0 || chain.has_floating) return false;
  Workspace ws(chain);
  std::vector<double> q;
  for (int i = 0; i < chain.nq; ++i) q.push_back(0.4 + 0.3 * i);
  const EffectiveMass mass = TipMass(chain).at(ws, q);
  return !mass.singular_directions.empty() && std::ptrdiff_t(chain.nv) >= mass.mobility.size();
}

Json model_report(const Chain& chain) {
  Json json;
  json["name"] = chain.name;
  json["freedoms"] = chain.nv;
  json["joints"] = Json::array();
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Body& body = chain.bodies[i];
    Json joint{{"name", body.joint.name},
               {"kind", kind_name(body.joint)},
               {"body", body.name},
               {"parent", body.parent == 0 ? "world" : chain.bodies[std::size_t(body.parent)].name},
               {"mass", body.inertia.mass}};
    const std::string& coordinate = chain.coordinate_names[std::size_t(body.joint.v_index)];
    joint.update({{"follows", nullptr}, {"ratio", nullptr}, {"offset", nullptr}});
    if (body.joint.kind != JointKind::floating && coordinate != body.joint.name)
      joint.update({{"follows", coordinate}, {"ratio", body.joint.ratio}, {"offset", body.joint.offset}});
    json["joints"].push_back(joint);
  }
  json["lumped_links"] = int(chain.frames.size()) - int(chain.bodies.size());
  json["algebra"] = chain.planar ? "planar" : "spatial";
  json["why"] = chain.why_algebra;
  json["forward_dynamics"] = forward_dynamics_algorithm(chain);
  json["gravity"] = to_json(chain.gravity);
  json["friction"] = nullptr;
  if (std::any_of(chain.bodies.begin(), chain.bodies.end(), [](const Body& b) { return b.joint.friction > 0; }))
    json["friction"] = {{"law", "F tanh(qd / " + format_shortest(kFrictionSmoothing) + ")"},
                        {"creeps_under_three_quarters", kFrictionSmoothing * std::atanh(0.75)}};
  json["constraints"] = nullptr;  // of a scene
  json["end_effector"] = nullptr;
  if (chain.end_effector >= 0) json["end_effector"] = chain.frames[std::size_t(chain.end_effector)].name;
  json["singular_everywhere"] = is_singular_everywhere(chain);
  json["ends"] = Json::array();
  for (const int frame : chain.leaf_frames) json["ends"].push_back(chain.frames[std::size_t(frame)].name);
  return json;
}

Json cost_report(const Scene& scene, const Simulation& simulation, int frames) {
  // Counted, not guessed: adaptive methods have no other way. Nothing is sampled.
  const Trajectory run = simulate(simulation, {}, [](double) { return interrupted(); });
  throw_if_interrupted();
  const auto of_layer = [&](const char* layer) {
    return std::find(scene.draw.begin(), scene.draw.end(), layer) != scene.draw.end() ? frames : 0;
  };
  return {{"method", simulation.method->name},
          {"order", simulation.options.order > 0 ? simulation.options.order : simulation.method->order},
          {"status", to_string(run.status)},
          {"steps", run.steps},
          {"evaluations", run.evaluations},
          {"frames", frames},
          {"pixels_a_frame", scene.video.width * scene.video.height},
          {"layers", scene.draw},
          {"energies_computed", frames},
          {"Lambda_computed", of_layer("ellipse")},
          {"torques_computed", of_layer("torque")},
          {"constraint_forces_computed", simulation.constraints.empty() ? 0 : of_layer("constraint_force")},
          {"M_computed", of_layer("mass_matrix")}};
}

// What a joint mimics: "-1 left + 0.2".
std::string follows_text(const Json& joint) {
  if (joint["follows"].is_null()) return "";
  const double ratio = joint["ratio"].get<double>(), offset = joint["offset"].get<double>();
  std::string text = (ratio == 1 ? "" : format_shortest(ratio) + " ") + joint["follows"].get<std::string>();
  if (offset != 0) text += (offset > 0 ? " + " : " - ") + format_shortest(std::abs(offset));
  return text;
}

std::string words_of(const Json& list) {
  std::string words;
  for (const Json& word : list) words += (words.empty() ? "" : ", ") + word.get<std::string>();
  return words;
}

void print_model(const Json& model) {
  std::printf("model %s: %d freedoms; %s; forward dynamics: %s\n", model["name"].get<std::string>().c_str(),
              model["freedoms"].get<int>(), model["why"].get<std::string>().c_str(),
              model["forward_dynamics"].get<std::string>().c_str());
  std::vector<std::vector<std::string>> table{{"joint", "kind", "moves", "on", "kg"}};
  bool any_mimics = false;
  for (const Json& joint : model["joints"]) {
    table.push_back({joint["name"].get<std::string>(), joint["kind"].get<std::string>(),
                     joint["body"].get<std::string>(), joint["parent"].get<std::string>(),
                     joint["mass"].dump(), follows_text(joint)});
    any_mimics |= !joint["follows"].is_null();
  }
  table.front().emplace_back(any_mimics ? "mimics" : "");
  if (!any_mimics)
    for (std::vector<std::string>& row : table) row.pop_back();
  std::fputs(table_text(table).c_str(), stdout);
  if (!model["friction"].is_null())
    std::printf("friction: %s, in which nothing sticks: pushed by 3/4 of its F a joint creeps at %s rad/s or m/s\n",
                model["friction"]["law"].get<std::string>().c_str(),
                format_significant(model["friction"]["creeps_under_three_quarters"].get<double>(), 2).c_str());
  if (!model["end_effector"].is_null())
    std::printf("end effector: %s%s\n", model["end_effector"].get<std::string>().c_str(),
                model["singular_everywhere"].get<bool>() ? ", which no joint moves along one direction or more, at no pose, as where it lies on the last axis: Lambda is infinite there; "
                                                           "a frame at the tip has one, a link on a fixed joint in the URDF" : "");
  else
    std::printf("end effector: none of %s; choose one with `--set end_effector=NAME`\n",
                words_of(model["ends"]).c_str());
}

constexpr std::size_t kNextBest = 3;

// "" of a candidate that keeps the accuracy and what that allows of curves.
std::string what_it_misses(const Choice::Candidate& one, const Choice& choice, const Accuracy& accuracy) {
  if (!one.trouble.empty()) return one.trouble;
  if (!(one.error <= accuracy.value)) return "misses the accuracy";
  if (one.curve_error && *one.curve_error <= choice.curve_allowed) return "";
  return "curves beyond " + format_significant(100 * choice.curve_allowed, 2) + " %";
}

// The best first: what keeps the accuracy by its cost, then the others by their errors.
std::vector<Choice::Candidate> ranked(const Choice& choice, const Accuracy& accuracy) {
  std::vector<Choice::Candidate> all;
  for (const Choice::Candidate& one : choice.tried)
    if (to_string(one.setting) != to_string(choice.best.setting)) all.push_back(one);
  const auto keeps = [&](const Choice::Candidate& one) { return what_it_misses(one, choice, accuracy).empty(); };
  std::stable_sort(all.begin(), all.end(), [&](const Choice::Candidate& a, const Choice::Candidate& b) {
    if (keeps(a) != keeps(b)) return keeps(a);
    return keeps(a) ? a.cost < b.cost : a.error < b.error;
  });
  return all;
}

void print_candidates(const Choice& choice, const Accuracy& accuracy, bool all) {
  std::vector<std::vector<std::string>> table{
      {all ? "next best" : "the next best", "off by, " + to_string(accuracy.unit), "curves, %", "us", "evaluations", ""}};
  const std::vector<Choice::Candidate> others = ranked(choice, accuracy);
  const std::size_t shown = all ? others.size() : std::min(others.size(), kNextBest);
  for (std::size_t i = 0; i < shown; ++i) {
    const Choice::Candidate& one = others[i];
    table.push_back({to_string(one.setting), std::isfinite(one.error) ? format_significant(one.error, 2) : "-",
                     one.curve_error ? format_significant(100 * *one.curve_error, 2) : "-",
                     (one.trouble.empty() ? "" : "> ") + format_significant(one.cost / 1000, 3), std::to_string(one.evaluations),
                     what_it_misses(one, choice, accuracy)});
  }
  if (shown > 0) std::fputs(table_text(table).c_str(), stdout);
  if (shown < others.size()) std::printf("%zu others: --all\n", others.size() - shown);
}

struct ExaminedRun {
  Json model, cost;
};

// `frames`: of the film.
ExaminedRun examine_run(const PreparedScene& prepared, int frames) {
  ExaminedRun report{model_report(prepared.simulation.chain),
                   cost_report(prepared.scene, prepared.simulation, frames)};
  if (!prepared.simulation.constraints.empty())
    report.model["constraints"] = constraint_plan_report(prepared.simulation);
  report.cost["shapes"] = report.cost["triangles"] = 0;
  if (prepared.shapes) {
    std::size_t triangles = 0;
    for (const BodyShape& shape : prepared.shapes->shapes) triangles += shape.mesh->triangles.size() / 3;
    report.cost["shapes"] = prepared.shapes->shapes.size();
    report.cost["triangles"] = triangles;
  }
  report.cost["auto"] = prepared.choice ? choice_report(*prepared.choice, prepared.scene.accuracy, true) : Json(nullptr);
  return report;
}

void print_run(const PreparedScene& prepared, const ExaminedRun& report, bool all) {
  print_model(report.model);
  if (!report.model["constraints"].is_null())
    std::printf("%s\n", constraint_plan_text(report.model["constraints"]).c_str());
  const Json& cost = report.cost;
  if (prepared.simulation.motion)
    std::printf("%s: nothing is computed but what the motion takes, %ld steps from row to row, %d frames\n",
                method_text(prepared.scene).c_str(), cost["steps"].get<long>(), cost["frames"].get<int>());
  else
    std::printf("%s: order %d, %ld steps, %ld evaluations of the dynamics, %d frames\n",
              to_string(MethodSetting{prepared.simulation.method, prepared.simulation.options,
                                      prepared.simulation.step})
                  .c_str(),
              cost["order"].get<int>(), cost["steps"].get<long>(), cost["evaluations"].get<long>(),
              cost["frames"].get<int>());
  if (prepared.choice) {
    std::printf("%s\n", choice_text(*prepared.choice, prepared.scene.accuracy).c_str());
    print_candidates(*prepared.choice, prepared.scene.accuracy, all);
  }
  std::printf("computed for the picture only: %d energies, %d Lambda", cost["energies_computed"].get<int>(),
              cost["Lambda_computed"].get<int>());
  for (const auto& [key, name] : {std::pair{"torques_computed", "joint torques"},
                                  {"constraint_forces_computed", "constraint forces"},
                                  {"M_computed", "M"}})
    if (cost[key].get<int>() > 0) std::printf(", %d %s", cost[key].get<int>(), name);
  std::puts("");
  if (prepared.shapes)
    std::printf("drawn as %ld shapes of the model, %ld triangles a frame\n", cost["shapes"].get<long>(),
                cost["triangles"].get<long>());
}

void check_scene(const CheckOptions& options) {
  const PreparedFilm film = load_film(options.file(), overrides_of(options.common), true, options.common.quiet);
  if (options.all && std::none_of(film.panels.begin(), film.panels.end(), [](const PreparedScene& panel) { return panel.choice.has_value(); }))
    throw Error(ExitCode::usage, "--all shows what `method: auto` tried, and the scene names its method or shows a recorded motion: take --set method=auto --set motion=");
  const FilmClock clock = clock_of(film);
  const int frames = clock.frame_count();
  std::vector<ExaminedRun> reports;
  say_notices(film.panels, false);
  for (const PreparedScene& panel : film.panels) reports.push_back(examine_run(panel, frames));
  const std::string text = scene_text(film.scene);
  const bool alone = reports.size() == 1;
  if (options.common.json) {
    Json json{{"scene", text}, {"model", nullptr}, {"cost", nullptr}, {"panels", Json::array()}, {"slow_motion", Json::array()}};
    if (alone) json.update({{"model", reports[0].model}, {"cost", reports[0].cost}});
    for (std::size_t i = 0; i < reports.size() && !alone; ++i)
      json["panels"].push_back(
          {{"title", film.panels[i].scene.title}, {"model", reports[i].model}, {"cost", reports[i].cost}});
    for (const Stretch& one : clock.stretches()) json["slow_motion"].push_back(to_json(one));
    print_json(json);
    return;
  }
  std::printf("# %s with all defaults; paths from this folder\n%s\n", options.file().c_str(), text.c_str());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (!alone)
      std::printf("%spanel %d: %s\n", i > 0 ? "\n" : "", int(i) + 1, film.panels[i].scene.title.c_str());
    print_run(film.panels[i], reports[i], options.all);
  }
  for (const Stretch& one : clock.stretches())
    std::printf("slow motion from %s\n", to_words(one).c_str());
}

void check_model(const CheckOptions& options) {
  if (options.all) throw Error(ExitCode::usage, "--all goes with a scene, whose method is chosen");
  std::vector<std::string> honoured = keys_of_models(OfModel::mechanism);
  honoured.push_back("end_effector");
  const ModelScene model = model_scene_of(options.file(), overrides_of(options.common), "check", honoured);
  const std::vector<Finding> findings = examine_model(options.file(), model.options);
  Json list = Json::array();
  std::vector<Problem> errors;
  for (const Finding& finding : findings) {
    const std::string severity = to_string(finding.severity);
    list.push_back({{"severity", severity},
                    {"message", finding.message},
                    {"file", finding.place.file},
                    {"line", finding.place.line}});
    if (finding.severity == Finding::Severity::error)
      errors.push_back({finding.message, finding.place});
    else if (!options.common.json)
      std::printf("%s: %s\n", severity.c_str(), to_string(Problem{finding.message, finding.place}).c_str());
  }
  Json report{{"findings", list}, {"model", nullptr}};
  if (errors.empty())
    report["model"] = model_report(read_chain(options.file(), model.options));
  if (options.common.json)
    print_json(report);
  else if (errors.empty())
    print_model(report["model"]);
  if (!errors.empty()) throw Error(ExitCode::bad_input, errors);
}

void run_check(const CheckOptions& options) {
  std::error_code code;
  const bool are_films = std::all_of(options.files.begin(), options.files.end(), [&](const std::string& file) {
    return is_film_or_picture(file) || std::filesystem::is_directory(file, code);
  });
  const bool is_of_today = options.today || !options.scene.empty();
  if (is_of_today && !are_films)
    throw Error(ExitCode::usage, "--today and --scene go with films and pictures, or a folder of them: `chainreel check FILM.mp4 --today`");
  if (options.commands && (!is_of_today || options.common.json))
    throw Error(ExitCode::usage, "--commands goes with --today and without --json, which has each film's `command`: chainreel check out/ --today --commands | sh");
  if (are_films && options.all) throw Error(ExitCode::usage, "--all goes with a scene, whose method is chosen");
  if (!is_of_today && !options.junit.empty()) throw Error(ExitCode::usage, "--junit goes with --today: chainreel check out/ --today --junit out/today.xml");
  if (is_of_today) return check_of_today(options.files, options.scene, options.commands, options.junit, options.common);
  if (options.files.size() > 1 || (are_films && std::filesystem::is_directory(options.file(), code)))
    throw Error(ExitCode::usage, "takes one scene, model or film; several films, or a folder of them, go with --today");
  if (are_films) return check_as_written(options.file(), options.common);
  is_model_file(options.file()) ? check_model(options) : check_scene(options);
}

}  // namespace

void add_check_command(CommandLine& app) {
  auto options = std::make_shared<CheckOptions>();
  Command* command =
      app.add_subcommand("check", "the effective scene with all defaults, what a model holds, or whether a film is as it was written");
  command->add_option("files", options->files, "a scene (.yaml), a model (.urdf), or a film or picture with its audit, NAME.json, beside it; with --today also several, and folders").required().names_input();
  add_scene_options(*command, options->common);
  command->add_flag("--today", options->today, "of films, pictures and tables: would their scenes, which the audits beside them name, make the same today?");
  command->add_option("--scene", options->scene, "the same of this scene").names_input();
  command->add_option("--junit", options->junit, "with --today: results as JUnit XML, a case a film, picture or table");
  command->add_flag("--commands", options->commands, "with --today: print the commands that make anew what is another thing today, for a shell");
  command->add_flag("--all", options->all, "of a method that is chosen, all candidates instead of the three next best");
  add_json_option(*command, options->common);
  command->footer("Of a film or picture all files that the audit tells of are held against their SHA-256, and the audit against what the film\n"
                  "remembers: exit code 1 where one was changed since, or is gone. With --today it is asked whether the scene, its model and meshes and\n"
                  "the program of today would make the same film, with the --set that its audit tells and what is given besides: exit code 1 and what has changed where they would\n"
                  "not; 3 where of one of several it cannot be told, whatever comes of the others. It is simulated, not drawn.\n"
                  "Example: chainreel check rr_free --set method=rk4\n"
                  "or, behind `chainreel render rr_free`: chainreel check out/rr_free.mp4\n"
                  "                                       chainreel check out/ --today\n"
                  "                                       chainreel check out/ --today --commands | sh");
  command->callback([options] { run_check(*options); });
}

}  // namespace chainreel
