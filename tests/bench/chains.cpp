#include "bench/chains.hpp"

#include "model/read_chain.hpp"

namespace chainreel::bench {

std::vector<NamedChain> timed_chains() {
  const std::string root = CHAINREEL_SOURCE_FOLDER;
  ModelOptions options;
  options.friction = false;
  options.meshes = false;
  return {{"RR", read_chain(root + "/models/rr.urdf", options)},
          {"RRR", read_chain(root + "/models/rrr.urdf", options)},
          {"arm7", read_chain(root + "/tests/bench/models/arm7.urdf", options)}};
}

std::vector<test::State> states_of(const Chain& chain) {
  test::Random random(7);
  std::vector<test::State> states;
  for (std::size_t k = 0; k < kStates; ++k) states.push_back(test::random_state(chain, random));
  return states;
}

}  // namespace chainreel::bench
