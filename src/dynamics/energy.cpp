// Energies body by body, in world numbers: K = 1/2 m |v_c|^2 + 1/2 w^T R I_c R^T w, P = -m g . p_c.
#include "dynamics/energy.hpp"

#include "dynamics/kinematics.hpp"

namespace chainreel {

namespace {

Energy energy_of_body(const Chain& chain, const Workspace& ws, std::size_t i) {
  const Inertia& inertia = chain.bodies[i].inertia;
  const Eigen::Vector3d r = ws.X_WB[i].linear() * inertia.com;
  const Eigen::Vector3d v_com = ws.v_WB[i] + ws.w_WB[i].cross(r);
  const Eigen::Vector3d w_B = ws.X_WB[i].linear().transpose() * ws.w_WB[i];
  Energy energy;
  energy.kinetic = 0.5 * inertia.mass * v_com.squaredNorm() + 0.5 * w_B.dot(inertia.about_com * w_B);
  energy.potential = -inertia.mass * chain.gravity.dot(ws.X_WB[i].translation() + r);
  return energy;
}

}  // namespace

Energy energy_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd) {
  compute_kinematics(chain, ws, q, qd);
  Energy sum;
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) {
    const Energy energy = energy_of_body(chain, ws, i);
    sum.kinetic += energy.kinetic;
    sum.potential += energy.potential;
  }
  return sum;
}

}  // namespace chainreel
