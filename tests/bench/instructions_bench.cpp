// Instructions per forward dynamics: a number that no other load on the machine disturbs.
//
// Rule: callgrind counts the instructions of fd_once for two numbers of calls; their difference divided by
// the difference of the calls is free of start-up and reading. It holds the dozen instructions that a caller
// spends on the call. Valgrind 3.19 shows programs a processor with AVX2 and FMA where the machine has them,
// and none with AVX-512.
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>

#include "bench/chains.hpp"
#include "bench/results.hpp"
#include "core/format.hpp"
#include "support/run_program.hpp"

namespace chainreel::bench {
namespace {

constexpr long kFewCalls = 6400, kManyCalls = 19200;  // multiples of the states

// The goals of one call.
double goal_of(const std::string& chain) {
  return chain == "RR" ? 160 : chain == "RRR" ? 260 : 4300;
}

double instructions_of(const std::string& chain, long calls) {
  const ProgramResult result = run_command({"valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                                            CHAINREEL_FD_ONCE, chain, std::to_string(calls)},
                                           {.folder = {}, .environment = {}, .timeout_s = 600});
  if (result.status != 0) throw std::runtime_error("valgrind: " + result.err);
  const std::string label = "Collected : ";
  const std::size_t at = result.err.find(label);
  if (at == std::string::npos) throw std::runtime_error("callgrind counted nothing: " + result.err);
  const std::size_t begin = at + label.size();
  const std::optional<double> count =
      parse_number(result.err.substr(begin, result.err.find('\n', begin) - begin));
  if (!count) throw std::runtime_error("callgrind's count is no number: " + result.err);
  return *count;
}

void run() {
  Results results("instructions", {"chain", "instructions_per_fd", "goal"});
  results.note("counted by", run_command({"valgrind", "--version"}).out.substr(0, 15));
  std::printf("%-6s %20s %8s\n", "chain", "instructions per fd", "goal");
  for (const NamedChain& named : timed_chains()) {
    const double more = instructions_of(named.name, kManyCalls) - instructions_of(named.name, kFewCalls);
    const std::string count = format_fixed(more / double(kManyCalls - kFewCalls), 1);
    const std::string goal = format_shortest(goal_of(named.name));
    std::printf("%-6s %20s %8s\n", named.name.c_str(), count.c_str(), goal.c_str());
    results.add({named.name, count, goal});
  }
  results.write();
}

}  // namespace
}  // namespace chainreel::bench

int main() {
  return chainreel::bench::run_main(chainreel::bench::run);
}
