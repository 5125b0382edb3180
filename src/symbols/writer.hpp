// Formulas in a notation, with the names that their symbols have there.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/format.hpp"
#include "symbols/notation.hpp"

namespace chainreel {

// A part of a sum without its sign.
struct Piece {
  bool minus = false;
  std::string words;
};

inline std::string sum_of(const std::vector<Piece>& pieces) {
  if (pieces.empty()) return "0";
  std::string sum;
  for (const Piece& piece : pieces)
    sum += sum.empty() ? (piece.minus ? "-" : "") + piece.words : (piece.minus ? " - " : " + ") + piece.words;
  return sum;
}

inline std::string without_comma(std::string index) {
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

inline bool is_symmetric_in(const std::string& matrix) {
  return matrix == "M" || matrix == "N";
}

inline bool any(const std::vector<Formula>& formulas) {
  return std::any_of(formulas.begin(), formulas.end(), [](const Formula& e) { return !e.is_zero(); });
}

}  // namespace chainreel
