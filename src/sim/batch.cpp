#include "sim/batch.hpp"

#include <algorithm>
#include <cassert>
#include <thread>

#include "integrate/method.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {
namespace {

class GivenTorque final : public TorqueLaw {
 public:
  explicit GivenTorque(int nv) : tau(std::size_t(nv)) {}
  void evaluate(const Chain&, Workspace&, double, ConstVec, ConstVec, Vec result) override {
    std::copy(tau.begin(), tau.end(), result.begin());
  }
  double price(const Chain&) const override { return 0; }
  std::vector<double> tau;
};

bool fits_in_lane(const Chain& chain, const PlanarKernel& kernel) {
  return kernel.joints > 0 && !chain.has_dissipation;
}

}  // namespace

struct BatchSimulator::Alone {
  explicit Alone(const Chain& given)
      : chain(given),
        torque(chain.nv),
        system(chain, torque, LimitPolicy::report, {}),
        stepper(find_method("semi_implicit_euler").make_stepper(chain.nq, chain.nv)) {}

  Chain chain;
  GivenTorque torque;
  ChainSystem system;
  std::unique_ptr<Stepper> stepper;
  std::vector<double> q, qd;
};

BatchSimulator::BatchSimulator(const Chain& chain, int instances)
    : nq_(std::size_t(chain.nq)),
      nv_(std::size_t(chain.nv)),
      kernel_(planar_kernel_of(chain)),
      alone_(std::size_t(instances)),
      tau_(std::size_t(instances) * nv_),
      h_(std::size_t(instances), 0.001) {
  if (fits_in_lane(chain, kernel_)) {
    step_blocks_ = planar_batch_for(kernel_);
    blocks_.resize((alone_.size() + PlanarBlock::kLanes - 1) / PlanarBlock::kLanes);
    // Lanes without an instance rest as the first chain, so that they divide by nothing that is zero.
    for (PlanarBlock& block : blocks_)
      for (int lane = 0; lane < PlanarBlock::kLanes; ++lane) set_lane_chain(block, lane, kernel_);
  }
  const std::vector<double> q = zero_configuration(chain), qd(nv_);
  for (int i = 0; i < instances; ++i) place(i, chain, q, qd);
}

BatchSimulator::~BatchSimulator() = default;
BatchSimulator::BatchSimulator(BatchSimulator&&) noexcept = default;
BatchSimulator& BatchSimulator::operator=(BatchSimulator&&) noexcept = default;

// Puts instance i where its chain belongs.
void BatchSimulator::place(int i, const Chain& chain, ConstVec q, ConstVec qd) {
  const int lane = i % PlanarBlock::kLanes;
  std::unique_ptr<Alone>& alone = alone_[std::size_t(i)];
  const PlanarKernel kernel = planar_kernel_of(chain);
  if (step_blocks_ && fits_in_lane(chain, kernel) && are_alike(kernel, kernel_)) {
    alone.reset();
    set_lane_chain(block_of(i), lane, kernel);
  } else {
    alone = std::make_unique<Alone>(chain);
    alone->q.resize(nq_);
    alone->qd.resize(nv_);
    if (step_blocks_) {
      PlanarBlock& block = block_of(i);
      set_lane_chain(block, lane, kernel_);
      for (std::size_t k = 0; k < nv_; ++k) block.q[k][lane] = block.qd[k][lane] = block.Q[k][lane] = 0;
      block.h[lane] = 0;
    }
  }
  set_state(i, q, qd);
  set_torque(i, std::vector<double>(torque_of(i).begin(), torque_of(i).end()));
  set_step(i, h_[std::size_t(i)]);
}

void BatchSimulator::set_state(int i, ConstVec q, ConstVec qd) {
  assert(q.size() == nq_ && qd.size() == nv_);
  if (Alone* alone = alone_[std::size_t(i)].get()) {
    std::copy(q.begin(), q.end(), alone->q.begin());
    std::copy(qd.begin(), qd.end(), alone->qd.begin());
    return;
  }
  PlanarBlock& block = block_of(i);
  for (std::size_t k = 0; k < nv_; ++k) {
    block.q[k][i % PlanarBlock::kLanes] = q[k];
    block.qd[k][i % PlanarBlock::kLanes] = qd[k];
  }
}

void BatchSimulator::set_torque(int i, ConstVec tau) {
  assert(tau.size() == nv_);
  std::copy(tau.begin(), tau.end(), tau_.begin() + std::ptrdiff_t(std::size_t(i) * nv_));
  if (Alone* alone = alone_[std::size_t(i)].get()) {
    alone->torque.tau.assign(tau.begin(), tau.end());
  } else {
    set_lane_torque(block_of(i), i % PlanarBlock::kLanes, int(nv_), tau.data());
  }
}

void BatchSimulator::set_step(int i, double h) {
  h_[std::size_t(i)] = h;
  if (!alone_[std::size_t(i)]) block_of(i).h[i % PlanarBlock::kLanes] = h;
}

void BatchSimulator::set_chain(int i, const Chain& chain) {
  assert(std::size_t(chain.nq) == nq_ && std::size_t(chain.nv) == nv_);
  std::vector<double> q(nq_), qd(nv_);
  read_state(i, q, qd);
  place(i, chain, q, qd);
}

void BatchSimulator::read_state(int i, Vec q, Vec qd) const {
  assert(q.size() == nq_ && qd.size() == nv_);
  if (const Alone* alone = alone_[std::size_t(i)].get()) {
    std::copy(alone->q.begin(), alone->q.end(), q.begin());
    std::copy(alone->qd.begin(), alone->qd.end(), qd.begin());
    return;
  }
  const PlanarBlock& block = block_of(i);
  for (std::size_t k = 0; k < nv_; ++k) {
    q[k] = block.q[k][i % PlanarBlock::kLanes];
    qd[k] = block.qd[k][i % PlanarBlock::kLanes];
  }
}

// One thread's share: a run of blocks, and a run of those alone.
void BatchSimulator::step_slice(std::size_t slice, std::size_t slices, long steps) {
  const std::size_t end_block = blocks_.size() * (slice + 1) / slices;
  for (std::size_t b = blocks_.size() * slice / slices; b < end_block; b += kBlocksAtATime)
    step_blocks_(&blocks_[b], int(std::min<std::size_t>(kBlocksAtATime, end_block - b)), steps);

  const std::size_t end = alone_.size() * (slice + 1) / slices;
  for (std::size_t i = alone_.size() * slice / slices; i < end; ++i) {
    Alone* alone = alone_[i].get();
    if (!alone) continue;
    // The torques hold at every instant: the time says nothing.
    for (long k = 0; k < steps; ++k) alone->stepper->step(alone->system, 0, h_[i], alone->q, alone->qd);
  }
}

void BatchSimulator::run(long steps, int threads) {
  const auto slices = std::size_t(std::max(threads, 1));
  std::vector<std::jthread> others;
  for (std::size_t k = 1; k < slices; ++k)
    others.emplace_back([this, k, slices, steps] { step_slice(k, slices, steps); });
  step_slice(0, slices, steps);
}

}  // namespace chainreel
