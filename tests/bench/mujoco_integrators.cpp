#include <algorithm>
#include <cmath>

#include "bench/integrator_engines.hpp"
#include "peers/mujoco_chain.hpp"

namespace chainreel::bench {
namespace {

class MujocoRk4 final : public EndFinder {
 public:
  MujocoRk4(const MotionProblem& problem, std::vector<double> ladder)
      : EndFinder("MuJoCo RK4", std::move(ladder)), run_(problem.run), chain_(run_.chain) {
    chain_.use_rk4();
    ChainSystem system(run_);
    const ConstVec tau = system.torque(0, run_.q0, run_.qd0);
    tau_.assign(tau.begin(), tau.end());
  }

  std::vector<double> end_of(double rung) override {
    mjData* const d = chain_.data();
    std::copy(run_.q0.begin(), run_.q0.end(), d->qpos);
    std::copy(run_.qd0.begin(), run_.qd0.end(), d->qvel);
    std::copy(tau_.begin(), tau_.end(), d->qfrc_applied);
    chain_.set_step(rung);
    const long steps = std::lround(run_.duration / rung);
    for (long k = 0; k < steps; ++k) mj_step(chain_.model(), d);
    return {d->qpos, d->qpos + run_.chain.nq};
  }

 private:
  const Simulation& run_;
  peers::MujocoChain chain_;
  std::vector<double> tau_;
};

}  // namespace

std::unique_ptr<EndFinder> by_mujoco(const MotionProblem& problem, std::vector<double> rungs) {
  return std::make_unique<MujocoRk4>(problem, std::move(rungs));
}

}  // namespace chainreel::bench
