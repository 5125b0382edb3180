// The arrays of the recursions, one entry per body, under the letters of R. Featherstone, Rigid Body Dynamics
// Algorithms (2008), tables 5.1, 6.2 and 7.1. Body 0 is the world. The texts of the recursions take the
// algebra as template parameter: Planar<T> or Spatial<T>, over double, dual or quad numbers.
#pragma once

#include <span>
#include <vector>

#include "core/scalar.hpp"
#include "dynamics/planar.hpp"
#include "dynamics/spatial.hpp"
#include "model/chain.hpp"

namespace chainreel {

template <class A>
struct Links {
  using Algebra = A;
  using T = typename A::Scalar;

  explicit Links(const Chain& chain);
  std::size_t size() const { return joint.size(); }

  // The model.
  struct Joint {
    std::size_t parent = 0;
    std::size_t q = 0, v = 0;  // first coordinate and first freedom
    std::size_t freedoms = 1;  // 6 for a floating joint
  };
  std::vector<Joint> joint;
  std::vector<typename A::Body> body;
  typename A::Motion base_acceleration;

  // The pose.
  std::vector<typename A::Placement> X;  // in the parent
  std::vector<typename A::Motion> S;     // of the joint, times the ratio of a mimic joint
  std::vector<typename A::RigidInertia> I;
  std::vector<typename A::Pose> pose;  // in the world

  // What moves.
  std::vector<typename A::Motion> v, a;  // velocity, acceleration
  std::vector<typename A::Force> f;      // force across the joint

  // Composite and articulated inertias.
  std::vector<typename A::RigidInertia> Ic;
  std::vector<typename A::Inertia> IA;
  std::vector<typename A::Motion> c;  // velocity product
  std::vector<typename A::Force> pA, U;
  std::vector<T> D_inv, u;
};

template <class A>
Links<A>::Links(const Chain& chain) : base_acceleration(A::base_acceleration(chain)) {
  const std::size_t n = chain.bodies.size();
  joint.resize(n);
  body.resize(n);
  for (std::size_t i = 1; i < n; ++i) {
    const chainreel::Joint& j = chain.bodies[i].joint;
    joint[i] = {std::size_t(chain.bodies[i].parent), std::size_t(j.q_index), std::size_t(j.v_index),
                j.kind == JointKind::floating ? std::size_t(6) : std::size_t(1)};
    body[i] = A::body_of(chain, int(i));
  }
  const auto size = [n](auto&... arrays) { (arrays.resize(n), ...); };
  size(X, S, I, pose, v, a, f, Ic, IA, c, pA, U, D_inv, u);
}

// Every algebra that the recursions are instantiated for.
#define CHAINREEL_FOR_EACH_ALGEBRA(DO) \
  DO(Planar<double>)                   \
  DO(Spatial<double>)                  \
  DO(Planar<Dual<double>>)             \
  DO(Spatial<Dual<double>>)            \
  DO(Planar<Quad>)                     \
  DO(Spatial<Quad>)

}  // namespace chainreel
