// Expressions of an equation of motion in the form in which they are shortest: sums of polynomials in the parameters, each
// times the cosine or the sine of a sum of angles. Every product of cosines and sines has one such form, so that what is
// equal looks equal, and cos^2 + sin^2 is 1 by itself.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace chainreel {

// What a symbol stands for, in the order in which the factors of a product are written.
enum class SymbolKind { mass, inertia, damping, friction, length, gravity, position, rate };

struct Symbol {
  std::string letter;     // "m"
  std::string index;      // "1", "2,x"; "" for none
  SymbolKind kind = SymbolKind::mass;
  double value = 0;       // in SI units; of a position or rate none
  std::string unit;       // "kg"
  std::string meaning;    // "mass of upper_arm"

  bool is_coordinate() const { return kind == SymbolKind::position || kind == SymbolKind::rate; }
};

// A number as it is written: a fraction of small whole numbers where it is one.
struct Coefficient {
  double value = 0;
  long above = 0, below = 0;  // below 0: no such fraction
};

struct Monomial {
  Coefficient coefficient;
  std::vector<std::pair<int, int>> powers;  // index into the symbols, exponent; rising
};

enum class Wave { one, cosine, sine };

struct Term {
  Wave wave = Wave::one;
  std::vector<int> multiples;     // of the angles, one a coordinate; the first that is not 0 is positive
  std::vector<Monomial> factor;   // a sum, never empty
};

struct Formula {
  std::vector<Term> terms;  // rising by their multiples; none: zero

  bool is_zero() const { return terms.empty(); }
};

struct FormulaMatrix {
  int rows = 0, columns = 0;
  std::vector<Formula> entries;  // row by row

  const Formula& at(int row, int column) const { return entries[std::size_t(row * columns + column)]; }
  Formula& at(int row, int column) { return entries[std::size_t(row * columns + column)]; }
};

// The number that an formula is. `values`: one a symbol; `angles`: one a coordinate, rad.
double value_of(const Formula& formula, std::span<const double> values, std::span<const double> angles);

}  // namespace chainreel
