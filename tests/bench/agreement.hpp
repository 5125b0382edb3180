// Whether engines compute the same before they are timed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bench/chains.hpp"

namespace chainreel::bench {

// max |a - b| / max(1, |b|_inf)
inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0, size = 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i])) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return largest / size;
}

// Of the accelerations at all states.
template <class Engine, class Reference>
double difference_of_accelerations(const Chain& chain) {
  Engine engine(chain);
  Reference reference(chain);
  double largest = 0;
  for (const test::State& state : states_of(chain)) {
    engine.set(state);
    engine.forward_dynamics();
    reference.set(state);
    reference.forward_dynamics();
    largest = std::max(largest, distance(engine.qdd(), reference.qdd()));
  }
  return largest;
}

inline constexpr int kComparedSteps = 100;  // of 1 ms: before a chain's chaos makes round-off visible

// Of positions and velocities after kComparedSteps from each state.
template <class Engine, class Reference>
double difference_of_steps(const Chain& chain) {
  Engine engine(chain);
  Reference reference(chain);
  double largest = 0;
  for (const test::State& state : states_of(chain)) {
    engine.start(state);
    reference.start(state);
    for (int k = 0; k < kComparedSteps; ++k) {
      engine.step(0.001);
      reference.step(0.001);
    }
    largest = std::max({largest, distance(engine.q(), reference.q()), distance(engine.qd(), reference.qd())});
  }
  return largest;
}

}  // namespace chainreel::bench
