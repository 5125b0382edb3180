// What a joint costs in a long chain: the articulated-body algorithm is O(n), and beside its arithmetic only
// the memory that its arrays need can make a joint of a long chain dearer than one of a short chain.
//
// Rule: planar serial chains of 10 to 10,000 links, one state each; the lengths are timed in turn, round
// after round; reported is the median of the rounds' processor time per joint, and its ratio to that of 10
// links.
#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <vector>

#include "bench/results.hpp"
#include "core/format.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "support/chains.hpp"

namespace chainreel::bench {
namespace {

constexpr int kRounds = 25;
constexpr int kJointsPerRound = 400'000;
constexpr double kGoal = 1.3;  // of 10,000 links

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

struct Timed {
  explicit Timed(int n) : links(n), chain(test::planar_serial_chain(n)), ws(chain) {
    if (!chain.planar) throw std::logic_error("the chain ought to be planar");
    test::Random random(1);
    state = test::random_state(chain, random);
  }

  // ns per joint
  double once() {
    const int calls = kJointsPerRound / links;
    const double begin = processor_seconds();
    for (int k = 0; k < calls; ++k) compute_aba(chain, ws, state.q, state.qd, state.tau);
    return (processor_seconds() - begin) * 1e9 / (double(calls) * links);
  }

  int links;
  Chain chain;
  Workspace ws;
  test::State state;
  std::vector<double> ns;
};

void run() {
  std::vector<std::unique_ptr<Timed>> all;
  for (const int links : {10, 100, 1000, 10'000}) all.push_back(std::make_unique<Timed>(links));
  for (const auto& timed : all) timed->once();  // warm
  for (int round = 0; round < kRounds; ++round)
    for (const auto& timed : all) timed->ns.push_back(timed->once());

  Results results("length", {"links", "median_ns_per_joint", "ratio_to_10_links", "goal"});
  std::printf("%8s %14s %8s %6s\n", "links", "ns per joint", "ratio", "goal");
  const double shortest = median_of(all.front()->ns);
  for (const auto& timed : all) {
    const double ns = median_of(timed->ns);
    const std::string goal = timed->links == 10'000 ? format_shortest(kGoal) : "";
    std::printf("%8d %14.2f %8.3f %6s\n", timed->links, ns, ns / shortest, goal.c_str());
    results.add({std::to_string(timed->links), format_fixed(ns, 2), format_fixed(ns / shortest, 3), goal});
  }
  results.write();
}

}  // namespace
}  // namespace chainreel::bench

int main() {
  return chainreel::bench::run_main(chainreel::bench::run);
}
