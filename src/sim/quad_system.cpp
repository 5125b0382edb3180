#include "sim/quad_system.hpp"

#include <vector>

#include "dynamics/friction.hpp"
#include "dynamics/recursions.hpp"
#include "sim/chain_series.hpp"

namespace chainreel {
namespace {

// tanh of joint friction, as in dynamics/friction.cpp.
Quad smooth_sign(Quad x) {
  const Quad e = exponential(-2 * absolute(x));
  const Quad t = (1 - e) / (1 + e);
  return x < 0 ? -t : t;
}

template <class A>
class ChainInQuad final : public QuadSystem {
 public:
  explicit ChainInQuad(const Simulation& simulation)
      : QuadSystem(simulation.chain.nv),
        chain_(simulation.chain),
        law_(*simulation.torque),
        links_(chain_),
        tau_(std::size_t(n_)) {}

  void acceleration(Quad t, std::span<const Quad> q, std::span<const Quad> v, std::span<Quad> vd) override {
    law_.evaluate_in_quad(t, q, v, tau_);
    for (std::size_t i = 1; i < chain_.bodies.size() && chain_.has_dissipation; ++i) {
      const Joint& joint = chain_.bodies[i].joint;
      const auto k = std::size_t(joint.v_index);
      tau_[k] -= Quad(joint.damping) * v[k];
      if (joint.friction != 0) tau_[k] -= joint.friction * smooth_sign(v[k] / Quad(kFrictionSmoothing));
    }
    place<A>(links_, q);
    aba<A>(links_, links_.base_acceleration, v, tau_, vd);
  }

 private:
  const Chain& chain_;
  const TorqueLaw& law_;
  Links<A> links_;
  std::vector<Quad> tau_;
};

}  // namespace

std::unique_ptr<QuadSystem> make_quad_system(const Simulation& simulation) {
  const Chain& chain = simulation.chain;
  if (!simulation.constraints.empty()) return {};
  if (chain.has_floating || chain.has_mimic || cuts_torques(chain, simulation.limit)) return {};
  std::vector<Quad> q(simulation.q0.begin(), simulation.q0.end()), tau(q.size());
  if (!simulation.torque->evaluate_in_quad(0, q, q, tau)) return {};
  if (chain.planar) return std::make_unique<ChainInQuad<Planar<Quad>>>(simulation);
  return std::make_unique<ChainInQuad<Spatial<Quad>>>(simulation);
}

}  // namespace chainreel
