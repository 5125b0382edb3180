// The recursive Newton-Euler algorithm. R. Featherstone, Rigid Body Dynamics Algorithms (2008), table 5.1,
// after J. Luh, M. Walker, R. Paul (1980). p is the parent of i.
//
//   v_i = X v_p + S qd                      out, from the base
//   a_i = X a_p + S qdd + v_i x S qd        a of the base is -gravity: gravity costs nothing
//   f_i = I a_i + v_i x* I v_i
//   tau_i = S^T f_i,  f_p += X^T f_i        back, from the tips
//
// Bodies that share a coordinate (mimic) add their parts to the same tau.
#include <algorithm>

#include "dynamics/equation_of_motion.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

template <class A>
void accelerate(Links<A>& links, const typename A::Motion& base, ConstScalarSpan<A> qd,
                ConstScalarSpan<A> qdd) {
  auto& v = links.v;
  auto& a = links.a;
  a[0] = base;
  for (std::size_t i = 1; i < links.size(); ++i) {
    const auto& joint = links.joint[i];
    const auto S_qd = A::joint_motion(links.body[i], links.S[i], &qd[joint.v]);
    const auto S_qdd = A::joint_motion(links.body[i], links.S[i], &qdd[joint.v]);
    v[i] = A::to_child(links.X[i], v[joint.parent]) + S_qd;
    a[i] = A::to_child(links.X[i], a[joint.parent]) + S_qdd + A::cross_motion(v[i], S_qd);
  }
}

template <class A>
void rnea(Links<A>& links, const typename A::Motion& base, ConstScalarSpan<A> qd, ConstScalarSpan<A> qdd,
          ScalarSpan<A> tau) {
  auto& f = links.f;
  accelerate(links, base, qd, qdd);
  for (std::size_t i = 1; i < links.size(); ++i) {
    f[i] = links.I[i] * links.a[i] + A::cross_force(links.v[i], links.I[i] * links.v[i]);
  }

  std::fill(tau.begin(), tau.end(), typename A::Scalar(0));
  for (std::size_t i = links.size(); --i > 0;) {
    const auto& joint = links.joint[i];
    for (std::size_t k = 0; k < joint.freedoms; ++k) {
      tau[joint.v + k] = tau[joint.v + k] + A::power(A::unit_motion(links.body[i], links.S[i], int(k)), f[i]);
    }
    if (joint.parent > 0) f[joint.parent] = f[joint.parent] + A::to_parent(links.X[i], f[i]);
  }
}

#define INSTANTIATE(A)                                                                              \
  template void accelerate<A>(Links<A>&, const A::Motion&, ConstScalarSpan<A>, ConstScalarSpan<A>); \
  template void rnea<A>(Links<A>&, const A::Motion&, ConstScalarSpan<A>, ConstScalarSpan<A>, ScalarSpan<A>);
CHAINREEL_FOR_EACH_ALGEBRA(INSTANTIATE)
#undef INSTANTIATE

void compute_inverse_dynamics(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd) {
  ws.require_sizes(chain, q, qd, qdd);
  with_links(ws, [&](auto& links) {
    place(links, q);
    rnea(links, links.base_acceleration, qd, qdd, Vec(ws.tau));
  });
}

void compute_nle(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd) {
  ws.require_sizes(chain, q, qd);
  with_links(ws, [&](auto& links) {
    place(links, q);
    rnea(links, links.base_acceleration, qd, ConstVec(ws.scratch->zeros), Vec(ws.nle));
  });
}

void compute_gravity_torque(const Chain& chain, Workspace& ws, ConstVec q) {
  ws.require_sizes(chain, q);
  const ConstVec zeros = ws.scratch->zeros;
  with_links(ws, [&](auto& links) {
    place(links, q);
    rnea(links, links.base_acceleration, zeros, zeros, Vec(ws.tau_g));
  });
}

// The forces f of the recursive Newton-Euler algorithm (rnea.cpp) across the joints on the world, moved to
// its origin. Gravity is in them, since the world of the recursion rises at -g.

namespace {

using Eigen::Vector3d;

void add(Wrench& sum, const Chain& chain, const Planar<double>::Force& f) {
  const Plane& plane = chain.planar->plane;
  sum.force += f.x * plane.ex + f.y * plane.ey;
  sum.moment += f.n * plane.normal;
}

void add(Wrench& sum, const Chain&, const Spatial<double>::Force& f) {
  sum.force += Vector3d(f.f.x, f.f.y, f.f.z);
  sum.moment += Vector3d(f.n.x, f.n.y, f.n.z);
}

}  // namespace

Wrench compute_ground_reaction(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec qdd) {
  ws.require_sizes(chain, q, qd, qdd);
  Wrench sum;
  const Inertia& fixed = chain.bodies[0].inertia;
  Vector3d support = -fixed.mass * chain.gravity;
  if (chain.planar) support -= support.dot(chain.planar->plane.normal) * chain.planar->plane.normal;
  sum.force = support;
  sum.moment = fixed.com.cross(support);
  if (chain.planar) sum.moment = sum.moment.dot(chain.planar->plane.normal) * chain.planar->plane.normal;
  with_links(ws, [&](auto& links) {
    using A = typename std::remove_reference_t<decltype(links)>::Algebra;
    place(links, q);
    rnea(links, links.base_acceleration, qd, qdd, Vec(ws.tau));
    for (std::size_t i = 1; i < links.size(); ++i)
      if (links.joint[i].parent == 0) add(sum, chain, A::to_parent(links.X[i], links.f[i]));
  });
  return sum;
}

}  // namespace chainreel
