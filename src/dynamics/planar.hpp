// The algebra of motion parallel to one plane: 3 numbers where space needs 6.
// R. Featherstone, Rigid Body Dynamics Algorithms (2008), ch. 2.16 (planar vectors) and ch. 2.9-2.13.
//
// A body's numbers are taken about its own origin (a point fixed in it, at its joint) and along the plane's
// axes ex, ey, which never turn. Neighbouring bodies then differ by a shift r = (origin of the body) -
// (origin of its parent) alone: no product ever turns a vector, and each body costs one sine and cosine, of
// its absolute angle phi. The relations of Featherstone hold unchanged, because they hold in every set of
// coordinates at every instant.
//
//   Motion  (w; x, y)   rate of turn about the normal; velocity of the origin
//   Force   (n; x, y)   moment about the origin; force
//   S       (turn; slide)   motion of the body against its parent for a unit rate of its coordinate
#pragma once

#include <array>

#include "core/scalar.hpp"
#include "model/chain.hpp"

namespace chainreel {

template <class T>
struct Planar {
  using Scalar = T;
  static constexpr bool has_floating = false;

  struct Motion {
    T w{}, x{}, y{};
    friend Motion operator+(const Motion& a, const Motion& b) { return {a.w + b.w, a.x + b.x, a.y + b.y}; }
    friend Motion operator*(const Motion& a, const T& k) { return {a.w * k, a.x * k, a.y * k}; }
  };

  struct Force {
    T n{}, x{}, y{};
    friend Force operator+(const Force& a, const Force& b) { return {a.n + b.n, a.x + b.x, a.y + b.y}; }
    friend Force operator*(const Force& a, const T& k) { return {a.n * k, a.x * k, a.y * k}; }
  };

  // Mass, mass times centre of mass, moment of inertia about the origin.
  struct RigidInertia {
    T m{}, hx{}, hy{}, I{};
    friend Force operator*(const RigidInertia& I, const Motion& v) {
      return {I.I * v.w + (I.hx * v.y - I.hy * v.x), I.m * v.x - I.hy * v.w, I.m * v.y + I.hx * v.w};
    }
  };

  // A symmetric 3x3 matrix from Motion to Force.
  struct Inertia {
    T nn{}, nx{}, ny{}, xx{}, xy{}, yy{};
    friend Force operator*(const Inertia& I, const Motion& v) {
      return {I.nn * v.w + I.nx * v.x + I.ny * v.y, I.nx * v.w + I.xx * v.x + I.xy * v.y,
              I.ny * v.w + I.xy * v.x + I.yy * v.y};
    }
  };

  // What is constant in one body.
  struct Body {
    T turn{}, turn_zero{};  // phi = phi of parent + turn q + turn_zero
    T slide_x{}, slide_y{}, slide_zero_x{},
        slide_zero_y{};            // r = p_PJ + slide q + slide_zero, along the parent
    T m{}, com_x{}, com_y{}, I{};  // along the body; I about its origin
    bool turns = true;
  };

  // Where a body stands: its absolute angle, and its origin seen from its parent's.
  struct Placement {
    T phi{}, s{}, c{1}, x{}, y{};
  };

  // Where a body stands in the world's planar frame.
  struct Pose {
    T s{}, c{1}, x{}, y{};
  };

  static Body body_of(const Chain& chain, int i);
  // Body `self` at joint coordinate *q; S and I come out along ex, ey.
  static void place(const Body& self, const Placement& parent, const T* q, Placement& X, Motion& S,
                    RigidInertia& I);
  static Pose pose_of(const Pose& parent, const Placement& X) {
    return {X.s, X.c, parent.x + X.x, parent.y + X.y};
  }
  static Motion base_acceleration(const Chain& chain) {  // the world rises at -gravity
    return {T(0), T(-chain.gravity.dot(chain.planar->plane.ex)),
            T(-chain.gravity.dot(chain.planar->plane.ey))};
  }

  // The motion of the joint for coordinate rates *qd (one number; planar chains have no floating joints), and
  // the k-th of its unit motions.
  static Motion joint_motion(const Body&, const Motion& S, const T* qd) { return S * *qd; }
  static Motion unit_motion(const Body&, const Motion& S, int) { return S; }

  static Motion to_child(const Placement& X, const Motion& v) {
    return {v.w, v.x - v.w * X.y, v.y + v.w * X.x};
  }
  static Force to_parent(const Placement& X, const Force& f) {
    return {f.n + (X.x * f.y - X.y * f.x), f.x, f.y};
  }
  static RigidInertia to_parent(const Placement& X, const RigidInertia& I) {
    const T hx = I.hx + I.m * X.x;
    const T hy = I.hy + I.m * X.y;
    return {I.m, hx, hy, I.I + (X.x * (I.hx + hx) + X.y * (I.hy + hy))};
  }
  static Inertia to_parent(const Placement& X, const Inertia& I) {
    const T nx = I.nx + (X.x * I.xy - X.y * I.xx);
    const T ny = I.ny + (X.x * I.yy - X.y * I.xy);
    return {I.nn + (X.x * (I.ny + ny) - X.y * (I.nx + nx)), nx, ny, I.xx, I.xy, I.yy};
  }

  // of a force along a motion
  static T power(const Motion& v, const Force& f) { return v.w * f.n + v.x * f.x + v.y * f.y; }
  // v x m, and v x* f
  static Motion cross_motion(const Motion& v, const Motion& m) {
    return {T(0), m.w * v.y - v.w * m.y, v.w * m.x - m.w * v.x};
  }
  static Force cross_force(const Motion& v, const Force& f) {
    return {v.x * f.y - v.y * f.x, -(v.w * f.y), v.w * f.x};
  }

  // Points of a frame, in the body and in the world; a motion in the world's axes, at such a point instead of
  // the body's origin; the acceleration that a stopwatch would measure there.
  struct Point {
    T x{}, y{};
  };
  static Point point_of(const Chain& chain, const Frame& frame);
  static Point in_world(const Pose& X, const Point& p) {
    return {X.x + (X.c * p.x - X.s * p.y), X.y + (X.s * p.x + X.c * p.y)};
  }
  static Motion in_world(const Pose& X, const Motion& v, const Point& at) {
    return {v.w, v.x - v.w * (at.y - X.y), v.y + v.w * (at.x - X.x)};
  }
  static Motion classical(const Motion& a, const Motion& v) {
    return {a.w, a.x - v.w * v.y, a.y + v.w * v.x};
  }
  static constexpr int kLinearRows = 2, kFullRows = 3;
  static std::array<T, 3> rows(const Motion& v) { return {v.w, v.x, v.y}; }  // linear ones last

  static Inertia articulated(const RigidInertia& I) { return {I.I, -I.hy, I.hx, I.m, T(0), I.m}; }
  static void add(RigidInertia& sum, const RigidInertia& I) {
    sum = {sum.m + I.m, sum.hx + I.hx, sum.hy + I.hy, sum.I + I.I};
  }
  static void add(Inertia& sum, const Inertia& I) {
    sum = {sum.nn + I.nn, sum.nx + I.nx, sum.ny + I.ny, sum.xx + I.xx, sum.xy + I.xy, sum.yy + I.yy};
  }
  // I - U U^T / D
  static Inertia without(const Inertia& I, const Force& U, const T& D_inv) {
    const Force V = U * D_inv;
    return {I.nn - U.n * V.n, I.nx - U.n * V.x, I.ny - U.n * V.y,
            I.xx - U.x * V.x, I.xy - U.x * V.y, I.yy - U.y * V.y};
  }
};

template <class T>
typename Planar<T>::Body Planar<T>::body_of(const Chain& chain, int i) {
  const PlanarBody& b = chain.planar->bodies[std::size_t(i)];
  Body self;
  self.turns = b.kind == JointKind::revolute;
  if (self.turns) {
    self.turn = T(b.sign * b.ratio);
    self.turn_zero = T(b.sign * b.offset);
  } else {
    self.slide_x = T(b.direction.x()) * T(b.ratio);
    self.slide_y = T(b.direction.y()) * T(b.ratio);
  }
  const T offset = self.turns ? T(0) : T(b.offset);
  self.slide_zero_x = T(b.p_PJ.x()) + T(b.direction.x()) * offset;
  self.slide_zero_y = T(b.p_PJ.y()) + T(b.direction.y()) * offset;
  self.m = T(b.mass);
  self.com_x = T(b.com.x());
  self.com_y = T(b.com.y());
  self.I = T(b.inertia) + T(b.mass) * (T(b.com.x()) * T(b.com.x()) + T(b.com.y()) * T(b.com.y()));
  return self;
}

template <class T>
typename Planar<T>::Point Planar<T>::point_of(const Chain& chain, const Frame& frame) {
  const PlanarChain& planar = *chain.planar;
  const Eigen::Vector3d p = planar.X_WB_zero[std::size_t(frame.body)].linear() * frame.X_BF.translation();
  return {T(planar.plane.ex.dot(p)), T(planar.plane.ey.dot(p))};
}

template <class T>
void Planar<T>::place(const Body& self, const Placement& parent, const T* q, Placement& X, Motion& S,
                      RigidInertia& I) {
  const T& s = parent.s;
  const T& c = parent.c;
  if (self.turns) {
    X.phi = parent.phi + (self.turn * *q + self.turn_zero);
    const auto [sin, cos] = sin_cos(X.phi);
    X.s = sin;
    X.c = cos;
    X.x = c * self.slide_zero_x - s * self.slide_zero_y;
    X.y = s * self.slide_zero_x + c * self.slide_zero_y;
    S = {self.turn, T(0), T(0)};
  } else {
    X.phi = parent.phi;
    X.s = s;
    X.c = c;
    const T rx = self.slide_zero_x + self.slide_x * *q;
    const T ry = self.slide_zero_y + self.slide_y * *q;
    X.x = c * rx - s * ry;
    X.y = s * rx + c * ry;
    S = {T(0), c * self.slide_x - s * self.slide_y, s * self.slide_x + c * self.slide_y};
  }
  I.m = self.m;
  I.hx = self.m * (X.c * self.com_x - X.s * self.com_y);
  I.hy = self.m * (X.s * self.com_x + X.c * self.com_y);
  I.I = self.I;
}

}  // namespace chainreel
