#include <algorithm>
#include <string_view>

#include "core/format.hpp"
#include "dynamics/friction.hpp"
#include "symbols/notation.hpp"

namespace chainreel {
namespace {

// What names and notes are made of, as words of a document.
std::string escaped_for_latex(const std::string& words) {
  std::string text;
  for (const char c : words) {
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos)
      text += std::string("\\") + c;
    else if (c == '^')
      text += "\\textasciicircum{}";
    else if (c == '~')
      text += "\\textasciitilde{}";
    else
      text += c == '\\' ? std::string("\\textbackslash{}") : std::string(1, c);
  }
  return text;
}

// "m/s^2" with its power raised.
std::string unit_in_latex(const std::string& unit) {
  const std::size_t power = unit.find('^');
  if (power == std::string::npos) return escaped_for_latex(unit);
  return escaped_for_latex(unit.substr(0, power)) + "$^{" + unit.substr(power + 1) + "}$";
}

}  // namespace

std::string latex_document_of(const SymbolicEquation& equation, const EquationForm& form) {
  std::string text = "\\documentclass{article}\n\\usepackage[utf8]{inputenc}\n\\usepackage{amsmath}\n\\begin{document}\n\\section*{" +
                     escaped_for_latex(equation.model) + "}\n" + latex_formulas_of(equation, form) +
                     "\\noindent\n\\begin{tabular}{@{}lll@{}}\n";
  const auto row = [&](const std::string& name, double value, const std::string& unit, const std::string& meaning) {
    text += "  $" + name + "$ & " + format_shortest(value) + " " + unit_in_latex(unit) + " & " + escaped_for_latex(meaning) + " \\\\\n";
  };
  for (const Symbol& symbol : equation.symbols)
    if (!symbol.is_coordinate()) row(symbol_in(Notation::latex, equation, symbol, form.angle), symbol.value, symbol.unit, symbol.meaning);
  if (std::any_of(equation.friction.begin(), equation.friction.end(), [](const Formula& f) { return !f.is_zero(); })) row("v_0", kFrictionSmoothing, "", "width of the step of friction");
  text += "\\end{tabular}\n";
  for (const std::string& note : equation.notes) text += "\n\\noindent " + escaped_for_latex(note) + ".\n";
  return text + "\\end{document}\n";
}

}  // namespace chainreel
