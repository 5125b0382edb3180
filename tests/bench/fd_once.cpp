// fd_once CHAIN CALLS: that many forward dynamics of RR, RRR or arm7 and nothing else, for instructions_bench
// to count.
#include <cstdio>
#include <exception>
#include <string>

#include "bench/chains.hpp"
#include "dynamics/equation_of_motion.hpp"

namespace chainreel::bench {
namespace {

int run(const std::string& name, long calls) {
  for (const NamedChain& named : timed_chains()) {
    if (named.name != name) continue;
    const std::vector<test::State> states = states_of(named.chain);
    Workspace ws(named.chain);
    for (long i = 0; i < calls; ++i) {
      const test::State& state = states[std::size_t(i) % kStates];
      compute_forward_dynamics(named.chain, ws, state.q, state.qd, state.tau);
    }
    std::printf("%g\n", ws.qdd[0]);
    return 0;
  }
  std::fprintf(stderr, "no chain is called %s\n", name.c_str());
  return 2;
}

}  // namespace
}  // namespace chainreel::bench

int main(int argc, char** argv) {
  try {
    if (argc == 3) return chainreel::bench::run(argv[1], std::stol(argv[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  std::fprintf(stderr, "usage: fd_once CHAIN CALLS\n");
  return 2;
}
