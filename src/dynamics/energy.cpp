// Body by body, in world numbers, c the centre of mass:
//   K = 1/2 m |v_c|^2 + 1/2 w^T I_c w,  P = -m g . p_c,  linear momentum m v_c,  angular p_c x m v_c + I_c w
#include "dynamics/energy.hpp"

#include "dynamics/kinematics.hpp"

namespace chainreel {

namespace {

using Eigen::Vector3d;

// What a body's mass does.
struct MovingMass {
  double mass;
  Vector3d p, v;    // of the centre of mass
  Vector3d w, I_w;  // angular velocity, and the moment of momentum about the centre of mass
};

MovingMass moving_mass(const Chain& chain, const Workspace& ws, std::size_t i) {
  const Inertia& inertia = chain.bodies[i].inertia;
  const Eigen::Matrix3d R = ws.X_WB[i].linear();
  const Vector3d r = R * inertia.com;
  const Vector3d& w = ws.w_WB[i];
  return {inertia.mass, ws.X_WB[i].translation() + r, ws.v_WB[i] + w.cross(r), w,
          R * (inertia.about_com * (R.transpose() * w))};
}

Energy energy_of_body(const Chain& chain, const MovingMass& body) {
  return {0.5 * body.mass * body.v.squaredNorm() + 0.5 * body.w.dot(body.I_w),
          -body.mass * chain.gravity.dot(body.p)};
}

Momentum momentum_of_body(const MovingMass& body) {
  const Vector3d linear = body.mass * body.v;
  return {linear, body.p.cross(linear) + body.I_w};
}

template <class Visit>
void for_each_mass(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, Visit&& visit) {
  compute_kinematics(chain, ws, q, qd);
  for (std::size_t i = 1; i < chain.bodies.size(); ++i) visit(i, moving_mass(chain, ws, i));
}

}  // namespace

Energy energy_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd) {
  Energy sum;
  for_each_mass(chain, ws, q, qd, [&](std::size_t, const MovingMass& body) {
    const Energy energy = energy_of_body(chain, body);
    sum.kinetic += energy.kinetic;
    sum.potential += energy.potential;
  });
  return sum;
}

Momentum momentum_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd) {
  Momentum sum;
  for_each_mass(chain, ws, q, qd, [&](std::size_t, const MovingMass& body) {
    const Momentum momentum = momentum_of_body(body);
    sum.linear += momentum.linear;
    sum.angular += momentum.angular;
  });
  return sum;
}

MassCenter mass_center_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd) {
  MassCenter center;
  for_each_mass(chain, ws, q, qd, [&](std::size_t, const MovingMass& body) {
    center.mass += body.mass;
    center.position += body.mass * body.p;
    center.velocity += body.mass * body.v;
  });
  if (center.mass > 0) {
    center.position /= center.mass;
    center.velocity /= center.mass;
  }
  return center;
}

std::vector<BodyEnergy> body_energies_of(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd) {
  std::vector<BodyEnergy> bodies(chain.bodies.size());
  for_each_mass(chain, ws, q, qd, [&](std::size_t i, const MovingMass& body) {
    bodies[i] = {energy_of_body(chain, body), momentum_of_body(body)};
  });
  return bodies;
}

}  // namespace chainreel
