#include "symbols/notation.hpp"

#include "core/format.hpp"
#include "dynamics/friction.hpp"
#include "symbols/writer.hpp"

namespace chainreel {
namespace {

// Entries by name, one a line: M_11 = ..., those of a symmetric matrix once.
std::string entries_in_text(const Writer& writer, const std::string& letter, const FormulaMatrix& m) {
  std::string text;
  for (int r = 0; r < m.rows; ++r)
    for (int c = 0; c < m.columns; ++c) {
      const std::string place = std::to_string(r + 1) + std::to_string(c + 1);
      if (is_symmetric_in(letter) && c < r) continue;
      text += "  " + letter + "_" + place;
      if (is_symmetric_in(letter) && c > r) text += " = " + letter + "_" + std::to_string(c + 1) + std::to_string(r + 1);
      text += " = " + writer.write(m.at(r, c)) + "\n";
    }
  return text;
}

std::string list_in_text(const Writer& writer, const std::string& letter, const std::vector<Formula>& list) {
  std::string text;
  for (std::size_t i = 0; i < list.size(); ++i)
    text += "  " + letter + "_" + std::to_string(i + 1) + " = " + writer.write(list[i]) + "\n";
  return text;
}

std::string equation_in_text(const SymbolicEquation& equation, const std::string& q) {
  const bool dissipates = any(equation.damping) || any(equation.friction);
  return "tau = M(" + q + ") " + q + "dd + C(" + q + ", " + q + "d) " + q + "d + g(" + q + ")" + (dissipates ? " + tau_f(" + q + "d)" : "");
}

std::string dissipation_in_text(const Writer& writer, const SymbolicEquation& equation, const std::string& q) {
  if (!any(equation.damping) && !any(equation.friction)) return "";
  std::string text = "\ntau_f(" + q + "d):\n";
  for (std::size_t i = 0; i < equation.damping.size(); ++i) {
    const std::string sign = equation.friction[i].is_zero()
                                 ? ""
                                 : writer.write(equation.friction[i]) + " tanh(" + (equation.turns[i] ? q : std::string("q")) + "d_" + std::to_string(i + 1) + " / " +
                                       format_shortest(kFrictionSmoothing) + ")";
    const std::string linear = equation.damping[i].is_zero() ? "" : writer.write(equation.damping[i]);
    text += "  tau_f_" + std::to_string(i + 1) + " = " +
            (linear.empty() && sign.empty() ? "0" : linear + (!linear.empty() && !sign.empty() ? " + " : "") + sign) + "\n";
  }
  return text;
}

std::string task_in_text(const Writer& writer, const SymbolicEquation& equation, const EquationForm& form, const std::string& q) {
  if (equation.end_effector.empty()) return "";
  std::string text;
  if (form.has("J"))
    text += "\nJ(" + q + "), of " + equation.end_effector + " along " + joined(equation.axes) + ":\n" + entries_in_text(writer, "J", equation.J);
  if (!form.has("Lambda")) return text;
  if (!equation.Lambda)
    return text + "\nLambda(" + q + ") = (J M^-1 J^T)^-1, which has no short form: J is not square, nowhere regular, or its inverse is long\n";
  return text + "\nLambda(" + q + ") = J^-T M J^-1 = N / D^2:\n  D = " + writer.write(equation.Lambda->root) + "\n" +
         entries_in_text(writer, "N", equation.Lambda->numerator);
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

}  // namespace

std::string letter_of_all(const SymbolicEquation& equation, const std::string& angle) {
  return std::all_of(equation.turns.begin(), equation.turns.end(), [](bool turns) { return turns; }) ? angle : "q";
}

std::string symbol_in(Notation notation, const SymbolicEquation& equation, const Symbol& symbol, const std::string& angle) {
  return Writer(notation, equation, angle).name(symbol);
}

std::string formula_in(Notation notation, const SymbolicEquation& equation, const Formula& formula,
                          const std::string& angle) {
  return Writer(notation, equation, angle).write(formula);
}

std::string text_of(const SymbolicEquation& equation, const EquationForm& form) {
  const Writer writer(Notation::text, equation, form.angle);
  const std::string q = letter_of_all(equation, form.angle);
  std::string text = equation.model + ": " + equation_in_text(equation, q) + "\n";
  if (form.has("M")) text += "\nM(" + q + "):\n" + entries_in_text(writer, "M", equation.M);
  if (form.has("C")) text += "\nC(" + q + ", " + q + "d):\n" + entries_in_text(writer, "C", equation.C);
  if (form.has("g")) text += "\ng(" + q + "):\n" + list_in_text(writer, "g", equation.g);
  if (form.has("tau_f")) text += dissipation_in_text(writer, equation, q);
  text += task_in_text(writer, equation, form, q) + "\nwith\n";
  for (const Symbol& symbol : equation.symbols)
    text += "  " + padded(writer.name(symbol), 8) +
            (symbol.is_coordinate() ? padded("in " + symbol.unit, 24)
                                    : padded("= " + format_shortest(symbol.value) + " " + symbol.unit, 24)) +
            symbol.meaning + "\n";
  for (const std::string& note : equation.notes) text += "Note: " + note + ".\n";
  return text;
}

}  // namespace chainreel
