// The chains that are timed, and the states at which.
#pragma once

#include <string>
#include <vector>

#include "model/chain.hpp"
#include "support/chains.hpp"

namespace chainreel::bench {

struct NamedChain {
  std::string name;  // RR, RRR or arm7
  Chain chain;
};

// From models/rr.urdf, models/rrr.urdf and tests/bench/models/arm7.urdf, without friction.
std::vector<NamedChain> timed_chains();

// As many as a call after another goes round, so that no branch is learnt by heart.
inline constexpr std::size_t kStates = 64;  // a power of two
std::vector<test::State> states_of(const Chain& chain);

}  // namespace chainreel::bench
