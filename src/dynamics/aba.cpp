// The articulated-body algorithm: forward dynamics in O(n). R. Featherstone, Rigid Body Dynamics Algorithms
// (2008), table 7.1. IA_i is the inertia that body i shows to a force while all joints behind it are free,
// pA_i the force that keeps its acceleration zero. p is the parent of i.
//
//   v_i = X v_p + S qd,  c_i = v_i x S qd,  pA_i = v_i x* I v_i               out
//   U = IA S,  D = S^T U,  u = tau - S^T pA                                    back
//   IA_p += X^T (IA - U U^T / D) X,  pA_p += X^T (pA + Ia c + U u / D)
//   a' = X a_p + c,  qdd = (u - U^T a') / D,  a_i = a' + S qdd                 out
//
// A floating joint hands no inertia on, and exactly its tau as force: IA a_i = tau - pA gives its
// acceleration.
#include <cassert>

#include "dynamics/equation_of_motion.hpp"
#include "dynamics/recursions.hpp"
#include "dynamics/scratch.hpp"

namespace chainreel {

namespace {

template <class A>
void sweep_out(Links<A>& links, ConstScalarSpan<A> qd) {
  for (std::size_t i = 1; i < links.size(); ++i) {
    const auto& joint = links.joint[i];
    const auto S_qd = A::joint_motion(links.body[i], links.S[i], &qd[joint.v]);
    auto& v = links.v[i];
    v = A::to_child(links.X[i], links.v[joint.parent]) + S_qd;
    links.c[i] = A::cross_motion(v, S_qd);
    links.pA[i] = A::cross_force(v, links.I[i] * v);
    links.IA[i] = A::articulated(links.I[i]);
  }
}

template <class A>
void sweep_back(Links<A>& links, ConstScalarSpan<A> tau) {
  using T = typename A::Scalar;
  for (std::size_t i = links.size(); --i > 0;) {
    const auto& joint = links.joint[i];
    const auto& X = links.X[i];
    const auto& IA = links.IA[i];
    const auto& pA = links.pA[i];
    auto& U = links.U[i];
    if constexpr (A::has_floating) {
      if (joint.freedoms == 6) {
        const auto force = A::joint_force(&tau[joint.v]);
        U = force + pA * T(-1);
        if (joint.parent > 0) links.pA[joint.parent] = links.pA[joint.parent] + A::to_parent(X, force);
        continue;
      }
    }
    const auto& S = links.S[i];
    U = IA * S;
    const T D_inv = links.D_inv[i] = T(1) / A::power(S, U);
    const T u = links.u[i] = tau[joint.v] - A::power(S, pA);
    if (joint.parent > 0) {
      const auto Ia = A::without(IA, U, D_inv);
      A::add(links.IA[joint.parent], A::to_parent(X, Ia));
      links.pA[joint.parent] =
          links.pA[joint.parent] + A::to_parent(X, pA + Ia * links.c[i] + U * (u * D_inv));
    }
  }
}

template <class A>
void sweep_accelerations(Links<A>& links, const typename A::Motion& base, ScalarSpan<A> qdd) {
  using T = typename A::Scalar;
  links.a[0] = base;
  for (std::size_t i = 1; i < links.size(); ++i) {
    const auto& joint = links.joint[i];
    const auto carried = A::to_child(links.X[i], links.a[joint.parent]) + links.c[i];
    auto& a = links.a[i];
    if constexpr (A::has_floating) {
      if (joint.freedoms == 6) {
        a = A::solve(links.IA[i], links.U[i]);
        A::write_joint_rates(a + carried * T(-1), &qdd[joint.v]);
        continue;
      }
    }
    const T rate = (links.u[i] - A::power(carried, links.U[i])) * links.D_inv[i];
    a = carried + links.S[i] * rate;
    qdd[joint.v] = rate;
  }
}

}  // namespace

template <class A>
void aba(Links<A>& links, const typename A::Motion& base, ConstScalarSpan<A> qd, ConstScalarSpan<A> tau,
         ScalarSpan<A> qdd) {
  sweep_out(links, qd);
  sweep_back(links, tau);
  sweep_accelerations(links, base, qdd);
}

#define INSTANTIATE(A) \
  template void aba<A>(Links<A>&, const A::Motion&, ConstScalarSpan<A>, ConstScalarSpan<A>, ScalarSpan<A>);
CHAINREEL_FOR_EACH_ALGEBRA(INSTANTIATE)
#undef INSTANTIATE

void compute_aba(const Chain& chain, Workspace& ws, ConstVec q, ConstVec qd, ConstVec tau) {
  ws.require_sizes(chain, q, qd, tau);
  assert(!chain.has_mimic);
  with_links(ws, [&](auto& links) {
    place(links, q);
    aba(links, links.base_acceleration, qd, tau, Vec(ws.qdd));
  });
}

}  // namespace chainreel
