// An equation as a module of Python.
#include "core/format.hpp"
#include "dynamics/effective_mass.hpp"
#include "dynamics/friction.hpp"
#include "symbols/writer.hpp"

namespace chainreel {
namespace {

std::string matrix_in_python(const Writer& writer, const FormulaMatrix& m) {
  std::string text = "np.array([";
  for (int r = 0; r < m.rows; ++r) {
    text += r == 0 ? "\n        [" : ",\n        [";
    for (int c = 0; c < m.columns; ++c) text += (c == 0 ? "" : ",\n         ") + writer.write(m.at(r, c));
    text += "]";
  }
  return text + "], dtype=float)";
}

std::string function_in_python(const std::string& head, const std::string& doc, const std::string& value) {
  return "\n\ndef " + head + ":\n    \"\"\"" + doc + "\"\"\"\n    return " + value + "\n";
}

std::string vector_in_python(const Writer& writer, const std::vector<Formula>& list) {
  std::string text = "np.array([";
  for (std::size_t i = 0; i < list.size(); ++i) text += (i == 0 ? "\n        " : ",\n        ") + writer.write(list[i]);
  return text + "], dtype=float)";
}

// The quotient alone would be a number at every pose near which rounding leaves one.
std::string lambda_in_python(const Writer& writer, const SymbolicEquation& equation) {
  const std::string fraction = format_shortest(kSingularFraction);
  std::string text = "\n\ndef Lambda(q):\n    \"\"\"The effective mass of " + equation.end_effector +
                     (equation.Lambda ? ", J^-T M J^-1" : ", (J M^-1 J^T)^-1") + ". ValueError at poses where it is infinite in some\n"
                     "    direction: there J M^-1 J^T has an eigenvalue below " + fraction + " of the largest.\"\"\"\n"
                     "    mobility = J(q) @ np.linalg.solve(M(q), J(q).T)\n"
                     "    values = np.linalg.eigvalsh(mobility)\n"
                     "    if not values[0] > " + fraction + " * values[-1]:\n"
                     "        raise ValueError(\"no Lambda at this pose: the effective mass of the end effector is infinite in \"\n"
                     "                         \"some direction\")\n";
  if (!equation.Lambda) return text + "    return np.linalg.inv(mobility)\n";
  return text + "    return " + matrix_in_python(writer, equation.Lambda->numerator) + " / (" + writer.write(equation.Lambda->root) +
         ")**2\n";
}

std::string dissipation_in_python(const Writer& writer, const SymbolicEquation& equation) {
  std::string text = "np.array([";
  for (std::size_t i = 0; i < equation.damping.size(); ++i) {
    text += i == 0 ? "\n        " : ",\n        ";
    text += writer.write(equation.damping[i]);
    if (!equation.friction[i].is_zero())
      text += " + " + writer.write(equation.friction[i]) + "*np.tanh(qd[" + std::to_string(i) + "]/" +
              format_shortest(kFrictionSmoothing) + ")";
  }
  return text + "], dtype=float)";
}

}  // namespace

std::string python_of(const SymbolicEquation& equation) {
  const Writer writer(Notation::python, equation, "q");
  std::string text = "\"\"\"" + equation.model + ": tau = M(q) qdd + C(q, qd) qd + g(q) + tau_f(qd), in SI units and radians.\"\"\"\n"
                     "import numpy as np\nfrom numpy import cos, sin\n\n";
  for (const Symbol& symbol : equation.symbols)
    if (!symbol.is_coordinate())
      text += writer.name(symbol) + " = " + format_shortest(symbol.value) + "  # " + symbol.unit + ", " + symbol.meaning + "\n";
  for (const std::string& note : equation.notes) text += "# " + note + "\n";
  const std::string n = std::to_string(equation.coordinates.size()), square = "(" + n + ", " + n + ")";
  text += function_in_python("M(q)", "The mass matrix, " + square + ".", matrix_in_python(writer, equation.M));
  text += function_in_python("C(q, qd)", "Coriolis and centrifugal forces are C qd, " + square + ".",
                             matrix_in_python(writer, equation.C));
  text += function_in_python("g(q)", "Forces that hold the chain against gravity, (" + n + ",).", vector_in_python(writer, equation.g));
  text += function_in_python("tau_f(qd)", "Friction of the joints, (" + n + ",).", dissipation_in_python(writer, equation));
  text += function_in_python("forward(q, qd, tau)", "The acceleration qdd, (" + n + ",).",
                             "np.linalg.solve(M(q), tau - C(q, qd) @ qd - g(q) - tau_f(qd))");
  if (equation.end_effector.empty()) return text;
  text += function_in_python("J(q)", "The Jacobian of the position of " + equation.end_effector + ", along " + joined(equation.axes) + ".", matrix_in_python(writer, equation.J));
  return text + lambda_in_python(writer, equation);
}

}  // namespace chainreel
