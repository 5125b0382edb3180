// An equation of motion as text, as LaTeX and as a module of Python.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "symbols/equation.hpp"

namespace chainreel {

enum class Notation { text, latex, python };

// The letter of all coordinates together: `angle` where all of them turn, else "q".
std::string letter_of_all(const SymbolicEquation& equation, const std::string& angle);

// `angle`: "q" or "theta", the letter of coordinates that turn; in Python q is an array of all.
std::string formula_in(Notation notation, const SymbolicEquation& equation, const Formula& formula,
                          const std::string& angle = "q");

std::string symbol_in(Notation notation, const SymbolicEquation& equation, const Symbol& symbol, const std::string& angle = "q");

// What text and LaTeX can hold of an equation.
inline constexpr const char* kEquationParts[] = {"equation", "M", "C", "g", "tau_f", "J", "Lambda"};

struct EquationForm {
  std::string angle = "q";  // or "theta"
  std::vector<std::string> parts;  // of kEquationParts; empty: all

  bool has(const char* part) const { return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end(); }
};

// The whole of it, lines that end; with the values of its symbols.
std::string text_of(const SymbolicEquation& equation, const EquationForm& form = {});
std::string latex_of(const SymbolicEquation& equation, const EquationForm& form = {});
std::string latex_formulas_of(const SymbolicEquation& equation, const EquationForm& form = {});  // without values
std::string latex_document_of(const SymbolicEquation& equation, const EquationForm& form = {});  // to be typeset as it is
std::string python_of(const SymbolicEquation& equation);

}  // namespace chainreel
