#include "symbols/formula.hpp"

#include <cmath>

namespace chainreel {

double value_of(const Formula& formula, std::span<const double> values, std::span<const double> angles) {
  double sum = 0;
  for (const Term& term : formula.terms) {
    double angle = 0, factor = 0;
    for (std::size_t i = 0; i < term.multiples.size(); ++i) angle += term.multiples[i] * angles[i];
    for (const Monomial& monomial : term.factor) {
      double product = monomial.coefficient.value;
      for (const auto& [symbol, exponent] : monomial.powers) product *= std::pow(values[std::size_t(symbol)], exponent);
      factor += product;
    }
    sum += factor * (term.wave == Wave::one ? 1 : term.wave == Wave::cosine ? std::cos(angle) : std::sin(angle));
  }
  return sum;
}

}  // namespace chainreel
