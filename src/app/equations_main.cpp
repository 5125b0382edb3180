// chainreel-equations: the one command that computes in symbols.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>
#include <utility>

#include "app/cli/result.hpp"
#include "app/commands/equations_command.hpp"
#include "app/film/model_scene.hpp"
#include "app/film/prepared.hpp"
#include "app/main_program.hpp"
#include "app/report/run_report.hpp"
#include "app/today/table_record.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/json.hpp"
#include "core/output_file.hpp"
#include "model/read_chain.hpp"
#include "symbols/notation.hpp"

namespace chainreel {
namespace {

std::vector<std::string> overrides_of(const EquationsOptions& options) {
  std::vector<std::string> overrides = overrides_of(options.common);
  if (!options.gravity.empty()) overrides.push_back(gravity_override(options.gravity));
  if (!options.end_effector.empty()) overrides.push_back("end_effector=" + Json(options.end_effector).dump());
  return overrides;
}

// The equation of the mechanism of a model, or of a scene's with what the scene says of it.
SymbolicEquation equation_of(const EquationsOptions& options) {
  if (is_model_file(options.file)) {
    if (options.panel > 0) throw Error(ExitCode::usage, "--panel goes with a scene");
    std::vector<std::string> honoured = keys_of_models(OfModel::mechanism);
    honoured.push_back("end_effector");
    ModelScene model = model_scene_of(options.file, overrides_of(options), "equations", honoured);
    model.options.meshes = false;
    const Chain chain = read_chain(options.file, model.options);
    tell_warnings(chain.slips);
    return symbolic_equation_of(chain);
  }
  const PreparedFilm film = load_film(options.file, overrides_of(options), false);
  const Simulation& simulation = film.panels[chosen_panel(film.scene, options.panel)].simulation;
  SymbolicEquation equation = symbolic_equation_of(simulation.chain);
  if (!simulation.constraints.empty())
    equation.notes.push_back("the scene's constraints are not in it: they add J_c^T lambda to tau");
  return equation;
}

Json matrix_json(const SymbolicEquation& equation, const FormulaMatrix& m) {
  Json rows = Json::array();
  for (int r = 0; r < m.rows; ++r) {
    Json row = Json::array();
    for (int c = 0; c < m.columns; ++c) row.push_back(formula_in(Notation::text, equation, m.at(r, c)));
    rows.push_back(row);
  }
  return rows;
}

Json list_json(const SymbolicEquation& equation, const std::vector<Formula>& list) {
  Json entries = Json::array();
  for (const Formula& e : list) entries.push_back(formula_in(Notation::text, equation, e));
  return entries;
}

Json json_of(const SymbolicEquation& equation) {
  Json json{{"model", equation.model}, {"coordinates", equation.coordinates}};
  json["M"] = matrix_json(equation, equation.M);
  json["C"] = matrix_json(equation, equation.C);
  json["g"] = list_json(equation, equation.g);
  json["damping"] = list_json(equation, equation.damping);
  json["friction"] = list_json(equation, equation.friction);
  if (!equation.end_effector.empty()) {
    json["end_effector"] = equation.end_effector;
    json["J"] = matrix_json(equation, equation.J);
    json["Lambda"] = nullptr;
    if (equation.Lambda)
      json["Lambda"] = {{"numerator", matrix_json(equation, equation.Lambda->numerator)},
                        {"root_of_denominator", formula_in(Notation::text, equation, equation.Lambda->root)}};
  }
  json["symbols"] = Json::array();
  for (const Symbol& symbol : equation.symbols)
    if (!symbol.is_coordinate())
      json["symbols"].push_back({{"letter", symbol.letter},
                                 {"index", symbol.index},
                                 {"value", symbol.value},
                                 {"unit", symbol.unit},
                                 {"meaning", symbol.meaning}});
  json["notes"] = equation.notes;
  return json;
}

enum class Form { text, latex, document, python, json };

// What flags ask for, or else a file's ending: one of them. "": standard output.
Form form_of(const EquationsOptions& options, const std::string& output) {
  std::set<Form> asked;
  if (options.latex && !options.document) asked.insert(Form::latex);
  if (options.python) asked.insert(Form::python);
  // Of a file, --json tells on standard output what is in it.
  if (options.common.json && output.empty()) asked.insert(Form::json);
  const std::string ending = lower_case_ending(output);
  if (options.document && (output.empty() || output == "-" || ending == ".tex")) asked.insert(Form::document);
  const std::pair<const char*, Form> endings[] = {{".tex", options.document ? Form::document : Form::latex}, {".py", Form::python}, {".json", Form::json}};
  for (const auto& [name, form] : endings)
    if (ending == name) asked.insert(form);
  if (asked.empty() && !output.empty() && output != "-" && ending != ".txt")
    throw Error(ExitCode::usage, "-o " + output + ": give it the ending .tex, .py, .json or .txt");
  if (asked.size() > 1)
    throw Error(ExitCode::usage, "--latex (.tex, maybe as --document), --python (.py) and JSON are three forms of one thing: take one of them for each file");
  return asked.empty() ? Form::text : *asked.begin();
}

std::string text_in(Form form, const SymbolicEquation& equation, const EquationForm& words) {
  switch (form) {
    case Form::text: break;
    case Form::latex: return latex_of(equation, words);
    case Form::document: return latex_document_of(equation, words);
    case Form::python: return python_of(equation);
    case Form::json: return json_of(equation).dump(2) + "\n";
  }
  return text_of(equation, words);
}

std::vector<std::string> parts_of(const std::string& only) {
  const std::vector<std::string> all(std::begin(kEquationParts), std::end(kEquationParts));
  std::vector<std::string> parts;
  if (only.empty()) return parts;
  for (const std::string& part : separated(only, ',')) {
    if (std::find(all.begin(), all.end(), part) == all.end())
      throw Error(ExitCode::usage, "--only " + only + ": '" + part + "' is no part of the equation:" + did_you_mean(part, all) + " There are " + joined(all));
    parts.push_back(part);
  }
  return parts;
}

// The equation says nothing to who does not know what stands in it.
void tell_missing(const EquationsOptions& options, const EquationForm& form, const SymbolicEquation& equation) {
  if (options.only.empty() || !form.has("equation") || options.common.quiet) return;
  const auto is_any = [](const std::vector<Formula>& all) { return std::any_of(all.begin(), all.end(), [](const Formula& one) { return !one.is_zero(); }); };
  std::vector<std::string> parts = separated(options.only, ','), missing;
  for (const char* part : {"M", "C", "g", "tau_f"})
    if (!form.has(part) && (std::string(part) != "tau_f" || is_any(equation.damping) || is_any(equation.friction))) missing.push_back(part);
  if (missing.empty()) return;
  parts.insert(parts.end(), missing.begin(), missing.end());
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ",") + part;
  std::fprintf(stderr, "note: the equation holds %s, which --only leaves out: --only %s has all of it\n", joined(missing, ", ").c_str(), all.c_str());
}

void run_equations(const EquationsOptions& options) {
  const std::vector<std::string> outputs = options.outputs.empty() ? std::vector<std::string>{""} : options.outputs;
  std::vector<Form> forms;
  for (const std::string& output : outputs) forms.push_back(form_of(options, output));
  const auto has_words = [](Form form) { return form == Form::text || form == Form::latex || form == Form::document; };
  if (options.document && std::find(forms.begin(), forms.end(), Form::document) == forms.end())
    throw Error(ExitCode::usage, "--document is for LaTeX: no -o names a .tex file");
  if (options.theta && std::none_of(forms.begin(), forms.end(), has_words))
    throw Error(ExitCode::usage, "--theta is for text and LaTeX: the angles are q in Python and JSON");
  if (!options.only.empty() && std::none_of(forms.begin(), forms.end(), has_words))
    throw Error(ExitCode::usage, "--only is for text and LaTeX: Python and JSON hold all");
  const EquationForm words{options.theta ? "theta" : "q", parts_of(options.only)};
  std::vector<std::unique_ptr<OutputFile>> files;
  refuse_twice(options.outputs);
  for (const std::string& path : options.outputs) files.push_back(std::make_unique<OutputFile>(path, options.common.force));
  TableRecords records(*options.command, options.common.force);
  records.open(options.outputs, options.outputs);
  const SymbolicEquation equation = equation_of(options);
  tell_missing(options, words, equation);
  if (files.empty() && !options.common.json)
    return void(std::fputs(text_in(forms[0], equation, words).c_str(), stdout));
  for (std::size_t i = 0; i < files.size(); ++i) write_temporary(*files[i], text_in(forms[i], equation, words));
  for (const auto& file : files) file->commit();
  records.write();
  if (options.common.json) tell_files(options.common, options.outputs, [&] { return json_of(equation); });
}

void add_commands(CommandLine& app) {
  add_equations_command(app, run_equations);
}

}  // namespace
}  // namespace chainreel

int main(int argc, char** argv) {
  return chainreel::main_program(argc, argv, chainreel::add_commands);
}
