// What --json prints: the keys of each command, which a test holds against what the program prints.

#include "app/guide/reference.hpp"

#include <algorithm>

namespace chainreel {
namespace {

using Keys = std::vector<JsonKey>;

const Keys kRun{
    {"scene", "its file"},
    {"title", "of the scene, or of the panel"},
    {"model", "its file, or its numbers"},
    {"model_sha256", "of the URDF"},
    {"model_elements_sha256", "of what the URDF says, without comments and line breaks"},
    {"status", "finished, stopped, diverged, .."},
    {"expect", "what the scene expects: finish, diverge or within_limits"},
    {"trouble", "why it ended early, in words; or null"},
    {"method, step, tolerance, order", "of the integrator; what it has none of is null"},
    {"auto", "how `method: auto` chose it; or null"},
    {"motion", "of a recorded motion, its table; or null"},
    {"torque_function", "the name of a torque that is a function of the caller; or null"},
    {"steps, evaluations", "how many, of the dynamics; the work of torques looks into steps, which of Euler and RK4 takes one more a step"},
    {"duration", "s, that was asked for"},
    {"energy_start, largest_kinetic_energy, energy_moved", "J"},
    {"energy_error, energy_error_time", "J and s: the largest error of the energy at the ends of steps"},
    {"energy_error_of_frames, energy_error_of_frames_time", "the same at the frames alone"},
    {"warnings", "what speaks against it: [{kind, amount, what, remedy}]"},
    {"constraint_error", "how near it stayed to its constraints, and their forces; null without constraints"},
    {"limits_passed", "[{joint, quantity, t, value, limit}]"},
    {"events", "what happened: [{name, kind, t, q, qd}]"},
    {"held_from_start", "names of events that hold at t = 0 already, whose instants are those at which they begin again"},
    {"fall_time", "s, of an event of kind fall; or null"},
    {"end_time", "s, at which it ended"},
    {"trajectory_sha256", "of q and qd at the frames"},
    {"left_picture_at", "s; or null, as in a table always"},
};

const Keys kFilm{
    {"layout", "where things stand on the page"},
    {"panels", "of a comparison a run each, with the keys of runs but scene and duration; else []"},
    {"frames, fps, width, height, film_seconds", "of the first clip"},
    {"left_out", "layers that the page has no room for"},
    {"view", "what the camera sees: {height, origin}, m of the page's height, and where the world's origin lies, in heights of the page from its lower left"},
    {"style", "fonts and logo of a `style:`; or null"},
    {"slow_motion", "[{from, until, speed, ease, because, film_from, film_until}]"},
    {"pauses", "[{at, seconds, film_from}]"},
    {"versions", "of the program and of its libraries"},
    {"set", "what the command line changed of the scene: [\"duration=2\"]"},
    {"scene_path", "of the scene's file, as found from the audit's folder; or null"},
    {"mechanisms", "of each panel its model's links and joints, by which `check --today` names what changed"},
    {"tables", "of each panel the tables that drive it, by name, with hashes of their numbers"},
    {"meshes_sha256", "of what the model is drawn as; or null"},
    {"held_frames", "{first, last}: how many stand still"},
    {"seconds", "what each stage took"},
    {"outputs", "its files: [{file, bytes, sha256, ..}]"},
};

const Keys kFiles{{"file, files", "what was written: the first, or null; and all"}};

Keys with(Keys keys, const Keys& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

const Keys kState{
    {"model", "its name"},
    {"scene, t", "of a scene, and its instant in s; or null"},
    {"formulation, gravity, q, qd, tau", "what was asked"},
    {"M, nle, tau_g, qdd, C, C_qd, tau_f, h, tau_push", "of the equation of motion; h = nle + tau_f, tau_push = J^T F of what pushes, [] where nothing does: M qdd + h = tau + tau_push"},
    {"ends", "links at which the chain ends"},
    {"end_effector, x, xd, J, Jd_qd", "null where there is none"},
    {"basis, basis_directions, Lambda_inv, Lambda, mobility, directions, singular_directions", "of the effective mass, along unit vectors in the world; its eigenvectors in them, a row each; Lambda is null where it is infinite"},
    {"kinetic, potential, linear_momentum, angular_momentum, bodies", "of the whole, and of each link"},
    {"fixed_mass", "kg, of what is fixed to the world: no energy counts it"},
    {"constraint_rows, constraint_status, phi, J_c, Jcd_qd, lambda, contact_forces, baumgarte_gain", "of constraints; [] and null without any"},
};

}  // namespace

const std::vector<JsonKey>& run_keys() {
  return kRun;
}

const std::vector<JsonKey>& film_keys() {
  static const Keys keys = with(with(kFilm, kFiles), {{"part", "{first, behind} of --frames and --shard; or null"},
                                                      {"sidecars", "NAME.json, NAME.txt and others beside the film"},
                                                      {"small_clips", "GIF and APNG: [{file, width, height, fps, frames}]"}});
  return keys;
}

const std::vector<JsonReport>& json_reports() {
  static const std::vector<JsonReport> reports{
      {"render", {{"films", "a scene each: the keys of runs and of films below"}}},
      {"simulate", with(with(kRun, kFiles), {{"panels", "of a comparison scene, title, duration, panels, file and files stand on top, and a run each here; else []"},
                                             {"rows", "of the table"},
                                             {"peaks", "of --peaks [{name, unit, value, t}]; else []"}})},
      {"snapshot", with(kFiles, {{"pictures", "[{file, files, at, panels}], of models [{file, files, poses}]: the numbers of the states that are shown"}})},
      {"sheet", with(kFiles, {{"columns, lines", "of the page"}, {"cells", "[{scene, at, panels}]"}})},
      {"ellipse", with(kFiles, {{"reading, shape, unit", "of the ellipses; not with --joint-space"}, {"poses", "[{t, q, point, Lambda_inv, Lambda, mass_along, eigenvalues, semi_axes, ..}]; mass_along: 1 / Lambda_inv_ii, what a force along each axis moves"}})},
      {"chart", with(kFiles, {{"scene, machine", "what was measured where"},
                              {"warnings", "what speaks against judging by the end of the run; []"},
                              {"duration, judged_until", "of the run; less where no run of these follows the motion to its end: the part that is judged, s"},
                              {"reference, error, qd_scale, judged", "what errors are measured by; judged: which one the chart shows, error or energy_error"},
                              {"units", "of these numbers, by their keys"},
                              {"choice", "that of `method: auto`"},
                              {"methods", "[{method, rungs}]"},
                              {"left_out", "methods that the scene refuses, in words"}})},
      {"energy", with(kFiles, {{"scene, duration", "s"},
                               {"runs", "[{panel, title, method, setting, largest_error, error_at_end, largest_between_steps, evaluations, status}]; panel counts from 1, null where methods are compared"},
                               {"left_out", "methods that the scene refuses, in words"}})},
      {"stability", with(kFiles, {{"scene, method", "what ran"},
                                  {"x, y", "{key, values}"},
                                  {"threads", "how many"},
                                  {"rows", "[[{failed, status, energy_error, energy_scale, stable_by_theory, trouble}]], from below"},
                                  {"failed", "how many cells. Without --x and --y: methods, left_out and start, the motion linearised there"}})},
      {"sweep", with(kFiles, {{"runs", "how many"}, {"outputs", "[{file, done_before, failed, largest}]; largest [{column, value, run, set}] of a table's peaks"}, {"failed", "how many runs"}})},
      {"fall", with(kFiles, {{"scene, duration, method", "what ran"},
                             {"set", "what --set says of it"},
                             {"key", "of --sweep; or null"},
                             {"events", "[{name, kind, when}]"},
                             {"rows", "[{value, status, end_time, fall_time, ended_by, first, stands, tips_at, tips_over, falls, takes_off_at, foot_bears, trouble}]; foot_bears {over_heel, over_toe}, N m of the ankle that a foot at rest bears before it tips, or null"},
                             {"edges", "[{before, behind, from, to, rows, contradicted_at}] of --edges: values of the key between which the end changes, the rows around them, and one between these that ends otherwise, or null"}})},
      {"dynamics", kState},
      {"inverse", with(kFiles, {{"rows", "of the table"}, {"peaks", "of each torque and multiplier, at the rows: [{name, unit, value, t}]"}, {"limits_passed", "first by each joint, of position, rate and effort, at the rows: [{joint, quantity, t, value, limit}]"}, {"coarse_torques", "{largest_difference, t, freedom}: how far torques of splines through every other row are from these, where the table tells no accelerations and has rows enough; or null"}, {"constraints", "rows and errors of a scene's constraints; or null"}})},
      {"equations", with(kFiles, {{"model, coordinates", "what it is about"},
                                  {"M, C, g, damping, friction, J, Lambda", "formulas as text"},
                                  {"end_effector", "the link of J and Lambda"},
                                  {"symbols, notes", "what letters stand for, and what is to be known"}})},
      {"check", {{"scene", "its text with all defaults"},
                 {"model, cost", "of one run; null of a comparison"},
                 {"panels", "[{title, model, cost}] of a comparison; else []"},
                 {"slow_motion", "[{from, until, speed, ease, because}]. Of a .urdf: findings and model. Of a film or picture: audit, passes, audited, [{file, state, sha256, expected}], contradicted, keys of the audit, and remembered, whether a film was there to hold it against. With --today films, of each its file, scene, set, is_same, changed, audit_changed, has_other_versions, is_gone, trouble, and command, the words that make it anew; and passed_over, the files without an audit"}}},
      {"compare", {{"before, after, equal, passes", "what was compared, and whether it is the same"},
                   {"tolerance", "of pictures {error, pixels, edges_forgiven}, of tables {of_range}; or null"},
                   {"explained", "differences that are told, in words"},
                   {"frames, fps, seconds, unequal_frames, frames_beyond, errors, mean_errors", "of films: errors are those of the worst pixel of each frame; first and worst, {frame, ..}, the frame that differs first, and that with the most pixels beyond the tolerance; pictures and models have numbers of their own. Of tables: instants, and columns, [{name, unit, first_time, at_first, largest, largest_time, range}] of those that differ"}}},
      {"verify", {{"suite, baselines, passed, failed", "what was verified, and how it went"},
                  {"pictures", "[{name, source, state, passed, words, tolerance, pixels}]"},
                  {"unused, pruned, notices", "names, and what is to be known"},
                  {"accept", "the command that takes what failed as new baselines; or null"}}},
      {"extract", with(kFiles, {{"scene, audit", "of a clip; or null"}, {"command, figure", "of a figure; or null"}})},
      {"join", with(kFiles, {{"parts, frames", "how many; frames is null of a table"}, {"failed", "of a table, how many of its runs failed; or null"}})},
      {"init", kFiles},
      {"gallery", with(kFiles, {{"clips, pictures", "how many"}})},
      {"bench", {{"films", "[{scene, width, height, fps, frames, stages, whole, encoder_alone, ..}]"}}},
      {"doctor", {{"renderer, fonts, encoders, builds, versions", "what is there; renderer is null where there is none"}}},
      {"methods", {{"methods", "[{name, order, orders, kind, state, dense_order, adaptive, symplectic, reversible, source}]"}}},
      {"help", {{"topics", "[{topic, about}]; of a topic: topic and text"}}},
  };
  return reports;
}

namespace {

std::string table_of(const std::vector<JsonKey>& keys) {
  std::vector<std::vector<std::string>> table{{"keys", "what they say"}};
  for (const JsonKey& key : keys) table.push_back({key.names, key.says});
  return markdown_table(table);
}

}  // namespace

std::string json_page() {
  std::string page =
      "# What --json prints\n\n"
      "One object on standard output, and nothing else; messages go to standard error. A key that is told here is always there: null or [] where\n"
      "there is nothing to say. Numbers that are not finite are null. Times are s, angles rad, energies J. NAME.json beside a film has the\n"
      "same keys as an entry of `films`, but for file, files, part, sidecars and small_clips, and with the hashes of its sidecars.\n\n" +
      code_block("sh", "chainreel simulate rr_free --json --quiet | jq .energy_error\nchainreel render rr_free --json --quiet | jq '.films[0].files'\n") +
      "\n## Of a run\n\n" + table_of(run_keys()) + "\n## Of a film\n\n" + table_of(film_keys());
  for (const JsonReport& report : json_reports())
    page += "\n## " + report.command + "\n\n" + (report.command == "simulate" ? "The keys of a run, and:\n\n" : "") +
            table_of(report.command == "simulate" ? Keys(report.keys.begin() + std::ptrdiff_t(run_keys().size()), report.keys.end()) : report.keys);
  return page;
}

}  // namespace chainreel
