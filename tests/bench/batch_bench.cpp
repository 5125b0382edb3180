// What a semi-implicit Euler step costs when many chains are stepped together, for each instruction set of
// this processor.
//
// Rule: 4096 chains with other states, torques, masses and steps each, one thread; the instruction sets are
// timed in turn, round after round; reported is the median of the rounds' processor time per step of one
// chain. The last column counts the instances whose state differs, in any bit, from the narrowest width's.
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <vector>

#include "bench/results.hpp"
#include "core/format.hpp"
#include "sim/batch.hpp"
#include "support/chains.hpp"

namespace chainreel::bench {
namespace {

constexpr int kInstances = 4096;
constexpr long kSteps = 200;  // per round
constexpr int kRounds = 15;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

struct Timed {
  Timed(const Chain& chain, InstructionSet given) : set(given), batch(chain, kInstances, given) {
    testing::Random random(1);
    for (int i = 0; i < kInstances; ++i) {
      Chain other = chain;
      for (std::size_t b = 1; b < other.bodies.size(); ++b)
        other.bodies[b].inertia.mass *= random.between(0.5, 2);
      testing::finish(other);
      batch.set_chain(i, other);
      const testing::State state = testing::random_state(chain, random);
      batch.set_state(i, state.q, state.qd);
      batch.set_torque(i, state.tau);
      batch.set_step(i, random.between(1e-4, 1e-3));
    }
  }

  double once() {
    const double begin = processor_seconds();
    batch.run(kSteps);
    return (processor_seconds() - begin) * 1e9 / (double(kSteps) * kInstances);
  }

  InstructionSet set;
  BatchSimulator batch;
  std::vector<double> ns;
};

int different(const BatchSimulator& a, const BatchSimulator& b, std::size_t n) {
  std::vector<double> q(n), qd(n), other_q(n), other_qd(n);
  int count = 0;
  for (int i = 0; i < kInstances; ++i) {
    a.read_state(i, q, qd);
    b.read_state(i, other_q, other_qd);
    const std::size_t bytes = n * sizeof(double);
    count += std::memcmp(q.data(), other_q.data(), bytes) != 0 ||
             std::memcmp(qd.data(), other_qd.data(), bytes) != 0;
  }
  return count;
}

void measure(const char* name, const Chain& chain, Results& results) {
  std::vector<Timed> all;
  for (const InstructionSet set : kInstructionSets)
    if (is_supported(set)) all.emplace_back(chain, set);
  for (Timed& timed : all) timed.once();  // warm
  for (int round = 0; round < kRounds; ++round)
    for (Timed& timed : all) timed.ns.push_back(timed.once());
  for (const Timed& timed : all) {
    const double ns = median_of(timed.ns);
    const int differing = different(timed.batch, all.front().batch, std::size_t(chain.nv));
    std::printf("%5s %8s %10.2f ns per step, %d differ\n", name, to_string(timed.set).c_str(), ns, differing);
    results.add({name, to_string(timed.set), format_fixed(ns, 2), std::to_string(differing)});
  }
}

void run() {
  Results results("batch", {"chain", "instruction_set", "median_ns_per_step", "instances_that_differ"});
  measure("RR", testing::rr_chain(), results);
  measure("RRR", testing::rrr_chain(), results);
  results.write();
}

}  // namespace
}  // namespace chainreel::bench

int main() {
  try {
    chainreel::bench::run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
