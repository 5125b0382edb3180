// What a semi-implicit Euler step costs when many chains are stepped together, for each instruction set of
// this processor, beside MuJoCo's step of one chain.
//
// Rule: 4096 chains with other states, torques, masses and steps each, one thread; the instruction sets and
// MuJoCo are timed in turn, round after round; reported is the median of the rounds' processor time per step
// of one chain, and the median of each round's ratio. The last column counts the instances whose state
// differs, in any bit, from the narrowest width's.
#include <cstdio>
#include <cstring>
#include <vector>

#include "bench/engines.hpp"
#include "bench/results.hpp"
#include "core/format.hpp"
#include "sim/batch.hpp"
#include "support/chains.hpp"

namespace chainreel::bench {
namespace {

constexpr int kInstances = 4096;
constexpr long kSteps = 200;  // per round
constexpr int kRounds = 15;

// The step of one chain by MuJoCo, from rest at zero and every kSteps steps anew.
class Mujoco {
 public:
  explicit Mujoco(const Chain& chain) : engine_(chain) {
    start_.q = zero_configuration(chain);
    start_.qd.resize(std::size_t(chain.nv));
    start_.tau.resize(std::size_t(chain.nv));
  }

  double once() {
    constexpr int kRepeats = 50;
    const double begin = processor_seconds();
    for (int k = 0; k < kRepeats; ++k) {
      engine_.start(start_);
      for (long step = 0; step < kSteps; ++step) engine_.step(0.001);
    }
    return (processor_seconds() - begin) * 1e9 / (double(kSteps) * kRepeats);
  }

  std::vector<double> ns;

 private:
  MujocoEngine engine_;
  test::State start_;
};

struct Timed {
  Timed(const Chain& chain, InstructionSet given) : set(given), batch(chain, kInstances, given) {
    test::Random random(1);
    for (int i = 0; i < kInstances; ++i) {
      Chain other = chain;
      for (std::size_t b = 1; b < other.bodies.size(); ++b)
        other.bodies[b].inertia.mass *= random.between(0.5, 2);
      test::finish(other);
      batch.set_chain(i, other);
      const test::State state = test::random_state(chain, random);
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
  std::vector<double> ns, ratio;  // of each round; MuJoCo's time over ours
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

void measure(const char* name, const Chain& chain, double goal, Results& results) {
  std::vector<Timed> all;
  for (const InstructionSet set : kInstructionSets)
    if (is_supported(set)) all.emplace_back(chain, set);
  Mujoco mujoco(chain);
  for (Timed& timed : all) timed.once();  // warm
  for (int round = 0; round < kRounds; ++round) {
    mujoco.ns.push_back(mujoco.once());
    for (Timed& timed : all) {
      timed.ns.push_back(timed.once());
      timed.ratio.push_back(mujoco.ns.back() / timed.ns.back());
    }
  }
  std::printf("%5s   MuJoCo %10.2f ns per step of one chain\n", name, median_of(mujoco.ns));
  results.add({name, "MuJoCo", format_fixed(median_of(mujoco.ns), 2), "", "", ""});
  for (const Timed& timed : all) {
    const double ns = median_of(timed.ns), ratio = median_of(timed.ratio);
    const int differing = different(timed.batch, all.front().batch, std::size_t(chain.nv));
    const std::string of_goal = timed.set == InstructionSet::avx512 ? format_shortest(goal) : "";
    std::printf("%5s %8s %10.2f ns per step, ratio %.1f, goal %s, %d differ\n", name,
                to_string(timed.set).c_str(), ns, ratio, of_goal.c_str(), differing);
    results.add({name, to_string(timed.set), format_fixed(ns, 2), format_fixed(ratio, 1), of_goal,
                 std::to_string(differing)});
  }
}

void run() {
  Results results("batch", {"chain", "instruction_set", "median_ns_per_step", "ratio_to_mujoco", "goal",
                            "instances_that_differ"});
  measure("RR", test::rr_chain(), 200, results);
  measure("RRR", test::rrr_chain(), 130, results);
  results.write();
}

}  // namespace
}  // namespace chainreel::bench

int main() {
  return chainreel::bench::run_main(chainreel::bench::run);
}
