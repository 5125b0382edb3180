// Joint friction. Coulomb's law jumps at zero speed; a jump would cost every integrator its order, so the
// sign is smoothed to tanh(qd / v0).
#include "dynamics/friction.hpp"

#include <algorithm>

#include "core/scalar.hpp"

namespace chainreel {

namespace {

// tanh, from the one exponential that neither overflows nor loses the sign.
double smooth_sign(double x) {
  const double e = exponential(-2 * absolute(x));
  const double t = (1 - e) / (1 + e);
  return x < 0 ? -t : t;
}

void write_friction(const Chain& chain, ConstVec qd, Vec tau_f) {
  std::fill(tau_f.begin(), tau_f.end(), 0.0);
  if (!chain.has_dissipation) return;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    const std::size_t freedoms = joint.kind == JointKind::floating ? 6 : 1;
    for (std::size_t k = 0; k < freedoms; ++k) {
      // A mimic joint moves `ratio` times as fast as its coordinate, and its torque reaches it `ratio` fold.
      const std::size_t v = std::size_t(joint.v_index) + k;
      const double rate = joint.ratio * qd[v];
      const double torque = joint.damping * rate + joint.friction * smooth_sign(rate / kFrictionSmoothing);
      tau_f[v] += joint.ratio * torque;
    }
  }
}

}  // namespace

void compute_friction(const Chain& chain, Workspace& ws, ConstVec qd) {
  write_friction(chain, qd, ws.tau_f);
}

std::vector<double> friction_of(const Chain& chain, ConstVec qd) {
  std::vector<double> tau_f(qd.size());
  write_friction(chain, qd, tau_f);
  return tau_f;
}

}  // namespace chainreel
