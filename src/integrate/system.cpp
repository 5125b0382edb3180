#include "integrate/system.hpp"

#include <algorithm>

namespace chainreel {

void SecondOrder::q_rate(std::span<const double>, std::span<const double> v, std::span<double> q_dot) const {
  std::copy(v.begin(), v.end(), q_dot.begin());
}

void SecondOrder::advance(std::span<double> q, std::span<const double> v, double h) const {
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += h * v[i];
}

void SecondOrder::normalize(std::span<double>) const {}

}  // namespace chainreel
