// One forward dynamics, and one step of semi-implicit Euler at 1 ms, of ours beside MuJoCo, Bullet and DART.
//
// Rule: first all engines must agree, else nothing is timed. Then Google Benchmark times them in random
// alternation, many repetitions of each; what is reported is the median of the processor time per call, and
// its ratio to ours. Forward dynamics goes round 64 random states; calls do not depend on each other. Steps
// do: each starts from the last one's end, and every 1000 steps from the start again. Other programs at work
// take caches away, which the larger engines feel most: the ratio of the lowest times is the more cautious
// number.
//
// Options are Google Benchmark's own, e.g. --benchmark_repetitions=31.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/agreement.hpp"
#include "bench/chains.hpp"
#include "bench/engines.hpp"
#include "bench/results.hpp"
#include "core/format.hpp"

namespace chainreel::bench {
namespace {

constexpr double kLargestDifference = 1e-9;  // round-off and MuJoCo's least moments leave 1e-13
constexpr int kStepsPerStart = 1000;

// How many times faster than MuJoCo ours ought to be.
const std::map<std::string, double> kGoals = {{"RR/fd", 40},    {"RR/step", 28}, {"RRR/fd", 30},
                                              {"RRR/step", 24}, {"arm7/fd", 5},  {"arm7/step", 4.8}};

template <class Engine>
void time_forward_dynamics(benchmark::State& loop, const Chain& chain) {
  Engine engine(chain);
  const std::vector<test::State> states = states_of(chain);
  std::size_t k = 0;
  for (auto _ : loop) {
    engine.set(states[k]);
    engine.forward_dynamics();
    k = (k + 1) % kStates;
  }
}

template <class Engine>
void time_step(benchmark::State& loop, const Chain& chain) {
  Engine engine(chain);
  // The torques of a random state would wind the chain up.
  test::State start = states_of(chain).front();
  start.tau.assign(start.tau.size(), 0);
  engine.start(start);
  int k = 0;
  for (auto _ : loop) {
    engine.step(0.001);
    if (++k < kStepsPerStart) continue;
    k = 0;
    loop.PauseTiming();
    engine.start(start);
    loop.ResumeTiming();
  }
}

// A pair of an engine and a quantity, under the name that Google Benchmark gives it.
struct Timed {
  std::string chain, quantity;
  EngineInfo engine;
  double difference = 0;        // from ours
  std::vector<double> ns = {};  // processor time per call, a number a repetition
  std::string name() const { return chain + "/" + quantity + "/" + engine.name; }
};

template <class Engine>
void add(const NamedChain& named, std::vector<Timed>& all) {
  all.push_back(
      {named.name, "fd", Engine::info(), difference_of_accelerations<Engine, OurEngine>(named.chain)});
  benchmark::RegisterBenchmark(all.back().name().c_str(), time_forward_dynamics<Engine>, named.chain);
  all.push_back({named.name, "step", Engine::info(), difference_of_steps<Engine, OurEngine>(named.chain)});
  benchmark::RegisterBenchmark(all.back().name().c_str(), time_step<Engine>, named.chain);
}

// Keeps what Google Benchmark measures.
class Collector : public benchmark::BenchmarkReporter {
 public:
  explicit Collector(std::vector<Timed>& all) : all_(all) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      for (Timed& timed : all_)
        if (run.run_name.function_name == timed.name())
          timed.ns.push_back(run.cpu_accumulated_time / double(run.iterations) * 1e9);
    }
  }

 private:
  std::vector<Timed>& all_;
};

const Timed& ours_beside(const std::vector<Timed>& all, const Timed& timed) {
  for (const Timed& other : all)
    if (other.chain == timed.chain && other.quantity == timed.quantity &&
        other.engine.name == OurEngine::info().name)
      return other;
  throw std::logic_error("ours was not timed");
}

bool all_agree(const std::vector<Timed>& all) {
  bool agree = true;
  for (const Timed& timed : all) {
    if (timed.difference <= kLargestDifference) continue;
    std::fprintf(stderr, "%s differs from ours by %.1e: nothing is timed\n", timed.name().c_str(),
                 timed.difference);
    agree = false;
  }
  return agree;
}

double lowest_of(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

void report(const std::vector<Timed>& all) {
  Results results("peers", {"chain", "quantity", "engine", "version", "call", "median_ns", "lowest_ns",
                            "repetitions", "ratio_to_ours", "ratio_of_lowest", "goal", "difference"});
  std::printf("%-6s %-5s %-10s %10s %10s %8s %8s  %s\n", "chain", "what", "engine", "median ns", "lowest ns",
              "ratio", "lowest", "goal");
  for (const Timed& timed : all) {
    if (timed.ns.empty()) continue;  // left out by --benchmark_filter
    const Timed& ours = ours_beside(all, timed);
    const double ns = median_of(timed.ns), lowest = lowest_of(timed.ns);
    const double ratio = ns / median_of(ours.ns), ratio_of_lowest = lowest / lowest_of(ours.ns);
    const bool has_goal = timed.engine.name == MujocoEngine::info().name;
    const std::string goal = has_goal ? format_shortest(kGoals.at(timed.chain + "/" + timed.quantity)) : "";
    std::printf("%-6s %-5s %-10s %10.1f %10.1f %8.2f %8.2f  %s\n", timed.chain.c_str(),
                timed.quantity.c_str(), timed.engine.name.c_str(), ns, lowest, ratio, ratio_of_lowest,
                goal.c_str());
    results.add({timed.chain, timed.quantity, timed.engine.name, "\"" + timed.engine.version + "\"",
                 "\"" + (timed.quantity == "fd" ? timed.engine.forward_dynamics : timed.engine.step) + "\"",
                 format_fixed(ns, 1), format_fixed(lowest, 1), std::to_string(timed.ns.size()),
                 format_fixed(ratio, 2), format_fixed(ratio_of_lowest, 2), goal,
                 format_significant(timed.difference, 2)});
  }
  results.write();
}

int run(int argc, char** argv) {
  // Ours first, so that the command line's own come behind and win.
  std::vector<std::string> words = {argv[0], "--benchmark_enable_random_interleaving=true",
                                    "--benchmark_repetitions=15", "--benchmark_min_time=0.03"};
  words.insert(words.end(), argv + 1, argv + argc);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  int count = int(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;

  const std::vector<NamedChain> chains = timed_chains();
  std::vector<Timed> all;
  for (const NamedChain& named : chains) {
    add<OurEngine>(named, all);
    add<MujocoEngine>(named, all);
    add<BulletEngine>(named, all);
    add<DartEngine>(named, all);
  }
  if (!all_agree(all)) return 1;
  Collector collector(all);
  benchmark::RunSpecifiedBenchmarks(&collector);
  report(all);
  return 0;
}

}  // namespace
}  // namespace chainreel::bench

int main(int argc, char** argv) {
  try {
    return chainreel::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
