// An equation as LaTeX: formulas, and a document that can be typeset.
#include <algorithm>
#include <cctype>
#include <numeric>
#include <string_view>

#include "core/format.hpp"
#include "dynamics/friction.hpp"
#include "symbols/writer.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kLine = 130;  // characters of LaTeX that fill a page across
constexpr std::size_t kRow = 150;   // of the entries of a matrix, which have more of TeX's own words

// Behind "&= ": a long sum on lines of its own, each beginning with its sign.
std::string sum_on_lines(const std::string& sum) {
  std::string lines;
  std::size_t begin = 0, end = std::string::npos;
  int depth = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    depth += sum[i] == '(' || sum[i] == '{' ? 1 : sum[i] == ')' || sum[i] == '}' ? -1 : 0;
    if (depth == 0 && i > begin && (sum.compare(i, 3, " + ") == 0 || sum.compare(i, 3, " - ") == 0)) {
      if (end != std::string::npos && i - begin > kLine) {
        lines += sum.substr(begin, end - begin) + " \\\\\n  &\\quad ";
        begin = end + 1;
      }
      end = i;
    }
  }
  if (end != std::string::npos && end > begin && sum.size() - begin > kLine) {
    lines += sum.substr(begin, end - begin) + " \\\\\n  &\\quad ";
    begin = end + 1;
  }
  return lines + sum.substr(begin);
}

// Where its rows fit across a page a matrix, else a matrix of the entries' names, and one entry a line.
std::string matrix_in_latex(const Writer& writer, const std::string& letter, const FormulaMatrix& m) {
  std::string rows, names, lines;
  std::vector<std::size_t> widest(std::size_t(m.columns));
  for (int r = 0; r < m.rows; ++r)
    for (int c = 0; c < m.columns; ++c) {
      const std::string entry = writer.write(m.at(r, c));
      widest[std::size_t(c)] = std::max(widest[std::size_t(c)], entry.size());
      rows += (c > 0 ? " & " : r > 0 ? " \\\\\n  " : "  ") + entry;
      const auto place = [&](int a, int b) { return letter + "_{" + std::to_string(a + 1) + std::to_string(b + 1) + "}"; };
      const bool is_below = is_symmetric_in(letter) && c < r;
      names += (c > 0 ? " & " : r > 0 ? " \\\\ " : "") + (is_below ? place(c, r) : place(r, c));
      if (is_below) continue;
      lines += " \\\\\n  " + place(r, c) + " &= " + sum_on_lines(entry);
    }
  return std::accumulate(widest.begin(), widest.end(), std::size_t(0)) <= kRow
             ? letter + " = \\begin{bmatrix}\n" + rows + "\n\\end{bmatrix}"
             : "\\begin{aligned}\n  " + letter + " &= \\begin{bmatrix} " + names + " \\end{bmatrix}" + lines + "\n\\end{aligned}";
}

// Where an entry is too long for a line the entries by their numbers.
std::string vector_in_latex(const Writer& writer, const std::string& letter, const std::string& argument, const std::vector<Formula>& list) {
  std::string rows, lines;
  bool is_short = true;
  for (const Formula& e : list) {
    const std::string entry = writer.write(e), number = std::to_string(&e - list.data() + 1), next = rows.empty() ? "  " : " \\\\\n  ";
    is_short = is_short && entry.size() <= kLine;
    rows += next + entry;
    lines += next + letter + "_{" + number + "} &= " + sum_on_lines(entry);
  }
  return is_short ? letter + argument + " = \\begin{bmatrix}\n" + rows + "\n\\end{bmatrix}"
                  : "\\begin{aligned}\n" + lines + "\n\\end{aligned}";
}

// As a name of its own, not as a part of another one.
bool occurs(const std::string& text, const std::string& name) {
  const auto is_part = [&](std::size_t i) { return i < text.size() && (std::isalpha(static_cast<unsigned char>(text[i])) != 0 || text[i] == '\\'); };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if (!(at > 0 && is_part(at - 1)) && !is_part(at + name.size())) return true;
  return false;
}

std::string displayed(const std::string& formula) {
  return "\\[\n" + formula + "\n\\]\n";
}

std::string dissipation_in_latex(const Writer& writer, const SymbolicEquation& equation, const std::string& angle) {
  std::string lines;
  for (std::size_t i = 0; i < equation.damping.size(); ++i) {
    std::string entry = writer.write(equation.damping[i]);
    if (!equation.friction[i].is_zero()) {
      const std::string symbol = equation.turns[i] && angle == "theta" ? "\\theta" : "q";
      entry = (entry == "0" ? "" : entry + " + ") + writer.write(equation.friction[i]) + " \\tanh(\\dot{" + symbol + "}_{" +
              std::to_string(i + 1) + "} / v_0)";
    }
    lines += (i == 0 ? "  " : " \\\\\n  ") + entry;
  }
  return "\\tau_f = \\begin{bmatrix}\n" + lines + "\n\\end{bmatrix}";
}

}  // namespace

std::string latex_formulas_of(const SymbolicEquation& equation, const EquationForm& form) {
  const std::string& angle = form.angle;
  const Writer writer(Notation::latex, equation, angle);
  const bool dissipates = any(equation.damping) || any(equation.friction);
  const std::string q = letter_of_all(equation, angle) == "theta" ? "\\theta" : "q";
  const std::string qd = "\\dot{" + q + "}";
  std::string text;
  if (form.has("equation"))
    text += displayed("\\tau = M(" + q + ") \\ddot{" + q + "} + C(" + q + ", " + qd + ") " + qd + " + \\mathbf{g}(" + q + ")" +
                      (dissipates ? " + \\tau_f(" + qd + ")" : ""));
  if (form.has("M")) text += displayed(matrix_in_latex(writer, "M", equation.M));
  if (form.has("C")) text += displayed(matrix_in_latex(writer, "C", equation.C));
  if (form.has("g")) text += displayed(vector_in_latex(writer, "\\mathbf{g}", "(" + q + ")", equation.g));
  if (dissipates && form.has("tau_f")) text += displayed(dissipation_in_latex(writer, equation, angle));
  if (!equation.end_effector.empty() && form.has("J")) text += displayed(matrix_in_latex(writer, "J", equation.J));
  if (!equation.end_effector.empty() && form.has("Lambda")) {
    if (equation.Lambda)
      text += displayed("\\Lambda = J^{-T} M J^{-1} = N / D^{2}, \\quad D = " + writer.write(equation.Lambda->root)) +
              displayed(matrix_in_latex(writer, "N", equation.Lambda->numerator));
    else
      text += displayed("\\Lambda = (J M^{-1} J^{T})^{-1}");
  }
  return text;
}

std::string latex_of(const SymbolicEquation& equation, const EquationForm& form) {
  const Writer writer(Notation::latex, equation, form.angle);
  const std::string formulas = latex_formulas_of(equation, form);
  std::string text = "% " + equation.model + "\n" + formulas;
  for (const Symbol& symbol : equation.symbols)
    if (!symbol.is_coordinate() && occurs(formulas, writer.name(symbol)))
      text += "% " + writer.name(symbol) + " = " + format_shortest(symbol.value) + " " + symbol.unit + ", " + symbol.meaning + "\n";
  if (any(equation.friction)) text += "% v_0 = " + format_shortest(kFrictionSmoothing) + "\n";
  for (const std::string& note : equation.notes) text += "% " + note + "\n";
  return text;
}

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
  const std::string formulas = latex_formulas_of(equation, form);
  std::string text = "\\documentclass{article}\n\\usepackage[utf8]{inputenc}\n\\usepackage{amsmath}\n\\begin{document}\n\\section*{" +
                     escaped_for_latex(equation.model) + "}\n" + formulas +
                     "\\noindent\n\\begin{tabular}{@{}lll@{}}\n";
  const auto row = [&](const std::string& name, double value, const std::string& unit, const std::string& meaning) {
    text += "  $" + name + "$ & " + format_shortest(value) + " " + unit_in_latex(unit) + " & " + escaped_for_latex(meaning) + " \\\\\n";
  };
  for (const Symbol& symbol : equation.symbols)
    if (const std::string name = symbol_in(Notation::latex, equation, symbol, form.angle); !symbol.is_coordinate() && occurs(formulas, name))
      row(name, symbol.value, symbol.unit, symbol.meaning);
  if (std::any_of(equation.friction.begin(), equation.friction.end(), [](const Formula& f) { return !f.is_zero(); })) row("v_0", kFrictionSmoothing, "", "width of the step of friction");
  text += "\\end{tabular}\n";
  for (const std::string& note : equation.notes) text += "\n\\noindent " + escaped_for_latex(note) + ".\n";
  return text + "\\end{document}\n";
}

}  // namespace chainreel
