// One floating joint within q and qd: its pose as a vector and a quaternion, its twist in the body's own axes.
#pragma once

#include <cstddef>

#include "core/scalar.hpp"
#include "dynamics/algebra.hpp"
#include "model/chain.hpp"

namespace chainreel {

struct Quaternion {
  Vec3<double> u;
  double w = 1;
};

inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {b.u * a.w + a.u * b.w + cross(a.u, b.u), a.w * b.w - dot(a.u, b.u)};
}

// By a unit quaternion.
inline Vec3<double> turned(const Quaternion& a, const Vec3<double>& v) {
  const Vec3<double> t = cross(a.u, v) * 2.0;
  return v + t * a.w + cross(a.u, t);
}

inline Quaternion unit_of(const Quaternion& a) {
  const double k = 1 / square_root(dot(a.u, a.u) + a.w * a.w);
  return {a.u * k, a.w * k};
}

// The numbers of the joint, from the first of them on.
struct Floating {
  static Vec3<double> position(const double* q) { return {q[0], q[1], q[2]}; }
  static Quaternion turn(const double* q) { return {{q[3], q[4], q[5]}, q[6]}; }
  static Vec3<double> linear(const double* qd) { return {qd[0], qd[1], qd[2]}; }
  static Vec3<double> angular(const double* qd) { return {qd[3], qd[4], qd[5]}; }
  static void write(const Vec3<double>& p, const Quaternion& a, double* q) {
    q[0] = p.x, q[1] = p.y, q[2] = p.z;
    q[3] = a.u.x, q[4] = a.u.y, q[5] = a.u.z, q[6] = a.w;
  }
};

// Coordinates and freedoms are numbered in the same order, so that behind k floating joints the coordinate of
// freedom v is v + k. Calls `scalar(q index, v index)` for each single coordinate, `floating(q index, v index)` for each floating
// joint.
template <class Scalar, class FloatingJoint>
void for_each_coordinate(const Chain& chain, Scalar&& scalar, FloatingJoint&& floating) {
  std::size_t q = 0, v = 0;
  const auto scalars_up_to = [&](std::size_t end) {
    while (v < end) scalar(q++, v++);
  };
  if (chain.has_floating) {
    for (const Body& body : chain.bodies) {
      if (&body == &chain.bodies.front() || body.joint.kind != JointKind::floating) continue;
      scalars_up_to(std::size_t(body.joint.v_index));
      floating(q, v);
      q += 7;
      v += 6;
    }
  }
  scalars_up_to(std::size_t(chain.nv));
}

}  // namespace chainreel
