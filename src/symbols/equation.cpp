#include "symbols/equation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/error.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"
#include "symbols/derive.hpp"

namespace chainreel {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

// Numbers of terms are products of a few entries of rotations: what is smaller is their round-off.
constexpr double kNoCoefficient = 1e-10;
constexpr long kLargestInFraction = 1000;

using Powers = std::vector<std::pair<int, int>>;

// Polynomials of GiNaC as formulas, and where each symbol stands in the list that is told.
class Reader {
 public:
  Reader(const Symbols& symbols, const Coordinates& coordinates) : symbols_(symbols), coordinates_(coordinates) {
    // Told by their kind, and within it in the order of the bodies.
    order_.resize(symbols.list().size());
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](int a, int b) { return symbols.list()[std::size_t(a)].kind < symbols.list()[std::size_t(b)].kind; });
    place_.resize(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) place_[std::size_t(order_[k])] = int(k);
  }

  Formula read(const ex& e) const {
    std::map<std::vector<int>, std::map<Powers, numeric>> by_wave;
    const ex expanded = e.expand();
    if (GiNaC::is_a<GiNaC::add>(expanded))
      for (const ex& term : expanded) add_term(term, by_wave);
    else if (!expanded.is_zero())
      add_term(expanded, by_wave);
    Formula formula;
    for (const auto& [multiples, factor] : by_wave) {
      const auto first = std::find_if(multiples.begin(), multiples.end(), [](int k) { return k != 0; });
      if (first == multiples.end()) {
        add(formula, Wave::one, multiples, factor);
        continue;
      }
      std::vector<int> opposite = multiples;
      for (int& k : opposite) k = -k;
      const auto other = by_wave.find(opposite);
      if (*first < 0 && other != by_wave.end()) continue;  // told with the other one
      // a z + b / z = (a + b) cos + i (a - b) sin.
      const std::map<Powers, numeric> none;
      const auto& before = *first > 0 ? factor : none;
      const auto& after = *first > 0 ? (other == by_wave.end() ? none : other->second) : factor;
      const std::vector<int>& told = *first > 0 ? multiples : opposite;
      add(formula, Wave::cosine, told, mixed(before, after, 1, 1));
      add(formula, Wave::sine, told, mixed(before, after, GiNaC::I, -GiNaC::I));
    }
    std::sort(formula.terms.begin(), formula.terms.end(), [](const Term& a, const Term& b) {
      return std::pair(a.multiples, a.wave) < std::pair(b.multiples, b.wave);
    });
    return formula;
  }

  FormulaMatrix read(const GiNaC::matrix& m) const {
    FormulaMatrix told{int(m.rows()), int(m.cols()), {}};
    for (unsigned r = 0; r < m.rows(); ++r)
      for (unsigned c = 0; c < m.cols(); ++c) told.entries.push_back(read(m(r, c)));
    return told;
  }

  std::vector<Symbol> symbols() const {
    std::vector<Symbol> told;
    for (const int k : order_) told.push_back(symbols_.list()[std::size_t(k)]);
    return told;
  }

 private:
  void add_term(const ex& term, std::map<std::vector<int>, std::map<Powers, numeric>>& by_wave) const {
    ex rest = term;
    std::vector<int> multiples;
    for (std::size_t i = 0; i < coordinates_.turns.size(); ++i) {
      const int k = coordinates_.turns[i] ? term.degree(coordinates_.exponential[i]) : 0;
      if (k != 0) rest = rest * pow(coordinates_.exponential[i], -k);
      multiples.push_back(k);
    }
    Powers powers;
    for (std::size_t s = 0; s < place_.size(); ++s) {
      const GiNaC::symbol& twin = symbols_.twins()[s];
      const int k = term.degree(twin);
      if (k == 0) continue;
      rest = rest * pow(twin, -k);
      powers.emplace_back(place_[s], k);
    }
    std::sort(powers.begin(), powers.end());
    numeric& sum = by_wave[multiples][powers];
    sum = sum + GiNaC::ex_to<numeric>(rest);
  }

  static std::map<Powers, numeric> mixed(const std::map<Powers, numeric>& a, const std::map<Powers, numeric>& b,
                                         const ex& of_a, const ex& of_b) {
    std::map<Powers, numeric> sum;
    for (const auto& [powers, c] : a) sum[powers] = sum[powers] + GiNaC::ex_to<numeric>(of_a) * c;
    for (const auto& [powers, c] : b) sum[powers] = sum[powers] + GiNaC::ex_to<numeric>(of_b) * c;
    return sum;
  }

  static Coefficient coefficient_of(const numeric& c) {
    Coefficient told{c.to_double(), 0, 0};
    if (c.is_rational() && abs(c.numer()) <= kLargestInFraction && c.denom() <= kLargestInFraction)
      told.above = c.numer().to_long(), told.below = c.denom().to_long();
    return told;
  }

  static void add(Formula& formula, Wave wave, const std::vector<int>& multiples,
                  const std::map<Powers, numeric>& factor) {
    Term term{wave, multiples, {}};
    for (const auto& [powers, number] : factor) {
      const numeric real = number.real();
      if (std::abs(real.to_double()) > kNoCoefficient) term.factor.push_back({coefficient_of(real), powers});
    }
    if (!term.factor.empty()) formula.terms.push_back(std::move(term));
  }

  const Symbols& symbols_;
  const Coordinates& coordinates_;
  std::vector<int> order_, place_;
};

Coordinates coordinates_of(const Chain& chain, Symbols& symbols) {
  Coordinates coordinates;
  coordinates.turns.assign(std::size_t(chain.nv), true);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const bool turns = joint.kind == JointKind::revolute;
    if (joint.ratio == 1 && joint.offset == 0) coordinates.turns[std::size_t(joint.v_index)] = turns;
  }
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const bool turns = joint.kind == JointKind::revolute;
    if (turns != coordinates.turns[std::size_t(joint.v_index)] || (turns && joint.ratio != std::round(joint.ratio)))
      throw Error(ExitCode::bad_input, "joint " + joint.name + " follows another one by a ratio that is not whole, or by turning where "
                                       "that slides: cosines of its angle are no polynomial in those of the other");
  }
  for (std::size_t i = 0; i < coordinates.turns.size(); ++i) {
    const std::string index = std::to_string(i + 1), &name = chain.coordinate_names[i];
    const bool turns = coordinates.turns[i];
    coordinates.exponential.emplace_back("z" + index);
    coordinates.position.push_back(turns ? ex(0) : symbols.add({"q", index, SymbolKind::position, 0, "m", "position of " + name}));
    coordinates.rate.push_back(symbols.add({"qd", index, SymbolKind::rate, 0, turns ? "rad/s" : "m/s", "rate of " + name}));
  }
  return coordinates;
}

// The least exponent of each symbol in all monomials.
std::map<int, int> common_powers(const std::vector<Formula>& formulas) {
  std::map<int, int> common;
  bool first = true;
  for (const Formula& formula : formulas)
    for (const Term& term : formula.terms)
      for (const Monomial& monomial : term.factor) {
        std::map<int, int> own(monomial.powers.begin(), monomial.powers.end()), least;
        for (const auto& [symbol, exponent] : first ? own : common)
          if (own.contains(symbol)) least[symbol] = std::min(exponent, own[symbol]);
        common = std::move(least), first = false;
      }
  return common;
}

void divide(Formula& formula, int symbol, int exponent) {
  for (Term& term : formula.terms)
    for (Monomial& monomial : term.factor)
      for (auto& [s, k] : monomial.powers)
        if (s == symbol) k -= exponent;
  for (Term& term : formula.terms)
    for (Monomial& monomial : term.factor) std::erase_if(monomial.powers, [](const auto& p) { return p.second == 0; });
}

// Products of terms in a Lambda that somebody reads; of a 3R arm with offsets there are millions.
constexpr double kMostProducts = 2e5;

double terms_of(const GiNaC::matrix& m) {
  double count = 0;
  for (unsigned i = 0; i < m.nops(); ++i) count += GiNaC::is_a<GiNaC::add>(m.op(i)) ? double(m.op(i).nops()) : 1;
  return count;
}

// J^-T M J^-1 by adjugates.
std::optional<SymbolicLambda> lambda_of(const GiNaC::matrix& M, const GiNaC::matrix& J, const Reader& reader) {
  const unsigned n = M.rows();
  if (J.rows() != n || n > 3) return std::nullopt;
  SymbolicLambda lambda;
  lambda.root = reader.read(J.determinant().expand());
  if (lambda.root.is_zero()) return std::nullopt;
  GiNaC::matrix adjugate(n, n);
  for (unsigned r = 0; r < n; ++r)
    for (unsigned c = 0; c < n; ++c) {
      if (n == 1) {
        adjugate(0, 0) = 1;
        continue;
      }
      const ex minor = GiNaC::ex_to<GiNaC::matrix>(GiNaC::reduced_matrix(J, c, r)).determinant();
      adjugate(r, c) = ((r + c) % 2 == 0 ? minor : -minor).expand();
    }
  if (terms_of(adjugate) * terms_of(adjugate) * terms_of(M) > kMostProducts) return std::nullopt;
  GiNaC::matrix numerator(n, n);
  for (unsigned r = 0; r < n; ++r)
    for (unsigned c = 0; c < n; ++c) {
      ex entry = 0;
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) entry += (adjugate(i, r) * M(i, j)).expand() * adjugate(j, c);
      numerator(r, c) = entry.expand();
    }
  lambda.numerator = reader.read(numerator);
  const auto above = common_powers(lambda.numerator.entries), below = common_powers({lambda.root});
  for (const auto& [symbol, exponent] : below) {
    const auto both = above.find(symbol);
    const int e = both == above.end() ? 0 : std::min(exponent, both->second / 2);
    if (e <= 0) continue;
    divide(lambda.root, symbol, e);
    for (Formula& entry : lambda.numerator.entries) divide(entry, symbol, 2 * e);
  }
  return lambda;
}

template <class Visit>
void for_each_formula(SymbolicEquation& equation, Visit visit) {
  for (FormulaMatrix* m : {&equation.M, &equation.C, &equation.J})
    for (Formula& e : m->entries) visit(e);
  for (std::vector<Formula>* v : {&equation.g, &equation.damping, &equation.friction})
    for (Formula& e : *v) visit(e);
  if (!equation.Lambda) return;
  for (Formula& e : equation.Lambda->numerator.entries) visit(e);
  visit(equation.Lambda->root);
}

// Symbols that stand nowhere (a base's height) are not told.
void drop_unused(SymbolicEquation& equation) {
  std::vector<int> place(equation.symbols.size(), -1);
  for_each_formula(equation, [&](const Formula& e) {
    for (const Term& term : e.terms)
      for (const Monomial& monomial : term.factor)
        for (const auto& power : monomial.powers) place[std::size_t(power.first)] = 0;
  });
  std::vector<Symbol> used;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] < 0 && !equation.symbols[i].is_coordinate()) continue;
    place[i] = int(used.size());
    used.push_back(equation.symbols[i]);
  }
  for_each_formula(equation, [&](Formula& e) {
    for (Term& term : e.terms)
      for (Monomial& monomial : term.factor)
        for (auto& power : monomial.powers) power.first = place[std::size_t(power.first)];
  });
  equation.symbols = std::move(used);
}

void add_friction(SymbolicEquation& equation, const Chain& chain, const ChainParameters& named,
                  const Coordinates& coordinates, const Reader& reader) {
  std::vector<ex> damping(std::size_t(chain.nv), 0), friction(std::size_t(chain.nv), 0);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const std::size_t own = std::size_t(joint.v_index);
    const ex ratio = exact_number(joint.ratio);
    damping[own] += ratio * ratio * named.bodies[i].damping * coordinates.rate[own];
    if (joint.friction != 0 && joint.ratio != 1)
      throw Error(ExitCode::bad_input, "joint " + joint.name + " has friction and follows another one: the equation in symbols has one sort of "
                                       "Coulomb's law a coordinate");
    friction[own] += named.bodies[i].friction;
  }
  for (std::size_t i = 0; i < damping.size(); ++i) {
    equation.damping.push_back(reader.read(damping[i]));
    equation.friction.push_back(reader.read(friction[i]));
  }
}

void require_few_joints(const Chain& chain) {
  if (chain.has_floating)
    throw Error(ExitCode::bad_input, "the equation in symbols knows chains on a fixed base: take --base fixed");
  if (chain.nv > kMostSymbolicFreedoms || chain.nv == 0)
    throw Error(ExitCode::bad_input, "the equation in symbols is for 1 to " + std::to_string(kMostSymbolicFreedoms) +
                                         " joints, " + chain.name + " has " + std::to_string(chain.nv) +
                                         ": take `chainreel dynamics` for its numbers, or fix joints in the model");
}

}  // namespace

SymbolicEquation symbolic_equation_of(const Chain& given) {
  require_few_joints(given);
  const bool as_given = is_right_angled(given);
  if (!as_given && !given.planar)
    throw Error(ExitCode::bad_input, given.name + " moves in space and some axis or joint's frame of it stands at no right angle: its equation "
                                                  "in symbols would fill books; take `chainreel dynamics` for its numbers");
  const Chain chain = as_given ? given : flattened(given);
  Symbols symbols;
  const ChainParameters named = parameters_of(chain, symbols);
  const Coordinates coordinates = coordinates_of(chain, symbols);
  TaskBasis basis = task_basis(given, Task::linear);
  if (!as_given) basis.directions = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  const Derived derived = derive(chain, named, coordinates, basis.directions);
  const Reader reader(symbols, coordinates);
  const unsigned n = unsigned(chain.nv);

  SymbolicEquation equation;
  equation.model = chain.name;
  equation.symbols = reader.symbols();
  equation.coordinates = chain.coordinate_names;
  equation.turns = coordinates.turns;
  equation.notes = derived.notes;
  equation.M = reader.read(derived.M);
  equation.C = reader.read(coriolis_of(derived.M, coordinates));
  for (std::size_t i = 0; i < n; ++i) equation.g.push_back(reader.read(derivative(derived.potential, coordinates, i)));
  add_friction(equation, chain, named, coordinates, reader);
  if (chain.end_effector >= 0) {
    equation.end_effector = chain.frames[std::size_t(chain.end_effector)].name;
    equation.axes = words_of(task_basis(given, Task::linear));
    GiNaC::matrix J(unsigned(basis.names.size()), n);
    for (unsigned r = 0; r < J.rows(); ++r)
      for (unsigned c = 0; c < n; ++c) J(r, c) = derivative(derived.position[r], coordinates, c);
    equation.J = reader.read(J);
    equation.Lambda = lambda_of(derived.M, J, reader);
  }
  drop_unused(equation);
  return equation;
}

SymbolicValues values_at(const SymbolicEquation& equation, std::span<const double> q, std::span<const double> qd) {
  SymbolicValues values;
  for (const Symbol& symbol : equation.symbols)
    values.symbols.push_back(symbol.kind == SymbolKind::position ? q[std::stoul(symbol.index) - 1]
                             : symbol.kind == SymbolKind::rate   ? qd[std::stoul(symbol.index) - 1]
                                                                 : symbol.value);
  values.angles.assign(q.begin(), q.end());
  return values;
}

}  // namespace chainreel
