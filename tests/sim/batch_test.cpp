// A batch against `simulate`, bit by bit.
#include "sim/batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <functional>

#include "sim/simulate.hpp"
#include "support/chains.hpp"

namespace chainreel {
namespace {

struct Instance {
  Chain chain;
  test::State state;
  double h = 0.001;
};

using MakeChain = std::function<Chain(test::Random&)>;

// Other masses and inertias each; the planar form is made anew from them.
Chain varied(Chain chain, test::Random& random) {
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const double scale = random.between(0.5, 3);
    chain.bodies[i].inertia.mass *= scale;
    chain.bodies[i].inertia.about_com *= scale;
  }
  test::finish(chain);
  return chain;
}

Chain varied_rr(test::Random& random) {
  return test::rr_chain({.L1 = random.between(0.5, 2),
                            .L2 = random.between(0.5, 2),
                            .m1 = random.between(0.5, 3),
                            .m2 = random.between(0.5, 3)});
}

Chain varied_rrr(test::Random& random) {
  return varied(test::rrr_chain(), random);
}

// Some start where the fast reduction of angles ends: far off, near multiples of pi/2, at both zeros.
std::vector<Instance> instances_of(const MakeChain& make, int count, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Instance> all;
  for (int i = 0; i < count; ++i) {
    Instance instance{make(random), {}, random.between(1e-4, 1e-3)};
    instance.state = test::random_state(instance.chain, random);
    if (i % 7 == 1) instance.state.q[0] = random.between(1e6, 1e8);
    if (i % 7 == 2) instance.state.q.back() = -random.between(1e6, 1e8);
    if (i % 7 == 3) instance.state.q[0] = 0x1.921fb54442d18p+0, instance.state.qd[0] = 1e-9;
    if (i % 7 == 4) instance.state.q[0] = -0.0, instance.state.qd[0] = 0;
    all.push_back(std::move(instance));
  }
  return all;
}

std::vector<std::uint64_t> bits_of(ConstVec q, ConstVec qd) {
  std::vector<std::uint64_t> bits;
  for (const double x : q) bits.push_back(std::bit_cast<std::uint64_t>(x));
  for (const double x : qd) bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

struct ConstantTorque final : TorqueLaw {
  double price(const Chain&) const override { return 0; }
  explicit ConstantTorque(std::vector<double> given) : tau_(std::move(given)) {}
  void evaluate(const Chain&, Workspace&, double, ConstVec, ConstVec, Vec tau) override {
    std::copy(tau_.begin(), tau_.end(), tau.begin());
  }
  bool is_constant() const override { return true; }
  std::vector<double> tau_;
};

// The bits after each of the steps, by `simulate`.
std::vector<std::vector<std::uint64_t>> scalar_bits(const Instance& instance, int steps) {
  Simulation run;
  run.chain = instance.chain;
  run.q0 = instance.state.q;
  run.qd0 = instance.state.qd;
  run.torque = std::make_unique<ConstantTorque>(instance.state.tau);
  run.method = &find_method("semi_implicit_euler");
  run.step = instance.h;
  run.duration = instance.h * steps;
  const Trajectory trajectory = simulate_every_step(run);
  EXPECT_EQ(trajectory.size(), steps + 1) << trajectory.trouble;
  std::vector<std::vector<std::uint64_t>> bits;
  for (int k = 0; k < trajectory.size(); ++k)
    bits.push_back(bits_of(trajectory.q_at(k), trajectory.qd_at(k)));
  return bits;
}

BatchSimulator batch_of(const std::vector<Instance>& all) {
  BatchSimulator batch(all.front().chain, int(all.size()));
  for (int i = 0; i < batch.instances(); ++i) {
    const Instance& instance = all[std::size_t(i)];
    if (i > 0) batch.set_chain(i, instance.chain);
    batch.set_state(i, instance.state.q, instance.state.qd);
    batch.set_torque(i, instance.state.tau);
    batch.set_step(i, instance.h);
  }
  return batch;
}

std::vector<std::uint64_t> bits_of(const BatchSimulator& batch, int i, const Chain& chain) {
  std::vector<double> q(std::size_t(chain.nq)), qd(std::size_t(chain.nv));
  batch.read_state(i, q, qd);
  return bits_of(q, qd);
}

// How many instances differ from `simulate` after one, two, .. calls of run.
int different(const std::vector<Instance>& all, BatchSimulator& batch, int threads = 1) {
  constexpr int kCalls = 4, kSteps = 40;
  std::vector<bool> differs(all.size());
  std::vector<std::vector<std::vector<std::uint64_t>>> expected;
  for (const Instance& instance : all) expected.push_back(scalar_bits(instance, kCalls * kSteps));
  for (int call = 1; call <= kCalls; ++call) {
    batch.run(kSteps, threads);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (bits_of(batch, int(i), all[i].chain) != expected[i].at(std::size_t(call) * kSteps))
        differs[i] = true;
  }
  return int(std::count(differs.begin(), differs.end(), true));
}

class Batch : public ::testing::Test {
 protected:
  // All instances have the bits of `simulate`; says how many were stepped in lanes.
  int in_lanes(const MakeChain& make, int count, std::uint64_t seed, int threads = 1) {
    const std::vector<Instance> all = instances_of(make, count, seed);
    BatchSimulator batch = batch_of(all);
    EXPECT_EQ(different(all, batch, threads), 0);
    int lanes = 0;
    for (int i = 0; i < count; ++i) lanes += batch.is_in_lane(i);
    return lanes;
  }
};

TEST_F(Batch, OfTwoJointsHasTheBitsOfEachRunByItself) {
  EXPECT_EQ(in_lanes(varied_rr, 301, 1), 301);
}

TEST_F(Batch, OfThreeJointsHasTheBitsOfEachRunByItself) {
  EXPECT_EQ(in_lanes(varied_rrr, 301, 2), 301);
}

TEST_F(Batch, OfOneAndOfFourJointsHasTheBitsOfEachRunByItself) {
  for (const int n : {1, 4}) {
    const auto make = [n](test::Random& r) { return varied(test::planar_serial_chain(n), r); };
    EXPECT_EQ(in_lanes(make, 60, 3), 60) << n;
  }
}

// Planes turned in space, centres of mass off the links' lines, axes that point either way: an instance whose
// axes are unlike the first one's in kind is stepped by itself.
TEST_F(Batch, OfCrookedChainsHasTheBitsOfEachRunByItself) {
  for (const int n : {2, 3, 4}) {
    const auto make = [n](test::Random& r) {
      return test::random_planar_tree(std::uint64_t(r.below(1000)),
                                         {.bodies = n, .serial = true, .prismatic = 0});
    };
    EXPECT_GT(in_lanes(make, 60, 4), 0) << n;
  }
}

TEST_F(Batch, TakesChainsWithoutAKernelOneByOne) {
  EXPECT_EQ(in_lanes([](test::Random& r) { return varied(test::pp_chain(), r); }, 20, 5), 0);
  EXPECT_EQ(in_lanes([](test::Random&) { return test::arm_chain(7); }, 5, 6), 0);
  const test::TreeOptions flying{.bodies = 4, .floating_base = true};
  EXPECT_EQ(in_lanes([&](test::Random&) { return test::random_tree(8, flying); }, 5, 7), 0);
}

TEST_F(Batch, StepsAChainWithFrictionBesideOthersByItself) {
  std::vector<Instance> all = instances_of(varied_rr, 20, 8);
  for (const std::size_t i : {3u, 12u}) {
    all[i].chain.bodies[1].joint.damping = 0.3;
    test::finish(all[i].chain);
  }
  BatchSimulator batch = batch_of(all);
  EXPECT_FALSE(batch.is_in_lane(3));
  EXPECT_TRUE(batch.is_in_lane(4));
  EXPECT_EQ(different(all, batch), 0);
}

TEST_F(Batch, HasTheSameBitsForAnyNumberOfThreads) {
  for (const int threads : {2, 3, 16}) EXPECT_EQ(in_lanes(varied_rrr, 101, 9, threads), 101) << threads;
}

TEST_F(Batch, KeepsStateTorqueAndStepWhenAChainIsReplaced) {
  std::vector<Instance> all = instances_of(varied_rr, 9, 10);
  BatchSimulator batch = batch_of(all);
  test::Random random(11);
  Chain rubbing = all[5].chain;
  rubbing.bodies[1].joint.damping = 1;
  test::finish(rubbing);
  batch.set_chain(5, rubbing);  // out of its lane
  all[5].chain = varied_rr(random);
  batch.set_chain(5, all[5].chain);  // and back
  EXPECT_TRUE(batch.is_in_lane(5));
  EXPECT_EQ(different(all, batch), 0);
}

// Negative controls: the comparison sees one changed number in one instance.
TEST_F(Batch, DiffersWhereOneMassTorqueOrStepDiffers) {
  const std::vector<Instance> all = instances_of(varied_rr, 40, 12);
  Instance other = all[17];
  other.chain.bodies[2].inertia.mass *= 1 + 1e-12;
  test::finish(other.chain);
  BatchSimulator mass = batch_of(all);
  mass.set_chain(17, other.chain);
  EXPECT_EQ(different(all, mass), 1);

  other.state.tau[1] *= 1 + 1e-12;
  BatchSimulator torque = batch_of(all);
  torque.set_torque(17, other.state.tau);
  EXPECT_EQ(different(all, torque), 1);

  BatchSimulator step = batch_of(all);
  step.set_step(17, other.h * (1 + 1e-12));
  EXPECT_EQ(different(all, step), 1);
}

}  // namespace
}  // namespace chainreel
