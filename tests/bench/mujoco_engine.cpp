#include "bench/engines.hpp"

namespace chainreel::bench {

// Chains without floating joints: positions and velocities are the same numbers in the same order.
EngineInfo MujocoEngine::info() {
  return {"MuJoCo", mj_versionString(), "mj_forward", "mj_step (Euler)"};
}

void MujocoEngine::set(const test::State& state) {
  mjData* d = chain_.data();
  for (std::size_t i = 0; i < state.q.size(); ++i) {
    d->qpos[i] = state.q[i];
    d->qvel[i] = state.qd[i];
    d->qfrc_applied[i] = state.tau[i];
  }
}

void MujocoEngine::step(double h) {
  chain_.set_step(h);
  mj_step(chain_.model(), chain_.data());
}

std::vector<double> MujocoEngine::qdd() {
  return {chain_.data()->qacc, chain_.data()->qacc + chain_.model()->nv};
}

std::vector<double> MujocoEngine::q() {
  return {chain_.data()->qpos, chain_.data()->qpos + chain_.model()->nq};
}

std::vector<double> MujocoEngine::qd() {
  return {chain_.data()->qvel, chain_.data()->qvel + chain_.model()->nv};
}

}  // namespace chainreel::bench
