#include "bench/engines.hpp"
#include "core/format.hpp"

namespace chainreel::bench {

EngineInfo OurEngine::info() {
  return {"chainreel", "this tree", "compute_forward_dynamics", "semi_implicit_euler over ChainSystem"};
}

OurEngine::OurEngine(const Chain& chain) : chain_(chain), ws_(chain) {
  stepper_ = find_method("semi_implicit_euler").make_stepper(chain.nq, chain.nv);
}

void OurEngine::start(const test::State& state) {
  q_ = state.q;
  qd_ = state.qd;
  std::vector<TorqueEntry> entries(state.tau.size());
  for (std::size_t i = 0; i < entries.size(); ++i) entries[i].text = format_shortest(state.tau[i]);
  torque_ = make_torque_law(chain_, entries, {});
  system_ = std::make_unique<ChainSystem>(chain_, *torque_, LimitPolicy::report, ConstraintPlan{});
}

}  // namespace chainreel::bench
