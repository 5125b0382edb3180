// Pages made of the registries of methods, functions, outputs and exit codes.
#include "app/film/formats.hpp"
#include "app/guide/reference.hpp"
#include "core/error.hpp"
#include "expr/expression.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {
namespace {

struct ExitRow {
  ExitCode code;
  const char* meaning;
};
constexpr ExitRow kExits[] = {{ExitCode::good, "good"},
                              {ExitCode::comparison_failed, "a comparison failed"},
                              {ExitCode::usage, "usage"},
                              {ExitCode::bad_input, "bad input"},
                              {ExitCode::no_renderer, "no renderer or codec"},
                              {ExitCode::numerical, "numerical failure"},
                              {ExitCode::file, "file or disk"},
                              {ExitCode::limit, "a limit exceeded: of the program's own, or of a joint where `expect: within_limits` stands"}};

std::string table_of(const char* what, std::span<const Name> names) {
  std::vector<std::vector<std::string>> table{{what, "what it is"}};
  for (const Name& one : names) table.push_back({code(one.name), one.meaning});
  return markdown_table(table);
}

}  // namespace

std::string order_words(const Method& method) {
  if (method.highest_order == 0) return std::to_string(method.order);
  return std::to_string(method.lowest_order) + "-" + std::to_string(method.highest_order);
}

std::string state_words(const Method& method) {
  switch (method.form) {
    case Form::second_order:
      return "q, qd";
    case Form::momenta:
      return "q, p";
    case Form::series:
      return "series";
    case Form::linked_points:
      return "points";
  }
  return "";
}

std::string exit_code_words() {
  std::string words;
  for (const ExitRow& row : kExits)
    words += (words.empty() ? "" : ", ") + std::to_string(int(row.code)) + " " + row.meaning;
  return words + ", 129, 130, 131 and 143 signals";
}

std::string methods_page() {
  std::vector<std::vector<std::string>> table{
      {"method", "order", "of dense output", "state", "step", "symplectic", "reversible", "kind", "source"}};
  for (const Method& method : methods())
    table.push_back({code(method.name), order_words(method), std::to_string(method.dense_order), state_words(method),
                     method.adaptive ? "`tolerance:` or `step:`" : "`step:`", method.symplectic ? "yes" : "",
                     method.reversible ? "yes" : "", method.kind, method.source});
  const SceneKey &step = *find_key("step"), &tolerance = *find_key("tolerance");
  return "# Methods\n\n"
         "`method: auto`, the default, takes the cheapest method and step that keep `accuracy:` at every point that can be\n"
         "seen, in every frame, where torques bend or jump, and halfway between, and curves of rates, torques, energies and multipliers to a like share of their range\n"
         "(`chainreel check` tells which candidate misses what). Any other is named, with a step or a tolerance:\n\n" +
         code_block("yaml", "method: dop853\ntolerance: 1e-11\n") + "\n" +
         "- `step`, where it is left out: " + step.absent + ".\n- `tolerance`, where it is left out: " + tolerance.absent +
         ".\n- `order` of methods with several, see the table; where it is left out: " + find_key("order")->absent + ".\n\n" + markdown_table(table) + "\nThe units of `accuracy`:\n\n" +
         table_of("unit", names_of(AccuracyUnit{})) + "\n" +
         code_block("yaml", "method: auto\naccuracy: 1e-3 m\n") +
         "\nWhat `expect:` says of a run:\n\n" + table_of("word", names_of(Outcome{}));
}

std::string expressions_page() {
  static constexpr Name variables[] = {
      {"t", "time, s"},
      {"q1 q2 ..", "joint positions, rad or m; of a floating base x y z and the quaternion's x y z w"},
      {"qd1 qd2 ..", "joint rates; of a floating base its twist in its own axes, linear then angular"},
      {"x_G y_G z_G", "place of the end effector in the world, m"},
      {"xd_G yd_G zd_G", "its velocity, m/s"},
      {"x_H .. zd_H", "the same of each name H of `frames:`"},
      {"k", "each name of `parameters:`"},
      {"lambda1 ..", "multipliers of the constraints' rows, N or N m, as tau = M qdd + nle + J_c^T lambda has them: what the robot presses on its ties with; in events and plots"},
      {"cop heel toe", "with a `foot:`: the centre of pressure and the foot's ends, m along the ground; in events and plots, whose curves end where the ground does not press within three lengths of the foot"},
      {"grf", "with a `foot:`: the force of the ground on the robot against gravity, N; below zero it would have to pull; in events and plots"},
      {"s", "in a constraint's curve: the way along it"},
      {"pi", "3.14159.."}};
  static constexpr Name operators[] = {{"+ - * /", ""},
                                       {"^", "power; binds to the right"},
                                       {"< <= > >= == !=", "1 where it holds, else 0"},
                                       {"( )", ""}};
  return "# Expressions\n\n"
         "Torques, references, events and plots may be expressions. They are in SI units and radians; of units a number may have `deg` or `rad`:\n"
         "`q1 - 45deg`.\n"
         "Where a torque has corners (comparisons, abs, min, max), steps end at them. Curves of plots are cut where they have a pole. An event is\n"
         "an instant at which its expression passes zero: one that only touches it, like abs(q1), is refused.\n\n" +
         table_of("name", variables) + "\n" + table_of("operator", operators) + "\n" +
         table_of("function", expression_functions()) + "\n" +
         code_block("yaml", "parameters: {k: 80, F: 0.5}\ntorque: [-k * (q1 - sin(2 * t)), -F * max(-1, min(1, qd2 / 0.01))]\n"
                            "events: [{when: \"y_G < 0.2\", kind: mark, name: low}]\nplot: [energy, \"x_G - 1\"]\n");
}

std::string outputs_page() {
  std::vector<Name> endings;
  for (const OutputFormat& row : output_formats()) endings.push_back({row.ending, row.told});
  return "# What can be written\n\n"
         "`-o` names a file by its ending, or a folder, and may stand several times: each frame is drawn once for all.\n"
         "Without it, `video.preset` decides.\n\n" +
         table_of("ending", endings) + "\n" + table_of("preset", names_of(Preset{})) + "\n" +
         code_block("yaml", "video: {width: 1280, height: 720, fps: 50, preset: web, crf: 24}\n") +
         "\nBeside a film lies NAME.json, its audit, and NAME.txt, its words; where events come or words are annotated NAME.srt, too, its captions.\n"
         "Where NAME.json tells of another film that is still there,\n"
         "x.mp4 beside the new x.gif, the audit of that is x.gif.json. The audit's `outputs` are its files, each with bytes, SHA-256 and,\n"
         "of clips, `frames`, `fps`, `width`, `height` and `film_seconds` of its own. Those on top of the audit are of the first clip that\n"
         "was asked for with -o and that the audit tells of; where that is a GIF or APNG, `drawn` has those of the frames that it was made\n"
         "of.\n"
         "`chainreel check out/rr.mp4` holds all of them against their SHA-256, and the audit against what the film remembers: exit code 1\n"
         "where anything was changed since. `chainreel check out/ --today` asks of each film, picture, figure and table there, and in its folders, whether its scene,\n"
         "model, tables, meshes and the program of today would make the same: exit code 1 and what has changed where they would not. The audit beside it\n"
         "tells which scene that is and what `--set` changed. Pictures of `snapshot` have none and say both themselves: the scene of that name is\n"
         "taken that lies nearest to them, and of figures and sheets the files of their commands, of which they remember what they said; elsewhere `--scene rr.yaml` names\n"
         "it. Beside a table that a command writes by itself, x.csv or x.json, lies the record x.csv.json or x.json.json, which says the same. Charts, which measure, are not asked about, which\n"
         "is said. It simulates and draws nothing, so that a folder of films is held against its scenes in seconds.\n\n"
         "What a command does not overwrite without `--force`: files outside of a folder named `out`.\n\n" +
         code_block("sh", "chainreel render rr_free -o out/rr.webm -o out/rr.gif\n");
}

std::string exit_codes_page() {
  std::vector<std::vector<std::string>> table{{"code", "what it says"}};
  for (const ExitRow& row : kExits) table.push_back({std::to_string(int(row.code)), row.meaning});
  table.push_back({"129, 130, 131, 143", "ended by SIGHUP, SIGINT, SIGQUIT, SIGTERM: what was begun is taken away"});
  return "# Exit codes\n\n" + markdown_table(table);
}

}  // namespace chainreel
