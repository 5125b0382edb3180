#include "symbols/notation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/format.hpp"
#include "dynamics/effective_mass.hpp"
#include "dynamics/friction.hpp"

namespace chainreel {
namespace {

// A part of a sum without its sign.
struct Piece {
  bool minus = false;
  std::string words;
};

std::string sum_of(const std::vector<Piece>& pieces) {
  if (pieces.empty()) return "0";
  std::string sum;
  for (const Piece& piece : pieces)
    sum += sum.empty() ? (piece.minus ? "-" : "") + piece.words : (piece.minus ? " - " : " + ") + piece.words;
  return sum;
}

std::string without_comma(std::string index) {
  std::erase(index, ',');
  return index;
}

class Writer {
 public:
  Writer(Notation notation, const SymbolicEquation& equation, const std::string& angle)
      : notation_(notation), equation_(equation), angle_(angle) {}

  std::string name(const Symbol& symbol) const {
    if (symbol.is_coordinate()) return coordinate(std::stoul(symbol.index) - 1, symbol.kind == SymbolKind::rate);
    // In Python g is the function.
    if (symbol.index.empty()) return notation_ == Notation::python ? "gravity" : symbol.letter;
    return notation_ == Notation::latex ? symbol.letter + "_{" + symbol.index + "}"
                                        : symbol.letter + "_" + without_comma(symbol.index);
  }

  std::string write(const Formula& formula) const {
    std::vector<Piece> pieces;
    for (const Term& term : formula.terms)
      if (term.wave == Wave::one)
        for (const Piece& piece : grouped(term.factor, {})) pieces.push_back(piece);
      else
        pieces.push_back(wave_piece(term));
    return sum_of(pieces);
  }

 private:
  using Powers = std::vector<std::pair<int, int>>;
  // What a product consists of, with the kind by which it is put in order.
  using Factors = std::vector<std::pair<int, std::string>>;
  static constexpr int kLast = 100;
  static constexpr Coefficient kOne{1, 1, 1};

  // Zero-based.
  std::string coordinate(std::size_t i, bool rate) const {
    const bool turns = equation_.turns[i];
    const std::string letter = turns ? angle_ : "q", number = std::to_string(i + 1);
    if (notation_ == Notation::python) return (rate ? "qd[" : "q[") + std::to_string(i) + "]";
    if (notation_ == Notation::text) return letter + (rate ? "d_" : "_") + number;
    const std::string symbol = letter == "theta" ? "\\theta" : letter;
    return (rate ? "\\dot{" + symbol + "}" : symbol) + "_{" + number + "}";
  }

  std::string power(const std::string& base, int exponent) const {
    if (exponent == 1) return base;
    const std::string e = std::to_string(exponent);
    return notation_ == Notation::python ? base + "**" + e : notation_ == Notation::latex ? base + "^{" + e + "}" : base + "^" + e;
  }

  int rank(int symbol) const { return int(equation_.symbols[std::size_t(symbol)].kind); }

  void add(Factors& factors, const Powers& powers) const {
    for (const auto& [symbol, exponent] : powers)
      factors.emplace_back(rank(symbol), power(name(equation_.symbols[std::size_t(symbol)]), exponent));
  }

  // The absolute value of a coefficient; "" for 1.
  std::string number(const Coefficient& c) const {
    if (c.below == 0) return format_significant(std::abs(c.value), notation_ == Notation::python ? 17 : 6);
    const std::string above = std::to_string(std::labs(c.above)), below = std::to_string(c.below);
    if (c.below == 1) return above == "1" ? "" : above;
    return notation_ == Notation::latex ? "\\tfrac{" + above + "}{" + below + "}" : above + "/" + below;
  }

  std::string product(const Coefficient& c, Factors factors) const {
    std::stable_sort(factors.begin(), factors.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string words = number(c);
    const char* const times = notation_ == Notation::python ? "*" : " ";
    for (const auto& factor : factors) words += (words.empty() ? "" : times) + factor.second;
    return words.empty() ? "1" : words;
  }

  // The same sum with the symbols of one kind, or of two, taken together: (m_1 + m_2) L_1^2.
  struct Group {
    Powers outside;
    std::vector<Monomial> inside;
  };
  std::vector<Group> group_by(const std::vector<Monomial>& sum, SymbolKind kind) const {
    const auto is_inside = [&](int symbol) {
      const SymbolKind own = equation_.symbols[std::size_t(symbol)].kind;
      return own == kind || (kind == SymbolKind::mass && own == SymbolKind::inertia);
    };
    std::vector<Group> groups;
    for (const Monomial& monomial : sum) {
      Powers outside;
      Monomial inside{monomial.coefficient, {}};
      for (const auto& p : monomial.powers) (is_inside(p.first) ? inside.powers : outside).push_back(p);
      auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.outside == outside; });
      if (group == groups.end()) group = groups.insert(groups.end(), Group{outside, {}});
      group->inside.push_back(inside);
    }
    return groups;
  }

  // Sums as short as one kind of symbols makes them, each times `factors`.
  std::vector<Piece> grouped(const std::vector<Monomial>& sum, const Factors& factors) const {
    std::vector<Group> best;
    SymbolKind by = SymbolKind::mass;
    for (const SymbolKind kind : {SymbolKind::mass, SymbolKind::rate, SymbolKind::length}) {
      std::vector<Group> groups = group_by(sum, kind);
      if (best.empty() || groups.size() < best.size()) best = std::move(groups), by = kind;
    }
    if (const auto one = as_product(best, by, factors)) return {*one};
    std::vector<Piece> pieces;
    for (const Group& group : best) {
      Factors all = factors;
      add(all, group.outside);
      const Coefficient& first = group.inside[0].coefficient;
      if (group.inside.size() == 1) {
        add(all, group.inside[0].powers);
        pieces.push_back({first.value < 0, product(first, all)});
        continue;
      }
      const auto [before, inner] = sum_in_parentheses(group.inside);
      if (all.empty() && before.value == 1) {
        pieces.insert(pieces.end(), inner.begin(), inner.end());
        continue;
      }
      all.emplace_back(int(by), "(" + sum_of(inner) + ")");
      pieces.push_back({before.value < 0, product(before, all)});
    }
    return pieces;
  }

  // The number that all parts of a sum have, with the sign of the first, and what is left of them.
  std::pair<Coefficient, std::vector<Piece>> sum_in_parentheses(const std::vector<Monomial>& sum) const {
    const Coefficient& first = sum[0].coefficient;
    const bool alike = std::all_of(sum.begin(), sum.end(), [&](const Monomial& m) {
      return std::abs(m.coefficient.value) == std::abs(first.value);
    });
    std::vector<Piece> inner;
    for (const Monomial& m : sum) {
      Factors own;
      add(own, m.powers);
      const bool minus = (m.coefficient.value < 0) != (first.value < 0);
      inner.push_back({minus, product(alike ? kOne : m.coefficient, own)});
    }
    return {alike ? first : Coefficient{first.value < 0 ? -1.0 : 1.0, 1, 1}, inner};
  }

  // (m_2 / 2 + m_3) (qd_1 + qd_2), where the groups differ by what is outside alone.
  std::optional<Piece> as_product(const std::vector<Group>& groups, SymbolKind by, const Factors& factors) const {
    if (groups.size() < 2 || groups[0].inside.size() < 2) return std::nullopt;
    std::vector<Monomial> outside;
    for (const Group& group : groups) {
      if (group.inside.size() != groups[0].inside.size()) return std::nullopt;
      const double ratio = group.inside[0].coefficient.value / groups[0].inside[0].coefficient.value;
      if (std::abs(ratio) != 1) return std::nullopt;
      for (std::size_t i = 0; i < group.inside.size(); ++i)
        if (group.inside[i].powers != groups[0].inside[i].powers ||
            group.inside[i].coefficient.value != ratio * groups[0].inside[i].coefficient.value)
          return std::nullopt;
      outside.push_back({{ratio, long(ratio), 1}, group.outside});
    }
    const auto [before, inner] = sum_in_parentheses(groups[0].inside);
    const auto [none, other] = sum_in_parentheses(outside);
    Factors all = factors;
    all.emplace_back(int(by), "(" + sum_of(inner) + ")");
    all.emplace_back(outside[0].powers.empty() ? kLast - 1 : rank(outside[0].powers.back().first), "(" + sum_of(other) + ")");
    return Piece{before.value < 0, product(before, all)};
  }

  std::string angle_of(const Term& term) const {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < term.multiples.size(); ++i) {
      const int k = term.multiples[i];
      if (k == 0) continue;
      const std::string times = notation_ == Notation::python ? "*" : " ";
      pieces.push_back({k < 0, (std::abs(k) == 1 ? "" : std::to_string(std::abs(k)) + times) + coordinate(i, false)});
    }
    return sum_of(pieces);
  }

  std::string wave_of(const Term& term) const {
    const std::string wave = term.wave == Wave::cosine ? "cos" : "sin", angle = angle_of(term);
    if (notation_ != Notation::latex) return wave + "(" + angle + ")";
    return "\\" + wave + (angle.find(' ') == std::string::npos ? " " + angle : "(" + angle + ")");
  }

  // One product: what all parts of the sum have stands before it.
  Piece wave_piece(const Term& term) const {
    std::map<int, int> common(term.factor[0].powers.begin(), term.factor[0].powers.end());
    for (const Monomial& monomial : term.factor) {
      const std::map<int, int> own(monomial.powers.begin(), monomial.powers.end());
      std::erase_if(common, [&](const auto& p) { return !own.contains(p.first); });
      for (auto& [symbol, exponent] : common) exponent = std::min(exponent, own.at(symbol));
    }
    std::vector<Monomial> rest = term.factor;
    for (Monomial& monomial : rest) {
      for (auto& [symbol, exponent] : monomial.powers)
        if (const auto c = common.find(symbol); c != common.end()) exponent -= c->second;
      std::erase_if(monomial.powers, [](const auto& p) { return p.second == 0; });
    }
    Factors factors{{kLast, wave_of(term)}};
    add(factors, Powers(common.begin(), common.end()));
    const std::vector<Piece> whole = grouped(rest, factors);
    if (whole.size() == 1) return whole[0];
    std::vector<Piece> inner = grouped(rest, {});
    const bool minus = inner[0].minus;
    for (Piece& piece : inner) piece.minus = piece.minus != minus;
    factors.emplace_back(int(SymbolKind::length), "(" + sum_of(inner) + ")");
    return {minus, product(kOne, factors)};
  }

  Notation notation_;
  const SymbolicEquation& equation_;
  std::string angle_;
};

bool is_symmetric_in(const std::string& matrix) {
  return matrix == "M" || matrix == "N";
}

bool any(const std::vector<Formula>& formulas) {
  return std::any_of(formulas.begin(), formulas.end(), [](const Formula& e) { return !e.is_zero(); });
}

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

std::string equation_in_text(const SymbolicEquation& equation) {
  const bool dissipates = any(equation.damping) || any(equation.friction);
  return std::string("tau = M(q) qdd + C(q, qd) qd + g(q)") + (dissipates ? " + tau_f(qd)" : "");
}

std::string dissipation_in_text(const Writer& writer, const SymbolicEquation& equation) {
  if (!any(equation.damping) && !any(equation.friction)) return "";
  std::string text = "\ntau_f(qd):\n";
  for (std::size_t i = 0; i < equation.damping.size(); ++i) {
    const std::string sign = equation.friction[i].is_zero()
                                 ? ""
                                 : writer.write(equation.friction[i]) + " tanh(qd_" + std::to_string(i + 1) + " / " +
                                       format_shortest(kFrictionSmoothing) + ")";
    const std::string linear = equation.damping[i].is_zero() ? "" : writer.write(equation.damping[i]);
    text += "  tau_f_" + std::to_string(i + 1) + " = " +
            (linear.empty() && sign.empty() ? "0" : linear + (!linear.empty() && !sign.empty() ? " + " : "") + sign) + "\n";
  }
  return text;
}

std::string task_in_text(const Writer& writer, const SymbolicEquation& equation, const EquationForm& form) {
  if (equation.end_effector.empty()) return "";
  std::string text;
  if (form.has("J"))
    text += "\nJ(q), of " + equation.end_effector + " along " + joined(equation.axes) + ":\n" + entries_in_text(writer, "J", equation.J);
  if (!form.has("Lambda")) return text;
  if (!equation.Lambda)
    return text + "\nLambda(q) = (J M^-1 J^T)^-1, which has no short form: J is not square, nowhere regular, or its inverse is long\n";
  return text + "\nLambda(q) = J^-T M J^-1 = N / D^2:\n  D = " + writer.write(equation.Lambda->root) + "\n" +
         entries_in_text(writer, "N", equation.Lambda->numerator);
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

}  // namespace

std::string symbol_in(Notation notation, const SymbolicEquation& equation, const Symbol& symbol, const std::string& angle) {
  return Writer(notation, equation, angle).name(symbol);
}

std::string formula_in(Notation notation, const SymbolicEquation& equation, const Formula& formula,
                          const std::string& angle) {
  return Writer(notation, equation, angle).write(formula);
}

std::string text_of(const SymbolicEquation& equation, const EquationForm& form) {
  const Writer writer(Notation::text, equation, form.angle);
  std::string text = equation.model + ": " + equation_in_text(equation) + "\n";
  if (form.has("M")) text += "\nM(q):\n" + entries_in_text(writer, "M", equation.M);
  if (form.has("C")) text += "\nC(q, qd):\n" + entries_in_text(writer, "C", equation.C);
  if (form.has("g")) text += "\ng(q):\n" + list_in_text(writer, "g", equation.g);
  if (form.has("tau_f")) text += dissipation_in_text(writer, equation);
  text += task_in_text(writer, equation, form) + "\nwith\n";
  for (const Symbol& symbol : equation.symbols)
    text += "  " + padded(writer.name(symbol), 8) +
            (symbol.is_coordinate() ? padded("in " + symbol.unit, 24)
                                    : padded("= " + format_shortest(symbol.value) + " " + symbol.unit, 24)) +
            symbol.meaning + "\n";
  for (const std::string& note : equation.notes) text += "Note: " + note + ".\n";
  return text;
}

namespace {

constexpr std::size_t kLine = 130;  // characters of LaTeX that fill a page across

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

// Where every entry is short a matrix, else one entry a line.
std::string matrix_in_latex(const Writer& writer, const std::string& letter, const FormulaMatrix& m) {
  constexpr std::size_t kShort = 60;  // characters of LaTeX: three such columns fill a page
  std::string rows, lines;
  bool is_short = true;
  for (int r = 0; r < m.rows; ++r)
    for (int c = 0; c < m.columns; ++c) {
      const std::string entry = writer.write(m.at(r, c));
      is_short = is_short && entry.size() <= kShort;
      rows += (c > 0 ? " & " : r > 0 ? " \\\\\n  " : "  ") + entry;
      if (is_symmetric_in(letter) && c < r) continue;
      const auto place = [&](int a, int b) { return letter + "_{" + std::to_string(a + 1) + std::to_string(b + 1) + "}"; };
      lines += (lines.empty() ? "  " : " \\\\\n  ") + place(r, c);
      if (is_symmetric_in(letter) && c > r) lines += " = " + place(c, r);
      lines += " &= " + sum_on_lines(entry);
    }
  return is_short ? letter + " = \\begin{bmatrix}\n" + rows + "\n\\end{bmatrix}"
                  : "\\begin{aligned}\n" + lines + "\n\\end{aligned}";
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
  const std::string q = std::all_of(equation.turns.begin(), equation.turns.end(), [](bool b) { return b; }) && angle == "theta"
                            ? "\\theta"
                            : "q";
  const std::string qd = "\\dot{" + q + "}";
  std::string text;
  if (form.parts.empty())
    text += displayed("\\tau = M(" + q + ") \\ddot{" + q + "} + C(" + q + ", " + qd + ") " + qd + " + g(" + q + ")" +
                      (dissipates ? " + \\tau_f(" + qd + ")" : ""));
  if (form.has("M")) text += displayed(matrix_in_latex(writer, "M", equation.M));
  if (form.has("C")) text += displayed(matrix_in_latex(writer, "C", equation.C));
  if (form.has("g")) text += displayed(vector_in_latex(writer, "g", "(" + q + ")", equation.g));
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
  std::string text = "% " + equation.model + "\n" + latex_formulas_of(equation, form);
  for (const Symbol& symbol : equation.symbols)
    if (!symbol.is_coordinate())
      text += "% " + writer.name(symbol) + " = " + format_shortest(symbol.value) + " " + symbol.unit + ", " + symbol.meaning + "\n";
  if (any(equation.friction)) text += "% v_0 = " + format_shortest(kFrictionSmoothing) + "\n";
  for (const std::string& note : equation.notes) text += "% " + note + "\n";
  return text;
}

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
                     "    direction: there J M^-1 J^T has an eigenvalue below " + fraction + " of the largest, and its direction less than\n"
                     "    " + format_shortest(kAcross) + " of each column of J.\"\"\"\n"
                     "    mobility = J(q) @ np.linalg.solve(M(q), J(q).T)\n"
                     "    values, directions = np.linalg.eigh(mobility)\n"
                     "    is_across = np.all(np.abs(directions[:, 0] @ J(q)) <= " + format_shortest(kAcross) + " * np.linalg.norm(J(q), axis=0))\n"
                     "    if not values[0] > (" + fraction + " if is_across else 1e-13) * values[-1]:\n"
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
